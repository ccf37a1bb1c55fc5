//! What is told of rollers that skew and tilt: their channels, contacts, and the forces on bodies.

use super::super::report::{SpatialBodyForces, SpatialContact, channel};
use super::super::workspace::Workspace;
use super::super::{Source, Space};
use super::RollersOfScene;
use super::contacts::{Contact, Node, Place, on_mate};
use crate::bodies::{CAGE, ForceSource, SPIN};
use crate::laws::contact_pair::{ContactForce, ContactMotion};
use crate::laws::line_contact::LineContact;
use crate::model::feedthrough::Sees;
use crate::model::{Channel, Condition, STATIC_LIMIT_OF_ROLLERS};
use crate::scalar::math;
use crate::space::solid::{Vector, cross, difference, dot, scaled, sum, to_global, to_local};
use std::f64::consts::PI;

/// What a channel shows of a roller, or of all.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum OfRollers {
    /// Mean, standard deviation and largest size of the skew of all.
    MeanSkew,
    SkewSpread,
    LargestSkew,
    /// Of a roller: x, skew and tilt, slip.
    Axial(usize),
    Skew(usize),
    Tilt(usize),
    Slip(usize),
    /// Of contact and roller.
    Force(usize, usize),
    TiltMoment(usize, usize),
    SkewMoment(usize, usize),
    LineLoad(usize, usize),
    LineLoadAt(usize, usize),
    LoadedLength(usize, usize),
    Pressure(usize, usize),
    Film(usize, usize),
    SlidingPower(usize, usize),
}

impl OfRollers {
    /// What it is made of.
    pub(in super::super) fn sees(self) -> Sees {
        match self {
            Self::Slip(_) => Sees::SPEEDS,
            Self::MeanSkew
            | Self::SkewSpread
            | Self::LargestSkew
            | Self::Axial(_)
            | Self::Skew(_)
            | Self::Tilt(_) => Sees::STATES,
            _ => Sees::FORCES,
        }
    }

    /// Whether it may peak between two records and is known in every step.
    pub(in super::super) fn can_be_watched(self) -> bool {
        matches!(self, Self::Force(..) | Self::LargestSkew | Self::Skew(_) | Self::Tilt(_) | Self::Axial(_))
    }
}

impl RollersOfScene {
    /// Load per length at a place of a contact, N/m.
    pub(super) fn line_load(&self, node: &Node) -> f64 {
        if node.slice.share > 0.0 {
            node.force.normal / (node.slice.share * 2.0 * self.half_length)
        } else {
            0.0
        }
    }

    /// The most loaded place of a contact.
    fn deepest<'a>(&self, nodes: &'a [Node]) -> Option<&'a Node> {
        nodes.iter().max_by(|a, b| self.line_load(a).total_cmp(&self.line_load(b)))
    }

    /// Half width (m) and largest pressure (Pa) of Hertz's line contact at the most loaded place of a contact with a raceway.
    pub(super) fn hertz(&self, side: usize, node: &Node) -> [f64; 2] {
        let Some(law) = self.laws[side].line() else { return [0.0; 2] };
        let elastic = &law.elastic;
        let load = self.line_load(node) * elastic.length;
        if load <= 0.0 {
            return [0.0; 2];
        }
        let half_width = elastic.half_width(load);
        [half_width, 4.0 / PI * elastic.mean_pressure(load, half_width)]
    }
}

impl Space {
    /// Channels of all rollers together.
    pub(in super::super) fn add_rollers_channels(&self, list: &mut Vec<Channel>) {
        if self.rollers.is_none() {
            return;
        }
        let mut add = |name: &str, text, source| {
            list.push(channel(name.to_owned(), "rad", text, Source::Rollers(source), false));
        };
        add("rollers.mean_skew", "mean skew of the rollers", OfRollers::MeanSkew);
        add("rollers.skew_spread", "standard deviation of the skew among the rollers", OfRollers::SkewSpread);
        add("rollers.largest_skew", "largest size of the skew of a roller", OfRollers::LargestSkew);
    }

