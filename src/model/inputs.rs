//! Inputs of a model: from the scene to functions of time, and what hosts may set.

use super::signals::{Beside, Drive, InputSignals, InputSource, Oil, Orbit, Turning};
use super::{HostInputs, Input, InputValues, Model, StateInfo};
use crate::bodies::{OF_RING, PLACES};
use crate::error::{Error, Result, Status};
use crate::laws::fluid::walther::Walther;
use crate::pairs;
use crate::scalar::math;
use crate::scene::{ElementMotion, FORCE, FreeRing, Load, MOMENT, OuterRingMotion, POSITION, PlaneMotion};
use crate::scene::{RingMotion, SPEED, Scene, Signal, TEMPERATURE, TILT, TORQUE, VELOCITY};
use crate::scene::{Temperature, VISCOSITY, Viscosity, bad_scene, interpolate};

impl Model {
    /// The inputs of this scene, in the order of their indices.
    pub fn input_list(&self) -> impl ExactSizeIterator<Item = Input> {
        self.inputs.list.iter().map(|(input, _)| *input)
    }

    /// Number of inputs.
    pub fn input_count(&self) -> usize {
        self.inputs.list.len()
    }

    /// Values of the inputs at time `t` in s.
    #[doc(hidden)]
    #[inline]
    pub fn inputs_at(&self, t: f64, host: &HostInputs) -> InputValues {
        self.inputs.at(t, host)
    }

    /// Finds [`Model::inputs_at`] in place.
    #[inline]
    pub(crate) fn find_inputs(&self, t: f64, host: &HostInputs, now: &mut InputValues) {
        self.inputs.find(t, host, now);
    }

    /// Rates of the inputs at time `t` in s, per second; of `orbit_travel` too. At a jump or kink they are those after it.
    #[doc(hidden)]
    pub fn input_rates_at(&self, t: f64, host: &HostInputs) -> InputValues {
        self.inputs.rates_at(t, host)
    }

    /// How all values change per unit of one of them: see [`Model::input_rates_at`].
    pub(crate) fn input_direction(&self, input: Input, t: f64, host: &HostInputs) -> InputValues {
        self.inputs.direction(input, t, host)
    }

    /// Sets an input at time `t` (s) to a value that goes on with a slope, per second, or lets it follow the scene again with `None`: see
    /// [`crate::Sim::set_input_slope`].
    #[doc(hidden)]
    pub fn set_input(&self, host: &mut HostInputs, t: f64, input: Input, to: Option<(f64, Option<f64>)>) {
        self.inputs.set(host, t, input, to);
    }

    /// Whether an input may have this value: those that scenes may give it.
    ///
    /// # Errors
    /// [`crate::Status::BadValue`].
    pub fn check_input(&self, input: Input, value: f64) -> Result<()> {
        let allowed = match input {
            Input::RingSpeed | Input::OuterRingSpeed | Input::OrbitSpeed | Input::SpinSpeed => SPEED,
            Input::LoadX | Input::LoadY | Input::LoadZ => FORCE,
            Input::CageForceX | Input::CageForceY | Input::CageForceZ => FORCE,
            Input::CageTorque => TORQUE,
            Input::MomentY | Input::MomentZ | Input::CageMomentY | Input::CageMomentZ => MOMENT,
            Input::Temperature => TEMPERATURE,
            Input::OuterLoadY | Input::OuterLoadZ | Input::RotorLoadY | Input::RotorLoadZ => FORCE,
            Input::RingX | Input::RingY | Input::RingZ | Input::OuterRingY | Input::OuterRingZ => POSITION,
            Input::RingVx | Input::RingVy | Input::RingVz | Input::OuterRingVy | Input::OuterRingVz => {
                VELOCITY
            }
            Input::RingTiltY | Input::RingTiltZ => TILT,
            Input::RingTiltSpeedY | Input::RingTiltSpeedZ => SPEED,
        };
        allowed.check("value", value).map_err(|e| Error::new(Status::BadValue, e.message))?;
        match self.inputs.oil.filter(|_| input == Input::Temperature).map(|oil| oil.law.viscosity(value)) {
            Some(viscosity) => VISCOSITY.check("value", viscosity).map_err(|e| {
                let text =
                    format!("value: at {value:?} K the viscosity{}", e.message.trim_start_matches("value:"));
                Error::new(Status::BadValue, text)
            }),
            None => Ok(()),
        }
    }

    /// The first jump or kink of an input after `t`, s; infinity if there is none.
    #[doc(hidden)]
    pub fn next_event(&self, t: f64, host: &HostInputs) -> f64 {
        self.inputs.next_event(t, host)
    }

    /// The inputs.
    pub fn input_infos(&self) -> Vec<StateInfo> {
        let named = self.input_list().map(|input| {
            let [unit, description] = input.meaning();
            StateInfo { name: input.name().to_owned(), unit, description }
        });
        named.collect()
    }

