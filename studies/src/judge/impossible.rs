//! Results that no bearing can have, whatever a run says of itself.

use serde_json::Value;
use std::collections::BTreeMap;
use std::f64::consts::TAU;

/// How far a free ring may leave its clearance, in radii of a roller.
const RING_BEYOND: f64 = 0.1;
/// Largest distance of a cage from its guide in radial clearances: beyond one a solid contact gives way or the cage bends. On a
/// soft contact friction drives its whirl until it rolls.
const CAGE_BEYOND: f64 = 2.0;
/// Tilt of a cage that its pockets cannot allow, rad, and its way along the axis in radii of a ball.
const TILTED: f64 = 0.15;
const ALONG: f64 = 1.0;
/// Slip that is more than all, beyond what rounding of a stop gives.
const ALL: f64 = 1.001;
/// Mean slip of what is faster than without slip. A roller on one ring alone is so by the slip of its orbit, and a cage on a guide
/// that is faster may turn with it.
const FASTER: f64 = -0.1;
/// Records in contact without a gap after which a roller rolls on its raceway.
const ROLLS: f64 = 5.0;
/// Share of all records in contact above which the mean slip of a roller is one of rolling.
const ROLLING: f64 = 0.5;
/// Torque that is round-off, N m.
const NO_TORQUE: f64 = 1e-12;
/// Temperatures that a lubricated bearing has, K.
const TEMPERATURES: [f64; 2] = [200.0, 700.0];
/// Mean drag torque in units of its largest value below which a bearing drives its shaft, if it gives more than it held.
const DRIVES: f64 = -1e-2;

/// Sum or difference of the speeds of both rings, in units of both, below which cage or rollers rest nearly.
const AT_REST: f64 = 0.3;

/// How deep two neighbours may be in each other, in radii of a roller: more than any contact gives way.
const OVERLAP: f64 = 1e-2;

/// Watches the channels of a run.
pub struct Watch {
    /// Watched channels with the sums of their values, the number of these and how many came last without a gap: of rollers, where
    /// they touch their raceway.
    places: Vec<(usize, Quantity, [f64; 3])>,
    names: Vec<String>,
    /// Largest excess of each kind, and in how many records.
    found: BTreeMap<&'static str, (f64, String, u32)>,
    clearance: Option<[f64; 2]>,
    without: WithoutSlip,
    records: f64,
    /// Slip of the cage of each record, and the least of them, 0 or less.
    cage: Option<usize>,
    fastest: f64,
    /// Largest magnitude of the drag torque, N m.
    torque: f64,
    ring: [Option<usize>; 2],
    loads: LoadsInSpace,
    /// Orbit angles of rollers, and the radius of a roller over that of their circle.
    orbits: Vec<usize>,
    share: f64,
    /// m; infinite without balls.
    ball_radius: f64,
    /// Orbit angles of the first and the last record, rad.
    from: Vec<f64>,
    to: Vec<f64>,
}

#[derive(Clone, Copy)]
enum Quantity {
    CageSlip,
    /// Of this roller, whose load on the outer raceway has this place.
    RollerSlip(usize, usize),
    Eccentricity,
    Tilt,
    /// Along the axis of the bearing.
    Along,
    Temperature,
    Torque,
}