    /// Channels of roller `j`.
    pub(in super::super) fn add_roller_channels(&self, j: usize, list: &mut Vec<Channel>) {
        let Some(rollers) = &self.rollers else { return };
        let mut add = |field: &str, unit, text, source, detail| {
            list.push(channel(format!("roller[{j}].{field}"), unit, text, Source::Rollers(source), detail));
        };
        let text = "spin without slip less spin speed, over the larger of both";
        add("slip", "1", text, OfRollers::Slip(j), false);
        add("axial_offset", "m", "place along the axis of the bearing", OfRollers::Axial(j), false);
        let text = "rotation of its axis about that outwards: its +x end is at smaller angles where positive";
        add("skew", "rad", text, OfRollers::Skew(j), false);
        let text = "rotation of its axis about that along the orbit: its +x end is outside where positive";
        add("tilt", "rad", text, OfRollers::Tilt(j), false);
        for (k, end) in rollers.ends.iter().enumerate() {
            let [_, first] = rollers.first_end;
            let text = "normal force of an end of the roller";
            add(&format!("{}_force", end.name), "N", text, OfRollers::Force(first + k, j), false);
        }
        for k in [1, 0] {
            let ring = ["outer", "inner"][k];
            let mut of = |field: &str, unit, text, source, detail| {
                add(&format!("{ring}_{field}"), unit, text, source, detail);
            };
            of("force", "N", "normal force on the raceway", OfRollers::Force(k, j), false);
            let text = "moment on the roller about the axis along the orbit, which tilts it";
            of("tilt_moment", "N m", text, OfRollers::TiltMoment(k, j), false);
            let text = "moment on the roller about the outward axis, which skews it";
            of("skew_moment", "N m", text, OfRollers::SkewMoment(k, j), true);
            of("line_load", "N/m", "largest load per length", OfRollers::LineLoad(k, j), false);
            let text = "where that is, along the roller from its middle";
            of("line_load_at", "m", text, OfRollers::LineLoadAt(k, j), true);
            of("loaded_length", "m", "length that is loaded", OfRollers::LoadedLength(k, j), true);
            if rollers.raceway(k).film.is_some() {
                let text = "central film thickness at the largest load per length";
                of("film", "m", text, OfRollers::Film(k, j), false);
            }
            of("pressure", "Pa", "largest Hertz pressure", OfRollers::Pressure(k, j), true);
            let text = "power lost by sliding in the contact";
            of("sliding_power", "W", text, OfRollers::SlidingPower(k, j), true);
        }
    }

    /// Value of a channel at the last evaluated state of `ws`, or in the step from there that was found last.
    pub(in super::super) fn rollers_value(&self, source: OfRollers, ws: &Workspace) -> f64 {
        let Some(rollers) = &self.rollers else { return f64::NAN };
        let memory = &ws.rollers;
        let count = memory.rollers.len() as f64;
        let skews = || memory.rollers.iter().map(|roller| roller.state.angles[0]);
        let mean = || skews().sum::<f64>() / count;
        let contact = |k: usize, j: usize| {
            let touches = |contact: &&Contact| contact.roller == j && contact.in_list == k;
            memory.contacts.iter().find(touches)
        };
        let deepest = |k: usize, j: usize| rollers.deepest(memory.places(contact(k, j)?));
        let moment = |k: usize, j: usize, axis: usize| contact(k, j).map_or(0.0, |c| c.on_roller()[1][axis]);
        match source {
            OfRollers::MeanSkew => mean(),
            OfRollers::SkewSpread => {
                let mean = mean();
                (skews().map(|skew| (skew - mean) * (skew - mean)).sum::<f64>() / count).sqrt()
            }
            OfRollers::LargestSkew => skews().map(f64::abs).fold(0.0, f64::max),
            OfRollers::Axial(j) => memory.rollers[j].state.at[0],
            OfRollers::Skew(j) => memory.rollers[j].state.angles[0],
            OfRollers::Tilt(j) => memory.rollers[j].state.angles[1],
            OfRollers::Slip(j) => {
                let (free, own) =
                    (self.kinematic_speeds(&ws.inputs)[1], memory.rollers[j].state.speeds[SPIN]);
                let larger = free.abs().max(own.abs());
                if free == 0.0 { 0.0 } else { free.signum() * (free - own) / larger }
            }
            OfRollers::Force(k, j) => contact(k, j).map_or(0.0, |contact| contact.normal),
            OfRollers::TiltMoment(k, j) => moment(k, j, 2),
            OfRollers::SkewMoment(k, j) => moment(k, j, 1),
            OfRollers::LineLoad(k, j) => deepest(k, j).map_or(0.0, |node| rollers.line_load(node)),
            OfRollers::LineLoadAt(k, j) => deepest(k, j).map_or(0.0, |node| node.slice.place),
            OfRollers::LoadedLength(k, j) => contact(k, j).map_or(0.0, |contact| contact.loaded()),
            OfRollers::Pressure(k, j) => deepest(k, j).map_or(0.0, |node| rollers.hertz(k, node)[1]),
            OfRollers::Film(k, j) => deepest(k, j)
                .map_or(0.0, |node| memory.laws[k].as_ref().map_or(0.0, |laws| laws.force(node.row).film)),
            OfRollers::SlidingPower(k, j) => contact(k, j).map_or(0.0, |contact| {
                let lost = |node: &Node| {
                    let [along, across] = node.spot.slip;
                    node.force.secant * (along * along + across * across)
                };
                memory.places(contact).iter().map(lost).sum()
            }),
        }
    }

