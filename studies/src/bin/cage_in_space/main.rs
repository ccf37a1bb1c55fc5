//! The cage of the second paper's bearing among balls that move: `make cage-in-space`.
//!
//! Prints tables; with `--docs` also those of `docs/results/cage-in-space.md`.

mod runs;

use cagedyn::scene::Signal;
use cagedyn::{CageMotion, Error, Result, Scene};
use cagedyn_studies::page::{self, Changes, Make, scene};
use cagedyn_studies::table::Table;
use runs::{Found, Run, all, starts};
use serde_json::{Value, json};
use std::f64::consts::TAU;

const LOAD: &str = "inner_ring.motion.space.load.x.constant";
const SPEED: &str = "inner_ring.speed.constant";
const POCKET: &str = "cage.pocket";
const FRICTION: &str = "cage.pocket.solid_cylinder.law.spring.friction.coefficient";
/// Diametral clearance of pocket and guide of the scene, m.
const CLEARANCES: [f64; 2] = [0.555e-3, 0.427e-3];
const BALLS: f64 = 25.0;
/// Starts from which a whirl may come.
const STARTS: u32 = 6;
/// Their distance from the centre, m: half of the radial clearance.
const START: f64 = 0.1e-3;

fn main() -> Result<()> {
    let tables: &[(&str, Make)] = &[
        ("load", load),
        ("speed", speed),
        ("pocket", pockets),
        ("land", lands),
        ("bending", bending),
        ("starts", share_of_starts),
        ("starts over speed", starts_over_speed),
        ("guided by balls", guided_by_balls),
        ("unbalance", unbalance),
        ("waves", waves),
    ];
    page::print("docs/results/cage-in-space.md", tables)
}

fn caged(changes: &Changes) -> Result<Scene> {
    scene("angular_contact_70_cage", changes)
}

/// Plane walls with these clearances along the orbit and along the axis, m.
fn planes(around: f64, along: f64) -> Value {
    let friction = json!({"coefficient": 0.1, "transition_speed": 0.01});
    let contact = json!({"stiffness": 1e6, "damping": 44.4, "softening_depth": 1e-6, "friction": friction});
    json!({"solid_plane": {"diametral_clearance": around, "axial_clearance": along, "contact": contact}})
}

/// Round pockets of this kind with the spring of the scene.
fn round(kind: &str, clearance: f64, along: Option<f64>) -> Value {
    let friction = json!({"coefficient": 0.1, "transition_speed": 0.01});
    let spring = json!({"stiffness": 1e6, "damping": 44.4, "softening_depth": 1e-6, "friction": friction});
    json!({ kind: {"diametral_clearance": clearance, "axial_clearance": along, "law": {"spring": spring}} })
}

fn rad_per_s(turns: f64) -> f64 {
    turns * TAU / 60.0
}

/// Whirl speed where it whirls for half of the time and more, else the class.
fn whirl(found: &Found) -> String {
    let shares = found.whirl.shares.unwrap_or_default();
    let of = |motion: CageMotion| shares[motion as usize];
    let whirling = of(CageMotion::ForwardWhirl) + of(CageMotion::BackwardWhirl);
    match found.whirl.speed {
        Some(speed) if whirling >= 0.5 => {
            let share = if whirling < 0.995 { format!(", {:.0} %", 100.0 * whirling) } else { String::new() };
            format!("{:.0}{share}", speed.mean)
        }
        _ if found.whirl.intermittent => format!("comes and goes, {:.0} %", 100.0 * whirling),
        _ => found.whirl.motion.name().to_owned(),
    }
}

fn radius(found: &Found) -> String {
    format!("{:.1}", 1e6 * found.whirl.radius)
}

fn tilt(found: &Found) -> String {
    format!("{:.2}", 1e3 * found.tilt)
}

fn orbit(found: &Found) -> String {
    found.orbit.map_or_else(String::new, |ratio| format!("{ratio:.3}"))
}

fn wobble(found: &Found) -> String {
    found.wobble.as_ref().map_or("none", |wobble| wobble.motion.name()).to_owned()
}

