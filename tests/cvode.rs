//! The library's methods against CVODE of SUNDIALS, which integrates [`Sim::derivative`]. Errors are differences of
//! positions in units of the guide clearance. What is found is told in `docs/verification.md`.

mod common;
#[path = "common/cvode.rs"]
mod cvode;

use cagedyn::integrate::{DampingBlock, DormandPrince, Driver, Limits, Linearization, Structure, System};
use cagedyn::{Model, Sim};
use common::{example, read, repository, with};
use cvode::{Method, Options};
use serde_json::{Value, json};
use std::sync::Arc;

/// Largest step of methods with error control in the library, s; CVODE gets the same where it is compared with them.
const MAX_STEP: f64 = 1e-4;

/// A scene and how long it is followed.
struct Case {
    name: &'static str,
    scene: Value,
    duration: f64,
    /// Largest step of the reference, s: short enough to meet every contact.
    reference_step: f64,
}

/// The end of a reference run, and how far another method of CVODE ends from it.
struct Reference {
    end: End,
    doubt: f64,
}

/// Where a run ended and what it took.
#[derive(Clone, Debug)]
struct End {
    state: Vec<f64>,
    steps: u64,
    evaluations: u64,
}

impl Case {
    fn sim(&self, solver: &Value) -> Sim {
        let scene = with(&self.scene, &[("solver", solver.clone())]);
        let model = Model::from_json(&scene.to_string()).unwrap_or_else(|e| panic!("{}: {e}", self.name));
        Sim::new(Arc::new(model)).unwrap_or_else(|e| panic!("{}: {e}", self.name))
    }

    fn run(&self, solver: &Value) -> End {
        let mut sim = self.sim(solver);
        sim.advance_to(self.duration).unwrap_or_else(|e| panic!("{}: {e}", self.name));
        let statistics = sim.statistics();
        End {
            state: sim.state().to_vec(),
            steps: statistics.driver.steps,
            evaluations: statistics.evaluations,
        }
    }

    fn dormand_prince(&self, tolerance: f64) -> End {
        self.run(&json!({"method": {"dormand_prince": {"tolerance": tolerance}}}))
    }

    fn leapfrog(&self, step: f64) -> End {
        self.run(&json!({"method": {"leapfrog": {"step": step}}}))
    }

    /// CVODE with `absolute` in units of the scene's state scales.
    fn cvode(&self, method: Method, relative: f64, absolute: f64, max_step: f64) -> End {
        let mut sim = self.sim(&json!({}));
        let scales: Vec<f64> = sim.model().state_scales().iter().map(|s| absolute * s).collect();
        let start = sim.state().to_vec();
        let options = Options { method, relative, absolute: &scales, max_steps: 10_000_000, max_step };
        let mut rates = |t: f64, x: &[f64], rate: &mut [f64]| sim.derivative(t, x, rate).map_err(|_| ());
        let solution = cvode::solve(&options, 0.0, &start, &[self.duration], &mut rates, None)
            .unwrap_or_else(|e| panic!("{}, {method:?} at {relative:e}, {absolute:e}: {e}", self.name));
        let statistics = solution.statistics;
        End {
            state: solution.states[0].clone(),
            steps: statistics.steps,
            evaluations: statistics.evaluations,
        }
    }

    fn reference(&self) -> Reference {
        let [end, other] =
            [Method::Bdf, Method::Adams].map(|m| self.cvode(m, 1e-12, 1e-12, self.reference_step));
        Reference { doubt: self.distance(&other, &end), end }
    }

    /// Largest difference of positions in units of the reference clearance; angles count as arcs of the pitch circle.
    fn distance(&self, a: &End, b: &End) -> f64 {
        let sim = self.sim(&json!({}));
        let scales = sim.model().state_scales();
        let positions = sim.model().layout().positions();
        (0..positions).map(|i| (a.state[i] - b.state[i]).abs() / scales[i]).fold(0.0, f64::max)
    }
}

