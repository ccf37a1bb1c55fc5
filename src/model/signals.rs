//! What inputs follow: quantities that follow the scene's functions of time unless the host takes them over, and
//! what follows from them: the prescribed motion of kinematic elements.

use crate::bodies::{HostInputs, Input, InputValues};
use crate::laws::fluid::Fluid;
use crate::laws::fluid::grease::Thickener;
use crate::laws::fluid::walther::Walther;
use crate::scene::{Scene, Signal, SignalIntegral, Viscosity, interpolate, slope};

/// Where the value of an input comes from when the host does not set it.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum InputSource {
    /// A function of time.
    Time(Signal),
    /// Points (rad/s, unit of the input) over the magnitude of the ring speed.
    RingSpeed(Vec<f64>, Vec<f64>),
}

/// Prescribed orbit of kinematic elements: the sum of what its drives do.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Orbit {
    pub(super) drive: Drive,
    /// That by an outer ring that turns.
    pub(super) by_outer: Option<Drive>,
}

/// What drives the orbit of kinematic elements.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Drive {
    /// The input that drives it, and orbit speed per unit of it.
    pub(super) speed: Turning,
    pub(super) orbit_ratio: f64,
    /// Spin speed per unit of the input; `None` if it is an input of its own.
    pub(super) spin_ratio: Option<f64>,
}

/// An input that is a speed, with its integral.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Turning {
    pub(super) input: Input,
    pub(super) integral: SignalIntegral,
}

/// What follows time beside the inputs.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Beside {
    Nothing,
    /// Kinematic elements.
    Orbit(Orbit),
    /// A bearing in space.
    Space(Box<InSpace>),
}

/// What follows time in a bearing in space beside its inputs.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct InSpace {
    /// Angles of outer and inner ring, where something follows them.
    pub(super) angles: [Option<Turning>; 2],
    /// Prescribed coordinates of the inner ring.
    pub(super) ring: Vec<Signal>,
}

/// Viscosity that follows the temperature.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Oil {
    pub(super) law: Walther,
    /// Temperature (K) and viscosity (Pa s) that the laws were built with.
    pub(super) built_at: (f64, f64),
    /// What thickens it where it is sheared.
    pub(super) thickener: Option<Thickener>,
}

impl Oil {
    /// The lubricant at a temperature in K, against that which laws were built with; its viscosity is NaN where the law has none.
    pub(super) fn fluid_at(&self, temperature: f64) -> Fluid {
        let fluid = Fluid::new(self.law.viscosity(temperature) / self.built_at.1);
        Fluid { structure: self.thickener.map_or(1.0, |law| law.structure(temperature)), ..fluid }
    }
}

/// The inputs that a scene has.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct InputSignals {
    /// In the order of [`Input`]; the ring speed comes first where it exists.
    pub(super) list: Vec<(Input, InputSource)>,
    pub(super) beside: Beside,
    /// Oil whose viscosity follows the temperature.
    pub(super) oil: Option<Oil>,
    /// Values of the list at the start.
    pub(super) start: InputValues,
    /// Whether these do not follow time.
    pub(super) steady: bool,
}

impl InputSignals {
    /// Those of this list; what is constant is found once.
    pub(super) fn new(list: Vec<(Input, InputSource)>, beside: Beside, oil: Option<Oil>) -> Self {
        let steady = |(_, source): &(Input, InputSource)| match source {
            InputSource::Time(signal) => matches!(signal, Signal::Constant(_)),
            InputSource::RingSpeed(..) => true,
        };
        let steady = list.iter().all(steady);
        let mut signals = Self { list, beside, oil, start: InputValues::default(), steady };
        let mut start = InputValues::default();
        signals.follow(0.0, &HostInputs::default(), &mut start);
        signals.start = start;
        signals
    }

    /// Finds the values of the list one by one.
    fn follow(&self, t: f64, host: &HostInputs, now: &mut InputValues) {
        for (input, source) in &self.list {
            now.values[*input as usize] = match (host.of(*input), source) {
                (Some(value), _) => value,
                (None, InputSource::Time(signal)) => signal.at(t),
                (None, InputSource::RingSpeed(speed, value)) => {
                    interpolate(speed, value, now.of(Input::RingSpeed).abs())
                }
            };
        }
    }

