//! The driver: chooses step sizes, lands on events, retries failed steps, counts, interpolates.
//!
//! The driver runs ahead of the time its caller asks for and answers from the dense output of the last step, so
//! the times of the questions never influence the steps.
//!
//! The steps of a method that is judged ([`Stepper::longest_stretch`]) count in stretches. The driver runs ahead by one of them and
//! answers from the dense output of all its steps; nobody sees a stretch before it was judged. After a wrong one everything
//! goes back to its start. From a new state or input on, stretches grow from a single step, so that a host that sets inputs
//! often wastes few steps; and they end with the step in which it would set one again, if it did so at equal intervals.

pub mod control;
mod outcome;
mod trail;
pub mod watch;

pub use outcome::{Failure, Limits, Statistics};

use crate::integrate::auto::Choice;
use crate::integrate::{
    Applied, Observed, Progress, Stepper, Stretch, Total, Vibration, add_weighted, throughput,
};
use crate::stored::{Reader, Stored, stored};
use control::{Controller, Estimate, Plan, RECOVERY_GROWTH};
use trail::Trail;
use watch::Tally;

/// Most places of a step at which a method samples what the host watches.
const MOST_SAMPLES: usize = 3;

/// Intervals between two times at which the host sets something that are alike, relative: they are differences of sums.
const SAME_INTERVAL: f64 = 1e-6;

/// Integrates a system with one method.
pub struct Driver<S: Observed> {
    stepper: Box<dyn Stepper<S> + Send>,
    limits: Limits,
    /// The last accepted step spans `from` to `to`, s.
    from: f64,
    to: f64,
    /// Step of methods without error estimate, s.
    nominal_step: f64,
    next_step: f64,
    control: Controller,
    needs_refresh: bool,
    statistics: Statistics,
    /// Works of the system's powers up to `from`, and over the last step; and memory for as many.
    works: [Vec<f64>; 2],
    spare: Vec<f64>,
    /// The most that the works had brought in or taken out in all, J; looked at after stretches, or steps without them.
    passed: f64,
    /// Of what the host watches.
    tally: Tally,
    /// When it was started last, and when it will be if the host goes on like this, s; zero where that is not known.
    begun: f64,
    expected: f64,
    /// Number of steps of the next stretch.
    length: usize,
    /// The last stretch, whose steps are `made`; without room with a method that is not judged.
    stretch: Trail,
    made: usize,
    /// Whether the host stopped the run within the stretch; what was made of it then has yet to be judged.
    unfinished: bool,
    /// All of this before the stretch.
    mark: Vec<f64>,
}

impl<S: Observed> Driver<S> {
    /// A driver at rest; [`Driver::start`] comes next.
    pub fn new(stepper: Box<dyn Stepper<S> + Send>, limits: Limits) -> Self {
        let Progress { samples, works, .. } = stepper.progress();
        let (watched, works) = (samples.count(), vec![0.0; works.len()]);
        let mut driver = Self {
            stepper,
            limits,
            from: 0.0,
            to: 0.0,
            nominal_step: limits.nominal_step,
            next_step: limits.nominal_step,
            control: Controller::default(),
            needs_refresh: true,
            statistics: Statistics::default(),
            works: [works.clone(), works.clone()],
            spare: works,
            passed: 0.0,
            tally: Tally::new(watched),
            begun: 0.0,
            expected: 0.0,
            length: 1,
            stretch: Trail::default(),
            made: 0,
            unfinished: false,
            mark: Vec::new(),
        };
        let Stretch { steps, room, .. } = driver.stepper.longest_stretch();
        if steps > 0 {
            let sizes = [driver.stepper.state().len(), driver.spare.len()];
            driver.stretch = Trail::new(steps, sizes, room, [watched, MOST_SAMPLES]);
            driver.set_mark();
            // It is always as long.
            driver.mark.shrink_to_fit();
        }
        driver
    }

    /// Starts at time `t` from `state`. Counts go on, and so do works if `t` is within the last step.
    pub fn start(&mut self, t: f64, state: &[f64]) {
        self.tally_to(t);
        let mut sum = std::mem::take(&mut self.spare);
        self.works_at(t, &mut sum);
        std::mem::swap(&mut self.works[0], &mut sum);
        self.spare = sum;
        self.works[1].fill(0.0);
        self.stepper.set_state(state);
        (self.from, self.to) = (t, t);
        self.next_step = self.nominal_step;
        self.control = Controller::default();
        self.needs_refresh = true;
        (self.made, self.unfinished) = (0, false);
        self.expect_next(t);
    }

