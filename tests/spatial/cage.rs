//! A cage among balls: the planar limit, conservation without friction, the whirl of a greased guide.

use crate::{CAGED, elastic_ring, free_ring, model};
use cagedyn::{CageMotion, Model, MotionOfCage, Recording, Sim};
use serde_json::{Value, json};
use std::sync::Arc;

fn channel(model: &Model, name: &str) -> usize {
    model.channels().iter().position(|channel| channel.name == name).expect("a channel")
}

/// Means of these channels over the last `window` (s) of a run until `end`, and the largest tilt and axial place.
fn means<const N: usize>(model: &Arc<Model>, names: [&str; N], [window, end]: [f64; 2]) -> [f64; N] {
    let mut sim = Sim::new(model.clone()).unwrap();
    let places = names.map(|name| channel(model, name));
    let mut sums = [0.0; N];
    sim.advance_to(end - window).unwrap();
    let count = 1200;
    for k in 1..=count {
        sim.advance_to(end - window + window * f64::from(k) / f64::from(count)).unwrap();
        for (sum, place) in sums.iter_mut().zip(places) {
            *sum += sim.output(place).unwrap();
        }
    }
    let balance = sim.power_balance().unwrap();
    assert!(balance.relative_residual().abs() < 1e-3, "{balance:?}");
    sums.map(|sum| sum / f64::from(count))
}

const GREASED: &str = "scenes/grease_guide.json";

/// The planar scene with a cage that could leave the plane.
fn prescribed(changes: &[(&str, Value)]) -> Arc<Model> {
    let space = [("cage.space", json!({"transverse_inertia": 1.285e-5}))];
    model(GREASED, &[&space[..], changes].concat())
}

/// A cage in space among prescribed elements, between plane walls and with a land in the middle, has the accelerations of one in the plane.
#[test]
fn the_plane_is_a_limit() {
    let eccentric = [("cage.mass_eccentricity", json!({"y": 2e-5, "z": 1e-5}))];
    for changes in [&[][..], &eccentric] {
        let mut plane = Sim::new(model(GREASED, changes)).unwrap();
        let mut space = Sim::new(prescribed(changes)).unwrap();
        for step in 1..=200 {
            plane.advance_to(1e-4 * f64::from(step)).unwrap();
            let [y, z, angle, vy, vz, speed] = std::array::from_fn(|k| plane.state()[k]);
            let state = [0.0, y, z, angle, 0.0, 0.0, 0.0, vy, vz, speed, 0.0, 0.0];
            let (mut of_plane, mut of_space) = ([0.0; 6], [0.0; 12]);
            let planar = plane.state().to_vec();
            plane.derivative(plane.time(), &planar, &mut of_plane).unwrap();
            space.derivative(plane.time(), &state, &mut of_space).unwrap();
            let size = of_plane[3..].iter().fold(1.0, |a: f64, b| a.max(b.abs()));
            for (k, expected) in [(7, of_plane[3]), (8, of_plane[4]), (9, of_plane[5])] {
                let off = (of_space[k] - expected).abs();
                assert!(off < 1e-11 * size, "{step} {k}: {} {expected}", of_space[k]);
            }
            for k in [6, 10, 11] {
                assert_eq!(of_space[k], 0.0);
            }
        }
    }
}

/// The same of a cage that bends, in a state of its whirl and with every wave off.
#[test]
fn the_plane_is_a_limit_of_a_cage_that_bends() {
    let (touched, _) = bends_as_in_the_plane(&[], 1e-4);
    assert!(touched);
    // Lobes whose asperities touch where a round cage would not.
    let lobes =
        json!([{"order": 3, "amplitude": 4e-5, "phase": 4.7}, {"order": 9, "amplitude": 2e-6, "phase": 1.0}]);
    let thrown = ("initial.cage_velocity", json!({"y": -0.2, "z": -1.0}));
    let (_, least) = bends_as_in_the_plane(
        &[
            ("cage.guide.roundness", lobes),
            ("cage.guide.film.lubricant_layer.thickness", json!(5e-6)),
            ("cage.guide.solid.asperity_height", json!(8e-6)),
            ("cage.guide.film_share.roughness", json!(4e-6)),
            thrown,
        ],
        2e-6,
    );
    assert!(least < 8e-6, "{least}");
}

