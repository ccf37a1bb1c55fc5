//! What both versions of the standard have alike: one body each, under its names in FMI 2.0 and 3.0.

use super::{give, items, places, put, saved, sizes, with};
use crate::capi::guard::free;
use crate::error::Result;
use crate::fmi::{Mode, Saved};
use libc::c_void;

/// Functions with the same arguments in both versions.
macro_rules! both {
    ($($name:ident: $two:ident, $three:ident($($argument:ident: $type:ty),*) = $entry:expr;)+) => {$(
        unsafe fn $name(instance: *mut c_void, what: &str $(, $argument: $type)*) -> i32 {
            // SAFETY: handle and arguments are those of the importer.
            unsafe { with(instance, what, $entry) }
        }

        /// # Safety
        /// As in the standard: handles are live, arrays as long as their lengths say.
        #[unsafe(no_mangle)]
        pub unsafe extern "C" fn $two(instance: *mut c_void $(, $argument: $type)*) -> i32 {
            // SAFETY: see above.
            unsafe { $name(instance, stringify!($two) $(, $argument)*) }
        }

        /// # Safety
        /// As in the standard: handles are live, arrays as long as their lengths say.
        #[unsafe(no_mangle)]
        pub unsafe extern "C" fn $three(instance: *mut c_void $(, $argument: $type)*) -> i32 {
            // SAFETY: see above.
            unsafe { $name(instance, stringify!($three) $(, $argument)*) }
        }
    )+};
}

both! {
    exit_initialization: fmi2ExitInitializationMode, fmi3ExitInitializationMode() =
        |c| c.instance.exit_initialization(c.with_events);
    enter_events: fmi2EnterEventMode, fmi3EnterEventMode() = |c| c.instance.enter(Mode::Event);
    enter_continuous: fmi2EnterContinuousTimeMode, fmi3EnterContinuousTimeMode() =
        |c| c.instance.enter(Mode::Continuous);
    terminate: fmi2Terminate, fmi3Terminate() = |c| c.instance.enter(Mode::Terminated);
    reset: fmi2Reset, fmi3Reset() = |c| {
        c.instance.reset();
        Ok(())
    };
    keep: fmi2GetFMUstate, fmi3GetFMUState(state: *mut *mut c_void) = |c| give(state, c.instance.save());
    go_back: fmi2SetFMUstate, fmi3SetFMUState(state: *mut c_void) = |c| c.instance.restore(saved(state)?);
    forget: fmi2FreeFMUstate, fmi3FreeFMUState(state: *mut *mut c_void) = |_| {
        let place = places("FMUState", state, 1)?;
        free(std::mem::replace(&mut place[0], std::ptr::null_mut()).cast::<Saved>());
        Ok(())
    };
    serialized_size: fmi2SerializedFMUstateSize, fmi3SerializedFMUStateSize(state: *mut c_void, size: *mut usize) =
        |_| put("size", size, saved(state)?.to_bytes().len());
    serialize: fmi2SerializeFMUstate, fmi3SerializeFMUState(state: *mut c_void, bytes: *mut u8, size: usize) = |_| {
        let found = saved(state)?.to_bytes();
        sizes("serializedState", size, found.len())?;
        places("serializedState", bytes, size)?.copy_from_slice(&found);
        Ok(())
    };
    deserialize: fmi2DeSerializeFMUstate, fmi3DeserializeFMUState(bytes: *const u8, size: usize, state: *mut *mut c_void) =
        |_| give(state, Saved::from_bytes(items("serializedState", bytes, size)?)?);
    set_time: fmi2SetTime, fmi3SetTime(time: f64) = |c| c.instance.set_time(time);
    set_states: fmi2SetContinuousStates, fmi3SetContinuousStates(states: *const f64, count: usize) =
        |c| c.instance.set_state(items("continuousStates", states, count)?);
    get_states: fmi2GetContinuousStates, fmi3GetContinuousStates(out: *mut f64, count: usize) =
        |c| fill("continuousStates", c.instance.state()?, out, count);
    get_rates: fmi2GetDerivatives, fmi3GetContinuousStateDerivatives(out: *mut f64, count: usize) =
        |c| fill("derivatives", c.instance.rates()?, out, count);
    get_nominals: fmi2GetNominalsOfContinuousStates, fmi3GetNominalsOfContinuousStates(out: *mut f64, count: usize) =
        |c| fill("nominals", &c.instance.nominals(), out, count);
    get_indicators: fmi2GetEventIndicators, fmi3GetEventIndicators(out: *mut f64, count: usize) =
        |_| fill("eventIndicators", &[], out, count);
}

/// Writes a list.
///
/// # Safety
/// `out` is NULL or has room for `count` numbers.
unsafe fn fill(name: &str, found: &[f64], out: *mut f64, count: usize) -> Result<()> {
    sizes(name, count, found.len())?;
    // SAFETY: see above.
    unsafe { places(name, out, count) }?.copy_from_slice(found);
    Ok(())
}

/// Value references and values with their lengths.
type Named<V> = (*const u32, usize, V, usize);

/// Values of variables.
///
/// # Safety
/// As in the standard.
pub(super) unsafe fn get(
    instance: *mut c_void,
    what: &str,
    (references, count, out, length): Named<*mut f64>,
) -> i32 {
    // SAFETY: see above.
    unsafe {
        with(instance, what, |c| {
            sizes("values", length, count)?;
            c.instance.values(items("valueReferences", references, count)?, places("values", out, length)?)
        })
    }
}

/// Sets variables.
///
/// # Safety
/// As in the standard.
pub(super) unsafe fn set(
    instance: *mut c_void,
    what: &str,
    (references, count, values, length): Named<*const f64>,
) -> i32 {
    // SAFETY: see above.
    unsafe {
        with(instance, what, |c| {
            sizes("values", length, count)?;
            c.instance
                .set_values(items("valueReferences", references, count)?, items("values", values, length)?)
        })
    }
}

/// Derivatives of unknowns over knowns, along a seed or if `adjoint` the other way round.
///
/// # Safety
/// As in the standard.
pub(super) unsafe fn differentiate(
    instance: *mut c_void,
    what: &str,
    [(unknowns, unknown_count), (knowns, known_count)]: [(*const u32, usize); 2],
    (seed, seed_length): (*const f64, usize),
    adjoint: bool,
    (out, length): (*mut f64, usize),
) -> i32 {
    // SAFETY: see above.
    unsafe {
        with(instance, what, |c| {
            let (from, to) =
                if adjoint { (unknown_count, known_count) } else { (known_count, unknown_count) };
            sizes("seed", seed_length, from)?;
            sizes("sensitivity", length, to)?;
            let variables =
                [items("unknowns", unknowns, unknown_count)?, items("knowns", knowns, known_count)?];
            let (seed, out) = (items("seed", seed, seed_length)?, places("sensitivity", out, length)?);
            c.instance.derivative_along(variables, seed, adjoint, out)
        })
    }
}
