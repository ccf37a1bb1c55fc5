//! What is told of a cage in space: its channels, contacts in its pockets, forces on it and on the rings that guide it.

use super::super::report::{SpatialBodyForces, SpatialContact, channel};
use super::super::workspace::{Workspace, at_lane};
use super::super::{Reading, Source, Space};
use super::memory::Touching;
use crate::bodies::{Balls, CAGE, ForceSource};
use crate::model::Channel;
use crate::pairs::guide::land::Land;
use crate::scalar::{math, place_of};
use crate::space::solid::{Vector, added, cross, difference, dot, scaled, sum, to_global};

/// What a channel shows of a cage in space.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum OfCage {
    Position(usize),
    Speed,
    /// Of the centre from that of the guiding ring over the clearance, along y and z.
    Ratio(usize),
    Eccentricity,
    Tilt,
    WobbleSpeed,
    Slip,
    WhirlSpeed,
    WhirlRadius,
    /// Force or moment of all lands, in the order of components of forces.
    Guide(usize),
    SmallestGap,
    FilmShare,
    /// Part of the force of all lands, along the line from guide to cage centre or across it.
    GuidePart(usize, usize),
    LandGap(usize),
    LandEccentricity(usize),
    /// Largest of all lands.
    TiltOverGap,
    /// Force or moment of all pockets.
    Pocket(usize),
    /// Across the axis of the bearing, along that line or across it.
    PocketSum(usize),
    TouchingElements,
    /// Of a bent ring: the wave whose first coordinate has this place, and its energy, J.
    ModeAmplitude(usize),
    ModePhase(usize),
    ElasticEnergy,
    GuideHeat,
    WetArcs,
    WetAngle,
    /// Of a ball: place in its pocket along the axis, outwards or ahead.
    InPocket(usize, usize),
    PocketForce(usize),
    AxialPocketForce(usize),
}

impl OfCage {
    /// Whether it may peak between two records and is known in every step.
    pub(in super::super) fn can_be_watched(self) -> bool {
        matches!(
            self,
            Self::Eccentricity
                | Self::WhirlRadius
                | Self::Tilt
                | Self::Guide(_)
                | Self::SmallestGap
                | Self::GuidePart(..)
                | Self::LandGap(_)
                | Self::LandEccentricity(_)
                | Self::Pocket(_)
                | Self::PocketSum(_)
                | Self::PocketForce(_)
                | Self::AxialPocketForce(_)
        )
    }
}

/// Components of a vector along and across another one; itself where that is zero.
fn along([y, z]: [f64; 2], [a, b]: [f64; 2]) -> [f64; 2] {
    let size = math::hypot(y, z);
    if size == 0.0 { [a, b] } else { [(a * y + b * z) / size, (b * y - a * z) / size] }
}

/// Angular speed of a point at `at` that moves at `velocity`; zero in the centre.
fn around([y, z]: [f64; 2], [vy, vz]: [f64; 2]) -> f64 {
    let square = y * y + z * z;
    if square > 0.0 { (y * vz - z * vy) / square } else { 0.0 }
}

