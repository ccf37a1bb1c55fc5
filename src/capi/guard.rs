//! What every entry of the C ABI passes through: error memory, panic guard, argument checks.

use crate::error::{Error, Result, Status};
use crate::scene::nearest;
use libc::c_char;
use std::cell::{Cell, RefCell, UnsafeCell};
use std::ffi::{CStr, CString};
use std::ops::{Deref, DerefMut};
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::atomic::{AtomicBool, Ordering};

thread_local! {
    /// Status of the last call; apart from its text, so that a call after a success has one number to look at.
    static LAST_STATUS: Cell<i32> = const { Cell::new(0) };
    /// Its text. Has no destructor and never moves, so that a pointer to it can be read as long as the thread lives.
    static LAST_MESSAGE: UnsafeCell<[u8; MESSAGE_ROOM]> = const { UnsafeCell::new([0; MESSAGE_ROOM]) };
    /// What the last search by name that found nothing had to say.
    static LAST_SEARCH: RefCell<String> = const { RefCell::new(String::new()) };
}

/// Longest message with its NUL, bytes; what is longer ends in dots.
const MESSAGE_ROOM: usize = 4096;

/// Clears the error, runs `entry`, and returns its value, or `on_failure` after storing the error. A panic becomes
/// [`Status::Internal`].
pub fn guard<R>(on_failure: impl FnOnce(Status) -> R, entry: impl FnOnce() -> Result<R>) -> R {
    let (mut entry, mut value) = (Some(entry), None);
    let status = run(&mut || {
        value = entry.take().map(|entry| entry()).transpose()?;
        Ok(())
    });
    value.unwrap_or_else(|| on_failure(status))
}

/// Status of an entry; a failure is stored. All entries pass through this one function.
fn run(entry: &mut dyn FnMut() -> Result<()>) -> Status {
    if last_status() != 0 {
        store(0, "");
    }
    let error = match catch_unwind(AssertUnwindSafe(entry)) {
        Ok(Ok(())) => return Status::Ok,
        Ok(Err(error)) => error,
        Err(panic) => {
            let text = panic.downcast_ref::<&str>().map(|s| (*s).to_owned());
            let text = text.or_else(|| panic.downcast_ref::<String>().cloned()).unwrap_or_default();
            Error::new(Status::Internal, format!("internal defect: {text}"))
        }
    };
    store(error.status as i32, &error.message);
    error.status
}

/// Frees a handle that came from `Box::into_raw`; NULL is none. Frees nothing but it: the error of an earlier call stays to be
/// asked for.
///
/// # Safety
/// `handle` is NULL or a live handle; it must not be used afterwards.
pub unsafe fn free<T>(handle: *mut T) {
    if !handle.is_null() {
        // SAFETY: see above. A panic in a destructor has nobody to go to.
        let _ = catch_unwind(AssertUnwindSafe(|| drop(unsafe { Box::from_raw(handle) })));
    }
}

/// [`guard`] for entries that return a status.
pub fn status(entry: impl FnOnce() -> Result<()>) -> i32 {
    guard(|s| s as i32, || entry().map(|()| 0))
}

/// [`guard`] for entries that return a count or an index; failures are negative status codes.
pub fn count(entry: impl FnOnce() -> Result<usize>) -> i64 {
    guard(|s| s as i64, || entry().map(|n| i64::try_from(n).unwrap_or(i64::MAX)))
}

/// Text of the last error of this thread, empty after a success.
pub fn last_message() -> *const c_char {
    LAST_MESSAGE.try_with(|buffer| buffer.get().cast_const().cast()).unwrap_or(EMPTY.as_ptr())
}

/// Status of the last call in this thread.
pub fn last_status() -> i32 {
    LAST_STATUS.get()
}

/// The empty string that stands for "no name".
pub const EMPTY: &CStr = c"";

