//! Palmgren's line contact as a reference for reported loads.

/// Palmgren's load of a steel roller of the example on a mate of the given E and nu at an approach in m.
pub fn palmgren_load(approach: f64, length: f64, mate: [f64; 2]) -> f64 {
    (approach / palmgren_compliance(length, mate)).powf(10.0 / 9.0)
}

fn palmgren_compliance(length: f64, [young, poisson]: [f64; 2]) -> f64 {
    let modulus = 2.0 / ((1.0 - 0.3 * 0.3) / 206e9 + (1.0 - poisson * poisson) / young);
    0.39 * (8.0 / modulus).powf(0.9) / length.powf(0.8)
}

pub const STEEL: [f64; 2] = [206e9, 0.3];
pub const BRASS: [f64; 2] = [103e9, 0.34];
