//! Whirl of the cage: how its centre moves about the guide centre, from what a run recorded.
//!
//! The motion over a window of time is one of the classes of [`CageMotion`]; the first whose rule holds is taken:
//!
//! 1. *Resting*: the centre stays within 1 % of the clearance of its mean position.
//! 2. *Whirl*: the 5th and the 95th percentile of the whirl speed have the same sign, the centre makes at least one
//!    full net turn about the guide centre, and its mean radius is at least 5 % of the clearance. Forward in the sense
//!    of the rotation of the cage, backward against it; a cage that does not turn counts as turning counter-clockwise.
//! 3. *Stable*: the 95th percentile of the distance from the mean position is at most 25 % of the clearance.
//! 4. *Irregular*: anything else.
//!
//! Near the guide centre the whirl speed is noise: records closer to it than 0.1 % of the clearance are left out of its
//! statistics and of the settling time.
//!
//! The *deviation of the velocity*, a measure of how steady a cage runs, is the standard deviation of the speed of its centre over
//! the mean of that speed: near zero of a regular whirl, about one half of a random walk, and larger of a cage that rests and is
//! hit now and then. It says nothing of a cage that rests.
//!
//! Of a cage in space the same rules tell of its *wobble*: the way of the point on its axis that is one pitch radius away from its centre,
//! beside which its own edge shifts as far. How long it moves in which way: [`super::stretches`].
//!
//! Without a clearance, the largest distance of the centre from the guide centre in the window stands in for it.

use super::stretches::{MotionShares, intermittent};
use crate::scalar::math;
use crate::sim::Spread;
use serde::{Deserialize, Serialize};
use std::f64::consts::{PI, TAU};

/// Fewer records than this are no motion.
const MIN_RECORDS: usize = 3;
/// Largest distance of a resting centre from its mean position, in units of the clearance.
const RESTING_REACH: f64 = 0.01;
/// Distance from the guide centre below which the whirl speed says nothing, in units of the clearance.
pub const SMALLEST_WHIRL_RADIUS: f64 = 1e-3;
/// Smallest mean radius of a whirl, in units of the clearance.
const WHIRL_RADIUS: f64 = 0.05;
/// Smallest number of net turns of a whirl in the window.
const WHIRL_TURNS: f64 = 1.0;
/// Largest 95th percentile of the distance of a stable centre from its mean position, in units of the clearance.
const STABLE_REACH: f64 = 0.25;
/// A whirl has settled when its speed stays this close to the mean, in units of the mean.
const SETTLED_BAND: f64 = 0.15;

/// Columns of a run, one value per record; what is longer than the shortest is not used.
#[derive(Clone, Copy, Debug)]
pub struct WhirlRecord<'a> {
    /// Times in growing order, s.
    pub times: &'a [f64],
    /// Angular speed of the cage centre about the guide centre, rad/s.
    pub whirl_speed: &'a [f64],
    /// Distance of the cage centre from the guide centre, m.
    pub whirl_radius: &'a [f64],
    /// Cage centre (y, z) relative to the guide centre, m.
    pub centre: [&'a [f64]; 2],
    /// Cage centre along the axis of the bearing, m, where it moves there.
    pub along: Option<&'a [f64]>,
    /// Rotation speed of the cage, rad/s.
    pub cage_speed: &'a [f64],
    /// Radial guide clearance, m.
    pub clearance: Option<f64>,
}

/// Motion of the cage centre over a window of time; the rules are those of the module's introduction.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum CageMotion {
    /// Stays where it is.
    Resting,
    /// Swings about a fixed place.
    Stable,
    /// Whirls in the sense of the cage rotation.
    ForwardWhirl,
    /// Whirls against the cage rotation.
    BackwardWhirl,
    /// Anything else.
    Irregular,
}

impl CageMotion {
    /// All classes.
    pub const ALL: [Self; 5] =
        [Self::Resting, Self::Stable, Self::ForwardWhirl, Self::BackwardWhirl, Self::Irregular];

