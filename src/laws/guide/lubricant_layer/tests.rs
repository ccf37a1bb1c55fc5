use super::*;
use crate::laws::fluid::grease::Soap;
use crate::laws::guide::journal::tests::motion;
use crate::scalar::Dual;
use std::f64::consts::PI;

const SHEARS: [PressureShear; 3] =
    [PressureShear::Absent, PressureShear::WithinArc, PressureShear::WithEdges];

pub(in crate::laws::guide) fn layer() -> LubricantLayer {
    LubricantLayer {
        viscosity: 0.0924,
        thickener: None,
        pressure_viscosity: 2e-8,
        cap: 0.9,
        radius: 46.6615e-3,
        clearance: 0.2135e-3,
        width: 8e-3,
        thickness: 80e-6,
        pressure_shear: PressureShear::WithinArc,
        roundness: Vec::new(),
        profile_on_journal: true,
    }
}

fn all(f: &FilmForce<f64>) -> [f64; 5] {
    [f.pressure[0], f.pressure[1], f.shear[0], f.shear[1], f.moment]
}

fn size(f: &FilmForce<f64>) -> f64 {
    f.pressure[0].hypot(f.pressure[1]).max(f.shear[0].hypot(f.shear[1]))
}

/// Largest difference of two forces relative to the larger; moments count by their force at R.
fn distance(a: &FilmForce<f64>, b: &FilmForce<f64>) -> f64 {
    let (x, y) = (all(a), all(b));
    let worst =
        x.iter().zip(y).enumerate().map(|(i, (x, y))| (x - y).abs() / if i == 4 { 0.0466615 } else { 1.0 });
    worst.fold(0.0, f64::max) / size(a).max(size(b))
}

#[test]
fn closed_forms_of_the_flooded_isoviscous_film() {
    let l = LubricantLayer { pressure_viscosity: 0.0, thickness: 1e-3, ..layer() };
    let c = l.clearance;
    let unit = l.viscosity * l.radius * l.width.powi(3) / c.powi(2);
    for eps in [0.1f64, 0.3, 0.5, 0.7, 0.9] {
        let q2 = 1.0 - eps * eps;
        let f = l.force(&motion([eps * c, 0.0], [0.0; 2], 100.0), Fluid::SAME).unwrap().pressure;
        let exact = [-eps * eps / q2.powi(2), PI * eps / (4.0 * q2.powf(1.5))].map(|x| x * unit * 100.0);
        assert!((f[0] / exact[0] - 1.0).abs() < 1e-12 && (f[1] / exact[1] - 1.0).abs() < 1e-12, "{f:?}");
        // Pure approach: the half circle towards the thin side carries.
        let f = l.force(&motion([eps * c, 0.0], [0.1 * c, 0.0], 0.0), Fluid::SAME).unwrap().pressure;
        let i_cc = ((-eps).acos() * (1.0 + 2.0 * eps * eps) + 3.0 * eps * q2.sqrt()) / q2.powf(2.5);
        assert!((f[0] / (-0.1 * i_cc * unit) - 1.0).abs() < 1e-12, "{f:?}");
    }
}

#[test]
fn half_speed_whirl_builds_no_pressure() {
    let l = layer();
    let e = 150e-6;
    let f = l.force(&motion([e, 0.0], [0.0, e * 71.25], 142.5), Fluid::SAME).unwrap();
    assert!(f.pressure[0].abs() + f.pressure[1].abs() < 1e-12 && f.shear[1] < 0.0);
}

#[test]
fn continuity() {
    let l = layer();
    let m = motion([190e-6, 20e-6], [0.02, -0.1], 142.5);
    let zero = LubricantLayer { pressure_viscosity: 0.0, ..layer() }.force(&m, Fluid::SAME).unwrap();
    let tiny = LubricantLayer { pressure_viscosity: 1e-14, ..layer() }.force(&m, Fluid::SAME).unwrap();
    assert!(distance(&zero, &tiny) < 1e-5);
    // The force starts as the square root of the immersion.
    let touch = l.clearance - l.thickness;
    let [dry, wet] = [-1e-12, 1e-12].map(|share| motion([touch * (1.0 + share), 0.0], [0.02, -0.1], 142.5));
    assert!((l.minimum(&dry) - l.minimum(&wet)).abs() < 1e-14);
    let [dry, wet] = [dry, wet].map(|m| l.force(&m, Fluid::SAME).unwrap());
    assert!(all(&dry) == [0.0; 5] && size(&wet) < 1e-3);
    // Flooding.
    for pressure_shear in SHEARS {
        let at = |thickness| {
            LubricantLayer { thickness, pressure_shear, ..layer() }.force(&m, Fluid::SAME).unwrap()
        };
        let widest = l.clearance + 190e-6f64.hypot(20e-6);
        assert!(distance(&at(widest * (1.0 - 1e-12)), &at(widest * (1.0 + 1e-12))) < 1e-5);
    }
    // The place where the cap is reached.
    let steps: Vec<_> = (0..400)
        .map(|i| {
            l.force(&motion([205e-6, 0.0], [1e-4 + 5e-7 * f64::from(i), 0.01], 142.5), Fluid::SAME).unwrap()
        })
        .collect();
    assert!(steps.windows(2).all(|p| distance(&p[0], &p[1]) < 0.02));
}

