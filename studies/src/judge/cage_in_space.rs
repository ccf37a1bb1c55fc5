//! Cages for scenes of balls that move in space.
//!
//! Ranges: a twentieth to all of the mass of the cages of [`scenes`](super::scenes), half to six tenths of the polar inertia across the
//! axis, clearances of 1 to 12 % of the ball in round, ball-shaped and square pockets, one land in the middle or off it, two of them, or
//! none; guides, springs, friction and layers as there; starts that tilt by up to 3 mrad and shift along the axis; every fourth ring bends.

use super::parts::elastic_ring;
use super::scenes::Draw;
use serde_json::{Value, json};

/// Number of balls, ball radius, pitch radius, half of the room between neighbours and radial clearance of the balls, m.
#[derive(Clone, Copy)]
pub(super) struct Sizes {
    pub(super) count: usize,
    pub(super) radius: f64,
    pub(super) pitch: f64,
    pub(super) room: f64,
    pub(super) clearance: f64,
}

/// Puts a cage into a scene of `duration` s.
pub(super) fn add(draw: &mut Draw, scene: &mut Value, sizes: Sizes, duration: f64) {
    let Sizes { radius, pitch, .. } = sizes;
    let mass = draw.log(0.05, 1.0) * 7e3 * pitch * radius * radius;
    let inertia = draw.within(0.85, 1.05) * mass * pitch * pitch;
    let mut space = json!({"transverse_inertia": inertia * draw.within(0.501, 0.6)});
    let (pocket, holds) = pocket(draw, sizes, mass);
    let inner = draw.chance(0.3);
    let place = if inner { pitch - 0.4 * radius } else { pitch + 0.4 * radius };
    let ring = if inner { "inner_ring" } else { "outer_ring" };
    // Loads shift an inner ring within its clearance and press it into the balls.
    let least = if inner { 1.5 * sizes.clearance + 4e-3 * pitch } else { 0.0 };
    let width = radius * draw.log(0.2, 1.0);
    let mut guide = draw.guide(ring, place, least, width, mass);
    if guide.is_null() && !holds {
        guide = json!({
            "ring": "outer_ring", "guide_radius": pitch + 0.4 * radius, "diametral_clearance": 5e-3 * pitch,
            "solid": {"contact": draw.solid(mass)}
        });
    }
    let off = draw.within(0.6, 1.3) * radius;
    let places = match draw.0.index(10) {
        0..=5 => vec![],
        6 => vec![off],
        _ => vec![-off, off],
    };
    let mut cage = json!({"mass": mass, "inertia": inertia, "material": "brass", "pocket": pocket});
    if places.is_empty() || guide.is_null() {
        cage["guide"] = guide;
    } else {
        let slices = 1 + draw.0.index(6);
        let land = |x: &f64| json!({"x": x, "width": width, "slices": slices, "guide": guide});
        space["lands"] = json!(places.iter().map(land).collect::<Vec<_>>());
    }
    if draw.chance(0.5) {
        let (eccentricity, angle) = (draw.log(1e-6, 1e-4), draw.angle());
        cage["mass_eccentricity"] = json!({"y": eccentricity * angle.cos(), "z": eccentricity * angle.sin()});
        space["mass_offset_x"] = json!(draw.within(-0.2, 0.2) * radius);
    }
    if draw.chance(0.2) {
        let size = mass * draw.log(1.0, 300.0);
        let [force, moment] = [size, 0.3 * size * pitch].map(|size| draw.signal(size, duration, 1e4));
        space["load"] = json!({"force_x": force, "moment_y": moment});
    }
    if draw.chance(0.3) {
        let mut small = |size: f64| size * draw.within(-1.0, 1.0);
        scene["initial"]["cage_space"] = json!({
            "x": small(0.3 * radius * 1e-2), "velocity_x": small(0.05), "tilt_y": small(3e-3), "tilt_z": small(3e-3)
        });
    }
    if draw.chance(0.25) {
        let Sizes { count, .. } = sizes;
        cage["elastic_ring"] = elastic_ring(draw, (pitch, count), mass);
    }
    cage["space"] = space;
    scene["cage"] = cage;
    scene["materials"]["brass"] = json!({"young_modulus": 103e9, "poisson_ratio": 0.34});
}

/// A pocket, and whether it holds a cage without guide.
fn pocket(draw: &mut Draw, sizes: Sizes, mass: f64) -> (Value, bool) {
    let mut clearance = || 2.0 * (sizes.radius * draw.log(0.01, 0.12)).min(0.6 * sizes.room);
    let [around, along] = [clearance(), clearance()];
    let kind = draw.0.index(4);
    if kind == 0 {
        let contact = draw.solid(mass);
        let walls = json!({"diametral_clearance": around, "axial_clearance": along, "contact": contact});
        return (json!({ "solid_plane": walls }), false);
    }
    let law = if draw.chance(0.6) {
        json!({"spring": draw.solid(mass)})
    } else {
        json!({"hertz": {
            "damping": {"relaxation_time": draw.log(5e-7, 5e-6), "softening_depth": 1e-8}, "friction": draw.friction()
        }})
    };
    let mut round = json!({"diametral_clearance": around, "law": law});
    if draw.chance(0.4) {
        round["axial_clearance"] = json!(along);
    }
    let name = if kind == 1 { "solid_sphere" } else { "solid_cylinder" };
    (json!({ name: round }), kind == 1)
}
