//! A disc of a roller that skews and tilts against the bars of its pocket of a cage that does so too.
//!
//! ```text
//! pocket's axes: b along that of the cage, o outwards, a ahead;   C = q + s u   centre of the disc,   p = C - (C . b) b,   R = R_b + dR - p(s)
//! wall    |phi| <= phi_p : d = |p|,            k = 1     delta = d - (R_p - R) - R (1 - c)
//! edge    |phi| >  phi_p : d = |p - R_p e|,    k = -1    delta = (R - d) - R (1 - c)
//! plane                  : d without limit,    k = 1     delta = +-p . a - (c_p/2 + R_b - R) - R (1 - c)
//! e_n from the axis of the wall or from the edge to the disc,   e_t = b x e_n,   g = e_n . u,   h = e_t . u,   c = sqrt(1 - g^2)
//! n = d(delta)/dC = k e_n - R (g h/(c d)) e_t
//! on the roller for Q = 1:   force -n,   moment about P  -s u x n + R (g/c) (u x e_n)
//! X = C + R m,   m = k (e_n - g u)/c,   t = k e_t     v = v_P + w x (X - P) - v_O - W x (X - O) - d'     u_1 = v . t,   u_2 = 0
//! ```
//!
//! Pockets of tapered rollers are inclined as these, and their walls grow with them: R, R_p and c_p/2 are those beside the disc, whose forces are across the
//! pocket's axis, so that what pushes the roller along by the cone, sin(beta) of the force, is left out. b and o are then turned by the inclination.
//!
//! P is the centre of the roller, at q from that of its pocket (as in `pairs/ball_pocket`), u its axis, O the centre of the cage and W its angular
//! velocity with its spin, d' the velocity at which a bent cage displaces the pocket. phi is the angle of p from the direction ahead, or behind, and
//! R_p e the edge at phi_p. Bars are as long as the roller, and their surface rests against the contact: nothing rolls. All differences of radii are
//! sums of small numbers. Force and moment are the gradient of delta and turn the roller about no axis of its own. With zero angles this is the
//! pocket in the plane (`pairs/pocket`). Source: geometry.
//!
//! Where a disc both tilts and skews against a wall, it reaches further beside e_n by (R g h)^2/(2 d), which is left out: 0.03 nm at 5 mrad and 8 nm
//! at 20 mrad in a pocket with a radial clearance of 0.15 mm. Where a wall becomes its edge, delta is continuous and n turns by R g h/d.

#[cfg(test)]
mod tests;

use super::{MovingRoller, Spot};
use crate::bodies::{Inclination, MovingCage};
use crate::pairs::ball_pocket::{InPocket, ahead};
use crate::pairs::raceway::Cones;
use crate::scalar::{Real, math, smoothstep};
use crate::space::solid::{Moving, Vector, cross, difference, dot, scaled, sum};

/// |p|^2, m^2, below which a disc is in the middle of its pocket and no place of the wall is nearest.
const LEAST_SQUARE: f64 = 1e-40;

/// Walls of the pockets.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum BarShape {
    /// Planes across the orbit.
    Planes,
    /// Cylinders that end in edges.
    Cylinders {
        /// phi_p, rad.
        half_angle: f64,
        /// Angle before the edge over which friction changes, rad.
        edge_blend: f64,
    },
}

/// The bars of all pockets.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Bars {
    /// Radius of the circle of pocket centres and nominal R_b, m.
    pitch_radius: f64,
    roller_radius: f64,
    /// On each side of a centred roller, m: R_p - R_b or c_p/2.
    clearance: f64,
    cones: Cones,
    shape: BarShape,
    /// Sine and cosine of the angles where the wall ends and where friction begins to change.
    edge: (f64, f64),
    blend: (f64, f64),
}

/// A roller between the bars of its pocket, in the axes of its azimuth.
#[derive(Clone, Copy, Debug)]
pub(crate) struct InBars<T> {
    /// Directions in which a bent cage displaces the pocket: outwards and ahead.
    pub(crate) displaced: [Vector<T>; 2],
    /// Directions of the pocket along its axis, outwards and ahead.
    pub(crate) axes: [Vector<T>; 3],
    /// q outwards and ahead in the pocket, m.
    pub(crate) offset: [T; 2],
    /// u, and its components outwards and ahead in the pocket.
    axis: Vector<T>,
    slopes: [T; 2],
    /// Motion of the roller against the material of the cage at its centre.
    pub(crate) passing: Moving<T>,
}