/// Results of scenes in their order; one that cannot be run is an error.
fn results(scenes: impl IntoIterator<Item = Result<Scene>>) -> Result<Vec<Found>> {
    let runs = scenes.into_iter().map(|scene| Ok(Run::new(scene?))).collect::<Result<Vec<Run>>>()?;
    all(&runs).into_iter().collect()
}

/// Whirl over the axial load, in round and plane pockets.
fn load(name: &str) -> Result<Table> {
    let head = [
        "axial load, N",
        "whirl, rad/s",
        "radius, um",
        "tilt, mrad",
        "wobble",
        "orbit over rolling",
        "plane walls: whirl",
        "tilt",
    ];
    let mut table = Table::new(name, &head);
    let loads = [50.0, 100.0, 200.0, 400.0, 687.0, 1000.0, 2000.0, 3000.0];
    let [around, _] = CLEARANCES;
    let plane = |load: f64| caged(&vec![(LOAD, json!(load)), (POCKET, planes(around, around))]);
    let found = results(loads.iter().flat_map(|load| [caged(&vec![(LOAD, json!(load))]), plane(*load)]))?;
    for (load, pair) in loads.iter().zip(found.chunks(2)) {
        let [round, plane] = pair else { continue };
        table.add([
            format!("{load:.0}"),
            whirl(round),
            radius(round),
            tilt(round),
            wobble(round),
            orbit(round),
            whirl(plane),
            tilt(plane),
        ]);
    }
    Ok(table)
}

/// Whirl over speed beside the cage in the plane among prescribed balls.
fn speed(name: &str) -> Result<Table> {
    let head = [
        "rev/min",
        "whirl, rad/s",
        "radius, um",
        "tilt, mrad",
        "plane walls: whirl",
        "in the plane: whirl",
        "radius",
    ];
    let mut table = Table::new(name, &head);
    let speeds = [1000.0, 1500.0, 2000.0, 3000.0, 5000.0, 8000.0];
    let [around, _] = CLEARANCES;
    let of = |turns: f64| {
        let start = [push(), vec![(SPEED, json!(rad_per_s(turns)))]].concat();
        let walls = [start.clone(), vec![(POCKET, planes(around, around))]].concat();
        [caged(&start), caged(&walls), scene("grease_guide", &start)]
    };
    let found = results(speeds.iter().flat_map(|turns| of(*turns)))?;
    for (turns, three) in speeds.iter().zip(found.chunks(3)) {
        let [round, walls, plane] = three else { continue };
        table.add([
            format!("{turns:.0}"),
            whirl(round),
            radius(round),
            tilt(round),
            whirl(walls),
            whirl(plane),
            radius(plane),
        ]);
    }
    Ok(table)
}

fn named(name: &str, what: &str, cases: Vec<(&str, Changes)>) -> Result<Table> {
    let mut table = Table::new(name, &[what, "whirl, rad/s", "radius, um", "tilt, mrad", "wobble"]);
    let found = results(cases.iter().map(|(_, changes)| caged(changes)))?;
    for ((what, _), found) in cases.iter().zip(&found) {
        table.add([(*what).to_owned(), whirl(found), radius(found), tilt(found), wobble(found)]);
    }
    Ok(table)
}

/// Shapes and plays of pockets.
fn pockets(name: &str) -> Result<Table> {
    let [c, _] = CLEARANCES;
    let pocket = |value: Value| vec![(POCKET, value)];
    named(
        name,
        "pocket, 687 N, 3000 rev/min",
        vec![
            ("round", vec![]),
            ("round, half of the play along the axis", pocket(round("solid_cylinder", c, Some(0.5 * c)))),
            ("round, twice the play along the axis", pocket(round("solid_cylinder", c, Some(2.0 * c)))),
            ("ball-shaped", pocket(round("solid_sphere", c, None))),
            ("square", pocket(planes(c, c))),
            ("square, a tenth of the play along the axis", pocket(planes(c, 0.1 * c))),
        ],
    )
}

