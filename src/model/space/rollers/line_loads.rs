//! How contacts of rollers are loaded along their length at the last evaluated state.

use super::super::Space;
use super::super::workspace::Workspace;
use super::contacts::Contact;
use crate::model::{Quantity, quantity};

/// What is known of every place of a contact along its roller.
pub const LINE_LOAD_QUANTITIES: [Quantity; 5] = [
    quantity("place", "m", "along the roller from its middle, positive towards +x"),
    quantity("extent", "m", "length of the roller that the place stands for"),
    quantity("line_load", "N/m", "normal force per length, with damping"),
    quantity("largest_pressure", "Pa", "largest pressure of Hertz's line contact under that load"),
    quantity("half_width", "m", "half width b of Hertz's line contact there"),
];

/// Values of [`LINE_LOAD_QUANTITIES`].
pub type LineLoad = [f64; LINE_LOAD_QUANTITIES.len()];

impl Space {
    /// Places of a contact, by its place among the names of contacts, in order along the roller: the nodes of its slices. None where the surfaces
    /// are apart, nor of contacts that are no lines.
    pub(crate) fn line_loads(&self, ws: &Workspace, contact: usize) -> Vec<LineLoad> {
        let Some(rollers) = &self.rollers else { return Vec::new() };
        let of_roller = self.contacts_of_ball.len();
        let (roller, in_list) = (contact / of_roller, contact % of_roller);
        let touches = |contact: &&Contact| contact.roller == roller && contact.in_list == in_list;
        let Some(contact) = ws.rollers.contacts.iter().find(touches) else { return Vec::new() };
        if rollers.laws[contact.law].line().is_none() {
            return Vec::new();
        }
        let mut list: Vec<LineLoad> = ws
            .rollers
            .places(contact)
            .iter()
            .map(|node| {
                let extent = node.slice.share * 2.0 * rollers.half_length;
                let [half_width, pressure] = rollers.hertz(contact.law, node);
                [node.slice.place, extent, rollers.line_load(node), pressure, half_width]
            })
            .collect();
        list.sort_by(|a, b| a[0].total_cmp(&b[0]));
        list
    }
}
