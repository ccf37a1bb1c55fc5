//! FMI 3.0: what units of the library use of it. Names, arguments and statuses are those of `fmi3FunctionTypes.h`.

use super::{Handle, Logger, Wanted, both, instantiate, put, with};
use crate::capi::guard::{free, text};
use crate::error::Result;
use crate::fmi::{Interface, Mode};
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
pub unsafe extern "C" fn fmi3EnterStepMode(instance: *mut c_void) -> i32 {
    // SAFETY: see above.
    unsafe { with(instance, "fmi3EnterStepMode", |c| c.instance.enter(Mode::Step)) }
}

/// # Safety
/// See above.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi3EvaluateDiscreteStates(instance: *mut c_void) -> i32 {
    // SAFETY: see above.
    unsafe { with(instance, "fmi3EvaluateDiscreteStates", |_| Ok(())) }
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
    unsafe { both::get(instance, "fmi3GetFloat64", (references, count, values, length)) }
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
    unsafe { both::set(instance, "fmi3SetFloat64", (references, count, values, length)) }
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
        let variables = [(unknowns, unknown_count), (knowns, known_count)];
        both::differentiate(
            instance,
            "fmi3GetDirectionalDerivative",
            variables,
            (seed, seed_length),
            false,
            (sensitivity, length),
        )
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
        let variables = [(unknowns, unknown_count), (knowns, known_count)];
        both::differentiate(
            instance,
            "fmi3GetAdjointDerivative",
            variables,
            (seed, seed_length),
            true,
            (sensitivity, length),
        )
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
