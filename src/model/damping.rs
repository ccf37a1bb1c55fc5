//! How forces oppose velocities at the last evaluated state: what semi-implicit methods take of the change of a step.

use super::batch::Mate;
use super::workspace::Workspace;
use super::{CageBody, ElementKind, Model, RingBody, RollerSet};
use crate::contact::guide::BodyMotion;
use crate::contact::rotate;
use crate::integrate::{DampingBlock, GroupDamping, implicit_share};
use crate::scalar::{Columns, Dual, Pack, Real, dispatch};
use nalgebra::{Matrix3, Vector3};
use pulp::Simd;

impl Model {
    /// Damping of each roller at the last evaluated state over (radial speed, orbit speed, spin speed): contact
    /// damping, half of it implicit, and the secant slope of friction, for a step of size `h` (s).
    pub(crate) fn roller_damping(&self, h: f64, ws: &Workspace, out: &mut GroupDamping) {
        let ElementKind::Rollers(rollers) = &self.elements.kind else { return };
        let radius = rollers.geometry.roller_radius;
        for (i, k) in UPPER {
            out.full[i][k].fill(0.0);
            out.implicit[i][k].fill(0.0);
        }
        // Upper triangles.
        let GroupDamping { full, implicit, .. } = out;
        let mut collect = |roller: usize, [nr, nc]: [f64; 2], [damping, secant]: [f64; 2]| {
            let (n, t, share) = ([nr, nc, 0.0], [-nc, nr, radius], rollers.friction_share(h, secant));
            for (i, k) in UPPER {
                let (normal, friction) = (damping * n[i] * n[k], secant * t[i] * t[k]);
                full[i][k][roller] += normal + friction;
                implicit[i][k][roller] += 0.5 * normal + share * friction;
            }
        };
        for (site, rates) in ws.raceways.damping().chain(ws.pockets.damping()) {
            collect(site.element, ws.elements[site.element].normal(site), rates);
        }
        let radial_offset = &ws.places.radial_offset;
        dispatch(ws.instructions, Divide { rollers, rows: self.layout.count, radial_offset, damping: out });
    }

    /// Damping of a free ring, over (y, z): its support, and the guide of a cage around it.
    pub(crate) fn ring_damping(&self, cage: &DampingBlock, h: f64) -> DampingBlock {
        let mut block = DampingBlock::default();
        let RingBody::Free { mass, damping } = self.ring else { return block };
        let rate = damping / mass;
        block.full = Matrix3::from_diagonal(&Vector3::new(rate, rate, 0.0));
        if let Some(body) = self.cage.as_ref().filter(|cage| cage.guided_by_inner_ring) {
            let shared = cage.full.fixed_view::<2, 2>(0, 0) * (body.mass / mass);
            let mut corner = block.full.fixed_view_mut::<2, 2>(0, 0);
            corner += shared;
        }
        block.implicit = block.full * self.guide_share(h * block.full.diagonal().amax());
        block
    }

    /// Damping of the cage at the last evaluated state, over (y, z, angle): the guide, exact by dual numbers, and the
    /// pockets of kinematic elements.
    pub(crate) fn cage_damping(&self, q: &[f64], v: &[f64], ws: &Workspace, h: f64) -> DampingBlock {
        let mut block = DampingBlock::default();
        let Some(cage) = &self.cage else { return block };
        let mut slope = self.guide_slope(cage, q, v, ws);
        if let ElementKind::Kinematic = self.elements.kind {
            slope += pocket_slope(ws);
        }
        let angle = self.layout.cage.map_or(0.0, |c| q[c + 2]);
        block.full = cage.accelerations_of(&slope, angle);
        block.implicit = block.full * self.guide_share(h * block.full.diagonal().amax());
        block
    }

    /// Share of a guide's damping to take at the end of a step. Where both bodies move, each takes the other's
    /// predicted velocity, and only twice the share keeps the exchange stable.
    fn guide_share(&self, z: f64) -> f64 {
        let both_move =
            self.cage.as_ref().is_some_and(|c| c.guided_by_inner_ring) && self.layout.ring.is_some();
        implicit_share(z) * if both_move { 2.0 } else { 1.0 }
    }

