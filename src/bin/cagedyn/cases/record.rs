//! What is kept of a case that is done, so that it is not run again.

use crate::CasesArgs;
use crate::points::spectrum::Spectrum;
use crate::points::{Records, Row};
use crate::results::files::plain;
use crate::results::finished::Run;
use crate::results::output::SUMMARY;
use crate::results::summary::Summary;
use crate::starts::Starts;
use cagedyn::model::{HostInputs, Input};
use cagedyn::scene::Case;
use cagedyn::{Error, Scene, Status};
use serde::{Deserialize, Serialize};
use serde_json::{Value, json};
use std::f64::consts::TAU;
use std::path::Path;

/// Failures of the machine and the moment, which another attempt may not have.
const PASSING: [Status; 3] = [Status::File, Status::OutOfTime, Status::Cancelled];

/// A case that was run, or could not be. Numbers are texts, which keep their digits.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct Record {
    /// Fingerprint of all that the results depend on.
    of: String,
    /// Results, and why there are none.
    pub row: Row,
    /// Inner ring speed at the end, 1/min, without sign.
    speed: Option<String>,
    /// Wall time of the simulation, s.
    wall_time: Option<String>,
    /// Motions from several starts in words.
    pub starts: Option<String>,
    /// Files in the folder of the case, and a fingerprint of the summary among them.
    files: Vec<String>,
    summary: Option<String>,
}

impl Record {
    /// Of a run whose files are in this folder.
    pub fn of_run(of: &str, folder: &Path, run: &Run, summary: &Summary) -> Self {
        let row = match &run.failure {
            Some(e) => Row::failed(Vec::new(), Some(run.time), e),
            None if run.interrupted => {
                Row::failed(Vec::new(), Some(run.time), &Error::new(Status::Cancelled, "interrupted"))
            }
            None => Row { spectrum: Spectrum::of(run, summary), ..Row::complete(Vec::new(), summary) },
        };
        let speed = run.model.inputs_at(run.time, &HostInputs::default()).of(Input::RingSpeed);
        Self {
            of: of.to_owned(),
            row,
            speed: Some(plain(speed.abs() * 60.0 / TAU)),
            wall_time: Some(plain(run.wall)),
            starts: summary.starts.as_ref().map(Starts::in_words),
            files: summary.files.clone(),
            summary: fingerprint_of_file(&folder.join(SUMMARY)),
        }
    }

    /// Of a case that did not start.
    pub fn of_failure(of: &str, e: &Error) -> Self {
        let row = Row::failed(Vec::new(), None, e);
        Self {
            of: of.to_owned(),
            row,
            speed: None,
            wall_time: None,
            starts: None,
            files: Vec::new(),
            summary: None,
        }
    }

    /// Inner ring speed at the end, 1/min, without sign; NaN of a case that did not start.
    pub fn speed(&self) -> f64 {
        self.speed.as_ref().and_then(|text| text.parse().ok()).unwrap_or(f64::NAN)
    }

    /// Wall time of the simulation, s.
    pub fn wall_time(&self) -> Option<f64> {
        self.wall_time.as_ref()?.parse().ok()
    }

    /// Whether it was interrupted.
    pub fn interrupted(&self) -> bool {
        self.row.error.as_ref().is_some_and(|(code, _)| code == Status::Cancelled.name())
    }

    /// Whether another attempt would have the same end.
    pub fn lasts(&self) -> bool {
        let passing = |code: &str| PASSING.iter().any(|status| status.name() == code);
        !self.row.error.as_ref().is_some_and(|(code, _)| passing(code))
    }

    /// Keeps it, if another attempt would have the same end.
    ///
    /// # Errors
    /// [`Status::File`].
    pub fn keep(&self, records: &Records, case: &Case) -> cagedyn::Result<()> {
        if self.lasts() { records.keep(&case.name, self) } else { Ok(()) }
    }

    /// The record of a case with this fingerprint, whose files are still in its folder as they were written.
    pub fn kept(records: &Records, case: &Case, of: &str, folder: &Path) -> Option<Self> {
        let record: Self = records.get(&case.name).filter(|record: &Self| record.of == of)?;
        let whole = record.files.iter().all(|name| folder.join(name).is_file())
            && (record.files.is_empty() || record.summary == fingerprint_of_file(&folder.join(SUMMARY)));
        whole.then_some(record)
    }
}

/// Fingerprint of all that the results of a case depend on: the scene as it is run, what its files tell of it, options, and the
/// build of this program.
pub fn fingerprint_of_case(
    args: &CasesArgs,
    base: &Path,
    case: &Case,
    scene: &Scene,
    comment: &Option<Value>,
) -> String {
    let instead = &args.instead;
    let all = json!({
        "build": env!("CAGEDYN_BUILD"),
        "file": base.display().to_string(),
        "case": case,
        "scene": scene,
        "comment": comment,
        "starts": [json!(instead.starts), json!(instead.start_shift), json!(instead.start_spin)],
        "max_wall_time": instead.max_wall_time,
        "large_table": instead.large_table,
    });
    fingerprint(all.to_string().as_bytes())
}

fn fingerprint_of_file(path: &Path) -> Option<String> {
    Some(fingerprint(&std::fs::read(path).ok()?))
}

/// The same for the same bytes with every version of the compiler: FNV-1a (G. Fowler, L. C. Noll, K.-P. Vo).
fn fingerprint(bytes: &[u8]) -> String {
    let add = |hash: u64, byte: &u8| (hash ^ u64::from(*byte)).wrapping_mul(0x0000_0100_0000_01b3);
    format!("{:016x}", bytes.iter().fold(0xcbf2_9ce4_8422_2325, add))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn fingerprints_are_those_of_the_literature() {
        assert_eq!(fingerprint(b""), "cbf29ce484222325");
        assert_eq!(fingerprint(b"foobar"), "85944171f73967e8");
    }

    #[test]
    fn failures_of_the_moment_do_not_last() {
        let of = |status| Record::of_failure("", &Error::new(status, "x"));
        assert!(of(Status::TooManySteps).lasts() && of(Status::BadScene).lasts());
        for status in PASSING {
            assert!(!of(status).lasts(), "{}", status.name());
        }
        assert!(of(Status::Cancelled).interrupted() && !of(Status::File).interrupted());
    }
}
