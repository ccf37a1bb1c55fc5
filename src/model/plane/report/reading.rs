//! Values of output channels at one state.

use super::channels::{GuidePart, Source};
use super::forces::{
    ContactForces, FILM_THICKNESS, FRICTION, Forces, GuideReport, MEAN_PRESSURE, NORMAL_FORCE, SLIP_SPEED,
};
use crate::bodies::{CAGE, CAGE_MOTION, ForceSource, INNER_RING, Input, InputValues, OUTER_RING, displaced};
use crate::model::plane::{Plane, Workspace};
use crate::pairs::{ContactLaw, ElementPlace};
use crate::scalar::math;
use crate::space::Motion;
use std::f64::consts::{PI, TAU};

/// A ring slower than this stands still for the slip channels, rad/s.
const STANDSTILL: f64 = 1e-9;

/// Share of the speed of the rings below which a speed without slip is none.
const NO_SPEED: f64 = 1e-9;

/// A state with what many channels show of it.
pub(crate) struct Reading<'a> {
    model: &'a Plane,
    q: &'a [f64],
    v: &'a [f64],
    inputs: InputValues,
    ws: &'a Workspace,
    forces: &'a Forces,
    /// Speeds of orbit and spin without slip, rad/s.
    without_slip: [f64; 2],
    /// Speed of the faster ring, or of elements that are prescribed, rad/s.
    turning: f64,
    cage: Motion<f64>,
}

