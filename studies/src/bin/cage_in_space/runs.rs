//! Runs of scenes on all cores, and what is read off them.

use cagedyn::{Model, MotionOfCage, Recording, Result, Scene, Sim, WhirlSummary};
use cagedyn_studies::page::on_all_cores;
use std::f64::consts::{PI, TAU};
use std::sync::Arc;

/// Time between records, s.
const INTERVAL: f64 = 1e-4;
/// What is recorded beside the motion of the cage.
const ORBIT: &str = "balls.orbit_ratio";

/// A run: its scene, its length and the part of that which does not count, s.
pub struct Run {
    pub scene: Scene,
    pub until: f64,
    pub from: f64,
    /// Shift of the cage centre at the start, m, and change of the cage speed as a share of it.
    pub start: ([f64; 2], f64),
}

/// What came of it.
pub struct Found {
    pub whirl: WhirlSummary,
    pub wobble: Option<WhirlSummary>,
    /// Mean tilt of the cage, rad; zero in the plane.
    pub tilt: f64,
    /// Mean orbit speed of the balls over that of rolling; `None` of prescribed ones.
    pub orbit: Option<f64>,
    pub cage_speed: f64,
    /// Place of the cage centre, m, over the part that counts.
    centre: [Vec<f64>; 2],
}

impl Run {
    /// The last 0.12 s of 0.3 s.
    pub fn new(scene: Scene) -> Self {
        Self { scene, until: 0.3, from: 0.18, start: ([0.0; 2], 0.0) }
    }

    fn run(&self) -> Result<Found> {
        let mut scene = self.scene.clone();
        let model = Model::new(scene.clone())?;
        let known: Vec<String> = model.channels().iter().map(|channel| channel.name.clone()).collect();
        let asked = MotionOfCage::CHANNELS.into_iter().chain([ORBIT]);
        let channels = asked.filter(|name| known.iter().any(|k| k == name)).map(str::to_owned).collect();
        scene.record.channels = Some(channels);
        scene.record.extremes = Some(Vec::new());
        let model = Arc::new(Model::new(scene)?);
        let mut sim = Sim::new(model.clone())?;
        let ([y, z], spin) = self.start;
        let mut state = sim.state().to_vec();
        for (x, info) in state.iter_mut().zip(model.state_infos()) {
            match info.name.as_str() {
                "cage.y" => *x += y,
                "cage.z" => *x += z,
                "cage.speed" => *x *= 1.0 + spin,
                _ => {}
            }
        }
        sim.set_state(0.0, &state)?;
        let mut recording = Recording::default();
        recording.run(&mut sim, self.until, INTERVAL, |_, _| true)?;
        let first = recording.times.partition_point(|t| *t < self.from);
        let column = |name: &str| {
            let place = model.recorded().iter().position(|i| model.channels()[*i].name == name)?;
            Some(recording.columns[place][first..].to_vec())
        };
        let mean = |name: &str| column(name).map(|values| values.iter().sum::<f64>() / values.len() as f64);
        let moved = MotionOfCage::of(&model, &recording, self.from).expect("records of the cage");
        Ok(Found {
            whirl: moved.whirl,
            wobble: moved.wobble,
            tilt: mean("cage.tilt").unwrap_or(0.0),
            orbit: mean(ORBIT),
            cage_speed: mean("cage.speed").unwrap_or(f64::NAN),
            centre: ["cage.y", "cage.z"].map(|name| column(name).unwrap_or_default()),
        })
    }
}

impl Found {
    /// Amplitude of the circle that the cage centre describes at this frequency (Hz; negative clockwise), m, and the mean of that over
    /// nearby frequencies that are not the line's own.
    pub fn line(&self, frequency: f64) -> [f64; 2] {
        let resolution = 1.0 / (INTERVAL * self.centre[0].len() as f64);
        let around = [-12.0, -10.0, -8.0, -6.0, 6.0, 8.0, 10.0, 12.0];
        let nearby = around.iter().map(|k| self.circle(frequency + k * resolution)).sum::<f64>();
        [self.circle(frequency), nearby / around.len() as f64]
    }

    /// By a Hann window, whose mean is one half.
    fn circle(&self, frequency: f64) -> f64 {
        let n = self.centre[0].len() as f64;
        let mut sum = [0.0; 2];
        for (i, (y, z)) in self.centre[0].iter().zip(&self.centre[1]).enumerate() {
            let window = 1.0 - (TAU * i as f64 / n).cos();
            let (sin, cos) = (-TAU * frequency * INTERVAL * i as f64).sin_cos();
            sum = [sum[0] + window * (y * cos - z * sin), sum[1] + window * (y * sin + z * cos)];
        }
        sum[0].hypot(sum[1]) / n
    }
}

/// Runs all of them, as many at once as there are cores; results in their order.
pub fn all(runs: &[Run]) -> Vec<Result<Found>> {
    on_all_cores(runs.len(), |k| runs[k].run())
}

/// Starts with the cage at the distance `shift` (m) in directions that spread evenly, and speeds up to a tenth apart.
pub fn starts(scene: &Scene, count: u32, shift: f64) -> impl Iterator<Item = Run> + '_ {
    (0..count).map(move |k| {
        let angle = TAU * (f64::from(k) * (3.0 - 5f64.sqrt()) / 2.0).fract() - PI;
        let spin = 0.2 * ((f64::from(k) * std::f64::consts::SQRT_2).fract() - 0.5);
        let at = [shift * angle.cos(), shift * angle.sin()];
        Run { scene: scene.clone(), until: 0.15, from: 0.09, start: (at, spin) }
    })
}
