//! The NU2310 of the first paper with rollers in the plane and with rollers that skew and tilt: `make roller-space`.
//!
//! Prints tables; with `--docs` also those of `docs/results/roller-space.md`.

mod runs;

use cagedyn::{Result, Scene};
use cagedyn_studies::page::{self, Changes, Make, scene};
use cagedyn_studies::table::Table;
use runs::{Case, Found, STARTS, all};
use serde_json::{Value, json};
use std::f64::consts::TAU;

const PAGE: &str = "docs/results/roller-space.md";
const SPEED: &str = "inner_ring.speed.constant";
const CLEARANCE: &str = "inner_ring.radial_clearance";
const TILT: &str = "inner_ring.motion.space.tilt_y";
/// The largest slip of a roller in the paper, %.
const SLIP_OF_PAPER: &str = "22";
/// Load of the roller that carries most at a quarter of the static rating of 131 kN, N: that times 5/Z.
const DESIGN_LOAD: f64 = 131e3 / 4.0 * 5.0 / 12.0;
/// Contact length of the rollers, m.
const LENGTH: f64 = 0.0204;

/// A column: its head, what turns a result into its unit, how many decimals it has.
type Column = (&'static str, fn(&Found) -> f64, usize);

const Y: Column = ("y", |f| f.y, 2);
const Z: Column = ("z", |f| f.z, 2);
const SLIP: Column = ("largest slip, %", |f| 100.0 * f.slip, 1);
const SIGNED_SKEW: Column = ("mean skew of loaded rollers, mrad", |f| 1e3 * f.skew_by_load[0], 2);
/// Which way loaded rollers skew is an accident in a symmetric bearing, so that only the size of their mean counts.
const SKEW_OF_LOADED: Column =
    ("size of the mean skew of loaded rollers, mrad", |f| 1e3 * f.skew_by_load[0].abs(), 2);
const SKEW: Column = ("skew, standard deviation, mrad", |f| 1e3 * f.skew[1], 2);
const LARGEST_SKEW: Column = ("largest skew, mrad", |f| 1e3 * f.skew[2], 1);
const TILT_SPREAD: Column = ("tilt, standard deviation, mrad", |f| 1e3 * f.tilt[0], 3);
const LARGEST_TILT: Column = ("largest tilt, mrad", |f| 1e3 * f.tilt[1], 2);
const LOSSES: Column = ("friction of contacts, W", |f| f.losses, 1);
const RIB_LOSSES: Column = ("of ribs, W", |f| f.rib_losses, 2);
const POCKET: Column = ("95 % of pocket forces, N", |f| f.pocket_force, 0);

fn main() -> Result<()> {
    let tables: &[(&str, Make)] = &[
        ("plane and space", plane_and_space),
        ("fig9", fig9),
        ("fig10", fig10),
        ("end play", end_play),
        ("profile", profiles),
        ("slices", slices),
        ("misalignment", misalignment),
        ("thrust", thrust),
    ];
    page::print(PAGE, tables)
}

fn in_space(changes: &Changes) -> Result<Scene> {
    scene("nu2310_space", changes)
}

/// The NU2310 in the plane and in space with this clearance (m), load (N) and speed (1/min).
fn pair(clearance: f64, load: f64, speed: f64) -> Result<[Scene; 2]> {
    let of = |name: &str, path: &'static str| {
        let turning = json!(-speed * TAU / 60.0);
        scene(name, &vec![(CLEARANCE, json!(clearance)), (path, json!(-load)), (SPEED, turning)])
    };
    Ok([
        of("nu2310", "inner_ring.motion.free.load.z.constant")?,
        of("nu2310_space", "inner_ring.motion.space.load.z.constant")?,
    ])
}

/// "30.3 ± 0.4": mean and deviation among the starts.
fn told(case: &Case, (_, value, decimals): Column) -> Result<String> {
    let scatter = case.of(value)?;
    let text = format!("{:.decimals$} ± {:.decimals$}", scatter.mean, scatter.deviation);
    // A mean that rounds to zero has no sign.
    let zero = format!("-{:.decimals$}", 0.0);
    Ok(text.strip_prefix(&zero).map_or(text.clone(), |rest| format!("{:.decimals$}{rest}", 0.0)))
}

