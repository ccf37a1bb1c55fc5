//! Rows of the table and how to write them.

use crate::common::{example, example_text, read, remove, with};
use cagedyn::{Model, Status};
use serde_json::Value;

/// One bad scene.
pub struct Row {
    pub name: &'static str,
    pub text: String,
    pub status: Status,
    /// Start of the message: the JSON path, or empty where there is none (syntax).
    pub path: &'static str,
    /// What else the message must say.
    pub says: &'static [&'static str],
}

impl Row {
    /// The same, refused at another place.
    pub fn at(self, path: &'static str) -> Self {
        Self { path, ..self }
    }
}

/// A valid scene that the rows spoil.
#[derive(Clone)]
pub struct Base(Value);

/// The example with rollers.
pub fn rollers() -> Base {
    Base(example())
}

/// The example with kinematic elements and a cage guided by a greased ring.
pub fn grease() -> Base {
    Base(serde_json::from_str(&grease_text()).expect("the example scene is JSON"))
}

/// The same with an elastic cage.
pub fn bent() -> Base {
    Base(serde_json::from_str(&read("scenes/grease_guide_elastic.json")).expect("the example scene is JSON"))
}

/// The same with a heat balance.
pub fn warm() -> Base {
    Base(serde_json::from_str(&read("scenes/grease_guide_heat.json")).expect("the example scene is JSON"))
}

/// A deep groove ball bearing in space.
pub fn deep_groove() -> Base {
    Base(serde_json::from_str(&read("scenes/deep_groove_6206.json")).expect("the example scene is JSON"))
}

/// An angular contact ball bearing in space.
pub fn angular_contact() -> Base {
    Base(serde_json::from_str(&read("scenes/angular_contact_218.json")).expect("the example scene is JSON"))
}

/// The same with a cage.
pub fn caged() -> Base {
    Base(
        serde_json::from_str(&read("scenes/angular_contact_70_cage.json"))
            .expect("the example scene is JSON"),
    )
}

fn grease_text() -> String {
    read("scenes/grease_guide.json")
}

impl Base {
    /// Another valid scene; null removes an optional block.
    pub fn with(&self, changes: &[(&str, Value)]) -> Self {
        let scene = Self(with(&self.0, changes));
        Model::from_json(&scene.0.to_string()).unwrap_or_else(|e| panic!("a base must be valid: {e}"));
        scene
    }

    fn changed(
        &self,
        name: &'static str,
        changes: &[(&str, Value)],
        status: Status,
        path: &'static str,
        says: &'static [&'static str],
    ) -> Row {
        Row { name, text: with(&self.0, changes).to_string(), status, path, says }
    }

    /// Wrong types and fields at one place.
    pub fn json(
        &self,
        name: &'static str,
        place: &'static str,
        value: Value,
        path: &'static str,
        says: &'static [&'static str],
    ) -> Row {
        self.changed(name, &[(place, value)], Status::BadJson, path, says)
    }

    /// A value that is refused at its own place.
    pub fn value(
        &self,
        name: &'static str,
        path: &'static str,
        value: Value,
        says: &'static [&'static str],
    ) -> Row {
        self.changed(name, &[(path, value)], Status::BadScene, path, says)
    }

    /// Values that are refused at `path`.
    pub fn scene(
        &self,
        name: &'static str,
        changes: &[(&str, Value)],
        path: &'static str,
        says: &'static [&'static str],
    ) -> Row {
        self.changed(name, changes, Status::BadScene, path, says)
    }

    /// Without one field.
    pub fn missing(
        &self,
        name: &'static str,
        field: &str,
        path: &'static str,
        says: &'static [&'static str],
    ) -> Row {
        let mut scene = self.0.clone();
        remove(&mut scene, field);
        Row { name, text: scene.to_string(), status: Status::BadJson, path, says }
    }

    /// Without one optional block that something else needs.
    pub fn needed(
        &self,
        name: &'static str,
        field: &str,
        path: &'static str,
        says: &'static [&'static str],
    ) -> Row {
        Row { status: Status::BadScene, ..self.missing(name, field, path, says) }
    }
}

/// A whole text that is not a scene.
pub fn text(name: &'static str, text: &str, says: &'static [&'static str]) -> Row {
    Row { name, text: text.to_owned(), status: Status::BadJson, path: "", says }
}

/// The example with one piece of text replaced, for what a JSON value cannot express.
pub fn replaced(
    name: &'static str,
    from: &str,
    to: &str,
    path: &'static str,
    says: &'static [&'static str],
) -> Row {
    replaced_in(&example_text(), name, from, to, path, says)
}

/// As [`replaced`] in the example with kinematic elements.
pub fn replaced_in_grease(
    name: &'static str,
    from: &str,
    to: &str,
    path: &'static str,
    says: &'static [&'static str],
) -> Row {
    replaced_in(&grease_text(), name, from, to, path, says)
}

fn replaced_in(
    text: &str,
    name: &'static str,
    from: &str,
    to: &str,
    path: &'static str,
    says: &'static [&'static str],
) -> Row {
    assert!(text.contains(from), "{name}: the example has no {from}");
    Row { name, text: text.replacen(from, to, 1), status: Status::BadJson, path, says }
}

/// Wrong types and fields: the place of the message is the place of the change.
pub fn json_row(
    name: &'static str,
    place: &'static str,
    value: Value,
    path: &'static str,
    says: &'static [&'static str],
) -> Row {
    rollers().json(name, place, value, path, says)
}

/// A value that is refused at its own place.
pub fn value_row(name: &'static str, path: &'static str, value: Value, says: &'static [&'static str]) -> Row {
    rollers().value(name, path, value, says)
}

/// Values that are refused at `path`.
pub fn scene_row(
    name: &'static str,
    changes: Vec<(&str, Value)>,
    path: &'static str,
    says: &'static [&'static str],
) -> Row {
    rollers().scene(name, &changes, path, says)
}

/// The example without one field.
pub fn missing(name: &'static str, field: &str, path: &'static str, says: &'static [&'static str]) -> Row {
    rollers().missing(name, field, path, says)
}

/// The example without one optional block that something else needs.
pub fn needed(name: &'static str, field: &str, path: &'static str, says: &'static [&'static str]) -> Row {
    rollers().needed(name, field, path, says)
}

/// What is wrong with the answer to a row; `None` if nothing is.
pub fn complaint(row: &Row) -> Option<String> {
    let error = match Model::from_json(&row.text) {
        Ok(_) => return Some("accepted".to_owned()),
        Err(error) => error,
    };
    let message = &error.message;
    let mut wrong = Vec::new();
    if error.status != row.status {
        wrong.push(format!("status {:?} instead of {:?}", error.status, row.status));
    }
    if message.trim().is_empty() || message.chars().any(char::is_control) {
        wrong.push("not one line of text".to_owned());
    }
    let rest = message.strip_prefix(row.path);
    if !row.path.is_empty() && !rest.is_some_and(|rest| rest.starts_with([':', '.'])) {
        wrong.push(format!("does not start with the path {}", row.path));
    }
    // Words of the language that this is written in tell a user nothing.
    for word in ["f64", "u32", "u64", "unit variant", "newtype", "map with a single key", "struct", "enum"] {
        if message.contains(word) {
            wrong.push(format!("says '{word}'"));
        }
    }
    for part in row.says.iter().filter(|part| !message.contains(**part)) {
        wrong.push(format!("does not say '{part}'"));
    }
    (!wrong.is_empty()).then(|| format!("{}; message: {message}", wrong.join(", ")))
}
