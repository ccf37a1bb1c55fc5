//! Chooses among the other methods, from what is known about a system and from what it does.
//!
//! - A system that vibrates most of the time is followed in its statistics: the leapfrog, watched over by [`Watch`]. When
//!   it fails, or would need steps that cost as much as error control, the Rosenbrock method takes over until probes
//!   say that the leapfrog would do again. It also has the quiet phases, in which it costs little more: see `integrate::quiet`.
//! - Any other system, or with a tolerance that was asked for, is followed in its trajectory: Dormand-Prince or the
//!   Rosenbrock method, whichever advances further per evaluation.

use super::control::{Estimate, Law};
use super::ledger::Ledger;
use super::quiet::Quiet;
use super::race::Race;
use super::watch::{Expectation, Findings, Verdict, Watch};
use super::{Applied, DormandPrince, Leapfrog, Quadratures, Reader, Rosenbrock, Stepper, System};

/// Evaluations of an attempt of Dormand-Prince, of the Rosenbrock method, and of its start from a new state, where the
/// derivatives cost about as much as three more and the integrals beside the state take another.
const EXPLICIT_COST: f64 = 6.0;
const IMPLICIT_COST: f64 = 5.0;
const LINEARIZATION_COST: f64 = 5.0;
/// Places of the methods in the race.
const EXPLICIT: usize = 0;
const IMPLICIT: usize = 1;
/// Failed attempts in a row after which the leapfrog gives way, and after which one method with error control does.
const PATIENCE: u64 = 3;
const LONG_PATIENCE: u64 = 12;
/// At most this many changes for that reason before a step is accepted.
const MOST_CHANGES: u64 = 4;
/// Evaluations of error control between two probes whether the leapfrog would do.
const PROBE_INTERVAL: f64 = 500.0;

/// How to follow a system.
#[derive(Clone, Debug, PartialEq)]
pub struct Aim {
    /// In its statistics, by the leapfrog; otherwise in its trajectory.
    pub statistics: bool,
    /// What the leapfrog's step is chosen from.
    pub expected: Expectation,
    /// One unit of error of each state.
    pub units: Vec<f64>,
    /// Tolerance of error control, in these units.
    pub tolerance: f64,
    /// Evaluations of error control that accuracy is worth for one of the leapfrog.
    pub affordable: f64,
    /// First step of error control, s.
    pub first_step: f64,
}

impl Aim {
    /// The step that a run starts with, s.
    pub fn nominal_step(&self) -> f64 {
        if self.statistics { self.expected.step() } else { self.first_step }
    }
}

/// A method to choose.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    /// [`Leapfrog`].
    Leapfrog,
    /// [`DormandPrince`].
    DormandPrince,
    /// [`Rosenbrock`].
    Rosenbrock,
}

/// Why a method was chosen.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Reason {
    /// The system vibrates.
    Vibration,
    /// The system does not vibrate all the time, or a tolerance was asked for.
    Trajectory,
    /// It advances further per evaluation.
    Speed,
    /// It is tried whether it does.
    Trial,
    /// The attempts of the one before failed.
    Failures,
    /// The leapfrog would have to take steps that cost as much.
    Cost,
    /// The leapfrog missed too much energy.
    Balance,
    /// Nothing vibrates, or it is tried whether that is so: errors are controlled at little cost.
    Quiet,
}

/// What was chosen, and what it rests on.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Choice {
    /// The active method.
    pub method: Kind,
    /// Why.
    pub reason: Reason,
    /// Accepted steps of each method, in the order of [`Kind`].
    pub steps: [u64; 3],
    /// Changes of the method or the leapfrog's step.
    pub changes: u64,
    /// Step of the leapfrog, s.
    pub leapfrog_step: f64,
    /// How many times as far as its rival the active method with error control advances per evaluation; zero before
    /// both have been tried.
    pub lead: f64,
    /// What the checks of the leapfrog found.
    pub findings: Findings,
}

/// The methods and the choice among them.
#[derive(Clone, Debug)]
pub struct Auto {
    aim: Aim,
    leapfrog: Leapfrog,
    explicit: DormandPrince,
    implicit: Rosenbrock,
    watch: Watch,
    race: Race,
    quiet: Quiet,
    ledger: Ledger,
    active: Kind,
    reason: Reason,
    /// Step that each method with error control took last, s.
    last_steps: [f64; 2],
    /// Size of the last attempt, s.
    h: f64,
    /// Attempts since the last change or accepted step, and changes because of them.
    attempts: u64,
    gave_way: u64,
    /// Evaluations of error control until the next probe of the leapfrog.
    probe: f64,
    steps: [u64; 3],
    changes: u64,
    /// Whether the state was set since the last refresh, which is no event of the system then.
    placed: bool,
    /// Where states change hands.
    state: Vec<f64>,
}

