//! Forces of every contact and on every body of a bearing in space at a state.

use crate::bodies::{Balls, FORCE_SOURCES, ForceSource};
use crate::model::space::Space;
use crate::model::space::workspace::{Workspace, at_lane};
use crate::model::{Quantity, quantity};
use crate::scalar::{math, place_of};
use crate::space::solid::{numbers, to_global};

/// What is reported of a contact in space. t points along the race, in a pocket outwards; l across, and n from the ball to the contact;
/// (t, l, n) is right-handed. Friction and couple act on the ball, at the contact; the opposite on ring or cage.
pub const SPATIAL_CONTACT_QUANTITIES: [Quantity; 30] = [
    quantity("normal_force", "N", "normal force Q"),
    quantity("approach", "m", "elastic approach delta; negative where they are apart"),
    quantity("approach_speed", "m/s", "rate of the approach"),
    quantity("contact_angle", "rad", "angle of the normal to the plane across the axis of the ring"),
    quantity("half_axis_across", "m", "half axis a of the ellipse, across the race"),
    quantity("half_axis_along", "m", "half axis b of the ellipse, along the race"),
    quantity("largest_pressure", "Pa", "largest pressure of Hertz's ellipse"),
    quantity("film_thickness", "m", "central film thickness; 0 without film"),
    quantity("film_ratio", "1", "film ratio Lambda; 0 without boundary friction, which has the roughness"),
    quantity("temperature_rise", "K", "temperature rise of the traction film"),
    quantity("friction_along", "N", "friction F_t on the ball along the race"),
    quantity("friction_across", "N", "friction F_l on the ball across the race"),
    quantity("couple_along", "N m", "couple M_t on the ball about t"),
    quantity("couple_across", "N m", "couple M_l on the ball about l"),
    quantity("couple_normal", "N m", "couple M_n on the ball about the normal: that of spin"),
    quantity(
        "rolling_resistance",
        "N",
        "rolling resistance on each surface along t, against the rolling speed",
    ),
    quantity("slip_along", "m/s", "slip D_t of the ball in the middle of the contact, along the race"),
    quantity("slip_across", "m/s", "slip D_l of the ball in the middle of the contact, across the race"),
    quantity("turning_along", "rad/s", "angular velocity of the ball against the ring about t"),
    quantity("turning_across", "rad/s", "angular velocity of the ball against the ring about l: rolling"),
    quantity("turning_normal", "rad/s", "angular velocity of the ball against the ring about n: spin"),
    quantity("surface_speed_ball", "m/s", "speed u1 of the surface of the ball past the contact, along t"),
    quantity("surface_speed_ring", "m/s", "speed u2 of the race past the contact, along t"),
    quantity("spin_to_roll", "1", "angular velocity about the normal over that of rolling"),
    quantity("point_x", "m", "contact point along the axis of the bearing"),
    quantity("point_y", "m", "contact point, to the right of the centre of the bearing"),
    quantity("point_z", "m", "contact point, above the centre of the bearing"),
    quantity("normal_x", "1", "normal from the centre of the ball to the contact, along the axis"),
    quantity("normal_y", "1", "the same to the right"),
    quantity("normal_z", "1", "the same upwards"),
];

/// Places among these.
pub(super) const NORMAL_FORCE: usize = 0;
pub(super) const CONTACT_ANGLE: usize = 3;
pub(super) const HALF_AXIS: usize = 4;
pub(super) const PRESSURE: usize = 6;
pub(super) const FILM: usize = 7;
pub(super) const FILM_RATIO: usize = 8;
pub(super) const TEMPERATURE: usize = 9;
/// Friction and couple, and in the same order the slip and turning that they act against.
pub(super) const FRICTION: usize = 10;
pub(super) const SLIP: usize = 16;
pub(super) const SPIN_TO_ROLL: usize = 23;

/// Values of [`SPATIAL_CONTACT_QUANTITIES`].
pub type SpatialContact = [f64; SPATIAL_CONTACT_QUANTITIES.len()];

/// Components of a force on a body in space.
pub const SPATIAL_FORCE_COMPONENTS: [Quantity; 6] = [
    quantity("force_x", "N", "force along the axis of the bearing"),
    quantity("force_y", "N", "force to the right"),
    quantity("force_z", "N", "force upwards"),
    quantity("moment_x", "N m", "moment about the centre of the body, about the axis of the bearing"),
    quantity("moment_y", "N m", "the same about the axis to the right"),
    quantity("moment_z", "N m", "the same about the upward axis"),
];

/// Forces on one body by source, by [`SPATIAL_FORCE_COMPONENTS`].
pub type SpatialBodyForces = [[f64; SPATIAL_FORCE_COMPONENTS.len()]; FORCE_SOURCES.len()];

/// Forces of a bearing in space; nothing of one in the plane.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct SpatialForces {
    /// Per contact, in the order of the names of contacts.
    pub contacts: Vec<SpatialContact>,
    /// Per body, in the order of the names of bodies.
    pub bodies: Vec<SpatialBodyForces>,
}

