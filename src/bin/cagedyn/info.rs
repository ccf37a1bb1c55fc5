//! The command `info`.

mod json;

use crate::effects::effects;
use crate::results::facts;
use crate::results::table::{self, Align, number};
use crate::run::{in_file, read, stem, table_size};
use crate::{InfoArgs, terminal};
use cagedyn::model::{HostInputs, Input};
use cagedyn::scene::{ElementMotion, Method, RingCoordinate, RingMotion};
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
    let set: Vec<String> = args.sets.pairs().map(|(path, value)| format!("{path}={value}")).collect();
    let title = facts::title(model.scene().title.as_deref(), &stem(&args.scene), &set);
    if args.json {
        terminal::print(&format!("{:#}\n", json::as_json(&title, model)))?;
        return Ok(ExitCode::SUCCESS);
    }
    let mut text = format!("{title}\n{}\n", facts::facts(&model));
    let warnings = model.scene().warnings();
    if !warnings.is_empty() {
        section(&mut text, "Unlikely values", warnings.into_iter().map(|text| vec![text]).collect());
    }
    section(&mut text, "Bodies and states", bodies(&model));
    let (present, absent): (Vec<_>, Vec<_>) =
        effects(model.scene()).into_iter().partition(|e| e.adds.is_some());
    let mut active = vec![elements(&model)];
    active.extend(present.into_iter().map(|e| row(&e.path, e.adds.unwrap_or_default())));
    section(&mut text, "Active effects and what they add", active);
    section(&mut text, "Laws in use, and the most contacts each can act in", laws(&model));
    section(&mut text, "Absent effects", absent.into_iter().map(|e| vec![e.path]).collect());
    section(&mut text, "Inputs", inputs(&model));
    section(&mut text, "Output channels", channels(&model));
    section(&mut text, "Records", records(&model));
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
    let outer = match model.scene().outer_ring.as_ref().and_then(|ring| ring.speed.as_ref()) {
        None => "fixed at the origin",
        Some(_) => "held at the origin, turns at its given speed",
    };
    let mut rows = vec![row("outer_ring", outer), row("inner_ring", ring(model))];
    if layout.cage().is_some() {
        let in_space = model.scene().cage.as_ref().is_some_and(|cage| cage.space.is_some());
        rows.push(row(
            "cage",
            if in_space { "moves, turns and tilts" } else { "moves and turns in the plane" },
        ));
    }
    let in_space = model.scene().rollers.as_ref().is_some_and(|rollers| rollers.space.is_some());
    let text = if in_space {
        "each: axial and radial offset, orbit travel, skew, tilt, their rates, spin speed"
    } else if model.has_rollers() {
        "each: radial offset, orbit travel, their rates, spin speed"
    } else if model.scene().balls.is_some() {
        "each: axial and radial offset, orbit travel, their rates, three spin speeds"
    } else {
        "prescribed orbit and spin, no states"
    };
    rows.push(row(&indexed(model.element_kind(), model.element_count()), text));
    let (q, v) = (layout.positions(), layout.velocities());
    rows.push(row("states", format!("{}: {q} positions, {v} velocities", layout.states())));
    rows
}

/// How the inner ring moves.
fn ring(model: &Model) -> String {
    match model.scene().inner_ring.as_ref().map(|ring| &ring.motion) {
        None => "does not turn".to_owned(),
        Some(RingMotion::Fixed(at)) => format!("held at ({}, {}) m, turns at its given speed", at.y, at.z),
        Some(RingMotion::Prescribed(_)) => "moves as prescribed, turns at its given speed".to_owned(),
        Some(RingMotion::Free(_)) => "moves in the plane, turns at its given speed".to_owned(),
        Some(RingMotion::Space(ring)) => {
            let coordinates = ring.coordinates();
            let free: Vec<&str> = coordinates
                .iter()
                .filter_map(|(name, coordinate)| (**coordinate == RingCoordinate::Free).then_some(*name))
                .collect();
            let free =
                if free.is_empty() { "held".to_owned() } else { format!("free in {}", free.join(", ")) };
            let planar = model.scene().rollers.as_ref().is_some_and(|rollers| rollers.space.is_none());
            let still =
                if planar { "; beside rollers it has an equilibrium, no motion over time" } else { "" };
            format!("{free}, turns at its given speed{still}")
        }
    }
}

/// `roller[0..11]` for twelve rollers.
fn indexed(name: &str, count: usize) -> String {
    format!("{name}[0..{}]", count.saturating_sub(1))
}

fn elements(model: &Model) -> Vec<String> {
    let count = model.element_count();
    match model.scene().kinematic_elements.as_ref().map(|e| &e.motion) {
        None if model.has_rollers() => {
            let in_space = model.scene().rollers.as_ref().is_some_and(|rollers| rollers.space.is_some());
            let states = if in_space { 11 } else { 5 };
            let text = format!(
                "{} states, {} contacts: elastic line contact of Palmgren",
                states * count,
                2 * count
            );
            row("rollers", text)
        }
        None => {
            row("balls", format!("{} states, {} contacts: elastic ellipse of Hertz", 9 * count, 2 * count))
        }
        Some(ElementMotion::Rolling { contact_angle }) => {
            let text = format!("no states: {count} elements roll at a contact angle of {contact_angle} rad");
            row("kinematic_elements", text)
        }
        Some(ElementMotion::Prescribed { .. }) => {
            row("kinematic_elements", format!("no states: {count} elements with given orbit and spin"))
        }
    }
}