/// Calls a method of the active stepper.
macro_rules! active {
    ($self:ident, $system:ty, $method:ident($($argument:expr),*)) => {
        match $self.active {
            Kind::Leapfrog => Stepper::<$system>::$method(&mut $self.leapfrog, $($argument),*),
            Kind::DormandPrince => Stepper::<$system>::$method(&mut $self.explicit, $($argument),*),
            Kind::Rosenbrock => Stepper::<$system>::$method(&mut $self.implicit, $($argument),*),
        }
    };
    ($self:ident, ref $system:ty, $method:ident($($argument:expr),*)) => {
        match $self.active {
            Kind::Leapfrog => Stepper::<$system>::$method(&$self.leapfrog, $($argument),*),
            Kind::DormandPrince => Stepper::<$system>::$method(&$self.explicit, $($argument),*),
            Kind::Rosenbrock => Stepper::<$system>::$method(&$self.implicit, $($argument),*),
        }
    };
}

impl Auto {
    /// Memory for a system.
    pub fn new<S: System>(system: &S, aim: Aim) -> Self {
        let tolerance: Vec<f64> = aim.units.iter().map(|unit| unit * aim.tolerance).collect();
        let mut auto = Self {
            leapfrog: Leapfrog::new(system),
            explicit: DormandPrince::new(system, &tolerance),
            implicit: Rosenbrock::new(system, &tolerance),
            watch: Watch::new(system, aim.expected, &aim.units),
            race: Race::new(EXPLICIT),
            quiet: Quiet::new(),
            ledger: Ledger::new(system.velocities()),
            active: Kind::DormandPrince,
            reason: Reason::Trajectory,
            last_steps: [aim.first_step; 2],
            h: aim.first_step,
            attempts: 0,
            gave_way: 0,
            probe: 0.0,
            steps: [0; 3],
            changes: 0,
            placed: true,
            state: vec![0.0; system.positions() + system.velocities()],
            aim,
        };
        auto.start_over();
        auto
    }

    fn start_over(&mut self) {
        self.watch.forget();
        self.quiet = Quiet::new();
        self.ledger.forget();
        self.last_steps = [self.aim.first_step; 2];
        (self.attempts, self.gave_way, self.probe) = (0, 0, 0.0);
        (self.steps, self.changes) = ([0; 3], 0);
        (self.active, self.reason) = match self.aim.statistics {
            true => (Kind::Rosenbrock, Reason::Quiet),
            false => (Kind::DormandPrince, Reason::Trajectory),
        };
        self.race = Race::new(if self.aim.statistics { IMPLICIT } else { EXPLICIT });
    }

    /// Goes on with another method from the present state at time `t`. Returns the step to take, or nothing if the
    /// method cannot start there.
    fn change_to<S: System>(&mut self, kind: Kind, reason: Reason, system: &mut S, t: f64) -> Option<f64> {
        let mut state = std::mem::take(&mut self.state);
        state.copy_from_slice(Stepper::<S>::state(self));
        let before = std::mem::replace(&mut self.active, kind);
        active!(self, S, set_state(&state));
        self.state = state;
        if active!(self, S, refresh(system, t)).is_err() {
            self.active = before;
            return None;
        }
        self.reason = reason;
        self.changes += 1;
        self.attempts = 0;
        self.ledger.hurry();
        Some(match kind {
            Kind::Leapfrog => self.watch.step(),
            Kind::DormandPrince => self.last_steps[EXPLICIT],
            Kind::Rosenbrock => self.last_steps[IMPLICIT],
        })
    }

