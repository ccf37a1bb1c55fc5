//! Film forces of the cage guide against a brute-force quadrature over the angle and the width of the film.
//!
//! The reference integrates the pressure and the stress of the Reynolds film point by point, from the gap, the
//! pressure-viscosity law and nothing else: no closed integral over the width, no integration by parts.

use crate::common::Random;
use cagedyn::laws::fluid::Fluid;
use cagedyn::laws::guide::journal::{FilmForce, Harmonic, JournalMotion};
use cagedyn::laws::guide::lubricant_layer::{LubricantLayer, PressureShear};
use cagedyn::laws::guide::short_bearing::ShortBearing;
use std::f64::consts::{FRAC_PI_2, PI};

/// Nodes and weights of Gauss-Legendre quadrature on [0, 1].
fn gauss(n: usize) -> Vec<(f64, f64)> {
    let node = |i: usize| {
        let mut x = (PI * (i as f64 + 0.75) / (n as f64 + 0.5)).cos();
        let mut slope = 0.0;
        for _ in 0..8 {
            let (mut p, mut before) = (x, 1.0);
            for k in 2..=n {
                let k = k as f64;
                (p, before) = (((2.0 * k - 1.0) * x * p - (k - 1.0) * before) / k, p);
            }
            slope = n as f64 * (x * p - before) / (x * x - 1.0);
            x -= p / slope;
        }
        ((1.0 - x) / 2.0, 1.0 / ((1.0 - x * x) * slope * slope))
    };
    (0..n).map(node).collect()
}

/// Pressure y, z; shear y, z; moment.
type Sums = [f64; 5];

fn combined(a: &Sums, b: &Sums, f: impl Fn(f64, f64) -> f64) -> Sums {
    std::array::from_fn(|i| f(a[i], b[i]))
}

/// What a point of the gap contributes, per unit of angle.
struct Section {
    /// Film thickness and its derivative by the angle, m.
    film: [f64; 2],
    /// (u1 + u2) dh/dx + 2 dh/dt, m/s.
    closing: f64,
    /// Isoviscous pressure at mid-width and its derivative by the angle, Pa.
    peak: [f64; 2],
    /// Sliding speed u1 - u2, m/s.
    sliding: f64,
    /// Film thickness less that of the layer, m.
    dry: f64,
}

/// A film to integrate. Angles d are counted from the direction of the eccentricity.
struct Reference<'a> {
    layer: &'a LubricantLayer,
    motion: &'a JournalMotion<f64>,
    eccentricity: f64,
    direction: f64,
    along: Vec<(f64, f64)>,
    across: Vec<(f64, f64)>,
    across_thick: Vec<(f64, f64)>,
}

impl<'a> Reference<'a> {
    fn new(layer: &'a LubricantLayer, motion: &'a JournalMotion<f64>) -> Self {
        let [y, z] = motion.position;
        let rules = [20, 96, 12].map(gauss);
        let [along, across, across_thick] = rules;
        Self { layer, motion, eccentricity: y.hypot(z), direction: z.atan2(y), along, across, across_thick }
    }

    fn section(&self, d: f64) -> Section {
        let (l, m, e) = (self.layer, self.motion, self.eccentricity);
        let ((sin, cos), (sin_phi, cos_phi)) = (d.sin_cos(), self.direction.sin_cos());
        let [vy, vz] = m.velocity;
        let (v_out, v_around) = (vy * cos_phi + vz * sin_phi, vz * cos_phi - vy * sin_phi);
        let bulge = 2.0 * e * (d / 2.0).sin().powi(2);
        let mut h = [bulge, e * sin, e * cos];
        let mut rate = [-v_out * cos - v_around * sin, v_out * sin - v_around * cos];
        for a in &l.roundness {
            let n = f64::from(a.order);
            let (sin, cos) = (n * (self.direction + d - m.profile_angle) + a.phase).sin_cos();
            h[0] -= a.amplitude * cos;
            h[1] += a.amplitude * n * sin;
            h[2] += a.amplitude * n * n * cos;
            rate[0] -= a.amplitude * n * m.profile_speed * sin;
            rate[1] -= a.amplitude * n * n * m.profile_speed * cos;
        }
        let dry = (l.clearance - l.thickness - e) + h[0];
        h[0] += l.clearance - e;
        let turning = m.journal_speed + m.bush_speed;
        let closing = [turning * h[1] + 2.0 * rate[0], turning * h[2] + 2.0 * rate[1]];
        let scale = -0.75 * l.viscosity * l.width * l.width / h[0].powi(3);
        Section {
            film: [h[0], h[1]],
            closing: closing[0],
            peak: [scale * closing[0], scale * (closing[1] - 3.0 * closing[0] * h[1] / h[0])],
            sliding: l.radius * (m.journal_speed - m.bush_speed) - v_out * sin + v_around * cos,
            dry,
        }
    }

