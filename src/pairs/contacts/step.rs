//! Forces and powers of all contacts in a semi-implicit step, which differ from those of its evaluation.
//!
//! ```text
//! Q   = Q(v*) + c (delta_dot - delta_dot*)      mean over the step
//! F_T = F_T(v*) - s (u1 - u2 - (u1* - u2*))     at a share of its change, from the mean to the end
//! ```
//!
//! v* velocities of the evaluation, c normal damping, s secant slope of friction; by the motion of the elements.

use super::wrenches::store_on_mates;
use super::{Batch, ContactBlock, contact_force};
use crate::bodies::{OF_ELEMENT, WrenchLanes};
use crate::integrate::implicit_share;
use crate::laws::contact_pair::ContactForce;
use crate::pairs::ContactLaw;
use crate::scalar::{Base, Columns, Lanes, Numeric, Pack, WIDEST, ZEROS, dispatch, place_of};
use pulp::{Arch, Simd};

/// Powers of a contact: of its damping, of its friction, of its rolling resistance.
const POWERS_OF_CONTACT: usize = 3;

/// Changes of the speeds of a block of elements in their local frames, m/s and rad/s: mean over the step, and to its end.
pub(crate) type SpeedChanges = [[Lanes; OF_ELEMENT]; 2];

/// Forces and powers of a block of contacts in the step from the last evaluated state, or at it.
#[derive(Clone, Debug)]
pub(crate) struct StepForces {
    /// Of the elements.
    changes: SpeedChanges,
    /// Normal force and friction, N.
    pub(crate) normal: Lanes,
    pub(crate) friction: Lanes,
    /// W.
    pub(crate) powers: [Lanes; POWERS_OF_CONTACT],
    /// What the step has added to the wrenches on the mates, in global axes.
    pub(crate) reaction: WrenchLanes,
    /// Moment on the mates, N m.
    pub(crate) moment_on_mate: Lanes,
}

impl StepForces {
    pub(super) const ZERO: Self = Self {
        changes: [[ZEROS; OF_ELEMENT]; 2],
        normal: ZEROS,
        friction: ZEROS,
        powers: [ZEROS; POWERS_OF_CONTACT],
        reaction: [ZEROS; OF_ELEMENT],
        moment_on_mate: ZEROS,
    };
}

impl Batch {
    /// Finds the forces and powers in a step of size `h` (s) in which the speeds of the elements, of this `mobility`
    /// (m/(N s^2)), change like this. Without a step those of the state. `laws` are those of the pairs.
    pub(crate) fn find_step(
        &mut self,
        step: Option<(&[SpeedChanges], f64)>,
        mobility: f64,
        laws: &[ContactLaw],
        instructions: Arch,
    ) {
        match step {
            Some((of_elements, _)) => self.see_changes(of_elements),
            None if self.changed => {
                self.changed = false;
                self.blocks.iter_mut().for_each(|block| block.step.changes = [[ZEROS; OF_ELEMENT]; 2]);
            }
            None => (),
        }
        let (rows, rate) = (self.len(), step.map_or(0.0, |(_, h)| h * mobility));
        let mut cut = false;
        dispatch(instructions, Step { rows, blocks: &mut self.blocks, rate, cut: &mut cut });
        if cut || self.sliced {
            self.correct_cut(laws);
        }
    }

    /// Changes of the speeds of the elements for each contact.
    fn see_changes(&mut self, of_elements: &[SpeedChanges]) {
        self.changed = true;
        for (sites, block) in self.sites.chunks(WIDEST).zip(&mut self.blocks) {
            let [mean, end] = &mut block.step.changes;
            for (at, site) in sites.iter().enumerate().take(WIDEST) {
                let (of, lane) = place_of(site.element);
                let [to_mean, to_end] = &of_elements[of];
                for k in 0..OF_ELEMENT {
                    (mean[k][at], end[k][at]) = (to_mean[k][lane], to_end[k][lane]);
                }
            }
        }
    }

