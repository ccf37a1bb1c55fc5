//! Output channels of a bearing in space, their values, and what is followed in every step.

use super::forces::{
    CONTACT_ANGLE, FILM, FILM_RATIO, FRICTION, HALF_AXIS, NORMAL_FORCE, PRESSURE, SLIP,
    SPATIAL_CONTACT_QUANTITIES, SPIN_TO_ROLL, SpatialContact, SpatialForces, TEMPERATURE,
};
use crate::bodies::{ForceSource, InputValues, MovingRing, OF_BALL};
use crate::integrate::SemiImplicit;
use crate::model::feedthrough::Sees;
use crate::model::space::cage::OfCage;
use crate::model::space::rollers::OfRollers;
use crate::model::space::workspace::Workspace;
use crate::model::space::{RACES, Space};
use crate::model::{Channel, Quantity, Source as AnySource};
use crate::scalar::math;
use crate::space::solid::{dot, sum};

/// What a channel shows.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Source {
    Ring(usize),
    /// Component of the force of all contacts on the inner ring, by its place among [`super::SPATIAL_FORCE_COMPONENTS`].
    OnRing(usize),
    DragTorque,
    OuterRingTorque,
    OuterDragTorque,
    Viscosity,
    MeanOrbitRatio,
    OrbitAngle(usize),
    OrbitRatio(usize),
    Pitch(usize),
    Yaw(usize),
    /// Quantity, race and ball.
    Contact(usize, usize, usize),
    SlidingPower(usize, usize),
    /// Angle left to the edge of the shoulder, of race and ball.
    Shoulder(usize, usize),
    Cage(OfCage),
    Rollers(OfRollers),
}

impl Source {
    /// What it is made of.
    pub(in crate::model) fn sees(self) -> Sees {
        match self {
            Self::Ring(_) => Sees::PLACES,
            Self::OrbitAngle(_) | Self::Pitch(_) | Self::Yaw(_) => Sees::STATES,
            Self::MeanOrbitRatio | Self::OrbitRatio(_) => Sees::SPEEDS,
            Self::Viscosity => Sees::TEMPERATURE,
            Self::Rollers(source) => source.sees(),
            _ => Sees::FORCES,
        }
    }

    /// Whether it may peak between two records and is known in every step.
    fn can_be_watched(self) -> bool {
        match self {
            Self::Cage(source) => source.can_be_watched(),
            Self::Rollers(source) => source.can_be_watched(),
            Self::Contact(NORMAL_FORCE, ..)
            | Self::DragTorque
            | Self::OuterRingTorque
            | Self::OuterDragTorque => true,
            _ => false,
        }
    }
}

/// What elements and cage do to the inner ring: place among the components, name, unit and meaning.
const ON_RING: [(usize, &str, &str, &str); 5] = [
    (0, "force_x", "N", "force of rolling elements and cage on the ring, along the axis of the bearing"),
    (1, "force_y", "N", "force of rolling elements and cage on the ring, to the right"),
    (2, "force_z", "N", "force of rolling elements and cage on the ring, upwards"),
    (
        4,
        "moment_y",
        "N m",
        "moment of rolling elements and cage about the centre of the ring, about the axis to the right",
    ),
    (
        5,
        "moment_z",
        "N m",
        "moment of rolling elements and cage about the centre of the ring, about the upward axis",
    ),
];

/// A channel of a bearing in space.
pub(in super::super) fn channel(
    name: String,
    unit: &'static str,
    description: &'static str,
    source: Source,
    detail: bool,
) -> Channel {
    let can_be_watched = source.can_be_watched();
    Channel { name, unit, description, source: AnySource::Space(source), detail, can_be_watched }
}

/// A state with what channels show of it.
pub(crate) struct Reading<'a> {
    pub(crate) space: &'a Space,
    pub(crate) ws: &'a Workspace,
    pub(crate) inputs: InputValues,
    pub(crate) q: &'a [f64],
    pub(crate) v: &'a [f64],
    /// Forces that `ws` was evaluated for.
    pub(crate) forces: &'a SpatialForces,
}

