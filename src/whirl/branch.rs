//! A branch of steady whirls over a number of the scene, followed around folds by its arc length.

use super::averaged::Averaged;
use super::{Whirl, linearized, rest, whirl};
use crate::error::{Error, Result, Status};
use crate::scene::Scene;
use crate::sim::RunLimits;
use nalgebra::{DMatrix, DVector};

/// Points of a branch at most, its first step as a share of the range, the largest and the smallest.
const MOST_POINTS: usize = 400;
const FIRST_STEP: f64 = 0.02;
const LARGEST_STEP: f64 = 0.07;
const SMALLEST_STEP: f64 = 1e-4;
/// Steps of the corrector, after how few the next step grows, by how much, and the change at which it ends.
const MOST_CORRECTIONS: usize = 10;
const FEW: usize = 4;
const GROWTH: f64 = 1.5;
const CONVERGED: f64 = 1e-8;
/// How long unknowns count against the range of the parameter: changes by so many scales are a range.
const RANGE: f64 = 30.0;
/// How far beyond a lost whirl the search begins anew, as a share of the range.
const BEYOND: f64 = 0.02;
/// Step of differences over the parameter, as a share of the range.
const DIFFERENCE: f64 = 1e-5;

/// How a branch ends.
#[derive(Clone, Debug, PartialEq)]
pub enum End {
    /// At the end of the range.
    Range,
    /// After as many points as a branch may have.
    Length,
    /// No whirl was found further on; the text says why.
    Lost(String),
    /// Where a host ended it, on request or with its limit on the wall time.
    Stopped(Error),
}

impl End {
    /// Its name.
    pub fn name(&self) -> &'static str {
        match self {
            Self::Range => "range",
            Self::Length => "length",
            Self::Lost(_) => "lost",
            Self::Stopped(e) if e.status == Status::Cancelled => "cancelled",
            Self::Stopped(_) => "out of time",
        }
    }

    /// Why it ends there, where something failed.
    pub fn why(&self) -> Option<&str> {
        match self {
            Self::Range | Self::Length => None,
            Self::Lost(why) => Some(why),
            Self::Stopped(e) => Some(&e.message),
        }
    }

    /// Of a failure.
    fn of(e: Error) -> Self {
        if e.is_stop() { Self::Stopped(e) } else { Self::Lost(e.message) }
    }
}

/// A whirl of a branch.
#[derive(Clone, Debug, PartialEq)]
pub struct Point {
    /// The number that is varied.
    pub parameter: f64,
    /// The whirl there.
    pub whirl: Whirl,
    /// Whether the branch has turned back since the point before.
    pub fold: bool,
    /// Whether a pair of eigenvalues has crossed since the point before.
    pub hopf: bool,
    /// Whether a wet arc has appeared or vanished since the point before: the whirl is another one, and the branch between them is
    /// not known.
    pub grazed: bool,
}

/// A branch.
#[derive(Clone, Debug, PartialEq)]
pub struct Branch {
    /// Its points in order.
    pub points: Vec<Point>,
    /// How it ends.
    pub end: End,
}

/// Follows the steady whirl of a scene from one value of a number of it to another; `with` changes the scene.
///
/// # Errors
/// [`Status::BadValue`] for a range of no length; as [`super::steady`] for its start. Later failures, and limits, end the branch, which keeps
/// its points.
pub fn follow(
    scene: &Scene,
    range: [f64; 2],
    with: impl Fn(&Scene, f64) -> Result<Scene>,
    limits: &RunLimits,
    tell: impl FnMut(&Point),
) -> Result<Branch> {
    limits.searching(|| along(scene, range, with, limits, tell))
}

