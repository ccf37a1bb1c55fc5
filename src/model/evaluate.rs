//! The force evaluation: from a state to the forces of every contact and the accelerations.
//!
//! Three passes: find the contacts that touch and write their motions into one contiguous list per law (`locate`); run
//! each law over its list; collect the forces on the bodies (`assemble`).

use super::batch::{CONTACT_LAWS, Mate, PocketSite, Site};
use super::laws::{self, Laws, PocketLaws, count_parts};
use super::workspace::{ElementSite, Workspace};
use super::{CageBody, ElementKind, Fault, Input, InputValues, Model, RingBody, RollerSet};
use crate::contact::guide::BodyMotion;
use crate::contact::{PairFrame, Wrench, rotate};
use crate::laws::contact_pair::ContactForce;
use crate::laws::guide::GuideLaw;
use crate::scalar::math;

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
        inputs: &InputValues,
        q: &[f64],
        v: &[f64],
        ws: &mut Workspace,
        a: &mut [f64],
    ) -> Result<(), Fault> {
        ws.inputs = *inputs;
        self.heat(ws)?;
        self.locate(q, v, ws)?;
        self.apply_laws(q, v, ws)?;
        self.assemble(q, v, ws, a);
        match a.iter().position(|x| !x.is_finite()) {
            None => Ok(()),
            Some(velocity) => Err(Fault::NotFinite { velocity, contact: self.contact_not_finite(ws) }),
        }
    }

    /// Finds the viscosity at the present temperature.
    fn heat(&self, ws: &mut Workspace) -> Result<(), Fault> {
        let temperature = ws.inputs.of(Input::Temperature);
        let Some(oil) = self.inputs.oil.as_ref().filter(|_| temperature != ws.temperature) else {
            return Ok(());
        };
        ws.counts[laws::VISCOSITY_TEMPERATURE] += u64::from(ws.counting);
        let ratio = oil.law.viscosity(temperature) / oil.built_at.1;
        if ratio.is_nan() {
            return Err(Fault::NoViscosity { temperature });
        }
        ws.thickening = math::ln(ratio);
        ws.temperature = temperature;
        let films = (ws.guide_law.as_mut(), self.laws.guide.as_ref());
        if let (Some(GuideLaw { film: Some(present), .. }), Some(GuideLaw { film: Some(film), .. })) = films {
            *present.viscosity_mut() = film.viscosity() * ratio;
        }
        Ok(())
    }

    /// The first contact whose force is not finite, as a place in [`Model::contact_names`].
    fn contact_not_finite(&self, ws: &Workspace) -> Option<usize> {
        let bad = |f: ContactForce<f64>| !(f.normal + f.friction + f.rolling_resistance).is_finite();
        let found = ws.contacts().find(|c| bad(c.force))?;
        let Site { element, mate, .. } = found.site;
        Some(element * self.contacts_per_element() + self.contact_place(mate))
    }

    /// Ring position and velocity, global frame.
    #[inline]
    pub(super) fn ring_motion(&self, q: &[f64], v: &[f64]) -> ([f64; 2], [f64; 2]) {
        match (self.ring, self.layout.ring) {
            (RingBody::Fixed(position), _) => (position, [0.0; 2]),
            (_, i) => {
                let i = i.unwrap_or(0);
                ([q[i], q[i + 1]], [v[i], v[i + 1]])
            }
        }
    }

    /// Evaluates every law over its list.
    fn apply_laws(&self, q: &[f64], v: &[f64], ws: &mut Workspace) -> Result<(), Fault> {
        if ws.differentiating {
            ws.raceways.differentiate(ws.thickening, ws.instructions);
        } else {
            ws.raceways.apply(ws.thickening, ws.instructions);
        }
        self.apply_to_pockets(ws);
        self.apply_guide(q, v, ws)?;
        if ws.counting {
            count(&self.laws, ws);
        }
        Ok(())
    }

    /// Evaluates contacts with pockets that have a batch of their own.
    pub(super) fn apply_to_pockets(&self, ws: &mut Workspace) {
        let Workspace { pockets, thickening, instructions, differentiating, .. } = ws;
        if let Some(PocketLaws::Plane(laws)) = &self.laws.pocket {
            for i in 0..pockets.len() {
                let force = laws.contact.force(&pockets.motion.map(|x| x[i]));
                pockets.force.set(i, &force);
            }
        } else if *differentiating {
            pockets.differentiate(*thickening, *instructions);
        } else {
            pockets.apply(*thickening, *instructions);
        }
    }

    /// Evaluates the guide.
    pub(super) fn apply_guide(&self, q: &[f64], v: &[f64], ws: &mut Workspace) -> Result<(), Fault> {
        if let Some(guide) = &ws.guide_law
            && let Some(cage) = &self.cage
        {
            let bodies = self.guide_bodies(q, v, &ws.inputs);
            let motion = cage.guide_side.journal_motion(&bodies[0], &bodies[1]);
            ws.journal = Some(motion);
            let force = guide.force(&motion);
            ws.guide = Some(force.map_err(|e| Fault::NoGuideFilm { minimum_film: e.minimum_film })?);
        }
        Ok(())
    }

    /// Motion of the cage and of the ring that guides it.
    #[inline]
    pub(super) fn guide_bodies(&self, q: &[f64], v: &[f64], inputs: &InputValues) -> [BodyMotion<f64>; 2] {
        let still = BodyMotion { position: [0.0; 2], velocity: [0.0; 2], angle: 0.0, speed: 0.0 };
        let cage = self.layout.cage.map_or(still, |c| BodyMotion {
            position: [q[c], q[c + 1]],
            velocity: [v[c], v[c + 1]],
            angle: q[c + 2],
            speed: v[c + 2],
        });
        if !self.cage.as_ref().is_some_and(|cage| cage.guided_by_inner_ring) {
            return [cage, still];
        }
        let (position, velocity) = self.ring_motion(q, v);
        [cage, BodyMotion { position, velocity, angle: 0.0, speed: inputs.of(Input::RingSpeed) }]
    }

    /// Collects forces on the bodies and divides by the inertias.
    pub(super) fn assemble(&self, q: &[f64], v: &[f64], ws: &mut Workspace, a: &mut [f64]) {
        let mut on_ring = [0.0; 2];
        let mut on_cage = Wrench::default();
        ws.on_roller.fill(Wrench::default());
        for (&Site { element, frame, mate }, force) in ws.raceways.forces().chain(ws.pockets.forces()) {
            let site = &ws.elements[element];
            let on_element = match mate {
                Mate::Outer => frame.wrenches(&force)[0],
                Mate::Inner => {
                    let [on_roller, reaction] = frame.wrenches(&force);
                    let reaction = site.to_global(reaction.force);
                    on_ring[0] += reaction[0];
                    on_ring[1] += reaction[1];
                    on_roller
                }
                Mate::Pocket(pocket) => {
                    let (on_element, reaction) = pocket_wrenches(&frame, &force, &pocket, site);
                    add(&mut on_cage, reaction.force, reaction.moment);
                    on_element
                }
            };
            if let Some(on_roller) = ws.on_roller.get_mut(element) {
                add(on_roller, on_element.force, on_element.moment);
            }
        }
        if let (Some(cage), Some(c)) = (&self.cage, self.layout.cage) {
            if let (Some(force), Some(motion)) = (&ws.guide, &ws.journal) {
                let [guided, ring] = cage.guide_side.wrenches(force, motion);
                add(&mut on_cage, guided.force, guided.moment);
                if cage.guided_by_inner_ring {
                    on_ring[0] += ring.force[0];
                    on_ring[1] += ring.force[1];
                }
            }
            if cage.loaded {
                let inputs = &ws.inputs;
                let force = [inputs.of(Input::CageForceY), inputs.of(Input::CageForceZ)];
                add(&mut on_cage, force, inputs.of(Input::CageTorque));
            }
            self.accelerate_cage(cage, &on_cage, q[c + 2], v[c + 2], &mut a[c..c + 3]);
            ws.on_cage = on_cage;
        }
        if let Some(i) = self.layout.ring
            && let RingBody::Free { mass, damping } = self.ring
        {
            let (_, ring_velocity) = self.ring_motion(q, v);
            let load = [ws.inputs.of(Input::LoadY), ws.inputs.of(Input::LoadZ)];
            for k in 0..2 {
                let force = on_ring[k] + load[k] - damping * ring_velocity[k];
                a[i + k] = force / mass + self.gravity[k];
            }
        }
        if let ElementKind::Rollers(rollers) = &self.elements.kind {
            self.accelerate_rollers(rollers, ws, a);
        }
    }

    /// Accelerations of the cage from the forces on it without gravity, moment about the geometric centre.
    fn accelerate_cage(&self, cage: &CageBody, on_cage: &Wrench<f64>, angle: f64, speed: f64, a: &mut [f64]) {
        let offset = cage.mass_offset(angle);
        a.copy_from_slice(&cage.response(on_cage, offset));
        a[0] += self.gravity[0];
        a[1] += self.gravity[1];
        if let Some([uy, uz]) = offset {
            a[0] += speed * speed * uy;
            a[1] += speed * speed * uz;
        }
    }

    fn accelerate_rollers(&self, rollers: &RollerSet, ws: &Workspace, a: &mut [f64]) {
        for (j, (site, wrench)) in ws.elements.iter().zip(&ws.on_roller).enumerate() {
            let i = self.layout.roller(j);
            let r = rollers.geometry.pitch_radius + site.motion.radial_offset;
            let weight = site.to_local(self.gravity);
            let (radial_speed, orbit) = (site.motion.radial_speed, site.motion.orbit_speed);
            a[i] = wrench.force[0] / rollers.mass + weight[0] + r * orbit * orbit;
            a[i + 1] = (wrench.force[1] / rollers.mass + weight[1] - 2.0 * radial_speed * orbit) / r;
            a[self.layout.spin(j)] = wrench.moment / rollers.inertia;
        }
    }
}

