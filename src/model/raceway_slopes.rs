//! Derivatives of the raceway forces: those of the laws, which come in columns, chained with those of the kinematics, by
//! dual numbers over the few coordinates that a contact sees.
//!
//! With the inner raceway, r = r_p + rho and the centre and velocity x, v of the ring in the frame of the roller, only
//! differences of places and velocities matter, and psi moves nothing but the ring, which turns backwards:
//!
//! ```text
//! dF/dx_r = -dF/drho + (psi_dot/r) dF/dpsi_dot,   dF/dv_r = -dF/drho_dot,   dF/dv_c = -(1/r) dF/dpsi_dot
//! dx_r/dpsi = x_c,  dx_c/dpsi = -x_r
//! d(e_r F_r + e_c F_c)/dpsi = e_r (dF_r/dpsi - F_c) + e_c (dF_c/dpsi + F_r)      force on the ring in global axes
//! ```

use super::batch::{Mate, Site};
use super::jacobian::Drift;
use super::law_slopes::{FORCES, Slopes, VISCOSITY, chain, contact_force};
use super::workspace::{ElementSite, Workspace};
use super::{Input, Model, RollerSet};
use crate::contact::raceway::{RingMotion, RollerMotion};
use crate::contact::{PairFrame, Wrench};
use crate::integrate::Linearization;
use crate::scalar::{Dual, Real};

/// Radial offset, radial speed, orbit speed, spin speed.
type OuterDual = Dual<4>;
/// The same and the centre of the ring across the roller's radius.
type InnerDual = Dual<5>;
const ACROSS: usize = 4;
/// Direction of the law that the speed of the ring moves: u2.
const SECOND_SPEED: usize = 3;

impl Model {
    /// Adds the derivatives of all raceway contacts. Those of their laws are in the batch.
    pub(super) fn add_raceways(
        &self,
        rollers: &RollerSet,
        (q, v): (&[f64], &[f64]),
        ws: &Workspace,
        drift: &mut Drift<'_>,
        out: &mut Linearization,
    ) {
        let ring = self.ring_motion(q, v);
        for (i, &Site { element: j, mate, .. }) in ws.raceways.sites.iter().enumerate() {
            match mate {
                Mate::Outer => {
                    let (motion, frame) = rollers.geometry.outer(&lift::<4>(&ws.elements[j].motion));
                    let (forces, slopes) = ws.raceways.slopes(i);
                    let [on_roller, _] = frame.wrenches(&chain(&forces, &slopes, &motion, None));
                    let time = Self::over_time(&slopes, &ws.raceways.sites[i].frame, 0.0, drift);
                    self.add_outer(j, &components(&on_roller), time.as_ref(), out);
                }
                Mate::Inner => self.differentiate_inner(rollers, ring, (i, j), ws, drift, out),
                Mate::Pocket(_) => {}
            }
        }
    }

    /// Rates of the forces (N/s) and moments (N m/s) on roller and mate while the second surface speed changes at `u2_rate`
    /// (m/s^2) and the viscosity as it does; `None` while neither does.
    #[inline]
    fn over_time(
        slopes: &Slopes,
        frame: &PairFrame<f64>,
        u2_rate: f64,
        drift: &Drift<'_>,
    ) -> Option<[Wrench<f64>; 2]> {
        let rate = |f: usize| slopes[f][SECOND_SPEED] * u2_rate + slopes[f][VISCOSITY] * drift.thickening;
        (u2_rate != 0.0 || drift.thickening != 0.0)
            .then(|| frame.wrenches(&contact_force(std::array::from_fn::<f64, FORCES, _>(rate))))
    }

    /// Adds the derivatives of contact `i`, of roller `j` with the inner ring.
    fn differentiate_inner(
        &self,
        rollers: &RollerSet,
        ring: ([f64; 2], [f64; 2]),
        (i, j): (usize, usize),
        ws: &Workspace,
        drift: &mut Drift<'_>,
        out: &mut Linearization,
    ) {
        let site = &ws.elements[j];
        let (x, v) = (site.to_local(ring.0), site.to_local(ring.1));
        let constant = InnerDual::constant;
        let motion = RingMotion {
            position: [constant(x[0]), InnerDual::variable(x[1], ACROSS)],
            velocity: [constant(v[0]), constant(v[1])],
            speed: constant(ws.inputs.of(Input::RingSpeed)),
        };
        let (motion, frame) = rollers.geometry.inner(&lift::<5>(&site.motion), &motion);
        let (forces, slopes) = ws.raceways.slopes(i);
        let [on_roller, on_ring] = frame.wrenches(&chain(&forces, &slopes, &motion, None));
        let r = rollers.geometry.pitch_radius + site.motion.radial_offset;
        let over = |force: &InnerDual| over_global(row(force, r, site, x, v), site);
        let own = [over(&on_roller.force[0]), over(&on_roller.force[1]), over(&on_roller.moment)];
        let [radial, across] = on_ring.force;
        let (mut first, mut second) = (row(&radial, r, site, x, v), row(&across, r, site, x, v));
        first[1] -= across.re;
        second[1] += radial.re;
        for (a, b) in first.iter_mut().zip(&mut second) {
            [*a, *b] = site.to_global([*a, *b]);
        }
        let shared = [over_global(first, site), over_global(second, site)];
        let frame = &ws.raceways.sites[i].frame;
        let speeding = -frame.arm_2 * drift.rates.of(Input::RingSpeed);
        let time = Self::over_time(&slopes, frame, speeding, drift);
        self.add_inner((j, site), (&own, &shared), time.as_ref(), drift, out);
    }