/// Place of a name among these.
///
/// # Safety
/// `name` is NULL or a NUL-terminated text.
pub unsafe fn find_static(names: &[&[&'static CStr]], name: *const c_char) -> i64 {
    count(|| {
        // SAFETY: see above.
        let name = unsafe { text("name", name) }?;
        place_of(name, names.iter().copied().flatten().copied())
    })
}

/// Place of a name among these. A failure says which of them is nearest, and is remembered for whoever uses its code as an index.
pub fn place_of<'a>(name: &str, names: impl Iterator<Item = &'a CStr> + Clone) -> Result<usize> {
    let place = names.clone().position(|n| n.to_bytes() == name.as_bytes());
    place.ok_or_else(|| {
        let mut text = format!("there is no '{name}'");
        if let Some(meant) = nearest(name, names.filter_map(|n| n.to_str().ok())) {
            text += &format!(", the nearest is '{meant}'");
        }
        let error = Error::new(Status::UnknownName, format!("name: {text}"));
        let _ = LAST_SEARCH.try_with(|last| last.try_borrow_mut().map(|mut last| *last = text));
        error
    })
}

/// One of these names, "" for other numbers.
pub fn static_name(names: &'static [&'static CStr], index: i64) -> *const c_char {
    let name = usize::try_from(index).ok().and_then(|i| names.get(i));
    name.map_or(EMPTY, |name| *name).as_ptr()
}

fn store(status: i32, message: &str) {
    LAST_STATUS.set(status);
    let mut end = message.len().min(MESSAGE_ROOM - 1);
    let more = if end < message.len() { "..." } else { "" };
    end -= more.len();
    while !message.is_char_boundary(end) {
        end -= 1;
    }
    let bytes = message[..end].bytes().chain(more.bytes());
    let bytes = bytes.map(|byte| if byte == 0 { b' ' } else { byte }).chain([0]);
    let _ = LAST_MESSAGE.try_with(|buffer| {
        // SAFETY: it is of this thread, and nothing of it is lent but as a pointer that hosts read between calls.
        let buffer = unsafe { &mut *buffer.get() };
        buffer.iter_mut().zip(bytes).for_each(|(to, byte)| *to = byte);
    });
}

/// A C string of `text`; NUL bytes inside become spaces.
pub fn to_c_string(text: &str) -> CString {
    CString::new(text.replace('\0', " ")).unwrap_or_default()
}

/// The text behind a C string.
///
/// # Safety
/// `text` is NULL or points to a NUL-terminated string that lives as long as the result.
pub unsafe fn text<'a>(name: &str, text: *const c_char) -> Result<&'a str> {
    if text.is_null() {
        return Err(null(name));
    }
    // SAFETY: not NULL; NUL-terminated by the contract of the ABI.
    let text = unsafe { CStr::from_ptr(text) };
    text.to_str().map_err(|e| Error::new(Status::BadText, format!("{name}: not valid UTF-8 ({e})")))
}

/// The object behind a handle.
///
/// # Safety
/// `handle` is NULL or came from the matching constructor and was not freed.
pub unsafe fn shared<'a, T>(name: &str, handle: *const T) -> Result<&'a T> {
    // SAFETY: NULL is checked by as_ref; validity is the contract of the ABI.
    unsafe { handle.as_ref() }.ok_or_else(|| null(name))
}

/// What is behind a handle that one thread uses at a time. A second user gets [`Status::Busy`] and touches nothing.
pub struct Exclusive<C> {
    busy: AtomicBool,
    content: UnsafeCell<C>,
}

// SAFETY: the content is given to one user at a time.
unsafe impl<C: Send> Sync for Exclusive<C> {}

/// The content, until it is dropped.
pub struct InUse<'a, C>(&'a Exclusive<C>);

/// A handle to such an object.
pub trait Handle {
    /// What is behind it.
    type Content;

    /// The object.
    fn exclusive(&self) -> &Exclusive<Self::Content>;
}

impl<C> Exclusive<C> {
    /// An object that nobody uses.
    pub fn new(content: C) -> Self {
        Self { busy: AtomicBool::new(false), content: UnsafeCell::new(content) }
    }

    /// Its content, if nobody else uses it.
    pub fn enter(&self, name: &str) -> Result<InUse<'_, C>> {
        if self.busy.swap(true, Ordering::Acquire) {
            let text = format!("{name}: is used by another thread, or by a batch that runs");
            return Err(Error::new(Status::Busy, text));
        }
        Ok(InUse(self))
    }
}

impl<C> Deref for InUse<'_, C> {
    type Target = C;

    fn deref(&self) -> &C {
        // SAFETY: `busy` was false, so this is the only user.
        unsafe { &*self.0.content.get() }
    }
}

impl<C> DerefMut for InUse<'_, C> {
    fn deref_mut(&mut self) -> &mut C {
        // SAFETY: as above.
        unsafe { &mut *self.0.content.get() }
    }
}

