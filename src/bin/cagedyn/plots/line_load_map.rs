//! Load per length along all rollers as a map: azimuth across, place along the roller up, for either raceway.

use super::axis::Axis;
use super::panel::{Panel, Place, panel};
use super::style::{self, Canvas, Drawn, GRID, MUTED, TEXT, THIN, line, px, text};
use super::sweep::colours::{self, STEPS, color};
use crate::results::finished::Run;
use crate::results::table::rounded;
use cagedyn::Result;
use cagedyn::equilibrium::Equilibrium;
use cagedyn::model::LINE_LOAD_QUANTITIES;
use plotters::prelude::{Color, Rectangle, Text};
use plotters::style::text_anchor::{HPos, VPos};

/// Size of a map, px, and distance from the top of one to that of the next.
const SIZE: (f64, f64) = (690.0, 190.0);
const NEXT: f64 = 246.0;
const TOP: f64 = 104.0;
/// Share of the distance between rollers that a column takes, and room on either side of where their middles may be.
const COLUMN: f64 = 0.72;
const BESIDE: f64 = 0.4;
/// Raceways in the order of the contacts of a roller.
const RACEWAYS: [&str; 2] = ["outer raceway", "inner raceway"];

/// A part of a roller: from where to where, m, and its load, N/m.
type Cell = ([f64; 2], f64);

/// A roller: its number, its azimuth in degrees, and how either raceway loads it.
struct Column {
    number: usize,
    azimuth: f64,
    cells: [Vec<Cell>; 2],
}

/// The picture at the end of a run, if rollers move in space and their azimuths are recorded.
pub fn of_run(run: &Run) -> Option<Result<String>> {
    let length = run.model.scene().rollers.as_ref()?.effective_length;
    if run.line_loads.is_empty() {
        return None;
    }
    let place = |name: &str| LINE_LOAD_QUANTITIES.iter().position(|q| q.name == name);
    let [at, extent, load] = [place("place")?, place("extent")?, place("line_load")?];
    let cells = |loads: &Vec<cagedyn::model::LineLoad>| {
        let nodes: Vec<[f64; 3]> = loads.iter().map(|node| [node[at], node[extent], node[load]]).collect();
        of_nodes(&nodes, 0.5 * length)
    };
    let columns = run.line_loads.iter().enumerate().map(|(j, loads)| {
        let angle = *run.column(&format!("roller[{j}].orbit_angle"))?.last()?;
        Some(Column { number: j, azimuth: angle.to_degrees(), cells: [0, 1].map(|k| cells(&loads[k])) })
    });
    let columns: Vec<Column> = columns.collect::<Option<_>>()?;
    let time = rounded(run.recording.times.last().copied()?);
    let subtitle = run.subtitle(&format!("Load per length along the rollers at {time} s"));
    Some(picture(&run.title, &subtitle, length, columns))
}

/// The picture of an equilibrium that tells line loads.
///
/// # Errors
/// [`cagedyn::Status::File`] when it cannot be drawn.
pub fn of_equilibrium(title: &str, found: &Equilibrium) -> Result<String> {
    let places = &found.line_loads.places;
    let (first, last) = (places.first().copied().unwrap_or(0.0), places.last().copied().unwrap_or(0.0));
    let middle = |i: usize| 0.5 * (places[i] + places[i + 1]);
    let bounds = |i: usize| {
        [if i == 0 { first } else { middle(i - 1) }, if i + 1 == places.len() { last } else { middle(i) }]
    };
    let columns = (0..found.elements.len()).map(|j| {
        let cells = |k: usize| -> Vec<Cell> {
            let loads = found.line_loads.values[2 * j + k].iter().enumerate();
            loads.filter(|(_, load)| **load > 0.0).map(|(i, load)| (bounds(i), *load)).collect()
        };
        Column { number: j, azimuth: found.elements[j][0].to_degrees(), cells: [0, 1].map(cells) }
    });
    let subtitle = "Equilibrium: load per length along the rollers";
    picture(title, subtitle, last - first, columns.collect())
}

/// What nodes, each with its place, its extent and its load, stand for on a roller of this half length, m. Neighbours meet in the middle
/// between their extents, but where there is an unloaded part between them.
fn of_nodes(nodes: &[[f64; 3]], half_length: f64) -> Vec<Cell> {
    let ends = |[at, extent, _]: [f64; 3]| [at - 0.5 * extent, at + 0.5 * extent];
    let meet = |before: [f64; 3], after: [f64; 3]| {
        let (end, begin) = (ends(before)[1], ends(after)[0]);
        (begin - end < 0.25 * before[1].min(after[1])).then_some(0.5 * (end + begin))
    };
    let mut cells: Vec<Cell> = nodes.iter().map(|node| (ends(*node), node[2])).collect();
    for (i, pair) in nodes.windows(2).enumerate() {
        if let Some(at) = meet(pair[0], pair[1]) {
            (cells[i].0[1], cells[i + 1].0[0]) = (at, at);
        }
    }
    for ([from, to], _) in &mut cells {
        (*from, *to) = (from.max(-half_length), to.min(half_length));
    }
    cells
}

