//! Touching places of rollers at a state, and their sums.

use crate::bodies::{CAGE, ForceSource, Inclination, OF_ROLLER, Power, RollerState};
use crate::laws::elastic::loaded::Loaded;
use crate::laws::elastic::tilted::Slice;
use crate::pairs::roller::{SliceLaws, Spot, SpotForces, SpotLaw, UnitWrench};
use crate::space::solid::{Moving, Vector, added, cross, dot, scaled, sum, to_global};
use pulp::Arch;

/// Parts of what a contact does: normal force, friction, rolling resistance.
pub(in super::super) const PARTS: usize = 3;
pub(in super::super) const NORMAL: usize = 0;
pub(in super::super) const FRICTION: usize = 1;
pub(in super::super) const ROLLING: usize = 2;

/// What a contact is with.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(in super::super) enum Place {
    /// The raceway of outer or inner ring.
    Raceway(usize),
    /// The bar in front or behind.
    Bar(usize),
    /// An end of the roller, by its place among those that may touch, at this mate.
    End(usize, usize),
}

impl Place {
    /// Which body: outer ring, inner ring, cage.
    pub(in super::super) fn mate(self) -> usize {
        match self {
            Self::Raceway(side) => side,
            Self::Bar(_) => CAGE,
            Self::End(_, mate) => mate,
        }
    }

    /// Powers of its damping, friction and rolling resistance.
    pub(in super::super) fn powers(self) -> [Power; PARTS] {
        match self {
            Self::Raceway(_) => [Power::RacewayDamping, Power::RacewayFriction, Power::RollingResistance],
            Self::Bar(_) | Self::End(_, CAGE) => {
                [Power::PocketDamping, Power::PocketFriction, Power::PocketFriction]
            }
            Self::End(..) => [Power::RibDamping, Power::RibFriction, Power::RibFriction],
        }
    }

    /// Under which its forces are reported.
    pub(in super::super) fn source(self) -> ForceSource {
        match self {
            Self::Raceway(0) => ForceSource::OuterRaceway,
            Self::Raceway(_) => ForceSource::InnerRaceway,
            Self::Bar(_) | Self::End(_, CAGE) => ForceSource::Pocket,
            Self::End(..) => ForceSource::Rib,
        }
    }
}

/// What a force and moment about the centre of a roller do to a mate whose centre is away from that by `-from_mate`, in the axes of the bearing.
pub(super) fn on_mate(
    [force, moment]: [Vector<f64>; 2],
    from_mate: Vector<f64>,
    direction: [f64; 2],
) -> [Vector<f64>; 2] {
    let about = sum(moment, cross(from_mate, force));
    [to_global(scaled(force, -1.0), direction), to_global(scaled(about, -1.0), direction)]
}

/// A roller at the last evaluated state.
#[derive(Clone, Copy, Debug)]
pub(in super::super) struct OneRoller {
    pub(in super::super) state: RollerState<f64>,
    /// Cosine and sine of its azimuth.
    pub(in super::super) direction: [f64; 2],
    /// Orbit angle since the start, rad.
    pub(in super::super) travel: f64,
    /// Forces of all contacts over its speeds.
    pub(in super::super) forces: [f64; OF_ROLLER],
}

const NO_FORCE: SpotForces<f64> =
    SpotForces { normal: 0.0, elastic: 0.0, damping: 0.0, secant: 0.0, rolling: 0.0 };

/// A place of a contact.
#[derive(Clone, Copy, Debug)]
pub(in super::super) struct Node {
    /// Its contact.
    pub(in super::super) contact: usize,
    /// Its place among the slices of its law.
    pub(in super::super) row: usize,
    pub(in super::super) slice: Slice,
    pub(in super::super) spot: Spot<f64>,
    pub(in super::super) force: SpotForces<f64>,
}

/// A contact of a roller.
#[derive(Clone, Copy, Debug)]
pub(in super::super) struct Contact {
    pub(in super::super) roller: usize,
    pub(in super::super) place: Place,
    /// Its place among the contacts of a roller, and its law among those of the rollers.
    pub(in super::super) in_list: usize,
    pub(in super::super) law: usize,
    /// Its places among all.
    pub(in super::super) first: usize,
    pub(in super::super) last: usize,
    /// Motion of the roller against the mate, at the centre of the roller.
    pub(in super::super) passing: Moving<f64>,
    /// Centre of the roller from that of the mate, m.
    pub(in super::super) from_mate: Vector<f64>,
    /// What is loaded of its length.
    pub(super) loaded: Loaded,
    /// Force and moment on the roller about its centre, by parts.
    pub(in super::super) parts: [[Vector<f64>; 2]; PARTS],
    /// Directions outwards and ahead in which a bent cage displaces the pocket.
    pub(in super::super) bent: Option<[Vector<f64>; 2]>,
    /// Normal force, at the state or in the step from it that was found last, N; of such a step also what the forces on the mate change by in the
    /// axes of the bearing, and powers of damping, friction and rolling resistance, W.
    pub(in super::super) reaction: [Vector<f64>; 2],
    pub(in super::super) normal: f64,
    pub(in super::super) powers: [f64; PARTS],
    /// And what acts on the displacement of a pocket changes by, N.
    pub(in super::super) on_bending: [f64; 2],
}

