//! Whether a run kept what its preset promises, and if not, why.

use crate::bodies::Power;
use crate::error::{Error, Result, Status};
use crate::model::{Condition, STATIC_LIMIT, STATIC_LIMIT_OF_ROLLERS};
use crate::scene::Method;
use crate::sim::balance::Start;
use crate::sim::preset::numbers;
use crate::sim::{PowerBalance, Sim};
use std::fmt;

/// Less than this share of the stored energy is round-off of a run.
const ROUNDING: f64 = 1e-10;
/// The leapfrog is stable up to this many times the inverse of the highest frequency.
const STABLE: f64 = 2.0;

/// Why a run is not to be trusted.
#[derive(Clone, Debug, PartialEq)]
pub enum Doubt {
    /// More energy is missing than the preset promises.
    MissingEnergy {
        /// What is missing as a share of what passed through.
        share: f64,
        /// The largest share that the preset allows.
        promised: f64,
    },
    /// The balance cannot be closed, because forces are undefined at the end.
    NoBalance(String),
    /// A film that is not passive gave energy.
    CreatedEnergy {
        /// The field by which it can.
        field: String,
        /// What it gave as a share of what passed through.
        share: f64,
        /// The largest share that a run may miss.
        allowed: f64,
    },
    /// A law was outside of where it holds, at a floor that keeps it defined.
    Floor {
        /// Share of the time in which it was so in at least one contact.
        share: f64,
    },
    /// The steps of the leapfrog that was asked for are too long for the fastest contact.
    UnstableStep {
        /// The step, s.
        step: f64,
        /// The longest stable one, s.
        longest: f64,
    },
}

impl fmt::Display for Doubt {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Doubt::MissingEnergy { share, promised } => {
                let (share, promised) = (100.0 * share, 100.0 * promised);
                write!(
                    f,
                    "{share:+.2} % of the energy that passed through is missing, allowed are {promised} %"
                )
            }
            Doubt::NoBalance(why) => write!(f, "the power balance cannot be closed: {why}"),
            Doubt::CreatedEnergy { field, share, allowed } => {
                let (share, allowed) = (100.0 * share, 100.0 * allowed);
                write!(
                    f,
                    "{share:.2} % of the energy that passed through was made by the film of the guide ({field}), allowed are \
                     {allowed} %"
                )
            }
            Doubt::Floor { share } => {
                let share = 100.0 * share;
                write!(
                    f,
                    "in {share:.2} % of the time the thermal factor of a raceway contact was at its floor: rolling speed and \
                     pressure are outside of what it was fitted to"
                )
            }
            Doubt::UnstableStep { step, longest } => {
                write!(
                    f,
                    "leapfrog steps of {step:.3e} s are unstable in the fastest contact above {longest:.3e} s"
                )
            }
        }
    }
}

impl PowerBalance {
    /// Whether no more than this share of the energy that passed through is missing, or no more than round-off.
    pub fn closes(&self, share: f64) -> bool {
        let stored: f64 = self.energy.iter().map(|e| e.kinetic + e.elastic + e.potential.abs()).sum();
        // Written so that what is not a number does not close.
        self.residual().abs() <= share * self.throughput() + ROUNDING * stored
    }
}

impl Sim {
    /// Share of the energy that this simulation's preset lets a trusted run miss: 1e-2 at `draft`, 1e-3 at `engineering`,
    /// 1e-4 at `reference`.
    pub fn promised_balance(&self) -> f64 {
        numbers(self.solver.preset).missing_energy
    }

    /// What speaks against this run, since the start of the scene or the last [`Sim::set_state`]; nothing, if it is to be
    /// trusted.
    pub fn doubts(&mut self) -> Vec<Doubt> {
        let mut doubts = Vec::new();
        if let Method::Leapfrog(_) = self.solver.method {
            let (step, longest) = (self.nominal_step(), STABLE / self.model().highest_frequency());
            if step > longest {
                doubts.push(Doubt::UnstableStep { step, longest });
            }
        }
        let promised = self.promised_balance();
        match self.power_balance() {
            Err(e) => doubts.push(Doubt::NoBalance(e.message)),
            Ok(balance) => {
                if !balance.closes(promised) {
                    doubts.push(Doubt::MissingEnergy { share: balance.relative_residual(), promised });
                }
                doubts.extend(self.created_energy(&balance, promised));
            }
        }
        let share = self.share_of(Condition::AtFloor);
        if share > 0.0 {
            doubts.push(Doubt::Floor { share });
        }
        doubts
    }

    /// What happened in this run that a user should know, though the laws hold: in words, with shares of the time since the start of the
    /// scene or the last [`Sim::set_state`].
    pub fn remarks(&self) -> Vec<String> {
        let words = |condition: Condition| match condition {
            Condition::AtFloor => None,
            Condition::BeyondShoulder => {
                Some("an ellipse reached beyond the shoulder of its ring".to_owned())
            }
            Condition::OnLowShoulder => Some(
                "a ball pressed the side of a low shoulder, which no bearing with a contact angle counts on"
                    .to_owned(),
            ),
            Condition::OverPressed => {
                let limit =
                    1e-9 * if self.model().has_rollers() { STATIC_LIMIT_OF_ROLLERS } else { STATIC_LIMIT };
                Some(format!(
                    "a contact pressure was above {limit} GPa, where races of steel are dented for good (ISO 76)"
                ))
            }
            Condition::Unloaded => Some(format!("no {} pressed the inner ring", self.model().element_kind())),
        };
        let told = Condition::ALL.into_iter().filter_map(|condition| {
            let share = self.share_of(condition);
            words(condition)
                .filter(|_| share > 0.0)
                .map(|words| format!("in {:.2} % of the time {words}", 100.0 * share))
        });
        told.collect()
    }

    /// The doubt about a film that is not passive and gave more than this share of what passed through.
    fn created_energy(&self, balance: &PowerBalance, allowed: f64) -> Option<Doubt> {
        let field = self.model().energy_giving_film()?;
        let share = balance.work[Power::GuideFilm as usize] / balance.throughput();
        (share > allowed).then_some(Doubt::CreatedEnergy { field, share, allowed })
    }

    /// Whether the run is to be trusted.
    ///
    /// # Errors
    /// [`Status::Untrusted`] with every doubt; [`Status::NotJudged`] as [`Sim::not_judged`].
    pub fn trust(&mut self) -> Result<()> {
        let doubts = self.doubts();
        if !doubts.is_empty() {
            return Err(Error::new(Status::Untrusted, in_words(&doubts)));
        }
        self.not_judged().map_or(Ok(()), |why| Err(Error::new(Status::NotJudged, why)))
    }

    /// Why it cannot be known whether the run is to be trusted, even if nothing speaks against it: [`Sim::set_state`] moved it
    /// on the way to where its motion had not led, and of that the balance knows nothing. `None` where it can be known.
    pub fn not_judged(&self) -> Option<String> {
        let Start { set, time, .. } = self.balance;
        (set > 0).then(|| {
            let times = if set == 1 { "once".to_owned() } else { format!("{set} times") };
            format!("the host set the state {times} on the way; the power balance knows what happened after {time:?} s")
        })
    }
}

/// All doubts in one line.
pub(in crate::sim) fn in_words(doubts: &[Doubt]) -> String {
    doubts.iter().map(ToString::to_string).collect::<Vec<_>>().join("; ")
}