fn picture(title: &str, subtitle: &str, length: f64, mut columns: Vec<Column>) -> Result<String> {
    let pitch = 360.0 / columns.len().max(1) as f64;
    for column in &mut columns {
        column.azimuth = (column.azimuth + 0.5 * pitch).rem_euclid(360.0) - 0.5 * pitch;
    }
    let loads = columns.iter().flat_map(|column| column.cells.iter().flatten());
    let largest = 1e-3 * loads.map(|(_, load)| *load).fold(0.0, f64::max);
    let scale = Axis::new("load per length [N/mm]", 0.0, largest.max(1e-3), 5);
    let axis = "azimuth from y, counter-clockwise; 270 is the bottom [deg]";
    let ends = [-0.5 - BESIDE, -0.5 + BESIDE].map(|share| share * pitch);
    let x_axis = Axis::new(axis, ends[0], 360.0 + ends[1], 8).every(45.0);
    let half = 0.55e3 * length;
    let height = TOP + NEXT + SIZE.1 + 60.0;
    style::picture((900.0, height), title, subtitle, |canvas| {
        for (k, raceway) in RACEWAYS.into_iter().enumerate() {
            let y_axis = Axis::new("along the roller [mm]\n+x upwards", -half, half, 5);
            let place = Place { x: 100.0, y: TOP + k as f64 * NEXT, w: SIZE.0, h: SIZE.1 };
            let style = text(TEXT, MUTED, HPos::Left, VPos::Center);
            let head = format!("{raceway}; numbers are those of the rollers");
            canvas.draw(&Text::new(head, (px(place.x), px(place.y - 30.0)), style))?;
            let last = k + 1 == RACEWAYS.len();
            panel(canvas, place, (&x_axis, &y_axis), last, &[], |panel| {
                columns.iter().try_for_each(|column| draw(panel, column, k, (pitch, length, scale.max)))
            })?;
            numbers(canvas, place, &columns, (&x_axis, pitch))?;
            colours::scale(canvas, place, &scale)?;
        }
        Ok(())
    })
}

/// A roller: its outline, and what is loaded of it.
fn draw(
    panel: &mut Panel<'_, '_, '_>,
    column: &Column,
    k: usize,
    (pitch, length, largest): (f64, f64, f64),
) -> Drawn {
    let half_width = 0.5 * COLUMN * pitch;
    let corners = |panel: &Panel<'_, '_, '_>, [from, to]: [f64; 2]| {
        [(-half_width, from), (half_width, to)].map(|(dx, s)| panel.place((column.azimuth + dx, 1e3 * s)))
    };
    let whole = corners(panel, [-0.5 * length, 0.5 * length]);
    panel.canvas().draw(&Rectangle::new(whole, GRID.filled()))?;
    // Neighbours of one colour are one rectangle.
    let step = |load: f64| (1e-3 * load / largest * STEPS as f64) as usize;
    let mut merged: Vec<([f64; 2], usize)> = Vec::new();
    for &([from, to], load) in &column.cells[k] {
        match merged.last_mut() {
            Some(last) if last.0[1] == from && last.1 == step(load) => last.0[1] = to,
            _ => merged.push(([from, to], step(load))),
        }
    }
    let mut end = f64::NAN;
    let reach: Vec<f64> = merged
        .iter()
        .enumerate()
        .rev()
        .map(|(i, ([_, to], _))| {
            let joined = merged.get(i + 1).is_some_and(|([from, _], _)| from == to);
            end = if joined { end } else { *to };
            end
        })
        .collect();
    // Up to the end of its part each, so that there are no gaps between them.
    for (([from, _], step), end) in merged.iter().zip(reach.into_iter().rev()) {
        let paint = color((*step as f64 + 0.5) / STEPS as f64);
        panel.canvas().draw(&Rectangle::new(corners(panel, [*from, end]), paint.filled()))?;
    }
    panel.canvas().draw(&Rectangle::new(whole, line(MUTED, THIN)))
}

/// Numbers of the rollers above their columns.
fn numbers(canvas: &Canvas<'_>, place: Place, columns: &[Column], (x, pitch): (&Axis, f64)) -> Drawn {
    // Beside each other as far as they have room.
    let room = place.w * pitch / (x.max - x.min);
    let every = (18.0 / room).ceil().max(1.0) as usize;
    columns.iter().filter(|column| column.number % every == 0).try_for_each(|column| {
        let at = place.x + place.w * (column.azimuth - x.min) / (x.max - x.min);
        let style = text(TEXT - 2.0, MUTED, HPos::Center, VPos::Center);
        canvas.draw(&Text::new(column.number.to_string(), (px(at), px(place.y - 9.0)), style))
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn nodes_of_one_part_meet_and_those_of_two_do_not() {
        // Gauss and Legendre's four on one part, in units of its half.
        let four = [[-0.861, 0.348, 1.0], [-0.34, 0.652, 2.0], [0.34, 0.652, 3.0], [0.861, 0.348, 4.0]];
        let cells = of_nodes(&four, 1.0);
        assert_eq!((cells[0].0[0], cells[3].0[1]), (-1.0, 1.0));
        assert!(cells.windows(2).all(|pair| pair[0].0[1] == pair[1].0[0]));
        assert!((cells[0].0[1] + 0.652).abs() < 0.03 && cells[1].0[1].abs() < 1e-12);
        let apart = of_nodes(&[[-0.9, 0.2, 1.0], [0.9, 0.2, 1.0]], 1.0);
        assert_eq!([apart[0].0[1], apart[1].0[0]].map(|x| (100.0 * x).round()), [-80.0, 80.0]);
        assert!(of_nodes(&[], 1.0).is_empty());
    }
}