/// A disc against a bar.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct BarTouch<T> {
    pub(crate) spot: Spot<T>,
    /// Share of edge friction: 0 on the wall, 1 on an edge.
    pub(crate) edge_share: T,
}

/// What of a bar is nearest to the centre of a disc.
struct Nearest<T> {
    /// delta of an upright disc, m.
    approach: T,
    /// e_n outwards and ahead, and k.
    direction: [T; 2],
    side: f64,
    /// 1/d, 1/m.
    curvature: T,
    edge_share: T,
}

impl<T: Real> InBars<T> {
    /// Centre of the disc at `s` (m), outwards and ahead from that of the pocket, m.
    fn disc(&self, s: f64) -> [T; 2] {
        let ([q_out, q_ahead], [out, ahead]) = (self.offset, self.slopes);
        [q_out + out * s, q_ahead + ahead * s]
    }
}

impl Bars {
    /// From the radii of pitch circle and roller, the clearance on each side of a centred roller, m, and the shape of the walls.
    pub(crate) fn new(
        pitch_radius: f64,
        (roller_radius, cones): (f64, Cones),
        clearance: f64,
        shape: BarShape,
    ) -> Self {
        let (half_angle, edge_blend) = match shape {
            BarShape::Planes => (0.0, 0.0),
            BarShape::Cylinders { half_angle, edge_blend } => (half_angle, edge_blend),
        };
        let (edge, blend) = (math::sin_cos(half_angle), math::sin_cos(half_angle - edge_blend));
        Self { pitch_radius, roller_radius, clearance, cones, shape, edge, blend }
    }

    /// Where a roller is and how it moves at the azimuth with this cosine and sine, ahead of its pocket by `lead` (rad), which a bent cage displaces
    /// outwards and ahead by the first of `bent`, m, at the rate of the second, m/s.
    pub(crate) fn place<T: Real>(
        &self,
        roller: &MovingRoller<T>,
        direction: [T; 2],
        lead: T,
        cage: &MovingCage<T>,
        bent: Option<[[T; 2]; 2]>,
    ) -> InBars<T> {
        let at = [roller.place.x, roller.place.rho];
        let pocket =
            InPocket::new(self.pitch_radius, at, direction, lead, cage, bent.map(|[displaced, _]| displaced));
        let local = |v: Vector<T>| ahead(v, direction);
        let [zero, one] = [0.0, 1.0].map(T::constant);
        let [outwards, onwards] = [[zero, one, zero], [zero, zero, one]].map(|axis| pocket.at_azimuth(axis));
        let (u, turning, centre) = (roller.place.axis, local(cage.moving.turning), local(cage.centre));
        let from_cage = difference([at[0], at[1] + self.pitch_radius, zero], centre);
        let carried = sum(local(cage.moving.velocity), cross(turning, from_cage));
        let mut velocity = difference(roller.moving.velocity, carried);
        if let Some([_, [out, on]]) = bent {
            velocity = difference(velocity, sum(scaled(outwards, out), scaled(onwards, on)));
        }
        let Inclination { sin, cos } = self.cones.inclination;
        let axis = local(cage.tilt.axis);
        let along = sum(scaled(axis, one * cos), scaled(outwards, one * sin));
        let out = difference(scaled(outwards, one * cos), scaled(axis, one * sin));
        let [x, radial, across] = pocket.q;
        InBars {
            displaced: [outwards, onwards],
            axes: [along, out, onwards],
            offset: [radial * cos - x * sin, across],
            axis: u,
            slopes: [dot(out, u), dot(onwards, u)],
            passing: Moving { velocity, turning: difference(roller.moving.turning, turning) },
        }
    }

    /// Whether no disc within `half_length` (m) of the middle of a roller larger than nominal by `excess` (m) can touch the bar in front (0) and
    /// the one behind (1). False where there is no number.
    pub(crate) fn apart<T: Real>(&self, place: &InBars<T>, half_length: f64, excess: f64) -> [bool; 2] {
        // The support of the wall in the direction of the disc is convex over s: largest at an end.
        let ends = [-half_length, half_length].map(|s| place.disc(s).map(T::value));
        [1.0, -1.0].map(|sign| {
            ends.iter().all(|[radial, across]| {
                let (towards, height, (sin, cos)) = (sign * across, radial.abs(), self.edge);
                let reach = match self.shape {
                    BarShape::Planes => towards,
                    BarShape::Cylinders { .. } if height * cos <= towards * sin => {
                        (towards * towards + height * height).sqrt()
                    }
                    BarShape::Cylinders { .. } => towards * cos + height * sin,
                };
                reach < self.clearance - excess
            })
        })
    }

