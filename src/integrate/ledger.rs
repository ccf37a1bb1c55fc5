//! Keeps account of the energy of a run, and tells when a method without error estimate misses too much of it.
//!
//! The works of all forces ([`System::quadratures`]) less the gain of stored energy ([`System::energy`]) are zero for an exact
//! solution. What is missing, as a share of what passed through, is an error of the whole run.

use super::{Quadratures, Reader, System, add_weighted};

/// Share of the energy that may be missing before something is done about it.
const MUCH: f64 = 2e-4;
/// Steps from one look to the next: at first, and at most. A look costs an evaluation.
const FIRST_INTERVAL: u64 = 8;
const LONGEST_INTERVAL: u64 = 64;

/// Energy that passed through a system, J: all that came in by work, or was stored before and is no longer.
pub fn throughput(works: impl IntoIterator<Item = f64>, gains: impl IntoIterator<Item = f64>) -> f64 {
    let sources = works.into_iter().chain(gains.into_iter().map(|x| -x));
    let [came, went] = sources.fold(
        [0.0, 0.0],
        |[came, went]: [f64; 2], x| if x > 0.0 { [came + x, went] } else { [came, went - x] },
    );
    came.max(went)
}

/// The account.
#[derive(Clone, Debug)]
pub struct Ledger {
    /// Whether `start` is known.
    open: bool,
    start: [f64; 3],
    works: Quadratures,
    /// What was missing at the last look, what of it has been acted upon, and what passed through, J.
    missing: f64,
    settled: f64,
    passed: f64,
    /// The first and the last of these when the account was opened.
    missing_before: f64,
    passed_before: f64,
    /// Steps until the next look, and between looks.
    due: u64,
    interval: u64,
    a: Vec<f64>,
}

impl Ledger {
    /// An empty account of a system with this many velocities.
    pub fn new(velocities: usize) -> Self {
        Self {
            open: false,
            start: [0.0; 3],
            works: Quadratures::default(),
            missing: 0.0,
            settled: 0.0,
            passed: 0.0,
            missing_before: 0.0,
            passed_before: 0.0,
            due: FIRST_INTERVAL,
            interval: FIRST_INTERVAL,
            a: vec![0.0; velocities],
        }
    }

    /// Forgets everything: the next look opens the account.
    pub fn forget(&mut self) {
        *self = Self { a: std::mem::take(&mut self.a), ..Self::new(0) };
    }

    /// Ends the account, as the state may jump; the next look goes on from there with what was missing and what passed.
    pub fn close(&mut self) {
        self.open = false;
        (self.missing_before, self.passed_before) = (self.missing, self.passed);
    }

    /// Looks more often, as at first: another method goes on.
    pub fn hurry(&mut self) {
        (self.due, self.interval) = (FIRST_INTERVAL, FIRST_INTERVAL);
    }

    /// Adds the works of a step.
    pub fn add(&mut self, works: &Quadratures) {
        add_weighted(&mut self.works, 1.0, works);
        self.due = self.due.saturating_sub(1);
    }

    /// Whether the next look opens the account.
    pub fn is_closed(&self) -> bool {
        !self.open
    }

    /// Whether it is time for a look.
    pub fn is_due(&self) -> bool {
        self.due == 0
    }

    /// Looks at the present state, `positions` of positions and the velocities, at time `t` in s.
    ///
    /// # Errors
    /// The system's fault at this state.
    pub fn look<S: System>(&mut self, system: &mut S, t: f64, state: &[f64]) -> Result<(), S::Fault> {
        if self.due == 0 {
            self.interval = (2 * self.interval).min(LONGEST_INTERVAL);
            self.due = self.interval;
        }
        let (q, v) = state.split_at(system.positions());
        system.accelerations(t, q, v, &mut self.a)?;
        let energy = system.energy(q, v);
        if !self.open {
            (self.open, self.start, self.works) = (true, energy, Quadratures::default());
        }
        let gains = [0, 1, 2].map(|k| energy[k] - self.start[k]);
        let missing = self.works.iter().sum::<f64>() - gains.iter().sum::<f64>();
        self.missing = self.missing_before + missing;
        self.passed = self.passed_before + throughput(self.works, gains);
        Ok(())
    }

    /// Whether too much more is missing than when something was done about it last.
    pub fn misses_much(&self) -> bool {
        let much = MUCH * self.passed;
        self.missing.abs() > much && (self.missing - self.settled).abs() > much
    }

    /// Something is done about what is missing.
    pub fn settle(&mut self) {
        self.settled = self.missing;
    }

    /// Whether little enough is missing of all for steps that may miss some more.
    pub fn can_spare(&self) -> bool {
        self.missing.abs() <= MUCH * self.passed
    }

    /// Appends everything that the next decisions depend on.
    pub fn save(&self, out: &mut Vec<f64>) {
        out.push(f64::from(u8::from(self.open)));
        out.extend(self.start.iter().chain(&self.works));
        out.extend([self.missing, self.settled, self.passed, self.missing_before, self.passed_before]);
        out.extend([self.due, self.interval].map(|n| n as f64));
    }

    /// Takes back what [`Ledger::save`] wrote; `None` if it does not fit.
    pub fn load(&mut self, from: &mut Reader<'_>) -> Option<()> {
        self.open = from.flag()?;
        from.fill(&mut self.start)?;
        from.fill(&mut self.works)?;
        let [missing, passed] = [&mut self.missing_before, &mut self.passed_before];
        for number in [&mut self.missing, &mut self.settled, &mut self.passed, missing, passed] {
            *number = from.number()?;
        }
        self.due = from.count()?;
        self.interval = from.count().filter(|n| (FIRST_INTERVAL..=LONGEST_INTERVAL).contains(n))?;
        Some(())
    }
}
