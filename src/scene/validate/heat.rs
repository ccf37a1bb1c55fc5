//! Checks of the heat balance.

use crate::scene::check::{Range, bad, range};
use crate::scene::heat::AMBIENT;
use crate::scene::validate::*;
use crate::scene::*;

const CAPACITY: Range = range(1e-6, 1e9, "J/K");
const CONDUCTANCE: Range = range(0.0, 1e6, "W/K");
const SHARE: Range = range(0.0, 1.0, "");
const MOST_NODES: usize = 64;

impl Scene {
    pub(in crate::scene) fn validate_heat(&self, judge: Judge<'_>, heat: &Heat) -> Result<()> {
        judge.number("heat.ambient", heat.ambient, TEMPERATURE)?;
        if !(1..=MOST_NODES).contains(&heat.nodes.len()) {
            judge
                .refuse("heat.nodes", format!("{} lumps, allowed are 1 to {MOST_NODES}", heat.nodes.len()))?;
        }
        for (i, node) in heat.nodes.iter().enumerate() {
            let at = |field: &str| format!("heat.nodes.{i}.{field}");
            if node.name == AMBIENT || heat.node(&node.name) != Some(i) {
                judge.refuse(
                    &at("name"),
                    format!("'{}' is taken; each lump has a name of its own", node.name),
                )?;
            }
            judge.number(&at("capacity"), node.capacity, CAPACITY)?;
            judge.optional(&at("start"), node.start, TEMPERATURE)?;
            if let Some(flow) = &node.flow {
                judge.number(&at("flow.rate"), flow.rate, range(0.0, 1.0, "m^3/s"))?;
                judge.number(&at("flow.inlet"), flow.inlet, TEMPERATURE)?;
                judge.number(&at("flow.heat_capacity"), flow.heat_capacity, range(1e5, 1e7, "J/(m^3 K)"))?;
            }
        }
        let unnamed = |i: usize| judge.excuses(&format!("heat.nodes.{i}.name"));
        let all_named = !judge.excuses("heat.nodes") && !(0..heat.nodes.len()).any(unnamed);
        let known = |path: String, name: &str| match heat.node(name) {
            Some(_) => Ok(()),
            None if !all_named => Ok(()),
            None => {
                let names: Vec<_> = heat.nodes.iter().map(|node| node.name.as_str()).collect();
                judge.refuse(&path, format!("there is no lump '{name}'; there are {}", names.join(", ")))
            }
        };
        known("heat.lubricant".to_owned(), &heat.lubricant)?;
        for (i, link) in heat.links.iter().enumerate() {
            for (k, name) in link.between.iter().enumerate() {
                if name != AMBIENT {
                    known(format!("heat.links.{i}.between.{k}"), name)?;
                }
            }
            if link.between[0] == link.between[1] {
                let text = format!("both ends are '{}'", link.between[0]);
                judge.refuse(&format!("heat.links.{i}.between"), text)?;
            }
            let at = |field: &str| format!("heat.links.{i}.conductance.{field}");
            match &link.conductance {
                Conductance::Constant(value) => judge.number(&at("constant"), *value, CONDUCTANCE)?,
                Conductance::Balls(factor) => judge.number(&at("balls"), *factor, range(0.0, 1e3, ""))?,
                Conductance::Splashed(surface) => {
                    judge.number(&at("splashed.area"), surface.area, range(0.0, 100.0, "m^2"))?;
                    let allowed = range(100.0, 1e4, "J/(kg K)");
                    judge.number(&at("splashed.specific_heat"), surface.specific_heat, allowed)?;
                    if self.lubricant.as_ref().is_none_or(|lubricant| lubricant.conductivity.is_none()) {
                        judge.refuse(
                            "lubricant.conductivity",
                            format!("missing; {} needs it", at("splashed")),
                        )?;
                    }
                }
            }
        }
        for (i, source) in heat.sources.iter().enumerate() {
            let at = |field: &str| format!("heat.sources.{i}.{field}");
            if !HEATING_POWERS.contains(&source.power.as_str()) {
                let text = format!("'{}' is none of {}", source.power, HEATING_POWERS.join(", "));
                judge.refuse(&at("power"), text)?;
            }
            known(at("node"), &source.node)?;
            judge.number(&at("share"), source.share, SHARE)?;
        }
        let warms = heat.bearing_torque.is_some() || !heat.sources.is_empty();
        if !warms {
            judge.refuse(
                "heat.sources",
                "nothing warms the bearing; give a source or 'heat.bearing_torque'",
            )?;
        }
        for power in HEATING_POWERS {
            let total: f64 = heat.sources.iter().filter(|s| s.power == *power).map(|s| s.share).sum();
            if total > 1.0 + 1e-12 {
                judge.refuse("heat.sources", format!("the shares of '{power}' add up to {total:?}"))?;
            }
        }
        if let Some(torque) = &heat.bearing_torque {
            let at = |field: &str| format!("heat.bearing_torque.{field}");
            judge.number(&at("f0"), torque.f0, range(0.0, 100.0, ""))?;
            judge.number(&at("f1"), torque.f1, range(0.0, 0.1, ""))?;
            judge.number(&at("load"), torque.load, range(0.0, 1e9, "N"))?;
            judge.number(&at("inner_share"), torque.inner_share, SHARE)?;
            for (k, name) in torque.nodes.iter().enumerate() {
                known(at(&format!("nodes.{k}")), name)?;
            }
            if torque.nodes[0] == torque.nodes[1] {
                judge.refuse(&at("nodes"), format!("both rings are '{}'", torque.nodes[0]))?;
            }
            if self.rollers.is_some() && !judge.excuses("rollers") && !heat.sources.is_empty() {
                let text =
                    "stands for the losses of contacts, which 'heat.sources' has already; give one of them";
                judge.refuse("heat.bearing_torque", text)?;
            }
            if let Some(elements) = &torque.elements {
                known(at("elements.node"), &elements.node)?;
                judge.number(&at("elements.share"), elements.share, SHARE)?;
            }
            if let Some(name) = &torque.without_load {
                known(at("without_load"), name)?;
            }
        }
        for (i, name) in heat.in_motion.iter().enumerate() {
            let path = format!("heat.in_motion.{i}");
            known(path.clone(), name)?;
            if heat.in_motion[..i].contains(name) {
                judge.refuse(&path, format!("'{name}' is there twice"))?;
            }
        }
        judge.optional("heat.own_time", heat.own_time, range(1e-3, 1e6, "s"))?;
        if heat.own_time.is_some() && heat.in_motion.is_empty() {
            judge.refuse("heat.own_time", "no lump is in heat.in_motion, whose time it would be")?;
        }
        if let Some(play) = &heat.play {
            for (k, name) in play.nodes.iter().enumerate() {
                known(format!("heat.play.nodes.{k}"), name)?;
            }
            judge.number("heat.play.expansion", play.expansion, range(0.0, 1e-4, "1/K"))?;
            judge.number("heat.play.reference", play.reference, TEMPERATURE)?;
            if self.rollers.is_none() {
                judge.refuse("heat.play", "has no radial clearance to change; it needs 'rollers'")?;
            }
            let warm = self.radial_clearance();
            if !warm.is_nan() && !(-2e-4..=2e-3).contains(&warm) {
                let text = format!(
                    "the radial clearance is {warm:?} m at the temperatures of the start, allowed are -0.0002 to 0.002 m"
                );
                judge.refuse("heat.play", text)?;
            }
        }
        match self.inner_ring.as_ref().map(|ring| &ring.speed) {
            None => judge.refuse("inner_ring", "missing; 'heat' needs its speed")?,
            Some(Signal::Constant(_)) => {}
            Some(_) => {
                let text = "changes over time; what conducts and what the bearing loses by 'heat' are those of one speed";
                judge.refuse("inner_ring.speed", text)?;
            }
        }
        if self.outer_ring.as_ref().is_some_and(|ring| ring.speed.is_some()) {
            let text = "not allowed beside 'heat', whose torque and conductances are by the speed of the inner ring alone; remove one of them";
            return Err(bad("outer_ring.speed", text));
        }
        match self.lubricant.as_ref().map(|lubricant| &lubricant.viscosity) {
            Some(Viscosity::Walther(_)) => {}
            _ => {
                let text = "missing; 'heat' needs a viscosity that follows the temperature";
                judge.refuse("lubricant.viscosity.walther", text)?;
            }
        }
        // Any lump and any link may lead there.
        let turns = self.inner_ring.as_ref().is_some_and(|ring| ring.speed.largest() > 0.0);
        if judge.doubts("heat") { Ok(()) } else { heat.reaches_ambient(turns) }
    }
}

