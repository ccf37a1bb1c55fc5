//! How far the surfaces of one roller and its raceway fall back from straight ones: a profile, a table of drops, a crown that deviates.
//!
//! ```text
//! p(s) = profile of the roller + table(s) + d (s/a)^2,   p_r(t) = profile of the raceway + table(t)
//! ```
//!
//! A table is a cubic between neighbouring places with slopes that keep it monotone where its drops are; beyond its ends it goes on straight. Its slope is
//! continuous. Source: F. N. Fritsch, J. Butland, SIAM J. Sci. Stat. Comput. 5 (1984), slopes by their weighted harmonic mean.

use super::profile::Profile;
use crate::scalar::{Numeric, Of, Pack};
use pulp::Simd;

/// Most places of a table.
pub const MOST_PLACES: usize = 32;

/// Drops at places along a surface.
#[derive(Clone, Debug, PartialEq)]
pub struct Table {
    /// m from the middle, growing.
    places: Box<[f64]>,
    /// Drop there, m, and its slope.
    drops: Box<[[f64; 2]]>,
}

/// Slopes of secants between places, kept monotone.
fn slopes(places: &[f64], drops: &[f64]) -> Vec<f64> {
    let width = |i: usize| places[i + 1] - places[i];
    let secant = |i: usize| (drops[i + 1] - drops[i]) / width(i);
    let last = places.len() - 1;
    let inner = |i: usize| {
        let ([before, after], [narrow, wide]) = ([secant(i - 1), secant(i)], [width(i - 1), width(i)]);
        if before * after <= 0.0 {
            return 0.0;
        }
        let (first, second) = (2.0 * wide + narrow, wide + 2.0 * narrow);
        (first + second) / (first / before + second / after)
    };
    (0..=last)
        .map(|i| match i {
            0 => secant(0),
            i if i == last => secant(last - 1),
            i => inner(i),
        })
        .collect()
}

impl Table {
    /// From at least two growing places (m) and as many drops, m.
    pub fn new(places: &[f64], drops: &[f64]) -> Self {
        let slopes = slopes(places, drops);
        Self {
            places: places.into(),
            drops: drops.iter().zip(slopes).map(|(drop, slope)| [*drop, slope]).collect(),
        }
    }

    /// Places, m.
    pub(super) fn places(&self) -> &[f64] {
        &self.places
    }

    /// Drop at `s` (m), m, and its slope.
    pub fn at<T: Of<f64>>(&self, s: T) -> [T; 2] {
        let (x, last) = (s.base(), self.places.len() - 1);
        let next = self.places.partition_point(|place| *place <= x);
        if next == 0 || next > last {
            let k = next.min(last);
            let [drop, slope] = self.drops[k];
            return [(s - self.places[k]) * slope + drop, s.like(slope)];
        }
        let ([from, to], width) =
            ([self.drops[next - 1], self.drops[next]], self.places[next] - self.places[next - 1]);
        let u = (s - self.places[next - 1]) * (1.0 / width);
        let (rise, [first, second]) = (to[0] - from[0], [from[1], to[1]].map(|slope| slope * width));
        let (square, cube) = (3.0 * rise - 2.0 * first - second, first + second - 2.0 * rise);
        let drop = ((u * cube + square) * u + first) * u + from[0];
        [drop, ((u * (3.0 * cube) + 2.0 * square) * u + first) * (1.0 / width)]
    }
}

/// How much less surfaces reach than straight ones, m.
pub trait Drops<T>: Copy {
    /// Of the roller, `s` (m) from its middle.
    fn of_roller(&self, s: T) -> T;
    /// Of the raceway, `t` (m) from its middle, and its slope.
    fn of_raceway(&self, t: T) -> [T; 2];
}

/// Straight surfaces.
#[derive(Clone, Copy, Debug)]
pub struct Straight;

impl<T: Numeric> Drops<T> for Straight {
    #[inline(always)]
    fn of_roller(&self, s: T) -> T {
        s.like(0.0)
    }
    #[inline(always)]
    fn of_raceway(&self, t: T) -> [T; 2] {
        [t.like(0.0); 2]
    }
}

/// These surfaces, or straight ones.
impl<T: Of<f64>> Drops<T> for Option<&Surface> {
    #[inline(always)]
    fn of_roller(&self, s: T) -> T {
        self.map_or_else(|| s.like(0.0), |surface| surface.of_roller(s))
    }
    #[inline(always)]
    fn of_raceway(&self, t: T) -> [T; 2] {
        self.map_or_else(|| [t.like(0.0); 2], |surface| surface.of_raceway(t))
    }
}

