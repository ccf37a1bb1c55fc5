//! Work-precision diagrams: wall time over error, both logarithmic, one line per solver over its settings.

use crate::curves::{Comparison, Curve};
use crate::solvers::Way;
use axis::Axis;
use cagedyn::Result;
use cagedyn_studies::plots::{axis, panel, style};
use panel::{Place, X_LABELS, Y_LABELS, panel};
use style::{
    CURVE, Canvas, Drawn, LEFT, MUTED, Marker, Paint, SERIES, Symbol, THIN, legend_entry, line, marker,
};

/// Size of a diagram without labels, px, and of a line of the legend.
const WIDTH: f64 = 620.0;
const HEIGHT: f64 = 420.0;
const TOP: f64 = 84.0;
const LEGEND: f64 = 300.0;
const LEGEND_LINE: f64 = 24.0;
/// Room around the points, powers of ten.
const ROOM: f64 = 0.3;
/// Smaller errors, in units of the noise, and errors so many powers of ten above the smallest that is shown stand at these ends.
const FLOOR: f64 = 0.3;
const DECADES: f64 = 8.0;

/// The diagram of a comparison.
///
/// # Errors
/// [`cagedyn::Status::File`] when it cannot be drawn.
pub fn diagram(comparison: &Comparison, machine: &str) -> Result<String> {
    let points = || comparison.curves.iter().flat_map(|curve| &curve.points);
    let ends = |values: Vec<f64>| {
        let logs = values.iter().map(|x| x.log10());
        logs.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), x| (low.min(x), high.max(x)))
    };
    let floor = FLOOR * comparison.noise;
    let errors = ends(points().map(|p| p.error.max(floor)).collect());
    let times = ends(points().map(|p| p.seconds).collect());
    let most = errors.1.min(errors.0 + DECADES);
    let x = Axis::powers_of_ten(comparison.error, errors.0 - ROOM, most + ROOM);
    let y = Axis::powers_of_ten("wall time, s", times.0 - ROOM, times.1 + ROOM);
    let place = Place { x: LEFT + Y_LABELS, y: TOP, w: WIDTH, h: HEIGHT };
    let size = (place.x + WIDTH + LEGEND + 2.0 * LEFT, TOP + HEIGHT + X_LABELS + 16.0);
    let mut subtitle = format!("{} s simulated, {machine}. Shaded: noise of the error", comparison.simulated);
    if points().any(|p| p.error < floor) {
        subtitle += &format!("; errors below {FLOOR} of it are drawn there");
    }
    if errors.1 > most {
        subtitle += "; errors beyond the scale are drawn at its end";
    }
    subtitle.push('.');
    let noise = [(x.min, comparison.noise.log10())];
    style::picture(size, comparison.title, &subtitle, |canvas| {
        panel(canvas, place, (&x, &y), true, &noise, |panel| {
            for target in &comparison.targets {
                panel.vertical(target.log10(), y.max, line(MUTED, THIN))?;
            }
            for (k, curve) in comparison.curves.iter().enumerate() {
                let (color, shape) = look(k, curve);
                let at = |p: &crate::curves::Point| (p.error.max(floor).log10().min(most), p.seconds.log10());
                let width = if curve.solver.ours() { 1.5 * CURVE } else { CURVE };
                panel.curve(curve.points.iter().map(at), line(color, width))?;
                for point in &curve.points {
                    let place = panel.place(at(point));
                    marker(panel.canvas(), shape, place, size_of(curve), color)?;
                }
            }
            Ok(())
        })?;
        legend(canvas, comparison, place.x + WIDTH + LEFT)
    })
}

fn legend(canvas: &Canvas<'_>, comparison: &Comparison, x: f64) -> Drawn {
    let shown = comparison.curves.iter().enumerate().filter(|(_, curve)| !curve.points.is_empty());
    for (line, (k, curve)) in shown.enumerate() {
        let (color, shape) = look(k, curve);
        let symbol = match curve.solver.way {
            Way::Preset(_) => Symbol::Marker(shape, color),
            _ => Symbol::MarkedLine(shape, color),
        };
        let y = TOP + LEGEND_LINE * (line as f64 + 0.5);
        legend_entry(canvas, (x, y), symbol, curve.solver.name)?;
    }
    Ok(())
}

/// Colour and marker of a curve: the library's are filled, others open or crossed.
fn look(k: usize, curve: &Curve) -> (Paint, Marker) {
    let color = SERIES[k % SERIES.len()];
    let shape = match curve.solver.way {
        Way::Preset(_) => Marker::Diamond,
        Way::Leapfrog | Way::Controlled(_) => Marker::Disc,
        Way::Cvode(..) => Marker::Ring,
        Way::Peer(..) => Marker::Cross,
    };
    (color, shape)
}

fn size_of(curve: &Curve) -> f64 {
    if matches!(curve.solver.way, Way::Preset(_)) { 7.0 } else { 3.2 }
}
