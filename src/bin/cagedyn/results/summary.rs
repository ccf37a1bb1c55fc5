//! Results of a run in numbers, as written to `summary.json`.

mod found;

use crate::results::files::{SERIES, UNFINISHED};
use crate::results::finished::Run;
use crate::results::lines::{Lines, lines};
use crate::results::map::{as_map, from_map};
use crate::results::sectors::{self, Sectors};
use crate::starts::Starts;
use cagedyn::sim::LoadZone;
use cagedyn::{CageMotion, MotionOfCage, Spread, WhirlSummary};
use found::{
    balance, cage_turns, extremes, integration, key_statistics, max_roller_slip, pocket_forces, power_loss,
    window,
};
use serde::{Deserialize, Serialize};
use std::borrow::Cow;
use std::collections::BTreeMap;
use std::f64::consts::TAU;
use std::path::Path;

/// A name or unit: one of the program, or one that was read.
type Name = Cow<'static, str>;

/// A run with fewer turns of the cage says so beside every mean: with each turn loads and deviations of the bearing repeat.
pub const FEW_TURNS: f64 = 3.0;

/// All results. The names of the fields are those in the file.
#[derive(Serialize, Deserialize)]
pub struct Summary {
    /// Title.
    pub title: String,
    /// Scene file.
    pub scene: String,
    /// Name of the case, in a case set.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub case: Option<String>,
    /// Values that replaced those of the scene, as `path=value`.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub set: Vec<String>,
    /// Version of the library.
    pub version: Name,
    /// Values of the scene that are legal and unlikely.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub warnings: Vec<String>,
    /// Whether the run came to its end.
    pub complete: bool,
    /// Whether Ctrl-C or another signal ended it.
    pub interrupted: bool,
    /// Why the run failed.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub error: Option<String>,
    /// Whether the run kept what its preset promises.
    pub trusted: bool,
    /// What speaks against that.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub doubts: Vec<String>,
    /// What happened that a user should know, though the laws hold.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub remarks: Vec<String>,
    /// Simulated time, s.
    pub simulated_time_s: f64,
    /// Wall time of the simulation, s.
    pub wall_time_s: f64,
    /// Simulated time over wall time.
    pub simulated_over_wall: f64,
    /// Number of states.
    pub states: States,
    /// Steps.
    pub integration: Integration,
    /// Where the energy went.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub power_balance: Option<Balance>,
    /// Where the power goes, mean over the window.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub power_loss: Option<PowerLoss>,
    /// Turns of the cage in the whole run.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub cage_turns: Option<f64>,
    /// Averaging window.
    pub window: Window,
    /// Rotation frequency of the cage in the window, Hz.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub cage_frequency_hz: Option<f64>,
    /// Motion of the cage centre about the guide centre in the window.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub whirl: Option<Whirl>,
    /// The same of the axis of a cage in space about that of the bearing: of the point that is one pitch radius from the centre.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub wobble: Option<Whirl>,
    /// Spectrum of the height of the cage centre at frequencies of the bearing.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub spectrum: Option<Lines>,
    /// Motions from other starts, where they were asked for.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub starts: Option<Starts>,
    /// Largest slip of any roller in the window.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub max_roller_slip: Option<RollerSlip>,
    /// Forces between rollers and pockets in the window.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub pocket_forces: Option<PocketForces>,
    /// Where rollers carry load.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub load_zone: Option<LoadZone>,
    /// What elements feel over the angle of their orbit.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub over_orbit: Option<Sectors>,
    /// Extremes, means and integrals of the watched channels over the window, from every step.
    #[serde(
        default,
        serialize_with = "as_map",
        deserialize_with = "from_map",
        skip_serializing_if = "Vec::is_empty"
    )]
    pub extremes: Vec<(String, Extremes)>,
    /// Statistics over the window by channel.
    #[serde(serialize_with = "as_map", deserialize_with = "from_map")]
    pub statistics: Vec<(String, Statistics)>,
    /// Files written, relative to the folder of this one.
    pub files: Vec<String>,
}

/// Number of states.
#[derive(Serialize, Deserialize)]
pub struct States {
    /// Positions.
    pub positions: usize,
    /// Velocities.
    pub velocities: usize,
}

/// Counts of the integration.
#[derive(Serialize, Deserialize)]
pub struct Integration {
    /// How accurate, where the method leaves it open.
    pub preset: Name,
    /// Method, as in the scene.
    pub method: Name,
    /// What the integration did and why.
    pub report: String,
    /// Accepted steps.
    pub steps: u64,
    /// Steps rejected by the error estimate.
    pub rejected: u64,
    /// Steps taken back because they missed energy.
    pub undone: u64,
    /// Steps abandoned because forces were undefined.
    pub faults: u64,
    /// The same by cause; those that never occurred are left out.
    #[serde(serialize_with = "as_map", deserialize_with = "from_map")]
    pub faults_by_cause: Vec<(Name, u64)>,
    /// Root mean square approach speed of the loaded raceway contacts, m/s.
    pub raceway_vibration_rms: f64,
    /// Jumps and kinks of inputs.
    pub events: u64,
    /// Smallest step, s.
    pub smallest_step_s: f64,
    /// Largest step, s.
    pub largest_step_s: f64,
    /// Force evaluations.
    pub evaluations: u64,
    /// Derivatives of the forces, each with one of the evaluations.
    pub jacobians: u64,
    /// Share of the wall time by part of the force evaluation; the rest is derivatives, integration and records.
    #[serde(serialize_with = "as_map", deserialize_with = "from_map")]
    pub time_shares: Vec<(String, f64)>,
    /// Evaluations of each law in them; those that never acted are left out.
    #[serde(serialize_with = "as_map", deserialize_with = "from_map")]
    pub law_evaluations: Vec<(Name, u64)>,
}

