//! Output channels: the named quantities that a run records.

use super::forces::{
    ContactForces, FILM_THICKNESS, FRICTION, Forces, GuideReport, MEAN_PRESSURE, NORMAL_FORCE, SLIP_SPEED,
};
use crate::bodies::{CAGE, CAGE_MOTION, ForceSource, INNER_RING, Input, InputValues, OUTER_RING, displaced};
use crate::model::Model;
use crate::model::Workspace;
use crate::pairs::{ContactLaw, ElementPlace};
use crate::scalar::math;
use std::f64::consts::{PI, TAU};

/// A ring slower than this stands still for the slip channels, rad/s.
const STANDSTILL: f64 = 1e-9;

/// Share of the speed of the rings below which a speed without slip is none.
const NO_SPEED: f64 = 1e-9;

/// What a channel shows.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Source {
    CageY,
    CageZ,
    CageYRatio,
    CageZRatio,
    CageEccentricity,
    CageSpeed,
    CageSlip,
    WhirlSpeed,
    WhirlRadius,
    TouchingElements,
    GuideY,
    GuideZ,
    GuideMoment,
    GuideFilm,
    FilmShare,
    /// Component of a guide force: which, along eps (0) or phi (1).
    Guide(GuidePart, usize),
    /// Sum of the pocket forces on the cage along eps (0) or phi (1).
    PocketSum(usize),
    PocketMoment,
    Viscosity,
    /// Value of a node by its place among the velocities.
    Node(usize),
    RingY,
    RingZ,
    DragTorque,
    OuterRingTorque,
    OuterDragTorque,
    OrbitAngle(usize),
    RollerSlip(usize),
    PocketPosition(usize),
    PocketForce(usize),
    InnerForce(usize),
    OuterForce(usize),
    InnerFilm(usize),
    OuterFilm(usize),
    CageAngle,
    /// Amplitude of a pair of modes of the cage by the place of its first coordinate, and where its wave is highest.
    ModeAmplitude(usize),
    ModePhase(usize),
    ElasticEnergy,
    GuideHeat,
    WetArcs,
    WetAngle,
    /// Of a contact: its place among those of the element, and element.
    Traction(usize, usize),
    HertzPressure(usize, usize),
    SlidingPower(usize, usize),
}

/// Part of the guide force.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum GuidePart {
    Pressure,
    Shear,
    Solid,
}

/// A named output.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Channel {
    /// Name, for example `cage.y` or `roller[3].slip`.
    pub name: String,
    /// SI unit; "1" for ratios.
    pub unit: &'static str,
    /// What it is.
    pub description: &'static str,
    pub(super) source: Source,
    /// Whether records leave it out unless they name it.
    pub(super) detail: bool,
}

impl Model {
    /// The output channels of this scene.
    pub fn channels(&self) -> &[Channel] {
        &self.channels
    }

    pub(in crate::model) fn list_channels(&self) -> Vec<Channel> {
        let mut list = ChannelList(Vec::new());
        self.add_cage_channels(&mut list);
        if self.scene.inner_ring.is_some() {
            list.add("inner_ring.y", "m", "inner ring centre to the right", Source::RingY);
            list.add("inner_ring.z", "m", "inner ring centre upwards", Source::RingZ);
            let text = "torque that keeps the inner ring turning, positive against rolling drag";
            list.add("inner_ring.drag_torque", "N m", text, Source::DragTorque);
        }
        let text = "moment on the outer ring about its centre, positive counter-clockwise";
        list.add("outer_ring.torque", "N m", text, Source::OuterRingTorque);
        if let Some(ring) = self.scene.outer_ring.as_ref().filter(|ring| ring.speed.is_some()) {
            let text = "torque that keeps the outer ring turning, positive against rolling drag";
            // A ring that only a host may turn is no column of a table.
            let add = if ring.turns() { ChannelList::add } else { ChannelList::add_detail };
            add(&mut list, "outer_ring.drag_torque", "N m", text, Source::OuterDragTorque);
        }
        if self.inputs.oil.is_some() {
            let text = "dynamic viscosity of the lubricant at its temperature";
            list.add("lubricant.viscosity", "Pa s", text, Source::Viscosity);
        }
        for (node, at) in self.nodes_in() {
            for (state, place) in node.states().iter().zip(at) {
                let name = format!("{}.{}", node.name(), state.name);
                list.add(&name, state.unit, state.description, Source::Node(place));
            }
        }
        for j in 0..self.element_count() {
            self.add_element_channels(j, &mut list);
        }
        // Behind all others, so that records without them have the places of channels.
        list.0.sort_by_key(|channel| channel.detail);
        list.0.shrink_to_fit();
        list.0
    }