    /// Normal force, friction and rolling resistance of contact `i` in the step that was found last, N.
    #[inline]
    pub(crate) fn force_in_step(&self, i: usize) -> ContactForce<f64> {
        let (ContactBlock { force, step, .. }, lane) = self.at(i);
        contact_force([step.normal[lane], step.friction[lane], force.rolling_resistance[lane]])
    }

    /// Where damping has cut off the force, the spring loses what it held.
    fn correct_cut(&mut self, laws: &[ContactLaw]) {
        for (sites, block) in self.sites.chunks(WIDEST).zip(&mut self.blocks) {
            let ContactBlock { grip, motion, force, step, .. } = block;
            for (at, site) in sites.iter().enumerate().take(WIDEST) {
                let delta = motion.delta[at];
                if force.normal[at] == 0.0 && delta > 0.0 {
                    let [mean, _] = &step.changes;
                    let [approach, _] = grip.of(at).speeds([mean[0][at], mean[1][at], mean[2][at]]);
                    let [held, _] = laws[site.pair].spring(delta);
                    step.powers[0][at] = held * (motion.delta_dot[at] + approach);
                } else if laws[site.pair].sliced() {
                    let [mean, _] = &step.changes;
                    let [approach, _] = grip.of(at).speeds([mean[0][at], mean[1][at], mean[2][at]]);
                    let held = laws[site.pair].cut_off(&motion.of(at));
                    step.powers[0][at] += held * (motion.delta_dot[at] + approach);
                }
            }
        }
    }
}

struct Step<'a> {
    rows: usize,
    blocks: &'a mut [ContactBlock],
    /// Rate of friction over its secant slope, for the step.
    rate: f64,
    /// Whether damping has cut off a force.
    cut: &'a mut bool,
}

impl Columns for Step<'_> {
    fn rows(&self) -> usize {
        self.rows
    }

    #[inline(always)]
    fn group<S: Simd, const K: usize>(&mut self, simd: S, first: usize) {
        let (block, at) = place_of(first);
        let ContactBlock { grip, frame, motion, force, step, .. } = &mut self.blocks[block];
        let load = |column: &Lanes| Pack::<S, K>::load(simd, &column[at..]);
        let (grip, motion) = (grip.load(simd, at), motion.load(simd, at));
        let [mean, end] = &step.changes;
        let [approach, slip] = grip.speeds([load(&mean[0]), load(&mean[1]), load(&mean[2])]);
        let [_, slip_at_end] = grip.speeds([load(&end[0]), load(&end[1]), load(&end[2])]);
        let (normal, damping) = (load(&force.normal), load(&force.damping));
        let (secant, rolling_resistance) = (load(&force.friction_secant), load(&force.rolling_resistance));
        let beyond = implicit_share(secant * self.rate) * 2.0 - 1.0;
        let change = ContactForce {
            normal: damping * approach,
            friction: -(secant * (slip + beyond * (slip_at_end - slip))),
            ..ContactForce::none(Pack::all(simd, 0.0))
        };
        let friction = load(&force.friction) + change.friction;
        (normal + change.normal).store(&mut step.normal[at..]);
        friction.store(&mut step.friction[at..]);
        let approach_speed = motion.delta_dot + approach;
        (-(damping * approach_speed * approach_speed)).store(&mut step.powers[0][at..]);
        (friction * (motion.u1 - motion.u2 + slip)).store(&mut step.powers[1][at..]);
        (rolling_resistance * (motion.u1 + motion.u2)).store(&mut step.powers[2][at..]);
        let [_, reaction] = grip.wrenches(&change);
        store_on_mates(&mut step.reaction, at, frame.load(simd, at), &reaction);
        let [l_n, l_t, l_r] = grip.on_mate;
        (l_t * friction + l_r * rolling_resistance + l_n * (normal + change.normal))
            .store(&mut step.moment_on_mate[at..]);
        *self.cut |= Pack::any(normal.at_most(0.0) & motion.delta.above(0.0));
    }
}
