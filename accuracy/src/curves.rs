//! What a comparison finds: one curve of errors and times per solver.

use crate::solvers::{Solver, Way};

/// One run, or the mean of several, of a solver at a setting.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Point {
    /// Tolerance or step; nothing where there is no choice.
    pub setting: Option<f64>,
    /// Error, in the unit of the comparison.
    pub error: f64,
    /// Wall time of a run, s.
    pub seconds: f64,
    /// Evaluations of the forces in a run.
    pub evaluations: u64,
}

/// All runs of a solver.
pub struct Curve {
    /// The solver.
    pub solver: Solver,
    /// In the order of the settings.
    pub points: Vec<Point>,
    /// Settings at which it gave up, and why.
    pub failures: Vec<(Option<f64>, String)>,
}

/// One comparison.
pub struct Comparison {
    /// Name for files and markers.
    pub name: &'static str,
    /// Title.
    pub title: &'static str,
    /// Name and unit of the error.
    pub error: &'static str,
    /// What the reference is and how far it can be trusted.
    pub reference: String,
    /// Errors up to this are noise: sampling noise, or the doubt about the reference.
    pub noise: f64,
    /// Errors at which times are compared.
    pub targets: Vec<f64>,
    /// Simulated time of a run, s.
    pub simulated: f64,
    /// One per solver.
    pub curves: Vec<Curve>,
}

/// Tolerances from `10^-from` to `10^-to`, two per power of ten.
pub fn tolerances(from: i32, to: i32) -> Vec<f64> {
    (2 * from..=2 * to).map(|k| 10f64.powf(-0.5 * f64::from(k))).collect()
}

/// The settings of a solver among those for steps and those for tolerances.
pub fn settings(solver: &Solver, steps: &[f64], tolerances: &[f64]) -> Vec<Option<f64>> {
    let list = match solver.way {
        Way::Preset(_) => return vec![None],
        Way::Leapfrog => steps,
        _ => tolerances,
    };
    list.iter().copied().map(Some).collect()
}

impl Curve {
    /// Runs a solver at all these settings; `run` gives error, wall time (s) and evaluations.
    pub fn trace(
        solver: Solver,
        settings: Vec<Option<f64>>,
        mut run: impl FnMut(&Solver, f64) -> Result<(f64, f64, u64), String>,
    ) -> Self {
        let mut curve = Self { solver, points: Vec::new(), failures: Vec::new() };
        for setting in settings {
            match run(&solver, setting.unwrap_or_default()) {
                Ok((error, seconds, evaluations)) if error.is_finite() => {
                    curve.points.push(Point { setting, error, seconds, evaluations });
                }
                Ok(_) => curve.failures.push((setting, "states that are not finite".to_owned())),
                Err(why) => curve.failures.push((setting, why)),
            }
        }
        curve
    }

    /// Wall time at which an error is reached, s: the fastest run without a larger one, or between two neighbours on
    /// the curve where that is faster.
    pub fn seconds_at(&self, error: f64) -> Option<f64> {
        let reached = self.points.iter().filter(|p| p.error <= error).map(|p| p.seconds);
        let between = self.points.windows(2).filter_map(|pair| {
            let [a, b] = [pair[0], pair[1]].map(|p| (p.error.ln(), p.seconds.ln()));
            let share = (error.ln() - a.0) / (b.0 - a.0);
            (0.0..=1.0).contains(&share).then(|| (a.1 + share * (b.1 - a.1)).exp())
        });
        reached.chain(between).reduce(f64::min)
    }
}

impl Comparison {
    /// The library's solver that reaches an error first, with its time in s.
    pub fn best_of_ours(&self, error: f64) -> Option<(&Curve, f64)> {
        let ours = self.curves.iter().filter(|curve| curve.solver.ours());
        let times = ours.filter_map(|curve| Some((curve, curve.seconds_at(error)?)));
        times.min_by(|a, b| a.1.total_cmp(&b.1))
    }

    /// The curve of a solver.
    pub fn curve(&self, name: &str) -> Option<&Curve> {
        self.curves.iter().find(|curve| curve.solver.name == name)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::solvers::SOLVERS;

    #[test]
    fn times_at_an_error_lie_on_the_curve() {
        let point = |error, seconds| Point { setting: None, error, seconds, evaluations: 0 };
        let points = vec![point(1e-2, 1.0), point(1e-4, 100.0), point(1e-6, 50.0)];
        let curve = Curve { solver: SOLVERS[0], points, failures: Vec::new() };
        assert_eq!(curve.seconds_at(1.0), Some(1.0));
        assert!((curve.seconds_at(1e-3).unwrap() - 10.0).abs() < 1e-9, "half way in logarithms");
        assert_eq!(curve.seconds_at(1e-5), Some(50.0), "the fastest run without a larger error");
        assert_eq!(curve.seconds_at(1e-7), None);
    }

    #[test]
    fn tolerances_come_in_half_powers_of_ten() {
        let list = tolerances(3, 4);
        assert_eq!(list.len(), 3);
        assert!((list[1] / 10f64.powf(-3.5) - 1.0).abs() < 1e-12);
    }
}
