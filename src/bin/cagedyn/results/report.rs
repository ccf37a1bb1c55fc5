//! The summary that `run` prints.

use crate::results::finished::Run;
use crate::results::summary::{Balance, Statistics, Summary, Whirl, Window};
use crate::results::table::{self, Align, celsius, grouped, number, rounded};
use cagedyn::CageMotion;
use std::borrow::Cow;
use std::path::Path;

/// One result.
pub struct Row {
    /// Name.
    pub name: &'static str,
    /// Mean, or the value itself.
    pub value: String,
    /// Standard deviation and standard error of the mean, of which "?" is not known.
    pub spread: Option<[String; 2]>,
    /// Unit.
    pub unit: &'static str,
    /// Remark.
    pub remark: String,
}

impl Row {
    fn cells(self) -> Vec<String> {
        let spread =
            self.spread.map_or(String::new(), |[deviation, error]| format!("± {deviation} ({error})"));
        vec![self.name.to_owned(), self.value, spread, self.unit.to_owned(), self.remark]
    }
}

struct Rows {
    list: Vec<Row>,
    /// What stands beside every mean, if the run is too short for it.
    few_turns: Option<String>,
}

impl Rows {
    /// A mean with its deviation and its error in another unit, `scale` of it per SI unit. What is zero all the time is left
    /// out.
    fn spread(
        &mut self,
        name: &'static str,
        s: Option<&Statistics>,
        scale: f64,
        unit: &'static str,
        remark: &str,
    ) {
        if let Some(s) = s.filter(|s| (s.spread.min, s.spread.max) != (0.0, 0.0)) {
            let error = match s.spread.stationary {
                true => number(s.spread.standard_error * scale),
                false => "?".to_owned(),
            };
            let spread = Some([number(s.spread.deviation * scale), error]);
            let (value, remark) = (number(s.spread.mean * scale), self.of_mean(remark));
            self.list.push(Row { name, value, spread, unit, remark });
        }
    }

    /// A mean of which nothing else is known.
    fn mean(&mut self, name: &'static str, value: f64, unit: &'static str, remark: &str) {
        self.add(name, number(value), unit, &self.of_mean(remark));
    }

    /// The remark of a mean.
    fn of_mean(&self, remark: &str) -> String {
        let parts = self.few_turns.iter().map(String::as_str).chain([remark]);
        parts.filter(|part| !part.is_empty()).collect::<Vec<_>>().join("; ")
    }

    fn add(&mut self, name: &'static str, value: String, unit: &'static str, remark: &str) {
        self.list.push(Row { name, value, spread: None, unit, remark: remark.to_owned() });
    }
}

/// Title, table of means and deviations, and what was done.
pub fn text(run: &Run, summary: &Summary, folder: &Path) -> String {
    let w = &summary.window;
    let mut text = format!("{}\n{}\n", summary.title, run.facts);
    text.push_str(&format!(
        "mean ± standard deviation (standard error of the mean; ? if still changing) from {} s to {} s ({})\n",
        rounded(w.from_s),
        rounded(w.to_s),
        window(w)
    ));
    if let Some(whirl) = &summary.whirl {
        text.push_str(&format!("cage motion in this time: {}\n", motion(whirl)));
    }
    if let Some(wobble) = &summary.wobble {
        text.push_str(&format!("wobble of its axis: {}\n", motion(wobble)));
    }
    if let Some(starts) = &summary.starts {
        let (shift, spin) = (number(starts.apart.shift_m), number(100.0 * starts.apart.spin_share));
        let apart = format!("{shift} m and up to {spin} % of the cage speed apart");
        text.push_str(&format!("from {} starts {apart}: {}\n", starts.count, starts.in_words()));
    }
    text.push('\n');
    let rows: Vec<_> = results(summary).into_iter().map(Row::cells).collect();
    for line in table::lines(&rows, &[Align::Left, Align::Right]) {
        text.push_str(&format!("  {line}\n"));
    }
    text.push('\n');
    for line in table::lines(&effort(run, summary, folder), &[Align::Left]) {
        text.push_str(&format!("  {line}\n"));
    }
    text
}

/// "200 records, 2.0 turns of the cage".
pub fn window(window: &Window) -> String {
    let turns = window.cage_turns.map(|turns| format!(", {turns:.1} turns of the cage"));
    format!("{} records{}", window.records, turns.unwrap_or_default())
}

/// "backward whirl, 10.4 turns, within 15 % of its speed from 0.024 s on".
pub fn motion(whirl: &Whirl) -> String {
    let name = whirl.motion.name();
    if whirl.intermittent {
        let share = |motion: CageMotion| whirl.share(motion).filter(|share| *share > 0.0);
        let part = |motion: CageMotion| Some(format!("{} {:.0} %", motion.name(), 100.0 * share(motion)?));
        let parts: Vec<String> = CageMotion::ALL.into_iter().filter_map(part).collect();
        return format!("{name}; a whirl comes and goes: {} of the time", parts.join(", "));
    }
    if !whirl.motion.is_whirl() {
        return name.to_owned();
    }
    let settled = match whirl.settling_time_s {
        Some(t) => format!("within 15 % of its speed from {} s on", rounded(t)),
        None => "not settled within 15 % of its speed".to_owned(),
    };
    format!("{name}, {:.1} turns, {settled}", whirl.turns.abs())
}

