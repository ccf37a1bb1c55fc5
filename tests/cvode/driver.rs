//! CVODE itself on systems with known solutions.

use crate::cvode::{self, Method, Options};

#[test]
fn cvode_solves_what_is_known_and_reports_what_fails() {
    // x'' = -x from x = 1, and y' = -1e4 (y - x).
    let mut calls = 0;
    for (method, with_jacobian, bound) in
        [(Method::Bdf, false, 1e-7), (Method::Bdf, true, 1e-7), (Method::Adams, false, 1e-7)]
    {
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
        let jacobian: Option<&mut cvode::Function<'_>> =
            if with_jacobian { Some(&mut jacobian) } else { None };
        let times = [0.5, 1.0, 2.0];
        let solution = cvode::solve(&options, 0.0, &[1.0, 0.0, 1.0], &times, &mut rates, jacobian).unwrap();
        for (t, state) in times.iter().zip(&solution.states) {
            let error = (state[0] - t.cos()).abs().max((state[1] + t.sin()).abs());
            assert!(error < bound, "{method:?} at {t}: {error:e}");
            assert!((state[2] - t.cos()).abs() < 2e-4, "{method:?} at {t}: {state:?}");
        }
        let statistics = solution.statistics;
        assert!(statistics.steps > 50 && statistics.evaluations > statistics.steps, "{statistics:?}");
        let few = Options { max_steps: 3, ..options };
        let error = cvode::solve(&few, 0.0, &[1.0, 0.0, 1.0], &times, &mut rates, None).unwrap_err();
        assert!(error.contains("CVODE error -1"), "{error}");
        let mut broken = |_: f64, _: &[f64], _: &mut [f64]| Err(());
        let error = cvode::solve(&options, 0.0, &[1.0, 0.0, 1.0], &times, &mut broken, None).unwrap_err();
        assert!(error.contains("CVODE error"), "{error}");
        let panics = std::panic::catch_unwind(|| {
            let mut panics = |_: f64, _: &[f64], _: &mut [f64]| -> Result<(), ()> {
                std::panic::resume_unwind(Box::new("on purpose"))
            };
            cvode::solve(&options, 0.0, &[1.0, 0.0, 1.0], &times, &mut panics, None)
        });
        assert!(panics.is_err());
    }
    assert!(calls > 0);
}