impl Space {
    /// Channels of the cage.
    pub(in super::super) fn add_cage_channels(&self, list: &mut Vec<Channel>) {
        let Some(cage) = &self.cage else { return };
        let mut add = |name: &str, unit, text, source| {
            list.push(channel(name.to_owned(), unit, text, Source::Cage(source), false));
        };
        add("cage.x", "m", "cage centre along the axis of the bearing", OfCage::Position(0));
        add("cage.y", "m", "cage centre to the right", OfCage::Position(1));
        add("cage.z", "m", "cage centre upwards", OfCage::Position(2));
        if !cage.lands.is_empty() {
            let text =
                "cage centre to the right of the guide centre, over the smallest radial guide clearance";
            add("cage.y_ratio", "1", text, OfCage::Ratio(0));
            let text = "cage centre above the guide centre, over the smallest radial guide clearance";
            add("cage.z_ratio", "1", text, OfCage::Ratio(1));
            let text =
                "distance of the cage centre from the guide centre over the smallest radial guide clearance";
            add("cage.eccentricity", "1", text, OfCage::Eccentricity);
        }
        add("cage.angle", "rad", "rotation angle of the cage since the start", OfCage::Position(3));
        add("cage.speed", "rad/s", "rotation speed of the cage", OfCage::Speed);
        add(
            "cage.tilt_y",
            "rad",
            "rotation vector of the axis of the cage, to the right",
            OfCage::Position(4),
        );
        add("cage.tilt_z", "rad", "rotation vector of the axis of the cage, upwards", OfCage::Position(5));
        add("cage.tilt", "rad", "angle of the axis of the cage to that of the bearing", OfCage::Tilt);
        let text =
            "speed at which the tilted axis goes around that of the bearing, positive counter-clockwise";
        add("cage.wobble_speed", "rad/s", text, OfCage::WobbleSpeed);
        let text = "speed without slip less cage speed, over the larger of both";
        add("cage.slip", "1", text, OfCage::Slip);
        let text = "speed of the cage centre about the guide centre, positive counter-clockwise";
        add("cage.whirl_speed", "rad/s", text, OfCage::WhirlSpeed);
        let text = "distance of the cage centre from the guide centre across the axis of the bearing";
        add("cage.whirl_radius", "m", text, OfCage::WhirlRadius);
        if !cage.lands.is_empty() {
            let has = |k: usize| cage.lands.iter().any(|land| land.laws()[k].is_some());
            let [film, solid] = [has(0), has(1)];
            add("guide.force_y", "N", "force of all lands on the cage to the right", OfCage::Guide(1));
            add("guide.force_z", "N", "force of all lands on the cage upwards", OfCage::Guide(2));
            add(
                "guide.moment",
                "N m",
                "moment of all lands on the cage about the axis of the bearing",
                OfCage::Guide(3),
            );
            add("guide.moment_y", "N m", "the same about the axis to the right", OfCage::Guide(4));
            add("guide.moment_z", "N m", "the same about the upward axis", OfCage::Guide(5));
            add("guide.minimum_film", "m", "smallest gap of all lands", OfCage::SmallestGap);
            if film && solid {
                let text = "largest share of the film in the force of a land";
                add("guide.film_share", "1", text, OfCage::FilmShare);
            }
            let text = "how far the tilt takes the edges of a land over the gap in its middle: films hold well below 1";
            add("guide.tilt_over_gap", "1", text, OfCage::TiltOverGap);
            let shears = cage.lands.iter().any(Land::shears);
            for (part, (name, present)) in
                [("pressure", film), ("shear", shears), ("solid", solid)].into_iter().enumerate()
            {
                if present {
                    let text = "guide force on the cage, along the line from guide to cage centre";
                    add(&format!("guide.{name}_eps"), "N", text, OfCage::GuidePart(part, 0));
                    let text = "guide force on the cage, across that line, positive counter-clockwise";
                    add(&format!("guide.{name}_phi"), "N", text, OfCage::GuidePart(part, 1));
                }
            }
            let beside = cage.lands.len() > 1 || cage.lands.iter().any(Land::off_middle);
            for k in (0..cage.lands.len()).filter(|_| beside) {
                let text = "smallest gap over the width of this land";
                add(&format!("land[{k}].minimum_gap"), "m", text, OfCage::LandGap(k));
                let text =
                    "distance of the cage centre from the ring centre in this land over its radial clearance";
                add(&format!("land[{k}].eccentricity"), "1", text, OfCage::LandEccentricity(k));
            }
        }
        for (k, (order, _)) in cage.body.waves().into_iter().enumerate() {
            let text = "amplitude of this wave of the bent ring";
            add(&format!("cage.mode[{order}].amplitude"), "m", text, OfCage::ModeAmplitude(2 * k));
            let text = "angle in the cage at which this wave is highest, as an angle of the wave";
            add(&format!("cage.mode[{order}].phase"), "rad", text, OfCage::ModePhase(2 * k));
        }
        if cage.body.bending() > 0 {
            add("cage.elastic_energy", "J", "energy of the bent ring", OfCage::ElasticEnergy);
            if !cage.lands.is_empty() {
                let text =
                    "power that all lands take: what films and friction lose, and what solid contacts store";
                add("guide.heat", "W", text, OfCage::GuideHeat);
            }
            if cage.lands.iter().any(|land| land.laws()[0].is_some()) {
                let text = "number of arcs that carry a film, of all lands";
                add("guide.wet_arcs", "1", text, OfCage::WetArcs);
                add("guide.wet_angle", "rad", "angle of all these arcs together", OfCage::WetAngle);
            }
        }
        if self.has_pockets() {
            let text = "all pocket forces on the cage along the axis of the bearing";
            add("pocket.force_x", "N", text, OfCage::Pocket(0));
            let text = "all pocket forces on the cage, along the line from guide to cage centre";
            add("pocket.force_eps", "N", text, OfCage::PocketSum(0));
            let text = "all pocket forces on the cage, across that line, positive counter-clockwise";
            add("pocket.force_phi", "N", text, OfCage::PocketSum(1));
            let text = "all pocket moments on the cage about the axis of the bearing";
            add("pocket.moment", "N m", text, OfCage::Pocket(3));
            add("pocket.moment_y", "N m", "the same about the axis to the right", OfCage::Pocket(4));
            add("pocket.moment_z", "N m", "the same about the upward axis", OfCage::Pocket(5));
            add(
                "pocket.touching_elements",
                "1",
                "number of elements that touch the cage",
                OfCage::TouchingElements,
            );
        }
    }