    /// Name in words.
    pub fn name(self) -> &'static str {
        match self {
            Self::Resting => "resting",
            Self::Stable => "stable",
            Self::ForwardWhirl => "forward whirl",
            Self::BackwardWhirl => "backward whirl",
            Self::Irregular => "irregular",
        }
    }

    /// Whether it is a whirl, in either sense.
    pub fn is_whirl(self) -> bool {
        matches!(self, Self::ForwardWhirl | Self::BackwardWhirl)
    }
}

/// Whirl of the cage over a window of time.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct WhirlSummary {
    /// Whirl speed in the window, rad/s; `None` if the centre was always too close to that of the guide to have one.
    pub speed: Option<Spread>,
    /// Mean whirl radius in the window, m.
    pub radius: f64,
    /// Time of the first record from which on the whirl speed stays within 15 % of its mean in the window, s. `None`
    /// if that is not so before the window starts.
    pub settling_time: Option<f64>,
    /// Net turns of the centre about the guide centre in the window, positive counter-clockwise.
    pub turns: f64,
    /// Standard deviation of the speed of the centre over its mean, from one record to the next; `None` for a centre that
    /// stays in its place.
    pub velocity_deviation: Option<f64>,
    /// Class of the motion.
    pub motion: CageMotion,
    /// Share of the time in each class; `None` of a window with too few records for it.
    pub shares: Option<MotionShares>,
    /// Whether a whirl comes and goes.
    pub intermittent: bool,
}

impl WhirlSummary {
    /// Whirl from time `from` (s) on. `None` when the window holds fewer than three records, or a value that is not
    /// finite.
    pub fn of(record: &WhirlRecord<'_>, from: f64) -> Option<Self> {
        let count = record.columns().map(<[f64]>::len).min()?;
        let first = record.times.get(..count)?.partition_point(|&t| t < from);
        let window = record.part(first, count)?;
        let finite = window.columns().all(|column| column.iter().all(|x| x.is_finite()));
        if window.times.len() < MIN_RECORDS || !finite {
            return None;
        }
        let speeds: Vec<f64> = window.known_speeds().map(|(_, speed)| speed).collect();
        let speed = Spread::of(&speeds);
        let radius = mean(window.whirl_radius);
        let turns = window.turns(speed.as_ref());
        let motion = window.motion(speed.as_ref(), radius, turns.abs() >= WHIRL_TURNS);
        let shares = window.shares();
        let intermittent = shares.as_ref().is_some_and(intermittent);
        let settling_time = speed.and_then(|speed| settling_time(&record.part(0, count)?, first, speed.mean));
        let velocity_deviation = window.velocity_deviation();
        Some(Self { speed, radius, settling_time, turns, velocity_deviation, motion, shares, intermittent })
    }
}

