//! Heat balance of a bearing: what its motion loses warms lumps, they warm each other, and the lubricant follows one of them.
//!
//! Minutes of warming are not run. The motion is run in bursts of some hundredths of a second at constant temperatures, and its mean
//! powers move the temperatures: to where they stay ([`HeatBalance::settle`]), or along the hours until then
//! ([`HeatBalance::warm_up`]).
//!
//! ```no_run
//! fn main() -> cagedyn::Result<()> {
//!     let text = std::fs::read_to_string("scenes/grease_guide_heat.json").unwrap_or_default();
//!     let mut heat = cagedyn::heat::HeatBalance::new(cagedyn::Model::from_json(&text)?)?;
//!     let steady = heat.settle()?;
//!     for (name, temperature) in heat.names().zip(&steady.temperatures) {
//!         println!("{name}: {temperature:.1} K");
//!     }
//!     Ok(())
//! }
//! ```

mod burst;
mod network;

use crate::error::{Error, Result, Status};
use crate::laws::bearing_torque::Palmgren;
use crate::laws::fluid::walther::Walther;
use crate::model::Model;
use crate::scene::{Heat, Viscosity};
use crate::sim::Sim;
use burst::Burst;
use network::Network;
use std::sync::Arc;

/// Share of the way that temperatures go towards where the network has them: falling viscosity lowers the heat, so a whole step
/// would swing.
const RELAXATION: f64 = 0.6;
/// Largest change of a temperature from one burst to the next, K: the losses of cold oil at speed would lead far beyond.
const LARGEST_STEP: f64 = 20.0;
/// Temperatures that change by less than this from one burst to the next have settled, K.
const SETTLED: f64 = 2e-3;
/// Bursts until they must have.
const MOST_BURSTS: usize = 60;
/// First step of warming up, s, how much longer each is than the one before, and their number.
const FIRST_STEP: f64 = 5.0;
const GROWTH: f64 = 1.8;
const STEPS: usize = 16;
/// Temperatures at which Walther's line of a mineral oil is still one, K.
const OIL_HOLDS: [f64; 2] = [250.0, 450.0];

/// A bearing whose temperatures follow from its motion.
pub struct HeatBalance {
    model: Arc<Model>,
    heat: Heat,
    network: Network,
    burst: Burst,
    /// Temperatures now, K.
    temperatures: Vec<f64>,
    /// Place of the lubricant's lump.
    lubricant: usize,
    /// Friction of the whole bearing: its law, lumps of both rings, share of the first, and the kinematic viscosity of the oil.
    torque: Option<(Palmgren, [usize; 2], f64, Walther)>,
}

/// What a heat balance has come to.
#[derive(Clone, Debug, PartialEq)]
pub struct HeatState {
    /// Temperatures of the lumps, K.
    pub temperatures: Vec<f64>,
    /// Heat that goes into each, W.
    pub heat: Vec<f64>,
    /// Heat of the motion by the name of its power, W.
    pub of_motion: Vec<(String, f64)>,
    /// Heat of the bearing by catalogue values, W.
    pub of_bearing: f64,
    /// Heat that flows through each link, from the first of its names to the second, W.
    pub flows: Vec<f64>,
    /// Viscosity of the lubricant, Pa s.
    pub viscosity: f64,
    /// Mean whirl speed of the cage in the last burst, rad/s; zero where it does not go round.
    pub whirl_speed: f64,
    /// Bursts that were run.
    pub bursts: usize,
}

impl HeatBalance {
    /// The heat balance of a scene that has one.
    ///
    /// # Errors
    /// [`Status::BadScene`] for a scene without `heat`, and where its bearing cannot start.
    pub fn new(model: Model) -> Result<Self> {
        let Some(heat) = model.scene().heat.clone() else {
            return Err(Error::new(
                Status::BadScene,
                "heat: missing; the scene has no heat balance".to_owned(),
            ));
        };
        let scene = model.scene();
        let oil = match scene.lubricant.as_ref().map(|lubricant| &lubricant.viscosity) {
            Some(Viscosity::Walther(w)) => {
                let point = |p: crate::scene::ViscosityPoint| (p.temperature, p.kinematic_viscosity);
                Some(Walther::new(point(w.cold), point(w.hot), 1.0))
            }
            _ => None,
        };
        let torque = heat.bearing_torque.as_ref().zip(oil).and_then(|(torque, oil)| {
            let nodes = [heat.node(&torque.nodes[0])?, heat.node(&torque.nodes[1])?];
            let pitch_diameter = 2.0 * scene.pitch_radius();
            let law = Palmgren { f0: torque.f0, f1: torque.f1, load: torque.load, pitch_diameter };
            Some((law, nodes, torque.inner_share, oil))
        });
        let model = Arc::new(model);
        let sim = Sim::new(model.clone())?;
        let burst = Burst::new(sim, &heat);
        let network = Network::new(&heat, model.scene(), burst.ring_speed());
        let temperatures = heat.nodes.iter().map(|node| node.start.unwrap_or(heat.ambient)).collect();
        let lubricant = heat.node(&heat.lubricant).unwrap_or(0);
        Ok(Self { burst, model, heat, network, temperatures, lubricant, torque })
    }

