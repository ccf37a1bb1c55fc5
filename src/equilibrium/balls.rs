//! Ring and balls in space: the ring is found by its own forces, with every ball at rest beside it.
//!
//! First without speed, by the least energy; then the speed grows to that of the scene, from each equilibrium to the next.

use super::ball::{Ball, OF_RING, OnRing, RaceControl, Rolling};
use super::settle::{Balance, Rest, settle};
use super::steady::SteadyBall;
use super::{Equilibrium, named};
use crate::bodies::{HostInputs, Input, RING_COORDINATES};
use crate::error::{Error, Result, Status};
use crate::laws::film::thickness::Entrainment;
use crate::laws::point_contact::PointContact;
use crate::model::space::Space;
use crate::model::{Quantity, quantity};
use crate::scalar::{Dual, math};
use crate::scene::shown;
use crate::space::solid::{LARGEST_TILT, Tilt, dot};
use nalgebra::{Matrix5, Vector5};

/// Smallest and largest part of the speed by which it grows from one equilibrium to the next.
const SMALLEST_PART: f64 = 1.0 / 1024.0;
const LARGEST_PART: f64 = 0.25;
/// A direction of the ring with less than this share of the stiffness of a lightly pressed contact has none.
const NO_STIFFNESS: f64 = 1e-9;
/// Largest pressure that bearing steel is rated for, Pa (ISO 76, ball bearings).
const RATED_PRESSURE: f64 = 4.2e9;

/// What is known of every ball.
const BALL: [Quantity; 8] = [
    quantity("azimuth", "rad", "angle about the axis of the bearing"),
    quantity("axial_offset", "m", "place along the axis of the bearing"),
    quantity("radial_offset", "m", "distance outside the pitch circle"),
    quantity("orbit_speed", "rad/s", "speed about the axis of the bearing"),
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
    quantity("normal_force", "N", "normal force Q"),
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

/// A ball at rest or in steady motion.
enum AtRest<'a> {
    Controlled(Ball<'a>, [f64; 2]),
    Steady(SteadyBall<'a>, [f64; 6]),
}

impl<'a> AtRest<'a> {
    fn on_ring(&self, beside: [f64; OF_RING]) -> OnRing {
        match self {
            Self::Controlled(ball, place) => ball.on_ring(*place, beside),
            Self::Steady(ball, motion) => ball.on_ring(*motion, beside),
        }
    }

    fn ball(&self) -> &Ball<'a> {
        match self {
            Self::Controlled(ball, _) => ball,
            Self::Steady(ball, _) => &ball.ball,
        }
    }

    /// x and rho, m; psi', w_x, w_r, w_psi, rad/s.
    fn motion(&self, beside: [f64; OF_RING]) -> [f64; 6] {
        match self {
            Self::Controlled(ball, place) => {
                let Rolling { orbit, spin } = ball.forces::<f64>(*place, beside).rolling;
                [place[0], place[1], orbit, spin[0], spin[1], 0.0]
            }
            Self::Steady(_, motion) => *motion,
        }
    }
}

/// The bearing at one speed.
struct Bearing<'a> {
    space: &'a Space,
    control: RaceControl,
    /// Whether balls are in the steady motion of their friction.
    steady: bool,
    /// Loads on the ring, N and N m.
    load: [f64; OF_RING],
    /// Speeds of outer and inner ring, rad/s.
    speeds: [f64; 2],
}

