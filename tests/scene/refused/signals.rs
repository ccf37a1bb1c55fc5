//! Functions of time.

use super::table::*;
use serde_json::{Value, json};

pub fn rows() -> Vec<Row> {
    let speed = |signal: Value| vec![("inner_ring.speed", signal)];
    let table = |time: Value, value: Value| speed(json!({"table": {"time": time, "value": value}}));
    let load = vec![("inner_ring.motion.free.load.y", json!({"table": {"time": [0, 1], "value": [0, 2e9]}}))];
    vec![
        scene_row("empty table", table(json!([]), json!([])), "inner_ring.speed.table.time", &["0 points"]),
        scene_row(
            "unequal table",
            table(json!([0, 1]), json!([0])),
            "inner_ring.speed.table.value",
            &["1 values for 2 points"],
        ),
        scene_row(
            "table going back",
            table(json!([0, 2, 1]), json!([0, 0, 0])),
            "inner_ring.speed.table.time.2",
            &["1.0 s is not after 2.0 s"],
        ),
        scene_row(
            "table standing still",
            table(json!([0, 0]), json!([0, 1])),
            "inner_ring.speed.table.time.1",
            &["0.0 s is not after 0.0 s"],
        ),
        scene_row(
            "table before zero",
            table(json!([-1, 0]), json!([0, 1])),
            "inner_ring.speed.table.time.0",
            &["-1.0 s"],
        ),
        scene_row(
            "table value out of range",
            load,
            "inner_ring.motion.free.load.y.table.value.1",
            &["2000000000.0 N"],
        ),
        scene_row(
            "ramp ends before it starts",
            speed(json!({"ramp": {"from": 0, "to": -314, "start": 0.2, "end": 0.1}})),
            "inner_ring.speed.ramp.end",
            &["0.1 s is not after the start 0.2 s"],
        ),
        scene_row(
            "ramp of no length",
            speed(json!({"ramp": {"from": 0, "to": -314, "start": 0.2, "end": 0.2}})),
            "inner_ring.speed.ramp.end",
            &["0.2 s"],
        ),
        scene_row(
            "step before zero",
            speed(json!({"step": {"before": 0, "after": 1, "time": -1e-3}})),
            "inner_ring.speed.step.time",
            &["-0.001 s"],
        ),
        scene_row(
            "negative frequency",
            speed(json!({"sine": {"mean": 0, "amplitude": 1, "frequency": -50, "phase": 0}})),
            "inner_ring.speed.sine.frequency",
            &["-50.0 Hz"],
        ),
        scene_row(
            "sine amplitude out of range",
            speed(json!({"sine": {"mean": 0, "amplitude": 1e6, "frequency": 50, "phase": 0}})),
            "inner_ring.speed.sine.amplitude",
            &["1000000.0 rad/s"],
        ),
    ]
}
