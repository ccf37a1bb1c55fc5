//! Slip over the ellipses of the ball that presses the inner ring most, at the end of a run: where it rolls and where it slips.
//!
//! Slip of the ball against the race at x along it and y across it: D_t - w_n y - w_l H and D_l + w_n x + w_t H, H = y^2/(2 R_d) the place of the
//! pressed surface. Where the first vanishes the ball rolls: at most two lines across the ellipse, and with spin one more where it is
//! skewed.

use super::axis::Axis;
use super::panel::{Panel, Place, panel};
use super::style::{
    self, BLUE, Drawn, INK, MUTED, ORANGE, Paint, RED, SHADE, Symbol, TEXT, THIN, line, px, text,
};
use crate::results::finished::Run;
use crate::results::table::{number, rounded};
use cagedyn::Result;
use cagedyn::model::{SPATIAL_CONTACT_QUANTITIES, SpatialContact};
use plotters::prelude::Text;
use plotters::style::text_anchor::{HPos, VPos};
use std::f64::consts::TAU;

/// Races in the order of the contacts of a ball.
const RACES: [&str; 2] = ["outer", "inner"];
/// Width and height of a diagram, px.
const SIZE: (f64, f64) = (760.0, 190.0);
/// Arrows across and along an ellipse, and length of the longest one, px.
const ARROWS: [usize; 2] = [31, 7];
const LONGEST: f64 = 34.0;
/// Places at which the slip along the race is looked at for where it vanishes.
const PLACES: usize = 400;

/// A contact as it is drawn; SI.
struct Ellipse {
    half_axes: [f64; 2],
    slip: [f64; 2],
    turning: [f64; 3],
    pressed_radius: f64,
    says: String,
}

impl Ellipse {
    fn new(name: &'static str, contact: &SpatialContact, pressed_radius: f64) -> Option<Self> {
        let of =
            |name: &str| SPATIAL_CONTACT_QUANTITIES.iter().position(|q| q.name == name).map(|i| contact[i]);
        let half_axes = [of("half_axis_across")?, of("half_axis_along")?];
        let (force, pressure) = (of("normal_force")?, 1e-9 * of("largest_pressure")?);
        let angle = of("contact_angle")?.to_degrees();
        let spin = of("spin_to_roll")?;
        let says = format!(
            "{name} race: {} N, {} GPa, {} deg, spin to roll {}",
            number(force),
            number(pressure),
            number(angle),
            number(spin)
        );
        (half_axes[0] > 0.0).then_some(Self {
            half_axes,
            slip: [of("slip_along")?, of("slip_across")?],
            turning: [of("turning_along")?, of("turning_across")?, of("turning_normal")?],
            pressed_radius,
            says,
        })
    }

    /// Slip along and across the race at x along it and y across it, m/s.
    fn slip(&self, x: f64, y: f64) -> [f64; 2] {
        let ([dt, dl], [wt, wl, wn]) = (self.slip, self.turning);
        let r = self.pressed_radius;
        let height = y * y / (r + (r * r - y * y).max(0.0).sqrt());
        [dt - wn * y - wl * height, dl + wn * x + wt * height]
    }

    /// Half of the ellipse along the race at y across it, m.
    fn half_along(&self, y: f64) -> f64 {
        let [a, b] = self.half_axes;
        b * (1.0 - y * y / (a * a)).max(0.0).sqrt()
    }

    /// Where the ball does not slip along the race: y, m.
    fn rolling(&self) -> Vec<f64> {
        let [a, _] = self.half_axes;
        let at = |i: usize| a * (2.0 * i as f64 / PLACES as f64 - 1.0);
        let slip = |y: f64| self.slip(0.0, y)[0];
        let between = |i: usize| {
            let (from, to) = (at(i), at(i + 1));
            let (before, after) = (slip(from), slip(to));
            (before * after < 0.0).then(|| from + (to - from) * before / (before - after))
        };
        (0..PLACES).filter_map(between).collect()
    }

    fn largest(&self) -> f64 {
        self.places().map(|(x, y)| self.slip(x, y)).fold(0.0, |most: f64, [t, l]| most.max(t.hypot(l)))
    }

    /// Places of the arrows: x along the race, y across it.
    fn places(&self) -> impl Iterator<Item = (f64, f64)> {
        let [across, along] = ARROWS;
        let [a, b] = self.half_axes;
        let share = |i: usize, n: usize| 2.0 * (i as f64 + 0.5) / n as f64 - 1.0;
        let all = (0..across).flat_map(move |i| (0..along).map(move |k| (share(k, along), share(i, across))));
        all.filter(|(u, v)| u * u + v * v < 1.0).map(move |(u, v)| (b * u, a * v))
    }

