//! Derivatives of the raceway forces: those of the laws, which come in columns, chained with those of the kinematics, by
//! dual numbers over the few coordinates that a contact sees.
//!
//! In the frame of the roller the azimuth psi moves nothing but the ring, whose centre and velocity x turn backwards:
//!
//! ```text
//! dx_r/dpsi = x_c,  dx_c/dpsi = -x_r
//! d(e_r F_r + e_c F_c)/dpsi = e_r (dF_r/dpsi - F_c) + e_c (dF_c/dpsi + F_r)      force on the ring in global axes
//! ```

use super::batch::{Batch, Mate, Site};
use super::jacobian::Drift;
use super::law_slopes::DIRECTIONS;
use super::workspace::{ElementSite, Workspace};
use super::{Input, Model, RollerSet};
use crate::contact::Wrench;
use crate::contact::raceway::{RingMotion, RollerMotion};
use crate::integrate::Linearization;
use crate::laws::contact_pair::{ContactForce, ContactMotion};
use crate::scalar::{Dual, Real};

/// Radial offset, radial speed, orbit speed, spin speed, logarithm of the viscosity.
type OuterDual = Dual<5>;
/// The same but the last; centre and velocity of the ring in the frame of the roller, its speed; the viscosity.
type InnerDual = Dual<10>;
const RING_POSITION: usize = 4;
const RING_VELOCITY: usize = 6;
const RING_SPEED: usize = 8;

impl Model {
    /// Adds the derivatives of all raceway contacts. Those of their laws are in the batches.
    pub(super) fn add_raceways(
        &self,
        rollers: &RollerSet,
        (q, v): (&[f64], &[f64]),
        ws: &Workspace,
        drift: &mut Drift<'_>,
        out: &mut Linearization,
    ) {
        let batch = &ws.raceways;
        for (i, &Site { element: j, mate, .. }) in batch.sites.iter().enumerate() {
            match mate {
                Mate::Outer => {
                    let roller = lift::<5>(&ws.elements[j].motion);
                    let (motion, frame) = rollers.geometry.outer(&roller);
                    let [on_roller, _] = frame.wrenches(&chain(batch, i, &motion));
                    self.add_outer(j, &components(&on_roller), drift, out);
                }
                Mate::Inner => {
                    self.differentiate_inner(rollers, (q, v), (i, j), ws, drift, out);
                }
                Mate::Pocket(_) => {}
            }
        }
    }

    /// Adds the derivatives of contact `i`, of roller `j` with the inner ring.
    fn differentiate_inner(
        &self,
        rollers: &RollerSet,
        (q, v): (&[f64], &[f64]),
        (i, j): (usize, usize),
        ws: &Workspace,
        drift: &mut Drift<'_>,
        out: &mut Linearization,
    ) {
        let (position, velocity) = self.ring_motion(q, v);
        let site = &ws.elements[j];
        let [x, v] = [site.to_local(position), site.to_local(velocity)];
        let vector = |x: [f64; 2], at: usize| [0, 1].map(|k| InnerDual::variable(x[k], at + k));
        let ring = RingMotion {
            position: vector(x, RING_POSITION),
            velocity: vector(v, RING_VELOCITY),
            speed: InnerDual::variable(ws.inputs.of(Input::RingSpeed), RING_SPEED),
        };
        let (motion, frame) = rollers.geometry.inner(&lift::<10>(&site.motion), &ring);
        let [on_roller, on_ring] = frame.wrenches(&chain(&ws.raceways, i, &motion));
        let turn = |row: &InnerDual| {
            let [position, velocity] =
                [RING_POSITION, RING_VELOCITY].map(|at| [row.eps[at], row.eps[at + 1]]);
            position[0] * x[1] - position[1] * x[0] + velocity[0] * v[1] - velocity[1] * v[0]
        };
        let own = components(&on_roller).map(|row| Row::new(&row, turn(&row), site, drift));
        let [radial, across] = on_ring.force;
        let turned = [turn(&radial) - across.re, turn(&across) + radial.re];
        let both = [&radial, &across];
        let turned = site.to_global(turned);
        let mut rows = [InnerDual::constant(0.0); 2];
        for d in 0..radial.eps.len() {
            [rows[0].eps[d], rows[1].eps[d]] = site.to_global(both.map(|f| f.eps[d]));
        }
        let shared = [0, 1].map(|k| Row::new(&rows[k], turned[k], site, drift));
        self.add_inner(j, &own, &shared, drift, out);
    }

    fn add_outer(&self, j: usize, rows: &[OuterDual; 3], drift: &Drift<'_>, out: &mut Linearization) {
        let (Some(k), Some(d)) =
            (out.over_positions.spokes.get_mut(j), out.over_velocities.spokes.get_mut(j))
        else {
            return;
        };
        let places = self.places(j);
        for (i, row) in rows.iter().enumerate() {
            k.own[(i, 0)] += row.eps[0];
            for c in 0..3 {
                d.own[(i, c)] += row.eps[1 + c];
            }
            out.over_time[places[i]] += row.eps[4] * drift.thickening;
        }
    }

