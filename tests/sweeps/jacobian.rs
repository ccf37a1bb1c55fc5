//! Exact derivatives of the accelerations against differences of sixth order, in every combination of parts.

use crate::common::parts::{Parts, all, move_rings, roughen, scene};
use crate::common::{Random, example_text, example_with};
use cagedyn::integrate::Linearization;
use cagedyn::model::{HostInputs, Workspace};
use cagedyn::{Model, Sim, Status};
use serde_json::{Value, json};
use std::sync::Arc;

/// Steps of the differences as shares of the state scales; all must agree where the forces are smooth.
const STEPS: [f64; 3] = [7e-6, 4e-6, 2e-6];
/// Time in which the inputs change as much as the states by their scales, s.
const TIME_SCALE: f64 = 1e-4;
/// Agreement of the differences, and jump of a slope, that count as smooth; agreement of differences and derivatives.
const SMOOTH: f64 = 2e-8;
const TOLERANCE: f64 = 1e-7;

/// Rows: accelerations; columns: positions, velocities, time.
fn dense(model: &Model, slope: &Linearization<3>) -> Vec<Vec<f64>> {
    let structure = model.plane().unwrap().structure();
    let (nq, nv) = (model.layout().positions(), model.layout().velocities());
    let mut out = vec![vec![0.0; nq + nv + 1]; nv];
    for (row, rate) in out.iter_mut().zip(&slope.over_time) {
        row[nq + nv] = *rate;
    }
    let hub = || structure.hub.iter().copied().enumerate();
    for (first, columns, part) in [(0, nq, &slope.over_positions), (nq, nv, &slope.over_velocities)] {
        let mut put = |row: usize, column: usize, value: f64| {
            // Spins have no position.
            if column < columns {
                out[row][first + column] = value;
            } else {
                assert_eq!(value, 0.0);
            }
        };
        for (i, row) in hub() {
            for (k, column) in hub() {
                put(row, column, part.hub[(i, k)]);
            }
            for (j, places) in structure.spokes.iter().enumerate() {
                for (k, column) in places.iter().enumerate() {
                    put(row, *column, part.to_hub[(i, 3 * j + k)]);
                }
            }
        }
        for (j, places) in structure.spokes.iter().enumerate() {
            for (i, row) in places.iter().enumerate() {
                for (k, column) in places.iter().enumerate() {
                    put(*row, *column, part.own[(i, 3 * j + k)]);
                }
                for (k, column) in hub() {
                    put(*row, column, part.from_hub[(i, structure.hub.len() * j + k)]);
                }
            }
            for (other, values) in part.rim_of(j) {
                for (column, values) in structure.spokes[other].iter().zip(values) {
                    for (row, value) in places.iter().zip(values) {
                        put(*row, *column, *value);
                    }
                }
            }
        }
    }
    out
}

/// Column of the derivatives by differences: each slope, and how far it jumps at the state itself.
struct Difference {
    slope: Vec<f64>,
    jump: Vec<f64>,
}

/// Differences of sixth order with step `h`; the column after the last state is time. `None` where forces are
/// undefined.
///
/// On a kink every central difference gives the mean of both sides, and steps of all sizes agree. The jump tells: the
/// slope ahead less that behind is jump + h f'' + O(h^3), and three steps leave the jump, with an error of fifth order.
fn difference(model: &Model, t: f64, state: &[f64], column: usize, h: f64) -> Option<Difference> {
    let nq = model.layout().positions();
    let mut ws = Workspace::new(model.plane().unwrap());
    let mut at = |offset: f64| {
        let (mut moved, mut time) = (state.to_vec(), t);
        *moved.get_mut(column).unwrap_or(&mut time) += offset * h;
        let inputs = model.inputs_at(time, &HostInputs::default());
        let (q, v) = moved.split_at(nq);
        let mut a = vec![0.0; v.len()];
        model.plane().unwrap().accelerations(&inputs, q, v, &mut ws, &mut a).ok().map(|()| a)
    };
    let here = at(0.0)?;
    let zero = vec![0.0; here.len()];
    let mut out = Difference { slope: zero.clone(), jump: zero };
    for (offset, central, one_sided) in [(1.0, 45.0, 2.5), (2.0, -9.0, -2.0), (3.0, 1.0, 0.5)] {
        let (ahead, behind) = (at(offset)?, at(-offset)?);
        for i in 0..here.len() {
            out.slope[i] += central * (ahead[i] - behind[i]) / (60.0 * h);
            out.jump[i] += one_sided * (ahead[i] - 2.0 * here[i] + behind[i]) / (offset * h);
        }
    }
    Some(out)
}

