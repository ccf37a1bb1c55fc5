use super::breaks::Search;
use super::gap::{Gap, Harmonics, Lobe};
use super::panels::{Panel, Piece};
use super::rule::{SIXTEEN, TWICE_EIGHT};
use super::samples::{Memory, Samples, Table, with_memory};
use super::stretch::{Aims, DRY, Functions, OPENING, Stretch};
use crate::laws::guide::journal::tests::motion;
use crate::scalar::{Lanes, WIDEST};
use pulp::Arch;

const LAYER: f64 = 80e-6;

/// Waves of a surface up to this order, the first of which is large enough for dry parts.
fn harmonics(order: u32, rng: &mut fastrand::Rng) -> Vec<Harmonics> {
    let mut wave = |size: f64| [size * (rng.f64() - 0.5), size * (rng.f64() - 0.5)];
    let all = (1..=order).map(|n| {
        let n = f64::from(n);
        Harmonics { film: wave(250e-6 / (n * n)), opening: wave(0.1 / n), sliding: wave(0.1), still: false }
    });
    all.collect()
}

fn bent(harmonics: &[Harmonics]) -> (Gap<'_>, [Lobe; 1]) {
    let m = motion([0.0; 2], [0.0; 2], 100.0);
    let lobe = [Lobe { order: harmonics.len() as u32, ..Lobe::default() }];
    (Gap { harmonics, ..Gap::new([46e-3, 0.16e-3], &m, 0.0, [1.0, 0.0], &[]) }, lobe)
}

/// Breaks of a gap, and of which functions, with the angle of the first place.
fn breaks(gap: &Gap<'_>, aims: Aims, memory: Memory<'_>) -> Vec<(usize, f64)> {
    let mut search = Search::new(gap, LAYER, aims, Arch::new(), memory);
    let (mut stretch, mut found) = (Stretch::new(), Vec::new());
    while search.next(&mut stretch) {
        found.extend(stretch.breaks.all().iter().map(|b| (b.of, b.angle)));
    }
    found
}

#[test]
fn a_table_has_the_gap_of_each_place() {
    let mut rng = fastrand::Rng::with_seed(3);
    for order in [2, 3, 4, 5, 8, 13] {
        let harmonics = harmonics(order, &mut rng);
        let (gap, lobes) = bent(&harmonics);
        let gap = Gap { lobes: &lobes, ..gap };
        let table = Table::new(order);
        let mut rows = table.rows();
        let mut samples = Samples::new(order, Memory { rows: &mut rows, table: Some(&table) });
        let functions = Functions { gap: &gap, layer: LAYER, aims: Aims::Edges };
        samples.reach(0, &functions, Arch::new());
        let mut lowest = f64::INFINITY;
        for k in 0..=samples.count() {
            let (place, group) = (gap.at(samples.angle(k)), samples.group(k / 8));
            let (sample, signs) = (group.at(k % 8), group.signs());
            let [[h, h1], [g, g1]] = [sample.film(), sample.opening()];
            let expected = [place.film[0], place.film[1], place.opening[0], place.opening[1]];
            for (found, expected) in [h, h1, g, g1].into_iter().zip(expected) {
                assert!((found - expected).abs() < 1e-14 + 1e-12 * expected.abs(), "{order} {k}: {found}");
            }
            let negative = [(DRY, h - LAYER, h1), (OPENING, g, g1)];
            for (of, value, slope) in negative {
                assert_eq!(signs.values(of) >> (k % 8) & 1 == 1, value < 0.0, "{order} {k} {of}");
                assert_eq!(signs.slopes(of) >> (k % 8) & 1 == 1, slope < 0.0, "{order} {k} {of}");
            }
            lowest = h.min(lowest);
        }
        assert_eq!(samples.lowest(), lowest);
    }
}

#[test]
fn every_break_is_found_and_is_one() {
    let mut rng = fastrand::Rng::with_seed(5);
    let (mut of_edges, mut of_opening, mut of_excess) = (0, 0, 0);
    for i in 0..300 {
        let order = 2 + i % 7;
        let harmonics = harmonics(order, &mut rng);
        let (gap, lobes) = bent(&harmonics);
        let gap = Gap { lobes: &lobes, ..gap };
        let c = 1e10 * 100f64.powf(rng.f64());
        let aims = if i % 3 == 0 { Aims::EdgesAndExcess(c) } else { Aims::Edges };
        let table = Table::new(order);
        let mut rows = table.rows();
        let found = breaks(&gap, aims, Memory { rows: &mut rows, table: Some(&table) });
        let functions = |d: f64| {
            let place = gap.at(d);
            let (h, g) = (place.film[0], place.opening[0]);
            [h - LAYER, g, if i % 3 == 0 { g + c * h.powi(3) } else { 1.0 }]
        };
        // Where it is wet, signs on a fine grid change as often as there are breaks.
        const FINE: usize = 20_000;
        let mut expected = [0; 3];
        let step = std::f64::consts::TAU / FINE as f64;
        for j in 0..FINE {
            let [a, b] = [j, j + 1].map(|j| functions(j as f64 * step));
            for of in 0..3 {
                let wet = a[DRY] < 0.0 && b[DRY] < 0.0;
                expected[of] += usize::from((of == DRY || wet) && (a[of] < 0.0) != (b[of] < 0.0));
            }
        }
        let sizes = [1e-4, 0.1, 0.1];
        let mut counted = [0; 3];
        for (of, angle) in found {
            let wet = [0.0, 1.0].iter().all(|i| functions(((angle / step).floor() + i) * step)[DRY] < 0.0);
            // In dry parts breaks only say which sign a function has at the next edge.
            if of == DRY || wet {
                counted[of] += 1;
                let value = functions(angle)[of];
                assert!(value.abs() < 1e-12 * sizes[of], "{i}: {value} of {of} at {angle}");
            }
        }
        assert_eq!(counted, expected, "{i}");
        of_edges += counted[DRY];
        of_opening += counted[OPENING];
        of_excess += counted[2];
    }
    assert!(of_edges > 300 && of_opening > 150 && of_excess > 20, "{of_edges} {of_opening} {of_excess}");
}

