//! Pictures as SVG text. Each exists only if the scene has the channels it shows.

mod axis;
mod cage_positions;
mod orbit;
mod panel;
mod position;
mod roller;
mod spectrum;
mod style;

pub use cage_positions::{Point, Series, cage_positions};

use crate::run::Run;
use crate::summary::Summary;
use cagedyn::Result;

/// File names and contents of the pictures of a run.
///
/// # Errors
/// [`cagedyn::Status::File`] when a picture cannot be drawn.
pub fn pictures(run: &Run, summary: &Summary) -> Result<Vec<(&'static str, String)>> {
    // A single record is no history: the run failed or was interrupted at its start.
    if run.recording.times.len() < 2 {
        return Ok(Vec::new());
    }
    let drawn = [
        ("cage_orbit.svg", orbit::cage_orbit(run, summary)),
        ("cage_position.svg", position::cage_position(run, summary)),
        ("roller_history.svg", roller::roller_history(run)),
        ("cage_spectrum.svg", spectrum::cage_spectrum(run, summary)),
    ];
    drawn.into_iter().filter_map(|(name, svg)| Some(svg?.map(|svg| (name, svg)))).collect()
}
