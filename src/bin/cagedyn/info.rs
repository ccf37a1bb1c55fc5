//! The command `info`.

use crate::effects::effects;
use crate::run::{in_file, read, stem};
use crate::table::{self, Align, number};
use crate::{InfoArgs, terminal};
use cagedyn::scene::{Method, RingMotion};
use cagedyn::{Model, Result, Scene, Sim};
use std::f64::consts::TAU;
use std::process::ExitCode;
use std::sync::Arc;

/// Prints what a scene contains.
///
/// # Errors
/// A scene that cannot be read or compiled.
pub fn command(args: &InfoArgs) -> Result<ExitCode> {
    let scene = Scene::from_json_with(&read(&args.scene)?, args.sets.pairs());
    let model = scene.and_then(Model::new).map_err(|e| in_file(&args.scene, e))?;
    let title = model.scene().title.clone().unwrap_or_else(|| stem(&args.scene));
    let mut text = title + "\n";
    section(&mut text, "Bodies and states", bodies(&model));
    let (present, absent): (Vec<_>, Vec<_>) =
        effects(model.scene()).into_iter().partition(|e| e.adds.is_some());
    let mut active = vec![row("roller and raceway contacts", contacts(&model))];
    active.extend(present.into_iter().map(|e| row(&e.path, e.adds.unwrap_or_default())));
    section(&mut text, "Active effects and what they add", active);
    section(&mut text, "Absent effects", absent.into_iter().map(|e| vec![e.path]).collect());
    section(&mut text, "Inputs", inputs(&model));
    section(&mut text, "Output channels", channels(&model));
    section(&mut text, "Geometry and kinematics", geometry(&model));
    section(&mut text, "Integration", integration(Arc::new(model)));
    terminal::print(&text)?;
    Ok(ExitCode::SUCCESS)
}

fn section(text: &mut String, name: &str, rows: Vec<Vec<String>>) {
    text.push_str(&format!("\n{name}\n"));
    if rows.is_empty() {
        text.push_str("  none\n");
    }
    for line in table::lines(&rows, &[Align::Left]) {
        text.push_str(&format!("  {line}\n"));
    }
}

fn row(name: &str, value: impl Into<String>) -> Vec<String> {
    vec![name.to_owned(), value.into()]
}

fn bodies(model: &Model) -> Vec<Vec<String>> {
    let layout = model.layout();
    let ring = match &model.scene().inner_ring.motion {
        RingMotion::Fixed(at) => format!("held at ({}, {}) m, turns at its given speed", at.y, at.z),
        RingMotion::Free(_) => "moves in the plane, turns at its given speed".to_owned(),
    };
    let mut rows = vec![row("outer_ring", "fixed at the origin"), row("inner_ring", ring)];
    if layout.cage.is_some() {
        rows.push(row("cage", "moves and turns in the plane"));
    }
    let rollers = "each: radial offset, orbit angle, their rates, spin speed";
    rows.push(row(&indexed("roller", layout.count), rollers));
    let (q, v) = (layout.positions(), layout.velocities());
    rows.push(row("states", format!("{}: {q} positions, {v} velocities", layout.states())));
    rows
}

/// `roller[0..11]` for twelve rollers.
fn indexed(name: &str, count: usize) -> String {
    format!("{name}[0..{}]", count.saturating_sub(1))
}

fn contacts(model: &Model) -> String {
    let count = model.layout().count;
    let raceways = model.contact_names().iter().filter(|name| name.ends_with("_raceway")).count();
    format!("{} states, {raceways} contacts: elastic line contact of Palmgren", 5 * count)
}

fn inputs(model: &Model) -> Vec<Vec<String>> {
    let infos = model.input_infos();
    infos.into_iter().map(|i| vec![i.name, format!("[{}]", i.unit), i.description.to_owned()]).collect()
}

/// The channels; those that every roller has in one row.
fn channels(model: &Model) -> Vec<Vec<String>> {
    let all = indexed("roller", model.layout().count);
    let rows = model.channels().into_iter().filter_map(|channel| {
        let name = match channel.name.strip_prefix("roller[") {
            None => channel.name,
            Some(rest) => format!("{all}{}", rest.strip_prefix("0]")?),
        };
        Some(vec![name, format!("[{}]", channel.unit), channel.description.to_owned()])
    });
    rows.collect()
}

fn geometry(model: &Model) -> Vec<Vec<String>> {
    let scene = model.scene();
    let clearance = scene.inner_ring.radial_clearance;
    let speed = model.inputs_at(0.0, &[None; 3]).ring_speed;
    let turning = |w: f64| format!("{} rad/s ({} 1/min)", number(w), number(w * 60.0 / TAU));
    let mut rows = vec![
        row("pitch radius", format!("{:.4} mm", 1e3 * model.pitch_radius())),
        row("outer raceway radius", format!("{:.4} mm", 1e3 * scene.outer_ring.raceway_radius)),
        row("inner raceway radius", format!("{:.4} mm", 1e3 * model.inner_raceway_radius())),
        row("roller radius", format!("{:.4} mm", 1e3 * scene.rollers.radius)),
        row("radial internal clearance", format!("{} um", number(1e6 * clearance))),
    ];
    if let Some(guide) = model.guide_clearance() {
        rows.push(row("radial guide clearance", format!("{} um", number(1e6 * guide))));
    }
    rows.push(row("inner ring speed at t = 0", turning(speed)));
    rows.push(row("cage and orbit speed without slip", turning(speed * model.orbit_ratio())));
    rows.push(row("roller spin speed without slip", turning(speed * model.spin_ratio())));
    let frequency = model.highest_frequency();
    let text = format!("{} rad/s ({} Hz)", number(frequency), number(frequency / TAU));
    rows.push(row("highest contact frequency", text));
    rows
}

fn integration(model: Arc<Model>) -> Vec<Vec<String>> {
    let solver = model.scene().solver.clone();
    let record = model.scene().record.clone();
    let (method, kind) = match &solver.method {
        Method::Leapfrog(m) if m.step.is_some() => ("leapfrog".to_owned(), "step, set by the scene"),
        Method::Leapfrog(_) => ("leapfrog".to_owned(), "step, from the highest contact frequency"),
        Method::DormandPrince(m) => (format!("Dormand-Prince 5(4), tolerance {}", m.tolerance), "first step"),
    };
    let step =
        first_step(model).map_or_else(|e| format!("no step possible: {e}"), |s| format!("{} s", number(s)));
    vec![
        row("method", method),
        row(kind, step),
        row("smallest step allowed", format!("{:e} s", solver.min_step)),
        row("simulated time", format!("{} s", record.duration)),
        row("record interval", format!("{} s", record.interval)),
    ]
}

/// Size of the first step, s.
fn first_step(model: Arc<Model>) -> Result<f64> {
    Ok(Sim::new(model)?.nominal_step())
}
