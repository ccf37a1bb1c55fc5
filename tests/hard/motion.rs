//! How the cage, or the ring of a bearing without cage, moves: means, and the class of motion.

use cagedyn::Sim;
use std::f64::consts::PI;
use std::fmt::{Display, Formatter, Result};

/// Place in shares of the clearance, y and z, and mean speed of the cage in rad/s; without a cage of the ring and its drag
/// torque in N m.
pub type Readings = [f64; 3];

/// Distance from the mean place in shares of the clearance, or of the distance of that place from the centre, below which
/// something stays.
const STAYS: [f64; 2] = [0.1, 0.4];

/// The kind of a motion.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Class {
    /// Near one place.
    Stays,
    /// Round the centre, in the direction of the cage's rotation.
    Forward,
    /// Round the centre against it.
    Backward,
    /// None of these.
    Wanders,
}

impl Display for Class {
    fn fmt(&self, f: &mut Formatter<'_>) -> Result {
        f.write_str(match self {
            Self::Stays => "stays",
            Self::Forward => "goes round forward",
            Self::Backward => "goes round backward",
            Self::Wanders => "wanders",
        })
    }
}

/// Readings of the second half of a run.
pub struct Path {
    places: [usize; 3],
    /// Factors that make shares of the clearance of places.
    units: [f64; 3],
    /// Speed of the cage centre round the guide, which may turn more than once from record to record.
    whirl: Option<usize>,
    readings: Vec<Readings>,
    /// Sums of the squared distance from the centre and of its product with the whirl speed.
    sums: [f64; 2],
}

impl Path {
    pub fn new(sim: &Sim) -> Self {
        let channels = sim.channels();
        let find = |names: [&str; 3]| {
            let place = |name: &str| channels.iter().position(|c| c.name == name);
            Some([place(names[0])?, place(names[1])?, place(names[2])?])
        };
        let length = sim.model().reference_length();
        let cage = find(["cage.y_ratio", "cage.z_ratio", "cage.speed"]).map(|places| (places, [1.0; 3]));
        let ring = ["inner_ring.y", "inner_ring.z", "inner_ring.drag_torque"];
        let (places, units) = cage
            .or_else(|| find(ring).map(|places| (places, [1.0 / length, 1.0 / length, 1.0])))
            .expect("a cage or a ring that moves");
        let whirl = channels.iter().position(|c| c.name == "cage.whirl_speed");
        Self { places, units, whirl, readings: Vec::new(), sums: [0.0; 2] }
    }

    /// Adds the outputs of a record.
    pub fn add(&mut self, out: &[f64]) {
        let reading = [0, 1, 2].map(|k| self.units[k] * out[self.places[k]]);
        let square = reading[0] * reading[0] + reading[1] * reading[1];
        self.sums[0] += square;
        self.sums[1] += square * self.whirl.map_or(0.0, |k| out[k]);
        self.readings.push(reading);
    }

    pub fn means(&self) -> Readings {
        let n = self.readings.len().max(1) as f64;
        [0, 1, 2].map(|k| self.readings.iter().map(|r| r[k]).sum::<f64>() / n)
    }

    /// Of readings over this time in s.
    pub fn class(&self, duration: f64) -> Class {
        let [y, z, speed] = self.means();
        let n = self.readings.len().max(1) as f64;
        let spread = self.readings.iter().map(|r| (r[0] - y).powi(2) + (r[1] - z).powi(2)).sum::<f64>() / n;
        let spread = spread.sqrt();
        if spread < STAYS[0] || spread < STAYS[1] * y.hypot(z) {
            return Class::Stays;
        }
        let [squares, weighted] = self.sums;
        let swept = if squares > 0.0 { weighted / squares * duration } else { 0.0 };
        match swept * speed.signum() {
            swept if swept > PI => Class::Forward,
            swept if swept < -PI => Class::Backward,
            _ => Class::Wanders,
        }
    }
}