impl<'a> WhirlRecord<'a> {
    fn columns(&self) -> impl Iterator<Item = &'a [f64]> {
        let [y, z] = self.centre;
        [self.times, self.whirl_speed, self.whirl_radius, y, z, self.cage_speed].into_iter().chain(self.along)
    }

    /// Records `first` to `end`, without the latter.
    pub(super) fn part(&self, first: usize, end: usize) -> Option<Self> {
        let part = |column: &'a [f64]| column.get(first..end);
        Some(Self {
            times: part(self.times)?,
            whirl_speed: part(self.whirl_speed)?,
            whirl_radius: part(self.whirl_radius)?,
            centre: [part(self.centre[0])?, part(self.centre[1])?],
            along: self.along.and_then(part),
            cage_speed: part(self.cage_speed)?,
            clearance: self.clearance,
        })
    }

    /// Distance that shares are of, m.
    pub(super) fn reference(&self) -> f64 {
        self.clearance.unwrap_or_else(|| self.places().map(|(y, z)| math::hypot(y, z)).fold(0.0, f64::max))
    }

    /// Records far enough from the guide centre to have a whirl speed, with that.
    pub(super) fn known_speeds(&self) -> impl Iterator<Item = (usize, f64)> + '_ {
        let smallest = SMALLEST_WHIRL_RADIUS * self.reference();
        let all = self.whirl_radius.iter().zip(self.whirl_speed).enumerate();
        all.filter(move |(_, (radius, _))| **radius >= smallest).map(|(i, (_, speed))| (i, *speed))
    }

    fn places(&self) -> impl Iterator<Item = (f64, f64)> + '_ {
        self.centre[0].iter().copied().zip(self.centre[1].iter().copied())
    }

    /// Net turns: the angle between successive records added up, or mean speed times time where most of a half turn
    /// and more may lie between two records.
    pub(super) fn turns(&self, speed: Option<&Spread>) -> f64 {
        let interval = self.times.windows(2).map(|t| t[1] - t[0]).fold(0.0, f64::max);
        if let Some(speed) = speed.filter(|speed| speed.p05.abs().max(speed.p95.abs()) * interval > PI) {
            let [first, .., last] = self.times else { return 0.0 };
            return speed.mean * (last - first) / TAU;
        }
        self.angles().sum::<f64>() / TAU
    }

    /// Angles about the guide centre from record to record, rad.
    pub(super) fn angles(&self) -> impl Iterator<Item = f64> + '_ {
        let steps = self.places().zip(self.places().skip(1));
        steps.map(|((y0, z0), (y1, z1))| math::atan2(y0 * z1 - z0 * y1, y0 * y1 + z0 * z1))
    }

    fn velocity_deviation(&self) -> Option<f64> {
        let steps = self.places().zip(self.places().skip(1)).zip(self.times.windows(2));
        let across =
            steps.map(|(((y0, z0), (y1, z1)), t)| (math::hypot(y1 - y0, z1 - z0), t[1] - t[0])).enumerate();
        let along = |i: usize| self.along.map_or(0.0, |x| x[i + 1] - x[i]);
        let speeds: Vec<f64> = across.map(|(i, (way, time))| math::hypot(way, along(i)) / time).collect();
        let speed = Spread::of(&speeds).filter(|speed| speed.mean > 0.0)?;
        Some(speed.deviation / speed.mean)
    }

    /// The class; `turns`: whether the centre goes round often enough for a whirl.
    pub(super) fn motion(&self, speed: Option<&Spread>, radius: f64, turns: bool) -> CageMotion {
        let reference = self.reference();
        let centre = self.centre.map(mean);
        let distances: Vec<f64> =
            self.places().map(|(y, z)| math::hypot(y - centre[0], z - centre[1])).collect();
        let Some(distance) = Spread::of(&distances) else { return CageMotion::Irregular };
        let sense = speed.filter(|speed| speed.p05 * speed.p95 > 0.0).map(|speed| speed.mean);
        if distance.max <= RESTING_REACH * reference {
            CageMotion::Resting
        } else if let Some(speed) = sense.filter(|_| turns && radius >= WHIRL_RADIUS * reference) {
            let cage = if mean(self.cage_speed) < 0.0 { -1.0 } else { 1.0 };
            if cage * speed > 0.0 { CageMotion::ForwardWhirl } else { CageMotion::BackwardWhirl }
        } else if distance.p95 <= STABLE_REACH * reference {
            CageMotion::Stable
        } else {
            CageMotion::Irregular
        }
    }
}

/// See [`WhirlSummary::settling_time`]; `window` is the first record of the window.
fn settling_time(record: &WhirlRecord<'_>, window: usize, mean: f64) -> Option<f64> {
    let inside = |speed: f64| (speed - mean).abs() <= SETTLED_BAND * mean.abs();
    let last_outside = record.known_speeds().filter(|(_, speed)| !inside(*speed)).last();
    let first = last_outside.map_or(0, |(i, _)| i + 1);
    if first > window { None } else { record.times.get(first).copied() }
}

pub(super) fn mean(values: &[f64]) -> f64 {
    values.iter().sum::<f64>() / values.len() as f64
}

#[cfg(test)]
pub(super) mod tests {
    use super::*;

