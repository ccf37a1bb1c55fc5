//! Energy of a bearing and the power that goes into it and out of it.
//!
//! ```text
//! d/dt (kinetic + elastic + potential energy) = sum of the powers
//! kinetic    m v^2/2 of ring, cage (at its centre of mass) and rollers, I w^2/2 of cage and rollers
//! elastic    line contacts U = (9/19) delta Q_el(delta), plane pockets U = k delta^2/2, modes of the cage K (A^2 + B^2)/2
//! contacts   -(Q - Q_el) delta_dot,  F_T (u1 - u2),  F_EHLr (u1 + u2)
//! ```
//!
//! The sum is zero at any state, to round-off, with the accelerations of that state. What it adds up to over a run is the
//! error of the integration. Rings whose rotation is prescribed have no kinetic energy of their own: what turns them is
//! the power that the bearing takes from the shaft.

use super::Plane;
use super::workspace::Workspace;
use crate::bodies::{CAGE, INNER_RING, OUTER_RING, Power, SharedBody};
use crate::integrate::SemiImplicit;
use crate::model::Condition;
use crate::model::Energy;
use crate::pairs::{Batch, ContactBlock, Loaded, Site};
use crate::scalar::WIDEST;
use crate::space::Wrench;

/// The rings, and the powers of what turns them.
const RINGS: [usize; 2] = [OUTER_RING, INNER_RING];
const DRIVES: [Power; 2] = [Power::OuterRingDrive, Power::RingDrive];

impl Plane {
    /// Powers at the last evaluated state of `ws`, whose velocities are `v`, W, in the order of [`POWERS`], and last whether a law
    /// is at a floor (1 or 0). With a semi-implicit step those of its forces, which differ from the evaluated ones.
    ///
    /// # Panics
    /// When `p` is shorter than that.
    #[doc(hidden)]
    pub fn powers(&self, v: &[f64], step: Option<&SemiImplicit<'_>>, ws: &mut Workspace, p: &mut [f64]) {
        p.fill(0.0);
        self.find_step(v, step, ws);
        let ws = &*ws;
        // Moments on outer and inner ring, which their drives hold up.
        let mut on_rings = [0.0; RINGS.len()];
        let mut at_floor = false;
        let driven = |body: usize| RINGS.iter().position(|ring| *ring == body && self.is_driven(body));
        for (batch, info, contacts) in ws.contacts.by_pair(&self.infos) {
            let ([of_damping, of_friction], share) = (info.powers, info.share);
            let [mut by_damping, mut by_friction] = [of_damping, of_friction].map(|power| p[power as usize]);
            let (mut by_rolling, mut moment) = (p[Power::RollingResistance as usize], 0.0);
            let mut without_resistance = false;
            for (ContactBlock { force, step, .. }, here) in batch.pieces(contacts.clone()) {
                let [damping, friction, rolling] = &step.powers;
                for lane in here.map(|lane| lane % WIDEST) {
                    by_damping += share * damping[lane];
                    by_friction += share * friction[lane];
                    moment += step.moment_on_mate[lane];
                    by_rolling += rolling[lane];
                    // A resistance is at its floor where there is none.
                    without_resistance |= force.rolling_resistance[lane] == 0.0;
                }
            }
            p[of_damping as usize] = by_damping;
            p[of_friction as usize] = by_friction;
            if info.rolls {
                p[Power::RollingResistance as usize] = by_rolling;
                at_floor |= without_resistance
                    && contacts.into_iter().any(|i| self.is_at_floor(batch, i, ws.fluid.ln_viscosity));
            }
            if let Some(ring) = driven(info.mate) {
                on_rings[ring] += moment;
            }
        }
        p[Condition::AtFloor.place()] = f64::from(u8::from(at_floor));
        for (place, (info, force)) in self.between_infos.iter().zip(&ws.between).enumerate() {
            let [film, rest] = self.power_between(place, ws);
            p[info.powers[0] as usize] += film;
            if self.between[place].stored(&ws.motions).is_none() {
                p[info.powers[1] as usize] += rest;
            }
            for (body, on_body) in info.bodies.iter().zip(&force.on) {
                if let Some(ring) = driven(*body) {
                    on_rings[ring] += on_body.moment;
                }
            }
        }
        for (place, body) in self.shared.iter().enumerate() {
            if let Some(body) = body {
                body.add_powers(&ws.body(place, self.layout.range(place)), &ws.inputs, p);
            }
        }
        for ((ring, moment), power) in RINGS.into_iter().zip(on_rings).zip(DRIVES) {
            if let Some(speed) = self.turned_by(ring) {
                p[power as usize] = -moment * ws.inputs.of(speed);
            }
        }
        for place in &self.moved {
            let [[fy, fz], [vy, vz]] = [self.on_moved(*place, ws), ws.motions.shared[*place].velocity];
            p[DRIVES[*place] as usize] -= fy * vy + fz * vz;
        }
        if self.elements.mass().is_none() {
            p[Power::ElementDrive as usize] = -self.power_on_elements(ws);
        }
    }

