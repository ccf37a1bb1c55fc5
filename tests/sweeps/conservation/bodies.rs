//! Energy and momenta of a bearing without friction and damping, from the scene and the state alone: masses, gaps
//! between circles in the plane, and potentials of the contact laws. Nothing here is taken from the library.

use cagedyn::model::Layout;
use serde_json::Value;
use std::f64::consts::TAU;

type Vector = [f64; 2];

fn number(value: &Value, path: &str) -> f64 {
    let found = path.split('.').fold(value, |place, key| &place[key]);
    found.as_f64().unwrap_or(0.0)
}

fn vector(value: &Value, path: &str) -> Vector {
    ["y", "z"].map(|axis| number(value, &format!("{path}.{axis}")))
}

fn difference(a: Vector, b: Vector) -> Vector {
    [a[0] - b[0], a[1] - b[1]]
}

fn dot(a: Vector, b: Vector) -> f64 {
    a[0] * b[0] + a[1] * b[1]
}

fn cross(a: Vector, b: Vector) -> f64 {
    a[0] * b[1] - a[1] * b[0]
}

fn length(a: Vector) -> f64 {
    a[0].hypot(a[1])
}

fn turned([y, z]: Vector, angle: f64) -> Vector {
    let (sin, cos) = angle.sin_cos();
    [y * cos - z * sin, y * sin + z * cos]
}

/// Spring of a contact.
#[derive(Clone, Copy)]
enum Spring {
    /// Stiffness, N/m.
    Linear(f64),
    /// Palmgren's delta = K Q^0.9 with K in m/N^0.9: the work is Int (delta/K)^(10/9).
    Palmgren(f64),
}

impl Spring {
    fn between(scene: &Value, a: &str, b: &str, contact_length: f64) -> Self {
        let flexibility = |name: &str| {
            let poisson = number(scene, &format!("materials.{name}.poisson_ratio"));
            (1.0 - poisson * poisson) / number(scene, &format!("materials.{name}.young_modulus"))
        };
        let modulus = 2.0 / (flexibility(a) + flexibility(b));
        Spring::Palmgren(0.39 * (8.0 / modulus).powf(0.9) / contact_length.powf(0.8))
    }

    /// Work in J to press it in to a depth in m, which is negative where surfaces are apart.
    fn work(self, depth: f64) -> f64 {
        let depth = depth.max(0.0);
        match self {
            Spring::Linear(stiffness) => 0.5 * stiffness * depth * depth,
            Spring::Palmgren(compliance) => 9.0 / 19.0 * compliance * (depth / compliance).powf(19.0 / 9.0),
        }
    }
}

struct Rollers {
    count: usize,
    mass: f64,
    inertia: f64,
    radius: f64,
    pitch: f64,
    raceways: [f64; 2],
    springs: [Spring; 2],
}

#[derive(Clone, Copy)]
enum Pocket {
    None,
    /// Clearance on either side of a centred roller, m.
    Plane {
        clearance: f64,
        spring: Spring,
    },
    /// Radial clearance and half angle of the walls.
    Cylinder {
        clearance: f64,
        half_angle: f64,
        spring: Spring,
    },
}

struct Cage {
    mass: f64,
    inertia: f64,
    eccentricity: Vector,
    load: Vector,
    pocket: Pocket,
    guide: Option<(f64, Spring)>,
    inner_guide: bool,
}

/// Masses and contacts of a scene.
pub struct Bodies {
    gravity: Vector,
    ring_mass: f64,
    ring_load: Vector,
    rollers: Option<Rollers>,
    cage: Option<Cage>,
    first_angle: f64,
}

/// What a state holds.
#[derive(Clone, Copy, Debug, Default)]
pub struct Balance {
    /// Kinetic energy, J.
    pub kinetic: f64,
    /// What can vibrate: kinetic energy of ring and cage centre and of the radial motion of rollers, and the energy of
    /// the contacts, J.
    pub vibration: f64,
    /// Energy of contacts, of gravity and of constant loads, J.
    pub contacts: f64,
    pub weight: f64,
    /// Angular momentum about the bearing axis, without the spins of the rollers, kg m^2/s.
    pub angular_momentum: f64,
    pub touching: usize,
}

