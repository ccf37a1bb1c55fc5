//! Profiles of rollers and raceways.

use super::table::*;
use serde_json::{Value, json};

pub fn rows() -> Vec<Row> {
    let logarithmic = |more: Value| {
        let mut profile = json!({"logarithmic": {"design_load": 9000.0}});
        profile["logarithmic"].as_object_mut().unwrap().extend(more.as_object().unwrap().clone());
        profile
    };
    let crown = |radius: f64| json!({"circular_crown": {"radius": radius}});
    let log =
        |name, more, path, says| rollers().scene(name, &[("rollers.profile", logarithmic(more))], path, says);
    vec![
        log(
            "design load of nothing",
            json!({"design_load": 0.0}),
            "rollers.profile.logarithmic.design_load",
            &["0.0 N", "1e-3 to 1e9 N"],
        ),
        log(
            "no load factor",
            json!({"load_factor": 0.0}),
            "rollers.profile.logarithmic.load_factor",
            &["0.0", "1e-3 to 1000"],
        ),
        log(
            "crowned share above one",
            json!({"crowned_share": 1.1}),
            "rollers.profile.logarithmic.crowned_share",
            &["1.1", "0.01 to 1"],
        ),
        log(
            "end drop in um",
            json!({"end_drop": 12}),
            "rollers.profile.logarithmic.end_drop",
            &["12.0 m", "micro", "1.2e-5 m"],
        ),
        rollers().scene(
            "crown of a ball",
            &[("rollers.profile", crown(7.5e-3))],
            "rollers.profile.circular_crown.radius",
            &["0.0075 m", "0.0204 to 1e6 m"],
        ),
        rollers().json(
            "two profiles",
            "rollers.profile",
            json!({"logarithmic": {"design_load": 9e3}, "circular_crown": {"radius": 2.0}}),
            "rollers.profile",
            &[],
        ),
        rollers().json(
            "unknown profile",
            "rollers.profile",
            json!({"parabolic": {"drop": 1e-5}}),
            "rollers.profile",
            &["parabolic", "logarithmic"],
        ),
        rollers().value(
            "flat crown of the outer raceway",
            "outer_ring.raceway_crown_radius",
            json!(2e7),
            &["20000000.0 m", "1e6 m"],
        ),
        rollers().value(
            "deep crown of the inner raceway",
            "inner_ring.raceway_crown_radius",
            json!(1e-3),
            &["0.001 m", "0.0204 to 1e6 m"],
        ),
        grease().value(
            "crown under elements of prescribed motion",
            "inner_ring.raceway_crown_radius",
            json!(2.0),
            &["needs 'rollers'", "remove it"],
        ),
        rollers().value(
            "slices of straight contacts",
            "raceways.slices",
            json!(8),
            &["not used without 'rollers.profile'", "remove it"],
        ),
        rollers().scene(
            "one slice",
            &[("rollers.profile", crown(2.0)), ("raceways.slices", json!(1))],
            "raceways.slices",
            &["1 is not within 2 to 32"],
        ),
        rollers().scene(
            "too few deviations of radii",
            &[("rollers.radius_deviations", json!({"each": [1e-6, 0.0]}))],
            "rollers.radius_deviations.each",
            &["2 numbers for 12 rollers"],
        ),
        rollers().scene(
            "roller that does not fit its pocket",
            &[("rollers.radius_deviations", json!({"groups": [{"rollers": [3], "deviation": 3e-4}]}))],
            "rollers.radius_deviations.groups.0.deviation",
            &["0.0003 m", "-7.5e-5 to 7.5e-5 m"],
        ),
        rollers().scene(
            "deviation of a roller that is not there",
            &[("rollers.radius_deviations", json!({"groups": [{"rollers": [3, 12], "deviation": 1e-6}]}))],
            "rollers.radius_deviations.groups.0.rollers.1",
            &["no roller 12", "0 to 11"],
        ),
        rollers().scene(
            "two deviations of one roller",
            &[(
                "rollers.radius_deviations",
                json!({"groups": [{"rollers": [3], "deviation": 1e-6}, {"rollers": [1, 3], "deviation": 2e-6}]}),
            )],
            "rollers.radius_deviations.groups.1.rollers.1",
            &["roller 3", "twice"],
        ),
    ]
}
