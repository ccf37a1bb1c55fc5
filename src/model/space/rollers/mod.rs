//! Rollers that skew and tilt among rings and cage: their contacts at a state.
//!
//! Every contact is a list of places with unit wrenches ([`Spot`]), whatever it is with: a raceway in slices, a rib, a pocket. What they do to the
//! roller is kept over its speeds, so that damping, forces of a step, powers and derivatives follow by the same code; what they do to the mate is
//! the opposite, moved to its centre.

pub(super) mod contacts;
mod line_loads;
mod raceways;
mod report;
mod slopes;
mod start;
mod step;
mod varied;

pub use line_loads::{LINE_LOAD_QUANTITIES, LineLoad};
pub(crate) use report::OfRollers;
pub(super) use varied::{AT_ONCE, Pass, Varied};

use super::Space;
use super::cage::add_to_modes;
use super::workspace::Workspace;
use crate::bodies::{
    CAGE, Fault, MovingCage, MovingRing, OF_ROLLER, RollerState, RollersInSpace, SOUND, Spacing,
};
use crate::error::Result;
use crate::laws::elastic::loaded::Loaded;
use crate::laws::elastic::profile::USUAL_SLICES;
use crate::laws::elastic::tilted::Slice;
use crate::laws::line_contact::LineContact;
use crate::pairs::raceway::RacewayGeometry;
use crate::pairs::roller::{Bars, EndPair, Shapes, SpotLaw};
use crate::pairs::{Law, parts_of_line};
use crate::scalar::{Numeric, math};
use crate::scene::{Scene, SlicesOn};
use crate::space::solid::{LARGEST_TILT, added, to_local};
use contacts::{Contact, Place, RollerMemory};

/// Names of the contacts with raceways.
const RACEWAYS: [&str; 2] = ["outer_raceway", "inner_raceway"];
/// With the bars of the cage.
const BARS: [&str; 2] = ["pocket_front", "pocket_back"];
/// Least slices of a contact with a bar.
const SLICES_OF_BAR: usize = 4;

/// Rollers with their pairs.
#[derive(Debug)]
pub(super) struct RollersOfScene {
    pub(super) body: RollersInSpace,
    spacing: Spacing,
    geometry: RacewayGeometry,
    /// Of outer and inner raceway, of bars.
    laws: Vec<SpotLaw>,
    bars: Option<Bars>,
    /// What ends of rollers may touch, and the places of the first among laws and contacts.
    ends: Vec<EndPair>,
    first_end: [usize; 2],
    /// a of nominal rollers, m.
    half_length: f64,
    shapes: Shapes,
    slices: usize,
    slices_on: SlicesOn,
    /// What a roller can touch, in the order of reports.
    pub(super) contacts: Vec<&'static str>,
}

impl RollersOfScene {
    /// Those of a scene, if its rollers move in space, with the lubricant at `viscosity` in Pa s.
    pub(super) fn new(
        scene: &Scene,
        set: &crate::bodies::ElementSet,
        viscosity: Option<f64>,
    ) -> Result<Option<Self>> {
        let (Some(body), Some(rollers)) = (RollersInSpace::new(scene, set), &scene.rollers) else {
            return Ok(None);
        };
        let Some((geometry, laws)) = crate::pairs::raceway::laws_of_scene(scene, viscosity)? else {
            return Ok(None);
        };
        let raceways = scene.raceways.as_ref();
        let shapes = Shapes::new(scene, [&laws[0], &laws[1]], set.count);
        let mut list: Vec<SpotLaw> = laws.into_iter().map(SpotLaw::Line).collect();
        let mut contacts: Vec<&'static str> = RACEWAYS.to_vec();
        let bars = crate::pairs::roller::bars(scene, viscosity)?.map(|(bars, law)| {
            list.push(law);
            contacts.extend(BARS);
            bars
        });
        let ends = crate::pairs::roller::ends(scene, &geometry, viscosity)?;
        let first_end = [list.len(), contacts.len()];
        for end in &ends {
            list.push(end.law);
            contacts.push(end.name);
        }
        Ok(Some(Self {
            body,
            spacing: Spacing::new(scene),
            geometry,
            laws: list,
            bars,
            ends,
            first_end,
            half_length: 0.5 * rollers.effective_length,
            shapes,
            slices: raceways.and_then(|raceways| raceways.slices).map_or(USUAL_SLICES, |n| n as usize),
            slices_on: rollers.space.as_ref().map(|space| space.slices_on).unwrap_or_default(),
            contacts,
        }))
    }