    fn add_cage_channels(&self, list: &mut ChannelList) {
        if !self.has_cage() {
            return;
        }
        list.add("cage.y", "m", "cage centre to the right", Source::CageY);
        list.add("cage.z", "m", "cage centre upwards", Source::CageZ);
        if self.guide().is_some() {
            let text = "cage centre to the right of the guide centre, over the radial guide clearance";
            list.add("cage.y_ratio", "1", text, Source::CageYRatio);
            let text = "cage centre above the guide centre, over the radial guide clearance";
            list.add("cage.z_ratio", "1", text, Source::CageZRatio);
            let text = "distance of the cage centre from the guide centre over the radial guide clearance";
            list.add("cage.eccentricity", "1", text, Source::CageEccentricity);
        }
        list.add("cage.angle", "rad", "rotation angle of the cage since the start", Source::CageAngle);
        list.add("cage.speed", "rad/s", "rotation speed of the cage", Source::CageSpeed);
        let text = "1 - cage speed over the speed without slip";
        list.add("cage.slip", "1", text, Source::CageSlip);
        let text = "speed of the cage centre about the guide centre, positive counter-clockwise";
        list.add("cage.whirl_speed", "rad/s", text, Source::WhirlSpeed);
        let text = "distance of the cage centre from the guide centre";
        list.add("cage.whirl_radius", "m", text, Source::WhirlRadius);
        if let Some((_, guide)) = self.guide() {
            let [film, solid] = guide.laws.map(|law| law.is_some());
            list.add("guide.force_y", "N", "guide force on the cage to the right", Source::GuideY);
            list.add("guide.force_z", "N", "guide force on the cage upwards", Source::GuideZ);
            list.add("guide.moment", "N m", "guide moment on the cage", Source::GuideMoment);
            list.add("guide.minimum_film", "m", "smallest gap of the guide", Source::GuideFilm);
            if film && solid {
                let text = "share of the film in the guide force";
                list.add("guide.film_share", "1", text, Source::FilmShare);
            }
            for (part, name, present) in [
                (GuidePart::Pressure, "pressure", film),
                (GuidePart::Shear, "shear", guide.shears),
                (GuidePart::Solid, "solid", solid),
            ] {
                if present {
                    let text = "guide force on the cage, along the line from guide to cage centre";
                    list.add(&format!("guide.{name}_eps"), "N", text, Source::Guide(part, 0));
                    let text = "guide force on the cage, across that line, positive counter-clockwise";
                    list.add(&format!("guide.{name}_phi"), "N", text, Source::Guide(part, 1));
                }
            }
        }
        self.add_elastic_channels(list);
        if self.has_pockets() {
            let text = "all pocket forces on the cage, along the line from guide to cage centre";
            list.add("pocket.force_eps", "N", text, Source::PocketSum(0));
            let text = "all pocket forces on the cage, across that line, positive counter-clockwise";
            list.add("pocket.force_phi", "N", text, Source::PocketSum(1));
            list.add("pocket.moment", "N m", "all pocket moments on the cage", Source::PocketMoment);
            let text = "number of elements that touch the cage";
            list.add("pocket.touching_elements", "1", text, Source::TouchingElements);
        }
    }

    /// Those of a cage that bends.
    fn add_elastic_channels(&self, list: &mut ChannelList) {
        let Some(ring) = self.scene.cage.as_ref().and_then(|cage| cage.elastic_ring.as_ref()) else { return };
        for (k, order) in (2..=ring.modes).enumerate() {
            let text = "amplitude of this wave of the bent ring";
            list.add(&format!("cage.mode[{order}].amplitude"), "m", text, Source::ModeAmplitude(2 * k));
            let text = "angle in the cage at which this wave is highest, as an angle of the wave";
            list.add(&format!("cage.mode[{order}].phase"), "rad", text, Source::ModePhase(2 * k));
        }
        list.add("cage.elastic_energy", "J", "energy of the bent ring", Source::ElasticEnergy);
        if let Some((_, guide)) = self.guide() {
            let text = "power that the guide takes: what its film and friction lose, and what its solid contact stores";
            list.add("guide.heat", "W", text, Source::GuideHeat);
            if guide.laws[0].is_some() {
                list.add("guide.wet_arcs", "1", "number of arcs that carry a film", Source::WetArcs);
                list.add("guide.wet_angle", "rad", "angle of all these arcs together", Source::WetAngle);
            }
        }
    }

