//! Touching places of rollers at a state, and their sums.

use super::{added, on_mate};
use crate::bodies::{ForceSource, OF_ROLLER, RollerState};
use crate::laws::elastic::loaded::Loaded;
use crate::laws::elastic::tilted::Slice;
use crate::laws::line_contact::LineContact;
use crate::pairs::roller::{SliceLaws, Spot, UnitWrench};
use crate::space::solid::{Moving, Vector, dot, scaled, sum};
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
}

impl Place {
    /// Which body: outer ring, inner ring, cage.
    pub(in super::super) fn mate(self) -> usize {
        match self {
            Self::Raceway(side) => side,
        }
    }

    /// Under which its forces are reported.
    pub(in super::super) fn source(self) -> ForceSource {
        match self {
            Self::Raceway(0) => ForceSource::OuterRaceway,
            Self::Raceway(_) => ForceSource::InnerRaceway,
        }
    }

    /// Its place among the contacts of a roller.
    pub(in super::super) fn in_list(self) -> usize {
        match self {
            Self::Raceway(side) => side,
        }
    }
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

/// Forces at a place of a contact.
#[derive(Clone, Copy, Debug, Default)]
pub(in super::super) struct SpotForce {
    /// Normal force, N, its elastic part, and its damping, N s/m.
    pub(in super::super) normal: f64,
    pub(in super::super) elastic: f64,
    pub(in super::super) damping: f64,
    /// Secant of friction, N s/m, and rolling resistance, N.
    pub(in super::super) secant: f64,
    pub(in super::super) rolling: f64,
}

/// A place of a contact.
#[derive(Clone, Copy, Debug)]
pub(in super::super) struct Node {
    /// Its contact.
    pub(in super::super) contact: usize,
    /// Its place among the slices of its law.
    pub(in super::super) row: usize,
    pub(in super::super) slice: Slice,
    pub(in super::super) spot: Spot<f64>,
    /// Unit wrenches over the speeds of the roller: of normal force, friction along and across, rolling resistance.
    pub(in super::super) rows: [[f64; OF_ROLLER]; 4],
    pub(in super::super) force: SpotForce,
}

/// A contact of a roller.
#[derive(Clone, Copy, Debug)]
pub(in super::super) struct Contact {
    pub(in super::super) roller: usize,
    pub(in super::super) place: Place,
    /// Its places among all.
    pub(in super::super) first: usize,
    pub(in super::super) last: usize,
    /// Motion of the roller against the mate, at the centre of the roller.
    pub(in super::super) passing: Moving<f64>,
    /// Centre of the roller from that of the mate, m.
    pub(in super::super) from_mate: Vector<f64>,
    /// What is loaded of its length.
    loaded: Loaded,
    /// Force and moment on the roller about its centre, by parts.
    pub(in super::super) parts: [[Vector<f64>; 2]; PARTS],
    /// In the step from the last evaluated state: what the forces on the mate change by in the axes of the bearing, normal force, and powers
    /// of damping, friction and rolling resistance, W.
    pub(in super::super) reaction: [Vector<f64>; 2],
    pub(in super::super) normal: f64,
    pub(in super::super) powers: [f64; PARTS],
}

impl Contact {
    pub(in super::super) fn new(
        roller: usize,
        place: Place,
        passing: Moving<f64>,
        from_mate: Vector<f64>,
        loaded: Loaded,
    ) -> Self {
        Self {
            roller,
            place,
            first: 0,
            last: 0,
            passing,
            from_mate,
            loaded,
            parts: [[[0.0; 3]; 2]; PARTS],
            reaction: [[0.0; 3]; 2],
            normal: 0.0,
            powers: [0.0; PARTS],
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

    /// Force and moment on the roller about its centre.
    pub(in super::super) fn on_roller(&self) -> [Vector<f64>; 2] {
        self.parts.iter().fold([[0.0; 3]; 2], |sum, part| added(sum, *part))
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
    /// Slices of outer and inner raceway.
    pub(in super::super) laws: Vec<SliceLaws>,
    /// Force and moment on outer ring, inner ring and cage about their centres, in the axes of the bearing.
    pub(in super::super) on_mates: [[Vector<f64>; 2]; 3],
}

/// A unit wrench over the speeds of a roller; what `turns` it about its own axis is not there by round-off.
fn row(state: &RollerState<f64>, wrench: &UnitWrench<f64>, turns: bool) -> [f64; OF_ROLLER] {
    let own = if turns { dot(wrench[1], state.tilt.axis) } else { 0.0 };
    state.over_speeds(*wrench, own)
}

impl RollerMemory {
    /// Without any roller.
    pub(in super::super) fn none() -> Self {
        Self::new(0, 0, &[])
    }

    pub(super) fn new(count: usize, slices: usize, laws: &[LineContact]) -> Self {
        let state = RollerState::new(1.0, [0.0; 2], [0.0; 2], [0.0; OF_ROLLER]);
        let still = OneRoller { state, direction: [1.0, 0.0], travel: 0.0, forces: [0.0; OF_ROLLER] };
        Self {
            rollers: vec![still; count],
            contacts: Vec::with_capacity(laws.len() * count),
            nodes: Vec::with_capacity(laws.len() * count * slices),
            found: Vec::with_capacity(slices),
            laws: laws.iter().map(|law| SliceLaws::new(law, count * slices)).collect(),
            on_mates: [[[0.0; 3]; 2]; 3],
        }
    }

    /// Forgets all contacts.
    pub(super) fn clear(&mut self) {
        self.contacts.clear();
        self.nodes.clear();
        self.laws.iter_mut().for_each(SliceLaws::clear);
    }

    /// Begins a contact.
    pub(super) fn open(&mut self, contact: Contact) {
        let first = self.nodes.len();
        self.contacts.push(Contact { first, last: first, ..contact });
    }

    /// Adds a slice to it, under the law of this place in the list.
    pub(super) fn add_slice(&mut self, law: usize, slice: Slice, spot: &Spot<f64>, edge_share: f64) {
        self.laws[law].add(spot, edge_share);
        self.add_node(self.laws[law].rows() - 1, slice, spot);
    }

    fn add_node(&mut self, row_of_law: usize, slice: Slice, spot: &Spot<f64>) {
        let contact = self.contacts.len() - 1;
        let state = &self.rollers[self.contacts[contact].roller].state;
        let rows = [
            row(state, &spot.normal, false),
            row(state, &spot.along, true),
            row(state, &spot.across, true),
            row(state, &spot.rolling, true),
        ];
        let force = SpotForce::default();
        self.nodes.push(Node { contact, row: row_of_law, slice, spot: *spot, rows, force });
    }

    /// Ends it.
    pub(super) fn close(&mut self) {
        let last = self.nodes.len();
        if let Some(contact) = self.contacts.last_mut() {
            contact.last = last;
        }
    }

    /// Evaluates all laws, with the logarithm of the relative viscosity.
    pub(super) fn evaluate(&mut self, ln_viscosity: f64, instructions: Arch) {
        for laws in &mut self.laws {
            laws.apply(ln_viscosity, instructions);
        }
        for node in &mut self.nodes {
            let Place::Raceway(side) = self.contacts[node.contact].place;
            let (force, share) = (self.laws[side].force(node.row), node.slice.share);
            // Q_el = 9/10 k delta of Palmgren's law.
            node.force = SpotForce {
                normal: force.normal * share,
                elastic: force.stiffness * node.spot.delta * (0.9 * share),
                damping: force.damping * share,
                secant: force.friction_secant * share,
                rolling: force.rolling_resistance * share,
            };
        }
    }

    /// Finds the derivatives of all laws.
    pub(super) fn differentiate(&mut self, ln_viscosity: f64, instructions: Arch) {
        for laws in &mut self.laws {
            laws.differentiate(ln_viscosity, instructions);
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
            for node in &nodes[contact.first..contact.last] {
                let (spot, force) = (&node.spot, &node.force);
                let [along, across] = spot.slip.map(|slip| -(force.secant * slip));
                let factors = [force.normal, along, across, force.rolling];
                for (row, factor) in node.rows.iter().zip(factors) {
                    for (sum, x) in roller.forces.iter_mut().zip(row) {
                        *sum += factor * x;
                    }
                }
                let wrenches = [&spot.normal, &spot.along, &spot.across, &spot.rolling];
                for ((wrench, factor), part) in
                    wrenches.into_iter().zip(factors).zip([NORMAL, FRICTION, FRICTION, ROLLING])
                {
                    let by = wrench.map(|v| scaled(v, factor));
                    contact.parts[part] = added(contact.parts[part], by);
                }
            }
            let on = on_mate(contact.on_roller(), contact.from_mate, roller.direction);
            let sum_on = &mut on_mates[contact.place.mate()];
            *sum_on = [sum(sum_on[0], on[0]), sum(sum_on[1], on[1])];
        }
    }

    /// Elastic energy of all contacts, J.
    pub(super) fn elastic_energy(&self, laws: &[LineContact; 2]) -> f64 {
        let of = |node: &Node| {
            let Place::Raceway(side) = self.contacts[node.contact].place;
            laws[side].elastic.energy(node.spot.delta) * node.slice.share
        };
        self.nodes.iter().map(of).sum()
    }

    /// Mean normal speed of every loaded contact with a raceway, m/s.
    pub(in super::super) fn normal_speeds(&self) -> impl Iterator<Item = f64> {
        self.contacts.iter().filter_map(|contact| {
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
