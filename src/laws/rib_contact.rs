//! The end of a roller on a rib: Hertz's contact with a lubricant film that is mostly sheared.
//!
//! ```text
//! Q, a, b, P_mean = Q/(pi a b)        of the ellipse, as of other point contacts; beside a cylinder the circle of the radius R_f
//! h = 2.69 R_f U^0.67 G^0.53 W^-0.067 (1 - 0.61 e^-0.73),   W = Q/(E' R_f^2)        (Hamrock and Dowson), times T_R at P_max = 1.5 P_mean
//! friction of the film as in line contacts, at P_mean and the radius sqrt(a b)
//! ```
//!
//! 1/R_f is the mean of both curvatures of end and rib together. The mean of a line contact on an ellipse is an assumption, and so is the film of a circle;
//! so is that rim and corner of an end are as stiff as its cap. Sources: Hertz; Hamrock and Dowson 1977; NTN Technical Review 71 for the film.

use crate::laws::contact_pair::ContactForce;
use crate::laws::elastic::normal::{NormalDamping, NormalForce};
use crate::laws::elastic::point::ElasticPoint;
use crate::laws::film::ellipse::EllipseFilm;
use crate::laws::film::regime::LubricationRegime;
use crate::laws::film::thickness::Entrainment;
use crate::laws::traction::film_friction::FilmFriction;
use crate::laws::traction::muraki_kimura::Traction;
use crate::laws::traction::self_heating::SelfHeating;
use crate::scalar::{Real, math};
use std::f64::consts::PI;

/// The law of one kind of ribs.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RibContact {
    /// Hertz's contact.
    pub elastic: ElasticPoint,
    /// Normal damping.
    pub damping: Option<NormalDamping>,
    /// Film thickness; without it there is no friction.
    pub film: Option<EllipseFilm>,
    /// Full-film traction.
    pub traction: Option<Traction>,
    /// Self-heating of the traction film.
    pub self_heating: Option<SelfHeating>,
    /// Mixed and boundary lubrication.
    pub regime: Option<LubricationRegime>,
}

/// How an end moves on its rib.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct EndMotion<T> {
    /// delta, m, and its rate, m/s.
    pub delta: T,
    /// See `delta`.
    pub delta_dot: T,
    /// Size of the mean velocity of both surfaces past the contact, and of the slip, m/s.
    pub entrainment: T,
    /// See `entrainment`.
    pub slip: T,
    /// Sizes of the velocities of both surfaces past the contact, m/s.
    pub surface_speeds: [T; 2],
}

impl RibContact {
    /// Elastic load at an approach (m), N.
    pub fn load<T: Real>(&self, delta: T) -> T {
        if delta.value() <= 0.0 {
            return T::constant(0.0);
        }
        delta * delta.sqrt() * self.elastic.rigidity
    }

    /// Elastic energy at an approach (m), J: 2/5 of Q delta.
    pub fn energy(&self, delta: f64) -> f64 {
        0.4 * self.load(delta) * delta.max(0.0)
    }

    /// Stiffness under a load (N), N/m.
    pub fn stiffness_at_load(&self, load: f64) -> f64 {
        1.5 * math::powf(load * self.elastic.rigidity * self.elastic.rigidity, 1.0 / 3.0)
    }

    /// Mean radius sqrt(a b) of the contact (m) and largest pressure (Pa) under a load, N.
    pub fn circle<T: Real>(&self, load: T) -> [T; 2] {
        let [long, short] = self.elastic.unit_axes;
        let a = (load.ln() * (1.0 / 3.0)).exp() * (long * short).sqrt();
        [a, load / (a * a) * (1.5 / PI)]
    }

