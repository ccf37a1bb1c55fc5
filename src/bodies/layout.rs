//! Order of the coordinates in the state vector.
//!
//! ```text
//! q = [ring y, z] [cage y, z, angle] [element 0: rho, travel] [element 1: rho, travel] ...
//! v = the rates of q in the same order, then [spin speed of element 0] [of element 1] ... [states of node 0] ...
//! ```
//!
//! That is in the plane; in space a ring has up to five coordinates, and a ball x, rho and travel with three spin speeds.
//!
//! Blocks in brackets exist only if the scene has them: a fixed ring and an absent cage add nothing. The spin angle
//! of an element that is round enters no force, so only its speed is a state; of rollers with waves it is the third position of each.
//! The rate of position `i` is velocity `i`.
//!
//! The travel of an element and the angle of the cage both count from the start, so the place of an element in its pocket
//! is their difference and does not depend on where in the bearing it is.
//!
//! In linear systems the shared bodies are the hub, in the same order, with the nodes behind them, and the elements the spokes.

use super::{CAGE, INNER_RING, SHARED};
use crate::integrate::Structure;
use crate::scalar::{Lanes, WIDEST};
use std::ops::Range;

/// Velocities of a free element in the plane.
pub(crate) const OF_ELEMENT: usize = 3;

/// Places of the bodies in `q` and `v`.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Layout {
    /// First coordinate of each shared body, and how many there are.
    shared: [(usize, usize); SHARED],
    /// First coordinate of the first element.
    pub(in crate::bodies) elements: usize,
    /// Number of elements that move freely.
    pub count: usize,
    /// Positions of one of them, and velocities without position.
    of_element: [usize; 2],
    /// Whether elements touch their neighbours.
    touching: bool,
    /// Number of states of each node.
    nodes: Vec<usize>,
}

impl Layout {
    /// The layout of shared bodies with so many coordinates each, so many free elements with so many positions and speeds without
    /// position, which may touch their neighbours, and nodes with so many states each.
    pub(crate) fn new(
        widths: [usize; SHARED],
        [count, positions, spins]: [usize; 3],
        touching: bool,
        nodes: Vec<usize>,
    ) -> Self {
        let mut next = 0;
        let shared = widths.map(|width| {
            next += width;
            (next - width, width)
        });
        Self { shared, elements: next, count, of_element: [positions, spins], touching, nodes }
    }

    /// First coordinate of the inner ring, if it is free.
    pub fn ring(&self) -> Option<usize> {
        self.shared(INNER_RING)
    }

    /// First coordinate of the cage, if there is one.
    pub fn cage(&self) -> Option<usize> {
        self.shared(CAGE)
    }

    /// First coordinate of a shared body, and its first place in the hub, if it is free; that of no body is none.
    #[inline]
    pub(crate) fn shared(&self, body: usize) -> Option<usize> {
        let (first, width) = self.shared.get(body).copied().unwrap_or_default();
        (width > 0).then_some(first)
    }

    /// Coordinates of a shared body; none if it is not free.
    #[inline]
    pub(crate) fn range(&self, body: usize) -> Range<usize> {
        let (first, width) = self.shared.get(body).copied().unwrap_or_default();
        first..first + width
    }

    /// Index of the first state of the nodes in `v`.
    fn first_of_nodes(&self) -> usize {
        self.positions() + self.of_element[1] * self.count
    }

    /// Number of states of all nodes.
    #[inline]
    pub(crate) fn of_nodes(&self) -> usize {
        self.nodes.iter().sum()
    }

    /// States of each node in `v`.
    pub(crate) fn nodes(&self) -> impl Iterator<Item = Range<usize>> {
        self.nodes.iter().scan(self.first_of_nodes(), |next, width| {
            *next += width;
            Some(*next - width..*next)
        })
    }

    /// Place in the hub of a state of the nodes.
    pub(crate) fn in_hub(&self, node_state: usize) -> usize {
        self.elements + node_state - self.first_of_nodes()
    }

    /// Number of coordinates of all shared bodies.
    #[inline]
    pub(crate) fn of_shared(&self) -> usize {
        self.elements
    }

    /// Number of places in the hub.
    #[inline]
    pub(crate) fn hub(&self) -> usize {
        self.elements + self.of_nodes()
    }

    /// The shared bodies that are free.
    pub(crate) fn free(&self) -> impl Iterator<Item = usize> {
        let shared = self.shared;
        (0..SHARED).filter(move |body| shared[*body].1 > 0)
    }

    /// Number of positions.
    pub fn positions(&self) -> usize {
        self.elements + self.of_element[0] * self.count
    }

