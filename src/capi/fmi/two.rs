//! FMI 2.0. Names, arguments and statuses are those of `fmi2FunctionTypes.h`.

use super::{Handle, Logger, Wanted, both, instantiate, items, none_of, put, with};
use crate::capi::guard::{free, text};
use crate::error::{Error, Result, Status};
use crate::fmi::Interface;
use libc::{c_char, c_void};
use std::path::PathBuf;

/// What tells messages: environment, name of the instance, status, category, message and what belongs into it.
pub type Log = unsafe extern "C" fn(*mut c_void, *const c_char, i32, *const c_char, *const c_char, ...);

/// Functions of the importer.
#[repr(C)]
pub struct Callbacks {
    logger: Option<Log>,
    allocate: *const c_void,
    free: *const c_void,
    finished: *const c_void,
    environment: *mut c_void,
}

/// What a unit says of events.
#[repr(C)]
pub struct EventInfo {
    need_update: i32,
    terminate: i32,
    nominals_changed: i32,
    values_changed: i32,
    next_defined: i32,
    next: f64,
}

/// The kind of an instance for co-simulation.
const CO_SIMULATION: i32 = 1;
/// Of a status: the time of the last step that could be made, and whether the run is over.
const LAST_SUCCESSFUL_TIME: i32 = 2;
const TERMINATED: i32 = 3;

/// Types of the platform.
#[unsafe(no_mangle)]
pub extern "C" fn fmi2GetTypesPlatform() -> *const c_char {
    c"default".as_ptr()
}

/// Version of the standard.
#[unsafe(no_mangle)]
pub extern "C" fn fmi2GetVersion() -> *const c_char {
    c"2.0".as_ptr()
}

/// Errors are told whatever this says; there is nothing else to tell.
///
/// # Safety
/// As in the standard, and so for all functions of this file: handles are live, arrays as long as their lengths say.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2SetDebugLogging(
    instance: *mut c_void,
    _logging_on: i32,
    _count: usize,
    _categories: *const *const c_char,
) -> i32 {
    // SAFETY: see above.
    unsafe { with(instance, "fmi2SetDebugLogging", |_| Ok(())) }
}

/// # Safety
/// See above.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2Instantiate(
    name: *const c_char,
    kind: i32,
    token: *const c_char,
    resources: *const c_char,
    callbacks: *const Callbacks,
    _visible: i32,
    _logging_on: i32,
) -> *mut c_void {
    // SAFETY: see above.
    let (environment, tell) =
        unsafe { callbacks.as_ref() }.map_or((std::ptr::null_mut(), None), |c| (c.environment, c.logger));
    // SAFETY: a text of the importer.
    let folder = || of_uri(unsafe { text("fmuResourceLocation", resources) }?);
    let interface = if kind == CO_SIMULATION { Interface::CoSimulation } else { Interface::ModelExchange };
    let logger = Logger::Two { environment, tell };
    // SAFETY: texts of the importer.
    unsafe { instantiate(&Wanted { name, token, interface, logger, with_events: false, resources: &folder }) }
}

/// The folder of a URI such as `file:///units/one/resources`.
fn of_uri(uri: &str) -> Result<PathBuf> {
    let bad = || Error::new(Status::BadText, format!("fmuResourceLocation: '{uri}' is no URI of a file"));
    let rest = uri.strip_prefix("file:").ok_or_else(bad)?;
    let path = match rest.strip_prefix("//") {
        Some(rest) => &rest[rest.find('/').ok_or_else(bad)?..],
        None => rest,
    };
    let (mut bytes, mut left) = (Vec::new(), path.bytes());
    while let Some(byte) = left.next() {
        if byte != b'%' {
            bytes.push(byte);
            continue;
        }
        let digits = [left.next().ok_or_else(bad)?, left.next().ok_or_else(bad)?];
        let digits = std::str::from_utf8(&digits).map_err(|_| bad())?;
        bytes.push(u8::from_str_radix(digits, 16).map_err(|_| bad())?);
    }
    String::from_utf8(bytes).map(PathBuf::from).map_err(|_| bad())
}

/// # Safety
/// See above.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2FreeInstance(instance: *mut c_void) {
    // SAFETY: see above.
    unsafe { free(instance.cast::<Handle>()) }
}

/// # Safety
/// See above.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2SetupExperiment(
    instance: *mut c_void,
    _tolerance_defined: i32,
    _tolerance: f64,
    start: f64,
    _stop_defined: i32,
    _stop: f64,
) -> i32 {
    // SAFETY: see above.
    unsafe {
        with(instance, "fmi2SetupExperiment", |c| {
            c.start = start;
            Ok(())
        })
    }
}

/// # Safety
/// See above.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2EnterInitializationMode(instance: *mut c_void) -> i32 {
    // SAFETY: see above.
    unsafe { with(instance, "fmi2EnterInitializationMode", |c| c.instance.enter_initialization(c.start)) }
}

/// # Safety
/// See above.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2GetReal(
    instance: *mut c_void,
    references: *const u32,
    count: usize,
    out: *mut f64,
) -> i32 {
    // SAFETY: see above.
    unsafe { both::get(instance, "fmi2GetReal", (references, count, out, count)) }
}

/// # Safety
/// See above.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2SetReal(
    instance: *mut c_void,
    references: *const u32,
    count: usize,
    values: *const f64,
) -> i32 {
    // SAFETY: see above.
    unsafe { both::set(instance, "fmi2SetReal", (references, count, values, count)) }
}

