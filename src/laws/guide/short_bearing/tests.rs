use super::*;
use crate::laws::guide::journal::tests::motion;
use crate::scalar::Dual;

fn bearing() -> ShortBearing {
    ShortBearing {
        viscosity: 0.06,
        radius: 44.7775e-3,
        clearance: 0.2225e-3,
        land_width: 7e-3,
        squeeze: true,
        pressure_moment: false,
        roundness: Vec::new(),
        profile_on_journal: true,
    }
}

/// Force of one land in units of eta R l^3 w / c^2, along and across the eccentricity (+y).
fn ocvirk(eps: f64) -> [f64; 2] {
    let b = bearing();
    let f = b.force(&motion([eps * b.clearance, 0.0], [0.0; 2], 100.0), Fluid::SAME).unwrap().force();
    let scale = b.viscosity * b.radius * b.land_width.powi(3) * 100.0 / b.clearance.powi(2);
    f.map(|f| f / 2.0 / scale)
}

#[test]
fn ocvirk_closed_forms() {
    for (eps, f_e, f_phi) in [
        (0.1, -0.010203, 0.079733),
        (0.3, -0.108683, 0.271425),
        (0.5, -0.444444, 0.604600),
        (0.7, -1.883891, 1.509498),
        (0.9, -22.437673, 8.534970),
    ] {
        let f = ocvirk(eps);
        assert!((f[0] - f_e).abs() < 1e-6 && (f[1] - f_phi).abs() < 1e-6, "eps {eps}: {f:?}");
        let exact = [-eps * eps / (1.0 - eps * eps).powi(2), PI * eps / (4.0 * (1.0 - eps * eps).powf(1.5))];
        assert!((f[0] / exact[0] - 1.0).abs() < 1e-12 && (f[1] / exact[1] - 1.0).abs() < 1e-12);
    }
}

#[test]
fn squeeze_factors() {
    // Pure approach with the Guembel cut, in units of eta R l^3 eps_dot / c^2 (one land, anchors to 8 digits).
    for (eps, factor) in [(0.2, -2.770609), (0.5, -9.115731), (0.8, -91.765030)] {
        let b = bearing();
        let speed = 0.01;
        let f = b.force(&motion([eps * b.clearance, 0.0], [speed, 0.0], 0.0), Fluid::SAME).unwrap().force();
        let scale = 2.0 * b.viscosity * b.radius * b.land_width.powi(3) * speed / b.clearance.powi(3);
        assert!((f[0] / scale / factor - 1.0).abs() < 1e-6, "{} {factor}", f[0] / scale);
        assert!(f[1].abs() < 1e-12 * f[0].abs());
    }
}

#[test]
fn half_speed_whirl_has_no_pressure() {
    let b = bearing();
    let e = 0.6 * b.clearance;
    let whirl = |rate: f64| b.force(&motion([e, 0.0], [0.0, e * rate], -100.0), Fluid::SAME).unwrap().force();
    let at_rest = whirl(0.0);
    let half = whirl(-50.0);
    assert!(half[0].hypot(half[1]) < 1e-12 * at_rest[0].hypot(at_rest[1]));
}

/// Plain midpoint quadrature of the defining integral.
fn brute_force(b: &ShortBearing, m: &JournalMotion<f64>, n: usize) -> [f64; 2] {
    let mut sum = [0.0; 2];
    for i in 0..n {
        let th = (i as f64 + 0.5) * TAU / n as f64;
        let (s, c) = th.sin_cos();
        let mut h = b.clearance - m.position[0] * c - m.position[1] * s;
        let mut slope = m.position[0] * s - m.position[1] * c;
        let mut rate = -m.velocity[0] * c - m.velocity[1] * s;
        for a in &b.roundness {
            let n = f64::from(a.order);
            let p = n * (th - m.profile_angle) + a.phase;
            h -= a.amplitude * p.cos();
            slope += a.amplitude * n * p.sin();
            rate -= a.amplitude * n * m.profile_speed * p.sin();
        }
        let g = (0.5 * (m.journal_speed + m.bush_speed) * slope + rate) / h.powi(3);
        if g < 0.0 {
            sum[0] += g * c;
            sum[1] += g * s;
        }
    }
    sum.map(|s| s * TAU / n as f64 * 2.0 * b.viscosity * b.radius * b.land_width.powi(3))
}

