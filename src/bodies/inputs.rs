//! Inputs of the model: what drives the bodies from outside.

use crate::registry::registry;
use crate::stored::stored;

registry! {
    /// An input.
    pub enum Input, /// Their names.
    pub const INPUT_NAMES {
        /// Rotation speed of the inner ring, rad/s.
        RingSpeed = "inner_ring.speed",
        /// Rotation speed of the outer ring, rad/s.
        OuterRingSpeed = "outer_ring.speed",
        /// External load on the outer ring to the right, N.
        OuterLoadY = "outer_ring.load.y",
        /// External load on the outer ring upwards, N.
        OuterLoadZ = "outer_ring.load.z",
        /// External load on the rotor to the right, N.
        RotorLoadY = "rotor.load.y",
        /// External load on the rotor upwards, N.
        RotorLoadZ = "rotor.load.z",
        /// External load on the inner ring along the axis of the bearing, N.
        LoadX = "load.x",
        /// External load on the inner ring to the right, N.
        LoadY = "load.y",
        /// External load on the inner ring upwards, N.
        LoadZ = "load.z",
        /// External moment on the inner ring about the axis to the right, N m.
        MomentY = "load.moment_y",
        /// External moment on the inner ring about the upward axis, N m.
        MomentZ = "load.moment_z",
        /// External force on the cage to the right, N.
        CageForceY = "cage.force_y",
        /// External force on the cage upwards, N.
        CageForceZ = "cage.force_z",
        /// External torque on the cage, N m.
        CageTorque = "cage.torque",
        /// External force on a cage in space along the axis of the bearing, N.
        CageForceX = "cage.force_x",
        /// External moment on it about the axis to the right, N m.
        CageMomentY = "cage.moment_y",
        /// External moment on it about the upward axis, N m.
        CageMomentZ = "cage.moment_z",
        /// Orbit speed of kinematic elements, rad/s.
        OrbitSpeed = "elements.orbit_speed",
        /// Spin speed of kinematic elements, rad/s.
        SpinSpeed = "elements.spin_speed",
        /// Temperature of the lubricant, K.
        Temperature = "lubricant.temperature",
        /// Place of an inner ring whose motion is prescribed: along the axis of the bearing, m.
        RingX = "inner_ring.x",
        /// To the right, m.
        RingY = "inner_ring.y",
        /// Upwards, m.
        RingZ = "inner_ring.z",
        /// Its tilt about the axis to the right, rad.
        RingTiltY = "inner_ring.tilt_y",
        /// About the upward axis, rad.
        RingTiltZ = "inner_ring.tilt_z",
        /// Rates of these, m/s and rad/s.
        RingVx = "inner_ring.vx",
        /// See [`Input::RingVx`].
        RingVy = "inner_ring.vy",
        /// See [`Input::RingVx`].
        RingVz = "inner_ring.vz",
        /// See [`Input::RingVx`].
        RingTiltSpeedY = "inner_ring.tilt_speed_y",
        /// See [`Input::RingVx`].
        RingTiltSpeedZ = "inner_ring.tilt_speed_z",
        /// Place of an outer ring whose motion is prescribed, to the right, m.
        OuterRingY = "outer_ring.y",
        /// Upwards, m.
        OuterRingZ = "outer_ring.z",
        /// Rates of these, m/s.
        OuterRingVy = "outer_ring.vy",
        /// See [`Input::OuterRingVy`].
        OuterRingVz = "outer_ring.vz",
    }
}

/// Number of inputs a model can have.
pub const INPUTS: usize = INPUT_NAMES.len();