    pub(crate) const CLEARANCE: f64 = 2e-4;
    pub(crate) const INTERVAL: f64 = 1e-4;

    /// Columns of a synthetic orbit: times, whirl speed, radius, y, z, cage speed.
    pub(crate) struct Orbit([Vec<f64>; 6]);

    impl Orbit {
        /// An orbit of 1000 records at positions (y, z) in units of the clearance over time in s.
        pub(crate) fn new(cage_speed: f64, interval: f64, place: impl Fn(f64) -> (f64, f64)) -> Self {
            let mut columns: [Vec<f64>; 6] = Default::default();
            for i in 0..1000 {
                let t = f64::from(i) * interval;
                let (y, z) = place(t);
                // Central differences over a time that is short for every orbit here.
                let ((a, b), (c, d)) = (place(t - 1e-7), place(t + 1e-7));
                let speed = (y * (d - b) - z * (c - a)) / (2e-7 * (y * y + z * z).max(1e-12));
                let row = [t, speed, CLEARANCE * math::hypot(y, z), CLEARANCE * y, CLEARANCE * z, cage_speed];
                columns.iter_mut().zip(row).for_each(|(column, x)| column.push(x));
            }
            Self(columns)
        }

        pub(crate) fn record(&self) -> WhirlRecord<'_> {
            let [times, whirl_speed, whirl_radius, y, z, cage_speed] = &self.0;
            let clearance = Some(CLEARANCE);
            WhirlRecord {
                times,
                whirl_speed,
                whirl_radius,
                centre: [y, z],
                along: None,
                cage_speed,
                clearance,
            }
        }

