//! Wrenches of all contacts on both of their bodies.

use super::{Batch, ContactBlock};
use crate::bodies::WrenchLanes;
use crate::laws::contact_pair::ContactForce;
use crate::scalar::{Columns, Lanes, Pack, dispatch, place_of};
use crate::space::{Frame, Wrench};
use pulp::{Arch, Simd};

impl Batch {
    /// Finds the wrenches of all contacts, and adds those on elements to theirs, unless these have no place.
    pub(crate) fn add_wrenches(&mut self, instructions: Arch, on_elements: &mut [WrenchLanes]) {
        dispatch(instructions, Wrenches { rows: self.len(), blocks: &mut self.blocks });
        if on_elements.is_empty() {
            return;
        }
        for (sites, block) in self.by_block() {
            let [radial, across, moment] = &block.on_elements;
            for (site, ((radial, across), moment)) in sites.iter().zip(radial.iter().zip(across).zip(moment))
            {
                let (of, lane) = place_of(site.element);
                let sums = &mut on_elements[of];
                sums[0][lane] += radial;
                sums[1][lane] += across;
                sums[2][lane] += moment;
            }
        }
    }
}

/// Writes a wrench that contacts have on their mates from a place on, in the frames of the elements, in global axes.
#[inline(always)]
pub(super) fn store_on_mates<S: Simd, const K: usize>(
    out: &mut WrenchLanes,
    lane: usize,
    frame: Frame<Pack<S, K>>,
    wrench: &Wrench<Pack<S, K>>,
) {
    let [y, z] = frame.to_global(wrench.force);
    y.store(&mut out[0][lane..]);
    z.store(&mut out[1][lane..]);
    wrench.moment.store(&mut out[2][lane..]);
}

struct Wrenches<'a> {
    rows: usize,
    blocks: &'a mut [ContactBlock],
}

impl Columns for Wrenches<'_> {
    fn rows(&self) -> usize {
        self.rows
    }

    #[inline(always)]
    fn group<S: Simd, const K: usize>(&mut self, simd: S, first: usize) {
        let (block, lane) = place_of(first);
        let ContactBlock { grip, frame, force, on_elements, on_mates, .. } = &mut self.blocks[block];
        let load = |column: &Lanes| Pack::<S, K>::load(simd, &column[lane..]);
        let [on_element, on_mate] = grip.load(simd, lane).wrenches(&ContactForce {
            normal: load(&force.normal),
            friction: load(&force.friction),
            rolling_resistance: load(&force.rolling_resistance),
            ..ContactForce::none(Pack::all(simd, 0.0))
        });
        let [radial, across] = on_element.force;
        radial.store(&mut on_elements[0][lane..]);
        across.store(&mut on_elements[1][lane..]);
        on_element.moment.store(&mut on_elements[2][lane..]);
        store_on_mates(on_mates, lane, frame.load(simd, lane), &on_mate);
    }
}
