//! FMI 3.0: what units of the library use of it. Names, arguments and statuses are those of `fmi3FunctionTypes.h`.

use super::{Component, Handle, Logger, Wanted, give, instantiate, items, places, put, saved, sizes, with};
use crate::capi::guard::{free, text};
use crate::error::Result;
use crate::fmi::{Interface, Mode, Saved};
use libc::{c_char, c_void};
use std::path::PathBuf;

/// What tells messages: environment, status, category, message.
pub type Log = unsafe extern "C" fn(*mut c_void, i32, *const c_char, *const c_char);

/// Version of the standard.
#[unsafe(no_mangle)]
pub extern "C" fn fmi3GetVersion() -> *const c_char {
    c"3.0".as_ptr()
}

/// Errors are told whatever this says; there is nothing else to tell.
///
/// # Safety
/// As in the standard, and so for all functions of this file: handles are live, arrays as long as their lengths say.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi3SetDebugLogging(
    instance: *mut c_void,
    _logging_on: bool,
    _count: usize,
    _categories: *const *const c_char,
) -> i32 {
    // SAFETY: see above.
    unsafe { with(instance, "fmi3SetDebugLogging", |_| Ok(())) }
}

unsafe fn new(
    [name, token, resources]: [*const c_char; 3],
    interface: Interface,
    (environment, tell): (*mut c_void, Option<Log>),
    with_events: bool,
) -> *mut c_void {
    let folder = || -> Result<PathBuf> {
        // SAFETY: a text of the importer.
        Ok(PathBuf::from(unsafe { text("resourcePath", resources) }?))
    };
    let logger = Logger::Three { environment, tell };
    // SAFETY: texts of the importer.
    unsafe { instantiate(&Wanted { name, token, interface, logger, with_events, resources: &folder }) }
}

/// # Safety
/// See above.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi3InstantiateModelExchange(
    name: *const c_char,
    token: *const c_char,
    resources: *const c_char,
    _visible: bool,
    _logging_on: bool,
    environment: *mut c_void,
    tell: Option<Log>,
) -> *mut c_void {
    // SAFETY: see above.
    unsafe { new([name, token, resources], Interface::ModelExchange, (environment, tell), true) }
}

/// # Safety
/// See above.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi3InstantiateCoSimulation(
    name: *const c_char,
    token: *const c_char,
    resources: *const c_char,
    _visible: bool,
    _logging_on: bool,
    event_mode_used: bool,
    _early_return_allowed: bool,
    _required_intermediate: *const u32,
    _required_count: usize,
    environment: *mut c_void,
    tell: Option<Log>,
    _intermediate_update: *const c_void,
) -> *mut c_void {
    // SAFETY: see above.
    unsafe { new([name, token, resources], Interface::CoSimulation, (environment, tell), event_mode_used) }
}

/// # Safety
/// See above.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi3FreeInstance(instance: *mut c_void) {
    // SAFETY: see above.
    unsafe { free(instance.cast::<Handle>()) }
}

/// # Safety
/// See above.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi3EnterInitializationMode(
    instance: *mut c_void,
    _tolerance_defined: bool,
    _tolerance: f64,
    start: f64,
    _stop_defined: bool,
    _stop: f64,
) -> i32 {
    // SAFETY: see above.
    unsafe { with(instance, "fmi3EnterInitializationMode", |c| c.instance.enter_initialization(start)) }
}

/// # Safety
/// See above.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi3ExitInitializationMode(instance: *mut c_void) -> i32 {
    // SAFETY: see above.
    unsafe { with(instance, "fmi3ExitInitializationMode", |c| c.instance.exit_initialization(c.with_events)) }
}

/// Functions of a handle alone.
macro_rules! simple {
    ($($name:ident => $entry:expr;)+) => {$(
        /// # Safety
        /// See above.
        #[unsafe(no_mangle)]
        pub unsafe extern "C" fn $name(instance: *mut c_void) -> i32 {
            let entry: fn(&mut Component) -> Result<()> = $entry;
            // SAFETY: see above.
            unsafe { with(instance, stringify!($name), entry) }
        }
    )+};
}

simple! {
    fmi3EnterEventMode => |c| c.instance.enter(Mode::Event);
    fmi3EnterContinuousTimeMode => |c| c.instance.enter(Mode::Continuous);
    fmi3EnterStepMode => |c| c.instance.enter(Mode::Step);
    fmi3Terminate => |c| c.instance.enter(Mode::Terminated);
    fmi3Reset => |c| { c.instance.reset(); Ok(()) };
    fmi3EvaluateDiscreteStates => |_| Ok(());
}

/// # Safety
/// See above.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi3GetFloat64(
    instance: *mut c_void,
    references: *const u32,
    count: usize,
    values: *mut f64,
    length: usize,
) -> i32 {
    // SAFETY: see above.
    unsafe {
        with(instance, "fmi3GetFloat64", |c| {
            sizes("values", length, count)?;
            c.instance.values(items("valueReferences", references, count)?, places("values", values, length)?)
        })
    }
}

