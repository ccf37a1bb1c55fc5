//! All that is wrong with a text at once. Reading and checks end at the first mistake; what it is about is then taken as
//! unknown, and they begin anew until they find nothing more. A mistake that is there only because of another one is left out.

use super::json::{Complaint, PICKS, UNKNOWN_TEXT, Unknown, typed_beside};
use super::validate::{Judge, is_at_or_below};
use super::{Material, Scene, ThermalMaterial, catalogue};
use crate::error::{Error, Result};
use serde_json::Value;

/// No more mistakes than this are looked for.
const MOST: usize = 100;

/// A mistake: the keys that lead to its place, and what it is.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Found {
    /// Keys from the outermost on; missing ones are among them.
    pub(crate) path: Vec<String>,
    /// In words, without the path.
    pub(crate) text: String,
}

/// What ends one attempt to read and to check.
pub(super) enum Finding {
    /// Something of the wrong form.
    Misread(Complaint),
    /// A check that failed.
    Refused(Error),
}

impl From<Complaint> for Finding {
    fn from(complaint: Complaint) -> Self {
        Self::Misread(complaint)
    }
}

impl From<Error> for Finding {
    fn from(error: Error) -> Self {
        Self::Refused(error)
    }
}

/// What is taken as unknown.
#[derive(Default)]
pub(super) struct Doubts {
    /// As the reader needs it.
    pub(super) unknown: Unknown,
    /// Dotted paths, as the checks need them.
    pub(super) paths: Vec<String>,
}

impl Doubts {
    /// Takes what a finding is about as unknown. Tells whether that is new.
    fn add(&mut self, finding: &Finding, found: &Found) -> bool {
        match finding {
            Finding::Misread(complaint) => match self.unknown.mend(complaint) {
                Some(path) => {
                    self.paths.extend(path.map(|path| path.join(".")));
                    true
                }
                None => false,
            },
            Finding::Refused(_) => {
                let dotted = found.path.join(".");
                let new = !found.path.is_empty() && self.unknown.flag(&found.path);
                self.paths.push(dotted);
                new
            }
        }
    }

    fn excuses(&self, path: &[String]) -> bool {
        let path = path.join(".");
        self.paths.iter().any(|place| is_at_or_below(&path, place))
    }
}

/// One attempt beside what is unknown, with one of several picks for it.
pub(super) type Attempt<'a> = dyn Fn(&Doubts, usize) -> std::result::Result<(), Finding> + 'a;

/// Everything that attempts to use a value find, in their order.
pub(super) fn all(value: &Value, attempt: &Attempt<'_>) -> Vec<Found> {
    let Err(first) = attempt(&Doubts::default(), 0) else { return Vec::new() };
    let mut found = with_pick(value, attempt, 0);
    for pick in 1..PICKS {
        if found.len() < 2 {
            break;
        }
        // What depends on the pick is no mistake of its own.
        let others = with_pick(value, attempt, pick);
        found.retain(|mistake| others.contains(mistake));
    }
    if found.is_empty() {
        // What is refused has a reason.
        found.push(located(value, &first));
    }
    found
}

fn with_pick(value: &Value, attempt: &Attempt<'_>, pick: usize) -> Vec<Found> {
    let mut doubts = Doubts::default();
    let mut findings: Vec<(Finding, Found, bool)> = Vec::new();
    while findings.len() < MOST {
        let Err(finding) = attempt(&doubts, pick) else { break };
        let found = located(value, &finding);
        let excused = matches!(finding, Finding::Refused(_)) && doubts.excuses(&found.path);
        let goes_on = doubts.add(&finding, &found);
        findings.push((finding, found, excused));
        if !goes_on {
            break;
        }
    }
    let own = findings.iter().filter(|(finding, found, excused)| {
        !excused
            && (matches!(finding, Finding::Misread(_))
                || stands_alone(value, attempt, pick, &findings, found))
    });
    let own: Vec<Found> = own.map(|(_, found, _)| found.clone()).collect();
    // Parts of a block that is missing need not be told.
    let is_there = |path: &[String]| path.iter().try_fold(value, |value, key| child(value, key)).is_some();
    let within = |part: &Found, whole: &Found| {
        part.path.len() > whole.path.len() && part.path.starts_with(&whole.path) && !is_there(&whole.path)
    };
    own.iter().filter(|part| !own.iter().any(|whole| within(part, whole))).cloned().collect()
}

