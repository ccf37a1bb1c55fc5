//! The animation of a report: geometry of the bearing, and what moves in it, by frames.

use super::frames::{self, Packed, integral};
use super::series::Series;
use super::unrolled::{self, Unrolled};
use cagedyn::Model;
use cagedyn::model::{HostInputs, Input};
use cagedyn::scene::{GuideRing, Pocket};
use serde::Serialize;
use std::f64::consts::TAU;

/// An animation, ready to be shown.
pub struct Animation {
    /// [`Content`] as JSON.
    pub json: String,
    /// Number of frames.
    pub frames: usize,
    /// First and last time, s.
    pub span: [f64; 2],
    /// Records from one frame to the next.
    pub stride: usize,
    /// What is not shown and why.
    pub missing: Vec<String>,
}

/// Lengths in m, angles in rad, forces in N.
#[derive(Serialize)]
struct Content {
    times: Vec<f64>,
    kind: &'static str,
    count: usize,
    element_radius: f64,
    pitch_radius: f64,
    /// Angle of the first element and pocket at the start.
    first_angle: f64,
    /// Radii of the raceways; of elements without raceways in the scene as if they touched both.
    raceways: [f64; 2],
    raceways_known: bool,
    /// Room of an element between the raceways, half of it on either side.
    raceway_play: f64,
    pocket_clearance: Option<f64>,
    /// Half angle of cylindrical walls.
    pocket_half_angle: Option<f64>,
    /// Radius of the neutral line of a cage that bends.
    neutral_radius: Option<f64>,
    guide: Option<GuideOf>,
    /// Waves of the guided surface that turn with the cage: order, amplitude, phase.
    roundness: Vec<(u32, f64, f64)>,
    /// Angle of the inner ring since the first frame.
    ring_angle: Packed,
    /// That of an outer ring that turns.
    outer_ring_angle: Option<Packed>,
    ring: Option<[Packed; 2]>,
    cage: Option<CageOf>,
    /// Angle from which those of the elements count: of the cage, or of the first element; since the start of the run.
    turn: Packed,
    /// Angle of every element ahead of its place at that angle, counter-clockwise; by element, then by frame.
    ahead: Packed,
    /// Spin angle since the first frame, of every element or of all of them.
    spin: Option<Packed>,
    forces: Forces,
    /// What else a bearing in space shows.
    space: Option<SpaceOf>,
    /// Rollers that skew and tilt.
    unrolled: Option<Unrolled>,
}

#[derive(Serialize)]
struct SpaceOf {
    /// Radii of the grooves of outer and inner race across them, m.
    grooves: [f64; 2],
    /// At which balls just touch, rad.
    contact_angle: f64,
    /// x, y, z and tilts of the inner ring.
    ring: [Packed; 5],
    /// Contact angles of outer and inner race; by element, then by frame.
    angles: [Option<Packed>; 2],
    /// Pitch and yaw of the axes of the balls.
    axes: Option<[Packed; 2]>,
    /// x, y, z and tilts of the cage.
    cage: Option<[Packed; 5]>,
}

#[derive(Serialize)]
struct GuideOf {
    inner: bool,
    radius: f64,
    clearance: f64,
}

#[derive(Serialize)]
struct CageOf {
    y: Packed,
    z: Packed,
    /// Waves of its ring: order, amplitudes of cosine and sine.
    waves: Vec<(usize, Packed, Packed)>,
}

/// By element, then by frame; on the cage counter-clockwise positive, on raceways the normal force.
#[derive(Default, Serialize)]
struct Forces {
    pocket: Option<Packed>,
    /// Whether they are the largest in any step since the frame before, or those of the records.
    pocket_of_steps: bool,
    /// What the largest of those of the records exceeds in a tenth of the frames: beside hits of single steps, the force of the
    /// guide would not be seen.
    pocket_usual: Option<f64>,
    inner: Option<Packed>,
    outer: Option<Packed>,
    /// Components of the force of the guide on the cage.
    guide: Option<[Packed; 2]>,
}

