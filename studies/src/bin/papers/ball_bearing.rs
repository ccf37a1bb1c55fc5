//! Second paper: the greased cage guide of an angular contact ball bearing.

use crate::folder::Folder;
use cagedyn::Result;
use cagedyn_studies::table::Table;
use serde_json::Value;
use std::path::Path;

/// The whirl is told to be steady from where its speed stays within this share of its mean in the window, beside the share of the
/// summary.
const NARROW: f64 = 0.05;
/// Forces are smoothed over this time, s.
const SMOOTHED: f64 = 1e-3;

/// All tables.
///
/// # Errors
/// [`cagedyn::Status::File`].
pub fn tables(folder: &Path) -> Result<Vec<Table>> {
    let greased = Folder::new(&folder.join("grease"))?;
    Ok(vec![fig8(&greased)?, forces(&greased)?, fig11(folder)?, dry(folder, &greased)?])
}

fn fig8(run: &Folder) -> Result<Table> {
    let mut table = Table::new("second fig8", &["Fig. 8: 3000 rev/min, 313 K", "paper", "here"]);
    let [mean, low, high] =
        ["mean", "p05", "p95"].map(|part| run.number(&format!("/whirl/{part}_speed_rad_per_s")));
    let mean = mean?;
    table.add([
        format!("whirl speed, mean from {} ms on, rad/s (5 to 95 %)", window(run)?),
        "negative, steady; 1.2 to 2.3 times the measured".into(),
        format!("{mean:.0} ({:.0} to {:.0})", low?, high?),
    ]);
    let columns = run.columns(&["cage.whirl_speed"])?;
    let (times, speeds) = (&columns[0], &columns[1]);
    let last = speeds.iter().rposition(|x| (x / mean - 1.0).abs() > NARROW);
    let within = times.get(last.map_or(0, |i| i + 1));
    let ms = |t: Option<f64>| t.map_or("never".to_owned(), |t| format!("{:.1}", 1e3 * t));
    table.add([
        "whirl speed within 15 % of this mean from, ms".into(),
        "steady from 25".into(),
        ms(run.number("/whirl/settling_time_s").ok()),
    ]);
    table.add(["within 5 % from, ms".into(), String::new(), ms(within.copied())]);
    table.add([
        "mean eccentricity over the clearance".into(),
        "within the guide clearance".into(),
        format!("{:.2}", run.mean("cage.eccentricity")?),
    ]);
    table.add([
        "starts that lead to it".into(),
        String::new(),
        format!("{} of {}", kind(run, "backward_whirl").0, run.number("/starts/count")?),
    ]);
    Ok(table)
}

/// Where the averaging window of a run begins, ms.
fn window(run: &Folder) -> Result<String> {
    Ok(format!("{:.1}", 1e3 * run.number("/window/from_s")?))
}

/// How many starts lead to a motion, and the range of their mean whirl speeds, rad/s.
fn kind(run: &Folder, motion: &str) -> (u64, Option<[f64; 2]>) {
    let kinds = run.find("/starts/motions").and_then(Value::as_array);
    let found = kinds.and_then(|kinds| kinds.iter().find(|kind| kind["motion"] == motion));
    let range = found.and_then(|kind| {
        let range = kind.get("mean_speed_rad_per_s")?;
        Some([range[0].as_f64()?, range[1].as_f64()?])
    });
    (found.and_then(|kind| kind["count"].as_u64()).unwrap_or(0), range)
}

/// Means over the time before each record, s.
fn smoothed(times: &[f64], values: &[f64]) -> Vec<f64> {
    let mean = |i: usize| {
        let from = times.partition_point(|t| *t <= times[i] - SMOOTHED);
        values[from..=i].iter().sum::<f64>() / (i + 1 - from) as f64
    };
    (0..times.len()).map(mean).collect()
}

