//! The same scene from slightly different starts: which kinds of motion there are, and how often. Where a cage has more than
//! one, a single start says nothing about the bearing.

use crate::terminal;
use crate::workers;
use cagedyn::scene::Record;
use cagedyn::{CageMotion, Error, Model, MotionOfCage, Recording, Result, Scene, Sim, Status, WhirlSummary};
use serde::{Deserialize, Serialize};
use std::f64::consts::{SQRT_2, TAU};
use std::sync::Arc;

/// Part of a turn between the directions of one start and the next.
const GOLDEN_SECTION: f64 = 0.618_033_988_749_895;

/// Motions from all starts.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct Starts {
    /// Number of starts that were asked for: the scene's own, and others around it.
    pub asked: usize,
    /// Number of those that were run.
    pub count: usize,
    /// How far from it the cage centre of the others is, m, and by which share at most their cage speed differs.
    #[serde(flatten)]
    pub apart: Apart,
    /// Kinds of motion, the most frequent first.
    pub motions: Vec<Kind>,
    /// Starts from which the run failed, and why the first of them did.
    pub failed: usize,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub failure: Option<String>,
}

/// How far the other starts are from that of the scene.
#[derive(Clone, Copy, Debug, Serialize, Deserialize)]
pub struct Apart {
    /// Distance of the cage centre, m, in directions that spread evenly.
    pub shift_m: f64,
    /// Largest change of the cage speed as a share of it; the changes spread evenly.
    pub spin_share: f64,
}

/// One kind of motion.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct Kind {
    /// Class of the motion.
    pub motion: CageMotion,
    /// Number of starts that lead to it.
    pub count: usize,
    /// The same as a share of all.
    pub share: f64,
    /// Smallest and largest of their mean whirl speeds, rad/s, if they have any.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub mean_speed_rad_per_s: Option<[f64; 2]>,
}

impl Starts {
    /// "backward whirl 11 of 12 (-1960 to -1950 rad/s), resting 1 of 12".
    pub fn in_words(&self) -> String {
        let speeds = |kind: &Kind| match kind.mean_speed_rad_per_s.filter(|_| kind.motion.is_whirl()) {
            Some([low, high]) => format!(" ({low:.0} to {high:.0} rad/s)"),
            None => String::new(),
        };
        let of =
            |kind: &Kind| format!("{} {} of {}{}", kind.motion.name(), kind.count, self.count, speeds(kind));
        let mut list: Vec<String> = self.motions.iter().map(of).collect();
        if self.failed > 0 {
            let why = self.failure.as_deref().unwrap_or("too few records");
            list.push(format!("failed {} of {} ({why})", self.failed, self.count));
        }
        let text = list.join(", ");
        if self.count < self.asked {
            format!("{text}; interrupted, {} starts were asked for", self.asked)
        } else {
            text
        }
    }

    /// Share of starts that lead to a motion.
    pub fn share(&self, motion: CageMotion) -> f64 {
        self.motions.iter().find(|kind| kind.motion == motion).map_or(0.0, |kind| kind.share)
    }
}

/// Whether other starts of this simulation can be so far apart.
///
/// # Errors
/// [`Status::BadScene`] without a cage, or without room for it.
pub fn check(sim: &mut Sim, apart: Apart) -> Result<()> {
    let refused = |text: String| Err(Error::new(Status::BadScene, text));
    let model = sim.model().clone();
    if model.scene().cage.is_none() {
        return refused("--starts: there is no cage whose motion could differ".to_owned());
    }
    let radius = sim.channels().iter().position(|channel| channel.name == "cage.whirl_radius");
    let radius = radius.map_or(Ok(0.0), |place| sim.output(place))?;
    match model.guide_clearance().filter(|clearance| radius + apart.shift_m >= *clearance) {
        Some(clearance) => refused(format!(
            "--start-shift: {:?} m leaves no room in the guide clearance of {clearance:?} m",
            apart.shift_m
        )),
        None => Ok(()),
    }
}

