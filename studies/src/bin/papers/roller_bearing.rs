//! First paper: the cylindrical roller bearing NU2310.

use crate::folder::Folder;
use cagedyn::Result;
use cagedyn_studies::table::Table;
use std::f64::consts::{PI, TAU};
use std::path::Path;

/// The bottom of the bearing, where the load is.
const BOTTOM: f64 = 1.5 * PI;
/// What the paper states of its slip.
const SLIP: f64 = 0.22;

/// All tables.
///
/// # Errors
/// [`cagedyn::Status::File`].
pub fn tables(folder: &Path) -> Result<Vec<Table>> {
    let settled = Folder::new(&folder.join("nu2310"))?;
    let close = Folder::new(&folder.join("nu2310_5um"))?;
    Ok(vec![
        fig4(&settled)?,
        fig6(&settled)?,
        fig9(folder)?,
        unknowns(folder)?,
        inlet(folder)?,
        fig10(&close)?,
        fig11(&close)?,
    ])
}

fn fig4(run: &Folder) -> Result<Table> {
    let mut table = Table::new("fig4", &["Figs. 4 and 5: 40 um, 4900 N, 3000 rev/min", "paper", "here"]);
    let [y, z] = ["cage.y_ratio", "cage.z_ratio"].map(|name| run.mean(name));
    let (y, z) = (y?, z?);
    let columns = run.columns(&["cage.y_ratio", "cage.z_ratio"])?;
    let far = |i: usize| (columns[1][i] - y).hypot(columns[2][i] - z);
    let last = (0..columns[0].len()).rev().find(|i| far(*i) > 0.25).map_or(0.0, |i| columns[0][i]);
    let deviation = run.number("/statistics/cage.z_ratio/deviation")?;
    table.add(["motion".into(), "moves at the start, then steady with minute vibration".into(), motion(run)]);
    table.add([
        "within a quarter of the clearance of its mean place from, s".into(),
        "before 0.08".into(),
        format!("{last:.3}"),
    ]);
    table.add([
        "mean place (y, z) over the clearance".into(),
        "a picture, upper left".into(),
        format!("({y:.2}, {z:.2})"),
    ]);
    table.add([
        "standard deviation of z over the clearance".into(),
        "minute".into(),
        format!("{deviation:.3}"),
    ]);
    Ok(table)
}

fn motion(run: &Folder) -> String {
    run.find("/whirl/motion").and_then(|x| x.as_str()).unwrap_or("unknown").replace('_', " ")
}

fn fig6(run: &Folder) -> Result<Table> {
    let head = ["Fig. 6: amplitude of the height of the cage", "frequency, Hz", "paper", "here, um"];
    let mut table = Table::new("fig6", &head);
    for (name, paper) in [
        ("f_c", "large; 20 Hz"),
        ("4 f_c", "large"),
        ("8 f_c", "smaller than Z f_c"),
        ("16 f_c", "smaller than Z f_c"),
        ("Z f_c", "especially large; 240 Hz"),
        ("Z f_c - f_c", ""),
        ("Z f_c + f_c", ""),
    ] {
        let (amplitude, frequency) = run.line(name)?;
        table.add([name.into(), format!("{frequency:.1}"), paper.into(), format!("{:.2}", 1e6 * amplitude)]);
    }
    Ok(table)
}

fn fig9(folder: &Path) -> Result<Table> {
    let head = [
        "Fig. 9: clearance, load, speed",
        "y",
        "z",
        "largest slip, %",
        "largest pocket force, N",
        "load zone, deg",
        "power loss, W",
    ];
    let mut table = Table::new("fig9", &head);
    for clearance in ["40um", "5um"] {
        for load in ["980N", "4900N"] {
            for speed in ["1000rpm", "3000rpm", "5000rpm"] {
                let name = format!("{clearance}-{load}-{speed}");
                let run = Folder::new(&folder.join("fig9").join(&name))?;
                let place = |channel: &str| {
                    let deviation = run.number(&format!("/statistics/{channel}/deviation"))?;
                    Ok::<_, cagedyn::Error>(format!("{:+.2} ± {deviation:.2}", run.mean(channel)?))
                };
                table.add([
                    name.replace('-', ", ")
                        .replace("um", " um")
                        .replace('N', " N")
                        .replace("rpm", " rev/min"),
                    place("cage.y_ratio")?,
                    place("cage.z_ratio")?,
                    format!("{:.0}", 100.0 * run.number("/max_roller_slip/value")?),
                    format!("{:.0}", run.number("/pocket_forces/largest_n")?),
                    format!("{:.0}", run.number("/load_zone/extent_rad")?.to_degrees()),
                    format!("{:.0}", run.number("/power_loss/total_w")?),
                ]);
            }
        }
    }
    Ok(table)
}

