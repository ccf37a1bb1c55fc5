//! Cost of the structured linear solver over the number of spokes, beside a dense one.
//!
//! Compare numbers of one run only: machines differ and drift.

use cagedyn::integrate::linear::{Arrowhead, Factors, HUB, SPOKE};
use criterion::{Criterion, criterion_group, criterion_main};
use faer::linalg::solvers::Solve;
use nalgebra::{SMatrix, SVector};
use std::hint::black_box;

/// Diagonally dominant, with the entries of a fixed pattern.
fn matrix(spokes: usize) -> Arrowhead {
    let entry = |i: usize, j: usize| ((7 * i + 3 * j) as f64).sin();
    let mut a = Arrowhead::new(spokes);
    a.hub = SMatrix::from_fn(entry) + SMatrix::identity() * (10.0 + 3.0 * spokes as f64);
    for (n, spoke) in a.spokes.iter_mut().enumerate() {
        spoke.own = SMatrix::from_fn(|i, j| entry(i + n, j)) + SMatrix::identity() * 10.0;
        spoke.to_hub = SMatrix::from_fn(|i, j| entry(i, j + n));
        spoke.from_hub = SMatrix::from_fn(|i, j| entry(i + n, j + n));
    }
    a
}

fn dense(a: &Arrowhead) -> faer::Mat<f64> {
    let size = HUB + SPOKE * a.spokes.len();
    faer::Mat::from_fn(size, size, |i, j| {
        let spoke = |k: usize| k.checked_sub(HUB).map(|k| (k / SPOKE, k % SPOKE));
        match (spoke(i), spoke(j)) {
            (None, None) => a.hub[(i, j)],
            (None, Some((n, j))) => a.spokes[n].to_hub[(i, j)],
            (Some((n, i)), None) => a.spokes[n].from_hub[(i, j)],
            (Some((n, i)), Some((m, j))) if n == m => a.spokes[n].own[(i, j)],
            _ => 0.0,
        }
    })
}

fn benches(c: &mut Criterion) {
    for spokes in [1, 12, 50, 200] {
        let a = matrix(spokes);
        let mut factors = Factors::new(spokes);
        c.bench_function(&format!("{spokes} spokes/factorize"), |b| {
            b.iter(|| factors.factorize(black_box(&a)));
        });
        let (b_hub, b_spokes) = (SVector::repeat(1.0), vec![SVector::repeat(1.0); spokes]);
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

criterion_group!(linear, benches);
criterion_main!(linear);
