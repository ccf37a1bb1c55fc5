//! A burst of motion at constant temperatures, and its mean powers.

use crate::error::Result;
use crate::model::{Input, Model, Power};
use crate::sim::{RunLimits, Sim};
use std::f64::consts::TAU;
use std::sync::Arc;

/// Length of a burst among elements of prescribed motion and among free ones, whose powers scatter, s; the share of it after which
/// powers count.
const LENGTH: f64 = 30e-3;
const LENGTH_OF_FREE: f64 = 0.1;
const COUNTED_FROM: f64 = 0.4;
/// Places of a burst at which the cage is looked at.
const LOOKS: u32 = 600;

/// The simulation that goes from burst to burst.
pub(super) struct Burst {
    sim: Sim,
    /// Channels of the place of the cage beside its guide.
    place: Option<[usize; 2]>,
    /// Channel of the viscosity.
    viscosity: Option<usize>,
}

/// Mean heat of a burst, W.
#[derive(Clone, Debug, Default)]
pub(super) struct Heating {
    pub(super) into_nodes: Vec<f64>,
    pub(super) of_motion: Vec<(String, f64)>,
    /// What no source names.
    pub(super) in_no_lump: Vec<(String, f64)>,
    pub(super) of_bearing: f64,
    pub(super) whirl_speed: f64,
    /// Viscosity of the lubricant, Pa s.
    pub(super) viscosity: f64,
    /// Radial clearance of a roller bearing, m.
    pub(super) clearance: Option<f64>,
}

impl Burst {
    pub(super) fn new(sim: Sim) -> Self {
        let channel = |name: &str| sim.channels().iter().position(|channel| channel.name == name);
        let place = channel("cage.y_ratio").zip(channel("cage.z_ratio")).map(|(y, z)| [y, z]);
        Self { place, viscosity: channel("lubricant.viscosity"), sim }
    }

    /// The bearing at the temperatures of the last burst.
    pub(super) fn model(&self) -> &Arc<Model> {
        self.sim.model()
    }

    /// Speed of the inner ring, rad/s.
    pub(super) fn ring_speed(&self) -> f64 {
        let place = self.sim.model().input_list().position(|input| input == Input::RingSpeed);
        place.and_then(|place| self.sim.input(place).ok()).unwrap_or(0.0)
    }

    /// Back to the start of the scene, after a burst that failed.
    pub(super) fn restart(&mut self) {
        // A scene that has started starts again.
        let _ = self.sim.reset();
    }

    /// The bearing at these temperatures (K), which moves on from where it was.
    fn warm(&mut self, temperatures: &[f64]) -> Result<()> {
        let mut scene = self.sim.model().scene().copied();
        if let Some(heat) = &mut scene.heat {
            heat.nodes.iter_mut().zip(temperatures).for_each(|(node, t)| node.start = Some(*t));
        }
        let mut sim = Sim::new(Arc::new(Model::new(scene)?))?;
        // Lumps in motion begin with what the network has found.
        let mut state = self.sim.state().to_vec();
        let lumps = state.len() - sim.model().layout().of_nodes();
        state[lumps..].copy_from_slice(&sim.state()[lumps..]);
        sim.set_state(self.sim.time(), &state)?;
        self.sim = sim;
        Ok(())
    }

    /// Goes on for a burst with the lumps at these temperatures (K): the mean heat of its last part from these sources (power, lump,
    /// share), over whole turns of the whirl where there is one.
    pub(super) fn run(
        &mut self,
        temperatures: &[f64],
        sources: &[(Power, usize, f64)],
        limits: &RunLimits,
    ) -> Result<Heating> {
        self.warm(temperatures)?;
        let start = self.sim.time();
        let length = if self.sim.model().has_rollers() { LENGTH_OF_FREE } else { LENGTH };
        let at = |i: u32| start + length * f64::from(i) / f64::from(LOOKS);
        let first = (COUNTED_FROM * f64::from(LOOKS)) as u32;
        limits.advance(&mut self.sim, at(first))?;
        let begin = self.works()?;
        let mut angle = self.angle()?;
        let (mut turned, mut turns) = (0.0f64, 0.0f64);
        let mut end = begin.clone();
        for i in first + 1..=LOOKS {
            limits.advance(&mut self.sim, at(i))?;
            let now = self.angle()?;
            turned += (now - angle + 0.5 * TAU).rem_euclid(TAU) - 0.5 * TAU;
            angle = now;
            // The end of the last whole turn, or of the burst before there is one.
            let whole = (turned.abs() / TAU).floor();
            if whole > turns || turns == 0.0 {
                turns = whole;
                end = self.works()?;
            }
        }
        let time = end.0 - begin.0;
        let heat: Vec<f64> = end.1.iter().zip(&begin.1).map(|(end, begin)| (begin - end) / time).collect();
        let mut heating = Heating { into_nodes: vec![0.0; temperatures.len()], ..Heating::default() };
        for (power, node, share) in sources {
            let heat = share * heat[*power as usize];
            heating.into_nodes[*node] += heat;
            match heating.of_motion.iter_mut().find(|(name, _)| name == power.name()) {
                Some((_, sum)) => *sum += heat,
                None => heating.of_motion.push((power.name().to_owned(), heat)),
            }
        }
        for power in Power::ALL.into_iter().filter(|power| power.is_lost()) {
            let named: f64 = sources.iter().filter(|source| source.0 == power).map(|source| source.2).sum();
            let rest = (1.0 - named) * heat[power as usize];
            if rest.abs() > 1e-12 * heat.iter().fold(0.0, |sum: f64, heat| sum + heat.abs()) {
                heating.in_no_lump.push((power.name().to_owned(), rest));
            }
        }
        let scene = self.sim.model().scene();
        heating.clearance = scene.rollers.as_ref().map(|_| scene.radial_clearance());
        heating.viscosity = self.viscosity.map_or(Ok(f64::NAN), |channel| self.sim.output(channel))?;
        heating.whirl_speed = if turns > 0.0 { turned / (at(LOOKS) - at(first)) } else { 0.0 };
        Ok(heating)
    }

    /// Time and works that belong to it.
    fn works(&mut self) -> Result<(f64, Vec<f64>)> {
        let balance = self.sim.power_balance()?;
        Ok((balance.to, balance.work.to_vec()))
    }

    /// Direction of the cage centre from that of its guide, rad.
    fn angle(&mut self) -> Result<f64> {
        let Some([y, z]) = self.place else { return Ok(0.0) };
        let [y, z] = [self.sim.output(y)?, self.sim.output(z)?];
        Ok(crate::scalar::math::atan2(z, y))
    }
}
