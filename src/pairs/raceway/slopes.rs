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

use super::kinematics::{RacewayGeometry, RingMotion};
use crate::bodies::{Element, ElementMotion, INNER_RING, Input, Motions};
use crate::pairs::contacts::{FORCES, Slopes, VISCOSITY, chain, contact_force};
use crate::pairs::{Batch, Grip, SlopeSums};
use crate::scalar::{Dual, Real};
use crate::space::Wrench;

/// Radial offset, radial speed, orbit speed, spin speed.
type OuterDual = Dual<4>;
/// The same and the centre of the ring across the roller's radius.
type InnerDual = Dual<5>;
const ACROSS: usize = 4;
/// Direction of the law that the speed of the ring moves: u2.
const SECOND_SPEED: usize = 3;

/// Adds those of contact `i` of a batch, with the outer ring.
pub(super) fn add_outer(
    geometry: &RacewayGeometry,
    batch: &Batch,
    i: usize,
    motions: &Motions,
    sums: &mut SlopeSums<'_>,
) {
    let j = batch.sites[i].element;
    let (motion, grip) = geometry.outer(&lift::<4>(&motions.element(j).motion));
    let (forces, slopes) = batch.slopes(i);
    let [on_roller, _] = grip.wrenches(&chain(&forces, &slopes, &motion, None));
    let rows = on_roller.components().map(|row: OuterDual| {
        let [offset, radial, orbit, spin] = row.eps;
        ([offset], [radial, orbit, spin])
    });
    sums.add_own(j, &rows);
    if let Some([on_roller, _]) = over_time(&slopes, &batch.grip(i), 0.0, sums.ln_viscosity_rate) {
        sums.add_own_over_time(j, &on_roller.components());
    }
}

/// Adds those of contact `i` of a batch, with the inner ring.
pub(super) fn add_inner(
    geometry: &RacewayGeometry,
    batch: &Batch,
    i: usize,
    motions: &Motions,
    sums: &mut SlopeSums<'_>,
) {
    let (j, ring) = (batch.sites[i].element, &motions.shared[INNER_RING]);
    let element = &motions.element(j);
    let (x, v) = (element.frame.to_local(ring.position), element.frame.to_local(ring.velocity));
    let constant = InnerDual::constant;
    let seen = RingMotion {
        position: [constant(x[0]), InnerDual::variable(x[1], ACROSS)],
        velocity: [constant(v[0]), constant(v[1])],
        speed: constant(ring.speed),
    };
    let (motion, grip) = geometry.inner(&lift::<5>(&element.motion), &seen);
    let (forces, slopes) = batch.slopes(i);
    let [on_roller, on_ring] = grip.wrenches(&chain(&forces, &slopes, &motion, None));
    let over = |force: &InnerDual| over_global(row(force, element, x, v), element);
    let own = [over(&on_roller.force[0]), over(&on_roller.force[1]), over(&on_roller.moment)];
    let [radial, across] = on_ring.force;
    let (mut first, mut second) = (row(&radial, element, x, v), row(&across, element, x, v));
    first[1] -= across.re;
    second[1] += radial.re;
    for (a, b) in first.iter_mut().zip(&mut second) {
        [*a, *b] = element.frame.to_global([*a, *b]);
    }
    let shared = [over_global(first, element), over_global(second, element)];
    let ring_moves = sums.layout.shared(INNER_RING).is_some();
    sums.add_own(j, &own.map(over_element));
    let held = batch.grip(i);
    let [_, arm, _] = held.on_mate;
    let speeding = -arm * sums.rates.of(Input::RingSpeed);
    let time = over_time(&slopes, &held, speeding, sums.ln_viscosity_rate);
    if ring_moves {
        sums.add_own_over_mate(j, INNER_RING, &own.map(over_ring));
        sums.add_mate_over_own(j, INNER_RING, &shared.map(over_element));
        sums.add_mate(INNER_RING, INNER_RING, &shared.map(over_ring));
        if let Some([_, on_ring]) = &time {
            sums.add_mate_over_time(INNER_RING, &element.frame.to_global(on_ring.force));
        }
    }
    if let Some([on_roller, _]) = time {
        sums.add_own_over_time(j, &on_roller.components());
    }
}

/// Rates of the forces (N/s) and moments (N m/s) on roller and mate while the second surface speed changes at `u2_rate`
/// (m/s^2) and the logarithm of the viscosity at `ln_viscosity_rate` (1/s); `None` while neither does.
#[inline]
fn over_time(
    slopes: &Slopes,
    grip: &Grip<f64>,
    u2_rate: f64,
    ln_viscosity_rate: f64,
) -> Option<[Wrench<f64>; 2]> {
    let rate = |f: usize| slopes[f][SECOND_SPEED] * u2_rate + slopes[f][VISCOSITY] * ln_viscosity_rate;
    (u2_rate != 0.0 || ln_viscosity_rate != 0.0)
        .then(|| grip.wrenches(&contact_force(std::array::from_fn::<f64, FORCES, _>(rate))))
}

/// Derivatives of one force over what a contact with the inner raceway sees: radial offset and travel; radial, orbit and
/// spin speed; centre of the ring; its velocity.
type Row = [f64; 9];
const RING_POSITION: usize = 5;
const RING_VELOCITY: usize = 7;

#[inline]
fn over_element([p0, p1, v0, v1, v2, ..]: Row) -> ([f64; 2], [f64; 3]) {
    ([p0, p1], [v0, v1, v2])
}

#[inline]
fn over_ring([.., x0, x1, w0, w1]: Row) -> ([f64; 2], [f64; 2]) {
    ([x0, x1], [w0, w1])
}

/// From the derivatives in the frame of the roller, with the centre `x` and the velocity `v` of the ring in that frame.
#[inline]
fn row(force: &InnerDual, element: &Element, x: [f64; 2], v: [f64; 2]) -> Row {
    let r = element.radius;
    let [offset, radial, orbit, spin, across] = force.eps;
    let along = orbit * (element.motion.orbit_speed / r) - offset;
    let [v_r, v_c] = [-radial, -orbit / r];
    let turned = along * x[1] - across * x[0] + v_r * v[1] - v_c * v[0];
    [offset, turned, radial, orbit, spin, along, across, v_r, v_c]
}

/// The same over the ring's coordinates in global axes.
#[inline]
fn over_global(mut row: Row, element: &Element) -> Row {
    for at in [RING_POSITION, RING_VELOCITY] {
        [row[at], row[at + 1]] = element.frame.to_global([row[at], row[at + 1]]);
    }
    row
}

#[inline]
fn lift<const N: usize>(m: &ElementMotion<f64>) -> ElementMotion<Dual<N>> {
    ElementMotion {
        radial_offset: Dual::variable(m.radial_offset, 0),
        radial_speed: Dual::variable(m.radial_speed, 1),
        orbit_speed: Dual::variable(m.orbit_speed, 2),
        spin_speed: Dual::variable(m.spin_speed, 3),
    }
}
