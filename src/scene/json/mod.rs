//! From JSON text to typed data and back: `parse` reads the text, `typed` makes the data, both with the path of what is
//! wrong.

mod overrides;
mod parse;
mod schema;
mod typed;

pub use overrides::{parse_override, set_path};
pub use parse::parse;
pub use typed::typed;

use crate::error::{Error, Status};
use std::fmt::Display;

/// An error with the dotted path of its place.
fn complaint(path: &[String], text: impl Display) -> Error {
    let text = if path.is_empty() { text.to_string() } else { format!("{}: {text}", path.join(".")) };
    Error::new(Status::BadJson, text)
}
