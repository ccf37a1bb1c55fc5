//! Linear systems (m I - J) u = r with a real or complex shift m in 1/s and the Jacobian J of a second-order system.
//!
//! With q' = v, v' = a(t, q, v) the positions are eliminated, which leaves one structured system:
//!
//! ```text
//! (m I - D - K/m) u_v = r_v + K r_q/m,   u_q = (r_q + u_v)/m,   K = da/dq,  D = da/dv
//! ```

use crate::integrate::linear::{Arrowhead, Factors, HUB, Number, SPOKE};
use crate::integrate::{Linearization, Structure};
use nalgebra::{SMatrix, SVector};

/// The factorised matrix, with the memory to use it.
#[derive(Clone, Debug)]
pub struct Shifted<T: Number> {
    shift: T,
    matrix: Arrowhead<T>,
    factors: Factors<T>,
    hub: SVector<T, HUB>,
    spokes: Vec<SVector<T, SPOKE>>,
}

impl<T: Number> Shifted<T> {
    /// Memory for this number of spokes.
    pub fn new(spokes: usize) -> Self {
        Self {
            shift: T::one(),
            matrix: Arrowhead::new(spokes),
            factors: Factors::new(spokes),
            hub: SVector::zeros(),
            spokes: vec![SVector::zeros(); spokes],
        }
    }

    /// Factorises the matrix; false if that fails.
    #[must_use]
    pub fn factorize(&mut self, slope: &Linearization, shift: T) -> bool {
        self.shift = shift;
        let inverse = shift.recip();
        let (k, d) = (&slope.over_positions, &slope.over_velocities);
        self.matrix.hub = entries(&k.hub, &d.hub, inverse);
        for i in 0..HUB {
            self.matrix.hub[(i, i)] += shift;
        }
        for ((m, k), d) in self.matrix.spokes.iter_mut().zip(&k.spokes).zip(&d.spokes) {
            m.own = entries(&k.own, &d.own, inverse);
            m.to_hub = entries(&k.to_hub, &d.to_hub, inverse);
            m.from_hub = entries(&k.from_hub, &d.from_hub, inverse);
            for i in 0..SPOKE {
                m.own[(i, i)] += shift;
            }
        }
        self.factors.factorize(&self.matrix)
    }

    /// Replaces the right-hand side `r` over (`positions` positions, velocities) by the solution.
    pub fn solve(&mut self, slope: &Linearization, structure: &Structure, positions: usize, r: &mut [T]) {
        let inverse = self.shift.recip();
        let (r_q, r_v) = r.split_at_mut(positions);
        // Velocities without position have no column in K.
        let at = |x: &[T], index: Option<usize>| index.and_then(|i| x.get(i)).copied().unwrap_or(T::zero());
        let hub_q = SVector::<T, HUB>::from_fn(|k, _| at(r_q, structure.hub[k]));
        let k = &slope.over_positions;
        let mut pushed = product(&k.hub, &hub_q);
        for ((x, spoke), places) in self.spokes.iter_mut().zip(&k.spokes).zip(&structure.spokes) {
            let own_q = SVector::<T, SPOKE>::from_fn(|k, _| at(r_q, Some(places[k])));
            pushed += product(&spoke.to_hub, &own_q);
            let own = product(&spoke.own, &own_q) + product(&spoke.from_hub, &hub_q);
            *x = SVector::from_fn(|k, _| r_v[places[k]] + inverse * own[k]);
        }
        self.hub = SVector::from_fn(|k, _| at(r_v, structure.hub[k]) + inverse * pushed[k]);
        self.factors.solve(&mut self.hub, &mut self.spokes);
        for (x, index) in self.hub.iter().zip(&structure.hub) {
            if let Some(index) = index {
                r_v[*index] = *x;
            }
        }
        for (x, places) in self.spokes.iter().zip(&structure.spokes) {
            for (x, index) in x.iter().zip(places) {
                r_v[*index] = *x;
            }
        }
        for (u_q, u_v) in r_q.iter_mut().zip(r_v) {
            *u_q = inverse * (*u_q + *u_v);
        }
    }
}

/// -D - K/m
fn entries<T: Number, const R: usize, const C: usize>(
    k: &SMatrix<f64, R, C>,
    d: &SMatrix<f64, R, C>,
    inverse: T,
) -> SMatrix<T, R, C> {
    k.zip_map(d, |k, d| -inverse.scale(k) - T::from_real(d))
}

fn product<T: Number, const R: usize, const C: usize>(
    m: &SMatrix<f64, R, C>,
    x: &SVector<T, C>,
) -> SVector<T, R> {
    SVector::from_fn(|i, _| (0..C).fold(T::zero(), |sum, j| sum + x[j].scale(m[(i, j)])))
}
