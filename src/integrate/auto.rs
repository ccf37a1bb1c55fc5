//! Chooses among the other methods, from what is known about a system and from what it does.
//!
//! - A system that vibrates most of the time is followed in its statistics: the leapfrog, monitored by [`StepMonitor`]. When
//!   it fails, or would need steps that cost as much as error control, the Rosenbrock method takes over until probes
//!   say that the leapfrog would do again. It also has the quiet phases, in which it costs little more.
//! - Any other system, or with a tolerance that was asked for, is followed in its trajectory: Dormand-Prince or the
//!   Rosenbrock method, whichever advances further per evaluation.
//!
//! Every stretch of steps is judged by the energy that it misses. A wrong one is made again: those of the leapfrog with error
//! control, those of error control with a tenth of the tolerance.

use super::control::{Estimate, Law};
use super::ledger::Ledger;
use super::selection::Selection;
use super::step_monitor::{Expectation, Findings, StepMonitor, Verdict};
use super::{Applied, DormandPrince, Leapfrog, Quadratures, Reader, Rosenbrock, Stepper, System};

/// Evaluations of an attempt of Dormand-Prince, of the Rosenbrock method, and of its start from a new state, where the
/// derivatives cost about as much as three more and the integrals beside the state take another.
const EXPLICIT_COST: f64 = 6.0;
const IMPLICIT_COST: f64 = 5.0;
const LINEARIZATION_COST: f64 = 5.0;
/// Places of the methods in the selection.
const EXPLICIT: usize = 0;
const IMPLICIT: usize = 1;
/// Failed attempts in a row after which the leapfrog gives way, and after which one method with error control does.
const PATIENCE: u64 = 3;
const LONG_PATIENCE: u64 = 12;
/// At most this many changes for that reason before a step is accepted.
const MOST_CHANGES: u64 = 4;
/// Stretches that error control has at the start, the first of which are short, and after an event; and the least between two
/// events that it has for this reason: events may follow each other closely.
const START: u64 = 5;
const TRANSIENT: u64 = 8;
const EVENT_INTERVAL: u64 = 256;
/// Stretches of the leapfrog between trials of error control: at first, and at most.
const FIRST_PAUSE: u64 = 256;
const LONGEST_PAUSE: u64 = 64 * FIRST_PAUSE;
/// Stretches that are followed more closely after a wrong one: at first, and at most. As many right ones of the method before
/// make it the first number again.
const FIRST_HOLD: u64 = 4;
const LONGEST_HOLD: u64 = 64 * FIRST_HOLD;
/// Each level of strictness divides the tolerance by this, and there are so many.
const STRICTER: f64 = 10.0;
const STRICTEST: u64 = 5;

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
    /// Share of the energy that a run may miss.
    pub missing_energy: f64,
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