    /// Forces, with the viscosity e^`ln_viscosity` times that of the laws; friction is the secant alone, against the slip.
    pub fn force<T: Real>(&self, motion: &EndMotion<T>, ln_viscosity: T) -> ContactForce<T> {
        let zero = T::constant(0.0);
        let mut out = ContactForce::none(zero);
        // A NaN counts as contact and is passed on.
        if motion.delta.value() <= 0.0 {
            return out;
        }
        let elastic = self.load(motion.delta);
        let stiffness = elastic / motion.delta * 1.5;
        let normal =
            NormalForce::new(elastic, stiffness, self.damping.as_ref(), motion.delta, motion.delta_dot);
        (out.normal, out.stiffness, out.damping) = (normal.force, normal.stiffness, normal.damping);
        let Some(film) = self.film.as_ref().filter(|_| normal.force.value() > 0.0) else { return out };
        let [a, pressure] = self.circle(normal.force);
        let half = motion.slip * 0.5;
        let rolling = Entrainment::new(motion.entrainment + half, motion.entrainment - half, ln_viscosity);
        let ln_film = film.ln_central(normal.force.ln(), pressure, &rolling);
        out.film = ln_film.exp();
        let friction = FilmFriction {
            traction: self.traction.as_ref(),
            self_heating: self.self_heating.as_ref(),
            regime: self.regime.as_ref(),
        };
        let rubbing =
            friction.at([pressure * (2.0 / 3.0), a], [out.film, ln_film], motion.surface_speeds, &rolling);
        out.film_ratio = rubbing.film_ratio;
        out.temperature_rise = rubbing.temperature_rise;
        out.friction_coefficient = rubbing.coefficient;
        out.friction_secant = rubbing.coefficient * normal.force / rolling.slip;
        out
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::laws::elastic::line::effective_modulus;
    use crate::laws::film::thickness::ThermalLoad;
    use crate::laws::line_contact::tests::raceway;
    use crate::scalar::Dual;

    fn rib() -> RibContact {
        let modulus = effective_modulus(206e9, 0.3, 206e9, 0.3);
        let line = raceway();
        let point = ElasticPoint::new(modulus, [1.0 / 0.6; 2]).unwrap();
        RibContact {
            elastic: point,
            damping: line.damping,
            film: Some(EllipseFilm::new(&point, 0.06, 2e-8, Some(ThermalLoad::new(0.04, 0.06, 0.13)))),
            traction: line.traction,
            self_heating: line.self_heating,
            regime: line.regime,
        }
    }

    fn motion(delta: f64) -> EndMotion<f64> {
        EndMotion { delta, delta_dot: 1e-3, entrainment: 2.0, slip: 1.3, surface_speeds: [2.5, 1.4] }
    }

    #[test]
    fn it_is_the_contact_of_hertz() {
        let law = rib();
        let stiffness = 2.0 / 3.0 * law.elastic.effective_modulus * 0.6f64.sqrt();
        for delta in [1e-8, 1e-6, 5e-6] {
            let (own, of_circle) = (law.load(delta), stiffness * delta * f64::sqrt(delta));
            assert!((own / of_circle - 1.0).abs() < 1e-6, "{own} {of_circle}");
            let [a, pressure] = law.circle(own);
            assert!((a * a / (0.6 * delta) - 1.0).abs() < 1e-6);
            assert!((pressure * PI * a * a / (1.5 * own) - 1.0).abs() < 1e-12);
            let stiffness = law.load(Dual::<1>::variable(delta, 0)).eps[0];
            assert!((law.stiffness_at_load(own) / stiffness - 1.0).abs() < 1e-12);
        }
    }

    #[test]
    fn it_slides_with_less_than_the_limit_of_the_film() {
        let force = rib().force(&motion(1e-6), 0.0);
        // tau0 over the mean pressure is that of a film that is as thin as can be.
        let [_, pressure] = rib().circle(force.normal);
        let limit = 1.5 * 5e6 / pressure;
        assert!((1e-4..limit).contains(&force.friction_coefficient), "{force:?} {limit}");
        assert!(
            (force.friction_secant * 1.3 / (force.friction_coefficient * force.normal) - 1.0).abs() < 1e-9
        );
    }

    #[test]
    fn derivatives_are_those_of_the_forces() {
        let law = rib();
        for delta in [1e-8, 2e-6] {
            let at = motion(delta);
            let numbers = [at.delta, at.delta_dot, at.entrainment, at.slip, 2.5, 1.4, 0.1];
            let of = |x: [f64; 7]| {
                let motion = EndMotion {
                    delta: x[0],
                    delta_dot: x[1],
                    entrainment: x[2],
                    slip: x[3],
                    surface_speeds: [x[4], x[5]],
                };
                let force = law.force(&motion, x[6]);
                [force.normal, force.friction_secant]
            };
            let x: [Dual<7>; 7] = std::array::from_fn(|k| Dual::variable(numbers[k], k));
            let varied = EndMotion {
                delta: x[0],
                delta_dot: x[1],
                entrainment: x[2],
                slip: x[3],
                surface_speeds: [x[4], x[5]],
            };
            let force = law.force(&varied, x[6]);
            for k in 0..7 {
                let h = 1e-5 * numbers[k];
                let moved = |s: f64| of(std::array::from_fn(|i| numbers[i] + if i == k { s } else { 0.0 }));
                let [low, high] = [-h, h].map(moved);
                for (i, exact) in [force.normal, force.friction_secant].into_iter().enumerate() {
                    let difference = (high[i] - low[i]) / (2.0 * h);
                    let size = exact.re.abs() / numbers[k].abs();
                    assert!(
                        (exact.eps[k] - difference).abs() < 1e-5 * size,
                        "{k} {i}: {exact:?} {difference}"
                    );
                }
            }
        }
    }

    #[test]
    fn apart_there_is_nothing() {
        assert_eq!(rib().force(&motion(-1e-9), 0.0), ContactForce::none(0.0));
        assert!(rib().force(&motion(f64::NAN), 0.0).normal.is_nan());
    }
}
