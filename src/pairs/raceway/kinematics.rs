//! Roller against the raceway of the outer or the inner ring.
//!
//! The roller is described in cylindrical coordinates about the centre of the bearing: r = r_p + rho, angle psi.
//! rho is its offset from the pitch circle, so a gap of nanometres is a sum of small numbers and never a
//! difference of radii:
//!
//! ```text
//! outer gap = gap_0 - rho - (d - r)
//! inner gap = gap_0 + rho + (d - r),   d - r = (|x|^2 - 2 r x_r)/(d + r)
//! ```
//!
//! each less what the radius of the roller exceeds the nominal R_b, with x the centre of the ring, x_r its component along
//! the roller's radius and d its distance from the roller centre; d = r of an outer ring that is held in the centre. Local frame: (radial, circumferential) at the roller.
//!
//! Surface speeds are relative to the contact point, which moves with the line of centres:
//! `u1 = arm_1 (w_b - phi_dot)`, `u2 = -arm_2 (w_r - phi_dot)`, phi_dot the turning rate of that line.

use super::Cones;
use crate::bodies::ElementMotion;
use crate::laws::contact_pair::ContactMotion;
use crate::pairs::Grip;
use crate::scalar::Numeric;

/// Motion of a ring, its vectors in the local frame of a roller.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RingMotion<T> {
    /// Centre, m.
    pub position: [T; 2],
    /// Velocity of the centre, m/s.
    pub velocity: [T; 2],
    /// Rotation speed, rad/s.
    pub speed: T,
}

/// Radii of a roller set between its raceways.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RacewayGeometry {
    /// r_p, radius of the pitch circle: mean of the raceway radii, m.
    pub pitch_radius: f64,
    /// Nominal R_b, m.
    pub roller_radius: f64,
    /// Gap of a roller on the pitch circle to either raceway with the inner ring centred, m.
    pub gap: f64,
    /// Cones of rollers and raceways: `roller_radius` is that of the middle of a roller, the raceways are those beside it.
    pub(crate) cones: Cones,
}

impl RacewayGeometry {
    /// From the outer raceway radius, the roller radius with the cones, and the diametral clearance, m.
    pub(crate) fn new(
        outer_raceway_radius: f64,
        (roller_radius, cones): (f64, Cones),
        diametral_clearance: f64,
    ) -> Self {
        let gap = diametral_clearance / 4.0;
        let pitch_radius = outer_raceway_radius - roller_radius * cones.inclination.cos - gap;
        Self { pitch_radius, roller_radius, gap, cones }
    }

    /// Radius of the inner raceway in m, with this one of the outer.
    pub fn inner_radius(&self, outer_raceway_radius: f64) -> f64 {
        outer_raceway_radius - 2.0 * self.roller_radius * self.cones.inclination.cos - 2.0 * self.gap
    }

    /// Motion and levers of the contact with the outer raceway; the outer ring is centred and turns at this speed in rad/s.
    #[inline(always)]
    pub fn outer<T: Numeric>(&self, roller: &ElementMotion<T>, ring_speed: T) -> (ContactMotion<T>, Grip<T>) {
        let arm_1 = roller.radius_excess + self.roller_radius;
        let to_contact = roller.radial_offset + (self.pitch_radius + self.roller_radius);
        let arm_2 = -(to_contact + roller.radius_excess);
        let motion = ContactMotion {
            delta: roller.radial_offset - self.gap + roller.radius_excess,
            delta_dot: roller.radial_speed,
            u1: arm_1 * (roller.spin_speed - roller.orbit_speed),
            // In this order a ring at rest changes no bit.
            u2: arm_2 * (roller.orbit_speed - ring_speed),
        };
        let normal = [arm_1.like(1.0), arm_1.like(0.0)];
        (motion, Grip::centred(normal, arm_1, arm_2))
    }

    /// The same with an outer ring that moves: the normal leads from its centre through that of the roller.
    #[inline(always)]
    pub fn outer_beside<T: Numeric>(
        &self,
        roller: &ElementMotion<T>,
        ring: &RingMotion<T>,
    ) -> (ContactMotion<T>, Grip<T>) {
        let r = roller.radial_offset + self.pitch_radius;
        let from_ring = [r - ring.position[0], -ring.position[1]];
        let d = (from_ring[0] * from_ring[0] + from_ring[1] * from_ring[1]).sqrt();
        let normal = [from_ring[0] / d, from_ring[1] / d];
        let arm_1 = roller.radius_excess + self.roller_radius;
        let arm_2 = -(d + arm_1);
        let grip = Grip::centred(normal, arm_1, arm_2);
        let tangent = grip.tangent();
        let relative = [roller.radial_speed - ring.velocity[0], r * roller.orbit_speed - ring.velocity[1]];
        let turning = (relative[0] * tangent[0] + relative[1] * tangent[1]) / d;
        let motion = ContactMotion {
            delta: roller.radial_offset - self.gap + roller.radius_excess + shift(r, d, ring.position),
            delta_dot: relative[0] * normal[0] + relative[1] * normal[1],
            u1: arm_1 * (roller.spin_speed - turning),
            u2: arm_2 * (turning - ring.speed),
        };
        (motion, grip)
    }