fn short(figures: &[f64]) -> String {
    figures.iter().map(|x| format!("{x:.1e}")).collect::<Vec<_>>().join(" ")
}

fn scene(file: &str, changes: &[(&str, Value)]) -> Value {
    let scene: Value = serde_json::from_str(&read(file)).expect("a scene");
    with(&scene, changes)
}

const BALL: &str = "scenes/ball_short_bearing.json";
const DRY: &str = "dry guide";
const GREASE: &str = "scenes/grease_guide.json";

/// The cage on its film alone: nothing touches, forces have all the derivatives that the methods need.
fn smooth() -> Vec<Case> {
    let start = json!({
        "cage": {"y": 0.08e-3, "z": -0.05e-3}, "cage_velocity": {"y": 0.02, "z": 0.03}, "cage_speed": 142.5
    });
    let oil = |more: &[(&str, Value)]| {
        let alone = scene(BALL, &[("cage.pocket", Value::Null), ("initial", start.clone())]);
        with(&alone, more)
    };
    let unbalance = [("cage.mass_eccentricity", json!({"y": 50e-6, "z": -20e-6}))];
    let flooded = [
        ("cage.pocket", Value::Null),
        ("cage.guide.solid", Value::Null),
        ("cage.guide.film_share", Value::Null),
        ("cage.guide.film.lubricant_layer.thickness", json!(0.5e-3)),
        ("initial", start.clone()),
    ];
    let case = |name, scene| Case { name, scene, duration: 5e-3, reference_step: 2.5e-6 };
    vec![
        case("short bearing", oil(&[])),
        case("short bearing, unbalance", oil(&unbalance)),
        case("flooded guide", scene(GREASE, &flooded)),
    ]
}

/// A cage that is always pressed onto the spring of its guide and slides there to and fro: smooth, and without any
/// damping. A decay that is fast against the steps would hide the order of the error.
fn pressed() -> Case {
    let start = json!({"cage": {"y": 30e-6, "z": -0.22e-3}});
    let changes = [
        ("gravity.z", json!(-981.0)),
        ("cage.pocket", Value::Null),
        ("cage.guide.film", Value::Null),
        ("cage.guide.film_share", Value::Null),
        ("cage.guide.solid", json!({"contact": {"stiffness": 1e6}})),
        ("initial", start),
    ];
    Case { name: "pressed", scene: scene(GREASE, &changes), duration: 5e-3, reference_step: f64::INFINITY }
}

/// Contacts open and close: forces have kinks in their derivatives.
fn contacts() -> Vec<Case> {
    let falling =
        json!({"cage": {"y": 0.2e-3, "z": 0.0}, "cage_velocity": {"y": 0.05, "z": 0.1}, "cage_speed": 142.5});
    let fast = json!({
        "cage": {"y": 0.05e-3, "z": -0.03e-3}, "cage_velocity": {"y": 0.1, "z": 0.05}, "cage_speed": 160.0
    });
    let dry =
        [("cage.guide.film", Value::Null), ("cage.guide.film_share", Value::Null), ("initial", falling)];
    let cylinder = {
        let mut scene = example();
        let rollers = scene["rollers"].clone();
        for part in ["rollers", "outer_ring", "raceways"] {
            scene.as_object_mut().expect("an object").remove(part);
        }
        scene["kinematic_elements"] = json!({
            "count": 12, "radius": rollers["radius"], "pitch_radius": 39.99e-3, "material": "steel",
            "effective_length": rollers["effective_length"], "motion": {"rolling": {"contact_angle": 0.0}}
        });
        scene["inner_ring"] = json!({"speed": {"constant": -314.0}});
        scene["initial"] = json!({"cage_velocity": {"y": 0.08, "z": -0.15}});
        scene
    };
    let case = |name, scene, duration| Case { name, scene, duration, reference_step: 2.5e-7 };
    vec![
        case("NU2310", example(), 1e-3),
        case("grease guide", scene(GREASE, &[]), 10e-3),
        case(DRY, scene(GREASE, &dry), 2e-3),
        case("plane pockets", scene(BALL, &[("initial", fast)]), 3e-3),
        case("cylinder pockets", cylinder, 3e-3),
    ]
}

