//! The variables of a unit. A value reference is the place of a variable in this list.
//!
//! | variables | names |
//! |---|---|
//! | time | `time` |
//! | parameters: numbers of the scene | `scene.` and their paths, such as `scene.inner_ring.radial_clearance` |
//! | inputs, outputs | as in the library, such as `inner_ring.speed`, `cage.y_ratio` |
//! | states and their rates | `state.cage.y`, `der(state.cage.y)` |

use super::SCENE_FILE;
use super::units::of_rate;
use crate::error::{Error, Result, Status};
use crate::model::{HostInputs, Model};
use crate::scene::{Scene, set_path};
use serde_json::Value;
use std::hash::{DefaultHasher, Hash, Hasher};
use std::path::Path;
use std::sync::Arc;

/// Fields of a scene that are no parameters: they say what is recorded and nothing about the bearing.
const NOT_TUNED: [&str; 1] = ["record"];

/// What a variable is, with its place among those of its kind.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Kind {
    Time,
    Parameter(usize),
    Input(usize),
    Output(usize),
    State(usize),
    Rate(usize),
}

/// A variable.
#[derive(Clone, Debug)]
pub(super) struct Variable {
    pub(super) kind: Kind,
    pub(super) name: String,
    /// SI unit; "1" of ratios, empty where it is not told.
    pub(super) unit: &'static str,
    pub(super) description: String,
    /// Value at the start, where it does not follow from others.
    pub(super) start: Option<f64>,
}

/// What a unit is made of: a scene, compiled, with its variables. Shared by its instances.
#[derive(Debug)]
pub struct Unit {
    pub(super) scene: Value,
    pub(super) model: Arc<Model>,
    pub(super) variables: Vec<Variable>,
    /// Paths and values of the parameters.
    pub(super) parameters: Vec<(String, f64)>,
    /// First value references of states and of rates.
    pub(super) states: u32,
    pub(super) rates: u32,
    token: String,
}

impl Unit {
    /// Of the text of a scene.
    ///
    /// # Errors
    /// As [`Model::from_json`].
    pub fn new(text: &str) -> Result<Self> {
        let model = Model::from_json(text)?;
        // What the model was read from: comments are gone, numbers that stand for constants are written out.
        let scene: Value = serde_json::from_str(&model.scene().to_json())
            .map_err(|e| Error::new(Status::Internal, format!("the scene as JSON: {e}")))?;
        let parameters = parameters(&scene);
        // The sources alone: libraries for several platforms share a description.
        let (_, sources) = env!("CAGEDYN_BUILD").rsplit_once(' ').unwrap_or_default();
        let mut token = DefaultHasher::new();
        (sources, model.scene().to_json()).hash(&mut token);
        let mut unit = Self {
            model: Arc::new(model),
            variables: Vec::new(),
            states: 0,
            rates: 0,
            token: format!("{:016x}", token.finish()),
            scene,
            parameters,
        };
        unit.list_variables();
        Ok(unit)
    }

    /// Of the folder of the resources of an unpacked unit, whose description has this token.
    ///
    /// # Errors
    /// [`Status::File`]; as [`Unit::new`]; [`Status::BadSnapshot`] for a unit of another build of the library.
    pub fn open(resources: &Path, token: &str) -> Result<Self> {
        let path = resources.join(SCENE_FILE);
        let text = std::fs::read_to_string(&path)
            .map_err(|e| Error::new(Status::File, format!("{}: {e}", path.display())))?;
        let unit = Self::new(&text)?;
        if unit.token != token {
            let text = format!(
                "instantiationToken: '{token}' is not '{}': the scene was changed, or the unit is of another build of the library",
                unit.token
            );
            return Err(Error::new(Status::BadSnapshot, text));
        }
        Ok(unit)
    }

    /// Names scene and build: description and binary of a unit must agree on it.
    pub fn token(&self) -> &str {
        &self.token
    }

    /// Names of the variables, in the order of their value references.
    pub fn names(&self) -> impl Iterator<Item = &str> {
        self.variables.iter().map(|variable| variable.name.as_str())
    }

    /// The model.
    pub fn model(&self) -> &Model {
        &self.model
    }

    /// "3 inputs, 100 outputs, 20 parameters, 58 states".
    pub fn in_words(&self) -> String {
        let count =
            |is: fn(&Kind) -> bool| self.variables.iter().filter(|variable| is(&variable.kind)).count();
        format!(
            "{} inputs, {} outputs, {} parameters, {} states",
            count(|kind| matches!(kind, Kind::Input(_))),
            count(|kind| matches!(kind, Kind::Output(_))),
            self.parameters.len(),
            count(|kind| matches!(kind, Kind::State(_)))
        )
    }