/// Numbers and places of lands.
fn lands(name: &str) -> Result<Table> {
    let base = serde_json::to_value(caged(&vec![])?.cage.and_then(|cage| cage.guide))
        .map_err(|e| Error::new(cagedyn::Status::BadJson, e.to_string()))?;
    let lands = |places: &[f64], width: f64| -> Changes {
        let mut guide = base.clone();
        guide["film"]["lubricant_layer"]["land_width"] = json!(width);
        let land = |x: &f64| json!({"x": x, "width": width, "slices": 5, "guide": guide});
        let all: Vec<Value> = places.iter().map(land).collect();
        vec![("cage.guide", Value::Null), ("cage.space.lands", json!(all))]
    };
    let mut inner = base.clone();
    inner["ring"] = json!("inner_ring");
    inner["guide_radius"] = json!(43.1e-3);
    named(
        name,
        "lands, 687 N, 3000 rev/min",
        vec![
            ("one of 8 mm in the middle", vec![]),
            ("one of 8 mm whose solid contact is spread over its width", lands(&[0.0], 8e-3)),
            ("one of 8 mm, 4 mm off the middle", lands(&[4e-3], 8e-3)),
            ("two of 4 mm at 4 mm", lands(&[-4e-3, 4e-3], 4e-3)),
            ("two of 4 mm at 8 mm", lands(&[-8e-3, 8e-3], 4e-3)),
            ("two of 6.35 mm at 6 mm", lands(&[-6e-3, 6e-3], 6.35e-3)),
            ("one of 8 mm on the inner ring", vec![("cage.guide", inner)]),
        ],
    )
}

/// A ring that bends as that of the elastic scene in the plane, with waves up to an order, beside the rigid one and the plane.
fn bending(name: &str) -> Result<Table> {
    let head = [
        "cage",
        "axial load, N",
        "rev/min",
        "whirl, rad/s",
        "radius, um",
        "tilt, mrad",
        "wobble",
        "in the plane: whirl",
        "radius",
    ];
    let mut table = Table::new(name, &head);
    let elastic = scene("grease_guide_elastic", &vec![])?.cage.and_then(|cage| cage.elastic_ring);
    let elastic =
        serde_json::to_value(elastic).map_err(|e| Error::new(cagedyn::Status::BadJson, e.to_string()))?;
    let rows = [
        ("rigid", 0, 1.0, 200.0, 3000.0),
        ("EI x 1000, N = 4", 4, 1e3, 200.0, 3000.0),
        ("rigid", 0, 1.0, 687.0, 3000.0),
        ("EI x 1000, N = 4", 4, 1e3, 687.0, 3000.0),
        ("N = 2", 2, 1.0, 687.0, 3000.0),
        ("N = 4", 4, 1.0, 687.0, 3000.0),
        ("N = 6", 6, 1.0, 687.0, 3000.0),
        ("N = 4", 4, 1.0, 50.0, 3000.0),
        ("N = 4", 4, 1.0, 200.0, 3000.0),
        ("N = 4", 4, 1.0, 2000.0, 3000.0),
        ("N = 4", 4, 1.0, 687.0, 1500.0),
        ("N = 4", 4, 1.0, 687.0, 5000.0),
    ];
    let of = |(_, modes, stiffer, load, turns): &(&str, u32, f64, f64, f64)| {
        let mut ring = elastic.clone();
        ring["modes"] = json!(modes);
        ring["stiffness"]["bending"] =
            json!(stiffer * ring["stiffness"]["bending"].as_f64().unwrap_or(f64::NAN));
        let ring = if *modes == 0 { Value::Null } else { ring };
        let bends: Changes = vec![("cage.elastic_ring", ring), (SPEED, json!(rad_per_s(*turns)))];
        let start = [push(), bends].concat();
        [caged(&[start.clone(), vec![(LOAD, json!(load))]].concat()), scene("grease_guide", &start)]
    };
    for (row, two) in rows.iter().zip(results(rows.iter().flat_map(of))?.chunks(2)) {
        let ([found, plane], (what, _, _, load, turns)) = (two, row) else { continue };
        table.add([
            (*what).to_owned(),
            format!("{load:.0}"),
            format!("{turns:.0}"),
            whirl(found),
            radius(found),
            tilt(found),
            wobble(found),
            whirl(plane),
            radius(plane),
        ]);
    }
    Ok(table)
}

