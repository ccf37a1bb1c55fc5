//! How far a step may pass the onset of a solid contact: a share of the time in which it turns a body, or of the depth over
//! which its damper sets in.

use crate::integrate::Tuning;
use crate::laws::elastic::solid::SolidContact;

/// How far a step may pass the onset of a solid contact.
pub(super) struct Passage {
    /// Share of the time in which it turns a body, s.
    turn: f64,
    /// Share of the depth over which its damper sets in, m.
    depth: f64,
}

impl Passage {
    /// For a body of `mass` kg.
    pub(super) fn of(contact: &SolidContact, mass: f64, tuning: &Tuning) -> Self {
        let turn = if contact.stiffness > 0.0 { (mass / contact.stiffness).sqrt() } else { 0.0 };
        Self { turn: tuning.turn_share * turn, depth: tuning.onset_share * contact.softening_depth }
    }

    /// In s, at this speed in m/s.
    pub(super) fn time(&self, speed: f64) -> f64 {
        self.turn.max(self.depth / speed)
    }
}
