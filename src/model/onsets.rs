//! How long a step may be from a state before a narrow law sets in: the edge of a lubricant layer, the asperities and the
//! solid contact of the guide, the walls of plane pockets.
//!
//! Bodies move on straight lines for this. From outside an onset, a step ends no further behind it than a share of what the
//! law needs to become itself; within a gap it uses up at most a share of what is left. So no law is passed between two
//! states that both are outside of it. Signals bound the step, too: see [`InputSignals::shortest_period`].
//!
//! [`InputSignals::shortest_period`]: super::inputs::InputSignals::shortest_period

use super::laws::{PlaneLaws, PocketLaws};
use super::{CageBody, ElementKind, HostInputs, Input, Model};
use crate::contact::rotate;
use crate::integrate::Tuning;
use crate::laws::guide::{GuideFilm, GuideLaw};
use crate::laws::solid_contact::SolidContact;
use crate::scalar::math;

impl Model {
    /// The longest step (s) from the state (q, v) at time `t` that passes no narrow law unseen, or any longer one than
    /// `wanted`.
    pub fn longest_step(
        &self,
        t: f64,
        [q, v]: [&[f64]; 2],
        host: &HostInputs,
        wanted: f64,
        tuning: &Tuning,
    ) -> f64 {
        let mut longest = self.inputs.shortest_period(host) / tuning.steps_per_period;
        let Some(cage) = &self.cage else { return longest };
        if let Some(guide) = &self.laws.guide {
            let inputs = if cage.guided_by_inner_ring { self.inputs_at(t, host) } else { Default::default() };
            let [of_cage, of_ring] = self.guide_bodies(q, v, &inputs);
            let relative = |a: [f64; 2], b: [f64; 2]| [a[0] - b[0], a[1] - b[1]];
            let position = relative(of_cage.position, of_ring.position);
            let velocity = relative(of_cage.velocity, of_ring.velocity);
            longest = longest.min(in_guide(guide, cage, position, velocity, tuning));
        }
        if let Some(PocketLaws::Plane(laws)) = &self.laws.pocket {
            let prescribed = match &self.elements.kind {
                ElementKind::Rollers(_) => None,
                ElementKind::Kinematic => {
                    let inputs = self.inputs_at(t, host);
                    Some([inputs.orbit_travel, inputs.of(Input::OrbitSpeed)])
                }
            };
            longest = longest.min(self.in_pockets(laws, prescribed, [q, v], wanted, tuning));
        }
        longest
    }

    /// The same for the walls of plane pockets, with the travel (rad) and speed (rad/s) of elements that are prescribed.
    fn in_pockets(
        &self,
        laws: &PlaneLaws,
        prescribed: Option<[f64; 2]>,
        [q, v]: [&[f64]; 2],
        wanted: f64,
        tuning: &Tuning,
    ) -> f64 {
        let (Some(cage), Some(c)) = (&self.cage, self.layout.cage) else { return f64::INFINITY };
        let mass = match &self.elements.kind {
            ElementKind::Rollers(rollers) => rollers.mass.min(cage.mass),
            ElementKind::Kinematic => cage.mass,
        };
        let (sin, cos) = math::sin_cos(q[c + 2]);
        // Position and velocity of the cage in its own axes.
        let (place, speed) = (rotate([q[c], q[c + 1]], -sin, cos), rotate([v[c], v[c + 1]], -sin, cos));
        let pitch = self.elements.pitch_radius;
        let pass = Passage::of(&laws.contact, mass, tuning);
        let mut longest = f64::INFINITY;
        for (j, [x, y]) in self.elements.directions.iter().enumerate() {
            let [angle, orbit] = match prescribed {
                Some(motion) => motion,
                None => [q[self.layout.roller(j) + 1], v[self.layout.roller(j) + 1]],
            };
            let offset = pitch * (angle - q[c + 2]) - (place[1] * x - place[0] * y);
            let approach = pitch * (orbit - v[c + 2]) - (speed[1] * x - speed[0] * y);
            let rest = laws.shape.clearance - offset * approach.signum();
            if rest > 0.0 && rest <= approach.abs() * wanted {
                longest = longest.min(rest / approach.abs() + pass.time(approach.abs()));
            }
        }
        longest
    }
}

/// How far a step may pass the onset of a solid contact.
struct Passage {
    /// Share of the time in which it turns a body, s.
    turn: f64,
    /// Share of the depth over which its damper sets in, m.
    depth: f64,
}

