//! The scenes of the study and the changes made to them, one row each.

use cagedyn::model::{LAWS, LawCounts, StateInfo};

/// A scene and its rows.
pub struct Study {
    /// Name of the scene file without its extension.
    pub name: &'static str,
    /// Changes of the scene.
    pub rows: &'static [Row],
}

/// One change of a scene.
pub struct Row {
    /// The effect, in words.
    pub effect: &'static str,
    /// What the change does to it.
    pub kind: Kind,
    /// Values by path, as in `--set`.
    pub set: &'static [(&'static str, &'static str)],
    /// Laws that lose evaluations, each with the contacts in which it is still evaluated.
    pub gone: &'static [(&'static str, &'static [&'static str])],
    /// How the names of the states that go begin.
    pub states: &'static [&'static str],
}

impl Row {
    /// What should have gone with the effect and is still there after a run: evaluations and states.
    pub fn left_over(&self, counts: &LawCounts, states: &[StateInfo]) -> Vec<String> {
        let count =
            |law: &str| LAWS.iter().zip(counts).find(|(name, _)| **name == law).map_or(0, |(_, n)| *n);
        let law = |(law, contacts): &(&str, &[&str])| {
            let surplus = count(law).abs_diff(contacts.iter().map(|contact| count(contact)).sum());
            (surplus > 0).then(|| format!("{surplus} evaluations of {law}"))
        };
        let gone = |name: &String| self.states.iter().any(|prefix| name.starts_with(prefix));
        let states = states.iter().map(|info| info.name.clone()).filter(gone);
        self.gone.iter().filter_map(law).chain(states).collect()
    }
}

/// What a change does to an effect.
#[derive(Clone, Copy, PartialEq, Eq)]
pub enum Kind {
    /// The scene has it, the row has not.
    Removed,
    /// The row has something simpler in its place.
    Replaced,
    /// The scene does not have it, the row has.
    Added,
    /// Nothing is left but the cage and its weight.
    Reference,
}

/// Contacts of the raceways and of the pocket walls.
const RACEWAYS: &[&str] = &["outer_raceway", "inner_raceway"];
const WALL: &[&str] = &["pocket_wall"];
const NOWHERE: &[&str] = &[];

/// A step for scenes without contacts.
const STEP: &str = r#"{"method": {"leapfrog": {"step": 1e-5}}}"#;

const fn removed(
    effect: &'static str,
    set: &'static [(&'static str, &'static str)],
    gone: &'static [(&'static str, &'static [&'static str])],
) -> Row {
    Row { effect, kind: Kind::Removed, set, gone, states: &[] }
}

const fn added(effect: &'static str, set: &'static [(&'static str, &'static str)]) -> Row {
    Row { effect, kind: Kind::Added, set, gone: &[], states: &[] }
}

/// Both scenes.
pub const STUDIES: [Study; 2] =
    [Study { name: "nu2310", rows: &NU2310 }, Study { name: "grease_guide", rows: &GREASE_GUIDE }];

