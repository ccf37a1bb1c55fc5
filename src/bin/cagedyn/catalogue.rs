//! The command `catalogue`: materials and lubricants by name, with their values and where these come from.

use crate::{CatalogueArgs, terminal};
use cagedyn::scene::catalogue;
use cagedyn::{Error, Result, Status};
use serde_json::Value;
use std::fmt::Write;
use std::process::ExitCode;

/// Lists the entries, or shows one.
///
/// # Errors
/// [`Status::UnknownName`] for a name that is not in the catalogue; [`Status::File`] when standard output cannot be written.
pub fn command(args: &CatalogueArgs) -> Result<ExitCode> {
    let all = catalogue();
    let shown = match &args.name {
        None => all,
        Some(name) => entry(all, name)?,
    };
    let text = match (args.json, &args.name) {
        (true, _) => serde_json::to_string_pretty(shown).unwrap_or_default() + "\n",
        (false, None) => list(all),
        (false, Some(name)) => details(name, shown),
    };
    terminal::print(&text)?;
    Ok(ExitCode::SUCCESS)
}

fn kinds(all: &Value) -> impl Iterator<Item = (&String, &serde_json::Map<String, Value>)> {
    all.as_object().into_iter().flatten().filter_map(|(kind, entries)| Some((kind, entries.as_object()?)))
}

fn entry<'a>(all: &'a Value, name: &str) -> Result<&'a Value> {
    kinds(all).find_map(|(_, entries)| entries.get(name)).ok_or_else(|| {
        let known: Vec<&str> =
            kinds(all).flat_map(|(_, entries)| entries.keys().map(String::as_str)).collect();
        let text = format!("'{name}' is not in the catalogue ({})", known.join(", "));
        Error::new(Status::UnknownName, text)
    })
}

fn list(all: &Value) -> String {
    let mut text = String::new();
    for (kind, entries) in kinds(all) {
        let _ = writeln!(text, "{kind}");
        let width = entries.keys().map(String::len).max().unwrap_or(0);
        for (name, entry) in entries {
            let _ = writeln!(text, "  {name:width$}  {}", entry["title"].as_str().unwrap_or_default());
        }
    }
    text
}

fn details(name: &str, entry: &Value) -> String {
    let mut text = format!("{name}: {}\n", entry["title"].as_str().unwrap_or_default());
    write_values(&mut text, &entry["values"], "");
    let _ = writeln!(text, "sources");
    for (place, source) in entry["sources"].as_object().into_iter().flatten() {
        let _ = writeln!(text, "  {place}: {}", source.as_str().unwrap_or_default());
    }
    text
}

/// Values by their path, in SI units.
fn write_values(text: &mut String, value: &Value, path: &str) {
    let Value::Object(map) = value else {
        let _ = writeln!(text, "  {path} {value}");
        return;
    };
    for (key, value) in map {
        let path = if path.is_empty() { key.clone() } else { format!("{path}.{key}") };
        write_values(text, value, &path);
    }
}
