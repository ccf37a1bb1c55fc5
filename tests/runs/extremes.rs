//! Extremes and integrals between records, and what is a share of the clearance.

use crate::common::example_with;
use cagedyn::{Interval, Model, Recording, Result, Scene, Sim, Status};
use serde_json::{Value, json};
use std::f64::consts::PI;
use std::sync::Arc;

fn model(set: &[(&str, Value)]) -> Result<Model> {
    Model::new(Scene::from_value(&example_with(set))?)
}

fn sim(set: &[(&str, Value)]) -> Sim {
    let sim = model(set).and_then(|model| Sim::new(Arc::new(model)));
    sim.unwrap_or_else(|e| panic!("{e}"))
}

fn channel(sim: &Sim, name: &str) -> usize {
    sim.channels().iter().position(|c| c.name == name).unwrap_or_else(|| panic!("no {name}"))
}

/// Records never change the steps, so what happens between two times does not depend on them.
#[test]
fn extremes_do_not_depend_on_the_interval_of_records() {
    let window = |interval: f64, at: &[f64]| -> Vec<Interval> {
        let mut sim = sim(&[]);
        let mut recording = Recording::default();
        recording.run(&mut sim, 0.04, interval, |_, _| true).unwrap();
        assert_eq!(recording.intervals.len(), 12);
        assert!(recording.intervals.iter().all(|column| column.len() == recording.times.len()));
        let recording = &recording;
        at.iter().flat_map(|from| (0..12).map(move |j| recording.interval(j, from - 1e-9).unwrap())).collect()
    };
    let (from, mut sampled) = ([0.0, 0.03], Vec::new());
    let finest = window(2e-6, &from);
    for interval in [5e-4, 1e-4] {
        for (coarse, fine) in window(interval, &from).iter().zip(&finest) {
            assert!((coarse.from - fine.from).abs() < 1e-12 && (coarse.to - fine.to).abs() < 1e-12);
            assert_eq!((coarse.min, coarse.max), (fine.min, fine.max));
            let size = fine.max - fine.min;
            assert!((coarse.mean - fine.mean).abs() <= 1e-12 * size, "{coarse:?} {fine:?}");
            assert!((coarse.integral - fine.integral).abs() <= 1e-12 * size * 0.04, "{coarse:?} {fine:?}");
            assert!((coarse.positive - fine.positive).abs() <= 1e-12 * size * 0.04, "{coarse:?} {fine:?}");
        }
        let mut sim = sim(&[]);
        let mut recording = Recording::default();
        recording.run(&mut sim, 0.04, interval, |_, _| true).unwrap();
        let of = |j: usize| &recording.columns[channel(&sim, &format!("roller[{j}].pocket_force"))];
        let largest = |j: usize| of(j).iter().fold(0.0, |m: f64, x| m.max(x.abs()));
        sampled.push((0..12).map(largest).collect::<Vec<_>>());
    }
    // Records alone see less of the peaks of most rollers.
    let peaks = finest[..12].iter().map(|all| all.max.max(-all.min));
    for sampled in sampled {
        let missed = sampled.iter().zip(peaks.clone()).filter(|(seen, peak)| **seen < 0.99 * peak).count();
        assert!(missed >= 6, "{sampled:?}");
    }
}