/// The same at many places, one after the other: tables and logarithms branch.
#[derive(Clone, Copy, Debug)]
pub struct OneByOne<'a>(pub Option<&'a Surface>);

impl<S: Simd, const K: usize> Drops<Pack<S, K>> for OneByOne<'_> {
    #[inline(always)]
    fn of_roller(&self, s: Pack<S, K>) -> Pack<S, K> {
        match self.0 {
            Some(surface) => s.each(|s| [surface.of_roller(s)])[0],
            None => s.like(0.0),
        }
    }
    #[inline(always)]
    fn of_raceway(&self, t: Pack<S, K>) -> [Pack<S, K>; 2] {
        match self.0 {
            Some(surface) => t.each(|t| surface.of_raceway(t)),
            None => [t.like(0.0); 2],
        }
    }
}

/// Surfaces of one roller and one raceway.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Surface {
    /// Profile of both.
    pub profile: Option<Profile>,
    /// Tables of roller and raceway.
    pub tables: [Option<Table>; 2],
    /// d/a^2, 1/m: what the crown of the roller deviates by.
    pub crown: f64,
}

impl Surface {
    /// That of a profile alone.
    pub fn new(profile: Profile) -> Self {
        Self { profile: Some(profile), ..Self::default() }
    }

    /// Whether both are straight.
    pub fn is_straight(&self) -> bool {
        *self == Self::default()
    }

    /// Where the roller's profile has its logarithm begin, m from the middle.
    pub(super) fn start(&self) -> f64 {
        self.profile.as_ref().map_or(0.0, Profile::start)
    }

    /// Drop in m of the roller, `s` (m) from its middle.
    #[inline(always)]
    pub fn of_roller<T: Of<f64>>(&self, s: T) -> T {
        let mut drop = s * s * self.crown;
        if let Some(profile) = &self.profile {
            drop += profile.of_roller(s);
        }
        if let Some(table) = &self.tables[0] {
            drop += table.at(s)[0];
        }
        drop
    }

    /// Slope of that.
    #[inline(always)]
    pub fn slope_of_roller(&self, s: f64) -> f64 {
        let of_profile = self.profile.as_ref().map_or(0.0, |profile| profile.slope_of_roller(s));
        let of_table = self.tables[0].as_ref().map_or(0.0, |table| table.at(s)[1]);
        of_profile + of_table + 2.0 * self.crown * s
    }

    /// Drop in m of the raceway, `t` (m) from its middle, and its slope.
    #[inline(always)]
    pub fn of_raceway<T: Of<f64>>(&self, t: T) -> [T; 2] {
        let [mut drop, mut slope] = match &self.profile {
            Some(profile) => profile.of_raceway(t),
            None => [t.like(0.0); 2],
        };
        if let Some(table) = &self.tables[1] {
            let [of_table, steep] = table.at(t);
            (drop, slope) = (drop + of_table, slope + steep);
        }
        [drop, slope]
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scalar::Dual;

    fn table() -> Table {
        Table::new(&[-0.01, -0.006, -0.002, 0.003, 0.0065, 0.01], &[9e-6, 2e-6, 0.0, 0.0, 1.5e-6, 12e-6])
    }

    #[test]
    fn it_goes_through_its_places_and_stays_monotone_between_them() {
        let table = table();
        for (place, [drop, _]) in table.places.iter().zip(&table.drops) {
            assert!((table.at(*place)[0] - drop).abs() < 1e-20);
        }
        let at = |i: i32| table.at(f64::from(i) * 1e-5)[0];
        assert!((-1000..-200).all(|i| at(i) >= at(i + 1)) && (300..1000).all(|i| at(i) <= at(i + 1)));
        assert!((-200..=300).all(|i| at(i).abs() < 1e-20));
        // Straight beyond its ends.
        assert!((table.at(0.011)[0] - 12e-6 - 1e-3 * table.at(0.01)[1]).abs() < 1e-18);
    }

    #[test]
    fn its_slope_is_that_of_the_drop_and_continuous() {
        let table = table();
        for s in [-0.012, -0.0081, -0.0055, 0.0, 0.004, 0.0099, 0.012] {
            let [drop, slope] = table.at(Dual::<1>::variable(s, 0));
            assert!((drop.eps[0] - slope.re).abs() < 1e-15, "{s}");
        }
        for place in &table.places {
            let [before, after] = [-1e-12, 1e-12].map(|h| table.at(place + h)[1]);
            assert!((before - after).abs() < 1e-11, "{place}");
        }
    }
}