/// Whether a check fails, too, when everything else that was found is unknown.
fn stands_alone(
    value: &Value,
    attempt: &Attempt<'_>,
    pick: usize,
    findings: &[(Finding, Found, bool)],
    own: &Found,
) -> bool {
    let mut doubts = Doubts::default();
    // What is part of a block that is wrong as a whole is not told by it.
    for (finding, found, _) in findings.iter().filter(|(_, found, _)| !own.path.starts_with(&found.path)) {
        doubts.add(finding, found);
    }
    attempt(&doubts, pick).is_err_and(|finding| located(value, &finding) == *own)
}

/// The mistake that a finding is about.
fn located(value: &Value, finding: &Finding) -> Found {
    match finding {
        Finding::Misread(complaint) => Found { path: complaint.path(), text: complaint.text.clone() },
        Finding::Refused(error) => {
            let (path, text) = split(value, &error.message);
            Found { path, text: text.to_owned() }
        }
    }
}

/// Part of a value.
fn child<'a>(value: &'a Value, key: &str) -> Option<&'a Value> {
    match value {
        Value::Object(map) => map.get(key),
        Value::Array(list) => list.get(key.parse::<usize>().ok()?),
        _ => None,
    }
}

/// The keys with which a message begins, and what stands behind them. Keys of the text may have any characters in them.
fn split<'a>(value: &Value, message: &'a str) -> (Vec<String>, &'a str) {
    let (mut path, mut rest, mut here) = (Vec::new(), message, Some(value));
    loop {
        let ends = |key: &str| {
            rest.strip_prefix(key).is_some_and(|behind| behind.starts_with('.') || behind.starts_with(": "))
        };
        let known = match here {
            Some(Value::Object(map)) => {
                map.keys().filter(|key| ends(key)).max_by_key(|key| key.len()).cloned()
            }
            _ => None,
        };
        let plain =
            |text: &str| text.find(|c: char| !c.is_ascii_alphanumeric() && c != '_').unwrap_or(text.len());
        let key = known.unwrap_or_else(|| rest[..plain(rest)].to_owned());
        if key.is_empty() || !ends(&key) {
            // No path at all, or none to its end.
            return if path.is_empty() { (path, message) } else { (path, rest) };
        }
        here = here.and_then(|value| child(value, &key));
        let behind = &rest[key.len()..];
        path.push(key);
        match behind.strip_prefix(": ") {
            Some(text) => return (path, text),
            None => rest = &behind[1..],
        }
    }
}

impl Scene {
    /// Everything that is wrong with a scene. `more` checks what the scene itself cannot, of a scene that has NaN for what is
    /// unknown; it is told whether nothing of that kind is left.
    pub(crate) fn problems(value: &Value, more: &dyn Fn(&Scene, bool) -> Result<()>) -> Vec<Found> {
        let (value, refused_oil) = catalogue::filled_and_refused(value);
        let value = value.as_ref();
        let found = all(value, &|doubts: &Doubts, pick| {
            Self::refuse_other_formats(value)?;
            let mut scene: Self = typed_beside(value, &doubts.unknown, pick)?;
            let judge = Judge::beside(&doubts.paths);
            scene.judged(judge)?;
            // Materials that do not exist are told already.
            if !doubts.paths.is_empty() {
                scene.materials.insert(UNKNOWN_TEXT.to_owned(), unknown_material());
            }
            let only_names = |path: &String| {
                is_at_or_below(path, "record.channels") || is_at_or_below(path, "record.extremes")
            };
            if !judge.excuses("materials") {
                more(&scene, doubts.paths.iter().all(only_names))?;
            }
            Ok(())
        });
        let path = || catalogue::PATH.split('.').map(str::to_owned).collect();
        refused_oil.map(|text| Found { path: path(), text }).into_iter().chain(found).collect()
    }
}

fn unknown_material() -> Material {
    let [young_modulus, poisson_ratio, conductivity, density, specific_heat] = [f64::NAN; 5];
    let thermal = Some(ThermalMaterial { conductivity, density, specific_heat });
    Material { young_modulus, poisson_ratio, thermal }
}