/// Channels of every element: angle, slip, forces.
const OF_ELEMENT: [&str; 14] = [
    "orbit_angle",
    "slip",
    "pocket_force",
    "pocket_force min",
    "pocket_force max",
    "inner_force",
    "outer_force",
    "inner_angle",
    "outer_angle",
    "pitch_angle",
    "yaw_angle",
    unrolled::CHANNELS[0],
    unrolled::CHANNELS[1],
    unrolled::CHANNELS[2],
];
/// Coordinates of ring and cage in space.
const OF_BODY: [&str; 5] = ["x", "y", "z", "tilt_y", "tilt_z"];
const OF_CAGE: [&str; 7] =
    ["cage.y", "cage.z", "cage.angle", "guide.force_y", "guide.force_z", "inner_ring.y", "inner_ring.z"];

/// Names of the columns of the table that an animation takes.
pub fn columns(model: &Model) -> Vec<String> {
    let kind = model.element_kind();
    let of_elements =
        (0..model.element_count()).flat_map(|j| OF_ELEMENT.map(|field| format!("{kind}[{j}].{field}")));
    let waves = (2..=orders(model)).flat_map(|n| ["amplitude", "phase"].map(|part| wave(n, part)));
    let tilts =
        ["inner_ring", "cage"].map(|body| ["x", "tilt_y", "tilt_z"].map(|field| format!("{body}.{field}")));
    OF_CAGE
        .map(str::to_owned)
        .into_iter()
        .chain(tilts.into_iter().flatten())
        .chain(waves)
        .chain(of_elements)
        .collect()
}

/// Highest order of the waves of the cage; below 2 without any.
fn orders(model: &Model) -> usize {
    let ring = model.scene().cage.as_ref().and_then(|cage| cage.elastic_ring.as_ref());
    ring.map_or(0, |ring| ring.modes as usize)
}

fn wave(n: usize, part: &str) -> String {
    format!("cage.mode[{n}].{part}")
}

impl Animation {
    /// Makes an animation of the records.
    ///
    /// # Errors
    /// Why there can be none, in words.
    pub fn new(model: &Model, series: &Series) -> Result<Self, String> {
        if series.times.len() < 2 {
            return Err("there are fewer than two records".to_owned());
        }
        Shown::new(model, series)?.animation()
    }
}

/// Records on their way to frames.
struct Shown<'a> {
    model: &'a Model,
    series: &'a Series,
    kind: &'static str,
    count: usize,
    /// Angle from which those of the elements count.
    turn: Vec<f64>,
    /// Places of the records that are shown.
    places: Vec<usize>,
    missing: Vec<String>,
}

impl<'a> Shown<'a> {
    fn new(model: &'a Model, series: &'a Series) -> Result<Self, String> {
        let (kind, count) = (model.element_kind(), model.element_count());
        let needed = |name: &str| {
            series
                .column(name)
                .ok_or_else(|| format!("needs {name}, which the table does not have (record.channels)"))
        };
        let first_angle = model.scene().initial.first_roller_angle;
        let has_cage = model.scene().cage.is_some();
        let turn: Vec<f64> = if has_cage {
            needed("cage.y")?;
            needed("cage.z")?;
            needed("cage.angle")?.to_vec()
        } else {
            needed(&format!("{kind}[0].orbit_angle"))?.iter().map(|angle| angle - first_angle).collect()
        };
        for j in 0..count {
            needed(&format!("{kind}[{j}].orbit_angle"))?;
        }
        let centre = series.column("cage.y").zip(series.column("cage.z"));
        let turns: Vec<f64> = match centre {
            None => turn.windows(2).map(|pair| pair[1] - pair[0]).collect(),
            Some((y, z)) => {
                let least = 0.1 * model.guide_clearance().unwrap_or(1e-4);
                (1..turn.len()).map(|i| (turn[i] - turn[i - 1]).abs().max(whirl(y, z, i, least))).collect()
            }
        };
        let numbers = 5 * count + 2 * orders(model) + 10;
        let places = frames::frames(series.times.len(), numbers, &turns);
        Ok(Self { model, series, kind, count, turn, places, missing: Vec::new() })
    }

