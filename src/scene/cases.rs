//! Case sets: many scenes as one base scene and the values that differ.

use super::Scene;
use super::json::{parse, set_path, typed, typed_beside};
use super::problems::{self, Doubts, Found};
use super::validate::Judge;
use crate::error::{Error, Result, Status};
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;

/// Names of the formats without version.
pub(super) const CASES_NAME: &str = "cagedyn.cases/";
const SCENE_NAME: &str = "cagedyn.scene/";

/// Name and version of the format of case sets.
pub const CASES_SCHEMA: &str = "cagedyn.cases/1";

/// A series of runs that differ from a base scene in a few values.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct CaseSet {
    /// Format of this file: "cagedyn.cases/1".
    pub schema: String,
    /// Free text for tables and pictures.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub title: Option<String>,
    /// File name of the base scene, relative to this file.
    pub scene: String,
    /// The cases.
    pub cases: Vec<Case>,
}

/// One run of a case set.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct Case {
    /// Name, also used for files.
    pub name: String,
    /// Values by dotted path, as in "inner_ring.speed.constant". null removes an optional block.
    pub set: BTreeMap<String, serde_json::Value>,
}

impl CaseSet {
    /// Reads a case set.
    ///
    /// # Errors
    /// [`Status::BadJson`]; [`Status::BadScene`] for a wrong format name or names that cannot name files.
    pub fn from_json(text: &str) -> Result<Self> {
        let value = parse(text)?;
        Self::refuse_scenes(&value)?;
        let set: Self = typed(&value)?;
        set.judged(Judge::STRICT)?;
        Ok(set)
    }

    fn refuse_scenes(value: &serde_json::Value) -> Result<()> {
        if let Some(schema) = value.get("schema").and_then(|schema| schema.as_str())
            && schema.starts_with(SCENE_NAME)
        {
            let text = format!("schema: '{schema}' is a scene, not a case set; `cagedyn run` runs it");
            return Err(Error::new(Status::BadScene, text));
        }
        Ok(())
    }

    /// Checks format and names.
    fn judged(&self, judge: Judge<'_>) -> Result<()> {
        if self.schema != CASES_SCHEMA {
            judge.refuse("schema", format!("'{}' is not '{CASES_SCHEMA}'", self.schema))?;
        }
        for (i, case) in self.cases.iter().enumerate() {
            let path = format!("cases.{i}.name");
            let plain = |c: char| c.is_ascii_alphanumeric() || "-_.".contains(c);
            if case.name.is_empty() || case.name.starts_with('.') || !case.name.chars().all(plain) {
                let text = format!("'{}' has other characters than A-Z a-z 0-9 - _ .", case.name);
                judge.refuse(&path, text)?;
            }
            if self.cases[..i].iter().any(|other| other.name == case.name) {
                judge.refuse(&path, format!("'{}' is used twice", case.name))?;
            }
        }
        Ok(())
    }

    /// Everything that is wrong with a case set, but for its scenes.
    pub(crate) fn problems(value: &serde_json::Value) -> Vec<Found> {
        problems::all(value, &|doubts: &Doubts, pick| {
            Self::refuse_scenes(value)?;
            let set: Self = typed_beside(value, &doubts.unknown, pick)?;
            set.judged(Judge::beside(&doubts.paths))?;
            Ok(())
        })
    }

    /// The checked scene of every case; `base` is the JSON text of the base scene.
    ///
    /// # Errors
    /// As [`Scene::from_json_with`], with the name of the case in front.
    pub fn scenes(&self, base: &str) -> Result<Vec<Scene>> {
        let parsed = parse(base)?;
        Scene::from_value(&parsed)?;
        self.cases
            .iter()
            .map(|case| {
                let mut value = parsed.clone();
                case.set
                    .iter()
                    .try_for_each(|(path, new)| set_path(&mut value, path, new.clone()))
                    .and_then(|()| Scene::from_value(&value))
                    .map_err(|e| Error::new(e.status, format!("case {}: {e}", case.name)))
            })
            .collect()
    }
}
