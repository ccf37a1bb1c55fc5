//! Names of bodies, states, inputs and contacts.

use super::{Input, Model};

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
        names.extend((0..self.layout.count).map(|j| format!("roller[{j}]")));
        names
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
        Input::ALL
            .into_iter()
            .take(self.input_count())
            .map(|input| match input {
                Input::RingSpeed => {
                    StateInfo::new("inner_ring.speed", "rad/s", "rotation speed of the inner ring")
                }
                Input::LoadY => {
                    StateInfo::new("load.y", "N", "external load on the inner ring, to the right")
                }
                Input::LoadZ => StateInfo::new("load.z", "N", "external load on the inner ring, upwards"),
            })
            .collect()
    }

    /// Contacts per roller in force reports: two raceways and, if the scene has pockets, two pillars.
    pub(super) fn contacts_per_roller(&self) -> usize {
        if self.cage.as_ref().is_some_and(|c| c.pocket.is_some()) { 4 } else { 2 }
    }

    /// Names of all contacts that can exist, in the order of force reports.
    pub fn contact_names(&self) -> Vec<String> {
        let kinds = ["outer_raceway", "inner_raceway", "pocket_front", "pocket_back"];
        let kinds = &kinds[..self.contacts_per_roller()];
        (0..self.layout.count).flat_map(|j| kinds.iter().map(move |k| format!("roller[{j}].{k}"))).collect()
    }
}

const RIGHT: &str = "centre position to the right";
const UP: &str = "centre position upwards";
const RIGHT_SPEED: &str = "velocity of the centre to the right";
const UP_SPEED: &str = "velocity of the centre upwards";
