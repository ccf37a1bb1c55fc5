//! A bearing whose balls and inner ring move in space.
//!
//! | file | what |
//! |---|---|
//! | `evaluate`, `workspace` | forces and accelerations, balls in columns |
//! | `step` | damping, forces of a semi-implicit step, energies, powers |
//! | `linearize` | exact derivatives |
//! | `rest/`, `initial` | ring and balls at rest or in steady motion; start of a run |
//! | `scales`, `costs` | units of errors, frequencies; where time goes |
//! | `report` | force reports, channels, what is followed in every step |

mod costs;
mod evaluate;
mod initial;
mod linearize;
mod report;
pub(crate) mod rest;
mod scales;
mod step;
mod workspace;

pub(crate) use report::{Reading, Source};
pub use report::{
    SPATIAL_CONTACT_QUANTITIES, SPATIAL_FORCE_COMPONENTS, SpatialBodyForces, SpatialContact, SpatialForces,
};
pub use workspace::Workspace;

use super::faults::{Names, in_words};
use super::signals::InputSignals;
use super::{HostInputs, Layout, Quantity, StateInfo, quantity};
use crate::bodies::{Balls, Coordinate, Fault, Input, Owner, RING_COORDINATES, RingInSpace};
use crate::error::Result;
use crate::integrate::Tuning;
use crate::laws::drag::MixtureDrag;
use crate::pairs::Law;
use crate::pairs::groove::{Fit, Race, angle_of_drop, fit, races};
use crate::scene::{BallDrag, Scene, needed};
use std::f64::consts::TAU;
use std::sync::Arc;

/// Names of the bodies before the balls.
const RINGS: [&str; 2] = ["outer_ring", "inner_ring"];
/// Contacts of every ball.
const RACES: [&str; 2] = ["outer_raceway", "inner_raceway"];

/// A bearing in space.
#[derive(Debug)]
pub struct Space {
    scene: Arc<Scene>,
    pub(crate) inputs: Arc<InputSignals>,
    layout: Layout,
    /// Along y and z, m/s^2.
    pub(crate) gravity: [f64; 2],
    pub(crate) ring: RingInSpace,
    pub(crate) balls: Balls,
    /// Of outer and inner ring.
    pub(crate) races: [Race; 2],
    /// Of the mixture around the balls.
    drag: Option<MixtureDrag>,
    /// Channels that are followed in every step.
    watched: Vec<Source>,
}

impl Space {
    /// Builds that of a checked scene with these inputs, if it has balls.
    pub(in crate::model) fn new(scene: Arc<Scene>, inputs: Arc<InputSignals>) -> Result<Option<Self>> {
        let Some(balls) = Balls::new(&scene) else { return Ok(None) };
        let viscosity = inputs.viscosity_at_start(&scene);
        let Some(races) = races(&scene, &balls.set.radius_excess, viscosity)? else { return Ok(None) };
        let of_drag = |drag: &BallDrag| {
            let viscosity = needed("lubricant", viscosity, "balls.drag")?;
            Ok(MixtureDrag { density: drag.density, coefficient: drag.coefficient, viscosity })
        };
        let drag = scene.balls.as_ref().and_then(|balls| balls.drag.as_ref()).map(of_drag).transpose()?;
        let ring = RingInSpace::new(&scene);
        let spins = balls.coordinates().iter().filter(|c| c.position.is_none()).count();
        let of_balls = [balls.set.count, balls.coordinates().len() - spins, spins];
        let layout = Layout::new([0, ring.free().count(), 0], of_balls, false, Vec::new());
        let gravity = scene.gravity.map_or([0.0; 2], |g| [g.y, g.z]);
        Ok(Some(Self { scene, inputs, layout, gravity, ring, balls, races, drag, watched: Vec::new() }))
    }

    /// Order of the coordinates in the state vector.
    pub(crate) fn layout(&self) -> &Layout {
        &self.layout
    }

    /// The longest step (s) from time `t` in which no signal is passed unseen.
    pub(crate) fn longest_step(&self, host: &HostInputs, tuning: &Tuning) -> f64 {
        self.inputs.shortest_period(host).min(self.shortest_wave(host)) / tuning.steps_per_period
    }

    /// Shortest period of the waves of races that balls pass, s: at most that by which both rings turn; infinity where they are round.
    fn shortest_wave(&self, host: &HostInputs) -> f64 {
        let order = self.races.iter().filter_map(|race| Some(race.waviness.as_ref()?.highest_order()));
        let order = order.fold(0.0, f64::max);
        if order == 0.0 {
            return f64::INFINITY;
        }
        let speed = |input| host.of(input).map_or_else(|| self.inputs.largest(input), f64::abs);
        TAU / (order * (speed(Input::OuterRingSpeed) + speed(Input::RingSpeed)))
    }

    /// Name of the body of a group of velocities.
    pub(crate) fn group_name(&self, group: usize) -> Option<String> {
        match self.layout.owner_of_group(group) {
            Owner::Element(j) => Some(format!("ball[{j}]")),
            Owner::Shared(_) => Some(RINGS[1].to_owned()),
            Owner::Node(_) => None,
        }
    }

