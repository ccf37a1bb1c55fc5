//! Exact derivatives of the accelerations against differences.

use crate::{DEEP, cages, driven, everything, free_ring, model, states};
use cagedyn::{Model, Sim};
use serde_json::json;
use std::sync::Arc;

/// Largest error of a column of the Jacobian against central differences of fourth order, over the largest entry of its rows in units
/// of the scales.
pub(crate) fn error(model: &Arc<Model>, spread: f64) -> f64 {
    error_of_steps(model, spread, &[1.0])
}

/// The same by differences over several steps, as shares of the usual one, of which the best counts: where contacts just touch, or a curvature jumps, a
/// step may be too long.
pub(crate) fn error_of_steps(model: &Arc<Model>, spread: f64, steps: &[f64]) -> f64 {
    let mut sim = Sim::new(model.clone()).unwrap();
    let scales = model.state_scales();
    let mut worst: f64 = 0.0;
    for state in states(&sim, 3, spread, 5) {
        let n = state.len();
        let mut exact = vec![0.0; n * n];
        sim.jacobian(0.0, &state, &mut exact).unwrap();
        let mut rate_at = |k: usize, x: f64| {
            let (mut moved, mut rate) = (state.clone(), vec![0.0; n]);
            moved[k] += x;
            sim.derivative(0.0, &moved, &mut rate).unwrap();
            rate
        };
        for k in 0..n {
            let h = 5e-5 * scales[k];
            let of_step = |part: &f64| {
                let h = part * h;
                let [a, b, c, d] = [-2.0, -1.0, 1.0, 2.0].map(|s| rate_at(k, s * h));
                let difference = |i: usize| (a[i] - d[i] + 8.0 * (c[i] - b[i])) / (12.0 * h);
                (0..n).map(difference).collect::<Vec<_>>()
            };
            let of_steps: Vec<Vec<f64>> = steps.iter().map(of_step).collect();
            for i in 0..n {
                let unit = scales[i] / scales[k];
                let row =
                    (0..n).map(|m| (exact[i + n * m] * scales[m] / scales[i]).abs()).fold(1.0, f64::max);
                let off_of = |of: &Vec<f64>| (exact[i + n * k] - of[i]).abs() / (unit * row);
                let off = of_steps.iter().map(off_of).fold(f64::INFINITY, f64::min);
                let difference = of_steps[0][i];
                if off > worst {
                    let names = model.state_infos();
                    println!("d {}' / d {}: {} {difference}", names[i].name, names[k].name, exact[i + n * k]);
                }
                worst = worst.max(off);
            }
        }
    }
    worst
}

#[test]
fn derivatives_are_those_of_the_accelerations() {
    for model in [everything(), driven()] {
        let off = error(&model, 0.3);
        assert!(off < 1e-6, "{off}");
    }
}

fn bends(model: &Model) -> bool {
    !model.ring_waves().is_empty()
}

#[test]
fn derivatives_with_a_cage() {
    for model in cages() {
        let off = error(&model, 0.1);
        // Differences of sums around a bent surface see their errors, derivatives are those of the exact integrals.
        assert!(off < if bends(&model) { 1e-4 } else { 1e-6 }, "{off}");
    }
}

/// With waves that turn, and a ring that is moved.
#[test]
fn rates_at_a_state_that_stands_still() {
    for model in [everything(), driven()].into_iter().chain(cages()) {
        let mut sim = Sim::new(model.clone()).unwrap();
        let scales = model.state_scales();
        for state in states(&sim, 3, 0.3, 6) {
            // Round-off of the sums around a bent surface over a short time would stand out.
            let h = if bends(&model) { 1e-6 } else { 1e-7 };
            let (t, n) = (2.3e-3, state.len());
            let mut exact = vec![0.0; n];
            sim.time_derivative(t, &state, &mut exact).unwrap();
            let mut rate_at = |s: f64| {
                let mut rate = vec![0.0; n];
                sim.derivative(t + s, &state, &mut rate).unwrap();
                rate
            };
            let [a, b, c, d] = [-2.0, -1.0, 1.0, 2.0].map(|s| rate_at(s * h));
            let differences = (0..n).map(|i| (a[i] - d[i] + 8.0 * (c[i] - b[i])) / (12.0 * h));
            let largest = exact.iter().zip(&scales).map(|(x, scale)| (x / scale).abs()).fold(0.0, f64::max);
            assert!(largest > 1.0);
            for ((exact, difference), scale) in exact.iter().zip(differences).zip(&scales) {
                assert!((exact - difference).abs() < 1e-6 * largest * scale, "{exact} {difference}");
            }
        }
    }
}

#[test]
fn derivatives_of_a_deep_groove_bearing() {
    let changes = [
        ("inner_ring.motion", free_ring([100.0, 0.0, -3000.0, 2.0, 1.0])),
        ("inner_ring.speed", json!({"constant": 300.0})),
        ("initial", json!({"inner_ring": "equilibrium"})),
    ];
    let off = error(&model(DEEP, &changes), 0.1);
    assert!(off < 1e-6, "{off}");
}
