//! The structured linear solver against an independent dense one.

use cagedyn::integrate::linear::{Arrowhead, Factors};
use faer::linalg::solvers::Solve;
use nalgebra::{Complex, DMatrix, DVector, SMatrix, SVector};

/// Unknowns of the hub and of a spoke that most tests are made with.
const HUB: usize = 5;
const SPOKE: usize = 3;

/// Repeatable numbers in -1..1 (splitmix64).
struct Random(u64);

impl Random {
    fn next(&mut self) -> f64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let z = (self.0 ^ (self.0 >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        let z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        ((z ^ (z >> 31)) >> 11) as f64 / f64::from(1 << 26) / f64::from(1 << 26) - 1.0
    }

    /// 1e-6..1e6
    fn scale(&mut self) -> f64 {
        10f64.powf(6.0 * self.next())
    }

    fn matrix(&mut self, rows: usize, columns: usize) -> DMatrix<f64> {
        DMatrix::from_fn(rows, columns, |_, _| self.next())
    }

    fn square<const N: usize>(&mut self) -> SMatrix<f64, N, N> {
        SMatrix::from_fn(|_, _| self.next())
    }
}

/// One right-hand side or solution, with spokes of `N` unknowns.
#[derive(Clone)]
struct Vector<const N: usize> {
    hub: DVector<f64>,
    spokes: Vec<SVector<f64, N>>,
}

impl<const N: usize> Vector<N> {
    fn from_fn([hub, spokes]: [usize; 2], mut f: impl FnMut(usize) -> f64) -> Self {
        let spokes = (0..spokes).map(|n| SVector::from_fn(|i, _| f(hub + N * n + i)));
        let spokes = spokes.collect();
        Self { hub: DVector::from_fn(hub, |i, _| f(i)), spokes }
    }

    fn flat(&self) -> Vec<f64> {
        self.hub.iter().chain(self.spokes.iter().flatten()).copied().collect()
    }

    fn times(&self, a: &Arrowhead<f64, N>) -> Self {
        let mut out = self.clone();
        a.multiply(self.hub.as_slice(), &self.spokes, out.hub.as_mut_slice(), &mut out.spokes);
        out
    }

