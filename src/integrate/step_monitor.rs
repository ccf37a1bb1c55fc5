//! Monitors the leapfrog, which has no error estimate of its own, and chooses its step.
//!
//! The step is `share / highest frequency`, halved `level` times. From time to time the highest frequency is measured
//! at the present state, and a stretch of steps is made twice, with the step and with half of it: their difference is
//! the error of the stretch, and the ratio of their vibrations shows whether the method drives or damps them. Both
//! move the level; neither touches the run itself.

use super::control::ErrorNorm;
use super::mode::{Mode, ModeFinder};
use super::{Leapfrog, Linearization, Reader, Stepper, System, Vibration};

/// Steps between two checks: they cost a twentieth of a run. The first checks follow each other sooner.
const INTERVAL: u64 = 512;
const FIRST_INTERVAL: u64 = 64;
/// Steps of a stretch: about one period of the fastest vibration.
const STRETCH: usize = 8;
/// Largest relative change of vibration. Measured on a roller bearing, as the largest errors of the presets.
const LARGEST_CHANGE: f64 = 0.25;
/// A stretch with more than this many times the largest error is refined at once: more than an impact makes, of those
/// that occur once in a hundred checks.
const FAR_TOO_MUCH: f64 = 32.0;
/// Error control gives back to the leapfrog below these shares.
const GIVE_BACK: [f64; 2] = [0.5, 1.0];
/// Below these shares of the largest error and change the step is doubled. Errors grow with its cube where motion is
/// smooth, with its square or less where contacts open and close.
const COMFORT: [f64; 2] = [0.2, 0.2];
/// The frequency that the step rests on follows the measured one only if they differ by more than this factor.
const CLEAR_DIFFERENCE: f64 = 1.1;
/// Weight of the past in the running means, and the total weight, that of 24 checks, from which they count: errors of
/// single stretches scatter by twice their mean, so the mean of 24 does by two fifths.
const MEMORY: f64 = 31.0 / 32.0;
const ENOUGH: f64 = 0.53;
/// Eight checks are enough for means of more than this many times the largest error.
const EARLY: f64 = 0.22;
const CLEARLY_TOO_MUCH: f64 = 2.0;
/// Without damping, vibration grows until its phases are the largest errors, and they mean nothing in statistics. The
/// leapfrog turns them by (h frequency)^3/3 in a stretch; errors up to this many times the speed that makes are allowed.
const PHASES: f64 = 1.5;
/// Below this share of critical damping the fastest vibration counts as undamped: half the step.
const LIGHT_DAMPING: f64 = 0.01;
/// Steps finer than by this many halvings cost as much as error control, without its bound on the bias.
const FINEST: u64 = 1;
/// The same holds where the highest frequency is more than this many times the expected one.
const HIGHEST: f64 = 2.0;

/// What is known about a system before its first step.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Expectation {
    /// Highest frequency of undamped vibration, rad/s; zero if unknown.
    pub frequency: f64,
    /// Whether that vibration is damped.
    pub damped: bool,
    /// Step in units of 1/frequency.
    pub share: f64,
    /// Largest step, s.
    pub largest_step: f64,
    /// Largest error of a stretch, in units of the norm.
    pub largest_error: f64,
    /// Speed of vibration that counts as one such unit, m/s.
    pub speed_unit: f64,
}

impl Expectation {
    /// The step to start with, s.
    pub fn step(&self) -> f64 {
        self.step_at(self.frequency, self.level())
    }

    fn step_at(&self, frequency: f64, level: u64) -> f64 {
        let halvings = (0..level).fold(1.0, |share, _| 0.5 * share);
        (self.share / frequency).min(self.largest_step) * halvings
    }

    /// The level to start with, and the lowest one while nothing else is known.
    fn level(&self) -> u64 {
        u64::from(!self.damped)
    }
}

/// What the checks have found since the start.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Findings {
    /// Number of checks.
    pub checks: u64,
    /// Mean and largest error of a stretch, in units of the norm.
    pub mean_error: f64,
    /// Largest error of a stretch.
    pub largest_error: f64,
    /// Vibration with the step and with half of it.
    pub vibrations: [Vibration; 2],
    /// Highest frequency met, rad/s.
    pub frequency: f64,
}

impl Findings {
    /// Root mean square vibration with the step over that with half of it; 1 if there is none.
    pub fn vibration_ratio(&self) -> f64 {
        let [coarse, fine] = self.vibrations.map(Vibration::rms);
        if fine > 0.0 { coarse / fine } else { 1.0 }
    }
}

/// What a check leads to.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Verdict {
    /// Go on.
    Keep,
    /// Go on with another step.
    Change,
    /// No step that is worth its cost is accurate enough.
    Hopeless,
}

