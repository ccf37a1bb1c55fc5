//! Averaged equations of a cage among a train of elements that passes fast.
//!
//! ```text
//! mean over the place of the train:   <a>(Y, Z, V, w, alpha, waves)            in axes of the cage, without gravity
//! whirl at W:   position (e, 0), velocity (0, e W), w = w_o, lam = W - w_o, waves turn by lam: A' = -n lam B, B' = n lam A
//! <a_y> = -e W^2,   <a_z> = 0,   <w'> = 0,   <A''> = -(n lam)^2 A,   <B''> = -(n lam)^2 B
//! ```
//!
//! The mean is over trains that are turned by shares of a pitch: axes of the cage turn the other way instead, which the guide does
//! not see. The force law is that of the model.

mod at_rest;

use crate::bodies::CAGE_MOTION;
use crate::error::{Error, Result, Status};
use crate::model::{Fault, HostInputs, Input, InputValues, Model, Plane, Workspace};
use crate::scalar::math;
use crate::scene::{GuideFilm, Pocket, Scene, Signal};
use crate::sim::RunLimits;
use crate::space::rotate;
use nalgebra::{DMatrix, DVector};
use std::f64::consts::TAU;
use std::sync::Arc;

/// Places of the train in a pitch at which contacts are counted, and halvings of a step in which one begins or ends.
const SCAN: usize = 48;
const HALVINGS: u32 = 18;
/// Scales of the unknowns: angle of the wet arc, or share of the clearance; speed, rad/s; lead, rad; waves, m.
const ARC: f64 = 1e-2;
const SPEED: f64 = 100.0;
const LEAD: f64 = 1e-5;
const WAVE: f64 = 1e-5;
/// Steps of differences of the state for its stability: place m, velocity m/s, lead rad, speed rad/s, waves m and their rates m/s.
const STEPS: [f64; 6] = [1e-9, 1e-5, 1e-9, 1e-3, 1e-9, 1e-5];

/// Slower than this share of the elements, or nearer to the centre than this share of the clearance, a cage rests.
const RESTS: f64 = 1e-3;
const CENTRE: f64 = 1e-6;

/// Step of differences over the motion in axes at rest, in units of its scales.
pub(super) const DIFFERENCE_OF_MOTION: f64 = 1e-3;
/// Positive nodes and weights of the Gauss-Legendre rule of twelve points on [-1, 1].
const GAUSS: [(f64, f64); 6] = [
    (0.125_233_408_511_468_9, 0.249_147_045_813_402_8),
    (0.367_831_498_998_180_2, 0.233_492_536_538_354_8),
    (0.587_317_954_286_617_4, 0.203_167_426_723_065_9),
    (0.769_902_674_194_304_7, 0.160_078_328_543_346_2),
    (0.904_117_256_370_474_9, 0.106_939_325_995_318_43),
    (0.981_560_634_246_719_3, 0.047_175_336_386_511_83),
];

/// The averaged cage of a scene.
pub(super) struct Averaged {
    /// What may end a search with it.
    limits: RunLimits,
    model: Model,
    plane: Arc<Plane>,
    ws: Workspace,
    inputs: InputValues,
    /// Orders of the waves.
    orders: Vec<u32>,
    /// Angle from one element to the next, rad.
    pitch: f64,
    /// Orbit speed of the elements, rad/s.
    orbit: f64,
    clearance: f64,
    /// g_c, which takes from the clearance inside of a ring, m s^2.
    growth: f64,
    layer: Option<f64>,
    a: Vec<f64>,
    /// Whether elements pass the contact counter-clockwise.
    passes_forwards: bool,
    /// Radial play of an element in its pocket, m.
    play: f64,
    /// Evenly spaced places of it that means are over; `None` where they are exact.
    train: Option<usize>,
}

/// A whirl, as it is solved for.
pub(super) struct Unknowns {
    pub(super) eccentricity: f64,
    pub(super) speed: f64,
    pub(super) lead: f64,
    pub(super) waves: Vec<f64>,
}

