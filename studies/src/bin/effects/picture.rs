//! The picture of the study: cost of every effect beside the change of every result.

use crate::report::Report;
use cagedyn::Result;
use cagedyn_studies::effects::bar::Bar;
use cagedyn_studies::effects::rows::Kind;
use cagedyn_studies::plots::style::{
    self, BLUE, Canvas, Drawn, FAINT, GRID, INK, LEFT, MUTED, ORANGE, PAPER, Paint, TEXT, line, px, text,
    text_width,
};
use plotters::element::{PathElement, Rectangle, Text};
use plotters::style::Color;
use plotters::style::text_anchor::{HPos, VPos};

/// Height of a line, of the headings of a scene, and of everything above the first scene, px.
const LINE: f64 = 21.0;
const HEAD: f64 = 62.0;
const TOP: f64 = 108.0;
/// Places of the bars, and of the first column of changes, px; width of a column and of the numbers beside the bars.
const BARS: [f64; 2] = [350.0, 580.0];
const COLUMNS: f64 = 666.0;
const COLUMN: f64 = 102.0;
/// Size of numbers and headings of columns, px.
const SMALL: f64 = 11.5;
/// Least saving below zero that is told, as a share.
const LEAST: f64 = 0.0005;
/// Distance of the mark of a broken bar from its end, px.
const BREAK: f64 = 24.0;
/// Colours of changes from just beyond scatter on to ten times of it.
const SHADES: [(f64, Paint); 4] = [
    (10.0, Paint(0x7f, 0xa9, 0xd6)),
    (3.0, Paint(0xb3, 0xcd, 0xe8)),
    (1.0, Paint(0xdd, 0xe9, 0xf5)),
    (0.0, PAPER),
];

/// The picture.
///
/// # Errors
/// [`cagedyn::Status::File`] when it cannot be drawn.
pub fn effects(reports: &[Report]) -> Result<String> {
    let columns = reports.iter().map(|report| report.readings.quantities.len()).max().unwrap_or(0);
    let lines: usize = reports.iter().map(|report| report.outcomes.len() - 1).sum();
    let height = TOP + HEAD * reports.len() as f64 + LINE * lines as f64 + 12.0;
    let size = (COLUMNS + COLUMN * columns as f64 + LEFT, height);
    let title = "What each effect costs and what it changes";
    let subtitle = "Left: share of the instructions of a force evaluation. Right: change of the results when the effect \
                    is taken away or added.";
    style::picture(size, title, subtitle, |canvas| {
        legend(canvas)?;
        let mut y = TOP;
        for report in reports {
            scene(canvas, report, y)?;
            y += HEAD + LINE * (report.outcomes.len() - 1) as f64;
        }
        Ok(())
    })
}

fn legend(canvas: &Canvas<'_>) -> Drawn {
    let mut x = LEFT;
    for (color, label) in [(BLUE, "effect of the scene"), (ORANGE, "effect added to the scene")] {
        swatch(canvas, (x, 78.0), color)?;
        label_at(canvas, (x + 26.0, 78.0), label, (TEXT, INK, HPos::Left))?;
        x += 26.0 + text_width(label, TEXT) + 18.0;
    }
    x = COLUMNS;
    for ((_, color), label) in SHADES.iter().rev().zip(["within scatter", "beyond it", "3 times", "10 times"])
    {
        swatch(canvas, (x, 78.0), *color)?;
        label_at(canvas, (x + 26.0, 78.0), label, (SMALL, INK, HPos::Left))?;
        x += 26.0 + text_width(label, SMALL) + 12.0;
    }
    Ok(())
}

fn swatch(canvas: &Canvas<'_>, (x, y): (f64, f64), color: Paint) -> Drawn {
    let corners = [(px(x), px(y - 6.0)), (px(x + 20.0), px(y + 6.0))];
    canvas.draw(&Rectangle::new(corners, color.filled()))?;
    canvas.draw(&Rectangle::new(corners, line(FAINT, 0.6)))
}

fn label_at(canvas: &Canvas<'_>, (x, y): (f64, f64), label: &str, look: (f64, Paint, HPos)) -> Drawn {
    let style = text(look.0, look.1, look.2, VPos::Center);
    canvas.draw(&Text::new(label.to_owned(), (px(x), px(y)), style))
}