/// One row for each scene, one column for each of these.
fn rows(name: &str, what: &str, cases: Vec<(String, Result<Scene>)>, columns: &[Column]) -> Result<Table> {
    let heads: Vec<&str> = [what].into_iter().chain(columns.iter().map(|(head, ..)| *head)).collect();
    let mut table = Table::new(name, &heads);
    let (labels, scenes): (Vec<String>, Vec<Result<Scene>>) = cases.into_iter().unzip();
    let scenes = scenes.into_iter().collect::<Result<Vec<Scene>>>()?;
    for (label, case) in labels.into_iter().zip(all(&scenes)) {
        let cells = columns.iter().map(|column| told(&case, *column));
        table.lines.push([Ok(label)].into_iter().chain(cells).collect::<Result<_>>()?);
    }
    Ok(table)
}

/// The scenes as they are.
fn plane_and_space(name: &str) -> Result<Table> {
    let mut table = Table::new(name, &["40 um, 4900 N, 3000 rev/min", "in the plane", "in space"]);
    let cases = all(&pair(40e-6, 4900.0, 3000.0)?);
    for column in [Y, Z, SLIP, LOSSES, POCKET] {
        table.add([column.0.to_owned(), told(&cases[0], column)?, told(&cases[1], column)?]);
    }
    for column in [RIB_LOSSES, SKEW, LARGEST_SKEW, TILT_SPREAD, LARGEST_TILT, SKEW_OF_LOADED] {
        table.add([column.0.to_owned(), String::new(), told(&cases[1], column)?]);
    }
    let positive = cases[1].0.iter().flatten().filter(|found| found.skew_by_load[0] > 0.0).count();
    let what = format!("starts in which that is positive, of {STARTS}");
    table.add([what, String::new(), positive.to_string()]);
    Ok(table)
}

/// The conditions of the paper's Fig. 9.
fn fig9(name: &str) -> Result<Table> {
    let head = [
        "Fig. 9: clearance, load, speed",
        "plane: y",
        "z",
        "largest slip, %",
        "space: y",
        "z",
        "largest slip, %",
        "skew, standard deviation, mrad",
        "largest",
    ];
    let mut table = Table::new(name, &head);
    let (mut labels, mut scenes) = (Vec::new(), Vec::new());
    for clearance in [40e-6, 5e-6] {
        for load in [980.0, 4900.0] {
            for speed in [1000.0, 3000.0, 5000.0] {
                labels.push(format!("{:.0} um, {load:.0} N, {speed:.0} rev/min", 1e6 * clearance));
                scenes.extend(pair(clearance, load, speed)?);
            }
        }
    }
    for (label, cases) in labels.into_iter().zip(all(&scenes).chunks(2)) {
        let planar = [Y, Z, SLIP].map(|column| told(&cases[0], column));
        let spatial = [Y, Z, SLIP, SKEW, LARGEST_SKEW].map(|column| told(&cases[1], column));
        let cells = [Ok(label)].into_iter().chain(planar).chain(spatial);
        table.lines.push(cells.collect::<Result<_>>()?);
    }
    Ok(table)
}

/// What the paper's Fig. 10 shows of one roller.
fn fig10(name: &str) -> Result<Table> {
    let head = ["Fig. 10: 5 um, 4900 N, 3000 rev/min", "paper", "in the plane", "in space"];
    let mut table = Table::new(name, &head);
    let cases = all(&pair(5e-6, 4900.0, 3000.0)?);
    let percent: [(&str, &str, Column); 5] = [
        ("largest slip, %", SLIP_OF_PAPER, SLIP),
        (
            "mean slip within 20 degrees behind the load zone, %",
            "grows in the unloaded zone",
            ("", |f| 100.0 * f.slip_by_place[0], 1),
        ),
        ("within 20 degrees before it, %", "", ("", |f| 100.0 * f.slip_by_place[1], 1)),
        (
            "within 20 degrees of the bottom, %",
            "the theoretical speed",
            ("", |f| 100.0 * f.slip_by_place[2], 1),
        ),
        (
            "unloaded rollers in the back half of their pockets, %",
            "towards the back",
            ("", |f| 100.0 * f.back, 0),
        ),
    ];
    for (what, paper, column) in percent {
        table.add([what.to_owned(), paper.to_owned(), told(&cases[0], column)?, told(&cases[1], column)?]);
    }
    Ok(table)
}

