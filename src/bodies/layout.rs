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

use super::{CAGE, INNER_RING, SHARED};
use crate::integrate::Structure;
use crate::integrate::linear::HUB;

/// Velocities of a free element.
pub(crate) const OF_ELEMENT: usize = 3;

/// Places of the bodies in `q` and `v`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Layout {
    /// First coordinate of each shared body, if it is free.
    shared: [Option<usize>; SHARED],
    /// Number of coordinates of each shared body.
    widths: [usize; SHARED],
    /// First coordinate of the first roller.
    pub rollers: usize,
    /// Number of rollers.
    pub count: usize,
}

impl Layout {
    /// The layout of shared bodies with so many coordinates each and so many free rollers.
    pub(crate) fn new(widths: [usize; SHARED], count: usize) -> Self {
        let mut next = 0;
        let shared = widths.map(|width| {
            let first = next;
            next += width;
            (width > 0).then_some(first)
        });
        Self { shared, widths, rollers: next, count }
    }

    /// First coordinate of the inner ring, if it is free.
    pub fn ring(&self) -> Option<usize> {
        self.shared[INNER_RING]
    }

    /// First coordinate of the cage, if there is one.
    pub fn cage(&self) -> Option<usize> {
        self.shared[CAGE]
    }

    /// First coordinate of a shared body, if it is free.
    #[inline]
    pub(crate) fn shared(&self, body: usize) -> Option<usize> {
        self.shared[body]
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

    /// Velocities of roller `j`.
    #[inline]
    pub(crate) fn of_element(&self, j: usize) -> [usize; OF_ELEMENT] {
        [self.roller(j), self.roller(j) + 1, self.spin(j)]
    }

    /// Which velocities are coupled: shared bodies are the hub, rollers the spokes.
    pub(crate) fn structure(&self) -> Structure {
        Structure { hub: self.hub(), spokes: (0..self.count).map(|j| self.of_element(j)).collect() }
    }

    /// Velocity of each place of the hub.
    pub(crate) fn hub(&self) -> [Option<usize>; HUB] {
        let mut places = [None; HUB];
        for ((first, width), at) in self.shared.iter().zip(self.widths).zip(IN_HUB) {
            if let Some(first) = first {
                for k in 0..width {
                    places[at + k] = Some(first + k);
                }
            }
        }
        places
    }

    /// Number of groups of velocities of one body: rollers, then the shared bodies that are free.
    pub(crate) fn groups(&self) -> usize {
        self.count + self.shared.iter().flatten().count()
    }

    /// The shared body of a group behind the rollers.
    pub(crate) fn body_of_group(&self, i: usize) -> Option<usize> {
        let nth = i.checked_sub(self.count)?;
        (0..SHARED).filter(|&body| self.shared[body].is_some()).nth(nth)
    }

    /// Velocities of a group.
    pub(crate) fn group(&self, i: usize) -> [Option<usize>; 3] {
        if i < self.count {
            return self.of_element(i).map(Some);
        }
        let body = self.body_of_group(i);
        let first = body.and_then(|body| self.shared[body]);
        std::array::from_fn(|k| {
            first.filter(|_| body.is_some_and(|body| k < self.widths[body])).map(|first| first + k)
        })
    }
}

/// First place of each shared body in the hub of the linear systems. The outer ring has none.
pub(crate) const IN_HUB: [usize; SHARED] = [HUB, 0, 2];
