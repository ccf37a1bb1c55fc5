//! Cages in space that cannot be.

use super::table::*;
use serde_json::json;

pub fn rows() -> Vec<Row> {
    let (caged, grease, rollers) = (caged(), grease(), rollers());
    let space = json!({"transverse_inertia": 1.285e-5});
    let land = |x: f64| {
        let solid = json!({"contact": {"stiffness": 1e6, "softening_depth": 1e-6}});
        let guide = json!({"ring": "outer_ring", "guide_radius": 0.046875, "diametral_clearance": 4e-4, "solid": solid});
        json!([{"x": x, "width": 3e-3, "guide": guide}])
    };
    let round = json!({"solid_cylinder": {"diametral_clearance": 5e-4, "law": {"spring": {"stiffness": 1e6, "softening_depth": 1e-6}}}});
    let shape = json!({"inner_radius": 0.042, "outer_radius": 0.0466, "width": 0.016, "density": 500.0});
    let mut sliced = land(2e-3);
    sliced[0]["slices"] = json!(0);
    vec![
        caged.value(
            "no inertia across the axis",
            "cage.space.transverse_inertia",
            json!(0.0),
            &["0.0 kg m^2", "1.2555e-5"],
        ),
        caged.value(
            "less across the axis than a body can have",
            "cage.space.transverse_inertia",
            json!(1e-5),
            &["1e-5 kg m^2", "1.2555e-5"],
        ),
        caged.scene(
            "neither inertia nor shape",
            &[("cage.space", json!({}))],
            "cage.space.transverse_inertia",
            &["missing", "cage.space.shape"],
        ),
        caged.scene(
            "inertia and shape",
            &[("cage.space.shape", shape.clone())],
            "cage.space.shape",
            &["not allowed beside 'cage.space.transverse_inertia'"],
        ),
        caged.scene(
            "shape of another cage",
            &[("cage.space", json!({"shape": shape}))],
            "cage.space.shape",
            &["does not fit", "allowed are"],
        ),
        caged.value("pocket higher than a ball", "cage.space.pocket_height", json!(0.02), &["0.02 m", "8.731e-3 m"]),
        caged.scene("no slices", &[("cage.space.lands", sliced)], "cage.space.lands.0.slices", &["0 is outside of 1 to 15"]),
        caged.scene(
            "land outside of the bearing",
            &[("cage.space.lands", land(0.5))],
            "cage.space.lands.0.x",
            &["0.5 m", "0.045 m"],
        ),
        caged.scene(
            "tilted beyond its lands",
            &[("cage.space.lands", land(8e-3)), ("initial.cage_space", json!({"tilt_y": 0.06}))],
            "initial.cage_space",
            &["a tilt of 0.06 rad", "leaves no room", "cage.space.lands.0"],
        ),
        caged.value("start at a thousand", "initial.cage_space", json!({"tilt_z": 1e3}), &["1000.0 rad"])
            .at("initial.cage_space.tilt_z"),
        caged.scene(
            "pockets that run into each other",
            &[("cage.pocket.solid_cylinder.diametral_clearance", json!(5e-3))],
            "cage.pocket.solid_cylinder.diametral_clearance",
            &["25 pockets", "overlap"],
        ),
        caged.scene(
            "Hertz without a material of the cage",
            &[("cage.pocket.solid_cylinder.law", json!({"hertz": {}}))],
            "cage.material",
            &["missing"],
        ),
        caged.scene(
            "more waves than pockets carry",
            &[("cage.elastic_ring", json!({"modes": 13, "neutral_radius": 45.081e-3, "stiffness": {"bending": 0.2572}, "damping": 0.03, "growth": 1.4e-11}))],
            "cage.elastic_ring.modes",
            &["within 2 to 12"],
        ),
        rollers.value("rollers", "cage.space", space.clone(), &["not allowed beside 'rollers'"]),
        grease.scene(
            "round pocket in the plane",
            &[("cage.pocket", round)],
            "cage.pocket",
            &["cages in space"],
        ),
        grease.scene(
            "axial walls in the plane",
            &[("cage.pocket.solid_plane.axial_clearance", json!(5e-4))],
            "cage.pocket.solid_plane.axial_clearance",
            &["needs 'cage.space'"],
        ),
        grease.value("tilt in the plane", "initial.cage_space", json!({"tilt_y": 1e-3}), &["needs 'cage.space'"]),
    ]
}
