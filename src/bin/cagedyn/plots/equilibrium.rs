//! An equilibrium: loads, contact angles and pressures around the bearing, or what changes with a number of the scene.

use super::strips::{self, Strip, Texts};
use super::style::{BLUE, ORANGE, Paint, SERIES, Symbol};
use cagedyn::Result;
use cagedyn::equilibrium::Equilibrium;

/// Quantities of contacts that are drawn: name, heading, and what turns SI into its unit.
const DRAWN: [(&str, &str, f64); 4] = [
    ("normal_force", "normal force [N]", 1.0),
    ("contact_angle", "contact angle [deg]", 180.0 / std::f64::consts::PI),
    ("largest_line_load", "largest line load [N/mm]", 1e-3),
    ("largest_pressure", "largest pressure [GPa]", 1e-9),
];

/// What contacts carry, over the azimuth of their elements.
///
/// # Errors
/// [`cagedyn::Status::File`] when it cannot be drawn.
pub fn around(title: &str, found: &Equilibrium) -> Result<String> {
    let azimuth =
        |j: usize| found.elements[j].first().map_or(0.0, |angle| angle.to_degrees().rem_euclid(360.0));
    let mut order: Vec<usize> = (0..found.elements.len()).collect();
    order.sort_by(|a, b| azimuth(*a).total_cmp(&azimuth(*b)));
    let degrees: Vec<f64> = order.iter().map(|j| azimuth(*j)).collect();
    let strip = |(name, heading, scale): (&str, &'static str, f64)| {
        let place = found.contact_quantities.iter().position(|q| q.name == name)?;
        let load = found.contact_quantities.iter().position(|q| q.name == "normal_force")?;
        let curve = |ring: usize, paint: Paint| {
            let value = |j: &usize| {
                let values = &found.contact_values[2 * j + ring];
                // The angle of a contact that carries nothing says nothing.
                if name == "contact_angle" && values[load] == 0.0 { f64::NAN } else { scale * values[place] }
            };
            (paint, order.iter().map(value).collect::<Vec<f64>>())
        };
        Some(Strip { curves: vec![curve(0, BLUE), curve(1, ORANGE)], ..Strip::new(heading) })
    };
    let strips: Vec<Strip<'_>> = DRAWN.into_iter().filter_map(strip).collect();
    let entries =
        vec![(Symbol::Line(BLUE), "outer race".to_owned()), (Symbol::Line(ORANGE), "inner race".to_owned())];
    let texts = Texts {
        title,
        subtitle: "Equilibrium: contacts of the elements around the bearing",
        axis: "azimuth from y, counter-clockwise; 270 is the bottom [deg]",
        step: Some(45.0),
        entries,
    };
    strips::history(&texts, &degrees, &strips, &[])
}

/// Line loads along the rollers that carry most, with either raceway.
///
/// # Errors
/// [`cagedyn::Status::File`] when it cannot be drawn.
pub fn along(title: &str, found: &Equilibrium) -> Result<String> {
    let inner = |j: &usize| found.contact_values[2 * j + 1][0];
    let mut order: Vec<usize> = (0..found.elements.len()).collect();
    order.sort_by(|a, b| inner(b).total_cmp(&inner(a)));
    order.truncate(SERIES.len());
    order.retain(|j| inner(j) > 0.0);
    let strip = |(ring, heading): (usize, &'static str)| {
        let curve = |(j, paint): (&usize, Paint)| {
            let loads = &found.line_loads.values[2 * j + ring];
            (paint, loads.iter().map(|load| 1e-3 * load).collect::<Vec<_>>())
        };
        Strip { curves: order.iter().zip(SERIES).map(curve).collect(), ..Strip::new(heading) }
    };
    let strips = [(0, "outer raceway [N/mm]"), (1, "inner raceway [N/mm]")].map(strip);
    let entry = |(j, paint): (&usize, Paint)| {
        let name = found.contacts[2 * j].split('.').next().unwrap_or_default();
        (
            Symbol::Line(paint),
            format!("{name}, {:.0} deg", found.elements[*j][0].to_degrees().rem_euclid(360.0)),
        )
    };
    let texts = Texts {
        title,
        subtitle: "Equilibrium: load per length along the rollers that carry most",
        axis: "along the roller from its middle [mm]",
        step: None,
        entries: order.iter().zip(SERIES).map(entry).collect(),
    };
    let places: Vec<f64> = found.line_loads.places.iter().map(|place| 1e3 * place).collect();
    strips::history(&texts, &places, &strips, &[])
}

/// Displacement, largest load and stiffness over the numbers that `path` takes; what has no equilibrium is a gap.
///
/// # Errors
/// [`cagedyn::Status::File`] when it cannot be drawn.
pub fn over(title: &str, path: &str, points: &[(f64, Option<&Equilibrium>)]) -> Result<String> {
    let Some(first) = points.iter().find_map(|(_, found)| *found) else { return Ok(String::new()) };
    let n = first.coordinates.len();
    let places: Vec<f64> = points.iter().map(|(x, _)| *x).collect();
    let curve = |value: &dyn Fn(&Equilibrium) -> f64| -> Vec<f64> {
        points.iter().map(|(_, found)| found.map_or(f64::NAN, value)).collect()
    };
    let of_coordinates = |unit: &str, held: bool, value: &dyn Fn(&Equilibrium, usize) -> f64| {
        let these = (0..n).filter(|k| first.coordinates[*k].unit == unit && (held || first.free[*k]));
        these.map(|k| (SERIES[k], curve(&|found| value(found, k)))).collect::<Vec<(Paint, Vec<f64>)>>()
    };
    let strip = |name, curves: Vec<(Paint, Vec<f64>)>| {
        (!curves.is_empty()).then(|| Strip { curves, ..Strip::new(name) })
    };
    let largest = |found: &Equilibrium| {
        found.contact_values.iter().filter_map(|values| values.first()).fold(0.0, |a: f64, b| a.max(*b))
    };
    let strips: Vec<Strip<'_>> = [
        strip("displacement [\u{b5}m]", of_coordinates("m", false, &|found, k| 1e6 * found.displacement[k])),
        strip("tilt [mrad]", of_coordinates("rad", false, &|found, k| 1e3 * found.displacement[k])),
        strip("largest contact force [N]", vec![(BLUE, curve(&largest))]),
        strip(
            "stiffness [N/\u{b5}m]",
            of_coordinates("m", true, &|found, k| 1e-6 * found.stiffness[k * (n + 1)]),
        ),
        strip(
            "tilting stiffness [N m/mrad]",
            of_coordinates("rad", true, &|found, k| 1e-3 * found.stiffness[k * (n + 1)]),
        ),
    ]
    .into_iter()
    .flatten()
    .collect();
    let entries = first.coordinates.iter().enumerate();
    let entries = entries.map(|(k, c)| (Symbol::Line(SERIES[k]), c.name.replace('_', " "))).collect();
    let subtitle = &format!("Equilibrium over {path}");
    let texts = Texts { title, subtitle, axis: path, step: None, entries };
    strips::history(&texts, &places, &strips, &[])
}
