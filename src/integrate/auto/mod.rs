//! Chooses among the other methods, from what is known about a system and from what it does.
//!
//! - A system that vibrates most of the time is followed in its statistics: the leapfrog, monitored by [`StabilityMonitor`]. When
//!   it fails, or would need steps that cost as much as error control, the Rosenbrock method takes over until probes
//!   say that the leapfrog would do again, or until it is seen that finer steps of the leapfrog advance further per evaluation. It
//!   also has the phases in which so little happens that it costs no more.
//! - Any other system, or with a tolerance that was asked for, is followed in its trajectory: Dormand-Prince or the
//!   Rosenbrock method, whichever advances further per evaluation.
//!
//! Where the steps of the Rosenbrock method become tiny, the Radau method is tried in its place.
//!
//! Every stretch of steps is judged by the energy that it misses. A wrong one is made again: those of the leapfrog with error
//! control or finer steps, those of error control with a tenth of the tolerance.

/// Calls a function of [`Stepper`] of the method of this kind.
macro_rules! of_kind {
    ($kind:expr, [$($borrow:tt)+] $self:ident, $system:ty, $call:ident($($argument:expr),*)) => {
        match $kind {
            Kind::Leapfrog => Stepper::<$system>::$call($($borrow)+ $self.leapfrog, $($argument),*),
            Kind::DormandPrince => Stepper::<$system>::$call($($borrow)+ $self.dormand_prince, $($argument),*),
            Kind::Rosenbrock => Stepper::<$system>::$call($($borrow)+ $self.rosenbrock, $($argument),*),
            Kind::Radau => Stepper::<$system>::$call($($borrow)+ $self.radau, $($argument),*),
        }
    };
}

/// The same of the active method.
macro_rules! active {
    ($self:ident, $system:ty, $($call:tt)+) => { of_kind!($self.active, [&mut] $self, $system, $($call)+) };
    ($self:ident, ref $system:ty, $($call:tt)+) => { of_kind!($self.active, [&] $self, $system, $($call)+) };
}

pub mod balance;
pub mod mode;
mod selection;
pub mod stability;
mod stepper;
pub mod tuning;

use crate::integrate::{Complete, DormandPrince, Leapfrog, Radau, Rosenbrock, Stepper, Tuning};
use balance::Balance;
use selection::Selection;
use stability::{Expectation, StabilityMonitor, Verdict};

/// Places of the methods in the selection.
const EXPLICIT: usize = 0;
const IMPLICIT: usize = 1;
/// Places of the implicit ones in the selection between them.
const ROSENBROCK: usize = 0;
const RADAU: usize = 1;

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
    /// First step of error control, s.
    pub first_step: f64,
    /// Share of the energy that a run may miss.
    pub missing_energy: f64,
    /// Constants of the choice.
    pub tuning: Tuning,
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
    /// [`Radau`].
    Radau,
}

/// The methods, by their numbers.
const KINDS: [Kind; 4] = [Kind::Leapfrog, Kind::DormandPrince, Kind::Rosenbrock, Kind::Radau];

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
    /// The leapfrog missed too much energy, at least with longer steps.
    Balance,
    /// Nothing vibrates, or it is tried whether that is so: errors are controlled at little cost.
    Affordable,
}

/// The reasons, by their numbers.
const REASONS: [Reason; 8] = [
    Reason::Vibration,
    Reason::Trajectory,
    Reason::Speed,
    Reason::Trial,
    Reason::Failures,
    Reason::Cost,
    Reason::Balance,
    Reason::Affordable,
];

/// What was chosen, and what it rests on.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Choice {
    /// The active method.
    pub method: Kind,
    /// Why.
    pub reason: Reason,
    /// Accepted steps of each method, in the order of [`Kind`].
    pub steps: [u64; KINDS.len()],
    /// Changes of the method or the leapfrog's step.
    pub changes: u64,
    /// Step of the leapfrog, s.
    pub leapfrog_step: f64,
    /// How many times as far as its rival the active method with error control advances per evaluation; zero before
    /// both have been tried.
    pub lead: f64,
    /// Highest frequency met by the leapfrog, rad/s; zero before it was used.
    pub highest_frequency: f64,
}