impl Input {
    /// SI unit, and what it is.
    pub fn meaning(self) -> [&'static str; 2] {
        match self {
            Self::RingSpeed => ["rad/s", "rotation speed of the inner ring"],
            Self::OuterRingSpeed => ["rad/s", "rotation speed of the outer ring"],
            Self::RingX => ["m", "place of the inner ring, along the axis of the bearing"],
            Self::RingY => ["m", "place of the inner ring, to the right"],
            Self::RingZ => ["m", "place of the inner ring, upwards"],
            Self::RingTiltY => ["rad", "tilt of the inner ring, about the axis to the right"],
            Self::RingTiltZ => ["rad", "tilt of the inner ring, about the upward axis"],
            Self::RingVx => ["m/s", "rate of inner_ring.x"],
            Self::RingVy => ["m/s", "rate of inner_ring.y"],
            Self::RingVz => ["m/s", "rate of inner_ring.z"],
            Self::RingTiltSpeedY => ["rad/s", "rate of inner_ring.tilt_y"],
            Self::RingTiltSpeedZ => ["rad/s", "rate of inner_ring.tilt_z"],
            Self::OuterRingY => ["m", "place of the outer ring, to the right"],
            Self::OuterRingZ => ["m", "place of the outer ring, upwards"],
            Self::OuterRingVy => ["m/s", "rate of outer_ring.y"],
            Self::OuterRingVz => ["m/s", "rate of outer_ring.z"],
            Self::OuterLoadY => ["N", "external load on the outer ring, to the right"],
            Self::OuterLoadZ => ["N", "external load on the outer ring, upwards"],
            Self::RotorLoadY => ["N", "external load on the rotor, to the right"],
            Self::RotorLoadZ => ["N", "external load on the rotor, upwards"],
            Self::LoadY => ["N", "external load on the inner ring, to the right"],
            Self::LoadZ => ["N", "external load on the inner ring, upwards"],
            Self::CageForceY => ["N", "external force on the cage, to the right"],
            Self::CageForceZ => ["N", "external force on the cage, upwards"],
            Self::CageTorque => ["N m", "external torque on the cage"],
            Self::CageForceX => ["N", "external force on the cage, along the axis of the bearing"],
            Self::CageMomentY => ["N m", "external moment on the cage, about the axis to the right"],
            Self::CageMomentZ => ["N m", "external moment on the cage, about the upward axis"],
            Self::OrbitSpeed => ["rad/s", "orbit speed of the rolling elements"],
            Self::SpinSpeed => ["rad/s", "spin speed of the rolling elements"],
            Self::Temperature => ["K", "temperature of the lubricant"],
            Self::LoadX => ["N", "external load on the inner ring, along the axis of the bearing"],
            Self::MomentY => ["N m", "external moment on the inner ring, about the axis to the right"],
            Self::MomentZ => ["N m", "external moment on the inner ring, about the upward axis"],
        }
    }
}

/// Number of inputs before those of [`PLACES`], which few scenes have.
pub(crate) const GENERAL: usize = INPUTS - 2 * PLACES.len();

/// Places and their rates: coordinates of rings whose motion is prescribed. They are the last inputs.
pub(crate) const PLACES: [[Input; 2]; 7] = [
    [Input::RingX, Input::RingVx],
    [Input::RingY, Input::RingVy],
    [Input::RingZ, Input::RingVz],
    [Input::RingTiltY, Input::RingTiltSpeedY],
    [Input::RingTiltZ, Input::RingTiltSpeedZ],
    [Input::OuterRingY, Input::OuterRingVy],
    [Input::OuterRingZ, Input::OuterRingVz],
];

impl Input {
    /// The place that it is, or is the rate of, among [`PLACES`], and whether it is the rate.
    pub(crate) fn place(self) -> Option<(usize, bool)> {
        let among = |which: usize| PLACES.iter().position(|place| place[which] == self);
        among(0).map(|place| (place, false)).or_else(|| among(1).map(|place| (place, true)))
    }
}

/// Values of the inputs at one instant, and what follows from them.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct InputValues {
    /// Values by [`Input`]; zero for inputs that the model does not have. Orbit and spin speed are those of rolling
    /// where the scene asks for it.
    pub values: [f64; INPUTS],
    /// Angles since the start that follow from speeds, rad: orbit of kinematic elements in the plane; turning of outer and inner ring
    /// where something asks for it.
    pub angles: [f64; 2],
    /// Second rates of places, by their order: m/s^2 and rad/s^2.
    pub second: [f64; PLACES.len()],
    /// Rates of the speeds of outer and inner ring where something asks for their angles, rad/s^2.
    pub speeding: [f64; 2],
}

impl Default for InputValues {
    fn default() -> Self {
        Self { values: [0.0; INPUTS], angles: [0.0; 2], second: [0.0; PLACES.len()], speeding: [0.0; 2] }
    }
}

impl InputValues {
    /// Orbit angle that kinematic elements have travelled since the start, rad.
    #[inline]
    pub fn orbit_travel(&self) -> f64 {
        self.angles[0]
    }

    /// Value of one input.
    pub fn of(&self, input: Input) -> f64 {
        self.values[input as usize]
    }

    /// Takes over the values of a scene that has no places, without angles.
    #[inline]
    pub(crate) fn take_general(&mut self, from: &Self) {
        debug_assert!(PLACES.as_flattened().iter().all(|input| *input as usize >= GENERAL));
        self.values[..GENERAL].copy_from_slice(&from.values[..GENERAL]);
    }

