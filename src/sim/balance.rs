//! The power balance of a run: what went in, what was lost, what is stored, and what is missing.

use super::Sim;
use crate::error::Result;
use crate::integrate::throughput;
use crate::model::{Condition, Energy, POWERS, Power, RATES};
use crate::registry::registry;
use crate::stored::stored;

/// Round-off of the stored energy, relative; and an energy that is none, J: less than a nanonewton does over a picometre.
const ROUNDING: f64 = 1e-14;
const NOTHING: f64 = 1e-21;

/// Where the balance starts.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct Start {
    /// s
    pub(super) time: f64,
    pub(super) energy: Energy,
    /// How many times the host has set the state in this run, away from where the motion had led.
    pub(super) set: u64,
    /// Work that jumps of the places of outer and inner ring have done, J.
    pub(super) pushed: [f64; 2],
}

impl Start {
    /// The state jumps from one energy to another, which is no gain of the run.
    pub(super) fn shift(&mut self, before: Energy, after: Energy) {
        self.energy.kinetic += after.kinetic - before.kinetic;
        self.energy.elastic += after.elastic - before.elastic;
        self.energy.potential += after.potential - before.potential;
    }

    /// The place of a ring (0 the outer one) jumps, which takes this work, J.
    pub(super) fn push(&mut self, ring: usize, work: f64) {
        self.pushed[ring] += work;
    }
}

/// Energies of a run from its start to the time that the integration has reached.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PowerBalance {
    /// From the start of the scene, or the last [`Sim::set_state`] that was not next to the state that the run had, s.
    pub from: f64,
    /// To this time, s; the integration may be ahead of [`Sim::time`] by some steps.
    pub to: f64,
    /// Work of each of [`POWERS`], J; positive where it goes into the bearing.
    pub work: [f64; POWERS.len()],
    /// Energy at the two times.
    pub energy: [Energy; 2],
    /// The most that all works had brought in or taken out at any time between, J: what came in and went out again has passed
    /// through, too.
    pub passed: f64,
}

registry! {
    /// A number of a power balance beside the works.
    pub(crate) enum BalanceItem,
    /// Names of what follows the works in a power balance: gains of energy and the residual in J, the relative residual,
    /// times in s.
    pub const BALANCE_ITEMS {
        KineticEnergyGain = "kinetic_energy_gain",
        ElasticEnergyGain = "elastic_energy_gain",
        PotentialEnergyGain = "potential_energy_gain",
        Residual = "residual",
        RelativeResidual = "relative_residual",
        From = "from",
        To = "to",
    }
}

impl PowerBalance {
    /// Gain of kinetic, elastic and potential energy, J.
    pub fn gain(&self) -> [f64; 3] {
        let [before, after] = &self.energy;
        [after.kinetic - before.kinetic, after.elastic - before.elastic, after.potential - before.potential]
    }

    /// One of [`BALANCE_ITEMS`].
    pub(crate) fn value(&self, item: BalanceItem) -> f64 {
        let [kinetic, elastic, potential] = self.gain();
        match item {
            BalanceItem::KineticEnergyGain => kinetic,
            BalanceItem::ElasticEnergyGain => elastic,
            BalanceItem::PotentialEnergyGain => potential,
            BalanceItem::Residual => self.residual(),
            BalanceItem::RelativeResidual => self.relative_residual(),
            BalanceItem::From => self.from,
            BalanceItem::To => self.to,
        }
    }

    /// Work that is found nowhere, J: the error of the integration and of the sums.
    pub fn residual(&self) -> f64 {
        self.work.iter().sum::<f64>() - self.gain().iter().sum::<f64>()
    }

    /// Energy that passed through, J: all that came in by work, or was stored before and is no longer; and no less than had
    /// come in or gone out before.
    pub fn throughput(&self) -> f64 {
        throughput(self.work, self.gain()).max(self.passed)
    }

    /// The residual as a share of the throughput; zero where nothing passed but round-off of what is stored.
    pub fn relative_residual(&self) -> f64 {
        let stored = self.energy.iter().map(|e| e.kinetic.abs() + e.elastic.abs() + e.potential.abs());
        let throughput = self.throughput();
        let nothing = ROUNDING * stored.fold(0.0, f64::max) + NOTHING;
        if throughput > nothing { self.residual() / throughput } else { 0.0 }
    }
}

impl Sim {
    /// The power balance since the start of the scene or the last [`Sim::set_state`] that was not next to the state that the
    /// run had; the energy of the little that such ones change is none of its gain. Works are summed up step by step, with
    /// the weights of the method; those of the leapfrog with the forces of contacts that it applied, the mean velocities of
    /// the rollers, and the predicted ones of ring and cage. Inputs and limits may change on the way. An input that is set
    /// within a step divides the works of that step in proportion to time.
    ///
    /// # Errors
    /// [`crate::Status::BadState`] when forces are undefined at the end.
    pub fn power_balance(&mut self) -> Result<PowerBalance> {
        let to = self.driver.reached();
        let mut state = self.state.clone();
        self.driver.state_at(to, &mut state);
        let energy = self.energy_at(to, &state)?;
        let mut work = [0.0; POWERS.len()];
        work.copy_from_slice(&self.works_at(to)[..POWERS.len()]);
        let Start { time, energy: start, .. } = self.balance;
        Ok(PowerBalance { from: time, to, work, energy: [start, energy], passed: self.driver.passed() })
    }

    /// Works of all forces since the balance began, up to the present time, J: in the order of [`POWERS`], positive where they go
    /// into the bearing.
    pub fn works(&self) -> [f64; POWERS.len()] {
        let mut works = [0.0; POWERS.len()];
        works.copy_from_slice(&self.works_at(self.time())[..POWERS.len()]);
        works
    }

    /// Share of the time since the balance began in which a condition held.
    pub(super) fn share_of(&self, condition: Condition) -> f64 {
        let to = self.driver.reached();
        // Some weights of methods are negative.
        let time = self.works_at(to)[condition.place()].abs();
        if time > 0.0 { time / (to - self.balance.time) } else { 0.0 }
    }

    fn works_at(&self, t: f64) -> [f64; RATES] {
        let mut works = [0.0; RATES];
        self.driver.works_at(t, &mut works);
        let [outer, inner] = self.balance.pushed;
        works[Power::OuterRingDrive as usize] += outer;
        works[Power::RingDrive as usize] += inner;
        works
    }

    /// Starts the balance at the last evaluated state, which must be the present one.
    pub(super) fn start_balance(&mut self) {
        self.balance =
            Start { time: self.time, energy: self.bearing.energy(), pushed: [0.0; 2], ..self.balance };
        self.bearing.begin_works(&self.balance.energy);
        self.driver.forget_works();
    }
}

stored! {
    impl[] Start { time, energy, set, pushed }
    if |start| start.time >= 0.0
}

stored! {
    impl[] Energy { kinetic, elastic, potential }
}
