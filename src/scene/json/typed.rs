//! Typed data from parsed JSON: objects for blocks, words for choices, nothing left over. Stricter than serde_json, which
//! takes arrays for blocks and objects for words.

use super::complaint;
use super::complaints::Complaint;
use super::unknown::Unknown;
use crate::error::Result;
use serde::de::value::StrDeserializer;
use serde::de::{
    self, DeserializeOwned, DeserializeSeed, EnumAccess, IntoDeserializer, MapAccess, SeqAccess,
    VariantAccess, Visitor,
};
use serde::forward_to_deserialize_any;
use serde_json::{Map, Value, map};

/// Makes typed data of a JSON value.
///
/// # Errors
/// [`crate::Status::BadJson`] with the path of a value of the wrong type, or of an unknown or missing field.
pub fn typed<T: DeserializeOwned>(value: &Value) -> Result<T> {
    let beside = Beside { node: None, pick: 0 };
    let read = T::deserialize(Reader { content: Content::Given(value), beside });
    read.map_err(|e| complaint(&e.path(), &e.text))
}

/// The same with something in place of what is `unknown`: NaN for a number, and for what has no such value the one of this
/// `pick` among several that may be.
///
/// # Errors
/// The first thing that is wrong and not known to be so.
pub fn typed_beside<T: DeserializeOwned>(
    value: &Value,
    unknown: &Unknown,
    pick: usize,
) -> std::result::Result<T, Complaint> {
    let beside = Beside { node: Some(unknown), pick };
    T::deserialize(Reader { content: Content::Given(value), beside })
}

/// Text in place of an unknown one.
pub const UNKNOWN_TEXT: &str = "*";
/// What an unknown whole number may be.
const WHOLE: [u64; PICKS] = [2, 64, 4, 16];
/// Number of different picks.
pub const PICKS: usize = 4;

/// Whole numbers up to this are doubles without loss.
const LARGEST_WHOLE: f64 = 9_007_199_254_740_992.0;

type Read<T> = std::result::Result<T, Complaint>;

/// What is unknown at and below a value.
#[derive(Clone, Copy)]
struct Beside<'de> {
    node: Option<&'de Unknown>,
    pick: usize,
}

impl<'de> Beside<'de> {
    /// The value of a key, or the blank that it has because it is unknown or below what is.
    fn reader(self, key: &str, given: Option<&'de Value>) -> Reader<'de> {
        let node = self.node.and_then(|node| node.below(key));
        let content = match given {
            _ if node.is_some_and(Unknown::is_flagged) => Content::Blank,
            Some(value) => Content::Given(value),
            None => Content::Within,
        };
        Reader { content, beside: Beside { node, ..self } }
    }

    /// The word that is meant by one of the text.
    fn meant(self, word: &'de str) -> Option<&'de str> {
        self.node.map_or(Some(word), |node| node.meant(word))
    }
}

/// What a value is read from.
#[derive(Clone, Copy)]
enum Content<'de> {
    /// A value of the text.
    Given(&'de Value),
    /// Something that is there and unknown.
    Blank,
    /// Part of something unknown; what is optional is not there.
    Within,
}

/// A value to be read.
#[derive(Clone, Copy)]
struct Reader<'de> {
    content: Content<'de>,
    beside: Beside<'de>,
}

impl<'de> Reader<'de> {
    /// The value, if it is not a blank.
    fn given(self) -> Option<&'de Value> {
        match self.content {
            Content::Given(value) => Some(value),
            Content::Blank | Content::Within => None,
        }
    }