    /// Most slices of one contact.
    fn most_slices(&self) -> usize {
        self.slices.max(SLICES_OF_BAR) + 1
    }
}

impl Space {
    /// Finds how rollers move.
    pub(super) fn locate_rollers(
        &self,
        q: &[f64],
        v: &[f64],
        ws: &mut Workspace,
    ) -> std::result::Result<(), Fault> {
        let Some(rollers) = &self.rollers else { return Ok(()) };
        let pitch = self.set.pitch_radius;
        let levers = self.levers_of_rollers();
        for j in 0..self.layout.count {
            let places = self.layout.of_element::<OF_ROLLER>(j);
            let at = |k: usize| q[places[k]];
            let speeds = places.map(|place| v[place]);
            for (k, (speed, lever)) in speeds.iter().zip(levers).enumerate() {
                if speed.abs() * lever > SOUND {
                    return Err(Fault::TooFast { velocity: places[k], speed: speed.abs() * lever });
                }
            }
            for (way, offset) in [("radial", at(1)), ("axial", at(0))] {
                if offset.abs() > self.set.radius {
                    return Err(Fault::LostRoller { roller: j, way, offset });
                }
            }
            let angle = math::hypot(at(3), at(4));
            if angle > LARGEST_TILT {
                return Err(Fault::AskewRoller { roller: j, angle });
            }
            let state =
                RollerState::new((pitch, rollers.body.inclination), [at(0), at(1)], [at(3), at(4)], speeds);
            let (sin, cos) = math::sin_cos(self.set.reference_angles[j] + at(2));
            let roller = &mut ws.rollers.rollers[j];
            (roller.state, roller.direction, roller.travel) = (state, [cos, sin], at(2));
        }
        let memory = &ws.rollers.rollers;
        let place = |j: usize| [memory[j].state.at[1], memory[j].travel];
        match rollers.spacing.overlap(&self.set, place) {
            None => Ok(()),
            Some(overlap) => Err(overlap),
        }
    }

    /// Levers of the speeds of a roller, m or 1.
    pub(super) fn levers_of_rollers(&self) -> [f64; OF_ROLLER] {
        let (pitch, radius) = (self.set.pitch_radius, self.set.radius);
        let half = self.rollers.as_ref().map_or(0.0, |rollers| rollers.half_length);
        [1.0, 1.0, pitch, half, half, radius]
    }

    /// Finds the forces of all contacts of rollers.
    pub(super) fn apply_rollers(&self, ws: &mut Workspace) -> std::result::Result<(), Fault> {
        let Some(rollers) = &self.rollers else { return Ok(()) };
        ws.rollers.clear();
        for side in 0..2 {
            self.touch_raceway(rollers, side, ws);
        }
        if let Some(bars) = &rollers.bars {
            self.touch_bars(rollers, bars, ws)?;
        }
        self.touch_ends(rollers, ws);
        let Workspace { rollers: memory, fluid, instructions, .. } = ws;
        memory.evaluate(&rollers.laws, fluid.ln_viscosity, *instructions);
        memory.add_up();
        if ws.counting {
            self.count_of_rollers(ws);
        }
        Ok(())
    }

