//! The power balance of a run, stretch by stretch: which of them missed too much energy.
//!
//! The works of all forces ([`Observed::powers`]) less the gain of stored energy ([`Observed::energy`]) are zero for an exact
//! solution. What is missing, as a share of what passed through, is an error of all of the integration.

use crate::integrate::{Observed, Tuning, add_weighted};
use crate::stored::stored;

/// Energy that passed through a system, J: all that came in by work, or was stored before and is no longer.
pub fn throughput(works: impl IntoIterator<Item = f64>, gains: impl IntoIterator<Item = f64>) -> f64 {
    let sources = works.into_iter().chain(gains.into_iter().map(|x| -x));
    let [came, went] = sources.fold(
        [0.0, 0.0],
        |[came, went]: [f64; 2], x| if x > 0.0 { [came + x, went] } else { [came, went - x] },
    );
    came.max(went)
}

/// Works and gains of stored energy over some time, J.
#[derive(Clone, Debug)]
struct Turnover {
    works: Vec<f64>,
    gains: [f64; 3],
}

impl Turnover {
    fn clear(&mut self) {
        self.works.fill(0.0);
        self.gains = [0.0; 3];
    }

    /// Counts only this share of what passed so far.
    fn fade(&mut self, kept: f64) {
        self.works.iter_mut().chain(&mut self.gains).for_each(|energy| *energy *= kept);
    }

    fn add(&mut self, other: &Self) {
        add_weighted(&mut self.works, 1.0, &other.works);
        for (sum, gain) in self.gains.iter_mut().zip(other.gains) {
            *sum += gain;
        }
    }

    fn missing(&self) -> f64 {
        self.works.iter().sum::<f64>() - self.gains.iter().sum::<f64>()
    }

    /// What is missing as a share of what passed through; zero where nothing passed.
    fn missing_share(&self) -> f64 {
        let missing = self.missing();
        let passed = throughput(self.works.iter().copied(), self.gains);
        if missing == 0.0 { 0.0 } else { (missing / passed).abs() }
    }
}

/// The balance.
#[derive(Clone, Debug)]
pub struct Balance {
    tuning: Tuning,
    /// Share that a run may miss.
    allowed: f64,
    /// Whether `energy` is that of the start of the stretch.
    open: bool,
    energy: [f64; 3],
    stretch: Turnover,
    /// All before the stretch.
    before: Turnover,
    /// The last stretches; the further back, the less.
    latest: Turnover,
    a: Vec<f64>,
}

impl Balance {
    /// An empty balance of a system whose runs may miss this share of their energy.
    pub fn new<S: Observed>(system: &S, allowed: f64, tuning: Tuning) -> Self {
        let [powers, _] = system.power_count();
        let nothing = Turnover { works: vec![0.0; powers], gains: [0.0; 3] };
        Self {
            tuning,
            allowed,
            open: false,
            energy: [0.0; 3],
            stretch: nothing.clone(),
            before: nothing.clone(),
            latest: nothing,
            a: vec![0.0; system.velocities()],
        }
    }

    /// Forgets everything: the next stretch opens the balance.
    pub fn forget(&mut self) {
        self.close();
        self.before.clear();
        self.latest.clear();
    }

    /// Ends the stretch without a judgement, as the state may jump.
    pub fn close(&mut self) {
        self.open = false;
        self.stretch.clear();
    }

    /// Whether a stretch has begun.
    pub fn is_open(&self) -> bool {
        self.open
    }

    /// Begins a stretch at time `t` (s) and this state.
    ///
    /// # Errors
    /// The system's fault at this state.
    pub fn open<S: Observed>(&mut self, system: &mut S, t: f64, state: &[f64]) -> Result<(), S::Fault> {
        self.energy = self.energy_at(system, t, state)?;
        self.open = true;
        self.stretch.clear();
        Ok(())
    }

    /// Adds the works of a step.
    pub fn add(&mut self, works: &[f64]) {
        add_weighted(&mut self.stretch.works, 1.0, works);
    }

    /// Ends the stretch at time `t` (s) and this state, where the next one begins. Whether it missed little enough, or the
    /// whole run has and, of steps whose errors nobody `controlled`, the latest stretches, too.
    ///
    /// # Errors
    /// The system's fault at this state; the stretch then goes on.
    pub fn settle<S: Observed>(
        &mut self,
        system: &mut S,
        t: f64,
        state: &[f64],
        controlled: bool,
    ) -> Result<bool, S::Fault> {
        let energy = self.energy_at(system, t, state)?;
        self.stretch.gains = [0, 1, 2].map(|k| energy[k] - self.energy[k]);
        self.energy = energy;
        self.before.add(&self.stretch);
        self.latest.fade(self.tuning.latest_memory);
        self.latest.add(&self.stretch);
        let (missing, missing_share) = (self.stretch.missing(), self.stretch.missing_share());
        self.stretch.clear();
        let stored: f64 = energy.iter().map(|x| x.abs()).sum();
        // Written so that what is not a number is too much.
        Ok(missing.abs() <= self.tuning.energy_rounding * stored
            || missing_share <= self.tuning.energy_share * self.allowed
            || self.can_spare() && (controlled || self.latest.missing_share() <= self.tuning.latest_share))
    }

    /// Whether little enough of all is missing for steps that may miss some more.
    pub fn can_spare(&self) -> bool {
        self.before.missing_share() <= self.tuning.energy_share * self.allowed
    }

    fn energy_at<S: Observed>(
        &mut self,
        system: &mut S,
        t: f64,
        state: &[f64],
    ) -> Result<[f64; 3], S::Fault> {
        let (q, v) = state.split_at(system.positions());
        system.accelerations(t, q, v, &mut self.a)?;
        Ok(system.energy(q, v))
    }
}

stored! {
    impl[] Balance { open, energy, stretch, before, latest }
}

stored! {
    impl[] Turnover { works, gains }
}
