//! A ball in its pocket of a cage that moves in space.
//!
//! ```text
//! pocket at the azimuth psi - beta, beta = travel of the ball - angle of the cage; axes x, outwards, ahead there, before the cage tilts
//! q  = (x - x_c, rho - 2 r sin^2(beta/2) - Y_r, r sin beta - Y_psi) - r_p (Exp - 1) e_r,   then turned back by the tilt, less d
//! v  = v_ball + w_ball x R n - v_c - w_c x (P + R n - C) - d'                                 slip of ball on wall, and approach
//! N  of a spring and damper, or of Hertz's contact;   F = -N n - f D on the ball at P + R n, D the part of v across n;   the opposite on the cage
//! ```
//!
//! r distance of the ball at P from the axis of the bearing, Y centre C of the cage, d what a bent ring displaces the pocket by, outwards and
//! ahead; its walls keep their directions. No radii are subtracted. Friction is Coulomb's with a smooth transition through zero slip, of two
//! components and with the whole spin of the ball. Source: geometry; the laws are those of the plane.

mod place;
mod walls;

pub(crate) use place::{InPocket, ahead};
pub(crate) use walls::{WALLS, Wall, Walls};

use crate::bodies::MovingCage;
use crate::error::Result;
use crate::laws::contact_pair::ContactMotion;
use crate::laws::elastic::line::effective_modulus;
use crate::laws::elastic::normal::{NormalDamping, NormalForce};
use crate::laws::elastic::point::ElasticPoint;
use crate::laws::elastic::solid::SolidContact;
use crate::laws::traction::solid_friction::SolidFriction;
use crate::pairs::line_laws::LawBuilder;
use crate::scalar::Real;
use crate::scene::{HertzPocket, Pocket, PocketLaw, Scene, bad_scene, needed};
use crate::space::solid::{Moving, Vector, cross, difference, dot, scaled, sum};

/// Square of the slip, m^2/s^2, that is added so that its size has a slope at none.
const SLIP_FLOOR: f64 = 1e-24;

/// Pockets of a cage in space.
#[derive(Debug)]
pub(crate) struct BallPockets {
    pub(crate) walls: Walls,
    law: Law,
    /// Radius R of a ball without deviation, and r_p, m.
    ball_radius: f64,
    pitch_radius: f64,
    /// How far off the pitch circle a ball may be, m.
    pub(crate) height: f64,
}

/// Law of the contact.
#[derive(Clone, Copy, Debug)]
enum Law {
    Spring(SolidContact),
    Hertz { elastic: ElasticPoint, damping: Option<NormalDamping>, friction: Option<SolidFriction> },
}

/// A ball beside its pocket.
#[derive(Clone, Copy, Debug)]
pub(crate) struct BallAt<T> {
    /// x and rho, m.
    pub(crate) at: [T; 2],
    /// Cosine and sine of its azimuth.
    pub(crate) direction: [T; 2],
    /// beta, rad.
    pub(crate) lead: T,
    /// In the axes of its azimuth.
    pub(crate) moving: Moving<T>,
    /// How much larger than nominal its radius is, m.
    pub(crate) excess: f64,
    /// By how much a bent cage displaces its pocket, outwards and ahead, m, and the rates of that.
    pub(crate) bent: Option<[[T; 2]; 2]>,
}

/// A ball that touches a wall, in the axes of its azimuth.
#[derive(Clone, Copy, Debug)]
pub(crate) struct PocketContact<T> {
    pub(crate) depth: T,
    pub(crate) depth_rate: T,
    pub(crate) normal: Vector<T>,
    /// D, m/s.
    pub(crate) slip: Vector<T>,
    /// N, N, its damping, N s/m, and f, N s/m.
    pub(crate) force: T,
    pub(crate) damping: T,
    pub(crate) secant: T,
    /// Of the contact from the centres of ball and cage, m.
    pub(crate) levers: [Vector<T>; 2],
    /// Directions outwards and ahead in the pocket of a cage that bends.
    outwards_ahead: Option<[Vector<T>; 2]>,
}

/// Force, N, and moment about the centre, N m, on a body.
pub(crate) type OnBody<T> = [Vector<T>; 2];

