//! Names of the coordinates of the modes of an elastic cage.

use crate::bodies::{Coordinate, Moves};
use crate::scene::MOST_RING_ORDERS;

/// Names of A and B of an order, and of their rates.
type Names = [[&'static str; 2]; 2];

macro_rules! names {
    ($($order:literal)*) => {
        [$([
            [concat!("mode[", $order, "].a"), concat!("mode[", $order, "].a_rate")],
            [concat!("mode[", $order, "].b"), concat!("mode[", $order, "].b_rate")],
        ]),*]
    };
}

/// From order 2 on.
const NAMES: [Names; MOST_RING_ORDERS as usize - 1] = names!(2 3 4 5 6 7 8 9 10 11 12 13 14 15 16);

/// What the waves are.
const WAVES: [[&str; 2]; 2] = [
    ["wave of the bent ring outwards at the angle of the cage", "rate of this wave"],
    ["wave of the bent ring outwards a quarter of a wave ahead", "rate of this wave"],
];

/// The coordinates of a pair of modes.
pub(in crate::bodies) fn of_mode(order: u32) -> [Coordinate; 2] {
    let names = NAMES[order as usize - 2];
    [0, 1].map(|wave| {
        let ([name, rate], [text, of_rate]) = (names[wave], WAVES[wave]);
        Coordinate { position: Some([name, "m", text]), rate: [rate, "m/s", of_rate], moves: Moves::Itself }
    })
}