impl Balance {
    pub fn energy(&self) -> f64 {
        self.kinetic + self.contacts + self.weight
    }

    fn touch(&mut self, spring: Spring, depth: f64) {
        self.contacts += spring.work(depth);
        self.vibration += spring.work(depth);
        self.touching += usize::from(depth > 0.0);
    }

    fn carry(&mut self, mass: f64, place: Vector, velocity: Vector, force: Vector) {
        self.kinetic += 0.5 * mass * dot(velocity, velocity);
        self.angular_momentum += mass * cross(place, velocity);
        self.weight -= dot(force, place);
    }
}

impl Bodies {
    pub fn new(scene: &Value) -> Self {
        let rollers = scene["rollers"].is_object().then(|| {
            let radius = number(scene, "rollers.radius");
            let outer = number(scene, "outer_ring.raceway_radius");
            let play = number(scene, "inner_ring.radial_clearance");
            let contact_length = number(scene, "rollers.effective_length");
            let spring = |ring: &str| {
                let name = |part: &str| scene[part]["material"].as_str().expect("a material").to_owned();
                Spring::between(scene, &name("rollers"), &name(ring), contact_length)
            };
            Rollers {
                count: scene["rollers"]["count"].as_u64().expect("a count") as usize,
                mass: number(scene, "rollers.mass"),
                inertia: number(scene, "rollers.inertia"),
                radius,
                pitch: outer - radius - play / 4.0,
                raceways: [outer, outer - 2.0 * radius - play / 2.0],
                springs: ["outer_ring", "inner_ring"].map(spring),
            }
        });
        let free = &scene["inner_ring"]["motion"]["free"];
        Self {
            gravity: vector(scene, "gravity"),
            ring_mass: number(free, "mass"),
            ring_load: ["y", "z"].map(|axis| number(free, &format!("load.{axis}.constant"))),
            rollers,
            cage: scene["cage"].is_object().then(|| Cage::new(scene)),
            first_angle: number(scene, "initial.first_roller_angle"),
        }
    }

    /// Energy and momentum at a state.
    pub fn balance(&self, layout: &Layout, state: &[f64]) -> Balance {
        let (q, v) = state.split_at(layout.positions());
        let mut sum = Balance::default();
        let ring = layout.ring().map_or([0.0; 2], |i| [q[i], q[i + 1]]);
        if let Some(i) = layout.ring() {
            let force = [0, 1].map(|k| self.ring_mass * self.gravity[k] + self.ring_load[k]);
            let velocity = [v[i], v[i + 1]];
            sum.carry(self.ring_mass, ring, velocity, force);
            sum.vibration += 0.5 * self.ring_mass * dot(velocity, velocity);
        }
        if let (Some(cage), Some(c)) = (&self.cage, layout.cage()) {
            cage.add(ring, &q[c..c + 3], &v[c..c + 3], self.gravity, &mut sum);
        }
        let Some(rollers) = &self.rollers else { return sum };
        for j in 0..rollers.count {
            let (i, start) = (layout.element(j), self.first_angle + TAU * j as f64 / rollers.count as f64);
            let (radius, angle) = (rollers.pitch + q[i], start + q[i + 1]);
            let place = turned([radius, 0.0], angle);
            let velocity = turned([v[i], radius * v[i + 1]], angle);
            sum.carry(rollers.mass, place, velocity, self.gravity.map(|g| g * rollers.mass));
            sum.kinetic += 0.5 * rollers.inertia * v[layout.spin(j)].powi(2);
            sum.vibration += 0.5 * rollers.mass * v[i] * v[i];
            let [outer, inner] = rollers.raceways;
            let from_ring = length(difference(place, ring));
            sum.touch(rollers.springs[0], radius + rollers.radius - outer);
            sum.touch(rollers.springs[1], inner + rollers.radius - from_ring);
            if let (Some(cage), Some(c)) = (&self.cage, layout.cage()) {
                let turn = start + q[c + 2];
                let offset = turned(difference(place, [q[c], q[c + 1]]), -turn);
                let offset = difference(offset, [rollers.pitch, 0.0]);
                cage.pocket.add(rollers.radius, offset, &mut sum);
            }
        }
        sum
    }
}

