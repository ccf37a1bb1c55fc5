//! Slices of a line contact whose surfaces are tilted against each other: where it is loaded, and where the slices stand.
//!
//! ```text
//! delta(s) = c_0 + c_1 s + c_2 s^2 - p(s) - p_r(t_0 + t_1 s),   |s| <= a = l/2
//! Q = (1/l) Int (delta(s)/K)^(10/9) ds      where delta(s) > 0, K that of the full length
//! ```
//!
//! p is the profile of the roller, p_r that of the raceway, whose middle is elsewhere where the roller lies beside it. The length is cut where
//! a logarithm begins and where delta is largest or smallest; delta is monotone on every part. Of each the loaded share has the nodes of the
//! same rule as a contact without tilt ([`super::profile`]), which stand close where the load vanishes. With nodes on the whole length
//! the stiffness against tilting would fall at once whenever one of them leaves the contact.
//!
//! Valid for slopes that are small beside one. Slices do not feel each other: a contact that is loaded on a short part is a little too stiff.
//! Source of the sum: ISO/TS 16281, with its spring constant of the full length in every slice.

use super::profile::{Profile, USUAL_SLICES, nodes};
use super::surface::Surface;

/// Halvings of a part in which the slope or the approach changes its sign: down to 1e-9 of the length.
const HALVINGS: usize = 30;

/// How the surfaces of a contact approach each other along its length.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Along<'a> {
    /// Profiles of roller and raceway; without them both are straight.
    pub profile: Option<&'a Surface>,
    /// a, m.
    pub half_length: f64,
    /// c_0, m, c_1, and c_2, 1/m.
    pub approach: [f64; 3],
    /// t_0, m, and t_1.
    pub in_raceway: [f64; 2],
}

/// A slice.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Slice {
    /// s, m from the middle of the roller.
    pub place: f64,
    /// Share of the length l.
    pub share: f64,
}

impl Along<'_> {
    /// The parabola through approaches (m) without profiles at -a, 0 and a.
    pub fn parabola(half_length: f64, [low, middle, high]: [f64; 3]) -> [f64; 3] {
        let bend = 0.5 * (high + low) - middle;
        [middle, 0.5 * (high - low) / half_length, bend / (half_length * half_length)]
    }

    /// delta at `s`, m.
    pub(super) fn depth(&self, s: f64) -> f64 {
        let ([c0, c1, c2], [t0, t1]) = (self.approach, self.in_raceway);
        let parabola = c0 + s * (c1 + s * c2);
        match self.profile {
            Some(profile) => parabola - profile.of_roller(s) - profile.of_raceway(t0 + t1 * s)[0],
            None => parabola,
        }
    }

    /// Whether delta grows from `s` on towards larger s, by a difference within `step` (m).
    fn grows(&self, s: f64, step: f64) -> bool {
        self.depth(s + step) > self.depth(s)
    }

    /// Adds the slices of the loaded part.
    pub fn slices(&self, out: &mut Vec<Slice>) {
        let a = self.half_length;
        let start = self.profile.map_or(0.0, Surface::start);
        if start > 0.0 && start < a {
            for [from, to] in [[-start, start], [-start, -a], [start, a]] {
                self.part(from, to, out);
            }
        } else {
            self.part(-a, a, out);
        }
    }

    /// Those between two places where the profile is smooth: cut at an extremum.
    fn part(&self, from: f64, to: f64, out: &mut Vec<Slice>) {
        let step = 1e-4 * (to - from);
        let (first, last) = (self.grows(from, step), self.grows(to - step, step));
        if first == last {
            return self.monotone(from, to, out);
        }
        let (mut low, mut high) = (from, to - step);
        for _ in 0..HALVINGS {
            let middle = 0.5 * (low + high);
            if self.grows(middle, step) == first {
                low = middle;
            } else {
                high = middle;
            }
        }
        // The difference is the slope in its middle.
        let extremum = low + 0.5 * step;
        self.monotone(extremum, from, out);
        self.monotone(extremum, to, out);
    }

    /// Those of a part along which delta grows or falls.
    fn monotone(&self, from: f64, to: f64, out: &mut Vec<Slice>) {
        let (deep, mut end) = if self.depth(from) >= self.depth(to) { (from, to) } else { (to, from) };
        if self.depth(deep) <= 0.0 {
            return;
        }
        if self.depth(end) < 0.0 {
            let (mut loaded, mut free) = (deep, end);
            for _ in 0..HALVINGS {
                let middle = 0.5 * (loaded + free);
                if self.depth(middle) > 0.0 {
                    loaded = middle;
                } else {
                    free = middle;
                }
            }
            end = loaded;
        }
        let nodes = self
            .profile
            .and_then(|surface| surface.profile.as_ref())
            .map_or_else(|| nodes(USUAL_SLICES), Profile::nodes);
        let length = (end - deep).abs() / (2.0 * self.half_length);
        out.extend(
            nodes
                .iter()
                .map(|node| Slice { place: deep + (end - deep) * node.place, share: length * node.weight }),
        );
    }
}

