use super::*;
use crate::laws::elastic::line::effective_modulus;
use crate::laws::film::thickness::{ThermalCorrection, ThermalLoad};
use crate::laws::rolling::{
    ELASTIC_RATIO, Extent, InletSliding, Isothermal, RIGID_RATIO, RollingFilm, ZhouHoeprich,
};
use crate::scalar::{Dual, Real};

/// The inner raceway contact of the NU2310 example.
pub fn raceway() -> LineContact {
    let e = effective_modulus(206e9, 0.3, 206e9, 0.3);
    let elastic = ElasticLine::new(e, 1.0 / (1.0 / 7.5e-3 + 1.0 / 32.5e-3), 0.0204);
    let thermal = ThermalLoad::new(0.04, 0.06, 0.13);
    let film = RollingFilm { line: &elastic, viscosity: 0.06, pressure_viscosity: 2e-8 };
    let rolling = Isothermal::ZhouHoeprich(ZhouHoeprich::new(&film));
    let steel = 46.0 * 7830.0 * 460.0;
    LineContact {
        elastic,
        profile: None,
        damping: Some(NormalDamping { relaxation_time: 5e-7, softening_depth: 1e-8 }),
        film: Some(FilmThickness::new(&elastic, 0.06, 2e-8, Some(ThermalCorrection::GhoshPandey(thermal)))),
        traction: Some(Traction::new(0.06, 2e-8, 5e6, 3e8)),
        self_heating: Some(SelfHeating {
            temperature_viscosity: 0.04,
            conductivity: 0.13,
            eyring_stress: 5e6,
            thermal_product_1: steel,
            thermal_product_2: steel,
            acts: 1.0,
        }),
        regime: Some(LubricationRegime {
            boundary: SolidFriction { coefficient: 0.1, transition_speed: 0.02 },
            lambda_boundary: 0.06,
            lambda_full: 3.0,
            roughness: 1e-7,
        }),
        rolling_resistance: Some(RollingResistance::new(rolling, &elastic, thermal, Extent::All)),
        edge_friction: None,
    }
}

/// The same with the drag of the inlet on surfaces that slip.
fn with_inlet_sliding() -> LineContact {
    let law = raceway();
    let film = RollingFilm { line: &law.elastic, viscosity: 0.06, pressure_viscosity: 2e-8 };
    let sliding = Some(InletSliding::new(&film, RIGID_RATIO, ELASTIC_RATIO));
    let rolling_resistance = law.rolling_resistance.map(|of| RollingResistance { sliding, ..of });
    LineContact { rolling_resistance, ..law }
}

#[test]
fn what_drags_in_the_inlet_is_a_share_of_rolling_resistance() {
    let (law, without) = (with_inlet_sliding(), raceway());
    for (delta, u1, u2) in [(1e-8, 6.0, 5.0), (3e-6, -6.0, -6.3), (1e-9, -0.2, 6.0)] {
        let motion = ContactMotion { delta, delta_dot: 0.0, u1, u2 };
        let [a, b] = [law, without].map(|law| law.force(&motion, 0.1, 0.0));
        let drag = a.friction - b.friction;
        let sliding = law.rolling_resistance.unwrap().sliding.unwrap();
        let share = sliding.ratio(math::ln(b.normal), &Entrainment::new(u1, u2, 0.1));
        let expected = share * b.rolling_resistance.abs() * (u2 - u1) / (0.5 * (u1 + u2)).abs();
        assert!((drag / expected - 1.0).abs() < 1e-9, "{drag} {expected}");
        assert_eq!((a.normal, a.rolling_resistance), (b.normal, b.rolling_resistance));
        assert!((a.friction_coefficient * a.normal / a.friction.abs() - 1.0).abs() < 1e-9);
    }
}

fn components<T: Real>(f: &ContactForce<T>) -> [T; 3] {
    [f.normal, f.friction, f.rolling_resistance]
}

#[test]
fn exact_derivatives_match_central_differences() {
    exact_derivatives(&raceway());
    exact_derivatives(&with_inlet_sliding());
}

