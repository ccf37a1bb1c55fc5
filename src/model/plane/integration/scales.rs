//! Lengths, frequencies and rates that describe a model as a whole: what errors are measured by, and what limits the
//! steps.

use crate::bodies::{CAGE, ForceSource, INNER_RING, Moves, OUTER_RING, PLACES, ROTOR, states_of};
use crate::model::plane::{Input, Plane};
use crate::pairs::{ContactLaw, NEIGHBOUR};
use crate::scalar::math;

/// Ratio of velocity to position scale in the error control, 1/s: slow against contact vibration (2e5 1/s), fast
/// against the cage (1e2 1/s).
const RATE_SCALE: f64 = 1e4;

impl Plane {
    /// Radial guide clearance in m, if the cage is guided.
    pub fn guide_clearance(&self) -> Option<f64> {
        let guide = self.scene.cage.as_ref()?.guide.as_ref()?;
        Some(guide.diametral_clearance / 2.0)
    }

    /// Clearance in m of an element to the pillar before or behind it, if there are pockets.
    pub fn pocket_clearance(&self) -> Option<f64> {
        self.pairs.iter().find_map(|pair| pair.clearance())
    }

    /// Length in m that errors are measured by: the guide clearance, else the pocket clearance, else 0.1 mm.
    pub fn reference_length(&self) -> f64 {
        self.guide_clearance().or_else(|| self.pocket_clearance()).unwrap_or(1e-4)
    }

    /// Highest contact frequency in rad/s at the largest load of the scene: of a roller between two loaded raceways,
    /// or, if one is so light, of the ring on half of the rollers or the cage between all elements or on its guide.
    /// Zero without contacts.
    pub fn contact_frequency(&self) -> f64 {
        let (rollers, pocket_load) = self.roller_frequencies().unwrap_or((0.0, 1.0));
        let cage = self.shared[CAGE].as_ref().map_or(0.0, |cage| {
            let pockets: f64 = self.laws_on(CAGE).map(|law| law.stiffness_at_load(pocket_load)).sum();
            let with_cage = self.between.iter().filter(|pair| pair.info().bodies.contains(&CAGE));
            let guide: f64 = with_cage.map(|pair| pair.stiffness()).sum();
            cage.frequency_on(guide, pockets * self.element_count() as f64, self.pitch_radius())
        });
        rollers.max(cage).sqrt()
    }

    /// Orders and frequencies in rad/s of the waves of an elastic ring of the cage, free and at rest.
    pub fn ring_waves(&self) -> Vec<(u32, f64)> {
        self.shared[CAGE].as_ref().map_or_else(Vec::new, |cage| cage.waves())
    }

    /// The highest of all: contacts and waves, rad/s.
    pub fn highest_frequency(&self) -> f64 {
        self.ring_waves().iter().fold(self.contact_frequency(), |highest, (_, wave)| highest.max(*wave))
    }

    /// Laws of the pairs with this shared body.
    fn laws_on(&self, body: usize) -> impl Iterator<Item = &ContactLaw> {
        self.infos.iter().zip(&self.laws).filter(move |(info, _)| info.mate == body).map(|(_, law)| law)
    }

    /// Highest squared frequency of rollers and ring in 1/s^2, and the largest roller load in N; `None` without raceways.
    fn roller_frequencies(&self) -> Option<(f64, f64)> {
        let mass = self.elements.mass()?;
        let rolling = || self.infos.iter().zip(&self.laws).filter(|(info, _)| info.rolls).map(|(_, law)| law);
        let inner = self.law_of(ForceSource::InnerRaceway)?;
        let largest = |input| self.inputs.largest(input);
        let count = self.layout.count as f64;
        let weighing =
            |body: usize| self.shared[body].as_ref().and_then(|body| body.weighing()).unwrap_or(0.0);
        let rings = [INNER_RING, OUTER_RING, ROTOR];
        let weight = rings.map(weighing).iter().sum::<f64>() * math::hypot(self.gravity[0], self.gravity[1]);
        let [by_outer, by_inner] = self.elements.orbit_ratios();
        let orbit = largest(Input::RingSpeed) * by_inner + largest(Input::OuterRingSpeed) * by_outer;
        let centrifugal = self.elements.centrifugal(orbit);
        let larger = self.elements.set().radius_excess.iter().copied().fold(0.0, f64::max);
        let preload = inner.spring((larger - self.scene.radial_clearance() / 4.0).max(0.0))[0];
        let off = |place: usize| largest(PLACES[place][0]);
        let apart = math::hypot(off(1) + off(5), off(2) + off(6));
        let pressed = inner.spring((0.5 * apart - self.scene.radial_clearance() / 4.0).max(0.0))[0];
        // 4.1 F/Z is the largest roller load of a line contact bearing without clearance; 1 N keeps it positive.
        let per_roller = 4.1 / count.max(4.1);
        let loads = [
            [Input::LoadY, Input::LoadZ],
            [Input::OuterLoadY, Input::OuterLoadZ],
            [Input::RotorLoadY, Input::RotorLoadZ],
        ];
        let load = loads.iter().map(|[y, z]| math::hypot(largest(*y), largest(*z))).sum::<f64>() + weight;
        let q = per_roller * load + centrifugal + preload + pressed + 1.0;
        let stiffness: f64 = rolling().map(|law| law.stiffness_at_load(q)).sum();
        // A roller between two that move the other way.
        let neighbours = self.laws_on(NEIGHBOUR).map(|law| 4.0 * law.stiffness_at_load(q)).sum();
        let roller = stiffness.max(neighbours) / mass;
        let shaft = |body: usize| {
            let pairs = self.between_infos.iter().zip(&self.between);
            let of_rotor = pairs.filter(|(info, _)| info.bodies[0] == ROTOR && info.bodies.contains(&body));
            of_rotor.map(|(_, pair)| pair.stiffness()).sum::<f64>()
        };
        let ring = rings.into_iter().fold(0.0, |highest: f64, place| {
            let contacts =
                if place == ROTOR { 0.0 } else { inner.stiffness_at_load(q) * 0.5 * count.max(2.0) };
            let body = self.shared[place].as_ref();
            highest.max(body.map_or(0.0, |body| body.frequency_on(contacts + shaft(place), 0.0, 0.0)))
        });
        Some((roller.max(ring), q))
    }

    /// Whether the contacts that set the highest frequency are damped.
    #[doc(hidden)]
    pub fn damped(&self) -> bool {
        let raceway = self.law_of(ForceSource::InnerRaceway);
        raceway.or_else(|| self.laws_on(CAGE).next()).is_none_or(ContactLaw::damped)
    }

    /// What counts as one unit of error for every state: the reference length for positions, divided by a radius
    /// for angles, times 1e4 1/s for velocities; what nodes say of theirs.
    #[doc(hidden)]
    pub fn state_scales(&self) -> Vec<f64> {
        let length = self.reference_length();
        let (pitch, radius) = (self.pitch_radius(), self.elements.set().radius);
        let scales = states_of(&self.shared, &*self.elements).map(|(state, _, coordinate)| {
            let unit = match coordinate.moves {
                Moves::Itself => length,
                Moves::PitchCircle => length / pitch,
                Moves::Surface => length / radius,
            };
            if state.is_rate() { unit * RATE_SCALE } else { unit }
        });
        let of_nodes = self.nodes.iter().flat_map(|node| node.states().iter().map(|state| state.error_unit));
        scales.chain(of_nodes).collect()
    }
}
