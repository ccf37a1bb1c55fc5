//! Scenes of published bearings that `judge --published` draws: all are taken, and all their parts come up.

use cagedyn::Scene;
use cagedyn_studies::bearings::TWELVE;
use cagedyn_studies::judge::published::scene;

#[test]
fn scenes_of_published_bearings_are_taken_and_have_every_part() {
    let parts = [
        "/cage/elastic_ring",
        "/heat/in_motion",
        "/heat/play",
        "/lubricant/grease",
        "/rollers/profile",
        "/rollers/radius_deviations",
        "/inner_ring/raceway_crown_radius",
        "/outer_ring/raceway_crown_radius",
        "/outer_ring/speed",
        "/inner_ring/speed/ramp",
        "/cage/guide/film/short_bearing",
        "/cage/guide/film/lubricant_layer",
        "/cage/guide/roundness",
        "/cage/pocket/solid_plane",
        "/cage/pocket/lubricated_cylinder",
    ];
    let mut counts = [0; 15];
    let (mut uncaged, mut inner, mut uncaged_of_caged) = (0, 0, 0);
    for number in 0..480 {
        let scene = scene(number, 0.03);
        if let Err(e) = Scene::from_value(&scene) {
            panic!("{number}: {e}");
        }
        for (count, part) in counts.iter_mut().zip(parts) {
            *count += usize::from(scene.pointer(part).is_some_and(|part| !part.is_null()));
        }
        inner += usize::from(scene["cage"]["guide"]["ring"] == "inner_ring");
        if scene["cage"].is_null() {
            uncaged += 1;
            uncaged_of_caged += usize::from(TWELVE[(number % 12) as usize].caged);
        }
    }
    for (count, part) in counts.iter().zip(parts) {
        assert!(*count > 4, "{part} {count} times");
    }
    assert!(inner > 50 && uncaged > 40 && uncaged_of_caged > 4, "{inner} {uncaged} {uncaged_of_caged}");
}