impl<C> Drop for InUse<'_, C> {
    fn drop(&mut self) {
        self.0.busy.store(false, Ordering::Release);
    }
}

/// The content behind a handle that one thread uses at a time.
///
/// # Safety
/// As [`shared`].
pub unsafe fn exclusive<'a, H: Handle + 'a>(name: &str, handle: *const H) -> Result<InUse<'a, H::Content>> {
    // SAFETY: as the caller's.
    unsafe { shared(name, handle) }?.exclusive().enter(name)
}

/// Copies a caller's array into `to`.
///
/// # Safety
/// `from` is NULL or points to `length` numbers.
pub unsafe fn read_array(name: &str, from: *const f64, length: i64, to: &mut [f64]) -> Result<()> {
    check_array(name, from.is_null(), length, to.len())?;
    // SAFETY: both hold to.len() numbers; bytes may be copied whatever the alignment of `from`.
    unsafe { std::ptr::copy(from.cast::<u8>(), to.as_mut_ptr().cast::<u8>(), size_of_val(to)) };
    Ok(())
}

/// Copies `from` into a caller's array.
///
/// # Safety
/// `to` is NULL or points to `length` numbers.
pub unsafe fn write_array<T: Copy>(name: &str, from: &[T], to: *mut T, length: i64) -> Result<()> {
    check_array(name, to.is_null(), length, from.len())?;
    // SAFETY: both hold from.len() numbers; bytes may be copied whatever the alignment of `to`.
    unsafe { std::ptr::copy(from.as_ptr().cast::<u8>(), to.cast::<u8>(), size_of_val(from)) };
    Ok(())
}

/// A caller's array where it lies, or a copy in `room` if it does not lie as numbers should; `room` has the length it must have.
///
/// # Safety
/// As [`read_array`]; the array must not change while what is lent is in use.
pub unsafe fn lend_array<'a>(
    name: &str,
    from: *const f64,
    length: i64,
    room: &'a mut [f64],
) -> Result<&'a [f64]> {
    check_array(name, from.is_null(), length, room.len())?;
    if from.is_aligned() && !from.is_null() {
        // SAFETY: it holds room.len() numbers.
        return Ok(unsafe { std::slice::from_raw_parts(from, room.len()) });
    }
    // SAFETY: as the caller's.
    unsafe { read_array(name, from, length, room) }?;
    Ok(room)
}

/// Copies these, one behind the other, into a caller's array; the first may lie in that array.
///
/// # Safety
/// As [`write_array`], of as many numbers as both have.
pub unsafe fn write_parts(name: &str, parts: [*const [f64]; 2], to: *mut f64, length: i64) -> Result<()> {
    let [first, second] = parts;
    check_array(name, to.is_null(), length, first.len() + second.len())?;
    // SAFETY: it holds both; bytes may be copied whatever the alignment of `to`.
    unsafe {
        std::ptr::copy(first.cast::<u8>(), to.cast::<u8>(), size_of::<f64>() * first.len());
        let to = to.wrapping_add(first.len());
        std::ptr::copy(second.cast::<u8>(), to.cast::<u8>(), size_of::<f64>() * second.len());
    }
    Ok(())
}

/// Checks a caller's array before anything is computed for it. One without numbers may be NULL.
pub fn check_array(name: &str, is_null: bool, length: i64, expected: usize) -> Result<()> {
    if is_null && (length, expected) != (0, 0) {
        return Err(null(name));
    }
    if usize::try_from(length) != Ok(expected) {
        return Err(Error::new(Status::WrongSize, format!("{name}: length {length}, must be {expected}")));
    }
    Ok(())
}

/// An index given by the caller.
pub fn index(name: &str, index: i64, count: usize) -> Result<usize> {
    usize::try_from(index)
        .ok()
        .filter(|&i| i < count)
        .ok_or_else(|| Error::new(Status::BadIndex, no_place(name, index, count)))
}

/// What is said of an index that is none. A negative one is most likely the failure of a search by name.
fn no_place(name: &str, index: i64, count: usize) -> String {
    let code = Status::ALL.into_iter().find(|status| *status as i64 == index && *status != Status::Ok);
    match code {
        Some(code) => {
            let mut text = format!(
                "{name}: index {index} is CAGEDYN_{} of the call that gave it; there are {count}",
                code.name()
            );
            let search = LAST_SEARCH.try_with(|last| last.borrow().clone()).unwrap_or_default();
            if code == Status::UnknownName && !search.is_empty() {
                text += &format!("; the last search without result: {search}");
            }
            text
        }
        None => format!("{name}: index {index}, there are {count}, from 0 on"),
    }
}

