//! The structured linear solver against an independent dense one.

use cagedyn::integrate::linear::{Arrowhead, Factors, HUB, SPOKE};
use faer::linalg::solvers::Solve;
use nalgebra::{Complex, SMatrix, SVector};

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

    fn matrix<const R: usize, const C: usize>(&mut self) -> SMatrix<f64, R, C> {
        SMatrix::from_fn(|_, _| self.next())
    }
}

/// One right-hand side or solution.
#[derive(Clone)]
struct Vector {
    hub: SVector<f64, HUB>,
    spokes: Vec<SVector<f64, SPOKE>>,
}

impl Vector {
    fn from_fn(spokes: usize, mut f: impl FnMut(usize) -> f64) -> Self {
        let hub = SVector::from_fn(|i, _| f(i));
        let spokes = (0..spokes).map(|n| SVector::from_fn(|i, _| f(HUB + SPOKE * n + i))).collect();
        Self { hub, spokes }
    }

    fn flat(&self) -> Vec<f64> {
        self.hub.iter().chain(self.spokes.iter().flatten()).copied().collect()
    }

    fn times(&self, a: &Arrowhead) -> Self {
        let mut out = self.clone();
        a.multiply(&self.hub, &self.spokes, &mut out.hub, &mut out.spokes);
        out
    }
}

fn dominant(random: &mut Random, spokes: usize) -> Arrowhead {
    let mut a = Arrowhead::new(spokes);
    a.hub = random.matrix() + SMatrix::identity() * (HUB + SPOKE * spokes) as f64;
    for spoke in &mut a.spokes {
        // A permutation of a dominant matrix: pivots are off the diagonal.
        let own: SMatrix<f64, SPOKE, SPOKE> = random.matrix() + SMatrix::identity() * 9.0;
        let turn = (4.0 * random.next().abs()) as usize;
        spoke.own = SMatrix::from_fn(|i, j| own[((i + turn) % SPOKE, j)]);
        spoke.to_hub = random.matrix();
        spoke.from_hub = random.matrix();
    }
    a
}

/// Scales row i by `rows[i]`, column j by `columns[j]`.
fn scaled(a: &Arrowhead, rows: &Vector, columns: &Vector) -> Arrowhead {
    let mut a = a.clone();
    a.hub = SMatrix::from_diagonal(&rows.hub) * a.hub * SMatrix::from_diagonal(&columns.hub);
    for ((spoke, row), column) in a.spokes.iter_mut().zip(&rows.spokes).zip(&columns.spokes) {
        let (row, column) = (SMatrix::from_diagonal(row), SMatrix::from_diagonal(column));
        spoke.own = row * spoke.own * column;
        spoke.to_hub = SMatrix::from_diagonal(&rows.hub) * spoke.to_hub * column;
        spoke.from_hub = row * spoke.from_hub * SMatrix::from_diagonal(&columns.hub);
    }
    a
}

/// All entries, through the products with unit vectors.
fn dense(a: &Arrowhead) -> faer::Mat<f64> {
    let size = HUB + SPOKE * a.spokes.len();
    let columns: Vec<_> = (0..size)
        .map(|j| Vector::from_fn(a.spokes.len(), |i| f64::from(u8::from(i == j))).times(a).flat())
        .collect();
    faer::Mat::from_fn(size, size, |i, j| columns[j][i])
}

