//! Runs of the NU2310 in the plane and in space on all cores, and what is read off them.

use cagedyn::model::POWERS;
use cagedyn::{Error, Model, Recording, Result, Scene, Sim, Status};
use cagedyn_studies::page::on_all_cores;
use std::f64::consts::{PI, TAU};
use std::sync::Arc;

/// Length of a run, what of it counts, and time between records, s.
const UNTIL: f64 = 0.3;
const FROM: f64 = 0.2;
const INTERVAL: f64 = 2.5e-4;
/// Starts of every scene, and how far the centre of the cage is from that of the scene's own, m.
pub const STARTS: u32 = 4;
const APART: f64 = 20e-6;
/// Half of the guide clearance, m; the same in both scenes.
const CLEARANCE: f64 = 0.5 * 0.445e-3;
/// What is recorded of every roller.
const OF_ROLLER: [&str; 7] =
    ["slip", "skew", "tilt", "pocket_force", "pocket_position", "inner_force", "orbit_angle"];
/// What stands for the bottom, rad.
const BOTTOM: f64 = 1.5 * PI;
/// Powers of contacts, which are losses.
const CONTACTS: [&str; 2] = ["friction", "resistance"];

/// What came of a run.
#[derive(Clone, Debug)]
pub struct Found {
    /// Mean place of the cage centre over the clearance.
    pub y: f64,
    pub z: f64,
    /// Largest slip of a roller at a record.
    pub slip: f64,
    /// Skew of all rollers at all records: mean, standard deviation, largest size; of the tilt the last two, rad. Zeros in the plane.
    pub skew: [f64; 3],
    pub tilt: [f64; 2],
    /// Mean skew of the rollers that the inner ring presses, and of the others, rad.
    pub skew_by_load: [f64; 2],
    /// Mean power that friction and rolling resistance of all contacts take, W, and what of it is that of ribs.
    pub losses: f64,
    pub rib_losses: f64,
    /// 95 % of the pocket forces of all rollers at all records are below it, N.
    pub pocket_force: f64,
    /// Mean slip on leaving the load zone, just before it, and within it.
    pub slip_by_place: [f64; 3],
    /// Share of unloaded rollers in the back half of their pockets.
    pub back: f64,
}

/// Mean and standard deviation among starts.
pub struct Scatter {
    pub mean: f64,
    pub deviation: f64,
}

/// What came of all starts of a scene; of a scene that has none in some start the failure.
pub struct Case(pub Vec<Result<Found>>);

impl Case {
    /// A quantity over the starts.
    ///
    /// # Errors
    /// The first failure.
    pub fn of(&self, value: impl Fn(&Found) -> f64) -> Result<Scatter> {
        let values = self.0.iter().map(|found| Ok(value(found.as_ref().map_err(Error::clone)?)));
        let values = values.collect::<Result<Vec<f64>>>()?;
        let n = values.len() as f64;
        let mean = values.iter().sum::<f64>() / n;
        let square = values.iter().map(|x| (x - mean) * (x - mean)).sum::<f64>() / (n - 1.0).max(1.0);
        Ok(Scatter { mean, deviation: square.sqrt() })
    }
}

/// Runs all scenes from all starts, as many at once as there are cores; cases in the order of the scenes.
pub fn all(scenes: &[Scene]) -> Vec<Case> {
    let starts = STARTS as usize;
    let run = |k: usize| run(&scenes[k / starts], (k % starts) as u32);
    let mut done = on_all_cores(starts * scenes.len(), run).into_iter();
    scenes.iter().map(|_| Case(done.by_ref().take(starts).collect())).collect()
}

/// Runs a scene from one of its starts: the first is its own, in the others the cage is displaced in directions that spread evenly.
fn run(scene: &Scene, start: u32) -> Result<Found> {
    let mut scene = scene.clone();
    let known: Vec<String> =
        Model::new(scene.clone())?.channels().iter().map(|channel| channel.name.clone()).collect();
    let count = scene.rollers.as_ref().map_or(0, |rollers| rollers.count);
    let of_rollers = (0..count).flat_map(|j| OF_ROLLER.map(|field| format!("roller[{j}].{field}")));
    let wanted = ["cage.y".to_owned(), "cage.z".to_owned()].into_iter().chain(of_rollers);
    scene.record.channels = Some(wanted.filter(|name| known.contains(name)).collect());
    scene.record.extremes = Some(Vec::new());
    let model = Arc::new(Model::new(scene)?);
    let mut sim = Sim::new(model.clone())?;
    let angle = TAU * (f64::from(start) * (3.0 - 5f64.sqrt()) / 2.0).fract();
    let shift = if start == 0 { 0.0 } else { APART };
    let mut state = sim.state().to_vec();
    for (x, info) in state.iter_mut().zip(model.state_infos()) {
        match info.name.as_str() {
            "cage.y" => *x += shift * angle.cos(),
            "cage.z" => *x += shift * angle.sin(),
            _ => {}
        }
    }
    sim.set_state(0.0, &state)?;
    sim.advance_to(FROM)?;
    let before = sim.works();
    let mut recording = Recording::default();
    recording.run(&mut sim, UNTIL, INTERVAL, |_, _| true)?;
    let after = sim.works();
    let power = |wanted: &dyn Fn(&str) -> bool| {
        let works = POWERS.iter().zip(after.iter().zip(&before));
        works.filter(|(name, _)| wanted(name)).map(|(_, (now, then))| then - now).sum::<f64>()
            / (UNTIL - FROM)
    };
    let of_contact = |name: &str| CONTACTS.iter().any(|part| name.ends_with(part));
    let losses = [power(&of_contact), power(&|name| name.starts_with("rib_"))];
    Found::of(&model, &recording, count as usize, losses)
}