#[cfg(test)]
mod tests {
    use super::super::profile::Logarithm;
    use super::*;

    const LENGTH: f64 = 0.0204;

    /// Integral of (delta/1 um)^(10/9) ds/l over the loaded part, and of the same times s/a.
    fn by_slices(along: &Along<'_>) -> [f64; 2] {
        let mut slices = Vec::new();
        along.slices(&mut slices);
        let of = |slice: &Slice| slice.share * (1e6 * along.depth(slice.place)).max(0.0).powf(10.0 / 9.0);
        [
            slices.iter().map(of).sum(),
            slices.iter().map(|slice| of(slice) * slice.place / along.half_length).sum(),
        ]
    }

    /// The same by a hundred thousand equal laminae.
    fn by_laminae(along: &Along<'_>) -> [f64; 2] {
        let n = 100_000;
        let mut sum = [0.0; 2];
        for i in 0..n {
            let x = (2.0 * f64::from(i) + 1.0) / f64::from(n) - 1.0;
            let load = (1e6 * along.depth(x * along.half_length)).max(0.0).powf(10.0 / 9.0) / f64::from(n);
            sum[0] += load;
            sum[1] += load * x;
        }
        sum
    }

    #[test]
    fn slices_are_the_integral_whatever_the_tilt() {
        let logarithm = Logarithm::new(1.5e-6, LENGTH, 0.6, Some(12e-6));
        let log = Surface::new(Profile::new(LENGTH, Some(logarithm), [None, None], 16).unwrap());
        let crown = Surface::new(Profile::new(LENGTH, None, [Some(3.0), Some(20.0)], 8).unwrap());
        for (name, profile, allowed) in
            [("straight", None, 1e-4), ("crowned", Some(&crown), 2e-4), ("logarithm", Some(&log), 1e-3)]
        {
            for depth in [2e-6, 6e-6, 12e-6] {
                for tilt in [0.0, 1e-4, 5e-4, 2e-3] {
                    for bend in [0.0, 0.05, -0.02] {
                        let approach = [depth, tilt, bend];
                        let along =
                            Along { profile, half_length: 0.5 * LENGTH, approach, in_raceway: [4e-5, 1.0] };
                        let ([load, moment], [of_load, of_moment]) = (by_slices(&along), by_laminae(&along));
                        let error =
                            ((load - of_load) / of_load).abs().max((moment - of_moment).abs() / of_load);
                        assert!(
                            error < allowed,
                            "{name} {approach:?}: {load} {of_load} {moment} {of_moment}"
                        );
                    }
                }
            }
        }
    }

    #[test]
    fn a_roller_that_lies_on_its_ends_is_loaded_there() {
        let approach = [-1e-6, 0.0, 0.03];
        let along = Along { profile: None, half_length: 0.5 * LENGTH, approach, in_raceway: [0.0, 1.0] };
        let mut slices = Vec::new();
        along.slices(&mut slices);
        assert_eq!(slices.len(), 2 * USUAL_SLICES);
        assert!(slices.iter().all(|slice| along.depth(slice.place) > 0.0));
        let ([load, moment], [of_load, _]) = (by_slices(&along), by_laminae(&along));
        assert!(
            (load / of_load - 1.0).abs() < 1e-4 && moment.abs() < 1e-9 * load,
            "{load} {of_load} {moment}"
        );
    }

    #[test]
    fn what_is_apart_has_no_slices() {
        let along = Along {
            profile: None,
            half_length: 0.5 * LENGTH,
            approach: [-1e-6, 1e-5, 0.0],
            in_raceway: [0.0, 1.0],
        };
        let mut slices = Vec::new();
        along.slices(&mut slices);
        assert!(slices.is_empty());
    }
}