fn null(name: &str) -> Error {
    Error::new(Status::NullArgument, format!("{name}: is NULL"))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn message() -> String {
        // SAFETY: the pointer is a C string that lives until the next guarded call of this thread.
        unsafe { CStr::from_ptr(last_message()) }.to_string_lossy().into_owned()
    }

    #[test]
    fn panics_become_errors_and_are_cleared_by_the_next_call() {
        let hook = std::panic::take_hook();
        std::panic::set_hook(Box::new(|_| {}));
        let code = status(|| panic!("broken {}", 7));
        std::panic::set_hook(hook);
        assert_eq!((code, last_status()), (-99, -99));
        assert!(message().contains("broken 7"));
        assert_eq!(status(|| Ok(())), 0);
        assert_eq!((last_status(), message().as_str()), (0, ""));
    }

    /// As a host that keeps the pointer would see it.
    #[test]
    fn a_kept_message_is_what_the_last_call_left_there() {
        let fail = |text: &str| status(|| Err(Error::new(Status::BadValue, text)));
        fail("short");
        let kept = last_message();
        let long = "\u{e4}\0".repeat(MESSAGE_ROOM);
        fail(&long);
        assert_eq!(last_message(), kept);
        let text = message();
        assert!(text.len() < MESSAGE_ROOM && text.len() > MESSAGE_ROOM - 8, "{}", text.len());
        assert_eq!(text, format!("{}...", &long.replace('\0', " ")[..text.len() - 3]));
        fail("again");
        assert_eq!((last_message(), message().as_str()), (kept, "again"));
        assert_eq!(status(|| Ok(())), 0);
        assert_eq!((last_message(), message().as_str()), (kept, ""));
    }

    #[test]
    fn the_nearest_name_is_said_also_of_a_code_used_as_an_index() {
        let names = [c"cage.y_ratio", c"cage.z_ratio"];
        assert_eq!(place_of("cage.z_ratio", names.into_iter()), Ok(1));
        let found = count(|| place_of("cage.y_ration", names.into_iter()));
        let says = "there is no 'cage.y_ration', the nearest is 'cage.y_ratio'";
        assert_eq!(message(), format!("name: {says}"));
        let error = index("index", found, 2).unwrap_err();
        assert!(error.message.ends_with(&format!("; the last search without result: {says}")), "{error}");
        assert_eq!(place_of("wheel", names.into_iter()).unwrap_err().message, "name: there is no 'wheel'");
    }

    #[test]
    fn lengths_and_indices_are_checked() {
        assert!(check_array("a", false, -1, 3).is_err());
        assert!(check_array("a", true, 3, 3).is_err());
        assert!(check_array("a", false, 3, 3).is_ok());
        assert!(check_array("a", true, 0, 0).is_ok() && check_array("a", true, 0, 3).is_err());
        assert!(index("i", -1, 3).is_err() && index("i", 3, 3).is_err());
        assert_eq!(index("i", 2, 3), Ok(2));
    }

    #[test]
    fn arrays_are_lent_where_they_lie_or_copied_if_they_lie_between_numbers() {
        let mut caller = [1.0, 2.0, 3.0, 0.0];
        let (place, mut room) = (caller.as_mut_ptr(), [0.0; 3]);
        // SAFETY: three numbers of four, moved by three bytes there and back.
        unsafe {
            assert_eq!(lend_array("a", place, 3, &mut room).map(<[f64]>::as_ptr), Ok(place.cast_const()));
            let between = place.byte_add(3);
            std::ptr::copy(place.cast::<u8>(), between.cast::<u8>(), size_of_val(&room));
            assert_eq!(lend_array("a", between, 3, &mut room), Ok(&[1.0, 2.0, 3.0][..]));
            assert!(lend_array("a", between, 2, &mut room).is_err());
            write_parts("a", [&raw const room[1..], &raw const room[..1]], between, 3).expect("as many");
            assert_eq!(lend_array("a", between, 3, &mut room), Ok(&[2.0, 3.0, 1.0][..]));
            assert!(write_parts("a", [&raw const room[..], &raw const room[..]], place, 5).is_err());
        }
    }
}
