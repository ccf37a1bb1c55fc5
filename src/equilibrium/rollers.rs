//! Ring and rollers in the plane.

use super::{
    AZIMUTH, Equilibrium, LineLoads, NORMAL_FORCE, ORBIT_SPEED, PRESCRIBED, RADIAL_OFFSET, life, named,
};
use crate::bodies::CENTRE;
use crate::error::{Error, Result, Status};
use crate::model::plane::{Plane, StillBearing};
use crate::model::{HostInputs, Input, Model, Quantity, quantity};
use crate::scalar::math;
use crate::scene::RingMotion;

/// What is known of every roller.
const ROLLER: [Quantity; 3] = [AZIMUTH, RADIAL_OFFSET, ORBIT_SPEED];
/// What is known of every contact.
const CONTACT: [Quantity; 4] = [
    NORMAL_FORCE,
    quantity("approach", "m", "elastic approach delta; negative where they are apart"),
    quantity(
        "largest_pressure",
        "Pa",
        "largest pressure of Hertz's line contact; with a profile that of the middle",
    ),
    quantity("half_width", "m", "half width b of Hertz's line contact; with a profile that of the middle"),
];
/// Place of the approach among these.
const APPROACH: usize = 1;

/// The equilibrium of a ring and the rollers that go round with the speed that they roll at.
pub(super) fn equilibrium(model: &Model, plane: &Plane) -> Result<Equilibrium> {
    let inputs = model.inputs_at(0.0, &HostInputs::default());
    let [orbit, _] = model.kinematic_speeds(&inputs);
    let still = StillBearing::new(plane, orbit).ok_or_else(|| Error::new(Status::BadScene, PRESCRIBED))?;
    let state = model.initial_state()?;
    let q = &state[..model.layout().positions()];
    let (load, held) = match model.scene().inner_ring.as_ref().map(|ring| &ring.motion) {
        Some(RingMotion::Fixed(place)) => (None, [place.y, place.z]),
        Some(RingMotion::Prescribed(_)) => (None, [Input::RingY, Input::RingZ].map(|input| inputs.of(input))),
        _ => (plane.load_at_rest(&inputs), [0.0; 2]),
    };
    let ring = match load {
        Some(load) => still.equilibrium(q, load)?,
        None => held,
    };
    let mut found = Equilibrium {
        coordinates: named(&CENTRE),
        free: vec![load.is_some(); 2],
        displacement: ring.to_vec(),
        reaction: vec![0.0; 2],
        stiffness: vec![0.0; 4],
        element_quantities: &ROLLER,
        elements: Vec::new(),
        contacts: Vec::new(),
        contact_quantities: &CONTACT,
        contact_values: Vec::new(),
        line_loads: LineLoads::default(),
        life: None,
        warnings: Vec::new(),
        residual: 0.0,
    };
    let (kind, mut size) = (model.element_kind(), 0.0);
    for j in 0..model.element_count() {
        let roller = still.roller_at_rest(q, j, ring);
        found.elements.push(vec![roller.azimuth, roller.radial_offset, orbit]);
        for (k, name) in ["outer_raceway", "inner_raceway"].into_iter().enumerate() {
            let (load, approach) = (roller.loads[k], roller.approaches[k]);
            let [half_width, pressure] = if load > 0.0 { still.pressed(k, load, approach) } else { [0.0; 2] };
            found.contacts.push(format!("{kind}[{j}].{name}"));
            found.contact_values.push(vec![load, approach, pressure, half_width]);
        }
        size += roller.loads[1];
        for i in 0..2 {
            found.reaction[i] += roller.on_ring[i];
            for k in 0..2 {
                found.stiffness[2 * i + k] += roller.stiffness[i][k];
            }
        }
    }
    if let Some(load) = load {
        let rest = [0, 1].map(|k| found.reaction[k] + load[k]);
        found.residual = math::hypot(rest[0], rest[1]) / size.max(f64::MIN_POSITIVE);
    }
    let approach = |k: usize, j: usize| found.contact_values[2 * j + k][APPROACH];
    found.life = life::of(model, |k, j, s| still.line_load(k, approach(k, j), s));
    Ok(found)
}
