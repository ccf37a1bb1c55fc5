//! Mean whirl speed on the greased guide, over starts that differ by next to nothing.

use crate::cases::{Case, GREASE, scene};
use cagedyn::Sim;
use cagedyn_studies::cvode::{self, Derivatives, Method, Options};
use serde_json::{Value, json};

/// Mean whirl speed over the second half of 0.1 s on the greased guide.
fn whirl(state_at: &mut dyn FnMut(usize) -> Vec<f64>, sim: &mut Sim) -> f64 {
    let channel = sim.channels().iter().position(|c| c.name == "cage.whirl_speed").expect("a whirl speed");
    let speeds: Vec<f64> = (500..=1000)
        .map(|i| {
            sim.set_state(i as f64 * 1e-4, &state_at(i)).expect("a state");
            sim.output(channel).expect("an output")
        })
        .collect();
    speeds.iter().sum::<f64>() / speeds.len() as f64
}

/// Mean of some figures and the variance of that mean.
pub fn mean(figures: &[f64]) -> (f64, f64) {
    let n = figures.len() as f64;
    let mean = figures.iter().sum::<f64>() / n;
    (mean, figures.iter().map(|x| (x - mean).powi(2)).sum::<f64>() / (n - 1.0) / n)
}

/// Starts of the whirl runs: the first element turned by so many mrad.
const STARTS: u32 = 6;
/// Student's t that a difference of two such means stays below with a probability of 99.9 %.
const STUDENT: f64 = 4.587;

/// Error of a method of second order in units of what half the step changes.
const SECOND_ORDER: f64 = 4.0 / 3.0;

/// The whirl of one method from all starts.
pub struct Whirl {
    pub name: &'static str,
    pub figures: Vec<f64>,
    /// Place of a finer run of the method, and error of this one in units of the difference between them.
    finer: Option<(usize, f64)>,
}

pub fn whirls() -> Vec<Whirl> {
    let turned = |k: u32| {
        let angle = [("initial.first_roller_angle", json!(f64::from(k) * 1e-3))];
        let scene = scene(GREASE, &angle);
        Case { name: "whirl", scene, duration: 0.1, reference_step: 1e-5, max_step: 1e-4 }
    };
    let own = |solver: Value| -> Vec<f64> {
        let run = |k| {
            let mut runs = turned(k).sim(&solver);
            let mut at = |i: usize| {
                runs.advance_to(i as f64 * 1e-4).expect("a run");
                runs.state().to_vec()
            };
            whirl(&mut at, &mut turned(k).sim(&json!({})))
        };
        (0..STARTS).map(run).collect()
    };
    let cvode = |k| {
        let case = turned(k);
        let mut sim = case.sim(&json!({}));
        let absolute: Vec<f64> = sim.model().state_scales().iter().map(|s| 1e-8 * s).collect();
        let options = Options {
            method: Method::Bdf,
            relative: 1e-8,
            absolute: &absolute,
            max_steps: 1_000_000,
            max_step: case.reference_step,
        };
        let times: Vec<f64> = (1..=1000).map(|i| f64::from(i) * 1e-4).collect();
        let start = sim.state().to_vec();
        let mut rates = |t: f64, x: &[f64], rate: &mut [f64]| sim.derivative(t, x, rate).map_err(|_| ());
        let solution =
            cvode::solve(&options, 0.0, &start, &times, &mut rates, Derivatives::Quotients).expect("a run");
        whirl(&mut |i| solution.states[i - 1].clone(), &mut sim)
    };
    let step = turned(0).sim(&json!({"method": {"leapfrog": {}}})).nominal_step();
    let leapfrog = |share: f64| own(json!({"method": {"leapfrog": {"step": step / share}}}));
    let controlled = |method: &str| own(json!({"method": {method: {"tolerance": 1e-8}}}));
    let entry = |name, figures, finer| Whirl { name, figures, finer };
    // Halving the step of a method of second order leaves a quarter of its error. A hundredth of the tolerance makes it
    // ten times less even where kinks leave only the root.
    vec![
        entry("CVODE, 1e-8", (0..STARTS).map(cvode).collect(), None),
        entry("leapfrog", leapfrog(1.0), Some((2, SECOND_ORDER))),
        entry("leapfrog, half the step", leapfrog(2.0), Some((3, SECOND_ORDER))),
        entry("leapfrog, quarter of the step", leapfrog(4.0), None),
        entry("Dormand-Prince, 1e-8", controlled("dormand_prince"), None),
        entry("Rosenbrock, 1e-8", controlled("rosenbrock"), None),
        entry("auto, 1e-8", controlled("auto"), None),
        entry("auto", own(json!({})), Some((6, 1.0 / 0.9))),
    ]
}

/// The whirl is steady, so its scatter is small, and the error of a coarse step or tolerance shows. A finer run tells how
/// large it may be.
#[test]
fn mean_whirl_does_not_depend_on_the_integrator() {
    let all = whirls();
    let (reference, variance) = mean(&all[0].figures);
    for run in all.iter().skip(1).filter(|run| !run.name.contains("quarter")) {
        let (found, own) = mean(&run.figures);
        let scatter = STUDENT * (variance + own).sqrt();
        let coarse = run.finer.map_or(0.0, |(k, ratio)| ratio * (found - mean(&all[k].figures).0).abs());
        println!(
            "{}: {found:.2} rad/s, CVODE {reference:.2} +- {scatter:.2} +- {coarse:.2}: {:.2?}",
            run.name, run.figures
        );
        assert!((found - reference).abs() < scatter + coarse, "{}: {found}, CVODE {reference}", run.name);
        assert!(scatter + coarse < 3e-3 * reference.abs(), "{}: {scatter} + {coarse} says nothing", run.name);
    }
}