#[test]
fn general_motion_matches_brute_force() {
    let mut b = bearing();
    let c = b.clearance;
    let both_turn = |m: JournalMotion<f64>| JournalMotion { bush_speed: 80.0, ..m };
    let motions = [
        motion([0.3 * c, -0.5 * c], [0.01, 0.02], -127.0),
        motion([-0.6 * c, 0.25 * c], [-0.002, 0.001], -127.0),
        motion([0.0, 0.0], [0.01, -0.03], 50.0),
        motion([0.1 * c, 0.9 * c], [0.0, 0.05], 300.0),
        motion([0.5 * c, 0.1 * c], [0.02, -0.04], 0.0),
        both_turn(motion([0.5 * c, 0.1 * c], [0.02, -0.04], 30.0)),
    ];
    let compare = |b: &ShortBearing, tolerance: f64| {
        for m in &motions {
            let (f, x) = (b.force(m, Fluid::SAME).unwrap().force(), brute_force(b, m, 1_000_000));
            let size = x[0].hypot(x[1]);
            let error = (f[0] - x[0]).hypot(f[1] - x[1]) / size;
            assert!(error < tolerance, "{m:?}: {f:?} {x:?}");
        }
    };
    compare(&b, 1e-9);
    b.roundness = vec![
        Harmonic { order: 2, amplitude: 6e-6, phase: 0.4 },
        Harmonic { order: 5, amplitude: -3e-6, phase: 2.0 },
    ];
    compare(&b, 1e-7);
    // A profile of vanishing height must give the round cage.
    b.roundness = vec![Harmonic { order: 3, amplitude: 1e-15, phase: 0.0 }];
    let round = bearing();
    for m in &motions {
        let (f, x) = (b.force(m, Fluid::SAME).unwrap().force(), round.force(m, Fluid::SAME).unwrap().force());
        assert!((f[0] - x[0]).hypot(f[1] - x[1]) < 1e-8 * x[0].hypot(x[1]));
    }
}

#[test]
fn derivatives_match_central_differences() {
    let mut b = bearing();
    let c = b.clearance;
    for profile in [vec![], vec![Harmonic { order: 3, amplitude: 5e-6, phase: 1.0 }]] {
        b.roundness = profile;
        let x = [0.4 * c, -0.3 * c, 0.01, 0.005, 0.7, -120.0, 35.0];
        let build = |x: [f64; 7]| JournalMotion {
            position: [x[0], x[1]],
            velocity: [x[2], x[3]],
            profile_angle: x[4],
            profile_speed: x[5],
            journal_speed: x[5],
            bush_speed: x[6],
        };
        let d: Vec<Dual<7>> = (0..7).map(|i| Dual::variable(x[i], i)).collect();
        let exact = b
            .force(
                &JournalMotion {
                    position: [d[0], d[1]],
                    velocity: [d[2], d[3]],
                    profile_angle: d[4],
                    profile_speed: d[5],
                    journal_speed: d[5],
                    bush_speed: d[6],
                },
                Fluid::SAME,
            )
            .unwrap()
            .force();
        for i in 0..7 {
            let h = [1e-9, 1e-9, 1e-6, 1e-6, 1e-4, 1e-3, 1e-3][i];
            let (mut lo, mut hi) = (x, x);
            lo[i] -= h;
            hi[i] += h;
            let (lo, hi) = (
                b.force(&build(lo), Fluid::SAME).unwrap().force(),
                b.force(&build(hi), Fluid::SAME).unwrap().force(),
            );
            for k in 0..2 {
                let difference = (hi[k] - lo[k]) / (2.0 * h);
                let error = (exact[k].eps[i] - difference).abs();
                let scale = difference.abs() + 1e-7 * exact[k].re.abs() / h;
                assert!(error < 1e-4 * scale, "{k} {i}: {} {difference}", exact[k].eps[i]);
            }
        }
    }
}

