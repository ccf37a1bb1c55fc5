//! One ball between its races, standing still or going round: where its forces vanish, and what it then does to the inner ring.
//!
//! ```text
//! elastic        -Q_o n_o - Q_i n_i
//! centrifugal    m psi'^2 r outwards, weight
//! rolling        R (w - phi' a) . l = (Omega - phi') rho_c on both races, phi' = psi' r t_psi/vr, and (w - Omega a) . n = 0 on the
//!                race that controls, or w_r = 0 without control: three equations for psi', w_x, w_r
//! gyroscopic     the friction F of the race that controls gives the moment I psi' w_r:  F = -I psi' w_r/R along l
//! ```
//!
//! Source: Jones 1959, as in Harris and Kotzalas, Advanced Concepts of Bearing Technology, ch. 3, with the exact geometry of both
//! grooves instead of theirs for an untilted ring.

use super::settle::{Balance, settle};
use crate::laws::elastic::point::ElasticPoint;
use crate::pairs::groove::{Groove, RingPlace, Touch};
use crate::scalar::{Dual, Of, math};
use crate::space::solid::{Tilt, Vector, cross, dot, scaled, sum};
use nalgebra::{DMatrix, SMatrix, SVector};

/// What keeps balls from turning about the normals of their contacts, and gives them their gyroscopic moment.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum RaceControl {
    /// The outer one, as on fast balls.
    #[default]
    Outer,
    /// The inner one, as on slow ones.
    Inner,
    /// Neither: balls turn about axes parallel to that of the bearing, where there is no gyroscopic moment.
    None,
    /// No hypothesis: the steady motion under the traction of both contacts.
    Friction,
}

impl RaceControl {
    /// All, with their names.
    pub const ALL: [(&'static str, Self); 4] =
        [("outer", Self::Outer), ("inner", Self::Inner), ("none", Self::None), ("friction", Self::Friction)];
}

/// How often forces that are not elastic follow the ball to its rest; a few times are usual.
const FOLLOWINGS: usize = 60;

/// Coordinates of the ring beside a ball: x, outwards, along the orbit, and the rotation vector of its axis outwards and along the orbit.
pub(crate) const OF_RING: usize = 5;
/// With those of the ball, which come first: x and rho.
pub(super) const ALL: usize = 2 + OF_RING;

/// A ball and what acts on it beside the ring.
pub(crate) struct Ball<'a> {
    /// Of outer and inner race.
    pub(crate) grooves: [&'a Groove; 2],
    pub(crate) elastic: [&'a ElasticPoint; 2],
    /// By how much its radius is larger than nominal, m.
    pub(super) excess: f64,
    /// Mass, kg, and moment of inertia, kg m^2.
    pub(super) inertia: [f64; 2],
    /// Speeds of outer and inner ring, rad/s.
    pub(crate) speeds: [f64; 2],
    /// Acceleration of gravity outwards, m/s^2.
    pub(super) gravity: f64,
    pub(super) control: RaceControl,
}

/// How a ball goes round.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Rolling<T> {
    /// psi', rad/s.
    pub(crate) orbit: T,
    /// w_x and w_r, rad/s.
    pub(crate) spin: [T; 2],
}

/// Forces at one place of ball and ring.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Forces<T> {
    /// On the ball along x and outwards, N: all, and those that are not elastic.
    on_ball: [T; 2],
    outside: [T; 2],
    /// On the ring over its coordinates, N and N m.
    on_ring: [T; OF_RING],
    pub(crate) touches: [Touch<T>; 2],
    /// Q of outer and inner contact, N.
    pub(crate) loads: [T; 2],
    pub(crate) rolling: Rolling<T>,
}

/// Places of a ball (x, rho), m, by the angle about the centre of the outer groove's arc, times the length of its arm, and the distance from
/// there, m: a ball that only the outer race holds swings along one of them, however soft that is.
struct Polar {
    from_centre: [f64; 2],
    length: f64,
}

impl Polar {
    fn about(groove: &Groove) -> Self {
        Self { from_centre: groove.centre(), length: groove.length() }
    }

