//! Linear systems (m I - J) u = r with a real or complex shift m in 1/s and the Jacobian J of a second-order system.
//!
//! With q' = v, v' = a(t, q, v) the positions are eliminated, which leaves one structured system:
//!
//! ```text
//! (m I - D - K/m) u_v = r_v + K r_q/m,   u_q = (r_q + u_v)/m,   K = da/dq,  D = da/dv
//! ```

use crate::integrate::linear::lu::with_width;
use crate::integrate::linear::{Arrowhead, Factors, Number};
use crate::integrate::{Linearization, Structure};
use nalgebra::{Dim, SVector};

/// The factorised matrix, with the memory to use it.
#[derive(Clone, Debug)]
pub struct Shifted<T: Number, const N: usize> {
    shift: T,
    matrix: Arrowhead<T, N>,
    factors: Factors<T, N>,
    /// Right-hand sides.
    hub: Vec<T>,
    spokes: Vec<SVector<T, N>>,
    memory: [Vec<T>; 3],
}

impl<T: Number, const N: usize> Shifted<T, N> {
    /// Memory for systems of this structure.
    pub fn new(structure: &Structure<N>) -> Self {
        let (width, spokes) = (structure.hub.len(), structure.spokes.len());
        Self {
            shift: T::one(),
            matrix: Arrowhead::of(structure),
            factors: Factors::new(width, spokes),
            hub: vec![T::zero(); width],
            spokes: vec![SVector::zeros(); spokes],
            memory: std::array::from_fn(|_| vec![T::zero(); width]),
        }
    }

    /// Factorises the matrix; false if that fails.
    #[must_use]
    pub fn factorize(&mut self, slope: &Linearization<N>, shift: T) -> bool {
        self.shift = shift;
        let inverse = shift.recip();
        let (k, d) = (slope.over_positions.blocks(), slope.over_velocities.blocks());
        for ((m, k), d) in self.matrix.blocks_mut().into_iter().zip(k).zip(d) {
            for ((m, k), d) in m.iter_mut().zip(k).zip(d) {
                *m = -inverse.scale(*k) - T::from_real(*d);
            }
        }
        self.matrix.add_diagonal(shift);
        self.factors.factorize(&self.matrix)
    }

    /// Replaces the right-hand side `r` over (`positions` positions, velocities) by the solution.
    pub fn solve(
        &mut self,
        slope: &Linearization<N>,
        structure: &Structure<N>,
        positions: usize,
        r: &mut [T],
    ) {
        with_width!(N, self.hub.len(), width => self.eliminate_positions(slope, structure, positions, r, width));
        let inverse = self.shift.recip();
        let Self { hub, spokes, factors, .. } = self;
        let (r_q, r_v) = r.split_at_mut(positions);
        factors.solve(hub, spokes);
        for (x, index) in hub.iter().zip(&structure.hub) {
            r_v[*index] = *x;
        }
        for (x, places) in spokes.iter().zip(&structure.spokes) {
            for (x, index) in x.iter().zip(places) {
                r_v[*index] = *x;
            }
        }
        for (u_q, u_v) in r_q.iter_mut().zip(r_v) {
            *u_q = inverse * (*u_q + *u_v);
        }
    }

    /// Right-hand sides over the velocities alone.
    fn eliminate_positions<W: Dim>(
        &mut self,
        slope: &Linearization<N>,
        structure: &Structure<N>,
        positions: usize,
        r: &[T],
        width: W,
    ) {
        let width = width.value();
        let inverse = self.shift.recip();
        let (r_q, r_v) = r.split_at(positions);
        // Velocities without position have no column in K.
        let at = |x: &[T], index: usize| x.get(index).copied().unwrap_or(T::zero());
        let [hub_q, pushed, by_spoke] = &mut self.memory;
        let (hub_q, pushed, by_spoke) = (&mut hub_q[..width], &mut pushed[..width], &mut by_spoke[..width]);
        for (x, index) in hub_q.iter_mut().zip(&structure.hub) {
            *x = at(r_q, *index);
        }
        let k = &slope.over_positions;
        pushed.fill(T::zero());
        add_scaled(k.hub.as_slice(), hub_q, pushed);
        let spokes = &structure.spokes;
        for (j, (x, places)) in self.spokes.iter_mut().zip(spokes).enumerate() {
            let mut own_q = [T::zero(); N];
            for (x, index) in own_q.iter_mut().zip(places) {
                *x = at(r_q, *index);
            }
            by_spoke.fill(T::zero());
            add_scaled(&k.to_hub_of(j)[..N * width], &own_q, by_spoke);
            pushed.iter_mut().zip(by_spoke.iter()).for_each(|(sum, x)| *sum += *x);
            let [mut own, mut across] = [[T::zero(); N]; 2];
            add_scaled(k.own_of(j)[..N].as_flattened(), &own_q, &mut own);
            add_scaled(k.from_hub_of(j)[..width].as_flattened(), hub_q, &mut across);
            for (other, columns) in k.rim_of(j) {
                let other_q = spokes[other].map(|index| at(r_q, index));
                add_scaled(columns.as_flattened(), &other_q, &mut across);
            }
            *x = SVector::from_fn(|k, _| r_v[places[k]] + inverse * (own[k] + across[k]));
        }
        for ((x, pushed), index) in self.hub.iter_mut().zip(pushed).zip(&structure.hub) {
            *x = r_v[*index] + inverse * *pushed;
        }
    }
}

/// Adds the product of a real matrix, given by its columns, with `x`.
#[inline(always)]
fn add_scaled<T: Number>(columns: &[f64], x: &[T], sum: &mut [T]) {
    for (x, column) in x.iter().zip(columns.chunks_exact(sum.len().max(1))) {
        sum.iter_mut().zip(column).for_each(|(sum, m)| *sum += x.scale(*m));
    }
}
