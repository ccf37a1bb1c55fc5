//! The elastic ring of a cage: how it bends in its plane.

use crate::scalar::math;
use serde::{Deserialize, Serialize};
use std::f64::consts::PI;

/// Largest order of a wave.
pub(crate) const MOST_RING_ORDERS: u32 = 16;

/// A cage whose ring bends in its plane: a thin ring that does not stretch, with waves of the orders 2 to N around it. Valid
/// for a ring that is thin against its radius (t/a below about 0.1), waves longer than about three pitches of the pockets, and
/// amplitudes below a hundredth of the radius.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct ElasticRing {
    /// Highest order N of the waves, at most half of the number of elements: 4 for trends, 8 for numbers.
    #[cfg_attr(feature = "schema", schemars(range(min = 2, max = 16)))]
    pub modes: u32,
    /// Radius a of the neutral line, m.
    #[cfg_attr(feature = "schema", schemars(range(min = 0.0001, max = 5.0)))]
    pub neutral_radius: f64,
    /// How stiff the ring is.
    pub stiffness: RingStiffness,
    /// Damping zeta of every wave as a share of the critical one: about half of the loss factor of the material and its joints.
    #[cfg_attr(feature = "schema", schemars(range(min = 0.0, max = 1.0)))]
    pub damping: f64,
    /// Growth g_c of the radius with the square of the speed by centrifugal forces, m s^2: (m/(2 pi a)) a^3/(EA).
    #[serde(default)]
    #[cfg_attr(feature = "schema", schemars(range(min = 0.0, max = 1e-6)))]
    pub growth: f64,
    /// Depth at which the solid contact of the guide, which is spread along the bent surface, is as stiff as the one of a round
    /// cage, m.
    #[serde(default = "default_contact_depth")]
    #[cfg_attr(feature = "schema", schemars(range(min = 1e-8, max = 1e-4)))]
    pub contact_depth: f64,
}

fn default_contact_depth() -> f64 {
    1e-6
}

/// Stiffness of the ring.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(rename_all = "snake_case", deny_unknown_fields)]
pub enum RingStiffness {
    /// Bending stiffness EI, N m^2.
    Bending(f64),
    /// From a rectangular section.
    Section(RingSection),
    /// From a finite-element analysis of the cage, for the orders 2 to N.
    FiniteElements(FiniteElementModes),
}

/// Rectangular section of the ring, with pockets through it.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct RingSection {
    /// Young's modulus E, Pa.
    #[cfg_attr(feature = "schema", schemars(range(min = 1e6, max = 1e13)))]
    pub young_modulus: f64,
    /// Width b_0 along the axis, m; of two side rings together, without the pillars.
    #[cfg_attr(feature = "schema", schemars(range(min = 0.0001, max = 5.0)))]
    pub width: f64,
    /// Thickness t along the radius, m.
    #[cfg_attr(feature = "schema", schemars(range(min = 0.0001, max = 1.0)))]
    pub thickness: f64,
    /// Diameter of round pockets in the middle of the width, m, which take their share of the stiffness as beams in series.
    /// Absent: none.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[cfg_attr(feature = "schema", schemars(range(min = 0.0001, max = 5.0)))]
    pub pocket_diameter: Option<f64>,
}

/// Modes of a free cage by a finite-element analysis.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct FiniteElementModes {
    /// Angular frequencies of the orders 2 to N, rad/s.
    pub frequencies: Vec<f64>,
    /// Their modal masses for a radial amplitude of one, kg.
    pub modal_masses: Vec<f64>,
}

impl RingSection {
    /// EI of a ring of neutral radius `a` (m) with this many pockets, N m^2.
    pub fn bending_stiffness(&self, a: f64, pockets: usize) -> f64 {
        let full = self.young_modulus * self.width * self.thickness.powi(3) / 12.0;
        full * self.share_beside_pockets(a, pockets)
    }

    /// k_EI = 1/<b_0/b(s)>: the mean is over one pitch, b(s) the width that is left beside a round pocket.
    pub fn share_beside_pockets(&self, a: f64, pockets: usize) -> f64 {
        let Some(diameter) = self.pocket_diameter else { return 1.0 };
        let (radius, pitch) = (0.5 * diameter, 2.0 * PI * a / pockets as f64);
        let share = diameter / self.width;
        let rest = 1.0 - share * share;
        let turned = 4.0 / rest.sqrt() * math::atan2((1.0 + share).sqrt(), (1.0 - share).sqrt());
        let beside = radius / share * (turned - PI);
        pitch / (pitch - diameter + beside)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn round_pockets_take_their_share_of_the_stiffness() {
        // Machined phenolic cage of an angular contact ball bearing with 25 balls.
        let section = RingSection {
            young_modulus: 9.61e9,
            width: 17e-3,
            thickness: 3.1615e-3,
            pocket_diameter: Some(9.286e-3),
        };
        let a = 45.081e-3;
        let share = section.share_beside_pockets(a, 25);
        assert!((share - 0.598).abs() < 5e-4, "{share}");
        assert!((section.bending_stiffness(a, 25) / 0.2572 - 1.0).abs() < 2e-3);
        // The mean by its definition.
        let (pitch, n) = (2.0 * PI * a / 25.0, 200_000);
        let sum: f64 = (0..n)
            .map(|i| {
                let s = pitch * ((f64::from(i) + 0.5) / f64::from(n) - 0.5);
                let hole = (0.25 * 9.286e-3f64.powi(2) - s * s).max(0.0).sqrt();
                17e-3 / (17e-3 - 2.0 * hole)
            })
            .sum();
        assert!((share * sum / f64::from(n) - 1.0).abs() < 1e-7);
    }
}
