//! The force evaluation: from a state to the forces of every contact and the accelerations.
//!
//! Three passes: find the contacts that touch and write their motions into one contiguous list per law; run each
//! law over its list; collect the forces on the bodies. A contact that is apart costs its distance check.

use super::{Fault, InputValues, Model, PocketLaws, RingBody};
use crate::contact::pocket::{CageMotion, Pillar, PillarContact, PocketMotion};
use crate::contact::raceway::{RingMotion, RollerMotion};
use crate::contact::{PairFrame, Wrench, guide, rotate};
use crate::integrate::{DampingBlock, implicit_share};
use crate::laws::journal::{FilmForce, JournalMotion};
use crate::laws::line_contact::{ContactMotion, LineContactForce};
use crate::scalar::{Dual, Real};
use nalgebra::{Matrix3, Vector3};

/// A roller this far from the pitch circle, in pitch radii, has left the bearing.
const LOST_ROLLER: f64 = 0.25;
/// A ring or cage this far from the centre, in pitch radii, has left the bearing.
const LOST_BODY: f64 = 1.0;

/// The touching contacts of one law. Capacity is fixed at creation, so filling it does not allocate.
#[derive(Clone, Debug)]
pub(super) struct Batch<S> {
    pub(super) roller: Vec<usize>,
    pub(super) motion: Vec<ContactMotion<f64>>,
    pub(super) frame: Vec<PairFrame<f64>>,
    pub(super) site: Vec<S>,
    pub(super) force: Vec<LineContactForce<f64>>,
}

impl<S> Batch<S> {
    fn with_capacity(n: usize) -> Self {
        Self {
            roller: Vec::with_capacity(n),
            motion: Vec::with_capacity(n),
            frame: Vec::with_capacity(n),
            site: Vec::with_capacity(n),
            force: Vec::with_capacity(n),
        }
    }

    fn clear(&mut self) {
        self.roller.clear();
        self.motion.clear();
        self.frame.clear();
        self.site.clear();
        self.force.clear();
    }

    fn push(&mut self, roller: usize, motion: ContactMotion<f64>, frame: PairFrame<f64>, site: S) {
        self.roller.push(roller);
        self.motion.push(motion);
        self.frame.push(frame);
        self.site.push(site);
    }

    /// Contacts with their forces, in the order of the rollers.
    pub(super) fn iter(&self) -> impl Iterator<Item = Loaded<'_, S>> {
        let kinematics = self.roller.iter().zip(&self.motion).zip(&self.frame);
        kinematics
            .zip(self.site.iter().zip(&self.force))
            .map(|(((&roller, motion), frame), (site, force))| Loaded { roller, motion, frame, site, force })
    }
}

/// One contact of a batch.
pub(super) struct Loaded<'a, S> {
    pub(super) roller: usize,
    pub(super) motion: &'a ContactMotion<f64>,
    pub(super) frame: &'a PairFrame<f64>,
    pub(super) site: &'a S,
    pub(super) force: &'a LineContactForce<f64>,
}

/// What a pillar contact needs besides its motion.
#[derive(Clone, Copy, Debug)]
pub(super) struct PocketSite {
    pub(super) pillar: Pillar,
    edge_share: f64,
    /// Contact point relative to the cage centre, pocket frame, m.
    lever: [f64; 2],
    /// Sine and cosine of the angle by which the roller leads its pocket.
    lead: (f64, f64),
}

/// Motion of a roller and the direction of its local frame.
#[derive(Clone, Copy, Debug)]
pub(super) struct RollerSite {
    pub(super) motion: RollerMotion<f64>,
    pub(super) sin: f64,
    pub(super) cos: f64,
    /// Roller centre relative to its pocket, pocket frame, m; zero without pockets.
    pub(super) pocket_offset: [f64; 2],
}

impl RollerSite {
    /// A global vector in the roller's local frame.
    pub(super) fn to_local(self, v: [f64; 2]) -> [f64; 2] {
        rotate(v, -self.sin, self.cos)
    }