/// The cage turns by exactly what pockets and guide gave it, in every method.
#[test]
fn integrals_are_the_impulses_that_were_given() {
    for (method, allowed) in [
        (json!({"leapfrog": {}}), 1e-9),
        (json!({"auto": {}}), 1e-4),
        (json!({"dormand_prince": {"tolerance": 1e-8}}), 1e-3),
        (json!({"adams": {"tolerance": 1e-8}}), 1e-3),
        (json!({"rosenbrock": {"tolerance": 1e-7}}), 1e-3),
        (json!({"radau": {"tolerance": 1e-7}}), 1e-3),
    ] {
        let extremes = json!(["pocket.moment", "guide.moment", "*.pocket_force"]);
        let set = [("record.extremes", extremes), ("solver.method", method.clone())];
        let mut sim = sim(&set);
        let inertia = sim.model().scene().cage.as_ref().unwrap().inertia;
        let speed = channel(&sim, "cage.speed");
        let moments = ["pocket.moment", "guide.moment"].map(|name| channel(&sim, name));
        for k in 1..=4 {
            let before = sim.output(speed).unwrap();
            sim.begin_interval();
            sim.advance_to(2.3e-3 * f64::from(k)).unwrap();
            let [pockets, guide] = moments.map(|i| sim.interval(i).unwrap());
            let gained = inertia * (sim.output(speed).unwrap() - before);
            let size = 2.3e-3 * pockets.max.max(-pockets.min).max(guide.max);
            let error = (pockets.integral + guide.integral - gained).abs() / size;
            assert!(error < allowed, "{method}, interval {k}: {error:e} of {size}");
        }
    }
}

/// In developed motion what the pockets give on average is what the guide takes but for what the cage still gains, which is
/// not true of the mean of sampled forces.
#[test]
fn means_of_forces_balance() {
    for preset in ["draft", "engineering"] {
        let extremes = json!(["pocket.moment", "guide.moment"]);
        let mut sim = sim(&[("record.extremes", extremes), ("solver.preset", json!(preset))]);
        let moments = ["pocket.moment", "guide.moment"].map(|name| channel(&sim, name));
        let speed = channel(&sim, "cage.speed");
        sim.advance_to(0.02).unwrap();
        sim.begin_interval();
        let before = sim.output(speed).unwrap();
        sim.advance_to(0.12).unwrap();
        let gained =
            sim.model().scene().cage.as_ref().unwrap().inertia * (sim.output(speed).unwrap() - before);
        let [pockets, guide] = moments.map(|i| sim.interval(i).unwrap().mean);
        assert!(
            (pockets + guide - gained / 0.1).abs() < 1e-4 * guide,
            "{preset}: {pockets} {guide} {gained}"
        );
        assert!((pockets / guide + 1.0).abs() < 0.02, "{preset}: {pockets} {guide}");
    }
}

#[test]
fn only_what_is_watched_has_intervals() {
    let mut sim = sim(&[]);
    let slip = channel(&sim, "roller[0].slip");
    let e = sim.interval(slip).unwrap_err();
    assert_eq!(e.status, Status::BadValue);
    assert!(e.message.contains("roller[0].slip") && e.message.contains("record.extremes"), "{e}");
    assert_eq!(sim.interval(10_000).unwrap_err().status, Status::BadIndex);
    // Of no time it is the present value.
    let force = channel(&sim, "roller[0].pocket_force");
    sim.advance_to(1e-3).unwrap();
    sim.begin_interval();
    let (now, value) = (sim.interval(force).unwrap(), sim.output(force).unwrap());
    assert_eq!((now.min, now.max, now.mean, now.integral), (value, value, value, 0.0));
    // A new state begins a new interval.
    let state = sim.state().to_vec();
    sim.advance_to(2e-3).unwrap();
    assert_eq!(sim.interval(force).unwrap().from, 1e-3);
    sim.set_state(5e-3, &state).unwrap();
    assert_eq!(sim.interval(force).unwrap().from, 5e-3);
}

