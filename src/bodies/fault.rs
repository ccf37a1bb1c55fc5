//! States at which forces are undefined.

use crate::registry::registry;

/// Why forces cannot be computed at a state.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Fault {
    /// The film between cage and guide is gone.
    NoGuideFilm {
        /// Smallest film thickness, m.
        minimum_film: f64,
    },
    /// The lubricant has no viscosity at its temperature.
    NoViscosity {
        /// K.
        temperature: f64,
    },
    /// A roller has left the space between the rings.
    LostRoller {
        /// Number of the roller.
        roller: usize,
        /// Offset from the pitch circle, m.
        radial_offset: f64,
    },
    /// A rolling element is further round from its pocket than its own radius, where no law describes what it touches.
    OutOfPocket {
        /// Number of the element.
        element: usize,
        /// Angle by which it leads the pocket, rad.
        lead: f64,
    },
    /// The inner ring has left the bearing.
    LostRing,
    /// The cage has left the bearing.
    LostCage,
    /// An acceleration is not a finite number.
    NotFinite {
        /// Index of the velocity whose rate it is.
        velocity: usize,
        /// The contact it comes from, if it is one: its place in [`crate::Model::contact_names`].
        contact: Option<usize>,
    },
    /// A derivative of an acceleration over the state is not a finite number.
    NoSlope {
        /// Index of the velocity whose rate it is.
        velocity: usize,
    },
}

registry! {
    /// Kind of a fault.
    pub(crate) enum FaultKind,
    /// The kinds of [`Fault`].
    pub const FAULTS {
        NoGuideFilm = "no_guide_film",
        NoViscosity = "no_viscosity",
        LostRoller = "lost_roller",
        LostRing = "lost_ring",
        LostCage = "lost_cage",
        NotFinite = "not_finite",
        NoSlope = "no_slope",
        OutOfPocket = "out_of_pocket",
    }
}

/// Number of faults of each kind, in the order of [`FAULTS`].
pub type FaultCounts = [u64; FAULTS.len()];

impl Fault {
    /// Place of its kind in [`FAULTS`].
    pub fn kind(&self) -> usize {
        let kind = match self {
            Self::NoGuideFilm { .. } => FaultKind::NoGuideFilm,
            Self::NoViscosity { .. } => FaultKind::NoViscosity,
            Self::LostRoller { .. } => FaultKind::LostRoller,
            Self::LostRing => FaultKind::LostRing,
            Self::LostCage => FaultKind::LostCage,
            Self::NotFinite { .. } => FaultKind::NotFinite,
            Self::NoSlope { .. } => FaultKind::NoSlope,
            Self::OutOfPocket { .. } => FaultKind::OutOfPocket,
        };
        kind as usize
    }
}
