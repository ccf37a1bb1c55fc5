//! Intervals of time in which a sampled quantity is positive, for example the load zone of a roller.

/// Intervals (start, end) in which `values` are above zero. An edge lies midway between the two samples around it;
/// at the ends of the record it is the sample itself.
pub fn positive_intervals(times: &[f64], values: &[f64]) -> Vec<(f64, f64)> {
    let count = times.len().min(values.len());
    let mut found = Vec::new();
    let mut start = None;
    for i in 0..count {
        let edge = if i == 0 { times[0] } else { 0.5 * (times[i - 1] + times[i]) };
        match (values[i] > 0.0, start) {
            (true, None) => start = Some(edge),
            (false, Some(from)) => {
                found.push((from, edge));
                start = None;
            }
            _ => {}
        }
    }
    if let (Some(from), Some(&last)) = (start, times[..count].last()) {
        found.push((from, last));
    }
    found
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn edges_lie_between_samples() {
        let times = [0.0, 1.0, 2.0, 3.0, 4.0, 5.0];
        assert_eq!(positive_intervals(&times, &[0.0, 2.0, 3.0, 0.0, 0.0, 1.0]), [(0.5, 2.5), (4.5, 5.0)]);
        assert_eq!(positive_intervals(&times, &[1.0, 0.0, -1.0, 0.0, 0.0, 0.0]), [(0.0, 0.5)]);
        assert_eq!(positive_intervals(&times, &[1.0; 6]), [(0.0, 5.0)]);
    }

    #[test]
    fn nothing_positive_gives_nothing() {
        assert!(positive_intervals(&[0.0, 1.0], &[0.0, f64::NAN]).is_empty());
        assert!(positive_intervals(&[], &[]).is_empty());
    }
}