/// A stretch that may be wrong.
#[derive(Clone, Copy, Debug)]
struct Wrong {
    method: Kind,
    /// How often the step of the leapfrog had been refined.
    refinement: u64,
    /// Share of the energy that it missed.
    missed: f64,
}

/// The methods and the choice among them.
#[derive(Clone, Debug)]
pub struct Auto<const N: usize> {
    aim: Aim,
    leapfrog: Leapfrog<N>,
    dormand_prince: DormandPrince,
    rosenbrock: Rosenbrock<N>,
    radau: Radau<N>,
    monitor: StabilityMonitor<N>,
    /// Between the explicit and the implicit method.
    selection: Selection,
    /// Between the implicit methods.
    stiffness: Selection,
    balance: Balance,
    active: Kind,
    reason: Reason,
    /// Step that each method with error control took last, s.
    last_steps: [f64; KINDS.len()],
    /// Size of the last attempt, s.
    h: f64,
    /// Attempts since the last change or accepted step.
    attempts: u64,
    /// Whether a stretch has just been judged.
    judged: bool,
    /// That stretch; not taken back with it.
    wrong: Wrong,
    /// Simulated time (s) and evaluations of error control in the stretch.
    advanced: f64,
    cost: f64,
    /// Level of strictness of error control.
    strictness: u64,
    /// Evaluations that the derivatives of the system cost.
    linearization_cost: f64,
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
    steps: [u64; KINDS.len()],
    changes: u64,
    /// Whether the state was set since the last refresh, which is no event of the system then.
    placed: bool,
    /// Where states change hands.
    state: Vec<f64>,
}