impl BallPockets {
    /// Those of a scene whose cage moves in space.
    pub(crate) fn new(scene: &Scene, viscosity: Option<f64>) -> Result<Option<Self>> {
        let Some((cage, pocket)) = scene.cage.as_ref().and_then(|cage| Some((cage, cage.pocket.as_ref()?)))
        else {
            return Ok(None);
        };
        let ball_radius = scene.element_radius();
        let builder = LawBuilder::new(scene, viscosity);
        let half = |clearance: &f64| 0.5 * clearance;
        let (walls, law) = match pocket {
            Pocket::SolidPlane(pocket) => {
                let across = pocket.axial_clearance.as_ref().map(half);
                let walls = Walls::Planes { along: half(&pocket.diametral_clearance), across };
                (walls, Law::Spring(SolidContact::from(&pocket.contact)))
            }
            Pocket::SolidCylinder(round) | Pocket::SolidSphere(round) => {
                let sphere = matches!(pocket, Pocket::SolidSphere(_));
                let along = half(&round.diametral_clearance);
                let across = round.axial_clearance.as_ref().map_or(along, half);
                let law = match &round.law {
                    PocketLaw::Spring(contact) => Law::Spring(SolidContact::from(contact)),
                    PocketLaw::Hertz(law) => {
                        let wall = ball_radius + along.min(across);
                        Law::hertz(law, &builder, [ball_radius, wall], sphere)?
                    }
                };
                (Walls::round([along, across], sphere), law)
            }
            Pocket::LubricatedCylinder(_) => {
                let text =
                    "a law of the plane; in space give 'solid_plane', 'solid_cylinder' or 'solid_sphere'";
                return Err(bad_scene("cage.pocket.lubricated_cylinder", text));
            }
        };
        let height = cage.space.as_ref().and_then(|space| space.pocket_height).unwrap_or(ball_radius);
        Ok(Some(Self { walls, law, ball_radius, pitch_radius: scene.pitch_radius(), height }))
    }

    /// Where a ball is in its pocket.
    pub(crate) fn place<T: Real>(&self, ball: &BallAt<T>, cage: &MovingCage<T>) -> InPocket<T> {
        let bent = ball.bent.map(|[by, _]| by);
        InPocket::new(self.pitch_radius, ball.at, ball.direction, ball.lead, cage, bent)
    }

    /// Contact with wall `k`, of a ball that is there; `None` where it touches none.
    pub(crate) fn contact<T: Real>(
        &self,
        k: usize,
        ball: &BallAt<T>,
        place: &InPocket<T>,
        cage: &MovingCage<T>,
    ) -> Option<PocketContact<T>> {
        let wall: Wall<T> = self.walls.wall(k, place.q, ball.excess)?;
        // A depth that is no number is told by the forces.
        if wall.depth.value() <= 0.0 {
            return None;
        }
        let normal = place.at_azimuth(wall.normal);
        let local = |v: Vector<T>| ahead(v, ball.direction);
        let centre = local(cage.centre);
        let [x, rho] = ball.at;
        let r = rho + self.pitch_radius;
        let to_wall = scaled(normal, T::constant(self.ball_radius + ball.excess));
        let from_cage = sum([x - centre[0], r - centre[1], -centre[2]], to_wall);
        let of_ball = sum(ball.moving.velocity, cross(ball.moving.turning, to_wall));
        let of_cage = sum(local(cage.moving.velocity), cross(local(cage.moving.turning), from_cage));
        let mut passing = difference(of_ball, of_cage);
        let outwards_ahead = ball.bent.map(|[_, rates]| {
            let [zero, one] = [0.0, 1.0].map(T::constant);
            let axes = [[zero, one, zero], [zero, zero, one]];
            let axes = axes.map(|axis| place.at_azimuth(axis));
            passing = difference(passing, sum(scaled(axes[0], rates[0]), scaled(axes[1], rates[1])));
            axes
        });
        let depth_rate = dot(passing, normal);
        let slip = difference(passing, scaled(normal, depth_rate));
        let size = (dot(slip, slip) + SLIP_FLOOR).sqrt();
        let [force, damping, secant] = self.law.force(wall.depth, depth_rate, size);
        let levers = [to_wall, from_cage];
        let depth = wall.depth;
        Some(PocketContact {
            depth,
            depth_rate,
            normal,
            slip,
            force,
            damping,
            secant,
            levers,
            outwards_ahead,
        })
    }

    /// Elastic energy of a contact of this depth (m), J, and its force, N.
    pub(crate) fn spring(&self, depth: f64) -> [f64; 2] {
        match &self.law {
            Law::Spring(contact) => {
                let force = contact.stiffness * depth.max(0.0);
                [0.5 * force * depth, force]
            }
            Law::Hertz { elastic, .. } => {
                let force = elastic.load(depth);
                [0.4 * force * depth, force]
            }
        }
    }

