//! Places of all rolling elements, in columns: what pairs look at to find contacts.

use super::ElementSet;
use crate::scalar::elementary::{ANGLE_LARGEST, sin_cos};
use crate::scalar::{Columns, Pack, WIDEST, dispatch, math};
use crate::space::{Frame, rotate};
use pulp::{Arch, Simd};
use std::f64::consts::TAU;

/// The columns, as long as whole groups of vector instructions need; what is beyond the last element is of no meaning.
#[derive(Clone, Debug)]
pub(crate) struct Places {
    /// Offset from the pitch circle, m.
    pub(crate) radial_offset: Vec<f64>,
    /// Direction from the centre, rad; of elements that move freely.
    pub(crate) azimuth: Vec<f64>,
    /// Angle travelled since the start, rad.
    pub(crate) travel: Vec<f64>,
    /// The travel of all elements, where it is the same.
    pub(crate) together: Option<f64>,
    /// Sine and cosine of the azimuth.
    pub(crate) direction: [Vec<f64>; 2],
}

impl Places {
    /// Room for this many elements.
    pub(crate) fn new(elements: usize) -> Self {
        let zero = vec![0.0; elements.next_multiple_of(WIDEST)];
        let one = vec![1.0; zero.len()];
        Self {
            radial_offset: zero.clone(),
            azimuth: zero.clone(),
            travel: zero.clone(),
            together: None,
            direction: [zero, one],
        }
    }

    /// Finds the directions of the first `n` elements from their azimuths.
    pub(crate) fn find_directions(&mut self, n: usize, instructions: Arch) {
        reduce(&mut self.azimuth[..n]);
        dispatch(instructions, Directions { places: self, n });
    }

    /// Frame of element `j`.
    #[inline]
    pub(crate) fn frame(&self, j: usize) -> Frame<f64> {
        Frame { sin: self.direction[0][j], cos: self.direction[1][j] }
    }

    /// Sets the directions of elements that all have travelled by the same angle (rad).
    pub(crate) fn turn_together(&mut self, set: &ElementSet, travel: f64, instructions: Arch) {
        self.together = Some(travel);
        let (sin, cos) = math::sin_cos(travel);
        dispatch(instructions, Turn { places: self, set, sin, cos });
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
    places: &'a mut Places,
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
        let all = |x: f64| Pack::<S, K>::all(simd, x);
        let [sines, cosines] = &self.set.directions;
        let start = [Pack::load(simd, &cosines[first..]), Pack::load(simd, &sines[first..])];
        let [cos, sin] = rotate(start, all(self.sin), all(self.cos));
        sin.store(&mut self.places.direction[0][first..]);
        cos.store(&mut self.places.direction[1][first..]);
    }
}

struct Directions<'a> {
    places: &'a mut Places,
    n: usize,
}

impl Columns for Directions<'_> {
    fn rows(&self) -> usize {
        self.n
    }

    #[inline(always)]
    fn group<S: Simd, const K: usize>(&mut self, simd: S, first: usize) {
        let places = &mut *self.places;
        let (sin, cos) = sin_cos(Pack::<S, K>::load(simd, &places.azimuth[first..]));
        sin.store(&mut places.direction[0][first..]);
        cos.store(&mut places.direction[1][first..]);
    }
}