    /// Finds where rollers touch the bars of their pockets.
    fn touch_bars(
        &self,
        rollers: &RollersOfScene,
        bars: &Bars,
        ws: &mut Workspace,
    ) -> std::result::Result<(), Fault> {
        let furthest = self.set.radius / self.set.pitch_radius;
        for j in 0..self.layout.count {
            let (a, surface) = (rollers.shapes.half_length(j), rollers.shapes.surface(0, j));
            let of = ws.rollers.rollers[j];
            let excess = self.set.radius_excess[j];
            let lead = of.travel - ws.cage.moving.angle;
            if lead.abs() > furthest {
                return Err(Fault::OutOfPocket { element: j, lead });
            }
            let roller = of.state.motion();
            let bent = self.displaced_pocket(ws, j);
            let place = bars.place(&roller, of.direction, lead, &ws.cage.moving, bent);
            let apart = bars.apart(&place, a, excess);
            for (wall, apart) in apart.into_iter().enumerate() {
                if apart {
                    continue;
                }
                let Workspace { rollers: memory, cage, .. } = ws;
                memory.found.clear();
                Loaded::whole(a).slices(
                    rollers.half_length,
                    rollers.slices.max(SLICES_OF_BAR),
                    &mut memory.found,
                );
                let centre = to_local(cage.moving.centre, of.direction);
                let from_mate = [of.state.at[0] - centre[0], of.state.r - centre[1], -centre[2]];
                let contact = Contact::new(
                    j,
                    (Place::Bar(wall), 2 + wall, 2),
                    place.passing,
                    from_mate,
                    Loaded::whole(a),
                );
                memory.open(Contact { bent: bent.map(|_| place.displaced), ..contact });
                for i in 0..memory.found.len() {
                    let slice = memory.found[i];
                    let drop = surface.map_or(0.0, |surface| surface.of_roller(slice.place));
                    let touch = bars.spot(&place, wall, slice.place, excess, drop);
                    // A depth that is no number is told by the forces.
                    if touch.spot.delta > 0.0 || touch.spot.delta.is_nan() {
                        memory.add(slice, &touch.spot, touch.edge_share);
                    }
                }
                memory.close();
            }
        }
        Ok(())
    }

    /// Finds where ends of rollers touch ribs and sides of their pockets.
    fn touch_ends(&self, rollers: &RollersOfScene, ws: &mut Workspace) {
        let [first_law, first_contact] = rollers.first_end;
        for (k, end) in rollers.ends.iter().enumerate() {
            let Workspace { rollers: memory, rings, cage, .. } = ws;
            let of_mate = if end.mate == CAGE { as_ring(&cage.moving) } else { rings[end.mate] };
            for j in 0..self.layout.count {
                let of = &memory.rollers[j];
                let ring = of_mate.beside(of.direction);
                let roller = of.state.motion();
                let longer = rollers.shapes.longer(j);
                if end.geometry.apart(&roller, &ring, longer) {
                    continue;
                }
                let touch = end.geometry.touch(&roller, &ring, longer);
                // A depth that is no number is told by the forces.
                if touch.spot.delta <= 0.0 {
                    continue;
                }
                let centre = ring.centre;
                let from_mate = [of.state.at[0] - centre[0], of.state.r - centre[1], -centre[2]];
                let place = (Place::End(k, end.mate), first_contact + k, first_law + k);
                memory.open(Contact::new(j, place, touch.passing, from_mate, Loaded::default()));
                memory.add(Slice { place: 0.0, share: 1.0 }, &touch.spot, 0.0);
                memory.close();
            }
        }
    }

    /// Adds what rollers do to the cage, and over the modes of one that bends.
    pub(super) fn add_rollers_to_cage(&self, ws: &mut Workspace) {
        let Some(cage) = &self.cage else { return };
        let Workspace { rollers, cage: memory, .. } = ws;
        memory.by_pockets = added(memory.by_pockets, rollers.on_mates[CAGE]);
        if cage.body.bending() > 0 {
            for contact in rollers.contacts.iter().filter(|contact| contact.place.mate() == CAGE) {
                let by = contact.over_bending(contact.on_roller()[0]);
                add_to_modes(&mut memory.on_modes[0], cage.body.displacements(contact.roller), by);
            }
        }
    }

