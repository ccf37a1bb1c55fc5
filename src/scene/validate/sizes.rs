//! Checks of the deviations of rollers' radii.

use crate::scene::check::range;
use crate::scene::validate::Judge;
use crate::scene::*;

/// Largest deviation as a share of the radius: masses and laws of contacts are those of the nominal one.
const LARGEST: f64 = 0.01;

impl Scene {
    /// Checks how the radii of rollers deviate.
    pub(in crate::scene) fn validate_sizes(&self, judge: Judge<'_>, rollers: &Rollers) -> Result<()> {
        let Some(deviations) = &rollers.radius_deviations else { return Ok(()) };
        let bound = LARGEST * rollers.radius;
        let pocket = self.cage.as_ref().and_then(|cage| cage.pocket.as_ref()).map(|pocket| match pocket {
            Pocket::LubricatedCylinder(pocket) => pocket.radial_clearance,
            Pocket::SolidPlane(pocket) => pocket.diametral_clearance / 2.0,
        });
        // A larger roller does not fit into its pocket.
        let largest = pocket.filter(|clearance| *clearance < bound).unwrap_or(bound);
        let allowed = range(-bound, largest, "m");
        match deviations {
            RadiusDeviations::Each(list) => {
                let path = "rollers.radius_deviations.each";
                if list.len() != rollers.count as usize {
                    let text = format!("has {} numbers for {} rollers", list.len(), rollers.count);
                    judge.refuse(path, text)?;
                }
                for (j, deviation) in list.iter().enumerate() {
                    judge.number(&format!("{path}.{j}"), *deviation, allowed)?;
                }
            }
            RadiusDeviations::Groups(groups) => {
                let mut seen = std::collections::BTreeSet::new();
                for (g, group) in groups.iter().enumerate() {
                    let path = format!("rollers.radius_deviations.groups.{g}");
                    judge.number(&format!("{path}.deviation"), group.deviation, allowed)?;
                    for (i, roller) in group.rollers.iter().enumerate() {
                        let path = format!("{path}.rollers.{i}");
                        if *roller >= rollers.count {
                            let last = rollers.count.saturating_sub(1);
                            judge.refuse(&path, format!("there is no roller {roller}; 0 to {last}"))?;
                        }
                        if !seen.insert(*roller) {
                            judge.refuse(&path, format!("roller {roller} stands in the list twice"))?;
                        }
                    }
                }
            }
        }
        Ok(())
    }

    /// How much larger than nominal the largest roller is, m; at least 0.
    pub(crate) fn largest_deviation(&self) -> f64 {
        let deviations = self.rollers.as_ref().and_then(|rollers| rollers.radius_deviations.as_ref());
        let each = deviations.map_or_else(Vec::new, |list| list.of_each(self.element_count() as usize));
        each.into_iter().fold(0.0, f64::max)
    }
}