fn unknowns(folder: &Path) -> Result<Table> {
    let head = [
        "5 um, 4900 N, 3000 rev/min",
        "largest slip, %",
        "less the paper's 22",
        "y",
        "z",
        "driving pocket forces, N",
        "drag torque, N m",
    ];
    let mut table = Table::new("unknowns", &head);
    for (name, what) in [
        ("as-assumed", "as assumed: oil at 35 C, damping 5 % of critical, land 7 mm, straight rollers"),
        ("oil-30C", "oil at 30 C"),
        ("oil-42C", "42 C"),
        ("oil-48C", "48 C"),
        ("oil-55C", "55 C"),
        ("damping-20-percent", "contact damping 20 % of critical"),
        ("damping-1-percent", "1 %"),
        ("damping-half-a-percent", "0.5 %"),
        ("oil-42C-damping-1-percent", "oil at 42 C and damping 1 %"),
        ("land-5mm", "land 5 mm wide"),
        ("land-9mm", "9 mm"),
        ("rolling-resistance-loaded-only", "rolling resistance in loaded contacts only"),
        ("rolling-resistance-rigid-limit", "rolling resistance with the limit of rigid surfaces"),
        ("roughness-0.3um", "roughness of the raceways 0.3 um"),
        ("profile-logarithm-12um", "rollers with a logarithm of 12 um"),
        ("profile-crown-2um", "with a crown of 2 um"),
        ("profile-crown-5um", "with a crown of 5 um"),
    ] {
        let run = Folder::new(&folder.join("unknowns").join(name))?;
        let slip = run.number("/max_roller_slip/value")?;
        table.add([
            what.into(),
            format!("{:.1}", 100.0 * slip),
            format!("{:+.1}", 100.0 * (slip - SLIP)),
            format!("{:+.2}", run.mean("cage.y_ratio")?),
            format!("{:+.2}", run.mean("cage.z_ratio")?),
            format!("{:.1}", run.number("/pocket_forces/driving_n")?),
            format!("{:.3}", run.mean("inner_ring.drag_torque")?),
        ]);
    }
    Ok(table)
}

/// What the drag of the inlet does to slip, which neither paper has.
fn inlet(folder: &Path) -> Result<Table> {
    let head = [
        "4900 N",
        "largest slip without, %",
        "with, %",
        "z of the cage without",
        "with",
        "power loss without, W",
        "with, W",
    ];
    let mut table = Table::new("inlet", &head);
    for clearance in ["40um", "5um"] {
        for speed in ["1000rpm", "3000rpm", "5000rpm"] {
            let run =
                |with: &str| Folder::new(&folder.join("inlet").join(format!("{clearance}-{speed}-{with}")));
            let runs = [run("without")?, run("with")?];
            let [slips, heights, losses] = [
                |run: &Folder| run.number("/max_roller_slip/value").map(|x| format!("{:.1}", 100.0 * x)),
                |run: &Folder| run.mean("cage.z_ratio").map(|x| format!("{x:+.2}")),
                |run: &Folder| run.number("/power_loss/total_w").map(|x| format!("{x:.0}")),
            ]
            .map(|cell| runs.each_ref().map(cell));
            let what = format!("{clearance}, {speed}").replace("um", " um").replace("rpm", " rev/min");
            let ([slip, slip_with], [z, z_with], [loss, loss_with]) = (slips, heights, losses);
            table.add([what, slip?, slip_with?, z?, z_with?, loss?, loss_with?]);
        }
    }
    Ok(table)
}

