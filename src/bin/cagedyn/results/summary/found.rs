//! What a run found, as it stands in its summary.

use super::{Balance, Extremes, Integration, Name, PocketForces, PowerLoss, RollerSlip, Statistics, Window};
use crate::results::finished::Run;
use cagedyn::model::{Channel, FAULTS, LAWS, PARTS, POWERS, PartTimes};
use cagedyn::sim::PowerBalance;
use cagedyn::{Interval, Recording, Spread};
use std::f64::consts::TAU;

/// Channel whose statistics leave out what is near the centre of the guide.
const WHIRL_SPEED: &str = "cage.whirl_speed";

/// Statistics of every channel of cage, guide and rings, and of the slip of every roller; not of the other channels
/// that every element has.
pub(super) fn key_statistics(
    channels: &[Channel],
    recording: &Recording,
    (from, few_cage_turns): (f64, Option<f64>),
    whirl_speed: Option<Spread>,
) -> Vec<(String, Statistics)> {
    let of_element = |name: &str| name.starts_with("roller[") || name.starts_with("element[");
    let key = |name: &str| !of_element(name) || name.ends_with("].slip");
    let columns = channels.iter().enumerate().filter(|(_, c)| key(&c.name));
    columns
        .filter_map(|(i, c)| {
            let spread = match c.name.as_str() {
                WHIRL_SPEED => whirl_speed?,
                _ => recording.spread(i, from)?,
            };
            Some((c.name.clone(), Statistics { unit: c.unit.into(), few_cage_turns, spread }))
        })
        .collect()
}

/// Parts that the scene has, with their shares of the wall time; none where they were not measured.
fn time_shares(run: &Run) -> Vec<(String, f64)> {
    shares_of(run.parts, run.statistics.evaluations as f64, run.wall)
}

/// Shares of the wall time of parts that took so long in each evaluation. They are timed after the run: where they make more than
/// the whole of it, the machine was busier then, or the states that they were timed at are not those that took the time.
fn shares_of(parts: PartTimes, evaluations: f64, wall: f64) -> Vec<(String, f64)> {
    if evaluations * parts.iter().sum::<f64>() > wall {
        return Vec::new();
    }
    let shares = PARTS.iter().zip(parts).filter(|(_, time)| *time > 0.0);
    shares.map(|(name, time)| ((*name).to_owned(), evaluations * time / wall)).collect()
}

pub(super) fn balance(b: &PowerBalance) -> Balance {
    let [kinetic_energy_gain_j, elastic_energy_gain_j, potential_energy_gain_j] = b.gain();
    Balance {
        from_s: b.from,
        to_s: b.to,
        work_j: named(POWERS.into_iter().zip(b.work).filter(|(_, work)| *work != 0.0)),
        kinetic_energy_gain_j,
        elastic_energy_gain_j,
        potential_energy_gain_j,
        residual_j: b.residual(),
        relative_residual: b.relative_residual(),
    }
}

/// Sources that are no loss: what drives the bearing, and loads, which give back what they take.
fn drives(name: &str) -> bool {
    matches!(name, "loads" | "ring_drive" | "outer_ring_drive" | "element_drive")
}

pub(super) fn power_loss(run: &Run, few_cage_turns: Option<f64>) -> Option<PowerLoss> {
    let (from, before) = run.before?;
    let time = run.time - from;
    if time <= 0.0 {
        return None;
    }
    let powers =
        POWERS.into_iter().zip(run.works).zip(before).map(|((name, now), then)| (name, (then - now) / time));
    let losses: Vec<_> = powers.filter(|(name, power)| *power > 0.0 && !drives(name)).collect();
    let total_w = losses.iter().map(|(_, power)| power).sum();
    Some(PowerLoss { total_w, by_source_w: named(losses.into_iter()), few_cage_turns })
}

