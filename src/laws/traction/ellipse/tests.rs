use super::*;
use crate::scalar::Dual;

const STEEL: f64 = 46.0 * 7830.0 * 460.0;

fn law(strips: usize, places: usize) -> EllipseTraction {
    let heating = SelfHeating {
        temperature_viscosity: 0.04,
        conductivity: 0.13,
        eyring_stress: 5e6,
        thermal_product_1: STEEL,
        thermal_product_2: STEEL,
        acts: 1.0,
    };
    EllipseTraction {
        rule: EllipseRule::new(strips, places),
        temperature_rule: EllipseRule::new(strips, places),
        ln_time: (0.03_f64 / 5e6).ln(),
        pressure_viscosity: 2e-8,
        eyring_stress: 5e6,
        shear_modulus: 3e8,
        pressed_radius: 11.37e-3,
        self_heating: Some(heating),
    }
}

const AXES: [f64; 2] = [2e-3, 0.25e-3];

fn state(film: f64, boundary_share: f64) -> EllipseState<f64> {
    EllipseState {
        pressure: 1.5 * 1500.0 / (PI * AXES[0] * AXES[1]),
        half_axes: AXES,
        film,
        ln_viscosity: 0.0,
        rolling_speed: (32.0_f64 * 32.0 + 1e-12).sqrt(),
        surface_speeds: [31.0, 33.0],
        slip: [0.1, 0.3],
        turning: [50.0, -5000.0, 1300.0],
        boundary_share,
    }
}

fn power(at: &EllipseState<f64>, found: &EllipseFriction<f64>) -> f64 {
    let of_forces: f64 = found.force.iter().zip(at.slip).map(|(f, d)| f * d).sum();
    of_forces + found.couple.iter().zip(at.turning).map(|(m, w)| m * w).sum::<f64>()
}

#[test]
fn an_example_of_an_independent_program() {
    let boundary = SolidFriction { coefficient: 0.1, transition_speed: 0.02 };
    let at = state(0.9e-6, 0.0);
    let found = law(16, 4).friction(&at, Some(&boundary));
    for (found, expected) in found.force.into_iter().chain(found.couple).zip([
        -7.171_064_090_68,
        -38.249_218_046_8,
        -7.309_180_331_47e-4,
        1.529_951_463_99e-4,
        -0.071_038_279_985_7,
    ]) {
        assert!((found / expected - 1.0).abs() < 1e-8, "{found} {expected}");
    }
    assert!((found.temperature_rise / 46.437_698_945_7 - 1.0).abs() < 1e-9, "{}", found.temperature_rise);
    assert!((power(&at, &found) / -105.343_157_438 - 1.0).abs() < 1e-8);

    let mixed = law(16, 4).friction(&state(0.12e-6, 0.052_668_5), Some(&boundary));
    for (found, expected) in mixed.force.into_iter().zip([-8.244_057_284_98, -48.016_432_509]) {
        assert!((found / expected - 1.0).abs() < 2e-7, "{found} {expected}");
    }
}

#[test]
fn it_never_drives_and_vanishes_without_slip() {
    let law = law(16, 2);
    let mut at = state(0.9e-6, 0.3);
    let boundary = SolidFriction { coefficient: 0.1, transition_speed: 0.02 };
    for k in 0..400 {
        let random = |i: usize| (12.9898 * (k * 7 + i) as f64).sin();
        at.slip = [random(0), random(1)];
        at.turning = [100.0 * random(2), 6000.0 * random(3), 2000.0 * random(4)];
        assert!(power(&at, &law.friction(&at, Some(&boundary))) < 0.0);
    }
    (at.slip, at.turning) = ([0.0; 2], [0.0; 3]);
    let still = law.friction(&at, Some(&boundary));
    assert_eq!((still.force, still.couple), ([0.0; 2], [0.0; 3]));
    assert!(still.secants.first[0] > 0.0 && still.temperature_rise.abs() < 1e-12);
}

#[test]
fn one_uniform_strip_is_a_line_contact() {
    use crate::laws::film::thickness::Entrainment;
    use crate::laws::traction::muraki_kimura::Traction;
    let mut one = law(1, 2);
    one.self_heating = None;
    let at = EllipseState { slip: [0.4, 0.0], turning: [0.0; 3], ..state(0.9e-6, 0.0) };
    let line = Traction::new(0.03, 2e-8, 5e6, 3e8);
    let e = Entrainment { slip: 0.4, ln_slip: 0.4_f64.ln(), ..Entrainment::new(32.2, 31.8, 0.0) };
    let shear = line.shear_state(0.25 * PI * at.pressure, at.film, at.film.ln(), AXES[1], &e);
    // One strip of the rule has the width pi/2 a.
    let expected = -5e6 * shear.mean_shear(0.0).stress * 2.0 * AXES[1] * 0.5 * PI * AXES[0];
    let found = one.friction::<f64, f64>(&at, None).force[0];
    assert!((found / expected - 1.0).abs() < 1e-10, "{found} {expected}");
}

#[test]
fn derivatives_are_those_of_the_values() {
    let law = law(16, 2);
    let boundary = SolidFriction { coefficient: 0.1, transition_speed: 0.02 };
    let at = |x: [f64; 6]| {
        let mut at = state(0.9e-6 * x[5], 0.01);
        at.slip = [x[0], x[1]];
        at.turning = [x[2], x[3], x[4]];
        at
    };
    let x = [0.1, 0.3, 50.0, -5000.0, 1300.0, 1.0];
    let dual = |k: usize| Dual::<6>::variable(x[k], k);
    let constant = |value: f64| Dual::<6>::lift(value);
    let plain = at(x);
    let varied = EllipseState {
        pressure: constant(plain.pressure),
        half_axes: AXES.map(constant),
        film: dual(5) * 0.9e-6,
        ln_viscosity: constant(0.0),
        rolling_speed: constant(plain.rolling_speed),
        surface_speeds: [31.0, 33.0].map(constant),
        slip: [dual(0), dual(1)],
        turning: [dual(2), dual(3), dual(4)],
        boundary_share: constant(0.01),
    };
    let exact = law.friction(&varied, Some(&boundary));
    let values = |x: [f64; 6]| {
        let found = law.friction(&at(x), Some(&boundary));
        [
            found.force[0],
            found.force[1],
            found.couple[0],
            found.couple[1],
            found.couple[2],
            found.temperature_rise,
        ]
    };
    let [f0, f1] = exact.force;
    let [m0, m1, m2] = exact.couple;
    for k in 0..6 {
        let h = 1e-5 * x[k];
        let moved = |s: f64| {
            let mut x = x;
            x[k] += s * h;
            values(x)
        };
        let (before, after) = (moved(-1.0), moved(1.0));
        for (i, exact) in [f0, f1, m0, m1, m2, exact.temperature_rise].into_iter().enumerate() {
            let difference = (after[i] - before[i]) / (2.0 * h);
            let size = values(x)[i].abs() / x[k].abs();
            assert!(
                (exact.eps[k] - difference).abs() < 1e-6 * size,
                "{i} {k}: {} {difference}",
                exact.eps[k]
            );
        }
    }
}