/// Derivatives of the accelerations at one state.
fn linearization(model: &Model, t: f64, state: &[f64]) -> Linearization<3> {
    let (q, v) = state.split_at(model.layout().positions());
    let mut ws = Workspace::new(model.plane().unwrap());
    let mut a = vec![0.0; v.len()];
    model
        .plane()
        .unwrap()
        .accelerations(&model.inputs_at(t, &HostInputs::default()), q, v, &mut ws, &mut a)
        .unwrap();
    let mut slope = Linearization::new(&model.plane().unwrap().structure(), v.len());
    model.plane().unwrap().linearize(&mut ws, &model.input_rates_at(t, &HostInputs::default()), &mut slope);
    slope
}

/// Numbers of entries compared and skipped, and the worst error, at one state.
fn compare(model: &Model, t: f64, state: &[f64]) -> (usize, usize, f64, String) {
    let nq = model.layout().positions();
    let v = &state[nq..];
    let exact = dense(model, &linearization(model, t, state));
    let mut scales = model.state_scales();
    scales.push(TIME_SCALE);
    let sizes: Vec<f64> = exact
        .iter()
        .map(|row| row.iter().zip(&scales).map(|(x, s)| (x * s).abs()).fold(1e-300, f64::max))
        .collect();
    let (mut compared, mut skipped, mut worst, mut place) = (0, 0, 0.0, String::new());
    for column in 0..=state.len() {
        let found = STEPS.map(|share| difference(model, t, state, column, share * scales[column]));
        let [Some(coarse), Some(middle), Some(fine)] = found else {
            skipped += v.len();
            continue;
        };
        for row in 0..v.len() {
            let scale = sizes[row] / scales[column];
            let slope = fine.slope[row];
            let spread = (coarse.slope[row] - slope).abs().max((middle.slope[row] - slope).abs());
            if spread.max(fine.jump[row].abs()) > SMOOTH * scale {
                skipped += 1;
                continue;
            }
            compared += 1;
            let error = (exact[row][column] - slope).abs() / scale;
            if error.is_nan() || error > worst {
                worst = error;
                let infos = model.state_infos();
                place = format!(
                    "d({})'/d({}): {:e}, differences {:e}",
                    infos[nq + row].name,
                    infos.get(column).map_or("t", |info| &info.name),
                    exact[row][column],
                    slope
                );
            }
        }
    }
    (compared, skipped, worst, place)
}

/// Gives rollers and raceways of a scene with rollers one profile after the other, and now and then none.
fn add_profile(scene: &mut Value, i: usize) {
    if scene["rollers"].is_null() {
        return;
    }
    let logarithm = |share: f64| json!({"logarithmic": {"design_load": 10880.0, "crowned_share": share, "end_drop": 12e-6}});
    let kind = i % 5;
    match kind {
        0 => scene["rollers"]["profile"] = logarithm(0.6),
        1 => scene["rollers"]["profile"] = json!({"circular_crown": {"radius": 5.2}}),
        2 => scene["rollers"]["profile"] = json!({"logarithmic": {"design_load": 9000.0}}),
        3 => scene["rollers"]["profile"] = logarithm(0.8),
        _ => return,
    }
    if kind == 1 || kind == 3 {
        scene["outer_ring"]["raceway_crown_radius"] = json!(12.0);
        scene["raceways"]["slices"] = json!(4);
    }
    if kind == 3 {
        scene["inner_ring"]["raceway_crown_radius"] = json!(7.0);
    }
}