    fn review_leapfrog<S: System>(&mut self, system: &mut S, t: f64, t_last: f64) -> Option<f64> {
        if self.attempts == 0 && self.quiet.begins() {
            self.race = Race::new(IMPLICIT);
            self.last_steps = [self.watch.step(); 2];
            let step = self.change_to(Kind::Rosenbrock, Reason::Quiet, system, t);
            if step.is_none() {
                self.quiet.end();
            }
            return step;
        }
        let missed = self.attempts == 0 && self.misses_energy(system, t);
        let verdict = if missed {
            self.ledger.settle();
            self.watch.refine()
        } else {
            self.watch.look(system, &self.leapfrog, t, t_last, self.ledger.can_spare())
        };
        let reason = match verdict {
            _ if self.attempts >= PATIENCE => Reason::Failures,
            Verdict::Hopeless if missed => Reason::Balance,
            Verdict::Hopeless => Reason::Cost,
            Verdict::Keep => return None,
            Verdict::Change => {
                self.changes += 1;
                return Some(self.watch.step());
            }
        };
        self.watch.give_up();
        self.race = Race::new(IMPLICIT);
        self.last_steps = [self.watch.step(); 2];
        self.probe = PROBE_INTERVAL;
        self.change_to(Kind::Rosenbrock, reason, system, t)
    }

    fn review_race<S: System>(&mut self, system: &mut S, t: f64, t_last: f64) -> Option<f64> {
        if self.reason == Reason::Quiet {
            if self.quiet.ends(self.aim.affordable, self.watch.step()) {
                let step = self.change_to(Kind::Leapfrog, Reason::Vibration, system, t)?;
                return self.review_leapfrog(system, t, t_last).or(Some(step));
            }
        } else if self.aim.statistics && self.probe <= 0.0 {
            self.probe = PROBE_INTERVAL;
            if self.may_leapfrog(system, t, t_last) {
                return self.change_to(Kind::Leapfrog, Reason::Vibration, system, t);
            }
        }
        let stuck = self.attempts >= LONG_PATIENCE && self.gave_way < MOST_CHANGES;
        if stuck {
            self.gave_way += 1;
            if self.reason == Reason::Quiet {
                self.quiet.end();
            }
            self.last_steps[self.race.active()] = self.h;
            self.race.give_up();
        }
        // In statistics the explicit method at loose tolerance drives the vibration: it only helps out.
        let changed = stuck || (!self.aim.statistics || self.race.active() == EXPLICIT) && self.race.decide();
        if self.reason == Reason::Trial && !self.race.on_trial() {
            self.reason = Reason::Speed;
        }
        if !changed {
            return None;
        }
        let kind = if self.race.active() == EXPLICIT { Kind::DormandPrince } else { Kind::Rosenbrock };
        let reason = match self.race.on_trial() {
            _ if stuck => Reason::Failures,
            true => Reason::Trial,
            false => Reason::Speed,
        };
        let step = self.change_to(kind, reason, system, t);
        if step.is_none() {
            self.race.give_up();
        }
        step
    }

    /// Whether a look at the balance says that the leapfrog misses too much, if it is time for one.
    fn misses_energy<S: System>(&mut self, system: &mut S, t: f64) -> bool {
        if !self.ledger.is_due() {
            return false;
        }
        let state = Stepper::<S>::state(&self.leapfrog);
        // A failure is the run's own in a moment.
        self.ledger.look(system, t, state).is_ok() && self.ledger.misses_much()
    }

    /// Whether a probe says that the leapfrog could go on from the present state.
    fn may_leapfrog<S: System>(&mut self, system: &mut S, t: f64, t_last: f64) -> bool {
        let mut state = std::mem::take(&mut self.state);
        state.copy_from_slice(Stepper::<S>::state(self));
        Stepper::<S>::set_state(&mut self.leapfrog, &state);
        self.state = state;
        self.ledger.look(system, t, Stepper::<S>::state(&self.leapfrog)).is_ok()
            && self.ledger.can_spare()
            && self.leapfrog.refresh(system, t).is_ok()
            && self.watch.probe(system, &self.leapfrog, t, t_last)
    }

    fn note_cost(&mut self, evaluations: f64) {
        self.race.note_cost(evaluations);
        self.quiet.note_cost(evaluations);
        self.probe -= evaluations;
    }
}

impl<S: System> Stepper<S> for Auto {
    fn set_state(&mut self, state: &[f64]) {
        self.ledger.close();
        self.placed = true;
        active!(self, S, set_state(state));
    }

    fn refresh(&mut self, system: &mut S, t: f64) -> Result<(), S::Fault> {
        if !std::mem::take(&mut self.placed) {
            self.quiet.note_event();
        }
        active!(self, S, refresh(system, t))
    }

    fn review(&mut self, system: &mut S, t: f64, t_last: f64) -> Option<f64> {
        if self.aim.statistics && self.ledger.is_closed() {
            // A failure is the run's own in a moment.
            self.ledger.look(system, t, active!(self, ref S, state())).ok();
        }
        match self.active {
            Kind::Leapfrog => self.review_leapfrog(system, t, t_last),
            Kind::DormandPrince | Kind::Rosenbrock => self.review_race(system, t, t_last),
        }
    }