fn exact_derivatives(law: &LineContact) {
    for x in [
        [2e-6, 1e-3, 6.0, 5.9],
        [1e-8, -1e-4, 6.0, 6.3],
        [4e-6, 0.0, 6.0, 6.0001],
        [1e-6, 0.0, -3.0, -3.5],
        [1e-6, 0.01, 0.4, -0.3],
        [3e-7, 0.0, 0.02, 0.005],
    ] {
        let d: Vec<Dual<4>> = (0..4).map(|i| Dual::variable(x[i], i)).collect();
        let motion = ContactMotion { delta: d[0], delta_dot: d[1], u1: d[2], u2: d[3] };
        let exact = components(&law.force(&motion, Dual::constant(0.0), Dual::constant(0.0)));
        let value = |x: &[f64; 4]| {
            let motion = ContactMotion { delta: x[0], delta_dot: x[1], u1: x[2], u2: x[3] };
            components(&law.force(&motion, 0.0, 0.0))
        };
        for i in 0..4 {
            let h = [1e-5 * x[0], 1e-7, 1e-6, 1e-6][i];
            let (mut lo, mut hi) = (x, x);
            lo[i] -= h;
            hi[i] += h;
            let (lo, hi) = (value(&lo), value(&hi));
            for k in 0..3 {
                let difference = (hi[k] - lo[k]) / (2.0 * h);
                let scale = difference.abs().max(1e-6 * value(&x)[0] / h);
                let error = (exact[k].eps[i] - difference).abs() / scale;
                assert!(error < 1e-5, "x {x:?} d{k}/d{i}: {} {difference}", exact[k].eps[i]);
            }
        }
    }
}

#[test]
fn forces_are_continuous_through_every_switch() {
    // A fine scan finds the steepest interval; halving it again and again must make the change vanish, which
    // it does for any power law but not for a jump.
    scan_switches(&raceway());
    scan_switches(&with_inlet_sliding());
}

fn scan_switches(law: &LineContact) {
    let scan = |name: &str, at: &dyn Fn(f64) -> ContactMotion<f64>| {
        let value = |x: f64| components(&law.force(&at(x), 0.0, 0.0));
        let n = 4000;
        let grid: Vec<_> = (0..=n).map(|i| value(i as f64 / n as f64)).collect();
        for k in 0..3 {
            let largest = grid.iter().fold(1e-3f64, |m, v| m.max(v[k].abs()));
            let change = |i: usize| (grid[i + 1][k] - grid[i][k]).abs();
            let steepest = (0..n).max_by(|&i, &j| change(i).total_cmp(&change(j))).unwrap();
            let (mut a, mut b) = (steepest as f64 / n as f64, (steepest + 1) as f64 / n as f64);
            for _ in 0..40 {
                let middle = 0.5 * (a + b);
                let (fa, fm, fb) = (value(a)[k], value(middle)[k], value(b)[k]);
                if (fm - fa).abs() > (fb - fm).abs() { b = middle } else { a = middle }
            }
            let jump = (value(b)[k] - value(a)[k]).abs();
            assert!(jump < 2e-3 * largest, "{name}: component {k} jumps by {jump} of {largest}");
        }
    };
    scan("onset", &|x| ContactMotion { delta: 2e-8 * (x - 0.3), delta_dot: 0.02, u1: 6.0, u2: 5.0 });
    scan("slip", &|x| ContactMotion { delta: 1e-6, delta_dot: 0.0, u1: 6.0 + 0.2 * (x - 0.5), u2: 6.0 });
    scan("rolling", &|x| ContactMotion {
        delta: 1e-6,
        delta_dot: 0.0,
        u1: 1e-4 * (x - 0.5),
        u2: 1e-4 * (x - 0.5) - 0.3,
    });
    scan("regimes", &|x| {
        let u = 1e-5 * 1e7f64.powf(x);
        ContactMotion { delta: 1e-6, delta_dot: 0.0, u1: u, u2: 0.9 * u }
    });
    scan("pressure", &|x| ContactMotion { delta: 1e-9 * 1e5f64.powf(x), delta_dot: 0.0, u1: 6.0, u2: 5.95 });
}

#[test]
fn friction_opposes_slip_and_rolling_resistance_opposes_rolling() {
    let law = raceway();
    for (u1, u2) in [(6.0, 5.0), (5.0, 6.0), (-6.0, -5.0), (-5.0, -6.0)] {
        let motion = ContactMotion { delta: 1e-6, delta_dot: 0.0, u1, u2 };
        let f = law.force(&motion, 0.0, 0.0);
        assert!(f.friction * (u1 - u2) < 0.0);
        assert!(f.rolling_resistance * (u1 + u2) < 0.0);
    }
}

#[test]
fn absent_laws_add_nothing() {
    let bare = LineContact {
        film: None,
        traction: None,
        self_heating: None,
        regime: None,
        rolling_resistance: None,
        damping: None,
        ..raceway()
    };
    let motion = ContactMotion { delta: 1e-6, delta_dot: 1.0, u1: 6.0, u2: 1.0 };
    let f = bare.force(&motion, 0.0, 0.0);
    assert_eq!(f.normal, bare.elastic.load(1e-6));
    assert_eq!([f.friction, f.rolling_resistance, f.film, f.damping], [0.0; 4]);
}
