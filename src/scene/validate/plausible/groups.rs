//! Usual ranges of numbers that follow from other numbers. What is told of one of a group is true of the group: any of them may
//! be the wrong one.

use super::scales::{EARTH, STEEL, damping};
use crate::scalar::math;
use crate::scene::check::{Range, range};
use crate::scene::*;
use std::f64::consts::{PI, TAU};

/// A number that is judged by others.
pub(super) struct Group {
    /// Where it stands.
    pub(super) path: &'static str,
    /// What its range follows from; nothing is said where one of these is unlikely itself.
    pub(super) from: &'static [&'static str],
    /// Its size and its usual range; `None` where there is no such number.
    pub(super) find: fn(&Scene) -> Option<(f64, Range)>,
    /// What it is below and above this range.
    pub(super) is: [&'static str; 2],
}

pub(super) const fn group(
    path: &'static str,
    from: &'static [&'static str],
    find: fn(&Scene) -> Option<(f64, Range)>,
    is: [&'static str; 2],
) -> Group {
    Group { path, from, find, is }
}

/// Largest pressure at rest over the modulus of the contact (1/E* = sum of (1 - nu^2)/E): 4.5 GPa between steel; ISO 76 rates
/// roller bearings for 4 GPa.
const HIGHEST_STRAIN: f64 = 0.04;
/// Largest acceleration of gravity that is meant on earth, m/s^2.
const HEAVY: f64 = 20.0;
/// What is said of a ring that grows too much.
const CLEARANCE_GONE: &str = "so much that the clearance is gone at the speed of the ring";
/// Radial internal clearance above which a bearing rattles: class C5 of small bearings, m, and growth with the pitch diameter.
const LOOSEST: [f64; 2] = [1e-4, 1.5e-3];
/// Turns of a ring in a run.
const TURNS: f64 = 1e4;

pub(super) const SIZE: &[&str] = &[
    "rollers.radius",
    "balls.radius",
    "balls.pitch_radius",
    "kinematic_elements.radius",
    "kinematic_elements.pitch_radius",
];
pub(super) const UNUSUAL: [&str; 2] = ["unusually small for this size", "unusually large for this size"];
const FAST: [&str; 2] = ["", "a speed that only special bearings of this size reach"];
pub(super) const SOFT: [&str; 2] =
    ["so soft that the weight of the cage takes the clearance", "stiffer than solid steel of this size"];
const GROOVE: [&str; 2] = ["hardly wider than the ball", "unusually wide for the ball"];
pub(super) const WEAK: [&str; 2] =
    ["hardly any damping of this mass on this stiffness", "many times the critical damping"];

/// Laws of the plane contact of pockets, of the solid contact of the guide, of a free ring.
const POCKET: &str = "cage.pocket.solid_plane.contact.stiffness";
const GUIDE: &str = "cage.guide.solid.contact.stiffness";

