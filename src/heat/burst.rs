//! A burst of motion at constant temperatures, and its mean powers.

use crate::error::Result;
use crate::model::{Input, POWERS};
use crate::scene::Heat;
use crate::sim::Sim;
use std::f64::consts::TAU;

/// Length of a burst, s, and the share of it after which powers count.
const LENGTH: f64 = 30e-3;
const COUNTED_FROM: f64 = 0.4;
/// Places of a burst at which the cage is looked at.
const LOOKS: u32 = 600;

/// The simulation that goes from burst to burst.
pub(super) struct Burst {
    sim: Sim,
    /// Power, lump and share of every source.
    sources: Vec<(usize, usize, f64)>,
    temperature: Option<usize>,
    ring: Option<usize>,
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
    pub(super) of_bearing: f64,
    pub(super) whirl_speed: f64,
    /// Viscosity of the lubricant, Pa s.
    pub(super) viscosity: f64,
}

impl Burst {
    pub(super) fn new(sim: Sim, heat: &Heat) -> Self {
        let power = |name: &str| POWERS.iter().position(|power| *power == name);
        let sources = heat
            .sources
            .iter()
            .filter_map(|source| Some((power(&source.power)?, heat.node(&source.node)?, source.share)));
        let list: Vec<Input> = sim.model().input_list().collect();
        let input = |wanted: Input| list.iter().position(|input| *input == wanted);
        let channel = |name: &str| sim.channels().iter().position(|channel| channel.name == name);
        let place = channel("cage.y_ratio").zip(channel("cage.z_ratio")).map(|(y, z)| [y, z]);
        Self {
            sources: sources.collect(),
            temperature: input(Input::Temperature),
            ring: input(Input::RingSpeed),
            place,
            viscosity: channel("lubricant.viscosity"),
            sim,
        }
    }

    /// Speed of the inner ring, rad/s.
    pub(super) fn ring_speed(&self) -> f64 {
        self.ring.and_then(|place| self.sim.input(place).ok()).unwrap_or(0.0)
    }

    /// Goes on for a burst with the lubricant at this temperature (K): the mean heat of its last part, over whole turns of the
    /// whirl where there is one, for so many lumps.
    pub(super) fn run(&mut self, temperature: f64, nodes: usize) -> Result<Heating> {
        if let Some(place) = self.temperature {
            self.sim.set_input(place, temperature)?;
        }
        let start = self.sim.time();
        let at = |i: u32| start + LENGTH * f64::from(i) / f64::from(LOOKS);
        let first = (COUNTED_FROM * f64::from(LOOKS)) as u32;
        self.sim.advance_to(at(first))?;
        let begin = self.works()?;
        let mut angle = self.angle()?;
        let (mut turned, mut turns) = (0.0f64, 0.0f64);
        let mut end = begin.clone();
        for i in first + 1..=LOOKS {
            self.sim.advance_to(at(i))?;
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
        let mut heating = Heating { into_nodes: vec![0.0; nodes], ..Heating::default() };
        for (power, node, share) in &self.sources {
            heating.into_nodes[*node] += share * heat[*power];
            heating.of_motion.push((POWERS[*power].to_owned(), share * heat[*power]));
        }
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
