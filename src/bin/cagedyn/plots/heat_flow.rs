//! Lumps of a heat balance with their temperatures, and the heat that flows between them.

use super::labels::Room;
use super::style::{BLUE, Drawn, FAINT, INK, MUTED, Paint, RED, TEXT, line, picture, px, text};
use crate::results::table::celsius;
use cagedyn::Result;
use cagedyn::heat::HeatState;
use plotters::prelude::*;
use plotters::style::text_anchor::{HPos, VPos};
use std::f64::consts::TAU;

/// Size of the picture, centre and radii of the ring of lumps, px.
const SIZE: (f64, f64) = (860.0, 620.0);
const CENTRE: (f64, f64) = (430.0, 345.0);
const RADII: (f64, f64) = (310.0, 210.0);
/// Largest radius of a lump, its share of the way to the next one, and widest flow, px.
const LUMP: f64 = 38.0;
const LUMP_SHARE: f64 = 0.4;
const WIDEST: f64 = 14.0;
/// Usual place of the label of a flow on its way: off the middle, where arrows cross.
const LABEL: f64 = 0.42;
/// Flows below this share of the largest are lines of the least width.
const LEAST: f64 = 0.8;

/// The picture.
///
/// # Errors
/// [`cagedyn::Status::File`] when drawing fails.
pub fn draw(
    title: &str,
    names: &[String],
    links: &[[String; 2]],
    state: &HeatState,
    ambient: f64,
) -> Result<String> {
    let subtitle = "temperatures of the lumps, heat made in them (red) and heat that flows (width in proportion, at least a hairline)";
    picture(SIZE, title, subtitle, |canvas| {
        let count = names.len() + 1;
        let place = |i: usize| {
            // The surroundings at the bottom.
            let angle = TAU * (i as f64 + 1.0) / count as f64 + 0.25 * TAU;
            (CENTRE.0 + RADII.0 * angle.cos(), CENTRE.1 + RADII.1 * angle.sin())
        };
        let of = |name: &str| place(names.iter().position(|other| other == name).unwrap_or(names.len()));
        let at = |(x, y): (f64, f64)| (px(x), px(y));
        let way = TAU * RADII.1 / count as f64;
        let lump = LUMP.min(LUMP_SHARE * way);
        let mut room = Room::new(TEXT, lump);
        (0..count).for_each(|i| room.add(&[at(place(i))]));
        let mut labels = Vec::new();
        let largest = state.flows.iter().fold(1e-12, |most: f64, flow| most.max(flow.abs()));
        for ([from, to], flow) in links.iter().zip(&state.flows) {
            let (from, to) = if *flow >= 0.0 { (of(from), of(to)) } else { (of(to), of(from)) };
            let width = (WIDEST * flow.abs() / largest).max(LEAST);
            arrow(canvas, from, to, lump, width, FAINT)?;
            let ends = (at(from), at(to));
            room.line(&[ends.0, ends.1], width);
            labels.push((ends, format!("{:.2} W", flow.abs())));
        }
        for (ends, label) in labels {
            let frame = room.slide(ends, LABEL, &label);
            canvas.draw(&Rectangle::new(frame.corners(), WHITE.mix(0.85).filled()))?;
            canvas.draw(&Text::new(label, frame.centre, text(TEXT, BLUE, HPos::Center, VPos::Center)))?;
        }
        let lumps = names.iter().zip(state.temperatures.iter().zip(&state.heat));
        let lumps = lumps.map(|(name, (temperature, heat))| (name.as_str(), *temperature, *heat));
        for (i, (name, temperature, heat)) in lumps.chain([("ambient", ambient, 0.0)]).enumerate() {
            let (x, y) = place(i);
            canvas.draw(&Circle::new(at((x, y)), px(lump), WHITE.filled()))?;
            canvas.draw(&Circle::new(at((x, y)), px(lump), line(INK, 1.4)))?;
            let name = name.replace('_', " ");
            canvas.draw(&Text::new(name, at((x, y - 3.0)), text(TEXT, MUTED, HPos::Center, VPos::Bottom)))?;
            let scales = [format!("{temperature:.1} K"), format!("{:.1} \u{b0}C", celsius(temperature))];
            for (k, degrees) in scales.into_iter().enumerate() {
                let place = at((x, y + TEXT * k as f64));
                canvas.draw(&Text::new(degrees, place, text(TEXT, INK, HPos::Center, VPos::Top)))?;
            }
            if heat != 0.0 {
                // On the side away from the middle, where no flow is.
                let (side, anchor) = if y < CENTRE.1 { (-1.0, VPos::Bottom) } else { (1.0, VPos::Top) };
                let label = text(TEXT, RED, HPos::Center, anchor);
                let made = format!("+{heat:.2} W");
                canvas.draw(&Text::new(made, at((x, y + side * (lump + 4.0))), label))?;
            }
        }
        Ok(())
    })
}

/// A line from one lump to another with a head before the second.
fn arrow(
    canvas: &super::style::Canvas<'_>,
    from: (f64, f64),
    to: (f64, f64),
    lump: f64,
    width: f64,
    color: Paint,
) -> Drawn {
    let (dx, dy) = (to.0 - from.0, to.1 - from.1);
    let length = dx.hypot(dy);
    let (ux, uy) = (dx / length, dy / length);
    let head = 6.0 + width;
    let tip = (to.0 - ux * (lump + 1.0), to.1 - uy * (lump + 1.0));
    let neck = (tip.0 - ux * head, tip.1 - uy * head);
    let point = |(x, y): (f64, f64)| (px(x), px(y));
    canvas.draw(&PathElement::new(vec![point(from), point(neck)], line(color, width)))?;
    let side = 0.5 * width + 4.0;
    let corners = [tip, (neck.0 - uy * side, neck.1 + ux * side), (neck.0 + uy * side, neck.1 - ux * side)];
    canvas.draw(&Polygon::new(corners.map(point).to_vec(), color.filled()))
}
