//! Sums of the derivatives of all wrenches over the coordinates, in the structure of the bearing: shared bodies are coupled to
//! every element, elements to nothing else.

use crate::bodies::{InputValues, Layout, OF_ELEMENT};
use crate::integrate::Linearization;
use crate::integrate::linear::Arrowhead;

/// Sums in the making.
pub(crate) struct SlopeSums<'a> {
    pub(crate) layout: &'a Layout,
    /// How the inputs change, per second.
    pub(crate) rates: &'a InputValues,
    /// Rate of the logarithm of the viscosity, 1/s.
    pub(crate) ln_viscosity_rate: f64,
    pub(crate) out: &'a mut Linearization<OF_ELEMENT>,
}

/// Derivatives of one component of a wrench over the first positions and velocities of a body, as many as it has.
pub(crate) type Slope<const P: usize, const V: usize> = ([f64; P], [f64; V]);

/// Columns of a matrix with as many rows as an element has velocities.
#[inline]
fn chunks(columns: &mut [f64]) -> &mut [[f64; OF_ELEMENT]] {
    columns.as_chunks_mut().0
}

impl SlopeSums<'_> {
    /// Over positions and over velocities.
    #[inline]
    fn parts(&mut self) -> [&mut Arrowhead<f64, OF_ELEMENT>; 2] {
        [&mut self.out.over_positions, &mut self.out.over_velocities]
    }

    /// Adds derivatives of the wrench on element `j`, in its local frame, over its own coordinates.
    #[inline]
    pub(crate) fn add_own<const P: usize>(&mut self, j: usize, rows: &[Slope<P, OF_ELEMENT>; OF_ELEMENT]) {
        let columns = j * OF_ELEMENT..(j + 1) * OF_ELEMENT;
        let [k, d] = self.parts().map(|part| &mut chunks(part.own.as_mut_slice())[columns.clone()]);
        for (i, (position, velocity)) in rows.iter().enumerate() {
            for (c, slope) in position.iter().enumerate() {
                k[c][i] += slope;
            }
            for (c, slope) in velocity.iter().enumerate() {
                d[c][i] += slope;
            }
        }
    }

    /// The same over those of a shared body.
    #[inline]
    pub(crate) fn add_own_over_mate<const N: usize>(
        &mut self,
        j: usize,
        mate: usize,
        rows: &[Slope<N, N>; OF_ELEMENT],
    ) {
        let (places, first) = (self.layout.range(mate), j * self.layout.hub());
        let columns = first + places.start..first + places.end;
        let [k, d] = self.parts().map(|part| &mut chunks(part.from_hub.as_mut_slice())[columns.clone()]);
        for (c, (k, d)) in k.iter_mut().zip(d).enumerate().take(N) {
            for (i, (position, velocity)) in rows.iter().enumerate() {
                k[i] += position[c];
                d[i] += velocity[c];
            }
        }
    }

    /// Adds derivatives of the first components of the wrench on a shared body over the coordinates of element `j`.
    #[inline]
    pub(crate) fn add_mate_over_own<const M: usize>(
        &mut self,
        j: usize,
        mate: usize,
        rows: &[Slope<2, OF_ELEMENT>; M],
    ) {
        let (places, width) = (self.layout.range(mate), self.layout.hub());
        let block = j * OF_ELEMENT * width..(j + 1) * OF_ELEMENT * width;
        let [k, d] = self.parts().map(|part| &mut part.to_hub.as_mut_slice()[block.clone()]);
        for (c, column) in k.chunks_exact_mut(width).enumerate().take(2) {
            column[places.clone()].iter_mut().zip(rows).for_each(|(sum, row)| *sum += row.0[c]);
        }
        for (c, column) in d.chunks_exact_mut(width).enumerate() {
            column[places.clone()].iter_mut().zip(rows).for_each(|(sum, row)| *sum += row.1[c]);
        }
    }

    /// The same over those of a shared body, itself or another.
    #[inline]
    pub(crate) fn add_mate<const M: usize, const N: usize>(
        &mut self,
        mate: usize,
        over: usize,
        rows: &[Slope<N, N>; M],
    ) {
        let (k, d) = (&mut self.out.over_positions.hub, &mut self.out.over_velocities.hub);
        for (at, (position, velocity)) in self.layout.range(mate).zip(rows) {
            for (c, column) in self.layout.range(over).enumerate().take(N) {
                k[(at, column)] += position[c];
                d[(at, column)] += velocity[c];
            }
        }
    }

    /// Adds rates of the wrench on element `j` at constant state.
    #[inline]
    pub(crate) fn add_own_over_time(&mut self, j: usize, rates: &[f64; OF_ELEMENT]) {
        for (place, rate) in self.layout.of_element(j).into_iter().zip(rates) {
            self.out.over_time[place] += rate;
        }
    }

    /// Adds rates of the first components of the wrench on a shared body at constant state.
    #[inline]
    pub(crate) fn add_mate_over_time(&mut self, mate: usize, rates: &[f64]) {
        for (place, rate) in self.layout.range(mate).zip(rates) {
            self.out.over_time[place] += rate;
        }
    }
}
