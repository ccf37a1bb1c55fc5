//! Energy of a bearing and the power that goes into it and out of it.
//!
//! ```text
//! d/dt (kinetic + elastic + potential energy) = sum of the powers
//! kinetic    m v^2/2 of ring, cage (at its centre of mass) and rollers, I w^2/2 of cage and rollers
//! elastic    line contacts U = (9/19) delta Q_el(delta), plane pockets U = k delta^2/2
//! contacts   -(Q - Q_el) delta_dot,  F_T (u1 - u2),  F_EHLr (u1 + u2)
//! ```
//!
//! The sum is zero at any state, to round-off, with the accelerations of that state. What it adds up to over a run is the
//! error of the integration. Rings whose rotation is prescribed have no kinetic energy of their own: what turns them is
//! the power that the bearing takes from the shaft.

use super::batch::{Batch, Mate, Site};
use super::evaluate::pocket_wrenches;
use super::laws::PocketLaws;
use super::step_forces::Changes;
use super::workspace::Workspace;
use super::{ElementKind, Input, Model, RingBody};
use crate::contact::Wrench;
use crate::contact::guide::BodyMotion;
use crate::integrate::{Quadratures, SemiImplicit, WORKS};
use crate::laws::guide::GuideForce;

/// Names of the powers, W. Those of loads and of prescribed motions are positive where they drive the bearing; those of
/// forces inside are negative where they take energy. The solid contact of the guide gives back what its spring took.
pub const POWERS: [&str; 11] = [
    "loads",
    "ring_drive",
    "element_drive",
    "ring_support",
    "raceway_damping",
    "raceway_friction",
    "rolling_resistance",
    "pocket_damping",
    "pocket_friction",
    "guide_film",
    "guide_solid",
];

const LOADS: usize = 0;
const RING_DRIVE: usize = 1;
const ELEMENT_DRIVE: usize = 2;
const RING_SUPPORT: usize = 3;
const RACEWAY_DAMPING: usize = 4;
const RACEWAY_FRICTION: usize = 5;
const ROLLING_RESISTANCE: usize = 6;
const POCKET_DAMPING: usize = 7;
const POCKET_FRICTION: usize = 8;
const GUIDE_FILM: usize = 9;
const GUIDE_SOLID: usize = 10;
/// Behind the powers: 1 while a law between rollers and raceways is at a floor, else 0.
pub(crate) const AT_FLOOR: usize = POWERS.len();
const _: () = assert!(POWERS.len() == WORKS);

/// Energy of a state, J.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Energy {
    /// Kinetic energy.
    pub kinetic: f64,
    /// Energy of contacts that are pressed together.
    pub elastic: f64,
    /// Potential energy of the weight; zero with all bodies at the centre.
    pub potential: f64,
}

impl Energy {
    /// All of it, J.
    pub fn total(&self) -> f64 {
        self.kinetic + self.elastic + self.potential
    }
}

impl Model {
    /// Powers at the last evaluated state (`q`, `v`) of `ws`, W, in the order of [`POWERS`], and whether a law is at a floor
    /// (1 or 0). With a semi-implicit step those of its forces, which differ from the evaluated ones.
    pub fn powers(
        &self,
        q: &[f64],
        v: &[f64],
        step: Option<&SemiImplicit<'_>>,
        ws: &Workspace,
    ) -> Quadratures {
        let mut p = Quadratures::default();
        let (_, ring_velocity) = self.ring_motion(q, v);
        let ring_speed = ws.inputs.of(Input::RingSpeed);
        // Moment on the inner ring, which its drive holds up.
        let mut on_ring = 0.0;
        for batch in [&ws.raceways, &ws.pockets] {
            for (i, site) in batch.sites.iter().enumerate() {
                let c = self.contact_power(
                    batch,
                    i,
                    step.map(|step| {
                        self.step_changes(site, batch.force.friction_secant[i], v, step, &ws.elements)
                    }),
                );
                match site.mate {
                    Mate::Pocket(_) => {
                        p[POCKET_DAMPING] += c.damping;
                        p[POCKET_FRICTION] += c.friction;
                    }
                    Mate::Outer | Mate::Inner => {
                        p[RACEWAY_DAMPING] += c.damping;
                        p[RACEWAY_FRICTION] += c.friction;
                        p[ROLLING_RESISTANCE] += c.rolling;
                        if self.is_at_floor(batch, i, ws.thickening) {
                            p[AT_FLOOR] = 1.0;
                        }
                    }
                }
                if let Mate::Inner = site.mate {
                    on_ring -= site.frame.arm_2 * c.on_mate;
                }
            }
        }
        if let (Some(cage), Some(c)) = (&self.cage, self.layout.cage) {
            if let (Some(force), Some(motion)) = (&ws.guide, &ws.journal) {
                let bodies = self.guide_bodies(q, v, &ws.inputs);
                let power_and_moment = |force: &GuideForce<f64>| {
                    let [on_cage, ring] = cage.guide_side.wrenches(force, motion);
                    (power(&on_cage, &bodies[0]) + power(&ring, &bodies[1]), ring.moment)
                };
                let (all, film) = (power_and_moment(force), power_and_moment(&force.of_film()));
                p[GUIDE_FILM] = film.0;
                p[GUIDE_SOLID] = all.0 - film.0;
                on_ring += if cage.guided_by_inner_ring { all.1 } else { 0.0 };
            }
            if cage.loaded {
                let load = [Input::CageForceY, Input::CageForceZ, Input::CageTorque];
                p[LOADS] += load.iter().zip(&v[c..]).map(|(input, v)| ws.inputs.of(*input) * v).sum::<f64>();
            }
        }
        if let RingBody::Free { damping, .. } = self.ring {
            let [y, z] = ring_velocity;
            p[LOADS] += ws.inputs.of(Input::LoadY) * y + ws.inputs.of(Input::LoadZ) * z;
            p[RING_SUPPORT] = -damping * (y * y + z * z);
        }
        p[RING_DRIVE] = -on_ring * ring_speed;
        if let ElementKind::Kinematic = self.elements.kind {
            p[ELEMENT_DRIVE] = -self.power_on_elements(ws);
        }
        p
    }