/// Share of starts from which a cage comes to whirl, backward and forward, in words.
fn shares(found: &[Result<Found>]) -> String {
    let class = |one: &Result<Found>| one.as_ref().ok().map(|found| found.whirl.motion);
    let of = |motion: CageMotion| found.iter().filter(|one| class(one) == Some(motion)).count();
    let [backward, forward] = [CageMotion::BackwardWhirl, CageMotion::ForwardWhirl].map(of);
    let forward = if forward > 0 { format!(", forward {forward}/{}", found.len()) } else { String::new() };
    format!("{backward}/{}{forward}", found.len())
}

fn share_of_starts(name: &str) -> Result<Table> {
    let ratios = [0.5, 0.9, 1.3, 2.0];
    let head: Vec<String> = std::iter::once("axial load, N".to_owned())
        .chain(ratios.map(|ratio| format!("c_p/c_g {ratio}")))
        .collect();
    let head: Vec<&str> = head.iter().map(String::as_str).collect();
    let mut table = Table::new(name, &head);
    for load in [50.0, 200.0, 687.0, 2000.0] {
        let mut runs = Vec::new();
        for ratio in ratios {
            let clearance = json!(ratio * CLEARANCES[1]);
            let changes =
                vec![(LOAD, json!(load)), ("cage.pocket.solid_cylinder.diametral_clearance", clearance)];
            runs.extend(starts(&caged(&changes)?, STARTS, START));
        }
        let found = all(&runs);
        let mut cells = found.chunks(STARTS as usize).map(shares);
        let mut cell = || cells.next().unwrap_or_default();
        table.add([format!("{load:.0}"), cell(), cell(), cell(), cell()]);
    }
    Ok(table)
}

fn starts_over_speed(name: &str) -> Result<Table> {
    let mut table =
        Table::new(name, &["rev/min", "687 N, round pockets", "plane walls", "200 N, round pockets"]);
    let [around, _] = CLEARANCES;
    for turns in [1000.0, 1500.0, 2000.0, 3000.0, 5000.0] {
        let speed = (SPEED, json!(rad_per_s(turns)));
        let mut runs = Vec::new();
        for more in [vec![], vec![(POCKET, planes(around, around))], vec![(LOAD, json!(200.0))]] {
            let scene = caged(&[vec![speed.clone()], more].concat())?;
            runs.extend(starts(&scene, STARTS, START));
        }
        let found = all(&runs);
        let mut cells = found.chunks(STARTS as usize).map(shares);
        let mut cell = || cells.next().unwrap_or_default();
        table.add([format!("{turns:.0}"), cell(), cell(), cell()]);
    }
    Ok(table)
}

/// A cage without lands, over the friction in its pockets, with and without weight.
fn guided_by_balls(name: &str) -> Result<Table> {
    let head = [
        "friction",
        "weightless: whirl, rad/s",
        "over the speed of the cage",
        "radius, um",
        "with weight: whirl",
        "radius",
    ];
    let mut table = Table::new(name, &head);
    let frictions = [0.05, 0.1, 0.2, 0.3, 0.4];
    let of = |friction: f64| {
        let heavy: Changes = vec![("cage.guide", Value::Null), (FRICTION, json!(friction))];
        let free = [heavy.clone(), vec![("gravity", Value::Null)], push()].concat();
        [caged(&free), caged(&heavy)]
    };
    let scenes = frictions.iter().flat_map(|friction| of(*friction));
    // Cages that rub hard take many small steps.
    let short = |scene: Result<Scene>| Ok(Run { until: 0.1, from: 0.05, ..Run::new(scene?) });
    let runs = scenes.map(short).collect::<Result<Vec<Run>>>()?;
    let found = all(&runs).into_iter().collect::<Result<Vec<Found>>>()?;
    for (friction, two) in frictions.iter().zip(found.chunks(2)) {
        let [free, heavy] = two else { continue };
        table.add([
            format!("{friction}"),
            whirl(free),
            over_cage(free),
            radius(free),
            whirl(heavy),
            radius(heavy),
        ]);
    }
    Ok(table)
}

