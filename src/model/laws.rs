//! The force laws of a model, and the names under which their evaluations are counted.

use super::law_columns::KINDS;
use crate::contact::cylinder_pocket::CylinderPocket;
use crate::contact::plane_pocket::PlanePocket;
use crate::contact::pocket::PocketPlace;
use crate::laws::guide::GuideLaw;
use crate::laws::line_contact::LineContact;
use crate::laws::solid_contact::SolidContact;

/// All laws of a model; what the scene does not ask for is `None`.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Laws {
    pub(super) raceways: Option<RacewayLaws>,
    pub(super) pocket: Option<PocketLaws>,
    pub(super) guide: Option<GuideLaw>,
}

/// Contacts of rollers with the rings.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct RacewayLaws {
    pub(super) outer: LineContact,
    pub(super) inner: LineContact,
}

/// Contacts of elements with their pockets.
#[expect(clippy::large_enum_variant, reason = "one per model")]
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum PocketLaws {
    Cylinder(CylinderLaws),
    Plane(PlaneLaws),
}

impl PocketLaws {
    pub(super) fn place(&self) -> PocketPlace {
        match self {
            Self::Cylinder(laws) => laws.shape.place,
            Self::Plane(laws) => laws.shape.place,
        }
    }
}

#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct CylinderLaws {
    pub(super) shape: CylinderPocket,
    /// With the friction of edges.
    pub(super) wall: LineContact,
}

#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct PlaneLaws {
    pub(super) shape: PlanePocket,
    pub(super) contact: SolidContact,
}

/// Laws of line contacts by kind, for the batches of contacts.
pub(super) struct LineLaws {
    pub(super) raceways: Option<[LineContact; KINDS]>,
    pub(super) pockets: Option<[LineContact; KINDS]>,
    /// Whether pockets are among the first.
    pub(super) joined: bool,
}

impl Laws {
    /// Raceways and pockets in one batch if their laws have the same parts.
    pub(super) fn of_lines(&self) -> LineLaws {
        let raceways = self.raceways.map(|laws| [laws.outer, laws.inner]);
        let wall = match &self.pocket {
            Some(PocketLaws::Cylinder(laws)) => Some(laws.wall),
            Some(PocketLaws::Plane(_)) | None => None,
        };
        let joined = match (raceways, wall) {
            (Some([outer, inner]), Some(wall)) => outer
                .alike(&wall)
                .and_then(|[outer, wall]| inner.alike(&wall).map(|[inner, wall]| [outer, inner, wall])),
            _ => None,
        };
        LineLaws {
            raceways: joined.or(raceways.map(|[outer, inner]| [outer, inner, outer])),
            pockets: if joined.is_some() { None } else { wall.map(|wall| [wall; KINDS]) },
            joined: joined.is_some(),
        }
    }
}

/// Laws whose evaluations are counted.
pub const LAWS: [&str; 13] = [
    "outer_raceway",
    "inner_raceway",
    "pocket_wall",
    "pocket_edge",
    "pocket_plane",
    "film_thickness",
    "traction",
    "self_heating",
    "lubrication_regime",
    "rolling_resistance",
    "guide_film",
    "guide_solid",
    "viscosity_temperature",
];

/// Counts by law, in the order of [`LAWS`].
pub type LawCounts = [u64; LAWS.len()];

pub(super) const OUTER_RACEWAY: usize = 0;
pub(super) const INNER_RACEWAY: usize = 1;
pub(super) const POCKET_WALL: usize = 2;
pub(super) const POCKET_EDGE: usize = 3;
pub(super) const POCKET_PLANE: usize = 4;
/// The first of the laws that are parts of a line contact.
const FIRST_PART: usize = 5;
pub(super) const GUIDE_FILM: usize = 10;
pub(super) const GUIDE_SOLID: usize = 11;
pub(super) const VISCOSITY_TEMPERATURE: usize = 12;

/// Adds `n` evaluations of the laws in a line contact.
pub(super) fn count_parts(counts: &mut LawCounts, contact: &LineContact, n: u64) {
    for (part, (_, present)) in (FIRST_PART..).zip(line_contact_parts(contact)) {
        counts[part] += if present { n } else { 0 };
    }
}

/// The optional laws in a line contact, in the order of [`LAWS`], and whether they are there.
pub(super) fn line_contact_parts(contact: &LineContact) -> [(&'static str, bool); 5] {
    [
        ("film_thickness", contact.film.is_some()),
        ("traction", contact.traction.is_some()),
        ("self_heating", contact.self_heating.is_some()),
        ("lubrication_regime", contact.regime.is_some()),
        ("rolling_resistance", contact.rolling_resistance.is_some()),
    ]
}
