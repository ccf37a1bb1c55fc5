//! Contacts of a roller that skews and tilts: with raceways in slices, with ribs at its ends, with the bars of its pocket.
//!
//! Everything is seen in the axes (x, outwards, ahead) of the azimuth of the roller. A contact is one or more [`Spot`]s, each with its approach,
//! its slip and the wrenches of unit forces on the roller about its centre P. What acts on the mate about its own centre O is the
//! opposite, moved there: moment -(M + (P - O) x F).

mod bar;
mod laws;
mod slice;

pub(crate) use bar::{BarShape, BarTouch, Bars, InBars};
pub(crate) use laws::SliceLaws;
pub(crate) use slice::{Middle, OnRaceway};

use crate::space::solid::Vector;

pub(crate) use crate::bodies::MovingRoller;

/// Force and moment about the centre of the roller, per unit of a force.
pub(crate) type UnitWrench<T> = [Vector<T>; 2];

/// A place where a roller touches a mate.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Spot<T> {
    /// delta, m, and its rate, m/s.
    pub(crate) delta: T,
    pub(crate) delta_dot: T,
    /// Speeds of the surfaces of roller and mate past the contact, m/s: along t where it rolls, else their sizes.
    pub(crate) surface_speeds: [T; 2],
    /// Mean velocity of both surfaces past the contact, m/s: along t where it rolls, else its size.
    pub(crate) entrainment: T,
    /// Velocity of the surface of the roller against that of the mate along t and b, m/s.
    pub(crate) slip: [T; 2],
    /// Wrenches on the roller: of a normal force, of friction along t and along b, of rolling resistance.
    pub(crate) normal: UnitWrench<T>,
    pub(crate) along: UnitWrench<T>,
    pub(crate) across: UnitWrench<T>,
    pub(crate) rolling: UnitWrench<T>,
}
