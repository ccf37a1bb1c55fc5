//! What a host sets: states that a run goes on from, and inputs over time.

use crate::common::read;
use crate::started::{ACCURATE, CHOSEN, STIFF, bits, sim};
use cagedyn::{Model, Sim, Status};
use std::sync::Arc;

#[test]
fn a_state_set_by_the_host_is_where_the_run_goes_on() {
    let mut s = sim(&[]);
    s.advance_to(1e-3).unwrap();
    let state = s.state().to_vec();
    // The present state changes nothing.
    s.set_state(1e-3, &state).unwrap();
    assert_eq!(s.state(), state);
    s.advance_to(1.1e-3).unwrap();
    let mut moved = state.clone();
    moved[2] += 1e-6;
    s.set_state(5.0, &moved).unwrap();
    assert_eq!((s.time(), s.state()[2]), (5.0, moved[2]));
    let e = s.set_state(0.0, &moved[1..]).unwrap_err();
    assert_eq!(e.status, Status::WrongSize);
    moved[2] = 0.3e-3;
    let e = s.set_state(0.0, &moved).unwrap_err();
    assert_eq!(e.status, Status::BadState);
    assert!(e.message.contains("film between cage and guide"), "{e}");
    assert_eq!(s.time(), 5.0);
}

/// A host that hands its own copy of the state back in every step, or one that differs by round-off or by what it controls errors
/// to, costs little, keeps the balance and all counts.
#[test]
fn states_next_to_the_present_one_go_on_gently() {
    let advance = |change: Option<f64>| {
        let mut s = sim(&[]);
        s.advance_to(5e-3).unwrap();
        let before = s.statistics();
        for i in 1..=50u32 {
            if let Some(change) = change {
                let mut state = s.state().to_vec();
                let unit = s.model().state_scales()[0];
                state[0] += change * unit * if i % 2 == 0 { 1.0 } else { -1.0 };
                s.set_state(s.time(), &state).unwrap();
            }
            s.advance_to(5e-3 + 1e-4 * f64::from(i)).unwrap();
        }
        let after = s.statistics();
        assert_eq!(after.choice.unwrap().steps.iter().sum::<u64>(), after.driver.steps);
        assert_eq!(s.power_balance().unwrap().from, 0.0);
        assert_eq!(s.trust(), Ok(()));
        let cost = (after.evaluations - before.evaluations, after.jacobians - before.jacobians);
        (bits(s.state()), cost)
    };
    let (free, (evaluations, jacobians)) = advance(None);
    assert_eq!(advance(Some(0.0)), (free, (evaluations, jacobians)));
    let (_, near) = advance(Some(5e-3));
    // From a state elsewhere on it is more than thirty Jacobians for each of the fifty.
    assert!(
        near.0 < 4 * evaluations && near.1 < jacobians + 50 / 3,
        "{near:?} after {evaluations}, {jacobians}"
    );
}

/// Of motion that a host imposes the balance knows nothing; a state from which a run begins is no such thing.
#[test]
fn imposed_motion_is_not_judged() {
    let mut s = sim(&[]);
    let mut state = s.state().to_vec();
    state[2] += 1e-6;
    s.set_state(0.0, &state).unwrap();
    s.advance_to(1e-3).unwrap();
    assert_eq!(s.trust(), Ok(()));
    let steps = s.statistics().driver.steps;
    for i in 1..=3u32 {
        state[2] += 2e-6;
        s.set_state(1e-3 * f64::from(i), &state).unwrap();
        s.advance_to(1e-3 * f64::from(i + 1)).unwrap();
    }
    let error = s.trust().unwrap_err();
    assert!(error.status == Status::NotJudged && error.message.contains("3 times"), "{error}");
    assert_eq!(s.doubts(), []);
    assert!(s.report().contains("not judged"), "{}", s.report());
    let (counted, choice) = (s.statistics().driver.steps, s.statistics().choice.unwrap());
    assert!(counted > steps && choice.steps.iter().sum::<u64>() == counted);
    assert!(choice.highest_frequency > 0.0);
    // What a simulation remembers, a snapshot does.
    let mut other = sim(&[]);
    other.restore(&s.save()).unwrap();
    assert_eq!(other.trust(), Err(error));
    s.set_state(0.0, &state).unwrap();
    s.advance_to(1e-3).unwrap();
    assert_eq!(s.trust(), Ok(()));
    other.reset().unwrap();
    assert_eq!(other.trust(), Ok(()));
    assert_eq!(other.statistics().choice.unwrap().steps, [0; 4]);
}

