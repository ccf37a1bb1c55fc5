//! Shapes of the rollers of a scene, one by one: surfaces towards both raceways, contact lengths, what their ends are longer by.

use crate::laws::elastic::surface::{Surface, Table};
use crate::laws::line_contact::LineContact;
use crate::scene::{DropTable, RadiusDeviations, RollerProfile, Scene};

/// Shapes of all rollers.
#[derive(Clone, Debug)]
pub(crate) struct Shapes {
    /// By raceway, by roller; none where both are straight.
    surfaces: [Vec<Option<Surface>>; 2],
    /// a, m, by roller.
    half_lengths: Vec<f64>,
    /// By how much each is longer than nominal, m.
    longer: Vec<f64>,
}

impl Shapes {
    /// Of `count` rollers of a scene between raceways with these laws.
    pub(crate) fn new(scene: &Scene, laws: [&LineContact; 2], count: usize) -> Self {
        let rollers = scene.rollers.as_ref();
        let space = rollers.and_then(|rollers| rollers.space.as_ref());
        let each = |list: Option<&RadiusDeviations>| {
            list.map_or_else(|| vec![0.0; count], |list| list.of_each(count))
        };
        let longer = each(space.and_then(|space| space.length_deviations.as_ref()));
        let crowns = each(space.and_then(|space| space.crown_deviations.as_ref()));
        let table = |table: &DropTable| Table::new(&table.places, &table.drops);
        let of_roller = match rollers.and_then(|rollers| rollers.profile.as_ref()) {
            Some(RollerProfile::Table(drops)) => Some(table(drops)),
            _ => None,
        };
        let of_rings = [
            scene.outer_ring.as_ref().and_then(|ring| ring.raceway_drops.as_ref()),
            scene.inner_ring.as_ref().and_then(|ring| ring.raceway_drops.as_ref()),
        ];
        let nominal = 0.5 * laws[0].elastic.length;
        let surfaces = [0, 1].map(|side: usize| {
            let of = |crown: &f64| Surface {
                profile: laws[side].profile,
                tables: [of_roller.clone(), of_rings[side].map(table)],
                crown: crown / (nominal * nominal),
            };
            crowns.iter().map(of).map(|surface| (!surface.is_straight()).then_some(surface)).collect()
        });
        let half_lengths = longer.iter().map(|longer| nominal + 0.5 * longer).collect();
        Self { surfaces, half_lengths, longer }
    }

    /// Surfaces of roller `j` and raceway `side`.
    #[inline]
    pub(crate) fn surface(&self, side: usize, j: usize) -> Option<&Surface> {
        self.surfaces[side][j].as_ref()
    }

    /// a of roller `j`, m.
    #[inline]
    pub(crate) fn half_length(&self, j: usize) -> f64 {
        self.half_lengths[j]
    }

    /// By how much roller `j` is longer than nominal, m.
    #[inline]
    pub(crate) fn longer(&self, j: usize) -> f64 {
        self.longer[j]
    }
}