/// State of the averaged cage in its own axes.
#[derive(Clone)]
struct State {
    position: [f64; 2],
    velocity: [f64; 2],
    lead: f64,
    speed: f64,
    waves: Vec<f64>,
    rates: Vec<f64>,
}

impl Averaged {
    /// That of a scene, whose gravity is left out, for a search with these limits.
    pub(super) fn new(scene: &Scene, limits: &RunLimits) -> Result<Self> {
        let refused = |path: &str, text: &str| Err(Error::new(Status::BadScene, format!("{path}: {text}")));
        let scene = Scene { gravity: None, ..scene.copied() };
        if scene.balls.is_some() {
            let text = "a steady whirl is that of a cage among elements of prescribed motion in the plane; \
                        runs from several starts tell whether this one whirls: 'cagedyn sweep --starts'";
            return refused("balls", text);
        }
        if scene.kinematic_elements.is_none() {
            let text = "a steady whirl is that of a cage among elements of prescribed motion";
            return refused("rollers", text);
        }
        let Some(cage) = &scene.cage else { return refused("cage", "missing; it is what whirls") };
        let Some(guide) = &cage.guide else {
            return refused("cage.guide", "missing; it is what the cage whirls in");
        };
        if cage.mass_eccentricity.is_some() {
            return refused(
                "cage.mass_eccentricity",
                "an unbalanced cage has no steady whirl in its own axes",
            );
        }
        if !guide.roundness.is_empty() {
            return refused(
                "cage.guide.roundness",
                "a cage with a profile has no steady whirl in its own axes",
            );
        }
        for (field, force) in
            cage.load.iter().flat_map(|load| [("force_y", &load.force_y), ("force_z", &load.force_z)])
        {
            if *force != Signal::Constant(0.0) {
                let path = format!("cage.load.{field}");
                return refused(
                    &path,
                    "a force with a direction leaves no steady whirl; a torque is allowed",
                );
            }
        }
        let constant = |signal: &Signal| matches!(signal, Signal::Constant(_));
        if !scene.inner_ring.as_ref().is_none_or(|ring| constant(&ring.speed)) {
            return refused("inner_ring.speed", "changes over time; a steady whirl needs a constant speed");
        }
        let outer_speed = scene.outer_ring.as_ref().and_then(|ring| ring.speed.as_ref());
        if !outer_speed.is_none_or(constant) {
            return refused("outer_ring.speed", "changes over time; a steady whirl needs a constant speed");
        }
        let clearance = guide.diametral_clearance / 2.0;
        let layer = match &guide.film {
            Some(GuideFilm::LubricantLayer(layer)) if layer.thickness < clearance => Some(layer.thickness),
            _ => None,
        };
        let orders = cage.elastic_ring.as_ref().map_or(Vec::new(), |ring| (2..=ring.modes).collect());
        let play = cage.pocket.as_ref().map_or(f64::INFINITY, Pocket::clearance);
        let growth = cage.elastic_ring.as_ref().map_or(0.0, |ring| ring.growth);
        let model = Model::new(scene)?;
        let inputs = model.inputs_at(0.0, &HostInputs::default());
        if inputs.of(Input::OrbitSpeed) == 0.0 {
            return refused("inner_ring.speed", "the elements do not go round, so nothing drives a whirl");
        }
        let plane = model.plane()?.clone();
        let count = model.element_count();
        Ok(Self {
            limits: limits.clone(),
            ws: Workspace::new(&plane),
            orders,
            pitch: TAU / count as f64,
            orbit: inputs.of(Input::OrbitSpeed),
            clearance,
            growth,
            layer,
            a: vec![0.0; model.layout().velocities()],
            passes_forwards: true,
            play,
            train: None,
            inputs,
            model,
            plane,
        })
    }

    pub(super) fn model(&self) -> &Model {
        &self.model
    }

    /// Radial play of an element in its pocket, m; infinite without pockets.
    pub(super) fn play(&self) -> f64 {
        self.play
    }

    pub(super) fn limits(&self) -> &RunLimits {
        &self.limits
    }

    /// Radial clearance of the cage at rest, m.
    pub(super) fn clearance(&self) -> f64 {
        self.clearance
    }

