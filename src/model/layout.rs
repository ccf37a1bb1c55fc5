//! Order of the coordinates in the state vector.
//!
//! ```text
//! q = [ring y, z] [cage y, z, angle] [roller 0: rho, travel] [roller 1: rho, travel] ...
//! v = the rates of q in the same order, then [spin speed of roller 0] [of roller 1] ...
//! ```
//!
//! Blocks in brackets exist only if the scene has them: a fixed ring and an absent cage add nothing. The spin angle
//! of a roller enters no force, so only its speed is a state. The rate of position `i` is velocity `i`.
//!
//! The travel of a roller and the angle of the cage both count from the start, so the place of a roller in its pocket
//! is their difference and does not depend on where in the bearing it is.

/// Places of the bodies in `q` and `v`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Layout {
    /// First coordinate of the inner ring, if it is free.
    pub ring: Option<usize>,
    /// First coordinate of the cage, if there is one.
    pub cage: Option<usize>,
    /// First coordinate of the first roller.
    pub rollers: usize,
    /// Number of rollers.
    pub count: usize,
}

impl Layout {
    /// The layout for a scene with these bodies.
    pub fn new(free_ring: bool, cage: bool, count: usize) -> Self {
        let after_ring = if free_ring { 2 } else { 0 };
        let rollers = after_ring + if cage { 3 } else { 0 };
        Self { ring: free_ring.then_some(0), cage: cage.then_some(after_ring), rollers, count }
    }

    /// Number of positions.
    pub fn positions(&self) -> usize {
        self.rollers + 2 * self.count
    }

    /// Number of velocities.
    pub fn velocities(&self) -> usize {
        self.positions() + self.count
    }

    /// Length of the state vector (q, v).
    pub fn states(&self) -> usize {
        self.positions() + self.velocities()
    }

    /// Index of rho (and of its rate in `v`) of roller `j`; the travel follows.
    pub fn roller(&self, j: usize) -> usize {
        self.rollers + 2 * j
    }

    /// Index of the spin speed of roller `j` in `v`.
    pub fn spin(&self, j: usize) -> usize {
        self.positions() + j
    }
}