#[test]
fn load_steps_ramps_sines_and_tables_are_followed() {
    let load = "inner_ring.motion.free.load.z";
    for (signal, events) in [
        (r#"{"step": {"before": -4900, "after": -980, "time": 0.5e-3}}"#, 1),
        (r#"{"ramp": {"from": -4900, "to": 4900, "start": 0.2e-3, "end": 0.9e-3}}"#, 2),
        (r#"{"sine": {"mean": -3000, "amplitude": 1000, "frequency": 500, "phase": 0.3}}"#, 0),
        (r#"{"table": {"time": [0, 3e-4, 6e-4], "value": [-4900, -2000, -6000]}}"#, 2),
    ] {
        for method in [&[][..], &[CHOSEN][..], &[ACCURATE][..], &[STIFF][..]] {
            let overrides: Vec<_> = std::iter::once((load, signal)).chain(method.iter().copied()).collect();
            let mut s = sim(&overrides);
            s.advance_to(1.5e-3).unwrap_or_else(|e| panic!("{signal}: {e}"));
            assert_eq!(s.statistics().driver.events, events, "{signal}");
        }
    }
}

#[test]
fn inputs_taken_over_by_the_host_stay_until_released_or_reset() {
    let mut s = sim(&[]);
    let start = bits(s.state());
    s.set_input(0, -100.0).unwrap();
    s.set_input(1, 250.0).unwrap();
    assert_eq!((s.input(0), s.input(1), s.input(2)), (Ok(-100.0), Ok(250.0), Ok(-4900.0)));
    s.advance_to(0.5e-3).unwrap();
    let sources = cagedyn::model::FORCE_SOURCES;
    let load = sources.iter().position(|s| *s == "load").unwrap();
    assert_eq!(s.forces().unwrap().bodies[1][load], [250.0, -4900.0, 0.0]);
    s.release_input(1).unwrap();
    assert_eq!(s.input(1), Ok(0.0));
    s.reset().unwrap();
    assert_eq!(s.input(0), Ok(-314.1592653589793));
    assert_eq!(bits(s.state()), start);
    assert_eq!(s.statistics(), sim(&[]).statistics());
    assert_eq!(s.set_input(3, 0.0).unwrap_err().status, Status::BadIndex);
    let fixed = sim(&[
        ("inner_ring.motion", r#"{"fixed": {"y": 0, "z": -25e-6}}"#),
        ("initial.inner_ring", "\"centred\""),
    ]);
    assert_eq!(fixed.model().input_count(), 1);
}

#[test]
fn a_refused_state_leaves_the_outputs_alone() {
    let mut s = sim(&[]);
    s.advance_to(1e-3).unwrap();
    let mut before = vec![0.0; s.channels().len()];
    s.outputs(&mut before).unwrap();
    for (i, value) in [(2, 1e-3), (5, 1.0), (5, -1e300), (0, 1e300), (2, -1e200)] {
        let mut state = s.state().to_vec();
        state[i] = value;
        let expected = if value.abs() > 1e12 { Status::BadValue } else { Status::BadState };
        assert_eq!(s.set_state(1e-3, &state).unwrap_err().status, expected, "{i}");
        let mut after = vec![0.0; before.len()];
        s.outputs(&mut after).unwrap();
        assert_eq!(bits(&before), bits(&after), "{i}");
    }
}

/// The value that an input has already, and one that the scene gives, change nothing.
#[test]
fn inputs_that_are_set_to_what_they_are_cost_nothing() {
    let run = |set: bool| {
        let mut s = sim(&[]);
        for k in 1..=2000 {
            if set || k == 1 {
                s.set_input(0, -314.0).unwrap();
            }
            s.advance_to(1e-6 * f64::from(k)).unwrap();
        }
        (bits(s.state()), s.power_balance().unwrap().relative_residual())
    };
    assert_eq!(run(true), run(false));
}

#[test]
fn inputs_have_the_ranges_of_scenes() {
    let mut s = sim(&[]);
    let names: Vec<String> = s.model().input_infos().into_iter().map(|info| info.name).collect();
    for (name, value) in
        [("inner_ring.speed", 2e5), ("load.z", 1e12), ("load.y", -1e10), ("load.z", f64::NAN)]
    {
        let input = names.iter().position(|other| other == name).unwrap();
        let before = s.input(input).unwrap();
        assert_eq!(s.set_input(input, value).unwrap_err().status, Status::BadValue, "{name} = {value}");
        assert_eq!(s.input(input).unwrap(), before);
    }
    let grease = read("scenes/grease_guide.json");
    let mut s = Sim::new(Arc::new(Model::from_json(&grease).unwrap())).unwrap();
    let temperature = s.model().input_infos().iter().position(|i| i.name == "lubricant.temperature").unwrap();
    let e = s.set_input(temperature, 40.0).unwrap_err();
    assert!(e.message.contains("313.15 K"), "{e}");
    // In range, but the oil of this scene has no viscosity there.
    let e = s.set_input(temperature, 160.0).unwrap_err();
    assert!(e.status == Status::BadValue && e.message.contains("at 160.0 K the viscosity"), "{e}");
}