    fn add_element_channels(&self, j: usize, list: &mut ChannelList) {
        let kind = self.element_kind();
        let mut add = |field: &str, unit, text, source| {
            list.add(&format!("{kind}[{j}].{field}"), unit, text, source);
        };
        add("orbit_angle", "rad", "angle of the element about the bearing", Source::OrbitAngle(j));
        if self.has_rollers() {
            add("slip", "1", "1 - spin speed over the spin without slip", Source::RollerSlip(j));
        }
        if self.has_pockets() {
            let text = "distance ahead of the pocket centre in the direction of rotation";
            add("pocket_position", "m", text, Source::PocketPosition(j));
            let text = "circumferential force on the cage, positive when it drives the cage";
            add("pocket_force", "N", text, Source::PocketForce(j));
        }
        if self.has_raceways() {
            add("inner_force", "N", "normal force on the inner raceway", Source::InnerForce(j));
            add("outer_force", "N", "normal force on the outer raceway", Source::OuterForce(j));
            let law = self.law_of(ForceSource::OuterRaceway).and_then(ContactLaw::line);
            if law.is_some_and(|law| law.film.is_some()) {
                add("inner_film", "m", "central film thickness on the inner raceway", Source::InnerFilm(j));
                add("outer_film", "m", "central film thickness on the outer raceway", Source::OuterFilm(j));
            }
        }
        for (place, (pair, name)) in self.contact_kinds().enumerate() {
            let name = name.trim_end_matches("_raceway");
            let text = "friction F_T on the element along the tangent of the contact";
            list.add_detail(&format!("{kind}[{j}].{name}_traction"), "N", text, Source::Traction(place, j));
            if self.laws[pair].line().is_some() {
                let text = "largest Hertz pressure in the contact; at the edge of a pocket as on its wall";
                let source = Source::HertzPressure(place, j);
                list.add_detail(&format!("{kind}[{j}].{name}_pressure"), "Pa", text, source);
            }
            let text = "power lost by sliding in the contact";
            let source = Source::SlidingPower(place, j);
            list.add_detail(&format!("{kind}[{j}].{name}_sliding_power"), "W", text, source);
        }
    }