    /// Expects the host as long after time `t` (s) as that is after the last time, and stretches until then as long as before.
    fn expect_next(&mut self, t: f64) {
        let (interval, before) = (t - self.begun, self.expected - self.begun);
        let alike = (interval - before).abs() <= SAME_INTERVAL * interval;
        if interval != 0.0 {
            self.expected = if interval > 0.0 { t + interval } else { 0.0 };
        }
        if interval != 0.0 && !alike {
            self.length = 1;
        }
        self.begun = t;
    }

    /// Whether the last step is that in which the host is expected.
    fn meets_host(&self) -> bool {
        self.made > 0 && self.from < self.expected && self.expected <= self.to
    }

    /// Time the integration has reached, s; at least the time asked for.
    pub fn reached(&self) -> f64 {
        if self.unfinished { self.stretch.from().unwrap_or(self.to) } else { self.to }
    }

    /// What a method that chooses among others has chosen.
    pub fn choice(&self) -> Option<Choice> {
        self.stepper.choice()
    }

    /// Counts since creation.
    pub fn statistics(&self) -> &Statistics {
        &self.statistics
    }

    /// Sets all counts to zero and forgets what was learned from earlier states.
    pub fn reset(&mut self) {
        self.statistics = Statistics::default();
        self.stepper.reset_counts();
        self.forget();
    }

    /// Forgets what was learned from earlier states; counts stay.
    pub fn forget(&mut self) {
        self.nominal_step = self.limits.nominal_step;
        self.stepper.forget();
    }

    /// Integrates until `t` is reached or passed.
    ///
    /// # Errors
    /// A [`Failure`]; everything up to the last accepted step stays available.
    pub fn advance(&mut self, system: &mut S, t: f64) -> Result<(), Failure<S::Fault>> {
        let mut attempts = 0;
        while self.reached() < t {
            if self.stretch.longest() > 0 {
                let made = self.make_stretch(system, &mut attempts);
                // What fails beyond the time that is asked for fails again when it is reached.
                if self.reached() < t {
                    made?;
                }
            } else {
                self.tally_to(self.to);
                self.make_step(system, &mut attempts)?;
            }
            self.note_passed(system);
        }
        Ok(())
    }

    /// Makes a stretch of steps that is right, again and more closely if it is not.
    fn make_stretch(&mut self, system: &mut S, attempts: &mut u64) -> Result<(), Failure<S::Fault>> {
        loop {
            if !std::mem::take(&mut self.unfinished) {
                self.tally_to(self.to);
                self.set_mark();
            }
            let length = self.length;
            let mut made = Ok(());
            while made.is_ok() && self.made < length && self.has_room() && !self.meets_host() {
                made = self.make_step(system, attempts).map(|()| self.keep_step());
            }
            if let Err(Failure::Interrupted { .. } | Failure::TooManySteps { .. }) = made {
                // From outside, and no reason to judge less than a whole stretch: it goes on when the host does.
                self.unfinished = self.made > 0;
                return made.map_err(|failure| failure.at(self.reached()));
            }
            if self.made == 0 || self.stepper.judge(system, self.to) {
                self.length = (2 * length).min(self.stretch.longest());
                return made;
            }
            self.go_back(system);
        }
    }

    fn set_mark(&mut self) {
        self.made = 0;
        self.stretch.begin(self.stepper.state());
        let mut mark = std::mem::take(&mut self.mark);
        mark.clear();
        self.save(&mut mark);
        self.mark = mark;
    }

    /// Back to the mark, and on from there with a method that follows the system more closely.
    fn go_back(&mut self, system: &mut S) {
        let undone = self.statistics.undone + self.made as u64;
        let mark = std::mem::take(&mut self.mark);
        let loaded = self.load(&mut Reader::new(&mark));
        debug_assert!(loaded.is_some(), "what was saved fits");
        self.mark = mark;
        self.statistics.undone = undone;
        if let Some(step) = self.stepper.go_back(system, self.to) {
            self.set_step(step);
        }
        self.set_mark();
    }

    /// Keeps the last step for questions about it.
    fn keep_step(&mut self) {
        let works = self.works.each_ref().map(Vec::as_slice);
        let (span, stepper) = ([self.from, self.to], &self.stepper);
        let Progress { end, samples, .. } = stepper.progress();
        self.stretch.add(span, end, works, samples, |rest| stepper.keep(rest));
        self.made += 1;
    }

    /// Whether the step that comes next can be kept with those of its stretch; the first always can.
    fn has_room(&self) -> bool {
        self.made == 0 || self.stretch.has_room(self.stepper.longest_stretch().of_step)
    }

