//! Exact derivatives of the accelerations against differences of sixth order, in every combination of parts.

mod common;

use cagedyn::model::{HostInputs, Jacobian, Workspace};
use cagedyn::{Model, Sim};
use common::parts::{all, scene};
use std::sync::Arc;

/// Steps of the differences as shares of the state scales; all must agree where the forces are smooth.
const STEPS: [f64; 3] = [7e-6, 4e-6, 2e-6];
/// Agreement of the differences that counts as smooth, and of differences and derivatives.
const SMOOTH: f64 = 2e-8;
const TOLERANCE: f64 = 1e-7;

/// Rows: accelerations; columns: positions, then velocities.
fn dense(model: &Model, jacobian: &Jacobian) -> Vec<Vec<f64>> {
    let layout = model.layout();
    let (nq, nv) = (layout.positions(), layout.velocities());
    let mut out = vec![vec![0.0; nq + nv]; nv];
    let hub: Vec<Option<usize>> = (0..5)
        .map(|k| if k < 2 { layout.ring.map(|i| i + k) } else { layout.cage.map(|i| i + k - 2) })
        .collect();
    for kind in 0..2 {
        for (i, row) in hub.iter().enumerate() {
            for (k, column) in hub.iter().enumerate() {
                if let (Some(row), Some(column)) = (row, column) {
                    out[*row][kind * nq + column] = jacobian.shared[kind][(i, k)];
                }
            }
        }
        for (j, roller) in jacobian.rollers.iter().enumerate() {
            let own = [layout.roller(j), layout.roller(j) + 1, layout.spin(j)];
            // Spin has no position: its column belongs to the velocities only.
            for (i, row) in own.iter().enumerate() {
                for (k, column) in own.iter().enumerate().take(if kind == 0 { 2 } else { 3 }) {
                    out[*row][kind * nq + column] = roller.own[kind][(i, k)];
                }
                for (k, column) in hub.iter().enumerate() {
                    if let Some(column) = column {
                        out[*row][kind * nq + column] = roller.from_shared[kind][(i, k)];
                    }
                }
            }
            for (i, row) in hub.iter().enumerate() {
                for (k, column) in own.iter().enumerate().take(if kind == 0 { 2 } else { 3 }) {
                    if let Some(row) = row {
                        out[*row][kind * nq + column] = roller.to_shared[kind][(i, k)];
                    }
                }
            }
        }
    }
    out
}

/// Column of the derivatives by a sixth-order difference with step `h`; `None` where forces are undefined.
fn difference(model: &Model, t: f64, state: &[f64], column: usize, h: f64) -> Option<Vec<f64>> {
    let nq = model.layout().positions();
    let inputs = model.inputs_at(t, &HostInputs::default());
    let mut ws = Workspace::new(model);
    let mut sum = vec![0.0; model.layout().velocities()];
    for (offset, weight) in [(1.0, 45.0), (2.0, -9.0), (3.0, 1.0)] {
        for side in [1.0, -1.0] {
            let mut moved = state.to_vec();
            moved[column] += side * offset * h;
            let (q, v) = moved.split_at(nq);
            let mut a = vec![0.0; sum.len()];
            model.accelerations(&inputs, q, v, &mut ws, &mut a).ok()?;
            for (sum, a) in sum.iter_mut().zip(a) {
                *sum += side * weight * a / (60.0 * h);
            }
        }
    }
    Some(sum)
}

/// Numbers of entries compared and skipped, and the worst error, at one state.
fn compare(model: &Model, t: f64, state: &[f64]) -> (usize, usize, f64, String) {
    let nq = model.layout().positions();
    let (q, v) = state.split_at(nq);
    let mut ws = Workspace::new(model);
    let mut a = vec![0.0; v.len()];
    model.accelerations(&model.inputs_at(t, &HostInputs::default()), q, v, &mut ws, &mut a).unwrap();
    let mut jacobian = Jacobian::default();
    model.jacobian(q, v, &ws, &mut jacobian);
    let exact = dense(model, &jacobian);
    let scales = model.state_scales();
    let sizes: Vec<f64> = exact
        .iter()
        .map(|row| row.iter().zip(&scales).map(|(x, s)| (x * s).abs()).fold(1e-300, f64::max))
        .collect();
    let (mut compared, mut skipped, mut worst, mut place) = (0, 0, 0.0, String::new());
    for column in 0..state.len() {
        let found = STEPS.map(|share| difference(model, t, state, column, share * scales[column]));
        let [Some(coarse), Some(middle), Some(fine)] = found else {
            skipped += v.len();
            continue;
        };
        for row in 0..v.len() {
            let scale = sizes[row] / scales[column];
            let spread = (coarse[row] - fine[row]).abs().max((middle[row] - fine[row]).abs());
            if spread > SMOOTH * scale {
                skipped += 1;
                continue;
            }
            compared += 1;
            let error = (exact[row][column] - fine[row]).abs() / scale;
            if error.is_nan() || error > worst {
                worst = error;
                let infos = model.state_infos();
                place = format!(
                    "d({})'/d({}): {:e}, differences {:e}",
                    infos[nq + row].name,
                    infos[column].name,
                    exact[row][column],
                    fine[row]
                );
            }
        }
    }
    (compared, skipped, worst, place)
}

#[test]
fn derivatives_match_differences_in_every_combination() {
    let (mut compared, mut skipped, mut largest) = (0, 0, 0.0f64);
    for (i, parts) in all().into_iter().enumerate() {
        let model = Arc::new(Model::from_json(&scene(parts).to_string()).unwrap());
        let mut sim = Sim::new(model.clone()).unwrap();
        for k in 1..=2 {
            sim.advance_to(1.1e-3 * f64::from(k) + 1e-5 * (i % 37) as f64).unwrap();
            let (n, missed, worst, place) = compare(&model, sim.time(), sim.state());
            assert!(worst < TOLERANCE, "{parts:?} at {} s: {worst:e} in {place}", sim.time());
            compared += n;
            skipped += missed;
            largest = largest.max(worst);
        }
    }
    println!("{compared} derivatives compared, {skipped} skipped at kinks, largest error {largest:e}");
    assert!(skipped < compared / 20, "{skipped} of {compared} skipped");
}
