//! Scenes of rollers in space that `judge --rollers` draws: all are taken, all their parts come up, and they run or say why not.

use crate::{check_error, check_finite};
use cagedyn::{Model, Scene, Sim, Status};
use cagedyn_studies::judge::rollers_in_space::scene;
use std::sync::Arc;

const PARTS: [&str; 22] = [
    "/cage/elastic_ring",
    "/cage/space/lands",
    "/cage/space/pocket_sides",
    "/cage/space/load",
    "/cage/guide/film/short_bearing",
    "/cage/space/lands/0/guide/film/lubricant_layer",
    "/cage/pocket/solid_plane",
    "/cage/pocket/lubricated_cylinder",
    "/lubricant/grease",
    "/rollers/profile/logarithmic",
    "/rollers/profile/circular_crown",
    "/rollers/radius_deviations",
    "/rollers/space/slices_on",
    "/inner_ring/raceway_crown_radius",
    "/outer_ring/raceway_crown_radius",
    "/outer_ring/speed",
    "/inner_ring/motion/space/load/x",
    "/inner_ring/motion/space/tilt_y/held",
    "/inner_ring/motion/space/tilt_z/prescribed",
    "/ribs/list/3",
    "/ribs/contact/boundary_friction",
    "/raceways/slices",
];

#[test]
fn scenes_of_rollers_in_space_are_taken_and_have_every_part() {
    let (mut counts, mut uncaged, mut without_ribs) = ([0; PARTS.len()], 0, 0);
    for number in 0..400 {
        let scene = scene(number, 0.03);
        if let Err(e) = Scene::from_value(&scene) {
            panic!("{number}: {e}");
        }
        for (count, part) in counts.iter_mut().zip(PARTS) {
            *count += usize::from(scene.pointer(part).is_some_and(|part| !part.is_null()));
        }
        uncaged += usize::from(scene["cage"].is_null());
        without_ribs += usize::from(scene["ribs"].is_null());
    }
    for (count, part) in counts.iter().zip(PARTS) {
        assert!(*count > 4, "{part} {count} times");
    }
    assert!(uncaged > 10 && without_ribs > 10, "{uncaged} {without_ribs}");
}

/// A few steps of each: nothing panics, every number is finite, what ends a run is told.
#[test]
fn random_rollers_in_space_run_or_say_why_not() {
    let mut finished = 0;
    for number in 0..60 {
        let scene = scene(number, 0.03);
        let model =
            Arc::new(Model::from_json(&scene.to_string()).unwrap_or_else(|e| panic!("{number}: {e}")));
        let names: Vec<String> = model.channels().iter().map(|channel| channel.name.clone()).collect();
        let allowed = [Status::BadState, Status::StepTooSmall, Status::TooManySteps];
        let fails = |e: &cagedyn::Error| check_error(e, &allowed).unwrap_or_else(|e| panic!("{number}: {e}"));
        let mut sim = match Sim::new(model) {
            Ok(sim) => sim,
            Err(e) => {
                fails(&e);
                continue;
            }
        };
        match sim.advance_to(2e-5) {
            Ok(()) => finished += 1,
            Err(e) => fails(&e),
        }
        assert!(sim.state().iter().all(|x| x.is_finite()), "{number}");
        let mut out = vec![0.0; names.len()];
        sim.outputs(&mut out).unwrap_or_else(|e| panic!("{number}: {e}"));
        check_finite("outputs", &names, &out).unwrap_or_else(|e| panic!("{number}: {e}"));
    }
    println!("{finished} of 60");
    assert!(finished > 54, "{finished}");
}