    /// alpha q at mid-width.
    fn thickening(&self, s: &Section) -> f64 {
        self.layer.pressure_viscosity * s.peak[0]
    }

    /// Pressure, its derivative by the isoviscous pressure, and viscosity.
    fn barus(&self, q: f64) -> [f64; 3] {
        let (alpha, eta) = (self.layer.pressure_viscosity, self.layer.viscosity);
        if alpha == 0.0 {
            return [q, 1.0, eta];
        }
        let below = (alpha * q).min(self.layer.cap);
        let slope = 1.0 / (1.0 - below);
        [(-(-below).ln_1p() + slope * (alpha * q - below)) / alpha, slope, eta * slope]
    }

    /// Integrals of the pressure and of the stress at the journal over the width.
    fn line_loads(&self, s: &Section) -> [f64; 2] {
        let (l, drag) = (self.layer, s.sliding / s.film[0]);
        if s.peak[0] <= 0.0 {
            return [0.0, l.viscosity * drag * l.width];
        }
        // From the edge of the land to its middle, split where alpha q passes the cap.
        let ratio = l.cap / self.thickening(s);
        let split = if ratio < 1.0 { ratio / (1.0 + (1.0 - ratio).sqrt()) } else { 1.0 };
        let mut sums = [0.0; 2];
        for (rule, start, length) in [(&self.across, 0.0, split), (&self.across_thick, split, 1.0 - split)] {
            for (node, weight) in rule {
                let y = start + length * node;
                let share = y * (2.0 - y);
                let [p, slope, eta] = self.barus(s.peak[0] * share);
                let stress = slope * s.peak[1] * share / l.radius * s.film[0] / 2.0 + eta * drag;
                sums[0] += weight * length * l.width * p;
                sums[1] += weight * length * l.width * stress;
            }
        }
        sums
    }

    /// Forces and moment of line loads at the angle d.
    fn acting(&self, d: f64, [pressure, shear]: [f64; 2]) -> Sums {
        let (sin, cos) = (self.direction + d).sin_cos();
        let r = self.layer.radius;
        [-r * pressure * cos, -r * pressure * sin, r * shear * sin, -r * shear * cos, -r * r * shear]
    }

    /// Moment per angle of the pressure on the lobes of the journal, by which it holds back what turns them.
    fn on_lobes(&self, d: f64, section: &Section, pressure: f64) -> f64 {
        let turns = self.layer.profile_on_journal && self.layer.pressure_shear == PressureShear::WithEdges;
        let lobes = section.film[1] - self.eccentricity * d.sin();
        if turns { self.layer.radius * pressure * lobes } else { 0.0 }
    }

    /// Gauss sum over a part of a segment, whose ends are square-root points: d = a + (b - a) t^2 (3 - 2 t).
    fn panel(&self, [a, b]: [f64; 2], [from, to]: [f64; 2]) -> Sums {
        self.along.iter().fold([0.0; 5], |sums, (node, weight)| {
            let t = from + (to - from) * node;
            let d = a + (b - a) * t * t * (3.0 - 2.0 * t);
            let step = weight * (to - from) * (b - a) * 6.0 * t * (1.0 - t);
            let section = self.section(d);
            let loads = self.line_loads(&section);
            let mut acting = self.acting(d, loads);
            acting[4] -= self.on_lobes(d, &section, loads[0]);
            combined(&sums, &acting, |sum, f| sum + step * f)
        })
    }

