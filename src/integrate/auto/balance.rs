//! The power balance of a run, stretch by stretch: which of them missed too much energy.
//!
//! The works of all forces ([`Observed::powers`]) less the gain of stored energy ([`Observed::energy`]) are zero for an exact
//! solution. What is missing, as a share of what passed through, is an error of all of the integration.

use crate::integrate::{Observed, Tuning, add_weighted};
use crate::stored::stored;

/// Energy that passed through a system, J: all that came in by work, or was stored before and is no longer.
pub fn throughput(works: impl IntoIterator<Item = f64>, gains: impl IntoIterator<Item = f64>) -> f64 {
    let [mut came, mut went] = [0.0, 0.0];
    let mut add = |x: f64| (came, went) = (came + x.max(0.0), went - x.min(0.0));
    works.into_iter().for_each(&mut add);
    gains.into_iter().for_each(|gain| add(-gain));
    f64::max(came, went)
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

    /// This energy (J) as a share of what passed through; zero of nothing.
    fn share(&self, energy: f64) -> f64 {
        let passed = throughput(self.works.iter().copied(), self.gains);
        if energy == 0.0 { 0.0 } else { energy / passed }
    }

    /// What is missing as a share of what passed through; zero where nothing passed.
    fn missing_share(&self) -> f64 {
        self.share(self.missing()).abs()
    }
}

/// What a stretch is worth.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Judgement {
    /// It missed little enough.
    Right,
    /// It missed too much.
    Wrong,
    /// It missed too much, but steps are not to blame: closer ones missed as much.
    Inherent,
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
    /// What is missing there of which steps are not to blame, J.
    inherent: f64,
    /// The last stretches; the further back, the less.
    latest: Turnover,
    /// Share that the last stretch missed.
    missed: f64,
    /// Share that the present one missed before it was taken back; zero of a new one.
    suspected: f64,
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
            inherent: 0.0,
            latest: nothing,
            missed: 0.0,
            suspected: 0.0,
            a: vec![0.0; system.velocities()],
        }
    }

    /// Forgets everything: the next stretch opens the balance.
    pub fn forget(&mut self) {
        self.close();
        self.before.clear();
        self.latest.clear();
        (self.inherent, self.missed, self.suspected) = (0.0, 0.0, 0.0);
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

    /// Share that the last stretch missed; negative where energy came from nowhere.
    pub fn missed(&self) -> f64 {
        self.missed
    }

    /// The next stretch is made again, as it missed this share.
    pub fn suspect(&mut self, missed: f64) {
        (self.missed, self.suspected) = (missed, missed);
    }

    /// Whether the last stretch would have been right if it had missed this many times as much.
    pub fn has_reserve(&self, factor: f64) -> bool {
        factor * self.missed.abs() <= self.tuning.energy_share * self.allowed
    }

    /// Ends the stretch at time `t` (s) and this state, where the next one begins. It is right if it missed little enough, or the
    /// whole run has and, of steps whose errors nobody `controlled`, the latest stretches, too.
    ///
    /// Slices of contacts with steep profiles have forces that are not quite the slopes of their energy. No step lessens what is
    /// missing by that, and chasing it would never end: where steps with controlled errors miss about as much as those before them
    /// had, all that is missing so far is forgiven. Whether the run is trusted is judged elsewhere, by everything.
    ///
    /// # Errors
    /// The system's fault at this state; the stretch then goes on.
    pub fn settle<S: Observed>(
        &mut self,
        system: &mut S,
        t: f64,
        state: &[f64],
        controlled: bool,
    ) -> Result<Judgement, S::Fault> {
        // All of it where it cannot be told.
        self.missed = 1.0;
        let energy = self.energy_at(system, t, state)?;
        self.stretch.gains = [0, 1, 2].map(|k| energy[k] - self.energy[k]);
        self.energy = energy;
        self.before.add(&self.stretch);
        self.latest.fade(self.tuning.latest_memory);
        self.latest.add(&self.stretch);
        let missing = self.stretch.missing();
        self.missed = self.stretch.share(missing);
        self.stretch.clear();
        let suspected = std::mem::take(&mut self.suspected);
        let stored: f64 = energy.iter().map(|x| x.abs()).sum();
        // Written so that what is not a number is too much.
        if missing.abs() <= self.tuning.energy_rounding * stored
            || self.missed.abs() <= self.tuning.energy_share * self.allowed
            || self.can_spare() && (controlled || self.latest.missing_share() <= self.tuning.latest_share)
        {
            return Ok(Judgement::Right);
        }
        let as_much = suspected != 0.0 && self.missed / suspected >= self.tuning.inherent_share;
        if !controlled || !as_much {
            return Ok(Judgement::Wrong);
        }
        self.inherent = self.before.missing();
        self.latest.clear();
        Ok(Judgement::Inherent)
    }

    /// Whether little enough of all is missing for steps that may miss some more. What was forgiven goes on to grow.
    pub fn can_spare(&self) -> bool {
        let missing = self.before.missing() - self.inherent;
        self.before.share(missing).abs() <= self.tuning.energy_share * self.allowed
            || missing.abs() <= self.tuning.inherent_share * self.inherent.abs()
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
    impl[] Balance { open, energy, stretch, before, inherent, latest, missed, suspected }
}

stored! {
    impl[] Turnover { works, gains }
}
