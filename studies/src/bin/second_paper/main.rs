//! What an elastic cage and a heat balance make of the whirl of the second paper, and an elastic cage of the first paper's bearing:
//! `make second-paper`.
//!
//! Prints tables; with `--docs` also those of `docs/results/second-paper.md`.

mod motion;

use cagedyn::heat::HeatBalance;
use cagedyn::whirl::onset;
use cagedyn::{Model, Result, Scene};
use cagedyn_studies::table::Table;
use clap::Parser;
use motion::{Whirl, whirl_of};
use std::f64::consts::TAU;
use std::path::Path;

#[derive(Parser)]
#[command(about)]
struct Arguments {
    /// Also write the tables into docs/results/second-paper.md.
    #[arg(long)]
    docs: bool,
}

/// Speeds of the inner ring, 1/min.
const SPEEDS: [f64; 6] = [500.0, 1000.0, 2000.0, 3000.0, 5000.0, 8000.0];
/// Highest order of the waves in the comparison of models.
const WAVES: &str = "6";
/// The elastic ring of the phenolic cage as a block for scenes that have none.
const RING: &str = r#"{"modes": 6, "neutral_radius": 45.081e-3, "stiffness": {"bending": 0.2572}, "damping": 0.03, "growth": 1.40e-11}"#;

fn main() -> Result<()> {
    let arguments = Arguments::parse();
    let tables = [models()?, sensitivity()?, level()?, starts()?, brass()?];
    for table in &tables {
        println!("{}\n{}", table.name, table.text());
    }
    if arguments.docs {
        let texts = tables.iter().map(|table| (table.name.as_str(), table.text()));
        cagedyn_studies::write_tables(Path::new("docs/results/second-paper.md"), texts)?;
    }
    Ok(())
}

/// A scene with changes.
fn scene(name: &str, changes: &[(&str, &str)]) -> Result<Scene> {
    let path = format!("scenes/{name}.json");
    let text =
        std::fs::read_to_string(&path).map_err(|e| cagedyn_studies::file_error(Path::new(&path), e))?;
    Scene::from_json_with(&text, changes.iter().copied())
}

fn shown(whirl: &Whirl) -> String {
    if whirl.turns < 1.0 {
        return "no whirl".to_owned();
    }
    let scatter = if whirl.scatter > 30.0 { format!(" ± {:.0}", whirl.scatter) } else { String::new() };
    format!("{:.0}{scatter}; {:.2}", whirl.speed, whirl.eccentricity)
}

