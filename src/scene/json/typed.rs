//! Typed data from parsed JSON: objects for blocks, words for choices, nothing left over. Stricter than serde_json, which
//! takes arrays for blocks and objects for words.

use super::{complaint, shortened};
use crate::error::Result;
use serde::de::value::StrDeserializer;
use serde::de::{
    self, DeserializeOwned, DeserializeSeed, EnumAccess, IntoDeserializer, MapAccess, SeqAccess, Unexpected,
    VariantAccess, Visitor,
};
use serde::forward_to_deserialize_any;
use serde_json::{Map, Value, map};
use std::fmt;

/// Longest piece of the text that a message repeats, characters.
const LONGEST_QUOTE: usize = 60;

/// Makes typed data of a JSON value.
///
/// # Errors
/// [`crate::Status::BadJson`] with the path of a value of the wrong type, or of an unknown or missing field.
pub fn typed<T: DeserializeOwned>(value: &Value) -> Result<T> {
    T::deserialize(Reader(value)).map_err(|mut e| {
        e.path.reverse();
        complaint(&e.path, &e.text)
    })
}

/// Whole numbers up to this are doubles without loss.
const LARGEST_WHOLE: f64 = 9_007_199_254_740_992.0;

/// What is wrong, and the keys that lead there, the last one first.
#[derive(Debug)]
struct Complaint {
    path: Vec<String>,
    text: String,
}

impl Complaint {
    fn expected(what: &str, found: &Value) -> Self {
        let found = shortened(found.to_string(), LONGEST_QUOTE);
        de::Error::custom(format!("expected {what}, found {found}"))
    }

    fn below(mut self, key: &str) -> Self {
        self.path.push(key.to_owned());
        self
    }
}

impl de::Error for Complaint {
    fn custom<T: fmt::Display>(text: T) -> Self {
        Self { path: Vec::new(), text: text.to_string() }
    }

    /// Of numbers only, which [`Reader`] lets the field's own type judge.
    fn invalid_value(found: Unexpected<'_>, _: &dyn de::Expected) -> Self {
        let found = match found {
            Unexpected::Unsigned(number) => number.to_string(),
            Unexpected::Signed(number) => number.to_string(),
            other => other.to_string(),
        };
        Self::custom(format!("{found} is out of range"))
    }
}

impl fmt::Display for Complaint {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.text)
    }
}

impl std::error::Error for Complaint {}

type Read<T> = std::result::Result<T, Complaint>;

/// A value to be read.
#[derive(Clone, Copy)]
struct Reader<'de>(&'de Value);

impl<'de> Reader<'de> {
    fn object(self) -> Read<Fields<'de>> {
        match self.0 {
            Value::Object(map) => Ok(Fields { rest: map.iter(), value: None }),
            other => Err(Complaint::expected("an object", other)),
        }
    }

    fn whole<V: Visitor<'de>>(self, visitor: V) -> Read<V::Value> {
        // Many languages write whole numbers as 12.0.
        let whole = |x: f64| ((0.0..=LARGEST_WHOLE).contains(&x) && x.fract() == 0.0).then_some(x as u64);
        match self.0.as_u64().or_else(|| self.0.as_f64().and_then(whole)) {
            Some(number) => visitor.visit_u64(number),
            None => Err(Complaint::expected("a whole number from 0 on", self.0)),
        }
    }
}

impl<'de> de::Deserializer<'de> for Reader<'de> {
    type Error = Complaint;

    /// For parts that stay JSON.
    fn deserialize_any<V: Visitor<'de>>(self, visitor: V) -> Read<V::Value> {
        self.0.deserialize_any(visitor).map_err(de::Error::custom)
    }

    fn deserialize_bool<V: Visitor<'de>>(self, visitor: V) -> Read<V::Value> {
        let value = self.0.as_bool().ok_or_else(|| Complaint::expected("true or false", self.0))?;
        visitor.visit_bool(value)
    }

    fn deserialize_f64<V: Visitor<'de>>(self, visitor: V) -> Read<V::Value> {
        let value = self.0.as_f64().ok_or_else(|| Complaint::expected("a number", self.0))?;
        visitor.visit_f64(value)
    }

    fn deserialize_u32<V: Visitor<'de>>(self, visitor: V) -> Read<V::Value> {
        self.whole(visitor)
    }

    fn deserialize_u64<V: Visitor<'de>>(self, visitor: V) -> Read<V::Value> {
        self.whole(visitor)
    }

    fn deserialize_string<V: Visitor<'de>>(self, visitor: V) -> Read<V::Value> {
        let value = self.0.as_str().ok_or_else(|| Complaint::expected("a text", self.0))?;
        visitor.visit_borrowed_str(value)
    }

    fn deserialize_option<V: Visitor<'de>>(self, visitor: V) -> Read<V::Value> {
        if self.0.is_null() { visitor.visit_none() } else { visitor.visit_some(self) }
    }

    fn deserialize_seq<V: Visitor<'de>>(self, visitor: V) -> Read<V::Value> {
        let list = self.0.as_array().ok_or_else(|| Complaint::expected("an array", self.0))?;
        visitor.visit_seq(Items { list, next: 0 })
    }

    fn deserialize_map<V: Visitor<'de>>(self, visitor: V) -> Read<V::Value> {
        visitor.visit_map(self.object()?)
    }

    fn deserialize_struct<V: Visitor<'de>>(
        self,
        _: &'static str,
        _: &'static [&'static str],
        visitor: V,
    ) -> Read<V::Value> {
        visitor.visit_map(self.object()?)
    }

    fn deserialize_enum<V: Visitor<'de>>(
        self,
        _: &'static str,
        variants: &'static [&'static str],
        visitor: V,
    ) -> Read<V::Value> {
        let one = |map: &'de Map<String, Value>| {
            let mut keys = map.iter().filter(|(key, _)| !is_remark(key));
            keys.next().filter(|_| keys.next().is_none())
        };
        let choice = match self.0 {
            Value::String(word) => Some(Choice { word, content: None }),
            Value::Object(map) => one(map).map(|(word, value)| Choice { word, content: Some(value) }),
            // A number alone is a constant.
            Value::Number(_) if variants.contains(&CONSTANT) => {
                Some(Choice { word: CONSTANT, content: Some(self.0) })
            }
            _ => None,
        };
        let choice = choice.ok_or_else(|| no_choice(variants, self.0))?;
        visitor.visit_enum(choice)
    }

    forward_to_deserialize_any! {
        i8 i16 i32 i64 i128 u8 u16 u128 f32 char str bytes byte_buf unit unit_struct newtype_struct tuple tuple_struct
        identifier ignored_any
    }
}