/// Whether pockets and guide took part, and the smallest gap, m.
fn bends_as_in_the_plane(changes: &[(&str, Value)], interval: f64) -> (bool, f64) {
    let elastic = "scenes/grease_guide_elastic.json";
    let planar_model = model(elastic, changes);
    let mut plane = Sim::new(planar_model.clone()).unwrap();
    let space = [("cage.space", json!({"transverse_inertia": 1.285e-5}))];
    let space_model = model(elastic, &[changes, &space].concat());
    let mut space = Sim::new(space_model.clone()).unwrap();
    let energy = |sim: &mut Sim, t: f64, state: &[f64]| sim.energy_at(t, state).unwrap().total();
    // Places of the coordinates of the plane among those in space.
    let places: Vec<usize> = [1, 2, 3].into_iter().chain(6..12).collect();
    let (mut touched, mut least) = (false, f64::INFINITY);
    for step in 1..=200 {
        plane.advance_to(interval * f64::from(step)).unwrap();
        least = least.min(plane.output(channel(&planar_model, "guide.minimum_film")).unwrap());
        let planar = plane.state().to_vec();
        let mut state = [0.0; 24];
        for (k, place) in places.iter().enumerate() {
            (state[*place], state[12 + place]) = (planar[k], planar[9 + k]);
        }
        let (mut of_plane, mut of_space) = ([0.0; 18], [0.0; 24]);
        plane.derivative(plane.time(), &planar, &mut of_plane).unwrap();
        space.derivative(plane.time(), &state, &mut of_space).unwrap();
        let size = of_plane[9..].iter().fold(1.0, |a: f64, b| a.max(b.abs()));
        for (k, place) in places.iter().enumerate() {
            let off = (of_space[12 + place] - of_plane[9 + k]).abs();
            assert!(off < 1e-11 * size, "{step} {k}: {} {}", of_space[12 + place], of_plane[9 + k]);
        }
        for k in [12, 16, 17] {
            assert_eq!(of_space[k], 0.0);
        }
        let t = plane.time();
        let [expected, found] = [energy(&mut plane, t, &planar), energy(&mut space, t, &state)];
        assert!((found - expected).abs() < 1e-12 * expected.abs(), "{found} {expected}");
        let [expected, found] = [plane.powers_at(t, &planar), space.powers_at(t, &state)].map(Result::unwrap);
        touched |= expected.iter().filter(|p| **p != 0.0).count() > 3;
        for (expected, found) in expected.iter().zip(&found) {
            assert!((found - expected).abs() < 1e-9 * expected.abs().max(1.0), "{found} {expected}");
        }
    }
    (touched, least)
}

/// Steps that split off the damping of balls and cage keep the balance, too, where its ring bends.
#[test]
fn a_cage_that_bends_keeps_its_balance_in_steps_of_a_leapfrog() {
    let leapfrog = |step: f64| ("solver", json!({"method": {"leapfrog": {"step": step}}}));
    let push = [
        ("initial.cage", json!({"y": 0.0, "z": -150e-6})),
        ("initial.cage_velocity", json!({"y": -0.25, "z": 0.0})),
        ("cage.elastic_ring", elastic_ring(4)),
    ];
    let prescribed = |step| prescribed(&[&push[..], &[leapfrog(step)]].concat());
    let free = |step| model(CAGED, &[&push[..], &[leapfrog(step)]].concat());
    let missing = |model: Arc<Model>| {
        let touching = channel(&model, "pocket.touching_elements");
        let mut sim = Sim::new(model).unwrap();
        let mut touched: f64 = 0.0;
        for k in 1..=50 {
            sim.advance_to(2e-4 * f64::from(k)).unwrap();
            touched = touched.max(sim.output(touching).unwrap());
        }
        assert!(touched > 0.0);
        let balance = sim.power_balance().unwrap();
        balance.relative_residual().abs()
    };
    for (coarse, fine) in [(prescribed(4e-6), prescribed(1e-6)), (free(4e-6), free(1e-6))] {
        let [coarse, fine] = [coarse, fine].map(missing);
        assert!(fine < 0.3 * coarse && fine < 2e-4, "{coarse:e} {fine:e}");
    }
}

