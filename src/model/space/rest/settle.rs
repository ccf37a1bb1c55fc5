//! Where forces vanish: Newton's method with a Levenberg-Marquardt parameter.
//!
//! ```text
//! (K + m I) s = f,   K = -df/dx
//! ```
//!
//! A step is taken where it lowers the energy or halves the force; m shrinks then, and grows otherwise. Without stiffness, as in a
//! clearance, steps follow the force. At the end, where an energy drowns in round-off, the force alone tells progress.

use nalgebra::{DMatrix, DVector, SMatrix, SVector};

/// Most steps; about twenty are usual.
const MAX_STEPS: usize = 400;
/// Change of the parameter after a step that is taken, and after one that is not.
const SHRINKS: f64 = 0.1;
const GROWS: f64 = 8.0;
/// Share of the forces that add up to zero at which a rest is round-off.
const ROUND_OFF: f64 = 1e-13;
/// A rest of this share is accepted where no step makes it smaller.
const ACCEPTED: f64 = 1e-9;
/// Rest in N that is none beside any load of interest.
const NEGLIGIBLE: f64 = 1e-9;

/// Forces at a point.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Balance<const N: usize> {
    /// f, N.
    pub(crate) force: SVector<f64, N>,
    /// K, N/m.
    pub(crate) stiffness: SMatrix<f64, N, N>,
    /// Energy, J, that falls along the force.
    pub(super) energy: f64,
    /// Size of the forces that add up to f, N.
    pub(super) size: f64,
}

impl<const N: usize> Balance<N> {
    /// Whether what is left of the force is round-off.
    pub(super) fn is_rest(&self) -> bool {
        self.force.norm() <= ROUND_OFF * (self.size + NEGLIGIBLE)
    }

    /// Whether it may count as one where no step makes it smaller.
    pub(super) fn is_nearly_rest(&self) -> bool {
        self.force.norm() <= ACCEPTED * self.size + NEGLIGIBLE
    }
}

/// A point of rest.
pub(super) struct Rest<const N: usize> {
    pub(super) x: SVector<f64, N>,
    pub(super) balance: Balance<N>,
}

/// Finds a point of rest from `start` (m); `soft` is a stiffness (N/m) that first steps without any are made with. `forces` answers `None`
/// where there are none, such as out of the bearing.
///
/// # Errors
/// The last point, where none was found.
pub(super) fn settle<const N: usize>(
    start: SVector<f64, N>,
    soft: f64,
    forces: &mut dyn FnMut(&SVector<f64, N>) -> Option<Balance<N>>,
) -> Result<Rest<N>, SVector<f64, N>> {
    let mut x = start;
    let mut here = forces(&x).ok_or(x)?;
    let mut parameter = soft;
    for _ in 0..MAX_STEPS {
        let rest = here.force.norm();
        if here.is_rest() {
            return Ok(Rest { x, balance: here });
        }
        let pressed = here.stiffness + SMatrix::identity() * parameter;
        let pressed = DMatrix::from_column_slice(N, N, pressed.as_slice());
        let step = pressed.lu().solve(&DVector::from_column_slice(here.force.as_slice()));
        let to = step.map(|step| x + SVector::from_column_slice(step.as_slice()));
        let there = to.and_then(|to| Some((to, forces(&to)?)));
        let better = there.filter(|(_, there)| {
            there.energy < here.energy && there.force.norm() < 4.0 * rest || there.force.norm() < 0.5 * rest
        });
        match better {
            Some((to, there)) => {
                (x, here) = (to, there);
                parameter *= SHRINKS;
            }
            None if parameter > 1e12 * soft => break,
            None => parameter = GROWS * parameter.max(1e-6 * soft),
        }
    }
    if here.is_nearly_rest() {
        return Ok(Rest { x, balance: here });
    }
    Err(x)
}
