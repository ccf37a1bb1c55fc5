//! The end of a roller on a rib, or on the side of its pocket.
//!
//! ```text
//! end: a paraboloid over the disc |y| <= R_end;   rib: tangent plane of its cone in the meridian of the roller
//! N  = e cos(eps') b + f sin(eps') e_n(P),   eps' = eps + e f gamma,   e = +-1 the end, f = 1 a rib of the outer ring, -1 of the inner one
//! N1 = N . m1,   N2 = N . w,   Nu = N . e u,   m1 = (e_n - g u)/c,   w = u x m1
//! y  = point of {|y| <= R_end, f y_1 >= y_min} where y . (N1, N2) - z Nu is largest:   on the cap, its rim, the edge of the rib, or the corner of both
//! delta = cos(eps') e t + f sin(eps') (rho + (d - r)) + (L/2) (Nu - cos(eps)) - z Nu + cos(eps) y_n^2/(2 R_s) + y_1 N1 + y_2 N2 - sin(eps) y_n - g_f
//!         z = y_1^2/(2 R_1) + y_2^2/(2 R_2),   y_n = R_s tan(eps), or the nearest of y_min to R_end
//! on the roller for Q = 1:  force -(N + k_t e_t),   moment about P  -((X - P) x N - T u + T (g/c) m1),   T = y_1 N2 - y_2 N1
//! ```
//!
//! eps is how far the cone of the rib opens against the plane across the axis of an upright roller, which is inclined by gamma. A delta of a concave
//! function over a convex region has a continuous slope from the cap to the corner. T turns the roller about
//! its own axis by nothing. R_1 is R_s; so is R_2 beside a cylinder, whose rib is nearly a plane: left out is its curvature across the meridian,
//! f sin(eps) y_2^2/(2 rho_c), a micrometre at 3 mm. The rib of a tapered bearing is nearly as round as the end, and 1/R_2 = 1/R_s - f sin(eps')/rho_c, rho_c
//! the distance of the contact from the axis of the bearing. Source: geometry; the gradient is exact.

#[cfg(test)]
mod tests;

use super::{MovingRoller, Spot};
use crate::bodies::{Inclination, MovingRing};
use crate::pairs::raceway::{Cones, OffAxis, RacewayGeometry};
use crate::scalar::Real;
use crate::space::solid::{Moving, cross, difference, dot, scaled, sum};

/// Square of a speed, m^2/s^2, that is added so that its size has a slope at none.
const SPEED_FLOOR: f64 = 1e-24;
/// Most steps to the rim; a few are usual.
const MOST_STEPS: usize = 40;
/// Least share by which an end must be rounder than its rib.
const LEAST_DIFFERENCE: f64 = 0.01;

/// What of an end touches.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Region {
    Cap,
    Rim,
    Edge,
    Corner,
}

/// The shape of the ends of rollers.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct EndShape {
    /// R_s, R_end and L, m.
    pub(crate) cap_radius: f64,
    pub(crate) face_radius: f64,
    pub(crate) length: f64,
}

impl EndShape {
    /// That of the end at +x (1.0) or -x (-1.0) of rollers with these cones, of which it is that of the large one.
    fn at(self, side: f64, cones: &Cones) -> Self {
        let smaller = if side > 0.0 { 0.0 } else { self.length * cones.growth };
        Self { face_radius: self.face_radius - smaller, ..self }
    }
}

/// An end beside its rib.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct RibGeometry {
    pitch_radius: f64,
    end: EndShape,
    /// eps and eps'.
    opening: Inclination,
    angle: Inclination,
    /// R_2, m.
    across_radius: f64,
    /// f and e.
    outwards: f64,
    side: f64,
    /// y_min and g_f, m.
    lowest: f64,
    gap: f64,
}

