//! Dry or boundary friction with a smooth transition through zero slip.
//!
//! ```text
//! mu(|du|) = mu_0 tanh(|du| / v_s)
//! ```
//!
//! Coulomb's law jumps at zero slip; the transition speed v_s makes it continuous. It is an assumption: below
//! about v_s the surfaces creep instead of sticking.

use crate::scalar::{Base, Of};

/// Friction coefficient that fades to zero below a transition speed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SolidFriction<B = f64> {
    /// mu_0, coefficient at high slip speed.
    pub coefficient: B,
    /// v_s, m/s.
    pub transition_speed: B,
}

impl SolidFriction {
    /// No friction.
    pub const NONE: Self = Self { coefficient: 0.0, transition_speed: 1.0 };
}

impl<B> SolidFriction<B> {
    /// The same with every constant replaced.
    #[inline(always)]
    pub fn map<U>(&self, f: &mut impl FnMut(&B) -> U) -> SolidFriction<U> {
        SolidFriction { coefficient: f(&self.coefficient), transition_speed: f(&self.transition_speed) }
    }
}

impl<B: Base> SolidFriction<B> {
    /// mu at the slip speed `slip` >= 0 in m/s.
    #[inline(always)]
    pub fn at<T: Of<B>>(&self, slip: T) -> T {
        (slip / self.transition_speed).tanh() * self.coefficient
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn saturates_and_vanishes() {
        let f = SolidFriction { coefficient: 0.1, transition_speed: 0.02 };
        assert_eq!(f.at(0.0), 0.0);
        assert!((f.at(1.0) - 0.1).abs() < 1e-15);
        assert!((f.at(1e-6) - 0.1 * 1e-6 / 0.02).abs() < 1e-14);
    }
}
