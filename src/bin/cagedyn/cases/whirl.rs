//! Comparison of cases whose elements have a prescribed motion: whether and how the cage whirls.

use super::series::series;
use super::{Comparison, Done};
use crate::plots::{self, WhirlPoint};
use crate::summary::Whirl;
use crate::table::rounded;
use cagedyn::Result;

/// The comparison.
pub const WHIRL: Comparison =
    Comparison { columns: &COLUMNS, row, csv_rows, picture_name: "whirl_speed.svg", picture };

/// Columns of the printed table: heading, narrowest width.
const COLUMNS: [(&str, usize); 9] = [
    ("case", 4),
    ("whirl [rad/s]", 13),
    ("5 %", 9),
    ("95 %", 9),
    ("radius [um]", 11),
    ("motion", 14),
    ("settled [s]", 11),
    ("wall time [s]", 13),
    ("", 0),
];

/// Channels whose means are in the file.
const CHANNELS: [&str; 9] = [
    "cage.y_ratio",
    "cage.z_ratio",
    "cage.eccentricity",
    "cage.speed",
    "cage.slip",
    "guide.film_share",
    "guide.minimum_film",
    "pocket.touching_elements",
    "lubricant.viscosity",
];

fn row(done: &Done<'_>) -> Vec<String> {
    let whirl = done.summary.whirl.as_ref();
    let cell = |text: &dyn Fn(&Whirl) -> String| whirl.map_or("-".to_owned(), text);
    vec![
        done.case.name.clone(),
        cell(&|w| format!("{:.1}", w.mean_speed_rad_per_s)),
        cell(&|w| format!("{:.1}", w.p05_speed_rad_per_s)),
        cell(&|w| format!("{:.1}", w.p95_speed_rad_per_s)),
        cell(&|w| format!("{:.2}", 1e6 * w.mean_radius_m)),
        cell(&|w| w.motion.name().to_owned()),
        cell(&|w| settled(w).map_or("-".to_owned(), |t| format!("{t:.4}"))),
        format!("{:.2}", done.summary.wall_time_s),
        done.state().to_owned(),
    ]
}

/// Settling time of a whirl, s; that of other motions says nothing.
fn settled(whirl: &Whirl) -> Option<f64> {
    whirl.settling_time_s.filter(|_| whirl.motion.is_whirl()).map(rounded)
}

fn csv_rows(done: &[Done<'_>]) -> Vec<Vec<String>> {
    let unit = |name: &str| done.iter().find_map(|d| d.summary.of(name)).map_or("1", |s| s.unit);
    let mut head: Vec<String> = [
        "case",
        "inner ring speed [1/min]",
        "whirl speed mean [rad/s]",
        "whirl speed 5 % [rad/s]",
        "whirl speed 95 % [rad/s]",
        "whirl radius mean [m]",
        "turns [1]",
        "motion",
        "settling time [s]",
    ]
    .map(str::to_owned)
    .to_vec();
    head.extend(CHANNELS.iter().map(|name| format!("{name} mean [{}]", unit(name))));
    head.extend(["simulated time [s]", "wall time [s]", "complete"].map(str::to_owned));
    std::iter::once(head).chain(done.iter().map(csv_row)).collect()
}

fn csv_row(done: &Done<'_>) -> Vec<String> {
    let s = &done.summary;
    let number = |x: Option<f64>| x.map_or(String::new(), |x| format!("{x:?}"));
    let whirl = |value: &dyn Fn(&Whirl) -> f64| number(s.whirl.as_ref().map(value));
    let mut row = vec![
        done.case.name.clone(),
        rounded(done.speed).to_string(),
        whirl(&|w| w.mean_speed_rad_per_s),
        whirl(&|w| w.p05_speed_rad_per_s),
        whirl(&|w| w.p95_speed_rad_per_s),
        whirl(&|w| w.mean_radius_m),
        whirl(&|w| w.turns),
        s.whirl.as_ref().map_or(String::new(), |w| w.motion.name().to_owned()),
        number(s.whirl.as_ref().and_then(settled)),
    ];
    row.extend(CHANNELS.iter().map(|name| number(s.of(name).map(|s| s.spread.mean))));
    row.push(format!("{:?}", s.simulated_time_s));
    row.push(format!("{:.3}", s.wall_time_s));
    row.push(done.state().is_empty().to_string());
    row
}

/// Whirl over speed, if the cases have more than one speed.
fn picture(title: &str, done: &[Done<'_>]) -> Option<Result<String>> {
    let series = series(done, point);
    let mut speeds = series.iter().flat_map(|s| &s.points).map(|p| p.speed);
    let first = speeds.next()?;
    speeds.any(|speed| speed != first).then(|| plots::whirl_speed(title, &series))
}

fn point(d: &Done<'_>) -> Option<WhirlPoint> {
    let w = d.summary.whirl.as_ref()?;
    Some(WhirlPoint {
        speed: d.speed,
        mean: w.mean_speed_rad_per_s,
        band: [w.p05_speed_rad_per_s, w.p95_speed_rad_per_s],
        whirls: w.motion.is_whirl(),
    })
}