    /// Orbit speed of the elements, rad/s.
    pub(super) fn orbit(&self) -> f64 {
        self.orbit
    }

    /// Scale of every unknown.
    pub(super) fn scales(&self) -> Vec<f64> {
        let mut scales = vec![WAVE; 3 + 2 * self.orders.len()];
        scales[..3].copy_from_slice(&[ARC, SPEED, LEAD]);
        scales
    }

    /// Unknowns of a whirl.
    pub(super) fn pack(&self, whirl: &Unknowns) -> Vec<f64> {
        let first = self.place_at(whirl.eccentricity);
        [first, whirl.speed, whirl.lead].into_iter().chain(whirl.waves.iter().copied()).collect()
    }

    /// The unknown that stands for this eccentricity, m.
    pub(super) fn place_at(&self, eccentricity: f64) -> f64 {
        let Some(inside) = self.inside() else { return eccentricity / self.free() };
        // Of the shorter of both to the longer one: the half angle of the wet arc, or, beside the layer, what goes on from it.
        let (wet, cos) = match inside / eccentricity {
            share if share < 1.0 => (1.0, share),
            share => (-1.0, 1.0 / share),
        };
        wet * math::atan2((1.0 - cos * cos).max(0.0).sqrt(), cos)
    }

    /// Clearance of the grown cage, m.
    fn free(&self) -> f64 {
        self.clearance - self.growth * self.orbit * self.orbit
    }

    /// What is left of it inside of a layer, where the angle of the wet arc of a round cage stands for its place, m.
    pub(super) fn inside(&self) -> Option<f64> {
        self.layer.filter(|_| self.orders.is_empty()).map(|layer| self.free() - layer)
    }

    /// Whirl of these unknowns.
    pub(super) fn unknowns(&self, u: &[f64]) -> Unknowns {
        // The half angle of the wet arc of a round cage takes out the square root at its edge.
        let eccentricity = match self.inside() {
            Some(inside) if u[0] < 0.0 => inside * math::cos(u[0]),
            Some(inside) => inside / math::cos(u[0]),
            None => self.free() * u[0],
        };
        Unknowns { eccentricity, speed: u[1], lead: u[2], waves: u[3..].to_vec() }
    }

    pub(super) fn speed(&self, u: &[f64]) -> f64 {
        u[1]
    }

    pub(super) fn eccentricity(&self, u: &[f64]) -> f64 {
        self.unknowns(u).eccentricity
    }

    /// Whether nothing goes round: the cage stands, or is in the centre.
    pub(super) fn rests(&self, u: &[f64]) -> bool {
        self.speed(u).abs() < RESTS * self.orbit.abs() || self.eccentricity(u).abs() < CENTRE * self.clearance
    }

    /// The state of a whirl, and the speed at which it goes round in axes of the cage.
    fn state(&self, u: &[f64]) -> (State, f64) {
        let Unknowns { eccentricity, speed, lead, waves } = self.unknowns(u);
        let round = speed - self.orbit;
        let rates = self.orders.iter().zip(waves.chunks(2)).flat_map(|(order, pair)| {
            let n = f64::from(*order) * round;
            [-n * pair[1], n * pair[0]]
        });
        let rates = rates.collect();
        let state = State {
            position: [eccentricity, 0.0],
            velocity: [0.0, eccentricity * speed],
            lead,
            speed: self.orbit,
            waves,
            rates,
        };
        (state, round)
    }

    /// What is zero at a steady whirl: mean accelerations less those of the whirl, m/s^2 and, at the pitch circle, of the angle.
    pub(super) fn residual(&mut self, u: &[f64]) -> Result<Vec<f64>> {
        let (state, round) = self.state(u);
        let mut mean = self.accelerations(&state)?;
        mean[0] += state.position[0] * u[1] * u[1];
        mean[2] *= self.model.pitch_radius();
        for (k, order) in self.orders.iter().enumerate() {
            let n = f64::from(*order) * round;
            for i in 0..2 {
                mean[CAGE_MOTION + 2 * k + i] += n * n * state.waves[2 * k + i];
            }
        }
        Ok(mean)
    }