#[test]
fn channels_are_chosen_by_patterns() {
    let names = |set: &[(&str, Value)]| {
        let model = model(set)?;
        let all = model.channels();
        Ok::<_, cagedyn::Error>(
            [model.recorded(), model.watched()]
                .map(|places| places.iter().map(|i| all[*i].name.clone()).collect::<Vec<_>>()),
        )
    };
    let [recorded, watched] = names(&[]).unwrap();
    assert!(recorded.len() > 100 && watched.len() == 12);
    let chosen = [
        ("record.channels", json!(["roller[?].slip", "cage.y"])),
        ("record.extremes", json!(["guide.*", "roller[11].*_force"])),
    ];
    let [recorded, watched] = names(&chosen).unwrap();
    assert_eq!(recorded.len(), 11);
    assert_eq!(recorded[0], "cage.y");
    for name in ["guide.moment", "guide.minimum_film", "roller[11].inner_force", "roller[11].pocket_force"] {
        assert!(watched.iter().any(|other| other == name), "{name} of {watched:?}");
    }
    let [_, none] = names(&[("record.extremes", json!([]))]).unwrap();
    assert!(none.is_empty());
    for (path, pattern, text) in [
        ("record.channels", "cage.x*", "no channel of this scene is named 'cage.x*'"),
        ("record.extremes", "*.slip", "'*.slip' cannot be followed in every step"),
    ] {
        let e = names(&[(path, json!(["cage.*", pattern]))]).unwrap_err();
        assert_eq!(e.status, Status::BadScene);
        assert!(e.message.starts_with(&format!("{path}.1: ")) && e.message.contains(text), "{e}");
    }
}

/// A cage on a ring that hangs in its clearance.
fn on_inner_ring() -> Vec<(&'static str, Value)> {
    vec![
        ("cage.guide.ring", json!("inner_ring")),
        ("cage.guide.guide_radius", json!(0.0345)),
        ("inner_ring.radial_clearance", json!(120e-6)),
        ("cage.guide.diametral_clearance", json!(2e-4)),
    ]
}

#[test]
fn shares_of_the_clearance_are_seen_from_the_guide() {
    let mut sim = sim(&on_inner_ring());
    sim.advance_to(5e-3).unwrap();
    let clearance = sim.model().guide_clearance().unwrap();
    let names = ["cage.y", "cage.z", "inner_ring.y", "inner_ring.z", "cage.y_ratio", "cage.z_ratio"];
    let [y, z, ring_y, ring_z, y_ratio, z_ratio] = names.map(|name| {
        let i = channel(&sim, name);
        sim.output(i).unwrap()
    });
    let i = channel(&sim, "cage.eccentricity");
    let eccentricity = sim.output(i).unwrap();
    assert!(ring_z < -50e-6, "{ring_z}");
    assert!((y_ratio - (y - ring_y) / clearance).abs() < 1e-12);
    assert!((z_ratio - (z - ring_z) / clearance).abs() < 1e-12);
    assert!((y_ratio.hypot(z_ratio) - eccentricity).abs() < 1e-12);
}

#[test]
fn cages_start_in_the_centre_of_their_guide_and_are_checked_against_it() {
    let mut set = on_inner_ring();
    let start = |set: &[(&str, Value)]| model(set)?.initial_state();
    let state = start(&set).unwrap();
    let (ring, cage) = ([state[0], state[1]], [state[2], state[3]]);
    assert!(ring[1] < -60e-6, "{ring:?}");
    assert!((0..2).all(|k| (cage[k] - ring[k]).abs() < 1e-15), "{ring:?} {cage:?}");
    // In the centre of the bearing it is half of the clearance away, which is allowed; well beyond it is not.
    set.push(("initial.cage", json!({"y": 0.0, "z": 0.0})));
    assert!(start(&set).is_ok());
    set.pop();
    for z in [50e-6, -180e-6] {
        set.push(("initial.cage", json!({"y": 0.0, "z": z})));
        let e = start(&set).unwrap_err();
        assert!(e.message.starts_with("initial.cage: ") && e.message.contains("guide"), "{z}: {e}");
        set.pop();
    }
    // A place below the bearing's centre that is in the middle of the ring.
    set.push(("initial.cage", json!({"y": 0.0, "z": -140e-6})));
    assert!(start(&set).is_ok());
}