/// The stiffer its ring, the more a cage that bends moves as a rigid one, also where it is tilted in round pockets.
#[test]
fn a_stiff_ring_is_a_rigid_one() {
    let spring = json!({"stiffness": 1e6, "damping": 44.4, "softening_depth": 1e-6});
    let after = |elastic_ring: Value| {
        let changes = [
            ("cage.elastic_ring", elastic_ring),
            (
                "cage.pocket",
                json!({"solid_cylinder": {"diametral_clearance": 2.9e-4, "law": {"spring": spring}}}),
            ),
            ("initial.cage", json!({"y": 0.0, "z": -150e-6})),
            ("initial.cage_space", json!({"tilt_y": 1e-3, "tilt_speed_z": 0.3})),
            ("solver", json!({"method": {"dormand_prince": {"tolerance": 1e-8}}})),
        ];
        let mut sim = Sim::new(prescribed(&changes)).unwrap();
        sim.advance_to(2e-3).unwrap();
        sim.state()[..6].to_vec()
    };
    let rigid = after(Value::Null);
    let off = |stiffer: f64| {
        let mut ring = elastic_ring(3);
        (ring["stiffness"]["bending"], ring["growth"]) = (json!(0.2572 * stiffer), json!(0.0));
        let bent = after(ring);
        bent.iter().zip(&rigid).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max)
    };
    let [soft, stiff] = [1e2, 1e4].map(off);
    assert!(stiff < 0.05 * soft && stiff < 1e-6, "{soft} {stiff}");
}

/// It moves and whirls as that does, within what error control leaves, and neither tilts nor moves along the axis.
#[test]
fn the_whirl_of_the_plane() {
    let controlled =
        |tolerance: f64| [("solver", json!({"method": {"dormand_prince": {"tolerance": tolerance}}}))];
    let mut plane = Sim::new(model(GREASED, &controlled(1e-10))).unwrap();
    let mut coarser = Sim::new(model(GREASED, &controlled(1e-9))).unwrap();
    let space_model = prescribed(&controlled(1e-10));
    let mut space = Sim::new(space_model.clone()).unwrap();
    let touching = channel(&space_model, "pocket.touching_elements");
    let mut touched = false;
    let (mut off, mut left): (f64, f64) = (0.0, 0.0);
    // Later contacts grow any difference.
    for k in 1..=180 {
        let t = 1e-4 * f64::from(k);
        plane.advance_to(t).unwrap();
        space.advance_to(t).unwrap();
        touched |= space.output(touching).unwrap() > 0.0;
        coarser.advance_to(t).unwrap();
        for i in 0..2 {
            off = off.max((plane.state()[i] - space.state()[1 + i]).abs());
            left = left.max((plane.state()[i] - coarser.state()[i]).abs());
        }
    }
    assert!(touched);
    assert!(off < left && left < 1e-8, "{off} {left}");
    for name in ["cage.x", "cage.tilt"] {
        assert_eq!(space.output(channel(&space_model, name)).unwrap(), 0.0);
    }
    let [whirl, radius] = means(&prescribed(&[]), ["cage.whirl_speed", "cage.whirl_radius"], [0.02, 0.1]);
    assert!((whirl + 1958.0).abs() < 5.0 && (radius - 134.2e-6).abs() < 2e-7, "{whirl} {radius}");
}

/// Without friction and damping energy and the axial angular momentum of balls, ring and cage stay.
#[test]
fn without_friction_a_cage_loses_nothing() {
    loses_nothing(&Value::Null);
    // The damping of its waves would lose energy.
    let mut ring = elastic_ring(ORDERS);
    ring["damping"] = json!(0.0);
    loses_nothing(&ring);
}