/// A scene for the library's own methods, but driven by [`Sim::derivative`], so that the largest step can be chosen.
struct Rates {
    sim: Sim,
    state: Vec<f64>,
    rate: Vec<f64>,
}

impl System for Rates {
    type Fault = ();

    fn positions(&self) -> usize {
        self.sim.model().layout().positions()
    }
    fn velocities(&self) -> usize {
        self.sim.model().layout().velocities()
    }
    fn accelerations(&mut self, t: f64, q: &[f64], v: &[f64], a: &mut [f64]) -> Result<(), ()> {
        self.state.clear();
        self.state.extend(q.iter().chain(v));
        self.sim.derivative(t, &self.state, &mut self.rate).map_err(|_| ())?;
        a.copy_from_slice(&self.rate[q.len()..]);
        Ok(())
    }
    fn not_finite(&self, _: usize) {}
    fn next_event(&self, _: f64) -> f64 {
        f64::INFINITY
    }
    fn groups(&self) -> usize {
        0
    }
    fn group(&self, _: usize) -> [Option<usize>; 3] {
        [None; 3]
    }
    fn structure(&self) -> Structure {
        self.sim.model().structure()
    }
    fn linearize(
        &mut self,
        _: f64,
        _: &[f64],
        _: &[f64],
        _: &mut [f64],
        _: &mut Linearization,
    ) -> Result<(), ()> {
        Err(())
    }
    fn damping(&self, _: f64, _: &[f64], _: &[f64], _: &mut [DampingBlock]) {}
}

impl Case {
    /// Dormand-Prince with steps of at most `max_step`; a tolerance of infinity makes all steps that long.
    fn limited(&self, tolerance: f64, max_step: f64) -> End {
        let sim = self.sim(&json!({}));
        let start = sim.state().to_vec();
        let tolerances: Vec<f64> = sim.model().state_scales().iter().map(|s| tolerance * s).collect();
        let mut rates = Rates { sim, state: Vec::new(), rate: vec![0.0; start.len()] };
        let method = Box::new(DormandPrince::new(&rates, &tolerances));
        let limits = Limits { nominal_step: max_step, min_step: 1e-14, max_step, max_steps: 10_000_000 };
        let mut driver = Driver::new(method, limits);
        driver.start(0.0, &start);
        let done = driver.advance(&mut rates, self.duration);
        done.unwrap_or_else(|e| panic!("{}: {e:?}", self.name));
        let mut state = start;
        driver.state_at(self.duration, &mut state);
        let steps = driver.statistics().steps;
        End { state, steps, evaluations: 6 * steps + 1 }
    }
}

