//! Checks of the deviations of the radii of rollers and balls.

use crate::scene::check::{Range, range};
use crate::scene::validate::Judge;
use crate::scene::*;

/// Largest deviation as a share of the radius: masses and laws of contacts are those of the nominal one.
const LARGEST: f64 = 0.01;

impl Scene {
    /// Checks how the radii of `count` rollers or balls, which are `elements`, deviate from `radius` (m).
    pub(in crate::scene) fn validate_sizes(
        &self,
        judge: Judge<'_>,
        elements: &str,
        (count, radius): (u32, f64),
        deviations: Option<&RadiusDeviations>,
    ) -> Result<()> {
        let Some(deviations) = deviations else { return Ok(()) };
        let bound = LARGEST * radius;
        let pocket = self.cage.as_ref().and_then(|cage| cage.pocket.as_ref()).map(Pocket::clearance);
        // A larger roller does not fit into its pocket.
        let largest = pocket.filter(|clearance| *clearance < bound).unwrap_or(bound);
        let path = format!("{elements}.radius_deviations");
        self.validate_deviations(judge, (elements, &path, count), range(-bound, largest, "m"), deviations)
    }

    /// Checks deviations of `count` rollers or balls, which are `elements`, at this path.
    pub(in crate::scene) fn validate_deviations(
        &self,
        judge: Judge<'_>,
        (elements, at, count): (&str, &str, u32),
        allowed: Range,
        deviations: &RadiusDeviations,
    ) -> Result<()> {
        let one = elements.trim_end_matches('s');
        match deviations {
            RadiusDeviations::Each(list) => {
                let path = format!("{at}.each");
                if list.len() != count as usize {
                    let text = format!("has {} numbers for {count} {elements}", list.len());
                    judge.refuse(&path, text)?;
                }
                for (j, deviation) in list.iter().enumerate() {
                    judge.number(&format!("{path}.{j}"), *deviation, allowed)?;
                }
            }
            RadiusDeviations::Groups(groups) => {
                let mut seen = std::collections::BTreeSet::new();
                for (g, group) in groups.iter().enumerate() {
                    let path = format!("{at}.groups.{g}");
                    judge.number(&format!("{path}.deviation"), group.deviation, allowed)?;
                    for (i, number) in group.rollers.iter().enumerate() {
                        let path = format!("{path}.{elements}.{i}");
                        if *number >= count {
                            let last = count.saturating_sub(1);
                            judge.refuse(&path, format!("there is no {one} {number}; 0 to {last}"))?;
                        }
                        if !seen.insert(*number) {
                            judge.refuse(&path, format!("{one} {number} stands in the list twice"))?;
                        }
                    }
                }
            }
        }
        Ok(())
    }

    /// How the radii of its rollers or balls deviate.
    pub(crate) fn radius_deviations(&self) -> Option<&RadiusDeviations> {
        let of_rollers = self.rollers.as_ref().and_then(|rollers| rollers.radius_deviations.as_ref());
        let of_balls = self.balls.as_ref().and_then(|balls| balls.radius_deviations.as_ref());
        of_rollers.or(of_balls)
    }

    /// How much larger than nominal the largest roller or ball is, m; at least 0.
    pub(crate) fn largest_deviation(&self) -> f64 {
        let each = self
            .radius_deviations()
            .map_or_else(Vec::new, |list| list.of_each(self.element_count() as usize));
        each.into_iter().fold(0.0, f64::max)
    }
}
