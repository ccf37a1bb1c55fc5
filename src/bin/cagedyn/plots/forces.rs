//! The bearing with the forces of its contacts where that on a pocket is largest (compare Fig. 11).

use super::axis::Axis;
use super::cage_shape::{self, CageShape};
use super::panel::{HEAD, Panel, Place, panel};
use super::style::{self, Drawn, GREEN, INK, METAL, MUTED, PURPLE, Paint, RED, Symbol, THIN, line};
use crate::results::finished::Run;
use crate::results::table::{number, rounded};
use cagedyn::Result;
use cagedyn::model::{CONTACT_QUANTITIES, ContactForces};
use std::f64::consts::TAU;

/// Side of the diagram, px.
const SIDE: f64 = 600.0;
/// Length of the longest arrow on a raceway in units of the diameter of an element, so that those on both raceways stay apart, and of
/// the longest one on the cage in units of the pitch radius.
const ON_RACEWAYS: f64 = 0.45;
const ON_CAGE: f64 = 0.4;
const ON_CAGE_NAME: &str = "elements on cage";
/// Arrows shorter than this are not seen, in units of the pitch radius.
const SHORTEST: f64 = 0.004;
/// Radius of the arrow that tells which way the elements go, in units of the pitch radius.
const TURNING: f64 = 0.16;

/// A force at a place, N and m.
struct Arrow {
    at: [f64; 2],
    force: [f64; 2],
}

/// What forces of one kind act on; all forces on one body have one scale, since they may balance each other.
#[derive(Clone, Copy, PartialEq)]
enum Body {
    Raceways,
    Cage,
}

/// Forces of one kind.
struct Kind {
    name: &'static str,
    body: Body,
    paint: Paint,
    arrows: Vec<Arrow>,
}

impl Kind {
    fn new(name: &'static str, body: Body, paint: Paint) -> Self {
        Self { name, body, paint, arrows: Vec::new() }
    }

    fn largest(&self) -> f64 {
        self.arrows.iter().map(|arrow| arrow.force[0].hypot(arrow.force[1])).fold(0.0, f64::max)
    }
}

