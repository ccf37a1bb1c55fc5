//! Materials and lubricants by name, each value with its source. A scene that names one is filled with its values where it gives
//! none itself; what then runs, and what is written back, has them all.
//!
//! An entry is one object in `materials.json` or `lubricants.json`: title, values as in scenes, and sources by the same names.

use super::problems::Found;
use crate::error::{Error, Result, Status};
use serde_json::{Map, Value, json};
use std::borrow::Cow;
use std::sync::OnceLock;

/// Text of the catalogue: `materials` and `lubricants` by name, with `title`, `values` and `sources`.
const TEXTS: [(&str, &str); 2] =
    [("materials", include_str!("materials.json")), ("lubricants", include_str!("lubricants.json"))];
/// Where a scene names an oil.
const PATH: &str = "lubricant.catalogue";
/// Blocks whose `material` names one.
const BODIES: [&str; 5] = ["rollers", "kinematic_elements", "outer_ring", "inner_ring", "cage"];

/// The whole catalogue: `{"materials": {name: {title, values, sources}}, "lubricants": ...}`. Values are those of scenes, in SI
/// units.
pub fn catalogue() -> &'static Value {
    static CATALOGUE: OnceLock<Value> = OnceLock::new();
    CATALOGUE.get_or_init(|| {
        let part =
            |(name, text): (&str, &str)| (name.to_owned(), serde_json::from_str(text).unwrap_or(Value::Null));
        Value::Object(TEXTS.into_iter().map(part).collect())
    })
}

fn entries(kind: &str) -> Option<&'static Map<String, Value>> {
    catalogue().get(kind)?.as_object()
}

/// Values of an entry.
fn values(kind: &str, name: &str) -> Option<&'static Value> {
    entries(kind)?.get(name)?.get("values")
}

/// Names of the entries of a kind.
pub(super) fn names(kind: &str) -> impl Iterator<Item = &'static str> {
    entries(kind).into_iter().flat_map(|map| map.keys().map(String::as_str))
}

/// The oil that a scene names, if it does.
fn named_oil(scene: &Value) -> Option<&str> {
    scene.pointer("/lubricant/catalogue")?.as_str()
}

/// Materials that parts of a scene name and that it does not describe itself, as far as the catalogue has them.
fn named_materials(scene: &Value) -> impl Iterator<Item = (&str, &'static Value)> {
    let own = scene.get("materials");
    BODIES.into_iter().filter_map(move |body| {
        let name = scene.get(body)?.get("material")?.as_str()?;
        let described = own.is_some_and(|own| own.get(name).is_some());
        let values = (!described).then(|| values("materials", name))??;
        Some((name, values))
    })
}

/// The scene with the values of the catalogue that it names.
///
/// # Errors
/// [`Status::BadScene`] for an oil that is not in the catalogue.
pub(super) fn filled(scene: &Value) -> Result<Cow<'_, Value>> {
    let oil = match named_oil(scene) {
        Some(name) => Some(values("lubricants", name).ok_or_else(|| unknown_oil(name))?),
        None => None,
    };
    let materials: Map<String, Value> =
        named_materials(scene).map(|(name, values)| (name.to_owned(), values.clone())).collect();
    if oil.is_none() && materials.is_empty() {
        return Ok(Cow::Borrowed(scene));
    }
    let mut full = scene.clone();
    if let Some(values) = oil {
        fill(&mut full["lubricant"], values);
    }
    if !materials.is_empty() {
        // What is no list of materials is told by the reader.
        if full["materials"].is_null() {
            full["materials"] = Value::Object(Map::new());
        }
        if let Value::Object(own) = &mut full["materials"] {
            own.extend(materials);
        }
    }
    Ok(Cow::Owned(full))
}

/// The same for a list of all that is wrong: an oil that there is not is told, and another one stands in for it.
pub(super) fn filled_and_found(scene: &Value) -> (Cow<'_, Value>, Option<Found>) {
    let error = match filled(scene) {
        Ok(full) => return (full, None),
        Err(error) => error,
    };
    let path = PATH.split('.').map(str::to_owned).collect();
    let text = error.message.strip_prefix(PATH).unwrap_or_default().trim_start_matches(": ").to_owned();
    let mut other = scene.clone();
    other["lubricant"]["catalogue"] = json!(names("lubricants").next());
    let full = filled(&other).map(Cow::into_owned).unwrap_or(other);
    (Cow::Owned(full), Some(Found { path, text }))
}

fn unknown_oil(name: &str) -> Error {
    let known: Vec<&str> = names("lubricants").collect();
    let text = format!("{PATH}: '{name}' is not in the catalogue ({})", known.join(", "));
    Error::new(Status::BadScene, text)
}