fn laws(model: &Model) -> Vec<Vec<String>> {
    model.laws_in_use().into_iter().map(|(name, contacts)| row(name, contacts.to_string())).collect()
}

fn inputs(model: &Model) -> Vec<Vec<String>> {
    let infos = model.input_infos();
    infos.into_iter().map(|i| vec![i.name, format!("[{}]", i.unit), i.description.to_owned()]).collect()
}

/// The channels; those that every element has in one row.
fn channels(model: &Model) -> Vec<Vec<String>> {
    let kind = model.element_kind();
    let all = indexed(kind, model.element_count());
    let rows = model.channels().iter().filter_map(|channel| {
        let name = match channel.name.strip_prefix(&format!("{kind}[")) {
            None => channel.name.clone(),
            Some(rest) => format!("{all}{}", rest.strip_prefix("0]")?),
        };
        Some(vec![name, format!("[{}]", channel.unit), channel.description.to_owned()])
    });
    rows.collect()
}

fn records(model: &Model) -> Vec<Vec<String>> {
    let (record, all) = (&model.scene().record, model.channels());
    let watched: Vec<&str> = model.watched().iter().map(|i| all[*i].name.as_str()).collect();
    let watched = match watched[..] {
        [] => "none".to_owned(),
        [first, .., last] if watched.len() > 3 => {
            format!("{} channels from {first} to {last}", watched.len())
        }
        _ => watched.join(", "),
    };
    vec![
        row("recorded", format!("{} of {} channels", model.recorded().len(), all.len())),
        row("followed in every step", watched),
        row("size", table_size(model).1),
        row("interval", format!("{} s up to {} s", number(record.interval), number(record.duration))),
    ]
}

fn geometry(model: &Model) -> Vec<Vec<String>> {
    let scene = model.scene();
    let inputs = model.inputs_at(0.0, &HostInputs::default());
    let turning = |w: f64| format!("{} rad/s ({} 1/min)", number(w), number(w * 60.0 / TAU));
    let kind = model.element_kind();
    let mut rows = vec![
        row("pitch radius", format!("{:.4} mm", 1e3 * model.pitch_radius())),
        row(&format!("{kind} radius"), format!("{:.4} mm", 1e3 * scene.element_radius())),
    ];
    let outer = scene.outer_ring.as_ref().and_then(|ring| ring.raceway_radius);
    if let (Some(outer), Some(inner)) = (outer, model.inner_raceway_radius()) {
        rows.push(row("outer raceway radius", format!("{:.4} mm", 1e3 * outer)));
        rows.push(row("inner raceway radius", format!("{:.4} mm", 1e3 * inner)));
    }
    if let Some(clearance) = scene.inner_ring.as_ref().and_then(|ring| ring.radial_clearance) {
        rows.push(row("radial internal clearance", format!("{} um", number(1e6 * clearance))));
    }
    if let Some(guide) = model.guide_clearance() {
        rows.push(row("radial guide clearance", format!("{} um", number(1e6 * guide))));
    }
    if let Some(viscosity) = model.viscosity(&inputs) {
        rows.push(row("viscosity at t = 0", format!("{} Pa s", number(viscosity))));
    }
    let [orbit, spin] = model.kinematic_speeds(&inputs);
    rows.push(row("inner ring speed at t = 0", turning(inputs.of(Input::RingSpeed))));
    if scene.outer_ring.as_ref().is_some_and(|ring| ring.speed.is_some()) {
        rows.push(row("outer ring speed at t = 0", turning(inputs.of(Input::OuterRingSpeed))));
    }
    rows.push(row("cage and orbit speed without slip", turning(orbit)));
    rows.push(row(&format!("{kind} spin speed without slip"), turning(spin)));
    let vibrating = |frequency: f64| format!("{} rad/s ({} Hz)", number(frequency), number(frequency / TAU));
    rows.push(row("highest contact frequency", vibrating(model.contact_frequency())));
    for (order, frequency) in model.ring_waves() {
        rows.push(row(&format!("wave of order {order} of the free ring of the cage"), vibrating(frequency)));
    }
    rows
}

fn integration(model: Arc<Model>) -> Vec<Vec<String>> {
    let solver = model.scene().solver.clone();
    let record = model.scene().record.clone();
    let tolerance = solver.method.tolerance().map_or(String::new(), |t| format!(", tolerance {t}"));
    let method = format!("{}{tolerance}", solver.method.title());
    let kind = match &solver.method {
        Method::Leapfrog(m) if m.step.is_some() => "step, set by the scene",
        Method::Leapfrog(_) => "step, from the highest contact frequency",
        _ => "first step",
    };
    let step =
        first_step(model).map_or_else(|e| format!("no step possible: {e}"), |s| format!("{} s", number(s)));
    vec![
        row("preset", solver.preset.name().to_owned()),
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
