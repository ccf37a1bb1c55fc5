//! Exact derivatives of the accelerations with respect to positions and velocities, by dual numbers through the same
//! kinematics and laws that give the forces.
//!
//! Each contact is differentiated on its own: its law over what the law sees (approach, approach speed, surface
//! speeds, share of edge friction), its kinematics over the coordinates of its two bodies, chained. The sums keep the
//! structure of the bearing: ring and cage are coupled to every roller, rollers to nothing else.

use super::laws::{CylinderLaws, Laws, PocketLaws, RacewayLaws};
use super::workspace::{ElementSite, Workspace};
use super::{ElementKind, Input, InputValues, Model, RingBody, RollerSet};
use crate::contact::guide::BodyMotion;
use crate::contact::pocket::{CageMotion, Pillar, PillarContact, PocketPlace};
use crate::contact::raceway::{RingMotion, RollerMotion};
use crate::contact::{Wrench, rotate};
use crate::integrate::arrowhead::HUB;
use crate::integrate::{Linearization, Structure};
use crate::laws::contact_pair::{ContactForce, ContactMotion};
use crate::laws::line_contact::FrictionBlend;
use crate::scalar::{Dual, Real};
use nalgebra::{Matrix3, Matrix5, Vector5};

/// First cage coordinate in the hub, after ring y, z.
const CAGE: usize = 2;

/// A number with derivatives over what a contact law sees: approach, approach speed, u1, u2, edge share, logarithm of the
/// viscosity.
type LawDual = Dual<6>;
/// A number with derivatives over the coordinates of a contact: element (rho, travel), their rates, spin; hub positions;
/// hub velocities; speed of the inner ring; logarithm of the viscosity.
type PairDual = Dual<17>;
const RING_SPEED: usize = 15;
const VISCOSITY: usize = 16;