    /// A local vector in the global frame.
    pub(super) fn to_global(self, v: [f64; 2]) -> [f64; 2] {
        rotate(v, self.sin, self.cos)
    }
}

/// Memory of a force evaluation and its results. One per simulation; never shared.
#[derive(Clone, Debug)]
pub struct Workspace {
    pub(super) rollers: Vec<RollerSite>,
    pub(super) outer: Batch<()>,
    pub(super) inner: Batch<()>,
    pub(super) wall: Batch<PocketSite>,
    pub(super) edge: Batch<PocketSite>,
    pub(super) guide: Option<FilmForce<f64>>,
    /// Motion of the cage that `guide` belongs to.
    journal: JournalMotion<f64>,
    pub(super) inputs: InputValues,
    /// Contact forces on each roller, local frame.
    on_roller: Vec<Wrench<f64>>,
}

impl Workspace {
    /// Memory for evaluations of `model`.
    pub fn new(model: &Model) -> Self {
        let n = model.layout.count;
        let pockets = if model.cage.as_ref().is_some_and(|c| c.pocket.is_some()) { 2 * n } else { 0 };
        Self {
            rollers: Vec::with_capacity(n),
            outer: Batch::with_capacity(n),
            inner: Batch::with_capacity(n),
            wall: Batch::with_capacity(pockets),
            edge: Batch::with_capacity(pockets),
            guide: None,
            journal: JournalMotion {
                position: [0.0; 2],
                velocity: [0.0; 2],
                journal_speed: 0.0,
                bush_speed: 0.0,
                profile_angle: 0.0,
                profile_speed: 0.0,
            },
            inputs: InputValues::default(),
            on_roller: vec![Wrench::default(); n],
        }
    }

    /// Number of contacts that touched in the last evaluation: raceways, pockets.
    pub fn active_contacts(&self) -> [usize; 2] {
        [self.outer.roller.len() + self.inner.roller.len(), self.wall.roller.len() + self.edge.roller.len()]
    }
}

impl Model {
    /// Accelerations `a` (shape: velocities; m/s^2 or rad/s^2) at positions `q` and velocities `v`.
    ///
    /// # Errors
    /// A [`Fault`] when forces are undefined at this state; `a` is then meaningless.
    ///
    /// # Panics
    /// When a slice is shorter than its shape, or `ws` was made for another model.
    pub fn accelerations(
        &self,
        inputs: InputValues,
        q: &[f64],
        v: &[f64],
        ws: &mut Workspace,
        a: &mut [f64],
    ) -> Result<(), Fault> {
        ws.inputs = inputs;
        self.locate(q, v, ws)?;
        self.apply_laws(q, v, ws)?;
        self.assemble(q, v, ws, a);
        match a.iter().position(|x| !x.is_finite()) {
            None => Ok(()),
            Some(velocity) => Err(Fault::NotFinite { velocity }),
        }
    }

    /// Ring position and velocity, global frame.
    pub(super) fn ring_motion(&self, q: &[f64], v: &[f64]) -> ([f64; 2], [f64; 2]) {
        match (self.ring, self.layout.ring) {
            (RingBody::Fixed(position), _) => (position, [0.0; 2]),
            (_, i) => {
                let i = i.unwrap_or(0);
                ([q[i], q[i + 1]], [v[i], v[i + 1]])
            }
        }
    }