    /// Channels of ball `j` in its pocket.
    pub(in super::super) fn add_pocket_channels(&self, j: usize, list: &mut Vec<Channel>) {
        if !self.has_pockets() {
            return;
        }
        let kind = self.element_kind();
        let mut add = |field: &str, unit, text, source| {
            list.push(channel(format!("{kind}[{j}].{field}"), unit, text, Source::Cage(source), false));
        };
        let text = "distance ahead of the pocket centre in the direction of rotation";
        add("pocket_position", "m", text, OfCage::InPocket(2, j));
        let text = "distance from the pocket centre along the axis of the cage";
        add("pocket_axial", "m", text, OfCage::InPocket(0, j));
        let text = "circumferential force on the cage, positive when it drives the cage";
        add("pocket_force", "N", text, OfCage::PocketForce(j));
        add(
            "pocket_axial_force",
            "N",
            "force on the cage along the axis of the bearing",
            OfCage::AxialPocketForce(j),
        );
    }

    /// Value of a channel of the cage at the last evaluated state of `ws`, or in the step from there that was found last.
    pub(in super::super) fn cage_value(&self, source: OfCage, ws: &Workspace) -> f64 {
        let Some(cage) = &self.cage else { return f64::NAN };
        let memory = &ws.cage;
        let moving = &memory.moving;
        let ring = cage.lands.first().map_or(0, |land| land.ring);
        let bending = memory.bending();
        let [at, speed] = Land::offset(moving, &ws.rings[ring]);
        let clearance = || cage.lands.iter().map(Land::clearance).fold(f64::INFINITY, f64::min);
        let gap = |k: usize| cage.lands[k].smallest_gap(moving, &ws.rings[cage.lands[k].ring], bending);
        let [tilt_y, tilt_z] = [memory.state.position[4], memory.state.position[5]];
        let direction = if self.kinematic_speeds(&ws.inputs)[0] < 0.0 { -1.0 } else { 1.0 };
        let amplitude = |k: usize| memory.of_modes[0][k];
        let wet_arcs = || {
            let lands = cage.lands.iter().filter(|land| land.laws()[0].is_some());
            lands.map(|land| land.wet_arcs(moving, &ws.rings[land.ring], bending))
        };
        let of_all = |parts: &dyn Fn(usize) -> f64| (0..cage.lands.len()).map(parts).sum::<f64>();
        match source {
            OfCage::Position(k) => memory.state.position[k],
            OfCage::Speed => memory.state.rate[3],
            OfCage::Ratio(k) => at[k] / clearance(),
            OfCage::Eccentricity => math::hypot(at[0], at[1]) / clearance(),
            OfCage::Tilt => math::hypot(tilt_y, tilt_z),
            OfCage::WobbleSpeed => around([tilt_y, tilt_z], [memory.state.rate[4], memory.state.rate[5]]),
            OfCage::Slip => {
                let (free, own) = (self.kinematic_speeds(&ws.inputs)[0], memory.state.rate[3]);
                let larger = free.abs().max(own.abs());
                if free == 0.0 { 0.0 } else { direction * (free - own) / larger }
            }
            OfCage::WhirlSpeed => around(at, speed),
            OfCage::WhirlRadius => math::hypot(at[0], at[1]),
            OfCage::Guide(k) => of_all(&|i| memory.lands[i].on[0][k / 3][k % 3]),
            OfCage::SmallestGap => (0..cage.lands.len()).map(gap).fold(f64::INFINITY, f64::min),
            OfCage::FilmShare => memory.lands.iter().map(|land| land.film_share).fold(0.0, f64::max),
            OfCage::GuidePart(part, k) => {
                let sum = [0, 1].map(|i| of_all(&|land| memory.lands[land].parts[part][i]));
                along(at, sum)[k]
            }
            OfCage::LandGap(k) => gap(k),
            OfCage::LandEccentricity(k) => {
                let land = &cage.lands[k];
                let [[y, z], _] = land.eccentricity(moving, &ws.rings[land.ring]);
                math::hypot(y, z) / land.clearance()
            }
            OfCage::TiltOverGap => {
                let of = |land: &Land| land.tilt_over_gap(moving, &ws.rings[land.ring], bending);
                cage.lands.iter().map(of).fold(0.0, f64::max)
            }
            OfCage::Pocket(k) => self.by_pockets(ws)[k / 3][k % 3],
            OfCage::PocketSum(k) => {
                let [[_, y, z], _] = self.by_pockets(ws);
                along(at, [y, z])[k]
            }
            OfCage::TouchingElements if self.rollers.is_some() => self.rollers_in_touch(ws),
            OfCage::TouchingElements => {
                let mut count = 0.0;
                let mut last = None;
                for touching in memory.touching.iter().filter(|touching| touching.normal > 0.0) {
                    count += f64::from(u8::from(last.replace(touching.ball) != Some(touching.ball)));
                }
                count
            }
            OfCage::ModeAmplitude(k) => math::hypot(amplitude(k), amplitude(k + 1)),
            OfCage::ModePhase(k) => math::atan2(amplitude(k + 1), amplitude(k)),
            OfCage::ElasticEnergy => self.energy_of_bending(ws),
            OfCage::GuideHeat => -self.guide_powers(ws).iter().sum::<f64>(),
            OfCage::WetArcs => wet_arcs().map(|(count, _)| f64::from(count)).sum(),
            OfCage::WetAngle => wet_arcs().map(|(_, angle)| angle).sum(),
            OfCage::InPocket(k, j) if self.rollers.is_some() => {
                let place = self.roller_in_pocket(ws, j)[k];
                if k == 2 { direction * place } else { place }
            }
            OfCage::InPocket(k, j) => {
                let Some(pockets) = &cage.pockets else { return f64::NAN };
                let place = pockets.place(&self.in_pocket(ws, j), moving);
                if k == 2 { direction * place.q[k] } else { place.q[k] }
            }
            OfCage::PocketForce(j) => direction * self.on_cage_by(ws, j)[2],
            OfCage::AxialPocketForce(j) => self.on_cage_by(ws, j)[0],
        }
    }