    /// All values at time `t` in s.
    #[inline]
    pub(crate) fn at(&self, t: f64, host: &HostInputs) -> InputValues {
        let mut now = InputValues::default();
        self.find(t, host, &mut now);
        now
    }

    /// Finds [`InputSignals::at`] in place: every evaluation of forces asks.
    #[inline]
    pub(super) fn find(&self, t: f64, host: &HostInputs, now: &mut InputValues) {
        *now = self.start;
        if !self.steady || host.sets_any() {
            self.follow(t, host, now);
        }
        match &self.beside {
            Beside::Nothing => {}
            Beside::Orbit(orbit) => {
                orbit.follow(now);
                now.angles[0] = orbit.travel(t, host);
            }
            Beside::Space(space) => {
                now.angles = space.turned(t, host);
                now.time = t;
            }
        }
    }

    /// Rates of what [`InputSignals::at`] gives, per second.
    pub(super) fn rates_at(&self, t: f64, host: &HostInputs) -> InputValues {
        let mut rates = InputValues::default();
        for (input, source) in &self.list {
            rates.values[*input as usize] = match (host.of(*input), source) {
                (Some(_), _) => 0.0,
                (None, InputSource::Time(signal)) => signal.rate(t),
                (None, InputSource::RingSpeed(speed, value)) => {
                    let now = self.at(t, host).of(Input::RingSpeed);
                    slope(speed, value, now.abs()) * now.signum() * rates.of(Input::RingSpeed)
                }
            };
        }
        match &self.beside {
            Beside::Nothing => {}
            Beside::Orbit(orbit) => {
                orbit.follow(&mut rates);
                rates.angles[0] = self.at(t, host).of(Input::OrbitSpeed);
            }
            Beside::Space(_) => {
                let now = self.at(t, host);
                rates.angles = [Input::OuterRingSpeed, Input::RingSpeed].map(|input| now.of(input));
            }
        }
        rates
    }

    /// The first jump or kink after `t`, s.
    pub(super) fn next_event(&self, t: f64, host: &HostInputs) -> f64 {
        let first = self.of_ring(|signal| signal.next_event(t));
        if self.steady {
            return first;
        }
        let followed = self.list.iter().filter(|(input, _)| host.of(*input).is_none());
        followed
            .map(|(_, source)| match source {
                InputSource::Time(signal) => signal.next_event(t),
                InputSource::RingSpeed(speed, _) => self.next_speed(t, speed, host),
            })
            .fold(first, f64::min)
    }

    /// The first time after `t` (s) at which the magnitude of the ring speed passes one of these (rad/s).
    fn next_speed(&self, t: f64, speeds: &[f64], host: &HostInputs) -> f64 {
        let ring = self.list.iter().find(|(input, _)| *input == Input::RingSpeed);
        let Some((_, InputSource::Time(signal))) = ring else { return f64::INFINITY };
        if host.of(Input::RingSpeed).is_some() {
            return f64::INFINITY;
        }
        let both = speeds.iter().flat_map(|speed| [*speed, -speed]);
        both.map(|speed| signal.next_passage(t, speed)).fold(f64::INFINITY, f64::min)
    }

    /// The least of a number of every prescribed coordinate of a ring; infinity without any.
    fn of_ring(&self, number: impl Fn(&Signal) -> f64) -> f64 {
        let list = match &self.beside {
            Beside::Space(space) => &space.ring[..],
            _ => &[],
        };
        list.iter().map(number).fold(f64::INFINITY, f64::min)
    }

    /// Shortest period of the sines that are followed, s; infinity without any.
    pub(super) fn shortest_period(&self, host: &HostInputs) -> f64 {
        let shortest = self.of_ring(Signal::period);
        if self.steady {
            return shortest;
        }
        let followed = self.list.iter().filter(|(input, _)| host.of(*input).is_none());
        followed
            .map(|(_, source)| match source {
                InputSource::Time(signal) => signal.period(),
                InputSource::RingSpeed(..) => f64::INFINITY,
            })
            .fold(shortest, f64::min)
    }