/// The monitor and its memory.
#[derive(Clone, Debug)]
pub struct StepMonitor {
    expected: Expectation,
    coarse: Leapfrog,
    fine: Leapfrog,
    norm: ErrorNorm,
    finder: ModeFinder,
    slopes: Linearization,
    a: Vec<f64>,
    /// Steps until the next check.
    due: u64,
    level: u64,
    /// Highest frequency that the step rests on, rad/s.
    frequency: f64,
    /// Whether the fastest vibration counts as undamped.
    undamped: bool,
    /// Running sums of the error and of both vibrations, and their total weight.
    error: f64,
    vibrations: [Vibration; 2],
    weight: f64,
    findings: Findings,
}

impl StepMonitor {
    /// A monitor of a system; `units` are one unit of error of each state.
    pub fn new<S: System>(system: &S, expected: Expectation, units: &[f64]) -> Self {
        let (structure, leapfrog) = (system.structure(), Leapfrog::new(system));
        let mut monitor = Self {
            expected,
            coarse: leapfrog.clone(),
            fine: leapfrog,
            norm: ErrorNorm::new(system, units),
            finder: ModeFinder::new(&structure, system.positions(), units),
            slopes: Linearization::new(&structure, system.velocities()),
            a: vec![0.0; system.velocities()],
            due: 0,
            level: 0,
            frequency: 0.0,
            error: 0.0,
            undamped: false,
            vibrations: [Vibration::default(); 2],
            weight: 0.0,
            findings: Findings::default(),
        };
        monitor.forget();
        monitor
    }

    /// Forgets everything that was measured.
    pub fn forget(&mut self) {
        self.level = self.expected.level();
        self.undamped = !self.expected.damped;
        self.frequency = self.expected.frequency;
        self.due = 0;
        self.findings = Findings::default();
        self.start_anew();
    }

    /// What was found.
    pub fn findings(&self) -> &Findings {
        &self.findings
    }

    /// Step of the leapfrog, s.
    pub fn step(&self) -> f64 {
        self.expected.step_at(self.frequency, self.level)
    }

    /// One more step was made.
    pub fn count_step(&mut self) {
        self.due = self.due.saturating_sub(1);
    }

    /// Checks, if it is time to. `main` is the method at time `t`; nothing is evaluated later than `t_last`. Longer steps are
    /// for those who can spare some accuracy.
    pub fn look<S: System>(
        &mut self,
        system: &mut S,
        main: &Leapfrog,
        t: f64,
        t_last: f64,
        can_spare: bool,
    ) -> Verdict {
        if self.due > 0 {
            return Verdict::Keep;
        }
        self.due = if self.weight < EARLY { FIRST_INTERVAL } else { INTERVAL };
        let before = self.step();
        let floor = self.measure_frequency(system, main, t);
        self.level = self.level.max(floor);
        // A step that is far too coarse is refined at once, others after some checks have agreed.
        while let Some(error) = self.check(system, main, t, t_last) {
            if error <= FAR_TOO_MUCH * self.largest_error() || self.level > FINEST {
                break;
            }
            self.refine();
        }
        let largest = [1.0, 1.0];
        if self.weight > EARLY && !self.accurate(largest.map(|x| CLEARLY_TOO_MUCH * x))
            || self.weight > ENOUGH && !self.accurate(largest)
        {
            self.refine();
        } else if can_spare && self.weight > ENOUGH && self.level > floor && self.accurate(COMFORT) {
            self.level -= 1;
            self.start_anew();
        }
        if self.too_fine() {
            Verdict::Hopeless
        } else if self.step() == before {
            Verdict::Keep
        } else {
            Verdict::Change
        }
    }

    /// While another method runs: makes the check at the finest step that is worth its cost, from the state that `main`
    /// has been set to. Whether the leapfrog may go on from there.
    pub fn probe<S: System>(&mut self, system: &mut S, main: &Leapfrog, t: f64, t_last: f64) -> bool {
        self.level = FINEST;
        self.measure_frequency(system, main, t);
        if self.too_fine() || self.check(system, main, t, t_last).is_none_or(f64::is_infinite) {
            self.start_anew();
            return false;
        }
        let may = self.weight > ENOUGH && self.accurate(GIVE_BACK);
        if may {
            self.start_anew();
            self.due = INTERVAL;
        }
        may
    }

    /// Gives the run to another method.
    pub fn give_up(&mut self) {
        self.level = FINEST;
        self.start_anew();
    }

    fn too_fine(&self) -> bool {
        self.level > FINEST || self.frequency > HIGHEST * self.expected.frequency
    }

    /// Whether the running means of errors and vibrations are below these shares of what is allowed.
    fn accurate(&self, [of_error, of_change]: [f64; 2]) -> bool {
        self.error <= of_error * self.largest_error() * self.weight
            && self.change_of_vibration() <= of_change * LARGEST_CHANGE
    }

    /// Largest mean error of a stretch that is allowed.
    fn largest_error(&self) -> f64 {
        let turned = (self.step() * self.frequency).powi(3) / 3.0;
        let phases = PHASES * turned * self.vibrations[1].rms() / self.expected.speed_unit;
        if self.undamped { phases.max(self.expected.largest_error) } else { self.expected.largest_error }
    }

