//! The scene of a report as lines of HTML, with marks at values that are assumed and at those that were replaced.
//!
//! Which values are assumed, a scene may say in its comment: `"comment": {"assumed": {"rollers.mass": "solid steel"}}`, or
//! a list of paths without reasons.

use crate::plots::style::escaped;
use serde_json::Value;

/// What a scene says of its own values.
#[derive(Debug, Default, PartialEq)]
pub struct Remarks {
    /// Paths of assumed values, and the reasons.
    pub assumed: Option<Vec<(String, String)>>,
    /// What else the comment says.
    pub comment: Option<String>,
}

impl Remarks {
    /// Reads the comment of a scene.
    pub fn of(comment: Option<&Value>) -> Self {
        let plain = |value: &Value| value.as_str().map_or_else(|| value.to_string(), str::to_owned);
        match comment {
            None => Self::default(),
            Some(Value::Object(fields)) => {
                let assumed = match fields.get("assumed") {
                    Some(Value::Object(list)) => {
                        Some(list.iter().map(|(path, why)| (path.clone(), plain(why))).collect())
                    }
                    Some(Value::Array(list)) => {
                        Some(list.iter().map(|path| (plain(path), String::new())).collect())
                    }
                    _ => None,
                };
                let others = fields.iter().filter(|(name, _)| *name != "assumed" || assumed.is_none());
                let others: Vec<String> =
                    others.map(|(name, value)| format!("{name}: {}", plain(value))).collect();
                Self { assumed, comment: (!others.is_empty()).then(|| others.join("; ")) }
            }
            Some(other) => Self { assumed: None, comment: Some(plain(other)) },
        }
    }
}

/// The scene as HTML, and which paths of remarks are not in it.
pub fn marked(text: &str, remarks: &Remarks, set: &[String]) -> (String, Vec<String>) {
    let assumed = remarks.assumed.as_deref().unwrap_or_default();
    let replaced: Vec<&str> = set.iter().filter_map(|pair| Some(pair.split_once('=')?.0)).collect();
    let mut found = vec![false; assumed.len()];
    let mut html = String::new();
    for (line, path) in lines(text) {
        let mut line = escaped(line);
        if replaced.iter().any(|other| *other == path) {
            line = format!("<b class=replaced>{line}</b> <i>replaced</i>");
        }
        if let Some(place) = assumed.iter().position(|(other, _)| *other == path) {
            found[place] = true;
            let why = &assumed[place].1;
            let why = if why.is_empty() { String::new() } else { format!(": {}", escaped(why)) };
            line = format!("<mark>{line}</mark> <i>assumed{why}</i>");
        }
        html.push_str(&line);
        html.push('\n');
    }
    let lost = assumed.iter().zip(found).filter(|(_, found)| !found).map(|((path, _), _)| path.clone());
    (html, lost.collect())
}

/// Lines of pretty JSON without its comment, each with the dotted path of the value that begins there.
fn lines(text: &str) -> Vec<(&str, String)> {
    let mut path: Vec<String> = Vec::new();
    // Next place, in every list that is open; none in maps.
    let mut places: Vec<Option<usize>> = Vec::new();
    let mut list = Vec::new();
    for line in text.lines() {
        let trimmed = line.trim();
        if trimmed.starts_with(['}', ']']) {
            places.pop();
            path.pop();
            list.push((line, String::new()));
            continue;
        }
        let name = match places.last_mut() {
            Some(Some(place)) => {
                *place += 1;
                (*place - 1).to_string()
            }
            _ => trimmed
                .strip_prefix('"')
                .and_then(|rest| rest.split_once("\":"))
                .map_or("", |(key, _)| key)
                .to_owned(),
        };
        path.push(name);
        list.push((line, path[1.min(path.len())..].join(".")));
        match trimmed.chars().last() {
            Some('{') => places.push(None),
            Some('[') => places.push(Some(0)),
            _ => {
                path.pop();
            }
        }
    }
    without_comment(list)
}

/// Takes the comment of the whole scene out, which is shown elsewhere.
fn without_comment(mut list: Vec<(&str, String)>) -> Vec<(&str, String)> {
    if let Some(first) = list.iter().position(|(_, path)| path == "comment") {
        let indent = |line: &str| line.len() - line.trim_start().len();
        let after = list[first + 1..].iter().position(|(line, _)| indent(line) <= indent(list[first].0));
        let closes = |line: &str| line.trim().starts_with(['}', ']']);
        let mut end = first + 1 + after.unwrap_or(0);
        if list.get(end).is_some_and(|(line, _)| closes(line) && indent(line) == indent(list[first].0)) {
            end += 1;
        }
        list.drain(first..end);
    }
    list
}

#[cfg(test)]
mod tests {
    use super::*;
    use serde_json::json;

    #[test]
    fn values_are_marked_at_their_paths() {
        let scene =
            json!({"a": {"b": 1, "c": [{"d": "<x>"}, 2], "e": {}}, "comment": {"assumed": []}, "z": 5});
        let text = serde_json::to_string_pretty(&scene).unwrap();
        let comment = json!({"assumed": {"a.c.0.d": "a & b", "a.c.1": "", "none.x": ""}, "by": "me"});
        let remarks = Remarks::of(Some(&comment));
        assert_eq!(remarks.comment.as_deref(), Some("by: me"));
        let (html, lost) = marked(&text, &remarks, &["a.b=1".to_owned(), "z=5".to_owned()]);
        assert_eq!(lost, ["none.x"]);
        assert!(
            html.contains(
                "<mark>        &quot;d&quot;: &quot;&lt;x&gt;&quot;</mark> <i>assumed: a &amp; b</i>"
            ),
            "{html}"
        );
        assert!(html.contains("<mark>      2</mark> <i>assumed</i>"), "{html}");
        assert!(
            html.contains("<b class=replaced>    &quot;b&quot;: 1,</b>")
                && html.matches("replaced</i>").count() == 2,
            "{html}"
        );
        assert!(!html.contains("comment") && html.lines().count() == 13, "{html}");
    }

    #[test]
    fn remarks_of_any_comment() {
        assert_eq!(Remarks::of(Some(&json!(["assumed"]))).comment.as_deref(), Some("[\"assumed\"]"));
        let list = Remarks::of(Some(&json!({"assumed": ["a.b"]})));
        assert_eq!(list, Remarks { assumed: Some(vec![("a.b".to_owned(), String::new())]), comment: None });
        let none = Remarks::of(Some(&json!({"assumed": 3})));
        assert_eq!((none.assumed, none.comment.as_deref()), (None, Some("assumed: 3")));
    }
}
