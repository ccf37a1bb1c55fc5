//! A branch of steady whirls over a number of the scene, followed around folds by its arc length.

use super::averaged::Averaged;
use super::{Whirl, linearized, solve, start, whirl};
use crate::error::{Error, Result, Status};
use crate::scene::Scene;
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
/// Step of differences over the parameter, as a share of the range.
const DIFFERENCE: f64 = 1e-5;

/// How a branch ends.
#[derive(Clone, Debug, PartialEq)]
pub enum End {
    /// At the end of the range.
    Range,
    /// After as many points as a branch may have.
    Length,
    /// Where a wet arc appears or vanishes: the force has an infinite slope there.
    Grazing,
    /// No whirl was found further on; the text says why.
    Lost(String),
}

impl End {
    /// Its name.
    pub fn name(&self) -> &'static str {
        match self {
            Self::Range => "range",
            Self::Length => "length",
            Self::Grazing => "grazing",
            Self::Lost(_) => "lost",
        }
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
/// [`Status::BadValue`] for a range of no length; as [`super::steady`] for its start. Later failures end the branch.
pub fn follow(
    scene: &Scene,
    [from, to]: [f64; 2],
    with: impl Fn(&Scene, f64) -> Result<Scene>,
    mut tell: impl FnMut(&Point),
) -> Result<Branch> {
    let range = to - from;
    if !range.is_finite() || range == 0.0 {
        return Err(Error::new(Status::BadValue, format!("range: from {from:?} to {to:?} there is no way")));
    }
    let at = |s: f64| Averaged::new(&with(scene, from + range * s)?);
    let first_scene = with(scene, from)?;
    let mut averaged = Averaged::new(&first_scene)?;
    let begin = start::guess(&first_scene, &averaged)?;
    let mut points =
        vec![Point { parameter: from, whirl: solve(&mut averaged, begin)?, fold: false, hopf: false }];
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
        if points.len() >= MOST_POINTS {
            break End::Length;
        }
        match advance(&at, &x, &tangent, step, &scales, &plain) {
            Ok((next, direction, corrections)) => {
                let s = next[n];
                let last = &points[points.len() - 1];
                let found = at(s).and_then(|mut averaged| {
                    whirl(&mut averaged, &DVector::from_vec(plain(&next)), corrections)
                });
                let found = match found {
                    Ok(found) => found,
                    Err(e) => break End::Lost(e.message),
                };
                let (grazes, crossed) =
                    (found.arcs != last.whirl.arcs, found.stable() != last.whirl.stable());
                let fold = direction[n] * tangent[n] < 0.0;
                let oscillates = found.eigenvalues.first().is_some_and(|[_, frequency]| *frequency != 0.0);
                let point =
                    Point { parameter: from + range * s, whirl: found, fold, hopf: crossed && oscillates };
                tell(&point);
                points.push(point);
                if grazes {
                    break End::Grazing;
                }
                if !(0.0..1.0 - SMALLEST_STEP).contains(&s) {
                    break End::Range;
                }
                (x, tangent) = (next, direction);
                if corrections <= FEW {
                    step = (step * GROWTH).min(LARGEST_STEP);
                }
                // The last point is the end of the range.
                if tangent[n] > 0.0 {
                    step = step.min(((1.0 - x[n]) / tangent[n]).max(SMALLEST_STEP));
                }
            }
            Err(e) => {
                step *= 0.5;
                if step < SMALLEST_STEP {
                    break End::Lost(e.message);
                }
            }
        }
    };
    Ok(Branch { points, end })
}

/// One step along the branch: predictor and corrector with the bordered system. Returns point, tangent and corrections.
fn advance(
    at: &impl Fn(f64) -> Result<Averaged>,
    x: &DVector<f64>,
    tangent: &DVector<f64>,
    step: f64,
    scales: &[f64],
    plain: &impl Fn(&DVector<f64>) -> Vec<f64>,
) -> Result<(DVector<f64>, DVector<f64>, usize)> {
    let n = scales.len();
    let mut y = x + tangent * step;
    for corrections in 1..=MOST_CORRECTIONS {
        let (bordered, residual) = bordered(at, &y, tangent, scales, plain)?;
        let mut right = DVector::zeros(n + 1);
        right.rows_mut(0, n).copy_from(&residual);
        right[n] = tangent.dot(&(&y - x)) - step;
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
    Err(Error::new(Status::BadState, "no steady whirl found further on".to_owned()))
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
