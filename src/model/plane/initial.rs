//! Start of a run: kinematic speeds, and on request the static equilibrium of ring and rollers.

use super::{HostInputs, Input, InputValues, Plane};
use crate::bodies::{ElementMotion, ForceSource, INNER_RING};
use crate::error::{Error, Result, Status};
use crate::laws::line_contact::LineContact;
use crate::pairs::raceway::{RacewayGeometry, RingMotion};
use crate::scalar::math;
use crate::scene::{RingMotion as Held, RingStart};
use crate::space::Frame;

/// Steps for the equilibrium of the ring; about twenty are usual.
const MAX_ITERATIONS: usize = 500;
/// How often the start of a cage in the centre of its ring and that of the ring are found in turn: each time the difference
/// shrinks by the clearance over the pitch radius.
const PLACINGS: usize = 4;
/// Share of the way to the edges of its pockets that a cage starts at most.
const SHARE_OF_REACH: f64 = 0.9;
/// Accepted residual force in N, far below any load of interest.
const NEGLIGIBLE_FORCE: f64 = 1e-9;
/// Accepted residual force relative to the load.
const TOLERANCE: f64 = 1e-10;

impl Plane {
    /// State vector at the start of the run.
    ///
    /// # Errors
    /// [`Status::BadScene`] when no static equilibrium is found, or it leaves no room for the cage.
    pub fn initial_state(&self) -> Result<Vec<f64>> {
        let inputs = self.inputs.at(0.0, &HostInputs::default());
        let layout = &self.layout;
        let mut state = vec![0.0; layout.states()];
        let (q, v) = state.split_at_mut(layout.positions());
        let [orbit, spin] = self.kinematic_speeds(&inputs);
        let start = &self.scene.initial;
        let inner_guide = self.guiding_ring() == INNER_RING;
        let mut cage = match (start.cage, self.scene.inner_ring.as_ref().map(|ring| &ring.motion)) {
            (Some(place), _) => [place.y, place.z],
            (None, Some(Held::Fixed(place))) if inner_guide => [place.y, place.z],
            _ => [0.0; 2],
        };
        if let Some(c) = layout.cage() {
            v[c] = start.cage_velocity.y;
            v[c + 1] = start.cage_velocity.z;
            v[c + 2] = start.cage_speed.unwrap_or(orbit);
        }
        self.place_cage(cage, q);
        self.start_nodes(v);
        if !self.has_rollers() {
            return Ok(state);
        }
        for j in 0..layout.count {
            v[layout.element(j) + 1] = orbit;
            v[layout.spin(j)] = spin;
        }
        if start.inner_ring == RingStart::Equilibrium
            && let Some(i) = layout.ring()
            && let Some(mass) = self.shared[INNER_RING].as_ref().and_then(|ring| ring.mass())
            && let Some(geometry) = self.raceway_geometry()
            && let [Some(outer), Some(inner)] =
                [ForceSource::OuterRaceway, ForceSource::InnerRaceway].map(|ring| self.law_of(ring)?.line())
        {
            let laws = [outer, inner];
            let load = [
                inputs.of(Input::LoadY) + mass * self.gravity[0],
                inputs.of(Input::LoadZ) + mass * self.gravity[1],
            ];
            let centrifugal = self.elements.centrifugal(orbit);
            let find =
                |q: &[f64]| StillBearing { model: self, geometry, laws, q, centrifugal }.equilibrium(load);
            let mut ring = find(q)?;
            if inner_guide {
                // A cage that starts in the centre of the ring moves the rollers along, and they the ring, by next to nothing.
                for _ in 0..if start.cage.is_none() { PLACINGS } else { 0 } {
                    cage = self.beside(ring);
                    self.place_cage(cage, q);
                    ring = find(q)?;
                }
                self.scene.check_cage_start(cage, ring)?;
            }
            let still = StillBearing { model: self, geometry, laws, q, centrifugal };
            let offsets: Vec<f64> =
                (0..layout.count).map(|j| still.roller(j, ring).0.radial_offset).collect();
            q[i] = ring[0];
            q[i + 1] = ring[1];
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

/// The rollers of a bearing in which nothing moves but for the centrifugal force.
struct StillBearing<'a> {
    model: &'a Plane,
    geometry: RacewayGeometry,
    /// Of outer and inner ring.
    laws: [&'a LineContact; 2],
    q: &'a [f64],
    /// On each roller, N.
    centrifugal: f64,
}

impl StillBearing<'_> {
    /// Position of the ring, m, at which the rollers carry `load` (N): the minimum of the potential energy, found by
    /// Newton steps whose length a Levenberg-Marquardt parameter controls.
    fn equilibrium(&self, load: [f64; 2]) -> Result<[f64; 2]> {
        let mut size = math::hypot(load[0], load[1]);
        let mut x = [0.0; 2];
        let mut here = self.ring_balance(x, load);
        // Rollers of different size press on a ring without a load, too, and what they cancel has a round-off.
        if self.model.elements.set().radius_excess.iter().any(|excess| *excess != 0.0) {
            size += here.pressing;
        }
        if size == 0.0 {
            return Ok(x);
        }
        let reach = (2.0 * self.geometry.gap).max(0.0) + 2.0 * self.laws[1].approach(size);
        let mut parameter = size / reach;
        for _ in 0..MAX_ITERATIONS {
            let residual = math::hypot(here.force[0], here.force[1]);
            if residual <= TOLERANCE * size + NEGLIGIBLE_FORCE {
                return Ok(x);
            }
            let [kyy, kyz, kzz] = here.stiffness;
            let (kyy, kzz) = (kyy + parameter, kzz + parameter);
            let determinant = kyy * kzz - kyz * kyz;
            let [fy, fz] = here.force;
            let trial =
                [x[0] + (kzz * fy - kyz * fz) / determinant, x[1] + (kyy * fz - kyz * fy) / determinant];
            let there = self.ring_balance(trial, load);
            // Close to the minimum the energy drowns in round-off, and the force alone tells progress.
            let better =
                there.energy < here.energy || math::hypot(there.force[0], there.force[1]) < 0.5 * residual;
            if better {
                (x, here) = (trial, there);
            }
            parameter *= if better { 0.2 } else { 5.0 };
        }
        let text = format!(
            "initial.inner_ring: no static equilibrium found for a load of ({:?}, {:?}) N; start 'centred' instead",
            load[0], load[1]
        );
        Err(Error::new(Status::BadScene, text))
    }

    /// Energy, force and stiffness of the ring at `x` under `load` and all rollers.
    fn ring_balance(&self, x: [f64; 2], load: [f64; 2]) -> RingBalance {
        let mut sum = RingBalance {
            energy: -(load[0] * x[0] + load[1] * x[1]),
            force: load,
            pressing: 0.0,
            stiffness: [0.0; 3],
        };
        for j in 0..self.model.layout.count {
            let (roller, frame) = self.roller(j, x);
            let [ny, nz] = frame.to_global(roller.normal);
            sum.energy += roller.energy;
            sum.pressing += roller.load;
            sum.force[0] += roller.load * ny;
            sum.force[1] += roller.load * nz;
            sum.stiffness[0] += roller.stiffness * ny * ny;
            sum.stiffness[1] += roller.stiffness * ny * nz;
            sum.stiffness[2] += roller.stiffness * nz * nz;
        }
        sum
    }

    /// Equilibrium of roller `j` with the ring at `x` in m, and its frame.
    fn roller(&self, j: usize, x: [f64; 2]) -> (RollerBalance, Frame<f64>) {
        let Plane { layout, elements, .. } = self.model;
        let frame = elements.frame(layout, self.q, &InputValues::default(), j);
        (self.roller_balance(frame.to_local(x), elements.set().radius_excess[j]), frame)
    }

    /// Radial equilibrium of a roller whose radius is larger by `excess` (m), with the ring centre at `ring` (m) in its local
    /// frame.
    fn roller_balance(&self, ring: [f64; 2], excess: f64) -> RollerBalance {
        let [outer, inner] = self.laws;
        let (g, centrifugal) = (self.geometry, self.centrifugal);
        // On the pitch circle, to the outer raceway.
        let gap = g.gap - excess;
        // The outward force of the roller falls with its offset: bisection between resting outside and squeezed in.
        let state = |offset: f64| {
            let still =
                ElementMotion { radial_offset: offset, radius_excess: excess, ..ElementMotion::default() };
            let still_ring = RingMotion { position: ring, velocity: [0.0; 2], speed: 0.0 };
            let (motion, grip) = g.inner(&still, &still_ring);
            (inner.rest_at(motion.delta), outer.rest_at(offset - gap), motion.delta, grip.normal)
        };
        let resting = gap + outer.approach(centrifugal);
        let squeezed = ring[0].abs() + ring[1].abs() + 2.0 * gap.abs();
        let (mut low, mut high) = (resting, resting + squeezed);
        for _ in 0..100 {
            let middle = 0.5 * (low + high);
            let ([on_inner, _], [on_outer, _], _, normal) = state(middle);
            if centrifugal - on_inner * normal[0] > on_outer {
                low = middle;
            } else {
                high = middle;
            }
        }
        let ([load, work], [on_outer, work_outer], delta, normal) = state(high);
        // Palmgren's law: the energy at the approach delta is 9/19 Q delta.
        let energy = 9.0 / 19.0 * (work + work_outer) - centrifugal * (high - gap);
        let stiffness = if load > 0.0 {
            1.0 / (1.0 / inner.stiffness_at_rest(load, delta)
                + 1.0 / outer.stiffness_at_rest(on_outer, high - gap))
        } else {
            0.0
        };
        RollerBalance { load, stiffness, energy, normal, radial_offset: high }
    }
}

struct RingBalance {
    /// Potential energy, J.
    energy: f64,
    /// Sum of load and contact forces (y, z), N.
    force: [f64; 2],
    /// Sum of the magnitudes of contact forces, N.
    pressing: f64,
    /// Stiffness of the contacts (yy, yz, zz), N/m.
    stiffness: [f64; 3],
}

struct RollerBalance {
    /// Force on the inner raceway, N.
    load: f64,
    /// Stiffness of both contacts in series, N/m.
    stiffness: f64,
    /// Elastic energy of both contacts less the work of the centrifugal force, J.
    energy: f64,
    /// From the roller to the ring, local frame: the direction of the force on the ring.
    normal: [f64; 2],
    /// Offset from the pitch circle, m.
    radial_offset: f64,
}
