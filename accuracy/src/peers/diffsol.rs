//! BDF of variable order from the crate `diffsol`, with nalgebra's dense LU decomposition: its fastest for tens of states.
//!
//! The crate takes Jacobian-vector products and builds a dense Jacobian from one
//! product per unit vector; this module computes the Jacobian once and hands out
//! its columns.  The relative tolerance is zero.  The crate has no largest step:
//! [`Task::max_step`] is ignored.

use super::{Guard, Setup, Task, run};
use ::diffsol::{
    DiffsolError, NalgebraLU, NalgebraMat, OdeBuilder, OdeEquations, OdeSolverMethod, OdeSolverStopReason,
    Vector,
};
use std::cell::RefCell;

/// The last Jacobian, and where it was taken.
#[derive(Default)]
struct Cache {
    time: f64,
    state: Vec<f64>,
    columns: Vec<f64>,
}

impl Cache {
    /// Make `columns` the Jacobian at a point.
    fn update(&mut self, guard: &RefCell<&mut Guard>, time: f64, state: &[f64]) {
        if self.time == time && self.state == state {
            return;
        }
        self.columns.resize(state.len() * state.len(), 0.0);
        guard.borrow_mut().jacobian(time, state, &mut self.columns);
        self.time = time;
        self.state.clear();
        self.state.extend_from_slice(state);
    }

    /// Multiply by a vector: a copy of a column if it is a unit vector.
    fn multiply(&self, vector: &[f64], product: &mut [f64]) {
        product.fill(0.0);
        let columns = self.columns.chunks_exact(vector.len());
        for (&factor, column) in vector.iter().zip(columns) {
            if factor == 1.0 {
                product.iter_mut().zip(column).for_each(|(sum, slope)| *sum += slope);
            } else if factor != 0.0 {
                product.iter_mut().zip(column).for_each(|(sum, slope)| *sum += factor * slope);
            }
        }
    }
}

/// Solve with BDF.
pub fn solve(task: Task<'_, '_, '_>) -> Result<Vec<Vec<f64>>, String> {
    run(task, |guard, setup| integrate(guard, setup).map_err(|error| error.to_string()))
}

fn integrate(guard: &mut Guard<'_, '_, '_>, setup: &Setup<'_>) -> Result<Vec<Vec<f64>>, DiffsolError> {
    let (guard, cache) = (RefCell::new(guard), RefCell::new(Cache::default()));
    let state = setup.state;
    let mut problem = OdeBuilder::<NalgebraMat<f64>>::new()
        .t0(setup.start)
        .rtol(0.0)
        .atol([setup.tolerance])
        .rhs_implicit(
            |state: &[f64], _: &[f64], time, rates: &mut [f64]| {
                guard.borrow_mut().rates(time, state, rates);
            },
            |state: &[f64], _: &[f64], time, vector: &[f64], product: &mut [f64]| {
                let mut cache = cache.borrow_mut();
                cache.update(&guard, time, state);
                cache.multiply(vector, product);
            },
        )
        .init(|_: &[f64], _, initial: &mut [f64]| initial.copy_from_slice(state), state.len())
        .build()?;
    // Failures are limited by `max_evaluations` and the least step alone.
    problem.ode_options.max_nonlinear_solver_failures = usize::MAX;
    problem.ode_options.max_error_test_failures = usize::MAX;
    problem.ode_options.min_timestep = 1e-18;
    collect(problem.bdf::<NalgebraLU<f64>>()?, setup)
}

/// Step to the last output time and interpolate at all of them.
fn collect<'a, E, S>(mut solver: S, setup: &Setup<'_>) -> Result<Vec<Vec<f64>>, DiffsolError>
where
    E: OdeEquations<T = f64> + 'a,
    S: OdeSolverMethod<'a, E>,
{
    let mut states = Vec::with_capacity(setup.times.len());
    solver.set_stop_time(setup.end())?;
    loop {
        let reason = solver.step()?;
        let reached =
            if matches!(reason, OdeSolverStopReason::TstopReached) { setup.end() } else { solver.state().t };
        while let Some(&output) = setup.times.get(states.len()).filter(|&&output| output <= reached) {
            let state = if output < solver.state().t {
                solver.interpolate(output)?.clone_as_vec()
            } else {
                solver.state().y.clone_as_vec()
            };
            states.push(state);
        }
        if states.len() == setup.times.len() {
            return Ok(states);
        }
    }
}
