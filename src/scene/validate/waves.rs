//! Checks of raceways and rollers that are not round.

use super::series::harmonics;
use crate::scene::check::{Range, range, shown};
use crate::scene::validate::Judge;
use crate::scene::*;
use std::collections::BTreeSet;
use std::f64::consts::TAU;

/// Largest slope of the waves of a surface over its arc: normals and curvatures in the laws are those of a round one.
const STEEPEST: f64 = 0.01;
/// The same of a table, whose edges may be those of a spall.
const STEEPEST_OF_TABLE: f64 = 0.2;
const WAVE: Range = range(-1e-4, 1e-4, "m");
const HEIGHT: Range = range(-1e-3, 1e-3, "m");
/// Angles of a table, and the smallest distance between them, rad.
const ANGLES: std::ops::RangeInclusive<usize> = 4..=4096;
const CLOSEST: f64 = 1e-4;

impl Scene {
    /// Checks the waves of raceways and of single rollers.
    pub(super) fn validate_waves(&self, judge: Judge<'_>) -> Result<()> {
        let (outer, inner) = (self.outer_ring.as_ref(), self.inner_ring.as_ref());
        let pitch = self.pitch_radius();
        for (ring, waves, table) in [
            (
                "outer_ring",
                outer.map(|ring| &ring.waviness),
                outer.and_then(|ring| ring.waviness_table.as_ref()),
            ),
            (
                "inner_ring",
                inner.map(|ring| &ring.waviness),
                inner.and_then(|ring| ring.waviness_table.as_ref()),
            ),
        ] {
            let paths = [format!("{ring}.waviness"), format!("{ring}.waviness_table")];
            let waves = waves.map_or(&[][..], |waves| waves);
            for (path, present) in paths.iter().zip([!waves.is_empty(), table.is_some()]) {
                self.may_be_wavy(judge, path, present)?;
            }
            validate_harmonics(judge, &paths[0], waves, pitch)?;
            validate_table(judge, &paths[1], table, pitch)?;
        }
        let Some(rollers) = &self.rollers else { return Ok(()) };
        self.may_be_wavy(judge, "rollers.waviness", !rollers.waviness.is_empty())?;
        let mut seen = BTreeSet::new();
        for (g, group) in rollers.waviness.iter().enumerate() {
            let path = format!("rollers.waviness.{g}");
            for (i, number) in group.rollers.iter().enumerate() {
                let path = format!("{path}.rollers.{i}");
                if *number >= rollers.count {
                    let last = rollers.count.saturating_sub(1);
                    judge.refuse(&path, format!("there is no roller {number}; 0 to {last}"))?;
                }
                if !seen.insert(*number) {
                    judge.refuse(&path, format!("roller {number} stands in the list twice"))?;
                }
            }
            if group.harmonics.is_empty() && group.table.is_none() {
                judge.refuse(&path, "has no waves; give 'harmonics' or a 'table'")?;
            }
            validate_harmonics(judge, &format!("{path}.harmonics"), &group.harmonics, rollers.radius)?;
            validate_table(judge, &format!("{path}.table"), group.table.as_ref(), rollers.radius)?;
        }
        Ok(())
    }

    /// Refuses waves where no element sees them.
    fn may_be_wavy(&self, judge: Judge<'_>, path: &str, present: bool) -> Result<()> {
        let excused = judge.excuses("balls") || judge.excuses("rollers");
        let in_plane = self.rollers.as_ref().is_some_and(|rollers| rollers.space.is_none());
        if !present || self.balls.is_some() || in_plane || excused {
            return Ok(());
        }
        judge.refuse(path, "needs 'balls', or 'rollers' without 'rollers.space'; remove it")
    }
}

fn validate_harmonics(judge: Judge<'_>, path: &str, waves: &[WavinessHarmonic], radius: f64) -> Result<()> {
    harmonics(judge, path, waves.iter().map(|wave| (wave.order, wave.amplitude, wave.phase)), (1, ""), WAVE)?;
    let steepest: f64 = waves.iter().map(|wave| f64::from(wave.order) * wave.amplitude.abs()).sum();
    if steepest > STEEPEST * radius {
        let text = format!(
            "slopes of {} at most, order times amplitude over the radius {radius:?} m, are too steep for waves whose curvatures are those of a \
             round surface; {STEEPEST} is allowed",
            shown(steepest / radius)
        );
        judge.refuse(path, text)?;
    }
    Ok(())
}

fn validate_table(judge: Judge<'_>, path: &str, table: Option<&WavinessTable>, radius: f64) -> Result<()> {
    let Some(WavinessTable { angles, heights }) = table else { return Ok(()) };
    if !ANGLES.contains(&angles.len()) {
        let text = format!("has {} numbers; {} to {}", angles.len(), ANGLES.start(), ANGLES.end());
        return judge.refuse(&format!("{path}.angles"), text);
    }
    if heights.len() != angles.len() {
        let text = format!("has {} numbers for {} angles", heights.len(), angles.len());
        return judge.refuse(&format!("{path}.heights"), text);
    }
    for (i, (angle, height)) in angles.iter().zip(heights).enumerate() {
        let lowest = if i == 0 { -TAU } else { angles[i - 1] + CLOSEST };
        let highest = if i == 0 { TAU } else { angles[0] + TAU - CLOSEST };
        judge.number(&format!("{path}.angles.{i}"), *angle, range(lowest, highest, "rad"))?;
        judge.number(&format!("{path}.heights.{i}"), *height, HEIGHT)?;
    }
    for i in 0..angles.len() {
        let next = (i + 1) % angles.len();
        let width = angles[next] - angles[i] + if next == 0 { TAU } else { 0.0 };
        let slope = (heights[next] - heights[i]).abs() / (width * radius);
        if slope > STEEPEST_OF_TABLE {
            let text = format!(
                "is {} m away from its neighbour {i} over {} rad: a slope of {}, more than {STEEPEST_OF_TABLE}",
                shown(heights[next] - heights[i]),
                shown(width),
                shown(slope)
            );
            judge.refuse(&format!("{path}.heights.{next}"), text)?;
        }
    }
    Ok(())
}