    /// Motion and levers of the contact with the inner raceway.
    #[inline(always)]
    pub fn inner<T: Numeric>(
        &self,
        roller: &ElementMotion<T>,
        ring: &RingMotion<T>,
    ) -> (ContactMotion<T>, Grip<T>) {
        let r = roller.radial_offset + self.pitch_radius;
        let to_ring = [ring.position[0] - r, ring.position[1]];
        let d = (to_ring[0] * to_ring[0] + to_ring[1] * to_ring[1]).sqrt();
        let normal = [to_ring[0] / d, to_ring[1] / d];
        let arm_1 = roller.radius_excess + self.roller_radius;
        let arm_2 = d - arm_1;
        let grip = Grip::centred(normal, arm_1, arm_2);
        let tangent = grip.tangent();
        let relative = [ring.velocity[0] - roller.radial_speed, ring.velocity[1] - r * roller.orbit_speed];
        let turning = (relative[0] * tangent[0] + relative[1] * tangent[1]) / d;
        let motion = ContactMotion {
            delta: roller.radius_excess - (roller.radial_offset + self.gap + shift(r, d, ring.position)),
            delta_dot: -(relative[0] * normal[0] + relative[1] * normal[1]),
            u1: arm_1 * (roller.spin_speed - turning),
            u2: -(arm_2 * (ring.speed - turning)),
        };
        (motion, grip)
    }
}

/// d - r without cancellation.
#[inline(always)]
fn shift<T: Numeric>(r: T, d: T, ring: [T; 2]) -> T {
    (ring[0] * ring[0] + ring[1] * ring[1] - r * ring[0] * 2.0) / (d + r)
}

#[cfg(test)]
mod tests {
    use super::*;

    const G: RacewayGeometry =
        RacewayGeometry { pitch_radius: 0.03999, roller_radius: 0.0075, gap: 1e-5, cones: Cones::NONE };

    #[test]
    fn geometry_splits_the_clearance() {
        let g = RacewayGeometry::new(0.0475, (0.0075, Cones::NONE), 40e-6);
        assert!((g.pitch_radius - 0.03999).abs() < 1e-15);
        assert!((g.gap - 1e-5).abs() < 1e-18);
    }

    #[test]
    fn kinematic_speeds_roll_without_slip() {
        // Inner ring centred and turning: cage speed w_i (1 - gamma)/2, roller spin from rolling on the outer ring.
        let (r_i, r_o) = (0.03999 - 0.0075, 0.03999 + 0.0075);
        let w_i = -314.0;
        let orbit = w_i * r_i / (r_i + r_o);
        let spin = -orbit * 0.03999 / 0.0075;
        let roller = ElementMotion { orbit_speed: orbit, spin_speed: spin, ..ElementMotion::default() };
        let ring = RingMotion { position: [0.0; 2], velocity: [0.0; 2], speed: w_i };
        let (outer, _) = G.outer(&roller, 0.0);
        let (inner, frame) = G.inner(&roller, &ring);
        assert!((outer.u1 - outer.u2).abs() < 1e-13);
        assert!((inner.u1 - inner.u2).abs() < 1e-13);
        // Entrainment d_m w_i (1 - gamma^2)/4, in magnitude.
        let gamma = 0.0075 / 0.03999;
        let u = 2.0 * 0.03999 * 314.0 * (1.0 - gamma * gamma) / 4.0;
        assert!((outer.u1.abs() - u).abs() < 1e-12 && (inner.u1.abs() - u).abs() < 1e-12);
        assert_eq!(frame.normal, [-1.0, 0.0]);
        assert!((inner.delta + G.gap).abs() < 1e-20);
    }

    /// Approach to the inner raceway with all at rest.
    fn approach_at(radial_offset: f64, position: [f64; 2]) -> f64 {
        let roller = ElementMotion { radial_offset, ..ElementMotion::default() };
        G.inner(&roller, &RingMotion { position, velocity: [0.0; 2], speed: 0.0 }).0.delta
    }

    #[test]
    fn nanometre_gaps_keep_their_digits() {
        // The exact gap of a ring shifted along the radius is gap + rho - x: check it to 1e-22 m.
        let (rho, x) = (3.123_456_789e-9, 1.000_987_654_321e-5);
        let approach = approach_at(rho, [x, 0.0]);
        assert!((approach - (x - G.gap - rho)).abs() < 1e-20, "{approach}");
        // A sideways shift lengthens the distance by x^2/(2 r) to leading order.
        let approach = approach_at(0.0, [0.0, 2e-5]);
        let expected = -(G.gap + 4e-10 / (2.0 * G.pitch_radius));
        assert!((approach / expected - 1.0).abs() < 1e-9);
    }

