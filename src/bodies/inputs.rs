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

/// Values of the inputs at one instant, and what follows from them.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct InputValues {
    /// Values by [`Input`]; zero for inputs that the model does not have. Orbit and spin speed are those of rolling
    /// where the scene asks for it.
    pub values: [f64; INPUTS],
    /// Angles since the start that follow from speeds, rad: orbit of kinematic elements in the plane; turning of outer and inner ring in space,
    /// where something asks for it.
    pub angles: [f64; 2],
    /// Time, s, where something follows it beside the inputs; else zero.
    pub time: f64,
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
}

/// Values set by the host.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct HostInputs {
    /// By [`Input`]; `None` follows the scene.
    values: [Option<f64>; INPUTS],
    /// How many are set.
    set: u64,
    /// Time (s) and [`InputValues::angles`] (rad) from which these count on.
    pub anchor: [f64; 3],
}

impl HostInputs {
    /// Value that the host has set, if it has.
    #[inline]
    pub fn of(&self, input: Input) -> Option<f64> {
        self.values[input as usize]
    }

    /// Sets a value, or lets it follow the scene again with `None`.
    pub(crate) fn hold(&mut self, input: Input, value: Option<f64>) {
        self.values[input as usize] = value;
        self.set = self.count();
    }

    fn count(&self) -> u64 {
        self.values.iter().flatten().count() as u64
    }

    /// Whether it has set any.
    #[inline]
    pub fn sets_any(&self) -> bool {
        self.set > 0
    }
}

stored! {
    impl[] HostInputs { values, set, anchor }
    if |host| host.set == host.count()
}