impl<const N: usize> Auto<N> {
    /// Memory for a system.
    pub fn new<S: Complete<N>>(system: &S, aim: Aim) -> Self {
        let tolerance: Vec<f64> = aim.units.iter().map(|unit| unit * aim.tolerance).collect();
        let mut auto = Self {
            leapfrog: Leapfrog::new(system),
            dormand_prince: DormandPrince::new(system, &tolerance),
            rosenbrock: Rosenbrock::new(system, &tolerance),
            radau: Radau::new(system, &tolerance),
            monitor: StabilityMonitor::new(system, aim.expected, &aim.units, aim.tuning),
            selection: Selection::new(EXPLICIT, aim.tuning),
            stiffness: Selection::new(ROSENBROCK, aim.tuning),
            balance: Balance::new(system, aim.missing_energy, aim.tuning),
            active: Kind::DormandPrince,
            reason: Reason::Trajectory,
            last_steps: [aim.first_step; KINDS.len()],
            h: aim.first_step,
            attempts: 0,
            judged: false,
            wrong: Wrong { method: Kind::Leapfrog, refinement: 0, missed: 0.0 },
            advanced: 0.0,
            cost: 0.0,
            strictness: 0,
            linearization_cost: system.linearization_cost(),
            hold: 0,
            next_hold: 0,
            right: 0,
            wait: 0,
            pause: 0,
            event_wait: 0,
            event: false,
            steps: [0; KINDS.len()],
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
        self.balance.forget();
        self.last_steps = [self.aim.first_step; KINDS.len()];
        (self.attempts, self.judged, self.advanced, self.cost) = (0, false, 0.0, 0.0);
        (self.strictness, self.hold, self.next_hold, self.right) =
            (0, self.aim.tuning.start, self.aim.tuning.first_hold, 0);
        (self.wait, self.pause) = (0, self.aim.tuning.first_pause);
        (self.event_wait, self.event) = (0, false);
        (self.active, self.reason) = match self.aim.statistics {
            true => (Kind::Rosenbrock, Reason::Affordable),
            false => (Kind::DormandPrince, Reason::Trajectory),
        };
        self.selection =
            Selection::new(if self.aim.statistics { IMPLICIT } else { EXPLICIT }, self.aim.tuning);
        self.stiffness = Selection::new(ROSENBROCK, self.aim.tuning);
    }

    /// Goes on with another method from the present state at time `t`. Returns the step to take, or nothing if the
    /// method cannot start there.
    fn change_to<S: Complete<N>>(
        &mut self,
        kind: Kind,
        reason: Reason,
        system: &mut S,
        t: f64,
    ) -> Option<f64> {
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
            _ => self.last_steps[kind as usize],
        })
    }

    /// From the leapfrog to error control.
    fn control_errors<S: Complete<N>>(&mut self, reason: Reason, system: &mut S, t: f64) -> Option<f64> {
        self.selection = Selection::new(IMPLICIT, self.aim.tuning);
        self.stiffness = Selection::new(ROSENBROCK, self.aim.tuning);
        self.last_steps = [self.monitor.step(); KINDS.len()];
        self.change_to(Kind::Rosenbrock, reason, system, t)
    }

    fn review_leapfrog<S: Complete<N>>(&mut self, system: &mut S, t: f64) -> Option<f64> {
        let stretch_over = std::mem::take(&mut self.judged);
        if stretch_over {
            self.note_right_stretch();
            self.wait = self.wait.saturating_sub(1);
            self.hold = self.hold.saturating_sub(1);
        }
        let event = std::mem::take(&mut self.event);
        if event || stretch_over && self.wait == 0 {
            self.hold = if event { self.aim.tuning.transient } else { 0 };
            return self.control_errors(Reason::Affordable, system, t);
        }
        let eased = self.hold == 0 || self.balance.has_reserve(self.aim.tuning.reserve);
        let coarser = stretch_over && eased && self.monitor.coarsen();
        if coarser {
            (self.hold, self.right) = (self.aim.tuning.first_hold, 0);
            self.changes += 1;
            if self.monitor.refinement() == 0 {
                self.reason = Reason::Vibration;
            }
        }
        let reason = match self.monitor.look(system, &self.leapfrog, t) {
            _ if self.attempts >= self.aim.tuning.patience => Reason::Failures,
            Verdict::TooFast => Reason::Cost,
            Verdict::Keep => return coarser.then(|| self.monitor.step()),
            Verdict::Change => {
                self.changes += 1;
                return Some(self.monitor.step());
            }
        };
        self.hold = 0;
        self.control_errors(reason, system, t)
    }

    /// After a right stretch of error control: whether the leapfrog takes over, or how strict the next one is.
    fn ease<S: Complete<N>>(&mut self, system: &mut S, t: f64) -> Option<f64> {
        let (advanced, cost) = (std::mem::take(&mut self.advanced), std::mem::take(&mut self.cost));
        self.note_right_stretch();
        if self.derivatives_are_dear() {
            self.monitor.note_rival(advanced, cost);
        }
        if self.reason == Reason::Balance && self.monitor.refine(self.monitor.refinement()) {
            return self.go_on_finer(system, t);
        }
        if self.hold > 0 {
            self.hold -= 1;
            return None;
        }
        if self.strictness > 0 {
            self.strictness -= 1;
            self.hold = self.aim.tuning.first_hold;
            return None;
        }
        if !self.aim.statistics {
            return None;
        }
        if self.reason == Reason::Affordable {
            // No more evaluations than the leapfrog's.
            if advanced >= cost * self.monitor.step() {
                self.pause = self.aim.tuning.first_pause;
                self.hold = self.aim.tuning.first_hold;
                return None;
            }
            (self.wait, self.pause) = (self.pause, self.pause.saturating_mul(2));
        } else if !self.may_leapfrog(system, t) {
            return None;
        }
        self.wait = self.wait.max(self.aim.tuning.first_pause);
        self.change_to(Kind::Leapfrog, Reason::Vibration, system, t)
    }

    /// Goes on with the leapfrog, whose steps have become finer. Returns them as [`Auto::change_to`].
    pub(super) fn go_on_finer<S: Complete<N>>(&mut self, system: &mut S, t: f64) -> Option<f64> {
        self.strictness = 0;
        // What error control costs may have been that of a single impact.
        let pause = self.aim.tuning.finer_pause;
        self.wait = if self.wait == 0 { pause } else { self.wait.min(pause) };
        self.change_to(Kind::Leapfrog, Reason::Balance, system, t)
    }

    /// Whether finer steps of the leapfrog are weighed against error control at all.
    pub(super) fn derivatives_are_dear(&self) -> bool {
        self.linearization_cost >= self.aim.tuning.dear_derivatives
    }

    /// No more care than at the start of a run, as it was in vain.
    fn relax(&mut self) {
        (self.strictness, self.hold, self.next_hold) = (0, 0, self.aim.tuning.first_hold);
        self.monitor.relax();
    }

    fn note_right_stretch(&mut self) {
        self.right += 1;
        self.event_wait = self.event_wait.saturating_sub(1);
        if self.right >= self.next_hold {
            self.next_hold = self.aim.tuning.first_hold;
        }
    }

    fn review_error_control<S: Complete<N>>(&mut self, system: &mut S, t: f64) -> Option<f64> {
        if std::mem::take(&mut self.event) {
            self.hold = self.hold.max(self.aim.tuning.transient);
        }
        if std::mem::take(&mut self.judged)
            && let Some(step) = self.ease(system, t)
        {
            return match self.active {
                Kind::Leapfrog => self.review_leapfrog(system, t).or(Some(step)),
                _ => Some(step),
            };
        }
        let stuck = self.attempts >= self.aim.tuning.long_patience;
        if let Some(step) = self.weigh_stiffness(stuck, system, t) {
            return Some(step);
        }
        if stuck {
            self.last_steps[self.active as usize] = self.h;
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
        let kind =
            if self.selection.active() == EXPLICIT { Kind::DormandPrince } else { self.implicit_kind() };
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

    /// The implicit method that advances further.
    fn implicit_kind(&self) -> Kind {
        if self.stiffness.active() == RADAU { Kind::Radau } else { Kind::Rosenbrock }
    }

    /// Goes on with the other implicit method: where that advances further, which is tried where steps are tiny beside those
    /// that the leapfrog was expected to make, or where the Radau method is `stuck` or its steps are the finest.
    fn weigh_stiffness<S: Complete<N>>(&mut self, stuck: bool, system: &mut S, t: f64) -> Option<f64> {
        // What does not cost more than the leapfrog is not stiff, and what does is soon over.
        if self.active != self.implicit_kind() || self.reason == Reason::Affordable {
            return None;
        }
        let finest = self.is_finest(self.h);
        if self.active == Kind::Radau && (stuck || finest) {
            self.stiffness.give_up();
        } else if finest || !self.stiffness.decide_below(self.aim.expected.step() / self.aim.tuning.stiff) {
            return None;
        }
        self.last_steps[Kind::Radau as usize] = self.last_steps[Kind::Rosenbrock as usize];
        let kind = self.implicit_kind();
        // What is known of error control holds for both.
        let known = (self.right, self.advanced, self.cost);
        let step = self.change_to(kind, self.reason, system, t);
        (self.right, self.advanced, self.cost) = known;
        if step.is_none() {
            self.stiffness.give_up();
        }
        step
    }

    /// Whether finer steps than those of `h` s are not asked for.
    pub(super) fn is_finest(&self, h: f64) -> bool {
        h < self.aim.tuning.finest * self.aim.expected.step()
    }

    /// Whether a probe says that the leapfrog could go on from the present state.
    fn may_leapfrog<S: Complete<N>>(&mut self, system: &mut S, t: f64) -> bool {
        let mut state = std::mem::take(&mut self.state);
        state.copy_from_slice(Stepper::<S>::state(self));
        Stepper::<S>::set_state(&mut self.leapfrog, &state);
        self.state = state;
        self.balance.can_spare()
            && self.leapfrog.refresh(system, t).is_ok()
            && self.monitor.allows(system, &self.leapfrog, t)
    }

    fn note_cost(&mut self, evaluations: f64) {
        self.selection.note_cost(evaluations);
        if self.active == self.implicit_kind() {
            self.stiffness.note_cost(evaluations);
        }
        self.cost += evaluations;
    }
}
