//! Tables of the comparisons, and their places on the pages.

use crate::curves::Comparison;
use crate::solvers::Way;
use cagedyn::{Error, Result, Status};
use cagedyn_studies::table::Table;
use std::path::Path;

/// All runs of a comparison.
pub fn runs(comparison: &Comparison) -> Table {
    let head = ["solver", "setting", "error", "wall_time_s", "evaluations", "gave_up"];
    let mut table = empty(comparison.name, head.map(str::to_owned).to_vec());
    let setting = |x: Option<f64>| x.map_or(String::new(), |x| format!("{x:.3e}"));
    for curve in &comparison.curves {
        let name = || curve.solver.name.to_owned();
        for p in &curve.points {
            table.lines.push(vec![
                name(),
                setting(p.setting),
                format!("{:.3e}", p.error),
                format!("{:.4e}", p.seconds),
                p.evaluations.to_string(),
                String::new(),
            ]);
        }
        for (at, why) in &curve.failures {
            let mut line = vec![name(), setting(*at)];
            line.extend([const { String::new() }; 3]);
            line.push(why.clone());
            table.lines.push(line);
        }
    }
    table
}

/// Wall times of all solvers at the same errors, and how many times as long as the fastest of the library.
pub fn times(comparison: &Comparison) -> Table {
    let targets =
        if comparison.targets.is_empty() { vec![comparison.noise] } else { comparison.targets.clone() };
    let mut head = vec!["solver".to_owned()];
    let within =
        |target: f64| if target == comparison.noise { "noise".to_owned() } else { format!("{target:.0e}") };
    head.extend(targets.iter().map(|target| format!("error {}", within(*target))));
    let mut table = empty(&format!("{} times", comparison.name), head);
    for curve in comparison.curves.iter() {
        let mut line = vec![curve.solver.name.to_owned()];
        for target in &targets {
            let best = comparison.best_of_ours(*target).map(|(_, seconds)| seconds);
            line.push(match (curve.seconds_at(*target), best) {
                _ if *target < comparison.noise => "below the noise".to_owned(),
                (None, _) => "not reached".to_owned(),
                (Some(t), Some(best)) => format!("{} ({:.2})", time(t), t / best),
                (Some(t), None) => time(t),
            });
        }
        table.lines.push(line);
    }
    table
}

/// Errors and wall times of the presets.
pub fn presets(comparisons: &[Comparison]) -> Table {
    let presets = comparisons.first().map_or(Vec::new(), |c| {
        let curves = c.curves.iter().filter(|curve| matches!(curve.solver.way, Way::Preset(_)));
        curves.map(|curve| curve.solver.name).collect()
    });
    let mut head = vec!["scene".to_owned(), "error".to_owned(), "noise".to_owned()];
    head.extend(presets.iter().flat_map(|name| [format!("{name}: error"), "time".to_owned()]));
    let mut table = empty("presets", head);
    for c in comparisons {
        let mut line = vec![c.title.to_owned(), c.error.to_owned(), format!("{:.1e}", c.noise)];
        for name in &presets {
            match c.curve(name).and_then(|curve| curve.points.first()) {
                Some(p) => line.extend([format!("{:.1e}", p.error), time(p.seconds)]),
                None => line.extend(["gave up".to_owned(), String::new()]),
            }
        }
        table.lines.push(line);
    }
    table
}

/// A wall time with its unit.
pub fn time(seconds: f64) -> String {
    match seconds {
        s if s < 1e-6 => format!("{:.0} ns", 1e9 * s),
        s if s < 1e-3 => format!("{:.2} us", 1e6 * s),
        s if s < 1.0 => format!("{:.2} ms", 1e3 * s),
        s => format!("{s:.2} s"),
    }
}

/// A table without lines.
pub fn empty(name: &str, head: Vec<String>) -> Table {
    Table { name: name.to_owned(), head, lines: Vec::new() }
}

/// Puts texts between their markers on the pages, `<!-- name -->` and the next `<!-- end -->`.
///
/// # Errors
/// [`Status::File`], also when a text has its marker on no page.
pub fn write_pages(paths: &[&Path], texts: &[(String, String)]) -> Result<()> {
    let file = |path: &Path, e: std::io::Error| Error::new(Status::File, format!("{}: {e}", path.display()));
    let mut pages = Vec::new();
    for path in paths {
        pages.push(std::fs::read_to_string(path).map_err(|e| file(path, e))?);
    }
    for (name, text) in texts {
        let marker = format!("<!-- {name} -->");
        // A table stands by itself, a sentence within its line.
        let text = if text.contains('\n') { format!("\n\n{}\n", text.trim_end()) } else { text.clone() };
        let mut found = false;
        for page in &mut pages {
            let Some(from) = page.find(&marker).map(|at| at + marker.len()) else { continue };
            let Some(length) = page[from..].find("<!-- end -->") else { continue };
            page.replace_range(from..from + length, &text);
            found = true;
        }
        if !found {
            return Err(Error::new(Status::File, format!("no page has {marker} ... <!-- end -->")));
        }
    }
    paths.iter().zip(pages).try_for_each(|(path, page)| std::fs::write(path, page).map_err(|e| file(path, e)))
}
