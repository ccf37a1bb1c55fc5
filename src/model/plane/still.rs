//! Ring and rollers at rest: where the load of the ring is carried.

use super::{InputValues, Plane};
use crate::bodies::{ElementMotion, ForceSource, INNER_RING, OUTER_RING, ROTOR, SharedBody};
use crate::error::{Error, Result, Status};
use crate::laws::contact_pair::{ContactForce, ContactMotion};
use crate::laws::line_contact::LineContact;
use crate::pairs::raceway::{RacewayGeometry, RingMotion};
use crate::scalar::math;
use crate::space::Frame;
use nalgebra::{Matrix2, Vector2};
use std::f64::consts::PI;

/// Steps for the equilibrium of the ring; about twenty are usual.
const MAX_ITERATIONS: usize = 500;
/// Accepted residual force in N, far below any load of interest.
const NEGLIGIBLE_FORCE: f64 = 1e-9;
/// How often rings are placed whose supports push across: each time the difference shrinks by what is not symmetric in the stiffness over
/// what is.
const PLACINGS: usize = 30;
/// Accepted residual force relative to the load.
const TOLERANCE: f64 = 1e-10;

impl Plane {
    /// Load and weight of a free ring at these inputs, N; `None` of one that is held.
    fn load_on(&self, ring: usize, inputs: &InputValues) -> Option<Vector2<f64>> {
        let of = |body: &dyn SharedBody| {
            let weight = Vector2::from(self.gravity) * body.weighing()?;
            Some(Vector2::from(body.load(inputs)) + weight)
        };
        let own = of(self.shared[ring].as_deref()?)?;
        let carried = self.shared[ROTOR].as_deref().filter(|_| ring == INNER_RING).and_then(of);
        Some(carried.map_or(own, |carried| own + carried))
    }

    /// Place of the rotor at rest with the inner ring at `ring`, m; `None` without one.
    pub(super) fn rotor_at_rest(&self, ring: [f64; 2], inputs: &InputValues) -> Option<[f64; 2]> {
        let rotor = self.shared[ROTOR].as_ref()?;
        let shaft = self.between_infos.iter().position(|info| info.bodies[0] == ROTOR)?;
        let force = Vector2::from(rotor.load(inputs)) + Vector2::from(self.gravity) * rotor.weighing()?;
        Some((Vector2::from(ring) + force / self.between[shaft].stiffness()).into())
    }

    /// Load and weight of a free inner ring at these inputs, N; `None` of one that is held.
    pub(crate) fn load_at_rest(&self, inputs: &InputValues) -> Option<[f64; 2]> {
        self.load_on(INNER_RING, inputs).map(Into::into)
    }