    fn count_of_rollers(&self, ws: &mut Workspace) {
        let Some(rollers) = &self.rollers else { return };
        for contact in &ws.rollers.contacts {
            match contact.place {
                Place::Raceway(side) => {
                    let law = [Law::OuterRaceway, Law::InnerRaceway][side];
                    ws.counts[law as usize] += 1;
                    for part in rollers.parts(side) {
                        ws.counts[part as usize] += 1;
                    }
                }
                Place::Bar(_) => ws.counts[Law::PocketWall as usize] += 1,
                Place::End(..) => ws.counts[Law::Rib as usize] += 1,
            }
        }
    }

    /// Writes the accelerations of rollers.
    pub(super) fn accelerate_rollers(&self, ws: &Workspace, a: &mut [f64]) {
        let Some(rollers) = &self.rollers else { return };
        let [gy, gz] = self.gravity;
        for (j, of) in ws.rollers.rollers.iter().enumerate() {
            let [cos, sin] = of.direction;
            let inertia = rollers.body.inertia(j);
            let by_contacts = of.state.accelerated(inertia, of.forces);
            let drift = of.state.drift(inertia, [gy * cos + gz * sin, gz * cos - gy * sin]);
            for (k, place) in self.layout.of_element::<OF_ROLLER>(j).into_iter().enumerate() {
                a[place] = by_contacts[k] + drift[k];
            }
        }
    }

    /// Energy of rollers and of their contacts: kinetic, elastic, of their weight, J.
    pub(super) fn energy_of_rollers(&self, ws: &Workspace) -> [f64; 3] {
        let Some(rollers) = &self.rollers else { return [0.0; 3] };
        let [gy, gz] = self.gravity;
        let mut sum = [0.0, ws.rollers.elastic_energy(&rollers.laws), 0.0];
        for (j, of) in ws.rollers.rollers.iter().enumerate() {
            let [cos, sin] = of.direction;
            let [mass, ..] = rollers.body.inertia(j);
            sum[0] += rollers.body.kinetic_energy(j, &of.state);
            sum[2] -= mass * of.state.r * (gy * cos + gz * sin);
        }
        sum
    }

    /// The first contact of rollers whose force is not finite, as a place among all.
    pub(super) fn roller_contact_not_finite(&self, ws: &Workspace) -> Option<usize> {
        let rollers = self.rollers.as_ref()?;
        let lost = ws
            .rollers
            .contacts
            .iter()
            .find(|contact| contact.on_roller().iter().flatten().any(|x| !x.is_finite()))?;
        Some(lost.roller * rollers.contacts.len() + lost.in_list)
    }
}

impl RollersOfScene {
    /// The laws of the contacts with one raceway beside elasticity.
    pub(super) fn parts(&self, side: usize) -> impl Iterator<Item = Law> {
        parts_of_line(self.raceway(side))
    }

    /// Law of a raceway.
    pub(super) fn raceway(&self, side: usize) -> &LineContact {
        match &self.laws[side] {
            SpotLaw::Line(law) => law,
            SpotLaw::Solid(_) | SpotLaw::Rib(_) => unreachable!("raceways are line contacts"),
        }
    }

    /// Bars that a roller can touch.
    pub(super) fn bars(&self) -> usize {
        if self.bars.is_some() { BARS.len() } else { 0 }
    }

    /// Ribs and sides of its pocket that a roller can touch.
    pub(super) fn ends(&self) -> usize {
        self.ends.len()
    }

    /// Memory for these.
    pub(super) fn memory(&self, count: usize) -> RollerMemory {
        RollerMemory::new(count, self.most_slices(), &self.laws)
    }
}

/// A cage as a ring.
pub(super) fn as_ring<T: Numeric>(cage: &MovingCage<T>) -> MovingRing<T> {
    MovingRing { centre: cage.centre, axis: cage.tilt.axis, moving: cage.moving, speed: cage.speed }
}