/// Forces on the roller of a pair (radial, circumferential, moment) and on the shared bodies (ring y, z; cage y, z,
/// moment), with their derivatives.
struct PairForce {
    own: [PairDual; 3],
    shared: [PairDual; HUB],
}

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
        ws: &Workspace,
        rates: &InputValues,
        out: &mut Linearization,
    ) {
        let laws = &self.laws;
        out.clear();
        let mut drift = Drift { hub: Vector5::zeros(), rates, thickening: self.thickening(ws, rates) };
        for j in 0..ws.elements.len() {
            let pair = Pair::new(self, j, q, v, ws);
            let mut add = |force: PairForce| self.add_pair(j, &force, &mut drift, out);
            if let (Some(raceways), ElementKind::Rollers(rollers)) = (&laws.raceways, &self.elements.kind) {
                pair.raceways(raceways, rollers, &mut add);
            }
            pair.pocket(laws, &mut add);
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

    /// Adds the derivatives of the forces of one contact of element `j`.
    fn add_pair(&self, j: usize, force: &PairForce, drift: &mut Drift<'_>, out: &mut Linearization) {
        // Columns: own positions 0..2, own velocities 2..5, hub positions 5..10, hub velocities 10..15, ring speed.
        let rates = drift.rates;
        let thickening = drift.thickening;
        let by_itself = |row: &PairDual| {
            row.eps[RING_SPEED] * rates.of(Input::RingSpeed) + row.eps[VISCOSITY] * thickening
        };
        let (k, d) = (&mut out.over_positions, &mut out.over_velocities);
        for (i, row) in force.shared.iter().enumerate() {
            for c in 0..HUB {
                k.hub[(i, c)] += row.eps[5 + c];
                d.hub[(i, c)] += row.eps[10 + c];
            }
            drift.hub[i] += by_itself(row);
        }
        let (Some(k), Some(d)) = (k.spokes.get_mut(j), d.spokes.get_mut(j)) else {
            // The motion of the element is prescribed.
            for (sum, row) in drift.hub.iter_mut().zip(&force.shared) {
                *sum += row.eps[1] * rates.orbit_travel
                    + row.eps[3] * rates.of(Input::OrbitSpeed)
                    + row.eps[4] * rates.of(Input::SpinSpeed);
            }
            return;
        };
        for (i, row) in force.shared.iter().enumerate() {
            for c in 0..2 {
                k.to_hub[(i, c)] += row.eps[c];
            }
            for c in 0..3 {
                d.to_hub[(i, c)] += row.eps[2 + c];
            }
        }
        let places = [self.layout.roller(j), self.layout.roller(j) + 1, self.layout.spin(j)];
        for (i, row) in force.own.iter().enumerate() {
            for c in 0..2 {
                k.own[(i, c)] += row.eps[c];
            }
            for c in 0..3 {
                d.own[(i, c)] += row.eps[2 + c];
            }
            for c in 0..HUB {
                k.from_hub[(i, c)] += row.eps[5 + c];
                d.from_hub[(i, c)] += row.eps[10 + c];
            }
            out.over_time[places[i]] += by_itself(row);
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
        if let RingBody::Free { mass, damping } = self.ring {
            for k in 0..2 {
                out.over_velocities.hub[(k, k)] -= damping;
                inverse[(k, k)] = 1.0 / mass;
            }
        }
        if let (Some(cage), Some(c)) = (&self.cage, self.layout.cage) {
            let corner = cage.accelerations_of(&Matrix3::identity(), q[c + 2]);
            inverse.fixed_view_mut::<3, 3>(CAGE, CAGE).copy_from(&corner);
        }
        for part in [&mut out.over_positions, &mut out.over_velocities] {
            part.hub = inverse * part.hub;
            for spoke in &mut part.spokes {
                spoke.to_hub = inverse * spoke.to_hub;
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
            let places = [self.layout.roller(j), self.layout.roller(j) + 1, self.layout.spin(j)];
            for (i, factor) in inverse.into_iter().enumerate() {
                for part in [&mut *k, &mut *d] {
                    part.own.row_mut(i).scale_mut(factor);
                    part.from_hub.row_mut(i).scale_mut(factor);
                }
                out.over_time[places[i]] *= factor;
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

/// How forces on the hub change with time at constant state.
struct Drift<'a> {
    hub: Vector5<f64>,
    rates: &'a InputValues,
    /// Rate of the logarithm of the viscosity, 1/s.
    thickening: f64,
}

/// The coordinates of one element and of the shared bodies as variables.
struct Pair {
    motion: RollerMotion<PairDual>,
    /// Sine and cosine of the azimuth and of the lead over the pocket.
    azimuth: (PairDual, PairDual),
    lead: (PairDual, PairDual),
    ring: BodyMotion<PairDual>,
    cage: Option<BodyMotion<PairDual>>,
    /// ln of the relative viscosity.
    thickening: LawDual,
}

impl Pair {
    fn new(model: &Model, j: usize, q: &[f64], v: &[f64], ws: &Workspace) -> Self {
        let site: &ElementSite = &ws.elements[j];
        let m = &site.motion;
        let layout = &model.layout;
        let own = PairDual::variable;
        let motion = RollerMotion {
            radial_offset: own(m.radial_offset, 0),
            radial_speed: own(m.radial_speed, 2),
            orbit_speed: own(m.orbit_speed, 3),
            spin_speed: own(m.spin_speed, 4),
        };
        let turn = |(sin, cos): (f64, f64), slope: PairDual| (slope * cos + sin, -(slope * sin) + cos);
        // Zero with the derivative of the travel.
        let travel = own(0.0, 1);
        let shared = |at: Option<usize>, place: usize, k: usize| match at {
            Some(i) => {
                [PairDual::variable(q[i + k], 5 + place + k), PairDual::variable(v[i + k], 10 + place + k)]
            }
            None => [PairDual::constant(0.0); 2],
        };
        let mut ring = BodyMotion {
            position: std::array::from_fn(|k| shared(layout.ring, 0, k)[0]),
            velocity: std::array::from_fn(|k| shared(layout.ring, 0, k)[1]),
            angle: PairDual::constant(0.0),
            speed: PairDual::variable(ws.inputs.of(Input::RingSpeed), RING_SPEED),
        };
        if let RingBody::Fixed(position) = model.ring {
            ring.position = position.map(PairDual::constant);
        }
        let cage = layout.cage.map(|c| {
            let [angle, speed] = shared(Some(c), CAGE, 2);
            BodyMotion {
                position: std::array::from_fn(|k| shared(Some(c), CAGE, k)[0]),
                velocity: std::array::from_fn(|k| shared(Some(c), CAGE, k)[1]),
                angle,
                speed,
            }
        });
        let behind = cage.as_ref().map_or(travel, |cage| travel - (cage.angle - cage.angle.value()));
        Self {
            motion,
            azimuth: turn((site.sin, site.cos), travel),
            lead: turn(site.lead, behind),
            ring,
            cage,
            thickening: LawDual::variable(ws.thickening, 5),
        }
    }

    fn to_local(&self, v: [PairDual; 2]) -> [PairDual; 2] {
        rotate(v, -self.azimuth.0, self.azimuth.1)
    }

    fn to_global(&self, v: [PairDual; 2]) -> [PairDual; 2] {
        rotate(v, self.azimuth.0, self.azimuth.1)
    }

    fn raceways(&self, laws: &RacewayLaws, rollers: &RollerSet, add: &mut impl FnMut(PairForce)) {
        let geometry = &rollers.geometry;
        let zero = PairDual::constant(0.0);
        if self.motion.radial_offset.value() > geometry.gap {
            let (motion, frame) = geometry.outer(&self.motion);
            let force =
                chain(&laws.outer.force(&law_variables(&motion), self.thickening, None), &motion, zero);
            let [on_roller, _] = frame.wrenches(&force);
            add(PairForce { own: components(&on_roller), shared: [zero; HUB] });
        }
        let ring = RingMotion {
            position: self.to_local(self.ring.position),
            velocity: self.to_local(self.ring.velocity),
            speed: self.ring.speed,
        };
        let (motion, frame) = geometry.inner(&self.motion, &ring);
        if motion.delta.value() > 0.0 {
            let force =
                chain(&laws.inner.force(&law_variables(&motion), self.thickening, None), &motion, zero);
            let [on_roller, on_ring] = frame.wrenches(&force);
            let [y, z] = self.to_global(on_ring.force);
            add(PairForce { own: components(&on_roller), shared: [y, z, zero, zero, zero] });
        }
    }

    fn pocket(&self, laws: &Laws, add: &mut impl FnMut(PairForce)) {
        let (Some(pocket), Some(cage)) = (&laws.pocket, &self.cage) else { return };
        let place = match pocket {
            PocketLaws::Cylinder(laws) => laws.shape.place,
            PocketLaws::Plane(laws) => laws.shape.place,
        };
        let position = rotate(self.to_local(cage.position), self.lead.0, self.lead.1);
        let offset = place.offset(self.motion.radial_offset, self.lead, position);
        let apart = match pocket {
            PocketLaws::Cylinder(laws) => laws.shape.apart(offset),
            PocketLaws::Plane(laws) => laws.shape.apart(offset),
        };
        if apart {
            return;
        }
        let velocity = rotate(self.to_local(cage.velocity), self.lead.0, self.lead.1);
        let moving = CageMotion { position, velocity, speed: cage.speed };
        let relative = place.relative_motion(offset, &self.motion, self.lead, &moving);
        for side in [Pillar::Front, Pillar::Back] {
            let contact = match pocket {
                PocketLaws::Cylinder(laws) => laws.shape.pillar(side, &relative),
                PocketLaws::Plane(laws) => laws.shape.wall(side, &relative),
            };
            let Some(contact) = contact else { continue };
            let force = match pocket {
                PocketLaws::Cylinder(laws) => cylinder_force(laws, &contact, self.thickening),
                PocketLaws::Plane(laws) => {
                    let law = laws.contact.force(&law_variables(&contact.motion));
                    chain(&law, &contact.motion, contact.edge_share)
                }
            };
            add(self.pocket_force(&place, &offset, &contact, &force));
        }
    }

    fn pocket_force(
        &self,
        place: &PocketPlace,
        offset: &[PairDual; 2],
        contact: &PillarContact<PairDual>,
        force: &ContactForce<PairDual>,
    ) -> PairForce {
        let [on_element, _] = contact.frame.wrenches(force);
        let lever = place.lever(*offset, contact.frame.normal);
        let [along_r, along_c] = on_element.force;
        let moment = -(lever[0] * along_c - lever[1] * along_r);
        let local = rotate(on_element.force, -self.lead.0, self.lead.1);
        let [y, z] = self.to_global(local);
        let zero = PairDual::constant(0.0);
        let own = components(&Wrench { force: local, moment: on_element.moment });
        PairForce { own, shared: [zero, zero, -y, -z, moment] }
    }
}

/// Force of a wall or an edge of a cylindrical pocket.
fn cylinder_force(
    laws: &CylinderLaws,
    contact: &PillarContact<PairDual>,
    thickening: LawDual,
) -> ContactForce<PairDual> {
    let motion = law_variables(&contact.motion);
    let on_edge = contact.edge_share.value() >= 1.0;
    let (law, share) = if on_edge {
        (&laws.edge, LawDual::constant(1.0))
    } else {
        (&laws.wall, LawDual::variable(contact.edge_share.value(), 4))
    };
    let blend = (share.value() > 0.0).then_some(FrictionBlend { share, other: laws.edge_friction });
    chain(&law.force(&motion, thickening, blend), &contact.motion, contact.edge_share)
}

/// What a law sees, as its variables.
fn law_variables(motion: &ContactMotion<PairDual>) -> ContactMotion<LawDual> {
    ContactMotion {
        delta: LawDual::variable(motion.delta.value(), 0),
        delta_dot: LawDual::variable(motion.delta_dot.value(), 1),
        u1: LawDual::variable(motion.u1.value(), 2),
        u2: LawDual::variable(motion.u2.value(), 3),
    }
}

/// The forces of a contact over the coordinates of its bodies: chain rule. What makes no force is left at zero.
fn chain(
    force: &ContactForce<LawDual>,
    motion: &ContactMotion<PairDual>,
    edge_share: PairDual,
) -> ContactForce<PairDual> {
    let viscosity = PairDual::variable(0.0, VISCOSITY);
    let inner = [motion.delta, motion.delta_dot, motion.u1, motion.u2, edge_share, viscosity];
    let over_coordinates = |f: LawDual| {
        let mut out = PairDual::constant(f.re);
        for (slope, x) in f.eps.iter().zip(&inner) {
            for (e, dx) in out.eps.iter_mut().zip(x.eps) {
                *e += slope * dx;
            }
        }
        out
    };
    ContactForce {
        normal: over_coordinates(force.normal),
        friction: over_coordinates(force.friction),
        rolling_resistance: over_coordinates(force.rolling_resistance),
        ..ContactForce::none(PairDual::constant(0.0))
    }
}

fn components(wrench: &Wrench<PairDual>) -> [PairDual; 3] {
    [wrench.force[0], wrench.force[1], wrench.moment]
}
