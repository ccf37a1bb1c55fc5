//! The equilibrium of rollers that tilt with their ring, told as users read it.

use super::{
    AZIMUTH, Equilibrium, NORMAL_FORCE, ORBIT_SPEED, RADIAL_OFFSET, life, of_ring, over_pressed, pushed_away,
};
use crate::error::Result;
use crate::model::plane::Plane;
use crate::model::space::rest::rollers::{OnRib, SettledRollers, settled_rollers};
use crate::model::{HostInputs, Model, Quantity, STATIC_LIMIT_OF_ROLLERS, quantity};
use std::f64::consts::PI;

/// Parts of the length between the places at which the line load is told.
const PLACES: usize = 100;
/// Share of an approach that is round-off.
const ROUND_OFF: f64 = 1e-12;

/// What is known of every roller.
const ROLLER: [Quantity; 5] = [
    AZIMUTH,
    RADIAL_OFFSET,
    quantity("tilt", "rad", "rotation of its axis about that along the orbit: its +x end outwards"),
    ORBIT_SPEED,
    quantity("axial_offset", "m", "place along the axis of the bearing"),
];
/// What is known of every contact.
const CONTACT: [Quantity; 8] = [
    NORMAL_FORCE,
    quantity(
        "approach",
        "m",
        "elastic approach delta in the middle of the roller; negative where they are apart",
    ),
    quantity("moment", "N m", "moment on the roller about the axis along the orbit"),
    quantity("largest_line_load", "N/m", "largest load per length; none of a rib"),
    quantity("largest_at", "m", "where that is, along the roller from its middle"),
    quantity("loaded_length", "m", "length of the roller that is loaded"),
    quantity(
        "largest_pressure",
        "Pa",
        "largest pressure of Hertz's line contact under that load; stresses at sharp ends come on top",
    ),
    quantity(
        "half_width",
        "m",
        "half width b of Hertz's line contact there; of a rib the mean radius of the contact",
    ),
];

/// Place of the largest pressure among these.
const PRESSURE: usize = 6;

/// The equilibrium of a ring and the rollers that go round with the speed that they roll at.
pub(super) fn equilibrium(model: &Model, plane: &Plane) -> Result<Equilibrium> {
    let [orbit, _] = model.kinematic_speeds(&model.inputs_at(0.0, &HostInputs::default()));
    Ok(told(model, &settled_rollers(plane, orbit)?))
}

/// The same of one that was found.
pub(super) fn told(model: &Model, settled: &SettledRollers<'_>) -> Equilibrium {
    let [orbit, _] = model.kinematic_speeds(&model.inputs_at(0.0, &HostInputs::default()));
    let length = settled.rollers.law(0).elastic.length;
    let mut found = of_ring(&settled.ring, [&ROLLER, &CONTACT]);
    found.line_loads.places = (0..=PLACES).map(|i| length * (i as f64 / PLACES as f64 - 0.5)).collect();
    for j in 0..settled.places.len() {
        let [x, rho, tilt] = settled.place(j);
        found.elements.push(vec![settled.rollers.azimuths[j], rho, tilt, orbit, x]);
        for (k, name) in ["outer_raceway", "inner_raceway"].into_iter().enumerate() {
            let name = format!("{}[{j}].{name}", model.element_kind());
            let (values, line_loads) = contact(settled, (j, k), &found.line_loads.places);
            found.warnings.extend(over_pressed(&name, values[PRESSURE], STATIC_LIMIT_OF_ROLLERS));
            found.contacts.push(name);
            found.contact_values.push(values.to_vec());
            found.line_loads.values.push(line_loads);
        }
        for (name, on_rib, [pressure, radius]) in settled.rollers.ribs(j, settled.places[j], &settled.ring.at)
        {
            let OnRib { load, approach, moment } = on_rib;
            found.contacts.push(format!("{}[{j}].{name}", model.element_kind()));
            found.contact_values.push(vec![load, approach, moment, 0.0, 0.0, 0.0, pressure, radius]);
            found.line_loads.values.push(vec![0.0; found.line_loads.places.len()]);
        }
    }
    found.life = life::of(model, |k, j, s| settled.line_load(k, settled.approach(j, k, s)));
    found.warnings.extend(pushed_away(&settled.ring));
    found
}

/// Values of [`CONTACT`] of raceway `k` of roller `j`, and line loads at these places, N/m.
fn contact(
    settled: &SettledRollers<'_>,
    (j, k): (usize, usize),
    places: &[f64],
) -> ([f64; CONTACT.len()], Vec<f64>) {
    let SettledRollers { rollers, ring, places: at } = settled;
    let (on_raceway, elastic) = (rollers.raceways(j, at[j], &ring.at)[k], &rollers.law(k).elastic);
    let approach = |s: f64| settled.approach(j, k, s);
    let middle = approach(0.0);
    // Of places that are as deep, the middle.
    let (mut deepest, mut there) = (middle.max(0.0), 0.0);
    let mut line_loads = Vec::with_capacity(places.len());
    for &s in places {
        let depth = approach(s);
        if depth > deepest * (1.0 + ROUND_OFF) {
            (deepest, there) = (depth, s);
        }
        line_loads.push(settled.line_load(k, depth));
    }
    // Of a contact that is everywhere pressed like there.
    let load = elastic.load(deepest);
    let half_width = elastic.half_width(load);
    let pressure = if load > 0.0 { 4.0 / PI * elastic.mean_pressure(load, half_width) } else { 0.0 };
    let length = elastic.length * on_raceway.loaded;
    let (force, moment, largest) = (on_raceway.load, on_raceway.moment, load / elastic.length);
    ([force, middle, moment, largest, there, length, pressure, half_width], line_loads)
}
