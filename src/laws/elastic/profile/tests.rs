//! Slices against the straight contact, closed forms, brute force, differences.

use super::*;
use crate::laws::contact_pair::{ContactForce, ContactMotion};
use crate::laws::line_contact::LineContact;
use crate::laws::line_contact::tests::raceway;
use crate::scalar::{Dual, Real};

const LENGTH: f64 = 20.4e-3;
const HALF: f64 = 0.5 * LENGTH;

/// Drop of a logarithm, A in m.
fn logarithm(scale: f64, crowned_share: f64, end_drop: Option<f64>) -> Option<Logarithm> {
    Some(Logarithm::new(scale, LENGTH, crowned_share, end_drop))
}

/// Profiles of every kind, with their drop written down anew.
#[expect(clippy::type_complexity, reason = "a list of cases")]
pub(crate) fn profiles(slices: usize) -> Vec<(&'static str, Profile, Box<dyn Fn(f64) -> f64>)> {
    let log = |a: f64, k2: f64, z: f64| {
        move |s: f64| {
            let x = (s - (1.0 - k2) * HALF).max(0.0) / (k2 * HALF);
            a * (1.0 / (1.0 - (1.0 - (-z / a).exp()) * x * x)).ln()
        }
    };
    let crown = |r: f64| move |s: f64| r - (r * r - s * s).sqrt();
    let new = |logarithm, radii| Profile::new(LENGTH, logarithm, radii, slices).unwrap();
    let some = logarithm(1.5e-6, 0.6, Some(12e-6));
    let steep = logarithm(0.5e-6, 0.3, Some(20e-6));
    let mixed = (log(1.5e-6, 0.6, 12e-6), crown(2.0), crown(9.0));
    vec![
        ("logarithm", new(some, [None, None]), Box::new(log(1.5e-6, 0.6, 12e-6))),
        ("steep logarithm", new(steep, [None, None]), Box::new(log(0.5e-6, 0.3, 20e-6))),
        (
            "logarithm without limit",
            new(logarithm(1.5e-6, 1.0, None), [None, None]),
            Box::new(log(1.5e-6, 1.0, f64::INFINITY)),
        ),
        ("crown", new(None, [Some(2.0), None]), Box::new(crown(2.0))),
        ("crown of the raceway", new(None, [None, Some(0.7)]), Box::new(crown(0.7))),
        ("all", new(some, [Some(2.0), Some(9.0)]), Box::new(move |s| mixed.0(s) + mixed.1(s) + mixed.2(s))),
    ]
}

/// Approaches from a nanometre to deeper than the profiles.
fn approaches() -> impl Iterator<Item = f64> {
    (0..60).map(|i| 1e-9 * 10f64.powf(f64::from(i) / 13.0))
}

/// Where the drop is `depth`, by bisection.
fn edge_of(drop: &dyn Fn(f64) -> f64, depth: f64) -> f64 {
    let (mut low, mut high) = (0.0, HALF);
    if drop(HALF) <= depth {
        return HALF;
    }
    for _ in 0..80 {
        let middle = 0.5 * (low + high);
        if drop(middle) < depth { low = middle } else { high = middle }
    }
    low
}

#[test]
fn rules_integrate_polynomials() {
    for (n, rule) in (1..).zip(RULES.iter()) {
        assert_eq!(rule.len(), n);
        // Int (1 - s)^p over (0, 1) with 1 - s = (1 - u)^2: polynomials of degree 2 p + 1.
        for p in 0..n {
            let sum: f64 = rule.iter().map(|node| node.weight * (1.0 - node.place).powi(p as i32)).sum();
            assert!((sum * (p + 1) as f64 - 1.0).abs() < 1e-13, "{n} {p}: {sum}");
        }
        assert!(rule.windows(2).all(|pair| pair[0].place < pair[1].place));
    }
}

