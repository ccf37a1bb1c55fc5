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

use crate::bodies::HeatBudget;
use crate::error::{Error, Result, Status};
use crate::model::Model;
use crate::scalar::math;
use crate::scene::Heat;
use crate::sim::{RunLimits, Sim};
use burst::{Burst, Heating};
use std::sync::Arc;

/// Share of the way that temperatures go towards where the network has them: falling viscosity lowers the heat, so a whole step
/// would swing.
const RELAXATION: f64 = 0.6;
/// Largest change of a temperature from one burst to the next, K: the losses of cold oil at speed would lead far beyond.
const LARGEST_STEP: f64 = 20.0;
/// Temperatures that change by less than this from one burst to the next have settled, K.
const SETTLED: f64 = 2e-3;
/// Bursts after which changes tell whether they still fall: by less than this factor from one burst to the next they do not.
const FEWEST_BURSTS: usize = 6;
const STILL_FALLING: f64 = 0.8;
/// Means over bursts have settled with a standard error below this, K, after so many of them.
const MEAN_SETTLED: f64 = 0.1;
const FEWEST_OF_MEAN: usize = 8;
/// Bursts until they must have.
const MOST_BURSTS: usize = 80;
/// First step of warming up, s, how much longer each is than the one before, and their number.
const FIRST_STEP: f64 = 5.0;
const GROWTH: f64 = 1.8;
const STEPS: usize = 16;
/// Shortest and longest step that a host may ask for, s.
const SHORTEST: f64 = 1e-6;
const LONGEST: f64 = 1e9;
/// Temperatures that lumps may be set to, K.
const LUMPS_HOLD: [f64; 2] = [150.0, 1000.0];
/// Temperatures at which Walther's line of a mineral oil is still one, K.
const OIL_HOLDS: [f64; 2] = [250.0, 450.0];

/// A bearing whose temperatures follow from its motion.
pub struct HeatBalance {
    heat: Heat,
    budget: HeatBudget,
    burst: Burst,
    /// Temperatures now, K.
    temperatures: Vec<f64>,
    last: Option<HeatState>,
    limits: RunLimits,
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
    /// Heat of the motion that warms no lump, as no source names it or only a share of it, W.
    pub in_no_lump: Vec<(String, f64)>,
    /// Heat of the bearing by catalogue values, W.
    pub of_bearing: f64,
    /// Heat that flows through each link, from the first of its names to the second, W.
    pub flows: Vec<f64>,
    /// Heat that oil carries away which flows through lumps, W.
    pub carried: f64,
    /// Viscosity of the lubricant, Pa s.
    pub viscosity: f64,
    /// Radial clearance of a roller bearing, m.
    pub clearance: Option<f64>,
    /// Mean whirl speed of the cage in the last burst, rad/s; zero where it does not go round.
    pub whirl_speed: f64,
    /// Largest standard error of a temperature, K; zero where powers do not scatter.
    pub scatter: f64,
    /// Bursts that were run.
    pub bursts: usize,
}

/// Means of the temperatures that bursts lead to.
#[derive(Default)]
struct Means {
    count: usize,
    mean: Vec<f64>,
    /// Sums of squared differences from the mean, K^2.
    squares: Vec<f64>,
}

impl Means {
    /// Takes what one burst leads to; the share with which it counts in the mean.
    fn take(&mut self, wanted: &[f64]) -> f64 {
        self.mean.resize(wanted.len(), 0.0);
        self.squares.resize(wanted.len(), 0.0);
        self.count += 1;
        let share = 1.0 / self.count as f64;
        for ((mean, square), wanted) in self.mean.iter_mut().zip(&mut self.squares).zip(wanted) {
            let off = wanted - *mean;
            *mean += share * off;
            *square += off * (wanted - *mean);
        }
        share
    }

    /// Largest standard error, K.
    fn standard_error(&self) -> f64 {
        if self.count < FEWEST_OF_MEAN {
            return f64::INFINITY;
        }
        let largest = self.squares.iter().fold(0.0f64, |largest, square| largest.max(*square));
        (largest / (self.count * (self.count - 1)) as f64).sqrt()
    }
}

impl HeatBalance {
    /// The heat balance of a scene that has one.
    ///
    /// # Errors
    /// [`Status::BadScene`] for a scene without `heat`, and where its bearing cannot start.
    pub fn new(model: impl Into<Arc<Model>>) -> Result<Self> {
        let model = model.into();
        let missing =
            || Error::new(Status::BadScene, "heat: missing; the scene has no heat balance".to_owned());
        let heat = model.scene().heat.clone().ok_or_else(missing)?;
        let sim = Sim::new(model)?;
        let burst = Burst::new(sim);
        let budget = HeatBudget::of(burst.model().scene(), burst.ring_speed()).ok_or_else(missing)?;
        let temperatures = budget.start.clone();
        Ok(Self { temperatures, burst, heat, budget, last: None, limits: RunLimits::default() })
    }