    /// -d(force, moment on the cage)/d(velocity, speed of the cage) of the guide, N s/m and its kin.
    fn guide_slope(&self, cage: &CageBody, q: &[f64], v: &[f64], ws: &Workspace) -> Matrix3<f64> {
        let Some(law) = &ws.guide_law else { return Matrix3::zeros() };
        let [body, ring] = self.guide_bodies(q, v, &ws.inputs);
        let constant = |x: [f64; 2]| x.map(Dual::<3>::constant);
        let moving = BodyMotion {
            position: constant(body.position),
            velocity: [Dual::variable(body.velocity[0], 0), Dual::variable(body.velocity[1], 1)],
            angle: Dual::constant(body.angle),
            speed: Dual::variable(body.speed, 2),
        };
        let ring = BodyMotion {
            position: constant(ring.position),
            velocity: constant(ring.velocity),
            angle: Dual::constant(ring.angle),
            speed: Dual::constant(ring.speed),
        };
        let motion = cage.guide_side.journal_motion(&moving, &ring);
        let Ok(force) = law.force(&motion) else { return Matrix3::zeros() };
        let [on_cage, _] = cage.guide_side.wrenches(&force, &motion);
        let rows = [on_cage.force[0], on_cage.force[1], on_cage.moment];
        Matrix3::from_fn(|i, k| -rows[i].eps[k])
    }
}

/// The same of the pockets, from contact damping and the secant slope of friction.
fn pocket_slope(ws: &Workspace) -> Matrix3<f64> {
    let mut slope = Matrix3::zeros();
    for (contact, [damping, secant]) in ws.pockets.damping() {
        let (Mate::Pocket(pocket), frame) = (&contact.mate, &contact.frame) else { continue };
        let site = &ws.elements[contact.element];
        let (sin, cos) = site.lead;
        let lever = pocket.lever;
        for (direction, rate) in [(frame.normal, damping), (frame.tangent(), secant)] {
            let [y, z] = site.to_global(rotate(direction, -sin, cos));
            let g = Vector3::new(y, z, lever[0] * direction[1] - lever[1] * direction[0]);
            slope += g * g.transpose() * rate;
        }
    }
    slope
}

/// Places of the upper triangle of a matrix.
const UPPER: [(usize, usize); 6] = [(0, 0), (0, 1), (0, 2), (1, 1), (1, 2), (2, 2)];

/// From force over speed in the local frame to acceleration over rate of the coordinates.
struct Divide<'a> {
    rollers: &'a RollerSet,
    rows: usize,
    radial_offset: &'a [f64],
    damping: &'a mut GroupDamping,
}

impl Columns for Divide<'_> {
    const PAIRED: bool = false;

    fn rows(&self) -> usize {
        self.rows
    }

    #[inline(always)]
    #[expect(clippy::needless_range_loop, reason = "iterators might not be inlined")]
    fn group<S: Simd, const K: usize>(&mut self, simd: S, first: usize) {
        let Self { rollers, radial_offset, damping, .. } = self;
        let all = |x: f64| Pack::<S, K>::all(simd, x);
        let r = Pack::load(simd, &radial_offset[first..]) + rollers.geometry.pitch_radius;
        let speed = [all(1.0), r, all(1.0)];
        let inverse = [all(1.0 / rollers.mass), all(1.0 / rollers.mass) / r, all(1.0 / rollers.inertia)];
        for at in 0..UPPER.len() {
            let (i, k) = UPPER[at];
            let full = Pack::load(simd, &damping.full[i][k][first..]);
            let implicit = Pack::load(simd, &damping.implicit[i][k][first..]);
            let (here, mirrored) = (inverse[i] * speed[k], inverse[k] * speed[i]);
            (full * here).store(&mut damping.full[i][k][first..]);
            (full * mirrored).store(&mut damping.full[k][i][first..]);
            (implicit * here).store(&mut damping.implicit[i][k][first..]);
            (implicit * mirrored).store(&mut damping.implicit[k][i][first..]);
        }
    }
}

impl RollerSet {
    /// Share of the change of slip in a step of size `h` (s) at which friction of slope `secant` (N s/m) acts.
    #[inline]
    pub(super) fn friction_share(&self, h: f64, secant: f64) -> f64 {
        let radius = self.geometry.roller_radius;
        implicit_share(h * secant * (1.0 / self.mass + radius * radius / self.inertia))
    }
}

impl CageBody {
    /// Rows of (force, moment about the geometric centre) as rows of accelerations, at the cage angle `angle` (rad).
    pub(super) fn accelerations_of(&self, rows: &Matrix3<f64>, angle: f64) -> Matrix3<f64> {
        let (fy, fz, moment) = (rows.row(0), rows.row(1), rows.row(2));
        let [uy, uz] = self.mass_offset(angle).unwrap_or_default();
        let turning = (moment - (fz * uy - fy * uz)) / self.inertia;
        Matrix3::from_rows(&[fy / self.mass + turning * uz, fz / self.mass - turning * uy, turning])
    }
}
