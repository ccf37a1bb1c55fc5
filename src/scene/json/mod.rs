//! From JSON text to typed data and back: `parse` reads the text, `typed` makes the data, both with the path of what is
//! wrong.

mod complaints;
mod lines;
mod overrides;
mod parse;
mod schema;
mod typed;
mod unknown;

pub use complaints::Complaint;
pub(crate) use lines::line_of;
pub use overrides::{parse_override, set_path};
pub use parse::{parse, parse_located};
pub use typed::{PICKS, UNKNOWN_TEXT, typed, typed_beside};
pub use unknown::Unknown;
pub(crate) use unknown::nearest;

use crate::error::{Error, Status};
use std::fmt::Display;

/// Longest message, characters: keys and words of a text can be of any length.
const LONGEST_MESSAGE: usize = 500;

/// An error with the dotted path of its place.
fn complaint(path: &[String], text: impl Display) -> Error {
    let text = if path.is_empty() { text.to_string() } else { format!("{}: {text}", path.join(".")) };
    Error::new(Status::BadJson, shortened(text, LONGEST_MESSAGE))
}

/// A text of at most `longest` characters, and dots where it was longer.
fn shortened(mut text: String, longest: usize) -> String {
    if let Some((end, _)) = text.char_indices().nth(longest) {
        text.truncate(end);
        text.push_str("...");
    }
    text
}
