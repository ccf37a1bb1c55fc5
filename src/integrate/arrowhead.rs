//! Linear systems of one shared group of unknowns, the hub, and small groups, the spokes, that touch only the hub.
//!
//! ```text
//! | S   U_1  U_2 ..|  | s   |   | b   |      S   hub
//! | V_1 A_1        |  | x_1 | = | c_1 |      A_j spoke j
//! | V_2      A_2   |  | x_2 |   | c_2 |      U_j to_hub,  V_j from_hub
//! | :           .. |  | :   |   | :   |
//!
//! T_j = A_j^-1 V_j,   y_j = A_j^-1 c_j
//! (S - sum U_j T_j) s = b - sum U_j y_j,   x_j = y_j - T_j s
//! ```
//!
//! The cost is linear in the number of spokes. Rows and columns may differ in scale by many orders: pivots are
//! chosen as if both were scaled to one. Inverses are never formed: with stiff, nearly singular groups they would
//! lose what cancels between hub and spokes.

use nalgebra::{SMatrix, SVector};

/// Unknowns of the hub.
pub const HUB: usize = 5;
/// Unknowns of a spoke.
pub const SPOKE: usize = 3;

/// A pivot below this share of the terms whose difference it is consists of rounding: the matrix is singular.
const ROUNDING: f64 = 4.0 * f64::EPSILON;

/// The part of the matrix that belongs to one spoke.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Spoke {
    /// A_j: rows and columns of the spoke.
    pub own: SMatrix<f64, SPOKE, SPOKE>,
    /// U_j: rows of the hub, columns of the spoke.
    pub to_hub: SMatrix<f64, HUB, SPOKE>,
    /// V_j: rows of the spoke, columns of the hub.
    pub from_hub: SMatrix<f64, SPOKE, HUB>,
}

impl Spoke {
    /// A spoke with the identity and without coupling.
    pub fn identity() -> Self {
        Self { own: SMatrix::identity(), to_hub: SMatrix::zeros(), from_hub: SMatrix::zeros() }
    }
}

/// The matrix. Unused places carry the identity.
#[derive(Clone, Debug, PartialEq)]
pub struct Arrowhead {
    /// S: rows and columns of the hub.
    pub hub: SMatrix<f64, HUB, HUB>,
    /// The spokes.
    pub spokes: Vec<Spoke>,
}

impl Arrowhead {
    /// The identity with this number of spokes.
    pub fn new(spokes: usize) -> Self {
        Self { hub: SMatrix::identity(), spokes: vec![Spoke::identity(); spokes] }
    }

    /// Makes the matrix the identity.
    pub fn fill_identity(&mut self) {
        self.hub = SMatrix::identity();
        self.spokes.fill(Spoke::identity());
    }

    /// Makes the matrix zero.
    pub fn fill_zero(&mut self) {
        self.hub = SMatrix::zeros();
        let zero = Spoke { own: SMatrix::zeros(), to_hub: SMatrix::zeros(), from_hub: SMatrix::zeros() };
        self.spokes.fill(zero);
    }

    /// Product of the matrix with (`hub`, `spokes`).
    ///
    /// # Panics
    /// If the numbers of spokes differ.
    pub fn multiply(
        &self,
        hub: &SVector<f64, HUB>,
        spokes: &[SVector<f64, SPOKE>],
        hub_out: &mut SVector<f64, HUB>,
        spokes_out: &mut [SVector<f64, SPOKE>],
    ) {
        assert!(spokes.len() == self.spokes.len() && spokes_out.len() == self.spokes.len());
        *hub_out = self.hub * hub;
        for ((spoke, x), out) in self.spokes.iter().zip(spokes).zip(spokes_out) {
            *hub_out += spoke.to_hub * x;
            *out = spoke.own * x + spoke.from_hub * hub;
        }
    }
}

/// The factors of an [`Arrowhead`]. Memory is taken once.
#[derive(Clone, Debug)]
pub struct Factors {
    hub: Lu<HUB>,
    spokes: Vec<SpokeFactors>,
}

#[derive(Clone, Copy, Debug)]
struct SpokeFactors {
    own: Lu<SPOKE>,
    /// Columns of U_j.
    to_hub: [[f64; HUB]; SPOKE],
    /// Rows of T_j.
    response: [[f64; HUB]; SPOKE],
}

impl Factors {
    /// The factors of the identity with this number of spokes.
    pub fn new(spokes: usize) -> Self {
        let zero = [[0.0; HUB]; SPOKE];
        let spoke = SpokeFactors { own: Lu::identity(), to_hub: zero, response: zero };
        Self { hub: Lu::identity(), spokes: vec![spoke; spokes] }
    }

    /// Factorises a matrix. False when it is singular within rounding or not finite; the factors are then of no use.
    ///
    /// # Panics
    /// If the numbers of spokes differ.
    #[must_use]
    pub fn factorize(&mut self, a: &Arrowhead) -> bool {
        assert_eq!(a.spokes.len(), self.spokes.len());
        // Columns of the Schur complement.
        let mut schur: [[f64; HUB]; HUB] = a.hub.data.0;
        for (spoke, factors) in a.spokes.iter().zip(&mut self.spokes) {
            let own = transposed(&spoke.own.data.0);
            if !factors.own.decompose(own, own.map(|row| row.map(f64::abs))) {
                return false;
            }
            factors.to_hub = spoke.to_hub.data.0;
            factors.response = factors.own.solve(&transposed(&spoke.from_hub.data.0));
            for (c, column) in schur.iter_mut().enumerate() {
                for (u, t) in factors.to_hub.iter().zip(&factors.response) {
                    subtract(column, t[c], u);
                }
            }
        }
        let schur = transposed(&schur);
        let mut size = transposed(&a.hub.data.0);
        for (size, s) in size.iter_mut().flatten().zip(schur.iter().flatten()) {
            *size = size.abs().max(s.abs());
        }
        self.hub.decompose(schur, size)
    }

