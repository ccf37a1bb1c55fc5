//! How forces oppose velocities at the last evaluated state: what semi-implicit methods take at the end of a step.

use super::workspace::Workspace;
use super::{CageBody, ElementKind, Model, RingBody};
use crate::contact::guide::BodyMotion;
use crate::contact::rotate;
use crate::integrate::{DampingBlock, implicit_share};
use crate::scalar::{Dual, Real};
use nalgebra::{Matrix3, Vector3};

impl Model {
    /// Damping of each roller at the last evaluated state over (radial speed, orbit speed, spin speed): contact
    /// damping, half of it implicit, and the secant slope of friction, all of it implicit.
    pub(crate) fn roller_damping(&self, ws: &Workspace, blocks: &mut [DampingBlock]) {
        let ElementKind::Rollers(rollers) = &self.elements.kind else { return };
        blocks.fill(DampingBlock::default());
        let radius = rollers.geometry.roller_radius;
        // Upper triangles: contact damping in `full`, friction in `implicit`.
        let mut collect = |roller: usize, [nr, nc]: [f64; 2], [damping, secant]: [f64; 2]| {
            let DampingBlock { full, implicit } = &mut blocks[roller];
            full[(0, 0)] += damping * nr * nr;
            full[(0, 1)] += damping * nr * nc;
            full[(1, 1)] += damping * nc * nc;
            let d = [-nc, nr, radius];
            for i in 0..3 {
                for k in i..3 {
                    implicit[(i, k)] += secant * d[i] * d[k];
                }
            }
        };
        for (element, frame, (), rates) in ws.outer.damping().chain(ws.inner.damping()) {
            collect(element, frame.normal, rates);
        }
        for batch in [&ws.wall, &ws.edge, &ws.plane] {
            for (element, frame, _, rates) in batch.damping() {
                let (sin, cos) = ws.elements[element].lead;
                collect(element, rotate(frame.normal, -sin, cos), rates);
            }
        }
        // From force over speed in the local frame to acceleration over rate of the coordinates.
        for (block, site) in blocks.iter_mut().zip(&ws.elements) {
            let r = rollers.geometry.pitch_radius + site.motion.radial_offset;
            let speed = [1.0, r, 1.0];
            let inverse = [1.0 / rollers.mass, 1.0 / (rollers.mass * r), 1.0 / rollers.inertia];
            for i in 0..3 {
                for k in i..3 {
                    let (normal, friction) = (block.full[(i, k)], block.implicit[(i, k)]);
                    let (full, implicit) = (normal + friction, 0.5 * normal + friction);
                    let (here, mirrored) = (inverse[i] * speed[k], inverse[k] * speed[i]);
                    block.full[(i, k)] = full * here;
                    block.full[(k, i)] = full * mirrored;
                    block.implicit[(i, k)] = implicit * here;
                    block.implicit[(k, i)] = implicit * mirrored;
                }
            }
        }
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
        if let ElementKind::Kinematic(_) = self.elements.kind {
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
    let contacts = ws.wall.damping().chain(ws.edge.damping()).chain(ws.plane.damping());
    for (element, frame, pocket, [damping, secant]) in contacts {
        let site = &ws.elements[element];
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

impl CageBody {
    /// Rows of (force, moment about the geometric centre) as rows of accelerations, at the cage angle `angle` (rad).
    pub(super) fn accelerations_of(&self, rows: &Matrix3<f64>, angle: f64) -> Matrix3<f64> {
        let (fy, fz, moment) = (rows.row(0), rows.row(1), rows.row(2));
        let [uy, uz] = self.mass_offset(angle).unwrap_or_default();
        let turning = (moment - (fz * uy - fy * uz)) / self.inertia;
        Matrix3::from_rows(&[fy / self.mass + turning * uz, fz / self.mass - turning * uy, turning])
    }
}
