//! The command `schema`.

use crate::{Format, SchemaArgs, terminal};
use cagedyn::scene::CaseSet;
use cagedyn::{Result, Scene};
use std::process::ExitCode;

/// Prints the JSON Schema of a format.
///
/// # Errors
/// [`cagedyn::Status::File`] when standard output cannot be written.
pub fn command(args: &SchemaArgs) -> Result<ExitCode> {
    terminal::print(match args.format {
        Format::Scene => Scene::JSON_SCHEMA,
        Format::Cases => CaseSet::JSON_SCHEMA,
    })?;
    Ok(ExitCode::SUCCESS)
}
