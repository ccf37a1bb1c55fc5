//! Quantities over time or another axis, one diagram below the other.

use super::axis::Axis;
use super::panel::{Place, panel};
use super::style::{self, CURVE, FAINT, INK, MUTED, Paint, Symbol, TEXT, line, px, text};
use cagedyn::{Interval, Result};
use plotters::prelude::Text;
use plotters::style::text_anchor::{HPos, VPos};

/// Height of a diagram and gap between two, px.
const HEIGHT: f64 = 165.0;
const GAP: f64 = 16.0;
/// Width of the picture, px.
const WIDTH: f64 = 900.0;
/// Upper edge of the first diagram below one row of the legend, px.
const TOP: f64 = 100.0;

/// One diagram.
pub struct Strip<'a> {
    /// Name of the quantity with unit; a second line may tell what its sign means.
    pub name: &'static str,
    /// Values over time and their colours; later curves cover earlier ones.
    pub curves: Vec<(Paint, Vec<f64>)>,
    /// Dashed lines at these values.
    pub bounds: Vec<f64>,
    /// Extremes between the times, drawn behind the curves.
    pub envelope: Option<&'a [Interval]>,
    /// Remark below it; not of the last one.
    pub note: Option<&'static str>,
    /// A time from which on something holds, and what.
    pub since: Option<(f64, String)>,
}

/// Colour of extremes.
pub const ENVELOPE: Paint = FAINT;

impl Strip<'_> {
    /// A diagram without contents.
    pub fn new(name: &'static str) -> Self {
        Self { name, curves: Vec::new(), bounds: Vec::new(), envelope: None, note: None, since: None }
    }
}

/// Texts of the picture.
pub struct Texts<'a> {
    /// Title.
    pub title: &'a str,
    /// Line below it.
    pub subtitle: &'a str,
    /// Name of the common axis with unit.
    pub axis: &'a str,
    /// Step of its ticks, if it is no round number.
    pub step: Option<f64>,
    /// Legend.
    pub entries: Vec<(Symbol, String)>,
}

/// The usual axis.
pub const TIME: &str = "time [s]";

/// The picture over `times`, or the places on another axis; intervals of them in `shaded` get another background.
///
/// # Errors
/// [`cagedyn::Status::File`] when it cannot be drawn.
pub fn history(
    texts: &Texts<'_>,
    times: &[f64],
    strips: &[Strip<'_>],
    shaded: &[(f64, f64)],
) -> Result<String> {
    let (start, end) = (times.first().copied().unwrap_or(0.0), times.last().copied().unwrap_or(1.0));
    let x_axis = Axis::new(texts.axis, start, end, 10);
    let x_axis = texts.step.map_or(x_axis.clone(), |step| x_axis.every(step));
    let rows = style::legend_rows(&texts.entries, WIDTH);
    let top = TOP + style::LEGEND_ROW * (rows.len().max(1) - 1) as f64;
    let height = top + strips.len() as f64 * (HEIGHT + GAP) + 46.0;
    style::picture((WIDTH, height), texts.title, texts.subtitle, |canvas| {
        for (k, row) in rows.iter().enumerate() {
            style::legend_row(canvas, 78.0 + style::LEGEND_ROW * k as f64, row)?;
        }
        for (k, strip) in strips.iter().enumerate() {
            let values = strip.curves.iter().flat_map(|(_, values)| values.iter().copied());
            let extremes = strip.envelope.unwrap_or_default().iter().flat_map(|x| [x.min, x.max]);
            let shown = values.chain(strip.bounds.iter().copied()).chain(extremes);
            let y_axis = Axis::covering(strip.name, shown, 5);
            let place = Place { x: 100.0, y: top + k as f64 * (HEIGHT + GAP), w: 770.0, h: HEIGHT };
            let last = k + 1 == strips.len();
            if let Some(note) = strip.note {
                let style = text(TEXT - 2.0, MUTED, HPos::Right, VPos::Center);
                let at = (px(place.x + place.w), px(place.y + place.h + 0.5 * GAP));
                canvas.draw(&Text::new(note, at, style))?;
            }
            panel(canvas, place, (&x_axis, &y_axis), last, shaded, |panel| {
                for &bound in &strip.bounds {
                    panel.dashed([(start, bound), (end, bound)], line(MUTED, 0.9))?;
                }
                if let Some(envelope) = strip.envelope {
                    panel.envelope(envelope.iter().map(|x| (x.from, x.to, x.min, x.max)), ENVELOPE)?;
                }
                for (color, values) in &strip.curves {
                    let points = times.iter().copied().zip(values.iter().copied());
                    panel.curve(points, line(*color, CURVE))?;
                }
                if let Some((from, what)) = &strip.since {
                    panel.vertical(*from, y_axis.max, line(MUTED, 0.9))?;
                    let (x, y) = panel.place((*from, y_axis.max));
                    let at = (x + px(6.0), y + px(14.0));
                    style::label(panel.canvas(), what, at, (TEXT - 1.0, INK), HPos::Left)?;
                }
                Ok(())
            })?;
        }
        Ok(())
    })
}