const OF_VARIED: [Column; 9] =
    [Y, Z, SLIP, SKEW_OF_LOADED, SKEW, LARGEST_SKEW, TILT_SPREAD, LOSSES, RIB_LOSSES];

fn end_play(name: &str) -> Result<Table> {
    let cases = [10, 20, 35, 50, 70, 100]
        .map(|play| (play.to_string(), in_space(&vec![("ribs.end_play", json!(1e-6 * f64::from(play)))])));
    rows(name, "end play, um", cases.into(), &OF_VARIED)
}

fn profiles(name: &str) -> Result<Table> {
    const PROFILE: &str = "rollers.profile";
    let logarithm = json!({"logarithmic": {"design_load": DESIGN_LOAD, "end_drop": 12e-6}});
    let crown = |drop: f64| json!({"circular_crown": {"radius": LENGTH * LENGTH / (8.0 * drop)}});
    let of = |label: &str, profile: Value| (label.to_owned(), in_space(&vec![(PROFILE, profile)]));
    let cases = vec![
        ("straight".to_owned(), in_space(&Vec::new())),
        of("logarithm for 13.6 kN, drop of 12 um", logarithm),
        of("crown of 2 um", crown(2e-6)),
        of("crown of 5 um", crown(5e-6)),
    ];
    rows(name, "rollers", cases, &OF_VARIED)
}

fn slices(name: &str) -> Result<Table> {
    let cases = [2, 4, 8, 16].map(|n| (n.to_string(), in_space(&vec![("raceways.slices", json!(n))])));
    rows(name, "slices", cases.into(), &OF_VARIED)
}

fn misalignment(name: &str) -> Result<Table> {
    let cases = [0.0, 0.5, 1.0, 2.0, 3.0].map(|tilt| {
        let held = json!({"held": 1e-3 * tilt});
        let straight = ("inner_ring.motion.space.tilt_z", json!({"held": 0.0}));
        (tilt.to_string(), in_space(&vec![(TILT, held), straight]))
    });
    let columns = OF_VARIED.map(|column| if column.0 == SKEW_OF_LOADED.0 { SIGNED_SKEW } else { column });
    rows(name, "inner ring tilted about y, mrad", cases.into(), &columns)
}

/// An NJ bearing: both ribs of the outer ring and that of the inner one at -x, whose thrust they carry.
fn thrust(name: &str) -> Result<Table> {
    let rib = |ring: &str, side: &str| json!({"ring": ring, "side": side, "angle": 0.01, "height": 0.0025});
    let ribs = json!([rib("inner", "negative"), rib("outer", "positive"), rib("outer", "negative")]);
    let cases = [0.0, 100.0, 200.0, 500.0, 1000.0].map(|force| {
        let changes = vec![
            ("ribs.list", ribs.clone()),
            ("inner_ring.motion.space.x", json!("free")),
            ("inner_ring.motion.space.load.x", json!({"constant": force})),
        ];
        (format!("{force:.0}"), in_space(&changes))
    });
    let columns: [Column; 9] = [
        SIGNED_SKEW,
        ("of others", |f| 1e3 * f.skew_by_load[1], 2),
        SKEW,
        LARGEST_SKEW,
        TILT_SPREAD,
        Z,
        SLIP,
        LOSSES,
        RIB_LOSSES,
    ];
    rows(name, "NJ: thrust on the inner ring, N", cases.into(), &columns)
}
