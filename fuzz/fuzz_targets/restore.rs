//! Changed snapshots: refused, with the simulation as it was, or good to go on from.
#![no_main]

use cagedyn::{Model, Sim};
use libfuzzer_sys::fuzz_target;
use std::sync::{Arc, LazyLock};

static MODEL: LazyLock<Arc<Model>> = LazyLock::new(|| {
    Arc::new(Model::from_json(include_str!("../../scenes/grease_guide.json")).expect("a scene"))
});

fuzz_target!(|changes: Vec<(u16, f64)>| {
    let mut sim = Sim::new(MODEL.clone()).expect("a simulation");
    sim.advance_to(1e-4).expect("a step");
    let (mut saved, state) = (sim.save(), sim.state().to_vec());
    for (place, value) in changes {
        let n = saved.len();
        saved[usize::from(place) % n] = value;
    }
    if sim.restore(&saved).is_err() {
        assert_eq!(sim.state(), state);
    }
    sim.set_wall_time_limit(0.05).expect("a limit");
    let _ = sim.advance_to(sim.time() + 1e-5);
});