    /// The segment halved until that changes nothing.
    fn refined(&self, ends: [f64; 2], part: [f64; 2], whole: &Sums, scale: &Sums) -> Sums {
        let middle = (part[0] + part[1]) / 2.0;
        let halves = [[part[0], middle], [middle, part[1]]];
        let [left, right] = halves.map(|half| self.panel(ends, half));
        let sum = combined(&left, &right, |a, b| a + b);
        if (0..5).all(|i| (sum[i] - whole[i]).abs() <= 3e-14 * scale[i]) {
            return sum;
        }
        assert!(part[1] - part[0] > 1e-9, "the reference does not converge");
        let [left, right] =
            [(halves[0], left), (halves[1], right)].map(|(h, w)| self.refined(ends, h, &w, scale));
        combined(&left, &right, |a, b| a + b)
    }

    /// Film force, and the largest alpha q.
    fn force(&self) -> (FilmForce<f64>, f64) {
        const SCAN: i32 = 10_000;
        // Dense near the eccentricity, where a thin film has its structure.
        let scan: Vec<f64> = (-SCAN..=SCAN).map(|i| PI * (f64::from(i) / f64::from(SCAN)).powi(3)).collect();
        let sections: Vec<Section> = scan.iter().map(|&d| self.section(d)).collect();
        let dry = |s: &Section| s.dry;
        let closing = |s: &Section| s.closing;
        let over_cap = |s: &Section| self.thickening(s) - self.layer.cap;
        let (mut breaks, mut wet_ends) = (vec![-PI, 0.0, PI], Vec::new());
        for (d, s) in scan.windows(2).zip(sections.windows(2)) {
            let changes = |f: &dyn Fn(&Section) -> f64| (f(&s[0]) < 0.0) != (f(&s[1]) < 0.0);
            for f in [&dry as &dyn Fn(&Section) -> f64, &closing, &over_cap] {
                if changes(f) {
                    breaks.push(self.root([d[0], d[1]], f));
                }
            }
            if changes(&dry) {
                wet_ends.push((self.root([d[0], d[1]], &dry), if s[0].dry < 0.0 { -1.0 } else { 1.0 }));
            }
        }
        breaks.sort_by(f64::total_cmp);
        let is_wet = |ends: &[f64; 2]| self.section((ends[0] + ends[1]) / 2.0).dry < 0.0;
        let segments: Vec<[f64; 2]> = breaks.windows(2).map(|w| [w[0], w[1]]).filter(is_wet).collect();

        let parts =
            |ends: [f64; 2]| (0..16).map(move |i| (ends, [f64::from(i) / 16.0, f64::from(i + 1) / 16.0]));
        let panels: Vec<_> = segments
            .into_iter()
            .flat_map(parts)
            .map(|(ends, part)| (ends, part, self.panel(ends, part)))
            .collect();
        let size = panels.iter().fold([0.0; 5], |sum, (.., p)| combined(&sum, p, |sum, p| sum + p.abs()));
        let largest = size[..4].iter().fold(0.0, |a: f64, &b| a.max(b));
        let scale = [largest, largest, largest, largest, size[4].max(largest * self.layer.radius)];
        let mut sums = panels.iter().fold([0.0; 5], |sum, (ends, part, whole)| {
            combined(&sum, &self.refined(*ends, *part, whole, &scale), |a, b| a + b)
        });
        if self.layer.pressure_shear == PressureShear::WithEdges {
            // Across a wet end p jumps between zero and its value inside: dp/dx is that jump at one point.
            for (d, jump) in wet_ends {
                let s = self.section(d);
                let line = jump * self.line_loads(&s)[0] * s.film[0] / (2.0 * self.layer.radius);
                sums = combined(&sums, &self.acting(d, [0.0, line]), |a, b| a + b);
            }
        }
        let wet = sections.iter().filter(|s| s.dry < 0.0);
        let thickest = wet.map(|s| self.thickening(s)).fold(0.0, f64::max);
        let minimum_film = sections.iter().map(|s| s.film[0]).fold(f64::INFINITY, f64::min);
        let [py, pz, sy, sz, moment] = sums;
        (FilmForce { pressure: [py, pz], shear: [sy, sz], moment, minimum_film }, thickest)
    }

