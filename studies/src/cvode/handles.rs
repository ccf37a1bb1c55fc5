//! What CVODE allocates, freed when it goes out of scope.

use super::{Method, Statistics, check, not_null};
use std::ffi::{c_int, c_long, c_void};
use std::ptr;
use sundials_sys as sys;

/// Everything of SUNDIALS belongs to one.
pub struct Context(pub sys::SUNContext);

impl Context {
    pub fn new() -> Result<Self, String> {
        let mut context = ptr::null_mut();
        // SAFETY: the pointer is written during the call. Handlers that print are taken off: errors are returned.
        unsafe {
            check("SUNContext_Create", sys::SUNContext_Create(sys::comm_no_mpi(), &mut context))?;
            let context = Self(context);
            check("SUNContext_ClearErrHandlers", sys::SUNContext_ClearErrHandlers(context.0))?;
            Ok(context)
        }
    }
}

impl Drop for Context {
    fn drop(&mut self) {
        // SAFETY: everything made with it was declared later and is gone.
        unsafe { sys::SUNContext_Free(&mut self.0) };
    }
}

/// A serial vector with its length.
pub struct Vector(pub sys::N_Vector, pub usize);

impl Vector {
    pub fn new(context: &Context, values: &[f64]) -> Result<Self, String> {
        let length = i64::try_from(values.len()).map_err(|e| e.to_string())?;
        // SAFETY: the context is alive.
        let vector = not_null("N_VNew_Serial", unsafe { sys::N_VNew_Serial(length, context.0) })?;
        let mut vector = Self(vector, values.len());
        vector.values().copy_from_slice(values);
        Ok(vector)
    }

    pub fn values(&mut self) -> &mut [f64] {
        // SAFETY: a serial vector of this many numbers, borrowed with `self`.
        unsafe { std::slice::from_raw_parts_mut(sys::N_VGetArrayPointer(self.0), self.1) }
    }
}

impl Drop for Vector {
    fn drop(&mut self) {
        // SAFETY: made by `new`, freed once.
        unsafe { sys::N_VDestroy(self.0) };
    }
}

/// An integration by CVODE.
pub struct Memory(pub *mut c_void);

impl Memory {
    pub fn new(context: &Context, method: Method) -> Result<Self, String> {
        let method = match method {
            Method::Bdf => sys::CV_BDF,
            Method::Adams => sys::CV_ADAMS,
        };
        // SAFETY: the context is alive.
        Ok(Self(not_null("CVodeCreate", unsafe { sys::CVodeCreate(method, context.0) })?))
    }

    pub fn statistics(&self, method: Method) -> Result<Statistics, String> {
        type Count = unsafe extern "C" fn(*mut c_void, *mut c_long) -> c_int;
        let count = |get: Count| {
            let mut value = 0;
            // SAFETY: the memory is alive; the number is written during the call.
            check("statistics", unsafe { get(self.0, &mut value) })?;
            u64::try_from(value).map_err(|e| e.to_string())
        };
        let quotients = if method == Method::Bdf { count(sys::CVodeGetNumLinRhsEvals)? } else { 0 };
        Ok(Statistics {
            steps: count(sys::CVodeGetNumSteps)?,
            evaluations: count(sys::CVodeGetNumRhsEvals)? + quotients,
            rejected: count(sys::CVodeGetNumErrTestFails)?,
            newton_failures: count(sys::CVodeGetNumNonlinSolvConvFails)?,
        })
    }
}

impl Drop for Memory {
    fn drop(&mut self) {
        // SAFETY: made by `new`, freed once.
        unsafe { sys::CVodeFree(&mut self.0) };
    }
}