    /// What is known of the contact of ball `j` with wall `wall` of its pocket; zeros where they are apart.
    pub(in super::super) fn pocket_values(&self, ws: &Workspace, wall: usize, j: usize) -> SpatialContact {
        let mut touching =
            ws.cage.touching.iter().filter(|touching| touching.ball == j && touching.wall == wall);
        let Some(touching) = touching.next() else { return SpatialContact::default() };
        let contact = &touching.contact;
        let (place, lane) = place_of(j);
        let block = &ws.blocks[place];
        let direction = at_lane(&block.direction, lane);
        let [x, rho] = at_lane(&block.at, lane);
        let r = self.set.pitch_radius + rho;
        let normal = contact.normal;
        // t is the direction outwards in the wall, l = n x t.
        let outwards = difference([0.0, 1.0, 0.0], scaled(normal, normal[1]));
        let t = scaled(outwards, 1.0 / dot(outwards, outwards).sqrt().max(f64::MIN_POSITIVE));
        let l = cross(normal, t);
        let in_wall = |v: Vector<f64>| [dot(v, t), dot(v, l), dot(v, normal)];
        let of_ball = Balls::moving(at_lane(&block.speeds, lane), r).turning;
        let of_cage = ws.cage.moving.moving.turning;
        let [cos, sin] = direction;
        let of_cage = [of_cage[0], cos * of_cage[1] + sin * of_cage[2], cos * of_cage[2] - sin * of_cage[1]];
        let [ft, fl, _] = in_wall(touching.friction);
        let [dt, dl, _] = in_wall(contact.slip);
        let [wt, wl, wn] = in_wall(difference(of_ball, of_cage));
        let [passing, ..] = in_wall(cross(of_ball, contact.levers[0]));
        let ratio = if wl == 0.0 { 0.0 } else { (wn / wl).abs() };
        let point = to_global(sum([x, r, 0.0], contact.levers[0]), direction);
        let n = to_global(normal, direction);
        let mut out = SpatialContact::default();
        out[..4].copy_from_slice(&[
            contact.force,
            contact.depth,
            contact.depth_rate,
            math::asin(normal[0].clamp(-1.0, 1.0)),
        ]);
        out[10..12].copy_from_slice(&[ft, fl]);
        out[16..24].copy_from_slice(&[dt, dl, wt, wl, wn, passing, passing - dt, ratio]);
        out[24..27].copy_from_slice(&point);
        out[27..30].copy_from_slice(&n);
        out
    }