impl CageBody {
    /// Centre of mass relative to the geometric centre at the cage angle `angle` (rad), global axes, m; `None` for a
    /// balanced cage.
    pub(super) fn mass_offset(&self, angle: f64) -> Option<[f64; 2]> {
        let (sin, cos) = self.mass_eccentricity.map(|_| math::sin_cos(angle))?;
        self.mass_eccentricity.map(|u| rotate(u, sin, cos))
    }

    /// Accelerations (y, z, angle) of the cage by these forces, moment about the geometric centre, with its centre of mass
    /// at `offset` (m) from there.
    pub(super) fn response(&self, on_cage: &Wrench<f64>, offset: Option<[f64; 2]>) -> [f64; 3] {
        let [fy, fz] = on_cage.force;
        let [y, z] = [fy / self.mass, fz / self.mass];
        match offset {
            None => [y, z, on_cage.moment / self.inertia],
            Some([uy, uz]) => {
                // About the centre of mass, whose acceleration the forces give; the centre of the cage turns about it.
                let turning = (on_cage.moment - (uy * fz - uz * fy)) / self.inertia;
                [y + turning * uz, z - turning * uy, turning]
            }
        }
    }
}

/// Counts the evaluations of this pass; laws that the scene does not use cost nothing here.
fn count(laws: &Laws, ws: &mut Workspace) {
    let n: [u64; CONTACT_LAWS] = std::array::from_fn(|law| ws.raceways.counts[law] + ws.pockets.counts[law]);
    let counts = &mut ws.counts;
    for (count, n) in counts.iter_mut().zip(n) {
        *count += n;
    }
    if let Some(raceways) = &laws.raceways {
        count_parts(counts, &raceways.outer, n[laws::OUTER_RACEWAY]);
        count_parts(counts, &raceways.inner, n[laws::INNER_RACEWAY]);
    }
    if let Some(PocketLaws::Cylinder(pocket)) = &laws.pocket {
        count_parts(counts, &pocket.wall, n[laws::POCKET_WALL]);
    }
    if let (Some(GuideLaw { film, .. }), Some(force)) = (&laws.guide, &ws.guide) {
        counts[laws::GUIDE_FILM] += u64::from(film.is_some() && force.film_share > 0.0);
        counts[laws::GUIDE_SOLID] += u64::from(force.solid != [0.0; 2]);
    }
}

