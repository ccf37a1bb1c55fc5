//! Exact derivatives of the accelerations with respect to positions and velocities, by dual numbers through the same
//! kinematics and laws that give the forces.
//!
//! Each contact is differentiated on its own: its law over what the law sees (approach, approach speed, surface
//! speeds, share of edge friction), by the batch (`law_slopes`); its kinematics over the coordinates of its two bodies,
//! one by one (`raceway_slopes`, `pocket_slopes`), chained. The sums keep the structure of the bearing: ring and cage
//! are coupled to every roller, rollers to nothing else.

use super::workspace::Workspace;
use super::{ElementKind, Input, InputValues, Model, RingBody, RollerSet};
use crate::contact::guide::BodyMotion;
use crate::integrate::arrowhead::HUB;
use crate::integrate::{Linearization, Structure};
use crate::scalar::{Dual, Real};
use nalgebra::{Matrix3, Matrix5, Vector5};

/// First cage coordinate in the hub, after ring y, z.
pub(super) const CAGE: usize = 2;

impl Model {
    /// Which velocities are coupled: ring and cage are the hub, rollers the spokes.
    pub fn structure(&self) -> Structure {
        let layout = &self.layout;
        let roller = |j| [layout.roller(j), layout.roller(j) + 1, layout.spin(j)];
        Structure { hub: self.hub(), spokes: (0..layout.count).map(roller).collect() }
    }

    /// Velocities of ring and cage.
    fn hub(&self) -> [Option<usize>; HUB] {
        std::array::from_fn(|k| match k {
            0 | 1 => self.layout.ring.map(|i| i + k),
            _ => self.layout.cage.map(|i| i + k - CAGE),
        })
    }

    /// Derivatives of the accelerations at the last evaluated state (`q`, `v`) of `ws`, while the inputs change at
    /// `rates` (see [`Model::input_rates_at`]).
    ///
    /// # Panics
    /// When a slice is shorter than its shape, or `ws` or `out` was made for another model.
    pub fn linearize(
        &self,
        q: &[f64],
        v: &[f64],
        ws: &mut Workspace,
        rates: &InputValues,
        out: &mut Linearization,
    ) {
        let laws = &self.laws;
        out.clear();
        let mut drift = Drift { hub: Vector5::zeros(), rates, thickening: self.thickening(ws, rates) };
        ws.raceways.differentiate(ws.thickening, ws.instructions);
        ws.pockets.differentiate(ws.thickening, ws.instructions);
        let ws = &*ws;
        if let ElementKind::Rollers(rollers) = &self.elements.kind {
            self.add_raceways(rollers, (q, v), ws, &mut drift, out);
        }
        if let Some(pocket) = &laws.pocket {
            self.add_pockets(pocket, (q, v), ws, &mut drift, out);
        }
        self.add_guide(q, v, ws, &mut drift, out);
        self.add_loads(&mut drift);
        self.divide_by_inertias(q, v, ws, &drift, out);
    }

    /// External loads change by themselves.
    fn add_loads(&self, drift: &mut Drift<'_>) {
        let inputs = [Input::LoadY, Input::LoadZ, Input::CageForceY, Input::CageForceZ, Input::CageTorque];
        for (sum, input) in drift.hub.iter_mut().zip(inputs) {
            *sum += drift.rates.of(input);
        }
    }