impl Passage {
    /// For a body of `mass` kg.
    fn of(contact: &SolidContact, mass: f64, tuning: &Tuning) -> Self {
        let turn = if contact.stiffness > 0.0 { (mass / contact.stiffness).sqrt() } else { 0.0 };
        Self { turn: tuning.turn_share * turn, depth: tuning.onset_share * contact.softening_depth }
    }

    /// In s, at this speed in m/s.
    fn time(&self, speed: f64) -> f64 {
        self.turn.max(self.depth / speed)
    }
}

/// The same for a journal at `position` (m) from the centre of its bush, with `velocity` (m/s).
fn in_guide(
    guide: &GuideLaw,
    cage: &CageBody,
    position: [f64; 2],
    velocity: [f64; 2],
    tuning: &Tuning,
) -> f64 {
    let share = tuning.onset_share;
    let e = math::hypot(position[0], position[1]);
    let speed = math::hypot(velocity[0], velocity[1]);
    let along = position[0] * velocity[0] + position[1] * velocity[1];
    // Time until the distance from the centre is `radius`, which is larger than e.
    let until = |radius: f64| {
        let rest = (radius - e) * (radius + e);
        let root = (along * along + speed * speed * rest).sqrt();
        if along > 0.0 { rest / (along + root) } else { (root - along) / (speed * speed) }
    };
    let gap = guide.free_clearance - e;
    // Where surfaces touch before the film is gone, the gap may close.
    let fading = tuning.fading * guide.roughness;
    let least = if guide.solid.is_some() { fading } else { tuning.thinnest_film * guide.free_clearance };
    let mut longest = f64::INFINITY;
    if gap > 0.0 && guide.film.is_some() {
        longest = until(e + share * gap.max(least));
    }
    let mut onset = |rest: f64, depth: f64| {
        if rest > 0.0 {
            longest = longest.min(until(e + rest + share * depth));
        }
    };
    if let Some(GuideFilm::LubricantLayer(layer)) = &guide.film {
        onset(gap - layer.thickness, layer.thickness);
    }
    if let Some(solid) = &guide.solid {
        let rest = gap - solid.asperity_height;
        if rest > 0.0 {
            let depth = speed * Passage::of(&solid.contact, cage.mass, tuning).time(speed);
            onset(rest, depth / share);
        }
        if guide.film.is_some() {
            onset(gap - fading, fading);
        }
    }
    if longest.is_nan() { f64::INFINITY } else { longest }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::Model;

    fn model(changes: &[(&str, &str)]) -> Model {
        let path = concat!(env!("CARGO_MANIFEST_DIR"), "/scenes/grease_guide.json");
        let text = std::fs::read_to_string(path).unwrap();
        Model::new(crate::Scene::from_json_with(&text, changes.iter().copied()).unwrap()).unwrap()
    }

    /// Longest step of a cage at `y` m that moves to the right with `speed` m/s in a guide without reachable pockets.
    fn longest(model: &Model, y: f64, speed: f64) -> f64 {
        let (mut q, mut v) = ([y, 0.0, 0.0], [speed, 0.0, 0.0]);
        let inputs = model.inputs_at(0.0, &HostInputs::default());
        (q[2], v[2]) = (inputs.orbit_travel, inputs.of(Input::OrbitSpeed));
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
    fn signals_have_ten_steps_per_period() {
        let sine = r#"{"sine": {"mean": 300.0, "amplitude": 1.0, "frequency": 2e5, "phase": 0.0}}"#;
        let fast = model(&[("inner_ring.speed", sine)]);
        let (q, v) = ([0.0; 3], [0.0; 3]);
        let mut host = HostInputs::default();
        assert!(
            (fast.longest_step(0.0, [&q, &v], &host, 1.0, &Tuning::default()) / 5e-7 - 1.0).abs() < 1e-12
        );
        fast.set_input(&mut host, 0.0, Input::RingSpeed, Some(300.0));
        assert!(fast.longest_step(0.0, [&q, &v], &host, 1.0, &Tuning::default()) > 1e-6);
    }

    #[test]
    fn walls_of_plane_pockets_are_met_in_time() {
        let model = model(&[("cage.guide", "null")]);
        // The cage turns ahead of its elements at 0.09 m/s: half the clearance of 0.555 mm is left to each wall.
        let inputs = model.inputs_at(0.0, &HostInputs::default());
        let v = [0.0, 0.0, inputs.of(Input::OrbitSpeed) + 2.0];
        let h = model.longest_step(0.0, [&[0.0; 3], &v], &HostInputs::default(), 1.0, &Tuning::default());
        let turn = 0.25 * (12.34e-3f64 / 1e6).sqrt();
        assert!((h / (0.2775e-3 / 0.09 + turn) - 1.0).abs() < 1e-6, "{h}");
    }
}
