//! Which records an animation shows, and its numbers as small integers.

use serde::Serialize;

/// Most frames of an animation, and most numbers of all its frames together.
const MOST_FRAMES: usize = 601;
const MOST_NUMBERS: usize = 500_000;
/// From one frame to the next cage and whirl turn at most so far, rad: between frames places are interpolated.
const LARGEST_TURN: f64 = 0.5;
/// Integers go so far.
const RANGE: f64 = 32_000.0;

/// Places of the records that are shown, one `stride` apart, up to the last one. `turns` are the angles that cage or whirl turn
/// from each record to the next.
pub fn frames(records: usize, numbers_per_frame: usize, turns: &[f64]) -> Vec<usize> {
    let most = MOST_FRAMES.min(MOST_NUMBERS / numbers_per_frame.max(1)).max(2);
    let mut sorted: Vec<f64> = turns.iter().map(|x| x.abs()).collect();
    sorted.sort_by(f64::total_cmp);
    let usual = sorted.get(sorted.len() * 19 / 20).copied().unwrap_or(0.0);
    let widest = if usual > 0.0 { (LARGEST_TURN / usual) as usize } else { records };
    let stride = records.saturating_sub(1).div_ceil(most - 1).min(widest).max(1);
    let mut places: Vec<usize> = (0..records).rev().step_by(stride).take(most).collect();
    places.reverse();
    places
}

/// Numbers in units of the first field.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Packed {
    unit: f64,
    values: Vec<i32>,
}

impl Packed {
    /// Packs numbers so that the largest of them fits.
    pub fn new(values: &[f64]) -> Self {
        let largest = values.iter().fold(0.0, |m: f64, x| m.max(x.abs()));
        // Few digits: what is multiplied by it has no more.
        let unit: f64 = format!("{:.3e}", largest / RANGE).parse().unwrap_or(0.0);
        let packed = |x: &f64| if unit > 0.0 { (x / unit).round() as i32 } else { 0 };
        Self { unit, values: values.iter().map(packed).collect() }
    }
}

/// Integral of a rate over the records by the trapezoidal rule, zero at the first one.
pub fn integral(times: &[f64], rate: &[f64]) -> Vec<f64> {
    let mut sum = 0.0;
    let mut all = vec![0.0; times.len().min(1)];
    for (t, r) in times.windows(2).zip(rate.windows(2)) {
        sum += 0.5 * (r[0] + r[1]) * (t[1] - t[0]);
        all.push(sum);
    }
    all
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn frames_end_with_the_last_record_and_turn_little() {
        assert_eq!(frames(5, 10, &[0.01; 4]), [0, 1, 2, 3, 4]);
        let all = frames(601, 10, &[0.06; 600]);
        assert_eq!((all[0], all[1] - all[0], all.last()), (0, 1, Some(&600)));
        assert_eq!(frames(602, 10, &[0.06; 601]).len(), 301);
        // So fast that only the end can be shown.
        let end = frames(100_001, 10, &[0.2; 100_000]);
        assert_eq!((end.len(), end[1] - end[0], end.last()), (601, 2, Some(&100_000)));
        let many = frames(100_001, 5000, &[1e-6; 100_000]);
        assert!(many.len() == 99 && many[0] < 1011, "{many:?}");
        assert_eq!(frames(2, 1, &[9.0]), [0, 1]);
    }

    #[test]
    fn packed_numbers_keep_their_digits() {
        let values = [0.0, -1.25e-4, 3.7e-4, 1e-9];
        let packed = Packed::new(&values);
        for (x, n) in values.iter().zip(&packed.values) {
            assert!((x - packed.unit * f64::from(*n)).abs() < 2e-5 * 3.7e-4, "{x} {n}");
        }
        assert_eq!(Packed::new(&[0.0; 3]), Packed { unit: 0.0, values: vec![0; 3] });
    }

    #[test]
    fn rates_are_integrated() {
        assert_eq!(integral(&[0.0, 1.0, 3.0], &[2.0, 4.0, 0.0]), [0.0, 3.0, 7.0]);
        assert!(integral(&[], &[]).is_empty());
    }
}
