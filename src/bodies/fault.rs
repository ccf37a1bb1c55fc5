//! States at which forces are undefined.

use crate::registry::registry;

/// Speed of sound in a steel bar, m/s. Nothing in a bearing moves as fast.
pub(crate) const SOUND: f64 = 5e3;

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
        /// Which way: "radial" or "axial".
        way: &'static str,
        /// Offset from the pitch circle that way, m.
        offset: f64,
    },
    /// The axis of a roller is turned further than that of a roller in a bearing can be.
    AskewRoller {
        /// Number of the roller.
        roller: usize,
        /// Angle of its axis to that of the bearing, rad.
        angle: f64,
    },
    /// A ball has left the groove of a raceway, or its contact is wider than the groove.
    LostBall {
        /// Number of the ball.
        ball: usize,
        /// Name of the contact.
        race: &'static str,
        /// Elastic approach delta there, m; negative where they are apart.
        approach: f64,
    },
    /// A rolling element is further round from its pocket than its own radius, where no law describes what it touches.
    OutOfPocket {
        /// Number of the element.
        element: usize,
        /// Angle by which it leads the pocket, rad.
        lead: f64,
    },
    /// A rolling element is outside of the height of its pocket.
    AbovePocket {
        /// Number of the element.
        element: usize,
        /// How far it is outside of the pitch circle, in the axes of the pocket, m; negative inside.
        distance: f64,
    },
    /// A ring has left the bearing.
    LostRing {
        /// 0 for the outer one, 1 for the inner one.
        ring: usize,
        /// Distance of its centre from that of the outer ring, or of that from the centre of the bearing, and the most that rollers could let it have, m.
        distance: f64,
        /// See `distance`.
        reach: f64,
    },
    /// The rotor has left its shaft.
    LostRotor {
        /// Distance of its centre from that of the outer ring, and the most that it may have, m.
        distance: f64,
        /// See `distance`.
        reach: f64,
    },
    /// The cage has left the bearing.
    LostCage,
    /// Rollers that nothing keeps apart go through each other.
    Overlap {
        /// Number of the roller; the other is the next one.
        roller: usize,
        /// Number of the next one.
        next: usize,
        /// By how much they overlap, m.
        depth: f64,
    },
    /// The film of the guide has given more energy than came in and was there: its law is not passive.
    EnergyCreated {
        /// Work of the film, and all that loads, drives and the start could give, J.
        given: f64,
        /// See `given`.
        available: f64,
    },
    /// Something moves faster than sound does in steel.
    TooFast {
        /// Index of its velocity.
        velocity: usize,
        /// m/s; of a rotation that of its surface, of an orbit that of its centre.
        speed: f64,
    },
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
        Overlap = "overlap",
        TooFast = "too_fast",
        EnergyCreated = "energy_created",
        LostBall = "lost_ball",
        AbovePocket = "above_pocket",
        AskewRoller = "askew_roller",
        LostRotor = "lost_rotor",
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
            Self::LostRing { .. } => FaultKind::LostRing,
            Self::LostRotor { .. } => FaultKind::LostRotor,
            Self::LostCage => FaultKind::LostCage,
            Self::NotFinite { .. } => FaultKind::NotFinite,
            Self::NoSlope { .. } => FaultKind::NoSlope,
            Self::OutOfPocket { .. } => FaultKind::OutOfPocket,
            Self::Overlap { .. } => FaultKind::Overlap,
            Self::TooFast { .. } => FaultKind::TooFast,
            Self::EnergyCreated { .. } => FaultKind::EnergyCreated,
            Self::LostBall { .. } => FaultKind::LostBall,
            Self::AbovePocket { .. } => FaultKind::AbovePocket,
            Self::AskewRoller { .. } => FaultKind::AskewRoller,
        };
        kind as usize
    }
}