/// Solution and the dense matrix.
fn solved(a: &Arrowhead, b: &Vector) -> Vector {
    let mut factors = Factors::new(a.spokes.len());
    assert!(factors.factorize(a));
    let mut x = b.clone();
    factors.solve(&mut x.hub, &mut x.spokes);
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

#[test]
fn solutions_are_those_of_a_dense_solver() {
    let mut random = Random(1);
    for spokes in [0, 1, 2, 3, 5, 12, 14, 50, 200] {
        for _ in 0..if spokes > 20 { 2 } else { 20 } {
            let core = dominant(&mut random, spokes);
            let rows = Vector::from_fn(spokes, |_| random.scale());
            let columns = Vector::from_fn(spokes, |_| random.scale());
            let a = scaled(&core, &rows, &columns);
            let b = Vector::from_fn(spokes, |_| random.next());
            let right: Vec<f64> = b.flat().iter().zip(rows.flat()).map(|(b, row)| b * row).collect();
            let b_scaled = Vector::from_fn(spokes, |i| right[i]);

            let x = solved(&a, &b_scaled);
            let (x, columns) = (x.flat(), columns.flat());
            let right = faer::Mat::from_fn(x.len(), 1, |i, _| b.flat()[i]);
            let expected = dense(&core).partial_piv_lu().solve(&right);
            let largest = (0..x.len()).map(|i| expected[(i, 0)].abs()).fold(0.0, f64::max);
            for i in 0..x.len() {
                let error = (x[i] * columns[i] - expected[(i, 0)]).abs() / largest;
                assert!(error < 1e-10, "{spokes} spokes, unknown {i}: {error:e}");
            }
            let error = backward_error(&dense(&a), &x, &b_scaled.flat());
            assert!(error < 1e-13, "{spokes} spokes, residual {error:e}");
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
        let mut factors = Factors::new(n);
        for own in spokes {
            let sound = dominant(&mut random, n);
            let mut a = sound.clone();
            a.spokes[n / 2].own = SMatrix::from_fn(own);
            let b = Vector::from_fn(n, |_| random.next());
            for matrix in [&a, &sound] {
                assert!(factors.factorize(matrix));
                let mut x = b.clone();
                factors.solve(&mut x.hub, &mut x.spokes);
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
    let real = dominant(&mut random, 4);
    let mut a = Arrowhead::<Complex<f64>>::new(4);
    a.hub = real.hub.map(complex) * Complex::new(0.6, 0.8);
    for (spoke, real) in a.spokes.iter_mut().zip(&real.spokes) {
        spoke.own = real.own.map(complex) * Complex::i();
        spoke.to_hub = real.to_hub.map(complex);
        spoke.from_hub = real.from_hub.map(complex);
    }
    a.spokes[1].own.fill(complex(0.0));
    let mut factors = Factors::new(4);
    assert!(factors.factorize(&a));
    let hub = SVector::from_fn(|i, _| Complex::new(random.next(), i as f64));
    let spokes = vec![SVector::from_fn(|i, _| Complex::new(i as f64, random.next())); 4];
    let (mut x_hub, mut x_spokes) = (hub, spokes.clone());
    factors.solve(&mut x_hub, &mut x_spokes);
    let (mut back_hub, mut back_spokes) = (hub, spokes.clone());
    a.multiply(&x_hub, &x_spokes, &mut back_hub, &mut back_spokes);
    let error =
        (back_hub - hub).norm() + back_spokes.iter().zip(&spokes).map(|(a, b)| (a - b).norm()).sum::<f64>();
    assert!(error < 1e-12, "{error:e}");
}

/// I + k sum g g' with g in one spoke and the hub: inverses of the spokes lose what the hub needs.
#[test]
fn stiff_couplings_keep_small_residuals() {
    let mut random = Random(2);
    for k in [1e3, 1e6, 1e9, 1e12] {
        let spokes = 12;
        let mut a = Arrowhead::new(spokes);
        for spoke in &mut a.spokes {
            let (own, hub): (SVector<f64, SPOKE>, SVector<f64, HUB>) = (random.matrix(), random.matrix());
            spoke.own += own * own.transpose() * k;
            spoke.to_hub = hub * own.transpose() * k;
            spoke.from_hub = own * hub.transpose() * k;
            a.hub += hub * hub.transpose() * k;
        }
        let b = Vector::from_fn(spokes, |_| random.next());
        let x = solved(&a, &b).flat();
        let error = backward_error(&dense(&a), &x, &b.flat());
        assert!(error < 1e-12, "stiffness {k:e}: residual {error:e}");
    }
}

#[test]
fn products_of_solutions_are_the_right_hand_side() {
    let mut random = Random(3);
    for spokes in [0, 1, 12, 200] {
        let a = dominant(&mut random, spokes);
        let b = Vector::from_fn(spokes, |_| random.next());
        for (back, b) in solved(&a, &b).times(&a).flat().iter().zip(b.flat()) {
            assert!((back - b).abs() < 1e-13, "{back} instead of {b}");
        }
    }
}

#[test]
fn the_identity_changes_nothing() {
    let b = Vector::from_fn(3, |i| i as f64);
    let mut a = dominant(&mut Random(4), 3);
    a.fill_identity();
    assert_eq!(a, Arrowhead::new(3));
    assert_eq!(solved(&a, &b).flat(), b.flat());
    let mut x = b.clone();
    Factors::new(3).solve(&mut x.hub, &mut x.spokes);
    assert_eq!(x.flat(), b.flat());
}

#[test]
fn singular_and_undefined_matrices_are_refused() {
    let mut random = Random(5);
    let sound = dominant(&mut random, 12);
    let mut factors = Factors::new(12);
    let mut refused = |what: &str, change: &dyn Fn(&mut Arrowhead)| {
        let mut a = sound.clone();
        change(&mut a);
        assert!(!factors.factorize(&a), "{what}");
        assert!(factors.factorize(&sound), "after {what}");
    };
    refused("two spokes of zeros", &|a| {
        a.spokes[2].own.fill(0.0);
        a.spokes[7].own.fill(0.0);
    });
    refused("unknown that nothing depends on", &|a| {
        a.spokes[3].own.column_mut(1).fill(0.0);
        a.spokes[3].to_hub.column_mut(1).fill(0.0);
    });
    refused("free spoke with dependent rows", &|a| {
        a.spokes[7].own = SMatrix::from_fn(|i, j| 0.1 * (3 * i + j + 1) as f64);
        a.spokes[7].to_hub.fill(0.0);
    });
    refused("hub of zeros", &|a| {
        a.hub.fill(0.0);
        a.spokes.iter_mut().for_each(|spoke| spoke.to_hub.fill(0.0));
    });
    refused("hub that the spokes cancel", &|a| {
        a.hub.fill(0.0);
        for spoke in &a.spokes {
            a.hub += spoke.to_hub * spoke.own.try_inverse().unwrap_or_default() * spoke.from_hub;
        }
    });
    for bad in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
        refused("hub not finite", &|a| a.hub[(1, 3)] = bad);
        refused("spoke not finite", &|a| a.spokes[11].own[(2, 0)] = bad);
        refused("coupling to the hub not finite", &|a| a.spokes[0].to_hub[(4, 1)] = bad);
        refused("coupling from the hub not finite", &|a| a.spokes[5].from_hub[(1, 4)] = bad);
    }
}