/// Mean whirl speed over that of the cage.
fn over_cage(found: &Found) -> String {
    found.whirl.speed.map_or_else(String::new, |speed| format!("{:.2}", speed.mean / found.cage_speed))
}

/// A push from below that most whirls come from.
fn push() -> Changes {
    vec![
        ("initial.cage", json!({"y": 0.0, "z": -150e-6})),
        ("initial.cage_velocity", json!({"y": -0.25, "z": 0.0})),
    ]
}

/// Over the distance of the centre of mass from the middle: in grease, and in a dry guide at speed.
fn unbalance(name: &str) -> Result<Table> {
    let head = [
        "eccentricity of the mass, um",
        "grease, 3000 rev/min: whirl, rad/s",
        "radius, um",
        "tilt, mrad",
        "dry, 8000 rev/min: whirl",
        "over the speed of the cage",
        "radius, um",
        "tilt, mrad",
    ];
    let mut table = Table::new(name, &head);
    let sizes = [0.0, 20e-6, 50e-6, 100e-6, 200e-6, 500e-6, 1e-3];
    let of = |size: &f64| {
        let off: Changes = vec![("cage.mass_eccentricity", json!({"y": size, "z": 0.0}))];
        let dry: Changes = vec![
            ("cage.guide.film", Value::Null),
            ("cage.guide.film_share", Value::Null),
            (SPEED, json!(rad_per_s(8000.0))),
        ];
        [caged(&off), caged(&[off, dry].concat())]
    };
    for (size, two) in sizes.iter().zip(results(sizes.iter().flat_map(of))?.chunks(2)) {
        let [greased, dry] = two else { continue };
        table.add([
            format!("{:.0}", 1e6 * size),
            whirl(greased),
            radius(greased),
            tilt(greased),
            whirl(dry),
            over_cage(dry),
            radius(dry),
            tilt(dry),
        ]);
    }
    Ok(table)
}

/// Lines in the orbit of the cage that waves of the races make, at frequencies of kinematics.
fn waves(name: &str) -> Result<Table> {
    let head = ["waves of 2 um", "line, Hz", "amplitude, um", "nearby", "without waves"];
    let mut table = Table::new(name, &head);
    let wave = |order: f64| json!([{"order": order, "amplitude": 2e-6, "phase": 0.0}]);
    let orders = [BALLS - 1.0, BALLS + 1.0, 10.0];
    // Without a whirl, whose scatter would cover them.
    let light = || (LOAD, json!(50.0));
    let of = |ring: &'static str| move |order: &f64| caged(&vec![light(), (ring, wave(*order))]);
    let inner = orders.iter().map(of("inner_ring.waviness"));
    let outer = orders.iter().map(of("outer_ring.waviness"));
    let smooth = caged(&vec![light()])?;
    let turns = match &smooth.inner_ring.as_ref().map(|ring| &ring.speed) {
        Some(Signal::Constant(speed)) => speed / TAU,
        _ => f64::NAN,
    };
    let found = results(std::iter::once(Ok(smooth)).chain(inner).chain(outer))?;
    let [smooth, rest @ ..] = &found[..] else { return Ok(table) };
    for (k, found) in rest.iter().enumerate() {
        let (order, on_inner) = (orders[k % orders.len()], k < orders.len());
        // Waves of order n push ball k by cos(n (psi_k - Omega t)): only n = m Z +- 1 pushes the whole cage, round with m Z f_c -+ n f.
        let ring = if on_inner { turns } else { 0.0 };
        let sense = if order > BALLS { -1.0 } else { 1.0 };
        let line = |found: &Found| sense * (BALLS * found.cage_speed / TAU - order * ring);
        let [amplitude, nearby] = found.line(line(found));
        let [without, _] = smooth.line(line(smooth));
        table.add([
            format!("order {order:.0} of the {} race", if on_inner { "inner" } else { "outer" }),
            format!("{:.1}", line(found)),
            format!("{:.3}", 1e6 * amplitude),
            format!("{:.3}", 1e6 * nearby),
            format!("{:.3}", 1e6 * without),
        ]);
    }
    Ok(table)
}
