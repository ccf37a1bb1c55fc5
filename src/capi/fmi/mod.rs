//! The functions of a functional mock-up unit, FMI 2.0 and 3.0, which importers find by their names in the standard. They are no part of
//! `include/cagedyn.h`: the standard has headers of its own.

mod both;
mod three;
mod three_unused;
mod two;

use super::guard::{Exclusive, status, text};
use crate::error::{Error, Result, Status};
use crate::fmi::{Instance, Interface, Saved, Unit};
use libc::{c_char, c_void};
use std::ffi::CString;
use std::path::Path;
use std::slice;
use std::sync::Arc;

/// Statuses of both versions.
const OK: i32 = 0;
const DISCARD: i32 = 2;
const ERROR: i32 = 3;
const FATAL: i32 = 4;

/// Category of messages, as the description has it.
const CATEGORY: &std::ffi::CStr = c"logStatusError";

/// Whom an importer wants to be told what went wrong.
#[derive(Clone, Copy)]
enum Logger {
    Two { environment: *mut c_void, tell: Option<two::Log> },
    Three { environment: *mut c_void, tell: Option<three::Log> },
}

/// What an importer has of an instance.
struct Component {
    instance: Instance,
    name: CString,
    logger: Logger,
    /// Of co-simulation with event mode.
    with_events: bool,
    /// Start of the run of FMI 2, s, which is told before the initialization.
    start: f64,
}

// SAFETY: one thread at a time has the content; the environment is the importer's own and only handed back.
unsafe impl Send for Component {}

/// What is behind a handle.
type Handle = Exclusive<Component>;

impl Logger {
    /// Tells one line.
    fn tell(&self, name: &CString, status: i32, message: &str) {
        match *self {
            Self::Two { environment, tell: Some(tell) } => {
                // The message is a format of printf, and # opens a value reference.
                let message = message.replace('%', "%%").replace('#', "##");
                let message = super::guard::to_c_string(&message);
                // SAFETY: a function of the importer, with texts that live through the call.
                unsafe { tell(environment, name.as_ptr(), status, CATEGORY.as_ptr(), message.as_ptr()) }
            }
            Self::Three { environment, tell: Some(tell) } => {
                let message = super::guard::to_c_string(message);
                // SAFETY: see above.
                unsafe { tell(environment, status, CATEGORY.as_ptr(), message.as_ptr()) }
            }
            _ => {}
        }
    }
}

/// Status of the standard for an error: a step that cannot be made may be tried in another way.
fn status_of(error: &Error) -> i32 {
    match error.status {
        Status::BadState
        | Status::StepTooSmall
        | Status::TooManySteps
        | Status::OutOfTime
        | Status::Cancelled => DISCARD,
        Status::Internal => FATAL,
        _ => ERROR,
    }
}

/// Runs an entry with the component behind a handle. A failure is told to the importer, a panic is a fatal error.
///
/// # Safety
/// `handle` is NULL or came from an instantiation and was not freed.
unsafe fn with(handle: *mut c_void, what: &str, entry: impl FnOnce(&mut Component) -> Result<()>) -> i32 {
    let mut entry = Some(entry);
    let mut once = |component: &mut Component| entry.take().map_or(Ok(()), |entry| entry(component));
    // SAFETY: see above.
    unsafe { with_component(handle, what, &mut once) }
}

/// The same for all entries in one place.
///
/// # Safety
/// As [`with`].
unsafe fn with_component(
    handle: *mut c_void,
    what: &str,
    entry: &mut dyn FnMut(&mut Component) -> Result<()>,
) -> i32 {
    let mut found = FATAL;
    let guarded = status(|| {
        // SAFETY: see above.
        let Some(exclusive) = (unsafe { handle.cast::<Handle>().as_ref() }) else {
            found = ERROR;
            return Ok(());
        };
        let mut component = exclusive.enter("instance")?;
        let Err(error) = entry(&mut component) else {
            found = OK;
            return Ok(());
        };
        found = status_of(&error);
        component.logger.tell(&component.name, found, &format!("{what}: {}", error.message));
        Ok(())
    });
    if guarded == 0 { found } else { FATAL }
}

/// The items behind a pointer.
///
/// # Safety
/// `items` is NULL or points to `count` items that live as long as the result.
unsafe fn items<'a, T>(name: &str, items: *const T, count: usize) -> Result<&'a [T]> {
    match (items.is_null(), count) {
        (_, 0) => Ok(&[]),
        (true, _) => Err(null(name)),
        // SAFETY: see above; no array is longer than the memory.
        (false, _) => Ok(unsafe {
            slice::from_raw_parts(items, count.min(isize::MAX as usize / size_of::<T>().max(1)))
        }),
    }
}

