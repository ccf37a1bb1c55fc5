//! The equilibrium of balls in space, told as users read it.

use super::{
    AZIMUTH, Equilibrium, NORMAL_FORCE, ORBIT_SPEED, RADIAL_OFFSET, of_ring, over_pressed, pushed_away,
};
use crate::error::Result;
use crate::laws::film::thickness::Entrainment;
use crate::laws::point_contact::PointContact;
use crate::model::space::Space;
use crate::model::space::rest::{AtRest, Bearing, OF_RING, RaceControl, settled};
use crate::model::{Quantity, STATIC_LIMIT, quantity};
use crate::scalar::math;
use crate::scene::shown;
use crate::space::solid::{Tilt, dot};
use nalgebra::Vector5;

/// What is known of every ball.
const BALL: [Quantity; 8] = [
    AZIMUTH,
    quantity("axial_offset", "m", "place along the axis of the bearing"),
    RADIAL_OFFSET,
    ORBIT_SPEED,
    quantity("spin_x", "rad/s", "angular velocity about the axis of the bearing"),
    quantity("spin_r", "rad/s", "angular velocity about the outward axis"),
    quantity("spin_t", "rad/s", "angular velocity about the axis along the orbit"),
    quantity(
        "pitch_angle",
        "rad",
        "angle of the axis about which it turns against the train to that of the bearing, in the plane of both",
    ),
];
/// What is known of every contact.
const CONTACT: [Quantity; 10] = [
    NORMAL_FORCE,
    quantity("contact_angle", "rad", "angle of the normal to the plane across the axis of the ring"),
    quantity("approach", "m", "elastic approach delta; negative where they are apart"),
    quantity("largest_pressure", "Pa", "largest pressure of Hertz's ellipse"),
    quantity("half_axis_across", "m", "half axis a of the ellipse, across the race"),
    quantity("half_axis_along", "m", "half axis b of the ellipse, along the race"),
    quantity(
        "spin_to_roll",
        "1",
        "angular velocity about the normal over that of rolling, of the ball against the ring",
    ),
    quantity(
        "rolling_speed",
        "m/s",
        "speed of the race past the contact, and of the ball where it does not slip",
    ),
    quantity("film_thickness", "m", "central film thickness; 0 without film"),
    quantity("film_ratio", "1", "film ratio Lambda; 0 without boundary friction, which has the roughness"),
];

/// The equilibrium of ring and balls.
pub(super) fn equilibrium(space: &Space, control: RaceControl) -> Result<Equilibrium> {
    let settled = settled(space, control)?;
    let (bearing, ring) = (&settled.bearing, &settled.ring.at);
    let mut found = of_ring(&settled.ring, [&BALL, &CONTACT]);
    found.contacts = space.contact_names();
    for (j, ball) in settled.balls.iter().enumerate() {
        tell(bearing, j, ball, ring, &mut found);
    }
    warn(bearing, &mut found);
    found.warnings.extend(pushed_away(&settled.ring));
    Ok(found)
}

/// Writes what is known of a ball and its contacts.
fn tell(bearing: &Bearing<'_>, j: usize, at_rest: &AtRest<'_>, ring: &Vector5<f64>, out: &mut Equilibrium) {
    let beside: [f64; OF_RING] = (bearing.beside(j) * ring).into();
    let (ball, motion) = (at_rest.ball(), at_rest.motion(beside));
    let [x, rho, orbit, wx, wr, wpsi] = motion;
    let forces = ball.forces::<f64>([x, rho], beside);
    let own = orbit - wx;
    let pitch = if own == 0.0 { 0.0 } else { math::atan2(wr * own.signum(), own.abs()) };
    let azimuth = bearing.space.set.reference_angles[j];
    out.elements.push(vec![azimuth, x, rho, orbit, wx, wr, wpsi, pitch]);
    let axis = Tilt::new([beside[3], beside[4]]).axis;
    for (k, axis) in [[1.0, 0.0, 0.0], axis].into_iter().enumerate() {
        let (touch, load, elastic) = (&forces.touches[k], forces.loads[k], ball.elastic[k]);
        let side = if k == 0 { 1.0 } else { -1.0 };
        let angle = math::atan2(side * touch.in_meridian[0], side * touch.in_meridian[1]);
        let [long, short] = if load > 0.0 { elastic.half_axes(math::ln(load)) } else { [0.0; 2] };
        let pressure = if load > 0.0 { elastic.largest_pressure(load, [long, short]) } else { 0.0 };
        let turning: [f64; 3] = std::array::from_fn(|i| [wx, wr, wpsi][i] - bearing.speeds[k] * axis[i]);
        let (spin, roll) = (dot(turning, touch.normal), dot(turning, touch.across));
        let ratio = if roll == 0.0 { 0.0 } else { (spin / roll).abs() };
        let speed = ball.passing_speed(k, rho, orbit, touch);
        let [film, film_ratio] = film(&bearing.space.races[k].laws, load, pressure, speed);
        let values = [load, angle, touch.delta, pressure, long, short, ratio, speed.abs(), film, film_ratio];
        out.contact_values.push(values.to_vec());
    }
}

/// Film thickness (m) and film ratio of a contact that rolls without slip, zero without such laws.
fn film(laws: &PointContact, load: f64, pressure: f64, speed: f64) -> [f64; 2] {
    let Some(film) = laws.film.as_ref().filter(|_| load > 0.0 && speed != 0.0) else { return [0.0; 2] };
    let rolling = Entrainment::new(speed, speed, 0.0);
    let thickness = math::exp(film.ln_central(math::ln(load), pressure, &rolling));
    [thickness, laws.regime.as_ref().map_or(0.0, |regime| regime.film_ratio(thickness))]
}

/// Says what a bearing should not do.
fn warn(bearing: &Bearing<'_>, out: &mut Equilibrium) {
    for (i, (name, values)) in out.contacts.iter().zip(&out.contact_values).enumerate() {
        let [load, angle, _, pressure, long, ..] = values[..] else { continue };
        let race = &bearing.space.races[i % 2];
        if load > 0.0
            && let Some(beyond) = race.beyond_shoulder(angle, long).filter(|beyond| *beyond > 0.0)
        {
            let text = format!("{name}: the ellipse reaches {} rad beyond the shoulder", shown(beyond));
            out.warnings.push(text);
        }
        out.warnings.extend(over_pressed(name, pressure, STATIC_LIMIT));
    }
    let unloaded = out.contact_values.chunks(2).filter(|both| both[1][0] == 0.0).count();
    if unloaded > 0 && unloaded < out.elements.len() {
        out.warnings
            .push(format!("{unloaded} of {} balls carry no load of the inner ring", out.elements.len()));
    }
}
