//! What a scene contains, for programs.

use super::{first_step, ring};
use crate::effects::effects;
use cagedyn::Model;
use cagedyn::model::{HostInputs, Input};
use serde_json::{Map, Value, json};
use std::sync::Arc;

/// Everything that the tables show, in SI units.
pub fn as_json(title: &str, model: Model) -> Value {
    let scene = model.scene();
    let layout = model.layout();
    let inputs: Vec<Value> = model
        .input_infos()
        .into_iter()
        .map(|input| json!({"name": input.name, "unit": input.unit, "description": input.description}))
        .collect();
    let laws: Map<String, Value> =
        model.laws_in_use().into_iter().map(|(name, contacts)| (name.to_owned(), contacts.into())).collect();
    let present = effects(scene).into_iter().filter_map(|effect| Some((effect.path, effect.adds?.into())));
    let effects: Map<String, Value> = present.collect();
    let record = &scene.record;
    let mut report = json!({
        "title": title,
        "version": env!("CARGO_PKG_VERSION"),
        "warnings": scene.warnings(),
        "bodies": bodies(&model),
        "states": {
            "positions": layout.positions(),
            "velocities": layout.velocities(),
            "all": layout.states(),
        },
        "effects": effects,
        "most_contacts_by_law": laws,
        "inputs": inputs,
        "channels": channels(&model),
        "record": {
            "duration_s": record.duration,
            "interval_s": record.interval,
        },
        "geometry": geometry(&model),
        "solver": {
            "preset": scene.solver.preset.name(),
            "method": scene.solver.method.name(),
            "tolerance": scene.solver.method.tolerance(),
            "min_step_s": scene.solver.min_step,
        },
    });
    report["solver"]["first_step_s"] = first_step(Arc::new(model)).ok().into();
    report
}

fn bodies(model: &Model) -> Vec<Value> {
    let mut bodies = vec![
        json!({"name": "outer_ring", "count": 1, "motion": "fixed at the origin"}),
        json!({"name": "inner_ring", "count": 1, "motion": ring(model)}),
    ];
    if model.layout().cage().is_some() {
        let in_space = model.scene().cage.as_ref().is_some_and(|cage| cage.space.is_some());
        let motion = if in_space { "moves, turns and tilts" } else { "moves and turns in the plane" };
        bodies.push(json!({"name": "cage", "count": 1, "motion": motion}));
    }
    let in_space = model.scene().rollers.as_ref().is_some_and(|rollers| rollers.space.is_some());
    let motion = match model.has_rollers() {
        _ if in_space => "moves, spins, skews and tilts",
        true => "moves and spins in the plane",
        false => "prescribed orbit and spin",
    };
    bodies.push(json!({"name": model.element_kind(), "count": model.element_count(), "motion": motion}));
    bodies
}

/// Every channel, with whether records have it and whether it is followed in every step.
fn channels(model: &Model) -> Vec<Value> {
    let among = |places: &[usize]| {
        let mut is = vec![false; model.channels().len()];
        places.iter().for_each(|place| is[*place] = true);
        is
    };
    let (recorded, watched) = (among(model.recorded()), among(model.watched()));
    let all = model.channels().iter().zip(recorded.into_iter().zip(watched));
    all.map(|(channel, (recorded, watched))| {
        json!({
            "name": channel.name,
            "unit": channel.unit,
            "description": channel.description,
            "recorded": recorded,
            "followed": watched,
        })
    })
    .collect()
}

/// Lengths in m, speeds in rad/s at t = 0; null for what the scene has not.
fn geometry(model: &Model) -> Value {
    let scene = model.scene();
    let inputs = model.inputs_at(0.0, &HostInputs::default());
    let [orbit, spin] = model.kinematic_speeds(&inputs);
    let wave = |(order, frequency): (u32, f64)| json!({"order": order, "frequency_rad_s": frequency});
    let waves: Vec<Value> = model.ring_waves().into_iter().map(wave).collect();
    json!({
        "pitch_radius_m": model.pitch_radius(),
        "element_radius_m": scene.element_radius(),
        "outer_raceway_radius_m": scene.outer_ring.as_ref().map(|ring| ring.raceway_radius),
        "inner_raceway_radius_m": model.inner_raceway_radius(),
        "radial_clearance_m": scene.inner_ring.as_ref().and_then(|ring| ring.radial_clearance),
        "radial_guide_clearance_m": model.guide_clearance(),
        "viscosity_pa_s": model.viscosity(&inputs),
        "inner_ring_speed_rad_s": inputs.of(Input::RingSpeed),
        "orbit_speed_without_slip_rad_s": orbit,
        "spin_speed_without_slip_rad_s": spin,
        "highest_contact_frequency_rad_s": model.contact_frequency(),
        "ring_waves": waves,
    })
}
