//! Steady whirl of a cage without time stepping: its place, its speed and its stability from averaged equations.
//!
//! Elements of prescribed motion pass the moving contact of a whirling cage much faster than it or its pockets can answer, so their
//! train counts as its mean. Without gravity the averaged cage is autonomous in its own axes, and a circular whirl is a state at
//! rest there: a Newton step finds it in a millisecond, eigenvalues tell whether it is stable, and continuation follows it over
//! speed, temperature, clearance, stiffness, or any other number of the scene. Every function takes [`RunLimits`], by which another
//! thread can stop it, a wall time ends it, and its progress can be seen.
//!
//! ```no_run
//! fn main() -> cagedyn::Result<()> {
//!     let text = std::fs::read_to_string("scenes/grease_guide.json").unwrap_or_default();
//!     let whirl = cagedyn::whirl::steady(&cagedyn::Scene::from_json(&text)?, None, &Default::default())?;
//!     println!("{} rad/s at {} m, stable: {}", whirl.speed, whirl.eccentricity, whirl.stable());
//!     Ok(())
//! }
//! ```

mod averaged;
mod branch;
mod exact;
mod onset;
mod orbit;
mod search;
mod start;

pub use branch::{Branch, End, Point, follow};
pub use exact::Exact;
pub use onset::{Onset, onset};
pub use orbit::{Orbit, orbit};

use crate::error::{Error, Result, Status};
use crate::scalar::math;
use crate::scene::Scene;
use crate::sim::RunLimits;
use averaged::{Averaged, Unknowns};
use nalgebra::{DMatrix, DVector};

/// Newton steps, the largest change of an unknown in one in units of its scale, and the change at which they end.
const MOST_STEPS: usize = 40;
const LARGEST_STEP: f64 = 3.0;
const CONVERGED: f64 = 1e-9;
/// A step is halved, so many times at most, unless the residual falls by this share of what it should, or the step is shorter than this.
const MOST_HALVINGS: usize = 6;
const FALL: f64 = 1e-2;
const CLOSE: f64 = 1e-6;
/// Step of differences in units of the scales.
const DIFFERENCE: f64 = 1e-4;

/// A steady whirl.
#[derive(Clone, Debug, PartialEq)]
pub struct Whirl {
    /// Speed of the cage centre about that of the guide, rad/s; negative clockwise.
    pub speed: f64,
    /// Distance of both, m.
    pub eccentricity: f64,
    /// Angle by which elements are ahead of their pockets, rad.
    pub lead: f64,
    /// Amplitudes of the waves of an elastic cage from order 2 on, m.
    pub amplitudes: Vec<f64>,
    /// Rates of growth and frequencies of small disturbances, seen from axes that go round with the whirl, 1/s and rad/s; one of them is zero, that of
    /// its phase, and left out. The largest rate comes first.
    pub eigenvalues: Vec<[f64; 2]>,
    /// Number of wet arcs of a film that does not fill the guide; 1 for one that does, 0 where there is none.
    pub arcs: u32,
    /// Newton steps.
    pub steps: usize,
    /// What was solved for, to start from next to it.
    unknowns: Vec<f64>,
}

impl Whirl {
    /// Cosine and sine coefficients of the waves from order 2 on, seen from the direction of the place, m.
    pub fn waves(&self) -> &[f64] {
        self.unknowns.get(3..).unwrap_or_default()
    }

    /// Whether every small disturbance decays.
    pub fn stable(&self) -> bool {
        self.eigenvalues.first().is_none_or(|[rate, _]| *rate < 0.0)
    }
}