#[test]
fn edges_are_where_the_drop_is_the_approach() {
    for (name, profile, drop) in profiles(8) {
        for depth in approaches() {
            let (edge, expected) = (profile.edge(depth), edge_of(&*drop, depth));
            // The formula of the circle loses digits of small drops.
            assert!((edge / expected - 1.0).abs() < 2e-6, "{name} {depth:e}: {edge:e} {expected:e}");
            if edge < HALF {
                // Steep ends magnify the round-off of the edge.
                let exact = 1e-9 + 1e-15 * (depth / 0.5e-6).exp();
                assert!((profile.drop(edge, false) / depth - 1.0).abs() < exact, "{name} {depth:e}");
                let slope = profile.edge(Dual::<1>::variable(depth, 0)).eps[0];
                assert!((slope * profile.slope(edge) - 1.0).abs() < 1e3 * exact, "{name} {depth:e}");
            }
        }
    }
}

/// Load at this approach relative to that of a straight contact, by a midpoint rule that resolves the edge.
fn reference(drop: &dyn Fn(f64) -> f64, delta: f64) -> f64 {
    let (edge, n) = (edge_of(drop, delta), 40_000);
    let sum: f64 = (0..n)
        .map(|i| (f64::from(i) + 0.5) / f64::from(n))
        // s = edge (1 - v^3) puts them where it is steep.
        .map(|v| (1.0 - drop(edge * (1.0 - v * v * v)) / delta).max(0.0).powf(10.0 / 9.0) * 3.0 * v * v)
        .sum();
    sum / f64::from(n) * edge / HALF
}

#[test]
fn sums_converge_to_a_reference_that_resolves_the_edge() {
    let mut table = String::new();
    for (n, allowed) in [(4, 6e-4), (8, 3e-5), (16, 2e-6), (32, 2e-6)] {
        for (name, profile, drop) in profiles(n) {
            let law = LineContact { profile: Some(profile), damping: None, ..raceway() };
            let mut largest = 0.0f64;
            for i in 0..21 {
                let delta = 2e-6 + 0.5e-6 * f64::from(i);
                let motion = ContactMotion { delta, delta_dot: 0.0, u1: 6.0, u2: 6.0 };
                let share = law.force(&motion, 0.0, 0.0).normal / law.elastic.load(delta);
                largest = largest.max((share / reference(&*drop, delta) - 1.0).abs());
            }
            table += &format!("{name}, {n} slices: {largest:.0e}\n");
            assert!(largest < allowed, "{name} {n}: {largest:e}");
        }
    }
    println!("{table}");
}

fn motions() -> impl Iterator<Item = ContactMotion<f64>> {
    approaches().enumerate().map(|(i, delta)| {
        let i = i as f64;
        let u1 = 6.05 - 0.3 * i;
        ContactMotion { delta, delta_dot: 1e-3 * (i % 7.0 - 3.0), u1, u2: u1 + 0.01 * (i % 5.0 - 1.7) }
    })
}

fn numbers<T: Copy>(f: &ContactForce<T>) -> [T; 10] {
    [
        f.normal,
        f.stiffness,
        f.damping,
        f.film,
        f.film_ratio,
        f.temperature_rise,
        f.friction_coefficient,
        f.friction,
        f.friction_secant,
        f.rolling_resistance,
    ]
}

#[test]
fn a_straight_contact_in_slices_is_the_contact_as_a_whole() {
    let straight = raceway();
    for slices in [2, 4, 8, 32] {
        let flat = Profile::new(LENGTH, None, [Some(f64::INFINITY), Some(f64::INFINITY)], slices);
        let law = LineContact { profile: flat, ..straight };
        for motion in motions() {
            let [a, b] = [law, straight].map(|law| numbers(&law.force(&motion, 0.1, 0.0)));
            for (a, b) in a.iter().zip(&b) {
                assert!((a - b).abs() <= 4e-15 * b.abs(), "{motion:?}: {a} {b}");
            }
            let [a, b] = [law, straight].map(|law| law.rest_at(motion.delta));
            assert!((a[0] / b[0] - 1.0).abs() < 4e-15 && (a[1] / b[1] - 1.0).abs() < 4e-15);
        }
    }
    assert!(Profile::new(LENGTH, None, [None, None], 8).is_none());
}