    /// The sign change of `f` in an interval, by bisection.
    fn root(&self, [mut a, mut b]: [f64; 2], f: &dyn Fn(&Section) -> f64) -> f64 {
        let negative = f(&self.section(a)) < 0.0;
        for _ in 0..80 {
            let middle = (a + b) / 2.0;
            if (f(&self.section(middle)) < 0.0) == negative { a = middle } else { b = middle }
        }
        b
    }
}

fn logarithmic(random: &mut Random, low: f64, high: f64) -> f64 {
    (low.ln() + (high / low).ln() * random.unit()).exp()
}

/// Motion at the eccentricity `e`: slow, whirling, a hard squeeze towards the wall, or anything.
fn random_motion(random: &mut Random, e: f64) -> JournalMotion<f64> {
    let journal_speed = random.around_zero(1000.0);
    let bush_speed = if random.chance(0.3) { 0.0 } else { random.around_zero(1000.0) };
    let [v_out, v_around] = match random.index(5) {
        0 => [random.around_zero(1e-3), random.around_zero(1e-3)],
        1 => [random.around_zero(1e-3), random.around_zero(2000.0) * e],
        2 => [0.0, random.within(0.4, 0.6) * (journal_speed + bush_speed) * e],
        3 => {
            let v = logarithmic(random, 1e-3, 1.0);
            [v, random.around_zero(v)]
        }
        _ => [random.around_zero(1.0), random.around_zero(1.0)],
    };
    let (sin, cos) = random.around_zero(PI).sin_cos();
    JournalMotion {
        position: [e * cos, e * sin],
        velocity: [v_out * cos - v_around * sin, v_out * sin + v_around * cos],
        journal_speed,
        bush_speed,
        profile_angle: random.around_zero(PI),
        profile_speed: if random.chance(0.5) { journal_speed } else { bush_speed },
    }
}

/// Harmonics of orders 2 to 8 with amplitudes up to a fifth of `gap`.
fn random_roundness(random: &mut Random, gap: f64) -> Vec<Harmonic> {
    (0..1 + random.index(3))
        .map(|_| Harmonic {
            order: 2 + random.index(7) as u32,
            amplitude: random.around_zero(0.2 * gap),
            phase: random.around_zero(PI),
        })
        .collect()
}

/// A round layer, and an eccentricity that dips into it.
fn random_layer(random: &mut Random) -> (LubricantLayer, f64) {
    let clearance = logarithmic(random, 50e-6, 500e-6);
    let (e, thickness) = match random.index(10) {
        // A few parts in a thousand of the layer, or less, are dipped into.
        0 => {
            let thickness = logarithmic(random, 5e-6, clearance);
            (clearance - thickness * (1.0 - logarithmic(random, 1e-5, 1e-2)), thickness)
        }
        // Centred and flooded.
        1 => {
            let e = if random.chance(0.3) { 0.0 } else { logarithmic(random, 1e-12, 1e-7) };
            (e, clearance * random.within(1.01, 2.5))
        }
        // Nearly centred, with a film as thick as the layer.
        2 => {
            let e = logarithmic(random, 1e-8, 1e-6);
            (e, clearance + e * random.within(-0.9, 0.9))
        }
        3..=5 => {
            let e = clearance - logarithmic(random, 1e-7, clearance);
            (e, random.within(clearance + e, 2.5 * clearance))
        }
        _ => {
            let thickness = logarithmic(random, 5e-6, 2.0 * clearance);
            (clearance - logarithmic(random, 1e-7, clearance.min(thickness)), thickness)
        }
    };
    let layer = LubricantLayer {
        viscosity: logarithmic(random, 0.005, 0.5),
        pressure_viscosity: if random.chance(0.2) { 0.0 } else { logarithmic(random, 1e-10, 3e-8) },
        cap: random.within(0.5, 0.99),
        radius: logarithmic(random, 5e-3, 100e-3),
        clearance,
        width: logarithmic(random, 1e-3, 20e-3),
        thickness,
        pressure_shear: if random.chance(0.5) { PressureShear::WithEdges } else { PressureShear::WithinArc },
        roundness: Vec::new(),
        profile_on_journal: true,
    };
    (layer, e)
}