#[test]
fn approach_is_resisted() {
    for (e, v) in [(140e-6, 0.01), (200e-6, 0.5), (213.4e-6, 1.0), (213.4e-6, -1.0)] {
        let f = layer().force(&motion([e, 0.0], [v, 0.0], 0.0), Fluid::SAME).unwrap().force();
        assert!(f[0].is_finite() && f[0] * v <= 0.0, "{e} {v}: {f:?}");
    }
}

#[test]
fn symmetries() {
    let profile = vec![Harmonic { order: 3, amplitude: 2e-6, phase: 0.0 }];
    for roundness in [vec![], profile] {
        let l = LubricantLayer { roundness, ..layer() };
        let m = motion([120e-6, 130e-6], [0.02, -0.1], 142.5);
        let f = l.force(&m, Fluid::SAME).unwrap();
        let mirrored =
            JournalMotion { profile_angle: PI - 0.3, ..motion([-120e-6, 130e-6], [-0.02, -0.1], -142.5) };
        // A third harmonic seen in the mirror: n (pi - theta) - n (pi - psi) = -n (theta - psi).
        let g = l.force(&mirrored, Fluid::SAME).unwrap();
        let back = FilmForce {
            pressure: [-g.pressure[0], g.pressure[1]],
            shear: [-g.shear[0], g.shear[1]],
            moment: -g.moment,
        };
        assert!(distance(&f, &back) < 1e-9, "{f:?} {back:?}");
        let (s, c) = 1.1f64.sin_cos();
        let turn = |[y, z]: [f64; 2]| [c * y - s * z, s * y + c * z];
        let turned = motion(turn(m.position), turn(m.velocity), 142.5);
        let g = l.force(&JournalMotion { profile_angle: 1.4, ..turned }, Fluid::SAME).unwrap();
        let expected = FilmForce { pressure: turn(f.pressure), shear: turn(f.shear), ..f };
        assert!(distance(&g, &expected) < 1e-9);
    }
}

#[test]
fn a_vanishing_profile_gives_the_round_force() {
    let rough =
        LubricantLayer { roundness: vec![Harmonic { order: 3, amplitude: 1e-18, phase: 0.0 }], ..layer() };
    for pressure_shear in SHEARS {
        for thickness in [80e-6, 1e-3] {
            for (e, v) in [(134e-6, 0.0), (150e-6, -0.1), (200e-6, 0.01), (210e-6, 0.2)] {
                let m = motion([0.6 * e, 0.8 * e], [v, 0.5 * v - 0.1], 142.5);
                let [a, b] = [&layer(), &rough].map(|l| {
                    LubricantLayer { pressure_shear, thickness, ..l.clone() }.force(&m, Fluid::SAME).unwrap()
                });
                assert!(distance(&a, &b) < 1e-8, "{e} {v} {a:?} {b:?}");
            }
        }
    }
}

