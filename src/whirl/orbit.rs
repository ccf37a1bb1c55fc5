//! The whirl of a rigid cage under gravity, as a limit cycle of the averaged equations in axes at rest.
//!
//! The averaged cage does not know the time, so its whirl under gravity closes after one turn. It is cut where the cage crosses the
//! horizontal axis: unknown are place, velocity, lead and speed there and the time of the turn, found by Newton's method on the map of
//! one turn (classical Runge-Kutta method) from the whirl without gravity, with gravity switched on in steps. Multipliers of that map tell
//! whether the whirl survives small disturbances. Towards low speed it ends where the cage leaves the layer at the top of its turn.

use super::averaged::Averaged;
use super::{Whirl, find};
use crate::error::{Error, Result, Status};
use crate::scalar::math;
use crate::scene::Scene;
use crate::sim::RunLimits;
use nalgebra::{DMatrix, DVector};
use std::f64::consts::TAU;

/// Longest step of a turn, s; Newton steps, and the change in units of the scales at which they end.
const STEP: f64 = 1e-5;
const MOST_STEPS: usize = 12;
const CONVERGED: f64 = 1e-6;
/// Shares of gravity on the way.
const SHARES: [f64; 1] = [1.0];
/// Scales of place m, velocity m/s, lead rad and speed rad/s, and of the time of a turn as a share of it.
const SCALES: [f64; 6] = [1e-6, 1e-6, 1e-2, 1e-2, 1e-5, 1e-1];
const TIME: f64 = 1e-2;
/// Step of differences in units of the scales.
const DIFFERENCE: f64 = 1e-2;

/// A whirl under gravity.
#[derive(Clone, Debug, PartialEq)]
pub struct Orbit {
    /// Mean whirl speed over a turn, rad/s.
    pub speed: f64,
    /// Least and largest magnitude of the whirl speed in a turn, rad/s, with the sign of its direction.
    pub range: [f64; 2],
    /// Least and largest eccentricity in a turn, m.
    pub eccentricity: [f64; 2],
    /// Largest magnitude of a multiplier of one turn but that along the orbit; the whirl is stable below one.
    pub multiplier: f64,
    /// Newton steps.
    pub steps: usize,
}

/// One turn from a state, and what is seen on the way.
struct Turn {
    end: DVector<f64>,
    range: [f64; 2],
    eccentricity: [f64; 2],
    wet: bool,
}

/// The whirl of a rigid cage under the gravity of its scene.
///
/// # Errors
/// [`Status::BadScene`] for an elastic cage; as [`super::steady`]; [`Status::BadState`] where there is no such orbit, with the reason.
pub fn orbit(scene: &Scene, limits: &RunLimits) -> Result<Orbit> {
    limits.searching(|| closed(scene, limits))
}

fn closed(scene: &Scene, limits: &RunLimits) -> Result<Orbit> {
    if scene.cage.as_ref().is_some_and(|cage| cage.elastic_ring.is_some()) {
        let text = "cage.elastic_ring: the orbit under gravity is found for rigid cages; run the scene for an elastic one";
        return Err(Error::new(Status::BadScene, text.to_owned()));
    }
    let mut averaged = Averaged::new(scene, limits)?;
    let start = find(scene, &mut averaged)?;
    let gravity = scene.gravity.map_or([0.0; 2], |g| [g.y, g.z]);
    // The cage begins on the horizontal axis; the time stands in the place of its height.
    let mut u = DVector::from_vec(averaged.averaged_at_rest(&start.unknowns));
    u[1] = TAU / start.speed.abs();
    let mut steps = 0;
    for share in SHARES {
        let pulled = gravity.map(|g| share * g);
        steps += close(&mut averaged, &mut u, pulled, &start)?;
    }
    let time = u[1];
    let mut x = u;
    x[1] = 0.0;
    let seen = turn(&mut averaged, &x, time, gravity)?;
    if !seen.wet {
        let text = format!(
            "no whirl under gravity: the cage leaves its layer at {:.1} rad/s, where it whirls slowest",
            start.speed.signum() * seen.range[0]
        );
        return Err(Error::new(Status::BadState, text));
    }
    Ok(Orbit {
        speed: start.speed.signum() * TAU / time,
        range: seen.range.map(|speed| start.speed.signum() * speed),
        eccentricity: seen.eccentricity,
        multiplier: multiplier(&mut averaged, &x, time, gravity)?,
        steps,
    })
}