    fn add_guide(
        &self,
        q: &[f64],
        v: &[f64],
        ws: &Workspace,
        drift: &mut Drift<'_>,
        out: &mut Linearization,
    ) {
        let (Some(law), Some(cage)) = (&ws.guide_law, &self.cage) else { return };
        let bodies = self.guide_bodies(q, v, &ws.inputs);
        // Ring y, z, cage y, z, angle; then their rates.
        let lift = |body: &BodyMotion<f64>, at: usize, angle: bool, moves: bool| {
            let variable =
                |x: f64, i: usize| if moves { Dual::<11>::variable(x, i) } else { Dual::constant(x) };
            BodyMotion {
                position: std::array::from_fn(|k| variable(body.position[k], at + k)),
                velocity: std::array::from_fn(|k| variable(body.velocity[k], HUB + at + k)),
                angle: if angle { variable(body.angle, at + 2) } else { Dual::constant(body.angle) },
                speed: if angle { variable(body.speed, HUB + at + 2) } else { Dual::constant(body.speed) },
            }
        };
        let ring_moves = cage.guided_by_inner_ring && self.layout.ring.is_some();
        let moving = lift(&bodies[0], CAGE, true, true);
        let mut ring = lift(&bodies[1], 0, false, ring_moves);
        if cage.guided_by_inner_ring {
            ring.speed = Dual::variable(bodies[1].speed, 2 * HUB);
        }
        let motion = cage.guide_side.journal_motion(&moving, &ring);
        let Ok(force) = law.force(&motion) else { return };
        let [on_cage, on_ring] = cage.guide_side.wrenches(&force, &motion);
        let mut rows: [Option<Dual<11>>; HUB] =
            [None, None, Some(on_cage.force[0]), Some(on_cage.force[1]), Some(on_cage.moment)];
        if ring_moves {
            rows[0] = Some(on_ring.force[0]);
            rows[1] = Some(on_ring.force[1]);
        }
        for (i, row) in rows.into_iter().enumerate() {
            let Some(row) = row else { continue };
            for k in 0..HUB {
                out.over_positions.hub[(i, k)] += row.eps[k];
                out.over_velocities.hub[(i, k)] += row.eps[HUB + k];
            }
            drift.hub[i] += row.eps[2 * HUB] * drift.rates.of(Input::RingSpeed);
        }
        let thickening = drift.thickening;
        if thickening == 0.0 {
            return;
        }
        // Films know the viscosity only in its products with velocities, so their derivative over its logarithm is the
        // sum of those over each velocity times that velocity.
        let [on_cage, on_ring] = cage.guide_side.wrenches(&force.of_film(), &motion);
        let rows = [on_ring.force[0], on_ring.force[1], on_cage.force[0], on_cage.force[1], on_cage.moment];
        let hub = self.hub();
        for (i, row) in rows.into_iter().enumerate().skip(if ring_moves { 0 } else { CAGE }) {
            let velocities = hub.iter().zip(&row.eps[HUB..2 * HUB]);
            let by_motion: f64 = velocities.map(|(index, slope)| index.map_or(0.0, |i| v[i]) * slope).sum();
            drift.hub[i] += thickening * (by_motion + bodies[1].speed * row.eps[2 * HUB]);
        }
    }

    /// Rate of the logarithm of the viscosity, 1/s.
    fn thickening(&self, ws: &Workspace, rates: &InputValues) -> f64 {
        let warming = rates.of(Input::Temperature);
        match &self.inputs.oil {
            Some(oil) if warming != 0.0 => oil.law.relative_slope(ws.inputs.of(Input::Temperature)) * warming,
            _ => 0.0,
        }
    }

    /// From forces to accelerations, with the terms that are no contact forces.
    fn divide_by_inertias(
        &self,
        q: &[f64],
        v: &[f64],
        ws: &Workspace,
        drift: &Drift<'_>,
        out: &mut Linearization,
    ) {
        let mut inverse = Matrix5::zeros();
        let mut balanced = true;
        if let RingBody::Free { mass, damping } = self.ring {
            for k in 0..2 {
                out.over_velocities.hub[(k, k)] -= damping;
                inverse[(k, k)] = 1.0 / mass;
            }
        }
        if let (Some(cage), Some(c)) = (&self.cage, self.layout.cage) {
            let corner = cage.accelerations_of(&Matrix3::identity(), q[c + 2]);
            inverse.fixed_view_mut::<3, 3>(CAGE, CAGE).copy_from(&corner);
            balanced = cage.mass_eccentricity.is_none();
        }
        let diagonal = inverse.diagonal().data.0[0];
        for part in [&mut out.over_positions, &mut out.over_velocities] {
            part.hub = inverse * part.hub;
            for spoke in &mut part.spokes {
                if balanced {
                    scale_rows(&mut spoke.to_hub.data.0, &diagonal);
                } else {
                    spoke.to_hub = inverse * spoke.to_hub;
                }
            }
        }
        let rate = inverse * drift.hub;
        for (index, rate) in self.hub().into_iter().zip(rate.iter()) {
            if let Some(index) = index {
                out.over_time[index] += rate;
            }
        }
        self.add_unbalance(q, v, ws, out);
        if let ElementKind::Rollers(rollers) = &self.elements.kind {
            self.finish_rollers(rollers, ws, out);
        }
    }

