//! Where rollers are loaded by a raceway: the places along one roller side by side in lanes.

use super::super::Space;
use super::super::workspace::Workspace;
use super::RollersOfScene;
use super::contacts::{Contact, Place, RollerMemory};
use crate::bodies::MovingRing;
use crate::laws::elastic::loaded::Loaded;
use crate::laws::elastic::surface::{OneByOne, Straight};
use crate::laws::elastic::tilted::Along;
use crate::pairs::roller::{NUMBERS, OnRaceway, Spot};
use crate::scalar::{Pack, ZEROS};
use crate::scene::SlicesOn;
use pulp::{Simd, WithSimd};

/// All rollers and one raceway.
struct TouchRaceway<'a> {
    rollers: &'a RollersOfScene,
    side: usize,
    /// How much larger than nominal each roller is, m.
    excess: &'a [f64],
    ring: MovingRing<f64>,
    memory: &'a mut RollerMemory,
}

impl Space {
    /// Finds where rollers are loaded by one raceway.
    pub(super) fn touch_raceway(&self, rollers: &RollersOfScene, side: usize, ws: &mut Workspace) {
        let Workspace { rollers: memory, rings, instructions, .. } = ws;
        let excess = &self.set.radius_excess[..self.layout.count];
        instructions.dispatch(TouchRaceway { rollers, side, excess, ring: rings[side], memory });
    }
}

impl WithSimd for TouchRaceway<'_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) {
        let Self { rollers, side, excess, ring, memory } = self;
        let (geometry, nominal) = (&rollers.geometry, rollers.half_length);
        let mut lanes = [ZEROS; NUMBERS];
        for (j, excess) in excess.iter().enumerate() {
            let (a, profile) = (rollers.shapes.half_length(j), rollers.shapes.surface(side, j));
            let of = &memory.rollers[j];
            let (ring, roller) = (ring.beside(of.direction), of.state.motion());
            let on = OnRaceway { geometry, profile, side, ring, roller, excess: *excess };
            let in_lanes = on.map(OneByOne(profile), |x| Pack::<S, 1>::all(simd, x));
            let mut ends = ZEROS;
            (ends[1], ends[2]) = (-a, a);
            let straight = |first: usize| in_lanes.disc_in_line(Straight, Pack::load(simd, &ends[first..]));
            let discs = straight(0);
            let middle_disc = discs.map(|x| x.lanes()[0]);
            if on.apart(&middle_disc, a) {
                continue;
            }
            let [mut deltas, mut places] = [discs.delta, discs.in_raceway].map(Pack::lanes);
            for first in (S::F64_LANES..3).step_by(S::F64_LANES) {
                let discs = straight(first);
                discs.delta.store(&mut deltas[first..]);
                discs.in_raceway.store(&mut places[first..]);
            }
            let approach = Along::parabola(a, [deltas[1], deltas[0], deltas[2]]);
            let in_raceway = [places[0], 0.5 * (places[2] - places[1]) / a];
            let along = Along { profile, half_length: a, approach, in_raceway };
            let loaded = match rollers.slices_on {
                SlicesOn::Loaded => along.loaded(),
                SlicesOn::Whole => Loaded::whole(a),
            };
            if loaded.parts().is_empty() {
                continue;
            }
            memory.found.clear();
            loaded.slices(nominal, rollers.slices, &mut memory.found);
            let middle = on.middle(&middle_disc);
            let [x, rho] = of.state.at;
            let centre = ring.centre;
            let from_mate = [x - centre[0], rho + geometry.pitch_radius - centre[1], -centre[2]];
            let place = (Place::Raceway(side), side, side);
            memory.open(Contact::new(j, place, middle.passing, from_mate, loaded));
            let middle = middle.map(|x| Pack::<S, 1>::all(simd, x));
            for first in (0..memory.found.len()).step_by(S::F64_LANES) {
                let last = memory.found.len().min(first + S::F64_LANES);
                let mut s = ZEROS;
                for (s, slice) in s.iter_mut().zip(&memory.found[first..last]) {
                    *s = slice.place;
                }
                let s = Pack::load(simd, &s);
                let spots = in_lanes.spot(&middle, s, in_lanes.disc_in_line(in_lanes.profile, s)).numbers();
                for (lanes, numbers) in lanes.iter_mut().zip(spots) {
                    numbers.store(lanes);
                }
                for i in first..last {
                    memory.add(memory.found[i], &Spot::of_numbers(|k| lanes[k][i - first]), 0.0);
                }
            }
            memory.close();
        }
    }
}
