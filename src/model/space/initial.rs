//! Start of a run: on request ring and balls in the steady motion of their own friction, or where nothing drives a ball in that of outer race
//! control, or of none where there is no such motion; else undisplaced, at kinematic speeds.

use super::rest::{RaceControl, settled};
use super::{HostInputs, Space};
use crate::bodies::{CAGE, OF_BALL, OF_CAGE, RingInSpace};
use crate::error::Result;
use crate::scalar::math;
use crate::scene::{PlaneVector, RingStart};

impl Space {
    /// State vector at the start of the run.
    ///
    /// # Errors
    /// [`crate::Status::BadScene`] where a free coordinate has no inertia; [`crate::Status::BadState`] when no equilibrium is found.
    pub(crate) fn initial_state(&self) -> Result<Vec<f64>> {
        RingInSpace::can_move(&self.scene)?;
        let mut state = vec![0.0; self.layout.states()];
        let (q, v) = state.split_at_mut(self.layout.positions());
        if !self.free {
            self.start_cage([0.0; 2], q, v);
            return Ok(state);
        }
        if self.rollers.is_some() {
            let ring = self.start_rollers(q, v)?;
            self.start_cage(ring, q, v);
            return Ok(state);
        }
        let mut guide = [0.0; 2];
        let mut motions = vec![self.kinematic_motion(); self.set.count];
        if self.scene.initial.inner_ring == RingStart::Equilibrium {
            let found = settled(self, RaceControl::Friction)
                .or_else(|_| settled(self, RaceControl::Outer))
                .or_else(|error| settled(self, RaceControl::None).map_err(|_| error))?;
            for (q, k) in q.iter_mut().zip(self.ring.free()) {
                *q = found.ring.at[k];
            }
            guide = [found.ring.at[1], found.ring.at[2]];
            for (j, motion) in motions.iter_mut().enumerate() {
                *motion = found.balls[j].motion((found.bearing.beside(j) * found.ring.at).into());
            }
        }
        for (j, [x, rho, orbit, wx, wr, wt]) in motions.into_iter().enumerate() {
            let places = self.layout.of_element::<OF_BALL>(j);
            (q[places[0]], q[places[1]]) = (x, rho);
            for (place, speed) in places[2..].iter().zip([orbit, wx, wr, wt]) {
                v[*place] = speed;
            }
        }
        self.start_cage(guide, q, v);
        Ok(state)
    }

    /// Places the cage, upright in the middle of the ring that guides it, whose centre is at `ring` (m) if it is the inner one, unless the
    /// scene says where.
    fn start_cage(&self, ring: [f64; 2], q: &mut [f64], v: &mut [f64]) {
        let Some(cage) = &self.cage else { return };
        let start = &self.scene.initial;
        let guided_by_inner = cage.lands.first().is_some_and(|land| land.ring == 1);
        let held = [1, 2].map(|k| self.ring.held[k].unwrap_or(0.0));
        let [y, z] = match (start.cage, guided_by_inner) {
            (Some(place), _) => [place.y, place.z],
            (None, true) => [0, 1].map(|k| if ring[k] == 0.0 { held[k] } else { ring[k] }),
            (None, false) => [0.0; 2],
        };
        let PlaneVector { y: vy, z: vz } = start.cage_velocity;
        let rest = start.cage_space.unwrap_or_default();
        let [orbit, _] = self.kinematic_speeds(&self.inputs.at(0.0, &HostInputs::default()));
        let speed = start.cage_speed.unwrap_or(orbit);
        let first = self.layout.range(CAGE).start;
        let at = first..first + OF_CAGE;
        q[at.clone()].copy_from_slice(&[rest.x, y, z, 0.0, rest.tilt_y, rest.tilt_z]);
        v[at].copy_from_slice(&[rest.velocity_x, vy, vz, speed, rest.tilt_speed_y, rest.tilt_speed_z]);
    }

    /// x and rho, psi', w_x, w_r, w_psi of an undisplaced ball that rolls at the free contact angle.
    fn kinematic_motion(&self) -> [f64; 6] {
        let inputs = self.inputs.at(0.0, &HostInputs::default());
        let [orbit, spin] = self.kinematic_speeds(&inputs);
        let (sin, cos) = math::sin_cos(self.free_contact_angle());
        [0.0, 0.0, orbit, spin, (orbit - spin) * sin / cos, 0.0]
    }
}
