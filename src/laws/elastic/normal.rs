//! Normal force of an elastic contact with damping that is proportional to its stiffness.
//!
//! ```text
//! Q = max(0, Q_el + tau_c s(delta) dQ_el/d(delta) delta_dot),   s = delta/(delta + delta_s)
//! ```
//!
//! Valid for any elastic law Q_el(delta) that is zero at delta <= 0. An assumption of this library (NTN Technical Review 71 names no
//! damping): it is proportional to stiffness, and the factor s lets Q start continuously at first touch.

use crate::scalar::Of;

/// Damping of the normal motion, proportional to the elastic stiffness.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct NormalDamping<B = f64> {
    /// tau_c, ratio of damping to stiffness, s.
    pub relaxation_time: B,
    /// delta_s, approach at which half of the damping is active, m.
    pub softening_depth: B,
}

impl NormalDamping {
    /// No damping.
    pub const NONE: Self = Self { relaxation_time: 0.0, softening_depth: 1.0 };
}

impl<B> NormalDamping<B> {
    /// The same with every constant replaced.
    #[inline(always)]
    pub fn map<U>(&self, f: &mut impl FnMut(&B) -> U) -> NormalDamping<U> {
        NormalDamping { relaxation_time: f(&self.relaxation_time), softening_depth: f(&self.softening_depth) }
    }
}

/// Normal force of a contact and its slopes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct NormalForce<T> {
    /// Q, N; zero when the surfaces are apart.
    pub force: T,
    /// dQ_el/d(delta), N/m.
    pub stiffness: T,
    /// dQ/d(delta_dot), N s/m.
    pub damping: T,
}

impl<T> NormalForce<T> {
    /// From Q_el (N) and dQ_el/d(delta) (N/m) at the approach `delta` (m) and approach speed `delta_dot` (m/s); where `delta` <= 0 they may
    /// be anything.
    #[inline(always)]
    pub fn new<B>(
        elastic: T,
        stiffness: T,
        damping: Option<&NormalDamping<B>>,
        delta: T,
        delta_dot: T,
    ) -> Self
    where
        B: Copy,
        T: Of<B>,
    {
        let zero = delta.like(0.0);
        let coefficient = match damping {
            Some(d) => stiffness * d.relaxation_time * (delta / (delta + d.softening_depth)),
            None => zero,
        };
        let force = elastic + coefficient * delta_dot;
        // Written so that a NaN is passed on and not taken for "apart".
        let apart = delta.at_most(0.0) | force.at_most(0.0);
        Self {
            force: T::select(apart, zero, force),
            stiffness: T::select(apart, zero, stiffness),
            damping: T::select(apart, zero, coefficient),
        }
    }
}