impl Space {
    /// All channels, details behind the others.
    pub(in crate::model) fn list_channels(&self) -> Vec<Channel> {
        let mut list = Vec::new();
        self.add_cage_channels(&mut list);
        let mut push = |name: String, unit, description, source: Source, detail| {
            list.push(channel(name, unit, description, source, detail));
        };
        for (k, coordinate) in crate::bodies::RING_COORDINATES.iter().enumerate() {
            if let Some([name, unit, description]) = coordinate.position {
                push(format!("inner_ring.{name}"), unit, description, Source::Ring(k), false);
            }
        }
        for (k, component, unit, text) in ON_RING {
            let moved = self.ring.is_moved();
            push(format!("inner_ring.{component}"), unit, text, Source::OnRing(k), !moved);
        }
        let text = "torque that keeps the inner ring turning, positive against rolling drag";
        push("inner_ring.drag_torque".to_owned(), "N m", text, Source::DragTorque, false);
        let text = "moment on the outer ring about its axis, positive counter-clockwise";
        push("outer_ring.torque".to_owned(), "N m", text, Source::OuterRingTorque, false);
        if let Some(ring) = self.scene.outer_ring.as_ref().filter(|ring| ring.speed.is_some()) {
            let text = "torque that keeps the outer ring turning, positive against rolling drag";
            push("outer_ring.drag_torque".to_owned(), "N m", text, Source::OuterDragTorque, !ring.turns());
        }
        if self.inputs.oil.is_some() {
            let text = "dynamic viscosity of the lubricant at its temperature";
            push("lubricant.viscosity".to_owned(), "Pa s", text, Source::Viscosity, false);
        }
        if self.rollers.is_none() && self.free {
            let text = "mean orbit speed of the balls over that of rolling at the free contact angle";
            push("balls.orbit_ratio".to_owned(), "1", text, Source::MeanOrbitRatio, false);
        }
        self.add_rollers_channels(&mut list);
        for j in 0..self.element_count() {
            self.add_ball_channels(j, &mut list);
        }
        list.sort_by_key(|channel| channel.detail);
        list
    }

    /// Channels of ball `j`.
    fn add_ball_channels(&self, j: usize, list: &mut Vec<Channel>) {
        let kind = self.element_kind();
        let name = |field: &str| format!("{kind}[{j}].{field}");
        let mut push = |name: String, unit, description, source: Source, detail| {
            list.push(channel(name, unit, description, source, detail));
        };
        let text = "angle of the element about the bearing";
        push(name("orbit_angle"), "rad", text, Source::OrbitAngle(j), false);
        if !self.free || self.rollers.is_some() {
            self.add_roller_channels(j, list);
            self.add_pocket_channels(j, list);
            return;
        }
        let text = "orbit speed over that of rolling at the free contact angle";
        push(name("orbit_ratio"), "1", text, Source::OrbitRatio(j), false);
        let text = "angle of the axis about which it turns against the train to that of the bearing, in the plane of both";
        push(name("pitch_angle"), "rad", text, Source::Pitch(j), false);
        let text = "angle of that axis out of the plane through the axis of the bearing";
        push(name("yaw_angle"), "rad", text, Source::Yaw(j), false);
        for (k, race) in RACES.into_iter().enumerate().rev() {
            let ring = race.trim_end_matches("_raceway");
            let laws = &self.races[k].laws;
            let mut of_contact = |field: &str, place: usize, detail| {
                let Quantity { unit, description, .. } = SPATIAL_CONTACT_QUANTITIES[place];
                push(
                    name(&format!("{ring}_{field}")),
                    unit,
                    description,
                    Source::Contact(place, k, j),
                    detail,
                );
            };
            of_contact("force", NORMAL_FORCE, false);
            of_contact("angle", CONTACT_ANGLE, false);
            of_contact("spin_to_roll", SPIN_TO_ROLL, false);
            of_contact("slip_along", SLIP, false);
            of_contact("slip_across", SLIP + 1, false);
            if laws.film.is_some() {
                of_contact("film", FILM, false);
            }
            if laws.regime.is_some() {
                of_contact("film_ratio", FILM_RATIO, true);
            }
            if laws.traction.is_some() {
                of_contact("temperature_rise", TEMPERATURE, true);
            }
            of_contact("pressure", PRESSURE, true);
            let text = "power lost by friction of slip and spin in the contact";
            push(name(&format!("{ring}_sliding_power")), "W", text, Source::SlidingPower(k, j), true);
            if self.races[k].shoulder.is_some() {
                let text = "angle left between the ellipse and the edge of the shoulder, negative beyond it; zero without load";
                push(name(&format!("{ring}_shoulder_margin")), "rad", text, Source::Shoulder(k, j), true);
            }
        }
        self.add_pocket_channels(j, list);
    }

    /// Chooses the channels that are followed in every step, by their places among all.
    pub(in crate::model) fn watch_channels(&mut self, places: &[usize], channels: &[Channel]) {
        let sources = places.iter().filter_map(|place| match channels[*place].source {
            AnySource::Space(source) => Some(source),
            AnySource::Plane(_) => None,
        });
        self.watched = sources.collect();
    }

