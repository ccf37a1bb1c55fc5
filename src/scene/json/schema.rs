//! The JSON Schemas of the formats. Those of the folder `schemas` are part of the library; the feature `schema`, for tests,
//! makes them from the types, whose comments are their descriptions.

use crate::scene::{CaseSet, Scene};

impl Scene {
    /// The JSON Schema (draft 2020-12) of the scene format, as text.
    pub const JSON_SCHEMA: &str = include_str!("../../../schemas/scene.schema.json");

    /// The same from the types.
    #[cfg(feature = "schema")]
    pub fn generated_json_schema() -> serde_json::Value {
        finished(schemars::schema_for!(Scene).to_value())
    }
}

impl CaseSet {
    /// The JSON Schema (draft 2020-12) of the case set format, as text.
    pub const JSON_SCHEMA: &str = include_str!("../../../schemas/cases.schema.json");

    /// The same from the types.
    #[cfg(feature = "schema")]
    pub fn generated_json_schema() -> serde_json::Value {
        finished(schemars::schema_for!(CaseSet).to_value())
    }
}

/// The schema with what the reader takes beside what types say: remarks in every object, and plain numbers for constants.
#[cfg(feature = "schema")]
fn finished(mut schema: serde_json::Value) -> serde_json::Value {
    allow_more(&mut schema);
    schema
}

#[cfg(feature = "schema")]
fn allow_more(node: &mut serde_json::Value) {
    use serde_json::{Value, json};
    match node {
        Value::Array(items) => items.iter_mut().for_each(allow_more),
        Value::Object(map) => {
            map.values_mut().for_each(allow_more);
            if map.get("additionalProperties").is_some() {
                let properties = map.entry("properties").or_insert_with(|| json!({}));
                properties["comment"] = json!({"description": "Text for people, ignored."});
                properties["$schema"] = json!({"description": "For editors, ignored."});
            }
            if let Some(Value::Array(choices)) = map.get_mut("oneOf") {
                let constant = |choice: &Value| choice.pointer("/properties/constant").is_some();
                if choices.iter().any(constant) {
                    choices
                        .push(json!({"description": "The same as {\"constant\": ...}.", "type": "number"}));
                }
            }
        }
        _ => {}
    }
}