#[test]
fn cvode_solves_what_is_known_and_reports_what_fails() {
    // x'' = -x from x = 1, and y' = -1e4 (y - x).
    let mut calls = 0;
    for (method, with_jacobian, bound) in
        [(Method::Bdf, false, 1e-7), (Method::Bdf, true, 1e-7), (Method::Adams, false, 1e-7)]
    {
        let options = Options {
            method,
            relative: 1e-10,
            absolute: &[1e-10; 3],
            max_steps: 1_000_000,
            max_step: f64::INFINITY,
        };
        // Steps far too long at first, so that failed evaluations are met and overcome.
        let mut rates = |t: f64, s: &[f64], r: &mut [f64]| {
            assert!(t <= 2.0, "evaluated after the last time: {t}");
            r.copy_from_slice(&[s[1], -s[0], -1e4 * (s[2] - s[0])]);
            if s[0].abs() > 1.5 { Err(()) } else { Ok(()) }
        };
        let mut jacobian = |_: f64, _: &[f64], j: &mut [f64]| {
            calls += 1;
            j.copy_from_slice(&[0.0, -1.0, 1e4, 1.0, 0.0, 0.0, 0.0, 0.0, -1e4]);
            Ok(())
        };
        let jacobian: Option<&mut cvode::Function<'_>> =
            if with_jacobian { Some(&mut jacobian) } else { None };
        let times = [0.5, 1.0, 2.0];
        let solution = cvode::solve(&options, 0.0, &[1.0, 0.0, 1.0], &times, &mut rates, jacobian).unwrap();
        for (t, state) in times.iter().zip(&solution.states) {
            let error = (state[0] - t.cos()).abs().max((state[1] + t.sin()).abs());
            assert!(error < bound, "{method:?} at {t}: {error:e}");
            assert!((state[2] - t.cos()).abs() < 2e-4, "{method:?} at {t}: {state:?}");
        }
        let statistics = solution.statistics;
        assert!(statistics.steps > 50 && statistics.evaluations > statistics.steps, "{statistics:?}");
        let few = Options { max_steps: 3, ..options };
        let error = cvode::solve(&few, 0.0, &[1.0, 0.0, 1.0], &times, &mut rates, None).unwrap_err();
        assert!(error.contains("CVODE error -1"), "{error}");
        let mut broken = |_: f64, _: &[f64], _: &mut [f64]| Err(());
        let error = cvode::solve(&options, 0.0, &[1.0, 0.0, 1.0], &times, &mut broken, None).unwrap_err();
        assert!(error.contains("CVODE error"), "{error}");
        let panics = std::panic::catch_unwind(|| {
            let mut panics = |_: f64, _: &[f64], _: &mut [f64]| -> Result<(), ()> {
                std::panic::resume_unwind(Box::new("on purpose"))
            };
            cvode::solve(&options, 0.0, &[1.0, 0.0, 1.0], &times, &mut panics, None)
        });
        assert!(panics.is_err());
    }
    assert!(calls > 0);
}

#[test]
fn smooth_motion_agrees_with_cvode() {
    for case in smooth() {
        let reference = case.reference();
        let error = case.distance(&case.dormand_prince(1e-12), &reference.end);
        println!("{}: Dormand-Prince {error:.1e}, doubt {:.1e}", case.name, reference.doubt);
        assert!(
            reference.doubt < 1e-9,
            "{}: two methods of CVODE differ by {:e}",
            case.name,
            reference.doubt
        );
        assert!(error < 1e-9, "{}: {error:e} of the clearance", case.name);
    }
}

/// Orders from errors with steps that halve from run to run.
fn orders(errors: &[f64]) -> Vec<f64> {
    errors.windows(2).map(|e| (e[0] / e[1]).log2()).collect()
}

#[test]
fn the_leapfrog_is_of_second_order() {
    for case in smooth() {
        let reference = case.reference().end;
        let errors = [4e3, 8e3, 16e3].map(|n| case.distance(&case.leapfrog(case.duration / n), &reference));
        let found = orders(&errors);
        println!("{}, leapfrog: orders {found:.2?}, errors {}", case.name, short(&errors));
        assert!(found.iter().all(|order| (order - 2.0).abs() < 0.2), "{}: {found:?}", case.name);
    }
}

#[test]
fn dormand_prince_is_of_fifth_order() {
    let case = pressed();
    // Fifth order shows where steps are so short that the reference needs all digits.
    let reference = case.cvode(Method::Adams, 1e-14, 1e-14, f64::INFINITY);
    let run = |n| case.distance(&case.limited(f64::INFINITY, case.duration / n), &reference);
    let errors = [125.0, 250.0, 500.0, 1000.0].map(run);
    let found = orders(&errors);
    println!("Dormand-Prince: orders {found:.2?}, errors {}", short(&errors));
    assert!(found.iter().all(|order| *order > 4.8), "{found:?}");
    assert!((found[2] - 5.0).abs() < 0.2, "{found:?}");
}

