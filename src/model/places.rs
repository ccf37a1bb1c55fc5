//! Places of all rolling elements, in columns: their directions, their distances from the inner raceway and their
//! offsets in the pockets.

use super::workspace::ElementSite;
use crate::contact::pocket::PocketPlace;
use crate::contact::raceway::{RacewayGeometry, RollerMotion};
use crate::contact::rotate;
use crate::scalar::elementary::{ANGLE_LARGEST, sin_cos};
use crate::scalar::{Columns, Pack, WIDEST, dispatch};
use pulp::{Arch, Simd};
use std::f64::consts::TAU;

/// The columns. The first three are given, the others found from them; what is beyond the last element is of no meaning.
#[derive(Clone, Debug)]
pub(super) struct Places {
    /// Offset from the pitch circle, m.
    pub(super) radial_offset: Vec<f64>,
    /// Direction from the centre, rad.
    pub(super) azimuth: Vec<f64>,
    /// Angle by which the element leads its pocket, rad.
    pub(super) lead: Vec<f64>,
    /// Sine and cosine of the azimuth.
    pub(super) direction: [Vec<f64>; 2],
    /// Sine and cosine of the lead; 0 and 1 without pockets.
    pub(super) lead_direction: [Vec<f64>; 2],
    /// Approach to the inner raceway, m.
    pub(super) inner_approach: Vec<f64>,
    /// Centre relative to the pocket, pocket frame, m; zero without pockets.
    pub(super) pocket_offset: [Vec<f64>; 2],
}

/// What places are relative to.
#[derive(Clone, Copy)]
pub(super) struct Surroundings<'a> {
    /// Raceways, and the centre of the inner ring, m.
    pub(super) raceways: (&'a RacewayGeometry, [f64; 2]),
    /// Pockets, and the centre of the cage, m.
    pub(super) pockets: Option<(PocketPlace, [f64; 2])>,
}

impl Places {
    /// Room for this many elements.
    pub(super) fn new(elements: usize) -> Self {
        let zero = vec![0.0; elements.next_multiple_of(WIDEST)];
        let one = vec![1.0; zero.len()];
        Self {
            radial_offset: zero.clone(),
            azimuth: zero.clone(),
            lead: zero.clone(),
            direction: [zero.clone(), one.clone()],
            lead_direction: [zero.clone(), one],
            inner_approach: zero.clone(),
            pocket_offset: [zero.clone(), zero],
        }
    }

    /// Finds the places of the first `n` elements.
    pub(super) fn find(&mut self, n: usize, around: Surroundings<'_>, instructions: Arch) {
        let angles = self.azimuth[..n].iter_mut().chain(&mut self.lead[..n]);
        for angle in angles.filter(|angle| angle.abs() > ANGLE_LARGEST) {
            *angle %= TAU;
        }
        dispatch(instructions, Find { places: self, n, around });
    }

    /// Element `j` with its motion.
    #[inline]
    pub(super) fn site(&self, j: usize, motion: RollerMotion<f64>) -> ElementSite {
        let at = |[a, b]: &[Vec<f64>; 2]| [a[j], b[j]];
        let ([sin, cos], [lead_sin, lead_cos]) = (at(&self.direction), at(&self.lead_direction));
        let pocket_offset = at(&self.pocket_offset);
        ElementSite { motion, sin, cos, lead: (lead_sin, lead_cos), pocket_offset }
    }
}

struct Find<'a> {
    places: &'a mut Places,
    n: usize,
    around: Surroundings<'a>,
}

impl Columns for Find<'_> {
    fn rows(&self) -> usize {
        self.n
    }

    #[inline(always)]
    fn group<S: Simd, const K: usize>(&mut self, simd: S, first: usize) {
        let Self { places, around, .. } = self;
        let all = |x: f64| Pack::<S, K>::all(simd, x);
        let radial_offset = Pack::load(simd, &places.radial_offset[first..]);
        let (sin, cos) = sin_cos(Pack::load(simd, &places.azimuth[first..]));
        sin.store(&mut places.direction[0][first..]);
        cos.store(&mut places.direction[1][first..]);
        let (geometry, ring) = around.raceways;
        let ring = rotate([all(ring[0]), all(ring[1])], -sin, cos);
        geometry.inner_approach(radial_offset, ring).store(&mut places.inner_approach[first..]);
        if let Some((place, cage)) = around.pockets {
            let (lead_sin, lead_cos) = sin_cos(Pack::load(simd, &places.lead[first..]));
            lead_sin.store(&mut places.lead_direction[0][first..]);
            lead_cos.store(&mut places.lead_direction[1][first..]);
            let cage = rotate(rotate([all(cage[0]), all(cage[1])], -sin, cos), lead_sin, lead_cos);
            let offset = place.offset(radial_offset, (lead_sin, lead_cos), cage);
            offset[0].store(&mut places.pocket_offset[0][first..]);
            offset[1].store(&mut places.pocket_offset[1][first..]);
        }
    }
}