    /// Halves the step.
    pub fn refine(&mut self) -> Verdict {
        self.level += 1;
        self.start_anew();
        if self.too_fine() { Verdict::Hopeless } else { Verdict::Change }
    }

    fn start_anew(&mut self) {
        (self.error, self.vibrations, self.weight) = (0.0, Default::default(), 0.0);
    }

    /// Relative difference of the vibrations with the step and with half of it.
    fn change_of_vibration(&self) -> f64 {
        let [coarse, fine] = self.vibrations.map(Vibration::rms);
        if fine > 0.0 { (coarse / fine - 1.0).abs() } else { 0.0 }
    }

    /// Measures the highest frequency; returns the level below which its damping forbids to go.
    fn measure_frequency<S: System>(&mut self, system: &mut S, main: &Leapfrog, t: f64) -> u64 {
        let expected = self.expected.level();
        let (q, v) = Stepper::<S>::state(main).split_at(system.positions());
        if system.linearize(t, q, v, &mut self.a, &mut self.slopes).is_err() {
            return expected;
        }
        let Mode { frequency, damping_ratio } = self.finder.find(&self.slopes);
        self.findings.frequency = self.findings.frequency.max(frequency);
        let known = frequency.max(self.expected.frequency);
        if known > CLEAR_DIFFERENCE * self.frequency || self.frequency > CLEAR_DIFFERENCE * known {
            self.frequency = known;
        }
        if frequency < 0.5 * self.frequency {
            return expected;
        }
        let light = damping_ratio < LIGHT_DAMPING;
        self.undamped = light || !self.expected.damped;
        u64::from(light)
    }

    /// Makes a stretch of steps twice, if it lies before `t_last`. Returns its error; infinity if it could not be made.
    fn check<S: System>(&mut self, system: &mut S, main: &Leapfrog, t: f64, t_last: f64) -> Option<f64> {
        let h = self.step();
        if t + STRETCH as f64 * h > t_last {
            return None;
        }
        let mut vibrations = [Vibration::default(); 2];
        for (method, (pieces, vibration)) in
            [&mut self.coarse, &mut self.fine].into_iter().zip([1, 2].into_iter().zip(&mut vibrations))
        {
            method.copy_from(main);
            let h = h / f64::from(pieces);
            for i in 0..STRETCH * pieces as usize {
                if method.attempt(system, t + i as f64 * h, h, t_last).is_err() {
                    return Some(f64::INFINITY);
                }
                Stepper::<S>::accept(method);
                vibration.add(system.vibration(), 1.0 / f64::from(pieces));
            }
        }
        let (coarse, fine) = (Stepper::<S>::state(&self.coarse), Stepper::<S>::state(&self.fine));
        let error = self.norm.of(|i| coarse[i] - fine[i]).error;
        self.note(error, vibrations);
        Some(error)
    }

    fn note(&mut self, error: f64, vibrations: [Vibration; 2]) {
        let found = &mut self.findings;
        found.checks += 1;
        found.mean_error += (error - found.mean_error) / found.checks as f64;
        found.largest_error = found.largest_error.max(error);
        for ((sum, mean), now) in found.vibrations.iter_mut().zip(&mut self.vibrations).zip(vibrations) {
            sum.add(now, 1.0);
            let past = std::mem::take(mean);
            mean.add(past, MEMORY);
            mean.add(now, 1.0 - MEMORY);
        }
        self.error = MEMORY * self.error + (1.0 - MEMORY) * error;
        self.weight = MEMORY * self.weight + (1.0 - MEMORY);
    }

    /// Appends everything that the next steps depend on.
    pub fn save(&self, out: &mut Vec<f64>) {
        let f = &self.findings;
        out.extend([self.due, self.level, f.checks].map(|n| n as f64));
        out.push(f64::from(u8::from(self.undamped)));
        out.extend([self.frequency, self.error, self.weight]);
        out.extend([f.mean_error, f.largest_error, f.frequency]);
        out.extend(self.vibrations.iter().chain(&f.vibrations).flat_map(|v| [v.squares, v.count]));
    }

    /// Takes back what [`StepMonitor::save`] wrote; `None` if it does not fit.
    pub fn load(&mut self, from: &mut Reader<'_>) -> Option<()> {
        let positive = |from: &mut Reader<'_>| from.number().filter(|x| *x >= 0.0);
        self.due = from.count()?;
        self.level = from.count().filter(|level| *level <= FINEST)?;
        let checks = from.count()?;
        self.undamped = from.count()? > 0;
        self.frequency = positive(from)?;
        self.error = positive(from)?;
        self.weight = positive(from)?;
        self.findings = Findings {
            checks,
            mean_error: positive(from)?,
            largest_error: positive(from)?,
            frequency: positive(from)?,
            vibrations: [(); 2].map(|()| Vibration::default()),
        };
        for vibration in self.vibrations.iter_mut().chain(&mut self.findings.vibrations) {
            *vibration = Vibration { squares: positive(from)?, count: positive(from)? };
        }
        Some(())
    }
}