/// The methods, by their numbers.
const KINDS: [Kind; 3] = [Kind::Leapfrog, Kind::DormandPrince, Kind::Rosenbrock];

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
    monitor: StepMonitor,
    selection: Selection,
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
    /// Whether a stretch has just been judged.
    judged: bool,
    /// The method of that stretch; not taken back with it.
    wrong: Kind,
    /// Simulated time (s) and evaluations of error control in the stretch.
    advanced: f64,
    cost: f64,
    /// Level of strictness of error control.
    strictness: u64,
    /// Stretches until it may be less strict or give way, and those after the next wrong one.
    hold: u64,
    next_hold: u64,
    /// Right stretches since the last change.
    right: u64,
    /// Stretches of the leapfrog until error control is tried, and between trials.
    wait: u64,
    pause: u64,
    /// Stretches until an event calls for error control again, and whether one does.
    event_wait: u64,
    event: bool,
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
            monitor: StepMonitor::new(system, aim.expected, &aim.units),
            selection: Selection::new(EXPLICIT),
            ledger: Ledger::new(system.velocities(), aim.missing_energy),
            active: Kind::DormandPrince,
            reason: Reason::Trajectory,
            last_steps: [aim.first_step; 2],
            h: aim.first_step,
            attempts: 0,
            gave_way: 0,
            judged: false,
            wrong: Kind::Leapfrog,
            advanced: 0.0,
            cost: 0.0,
            strictness: 0,
            hold: 0,
            next_hold: 0,
            right: 0,
            wait: 0,
            pause: 0,
            event_wait: 0,
            event: false,
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
        self.monitor.forget();
        self.ledger.forget();
        self.last_steps = [self.aim.first_step; 2];
        (self.attempts, self.gave_way) = (0, 0);
        (self.judged, self.advanced, self.cost) = (false, 0.0, 0.0);
        (self.strictness, self.hold, self.next_hold, self.right) = (0, START, FIRST_HOLD, 0);
        (self.wait, self.pause) = (0, FIRST_PAUSE);
        (self.event_wait, self.event) = (0, false);
        (self.steps, self.changes) = ([0; 3], 0);
        (self.active, self.reason) = match self.aim.statistics {
            true => (Kind::Rosenbrock, Reason::Quiet),
            false => (Kind::DormandPrince, Reason::Trajectory),
        };
        self.selection = Selection::new(if self.aim.statistics { IMPLICIT } else { EXPLICIT });
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
        (self.attempts, self.right) = (0, 0);
        (self.advanced, self.cost) = (0.0, 0.0);
        Some(match kind {
            Kind::Leapfrog => self.monitor.step(),
            Kind::DormandPrince => self.last_steps[EXPLICIT],
            Kind::Rosenbrock => self.last_steps[IMPLICIT],
        })
    }

    /// From the leapfrog to error control.
    fn control_errors<S: System>(&mut self, reason: Reason, system: &mut S, t: f64) -> Option<f64> {
        self.selection = Selection::new(IMPLICIT);
        self.last_steps = [self.monitor.step(); 2];
        self.change_to(Kind::Rosenbrock, reason, system, t)
    }

    fn review_leapfrog<S: System>(&mut self, system: &mut S, t: f64, t_last: f64) -> Option<f64> {
        let stretch_over = std::mem::take(&mut self.judged);
        if stretch_over {
            self.note_right_stretch();
            self.wait = self.wait.saturating_sub(1);
        }
        let event = std::mem::take(&mut self.event);
        if event || stretch_over && self.wait == 0 {
            self.hold = if event { TRANSIENT } else { 0 };
            return self.control_errors(Reason::Quiet, system, t);
        }
        let can_spare = self.ledger.can_spare();
        let reason = match self.monitor.look(system, &self.leapfrog, t, t_last, can_spare) {
            _ if self.attempts >= PATIENCE => Reason::Failures,
            Verdict::Hopeless => Reason::Cost,
            Verdict::Keep => return None,
            Verdict::Change => {
                self.changes += 1;
                return Some(self.monitor.step());
            }
        };
        self.monitor.give_up();
        self.hold = 0;
        self.control_errors(reason, system, t)
    }

    /// After a right stretch of error control: whether the leapfrog takes over, or how strict the next one is.
    fn ease<S: System>(&mut self, system: &mut S, t: f64, t_last: f64) -> Option<f64> {
        let (advanced, cost) = (std::mem::take(&mut self.advanced), std::mem::take(&mut self.cost));
        self.note_right_stretch();
        if self.hold > 0 {
            self.hold -= 1;
            return None;
        }
        if self.strictness > 0 {
            self.strictness -= 1;
            self.hold = FIRST_HOLD;
            return None;
        }
        if !self.aim.statistics {
            return None;
        }
        if self.reason == Reason::Quiet {
            if advanced * self.aim.affordable >= cost * self.monitor.step() {
                self.pause = FIRST_PAUSE;
                return None;
            }
            (self.wait, self.pause) = (self.pause, (2 * self.pause).min(LONGEST_PAUSE));
        } else if !self.may_leapfrog(system, t, t_last) {
            return None;
        }
        self.wait = self.wait.max(FIRST_PAUSE);
        self.change_to(Kind::Leapfrog, Reason::Vibration, system, t)
    }

    fn note_right_stretch(&mut self) {
        self.right += 1;
        self.event_wait = self.event_wait.saturating_sub(1);
        if self.right >= self.next_hold {
            self.next_hold = FIRST_HOLD;
        }
    }

    fn review_error_control<S: System>(&mut self, system: &mut S, t: f64, t_last: f64) -> Option<f64> {
        if std::mem::take(&mut self.event) {
            self.hold = self.hold.max(TRANSIENT);
        }
        if std::mem::take(&mut self.judged)
            && let Some(step) = self.ease(system, t, t_last)
        {
            return match self.active {
                Kind::Leapfrog => self.review_leapfrog(system, t, t_last).or(Some(step)),
                _ => Some(step),
            };
        }
        let stuck = self.attempts >= LONG_PATIENCE && self.gave_way < MOST_CHANGES;
        if stuck {
            self.gave_way += 1;
            self.last_steps[self.selection.active()] = self.h;
            self.selection.give_up();
        }
        // In statistics the explicit method at loose tolerance drives the vibration: it only helps out.
        let changed =
            stuck || (!self.aim.statistics || self.selection.active() == EXPLICIT) && self.selection.decide();
        if self.reason == Reason::Trial && !self.selection.on_trial() {
            self.reason = Reason::Speed;
        }
        if !changed {
            return None;
        }
        let kind = if self.selection.active() == EXPLICIT { Kind::DormandPrince } else { Kind::Rosenbrock };
        let reason = match self.selection.on_trial() {
            _ if stuck => Reason::Failures,
            true => Reason::Trial,
            false => Reason::Speed,
        };
        let step = self.change_to(kind, reason, system, t);
        if step.is_none() {
            self.selection.give_up();
        }
        step
    }

    /// Whether a probe says that the leapfrog could go on from the present state.
    fn may_leapfrog<S: System>(&mut self, system: &mut S, t: f64, t_last: f64) -> bool {
        let mut state = std::mem::take(&mut self.state);
        state.copy_from_slice(Stepper::<S>::state(self));
        Stepper::<S>::set_state(&mut self.leapfrog, &state);
        self.state = state;
        self.ledger.can_spare()
            && self.leapfrog.refresh(system, t).is_ok()
            && self.monitor.probe(system, &self.leapfrog, t, t_last)
    }

    fn note_cost(&mut self, evaluations: f64) {
        self.selection.note_cost(evaluations);
        self.cost += evaluations;
    }
}

