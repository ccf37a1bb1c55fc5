//! Sums of the derivatives of all wrenches over the coordinates, in the structure of the bearing: shared bodies are coupled to
//! every element, elements to nothing else.

use crate::bodies::{InputValues, Layout, OF_ELEMENT};
use crate::integrate::Linearization;
use nalgebra::Vector5;

/// Sums in the making.
pub(crate) struct SlopeSums<'a> {
    pub(crate) layout: &'a Layout,
    /// How the inputs change, per second.
    pub(crate) rates: &'a InputValues,
    /// Rate of the logarithm of the viscosity, 1/s.
    pub(crate) ln_viscosity_rate: f64,
    /// Rates of the wrenches on the hub at constant state.
    pub(crate) hub_over_time: Vector5<f64>,
    pub(crate) out: &'a mut Linearization,
}

impl SlopeSums<'_> {
    /// Adds derivatives of the wrench on element `j`, in its local frame, over its own first positions and its velocities.
    #[inline]
    pub(crate) fn add_own<const P: usize>(&mut self, j: usize, rows: &[([f64; P], [f64; OF_ELEMENT]); 3]) {
        let k = &mut self.out.over_positions.spokes[j].own;
        let d = &mut self.out.over_velocities.spokes[j].own;
        for (i, (position, velocity)) in rows.iter().enumerate() {
            for (c, slope) in position.iter().enumerate() {
                k[(i, c)] += slope;
            }
            for (c, slope) in velocity.iter().enumerate() {
                d[(i, c)] += slope;
            }
        }
    }

    /// The same over the first positions and velocities of the shared body that begins at `at` in the hub.
    #[inline]
    pub(crate) fn add_own_over_mate<const N: usize>(
        &mut self,
        j: usize,
        at: usize,
        rows: &[([f64; N], [f64; N]); 3],
    ) {
        let k = &mut self.out.over_positions.spokes[j].from_hub;
        let d = &mut self.out.over_velocities.spokes[j].from_hub;
        for (i, (position, velocity)) in rows.iter().enumerate() {
            for c in 0..N {
                k[(i, at + c)] += position[c];
                d[(i, at + c)] += velocity[c];
            }
        }
    }

    /// Adds derivatives of the first components of the wrench on that body over the coordinates of element `j`.
    #[inline]
    pub(crate) fn add_mate_over_own<const M: usize>(
        &mut self,
        j: usize,
        at: usize,
        rows: &[([f64; 2], [f64; OF_ELEMENT]); M],
    ) {
        let k = &mut self.out.over_positions.spokes[j].to_hub;
        let d = &mut self.out.over_velocities.spokes[j].to_hub;
        for (i, (position, velocity)) in rows.iter().enumerate() {
            for (c, slope) in position.iter().enumerate() {
                k[(at + i, c)] += slope;
            }
            for (c, slope) in velocity.iter().enumerate() {
                d[(at + i, c)] += slope;
            }
        }
    }

    /// The same over the first coordinates of that body.
    #[inline]
    pub(crate) fn add_mate<const N: usize>(&mut self, at: usize, rows: &[([f64; N], [f64; N]); N]) {
        let (k, d) = (&mut self.out.over_positions.hub, &mut self.out.over_velocities.hub);
        for (i, (position, velocity)) in rows.iter().enumerate() {
            for c in 0..N {
                k[(at + i, at + c)] += position[c];
                d[(at + i, at + c)] += velocity[c];
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

    /// Adds rates of the first components of the wrench on the shared body that begins at `at` at constant state.
    #[inline]
    pub(crate) fn add_mate_over_time(&mut self, at: usize, rates: &[f64]) {
        for (k, rate) in rates.iter().enumerate() {
            self.hub_over_time[at + k] += rate;
        }
    }
}
