//! Lengths that follow from a scene, by name.

use crate::model::plane::Plane;
use crate::model::{Quantity, quantity};

impl Plane {
    /// Lengths and counts of the bearing that follow from its scene, those that it has: name, unit and meaning with the value, SI.
    pub fn geometry(&self) -> Vec<(Quantity, f64)> {
        let set = self.elements.set();
        let guide = self.scene.cage.as_ref().and_then(|cage| cage.guide.as_ref());
        let raceways = self.raceway_geometry();
        let outer = raceways.map(|g| g.pitch_radius + g.roller_radius + g.gap);
        let inner_ring = self.scene.inner_ring.as_ref();
        let list = [
            (quantity("element_count", "1", "number of rolling elements"), Some(set.count as f64)),
            (quantity("element_radius", "m", "radius of a rolling element"), Some(set.radius)),
            (quantity("pitch_radius", "m", "radius of the pitch circle"), Some(set.pitch_radius)),
            (quantity("outer_raceway_radius", "m", "radius of the outer raceway"), outer),
            (
                quantity("inner_raceway_radius", "m", "radius of the inner raceway"),
                self.inner_raceway_radius(),
            ),
            (
                quantity("radial_internal_clearance", "m", "radial internal clearance between the raceways"),
                inner_ring.and_then(|ring| ring.radial_clearance),
            ),
            (
                quantity("guide_radius", "m", "radius of the surface of the ring that guides the cage"),
                guide.map(|guide| guide.guide_radius),
            ),
            (
                quantity(
                    "guide_clearance",
                    "m",
                    "radial clearance between the cage and the ring that guides it",
                ),
                self.guide_clearance(),
            ),
            (
                quantity(
                    "pocket_clearance",
                    "m",
                    "clearance of a centred element to each side of its pocket",
                ),
                self.pocket_clearance(),
            ),
        ];
        list.into_iter().filter_map(|(about, value)| Some((about, value?))).collect()
    }
}