impl<'a> Bearing<'a> {
    fn ball(&self, j: usize) -> Ball<'a> {
        let Space { balls, races, gravity: [gy, gz], .. } = self.space;
        let (sin, cos) = self.direction(j);
        Ball {
            grooves: races.each_ref().map(|race| &race.groove),
            elastic: races.each_ref().map(|race| &race.elastic[j]),
            excess: balls.set.radius_excess[j],
            inertia: balls.inertia(j),
            speeds: self.speeds,
            gravity: gy * cos + gz * sin,
            control: match self.control {
                _ if self.speeds == [0.0; 2] => RaceControl::None,
                RaceControl::Friction => RaceControl::Outer,
                control => control,
            },
        }
    }

    fn direction(&self, j: usize) -> (f64, f64) {
        math::sin_cos(self.space.balls.set.reference_angles[j])
    }

    /// Coordinates of the ring beside ball `j`, by row, over those of the bearing.
    fn beside(&self, j: usize) -> Matrix5<f64> {
        let (s, c) = self.direction(j);
        Matrix5::from_row_slice(&[
            1.0, 0.0, 0.0, 0.0, 0.0, //
            0.0, c, s, 0.0, 0.0, //
            0.0, -s, c, 0.0, 0.0, //
            0.0, 0.0, 0.0, c, s, //
            0.0, 0.0, 0.0, -s, c,
        ])
    }

    /// A place (m) of a ball between both grooves, on the line that joins the centres of their arcs.
    fn between(&self, ring: &[f64; OF_RING]) -> [f64; 2] {
        let [outer, inner] = self.space.races.each_ref().map(|race| &race.groove);
        let ([ox, or], [ix, ir]) = (outer.centre(), inner.centre());
        let line = [ring[0] - ring[4] * outer.pitch_radius - ix + ox, ring[1] - ir + or];
        let distance = math::hypot(line[0], line[1]);
        let squeezed = distance - outer.length() - inner.length();
        // A ball that nothing presses stands off by less than an atom.
        let length = outer.length() * (1.0 - 1e-9) + 0.5 * squeezed.max(0.0);
        [line[0] / distance * length - ox, line[1] / distance * length - or]
    }

    /// All balls at rest beside a ring at these coordinates; `None` where one finds none.
    fn balls(&self, ring: &Vector5<f64>) -> Option<Vec<AtRest<'a>>> {
        (0..self.space.balls.set.count).map(|j| self.at_rest(j, ring)).collect()
    }

    /// Ball `j`.
    fn at_rest(&self, j: usize, ring: &Vector5<f64>) -> Option<AtRest<'a>> {
        let (ball, beside) = (self.ball(j), (self.beside(j) * ring).into());
        let from = self.between(&beside);
        if !self.steady {
            let place = ball.rest(from, beside)?;
            return Some(AtRest::Controlled(ball, place));
        }
        let ball = SteadyBall { ball, laws: self.space.races.each_ref().map(|race| &race.laws) };
        let motion = ball.steady(from, beside)?;
        Some(AtRest::Steady(ball, motion))
    }

    /// Force of these balls on the ring over its coordinates, the stiffness, and their energy, J, with the size of the forces.
    fn on_ring(&self, ring: &Vector5<f64>, balls: &[AtRest<'a>]) -> Balance<OF_RING> {
        let mut sum =
            Balance { force: Vector5::zeros(), stiffness: Matrix5::zeros(), energy: 0.0, size: 0.0 };
        for (j, ball) in balls.iter().enumerate() {
            let turned = self.beside(j);
            let of = ball.on_ring((turned * ring).into());
            sum.force += turned.transpose() * of.force;
            sum.stiffness += turned.transpose() * of.stiffness * turned;
            sum.energy += of.energy;
            sum.size += of.force.fixed_rows::<3>(0).norm();
        }
        sum
    }

    /// The same with load and spring, over coordinates that are lengths: tilts times the pitch radius; those that are held have no force.
    fn balance(&self, scaled: &Vector5<f64>) -> Option<Balance<OF_RING>> {
        let (ring, radius) = (self.unscaled(scaled), self.space.balls.set.pitch_radius);
        if scaled.norm() > self.reach() || math::hypot(ring[3], ring[4]) > LARGEST_TILT {
            return None;
        }
        let mut sum = self.on_ring(&ring, &self.balls(&ring)?);
        let [spring, stiffness] = self.space.ring.spring(ring[0]);
        let [lx, ly, lz, my, mz] = self.load;
        // A moment that keeps its direction, over the angles.
        let tilt = Tilt::new([0, 1].map(|k| Dual::<2>::variable(ring[3 + k], k)));
        let moments = tilt.moments_over_angles([0.0, my, mz].map(|m| Dual { re: m, eps: [0.0; 2] }));
        sum.force += Vector5::new(lx + spring, ly, lz, moments[0].re, moments[1].re);
        sum.stiffness[(0, 0)] += stiffness;
        for (i, moment) in moments.iter().enumerate() {
            for k in 0..2 {
                sum.stiffness[(3 + i, 3 + k)] -= moment.eps[k];
            }
        }
        sum.energy += 0.5 * stiffness * ring[0] * ring[0]
            - (lx + self.space.ring.spring(0.0)[0]) * ring[0]
            - ly * ring[1]
            - lz * ring[2]
            - my * ring[3]
            - mz * ring[4];
        sum.size += lx.abs() + spring.abs() + ly.abs() + lz.abs() + (my.abs() + mz.abs()) / radius;
        let lengths = Vector5::new(1.0, 1.0, 1.0, 1.0 / radius, 1.0 / radius);
        sum.force.component_mul_assign(&lengths);
        let outer = lengths * lengths.transpose();
        sum.stiffness.component_mul_assign(&outer);
        for (k, held) in self.space.ring.held.iter().enumerate() {
            if held.is_some() {
                sum.force[k] = 0.0;
                sum.stiffness.row_mut(k).fill(0.0);
                sum.stiffness.column_mut(k).fill(0.0);
                sum.stiffness[(k, k)] = self.soft();
            }
        }
        Some(sum)
    }

    /// Largest displacement of a ring that is still in the bearing, m.
    fn reach(&self) -> f64 {
        2.0 * self.space.races.iter().map(|race| race.groove.length()).sum::<f64>()
    }

    /// Stiffness of one lightly pressed contact, N/m.
    fn soft(&self) -> f64 {
        let elastic = &self.space.races[0].elastic[0];
        elastic.rigidity * (1e-5 * self.space.balls.set.radius).sqrt()
    }

    /// Largest centrifugal force of a ball beside a ring at these coordinates, N.
    fn largest_centrifugal(&self, ring: &Vector5<f64>) -> f64 {
        let forces = self.balls(ring).unwrap_or_default().into_iter().enumerate().map(|(j, ball)| {
            let [_, rho, orbit, ..] = ball.motion((self.beside(j) * ring).into());
            ball.ball().inertia[0] * orbit * orbit * (self.space.balls.set.pitch_radius + rho)
        });
        forces.fold(0.0, f64::max)
    }

    fn unscaled(&self, scaled: &Vector5<f64>) -> Vector5<f64> {
        let radius = self.space.balls.set.pitch_radius;
        Vector5::new(scaled[0], scaled[1], scaled[2], scaled[3] / radius, scaled[4] / radius)
    }

    fn settled(&self, from: Vector5<f64>) -> std::result::Result<Rest<OF_RING>, Vector5<f64>> {
        settle(from, 1e-3 * self.soft(), |scaled| self.balance(scaled))
    }
}

