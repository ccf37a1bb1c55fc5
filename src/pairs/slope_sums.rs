//! Sums of the derivatives of all wrenches over the coordinates, in the structure of the bearing: shared bodies are coupled to
//! every element, elements to nothing else.

use crate::bodies::{IN_HUB, InputValues, Layout, OF_ELEMENT};
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
    /// Adds derivatives of component `i` of the wrench on element `j`, in its local frame, over its own coordinates.
    #[inline]
    pub(crate) fn add_own(&mut self, j: usize, i: usize, position: &[f64], velocity: &[f64; OF_ELEMENT]) {
        let k = &mut self.out.over_positions.spokes[j];
        for (c, slope) in position.iter().enumerate() {
            k.own[(i, c)] += slope;
        }
        let d = &mut self.out.over_velocities.spokes[j];
        for (c, slope) in velocity.iter().enumerate() {
            d.own[(i, c)] += slope;
        }
    }

    /// The same over the first coordinates of the shared body `mate`, positions and velocities.
    #[inline]
    pub(crate) fn add_own_over_mate<const N: usize>(
        &mut self,
        (j, mate): (usize, usize),
        i: usize,
        position: &[f64; N],
        velocity: &[f64; N],
    ) {
        let at = IN_HUB[mate];
        let k = &mut self.out.over_positions.spokes[j];
        let d = &mut self.out.over_velocities.spokes[j];
        for c in 0..N {
            k.from_hub[(i, at + c)] += position[c];
            d.from_hub[(i, at + c)] += velocity[c];
        }
    }

    /// Adds derivatives of component `i` of the wrench on the shared body `mate` over the coordinates of element `j`.
    #[inline]
    pub(crate) fn add_mate_over_own(
        &mut self,
        (j, mate): (usize, usize),
        i: usize,
        position: &[f64; 2],
        velocity: &[f64; OF_ELEMENT],
    ) {
        let at = IN_HUB[mate];
        let k = &mut self.out.over_positions.spokes[j];
        for (c, slope) in position.iter().enumerate() {
            k.to_hub[(at + i, c)] += slope;
        }
        let d = &mut self.out.over_velocities.spokes[j];
        for (c, slope) in velocity.iter().enumerate() {
            d.to_hub[(at + i, c)] += slope;
        }
    }

    /// The same over the first coordinates of that body.
    #[inline]
    pub(crate) fn add_mate<const N: usize>(
        &mut self,
        mate: usize,
        i: usize,
        position: &[f64; N],
        velocity: &[f64; N],
    ) {
        let at = IN_HUB[mate];
        for c in 0..N {
            self.out.over_positions.hub[(at + i, at + c)] += position[c];
            self.out.over_velocities.hub[(at + i, at + c)] += velocity[c];
        }
    }

    /// Adds rates of the wrench on element `j` at constant state.
    #[inline]
    pub(crate) fn add_own_over_time(&mut self, j: usize, rates: &[f64; OF_ELEMENT]) {
        for (place, rate) in self.layout.of_element(j).into_iter().zip(rates) {
            self.out.over_time[place] += rate;
        }
    }

    /// Adds rates of the first components of the wrench on the shared body `mate` at constant state.
    #[inline]
    pub(crate) fn add_mate_over_time(&mut self, mate: usize, rates: &[f64]) {
        for (k, rate) in rates.iter().enumerate() {
            self.hub_over_time[IN_HUB[mate] + k] += rate;
        }
    }
}
