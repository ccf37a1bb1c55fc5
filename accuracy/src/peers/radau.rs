//! Radau IIA of order 5 (RADAU5), from the crate `ivp` (a translation of Hairer
//! and Wanner's Fortran code), with a dense LU decomposition of its own.
//!
//! Takes the largest step and the Jacobian.  The code transforms tolerances by
//! `rtol' = 0.1 rtol^(2/3)` and `atol' = atol rtol' / rtol`; this module inverts
//! that, so that the error estimate is compared with `tolerance + r |y|`, where
//! `r = 1e-12 tolerance`: zero cannot be passed.  The estimate is of third order
//! while the solution is of fifth, so errors are usually far below the tolerance
//! (scipy's Radau compares in the same way).
//!
//! Five Newton failures in a row make the code report a singular matrix; then
//! this module starts it anew from the last accepted step, with a smaller step.

use super::dop853::{Outputs, System};
use super::{Guard, Setup, Task, run};
use ivp::matrix::MatrixStorage;
use ivp::methods::{RADAU, Tolerance};
use ivp::status::Status;

/// Solve with Radau IIA.
pub fn solve(task: Task<'_, '_, '_>) -> Result<Vec<Vec<f64>>, String> {
    run(task, integrate)
}

fn integrate(guard: &mut Guard<'_, '_, '_>, setup: &Setup<'_>) -> Result<Vec<Vec<f64>>, String> {
    let size = setup.state.len();
    // Vectors, because the code would transform a scalar once per state.
    let transformed = 1e-12 * setup.tolerance;
    let relative = (10.0 * transformed).powf(1.5);
    let absolute = setup.tolerance * relative / transformed;
    let newton = setup.tolerance.sqrt().min(0.03).max(10.0 * f64::EPSILON / setup.tolerance);
    let mut method = RADAU {
        max_step: setup.max_step.is_finite().then_some(setup.max_step),
        max_steps: usize::MAX,
        newton_tol: Some(newton),
        jac_storage: MatrixStorage::Full,
        mass_storage: MatrixStorage::Identity,
        first_step: Some(guard.first_step(setup)),
        dense_output: false,
        ..RADAU::default()
    };
    let system = System::new(guard);
    let mut outputs = Outputs::new(setup);
    loop {
        let (time, state) = (outputs.time, outputs.state.clone());
        let relative = Tolerance::Vector(vec![relative; size]);
        let absolute = Tolerance::Vector(vec![absolute; size]);
        let result = method
            .solve(&system, time, &state, setup.end(), relative, absolute, Some(&mut outputs))
            .map_err(|error| error.to_string())?;
        if result.status != Status::SingularMatrix {
            return outputs.finish(&result);
        }
        method.first_step = Some(0.5 * result.h.abs());
    }
}