    /// Number of rollers that touch the cage.
    pub(in super::super) fn rollers_in_touch(&self, ws: &Workspace) -> f64 {
        let touches = |j: usize| {
            let mut with_cage = ws.rollers.contacts.iter();
            with_cage
                .any(|contact| contact.roller == j && contact.place.mate() == CAGE && contact.normal > 0.0)
        };
        (0..ws.rollers.rollers.len()).filter(|j| touches(*j)).count() as f64
    }

    /// Where roller `j` is in its pocket: along the axis of the cage, outwards and ahead, m.
    pub(in super::super) fn roller_in_pocket(&self, ws: &Workspace, j: usize) -> Vector<f64> {
        let Some(bars) = self.rollers.as_ref().and_then(|rollers| rollers.bars.as_ref()) else {
            return [f64::NAN; 3];
        };
        let (of, cage) = (&ws.rollers.rollers[j], &ws.cage.moving);
        let lead = of.travel - cage.angle;
        let bent = self.displaced_pocket(ws, j);
        let place = bars.place(&of.state.motion(), of.direction, lead, cage, bent);
        let centre = to_local(cage.centre, of.direction);
        let from_cage = [of.state.at[0] - centre[0], of.state.r - centre[1], -centre[2]];
        let [out, ahead] = place.offset;
        [dot(from_cage, place.axes[0]), out, ahead]
    }

    /// Force of roller `j` on the cage in the axes of its azimuth, N, with what the step that was found last has added.
    pub(in super::super) fn roller_on_cage(&self, ws: &Workspace, j: usize) -> Vector<f64> {
        let of = &ws.rollers.rollers[j];
        let on = |contact: &&Contact| contact.roller == j && contact.place.mate() == CAGE;
        ws.rollers.contacts.iter().filter(on).fold([0.0; 3], |total, contact| {
            let by_step = if ws.step.is_some_and(|h| h > 0.0) { contact.reaction[0] } else { [0.0; 3] };
            sum(total, difference(to_local(by_step, of.direction), contact.on_roller()[0]))
        })
    }

    /// Whether a condition holds in any contact of rollers.
    pub(in super::super) fn holds_of_rollers(
        &self,
        rollers: &RollersOfScene,
        condition: Condition,
        ws: &Workspace,
    ) -> bool {
        let memory = &ws.rollers;
        let on_raceways = || {
            let contacts = memory.contacts.iter();
            contacts.filter_map(|contact| match contact.place {
                Place::Raceway(side) => Some((side, contact, memory.places(contact))),
                _ => None,
            })
        };
        match condition {
            Condition::AtFloor => on_raceways().any(|(side, _, nodes)| {
                let law = LineContact { profile: None, ..*rollers.raceway(side) };
                nodes.iter().any(|node| {
                    let Some(slices) = &memory.laws[side] else { return false };
                    let [u1, u2] = node.spot.surface_speeds;
                    let motion =
                        ContactMotion { delta: node.spot.delta, delta_dot: node.spot.delta_dot, u1, u2 };
                    law.is_at_floor(&motion, ws.fluid.ln_viscosity, &slices.force(node.row))
                })
            }),
            Condition::OverPressed => on_raceways().any(|(side, _, nodes)| {
                rollers
                    .deepest(nodes)
                    .is_some_and(|node| rollers.hertz(side, node)[1] > STATIC_LIMIT_OF_ROLLERS)
            }),
            Condition::Unloaded => !on_raceways()
                .any(|(side, _, nodes)| side == 1 && nodes.iter().any(|node| node.force.normal > 0.0)),
            Condition::BeyondShoulder | Condition::OnLowShoulder => false,
        }
    }

