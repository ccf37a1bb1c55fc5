//! Replacing single values of a scene by their path.

use super::typed::CONSTANT;
use crate::error::{Error, Result, Status};
use serde_json::Value;

/// The JSON value of a text given by a user; a text that is not JSON is taken as a string.
pub fn parse_override(text: &str) -> Value {
    serde_json::from_str(text).unwrap_or_else(|_| Value::String(text.to_owned()))
}

/// Replaces the value at a dotted path (`cage.guide.roundness.0.amplitude`). The last object key may
/// be new; everything before it must exist. `null` removes the key, and with it an optional block.
///
/// # Errors
/// [`Status::UnknownName`] when the path leads nowhere.
pub fn set_path(scene: &mut Value, path: &str, new: Value) -> Result<()> {
    let unknown = |what: String| Error::new(Status::UnknownName, format!("{path}: {what}"));
    let mut place = scene;
    let mut walked = String::new();
    let mut keys = path.split('.').peekable();
    while let Some(key) = keys.next() {
        let last = keys.peek().is_none();
        place = match place {
            Value::Object(map) => {
                if last && new.is_null() {
                    map.remove(key);
                    return Ok(());
                } else if last {
                    map.entry(key).or_insert(Value::Null)
                } else {
                    map.get_mut(key).ok_or_else(|| {
                        let place = if walked.is_empty() { "the scene" } else { walked.as_str() };
                        unknown(format!("there is no '{key}' in {place}"))
                    })?
                }
            }
            Value::Array(list) => {
                let length = list.len();
                key.parse::<usize>()
                    .ok()
                    .and_then(|i| list.get_mut(i))
                    .ok_or_else(|| unknown(format!("'{walked}' has no item '{key}' (it has {length})")))?
            }
            // A number alone is a constant.
            Value::Number(_) if last && key == CONSTANT => place,
            _ => return Err(unknown(format!("'{walked}' is a plain value and has no '{key}'"))),
        };
        if !walked.is_empty() {
            walked.push('.');
        }
        walked.push_str(key);
    }
    *place = new;
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;
    use serde_json::json;

    #[test]
    fn sets_values_and_reports_bad_paths() {
        let mut v = json!({"a": {"b": [1, {"c": 2}]}, "n": 3});
        set_path(&mut v, "a.b.1.c", parse_override("5e-3")).unwrap();
        set_path(&mut v, "a.new", parse_override("text")).unwrap();
        set_path(&mut v, "n.constant", parse_override("4")).unwrap();
        assert_eq!(v["n"], json!(4));
        set_path(&mut v, "n", parse_override("null")).unwrap();
        assert_eq!(v, json!({"a": {"b": [1, {"c": 5e-3}], "new": "text"}}));
        for path in ["x.y", "a.b.7", "a.b.one", "a.b.0.z", "a.b.1.c.d"] {
            let e = set_path(&mut v, path, json!(1)).unwrap_err();
            assert_eq!(e.status, Status::UnknownName);
            assert!(e.message.starts_with(path), "{e}");
        }
    }
}
