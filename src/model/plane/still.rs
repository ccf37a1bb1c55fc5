//! Ring and rollers at rest: where the load of the ring is carried.

use super::{Input, InputValues, Plane};
use crate::bodies::{ElementMotion, ForceSource, INNER_RING};
use crate::error::{Error, Result, Status};
use crate::laws::contact_pair::{ContactForce, ContactMotion};
use crate::laws::line_contact::LineContact;
use crate::pairs::raceway::{RacewayGeometry, RingMotion};
use crate::scalar::math;
use crate::space::Frame;
use std::f64::consts::PI;

/// Steps for the equilibrium of the ring; about twenty are usual.
const MAX_ITERATIONS: usize = 500;
/// Accepted residual force in N, far below any load of interest.
const NEGLIGIBLE_FORCE: f64 = 1e-9;
/// Accepted residual force relative to the load.
const TOLERANCE: f64 = 1e-10;

impl Plane {
    /// Load and weight of a free inner ring at these inputs, N; `None` of one that is held.
    pub(crate) fn load_at_rest(&self, inputs: &InputValues) -> Option<[f64; 2]> {
        let mass = self.shared[INNER_RING].as_ref().and_then(|ring| ring.mass())?;
        Some([
            inputs.of(Input::LoadY) + mass * self.gravity[0],
            inputs.of(Input::LoadZ) + mass * self.gravity[1],
        ])
    }
}

/// The rollers of a bearing in which nothing moves but for the centrifugal force.
pub(crate) struct StillBearing<'a> {
    model: &'a Plane,
    pub(in crate::model) geometry: RacewayGeometry,
    /// Of outer and inner ring.
    pub(in crate::model) laws: [&'a LineContact; 2],
    /// On each roller, N.
    pub(in crate::model) centrifugal: f64,
}

impl<'a> StillBearing<'a> {
    /// That of a bearing with raceways whose rollers go round with this speed, rad/s.
    pub(crate) fn new(model: &'a Plane, orbit: f64) -> Option<Self> {
        let law = |ring: ForceSource| model.law_of(ring)?.line();
        let laws = [law(ForceSource::OuterRaceway)?, law(ForceSource::InnerRaceway)?];
        let centrifugal = model.elements.centrifugal(orbit);
        Some(Self { model, geometry: model.raceway_geometry()?, laws, centrifugal })
    }

