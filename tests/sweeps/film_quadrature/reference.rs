//! The reference: every film force by quadrature over the angle and the width.

use cagedyn::laws::guide::journal::{FilmForce, JournalMotion};
use cagedyn::laws::guide::lubricant_layer::{LubricantLayer, PressureShear};
use std::f64::consts::PI;

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

/// Places of a sum around the circle.
const PLACES: u32 = 100_000;

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

/// How far a film goes around its circumference.
pub struct Extremes {
    /// Largest alpha q.
    pub thickening: f64,
    /// Smallest thickness, m.
    pub film: f64,
}

/// A film to integrate. Angles d are counted from the direction of the eccentricity.
pub struct Reference<'a> {
    layer: &'a LubricantLayer,
    motion: &'a JournalMotion<f64>,
    eccentricity: f64,
    direction: f64,
    along: Vec<(f64, f64)>,
    across: Vec<(f64, f64)>,
    across_thick: Vec<(f64, f64)>,
}

impl<'a> Reference<'a> {
    pub fn new(layer: &'a LubricantLayer, motion: &'a JournalMotion<f64>) -> Self {
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

    /// Int dth/h, 1/m, as a sum over so many places that it is exact for films of a thousandth of the clearance.
    pub fn inverse_gap(&self) -> f64 {
        let width = 2.0 * PI / f64::from(PLACES);
        (0..PLACES).map(|i| width / self.section((f64::from(i) + 0.5) * width).film[0]).sum()
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
        let turns = self.layer.profile_on_journal;
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

    /// Film force, and how far the film goes.
    pub fn force(&self) -> (FilmForce<f64>, Extremes) {
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
        let thickening = wet.map(|s| self.thickening(s)).fold(0.0, f64::max);
        let film = sections.iter().map(|s| s.film[0]).fold(f64::INFINITY, f64::min);
        let [py, pz, sy, sz, moment] = sums;
        (FilmForce { pressure: [py, pz], shear: [sy, sz], moment }, Extremes { thickening, film })
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
