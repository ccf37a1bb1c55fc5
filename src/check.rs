//! All that is wrong with a scene or a case set at once, with lines, for people who write them.

use crate::error::Result;
use crate::model::Model;
use crate::scene::problems::Found;
use crate::scene::{CaseSet, Scene, line_of, parse_located, parse_override, set_path};
use crate::sim::Sim;
use serde_json::Value;
use std::fmt;
use std::sync::Arc;

/// One thing that is wrong with a text.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Problem {
    /// JSON path, dotted; empty for the whole text.
    pub path: String,
    /// Line of that place, from 1 on; of the nearest one above it where it is missing.
    pub line: usize,
    /// What is wrong: the value and what is allowed, in one line.
    pub message: String,
}

impl fmt::Display for Problem {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if self.path.is_empty() {
            return f.write_str(&self.message);
        }
        write!(f, "{}: {}", self.path, self.message)
    }
}

impl Problem {
    fn new(text: &str, path: &[String], message: &str) -> Self {
        let message = message.replace(['\n', '\r'], " ");
        Self { path: path.join(".").replace(['\n', '\r'], " "), line: line_of(text, path), message }
    }
}

/// The tree of a text, or the one problem of a text that is no JSON.
fn tree(text: &str) -> std::result::Result<Value, Vec<Problem>> {
    parse_located(text).map_err(|e| {
        let path = e.path.join(".");
        vec![Problem { path, line: e.line, message: e.text }]
    })
}

/// What is wrong with a scene.
fn found(value: &Value) -> Vec<Found> {
    Scene::problems(value, &|scene, whole| {
        Model::needs(scene)?;
        if whole {
            Sim::new(Arc::new(Model::new(scene.copied())?))?;
        }
        Ok(())
    })
}

/// Replaces values; tells what leads nowhere.
fn replace<'a>(value: &mut Value, changes: impl Iterator<Item = (&'a str, Value)>) -> Vec<Found> {
    let refused = changes.filter_map(|(path, new)| {
        let error = set_path(value, path, new).err()?;
        let text = error.message.strip_prefix(path).and_then(|rest| rest.strip_prefix(": "));
        let text = text.unwrap_or(&error.message).to_owned();
        Some(Found { path: path.split('.').map(str::to_owned).collect(), text })
    });
    refused.collect()
}

impl Scene {
    /// Everything that is wrong with a scene, in the order of its lines; nothing of it is a consequence of something else in the
    /// list. What is no JSON is told alone, and at most a hundred problems are. Of values that depend on a wrong one nothing
    /// is said before that is mended; names of channels, viscosities far from their points and places to start from are
    /// checked when everything else is right.
    pub fn check(text: &str) -> Vec<Problem> {
        Self::check_with(text, [])
    }

    /// The same for a scene in which values are replaced, as by [`Scene::from_json_with`]: it must be right before and after.
    pub fn check_with<'a>(
        text: &str,
        overrides: impl IntoIterator<Item = (&'a str, &'a str)>,
    ) -> Vec<Problem> {
        let mut value = match tree(text) {
            Ok(value) => value,
            Err(problems) => return problems,
        };
        let mut list = found(&value);
        let mut overrides = overrides.into_iter().peekable();
        if overrides.peek().is_some() {
            let refused = replace(&mut value, overrides.map(|(path, new)| (path, parse_override(new))));
            for problem in refused.into_iter().chain(found(&value)) {
                if !list.contains(&problem) {
                    list.push(problem);
                }
            }
        }
        let problems = list.iter().map(|found| Problem::new(text, &found.path, &found.text));
        in_order(problems.collect())
    }
}

fn in_order(mut problems: Vec<Problem>) -> Vec<Problem> {
    problems.sort_by_key(|problem| problem.line);
    problems
}

impl CaseSet {
    /// Everything that is wrong with a case set, but for its scenes; as [`Scene::check`].
    pub fn check(text: &str) -> Vec<Problem> {
        let value = match tree(text) {
            Ok(value) => value,
            Err(problems) => return problems,
        };
        let found = CaseSet::problems(&value);
        in_order(found.iter().map(|found| Problem::new(text, &found.path, &found.text)).collect())
    }

    /// Everything that is wrong with the cases of the set whose text this is, and not with their base scene, whose text is
    /// `base`. Places are those of the case set.
    pub fn check_cases(&self, text: &str, base: &str) -> Vec<Problem> {
        let Ok(base) = tree(base) else { return Vec::new() };
        let of_base = found(&base);
        let cases = self.cases.iter().enumerate().flat_map(|(i, case)| {
            let mut value = base.clone();
            let refused =
                replace(&mut value, case.set.iter().map(|(path, new)| (path.as_str(), new.clone())));
            let new = refused.into_iter().chain(found(&value)).filter(|found| !of_base.contains(found));
            let problems = new.map(|found| {
                let dotted = found.path.join(".");
                let touches = |key: &&String| {
                    let below = |a: &str, b: &str| {
                        a.strip_prefix(b).is_some_and(|rest| rest.is_empty() || rest.starts_with('.'))
                    };
                    below(&dotted, key) || below(key, &dotted)
                };
                let mut place = vec!["cases".to_owned(), i.to_string()];
                if let Some(key) = case.set.keys().find(touches) {
                    place.extend(["set".to_owned(), key.clone()]);
                }
                let what = if dotted.is_empty() { found.text } else { format!("{dotted}: {}", found.text) };
                Problem::new(text, &place, &format!("case {}: {what}", case.name))
            });
            problems.collect::<Vec<_>>()
        });
        in_order(cases.collect())
    }
}

impl Model {
    /// Whether the scene has what its laws need. Its numbers are not looked at.
    ///
    /// # Errors
    /// [`crate::Status::BadScene`].
    fn needs(scene: &Scene) -> Result<()> {
        let viscosity = scene.lubricant.as_ref().map(|_| f64::NAN);
        crate::pairs::element_pairs(scene, viscosity)?;
        crate::pairs::shared_pairs(scene, viscosity).map(|_| ())
    }
}
