//! Raceways and rollers that are not round.

use super::table::*;
use serde_json::{Value, json};

pub fn rows() -> Vec<Row> {
    let of = |rollers: Value, more: Value| {
        let mut group = json!({ "rollers": rollers });
        group.as_object_mut().unwrap().extend(more.as_object().unwrap().clone());
        json!([group])
    };
    let table = |angles: Value, heights: Value| json!({"angles": angles, "heights": heights});
    let wave = json!({"harmonics": [{"order": 2, "amplitude": 1e-7, "phase": 0.0}]});
    let on_roller = |name, rollers: Value, more: &Value, path, says| {
        rollers_row(name, "rollers.waviness", of(rollers, more.clone()), path, says)
    };
    let on_ring = |name, angles: Value, heights: Value, path, says| {
        rollers_row(name, "outer_ring.waviness_table", table(angles, heights), path, says)
    };
    vec![
        on_roller(
            "waves of no roller",
            json!([12]),
            &wave,
            "rollers.waviness.0.rollers.0",
            &["no roller 12", "0 to 11"],
        ),
        on_roller(
            "waves twice",
            json!([3, 3]),
            &wave,
            "rollers.waviness.0.rollers.1",
            &["roller 3", "twice"],
        ),
        on_roller(
            "round waves",
            json!([3]),
            &json!({}),
            "rollers.waviness.0",
            &["no waves", "'harmonics' or a 'table'"],
        ),
        on_roller(
            "roller in millimetres",
            json!([3]),
            &json!({"harmonics": [{"order": 2, "amplitude": 1e-3, "phase": 0.0}]}),
            "rollers.waviness.0.harmonics.0.amplitude",
            &["0.001 m"],
        ),
        on_roller(
            "roller that is too steep",
            json!([3]),
            &json!({"harmonics": [{"order": 100, "amplitude": 1e-6, "phase": 0.0}]}),
            "rollers.waviness.0.harmonics",
            &["too steep", "0.01 is allowed"],
        ),
        on_ring(
            "table of three",
            json!([0, 1, 2]),
            json!([0, 0, 0]),
            "outer_ring.waviness_table.angles",
            &["3 numbers", "4 to 4096"],
        ),
        on_ring(
            "fewer heights",
            json!([0, 1, 2, 3]),
            json!([0, 0, 0]),
            "outer_ring.waviness_table.heights",
            &["3 numbers for 4 angles"],
        ),
        on_ring(
            "angles that fall",
            json!([0, 2, 1, 3]),
            json!([0, 0, 0, 0]),
            "outer_ring.waviness_table.angles.2",
            &["1.0 rad"],
        ),
        on_ring(
            "more than a turn",
            json!([0, 2, 4, 7]),
            json!([0, 0, 0, 0]),
            "outer_ring.waviness_table.angles.3",
            &["7.0 rad"],
        ),
        on_ring(
            "heights in micrometres",
            json!([0, 1, 2, 3]),
            json!([0, 0, 5, 0]),
            "outer_ring.waviness_table.heights.2",
            &["5.0 m"],
        ),
        grease().scene(
            "waves that nothing rolls on",
            &[("inner_ring.waviness", json!([{"order": 2, "amplitude": 1e-7, "phase": 0.0}]))],
            "inner_ring.waviness",
            &["needs 'balls', or 'rollers'"],
        ),
        on_ring(
            "a wall",
            json!([0, 1, 1.001, 3]),
            json!([0, 0, -1e-4, 0]),
            "outer_ring.waviness_table.heights.2",
            &["slope", "more than 0.2"],
        ),
    ]
}

fn rollers_row(
    name: &'static str,
    path: &'static str,
    value: Value,
    at: &'static str,
    says: &'static [&'static str],
) -> Row {
    rollers().value(name, path, value, says).at(at)
}