    /// Number of velocities.
    pub fn velocities(&self) -> usize {
        self.first_of_nodes() + self.of_nodes()
    }

    /// Length of the state vector (q, v).
    pub fn states(&self) -> usize {
        self.positions() + self.velocities()
    }

    /// Index of rho (and of its rate in `v`) of element `j`; the travel follows.
    pub fn element(&self, j: usize) -> usize {
        self.elements + self.of_element[0] * j
    }

    /// Index of the first spin speed of element `j` in `v`.
    pub fn spin(&self, j: usize) -> usize {
        match self.of_element {
            [positions, 0] => self.element(j) + positions.saturating_sub(1),
            [_, spins] => self.positions() + spins * j,
        }
    }

    /// Whether the spin angles of elements in the plane are positions.
    #[inline]
    pub(in crate::bodies) fn has_spin_angles(&self) -> bool {
        self.of_element == [OF_ELEMENT, 0]
    }

    /// Velocities of element `j`.
    #[inline]
    pub(crate) fn of_element<const N: usize>(&self, j: usize) -> [usize; N] {
        let (first, spin, [positions, spins]) = (self.element(j), self.spin(j), self.of_element);
        debug_assert_eq!(positions + spins, N);
        std::array::from_fn(|k| if k < positions { first + k } else { spin + k - positions })
    }

    /// Brings the rates of the elements of a block in the plane from `v` into columns: radial, orbital, of the spin.
    #[inline]
    pub(crate) fn rates_of_block(
        &self,
        v: &[f64],
        block: usize,
        [radial, orbital, spin]: [&mut Lanes; OF_ELEMENT],
    ) {
        let here = self.in_block(block);
        let of_elements = &v[self.elements..];
        if self.has_spin_angles() {
            let rows = &of_elements.as_chunks::<OF_ELEMENT>().0[here];
            for (i, row) in rows.iter().enumerate().take(WIDEST) {
                [radial[i], orbital[i], spin[i]] = *row;
            }
            return;
        }
        let (rates, spins) = of_elements.split_at(2 * self.count);
        for (i, row) in rates.as_chunks::<2>().0[here.clone()].iter().enumerate().take(WIDEST) {
            [radial[i], orbital[i]] = *row;
        }
        spin.iter_mut().zip(&spins[here]).for_each(|(to, spin)| *to = *spin);
    }

    /// Brings the places of the elements of a block in the plane from `q` into columns: radial offset, travel; and adds the spin
    /// angles that are positions.
    #[inline]
    pub(in crate::bodies) fn places_of_block(
        &self,
        q: &[f64],
        block: usize,
        [offset, travel]: [&mut Lanes; 2],
        spin_angles: &mut Vec<f64>,
    ) {
        let here = self.in_block(block);
        let of_elements = &q[self.elements..];
        if self.has_spin_angles() {
            let rows = &of_elements.as_chunks::<OF_ELEMENT>().0[here];
            for (i, [rho, psi, angle]) in rows.iter().enumerate().take(WIDEST) {
                (offset[i], travel[i]) = (*rho, *psi);
                spin_angles.push(*angle);
            }
            return;
        }
        for (i, row) in of_elements.as_chunks::<2>().0[here].iter().enumerate().take(WIDEST) {
            [offset[i], travel[i]] = *row;
        }
    }

    /// The elements of a block.
    #[inline]
    fn in_block(&self, block: usize) -> Range<usize> {
        block * WIDEST..self.count.min((block + 1) * WIDEST)
    }

    /// Which velocities are coupled: shared bodies are the hub, elements the spokes.
    pub(crate) fn structure<const N: usize>(&self) -> Structure<N> {
        let of_nodes = self.nodes().map(|states| self.in_hub(states.start)..self.in_hub(states.end));
        Structure {
            hub: (0..self.elements).chain(self.first_of_nodes()..self.velocities()).collect(),
            bodies: self.free().map(|body| self.range(body)).chain(of_nodes).collect(),
            spokes: (0..self.count).map(|j| self.of_element(j)).collect(),
            rim: self.touching,
        }
    }

    /// What a group of velocities (see [`Structure::groups`]) belongs to.
    pub(crate) fn owner_of_group(&self, group: usize) -> Owner {
        let Some(nth) = group.checked_sub(self.count) else { return Owner::Element(group) };
        self.free().nth(nth).map_or_else(|| Owner::Node(nth - self.free().count()), Owner::Shared)
    }
}

/// What velocities belong to, by its place.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Owner {
    Element(usize),
    Shared(usize),
    Node(usize),
}