    /// Force of all contacts in the step that was found last on a ring whose place is prescribed, N.
    fn on_moved(&self, place: usize, ws: &Workspace) -> [f64; 2] {
        let mut sum = Wrench::default();
        for (batch, _, contacts) in ws.contacts.by_pair(&self.infos).filter(|(_, info, _)| info.mate == place)
        {
            for i in contacts {
                let (ContactBlock { on_mates, step, .. }, lane) = batch.at(i);
                let force = [0, 1].map(|k| on_mates[k][lane] + step.reaction[k][lane]);
                sum.add(&Wrench { force, moment: 0.0 });
            }
        }
        for (info, force) in self.between_infos.iter().zip(&ws.between) {
            let on = info.bodies.iter().zip(&force.on).filter(|(body, _)| **body == place);
            on.for_each(|(_, on_body)| sum.add(on_body));
        }
        sum.force
    }

    /// Power of the film and of the solid contact of a pair of shared bodies, W.
    pub(in crate::model::plane) fn power_between(&self, place: usize, ws: &Workspace) -> [f64; 2] {
        let (pair, force, motions) = (&self.between[place], &ws.between[place], &ws.motions);
        let [a, b] = self.between_infos[place].bodies.map(|body| &motions.shared[body]);
        let power = |[on_a, on_b]: [Wrench<f64>; 2]| on_a.power(a) + on_b.power(b);
        let (mut all, mut film) = (power(force.on), power(pair.of_film(motions, force)));
        let [_, rates] = &motions.modes;
        if let Some([on_modes, by_film]) = force.of_modes() {
            let power = |on: &[f64]| on.iter().zip(rates).map(|(force, rate)| force * rate).sum::<f64>();
            (all, film) = (all + power(on_modes), film + power(by_film));
        }
        [film, all - film]
    }

    /// Energy of the deformed cage at the last evaluated state, J.
    pub(in crate::model::plane) fn elastic_energy_of_cage(&self, ws: &Workspace) -> f64 {
        let energy =
            |body: &dyn SharedBody| body.energy(&ws.body(CAGE, self.layout.range(CAGE)), self.gravity);
        self.shared[CAGE].as_ref().map_or(0.0, |cage| energy(&**cage).elastic)
    }

    /// Power of contact forces on elements whose motion is prescribed, W.
    fn power_on_elements(&self, ws: &Workspace) -> f64 {
        let on_element = |(site, [radial, across, moment]): (&Site, [f64; 3])| {
            ws.motions.element(site.element).power(&Wrench { force: [radial, across], moment })
        };
        ws.contacts.on_elements().map(on_element).sum()
    }

    /// Whether a law of contact `i` is at a floor.
    fn is_at_floor(&self, batch: &Batch, i: usize, ln_viscosity: f64) -> bool {
        let (block, lane) = batch.at(i);
        if block.force.rolling_resistance[lane] != 0.0 {
            return false;
        }
        let contact = batch.loaded(i);
        self.laws[contact.site.pair].is_at_floor(&contact.motion, ln_viscosity, &contact.force)
    }

