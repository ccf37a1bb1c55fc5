//! Programs that print the tables of a page, run scenes with changes, and use all cores.

use crate::table::Table;
use crate::{file_error, workers, write_tables};
use cagedyn::{Result, Scene};
use clap::Parser;
use serde_json::Value;
use std::path::Path;

/// What such a program is asked for.
#[derive(Parser)]
#[command(about)]
struct Arguments {
    /// Also write the tables into the page.
    #[arg(long)]
    docs: bool,
    /// Only the table of this name.
    #[arg(long)]
    only: Option<String>,
}

/// A table by its name on the page.
pub type Make = fn(&str) -> Result<Table>;
/// Changes of a scene by path.
pub type Changes = Vec<(&'static str, Value)>;

/// Prints the tables that the command line asks for, and writes them into the page if it says so.
pub fn print(page: &str, tables: &[(&str, Make)]) -> Result<()> {
    let arguments = Arguments::parse();
    let asked = |name: &str| arguments.only.as_deref().is_none_or(|only| only == name);
    for (name, table) in tables.iter().filter(|(name, _)| asked(name)) {
        let table = table(name)?;
        println!("{name}\n{}", table.text());
        if arguments.docs {
            write_tables(Path::new(page), [(*name, table.text())])?;
        }
    }
    Ok(())
}

/// A committed scene with changes.
pub fn scene(name: &str, changes: &Changes) -> Result<Scene> {
    let path = format!("scenes/{name}.json");
    let text = std::fs::read_to_string(&path).map_err(|e| file_error(Path::new(&path), e))?;
    let texts: Vec<(&str, String)> = changes.iter().map(|(path, value)| (*path, value.to_string())).collect();
    Scene::from_json_with(&text, texts.iter().map(|(path, value)| (*path, value.as_str())))
}

/// What `run` finds for 0 to `count`, as many at once as there are cores, in their order.
pub fn on_all_cores<T: Send>(count: usize, run: impl Fn(usize) -> T + Sync) -> Vec<T> {
    let places: Vec<usize> = (0..count).collect();
    let mut done: Vec<Option<T>> = places.iter().map(|_| None).collect();
    let keep = |k: usize, found| {
        done[k] = Some(found);
        true
    };
    workers::share(&places, workers::threads(None), |k| Some(run(k)), keep);
    done.into_iter().flatten().collect()
}
