//! What every optional effect of the two example scenes costs and what it changes: `make effects`.
//!
//! Prints tables and writes `out/effects/*.csv`; with `--docs` also the tables of `docs/results/effects.md` and its picture.

mod measure;
mod picture;
mod report;
mod study;
use cagedyn::Result;
use cagedyn_studies::effects::rows;
use clap::Parser;
use report::Report;
use std::path::{Path, PathBuf};

#[derive(Parser)]
#[command(about)]
struct Arguments {
    /// Folder of the scenes.
    #[arg(long, default_value = "scenes")]
    scenes: PathBuf,
    /// Folder of the tables.
    #[arg(long, default_value = "out/effects")]
    out: PathBuf,
    /// Also write the tables into docs/results/effects.md and draw docs/images/effects.svg.
    #[arg(long)]
    docs: bool,
    /// Only evaluate the forces of this scene; callgrind runs the program so.
    #[arg(long, hide = true, requires = "states")]
    evaluate: Option<PathBuf>,
    #[arg(long, hide = true)]
    states: Option<PathBuf>,
    #[arg(long, hide = true, default_value_t = 1)]
    passes: u32,
    #[arg(long, hide = true)]
    set: Vec<String>,
}

fn main() -> Result<()> {
    let arguments = Arguments::parse();
    if let (Some(scene), Some(states)) = (&arguments.evaluate, &arguments.states) {
        let changes: Vec<(&str, &str)> =
            arguments.set.iter().filter_map(|change| change.split_once('=')).collect();
        return measure::evaluate(scene, &changes, states, arguments.passes);
    }
    std::fs::create_dir_all(&arguments.out).map_err(|e| cagedyn_studies::file_error(&arguments.out, e))?;
    let mut reports = Vec::new();
    for study in &rows::STUDIES {
        let scene = arguments.scenes.join(format!("{}.json", study.name));
        let readings = study::readings(study.name);
        eprintln!("{}: runs", scene.display());
        let outcomes = study::run_all(&scene, &readings, study.rows)?;
        eprintln!("{}: costs", scene.display());
        let costs = measure::costs(&scene, study.rows, &outcomes, &arguments.out)?;
        let report = Report { study, readings, outcomes, costs };
        report.print();
        report.save(&arguments.out)?;
        reports.push(report);
    }
    if arguments.docs {
        report::write_page(Path::new("docs/results/effects.md"), &reports)?;
        let path = Path::new("docs/images/effects.svg");
        std::fs::write(path, picture::effects(&reports)?)
            .map_err(|e| cagedyn_studies::file_error(path, e))?;
    }
    Ok(())
}
