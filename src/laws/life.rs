//! Basic reference rating life of a row of rollers by the loads on laminae of its raceways.
//!
//! ```text
//! gamma = D cos(alpha)/D_pw,   G = ((1 - gamma)/(1 + gamma))^(143/108)
//! C_r   = 1.1 f_c (L cos(alpha))^(7/9) Z^(3/4) D^(29/27),   in mm
//! f_c   = 207.9 lambda gamma^(2/9) (1 - gamma)^(29/27)/(1 + gamma)^(1/4) (1 + (1.04 G)^(9/2))^(-2/9)
//! Q_ci  = C_r/(0.378 lambda Z cos(alpha)) (1 + (1.038 G)^(9/2))^(2/9)        inner ring,   lambda = 0.83
//! Q_ce  = C_r/(0.364 lambda Z cos(alpha)) (1 + (1.038 G)^(-9/2))^(2/9)       outer ring
//! q_c   = Q_c n^(-7/9)                                                         of one of n laminae
//! f_k   = 1 - 0.01/ln(1.985 |2 k - n - 1|/(2 n - 2)),   k = 1 .. n             1 in the middle of an odd number
//! q_e,k = (1/Z Sum_j (f_k q_jk)^p)^(1/p)                                       p = 4 of a ring that turns against the load, else 9/2
//! L_10r = (Sum_k (q_ci/q_ei,k)^(-9/2) + (q_ce/q_ee,k)^(-9/2))^(-8/9)           10^6 turns
//! P_ref = C_r L_10r^(-3/10)
//! ```
//!
//! Z rollers of mean diameter D and effective length L in one row, pitch diameter D_pw, contact angle alpha of at most 45 degrees. f is what stress
//! gathers at the ends of profiled rollers under usual loads. Valid for n of at least 30, and for roller bearings of usual steel and make.
//! Sources: ISO/TS 16281:2008, equations 47 to 49 and 56 to 65, and ISO/TR 1281-1 for C_r, both as published programs and textbooks give them.

use crate::scalar::math;

/// Least number of laminae.
pub const LEAST_LAMINAE: usize = 30;

/// Reduction of Lundberg and Palmgren for uneven loads along a roller: lambda nu.
const REDUCTION: f64 = 0.83;
/// Exponent of the load of a ring that stands against the load.
const STANDING: f64 = 4.5;
/// The same of one that turns.
const TURNING: f64 = 4.0;

/// A row of rollers. Lengths in m, angles in rad; arrays are of outer and inner ring.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RollerRow {
    /// Z.
    pub count: usize,
    /// D, of the middle of the rollers.
    pub diameter: f64,
    /// L, which is loaded at most.
    pub effective_length: f64,
    /// D_pw.
    pub pitch_diameter: f64,
    /// alpha, at most 45 degrees.
    pub contact_angle: f64,
    /// Whether each ring turns against the load.
    pub turning: [bool; 2],
}

impl RollerRow {
    /// gamma and G.
    fn ratios(&self) -> [f64; 2] {
        let gamma = self.diameter * math::cos(self.contact_angle) / self.pitch_diameter;
        [gamma, math::powf((1.0 - gamma) / (1.0 + gamma), 143.0 / 108.0)]
    }

    /// C_r by ISO 281, N, of a bearing with machined rings.
    pub fn dynamic_load_rating(&self) -> f64 {
        let [gamma, g] = self.ratios();
        let factor = 207.9 * REDUCTION * math::powf(gamma, 2.0 / 9.0) * math::powf(1.0 - gamma, 29.0 / 27.0)
            / math::powf(1.0 + gamma, 0.25)
            * math::powf(1.0 + math::powf(1.04 * g, STANDING), -2.0 / 9.0);
        let [length, diameter] = [self.effective_length, self.diameter].map(|x| 1e3 * x);
        1.1 * factor
            * math::powf(length * math::cos(self.contact_angle), 7.0 / 9.0)
            * math::powf(self.count as f64, 0.75)
            * math::powf(diameter, 29.0 / 27.0)
    }

    /// Q_ce and Q_ci of a bearing with this C_r, N.
    pub fn ring_ratings(&self, dynamic_load_rating: f64) -> [f64; 2] {
        let [_, g] = self.ratios();
        let per_roller =
            dynamic_load_rating / (REDUCTION * self.count as f64 * math::cos(self.contact_angle));
        let of_ring = |factor: f64, exponent: f64| {
            per_roller / factor * math::powf(1.0 + math::powf(1.038 * g, exponent), 2.0 / 9.0)
        };
        [of_ring(0.364, -STANDING), of_ring(0.378, STANDING)]
    }

    /// q_e of every lamina of both rings, N, of these loads (N) on lamina k of roller j at ring r, `load(r, j, k)`.
    pub fn equivalent_loads(
        &self,
        laminae: usize,
        load: impl Fn(usize, usize, usize) -> f64,
    ) -> [Vec<f64>; 2] {
        [0, 1].map(|ring| {
            let p = if self.turning[ring] { TURNING } else { STANDING };
            let of_lamina = |k: usize| {
                let sum: f64 = (0..self.count).map(|j| math::powf(load(ring, j, k), p)).sum();
                edge_factor(k, laminae) * math::powf(sum / self.count as f64, 1.0 / p)
            };
            (0..laminae).map(of_lamina).collect()
        })
    }
}

