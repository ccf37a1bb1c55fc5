//! Rollers and raceways that are not round.
//!
//! ```text
//! delta  += w_r(phi - theta) + w_b(alpha - beta)
//! delta' += w_r' (phi' - w_1) + w_b' (phi' - w_2)
//! force   -Q (n + k (w_r' + w_b')/d t)  on the roller,  its moment  Q w_b',  that on the ring about its centre  Q w_r'
//! ```
//!
//! phi angle of the line from the centre of the ring to that of the roller and d its length, theta and w_1 angle and speed of the ring; alpha direction of
//! the contact from the centre of the roller: phi, or phi + pi of an inner ring; beta and w_2 angle and speed of the roller; k = 1 outer, -1 inner.
//!
//! These are the derivatives of the approach over all coordinates, so waves neither make nor lose energy. The curvature in the laws stays that
//! of round bodies, and friction acts across n. Valid for slopes far below one and waves that are long beside the width of the contact.
//! Source: geometry.

use super::{RacewayGeometry, RingMotion};
use crate::bodies::{ElementMotion, Motions, OUTER_RING};
use crate::laws::contact_pair::ContactMotion;
use crate::pairs::{Grip, Waves};
use crate::scalar::{Numeric, math, place_of};
use crate::scene::Scene;
use std::f64::consts::PI;

/// Waves of a raceway and of the rollers in it.
#[derive(Debug)]
pub(super) struct Wavy {
    raceway: Option<Waves>,
    /// Of every roller.
    rollers: Box<[Option<Waves>]>,
}

/// Waves at the contacts of a roller, or of several: height of both together, m, and slopes of raceway and roller, m/rad.
#[derive(Clone, Copy, Debug)]
pub(super) struct Wave<T> {
    pub(super) height: T,
    pub(super) slopes: [T; 2],
}

/// A roller as it is seen from the centre of a ring.
#[derive(Clone, Copy, Debug)]
pub(super) struct Seen<T> {
    /// Direction of the line of centres, in the axes of the roller.
    pub(super) outwards: [T; 2],
    /// d, m.
    pub(super) distance: T,
    /// phi', rad/s.
    pub(super) turning: T,
}

impl<T: Numeric> Seen<T> {
    /// A roller with the centre of the ring at `ring`, both in the axes of the roller.
    #[inline(always)]
    pub(super) fn new(geometry: &RacewayGeometry, roller: &ElementMotion<T>, ring: &RingMotion<T>) -> Self {
        let r = roller.radial_offset + geometry.pitch_radius;
        let [x, y] = [r - ring.position[0], -ring.position[1]];
        let distance = (x * x + y * y).sqrt();
        let outwards = [x / distance, y / distance];
        let [vx, vy] = [roller.radial_speed - ring.velocity[0], r * roller.orbit_speed - ring.velocity[1]];
        Self { outwards, distance, turning: (outwards[0] * vy - outwards[1] * vx) / distance }
    }

    /// How phi changes with the place of the roller as it is seen from the ring, along the axes of the roller, rad/m.
    #[inline(always)]
    pub(super) fn ahead(&self) -> [T; 2] {
        let [x, y] = self.outwards;
        [-(y / self.distance), x / self.distance]
    }

    /// Puts a round contact with the outer (`side` 1) or inner ring (-1) on a wave, with these speeds of ring and roller in rad/s.
    #[inline(always)]
    pub(super) fn put_on(
        &self,
        wave: &Wave<T>,
        side: f64,
        [ring, roller]: [T; 2],
        motion: &mut ContactMotion<T>,
        grip: &mut Grip<T>,
    ) {
        let [of_raceway, of_roller] = wave.slopes;
        motion.delta += wave.height;
        motion.delta_dot =
            motion.delta_dot + of_raceway * (self.turning - ring) + of_roller * (self.turning - roller);
        let (steep, tangent) = ((of_raceway + of_roller) * side / self.distance, grip.tangent());
        grip.normal = [grip.normal[0] + steep * tangent[0], grip.normal[1] + steep * tangent[1]];
        grip.offset = of_roller;
        grip.on_mate[0] = of_raceway;
    }
}

