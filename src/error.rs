//! The one error type of the library.

use std::fmt;

/// Kind of a failure. The numbers are part of the C ABI: they never change and are never reused.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[repr(i32)]
pub enum Status {
    /// Success.
    Ok = 0,
    /// A required pointer is NULL.
    NullArgument = -1,
    /// An array has the wrong length.
    WrongSize = -2,
    /// A number is not finite or out of range.
    BadValue = -3,
    /// An index is out of range.
    BadIndex = -4,
    /// No item of this name.
    UnknownName = -5,
    /// A text is not UTF-8.
    BadText = -6,
    /// JSON syntax error, wrong type, unknown or missing field.
    BadJson = -7,
    /// Well-formed scene that describes nothing that can be simulated.
    BadScene = -8,
    /// A file cannot be read or written.
    File = -9,
    /// Forces are undefined at a state (for example no film between cage and guide).
    BadState = -10,
    /// The step size fell below its minimum.
    StepTooSmall = -11,
    /// The limit on the number of steps was reached.
    TooManySteps = -12,
    /// A saved simulation does not fit this model or is damaged.
    BadSnapshot = -13,
    /// A run was stopped on request.
    Cancelled = -14,
    /// The limit on the wall time was reached.
    OutOfTime = -15,
    /// A run did not keep what its preset promises.
    Untrusted = -16,
    /// An object is used by another thread, or by a batch that runs.
    Busy = -17,
    /// Whether a run kept what its preset promises cannot be known, as the host set its state on the way.
    NotJudged = -18,
    /// A defect in the library; the object should be freed.
    Internal = -99,
}

impl Status {
    /// All kinds, in the order of their codes.
    pub const ALL: [Status; 20] = [
        Status::Ok,
        Status::NullArgument,
        Status::WrongSize,
        Status::BadValue,
        Status::BadIndex,
        Status::UnknownName,
        Status::BadText,
        Status::BadJson,
        Status::BadScene,
        Status::File,
        Status::BadState,
        Status::StepTooSmall,
        Status::TooManySteps,
        Status::BadSnapshot,
        Status::Cancelled,
        Status::OutOfTime,
        Status::Untrusted,
        Status::Busy,
        Status::NotJudged,
        Status::Internal,
    ];

    /// Stable name in the C ABI, without the prefix `CAGEDYN_`. Ends in NUL for use from C.
    pub fn name_with_nul(self) -> &'static str {
        match self {
            Status::Ok => "OK\0",
            Status::NullArgument => "ERR_NULL_ARGUMENT\0",
            Status::WrongSize => "ERR_WRONG_SIZE\0",
            Status::BadValue => "ERR_BAD_VALUE\0",
            Status::BadIndex => "ERR_BAD_INDEX\0",
            Status::UnknownName => "ERR_UNKNOWN_NAME\0",
            Status::BadText => "ERR_BAD_TEXT\0",
            Status::BadJson => "ERR_BAD_JSON\0",
            Status::BadScene => "ERR_BAD_SCENE\0",
            Status::File => "ERR_FILE\0",
            Status::BadState => "ERR_BAD_STATE\0",
            Status::StepTooSmall => "ERR_STEP_TOO_SMALL\0",
            Status::TooManySteps => "ERR_TOO_MANY_STEPS\0",
            Status::BadSnapshot => "ERR_BAD_SNAPSHOT\0",
            Status::Cancelled => "ERR_CANCELLED\0",
            Status::OutOfTime => "ERR_OUT_OF_TIME\0",
            Status::Untrusted => "ERR_UNTRUSTED\0",
            Status::Busy => "ERR_BUSY\0",
            Status::NotJudged => "ERR_NOT_JUDGED\0",
            Status::Internal => "ERR_INTERNAL\0",
        }
    }

    /// Stable name in the C ABI, without the prefix `CAGEDYN_`.
    pub fn name(self) -> &'static str {
        self.name_with_nul().trim_end_matches('\0')
    }
}

/// A failure with a one-line message that names the place, the value and what is allowed.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Error {
    /// Kind.
    pub status: Status,
    /// One line of text.
    pub message: String,
}

impl Error {
    /// A failure of the given kind. Line breaks in the message become spaces.
    pub fn new(status: Status, message: impl Into<String>) -> Self {
        let mut message = message.into();
        if message.contains(['\n', '\r']) {
            message = message.replace(['\n', '\r'], " ");
        }
        Self { status, message }
    }

    /// Whether a host has ended what failed: on request, or with its limit on the wall time.
    pub(crate) fn is_stop(&self) -> bool {
        matches!(self.status, Status::Cancelled | Status::OutOfTime)
    }
}

impl fmt::Display for Error {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.message)
    }
}

impl std::error::Error for Error {}

/// Result of the library's functions.
pub type Result<T> = std::result::Result<T, Error>;