/// Failure to find an equilibrium with the ring at last at these coordinates, in words.
fn none(bearing: &Bearing<'_>, at: &Vector5<f64>, share: f64) -> Error {
    let ring = bearing.unscaled(at);
    let far = (0..OF_RING)
        .filter(|k| bearing.space.ring.held[*k].is_none())
        .find(|k| at[*k].abs() > 0.4 * bearing.reach());
    let restless = (0..bearing.space.balls.set.count).find(|j| bearing.at_rest(*j, &ring).is_none());
    let why = match (far, restless) {
        (None, _) if bearing.control == RaceControl::Inner && share > 0.0 => {
            "the inner race controls no balls that it hardly presses; 'outer' or 'none' instead of 'inner'"
                .to_owned()
        }
        (None, Some(j)) if bearing.steady => format!(
            "ball[{j}] finds no steady motion under friction; balls that the inner race does not press are not driven: 'outer' or 'none' \
             instead of 'friction'"
        ),
        (None, Some(j)) => format!("ball[{j}] finds no rest"),
        (Some(k), _) => {
            let [name, unit, _] = RING_COORDINATES[k].position.unwrap_or_default();
            format!(
                "inner_ring.{name} goes beyond {} {unit}: nothing holds the ring that way",
                shown(ring[k])
            )
        }
        (None, None) if share > 0.0 => format!(
            "Newton's method found none near that of a lower speed; where the centrifugal force of balls, here up to {} N, outweighs \
             their load there may be none",
            shown(bearing.largest_centrifugal(&ring))
        ),
        (None, None) => "Newton's method found none".to_owned(),
    };
    let at = if share > 0.0 { format!(" at {} of the speed", shown(share)) } else { " at rest".to_owned() };
    Error::new(Status::BadState, format!("no equilibrium{at}: {why}"))
}

/// The free direction of the ring with the least stiffness: stiffness (N/m) as that of a move at the pitch circle, and the coordinate that
/// moves most.
fn softest(stiffness: &Matrix5<f64>) -> (f64, &'static str) {
    let eigen = stiffness.symmetric_part().symmetric_eigen();
    let (place, value) = eigen.eigenvalues.argmin();
    let (most, _) = eigen.eigenvectors.column(place).abs().argmax();
    let [name, ..] = RING_COORDINATES[most].position.unwrap_or_default();
    (value, name)
}