impl Cage {
    fn new(scene: &Value) -> Self {
        let cage = &scene["cage"];
        let plane = &cage["pocket"]["solid_plane"];
        let cylinder = &cage["pocket"]["lubricated_cylinder"];
        let pocket = if plane.is_object() {
            Pocket::Plane {
                clearance: number(plane, "diametral_clearance") / 2.0,
                spring: Spring::Linear(number(plane, "contact.stiffness")),
            }
        } else if cylinder.is_object() {
            let contact_length = number(scene, "rollers.effective_length");
            let name = |part: &str| scene[part]["material"].as_str().expect("a material").to_owned();
            Pocket::Cylinder {
                clearance: number(cylinder, "radial_clearance"),
                half_angle: number(cylinder, "half_angle"),
                spring: Spring::between(scene, &name("rollers"), &name("cage"), contact_length),
            }
        } else {
            Pocket::None
        };
        let guide = &cage["guide"];
        Self {
            mass: number(cage, "mass"),
            inertia: number(cage, "inertia"),
            eccentricity: vector(cage, "mass_eccentricity"),
            load: ["y", "z"].map(|axis| number(cage, &format!("load.force_{axis}.constant"))),
            pocket,
            guide: guide.is_object().then(|| {
                let stiffness = number(guide, "solid.contact.stiffness");
                (number(guide, "diametral_clearance") / 2.0, Spring::Linear(stiffness))
            }),
            inner_guide: guide["ring"] == "inner_ring",
        }
    }

    fn add(&self, ring: Vector, q: &[f64], v: &[f64], gravity: Vector, sum: &mut Balance) {
        let centre = [q[0], q[1]];
        let [uy, uz] = turned(self.eccentricity, q[2]);
        let (place, velocity) = ([q[0] + uy, q[1] + uz], [v[0] - v[2] * uz, v[1] + v[2] * uy]);
        sum.carry(self.mass, place, velocity, gravity.map(|g| g * self.mass));
        sum.vibration += 0.5 * self.mass * dot([v[0], v[1]], [v[0], v[1]]);
        sum.weight -= dot(self.load, centre);
        sum.kinetic += 0.5 * self.inertia * v[2] * v[2];
        sum.angular_momentum += self.inertia * v[2];
        if let Some((clearance, spring)) = self.guide {
            let of = if self.inner_guide { ring } else { [0.0; 2] };
            sum.touch(spring, length(difference(centre, of)) - clearance);
        }
    }
}

impl Pocket {
    /// Adds the contacts of a roller at `offset` (radial, circumferential) from the centre of its pocket.
    fn add(self, roller_radius: f64, [radial, around]: Vector, sum: &mut Balance) {
        for side in [1.0, -1.0] {
            let towards = side * around;
            match self {
                Pocket::None => {}
                Pocket::Plane { clearance, spring } => sum.touch(spring, towards - clearance),
                Pocket::Cylinder { clearance, half_angle, spring } => {
                    let angle = radial.atan2(towards);
                    if angle.abs() <= half_angle {
                        sum.touch(spring, radial.hypot(towards) - clearance);
                    } else {
                        let edge = turned([roller_radius + clearance, 0.0], half_angle.copysign(angle));
                        sum.touch(spring, roller_radius - length(difference(edge, [towards, radial])));
                    }
                }
            }
        }
    }
}