/// Runs a model from `count` starts on so many threads. The first is the scene's own. `from` is the start of the averaging
/// window, s; `limit` the wall time of each run, s.
///
/// # Errors
/// As [`Model::new`].
pub fn try_starts(
    model: &Model,
    count: usize,
    apart: Apart,
    from: f64,
    limit: f64,
    threads: usize,
) -> Result<Starts> {
    // The same bearing, of which only the motion of the cage is recorded.
    let known = model.channels();
    let channels =
        MotionOfCage::CHANNELS.iter().filter(|name| known.iter().any(|channel| channel.name == **name));
    let channels = Some(channels.map(|name| (*name).to_owned()).collect());
    let scene = model.scene().clone();
    let record = Record { channels, extremes: Some(Vec::new()), ..scene.record.clone() };
    let model = &Arc::new(Model::new(Scene { record, ..scene })?);
    let work = |k| {
        // What was cut short is no motion.
        let motion = || (!terminal::stop_requested()).then(|| motion_from(model, k, apart, from, limit));
        motion().filter(|_| !terminal::stop_requested())
    };
    let (starts, mut all) = ((0..count).collect::<Vec<_>>(), Vec::new());
    workers::share(&starts, threads, work, |k, motion| {
        all.push((k, motion));
        true
    });
    // In the order of the starts, whichever thread ran them.
    all.sort_by_key(|(k, _)| *k);
    let failures = all.iter().filter(|(_, found)| !matches!(found, Ok(Some(_))));
    let failure = all.iter().find_map(|(_, found)| Some(found.as_ref().err()?.message.clone()));
    let failed = failures.count();
    let whirls: Vec<&WhirlSummary> =
        all.iter().filter_map(|(_, found)| found.as_ref().ok()?.as_ref()).collect();
    let motions = kinds(&whirls, all.len());
    Ok(Starts { asked: count, count: all.len(), apart, motions, failed, failure })
}

/// The kinds among the motions from `count` starts, the most frequent first.
fn kinds(whirls: &[&WhirlSummary], count: usize) -> Vec<Kind> {
    let of = |motion: CageMotion| {
        let same: Vec<_> = whirls.iter().filter(|whirl| whirl.motion == motion).collect();
        let speeds = || same.iter().filter_map(|whirl| Some(whirl.speed?.mean));
        let range = [speeds().reduce(f64::min), speeds().reduce(f64::max)];
        let kind = Kind {
            motion,
            count: same.len(),
            share: same.len() as f64 / count as f64,
            mean_speed_rad_per_s: range[0].zip(range[1]).map(|(low, high)| [low, high]),
        };
        (kind.count > 0).then_some(kind)
    };
    let mut kinds: Vec<Kind> = CageMotion::ALL.into_iter().filter_map(of).collect();
    kinds.sort_by_key(|kind| std::cmp::Reverse(kind.count));
    kinds
}

/// Motion from start `k` in the window from time `from` (s) on; `None` if the window holds too few records.
fn motion_from(
    model: &Arc<Model>,
    k: usize,
    apart: Apart,
    from: f64,
    limit: f64,
) -> Result<Option<WhirlSummary>> {
    let mut sim = Sim::new(model.clone())?;
    sim.set_wall_time_limit(limit)?;
    if k > 0 {
        let mut state = sim.state().to_vec();
        // The fractions of two irrational numbers spread over a square without pattern.
        let [angle, spin] = [GOLDEN_SECTION, SQRT_2].map(|part| (part * k as f64).fract());
        for (x, info) in state.iter_mut().zip(model.state_infos()) {
            match info.name.as_str() {
                "cage.y" => *x += apart.shift_m * (TAU * angle).cos(),
                "cage.z" => *x += apart.shift_m * (TAU * angle).sin(),
                "cage.speed" => *x *= 1.0 + apart.spin_share * (2.0 * spin - 1.0),
                _ => {}
            }
        }
        sim.set_state(0.0, &state)?;
    }
    let Record { duration, interval, .. } = model.scene().record;
    let mut recording = Recording::default();
    recording.run(&mut sim, duration, interval, |_, _| !terminal::stop_requested())?;
    Ok(MotionOfCage::of(model, &recording, from).map(|moved| moved.whirl))
}
