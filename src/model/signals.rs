//! What inputs follow: quantities that follow the scene's functions of time unless the host takes them over, and
//! what follows from them: the prescribed motion of kinematic elements.

use crate::bodies::{HostInputs, Input, InputValues, PLACES, SPEEDS};
use crate::laws::fluid::Fluid;
use crate::laws::fluid::grease::Thickener;
use crate::laws::fluid::walther::Walther;
use crate::scene::{Scene, Signal, SignalIntegral, Viscosity, interpolate, slope};

/// Where the value of an input comes from when the host does not set it.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum InputSource {
    /// A function of time.
    Time(Signal),
    /// The rate of one.
    RateOf(Signal),
    /// Points (rad/s, unit of the input) over the magnitude of the ring speed.
    RingSpeed(Vec<f64>, Vec<f64>),
}

impl InputSource {
    /// The function of time that it follows, if it follows one.
    fn signal(&self) -> Option<&Signal> {
        match self {
            Self::Time(signal) | Self::RateOf(signal) => Some(signal),
            Self::RingSpeed(..) => None,
        }
    }
}

/// Prescribed orbit of kinematic elements: the sum of what its drives do.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Orbit {
    pub(super) drive: Drive,
    /// That by an outer ring that turns.
    pub(super) by_outer: Option<Drive>,
    /// Angle of the inner ring, where something follows it.
    pub(super) inner: Option<Turning>,
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
    Orbit(Box<Orbit>),
    /// Angles of outer and inner ring, where something follows them.
    Angles(Box<[Option<Turning>; 2]>),
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
    /// Which of [`PLACES`] are prescribed, and how.
    places: Vec<(usize, Signal)>,
}

impl InputSignals {
    /// Those of this list; what is constant is found once.
    pub(super) fn new(list: Vec<(Input, InputSource)>, beside: Beside, oil: Option<Oil>) -> Self {
        let steady = |(_, source): &(Input, InputSource)| {
            source.signal().is_none_or(|signal| matches!(signal, Signal::Constant(_)))
        };
        let steady = list.iter().all(steady);
        let place = |(input, source): &(Input, InputSource)| match input.place() {
            Some((place, false)) => Some((place, source.signal()?.clone())),
            _ => None,
        };
        let places = list.iter().filter_map(place).collect();
        let mut signals = Self { list, beside, oil, start: InputValues::default(), steady, places };
        let mut start = InputValues::default();
        signals.follow(0.0, &HostInputs::default(), &mut start);
        signals.start = start;
        signals
    }

