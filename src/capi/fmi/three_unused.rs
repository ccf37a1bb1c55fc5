//! FMI 3.0: what units of the library have no use for. Importers look for every function of the standard before they use any.

use super::{none_of, with};
use crate::error::{Error, Result, Status};
use libc::{c_char, c_void};

/// Getters and setters of types that no variable has.
macro_rules! no_variables {
    ($($name:ident($pointer:ty $(, $more:ident: $type:ty)*);)+) => {$(
        /// # Safety
        /// As in the standard: the handle is live, arrays are as long as their lengths say.
        #[unsafe(no_mangle)]
        pub unsafe extern "C" fn $name(
            instance: *mut c_void,
            references: *const u32,
            count: usize,
            _values: $pointer
            $(, $more: $type)*
        ) -> i32 {
            // SAFETY: see above.
            unsafe { none_of(instance, stringify!($name), references, count) }
        }
    )+};
}

no_variables! {
    fmi3GetFloat32(*mut f32, _length: usize);
    fmi3GetInt8(*mut i8, _length: usize);
    fmi3GetUInt8(*mut u8, _length: usize);
    fmi3GetInt16(*mut i16, _length: usize);
    fmi3GetUInt16(*mut u16, _length: usize);
    fmi3GetInt32(*mut i32, _length: usize);
    fmi3GetUInt32(*mut u32, _length: usize);
    fmi3GetInt64(*mut i64, _length: usize);
    fmi3GetUInt64(*mut u64, _length: usize);
    fmi3GetBoolean(*mut bool, _length: usize);
    fmi3GetString(*mut *const c_char, _length: usize);
    fmi3GetBinary(*mut usize, _binaries: *mut *const u8, _length: usize);
    fmi3GetClock(*mut bool);
    fmi3SetFloat32(*const f32, _length: usize);
    fmi3SetInt8(*const i8, _length: usize);
    fmi3SetUInt8(*const u8, _length: usize);
    fmi3SetInt16(*const i16, _length: usize);
    fmi3SetUInt16(*const u16, _length: usize);
    fmi3SetInt32(*const i32, _length: usize);
    fmi3SetUInt32(*const u32, _length: usize);
    fmi3SetInt64(*const i64, _length: usize);
    fmi3SetUInt64(*const u64, _length: usize);
    fmi3SetBoolean(*const bool, _length: usize);
    fmi3SetString(*const *const c_char, _length: usize);
    fmi3SetBinary(*const usize, _binaries: *const *const u8, _length: usize);
    fmi3SetClock(*const bool);
    fmi3GetIntervalDecimal(*mut f64, _qualifiers: *mut i32);
    fmi3GetIntervalFraction(*mut u64, _resolutions: *mut u64, _qualifiers: *mut i32);
    fmi3GetShiftDecimal(*mut f64);
    fmi3GetShiftFraction(*mut u64, _resolutions: *mut u64);
    fmi3SetIntervalDecimal(*const f64);
    fmi3SetIntervalFraction(*const u64, _resolutions: *const u64);
    fmi3SetShiftDecimal(*const f64);
    fmi3SetShiftFraction(*const u64, _resolutions: *const u64);
    fmi3GetOutputDerivatives(*const i32, _derivatives: *mut f64, _length: usize);
}

fn not_offered() -> Result<()> {
    Err(Error::new(Status::BadValue, "is nothing that this unit offers, as its description says".to_owned()))
}

/// Functions that the description does not offer.
macro_rules! not_offered {
    ($($name:ident($($argument:ident: $type:ty),*);)+) => {$(
        /// # Safety
        /// As in the standard.
        #[unsafe(no_mangle)]
        pub unsafe extern "C" fn $name(instance: *mut c_void $(, $argument: $type)*) -> i32 {
            // SAFETY: see above.
            unsafe { with(instance, stringify!($name), |_| not_offered()) }
        }
    )+};
}

not_offered! {
    fmi3GetNumberOfVariableDependencies(_reference: u32, _count: *mut usize);
    fmi3GetVariableDependencies(_dependent: u32, _own_elements: *mut usize, _independents: *mut u32, _elements: *mut usize, _kinds: *mut i32, _count: usize);
    fmi3EnterConfigurationMode();
    fmi3ExitConfigurationMode();
    fmi3ActivateModelPartition(_clock: u32, _time: f64);
}

/// There is no scheduled execution.
#[unsafe(no_mangle)]
pub extern "C" fn fmi3InstantiateScheduledExecution(
    _name: *const c_char,
    _token: *const c_char,
    _resources: *const c_char,
    _visible: bool,
    _logging_on: bool,
    _environment: *mut c_void,
    _tell: *const c_void,
    _clock_update: *const c_void,
    _lock: *const c_void,
    _unlock: *const c_void,
) -> *mut c_void {
    std::ptr::null_mut()
}