const NU2310: [Row; 24] = [
    removed("gravity", &[("gravity", "null")], &[]),
    removed("raceway damping", &[("raceways.contact.damping", "null")], &[]),
    removed("raceway thermal correction", &[("raceways.contact.thermal_correction", "null")], &[]),
    removed("raceway self-heating", &[("raceways.contact.self_heating", "null")], &[("self_heating", WALL)]),
    removed(
        "raceway traction with self-heating",
        &[("raceways.contact.traction", "null"), ("raceways.contact.self_heating", "null")],
        &[("traction", WALL), ("self_heating", WALL)],
    ),
    removed(
        "raceway boundary friction",
        &[("raceways.contact.boundary_friction", "null")],
        &[("lubrication_regime", WALL)],
    ),
    removed(
        "rolling resistance",
        &[("raceways.rolling_resistance", "null")],
        &[("rolling_resistance", NOWHERE)],
    ),
    Row {
        effect: "rolling resistance with the limit of rigid surfaces",
        kind: Kind::Replaced,
        set: &[("raceways.rolling_resistance.law", "rigid_limit")],
        gone: &[],
        states: &[],
    },
    Row {
        effect: "drag of the inlet on surfaces that slip",
        kind: Kind::Added,
        set: &[("raceways.rolling_resistance.inlet_sliding", "{}")],
        gone: &[],
        states: &[],
    },
    Row {
        effect: "rolling resistance of loaded contacts",
        kind: Kind::Replaced,
        set: &[("raceways.rolling_resistance.extent", r#"{"loaded": {"threshold": 50}}"#)],
        gone: &[],
        states: &[],
    },
    removed(
        "all raceway laws but elasticity",
        &[("raceways.contact", "{}"), ("raceways.rolling_resistance", "null")],
        &[
            ("film_thickness", WALL),
            ("traction", WALL),
            ("self_heating", WALL),
            ("lubrication_regime", WALL),
            ("rolling_resistance", NOWHERE),
        ],
    ),
    removed("pocket edge friction", &[("cage.pocket.lubricated_cylinder.edge_friction", "null")], &[]),
    removed(
        "all pocket laws but elasticity",
        &[("cage.pocket.lubricated_cylinder.contact", "{}")],
        &[
            ("film_thickness", RACEWAYS),
            ("traction", RACEWAYS),
            ("self_heating", RACEWAYS),
            ("lubrication_regime", RACEWAYS),
        ],
    ),
    removed(
        "pockets",
        &[("cage.pocket", "null")],
        &[("pocket_wall", NOWHERE), ("pocket_edge", NOWHERE), ("traction", RACEWAYS)],
    ),
    removed("guide squeeze", &[("cage.guide.film.short_bearing.squeeze", "false")], &[]),
    removed("guide", &[("cage.guide", "null")], &[("guide_film", NOWHERE)]),
    Row {
        effect: "cage",
        kind: Kind::Removed,
        set: &[("cage", "null")],
        gone: &[("pocket_wall", NOWHERE), ("pocket_edge", NOWHERE), ("guide_film", NOWHERE)],
        states: &["cage."],
    },
    Row {
        effect: "motion of the inner ring",
        kind: Kind::Removed,
        // Held where the scene's equilibrium puts it.
        set: &[
            ("inner_ring.motion", r#"{"fixed": {"y": 0.0, "z": -2.827e-5}}"#),
            ("initial.inner_ring", "null"),
        ],
        gone: &[],
        states: &["inner_ring."],
    },
    added("roundness", &[("cage.guide.roundness", r#"[{"order": 3, "amplitude": 5e-6, "phase": 0.0}]"#)]),
    added(
        "logarithmic profile of the rollers",
        // As in the variants of scenes/nu2310_unknowns.cases.json.
        &[(
            "rollers.profile",
            r#"{"logarithmic": {"design_load": 10880.0, "crowned_share": 0.6, "end_drop": 12e-6}}"#,
        )],
    ),
    added("mass eccentricity", &[("cage.mass_eccentricity", r#"{"y": 20e-6, "z": 0.0}"#)]),
    added(
        "viscosity of warming oil",
        &[(
            "lubricant.viscosity",
            r#"{"walther": {
                "cold": {"temperature": 308.15, "kinematic_viscosity": 69.77e-6},
                "hot": {"temperature": 373.15, "kinematic_viscosity": 7.8e-6},
                "density": 860.0,
                "temperature": {"over_time":
                    {"ramp": {"from": 308.15, "to": 313.15, "start": 0.0, "end": 0.3}}}
            }}"#,
        )],
    ),
    added(
        "solid contact of the guide",
        &[
            (
                "cage.guide.solid",
                r#"{"contact": {"stiffness": 1e8, "damping": 600.0,
                    "friction": {"coefficient": 0.1, "transition_speed": 0.02}}}"#,
            ),
            ("cage.guide.film_share", r#"{"roughness": 0.5e-6}"#),
        ],
    ),
    Row {
        effect: "gravity alone",
        kind: Kind::Reference,
        set: &[
            ("rollers", "null"),
            ("outer_ring", "null"),
            ("raceways", "null"),
            ("lubricant", "null"),
            ("inner_ring", r#"{"speed": {"constant": -314.1592653589793}}"#),
            (
                "kinematic_elements",
                r#"{"count": 12, "radius": 7.5e-3, "pitch_radius": 40e-3,
                    "motion": {"rolling": {"contact_angle": 0.0}}}"#,
            ),
            ("cage.pocket", "null"),
            ("cage.guide", "null"),
            ("initial", "null"),
            // Later it falls out of the bearing. Nothing here sets a step.
            ("record.duration", "0.05"),
            ("solver", STEP),
        ],
        gone: &[
            ("outer_raceway", NOWHERE),
            ("inner_raceway", NOWHERE),
            ("pocket_wall", NOWHERE),
            ("pocket_edge", NOWHERE),
            ("film_thickness", NOWHERE),
            ("traction", NOWHERE),
            ("self_heating", NOWHERE),
            ("lubrication_regime", NOWHERE),
            ("rolling_resistance", NOWHERE),
            ("guide_film", NOWHERE),
        ],
        states: &["inner_ring.", "roller["],
    },
];

const GREASE_GUIDE: [Row; 13] = [
    removed("gravity", &[("gravity", "null")], &[]),
    removed("pocket friction", &[("cage.pocket.solid_plane.contact.friction", "null")], &[]),
    removed("pocket damping", &[("cage.pocket.solid_plane.contact.damping", "null")], &[]),
    removed("pockets", &[("cage.pocket", "null")], &[("pocket_plane", NOWHERE)]),
    removed(
        "guide solid contact",
        &[("cage.guide.solid", "null"), ("cage.guide.film_share", "null")],
        &[("guide_solid", NOWHERE)],
    ),
    removed(
        "guide film",
        &[("cage.guide.film", "null"), ("cage.guide.film_share", "null")],
        &[("guide_film", NOWHERE)],
    ),
    removed("guide", &[("cage.guide", "null")], &[("guide_film", NOWHERE), ("guide_solid", NOWHERE)]),
    removed(
        "shear by the pressure gradient",
        &[("cage.guide.film.lubricant_layer.pressure_shear", "absent")],
        &[],
    ),
    Row {
        effect: "viscosity that hardly grows with pressure",
        kind: Kind::Replaced,
        set: &[("lubricant.pressure_viscosity", "1e-10")],
        gone: &[],
        states: &[],
    },
    Row {
        effect: "viscosity without temperature",
        kind: Kind::Replaced,
        set: &[("lubricant.viscosity", r#"{"constant": 0.0924}"#)],
        gone: &[("viscosity_temperature", NOWHERE)],
        states: &[],
    },
    added("roundness", &[("cage.guide.roundness", r#"[{"order": 3, "amplitude": 5e-6, "phase": 0.0}]"#)]),
    added("mass eccentricity", &[("cage.mass_eccentricity", r#"{"y": 20e-6, "z": 0.0}"#)]),
    Row {
        effect: "gravity alone",
        kind: Kind::Reference,
        set: &[
            ("lubricant", "null"),
            ("cage.pocket", "null"),
            ("cage.guide", "null"),
            ("record.duration", "0.05"),
            ("solver", STEP),
        ],
        gone: &[
            ("pocket_plane", NOWHERE),
            ("guide_film", NOWHERE),
            ("guide_solid", NOWHERE),
            ("viscosity_temperature", NOWHERE),
        ],
        states: &[],
    },
];
