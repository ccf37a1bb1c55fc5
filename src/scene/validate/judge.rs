//! Whether a check that fails ends all checks.

use crate::error::Result;
use crate::scene::check::{self, Range, bad};
use std::fmt::Display;

/// Says whether checks go on behind one that fails. They do where it fails because of a value that is known to be wrong.
#[derive(Clone, Copy)]
pub(in crate::scene) struct Judge<'a> {
    /// Paths of such values, which are NaN where they are numbers; `None` where the first failure ends the checks.
    unknown: Option<&'a [String]>,
}

impl<'a> Judge<'a> {
    /// The first failure ends the checks.
    pub(in crate::scene) const STRICT: Self = Self { unknown: None };

    /// Checks go on behind failures of the values at and below these paths.
    pub(in crate::scene) fn beside(unknown: &'a [String]) -> Self {
        Self { unknown: Some(unknown) }
    }

    /// Whether the value at a path is known to be wrong, or is part of one.
    pub(in crate::scene) fn excuses(self, path: &str) -> bool {
        self.unknown.is_some_and(|list| list.iter().any(|place| is_at_or_below(path, place)))
    }

    /// Whether anything at, below or above a path is known to be wrong.
    pub(in crate::scene) fn doubts(self, path: &str) -> bool {
        let below = |list: &[String]| list.iter().any(|place| is_at_or_below(place, path));
        self.excuses(path) || self.unknown.is_some_and(below)
    }

    /// The failure of a check at a path, unless it is excused.
    pub(in crate::scene) fn refuse(self, path: &str, text: impl Display) -> Result<()> {
        self.pass(path, || Err(bad(path, text)))
    }

    /// A check at a path, unless it is excused.
    pub(in crate::scene) fn pass(self, path: &str, check: impl FnOnce() -> Result<()>) -> Result<()> {
        if self.excuses(path) { Ok(()) } else { check() }
    }

    /// As [`check::number`]; nothing is said of a number or a range that is not known.
    pub(in crate::scene) fn number(self, path: &str, value: f64, allowed: Range) -> Result<()> {
        if self.unknown.is_some() && (value + allowed.min + allowed.max).is_nan() {
            return Ok(());
        }
        self.pass(path, || check::number(path, value, allowed))
    }

    /// The same for an optional number.
    pub(in crate::scene) fn optional(self, path: &str, value: Option<f64>, allowed: Range) -> Result<()> {
        value.map_or(Ok(()), |value| self.number(path, value, allowed))
    }
}

/// Whether a dotted path leads to a place or below it.
pub(in crate::scene) fn is_at_or_below(path: &str, place: &str) -> bool {
    path.strip_prefix(place).is_some_and(|rest| rest.is_empty() || rest.starts_with('.'))
}