    /// What holds the inner ring as seen from the outer one, and where the outer one is then.
    ///
    /// ```text
    /// o outer, x = o + d inner ring, f their loads, K their supports, B(d) force of the rollers on the inner ring
    /// B(d) + f_x = K_x (o + d),   f_o - B(d) = K_o o   where they are free
    /// ```
    ///
    /// What is not symmetric in K is a load, of rings at `places`.
    fn hold(&self, inputs: &InputValues, places: [[f64; 2]; 2]) -> (Hold, Follow) {
        let at = |ring: usize| Vector2::from(self.motion_of(ring, &[0.0; 2], &[0.0; 2], inputs).position);
        let support = |ring: usize| {
            let [[yy, yz], [zy, zz]] = self.shared[ring].as_ref().map_or([[0.0; 2]; 2], |b| b.support());
            let (mean, rest) = (0.5 * (yz + zy), 0.5 * (yz - zy));
            [Matrix2::new(yy, mean, mean, zz), Matrix2::new(0.0, rest, -rest, 0.0)]
        };
        let ([k_outer, rest_outer], [k_inner, rest_inner]) = (support(OUTER_RING), support(INNER_RING));
        let load = |ring: usize, rest: Matrix2<f64>| {
            self.load_on(ring, inputs).map(|load| load - rest * Vector2::from(places[ring]))
        };
        match (load(OUTER_RING, rest_outer), load(INNER_RING, rest_inner)) {
            (None, Some(load)) => {
                let outer = at(OUTER_RING);
                let load = YieldingLoad { load: load - k_inner * outer, stiffness: k_inner };
                (Hold::Under(load), Follow { outer, per_distance: Matrix2::zeros() })
            }
            (Some(load), None) => {
                let inner = at(INNER_RING);
                let load = YieldingLoad { load: k_outer * inner - load, stiffness: k_outer };
                (Hold::Under(load), Follow { outer: inner, per_distance: -Matrix2::identity() })
            }
            (Some(on_outer), Some(on_inner)) => {
                // Rings that nothing holds stay where they are.
                let yields = (k_outer + k_inner).try_inverse().unwrap_or_else(Matrix2::zeros);
                let follow =
                    Follow { outer: yields * (on_outer + on_inner), per_distance: -(yields * k_inner) };
                let load = YieldingLoad {
                    load: on_inner - k_inner * follow.outer,
                    stiffness: k_inner + k_inner * follow.per_distance,
                };
                (Hold::Under(load), follow)
            }
            (None, None) => {
                let (outer, inner) = (at(OUTER_RING), at(INNER_RING));
                (Hold::At(inner - outer), Follow { outer, per_distance: Matrix2::zeros() })
            }
        }
    }

    /// Places of outer and inner ring at rest, m, with the rollers at `q`; `still` has the outer ring there then.
    pub(super) fn rings_at_rest(
        &self,
        still: &mut StillBearing<'_>,
        q: &[f64],
        inputs: &InputValues,
    ) -> Result<[[f64; 2]; 2]> {
        let mut places = [[0.0; 2]; 2];
        for _ in 0..PLACINGS {
            let (hold, follow) = self.hold(inputs, places);
            still.outer = [0.0; 2];
            let distance = match hold {
                Hold::At(distance) => distance,
                Hold::Under(load) => still.rest(q, &load)?.into(),
            };
            let outer = follow.outer + follow.per_distance * distance;
            still.outer = outer.into();
            places = [outer.into(), (outer + distance).into()];
            if !self.circulates() {
                break;
            }
        }
        Ok(places)
    }

    /// Whether a support has a stiffness that is not symmetric.
    fn circulates(&self) -> bool {
        self.shared.iter().flatten().any(|body| {
            let [[_, yz], [zy, _]] = body.support();
            yz != zy
        })
    }
}

/// What keeps the inner ring at a distance from the outer one.
enum Hold {
    /// It is given, m.
    At(Vector2<f64>),
    Under(YieldingLoad),
}

/// Load on the inner ring at the distance d from the outer one: load - stiffness d.
struct YieldingLoad {
    /// N
    load: Vector2<f64>,
    /// N/m, symmetric.
    stiffness: Matrix2<f64>,
}

/// Where the outer ring is, m: `outer` + `per_distance` d.
struct Follow {
    outer: Vector2<f64>,
    per_distance: Matrix2<f64>,
}

/// The rollers of a bearing in which nothing moves but for the centrifugal force.
pub(crate) struct StillBearing<'a> {
    model: &'a Plane,
    pub(in crate::model) geometry: RacewayGeometry,
    /// Of outer and inner ring.
    pub(in crate::model) laws: [&'a LineContact; 2],
    /// On each roller, N.
    pub(in crate::model) centrifugal: f64,
    /// Centre of the outer ring, m.
    outer: [f64; 2],
}

impl<'a> StillBearing<'a> {
    /// That of a bearing with raceways whose rollers go round with this speed, rad/s.
    pub(crate) fn new(model: &'a Plane, orbit: f64) -> Option<Self> {
        let law = |ring: ForceSource| model.law_of(ring)?.line();
        let laws = [law(ForceSource::OuterRaceway)?, law(ForceSource::InnerRaceway)?];
        let centrifugal = model.elements.centrifugal(orbit);
        Some(Self { model, geometry: model.raceway_geometry()?, laws, centrifugal, outer: [0.0; 2] })
    }