impl Contact {
    pub(in super::super) fn new(
        roller: usize,
        (place, in_list, law): (Place, usize, usize),
        passing: Moving<f64>,
        from_mate: Vector<f64>,
        loaded: Loaded,
    ) -> Self {
        Self {
            roller,
            place,
            in_list,
            law,
            first: 0,
            last: 0,
            passing,
            from_mate,
            loaded,
            parts: [[[0.0; 3]; 2]; PARTS],
            bent: None,
            reaction: [[0.0; 3]; 2],
            normal: 0.0,
            powers: [0.0; PARTS],
            on_bending: [0.0; 2],
        }
    }

    /// Length that is loaded, m.
    pub(in super::super) fn loaded(&self) -> f64 {
        self.loaded.length()
    }

    /// Its loaded parts, m.
    pub(in super::super) fn parts_loaded(&self) -> &[[f64; 2]] {
        self.loaded.parts()
    }

    /// Forces over the displacement of its pocket by a cage that bends, of this force on the roller, N.
    pub(in super::super) fn over_bending(&self, force: Vector<f64>) -> [f64; 2] {
        self.bent.map_or([0.0; 2], |axes| axes.map(|axis| -dot(axis, force)))
    }

    /// Force and moment on the roller about its centre.
    pub(in super::super) fn on_roller(&self) -> [Vector<f64>; 2] {
        self.parts.iter().fold([[0.0; 3]; 2], |sum, part| added(sum, *part))
    }
}

/// Adds a unit wrench times a force.
#[inline]
pub(super) fn add_scaled(sum: &mut [Vector<f64>; 2], wrench: &UnitWrench<f64>, force: f64) {
    for (sum, v) in sum.iter_mut().zip(wrench) {
        for k in 0..3 {
            sum[k] += v[k] * force;
        }
    }
}

/// What is known of rollers at the last evaluated state.
#[derive(Clone, Debug)]
pub(in super::super) struct RollerMemory {
    pub(in super::super) rollers: Vec<OneRoller>,
    pub(in super::super) contacts: Vec<Contact>,
    pub(in super::super) nodes: Vec<Node>,
    /// Slices of a contact that is being found.
    pub(in super::super) found: Vec<Slice>,
    /// Slices of every law that is one of line contacts.
    pub(in super::super) laws: Vec<Option<SliceLaws>>,
    /// Force and moment on outer ring, inner ring and cage about their centres, in the axes of the bearing.
    pub(in super::super) on_mates: [[Vector<f64>; 2]; 3],
}

impl RollerMemory {
    /// Without any roller.
    pub(in super::super) fn none() -> Self {
        Self::new(0, 0, &[])
    }

    pub(super) fn new(count: usize, slices: usize, laws: &[SpotLaw]) -> Self {
        let state = RollerState::new((1.0, Inclination::NONE), [0.0; 2], [0.0; 2], [0.0; OF_ROLLER]);
        let still = OneRoller { state, direction: [1.0, 0.0], travel: 0.0, forces: [0.0; OF_ROLLER] };
        Self {
            rollers: vec![still; count],
            contacts: Vec::with_capacity(2 * laws.len() * count),
            nodes: Vec::with_capacity(2 * laws.len() * count * slices),
            found: Vec::with_capacity(slices),
            laws: laws.iter().map(|law| Some(SliceLaws::new(law.line()?, 2 * count * slices))).collect(),
            on_mates: [[[0.0; 3]; 2]; 3],
        }
    }

    /// Forgets all contacts.
    pub(super) fn clear(&mut self) {
        self.contacts.clear();
        self.nodes.clear();
        self.laws.iter_mut().flatten().for_each(SliceLaws::clear);
    }

    /// Begins a contact.
    pub(super) fn open(&mut self, contact: Contact) {
        let first = self.nodes.len();
        self.contacts.push(Contact { first, last: first, ..contact });
    }

