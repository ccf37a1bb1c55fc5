//! Balls in the grooves of the raceways: geometry of both rings by the same formulas, waves, elastic contacts.

mod contact;
mod geometry;
mod laws;
mod waviness;

pub(crate) use contact::{Contact, InGroove};
pub(crate) use geometry::{Fit, Groove, RingPlace, Side, Touch};
pub(crate) use waviness::Wave;

use super::Waves;
use super::line_laws::LawBuilder;
use crate::error::Result;
use crate::laws::elastic::line::effective_modulus;
use crate::laws::elastic::point::ElasticPoint;
use crate::laws::point_contact::PointContact;
use crate::scalar::math;
use crate::scene::{Scene, bad_scene, needed};

/// The contacts of all balls with one ring.
#[derive(Debug)]
pub(crate) struct Race {
    pub(crate) groove: Groove,
    /// Of each ball.
    pub(crate) elastic: Vec<ElasticPoint>,
    /// Laws besides elasticity.
    pub(crate) laws: PointContact,
    /// Angle of the contact at which a point would lie on the edge of the shoulder, rad.
    pub(crate) shoulder: Option<f64>,
    /// Waves around the ring.
    pub(crate) waviness: Option<Waves>,
}

impl Race {
    /// Radius of the pressed surface across the race, between those of ball and groove, m (Heathcote).
    pub(crate) fn pressed_radius(&self) -> f64 {
        pressed_radius(self.groove.radius, self.groove.ball_radius)
    }

    /// How far the ellipse with the half axis `long` (m) reaches beyond the shoulder when its middle stands at `angle` (rad), as an angle, rad;
    /// negative where there is room.
    pub(crate) fn beyond_shoulder(&self, angle: f64, long: f64) -> Option<f64> {
        let half = math::asin((long / self.pressed_radius()).min(1.0));
        Some(angle.abs() + half - self.shoulder?)
    }
}

/// R_d, m, of a groove and a ball.
fn pressed_radius(groove: f64, ball: f64) -> f64 {
    2.0 * groove * ball / (groove + ball)
}

/// The angle of which 1 - cos is this; zero below it.
pub(crate) fn angle_of_drop(drop: f64) -> f64 {
    2.0 * math::asin((0.5 * drop.max(0.0)).sqrt().min(1.0))
}

/// How the grooves of a scene lie to each other.
pub(crate) fn fit(scene: &Scene) -> Fit {
    let angle = scene.balls.as_ref().and_then(|balls| balls.contact_angle);
    angle.map_or_else(|| Fit::RadialClearance(scene.radial_clearance()), Fit::ContactAngle)
}

/// Outer and inner race of the balls of a scene with these deviations of their radii (m), in a lubricant with this viscosity, Pa s.
///
/// K and the ellipse are those at the free contact angle of an angular contact bearing and in the middle of a deep groove: a K that followed
/// the angle would leave the force without a potential, and it changes by less than 1 % over 60 degrees.
pub(crate) fn races(scene: &Scene, deviations: &[f64], viscosity: Option<f64>) -> Result<Option<[Race; 2]>> {
    let (Some(balls), Some(raceways)) = (&scene.balls, &scene.raceways) else { return Ok(None) };
    let builder = LawBuilder::new(scene, viscosity);
    let fit = fit(scene);
    let cos = match fit {
        Fit::ContactAngle(angle) => math::cos(angle),
        Fit::RadialClearance(_) => 1.0,
    };
    let (outer, inner) = (scene.outer_ring.as_ref(), scene.inner_ring.as_ref());
    let parts = [
        outer.map(|ring| {
            (
                ring.groove_radius,
                ring.shoulder_height,
                ring.material.as_deref(),
                (&*ring.waviness, ring.waviness_table.as_ref()),
            )
        }),
        inner.map(|ring| {
            (
                ring.groove_radius,
                ring.shoulder_height,
                ring.material.as_deref(),
                (&*ring.waviness, ring.waviness_table.as_ref()),
            )
        }),
    ];
    let race = |side: Side, ring: &str| {
        let (groove, shoulder, material, waves) = parts[side as usize].unwrap_or_default();
        let path = format!("{ring}.groove_radius");
        let radius = needed(&path, groove, "balls")?;
        let material_path = format!("{ring}.material");
        let a = builder.material("balls.material", &balls.material)?;
        let name = needed(&material_path, material, "balls")?;
        let b = builder.material(&material_path, name)?;
        let modulus = effective_modulus(a.young_modulus, a.poisson_ratio, b.young_modulus, b.poisson_ratio);
        let point = |deviation: f64| {
            let ball = balls.radius + deviation;
            let along = match side {
                Side::Outer => -cos / (balls.pitch_radius + ball * cos),
                Side::Inner => cos / (balls.pitch_radius - ball * cos),
            };
            ElasticPoint::new(modulus, [1.0 / ball + along, 1.0 / ball - 1.0 / radius]).ok_or_else(|| {
                let text = format!(
                    "{radius:?} m gives a ball of radius {ball:?} m no elliptic contact that is longer across the groove than along it; \
                     a little more than the radius of the ball is usual"
                );
                bad_scene(&path, text)
            })
        };
        let pressed = pressed_radius(radius, balls.radius);
        let laws = laws::point_contact(&builder, raceways, [&balls.material, name], &point(0.0)?, pressed)?;
        Ok(Race {
            groove: Groove::new(side, balls.pitch_radius, balls.radius, radius, fit),
            elastic: deviations.iter().map(|deviation| point(*deviation)).collect::<Result<_>>()?,
            laws,
            shoulder: shoulder.map(|height| angle_of_drop(height / radius)),
            waviness: Waves::new(waves.0, waves.1),
        })
    };
    Ok(Some([race(Side::Outer, "outer_ring")?, race(Side::Inner, "inner_ring")?]))
}
