//! How contacts oppose the velocities of rollers, and their forces and powers in a semi-implicit step.
//!
//! ```text
//! D = M^-1 Sum c n n^T + (F_T/|dv|) (t t^T + b b^T)      over the speeds of a roller, with the unit wrenches of every place over these
//! ```
//!
//! Every place of a contact has the implicit share of the whole contact, which is that of the plane.

use super::super::Space;
use super::super::cage::add_to_modes;
use super::super::workspace::Workspace;
use super::contacts::{Contact, FRICTION, NORMAL, Node, ROLLING};
use super::{RollersOfScene, added, on_mate};
use crate::bodies::{CAGE, OF_ROLLER};
use crate::integrate::{GroupDamping, SemiImplicit, implicit_share};
use crate::scalar::place_of;
use crate::space::solid::{Moving, Vector, dot, scaled, sum};

type Matrix = [[f64; OF_ROLLER]; OF_ROLLER];

fn dot_rows(a: &[f64; OF_ROLLER], b: &[f64; OF_ROLLER]) -> f64 {
    a.iter().zip(b).map(|(x, y)| x * y).sum()
}

/// Adds c x x^T.
fn add_square(sum: &mut Matrix, c: f64, row: &[f64; OF_ROLLER]) {
    for (sums, x) in sum.iter_mut().zip(row) {
        for (sum, y) in sums.iter_mut().zip(row) {
            *sum += c * x * y;
        }
    }
}

impl RollersOfScene {
    /// Shares of damping and friction of a contact that act on the change of a roller in a step of size `h`, s.
    fn shares(&self, contact: &Contact, nodes: &[Node], radius: f64, h: f64) -> [f64; 2] {
        let [mass, polar, _] = self.body.inertia(contact.roller);
        let [mut damping, mut secant] = [0.0; 2];
        for node in nodes {
            damping += node.force.damping;
            secant += node.force.secant;
        }
        [damping / mass, secant * (1.0 / mass + radius * radius / polar)].map(|rate| implicit_share(rate * h))
    }
}

impl Space {
    /// Damping of rollers for a step of size `h` (s).
    pub(in super::super) fn damp_rollers(&self, h: f64, ws: &Workspace, out: &mut GroupDamping<OF_ROLLER>) {
        let Some(rollers) = &self.rollers else { return };
        let memory = &ws.rollers;
        for (j, of) in memory.rollers.iter().enumerate() {
            let [mut full, mut implicit]: [Matrix; 2] = [[[0.0; OF_ROLLER]; OF_ROLLER]; 2];
            for contact in memory.contacts.iter().filter(|contact| contact.roller == j) {
                let nodes = memory.places(contact);
                let [of_normal, of_friction] = rollers.shares(contact, nodes, self.set.radius, h);
                for node in nodes {
                    let (force, [n, t, b, _]) = (&node.force, &node.rows);
                    add_square(&mut full, force.damping, n);
                    add_square(&mut implicit, force.damping * of_normal, n);
                    for row in [t, b] {
                        add_square(&mut full, force.secant, row);
                        add_square(&mut implicit, force.secant * of_friction, row);
                    }
                }
            }
            let (block, lane) = place_of(j);
            let inertia = rollers.body.inertia(j);
            let spokes = &mut out.spokes[block];
            for column in 0..OF_ROLLER {
                // Both are symmetric.
                let [full, implicit] = [&full, &implicit].map(|m| of.state.accelerated(inertia, m[column]));
                for row in 0..OF_ROLLER {
                    spokes.full[row][column][lane] = full[row];
                    spokes.implicit[row][column][lane] = implicit[row];
                }
            }
        }
    }