impl<'a> Reading<'a> {
    /// Of (`q`, `v`) at these inputs, with `forces` that `ws` was evaluated for.
    pub fn new(
        model: &'a Plane,
        [q, v]: [&'a [f64]; 2],
        inputs: InputValues,
        ws: &'a Workspace,
        forces: &'a Forces,
    ) -> Self {
        let without_slip = model.kinematic_speeds(&inputs);
        let turning = match model.has_rollers() {
            true => inputs.of(Input::RingSpeed).abs().max(inputs.of(Input::OuterRingSpeed).abs()),
            false => without_slip[0].abs(),
        };
        let cage = model.motion_of(CAGE, q, v, &inputs);
        Self { model, q, v, inputs, ws, forces, without_slip, turning, cage }
    }

    /// What of the speed without slip is missing, as a share of the larger of both speeds: positive of what lags, above one of what
    /// turns backwards, never beyond two. Without rotation there is no speed to compare with, and slip is zero; rings that turn
    /// against each other can leave one that is round-off.
    fn slip(&self, speed: f64, without_slip: f64) -> f64 {
        if self.turning < STANDSTILL || without_slip.abs() < NO_SPEED * self.turning {
            return 0.0;
        }
        let ratio = speed / without_slip;
        if ratio.abs() <= 1.0 { 1.0 - ratio } else { (1.0 - ratio) / ratio.abs() }
    }

    /// Force and moment on a body of the report of this source: rings and cage have their places among the shared bodies there.
    fn on(&self, body: usize, source: ForceSource) -> [f64; 3] {
        self.forces.bodies[body][source as usize]
    }

    /// Moment of all forces on a body about its centre, N m.
    fn moment(&self, body: usize) -> f64 {
        self.forces.bodies[body].iter().map(|force| force[2]).sum()
    }

    /// Component of the force on a ring by what it touches, N.
    fn by_contacts(&self, ring: usize, k: usize) -> f64 {
        const SOURCES: [ForceSource; 3] =
            [ForceSource::OuterRaceway, ForceSource::InnerRaceway, ForceSource::Guide];
        SOURCES.into_iter().map(|source| self.on(ring, source)[k]).sum()
    }

    fn contact(&self, j: usize, place: usize) -> &ContactForces {
        &self.forces.contacts[self.model.contacts_per_element() * j + place]
    }

    fn raceway(&self, j: usize, source: ForceSource, quantity: usize) -> f64 {
        self.model.first_contact_of(source).map_or(0.0, |place| self.contact(j, place)[quantity])
    }

    /// Value of a channel.
    pub fn value(&self, source: Source) -> f64 {
        let Self { model, q, v, ref inputs, ws, forces, without_slip: [orbit, spin], .. } = *self;
        let direction = direction_of(orbit);
        let cage = |k: usize| model.layout.cage().map_or(0.0, |c| q[c + k]);
        let cage_speed = || model.layout.cage().map_or(0.0, |c| v[c + 2]);
        let clearance = model.guide_clearance().unwrap_or(f64::INFINITY);
        let [guide, pocket] = [ForceSource::Guide, ForceSource::Pocket].map(|source| self.on(CAGE, source));
        match source {
            Source::CageY => cage(0),
            Source::CageZ => cage(1),
            Source::CageYRatio => forces.guide.offset[0] / clearance,
            Source::CageZRatio => forces.guide.offset[1] / clearance,
            Source::CageEccentricity => forces.guide.radius() / clearance,
            Source::CageSpeed => cage_speed(),
            Source::CageSlip => self.slip(cage_speed(), orbit),
            Source::WhirlSpeed => forces.guide.whirl_speed(),
            Source::WhirlRadius => forces.guide.radius(),
            Source::TouchingElements => touching_elements(model, ws) as f64,
            Source::GuideY => guide[0],
            Source::GuideZ => guide[1],
            Source::GuideMoment => guide[2],
            Source::GuideFilm => forces.guide.minimum_film,
            Source::FilmShare => forces.guide.film_share,
            Source::Guide(part, k) => {
                let force = match part {
                    GuidePart::Pressure => forces.guide.pressure,
                    GuidePart::Shear => forces.guide.shear,
                    GuidePart::Solid => forces.guide.solid,
                };
                forces.guide.along(force)[k]
            }
            Source::PocketSum(k) => {
                let [y, z, _] = pocket;
                forces.guide.along([y, z])[k]
            }
            Source::PocketMoment => pocket[2],
            Source::Viscosity => {
                let mut inputs = *inputs;
                model.set_lumps(v, &mut inputs);
                model.inputs.viscosity(&inputs).unwrap_or(f64::NAN)
            }
            Source::Node(place) => v[place],
            Source::Ring(ring, k) => model.motion_of(ring, q, v, inputs).position[k],
            Source::OnRing(ring, k) => self.by_contacts(ring, k),
            // Weight and load have no moment about the centre of a ring.
            Source::DragTorque => -model.turning_of(INNER_RING, inputs) * self.moment(INNER_RING),
            Source::OuterDragTorque => -model.turning_of(OUTER_RING, inputs) * self.moment(OUTER_RING),
            Source::OuterRingTorque => self.moment(OUTER_RING),
            Source::OrbitAngle(j) => model.elements.azimuth(&model.layout, q, inputs, j),
            Source::RollerSlip(j) => self.slip(v[model.layout.spin(j)], spin),
            Source::PocketPosition(j) => direction * self.pocket_position(j),
            Source::PocketForce(j) => {
                let [y, z, _] = self.on(model.element_body(j), ForceSource::Pocket);
                -direction * ws.motions.frame(j).to_local([y, z])[1]
            }
            Source::InnerForce(j) => self.raceway(j, ForceSource::InnerRaceway, NORMAL_FORCE),
            Source::OuterForce(j) => self.raceway(j, ForceSource::OuterRaceway, NORMAL_FORCE),
            Source::InnerFilm(j) => self.raceway(j, ForceSource::InnerRaceway, FILM_THICKNESS),
            Source::OuterFilm(j) => self.raceway(j, ForceSource::OuterRaceway, FILM_THICKNESS),
            Source::CageAngle => cage(2),
            Source::ModeAmplitude(k) => math::hypot(cage(CAGE_MOTION + k), cage(CAGE_MOTION + k + 1)),
            Source::ModePhase(k) => math::atan2(cage(CAGE_MOTION + k + 1), cage(CAGE_MOTION + k)),
            Source::ElasticEnergy => model.elastic_energy_of_cage(ws),
            Source::GuideHeat => {
                model.guide().map_or(0.0, |(place, _)| -model.power_between(place, ws).iter().sum::<f64>())
            }
            Source::WetArcs => f64::from(model.wet_arcs(ws).0),
            Source::WetAngle => model.wet_arcs(ws).1,
            Source::Traction(ring, j) => self.contact(j, ring)[FRICTION],
            Source::HertzPressure(ring, j) => {
                model.hertz_pressure(ring, self.contact(j, ring)).unwrap_or(0.0)
            }
            Source::SlidingPower(ring, j) => {
                (self.contact(j, ring)[FRICTION] * self.contact(j, ring)[SLIP_SPEED]).abs()
            }
        }
    }

    /// Circumferential offset of element `j` in its pocket, m.
    fn pocket_position(&self, j: usize) -> f64 {
        let Self { model, q, ref inputs, .. } = *self;
        let [travel, radial_offset] = model.elements.travel(&model.layout, q, inputs, j);
        let frame = model.elements.frame(&model.layout, q, inputs, j);
        let modes = q[model.layout.range(CAGE)].get(CAGE_MOTION..).unwrap_or(&[]);
        let basis = model.shared[CAGE].as_ref().map_or(&[][..], |cage| cage.displacements(j));
        let displacement = displaced(basis, modes);
        let place = ElementPlace { frame, radial_offset, travel, mate: self.cage, displacement };
        model.pairs.iter().find_map(|pair| pair.offset(&place)).unwrap_or(0.0)
    }
}

impl Plane {
    /// Largest pressure of Hertz's line contact of an element, by the place of the contact among those of the element, Pa; with a
    /// profile that of the middle. Of a straight one under the load Q: sqrt(Q E'/(2 pi R l)). E' = 2/((1 - nu1^2)/E1 + (1 - nu2^2)/E2), 1/R curvature, l length.
    fn hertz_pressure(&self, place: usize, contact: &ContactForces) -> Option<f64> {
        let (pair, _) = self.contact_kinds().nth(place)?;
        let ContactLaw::Line(law) = &self.laws[pair] else { return None };
        if law.profile.is_some() {
            return Some(4.0 / PI * contact[MEAN_PRESSURE]);
        }
        let (line, load) = (&law.elastic, contact[NORMAL_FORCE]);
        Some((load.max(0.0) * line.effective_modulus / (TAU * line.equivalent_radius * line.length)).sqrt())
    }