    fn of(&self, at: &SVector<f64, 2>) -> SVector<f64, 2> {
        let [x, r] = [0, 1].map(|k| at[k] + self.from_centre[k]);
        SVector::from([self.length * math::atan2(x, r), math::hypot(x, r) - self.length])
    }

    /// Sine and cosine of the angle, and the distance.
    fn arm(&self, polar: &SVector<f64, 2>) -> (f64, f64, f64) {
        let (sin, cos) = math::sin_cos(polar[0] / self.length);
        (sin, cos, self.length + polar[1])
    }

    fn place(&self, polar: &SVector<f64, 2>) -> SVector<f64, 2> {
        let (sin, cos, distance) = self.arm(polar);
        SVector::from([distance * sin - self.from_centre[0], distance * cos - self.from_centre[1]])
    }

    /// Forces and stiffness over these coordinates, from those over x and rho.
    fn turned(&self, polar: &SVector<f64, 2>, balance: Balance<2>) -> Balance<2> {
        let (sin, cos, distance) = self.arm(polar);
        let share = distance / self.length;
        let rows = SMatrix::<f64, 2, 2>::new(share * cos, sin, -share * sin, cos);
        let force = rows.transpose() * balance.force;
        let mixed = balance.force[0] * cos - balance.force[1] * sin;
        let curved = SMatrix::<f64, 2, 2>::new(-force[1] * share, mixed, mixed, 0.0) / self.length;
        Balance { force, stiffness: rows.transpose() * balance.stiffness * rows - curved, ..balance }
    }
}

/// What a ball at rest does to the ring.
#[derive(Clone, Copy, Debug)]
pub(super) struct OnRing {
    pub(super) force: SVector<f64, OF_RING>,
    /// -d(force)/d(coordinates) while the ball stays at rest.
    pub(super) stiffness: SMatrix<f64, OF_RING, OF_RING>,
    pub(super) energy: f64,
}

/// What an element does to the ring from a place of rest, by the forces on both over its coordinates, which come first, and those of the
/// ring; a stiffness of `least` (N/m) holds it where nothing does.
pub(super) fn following<const N: usize, const ALL: usize>(
    on_element: &[Dual<ALL>; N],
    on_ring: &[Dual<ALL>; OF_RING],
    energy: f64,
    least: f64,
) -> OnRing {
    let own = SMatrix::<f64, N, N>::from_fn(|i, k| -on_element[i].eps[k] + if i == k { least } else { 0.0 });
    let by_ring = SMatrix::<f64, N, OF_RING>::from_fn(|i, k| on_element[i].eps[N + k]);
    let of_element = SMatrix::<f64, OF_RING, N>::from_fn(|i, k| on_ring[i].eps[k]);
    let direct = SMatrix::<f64, OF_RING, OF_RING>::from_fn(|i, k| -on_ring[i].eps[N + k]);
    // An element that nothing touches does not follow.
    let own = DMatrix::from_column_slice(N, N, own.as_slice());
    let by_ring = DMatrix::from_column_slice(N, OF_RING, by_ring.as_slice());
    let follows = own
        .lu()
        .solve(&by_ring)
        .map_or_else(SMatrix::zeros, |found| SMatrix::<f64, N, OF_RING>::from_column_slice(found.as_slice()));
    let force = SVector::from(on_ring.map(|force| force.re));
    OnRing { force, stiffness: direct - of_element * follows, energy }
}

/// Solution of three linear equations, given by their rows.
fn solved<T: Of<f64>>([a, b, c]: [Vector<T>; 3], right: Vector<T>) -> Vector<T> {
    let [bc, ca, ab] = [cross(b, c), cross(c, a), cross(a, b)];
    let determinant = dot(a, bc);
    let combined = sum(sum(scaled(bc, right[0]), scaled(ca, right[1])), scaled(ab, right[2]));
    scaled(combined, determinant.like(1.0) / determinant)
}

impl Ball<'_> {
    pub(super) fn radius(&self) -> f64 {
        self.grooves[0].ball_radius + self.excess
    }

