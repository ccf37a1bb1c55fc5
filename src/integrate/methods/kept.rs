//! What methods keep of a step for questions about it.

/// Appends arrays of equal length.
pub(in crate::integrate) fn keep_parts(parts: &[Vec<f64>], out: &mut Vec<f64>) {
    parts.iter().for_each(|part| out.extend_from_slice(part));
}

/// The arrays that [`keep_parts`] wrote.
pub(in crate::integrate) fn kept_parts<const N: usize>(kept: &[f64]) -> [&[f64]; N] {
    let length = kept.len() / N;
    std::array::from_fn(|i| &kept[i * length..(i + 1) * length])
}