/// The steady whirl of a scene without its gravity, near `guess`, or, of several, a stable one.
///
/// Without a guess the search begins at a closed estimate, or with a short run from the start of the scene. Where that leads to rest or
/// nowhere, all whirls of a rigid cage are looked for; an elastic one is then started as the rigid one whirls, or with fewer waves.
///
/// # Errors
/// [`Status::BadScene`] for a scene of free rollers, with unbalance or without a guide; [`Status::BadState`] where there is no whirl, or none
/// was found, as the message says; [`Status::Cancelled`] and [`Status::OutOfTime`].
pub fn steady(scene: &Scene, guess: Option<&Whirl>, limits: &RunLimits) -> Result<Whirl> {
    limits.searching(|| {
        let mut averaged = Averaged::new(scene, limits)?;
        let whirl = match guess {
            Some(whirl) => solve(&mut averaged, whirl.unknowns.clone()),
            None => find(scene, &mut averaged),
        }?;
        limits.tell(1.0, 1);
        Ok(whirl)
    })
}

/// All steady whirls of a rigid cage without the gravity of its scene, those that are stable first, then by their speed. Empty where it
/// can only rest.
///
/// # Errors
/// [`Status::BadScene`] for an elastic cage, and as [`steady`]; [`Status::Cancelled`] and [`Status::OutOfTime`].
pub fn all(scene: &Scene, limits: &RunLimits) -> Result<Vec<Whirl>> {
    if scene.cage.as_ref().is_some_and(|cage| cage.elastic_ring.is_some()) {
        let text = "cage.elastic_ring: all whirls are looked for of rigid cages only";
        return Err(Error::new(Status::BadScene, text.to_owned()));
    }
    limits.searching(|| {
        let whirls = search::search(&mut Averaged::new(scene, limits)?, true)?.whirls;
        limits.tell(1.0, whirls.len());
        Ok(whirls)
    })
}

/// A steady whirl, from where a search begins by itself.
fn find(scene: &Scene, averaged: &mut Averaged) -> Result<Whirl> {
    let guess = start::guess(scene, averaged);
    let begun = guess.is_ok();
    let error = match guess.and_then(|first| solve(averaged, first)) {
        Err(e) if !e.is_stop() => e,
        found => return found,
    };
    if scene.cage.as_ref().is_none_or(|cage| cage.elastic_ring.is_none()) {
        let found = search::search(averaged, false)?;
        let none = || Error::new(Status::BadState, found.in_words());
        return found.whirls.first().cloned().ok_or_else(none);
    }
    // One that comes to no steady whirl by itself may whirl near where one of fewer waves does; one that rests needs a push.
    type Try = fn(&Scene, &mut Averaged) -> Result<Whirl>;
    let mut tries: [Try; 2] = [with_fewer_waves, pushed];
    if !begun {
        tries.reverse();
    }
    for attempt in tries {
        match attempt(scene, averaged) {
            Err(e) if !e.is_stop() => {}
            found => return found,
        }
    }
    Err(error)
}

/// The whirl next to that of a cage with one wave less.
fn with_fewer_waves(scene: &Scene, averaged: &mut Averaged) -> Result<Whirl> {
    let stiffer = start::with_fewer_waves(scene)
        .ok_or_else(|| Error::new(Status::BadState, "there are no waves to leave out".to_owned()))?;
    let mut near = find(&stiffer, &mut Averaged::new(&stiffer, averaged.limits())?)?;
    near.unknowns.extend([0.0; 2]);
    solve(averaged, near.unknowns)
}

/// The whirl that an elastic cage comes to which starts as a rigid one whirls.
fn pushed(scene: &Scene, averaged: &mut Averaged) -> Result<Whirl> {
    let rigid = start::rigid(scene);
    let whirl = find(&rigid, &mut Averaged::new(&rigid, averaged.limits())?)?;
    let first = start::run(&start::with_start(scene, &whirl, averaged.orbit()), averaged)?;
    let first = averaged.pack(&first);
    solve(averaged, first)
}

/// The exact whirl next to the averaged one of a scene without its gravity: periodic over the passing of one element.
///
/// # Errors
/// As [`steady`].
pub fn exact(scene: &Scene, near: &Whirl, limits: &RunLimits) -> Result<Exact> {
    limits.searching(|| {
        let mut averaged = Averaged::new(scene, limits)?;
        averaged.set_passing(near.speed);
        exact::exact(&mut averaged, near)
    })
}