/// The places behind a pointer.
///
/// # Safety
/// As [`items`]; nobody else has the items.
unsafe fn places<'a, T>(name: &str, items: *mut T, count: usize) -> Result<&'a mut [T]> {
    match (items.is_null(), count) {
        (_, 0) => Ok(&mut []),
        (true, _) => Err(null(name)),
        // SAFETY: see above.
        (false, _) => Ok(unsafe {
            slice::from_raw_parts_mut(items, count.min(isize::MAX as usize / size_of::<T>().max(1)))
        }),
    }
}

/// Writes to a place that must not be NULL.
///
/// # Safety
/// `place` is NULL or a place for a value.
unsafe fn put<T>(name: &str, place: *mut T, value: T) -> Result<()> {
    // SAFETY: see above.
    unsafe { places(name, place, 1) }.map(|places| places[0] = value)
}

fn null(name: &str) -> Error {
    Error::new(Status::NullArgument, format!("{name}: is NULL"))
}

fn sizes(name: &str, found: usize, wanted: usize) -> Result<()> {
    let text = || Error::new(Status::WrongSize, format!("{name}: length {found}, must be {wanted}"));
    if found == wanted { Ok(()) } else { Err(text()) }
}

/// Variables of other types than that of all variables: there are none.
unsafe fn none_of(handle: *mut c_void, what: &str, references: *const u32, count: usize) -> i32 {
    // SAFETY: a handle and references of the importer.
    unsafe {
        with(handle, what, |_| {
            let Some(reference) = items("valueReferences", references, count)?.first() else { return Ok(()) };
            let text = format!(
                "valueReference: {reference} is no variable of this type; all variables are real numbers"
            );
            Err(Error::new(Status::BadIndex, text))
        })
    }
}

/// What an importer wants to instantiate.
struct Wanted<'a> {
    name: *const c_char,
    token: *const c_char,
    interface: Interface,
    logger: Logger,
    with_events: bool,
    resources: &'a dyn Fn() -> Result<std::path::PathBuf>,
}

/// A new handle; NULL after telling what is wrong.
///
/// # Safety
/// Texts are NULL or end with NUL.
unsafe fn instantiate(wanted: &Wanted<'_>) -> *mut c_void {
    let mut made = std::ptr::null_mut();
    let mut failure = None;
    let guarded = status(|| {
        // SAFETY: see above.
        let name = unsafe { text("instanceName", wanted.name) }.map(super::guard::to_c_string);
        let name_or_none = name.clone().unwrap_or_default();
        let component = name.and_then(|name| {
            // SAFETY: see above.
            let token = unsafe { text("instantiationToken", wanted.token) }?;
            let unit = Unit::open(Path::new(&(wanted.resources)()?), token)?;
            Ok(Component {
                instance: Instance::new(Arc::new(unit), wanted.interface),
                name,
                logger: wanted.logger,
                with_events: wanted.with_events,
                start: 0.0,
            })
        });
        match component {
            Ok(component) => made = Box::into_raw(Box::new(Exclusive::new(component))).cast(),
            Err(error) => failure = Some((name_or_none, error)),
        }
        Ok(())
    });
    if guarded != 0 {
        failure = Some((CString::default(), Error::new(Status::Internal, "internal defect".to_owned())));
    }
    if let Some((name, error)) = failure {
        wanted.logger.tell(&name, ERROR, &format!("instantiation: {}", error.message));
    }
    made
}

/// Gives a saved state to the importer: in the place of the one that it has there, if it has.
///
/// # Safety
/// `state` is NULL or a place for a handle; one that is there came from here and was not freed.
unsafe fn give(state: *mut *mut c_void, new: Saved) -> Result<()> {
    // SAFETY: see above.
    let place = unsafe { places("FMUState", state, 1) }?;
    // SAFETY: see above.
    match unsafe { place[0].cast::<Saved>().as_mut() } {
        Some(there) => *there = new,
        None => place[0] = Box::into_raw(Box::new(new)).cast(),
    }
    Ok(())
}

/// What is behind such a handle.
///
/// # Safety
/// `state` is NULL or came from [`give`] and was not freed.
unsafe fn saved<'a>(state: *mut c_void) -> Result<&'a Saved> {
    // SAFETY: see above.
    unsafe { state.cast::<Saved>().as_ref() }.ok_or_else(|| null("FMUState"))
}
