//! What elements feel at each place of their orbit, from what a run recorded.
//!
//! The orbit is divided into sectors of equal angle, and the records of all elements are sorted into them.

use crate::sim::Spread;
use serde::{Deserialize, Serialize};
use std::f64::consts::TAU;

/// An element is loaded in a sector where it is so in this share of its records there.
const LOADED: f64 = 0.5;

/// A quantity over the angle of the orbit, one value per sector; NaN where no element was seen.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct OverOrbit {
    /// Mean.
    pub mean: Vec<f64>,
    /// 95th percentile of the magnitude.
    pub p95: Vec<f64>,
    /// 5th and 95th percentile of the value.
    pub range: Vec<[f64; 2]>,
    /// Largest magnitude.
    pub peak: Vec<f64>,
    /// Share of the records that are above zero.
    pub positive: Vec<f64>,
}

/// Where elements carry load.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct LoadZone {
    /// Middle, as an angle from y counter-clockwise, 0 to 2 pi, rad.
    pub middle_rad: f64,
    /// Extent, rad: 2 pi when all of the orbit is loaded. Known to one sector.
    pub extent_rad: f64,
}

impl OverOrbit {
    /// Sorts samples, each an angle in rad, the value there and an extreme magnitude around that time, into so many sectors.
    pub fn of(samples: impl IntoIterator<Item = (f64, f64, f64)>, sectors: usize) -> Self {
        let (mut values, mut peaks) = (vec![Vec::new(); sectors], vec![f64::NAN; sectors]);
        for (angle, value, extreme) in samples {
            let place = sector(angle, sectors);
            values[place].push(value);
            peaks[place] = extreme.abs().max(value.abs()).max(peaks[place]);
        }
        let share =
            |column: &Vec<f64>| column.iter().filter(|x| **x > 0.0).count() as f64 / column.len() as f64;
        let magnitude = |column: &Vec<f64>| {
            let magnitudes: Vec<f64> = column.iter().map(|x| x.abs()).collect();
            Spread::of(&magnitudes).map_or(f64::NAN, |spread| spread.p95)
        };
        Self {
            mean: values.iter().map(|x| Spread::of(x).map_or(f64::NAN, |spread| spread.mean)).collect(),
            p95: values.iter().map(magnitude).collect(),
            range: values
                .iter()
                .map(|x| Spread::of(x).map_or([f64::NAN; 2], |spread| [spread.p05, spread.p95]))
                .collect(),
            peak: peaks,
            positive: values.iter().map(share).collect(),
        }
    }

    /// Middle of sector `place`, from y counter-clockwise, rad.
    pub fn angle(&self, place: usize) -> f64 {
        (place as f64 + 0.5) * TAU / self.mean.len() as f64
    }

    /// The longest row of sectors in which more than half of the records are above zero; `None` where there is no such sector.
    pub fn positive_zone(&self) -> Option<LoadZone> {
        let n = self.positive.len();
        let inside = |place: usize| self.positive[place % n] >= LOADED;
        let width = TAU / n as f64;
        if (0..n).all(inside) {
            return (n > 0).then_some(LoadZone { middle_rad: 0.0, extent_rad: TAU });
        }
        let begins = (0..n).filter(|&place| inside(place) && !inside(place + n - 1));
        let length = |begin: usize| (begin..begin + n).take_while(|place| inside(*place)).count();
        let (begin, long) = begins.map(|begin| (begin, length(begin))).max_by_key(|(_, long)| *long)?;
        let middle = (begin as f64 + 0.5 * long as f64) * width;
        Some(LoadZone { middle_rad: middle % TAU, extent_rad: long as f64 * width })
    }
}

/// Sector of an angle in rad of any number of turns.
fn sector(angle: f64, sectors: usize) -> usize {
    let share = angle.rem_euclid(TAU) / TAU;
    ((share * sectors as f64) as usize).min(sectors - 1)
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::PI;

    #[test]
    fn a_load_around_an_angle_is_found_there() {
        // Loaded within 50 degrees of the bottom, also across whole turns, and clockwise.
        let bottom = 1.5 * PI;
        let samples = (0..7200).map(|i| {
            let angle = -0.01 * f64::from(i);
            let load = ((angle - bottom).cos() - (50.0f64).to_radians().cos()).max(0.0);
            (angle, 100.0 * load, 120.0 * load)
        });
        let over = OverOrbit::of(samples, 72);
        let zone = over.positive_zone().unwrap();
        assert!((zone.middle_rad - bottom).abs() < 0.05, "{zone:?}");
        assert!((zone.extent_rad - (100.0f64).to_radians()).abs() < (5.1f64).to_radians(), "{zone:?}");
        let place = (0..72).max_by(|a, b| over.mean[*a].total_cmp(&over.mean[*b])).unwrap();
        assert!((over.angle(place) - bottom).abs() < 0.1);
        assert!(over.peak[place] > over.p95[place] && over.p95[place] >= over.mean[place]);
        assert!(over.range[place][0] < over.mean[place] && over.range[place][1] == over.p95[place]);
        assert!((over.peak[place] - 120.0 * (1.0 - (50.0f64).to_radians().cos())).abs() < 0.2);
    }

    #[test]
    fn a_zone_may_lie_across_the_beginning_be_all_or_nothing() {
        let zone = |loaded: fn(f64) -> bool| {
            let samples = (0..360).map(|i| (f64::from(i) + 0.5).to_radians());
            OverOrbit::of(samples.map(|a| (a, f64::from(u8::from(loaded(a))), 0.0)), 36).positive_zone()
        };
        let across = zone(|a| a.cos() > 0.0).unwrap();
        assert!(across.middle_rad < 1e-9 || TAU - across.middle_rad < 1e-9, "{across:?}");
        assert!((across.extent_rad - PI).abs() < 1e-9);
        assert_eq!(zone(|_| false), None);
        assert_eq!(zone(|_| true).unwrap().extent_rad, TAU);
        assert_eq!(OverOrbit::of([], 36).positive_zone(), None);
        assert!(OverOrbit::of([(0.1, 1.0, 1.0)], 4).mean[2].is_nan());
    }
}
