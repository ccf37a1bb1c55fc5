//! The chosen method at work: attempts, accounts, judgement, memory.

use super::balance::Judgement;
use super::{Auto, Choice, KINDS, Kind, REASONS, Reason, Wrong};
use crate::integrate::driver::control::{Estimate, Law};
use crate::integrate::{Applied, Complete, DormandPrince, Kept, Progress, Rosenbrock, Stepper, Stretch};
use crate::stored::{stored, stored_choice};

/// Most numbers that a method keeps of a step, per state.
const MOST_KEPT: usize = 4;

impl<S: Complete<N>, const N: usize> Stepper<S> for Auto<N> {
    fn set_state(&mut self, state: &[f64]) {
        self.balance.close();
        self.placed = true;
        active!(self, S, set_state(state));
    }

    fn refresh(&mut self, system: &mut S, t: f64) -> Result<(), S::Fault> {
        if !std::mem::take(&mut self.placed) && self.aim.statistics && self.event_wait == 0 {
            (self.event, self.event_wait) = (true, self.aim.tuning.event_interval);
        }
        active!(self, S, refresh(system, t))
    }

    fn review(&mut self, system: &mut S, t: f64) -> Option<f64> {
        if !self.balance.is_open() {
            // A failure is the run's own in a moment.
            self.balance.open(system, t, active!(self, ref S, state())).ok();
        }
        match self.active {
            Kind::Leapfrog => self.review_leapfrog(system, t),
            _ => self.review_error_control(system, t),
        }
    }

    fn forget(&mut self) {
        self.start_over();
    }

    fn reset_counts(&mut self) {
        (self.steps, self.changes) = ([0; KINDS.len()], 0);
        self.monitor.reset_highest();
    }

    fn attempt(&mut self, system: &mut S, t: f64, h: f64, t_last: f64) -> Result<Option<Estimate>, S::Fault> {
        self.h = h;
        let result = active!(self, S, attempt(system, t, h, t_last));
        self.attempts += 1;
        match self.active {
            Kind::Leapfrog => return result,
            Kind::DormandPrince => self.note_cost(DormandPrince::EVALUATIONS),
            Kind::Rosenbrock => self.note_cost(Rosenbrock::<N>::EVALUATIONS),
            Kind::Radau => self.note_cost(f64::from(self.radau.evaluations())),
        }
        let strictness = if self.is_finest(h) { 0 } else { self.strictness };
        let stricter = self.aim.tuning.stricter.powi(strictness as i32);
        result.map(|estimate| {
            estimate.map(|estimate| Estimate { error: stricter * estimate.error, ..estimate })
        })
    }

    fn accept(&mut self) {
        self.balance.add(&active!(self, ref S, progress()).works);
        active!(self, S, accept());
        self.steps[self.active as usize] += 1;
        self.attempts = 0;
        if self.active == Kind::Leapfrog {
            return self.monitor.count_step();
        }
        self.last_steps[self.active as usize] = self.h;
        self.selection.note_advance(self.h);
        self.advanced += self.h;
        if self.active == self.implicit_kind() {
            self.stiffness.note_advance(self.h);
        }
        match self.active {
            Kind::Rosenbrock => {
                self.note_cost(Rosenbrock::<N>::EVALUATIONS_AT_START + self.linearization_cost)
            }
            Kind::Radau => self.note_cost(1.0 + self.linearization_cost),
            Kind::Leapfrog | Kind::DormandPrince => {}
        }
    }

    fn longest_stretch(&self) -> Stretch {
        // Room for the leapfrog's; each number here is one for the method, and what that keeps.
        let (steps, state) = (self.aim.tuning.longest_stretch, self.state.len());
        let of_step = 1 + MOST_KEPT * state;
        Stretch { steps, room: steps * (2 + self.leapfrog.velocities()) + of_step, of_step }
    }

    fn judge(&mut self, system: &mut S, t: f64) -> bool {
        // The leapfrog does not evaluate where it arrives; with error control a failure is the run's own in a moment.
        let controlled = self.active != Kind::Leapfrog;
        let settled = self.balance.settle(system, t, active!(self, ref S, state()), controlled);
        let right = settled.map_or(controlled, |judgement| judgement != Judgement::Wrong);
        if settled.is_ok_and(|judgement| judgement == Judgement::Inherent) {
            self.relax();
        }
        self.judged = true;
        self.wrong = Wrong {
            method: self.active,
            refinement: self.monitor.refinement(),
            missed: self.balance.missed(),
        };
        right || controlled && self.strictness == self.aim.tuning.strictest
    }

    /// The stretch may have begun with a change of method or strictness, which is undone, too.
    fn go_back(&mut self, system: &mut S, t: f64) -> Option<f64> {
        (self.hold, self.right) = (self.next_hold, 0);
        self.next_hold = (2 * self.next_hold).min(self.aim.tuning.longest_hold);
        let Wrong { method, refinement, missed } = self.wrong;
        if self.derivatives_are_dear() {
            self.balance.suspect(missed);
        }
        if method != Kind::Leapfrog {
            self.strictness = (self.strictness + 1).min(self.aim.tuning.strictest);
        } else {
            self.reason = Reason::Balance;
            self.monitor.take_care();
            if self.monitor.refine(refinement) {
                return self.go_on_finer(system, t);
            }
        }
        if self.active == Kind::Leapfrog { self.control_errors(Reason::Balance, system, t) } else { None }
    }

    fn keep(&self, out: &mut Vec<f64>) {
        out.push(self.active as usize as f64);
        active!(self, ref S, keep(out));
    }

    fn recall(&self, kept: &Kept<'_>, theta: f64, out: &mut [f64]) {
        let Some((kind, rest)) = kept.rest.split_first() else { return };
        of_kind!(KINDS[*kind as usize], [&] self, S, recall(&Kept { rest, ..*kept }, theta, out));
    }

    fn applied_in<'a>(&self, kept: Kept<'a>) -> Option<Applied<'a>> {
        let (kind, rest) = kept.rest.split_first()?;
        of_kind!(KINDS[*kind as usize], [&] self, S, applied_in(Kept { rest, ..kept }))
    }

    fn progress(&self) -> &Progress {
        active!(self, ref S, progress())
    }

    fn applied(&self) -> Option<Applied<'_>> {
        active!(self, ref S, applied())
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
            highest_frequency: self.monitor.highest_frequency(),
        })
    }
}

impl<const N: usize> Auto<N> {
    /// Whether a state that was loaded is one that the choice can have.
    fn is_sound(&self) -> bool {
        let steps = self.last_steps.iter().chain([&self.h]);
        steps.into_iter().all(|h| *h > 0.0)
            && (self.advanced >= 0.0 && self.cost >= 0.0)
            && self.strictness <= self.aim.tuning.strictest
    }
}

// All methods are saved, so that the length is always the same.
stored! {
    impl[const N: usize] Auto<N> {
        active, reason, last_steps, h, advanced, cost, placed, judged, event, attempts, strictness, hold, next_hold,
        right, wait, pause, event_wait, steps, changes, monitor, selection, stiffness, balance, leapfrog,
        dormand_prince, rosenbrock, radau
    }
    if Self::is_sound
}

stored_choice!(Kind, KINDS);
stored_choice!(Reason, REASONS);
