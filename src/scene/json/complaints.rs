//! What is wrong with a text as typed data, as its reader tells it.

use super::shortened;
use serde::de::{self, Unexpected};
use serde_json::Value;
use std::fmt;
use std::ops::Deref;

/// Longest piece of the text that a message repeats, characters.
const LONGEST_QUOTE: usize = 60;

/// What is wrong: one pointer, so that what reads a value hands little over.
#[derive(Debug)]
pub struct Complaint(Box<Wrong>);

/// What is wrong, and the keys that lead there, the last one first.
#[derive(Debug)]
pub struct Wrong {
    path: Vec<String>,
    /// In words, without the path.
    pub text: String,
    /// Of what kind it is.
    pub kind: Kind,
}

/// Kind of a mistake in the text.
#[derive(Debug)]
pub enum Kind {
    /// A value of the wrong type.
    Value,
    /// A field of this name is missing.
    Missing(&'static str),
    /// The last key of the path is none of these.
    Field(&'static [&'static str]),
    /// A choice is none of the others.
    Choice(String, &'static [&'static str]),
}

impl Deref for Complaint {
    type Target = Wrong;

    fn deref(&self) -> &Wrong {
        &self.0
    }
}

impl Complaint {
    fn new(text: String, kind: Kind) -> Self {
        Self(Box::new(Wrong { path: Vec::new(), text, kind }))
    }

    pub(super) fn expected(what: &str, found: &Value) -> Self {
        let found = shortened(found.to_string(), LONGEST_QUOTE);
        de::Error::custom(format!("expected {what}, found {found}"))
    }

    #[cold]
    #[inline(never)]
    pub(super) fn below(mut self, key: &str) -> Self {
        self.0.path.push(key.to_owned());
        self
    }

    /// The keys that lead there, the first one first.
    pub fn path(&self) -> Vec<String> {
        self.path.iter().rev().cloned().collect()
    }
}

/// "expected `a` or `b`" as serde has it; `none` where nothing is.
fn one_of(names: &[&str], none: &str) -> String {
    match names {
        [] => none.to_owned(),
        [one] => format!("expected `{one}`"),
        [one, other] => format!("expected `{one}` or `{other}`"),
        _ => format!("expected one of `{}`", names.join("`, `")),
    }
}

impl de::Error for Complaint {
    fn custom<T: fmt::Display>(text: T) -> Self {
        Self::new(text.to_string(), Kind::Value)
    }

    fn missing_field(field: &'static str) -> Self {
        Self::new(format!("missing field `{field}`"), Kind::Missing(field))
    }

    fn unknown_field(field: &str, expected: &'static [&'static str]) -> Self {
        let text = format!("unknown field `{field}`, {}", one_of(expected, "there are no fields"));
        Self::new(text, Kind::Field(expected))
    }

    fn unknown_variant(choice: &str, expected: &'static [&'static str]) -> Self {
        let text = format!("unknown variant `{choice}`, {}", one_of(expected, "there are no variants"));
        Self::new(text, Kind::Choice(choice.to_owned(), expected))
    }

    /// Of numbers only, which the reader lets the field's own type judge.
    fn invalid_value(found: Unexpected<'_>, _: &dyn de::Expected) -> Self {
        let found = match found {
            Unexpected::Unsigned(number) => number.to_string(),
            Unexpected::Signed(number) => number.to_string(),
            other => other.to_string(),
        };
        Self::custom(format!("{found} is out of range"))
    }
}

impl fmt::Display for Complaint {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.text)
    }
}

impl std::error::Error for Complaint {}
