//! The command `check`: everything that is wrong with a scene or a case set, at once.

use crate::results::facts;
use crate::run::{read, stem};
use crate::{CheckArgs, terminal};
use cagedyn::scene::CaseSet;
use cagedyn::{Error, Problem, Result, Scene, Status};
use serde_json::{Value, json};
use std::path::{Path, PathBuf};
use std::process::ExitCode;

/// Prints what is wrong, and fails if anything is.
///
/// # Errors
/// [`Status::File`] for a file that cannot be read; [`Status::BadValue`] for values that would replace those of a case set.
pub fn command(args: &CheckArgs) -> Result<ExitCode> {
    let text = read(&args.file)?;
    let schema = value_of(&text, "schema").unwrap_or_default();
    let found =
        if schema.starts_with("cagedyn.cases/") { of_cases(args, &text)? } else { of_scene(args, &text) };
    if args.json {
        let list: Vec<Value> = found.iter().map(|(file, problem)| as_json(file, problem)).collect();
        terminal::print(&format!("{:#}\n", Value::Array(list)))?;
    } else if found.is_empty() {
        let scene = Scene::from_json_with(&text, args.sets.pairs()).ok();
        let own = scene.as_ref().map_or_else(|| value_of(&text, "title"), |scene| scene.title.clone());
        terminal::print(&format!("{}: ok{}\n", args.file.display(), title(args, own)))?;
        scene.iter().flat_map(Scene::warnings).for_each(|warning| terminal::warn(&warning));
    } else {
        let lines =
            found.iter().map(|(file, problem)| format!("{}:{}: {problem}\n", file.display(), problem.line));
        terminal::print(&lines.collect::<String>())?;
    }
    Ok(if found.is_empty() { ExitCode::SUCCESS } else { ExitCode::FAILURE })
}

/// ", title", if there is one; the name of the file with the values that were replaced, of which a title may tell.
fn title(args: &CheckArgs, own: Option<String>) -> String {
    let set: Vec<String> = args.sets.pairs().map(|(path, value)| format!("{path}={value}")).collect();
    if own.is_none() && set.is_empty() {
        return String::new();
    }
    let title = facts::title(own.as_deref(), &stem(&args.file), &set);
    format!(", {}", title.replace(['\n', '\r'], " "))
}

/// A text at the top of a JSON object, in one line.
fn value_of(text: &str, key: &str) -> Option<String> {
    let value: Value = serde_json::from_str(text.trim_start_matches('\u{feff}')).ok()?;
    Some(value.get(key)?.as_str()?.replace(['\n', '\r'], " "))
}

fn of_scene(args: &CheckArgs, text: &str) -> Vec<(PathBuf, Problem)> {
    in_file(&args.file, Scene::check_with(text, args.sets.pairs())).collect()
}

/// Problems of a case set: its own, then those of its base scene, then those that its cases add.
fn of_cases(args: &CheckArgs, text: &str) -> Result<Vec<(PathBuf, Problem)>> {
    if args.sets.pairs().next().is_some() {
        let text = "--set: replaces values of a scene; this is a case set, whose cases do that themselves";
        return Err(Error::new(Status::BadValue, text));
    }
    let problems = CaseSet::check(text);
    // What is wrong with the set itself leaves open which scenes there are.
    let Ok(set) = CaseSet::from_json(text) else { return Ok(in_file(&args.file, problems).collect()) };
    let base = args.file.parent().unwrap_or(Path::new("")).join(&set.scene);
    let scene = read(&base)?;
    let of_base = in_file(&base, Scene::check(&scene));
    Ok(of_base.chain(in_file(&args.file, set.check_cases(text, &scene))).collect())
}

fn in_file(file: &Path, problems: Vec<Problem>) -> impl Iterator<Item = (PathBuf, Problem)> {
    problems.into_iter().map(move |problem| (file.to_owned(), problem))
}

fn as_json(file: &Path, problem: &Problem) -> Value {
    json!({
        "file": file.display().to_string(),
        "line": problem.line,
        "path": problem.path,
        "message": problem.message,
    })
}