fn short_bearing(layer: &LubricantLayer, squeeze: bool) -> ShortBearing {
    ShortBearing {
        viscosity: layer.viscosity,
        radius: layer.radius,
        clearance: layer.clearance,
        land_width: layer.width,
        squeeze,
        pressure_moment: false,
        roundness: layer.roundness.clone(),
        profile_on_journal: true,
    }
}

/// Isoviscous and flooded.
fn filled(random: &mut Random, clearance: f64) -> LubricantLayer {
    let (layer, _) = random_layer(random);
    LubricantLayer { pressure_viscosity: 0.0, clearance, thickness: 3.0 * clearance, ..layer }
}

/// The worst of many comparisons, with the state it was found in.
#[derive(Default)]
struct Worst {
    error: f64,
    state: String,
    failures: usize,
}

impl Worst {
    fn add(&mut self, error: f64, tolerance: f64, state: impl FnOnce() -> String) {
        self.failures += usize::from(error > tolerance);
        if error > self.error {
            (self.error, self.state) = (error, state());
        }
    }

    fn check(&self) {
        assert!(
            self.failures == 0,
            "{} states differ, by up to {:e}: {}",
            self.failures,
            self.error,
            self.state
        );
    }
}

fn size([y, z]: [f64; 2]) -> f64 {
    y.hypot(z)
}

fn apart(a: [f64; 2], b: [f64; 2]) -> f64 {
    size([a[0] - b[0], a[1] - b[1]])
}

/// Largest error of a film force, as a share of its larger part or of the force that the moment has at the surface.
///
/// A centred film has a moment without a force: its force is known to the round-off of the moment.
fn error(radius: f64, expected: &FilmForce<f64>, found: &FilmForce<f64>) -> f64 {
    let largest = size(expected.pressure).max(size(expected.shear));
    let tangential = expected.moment.abs() / radius;
    let force = apart(expected.pressure, found.pressure) + apart(expected.shear, found.shear);
    let moment = (expected.moment - found.moment).abs() / radius;
    if !(force + moment).is_finite() {
        return f64::INFINITY;
    }
    if largest == 0.0 && tangential == 0.0 {
        return force + moment;
    }
    (force / (largest + 1e-5 * tangential)).max(moment / largest.max(tangential))
}

#[test]
fn round_layer_agrees() {
    let (mut random, mut worst) = (Random::new(1), Worst::default());
    let (mut over_cap, mut flooded, mut thin, mut far_over) = (0, 0, 0, 0);
    for _ in 0..1500 {
        let (layer, e) = random_layer(&mut random);
        let motion = random_motion(&mut random, e);
        let (expected, thickest) = Reference::new(&layer, &motion).force();
        over_cap += usize::from(thickest > layer.cap);
        far_over += usize::from(thickest > 1e3);
        flooded += usize::from(layer.thickness > layer.clearance + e);
        thin += usize::from(expected.minimum_film < 1e-6);
        let found = layer.force(&motion, Fluid::SAME).expect("a film");
        let error = error(layer.radius, &expected, &found);
        let film = (found.minimum_film / expected.minimum_film - 1.0).abs();
        assert!(
            film <= 1e-9,
            "smallest film: {expected:?} wanted, {found:?} found in\n{layer:?}\n{motion:?}"
        );
        worst.add(error, 1e-9, || format!("{expected:?} wanted, {found:?} found in\n{layer:?}\n{motion:?}"));
    }
    let sample = [over_cap, far_over, flooded, thin];
    assert!(sample.iter().all(|&n| n >= 30), "{sample:?} states over the cap, far over, flooded, thin");
    worst.check();
}

#[test]
fn rough_layer_agrees() {
    let (mut random, mut worst) = (Random::new(2), Worst::default());
    for _ in 0..300 {
        let clearance = logarithmic(&mut random, 50e-6, 500e-6);
        let gap = logarithmic(&mut random, 1e-7, clearance);
        let thickness = logarithmic(&mut random, (1.5 * gap).max(5e-6), 2.5 * clearance);
        let (layer, _) = random_layer(&mut random);
        let roundness = random_roundness(&mut random, gap);
        let layer = LubricantLayer { clearance, thickness, roundness, ..layer };
        let motion = random_motion(&mut random, clearance - gap);
        let (expected, _) = Reference::new(&layer, &motion).force();
        let found = layer.force(&motion, Fluid::SAME).expect("a film");
        let error = error(layer.radius, &expected, &found);
        worst.add(error, 1e-8, || format!("{expected:?} wanted, {found:?} found in\n{layer:?}\n{motion:?}"));
    }
    worst.check();
}