    /// What is known of contact `k` of roller `j` at the last evaluated state; zeros where they are apart.
    pub(in super::super) fn roller_contact_values(
        &self,
        ws: &Workspace,
        k: usize,
        j: usize,
    ) -> SpatialContact {
        let mut out = SpatialContact::default();
        let Some(rollers) = &self.rollers else { return out };
        let memory = &ws.rollers;
        let touches = |contact: &&Contact| contact.roller == j && contact.in_list == k;
        let Some(contact) = memory.contacts.iter().find(touches) else { return out };
        let nodes = memory.places(contact);
        let Some(node) = rollers.deepest(nodes) else { return out };
        let of = &memory.rollers[j];
        let load: f64 = nodes.iter().map(|node| node.force.normal).sum();
        // By load, or of all places alike where there is none.
        let weight =
            |node: &Node| if load > 0.0 { node.force.normal / load } else { 1.0 / nodes.len() as f64 };
        let mean =
            |value: &dyn Fn(&Node) -> f64| nodes.iter().map(|node| weight(node) * value(node)).sum::<f64>();
        let n = scaled(node.spot.normal[0], -1.0);
        let t = node.spot.along[0];
        let l = cross(n, t);
        // From the centre of the roller to the middle of the load.
        let middle = mean(&|node| node.slice.place);
        let to_contact = sum(scaled(of.state.axis, middle), scaled(n, self.set.radius));
        let [force, moment] = contact.on_roller();
        let couple = difference(moment, cross(to_contact, force));
        let turning = contact.passing.turning;
        let ratio = if dot(turning, l) == 0.0 { 0.0 } else { (dot(turning, n) / dot(turning, l)).abs() };
        let slices = memory.laws[contact.law].as_ref();
        let law = slices.map_or(ContactForce::none(0.0), |slices| slices.force(node.row));
        let [b, pressure] = rollers.hertz(contact.law, node);
        let [x, _] = of.state.at;
        let point = to_global(sum([x, of.state.r, 0.0], to_contact), of.direction);
        let friction =
            |k: usize| nodes.iter().map(|node| -node.force.secant * node.spot.slip[k]).sum::<f64>();
        let [nx, ny, nz] = to_global(n, of.direction);
        out.copy_from_slice(&[
            load,
            nodes.iter().map(|node| node.spot.delta).fold(f64::NEG_INFINITY, f64::max),
            mean(&|node| node.spot.delta_dot),
            math::asin(n[0].clamp(-1.0, 1.0)),
            0.5 * contact.loaded(),
            b,
            pressure,
            law.film,
            law.film_ratio,
            law.temperature_rise,
            friction(0),
            friction(1),
            dot(couple, t),
            dot(couple, l),
            dot(couple, n),
            nodes.iter().map(|node| node.force.rolling).sum(),
            mean(&|node| node.spot.slip[0]),
            mean(&|node| node.spot.slip[1]),
            dot(turning, t),
            dot(turning, l),
            dot(turning, n),
            mean(&|node| node.spot.surface_speeds[0]),
            mean(&|node| node.spot.surface_speeds[1]),
            ratio,
            point[0],
            point[1],
            point[2],
            nx,
            ny,
            nz,
        ]);
        out
    }

    /// Writes the contacts of rollers, and adds their forces to those on the bodies.
    pub(in super::super) fn report_rollers(
        &self,
        ws: &Workspace,
        contacts: &mut Vec<SpatialContact>,
        bodies: &mut [SpatialBodyForces],
    ) {
        let Some(rollers) = &self.rollers else { return };
        for j in 0..ws.rollers.rollers.len() {
            contacts.extend((0..rollers.contacts.len()).map(|k| self.roller_contact_values(ws, k, j)));
            let [mass, ..] = rollers.body.inertia(j);
            let [gy, gz] = self.gravity;
            let body = self.body_of_ball(j);
            bodies[body][ForceSource::Gravity as usize] = [0.0, mass * gy, mass * gz, 0.0, 0.0, 0.0];
        }
        for contact in &ws.rollers.contacts {
            let of = &ws.rollers.rollers[contact.roller];
            let on_roller = contact.on_roller();
            let on = [
                (self.body_of_ball(contact.roller), on_roller.map(|v| to_global(v, of.direction))),
                (contact.place.mate(), on_mate(on_roller, contact.from_mate, of.direction)),
            ];
            let source = contact.place.source() as usize;
            for (body, parts) in on {
                for (sum, part) in bodies[body][source].iter_mut().zip(parts.as_flattened()) {
                    *sum += part;
                }
            }
        }
    }
}