/// Highest order of the waves.
const ORDERS: u32 = 4;

fn loses_nothing(elastic_ring: &Value) {
    let speed = 837.0;
    let spring = json!({"stiffness": 1e6, "softening_depth": 1e-6});
    let guide = json!({
        "ring": "outer_ring", "guide_radius": 46.875e-3, "diametral_clearance": 2e-4, "solid": {"contact": spring},
    });
    let changes = [
        ("raceways", json!({"contact": {}})),
        ("gravity", Value::Null),
        ("inner_ring.motion", free_ring([687.0, 0.0, 0.0, 0.0, 0.0])),
        ("inner_ring.speed", json!({"constant": speed})),
        ("cage.guide", guide),
        ("cage.elastic_ring", elastic_ring.clone()),
        ("cage.pocket", json!({"solid_cylinder": {"diametral_clearance": 2e-4, "law": {"spring": spring}}})),
        ("initial.cage_space", json!({"tilt_y": 1e-3})),
        ("initial.cage_velocity", json!({"y": 0.05, "z": 0.02})),
        ("solver", json!({"method": {"dormand_prince": {"tolerance": 1e-9}}})),
    ];
    let model = model(CAGED, &changes);
    let mut sim = Sim::new(model.clone()).unwrap();
    let touching = channel(&model, "pocket.touching_elements");
    let gap = channel(&model, "guide.minimum_film");
    let before = axial_momentum(&model, sim.state(), speed);
    let (mut largest, mut touched, mut rode): (f64, f64, bool) = (0.0, 0.0, false);
    for k in 1..=100 {
        sim.advance_to(1e-4 * f64::from(k)).unwrap();
        largest = largest.max((axial_momentum(&model, sim.state(), speed) / before - 1.0).abs());
        touched = touched.max(sim.output(touching).unwrap());
        rode |= sim.output(gap).unwrap() < 0.0;
    }
    assert!(touched > 0.0 && rode, "{touched} {rode}");
    let balance = sim.power_balance().unwrap();
    let missing = balance.residual() / balance.energy[0].total();
    assert!(missing.abs() < 1e-8, "{missing}");
    assert!(largest < 1e-12, "{largest}");
}

/// Of balls, ring and cage about the axis of the bearing, kg m^2/s; the ring stays upright here.
fn axial_momentum(model: &Model, state: &[f64], speed: f64) -> f64 {
    let (q, v) = state.split_at(model.layout().positions());
    let names = model.state_infos();
    let place = |name: &str| names.iter().position(|info| info.name == name).unwrap();
    let at = |name: &str| state[place(name)];
    let (mass, radius) = (2.7286e-3, 4.3655e-3);
    let of_balls = (0..model.element_count()).map(|j| {
        let (at, spin) = (model.layout().element(j), model.layout().spin(j));
        let r = model.pitch_radius() + q[at + 1];
        mass * (r * r * v[at + 2] + 0.4 * radius * radius * v[spin])
    });
    let around = |body: &str, mass: f64, [polar, transverse]: [f64; 2], speed: f64| {
        let [y, z, vy, vz] = ["y", "z", "vy", "vz"].map(|c| at(&format!("{body}.{c}")));
        let [a, b, da, db] =
            ["tilt_y", "tilt_z", "tilt_speed_y", "tilt_speed_z"].map(|c| at(&format!("{body}.{c}")));
        let (angle, turn) = (a.hypot(b), a * db - b * da);
        let share = if angle == 0.0 { 0.5 } else { 2.0 * (0.5 * angle).sin().powi(2) / (angle * angle) };
        let along = angle.cos();
        // Own angular velocity and that of the frame that does not spin, along the axis of the bearing.
        let across = share * turn * (1.0 + along);
        let own = speed;
        mass * (y * vz - z * vy) + transverse * across + polar * own * along
    };
    let cage_own = |body: &str| {
        let [a, b, da, db] =
            ["tilt_y", "tilt_z", "tilt_speed_y", "tilt_speed_z"].map(|c| at(&format!("{body}.{c}")));
        let angle = a.hypot(b);
        let share = if angle == 0.0 { 0.5 } else { 2.0 * (0.5 * angle).sin().powi(2) / (angle * angle) };
        // The frame turns about the axis of the cage, too.
        at(&format!("{body}.speed")) - share * (a * db - b * da)
    };
    // What the waves of a cage that bends add about its own axis.
    let waves = names.iter().any(|info| info.name == "cage.mode[2].a");
    let of_waves: f64 = (2..=ORDERS)
        .filter(|_| waves)
        .map(|order| {
            let n = f64::from(order);
            let [a, b, a_rate, b_rate] =
                ["a", "b", "a_rate", "b_rate"].map(|part| at(&format!("cage.mode[{order}].{part}")));
            let mass = 12.34e-3;
            mass * (a * b_rate - b * a_rate) / n
                - 0.5 * mass * (n * n - 3.0) * (a * a + b * b) * cage_own("cage")
        })
        .sum();
    let upright = at("cage.tilt_y").hypot(at("cage.tilt_z")).cos();
    of_balls.sum::<f64>()
        + around("inner_ring", 2.0, [4e-3, 3e-3], speed)
        + around("cage", 12.34e-3, [2.511e-5, 1.285e-5], cage_own("cage"))
        + upright * of_waves
}

