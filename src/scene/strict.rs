//! What serde lets pass and the JSON Schema does not: doubled keys of maps, and arrays in the place of objects.

use crate::error::{Error, Result, Status};
use serde::de::{Deserialize, Deserializer, Error as _, MapAccess, Visitor};
use serde::ser::Serialize;
use serde_json::Value;
use std::collections::BTreeMap;
use std::fmt;
use std::marker::PhantomData;

/// Reads a map and refuses doubled keys.
pub fn map<'de, D, V>(deserializer: D) -> std::result::Result<BTreeMap<String, V>, D::Error>
where
    D: Deserializer<'de>,
    V: Deserialize<'de>,
{
    struct Unique<V>(PhantomData<V>);

    impl<'de, V: Deserialize<'de>> Visitor<'de> for Unique<V> {
        type Value = BTreeMap<String, V>;

        fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
            f.write_str("an object")
        }

        fn visit_map<A: MapAccess<'de>>(self, mut access: A) -> std::result::Result<Self::Value, A::Error> {
            let mut map = BTreeMap::new();
            while let Some(key) = access.next_key::<String>()? {
                let value = access.next_value()?;
                if map.contains_key(&key) {
                    return Err(A::Error::custom(format!("duplicate field `{key}`")));
                }
                map.insert(key, value);
            }
            Ok(map)
        }
    }

    deserializer.deserialize_map(Unique(PhantomData))
}

/// Checks that the JSON text has objects and words where the typed data has them.
pub fn same_shape(text: &str, typed: &impl Serialize) -> Result<()> {
    let bad = |e: serde_json::Error| Error::new(Status::BadJson, e.to_string());
    same_shape_as(&serde_json::from_str(text).map_err(bad)?, typed)
}

/// As [`same_shape`] for parsed JSON.
pub fn same_shape_as(raw: &Value, typed: &impl Serialize) -> Result<()> {
    let typed = serde_json::to_value(typed).map_err(|e| Error::new(Status::BadJson, e.to_string()))?;
    compare(raw, &typed, &mut String::new())
}

fn compare(raw: &Value, typed: &Value, path: &mut String) -> Result<()> {
    let length = path.len();
    let mut step = |key: &str, raw: &Value, typed: &Value| {
        if length > 0 {
            path.push('.');
        }
        path.push_str(key);
        let result = compare(raw, typed, path);
        path.truncate(length);
        result
    };
    let wrong = match (raw, typed) {
        (Value::Object(raw), Value::Object(typed)) => {
            // A key that the typed data leaves out had its default or null.
            return raw.iter().try_for_each(|(key, value)| match typed.get(key) {
                Some(typed) => step(key, value, typed),
                None => Ok(()),
            });
        }
        (Value::Array(raw), Value::Array(typed)) => {
            let mut pairs = raw.iter().zip(typed).enumerate();
            return pairs.try_for_each(|(i, (raw, typed))| step(&i.to_string(), raw, typed));
        }
        (Value::Array(_), Value::Object(_)) => "invalid type: sequence, expected an object",
        (Value::Object(_), Value::String(_)) => "invalid type: map, expected a word",
        _ => return Ok(()),
    };
    Err(Error::new(Status::BadJson, format!("{path}: {wrong}")))
}