    /// Fills the roller sites and the lists of touching contacts.
    fn locate(&self, q: &[f64], v: &[f64], ws: &mut Workspace) -> Result<(), Fault> {
        ws.rollers.clear();
        ws.outer.clear();
        ws.inner.clear();
        ws.wall.clear();
        ws.edge.clear();
        let (ring_position, ring_velocity) = self.ring_motion(q, v);
        let reach = LOST_BODY * self.geometry.pitch_radius;
        if ring_position[0].hypot(ring_position[1]) > reach {
            return Err(Fault::LostRing);
        }
        if self.layout.cage.is_some_and(|c| q[c].hypot(q[c + 1]) > reach) {
            return Err(Fault::LostCage);
        }
        for j in 0..self.layout.count {
            let i = self.layout.roller(j);
            let motion = RollerMotion {
                radial_offset: q[i],
                radial_speed: v[i],
                orbit_speed: v[i + 1],
                spin_speed: v[self.layout.spin(j)],
            };
            if motion.radial_offset.abs() > LOST_ROLLER * self.geometry.pitch_radius {
                return Err(Fault::LostRoller { roller: j, radial_offset: motion.radial_offset });
            }
            let (sin, cos) = (self.reference_angles[j] + q[i + 1]).sin_cos();
            let mut site = RollerSite { motion, sin, cos, pocket_offset: [0.0; 2] };

            if touching(motion.radial_offset - self.geometry.gap) {
                let (contact, frame) = self.geometry.outer(&motion);
                ws.outer.push(j, contact, frame, ());
            }
            let position = site.to_local(ring_position);
            if touching(self.geometry.inner_approach(motion.radial_offset, position)) {
                let velocity = site.to_local(ring_velocity);
                let ring = RingMotion { position, velocity, speed: ws.inputs.ring_speed };
                let (contact, frame) = self.geometry.inner(&motion, &ring);
                ws.inner.push(j, contact, frame, ());
            }
            if let (Some(cage), Some(c)) = (&self.cage, self.layout.cage)
                && let Some(pocket) = &cage.pocket
            {
                let lead = (q[i + 1] - q[c + 2]).sin_cos();
                let position = rotate(site.to_local([q[c], q[c + 1]]), lead.0, lead.1);
                site.pocket_offset = pocket.geometry.offset(motion.radial_offset, lead, position);
                if !pocket.geometry.apart(site.pocket_offset) {
                    let velocity = rotate(site.to_local([v[c], v[c + 1]]), lead.0, lead.1);
                    let cage_motion = CageMotion { position, velocity, speed: v[c + 2] };
                    let relative =
                        pocket.geometry.relative_motion(site.pocket_offset, &motion, lead, &cage_motion);
                    ws.push_pillars(j, pocket, &relative, lead);
                }
            }
            ws.rollers.push(site);
        }
        Ok(())
    }

    /// Evaluates every law over its list.
    fn apply_laws(&self, q: &[f64], v: &[f64], ws: &mut Workspace) -> Result<(), Fault> {
        ws.outer.force.extend(ws.outer.motion.iter().map(|m| self.outer.force(m, None)));
        ws.inner.force.extend(ws.inner.motion.iter().map(|m| self.inner.force(m, None)));
        let (Some(cage), Some(c)) = (&self.cage, self.layout.cage) else { return Ok(()) };
        if let Some(pocket) = &cage.pocket {
            let friction = |m: &ContactMotion<f64>, share: f64| {
                (share > 0.0).then(|| (share, pocket.edge_friction.at(m.u1.abs())))
            };
            let wall = &mut ws.wall;
            wall.force.extend(
                wall.motion
                    .iter()
                    .zip(&wall.site)
                    .map(|(m, site)| pocket.wall.force(m, friction(m, site.edge_share))),
            );
            let edge = &mut ws.edge;
            edge.force.extend(edge.motion.iter().map(|m| pocket.edge.force(m, friction(m, 1.0))));
        }
        if let Some(bearing) = &cage.guide {
            ws.journal = JournalMotion {
                position: [q[c], q[c + 1]],
                velocity: [v[c], v[c + 1]],
                journal_speed: v[c + 2],
                bush_speed: 0.0,
                profile_angle: q[c + 2],
                profile_speed: v[c + 2],
            };
            let film = bearing.force(&ws.journal);
            ws.guide = Some(film.map_err(|e| Fault::NoGuideFilm { minimum_film: e.minimum_film })?);
        }
        Ok(())
    }