/// Newton's method from these unknowns.
fn solve(averaged: &mut Averaged, first: Vec<f64>) -> Result<Whirl> {
    let scales = averaged.scales();
    let mut u = DVector::from_vec(first);
    for steps in 1..=MOST_STEPS {
        let (residual, matrix) = linearized(averaged, &u, &scales)?;
        let Some(step) = matrix.lu().solve(&residual) else { break };
        let largest = step.amax();
        if !largest.is_finite() {
            break;
        }
        let mut share = (LARGEST_STEP / largest).min(1.0);
        let from = u.clone();
        for halvings in 0..=MOST_HALVINGS {
            for (((u, from), step), scale) in u.iter_mut().zip(&from).zip(&step).zip(&scales) {
                *u = from - share * step * scale;
            }
            let falls = averaged
                .residual(u.as_slice())
                .is_ok_and(|there| DVector::from_vec(there).norm() < residual.norm() * (1.0 - FALL * share));
            if falls || largest < CLOSE || halvings == MOST_HALVINGS {
                break;
            }
            share *= 0.5;
        }
        if largest < CONVERGED {
            return if averaged.rests(u.as_slice()) {
                Err(rest(averaged, &u))
            } else {
                whirl(averaged, &u, steps)
            };
        }
    }
    let text = format!(
        "no steady whirl found: Newton's method ended at {:.1} rad/s and {:.3e} m",
        averaged.speed(u.as_slice()),
        averaged.eccentricity(u.as_slice())
    );
    Err(Error::new(Status::BadState, text))
}

/// A cage that rests is a solution, too, but no whirl.
fn rest(averaged: &Averaged, u: &DVector<f64>) -> Error {
    let text = format!(
        "no steady whirl found: Newton's method came to rest, at {:.3e} m from the centre",
        averaged.eccentricity(u.as_slice())
    );
    Error::new(Status::BadState, text)
}

/// Residual at these unknowns, and its derivatives over them in units of their scales.
fn linearized(
    averaged: &mut Averaged,
    u: &DVector<f64>,
    scales: &[f64],
) -> Result<(DVector<f64>, DMatrix<f64>)> {
    let n = u.len();
    let residual = DVector::from_vec(averaged.residual(u.as_slice())?);
    let mut matrix = DMatrix::zeros(n, n);
    let mut moved = u.clone();
    for k in 0..n {
        let h = DIFFERENCE * scales[k];
        let mut at = |by: f64| {
            moved[k] = u[k] + by;
            let found = averaged.residual(moved.as_slice());
            moved[k] = u[k];
            found.map(DVector::from_vec)
        };
        let column = (at(h)? - at(-h)?) / (2.0 * DIFFERENCE);
        matrix.set_column(k, &column);
    }
    Ok((residual, matrix))
}

/// What is known of the whirl at a solution.
fn whirl(averaged: &mut Averaged, u: &DVector<f64>, steps: usize) -> Result<Whirl> {
    let Unknowns { eccentricity, speed, lead, waves } = averaged.unknowns(u.as_slice());
    let amplitudes = waves.chunks(2).map(|pair| math::hypot(pair[0], pair[1])).collect();
    let slopes = averaged.slopes(u.as_slice())?;
    let mut eigenvalues: Vec<[f64; 2]> =
        slopes.complex_eigenvalues().iter().map(|value| [value.re, value.im]).collect();
    // The phase of the whirl is arbitrary: the eigenvalue nearest to zero is that of it.
    let size = |value: &[f64; 2]| math::hypot(value[0], value[1]);
    eigenvalues.sort_by(|a, b| size(a).total_cmp(&size(b)));
    let mut eigenvalues = eigenvalues.split_off(1.min(eigenvalues.len()));
    eigenvalues.sort_by(|a, b| b[0].total_cmp(&a[0]).then(b[1].total_cmp(&a[1])));
    Ok(Whirl {
        speed,
        eccentricity,
        lead,
        amplitudes,
        eigenvalues,
        arcs: averaged.arcs(u.as_slice())?,
        steps,
        unknowns: u.as_slice().to_vec(),
    })
}

#[cfg(test)]
mod settled_tests;
#[cfg(test)]
mod tests;
