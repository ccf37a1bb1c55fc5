//! What elements feel over the angle of their orbit.

use crate::results::finished::Run;
use cagedyn::sim::{LoadZone, OverOrbit};
use serde::{Deserialize, Serialize};

/// Sectors of the orbit: 5 degrees each.
const SECTORS: usize = 72;
/// Records are few where elements pass quickly: sectors of forces are that many of these together.
const TOGETHER: usize = 2;

/// Quantities over the angle of the orbit in the averaging window, of all elements together. What no element was seen at is null.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Sectors {
    /// Middle of each sector, from y counter-clockwise, rad.
    pub angle_rad: Vec<f64>,
    /// Force on the inner ring, mean, N.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub inner_force_mean_n: Vec<Option<f64>>,
    /// Force on the outer ring of balls in space, mean, N.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub outer_force_mean_n: Vec<Option<f64>>,
    /// Contact angle at the inner ring, mean of the loaded contacts, rad.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub inner_angle_mean_rad: Vec<Option<f64>>,
    /// The same at the outer ring.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub outer_angle_mean_rad: Vec<Option<f64>>,
    /// Orbit speed of balls over that of rolling at the free contact angle, mean.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub orbit_ratio_mean: Vec<Option<f64>>,
    /// Slip of rollers, mean.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub slip_mean: Vec<Option<f64>>,
    /// Force on the pocket, mean, N; positive drives the cage.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub pocket_force_mean_n: Vec<Option<f64>>,
    /// 95th percentile of its magnitude, N.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub pocket_force_p95_n: Vec<Option<f64>>,
    /// Its largest magnitude in any step, N.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub pocket_force_peak_n: Vec<Option<f64>>,
    /// Of rollers that move in space.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub rollers_in_space: Option<InSpace>,
    /// Turns of the cage in the run, where they are too few for a mean to say much.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub few_cage_turns: Option<f64>,
}

/// How rollers lie between raceways and ribs over the angle of the orbit.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct InSpace {
    /// Skew, rad.
    pub skew: Scattered,
    /// Tilt, rad.
    pub tilt: Scattered,
    /// Normal forces of ends on ribs and pocket sides by their names, N.
    pub ends: Vec<EndForces>,
}

/// A quantity of either sign.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Scattered {
    /// Mean.
    pub mean: Vec<Option<f64>>,
    /// 5th and 95th percentile.
    pub p05: Vec<Option<f64>>,
    pub p95: Vec<Option<f64>>,
}

impl Scattered {
    fn of(found: &OverOrbit) -> Self {
        let [p05, p95] = [0, 1].map(|k| found.range.iter().map(|range| range[k]).collect::<Vec<f64>>());
        Self { mean: known(&found.mean), p05: known(&p05), p95: known(&p95) }
    }
}

/// Forces of one end of the rollers.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct EndForces {
    /// Of the contact.
    pub name: String,
    /// Mean.
    pub mean_n: Vec<Option<f64>>,
    /// 95th percentile.
    pub p95_n: Vec<Option<f64>>,
}

/// Quantity `field` of all elements over the angle from time `from` (s) on, if the scene records both; where `loaded` is a force that the
/// scene records, too, only while that is above zero.
fn over_orbit(
    run: &Run,
    (field, loaded): (&str, Option<&str>),
    from: f64,
    sectors: usize,
) -> Option<OverOrbit> {
    let kind = run.model.element_kind();
    let first = run.recording.index_at(from);
    let mut samples = Vec::new();
    for j in 0..run.model.element_count() {
        let angles = run.column(&format!("{kind}[{j}].orbit_angle"))?.get(first..)?;
        let name = format!("{kind}[{j}].{field}");
        let values = run.column(&name)?.get(first..)?;
        let force = loaded.and_then(|force| run.column(&format!("{kind}[{j}].{force}"))?.get(first..));
        let intervals = run.intervals(&name).and_then(|x| x.get(first..));
        for (i, (angle, value)) in angles.iter().zip(values).enumerate() {
            if force.is_some_and(|force| force[i] <= 0.0) {
                continue;
            }
            let extreme = intervals.and_then(|x| x.get(i)).map_or(0.0, |x| x.max.max(-x.min));
            samples.push((*angle, *value, extreme));
        }
    }
    Some(OverOrbit::of(samples, sectors))
}

fn known(column: &[f64]) -> Vec<Option<f64>> {
    column.iter().map(|x| x.is_finite().then_some(*x)).collect()
}

/// What rollers in space do, if the scene has them and records their skew and tilt.
fn in_space(run: &Run, from: f64, sectors: usize) -> Option<InSpace> {
    run.model.scene().rollers.as_ref()?.space.as_ref()?;
    let find = |field: &str| over_orbit(run, (field, None), from, sectors);
    let of_first = |name: &String| Some(name.strip_prefix("roller[0].")?.to_owned());
    let names = run.model.contact_names().iter().filter_map(of_first).collect::<Vec<_>>();
    let ends = names.into_iter().filter(|name| name.contains("_rib_") || name.contains("_side_"));
    let ends = ends.filter_map(|name| {
        let found = find(&format!("{name}_force"))?;
        Some(EndForces { name, mean_n: known(&found.mean), p95_n: known(&found.p95) })
    });
    Some(InSpace {
        skew: Scattered::of(&find("skew")?),
        tilt: Scattered::of(&find("tilt")?),
        ends: ends.collect(),
    })
}

/// The table, and where elements carry load.
pub fn of(run: &Run, from: f64) -> (Option<Sectors>, Option<LoadZone>) {
    let find = |field: &str, sectors: usize| over_orbit(run, (field, None), from, sectors);
    let inner = find("inner_force", SECTORS);
    let zone = inner.and_then(|load| load.positive_zone());
    let coarse = SECTORS / TOGETHER;
    let forces = find("pocket_force", coarse);
    let any = forces.clone().or_else(|| find("orbit_ratio", coarse)).or_else(|| find("skew", coarse));
    let Some(any) = any else { return (None, zone) };
    let means = |found: Option<OverOrbit>| found.map_or(Vec::new(), |found| known(&found.mean));
    let mean = |field: &str| means(find(field, coarse));
    let of_balls = |field: &str| if run.model.scene().balls.is_some() { mean(field) } else { Vec::new() };
    let angle = |race: &str| {
        let (field, force) = (format!("{race}_angle"), format!("{race}_force"));
        means(over_orbit(run, (&field, Some(&force)), from, coarse))
    };
    let of_pockets =
        |part: fn(&OverOrbit) -> &Vec<f64>| forces.as_ref().map_or(Vec::new(), |x| known(part(x)));
    let sectors = Sectors {
        angle_rad: (0..coarse).map(|place| any.angle(place)).collect(),
        inner_force_mean_n: mean("inner_force"),
        outer_force_mean_n: of_balls("outer_force"),
        inner_angle_mean_rad: angle("inner"),
        outer_angle_mean_rad: angle("outer"),
        orbit_ratio_mean: of_balls("orbit_ratio"),
        slip_mean: mean("slip"),
        pocket_force_mean_n: of_pockets(|x| &x.mean),
        pocket_force_p95_n: of_pockets(|x| &x.p95),
        pocket_force_peak_n: of_pockets(|x| &x.peak),
        rollers_in_space: in_space(run, from, coarse),
        few_cage_turns: None,
    };
    (Some(sectors), zone)
}
