//! Results that no bearing can have, whatever a run says of itself.

use serde_json::Value;
use std::collections::BTreeMap;
use std::f64::consts::TAU;

/// How far a free ring may leave its clearance, in radii of a roller.
const RING_BEYOND: f64 = 0.1;
/// Largest distance of a cage from its guide in radial clearances: beyond one a solid contact gives way or the cage bends.
const CAGE_BEYOND: f64 = 2.0;
/// The same where a reversal throws the cage against a soft contact.
const CAGE_THROWN_BEYOND: f64 = 4.0;
/// Slip that is more than all, beyond what rounding of a stop gives.
const ALL: f64 = 1.001;
/// Mean slip of what is faster than without slip; a roller on the inner ring alone is so by the slip of its orbit.
const FASTER: f64 = -0.1;
/// Temperatures that a lubricated bearing has, K.
const TEMPERATURES: [f64; 2] = [200.0, 700.0];
/// Mean drag torque in units of its largest value below which a bearing drives its shaft.
const DRIVES: f64 = -1e-2;
/// Revolutions of the shaft within which what the bearing held at its start may drive it.
const TURNS: f64 = 0.5;

/// Sum or difference of the speeds of both rings, in units of both, below which cage or rollers rest nearly.
const AT_REST: f64 = 0.3;

/// How deep two neighbours may be in each other, in radii of a roller: more than any contact gives way.
const OVERLAP: f64 = 1e-2;

/// Watches the channels of a run.
pub struct Watch {
    /// Watched channels with the sums of their values and the number of these: of rollers, where they touch their raceway.
    places: Vec<(usize, Quantity, [f64; 2])>,
    names: Vec<String>,
    /// Largest excess of each kind, and in how many records.
    found: BTreeMap<&'static str, (f64, String, u32)>,
    clearance: Option<[f64; 2]>,
    /// Whether slips of the cage and of rollers mean something: the rings turn steadily, and not so that what slips would rest
    /// without slip.
    steady: [bool; 2],
    /// Slip of a roller that its pocket seizes, so that it turns with the cage, or that a neighbour turns.
    seized: f64,
    cage_beyond: f64,
    /// Whether the shaft turns far enough to judge its drag.
    turns: bool,
    /// Largest magnitude of the drag torque, N m.
    torque: f64,
    ring: [Option<usize>; 2],
    /// Orbit angles of rollers, and the radius of a roller over that of their circle.
    orbits: Vec<usize>,
    share: f64,
}

#[derive(Clone, Copy)]
enum Quantity {
    CageSlip,
    /// With the place of the load on the outer raceway.
    RollerSlip(usize),
    Eccentricity,
    Temperature,
    Torque,
}

impl Watch {
    pub fn new(scene: &Value, names: &[String]) -> Self {
        let quantity = |name: &str| match name {
            "cage.slip" => Some(Quantity::CageSlip),
            "cage.eccentricity" => Some(Quantity::Eccentricity),
            "inner_ring.drag_torque" => Some(Quantity::Torque),
            _ if name.starts_with("roller[") && name.ends_with(".slip") => {
                let load = name.replace(".slip", ".outer_force");
                names.iter().position(|name| *name == load).map(Quantity::RollerSlip)
            }
            _ if name.starts_with("temperature.") => Some(Quantity::Temperature),
            _ => None,
        };
        let places = names.iter().enumerate();
        let places = places.filter_map(|(i, name)| Some((i, quantity(name)?, [0.0; 2]))).collect();
        let constant = |ring: &str| match &scene[ring]["speed"] {
            Value::Null => Some(0.0),
            speed => speed.as_f64().or_else(|| speed["constant"].as_f64()),
        };
        let radius = scene["rollers"]["radius"].as_f64();
        let raceway = scene["outer_ring"]["raceway_radius"].as_f64();
        let share = radius.zip(raceway).map_or(0.0, |(radius, raceway)| radius / (raceway - radius));
        let (steady, seized) = match (constant("inner_ring"), constant("outer_ring")) {
            (Some(inner), Some(outer)) => {
                let enough = |sum: f64| sum.abs() > AT_REST * (inner.abs() + outer.abs());
                let orbit = 0.5 * (inner * (1.0 - share) + outer * (1.0 + share));
                let spin = (outer * (1.0 + share) - orbit) / share.max(f64::MIN_POSITIVE);
                // Neighbours roll on each other, and turn one another backwards.
                let mates = scene["rollers"]["neighbours"].is_object();
                let seized = if mates { 2.0 } else { 1.0 + (orbit / spin).abs() };
                ([enough(inner + outer), enough(inner - outer)], seized)
            }
            _ => ([false; 2], 2.0),
        };
        let clearance = scene["inner_ring"]["radial_clearance"].as_f64();
        let duration = scene["record"]["duration"].as_f64().unwrap_or(0.0);
        let is_orbit = |name: &str| name.starts_with("roller[") && name.ends_with(".orbit_angle");
        let orbits = names.iter().enumerate().filter(|(_, name)| is_orbit(name)).map(|(i, _)| i).collect();
        Self {
            places,
            names: names.to_vec(),
            found: BTreeMap::new(),
            clearance: clearance.and_then(|clearance| Some([0.5 * clearance.max(0.0), radius?])),
            steady,
            torque: 0.0,
            orbits,
            share,
            seized,
            cage_beyond: if constant("inner_ring").is_some() { CAGE_BEYOND } else { CAGE_THROWN_BEYOND },
            turns: constant("inner_ring").is_some_and(|speed| speed.abs() * duration > TURNS * TAU),
            ring: ["inner_ring.y", "inner_ring.z"].map(|name| names.iter().position(|n| n == name)),
        }
    }