    /// Adds the forces of pockets, lands, weight and load to those on the bodies.
    pub(in super::super) fn report_cage(&self, ws: &Workspace, bodies: &mut [SpatialBodyForces]) {
        let Some(cage) = &self.cage else { return };
        let mut add = |body: usize, source: ForceSource, parts: [Vector<f64>; 2]| {
            for (sum, part) in bodies[body][source as usize].iter_mut().zip(parts.as_flattened()) {
                *sum += part;
            }
        };
        for touching in &ws.cage.touching {
            let (block, lane) = place_of(touching.ball);
            let direction = at_lane(&ws.blocks[block].direction, lane);
            let [on_ball, on_cage] = touching
                .contact
                .wrenches_of(touching.contact.force, touching.friction)
                .map(|on| on.map(|v| to_global(v, direction)));
            add(self.body_of_ball(touching.ball), ForceSource::Pocket, on_ball);
            add(CAGE, ForceSource::Pocket, on_cage);
        }
        for (land, force) in cage.lands.iter().zip(&ws.cage.lands) {
            add(CAGE, ForceSource::Guide, force.on[0]);
            add(land.ring, ForceSource::Guide, force.on[1]);
        }
        add(CAGE, ForceSource::Gravity, cage.body.weight(&ws.cage.moving, self.gravity));
        add(CAGE, ForceSource::Load, ws.cage.load);
    }
}

impl Space {
    /// Whether its cage has pockets.
    pub(in super::super) fn has_pockets(&self) -> bool {
        let of_balls = self.cage.as_ref().is_some_and(|cage| cage.pockets.is_some());
        of_balls || self.rollers.as_ref().is_some_and(|rollers| rollers.bars() > 0)
    }

    /// Force and moment of all pockets on the cage, in a step where one was found.
    fn by_pockets(&self, ws: &Workspace) -> [Vector<f64>; 2] {
        if ws.step.is_none_or(|h| h == 0.0) {
            return ws.cage.by_pockets;
        }
        let sum = ws.cage.touching.iter().fold(ws.cage.by_pockets, |sum, of| added(sum, of.reaction));
        added(sum, self.reaction_of_rollers(ws, CAGE))
    }

    /// Force of element `j` on the cage in the axes of its azimuth, N.
    fn on_cage_by(&self, ws: &Workspace, j: usize) -> Vector<f64> {
        if self.rollers.is_some() {
            return self.roller_on_cage(ws, j);
        }
        let of_ball = ws.cage.touching.iter().filter(|touching| touching.ball == j);
        of_ball.fold([0.0; 3], |total, Touching { contact, normal, friction, .. }| {
            let [_, [force, _]] = contact.wrenches_of(*normal, *friction);
            sum(total, force)
        })
    }
}

impl Reading<'_> {
    /// How the cage moves.
    pub(in super::super) fn cage(&self, source: OfCage) -> f64 {
        self.space.cage_value(source, self.ws)
    }
}
