//! From the scene's choice of a method to a running one, and back to words.

use super::bearing::Bearing;
use super::preset::{CAREFUL_STEP, Numbers, UNDAMPED_SHARE, numbers};
use crate::integrate::auto::stability::Expectation;
use crate::integrate::auto::{Aim, Auto, Choice, Kind, Reason};
use crate::integrate::{
    Adams, DormandPrince, Leapfrog, Limits, Linearized, Radau, Rosenbrock, Split, Stepper, Tuning,
};
use crate::model::{Model, OF_BALL, OF_ELEMENT};
use crate::scene::{Method, Solver};

/// Largest step of methods with error control, unless the scene says otherwise, in units of 1/(frequency of contacts): half
/// the time of a contact, so that none is jumped over except by a graze. Not with rollers, whose loaded contacts keep
/// steps short. And in s: a tenth of a millisecond still sees every roller pass.
const LARGEST_SHARE: f64 = std::f64::consts::FRAC_PI_2;
const MAX_STEP: f64 = 1e-4;
/// Largest nominal leapfrog step, s: without stiff contacts, films and the motion of the elements still set a scale.
const MAX_NOMINAL_STEP: f64 = 2e-5;
/// First step of methods with error control in units of 1/(highest frequency).
const FIRST_STEP: f64 = 0.1;

/// The method that is asked for.
pub(super) fn stepper(model: &Model, solver: &Solver, bearing: &Bearing) -> Box<dyn Stepper<Bearing> + Send> {
    match model.space() {
        Some(_) => stepper_of::<OF_BALL>(model, solver, bearing),
        None => stepper_of::<OF_ELEMENT>(model, solver, bearing),
    }
}

/// That for spokes of so many velocities.
fn stepper_of<const N: usize>(
    model: &Model,
    solver: &Solver,
    bearing: &Bearing,
) -> Box<dyn Stepper<Bearing> + Send>
where
    Bearing: Linearized<N> + Split<N>,
{
    let tolerance = solver.method.tolerance().unwrap_or(numbers(solver.preset).tolerance);
    let tolerances: Vec<f64> = model.state_scales().iter().map(|unit| tolerance * unit).collect();
    match &solver.method {
        Method::Auto(_) => Box::new(Auto::<N>::new(bearing, aim(model, solver, bearing.tuning()))),
        Method::Leapfrog(_) => Box::new(Leapfrog::<N>::new(bearing)),
        Method::DormandPrince(_) => Box::new(DormandPrince::new(bearing, &tolerances)),
        Method::Adams(_) => Box::new(Adams::new(bearing, &tolerances)),
        Method::Rosenbrock(_) => Box::new(Rosenbrock::<N>::new(bearing, &tolerances)),
        Method::Radau(_) => Box::new(Radau::<N>::new(bearing, &tolerances)),
    }
}

/// Steps and limits that a run starts with.
pub(super) fn limits(model: &Model, solver: &Solver) -> Limits {
    let nominal_step = match &solver.method {
        Method::Auto(_) => aim(model, solver, Tuning::default()).nominal_step(),
        Method::Leapfrog(m) => m.step.unwrap_or_else(|| {
            let damped = numbers(solver.preset).leapfrog_step;
            let share = if model.damped() { damped } else { UNDAMPED_SHARE * damped };
            (share / model.highest_frequency()).min(MAX_NOMINAL_STEP)
        }),
        _ => first_step(model, solver),
    };
    Limits {
        nominal_step: nominal_step.min(bound(solver)).max(solver.min_step),
        min_step: solver.min_step,
        max_step: largest_step(model, solver).max(solver.min_step),
        max_steps: solver.max_steps,
    }
}

/// Largest step that the scene allows any method, s; infinite where it does not say.
fn bound(solver: &Solver) -> f64 {
    solver.max_step.unwrap_or(f64::INFINITY)
}

/// Largest step of error control, s.
fn largest_step(model: &Model, solver: &Solver) -> f64 {
    solver.max_step.unwrap_or_else(|| match model.rolls() {
        true => MAX_STEP,
        false => (LARGEST_SHARE / model.contact_frequency()).min(MAX_STEP),
    })
}

/// First step of error control, s.
fn first_step(model: &Model, solver: &Solver) -> f64 {
    (FIRST_STEP / model.highest_frequency()).min(MAX_NOMINAL_STEP).min(largest_step(model, solver))
}

/// Rollers between raceways vibrate most of the time and make the motion chaotic within milliseconds, so their statistics
/// are what can be had at little cost; everything else is smooth between contacts.
fn aim(model: &Model, solver: &Solver, tuning: Tuning) -> Aim {
    let asked = solver.method.tolerance();
    let Numbers { statistics, leapfrog_step, auto_tolerance, watched_energy, .. } = numbers(solver.preset);
    let statistics = statistics && model.rolls() && asked.is_none();
    let units = model.state_scales();
    Aim {
        statistics,
        expected: Expectation {
            frequency: model.highest_frequency(),
            damped: model.damped(),
            share: leapfrog_step,
            careful_share: leapfrog_step.min(CAREFUL_STEP),
            largest_step: MAX_NOMINAL_STEP.min(bound(solver)),
        },
        units,
        tolerance: asked.unwrap_or(auto_tolerance),
        missing_energy: watched_energy,
        first_step: first_step(model, solver),
        tuning,
    }
}

/// Name of a method, as in scenes.
pub(super) fn name(kind: Kind) -> &'static str {
    match kind {
        Kind::Leapfrog => "leapfrog",
        Kind::DormandPrince => "dormand_prince",
        Kind::Rosenbrock => "rosenbrock",
        Kind::Radau => "radau",
    }
}

/// What was chosen and why, in words.
pub(super) fn describe(choice: &Choice) -> String {
    let step = format!("leapfrog with steps of {:.3e} s", choice.leapfrog_step);
    let mut text = match choice.method {
        Kind::Leapfrog => step.clone(),
        other => name(other).to_owned(),
    };
    text += match choice.reason {
        Reason::Vibration => ": the rolling elements vibrate, and statistics of that cost least this way",
        Reason::Trajectory => ": errors are controlled",
        Reason::Speed => ": errors are controlled, and it advances further per force evaluation",
        Reason::Trial => {
            ": errors are controlled, and it is tried whether it advances further per force evaluation"
        }
        Reason::Failures => ": attempts of the method before failed",
        Reason::Balance if choice.method == Kind::Leapfrog => ": longer ones missed too much of the energy",
        Reason::Balance => ": the leapfrog missed too much of the energy",
        Reason::Affordable => ": errors are controlled, which costs little while nothing vibrates",
        Reason::Cost => ": the leapfrog would need steps that cost as much as error control",
    };
    if choice.lead > 0.0 && choice.method != Kind::Leapfrog {
        text += &format!(" ({:.2} times as far as the other method)", choice.lead);
    }
    if choice.highest_frequency > 0.0 {
        text += &format!("; highest frequency {:.3e} rad/s", choice.highest_frequency);
    }
    let steps = choice.steps;
    text + &format!(
        "; {} steps by leapfrog, {} by dormand_prince, {} by rosenbrock, {} by radau, {} changes",
        steps[0], steps[1], steps[2], steps[3], choice.changes
    )
}