    fn solve(&mut self, factors: &mut Factors<f64, N>) {
        factors.solve(self.hub.as_mut_slice(), &mut self.spokes);
    }
}

fn dominant<const N: usize>(random: &mut Random, [hub, spokes]: [usize; 2]) -> Arrowhead<f64, N> {
    let mut a = Arrowhead::new(hub, spokes);
    a.hub = random.matrix(hub, hub) + DMatrix::identity(hub, hub) * (hub + N * spokes) as f64;
    for j in 0..spokes {
        // A permutation of a dominant matrix: pivots are off the diagonal.
        let own: SMatrix<f64, N, N> = random.square() + SMatrix::identity() * 9.0;
        let turn = (4.0 * random.next().abs()) as usize;
        set_own(&mut a, j, |i, k| own[((i + turn) % N, k)]);
    }
    a.to_hub.iter_mut().chain(a.from_hub.iter_mut()).for_each(|x| *x = random.next());
    a
}

/// Sets the rows and columns of spoke `j`.
fn set_own<const N: usize>(a: &mut Arrowhead<f64, N>, j: usize, f: impl Fn(usize, usize) -> f64) {
    a.own.columns_mut(N * j, N).copy_from(&SMatrix::<f64, N, N>::from_fn(f));
}

/// Scales row i by `rows[i]`, column j by `columns[j]`.
fn scaled<const N: usize>(a: &Arrowhead<f64, N>, rows: &Vector<N>, columns: &Vector<N>) -> Arrowhead<f64, N> {
    let mut a = a.clone();
    let [row, column] = [rows, columns].map(|x| DMatrix::from_diagonal(&x.hub));
    a.hub = &row * a.hub * &column;
    for (j, (own_row, own_column)) in rows.spokes.iter().zip(&columns.spokes).enumerate() {
        let (own_row, own_column) = (SMatrix::from_diagonal(own_row), SMatrix::from_diagonal(own_column));
        let (at, from) = (N * j, sizes(&a)[0]);
        let own = own_row * a.own.columns(at, N) * own_column;
        let to_hub = &row * a.to_hub.columns(at, N) * own_column;
        let from_hub = own_row * a.from_hub.columns(from * j, from) * &column;
        a.own.columns_mut(at, N).copy_from(&own);
        a.to_hub.columns_mut(at, N).copy_from(&to_hub);
        a.from_hub.columns_mut(from * j, from).copy_from(&from_hub);
    }
    a
}

/// Unknowns of the hub, and number of spokes.
fn sizes<const N: usize>(a: &Arrowhead<f64, N>) -> [usize; 2] {
    [a.width(), a.spokes()]
}

/// All entries, through the products with unit vectors.
fn dense<const N: usize>(a: &Arrowhead<f64, N>) -> faer::Mat<f64> {
    let size = a.width() + N * a.spokes();
    let unit = |j: usize| Vector::from_fn(sizes(a), |i| f64::from(u8::from(i == j)));
    let columns: Vec<_> = (0..size).map(|j| unit(j).times(a).flat()).collect();
    faer::Mat::from_fn(size, size, |i, j| columns[j][i])
}

/// The solution.
fn solved<const N: usize>(a: &Arrowhead<f64, N>, b: &Vector<N>) -> Vector<N> {
    let mut factors = Factors::new(a.width(), a.spokes());
    assert!(factors.factorize(a));
    let mut x = b.clone();
    x.solve(&mut factors);
    x
}

/// Largest |A x - b| in units of |A| |x| + |b|, over the rows.
fn backward_error(matrix: &faer::Mat<f64>, x: &[f64], b: &[f64]) -> f64 {
    let row = |i: usize| {
        let terms = (0..x.len()).map(|j| matrix[(i, j)] * x[j]);
        let size = terms.clone().map(f64::abs).sum::<f64>() + b[i].abs();
        (terms.sum::<f64>() - b[i]).abs() / size
    };
    (0..x.len()).map(row).fold(0.0, f64::max)
}

fn compare_with_dense<const N: usize>(random: &mut Random, sizes: [usize; 2]) {
    let core = dominant::<N>(random, sizes);
    let rows = Vector::<N>::from_fn(sizes, |_| random.scale());
    let columns = Vector::from_fn(sizes, |_| random.scale());
    let a = scaled(&core, &rows, &columns);
    let b = Vector::<N>::from_fn(sizes, |_| random.next());
    let right: Vec<f64> = b.flat().iter().zip(rows.flat()).map(|(b, row)| b * row).collect();
    let b_scaled = Vector::from_fn(sizes, |i| right[i]);

    let (x, columns) = (solved(&a, &b_scaled).flat(), columns.flat());
    let right = faer::Mat::from_fn(x.len(), 1, |i, _| b.flat()[i]);
    let expected = dense(&core).partial_piv_lu().solve(&right);
    let largest = (0..x.len()).map(|i| expected[(i, 0)].abs()).fold(0.0, f64::max);
    for i in 0..x.len() {
        let error = (x[i] * columns[i] - expected[(i, 0)]).abs() / largest;
        assert!(error < 1e-10, "{sizes:?} of {N}, unknown {i}: {error:e}");
    }
    let error = backward_error(&dense(&a), &x, &b_scaled.flat());
    assert!(error < 1e-13, "{sizes:?} of {N}, residual {error:e}");
}

#[test]
fn solutions_are_those_of_a_dense_solver() {
    let mut random = Random(1);
    for spokes in [0, 1, 2, 3, 5, 12, 14, 50, 200] {
        for _ in 0..if spokes > 20 { 2 } else { 20 } {
            compare_with_dense::<SPOKE>(&mut random, [HUB, spokes]);
        }
    }
    // Without a hub, of a ring or a cage alone, of a cage with modes; elements in space.
    for hub in [0, 2, 3, 9, 29] {
        for spokes in [1, 12] {
            compare_with_dense::<SPOKE>(&mut random, [hub, spokes]);
            compare_with_dense::<1>(&mut random, [hub, spokes]);
            compare_with_dense::<6>(&mut random, [hub, spokes]);
        }
    }
}

/// Elimination by blocks stops at such a spoke.
#[test]
fn singular_spokes_in_regular_matrices_are_solved() {
    let mut random = Random(6);
    let scales = [1e-6, 1.0, 1e9];
    let spokes: [&dyn Fn(usize, usize) -> f64; 3] =
        [&|_, _| 0.0, &|i, j| 0.1 * (3 * i + j + 1) as f64, &|i, j| {
            0.1 * (3 * i + j + 1) as f64 * scales[i] / scales[j]
        }];
    for n in [1, 12, 60] {
        let mut factors = Factors::new(HUB, n);
        for own in spokes {
            let sound = dominant::<SPOKE>(&mut random, [HUB, n]);
            let mut a = sound.clone();
            set_own(&mut a, n / 2, own);
            let b = Vector::from_fn([HUB, n], |_| random.next());
            for matrix in [&a, &sound] {
                assert!(factors.factorize(matrix));
                let mut x = b.clone();
                x.solve(&mut factors);
                let error = backward_error(&dense(matrix), &x.flat(), &b.flat());
                assert!(error < 1e-13, "{n} spokes, residual {error:e}");
            }
        }
    }
}

#[test]
fn singular_complex_spokes_are_solved() {
    let complex = |x: f64| Complex::new(x, 0.0);
    let mut random = Random(7);
    let real = dominant::<SPOKE>(&mut random, [HUB, 4]);
    let mut a = Arrowhead::<Complex<f64>, SPOKE>::new(HUB, 4);
    a.hub = real.hub.map(complex) * Complex::new(0.6, 0.8);
    a.own = real.own.map(complex) * Complex::i();
    a.to_hub = real.to_hub.map(complex);
    a.from_hub = real.from_hub.map(complex);
    a.own.columns_mut(SPOKE, SPOKE).fill(complex(0.0));
    let mut factors = Factors::new(HUB, 4);
    assert!(factors.factorize(&a));
    let hub = [(); HUB].map(|()| Complex::new(random.next(), 0.5));
    let spokes = vec![SVector::from_fn(|i, _| Complex::new(i as f64, random.next())); 4];
    let (mut x_hub, mut x_spokes) = (hub, spokes.clone());
    factors.solve(&mut x_hub, &mut x_spokes);
    let (mut back_hub, mut back_spokes) = (hub, spokes.clone());
    a.multiply(&x_hub, &x_spokes, &mut back_hub, &mut back_spokes);
    let in_hub: f64 = back_hub.iter().zip(&hub).map(|(a, b)| (a - b).norm()).sum();
    let error = in_hub + back_spokes.iter().zip(&spokes).map(|(a, b)| (a - b).norm()).sum::<f64>();
    assert!(error < 1e-12, "{error:e}");
}

/// I + k sum g g' with g in one spoke and the hub: inverses of the spokes lose what the hub needs.
#[test]
fn stiff_couplings_keep_small_residuals() {
    let mut random = Random(2);
    for k in [1e3, 1e6, 1e9, 1e12] {
        let spokes = 12;
        let mut a = Arrowhead::<f64, SPOKE>::new(HUB, spokes);
        for j in 0..spokes {
            let (own, hub) = (random.matrix(SPOKE, 1), random.matrix(HUB, 1));
            let mut block = a.own.columns_mut(SPOKE * j, SPOKE);
            block += &own * own.transpose() * k;
            a.to_hub.columns_mut(SPOKE * j, SPOKE).copy_from(&(&hub * own.transpose() * k));
            a.from_hub.columns_mut(HUB * j, HUB).copy_from(&(own * hub.transpose() * k));
            a.hub += &hub * hub.transpose() * k;
        }
        let b = Vector::from_fn([HUB, spokes], |_| random.next());
        let x = solved(&a, &b).flat();
        let error = backward_error(&dense(&a), &x, &b.flat());
        assert!(error < 1e-12, "stiffness {k:e}: residual {error:e}");
    }
}

#[test]
fn products_of_solutions_are_the_right_hand_side() {
    let mut random = Random(3);
    for spokes in [0, 1, 12, 200] {
        let a = dominant::<SPOKE>(&mut random, [HUB, spokes]);
        let b = Vector::from_fn([HUB, spokes], |_| random.next());
        for (back, b) in solved(&a, &b).times(&a).flat().iter().zip(b.flat()) {
            assert!((back - b).abs() < 1e-13, "{back} instead of {b}");
        }
    }
}

#[test]
fn the_identity_changes_nothing() {
    let b = Vector::from_fn([HUB, 3], |i| i as f64);
    let mut a = dominant::<SPOKE>(&mut Random(4), [HUB, 3]);
    a.fill_identity();
    assert_eq!(a, Arrowhead::new(HUB, 3));
    assert_eq!(solved(&a, &b).flat(), b.flat());
    let mut x = b.clone();
    x.solve(&mut Factors::new(HUB, 3));
    assert_eq!(x.flat(), b.flat());
}

#[test]
fn singular_and_undefined_matrices_are_refused() {
    let mut random = Random(5);
    let sound = dominant::<SPOKE>(&mut random, [HUB, 12]);
    let mut factors = Factors::new(HUB, 12);
    let mut refused = |what: &str, change: &dyn Fn(&mut Arrowhead<f64, SPOKE>)| {
        let mut a = sound.clone();
        change(&mut a);
        assert!(!factors.factorize(&a), "{what}");
        assert!(factors.factorize(&sound), "after {what}");
    };
    refused("two spokes of zeros", &|a| {
        a.own.columns_mut(2 * SPOKE, SPOKE).fill(0.0);
        a.own.columns_mut(7 * SPOKE, SPOKE).fill(0.0);
    });
    refused("unknown that nothing depends on", &|a| {
        a.own.column_mut(3 * SPOKE + 1).fill(0.0);
        a.to_hub.column_mut(3 * SPOKE + 1).fill(0.0);
    });
    refused("free spoke with dependent rows", &|a| {
        set_own(a, 7, |i, j| 0.1 * (3 * i + j + 1) as f64);
        a.to_hub.columns_mut(7 * SPOKE, SPOKE).fill(0.0);
    });
    refused("hub of zeros", &|a| {
        a.hub.fill(0.0);
        a.to_hub.fill(0.0);
    });
    refused("hub that the spokes cancel", &|a| {
        a.hub.fill(0.0);
        for j in 0..a.spokes() {
            let own: SMatrix<f64, SPOKE, SPOKE> = a.own.fixed_columns::<SPOKE>(SPOKE * j).into_owned();
            let (to_hub, from_hub) = (a.to_hub.columns(SPOKE * j, SPOKE), a.from_hub.columns(HUB * j, HUB));
            a.hub += to_hub * own.try_inverse().unwrap_or_default() * from_hub;
        }
    });
    for bad in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
        refused("hub not finite", &|a| a.hub[(1, 3)] = bad);
        refused("spoke not finite", &|a| a.own[(2, 11 * SPOKE)] = bad);
        refused("coupling to the hub not finite", &|a| a.to_hub[(4, 1)] = bad);
        refused("coupling from the hub not finite", &|a| a.from_hub[(1, 5 * HUB + 4)] = bad);
    }
}