    /// What the last burst of motion came to; `None` before the first.
    pub fn last(&self) -> Option<&HeatState> {
        self.last.as_ref()
    }

    /// What ends a search from outside, and tells how far it is.
    pub fn limits(&self) -> &RunLimits {
        &self.limits
    }

    /// Puts other limits in their place.
    pub fn set_limits(&mut self, limits: RunLimits) {
        self.limits = limits;
    }

    /// The bearing at the temperatures of the last burst.
    pub fn model(&self) -> &Arc<Model> {
        self.burst.model()
    }

    /// Names of the lumps.
    pub fn names(&self) -> impl Iterator<Item = &str> {
        self.heat.nodes.iter().map(|node| node.name.as_str())
    }

    /// Names of the powers of the motion that warm lumps, in the order of [`HeatState::of_motion`].
    pub fn sources(&self) -> impl Iterator<Item = &'static str> {
        let sources = self.budget.sources.as_slice();
        let first = move |i: usize| !sources[..i].iter().any(|source| source.0 == sources[i].0);
        (0..sources.len()).filter(move |i| first(*i)).map(move |i| sources[i].0.name())
    }

    /// Temperatures of the lumps now, K.
    pub fn temperatures(&self) -> &[f64] {
        &self.temperatures
    }

    /// Sets the temperatures of all lumps, K, from 150 to 1000: wide enough for any bearing, so that a value in degrees Celsius is seen.
    ///
    /// # Errors
    /// [`Status::WrongSize`], and [`Status::BadValue`] for a temperature out of this range.
    pub fn set_temperatures(&mut self, temperatures: &[f64]) -> Result<()> {
        let count = self.temperatures.len();
        if temperatures.len() != count {
            let text = format!("temperatures: length {}, must be {count}", temperatures.len());
            return Err(Error::new(Status::WrongSize, text));
        }
        let [coldest, hottest] = LUMPS_HOLD;
        for (name, temperature) in self.names().zip(temperatures) {
            if !(coldest..=hottest).contains(temperature) {
                let text =
                    format!("temperatures: {temperature} K of {name} is not from {coldest} to {hottest} K");
                return Err(Error::new(Status::BadValue, text));
            }
        }
        self.temperatures.copy_from_slice(temperatures);
        Ok(())
    }

    /// Names of both ends of the links.
    pub fn links(&self) -> impl Iterator<Item = [&str; 2]> {
        self.heat.links.iter().map(|link| link.between.each_ref().map(String::as_str))
    }

    /// The temperatures at which the bearing stays. Where powers scatter from burst to burst, as those of rattling rollers do, they are
    /// means over bursts, with their standard error in [`HeatState::scatter`].
    ///
    /// # Errors
    /// [`Status::BadState`] where temperatures do not settle, or leave the range of the oil; as [`Sim::advance_to`]. Temperatures
    /// are those before then, and the motion starts anew. With [`Status::Cancelled`] and [`Status::OutOfTime`] temperatures are those of
    /// the last whole burst, [`HeatBalance::last`] has what it came to, and another call goes on from there.
    pub fn settle(&mut self) -> Result<HeatState> {
        self.or_back(Self::find_steady)
    }

    /// What `moves` the temperatures; where that fails, nothing has moved. What a host ends is kept.
    fn or_back<T>(&mut self, moves: impl FnOnce(&mut Self) -> Result<T>) -> Result<T> {
        let before = (self.temperatures.clone(), self.last.clone());
        let moved = self.limits.clone().searching(|| moves(self));
        if moved.as_ref().is_err_and(|e| !e.is_stop()) {
            (self.temperatures, self.last) = before;
            self.burst.restart();
        }
        moved
    }

    fn find_steady(&mut self) -> Result<HeatState> {
        let mut before = f64::INFINITY;
        let mut means: Option<Means> = None;
        for bursts in 1..=MOST_BURSTS {
            let heat = self.run_burst()?;
            let wanted = self.budget.network.steady(&heat.into_nodes, self.viscosity())?;
            let relaxation = match &mut means {
                Some(means) => means.take(&wanted),
                None => RELAXATION,
            };
            let steps =
                || wanted.iter().zip(&self.temperatures).map(|(wanted, now)| relaxation * (wanted - now));
            let change = steps().fold(0.0f64, |change, step| change.max(step.abs()));
            let share = (LARGEST_STEP / change).min(1.0);
            let moved: Vec<f64> =
                self.temperatures.iter().zip(steps()).map(|(now, step)| now + share * step).collect();
            self.temperatures = moved;
            self.check_range()?;
            let scatter = means.as_ref().map_or(0.0, Means::standard_error);
            let state = self.keep(heat, bursts, scatter);
            if change < SETTLED && means.is_none() || means.is_some() && scatter < MEAN_SETTLED {
                self.limits.tell(1.0, bursts);
                return Ok(state);
            }
            let way = |now: f64| math::ln(LARGEST_STEP / now) / math::ln(LARGEST_STEP / SETTLED);
            let square = |x: f64| x * x;
            self.limits
                .tell(if means.is_none() { way(change) } else { square(MEAN_SETTLED / scatter) }, bursts);
            // Changes that no longer get smaller are scatter.
            if means.is_none() && bursts >= FEWEST_BURSTS && share == 1.0 && change > STILL_FALLING * before {
                means = Some(Means::default());
            }
            before = change;
        }
        let text = format!("temperatures have not settled to {MEAN_SETTLED} K after {MOST_BURSTS} bursts");
        Err(Error::new(Status::BadState, text))
    }

    /// Warms up from the present temperatures; tells the time (s) and the state after each step, which are longer and longer.
    ///
    /// # Errors
    /// As [`HeatBalance::settle`], but for settling. What was told before a limit stays.
    pub fn warm_up(&mut self, mut tell: impl FnMut(f64, &HeatState)) -> Result<HeatState> {
        self.or_back(|heat| {
            let (mut time, mut step) = (0.0, FIRST_STEP);
            let mut last = None;
            for bursts in 1..=STEPS {
                let state = heat.warm(step, bursts)?;
                heat.limits.tell(bursts as f64 / STEPS as f64, bursts);
                time += step;
                step *= GROWTH;
                tell(time, &state);
                last = Some(state);
            }
            last.ok_or_else(|| Error::new(Status::BadState, "no step was made".to_owned()))
        })
    }

    /// Warms up for `duration` (s, from 1e-6 to 1e9) from the present temperatures, with the heat of one burst of motion: the longer, the more
    /// roughly. At a speed that does not change, each step may be nearly twice as long as the one before.
    ///
    /// # Errors
    /// [`Status::BadValue`] for a duration out of this range; as [`HeatBalance::settle`], but for settling.
    pub fn step(&mut self, duration: f64) -> Result<HeatState> {
        if !(SHORTEST..=LONGEST).contains(&duration) {
            let text = format!("duration: {duration} s is not from {SHORTEST} to {LONGEST} s");
            return Err(Error::new(Status::BadValue, text));
        }
        self.or_back(|heat| heat.warm(duration, 1))
    }

    fn warm(&mut self, duration: f64, bursts: usize) -> Result<HeatState> {
        let heat = self.run_burst()?;
        let viscosity = self.viscosity();
        self.budget.network.step(&heat.into_nodes, viscosity, duration, &mut self.temperatures)?;
        self.check_range()?;
        Ok(self.keep(heat, bursts, 0.0))
    }

    /// Kinematic viscosity of the lubricant, m^2/s.
    fn viscosity(&self) -> f64 {
        self.budget.viscosity(|i| self.temperatures[i])
    }

    fn run_burst(&mut self) -> Result<Heating> {
        let mut heating = self.burst.run(&self.temperatures, &self.budget.sources, &self.limits)?;
        if let Some(friction) = &self.budget.friction {
            let into = &mut heating.into_nodes;
            heating.of_bearing = friction.heat(
                self.burst.ring_speed(),
                |i| self.temperatures[i],
                |node, heat| into[node] += heat,
            );
        }
        Ok(heating)
    }

    /// Keeps what a burst came to.
    fn keep(&mut self, heating: Heating, bursts: usize, scatter: f64) -> HeatState {
        let state = HeatState {
            temperatures: self.temperatures.clone(),
            flows: self.budget.network.flows(&self.temperatures, self.viscosity()),
            carried: self.budget.network.carried(&self.temperatures),
            heat: heating.into_nodes,
            of_motion: heating.of_motion,
            in_no_lump: heating.in_no_lump,
            of_bearing: heating.of_bearing,
            viscosity: heating.viscosity,
            clearance: heating.clearance,
            whirl_speed: heating.whirl_speed,
            scatter,
            bursts,
        };
        self.last.insert(state).clone()
    }

    fn check_range(&self) -> Result<()> {
        let temperature = self.temperatures[self.budget.lubricant];
        let [coldest, hottest] = OIL_HOLDS;
        if (coldest..=hottest).contains(&temperature) {
            return Ok(());
        }
        let text = format!(
            "heat: the lubricant came to {temperature:.1} K; Walther's equation holds from {coldest} to {hottest} K. Does enough conduct to \
             heat.ambient?"
        );
        Err(Error::new(Status::BadState, text))
    }
}

#[cfg(test)]
mod tests;
