//! Contacts of a roller that skews and tilts: with raceways in slices, with ribs at its ends, with the bars of its pocket.
//!
//! Everything is seen in the axes (x, outwards, ahead) of the azimuth of the roller. A contact is one or more [`Spot`]s, each with its approach,
//! its slip and the wrenches of unit forces on the roller about its centre P. What acts on the mate about its own centre O is the
//! opposite, moved there: moment -(M + (P - O) x F).

mod bar;
mod end;
mod end_laws;
mod laws;
mod shapes;
mod slice;

pub(crate) use bar::Bars;
pub(crate) use end_laws::{EndPair, ends};
pub(crate) use laws::{SliceLaws, SpotForces, SpotLaw};
pub(crate) use shapes::Shapes;
pub(crate) use slice::OnRaceway;

use super::line_laws::LawBuilder;
use super::pocket::cylinder;
use super::raceway::Cones;
use crate::error::Result;
use crate::laws::elastic::solid::SolidContact;
use crate::scene::{Pocket, Scene};
use crate::space::solid::Vector;
use bar::BarShape;

pub(crate) use crate::bodies::MovingRoller;

/// Bars of the cage of a scene with rollers, and their law, with the lubricant at `viscosity` in Pa s.
pub(crate) fn bars(scene: &Scene, viscosity: Option<f64>) -> Result<Option<(Bars, SpotLaw)>> {
    let Some((cage, pocket)) = scene.cage.as_ref().and_then(|cage| Some((cage, cage.pocket.as_ref()?)))
    else {
        return Ok(None);
    };
    let (pitch, radius) = (scene.pitch_radius(), (scene.element_radius(), Cones::new(scene.taper())));
    match pocket {
        Pocket::LubricatedCylinder(of) => {
            let law = cylinder::law_of(&LawBuilder::new(scene, viscosity), cage, of)?;
            let shape = BarShape::Cylinders { half_angle: of.half_angle, edge_blend: of.edge_blend };
            Ok(Some((Bars::new(pitch, radius, of.radial_clearance, shape), SpotLaw::Line(law))))
        }
        Pocket::SolidPlane(of) => {
            let law = SolidContact::from(&of.contact);
            let bars = Bars::new(pitch, radius, 0.5 * of.diametral_clearance, BarShape::Planes);
            Ok(Some((bars, SpotLaw::Solid(law))))
        }
        Pocket::SolidCylinder(_) | Pocket::SolidSphere(_) => Ok(None),
    }
}

/// Force and moment about the centre of the roller, per unit of a force.
pub(crate) type UnitWrench<T> = [Vector<T>; 2];

/// Numbers of a [`Spot`].
pub(crate) const NUMBERS: usize = 31;

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

impl<T: Copy> Spot<T> {
    /// All of its numbers.
    #[inline(always)]
    pub(crate) fn numbers(&self) -> [T; NUMBERS] {
        let mut out = [self.delta; NUMBERS];
        (out[1], [out[2], out[3]], out[4]) = (self.delta_dot, self.surface_speeds, self.entrainment);
        [out[5], out[6]] = self.slip;
        let wrenches = [self.normal, self.along, self.across, self.rolling];
        for (i, [force, moment]) in wrenches.iter().enumerate() {
            for k in 0..3 {
                (out[7 + 6 * i + k], out[10 + 6 * i + k]) = (force[k], moment[k]);
            }
        }
        out
    }

    /// One with these numbers.
    #[inline(always)]
    pub(crate) fn of_numbers(number: impl Fn(usize) -> T) -> Self {
        let vector = |k: usize| [number(k), number(k + 1), number(k + 2)];
        let wrench = |k: usize| [vector(k), vector(k + 3)];
        Self {
            delta: number(0),
            delta_dot: number(1),
            surface_speeds: [number(2), number(3)],
            entrainment: number(4),
            slip: [number(5), number(6)],
            normal: wrench(7),
            along: wrench(13),
            across: wrench(19),
            rolling: wrench(25),
        }
    }
}
