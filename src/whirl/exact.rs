//! The exact motion of a steady whirl among single elements: periodic over the passing of one element, seen from axes that turn.
//!
//! After the time tau in which one element passes the moving contact, the bearing is the one of the start, turned: by w_o tau - 2 pi/Z, as
//! elements and pockets are alike one place further. Fixed point of that map by Newton's method from the averaged whirl, with the classical
//! Runge-Kutta method in between; unknown are place and velocity on the axis, lead, speed, waves, and tau.

use super::averaged::Averaged;
use super::{Whirl, averaged};
use crate::error::{Error, Result, Status};
use crate::scalar::math;
use nalgebra::{DMatrix, DVector};

/// Steps of a passage, Newton steps at most, and the change in units of the scales at which they end.
const STEPS: usize = 300;
const MOST_STEPS: usize = 20;
const CONVERGED: f64 = 1e-8;

/// An exact steady whirl.
#[derive(Clone, Debug, PartialEq)]
pub struct Exact {
    /// Mean whirl speed, rad/s.
    pub speed: f64,
    /// Time in which one element passes, s.
    pub passage: f64,
    /// Largest rate of growth of small disturbances but that of the phase, 1/s.
    pub leading_rate: f64,
    /// Newton steps.
    pub steps: usize,
}

/// The exact whirl next to an averaged one of the same scene.
///
/// # Errors
/// [`Status::BadState`] where there is none near.
pub(super) fn exact(averaged: &mut Averaged, near: &Whirl) -> Result<Exact> {
    let start = averaged.at_rest(&near.unknowns);
    let orbit = averaged.orbit();
    let passage = averaged.pitch() / (near.speed - orbit).abs();
    // All but the second, which is zero on the axis, and the passage in its place.
    let mut u = DVector::from_vec(start);
    u[1] = passage;
    let n = u.len();
    let scales = averaged.motion_scales(passage);
    for steps in 1..=MOST_STEPS {
        let residual = |averaged: &mut Averaged, u: &DVector<f64>| -> Result<DVector<f64>> {
            let mut x = u.clone();
            x[1] = 0.0;
            let after = map(averaged, &x, u[1])?;
            Ok(after - x)
        };
        let here = residual(averaged, &u)?;
        let mut matrix = DMatrix::zeros(n, n);
        for k in 0..n {
            let h = averaged::DIFFERENCE_OF_MOTION * scales[k];
            let mut moved = u.clone();
            moved[k] += h;
            matrix.set_column(k, &((residual(averaged, &moved)? - &here) / h));
        }
        let Some(step) = matrix.lu().solve(&here) else { break };
        u -= &step;
        let largest =
            step.iter().zip(&scales).fold(0.0f64, |largest, (step, scale)| largest.max((step / scale).abs()));
        if !largest.is_finite() {
            break;
        }
        if largest < CONVERGED {
            let passage = u[1];
            u[1] = 0.0;
            let speed = orbit + (near.speed - orbit).signum() * averaged.pitch() / passage;
            return Ok(Exact { speed, passage, leading_rate: leading_rate(averaged, &u, passage)?, steps });
        }
    }
    let text = format!("no exact whirl found near {:.1} rad/s", near.speed);
    Err(Error::new(Status::BadState, text))
}

/// The state after a passage, turned back.
fn map(averaged: &mut Averaged, x: &DVector<f64>, passage: f64) -> Result<DVector<f64>> {
    let h = passage / STEPS as f64;
    let mut x = x.clone();
    for i in 0..STEPS {
        let t = h * i as f64;
        let a = averaged.full_rate(t, &x)?;
        let b = averaged.full_rate(t + 0.5 * h, &(&x + &a * (0.5 * h)))?;
        let c = averaged.full_rate(t + 0.5 * h, &(&x + &b * (0.5 * h)))?;
        let d = averaged.full_rate(t + h, &(&x + &c * h))?;
        x += (a + b * 2.0 + c * 2.0 + d) * (h / 6.0);
    }
    averaged.turn_back(&mut x, passage);
    Ok(x)
}

/// Largest rate of the multipliers of the map but that of its phase.
fn leading_rate(averaged: &mut Averaged, x: &DVector<f64>, passage: f64) -> Result<f64> {
    let n = x.len();
    let scales = averaged.motion_scales(0.0);
    let mut matrix = DMatrix::zeros(n, n);
    for k in 0..n {
        let h = averaged::DIFFERENCE_OF_MOTION * scales[k];
        let mut moved = x.clone();
        moved[k] += h;
        let high = map(averaged, &moved, passage)?;
        moved[k] -= 2.0 * h;
        let low = map(averaged, &moved, passage)?;
        matrix.set_column(k, &((high - low) / (2.0 * h)));
    }
    let mut multipliers: Vec<[f64; 2]> =
        matrix.complex_eigenvalues().iter().map(|value| [value.re, value.im]).collect();
    // That of the phase is one.
    multipliers.sort_by(|a, b| math::hypot(a[0] - 1.0, a[1]).total_cmp(&math::hypot(b[0] - 1.0, b[1])));
    let largest = multipliers.iter().skip(1).map(|value| math::hypot(value[0], value[1])).fold(0.0, f64::max);
    Ok(math::ln(largest) / passage)
}