    /// Viscosity of the lubricant in Pa s at these inputs, if it follows the temperature.
    #[doc(hidden)]
    pub fn viscosity(&self, inputs: &InputValues) -> Option<f64> {
        self.inputs.viscosity(inputs)
    }
}

/// The inputs in the order of [`Input`].
pub(super) fn inputs(scene: &Scene) -> Result<InputSignals> {
    let mut list = Vec::new();
    let mut add = |input: Input, signal: &Signal| list.push((input, InputSource::Time(signal.clone())));
    let outer_speed = scene.outer_ring.as_ref().and_then(|ring| ring.speed.as_ref());
    if let Some(ring) = &scene.inner_ring {
        add(Input::RingSpeed, &ring.speed);
    }
    if let Some(speed) = outer_speed {
        add(Input::OuterRingSpeed, speed);
    }
    let none = Signal::Constant(0.0);
    let mut add_load = |[y, z]: [Input; 2], load: Option<&Option<Load>>| {
        if let Some(load) = load {
            add(y, load.as_ref().map_or(&none, |load| &load.y));
            add(z, load.as_ref().map_or(&none, |load| &load.z));
        }
    };
    add_load([Input::OuterLoadY, Input::OuterLoadZ], scene.free_outer_ring().map(|ring| &ring.load));
    add_load([Input::RotorLoadY, Input::RotorLoadZ], scene.rotor.as_ref().map(|rotor| &rotor.load));
    add_load([Input::LoadY, Input::LoadZ], scene.free_inner_ring().map(|ring| &ring.load));
    if let Some(RingMotion::Space(ring)) = scene.inner_ring.as_ref().map(|ring| &ring.motion) {
        let loads = [Input::LoadX, Input::LoadY, Input::LoadZ, Input::MomentY, Input::MomentZ];
        for (input, signal) in loads.into_iter().zip(ring.loads()) {
            add(input, signal.unwrap_or(&none));
        }
    }
    if let Some(load) = scene.cage.as_ref().and_then(|cage| cage.load.as_ref()) {
        add(Input::CageForceY, &load.force_y);
        add(Input::CageForceZ, &load.force_z);
        add(Input::CageTorque, &load.torque);
    }
    let space = scene.cage.as_ref().and_then(|cage| cage.space.as_ref());
    if let Some(load) = space.and_then(|space| space.load.as_ref()) {
        add(Input::CageForceX, &load.force_x);
        add(Input::CageMomentY, &load.moment_y);
        add(Input::CageMomentZ, &load.moment_z);
    }
    let mut orbit = None;
    if let Some(elements) = &scene.kinematic_elements {
        match &elements.motion {
            ElementMotion::Prescribed { orbit_speed, spin_speed } => {
                add(Input::OrbitSpeed, orbit_speed);
                add(Input::SpinSpeed, spin_speed);
                let speed = Turning::new(Input::OrbitSpeed, orbit_speed);
                let drive = Drive { speed, orbit_ratio: 1.0, spin_ratio: None };
                orbit = Some(Orbit { drive, by_outer: None, inner: None });
            }
            ElementMotion::Rolling { contact_angle } => {
                orbit = Some(rolling(elements.radius / elements.pitch_radius, *contact_angle, scene));
            }
        }
    }
    let oil = match scene.lubricant.as_ref().map(|lubricant| &lubricant.viscosity) {
        Some(Viscosity::Walther(walther)) => {
            let point = |p: crate::scene::ViscosityPoint| (p.temperature, p.kinematic_viscosity);
            let law = Walther::new(point(walther.cold), point(walther.hot), walther.density);
            let start = scene.heat.as_ref().map_or(f64::NAN, |heat| heat.lubricant_start());
            let warmed = Temperature::OverTime(Signal::Constant(start));
            let temperature = walther.temperature.as_ref().unwrap_or(&warmed);
            let (source, at_start) = match temperature {
                Temperature::OverTime(signal) => (InputSource::Time(signal.clone()), signal.at(0.0)),
                Temperature::OverSpeed { speed, temperature } => {
                    let ring = scene.inner_ring.as_ref().ok_or_else(|| {
                        bad_scene(
                            "inner_ring",
                            "missing; lubricant.viscosity.walther.temperature needs its speed",
                        )
                    })?;
                    let at_start = interpolate(speed, temperature, ring.speed.at(0.0).abs());
                    (InputSource::RingSpeed(speed.clone(), temperature.clone()), at_start)
                }
            };
            let (coldest, hottest) = match temperature {
                Temperature::OverTime(signal) => signal.bounds(),
                Temperature::OverSpeed { temperature, .. } => {
                    temperature.iter().fold((f64::INFINITY, 0.0), |(a, b), t| (t.min(a), t.max(b)))
                }
            };
            for extreme in [coldest, hottest] {
                let viscosity = law.viscosity(extreme);
                if !(VISCOSITY.min..=VISCOSITY.max).contains(&viscosity) {
                    let value = if viscosity.is_nan() {
                        "no viscosity".to_owned()
                    } else {
                        format!("{viscosity:e} Pa s")
                    };
                    let text = format!(
                        "the oil has {value} at {extreme:?} K, allowed are {:e} to {:e} Pa s; too far from its two points",
                        VISCOSITY.min, VISCOSITY.max
                    );
                    return Err(bad_scene("lubricant.viscosity.walther.temperature", text));
                }
            }
            if !scene.heat.as_ref().is_some_and(|heat| heat.in_motion.contains(&heat.lubricant)) {
                list.push((Input::Temperature, source));
            }
            let viscosity = law.viscosity(at_start);
            let grease = scene.lubricant.as_ref().and_then(|lubricant| lubricant.grease.as_ref());
            let thickener = grease.map(|grease| pairs::line_laws::thickener(grease, viscosity));
            Some(Oil { law, built_at: (at_start, viscosity), thickener })
        }
        _ => None,
    };
    let places = prescribed(scene);
    list.extend(places.iter().map(|(k, signal)| (PLACES[*k][0], InputSource::Time(signal.clone()))));
    list.extend(places.iter().map(|(k, signal)| (PLACES[*k][1], InputSource::RateOf(signal.clone()))));
    let angles = angles(scene);
    let beside = match orbit {
        Some(orbit) => {
            let [_, inner] = angles;
            Beside::Orbit(Box::new(Orbit { inner, ..orbit }))
        }
        None if angles == [None, None] => Beside::Nothing,
        None => Beside::Angles(Box::new(angles)),
    };
    Ok(InputSignals::new(list, beside, oil))
}