/// The pairs with their names as those that were read are.
fn named<T>(pairs: impl Iterator<Item = (&'static str, T)>) -> Vec<(Name, T)> {
    pairs.map(|(name, value)| (name.into(), value)).collect()
}

pub(super) fn integration(run: &Run) -> Integration {
    let driver = &run.statistics.driver;
    Integration {
        preset: run.model.scene().solver.preset.name().into(),
        method: run.model.scene().solver.method.name().into(),
        report: run.report.clone(),
        steps: driver.steps,
        rejected: driver.rejected,
        undone: driver.undone,
        faults: driver.faults,
        faults_by_cause: named(FAULTS.into_iter().zip(run.statistics.faults).filter(|(_, n)| *n > 0)),
        raceway_vibration_rms: driver.vibration.rms(),
        events: driver.events,
        smallest_step_s: driver.smallest_step,
        largest_step_s: driver.largest_step,
        evaluations: run.statistics.evaluations,
        jacobians: run.statistics.jacobians,
        time_shares: time_shares(run),
        law_evaluations: named(LAWS.into_iter().zip(run.statistics.laws).filter(|(_, n)| *n > 0)),
    }
}

pub(super) fn window(run: &Run, from: f64) -> Window {
    let times = run.recording.times.get(run.recording.index_at(from)..).unwrap_or_default();
    Window {
        from_s: times.first().copied().unwrap_or(0.0),
        to_s: times.last().copied().unwrap_or(0.0),
        records: times.len(),
        cage_turns: cage_turns(run, from),
    }
}

/// Turns of the cage from time `from` (s) to the end, in either sense; without slip where its speed is not recorded. `None` without a
/// cage, or of one that does not turn.
pub(super) fn cage_turns(run: &Run, from: f64) -> Option<f64> {
    run.model.scene().cage.as_ref()?;
    let first = run.recording.index_at(from);
    let times = run.recording.times.get(first..)?;
    let speed = match run.column("cage.speed").and_then(|column| column.get(first..)) {
        Some(column) => column.iter().map(|speed| speed.abs()).sum::<f64>() / column.len() as f64,
        None => run.kinematic_orbit_speed().abs(),
    };
    Some(speed * (times.last()? - times.first()?) / TAU).filter(|turns| *turns > 0.0)
}

/// The columns `roller[j].field` of all rollers from time `from` on.
fn roller_columns<'a>(run: &'a Run, field: &str, from: f64) -> Vec<&'a [f64]> {
    let first = run.recording.index_at(from);
    let column = |j: usize| run.column(&format!("roller[{j}].{field}"))?.get(first..);
    (0..run.roller_count()).filter_map(column).collect()
}

pub(super) fn max_roller_slip(run: &Run, from: f64) -> Option<RollerSlip> {
    let times = run.recording.times.get(run.recording.index_at(from)..)?;
    let columns = roller_columns(run, "slip", from);
    let all =
        columns.iter().enumerate().flat_map(|(j, c)| c.iter().zip(times).map(move |(s, t)| (j, *s, *t)));
    let (roller, value, time_s) = all.max_by(|a, b| a.1.total_cmp(&b.1))?;
    Some(RollerSlip { value, roller, time_s })
}

pub(super) fn pocket_forces(run: &Run, (from, few_cage_turns): (f64, Option<f64>)) -> Option<PocketForces> {
    let kind = run.model.element_kind();
    let of_element = |j: usize| run.interval_from(&format!("{kind}[{j}].pocket_force"), from);
    let all: Vec<Interval> = (0..run.model.element_count()).map(of_element).collect::<Option<_>>()?;
    let time = all.first().map(|x| x.to - x.from)?;
    Some(PocketForces {
        driving_n: all.iter().map(|x| x.positive).sum::<f64>() / time,
        braking_n: all.iter().map(|x| x.positive - x.integral).sum::<f64>() / time,
        largest_n: all.iter().map(|x| x.max.max(-x.min)).fold(0.0, f64::max),
        few_cage_turns,
    })
}

pub(super) fn extremes(run: &Run, (from, few_cage_turns): (f64, Option<f64>)) -> Vec<(String, Extremes)> {
    let all = run.model.channels();
    let watched = run.model.watched().iter().map(|i| &all[*i]);
    let found = watched.enumerate().filter_map(|(place, channel)| {
        let Interval { min, max, mean, integral, .. } = run.recording.interval(place, from)?;
        let unit = channel.unit.into();
        Some((channel.name.clone(), Extremes { unit, min, max, mean, integral, few_cage_turns }))
    });
    found.collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn shares_that_exceed_the_wall_time_are_left_out() {
        let parts = [1e-6, 2e-6, 0.0, 0.0, 5e-6, 0.0];
        let shares = shares_of(parts, 1e5, 1.0);
        let names: Vec<_> = shares.iter().map(|(name, _)| name.as_str()).collect();
        assert_eq!(names, ["finding_contacts", "outer_raceway", "guide"]);
        assert!((shares.iter().map(|(_, share)| share).sum::<f64>() - 0.8).abs() < 1e-12);
        assert_eq!(shares_of(parts, 1e5, 0.79), []);
        assert_eq!(shares_of(parts, 1e5, 0.0), []);
        assert_eq!(shares_of(PartTimes::default(), 0.0, 0.0), []);
    }
}