    fn controlling(&self) -> usize {
        usize::from(self.control == RaceControl::Inner)
    }

    /// How it goes round without slip in the middle of both contacts.
    fn rolling<T: Of<f64>>(&self, rho: T, touches: &[Touch<T>; 2], axes: [Vector<T>; 2]) -> Rolling<T> {
        let zero = rho.like(0.0);
        if self.speeds == [0.0; 2] {
            return Rolling { orbit: zero, spin: [zero; 2] };
        }
        let radius = self.radius();
        let row = |k: usize| {
            let (touch, axis) = (&touches[k], axes[k]);
            let turning = (rho + self.grooves[k].pitch_radius) * touch.along[2] / touch.ball_distance;
            let orbit = turning * (touch.contact_distance - dot(axis, touch.across) * radius);
            [orbit, touch.across[0] * radius, touch.across[1] * radius]
        };
        let k = self.controlling();
        let [nx, nr, _] = touches[k].normal;
        let (pivot, turning) = match self.control {
            RaceControl::None => ([zero, zero, rho.like(1.0)], zero),
            _ => ([zero, nx, nr], dot(axes[k], touches[k].normal) * self.speeds[k]),
        };
        let race = |k: usize| touches[k].contact_distance * self.speeds[k];
        let [orbit, x, r] = solved([row(0), row(1), pivot], [race(0), race(1), turning]);
        Rolling { orbit, spin: [x, r] }
    }

    /// Speed of the outer (0) or inner (1) race past its contact with a ball at `rho` (m) that goes round at `orbit` (rad/s), m/s.
    pub(crate) fn passing_speed(&self, k: usize, rho: f64, orbit: f64, touch: &Touch<f64>) -> f64 {
        let along = orbit * (rho + self.grooves[k].pitch_radius) * touch.along[2];
        (self.speeds[k] - along / touch.ball_distance) * touch.contact_distance
    }

    /// Forces with the ball at (x, rho) and the ring at these coordinates.
    pub(crate) fn forces<T: Of<f64>>(&self, [x, rho]: [T; 2], ring: [T; OF_RING]) -> Forces<T> {
        let zero = x.like(0.0);
        let tilt = Tilt::new([ring[3], ring[4]]);
        let places = [
            RingPlace { centre: [zero; 3], axis: [x.like(1.0), zero, zero] },
            RingPlace { centre: [ring[0], ring[1], ring[2]], axis: tilt.axis },
        ];
        let touches = [0, 1].map(|k| self.grooves[k].touch([x, rho], self.excess, &places[k]));
        let loads = [0, 1].map(|k| self.elastic[k].load(touches[k].delta));
        let rolling = self.rolling(rho, &touches, places.map(|place| place.axis));
        let [mass, inertia] = self.inertia;
        let orbit_radius = rho + self.grooves[0].pitch_radius;
        let outwards = rolling.orbit * rolling.orbit * orbit_radius * mass + mass * self.gravity;
        let lateral = match self.control {
            RaceControl::None => zero,
            _ => -(rolling.orbit * rolling.spin[1]) * (inertia / self.radius()),
        };
        let friction = [0, 1].map(|k| if k == self.controlling() { lateral } else { zero });
        let [rubbed, pressed] = [0, 1].map(|part| {
            [0, 1].map(|k| match part {
                0 => scaled(touches[k].across, friction[k]),
                _ => scaled(touches[k].normal, -loads[k]),
            })
        });
        let outside = [rubbed[0][0] + rubbed[1][0], rubbed[0][1] + rubbed[1][1] + outwards];
        let force = scaled(sum(rubbed[1], pressed[1]), x.like(-1.0));
        let inner = &touches[1];
        let arm = sum(inner.from_ring, scaled(inner.normal, x.like(self.radius())));
        let [over_r, over_psi] = tilt.moments_over_angles(cross(arm, force));
        Forces {
            on_ball: [0, 1].map(|i| outside[i] + pressed[0][i] + pressed[1][i]),
            outside,
            on_ring: [force[0], force[1], force[2], over_r, over_psi],
            touches,
            loads,
            rolling,
        }
    }

