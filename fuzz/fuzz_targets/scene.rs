//! Any text as a scene: refused with a message of one line, or compiled and started.
#![no_main]

use cagedyn::{Model, Sim};
use libfuzzer_sys::fuzz_target;
use std::sync::Arc;

fuzz_target!(|text: &str| {
    match Model::from_json(text) {
        Err(e) => assert!(!e.message.is_empty() && !e.message.contains('\n')),
        Ok(model) if model.element_count() <= 100 => {
            if let Ok(mut sim) = Sim::new(Arc::new(model)) {
                sim.set_wall_time_limit(0.02).expect("a limit");
                let _ = sim.advance_to(1e-5);
            }
        }
        Ok(_) => {}
    }
});