    /// A stiffness for frequencies, N/m: of Hertz's law that at a depth of 1 um.
    pub(crate) fn stiffness(&self) -> f64 {
        match &self.law {
            Law::Spring(contact) => contact.stiffness,
            Law::Hertz { elastic, .. } => 1.5 * elastic.rigidity * 1e-3,
        }
    }

    /// Names of the contacts that a ball can have.
    pub(crate) fn wall_names(&self) -> &'static [&'static str] {
        match &self.walls {
            Walls::Planes { across: Some(_), .. } => &["pocket", "pocket_side"],
            _ => &["pocket"],
        }
    }
}

impl Law {
    fn hertz(
        law: &HertzPocket,
        builder: &LawBuilder<'_>,
        [ball, wall]: [f64; 2],
        sphere: bool,
    ) -> Result<Self> {
        let scene = builder.scene();
        let by = "cage.pocket";
        let of_balls = scene.balls.as_ref().map(|balls| ("balls.material", Some(balls.material.as_str())));
        let of_elements = || {
            let elements = scene.kinematic_elements.as_ref()?;
            Some(("kinematic_elements.material", elements.material.as_deref()))
        };
        let (path, name) = of_balls.or_else(of_elements).unwrap_or(("balls", None));
        let of_cage = scene.cage.as_ref().and_then(|cage| cage.material.as_deref());
        let a = builder.material(path, needed(path, name, by)?)?;
        let b = builder.material("cage.material", needed("cage.material", of_cage, by)?)?;
        let modulus = effective_modulus(a.young_modulus, a.poisson_ratio, b.young_modulus, b.poisson_ratio);
        let (free, hugged) = (1.0 / ball, 1.0 / ball - 1.0 / wall);
        let elastic = ElasticPoint::new(modulus, [if sphere { hugged } else { free }, hugged]);
        let elastic = elastic.ok_or_else(|| {
            let text = "hugs its ball so closely that Hertz's contact has no ellipse; give 'spring', or more clearance";
            bad_scene("cage.pocket", text)
        })?;
        Ok(Self::Hertz {
            elastic,
            damping: law.damping.as_ref().map(NormalDamping::from),
            friction: law.friction.as_ref().map(SolidFriction::from),
        })
    }

    /// Normal force, its damping and the secant of friction at a depth (m), its rate (m/s) and a slip (m/s).
    fn force<T: Real>(&self, depth: T, rate: T, slip: T) -> [T; 3] {
        let zero = T::constant(0.0);
        match self {
            Self::Spring(contact) => {
                let motion = ContactMotion { delta: depth, delta_dot: rate, u1: slip, u2: zero };
                let force = contact.force::<f64, T>(&motion);
                [force.normal, force.damping, force.friction_secant]
            }
            Self::Hertz { elastic, damping, friction } => {
                let load = elastic.load::<T>(depth);
                let stiffness = load / depth * 1.5;
                let normal = NormalForce::new(load, stiffness, damping.as_ref(), depth, rate);
                let rubbed = friction.map_or(zero, |friction| friction.at::<T>(slip) * normal.force / slip);
                [normal.force, normal.damping, rubbed]
            }
        }
    }
}

impl<T: Real> PocketContact<T> {
    /// What a normal force (N) and friction (N) on the ball there do to ball and cage.
    pub(crate) fn wrenches_of(&self, normal: T, friction: Vector<T>) -> [OnBody<T>; 2] {
        let on_ball = difference(friction, scaled(self.normal, normal));
        let on_cage = on_ball.map(|f| -f);
        let [of_ball, of_cage] = self.levers;
        // The normal goes through the centre of the ball.
        [[on_ball, cross(of_ball, friction)], [on_cage, cross(of_cage, on_cage)]]
    }

    /// Forces over the displacement of the pocket outwards and ahead by this one on the cage, N: what its modes get of it.
    pub(crate) fn on_bending(&self, on_cage: Vector<T>) -> [T; 2] {
        self.outwards_ahead.map_or([T::constant(0.0); 2], |axes| axes.map(|axis| dot(axis, on_cage)))
    }

    /// Velocity of the wall in axes of the azimuth by these rates of the displacement of the pocket outwards and ahead, m/s.
    pub(crate) fn velocity_by_bending(&self, rates: [T; 2]) -> Vector<T> {
        self.outwards_ahead.map_or([T::constant(0.0); 3], |[outwards, ahead]| {
            sum(scaled(outwards, rates[0]), scaled(ahead, rates[1]))
        })
    }

    /// Force and moment on ball and cage.
    pub(crate) fn wrenches(&self) -> [OnBody<T>; 2] {
        self.wrenches_of(self.force, scaled(self.slip, -self.secant))
    }
}
