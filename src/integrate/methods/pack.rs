//! Flat arrays of numbers for saving and restoring.

/// Appends arrays of equal length.
pub(in crate::integrate) fn keep_parts(parts: &[Vec<f64>], out: &mut Vec<f64>) {
    parts.iter().for_each(|part| out.extend_from_slice(part));
}

/// The arrays that [`keep_parts`] wrote.
pub(in crate::integrate) fn kept_parts<const N: usize>(kept: &[f64]) -> [&[f64]; N] {
    let length = kept.len() / N;
    std::array::from_fn(|i| &kept[i * length..(i + 1) * length])
}

/// Reads numbers in the order they were written.
#[derive(Debug)]
pub struct Reader<'a> {
    rest: &'a [f64],
}

impl<'a> Reader<'a> {
    /// Starts at the first number.
    pub fn new(values: &'a [f64]) -> Self {
        Self { rest: values }
    }

    /// The next number.
    pub fn number(&mut self) -> Option<f64> {
        let (first, rest) = self.rest.split_first()?;
        self.rest = rest;
        Some(*first)
    }

    /// The next number if it is a count.
    pub fn count(&mut self) -> Option<u64> {
        let x = self.number()?;
        (x >= 0.0 && x.fract() == 0.0 && x < 9e15).then_some(x as u64)
    }

    /// The next number if it is 0 or 1.
    pub fn flag(&mut self) -> Option<bool> {
        self.count().filter(|n| *n <= 1).map(|n| n == 1)
    }

    /// Fills `out` with the next numbers.
    pub fn fill(&mut self, out: &mut [f64]) -> Option<()> {
        let (head, rest) = self.rest.split_at_checked(out.len())?;
        out.copy_from_slice(head);
        self.rest = rest;
        Some(())
    }

    /// Whether everything was read.
    pub fn finished(&self) -> bool {
        self.rest.is_empty()
    }
}
