//! Names of bodies, states, inputs and contacts.

use super::laws::{PocketLaws, line_contact_parts};
use super::{Input, Model};
use crate::laws::line_contact::LineContact;

/// Name, unit and meaning of a state or an input.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct StateInfo {
    /// Name, for example `roller[3].orbit_travel`.
    pub name: String,
    /// SI unit; "1" for ratios.
    pub unit: &'static str,
    /// What it is.
    pub description: &'static str,
}

impl StateInfo {
    fn new(name: impl Into<String>, unit: &'static str, description: &'static str) -> Self {
        Self { name: name.into(), unit, description }
    }
}

impl Model {
    /// Names of the bodies, in the order of force reports: outer ring, inner ring, cage, rollers.
    pub fn body_names(&self) -> Vec<String> {
        let mut names = vec!["outer_ring".to_owned(), "inner_ring".to_owned()];
        if self.cage.is_some() {
            names.push("cage".to_owned());
        }
        let kind = self.element_kind();
        names.extend((0..self.elements.count).map(|j| format!("{kind}[{j}]")));
        names
    }

    /// What the elements are called in names.
    pub fn element_kind(&self) -> &'static str {
        if self.has_rollers() { "roller" } else { "element" }
    }

    /// The state vector: positions, then velocities.
    pub fn state_infos(&self) -> Vec<StateInfo> {
        let mut q = Vec::new();
        let mut v = Vec::new();
        if self.layout.ring.is_some() {
            q.push(StateInfo::new("inner_ring.y", "m", RIGHT));
            q.push(StateInfo::new("inner_ring.z", "m", UP));
            v.push(StateInfo::new("inner_ring.vy", "m/s", RIGHT_SPEED));
            v.push(StateInfo::new("inner_ring.vz", "m/s", UP_SPEED));
        }
        if self.layout.cage.is_some() {
            q.push(StateInfo::new("cage.y", "m", RIGHT));
            q.push(StateInfo::new("cage.z", "m", UP));
            q.push(StateInfo::new("cage.angle", "rad", "rotation angle since the start"));
            v.push(StateInfo::new("cage.vy", "m/s", RIGHT_SPEED));
            v.push(StateInfo::new("cage.vz", "m/s", UP_SPEED));
            v.push(StateInfo::new("cage.speed", "rad/s", "rotation speed"));
        }
        for j in 0..self.layout.count {
            let name = |field: &str| format!("roller[{j}].{field}");
            q.push(StateInfo::new(name("radial_offset"), "m", "distance outside the pitch circle"));
            q.push(StateInfo::new(
                name("orbit_travel"),
                "rad",
                "orbit angle travelled from the centred place of its pocket at the start",
            ));
            v.push(StateInfo::new(name("radial_speed"), "m/s", "rate of the radial offset"));
            v.push(StateInfo::new(name("orbit_speed"), "rad/s", "rate of the orbit angle"));
        }
        for j in 0..self.layout.count {
            v.push(StateInfo::new(
                format!("roller[{j}].spin_speed"),
                "rad/s",
                "rotation speed about its own axis",
            ));
        }
        q.append(&mut v);
        q
    }

    /// The inputs.
    pub fn input_infos(&self) -> Vec<StateInfo> {
        self.input_list()
            .map(|input| match input {
                Input::RingSpeed => {
                    StateInfo::new("inner_ring.speed", "rad/s", "rotation speed of the inner ring")
                }
                Input::LoadY => {
                    StateInfo::new("load.y", "N", "external load on the inner ring, to the right")
                }
                Input::LoadZ => StateInfo::new("load.z", "N", "external load on the inner ring, upwards"),
                Input::CageForceY => {
                    StateInfo::new("cage.force_y", "N", "external force on the cage, to the right")
                }
                Input::CageForceZ => {
                    StateInfo::new("cage.force_z", "N", "external force on the cage, upwards")
                }
                Input::CageTorque => StateInfo::new("cage.torque", "N m", "external torque on the cage"),
                Input::OrbitSpeed => {
                    StateInfo::new("elements.orbit_speed", "rad/s", "orbit speed of the rolling elements")
                }
                Input::SpinSpeed => {
                    StateInfo::new("elements.spin_speed", "rad/s", "spin speed of the rolling elements")
                }
                Input::Temperature => {
                    StateInfo::new("lubricant.temperature", "K", "temperature of the lubricant")
                }
            })
            .collect()
    }

    /// Contacts per element in force reports.
    pub(super) fn contacts_per_element(&self) -> usize {
        self.pocket_contact_offset() + if self.laws.pocket.is_some() { 2 } else { 0 }
    }

    /// Place of the first pocket contact among those of an element: after the raceways, if there are any.
    pub(super) fn pocket_contact_offset(&self) -> usize {
        if self.laws.raceways.is_some() { 2 } else { 0 }
    }

    /// Names of all contacts that can exist, in the order of force reports.
    pub fn contact_names(&self) -> Vec<String> {
        let mut kinds = Vec::new();
        if self.laws.raceways.is_some() {
            kinds.extend(["outer_raceway", "inner_raceway"]);
        }
        if self.laws.pocket.is_some() {
            kinds.extend(["pocket_front", "pocket_back"]);
        }
        let element = self.element_kind();
        (0..self.elements.count)
            .flat_map(|j| kinds.iter().map(move |kind| format!("{element}[{j}].{kind}")))
            .collect()
    }

    /// The laws that this scene uses, each with the largest number of contacts it can act in.
    pub fn laws_in_use(&self) -> Vec<(&'static str, usize)> {
        let n = self.elements.count;
        let mut list = Vec::new();
        let mut largest = |contact: &LineContact, contacts: usize| {
            for (name, present) in line_contact_parts(contact) {
                let known = list.iter_mut().find(|(known, _)| *known == name);
                match known {
                    Some((_, sum)) if present => *sum += contacts,
                    None if present => list.push((name, contacts)),
                    _ => {}
                }
            }
        };
        if let Some(raceways) = &self.laws.raceways {
            largest(&raceways.outer, n);
            largest(&raceways.inner, n);
        }
        if let Some(PocketLaws::Cylinder(pocket)) = &self.laws.pocket {
            largest(&pocket.wall, 2 * n);
        }
        let mut laws = Vec::new();
        if self.laws.raceways.is_some() {
            laws.extend([("outer_raceway", n), ("inner_raceway", n)]);
        }
        match &self.laws.pocket {
            None => {}
            Some(PocketLaws::Cylinder(_)) => laws.extend([("pocket_wall", 2 * n), ("pocket_edge", 2 * n)]),
            Some(PocketLaws::Plane(_)) => laws.push(("pocket_plane", 2 * n)),
        }
        laws.extend(list);
        if let Some(guide) = &self.laws.guide {
            laws.extend(guide.film.as_ref().map(|_| ("guide_film", 1)));
            laws.extend(guide.solid.as_ref().map(|_| ("guide_solid", 1)));
        }
        laws.extend(self.inputs.oil.map(|_| ("viscosity_temperature", 1)));
        laws
    }
}

const RIGHT: &str = "centre position to the right";
const UP: &str = "centre position upwards";
const RIGHT_SPEED: &str = "velocity of the centre to the right";
const UP_SPEED: &str = "velocity of the centre upwards";