    /// The step of the last stretch that time `t` (s) lies in, if there is one.
    fn step_at(&self, t: f64) -> Option<trail::Step<'_>> {
        if self.made > 0 { self.stretch.at(t) } else { None }
    }

    fn make_step(&mut self, system: &mut S, attempts: &mut u64) -> Result<(), Failure<S::Fault>> {
        if self.needs_refresh {
            let refreshed = self.stepper.refresh(system, self.to);
            refreshed.map_err(|fault| Failure::AtStart { time: self.to, fault })?;
            self.needs_refresh = false;
        }
        self.step(system, attempts)
    }

    /// Whether time `t` (s) lies within the last step or stretch.
    pub fn covers(&self, t: f64) -> bool {
        let of_stretch = if self.made > 0 { self.stretch.from() } else { None };
        of_stretch.unwrap_or(self.from) <= t && t <= self.to
    }

    /// State at time `t` within the last step or stretch (s).
    pub fn state_at(&self, t: f64, out: &mut [f64]) {
        if t >= self.to || self.to <= self.from {
            out.copy_from_slice(self.stepper.state());
        } else if let Some(step) = self.step_at(t) {
            let [from, to] = step.span();
            self.stepper.recall(&step.kept(), (t - from) / (to - from), out);
        } else {
            self.stepper.interpolate((t - self.from) / (self.to - self.from), out);
        }
    }

    /// Start time of the step at time `t` (s) and what it was made with, for methods whose forces are those of steps.
    pub fn applied_at(&self, t: f64) -> Option<(f64, Applied<'_>)> {
        if let Some(step) = self.step_at(t) {
            let [from, _] = step.span();
            return self.stepper.applied_in(step.kept()).map(|applied| (from, applied));
        }
        (self.to > self.from).then(|| self.stepper.applied()).flatten().map(|step| (self.from, step))
    }

    /// Works of the system's powers since they were forgotten, up to time `t` (s) within the last step or stretch.
    pub fn works_at(&self, t: f64, out: &mut [f64]) {
        let share_of = |[from, to]: [f64; 2]| {
            let step = to - from;
            if step > 0.0 { ((t - from) / step).clamp(0.0, 1.0) } else { 1.0 }
        };
        if let Some(step) = self.step_at(t) {
            return step.works(share_of(step.span()), out);
        }
        let [sum, last] = &self.works;
        out.copy_from_slice(sum);
        add_weighted(out, share_of([self.from, self.to]), last);
    }

    /// Begins the interval of [`Driver::total_at`] at time `t` (s) within the last step or stretch.
    pub fn begin_interval(&mut self, t: f64) {
        self.tally_to(t);
        self.tally.begin(t);
    }

    /// Start of the interval (s), and the totals from there to time `t` (s) within the last step or stretch of the quantity at
    /// a place among those that the host watches; `None` of no time. Steps count whole in the extremes.
    pub fn total_at(&mut self, t: f64, place: usize) -> (f64, Option<Total>) {
        self.tally_to(t);
        (self.tally.from, self.tally.total(place))
    }

    /// Adds the steps up to time `t` (s) to the totals; of what is beyond, nobody has asked yet.
    fn tally_to(&mut self, t: f64) {
        if self.tally.is_empty() || self.unfinished {
            return;
        }
        if self.made > 0 {
            for step in self.stretch.steps() {
                self.tally.add(step.span(), step.samples(), t);
            }
        }
        if self.stretch.longest() == 0 {
            self.tally.add([self.from, self.to], &self.stepper.progress().samples, t);
        }
    }

    /// Sets the works to zero; comes after [`Driver::start`].
    pub fn forget_works(&mut self) {
        self.works.iter_mut().for_each(|works| works.fill(0.0));
        self.passed = 0.0;
    }

    /// The most that the works had brought in or taken out in all since they were forgotten, J.
    pub fn passed(&self) -> f64 {
        self.passed
    }

    fn note_passed(&mut self, system: &S) {
        let ([sum, last], [powers, _]) = (&self.works, system.power_count());
        let works = sum.iter().zip(last).map(|(sum, last)| sum + last).take(powers);
        self.passed = self.passed.max(throughput(works, []));
    }

    /// Goes on with this step (s), and without memory of errors.
    fn set_step(&mut self, step: f64) {
        let largest = self.limits.nominal_step.max(self.limits.max_step);
        let step = step.clamp(self.limits.min_step, largest);
        (self.nominal_step, self.next_step) = (step, step);
        self.control = Controller::default();
    }

    /// Makes one accepted step.
    fn step(&mut self, system: &mut S, attempts: &mut u64) -> Result<(), Failure<S::Fault>> {
        let (mut last_fault, mut worst_group) = (None, None);
        loop {
            if *attempts >= self.limits.max_steps {
                return Err(Failure::TooManySteps { time: self.to, limit: self.limits.max_steps });
            }
            if let Some(why) = system.interruption() {
                return Err(Failure::Interrupted { time: self.to, why });
            }
            *attempts += 1;
            let event = system.next_event(self.to);
            if let Some(step) = self.stepper.review(system, self.to) {
                self.set_step(step);
            }
            let (q, v) = self.stepper.state().split_at(system.positions());
            let longest = system.longest_step(self.to, q, v, self.next_step);
            let h = self.next_step.min(longest.max(self.limits.min_step));
            let plan = Plan::of(self.to, h, self.next_step, event);
            if plan.end <= self.to {
                // The step is lost in the round-off of the time.
                return Err(Failure::StepTooSmall {
                    time: self.to,
                    step: plan.h,
                    fault: last_fault,
                    group: worst_group,
                });
            }
            match self.stepper.attempt(system, self.to, plan.h, plan.t_last) {
                Ok(Some(Estimate { error, .. })) if error <= 1.0 => {
                    let factor = self.control.accepted(error, self.stepper.control());
                    // A step cut by an event says little about the size of the next one: do not shrink for it.
                    let floor = if plan.cut { self.next_step } else { 0.0 };
                    self.next_step = (plan.h * factor).max(floor).min(self.limits.max_step);
                    return self.accept(system, &plan);
                }
                Ok(None) => {
                    self.next_step = (self.next_step * RECOVERY_GROWTH).min(self.nominal_step);
                    return self.accept(system, &plan);
                }
                Ok(Some(Estimate { error, group })) => {
                    self.statistics.rejected += 1;
                    system.rejected(group);
                    (last_fault, worst_group) = (None, Some(group));
                    self.next_step = plan.h * self.control.rejected(error, self.stepper.control());
                }
                Err(fault) => {
                    self.statistics.faults += 1;
                    system.failed(self.to, fault);
                    self.next_step = plan.h * self.control.failed();
                    (last_fault, worst_group) = (Some(fault), None);
                }
            }
            let smallest = self.limits.min_step.max(4.0 * f64::EPSILON * self.to.abs());
            if self.next_step < smallest {
                let step = self.next_step;
                self.next_step = self.nominal_step;
                return Err(Failure::StepTooSmall {
                    time: self.to,
                    step,
                    fault: last_fault,
                    group: worst_group,
                });
            }
        }
    }

    fn accept(&mut self, system: &S, plan: &Plan) -> Result<(), Failure<S::Fault>> {
        let [sum, last] = &mut self.works;
        add_weighted(sum, 1.0, last);
        last.copy_from_slice(&self.stepper.progress().works);
        self.stepper.accept();
        (self.from, self.to) = (self.to, plan.end);
        self.needs_refresh = plan.on_event;
        let s = &mut self.statistics;
        s.steps += 1;
        s.vibration.add(system.vibration(), plan.h);
        s.events += u64::from(plan.on_event);
        s.largest_step = s.largest_step.max(plan.h);
        if !plan.cut && (s.smallest_step == 0.0 || plan.h < s.smallest_step) {
            s.smallest_step = plan.h;
        }
        let overdrawn = system.overdrawn(self.works.each_ref().map(Vec::as_slice));
        overdrawn.map_or(Ok(()), |fault| Err(Failure::Overdrawn { time: self.to, fault }))
    }

    /// Appends everything that the next steps depend on, as it was before the last stretch: after [`Stored::load`] the stretch
    /// has to be made again.
    pub fn save_for_later(&self, out: &mut Vec<f64>) {
        if self.made > 0 {
            out.extend_from_slice(&self.mark);
        } else {
            self.save(out);
        }
    }

    /// Whether a state that was loaded is one that the driver can have.
    fn is_sound(&self) -> bool {
        let Self { limits, control, statistics: s, .. } = self;
        let largest = limits.nominal_step.max(limits.max_step);
        let step = |h: f64| h > 0.0 && h <= largest;
        let counts = [s.smallest_step, s.largest_step, s.vibration.squares, s.vibration.count];
        self.to >= self.from
            && self.passed >= 0.0
            && step(self.nominal_step)
            && step(self.next_step)
            && (control.last_error > 0.0 && control.last_change > 0.0)
            && (1..=self.stretch.longest().max(1)).contains(&self.length)
            && counts.iter().all(|x| *x >= 0.0)
    }
}

stored! {
    impl[S: Observed] Driver<S> {
        from, to, nominal_step, next_step, control, needs_refresh, begun, expected, length, statistics, works, passed, stepper
    }
    then { made = 0, unfinished = false }
    if Self::is_sound
}

stored! {
    impl[] Controller { last_error, last_change, after_rejection }
}

stored! {
    impl[] Statistics { steps, rejected, faults, events, undone, smallest_step, largest_step, vibration }
}

stored! {
    impl[] Vibration { squares, count }
}
