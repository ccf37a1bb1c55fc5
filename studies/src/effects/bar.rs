//! Length of a bar that shows a cost.

/// Longest cost whose bar is drawn as it is; what is more gets a mark.
const LARGEST: f64 = 0.9;

/// A bar.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Bar {
    /// Length as a share of the room.
    pub length: f64,
    /// Whether a part of it is cut out.
    pub broken: bool,
}

impl Bar {
    /// Of a cost as a share of the evaluation: its own length, or all the room with a mark in it.
    pub fn new(cost: f64) -> Self {
        let broken = cost > 1.0;
        Self { length: if broken { 1.0 } else { LARGEST * cost.max(0.0) }, broken }
    }
}