/// Rings whose raceways are wavy, or that are unbalanced, which makes their angles count.
fn angles(scene: &Scene) -> [Option<Turning>; 2] {
    let unbalanced = |ring: Option<&FreeRing>| ring.is_some_and(|ring| ring.unbalance.is_some());
    let outer = scene.outer_ring.as_ref().filter(|ring| ring.wavy() || unbalanced(scene.free_outer_ring()));
    let inner = scene.inner_ring.as_ref().filter(|ring| {
        let rotor = scene.rotor.as_ref().is_some_and(|rotor| rotor.unbalance.is_some());
        ring.wavy() || unbalanced(scene.free_inner_ring()) || rotor
    });
    [
        outer.and_then(|ring| Some(Turning::new(Input::OuterRingSpeed, ring.speed.as_ref()?))),
        inner.map(|ring| Turning::new(Input::RingSpeed, &ring.speed)),
    ]
}

/// Which of [`PLACES`] are prescribed over time, and how.
fn prescribed(scene: &Scene) -> Vec<(usize, Signal)> {
    let mut list = Vec::new();
    match scene.inner_ring.as_ref().map(|ring| &ring.motion) {
        Some(RingMotion::Space(ring)) => {
            for (k, (_, coordinate)) in ring.coordinates().into_iter().enumerate() {
                list.extend(coordinate.prescribed().map(|signal| (k, signal.clone())));
            }
        }
        Some(RingMotion::Prescribed(PlaneMotion { y, z })) => list.extend([(1, y.clone()), (2, z.clone())]),
        _ => {}
    }
    if let Some(OuterRingMotion::Prescribed(PlaneMotion { y, z })) = scene.outer_motion() {
        list.extend([(OF_RING, y.clone()), (OF_RING + 1, z.clone())]);
    }
    list
}

/// Elements that roll without slip on both rings; `radius_ratio` is element over pitch radius.
///
/// The spin is the component along the bearing axis of the rotation about the axis across the contact line, and the
/// rotation of that axis with the orbit. Seen from the outer ring the inner one turns at the difference of their speeds, so the
/// shares of both rings in orbit and spin add up to one.
fn rolling(radius_ratio: f64, contact_angle: f64, scene: &Scene) -> Orbit {
    let cos = math::cos(contact_angle);
    let gamma = radius_ratio * cos;
    let orbit_ratio = 0.5 * (1.0 - gamma);
    let spin_ratio = orbit_ratio - 0.5 / radius_ratio * (1.0 - gamma * gamma) * cos;
    let inner = scene.inner_ring.as_ref().map_or(Signal::Constant(0.0), |ring| ring.speed.clone());
    let drive = |input, orbit_ratio, spin_ratio, speed: &Signal| Drive {
        speed: Turning::new(input, speed),
        orbit_ratio,
        spin_ratio: Some(spin_ratio),
    };
    let outer = scene.outer_ring.as_ref().and_then(|ring| ring.speed.as_ref());
    Orbit {
        drive: drive(Input::RingSpeed, orbit_ratio, spin_ratio, &inner),
        by_outer: outer.map(|speed| drive(Input::OuterRingSpeed, 1.0 - orbit_ratio, 1.0 - spin_ratio, speed)),
        inner: None,
    }
}