#[test]
fn derivatives_match_central_differences() {
    let profile = vec![Harmonic { order: 3, amplitude: 2e-6, phase: 1.0 }];
    for roundness in [vec![], profile] {
        for pressure_shear in SHEARS {
            let l = LubricantLayer { roundness: roundness.clone(), pressure_shear, ..layer() };
            for (e, v) in [(160e-6, -0.05), (206e-6, 0.1)] {
                let x = [0.6 * e, -0.8 * e, v, -1.1 * v, 0.7, 120.0, 35.0];
                fn build<T: Real>(x: [T; 7]) -> JournalMotion<T> {
                    JournalMotion {
                        position: [x[0], x[1]],
                        velocity: [x[2], x[3]],
                        profile_angle: x[4],
                        profile_speed: x[5],
                        journal_speed: x[5],
                        bush_speed: x[6],
                    }
                }
                let d = l
                    .force(&build(std::array::from_fn(|i| Dual::<7>::variable(x[i], i))), Fluid::SAME)
                    .unwrap();
                let exact = [d.pressure[0], d.pressure[1], d.shear[0], d.shear[1], d.moment / l.radius];
                let scale = size(&l.force(&build(x), Fluid::SAME).unwrap());
                for i in 0..7 {
                    let h = [2e-10, 2e-10, 1e-6, 1e-6, 1e-5, 1e-3, 1e-3][i];
                    let [lo, hi] = [-h, h].map(|h| {
                        let mut x = x;
                        x[i] += h;
                        let mut f = all(&l.force(&build(x), Fluid::SAME).unwrap());
                        f[4] /= l.radius;
                        f
                    });
                    for k in 0..5 {
                        let difference = (hi[k] - lo[k]) / (2.0 * h);
                        let error = (exact[k].eps[i] - difference).abs();
                        let allowed = 1e-4 * difference.abs() + 1e-9 * scale / h;
                        assert!(error < allowed, "{e} {k} {i}: {} {difference}", exact[k].eps[i]);
                    }
                }
            }
        }
    }
}

#[test]
fn a_missing_film_is_reported_and_nan_ends() {
    let mut l = layer();
    for roundness in [vec![], vec![Harmonic { order: 2, amplitude: 1e-6, phase: 0.0 }]] {
        l.roundness = roundness;
        for y in [1.02, 1.5, f64::NAN, f64::INFINITY] {
            assert!(l.force(&motion([y * l.clearance, 0.0], [0.0; 2], 1.0), Fluid::SAME).is_err());
        }
        for v in [f64::NAN, f64::INFINITY] {
            let ended = l.force(&motion([0.9 * l.clearance, 0.0], [v, 0.0], 1.0), Fluid::SAME);
            assert!(ended.is_err() || ended.is_ok_and(|f| !size(&f).is_finite() || f.moment.is_nan()));
        }
    }
}

#[test]
fn all_instructions_give_the_same_bits_and_derivatives_the_same_values() {
    let profile = vec![
        Harmonic { order: 7, amplitude: 1e-6, phase: 1.0 },
        Harmonic { order: 3, amplitude: -2e-6, phase: 0.2 },
    ];
    let mut all = vec![Arch::new()];
    #[cfg(target_arch = "x86_64")]
    all.extend(pulp::x86::V3::try_new().map(Arch::V3));
    let bits = |f: &FilmForce<f64>| self::all(f).map(f64::to_bits);
    let soap = Soap {
        yield_stress: 300.0,
        yield_time: 1.0,
        consistency: 20.0,
        exponent: 0.4,
        lowest_shear_rate: 100.0,
        reference_temperature: 298.0,
        halving: 30.0,
        base_viscosity: 0.0924,
    };
    let kinds = [vec![], profile]
        .map(|roundness| [None, Some(Thickener::Soap(soap))].map(|t| (roundness.clone(), t)));
    for (roundness, thickener) in kinds.into_iter().flatten() {
        for i in 0..100 {
            let (e, v) = (100e-6 + f64::from(i) * 1.09e-6, 0.3 * (f64::from(i) * 0.7).sin());
            let l = LubricantLayer { roundness: roundness.clone(), thickener, ..layer() };
            let m = motion([0.6 * e, -0.8 * e], [v, -1.1 * v], 142.5);
            let m = JournalMotion { profile_angle: 0.37 * f64::from(i), ..m };
            let portable = l.film(Fluid::SAME, Arch::Scalar).force(&m).unwrap();
            for instructions in &all {
                assert_eq!(bits(&l.film(Fluid::SAME, *instructions).force(&m).unwrap()), bits(&portable));
            }
            let varied = JournalMotion {
                position: m.position.map(|x| Dual::<1>::variable(x, 0)),
                velocity: m.velocity.map(Dual::constant),
                journal_speed: Dual::constant(m.journal_speed),
                bush_speed: Dual::constant(m.bush_speed),
                profile_angle: Dual::constant(m.profile_angle),
                profile_speed: Dual::constant(m.profile_speed),
            };
            let d = l.force(&varied, Fluid::SAME).unwrap();
            assert_eq!(
                [d.pressure[0].re, d.shear[1].re, d.moment.re],
                [portable.pressure[0], portable.shear[1], portable.moment]
            );
        }
    }
}
