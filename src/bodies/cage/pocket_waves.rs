//! How waves of the cage displace its pockets, many pockets at a time.

use crate::scalar::{Columns, Lanes, Pack, WIDEST, ZEROS, blocks_for, dispatch, place_of};
use pulp::{Arch, Simd};

/// How each coordinate displaces each pocket, outwards and counter-clockwise, per unit.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct PocketWaves {
    /// Of each coordinate, by blocks of pockets.
    blocks: Vec<Vec<[Lanes; 2]>>,
}

impl PocketWaves {
    /// From what every coordinate does to each pocket.
    pub fn new(of_pockets: &[Vec<[f64; 2]>]) -> Self {
        let coordinates = of_pockets.first().map_or(0, Vec::len);
        let mut blocks = vec![vec![[ZEROS; 2]; coordinates]; blocks_for(of_pockets.len())];
        for (j, of_pocket) in of_pockets.iter().enumerate() {
            let (block, lane) = place_of(j);
            for (columns, of) in blocks[block].iter_mut().zip(of_pocket) {
                for (column, x) in columns.iter_mut().zip(of) {
                    column[lane] = *x;
                }
            }
        }
        Self { blocks }
    }

    /// Displacements of the pockets of a block, or their rates, by these amplitudes (m), or theirs.
    pub fn displace(&self, block: usize, amplitudes: &[f64], out: &mut [Lanes; 2], instructions: Arch) {
        if let Some(waves) = self.blocks.get(block) {
            dispatch(instructions, Sum { waves, amplitudes, out });
        }
    }
}

struct Sum<'a> {
    waves: &'a [[Lanes; 2]],
    amplitudes: &'a [f64],
    out: &'a mut [Lanes; 2],
}

impl Columns for Sum<'_> {
    fn rows(&self) -> usize {
        WIDEST
    }

    #[inline(always)]
    fn group<S: Simd, const K: usize>(&mut self, simd: S, first: usize) {
        let zero = Pack::<S, K>::all(simd, 0.0);
        let [mut outwards, mut ahead] = [zero; 2];
        for ([x, y], amplitude) in self.waves.iter().zip(self.amplitudes) {
            outwards += Pack::load(simd, &x[first..]) * *amplitude;
            ahead += Pack::load(simd, &y[first..]) * *amplitude;
        }
        outwards.store(&mut self.out[0][first..]);
        ahead.store(&mut self.out[1][first..]);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::bodies::displaced;

    #[test]
    fn blocks_are_displaced_as_each_pocket_is() {
        let of_pockets: Vec<Vec<[f64; 2]>> = (0..20)
            .map(|j| (0..6).map(|k| [f64::from(j * 7 + k).sin(), f64::from(j + 5 * k).cos()]).collect())
            .collect();
        let waves = PocketWaves::new(&of_pockets);
        let amplitudes = [1e-6, -2e-6, 3e-7, 4e-6, 0.0, 1e-5];
        for (block, pockets) in of_pockets.chunks(WIDEST).enumerate() {
            for instructions in [Arch::Scalar, Arch::new()] {
                let mut out = [ZEROS; 2];
                waves.displace(block, &amplitudes, &mut out, instructions);
                for (lane, of_pocket) in pockets.iter().enumerate() {
                    assert_eq!([out[0][lane], out[1][lane]], displaced(of_pocket, &amplitudes));
                }
            }
        }
    }
}
