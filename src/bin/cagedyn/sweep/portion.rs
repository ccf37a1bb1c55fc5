//! One of several parts of a sweep, for machines that each run some of its points.

use super::grid::MOST_POINTS;
use std::fmt;

/// Part `number`, from 1, of `count` parts: every `count`-th point, so that all parts take about as long.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Portion {
    /// Which one.
    pub number: usize,
    /// How many there are.
    pub count: usize,
}

impl Portion {
    /// Whether a point, counted from 0, is of this part.
    pub fn has(self, point: usize) -> bool {
        point % self.count == self.number - 1
    }
}

impl fmt::Display for Portion {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}/{}", self.number, self.count)
    }
}

/// Reads `K/N`.
///
/// # Errors
/// What is allowed.
pub fn parse_portion(text: &str) -> Result<Portion, String> {
    let numbers = text.split_once('/').and_then(|(k, n)| k.parse().ok().zip(n.parse().ok()));
    let portion = numbers.map(|(number, count)| Portion { number, count });
    let allowed = |portion: &Portion| {
        (1..=MOST_POINTS).contains(&portion.count) && (1..=portion.count).contains(&portion.number)
    };
    let refused = || format!("must have the form K/N, with N from 1 to {MOST_POINTS} and K from 1 to N");
    portion.filter(allowed).ok_or_else(refused)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn parts_have_every_point_once() {
        let parts = ["1/3", "2/3", "3/3"].map(|text| parse_portion(text).unwrap());
        for point in 0..10 {
            assert_eq!(parts.iter().filter(|part| part.has(point)).count(), 1);
        }
        assert!(parts[0].has(0) && parts[2].has(5) && parts[1].to_string() == "2/3");
    }

    #[test]
    fn others_are_refused() {
        for bad in ["0/4", "5/4", "x", "", "2", "1/0", "-1/4", "1/4/2", "1.5/4", "1/20001"] {
            assert!(parse_portion(bad).unwrap_err().contains("K from 1 to N"), "{bad}");
        }
    }
}