    /// Collects forces on the bodies and divides by the inertias.
    fn assemble(&self, q: &[f64], v: &[f64], ws: &mut Workspace, a: &mut [f64]) {
        let (_, ring_velocity) = self.ring_motion(q, v);
        let mut on_ring = [0.0; 2];
        let mut on_cage = Wrench::default();
        ws.on_roller.fill(Wrench::default());
        for contact in ws.outer.iter() {
            let [on_roller, _] = contact.frame.wrenches(contact.force);
            add(&mut ws.on_roller[contact.roller], on_roller.force, on_roller.moment);
        }
        for contact in ws.inner.iter() {
            let [on_roller, reaction] = contact.frame.wrenches(contact.force);
            add(&mut ws.on_roller[contact.roller], on_roller.force, on_roller.moment);
            let reaction = ws.rollers[contact.roller].to_global(reaction.force);
            on_ring[0] += reaction[0];
            on_ring[1] += reaction[1];
        }
        for contact in ws.wall.iter().chain(ws.edge.iter()) {
            let (on_roller, reaction) = pocket_wrenches(&contact, &ws.rollers[contact.roller]);
            add(&mut ws.on_roller[contact.roller], on_roller.force, on_roller.moment);
            add(&mut on_cage, reaction.force, reaction.moment);
        }
        if let Some(i) = self.layout.ring
            && let RingBody::Free { mass, damping } = self.ring
        {
            for k in 0..2 {
                let force = on_ring[k] + ws.inputs.load[k] - damping * ring_velocity[k];
                a[i + k] = force / mass + self.gravity[k];
            }
        }
        if let (Some(cage), Some(c)) = (&self.cage, self.layout.cage) {
            if let Some(film) = &ws.guide {
                let [on_journal, _] = guide::wrenches(film, [q[c], q[c + 1]]);
                add(&mut on_cage, on_journal.force, on_journal.moment);
            }
            a[c] = on_cage.force[0] / cage.mass + self.gravity[0];
            a[c + 1] = on_cage.force[1] / cage.mass + self.gravity[1];
            a[c + 2] = on_cage.moment / cage.inertia;
        }
        for (j, (site, wrench)) in ws.rollers.iter().zip(&ws.on_roller).enumerate() {
            let i = self.layout.roller(j);
            let r = self.geometry.pitch_radius + site.motion.radial_offset;
            let weight = site.to_local(self.gravity);
            let (radial_speed, orbit) = (site.motion.radial_speed, site.motion.orbit_speed);
            a[i] = wrench.force[0] / self.roller_mass + weight[0] + r * orbit * orbit;
            a[i + 1] = (wrench.force[1] / self.roller_mass + weight[1] - 2.0 * radial_speed * orbit) / r;
            a[self.layout.spin(j)] = wrench.moment / self.roller_inertia;
        }
    }

    /// Damping of each roller at the last evaluated state over (radial speed, orbit speed, spin speed): contact
    /// damping, half of it implicit, and the secant slope of friction, all of it implicit.
    pub(crate) fn roller_damping(&self, ws: &Workspace, blocks: &mut [DampingBlock]) {
        blocks.fill(DampingBlock::default());
        let radius = self.geometry.roller_radius;
        let mut collect = |roller: usize, [nr, nc]: [f64; 2], force: &LineContactForce<f64>| {
            let n = Vector3::new(nr, nc, 0.0);
            let d = Vector3::new(-nc, nr, radius);
            let normal = n * n.transpose() * force.damping;
            let friction = d * d.transpose() * force.friction_secant;
            blocks[roller].full += normal + friction;
            blocks[roller].implicit += normal * 0.5 + friction;
        };
        for contact in ws.outer.iter().chain(ws.inner.iter()) {
            collect(contact.roller, contact.frame.normal, contact.force);
        }
        for contact in ws.wall.iter().chain(ws.edge.iter()) {
            let (sin, cos) = contact.site.lead;
            collect(contact.roller, rotate(contact.frame.normal, -sin, cos), contact.force);
        }
        // From force over speed in the local frame to acceleration over rate of the coordinates.
        for (block, site) in blocks.iter_mut().zip(&ws.rollers) {
            let r = self.geometry.pitch_radius + site.motion.radial_offset;
            let speed = Matrix3::from_diagonal(&Vector3::new(1.0, r, 1.0));
            let mass = self.roller_mass;
            let inertia = Vector3::new(mass, mass * r, self.roller_inertia);
            let inverse = Matrix3::from_diagonal(&inertia.map(|m| 1.0 / m));
            block.full = inverse * block.full * speed;
            block.implicit = inverse * block.implicit * speed;
        }
    }

