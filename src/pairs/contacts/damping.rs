//! Damping of the elements by their contacts.
//!
//! ```text
//! D = sum over contacts of  c W_n' W_n + s W_t' W_t        W lever rows of the element, c damping, s secant slope of friction
//! ```

use super::{Batch, ContactBlock};
use crate::bodies::{Damping, UPPER};
use crate::integrate::implicit_share;
use crate::scalar::{Columns, Lanes, Pack, WIDEST, ZEROS, dispatch, place_of};
use pulp::{Arch, Simd};

/// Entries of the upper triangle of D over (radial, across, spin), N s/m and its kin, and of its implicit share.
#[derive(Clone, Debug)]
pub(super) struct Triangles {
    full: [Lanes; UPPER.len()],
    implicit: [Lanes; UPPER.len()],
}

impl Triangles {
    pub(super) const ZERO: Self = Self { full: [ZEROS; UPPER.len()], implicit: [ZEROS; UPPER.len()] };
}

impl Batch {
    /// Adds the damping of the elements for a step of size `h` (s): all of it, and its implicit share, half of that of normal
    /// forces, and of friction by its rate on an element of this `mobility` (m/(N s^2)).
    pub(crate) fn add_damping(&mut self, h: f64, mobility: f64, instructions: Arch, out: &mut Damping) {
        let rows = self.len();
        dispatch(instructions, FindTriangles { rows, blocks: &mut self.blocks, rate: h * mobility });
        for (sites, block) in self.by_block() {
            let Triangles { full, implicit } = &block.damping;
            for (at, site) in sites.iter().enumerate().take(WIDEST) {
                let (of, lane) = place_of(site.element);
                let sums = &mut out.spokes[of];
                for (place, (i, k)) in UPPER.into_iter().enumerate() {
                    sums.full[i][k][lane] += full[place][at];
                    sums.implicit[i][k][lane] += implicit[place][at];
                }
            }
        }
    }
}

struct FindTriangles<'a> {
    rows: usize,
    blocks: &'a mut [ContactBlock],
    /// Rate over secant slope, for a step.
    rate: f64,
}

impl Columns for FindTriangles<'_> {
    fn rows(&self) -> usize {
        self.rows
    }

    #[inline(always)]
    fn group<S: Simd, const K: usize>(&mut self, simd: S, first: usize) {
        let (block, at) = place_of(first);
        let ContactBlock { grip, force, damping, .. } = &mut self.blocks[block];
        let load = |column: &Lanes| Pack::<S, K>::load(simd, &column[at..]);
        let levers = [load(&grip.normal[0]), load(&grip.normal[1]), load(&grip.arm), load(&grip.offset)];
        let (normal, friction) = (load(&force.damping), load(&force.friction_secant));
        store_triangle(&mut damping.full, at, levers, normal, friction);
        let acting = friction * implicit_share(friction * self.rate);
        store_triangle(&mut damping.implicit, at, levers, normal * 0.5, acting);
    }
}

/// Writes the upper triangle of c W_n' W_n + s W_t' W_t with the normal (r, c), arm and offset, and damping and slope c and s.
#[inline(always)]
fn store_triangle<S: Simd, const K: usize>(
    out: &mut [Lanes; UPPER.len()],
    at: usize,
    [r, c, arm, offset]: [Pack<S, K>; 4],
    damping: Pack<S, K>,
    slope: Pack<S, K>,
) {
    let (turning, pressing) = (slope * arm, damping * offset);
    (damping * r * r + slope * c * c).store(&mut out[0][at..]);
    ((damping - slope) * r * c).store(&mut out[1][at..]);
    (-(turning * c + pressing * r)).store(&mut out[2][at..]);
    (damping * c * c + slope * r * r).store(&mut out[3][at..]);
    (turning * r - pressing * c).store(&mut out[4][at..]);
    (turning * arm + pressing * offset).store(&mut out[5][at..]);
}
