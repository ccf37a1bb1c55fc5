//! How long a step may be from a state before a narrow law sets in: the edge of a lubricant layer, the asperities and the
//! solid contact of the guide, the walls of plane pockets.
//!
//! Bodies move on straight lines for this. From outside an onset, a step ends no further behind it than a share of what the
//! law needs to become itself; within a gap it uses up at most a share of what is left; from surfaces that overlap it ends
//! within the film that they part into. So no law is passed between two states that both are outside of it. Signals bound the step, too: see [`InputSignals::shortest_period`].
//!
//! [`InputSignals::shortest_period`]: crate::model::signals::InputSignals::shortest_period

use crate::bodies::OUTER_RING;
use crate::integrate::Tuning;
use crate::model::plane::{HostInputs, InputValues, Plane};
use crate::pairs::Ahead;

impl Plane {
    /// The longest step (s) from the state (q, v) at time `t` that passes no narrow law unseen, or any longer one than
    /// `wanted`.
    #[doc(hidden)]
    pub fn longest_step(
        &self,
        t: f64,
        [q, v]: [&[f64]; 2],
        host: &HostInputs,
        wanted: f64,
        tuning: &Tuning,
    ) -> f64 {
        let mut longest = self.inputs.shortest_period(host) / tuning.steps_per_period;
        if self.between.is_empty() && !self.onsets {
            return longest;
        }
        // A ring that stands guides at no input.
        let moved = self.between_infos.iter().any(|info| info.bodies[1] != OUTER_RING || self.outer_moves);
        let inputs = if moved || self.onsets { self.inputs.at(t, host) } else { InputValues::default() };
        let shared = self.motions_at(q, v, &inputs);
        let ahead = Ahead {
            shared: &shared,
            bodies: &self.shared,
            elements: &*self.elements,
            layout: &self.layout,
            q,
            v,
            inputs: &inputs,
            masses: &self.masses,
            wanted,
            tuning,
        };
        longest = self.between.iter().map(|pair| pair.longest_step(&ahead)).fold(longest, f64::min);
        if !self.onsets {
            return longest;
        }
        self.pairs.iter().map(|pair| pair.longest_step(&ahead)).fold(longest, f64::min)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::{Input, Model};
    use std::sync::Arc;

    fn model(changes: &[(&str, &str)]) -> Arc<Plane> {
        let path = concat!(env!("CARGO_MANIFEST_DIR"), "/scenes/grease_guide.json");
        let text = std::fs::read_to_string(path).unwrap();
        let scene = crate::Scene::from_json_with(&text, changes.iter().copied()).unwrap();
        Model::new(scene).unwrap().plane().unwrap().clone()
    }

    /// Longest step of a cage at `y` m that moves to the right with `speed` m/s in a guide without reachable pockets.
    fn longest(model: &Plane, y: f64, speed: f64) -> f64 {
        let (mut q, mut v) = ([y, 0.0, 0.0], [speed, 0.0, 0.0]);
        let inputs = model.inputs.at(0.0, &HostInputs::default());
        (q[2], v[2]) = (inputs.orbit_travel(), inputs.of(Input::OrbitSpeed));
        model.longest_step(0.0, [&q, &v], &HostInputs::default(), f64::INFINITY, &Tuning::default())
    }

    #[test]
    fn steps_end_within_a_share_of_a_layer() {
        let layer = ("cage.guide.film.lubricant_layer.thickness", "1e-7");
        let far = ("cage.pocket.solid_plane.diametral_clearance", "1e-3");
        let model = model(&[layer, far, ("cage.guide.film_share.roughness", "1e-9")]);
        let edge = 0.2135e-3 - 1e-7;
        // From all over the clearance, towards the edge and away from it through the centre.
        for y in [0.0, 0.1e-3, 0.2e-3, 0.2133e-3] {
            for speed in [0.3, -0.3] {
                let h = longest(&model, y, speed);
                let way = h * 0.3;
                let room = if speed > 0.0 { edge - y } else { edge + y };
                let step = way.min(0.25 * (0.2135e-3 - y) + 1e-12);
                assert!(step > 0.0 && way <= room + 0.2501e-7, "{y} {speed}: {way} {room}");
            }
        }
        // Within the layer by the gap; apart, never zero.
        let h = longest(&model, 0.2135e-3 - 0.8e-7, 0.3);
        assert!((h * 0.3 / 0.2e-7 - 1.0).abs() < 1e-6, "{h}");
        assert_eq!(longest(&model, 0.0, 0.0), f64::INFINITY);
    }

    #[test]
    fn steps_from_overlapping_surfaces_end_within_the_film() {
        for thickness in ["1e-7", "1e-5"] {
            let layer = ("cage.guide.film.lubricant_layer.thickness", thickness);
            let model = model(&[layer, ("cage.pocket", "null")]);
            let thickness: f64 = thickness.parse().unwrap();
            for depth in [0.0, 1e-9, 1e-6, 1e-3] {
                let way = longest(&model, 0.2135e-3 + depth, -13.0) * 13.0;
                let room = depth + 0.25 * thickness;
                assert!((way / room - 1.0).abs() < 1e-6, "{thickness} {depth}: {way} {room}");
                // Deeper, the solid contact alone is what it meets.
                assert_eq!(longest(&model, 0.2135e-3 + depth, 13.0), f64::INFINITY);
            }
        }
    }

    #[test]
    fn signals_have_ten_steps_per_period() {
        let sine = r#"{"sine": {"mean": 300.0, "amplitude": 1.0, "frequency": 2e5, "phase": 0.0}}"#;
        let fast = model(&[("inner_ring.speed", sine)]);
        let (q, v) = ([0.0; 3], [0.0; 3]);
        let mut host = HostInputs::default();
        assert!(
            (fast.longest_step(0.0, [&q, &v], &host, 1.0, &Tuning::default()) / 5e-7 - 1.0).abs() < 1e-12
        );
        fast.inputs.set(&mut host, 0.0, Input::RingSpeed, Some((300.0, None)));
        assert!(fast.longest_step(0.0, [&q, &v], &host, 1.0, &Tuning::default()) > 1e-6);
    }

    #[test]
    fn walls_of_plane_pockets_are_met_in_time() {
        let model = model(&[("cage.guide", "null")]);
        // The cage turns ahead of its elements at 0.09 m/s: half the clearance of 0.555 mm is left to each wall.
        let inputs = model.inputs.at(0.0, &HostInputs::default());
        let v = [0.0, 0.0, inputs.of(Input::OrbitSpeed) + 2.0];
        let h = model.longest_step(0.0, [&[0.0; 3], &v], &HostInputs::default(), 1.0, &Tuning::default());
        let turn = 0.25 * (12.34e-3f64 / 1e6).sqrt();
        assert!((h / (0.2775e-3 / 0.09 + turn) - 1.0).abs() < 1e-6, "{h}");
    }
}