/// Results in the averaging window.
pub fn results(summary: &Summary) -> Vec<Row> {
    let mut rows = Rows { list: Vec::new(), few_turns: summary.few_turns() };
    let of = |name: &str| summary.of(name);
    if summary.of("cage.y_ratio").is_some() {
        rows.spread("cage centre y", of("cage.y_ratio"), 1.0, "of guide clearance", "");
        rows.spread("cage centre z", of("cage.z_ratio"), 1.0, "of guide clearance", "");
        rows.spread("cage eccentricity", of("cage.eccentricity"), 1.0, "of guide clearance", "");
    } else {
        rows.spread("cage centre y", of("cage.y"), 1e3, "mm", "");
        rows.spread("cage centre z", of("cage.z"), 1e3, "mm", "");
    }
    let frequency = summary.cage_frequency_hz.map(|f| format!("{} Hz", number(f))).unwrap_or_default();
    rows.spread("cage speed", of("cage.speed"), 1.0, "rad/s", &frequency);
    rows.spread("cage slip", of("cage.slip"), 100.0, "%", "");
    let band = |w: &Whirl| {
        Some(format!("5 % to 95 %: {} to {}", number(w.p05_speed_rad_per_s?), number(w.p95_speed_rad_per_s?)))
    };
    let band = summary.whirl.as_ref().and_then(band).unwrap_or_default();
    rows.spread("whirl speed", of("cage.whirl_speed"), 1.0, "rad/s", &band);
    rows.spread("whirl radius", of("cage.whirl_radius"), 1e6, "um", "");
    if let Some(deviation) = summary.whirl.as_ref().and_then(|whirl| whirl.velocity_deviation) {
        let remark = "standard deviation of the speed of the cage centre over its mean";
        rows.mean("velocity deviation", deviation, "", remark);
    }
    rows.spread("film share", of("guide.film_share"), 100.0, "%", "of the guide force");
    let across = "across the line from guide to cage centre";
    rows.spread("guide force, pressure", of("guide.pressure_phi"), 1.0, "N", across);
    rows.spread("guide force, shear", of("guide.shear_phi"), 1.0, "N", across);
    rows.spread("guide force, solid", of("guide.solid_phi"), 1.0, "N", across);
    rows.spread("pocket forces", of("pocket.force_phi"), 1.0, "N", across);
    rows.spread("elements touching", of("pocket.touching_elements"), 1.0, "", "the cage");
    if let Some(slip) = &summary.max_roller_slip {
        let place = format!("of one record: roller {} at {} s", slip.roller, rounded(slip.time_s));
        rows.add("largest roller slip", number(100.0 * slip.value), "%", &place);
    }
    if let Some(zone) = &summary.load_zone {
        let [extent, middle] = [zone.extent_rad, zone.middle_rad].map(|x| number(x.to_degrees()));
        rows.add("load zone", extent, "deg", &format!("around {middle} deg from y"));
    }
    if let Some(forces) = &summary.pocket_forces {
        let remark = "mean over time, all elements together";
        rows.mean("pocket force, driving", forces.driving_n, "N", remark);
        rows.mean("pocket force, braking", forces.braking_n, "N", remark);
        rows.add("pocket force, largest", number(forces.largest_n), "N", "of one element, from every step");
    }
    rows.spread("drag torque", of("inner_ring.drag_torque"), 1.0, "N m", "on the inner ring");
    rows.spread("drag torque, outer", of("outer_ring.drag_torque"), 1.0, "N m", "on the outer ring");
    if let Some(loss) = &summary.power_loss {
        let mut sources: Vec<_> = loss.by_source_w.iter().collect();
        sources.sort_by(|(_, a), (_, b)| b.total_cmp(a));
        let share = |(name, power): &(Cow<'static, str>, f64)| {
            format!("{} {:.0} %", name.replace('_', " "), 100.0 * power / loss.total_w)
        };
        let largest: Vec<_> = sources.into_iter().take(4).map(share).collect();
        rows.mean("power loss", loss.total_w, "W", &largest.join(", "));
    }
    let of_orbit = "of rolling at the free contact angle";
    rows.spread("orbit speed", of("balls.orbit_ratio"), 100.0, "%", of_orbit);
    if let Some(sectors) = &summary.over_orbit {
        let races = [("inner", &sectors.inner_angle_mean_rad), ("outer", &sectors.outer_angle_mean_rad)];
        for (race, angles) in races {
            let degrees = || angles.iter().flatten().map(|angle| angle.to_degrees());
            let (low, high) =
                (degrees().fold(f64::INFINITY, f64::min), degrees().fold(f64::NEG_INFINITY, f64::max));
            if low <= high {
                let range = format!("{} to {}", number(low), number(high));
                rows.add(
                    "contact angle",
                    range,
                    "deg",
                    &format!("{race} race, loaded contacts around the bearing"),
                );
            }
        }
    }
    rows.spread("inner ring x", of("inner_ring.x"), 1e6, "um", "");
    rows.spread("inner ring y", of("inner_ring.y"), 1e6, "um", "");
    rows.spread("inner ring z", of("inner_ring.z"), 1e6, "um", "");
    rows.spread("inner ring tilt y", of("inner_ring.tilt_y"), 1e3, "mrad", "");
    rows.spread("inner ring tilt z", of("inner_ring.tilt_z"), 1e3, "mrad", "");
    for (name, statistics) in &summary.statistics {
        if let Some(lump) = name.strip_prefix("temperature.") {
            let remark = format!("{:.2} °C, {lump}", celsius(statistics.spread.mean));
            rows.spread("temperature", Some(statistics), 1.0, "K", &remark);
        }
    }
    rows.spread("viscosity", of("lubricant.viscosity"), 1e3, "mPa s", "of the lubricant");
    rows.list
}

