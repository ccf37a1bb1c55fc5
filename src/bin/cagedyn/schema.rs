//! The command `schema`.

use crate::{Format, SchemaArgs, terminal};
use cagedyn::Scene;
use cagedyn::scene::CaseSet;
use cagedyn::{Error, Result, Status};
use std::process::ExitCode;

/// Prints the JSON Schema of a format.
///
/// # Errors
/// [`Status::File`] when standard output cannot be written.
pub fn command(args: &SchemaArgs) -> Result<ExitCode> {
    let schema = match args.format {
        Format::Scene => Scene::json_schema(),
        Format::Cases => CaseSet::json_schema(),
    };
    let text =
        serde_json::to_string_pretty(&schema).map_err(|e| Error::new(Status::Internal, e.to_string()))?;
    terminal::print(&(text + "\n"))?;
    Ok(ExitCode::SUCCESS)
}
