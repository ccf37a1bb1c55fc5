//! Inputs of the model: quantities that follow the scene's functions of time unless the host takes them over.

use crate::scene::Signal;

/// Number of inputs a model can have.
pub const INPUTS: usize = 3;

/// An input.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Input {
    /// Rotation speed of the inner ring, rad/s.
    RingSpeed = 0,
    /// External load on the inner ring to the right, N.
    LoadY = 1,
    /// External load on the inner ring upwards, N.
    LoadZ = 2,
}

impl Input {
    /// All inputs; a fixed ring has only the first.
    pub const ALL: [Input; INPUTS] = [Input::RingSpeed, Input::LoadY, Input::LoadZ];
}

/// Values of the inputs at one instant.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct InputValues {
    /// Rotation speed of the inner ring, rad/s.
    pub ring_speed: f64,
    /// External load on the inner ring (y, z), N.
    pub load: [f64; 2],
}

/// Values set by the host; `None` follows the scene.
pub type HostInputs = [Option<f64>; INPUTS];

/// Functions of time of the scene.
#[derive(Clone, Debug, PartialEq)]
pub struct InputSignals {
    /// Ring speed, load y, load z.
    pub signals: [Signal; INPUTS],
}

impl InputSignals {
    /// Values at time `t` in s.
    pub fn at(&self, t: f64, host: &HostInputs) -> InputValues {
        let value = |i: Input| host[i as usize].unwrap_or_else(|| self.signals[i as usize].at(t));
        InputValues { ring_speed: value(Input::RingSpeed), load: [value(Input::LoadY), value(Input::LoadZ)] }
    }

    /// The first jump or kink after `t`, s.
    pub fn next_event(&self, t: f64, host: &HostInputs) -> f64 {
        let followed = self.signals.iter().zip(host).filter(|(_, host)| host.is_none());
        followed.map(|(signal, _)| signal.next_event(t)).fold(f64::INFINITY, f64::min)
    }
}
