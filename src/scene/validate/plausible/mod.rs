//! What a scene may say and rarely means: every number against its usual range, alone and beside those that it belongs to.

mod groups;
mod numbers;
mod pockets;
mod scales;

use crate::error::Error;
use crate::scene::check::{Range, shown, slip_hint};
use crate::scene::validate::is_at_or_below;
use crate::scene::{Pocket, Scene, Signal};
use groups::{GROUPS, Group};
use numbers::NUMBERS;
use pockets::ROUND;
use serde::Deserialize;
use serde_json::Value;

impl Scene {
    /// Values that are legal and unlikely, one line for each: JSON path, value, why, and the unit that may have been meant.
    pub fn warnings(&self) -> Vec<String> {
        // By way of the text: a second writer of scenes would be as large as the first.
        let Ok(value) = serde_json::from_str(&self.to_json()) else { return Vec::new() };
        let mut told: Vec<(String, String)> = Vec::new();
        for (pattern, usual) in NUMBERS {
            at(&value, pattern, String::new(), &mut |path, number| {
                if number != 0.0
                    && let Some(line) =
                        unlikely(&path, number, *usual, ["unusually small", "unusually large"])
                {
                    told.push((path, line));
                }
            });
        }
        for group in all_groups() {
            let because = |(path, _): &(String, String)| {
                let related = |place: &str| is_at_or_below(path, place) || is_at_or_below(place, path);
                related(group.path) || group.from.iter().any(|place| related(place))
            };
            if let Some((number, usual)) = (group.find)(self)
                && number != 0.0
                && !told.iter().any(because)
                && let Some(line) = unlikely(group.path, number, usual, group.is)
            {
                told.push((group.path.to_owned(), line));
            }
        }
        told.into_iter().map(|(_, line)| line).chain(self.cage_free_to_leave()).collect()
    }

    /// Whether a cage among balls that move is between walls that leave it free along the axis.
    fn cage_free_to_leave(&self) -> Option<String> {
        let pocket = self.cage.as_ref().filter(|_| self.balls.is_some())?.pocket.as_ref()?;
        let free = matches!(pocket, Pocket::SolidPlane(pocket) if pocket.axial_clearance.is_none());
        let text = "cage.pocket.solid_plane.axial_clearance: absent: nothing holds the cage along the axis";
        free.then(|| format!("{text}; give it, or a round pocket"))
    }

    /// An error of the start of a run with the first of the [`Scene::warnings`], which may be why.
    pub(crate) fn suspected(&self, error: Error) -> Error {
        let Some(first) = self.warnings().into_iter().next() else { return error };
        Error::new(error.status, format!("{}; unlikely in this scene: {first}", error.message))
    }
}

/// Numbers that are judged by others.
fn all_groups() -> impl Iterator<Item = &'static Group> {
    GROUPS.iter().chain(const { &ROUND }.as_flattened())
}

/// Tells the sizes of all numbers, and of functions of time, whose path has the form of a pattern.
fn at(value: &Value, pattern: &str, path: String, tell: &mut impl FnMut(String, f64)) {
    if pattern.is_empty() {
        let over_time = || Signal::deserialize(value).ok().map(|signal| signal.largest());
        if let Some(number) = value.as_f64().map(f64::abs).or_else(over_time) {
            tell(path, number);
        }
        return;
    }
    let (key, rest) = pattern.split_once('.').unwrap_or((pattern, ""));
    let deep = key == "**";
    if deep {
        at(value, rest, path.clone(), tell);
    }
    let rest = if deep { pattern } else { rest };
    let mut follow = |name: &str, value: &Value| {
        let path = if path.is_empty() { name.to_owned() } else { format!("{path}.{name}") };
        at(value, rest, path, tell);
    };
    match value {
        Value::Object(map) if deep || key == "*" => map.iter().for_each(|(name, value)| follow(name, value)),
        Value::Object(map) => {
            if let Some(value) = map.get(key) {
                follow(key, value);
            }
        }
        Value::Array(list) if deep || key == "*" => {
            list.iter().enumerate().for_each(|(i, value)| follow(&i.to_string(), value));
        }
        _ => {}
    }
}

