//! Waves of a race around its axis, or of a roller around its own: heights towards the mate over the angle in the body.
//!
//! ```text
//! w(phi) = sum of a_n cos(n phi + b_n) + table(phi)
//! ```
//!
//! A table is a cubic between neighbouring angles, around and around, that goes nowhere beyond its heights
//! ([`crate::laws::elastic::surface::Table`]). Source: geometry.

use crate::laws::elastic::surface::Table;
use crate::scalar::{Dual, math};
use crate::scene::{WavinessHarmonic, WavinessTable};
use std::f64::consts::{PI, TAU};

/// Waves of one race or roller.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Waves {
    /// n, a_n in m and b_n in rad.
    harmonics: Box<[[f64; 3]]>,
    /// Heights over one turn and a bit beyond both of its ends, and the angle with which the turn begins, rad.
    table: Option<(Table, f64)>,
    highest_order: f64,
}

/// Angles of a table that are repeated beyond each end: its slopes look no further.
const BEYOND: usize = 2;

impl Waves {
    /// Of these harmonics and this table, if there are any. Tables that checks refuse are none.
    pub(crate) fn new(harmonics: &[WavinessHarmonic], table: Option<&WavinessTable>) -> Option<Self> {
        let table =
            table.filter(|table| table.angles.len() > BEYOND && table.heights.len() == table.angles.len());
        if harmonics.is_empty() && table.is_none() {
            return None;
        }
        let list = harmonics.iter().map(|h| [f64::from(h.order), h.amplitude, h.phase]);
        let of_harmonics = list.clone().map(|[order, ..]| order).fold(0.0, f64::max);
        Some(Self {
            harmonics: list.collect(),
            table: table.map(around),
            highest_order: table.map_or(0.0, |table| PI / narrowest(&table.angles)).max(of_harmonics),
        })
    }

    /// The largest order, or that of which half a wave lies between the angles of the table that are closest.
    pub(crate) fn highest_order(&self) -> f64 {
        self.highest_order
    }

    /// w, w' and w'' at an angle in the body (rad); m, m/rad and m/rad^2.
    pub(crate) fn at(&self, angle: f64) -> [f64; 3] {
        let smooth =
            self.harmonics.iter().fold([0.0; 3], |[height, slope, curvature], [order, amplitude, phase]| {
                let (sin, cos) = math::sin_cos(order * angle + phase);
                let [sin, cos] = [amplitude * sin, amplitude * cos];
                [height + cos, slope - order * sin, curvature - order * order * cos]
            });
        let Some((table, first)) = &self.table else { return smooth };
        let turns = ((angle - first) / TAU).floor();
        let [height, slope] = table.at(Dual::<1>::variable(angle - turns * TAU, 0));
        [smooth[0] + height.re, smooth[1] + slope.re, smooth[2] + slope.eps[0]]
    }
}

/// Smallest distance between neighbouring angles of one turn, rad.
fn narrowest(angles: &[f64]) -> f64 {
    let over_the_end = angles[0] + TAU - angles[angles.len() - 1];
    angles.windows(2).map(|pair| pair[1] - pair[0]).fold(over_the_end, f64::min)
}

/// A table of one turn with what its neighbours need, and where it begins.
fn around(table: &WavinessTable) -> (Table, f64) {
    let WavinessTable { angles, heights } = table;
    let count = angles.len();
    let places = (0..count + 2 * BEYOND).map(|i| {
        let at = i + 2 * count - BEYOND;
        (angles[at % count] + TAU * (at / count) as f64 - 2.0 * TAU, heights[at % count])
    });
    let (angles_around, heights): (Vec<f64>, Vec<f64>) = places.unzip();
    (Table::new(&angles_around, &heights), angles[0])
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn slopes_are_derivatives() {
        let harmonic = |order, amplitude, phase| WavinessHarmonic { order, amplitude, phase };
        assert!(Waves::new(&[], None).is_none());
        let table = WavinessTable {
            angles: vec![0.1, 1.0, 2.5, 4.0, 6.0],
            heights: vec![0.0, 1e-6, -2e-6, 0.0, 1e-6],
        };
        let harmonics = [harmonic(3, 1e-6, 0.3), harmonic(17, -2e-7, -1.0)];
        for (waves, order) in [
            (Waves::new(&harmonics, None), 17.0),
            (Waves::new(&[], Some(&table)), PI / (0.1 + TAU - 6.0)),
            (Waves::new(&harmonics, Some(&table)), 17.0),
        ] {
            let waves = waves.unwrap();
            assert!((waves.highest_order() - order).abs() < 1e-12);
            for at in [0.7, 0.05, -8.0, 6.1, 30.0] {
                let h = 1e-5;
                let [before, here, after] = [at - h, at, at + h].map(|angle| waves.at(angle));
                for k in 0..2 {
                    let slope = (after[k] - before[k]) / (2.0 * h);
                    assert!((slope - here[k + 1]).abs() < 1e-10, "{at} {k}: {slope} {}", here[k + 1]);
                }
                let around = waves.at(at + TAU);
                assert!((around[0] - here[0]).abs() < 1e-18 && (around[1] - here[1]).abs() < 1e-17);
            }
        }
        let waves = Waves::new(&harmonics, None).unwrap();
        let expected = 1e-6 * f64::cos(3.0 * 0.7 + 0.3) - 2e-7 * f64::cos(17.0 * 0.7 - 1.0);
        assert!((waves.at(0.7)[0] - expected).abs() < 1e-20);
    }

    #[test]
    fn a_table_keeps_its_heights_and_goes_nowhere_beyond() {
        // A spall: round but for one hollow.
        let table = WavinessTable {
            angles: vec![0.0, 1.0, 1.01, 1.05, 1.06],
            heights: vec![0.0, 0.0, -5e-6, -5e-6, 0.0],
        };
        let waves = Waves::new(&[], Some(&table)).unwrap();
        for (angle, height) in table.angles.iter().zip(&table.heights) {
            for turn in [-1.0, 0.0, 3.0] {
                assert!((waves.at(angle + turn * TAU)[0] - height).abs() < 1e-18);
            }
        }
        for i in 0..2000 {
            let [height, ..] = waves.at(f64::from(i) * 0.005);
            assert!((-5e-6 - 1e-18..=1e-18).contains(&height), "{height}");
        }
        assert_eq!(waves.at(4.0), [0.0; 3]);
    }
}