    /// Damping of a free ring by its support, over (y, z).
    pub(crate) fn ring_damping(&self, h: f64) -> DampingBlock {
        let mut block = DampingBlock::default();
        if let RingBody::Free { mass, damping } = self.ring {
            let rate = damping / mass;
            block.full = Matrix3::from_diagonal(&Vector3::new(rate, rate, 0.0));
            block.implicit = block.full * implicit_share(h * rate);
        }
        block
    }

    /// Damping of the cage by its guide film at the last evaluated state, over (y, z, angle), exact by dual numbers.
    /// Zero without a film.
    pub(crate) fn cage_damping(&self, ws: &Workspace, h: f64) -> DampingBlock {
        let mut block = DampingBlock::default();
        let Some(cage) = &self.cage else { return block };
        let Some(bearing) = &cage.guide else { return block };
        let m = &ws.journal;
        let motion = JournalMotion {
            position: m.position.map(Dual::<3>::constant),
            velocity: [Dual::variable(m.velocity[0], 0), Dual::variable(m.velocity[1], 1)],
            journal_speed: Dual::variable(m.journal_speed, 2),
            bush_speed: Dual::constant(0.0),
            profile_angle: Dual::constant(m.profile_angle),
            profile_speed: Dual::variable(m.profile_speed, 2),
        };
        let Ok(film) = bearing.force(&motion) else { return block };
        let force = film.force();
        for k in 0..3 {
            block.full[(0, k)] = -force[0].eps[k] / cage.mass;
            block.full[(1, k)] = -force[1].eps[k] / cage.mass;
            block.full[(2, k)] = -film.moment.eps[k] / cage.inertia;
        }
        block.implicit = block.full * implicit_share(h * block.full.diagonal().amax());
        block
    }
}

impl Workspace {
    fn push_pillars(
        &mut self,
        roller: usize,
        pocket: &PocketLaws,
        relative: &PocketMotion<f64>,
        lead: (f64, f64),
    ) {
        for pillar in [Pillar::Front, Pillar::Back] {
            let Some(contact) = pocket.geometry.pillar(pillar, relative) else { continue };
            let PillarContact { motion, frame, edge_share } = contact;
            let lever = pocket.geometry.lever(relative.offset, frame.normal);
            let site = PocketSite { pillar, edge_share, lever, lead };
            let batch = if edge_share < 1.0 { &mut self.wall } else { &mut self.edge };
            batch.push(roller, motion, frame, site);
        }
    }
}

/// A NaN approach counts as contact, so that it reaches the accelerations and is reported.
fn touching(approach: f64) -> bool {
    approach > 0.0 || approach.is_nan()
}

fn add(sum: &mut Wrench<f64>, force: [f64; 2], moment: f64) {
    sum.force[0] += force[0];
    sum.force[1] += force[1];
    sum.moment += moment;
}

/// Wrench on the roller in its local frame and on the cage in the global frame.
pub(super) fn pocket_wrenches(
    contact: &Loaded<'_, PocketSite>,
    site: &RollerSite,
) -> (Wrench<f64>, Wrench<f64>) {
    let [on_roller, _] = contact.frame.wrenches(contact.force);
    let (sin, cos) = contact.site.lead;
    let force = rotate(on_roller.force, -sin, cos);
    let [along_r, along_c] = on_roller.force;
    let lever = contact.site.lever;
    let [y, z] = site.to_global(force);
    (
        Wrench { force, moment: on_roller.moment },
        Wrench { force: [-y, -z], moment: -(lever[0] * along_c - lever[1] * along_r) },
    )
}