impl<S: System> Stepper<S> for Auto {
    fn set_state(&mut self, state: &[f64]) {
        self.ledger.close();
        self.placed = true;
        active!(self, S, set_state(state));
    }

    fn refresh(&mut self, system: &mut S, t: f64) -> Result<(), S::Fault> {
        if !std::mem::take(&mut self.placed) && self.aim.statistics && self.event_wait == 0 {
            (self.event, self.event_wait) = (true, EVENT_INTERVAL);
        }
        active!(self, S, refresh(system, t))
    }

    fn review(&mut self, system: &mut S, t: f64, t_last: f64) -> Option<f64> {
        if !self.ledger.is_open() {
            // A failure is the run's own in a moment.
            self.ledger.open(system, t, active!(self, ref S, state())).ok();
        }
        match self.active {
            Kind::Leapfrog => self.review_leapfrog(system, t, t_last),
            Kind::DormandPrince | Kind::Rosenbrock => self.review_error_control(system, t, t_last),
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
            Kind::Leapfrog => return result,
            Kind::DormandPrince => self.note_cost(EXPLICIT_COST),
            Kind::Rosenbrock => self.note_cost(IMPLICIT_COST),
        }
        let stricter = STRICTER.powi(self.strictness as i32);
        result.map(|estimate| {
            estimate.map(|estimate| Estimate { error: stricter * estimate.error, ..estimate })
        })
    }

    fn accept(&mut self) {
        self.ledger.add(active!(self, ref S, integrals()));
        active!(self, S, accept());
        self.steps[self.active as usize] += 1;
        (self.attempts, self.gave_way) = (0, 0);
        match self.active {
            Kind::Leapfrog => self.monitor.count_step(),
            Kind::DormandPrince => {
                self.last_steps[EXPLICIT] = self.h;
                self.selection.note_advance(self.h);
                self.advanced += self.h;
            }
            Kind::Rosenbrock => {
                self.last_steps[IMPLICIT] = self.h;
                self.selection.note_advance(self.h);
                self.advanced += self.h;
                self.note_cost(LINEARIZATION_COST);
            }
        }
    }

    fn is_judged(&self) -> bool {
        true
    }

    fn judge(&mut self, system: &mut S, t: f64) -> bool {
        // The leapfrog does not evaluate where it arrives; with error control a failure is the run's own in a moment.
        let settled = self.ledger.settle(system, t, active!(self, ref S, state()));
        let right = settled.unwrap_or(self.active != Kind::Leapfrog);
        self.judged = true;
        self.wrong = self.active;
        right || self.active != Kind::Leapfrog && self.strictness == STRICTEST
    }