    /// Value of one channel at (`q`, `v`) and these inputs, with `forces` that `ws` was evaluated for.
    pub(crate) fn channel_value(
        &self,
        channel: &Channel,
        q: &[f64],
        v: &[f64],
        inputs: &InputValues,
        ws: &Workspace,
        forces: &Forces,
    ) -> f64 {
        let [orbit, spin] = self.kinematic_speeds(inputs);
        let turning = match self.has_rollers() {
            true => inputs.of(Input::RingSpeed).abs().max(inputs.of(Input::OuterRingSpeed).abs()),
            false => orbit.abs(),
        };
        let direction = direction_of(orbit);
        let cage = |k: usize| self.layout.cage().map_or(0.0, |c| q[c + k]);
        let cage_speed = || self.layout.cage().map_or(0.0, |c| v[c + 2]);
        let clearance = self.guide_clearance().unwrap_or(f64::INFINITY);
        let on = |body: usize, source: ForceSource| forces.bodies[body][source as usize];
        let guide = |k: usize| on(CAGE, ForceSource::Guide)[k];
        let moment = |body: usize| forces.bodies[body].iter().map(|force| force[2]).sum::<f64>();
        let contact = |j: usize, k: usize| &forces.contacts[self.contacts_per_element() * j + k];
        let raceway = |j: usize, source: ForceSource, quantity: usize| {
            self.first_contact_of(source).map_or(0.0, |k| contact(j, k)[quantity])
        };
        // Without rotation there is no kinematic speed to compare with, and slip is reported as zero. Rings that turn against each
        // other can leave one that is round-off.
        let slip = |speed: f64, without_slip: f64| {
            let none = turning < STANDSTILL || without_slip.abs() < NO_SPEED * turning;
            if none { 0.0 } else { 1.0 - speed / without_slip }
        };
        match channel.source {
            Source::CageY => cage(0),
            Source::CageZ => cage(1),
            Source::CageYRatio => forces.guide.offset[0] / clearance,
            Source::CageZRatio => forces.guide.offset[1] / clearance,
            Source::CageEccentricity => forces.guide.radius() / clearance,
            Source::CageSpeed => cage_speed(),
            Source::CageSlip => slip(cage_speed(), orbit),
            Source::WhirlSpeed => forces.guide.whirl_speed(),
            Source::WhirlRadius => forces.guide.radius(),
            Source::TouchingElements => self.touching_elements(ws) as f64,
            Source::GuideY => guide(0),
            Source::GuideZ => guide(1),
            Source::GuideMoment => guide(2),
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
                let [y, z, _] = on(CAGE, ForceSource::Pocket);
                forces.guide.along([y, z])[k]
            }
            Source::PocketMoment => on(CAGE, ForceSource::Pocket)[2],
            Source::Viscosity => self.viscosity(&self.with_lumps(inputs, v)).unwrap_or(f64::NAN),
            Source::Node(place) => v[place],
            Source::RingY => self.motion_of(INNER_RING, q, v, inputs).position[0],
            Source::RingZ => self.motion_of(INNER_RING, q, v, inputs).position[1],
            // Weight and load have no moment about the centre of a ring.
            Source::DragTorque => -self.turning_of(INNER_RING, inputs) * moment(INNER_RING),
            Source::OuterDragTorque => -self.turning_of(OUTER_RING, inputs) * moment(OUTER_RING),
            Source::OuterRingTorque => moment(OUTER_RING),
            Source::OrbitAngle(j) => self.elements.azimuth(&self.layout, q, inputs, j),
            Source::RollerSlip(j) => slip(v[self.layout.spin(j)], spin),
            Source::PocketPosition(j) => direction * self.pocket_position(q, v, inputs, j),
            Source::PocketForce(j) => {
                let [y, z, _] = on(self.element_body(j), ForceSource::Pocket);
                -direction * ws.motions.frame(j).to_local([y, z])[1]
            }
            Source::InnerForce(j) => raceway(j, ForceSource::InnerRaceway, NORMAL_FORCE),
            Source::OuterForce(j) => raceway(j, ForceSource::OuterRaceway, NORMAL_FORCE),
            Source::InnerFilm(j) => raceway(j, ForceSource::InnerRaceway, FILM_THICKNESS),
            Source::OuterFilm(j) => raceway(j, ForceSource::OuterRaceway, FILM_THICKNESS),
            Source::CageAngle => cage(2),
            Source::ModeAmplitude(k) => math::hypot(cage(CAGE_MOTION + k), cage(CAGE_MOTION + k + 1)),
            Source::ModePhase(k) => math::atan2(cage(CAGE_MOTION + k + 1), cage(CAGE_MOTION + k)),
            Source::ElasticEnergy => self.elastic_energy_of_cage(ws),
            Source::GuideHeat => {
                self.guide().map_or(0.0, |(place, _)| -self.power_between(place, ws).iter().sum::<f64>())
            }
            Source::WetArcs => f64::from(self.wet_arcs(ws).0),
            Source::WetAngle => self.wet_arcs(ws).1,
            Source::Traction(ring, j) => contact(j, ring)[FRICTION],
            Source::HertzPressure(ring, j) => self.hertz_pressure(ring, contact(j, ring)).unwrap_or(0.0),
            Source::SlidingPower(ring, j) => {
                (contact(j, ring)[FRICTION] * contact(j, ring)[SLIP_SPEED]).abs()
            }
        }
    }

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

    /// Circumferential offset of element `j` in its pocket, m.
    fn pocket_position(&self, q: &[f64], v: &[f64], inputs: &InputValues, j: usize) -> f64 {
        let [travel, radial_offset] = self.elements.travel(&self.layout, q, inputs, j);
        let frame = self.elements.frame(&self.layout, q, inputs, j);
        let mate = self.motion_of(CAGE, q, v, inputs);
        let modes = q[self.layout.range(CAGE)].get(CAGE_MOTION..).unwrap_or(&[]);
        let basis = self.shared[CAGE].as_ref().map_or(&[][..], |cage| cage.displacements(j));
        let displacement = displaced(basis, modes);
        let place = ElementPlace { frame, radial_offset, travel, mate, displacement };
        self.pairs.iter().find_map(|pair| pair.offset(&place)).unwrap_or(0.0)
    }

    /// Number of wet arcs in the guide of a cage that bends, and their angle, rad.
    pub(crate) fn wet_arcs(&self, ws: &Workspace) -> (u32, f64) {
        self.guide().map_or((0, 0.0), |(place, _)| self.between[place].wet_arcs(&ws.motions))
    }

    /// Viscosity of the lubricant in Pa s at these inputs, if it follows the temperature.
    #[doc(hidden)]
    pub fn viscosity(&self, inputs: &InputValues) -> Option<f64> {
        self.inputs.oil.map(|oil| oil.law.viscosity(inputs.of(Input::Temperature)))
    }

    /// Number of elements with a force on the cage.
    fn touching_elements(&self, ws: &Workspace) -> usize {
        let touches = |j: usize| {
            ws.contacts.iter().any(|c| c.site.mate == CAGE && c.site.element == j && c.force.normal > 0.0)
        };
        (0..self.element_count()).filter(|&j| touches(j)).count()
    }
}

/// -1 for a clockwise speed, else 1.
fn direction_of(speed: f64) -> f64 {
    if speed < 0.0 { -1.0 } else { 1.0 }
}

/// Channels in the making.
struct ChannelList(Vec<Channel>);

impl ChannelList {
    fn add(&mut self, name: &str, unit: &'static str, description: &'static str, source: Source) {
        self.0.push(Channel { name: name.to_owned(), unit, description, source, detail: false });
    }

    fn add_detail(&mut self, name: &str, unit: &'static str, description: &'static str, source: Source) {
        self.0.push(Channel { name: name.to_owned(), unit, description, source, detail: true });
    }
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
