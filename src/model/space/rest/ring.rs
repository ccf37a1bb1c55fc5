//! The inner ring at rest under load and preload, on whatever its elements do to it.

use super::OF_RING;
use super::settle::{Balance, Rest, settle};
use crate::bodies::{RING_COORDINATES, RingInSpace};
use crate::error::{Error, Result, Status};
use crate::scalar::{Dual, math};
use crate::scene::shown;
use crate::space::solid::{LARGEST_TILT, Tilt};
use nalgebra::{Matrix5, Vector5};

/// A direction of the ring with less than this share of the stiffness of a lightly pressed contact has none.
const NO_STIFFNESS: f64 = 1e-9;

/// What elements do to a ring at these coordinates, m and rad; `None` where there is nothing.
pub(super) type Elements<'a> = dyn FnMut(&Vector5<f64>) -> Option<Balance<OF_RING>> + 'a;

/// The ring. Its coordinates are found as lengths: tilts times the pitch radius.
pub(super) struct RingAtRest<'a> {
    pub(super) ring: &'a RingInSpace,
    /// Loads on it, N and N m.
    pub(super) load: [f64; OF_RING],
    /// m.
    pub(super) pitch_radius: f64,
    /// Largest displacement with which it is still in the bearing, m.
    pub(super) reach: f64,
    /// Stiffness of one lightly pressed contact, N/m.
    pub(super) soft: f64,
}

/// The ring of an equilibrium.
pub(crate) struct SettledRing {
    /// By coordinate: where it is held; `None` of one that is free.
    pub(crate) held: [Option<f64>; OF_RING],
    /// Coordinates, m and rad.
    pub(crate) at: Vector5<f64>,
    /// Of all elements on it.
    pub(crate) forces: Balance<OF_RING>,
    /// Rest of the forces on it over their size.
    pub(crate) residual: f64,
    /// Stiffness (N/m at the pitch circle) of the softest free direction, and the coordinate that moves most.
    pub(crate) softest: (f64, &'static str),
}

/// Coordinates of the ring in the axes of an azimuth with this sine and cosine, by row, over those of the bearing.
pub(super) fn beside((s, c): (f64, f64)) -> Matrix5<f64> {
    Matrix5::from_row_slice(&[
        1.0, 0.0, 0.0, 0.0, 0.0, //
        0.0, c, s, 0.0, 0.0, //
        0.0, -s, c, 0.0, 0.0, //
        0.0, 0.0, 0.0, c, s, //
        0.0, 0.0, 0.0, -s, c,
    ])
}

/// The free direction of the ring with the least stiffness: stiffness (N/m) as that of a move at the pitch circle, and the coordinate that
/// moves most.
fn softest(stiffness: &Matrix5<f64>) -> (f64, &'static str) {
    let eigen = stiffness.symmetric_part().symmetric_eigen();
    let (place, value) = eigen.eigenvalues.argmin();
    let (most, _) = eigen.eigenvectors.column(place).abs().argmax();
    let [name, ..] = RING_COORDINATES[most].position.unwrap_or_default();
    (value, name)
}

impl RingAtRest<'_> {
    /// Where it is held; free coordinates are zero, as lengths.
    pub(super) fn start(&self) -> Vector5<f64> {
        let (held, radius) = (self.ring.held.map(|held| held.unwrap_or(0.0)), self.pitch_radius);
        Vector5::new(held[0], held[1], held[2], held[3] * radius, held[4] * radius)
    }

    /// Coordinates, m and rad, from lengths.
    pub(super) fn unscaled(&self, scaled: &Vector5<f64>) -> Vector5<f64> {
        let radius = self.pitch_radius;
        Vector5::new(scaled[0], scaled[1], scaled[2], scaled[3] / radius, scaled[4] / radius)
    }

    /// The rest that is found from these lengths on.
    ///
    /// # Errors
    /// The last lengths, where there is none.
    pub(super) fn settled(
        &self,
        from: Vector5<f64>,
        on_ring: &mut Elements<'_>,
    ) -> std::result::Result<Rest<OF_RING>, Vector5<f64>> {
        settle(from, 1e-3 * self.soft, &mut |scaled| self.balance(scaled, on_ring))
    }

    /// Elements with load and spring, over lengths; coordinates that are held have no force.
    fn balance(&self, scaled: &Vector5<f64>, on_ring: &mut Elements<'_>) -> Option<Balance<OF_RING>> {
        let (ring, radius) = (self.unscaled(scaled), self.pitch_radius);
        if scaled.norm() > self.reach || math::hypot(ring[3], ring[4]) > LARGEST_TILT {
            return None;
        }
        let mut sum = on_ring(&ring)?;
        let [spring, stiffness] = self.ring.spring(ring[0]);
        let [lx, ly, lz, my, mz] = self.load;
        // A moment that keeps its direction, over the angles.
        let tilt = Tilt::new([0, 1].map(|k| Dual::<2>::variable(ring[3 + k], k)));
        let moments = tilt.moments_over_angles([0.0, my, mz].map(|m| Dual { re: m, eps: [0.0; 2] }));
        sum.force += Vector5::new(lx + spring, ly, lz, moments[0].re, moments[1].re);
        sum.stiffness[(0, 0)] += stiffness;
        for (i, moment) in moments.iter().enumerate() {
            for k in 0..2 {
                sum.stiffness[(3 + i, 3 + k)] -= moment.eps[k];
            }
        }
        sum.energy += 0.5 * stiffness * ring[0] * ring[0]
            - (lx + self.ring.spring(0.0)[0]) * ring[0]
            - ly * ring[1]
            - lz * ring[2]
            - my * ring[3]
            - mz * ring[4];
        sum.size += lx.abs() + spring.abs() + ly.abs() + lz.abs() + (my.abs() + mz.abs()) / radius;
        let lengths = Vector5::new(1.0, 1.0, 1.0, 1.0 / radius, 1.0 / radius);
        sum.force.component_mul_assign(&lengths);
        let outer = lengths * lengths.transpose();
        sum.stiffness.component_mul_assign(&outer);
        for (k, held) in self.ring.held.iter().enumerate() {
            if held.is_some() {
                sum.force[k] = 0.0;
                sum.stiffness.row_mut(k).fill(0.0);
                sum.stiffness.column_mut(k).fill(0.0);
                sum.stiffness[(k, k)] = self.soft;
            }
        }
        Some(sum)
    }

    /// The equilibrium of this rest, in which elements do `forces` to the ring.
    ///
    /// # Errors
    /// [`Status::BadState`] where nothing holds it along a coordinate that is free.
    pub(super) fn equilibrium(&self, rest: &Rest<OF_RING>, forces: Balance<OF_RING>) -> Result<SettledRing> {
        let softest = softest(&rest.balance.stiffness);
        let (least, name) = softest;
        if least.abs() <= NO_STIFFNESS * self.soft {
            let text = format!(
                "inner_ring.motion.space.{name}: free, and nothing holds it (stiffness {} N/m at the pitch circle); hold it, or load the \
                 bearing",
                shown(least)
            );
            return Err(Error::new(Status::BadState, text));
        }
        let residual = rest.balance.force.norm() / rest.balance.size.max(f64::MIN_POSITIVE);
        Ok(SettledRing { held: self.ring.held, at: self.unscaled(&rest.x), forces, residual, softest })
    }
}
