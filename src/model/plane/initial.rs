//! Start of a run: kinematic speeds, and on request the static equilibrium of ring and rollers.

use super::{HostInputs, Plane, StillBearing};
use crate::bodies::{INNER_RING, InputValues, OUTER_RING, ROTOR};
use crate::error::Result;
use crate::scalar::math;
use crate::scene::{RingStart, bad_scene};

/// How often the start of a cage in the centre of its ring and that of the ring are found in turn: each time the difference
/// shrinks by the clearance over the pitch radius.
const PLACINGS: usize = 4;
/// Share of the way to the edges of its pockets that a cage starts at most.
const SHARE_OF_REACH: f64 = 0.9;

impl Plane {
    /// State vector at the start of the run.
    ///
    /// # Errors
    /// [`crate::Status::BadScene`] when no static equilibrium is found, it leaves no room for the cage, or the ring would tilt.
    pub fn initial_state(&self) -> Result<Vec<f64>> {
        if self.scene.has_tilting_rollers() {
            let text = "rollers move over time in the plane only; of a ring that tilts there is the equilibrium: write 'fixed' or 'free'";
            return Err(bad_scene("inner_ring.motion.space", text.to_owned()));
        }
        let inputs = self.inputs.at(0.0, &HostInputs::default());
        let layout = &self.layout;
        let mut state = vec![0.0; layout.states()];
        let (q, v) = state.split_at_mut(layout.positions());
        let [orbit, spin] = self.kinematic_speeds(&inputs);
        let start = &self.scene.initial;
        let guiding = self.guiding_ring();
        let given = self.shared[guiding].as_ref().filter(|ring| ring.mass().is_none());
        let guide_centre = given.map_or([0.0; 2], |ring| ring.motion(&[], &[], &inputs).position);
        let mut cage = start.cage.map_or(guide_centre, |place| [place.y, place.z]);
        if let Some(c) = layout.cage() {
            v[c] = start.cage_velocity.y;
            v[c + 1] = start.cage_velocity.z;
            v[c + 2] = start.cage_speed.unwrap_or(orbit);
        }
        self.place_cage(cage, q);
        self.start_nodes(v);
        let ring = self.motion_of(INNER_RING, q, v, &inputs).position;
        self.place_rotor(ring, &inputs, q);
        if !self.has_rollers() {
            return Ok(state);
        }
        for j in 0..layout.count {
            v[layout.element(j) + 1] = orbit;
            v[layout.spin(j)] = spin;
        }
        if start.inner_ring == RingStart::Equilibrium
            && let Some(mut still) = StillBearing::new(self, orbit)
        {
            let mut rings = self.rings_at_rest(&mut still, q, &inputs)?;
            if guiding == INNER_RING || rings[OUTER_RING] != [0.0; 2] {
                // A cage that starts in the centre of the ring moves the rollers along, and they the ring, by next to nothing.
                for _ in 0..if start.cage.is_none() { PLACINGS } else { 0 } {
                    cage = self.beside(rings[guiding]);
                    self.place_cage(cage, q);
                    rings = self.rings_at_rest(&mut still, q, &inputs)?;
                }
                self.scene.check_cage_start(cage, rings[guiding])?;
            }
            let offsets: Vec<f64> =
                (0..layout.count).map(|j| still.roller(q, j, rings[INNER_RING]).0.radial_offset).collect();
            for ring in [OUTER_RING, INNER_RING] {
                if let Some(i) = layout.shared(ring) {
                    q[i..i + 2].copy_from_slice(&rings[ring]);
                }
            }
            self.place_rotor(rings[INNER_RING], &inputs, q);
            for (j, offset) in offsets.into_iter().enumerate() {
                q[layout.element(j)] = offset;
            }
        }
        Ok(state)
    }

    /// The centre of a ring at `ring` (m), or a place on the way to it that the pockets let the cage reach.
    fn beside(&self, ring: [f64; 2]) -> [f64; 2] {
        let way = math::hypot(ring[0], ring[1]);
        let reach = SHARE_OF_REACH * self.scene.reach_in_pockets().unwrap_or(f64::INFINITY);
        if way > reach { ring.map(|x| x * reach / way) } else { ring }
    }

    /// Sets the rotor to where it rests on its shaft, with the inner ring at `ring` (m).
    fn place_rotor(&self, ring: [f64; 2], inputs: &InputValues, q: &mut [f64]) {
        if let (Some(i), Some(place)) = (self.layout.shared(ROTOR), self.rotor_at_rest(ring, inputs)) {
            q[i..i + 2].copy_from_slice(&place);
        }
    }

    /// Sets the cage centre (m), and the rollers into the middle of their pockets, which lie beside their angles then.
    fn place_cage(&self, cage: [f64; 2], q: &mut [f64]) {
        if let Some(c) = self.layout.cage() {
            q[c..c + 2].copy_from_slice(&cage);
        }
        for j in 0..self.layout.count {
            let (sin, cos) = math::sin_cos(self.elements.set().reference_angles[j]);
            let beside = cage[1] * cos - cage[0] * sin;
            q[self.layout.element(j) + 1] = math::asin(beside / self.pitch_radius());
        }
    }
}