    /// Finds the values of the list one by one.
    fn follow(&self, t: f64, host: &HostInputs, now: &mut InputValues) {
        for (input, source) in &self.list {
            now.values[*input as usize] = match (host.of(*input, t), source) {
                (Some([value, _]), _) => value,
                (None, InputSource::Time(signal)) => signal.at(t),
                (None, InputSource::RateOf(signal)) => signal.rate(t),
                (None, InputSource::RingSpeed(speed, value)) => {
                    interpolate(speed, value, now.of(Input::RingSpeed).abs())
                }
            };
        }
        for (place, signal) in &self.places {
            now.second[*place] = host.second_of(*place).unwrap_or_else(|| signal.higher_rates(t)[0]);
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
        if self.places.is_empty() {
            now.take_general(&self.start);
        } else {
            *now = self.start;
        }
        if !self.steady || host.sets_any() {
            self.follow(t, host, now);
        }
        match &self.beside {
            Beside::Nothing => {}
            Beside::Orbit(orbit) => {
                orbit.follow(now);
                now.angles[0] = orbit.travel(t, host);
                if let Some(inner) = &orbit.inner {
                    now.angles[1] = host.anchor[2] + inner.since(host.anchor[0], t, host);
                    now.speeding[1] = self.rate_of(Input::RingSpeed, t, host);
                }
            }
            Beside::Angles(angles) => {
                now.angles = turned(angles, t, host);
                now.speeding = SPEEDS.map(|input| self.rate_of(input, t, host));
            }
        }
    }

    /// Rates of what [`InputSignals::at`] gives, per second.
    pub(super) fn rates_at(&self, t: f64, host: &HostInputs) -> InputValues {
        let mut rates = InputValues::default();
        for (input, source) in &self.list {
            rates.values[*input as usize] = match (host.of(*input, t), source) {
                (Some([_, rate]), _) => rate,
                (None, InputSource::Time(signal)) => signal.rate(t),
                (None, InputSource::RateOf(signal)) => signal.higher_rates(t)[0],
                (None, InputSource::RingSpeed(speed, value)) => {
                    let now = self.at(t, host).of(Input::RingSpeed);
                    slope(speed, value, now.abs()) * now.signum() * rates.of(Input::RingSpeed)
                }
            };
        }
        for (place, signal) in &self.places {
            if host.second_of(*place).is_none() {
                rates.second[*place] = signal.higher_rates(t)[1];
            }
        }
        match &self.beside {
            Beside::Nothing => {}
            Beside::Orbit(orbit) => {
                orbit.follow(&mut rates);
                let now = self.at(t, host);
                rates.angles = [Input::OrbitSpeed, Input::RingSpeed].map(|input| now.of(input));
                rates.speeding =
                    SPEEDS.map(|input| self.signal_of(input).map_or(0.0, |s| s.higher_rates(t)[0]));
            }
            Beside::Angles(_) => {
                let now = self.at(t, host);
                rates.angles = SPEEDS.map(|input| now.of(input));
                rates.speeding =
                    SPEEDS.map(|input| self.signal_of(input).map_or(0.0, |s| s.higher_rates(t)[0]));
            }
        }
        rates
    }

    /// How all values change with one of them, at time `t` (s), where angles and second rates stay.
    pub(super) fn direction(&self, input: Input, t: f64, host: &HostInputs) -> InputValues {
        let mut by = InputValues::default();
        by.values[input as usize] = 1.0;
        for (other, source) in &self.list {
            if let (InputSource::RingSpeed(speed, value), Input::RingSpeed, false) =
                (source, input, host.holds(*other))
            {
                let now = self.at(t, host).of(Input::RingSpeed);
                by.values[*other as usize] = slope(speed, value, now.abs()) * now.signum();
            }
        }
        if let Beside::Orbit(orbit) = &self.beside {
            orbit.follow(&mut by);
        }
        by
    }

    /// What an input follows over time, if the scene gives it so.
    fn signal_of(&self, input: Input) -> Option<&Signal> {
        self.list.iter().find(|(i, _)| *i == input).and_then(|(_, source)| source.signal())
    }

    /// Rate of an input that is a speed at time `t` (s), per second.
    fn rate_of(&self, input: Input, t: f64, host: &HostInputs) -> f64 {
        let by_scene = || self.signal_of(input).map_or(0.0, |signal| signal.rate(t));
        host.of(input, t).map_or_else(by_scene, |[_, rate]| rate)
    }

    /// The first jump or kink after `t`, s.
    pub(super) fn next_event(&self, t: f64, host: &HostInputs) -> f64 {
        if self.steady {
            return f64::INFINITY;
        }
        let followed = self.list.iter().filter(|(input, _)| !host.holds(*input));
        followed
            .map(|(_, source)| match source {
                InputSource::Time(signal) | InputSource::RateOf(signal) => signal.next_event(t),
                InputSource::RingSpeed(speed, _) => self.next_speed(t, speed, host),
            })
            .fold(f64::INFINITY, f64::min)
    }

    /// The first time after `t` (s) at which the magnitude of the ring speed passes one of these (rad/s).
    fn next_speed(&self, t: f64, speeds: &[f64], host: &HostInputs) -> f64 {
        let ring = self.list.iter().find(|(input, _)| *input == Input::RingSpeed);
        let Some((_, InputSource::Time(signal))) = ring else { return f64::INFINITY };
        if host.holds(Input::RingSpeed) {
            return f64::INFINITY;
        }
        let both = speeds.iter().flat_map(|speed| [*speed, -speed]);
        both.map(|speed| signal.next_passage(t, speed)).fold(f64::INFINITY, f64::min)
    }

    /// Shortest period of the sines that are followed, s; infinity without any.
    pub(super) fn shortest_period(&self, host: &HostInputs) -> f64 {
        if self.steady {
            return f64::INFINITY;
        }
        let followed = self.list.iter().filter(|(input, _)| !host.holds(*input));
        followed
            .filter_map(|(_, source)| source.signal())
            .fold(f64::INFINITY, |shortest, signal| shortest.min(signal.period()))
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

    /// Sets an input at time `t` in s to a value that goes on with a slope, per second, or releases it. The elements stay where they are.
    pub(super) fn set(&self, host: &mut HostInputs, t: f64, input: Input, to: Option<(f64, Option<f64>)>) {
        let [first, second] = match &self.beside {
            Beside::Nothing => [0.0; 2],
            Beside::Orbit(orbit) => {
                let turned = orbit.inner.as_ref().map_or(0.0, |inner| inner.since(host.anchor[0], t, host));
                [orbit.travel(t, host), host.anchor[2] + turned]
            }
            Beside::Angles(angles) => turned(angles, t, host),
        };
        let here = input.place().map_or(0.0, |(place, _)| self.at(t, host).of(PLACES[place][0]));
        host.anchor = [t, first, second];
        match to {
            Some((value, slope)) => host.hold(input, t, [value, here], slope),
            None => host.release(input),
        }
    }

    /// Largest magnitude of an input by the scene; zero for one it does not have.
    pub(super) fn largest(&self, input: Input) -> f64 {
        self.list.iter().find(|(i, _)| *i == input).map_or(0.0, |(_, source)| match source {
            InputSource::Time(signal) => signal.largest(),
            InputSource::RateOf(_) => 0.0,
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

/// Angles of outer and inner ring at time `t` in s, rad; zero where nothing follows them.
fn turned(angles: &[Option<Turning>; 2], t: f64, host: &HostInputs) -> [f64; 2] {
    let [since, outer, inner] = host.anchor;
    let angle = |turning: &Option<Turning>, before: f64| {
        turning.as_ref().map_or(0.0, |turning| before + turning.since(since, t, host))
    };
    [angle(&angles[0], outer), angle(&angles[1], inner)]
}

impl Turning {
    /// That of an input which follows this signal.
    pub(super) fn new(input: Input, signal: &Signal) -> Self {
        Self { input, integral: SignalIntegral::new(signal) }
    }

    /// Angle from time `since` to time `t` (s), rad.
    #[inline(always)]
    fn since(&self, since: f64, t: f64, host: &HostInputs) -> f64 {
        host.turned(self.input, since, t).unwrap_or_else(|| self.integral.at(t) - self.integral.at(since))
    }
}