#[test]
fn derivatives_match_differences_in_every_combination() {
    let (mut compared, mut skipped, mut largest, mut thickened) = (0, 0, 0.0f64, 0);
    for (i, parts) in all().into_iter().enumerate() {
        // Everything that can change with time does.
        let mut scene = scene(parts);
        add_profile(&mut scene, i);
        if parts.rollers && !parts.neighbours && i % 3 == 0 {
            let groups =
                [json!({"rollers": [1, 4], "deviation": 3e-6}), json!({"rollers": [0], "deviation": -2e-6})];
            scene["rollers"]["radius_deviations"] = json!({ "groups": groups });
        }
        let swing =
            |mean: f64| json!({"sine": {"mean": mean, "amplitude": 50.0, "frequency": 80.0, "phase": 0.3}});
        scene["inner_ring"]["speed"] = swing(-314.0);
        if i % 4 < 2 {
            scene["outer_ring"]["speed"] = swing(90.0);
        }
        if !parts.neighbours {
            scene["cage"]["load"] = json!({"force_y": swing(0.0), "torque": {"constant": 0.01}});
        }
        if parts.rollers {
            scene["inner_ring"]["motion"]["free"]["load"]["z"] = swing(-4900.0);
        }
        move_rings(&mut scene, parts, i);
        if roughen(&mut scene, parts, i) {
            // Its temperatures are solved to some 5e-8 of their slopes, which counts for more where waves let the friction of two
            // raceways nearly cancel.
            scene["raceways"]["contact"]["self_heating"] = Value::Null;
        }
        let warming = if i % 2 == 0 {
            let sine = json!({"mean": 330.0, "amplitude": 15.0, "frequency": 80.0, "phase": 0.7});
            json!({"over_time": {"sine": sine}})
        } else {
            json!({"over_speed": {"speed": [0.0, 200.0, 400.0], "temperature": [300.0, 315.0, 345.0]}})
        };
        scene["lubricant"]["viscosity"] = json!({"walther": {
            "cold": {"temperature": 313.15, "kinematic_viscosity": 105e-6},
            "hot": {"temperature": 373.15, "kinematic_viscosity": 12e-6},
            "density": 880.0, "temperature": warming
        }});
        let in_layer = !scene["cage"]["guide"]["film"]["lubricant_layer"].is_null();
        if in_layer && i % 3 > 0 {
            scene["lubricant"]["grease"] = match i % 3 {
                1 => json!({"soap": {"yield_stress": 300.0, "consistency": 20.0, "exponent": 0.4}}),
                _ => json!({"polymer": {"plateau": 0.3, "relaxation_time": 1e-4, "exponent": 0.6}}),
            };
            thickened += 1;
        }
        let model = Arc::new(Model::from_json(&scene.to_string()).unwrap());
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
    assert!(skipped < compared / 200, "{skipped} of {compared} skipped");
    assert!(thickened > 20, "{thickened}");
}

#[test]
fn all_instructions_give_the_same_derivatives() {
    let mut compared = 0;
    for (i, parts) in all().into_iter().enumerate() {
        let mut scene = scene(parts);
        add_profile(&mut scene, i);
        roughen(&mut scene, parts, i);
        let mut sim = Sim::new(Arc::new(Model::from_json(&scene.to_string()).unwrap())).unwrap();
        sim.advance_to(1.1e-3).unwrap();
        let (model, host) = (sim.model(), HostInputs::default());
        let (inputs, rates) = (model.inputs_at(sim.time(), &host), model.input_rates_at(sim.time(), &host));
        let (q, v) = sim.state().split_at(model.layout().positions());
        let [vector, plain] = [true, false].map(|vector| {
            let (mut ws, mut a) = (Workspace::new(model.plane().unwrap()), vec![0.0; v.len()]);
            ws.set_vector_instructions(vector);
            model.plane().unwrap().accelerations(&inputs, q, v, &mut ws, &mut a).unwrap();
            let mut slope = Linearization::new(&model.plane().unwrap().structure(), v.len());
            model.plane().unwrap().linearize(&mut ws, &rates, &mut slope);
            dense(model, &slope)
        });
        for (a, b) in vector.iter().flatten().zip(plain.iter().flatten()) {
            assert_eq!(a.to_bits(), b.to_bits(), "{parts:?}: {a} {b}");
            compared += usize::from(*a != 0.0);
        }
    }
    println!("{compared} derivatives that are not zero");
    assert!(compared > 10_000, "{compared}");
}

/// A state that the bearing of these parts reaches.
fn moving(parts: Parts) -> Sim {
    let model = Model::from_json(&scene(parts).to_string()).unwrap();
    let mut sim = Sim::new(Arc::new(model)).unwrap();
    sim.advance_to(1.1e-3).unwrap();
    sim
}

#[test]
fn the_jacobian_of_a_simulation_has_every_derivative_in_its_place() {
    for parts in all() {
        let mut sim = moving(parts);
        let model = sim.model().clone();
        let (t, state) = (sim.time(), sim.state().to_vec());
        let (n, nq) = (state.len(), model.layout().positions());
        let mut found = vec![f64::NAN; n * n];
        sim.jacobian(t, &state, &mut found).unwrap();
        let slope = linearization(&model, t, &state);
        let accelerations = dense(&model, &slope);
        for column in 0..n {
            for row in 0..n {
                let expected = match row.checked_sub(nq) {
                    Some(velocity) => accelerations[velocity][column],
                    None => f64::from(u8::from(column == nq + row)),
                };
                assert_eq!(found[column * n + row], expected, "{parts:?}: {row}, {column}");
            }
        }
    }
}

#[test]
fn the_jacobian_of_a_simulation_matches_differences_of_its_derivative() {
    // Free ring, rollers, film and solid contact of the guide, plane pockets, unbalance.
    let parts = Parts {
        rollers: true,
        guide: "mixed short bearing",
        inner_ring: false,
        pocket: "plane",
        unbalance: true,
        roundness: true,
        gravity: true,
        neighbours: false,
    };
    let mut sim = moving(parts);
    let (t, state) = (sim.time(), sim.state().to_vec());
    let scales = sim.model().state_scales();
    let n = state.len();
    let mut exact = vec![0.0; n * n];
    sim.jacobian(t, &state, &mut exact).unwrap();
    let mut slope = |column: usize, h: f64| {
        let mut at = |offset: f64| {
            let (mut moved, mut rate) = (state.clone(), vec![0.0; n]);
            moved[column] += offset * h;
            sim.derivative(t, &moved, &mut rate).unwrap();
            rate
        };
        let [up, down, up_2, down_2, up_3, down_3] = [1.0, -1.0, 2.0, -2.0, 3.0, -3.0].map(&mut at);
        let sum = |i: usize| 45.0 * (up[i] - down[i]) - 9.0 * (up_2[i] - down_2[i]) + (up_3[i] - down_3[i]);
        (0..n).map(|i| sum(i) / (60.0 * h)).collect::<Vec<f64>>()
    };
    let sizes: Vec<f64> = (0..n)
        .map(|row| (0..n).map(|k| (exact[k * n + row] * scales[k]).abs()).fold(0.0, f64::max))
        .collect();
    let (mut compared, mut largest) = (0, 0.0f64);
    for column in 0..n {
        let [coarse, middle, fine] = STEPS.map(|share| slope(column, share * scales[column]));
        for row in 0..n {
            let scale = sizes[row] / scales[column];
            let spread = (coarse[row] - fine[row]).abs().max((middle[row] - fine[row]).abs());
            if spread <= SMOOTH * scale {
                compared += 1;
                largest = largest.max((exact[column * n + row] - fine[row]).abs() / scale);
            }
        }
    }
    println!("{compared} of {} compared, largest error {largest:e}", n * n);
    assert!(largest < TOLERANCE, "{largest:e}");
    assert!(compared > n * n * 19 / 20, "{compared} of {}", n * n);
}

#[test]
fn there_is_a_jacobian_wherever_there_is_a_derivative() {
    let mut random = Random::new(5);
    let (mut found, mut refused) = (0, 0);
    for parts in all() {
        let mut sim = Sim::new(Arc::new(Model::from_json(&scene(parts).to_string()).unwrap())).unwrap();
        let start = sim.state().to_vec();
        let scales = sim.model().state_scales();
        let (mut rate, mut out) = (start.clone(), vec![0.0; start.len() * start.len()]);
        for _ in 0..5 {
            // What is at rest or in the centre, what is near, and what is anywhere.
            let near = |x: f64, h: f64, random: &mut Random| match random.index(2) {
                0 => 0.0,
                _ => x + h * random.around_zero(1.0),
            };
            let close: Vec<f64> = start.iter().zip(&scales).map(|(x, h)| near(*x, *h, &mut random)).collect();
            let far = start.iter().map(|x| x * 10f64.powf(random.within(-300.0, 12.0))).collect();
            for state in [close, far] {
                let derivative = sim.derivative(0.0, &state, &mut rate);
                let jacobian = sim.jacobian(0.0, &state, &mut out);
                assert_eq!(jacobian, derivative, "{parts:?}: {state:?}");
                assert!(out.iter().all(|x| x.is_finite()), "{parts:?}: {state:?}");
                found += usize::from(jacobian.is_ok());
                refused += usize::from(jacobian.is_err());
            }
        }
    }
    println!("{found} states with a Jacobian, {refused} without forces");
    assert!(found > 1000 && refused > 100, "{found}, {refused}");
}

fn refused(result: cagedyn::Result<()>, status: Status, text: &str) {
    let error = result.unwrap_err();
    assert_eq!(error.status, status, "{error}");
    assert!(error.message.contains(text), "{error}");
}

#[test]
fn a_jacobian_that_cannot_be_had_changes_nothing() {
    let mut sim = Sim::new(Arc::new(Model::from_json(&example_text()).unwrap())).unwrap();
    let (before, state) = (sim.statistics(), sim.state().to_vec());
    let n = state.len();
    let mut out = vec![7.0; n * n];
    let with = |i: usize, value: f64| {
        let mut state = state.clone();
        state[i] = value;
        state
    };
    let mut no_jacobian = |t: f64, state: &[f64], length: usize, status: Status, text: &str| {
        refused(sim.jacobian(t, state, &mut out[..length]), status, text);
    };
    no_jacobian(0.0, &state[1..], n * n, Status::WrongSize, "state");
    no_jacobian(0.0, &state, n, Status::WrongSize, "jacobian");
    no_jacobian(f64::NAN, &state, n * n, Status::BadValue, "t:");
    no_jacobian(0.0, &with(5, f64::NAN), n * n, Status::BadValue, "state[5]");
    no_jacobian(0.0, &with(2, 1e-3), n * n, Status::BadState, "film");
    assert!(out.iter().all(|x| *x == 7.0));
    assert_eq!(sim.statistics(), before);
}

/// Solutions put back into the dense matrix give the right-hand side again, for small and large `gamma`.
#[test]
fn newton_systems_are_solved_in_every_combination() {
    let mut random = Random::new(3);
    let mut largest = 0.0_f64;
    for parts in all() {
        let mut sim = moving(parts);
        let (t, state, scales) = (sim.time(), sim.state().to_vec(), sim.model().state_scales());
        let n = state.len();
        let mut jacobian = vec![0.0; n * n];
        sim.jacobian(t, &state, &mut jacobian).unwrap();
        sim.linearize(t, &state).unwrap();
        for gamma in [1e-9, 3e-7, 1e-6] {
            sim.factorize(gamma).unwrap_or_else(|e| panic!("{parts:?}: {e}"));
            let right: Vec<f64> = scales.iter().map(|scale| scale * random.around_zero(1.0)).collect();
            let mut x = right.clone();
            sim.solve(&mut x).unwrap();
            for row in 0..n {
                let products = (0..n).map(|column| gamma * jacobian[column * n + row] * x[column]);
                let size = products.clone().fold(x[row].abs().max(right[row].abs()), |m, p| m.max(p.abs()));
                let rest = (x[row] - products.sum::<f64>() - right[row]).abs() / size;
                assert!(rest < 1e-13, "{parts:?}, gamma {gamma:e}, row {row}: {rest:e}");
                largest = largest.max(rest);
            }
        }
    }
    println!("largest residual of a row relative to its largest term: {largest:.1e}");
}

#[test]
fn newton_systems_without_a_solution_are_refused() {
    let mut sim = Sim::new(Arc::new(Model::from_json(&example_text()).unwrap())).unwrap();
    let state = sim.state().to_vec();
    let mut x = vec![7.0; state.len()];
    refused(sim.factorize(1e-6), Status::BadState, "linearize comes first");
    refused(sim.solve(&mut x), Status::BadState, "factorize comes first");
    sim.linearize(0.0, &state).unwrap();
    refused(sim.solve(&mut x), Status::BadState, "factorize comes first");
    for gamma in [0.0, -1e-6, f64::NAN, f64::INFINITY, 1e-310] {
        refused(sim.factorize(gamma), Status::BadValue, "gamma");
    }
    sim.factorize(1e-6).unwrap();
    refused(sim.solve(&mut x[1..]), Status::WrongSize, "x:");
    x[3] = f64::NAN;
    refused(sim.solve(&mut x), Status::BadValue, "x[3]");
    x[3] = 7.0;
    let mut huge = vec![1e300; state.len()];
    refused(sim.solve(&mut huge), Status::BadState, "not finite");
    assert!(huge.iter().all(|x| *x == 1e300) && x.iter().all(|x| *x == 7.0));
    // What was there is gone after a failure.
    let mut far = state.clone();
    far[2] = 1e-3;
    refused(sim.linearize(0.0, &far), Status::BadState, "film");
    refused(sim.factorize(1e-6), Status::BadState, "linearize comes first");
    sim.linearize(0.0, &state).unwrap();
    sim.factorize(1e-6).unwrap();
    sim.solve(&mut x).unwrap();
    assert_eq!((sim.time(), sim.state()), (0.0, &state[..]));
}

#[test]
fn asking_for_jacobians_does_not_change_a_run() {
    for solver in ["leapfrog", "dormand_prince", "rosenbrock"] {
        let setting = if solver == "leapfrog" { json!({}) } else { json!({"tolerance": 1e-5}) };
        let scene = example_with(&[("solver", json!({"method": {solver: setting}}))]);
        let model = Arc::new(Model::from_json(&scene.to_string()).unwrap());
        let [mut alone, mut asked] = [0, 1].map(|_| Sim::new(model.clone()).unwrap());
        let start = asked.state().to_vec();
        let mut out = vec![0.0; start.len() * start.len()];
        for i in 1..=20 {
            alone.advance_to(5e-5 * f64::from(i)).unwrap();
            asked.advance_to(5e-5 * f64::from(i)).unwrap();
            asked.jacobian(0.3, &start, &mut out).unwrap();
            asked.linearize(0.3, &start).unwrap();
            asked.factorize(1e-6).unwrap();
            assert_eq!(alone.forces().unwrap(), asked.forces().unwrap());
        }
        assert_eq!(alone.state(), asked.state());
        assert_eq!(alone.statistics(), asked.statistics());
    }
}