    /// Forces and powers of the contacts of rollers in a step from the last evaluated state, whose velocities are `v`, or at that state.
    pub(in super::super) fn find_rollers_step(
        &self,
        v: &[f64],
        step: Option<&SemiImplicit<'_>>,
        ws: &mut Workspace,
    ) {
        let Some(rollers) = &self.rollers else { return };
        let memory = &mut ws.rollers;
        for contact in &mut memory.contacts {
            let nodes = &memory.nodes[contact.first..contact.last];
            let of = &memory.rollers[contact.roller];
            let mut changes = [[0.0; OF_ROLLER]; 3];
            if let Some(step) = step {
                let places = self.layout.of_element::<OF_ROLLER>(contact.roller);
                let shares = rollers.shares(contact, nodes, self.set.radius, step.h);
                for (change, share) in changes.iter_mut().zip([0.5, shares[0], shares[1]]) {
                    for (change, place) in change.iter_mut().zip(places) {
                        *change = (step.mean[place] - v[place]) * (2.0 - 2.0 * share)
                            + (step.end[place] - v[place]) * (2.0 * share - 1.0);
                    }
                }
            }
            let [mean, pressed, rubbed] = changes;
            let by_mean = of.state.moved(mean);
            let passing = Moving {
                velocity: sum(contact.passing.velocity, by_mean.velocity),
                turning: sum(contact.passing.turning, by_mean.turning),
            };
            let mut change = [[[0.0; 3]; 2]; 2];
            (contact.normal, contact.powers) = (0.0, [0.0; 3]);
            for node in nodes {
                let (force, spot, [n, t, b, _]) = (&node.force, &node.spot, &node.rows);
                let pushed = -(force.damping * dot_rows(n, &pressed));
                let along = -(force.secant * dot_rows(t, &rubbed));
                let across = -(force.secant * dot_rows(b, &rubbed));
                let add = |part: &mut [Vector<f64>; 2], wrench: &[Vector<f64>; 2], factor: f64| {
                    *part = added(*part, wrench.map(|v| scaled(v, factor)));
                };
                add(&mut change[0], &spot.normal, pushed);
                add(&mut change[1], &spot.along, along);
                add(&mut change[1], &spot.across, across);
                contact.normal += force.normal + pushed;
                let nearer = -(dot(spot.normal[0], passing.velocity) + dot(spot.normal[1], passing.turning));
                contact.powers[NORMAL] -= (force.normal + pushed - force.elastic) * nearer;
            }
            let power = |[force, moment]: [Vector<f64>; 2]| {
                dot(force, passing.velocity) + dot(moment, passing.turning)
            };
            contact.powers[FRICTION] = power(added(contact.parts[FRICTION], change[1]));
            contact.powers[ROLLING] = power(contact.parts[ROLLING]);
            let changed = added(change[0], change[1]);
            contact.on_bending = contact.over_bending(changed[0]);
            contact.reaction = on_mate(changed, contact.from_mate, of.direction);
        }
    }

    /// What the forces of rollers on a mate have become in that step, or at that state.
    pub(in super::super) fn reaction_of_rollers(&self, ws: &Workspace, mate: usize) -> [Vector<f64>; 2] {
        let of_mate = ws.rollers.contacts.iter().filter(|contact| contact.place.mate() == mate);
        of_mate.fold([[0.0; 3]; 2], |sum, contact| added(sum, contact.reaction))
    }

    /// Adds what the forces of rollers on the cage have changed by in that step.
    pub(in super::super) fn add_reaction_to_cage(
        &self,
        ws: &Workspace,
        on_cage: &mut [Vector<f64>; 2],
        on_modes: &mut [f64],
    ) {
        let Some(cage) = &self.cage else { return };
        for contact in ws.rollers.contacts.iter().filter(|contact| contact.place.mate() == CAGE) {
            *on_cage = added(*on_cage, contact.reaction);
            add_to_modes(on_modes, cage.body.displacements(contact.roller), contact.on_bending);
        }
    }

    /// Adds the powers of the contacts of rollers, W.
    pub(in super::super) fn add_roller_powers(&self, ws: &Workspace, p: &mut [f64]) {
        for contact in &ws.rollers.contacts {
            for (power, part) in contact.powers.iter().zip(contact.place.powers()) {
                p[part as usize] += power;
            }
        }
    }
}