impl Watch {
    pub fn new(scene: &Value, names: &[String]) -> Self {
        let of_land = |name: &str| name.starts_with("land[") && name.ends_with(".eccentricity");
        // The centre of a cage that tilts about a land off the middle goes further than that does.
        let by_lands = names.iter().any(|name| of_land(name));
        let quantity = |name: &str| match name {
            "cage.slip" => Some(Quantity::CageSlip),
            "cage.eccentricity" if !by_lands => Some(Quantity::Eccentricity),
            _ if of_land(name) => Some(Quantity::Eccentricity),
            "cage.tilt" => Some(Quantity::Tilt),
            "cage.x" => Some(Quantity::Along),
            "inner_ring.drag_torque" => Some(Quantity::Torque),
            _ if name.starts_with("roller[") && name.ends_with(".slip") => {
                let load = name.replace(".slip", ".outer_force");
                let number = name.split(['[', ']']).nth(1)?.parse().ok()?;
                names.iter().position(|name| *name == load).map(|load| Quantity::RollerSlip(number, load))
            }
            _ if name.starts_with("temperature.") => Some(Quantity::Temperature),
            _ => None,
        };
        let places = names.iter().enumerate();
        let places = places.filter_map(|(i, name)| Some((i, quantity(name)?, [0.0; 3]))).collect();
        let without = WithoutSlip::of(scene);
        let radius = number(scene, "/rollers/radius");
        let raceway = number(scene, "/outer_ring/raceway_radius");
        let share = radius.zip(raceway).map_or(0.0, |(radius, raceway)| radius / (raceway - radius));
        let clearance = scene["inner_ring"]["radial_clearance"].as_f64();
        let is_orbit = |name: &str| name.starts_with("roller[") && name.ends_with(".orbit_angle");
        let orbits = names.iter().enumerate().filter(|(_, name)| is_orbit(name)).map(|(i, _)| i).collect();
        Self {
            places,
            names: names.to_vec(),
            found: BTreeMap::new(),
            clearance: clearance.and_then(|clearance| Some([0.5 * clearance.max(0.0), radius?])),
            records: 0.0,
            cage: names.iter().position(|name| name == "cage.slip"),
            fastest: 0.0,
            torque: 0.0,
            orbits,
            share,
            ball_radius: number(scene, "/balls/radius").unwrap_or(f64::INFINITY),
            without,
            from: Vec::new(),
            to: Vec::new(),
            loads: LoadsInSpace::of(scene, names),
            ring: ["inner_ring.y", "inner_ring.z"].map(|name| names.iter().position(|n| n == name)),
        }
    }

