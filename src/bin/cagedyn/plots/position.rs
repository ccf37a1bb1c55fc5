//! Position of the cage centre over time (compare Fig. 5).

use super::axis::Axis;
use super::panel::{Place, panel};
use super::style::{self, BLUE, CURVE, ORANGE, Symbol, line};
use crate::results::finished::Run;
use crate::results::summary::Summary;
use cagedyn::Result;

/// The picture, if there is a cage.
pub fn cage_position(run: &Run, summary: &Summary) -> Option<Result<String>> {
    let millimetres = |name: &str| Some(run.column(name)?.iter().map(|x| 1e3 * x).collect::<Vec<f64>>());
    let (y, z) = (millimetres("cage.y")?, millimetres("cage.z")?);
    Some(draw(run, summary, &y, &z))
}

fn draw(run: &Run, summary: &Summary, y: &[f64], z: &[f64]) -> Result<String> {
    let times = &run.recording.times;
    let x_axis = Axis::new("time [s]", 0.0, run.end(), 8);
    let y_axis = Axis::covering("cage centre [mm]", y.iter().chain(z).copied(), 6);
    let place = Place { x: 100.0, y: 100.0, w: 770.0, h: 330.0 };
    let window = [(summary.window.from_s, summary.window.to_s)];
    style::picture((900.0, 500.0), &run.title, &run.subtitle("Position of the cage centre"), |canvas| {
        let entries = [
            (Symbol::Line(BLUE), "y, to the right".to_owned()),
            (Symbol::Line(ORANGE), "z, upwards".to_owned()),
            (Symbol::Patch, "averaging window".to_owned()),
        ];
        style::legend_row(canvas, 78.0, &entries)?;
        panel(canvas, place, (&x_axis, &y_axis), true, &window, |panel| {
            let pairs = |values: &[f64]| times.iter().copied().zip(values.to_vec());
            panel.curve(pairs(y), line(BLUE, CURVE))?;
            panel.curve(pairs(z), line(ORANGE, CURVE))
        })
    })
}
