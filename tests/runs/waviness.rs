//! Waves of raceways and rollers make the lines of textbooks, and nothing else.

use cagedyn_studies::waves::{AMPLITUDE, amplitude, highest, preloaded, run, textbook, waves};

/// Length of the runs, s, and the highest frequency that is looked at, Hz.
const DURATION: f64 = 0.1;
const HIGHEST: f64 = 1000.0;

#[test]
fn orders_make_the_lines_of_textbooks() {
    let round = run(preloaded(&Vec::new()).unwrap(), DURATION).unwrap();
    for (body, order, height) in [
        ("inner ring", 11, 0.9),
        ("inner ring", 13, 0.9),
        ("inner ring", 12, 0.0),
        ("outer ring", 25, 0.9),
        ("outer ring", 12, 0.0),
        ("one roller", 2, 0.15),
        ("one roller", 3, 0.0),
    ] {
        let run = run(preloaded(&waves(body, order)).unwrap(), DURATION).unwrap();
        let expected = textbook(body, order, run.turns, 12);
        let found = highest(&run.ring, HIGHEST, expected.len() + 1);
        println!("{body} {order}: {expected:?}, found {found:?}");
        for line in &expected {
            let [_, size] =
                found.iter().find(|[at, _]| (at - line).abs() <= 0.75 / DURATION).expect("the line");
            assert!((height..=1.01).contains(&(size / AMPLITUDE)), "{body} {order}: {size}");
            // The cage feels it through the films of pockets and guide.
            let [with, without] = [&run, &round].map(|run| amplitude(&run.cage, *line));
            assert!(
                with > 0.05 * AMPLITUDE && without < 1e-3 * AMPLITUDE,
                "{body} {order}: {with} {without}"
            );
        }
        // What else there is: leakage of the window and of a speed that varies.
        let [_, next] = found[expected.len()];
        let allowed = if expected.is_empty() { 5e-4 } else { 0.03 };
        assert!(next < allowed * AMPLITUDE, "{body} {order}: {next}");
    }
}
