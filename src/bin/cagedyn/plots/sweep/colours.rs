//! The scale of colours of maps: told apart in grey and by colour-blind eyes, as lightness grows evenly with the value.

use super::super::axis::Axis;
use super::super::panel::Place;
use super::super::style::{Canvas, Drawn, INK, MUTED, PAPER, Paint, TEXT, line, px, text};
use plotters::prelude::{Color, FontTransform, Rectangle, Text};
use plotters::style::text_anchor::{HPos, VPos};

/// Width of the scale, px.
const WIDTH: f64 = 14.0;
/// Steps of the scale.
pub const STEPS: usize = 64;
/// Distance of its name from the map, px.
const NAME: f64 = 78.0;

/// Colours from the smallest to the largest value, even in lightness from dark to light.
const COLOURS: [Paint; 6] = [
    Paint(0x1f, 0x2a, 0x5c),
    Paint(0x1f, 0x5f, 0xa6),
    Paint(0x1c, 0x8f, 0x9c),
    Paint(0x58, 0xb3, 0x78),
    Paint(0xb9, 0xcf, 0x5a),
    Paint(0xf7, 0xe8, 0x7d),
];

/// The colour at a share of the scale.
pub fn color(share: f64) -> Paint {
    if !share.is_finite() {
        return PAPER;
    }
    let place = share.clamp(0.0, 1.0) * (COLOURS.len() - 1) as f64;
    let (k, part) = ((place as usize).min(COLOURS.len() - 2), place.fract());
    let part = if place as usize > k { 1.0 } else { part };
    let mixed = |a: u8, b: u8| (f64::from(a) + part * (f64::from(b) - f64::from(a))).round() as u8;
    let (a, b) = (COLOURS[k], COLOURS[k + 1]);
    Paint(mixed(a.0, b.0), mixed(a.1, b.1), mixed(a.2, b.2))
}

/// Draws the scale to the right of a map, with its name if it has one.
pub fn scale(canvas: &Canvas<'_>, place: Place, scale: &Axis) -> Drawn {
    let x = place.x + place.w + 14.0;
    let height = |share: f64| px(place.y + (1.0 - share) * place.h);
    for step in 0..STEPS {
        let [from, to] = [step, step + 1].map(|step| step as f64 / STEPS as f64);
        // Up to the end, so that there are no gaps between steps.
        let corners = [(px(x), height(from)), (px(x + WIDTH), height(1.0))];
        canvas.draw(&Rectangle::new(corners, color(0.5 * (from + to)).filled()))?;
    }
    canvas.draw(&Rectangle::new([(px(x), height(0.0)), (px(x + WIDTH), height(1.0))], line(MUTED, 0.8)))?;
    for tick in scale.ticks() {
        let at = (px(x + WIDTH + 6.0), height((tick - scale.min) / (scale.max - scale.min)));
        let style = text(TEXT - 1.0, INK, HPos::Left, VPos::Center);
        canvas.draw(&Text::new(scale.label(tick), at, style))?;
    }
    let style = text(TEXT, INK, HPos::Center, VPos::Center).transform(FontTransform::Rotate270);
    canvas.draw(&Text::new(scale.name.clone(), (px(place.x + place.w + NAME), height(0.5)), style))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lightness_grows_with_the_value() {
        // Relative luminance of sRGB, and the lightness of CIELAB.
        let linear = |c: u8| {
            let c = f64::from(c) / 255.0;
            if c <= 0.04045 { c / 12.92 } else { ((c + 0.055) / 1.055).powf(2.4) }
        };
        let lightness = |Paint(r, g, b): Paint| {
            116.0 * (0.2126 * linear(r) + 0.7152 * linear(g) + 0.0722 * linear(b)).cbrt() - 16.0
        };
        let all: Vec<f64> = (0..=50).map(|i| lightness(color(f64::from(i) / 50.0))).collect();
        assert!(all.windows(2).all(|pair| (0.5..3.0).contains(&(pair[1] - pair[0]))), "{all:?}");
        assert_eq!(color(f64::NAN), PAPER);
        assert_eq!((color(-1.0), color(2.0)), (COLOURS[0], COLOURS[5]));
    }
}