impl Found {
    fn of(
        model: &Model,
        recording: &Recording,
        count: usize,
        [losses, rib_losses]: [f64; 2],
    ) -> Result<Self> {
        let column = |name: &str| {
            let place = model.recorded().iter().position(|i| model.channels()[*i].name == name);
            place.map(|place| recording.columns[place].as_slice())
        };
        let needed = |name: String| {
            column(&name).ok_or_else(|| Error::new(Status::UnknownName, format!("{name} is not recorded")))
        };
        let of_rollers = |field: &str| -> Result<Vec<&[f64]>> {
            (0..count).map(|j| needed(format!("roller[{j}].{field}"))).collect()
        };
        let mean = |values: &[f64]| values.iter().sum::<f64>() / values.len().max(1) as f64;
        let all = |columns: &[&[f64]]| columns.concat();
        let (slip, force) = (of_rollers("slip")?, of_rollers("inner_force")?);
        let (angle, pocket) = (of_rollers("orbit_angle")?, of_rollers("pocket_force")?);
        let place = of_rollers("pocket_position")?;
        let largest = |values: &[f64]| values.iter().fold(0.0, |m: f64, x| m.max(x.abs()));
        let spread = |values: &[f64]| {
            let middle = mean(values);
            mean(&values.iter().map(|x| (x - middle) * (x - middle)).collect::<Vec<_>>()).sqrt()
        };
        let (mut skew, mut tilt, mut skew_by_load) = ([0.0; 3], [0.0; 2], [0.0; 2]);
        if column("roller[0].skew").is_some() {
            let [skews, tilts] = [of_rollers("skew")?, of_rollers("tilt")?];
            let split = |loaded: bool| {
                let of = skews.iter().zip(&force).flat_map(|(skew, force)| skew.iter().zip(*force));
                mean(&of.filter(|(_, f)| (**f > 0.0) == loaded).map(|(x, _)| *x).collect::<Vec<_>>())
            };
            skew_by_load = [split(true), split(false)];
            let [skews, tilts] = [all(&skews), all(&tilts)];
            skew = [mean(&skews), spread(&skews), largest(&skews)];
            tilt = [spread(&tilts), largest(&tilts)];
        }
        let mut pressed: Vec<f64> = all(&pocket).iter().map(|x| x.abs()).collect();
        pressed.sort_by(f64::total_cmp);
        // Angle behind the bottom along the way of the rollers, which go clockwise.
        let behind = |angle: f64| (BOTTOM - angle + PI).rem_euclid(TAU) - PI;
        let samples = || {
            let columns = slip.iter().zip(&force).zip(&angle).zip(&place);
            columns.flat_map(|(((slip, force), angle), place)| {
                (0..slip.len()).map(|i| (slip[i], force[i], behind(angle[i]), place[i]))
            })
        };
        let edge = samples().filter(|(_, force, at, _)| *force > 0.0 && at.abs() < 0.5 * PI);
        let half = edge.fold(0.0, |m: f64, (_, _, at, _)| m.max(at.abs()));
        let between = |from: f64, to: f64| {
            mean(
                &samples()
                    .filter(|(.., at, _)| (from..to).contains(at))
                    .map(|(slip, ..)| slip)
                    .collect::<Vec<_>>(),
            )
        };
        let unloaded: Vec<f64> = samples()
            .filter(|(_, force, ..)| *force <= 0.0)
            .map(|(.., place)| f64::from(u8::from(place < 0.0)))
            .collect();
        Ok(Self {
            y: mean(needed("cage.y".to_owned())?) / CLEARANCE,
            z: mean(needed("cage.z".to_owned())?) / CLEARANCE,
            slip: largest(&all(&slip)),
            skew,
            tilt,
            skew_by_load,
            losses,
            rib_losses,
            pocket_force: pressed[pressed.len() * 95 / 100],
            slip_by_place: [between(half, half + 0.35), between(-half - 0.35, -half), between(-0.35, 0.35)],
            back: mean(&unloaded),
        })
    }
}