    /// Viscosity that the laws of a scene are built with, Pa s.
    pub(super) fn viscosity_at_start(&self, scene: &Scene) -> Option<f64> {
        match (&self.oil, scene.lubricant.as_ref().map(|l| &l.viscosity)) {
            (Some(oil), _) => Some(oil.built_at.1),
            (None, Some(Viscosity::Constant(value))) => Some(*value),
            _ => None,
        }
    }

    /// Viscosity of the lubricant in Pa s at these inputs, if it follows the temperature.
    pub(super) fn viscosity(&self, inputs: &InputValues) -> Option<f64> {
        self.oil.map(|oil| oil.law.viscosity(inputs.of(Input::Temperature)))
    }

    /// Sets or releases an input at time `t` in s. The elements stay where they are.
    pub(super) fn set(&self, host: &mut HostInputs, t: f64, input: Input, value: Option<f64>) {
        let [first, second] = match &self.beside {
            Beside::Nothing => [0.0; 2],
            Beside::Orbit(orbit) => [orbit.travel(t, host), 0.0],
            Beside::Space(space) => space.turned(t, host),
        };
        host.anchor = [t, first, second];
        host.hold(input, value);
    }

    /// Largest magnitude of an input by the scene; zero for one it does not have.
    pub(super) fn largest(&self, input: Input) -> f64 {
        self.list.iter().find(|(i, _)| *i == input).map_or(0.0, |(_, source)| match source {
            InputSource::Time(signal) => signal.largest(),
            InputSource::RingSpeed(_, value) => value.iter().fold(0.0, |m, v| m.max(v.abs())),
        })
    }
}

impl Orbit {
    /// Sets orbit and spin speed, or their rates, to what the drives make them.
    fn follow(&self, inputs: &mut InputValues) {
        let speed = inputs.of(self.drive.speed.input);
        let mut orbit = self.drive.orbit_ratio * speed;
        let mut spin = self.drive.spin_ratio.map(|ratio| ratio * speed);
        if let Some(drive) = &self.by_outer {
            let speed = inputs.of(drive.speed.input);
            orbit += drive.orbit_ratio * speed;
            spin = spin.zip(drive.spin_ratio).map(|(sum, ratio)| sum + ratio * speed);
        }
        inputs.values[Input::OrbitSpeed as usize] = orbit;
        if let Some(spin) = spin {
            inputs.values[Input::SpinSpeed as usize] = spin;
        }
    }

    #[inline]
    fn travel(&self, t: f64, host: &HostInputs) -> f64 {
        let [since, before, _] = host.anchor;
        let turned = |drive: &Drive| drive.speed.since(since, t, host);
        let travel = before + self.drive.orbit_ratio * turned(&self.drive);
        match &self.by_outer {
            None => travel,
            Some(drive) => travel + drive.orbit_ratio * turned(drive),
        }
    }
}

impl InSpace {
    /// Angles of outer and inner ring at time `t` in s, rad; zero where nothing follows them.
    fn turned(&self, t: f64, host: &HostInputs) -> [f64; 2] {
        let [since, outer, inner] = host.anchor;
        let angle = |turning: &Option<Turning>, before: f64| {
            turning.as_ref().map_or(0.0, |turning| before + turning.since(since, t, host))
        };
        [angle(&self.angles[0], outer), angle(&self.angles[1], inner)]
    }
}

impl Turning {
    /// That of an input which follows this signal.
    pub(super) fn new(input: Input, signal: &Signal) -> Self {
        Self { input, integral: SignalIntegral::new(signal) }
    }

    /// Angle from time `since` to time `t` (s), rad.
    #[inline(always)]
    fn since(&self, since: f64, t: f64, host: &HostInputs) -> f64 {
        match host.of(self.input) {
            Some(speed) => speed * (t - since),
            None => self.integral.at(t) - self.integral.at(since),
        }
    }
}
