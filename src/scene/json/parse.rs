//! JSON text as a tree in which every key of an object stands once.

use super::complaint;
use crate::error::Result;
use serde::de::{DeserializeSeed, Deserializer, Error as _, MapAccess, SeqAccess, Visitor};
use serde_json::{Map, Value};
use std::fmt;

/// The longest path that a message shows; texts that nest deeper than scenes do are refused anyway.
const LONGEST_PATH: usize = 16;

/// Longest text, bytes: many times the largest table of a signal that a person would give, and read within a third of a gigabyte.
const LONGEST_TEXT: usize = 16 << 20;

/// Why a text is no JSON.
#[derive(Debug)]
pub struct Misread {
    /// Keys that lead to the place.
    pub path: Vec<String>,
    /// In words, with line and column.
    pub text: String,
    /// Line, from 1 on.
    pub line: usize,
}

/// Reads JSON text.
///
/// # Errors
/// [`crate::Status::BadJson`] for syntax, doubled keys and numbers beyond the range, with path, line and column.
pub fn parse(text: &str) -> Result<Value> {
    parse_located(text).map_err(|e| complaint(&e.path, e.text))
}

/// The same.
///
/// # Errors
/// Where and why.
pub fn parse_located(text: &str) -> std::result::Result<Value, Misread> {
    if text.len() > LONGEST_TEXT {
        let text = format!("{} bytes of text, at most {LONGEST_TEXT}", text.len());
        return Err(Misread { path: Vec::new(), text, line: 1 });
    }
    let mut path = Vec::new();
    // Some editors begin a file with this mark.
    let text = text.strip_prefix('\u{feff}').unwrap_or(text);
    let mut reader = serde_json::Deserializer::from_str(text);
    let value = Tree(&mut path).deserialize(&mut reader);
    value.and_then(|value| reader.end().map(|()| value)).map_err(|e| {
        path.truncate(LONGEST_PATH);
        let text = e.to_string().replace("expected value", "expected a JSON value");
        Misread { path, text, line: e.line().max(1) }
    })
}

/// Reads one value. The path is that of the value being read, and so, after an error, that of the error.
struct Tree<'a>(&'a mut Vec<String>);

impl<'de> DeserializeSeed<'de> for Tree<'_> {
    type Value = Value;

    fn deserialize<D: Deserializer<'de>>(self, reader: D) -> std::result::Result<Value, D::Error> {
        reader.deserialize_any(self)
    }
}

impl<'de> Visitor<'de> for Tree<'_> {
    type Value = Value;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("a JSON value")
    }

    fn visit_unit<E>(self) -> std::result::Result<Value, E> {
        Ok(Value::Null)
    }

    fn visit_bool<E>(self, value: bool) -> std::result::Result<Value, E> {
        Ok(value.into())
    }

    fn visit_u64<E>(self, value: u64) -> std::result::Result<Value, E> {
        Ok(value.into())
    }

    fn visit_i64<E>(self, value: i64) -> std::result::Result<Value, E> {
        Ok(value.into())
    }

    fn visit_f64<E>(self, value: f64) -> std::result::Result<Value, E> {
        Ok(value.into())
    }

    fn visit_str<E>(self, value: &str) -> std::result::Result<Value, E> {
        Ok(value.into())
    }

    fn visit_seq<A: SeqAccess<'de>>(self, mut access: A) -> std::result::Result<Value, A::Error> {
        let mut list = Vec::new();
        loop {
            self.0.push(list.len().to_string());
            let item = access.next_element_seed(Tree(&mut *self.0))?;
            self.0.pop();
            match item {
                Some(item) => list.push(item),
                None => return Ok(Value::Array(list)),
            }
        }
    }

    fn visit_map<A: MapAccess<'de>>(self, mut access: A) -> std::result::Result<Value, A::Error> {
        let mut map = Map::new();
        while let Some(key) = access.next_key::<String>()? {
            if map.contains_key(&key) {
                return Err(A::Error::custom(format!("duplicate field `{key}`")));
            }
            self.0.push(key.clone());
            let value = access.next_value_seed(Tree(&mut *self.0))?;
            self.0.pop();
            map.insert(key, value);
        }
        Ok(Value::Object(map))
    }
}
