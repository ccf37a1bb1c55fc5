//! A bearing whose balls or rollers, inner ring and cage move in space.
//!
//! | file | what |
//! |---|---|
//! | `evaluate`, `workspace` | forces and accelerations, balls in columns |
//! | `cage/` | pockets and lands at a state and in a step, their derivatives, what is told of them |
//! | `rollers/` | rollers that skew and tilt: their contacts at a state and in a step, derivatives, start, what is told of them |
//! | `step` | damping, forces of a semi-implicit step, energies, powers |
//! | `linearize` | exact derivatives |
//! | `rest/`, `initial` | ring and balls at rest or in steady motion; start of a run |
//! | `scales`, `costs` | units of errors, frequencies; where time goes |
//! | `report` | force reports, channels, what is followed in every step |

mod cage;
mod costs;
mod evaluate;
mod initial;
mod linearize;
mod report;
pub(crate) mod rest;
mod rollers;
mod scales;
mod step;
mod workspace;

pub(crate) use report::{Reading, Source};
pub use report::{
    SPATIAL_CONTACT_QUANTITIES, SPATIAL_FORCE_COMPONENTS, SpatialBodyForces, SpatialContact, SpatialForces,
};
pub use rollers::{LINE_LOAD_QUANTITIES, LineLoad};
pub use workspace::Workspace;

use super::faults::{Names, in_words};
use super::signals::InputSignals;
use super::{HostInputs, Layout, Quantity, StateInfo, quantity};
use crate::bodies::{
    Balls, CAGE, CageInSpace, Coordinate, ElementSet, Fault, Input, Owner, RING_COORDINATES, RingInSpace,
};
use crate::error::Result;
use crate::integrate::Tuning;
use crate::laws::drag::MixtureDrag;
use crate::pairs::Law;
use crate::pairs::ball_pocket::{BallPockets, WALLS};
use crate::pairs::groove::{Fit, Race, angle_of_drop, fit, races};
use crate::pairs::guide::land::Land;
use crate::scene::{BallDrag, Scene, needed};
use cage::memory::CageOfScene;
use rollers::RollersOfScene;
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
    /// Number, size and places of the elements.
    pub(crate) set: ElementSet,
    pub(crate) balls: Balls,
    /// Whether balls have states; else their motion is prescribed.
    pub(crate) free: bool,
    /// Of outer and inner ring, where balls are free; else none.
    pub(crate) races: Vec<Race>,
    cage: Option<CageOfScene>,
    /// Rollers that move in space; `None` with balls and prescribed elements.
    rollers: Option<RollersOfScene>,
    /// What a ball touches, in the order of its contacts.
    contacts_of_ball: Vec<&'static str>,
    /// Of the mixture around the balls.
    drag: Option<MixtureDrag>,
    /// Channels that are followed in every step.
    watched: Vec<Source>,
}

impl Space {
    /// Builds that of a checked scene with these inputs, if it has balls or a cage in space.
    pub(in crate::model) fn new(scene: Arc<Scene>, inputs: Arc<InputSignals>) -> Result<Option<Self>> {
        let skewing = scene.has_skewing_rollers();
        let free = scene.balls.is_some() || skewing;
        if !free && !scene.has_spatial_cage() {
            return Ok(None);
        }
        let set = ElementSet::new(&scene);
        let balls = Balls::new(&scene, &set);
        let viscosity = inputs.viscosity_at_start(&scene);
        let races = races(&scene, &set.radius_excess, viscosity)?.map_or_else(Vec::new, Vec::from);
        let of_drag = |drag: &BallDrag| {
            let viscosity = needed("lubricant", viscosity, "balls.drag")?;
            Ok(MixtureDrag { density: drag.density, coefficient: drag.coefficient, viscosity })
        };
        let drag = scene.balls.as_ref().and_then(|balls| balls.drag.as_ref()).map(of_drag).transpose()?;
        let ring = RingInSpace::new(&scene);
        let rollers = RollersOfScene::new(&scene, &set, viscosity)?;
        let coordinates = rollers.as_ref().map_or(balls.coordinates(), |rollers| rollers.body.coordinates());
        let spins = coordinates.iter().filter(|c| c.position.is_none()).count();
        let count = if free { set.count } else { 0 };
        let of_elements = [count, coordinates.len() - spins, spins];
        let cage = match CageInSpace::new(&scene, &set) {
            None => None,
            Some(body) => Some(CageOfScene {
                body,
                pockets: if skewing { None } else { BallPockets::new(&scene, viscosity)? },
                lands: Land::all(&scene, viscosity)?,
            }),
        };
        let mut contacts_of_ball: Vec<&'static str> = RACES[..races.len()].to_vec();
        if let Some(rollers) = &rollers {
            contacts_of_ball = rollers.contacts.clone();
        }
        if let Some(pockets) = cage.as_ref().and_then(|cage| cage.pockets.as_ref()) {
            contacts_of_ball.extend(pockets.wall_names());
        }
        let of_cage = cage.as_ref().map_or(0, |cage| cage.body.coordinates().len());
        let layout = Layout::new([0, ring.free().count(), of_cage, 0], of_elements, false, Vec::new());
        let gravity = scene.gravity.map_or([0.0; 2], |g| [g.y, g.z]);
        let watched = Vec::new();
        Ok(Some(Self {
            scene,
            inputs,
            layout,
            gravity,
            ring,
            set,
            balls,
            free,
            races,
            cage,
            rollers,
            contacts_of_ball,
            drag,
            watched,
        }))
    }

