//! The JSON Schemas of the formats. Those of the folder `schemas` are part of the library; the feature `schema`, for tests,
//! makes them from the types, whose comments are their descriptions.

use crate::scene::{CaseSet, Scene};

impl Scene {
    /// The JSON Schema (draft 2020-12) of the scene format, as text.
    pub const JSON_SCHEMA: &str = include_str!("../../../schemas/scene.schema.json");

    /// The same from the types.
    #[cfg(feature = "schema")]
    pub fn generated_json_schema() -> serde_json::Value {
        schemars::schema_for!(Scene).to_value()
    }
}

impl CaseSet {
    /// The JSON Schema (draft 2020-12) of the case set format, as text.
    pub const JSON_SCHEMA: &str = include_str!("../../../schemas/cases.schema.json");

    /// The same from the types.
    #[cfg(feature = "schema")]
    pub fn generated_json_schema() -> serde_json::Value {
        schemars::schema_for!(CaseSet).to_value()
    }
}