    /// Looks at one record.
    pub fn see(&mut self, out: &[f64]) {
        if let Some(i) = out.iter().position(|value| value.is_nan()) {
            let name = self.names[i].clone();
            self.note("no number", 0.0, name);
        }
        self.records += 1.0;
        self.loads.see(out);
        self.fastest = self.cage.map_or(0.0, |cage| self.fastest.min(out[cage]));
        let seized = 1.0 + self.without.seized * (1.0 - self.fastest);
        for k in 0..self.places.len() {
            let (i, quantity, ref mut sum) = self.places[k];
            let value = out[i];
            let flies = matches!(quantity, Quantity::RollerSlip(_, outer) if out[outer] <= 0.0);
            *sum = if flies { [sum[0], sum[1], 0.0] } else { [sum[0] + value, sum[1] + 1.0, sum[2] + 1.0] };
            let kind = match quantity {
                // What flies or bounces may turn as it was hit.
                Quantity::RollerSlip(..)
                    if self.without.steady[1] && value > ALL * seized && sum[2] >= ROLLS =>
                {
                    "roller on its raceway spins backwards"
                }
                Quantity::Eccentricity if value > self.without.cage_beyond => "cage outside its guide",
                Quantity::Tilt if value > TILTED => "cage tilted out of its pockets",
                Quantity::Along if value.abs() > ALONG * self.ball_radius => "cage beside its balls",
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
        self.to.clear();
        self.to.extend(self.orbits.iter().map(|&place| out[place]));
        if self.from.is_empty() {
            self.from.clone_from(&self.to);
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
        let mean_of = |[sum, records, _]: &[f64; 3]| sum / records.max(1.0);
        let cage = self.places.iter().find(|(_, quantity, _)| matches!(quantity, Quantity::CageSlip));
        let cage_slip = cage.map_or(0.0, |(_, _, sum)| mean_of(sum).abs());
        // What one ring alone drives or holds turns faster by as much as its circle is slower or faster.
        let orbit_slip =
            |roller: usize| match (self.without.rolled, self.from.get(roller), self.to.get(roller)) {
                (Some(rolled), Some(from), Some(to)) => (1.0 - (to - from) / rolled).abs(),
                _ => 0.0,
            };
        for (i, quantity, sum) in &self.places {
            let mean = mean_of(sum);
            let kind = match quantity {
                Quantity::CageSlip if self.without.steady[0] && mean > ALL => "cage turns against its rings",
                Quantity::CageSlip if self.without.steady[0] && mean < self.without.cage_faster => {
                    "cage outruns its rings"
                }
                Quantity::RollerSlip(roller, _)
                    if self.without.steady[1]
                        && sum[1] > ROLLING * self.records
                        && mean < FASTER - cage_slip.max(orbit_slip(*roller)) =>
                {
                    "roller outruns its rings"
                }
                Quantity::Torque
                    if self.without.steady[1]
                        && !outer_turns
                        && mean
                            < (DRIVES * self.torque).min(-self.without.torque_of(self.loads.most()))
                                - NO_TORQUE =>
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

/// What the rings of a bearing would do without slip, and what follows for what is possible.
struct WithoutSlip {
    /// Whether slips of the cage and of rollers mean something: the rings turn steadily, and not so that what slips would rest
    /// without slip; and no load shakes the rollers, which may turn as they were hit.
    steady: [bool; 2],
    /// Slip above all of a roller that its pocket seizes, so that it turns with a cage without slip, or that a neighbour turns.
    seized: f64,
    /// Mean slip of the cage below which nothing drives it.
    cage_faster: f64,
    /// Largest distance of the cage from its guide in radial clearances.
    cage_beyond: f64,
    /// Angle of an orbit during the run, rad; none where that is small.
    rolled: Option<f64>,
    /// What rollers, balls and cage hold, and the load of a ring in its clearance, J.
    holds: f64,
    /// Of the shaft during the run, rad.
    turn: f64,
}

/// Loads of a ring in space, which give or take what they are moved by.
struct LoadsInSpace(Vec<OneLoad>);

struct OneLoad {
    place: usize,
    /// Largest magnitude, N or N m.
    size: f64,
    /// Where the ring was, m or rad.
    range: [f64; 2],
}

impl LoadsInSpace {
    fn of(scene: &Value, names: &[String]) -> Self {
        let ring = &scene["inner_ring"]["motion"]["space"];
        let weight = number(scene, "/gravity/z").unwrap_or(0.0).abs() * ring["mass"].as_f64().unwrap_or(0.0);
        let coordinates =
            [("x", "x"), ("y", "y"), ("z", "z"), ("tilt_y", "moment_y"), ("tilt_z", "moment_z")];
        let of = |(coordinate, load): (&str, &str)| {
            let place = names.iter().position(|name| *name == format!("inner_ring.{coordinate}"))?;
            let size = largest(&ring["load"][load]) + if coordinate == "z" { weight } else { 0.0 };
            Some(OneLoad { place, size, range: [f64::INFINITY, f64::NEG_INFINITY] })
        };
        Self(coordinates.into_iter().filter_map(of).collect())
    }

    fn see(&mut self, out: &[f64]) {
        for OneLoad { place, range, .. } in &mut self.0 {
            *range = [range[0].min(out[*place]), range[1].max(out[*place])];
        }
    }

    /// Most that they can have given, J.
    fn most(&self) -> f64 {
        self.0.iter().map(|load| load.size * (load.range[1] - load.range[0]).max(0.0)).sum()
    }
}

/// No less than the largest magnitude of a signal.
fn largest(signal: &Value) -> f64 {
    match signal {
        Value::Number(number) => number.as_f64().map_or(0.0, f64::abs),
        Value::Array(values) => values.iter().map(largest).fold(0.0, f64::max),
        Value::Object(fields) => {
            let of_values = fields
                .iter()
                .filter(|(name, _)| !["time", "start", "end", "frequency", "phase"].contains(&name.as_str()));
            of_values.map(|(_, value)| largest(value)).sum()
        }
        _ => 0.0,
    }
}

impl WithoutSlip {
    fn of(scene: &Value) -> Self {
        let constant = |signal: Option<&Value>| match signal {
            None | Some(Value::Null) => Some(0.0),
            Some(signal) => signal.as_f64().or_else(|| signal["constant"].as_f64()),
        };
        let speeds = ["/inner_ring/speed", "/outer_ring/speed"].map(|path| constant(scene.pointer(path)));
        let [Some(inner), Some(outer)] = speeds else {
            // A ring that reverses or jumps throws the cage as far as its contact is soft.
            let (cage_beyond, holds) = (f64::INFINITY, f64::INFINITY);
            return Self {
                steady: [false; 2],
                seized: 1.0,
                cage_faster: FASTER,
                cage_beyond,
                rolled: None,
                holds,
                turn: 0.0,
            };
        };
        let load = constant(scene.pointer("/inner_ring/motion/free/load/z"));
        let number = |path: &str| number(scene, path).unwrap_or(0.0);
        let duration = number("/record/duration");
        let (radius, circle) = if scene["rollers"].is_object() {
            let radius = number("/rollers/radius");
            (radius, number("/outer_ring/raceway_radius") - radius)
        } else if scene["balls"].is_object() {
            (number("/balls/radius"), number("/balls/pitch_radius"))
        } else {
            (number("/kinematic_elements/radius"), number("/kinematic_elements/pitch_radius"))
        };
        let share = if radius > 0.0 { radius / circle } else { 0.0 };
        let orbit = 0.5 * (inner * (1.0 - share) + outer * (1.0 + share));
        let spin = (outer * (1.0 + share) - orbit) / share.max(f64::MIN_POSITIVE);
        let enough = |sum: f64| sum.abs() > AT_REST * (inner.abs() + outer.abs());
        // Neighbours roll on each other, and turn one another backwards.
        let mates = scene["rollers"]["neighbours"].is_object();
        let lands = scene["cage"]["space"]["lands"].as_array().map_or(&[][..], Vec::as_slice);
        let of_first = lands.first().map_or(&Value::Null, |land| &land["guide"]);
        let guide = Some(&scene["cage"]["guide"]).filter(|guide| guide.is_object()).unwrap_or(of_first);
        let of_guide_number = |path: &str| guide.pointer(path).and_then(Value::as_f64).unwrap_or(0.0);
        let of_guide = if guide["ring"] == "inner_ring" { inner } else { outer };
        let clearance = 0.5 * of_guide_number("/diametral_clearance");
        let slides = (orbit - of_guide).abs() * of_guide_number("/guide_radius");
        let whirls = (of_guide_number("/solid/contact/stiffness") / number("/cage/mass")).sqrt();
        let soft = if whirls > 0.0 { 1.0 + slides / (whirls * clearance) } else { 0.0 };
        let travel = orbit * circle;
        let of_each = number("/rollers/mass") * travel * travel + number("/rollers/inertia") * spin * spin;
        let of_ball = number("/balls/mass") * (travel * travel + 0.4 * radius * radius * spin * spin);
        let of_all = number("/rollers/count") * of_each + number("/balls/count") * of_ball;
        let moves = 0.5 * (of_all + number("/cage/inertia") * orbit * orbit);
        let sinks = load.unwrap_or(f64::INFINITY).abs() * number("/inner_ring/radial_clearance").abs();
        Self {
            // Between rings that turn against each other the cage may follow either.
            steady: [enough(inner + outer) && inner * outer >= 0.0, enough(inner - outer) && load.is_some()],
            seized: if mates { 1.0 } else { (orbit / spin).abs() },
            cage_faster: if guide.is_object() { FASTER.min(1.0 - of_guide / orbit) } else { FASTER },
            cage_beyond: CAGE_BEYOND.max(soft),
            rolled: enough(inner + outer).then_some(orbit * duration),
            holds: moves + sinks,
            turn: inner.abs() * duration,
        }
    }

    /// Mean drag torque that gives the shaft what the bearing holds and this much more (J), N m.
    fn torque_of(&self, more: f64) -> f64 {
        (self.holds + more) / self.turn
    }
}

fn number(scene: &Value, path: &str) -> Option<f64> {
    scene.pointer(path).and_then(Value::as_f64)
}
