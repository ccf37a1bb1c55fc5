//! Film forces of the cage guide against a brute-force quadrature over the angle and the width of the film.
//!
//! The reference integrates the pressure and the stress of the Reynolds film point by point, from the gap, the
//! pressure-viscosity law and nothing else: no closed integral over the width, no integration by parts.

mod reference;

use crate::common::Random;
use cagedyn::laws::fluid::Fluid;
use cagedyn::laws::guide::journal::{FilmForce, Harmonic, JournalMotion};
use cagedyn::laws::guide::lubricant_layer::{LubricantLayer, PressureShear};
use cagedyn::laws::guide::short_bearing::ShortBearing;
use reference::Reference;
use std::f64::consts::{FRAC_PI_2, PI};

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
        thickener: None,
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
        let (expected, extremes) = Reference::new(&layer, &motion).force();
        over_cap += usize::from(extremes.thickening > layer.cap);
        far_over += usize::from(extremes.thickening > 1e3);
        flooded += usize::from(layer.thickness > layer.clearance + e);
        thin += usize::from(extremes.film < 1e-6);
        let found = layer.force(&motion, Fluid::SAME).expect("a film");
        let error = error(layer.radius, &expected, &found);
        let film = layer.minimum(&motion);
        let off = (film / extremes.film - 1.0).abs();
        assert!(off <= 1e-9, "{film} for {} m in\n{layer:?}\n{motion:?}", extremes.film);
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
            thickener: None,
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
        let sliding = land.radius * (motion.journal_speed - motion.bush_speed);
        let drag = 2.0 * land.viscosity * sliding * land.radius * land.width;
        let expected = FilmForce {
            pressure: land_force.pressure.map(|f| 2.0 * f),
            shear: [0.0; 2],
            moment: -drag * land.radius * Reference::new(&land, &motion).inverse_gap(),
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