    /// Mean accelerations of the cage: place, angle, waves.
    fn accelerations(&mut self, state: &State) -> Result<Vec<f64>> {
        self.limits.check()?;
        let n = CAGE_MOTION + state.waves.len();
        let mut mean = vec![0.0; n];
        if let Some(train) = self.train {
            let share = 1.0 / train as f64;
            for i in 0..train {
                self.add(state, self.pitch * share * i as f64, share, &mut mean)?;
            }
            return Ok(mean);
        }
        // Between places where a pocket begins or ends to touch, everything is smooth.
        let step = self.pitch / SCAN as f64;
        let mut breaks = Vec::new();
        let mut before = self.touching(state, 0.0)?;
        for i in 0..SCAN {
            let (mut low, mut high) = (step * i as f64, step * (i + 1) as f64);
            let after = self.touching(state, high)?;
            if before != after {
                for _ in 0..HALVINGS {
                    let middle = 0.5 * (low + high);
                    if self.touching(state, middle)? == before { low = middle } else { high = middle }
                }
                breaks.push(0.5 * (low + high));
            }
            before = after;
        }
        let first = breaks.first().copied().unwrap_or(0.0);
        breaks.push(first + self.pitch);
        let mut from = first;
        for to in breaks {
            let (middle, half) = (0.5 * (from + to), 0.5 * (to - from));
            for (node, weight) in GAUSS {
                for side in [-1.0, 1.0] {
                    self.add(state, middle + side * half * node, weight * half / self.pitch, &mut mean)?;
                }
            }
            from = to;
        }
        Ok(mean)
    }

    /// Number of contacts of elements with the cage, with the train turned by this angle, rad.
    fn touching(&mut self, state: &State, turned: f64) -> Result<usize> {
        self.evaluate(state, turned)?;
        Ok(self.ws.touching())
    }

    /// Adds the accelerations with a train that is turned by this angle (rad), times `weight`.
    fn add(&mut self, state: &State, turned: f64, weight: f64, mean: &mut [f64]) -> Result<()> {
        self.evaluate(state, turned)?;
        let (sin, cos) = math::sin_cos(turned);
        let a = &self.a;
        let [y, z] = rotate([a[0], a[1]], sin, cos);
        for (sum, a) in mean.iter_mut().zip([y, z, a[2]]) {
            *sum += weight * a;
        }
        for (k, order) in self.orders.iter().enumerate() {
            let (sin, cos) = math::sin_cos(f64::from(*order) * turned);
            let at = CAGE_MOTION + 2 * k;
            let wave = rotate([a[at], a[at + 1]], sin, cos);
            mean[at..at + 2].iter_mut().zip(wave).for_each(|(sum, a)| *sum += weight * a);
        }
        Ok(())
    }

    /// Finds the accelerations with a train that is turned by this angle, rad, in axes that are turned the other way.
    fn evaluate(&mut self, state: &State, turned: f64) -> Result<()> {
        let n = CAGE_MOTION + state.waves.len();
        let (mut q, mut v) = (vec![0.0; n], vec![0.0; n]);
        self.inputs.angles[0] = state.lead;
        v[2] = state.speed;
        let (sin, cos) = math::sin_cos(turned);
        q[..2].copy_from_slice(&rotate(state.position, -sin, cos));
        v[..2].copy_from_slice(&rotate(state.velocity, -sin, cos));
        for (k, order) in self.orders.iter().enumerate() {
            let (sin, cos) = math::sin_cos(f64::from(*order) * turned);
            let at = CAGE_MOTION + 2 * k;
            for (out, waves) in [(&mut q, &state.waves), (&mut v, &state.rates)] {
                out[at..at + 2].copy_from_slice(&rotate([waves[2 * k], waves[2 * k + 1]], -sin, cos));
            }
        }
        let Self { plane, inputs, ws, a, .. } = self;
        plane.accelerations(inputs, &q, &v, ws, a).map_err(|fault| failed(fault, plane))
    }

    /// Angle from one element to the next, rad.
    pub(super) fn pitch(&self) -> f64 {
        self.pitch
    }