    /// Outer and inner race of balls that are free.
    pub(crate) fn both_races(&self) -> [&Race; 2] {
        [&self.races[0], &self.races[1]]
    }

    /// Coordinates of an element.
    fn element_coordinates(&self) -> &'static [Coordinate] {
        match &self.rollers {
            Some(rollers) => rollers.body.coordinates(),
            None => self.balls.coordinates(),
        }
    }

    /// Coordinates of the cage; none without one.
    fn cage_coordinates(&self) -> &[Coordinate] {
        self.cage.as_ref().map_or(&[], |cage| cage.body.coordinates())
    }

    /// Order of the coordinates in the state vector.
    pub(crate) fn layout(&self) -> &Layout {
        &self.layout
    }

    /// The longest step (s) from the state (q, v) at time `t` in which no signal and no onset of a land is passed unseen.
    pub(crate) fn longest_step(
        &self,
        t: f64,
        [q, v]: [&[f64]; 2],
        host: &HostInputs,
        tuning: &Tuning,
    ) -> f64 {
        let longest =
            self.inputs.shortest_period(host).min(self.shortest_wave(t, host)) / tuning.steps_per_period;
        if self.cage.is_none() {
            return longest;
        }
        longest.min(self.longest_cage_step([q, v], &self.inputs.at(t, host), tuning))
    }

    /// Shortest period of the waves of races that balls pass, s: at most that by which both rings turn; infinity where they are round.
    fn shortest_wave(&self, t: f64, host: &HostInputs) -> f64 {
        let order = self.races.iter().filter_map(|race| Some(race.waviness.as_ref()?.highest_order()));
        let order = order.fold(0.0, f64::max);
        if order == 0.0 {
            return f64::INFINITY;
        }
        let speed =
            |input| host.of(input, t).map_or_else(|| self.inputs.largest(input), |[speed, _]| speed.abs());
        TAU / (order * (speed(Input::OuterRingSpeed) + speed(Input::RingSpeed)))
    }

    /// Name of the body of a group of velocities.
    pub(crate) fn group_name(&self, group: usize) -> Option<String> {
        match self.layout.owner_of_group(group) {
            Owner::Element(j) => Some(format!("{}[{j}]", self.element_kind())),
            Owner::Shared(CAGE) => Some("cage".to_owned()),
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
            giving: self.energy_giving_film(),
        };
        in_words(fault, &names)
    }

    /// What the elements are called in names.
    pub(crate) fn element_kind(&self) -> &'static str {
        match (&self.rollers, self.free) {
            (Some(_), _) => "roller",
            (None, true) => "ball",
            (None, false) => "element",
        }
    }

    /// The field of the scene by which the film of a land can give energy, if it can.
    pub(crate) fn energy_giving_film(&self) -> Option<String> {
        self.cage.as_ref()?.lands.iter().find_map(Land::energy_giving_field)
    }

    /// Smallest radial clearance of the lands of its cage, m, if it has any.
    pub(crate) fn guide_clearance(&self) -> Option<f64> {
        self.cage.as_ref()?.lands.iter().map(Land::clearance).reduce(f64::min)
    }

    /// Clearance of a centred ball in its pocket along the orbit, m, if there are pockets.
    pub(crate) fn pocket_clearance(&self) -> Option<f64> {
        if self.rollers.is_some() {
            return Some(self.scene.cage.as_ref()?.pocket.as_ref()?.clearance());
        }
        self.cage.as_ref()?.pockets.as_ref()?.walls.clearances()[0]
    }

    /// Number of balls.
    pub(crate) fn element_count(&self) -> usize {
        self.set.count
    }

    /// Whether its elements are rollers.
    pub(crate) fn has_rollers(&self) -> bool {
        self.rollers.is_some()
    }

    /// Radius of the pitch circle, m.
    pub(crate) fn pitch_radius(&self) -> f64 {
        self.set.pitch_radius
    }

    /// The laws that it uses, each with the largest number of contacts it can act in.
    pub(crate) fn laws_in_use(&self) -> Vec<(&'static str, usize)> {
        let mut most = [0; Law::ALL.len()];
        for (race, law) in [Law::OuterRaceway, Law::InnerRaceway].into_iter().enumerate() {
            for law in std::iter::once(law).filter(|_| self.free).chain(self.parts(race)) {
                most[law as usize] += self.element_count();
            }
        }
        if let Some(rollers) = &self.rollers {
            for part in [0, 1].into_iter().flat_map(|side| rollers.parts(side)) {
                most[part as usize] += self.element_count();
            }
            for (law, contacts) in [(Law::PocketWall, rollers.bars()), (Law::Rib, rollers.ends())] {
                most[law as usize] += contacts * self.element_count();
            }
        }
        if let Some(cage) = &self.cage {
            if let Some(pockets) = &cage.pockets {
                most[Law::PocketWall as usize] += self.element_count()
                    * pockets.walls.clearances().into_iter().flatten().count().min(WALLS);
            }
            for law in cage.lands.iter().flat_map(Land::laws_listed) {
                most[law as usize] += 1;
            }
        }
        most[Law::ViscosityTemperature as usize] += usize::from(self.inputs.oil.is_some());
        Law::ALL.iter().map(|law| (law.name(), most[*law as usize])).filter(|(_, n)| *n > 0).collect()
    }

    /// Names of the bodies: outer ring, inner ring, cage, balls.
    pub(crate) fn body_names(&self) -> Vec<String> {
        let cage = self.cage.iter().map(|_| "cage".to_owned());
        let balls = (0..self.set.count).map(|j| format!("{}[{j}]", self.element_kind()));
        RINGS.iter().map(|name| (*name).to_owned()).chain(cage).chain(balls).collect()
    }

    /// Place of ball `j` among the bodies.
    fn body_of_ball(&self, j: usize) -> usize {
        RINGS.len() + usize::from(self.cage.is_some()) + j
    }

    /// Names of all contacts, those of a ball together.
    pub(crate) fn contact_names(&self) -> Vec<String> {
        let kind = self.element_kind();
        let mut names = Vec::with_capacity(self.set.count * self.contacts_of_ball.len());
        for j in 0..self.set.count {
            names.extend(self.contacts_of_ball.iter().map(|contact| format!("{kind}[{j}].{contact}")));
        }
        names
    }

    /// The state vector: positions, their rates, then speeds without position.
    pub(crate) fn state_infos(&self) -> Vec<StateInfo> {
        let ring = self.ring.free().map(|k| ("inner_ring".to_owned(), &RING_COORDINATES[k]));
        let cage = self.cage_coordinates().iter().map(|c| ("cage".to_owned(), c));
        let kind = self.element_kind();
        let balls = (0..self.layout.count)
            .flat_map(|j| self.element_coordinates().iter().map(move |c| (format!("{kind}[{j}]"), c)));
        let all: Vec<(String, &Coordinate)> = ring.chain(cage).chain(balls).collect();
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
        let set = &self.set;
        let mut list = vec![
            (quantity("element_count", "1", "number of rolling elements"), set.count as f64),
            (quantity("element_radius", "m", "radius of a rolling element"), set.radius),
            (quantity("pitch_radius", "m", "radius of the pitch circle"), set.pitch_radius),
        ];
        if let [outer, inner] = &self.races[..] {
            let about = quantity("outer_groove_radius", "m", "radius of the outer groove across its length");
            list.push((about, outer.groove.radius));
            let about = quantity("inner_groove_radius", "m", "radius of the inner groove across its length");
            list.push((about, inner.groove.radius));
            let about = quantity("free_contact_angle", "rad", "contact angle at which balls just touch");
            list.push((about, self.free_contact_angle()));
        }
        if let Some(clearance) = self.guide_clearance() {
            list.push((
                quantity("guide_clearance", "m", "smallest radial clearance of the lands of the cage"),
                clearance,
            ));
        }
        if let Some(clearance) = self.pocket_clearance() {
            let about = quantity(
                "pocket_clearance",
                "m",
                "clearance of a centred element in its pocket along the orbit",
            );
            list.push((about, clearance));
        }
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
