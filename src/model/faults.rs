//! Faults in words.

use super::StateInfo;
use crate::bodies::{Fault, SOUND};
use crate::space::solid::LARGEST_TILT;

/// What a bearing calls its parts.
pub(super) struct Names<'a> {
    /// Elements.
    pub(super) element: &'static str,
    /// States, and how many of them are positions.
    pub(super) states: &'a dyn Fn() -> Vec<StateInfo>,
    pub(super) positions: usize,
    /// Contacts.
    pub(super) contacts: &'a dyn Fn() -> Vec<String>,
    /// The field by which a film can give energy.
    pub(super) giving: Option<String>,
}

/// A fault in words.
pub(super) fn in_words(fault: Fault, names: &Names<'_>) -> String {
    let kind = names.element;
    let velocity_name = |velocity: usize| {
        let mut infos = (names.states)().into_iter();
        infos.nth(names.positions + velocity).map_or("?".to_owned(), |info| info.name)
    };
    match fault {
        Fault::NoGuideFilm { minimum_film } => {
            format!("no film between cage and guide (smallest thickness {minimum_film:e} m, must be > 0)")
        }
        Fault::NoViscosity { temperature } => {
            format!("the lubricant has no viscosity at its temperature {temperature:?} K")
        }
        Fault::LostRoller { roller, way, offset } => {
            format!("roller[{roller}] has left the bearing ({way} offset {offset:e} m)")
        }
        Fault::AskewRoller { roller, angle } => {
            format!(
                "roller[{roller}] is askew in its bearing (its axis is turned by {angle:e} rad, at most {LARGEST_TILT:?} rad)"
            )
        }
        Fault::OutOfPocket { element, lead } => {
            format!("{kind}[{element}] is out of its pocket (ahead of it by {lead:e} rad)")
        }
        Fault::AbovePocket { element, distance } => format!(
            "{kind}[{element}] has left the height of its pocket ({distance:e} m outside of the pitch circle; cage.space.pocket_height)"
        ),
        Fault::LostRing { ring: 0, distance, reach } => {
            format!(
                "the outer ring has left its place (its centre is {distance:e} m off, allowed are {reach:e} m)"
            )
        }
        Fault::LostRing { distance, reach, .. } => format!(
            "the inner ring has left the bearing (its centre is {distance:e} m off, {kind}s allow {reach:e} m)"
        ),
        Fault::LostRotor { distance, reach } => {
            format!(
                "the rotor has left its shaft (its centre is {distance:e} m off, allowed are {reach:e} m)"
            )
        }
        Fault::Overlap { roller, next, depth } => format!(
            "roller[{roller}] and roller[{next}] go through each other (by {depth:e} m); a cage with pockets keeps \
             rollers apart, or their contact, rollers.neighbours"
        ),
        Fault::EnergyCreated { given, available } => {
            let field = names.giving.clone().unwrap_or_default();
            format!(
                "the film of the guide has given {given:e} J, more than the {available:e} J that loads, drives and the start \
                 could give: its law can make energy ({field})"
            )
        }
        Fault::TooFast { velocity, speed } => {
            let name = velocity_name(velocity);
            format!("{name} is too fast: {speed:e} m/s is more than sound in steel, {SOUND:e} m/s")
        }
        Fault::LostBall { ball, race, approach } => format!(
            "ball[{ball}] has left the groove of its {race}, or its contact is wider than the groove (approach {approach:e} m)"
        ),
        Fault::LostCage => "the cage has left the bearing".to_owned(),
        Fault::NotFinite { contact: Some(contact), .. } => {
            let contacts = (names.contacts)();
            let name = contacts.get(contact).map_or("?", String::as_str);
            format!("the force of {name} is not a finite number")
        }
        Fault::NotFinite { velocity, contact: None } => {
            format!("the rate of {} is not a finite number", velocity_name(velocity))
        }
        Fault::NoSlope { velocity } => {
            let name = velocity_name(velocity);
            format!("a derivative of the rate of {name} is not a finite number")
        }
    }
}