    fn finish_rollers(&self, rollers: &RollerSet, ws: &Workspace, out: &mut Linearization) {
        for (j, (site, wrench)) in ws.elements.iter().zip(&ws.on_roller).enumerate() {
            let (Some(k), Some(d)) =
                (out.over_positions.spokes.get_mut(j), out.over_velocities.spokes.get_mut(j))
            else {
                return;
            };
            let r = rollers.geometry.pitch_radius + site.motion.radial_offset;
            let inverse = [1.0 / rollers.mass, 1.0 / (rollers.mass * r), 1.0 / rollers.inertia];
            let places = self.places(j);
            for part in [&mut *k, &mut *d] {
                scale_rows(&mut part.own.data.0, &inverse);
                scale_rows(&mut part.from_hub.data.0, &inverse);
            }
            for (place, factor) in places.into_iter().zip(inverse) {
                out.over_time[place] *= factor;
            }
            let [weight_r, weight_c] = site.to_local(self.gravity);
            let (radial_speed, orbit) = (site.motion.radial_speed, site.motion.orbit_speed);
            let across = (wrench.force[1] / rollers.mass + weight_c - 2.0 * radial_speed * orbit) / r;
            k.own[(0, 0)] += orbit * orbit;
            k.own[(0, 1)] += weight_c;
            k.own[(1, 0)] -= across / r;
            k.own[(1, 1)] -= weight_r / r;
            d.own[(0, 1)] += 2.0 * r * orbit;
            d.own[(1, 0)] -= 2.0 * orbit / r;
            d.own[(1, 1)] -= 2.0 * radial_speed / r;
        }
    }

    /// How the accelerations of an unbalanced cage change with its angle and speed at given forces.
    fn add_unbalance(&self, q: &[f64], v: &[f64], ws: &Workspace, out: &mut Linearization) {
        let (Some(cage), Some(c)) = (&self.cage, self.layout.cage) else { return };
        let Some([uy, uz]) = cage.mass_offset(q[c + 2]) else { return };
        let [fy, fz] = ws.on_cage.force;
        let turning = (ws.on_cage.moment - (uy * fz - uz * fy)) / cage.inertia;
        // The offset turns: du = (-uz, uy) dangle.
        let turning_rate = (uz * fz + uy * fy) / cage.inertia;
        let speed = v[c + 2];
        let (positions, velocities) = (&mut out.over_positions.hub, &mut out.over_velocities.hub);
        let angle = CAGE + 2;
        positions[(angle, angle)] += turning_rate;
        positions[(CAGE, angle)] += turning_rate * uz + turning * uy - speed * speed * uz;
        positions[(CAGE + 1, angle)] += speed * speed * uy + turning * uz - turning_rate * uy;
        velocities[(CAGE, angle)] += 2.0 * speed * uy;
        velocities[(CAGE + 1, angle)] += 2.0 * speed * uz;
    }
}

/// Multiplies the rows of a matrix, given by its columns, by these factors.
#[inline]
fn scale_rows<const N: usize>(columns: &mut [[f64; N]], factors: &[f64; N]) {
    for column in columns {
        for (x, factor) in column.iter_mut().zip(factors) {
            *x *= factor;
        }
    }
}

/// How forces on the hub change with time at constant state.
pub(super) struct Drift<'a> {
    pub(super) hub: Vector5<f64>,
    pub(super) rates: &'a InputValues,
    /// Rate of the logarithm of the viscosity, 1/s.
    pub(super) thickening: f64,
}