    /// 1 where the elements go round counter-clockwise at these inputs, else -1.
    pub(super) fn direction(&self, inputs: &InputValues) -> f64 {
        let [orbit, _] = self.kinematic_speeds(inputs);
        direction_of(orbit)
    }

    /// 1 where a ring turns counter-clockwise at these inputs, else -1. Beside an outer ring that cannot turn the inner one goes the way
    /// of the elements.
    pub(super) fn turning_of(&self, ring: usize, inputs: &InputValues) -> f64 {
        match self.turned_by(ring).filter(|_| self.is_driven(OUTER_RING)) {
            Some(speed) => direction_of(inputs.of(speed)),
            None => self.direction(inputs),
        }
    }

    /// Number of wet arcs in the guide of a cage that bends, and their angle, rad.
    pub(crate) fn wet_arcs(&self, ws: &Workspace) -> (u32, f64) {
        self.guide().map_or((0, 0.0), |(place, _)| self.between[place].wet_arcs(&ws.motions))
    }
}

/// Number of elements with a force on the cage.
fn touching_elements(model: &Plane, ws: &Workspace) -> usize {
    let touches = |j: usize| {
        ws.contacts.iter().any(|c| c.site.mate == CAGE && c.site.element == j && c.force.normal > 0.0)
    };
    (0..model.element_count()).filter(|&j| touches(j)).count()
}

/// -1 for a clockwise speed, else 1.
fn direction_of(speed: f64) -> f64 {
    if speed < 0.0 { -1.0 } else { 1.0 }
}

impl GuideReport {
    /// Distance of the cage centre from the guide centre, m.
    fn radius(&self) -> f64 {
        radius(self.offset)
    }

    /// Angular speed of the cage centre about the guide centre, rad/s; zero in the centre.
    fn whirl_speed(&self) -> f64 {
        let [y, z] = self.offset;
        let square = y * y + z * z;
        if square > 0.0 { (y * self.velocity[1] - z * self.velocity[0]) / square } else { 0.0 }
    }

    /// Components of a vector along and across the line from guide to cage centre; (y, z) itself in the centre.
    fn along(&self, force: [f64; 2]) -> [f64; 2] {
        along(self.offset, force)
    }
}

/// Length of a vector.
pub(super) fn radius([y, z]: [f64; 2]) -> f64 {
    math::hypot(y, z)
}

/// Components of a vector along and across another one; (y, z) itself where that is zero.
pub(super) fn along(offset: [f64; 2], [fy, fz]: [f64; 2]) -> [f64; 2] {
    let radius = radius(offset);
    let [dy, dz] = if radius > 0.0 { offset.map(|x| x / radius) } else { [1.0, 0.0] };
    [fy * dy + fz * dz, fz * dy - fy * dz]
}
