//! What holds at an instant beside the powers, and is told as a share of the time.

use super::POWERS;

/// Largest pressure that a static load of a ball bearing may have, Pa (ISO 76).
pub const STATIC_LIMIT: f64 = 4.2e9;
/// The same of a roller bearing, Pa (ISO 76).
pub const STATIC_LIMIT_OF_ROLLERS: f64 = 4.0e9;

/// Something that holds or does not.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Condition {
    /// A law between rolling elements and raceways is at a floor that keeps it defined.
    AtFloor,
    /// An ellipse reaches beyond its shoulder.
    BeyondShoulder,
    /// A ball presses the side of the low shoulder of a bearing with a contact angle.
    OnLowShoulder,
    /// A pressure is above [`STATIC_LIMIT`].
    OverPressed,
    /// No ball presses the inner ring.
    Unloaded,
}

impl Condition {
    /// All of them, in their order behind the powers.
    pub(crate) const ALL: [Self; 5] =
        [Self::AtFloor, Self::BeyondShoulder, Self::OnLowShoulder, Self::OverPressed, Self::Unloaded];

    /// Its place among the rates: powers, then these, each 1 while it holds and else 0.
    pub(crate) const fn place(self) -> usize {
        POWERS.len() + self as usize
    }
}

/// Number of the powers and conditions.
pub(crate) const RATES: usize = POWERS.len() + Condition::ALL.len();