/// Tolerances at which methods with error control are compared.
const LEVELS: [f64; 3] = [1e-4, 1e-6, 1e-8];

#[test]
fn errors_through_contacts_are_like_those_of_cvode() {
    for case in contacts() {
        let reference = case.reference();
        let error = |end: &End| case.distance(end, &reference.end);
        assert!(
            reference.doubt < 1e-6,
            "{}: two methods of CVODE differ by {:e}",
            case.name,
            reference.doubt
        );
        let mut ours = Vec::new();
        for level in LEVELS {
            let here = error(&case.dormand_prince(level));
            let theirs = [Method::Bdf, Method::Adams].map(|m| error(&case.cvode(m, 0.0, level, MAX_STEP)));
            println!("{} at {level:e}: {here:.1e}, CVODE {}", case.name, short(&theirs));
            let bound = 5.0 * theirs[0].max(theirs[1]);
            assert!(here < bound, "{} at {level:e}: {here:e}, CVODE {theirs:?}", case.name);
            ours.push(here);
        }
        assert!(ours[2] < 0.1 * ours[0], "{}: Dormand-Prince {ours:?}", case.name);
        let leapfrog = [4e-6, 1e-6, 2.5e-7].map(|h| error(&case.leapfrog(h)));
        println!("{}: leapfrog {}, doubt {:.1e}", case.name, short(&leapfrog), reference.doubt);
        assert!(leapfrog[2] < 0.3 * leapfrog[0], "{}: leapfrog {leapfrog:?}", case.name);
    }
}

/// The cage on the dry guide bounces, and its second contact lasts 7 us. Error control that looks at a few places of a
/// step of free flight misses it, at any tolerance; CVODE does, too.
#[test]
fn only_the_length_of_a_step_bounds_what_it_jumps_over() {
    let case = contacts().into_iter().find(|case| case.name == DRY).expect("a dry guide");
    let reference = case.reference().end;
    let mut worst: f64 = 0.0;
    for tolerance in [1e-8, 1e-9, 1e-10, 1e-11, 1e-12] {
        let free = case.distance(&case.dormand_prince(tolerance), &reference);
        let limited = case.distance(&case.limited(tolerance, 2e-6), &reference);
        println!("tolerance {tolerance:e}: {free:.1e}, with steps of at most 2 us {limited:.1e}");
        assert!(limited < 1e-5, "{tolerance:e}: {limited:e}");
        worst = worst.max(free);
    }
    assert!(worst < 1e-3, "{worst:e}");
}

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
fn mean(figures: &[f64]) -> (f64, f64) {
    let n = figures.len() as f64;
    let mean = figures.iter().sum::<f64>() / n;
    (mean, figures.iter().map(|x| (x - mean).powi(2)).sum::<f64>() / (n - 1.0) / n)
}

/// Starts of the whirl runs: the first element turned by so many mrad.
const STARTS: u32 = 6;
/// Student's t that a difference of two such means stays below with a probability of 99.9 %.
const STUDENT: f64 = 4.587;

fn whirls() -> Vec<(&'static str, Vec<f64>)> {
    let turned = |k: u32| {
        let angle = [("initial.first_roller_angle", json!(f64::from(k) * 1e-3))];
        Case { name: "whirl", scene: scene(GREASE, &angle), duration: 0.1, reference_step: 1e-5 }
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
        let solution = cvode::solve(&options, 0.0, &start, &times, &mut rates, None).expect("a run");
        whirl(&mut |i| solution.states[i - 1].clone(), &mut sim)
    };
    let step = turned(0).sim(&json!({})).nominal_step();
    vec![
        ("CVODE", (0..STARTS).map(cvode).collect()),
        ("leapfrog", own(json!({}))),
        ("leapfrog, half the step", own(json!({"method": {"leapfrog": {"step": step / 2.0}}}))),
        ("leapfrog, quarter of the step", own(json!({"method": {"leapfrog": {"step": step / 4.0}}}))),
        ("Dormand-Prince", own(json!({"method": {"dormand_prince": {"tolerance": 1e-8}}}))),
    ]
}

