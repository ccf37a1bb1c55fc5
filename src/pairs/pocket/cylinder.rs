//! Cylindrical pocket: two pillars, each a cylindrical wall that ends in two edges.
//!
//! ```text
//! wall   |phi| <= phi_p : delta = |d| - (R_p - R_b),        n along d
//! edge   |phi| >  phi_p : delta = R_b - |d - R_p e(phi_p)|, n from the roller centre to the edge
//! ```
//!
//! d is the roller centre relative to the pocket centre, phi its angle from the circumferential direction of the
//! pillar. delta and n are continuous at phi_p. The wall carries the lubricated line contact; an edge carries the
//! normal force and boundary friction only. The friction coefficient goes from one to the other over the last
//! `edge_blend` of the wall (an assumption; 0 leaves the jump). Source: NTN section 3.2 and Fig. 2.
//!
//! Local frame: (radial, circumferential) at the pocket centre, turning with the cage.

use super::Pockets;
use super::kinematics::{PillarContact, PocketMotion, PocketPlace, PocketShape};
use crate::bodies::{CAGE, ForceSource, Power};
use crate::error::Result;
use crate::laws::line_contact::LineContact;
use crate::laws::traction::solid_friction::SolidFriction;
use crate::pairs::line_laws::LawBuilder;
use crate::pairs::{ContactLaw, Cost, ElementPair, Law, PairInfo};
use crate::scalar::math;
use crate::scalar::{Base, Numeric, smoothstep};
use crate::scene::{Cage, CylinderPocket as CylinderOfScene, Pocket, needed};

/// Shape of the pockets.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CylinderPocket {
    /// Place and element size.
    pub place: PocketPlace,
    /// R_p - R_b, m.
    pub clearance: f64,
    /// phi_p, half angle of the wall, rad.
    pub half_angle: f64,
    /// Angle before the edge over which friction changes, rad.
    pub edge_blend: f64,
    /// Sine and cosine of the angles where the wall ends and where friction begins to change.
    edge: (f64, f64),
    blend: (f64, f64),
}

impl CylinderPocket {
    /// From the place, the clearance in m, the half angle of the wall and the angle of the blend in rad.
    pub fn new(place: PocketPlace, clearance: f64, half_angle: f64, edge_blend: f64) -> Self {
        let (edge, blend) = (math::sin_cos(half_angle), math::sin_cos(half_angle - edge_blend));
        Self { place, clearance, half_angle, edge_blend, edge, blend }
    }
}

impl PocketShape for CylinderPocket {
    fn place(&self) -> PocketPlace {
        self.place
    }

    fn clearance(&self) -> f64 {
        self.clearance
    }

    #[inline(always)]
    fn apart<T: Numeric>(&self, [a, b]: [T; 2], excess: T) -> T::Mask {
        let clearance = -excess + self.clearance;
        let clearance = clearance.base();
        (a * a + b * b).base().less(clearance * clearance)
    }