    fn list_variables(&mut self) {
        let mut list = Vec::new();
        let mut add = |kind, name: String, unit, description: &str, start| {
            list.push(Variable { kind, name, unit, description: description.to_owned(), start });
            list.len() as u32 - 1
        };
        add(Kind::Time, "time".to_owned(), "s", "time", None);
        for (k, (path, value)) in self.parameters.iter().enumerate() {
            add(Kind::Parameter(k), format!("scene.{path}"), "", "number of the scene", Some(*value));
        }
        let at_start = self.model.inputs_at(0.0, &HostInputs::default());
        let inputs = self.model.input_infos();
        for (k, (info, input)) in inputs.iter().zip(self.model.input_list()).enumerate() {
            let start = Some(at_start.of(input));
            add(Kind::Input(k), info.name.clone(), info.unit, info.description, start);
        }
        for (k, channel) in self.model.channels().iter().enumerate() {
            // The place of a ring that the host moves is an input already.
            if inputs.iter().all(|input| input.name != channel.name) {
                add(Kind::Output(k), channel.name.clone(), channel.unit, channel.description, None);
            }
        }
        let states = self.model.state_infos();
        let mut firsts = [0; 2];
        for (k, info) in states.iter().enumerate() {
            let place =
                add(Kind::State(k), format!("state.{}", info.name), info.unit, info.description, None);
            firsts[0] = if k == 0 { place } else { firsts[0] };
        }
        for (k, info) in states.iter().enumerate() {
            let (name, unit) = (format!("der(state.{})", info.name), of_rate(info.unit));
            let place = add(Kind::Rate(k), name, unit, "rate of the state", None);
            firsts[1] = if k == 0 { place } else { firsts[1] };
        }
        [self.states, self.rates] = firsts;
        self.variables = list;
    }

    /// The variable of a value reference.
    pub(super) fn variable(&self, reference: u32) -> Result<&Variable> {
        self.variables.get(reference as usize).ok_or_else(|| {
            let text = format!("valueReference: {reference} is not within 0 to {}", self.variables.len() - 1);
            Error::new(Status::BadIndex, text)
        })
    }

    /// The model with these values of the parameters.
    pub(super) fn with(&self, parameters: &[f64]) -> Result<Arc<Model>> {
        let changed = || self.parameters.iter().zip(parameters).filter(|((_, own), new)| own != *new);
        if changed().next().is_none() {
            return Ok(self.model.clone());
        }
        let mut scene = self.scene.clone();
        for ((path, _), value) in changed() {
            set_path(&mut scene, path, serde_json::json!(value))?;
        }
        let model = Model::from_json(&scene.to_string())?;
        let states =
            |model: &Model| model.state_infos().into_iter().map(|info| info.name).collect::<Vec<_>>();
        let outputs =
            |model: &Model| model.channels().iter().map(|channel| channel.name.clone()).collect::<Vec<_>>();
        if states(&model) != states(&self.model) || outputs(&model) != outputs(&self.model) {
            let names = changed().map(|((path, _), _)| path.as_str()).collect::<Vec<_>>().join(", ");
            let text =
                format!("{names}: with these values the bearing has other states or outputs than the unit");
            return Err(Error::new(Status::BadScene, text));
        }
        Ok(Arc::new(model))
    }
}

/// Paths and values of the numbers of a scene that may be tuned: single numbers that need not be whole. Tables stay as they are.
fn parameters(scene: &Value) -> Vec<(String, f64)> {
    let mut found = Vec::new();
    for (name, value) in
        scene.as_object().into_iter().flatten().filter(|(name, _)| !NOT_TUNED.contains(&name.as_str()))
    {
        collect(value, name, &mut found);
    }
    // A field for whole numbers takes no half.
    let takes_halves = |path: &str| {
        let mut changed = scene.clone();
        let half = set_path(&mut changed, path, serde_json::json!(0.5));
        // A value out of its range is told in another way.
        let refused = half.and_then(|()| Scene::from_value(&changed).map(|_| ()));
        refused.err().is_none_or(|e| e.status == Status::BadScene)
    };
    found.retain(|(path, _)| takes_halves(path));
    found
}

fn collect(value: &Value, path: &str, found: &mut Vec<(String, f64)>) {
    match value {
        Value::Number(number) => found.extend(number.as_f64().map(|value| (path.to_owned(), value))),
        Value::Object(fields) => {
            fields.iter().for_each(|(name, field)| collect(field, &format!("{path}.{name}"), found))
        }
        Value::Array(items) if items.iter().all(Value::is_object) => {
            items.iter().enumerate().for_each(|(i, item)| collect(item, &format!("{path}.{i}"), found));
        }
        _ => {}
    }
}