#[test]
fn mean_whirl_does_not_depend_on_the_integrator() {
    let all = whirls();
    let (reference, variance) = mean(&all[0].1);
    for (i, (name, figures)) in all.iter().enumerate() {
        if name.contains("quarter") {
            continue;
        }
        let (found, own) = mean(figures);
        let scatter = STUDENT * (variance + own).sqrt();
        // The whirl is steady, so the scatter is small and the leapfrog's step shows. Halving it tells how much: the
        // error is at most twice the change, as a method of first order has it.
        let finer = all.get(i + 1).filter(|next| next.0.starts_with("leapfrog, "));
        let step = finer.map_or(0.0, |next| 2.0 * (found - mean(&next.1).0).abs());
        println!(
            "{name}: {found:.2} rad/s, CVODE {reference:.2} +- {scatter:.2} +- {step:.2}: {figures:.1?}"
        );
    }
}

const PAGE: &str = "docs/verification.md";
const END: &str = "<!-- end -->";

/// Prints the tables of the page; with `CAGEDYN_BLESS=1` also writes them there.
#[test]
#[ignore = "make verify"]
fn tables() {
    let mut table = String::from("| scene | method | tolerance or step | error | steps | evaluations |\n");
    table += "|---|---|---|---|---|---|\n";
    for case in smooth().into_iter().chain(contacts()) {
        let reference = case.reference();
        let mut row = |method: &str, setting: &str, error: f64, steps: u64, evaluations: u64| {
            table += &format!(
                "| {} | {method} | {setting} | {error:.1e} | {steps} | {evaluations} |\n",
                case.name
            );
        };
        let Reference { end, doubt } = &reference;
        row("CVODE, reference", "1e-12", *doubt, end.steps, end.evaluations);
        let mut line = |method: &str, setting: String, run: End| {
            row(method, &setting, case.distance(&run, end), run.steps, run.evaluations);
        };
        for level in LEVELS {
            for method in [Method::Bdf, Method::Adams] {
                let run = case.cvode(method, 0.0, level, MAX_STEP);
                let name = if method == Method::Bdf { "BDF" } else { "Adams" };
                line(&format!("CVODE, {name}"), format!("{level:e}"), run);
            }
        }
        for level in LEVELS.into_iter().chain([1e-10, 1e-12]) {
            line("Dormand-Prince", format!("{level:e}"), case.dormand_prince(level));
        }
        let nominal = case.sim(&json!({})).nominal_step();
        for share in [1.0, 4.0, 16.0] {
            let step = nominal / share;
            line("leapfrog", format!("{:.3} us", 1e6 * step), case.leapfrog(step));
        }
    }
    let mut whirl =
        String::from("| method | mean whirl | largest difference between starts |\n|---|---|---|\n");
    for (name, figures) in whirls() {
        let largest = figures.iter().copied().fold(f64::NEG_INFINITY, f64::max);
        let least = figures.iter().copied().fold(f64::INFINITY, f64::min);
        let spread = largest - least;
        whirl += &format!("| {name} | {:.2} rad/s | {spread:.2} rad/s |\n", mean(&figures).0);
    }
    println!("{table}\n{whirl}");
    if std::env::var_os("CAGEDYN_BLESS").is_some() {
        let mut page = read(PAGE);
        for (name, text) in [("errors", table), ("whirl", whirl)] {
            let marker = format!("<!-- {name} -->\n");
            let start = page.find(&marker).expect("a marker") + marker.len();
            let length = page[start..].find(END).expect("an end");
            page.replace_range(start..start + length, &format!("\n{text}\n"));
        }
        std::fs::write(repository(PAGE), page).expect("the page is written");
    }
}
