//! The C ABI: `include/cagedyn.h` is generated from this folder.
//!
//! The only place with `unsafe` code. Every function checks its arguments, catches panics and stores errors per
//! thread (see `guard.rs`); all work happens in the safe library.

#![allow(unsafe_code)]

pub mod batch;
pub mod equilibrium;
/// cbindgen:ignore
#[allow(non_snake_case, reason = "names of the standard")]
pub mod fmi;
pub mod forces;
pub mod geometry;
mod guard;
pub mod heat;
pub mod integrator;
pub mod interval;
pub mod limits;
pub mod line_loads;
pub mod model;
pub mod motion;
pub mod sim;
pub mod statistics;
pub mod whirl;

use crate::error::Status;
use libc::c_char;

/// Major version of the library this header belongs to.
pub const CAGEDYN_VERSION_MAJOR: i32 = 0;
/// Minor version of the library this header belongs to.
pub const CAGEDYN_VERSION_MINOR: i32 = 1;
/// Patch version of the library this header belongs to.
pub const CAGEDYN_VERSION_PATCH: i32 = 0;

/// Preset for searching: many cases, trends, the kind of motion.
pub const CAGEDYN_PRESET_DRAFT: i32 = 0;
/// Preset for results; the default.
pub const CAGEDYN_PRESET_ENGINEERING: i32 = 1;
/// Preset for comparing: trajectories with controlled errors.
pub const CAGEDYN_PRESET_REFERENCE: i32 = 2;

/// Success.
pub const CAGEDYN_OK: i32 = 0;
/// A required pointer is NULL.
pub const CAGEDYN_ERR_NULL_ARGUMENT: i32 = -1;
/// An array has the wrong length.
pub const CAGEDYN_ERR_WRONG_SIZE: i32 = -2;
/// A number is not finite or out of range.
pub const CAGEDYN_ERR_BAD_VALUE: i32 = -3;
/// An index is out of range.
pub const CAGEDYN_ERR_BAD_INDEX: i32 = -4;
/// No item of this name.
pub const CAGEDYN_ERR_UNKNOWN_NAME: i32 = -5;
/// A text is not UTF-8.
pub const CAGEDYN_ERR_BAD_TEXT: i32 = -6;
/// JSON syntax error, wrong type, unknown or missing field.
pub const CAGEDYN_ERR_BAD_JSON: i32 = -7;
/// Well-formed scene that describes nothing that can be simulated.
pub const CAGEDYN_ERR_BAD_SCENE: i32 = -8;
/// A file cannot be read.
pub const CAGEDYN_ERR_FILE: i32 = -9;
/// Forces are undefined at a state, for example without film between cage and guide.
pub const CAGEDYN_ERR_BAD_STATE: i32 = -10;
/// The step size fell below its minimum.
pub const CAGEDYN_ERR_STEP_TOO_SMALL: i32 = -11;
/// The limit on the number of steps was reached.
pub const CAGEDYN_ERR_TOO_MANY_STEPS: i32 = -12;
/// A saved simulation does not fit this model or is damaged.
pub const CAGEDYN_ERR_BAD_SNAPSHOT: i32 = -13;
/// A run was stopped on request, see cagedyn_canceller_cancel().
pub const CAGEDYN_ERR_CANCELLED: i32 = -14;
/// The limit on the wall time was reached, see cagedyn_sim_set_wall_time_limit().
pub const CAGEDYN_ERR_OUT_OF_TIME: i32 = -15;
/// A run did not keep what its preset promises, see cagedyn_sim_trust().
pub const CAGEDYN_ERR_UNTRUSTED: i32 = -16;
/// An object is used by another thread, or by a batch that runs; nothing happened.
pub const CAGEDYN_ERR_BUSY: i32 = -17;
/// Whether a run kept what its preset promises cannot be known, as the host set its state on the way; see cagedyn_sim_trust().
pub const CAGEDYN_ERR_NOT_JUDGED: i32 = -18;
/// A defect in the library; free the object.
pub const CAGEDYN_ERR_INTERNAL: i32 = -99;

/// Version of the library that is linked, for example "0.1.0". Static text.
#[unsafe(no_mangle)]
pub extern "C" fn cagedyn_version() -> *const c_char {
    concat!(env!("CARGO_PKG_VERSION"), "\0").as_ptr().cast()
}

/// Status of the last call in this thread that can fail; CAGEDYN_OK after a success.
#[unsafe(no_mangle)]
pub extern "C" fn cagedyn_error_status() -> i32 {
    guard::last_status()
}

/// Message of the last call in this thread that can fail: one line of UTF-8, empty after a success, never NULL.
/// It lies in a buffer of the thread: the pointer is the same every time and can be read as long as the thread lives, and the next
/// call in this thread overwrites the text. Above 4095 bytes it is cut and ends in "...".
#[unsafe(no_mangle)]
pub extern "C" fn cagedyn_error_message() -> *const c_char {
    guard::last_message()
}

/// Name of a status code without the prefix CAGEDYN_, for example "ERR_BAD_SCENE"; "UNKNOWN" for other numbers.
/// Static text, never NULL.
#[unsafe(no_mangle)]
pub extern "C" fn cagedyn_status_name(status: i32) -> *const c_char {
    let known = Status::ALL.iter().find(|s| **s as i32 == status);
    known.map_or("UNKNOWN\0", |s| s.name_with_nul()).as_ptr().cast()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn constants_match_the_library() {
        let constants = [
            CAGEDYN_OK,
            CAGEDYN_ERR_NULL_ARGUMENT,
            CAGEDYN_ERR_WRONG_SIZE,
            CAGEDYN_ERR_BAD_VALUE,
            CAGEDYN_ERR_BAD_INDEX,
            CAGEDYN_ERR_UNKNOWN_NAME,
            CAGEDYN_ERR_BAD_TEXT,
            CAGEDYN_ERR_BAD_JSON,
            CAGEDYN_ERR_BAD_SCENE,
            CAGEDYN_ERR_FILE,
            CAGEDYN_ERR_BAD_STATE,
            CAGEDYN_ERR_STEP_TOO_SMALL,
            CAGEDYN_ERR_TOO_MANY_STEPS,
            CAGEDYN_ERR_BAD_SNAPSHOT,
            CAGEDYN_ERR_CANCELLED,
            CAGEDYN_ERR_OUT_OF_TIME,
            CAGEDYN_ERR_UNTRUSTED,
            CAGEDYN_ERR_BUSY,
            CAGEDYN_ERR_NOT_JUDGED,
            CAGEDYN_ERR_INTERNAL,
        ];
        assert_eq!(constants.to_vec(), Status::ALL.map(|s| s as i32).to_vec());
        let version = format!("{CAGEDYN_VERSION_MAJOR}.{CAGEDYN_VERSION_MINOR}.{CAGEDYN_VERSION_PATCH}");
        assert_eq!(version, env!("CARGO_PKG_VERSION"));
    }
}
