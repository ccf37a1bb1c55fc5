//! Lengths, frequencies and rates that describe a model as a whole: what errors are measured by, and what limits the
//! steps.

use super::laws::PocketLaws;
use super::{ElementKind, Input, Model, RingBody, RollerSet};
use crate::laws::line_contact::LineContact;
use crate::scalar::math;

/// Ratio of velocity to position scale in the error control, 1/s: slow against contact vibration (2e5 1/s), fast
/// against the cage (1e2 1/s).
const RATE_SCALE: f64 = 1e4;

impl Model {
    /// Radial guide clearance in m, if the cage is guided.
    pub fn guide_clearance(&self) -> Option<f64> {
        let guide = self.scene.cage.as_ref()?.guide.as_ref()?;
        Some(guide.diametral_clearance / 2.0)
    }

    /// Clearance in m of an element to the pillar before or behind it, if there are pockets.
    pub fn pocket_clearance(&self) -> Option<f64> {
        self.laws.pocket.map(|pocket| match pocket {
            PocketLaws::Cylinder(laws) => laws.shape.clearance,
            PocketLaws::Plane(laws) => laws.shape.clearance,
        })
    }

    /// Length in m that errors are measured by: the guide clearance, else the pocket clearance, else 0.1 mm.
    pub fn reference_length(&self) -> f64 {
        self.guide_clearance().or_else(|| self.pocket_clearance()).unwrap_or(1e-4)
    }

    /// Highest contact frequency in rad/s at the largest load of the scene: of a roller between two loaded raceways,
    /// or, if one is so light, of the ring on half of the rollers or the cage between all elements or on its guide.
    /// Zero without contacts.
    pub fn highest_frequency(&self) -> f64 {
        let (rollers, pocket_load) = match (&self.elements.kind, &self.laws.raceways) {
            (ElementKind::Rollers(rollers), Some(laws)) => {
                self.roller_frequencies(rollers, &laws.inner, &laws.outer)
            }
            _ => (0.0, 1.0),
        };
        let cage = self.cage.as_ref().map_or(0.0, |cage| {
            let pockets = match &self.laws.pocket {
                None => 0.0,
                Some(PocketLaws::Cylinder(laws)) => laws.wall.elastic.stiffness_at_load(pocket_load),
                Some(PocketLaws::Plane(laws)) => laws.contact.stiffness,
            };
            let lever = self.elements.pitch_radius;
            let solid = self.laws.guide.as_ref().and_then(|guide| guide.solid);
            let guide = solid.map_or(0.0, |solid| solid.contact.stiffness);
            pockets * self.elements.count as f64 * (1.0 / cage.mass + lever * lever / cage.inertia)
                + guide / cage.mass
        });
        rollers.max(cage).sqrt()
    }

    /// Highest squared frequency of rollers and ring in 1/s^2, and the largest roller load in N.
    fn roller_frequencies(
        &self,
        rollers: &RollerSet,
        inner: &LineContact,
        outer: &LineContact,
    ) -> (f64, f64) {
        let largest = |input| self.inputs.largest(input);
        let ring_mass = match self.ring {
            RingBody::Fixed(_) => 0.0,
            RingBody::Free { mass, .. } => mass,
        };
        let weight = ring_mass * math::hypot(self.gravity[0], self.gravity[1]);
        let orbit = largest(Input::RingSpeed) * rollers.orbit_ratio();
        let centrifugal = rollers.mass * rollers.geometry.pitch_radius * orbit * orbit;
        let preload = inner.elastic.load(-rollers.geometry.gap);
        // 4.1 F/Z is the largest roller load of a line contact bearing without clearance; 1 N keeps it positive.
        let per_roller = 4.1 / (self.layout.count as f64).max(4.1);
        let load = math::hypot(largest(Input::LoadY), largest(Input::LoadZ)) + weight;
        let q = per_roller * load + centrifugal + preload + 1.0;
        let stiffness = inner.elastic.stiffness_at_load(q) + outer.elastic.stiffness_at_load(q);
        let roller = stiffness / rollers.mass;
        let ring = match self.ring {
            RingBody::Fixed(_) => 0.0,
            RingBody::Free { mass, .. } => {
                inner.elastic.stiffness_at_load(q) * 0.5 * (self.layout.count as f64).max(2.0) / mass
            }
        };
        (roller.max(ring), q)
    }

    /// Whether the contacts that set the highest frequency are damped.
    pub fn damped(&self) -> bool {
        match (&self.laws.raceways, &self.laws.pocket) {
            (Some(raceways), _) => raceways.inner.damping.is_some(),
            (None, Some(PocketLaws::Cylinder(laws))) => laws.wall.damping.is_some(),
            (None, Some(PocketLaws::Plane(laws))) => laws.contact.damping > 0.0,
            (None, None) => true,
        }
    }

    /// What counts as one unit of error for every state: the reference length for positions, divided by a radius
    /// for angles, times 1e4 1/s for velocities.
    pub fn state_scales(&self) -> Vec<f64> {
        let length = self.reference_length();
        let (pitch, radius) = (self.elements.pitch_radius, self.elements.radius);
        let layout = self.layout();
        let mut positions = vec![length; layout.positions()];
        if let Some(c) = layout.cage {
            positions[c + 2] = length / pitch;
        }
        for j in 0..layout.count {
            positions[layout.roller(j) + 1] = length / pitch;
        }
        let mut scales = positions.clone();
        scales.extend(positions.iter().map(|x| x * RATE_SCALE));
        scales.extend(std::iter::repeat_n(length / radius * RATE_SCALE, layout.count));
        scales
    }
}
