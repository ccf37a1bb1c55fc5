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
use super::RollersOfScene;
use super::contacts::{Contact, FRICTION, NORMAL, Node, ROLLING, add_scaled, on_mate};
use crate::bodies::{CAGE, OF_ROLLER, ORBIT, RollerState, SPIN};
use crate::integrate::{GroupDamping, SemiImplicit, implicit_share};
use crate::pairs::roller::UnitWrench;
use crate::scalar::place_of;
use crate::space::solid::{Moving, Vector, added, difference, dot, numbers, scaled, sum};

type Matrix = [[f64; OF_ROLLER]; OF_ROLLER];

/// Power of a unit wrench at this velocity and angular velocity.
#[inline]
fn speed(wrench: &UnitWrench<f64>, moved: &[f64; 6]) -> f64 {
    let [[a, b, c], [d, e, f]] = wrench;
    a * moved[0] + b * moved[1] + c * moved[2] + d * moved[3] + e * moved[4] + f * moved[5]
}

/// Adds c w w^T to its lower triangle.
#[inline]
fn add_square(sum: &mut Matrix, c: f64, wrench: &UnitWrench<f64>) {
    let w = wrench.as_flattened();
    for i in 0..OF_ROLLER {
        let scaled = c * w[i];
        for k in 0..=i {
            sum[i][k] += scaled * w[k];
        }
    }
}

/// Damping over velocity and angular velocity, given by lower triangles, over the speeds of a roller: of all forces, of which those of friction alone
/// turn it about its own axis.
fn over_speeds(state: &RollerState<f64>, all: &Matrix, friction: &Matrix) -> Matrix {
    let axis = state.axis;
    let around = difference([1.0, 0.0, 0.0], scaled(axis, axis[0]));
    let [skew, tilt] = [[1.0, 0.0], [0.0, 1.0]].map(|rates| {
        let turning = state.turning(rates);
        difference(turning, scaled(axis, dot(turning, axis)))
    });
    // Angular velocity by psi', sigma', tau' and w_1, at these places among the speeds.
    let turned = [(ORBIT, around, all), (3, skew, all), (4, tilt, all), (SPIN, axis, friction)];
    let mut out = [[0.0; OF_ROLLER]; OF_ROLLER];
    let mut add = |i: usize, k: usize, x: f64| {
        out[i][k] += x;
        if i != k {
            out[k][i] += x;
        }
    };
    let r = state.r;
    add(0, 0, all[0][0]);
    add(0, 1, all[1][0]);
    add(1, 1, all[1][1]);
    add(0, ORBIT, all[2][0] * r);
    add(1, ORBIT, all[2][1] * r);
    add(ORBIT, ORBIT, all[2][2] * r * r);
    for (n, (place, w, of)) in turned.iter().enumerate() {
        let with_force = |k: usize| of[3][k] * w[0] + of[4][k] * w[1] + of[5][k] * w[2];
        let [x, rho, psi] = [with_force(0), with_force(1), with_force(2) * r];
        add(0, *place, x);
        add(1, *place, rho);
        add(ORBIT, *place, if *place == ORBIT { 2.0 * psi } else { psi });
        let by = [
            of[3][3] * w[0] + of[4][3] * w[1] + of[5][3] * w[2],
            of[4][3] * w[0] + of[4][4] * w[1] + of[5][4] * w[2],
            of[5][3] * w[0] + of[5][4] * w[1] + of[5][5] * w[2],
        ];
        for (other, v, _) in &turned[..=n] {
            add(*other, *place, dot(by, *v));
        }
    }
    out
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
        // Over velocity and angular velocity: of normal forces, which turn nothing about its own axis, and of friction.
        type Sums = [Matrix; 2];
        for (j, of) in memory.rollers.iter().enumerate() {
            let [mut full, mut implicit]: [Sums; 2] = [[[[0.0; OF_ROLLER]; OF_ROLLER]; 2]; 2];
            for contact in memory.contacts.iter().filter(|contact| contact.roller == j) {
                let nodes = memory.places(contact);
                let [of_normal, of_friction] = rollers.shares(contact, nodes, self.set.radius, h);
                let mut by = [[[0.0; OF_ROLLER]; OF_ROLLER]; 2];
                for Node { force, spot, .. } in nodes {
                    add_square(&mut by[0], force.damping, &spot.normal);
                    add_square(&mut by[1], force.secant, &spot.along);
                    add_square(&mut by[1], force.secant, &spot.across);
                }
                for (part, share) in [of_normal, of_friction].into_iter().enumerate() {
                    for i in 0..OF_ROLLER {
                        for k in 0..=i {
                            full[part][i][k] += by[part][i][k];
                            implicit[part][i][k] += share * by[part][i][k];
                        }
                    }
                }
            }
            let [full, implicit] = [full, implicit].map(|[mut all, friction]| {
                for (all, friction) in all.iter_mut().zip(&friction) {
                    all.iter_mut().zip(friction).for_each(|(sum, x)| *sum += x);
                }
                over_speeds(&of.state, &all, &friction)
            });
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
            let [pressed, rubbed] = [pressed, rubbed].map(|change| {
                let Moving { velocity, turning } = of.state.moved(change);
                numbers([velocity, turning])
            });
            for Node { force, spot, .. } in nodes {
                let pushed = -(force.damping * speed(&spot.normal, &pressed));
                let along = -(force.secant * speed(&spot.along, &rubbed));
                let across = -(force.secant * speed(&spot.across, &rubbed));
                add_scaled(&mut change[0], &spot.normal, pushed);
                add_scaled(&mut change[1], &spot.along, along);
                add_scaled(&mut change[1], &spot.across, across);
                contact.normal += force.normal + pushed;
                let nearer = -passing.power(spot.normal);
                contact.powers[NORMAL] -= (force.normal + pushed - force.elastic) * nearer;
            }
            contact.powers[FRICTION] = passing.power(added(contact.parts[FRICTION], change[1]));
            contact.powers[ROLLING] = passing.power(contact.parts[ROLLING]);
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