    /// A roller beside an outer ring that moves is one beside a ring that is held, seen from that ring.
    #[test]
    fn an_outer_ring_that_moves_is_seen_from_its_centre() {
        let roller = ElementMotion {
            radial_offset: 2e-6,
            radial_speed: 0.01,
            orbit_speed: -120.0,
            spin_speed: 700.0,
            radius_excess: 1e-6,
        };
        let still = RingMotion { position: [0.0; 2], velocity: [0.0; 2], speed: 11.0 };
        let ((a, grip), (b, other)) = (G.outer(&roller, 11.0), G.outer_beside(&roller, &still));
        assert_eq!((a.delta, a.delta_dot, a.u1), (b.delta, b.delta_dot, b.u1));
        assert!((a.u2 - b.u2).abs() < 1e-13 && grip.normal == other.normal);
        assert!((grip.arm - other.arm).abs() < 1e-17);
        // Both on their way, with the frame of the roller seen from the ring.
        let ring = RingMotion { position: [8e-6, -1.5e-5], velocity: [0.02, -0.03], speed: 11.0 };
        let (moved, grip) = G.outer_beside(&roller, &ring);
        let r = G.pitch_radius + roller.radial_offset;
        let from = [r - ring.position[0], -ring.position[1]];
        let d = from[0].hypot(from[1]);
        let velocity = [roller.radial_speed - ring.velocity[0], r * roller.orbit_speed - ring.velocity[1]];
        let (n, t) = ([from[0] / d, from[1] / d], [-from[1] / d, from[0] / d]);
        let seen = ElementMotion {
            radial_offset: d - G.pitch_radius,
            radial_speed: velocity[0] * n[0] + velocity[1] * n[1],
            orbit_speed: (velocity[0] * t[0] + velocity[1] * t[1]) / d,
            ..roller
        };
        let (expected, _) = G.outer(&seen, 11.0);
        assert!((moved.delta - expected.delta).abs() < 1e-17, "{} {}", moved.delta, expected.delta);
        assert!((moved.delta_dot - expected.delta_dot).abs() < 1e-15);
        assert!((moved.u1 - expected.u1).abs() < 1e-13 && (moved.u2 - expected.u2).abs() < 1e-13);
        assert_eq!(grip.normal, n);
    }

    #[test]
    fn a_larger_roller_is_one_in_larger_raceways() {
        let excess = 3e-6;
        let roller = ElementMotion {
            radial_offset: 2e-6,
            radial_speed: 0.01,
            orbit_speed: -120.0,
            spin_speed: 700.0,
            radius_excess: excess,
        };
        let nominal = ElementMotion { radius_excess: 0.0, ..roller };
        let larger = RacewayGeometry { roller_radius: G.roller_radius + excess, gap: G.gap - excess, ..G };
        let ring = RingMotion { position: [8e-6, -1.5e-5], velocity: [0.02, -0.03], speed: -314.0 };
        let pairs = [
            (G.outer(&roller, 11.0), larger.outer(&nominal, 11.0)),
            (G.inner(&roller, &ring), larger.inner(&nominal, &ring)),
        ];
        for ((a, grip), (b, other)) in pairs {
            assert!((a.delta - b.delta).abs() < 1e-19 && a.delta_dot == b.delta_dot);
            assert!((a.u1 - b.u1).abs() < 1e-13 && (a.u2 - b.u2).abs() < 1e-13);
            assert!((grip.arm - other.arm).abs() < 1e-17 && grip.normal == other.normal);
        }
    }

    #[test]
    fn approach_speed_is_the_derivative_of_approach() {
        let roller = ElementMotion {
            radial_offset: 2e-6,
            radial_speed: 0.01,
            orbit_speed: -120.0,
            spin_speed: 700.0,
            radius_excess: 0.0,
        };
        let ring = RingMotion { position: [8e-6, -1.5e-5], velocity: [0.02, -0.03], speed: -314.0 };
        let (motion, frame) = G.inner(&roller, &ring);
        let h = 1e-9;
        let at = |s: f64| {
            // The ring vector as seen from the turning local frame.
            let turn = roller.orbit_speed * s;
            let x = [ring.position[0] + ring.velocity[0] * s, ring.position[1] + ring.velocity[1] * s];
            let x = crate::space::rotate(x, (-turn).sin(), (-turn).cos());
            approach_at(roller.radial_offset + roller.radial_speed * s, x)
        };
        let difference = (at(h) - at(-h)) / (2.0 * h);
        assert!((motion.delta_dot - difference).abs() < 1e-7, "{} {difference}", motion.delta_dot);
        assert!((motion.delta - at(0.0)).abs() < 1e-22);
        assert!((frame.normal[0].hypot(frame.normal[1]) - 1.0).abs() < 1e-15);
    }
}
