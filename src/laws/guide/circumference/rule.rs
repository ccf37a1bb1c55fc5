//! Gauss-Legendre rules for the places of a block, and whether they suit what is integrated.

use crate::scalar::{Lanes, WIDEST, ZEROS};

/// Places of a block: of one panel, or of two that share it.
pub(super) struct Rule {
    /// Nodes on [-1, 1].
    pub nodes: Lanes,
    pub weights: Lanes,
    /// (2 n - 3) P_n-2 + (2 n - 1) P_n-1 at the n nodes of a panel: with weights, the size of the last two terms of the Legendre
    /// series of what stands there.
    last_terms: Lanes,
    /// Largest share that these may have.
    tail: f64,
    of_two: bool,
}

/// One panel.
pub(super) const SIXTEEN: Rule = Rule::of(
    1e-6,
    [
        0.095_012_509_837_637_44,
        0.281_603_550_779_258_9,
        0.458_016_777_657_227_37,
        0.617_876_244_402_643_8,
        0.755_404_408_355_003,
        0.865_631_202_387_831_8,
        0.944_575_023_073_232_6,
        0.989_400_934_991_649_9,
    ],
    [
        0.189_450_610_455_068_5,
        0.182_603_415_044_923_58,
        0.169_156_519_395_002_54,
        0.149_595_988_816_576_73,
        0.124_628_971_255_533_88,
        0.095_158_511_682_492_79,
        0.062_253_523_938_647_894,
        0.027_152_459_411_754_096,
    ],
);

/// Two panels, one in each half of the block.
pub(super) const TWICE_EIGHT: Rule = Rule::of(
    1e-5,
    [0.183_434_642_495_649_8, 0.525_532_409_916_329, 0.796_666_477_413_626_7, 0.960_289_856_497_536_3],
    [0.362_683_783_378_362, 0.313_706_645_877_887_3, 0.222_381_034_453_374_48, 0.101_228_536_290_376_26],
);

impl Rule {
    /// That of these positive nodes, repeated until the block is full.
    const fn of<const N: usize>(tail: f64, nodes: [f64; N], weights: [f64; N]) -> Self {
        let mut rule = Self { nodes: ZEROS, weights: ZEROS, last_terms: ZEROS, tail, of_two: 2 * N < WIDEST };
        let mut i = 0;
        while i < WIDEST {
            let place = i % (2 * N);
            let (x, weight) = if place < N {
                (-nodes[N - 1 - place], weights[N - 1 - place])
            } else {
                (nodes[place - N], weights[place - N])
            };
            rule.nodes[i] = x;
            rule.weights[i] = weight;
            rule.last_terms[i] = last_terms(2 * N, x);
            i += 1;
        }
        rule
    }

    /// Whether the last terms of the series of pressure and stress are small, or at least of round-off, in each part of the
    /// block. A NaN suits, or nothing would.
    #[inline]
    pub fn suits(&self, [pressure, stress, cubes]: [&Lanes; 3], noise: f64) -> [bool; 2] {
        let [first, second] = self.excess(pressure);
        let [pressure, other_pressure] = if first > 0.0 || second > 0.0 {
            // Round-off is asked for only where it may matter.
            let [noisy, other_noisy] = self.totals(cubes);
            [first - noise * noisy, second - noise * other_noisy]
        } else {
            [first, second]
        };
        let [stress, other_stress] = self.excess(stress);
        [!(pressure > 0.0 || stress > 0.0), !(other_pressure > 0.0 || other_stress > 0.0)]
    }

    /// By how much the last terms of each part are larger than they may be.
    #[inline(always)]
    fn excess(&self, parts: &Lanes) -> [f64; 2] {
        let mut products = *parts;
        for (product, term) in products.iter_mut().zip(&self.last_terms) {
            *product *= term;
        }
        let ([tail, other_tail], [whole, other_whole]) = (self.totals(&products), self.totals(parts));
        [tail.abs() - self.tail * whole, other_tail.abs() - self.tail * other_whole]
    }

    /// Sum of each part of the block.
    #[inline(always)]
    fn totals(&self, lanes: &Lanes) -> [f64; 2] {
        if !self.of_two {
            return [total(lanes); 2];
        }
        let mut sums = [0.0; WIDEST / 2];
        for i in 0..4 {
            sums[i] = lanes[i] + lanes[i + 4];
            sums[4 + i] = lanes[8 + i] + lanes[12 + i];
        }
        let [a, b, c, d, e, f, g, h] = sums;
        [(a + c) + (b + d), (e + g) + (f + h)]
    }
}

/// Sum of all lanes, in an order that lets neighbours be added at a time.
#[inline]
pub(in crate::laws::guide) fn total(lanes: &Lanes) -> f64 {
    let mut sums = *lanes;
    for half in [8, 4, 2, 1] {
        for i in 0..half {
            sums[i] += sums[i + half];
        }
    }
    sums[0]
}

/// (2 n - 3) P_n-2 + (2 n - 1) P_n-1 at x, for n >= 2.
const fn last_terms(n: usize, x: f64) -> f64 {
    let (mut before, mut now, mut k) = (1.0, x, 1.0);
    while k < (n - 1) as f64 {
        (before, now) = (now, ((2.0 * k + 1.0) * x * now - k * before) / (k + 1.0));
        k += 1.0;
    }
    (2.0 * k - 1.0) * before + (2.0 * k + 1.0) * now
}