#[test]
fn a_cage_starts_no_nearer_to_its_ring_than_its_pockets_let_it() {
    let mut set = on_inner_ring();
    // Edges that reach into the rollers when the cage is more than 25 um off the centre of the bearing.
    let pocket = "cage.pocket.lubricated_cylinder";
    let (clearance, half_angle) = (format!("{pocket}.radial_clearance"), format!("{pocket}.half_angle"));
    set.push((clearance.as_str(), json!(10e-6)));
    set.push((half_angle.as_str(), json!(0.5)));
    let state = model(&set).unwrap().initial_state().unwrap();
    let (ring, cage) = ([state[0], state[1]], [state[2], state[3]]);
    let (far, near) = (ring[0].hypot(ring[1]), cage[0].hypot(cage[1]));
    assert!(far > 60e-6 && near < 25e-6 && near > 10e-6, "{ring:?} {cage:?}");
    assert!((ring[0] * cage[1] - ring[1] * cage[0]).abs() < 1e-9 * far * near);
    // The same place is refused where it is asked for.
    set.push(("initial.cage", json!({"y": ring[0], "z": ring[1]})));
    let e = model(&set).and_then(|model| model.initial_state()).unwrap_err();
    assert!(e.message.contains("pocket edges"), "{e}");
}

/// What is left out of records unless it is named: stress and losses of every raceway contact.
#[test]
fn contacts_show_traction_pressure_and_sliding_power() {
    let mut sim = sim(&[]);
    sim.advance_to(5e-3).unwrap();
    let scene = sim.model().scene().clone();
    let rollers = scene.rollers.as_ref().unwrap();
    let (mut loaded, all) = (0, sim.channels().len());
    for (ring, radius) in [("outer", -47.5e-3), ("inner", sim.model().inner_raceway_radius().unwrap())] {
        for j in 0..12 {
            let mut out = vec![0.0; all];
            sim.outputs(&mut out).unwrap();
            let [load, pressure, power, traction] =
                ["force", "pressure", "sliding_power", "traction"].map(|what| {
                    let i = channel(&sim, &format!("roller[{j}].{ring}_{what}"));
                    assert_eq!(sim.model().recorded().contains(&i), what == "force");
                    out[i]
                });
            // Half width b and pressure of Hertz, of steel on steel.
            let compliance = 2.0 * (1.0 - 0.09) / 206e9;
            let reduced = 1.0 / (1.0 / rollers.radius + 1.0 / radius);
            let b = (4.0 * load * reduced * compliance / (PI * rollers.effective_length)).sqrt();
            let hertz = if b > 0.0 { 2.0 * load / (PI * b * rollers.effective_length) } else { 0.0 };
            assert!((pressure - hertz).abs() <= 1e-9 * hertz, "{ring} {j}: {pressure} {hertz}");
            assert!(power >= 0.0 && traction.is_finite());
            loaded += usize::from(pressure > 1e8);
        }
    }
    assert!(loaded > 4, "{loaded}");
}

#[test]
fn pockets_show_them_too() {
    let set = [("solver.method", json!({"dormand_prince": {"tolerance": 1e-6}}))];
    let mut sim = sim(&set);
    let names = sim.model().contact_names();
    let scene = sim.model().scene().clone();
    let (rollers, mut touched) = (scene.rollers.as_ref().unwrap(), 0);
    for k in 1..=40 {
        sim.advance_to(2.5e-4 * f64::from(k)).unwrap();
        let contacts = sim.forces().unwrap().contacts.clone();
        for (i, name) in names.iter().enumerate().filter(|(_, name)| name.contains("pocket")) {
            let [pressure, power, traction] = ["pressure", "sliding_power", "traction"].map(|what| {
                let i = channel(&sim, &format!("{name}_{what}"));
                sim.output(i).unwrap()
            });
            let (load, friction, slip) = (contacts[i][0], contacts[i][6], contacts[i][10]);
            assert_eq!((traction, power), (friction, (friction * slip).abs()), "{name}");
            // Steel in brass, conformal.
            let compliance = (1.0 - 0.09) / 206e9 + (1.0 - 0.34 * 0.34) / 103e9;
            let curvature = 1.0 / rollers.radius - 1.0 / (rollers.radius + 0.15e-3);
            let hertz = (load * curvature / (PI * compliance * rollers.effective_length)).sqrt();
            assert!((pressure - hertz).abs() <= 1e-9 * hertz, "{name}: {pressure} {hertz}");
            touched += usize::from(load > 0.0);
        }
    }
    assert!(touched > 5, "{touched}");
}
