//! Output channels: the named quantities that a run records.

use crate::bodies::{ForceSource, INNER_RING, OUTER_RING, ROTOR};
use crate::model::Channel;
use crate::model::feedthrough::Sees;
use crate::model::plane::Plane;
use crate::pairs::ContactLaw;

/// What a channel shows.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Source {
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
    /// Component of the place of a ring or rotor: which, which component.
    Ring(usize, usize),
    /// Component of the force of all contacts on a ring.
    OnRing(usize, usize),
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
pub(crate) enum GuidePart {
    Pressure,
    Shear,
    Solid,
}

impl Source {
    /// What it is made of.
    pub(in crate::model) fn sees(self) -> Sees {
        match self {
            Self::CageY
            | Self::CageZ
            | Self::CageSpeed
            | Self::CageAngle
            | Self::Node(_)
            | Self::OrbitAngle(_)
            | Self::ModeAmplitude(_)
            | Self::ModePhase(_)
            | Self::ElasticEnergy => Sees::STATES,
            Self::CageYRatio
            | Self::CageZRatio
            | Self::CageEccentricity
            | Self::WhirlSpeed
            | Self::WhirlRadius
            | Self::Ring(..) => Sees::PLACES,
            // Also by the direction of rotation, which they count along.
            Self::CageSlip | Self::RollerSlip(_) | Self::PocketPosition(_) => Sees::SPEEDS,
            Self::Viscosity => Sees::TEMPERATURE,
            _ => Sees::FORCES,
        }
    }

    /// Whether it is a force, or something else that may peak between two records and is known in every step.
    fn can_be_watched(self) -> bool {
        matches!(
            self,
            Self::OuterForce(_)
                | Self::InnerForce(_)
                | Self::PocketForce(_)
                | Self::PocketSum(_)
                | Self::PocketMoment
                | Self::GuideY
                | Self::GuideZ
                | Self::GuideMoment
                | Self::Guide(..)
                | Self::GuideFilm
                | Self::DragTorque
                | Self::OuterRingTorque
                | Self::OuterDragTorque
                | Self::CageEccentricity
                | Self::WhirlRadius
        )
    }
}

impl Plane {
    /// All channels, details behind the others.
    pub(in crate::model) fn list_channels(&self) -> Vec<Channel> {
        let mut list = ChannelList(Vec::new());
        self.add_cage_channels(&mut list);
        if self.scene.inner_ring.is_some() {
            list.add("inner_ring.y", "m", "inner ring centre to the right", Source::Ring(INNER_RING, 0));
            list.add("inner_ring.z", "m", "inner ring centre upwards", Source::Ring(INNER_RING, 1));
            self.add_force_on_ring(INNER_RING, &mut list);
            let text = "torque that keeps the inner ring turning, positive against rolling drag";
            list.add("inner_ring.drag_torque", "N m", text, Source::DragTorque);
        }
        if self.scene.outer_motion().is_some() {
            list.add("outer_ring.y", "m", "outer ring centre to the right", Source::Ring(OUTER_RING, 0));
            list.add("outer_ring.z", "m", "outer ring centre upwards", Source::Ring(OUTER_RING, 1));
        }
        self.add_force_on_ring(OUTER_RING, &mut list);
        if self.scene.rotor.is_some() {
            list.add("rotor.y", "m", "rotor centre to the right", Source::Ring(ROTOR, 0));
            list.add("rotor.z", "m", "rotor centre upwards", Source::Ring(ROTOR, 1));
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

    /// What the bearing does to a ring: for who moves it a result, else a detail.
    fn add_force_on_ring(&self, ring: usize, list: &mut ChannelList) {
        let Some(body) = &self.shared[ring] else { return };
        let add = if body.moved_by().is_some() { ChannelList::add } else { ChannelList::add_detail };
        for (k, (component, text)) in [
            ("force_y", "force of rolling elements and cage on the ring, to the right"),
            ("force_z", "force of rolling elements and cage on the ring, upwards"),
        ]
        .into_iter()
        .enumerate()
        {
            let name = format!("{}.{component}", body.name());
            add(list, &name, "N", text, Source::OnRing(ring, k));
        }
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
        let text = "speed without slip less cage speed, over the larger of both";
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
            add(
                "slip",
                "1",
                "spin without slip less spin speed, over the larger of both",
                Source::RollerSlip(j),
            );
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
}

/// Channels in the making.
struct ChannelList(Vec<Channel>);

impl ChannelList {
    fn add(&mut self, name: &str, unit: &'static str, description: &'static str, source: Source) {
        self.push(name, unit, description, source, false);
    }

    fn add_detail(&mut self, name: &str, unit: &'static str, description: &'static str, source: Source) {
        self.push(name, unit, description, source, true);
    }

    fn push(
        &mut self,
        name: &str,
        unit: &'static str,
        description: &'static str,
        source: Source,
        detail: bool,
    ) {
        let can_be_watched = source.can_be_watched();
        let source = crate::model::Source::Plane(source);
        self.0.push(Channel { name: name.to_owned(), unit, description, source, detail, can_be_watched });
    }
}
