//! What models tell of states, inputs, quantities and energies: names, SI units and meanings.

use super::{plane, space};
use crate::model::feedthrough::Sees;

/// What a channel shows, by the bearing that it is of.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Source {
    Plane(plane::Source),
    Space(space::Source),
}

impl Source {
    /// What it is made of.
    pub(super) fn sees(self) -> Sees {
        match self {
            Self::Plane(source) => source.sees(),
            Self::Space(source) => source.sees(),
        }
    }
}

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

/// Name, unit and meaning of a reported quantity.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Quantity {
    /// Name.
    pub name: &'static str,
    /// SI unit; "1" for ratios.
    pub unit: &'static str,
    /// What it is.
    pub description: &'static str,
}

pub(crate) const fn quantity(name: &'static str, unit: &'static str, description: &'static str) -> Quantity {
    Quantity { name, unit, description }
}

/// A named output.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Channel {
    /// Name, for example `cage.y` or `roller[3].slip`.
    pub name: String,
    /// SI unit; "1" for ratios.
    pub unit: &'static str,
    /// What it is.
    pub description: &'static str,
    pub(super) source: Source,
    /// Whether records leave it out unless they name it.
    pub(super) detail: bool,
    /// Whether it can be followed in every step.
    pub(super) can_be_watched: bool,
}

/// Energy of a state, J.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Energy {
    /// Kinetic energy.
    pub kinetic: f64,
    /// Energy of contacts that are pressed together.
    pub elastic: f64,
    /// Potential energy of the weight; zero with all bodies at the centre.
    pub potential: f64,
}

impl Energy {
    /// All of it, J.
    pub fn total(&self) -> f64 {
        self.kinetic + self.elastic + self.potential
    }
}
