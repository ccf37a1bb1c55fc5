//! What accuracy costs in time: `make accuracy`.
//!
//! Runs the library and other solvers on the same derivatives, in one process; prints tables, writes them as CSV files and
//! diagrams, and with `--docs` also `docs/results/accuracy.md` and its pictures.

mod curves;
mod goals;
mod kernel;
mod memory;
mod peers;
mod plots;
mod pointwise;
mod problem;
mod report;
mod scenes;
mod size;
mod solvers;
mod statistics;

use cagedyn::Result;
use clap::Parser;
use std::path::{Path, PathBuf};

#[derive(Parser)]
#[command(about)]
struct Arguments {
    /// Folder of tables and diagrams.
    #[arg(long, default_value = "out/accuracy")]
    out: PathBuf,
    /// Also write docs/results/accuracy.md and docs/results/performance.md, with tables and pictures: all from one run.
    #[arg(long, conflicts_with = "only")]
    docs: bool,
    /// Only this comparison, or `size`, `costs` or `goals`; can be given more than once.
    #[arg(long)]
    only: Vec<String>,
}

fn main() -> Result<()> {
    let arguments = Arguments::parse();
    let asked = |name: &str| arguments.only.is_empty() || arguments.only.iter().any(|only| only == name);
    let solvers = pointwise::available();
    let machine = machine();
    make_folder(&arguments.out)?;
    let (mut comparisons, mut tables) = (Vec::new(), Vec::new());
    // The long comparisons come last.
    let mut growth = None;
    if asked("size") {
        let (table, exponent, memory) = size::table(&solvers)?;
        println!("{}", table.text());
        growth = Some((exponent, memory));
        tables.push(table);
    }
    if asked("costs") {
        for table in kernel::tables()? {
            println!("{}", table.text());
            tables.push(table);
        }
    }
    let names = pointwise::NAMES.iter().map(|name| (*name, true));
    for (name, is_pointwise) in names.chain(statistics::NAMES.iter().map(|name| (*name, false))) {
        if !asked(name) {
            continue;
        }
        let compare = if is_pointwise { pointwise::compare } else { statistics::compare };
        let comparison = compare(name, &solvers)?;
        let times = report::times(&comparison);
        println!("{}\nreference: {}\n\n{}", comparison.title, comparison.reference, times.text());
        let picture = plots::diagram(&comparison, &machine)?;
        write(&arguments.out.join(format!("{name}.svg")), &picture)?;
        if arguments.docs {
            write(&Path::new("docs/images").join(format!("accuracy_{name}.svg")), &picture)?;
        }
        tables.push(report::runs(&comparison));
        tables.push(times);
        comparisons.push(comparison);
    }
    let presets = report::presets(&comparisons);
    println!("{}", presets.text());
    tables.push(presets);
    if asked("goals") {
        let table = goals::table(&comparisons, growth)?;
        println!("{}", table.text());
        tables.push(table);
    }
    tables.iter().try_for_each(|table| table.save(&arguments.out))?;
    if arguments.docs {
        let mut texts: Vec<(String, String)> = comparisons
            .iter()
            .map(|c| (format!("{} reference", c.name), format!("{}.", c.reference)))
            .collect();
        texts.push(("machine".to_owned(), format!("{machine}.")));
        let shown = tables.iter().filter(|table| !comparisons.iter().any(|c| c.name == table.name));
        texts.extend(shown.map(|table| (table.name.clone(), table.text())));
        report::write_pages(
            &["docs/results/accuracy.md", "docs/results/performance.md"].map(Path::new),
            &texts,
        )?;
        let data = Path::new("docs/results/accuracy");
        make_folder(data)?;
        tables.iter().try_for_each(|table| table.save(data))?;
    }
    Ok(())
}

/// The processor and the compiler.
fn machine() -> String {
    let info = std::fs::read_to_string("/proc/cpuinfo").unwrap_or_default();
    let model = info.lines().find_map(|line| line.strip_prefix("model name")?.split_once(": "));
    let processor = model.map_or("unknown processor", |(_, name)| name.trim());
    let widest = if info.contains("avx512f") {
        "AVX-512"
    } else if info.contains("avx2") {
        "AVX2"
    } else {
        "no AVX2"
    };
    format!("one core of {processor} with {widest}")
}

fn make_folder(path: &Path) -> Result<()> {
    std::fs::create_dir_all(path).map_err(|e| cagedyn_studies::file_error(path, e))
}

fn write(path: &Path, text: &str) -> Result<()> {
    std::fs::write(path, text).map_err(|e| cagedyn_studies::file_error(path, e))
}