    /// Power of pocket forces on elements whose motion is prescribed, W.
    fn power_on_elements(&self, ws: &Workspace) -> f64 {
        let on_element = |(&Site { element, frame, mate }, force): (&Site, _)| {
            let (Mate::Pocket(pocket), site) = (mate, &ws.elements[element]) else { return 0.0 };
            let (wrench, _) = pocket_wrenches(&frame, &force, &pocket, site);
            wrench.force[1] * self.elements.pitch_radius * site.motion.orbit_speed
                + wrench.moment * site.motion.spin_speed
        };
        ws.pockets.forces().map(on_element).sum()
    }

    /// Power of contact `i`, whose speeds and forces a semi-implicit step has changed.
    fn contact_power(&self, batch: &Batch, i: usize, changes: Option<Changes>) -> ContactPower {
        let (f, m) = (&batch.force, &batch.motion);
        let Changes { approach_speed, slip, acting_slip } = changes.unwrap_or_default();
        let approach_speed = m.delta_dot[i] + approach_speed;
        let friction = f.friction[i] - f.friction_secant[i] * acting_slip;
        let damping = if f.normal[i] == 0.0 && m.delta[i] > 0.0 {
            // Damping has cut off the force, and the spring loses what it held.
            self.spring(&batch.sites[i].mate, m.delta[i])[0] * approach_speed
        } else {
            -f.damping[i] * approach_speed * approach_speed
        };
        ContactPower {
            damping,
            friction: friction * (m.u1[i] - m.u2[i] + slip),
            rolling: f.rolling_resistance[i] * (m.u1[i] + m.u2[i]),
            on_mate: f.rolling_resistance[i] - friction,
        }
    }

    /// Whether a law of contact `i` with a raceway is at a floor.
    fn is_at_floor(&self, batch: &Batch, i: usize, thickening: f64) -> bool {
        let Some(laws) = &self.laws.raceways else { return false };
        let law = if let Mate::Outer = batch.sites[i].mate { &laws.outer } else { &laws.inner };
        law.is_at_floor(&batch.motion.map(|x| x[i]), thickening, &batch.force.map(|x| x[i]))
    }

    /// Elastic force of a contact in N and its energy in J at the approach `delta` (m).
    fn spring(&self, mate: &Mate, delta: f64) -> [f64; 2] {
        let line = match (mate, &self.laws.raceways, &self.laws.pocket) {
            (Mate::Outer, Some(laws), _) => &laws.outer,
            (Mate::Inner, Some(laws), _) => &laws.inner,
            (Mate::Pocket(_), _, Some(PocketLaws::Cylinder(laws))) => &laws.wall,
            (Mate::Pocket(_), _, Some(PocketLaws::Plane(laws))) => {
                let force = laws.contact.stiffness * delta;
                return [force, 0.5 * force * delta];
            }
            _ => return [0.0; 2],
        };
        let force = line.elastic.load(delta);
        [force, 9.0 / 19.0 * force * delta]
    }