    /// A fault in words.
    pub(crate) fn describe(&self, fault: Fault) -> String {
        let names = Names {
            element: self.element_kind(),
            states: &|| self.state_infos(),
            positions: self.layout.positions(),
            contacts: &|| self.contact_names(),
            giving: None,
        };
        in_words(fault, &names)
    }

    /// What the elements are called in names.
    pub(crate) fn element_kind(&self) -> &'static str {
        "ball"
    }

    /// Number of balls.
    pub(crate) fn element_count(&self) -> usize {
        self.balls.set.count
    }

    /// Balls are none.
    pub(crate) fn has_rollers(&self) -> bool {
        false
    }

    /// Radius of the pitch circle, m.
    pub(crate) fn pitch_radius(&self) -> f64 {
        self.balls.set.pitch_radius
    }

    /// The laws that it uses, each with the largest number of contacts it can act in.
    pub(crate) fn laws_in_use(&self) -> Vec<(&'static str, usize)> {
        let mut most = [0; Law::ALL.len()];
        for (race, law) in [Law::OuterRaceway, Law::InnerRaceway].into_iter().enumerate() {
            for law in std::iter::once(law).chain(self.parts(race)) {
                most[law as usize] += self.element_count();
            }
        }
        most[Law::ViscosityTemperature as usize] += usize::from(self.inputs.oil.is_some());
        Law::ALL.iter().map(|law| (law.name(), most[*law as usize])).filter(|(_, n)| *n > 0).collect()
    }

    /// Names of the bodies: outer ring, inner ring, balls.
    pub(crate) fn body_names(&self) -> Vec<String> {
        let rings = RINGS.iter().map(|name| (*name).to_owned());
        rings.chain((0..self.balls.set.count).map(|j| format!("ball[{j}]"))).collect()
    }

    /// Names of all contacts, those of a ball together.
    pub(crate) fn contact_names(&self) -> Vec<String> {
        let of_ball = |j: usize| RACES.map(|contact| format!("ball[{j}].{contact}"));
        (0..self.balls.set.count).flat_map(of_ball).collect()
    }

    /// The state vector: positions, their rates, then speeds without position.
    pub(crate) fn state_infos(&self) -> Vec<StateInfo> {
        let ring = self.ring.free().map(|k| ("inner_ring".to_owned(), &RING_COORDINATES[k]));
        let balls = (0..self.balls.set.count)
            .flat_map(|j| self.balls.coordinates().iter().map(move |c| (format!("ball[{j}]"), c)));
        let all: Vec<(String, &Coordinate)> = ring.chain(balls).collect();
        let placed = || all.iter().filter(|(_, c)| c.position.is_some());
        let positions = placed().filter_map(|(body, c)| Some((body, c.position?)));
        let rates = placed().map(|(body, c)| (body, c.rate));
        let spins = all.iter().filter(|(_, c)| c.position.is_none()).map(|(body, c)| (body, c.rate));
        let named = |(body, [name, unit, description]): (&String, [&'static str; 3])| StateInfo {
            name: format!("{body}.{name}"),
            unit,
            description,
        };
        positions.chain(rates).chain(spins).map(named).collect()
    }

    /// Lengths, angles and counts of the bearing that follow from its scene.
    pub(crate) fn geometry(&self) -> Vec<(Quantity, f64)> {
        let (set, [outer, inner]) = (&self.balls.set, &self.races);
        let mut list = vec![
            (quantity("element_count", "1", "number of rolling elements"), set.count as f64),
            (quantity("element_radius", "m", "radius of a rolling element"), set.radius),
            (quantity("pitch_radius", "m", "radius of the pitch circle"), set.pitch_radius),
            (
                quantity("outer_groove_radius", "m", "radius of the outer groove across its length"),
                outer.groove.radius,
            ),
            (
                quantity("inner_groove_radius", "m", "radius of the inner groove across its length"),
                inner.groove.radius,
            ),
            (
                quantity("free_contact_angle", "rad", "contact angle at which balls just touch"),
                self.free_contact_angle(),
            ),
        ];
        if let Some(clearance) = self.scene.inner_ring.as_ref().and_then(|ring| ring.radial_clearance) {
            let about =
                quantity("radial_internal_clearance", "m", "radial internal clearance between the raceways");
            list.push((about, clearance));
        }
        list
    }

    /// Contact angle at which balls just touch both grooves, rad; zero of a deep groove bearing without clearance.
    pub(crate) fn free_contact_angle(&self) -> f64 {
        match fit(&self.scene) {
            Fit::ContactAngle(angle) => angle,
            Fit::RadialClearance(clearance) => {
                let distance: f64 =
                    self.races.iter().map(|race| race.groove.radius - race.groove.ball_radius).sum();
                angle_of_drop(clearance / (2.0 * distance))
            }
        }
    }
}
