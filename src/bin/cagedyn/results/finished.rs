//! A run that has come to its end, and what is asked of it.

use cagedyn::model::{Channel, ContactForces, HostInputs, LineLoad, POWERS, PartTimes, SpatialContact};
use cagedyn::scene::Record;
use cagedyn::sim::{PowerBalance, RunStatistics};
use cagedyn::{Error, Interval, Model, Recording, Result, Sim, Status};
use std::sync::Arc;

/// Length of the window over which results are averaged and details are shown, s.
const WINDOW: f64 = 0.1;
/// Share of the run that the window covers at most: what comes before is the start.
const LARGEST_WINDOW_SHARE: f64 = 1.0 / 3.0;

/// A run that has ended: by itself, by Ctrl-C or by a failure.
pub struct Run {
    /// Title for tables and pictures.
    pub title: String,
    /// Speed, load and clearances of the model.
    pub facts: String,
    /// The compiled scene.
    pub model: Arc<Model>,
    /// What was recorded.
    pub recording: Recording,
    /// The columns of the recording.
    pub channels: Vec<Channel>,
    /// Wall time of the parts of one force evaluation, s.
    pub parts: PartTimes,
    /// Counts.
    pub statistics: RunStatistics,
    /// Works and energies, if forces are defined at the end.
    pub balance: Option<PowerBalance>,
    /// Forces of all contacts at a record, if they are defined there: that with the largest force on a pocket in the averaging
    /// window, or the last one where there is none.
    pub contacts: Vec<ContactForces>,
    /// The same of a bearing in space.
    pub contacts_in_space: Vec<SpatialContact>,
    /// Place of that record.
    pub contacts_at: usize,
    /// How either raceway loads each roller in space along its length at the end, if forces are defined there; of others nothing.
    pub line_loads: Vec<[Vec<LineLoad>; 2]>,
    /// Works up to the end, J.
    pub works: [f64; POWERS.len()],
    /// Works up to the beginning of the averaging window: time, s, and J.
    pub before: Option<(f64, [f64; POWERS.len()])>,
    /// What speaks against trusting the run.
    pub doubts: Vec<String>,
    /// What happened that a user should know.
    pub remarks: Vec<String>,
    /// What the integration did and why.
    pub report: String,
    /// Simulated time, s.
    pub time: f64,
    /// Wall time of the simulation, s.
    pub wall: f64,
    /// Whether the table was written to its end.
    pub written: bool,
    /// Whether Ctrl-C ended it.
    pub interrupted: bool,
    /// The failure that ended it.
    pub failure: Option<Error>,
}

impl Run {
    /// An error with all doubts, if there are any.
    pub fn trust(&self) -> Result<()> {
        if self.doubts.is_empty() {
            return Ok(());
        }
        let text = format!("{}: not to be trusted: {}", self.title, self.doubts.join("; "));
        Err(Error::new(Status::Untrusted, text))
    }

    /// Values of a channel, if the scene has it.
    pub fn column(&self, name: &str) -> Option<&[f64]> {
        let index = self.channels.iter().position(|c| c.name == name)?;
        Some(self.recording.columns.get(index)?.as_slice())
    }

    /// What a watched channel did between records, one interval per record, if the scene watches it.
    pub fn intervals(&self, name: &str) -> Option<&[Interval]> {
        Some(self.recording.intervals.get(self.watched(name)?)?.as_slice())
    }

    /// What a watched channel did from time `from` (s) on.
    pub fn interval_from(&self, name: &str, from: f64) -> Option<Interval> {
        self.recording.interval(self.watched(name)?, from)
    }

    fn watched(&self, name: &str) -> Option<usize> {
        let all = self.model.channels();
        self.model.watched().iter().position(|i| all[*i].name == name)
    }

    /// Line below the title of a picture of something.
    pub fn subtitle(&self, what: &str) -> String {
        format!("{what}; {}", self.facts)
    }

    /// Start of the averaging window, s: that of the scene, the last 0.1 s, or the last third of a shorter run.
    pub fn window_start(&self) -> f64 {
        window_start(&self.model.scene().record, self.end())
    }

    /// Start of the last `length` seconds, at least zero. A little earlier, so that round-off loses no record.
    pub fn last(&self, length: f64) -> f64 {
        last(length, self.end(), self.interval())
    }

    /// Time between records, s.
    pub fn interval(&self) -> f64 {
        self.model.scene().record.interval
    }

    /// Time of the last record, s.
    pub fn end(&self) -> f64 {
        self.recording.times.last().copied().unwrap_or(0.0)
    }

    /// Which way the elements go round at the end: 1 counter-clockwise, -1 clockwise; none where they stand still.
    pub fn direction(&self) -> Option<f64> {
        let orbit = self.kinematic_orbit_speed();
        (orbit != 0.0).then(|| orbit.signum())
    }

    /// Speed of the elements about the bearing at the end without slip, rad/s.
    pub fn kinematic_orbit_speed(&self) -> f64 {
        let inputs = self.model.inputs_at(self.end(), &HostInputs::default());
        self.model.kinematic_speeds(&inputs)[0]
    }

    /// Number of rollers with a motion of their own.
    pub fn roller_count(&self) -> usize {
        self.model.layout().count
    }
}

/// What is noted of a run while it goes on.
pub struct Notes {
    /// Start of the averaging window, s.
    start: f64,
    /// Columns of the forces on pockets.
    pocket_forces: Vec<usize>,
    /// Time in s of the first record in the window, and works up to it, J.
    pub works: Option<(f64, [f64; POWERS.len()])>,
    /// The largest force on a pocket at a record in the window, N.
    largest: f64,
    /// Place, time in s and state of that record.
    pub strongest: Option<(usize, f64, Vec<f64>)>,
}

impl Notes {
    /// For a run of this model.
    pub fn new(model: &Model) -> Self {
        let (all, record) = (model.channels(), &model.scene().record);
        let of_pocket = |(_, i): &(usize, &usize)| all[**i].name.ends_with("].pocket_force");
        let pocket_forces = model.recorded().iter().enumerate().filter(of_pocket).map(|(place, _)| place);
        Self {
            start: window_start(record, record.duration),
            pocket_forces: pocket_forces.collect(),
            works: None,
            largest: 0.0,
            strongest: None,
        }
    }

    /// To be called after every record.
    pub fn at(&mut self, sim: &Sim, recording: &Recording) {
        if sim.time() < self.start {
            return;
        }
        self.works.get_or_insert_with(|| (sim.time(), sim.works()));
        let last = self.pocket_forces.iter().filter_map(|i| recording.columns.get(*i)?.last());
        let largest = last.fold(0.0, |most: f64, force| most.max(force.abs()));
        if largest > self.largest {
            self.largest = largest;
            self.strongest = Some((recording.times.len() - 1, sim.time(), sim.state().to_vec()));
        }
    }
}

/// Start of the averaging window of a run that is recorded so and ends at time `end`, s.
fn window_start(record: &Record, end: f64) -> f64 {
    // At least two records: what is followed in every step is known from one to the next.
    let usual = WINDOW.min(LARGEST_WINDOW_SHARE * end).max(record.interval);
    last(record.window.map_or(usual, |window| window.min(end)), end, record.interval)
}

fn last(length: f64, end: f64, interval: f64) -> f64 {
    (end - length - 1e-6 * interval).max(0.0)
}
