//! DOP853, Dormand-Prince 8(5,3) with dense output of order 7, from the crate
//! `ivp` (a translation of Hairer and Wanner's Fortran code).
//!
//! Takes the largest step and a relative tolerance of zero; has no use for a
//! Jacobian.  The test that gives up on stiff problems is switched off.

use super::{Guard, Setup, Task, run};
use ivp::dense::StepInterpolant;
use ivp::ivp::FirstOrderSystem;
use ivp::matrix::{Matrix, MatrixStorage};
use ivp::methods::{DOP853, IntegrationResult, Tolerance};
use ivp::solout::{ControlFlag, SolOut};
use ivp::status::Status;
use std::cell::RefCell;

/// The guarded functions as a system of `ivp`.
pub(crate) struct System<'g, 'a, 'r, 'j> {
    guard: RefCell<&'g mut Guard<'a, 'r, 'j>>,
    columns: RefCell<Vec<f64>>,
}

impl<'g, 'a, 'r, 'j> System<'g, 'a, 'r, 'j> {
    pub fn new(guard: &'g mut Guard<'a, 'r, 'j>) -> Self {
        Self { guard: RefCell::new(guard), columns: RefCell::new(Vec::new()) }
    }
}

impl FirstOrderSystem for System<'_, '_, '_, '_> {
    fn derivative(&self, time: f64, state: &[f64], rates: &mut [f64]) {
        self.guard.borrow_mut().rates(time, state, rates);
    }

    fn jac(&self, time: f64, state: &[f64], matrix: &mut Matrix) {
        let size = state.len();
        let mut columns = self.columns.borrow_mut();
        columns.resize(size * size, 0.0);
        self.guard.borrow_mut().jacobian(time, state, &mut columns);
        for row in 0..size {
            for column in 0..size {
                matrix[(row, column)] = columns[column * size + row];
            }
        }
    }

    /// The identity, which is also how the matrix is stored.
    fn mass(&self, matrix: &mut Matrix) {
        debug_assert!(matches!(matrix.storage, MatrixStorage::Identity));
    }
}

/// Collects the states at the output times, and the last accepted step.
pub(crate) struct Outputs<'a> {
    times: &'a [f64],
    pub states: Vec<Vec<f64>>,
    pub time: f64,
    pub state: Vec<f64>,
}

impl<'a> Outputs<'a> {
    pub fn new(setup: &Setup<'a>) -> Self {
        Self { times: setup.times, states: Vec::new(), time: setup.start, state: setup.state.to_vec() }
    }

    /// The states, or why there are fewer than output times.
    pub fn finish(self, result: &IntegrationResult) -> Result<Vec<Vec<f64>>, String> {
        if result.status != Status::Success || self.states.len() < self.times.len() {
            return Err(format!("gave up at {} with {:?}", self.time, result.status));
        }
        Ok(self.states)
    }
}

impl SolOut for Outputs<'_> {
    fn solout(
        &mut self,
        _before: f64,
        time: &mut f64,
        state: &mut [f64],
        interpolant: Option<&StepInterpolant<'_>>,
    ) -> ControlFlag {
        self.time = *time;
        self.state.copy_from_slice(state);
        while let Some(&output) = self.times.get(self.states.len()) {
            if output > *time {
                // Asks for an interpolant only once the output time is passed.
                return ControlFlag::XOut(output);
            }
            let mut value = state.to_vec();
            if output < *time {
                match interpolant {
                    Some(interpolant) => interpolant.interpolate(output, &mut value),
                    // Makes the run fail; the methods promise an interpolant here.
                    None => value.fill(f64::NAN),
                }
            }
            self.states.push(value);
        }
        ControlFlag::XOut(f64::INFINITY)
    }
}

/// Solve with DOP853.
pub fn solve(task: Task<'_, '_, '_>) -> Result<Vec<Vec<f64>>, String> {
    run(task, integrate)
}

fn integrate(guard: &mut Guard<'_, '_, '_>, setup: &Setup<'_>) -> Result<Vec<Vec<f64>>, String> {
    let method = DOP853 {
        max_step: setup.max_step.is_finite().then_some(setup.max_step),
        max_steps: usize::MAX,
        stiff_test: usize::MAX,
        dense_output: false,
        ..DOP853::default()
    };
    let mut outputs = Outputs::new(setup);
    let (relative, absolute) = (Tolerance::Scalar(0.0), Tolerance::Scalar(setup.tolerance));
    let system = System::new(guard);
    let result = method
        .solve(&system, setup.start, setup.state, setup.end(), relative, absolute, Some(&mut outputs))
        .map_err(|error| error.to_string())?;
    outputs.finish(&result)
}