    /// The disc at `s` (m) of a roller larger than nominal by `excess` (m), where its profile falls back by `drop` (m), against the bar in front (0)
    /// or behind (1). They touch where delta is above zero.
    pub(crate) fn spot<T: Real>(
        &self,
        place: &InBars<T>,
        wall: usize,
        s: f64,
        excess: f64,
        drop: f64,
    ) -> BarTouch<T> {
        let larger = excess - drop;
        let nominal = self.roller_radius + s * self.cones.growth;
        let radius = nominal + larger;
        let Nearest { approach, direction: [out, on], side, curvature, edge_share } =
            self.nearest(wall, place.disc(s), nominal, larger);
        let ([b, outwards, onwards], [u_out, u_on], u) = (place.axes, place.slopes, place.axis);
        let zero = T::constant(0.0);
        let e_n = sum(scaled(outwards, out), scaled(onwards, on));
        let e_t = difference(scaled(onwards, out), scaled(outwards, on));
        let (g, h) = (out * u_out + on * u_on, out * u_on - on * u_out);
        let c = (-(g * g) + 1.0).sqrt();
        let delta = approach - g * g * radius / (c + 1.0);
        let n = difference(scaled(e_n, T::constant(side)), scaled(e_t, g * h * curvature * radius / c));
        let tilting = scaled(cross(u, e_n), g * radius / c);
        let moment = sum(scaled(cross(u, n), T::constant(-s)), tilting);
        let Moving { velocity, turning } = place.passing;
        let delta_dot = dot(n, velocity) - dot(moment, turning);
        let rim = scaled(difference(e_n, scaled(u, g)), T::constant(side * radius) / c);
        let arm = sum(scaled(u, T::constant(s)), rim);
        let slip = sum(velocity, cross(turning, arm));
        let t = scaled(e_t, T::constant(side));
        let u1 = dot(slip, t);
        let spot = Spot {
            delta,
            delta_dot,
            surface_speeds: [u1, zero],
            entrainment: u1 * 0.5,
            slip: [u1, dot(slip, b)],
            normal: [n.map(|x| -x), moment],
            along: [t, cross(arm, t)],
            across: [b, cross(arm, b)],
            rolling: [[zero; 3]; 2],
        };
        BarTouch { spot, edge_share }
    }

    /// What of a bar is nearest to a disc here (m), whose radius is larger than the nominal one (m) by `larger`, m.
    fn nearest<T: Real>(
        &self,
        wall: usize,
        [radial, across]: [T; 2],
        nominal: f64,
        larger: f64,
    ) -> Nearest<T> {
        let sign = if wall == 0 { 1.0 } else { -1.0 };
        let zero = T::constant(0.0);
        let (towards, height, room) = (across * sign, radial.abs(), self.clearance - larger);
        let plane = |towards: T| Nearest {
            approach: towards - room,
            direction: [zero, T::constant(sign)],
            side: 1.0,
            curvature: zero,
            edge_share: zero,
        };
        let BarShape::Cylinders { half_angle, edge_blend } = self.shape else { return plane(towards) };
        let square = towards * towards + radial * radial;
        // |phi| > the angle, without it.
        let beyond = |(sin, cos): (f64, f64)| towards.value() * sin < height.value() * cos;
        if beyond(self.edge) {
            let (sin, cos) = self.edge;
            let (pocket_radius, radius) = (nominal + self.clearance, nominal + larger);
            let edge = [radial.sign() * pocket_radius * sin, pocket_radius * cos];
            let inside =
                (radial * edge[0] + towards * edge[1]) * 2.0 - square - room * (radius + pocket_radius);
            let from_edge = [radial - edge[0], towards - edge[1]];
            let distance = (from_edge[0] * from_edge[0] + from_edge[1] * from_edge[1]).sqrt();
            return Nearest {
                // R - d without the difference of two radii.
                approach: inside / (distance + radius),
                direction: [from_edge[0] / distance, from_edge[1] * sign / distance],
                side: -1.0,
                curvature: T::constant(1.0) / distance,
                edge_share: T::constant(1.0),
            };
        }
        if square.value() < LEAST_SQUARE {
            return plane(zero);
        }
        let distance = square.sqrt();
        let edge_share = if edge_blend > 0.0 && beyond(self.blend) {
            smoothstep((height.atan2(towards) + (edge_blend - half_angle)) / edge_blend)
        } else {
            zero
        };
        Nearest {
            approach: distance - room,
            direction: [radial / distance, across / distance],
            side: 1.0,
            curvature: T::constant(1.0) / distance,
            edge_share,
        }
    }
}
