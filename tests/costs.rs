//! What a scene does not ask for costs nothing: no evaluations, no states, no instructions. Instructions are counted
//! with Valgrind where it is installed (`CAGEDYN_REQUIRE_VALGRIND=1` makes a missing Valgrind a failure).

mod common;

use cagedyn::{Model, Scene, Sim};
use cagedyn_studies::effects::{bar, count, rows};
use common::read;
use count::{States, evaluate_states, instructions};
use rows::{Kind, Row, STUDIES, Study};
use std::path::{Path, PathBuf};
use std::process::Command;
use std::sync::Arc;

/// Time by which rollers have met their pockets and the greased cage its film, s.
const DEVELOPED: f64 = 10e-3;
/// States at which instructions are counted.
const STATES: usize = 20;
/// Most instructions of an evaluation of a cage with nothing but its weight: the call, and twelve elements on their orbits.
const WEIGHT_ALONE: f64 = 1250.0;
/// Instructions that a row may cost more than the unchanged scene, relative to that.
const MORE: f64 = 0.01;

fn sim(study: &Study, set: &[(&str, &str)]) -> Sim {
    let text = read(&format!("scenes/{}.json", study.name));
    let scene = Scene::from_json_with(&text, set.iter().copied()).unwrap_or_else(|e| panic!("{set:?}: {e}"));
    Sim::new(Arc::new(Model::new(scene).unwrap())).unwrap_or_else(|e| panic!("{set:?}: {e}"))
}

fn developed(study: &Study, set: &[(&str, &str)]) -> Sim {
    let mut sim = sim(study, set);
    sim.advance_to(DEVELOPED).unwrap_or_else(|e| panic!("{set:?}: {e}"));
    sim
}

/// A default of the scene may become what a row sets.
#[test]
fn every_row_changes_the_scene() {
    for study in &STUDIES {
        let full = sim(study, &[]);
        for row in study.rows {
            let changed = sim(study, row.set);
            assert_ne!(changed.model().scene(), full.model().scene(), "{}: {}", study.name, row.effect);
        }
    }
}

#[test]
fn effects_that_are_taken_away_leave_no_evaluations_and_no_states() {
    for study in &STUDIES {
        let full = developed(study, &[]);
        for row in study.rows {
            let what = format!("{}: {}", study.name, row.effect);
            let sim = developed(study, row.set);
            let (counts, names) = (sim.statistics().laws, sim.model().state_infos());
            assert_eq!(row.left_over(&counts, &names), Vec::<String>::new(), "{what}");
            // What the row does not take away stays: the check above would find it in the unchanged scene.
            let before = row.left_over(&full.statistics().laws, &full.model().state_infos());
            assert!(before.len() >= row.states.len(), "{what}: {before:?}");
            let expected = full.model().state_infos().len() - before.iter().filter(|b| is_state(b)).count();
            assert_eq!(names.len(), expected, "{what}");
        }
    }
}

/// Whether something left over is a state and not a count.
fn is_state(left: &str) -> bool {
    !left.contains(' ')
}

/// The laws of the rows are those that the unchanged scene evaluates, except a guide contact that is never reached and
/// oil that keeps its temperature.
#[test]
fn unchanged_scenes_evaluate_every_law_of_the_rows() {
    for study in &STUDIES {
        let full = developed(study, &[]);
        let counts = full.statistics().laws;
        let laws = study.rows.iter().flat_map(|row| row.gone).map(|(law, _)| *law);
        for law in laws.filter(|law| !["guide_solid", "viscosity_temperature"].contains(law)) {
            let place = cagedyn::model::LAWS.iter().position(|name| *name == law);
            let place = place.unwrap_or_else(|| panic!("{law} is no law"));
            assert!(counts[place] > 0, "{}: {law} is never evaluated", study.name);
        }
    }
}

#[test]
fn the_fixed_ring_stands_where_the_free_one_starts() {
    let free = sim(&STUDIES[0], &[]);
    let row =
        STUDIES[0].rows.iter().find(|row| row.states.contains(&"inner_ring.") && row.kind == Kind::Removed);
    let mut fixed = sim(&STUDIES[0], row.unwrap().set);
    let channel = |sim: &Sim, name: &str| sim.channels().iter().position(|c| c.name == name).unwrap();
    for (i, name) in ["inner_ring.y", "inner_ring.z"].into_iter().enumerate() {
        let index = channel(&fixed, name);
        let held = fixed.output(index).unwrap();
        assert!((held - free.state()[i]).abs() < 1e-8, "{name}: {held} {}", free.state()[i]);
    }
}

/// Runs in Valgrind, as a process of its own: evaluates a scene at saved states.
#[test]
#[ignore = "started by the tests that count instructions"]
fn evaluations_to_count() {
    let variable = |name: &str| std::env::var(name).unwrap_or_else(|_| panic!("{name} is not set"));
    let study = &STUDIES[variable("CAGEDYN_TEST_STUDY").parse::<usize>().unwrap()];
    let row = variable("CAGEDYN_TEST_ROW").parse::<usize>().ok().map(|i| &study.rows[i]);
    let mut sim = sim(study, row.map_or(&[], |row| row.set));
    let length = sim.state().len();
    let states = States::load(Path::new(&variable("CAGEDYN_TEST_STATES")), length).unwrap();
    assert_eq!(states.0.len(), STATES);
    evaluate_states(&mut sim, &states, 1, &mut vec![0.0; length]).unwrap();
}

