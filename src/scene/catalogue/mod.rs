//! Materials and lubricants by name, each value with its source. A scene that names one is filled with its values where it gives
//! none itself; what then runs, and what is written back, has them all.
//!
//! An entry is one object in `materials.json` or `lubricants.json`: title, values as in scenes, and sources by the same names.

use crate::error::{Error, Result, Status};
use serde_json::{Map, Value, json};
use std::borrow::Cow;
use std::sync::OnceLock;

/// Text of the catalogue: `materials` and `lubricants` by name, with `title`, `values` and `sources`.
const TEXTS: [(&str, &str); 2] =
    [("materials", include_str!("materials.json")), ("lubricants", include_str!("lubricants.json"))];
/// An oil with all values.
const COMPLETE: &str = "fva_3";
/// Where a scene names an oil.
pub(super) const PATH: &str = "lubricant.catalogue";
/// Blocks whose `material` names one.
const BODIES: [&str; 6] = ["rollers", "balls", "kinematic_elements", "outer_ring", "inner_ring", "cage"];

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

/// The scene with the values of the catalogue that it names, and without the name of the oil.
///
/// # Errors
/// [`Status::BadScene`] for an oil that is not in the catalogue, or one of which nothing is taken.
pub(super) fn filled(scene: &Value) -> Result<Cow<'_, Value>> {
    let (full, refused) = filled_and_refused(scene);
    refused.map_or(Ok(full), |text| Err(Error::new(Status::BadScene, format!("{PATH}: {text}"))))
}

/// The same for a list of all that is wrong: what is wrong with the name of the oil is told, and nothing that follows from it.
pub(super) fn filled_and_refused(scene: &Value) -> (Cow<'_, Value>, Option<String>) {
    let named = scene.get("lubricant").and_then(|block| block.get("catalogue"));
    let materials: Map<String, Value> =
        named_materials(scene).map(|(name, values)| (name.to_owned(), values.clone())).collect();
    if named.is_none() && materials.is_empty() {
        return (Cow::Borrowed(scene), None);
    }
    let (mut full, mut refused) = (scene.clone(), None);
    if let Some(Value::Object(block)) = full.get_mut("lubricant")
        && let Some(name) = block.remove("catalogue").filter(|name| !name.is_null())
    {
        refused = take_oil(block, &name).err();
    }
    if !materials.is_empty()
        && let Value::Object(top) = &mut full
    {
        let own = top.entry("materials").or_insert_with(|| json!({}));
        // What is no list of materials is told by the reader.
        if let Value::Object(own) = own {
            own.extend(materials);
        }
    }
    (Cow::Owned(full), refused)
}

/// Gives a block what it does not have of the oil of this name, or what another one has where it is refused.
fn take_oil(block: &mut Map<String, Value>, name: &Value) -> std::result::Result<(), String> {
    let oil = name.as_str().and_then(|name| values("lubricants", name));
    let (Some(Value::Object(oil)), Some(name)) = (oil, name.as_str()) else {
        if let Some(Value::Object(complete)) = values("lubricants", COMPLETE) {
            fill(block, complete);
        }
        let known = names("lubricants").collect::<Vec<&str>>().join(", ");
        return Err(match name.as_str() {
            Some(name) => format!("'{name}' is not in the catalogue ({known})"),
            None => format!("expected a name of the catalogue ({known}), found {name}"),
        });
    };
    let before = block.clone();
    fill(block, oil);
    let text =
        || format!("nothing is taken of '{name}', as all values stand beside it; remove them, or the name");
    if *block == before { Err(text()) } else { Ok(()) }
}

/// Adds what a block does not have. What belongs together stays as the block has it.
fn fill(own: &mut Map<String, Value>, values: &Map<String, Value>) {
    for (key, value) in values {
        match (own.get_mut(key), value) {
            (None, value) => {
                own.insert(key.clone(), value.clone());
            }
            (Some(Value::Object(mine)), Value::Object(values)) if !is_whole(key, mine, values) => {
                fill(mine, values)
            }
            _ => {}
        }
    }
}

/// Whether an object of a scene is not to be mixed with that of the catalogue: a point, and a choice of another kind.
fn is_whole(key: &str, mine: &Map<String, Value>, values: &Map<String, Value>) -> bool {
    let same_kind = || values.keys().any(|kind| mine.contains_key(kind));
    matches!(key, "cold" | "hot") || (key == "viscosity" && !same_kind())
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
        assert_eq!(
            (&full["lubricant"]["conductivity"], &full["lubricant"]["catalogue"]),
            (&json!(0.2), &Value::Null)
        );
        let walther = &full["lubricant"]["viscosity"]["walther"];
        assert_eq!(
            (&walther["density"], &walther["cold"]["kinematic_viscosity"]),
            (&json!(900.0), &json!(68e-6))
        );
        assert!(matches!(filled(&full).unwrap(), Cow::Borrowed(_)));
        // A viscosity of another kind and half a point are not mixed with those of the oil.
        let with =
            |viscosity: Value| json!({"lubricant": {"catalogue": "iso_vg_68", "viscosity": viscosity}});
        let constant = with(json!({"constant": 0.06}));
        assert_eq!(filled(&constant).unwrap()["lubricant"]["viscosity"], json!({"constant": 0.06}));
        let half = with(json!({"walther": {"cold": {"temperature": 293.15}}}));
        assert_eq!(
            filled(&half).unwrap()["lubricant"]["viscosity"]["walther"]["cold"],
            json!({"temperature": 293.15})
        );
        assert!(matches!(filled(&json!({"cage": {"material": "brass"}})).unwrap(), Cow::Borrowed(_)));
        let refused = |scene: Value| filled(&scene).unwrap_err().message;
        let e = refused(json!({"lubricant": {"catalogue": "butter"}}));
        assert!(e.starts_with("lubricant.catalogue: 'butter'") && e.contains("iso_vg_68"), "{e}");
        // A name that changes nothing is no oversight to keep.
        let mut all = full.into_owned();
        all["lubricant"]["catalogue"] = json!("iso_vg_10");
        assert!(refused(all).contains("nothing is taken of 'iso_vg_10'"));
        // What is no block is left to the reader.
        for odd in [json!(3), json!([]), Value::Null, json!({"catalogue": null})] {
            assert!(
                filled(&json!({"lubricant": odd, "materials": odd, "cage": {"material": "steel_100cr6"}}))
                    .is_ok()
            );
        }
    }
}
