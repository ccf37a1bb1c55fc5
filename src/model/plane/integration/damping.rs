//! How forces oppose velocities at the last evaluated state: what semi-implicit methods take of the change of a step.
//!
//! Of an element that of its contacts (`pairs/contacts/damping`), of a shared body that of the guide, exact by dual numbers, and
//! of its contacts with elements of prescribed motion.

use crate::bodies::{CAGE, CAGE_MOTION, Damping, SHARED, UPPER};
use crate::model::plane::Plane;
use crate::model::plane::workspace::Workspace;
use crate::scalar::ZEROS;
use nalgebra::{DMatrix, Matrix3, Vector3};

impl Plane {
    /// Damping of every group for a step of size `h` (s), after an evaluation with [`Workspace::set_splitting`].
    pub(crate) fn damping(&self, h: f64, ws: &mut Workspace, out: &mut Damping) {
        self.element_damping(h, ws, out);
        let ws = &*ws;
        let mut slopes = [Matrix3::zeros(); SHARED];
        for (force, info) in ws.between.iter().zip(&self.between_infos) {
            debug_assert!(force.damping.is_some(), "found with the forces");
            for (body, slope) in info.bodies.into_iter().zip(force.damping.into_iter().flatten()) {
                slopes[body] += slope;
            }
        }
        let factor = self.exchange_factor();
        for ((place, body, at), block) in self.free_bodies().zip(&mut out.bodies) {
            let mut slope = slopes[place];
            if self.elements.mass().is_none() {
                slope += contact_damping(place, ws);
            }
            let (full, q) = (&mut block.full, &ws.of_shared[0][at]);
            let n = full.nrows();
            full.fill(0.0);
            for (column, own) in full.as_mut_slice().chunks_exact_mut(n).zip(&slope.data.0) {
                column.iter_mut().zip(own).for_each(|(x, slope)| *x = *slope);
            }
            if place == CAGE && n > CAGE_MOTION {
                self.add_damping_of_modes(ws, full);
            }
            body.add_damping(&mut |[i, k], damping| full[(i, k)] += damping);
            full.as_mut_slice().chunks_exact_mut(n).for_each(|column| body.respond(column, q));
            block.split(h, factor);
        }
        self.node_damping(h, ws, out);
    }

    /// That of the cage by what its modes add: by the pairs of shared bodies, and by contacts with elements of prescribed motion.
    fn add_damping_of_modes(&self, ws: &Workspace, full: &mut DMatrix<f64>) {
        for damping in ws.between.iter().filter_map(|force| force.damping_of_modes()) {
            *full += damping;
        }
        let Some(cage) = self.shared[CAGE].as_ref().filter(|_| self.elements.mass().is_none()) else {
            return;
        };
        for contact in ws.contacts.iter().filter(|contact| contact.site.mate == CAGE) {
            let j = contact.site.element;
            let (frame, pocket) = (ws.motions.frame(j), ws.motions.pocket_frame(j));
            let rows = contact.grip.rows_on_mate(&frame);
            for (row, rate) in rows.into_iter().zip([contact.force.damping, contact.force.friction_secant]) {
                let [x, t] = pocket.to_local([row[0], row[1]]);
                let lever = |k: usize| match k.checked_sub(CAGE_MOTION) {
                    None => row[k],
                    Some(k) => cage.displacements(j).get(k).map_or(0.0, |b| x * b[0] + t * b[1]),
                };
                for k in CAGE_MOTION..full.ncols() {
                    for i in 0..k {
                        let entry = lever(i) * lever(k) * rate;
                        full[(i, k)] += entry;
                        full[(k, i)] += entry;
                    }
                    full[(k, k)] += lever(k) * lever(k) * rate;
                }
            }
        }
    }

    /// That of each element over (radial speed, orbit speed, spin speed).
    fn element_damping(&self, h: f64, ws: &mut Workspace, out: &mut Damping) {
        if self.elements.mass().is_none() {
            return;
        }
        // Upper triangles.
        for block in &mut out.spokes {
            for (i, k) in UPPER {
                (block.full[i][k], block.implicit[i][k]) = (ZEROS, ZEROS);
            }
        }
        for batch in &mut ws.contacts.batches {
            batch.add_damping(h, self.mobility, ws.motions.instructions, out);
        }
        self.elements.accelerations_of(&ws.motions, out);
    }

    /// Factor of the share of damping to take at the end of a step. Where both bodies of a pair move, each takes the other's
    /// predicted velocity, and only twice the share keeps the exchange stable.
    fn exchange_factor(&self) -> f64 {
        let moves = |body: &usize| self.layout.shared(*body).is_some();
        let both_move = self.between_infos.iter().any(|info| info.bodies.iter().all(moves));
        if both_move { 2.0 } else { 1.0 }
    }
}

/// -d(force, moment)/d(velocity, speed) of a shared body by the contacts with elements of prescribed motion, N s/m and its kin.
fn contact_damping(body: usize, ws: &Workspace) -> Matrix3<f64> {
    let mut slope = Matrix3::zeros();
    for contact in ws.contacts.iter().filter(|contact| contact.site.mate == body) {
        let rows = contact.grip.rows_on_mate(&ws.motions.frame(contact.site.element));
        for (row, rate) in rows.into_iter().zip([contact.force.damping, contact.force.friction_secant]) {
            let g = Vector3::from(row);
            slope += g * g.transpose() * rate;
        }
    }
    slope
}