#[test]
fn a_gap_has_the_same_breaks_by_its_table_by_its_lobes_and_in_parts() {
    let (mut rng, mut all) = (fastrand::Rng::with_seed(8), 0);
    for order in [2, 3, 7, 7, 8, 16, 16, 40, 60] {
        let lobes: Vec<_> = (2..=order)
            .map(|n| {
                let size = 250e-6 / f64::from(n * n);
                let height = [size * (rng.f64() - 0.5), size * (rng.f64() - 0.5)];
                Lobe { order: n, height, rate: height.map(|x| 300.0 * x) }
            })
            .collect();
        let m = motion([90e-6, 0.0], [0.02, -0.01], 100.0);
        let by_lobes = Gap::new([46e-3, 0.16e-3], &m, 90e-6, [1.0, 0.0], &lobes);
        let mut harmonics = vec![by_lobes.first_harmonic()];
        harmonics.extend(lobes.iter().map(|lobe| by_lobes.harmonic_of(lobe)));
        let thinnest = by_lobes.mean();
        let bent = Gap { harmonics: &harmonics, thinnest, eccentricity: 0.0, lobes: &lobes, ..by_lobes };
        let table = Table::new(order);
        let mut rows = table.rows();
        let tabulated = breaks(&bent, Aims::Edges, Memory { rows: &mut rows, table: Some(&table) });
        // In parts, wherever there is more than one row.
        let mut few = vec![rows[0]; 1.max(rows.len() - 1)];
        let in_parts = breaks(&by_lobes, Aims::Edges, Memory { rows: &mut few, table: None });
        let with_lobes = with_memory(order, |memory| breaks(&by_lobes, Aims::Edges, memory));
        all += tabulated.len();
        for others in [in_parts, with_lobes] {
            assert_eq!(tabulated.len(), others.len(), "{order}");
            for (a, b) in tabulated.iter().zip(&others) {
                assert!(a.0 == b.0 && (a.1 - b.1).abs() < 1e-11, "{order}: {a:?} {b:?}");
            }
        }
    }
    assert!(all > 20, "{all}");
}

#[test]
fn rules_are_exact_for_polynomials_and_see_what_does_not_suit() {
    for (rule, degree) in [(&SIXTEEN, 31), (&TWICE_EIGHT, 15)] {
        let places = (degree + 1) as usize / 2;
        for start in (0..WIDEST).step_by(places) {
            for power in 0..=degree {
                let sum: f64 =
                    (start..start + places).map(|i| rule.weights[i] * rule.nodes[i].powi(power)).sum();
                let expected = if power % 2 == 0 { 2.0 / f64::from(power + 1) } else { 0.0 };
                assert!((sum - expected).abs() < 1e-14, "{degree} {power}: {sum}");
            }
        }
        let lanes =
            |f: &dyn Fn(f64) -> f64| -> Lanes { std::array::from_fn(|i| rule.weights[i] * f(rule.nodes[i])) };
        let (smooth, kink) = (lanes(&f64::exp), lanes(&|x: f64| (x - 0.3).abs()));
        let smooth = if degree == 31 { smooth } else { lanes(&|x: f64| (0.3 * x).exp()) };
        assert_eq!(rule.suits([&smooth; 3], 0.0), [true; 2]);
        assert_eq!(rule.suits([&kink, &smooth, &smooth], 0.0), [false; 2]);
        assert_eq!(rule.suits([&smooth, &kink, &smooth], 0.0), [false; 2]);
        assert_eq!(rule.suits([&kink, &smooth, &smooth], 1.0), [true; 2]);
    }
    // Each of two parts by itself.
    let mixed: Lanes = std::array::from_fn(|i| {
        let x = TWICE_EIGHT.nodes[i];
        TWICE_EIGHT.weights[i] * if i < 8 { (0.3 * x).exp() } else { (x - 0.3).abs() }
    });
    assert_eq!(TWICE_EIGHT.suits([&mixed; 3], 0.0), [true, false]);
    let harmonics = [Harmonics::default()];
    let (gap, _) = bent(&harmonics);
    let panel = Panel::new(&gap, &Piece::STRAIGHT, [0.0, 1.0]);
    assert_eq!(panel.suit([&mixed; 3], None), [true; 2]);
}
