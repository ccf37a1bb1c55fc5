//! States at which forces are undefined.

use super::Model;

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
        /// The contact it comes from, if it is one: its place in [`Model::contact_names`].
        contact: Option<usize>,
    },
    /// A derivative of an acceleration over the state is not a finite number.
    NoSlope {
        /// Index of the velocity whose rate it is.
        velocity: usize,
    },
}

/// The kinds of [`Fault`].
pub const FAULTS: [&str; 8] = [
    "no_guide_film",
    "no_viscosity",
    "lost_roller",
    "lost_ring",
    "lost_cage",
    "not_finite",
    "no_slope",
    "out_of_pocket",
];

/// Number of faults of each kind, in the order of [`FAULTS`].
pub type FaultCounts = [u64; FAULTS.len()];

impl Fault {
    /// Place of its kind in [`FAULTS`].
    pub fn kind(&self) -> usize {
        match self {
            Self::NoGuideFilm { .. } => 0,
            Self::NoViscosity { .. } => 1,
            Self::LostRoller { .. } => 2,
            Self::LostRing => 3,
            Self::LostCage => 4,
            Self::NotFinite { .. } => 5,
            Self::NoSlope { .. } => 6,
            Self::OutOfPocket { .. } => 7,
        }
    }
}

impl Model {
    /// A fault in words.
    pub fn describe(&self, fault: Fault) -> String {
        match fault {
            Fault::NoGuideFilm { minimum_film } => {
                format!("no film between cage and guide (smallest thickness {minimum_film:e} m, must be > 0)")
            }
            Fault::NoViscosity { temperature } => {
                format!("the lubricant has no viscosity at its temperature {temperature:?} K")
            }
            Fault::LostRoller { roller, radial_offset } => {
                format!("roller[{roller}] has left the bearing (radial offset {radial_offset:e} m)")
            }
            Fault::OutOfPocket { element, lead } => {
                let kind = self.element_kind();
                format!("{kind}[{element}] is out of its pocket (ahead of it by {lead:e} rad)")
            }
            Fault::LostRing => "the inner ring has left the bearing".to_owned(),
            Fault::LostCage => "the cage has left the bearing".to_owned(),
            Fault::NotFinite { contact: Some(contact), .. } => {
                let names = self.contact_names();
                let name = names.get(contact).map_or("?", String::as_str);
                format!("the force of {name} is not a finite number")
            }
            Fault::NotFinite { velocity, contact: None } => {
                format!("the rate of {} is not a finite number", self.velocity_name(velocity))
            }
            Fault::NoSlope { velocity } => {
                let name = self.velocity_name(velocity);
                format!("a derivative of the rate of {name} is not a finite number")
            }
        }
    }

    fn velocity_name(&self, velocity: usize) -> String {
        let mut infos = self.state_infos().into_iter();
        infos.nth(self.layout().positions() + velocity).map_or("?".to_owned(), |info| info.name)
    }
}