/// An end on a rib.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct EndTouch<T> {
    pub(crate) spot: Spot<T>,
    /// y_1 and y_2, m.
    pub(crate) place: [T; 2],
    pub(crate) region: Region,
    /// Motion of the roller against the ring, at the centre of the roller.
    pub(crate) passing: Moving<T>,
}

/// Where the rim of the face is nearest to a point outside of it, by lengths over the roots of these radii (m): y_i = a_i/(1 + l R_i).
fn on_rim<T: Real>([a, b]: [T; 2], [first, second]: [f64; 2], face: f64) -> [T; 2] {
    if first == second {
        let scale = T::constant(face) / (a * a + b * b).sqrt();
        return [a * scale, b * scale];
    }
    // |y|^2 falls with l and is convex: Newton's steps from zero come from one side. The last one carries the derivative.
    let step = |l: f64| {
        let [shrunk, other] = [first, second].map(|radius| 1.0 / (1.0 + l * radius));
        let (p, q) = (a * shrunk, b * other);
        let (p, q) = (p * p, q * q);
        (p + q - face * face) / ((p * (shrunk * first) + q * (other * second)) * 2.0)
    };
    let mut l = 0.0;
    for _ in 0..MOST_STEPS {
        let by = step(l).value();
        l += by;
        if by <= 1e-15 * l {
            break;
        }
    }
    let l = step(l) + l;
    [a / (l * first + 1.0), b / (l * second + 1.0)]
}

/// The point of the face above the edge of the rib that reaches furthest, where a cap with these radii (m) without edges does so at `[a, b]`, m.
fn nearest<T: Real>(
    [a, b]: [T; 2],
    radii: [f64; 2],
    face: f64,
    outwards: f64,
    lowest: f64,
) -> ([T; 2], Region) {
    let above = |y: T| outwards * y.value() >= lowest;
    let within = (a * a + b * b).value() <= face * face;
    if within && above(a) {
        return ([a, b], Region::Cap);
    }
    if !within {
        let rim = on_rim([a, b], radii, face);
        if above(rim[0]) {
            return (rim, Region::Rim);
        }
    }
    let edge = outwards * lowest;
    let width = (face * face - lowest * lowest).max(0.0).sqrt();
    if !above(a) && b.value().abs() <= width {
        return ([T::constant(edge), b], Region::Edge);
    }
    ([T::constant(edge), T::constant(if b.value() < 0.0 { -width } else { width })], Region::Corner)
}

impl RibGeometry {
    /// Of a rib of the outer (0) or inner (1) ring at +x (1.0) or -x (-1.0) of rollers between these raceways whose cone opens by `angle` (rad), reaching
    /// `height` (m) above the raceway, with the play of a roller between two ribs, m. `None` where the rib is rounder than the end.
    ///
    /// The play of a tapered roller is at its small end.
    pub(crate) fn rib(
        geometry: &RacewayGeometry,
        end: EndShape,
        (ring, side): (usize, f64),
        [angle, height, end_play]: [f64; 3],
    ) -> Option<Self> {
        let RacewayGeometry { pitch_radius, roller_radius, gap, cones } = *geometry;
        let outwards = if ring == 0 { 1.0 } else { -1.0 };
        let end = end.at(side, &cones);
        let large = roller_radius + gap + 0.5 * side * end.length * cones.growth;
        let opening = Inclination::new(angle);
        let play = match (cones == Cones::NONE, side > 0.0) {
            (true, _) => 0.5 * end_play,
            (false, true) => 0.0,
            (false, false) => end_play,
        };
        let mut rib = Self {
            pitch_radius,
            end,
            opening,
            angle: opening.turned_by(cones.inclination, side * outwards),
            across_radius: end.cap_radius,
            outwards,
            side,
            lowest: large - height,
            gap: opening.cos * play,
        };
        if cones != Cones::NONE {
            let of_rib = rib.round(&cones);
            if of_rib >= (1.0 - LEAST_DIFFERENCE) / end.cap_radius {
                return None;
            }
            rib.across_radius = 1.0 / (1.0 / end.cap_radius - of_rib);
        }
        Some(rib)
    }