/// Counts instructions of the rows of a scene at states of the unchanged scene.
struct Counter {
    study: usize,
    full: Sim,
    states: States,
    folder: tempfile::TempDir,
}

impl Counter {
    /// `None` without Valgrind.
    fn new(study: usize) -> Option<Self> {
        if Command::new("valgrind").arg("--version").output().is_err() {
            assert!(std::env::var_os("CAGEDYN_REQUIRE_VALGRIND").is_none(), "valgrind is not installed");
            eprintln!("valgrind is not installed: no instructions counted");
            return None;
        }
        let mut full = developed(&STUDIES[study], &[]);
        let states = (0..STATES).map(|i| {
            full.advance_to(DEVELOPED + 1e-3 * i as f64).unwrap();
            (full.time(), full.state().to_vec())
        });
        let states = States(states.collect());
        Some(Self { study, full, states, folder: tempfile::tempdir().unwrap() })
    }

    /// Instructions per evaluation of row `row`, or of the unchanged scene.
    fn count(&self, row: Option<usize>) -> f64 {
        let study = &STUDIES[self.study];
        let name = row.map_or("unchanged".to_owned(), |i| i.to_string());
        let changed = sim(study, row.map_or(&[], |i| study.rows[i].set));
        let states = self.states.project(self.full.model(), changed.model()).expect("no new states");
        let path: PathBuf = self.folder.path().join(&name);
        states.save(&path).unwrap();
        let study = self.study.to_string();
        let variables = [
            ("CAGEDYN_TEST_STUDY", study.as_str()),
            ("CAGEDYN_TEST_ROW", &name),
            ("CAGEDYN_TEST_STATES", path.to_str().unwrap()),
        ];
        let arguments = ["--exact", "evaluations_to_count", "--ignored"];
        let test = std::env::current_exe().unwrap();
        instructions(&test, &arguments, &variables).unwrap_or_else(|e| panic!("{e}")) as f64 / STATES as f64
    }
}

/// Removing an effect saves instructions, or changes nothing.
fn rows_cost_no_more(study: usize) {
    let Some(counter) = Counter::new(study) else { return };
    let full = counter.count(None);
    let removed = |row: &Row| matches!(row.kind, Kind::Removed | Kind::Reference);
    for (i, row) in STUDIES[study].rows.iter().enumerate().filter(|(_, row)| removed(row)) {
        let count = counter.count(Some(i));
        assert!(
            count < (1.0 + MORE) * full,
            "{}: {count} instructions, {full} of the unchanged scene",
            row.effect
        );
        if study == 0 && row.kind == Kind::Reference {
            assert!(count < WEIGHT_ALONE, "{}: {count} instructions", row.effect);
        }
    }
}

#[test]
fn effects_of_the_roller_bearing_cost_only_where_they_are() {
    rows_cost_no_more(0);
}

#[test]
fn effects_of_the_greased_guide_cost_only_where_they_are() {
    rows_cost_no_more(1);
}

/// Instructions of a run that may go into following all pocket forces in every step.
const WATCHING: f64 = 0.03;

/// Runs in Valgrind: a developed run of the roller bearing, with what the scene follows or with nothing.
#[test]
#[ignore = "started by the test that counts instructions"]
fn steps_to_count() {
    let watching = std::env::var_os("CAGEDYN_TEST_WATCHING").is_some();
    let mut sim = sim(&STUDIES[0], if watching { &[] } else { &[("record.extremes", "[]")] });
    sim.advance_to(DEVELOPED).unwrap();
    evaluate_states_in_steps(&mut sim);
}

/// Its name tells callgrind where to count.
#[inline(never)]
fn evaluate_states_in_steps(sim: &mut Sim) {
    for k in 1..=20 {
        sim.begin_interval();
        sim.advance_to(DEVELOPED + 0.5e-3 * f64::from(k)).unwrap();
        for place in 0..sim.watched().len() {
            let index = sim.watched()[place];
            std::hint::black_box(sim.interval(index).unwrap());
        }
    }
}

#[test]
fn following_pocket_forces_in_every_step_costs_little() {
    if Counter::new(0).is_none() {
        return;
    }
    let count = |variables: &[(&str, &str)]| {
        let test = std::env::current_exe().unwrap();
        let arguments = ["--exact", "steps_to_count", "--ignored"];
        instructions(&test, &arguments, variables).unwrap_or_else(|e| panic!("{e}")) as f64
    };
    let more = count(&[("CAGEDYN_TEST_WATCHING", "1")]) / count(&[]) - 1.0;
    println!("following all pocket forces takes {:.2} % of the instructions of a run", 100.0 * more);
    assert!((0.0..WATCHING).contains(&more), "{more}");
}

/// An effect that costs twenty times the evaluation does not look like one that costs nearly as much.
#[test]
fn bars_of_costs_tell_large_from_huge() {
    use bar::Bar;
    assert_eq!(Bar::new(18.1), Bar { length: 1.0, broken: true });
    let whole = Bar::new(1.0);
    assert!(!whole.broken && whole.length < 1.0);
    assert_eq!(Bar::new(0.5).length, 0.5 * whole.length);
    assert_eq!(Bar::new(-0.1).length, 0.0);
}