    /// Energy of the last evaluated state of `ws`.
    #[doc(hidden)]
    pub fn energy(&self, ws: &Workspace) -> Energy {
        let (mut e, mut elastic) = (Energy::default(), 0.0);
        let of_shared = self.shared.iter().enumerate().filter_map(|(place, body)| {
            Some(body.as_ref()?.energy(&ws.body(place, self.layout.range(place)), self.gravity))
        });
        let free = (0..self.layout.count).map(|j| ws.motions.element(j));
        let of_elements = free.map(|element| self.elements.energy(&element, self.gravity));
        for energy in of_shared.chain(of_elements) {
            e.kinetic += energy.kinetic;
            elastic += energy.elastic;
            e.potential += energy.potential;
        }
        let spring =
            |c: Loaded<'_>| self.infos[c.site.pair].share * self.laws[c.site.pair].spring(c.motion.delta)[1];
        elastic += self.between.iter().filter_map(|pair| pair.stored(&ws.motions)).sum::<f64>();
        e.elastic = ws.contacts.iter().map(spring).sum::<f64>() + elastic;
        e
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Sim;
    use crate::bodies::POWERS;
    use crate::model::RATES;
    use crate::model::{HostInputs, Model};
    use std::sync::Arc;

    /// Runs a scene and compares the powers with the change of the energy along the motion.
    fn check(file: &str, sets: &[(&str, &str)]) {
        let path = format!("{}/scenes/{file}.json", env!("CARGO_MANIFEST_DIR"));
        let text = std::fs::read_to_string(path).unwrap();
        let scene = crate::Scene::from_json_with(&text, sets.iter().copied()).unwrap();
        let mut sim = Sim::new(Arc::new(Model::new(scene).unwrap())).unwrap();
        let nq = sim.model().layout().positions();
        let model = sim.model().clone();
        let mut ws = Workspace::new(model.plane().unwrap());
        let mut a = vec![0.0; model.layout().velocities()];
        let mut evaluate = |state: &[f64], t: f64| {
            let (q, v) = state.split_at(nq);
            let inputs = model.inputs_at(t, &HostInputs::default());
            model.plane().unwrap().accelerations(&inputs, q, v, &mut ws, &mut a).unwrap();
            let mut powers = [0.0; RATES];
            model.plane().unwrap().powers(v, None, &mut ws, &mut powers);
            (powers, model.plane().unwrap().energy(&ws))
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
            let powers = &powers[..POWERS.len()];
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
    fn powers_of_moving_rings_are_the_change_of_energy() {
        let swing = |frequency: u32| {
            format!(
                r#"{{"sine": {{"mean": 2e-6, "amplitude": 6e-6, "frequency": {frequency}, "phase": 0.3}}}}"#
            )
        };
        let prescribed = format!(r#"{{"prescribed": {{"y": {}, "z": {}}}}}"#, swing(130), swing(90));
        let support = r#"{"stiffness": {"yy": 3e7, "yz": 4e6, "zy": -2e6, "zz": 6e7},
            "damping": {"yy": 300, "yz": -20, "zy": 50, "zz": 900}, "mass": {"yy": 0.4, "yz": 0.2, "zy": 0.2, "zz": 1.1}}"#;
        let unbalance = r#"{"moment": 2e-4, "phase": 0.8}"#;
        let free = format!(
            r#"{{"free": {{"mass": 2.5, "support": {support}, "unbalance": {unbalance}, "load": {{"y": 40, "z": -300}}}}}}"#
        );
        let speed = r#"{"ramp": {"from": -250, "to": -330, "start": 0, "end": 0.01}}"#;
        for [outer, inner] in
            [[&free, &free], [&prescribed, &free], [&free, &prescribed], [&prescribed, &prescribed]]
        {
            let speed = [("inner_ring.speed", speed), ("outer_ring.speed", "40")];
            let motion = [("outer_ring.motion", outer.as_str()), ("inner_ring.motion", inner.as_str())];
            check("nu2310", &[speed, motion].concat());
        }
        check("nu2310_elastic", &[("outer_ring.motion", free.as_str())]);
        let waves = r#"[{"order": 13, "amplitude": 1e-6, "phase": -0.2}]"#;
        let table = r#"{"angles": [0, 1, 1.1, 1.2], "heights": [0, 0, -4e-6, 0]}"#;
        let rollers = format!(r#"[{{"rollers": [0, 3, 4, 8], "harmonics": {waves}, "table": {table}}}]"#);
        let waves = [
            ("inner_ring.waviness", waves),
            ("outer_ring.waviness_table", table),
            ("rollers.waviness", rollers.as_str()),
            ("outer_ring.speed", "40"),
        ];
        check("nu2310", &waves);
        let crown = ("rollers.profile", r#"{"circular_crown": {"radius": 2.0}}"#);
        check("nu2310", &[&waves[..2], &[crown]].concat());
        check("nu2310", &[&waves[..], &[("outer_ring.motion", free.as_str())]].concat());
        check("grease_guide", &[("inner_ring.motion", prescribed.as_str())]);
    }

    #[test]
    fn forces_inside_take_energy() {
        let path = format!("{}/scenes/nu2310.json", env!("CARGO_MANIFEST_DIR"));
        let mut sim =
            Sim::new(Arc::new(Model::from_json(&std::fs::read_to_string(path).unwrap()).unwrap())).unwrap();
        sim.advance_to(20e-3).unwrap();
        let balance = sim.power_balance().unwrap();
        for (name, work) in POWERS.iter().zip(balance.work).skip(Power::RingSupport as usize) {
            assert!(work <= 0.0, "{name}: {work}");
        }
        assert!(balance.work[Power::RingDrive as usize] > 1.0, "{balance:?}");
        assert!(balance.throughput() >= balance.work[Power::RingDrive as usize]);
    }
}