    /// Position of the ring, m, at which the rollers carry `load` (N): the minimum of the potential energy, found by
    /// Newton steps whose length a Levenberg-Marquardt parameter controls.
    pub(crate) fn equilibrium(&self, q: &[f64], load: [f64; 2]) -> Result<[f64; 2]> {
        self.rest(q, &YieldingLoad { load: load.into(), stiffness: Matrix2::zeros() })
    }

    /// The same under a load that gives way.
    fn rest(&self, q: &[f64], hold: &YieldingLoad) -> Result<[f64; 2]> {
        let load: [f64; 2] = hold.load.into();
        let mut size = math::hypot(load[0], load[1]);
        let mut x = [0.0; 2];
        let mut here = self.ring_balance(q, x, hold);
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
            let there = self.ring_balance(q, trial, hold);
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

    /// Energy, force and stiffness of the ring at `x` under its load and all rollers.
    fn ring_balance(&self, q: &[f64], x: [f64; 2], hold: &YieldingLoad) -> RingBalance {
        let load: [f64; 2] = hold.load.into();
        let mut sum = RingBalance {
            energy: -(load[0] * x[0] + load[1] * x[1]),
            force: load,
            pressing: 0.0,
            stiffness: [0.0; 3],
        };
        if hold.stiffness != Matrix2::zeros() {
            let (k, place) = (hold.stiffness, Vector2::from(x));
            let held = k * place;
            sum.energy += 0.5 * place.dot(&held);
            sum.force = [load[0] - held[0], load[1] - held[1]];
            sum.stiffness = [k[(0, 0)], k[(0, 1)], k[(1, 1)]];
        }
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
        let rings = [self.outer, x].map(|place| frame.to_local(place));
        (self.roller_balance(rings, elements.set().radius_excess[j]), frame)
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

    /// Radial equilibrium of a roller whose radius is larger by `excess` (m), with the centres of outer and inner ring at `outside` and
    /// `ring` (m) in its local frame.
    fn roller_balance(&self, [outside, ring]: [[f64; 2]; 2], excess: f64) -> RollerBalance {
        let [outer, inner] = self.laws;
        let (g, centrifugal) = (self.geometry, self.centrifugal);
        // On the pitch circle, to the outer raceway.
        let gap = g.gap - excess;
        // Approach to the outer raceway.
        let on_outer_at = |offset: f64| {
            if outside == [0.0; 2] {
                return offset - gap;
            }
            let still =
                ElementMotion { radial_offset: offset, radius_excess: excess, ..ElementMotion::default() };
            let held = RingMotion { position: outside, velocity: [0.0; 2], speed: 0.0 };
            g.outer_beside(&still, &held).0.delta
        };
        // The outward force of the roller falls with its offset: bisection between resting outside and squeezed in.
        let state = |offset: f64| {
            let still =
                ElementMotion { radial_offset: offset, radius_excess: excess, ..ElementMotion::default() };
            let still_ring = RingMotion { position: ring, velocity: [0.0; 2], speed: 0.0 };
            let (motion, grip) = g.inner(&still, &still_ring);
            let approach = on_outer_at(offset);
            (inner.rest_at(motion.delta), outer.rest_at(approach), motion.delta, grip.normal)
        };
        let resting = gap + outer.approach(centrifugal);
        let squeezed = ring[0].abs() + ring[1].abs() + 2.0 * gap.abs();
        let moved = outside[0].abs() + outside[1].abs();
        let (mut low, mut high) = (resting - moved, resting + squeezed + moved);
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
        let approach = on_outer_at(high);
        let energy = 9.0 / 19.0 * (work + work_outer) - centrifugal * (high - gap);
        let stiffness = if load > 0.0 {
            1.0 / (1.0 / inner.stiffness_at_rest(load, delta)
                + 1.0 / outer.stiffness_at_rest(on_outer, approach))
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
