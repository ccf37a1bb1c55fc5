//! Pictures as SVG text. Each exists only if the scene has the channels it shows.

mod axis;
mod cage_positions;
mod cage_shape;
mod cage_views;
mod ellipse;
pub mod equilibrium;
mod forces;
pub mod heat_flow;
mod labels;
pub mod line_load_map;
mod orbit;
mod over_orbit;
mod panel;
mod position;
mod roller;
mod roller_skew;
mod spectrogram;
mod spectrum;
mod strips;
pub mod style;
pub mod sweep;
mod units;
pub mod whirl_branch;
mod whirl_history;
mod whirl_speed;

pub use cage_positions::{Point, cage_positions};
pub use whirl_speed::{WhirlPoint, whirl_speed};

use crate::results::finished::Run;
use crate::results::summary::Summary;
use cagedyn::Result;
use style::{Marker, Paint, SERIES};

/// Shapes of series, in order; another number than colours, so that their combinations repeat late.
const SHAPES: [Marker; 4] = [Marker::Disc, Marker::Square, Marker::Triangle, Marker::Diamond];

/// Cases that differ in speed only, in the order of speed.
pub struct Series<P> {
    /// What the cases have in common.
    pub label: String,
    /// One point per case.
    pub points: Vec<P>,
}

/// Speeds whose ratio is larger are shown by their logarithms.
const LONG: f64 = 20.0;

/// Whether low ones of these speeds would lie on each other.
fn is_long(speeds: &[f64]) -> bool {
    let slowest = speeds.iter().copied().fold(f64::INFINITY, f64::min);
    slowest > 0.0 && speeds.iter().any(|speed| *speed > LONG * slowest)
}

/// Marker and colour of series `k`.
fn look(k: usize) -> (Marker, Paint) {
    (SHAPES[k % SHAPES.len()], SERIES[k % SERIES.len()])
}

/// File names of the pictures of a run.
pub const PICTURES: [&str; 13] = [
    "cage_orbit.svg",
    "cage_position.svg",
    "roller_history.svg",
    "over_orbit.svg",
    "whirl_history.svg",
    "cage_spectrum.svg",
    "contact_forces.svg",
    "contact_ellipse.svg",
    "cage_spectrogram.svg",
    "cage_views.svg",
    "land_gaps.svg",
    "roller_skew.svg",
    "line_load_map.svg",
];

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
        orbit::cage_orbit(run, summary),
        position::cage_position(run, summary),
        roller::roller_history(run),
        over_orbit::over_orbit(run, summary),
        whirl_history::whirl_history(run, summary),
        spectrum::cage_spectrum(run, summary),
        forces::contact_forces(run),
        ellipse::contact_ellipse(run),
        spectrogram::cage_spectrogram(run, summary),
        cage_views::cage_views(run, summary),
        cage_views::land_gaps(run, summary),
        roller_skew::roller_skew(run, summary),
        line_load_map::of_run(run),
    ];
    PICTURES.into_iter().zip(drawn).filter_map(|(name, svg)| Some(svg?.map(|svg| (name, svg)))).collect()
}