    fn animation(mut self) -> Result<Animation, String> {
        let scene = self.model.scene();
        let cage = scene.cage.as_ref();
        let guide = cage.and_then(|cage| cage.guide.as_ref());
        let (pitch_radius, radius) = (self.model.pitch_radius(), scene.element_radius());
        let outer = scene.outer_ring.as_ref().filter(|_| self.model.has_rollers());
        let raceways = self.model.inner_raceway_radius().zip(outer.and_then(|ring| ring.raceway_radius));
        let first = self.places[0];
        let last = self.places[self.places.len() - 1];
        let times = &self.series.times;
        let content = Content {
            times: self.places.iter().map(|i| times[*i]).collect(),
            kind: self.kind,
            count: self.count,
            element_radius: radius,
            pitch_radius,
            first_angle: scene.initial.first_roller_angle,
            raceways: raceways.map_or([pitch_radius - radius, pitch_radius + radius], |(i, o)| [i, o]),
            raceways_known: raceways.is_some(),
            raceway_play: scene.radial_clearance() / 2.0,
            pocket_clearance: self.model.pocket_clearance(),
            pocket_half_angle: match cage.and_then(|cage| cage.pocket.as_ref()) {
                Some(Pocket::LubricatedCylinder(pocket)) => Some(pocket.half_angle),
                _ => None,
            },
            neutral_radius: cage.and_then(|cage| Some(cage.elastic_ring.as_ref()?.neutral_radius)),
            guide: guide.map(|guide| GuideOf {
                inner: guide.ring == GuideRing::InnerRing,
                radius: guide.guide_radius,
                clearance: guide.diametral_clearance / 2.0,
            }),
            roundness: guide.map_or(Vec::new(), |guide| {
                guide.roundness.iter().map(|wave| (wave.order, wave.amplitude, wave.phase)).collect()
            }),
            ring_angle: self.ring_angle(Input::RingSpeed),
            outer_ring_angle: scene
                .outer_ring
                .as_ref()
                .filter(|ring| ring.turns())
                .map(|_| self.ring_angle(Input::OuterRingSpeed)),
            ring: self.ring(),
            cage: self.cage(),
            turn: self.packed(&self.turn),
            ahead: self.ahead(),
            spin: self.spin(),
            forces: self.forces(),
            space: self.space(),
            unrolled: self.unrolled(),
        };
        let json = serde_json::to_string(&content).map_err(|e| e.to_string())?;
        Ok(Animation {
            json,
            frames: self.places.len(),
            span: [times[first], times[last]],
            stride: self.places[1] - first,
            missing: self.missing,
        })
    }

    /// A column at the frames.
    fn packed(&self, column: &[f64]) -> Packed {
        Packed::new(&self.places.iter().map(|i| column[*i]).collect::<Vec<_>>())
    }