        pub(crate) fn summary(&self) -> WhirlSummary {
            WhirlSummary::of(&self.record(), 0.05).expect("a window")
        }
    }

    pub(crate) fn circle(radius: f64, speed: f64) -> impl Fn(f64) -> (f64, f64) {
        move |t| (radius * (speed * t).cos(), radius * (speed * t).sin())
    }

    #[test]
    fn velocities_of_a_steady_whirl_do_not_deviate() {
        let whirl = Orbit::new(140.0, INTERVAL, circle(0.8, -2000.0)).summary();
        assert!(whirl.velocity_deviation.is_some_and(|x| x < 1e-9), "{whirl:?}");
        // Along a line the speed is that of a rectified sine: its deviation is sqrt(pi^2 / 8 - 1) of its mean.
        let swing = Orbit::new(140.0, INTERVAL, |t| (0.1 + 0.3 * (100.0 * TAU * t).sin(), 0.0)).summary();
        let expected = (PI * PI / 8.0 - 1.0).sqrt();
        assert!(swing.velocity_deviation.is_some_and(|x| (x - expected).abs() < 0.01), "{swing:?}");
        let rest = Orbit::new(140.0, INTERVAL, |_| (0.5, -0.5)).summary();
        assert_eq!(rest.velocity_deviation, None);
    }

    #[test]
    fn whirl_in_both_senses() {
        for (cage, whirl, expected) in [
            (140.0, -2000.0, CageMotion::BackwardWhirl),
            (140.0, 2000.0, CageMotion::ForwardWhirl),
            (-140.0, -2000.0, CageMotion::ForwardWhirl),
            (-140.0, 2000.0, CageMotion::BackwardWhirl),
            (0.0, 2000.0, CageMotion::ForwardWhirl),
        ] {
            let s = Orbit::new(cage, INTERVAL, circle(0.6, whirl)).summary();
            assert_eq!(s.motion, expected, "cage {cage}, whirl {whirl}");
            assert!(s.motion.is_whirl());
            assert!((s.speed.unwrap().mean / whirl - 1.0).abs() < 1e-6, "{s:?}");
            assert!((s.radius - 0.6 * CLEARANCE).abs() < 1e-9, "{s:?}");
            // 500 records have 499 intervals between them.
            assert!((s.turns / (whirl * 499.0 * INTERVAL / TAU) - 1.0).abs() < 1e-9, "{s:?}");
            assert_eq!(s.settling_time, Some(0.0));
        }
    }

    #[test]
    fn motions_without_whirl() {
        let place = |y: f64, z: f64, t: f64| (y + 0.1 * (700.0 * t).cos(), z + 0.1 * (700.0 * t).sin());
        let cases: [(CageMotion, Orbit); 5] = [
            (CageMotion::Resting, Orbit::new(1.0, INTERVAL, |t| (0.3, -0.5 + 0.005 * (900.0 * t).sin()))),
            (CageMotion::Resting, Orbit::new(1.0, INTERVAL, |_| (0.0, 0.0))),
            (CageMotion::Stable, Orbit::new(1.0, INTERVAL, move |t| place(0.1, -0.8, t))),
            // A circle about a place that the guide centre is not in has no net turns.
            (CageMotion::Irregular, Orbit::new(1.0, INTERVAL, |t| (0.6 * (700.0 * t).cos(), 0.3))),
            // Turns too slowly for a full turn in the window.
            (CageMotion::Irregular, Orbit::new(1.0, INTERVAL, circle(0.6, -100.0))),
        ];
        for (expected, orbit) in cases {
            let s = orbit.summary();
            assert_eq!(s.motion, expected, "{s:?}");
            assert!(!s.motion.is_whirl());
        }
        // A tiny circle about the guide centre is no whirl.
        assert_eq!(Orbit::new(1.0, INTERVAL, circle(0.04, 2000.0)).summary().motion, CageMotion::Stable);
    }

    #[test]
    fn without_clearance_the_orbit_is_the_reference() {
        let orbit = Orbit::new(140.0, INTERVAL, circle(1e-3, -2000.0));
        let record = WhirlRecord { clearance: None, ..orbit.record() };
        assert_eq!(orbit.summary().motion, CageMotion::Resting);
        assert_eq!(WhirlSummary::of(&record, 0.05).unwrap().motion, CageMotion::BackwardWhirl);
    }

    #[test]
    fn coarse_records_count_turns_by_speed() {
        // 4 rad between records look like 2.28 rad the other way round.
        let s = Orbit::new(140.0, 2e-3, circle(0.5, 2000.0)).summary();
        assert!((s.turns / (2000.0 * 974.0 * 2e-3 / TAU) - 1.0).abs() < 1e-2, "{s:?}");
        assert_eq!(s.motion, CageMotion::ForwardWhirl);
    }

    #[test]
    fn settling_is_the_end_of_the_last_excursion() {
        let mut orbit = Orbit::new(140.0, INTERVAL, circle(0.6, -2000.0));
        orbit.0[1][..200].fill(-1000.0);
        orbit.0[1][240] = -2400.0;
        assert_eq!(orbit.summary().settling_time, Some(orbit.0[0][241]));
        orbit.0[1][700] = -2400.0;
        assert_eq!(orbit.summary().settling_time, None);
    }

    #[test]
    fn what_is_no_motion_gives_none() {
        let mut orbit = Orbit::new(140.0, INTERVAL, circle(0.6, -2000.0));
        for (from, expected) in [(0.0, true), (0.0997, true), (0.0998, false), (7.0, false), (f64::NAN, true)]
        {
            assert_eq!(WhirlSummary::of(&orbit.record(), from).is_some(), expected, "{from}");
        }
        let short = WhirlRecord { cage_speed: &[1.0], ..orbit.record() };
        assert_eq!(WhirlSummary::of(&short, 0.0), None);
        // A value that is not a number hurts only the window it is in; before it, the whirl has not settled.
        orbit.0[1][10] = f64::NAN;
        assert_eq!(orbit.summary().settling_time, Some(orbit.0[0][11]));
        for column in 1..6 {
            let mut orbit = Orbit::new(140.0, INTERVAL, circle(0.6, -2000.0));
            orbit.0[column][900] = f64::NAN;
            assert_eq!(WhirlSummary::of(&orbit.record(), 0.05), None);
        }
    }
}