/// Newton's method on the map of one turn; the number of its steps.
fn close(averaged: &mut Averaged, u: &mut DVector<f64>, gravity: [f64; 2], start: &Whirl) -> Result<usize> {
    let n = u.len();
    let mut scales = SCALES.to_vec();
    scales[1] = TIME * u[1];
    for steps in 1..=MOST_STEPS {
        let residual = |averaged: &mut Averaged, u: &DVector<f64>| -> Result<DVector<f64>> {
            let mut x = u.clone();
            x[1] = 0.0;
            Ok(turn(averaged, &x, u[1], gravity)?.end - x)
        };
        let here = residual(averaged, u)?;
        let mut matrix = DMatrix::zeros(n, n);
        for k in 0..n {
            let h = DIFFERENCE * scales[k];
            let mut moved = u.clone();
            moved[k] += h;
            matrix.set_column(k, &((residual(averaged, &moved)? - &here) / h));
        }
        let Some(step) = matrix.lu().solve(&here) else { break };
        let largest =
            step.iter().zip(&scales).fold(0.0f64, |largest, (step, scale)| largest.max((step / scale).abs()));
        if !largest.is_finite() {
            break;
        }
        *u -= &step;
        if largest < CONVERGED / DIFFERENCE {
            return Ok(steps);
        }
    }
    let text = format!("no whirl under gravity found near {:.1} rad/s", start.speed);
    Err(Error::new(Status::BadState, text))
}

/// Integrates over this time, s.
fn turn(averaged: &mut Averaged, x: &DVector<f64>, time: f64, gravity: [f64; 2]) -> Result<Turn> {
    let steps = (time / STEP).ceil().clamp(1.0, 1e5);
    let h = time / steps;
    let mut x = x.clone();
    let mut seen =
        Turn { end: x.clone(), range: [f64::INFINITY, 0.0], eccentricity: [f64::INFINITY, 0.0], wet: true };
    for _ in 0..steps as usize {
        let e = math::hypot(x[0], x[1]);
        let speed = ((x[0] * x[3] - x[1] * x[2]) / (e * e)).abs();
        seen.range = [seen.range[0].min(speed), seen.range[1].max(speed)];
        seen.eccentricity = [seen.eccentricity[0].min(e), seen.eccentricity[1].max(e)];
        seen.wet &= averaged.is_wet(&x);
        let a = averaged.rate_at_rest(&x, gravity)?;
        let b = averaged.rate_at_rest(&(&x + &a * (0.5 * h)), gravity)?;
        let c = averaged.rate_at_rest(&(&x + &b * (0.5 * h)), gravity)?;
        let d = averaged.rate_at_rest(&(&x + &c * h), gravity)?;
        x += (a + b * 2.0 + c * 2.0 + d) * (h / 6.0);
    }
    seen.end = x;
    Ok(seen)
}

/// Largest magnitude of the multipliers of a turn but that along the orbit.
fn multiplier(averaged: &mut Averaged, x: &DVector<f64>, time: f64, gravity: [f64; 2]) -> Result<f64> {
    let n = x.len();
    let here = turn(averaged, x, time, gravity)?.end;
    let mut matrix = DMatrix::zeros(n, n);
    for k in 0..n {
        let h = DIFFERENCE * SCALES[k];
        let mut moved = x.clone();
        moved[k] += h;
        matrix.set_column(k, &((turn(averaged, &moved, time, gravity)?.end - &here) / h));
    }
    let mut multipliers: Vec<[f64; 2]> =
        matrix.complex_eigenvalues().iter().map(|value| [value.re, value.im]).collect();
    multipliers.sort_by(|a, b| math::hypot(a[0] - 1.0, a[1]).total_cmp(&math::hypot(b[0] - 1.0, b[1])));
    Ok(multipliers.iter().skip(1).map(|value| math::hypot(value[0], value[1])).fold(0.0, f64::max))
}
