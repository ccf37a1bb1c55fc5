//! Whether the integration methods give the right statistics of long, chaotic runs: `make statistics`.
//!
//! Prints tables and writes `out/statistics/*.csv`; with `--docs` also the tables of `docs/results/statistics.md`.

mod report;
use cagedyn::Result;
use cagedyn_studies::statistics::{cases, study};
use cagedyn_studies::table::Table;
use clap::Parser;
use std::path::{Path, PathBuf};

#[derive(Parser)]
#[command(about)]
struct Arguments {
    /// Folder of the scenes.
    #[arg(long, default_value = "scenes")]
    scenes: PathBuf,
    /// Folder of the tables.
    #[arg(long, default_value = "out/statistics")]
    out: PathBuf,
    /// Also write the tables into docs/results/statistics.md.
    #[arg(long)]
    docs: bool,
    /// Only this case; can be given more than once.
    #[arg(long)]
    case: Vec<String>,
    /// Runs per method, instead of those of the case; at least 2.
    #[arg(long, value_parser = clap::value_parser!(u16).range(2..))]
    runs: Option<u16>,
}

fn main() -> Result<()> {
    let arguments = Arguments::parse();
    let asked = |name: &str| arguments.case.is_empty() || arguments.case.iter().any(|case| case == name);
    let cases: Vec<&cases::Case> = cases::CASES.iter().filter(|case| asked(case.name)).collect();
    let runs = arguments.runs.map(usize::from);
    let mut all = Vec::new();
    for case in cases {
        let outcomes = study::run_case(case, &arguments.scenes, runs)?;
        report::of_case(&outcomes).iter().for_each(print);
        all.push(outcomes);
    }
    let overview = report::overview(&all);
    overview.iter().for_each(print);
    let mut tables: Vec<_> = overview.into_iter().collect();
    tables.extend(all.iter().flat_map(report::of_case));
    std::fs::create_dir_all(&arguments.out).map_err(|e| cagedyn_studies::file_error(&arguments.out, e))?;
    tables.iter().try_for_each(|table| table.save(&arguments.out))?;
    if arguments.docs {
        report::write_page(Path::new("docs/results/statistics.md"), &tables)?;
    }
    Ok(())
}

fn print(table: &Table) {
    println!("{}\n\n{}", table.name, table.text());
}