/// f of lamina `k` of `n`, counted from 0.
pub fn edge_factor(k: usize, n: usize) -> f64 {
    let from_middle = (2.0 * k as f64 + 1.0 - n as f64).abs();
    if from_middle == 0.0 {
        return 1.0;
    }
    1.0 - 0.01 / math::ln(1.985 * from_middle / (2.0 * n as f64 - 2.0))
}

/// Q_e of both rings, N, by the q_e of their laminae.
pub fn ring_equivalent_loads(equivalent: &[Vec<f64>; 2]) -> [f64; 2] {
    [0, 1].map(|ring| {
        let of = &equivalent[ring];
        let sum: f64 = of.iter().map(|q| math::powf(*q, STANDING)).sum();
        math::powf(of.len() as f64, 7.0 / 9.0) * math::powf(sum, 1.0 / STANDING)
    })
}

/// L_10r in turns of one ring against the other, by Q_c and Q_e of both, N. Without any load infinite.
pub fn reference_life(ratings: [f64; 2], equivalent: [f64; 2]) -> f64 {
    let sum: f64 = (0..2).map(|ring| math::powf(equivalent[ring] / ratings[ring], STANDING)).sum();
    1e6 * math::powf(sum, -8.0 / 9.0)
}

/// P_ref of a bearing with this C_r (N) that lives for so many turns, N.
pub fn reference_load(dynamic_load_rating: f64, turns: f64) -> f64 {
    dynamic_load_rating * math::powf(1e-6 * turns, -0.3)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn near(value: f64, expected: f64, share: f64) {
        assert!((value / expected - 1.0).abs() < share, "{value} {expected}");
    }

    /// A published report of an NU 205 by another program: Q_c, and life and load by Q_e.
    #[test]
    fn a_published_report() {
        let row = RollerRow {
            count: 13,
            diameter: 7.5e-3,
            effective_length: 9e-3,
            pitch_diameter: 39e-3,
            contact_angle: 0.0,
            turning: [false, true],
        };
        let ratings = row.ring_ratings(32_500.0);
        near(ratings[1], 8165.4, 1e-5);
        near(ratings[0], 13_681.3, 1e-5);
        let life = reference_life(ratings, [4523.2, 4331.1]);
        near(life, 11.430e6, 1e-4);
        near(reference_load(32_500.0, life), 15_648.4, 1e-4);
    }

    #[test]
    fn factors_of_the_edges() {
        for (k, expected) in [(0, 2.328327), (1, 1.126603), (2, 1.064124), (29, 2.328327)] {
            near(edge_factor(k, 30), expected, 1e-6);
        }
        assert_eq!(edge_factor(17, 35), 1.0);
    }

    /// f_c of the table of ISO 281.
    #[test]
    fn the_rating_is_that_of_the_tables() {
        for (gamma, expected) in [(0.01, 52.1), (0.05, 74.1), (0.10, 84.2), (0.20, 88.7), (0.30, 83.8)] {
            let row = RollerRow {
                count: 1,
                diameter: 1e-3,
                effective_length: 1e-3,
                pitch_diameter: 1e-3 / gamma,
                contact_angle: 0.0,
                turning: [false, true],
            };
            near(row.dynamic_load_rating() / 1.1, expected, 1e-3);
        }
    }

    /// Six rollers of 9 x 13.6 mm under 1000 N, found by the laminae of the standard: both contacts in series, 35948 N/mm^(10/9).
    #[test]
    fn laminae_of_a_row() {
        const N: usize = 30;
        let (count, diameter, length) = (6, 9e-3, 13.6e-3);
        let row = RollerRow {
            count,
            diameter,
            effective_length: length,
            pitch_diameter: 43.5e-3,
            contact_angle: 0.0,
            turning: [false, true],
        };
        let ratings = row.ring_ratings(31_500.0);
        near(ratings[1], 17_081.177, 1e-7);
        near(ratings[0], 29_794.959, 1e-7);
        let stiffness = 35_948.0 * (1e3 * length).powf(8.0 / 9.0) / N as f64;
        let azimuths: Vec<f64> = (0..count).map(|j| (30.0 + 60.0 * j as f64).to_radians()).collect();
        let place = |k: usize| (k as f64 + 0.5 - 0.5 * N as f64) / N as f64;
        for (profiled, edges, expected) in
            [(false, false, 2_122_334.9), (true, false, 457_274.7), (true, true, 445_570.3)]
        {
            let drop = |k: usize| {
                let part = 2.0 * place(k);
                if profiled { 0.35 * diameter * (1.0 / (1.0 - part * part)).ln() } else { 0.0 }
            };
            let load = |shift: f64, j: usize, k: usize| {
                let delta = 1e3 * shift * azimuths[j].cos() - 2.0 * drop(k);
                stiffness * delta.max(0.0).powf(10.0 / 9.0)
            };
            let carried = |shift: f64| -> f64 {
                let of = |j: usize| (0..N).map(|k| load(shift, j, k)).sum::<f64>() * azimuths[j].cos();
                (0..count).map(of).sum()
            };
            let (mut low, mut high) = (0.0, 1e-3);
            for _ in 0..100 {
                let middle = 0.5 * (low + high);
                if carried(middle) < 1000.0 { low = middle } else { high = middle }
            }
            let mut equivalent = row.equivalent_loads(N, |_, j, k| load(low, j, k));
            if !edges {
                for of_ring in &mut equivalent {
                    of_ring.iter_mut().enumerate().for_each(|(k, q)| *q /= edge_factor(k, N));
                }
            }
            near(1e-6 * reference_life(ratings, ring_equivalent_loads(&equivalent)), expected, 1e-7);
        }
    }
}
