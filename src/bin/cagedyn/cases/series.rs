//! Series of cases: those that differ in speed only.

use super::Done;
use crate::plots::Series;
use cagedyn::scene::Case;
use serde_json::Value;
use std::collections::BTreeSet;

/// Values that do not make another series: the speed is the order within one, the title is no physics.
const WITHIN_SERIES: [&str; 2] = ["inner_ring.speed", "title"];

/// Values that set a series apart, and its cases.
type Group<'a> = (Vec<(&'a str, &'a Value)>, Vec<&'a Done<'a>>);

/// The complete cases that have a point, grouped by all that sets them apart but speed.
pub fn series<'a, P>(done: &'a [Done<'a>], point: impl Fn(&Done<'_>) -> Option<P>) -> Vec<Series<P>> {
    let mut groups: Vec<Group<'a>> = Vec::new();
    for d in done.iter().filter(|d| point(d).is_some()) {
        let key = series_values(d.case);
        match groups.iter_mut().find(|(other, _)| *other == key) {
            Some((_, members)) => members.push(d),
            None => groups.push((key, vec![d])),
        }
    }
    groups.iter_mut().for_each(|(_, members)| members.sort_by(|a, b| a.speed.total_cmp(&b.speed)));
    let labels = labels(&groups);
    let named = labels.into_iter().zip(&groups);
    named
        .map(|(label, (_, members))| Series {
            label,
            points: members.iter().filter_map(|d| point(d)).collect(),
        })
        .collect()
}

/// What the names of the cases of each group share, or else their values: labels must tell the groups apart.
fn labels(groups: &[Group<'_>]) -> Vec<String> {
    let words = |(_, members): &Group<'_>| {
        common_words(&members.iter().map(|d| d.case.name.as_str()).collect::<Vec<_>>())
    };
    let short: Vec<String> = groups.iter().filter_map(words).collect();
    let distinct: BTreeSet<&String> = short.iter().collect();
    if distinct.len() == groups.len() {
        return short;
    }
    groups.iter().map(|(key, _)| values_in_words(key)).collect()
}

fn series_values(case: &Case) -> Vec<(&str, &Value)> {
    let within = |path: &str| WITHIN_SERIES.iter().any(|p| path == *p || path.starts_with(&format!("{p}.")));
    case.set.iter().filter(|(path, _)| !within(path)).map(|(path, value)| (path.as_str(), value)).collect()
}

/// The words that all names share, in the order of the first: "40um-980N-1000rpm" and "40um-980N-3000rpm" share
/// "40um, 980N".
fn common_words(names: &[&str]) -> Option<String> {
    let words = |name: &str| name.split(['-', '_']).map(str::to_owned).collect::<Vec<String>>();
    let all: Vec<Vec<String>> = names.iter().map(|name| words(name)).collect();
    let shared = all.first()?.iter().filter(|word| !word.is_empty() && all.iter().all(|w| w.contains(word)));
    let shared: Vec<&str> = shared.map(String::as_str).collect();
    (!shared.is_empty()).then(|| shared.join(", "))
}

/// "radial_clearance = 0.00004, ..." for cases whose names share nothing.
fn values_in_words(key: &[(&str, &Value)]) -> String {
    let last = |path: &str| path.rsplit('.').find(|p| *p != "constant").unwrap_or(path).to_owned();
    let words: Vec<String> = key.iter().map(|(path, value)| format!("{} = {value}", last(path))).collect();
    if words.is_empty() { "all cases".to_owned() } else { words.join(", ") }
}

#[cfg(test)]
mod tests {
    use super::*;
    use serde_json::json;

    #[test]
    fn series_are_named_by_what_their_cases_share() {
        let words = common_words(&["40um-980N-1000rpm", "40um-980N-3000rpm"]);
        assert_eq!(words.as_deref(), Some("40um, 980N"));
        assert_eq!(common_words(&["a", "b"]), None);
        let (clearance, load) = (json!(0.25), json!(-980.0));
        let key = [("inner_ring.radial_clearance", &clearance), ("load.z.constant", &load)];
        assert_eq!(values_in_words(&key), "radial_clearance = 0.25, z = -980.0");
    }

    #[test]
    fn speed_and_title_do_not_separate_series() {
        let set = [("inner_ring.speed.constant", 1.0), ("inner_ring.radial_clearance", 2.0)];
        let set = set.into_iter().map(|(path, x)| (path.to_owned(), json!(x)));
        let case =
            Case { name: "a".to_owned(), set: set.chain([("title".to_owned(), json!("t"))]).collect() };
        let kept: Vec<&str> = series_values(&case).into_iter().map(|(path, _)| path).collect();
        assert_eq!(kept, ["inner_ring.radial_clearance"]);
    }
}