    /// The stretch may have begun with a change of method or strictness, which is undone, too.
    fn go_back(&mut self, system: &mut S, t: f64) -> Option<f64> {
        (self.hold, self.right) = (self.next_hold, 0);
        self.next_hold = (2 * self.next_hold).min(LONGEST_HOLD);
        if self.wrong == Kind::Leapfrog {
            self.monitor.give_up();
            self.reason = Reason::Balance;
        } else {
            self.strictness = (self.strictness + 1).min(STRICTEST);
        }
        if self.active == Kind::Leapfrog { self.control_errors(self.reason, system, t) } else { None }
    }

    fn keep(&self, out: &mut Vec<f64>) {
        out.push(self.active as usize as f64);
        active!(self, ref S, keep(out));
    }

    fn recall(&self, kept: &[f64], theta: f64, out: &mut [f64]) {
        let Some((kind, kept)) = kept.split_first() else { return };
        match KINDS[*kind as usize] {
            Kind::Leapfrog => Stepper::<S>::recall(&self.leapfrog, kept, theta, out),
            Kind::DormandPrince => Stepper::<S>::recall(&self.explicit, kept, theta, out),
            Kind::Rosenbrock => Stepper::<S>::recall(&self.implicit, kept, theta, out),
        }
    }

    fn applied_in<'a>(&'a self, kept: &'a [f64]) -> Option<Applied<'a>> {
        let (kind, kept) = kept.split_first()?;
        match KINDS[*kind as usize] {
            Kind::Leapfrog => Stepper::<S>::applied_in(&self.leapfrog, kept),
            Kind::DormandPrince | Kind::Rosenbrock => None,
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
            leapfrog_step: self.monitor.step(),
            lead: self.selection.lead(),
            findings: *self.monitor.findings(),
        })
    }

    /// All methods are saved, so that the length is always the same.
    fn save(&self, out: &mut Vec<f64>) {
        out.extend([self.active as usize as f64, self.reason as usize as f64]);
        out.extend([self.last_steps[0], self.last_steps[1], self.h, self.advanced, self.cost]);
        out.extend([self.placed, self.judged, self.event].map(|x| f64::from(u8::from(x))));
        let counts = [self.attempts, self.gave_way, self.strictness, self.hold, self.next_hold];
        out.extend(counts.map(|n| n as f64));
        out.extend([self.right, self.wait, self.pause, self.event_wait].map(|n| n as f64));
        out.extend(self.steps.map(|n| n as f64));
        out.push(self.changes as f64);
        self.monitor.save(out);
        self.selection.save(out);
        self.ledger.save(out);
        Stepper::<S>::save(&self.leapfrog, out);
        Stepper::<S>::save(&self.explicit, out);
        Stepper::<S>::save(&self.implicit, out);
    }

    fn load(&mut self, from: &mut Reader<'_>) -> Option<()> {
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
        self.active = *KINDS.get(usize::try_from(from.count()?).ok()?)?;
        self.reason = *reasons.get(usize::try_from(from.count()?).ok()?)?;
        for step in self.last_steps.iter_mut().chain([&mut self.h]) {
            *step = from.number().filter(|h| *h > 0.0)?;
        }
        self.advanced = from.number().filter(|x| *x >= 0.0)?;
        self.cost = from.number().filter(|x| *x >= 0.0)?;
        for flag in [&mut self.placed, &mut self.judged, &mut self.event] {
            *flag = from.flag()?;
        }
        for count in [&mut self.attempts, &mut self.gave_way, &mut self.strictness, &mut self.hold] {
            *count = from.count()?;
        }
        self.strictness = self.strictness.min(STRICTEST);
        for count in
            [&mut self.next_hold, &mut self.right, &mut self.wait, &mut self.pause, &mut self.event_wait]
        {
            *count = from.count()?;
        }
        for steps in &mut self.steps {
            *steps = from.count()?;
        }
        self.changes = from.count()?;
        self.monitor.load(from)?;
        self.selection.load(from)?;
        self.ledger.load(from)?;
        Stepper::<S>::load(&mut self.leapfrog, from)?;
        Stepper::<S>::load(&mut self.explicit, from)?;
        Stepper::<S>::load(&mut self.implicit, from)
    }
}
