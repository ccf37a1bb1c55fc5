//! The heat balance of a scene in numbers: its network, what warms each lump, and lumps whose temperature moves with the bearing.

mod lumps;

pub(crate) use lumps::Lumps;

use super::Power;
use crate::laws::bearing_torque::{Palmgren, ball_conductance};
use crate::laws::fluid::walther::Walther;
use crate::laws::heat_network::{Conducts, HeatNetwork, Inflow, Link};
use crate::scalar::math;
use crate::scene::{Conductance, ElementMotion, Heat, Scene, Viscosity};

/// Network and sources of a checked scene that has a heat balance.
#[derive(Clone, Debug)]
pub(crate) struct HeatBudget {
    pub(crate) network: HeatNetwork,
    /// Power, lump and share of every source.
    pub(crate) sources: Vec<(Power, usize, f64)>,
    pub(crate) friction: Option<BearingFriction>,
    /// Place of the lubricant's lump.
    pub(crate) lubricant: usize,
    /// Kinematic viscosity of the lubricant over the temperature.
    pub(crate) oil: Walther,
    /// Temperatures of all lumps at the start, K.
    pub(crate) start: Vec<f64>,
}

/// Friction of the whole bearing by catalogue values, and the lumps that it warms.
#[derive(Clone, Copy, Debug)]
pub(crate) struct BearingFriction {
    law: Palmgren,
    oil: Walther,
    /// Inner and outer ring.
    rings: [usize; 2],
    inner_share: f64,
    /// Elements, and their share of the torque by load.
    elements: Option<(usize, f64)>,
    /// What the torque without load warms instead.
    without_load: Option<usize>,
}

impl HeatBudget {
    /// That of a checked scene at this speed of the inner ring, rad/s; `None` where it has none.
    pub(crate) fn of(scene: &Scene, speed: f64) -> Option<Self> {
        let heat = scene.heat.as_ref()?;
        let lubricant = scene.lubricant.as_ref()?;
        let Viscosity::Walther(w) = &lubricant.viscosity else { return None };
        let point = |p: crate::scene::ViscosityPoint| (p.temperature, p.kinematic_viscosity);
        let oil = Walther::new(point(w.cold), point(w.hot), 1.0);
        let power = |name: &str| Power::ALL.into_iter().find(|power| power.name() == name);
        let sources = heat
            .sources
            .iter()
            .filter_map(|source| Some((power(&source.power)?, heat.node(&source.node)?, source.share)));
        let friction = heat.bearing_torque.as_ref().and_then(|torque| {
            let pitch_diameter = 2.0 * scene.pitch_radius();
            Some(BearingFriction {
                law: Palmgren { f0: torque.f0, f1: torque.f1, load: torque.load, pitch_diameter },
                oil,
                rings: [heat.node(&torque.nodes[0])?, heat.node(&torque.nodes[1])?],
                inner_share: torque.inner_share,
                elements: torque.elements.as_ref().and_then(|e| Some((heat.node(&e.node)?, e.share))),
                without_load: torque.without_load.as_ref().and_then(|name| heat.node(name)),
            })
        });
        Some(Self {
            network: network(heat, scene, speed, lubricant.conductivity.unwrap_or(0.0), w.density),
            sources: sources.collect(),
            friction,
            lubricant: heat.node(&heat.lubricant)?,
            oil,
            start: heat.nodes.iter().map(|node| node.start.unwrap_or(heat.ambient)).collect(),
        })
    }

    /// Kinematic viscosity of the lubricant at these temperatures, m^2/s.
    pub(crate) fn viscosity(&self, temperature: impl Fn(usize) -> f64) -> f64 {
        self.oil.viscosity(temperature(self.lubricant))
    }
}

fn network(heat: &Heat, scene: &Scene, speed: f64, conductivity: f64, density: f64) -> HeatNetwork {
    let (count, diameter) = (scene.element_count() as usize, 2.0 * scene.element_radius());
    let pitch_diameter = 2.0 * scene.pitch_radius();
    let balls = ball_conductance(count, diameter, pitch_diameter, speed);
    let angle = match scene.kinematic_elements.as_ref().map(|elements| &elements.motion) {
        Some(ElementMotion::Rolling { contact_angle }) => *contact_angle,
        _ => 0.0,
    };
    let ratio = diameter * math::cos(angle) / pitch_diameter;
    let links = heat.links.iter().map(|link| {
        let conducts = match &link.conductance {
            Conductance::Constant(value) => Conducts::Constant(*value),
            Conductance::Balls(factor) => Conducts::Constant(factor * balls),
            Conductance::Splashed(surface) => Conducts::splashed(
                surface.area,
                speed,
                ratio,
                [conductivity, density * surface.specific_heat],
            ),
        };
        Link { ends: link.between.each_ref().map(|name| heat.node(name)), conducts }
    });
    let inflows = heat.nodes.iter().enumerate().filter_map(|(node, lump)| {
        let flow = lump.flow.as_ref()?;
        let conductance = flow.rate * flow.heat_capacity;
        Some(Inflow { node, conductance, temperature: flow.inlet })
    });
    HeatNetwork {
        capacities: heat.nodes.iter().map(|node| node.capacity).collect(),
        links: links.collect(),
        inflows: inflows.collect(),
        ambient: heat.ambient,
    }
}

impl BearingFriction {
    /// Tells what every lump takes of it at a speed of the inner ring (rad/s) and these temperatures (K), W; returns all of it.
    pub(crate) fn heat(
        &self,
        speed: f64,
        temperature: impl Fn(usize) -> f64,
        mut tell: impl FnMut(usize, f64),
    ) -> f64 {
        let [inner, outer] = self.rings;
        // What is not made in the rings is made in the oil.
        let mean = match self.without_load {
            None => 0.5 * (temperature(inner) + temperature(outer)),
            Some(node) => temperature(node),
        };
        let [without_load, by_load] =
            [self.law.without_load(speed, self.oil.viscosity(mean)), self.law.by_load()]
                .map(|torque| torque * speed.abs());
        let mut on_rings = |power: f64| {
            tell(inner, self.inner_share * power);
            tell(outer, (1.0 - self.inner_share) * power);
        };
        let of_elements = self.elements.map_or(0.0, |(_, share)| share);
        on_rings(by_load * (1.0 - of_elements));
        match self.without_load {
            None => on_rings(without_load),
            Some(node) => tell(node, without_load),
        }
        if let Some((node, share)) = self.elements {
            tell(node, share * by_load);
        }
        without_load + by_load
    }
}