    /// The fields of an object, and of a blank all of `fields`.
    #[inline(never)]
    fn object(self, fields: &'static [&'static str]) -> Read<Fields<'de>> {
        let beside = self.beside;
        match self.given() {
            None => Ok(Fields { map: None, rest: None, unknown: fields.to_vec(), beside, value: None }),
            Some(Value::Object(map)) => {
                let unknown = beside.node.map_or(Vec::new(), |node| node.flagged_beside(map));
                Ok(Fields { map: Some(map), rest: Some(map.iter()), unknown, beside, value: None })
            }
            Some(other) => Err(Complaint::expected("an object", other)),
        }
    }

    fn whole<V: Visitor<'de>>(self, visitor: V) -> Read<V::Value> {
        let Some(value) = self.given() else { return visitor.visit_u64(WHOLE[self.beside.pick % PICKS]) };
        // Many languages write whole numbers as 12.0.
        let whole = |x: f64| ((0.0..=LARGEST_WHOLE).contains(&x) && x.fract() == 0.0).then_some(x as u64);
        match value.as_u64().or_else(|| value.as_f64().and_then(whole)) {
            Some(number) => visitor.visit_u64(number),
            None => Err(Complaint::expected("a whole number from 0 on", value)),
        }
    }

    /// So many blanks.
    fn blanks(self, count: usize) -> Items<'de> {
        Items { list: None, count, next: 0, beside: self.beside }
    }
}

impl<'de> de::Deserializer<'de> for Reader<'de> {
    type Error = Complaint;

    /// For parts that stay JSON.
    fn deserialize_any<V: Visitor<'de>>(self, visitor: V) -> Read<V::Value> {
        match self.given() {
            Some(value) => value.deserialize_any(visitor).map_err(de::Error::custom),
            None => visitor.visit_unit(),
        }
    }

    fn deserialize_bool<V: Visitor<'de>>(self, visitor: V) -> Read<V::Value> {
        let Some(value) = self.given() else { return visitor.visit_bool(self.beside.pick % 2 == 1) };
        let value = value.as_bool().ok_or_else(|| Complaint::expected("true or false", value))?;
        visitor.visit_bool(value)
    }

    fn deserialize_f64<V: Visitor<'de>>(self, visitor: V) -> Read<V::Value> {
        let Some(value) = self.given() else { return visitor.visit_f64(f64::NAN) };
        let value = value.as_f64().ok_or_else(|| Complaint::expected("a number", value))?;
        visitor.visit_f64(value)
    }

    fn deserialize_u32<V: Visitor<'de>>(self, visitor: V) -> Read<V::Value> {
        self.whole(visitor)
    }

    fn deserialize_u64<V: Visitor<'de>>(self, visitor: V) -> Read<V::Value> {
        self.whole(visitor)
    }

    fn deserialize_string<V: Visitor<'de>>(self, visitor: V) -> Read<V::Value> {
        let Some(value) = self.given() else { return visitor.visit_borrowed_str(UNKNOWN_TEXT) };
        let value = value.as_str().ok_or_else(|| Complaint::expected("a text", value))?;
        visitor.visit_borrowed_str(value)
    }

    fn deserialize_option<V: Visitor<'de>>(self, visitor: V) -> Read<V::Value> {
        match self.content {
            Content::Given(Value::Null) | Content::Within => visitor.visit_none(),
            _ => visitor.visit_some(self),
        }
    }

    fn deserialize_seq<V: Visitor<'de>>(self, visitor: V) -> Read<V::Value> {
        let Some(value) = self.given() else { return visitor.visit_seq(self.blanks(self.beside.pick)) };
        let list = value.as_array().ok_or_else(|| Complaint::expected("an array", value))?;
        visitor.visit_seq(Items { list: Some(list), count: list.len(), next: 0, beside: self.beside })
    }

    fn deserialize_tuple<V: Visitor<'de>>(self, length: usize, visitor: V) -> Read<V::Value> {
        match self.given() {
            Some(_) => self.deserialize_any(visitor),
            None => visitor.visit_seq(self.blanks(length)),
        }
    }

    fn deserialize_map<V: Visitor<'de>>(self, visitor: V) -> Read<V::Value> {
        visitor.visit_map(self.object(&[])?)
    }

    fn deserialize_struct<V: Visitor<'de>>(
        self,
        _: &'static str,
        fields: &'static [&'static str],
        visitor: V,
    ) -> Read<V::Value> {
        visitor.visit_map(self.object(fields)?)
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
        let beside = self.beside;
        let chosen = |word: &'de str, value: Option<&'de Value>| {
            let word = beside.meant(word).unwrap_or(word);
            Choice { word, content: value.map(|value| beside.reader(word, Some(value))) }
        };
        let Some(value) = self.given() else {
            let word = variants[beside.pick % variants.len()];
            return visitor.visit_enum(Choice { word, content: Some(beside.reader(word, None)) });
        };
        let choice = match value {
            Value::String(word) => Some(chosen(word, None)),
            Value::Object(map) => one(map).map(|(word, value)| chosen(word, Some(value))),
            // A number alone is a constant.
            Value::Number(_) if variants.contains(&CONSTANT) => Some(chosen(CONSTANT, Some(value))),
            _ => None,
        };
        let choice = choice.ok_or_else(|| no_choice(variants, value))?;
        visitor.visit_enum(choice)
    }

    forward_to_deserialize_any! {
        i8 i16 i32 i64 i128 u8 u16 u128 f32 char str bytes byte_buf unit unit_struct newtype_struct tuple_struct
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
    map: Option<&'de Map<String, Value>>,
    rest: Option<map::Iter<'de>>,
    /// Those that the object lacks and that are there all the same, as blanks.
    unknown: Vec<&'de str>,
    beside: Beside<'de>,
    value: Option<(&'de str, Reader<'de>)>,
}