#[test]
fn the_smallest_film_of_a_profile_is_found() {
    let mut b = bearing();
    b.roundness = vec![
        Harmonic { order: 3, amplitude: 0.2 * b.clearance, phase: 0.3 },
        Harmonic { order: 7, amplitude: 0.1 * b.clearance, phase: 1.1 },
    ];
    for k in 0..20 {
        let angle = 0.3 * f64::from(k);
        let e = 0.5 * b.clearance;
        let mut m = motion([e * angle.cos(), e * angle.sin()], [0.01, -0.02], 100.0);
        m.profile_angle = 0.7 * f64::from(k);
        let film = |theta: f64| {
            let lobes = b
                .roundness
                .iter()
                .map(|a| a.amplitude * (f64::from(a.order) * (theta - m.profile_angle) + a.phase).cos());
            b.clearance - m.position[0] * theta.cos() - m.position[1] * theta.sin() - lobes.sum::<f64>()
        };
        let scan = (0..200_000).map(|i| film(TAU * f64::from(i) / 200_000.0)).fold(f64::INFINITY, f64::min);
        let found = b.minimum(&m);
        // A scan so dense misses less than a thousandth of a nanometre.
        assert!((found - scan).abs() < 1e-12, "{k}: {found} {scan}");
    }
}

#[test]
fn a_missing_film_is_reported() {
    let mut b = bearing();
    for y in [1.0, 1.5, f64::NAN] {
        assert!(b.force(&motion([y * b.clearance, 0.0], [0.0; 2], 1.0), Fluid::SAME).is_err());
    }
    b.roundness = vec![Harmonic { order: 2, amplitude: 1e-4, phase: 0.0 }];
    assert!(b.force(&motion([0.6 * b.clearance, 0.0], [0.0; 2], 1.0), Fluid::SAME).is_err());
    // The bulge turned away from the narrow side leaves a film.
    let turned = JournalMotion { profile_angle: PI / 2.0, ..motion([0.6 * b.clearance, 0.0], [0.0; 2], 1.0) };
    assert!(b.force(&turned, Fluid::SAME).is_ok());
}

#[test]
fn friction_moment_opposes_rotation() {
    let b = bearing();
    let together = JournalMotion { bush_speed: 100.0, ..motion([0.0; 2], [0.0; 2], 100.0) };
    assert_eq!(b.force(&together, Fluid::SAME).unwrap().moment, 0.0);
    let m = b.force(&motion([0.5 * b.clearance, 0.0], [0.0; 2], 100.0), Fluid::SAME).unwrap().moment;
    let petroff =
        -4.0 * PI * b.viscosity * 100.0 * b.radius.powi(3) * b.land_width / b.clearance / 0.75f64.sqrt();
    assert!((m / petroff - 1.0).abs() < 1e-14);
}

/// An oval bore leaves room beyond the clearance of its mean circle, where the film of round surfaces ends.
#[test]
fn lobes_leave_room_beyond_the_clearance() {
    let mut b = bearing();
    let height = 0.12 * b.clearance;
    b.roundness = vec![Harmonic { order: 2, amplitude: height, phase: PI }];
    let moment = |b: &ShortBearing, eps: f64| {
        let m = JournalMotion { profile_angle: 0.0, ..motion([eps * b.clearance, 0.0], [0.0; 2], 100.0) };
        b.force(&m, Fluid::SAME).map(|force| force.moment)
    };
    for eps in [0.0, 0.5, 0.9, 0.998, 1.0, 1.05, 1.1] {
        let n = 200_000;
        let gap = |d: f64| b.clearance * (1.0 - eps * d.cos()) + height * (2.0 * d).cos();
        let inverse: f64 =
            (0..n).map(|i| TAU / f64::from(n) / gap((f64::from(i) + 0.5) * TAU / f64::from(n))).sum();
        let expected = -2.0 * b.viscosity * 100.0 * b.radius.powi(3) * b.land_width * inverse;
        let found = moment(&b, eps).unwrap();
        assert!((found / expected - 1.0).abs() < 1e-9, "{eps}: {found} {expected}");
    }
    assert!(moment(&b, 1.13).is_err());
    b.roundness[0].amplitude = 1e-15;
    assert!((moment(&b, 0.9).unwrap() / moment(&bearing(), 0.9).unwrap() - 1.0).abs() < 1e-9);
}
