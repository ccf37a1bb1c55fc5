//! Sums of the derivatives of all wrenches over the coordinates, in the structure of the bearing: shared bodies are coupled to
//! every element, elements to nothing else.

use crate::bodies::{CAGE_MOTION, Input, InputValues, Layout, Motions, OF_ELEMENT, PLACES, SharedBodies};
use crate::integrate::Linearization;
use crate::integrate::linear::Arrowhead;
use crate::scalar::{Lanes, WIDEST, ZEROS};
use std::ops::Range;

/// Sums in the making.
pub(crate) struct SlopeSums<'a> {
    pub(crate) layout: &'a Layout,
    pub(crate) bodies: &'a SharedBodies,
    /// How the inputs change, per second.
    pub(crate) rates: &'a InputValues,
    /// Rate of the logarithm of the viscosity, 1/s.
    pub(crate) ln_viscosity_rate: f64,
    /// Change of the logarithm of the structure of a grease over that of its viscosity.
    pub(crate) ln_structure_ratio: f64,
    pub(crate) out: &'a mut Linearization<OF_ELEMENT>,
}

/// Derivatives of one component of a wrench over the first positions and velocities of a body, as many as it has.
pub(crate) type Slope<const P: usize, const V: usize> = ([f64; P], [f64; V]);

/// Derivatives of the wrenches of a block of contacts by columns: the coordinates of the element (two positions, three
/// velocities) and of the mate (three and three), and time.
#[derive(Clone, Debug)]
pub(crate) struct ContactColumns {
    /// On elements, in their axes.
    pub(crate) own: [[Lanes; OF_ELEMENT]; Self::COUNT],
    /// On mates, in global axes.
    pub(crate) on_mate: [[Lanes; OF_ELEMENT]; Self::COUNT],
}

impl ContactColumns {
    /// Where columns begin: radial offset and travel of the element; their rates and its spin; place and angle of the mate; its
    /// velocity and speed; time.
    pub(crate) const OFFSET: usize = 0;
    pub(crate) const RADIAL_SPEED: usize = 2;
    pub(crate) const PLACE: usize = 5;
    pub(crate) const VELOCITY: usize = 8;
    pub(crate) const TIME: usize = 11;
    pub(crate) const COUNT: usize = Self::TIME + 1;
    pub(crate) const ZERO: Self =
        Self { own: [[ZEROS; OF_ELEMENT]; Self::COUNT], on_mate: [[ZEROS; OF_ELEMENT]; Self::COUNT] };
}

/// Derivatives of the wrenches of a block of contacts over the spin angles of their elements.
#[derive(Clone, Debug)]
pub(crate) struct OverSpinAngles {
    /// On elements, in their axes.
    pub(crate) own: [Lanes; OF_ELEMENT],
    /// On mates, in global axes.
    pub(crate) on_mate: [Lanes; OF_ELEMENT],
}

impl OverSpinAngles {
    pub(crate) const ZERO: Self = Self { own: [ZEROS; OF_ELEMENT], on_mate: [ZEROS; OF_ELEMENT] };
}

/// Adds what stands at a place of the lanes to the first components of a wrench.
#[inline(always)]
fn add(sum: &mut [f64], slopes: &[Lanes; OF_ELEMENT], lane: usize) {
    for (sum, column) in sum.iter_mut().zip(slopes) {
        *sum += column[lane % WIDEST];
    }
}

/// Columns of a matrix with as many rows as an element has velocities.
#[inline]
fn chunks(columns: &mut [f64]) -> &mut [[f64; OF_ELEMENT]] {
    columns.as_chunks_mut().0
}