    /// Position of the ring, m, at which the rollers carry `load` (N): the minimum of the potential energy, found by
    /// Newton steps whose length a Levenberg-Marquardt parameter controls.
    pub(crate) fn equilibrium(&self, q: &[f64], load: [f64; 2]) -> Result<[f64; 2]> {
        let mut size = math::hypot(load[0], load[1]);
        let mut x = [0.0; 2];
        let mut here = self.ring_balance(q, x, load);
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
            let there = self.ring_balance(q, trial, load);
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
    fn ring_balance(&self, q: &[f64], x: [f64; 2], load: [f64; 2]) -> RingBalance {
        let mut sum = RingBalance {
            energy: -(load[0] * x[0] + load[1] * x[1]),
            force: load,
            pressing: 0.0,
            stiffness: [0.0; 3],
        };
        for j in 0..self.model.layout.count {
            let (roller, frame) = self.roller(q, j, x);
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
    pub(super) fn roller(&self, q: &[f64], j: usize, x: [f64; 2]) -> (RollerBalance, Frame<f64>) {
        let Plane { layout, elements, .. } = self.model;
        let frame = elements.frame(layout, q, &InputValues::default(), j);
        (self.roller_balance(frame.to_local(x), elements.set().radius_excess[j]), frame)
    }

    /// Half width (m) and largest pressure (Pa) of Hertz's contact with outer or inner ring at rest at this approach, m.
    pub(crate) fn pressed(&self, ring: usize, load: f64, approach: f64) -> [f64; 2] {
        let still = ContactMotion { delta: approach, delta_dot: 0.0, u1: 0.0, u2: 0.0 };
        let force = ContactForce { normal: load, ..ContactForce::none(0.0) };
        let loading = self.laws[ring].loading(&still, 0.0, &force);
        [loading.half_width, 4.0 / PI * loading.mean_pressure]
    }

    /// Load per length (N/m) at `s` (m) along a roller that approaches a raceway so far (m) in its middle.
    pub(crate) fn line_load(&self, ring: usize, approach: f64, s: f64) -> f64 {
        let LineContact { elastic, profile, .. } = self.laws[ring];
        let drop = profile.as_ref().map_or(0.0, |of| of.of_roller(s) + of.of_raceway(s)[0]);
        elastic.load(approach - drop) / elastic.length
    }

    /// Roller `j` at rest beside a ring at `x` (m).
    pub(crate) fn roller_at_rest(&self, q: &[f64], j: usize, x: [f64; 2]) -> RollerAtRest {
        let [outer, inner] = self.laws;
        let elements = &self.model.elements;
        let (roller, frame) = self.roller(q, j, x);
        let gap = self.geometry.gap - elements.set().radius_excess[j];
        let approach = roller.radial_offset - gap;
        let [on_outer, _] = outer.rest_at(approach);
        // Against the ring, which a move of it along the normal leaves, and one across turns about the roller.
        let k_outer = if on_outer > 0.0 { outer.stiffness_at_rest(on_outer, approach) } else { 0.0 };
        let k_inner =
            if roller.load > 0.0 { inner.stiffness_at_rest(roller.load, roller.delta) } else { 0.0 };
        let local = frame.to_local(x);
        let from_roller = [local[0] - self.geometry.pitch_radius - roller.radial_offset, local[1]];
        let turning = roller.load / math::hypot(from_roller[0], from_roller[1]);
        let [n, t] = roller.normal;
        let held = [
            [k_inner * n * n - turning * t * t, (k_inner + turning) * n * t],
            [(k_inner + turning) * n * t, k_inner * t * t - turning * n * n],
        ];
        // The roller follows along its radius.
        let yields = if k_outer + held[0][0] > 0.0 { 1.0 / (k_outer + held[0][0]) } else { 0.0 };
        let with = |i: usize, k: usize| held[i][k] - held[i][0] * held[0][k] * yields;
        let columns = [0, 1].map(|k| {
            let unit = frame.to_local(if k == 0 { [1.0, 0.0] } else { [0.0, 1.0] });
            frame.to_global([0, 1].map(|i| with(i, 0) * unit[0] + with(i, 1) * unit[1]))
        });
        RollerAtRest {
            azimuth: elements.azimuth(&self.model.layout, q, &InputValues::default(), j),
            radial_offset: roller.radial_offset,
            loads: [on_outer, roller.load],
            approaches: [approach, roller.delta],
            on_ring: frame.to_global(roller.normal).map(|n| roller.load * n),
            stiffness: [[columns[0][0], columns[1][0]], [columns[0][1], columns[1][1]]],
        }
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
        RollerBalance { load, delta, stiffness, energy, normal, radial_offset: high }
    }
}

/// A roller at rest, by outer and inner contact.
pub(crate) struct RollerAtRest {
    pub(crate) azimuth: f64,
    pub(crate) radial_offset: f64,
    /// N.
    pub(crate) loads: [f64; 2],
    /// m; negative where they are apart.
    pub(crate) approaches: [f64; 2],
    /// Force on the ring (y, z), N.
    pub(crate) on_ring: [f64; 2],
    /// -d(force)/d(position) of the ring while the roller stays at rest, N/m, by rows.
    pub(crate) stiffness: [[f64; 2]; 2],
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

/// A roller at rest.
pub(super) struct RollerBalance {
    /// Force on the inner raceway, N.
    load: f64,
    /// Approach of the inner contact, m.
    delta: f64,
    /// Stiffness of both contacts in series, N/m.
    stiffness: f64,
    /// Elastic energy of both contacts less the work of the centrifugal force, J.
    energy: f64,
    /// From the roller to the ring, local frame: the direction of the force on the ring.
    normal: [f64; 2],
    /// Offset from the pitch circle, m.
    pub(super) radial_offset: f64,
}
