//! Rollers at the start of a run, speeds without slip, and frequencies.

use super::super::Space;
use super::super::rest::rollers::{Rollers, SettledRollers};
use super::RollersOfScene;
use crate::bodies::{INNER_RING, Input, InputValues, OF_ROLLER, ORBIT, OUTER_RING, RingInSpace, SPIN};
use crate::error::Result;
use crate::model::HostInputs;
use crate::pairs::raceway::{Cones, RacewayGeometry};
use crate::scalar::math;
use crate::scene::RingStart;

/// Largest load of a roller over the mean one under a radial load, of a bearing without clearance.
const STRIBECK: f64 = 4.1;

impl RollersOfScene {
    /// Orbit speed without slip per speed of outer and inner ring, of a roller that touches the outer raceway.
    fn orbit_ratios(&self) -> [f64; 2] {
        let RacewayGeometry { pitch_radius, roller_radius, gap, cones } = self.geometry;
        let (centre, reach) = (pitch_radius + gap, roller_radius * cones.inclination.cos);
        [centre + reach, pitch_radius - reach - gap].map(|raceway| raceway / (2.0 * centre))
    }

    /// Orbit and spin speed without slip, rad/s.
    pub(in super::super) fn kinematic_speeds(&self, inputs: &InputValues) -> [f64; 2] {
        let [outer_ratio, inner_ratio] = self.orbit_ratios();
        let [outer, inner] = [inputs.of(Input::OuterRingSpeed), inputs.of(Input::RingSpeed)];
        let over = (self.geometry.pitch_radius + self.geometry.gap) / self.geometry.roller_radius;
        // Of an inclined roller about its own axis: (r + R cos(gamma)) (outer - orbit)/R + orbit cos(gamma), which is the same.
        [inner_ratio * inner + outer_ratio * outer, (outer_ratio * outer - inner_ratio * inner) * over]
    }

    /// Whether the inner ring alone holds cylindrical rollers between two ribs.
    fn go_with_inner_ring(&self) -> bool {
        let ribs = |ring: usize| self.ends.iter().filter(|end| end.mate == ring).count();
        self.geometry.cones == Cones::NONE && ribs(INNER_RING) == 2 && ribs(OUTER_RING) < 2
    }

    /// Centrifugal force at this orbit speed (rad/s), N.
    fn centrifugal(&self, orbit: f64) -> f64 {
        let [mass, ..] = self.body.inertia(0);
        mass * self.geometry.pitch_radius * orbit * orbit
    }
}