    fn add_outer(
        &self,
        j: usize,
        rows: &[OuterDual; 3],
        time: Option<&[Wrench<f64>; 2]>,
        out: &mut Linearization,
    ) {
        let (Some(k), Some(d)) =
            (out.over_positions.spokes.get_mut(j), out.over_velocities.spokes.get_mut(j))
        else {
            return;
        };
        for (i, row) in rows.iter().enumerate() {
            k.own[(i, 0)] += row.eps[0];
            for c in 0..3 {
                d.own[(i, c)] += row.eps[1 + c];
            }
        }
        self.add_own_rates(j, time, out);
    }

    fn add_own_rates(&self, j: usize, time: Option<&[Wrench<f64>; 2]>, out: &mut Linearization) {
        let Some([on_roller, _]) = time else { return };
        for (place, rate) in self.places(j).into_iter().zip(components(on_roller)) {
            out.over_time[place] += rate;
        }
    }

    fn add_inner(
        &self,
        (j, site): (usize, &ElementSite),
        (own, shared): (&[Row; 3], &[Row; 2]),
        time: Option<&[Wrench<f64>; 2]>,
        drift: &mut Drift<'_>,
        out: &mut Linearization,
    ) {
        let ring_moves = self.layout.ring.is_some();
        let (positions, velocities) = (&mut out.over_positions, &mut out.over_velocities);
        let (Some(k), Some(d)) = (positions.spokes.get_mut(j), velocities.spokes.get_mut(j)) else { return };
        for (i, row) in own.iter().enumerate() {
            for (c, slope) in row[..OWN_VELOCITIES].iter().enumerate() {
                k.own[(i, c)] += slope;
            }
            for c in 0..3 {
                d.own[(i, c)] += row[OWN_VELOCITIES + c];
            }
            if ring_moves {
                for c in 0..2 {
                    k.from_hub[(i, c)] += row[RING_POSITION + c];
                    d.from_hub[(i, c)] += row[RING_VELOCITY + c];
                }
            }
        }
        if ring_moves {
            for (i, row) in shared.iter().enumerate() {
                for c in 0..2 {
                    k.to_hub[(i, c)] += row[c];
                    positions.hub[(i, c)] += row[RING_POSITION + c];
                    velocities.hub[(i, c)] += row[RING_VELOCITY + c];
                }
                for c in 0..3 {
                    d.to_hub[(i, c)] += row[OWN_VELOCITIES + c];
                }
            }
            if let Some([_, on_ring]) = time {
                for (sum, rate) in drift.hub.iter_mut().zip(site.to_global(on_ring.force)) {
                    *sum += rate;
                }
            }
        }
        self.add_own_rates(j, time, out);
    }

    /// Velocities of roller `j`.
    #[inline]
    pub(super) fn places(&self, j: usize) -> [usize; 3] {
        [self.layout.roller(j), self.layout.roller(j) + 1, self.layout.spin(j)]
    }
}

/// Derivatives of one force over what a contact with the inner raceway sees: radial offset and travel; radial, orbit and
/// spin speed; centre of the ring; its velocity.
type Row = [f64; 9];
const OWN_VELOCITIES: usize = 2;
const RING_POSITION: usize = 5;
const RING_VELOCITY: usize = 7;

/// From the derivatives in the frame of the roller at `site`, at the radius `r` (m), with the centre `x` and the velocity
/// `v` of the ring in that frame.
#[inline]
fn row(force: &InnerDual, r: f64, site: &ElementSite, x: [f64; 2], v: [f64; 2]) -> Row {
    let [offset, radial, orbit, spin, across] = force.eps;
    let along = orbit * (site.motion.orbit_speed / r) - offset;
    let [v_r, v_c] = [-radial, -orbit / r];
    let turned = along * x[1] - across * x[0] + v_r * v[1] - v_c * v[0];
    [offset, turned, radial, orbit, spin, along, across, v_r, v_c]
}

/// The same over the ring's coordinates in global axes.
#[inline]
fn over_global(mut row: Row, site: &ElementSite) -> Row {
    for at in [RING_POSITION, RING_VELOCITY] {
        [row[at], row[at + 1]] = site.to_global([row[at], row[at + 1]]);
    }
    row
}

#[inline]
fn lift<const N: usize>(m: &RollerMotion<f64>) -> RollerMotion<Dual<N>> {
    RollerMotion {
        radial_offset: Dual::variable(m.radial_offset, 0),
        radial_speed: Dual::variable(m.radial_speed, 1),
        orbit_speed: Dual::variable(m.orbit_speed, 2),
        spin_speed: Dual::variable(m.spin_speed, 3),
    }
}

#[inline]
fn components<T: Copy>(wrench: &Wrench<T>) -> [T; 3] {
    [wrench.force[0], wrench.force[1], wrench.moment]
}
