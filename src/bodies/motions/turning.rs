//! Directions of all rolling elements.

use super::{ElementBlock, ElementSet, Motions};
use crate::scalar::elementary::{ANGLE_LARGEST, sin_cos};
use crate::scalar::{Columns, Pack, dispatch, math, place_of};
use crate::space::{Frame, rotate};
use pulp::Simd;
use std::f64::consts::TAU;

impl Motions {
    /// Finds the directions of the elements from their azimuths.
    pub(crate) fn find_directions(&mut self) {
        for block in &mut self.blocks {
            reduce(&mut block.azimuth);
        }
        dispatch(self.instructions, Directions { blocks: &mut self.blocks, count: self.count });
    }

    /// Sets the directions of elements that all have travelled by the same angle (rad).
    pub(crate) fn turn_together(&mut self, set: &ElementSet, travel: f64) {
        self.together = Some(travel);
        let (sin, cos) = math::sin_cos(travel);
        dispatch(self.instructions, Turn { blocks: &mut self.blocks, set, sin, cos });
    }
}

/// Brings angles into the range of sine and cosine.
#[inline]
pub(crate) fn reduce(angles: &mut [f64]) {
    for angle in angles.iter_mut().filter(|angle| angle.abs() > ANGLE_LARGEST) {
        *angle %= TAU;
    }
}

/// Turns the directions that the elements have at the start.
struct Turn<'a> {
    blocks: &'a mut [ElementBlock],
    set: &'a ElementSet,
    sin: f64,
    cos: f64,
}

impl Columns for Turn<'_> {
    fn rows(&self) -> usize {
        self.set.count
    }

    #[inline(always)]
    fn group<S: Simd, const K: usize>(&mut self, simd: S, first: usize) {
        let (block, lane) = place_of(first);
        let all = |x: f64| Pack::<S, K>::all(simd, x);
        let [sines, cosines] = &self.set.directions;
        let start = [Pack::load(simd, &cosines[first..]), Pack::load(simd, &sines[first..])];
        let [cos, sin] = rotate(start, all(self.sin), all(self.cos));
        self.blocks[block].frame.store(lane, Frame { sin, cos });
    }
}

struct Directions<'a> {
    blocks: &'a mut [ElementBlock],
    count: usize,
}

impl Columns for Directions<'_> {
    fn rows(&self) -> usize {
        self.count
    }

    #[inline(always)]
    fn group<S: Simd, const K: usize>(&mut self, simd: S, first: usize) {
        let (block, lane) = place_of(first);
        let block = &mut self.blocks[block];
        let (sin, cos) = sin_cos(Pack::<S, K>::load(simd, &block.azimuth[lane..]));
        block.frame.store(lane, Frame { sin, cos });
    }
}