/// # Safety
/// See above.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi3SetFloat64(
    instance: *mut c_void,
    references: *const u32,
    count: usize,
    values: *const f64,
    length: usize,
) -> i32 {
    // SAFETY: see above.
    unsafe {
        with(instance, "fmi3SetFloat64", |c| {
            sizes("values", length, count)?;
            c.instance
                .set_values(items("valueReferences", references, count)?, items("values", values, length)?)
        })
    }
}

/// # Safety
/// See above.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi3GetFMUState(instance: *mut c_void, state: *mut *mut c_void) -> i32 {
    // SAFETY: see above.
    unsafe { with(instance, "fmi3GetFMUState", |c| give(state, c.instance.save())) }
}

/// # Safety
/// See above.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi3SetFMUState(instance: *mut c_void, state: *mut c_void) -> i32 {
    // SAFETY: see above.
    unsafe { with(instance, "fmi3SetFMUState", |c| c.instance.restore(saved(state)?)) }
}

/// # Safety
/// See above.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi3FreeFMUState(instance: *mut c_void, state: *mut *mut c_void) -> i32 {
    // SAFETY: see above.
    unsafe {
        with(instance, "fmi3FreeFMUState", |_| {
            let place = places("FMUState", state, 1)?;
            free(std::mem::replace(&mut place[0], std::ptr::null_mut()).cast::<Saved>());
            Ok(())
        })
    }
}

/// # Safety
/// See above.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi3SerializedFMUStateSize(
    instance: *mut c_void,
    state: *mut c_void,
    size: *mut usize,
) -> i32 {
    // SAFETY: see above.
    unsafe {
        with(instance, "fmi3SerializedFMUStateSize", |_| put("size", size, saved(state)?.to_bytes().len()))
    }
}

/// # Safety
/// See above.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi3SerializeFMUState(
    instance: *mut c_void,
    state: *mut c_void,
    bytes: *mut u8,
    size: usize,
) -> i32 {
    // SAFETY: see above.
    unsafe {
        with(instance, "fmi3SerializeFMUState", |_| {
            let found = saved(state)?.to_bytes();
            sizes("serializedState", size, found.len())?;
            places("serializedState", bytes, size)?.copy_from_slice(&found);
            Ok(())
        })
    }
}

/// # Safety
/// See above.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi3DeserializeFMUState(
    instance: *mut c_void,
    bytes: *const u8,
    size: usize,
    state: *mut *mut c_void,
) -> i32 {
    // SAFETY: see above.
    unsafe {
        with(instance, "fmi3DeserializeFMUState", |_| {
            let found = Saved::from_bytes(items("serializedState", bytes, size)?)?;
            give(state, found)
        })
    }
}

/// # Safety
/// See above.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi3GetDirectionalDerivative(
    instance: *mut c_void,
    unknowns: *const u32,
    unknown_count: usize,
    knowns: *const u32,
    known_count: usize,
    seed: *const f64,
    seed_length: usize,
    sensitivity: *mut f64,
    length: usize,
) -> i32 {
    // SAFETY: see above.
    unsafe {
        with(instance, "fmi3GetDirectionalDerivative", |c| {
            sizes("seed", seed_length, known_count)?;
            sizes("sensitivity", length, unknown_count)?;
            let (unknowns, knowns) =
                (items("unknowns", unknowns, unknown_count)?, items("knowns", knowns, known_count)?);
            let (seed, out) =
                (items("seed", seed, seed_length)?, places("sensitivity", sensitivity, length)?);
            c.instance.directional_derivative(unknowns, knowns, seed, out)
        })
    }
}

/// # Safety
/// See above.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi3GetAdjointDerivative(
    instance: *mut c_void,
    unknowns: *const u32,
    unknown_count: usize,
    knowns: *const u32,
    known_count: usize,
    seed: *const f64,
    seed_length: usize,
    sensitivity: *mut f64,
    length: usize,
) -> i32 {
    // SAFETY: see above.
    unsafe {
        with(instance, "fmi3GetAdjointDerivative", |c| {
            sizes("seed", seed_length, unknown_count)?;
            sizes("sensitivity", length, known_count)?;
            let (unknowns, knowns) =
                (items("unknowns", unknowns, unknown_count)?, items("knowns", knowns, known_count)?);
            let (seed, out) =
                (items("seed", seed, seed_length)?, places("sensitivity", sensitivity, length)?);
            c.instance.adjoint_derivative(unknowns, knowns, seed, out)
        })
    }
}