    /// Energy of the last evaluated state (`q`, `v`) of `ws`.
    pub fn energy(&self, q: &[f64], v: &[f64], ws: &Workspace) -> Energy {
        let mut e = Energy::default();
        let weight = |mass: f64, [y, z]: [f64; 2]| -mass * (self.gravity[0] * y + self.gravity[1] * z);
        if let RingBody::Free { mass, .. } = self.ring {
            let (position, [y, z]) = self.ring_motion(q, v);
            e.kinetic += 0.5 * mass * (y * y + z * z);
            e.potential += weight(mass, position);
        }
        if let (Some(cage), Some(c)) = (&self.cage, self.layout.cage) {
            let [uy, uz] = cage.mass_offset(q[c + 2]).unwrap_or_default();
            let speed = v[c + 2];
            let (y, z) = (v[c] - speed * uz, v[c + 1] + speed * uy);
            e.kinetic += 0.5 * (cage.mass * (y * y + z * z) + cage.inertia * speed * speed);
            e.potential += weight(cage.mass, [q[c] + uy, q[c + 1] + uz]);
        }
        if let ElementKind::Rollers(rollers) = &self.elements.kind {
            for site in &ws.elements {
                let (m, r) = (&site.motion, rollers.geometry.pitch_radius + site.motion.radial_offset);
                let across = r * m.orbit_speed;
                e.kinetic += 0.5
                    * (rollers.mass * (m.radial_speed * m.radial_speed + across * across)
                        + rollers.inertia * m.spin_speed * m.spin_speed);
                e.potential += weight(rollers.mass, site.to_global([r, 0.0]));
            }
        }
        e.elastic = ws.contacts().map(|c| self.spring(&c.site.mate, c.motion.delta)[1]).sum();
        e
    }
}

/// Power of one contact, W, and force on the surface of its mate, N.
struct ContactPower {
    damping: f64,
    friction: f64,
    rolling: f64,
    on_mate: f64,
}

fn power(wrench: &Wrench<f64>, body: &BodyMotion<f64>) -> f64 {
    wrench.force[0] * body.velocity[0] + wrench.force[1] * body.velocity[1] + wrench.moment * body.speed
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Sim;
    use crate::model::HostInputs;
    use std::sync::Arc;

    /// Runs a scene and compares the powers with the change of the energy along the motion.
    fn check(file: &str, sets: &[(&str, &str)]) {
        let path = format!("{}/scenes/{file}.json", env!("CARGO_MANIFEST_DIR"));
        let text = std::fs::read_to_string(path).unwrap();
        let scene = crate::Scene::from_json_with(&text, sets.iter().copied()).unwrap();
        let mut sim = Sim::new(Arc::new(Model::new(scene).unwrap())).unwrap();
        let nq = sim.model().layout().positions();
        let model = sim.model().clone();
        let mut ws = Workspace::new(&model);
        let mut a = vec![0.0; model.layout().velocities()];
        let mut evaluate = |state: &[f64], t: f64| {
            let (q, v) = state.split_at(nq);
            let inputs = model.inputs_at(t, &HostInputs::default());
            model.accelerations(&inputs, q, v, &mut ws, &mut a).unwrap();
            (model.powers(q, v, None, &ws), model.energy(q, v, &ws))
        };
        for step in 1..=40 {
            sim.advance_to(0.25e-3 * f64::from(step)).unwrap();
            let (t, state) = (sim.time(), sim.state().to_vec());
            let mut rate = vec![0.0; state.len()];
            sim.derivative(t, &state, &mut rate).unwrap();
            let dt = 1e-9;
            let moved = |s: f64| -> Vec<f64> { state.iter().zip(&rate).map(|(x, r)| x + s * r).collect() };
            let (powers, _) = evaluate(&state, t);
            let (after, before) = (evaluate(&moved(dt), t + dt).1, evaluate(&moved(-dt), t - dt).1);
            let change = (after.total() - before.total()) / (2.0 * dt);
            let sum: f64 = powers.iter().sum();
            let size = powers.iter().fold(0.0, |size, p| size + p.abs());
            assert!(
                (sum - change).abs() < 1e-5 * size + 1e-6,
                "{file} at {t}: {sum} {change} of {powers:?}, {before:?} {after:?}"
            );
        }
    }

    #[test]
    fn powers_are_the_change_of_energy() {
        check("nu2310", &[]);
        check("nu2310_grease", &[]);
        check("grease_guide", &[]);
        check("ball_short_bearing", &[]);
        check("nu2310", &[("raceways.contact.damping", "null"), ("cage.guide", "null")]);
        check("grease_guide", &[("cage.mass_eccentricity", r#"{"y": 2e-5, "z": 1e-5}"#)]);
        check(
            "nu2310",
            &[(
                "inner_ring.motion.free.load.z",
                r#"{"sine": {"mean": -3000, "amplitude": 2000, "frequency": 400, "phase": 0}}"#,
            )],
        );
    }

    #[test]
    fn forces_inside_take_energy() {
        let path = format!("{}/scenes/nu2310.json", env!("CARGO_MANIFEST_DIR"));
        let mut sim =
            Sim::new(Arc::new(Model::from_json(&std::fs::read_to_string(path).unwrap()).unwrap())).unwrap();
        sim.advance_to(20e-3).unwrap();
        let balance = sim.power_balance().unwrap();
        for (name, work) in POWERS.iter().zip(balance.work).skip(RING_SUPPORT) {
            assert!(work <= 0.0, "{name}: {work}");
        }
        assert!(balance.work[RING_DRIVE] > 1.0, "{balance:?}");
        assert!(balance.throughput() >= balance.work[RING_DRIVE]);
    }
}