fn along(
    scene: &Scene,
    [from, to]: [f64; 2],
    with: impl Fn(&Scene, f64) -> Result<Scene>,
    limits: &RunLimits,
    mut tell: impl FnMut(&Point),
) -> Result<Branch> {
    let range = to - from;
    if !range.is_finite() || range == 0.0 {
        return Err(Error::new(Status::BadValue, format!("range: from {from:?} to {to:?} there is no way")));
    }
    let at = |s: f64| Averaged::new(&with(scene, from + range * s)?, limits);
    let first_scene = with(scene, from)?;
    let mut averaged = Averaged::new(&first_scene, limits)?;
    let mut points = vec![Point {
        parameter: from,
        whirl: super::find(&first_scene, &mut averaged)?,
        fold: false,
        hopf: false,
        grazed: false,
    }];
    tell(&points[0]);
    let scales = averaged.scales();
    let n = scales.len();
    // Unknowns in units that a range counts in, and the parameter as a share of the range behind them.
    let scaled = |u: &[f64], s: f64| {
        let shares = u.iter().zip(&scales).map(|(u, scale)| u / (RANGE * scale));
        DVector::from_iterator(n + 1, shares.chain([s]))
    };
    let plain = |x: &DVector<f64>| -> Vec<f64> { (0..n).map(|k| x[k] * RANGE * scales[k]).collect() };
    let mut x = scaled(&points[0].whirl.unknowns, 0.0);
    let mut tangent = DVector::zeros(n + 1);
    tangent[n] = 1.0;
    let mut step = FIRST_STEP;
    let end = loop {
        limits.tell(x[n], points.len());
        if points.len() >= MOST_POINTS {
            break End::Length;
        }
        // The last point is the end of the range.
        let last_step = tangent[n] > 0.0 && x[n] + tangent[n] * step > 1.0 - SMALLEST_STEP;
        match advance(&at, &x, &tangent, step, last_step, &scales, &plain) {
            Ok((next, direction, corrections)) => {
                let s = next[n];
                let last = &points[points.len() - 1];
                let found = at(s).and_then(|mut averaged| {
                    let u = DVector::from_vec(plain(&next));
                    if averaged.rests(u.as_slice()) {
                        return Err(rest(&averaged, &u));
                    }
                    whirl(&mut averaged, &u, corrections)
                });
                let found = match found {
                    Ok(found) => found,
                    Err(e) => break End::of(e),
                };
                let (grazed, crossed) =
                    (found.arcs != last.whirl.arcs, found.stable() != last.whirl.stable());
                let fold = direction[n] * tangent[n] < 0.0;
                let oscillates = found.eigenvalues.first().is_some_and(|[_, frequency]| *frequency != 0.0);
                let parameter = if (s - 1.0).abs() < CONVERGED { to } else { from + range * s };
                let hopf = crossed && oscillates && !grazed;
                let point = Point { parameter, whirl: found, fold: fold && !grazed, hopf, grazed };
                tell(&point);
                points.push(point);
                if !(0.0..1.0 - CONVERGED).contains(&s) {
                    break End::Range;
                }
                (x, tangent) = (next, direction);
                if grazed {
                    // On the other side another branch begins, in the direction of the range.
                    tangent.fill(0.0);
                    tangent[n] = 1.0;
                    step = FIRST_STEP;
                    continue;
                }
                if corrections <= FEW {
                    step = (step * GROWTH).min(LARGEST_STEP);
                }
            }
            Err(e) if e.is_stop() => break End::of(e),
            Err(e) => {
                step *= 0.5;
                if step < SMALLEST_STEP {
                    // Where an arc is about to appear or vanish, the search begins anew beyond it.
                    let beyond = x[n] + BEYOND;
                    let parameter = from + range * beyond;
                    let begun = || super::find(&with(scene, parameter)?, &mut at(beyond)?);
                    let whirl = match (beyond < 1.0).then(begun) {
                        Some(Ok(whirl)) => whirl,
                        Some(Err(stop)) if stop.is_stop() => break End::of(stop),
                        _ => break End::of(e),
                    };
                    let last = &points[points.len() - 1].whirl;
                    if last.arcs == whirl.arcs {
                        break End::Lost(e.message);
                    }
                    x = scaled(&whirl.unknowns, beyond);
                    tangent.fill(0.0);
                    tangent[n] = 1.0;
                    step = FIRST_STEP;
                    let point = Point { parameter, whirl, fold: false, hopf: false, grazed: true };
                    tell(&point);
                    points.push(point);
                }
            }
        }
    };
    if !matches!(end, End::Stopped(_)) {
        limits.tell(1.0, points.len());
    }
    Ok(Branch { points, end })
}

/// One step along the branch: predictor and corrector with the bordered system. Returns point, tangent and corrections.
fn advance(
    at: &impl Fn(f64) -> Result<Averaged>,
    x: &DVector<f64>,
    tangent: &DVector<f64>,
    step: f64,
    to_end: bool,
    scales: &[f64],
    plain: &impl Fn(&DVector<f64>) -> Vec<f64>,
) -> Result<(DVector<f64>, DVector<f64>, usize)> {
    let n = scales.len();
    let step = if to_end { (1.0 - x[n]) / tangent[n] } else { step };
    let mut y = x + tangent * step;
    // The last point is where the number ends, not where the arc length does.
    let along =
        if to_end { DVector::from_fn(n + 1, |k, _| if k == n { 1.0 } else { 0.0 }) } else { tangent.clone() };
    let wanted = if to_end { 1.0 - x[n] } else { step };
    let tangent = &along;
    for corrections in 1..=MOST_CORRECTIONS {
        let (bordered, residual) = bordered(at, &y, tangent, scales, plain)?;
        let mut right = DVector::zeros(n + 1);
        right.rows_mut(0, n).copy_from(&residual);
        right[n] = tangent.dot(&(&y - x)) - wanted;
        let lu = bordered.lu();
        let Some(change) = lu.solve(&right).filter(|change| change.amax().is_finite()) else { break };
        y -= &change;
        if change.amax() < CONVERGED {
            let mut ahead = DVector::zeros(n + 1);
            ahead[n] = 1.0;
            let Some(direction) = lu.solve(&ahead) else { break };
            return Ok((y, direction.normalize(), corrections));
        }
    }
    let text = format!(
        "no steady whirl found further on: Newton's method failed with a step of {:.1e} of the range",
        step.abs()
    );
    Err(Error::new(Status::BadState, text))
}

/// Derivatives of the residual over the scaled unknowns and the parameter, with the tangent as last row; the residual.
fn bordered(
    at: &impl Fn(f64) -> Result<Averaged>,
    y: &DVector<f64>,
    tangent: &DVector<f64>,
    scales: &[f64],
    plain: &impl Fn(&DVector<f64>) -> Vec<f64>,
) -> Result<(DMatrix<f64>, DVector<f64>)> {
    let n = scales.len();
    let u = plain(y);
    let (residual, matrix) = linearized(&mut at(y[n])?, &DVector::from_vec(u.clone()), scales)?;
    let mut bordered = DMatrix::zeros(n + 1, n + 1);
    bordered.view_mut((0, 0), (n, n)).copy_from(&(matrix * RANGE));
    let ahead = |s: f64| Ok::<_, Error>(DVector::from_vec(at(s)?.residual(&u)?));
    let slope = (ahead(y[n] + DIFFERENCE)? - ahead(y[n] - DIFFERENCE)?) / (2.0 * DIFFERENCE);
    bordered.view_mut((0, n), (n, 1)).copy_from(&slope);
    bordered.row_mut(n).copy_from(&tangent.transpose());
    Ok((bordered, residual))
}