    /// Derivatives of the forces on ball and ring over (x, rho) and the coordinates of the ring, with the forces.
    fn slopes(&self, at: [f64; 2], ring: [f64; OF_RING]) -> Forces<Dual<ALL>> {
        let variable = |k: usize| Dual::<ALL>::variable(if k < 2 { at[k] } else { ring[k - 2] }, k);
        self.forces([0, 1].map(variable), std::array::from_fn(|k| variable(2 + k)))
    }

    /// Elastic energy of both contacts less the work of what else acts on the ball, as if that were constant, J.
    fn energy(&self, [x, rho]: [f64; 2], [along, outwards]: [f64; 2], forces: &Forces<Dual<ALL>>) -> f64 {
        let elastic: f64 = (0..2).map(|k| 0.4 * forces.loads[k].re * forces.touches[k].delta.re).sum();
        elastic - along * x - outwards * rho
    }

    /// Where the ball rests beside a ring at these coordinates, from a place (m) nearby; `None` where it finds none.
    ///
    /// Under constant forces beside the elastic ones that is a place of least energy, which is always found; these forces follow, again and
    /// again, until Newton's method finds the rest.
    pub(super) fn rest(&self, from: [f64; 2], ring: [f64; OF_RING]) -> Option<[f64; 2]> {
        let soft = 1e-3 * self.elastic[0].rigidity * (1e-3 * self.radius()).sqrt();
        let reach = 3.0 * self.grooves[0].length();
        let balance = |at: &SVector<f64, 2>, outside: Option<[f64; 2]>| {
            if at.norm() > reach {
                return None;
            }
            let forces = self.slopes((*at).into(), ring);
            let follows = outside.is_none();
            let outside = outside.unwrap_or_else(|| forces.outside.map(|force| force.re));
            let force = SVector::from_fn(|i, _| forces.on_ball[i].re - forces.outside[i].re + outside[i]);
            let stiffness = SMatrix::from_fn(|i, k| {
                let elastic = forces.outside[i].eps[k] - forces.on_ball[i].eps[k];
                if follows { elastic - forces.outside[i].eps[k] } else { elastic }
            });
            let size = forces.loads.iter().map(|load| load.re).sum();
            Some(Balance { force, stiffness, energy: self.energy((*at).into(), outside, &forces), size })
        };
        let mut at = SVector::from(from);
        for _ in 0..FOLLOWINGS {
            let outside = self.forces::<f64>(at.into(), ring).outside;
            let groove = Polar::about(self.grooves[0]);
            let found = settle(groove.of(&at), soft, &mut |polar| {
                Some(groove.turned(polar, balance(&groove.place(polar), Some(outside))?))
            });
            at = groove.place(&found.ok()?.x);
            if let Some(rest) = self.newton(at, |at| balance(at, None)) {
                return Some(rest.into());
            }
        }
        None
    }

    /// The rest that plain Newton steps find from a place nearby, if each brings them nearer.
    fn newton(
        &self,
        mut at: SVector<f64, 2>,
        balance: impl Fn(&SVector<f64, 2>) -> Option<Balance<2>>,
    ) -> Option<SVector<f64, 2>> {
        let mut here = balance(&at)?;
        while !here.is_rest() {
            let to = here.stiffness.lu().solve(&here.force).map(|step| at + step);
            let there = to.and_then(|to| Some((to, balance(&to)?)));
            match there.filter(|(_, there)| there.force.norm() <= 0.5 * here.force.norm()) {
                Some(nearer) => (at, here) = nearer,
                None => return here.is_nearly_rest().then_some(at),
            }
        }
        Some(at)
    }

    /// What it does to the ring from a place of rest.
    pub(super) fn on_ring(&self, at: [f64; 2], ring: [f64; OF_RING]) -> OnRing {
        let forces = self.slopes(at, ring);
        let energy = self.energy(at, forces.outside.map(|force| force.re), &forces);
        following(&forces.on_ball, &forces.on_ring, energy, 0.0)
    }
}
