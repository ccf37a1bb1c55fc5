//! The figures of both papers beside what the library gives: `make figures`.
//!
//! Reads the folders that the tool wrote, prints tables and writes them into `docs/papers.md`.

mod ball_bearing;
mod folder;
mod roller_bearing;

use cagedyn::Result;
use clap::Parser;
use std::path::PathBuf;

#[derive(Parser)]
#[command(about)]
struct Arguments {
    /// Folder with the results of the tool, as `make figures` makes it.
    folder: PathBuf,
    /// Page whose tables are written.
    #[arg(long)]
    page: Option<PathBuf>,
}

fn main() -> Result<()> {
    let arguments = Arguments::parse();
    let mut tables = roller_bearing::tables(&arguments.folder)?;
    tables.extend(ball_bearing::tables(&arguments.folder)?);
    for table in &tables {
        println!("{}\n{}", table.name, table.text());
    }
    match &arguments.page {
        Some(page) => cagedyn_studies::write_tables(
            page,
            tables.iter().map(|table| (table.name.as_str(), table.text())),
        ),
        None => Ok(()),
    }
}