    fn add_inner(
        &self,
        j: usize,
        own: &[Row; 3],
        shared: &[Row; 2],
        drift: &mut Drift<'_>,
        out: &mut Linearization,
    ) {
        let ring_moves = self.layout.ring.is_some();
        let (positions, velocities) = (&mut out.over_positions, &mut out.over_velocities);
        let (Some(k), Some(d)) = (positions.spokes.get_mut(j), velocities.spokes.get_mut(j)) else { return };
        let places = self.places(j);
        for (i, row) in own.iter().enumerate() {
            for (c, slope) in row.own_positions.into_iter().enumerate() {
                k.own[(i, c)] += slope;
            }
            for (c, slope) in row.own_velocities.into_iter().enumerate() {
                d.own[(i, c)] += slope;
            }
            if ring_moves {
                for c in 0..2 {
                    k.from_hub[(i, c)] += row.ring_position[c];
                    d.from_hub[(i, c)] += row.ring_velocity[c];
                }
            }
            out.over_time[places[i]] += row.time;
        }
        if !ring_moves {
            return;
        }
        for (i, row) in shared.iter().enumerate() {
            for (c, slope) in row.own_positions.into_iter().enumerate() {
                k.to_hub[(i, c)] += slope;
            }
            for (c, slope) in row.own_velocities.into_iter().enumerate() {
                d.to_hub[(i, c)] += slope;
            }
            for c in 0..2 {
                positions.hub[(i, c)] += row.ring_position[c];
                velocities.hub[(i, c)] += row.ring_velocity[c];
            }
            drift.hub[i] += row.time;
        }
    }

    /// Velocities of roller `j`.
    pub(super) fn places(&self, j: usize) -> [usize; 3] {
        [self.layout.roller(j), self.layout.roller(j) + 1, self.layout.spin(j)]
    }
}

/// Derivatives of one force over the coordinates that a contact with the inner raceway sees.
struct Row {
    /// Radial offset, travel.
    own_positions: [f64; 2],
    /// Radial speed, orbit speed, spin speed.
    own_velocities: [f64; 3],
    /// Of the ring, global axes.
    ring_position: [f64; 2],
    ring_velocity: [f64; 2],
    /// By the inputs.
    time: f64,
}

impl Row {
    /// From the derivatives in the frame of the roller at `site`; `turned` is that over the azimuth.
    fn new(row: &InnerDual, turned: f64, site: &ElementSite, drift: &Drift<'_>) -> Self {
        let e = &row.eps;
        Self {
            own_positions: [e[0], turned],
            own_velocities: [e[1], e[2], e[3]],
            ring_position: site.to_global([e[RING_POSITION], e[RING_POSITION + 1]]),
            ring_velocity: site.to_global([e[RING_VELOCITY], e[RING_VELOCITY + 1]]),
            time: e[RING_SPEED] * drift.rates.of(Input::RingSpeed) + e[9] * drift.thickening,
        }
    }
}

fn lift<const N: usize>(m: &RollerMotion<f64>) -> RollerMotion<Dual<N>> {
    RollerMotion {
        radial_offset: Dual::variable(m.radial_offset, 0),
        radial_speed: Dual::variable(m.radial_speed, 1),
        orbit_speed: Dual::variable(m.orbit_speed, 2),
        spin_speed: Dual::variable(m.spin_speed, 3),
    }
}

/// The forces of contact `i` over the coordinates: chain rule; the viscosity comes last.
fn chain<const N: usize>(batch: &Batch, i: usize, motion: &ContactMotion<Dual<N>>) -> ContactForce<Dual<N>> {
    let force = &batch.force;
    let slopes = batch.slopes.of(i);
    let inner = [&motion.delta, &motion.delta_dot, &motion.u1, &motion.u2];
    let over_coordinates = |value: f64, slopes: &[f64; DIRECTIONS]| {
        let mut out = Dual::<N>::constant(value);
        for (slope, x) in slopes.iter().zip(inner) {
            for (e, dx) in out.eps.iter_mut().zip(x.eps) {
                *e += slope * dx;
            }
        }
        out.eps[N - 1] += slopes[DIRECTIONS - 1];
        out
    };
    ContactForce {
        normal: over_coordinates(force.normal[i], &slopes[0]),
        friction: over_coordinates(force.friction[i], &slopes[1]),
        rolling_resistance: over_coordinates(force.rolling_resistance[i], &slopes[2]),
        ..ContactForce::none(Dual::constant(0.0))
    }
}

fn components<const N: usize>(wrench: &Wrench<Dual<N>>) -> [Dual<N>; 3] {
    [wrench.force[0], wrench.force[1], wrench.moment]
}
