//! What all pictures share: colours, fonts, titles, markers and legends.

use super::axis::Axis;
use cagedyn::{Error, Result, Status};
use plotters::coord::Shift;
use plotters::prelude::*;
pub use plotters::style::RGBColor as Paint;
use plotters::style::text_anchor::{HPos, Pos, VPos};
use std::cell::RefCell;
use std::io;
use std::ops::Deref;

/// A drawing surface.
pub struct Canvas<'a> {
    area: DrawingArea<SVGBackend<'a>, Shift>,
    /// Elements that nobody sees, by which a page knows what the places of diagrams mean.
    notes: RefCell<String>,
}

impl<'a> Deref for Canvas<'a> {
    type Target = DrawingArea<SVGBackend<'a>, Shift>;

    fn deref(&self) -> &Self::Target {
        &self.area
    }
}

impl Canvas<'_> {
    /// Notes that a rectangle in px is a diagram with these axes.
    pub fn note(&self, [x, y, w, h]: [f64; 4], axes: [&Axis; 2]) {
        let [x, y, w, h] = [x, y, w, h].map(px);
        let of = |axis: &Axis| {
            let kind = if axis.logarithmic() { "log" } else { "lin" };
            let name = axis.name.lines().next().unwrap_or_default();
            format!("{} {} {kind} {}", axis.min, axis.max, escaped(name))
        };
        let [across, up] = axes.map(of);
        self.notes.borrow_mut().push_str(&format!(
            "<rect x=\"{x}\" y=\"{y}\" width=\"{w}\" height=\"{h}\" opacity=\"0\" data-x=\"{across}\" data-y=\"{up}\"/>\n"
        ));
    }
}

/// Result of drawing.
pub type Drawn<T = ()> = std::result::Result<T, DrawingAreaErrorKind<io::Error>>;

/// The drawing library rounds to whole pixels, which makes curves jagged. It therefore draws this many times larger,
/// and the viewer scales back.
const SCALE: f64 = 4.0;
/// The library divides font sizes by this factor.
const FONT_FACTOR: f64 = 1.24;
/// Mean width of a character in units of the font size, on the safe side.
const CHARACTER_WIDTH: f64 = 0.58;

/// Background.
pub const PAPER: Paint = WHITE;
/// Text and axes.
pub const INK: Paint = Paint(0x22, 0x2b, 0x35);
/// Secondary text and thin marks.
pub const MUTED: Paint = Paint(0x66, 0x71, 0x7d);
/// Grid lines.
pub const GRID: Paint = Paint(0xe4, 0xe7, 0xeb);
/// Shaded intervals.
pub const SHADE: Paint = Paint(0xec, 0xf1, 0xf8);
/// Curves that stand behind others.
pub const FAINT: Paint = Paint(0xa9, 0xbb, 0xd0);
/// First curve.
pub const BLUE: Paint = Paint(0x1f, 0x5f, 0xa6);
/// Second curve.
pub const ORANGE: Paint = Paint(0xd9, 0x6a, 0x1d);
/// Third curve.
pub const GREEN: Paint = Paint(0x2a, 0x8a, 0x5c);
/// Fourth curve, and marks that must be seen.
pub const RED: Paint = Paint(0xb8, 0x2e, 0x3a);
/// Fifth curve.
pub const PURPLE: Paint = Paint(0x74, 0x54, 0xa6);
/// Sixth curve.
pub const TEAL: Paint = Paint(0x1c, 0x8f, 0x9c);
/// Bodies: bars, rims and edges of the cage, elements.
pub const CAGE: Paint = Paint(0xd8, 0xb5, 0x6a);
pub const CAGE_RIM: Paint = Paint(0xf0, 0xe2, 0xbf);
pub const CAGE_EDGE: Paint = Paint(0x8a, 0x6d, 0x25);
pub const METAL: Paint = Paint(0xee, 0xf1, 0xf4);

/// Colours of series, in order.
pub const SERIES: [Paint; 6] = [BLUE, ORANGE, GREEN, PURPLE, TEAL, RED];

/// Size of normal text, px.
pub const TEXT: f64 = 13.0;
/// Line width of curves, px.
pub const CURVE: f64 = 1.4;
/// Line width of auxiliary lines, px.
pub const THIN: f64 = 0.9;

/// A length in px of the finished picture, in units of the surface.
pub fn px(length: f64) -> i32 {
    (length * SCALE).round() as i32
}

/// A line of some width in px.
pub fn line(color: Paint, width: f64) -> ShapeStyle {
    ShapeStyle { color: color.to_rgba(), filled: false, stroke_width: px(width).max(1) as u32 }
}

/// Text of a size in px, placed relative to its anchor.
pub fn text(size: f64, color: Paint, h: HPos, v: VPos) -> TextStyle<'static> {
    let font: FontDesc<'static> = ("sans-serif", size * FONT_FACTOR * SCALE).into();
    font.color(&color).pos(Pos::new(h, v))
}