    /// These moved by `step` along a direction.
    pub(crate) fn moved(mut self, direction: &Self, step: f64) -> Self {
        for (value, by) in self.values.iter_mut().zip(&direction.values) {
            *value += step * by;
        }
        self
    }
}

/// How a host lets an input go on: value + slope (t - since) + curvature (t - since)^2/2.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
struct Held {
    value: f64,
    slope: f64,
    curvature: f64,
    /// s
    since: f64,
}

impl Held {
    fn at(&self, t: f64) -> f64 {
        let tau = t - self.since;
        self.value + tau * (self.slope + 0.5 * tau * self.curvature)
    }

    fn rate(&self, t: f64) -> f64 {
        self.slope + (t - self.since) * self.curvature
    }

    /// Integral of a line from one time to another.
    fn integral(&self, from: f64, to: f64) -> f64 {
        (self.value + self.slope * (0.5 * (from + to) - self.since)) * (to - from)
    }
}

/// What the host has set: inputs that go on from there, as long as it says nothing else. A place moves at its rate, so both are one
/// function of time, and to set the one is to set the other.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct HostInputs {
    /// By [`Input`], that of a place under the place; `None` follows the scene.
    held: [Option<Held>; INPUTS],
    /// How many are set.
    set: u64,
    /// Time (s) and [`InputValues::angles`] (rad) from which these count on.
    pub anchor: [f64; 3],
}

impl Default for HostInputs {
    fn default() -> Self {
        Self { held: [None; INPUTS], set: 0, anchor: [0.0; 3] }
    }
}

impl HostInputs {
    fn held(&self, input: Input) -> (Option<&Held>, bool) {
        let (under, is_rate) = match input.place() {
            Some((place, is_rate)) => (PLACES[place][0], is_rate),
            None => (input, false),
        };
        (self.held[under as usize].as_ref(), is_rate)
    }

    /// Whether the host has set it.
    pub fn holds(&self, input: Input) -> bool {
        self.held(input).0.is_some()
    }

    /// Value and rate at time `t` (s), if the host has set it.
    pub fn of(&self, input: Input, t: f64) -> Option<[f64; 2]> {
        let (held, is_rate) = self.held(input);
        held.map(|held| if is_rate { [held.rate(t), held.curvature] } else { [held.at(t), held.rate(t)] })
    }

    /// Second rate of one of [`PLACES`], if the host has set it.
    pub(crate) fn second_of(&self, place: usize) -> Option<f64> {
        self.held[PLACES[place][0] as usize].map(|held| held.curvature)
    }

    /// Integral of a speed from one time to another (s), if the host has set it.
    pub(crate) fn turned(&self, input: Input, from: f64, to: f64) -> Option<f64> {
        self.held[input as usize].map(|held| held.integral(from, to))
    }

    /// Sets a value at time `t` (s), from which it goes on with `slope` per second. Without one it stays, but for a place, which goes on
    /// at the rate that the host has set for it; a rate moves its place from where that is, `here`.
    pub(crate) fn hold(&mut self, input: Input, t: f64, [value, here]: [f64; 2], slope: Option<f64>) {
        let (before, is_rate) = self.held(input);
        let (slope, curvature) = match (input.place(), slope) {
            (Some(_), None) if !is_rate => before.map_or((0.0, 0.0), |held| (held.rate(t), held.curvature)),
            (_, slope) => (slope.unwrap_or(0.0), 0.0),
        };
        let new = match is_rate {
            true => Held { value: here, slope: value, curvature: slope, since: t },
            false => Held { value, slope, curvature, since: t },
        };
        let under = input.place().map_or(input, |(place, _)| PLACES[place][0]);
        self.held[under as usize] = Some(new);
        self.set = self.count();
    }

    /// Lets an input follow the scene again, a place and its rate together.
    pub(crate) fn release(&mut self, input: Input) {
        let under = input.place().map_or(input, |(place, _)| PLACES[place][0]);
        self.held[under as usize] = None;
        self.set = self.count();
    }

    fn count(&self) -> u64 {
        self.held.iter().flatten().count() as u64
    }

    /// Whether it has set any.
    #[inline]
    pub fn sets_any(&self) -> bool {
        self.set > 0
    }
}

stored! {
    impl[] Held { value, slope, curvature, since }
}

stored! {
    impl[] HostInputs { held, set, anchor }
    if |host| host.set == host.count()
}
