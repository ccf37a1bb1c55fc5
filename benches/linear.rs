//! Cost of the structured linear solver over the number of spokes, beside a dense one; cost and errors of dense decompositions and
//! eigenvalues of nalgebra, which the library has, and of faer.
//!
//! Compare numbers of one run only: machines differ and drift.

use cagedyn::integrate::linear;
use criterion::{Criterion, criterion_group, criterion_main};
use faer::linalg::solvers::Solve;
use nalgebra::{DMatrix, SMatrix, SVector};
use std::hint::black_box;

/// Unknowns of a ring and a cage, and of a roller.
const HUB: usize = 5;
const SPOKE: usize = 3;
type Arrowhead = linear::Arrowhead<f64, SPOKE>;
type Factors = linear::Factors<f64, SPOKE>;

/// Diagonally dominant, with the entries of a fixed pattern.
fn matrix(spokes: usize) -> Arrowhead {
    let entry = |i: usize, j: usize| ((7 * i + 3 * j) as f64).sin();
    let mut a = Arrowhead::new(HUB, spokes);
    a.hub = DMatrix::from_fn(HUB, HUB, entry) + DMatrix::identity(HUB, HUB) * (10.0 + 3.0 * spokes as f64);
    for n in 0..spokes {
        let own = SMatrix::<f64, SPOKE, SPOKE>::from_fn(|i, j| entry(i + n, j)) + SMatrix::identity() * 10.0;
        a.own.columns_mut(SPOKE * n, SPOKE).copy_from(&own);
        a.to_hub
            .columns_mut(SPOKE * n, SPOKE)
            .copy_from(&DMatrix::from_fn(HUB, SPOKE, |i, j| entry(i, j + n)));
        a.from_hub
            .columns_mut(HUB * n, HUB)
            .copy_from(&DMatrix::from_fn(SPOKE, HUB, |i, j| entry(i + n, j + n)));
    }
    a
}

fn dense(a: &Arrowhead) -> faer::Mat<f64> {
    let size = HUB + SPOKE * a.spokes();
    faer::Mat::from_fn(size, size, |i, j| {
        let spoke = |k: usize| k.checked_sub(HUB).map(|k| (k / SPOKE, k % SPOKE));
        match (spoke(i), spoke(j)) {
            (None, None) => a.hub[(i, j)],
            (None, Some((n, j))) => a.to_hub[(i, SPOKE * n + j)],
            (Some((n, i)), None) => a.from_hub[(i, HUB * n + j)],
            (Some((n, i)), Some((m, j))) if n == m => a.own[(i, SPOKE * n + j)],
            _ => 0.0,
        }
    })
}

fn benches(c: &mut Criterion) {
    for spokes in [1, 12, 50, 200] {
        let a = matrix(spokes);
        let mut factors = Factors::new(HUB, spokes);
        c.bench_function(&format!("{spokes} spokes/factorize"), |b| {
            b.iter(|| factors.factorize(black_box(&a)));
        });
        let (b_hub, b_spokes) = ([1.0; HUB], vec![SVector::repeat(1.0); spokes]);
        let mut x_spokes = b_spokes.clone();
        c.bench_function(&format!("{spokes} spokes/solve"), |b| {
            b.iter(|| {
                let mut x_hub = black_box(b_hub);
                x_spokes.copy_from_slice(&b_spokes);
                factors.solve(&mut x_hub, black_box(&mut x_spokes));
                x_hub
            });
        });
        let full = dense(&a);
        c.bench_function(&format!("{spokes} spokes/dense factorize"), |b| {
            b.iter(|| black_box(&full).partial_piv_lu());
        });
        let lu = full.partial_piv_lu();
        let right = faer::Mat::from_fn(full.nrows(), 1, |_, _| 1.0);
        c.bench_function(&format!("{spokes} spokes/dense solve"), |b| {
            b.iter(|| lu.solve(black_box(&right)));
        });
    }
}

/// Unknowns of a heat balance, of a whirl of a stiff and of an elastic cage, and of a bearing full of rollers.
const DENSE: [usize; 4] = [4, 5, 17, 55];

/// Nearly singular and not symmetric, as matrices of whirls are.
fn uneven(n: usize) -> DMatrix<f64> {
    DMatrix::from_fn(n, n, |i, j| ((7 * i + 3 * j * j) as f64).sin() * 10f64.powi((i % 4) as i32))
}

fn libraries(c: &mut Criterion) {
    for n in DENSE {
        let a = uneven(n);
        let b = faer::Mat::from_fn(n, n, |i, j| a[(i, j)]);
        let (right, ones) = (DMatrix::repeat(n, 1, 1.0), faer::Mat::<f64>::from_fn(n, 1, |_, _| 1.0));
        let [x, y] = [a.clone().lu().solve(&right).unwrap(), {
            let x = b.partial_piv_lu().solve(&ones);
            DMatrix::from_fn(n, 1, |i, _| x[(i, 0)])
        }]
        .map(|x| (&a * &x - &right).amax() / (a.amax() * x.amax()));
        // Their sum is the trace.
        let nalgebra: f64 = a.complex_eigenvalues().iter().map(|value| value.re).sum();
        let faer: f64 = b.eigenvalues().unwrap().iter().map(|value| value.re).sum();
        let [of_nalgebra, of_faer] = [nalgebra, faer].map(|sum| (sum - a.trace()).abs() / a.amax());
        println!("{n} unknowns, LU residual: nalgebra {x:.1e}, faer {y:.1e}");
        println!("{n} unknowns, sum of eigenvalues: nalgebra {of_nalgebra:.1e}, faer {of_faer:.1e}");
        c.bench_function(&format!("{n} unknowns/LU and solution, nalgebra"), |bench| {
            bench.iter(|| black_box(&a).clone().lu().solve(&right));
        });
        c.bench_function(&format!("{n} unknowns/LU and solution, faer"), |bench| {
            bench.iter(|| black_box(&b).partial_piv_lu().solve(&ones));
        });
        c.bench_function(&format!("{n} unknowns/eigenvalues, nalgebra"), |bench| {
            bench.iter(|| black_box(&a).complex_eigenvalues());
        });
        c.bench_function(&format!("{n} unknowns/eigenvalues, faer"), |bench| {
            bench.iter(|| black_box(&b).eigenvalues());
        });
    }
}

criterion_group!(linear, benches, libraries);
criterion_main!(linear);