impl Wavy {
    /// Of the raceway of the outer (0) or inner ring (1) of a scene with its rollers, if any of them has waves.
    pub(super) fn of(scene: &Scene, ring: usize) -> Option<Self> {
        let (outer, inner) = (scene.outer_ring.as_ref(), scene.inner_ring.as_ref());
        let (harmonics, table) = match ring {
            OUTER_RING => outer.map(|ring| (&ring.waviness, ring.waviness_table.as_ref()))?,
            _ => inner.map(|ring| (&ring.waviness, ring.waviness_table.as_ref()))?,
        };
        let given = scene.rollers.as_ref()?;
        let mut rollers = vec![None; given.count as usize];
        for group in &given.waviness {
            for roller in &group.rollers {
                // Numbers of no roller are what checks refuse.
                if let Some(waves) = rollers.get_mut(*roller as usize) {
                    *waves = Waves::new(&group.harmonics, group.table.as_ref());
                }
            }
        }
        let raceway = Waves::new(harmonics, table);
        (raceway.is_some() || rollers.iter().any(Option::is_some))
            .then(|| Self { raceway, rollers: rollers.into() })
    }

    /// Heights, slopes and curvatures of raceway and roller `j` where they touch; m, m/rad and m/rad^2.
    pub(super) fn under(
        &self,
        geometry: &RacewayGeometry,
        motions: &Motions,
        mate: usize,
        j: usize,
    ) -> [[f64; 3]; 2] {
        self.seen_under(&place(geometry, motions, mate, j).0, motions, mate, j)
    }

    /// The same with the roller as it is seen from the ring.
    fn seen_under(&self, seen: &Seen<f64>, motions: &Motions, mate: usize, j: usize) -> [[f64; 3]; 2] {
        let [x, y] = seen.outwards;
        let phi = motions.azimuth(j) + math::atan2(y, x);
        let alpha = if mate == OUTER_RING { phi } else { phi + PI };
        let at = |waves: &Option<Waves>, angle: f64| waves.as_ref().map_or([0.0; 3], |waves| waves.at(angle));
        [
            at(&self.raceway, phi - motions.shared[mate].angle),
            at(&self.rollers[j], alpha - motions.spin_angle(j)),
        ]
    }

    /// Puts the contact of roller `j` with the raceway of `mate` on its waves.
    pub(super) fn put_on(
        &self,
        geometry: &RacewayGeometry,
        motions: &Motions,
        (mate, j): (usize, usize),
        (motion, grip): (&mut ContactMotion<f64>, &mut Grip<f64>),
    ) {
        let (seen, spin) = place(geometry, motions, mate, j);
        let [raceway, roller] = self.seen_under(&seen, motions, mate, j);
        let wave = Wave { height: raceway[0] + roller[0], slopes: [raceway[1], roller[1]] };
        seen.put_on(&wave, side(mate), [motions.shared[mate].speed, spin], motion, grip);
    }

    /// Highest orders of the waves of the raceway and of any roller; zero where they are round.
    pub(super) fn highest_orders(&self) -> [f64; 2] {
        let order = |waves: Option<&Waves>| waves.map_or(0.0, Waves::highest_order);
        let of_rollers = self.rollers.iter().map(|waves| order(waves.as_ref())).fold(0.0, f64::max);
        [order(self.raceway.as_ref()), of_rollers]
    }
}

/// k of a ring.
pub(super) fn side(mate: usize) -> f64 {
    if mate == OUTER_RING { 1.0 } else { -1.0 }
}

/// Roller `j` as it is seen from the ring `mate`, and its spin speed, rad/s.
fn place(geometry: &RacewayGeometry, motions: &Motions, mate: usize, j: usize) -> (Seen<f64>, f64) {
    let (block, lane) = place_of(j);
    let (roller, ring) = (motions.blocks[block].motion.of(lane), &motions.shared[mate]);
    let frame = motions.frame(j);
    let ring = RingMotion {
        position: frame.to_local(ring.position),
        velocity: frame.to_local(ring.velocity),
        speed: ring.speed,
    };
    (Seen::new(geometry, &roller, &ring), roller.spin_speed)
}
