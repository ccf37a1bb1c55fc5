//! Any sequence of calls of one simulation.
#![no_main]

use cagedyn::{Model, Sim};
use libfuzzer_sys::fuzz_target;
use std::sync::{Arc, LazyLock};

static MODEL: LazyLock<Arc<Model>> = LazyLock::new(|| {
    Arc::new(Model::from_json(include_str!("../../scenes/nu2310.json")).expect("a scene"))
});

fuzz_target!(|calls: Vec<(u8, u16, f64)>| {
    let mut sim = Sim::new(MODEL.clone()).expect("a simulation");
    let mut out = vec![0.0; sim.channels().len()];
    for (call, place, x) in calls.into_iter().take(50) {
        let i = usize::from(place);
        sim.set_wall_time_limit(5e-3).expect("a limit");
        let mut state = sim.state().to_vec();
        let n = state.len();
        let _ = match call % 12 {
            0 => sim.step(x),
            1 => sim.advance_to(sim.time() + x.abs().min(1e-5)),
            2 => sim.set_input(i, x),
            3 => sim.release_input(i),
            4 => {
                state[i % n] = x;
                sim.set_state(sim.time(), &state)
            }
            5 => {
                state[i % n] += 1e-9 * x.clamp(-1e3, 1e3);
                sim.set_state(sim.time(), &state)
            }
            6 => sim.outputs(&mut out),
            7 => sim.output(i).map(drop),
            8 => sim.power_balance().map(drop),
            9 => sim.linearize(sim.time(), &state),
            10 => sim.factorize(x).and_then(|()| sim.solve(&mut state)),
            _ => sim.reset(),
        };
        assert!(sim.state().iter().all(|x| x.is_finite()) && sim.time().is_finite());
    }
});