/// # Safety
/// See above.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi3UpdateDiscreteStates(
    instance: *mut c_void,
    need_update: *mut bool,
    terminate: *mut bool,
    nominals_changed: *mut bool,
    values_changed: *mut bool,
    next_defined: *mut bool,
    next: *mut f64,
) -> i32 {
    // SAFETY: see above.
    unsafe {
        with(instance, "fmi3UpdateDiscreteStates", |c| {
            let event = c.instance.next_event()?;
            put("discreteStatesNeedUpdate", need_update, false)?;
            put("terminateSimulation", terminate, false)?;
            put("nominalsOfContinuousStatesChanged", nominals_changed, false)?;
            put("valuesOfContinuousStatesChanged", values_changed, false)?;
            put("nextEventTimeDefined", next_defined, event.is_some())?;
            put("nextEventTime", next, event.unwrap_or_default())
        })
    }
}

/// # Safety
/// See above.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi3CompletedIntegratorStep(
    instance: *mut c_void,
    _no_set_state_before: bool,
    enter_event_mode: *mut bool,
    terminate: *mut bool,
) -> i32 {
    // SAFETY: see above.
    unsafe {
        with(instance, "fmi3CompletedIntegratorStep", |c| {
            put("enterEventMode", enter_event_mode, false)?;
            put("terminateSimulation", terminate, false)?;
            c.instance.commit()
        })
    }
}

/// # Safety
/// See above.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi3SetTime(instance: *mut c_void, time: f64) -> i32 {
    // SAFETY: see above.
    unsafe { with(instance, "fmi3SetTime", |c| c.instance.set_time(time)) }
}

/// # Safety
/// See above.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi3SetContinuousStates(
    instance: *mut c_void,
    states: *const f64,
    count: usize,
) -> i32 {
    // SAFETY: see above.
    unsafe {
        with(instance, "fmi3SetContinuousStates", |c| {
            c.instance.set_state(items("continuousStates", states, count)?)
        })
    }
}

/// Writes one list of numbers of an instance.
unsafe fn list(
    instance: *mut c_void,
    what: &str,
    out: (*mut f64, usize),
    find: impl FnOnce(&mut Component) -> Result<Vec<f64>>,
) -> i32 {
    // SAFETY: an array of the importer.
    unsafe {
        with(instance, what, |c| {
            let found = find(c)?;
            sizes("values", out.1, found.len())?;
            places("values", out.0, out.1)?.copy_from_slice(&found);
            Ok(())
        })
    }
}

/// # Safety
/// See above.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi3GetContinuousStates(instance: *mut c_void, out: *mut f64, count: usize) -> i32 {
    // SAFETY: see above.
    unsafe { list(instance, "fmi3GetContinuousStates", (out, count), |c| Ok(c.instance.state()?.to_vec())) }
}

/// # Safety
/// See above.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi3GetContinuousStateDerivatives(
    instance: *mut c_void,
    out: *mut f64,
    count: usize,
) -> i32 {
    // SAFETY: see above.
    unsafe {
        list(instance, "fmi3GetContinuousStateDerivatives", (out, count), |c| {
            Ok(c.instance.rates()?.to_vec())
        })
    }
}

/// # Safety
/// See above.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi3GetNominalsOfContinuousStates(
    instance: *mut c_void,
    out: *mut f64,
    count: usize,
) -> i32 {
    // SAFETY: see above.
    unsafe {
        list(instance, "fmi3GetNominalsOfContinuousStates", (out, count), |c| Ok(c.instance.nominals()))
    }
}

/// # Safety
/// See above.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi3GetEventIndicators(instance: *mut c_void, out: *mut f64, count: usize) -> i32 {
    // SAFETY: see above.
    unsafe { list(instance, "fmi3GetEventIndicators", (out, count), |_| Ok(Vec::new())) }
}

/// # Safety
/// See above.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi3GetNumberOfEventIndicators(instance: *mut c_void, count: *mut usize) -> i32 {
    // SAFETY: see above.
    unsafe { with(instance, "fmi3GetNumberOfEventIndicators", |_| put("nEventIndicators", count, 0)) }
}

/// # Safety
/// See above.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi3GetNumberOfContinuousStates(instance: *mut c_void, count: *mut usize) -> i32 {
    // SAFETY: see above.
    unsafe {
        with(instance, "fmi3GetNumberOfContinuousStates", |c| {
            let states = c.instance.state_count();
            put("nContinuousStates", count, states)
        })
    }
}

/// # Safety
/// See above.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi3DoStep(
    instance: *mut c_void,
    current: f64,
    step: f64,
    _no_set_state_before: bool,
    event_needed: *mut bool,
    terminate: *mut bool,
    early: *mut bool,
    last: *mut f64,
) -> i32 {
    // SAFETY: see above.
    unsafe {
        with(instance, "fmi3DoStep", |c| {
            put("eventHandlingNeeded", event_needed, false)?;
            put("terminateSimulation", terminate, false)?;
            put("earlyReturn", early, false)?;
            let stepped = c.instance.do_step(current, step);
            put("lastSuccessfulTime", last, c.instance.time())?;
            stepped.map(|_| ())
        })
    }
}