/// Means of a list over the sectors whose angle before the bottom, in the direction of motion, lies within bounds in rad.
fn mean_between(angles: &[f64], values: &[f64], from: f64, to: f64) -> f64 {
    // The rollers go clockwise: what lies ahead has a smaller angle.
    let ahead = |angle: f64| (BOTTOM - angle + PI).rem_euclid(TAU) - PI;
    let inside = angles.iter().zip(values).filter(|(a, x)| (from..to).contains(&ahead(**a)) && x.is_finite());
    let (sum, count) = inside.fold((0.0, 0.0), |(sum, count), (_, x)| (sum + x, count + 1.0));
    sum / count
}

fn fig10(run: &Folder) -> Result<Table> {
    let mut table = Table::new("fig10", &["Fig. 10: 5 um, 4900 N, 3000 rev/min", "paper", "here"]);
    let [angles, slip] = ["angle_rad", "slip_mean"].map(|name| run.sectors(name));
    let (angles, slip) = (angles?, slip?);
    let half = 0.5 * run.number("/load_zone/extent_rad")?;
    let percent = |x: f64| format!("{:.1}", 100.0 * x);
    table.add(["largest slip, %".into(), "22".into(), percent(run.number("/max_roller_slip/value")?)]);
    table.add([
        "mean slip on leaving the load zone and just before it, %".into(),
        "grows in the unloaded zone".into(),
        format!(
            "{} and {}",
            percent(mean_between(&angles, &slip, half, half + 0.35)),
            percent(mean_between(&angles, &slip, -half - 0.35, -half))
        ),
    ]);
    table.add([
        "mean slip 25 to 45 degrees after the entry of the load zone, %".into(),
        "rapidly at the theoretical speed".into(),
        percent(mean_between(&angles, &slip, -half + 0.43, -half + 0.79)),
    ]);
    let columns: Vec<String> = (0..12)
        .flat_map(|j| ["pocket_position", "inner_force"].map(|what| format!("roller[{j}].{what}")))
        .collect();
    let columns: Vec<&str> = columns.iter().map(String::as_str).collect();
    let series = run.columns(&columns)?;
    let counted = series[0].iter().filter(|t| **t < 0.1).count();
    let (mut back, mut all) = (0.0, 0.0);
    for pair in series[1..].chunks(2) {
        for (place, _) in pair[0].iter().zip(&pair[1]).skip(counted).filter(|(_, load)| **load <= 0.0) {
            back += f64::from(u8::from(*place < 0.0));
            all += 1.0;
        }
    }
    table.add([
        "unloaded rollers in the back half of their pockets, %".into(),
        "towards the back".into(),
        format!("{:.0}", 100.0 * back / all),
    ]);
    Ok(table)
}

fn fig11(run: &Folder) -> Result<Table> {
    let mut table =
        Table::new("fig11", &["Fig. 11: mean pocket force, N (positive drives the cage)", "paper", "here"]);
    let [angles, force] = ["angle_rad", "pocket_force_mean_n"].map(|name| run.sectors(name));
    let (angles, force) = (angles?, force?);
    let half = 0.5 * run.number("/load_zone/extent_rad")?;
    let mean = |from: f64, to: f64| format!("{:.2}", mean_between(&angles, &force, from, to));
    table.add(["first half of the load zone".into(), "none".into(), mean(-half, 0.0)]);
    table.add([
        "second half of the load zone".into(),
        "rollers press forward and accelerate the cage".into(),
        mean(0.0, half),
    ]);
    table.add([
        "of it 20 to 60 degrees behind the bottom".into(),
        String::new(),
        mean((20.0f64).to_radians(), (60.0f64).to_radians()),
    ]);
    table.add(["unloaded zone".into(), "none or braking".into(), mean(half, TAU - half)]);
    table.add([
        "force of the guide on the cage (y, z), mean".into(),
        "supports the cage".into(),
        format!("({:.1}, {:.1})", run.mean("guide.force_y")?, run.mean("guide.force_z")?),
    ]);
    Ok(table)
}