/// What the integration did and what it took, but for the time: name and text.
pub fn cost(summary: &Summary) -> Vec<(&'static str, String)> {
    let i = &summary.integration;
    let steps = if i.smallest_step_s == i.largest_step_s {
        format!("{} of {} s", grouped(i.steps), number(i.largest_step_s))
    } else {
        format!(
            "{} of {} s to {} s, {} rejected, {} undone",
            grouped(i.steps),
            number(i.smallest_step_s),
            number(i.largest_step_s),
            grouped(i.rejected),
            grouped(i.undone)
        )
    };
    vec![
        ("method", format!("{}, preset {}", i.method.replace('_', "-"), i.preset)),
        ("why", i.report.clone()),
        ("steps", steps),
        ("force evaluations", format!("{}, {} Jacobians", grouped(i.evaluations), grouped(i.jacobians))),
        ("law evaluations", law_evaluations(&i.law_evaluations)),
        ("energy", energy(summary.power_balance.as_ref())),
    ]
}

fn effort(run: &Run, summary: &Summary, folder: &Path) -> Vec<Vec<String>> {
    let time = format!(
        "{} s simulated in {} s wall time (ratio {})",
        rounded(summary.simulated_time_s),
        number(summary.wall_time_s),
        number(summary.simulated_over_wall)
    );
    let mut rows = cost(summary);
    rows.extend([("time", time), ("where it goes", time_shares(&summary.integration.time_shares))]);
    if !run.doubts.is_empty() {
        rows.push(("trusted", format!("NO: {}", run.doubts.join("; "))));
    }
    rows.extend(run.remarks.iter().map(|remark| ("noticed", remark.clone())));
    if run.interrupted {
        rows.push(("ended", "interrupted, results are incomplete".to_owned()));
    } else if run.failure.is_some() {
        rows.push(("ended", "failed, results are incomplete".to_owned()));
    }
    rows.push(("files", format!("{}: {}", folder.display(), summary.files.join(", "))));
    rows.into_iter().map(|(name, value)| vec![name.to_owned(), value]).collect()
}

/// "ring drive +75.1 J, raceway friction -60.2 J; 0.02 % missing", the largest works only.
fn energy(balance: Option<&Balance>) -> String {
    let Some(balance) = balance else { return "forces are undefined at the end".to_owned() };
    let mut works = balance.work_j.clone();
    works.sort_by(|(_, a), (_, b)| b.abs().total_cmp(&a.abs()));
    let works = works.iter().take(4).map(|(name, work)| format!("{} {work:+.3e} J", name.replace('_', " ")));
    let works = works.collect::<Vec<_>>().join(", ");
    format!("{works}; {:+.4} % of what passed through is missing", 100.0 * balance.relative_residual)
}

/// "outer raceway 31 %, guide 5 %, rest 64 %".
fn time_shares(shares: &[(String, f64)]) -> String {
    if shares.is_empty() {
        return "not measured: what was timed after the run does not fit its wall time".to_owned();
    }
    let rest = 1.0 - shares.iter().map(|(_, share)| share).sum::<f64>();
    let parts = shares.iter().map(|(part, share)| (part.replace('_', " "), *share));
    let rest = std::iter::once(("integration, derivatives and records".to_owned(), rest));
    let each = parts.chain(rest).map(|(part, share)| format!("{part} {:.0} %", 100.0 * share));
    each.collect::<Vec<_>>().join(", ")
}

/// "guide film 6 423, pocket plane 5 640".
fn law_evaluations(counts: &[(Cow<'static, str>, u64)]) -> String {
    let each = counts.iter().map(|(law, n)| format!("{} {}", law.replace('_', " "), grouped(*n)));
    if counts.is_empty() { "none".to_owned() } else { each.collect::<Vec<_>>().join(", ") }
}