/// States that are hard to integrate: fast motion at a medium s, s just above the cap, and a dry gap between wet arcs.
#[test]
fn hard_states_agree() {
    let [edges, arc] = [PressureShear::WithEdges, PressureShear::WithinArc];
    let rough =
        [(4, 6.614172759811441e-6, 1.3698508924117814), (2, -2.990076213194169e-6, -2.3640403161793757)];
    // eta_0, alpha, s_cap, R, C, L and h_L; y, z, their rates, w_1, w_2 and the profile angle.
    let states = [
        (
            [0.0678648636660243, 1.317155509956678e-8, 0.8668393785882291, 0.04272763513675147],
            [1.166574183379467e-4, 0.010070759271973635, 2.563932889914819e-4],
            [-1.1531544660742153e-4, -2.5718804079193023e-6, 0.5785911137689179, 0.6870424947571518],
            [-87.94196327381212, 374.4471524155524, 0.0],
            (edges, &rough[..0]),
        ),
        (
            [0.013390211230451471, 1.4397352125047614e-10, 0.5080601006589603, 0.024132024525330923],
            [4.4728911487399917e-4, 0.0027135410298076623, 1.3988389912190955e-5],
            [1.544589393661845e-4, 4.194025269764762e-4, -5.99975280038733e-4, -3.5580553711804383e-4],
            [213.37012385307185, 360.91176539631624, 0.0],
            (arc, &rough[..0]),
        ),
        (
            [0.11001747427589928, 6.550351196019773e-9, 0.5078027019122577, 0.058681638073229604],
            [6.614698656788578e-5, 0.012215335018847818, 8.308737148144283e-5],
            [-8.027826878503487e-7, 1.0848601511254097e-5, -1.5376018376811861e-3, -1.1378057667772574e-4],
            [-541.3289179534413, 890.6231783651185, 2.624275775705417],
            (edges, &rough[..]),
        ),
    ];
    for (oil, [clearance, width, thickness], [y, z, vy, vz], [w1, w2, profile_angle], (shear, rough)) in
        states
    {
        let [viscosity, pressure_viscosity, cap, radius] = oil;
        let harmonic = |&(order, amplitude, phase)| Harmonic { order, amplitude, phase };
        let roundness = rough.iter().map(harmonic).collect();
        let layer = LubricantLayer {
            viscosity,
            pressure_viscosity,
            cap,
            radius,
            clearance,
            width,
            thickness,
            pressure_shear: shear,
            roundness,
            profile_on_journal: true,
        };
        let motion = JournalMotion {
            position: [y, z],
            velocity: [vy, vz],
            journal_speed: w1,
            bush_speed: w2,
            profile_angle,
            profile_speed: w2,
        };
        let (expected, _) = Reference::new(&layer, &motion).force();
        let error = error(radius, &expected, &layer.force(&motion, Fluid::SAME).expect("a film"));
        assert!(error <= 1e-9, "{error:e} in\n{layer:?}\n{motion:?}");
    }
}

/// Force of a bearing of two lands, and its moment, over random states.
fn compare_short_bearings(seed: u64, count: usize, tolerance: f64, rough: bool) {
    let (mut random, mut worst) = (Random::new(seed), Worst::default());
    for _ in 0..count {
        let clearance = logarithmic(&mut random, 50e-6, 500e-6);
        let gap = clearance * logarithmic(&mut random, 1e-3, 1.0);
        let roundness = if rough { random_roundness(&mut random, gap) } else { Vec::new() };
        let land = LubricantLayer { roundness, ..filled(&mut random, clearance) };
        let motion = random_motion(&mut random, clearance - gap);
        let squeeze = random.chance(0.8);
        let bearing = short_bearing(&land, squeeze);
        let found = bearing.force(&motion, Fluid::SAME).expect("a film");
        let still = JournalMotion { velocity: [0.0; 2], profile_speed: 0.0, ..motion };
        let (land_force, _) = Reference::new(&land, if squeeze { &motion } else { &still }).force();
        let eps = size(motion.position) / clearance;
        let sliding = land.radius * (motion.journal_speed - motion.bush_speed);
        let drag = 4.0 * PI * land.viscosity * sliding * land.radius * land.width / clearance;
        let expected = FilmForce {
            pressure: land_force.pressure.map(|f| 2.0 * f),
            shear: [0.0; 2],
            moment: -drag * land.radius / (1.0 - eps * eps).sqrt(),
            ..land_force
        };
        let error = error(land.radius, &expected, &found);
        worst.add(error, tolerance, || {
            format!("{expected:?} wanted, {found:?} found in\n{bearing:?}\n{motion:?}")
        });
    }
    worst.check();
}

