//! Values of a text that are not to be relied on, because something was found wrong with them.

use super::complaints::{Complaint, Kind};
use serde_json::{Map, Value};
use std::collections::BTreeMap;

/// What is unknown at and below a value.
#[derive(Debug, Default)]
pub struct Unknown {
    flagged: bool,
    below: BTreeMap<String, Unknown>,
    /// Names that are wrong, and those that are meant by them, if that can be told.
    instead: BTreeMap<String, Option<&'static str>>,
}

impl Unknown {
    /// Whether the value itself is unknown.
    pub fn is_flagged(&self) -> bool {
        self.flagged
    }

    /// What is unknown below a key.
    pub fn below(&self, key: &str) -> Option<&Self> {
        self.below.get(key)
    }

    /// Keys of unknown values that an object lacks.
    pub fn flagged_beside(&self, map: &Map<String, Value>) -> Vec<&str> {
        let flagged = self.below.iter().filter(|(key, node)| node.flagged && !map.contains_key(*key));
        flagged.map(|(key, _)| key.as_str()).collect()
    }

    /// The name that is meant by a key or a word; `None` if it has to be left out.
    pub fn meant<'a>(&'a self, name: &'a str) -> Option<&'a str> {
        self.instead.get(name).map_or(Some(name), |instead| *instead)
    }

    fn at(&mut self, path: &[String]) -> &mut Self {
        path.iter().fold(self, |node, key| node.below.entry(key.clone()).or_default())
    }

    /// Marks a value as unknown. Tells whether it was not before.
    pub fn flag(&mut self, path: &[String]) -> bool {
        let node = self.at(path);
        !std::mem::replace(&mut node.flagged, true)
    }

    /// Takes what a complaint is about as unknown, or a name as another one, so that reading goes on beside it: the path of
    /// what is unknown now, if anything is. `None` where reading cannot go on.
    pub fn mend(&mut self, complaint: &Complaint) -> Option<Option<Vec<String>>> {
        let mut path = complaint.path();
        match &complaint.kind {
            Kind::Field(expected) => {
                let key = path.pop()?;
                let node = self.at(&path);
                let meant = nearest(&key, expected.iter().copied());
                let taken = node.instead.values().any(|other| other.is_some() && *other == meant);
                return node.instead.insert(key, meant.filter(|_| !taken)).is_none().then_some(None);
            }
            Kind::Choice(word, expected) => {
                if let Some(meant) = nearest(word, expected.iter().copied()) {
                    return self
                        .at(&path)
                        .instead
                        .insert(word.clone(), Some(meant))
                        .is_none()
                        .then_some(None);
                }
            }
            Kind::Missing(field) => path.push((*field).to_owned()),
            Kind::Value => {}
        }
        (!path.is_empty() && self.flag(&path)).then_some(Some(path))
    }
}

/// The name that was probably meant: about a quarter of the letters differ at most.
pub(crate) fn nearest<'a>(word: &str, names: impl Iterator<Item = &'a str>) -> Option<&'a str> {
    // A word without letters resembles nothing.
    let letters = word.chars().count();
    let most = if letters == 0 { 0 } else { (letters / 4).max(1) };
    let distances = names.map(|name| (distance(word, name), name));
    distances
        .filter(|(distance, _)| *distance <= most)
        .min_by_key(|(distance, _)| *distance)
        .map(|(_, name)| name)
}

/// Number of letters to insert, to remove or to replace to come from one word to the other.
fn distance(a: &str, b: &str) -> usize {
    let b: Vec<char> = b.chars().collect();
    // Keys of a text can be of any length; names are short.
    let a: Vec<char> = a.chars().take(2 * b.len() + 2).collect();
    let mut row: Vec<usize> = (0..=b.len()).collect();
    for (i, x) in a.iter().enumerate() {
        let mut diagonal = std::mem::replace(&mut row[0], i + 1);
        for (j, y) in b.iter().enumerate() {
            let replaced = diagonal + usize::from(x != y);
            diagonal = row[j + 1];
            row[j + 1] = replaced.min(diagonal + 1).min(row[j] + 1);
        }
    }
    row[b.len()]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn misspelt_names_are_recognised() {
        let names = ["radius", "effective_length", "mass", "y"];
        for (word, meant) in [
            ("radus", Some("radius")),
            ("Radius", Some("radius")),
            ("effectiveLength", Some("effective_length")),
            ("x", Some("y")),
            ("colour", None),
            ("density", None),
            ("", None),
        ] {
            assert_eq!(nearest(word, names.into_iter()), meant, "{word}");
        }
        assert_eq!(distance("kitten", "sitting"), 3);
        assert_eq!(distance(&"a".repeat(100_000), "ab"), 5);
    }
}