    #[inline(always)]
    fn pillar<T: Numeric>(&self, front: T::Mask, m: &PocketMotion<T>) -> PillarContact<T> {
        let [radial, across] = m.offset;
        // Towards the pillar; on either side of its middle.
        let (towards, height) = (T::select(front, across, -across), radial.abs());
        let zero = radial.like(0.0);
        let at_angle = |(sin, cos): (f64, f64)| (towards.base() * sin, height.base() * cos);
        // |phi| <= phi_p without the angle, which is needed near the edge only. Neither where there is no number.
        let (along, up) = at_angle(self.edge);
        let (within, beyond) = (up.less_or_equal(along), along.less(up));
        let square = towards * towards + radial * radial;
        let (mut delta, mut normal, mut edge_share) = (square, [zero; 2], zero);
        if T::Base::any(within) {
            let distance = square.sqrt();
            delta = T::select(within, distance - self.clearance + m.radius_excess, delta);
            normal = [radial / distance, across / distance];
            let (along, up) = at_angle(self.blend);
            let fading = along.less(up);
            if self.edge_blend > 0.0 && T::Base::any(fading & within) {
                let angle = (height / towards).atan();
                let share = smoothstep((angle + (self.edge_blend - self.half_angle)) / self.edge_blend);
                edge_share = T::select(fading, share, zero);
            }
        }
        if T::Base::any(beyond) {
            let (sin, cos) = self.edge;
            let pocket_radius = self.place.element_radius + self.clearance;
            let radius = m.radius_excess + self.place.element_radius;
            let clearance = -m.radius_excess + self.clearance;
            let edge_height = pocket_radius * sin;
            let edge_height = T::select(radial.below(0.0), zero.like(-edge_height), zero.like(edge_height));
            let edge_along = pocket_radius * cos;
            // R_b - |d - R_p e| without the difference of two radii.
            let inside = (radial * edge_height + towards * edge_along) * 2.0
                - square
                - clearance * (radius + pocket_radius);
            delta = T::select(beyond, inside, delta);
            if T::Base::any(inside.above(0.0) & beyond) {
                let to_edge = [edge_height - radial, -towards + edge_along];
                let reach = (to_edge[0] * to_edge[0] + to_edge[1] * to_edge[1]).sqrt();
                let along = to_edge[1] / reach;
                delta = T::select(beyond, inside / (reach + radius), delta);
                normal[0] = T::select(beyond, to_edge[0] / reach, normal[0]);
                normal[1] = T::select(beyond, T::select(front, along, -along), normal[1]);
                edge_share = T::select(beyond, zero.like(1.0), edge_share);
            }
        }
        self.place.contact(m, delta, normal, edge_share)
    }
}

static INFO: PairInfo = PairInfo {
    mate: CAGE,
    source: ForceSource::Pocket,
    contacts: &["pocket_front", "pocket_back"],
    laws: [Some(Law::PocketWall), Some(Law::PocketEdge)],
    powers: [Power::PocketDamping, Power::PocketFriction],
    rolls: false,
    share: 1.0,
};

/// The law of the walls and edges of these pockets of a cage.
pub(in crate::pairs) fn law_of(
    laws: &LawBuilder<'_>,
    cage: &Cage,
    pocket: &CylinderOfScene,
) -> Result<LineContact> {
    let element_radius = laws.scene().element_radius();
    let pocket_radius = element_radius + pocket.radial_clearance;
    let equivalent_radius = element_radius * pocket_radius / pocket.radial_clearance;
    let mate = needed("cage.material", cage.material.as_deref(), "cage.pocket.lubricated_cylinder")?;
    let laws = laws.at("cage.pocket.lubricated_cylinder.contact");
    let wall = laws.line_contact(&pocket.contact, mate, equivalent_radius)?;
    let edge_friction = pocket.edge_friction.as_ref().map_or(SolidFriction::NONE, SolidFriction::from);
    Ok(LineContact { edge_friction: Some(edge_friction), ..wall })
}