#[test]
fn exact_derivatives_match_differences() {
    for (name, profile, _) in profiles(8) {
        let law = LineContact { profile: Some(profile), ..raceway() };
        for motion in motions() {
            let x = [motion.delta, motion.delta_dot, motion.u1, motion.u2];
            let at = |x: [f64; 4]| {
                let [delta, delta_dot, u1, u2] = x;
                numbers(&law.force(&ContactMotion { delta, delta_dot, u1, u2 }, 0.0, 0.0))
            };
            let d: Vec<Dual<4>> = (0..4).map(|i| Dual::variable(x[i], i)).collect();
            let varied = ContactMotion { delta: d[0], delta_dot: d[1], u1: d[2], u2: d[3] };
            let exact = numbers(&law.force(&varied, Dual::constant(0.0), Dual::constant(0.0)));
            let value = at(x);
            for i in 0..4 {
                let h = [1e-5 * x[0], 1e-7, 1e-6, 1e-6][i];
                let moved = |offset: f64| {
                    let mut moved = x;
                    moved[i] += offset * h;
                    at(moved)
                };
                let [far_low, low, high, far_high] = [-2.0, -1.0, 1.0, 2.0].map(moved);
                // Normal force, friction, rolling resistance: what has derivatives.
                for k in [0, 7, 9] {
                    let wide = (far_high[k] - far_low[k]) / (4.0 * h);
                    let difference = (4.0 * (high[k] - low[k]) / (2.0 * h) - wide) / 3.0;
                    let scale = difference.abs().max(1e-4 * value[0] / h).max(wide.abs());
                    // An edge that reaches the end is a kink.
                    let kink = (wide - difference).abs() > 1e-6 * scale;
                    let error = (exact[k].eps[i] - difference).abs() / scale;
                    assert!(error < 1e-6 || kink, "{name} {motion:?} {i} {k}: {error:e}");
                    assert!((exact[k].re - value[k]).abs() <= 1e-14 * value[k].abs());
                }
            }
        }
    }
}

#[test]
fn a_profile_makes_contacts_softer_and_takes_more_power_than_it_gives() {
    for (name, profile, _) in profiles(8) {
        let (law, straight) = (LineContact { profile: Some(profile), ..raceway() }, raceway());
        let mut last = 0.0;
        for motion in motions() {
            let f = law.force(&motion, 0.0, 0.0);
            let whole = straight.force(&motion, 0.0, 0.0);
            assert!(f.normal < whole.normal && f.rolling_resistance.abs() <= whole.rolling_resistance.abs());
            assert!(f.friction * (motion.u1 - motion.u2) <= 0.0, "{name} {motion:?}");
            assert!(f.rolling_resistance * (motion.u1 + motion.u2) <= 0.0, "{name} {motion:?}");
            // Damping takes what the force gives beyond the spring.
            let [elastic, _] = law.rest_at(motion.delta);
            assert!((f.normal - elastic) * motion.delta_dot >= -1e-12 * elastic, "{name} {motion:?}");
            assert!((f.friction_coefficient - f.friction.abs() / f.normal).abs() < 1e-9);
            assert!(elastic > last, "{name} {motion:?}");
            last = elastic;
            // Power laws of the load per length: the middle has that of the straight contact.
            assert!(f.film >= whole.film * (1.0 - 1e-12) && f.film < whole.film * 1.02);
        }
        let apart = ContactMotion { delta: -1e-9, delta_dot: 0.1, u1: 1.0, u2: 2.0 };
        assert_eq!(law.force(&apart, 0.0, 0.0), ContactForce::none(0.0));
        let nowhere = ContactMotion { delta: f64::NAN, ..apart };
        assert!(law.force(&nowhere, 0.0, 0.0).normal.is_nan());
    }
}

#[test]
fn the_scale_of_a_logarithm_is_lundbergs() {
    // 2 Q (1 - nu^2)/(pi l E): 10.88 kN on 20.4 mm of steel.
    let modulus = 206e9 / (1.0 - 0.3 * 0.3);
    let scale = Logarithm::scale_of(10_880.0, 1.0, LENGTH, modulus);
    assert!((scale / 1.5e-6 - 1.0).abs() < 1e-3, "{scale}");
    // The end drop is reached at the end.
    for (k2, drop) in [(1.0, 5e-6), (0.4, 12e-6)] {
        let log = logarithm(1.5e-6, k2, Some(drop)).unwrap();
        assert!((log.drop(HALF) / drop - 1.0).abs() < 1e-9);
        assert_eq!(log.drop(0.999 * (1.0 - k2) * HALF), 0.0);
    }
}
