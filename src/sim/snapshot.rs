//! Saving and restoring a simulation as a flat array of numbers, with bit-identical continuation.

use super::balance::Start;
use super::{Evaluated, Sim};
use crate::error::{Error, Result, Status};
use crate::integrate::Tuning;
use crate::model::{FaultCounts, HostInputs, LawCounts, Model};
use crate::scene::{Record, Scene, Solver};
use crate::stored::{Reader, Stored, stored};
use std::hash::{DefaultHasher, Hash, Hasher};

/// First number of a snapshot; changes when its content changes.
const FORMAT: f64 = 15.0;

/// Numbers of the checksum, and in front of the content: format, fingerprint, checksum.
const CHECKSUM: usize = 2;
const HEAD: usize = 3 + CHECKSUM;

/// What a simulation knows beside its driver.
struct Content {
    time: f64,
    /// Evaluations and Jacobians.
    counts: [u64; 2],
    laws: LawCounts,
    faults: FaultCounts,
    rejections: Vec<u64>,
    host: HostInputs,
    state: Vec<f64>,
    balance: Start,
}

stored! {
    impl[] Content { time, counts, laws, faults, rejections, host, state, balance }
    if |content| content.time >= 0.0
}

impl Sim {
    fn content(&self) -> Content {
        let bearing = &self.bearing;
        Content {
            time: self.time,
            counts: [bearing.evaluations(), bearing.jacobians()],
            laws: bearing.law_counts(),
            faults: *bearing.fault_counts(),
            rejections: bearing.rejections().to_vec(),
            host: *bearing.host(),
            state: self.state.clone(),
            balance: self.balance,
        }
    }

    /// Everything the future of this simulation depends on, for a model of the same physics in the same build of the library:
    /// title, comments and what is recorded may differ.
    pub fn save(&self) -> Vec<f64> {
        let mut out = vec![FORMAT];
        out.extend(self.fingerprint);
        out.extend([0.0; 2]);
        self.content().save(&mut out);
        self.driver.save_for_later(&mut out);
        let checksum = checksum(&out[HEAD..]);
        out[HEAD - checksum.len()..HEAD].copy_from_slice(&checksum);
        out
    }

    /// Length of [`Sim::save`]'s result; the same at all times.
    pub fn save_len(&self) -> usize {
        self.save().len()
    }

    /// Continues from a snapshot of a simulation of the same scene.
    ///
    /// # Errors
    /// [`Status::BadSnapshot`]; the simulation is then unchanged.
    pub fn restore(&mut self, snapshot: &[f64]) -> Result<()> {
        let before = self.save();
        let bad = |text: &str| Error::new(Status::BadSnapshot, format!("snapshot: {text}"));
        if snapshot.len() != before.len() {
            return Err(bad(&format!("length {}, must be {}", snapshot.len(), before.len())));
        }
        if let Some(i) = snapshot.iter().position(|x| !x.is_finite()) {
            return Err(bad(&format!("item {i} is {}, not a finite number", snapshot[i])));
        }
        let head = HEAD - CHECKSUM;
        if snapshot[..head] != before[..head] {
            return Err(bad("made from a scene of other physics, or by another build of the library"));
        }
        if snapshot[head..HEAD] != checksum(&snapshot[HEAD..]) {
            return Err(bad("damaged"));
        }
        let loaded = self.load(snapshot);
        if loaded.is_none() {
            // What was just saved fits, so this brings the old simulation back.
            let _ = self.load(&before);
        }
        self.begin_interval();
        loaded.ok_or_else(|| bad("damaged"))
    }

    fn load(&mut self, snapshot: &[f64]) -> Option<()> {
        let mut from = Reader::new(snapshot.get(HEAD..)?);
        let mut content = self.content();
        content.load(&mut from)?;
        self.driver.load(&mut from)?;
        from.finished().then_some(())?;
        let Content { time, counts, laws, faults, rejections, host, state, balance } = content;
        *self.bearing.host_mut() = host;
        self.bearing.begin_works(&balance.energy);
        // The stretch that covers this time is made again, whatever the wall time; the state must be the one that it gives.
        let limits = std::mem::take(self.bearing.limits_mut());
        let made = self.driver.advance(&mut self.bearing, time);
        *self.bearing.limits_mut() = limits;
        made.ok()?;
        self.driver.covers(time).then_some(())?;
        self.driver.state_at(time, &mut self.state);
        if self.state != state {
            return None;
        }
        self.time = time;
        self.balance = balance;
        self.bearing.set_counts(counts, laws);
        self.bearing.rejections_mut().copy_from_slice(&rejections);
        self.bearing.set_fault_counts(faults);
        self.evaluated = Evaluated::Other;
        Some(())
    }
}

/// Physics of the scene, solver, preset, tuning and build of the library, hashed into two numbers that fit exactly into f64.
pub(super) fn fingerprint(model: &Model, solver: &Solver, tuning: &Tuning) -> [f64; 2] {
    let mut hasher = DefaultHasher::new();
    env!("CAGEDYN_BUILD").hash(&mut hasher);
    let physics = Scene { title: None, record: Record::of(1.0, 1.0), ..model.scene().copied() };
    physics.to_json().hash(&mut hasher);
    solver.preset.hash(&mut hasher);
    tuning.values().iter().for_each(|value| value.to_bits().hash(&mut hasher));
    halves(hasher.finish())
}

fn checksum(content: &[f64]) -> [f64; CHECKSUM] {
    let mut hasher = DefaultHasher::new();
    content.iter().for_each(|x| x.to_bits().hash(&mut hasher));
    halves(hasher.finish())
}

/// A hash as two numbers without loss.
fn halves(bits: u64) -> [f64; 2] {
    [(bits >> 32) as f64, (bits & 0xffff_ffff) as f64]
}