/// Getters and setters of types that no variable has.
macro_rules! no_variables {
    ($($name:ident($pointer:ty);)+) => {$(
        /// # Safety
        /// See above.
        #[unsafe(no_mangle)]
        pub unsafe extern "C" fn $name(
            instance: *mut c_void,
            references: *const u32,
            count: usize,
            _values: $pointer,
        ) -> i32 {
            // SAFETY: see above.
            unsafe { none_of(instance, stringify!($name), references, count) }
        }
    )+};
}

no_variables! {
    fmi2GetInteger(*mut i32);
    fmi2GetBoolean(*mut i32);
    fmi2GetString(*mut *const c_char);
    fmi2SetInteger(*const i32);
    fmi2SetBoolean(*const i32);
    fmi2SetString(*const *const c_char);
}

/// # Safety
/// See above.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2GetDirectionalDerivative(
    instance: *mut c_void,
    unknowns: *const u32,
    unknown_count: usize,
    knowns: *const u32,
    known_count: usize,
    seed: *const f64,
    out: *mut f64,
) -> i32 {
    // SAFETY: see above.
    unsafe {
        let variables = [(unknowns, unknown_count), (knowns, known_count)];
        let (seed, out) = ((seed, known_count), (out, unknown_count));
        both::differentiate(instance, "fmi2GetDirectionalDerivative", variables, seed, false, out)
    }
}

/// # Safety
/// See above.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2NewDiscreteStates(instance: *mut c_void, info: *mut EventInfo) -> i32 {
    // SAFETY: see above.
    unsafe {
        with(instance, "fmi2NewDiscreteStates", |c| {
            let event = c.instance.next_event()?;
            let found = EventInfo {
                need_update: 0,
                terminate: 0,
                nominals_changed: 0,
                values_changed: 0,
                next_defined: i32::from(event.is_some()),
                next: event.unwrap_or_default(),
            };
            put("eventInfo", info, found)
        })
    }
}

/// # Safety
/// See above.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2CompletedIntegratorStep(
    instance: *mut c_void,
    _no_set_state_before: i32,
    enter_event_mode: *mut i32,
    terminate: *mut i32,
) -> i32 {
    // SAFETY: see above.
    unsafe {
        with(instance, "fmi2CompletedIntegratorStep", |c| {
            put("enterEventMode", enter_event_mode, 0)?;
            put("terminateSimulation", terminate, 0)?;
            c.instance.commit()
        })
    }
}

/// # Safety
/// See above.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2SetRealInputDerivatives(
    instance: *mut c_void,
    references: *const u32,
    count: usize,
    orders: *const i32,
    values: *const f64,
) -> i32 {
    // SAFETY: see above.
    unsafe {
        with(instance, "fmi2SetRealInputDerivatives", |c| {
            if let Some(order) = items("order", orders, count)?.iter().find(|order| **order != 1) {
                return Err(Error::new(Status::BadValue, format!("order: {order} is not 1")));
            }
            c.instance.set_input_slopes(items("vr", references, count)?, items("value", values, count)?)
        })
    }
}

/// # Safety
/// See above.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2GetRealOutputDerivatives(
    instance: *mut c_void,
    references: *const u32,
    count: usize,
    _orders: *const i32,
    _values: *mut f64,
) -> i32 {
    // SAFETY: see above.
    unsafe { none_of(instance, "fmi2GetRealOutputDerivatives", references, count) }
}

/// # Safety
/// See above.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2DoStep(
    instance: *mut c_void,
    current: f64,
    step: f64,
    _no_set_state_before: i32,
) -> i32 {
    // SAFETY: see above.
    unsafe { with(instance, "fmi2DoStep", |c| c.instance.do_step(current, step).map(|_| ())) }
}

/// # Safety
/// See above.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2GetRealStatus(instance: *mut c_void, kind: i32, value: *mut f64) -> i32 {
    // SAFETY: see above.
    unsafe {
        with(instance, "fmi2GetRealStatus", |c| match kind {
            LAST_SUCCESSFUL_TIME => put("value", value, c.instance.time()),
            _ => Err(no_status(kind)),
        })
    }
}

/// # Safety
/// See above.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2GetBooleanStatus(instance: *mut c_void, kind: i32, value: *mut i32) -> i32 {
    // SAFETY: see above.
    unsafe {
        with(instance, "fmi2GetBooleanStatus", |_| match kind {
            TERMINATED => put("value", value, 0),
            _ => Err(no_status(kind)),
        })
    }
}

fn no_status(kind: i32) -> Error {
    Error::new(
        Status::BadValue,
        format!("kind: there is no such status {kind}; steps do not run beside the importer"),
    )
}

/// # Safety
/// See above.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2CancelStep(instance: *mut c_void) -> i32 {
    // SAFETY: see above.
    unsafe {
        with(instance, "fmi2CancelStep", |_| {
            Err(Error::new(Status::BadValue, "steps do not run beside the importer".to_owned()))
        })
    }
}

/// Statuses of steps that run beside the importer, which do not.
macro_rules! no_statuses {
    ($($name:ident($pointer:ty);)+) => {$(
        /// # Safety
        /// See above.
        #[unsafe(no_mangle)]
        pub unsafe extern "C" fn $name(instance: *mut c_void, kind: i32, _value: $pointer) -> i32 {
            // SAFETY: see above.
            unsafe { with(instance, stringify!($name), |_| Err(no_status(kind))) }
        }
    )+};
}

no_statuses! {
    fmi2GetStatus(*mut i32);
    fmi2GetIntegerStatus(*mut i32);
    fmi2GetStringStatus(*mut *const c_char);
}