/// The picture, if there are elements whose contacts bear something.
pub fn contact_forces(run: &Run) -> Option<Result<String>> {
    let geometry = run.model.geometry();
    let length = |name: &str| geometry.iter().find(|(q, _)| q.name == name).map(|(_, value)| *value);
    let (pitch, radius) = (length("pitch_radius")?, length("element_radius")?);
    let mut kinds = vec![
        // As in the animation of the report.
        Kind::new("elements on raceways", Body::Raceways, RED),
        Kind::new(ON_CAGE_NAME, Body::Cage, PURPLE),
        Kind::new("guide on cage", Body::Cage, GREEN),
    ];
    for (name, contact) in run.model.contact_names().iter().zip(&run.contacts) {
        if let Some(arrow) = arrow(contact) {
            kinds[usize::from(!name.ends_with("_raceway"))].arrows.push(arrow);
        }
    }
    let then = |name: &str| run.column(name)?.get(run.contacts_at).copied();
    if let (Some(y), Some(z)) = (then("guide.force_y"), then("guide.force_z")) {
        let at = ["cage.y", "cage.z"].map(|name| then(name).unwrap_or(0.0));
        kinds[2].arrows.push(Arrow { at, force: [y, z] });
    }
    kinds.retain(|kind| kind.largest() > 0.0);
    if kinds.is_empty() {
        return None;
    }
    let kind = run.model.element_kind();
    let angles = (0..run.model.element_count()).map(|j| then(&format!("{kind}[{j}].orbit_angle")));
    let angles: Vec<f64> = angles.collect::<Option<_>>()?;
    let circles = ["outer_raceway_radius", "inner_raceway_radius"].map(length);
    let longest = |body| match body {
        Body::Raceways => ON_RACEWAYS * 2.0 * radius,
        Body::Cage => ON_CAGE * pitch,
    };
    let scale = |body| {
        let largest = kinds.iter().filter(|kind| kind.body == body).map(Kind::largest).fold(0.0, f64::max);
        longest(body) / largest
    };
    let reach = pitch + radius + 1.1 * longest(Body::Raceways);
    let axis = |name| Axis::new(name, -1e3 * reach, 1e3 * reach, 5);
    let (x_axis, y_axis) = (axis("y [mm]"), axis("z [mm]"));
    let place = Place { x: 100.0, y: 122.0, w: SIDE, h: SIDE };
    let cage = CageShape::new(&run.model, ["cage.y", "cage.z", "cage.angle"].map(then));
    let time = rounded(run.recording.times.get(run.contacts_at).copied()?);
    let when = match kinds.iter().any(|kind| kind.name == ON_CAGE_NAME) {
        true => format!("Forces at {time} s, when that on a pocket is largest"),
        false => format!("Forces at {time} s; none on a pocket in the window"),
    };
    let subtitle = run.subtitle(&when);
    Some(style::picture((730.0, 790.0), &run.title, &subtitle, |canvas| {
        let entries: Vec<_> = kinds
            .iter()
            .map(|kind| {
                (Symbol::Line(kind.paint), format!("{}, largest {} N", kind.name, number(kind.largest())))
            })
            .collect();
        style::legend_row(canvas, 76.0, &entries[..entries.len().min(2)])?;
        let note = match cage {
            Some(_) => "raceways and cage have a scale each; its height is not known",
            None => "raceways and cage have a scale each",
        };
        let note = (Symbol::None, note.to_owned());
        let second: Vec<_> = entries.iter().skip(2).cloned().chain([note]).collect();
        style::legend_row(canvas, 100.0, &second)?;
        panel(canvas, place, (&x_axis, &y_axis), true, &[], |panel| {
            for radius in circles.into_iter().flatten() {
                panel.circle(1e3 * radius, line(MUTED, THIN))?;
            }
            if let Some(cage) = &cage {
                cage_shape::draw(panel, cage)?;
            }
            for angle in &angles {
                let edge: Vec<_> = circle([pitch * angle.cos(), pitch * angle.sin()], radius).collect();
                panel.area(edge.iter().copied(), METAL)?;
                panel.curve(edge, line(MUTED, THIN))?;
            }
            panel.circle(1e3 * SHORTEST * pitch, line(INK, THIN))?;
            if let Some(way) = run.direction() {
                panel.turning(1e3 * TURNING * pitch, way, (1e3 * pitch, MUTED))?;
            }
            for kind in &kinds {
                let scale = scale(kind.body);
                kind.arrows.iter().try_for_each(|arrow| draw(panel, arrow, (scale, pitch), kind.paint))?;
            }
            Ok(())
        })
    }))
}

/// Force of an element on its mate; none where the surfaces are apart.
fn arrow(contact: &ContactForces) -> Option<Arrow> {
    let of = |name: &str| CONTACT_QUANTITIES.iter().position(|q| q.name == name).map_or(0.0, |i| contact[i]);
    let (normal, n) = (of("normal_force"), [of("normal_y"), of("normal_z")]);
    if normal <= 0.0 {
        return None;
    }
    let t = [-n[1], n[0]];
    let along = of("rolling_resistance") + of("film_pressure_mate") - of("friction");
    let force = [0, 1].map(|k| normal * n[k] + along * t[k]);
    Some(Arrow { at: [of("point_y"), of("point_z")], force })
}

/// Points of a circle, mm.
fn circle(centre: [f64; 2], radius: f64) -> impl Iterator<Item = (f64, f64)> {
    let angles = (0..=60).map(|i| f64::from(i) * TAU / 60.0);
    angles.map(move |a| (1e3 * (centre[0] + radius * a.cos()), 1e3 * (centre[1] + radius * a.sin())))
}

/// An arrow that begins where the force acts.
fn draw(panel: &mut Panel<'_, '_, '_>, arrow: &Arrow, (scale, pitch): (f64, f64), paint: Paint) -> Drawn {
    let size = scale * arrow.force[0].hypot(arrow.force[1]);
    if size < SHORTEST * pitch {
        return Ok(());
    }
    let along = arrow.force.map(|x| scale * x / size);
    let (length, half) = (pitch * HEAD.0, pitch * HEAD.1);
    let point = |ahead: f64, aside: f64| {
        let y = arrow.at[0] + ahead * along[0] - aside * along[1];
        let z = arrow.at[1] + ahead * along[1] + aside * along[0];
        (1e3 * y, 1e3 * z)
    };
    let neck = (size - length).max(0.0);
    panel.curve([point(0.0, 0.0), point(neck, 0.0)], line(paint, 1.8))?;
    panel.area([point(size, 0.0), point(neck, half), point(neck, -half)], paint)
}