    fn draw(&self, panel: &mut Panel<'_, '_, '_>, longest: f64) -> Drawn {
        let [a, b] = self.half_axes;
        let edge =
            || (0..=120).map(|i| f64::from(i) * TAU / 120.0).map(|x| (1e3 * a * x.cos(), 1e3 * b * x.sin()));
        panel.area(edge(), SHADE)?;
        panel.curve(edge(), line(INK, THIN))?;
        for y in self.rolling() {
            let half = 1e3 * self.half_along(y);
            panel.curve([(1e3 * y, -half), (1e3 * y, half)], line(RED, 1.6))?;
        }
        for (x, y) in self.places() {
            let [along, across] = self.slip(x, y);
            let paint = if along < 0.0 { ORANGE } else { BLUE };
            arrow(panel, (1e3 * y, 1e3 * x), [across, along].map(|v| v * LONGEST / longest), paint)?;
        }
        Ok(())
    }
}

/// An arrow in the middle of a place, as long as this on the paper, px.
fn arrow(panel: &Panel<'_, '_, '_>, place: (f64, f64), [right, up]: [f64; 2], paint: Paint) -> Drawn {
    let length = right.hypot(up);
    if length < 1.0 {
        return Ok(());
    }
    let (cx, cy) = panel.place(place);
    let scale = f64::from(px(1.0));
    let at = |ahead: f64, aside: f64| {
        let (c, s) = (right / length, up / length);
        let (x, y) = (ahead * c - aside * s, ahead * s + aside * c);
        (cx + (scale * x) as i32, cy - (scale * y) as i32)
    };
    let head = (0.35 * length).min(6.0);
    let canvas = panel.canvas();
    let shaft = vec![at(-0.5 * length, 0.0), at(0.5 * length - head, 0.0)];
    canvas.draw(&plotters::prelude::PathElement::new(shaft, line(paint, 1.1)))?;
    let tip = vec![
        at(0.5 * length, 0.0),
        at(0.5 * length - head, 0.4 * head),
        at(0.5 * length - head, -0.4 * head),
    ];
    canvas.draw(&plotters::prelude::Polygon::new(tip, plotters::style::Color::filled(&paint)))
}

/// The picture, if balls move in space and one presses the inner ring.
pub fn contact_ellipse(run: &Run) -> Option<Result<String>> {
    let scene = run.model.scene();
    let radius = scene.balls.as_ref()?.radius;
    let grooves = [scene.outer_ring.as_ref()?.groove_radius?, scene.inner_ring.as_ref()?.groove_radius?];
    let pairs = run.contacts_in_space.chunks_exact(RACES.len());
    let (ball, pair) = pairs.enumerate().max_by(|(_, x), (_, y)| x[1][0].total_cmp(&y[1][0]))?;
    let of = |k: usize| Ellipse::new(RACES[k], &pair[k], 2.0 * grooves[k] * radius / (grooves[k] + radius));
    let ellipses = [of(0)?, of(1)?];
    let longest = ellipses.iter().map(Ellipse::largest).fold(0.0, f64::max);
    let time = rounded(run.recording.times.get(run.contacts_at).copied()?);
    let subtitle = run.subtitle(&format!("Slip of ball {ball} over its ellipses at {time} s"));
    let height = 120.0 + 2.0 * (SIZE.1 + 90.0);
    Some(style::picture((900.0, height), &run.title, &subtitle, |canvas| {
        let entries = [
            (Symbol::Line(BLUE), format!("slip forwards, {} m/s at most", number(longest))),
            (Symbol::Line(ORANGE), "backwards".to_owned()),
            (Symbol::Line(RED), "no slip along the race: rolling".to_owned()),
        ];
        style::legend_row(canvas, 78.0, &entries)?;
        for (k, ellipse) in ellipses.iter().enumerate() {
            let [a, b] = ellipse.half_axes.map(|x| 1.1e3 * x);
            let axis = |name: &str, half: f64| Axis::new(name, -half, half, 5);
            let (x_axis, y_axis) = (axis("across the race [mm]", a), axis("along it [mm]", b));
            let top = 130.0 + k as f64 * (SIZE.1 + 90.0);
            let style = text(TEXT, MUTED, HPos::Left, VPos::Center);
            canvas.draw(&Text::new(ellipse.says.clone(), (px(100.0), px(top - 16.0)), style))?;
            let place = Place { x: 100.0, y: top, w: SIZE.0, h: SIZE.1 };
            panel(canvas, place, (&x_axis, &y_axis), true, &[], |panel| ellipse.draw(panel, longest))?;
        }
        Ok(())
    }))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_ball_without_spin_rolls_on_two_lines() {
        let ellipse = |turning: [f64; 3]| Ellipse {
            half_axes: [2e-3, 2e-4],
            slip: [1e-6 * -2000.0 / (2.0 * 1e-2), 0.0],
            turning,
            pressed_radius: 1e-2,
            says: String::new(),
        };
        // D_t = w_l y^2/(2 R_d) at a millimetre.
        let lines = ellipse([0.0, -2000.0, 0.0]).rolling();
        assert_eq!(lines.len(), 2);
        assert!(lines.iter().all(|y| (y.abs() - 1e-3).abs() < 1e-5), "{lines:?}");
        let spinning = ellipse([0.0, -2000.0, 500.0]).rolling();
        assert_eq!(spinning.len(), 1, "{spinning:?}");
    }
}