    /// Takes means over so many evenly spaced places of the train, to tell signs by, or exact ones again.
    pub(super) fn set_train(&mut self, places: Option<usize>) {
        self.train = places;
    }

    /// Tells whether elements go round faster than the whirl, seen counter-clockwise.
    pub(super) fn set_passing(&mut self, whirl_speed: f64) {
        self.passes_forwards = self.orbit > whirl_speed;
    }

    /// Derivatives of the averaged motion at a whirl in axes that go round with it: position, velocity, lead, speed, waves and
    /// their rates.
    pub(super) fn slopes(&mut self, u: &[f64]) -> Result<DMatrix<f64>> {
        let (state, round) = self.state(u);
        let x = state.flat();
        let n = x.len();
        let waves = state.waves.len();
        let mut out = DMatrix::zeros(n, n);
        for k in 0..n {
            let h = STEPS[match k {
                0 | 1 => 0,
                2 | 3 => 1,
                4 => 2,
                5 => 3,
                k if k < 6 + waves => 4,
                _ => 5,
            }];
            let mut rate = |by: f64| {
                let mut moved = x.clone();
                moved[k] += by;
                self.rate(&State::of(&moved, waves), round)
            };
            let (high, low) = (rate(h)?, rate(-h)?);
            for i in 0..n {
                out[(i, k)] = (high[i] - low[i]) / (2.0 * h);
            }
        }
        Ok(out)
    }

    /// Rate of the state in axes of the cage less what going round makes of it.
    fn rate(&mut self, state: &State, round: f64) -> Result<Vec<f64>> {
        let a = self.accelerations(state)?;
        let ([y, z], [vy, vz], speed) = (state.position, state.velocity, state.speed);
        let carried = speed + round;
        let mut rate = vec![vy + carried * z, vz - carried * y, a[0] + carried * vz, a[1] - carried * vy];
        rate.extend([self.orbit - speed, a[2]]);
        let turned = |x: &[f64], out: &mut Vec<f64>, rate: &dyn Fn(usize) -> f64| {
            for (k, order) in self.orders.iter().enumerate() {
                let n = f64::from(*order) * round;
                out.push(rate(2 * k) + n * x[2 * k + 1]);
                out.push(rate(2 * k + 1) - n * x[2 * k]);
            }
        };
        turned(&state.waves, &mut rate, &|k| state.rates[k]);
        turned(&state.rates, &mut rate, &|k| a[CAGE_MOTION + k]);
        Ok(rate)
    }

    /// Whether a round cage is in its layer at this state, if it has one.
    pub(super) fn is_wet(&self, x: &DVector<f64>) -> bool {
        self.layer.is_none_or(|layer| math::hypot(x[0], x[1]) > self.clearance - layer)
    }

    /// Number of wet arcs.
    pub(super) fn arcs(&mut self, u: &[f64]) -> Result<u32> {
        let (state, _) = self.state(u);
        let film = self.model.scene().cage.as_ref().and_then(|cage| cage.guide.as_ref()?.film.as_ref());
        let Some(layer) = self.layer else { return Ok(u32::from(film.is_some())) };
        if self.orders.is_empty() {
            return Ok(u32::from(state.position[0] > self.clearance - layer));
        }
        self.accelerations(&state)?;
        Ok(self.plane.wet_arcs(&self.ws).0)
    }
}

impl State {
    fn flat(&self) -> Vec<f64> {
        let motion =
            [self.position[0], self.position[1], self.velocity[0], self.velocity[1], self.lead, self.speed];
        motion.into_iter().chain(self.waves.iter().chain(&self.rates).copied()).collect()
    }

    fn of(x: &[f64], waves: usize) -> Self {
        Self {
            position: [x[0], x[1]],
            velocity: [x[2], x[3]],
            lead: x[4],
            speed: x[5],
            waves: x[6..6 + waves].to_vec(),
            rates: x[6 + waves..].to_vec(),
        }
    }
}

fn failed(fault: Fault, plane: &Plane) -> Error {
    Error::new(Status::BadState, format!("a trial whirl has no forces: {}", plane.describe(fault)))
}