impl Space {
    /// What is known of the contact of ball `j` with race `k` at the last evaluated state; force and moment about the centre on ball and
    /// ring in the axes of the bearing.
    fn contact_values(&self, ws: &Workspace, k: usize, j: usize) -> (SpatialContact, [[f64; 6]; 2]) {
        let (place, lane) = place_of(j);
        let block = &ws.blocks[place];
        let (motion, force) = (block.contacts[k].motion_of(lane), block.contacts[k].force_of(lane));
        let direction = at_lane(&block.direction, lane);
        let at = at_lane(&block.at, lane);
        let r = self.set.pitch_radius + at[1];
        let speeds = Balls::moving(at_lane(&block.speeds, lane), r);
        let wave = block.contacts[k].wave_of(&self.races[k], lane);
        let ball = self.in_groove(ws, k, j, &speeds);
        let touch = ball.touch(&ws.rings[k].beside(direction)).on(wave);
        let side = if k == 0 { 1.0 } else { -1.0 };
        let angle = math::atan2(side * touch.in_meridian[0], side * touch.in_meridian[1]);
        let radius = self.set.radius + block.excess[lane];
        let wrenches = ball.wrenches(&touch, &force).map(|on| numbers(on.map(|v| to_global(v, direction))));
        let [nx, ny, nz] = to_global(touch.normal, direction);
        let [px, py, pz] = to_global([at[0], r, 0.0], direction);
        let ([ft, fl], [mt, ml, mn]) = (force.friction.force, force.friction.couple);
        let ([dt, dl], [wt, wl, wn], [u1, u2]) = (motion.slip, motion.turning, motion.surface_speeds);
        let ratio = if wl == 0.0 { 0.0 } else { (wn / wl).abs() };
        let [a, b] = force.half_axes;
        let values = [
            force.normal,
            motion.delta,
            motion.delta_dot,
            angle,
            a,
            b,
            force.pressure,
            force.film,
            force.film_ratio,
            force.friction.temperature_rise,
            ft,
            fl,
            mt,
            ml,
            mn,
            force.rolling_resistance,
            dt,
            dl,
            wt,
            wl,
            wn,
            u1,
            u2,
            ratio,
            px + radius * nx,
            py + radius * ny,
            pz + radius * nz,
            nx,
            ny,
            nz,
        ];
        (values, wrenches)
    }

    /// Writes the forces of the last evaluation of `ws` into `out`.
    pub(crate) fn report(&self, ws: &Workspace, out: &mut SpatialForces) {
        out.contacts.clear();
        out.bodies.clear();
        out.bodies.resize(self.body_of_ball(self.set.count), SpatialBodyForces::default());
        let [gy, gz] = self.gravity;
        let walls = self.contacts_of_ball.len() - self.races.len();
        for j in 0..ws.count {
            let body = self.body_of_ball(j);
            let sources = [ForceSource::OuterRaceway, ForceSource::InnerRaceway];
            for (k, source) in sources.into_iter().enumerate().take(self.races.len()) {
                let (values, wrenches) = self.contact_values(ws, k, j);
                out.contacts.push(values);
                for (body, wrench) in [body, k].into_iter().zip(wrenches) {
                    for (sum, part) in out.bodies[body][source as usize].iter_mut().zip(wrench) {
                        *sum += part;
                    }
                }
            }
            out.contacts.extend((0..walls).map(|wall| self.pocket_values(ws, wall, j)));
            if !self.free {
                continue;
            }
            let (block, lane) = place_of(j);
            let block = &ws.blocks[block];
            let r = self.set.pitch_radius + block.at[1][lane];
            let direction = at_lane(&block.direction, lane);
            let of_ball = Balls::moving(at_lane(&block.speeds, lane), r);
            if let Some(drag) = self.drag_on(j, &of_ball, ws.fluid.ln_viscosity) {
                let drag = numbers(drag.map(|v| to_global(v, direction)));
                out.bodies[body][ForceSource::Drag as usize] = drag;
            }
            let [mass, _] = self.balls.inertia(j);
            out.bodies[body][ForceSource::Gravity as usize] = [0.0, mass * gy, mass * gz, 0.0, 0.0, 0.0];
        }
        self.report_rollers(ws, &mut out.contacts, &mut out.bodies);
        self.report_cage(ws, &mut out.bodies);
        let inner = &mut out.bodies[1];
        let [wy, wz] = self.ring.weight(self.gravity);
        inner[ForceSource::Gravity as usize] = [0.0, wy, wz, 0.0, 0.0, 0.0];
        let [spring, _] = self.ring.spring(ws.ring.position[0]);
        let [lx, ly, lz, my, mz] = ws.load;
        inner[ForceSource::Load as usize] = [lx + spring, ly, lz, 0.0, my, mz];
        let [sx, sy, sz, my, mz] = self.ring.support(&ws.ring.rate);
        inner[ForceSource::Support as usize] = [sx, sy, sz, 0.0, my, mz];
    }
}