/// One scene: headings, then a line per row.
fn scene(canvas: &Canvas<'_>, report: &Report, top: f64) -> Drawn {
    label_at(canvas, (LEFT, top + 20.0), report.study.name, (1.15 * TEXT, INK, HPos::Left))?;
    for (k, quantity) in report.readings.quantities.iter().enumerate() {
        let (name, unit) = quantity.name.split_once(", ").unwrap_or((quantity.name, ""));
        let x = COLUMNS + COLUMN * (k as f64 + 0.5);
        label_at(canvas, (x, top + 12.0), name, (SMALL, INK, HPos::Center))?;
        label_at(canvas, (x, top + 28.0), unit, (SMALL, MUTED, HPos::Center))?;
        if let Some((mean, deviation)) = report.outcomes[0].values[k] {
            let decimals = quantity.decimals;
            let value = format!("{mean:.decimals$} ± {deviation:.decimals$}");
            label_at(canvas, (x, top + 46.0), &value, (SMALL, INK, HPos::Center))?;
        }
    }
    label_at(canvas, (COLUMNS - 8.0, top + 46.0), "unchanged", (SMALL, MUTED, HPos::Right))?;
    for i in 1..report.outcomes.len() {
        row(canvas, report, i, top + HEAD + LINE * (i as f64 - 0.5))?;
    }
    Ok(())
}

fn row(canvas: &Canvas<'_>, report: &Report, i: usize, y: f64) -> Drawn {
    let [left, right] = BARS;
    let ends = vec![(px(LEFT), px(y + 0.5 * LINE)), (px(COLUMNS - 8.0), px(y + 0.5 * LINE))];
    canvas.draw(&PathElement::new(ends, line(GRID, 0.8)))?;
    label_at(canvas, (left - 8.0, y), &report.label(i), (TEXT, INK, HPos::Right))?;
    if let Some(share) = report.instruction_share(i) {
        let added = report.study.rows[i - 1].kind == Kind::Added;
        let cost = if added { share - 1.0 } else { 1.0 - share };
        let bar = Bar::new(cost);
        let width = bar.length * (right - left);
        let corners = [(px(left), px(y - 6.0)), (px(left + width), px(y + 6.0))];
        canvas.draw(&Rectangle::new(corners, if added { ORANGE } else { BLUE }.filled()))?;
        if bar.broken {
            // What is cut out of a bar that would be many times as long.
            for x in [BREAK - 5.0, BREAK + 5.0].map(|x| left + width - x) {
                let ends = vec![(px(x - 4.0), px(y + 8.0)), (px(x + 4.0), px(y - 8.0))];
                canvas.draw(&PathElement::new(ends, line(PAPER, 4.0)))?;
            }
        }
        let number = if cost < -LEAST {
            format!("costs {:.1} % more", -100.0 * cost)
        } else {
            format!("{:.1} %", 100.0 * cost.max(0.0))
        };
        label_at(canvas, (left + width + 6.0, y), &number, (SMALL, INK, HPos::Left))?;
    }
    // What is left of a bearing there has a cost, but a motion that is none of a bearing.
    let empty = report.study.rows[i - 1].kind == Kind::Reference;
    for k in 0..report.readings.quantities.len() {
        let x = COLUMNS + COLUMN * k as f64;
        let change = report.change(i, k).filter(|_| !empty);
        let significance = change.map_or(0.0, |change| change.significance);
        let shade = SHADES.iter().find(|(from, _)| significance >= *from).map_or(PAPER, |(_, color)| *color);
        let corners = [(px(x), px(y - 0.5 * LINE)), (px(x + COLUMN), px(y + 0.5 * LINE))];
        canvas.draw(&Rectangle::new(corners, shade.filled()))?;
        canvas.draw(&Rectangle::new(corners, line(GRID, 0.8)))?;
        let color = if significance >= 1.0 { INK } else { MUTED };
        let change = if empty { "-".to_owned() } else { report.change_text(i, k) };
        label_at(
            canvas,
            (x + 0.5 * COLUMN, y),
            change.trim_matches(['(', ')']),
            (SMALL, color, HPos::Center),
        )?;
    }
    Ok(())
}