impl SlopeSums<'_> {
    /// Step of the logarithm of the viscosity, where a difference over it is taken.
    pub(crate) const VISCOSITY_STEP: f64 = 1e-4;

    /// Rate of the rotation speed of a shared body whose rotation is prescribed, rad/s^2; zero of others.
    pub(crate) fn speeding(&self, body: usize) -> f64 {
        let turned_by = self.bodies[body].as_ref().and_then(|body| body.turned_by());
        turned_by.map_or(0.0, |input| self.rates.of(input))
    }

    /// Rates of place and velocity of a shared body that inputs move, m/s and m/s^2; zero of others.
    pub(crate) fn moving(&self, body: usize) -> [[f64; 2]; 2] {
        let moved_by = self.bodies.get(body).and_then(|body| body.as_ref()?.moved_by());
        moved_by.map_or([[0.0; 2]; 2], |places| {
            [0, 1].map(|which| places.map(|place| self.rates.of(PLACES[place][which])))
        })
    }

    /// Adds the derivatives of the contact at a place of the columns, of this element with this mate, but for those of the mate
    /// over its own coordinates.
    #[inline(always)]
    pub(crate) fn add_contact(&mut self, j: usize, mate: usize, columns: &ContactColumns, lane: usize) {
        if j >= self.layout.count {
            return;
        }
        self.add_own(j, columns, lane);
        // Pairs act on the motion of a body only, which has so many coordinates at most.
        match self.layout.range(mate).len().min(OF_ELEMENT) {
            0 => {}
            1 => self.add_across::<1>(j, mate, columns, lane),
            2 => self.add_across::<2>(j, mate, columns, lane),
            _ => self.add_across::<OF_ELEMENT>(j, mate, columns, lane),
        }
    }

    /// Over positions and over velocities, with the columns of elements and of mates.
    #[inline(always)]
    fn parts(&mut self) -> [(&mut Arrowhead<f64, OF_ELEMENT>, Range<usize>, Range<usize>); 2] {
        use ContactColumns as C;
        let Linearization { over_positions, over_velocities, .. } = &mut *self.out;
        [
            (over_positions, C::OFFSET..C::RADIAL_SPEED, C::PLACE..C::VELOCITY),
            (over_velocities, C::RADIAL_SPEED..C::PLACE, C::VELOCITY..C::TIME),
        ]
    }

    /// Of the element over its own coordinates.
    #[inline(always)]
    fn add_own(&mut self, j: usize, columns: &ContactColumns, lane: usize) {
        for (part, by_own, _) in self.parts() {
            let own = &mut chunks(part.own.as_mut_slice())[j * OF_ELEMENT..(j + 1) * OF_ELEMENT];
            for (column, slopes) in own.iter_mut().zip(&columns.own[by_own]) {
                add(column, slopes, lane);
            }
        }
    }

    /// Adds the derivatives of the wrenches of the contact at a place of the lanes over the spin angle of its element, where that is a
    /// position.
    pub(crate) fn add_over_spin_angle(&mut self, j: usize, mate: usize, over: &OverSpinAngles, lane: usize) {
        if j >= self.layout.count {
            return;
        }
        let (places, width) = (self.layout.range(mate), self.layout.hub());
        let Linearization { over_positions, .. } = &mut *self.out;
        let column = OF_ELEMENT * j + OF_ELEMENT - 1;
        add(&mut chunks(over_positions.own.as_mut_slice())[column], &over.own, lane);
        add(&mut over_positions.to_hub.as_mut_slice()[width * column..][places], &over.on_mate, lane);
    }

    /// Adds the derivatives of the wrench on element `j`, in its axes, over its own coordinates and those of its neighbour on a
    /// side (0 ahead, 1 behind), each two positions and three velocities, and its rate at constant state.
    pub(crate) fn add_neighbours(
        &mut self,
        j: usize,
        side: usize,
        slopes: [[f64; 10]; OF_ELEMENT],
        rates: [f64; OF_ELEMENT],
    ) {
        use ContactColumns as C;
        for (part, by, _) in self.parts() {
            let own = &mut chunks(part.own.as_mut_slice())[j * OF_ELEMENT..];
            let rim = &mut chunks(part.rim.as_mut_slice())[(2 * j + side) * OF_ELEMENT..];
            for ((own, rim), c) in own.iter_mut().zip(rim).zip(by) {
                for i in 0..OF_ELEMENT {
                    own[i] += slopes[i][c];
                    rim[i] += slopes[i][c + C::PLACE];
                }
            }
        }
        for (place, rate) in self.layout.of_element::<OF_ELEMENT>(j).into_iter().zip(rates) {
            self.out.over_time[place] += rate;
        }
    }

    /// Of the element over the first `N` coordinates of the mate, and the other way round.
    #[inline(always)]
    fn add_across<const N: usize>(&mut self, j: usize, mate: usize, columns: &ContactColumns, lane: usize) {
        let (start, width) = (self.layout.range(mate).start, self.layout.hub());
        for (part, by_own, by_mate) in self.parts() {
            let from_hub = chunks(&mut part.from_hub.as_mut_slice()[OF_ELEMENT * (j * width + start)..]);
            for (column, slopes) in from_hub.iter_mut().zip(&columns.own[by_mate][..N]) {
                add(column, slopes, lane);
            }
            let to_hub = part.to_hub.as_mut_slice()[OF_ELEMENT * width * j..].chunks_exact_mut(width);
            for (column, slopes) in to_hub.zip(&columns.on_mate[by_own]) {
                if let Some(column) = column[start..].first_chunk_mut::<N>() {
                    add(column, slopes, lane);
                }
            }
        }
    }

    /// Adds the derivatives of the wrenches on a mate over its own coordinates by the contacts at these places of the columns.
    pub(crate) fn add_on_mate(&mut self, mate: usize, columns: &ContactColumns, lanes: Range<usize>) {
        let places = self.layout.range(mate);
        for (part, _, by_mate) in self.parts() {
            for (column, at) in columns.on_mate[by_mate].iter().zip(places.clone()) {
                for (slopes, row) in column.iter().zip(places.clone()) {
                    let entry = &mut part.hub[(row, at)];
                    *entry = slopes[lanes.clone()].iter().fold(*entry, |sum, slope| sum + slope);
                }
            }
        }
    }

    /// Adds what changes while the state does not, by the contact at a place of the columns: viscosity, the speed of the mate,
    /// elements of prescribed motion.
    pub(crate) fn add_contact_over_time(
        &mut self,
        j: usize,
        mate: usize,
        columns: &ContactColumns,
        lane: usize,
    ) {
        let ContactColumns { own, on_mate } = columns;
        let places = self.layout.range(mate);
        add(&mut self.out.over_time[places.clone()], &on_mate[ContactColumns::TIME], lane);
        if j < self.layout.count {
            let mut rates = own[ContactColumns::TIME].each_ref().map(|column| column[lane]);
            for (first, of_mate) in
                [ContactColumns::PLACE, ContactColumns::VELOCITY].into_iter().zip(self.moving(mate))
            {
                for (k, rate) in of_mate.into_iter().enumerate().filter(|(_, rate)| *rate != 0.0) {
                    for (sum, column) in rates.iter_mut().zip(&own[first + k]) {
                        *sum += column[lane] * rate;
                    }
                }
            }
            for (place, rate) in self.layout.of_element::<OF_ELEMENT>(j).into_iter().zip(rates) {
                self.out.over_time[place] += rate;
            }
            return;
        }
        let [travel, orbit, spin] =
            [ContactColumns::OFFSET + 1, ContactColumns::RADIAL_SPEED + 1, ContactColumns::RADIAL_SPEED + 2]
                .map(|c| &on_mate[c]);
        let rates = self.rates;
        for (i, place) in places.enumerate().take(OF_ELEMENT) {
            self.out.over_time[place] += travel[i][lane] * rates.orbit_travel()
                + orbit[i][lane] * rates.of(Input::OrbitSpeed)
                + spin[i][lane] * rates.of(Input::SpinSpeed);
        }
    }

    /// Adds what belongs to the coordinates of a deformed mate behind those of its motion, by the contact at a place of the
    /// columns, of element `j`, that acts on the mate with the force `on_mate` (N).
    ///
    /// With b the displacement of the place of the element per unit of such a coordinate, in global axes: the force over it is
    /// b F, and what derivatives over b and its rate are is known from those over place and velocity of the mate, which moves
    /// the levers and the axes, too.
    pub(crate) fn add_displaced(
        &mut self,
        j: usize,
        mate: usize,
        on_mate: [f64; 2],
        motions: &Motions,
        columns: &ContactColumns,
        lane: usize,
    ) {
        use ContactColumns as C;
        let bodies = self.bodies;
        let Some(body) = &bodies[mate] else { return };
        let (basis, frame) = (body.displacements(j), motions.pocket_frame(j));
        let speed = motions.shared[mate].speed;
        let (first, width) = (self.layout.range(mate).start, self.layout.hub());
        let modes = first + CAGE_MOTION;
        let free = j < self.layout.count;
        // Rates of what is prescribed.
        let rates = self.rates;
        let prescribed = [rates.orbit_travel(), rates.of(Input::OrbitSpeed), rates.of(Input::SpinSpeed)];
        let of = |rows: &[[Lanes; OF_ELEMENT]; C::COUNT], c: usize, i: usize| rows[c][i][lane];
        // Over the displacement in global axes, of component i.
        let over_place = |rows: &[[Lanes; OF_ELEMENT]; C::COUNT], i: usize| {
            let [y, z] = [C::PLACE, C::PLACE + 1].map(|c| of(rows, c, i));
            let [vy, vz] = [C::VELOCITY, C::VELOCITY + 1].map(|c| of(rows, c, i));
            [y + speed * vz, z - speed * vy]
        };
        let over_rate = |rows: &[[Lanes; OF_ELEMENT]; C::COUNT], i: usize| {
            [C::VELOCITY, C::VELOCITY + 1].map(|c| of(rows, c, i))
        };
        let along = |b: [f64; 2], x: [f64; 2]| b[0] * x[0] + b[1] * x[1];
        for (k, b) in basis.iter().enumerate() {
            let b = frame.to_global(*b);
            // The forces over this coordinate, over everything but such coordinates.
            let row = |c: usize| {
                let turned = if c == C::PLACE + 2 { b[0] * on_mate[1] - b[1] * on_mate[0] } else { 0.0 };
                along(b, [of(&columns.on_mate, c, 0), of(&columns.on_mate, c, 1)]) + turned
            };
            let time = row(C::TIME);
            self.out.over_time[modes + k] += time;
            if !free {
                let over = [row(C::OFFSET + 1), row(C::RADIAL_SPEED + 1), row(C::RADIAL_SPEED + 2)];
                self.out.over_time[modes + k] +=
                    over.iter().zip(prescribed).map(|(x, rate)| x * rate).sum::<f64>();
            }
            for (is_rate, (part, by_own, by_mate)) in self.parts().into_iter().enumerate() {
                for (i, c) in by_mate.enumerate() {
                    part.hub[(modes + k, first + i)] += row(c);
                }
                if free {
                    let to_hub = part.to_hub.as_mut_slice()[OF_ELEMENT * width * j..].chunks_exact_mut(width);
                    for (column, c) in to_hub.zip(by_own) {
                        column[modes + k] += row(c);
                    }
                    let from_hub =
                        &mut chunks(&mut part.from_hub.as_mut_slice()[OF_ELEMENT * j * width..])[modes + k];
                    for (i, sum) in from_hub.iter_mut().enumerate() {
                        let rows = &columns.own;
                        let over = if is_rate == 1 { over_rate(rows, i) } else { over_place(rows, i) };
                        *sum += along(b, over);
                    }
                }
                let over = |i: usize| {
                    let mut over = if is_rate == 1 {
                        over_rate(&columns.on_mate, i)
                    } else {
                        over_place(&columns.on_mate, i)
                    };
                    if is_rate == 0 && i == 2 {
                        // The lever stays where it is.
                        (over[0], over[1]) = (over[0] + on_mate[1], over[1] - on_mate[0]);
                    }
                    over
                };
                for i in 0..OF_ELEMENT {
                    part.hub[(first + i, modes + k)] += along(b, over(i));
                }
                let [over_y, over_z] = [over(0), over(1)];
                for (other, b_other) in basis.iter().enumerate() {
                    let b_other = frame.to_global(*b_other);
                    let force = [along(b, over_y), along(b, over_z)];
                    part.hub[(modes + other, modes + k)] += along(b_other, force);
                }
            }
        }
    }

    /// Adds derivatives of the first components of the wrench on a shared body over the coordinates of one, itself or another.
    #[inline]
    pub(crate) fn add_mate<const M: usize, const N: usize>(
        &mut self,
        mate: usize,
        over: usize,
        rows: &[Slope<N, N>; M],
    ) {
        let (k, d) = (&mut self.out.over_positions.hub, &mut self.out.over_velocities.hub);
        for (at, (position, velocity)) in self.layout.range(mate).zip(rows) {
            for (c, column) in self.layout.range(over).enumerate().take(N) {
                k[(at, column)] += position[c];
                d[(at, column)] += velocity[c];
            }
        }
    }

    /// Adds rates of the first components of the wrench on a shared body at constant state.
    #[inline]
    pub(crate) fn add_mate_over_time(&mut self, mate: usize, rates: &[f64]) {
        for (place, rate) in self.layout.range(mate).zip(rates) {
            self.out.over_time[place] += rate;
        }
    }
}