/// The line for a value outside `usual`, in the unit of that range.
fn unlikely(path: &str, value: f64, usual: Range, is: [&str; 2]) -> Option<String> {
    let (is, limit, bound) = match value {
        _ if value < usual.min => (is[0], "less", usual.min),
        _ if value > usual.max => (is[1], "more", usual.max),
        _ => return None,
    };
    let unit = if usual.unit.is_empty() { String::new() } else { format!(" {}", usual.unit) };
    let hint = slip_hint(value, usual);
    Some(format!("{path}: {}{unit} is {is}, {limit} than {}{unit}{hint}", shown(value), shown(bound)))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::Model;
    use crate::sim::Sim;
    use std::f64::consts::PI;
    use std::sync::Arc;

    const ROLLERS: &str = include_str!("../../../../scenes/nu2310.json");
    const GREASE: &str = include_str!("../../../../scenes/grease_guide.json");

    const OIL: &str = include_str!("../../../../scenes/ball_short_bearing.json");

    fn warnings(text: &str, set: &[(&str, &str)]) -> Vec<String> {
        let scene = Scene::from_json_with(text, set.iter().copied());
        scene.unwrap_or_else(|e| panic!("{e}")).warnings()
    }

    #[test]
    fn what_prevents_a_start_is_told_beside_what_is_unlikely() {
        let set = [("materials.steel.young_modulus", "2.06e8")];
        let scene = Scene::from_json_with(ROLLERS, set).unwrap();
        let error = Sim::new(Arc::new(Model::new(scene).unwrap())).err().unwrap();
        for part in ["the inner ring has left the bearing", "unlikely", "young_modulus", "2.06e11 Pa"] {
            assert!(error.message.contains(part), "{error}");
        }
    }

    #[test]
    fn unlikely_values_are_named_with_the_unit_that_was_meant() {
        for (text, path, value, meant) in [
            (ROLLERS, "inner_ring.speed.constant", "-3000", "revolutions per minute, 314.159 rad/s"),
            (ROLLERS, "gravity.z", "-9806.65", "mm/s^2, 9.80665 m/s^2"),
            (ROLLERS, "gravity.z", "-21", "twice that of the earth"),
            (ROLLERS, "initial.first_roller_angle", "90", "degrees, 1.5708 rad"),
            (ROLLERS, "initial.cage_speed", "-1360", "revolutions per minute"),
            (ROLLERS, "inner_ring.motion.free.load.z.constant", "-1e6", "beyond what such a bearing carries"),
            (ROLLERS, "inner_ring.motion.free.load.z.constant", "-4.9e6", "millinewtons, 4900 N"),
            (ROLLERS, "inner_ring.motion.free.support_damping", "0.003", "kN s/mm, 3000 N s/m"),
            (ROLLERS, "inner_ring.motion.free.mass", "3000", "grams, 3 kg"),
            (ROLLERS, "inner_ring.radial_clearance", "3e-4", "axial"),
            (ROLLERS, "lubricant.viscosity.constant", "60", "millipascal seconds, 0.06 Pa s"),
            (ROLLERS, "lubricant.viscosity.constant", "6e-5", "m^2/s of oil with 880 kg/m^3, 0.0528 Pa s"),
            (ROLLERS, "lubricant.pressure_viscosity", "2e-7", "unusually large"),
            (ROLLERS, "materials.steel.young_modulus", "2.06e8", "kilopascals, 2.06e11 Pa"),
            (ROLLERS, "materials.brass.thermal.density", "850", ""),
            (ROLLERS, "record.duration", "300", "milliseconds, 0.3 s"),
            (ROLLERS, "cage.pocket.lubricated_cylinder.radial_clearance", "1.5e-6", "small for this size"),
            (GREASE, "cage.guide.solid.contact.stiffness", "1", "N/um, 1e6 N/m"),
            (GREASE, "cage.guide.solid.contact.stiffness", "1e12", "stiffer than solid steel"),
            (GREASE, "cage.pocket.solid_plane.contact.stiffness", "1e3", "weight of the cage"),
            (GREASE, "cage.guide.solid.contact.damping", "4e-4", "hardly any damping"),
            (OIL, "cage.guide.diametral_clearance", "4e-6", "unusually small"),
            (GREASE, "cage.guide.film.lubricant_layer.thickness", "8e-2", "many times the clearance"),
            (ROLLERS, "rollers.dynamic_load_rating", "121", "kilonewtons, 121000 N"),
            (GREASE, "inner_ring.speed.constant", "3000", "revolutions per minute, 314.159 rad/s"),
        ] {
            let list = warnings(text, &[(path, value)]);
            if meant.is_empty() {
                assert_eq!(list, [""; 0], "{path} = {value}");
                continue;
            }
            let start = path.trim_end_matches(".constant").trim_end_matches(".z");
            assert!(
                list.len() == 1 && list[0].starts_with(start) && list[0].contains(meant),
                "{path} = {value}: {list:?}"
            );
        }
        // Both in grams pass every check of one against the other.
        let grams = [("rollers.mass", "30.4"), ("rollers.inertia", "8.55e-4")];
        let list = warnings(ROLLERS, &grams);
        assert!(list.len() == 1 && list[0].contains("grams, 0.0304 kg"), "{list:?}");
        let grams = [("cage.mass", "12.34"), ("cage.inertia", "2.511e-2")];
        let list = warnings(GREASE, &grams);
        assert!(list.len() == 1 && list[0].contains("grams, 0.01234 kg"), "{list:?}");
    }

    /// Bearings of other sizes, by what catalogues say of them: nothing of them is unlikely.
    #[test]
    fn walls_that_leave_a_cage_free_along_the_axis_are_told() {
        let caged = include_str!("../../../../scenes/angular_contact_70_cage.json");
        let walls = |more: &str| {
            let pocket = format!(
                r#"{{"solid_plane": {{"diametral_clearance": 5e-4, {more} "contact": {{"stiffness": 1e6, "softening_depth": 1e-6}}}}}}"#
            );
            Scene::from_json_with(caged, [("cage.pocket", pocket.as_str())]).unwrap().warnings()
        };
        assert!(walls("")[0].contains("nothing holds the cage along the axis"));
        assert_eq!(walls(r#""axial_clearance": 5e-4,"#), Vec::<String>::new());
    }

    #[test]
    fn bearings_of_all_sizes_are_likely() {
        // Rollers: count, diameter, length, pitch diameter, radial clearance (mm), speed (1/min), load (N).
        for (name, count, diameter, length, pitch, clearance, speed, load) in [
            ("NU 206", 13, 9.0, 9.0, 46.0, 0.035, 12_000.0, 8e3),
            ("NU 215", 16, 15.0, 16.0, 102.5, 0.06, 5_600.0, 40e3),
            ("NU 1010", 20, 9.0, 9.0, 65.0, 0.05, 13_000.0, 10e3),
            ("NJ 2309", 12, 14.0, 20.0, 72.5, 0.05, 8_000.0, 50e3),
            ("full complement", 17, 11.0, 20.0, 61.0, 0.05, 4_000.0, 60e3),
            ("620 mm", 40, 36.0, 60.0, 620.0, 0.3, 1_000.0, 1e6),
            ("miniature", 10, 2.0, 2.0, 10.0, 0.045, 50_000.0, 100.0),
            ("gearbox", 14, 4.0, 8.0, 27.0, 0.04, 20_000.0, 2e3),
        ] {
            let (r, l, rp) = (0.5e-3 * diameter, 1e-3 * length, 0.5e-3 * pitch);
            let mass = 7830.0 * PI * r * r * l;
            let ring = 3.0 * 7830.0 * PI * (rp - r).powi(2) * l;
            let sets = [
                ("cage", "null".to_owned()),
                ("rollers.count", count.to_string()),
                ("rollers.radius", format!("{r:e}")),
                ("rollers.effective_length", format!("{:e}", 0.95 * l)),
                ("rollers.mass", format!("{mass:e}")),
                ("rollers.inertia", format!("{:e}", 0.5 * mass * r * r)),
                ("outer_ring.raceway_radius", format!("{:e}", rp + r + 0.25e-3 * clearance)),
                ("inner_ring.radial_clearance", format!("{:e}", 1e-3 * clearance)),
                ("inner_ring.speed.constant", format!("{:e}", speed * PI / 30.0)),
                ("inner_ring.motion.free.mass", format!("{ring:e}")),
                ("inner_ring.motion.free.support_damping", format!("{:e}", 1e-2 * (2e11 * l * ring).sqrt())),
                ("inner_ring.motion.free.load.z.constant", format!("{:e}", -load)),
            ];
            let sets: Vec<(&str, &str)> = sets.iter().map(|(path, value)| (*path, value.as_str())).collect();
            assert_eq!(warnings(ROLLERS, &sets), [""; 0], "{name}");
        }
        // Balls: count, diameter, pitch diameter, guide clearance, pocket clearance (mm), mass of the cage (g), speed (1/min).
        for (name, count, diameter, pitch, guide, pocket, cage, speed) in [
            ("6205", 9, 7.94, 39.0, 0.3, 0.3, 10.0, 16_000.0),
            ("7008", 17, 7.14, 54.0, 0.35, 0.3, 9.0, 30_000.0),
            ("7206", 13, 9.5, 46.0, 0.35, 0.35, 12.0, 20_000.0),
            ("dental", 8, 1.0, 5.0, 0.12, 0.12, 0.02, 400_000.0),
        ] {
            let (r, rp) = (0.5e-3 * diameter, 0.5e-3 * pitch);
            let mass = 1e-3 * cage;
            let stiffness: f64 = 1e6 * diameter / 8.7;
            let sets = [
                ("kinematic_elements.count", count.to_string()),
                ("kinematic_elements.radius", format!("{r:e}")),
                ("kinematic_elements.pitch_radius", format!("{rp:e}")),
                ("inner_ring.speed.constant", format!("{:e}", speed * PI / 30.0)),
                ("initial.cage_speed", "null".to_owned()),
                ("cage.mass", format!("{mass:e}")),
                ("cage.inertia", format!("{:e}", mass * rp * rp)),
                ("cage.guide.guide_radius", format!("{:e}", rp + 0.4 * r)),
                ("cage.guide.diametral_clearance", format!("{:e}", 1e-3 * guide)),
                ("cage.guide.film.lubricant_layer.land_width", format!("{:e}", 2.0 * r)),
                ("cage.pocket.solid_plane.diametral_clearance", format!("{:e}", 1e-3 * pocket)),
                ("cage.pocket.solid_plane.contact.stiffness", format!("{stiffness:e}")),
                ("cage.guide.solid.contact.stiffness", format!("{stiffness:e}")),
                ("cage.guide.solid.contact.damping", format!("{:e}", 0.4 * (stiffness * mass).sqrt())),
            ];
            let sets: Vec<(&str, &str)> = sets.iter().map(|(path, value)| (*path, value.as_str())).collect();
            assert_eq!(warnings(GREASE, &sets), [""; 0], "{name}");
        }
    }

    /// Every number of committed scenes and starters is looked at, and none is unlikely.
    #[test]
    fn every_number_of_committed_scenes_is_looked_at() {
        // Numbers that every value of is as likely, and those of checks that leave no room for units.
        const OTHERS: &[&str] = &[
            "rollers.count",
            "rollers.radius",
            "rollers.inertia",
            "outer_ring.raceway_radius",
            "cage.inertia",
            "balls.count",
            "balls.radius",
            "kinematic_elements.count",
            "kinematic_elements.radius",
            "kinematic_elements.pitch_radius",
            "kinematic_elements.effective_length",
            "inner_ring.motion.fixed",
            "cage.space.transverse_inertia",
            "cage.space.mass_offset_x",
            "initial.cage",
            "initial.cage_velocity",
            "solver",
            "record.interval",
            "record.window",
            "cage.pocket.lubricated_cylinder.half_angle",
            "cage.pocket.lubricated_cylinder.edge_blend",
            "cage.elastic_ring.modes",
            "cage.elastic_ring.contact_depth",
            "cage.elastic_ring.stiffness.section.pocket_diameter",
            "rollers.profile.logarithmic",
        ];
        const OF_ANY: &[&str] = &[
            "share",
            "inner_share",
            "order",
            "exponent",
            "lambda_boundary",
            "load",
            "own_time",
            "rolling",
            "sliding",
            "guide_radius",
            "slices",
            "pressure_cap",
            "touching_ratio",
        ];
        let folders = ["scenes", "src/bin/cagedyn/starters"]
            .map(|folder| std::fs::read_dir(format!("{}/{folder}", env!("CARGO_MANIFEST_DIR"))).unwrap());
        let mut scenes = 0;
        for file in folders.into_iter().flatten() {
            let path = file.unwrap().path();
            let name = path.display().to_string();
            if !name.ends_with(".json") || name.ends_with(".cases.json") {
                continue;
            }
            let scene = Scene::from_json(&std::fs::read_to_string(&path).unwrap()).unwrap();
            assert_eq!(scene.warnings(), [""; 0], "{name}");
            let value = serde_json::to_value(&scene).unwrap();
            let mut seen: Vec<String> = Vec::new();
            for (pattern, _) in NUMBERS {
                at(&value, pattern, String::new(), &mut |path, _| seen.push(path));
            }
            seen.extend(all_groups().map(|group| group.path.to_owned()));
            seen.extend(OTHERS.iter().map(|path| (*path).to_owned()));
            let mut leaves = Vec::new();
            numbers(&value, String::new(), &mut leaves);
            let missed: Vec<&String> = leaves
                .iter()
                .filter(|path| !seen.iter().any(|place| is_at_or_below(path, place)))
                .filter(|path| !OF_ANY.contains(&path.rsplit('.').next().unwrap()))
                .collect();
            assert!(missed.is_empty(), "{name}: {missed:?}");
            scenes += 1;
        }
        assert!(scenes > 9, "{scenes}");
    }

    #[test]
    fn documented_scenes_are_likely() {
        let pages = [
            include_str!("../../../../README.md"),
            include_str!("../../../../docs/scene.md"),
            include_str!("../../../../docs/scene/bearing.md"),
        ];
        let blocks = pages.iter().flat_map(|page| page.split("```json").skip(1));
        let scenes = blocks.filter_map(|block| Scene::from_json(block.split("```").next()?).ok());
        let scenes: Vec<Scene> = scenes.collect();
        assert!(scenes.len() > 1, "{}", scenes.len());
        for scene in scenes {
            assert_eq!(scene.warnings(), [""; 0]);
        }
    }

    fn numbers(value: &Value, path: String, out: &mut Vec<String>) {
        let below = |key: &str| if path.is_empty() { key.to_owned() } else { format!("{path}.{key}") };
        match value {
            Value::Number(_) => out.push(path),
            Value::Object(map) => map.iter().for_each(|(key, value)| numbers(value, below(key), out)),
            Value::Array(list) => {
                list.iter().enumerate().for_each(|(i, value)| numbers(value, below(&i.to_string()), out));
            }
            _ => {}
        }
    }
}
