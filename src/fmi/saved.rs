//! All that an instance knows, to come back to it: in memory, and as bytes.

use super::instance::{Exchange, Found, Instance, Mode};
use crate::error::{Error, Result, Status};
use crate::stored::{Reader, Stored};

/// First number of the bytes; changes when their content changes.
const FORMAT: f64 = 1.0;

const MODES: [Mode; 6] =
    [Mode::Instantiated, Mode::Initialization, Mode::Step, Mode::Event, Mode::Continuous, Mode::Terminated];

/// What an instance knew.
#[derive(Clone, Debug, PartialEq)]
pub struct Saved {
    mode: usize,
    start: f64,
    parameters: Vec<f64>,
    /// NaN of inputs that were not set.
    inputs: Vec<f64>,
    exchange: Vec<f64>,
    state: Vec<f64>,
    /// Of the simulation, if there was one.
    snapshot: Vec<f64>,
}

impl Instance {
    /// Keeps what it knows.
    pub fn save(&self) -> Saved {
        let Exchange { time, state, held, since } = &self.exchange;
        let mut exchange = vec![*time, *since];
        held.save(&mut exchange);
        Saved {
            mode: MODES.iter().position(|mode| *mode == self.mode).unwrap_or_default(),
            start: self.start,
            parameters: self.parameters.clone(),
            inputs: self.inputs.iter().map(|value| value.unwrap_or(f64::NAN)).collect(),
            exchange,
            state: state.clone(),
            snapshot: self.sim.as_ref().map_or_else(Vec::new, crate::Sim::save),
        }
    }

    /// Goes back to what another or the same instance of the unit knew; a run then goes on with the same bits.
    ///
    /// # Errors
    /// [`Status::BadSnapshot`] for one of another unit; the instance is then unchanged.
    pub fn restore(&mut self, saved: &Saved) -> Result<()> {
        let bad = || Error::new(Status::BadSnapshot, "FMUState: is not one of this unit".to_owned());
        let sizes =
            [(saved.parameters.len(), self.parameters.len()), (saved.inputs.len(), self.inputs.len())];
        let mode = MODES.get(saved.mode).copied().ok_or_else(bad)?;
        let mut exchange = Exchange::default();
        let [time, since, held @ ..] = &saved.exchange[..] else { return Err(bad()) };
        exchange.held.load(&mut Reader::new(held)).ok_or_else(bad)?;
        (exchange.time, exchange.since, exchange.state) = (*time, *since, saved.state.clone());
        let states = if saved.snapshot.is_empty() { saved.state.len() } else { self.state_count() };
        if sizes.iter().any(|(found, own)| found != own) || saved.state.len() != states {
            return Err(bad());
        }
        let same = self.sim.is_some() && saved.parameters == self.parameters;
        if saved.snapshot.is_empty() {
            self.sim = None;
        } else if let (true, Some(sim)) = (same, &mut self.sim) {
            sim.restore(&saved.snapshot)?;
        } else {
            let mut sim = crate::Sim::new(self.unit.with(&saved.parameters)?)?;
            sim.restore(&saved.snapshot)?;
            self.sim = Some(sim);
        }
        (self.mode, self.start, self.exchange) = (mode, saved.start, exchange);
        self.parameters.clone_from(&saved.parameters);
        self.inputs = saved.inputs.iter().map(|value| Some(*value).filter(|value| !value.is_nan())).collect();
        self.found = Found::default();
        Ok(())
    }
}

impl Saved {
    fn lists(&self) -> [&[f64]; 5] {
        [&self.parameters, &self.inputs, &self.exchange, &self.state, &self.snapshot]
    }

    /// As bytes.
    pub fn to_bytes(&self) -> Vec<u8> {
        let head = [FORMAT, self.mode as f64, self.start];
        let lists = self
            .lists()
            .into_iter()
            .flat_map(|list| std::iter::once(list.len() as f64).chain(list.iter().copied()));
        head.into_iter().chain(lists).flat_map(f64::to_le_bytes).collect()
    }

    /// From what [`Saved::to_bytes`] gave.
    ///
    /// # Errors
    /// [`Status::BadSnapshot`].
    pub fn from_bytes(bytes: &[u8]) -> Result<Self> {
        Self::read(bytes).ok_or_else(|| {
            Error::new(Status::BadSnapshot, "serializedState: is none of this version, or damaged".to_owned())
        })
    }

    fn read(bytes: &[u8]) -> Option<Self> {
        let (chunks, rest) = bytes.as_chunks::<8>();
        let numbers: Vec<f64> = chunks.iter().map(|chunk| f64::from_le_bytes(*chunk)).collect();
        let ([FORMAT, mode, start], mut rest_of) = (*numbers.first_chunk::<3>()?, numbers.get(3..)?) else {
            return None;
        };
        let mut list = || {
            let (length, after) = rest_of.split_first()?;
            let length = (*length >= 0.0 && length.fract() == 0.0).then_some(*length as usize)?;
            let found = after.get(..length)?.to_vec();
            rest_of = after.get(length..)?;
            Some(found)
        };
        let [parameters, inputs, exchange, state, snapshot] = [list()?, list()?, list()?, list()?, list()?];
        let whole = rest.is_empty() && rest_of.is_empty() && mode >= 0.0 && mode.fract() == 0.0;
        let finite = start.is_finite()
            && [&parameters, &exchange, &state].iter().all(|list| list.iter().all(|x| x.is_finite()));
        (whole && finite).then_some(Self {
            mode: mode as usize,
            start,
            parameters,
            inputs,
            exchange,
            state,
            snapshot,
        })
    }
}