    fn forget(&mut self) {
        self.start_over();
    }

    fn attempt(&mut self, system: &mut S, t: f64, h: f64, t_last: f64) -> Result<Option<Estimate>, S::Fault> {
        self.h = h;
        let result = active!(self, S, attempt(system, t, h, t_last));
        self.attempts += 1;
        match self.active {
            Kind::Leapfrog => {}
            Kind::DormandPrince => self.note_cost(EXPLICIT_COST),
            Kind::Rosenbrock => self.note_cost(IMPLICIT_COST),
        }
        result
    }

    fn accept(&mut self) {
        if self.aim.statistics {
            self.ledger.add(active!(self, ref S, integrals()));
        }
        active!(self, S, accept());
        self.steps[self.active as usize] += 1;
        (self.attempts, self.gave_way) = (0, 0);
        match self.active {
            Kind::Leapfrog => {
                self.watch.count_step();
                self.quiet.count_step();
            }
            Kind::DormandPrince => {
                self.last_steps[EXPLICIT] = self.h;
                self.race.note_advance(self.h);
            }
            Kind::Rosenbrock => {
                self.last_steps[IMPLICIT] = self.h;
                self.race.note_advance(self.h);
                self.quiet.note_advance(self.h);
                self.note_cost(LINEARIZATION_COST);
            }
        }
    }

    fn integrals(&self) -> &Quadratures {
        active!(self, ref S, integrals())
    }

    fn applied(&self) -> Option<Applied<'_>> {
        active!(self, ref S, applied())
    }

    fn state(&self) -> &[f64] {
        active!(self, ref S, state())
    }

    fn interpolate(&self, theta: f64, out: &mut [f64]) {
        active!(self, ref S, interpolate(theta, out));
    }

    fn control(&self) -> Law {
        active!(self, ref S, control())
    }

    fn choice(&self) -> Option<Choice> {
        Some(Choice {
            method: self.active,
            reason: self.reason,
            steps: self.steps,
            changes: self.changes,
            leapfrog_step: self.watch.step(),
            lead: self.race.lead(),
            findings: *self.watch.findings(),
        })
    }

    /// All methods are saved, so that the length is always the same.
    fn save(&self, out: &mut Vec<f64>) {
        out.extend([self.active as usize as f64, self.reason as usize as f64]);
        out.extend([self.last_steps[0], self.last_steps[1], self.h, self.attempts as f64, self.probe]);
        out.push(self.gave_way as f64);
        out.push(f64::from(u8::from(self.placed)));
        out.extend(self.steps.map(|n| n as f64));
        out.push(self.changes as f64);
        self.watch.save(out);
        self.race.save(out);
        self.quiet.save(out);
        self.ledger.save(out);
        Stepper::<S>::save(&self.leapfrog, out);
        Stepper::<S>::save(&self.explicit, out);
        Stepper::<S>::save(&self.implicit, out);
    }

    fn load(&mut self, from: &mut Reader<'_>) -> Option<()> {
        let kinds = [Kind::Leapfrog, Kind::DormandPrince, Kind::Rosenbrock];
        let reasons = [
            Reason::Vibration,
            Reason::Trajectory,
            Reason::Speed,
            Reason::Trial,
            Reason::Failures,
            Reason::Cost,
            Reason::Balance,
            Reason::Quiet,
        ];
        self.active = *kinds.get(usize::try_from(from.count()?).ok()?)?;
        self.reason = *reasons.get(usize::try_from(from.count()?).ok()?)?;
        for step in self.last_steps.iter_mut().chain([&mut self.h]) {
            *step = from.number().filter(|h| *h > 0.0)?;
        }
        self.attempts = from.count()?;
        self.probe = from.number()?;
        self.gave_way = from.count()?;
        self.placed = from.flag()?;
        for steps in &mut self.steps {
            *steps = from.count()?;
        }
        self.changes = from.count()?;
        self.watch.load(from)?;
        self.race.load(from)?;
        self.quiet.load(from)?;
        self.ledger.load(from)?;
        Stepper::<S>::load(&mut self.leapfrog, from)?;
        Stepper::<S>::load(&mut self.explicit, from)?;
        Stepper::<S>::load(&mut self.implicit, from)
    }
}
