//! Breaks of the film between two circles, in closed form.
//!
//! ```text
//! h = h_L    sin^2(d/2) = (h_L - C + e)/2e
//! G = 0      a cos d + b sin d = 0,   a = -s v_1,   b = (w_1 + w_2) e - s v_2
//! ```
//!
//! s is 2, or 0 for a film that is not squeezed. Without lobes h and G are of order one: there are at most two places of either, and
//! nothing has to be searched for.

use super::gap::Gap;
use super::stretch::{Breaks, DRY, FUNCTIONS, OPENING};
use crate::scalar::math;
use std::f64::consts::PI;

/// The whole circle.
pub(in crate::laws::guide) struct Circle {
    /// Whether each of the functions is negative at its start, -pi.
    pub negative: [bool; FUNCTIONS],
    pub breaks: Breaks<4>,
}

/// The circle of a gap that has no lobes; h_L in m.
pub(in crate::laws::guide) fn circle(gap: &Gap<'_>, layer: f64) -> Circle {
    let mut out = Circle { negative: [false; FUNCTIONS], breaks: Breaks::none() };
    let e = gap.eccentricity;
    // Infinite in a clearance full of oil, and where the journal is centred.
    let share = (layer - gap.thinnest) / (2.0 * e);
    if share >= 1.0 {
        out.negative[DRY] = true;
    } else if share > 0.0 {
        let edge = 2.0 * math::atan2(share.sqrt(), (1.0 - share).sqrt());
        out.breaks.add(-edge, DRY);
        out.breaks.add(edge, DRY);
    }
    let [v_1, v_2] = gap.velocity;
    let (a, b) = (-gap.squeeze * v_1, gap.turning * e - gap.squeeze * v_2);
    // Written so that a NaN has no breaks.
    if a.abs() + b.abs() > 0.0 {
        // G grows here, and falls half a turn away.
        let grows = math::atan2(-a, b);
        let falls = if grows > 0.0 { grows - PI } else { grows + PI };
        out.negative[OPENING] = grows < falls;
        out.breaks.add(grows, OPENING);
        out.breaks.add(falls, OPENING);
    }
    out
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::laws::guide::circumference::breaks::Search;
    use crate::laws::guide::circumference::gap::Lobe;
    use crate::laws::guide::circumference::samples::with_memory;
    use crate::laws::guide::circumference::stretch::{Aims, Stretch};
    use crate::laws::guide::journal::tests::motion;
    use pulp::Arch;

    /// What the search finds where it is told of a lobe that has no height.
    fn searched(gap: &Gap<'_>, layer: f64) -> (Vec<(usize, f64)>, [bool; 2]) {
        let lobes = [Lobe { order: 2, ..Lobe::default() }];
        let gap = Gap { lobes: &lobes, ..*gap };
        let (mut found, mut start) = (Vec::new(), None);
        with_memory(gap.order(), |memory| {
            let mut search = Search::new(&gap, layer, Aims::Edges, Arch::new(), memory);
            let mut stretch = Stretch::new();
            while search.next(&mut stretch) {
                start.get_or_insert([stretch.negative[DRY], stretch.negative[OPENING]]);
                found.extend(stretch.breaks.all().iter().map(|b| (b.of, b.angle)));
            }
        });
        // It ends where it started, within the first step.
        for (_, angle) in found.iter_mut().filter(|(_, angle)| *angle > PI) {
            *angle -= 2.0 * PI;
        }
        found.sort_by(|a, b| a.1.total_cmp(&b.1));
        (found, start.unwrap_or_default())
    }

    #[test]
    fn breaks_are_those_that_the_search_finds() {
        let mut all = [0; 5];
        for i in 0..400 {
            let x = |k: f64| (f64::from(i) * k).sin();
            let e = 90e-6 * (1.01 + x(0.7));
            let m = motion([e, 0.0], [0.05 * x(1.3), 0.05 * x(2.9)], 200.0 * x(0.31));
            let mut gap = Gap::new([46e-3, 0.2e-3], &m, e, [1.0, 0.0], &[]);
            if i % 7 == 0 {
                gap.squeeze = 0.0;
            }
            let layer = if i % 5 == 0 { f64::INFINITY } else { 0.2e-3 * (1.1 + x(4.1)) };
            let found = circle(&gap, layer);
            let (expected, negative) = searched(&gap, layer);
            // Where the circle begins, a place of it may be found at either end; in dry parts it is not looked for.
            let film = |angle: f64| gap.thinnest + 2.0 * e * (0.5 * angle).sin().powi(2);
            let seen = |(of, angle): &(usize, f64)| {
                angle.abs() < PI - 1e-9 && (*of == DRY || film(*angle) < 0.9 * layer)
            };
            let all_of_it: Vec<_> = found.breaks.all().iter().map(|b| (b.of, b.angle)).collect();
            let angles: Vec<_> = all_of_it.iter().copied().filter(seen).collect();
            let expected: Vec<_> = expected.into_iter().filter(seen).collect();
            all[angles.len()] += 1;
            assert_eq!(angles.len(), expected.len(), "{i}: {angles:?} {expected:?}");
            for of in [DRY, OPENING] {
                let only = |breaks: &[(usize, f64)]| -> Vec<f64> {
                    breaks.iter().filter(|b| b.0 == of).map(|b| b.1).collect()
                };
                for (a, b) in only(&angles).into_iter().zip(only(&expected)) {
                    assert!((a - b).abs() < 1e-7, "{i}: {a} {b}");
                }
            }
            if all_of_it.iter().all(|b| b.1.abs() < PI - 0.1) {
                assert_eq!([found.negative[DRY], found.negative[OPENING]], negative, "{i}");
            }
        }
        assert!(all.iter().all(|count| *count > 5), "{all:?}");
    }

    #[test]
    fn a_journal_that_only_turns_has_the_pressure_of_half_the_circle() {
        let m = motion([1e-4, 0.0], [0.0; 2], 100.0);
        let gap = Gap::new([46e-3, 0.2e-3], &m, 1e-4, [1.0, 0.0], &[]);
        let found = circle(&gap, f64::INFINITY);
        let angles: Vec<f64> = found.breaks.all().iter().map(|b| b.angle).collect();
        assert_eq!(angles, [0.0, PI]);
        assert!(found.negative[DRY] && found.negative[OPENING]);
        let still = motion([1e-4, 0.0], [0.0; 2], 0.0);
        let found = circle(&Gap::new([46e-3, 0.2e-3], &still, 1e-4, [1.0, 0.0], &[]), 0.05e-3);
        assert!(found.breaks.all().is_empty() && found.negative == [false; 3]);
    }
}
