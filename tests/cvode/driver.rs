//! CVODE itself on systems with known solutions.

use crate::common::example;
use cagedyn::{Model, Sim};
use cagedyn_studies::cvode::{self, Derivatives, Function, Method, Newton, Options};
use nalgebra::{SMatrix, SVector};
use std::sync::Arc;

/// Solves with the matrix of the system below.
struct Known {
    matrix: SMatrix<f64, 3, 3>,
    calls: u32,
}

impl Newton for Known {
    fn prepare(&mut self, _: f64, _: &[f64], gamma: f64, _: bool) -> Result<(), ()> {
        let slopes = SMatrix::<f64, 3, 3>::new(0.0, 1.0, 0.0, -1.0, 0.0, 0.0, 1e4, 0.0, -1e4);
        self.matrix = (SMatrix::identity() - slopes * gamma).try_inverse().ok_or(())?;
        self.calls += 1;
        Ok(())
    }

    fn solve(&mut self, x: &mut [f64]) -> Result<(), ()> {
        let solution = self.matrix * SVector::<f64, 3>::from_column_slice(x);
        x.copy_from_slice(solution.as_slice());
        Ok(())
    }
}

#[test]
fn cvode_solves_what_is_known_and_reports_what_fails() {
    // x'' = -x from x = 1, and y' = -1e4 (y - x).
    let mut calls = 0;
    let methods =
        [(Method::Bdf, "none"), (Method::Bdf, "dense"), (Method::Bdf, "own"), (Method::Adams, "none")];
    let bound = 1e-7;
    for (method, matrix) in methods {
        let options = Options {
            method,
            relative: 1e-10,
            absolute: &[1e-10; 3],
            max_steps: 1_000_000,
            max_step: f64::INFINITY,
        };
        // Steps far too long at first, so that failed evaluations are met and overcome.
        let mut rates = |t: f64, s: &[f64], r: &mut [f64]| {
            assert!(t <= 2.0, "evaluated after the last time: {t}");
            r.copy_from_slice(&[s[1], -s[0], -1e4 * (s[2] - s[0])]);
            if s[0].abs() > 1.5 { Err(()) } else { Ok(()) }
        };
        let mut jacobian = |_: f64, _: &[f64], j: &mut [f64]| {
            calls += 1;
            j.copy_from_slice(&[0.0, -1.0, 1e4, 1.0, 0.0, 0.0, 0.0, 0.0, -1e4]);
            Ok(())
        };
        let mut newton = Known { matrix: SMatrix::zeros(), calls: 0 };
        let derivatives = match matrix {
            "dense" => Derivatives::Dense(&mut jacobian),
            "own" => Derivatives::Newton(&mut newton),
            _ => Derivatives::Quotients,
        };
        let times = [0.5, 1.0, 2.0];
        let solution =
            cvode::solve(&options, 0.0, &[1.0, 0.0, 1.0], &times, &mut rates, derivatives).unwrap();
        assert_eq!(newton.calls > 0, matrix == "own");
        for (t, state) in times.iter().zip(&solution.states) {
            let error = (state[0] - t.cos()).abs().max((state[1] + t.sin()).abs());
            assert!(error < bound, "{method:?} at {t}: {error:e}");
            assert!((state[2] - t.cos()).abs() < 2e-4, "{method:?} at {t}: {state:?}");
        }
        let statistics = solution.statistics;
        assert!(statistics.steps > 50 && statistics.evaluations > statistics.steps, "{statistics:?}");
        let few = Options { max_steps: 3, ..options };
        let error = cvode::solve(&few, 0.0, &[1.0, 0.0, 1.0], &times, &mut rates, Derivatives::Quotients)
            .unwrap_err();
        assert!(error.contains("CVODE error -1"), "{error}");
        let mut broken = |_: f64, _: &[f64], _: &mut [f64]| Err(());
        let error =
            cvode::solve(&options, 0.0, &[1.0, 0.0, 1.0], &times, &mut broken, Derivatives::Quotients)
                .unwrap_err();
        assert!(error.contains("CVODE error"), "{error}");
        let panics = std::panic::catch_unwind(|| {
            let mut panics = |_: f64, _: &[f64], _: &mut [f64]| -> Result<(), ()> {
                std::panic::resume_unwind(Box::new("on purpose"))
            };
            cvode::solve(&options, 0.0, &[1.0, 0.0, 1.0], &times, &mut panics, Derivatives::Quotients)
        });
        assert!(panics.is_err());
    }
    assert!(calls > 0);
}

/// A roller bearing through CVODE's dense solver, with difference quotients and with exact derivatives, and through the
/// structured solver of the library: one motion, and Newton's method at home in each.
#[test]
fn cvode_takes_the_structured_solver_of_the_library() {
    const DURATION: f64 = 1e-3;
    let model = Arc::new(Model::from_json(&example().to_string()).unwrap());
    let [mut rates_sim, mut slopes_sim, mut newton_sim] = [(); 3].map(|()| Sim::new(model.clone()).unwrap());
    let scales = model.state_scales();
    let absolute: Vec<f64> = scales.iter().map(|scale| 1e-7 * scale).collect();
    let start = rates_sim.state().to_vec();
    let options = Options {
        method: Method::Bdf,
        relative: 0.0,
        absolute: &absolute,
        max_steps: 1_000_000,
        max_step: 1e-5,
    };
    let mut rates = |t: f64, x: &[f64], rate: &mut [f64]| rates_sim.derivative(t, x, rate).map_err(|_| ());
    let mut slopes = |t: f64, x: &[f64], out: &mut [f64]| slopes_sim.jacobian(t, x, out).map_err(|_| ());
    let run = |rates: &mut Function<'_>, derivatives: Derivatives<'_, '_>| {
        let solution = cvode::solve(&options, 0.0, &start, &[DURATION], rates, derivatives).unwrap();
        (solution.states[0].clone(), solution.statistics)
    };
    let runs = [
        run(&mut rates, Derivatives::Quotients),
        run(&mut rates, Derivatives::Dense(&mut slopes)),
        run(&mut rates, Derivatives::Newton(&mut newton_sim)),
    ];
    let positions = model.layout().positions();
    for (name, (state, statistics)) in ["quotients", "dense", "structured"].iter().zip(&runs) {
        let differences = state.iter().zip(&runs[1].0).zip(&scales).take(positions);
        let largest = differences.map(|((a, b), scale)| (a - b).abs() / scale).fold(0.0, f64::max);
        println!("{name}: {largest:.1e} of the clearance, {statistics:?}");
        assert!(largest < 2e-5, "{name}: {largest:e}");
        assert!(50 * statistics.newton_failures < statistics.steps, "{name}: {statistics:?}");
    }
    // An iteration or two per step; quotients take one more for every state and derivative.
    let per_step = |statistics: &cvode::Statistics| statistics.evaluations as f64 / statistics.steps as f64;
    let [quotients, _, structured] = [0, 1, 2].map(|k| per_step(&runs[k].1));
    assert!(structured < 1.5 && quotients > 2.0, "{structured}, {quotients} evaluations per step");
}