    /// Looks at one record.
    pub fn see(&mut self, out: &[f64]) {
        if let Some(i) = out.iter().position(|value| value.is_nan()) {
            let name = self.names[i].clone();
            self.note("no number", 0.0, name);
        }
        for k in 0..self.places.len() {
            let (i, quantity, ref mut sum) = self.places[k];
            let value = out[i];
            if !matches!(quantity, Quantity::RollerSlip(outer) if out[outer] <= 0.0) {
                *sum = [sum[0] + value, sum[1] + 1.0];
            }
            let kind = match quantity {
                // What flies freely may turn as it was hit.
                Quantity::RollerSlip(outer)
                    if self.steady[1] && value > ALL * self.seized && out[outer] > 0.0 =>
                {
                    "roller on its raceway spins backwards"
                }
                Quantity::Eccentricity if value > self.cage_beyond => "cage outside its guide",
                Quantity::Temperature if !(TEMPERATURES[0]..TEMPERATURES[1]).contains(&value) => {
                    "temperature"
                }
                Quantity::Torque => {
                    self.torque = self.torque.max(value.abs());
                    continue;
                }
                _ => continue,
            };
            self.note(kind, value, self.names[i].clone());
        }
        let chord = |a: usize, b: usize, turn: f64| 2.0 * (0.5 * (out[b] - out[a] + turn)).sin();
        let (first, last) = (self.orbits.first(), self.orbits.last());
        let ends = first.zip(last).map(|(first, last)| chord(*last, *first, TAU));
        let chords = self.orbits.windows(2).map(|pair| chord(pair[0], pair[1], 0.0)).chain(ends);
        let nearest = chords.fold(f64::INFINITY, f64::min);
        if self.orbits.len() > 1 && nearest < (2.0 - OVERLAP) * self.share {
            self.note("rollers overlap", nearest / self.share - 2.0, "in radii".to_owned());
        }
        if let ([Some(y), Some(z)], Some([clearance, radius])) = (self.ring, self.clearance) {
            let distance = out[y].hypot(out[z]);
            if distance > clearance + RING_BEYOND * radius {
                self.note("inner ring outside the bearing", distance, "inner_ring".to_owned());
            }
        }
    }

    fn note(&mut self, kind: &'static str, value: f64, name: String) {
        let entry = self.found.entry(kind).or_insert((value, name.clone(), 0));
        entry.2 += 1;
        if value.abs() > entry.0.abs() {
            (entry.0, entry.1) = (value, name);
        }
    }

    /// What was found, one text for each kind.
    pub fn list(&self, outer_turns: bool) -> Vec<String> {
        let found = self.found.iter();
        let mut list: Vec<String> = found
            .map(|(kind, (value, name, records))| format!("{kind}: {name} {value:.3e}, {records} records"))
            .collect();
        let mean_of = |[sum, records]: &[f64; 2]| sum / records.max(1.0);
        let cage = self.places.iter().find(|(_, quantity, _)| matches!(quantity, Quantity::CageSlip));
        let cage_slip = cage.map_or(0.0, |(_, _, sum)| mean_of(sum).max(0.0));
        for (i, quantity, sum) in &self.places {
            let mean = mean_of(sum);
            let kind = match quantity {
                Quantity::CageSlip if self.steady[0] && mean > ALL => "cage turns against its rings",
                Quantity::CageSlip if self.steady[0] && mean < FASTER => "cage outruns its rings",
                Quantity::RollerSlip(_) if self.steady[1] && mean < FASTER - cage_slip => {
                    "roller outruns its rings"
                }
                Quantity::Torque
                    if self.steady[1] && self.turns && !outer_turns && mean < DRIVES * self.torque =>
                {
                    "bearing drives its shaft"
                }
                _ => continue,
            };
            list.push(format!("{kind}: {} {mean:.3e} in the mean", self.names[*i]));
        }
        list
    }
}