    fn of_element(&self, j: usize, field: &str) -> Option<&'a [f64]> {
        self.series.column(&format!("{}[{j}].{field}", self.kind))
    }

    /// A field of all elements at the frames, if all have it.
    fn of_elements(&self, field: &str) -> Option<Packed> {
        let columns: Option<Vec<_>> = (0..self.count).map(|j| self.of_element(j, field)).collect();
        let values =
            columns?.iter().flat_map(|column| self.places.iter().map(|i| column[*i])).collect::<Vec<_>>();
        Some(Packed::new(&values))
    }

    fn miss(&mut self, what: &str, channels: &str) {
        self.missing
            .push(format!("{what} in the animation: {channels} is not in the table (record.channels)"));
    }

    /// Orbit and spin speed of an element without slip, rad/s, at a record.
    fn speeds(&self, i: usize) -> [f64; 2] {
        self.model.kinematic_speeds(&self.model.inputs_at(self.series.times[i], &HostInputs::default()))
    }

    /// Angles since the first frame from their rates at all records from there on.
    fn integrated(&self, rates: &[f64]) -> Vec<f64> {
        let first = self.places[0];
        let angle = integral(&self.series.times[first..], rates);
        self.places.iter().map(|i| angle[i - first]).collect()
    }

    fn ring_angle(&self, speed: Input) -> Packed {
        let times = &self.series.times[self.places[0]..];
        let rates: Vec<f64> =
            times.iter().map(|t| self.model.inputs_at(*t, &HostInputs::default()).of(speed)).collect();
        Packed::new(&self.integrated(&rates))
    }

    fn ring(&mut self) -> Option<[Packed; 2]> {
        self.model.scene().inner_ring.as_ref()?;
        let found = self.series.column("inner_ring.y").zip(self.series.column("inner_ring.z"));
        if found.is_none() {
            self.miss("place of the inner ring", "inner_ring.y, inner_ring.z");
        }
        found.map(|(y, z)| [self.packed(y), self.packed(z)])
    }

    fn cage(&mut self) -> Option<CageOf> {
        let (y, z) = self.series.column("cage.y").zip(self.series.column("cage.z"))?;
        let waves: Option<Vec<_>> = (2..=orders(self.model))
            .map(|n| {
                let amplitude = self.series.column(&wave(n, "amplitude"))?;
                let phase = self.series.column(&wave(n, "phase"))?;
                let part = |of: fn(f64) -> f64| {
                    let values: Vec<f64> = amplitude.iter().zip(phase).map(|(a, p)| a * of(*p)).collect();
                    self.packed(&values)
                };
                Some((n, part(f64::cos), part(f64::sin)))
            })
            .collect();
        if waves.is_none() {
            self.miss("shape of the cage", "cage.mode[n].amplitude or .phase");
        }
        Some(CageOf { y: self.packed(y), z: self.packed(z), waves: waves.unwrap_or_default() })
    }

    fn ahead(&self) -> Packed {
        let first_angle = self.model.scene().initial.first_roller_angle;
        let mut values = Vec::new();
        for j in 0..self.count {
            let start = first_angle + TAU * j as f64 / self.count as f64;
            let angles = self.of_element(j, "orbit_angle").unwrap_or_default();
            values.extend(self.places.iter().map(|i| angles[*i] - start - self.turn[*i]));
        }
        Packed::new(&values)
    }

    fn spin(&mut self) -> Option<Packed> {
        let first = self.places[0];
        let without_slip: Vec<f64> = (first..self.turn.len()).map(|i| self.speeds(i)[1]).collect();
        if !self.model.has_rollers() {
            return Some(Packed::new(&self.integrated(&without_slip)));
        }
        let mut values = Vec::new();
        for j in 0..self.count {
            let Some(slip) = self.of_element(j, "slip") else {
                self.miss("spin of the rollers", &format!("roller[{j}].slip"));
                return None;
            };
            let rates = without_slip.iter().zip(&slip[first..]).map(|(spin, slip)| spin * (1.0 - slip));
            values.extend(self.integrated(&rates.collect::<Vec<_>>()));
        }
        Some(Packed::new(&values))
    }

    fn forces(&mut self) -> Forces {
        let mut forces = Forces::default();
        if self.model.pocket_clearance().is_some() {
            let peaks = self.pocket_peaks();
            forces.pocket_of_steps = peaks.is_some();
            let samples = self.pocket_samples();
            forces.pocket_usual = samples.as_ref().map(|samples| self.usual(samples));
            forces.pocket = peaks.or_else(|| samples.map(|samples| Packed::new(&samples)));
            if forces.pocket.is_none() {
                self.miss("pocket forces", &format!("{}[j].pocket_force", self.kind));
            }
        }
        if self.model.has_rollers() || self.model.scene().balls.is_some() {
            (forces.inner, forces.outer) = (self.of_elements("inner_force"), self.of_elements("outer_force"));
            if forces.inner.is_none() || forces.outer.is_none() {
                self.miss("forces on the raceways", "inner_force or outer_force of the elements");
            }
        }
        if self.model.guide_clearance().is_some() {
            let found = self.series.column("guide.force_y").zip(self.series.column("guide.force_z"));
            forces.guide = found.map(|(y, z)| [self.packed(y), self.packed(z)]);
            if forces.guide.is_none() {
                self.miss("guide force", "guide.force_y, guide.force_z");
            }
        }
        forces
    }

    fn space(&mut self) -> Option<SpaceOf> {
        let scene = self.model.scene();
        scene.balls.as_ref()?;
        let (outer, inner) = (scene.outer_ring.as_ref()?, scene.inner_ring.as_ref()?);
        let grooves = [outer.groove_radius?, inner.groove_radius?];
        let Some(ring) = self.in_space("inner_ring") else {
            self.miss("the bearing in space", "inner_ring.x, .y, .z, .tilt_y or .tilt_z");
            return None;
        };
        let cage = scene.cage.as_ref().and_then(|_| self.in_space("cage"));
        if scene.cage.is_some() && cage.is_none() {
            self.miss("the cage", "cage.x, .y, .z, .tilt_y or .tilt_z");
        }
        let contact_angle =
            self.model.geometry().into_iter().find(|(q, _)| q.name == "free_contact_angle")?.1;
        let axes = self.of_elements("pitch_angle").zip(self.of_elements("yaw_angle"));
        Some(SpaceOf {
            grooves,
            contact_angle,
            ring,
            angles: ["outer_angle", "inner_angle"].map(|field| self.of_elements(field)),
            axes: axes.map(|(pitch, yaw)| [pitch, yaw]),
            cage,
        })
    }

    fn unrolled(&mut self) -> Option<Unrolled> {
        let found = Unrolled::new(self.model.scene(), |field| self.of_elements(field));
        if found.is_none() && unrolled::wanted(self.model.scene()) {
            self.miss("how rollers lie", "axial_offset, skew or tilt of the rollers");
        }
        found
    }

    /// Place and tilts of a body at the frames.
    fn in_space(&self, body: &str) -> Option<[Packed; 5]> {
        let columns = OF_BODY.map(|field| self.series.column(&format!("{body}.{field}")));
        let [x, y, z, tilt_y, tilt_z] = columns;
        Some([x?, y?, z?, tilt_y?, tilt_z?].map(|column| self.packed(column)))
    }

    /// -1 where the elements go clockwise: the table has pocket forces positive where they drive the cage.
    fn direction(&self, i: usize) -> f64 {
        if self.speeds(i)[0] < 0.0 { -1.0 } else { 1.0 }
    }

    /// Pocket forces of the records; by element, then by frame.
    fn pocket_samples(&self) -> Option<Vec<f64>> {
        let mut values = Vec::new();
        for j in 0..self.count {
            let column = self.of_element(j, "pocket_force")?;
            values.extend(self.places.iter().map(|i| self.direction(*i) * column[*i]));
        }
        Some(values)
    }

    /// What the largest of these values of a frame exceeds in a tenth of the frames with any.
    fn usual(&self, values: &[f64]) -> f64 {
        let frames = self.places.len();
        let of_frame = |i: usize| values.iter().skip(i).step_by(frames).fold(0.0, |m: f64, x| m.max(x.abs()));
        let mut largest: Vec<f64> = (0..frames).map(of_frame).filter(|x| *x > 0.0).collect();
        largest.sort_by(f64::total_cmp);
        largest.get(largest.len() * 9 / 10).copied().unwrap_or(0.0)
    }

    /// The forces that were largest in any step since the frame before.
    fn pocket_peaks(&self) -> Option<Packed> {
        let directions: Vec<f64> = self.places.iter().map(|i| self.direction(*i)).collect();
        let mut values = Vec::new();
        for j in 0..self.count {
            let (low, high) =
                (self.of_element(j, "pocket_force min")?, self.of_element(j, "pocket_force max")?);
            let mut from = self.places[0];
            for (i, direction) in self.places.iter().zip(&directions) {
                let of_frame = low[from..=*i].iter().chain(&high[from..=*i]);
                let largest = of_frame.fold(0.0, |m: f64, x| if x.abs() > m.abs() { *x } else { m });
                values.push(direction * largest);
                from = (i + 1).min(low.len() - 1);
            }
        }
        Some(Packed::new(&values))
    }
}

/// Angle that the cage centre goes about the origin from the record before to record `i`, rad; zero closer to it than `least`.
fn whirl(y: &[f64], z: &[f64], i: usize, least: f64) -> f64 {
    let ([y0, z0], [y1, z1]) = ([y[i - 1], z[i - 1]], [y[i], z[i]]);
    let near = y0.hypot(z0).min(y1.hypot(z1)) < least;
    if near { 0.0 } else { (y0 * z1 - z0 * y1).atan2(y0 * y1 + z0 * z1).abs() }
}