/// The alternative that a plain number stands for.
pub(super) const CONSTANT: &str = "constant";

/// Whether a key of an object is a remark for people and editors, which every object may have.
fn is_remark(key: &str) -> bool {
    key == "comment" || key == "$schema"
}

/// What is wrong with a value that is no word and no object with one key.
fn no_choice(variants: &[&str], found: &Value) -> Complaint {
    let what = if found.is_object() { "one key" } else { "one" };
    Complaint::expected(&format!("{what} of `{}`", variants.join("`, `")), found)
}

/// The fields of an object.
struct Fields<'de> {
    rest: map::Iter<'de>,
    value: Option<(&'de String, &'de Value)>,
}

impl<'de> MapAccess<'de> for Fields<'de> {
    type Error = Complaint;

    fn next_key_seed<K: DeserializeSeed<'de>>(&mut self, seed: K) -> Read<Option<K::Value>> {
        self.value = self.rest.find(|(key, _)| !is_remark(key));
        let Some((key, _)) = self.value else { return Ok(None) };
        let name: StrDeserializer<'de, Complaint> = key.as_str().into_deserializer();
        seed.deserialize(name).map(Some).map_err(|e| e.below(key))
    }

    fn next_value_seed<V: DeserializeSeed<'de>>(&mut self, seed: V) -> Read<V::Value> {
        let (key, value) = self.value.take().ok_or_else(|| de::Error::custom("a value without a key"))?;
        seed.deserialize(Reader(value)).map_err(|e| e.below(key))
    }
}

/// The items of an array.
struct Items<'de> {
    list: &'de [Value],
    next: usize,
}

impl<'de> SeqAccess<'de> for Items<'de> {
    type Error = Complaint;

    fn next_element_seed<T: DeserializeSeed<'de>>(&mut self, seed: T) -> Read<Option<T::Value>> {
        let Some(value) = self.list.get(self.next) else { return Ok(None) };
        self.next += 1;
        seed.deserialize(Reader(value)).map(Some).map_err(|e| e.below(&(self.next - 1).to_string()))
    }

    fn size_hint(&self) -> Option<usize> {
        Some(self.list.len() - self.next)
    }
}

/// One of several alternatives: a word, or a word with its content.
struct Choice<'de> {
    word: &'de str,
    content: Option<&'de Value>,
}

impl<'de> Choice<'de> {
    fn content(&self) -> Read<Reader<'de>> {
        let missing =
            || de::Error::custom(format!("expected an object with the key `{}`, found the word", self.word));
        self.content.map(Reader).ok_or_else(missing)
    }
}

impl<'de> EnumAccess<'de> for Choice<'de> {
    type Error = Complaint;
    type Variant = Self;

    fn variant_seed<V: DeserializeSeed<'de>>(self, seed: V) -> Read<(V::Value, Self)> {
        let name: StrDeserializer<'de, Complaint> = self.word.into_deserializer();
        Ok((seed.deserialize(name)?, self))
    }
}

impl<'de> VariantAccess<'de> for Choice<'de> {
    type Error = Complaint;

    fn unit_variant(self) -> Read<()> {
        match self.content {
            None => Ok(()),
            Some(value) => Err(Complaint::expected("a word alone", value).below(self.word)),
        }
    }

    fn newtype_variant_seed<T: DeserializeSeed<'de>>(self, seed: T) -> Read<T::Value> {
        seed.deserialize(self.content()?).map_err(|e| e.below(self.word))
    }

    fn tuple_variant<V: Visitor<'de>>(self, _: usize, visitor: V) -> Read<V::Value> {
        de::Deserializer::deserialize_seq(self.content()?, visitor).map_err(|e| e.below(self.word))
    }

    fn struct_variant<V: Visitor<'de>>(self, _: &'static [&'static str], visitor: V) -> Read<V::Value> {
        visitor.visit_map(self.content()?.object()?).map_err(|e| e.below(self.word))
    }
}