/// Powers that turn energy into heat.
const HEATING_POWERS: &[&str] = &[
    "raceway_damping",
    "raceway_friction",
    "rolling_resistance",
    "pocket_damping",
    "pocket_friction",
    "guide_film",
    "guide_solid",
    "cage_bending",
    "neighbour_damping",
    "neighbour_friction",
];

impl Scene {
    /// Radial clearance in m at the temperatures of the start where it follows them, of one that is `given` (m) at its reference.
    pub(in crate::scene) fn warmed_clearance(&self, given: f64) -> Option<f64> {
        let heat = self.heat.as_ref()?;
        let play = heat.play.as_ref()?;
        let diameter = 2.0 * self.rollers.as_ref()?.radius;
        let outer = 2.0 * self.outer_ring.as_ref()?.raceway_radius?;
        let inner = outer - 2.0 * diameter - given;
        let above = |k: usize| {
            let start = heat.nodes.iter().find(|node| node.name == play.nodes[k]).and_then(|node| node.start);
            start.unwrap_or(heat.ambient) - play.reference
        };
        Some(given + play.expansion * (outer * above(1) - inner * above(0) - 2.0 * diameter * above(2)))
    }
}

impl Heat {
    /// Whether every lump can give its heat to the surroundings. What a bearing moves conducts nothing at rest.
    fn reaches_ambient(&self, turns: bool) -> Result<()> {
        let flows = |node: &HeatNode| node.flow.as_ref().is_some_and(|flow| flow.rate > 0.0);
        let mut reached: Vec<bool> = self.nodes.iter().map(flows).collect();
        for _ in &self.nodes {
            for link in &self.links {
                let conducts = match &link.conductance {
                    Conductance::Constant(value) => *value > 0.0,
                    Conductance::Balls(value) => turns && *value > 0.0,
                    Conductance::Splashed(surface) => turns && surface.area > 0.0,
                };
                let is_reached =
                    |name: &str| name == AMBIENT || self.node(name).is_some_and(|place| reached[place]);
                if conducts && link.between.iter().any(|name| is_reached(name)) {
                    for place in link.between.iter().filter_map(|name| self.node(name)) {
                        reached[place] = true;
                    }
                }
            }
        }
        match reached.iter().position(|reached| !reached) {
            None => Ok(()),
            Some(place) => {
                let rest = if turns { "" } else { " while the ring rests" };
                let text = format!(
                    "nothing conducts from '{}' to '{AMBIENT}'{rest}, on whatever way; its temperature would grow without end",
                    self.nodes[place].name
                );
                Err(bad("heat.links", text))
            }
        }
    }
}
