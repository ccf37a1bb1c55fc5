//! Inputs that the host holds in place of the scene's functions of time.

use super::errors::bad_index;
use super::{Evaluated, Sim};
use crate::bodies::OF_RING;
use crate::error::{Error, Result, Status};
use crate::model::Input;

impl Sim {
    /// Value of input `index` at the current time.
    ///
    /// # Errors
    /// [`Status::BadIndex`].
    pub fn input(&self, index: usize) -> Result<f64> {
        let input = self.check_input(index)?;
        Ok(self.model().inputs_at(self.time, self.bearing.host()).of(input))
    }

    /// Holds input `index` at `value` from now on, instead of the scene's function of time. The value that it has already
    /// changes nothing.
    ///
    /// The place of a ring goes on at the rate that the host has set for it, if it has: see [`Sim::set_input_slope`].
    ///
    /// # Errors
    /// [`Status::BadIndex`]; [`Status::BadValue`] if the value is not finite or out of the range that scenes have, or a place is out of the
    /// bearing.
    pub fn set_input(&mut self, index: usize, value: f64) -> Result<()> {
        self.hold_input(index, value, None)
    }

    /// Lets input `index` go on from `value` with `slope` per second from now on, instead of the scene's function of time.
    ///
    /// The place of a ring and its rate are one motion: to set the rate lets the place go on from where it is, with `slope` as its
    /// second rate, and to set the place with a slope sets the rate. A place that jumps takes or gives energy, which the power balance
    /// has as work of what moves the ring.
    ///
    /// # Errors
    /// As [`Sim::set_input`], of the slope, too.
    pub fn set_input_slope(&mut self, index: usize, value: f64, slope: f64) -> Result<()> {
        if !slope.is_finite() {
            return Err(Error::new(Status::BadValue, format!("slope: {slope} is not a finite number")));
        }
        self.hold_input(index, value, Some(slope))
    }

    fn hold_input(&mut self, index: usize, value: f64, slope: Option<f64>) -> Result<()> {
        let input = self.check_input(index)?;
        self.model().check_input(input, value)?;
        let now = self.bearing.host().of(input, self.time);
        let same = |[is, goes_on]: [f64; 2]| match (input.place(), slope) {
            (Some((_, false)), None) => is == value,
            (_, slope) => is == value && goes_on == slope.unwrap_or(0.0),
        };
        if now.is_some_and(same) {
            return Ok(());
        }
        self.change_input(input, Some((value, slope)))
    }

    /// Lets input `index` follow the scene again.
    ///
    /// # Errors
    /// [`Status::BadIndex`]; [`Status::BadValue`] if the scene has a ring out of the bearing now.
    pub fn release_input(&mut self, index: usize) -> Result<()> {
        let input = self.check_input(index)?;
        if self.bearing.host().holds(input) {
            self.change_input(input, None)?;
        }
        Ok(())
    }

    /// Sets or releases an input. What the energy of the bearing jumps by with the place of a ring is work of what moves it.
    fn change_input(&mut self, input: Input, to: Option<(f64, Option<f64>)>) -> Result<()> {
        let Some((place, _)) = input.place() else {
            self.bearing.set_input(self.time, input, to);
            self.restart();
            return Ok(());
        };
        let held = *self.bearing.host();
        let before = self.energy_at_present();
        self.bearing.set_input(self.time, input, to);
        self.evaluated = Evaluated::Other;
        let evaluated = self.bearing.accelerations_at(self.time, &self.state, &mut self.accelerations);
        if let Err(fault) = evaluated {
            *self.bearing.host_mut() = held;
            return Err(Error::new(Status::BadValue, format!("value: {}", self.bearing.describe(fault))));
        }
        if let Some(before) = before {
            let after = self.bearing.energy();
            self.balance.push(usize::from(place < OF_RING), after.total() - before.total());
        }
        self.restart();
        Ok(())
    }

    pub(super) fn check_input(&self, index: usize) -> Result<Input> {
        let mut list = self.model().input_list();
        list.nth(index).ok_or_else(|| bad_index("input", index, self.model().input_count()))
    }
}