    /// Replaces the right-hand side (`hub`, `spokes`) by the solution.
    ///
    /// # Panics
    /// If the numbers of spokes differ.
    pub fn solve(&self, hub: &mut SVector<f64, HUB>, spokes: &mut [SVector<f64, SPOKE>]) {
        assert_eq!(spokes.len(), self.spokes.len());
        let mut s: [f64; HUB] = hub.data.0[0];
        for (factors, x) in self.spokes.iter().zip(spokes.iter_mut()) {
            let y = factors.own.solve(&x.data.0[0].map(|x| [x]));
            for (u, [y]) in factors.to_hub.iter().zip(y) {
                subtract(&mut s, y, u);
            }
            *x = SVector::from(y.map(|[y]| y));
        }
        let s = self.hub.solve(&s.map(|s| [s])).map(|[s]| s);
        *hub = SVector::from(s);
        for (factors, x) in self.spokes.iter().zip(spokes) {
            for (x, t) in x.iter_mut().zip(&factors.response) {
                *x -= t.iter().zip(&s).map(|(t, s)| t * s).sum::<f64>();
            }
        }
    }
}

/// Rows of the triangular factors of a small matrix, with the inverse of the diagonal.
#[derive(Clone, Copy, Debug)]
struct Lu<const N: usize> {
    rows: [[f64; N]; N],
    /// Row of the matrix that each row came from.
    order: [usize; N],
}

impl<const N: usize> Lu<N> {
    fn identity() -> Self {
        let rows = std::array::from_fn(|i| std::array::from_fn(|j| f64::from(u8::from(i == j))));
        Self { rows, order: std::array::from_fn(|i| i) }
    }

    /// Factorises the matrix with these rows. `size` is the magnitude of the terms that each entry is a sum of.
    #[inline]
    fn decompose(&mut self, mut a: [[f64; N]; N], mut size: [[f64; N]; N]) -> bool {
        let Some(mut weight) = row_weights(&a) else { return false };
        let mut order: [usize; N] = std::array::from_fn(|i| i);
        for k in 0..N {
            let mut best = k;
            for i in k + 1..N {
                if a[i][k].abs() * weight[i] > a[best][k].abs() * weight[best] {
                    best = i;
                }
            }
            if best != k {
                a.swap(k, best);
                size.swap(k, best);
                weight.swap(k, best);
                order.swap(k, best);
            }
            let inverse = a[k][k].recip();
            // Also false for what is not a number.
            let sound = a[k][k].abs() > ROUNDING * size[k][k] && inverse.is_finite();
            if !sound {
                return false;
            }
            a[k][k] = inverse;
            for i in k + 1..N {
                let l = a[i][k] * inverse;
                a[i][k] = l;
                for j in k + 1..N {
                    let term = l * a[k][j];
                    a[i][j] -= term;
                    size[i][j] = size[i][j].max(term.abs());
                }
            }
        }
        (self.rows, self.order) = (a, order);
        true
    }

    /// Rows of the solution for right-hand sides with these rows.
    #[inline]
    fn solve<const M: usize>(&self, b: &[[f64; M]; N]) -> [[f64; M]; N] {
        let mut x = self.order.map(|i| b[i]);
        for i in 1..N {
            let (known, rest) = x.split_at_mut(i);
            for (l, known) in self.rows[i].iter().zip(known) {
                subtract(&mut rest[0], *l, known);
            }
        }
        for i in (0..N).rev() {
            let (rest, known) = x.split_at_mut(i + 1);
            for (u, known) in self.rows[i][i + 1..].iter().zip(known) {
                subtract(&mut rest[i], *u, known);
            }
            rest[i] = rest[i].map(|x| x * self.rows[i][i]);
        }
        x
    }
}

/// Powers of two that bring rows to one after columns have been brought to one. `None` if an entry is not finite.
#[inline]
fn row_weights<const N: usize>(a: &[[f64; N]; N]) -> Option<[f64; N]> {
    let mut columns = [0.0; N];
    for row in a {
        for (sum, a) in columns.iter_mut().zip(row) {
            *sum += a.abs();
        }
    }
    if !columns.iter().sum::<f64>().is_finite() {
        return None;
    }
    let columns = columns.map(inverse_power);
    Some(a.map(|row| inverse_power(row.iter().zip(&columns).map(|(a, c)| a.abs() * c).sum())))
}

/// A power of two near 1/x, of a finite x >= 0.
#[inline]
fn inverse_power(x: f64) -> f64 {
    const EXPONENT: u64 = 0x7ff << 52;
    f64::from_bits((0x7fe << 52) - (x.to_bits() & EXPONENT))
}

/// a -= factor b
#[inline]
fn subtract<const M: usize>(a: &mut [f64; M], factor: f64, b: &[f64; M]) {
    for (a, b) in a.iter_mut().zip(b) {
        *a -= factor * b;
    }
}

/// Rows from columns.
#[inline]
fn transposed<const N: usize, const M: usize>(columns: &[[f64; N]; M]) -> [[f64; M]; N] {
    std::array::from_fn(|i| std::array::from_fn(|j| columns[j][i]))
}