    /// The scene.
    pub fn model(&self) -> &Arc<Model> {
        &self.model
    }

    /// Names of the lumps.
    pub fn names(&self) -> impl Iterator<Item = &str> {
        self.heat.nodes.iter().map(|node| node.name.as_str())
    }

    /// Names of both ends of the links.
    pub fn links(&self) -> impl Iterator<Item = [&str; 2]> {
        self.heat.links.iter().map(|link| link.between.each_ref().map(String::as_str))
    }

    /// The temperatures at which the bearing stays.
    ///
    /// # Errors
    /// [`Status::BadState`] where temperatures do not settle, or leave the range of the oil; as [`Sim::advance_to`].
    pub fn settle(&mut self) -> Result<HeatState> {
        for bursts in 1..=MOST_BURSTS {
            let heat = self.run_burst()?;
            let wanted = self.network.steady(&heat.into_nodes)?;
            let steps =
                || wanted.iter().zip(&self.temperatures).map(|(wanted, now)| RELAXATION * (wanted - now));
            let change = steps().fold(0.0f64, |change, step| change.max(step.abs()));
            let share = (LARGEST_STEP / change).min(1.0);
            let moved: Vec<f64> =
                self.temperatures.iter().zip(steps()).map(|(now, step)| now + share * step).collect();
            self.temperatures = moved;
            self.check_range()?;
            if change < SETTLED {
                return Ok(self.state(heat, bursts));
            }
        }
        let text = format!("temperatures have not settled to {SETTLED} K after {MOST_BURSTS} bursts");
        Err(Error::new(Status::BadState, text))
    }

    /// Warms up from the present temperatures; tells the time (s) and the state after each step, which are longer and longer.
    ///
    /// # Errors
    /// As [`HeatBalance::settle`], but for settling.
    pub fn warm_up(&mut self, mut tell: impl FnMut(f64, &HeatState)) -> Result<HeatState> {
        let (mut time, mut step) = (0.0, FIRST_STEP);
        let mut last = None;
        for bursts in 1..=STEPS {
            let heat = self.run_burst()?;
            self.network.step(&heat.into_nodes, step, &mut self.temperatures)?;
            self.check_range()?;
            time += step;
            step *= GROWTH;
            let state = self.state(heat, bursts);
            tell(time, &state);
            last = Some(state);
        }
        last.ok_or_else(|| Error::new(Status::BadState, "no step was made".to_owned()))
    }

    fn run_burst(&mut self) -> Result<burst::Heating> {
        let nodes = self.temperatures.len();
        let mut heating = self.burst.run(self.temperatures[self.lubricant], nodes)?;
        if let Some((law, places, inner_share, oil)) = &self.torque {
            let mean = 0.5 * places.iter().map(|place| self.temperatures[*place]).sum::<f64>();
            let speed = self.burst.ring_speed();
            heating.of_bearing = law.torque(speed, oil.viscosity(mean)) * speed.abs();
            let shares = [*inner_share, 1.0 - inner_share];
            for (place, share) in places.iter().zip(shares) {
                heating.into_nodes[*place] += share * heating.of_bearing;
            }
        }
        Ok(heating)
    }

    fn state(&self, heating: burst::Heating, bursts: usize) -> HeatState {
        HeatState {
            temperatures: self.temperatures.clone(),
            flows: self.network.flows(&self.temperatures),
            heat: heating.into_nodes,
            of_motion: heating.of_motion,
            of_bearing: heating.of_bearing,
            viscosity: heating.viscosity,
            whirl_speed: heating.whirl_speed,
            bursts,
        }
    }

    fn check_range(&self) -> Result<()> {
        let temperature = self.temperatures[self.lubricant];
        let [coldest, hottest] = OIL_HOLDS;
        if (coldest..=hottest).contains(&temperature) {
            return Ok(());
        }
        let text = format!(
            "heat: the lubricant came to {temperature:?} K, where Walther's line is none; allowed are {coldest} to {hottest} K"
        );
        Err(Error::new(Status::BadState, text))
    }
}

#[cfg(test)]
mod tests;
