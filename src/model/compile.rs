//! From the scene to bodies, pairs, coordinates and inputs.

use super::report::Selection;
use super::signals::{Drive, InputSignals, InputSource, Oil, Orbit};
use super::{Input, Model};
use crate::bodies::{self, OUTER_RING, SharedBodies};
use crate::error::Result;
use crate::laws::fluid::walther::Walther;
use crate::pairs;
use crate::scalar::math;
use crate::scene::{ElementMotion, RingMotion, Scene, Signal, SignalIntegral};
use crate::scene::{Temperature, VISCOSITY, Viscosity, bad_scene, interpolate};

/// Builds the model of a checked scene.
pub(super) fn compile(scene: Scene) -> Result<Model> {
    let elements = bodies::elements(&scene);
    let shared = bodies::shared_bodies(&scene, elements.set());
    let nodes = bodies::nodes(&scene);
    let inputs = inputs(&scene)?;
    let viscosity = viscosity_at_start(&scene, &inputs);
    let (pairs, between) =
        (pairs::element_pairs(&scene, viscosity)?, pairs::shared_pairs(&scene, viscosity)?);
    let mut model = Model {
        masses: shared.each_ref().map(|body| body.as_ref().and_then(|b| b.mass()).unwrap_or(f64::INFINITY)),
        outer_turns: turns(&shared, OUTER_RING),
        onsets: pairs.iter().any(|pair| pair.has_onset()),
        layout: bodies::layout_of(&shared, &*elements, &nodes),
        gravity: scene.gravity.map_or([0.0; 2], |g| [g.y, g.z]),
        shared,
        mobility: elements.mobility(),
        elements,
        lubricant: None,
        nodes,
        infos: pairs.iter().map(|pair| pair.info()).collect(),
        parts: pairs.iter().map(|pair| pair.law().parts()).collect(),
        laws: pairs.iter().map(|pair| pair.law()).collect(),
        pairs,
        between_infos: between.iter().map(|pair| pair.info()).collect(),
        between,
        inputs,
        channels: Vec::new(),
        selection: Selection::default(),
        scene,
    };
    let lubricant = model.nodes_in().find_map(|(node, at)| Some(at.start + node.lubricant()?));
    model.lubricant = lubricant;
    model.channels = model.list_channels();
    model.selection =
        Selection::new(&model.scene.record, &model.channels, &model.infos, model.element_count())?;
    Ok(model)
}

/// Whether the rotation of a shared body is prescribed.
fn turns(shared: &SharedBodies, place: usize) -> bool {
    shared[place].as_ref().is_some_and(|body| body.turned_by().is_some())
}

/// Viscosity that laws are built with, Pa s.
fn viscosity_at_start(scene: &Scene, inputs: &InputSignals) -> Option<f64> {
    match (&inputs.oil, scene.lubricant.as_ref().map(|l| &l.viscosity)) {
        (Some(oil), _) => Some(oil.built_at.1),
        (None, Some(Viscosity::Constant(value))) => Some(*value),
        _ => None,
    }
}

/// The inputs in the order of [`Input`].
fn inputs(scene: &Scene) -> Result<InputSignals> {
    let mut list = Vec::new();
    let mut add = |input: Input, signal: &Signal| list.push((input, InputSource::Time(signal.clone())));
    let outer_speed = scene.outer_ring.as_ref().and_then(|ring| ring.speed.as_ref());
    if let Some(ring) = &scene.inner_ring {
        add(Input::RingSpeed, &ring.speed);
    }
    if let Some(speed) = outer_speed {
        add(Input::OuterRingSpeed, speed);
    }
    if let Some(RingMotion::Free(free)) = scene.inner_ring.as_ref().map(|ring| &ring.motion) {
        let none = Signal::Constant(0.0);
        let (y, z) = free.load.as_ref().map_or((&none, &none), |load| (&load.y, &load.z));
        add(Input::LoadY, y);
        add(Input::LoadZ, z);
    }
    if let Some(load) = scene.cage.as_ref().and_then(|cage| cage.load.as_ref()) {
        add(Input::CageForceY, &load.force_y);
        add(Input::CageForceZ, &load.force_z);
        add(Input::CageTorque, &load.torque);
    }
    let mut orbit = None;
    if let Some(elements) = &scene.kinematic_elements {
        match &elements.motion {
            ElementMotion::Prescribed { orbit_speed, spin_speed } => {
                add(Input::OrbitSpeed, orbit_speed);
                add(Input::SpinSpeed, spin_speed);
                let drive = Drive {
                    input: Input::OrbitSpeed,
                    orbit_ratio: 1.0,
                    spin_ratio: None,
                    integral: SignalIntegral::new(orbit_speed),
                };
                orbit = Some(Orbit { drive, by_outer: None });
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
    Ok(InputSignals::new(list, orbit, oil))
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
        input,
        orbit_ratio,
        spin_ratio: Some(spin_ratio),
        integral: SignalIntegral::new(speed),
    };
    let outer = scene.outer_ring.as_ref().and_then(|ring| ring.speed.as_ref());
    Orbit {
        drive: drive(Input::RingSpeed, orbit_ratio, spin_ratio, &inner),
        by_outer: outer.map(|speed| drive(Input::OuterRingSpeed, 1.0 - orbit_ratio, 1.0 - spin_ratio, speed)),
    }
}