    /// Values of the watched channels at the last evaluated state of `ws`, whose velocities are `v`, or in a step from there.
    pub(crate) fn watch(
        &self,
        v: &[f64],
        step: Option<&SemiImplicit<'_>>,
        ws: &mut Workspace,
        out: &mut [f64],
    ) {
        self.find_step(v, step, ws);
        for (out, source) in out.iter_mut().zip(&self.watched) {
            *out = match *source {
                Source::Contact(_, k, j) => {
                    let (contact, lane) = ws.contact(k, j);
                    contact.normal[lane]
                }
                Source::Cage(source) => self.cage_value(source, ws),
                Source::Rollers(source) => self.rollers_value(source, ws),
                source => self.torque(source, ws),
            };
        }
    }

    /// Torque on a ring, N m, with what the step from the last evaluated state has added.
    fn torque(&self, source: Source, ws: &Workspace) -> f64 {
        let race = usize::from(source == Source::DragTorque);
        let mut moment = ws.on_rings[race][1];
        if self.rollers.is_some() && ws.step.is_some_and(|h| h > 0.0) {
            moment = sum(moment, self.reaction_of_rollers(ws, race)[1]);
        }
        if ws.step.is_some_and(|h| h > 0.0) {
            for (contact, lane) in ws.contacts(race) {
                let by_step = [3, 4, 5].map(|k| contact.reaction[k][lane]);
                moment = sum(moment, by_step);
            }
        }
        let turning = |ring: &MovingRing<f64>| if ring.speed < 0.0 { -1.0 } else { 1.0 };
        match source {
            Source::DragTorque => -dot(moment, ws.rings[1].axis) * turning(&ws.rings[1]),
            Source::OuterDragTorque => -moment[0] * turning(&ws.rings[0]),
            _ => moment[0],
        }
    }
}

impl Reading<'_> {
    fn contact(&self, k: usize, j: usize) -> &SpatialContact {
        &self.forces.contacts[self.space.contacts_of_ball.len() * j + k]
    }

    /// Value of a channel.
    pub(crate) fn value(&self, source: Source) -> f64 {
        let Self { space, ws, inputs, q, v, .. } = self;
        let of_ball = |j: usize| space.layout.of_element::<OF_BALL>(j);
        let kinematic = || space.kinematic_speeds(inputs)[0];
        let ratio = |speed: f64| if kinematic() == 0.0 { 0.0 } else { speed / kinematic() };
        match source {
            Source::Cage(source) => self.cage(source),
            Source::Rollers(source) => space.rollers_value(source, ws),
            Source::OnRing(k) => {
                let by_machine = [ForceSource::Gravity, ForceSource::Load, ForceSource::Support]
                    .map(|source| source as usize);
                let sources = self.forces.bodies[1].iter().enumerate();
                let touching = sources.filter(|(source, _)| !by_machine.contains(source));
                touching.map(|(_, force)| force[k]).sum()
            }
            Source::Ring(k) => space.ring.state(q, v, inputs).position[k],
            Source::DragTorque | Source::OuterRingTorque | Source::OuterDragTorque => {
                space.torque(source, ws)
            }
            Source::Viscosity => space.inputs.viscosity(inputs).unwrap_or(f64::NAN),
            Source::MeanOrbitRatio => {
                let count = space.set.count;
                ratio((0..count).map(|j| v[of_ball(j)[2]]).sum::<f64>() / count as f64)
            }
            Source::OrbitAngle(j) => {
                let travel = if space.free { q[of_ball(j)[2]] } else { inputs.orbit_travel() };
                space.set.reference_angles[j] + travel
            }
            Source::OrbitRatio(j) => ratio(v[of_ball(j)[2]]),
            Source::Pitch(j) | Source::Yaw(j) => {
                let [_, _, orbit, wx, wr, wt] = of_ball(j).map(|place| v[place]);
                let own = orbit - wx;
                let across = if matches!(source, Source::Pitch(_)) { wr } else { wt };
                if own == 0.0 { 0.0 } else { math::atan2(across * own.signum(), own.abs()) }
            }
            Source::Contact(place, k, j) => self.contact(k, j)[place],
            Source::SlidingPower(k, j) => {
                let values = self.contact(k, j);
                let product = |place: usize| values[FRICTION + place] * values[SLIP + place];
                -(0..5).map(product).sum::<f64>()
            }
            Source::Shoulder(k, j) => {
                let values = self.contact(k, j);
                if values[NORMAL_FORCE] > 0.0 {
                    -space.races[k].beyond_shoulder(values[CONTACT_ANGLE], values[HALF_AXIS]).unwrap_or(0.0)
                } else {
                    0.0
                }
            }
        }
    }
}