/// Adds what a block does not have. A choice between kinds that the block has made stays as it is.
fn fill(block: &mut Value, values: &Value) {
    let (Value::Object(own), Value::Object(values)) = (block, values) else { return };
    for (key, value) in values {
        match own.get_mut(key) {
            None => {
                own.insert(key.clone(), value.clone());
            }
            Some(mine)
                if is_choice(key)
                    && value.as_object().is_some_and(|v| v.keys().all(|k| mine.get(k).is_none())) => {}
            Some(mine) => fill(mine, value),
        }
    }
}

/// Whether a field of a lubricant is one of several kinds.
fn is_choice(key: &str) -> bool {
    key == "viscosity"
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::laws::fluid::walther::Walther;
    use crate::scene::json::typed;
    use crate::scene::{Lubricant, Material, Viscosity, ViscosityPoint};

    #[test]
    fn every_entry_reads_and_has_sources_for_all_its_values() {
        for (kind, least) in [("materials", 5), ("lubricants", 8)] {
            let entries = entries(kind).unwrap();
            assert!(entries.len() >= least, "{kind}");
            for (name, entry) in entries {
                assert!(entry["title"].as_str().is_some_and(|title| title.len() > 5), "{name}");
                let mut names = Vec::new();
                let mut leaves = vec![("".to_owned(), &entry["values"])];
                while let Some((path, value)) = leaves.pop() {
                    match value {
                        Value::Object(map) => leaves.extend(map.iter().map(|(key, value)| {
                            (if path.is_empty() { key.clone() } else { format!("{path}.{key}") }, value)
                        })),
                        _ => names.push(path),
                    }
                }
                for path in names {
                    let source = entry["sources"].as_object().unwrap().iter().any(|(place, text)| {
                        (path == *place || path.starts_with(&format!("{place}.")))
                            && text.as_str().is_some_and(|t| t.len() > 5)
                    });
                    assert!(source, "{name}: {path} has no source");
                }
            }
        }
        for entry in entries("materials").unwrap().values() {
            typed::<Material>(&entry["values"]).unwrap();
        }
        for entry in entries("lubricants").unwrap().values() {
            typed::<Lubricant>(&entry["values"]).unwrap();
        }
    }

    /// What is derived is what the sources say: slopes of viscosities, and Wooster's rule for the mineral oils.
    #[test]
    fn derived_values_follow_from_the_others() {
        for (name, entry) in entries("lubricants").unwrap() {
            let oil = typed::<Lubricant>(&entry["values"]).unwrap();
            let Viscosity::Walther(walther) = &oil.viscosity else { panic!("{name}") };
            let point = |p: ViscosityPoint| (p.temperature, p.kinematic_viscosity);
            let law = Walther::new(point(walther.cold), point(walther.hot), walther.density);
            let slope = -law.relative_slope(333.15);
            let beta = oil.temperature_viscosity.unwrap();
            assert!((slope / beta - 1.0).abs() < 5e-3, "{name}: {slope} {beta}");
            if name.starts_with("iso_vg") {
                let eta = 1e3 * walther.cold.kinematic_viscosity * walther.density;
                let alpha = (0.6 + 0.965 * eta.log10()) * 1e-8;
                assert!((oil.pressure_viscosity.unwrap() / alpha - 1.0).abs() < 5e-3, "{name}: {alpha}");
            }
        }
    }

    #[test]
    fn what_a_scene_gives_itself_stays() {
        let scene = json!({
            "materials": {"mine": {"young_modulus": 1e9}},
            "cage": {"material": "mine"}, "rollers": {"material": "steel_100cr6"},
            "lubricant": {"catalogue": "iso_vg_68", "conductivity": 0.2, "viscosity": {"walther": {"density": 900.0}}}});
        let full = filled(&scene).unwrap();
        assert_eq!(full["materials"]["mine"], json!({"young_modulus": 1e9}));
        assert!(full["materials"]["steel_100cr6"]["young_modulus"].as_f64().unwrap() > 1.9e11);
        assert_eq!(full["lubricant"]["conductivity"], 0.2);
        let walther = &full["lubricant"]["viscosity"]["walther"];
        assert_eq!(
            (&walther["density"], &walther["cold"]["kinematic_viscosity"]),
            (&json!(900.0), &json!(68e-6))
        );
        // Filled once more it is the same; a viscosity of another kind is not mixed with that of the oil.
        assert_eq!(filled(&full).unwrap().as_ref(), full.as_ref());
        let constant = json!({"lubricant": {"catalogue": "iso_vg_68", "viscosity": {"constant": 0.06}}});
        assert_eq!(filled(&constant).unwrap()["lubricant"]["viscosity"], json!({"constant": 0.06}));
        assert!(matches!(filled(&json!({"cage": {"material": "brass"}})).unwrap(), Cow::Borrowed(_)));
        let e = filled(&json!({"lubricant": {"catalogue": "butter"}})).unwrap_err();
        assert!(
            e.message.starts_with("lubricant.catalogue: 'butter'") && e.message.contains("iso_vg_68"),
            "{e}"
        );
    }
}
