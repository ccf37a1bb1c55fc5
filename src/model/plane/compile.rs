//! From the scene to bodies, pairs and coordinates.

use super::Plane;
use super::report::Watch;
use crate::bodies::{self, CAGE, INNER_RING, OUTER_RING, ROTOR, SHARED, SharedBodies};
use crate::error::Result;
use crate::model::Channel;
use crate::model::signals::InputSignals;
use crate::pairs;
use crate::scene::Scene;
use std::sync::Arc;

impl Plane {
    /// Builds that of a checked scene with these inputs; it watches nothing yet.
    pub(in crate::model) fn new(scene: Arc<Scene>, inputs: Arc<InputSignals>) -> Result<Self> {
        let elements = bodies::elements(&scene);
        let shared = bodies::shared_bodies(&scene, elements.set());
        let nodes = bodies::nodes(&scene);
        let viscosity = inputs.viscosity_at_start(&scene);
        let (pairs, between) =
            (pairs::element_pairs(&scene, viscosity)?, pairs::shared_pairs(&scene, viscosity)?);
        let mut model = Plane {
            masses: shared
                .each_ref()
                .map(|body| body.as_ref().and_then(|b| b.mass()).unwrap_or(f64::INFINITY)),
            outer_moves: moves(&shared, OUTER_RING),
            moving: Vec::new(),
            free: Vec::new(),
            moved: (0..SHARED).filter(|place| is_moved(&shared, *place)).collect(),
            onsets: pairs.iter().any(|pair| pair.has_onset()),
            layout: bodies::layout_of(&shared, &*elements, &nodes),
            gravity: scene.gravity.map_or([0.0; 2], |g| [g.y, g.z]),
            shared,
            mobility: elements.mobility(),
            elements,
            lubricant: None,
            nodes,
            infos: pairs.iter().map(|pair| pair.info()).collect(),
            parts: pairs.iter().map(|pair| pair.law().parts()).collect(),
            laws: pairs.iter().map(|pair| pair.law()).collect(),
            pairs,
            between_infos: between.iter().map(|pair| pair.info()).collect(),
            between,
            inputs,
            watch: Watch::default(),
            scene,
        };
        let lubricant = model.nodes_in().find_map(|(node, at)| Some(at.start + node.lubricant()?));
        model.lubricant = lubricant;
        model.list_bodies();
        Ok(model)
    }

    /// Lists the shared bodies that evaluations look at, by bodies and layout.
    pub(super) fn list_bodies(&mut self) {
        self.moving = [INNER_RING, CAGE, ROTOR, OUTER_RING]
            .into_iter()
            .filter(|place| *place != OUTER_RING || self.outer_moves)
            .filter(|place| self.shared[*place].is_some())
            .map(|place| (place, self.layout.shared(place).unwrap_or(0)))
            .collect();
        self.free = self.layout.free().map(|place| (place, self.layout.range(place))).collect();
    }

    /// Follows the channels at these places of all in every step.
    pub(in crate::model) fn watch_channels(&mut self, places: &[usize], channels: &[Channel]) {
        self.watch = Watch::new(places, channels, &self.infos, self.element_count());
    }
}

/// Whether a shared body moves or turns.
fn moves(shared: &SharedBodies, place: usize) -> bool {
    let body = shared[place].as_ref();
    body.is_some_and(|body| body.turned_by().is_some() || body.mass().is_some()) || is_moved(shared, place)
}

/// Whether inputs prescribe the place of a shared body.
fn is_moved(shared: &SharedBodies, place: usize) -> bool {
    shared[place].as_ref().is_some_and(|body| body.moved_by().is_some())
}