/// Whirl over speed by four models.
fn models() -> Result<Table> {
    let head =
        ["rev/min", "rigid, 313 K", "rigid, heat", "film, K", "elastic, 313 K", "elastic, heat", "film, K"];
    let mut table = Table::new("models", &head);
    for turns in SPEEDS {
        let speed = format!("{:?}", turns * TAU / 60.0);
        let speed = ("inner_ring.speed.constant", speed.as_str());
        let push = [
            ("initial.cage", r#"{"y": 0.0, "z": -150e-6}"#),
            ("initial.cage_velocity", r#"{"y": -0.25, "z": 0.0}"#),
        ];
        let rigid = whirl_of(&scene("grease_guide", &[speed, push[0], push[1]])?)?;
        let elastic =
            whirl_of(&scene("grease_guide_elastic", &[speed, ("cage.elastic_ring.modes", WAVES)])?)?;
        let heat = |changes: &[(&str, &str)]| {
            let mut heat = HeatBalance::new(Model::new(scene("grease_guide_heat", changes)?)?)?;
            let film = heat.settle()?.temperatures[0];
            Ok::<_, cagedyn::Error>((whirl_of(heat.model().scene())?, film))
        };
        let (warm, film) = heat(&[speed, push[0], push[1]])?;
        let sources = r#"[{"power": "guide_film", "node": "film"}, {"power": "guide_solid", "node": "film"}, {"power": "cage_bending", "node": "cage"}]"#;
        let both = heat(&[speed, push[0], push[1], ("cage.elastic_ring", RING), ("heat.sources", sources)]);
        let (both, both_film) = match both {
            Ok((whirl, film)) => (shown(&whirl), format!("{film:.1}")),
            Err(error) => (error.message, "-".to_owned()),
        };
        table.add([
            format!("{turns:.0}"),
            shown(&rigid),
            shown(&warm),
            format!("{film:.1}"),
            shown(&elastic),
            both,
            both_film,
        ]);
        eprintln!("{turns} 1/min");
    }
    Ok(table)
}

/// What changes the whirl of the elastic cage at 3000 1/min.
fn sensitivity() -> Result<Table> {
    let mut table = Table::new(
        "sensitivity",
        &["elastic cage, 3000 rev/min, 313 K", "whirl, rad/s; eccentricity over clearance"],
    );
    let waves = ("cage.elastic_ring.modes", WAVES);
    let oval = r#"[{"order": 2, "amplitude": 20e-6, "phase": 0.0}]"#;
    let lobes = r#"[{"order": 5, "amplitude": 10e-6, "phase": 0.0}]"#;
    for (name, changes) in [
        ("waves up to order 2", vec![("cage.elastic_ring.modes", "2")]),
        ("4", vec![("cage.elastic_ring.modes", "4")]),
        ("6", vec![waves]),
        ("8", vec![("cage.elastic_ring.modes", "8")]),
        ("damping 0.01, order 6", vec![waves, ("cage.elastic_ring.damping", "0.01")]),
        ("damping 0.1, order 6", vec![waves, ("cage.elastic_ring.damping", "0.1")]),
        ("half as stiff, order 4", vec![("cage.elastic_ring.stiffness.bending", "0.1286")]),
        ("twice as stiff, order 4", vec![("cage.elastic_ring.stiffness.bending", "0.5144")]),
        ("10 times as stiff, order 4", vec![("cage.elastic_ring.stiffness.bending", "2.572")]),
        ("oval by 20 um, order 4", vec![("cage.guide.roundness", oval)]),
        ("five lobes of 10 um, order 4", vec![("cage.guide.roundness", lobes)]),
    ] {
        table.add([name.to_owned(), shown(&whirl_of(&scene("grease_guide_elastic", &changes)?)?)]);
    }
    Ok(table)
}

/// What changes the level of the whirl of the rigid cage with heat.
fn level() -> Result<Table> {
    let mut table = Table::new("level", &["rigid cage with heat, 3000 rev/min", "film, K", "whirl, rad/s"]);
    let path =
        ["heat.links.6.conductance.constant", "heat.links.7.conductance.constant", "heat.bearing_torque.f0"];
    for (name, values) in [
        ("as assumed", ["1.41", "2.21", "2.0"]),
        ("half the conductance of the seats", ["0.705", "1.105", "2.0"]),
        ("twice", ["2.82", "4.42", "2.0"]),
        ("channelled grease, f0 = 1", ["1.41", "2.21", "1.0"]),
        ("f0 = 1 and twice", ["2.82", "4.42", "1.0"]),
    ] {
        let changes: Vec<(&str, &str)> = path.into_iter().zip(values).collect();
        let steady = HeatBalance::new(Model::new(scene("grease_guide_heat", &changes)?)?)?.settle()?;
        table.add([
            name.to_owned(),
            format!("{:.1}", steady.temperatures[0]),
            format!("{:.0}", steady.whirl_speed),
        ]);
    }
    Ok(table)
}

/// Speeds at which the rigid cage whirls.
fn starts() -> Result<Table> {
    let mut table = Table::new("onset", &["rigid cage, 313 K", "rev/min"]);
    let found = onset(&scene("grease_guide", &[])?, [15.0, 300.0], &Default::default())?;
    let turns = |speed: Option<f64>| {
        speed.map_or("none up to 2865".to_owned(), |speed| format!("{:.0}", speed * 60.0 / TAU))
    };
    table.add(["a whirl goes on down to".to_owned(), turns(found.survival)]);
    table.add(["a dropped cage comes to whirl from".to_owned(), turns(found.dropped_start)]);
    table.add(["a cage at rest is lost at".to_owned(), turns(found.loss_of_rest)]);
    Ok(table)
}

/// The brass cage of the first paper, rigid and elastic.
fn brass() -> Result<Table> {
    let head = [
        "NU2310, 3000 rev/min, 4900 N",
        "cage y",
        "cage z",
        "mean force of a touching pocket, N",
        "roller slip in the load zone, %",
    ];
    let mut table = Table::new("brass", &head);
    for clearance in ["40e-6", "5e-6"] {
        for (name, file) in [("rigid", "nu2310"), ("elastic", "nu2310_elastic")] {
            let scene = scene(file, &[("inner_ring.radial_clearance", clearance)])?;
            let [y, z, force, slip] = motion::rollers(&scene)?;
            let clearance: f64 = clearance.parse().unwrap_or(f64::NAN);
            table.add([
                format!("{:.0} um, {name}", 1e6 * clearance),
                format!("{y:.3}"),
                format!("{z:.3}"),
                format!("{force:.2}"),
                format!("{:.1}", 100.0 * slip),
            ]);
        }
    }
    Ok(table)
}