/// Work and energy of the run, J.
#[derive(Serialize, Deserialize)]
pub struct Balance {
    /// From this time, s.
    pub from_s: f64,
    /// To this time, s.
    pub to_s: f64,
    /// Work, J; positive where it goes into the bearing. What is zero is left out.
    #[serde(serialize_with = "as_map", deserialize_with = "from_map")]
    pub work_j: Vec<(Name, f64)>,
    /// Gain of kinetic energy, J.
    pub kinetic_energy_gain_j: f64,
    /// Gain of elastic energy, J.
    pub elastic_energy_gain_j: f64,
    /// Gain of potential energy, J.
    pub potential_energy_gain_j: f64,
    /// Works less gains, J.
    pub residual_j: f64,
    /// The same as a share of the energy that passed through.
    pub relative_residual: f64,
}

/// Power that leaves the motion, mean over the window, W.
#[derive(Serialize, Deserialize)]
pub struct PowerLoss {
    /// All of it.
    pub total_w: f64,
    /// By source. What is zero, and what gives power, is left out.
    #[serde(serialize_with = "as_map", deserialize_with = "from_map")]
    pub by_source_w: Vec<(Name, f64)>,
    /// Turns of the cage in the run, where they are too few for a mean to say much.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub few_cage_turns: Option<f64>,
}

/// Averaging window.
#[derive(Serialize, Deserialize)]
pub struct Window {
    /// First record, s.
    pub from_s: f64,
    /// Last record, s.
    pub to_s: f64,
    /// Number of records.
    pub records: usize,
    /// Turns of the cage from the first to the last of them.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub cage_turns: Option<f64>,
}

/// Motion of the cage centre about the guide centre.
#[derive(Serialize, Deserialize)]
pub struct Whirl {
    /// Class of the motion.
    pub motion: CageMotion,
    /// Mean whirl speed, rad/s; positive counter-clockwise. None where the centre stays within 0.1 % of the clearance of that
    /// of the guide; records so close to it count in none of these three.
    pub mean_speed_rad_per_s: Option<f64>,
    /// Its fifth percentile, rad/s.
    pub p05_speed_rad_per_s: Option<f64>,
    /// Its 95th percentile, rad/s.
    pub p95_speed_rad_per_s: Option<f64>,
    /// Mean distance of the cage centre from the guide centre, m.
    pub mean_radius_m: f64,
    /// Net turns about the guide centre, positive counter-clockwise.
    pub turns: f64,
    /// Standard deviation of the speed of the cage centre over its mean; none where it stays in its place.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub velocity_deviation: Option<f64>,
    /// Share of the time in each class, stretch by stretch; none of a window with too few records.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub shares: Option<BTreeMap<String, f64>>,
    /// Whether a whirl comes and goes.
    #[serde(default)]
    pub intermittent: bool,
    /// Time from which on the whirl speed stays within 15 % of its mean, s; none if it never does.
    pub settling_time_s: Option<f64>,
    /// Turns of the cage in the run, where they are too few for a mean to say much.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub few_cage_turns: Option<f64>,
}

/// The largest slip of any roller.
#[derive(Serialize, Deserialize)]
pub struct RollerSlip {
    /// Slip: 1 - spin speed over the spin without slip.
    pub value: f64,
    /// Roller.
    pub roller: usize,
    /// Time, s.
    pub time_s: f64,
}

/// Circumferential forces of all elements on the cage, from every step and not from records.
#[derive(Serialize, Deserialize)]
pub struct PocketForces {
    /// Sum of those that drive the cage, mean over time, N.
    pub driving_n: f64,
    /// Sum of those that brake the cage, mean over time, N; positive.
    pub braking_n: f64,
    /// Largest single force on the cage, driving or braking, N.
    pub largest_n: f64,
    /// Turns of the cage in the run, where they are too few for a mean to say much.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub few_cage_turns: Option<f64>,
}

/// Extremes, mean and integral of one watched channel.
#[derive(Serialize, Deserialize)]
pub struct Extremes {
    /// Unit; "1" for ratios.
    pub unit: Name,
    /// Smallest value in any step.
    pub min: f64,
    /// Largest value in any step.
    pub max: f64,
    /// Mean over time.
    pub mean: f64,
    /// Integral over time, in `unit` times s.
    pub integral: f64,
    /// Turns of the cage in the run, where they are too few for a mean to say much.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub few_cage_turns: Option<f64>,
}

