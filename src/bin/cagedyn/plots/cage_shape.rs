//! The cage as seen along the axis, to scale: bars between its pockets. Its height is not of a scene; it is drawn as in the animation of
//! the report.

use super::panel::Panel;
use super::style::{CAGE, CAGE_EDGE, CAGE_RIM, Drawn, THIN, line};
use cagedyn::Model;
use cagedyn::scene::{GuideRing, Pocket};
use std::f64::consts::TAU;

/// Points along the length and the height of a bar.
const ALONG: u32 = 8;

/// Shape and place of a cage; lengths in m.
pub struct CageShape {
    centre: [f64; 2],
    /// Angle of its first pocket, rad.
    angle: f64,
    pockets: usize,
    pitch: f64,
    /// Radii of its surfaces.
    bounds: [f64; 2],
    /// From the middle of a pocket to its wall at the pitch circle.
    wall: f64,
    /// Whether walls are cylinders about the middle of their pocket.
    round: bool,
}

impl CageShape {
    /// Of the cage of a model, if it has one whose place and angle are known.
    pub fn new(model: &Model, [y, z, angle]: [Option<f64>; 3]) -> Option<Self> {
        let scene = model.scene();
        let cage = scene.cage.as_ref()?;
        let (pitch, radius) = (model.pitch_radius(), scene.element_radius());
        let neutral = cage.elastic_ring.as_ref().map(|ring| ring.neutral_radius);
        let middle = neutral.unwrap_or(pitch);
        let surface = cage.guide.as_ref().map(|guide| {
            let inner = guide.ring == GuideRing::InnerRing;
            let play = 0.5 * guide.diametral_clearance;
            (inner, guide.guide_radius + if inner { play } else { -play })
        });
        let half = surface.map_or(0.45 * radius, |(_, surface)| (surface - middle).abs()).max(0.3 * radius);
        let other = half.min(if neutral.is_some() { half } else { 0.4 * radius });
        let bounds = match surface {
            Some((true, surface)) => [surface, surface + half + other],
            Some((false, surface)) => [surface - half - other, surface],
            None => [middle - other, middle + half],
        };
        Some(Self {
            centre: [y?, z?],
            angle: angle? + scene.initial.first_roller_angle,
            pockets: model.element_count(),
            pitch,
            bounds,
            wall: radius + model.pocket_clearance().unwrap_or(0.1 * radius),
            round: matches!(cage.pocket, Some(Pocket::LubricatedCylinder(_))),
        })
    }

    /// A place of the cage in mm.
    fn place(&self, radius: f64, angle: f64) -> (f64, f64) {
        let angle = self.angle + angle;
        let [y, z] = self.centre;
        (1e3 * (y + radius * angle.cos()), 1e3 * (z + radius * angle.sin()))
    }

    /// Angle from the middle of a pocket to its wall at a radius.
    fn to_wall(&self, radius: f64) -> f64 {
        let off = if self.round { (radius - self.pitch).abs().min(self.wall) } else { 0.0 };
        ((self.wall * self.wall - off * off).sqrt() / radius).min(1.0).asin()
    }

    /// Edge of the bar behind pocket `j`.
    fn bar(&self, j: usize) -> Vec<(f64, f64)> {
        let [inside, outside] = self.bounds;
        let pitch = TAU / self.pockets as f64;
        let first = j as f64 * pitch;
        let steps = || (0..=ALONG).map(|i| f64::from(i) / f64::from(ALONG));
        let height = |share: f64| inside + share * (outside - inside);
        let across = |radius: f64, share: f64| {
            let wall = self.to_wall(radius);
            self.place(radius, first + wall + share * (pitch - 2.0 * wall))
        };
        let up = steps().map(|share| across(height(share), 0.0));
        let over = steps().map(|share| across(outside, share));
        let down = steps().map(|share| across(height(1.0 - share), 1.0));
        up.chain(over).chain(down).chain(steps().map(|share| across(inside, 1.0 - share))).collect()
    }
}

/// Draws the rims of the cage, and the bars between its pockets.
pub fn draw(panel: &mut Panel<'_, '_, '_>, cage: &CageShape) -> Drawn {
    let around = |radius: f64| (0..=360).map(move |i| (radius, TAU * f64::from(i) / 360.0));
    let [inside, outside] =
        cage.bounds.map(|radius| around(radius).map(|(r, a)| cage.place(r, a)).collect::<Vec<_>>());
    panel.area(outside.iter().chain(inside.iter().rev()).copied(), CAGE_RIM)?;
    for j in 0..cage.pockets {
        let edge = cage.bar(j);
        panel.area(edge.iter().copied(), CAGE)?;
        panel.curve(edge.iter().chain(edge.first()).copied(), line(CAGE_EDGE, 0.6 * THIN))?;
    }
    [inside, outside].into_iter().try_for_each(|edge| panel.curve(edge, line(CAGE_EDGE, 0.6 * THIN)))
}