    /// Of the side of a pocket of rollers between these raceways, with this play of the roller along the axis, m.
    pub(crate) fn pocket_side(geometry: &RacewayGeometry, end: EndShape, side: f64, play: f64) -> Self {
        let end = end.at(side, &geometry.cones);
        Self {
            pitch_radius: geometry.pitch_radius,
            end,
            opening: Inclination::NONE,
            angle: Inclination::NONE.turned_by(geometry.cones.inclination, side),
            across_radius: end.cap_radius,
            outwards: 1.0,
            side,
            lowest: -end.face_radius,
            gap: 0.5 * play,
        }
    }

    /// y_n, m: where an untilted end touches. A cap whose middle is off the face or below the edge of the rib does so with its rim or at
    /// that edge.
    fn middle(&self) -> f64 {
        let of_cap = self.end.cap_radius * self.opening.sin / self.opening.cos;
        of_cap.max(self.lowest).min(self.end.face_radius)
    }

    /// Curvature of the cone of the rib across the meridian, where an upright roller touches it, 1/m: positive where it is hollow.
    fn round(&self, cones: &Cones) -> f64 {
        let Inclination { sin, cos } = cones.inclination;
        let of_rib =
            self.pitch_radius + 0.5 * self.side * self.end.length * sin + self.outwards * self.middle() * cos;
        self.outwards * self.angle.sin / of_rib
    }

    /// Curvatures of end and rib together, 1/m: the larger one first.
    pub(crate) fn curvatures(&self, cones: &Cones) -> [f64; 2] {
        let along = 1.0 / self.end.cap_radius;
        if *cones == Cones::NONE {
            // A circle with half of the curvature of the rib. A cap that is flatter than its rim can lean against the rib has the curvature of a cap
            // there, so that it is no contact of conforming surfaces.
            let Inclination { sin, cos } = self.opening;
            let (cap, middle) = (self.end.cap_radius, self.middle());
            let slope = if middle < cap * sin / cos { cos * middle / cap } else { sin };
            let of_rib = self.pitch_radius + self.outwards * middle;
            return [along - self.outwards * slope / (2.0 * of_rib); 2];
        }
        let across = along - self.round(cones);
        [along.max(across), along.min(across)]
    }

    /// Whether the end of a roller there that is longer than nominal by `longer` (m) is certainly apart from its rib.
    pub(crate) fn apart(&self, roller: &MovingRoller<f64>, ring: &MovingRing<f64>, longer: f64) -> bool {
        if self.angle != self.opening {
            // Of an inclined roller nothing is told early.
            return false;
        }
        let (Inclination { sin, cos }, b) = (self.angle, ring.axis);
        let (place, [ox, or, ot]) = (roller.place, ring.centre);
        let t = (place.x - ox) * b[0] + (place.rho + self.pitch_radius - or) * b[1] - ot * b[2];
        let off = difference(place.axis, b);
        let angle = 1.01 * dot(off, off).sqrt();
        // The face turned by the angle, the middle shifted along the cone.
        let across =
            place.rho.abs() + or.abs() + ot.abs() + self.pitch_radius * (b[1].abs() + b[2].abs()) * sin;
        let turned = self.end.face_radius * angle + 0.5 * self.end.length * sin * angle;
        // Untilted, y_1 N1 - |y|^2/(2 R_s) is largest at y_n.
        cos * self.side * t + sin * across + turned + angle * angle * self.end.cap_radius + 0.5 * longer
            < self.gap
    }