/// Statistics of one channel.
#[derive(Serialize, Deserialize)]
pub struct Statistics {
    /// Unit; "1" for ratios.
    pub unit: Name,
    /// Turns of the cage in the run, where they are too few for a mean to say much.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub few_cage_turns: Option<f64>,
    /// Mean, deviation and percentiles.
    #[serde(flatten)]
    pub spread: Spread,
}

impl Summary {
    /// Results of a run; `scene` is the file it came from.
    pub fn new(run: &Run, scene: &Path, case: Option<&str>, set: Vec<String>) -> Self {
        let from = run.window_start();
        let moved = MotionOfCage::of(&run.model, &run.recording, from);
        let (whirl, wobble) = moved.map_or((None, None), |moved| (Some(moved.whirl), moved.wobble));
        let speed = whirl.as_ref().and_then(|whirl| whirl.speed);
        let cage_turns = cage_turns(run, 0.0);
        let few = cage_turns.filter(|turns| *turns < FEW_TURNS);
        let statistics = key_statistics(&run.channels, &run.recording, (from, few), speed);
        let mean = |name: &str| statistics.iter().find(|(n, _)| n == name).map(|(_, s)| s.spread.mean);
        let layout = run.model.layout();
        let (over_orbit, load_zone) = sectors::of(run, from);
        let cage_frequency_hz = mean("cage.speed").map(|speed| speed.abs() / TAU);
        let [whirl, wobble] = [whirl, wobble].map(|way| way.map(|way| Whirl::new(way, few)));
        let spectrum = lines(run, cage_frequency_hz, whirl.as_ref().and_then(Whirl::frequency));
        Self {
            title: run.title.clone(),
            scene: scene.display().to_string(),
            case: case.map(str::to_owned),
            set,
            version: env!("CARGO_PKG_VERSION").into(),
            warnings: run.model.scene().warnings(),
            complete: !run.interrupted && run.failure.is_none(),
            interrupted: run.interrupted,
            error: run.failure.as_ref().map(|e| e.message.clone()),
            trusted: run.doubts.is_empty(),
            doubts: run.doubts.clone(),
            remarks: run.remarks.clone(),
            simulated_time_s: run.time,
            wall_time_s: run.wall,
            simulated_over_wall: if run.wall > 0.0 { run.time / run.wall } else { 0.0 },
            states: States { positions: layout.positions(), velocities: layout.velocities() },
            integration: integration(run),
            power_balance: run.balance.as_ref().map(balance),
            power_loss: power_loss(run, few),
            cage_turns,
            window: window(run, from),
            cage_frequency_hz,
            whirl,
            wobble,
            spectrum,
            starts: None,
            max_roller_slip: max_roller_slip(run, from),
            pocket_forces: pocket_forces(run, (from, few)),
            load_zone,
            over_orbit: over_orbit.map(|sectors| Sectors { few_cage_turns: few, ..sectors }),
            extremes: extremes(run, (from, few)),
            statistics,
            files: vec![if run.written { SERIES } else { UNFINISHED }.to_owned()],
        }
    }

    /// Turns of the cage in the run where they are few, in words.
    pub fn few_turns(&self) -> Option<String> {
        self.cage_turns.filter(|turns| *turns < FEW_TURNS).map(few_turns)
    }

    /// Statistics of a channel, if it has any.
    pub fn of(&self, channel: &str) -> Option<&Statistics> {
        self.statistics.iter().find(|(name, _)| name == channel).map(|(_, s)| s)
    }
}

/// What stands beside a mean over a run of so few turns of the cage.
pub fn few_turns(turns: f64) -> String {
    format!("only {turns:.1} turns of the cage")
}

/// Key of a class.
fn key_of(motion: CageMotion) -> String {
    motion.name().replace(' ', "_")
}

impl Whirl {
    /// Turns of the cage centre per second of a whirl, Hz; none of another motion.
    pub fn frequency(&self) -> Option<f64> {
        Some(self.mean_speed_rad_per_s.filter(|_| self.motion.is_whirl())?.abs() / TAU)
    }

    /// Share of the time in a class.
    pub fn share(&self, motion: CageMotion) -> Option<f64> {
        let shares = self.shares.as_ref()?;
        Some(shares.get(&key_of(motion)).copied().unwrap_or(0.0))
    }

    fn new(w: WhirlSummary, few_cage_turns: Option<f64>) -> Self {
        Self {
            motion: w.motion,
            mean_speed_rad_per_s: w.speed.map(|speed| speed.mean),
            p05_speed_rad_per_s: w.speed.map(|speed| speed.p05),
            p95_speed_rad_per_s: w.speed.map(|speed| speed.p95),
            mean_radius_m: w.radius,
            turns: w.turns,
            velocity_deviation: w.velocity_deviation,
            shares: w.shares.map(|shares| {
                let names = CageMotion::ALL.map(key_of);
                names.into_iter().zip(shares).filter(|(_, share)| *share > 0.0).collect()
            }),
            intermittent: w.intermittent,
            settling_time_s: w.settling_time,
            few_cage_turns,
        }
    }
}
