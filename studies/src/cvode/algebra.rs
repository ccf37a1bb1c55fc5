//! Solvers of the implicit equations.

use super::handles::{Context, Vector};
use super::{not_null, solve_for_cvode};
use std::ffi::c_void;
use std::ptr;
use sundials_sys as sys;

/// Solver of the implicit equations; null where the method needs none.
pub struct Algebra {
    pub matrix: sys::SUNMatrix,
    pub linear: sys::SUNLinearSolver,
    pub nonlinear: sys::SUNNonlinearSolver,
    /// Whether the linear solver is the caller's: its content is then not SUNDIALS' to free.
    own: bool,
}

impl Algebra {
    const NONE: Self =
        Self { matrix: ptr::null_mut(), linear: ptr::null_mut(), nonlinear: ptr::null_mut(), own: false };

    pub fn dense(context: &Context, y: &Vector) -> Result<Self, String> {
        let n = i64::try_from(y.1).map_err(|e| e.to_string())?;
        let mut algebra = Self::NONE;
        // SAFETY: context and vector are alive; the solver keeps the matrix, which is freed after it.
        unsafe {
            algebra.matrix = not_null("SUNDenseMatrix", sys::SUNDenseMatrix(n, n, context.0))?;
            let linear = sys::SUNLinSol_Dense(y.0, algebra.matrix, context.0);
            algebra.linear = not_null("SUNLinSol_Dense", linear)?;
        }
        Ok(algebra)
    }

    /// The caller's own solver: a matrix without content and a solver that passes on what it is asked.
    pub fn newton(context: &Context) -> Result<Self, String> {
        let mut algebra = Self::NONE;
        // SAFETY: the context is alive; operations are set before anybody uses them, and those left out are optional.
        unsafe {
            algebra.own = true;
            algebra.matrix = not_null("SUNMatNewEmpty", sys::SUNMatNewEmpty(context.0))?;
            (*(*algebra.matrix).ops).getid = Some(matrix_of_the_caller);
            algebra.linear = not_null("SUNLinSolNewEmpty", sys::SUNLinSolNewEmpty(context.0))?;
            let operations = &mut *(*algebra.linear).ops;
            operations.gettype = Some(direct);
            operations.solve = Some(solve_for_cvode);
        }
        Ok(algebra)
    }

    /// Makes the caller's own solver find its data.
    pub fn give(&self, data: *mut c_void) {
        // SAFETY: the solver is alive; nothing but `solve_for_cvode` looks at its content, and `drop` takes it away.
        unsafe { (*self.linear).content = data };
    }

    pub fn fixed_point(context: &Context, y: &Vector) -> Result<Self, String> {
        // SAFETY: context and vector are alive.
        let nonlinear = unsafe { sys::SUNNonlinSol_FixedPoint(y.0, 0, context.0) };
        Ok(Self { nonlinear: not_null("SUNNonlinSol_FixedPoint", nonlinear)?, ..Self::NONE })
    }
}

impl Drop for Algebra {
    fn drop(&mut self) {
        // SAFETY: each was made once and is freed once; the memory of CVODE that used them is gone.
        unsafe {
            if !self.linear.is_null() {
                if self.own {
                    (*self.linear).content = ptr::null_mut();
                }
                sys::SUNLinSolFree(self.linear);
            }
            if !self.nonlinear.is_null() {
                sys::SUNNonlinSolFree(self.nonlinear);
            }
            if !self.matrix.is_null() {
                sys::SUNMatDestroy(self.matrix);
            }
        }
    }
}

unsafe extern "C" fn matrix_of_the_caller(_: sys::SUNMatrix) -> sys::SUNMatrix_ID {
    sys::SUNMatrix_ID_SUNMATRIX_CUSTOM
}

unsafe extern "C" fn direct(_: sys::SUNLinearSolver) -> sys::SUNLinearSolver_Type {
    sys::SUNLinearSolver_Type_SUNLINEARSOLVER_DIRECT
}