pub(super) const GROUPS: &[Group] = &[
    group(
        "gravity",
        &[],
        |s| {
            let size = s.gravity.map(|g| math::hypot(g.y, g.z))?;
            Some((size, range(0.0, HEAVY, "m/s^2")))
        },
        ["", "more than twice that of the earth"],
    ),
    group(
        "rollers.effective_length",
        &["rollers.radius"],
        |s| {
            let r = s.rollers.as_ref()?;
            Some((r.effective_length, range(0.2 * r.radius, 40.0 * r.radius, "m")))
        },
        UNUSUAL,
    ),
    group(
        "rollers.mass",
        &["rollers.effective_length"],
        |s| {
            let r = s.rollers.as_ref()?;
            // Hollow ceramic to tungsten carbide.
            let volume = PI * r.radius * r.radius * r.effective_length;
            Some((r.mass, range(800.0 * volume, 2e4 * volume, "kg")))
        },
        ["lighter than any material of this volume", "heavier than any material of this volume"],
    ),
    group(
        "rollers.dynamic_load_rating",
        &["rollers.radius", "rollers.effective_length"],
        |s| {
            let r = s.rollers.as_ref()?;
            // ISO 281 with about the factor of usual bearings, in mm.
            let [length, diameter] = [r.effective_length, 2.0 * r.radius].map(|x| 1e3 * x);
            let count = math::powf(f64::from(r.count), 0.75);
            let usual = 90.0 * math::powf(length, 7.0 / 9.0) * count * math::powf(diameter, 29.0 / 27.0);
            Some((r.dynamic_load_rating?, range(0.2 * usual, 5.0 * usual, "N")))
        },
        UNUSUAL,
    ),
    group(
        "balls.mass",
        &["balls.radius"],
        |s| {
            let b = s.balls.as_ref()?;
            let volume = 4.0 / 3.0 * PI * b.radius.powi(3);
            Some((b.mass, range(800.0 * volume, 2e4 * volume, "kg")))
        },
        ["lighter than any material of this volume", "heavier than any material of this volume"],
    ),
    group(
        "balls.pitch_radius",
        &["balls.radius"],
        |s| {
            let b = s.balls.as_ref()?;
            Some((b.pitch_radius, range(2.2, 60.0, "m").times(b.radius)))
        },
        UNUSUAL,
    ),
    group(
        "outer_ring.groove_radius",
        &["balls.radius"],
        |s| s.groove(s.outer_ring.as_ref()?.groove_radius),
        GROOVE,
    ),
    group(
        "inner_ring.groove_radius",
        &["balls.radius"],
        |s| s.groove(s.inner_ring.as_ref()?.groove_radius),
        GROOVE,
    ),
    group(
        "outer_ring.shoulder_height",
        &["balls.radius"],
        |s| s.shoulder(s.outer_ring.as_ref()?.shoulder_height),
        UNUSUAL,
    ),
    group(
        "inner_ring.shoulder_height",
        &["balls.radius"],
        |s| s.shoulder(s.inner_ring.as_ref()?.shoulder_height),
        UNUSUAL,
    ),
    group(
        "inner_ring.motion.space.load",
        &["balls.radius", "balls.count"],
        |s| {
            let RingMotion::Space(ring) = &s.inner_ring.as_ref()?.motion else { return None };
            let arms = [1.0, 1.0, 1.0, 1.0 / s.pitch_radius(), 1.0 / s.pitch_radius()];
            let loads = ring.loads().into_iter().zip(arms);
            let size = loads.map(|(load, arm)| load.map_or(0.0, |load| arm * load.largest()));
            Some((size.fold(0.0, f64::max), s.carried()))
        },
        ["", "beyond what such a bearing carries at rest"],
    ),
    group(
        "inner_ring.motion.space.preload.force",
        &["balls.radius", "balls.count"],
        |s| {
            let RingMotion::Space(ring) = &s.inner_ring.as_ref()?.motion else { return None };
            Some((ring.preload?.force.abs(), s.carried()))
        },
        ["", "beyond what such a bearing carries at rest"],
    ),
    group(
        "cage.mass",
        &["rollers.effective_length"],
        |s| {
            let volume = TAU * s.pitch_radius() * 2.0 * s.element_radius() * s.length();
            Some((s.cage.as_ref()?.mass, range(15.0 * volume, 1.5e4 * volume, "kg")))
        },
        ["lighter than a cage of this size is", "heavier than a cage of this size is"],
    ),
    group(
        "inner_ring.motion.free.mass",
        &["rollers.effective_length"],
        |s| {
            let radius = s.pitch_radius() - s.element_radius();
            let volume = PI * radius * radius * s.length();
            // A sleeve to a shaft with a rotor of thousands of times the volume.
            Some((s.free_inner_ring()?.mass, range(300.0 * volume, 2e7 * volume, "kg")))
        },
        UNUSUAL,
    ),
    group(
        "inner_ring.motion.free.support_damping",
        &["inner_ring.motion.free.mass", "materials"],
        |s| {
            let ring = s.free_inner_ring()?;
            // Half of the rollers carry, each with about 0.15 E L.
            let stiffness = 0.075 * STEEL * s.length() * f64::from(s.element_count());
            Some((ring.support_damping?, damping(stiffness, ring.mass)))
        },
        WEAK,
    ),
    group(
        "inner_ring.motion.free.load",
        &["materials", "rollers.effective_length"],
        |s| {
            let (rollers, load) = (s.rollers.as_ref()?, s.free_inner_ring()?.load.as_ref()?);
            let inner = s.pitch_radius() - rollers.radius;
            let surface = |name: &String| {
                s.materials.get(name).map(|m| (1.0 - m.poisson_ratio.powi(2)) / m.young_modulus)
            };
            let modulus =
                1.0 / (surface(&rollers.material)? + surface(s.inner_ring.as_ref()?.material.as_ref()?)?);
            // p = sqrt(Q E*/(pi L R)) with Stribeck's Q = 5 F/Z.
            let curved = rollers.radius * inner / (rollers.radius + inner);
            let area = PI * rollers.effective_length * curved * f64::from(rollers.count) / 5.0;
            let largest = HIGHEST_STRAIN.powi(2) * modulus * area;
            Some((math::hypot(load.y.largest(), load.z.largest()), range(0.0, largest, "N")))
        },
        ["", "beyond what such a bearing carries at rest"],
    ),
    group("inner_ring.speed", SIZE, |s| Some((s.inner_ring.as_ref()?.speed.largest(), s.speeds())), FAST),
    group("outer_ring.speed", SIZE, |s| Some((s.outer_speed()?.largest(), s.speeds())), FAST),
    group(
        "kinematic_elements.motion.prescribed.orbit_speed",
        SIZE,
        |s| {
            let ElementMotion::Prescribed { orbit_speed, .. } = &s.kinematic_elements.as_ref()?.motion else {
                return None;
            };
            Some((orbit_speed.largest(), s.speeds()))
        },
        FAST,
    ),
    group(
        "kinematic_elements.motion.prescribed.spin_speed",
        SIZE,
        |s| {
            let ElementMotion::Prescribed { spin_speed, .. } = &s.kinematic_elements.as_ref()?.motion else {
                return None;
            };
            let fastest = s.speeds().max * s.pitch_radius() / s.element_radius();
            Some((spin_speed.largest(), range(0.0, fastest, "rad/s")))
        },
        FAST,
    ),
    group(
        "initial.cage_speed",
        &["inner_ring.speed", "outer_ring.speed"],
        |s| {
            let inner = s.inner_ring.as_ref().map_or(f64::INFINITY, |ring| ring.speed.largest());
            let ring = inner.max(s.outer_speed().map_or(0.0, Signal::largest));
            Some((s.initial.cage_speed?.abs(), range(0.0, 1.5 * ring, "rad/s")))
        },
        ["", "more than the ring has"],
    ),
    group(
        "inner_ring.radial_clearance",
        SIZE,
        |s| {
            let loosest = LOOSEST[0] + LOOSEST[1] * 2.0 * s.pitch_radius();
            Some((s.inner_ring.as_ref()?.radial_clearance?, range(-0.5 * loosest, loosest, "m")))
        },
        ["more than any fit takes", "unusually large for this size; it is the radial, not the axial one"],
    ),
    group(
        "inner_ring.raceway_crown_radius",
        SIZE,
        |s| Some((s.inner_ring.as_ref()?.raceway_crown_radius?, s.crowns())),
        UNUSUAL,
    ),
    group(
        "outer_ring.raceway_crown_radius",
        SIZE,
        |s| Some((s.outer_ring.as_ref()?.raceway_crown_radius?, s.crowns())),
        UNUSUAL,
    ),
    group(
        "rollers.profile.circular_crown.radius",
        SIZE,
        |s| match s.rollers.as_ref()?.profile.as_ref()? {
            RollerProfile::CircularCrown { radius } => Some((*radius, s.crowns())),
            RollerProfile::Logarithmic(_) | RollerProfile::Table(_) => None,
        },
        UNUSUAL,
    ),
    group(
        "cage.mass_eccentricity",
        SIZE,
        |s| {
            let offset = s.cage.as_ref()?.mass_eccentricity?;
            Some((math::hypot(offset.y, offset.z), range(0.0, 0.05 * s.pitch_radius(), "m")))
        },
        UNUSUAL,
    ),
    group(
        "cage.load",
        &["cage.mass"],
        |s| {
            let cage = s.cage.as_ref()?;
            let load = cage.load.as_ref()?;
            let size = math::hypot(load.force_y.largest(), load.force_z.largest());
            Some((size, range(0.0, 1e4 * EARTH * cage.mass, "N")))
        },
        ["", "more than ten thousand times the weight of the cage"],
    ),
    group(
        "cage.load.torque",
        &["cage.mass"],
        |s| {
            let cage = s.cage.as_ref()?;
            let largest = 1e4 * EARTH * cage.mass * s.pitch_radius();
            Some((cage.load.as_ref()?.torque.largest(), range(0.0, largest, "N m")))
        },
        ["", "more than ten thousand times the weight of the cage on the pitch radius"],
    ),
    group(
        "cage.pocket.lubricated_cylinder.radial_clearance",
        SIZE,
        |s| match s.cage.as_ref()?.pocket.as_ref()? {
            Pocket::LubricatedCylinder(pocket) => {
                Some((pocket.radial_clearance, range(5e-4, 0.5, "m").times(s.element_radius())))
            }
            _ => None,
        },
        UNUSUAL,
    ),
    group(
        "cage.pocket.solid_plane.diametral_clearance",
        SIZE,
        |s| Some((s.plane_pocket()?.diametral_clearance, range(1e-3, 1.0, "m").times(s.element_radius()))),
        UNUSUAL,
    ),
    group(
        POCKET,
        &["cage.mass", "cage.pocket.solid_plane.diametral_clearance"],
        |s| {
            let pocket = s.plane_pocket()?;
            Some((pocket.contact.stiffness, s.stiffnesses(pocket.diametral_clearance)?))
        },
        SOFT,
    ),
    group(
        "cage.pocket.solid_plane.contact.damping",
        &[POCKET, "cage.mass"],
        |s| {
            let contact = &s.plane_pocket()?.contact;
            Some((contact.damping, damping(contact.stiffness, s.cage.as_ref()?.mass)))
        },
        WEAK,
    ),
    group(
        "cage.guide.diametral_clearance",
        SIZE,
        |s| {
            let guide = s.guide()?;
            Some((guide.diametral_clearance, range(2e-4, 0.1, "m").times(guide.guide_radius)))
        },
        UNUSUAL,
    ),
    group(
        GUIDE,
        &["cage.mass", "cage.guide.diametral_clearance"],
        |s| {
            let guide = s.guide()?;
            Some((guide.solid.as_ref()?.contact.stiffness, s.stiffnesses(guide.diametral_clearance)?))
        },
        SOFT,
    ),
    group(
        "cage.guide.solid.contact.damping",
        &[GUIDE, "cage.mass"],
        |s| {
            let contact = &s.guide()?.solid.as_ref()?.contact;
            Some((contact.damping, damping(contact.stiffness, s.cage.as_ref()?.mass)))
        },
        WEAK,
    ),
    group(
        "cage.guide.film.short_bearing.land_width",
        SIZE,
        |s| match s.guide()?.film.as_ref()? {
            GuideFilm::ShortBearing(film) => Some((film.land_width, s.lands())),
            GuideFilm::LubricantLayer(_) => None,
        },
        UNUSUAL,
    ),
    group(
        "cage.guide.film.lubricant_layer.land_width",
        SIZE,
        |s| Some((s.layer()?.land_width, s.lands())),
        UNUSUAL,
    ),
    group(
        "cage.guide.film.lubricant_layer.thickness",
        &["cage.guide.diametral_clearance"],
        |s| Some((s.layer()?.thickness, range(1e-4, 5.0, "m").times(s.guide()?.diametral_clearance))),
        ["unusually thin for this clearance", "many times the clearance"],
    ),
    group(
        "cage.elastic_ring.neutral_radius",
        SIZE,
        |s| Some((s.elastic()?.neutral_radius, range(0.7, 1.3, "m").times(s.pitch_radius()))),
        UNUSUAL,
    ),
    group(
        "cage.elastic_ring.growth",
        &["cage.guide.diametral_clearance", "inner_ring.speed"],
        |s| s.growth_in(s.guide()?.diametral_clearance),
        ["", CLEARANCE_GONE],
    ),
    group(
        "cage.elastic_ring.growth",
        &["cage.space.lands", "inner_ring.speed"],
        |s| {
            let lands = &s.cage.as_ref()?.space.as_ref()?.lands;
            s.growth_in(lands.iter().map(|land| land.guide.diametral_clearance).reduce(f64::min)?)
        },
        ["", CLEARANCE_GONE],
    ),
    group(
        "cage.elastic_ring.stiffness.bending",
        &["cage.mass"],
        |s| match s.elastic()?.stiffness {
            // The first wave of the free ring runs around it at 2 to 5000 m/s.
            RingStiffness::Bending(stiffness) => {
                let moment = s.cage.as_ref()?.mass * s.elastic()?.neutral_radius / TAU / 7.2;
                Some((stiffness, range(4.0 * moment, 2.5e7 * moment, "N m^2")))
            }
            _ => None,
        },
        ["hardly any stiffness of a ring of this mass", "stiffer than rings of this mass are"],
    ),
    group(
        "cage.elastic_ring.stiffness.section.width",
        SIZE,
        |s| Some((s.section()?.width, range(0.02, 40.0, "m").times(s.element_radius()))),
        UNUSUAL,
    ),
    group(
        "cage.elastic_ring.stiffness.section.thickness",
        SIZE,
        |s| Some((s.section()?.thickness, range(0.02, 4.0, "m").times(s.element_radius()))),
        UNUSUAL,
    ),
    group(
        "record.duration",
        &["inner_ring.speed"],
        |s| {
            let speed = s.inner_ring.as_ref()?.speed.largest();
            Some((s.record.duration, range(0.0, TURNS * TAU / speed, "s")))
        },
        ["", "more than ten thousand turns of the ring, which take hours"],
    ),
];