impl Space {
    /// Ring and rollers at rest at the start of the scene, if it has rollers. A ring that is free along the axis and has no load there stays where it
    /// starts, unless rollers are tapered.
    ///
    /// # Errors
    /// [`crate::Status::BadState`] where there is no equilibrium, or none was found.
    pub(crate) fn settled_rollers(&self) -> Option<Result<SettledRollers<'_>>> {
        self.settled_beside(None)
    }

    /// The same of a ring that is held along the axis here (m), if it is free there.
    fn settled_beside(&self, held: Option<f64>) -> Option<Result<SettledRollers<'_>>> {
        let rollers = self.rollers.as_ref()?;
        let inputs = self.inputs.at(0.0, &HostInputs::default());
        let [orbit, _] = rollers.kinematic_speeds(&inputs);
        let laws = [rollers.raceway(0), rollers.raceway(1)];
        let laws = (laws, rollers.shapes.clone(), &rollers.ends[..]);
        let resting = Rollers::new(rollers.geometry, laws, &self.set, rollers.centrifugal(orbit));
        let mut body = RingInSpace::new(&self.scene);
        let load = body.load(&inputs);
        if rollers.geometry.cones == Cones::NONE && load[0] == 0.0 && body.spring(0.0) == [0.0; 2] {
            body.held[0].get_or_insert(0.0);
        }
        body.held[0] = body.held[0].or(held);
        Some(resting.settled(&body, load))
    }

    /// Places rollers and ring as the scene says.
    pub(in super::super) fn start_rollers(&self, q: &mut [f64], v: &mut [f64]) -> Result<[f64; 2]> {
        let inputs = self.inputs.at(0.0, &HostInputs::default());
        let [orbit, spin] = self.kinematic_speeds(&inputs);
        let mut ring = [0.0; 2];
        let at_rest = self.scene.initial.inner_ring == RingStart::Equilibrium;
        // A ring that nothing holds along the axis starts in the middle, and leaves.
        let settle = || match self.settled_rollers()? {
            Err(_) if self.ring.held[0].is_none() => self.settled_beside(Some(0.0)),
            found => Some(found),
        };
        let settled = if at_rest { settle().transpose()? } else { None };
        if let Some(found) = &settled {
            for (q, k) in q.iter_mut().zip(self.ring.free()) {
                *q = found.ring.at[k];
            }
            ring = [found.ring.at[1], found.ring.at[2]];
        }
        for j in 0..self.layout.count {
            let places = self.layout.of_element::<OF_ROLLER>(j);
            if let Some(found) = &settled {
                let [x, rho, tilt] = found.place(j);
                (q[places[0]], q[places[1]], q[places[4]]) = (x, rho, tilt);
            }
            (v[places[ORBIT]], v[places[SPIN]]) = (orbit, spin);
        }
        self.place_between_inner_ribs(q, v, &inputs, orbit);
        Ok(ring)
    }

    /// Puts rollers that the inner ring alone holds along the axis in the middle between its ribs, across which it may be tilted or shifted.
    fn place_between_inner_ribs(&self, q: &mut [f64], v: &mut [f64], inputs: &InputValues, orbit: f64) {
        if !self.rollers.as_ref().is_some_and(RollersOfScene::go_with_inner_ring) {
            return;
        }
        let ring = self.ring.state(q, v, inputs).motion();
        for j in 0..self.layout.count {
            let [x, rho, _, skew, ..] = self.layout.of_element::<OF_ROLLER>(j);
            let (sin, cos) = math::sin_cos(self.set.reference_angles[j]);
            let ring = ring.beside([cos, sin]);
            let ([along, outward, ahead], [cx, cr, ct]) = (ring.axis, ring.centre);
            let r = self.set.pitch_radius;
            q[x] = cx - ((r + q[rho] - cr) * outward - ct * ahead) / along;
            q[skew] = -ahead;
            (v[x], v[skew]) = (-r * ahead * orbit, outward * orbit);
        }
    }

    /// Highest frequency of a roller between its raceways in rad/s, at the largest load of the scene.
    pub(in super::super) fn roller_frequency(&self, rollers: &RollersOfScene) -> f64 {
        let largest = |input| self.inputs.largest(input);
        let count = self.element_count() as f64;
        let [by_outer, by_inner] = rollers.orbit_ratios();
        let orbit = largest(Input::RingSpeed) * by_inner + largest(Input::OuterRingSpeed) * by_outer;
        let radial = math::hypot(largest(Input::LoadY), largest(Input::LoadZ));
        // A moment loads the ends of rollers, whose line load it raises as a force does that acts at a third of the length.
        let moment = math::hypot(largest(Input::MomentY), largest(Input::MomentZ));
        let by_moment = 3.0 * moment / rollers.half_length;
        let larger = self.set.radius_excess.iter().copied().fold(0.0, f64::max);
        let line = &rollers.raceway(1).elastic;
        let preload = line.load((larger - rollers.geometry.gap).max(0.0));
        let load = STRIBECK / count.max(STRIBECK) * (radial + by_moment)
            + rollers.centrifugal(orbit)
            + preload
            + 1.0;
        let [mass, ..] = rollers.body.inertia(0);
        let stiffness: f64 = rollers.laws[..2].iter().map(|law| law.stiffness_at_load(load)).sum();
        (stiffness / mass).sqrt()
    }
}
