//! Pocket with plane walls across the circumference.
//!
//! ```text
//! delta = |s| - c_p/2,   s = d . t,   n = sgn(s) t
//! ```
//!
//! d element centre relative to the pocket centre, t circumferential direction of the pocket, c_p clearance between
//! element and both walls together. The walls turn with the cage and are unbounded radially. Source: Takeshima et al.
//! 2025, section 3.

use super::Pockets;
use super::kinematics::{PillarContact, PocketMotion, PocketPlace, PocketShape};
use crate::bodies::{CAGE, ForceSource, Input, Power};
use crate::error::Result;
use crate::laws::elastic::solid::SolidContact;
use crate::pairs::line_laws::LawBuilder;
use crate::pairs::passage::Passage;
use crate::pairs::{Ahead, ContactLaw, Cost, ElementPair, Law, PairInfo};
use crate::scalar::{Numeric, math};
use crate::scene::Pocket;
use crate::space::rotate;

/// Shape of the pockets.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PlanePocket {
    /// Place and element size.
    pub place: PocketPlace,
    /// c_p/2: clearance on each side of a centred element, m.
    pub clearance: f64,
}

impl PocketShape for PlanePocket {
    fn place(&self) -> PocketPlace {
        self.place
    }

    fn clearance(&self) -> f64 {
        self.clearance
    }

    #[inline(always)]
    fn apart<T: Numeric>(&self, [_, along]: [T; 2], excess: T) -> T::Mask {
        (along.abs() + excess).below(self.clearance)
    }

    #[inline(always)]
    fn pillar<T: Numeric>(&self, front: T::Mask, m: &PocketMotion<T>) -> PillarContact<T> {
        let [_, along] = m.offset;
        let zero = along.like(0.0);
        let delta = T::select(front, along, -along) - self.clearance + m.radius_excess;
        let normal = [zero, T::select(front, along.like(1.0), along.like(-1.0))];
        self.place.contact(m, delta, normal, zero)
    }
}

static INFO: PairInfo = PairInfo {
    mate: CAGE,
    source: ForceSource::Pocket,
    contacts: &["pocket_front", "pocket_back"],
    laws: [Some(Law::PocketPlane), None],
    powers: [Power::PocketDamping, Power::PocketFriction],
    rolls: false,
    share: 1.0,
};

/// The plane pockets of a scene, if it has any.
pub(in crate::pairs) fn new(laws: &LawBuilder<'_>) -> Result<Option<Box<dyn ElementPair>>> {
    let scene = laws.scene();
    let Some(Pocket::SolidPlane(pocket)) = scene.cage.as_ref().and_then(|cage| cage.pocket.as_ref()) else {
        return Ok(None);
    };
    let place = PocketPlace { pitch_radius: scene.pitch_radius(), element_radius: scene.element_radius() };
    let shape = PlanePocket { place, clearance: pocket.diametral_clearance / 2.0 };
    let law = ContactLaw::Solid(SolidContact::from(&pocket.contact));
    // Of all planes, mostly one is touched.
    let cost = Cost { value: 50.0, slopes: 600.0, per_element: false };
    Ok(Some(Box::new(Pockets { shape, law, info: &INFO, cost, longest_step: Some(longest_step) })))
}

/// The longest step that meets every wall in time: it ends no further behind the wall than a share of what the law needs to
/// become itself. Bodies move on straight lines for this.
fn longest_step(shape: &PlanePocket, law: &ContactLaw, ahead: &Ahead<'_>) -> f64 {
    let ContactLaw::Solid(contact) = law else { return f64::INFINITY };
    let cage = &ahead.shared[CAGE];
    let (sin, cos) = math::sin_cos(cage.angle);
    // Position and velocity of the cage in its own axes.
    let (place, speed) = (rotate(cage.position, -sin, cos), rotate(cage.velocity, -sin, cos));
    let set = ahead.elements.set();
    let free = ahead.elements.mass().is_some();
    let rigid = ahead.modes()[0].is_empty();
    let ahead_by = |angle: f64, orbit: f64| {
        [set.pitch_radius * (angle - cage.angle), set.pitch_radius * (orbit - cage.speed)]
    };
    let prescribed = ahead_by(ahead.inputs.orbit_travel(), ahead.inputs.of(Input::OrbitSpeed));
    let pass = Passage::of(contact, ahead.lightest(CAGE), ahead.tuning);
    let mut longest = f64::INFINITY;
    let [sines, cosines] = &set.directions;
    for (j, ((x, y), excess)) in cosines.iter().zip(sines).zip(&set.radius_excess).enumerate() {
        let [lead, leading] = if free {
            let i = ahead.layout.element(j) + 1;
            ahead_by(ahead.q[i], ahead.v[i])
        } else {
            prescribed
        };
        let [[_, moved], [_, moving]] = if rigid { [[0.0; 2]; 2] } else { ahead.displacement(j) };
        let offset = lead - (place[1] * x - place[0] * y) - moved;
        let approach = leading - (speed[1] * x - speed[0] * y) - moving;
        let rest = shape.clearance - excess - offset * 1f64.copysign(approach);
        if rest > 0.0 && rest <= approach.abs() * ahead.wanted {
            longest = longest.min(rest / approach.abs() + pass.time(approach.abs()));
        }
    }
    longest
}

#[cfg(test)]
mod tests {
    use super::*;

    const P: PlanePocket =
        PlanePocket { place: PocketPlace { pitch_radius: 0.045, element_radius: 0.004 }, clearance: 0.25e-3 };

    #[test]
    fn walls_are_flat_and_face_each_other() {
        for radial in [-0.3e-3, 0.0, 0.2e-3] {
            let m = |s: f64| PocketMotion {
                offset: [radial, s],
                velocity: [0.3, 0.2],
                spin: -1500.0,
                radius_excess: 0.0,
            };
            let front = P.pillar(true, &m(0.251e-3));
            assert!((front.motion.delta - 1e-6).abs() < 1e-18);
            assert_eq!(front.normal, [0.0, 1.0]);
            assert_eq!(front.motion.delta_dot, 0.2);
            // The front wall's t points inwards: radial sliding and spin at the contact.
            assert!((front.motion.u1 - (-0.3 - 1500.0 * 0.004)).abs() < 1e-14);
            let back = P.pillar(false, &m(-0.252e-3));
            assert!((back.motion.delta - 2e-6).abs() < 1e-18);
            assert_eq!(back.motion.delta_dot, -0.2);
            assert!(P.apart([radial, 0.249e-3], 0.0) && P.pillar(true, &m(0.249e-3)).motion.delta < 0.0);
        }
    }
}
