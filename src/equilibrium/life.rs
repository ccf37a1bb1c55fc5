//! Reference life of a row of rollers, by the loads along their raceways.

use crate::bodies::Input;
use crate::laws::life::{LEAST_LAMINAE, RollerRow, reference_life, reference_load, ring_equivalent_loads};
use crate::model::{HostInputs, Model, Quantity, quantity};
use std::f64::consts::{FRAC_PI_4, TAU};

/// Of what bearings the ratings are known: contact angles up to this, rad, with a little for round-off.
const LARGEST_ANGLE: f64 = FRAC_PI_4 + 1e-9;

/// Equivalent load that is round-off, N.
const NO_LOAD: f64 = 1e-9;

/// What is known of a life.
const LIFE: [Quantity; 8] = [
    quantity(
        "life_turns",
        "1",
        "L_10r: turns of one ring against the other that nine of ten such bearings reach",
    ),
    quantity("life_time", "s", "the same at the speeds of the rings; infinite where both turn alike"),
    quantity("reference_load", "N", "P_ref: radial load under which ISO 281 gives that life"),
    quantity("dynamic_load_rating", "N", "C_r: that of the scene, else by ISO 281"),
    quantity(
        "outer_rating",
        "N",
        "Q_ce: load of a contact that the outer raceway carries for a million turns",
    ),
    quantity("inner_rating", "N", "Q_ci: the same of the inner raceway"),
    quantity("outer_equivalent_load", "N", "Q_ee: load of a contact with the outer raceway for that life"),
    quantity("inner_equivalent_load", "N", "Q_ei: the same of the inner raceway"),
];

/// Life of a row of rollers after ISO/TS 16281, as [`crate::laws::life`] has it: that of the raceways of usual steel, without factors of lubrication,
/// cleanliness or reliability.
#[derive(Clone, Debug, PartialEq)]
pub struct ReferenceLife {
    /// What is known of it.
    pub quantities: &'static [Quantity],
    /// Values in this order.
    pub values: Vec<f64>,
    /// Middles of the laminae from that of the roller along its axis, m.
    pub places: Vec<f64>,
    /// Equivalent loads of these at the outer and the inner ring, N.
    pub equivalent_loads: [Vec<f64>; 2],
}

/// The life of rollers with these loads per length (N/m), `load(ring, roller, place)`; of none that is loaded, and of contact angles above 45 degrees,
/// there is none.
pub(super) fn of(model: &Model, load: impl Fn(usize, usize, f64) -> f64) -> Option<ReferenceLife> {
    let scene = model.scene();
    let rollers = scene.rollers.as_ref()?;
    let inputs = model.inputs_at(0.0, &HostInputs::default());
    let [outer, inner] = [Input::OuterRingSpeed, Input::RingSpeed].map(|speed| inputs.of(speed));
    let row = RollerRow {
        count: model.element_count(),
        diameter: 2.0 * rollers.radius,
        effective_length: rollers.effective_length,
        pitch_diameter: 2.0 * scene.pitch_radius(),
        contact_angle: scene.taper().map_or(0.0, |taper| taper.outer_raceway_angle),
        // Of rings at rest the inner one is taken to be what will turn.
        turning: [outer != 0.0, inner != 0.0 || outer == 0.0],
    };
    if row.contact_angle > LARGEST_ANGLE {
        return None;
    }
    let wide = row.effective_length / LEAST_LAMINAE as f64;
    let places: Vec<f64> =
        (0..LEAST_LAMINAE).map(|k| wide * (k as f64 + 0.5) - 0.5 * row.effective_length).collect();
    let equivalent_loads = row.equivalent_loads(LEAST_LAMINAE, |ring, j, k| wide * load(ring, j, places[k]));
    let of_rings = ring_equivalent_loads(&equivalent_loads);
    if of_rings.iter().sum::<f64>() < NO_LOAD {
        return None;
    }
    let rating = rollers.dynamic_load_rating.unwrap_or_else(|| row.dynamic_load_rating());
    let ratings = row.ring_ratings(rating);
    let turns = reference_life(ratings, of_rings);
    let time = turns * TAU / (inner - outer).abs();
    let values = [&[turns, time, reference_load(rating, turns), rating][..], &ratings, &of_rings].concat();
    Some(ReferenceLife { quantities: &LIFE, values, places, equivalent_loads })
}