#[test]
fn round_short_bearing_agrees() {
    compare_short_bearings(3, 300, 1e-9, false);
}

#[test]
fn rough_short_bearing_agrees() {
    compare_short_bearings(4, 100, 1e-6, true);
}

/// Flooded, isoviscous: Int p over half the circle is elementary, for a turning journal (Ocvirk) and for one that
/// moves straight to the wall or away from it.
#[test]
fn closed_forms() {
    let mut random = Random::new(5);
    for eps in (1..=9).map(|i| f64::from(i) / 10.0) {
        let clearance = 2e-4;
        let layer = filled(&mut random, clearance);
        let (r, e) = (layer.radius, eps * clearance);
        let (direction, v) = (random.around_zero(PI), random.within(1e-3, 1.0));
        let (sin, cos) = direction.sin_cos();
        let [journal_speed, bush_speed] = [random.around_zero(1000.0), random.around_zero(1000.0)];
        let gap = 1.0 - eps * eps;
        let scale = layer.viscosity * r * layer.width.powi(3) / clearance.powi(2);
        let motion = |v: f64, [journal_speed, bush_speed]: [f64; 2]| JournalMotion {
            position: [e * cos, e * sin],
            velocity: [v * cos, v * sin],
            journal_speed,
            bush_speed,
            profile_angle: 0.0,
            profile_speed: 0.0,
        };

        let turning = journal_speed + bush_speed;
        let out = -scale * turning.abs() * eps * eps / (gap * gap);
        let around = scale * turning * PI / 4.0 * eps / gap.powf(1.5);
        let drag = 2.0 * PI * layer.viscosity * r.powi(3) * layer.width / (clearance * gap.sqrt());
        let moment = -drag * (journal_speed - bush_speed) - e * around / 2.0;
        // Towards the wall the thin half carries, away from it the thick half.
        let squeeze = |eps: f64| {
            let arc = (FRAC_PI_2 + eps.asin()) / gap.sqrt();
            -scale * (v / clearance) * ((1.0 + 2.0 * eps * eps) * arc + 3.0 * eps) / (gap * gap)
        };
        for (motion, out, around, moment) in [
            (motion(0.0, [journal_speed, bush_speed]), out, around, moment),
            (motion(v, [0.0, 0.0]), squeeze(eps), 0.0, 0.0),
            (motion(-v, [0.0, 0.0]), -squeeze(-eps), 0.0, 0.0),
        ] {
            let pressure = [out * cos - around * sin, out * sin + around * cos];
            let found = layer.force(&motion, Fluid::SAME).expect("a film");
            for (name, f) in [("reference", Reference::new(&layer, &motion).force().0), ("layer", found)] {
                let worst = apart(f.pressure, pressure) / size(pressure);
                let moment = (f.moment - moment).abs() / (r * size(pressure)).max(moment.abs());
                assert!(worst <= 1e-12, "{name}, eps {eps}: {:?}, closed form {pressure:?}", f.pressure);
                assert!(moment <= 1e-12, "{name}, eps {eps}: {} N m, off by {moment:e}", f.moment);
            }
            let found = short_bearing(&layer, true).force(&motion, Fluid::SAME).expect("a film").pressure;
            let twice = pressure.map(|f| 2.0 * f);
            let worst = apart(found, twice) / size(twice);
            assert!(worst <= 1e-12, "short bearing, eps {eps}: {found:?}, closed form {twice:?}");
        }
    }
}