fn forces(run: &Folder) -> Result<Table> {
    let head = ["Figs. 9 and 10: force across the line of centres, N", "paper", "here"];
    let mut table = Table::new("second fig9", &head);
    let names = ["guide.pressure_phi", "guide.shear_phi", "pocket.force_phi"];
    let columns = run.columns(&names)?;
    let (times, [pressure, shear, _]) = (&columns[0], [&columns[1], &columns[2], &columns[3]]);
    // The window of the whirl speed.
    let from = run.number("/window/from_s")?;
    let steady = times.partition_point(|t| *t < from);
    let mean = |values: &[f64]| values.iter().sum::<f64>() / values.len() as f64;
    let [p, s, pockets] = [1, 2, 3].map(|k| mean(&columns[k][steady..]));
    let half = |values: &[f64], mean: f64| {
        let smooth = smoothed(times, values);
        let found = smooth.iter().position(|x| x / mean > 0.5);
        found.map_or("never".to_owned(), |i| format!("{:.1}", 1e3 * times[i]))
    };
    table.add([
        format!("pressure of the film, mean from {} ms on", window(run)?),
        "drives a positive whirl".into(),
        format!("{p:+.3}"),
    ]);
    table.add(["shear of the film".into(), "drives a negative whirl".into(), format!("{s:+.3}")]);
    table.add(["both".into(), "marginally negative".into(), format!("{:+.3}", p + s)]);
    table.add(["pockets".into(), "positive, balances the guide".into(), format!("{pockets:+.3}")]);
    table.add([
        "half of its steady mean is reached by shear at, ms".into(),
        "rises earlier".into(),
        half(shear, s),
    ]);
    table.add(["by pressure at, ms".into(), String::new(), half(pressure, p)]);
    Ok(table)
}

fn fig11(folder: &Path) -> Result<Table> {
    let head = [
        "Fig. 11: speed, rev/min",
        "313 K: whirl, rad/s (5 to 95 %)",
        "starts that whirl, of 24",
        "warming: whirl, rad/s (5 to 95 %)",
        "starts that whirl, of 24",
    ];
    let mut table = Table::new("second fig11", &head);
    for speed in ["100", "300", "500", "800", "1000", "1100", "1300", "2000", "3000", "5000", "8000"] {
        let cells = |kind_of: &str| {
            let run = Folder::new(&folder.join("grease_speed").join(format!("{kind_of}-{speed}rpm")))?;
            let (count, range) = kind(&run, "backward_whirl");
            let motion = run.find("/whirl/motion").and_then(Value::as_str).unwrap_or_default();
            let whirls = motion == "backward_whirl";
            let part = |part: &str| run.number(&format!("/whirl/{part}_speed_rad_per_s"));
            let whirl = match range {
                _ if whirls => format!("{:.0} ({:.0} to {:.0})", part("mean")?, part("p05")?, part("p95")?),
                Some([low, high]) => format!("{}; others {low:.0} to {high:.0}", motion.replace('_', " ")),
                None => motion.replace('_', " "),
            };
            Ok::<_, cagedyn::Error>([whirl, count.to_string()])
        };
        let ([cold, of_cold], [warm, of_warm]) = (cells("313K")?, cells("warming")?);
        table.add([speed.into(), cold, of_cold, warm, of_warm]);
    }
    Ok(table)
}

fn dry(folder: &Path, greased: &Folder) -> Result<Table> {
    let reference = greased.number("/whirl/mean_speed_rad_per_s")?;
    let times = format!("times the {reference:.0} of the greased guide");
    let head = [
        "solid contact only, 3000 rev/min: friction coefficient",
        "starts with backward whirl, of 24",
        "their whirl, rad/s",
        times.as_str(),
    ];
    let mut table = Table::new("second dry", &head);
    for friction in ["0.1", "0.5", "0.55", "0.6", "0.65", "0.7", "0.8", "1.0"] {
        let run = Folder::new(&folder.join("grease_dry").join(format!("friction-{friction}")))?;
        let (count, range) = kind(&run, "backward_whirl");
        let none = || ("-".to_owned(), "-".to_owned());
        let (speeds, ratio) = range.map_or_else(none, |[low, high]| {
            let span =
                |texts: [String; 2]| if texts[0] == texts[1] { texts[0].clone() } else { texts.join(" to ") };
            let of = |digits: usize, scale: f64| span([low, high].map(|x| format!("{:.digits$}", x / scale)));
            (of(0, 1.0), of(1, reference))
        });
        table.add([friction.into(), count.to_string(), speeds, ratio]);
    }
    Ok(table)
}