fn bold(size: f64) -> TextStyle<'static> {
    let font = FontDesc::new(FontFamily::SansSerif, size * FONT_FACTOR * SCALE, FontStyle::Bold);
    font.color(&INK).pos(Pos::new(HPos::Left, VPos::Top))
}

/// Estimated width of a text, px.
pub fn text_width(text: &str, size: f64) -> f64 {
    CHARACTER_WIDTH * size * text.chars().count() as f64
}

/// Draws a picture of a size in px with a title and a line below it; `draw` adds the rest.
///
/// # Errors
/// [`Status::File`] when drawing fails.
pub fn picture(
    size: (f64, f64),
    title: &str,
    subtitle: &str,
    draw: impl FnOnce(&Canvas<'_>) -> Drawn,
) -> Result<String> {
    let mut svg = String::new();
    let (width, height) = (px(size.0), px(size.1));
    let drawn = (|| {
        let area = SVGBackend::with_string(&mut svg, (width as u32, height as u32)).into_drawing_area();
        let canvas = Canvas { area, notes: RefCell::default() };
        canvas.fill(&WHITE)?;
        let room = size.0 - 2.0 * LEFT;
        let fitting = 18.0 * (room / text_width(title, 19.0)).min(1.0);
        canvas.draw(&Text::new(title.to_owned(), (px(LEFT), px(16.0)), bold(fitting)))?;
        let fitting = TEXT * (room / text_width(subtitle, TEXT)).min(1.0);
        let style = text(fitting, MUTED, HPos::Left, VPos::Top);
        canvas.draw(&Text::new(subtitle.to_owned(), (px(LEFT), px(42.0)), style))?;
        draw(&canvas)?;
        canvas.present()?;
        Ok(canvas.notes.into_inner())
    })();
    let notes = drawn
        .map_err(|e: DrawingAreaErrorKind<io::Error>| Error::new(Status::File, format!("picture: {e}")))?;
    // The view box keeps the large coordinates; only the size of the picture shrinks.
    let drawn_size = format!("width=\"{width}\" height=\"{height}\"");
    let svg = svg.replacen(&drawn_size, &format!("width=\"{}\" height=\"{}\"", size.0, size.1), 1);
    Ok(svg.replacen("</svg>", &format!("{notes}</svg>"), 1))
}

/// Left margin of titles and legends, px.
pub const LEFT: f64 = 24.0;

/// Shape of a marker.
#[derive(Clone, Copy, PartialEq, Eq)]
pub enum Marker {
    /// Filled circle.
    Disc,
    /// White circle with a coloured edge.
    Ring,
    /// Diagonal cross.
    Cross,
    /// Filled square.
    Square,
    /// Filled triangle.
    Triangle,
    /// Filled diamond.
    Diamond,
}

/// Draws a marker of some size (about its radius in px) at a place of the surface.
pub fn marker(canvas: &Canvas<'_>, shape: Marker, at: (i32, i32), size: f64, color: Paint) -> Drawn {
    let (x, y) = at;
    let corners = |list: &[(f64, f64)]| -> Vec<(i32, i32)> {
        list.iter().map(|(dx, dy)| (x + px(dx * size), y + px(dy * size))).collect()
    };
    match shape {
        Marker::Disc => canvas.draw(&Circle::new(at, px(size), color.filled())),
        Marker::Ring => {
            canvas.draw(&Circle::new(at, px(size), WHITE.filled()))?;
            canvas.draw(&Circle::new(at, px(size), line(color, 1.8)))
        }
        Marker::Cross => {
            // A white edge keeps the cross visible on top of curves.
            for (paint, width) in [(WHITE, 4.6), (color, 2.4)] {
                for ends in [[(-1.0, -1.0), (1.0, 1.0)], [(-1.0, 1.0), (1.0, -1.0)]] {
                    canvas.draw(&PathElement::new(corners(&ends), line(paint, width)))?;
                }
            }
            Ok(())
        }
        Marker::Square => {
            let list = [(-0.9, -0.9), (0.9, -0.9), (0.9, 0.9), (-0.9, 0.9)];
            canvas.draw(&Polygon::new(corners(&list), color.filled()))
        }
        Marker::Triangle => {
            let list = [(0.0, -1.15), (1.1, 0.85), (-1.1, 0.85)];
            canvas.draw(&Polygon::new(corners(&list), color.filled()))
        }
        Marker::Diamond => {
            let list = [(0.0, -1.25), (1.25, 0.0), (0.0, 1.25), (-1.25, 0.0)];
            canvas.draw(&Polygon::new(corners(&list), color.filled()))
        }
    }
}

/// Half the width of the ends of bars, px.
const BAR_END: f64 = 4.0;

/// Draws a bar of scatter, upright or level, between two places of the surface.
pub fn bar(canvas: &Canvas<'_>, [from, to]: [(i32, i32); 2], color: Paint) -> Drawn {
    if from == to {
        return Ok(());
    }
    let (dx, dy) = if from.0 == to.0 { (px(BAR_END), 0) } else { (0, px(BAR_END)) };
    let end = |(x, y): (i32, i32)| [(x - dx, y - dy), (x + dx, y + dy)];
    let strokes = [[from, to], end(from), end(to)];
    strokes.into_iter().try_for_each(|ends| canvas.draw(&PathElement::new(ends.to_vec(), line(color, THIN))))
}

/// Draws a text of a size in px with a white edge, to be readable on lines and colours.
pub fn label(
    canvas: &Canvas<'_>,
    label: &str,
    at: (i32, i32),
    (size, color): (f64, Paint),
    side: HPos,
) -> Drawn {
    const EDGE: f64 = 1.2;
    let draw = |(dx, dy): (f64, f64), color| {
        let style = text(size, color, side, VPos::Center);
        canvas.draw(&Text::new(label.to_owned(), (at.0 + px(EDGE * dx), at.1 + px(EDGE * dy)), style))
    };
    for shift in
        [(1.0, 0.0), (-1.0, 0.0), (0.0, 1.0), (0.0, -1.0), (0.7, 0.7), (0.7, -0.7), (-0.7, 0.7), (-0.7, -0.7)]
    {
        draw(shift, PAPER)?;
    }
    draw((0.0, 0.0), color)
}

/// Symbol of a legend entry.
#[derive(Clone, Copy)]
pub enum Symbol {
    /// A curve.
    Line(Paint),
    /// A dashed line.
    Dashed(Paint),
    /// A marker.
    Marker(Marker, Paint),
    /// A marker on a curve.
    MarkedLine(Marker, Paint),
    /// A shaded interval.
    Patch,
    /// Nothing: a remark.
    None,
}

const SYMBOL_WIDTH: f64 = 22.0;
const SYMBOL_GAP: f64 = 7.0;

/// Distance of two rows of a legend, px.
pub const LEGEND_ROW: f64 = 22.0;

/// Legend entries in as many rows as a picture of this width in px needs.
pub fn legend_rows(entries: &[(Symbol, String)], width: f64) -> Vec<&[(Symbol, String)]> {
    let (mut rows, mut first, mut x) = (Vec::new(), 0, LEFT);
    for (i, (_, label)) in entries.iter().enumerate() {
        if i > first && x + entry_width(label) > width {
            rows.push(&entries[first..i]);
            (first, x) = (i, LEFT);
        }
        x += entry_width(label);
    }
    rows.push(&entries[first..]);
    rows
}

fn entry_width(label: &str) -> f64 {
    SYMBOL_WIDTH + SYMBOL_GAP + text_width(label, TEXT) + 18.0
}

/// Draws legend entries in a row that starts at the left margin, centred at height `y` px.
pub fn legend_row(canvas: &Canvas<'_>, y: f64, entries: &[(Symbol, String)]) -> Drawn {
    let mut x = LEFT;
    for (symbol, label) in entries {
        legend_entry(canvas, (x, y), *symbol, label)?;
        x += entry_width(label);
    }
    Ok(())
}

/// Draws one legend entry with its left end at a place in px.
pub fn legend_entry(canvas: &Canvas<'_>, (x, y): (f64, f64), symbol: Symbol, label: &str) -> Drawn {
    let centre = (px(x + 0.5 * SYMBOL_WIDTH), px(y));
    let stroke = |from: f64, to: f64, style: ShapeStyle| {
        canvas.draw(&PathElement::new(vec![(px(x + from), px(y)), (px(x + to), px(y))], style))
    };
    match symbol {
        Symbol::None => {}
        Symbol::Line(color) => stroke(0.0, SYMBOL_WIDTH, line(color, 2.0))?,
        Symbol::Dashed(color) => {
            for k in 0..3 {
                stroke(8.0 * f64::from(k), 8.0 * f64::from(k) + 5.0, line(color, 1.2))?;
            }
        }
        Symbol::Marker(shape, color) => marker(canvas, shape, centre, 5.0, color)?,
        Symbol::MarkedLine(shape, color) => {
            stroke(-3.0, SYMBOL_WIDTH + 3.0, line(color, CURVE))?;
            marker(canvas, shape, centre, 5.0, color)?;
        }
        Symbol::Patch => {
            let corners = [(px(x), px(y - 6.0)), (px(x + SYMBOL_WIDTH), px(y + 6.0))];
            canvas.draw(&Rectangle::new(corners, SHADE.filled()))?;
            canvas.draw(&Rectangle::new(corners, line(FAINT, 0.6)))?;
        }
    }
    let style = text(TEXT, INK, HPos::Left, VPos::Center);
    canvas.draw(&Text::new(label.to_owned(), (px(x + SYMBOL_WIDTH + SYMBOL_GAP), px(y)), style))
}

/// Text as HTML or SVG, also within quotes.
pub fn escaped(text: &str) -> String {
    let mut html = String::with_capacity(text.len());
    for c in text.chars() {
        match c {
            '&' => html.push_str("&amp;"),
            '<' => html.push_str("&lt;"),
            '>' => html.push_str("&gt;"),
            '"' => html.push_str("&quot;"),
            '\'' => html.push_str("&#39;"),
            _ => html.push(c),
        }
    }
    html
}
