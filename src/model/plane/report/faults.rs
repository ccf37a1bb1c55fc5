//! Faults in words.

use crate::bodies::{Fault, SOUND};
use crate::model::plane::Plane;

impl Plane {
    /// A fault in words.
    #[doc(hidden)]
    pub fn describe(&self, fault: Fault) -> String {
        match fault {
            Fault::NoGuideFilm { minimum_film } => {
                format!("no film between cage and guide (smallest thickness {minimum_film:e} m, must be > 0)")
            }
            Fault::NoViscosity { temperature } => {
                format!("the lubricant has no viscosity at its temperature {temperature:?} K")
            }
            Fault::LostRoller { roller, radial_offset } => {
                format!("roller[{roller}] has left the bearing (radial offset {radial_offset:e} m)")
            }
            Fault::OutOfPocket { element, lead } => {
                let kind = self.element_kind();
                format!("{kind}[{element}] is out of its pocket (ahead of it by {lead:e} rad)")
            }
            Fault::LostRing { distance, reach } => format!(
                "the inner ring has left the bearing (its centre is {distance:e} m off, rollers allow {reach:e} m)"
            ),
            Fault::Overlap { roller, next, depth } => format!(
                "roller[{roller}] and roller[{next}] go through each other (by {depth:e} m); a cage with pockets keeps \
                 rollers apart, or their contact, rollers.neighbours"
            ),
            Fault::EnergyCreated { given, available } => {
                let field = self.energy_giving_film().unwrap_or_default();
                format!(
                    "the film of the guide has given {given:e} J, more than the {available:e} J that loads, drives and the start \
                     could give: its law can make energy ({field})"
                )
            }
            Fault::TooFast { velocity, speed } => {
                let name = self.velocity_name(velocity);
                format!("{name} is too fast: {speed:e} m/s is more than sound in steel, {SOUND:e} m/s")
            }
            Fault::LostCage => "the cage has left the bearing".to_owned(),
            Fault::NotFinite { contact: Some(contact), .. } => {
                let names = self.contact_names();
                let name = names.get(contact).map_or("?", String::as_str);
                format!("the force of {name} is not a finite number")
            }
            Fault::NotFinite { velocity, contact: None } => {
                format!("the rate of {} is not a finite number", self.velocity_name(velocity))
            }
            Fault::NoSlope { velocity } => {
                let name = self.velocity_name(velocity);
                format!("a derivative of the rate of {name} is not a finite number")
            }
        }
    }

    fn velocity_name(&self, velocity: usize) -> String {
        let mut infos = self.state_infos().into_iter();
        infos.nth(self.layout().positions() + velocity).map_or("?".to_owned(), |info| info.name)
    }
}