#[inline]
pub(super) fn add(sum: &mut Wrench<f64>, force: [f64; 2], moment: f64) {
    sum.force[0] += force[0];
    sum.force[1] += force[1];
    sum.moment += moment;
}

/// Wrench on the element in its local frame and on the cage in the global frame.
#[inline]
pub(super) fn pocket_wrenches(
    frame: &PairFrame<f64>,
    force: &ContactForce<f64>,
    pocket: &PocketSite,
    site: &ElementSite,
) -> (Wrench<f64>, Wrench<f64>) {
    let [on_element, _] = frame.wrenches(force);
    let (sin, cos) = site.lead;
    let force = rotate(on_element.force, -sin, cos);
    let [along_r, along_c] = on_element.force;
    let lever = pocket.lever;
    let [y, z] = site.to_global(force);
    (
        Wrench { force, moment: on_element.moment },
        Wrench { force: [-y, -z], moment: -(lever[0] * along_c - lever[1] * along_r) },
    )
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Sim;
    use crate::model::HostInputs;
    use pulp::Arch;
    use std::sync::Arc;

    /// Accelerations at a state with these instructions.
    fn accelerations(sim: &Sim, instructions: Arch) -> Vec<u64> {
        let model = sim.model();
        let (q, v) = sim.state().split_at(model.layout().positions());
        let mut ws = Workspace::new(model);
        ws.instructions = instructions;
        let mut a = vec![0.0; v.len()];
        let inputs = model.inputs_at(sim.time(), &HostInputs::default());
        model.accelerations(&inputs, q, v, &mut ws, &mut a).unwrap();
        a.into_iter().map(f64::to_bits).collect()
    }

    #[test]
    fn all_instructions_give_the_same_bits() {
        for scene in ["nu2310", "nu2310_grease", "grease_guide"] {
            let path = format!("{}/scenes/{scene}.json", env!("CARGO_MANIFEST_DIR"));
            let model = Model::from_json(&std::fs::read_to_string(path).unwrap()).unwrap();
            let mut sim = Sim::new(Arc::new(model)).unwrap();
            for step in 1..=20 {
                sim.advance_to(0.5e-3 * f64::from(step)).unwrap();
                let portable = accelerations(&sim, Arch::Scalar);
                assert_eq!(portable, accelerations(&sim, Arch::new()), "{scene}");
                #[cfg(target_arch = "x86_64")]
                if let Some(v3) = pulp::x86::V3::try_new() {
                    assert_eq!(portable, accelerations(&sim, Arch::V3(v3)), "{scene}");
                }
            }
        }
    }
}