    /// Adds a place to it, with this share of edge friction.
    pub(super) fn add(&mut self, slice: Slice, spot: &Spot<f64>, edge_share: f64) {
        let contact = self.contacts.len() - 1;
        let mut row_of_law = 0;
        if let Some(slices) = &mut self.laws[self.contacts[contact].law] {
            slices.add(spot, edge_share);
            row_of_law = slices.rows() - 1;
        }
        self.nodes.push(Node { contact, row: row_of_law, slice, spot: *spot, force: NO_FORCE });
    }

    /// Ends it; one without places is none.
    pub(super) fn close(&mut self) {
        let last = self.nodes.len();
        if let Some(contact) = self.contacts.last_mut() {
            contact.last = last;
            if contact.first == last {
                self.contacts.pop();
            }
        }
    }

    /// Evaluates all laws, with the logarithm of the relative viscosity.
    pub(super) fn evaluate(&mut self, laws: &[SpotLaw], ln_viscosity: f64, instructions: Arch) {
        for slices in self.laws.iter_mut().flatten() {
            slices.apply(ln_viscosity, instructions);
        }
        for node in &mut self.nodes {
            let law = self.contacts[node.contact].law;
            let force = match &self.laws[law] {
                Some(slices) => slices.forces(node.row, &laws[law], node.spot.delta),
                None => laws[law].alone(&node.spot, ln_viscosity).unwrap_or(NO_FORCE),
            };
            let share = node.slice.share;
            node.force = SpotForces {
                normal: force.normal * share,
                elastic: force.elastic * share,
                damping: force.damping * share,
                secant: force.secant * share,
                rolling: force.rolling * share,
            };
        }
    }

    /// Finds the derivatives of all laws.
    pub(super) fn differentiate(&mut self, ln_viscosity: f64, instructions: Arch) {
        for slices in self.laws.iter_mut().flatten() {
            slices.differentiate(ln_viscosity, instructions);
        }
    }

    /// Adds the forces of all places up.
    pub(super) fn add_up(&mut self) {
        let Self { rollers, contacts, nodes, on_mates, .. } = self;
        *on_mates = [[[0.0; 3]; 2]; 3];
        for roller in rollers.iter_mut() {
            roller.forces = [0.0; OF_ROLLER];
        }
        for contact in contacts.iter_mut() {
            let roller = &mut rollers[contact.roller];
            let axis = roller.state.axis;
            let [mut normal, mut friction, mut rolling] = [[[0.0; 3]; 2]; PARTS];
            for Node { spot, force, .. } in &nodes[contact.first..contact.last] {
                add_scaled(&mut normal, &spot.normal, force.normal);
                add_scaled(&mut friction, &spot.along, -(force.secant * spot.slip[0]));
                add_scaled(&mut friction, &spot.across, -(force.secant * spot.slip[1]));
                add_scaled(&mut rolling, &spot.rolling, force.rolling);
            }
            contact.parts = [normal, friction, rolling];
            contact.normal = nodes[contact.first..contact.last].iter().map(|node| node.force.normal).sum();
            // Normal forces turn nothing about its own axis, not even by round-off.
            let own = dot(friction[1], axis) + dot(rolling[1], axis);
            let forces = roller.state.over_speeds(contact.on_roller(), own);
            roller.forces.iter_mut().zip(forces).for_each(|(sum, force)| *sum += force);
            let on = on_mate(contact.on_roller(), contact.from_mate, roller.direction);
            let sum_on = &mut on_mates[contact.place.mate()];
            *sum_on = [sum(sum_on[0], on[0]), sum(sum_on[1], on[1])];
        }
    }

    /// Elastic energy of all contacts, J.
    pub(super) fn elastic_energy(&self, laws: &[SpotLaw]) -> f64 {
        let of =
            |node: &Node| laws[self.contacts[node.contact].law].energy(node.spot.delta) * node.slice.share;
        self.nodes.iter().map(of).sum()
    }

    /// Mean normal speed of every loaded contact with a raceway, m/s.
    pub(in super::super) fn normal_speeds(&self) -> impl Iterator<Item = f64> {
        let on_raceways = self.contacts.iter().filter(|contact| matches!(contact.place, Place::Raceway(_)));
        on_raceways.filter_map(|contact| {
            let nodes = self.places(contact);
            let load: f64 = nodes.iter().map(|node| node.force.normal).sum();
            let speed: f64 = nodes.iter().map(|node| node.force.normal * node.spot.delta_dot).sum();
            (load > 0.0).then(|| speed / load)
        })
    }

    /// Places of a contact.
    pub(in super::super) fn places(&self, contact: &Contact) -> &[Node] {
        &self.nodes[contact.first..contact.last]
    }
}
