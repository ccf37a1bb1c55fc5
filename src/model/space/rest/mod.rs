//! The ring in space at rest: found by its own forces, with every ball or roller at rest beside it.
//!
//! | file | what |
//! |---|---|
//! | `ring` | the ring under its load, whatever it rests on |
//! | `ball`, `steady` | a ball that race control turns, and one that its friction turns |
//! | `rollers` | rollers that tilt |
//! | `settle` | Newton's method |
//!
//! Beside balls first without speed, by the least energy; then the speed grows to that of the scene, from each equilibrium to the next.

mod ball;
mod ring;
pub(crate) mod rollers;
mod settle;
mod steady;

pub use ball::RaceControl;
pub(crate) use ball::{Ball, OF_RING};
pub(crate) use ring::SettledRing;
pub(crate) use settle::Balance;

use super::Space;
use crate::bodies::{HostInputs, Input, RING_COORDINATES};
use crate::error::{Error, Result, Status};
use crate::scalar::math;
use crate::scene::shown;
use ball::{OnRing, Rolling};
use nalgebra::{Matrix5, Vector5};
use ring::RingAtRest;
use settle::Rest;
use steady::SteadyBall;

/// Smallest and largest part of the speed by which it grows from one equilibrium to the next.
const SMALLEST_PART: f64 = 1.0 / 1024.0;
const LARGEST_PART: f64 = 0.25;
/// A ball at rest or in steady motion.
pub(crate) enum AtRest<'a> {
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

    pub(crate) fn ball(&self) -> &Ball<'a> {
        match self {
            Self::Controlled(ball, _) => ball,
            Self::Steady(ball, _) => &ball.ball,
        }
    }

    /// x and rho, m; psi', w_x, w_r, w_psi, rad/s.
    pub(crate) fn motion(&self, beside: [f64; OF_RING]) -> [f64; 6] {
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
pub(crate) struct Bearing<'a> {
    pub(crate) space: &'a Space,
    control: RaceControl,
    /// Whether balls are in the steady motion of their friction.
    steady: bool,
    /// Loads on the ring, N and N m.
    load: [f64; OF_RING],
    /// Speeds of outer and inner ring, rad/s.
    pub(crate) speeds: [f64; 2],
}

impl<'a> Bearing<'a> {
    fn ball(&self, j: usize) -> Ball<'a> {
        let Space { set, balls, gravity: [gy, gz], .. } = self.space;
        let races = self.space.both_races();
        let (sin, cos) = self.direction(j);
        Ball {
            grooves: races.map(|race| &race.groove),
            elastic: races.map(|race| &race.elastic[j]),
            excess: set.radius_excess[j],
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
        math::sin_cos(self.space.set.reference_angles[j])
    }

    /// Coordinates of the ring beside ball `j`, by row, over those of the bearing.
    pub(crate) fn beside(&self, j: usize) -> Matrix5<f64> {
        ring::beside(self.direction(j))
    }

    /// A place (m) of a ball between both grooves, on the line that joins the centres of their arcs.
    fn between(&self, ring: &[f64; OF_RING]) -> [f64; 2] {
        let [outer, inner] = self.space.both_races().map(|race| &race.groove);
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
        (0..self.space.set.count).map(|j| self.at_rest(j, ring)).collect()
    }

    /// Ball `j`.
    fn at_rest(&self, j: usize, ring: &Vector5<f64>) -> Option<AtRest<'a>> {
        let (ball, beside) = (self.ball(j), (self.beside(j) * ring).into());
        let from = self.between(&beside);
        if !self.steady {
            let place = ball.rest(from, beside)?;
            return Some(AtRest::Controlled(ball, place));
        }
        let ball = SteadyBall { ball, laws: self.space.both_races().map(|race| &race.laws) };
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

    /// Largest displacement of a ring that is still in the bearing, m.
    fn reach(&self) -> f64 {
        2.0 * self.space.races.iter().map(|race| race.groove.length()).sum::<f64>()
    }

    /// Stiffness of one lightly pressed contact, N/m.
    fn soft(&self) -> f64 {
        let elastic = &self.space.races[0].elastic[0];
        elastic.rigidity * (1e-5 * self.space.set.radius).sqrt()
    }

    /// Largest centrifugal force of a ball beside a ring at these coordinates, N.
    fn largest_centrifugal(&self, ring: &Vector5<f64>) -> f64 {
        let forces = self.balls(ring).unwrap_or_default().into_iter().enumerate().map(|(j, ball)| {
            let [_, rho, orbit, ..] = ball.motion((self.beside(j) * ring).into());
            ball.ball().inertia[0] * orbit * orbit * (self.space.set.pitch_radius + rho)
        });
        forces.fold(0.0, f64::max)
    }

    /// Its ring.
    fn ring(&self) -> RingAtRest<'a> {
        let Space { ring, set, .. } = self.space;
        let (load, pitch_radius) = (self.load, set.pitch_radius);
        RingAtRest { ring, load, pitch_radius, reach: self.reach(), soft: self.soft() }
    }

    fn settled(&self, from: Vector5<f64>) -> std::result::Result<Rest<OF_RING>, Vector5<f64>> {
        self.ring().settled(from, &mut |ring| Some(self.on_ring(ring, &self.balls(ring)?)))
    }
}

/// Failure to find an equilibrium with the ring at last at these coordinates, in words.
fn none(bearing: &Bearing<'_>, at: &Vector5<f64>, share: f64) -> Error {
    let ring = bearing.ring().unscaled(at);
    let far = (0..OF_RING)
        .filter(|k| bearing.space.ring.held[*k].is_none())
        .find(|k| at[*k].abs() > 0.4 * bearing.reach());
    let restless = (0..bearing.space.set.count).find(|j| bearing.at_rest(*j, &ring).is_none());
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

/// Ring and balls at rest, or in the motion that race control or friction gives them.
pub(crate) struct Settled<'a> {
    pub(crate) bearing: Bearing<'a>,
    pub(crate) ring: SettledRing,
    pub(crate) balls: Vec<AtRest<'a>>,
}

/// Finds ring and balls at rest at the start of the scene.
///
/// # Errors
/// [`Status::BadState`] where there is no equilibrium, or none was found; [`Status::BadScene`] where a law is missing.
pub(crate) fn settled(space: &Space, control: RaceControl) -> Result<Settled<'_>> {
    let inputs = space.inputs.at(0.0, &HostInputs::default());
    let speeds = [Input::OuterRingSpeed, Input::RingSpeed].map(|input| inputs.of(input));
    let at_speed = |share: f64| Bearing {
        space,
        control,
        steady: false,
        load: space.ring.load(&inputs),
        speeds: speeds.map(|speed| share * speed),
    };
    let still = at_speed(0.0);
    let mut rest = still.settled(still.ring().start()).map_err(|at| none(&still, &at, 0.0))?;
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
    let at = bearing.ring().unscaled(&rest.x);
    let balls = bearing.balls(&at).ok_or_else(|| none(&bearing, &rest.x, 1.0))?;
    let ring = bearing.ring().equilibrium(&rest, bearing.on_ring(&at, &balls))?;
    Ok(Settled { bearing, ring, balls })
}

/// The steady motion needs what drives balls.
fn has_traction(space: &Space) -> Result<()> {
    if space.races.iter().all(|race| race.laws.traction.is_some()) {
        return Ok(());
    }
    let text = "raceways.contact.traction: missing; the steady motion of balls under friction needs it";
    Err(Error::new(Status::BadScene, text))
}