impl<'de> Fields<'de> {
    #[inline(never)]
    fn next(&mut self) -> Option<(&'de str, Reader<'de>)> {
        for (key, value) in self.rest.as_mut().into_iter().flatten().filter(|(key, _)| !is_remark(key)) {
            // A name that is wrong has the place of the one that is meant, if that is free.
            match self.beside.meant(key) {
                Some(name) if name == key || self.map.is_none_or(|map| !map.contains_key(name)) => {
                    return Some((name, self.beside.reader(name, Some(value))));
                }
                _ => {}
            }
        }
        let name = self.unknown.pop()?;
        Some((name, self.beside.reader(name, None)))
    }
}

impl<'de> MapAccess<'de> for Fields<'de> {
    type Error = Complaint;

    fn next_key_seed<K: DeserializeSeed<'de>>(&mut self, seed: K) -> Read<Option<K::Value>> {
        self.value = self.next();
        let Some((key, _)) = self.value else { return Ok(None) };
        let name: StrDeserializer<'de, Complaint> = key.into_deserializer();
        seed.deserialize(name).map(Some).map_err(|e| e.below(key))
    }

    /// Once per type: what reads an object is as long as the list of its fields already.
    #[inline(never)]
    fn next_value_seed<V: DeserializeSeed<'de>>(&mut self, seed: V) -> Read<V::Value> {
        let (key, value) = self.value.take().ok_or_else(|| de::Error::custom("a value without a key"))?;
        seed.deserialize(value).map_err(|e| e.below(key))
    }
}

/// The items of an array, or so many blanks.
struct Items<'de> {
    list: Option<&'de [Value]>,
    count: usize,
    next: usize,
    beside: Beside<'de>,
}

impl<'de> SeqAccess<'de> for Items<'de> {
    type Error = Complaint;

    fn next_element_seed<T: DeserializeSeed<'de>>(&mut self, seed: T) -> Read<Option<T::Value>> {
        if self.next >= self.count {
            return Ok(None);
        }
        let (at, value) = (self.next, self.list.and_then(|list| list.get(self.next)));
        self.next += 1;
        let reader = match self.beside.node {
            // Tables are long, and mostly nothing in them is unknown.
            None => Reader { content: value.map_or(Content::Within, Content::Given), beside: self.beside },
            Some(_) => self.beside.reader(&at.to_string(), value),
        };
        seed.deserialize(reader).map(Some).map_err(|e| e.below(&at.to_string()))
    }

    fn size_hint(&self) -> Option<usize> {
        Some(self.count - self.next)
    }
}

/// One of several alternatives: a word, or a word with its content.
struct Choice<'de> {
    word: &'de str,
    content: Option<Reader<'de>>,
}

impl<'de> Choice<'de> {
    fn content(&self) -> Read<Reader<'de>> {
        let missing =
            || de::Error::custom(format!("expected an object with the key `{}`, found the word", self.word));
        self.content.ok_or_else(missing)
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
        match self.content.and_then(Reader::given) {
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

    fn struct_variant<V: Visitor<'de>>(self, fields: &'static [&'static str], visitor: V) -> Read<V::Value> {
        visitor.visit_map(self.content()?.object(fields)?).map_err(|e| e.below(self.word))
    }
}
