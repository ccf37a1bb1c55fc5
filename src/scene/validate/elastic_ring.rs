//! Checks of the elastic ring of a cage.

use crate::scene::check::{Range, range};
use crate::scene::validate::*;
use crate::scene::*;

const PATH: &str = "cage.elastic_ring";
const MODULUS: Range = range(1e6, 1e13, "Pa");
const BENDING: Range = range(1e-9, 1e9, "N m^2");
const FREQUENCY: Range = range(1.0, 1e8, "rad/s");
/// The section of the shortest wave bends as a whole up to this many thicknesses per neutral radius and order.
const SHORTEST_WAVE: f64 = 1.0;

impl Scene {
    pub(in crate::scene) fn validate_elastic_ring(
        &self,
        judge: Judge<'_>,
        ring: &ElasticRing,
        cage: &Cage,
    ) -> Result<()> {
        let at = |field: &str| format!("{PATH}.{field}");
        let elements = self.element_count();
        let most = MOST_RING_ORDERS.min(elements / 2);
        if !(2..=most).contains(&ring.modes) {
            let text = format!(
                "{} is not within 2 to {most}, half of the {elements} elements and {MOST_RING_ORDERS} at most",
                ring.modes
            );
            judge.refuse(&at("modes"), text)?;
        }
        let pitch = self.pitch_radius();
        judge.number(&at("neutral_radius"), ring.neutral_radius, range(0.5 * pitch, 1.5 * pitch, "m"))?;
        judge.number(&at("damping"), ring.damping, range(0.0, 1.0, ""))?;
        judge.number(&at("growth"), ring.growth, range(0.0, 1e-6, "m s^2"))?;
        judge.number(&at("contact_depth"), ring.contact_depth, range(1e-8, 1e-4, "m"))?;
        match &ring.stiffness {
            RingStiffness::Bending(bending) => judge.number(&at("stiffness.bending"), *bending, BENDING)?,
            RingStiffness::Section(section) => self.validate_section(judge, section, ring)?,
            RingStiffness::FiniteElements(modes) => {
                let wanted = (ring.modes as usize).saturating_sub(1);
                for (field, list, allowed) in [
                    ("frequencies", &modes.frequencies, FREQUENCY),
                    ("modal_masses", &modes.modal_masses, range(1e-3 * cage.mass, 1e3 * cage.mass, "kg")),
                ] {
                    let path = at(&format!("stiffness.finite_elements.{field}"));
                    if list.len() != wanted {
                        let text = format!(
                            "{} values; the orders 2 to {} of {PATH}.modes need {wanted}",
                            list.len(),
                            ring.modes
                        );
                        judge.refuse(&path, text)?;
                    }
                    for (i, value) in list.iter().enumerate() {
                        judge.number(&format!("{path}.{i}"), *value, allowed)?;
                    }
                }
            }
        }
        Ok(())
    }

    fn validate_section(&self, judge: Judge<'_>, section: &RingSection, ring: &ElasticRing) -> Result<()> {
        let at = |field: &str| format!("{PATH}.stiffness.section.{field}");
        judge.number(&at("young_modulus"), section.young_modulus, MODULUS)?;
        judge.number(&at("width"), section.width, WIDTH)?;
        let (a, n) = (ring.neutral_radius, f64::from(ring.modes));
        let thickest = SHORTEST_WAVE * a / n;
        judge.number(&at("thickness"), section.thickness, range(1e-4, a, "m"))?;
        if section.thickness > thickest {
            let text = format!(
                "{:?} m is more than {thickest:?} m, where waves of order {} are no longer those of a thin ring",
                section.thickness, ring.modes
            );
            judge.refuse(&at("thickness"), text)?;
        }
        if let Some(diameter) = section.pocket_diameter {
            let pitch = 2.0 * PI * a / f64::from(self.element_count());
            let widest = (0.999 * section.width).min(pitch);
            judge.number(&at("pocket_diameter"), diameter, range(1e-4, widest, "m"))?;
        }
        Ok(())
    }
}