/// The bearing of the second paper: balls that yield slow the whirl and rub the cage into a wobble.
#[test]
fn a_greased_cage_whirls_and_wobbles() {
    let axial = |force: f64| model(CAGED, &[("inner_ring.motion.space.load.x.constant", json!(force))]);
    let names = ["cage.whirl_speed", "cage.whirl_radius", "cage.tilt", "balls.orbit_ratio"];
    let [whirl, radius, tilt, orbit] = means(&axial(200.0), names, [0.12, 0.3]);
    assert!((-1750.0..-1450.0).contains(&whirl), "{whirl}");
    assert!((radius - 134e-6).abs() < 2e-6, "{radius}");
    assert!((3.5e-3..5.5e-3).contains(&tilt), "{tilt}");
    assert!((orbit - 1.0).abs() < 1e-3, "{orbit}");
    // Below an axial load nothing is caught.
    let [whirl, _, _, orbit] = means(&axial(50.0), names, [0.12, 0.3]);
    assert!(whirl.abs() < 100.0, "{whirl}");
    assert!((0.96..0.97).contains(&orbit), "{orbit}");
}

/// A cage that nothing touches wobbles forward as it nutates: its axis swings about its angular momentum at I_p w / I_t.
#[test]
fn the_wobble_of_a_free_cage_is_its_nutation() {
    let speed = 142.0;
    let changes = [
        ("gravity", Value::Null),
        ("cage.guide", Value::Null),
        ("cage.pocket", Value::Null),
        ("initial.cage_speed", json!(speed)),
        ("initial.cage_space", json!({"tilt_y": 1e-3, "tilt_speed_z": 1e-3 * speed * 2.511 / 1.285})),
        ("record", json!({"duration": 0.1, "interval": 1e-4})),
    ];
    let model = model(CAGED, &changes);
    let mut recording = Recording::default();
    recording.run(&mut Sim::new(model.clone()).unwrap(), 0.1, 1e-4, |_, _| true).unwrap();
    let wobble = MotionOfCage::of(&model, &recording, 0.0).unwrap().wobble.unwrap();
    let nutation = speed * 2.511 / 1.285;
    let found = wobble.speed.unwrap();
    assert_eq!(wobble.motion, CageMotion::ForwardWhirl, "{wobble:?}");
    assert!((found.mean / nutation - 1.0).abs() < 1e-4 && found.deviation < 1e-2, "{found:?} {nutation}");
    assert!((wobble.radius - 1e-3 * model.pitch_radius()).abs() < 1e-9, "{wobble:?}");
    assert_eq!(wobble.shares.unwrap()[CageMotion::ForwardWhirl as usize], 1.0);
}