/// The cylindrical pockets of a scene, if it has any.
pub(in crate::pairs) fn new(laws: &LawBuilder<'_>) -> Result<Option<Box<dyn ElementPair>>> {
    let scene = laws.scene();
    let Some(cage) = &scene.cage else { return Ok(None) };
    let Some(Pocket::LubricatedCylinder(pocket)) = &cage.pocket else { return Ok(None) };
    let element_radius = scene.element_radius();
    let place = PocketPlace { pitch_radius: scene.pitch_radius(), element_radius };
    let law = ContactLaw::Line(law_of(laws, cage, pocket)?);
    let shape = CylinderPocket::new(place, pocket.radial_clearance, pocket.half_angle, pocket.edge_blend);
    // A contact with them costs as much as one with a raceway, but few are touched.
    let cost = Cost { value: 0.0, slopes: 0.0, per_element: false };
    Ok(Some(Box::new(Pockets { shape, law, info: &INFO, cost, longest_step: None })))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn pocket() -> CylinderPocket {
        let place = PocketPlace { pitch_radius: 0.04, element_radius: 0.0075 };
        CylinderPocket::new(place, 0.15e-3, 0.436, 0.02)
    }

    fn at(offset: [f64; 2]) -> PocketMotion<f64> {
        PocketMotion { offset, velocity: [0.1, -0.2], spin: 800.0, radius_excess: 0.0 }
    }

    #[test]
    fn wall_contact_follows_the_gap() {
        let c = pocket().pillar(true, &at([0.0, 0.151e-3]));
        assert!((c.motion.delta - 1e-6).abs() < 1e-18);
        assert_eq!(c.normal, [0.0, 1.0]);
        assert_eq!(c.edge_share, 0.0);
        assert_eq!(c.motion.delta_dot, -0.2);
        // Front pillar: t points inwards, the surface slides with -v_r + R_b w.
        assert!((c.motion.u1 - (-0.1 + 0.0075 * 800.0)).abs() < 1e-14);
        assert!(pocket().pillar(false, &at([0.0, 0.151e-3])).motion.delta < 0.0);
        let back = pocket().pillar(false, &at([0.0, -0.152e-3]));
        assert!((back.motion.delta - 2e-6).abs() < 1e-18);
        assert_eq!(back.normal, [0.0, -1.0]);
    }

    #[test]
    fn approach_and_normal_are_continuous_at_the_edges() {
        let d = 0.155e-3;
        for (front, s) in [(true, 1.0), (false, -1.0)] {
            for edge in [pocket().half_angle, -pocket().half_angle] {
                let get = |phi: f64| pocket().pillar(front, &at([d * phi.sin(), s * d * phi.cos()]));
                let (a, b) = (get(edge * (1.0 - 1e-9)), get(edge * (1.0 + 1e-9)));
                assert!((a.motion.delta - b.motion.delta).abs() < 1e-15);
                assert!((a.normal[0] - b.normal[0]).abs() < 1e-7);
                assert!((a.normal[1] - b.normal[1]).abs() < 1e-7);
                assert!((a.edge_share - 1.0).abs() < 1e-6 && b.edge_share == 1.0);
            }
        }
    }

    #[test]
    fn a_roller_pushed_outwards_rests_on_both_pillars() {
        // At d = clearance/sin(phi_p) (to first order) the edges are reached.
        let d = 0.4e-3;
        let (front, back) = (pocket().pillar(true, &at([d, 0.0])), pocket().pillar(false, &at([d, 0.0])));
        assert!((front.motion.delta - back.motion.delta).abs() < 1e-18);
        assert!((front.normal[1] + back.normal[1]).abs() < 1e-15);
        assert!((front.normal[0] - back.normal[0]).abs() < 1e-15);
        let expected = {
            let (s, c) = pocket().half_angle.sin_cos();
            let r = 0.00765;
            0.0075 - (r * s - d).hypot(r * c)
        };
        assert!((front.motion.delta - expected).abs() < 1e-15);
    }

    #[test]
    fn a_larger_element_is_one_in_a_tighter_pocket_of_the_same_wall() {
        let excess = 0.02e-3;
        let place = PocketPlace { pitch_radius: 0.04, element_radius: 0.0075 + excess };
        let tighter = CylinderPocket::new(place, 0.15e-3 - excess, 0.436, 0.02);
        for i in 0..100 {
            let phi = i as f64 * 0.0628;
            let m = at([0.16e-3 * phi.sin(), 0.16e-3 * phi.cos()]);
            let larger = PocketMotion { radius_excess: excess, ..m };
            for front in [true, false] {
                let (a, b) = (pocket().pillar(front, &larger), tighter.pillar(front, &m));
                assert!((a.motion.delta - b.motion.delta).abs() < 1e-17, "{phi}");
                assert!((a.motion.u1 - b.motion.u1).abs() < 1e-13);
                assert!(
                    (a.normal[0] - b.normal[0]).abs() < 1e-12 && (a.edge_share - b.edge_share).abs() < 1e-9
                );
            }
            assert!(!pocket().apart(m.offset, excess));
            assert!(pocket().apart(at([0.129e-3 * phi.sin(), 0.129e-3 * phi.cos()]).offset, excess));
        }
    }

    #[test]
    fn nothing_touches_within_the_clearance() {
        for i in 0..100 {
            let phi = i as f64 * 0.0628;
            let m = at([0.1499e-3 * phi.sin(), 0.1499e-3 * phi.cos()]);
            assert!(pocket().apart(m.offset, 0.0));
            assert!([true, false].iter().all(|front| pocket().pillar(*front, &m).motion.delta < 0.0));
        }
    }
}
