//! What went wrong, in words.

use super::{MAX_TIME, Sim};
use crate::error::Result;
use crate::error::{Error, Status};
use crate::integrate::{Failure, Interruption};
use crate::model::Fault;

impl Sim {
    pub(in crate::sim) fn bad_state(&self, time: f64, fault: Fault) -> Error {
        Error::new(Status::BadState, format!("at t = {time:?} s: {}", self.bearing.describe(fault)))
    }

    pub(in crate::sim) fn failure(&self, failure: Failure<Fault>) -> Error {
        match failure {
            Failure::AtStart { time, fault } | Failure::Overdrawn { time, fault } => {
                self.bad_state(time, fault)
            }
            Failure::StepTooSmall { time, step, fault, group } => {
                let why = match (fault, group.and_then(|group| self.bearing.group_name(group))) {
                    (Some(fault), _) => self.bearing.describe(fault),
                    (None, Some(body)) => format!("the error of {body} stays above the tolerance"),
                    (None, None) => "the error stays above the tolerance".to_owned(),
                };
                let text = format!(
                    "at t = {time:?} s: a step of {step:e} s would be needed, which is too small: {why}"
                );
                Error::new(Status::StepTooSmall, text)
            }
            Failure::TooManySteps { time, limit } => {
                let text = format!("at t = {time:?} s: {limit} steps in one advance (solver.max_steps)");
                Error::new(Status::TooManySteps, text)
            }
            Failure::Interrupted { time, why: Interruption::Cancelled } => {
                Error::new(Status::Cancelled, format!("at t = {time:?} s: stopped on request"))
            }
            Failure::Interrupted { time, why: Interruption::OutOfTime } => Error::new(
                Status::OutOfTime,
                format!("at t = {time:?} s: the limit on the wall time is reached"),
            ),
        }
    }
}

pub(crate) fn check_time(what: &str, t: f64) -> Result<()> {
    if (0.0..=MAX_TIME).contains(&t) {
        return Ok(());
    }
    Err(Error::new(Status::BadValue, format!("{what}: {t} s is not within 0 to {MAX_TIME:e} s")))
}

pub(in crate::sim) fn wrong_size(what: &str, given: usize, expected: usize) -> Error {
    Error::new(Status::WrongSize, format!("{what}: length {given}, must be {expected}"))
}

pub(in crate::sim) fn bad_index(what: &str, index: usize, count: usize) -> Error {
    Error::new(Status::BadIndex, format!("{what}: index {index}, there are {count}"))
}