/// The equilibrium of ring and balls.
pub(super) fn equilibrium(space: &Space, control: RaceControl) -> Result<Equilibrium> {
    let inputs = space.inputs.at(0.0, &HostInputs::default());
    let speeds = [Input::OuterRingSpeed, Input::RingSpeed].map(|input| inputs.of(input));
    let radius = space.balls.set.pitch_radius;
    let held = space.ring.held.map(|held| held.unwrap_or(0.0));
    let start = Vector5::new(held[0], held[1], held[2], held[3] * radius, held[4] * radius);
    let at_speed = |share: f64| Bearing {
        space,
        control,
        steady: false,
        load: space.ring.load(&inputs),
        speeds: speeds.map(|speed| share * speed),
    };
    let still = at_speed(0.0);
    let mut rest = still.settled(start).map_err(|at| none(&still, &at, 0.0))?;
    let (mut share, mut part) = (0.0, LARGEST_PART);
    while speeds != [0.0; 2] && share < 1.0 {
        let next = (share + part).min(1.0);
        match at_speed(next).settled(rest.x) {
            Ok(found) => {
                (rest, share) = (found, next);
                part = (2.0 * part).min(LARGEST_PART);
            }
            Err(at) if part <= SMALLEST_PART => return Err(none(&at_speed(next), &at, next)),
            Err(_) => part *= 0.5,
        }
    }
    let mut bearing = at_speed(1.0);
    if control == RaceControl::Friction && speeds != [0.0; 2] {
        has_traction(space)?;
        bearing.steady = true;
        rest = bearing.settled(rest.x).map_err(|at| none(&bearing, &at, 1.0))?;
    }
    let (least, softest) = softest(&rest.balance.stiffness);
    if least.abs() <= NO_STIFFNESS * bearing.soft() {
        let text = format!(
            "inner_ring.motion.space.{softest}: free, and nothing holds it (stiffness {} N/m at the pitch circle); hold it, or load the \
             bearing",
            shown(least)
        );
        return Err(Error::new(Status::BadState, text));
    }
    let ring = bearing.unscaled(&rest.x);
    let balls = bearing.balls(&ring).ok_or_else(|| none(&bearing, &rest.x, 1.0))?;
    let sum = bearing.on_ring(&ring, &balls);
    let mut found = Equilibrium {
        coordinates: named(&RING_COORDINATES),
        free: space.ring.held.iter().map(Option::is_none).collect(),
        displacement: ring.iter().copied().collect(),
        reaction: sum.force.iter().copied().collect(),
        stiffness: sum.stiffness.transpose().iter().copied().collect(),
        element_quantities: &BALL,
        elements: Vec::new(),
        contacts: space.contact_names(),
        contact_quantities: &CONTACT,
        contact_values: Vec::new(),
        warnings: Vec::new(),
        residual: rest.balance.force.norm() / rest.balance.size.max(f64::MIN_POSITIVE),
    };
    for (j, ball) in balls.iter().enumerate() {
        tell(&bearing, j, ball, &ring, &mut found);
    }
    warn(&bearing, &mut found);
    if least < 0.0 {
        let text =
            format!("the ring is pushed away from this equilibrium along {softest} ({} N/m)", shown(least));
        found.warnings.push(text);
    }
    Ok(found)
}

/// The steady motion needs what drives balls.
fn has_traction(space: &Space) -> Result<()> {
    if space.races.iter().all(|race| race.laws.traction.is_some()) {
        return Ok(());
    }
    let text = "raceways.contact.traction: missing; the steady motion of balls under friction needs it";
    Err(Error::new(Status::BadScene, text))
}

/// Writes what is known of a ball and its contacts.
fn tell(bearing: &Bearing<'_>, j: usize, at_rest: &AtRest<'_>, ring: &Vector5<f64>, out: &mut Equilibrium) {
    let beside: [f64; OF_RING] = (bearing.beside(j) * ring).into();
    let (ball, motion) = (at_rest.ball(), at_rest.motion(beside));
    let [x, rho, orbit, wx, wr, wpsi] = motion;
    let forces = ball.forces::<f64>([x, rho], beside);
    let own = orbit - wx;
    let pitch = if own == 0.0 { 0.0 } else { math::atan2(wr * own.signum(), own.abs()) };
    let azimuth = bearing.space.balls.set.reference_angles[j];
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
        if pressure > RATED_PRESSURE {
            out.warnings.push(format!(
                "{name}: the largest pressure, {} Pa, is above {RATED_PRESSURE:e} Pa, the static limit of ISO 76",
                shown(pressure)
            ));
        }
    }
    let unloaded = out.contact_values.chunks(2).filter(|both| both[1][0] == 0.0).count();
    if unloaded > 0 && unloaded < out.elements.len() {
        out.warnings
            .push(format!("{unloaded} of {} balls carry no load of the inner ring", out.elements.len()));
    }
}
