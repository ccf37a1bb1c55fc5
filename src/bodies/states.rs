//! What is in the state vector, by the coordinates of the bodies, and where.

use super::{Coordinate, Elements, Layout, Node, SharedBodies};

/// The layout of these bodies.
pub(crate) fn layout_of(bodies: &SharedBodies, elements: &dyn Elements, nodes: &[Box<dyn Node>]) -> Layout {
    let widths = bodies.each_ref().map(|body| body.as_ref().map_or(0, |b| b.coordinates().len()));
    let free = !elements.coordinates().is_empty();
    // Of the coordinates of shared bodies none is without position: such a state is one of a node.
    debug_assert!(
        bodies.iter().flatten().all(|body| body.coordinates().iter().all(|c| c.position.is_some()))
    );
    let nodes = nodes.iter().map(|node| node.states().len()).collect();
    let set = elements.set();
    let spins = elements.coordinates().iter().filter(|c| c.position.is_none()).count();
    let count = if free { set.count } else { 0 };
    Layout::new(widths, [count, elements.coordinates().len() - spins, spins], set.touching, nodes)
}

/// What a state of a coordinate is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum State {
    Position,
    Rate,
}

impl State {
    pub(crate) fn is_rate(self) -> bool {
        self == Self::Rate
    }
}

/// All states of bodies in order; those of nodes follow. What they are, their body and their coordinate.
pub(crate) fn states_of<'a>(
    bodies: &'a SharedBodies,
    elements: &'a dyn Elements,
) -> impl Iterator<Item = (State, String, &'a Coordinate)> + 'a {
    let (kind, count) = (elements.kind(), elements.set().count);
    let coordinates = move |states: &'static [State], with_position: bool| {
        let of_shared = bodies.iter().flatten().flat_map(|body| {
            body.coordinates().iter().map(|coordinate| (body.name().to_owned(), coordinate))
        });
        let of_elements = (0..count).flat_map(move |j| {
            elements.coordinates().iter().map(move |coordinate| (format!("{kind}[{j}]"), coordinate))
        });
        let chosen = of_shared.chain(of_elements).filter(move |(_, c)| c.position.is_some() == with_position);
        chosen
            .flat_map(|(body, coordinate)| states.iter().map(move |state| (*state, body.clone(), coordinate)))
    };
    // Rates follow in the order of the positions, then those of coordinates without position.
    let positions = coordinates(&[State::Position], true);
    positions.chain(coordinates(&[State::Rate], true)).chain(coordinates(&[State::Rate], false))
}