    /// The end of a roller there that is longer than nominal by `longer`, m. They touch where delta is above zero.
    pub(crate) fn touch<T: Real>(
        &self,
        roller: &MovingRoller<T>,
        ring: &MovingRing<T>,
        longer: f64,
    ) -> EndTouch<T> {
        let Inclination { sin, cos } = self.angle;
        let (e, f, half) = (self.side, self.outwards, 0.5 * (self.end.length + longer));
        let radii = [self.end.cap_radius, self.across_radius];
        let (u, b, [ox, or, ot]) = (roller.place.axis, ring.axis, ring.centre);
        let one = T::constant(1.0);
        let r = roller.place.rho + self.pitch_radius;
        let along = roller.place.x - ox;
        let OffAxis { along: t, square, distance: d, outward: e_n, tangent: e_t } =
            OffAxis::new(r, [along, -or, -ot], b);
        let g = dot(e_n, u);
        let c = (one - g * g).sqrt();
        let normal = sum(scaled(b, one * (e * cos)), scaled(e_n, one * (f * sin)));
        let m1 = scaled(difference(e_n, scaled(u, g)), one / c);
        let w = cross(u, m1);
        let (n1, n2, nu) = (dot(normal, m1), dot(normal, w), dot(normal, u) * e);
        let free = [n1 / nu * radii[0], n2 / nu * radii[1]];
        let ([y1, y2], region) = nearest(free, radii, self.end.face_radius, f, self.lowest);
        let drop = y1 * y1 * (0.5 / radii[0]) + y2 * y2 * (0.5 / radii[1]);
        let y_n = self.middle();
        let opening = self.opening;
        let delta = t * (cos * e)
            + (roller.place.rho + square / (d + r)) * (f * sin)
            + (nu - opening.cos) * half
            + 0.5 * longer * opening.cos
            - drop * nu
            + y1 * n1
            + y2 * n2
            + (opening.cos * y_n * y_n * 0.5 / radii[0] - opening.sin * y_n - self.gap);
        let arm = sum(scaled(u, (-drop + half) * e), sum(scaled(m1, y1), scaled(w, y2)));
        let turn = y1 * n2 - y2 * n1;
        let tangential = dot(arm, e_t) / d * (f * sin) + turn * dot(w, e_t) / (c * d);
        let n = sum(normal, scaled(e_t, tangential));
        let moment = sum(difference(cross(arm, normal), scaled(u, turn)), scaled(m1, turn * g / c));
        let unit = [n.map(|x| -x), moment.map(|x| -x)];
        let from_ring = [along, r - or, -ot];
        let carried = sum(ring.moving.velocity, cross(ring.moving.turning, from_ring));
        let passing = Moving {
            velocity: difference(roller.moving.velocity, carried),
            turning: difference(roller.moving.turning, ring.moving.turning),
        };
        let delta_dot = -passing.power(unit);
        let across = cross(normal, e_t);
        let slip = sum(passing.velocity, cross(passing.turning, arm));
        let slip = [dot(slip, e_t), dot(slip, across)];
        // Past the place of contact, which goes round with the azimuth.
        let Moving { velocity, turning } = roller.moving;
        let around = velocity[2] / r;
        let zero = T::constant(0.0);
        let at = sum([zero, r, zero], arm);
        let carried = sum([zero, velocity[1], zero], cross([around, zero, zero], at));
        let of_roller = difference(sum(velocity, cross(turning, arm)), carried);
        let of_roller = [dot(of_roller, e_t), dot(of_roller, across)];
        let of_ring = [of_roller[0] - slip[0], of_roller[1] - slip[1]];
        let size = |[a, b]: [T; 2]| (a * a + b * b + SPEED_FLOOR).sqrt();
        let mean = [(of_roller[0] + of_ring[0]) * 0.5, (of_roller[1] + of_ring[1]) * 0.5];
        let spot = Spot {
            delta,
            delta_dot,
            surface_speeds: [size(of_roller), size(of_ring)],
            entrainment: size(mean),
            slip,
            normal: unit,
            along: [e_t, cross(arm, e_t)],
            across: [across, cross(arm, across)],
            rolling: [[zero; 3]; 2],
        };
        EndTouch { spot, place: [y1, y2], region, passing }
    }
}
