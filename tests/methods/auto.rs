//! The method that chooses: what it takes for which scene, that it is as good as the best of the others, and that it
//! says so.

use crate::common::{read, repository, set};
use cagedyn::integrate::Tuning;
use cagedyn::integrate::auto::{Choice, Kind, Reason};
use cagedyn::sim::STATISTICS;
use cagedyn::{Model, Sim};
use cagedyn_studies::judge::rollers_in_space;
use serde_json::{Value, json};
use std::sync::Arc;

/// A scene file with other values at some paths.
fn scene(file: &str, changes: &[(&str, Value)]) -> Value {
    let mut scene: Value = serde_json::from_str(&read(file)).expect("JSON");
    for (path, value) in changes {
        set(&mut scene, path, value.clone());
    }
    scene
}

fn sim(scene: &Value, method: Value) -> Sim {
    let mut scene = scene.clone();
    scene["solver"] = json!({ "method": method });
    let model = Model::from_json(&scene.to_string()).unwrap_or_else(|e| panic!("{e}"));
    Sim::new(Arc::new(model)).unwrap_or_else(|e| panic!("{e}"))
}

fn run(scene: &Value, method: Value, duration: f64) -> Sim {
    let mut sim = sim(scene, method);
    sim.advance_to(duration).unwrap_or_else(|e| panic!("{e}"));
    sim
}

fn choice(sim: &Sim) -> Choice {
    sim.statistics().choice.expect("the method chooses")
}

fn auto() -> Value {
    json!({ "auto": {} })
}

fn nu2310(changes: &[(&str, Value)]) -> Value {
    scene("scenes/nu2310.json", changes)
}

fn load(newton: f64) -> (&'static str, Value) {
    ("inner_ring.motion.free.load.z.constant", json!(-newton))
}

fn rpm(n: f64) -> (&'static str, Value) {
    ("inner_ring.speed.constant", json!(-n * std::f64::consts::TAU / 60.0))
}

fn undamped() -> Value {
    let mut scene = nu2310(&[]);
    crate::common::remove(&mut scene, "raceways.contact.damping");
    crate::common::remove(&mut scene, "cage.pocket.lubricated_cylinder.contact.damping");
    scene
}

/// The cage starts with a film of this thickness in m in its guide.
fn thin_film(file: &str, thickness: f64) -> Value {
    let scene = scene(file, &[]);
    let clearance = scene["cage"]["guide"]["diametral_clearance"].as_f64().expect("a number") / 2.0;
    let mut scene = scene;
    scene["initial"]["cage"] = json!({ "y": 0.0, "z": -(clearance - thickness) });
    scene
}

/// A cage without pockets in a short bearing of thick oil, from a film of 1 um: explicit steps are limited by stability.
fn stiff_film() -> Value {
    let mut scene = thin_film("scenes/ball_short_bearing.json", 1e-6);
    set(&mut scene, "lubricant.viscosity.constant", json!(0.1));
    crate::common::remove(&mut scene, "cage.pocket");
    scene
}

#[test]
fn it_is_the_default_and_costs_little_more_than_the_leapfrog_once_rollers_vibrate() {
    let mut scene = nu2310(&[]);
    let default = Model::from_json(&scene.to_string()).unwrap();
    let mut default = Sim::new(Arc::new(default)).unwrap();
    let costs = |sim: &mut Sim| {
        [20e-3, 100e-3].map(|t| {
            sim.advance_to(t).unwrap();
            sim.statistics().evaluations as f64
        })
    };
    let [first, whole] = costs(&mut default);
    let [plain_first, plain_whole] = costs(&mut sim(&scene, json!({ "leapfrog": {} })));
    // The first steps are followed closely; then nothing vibrates yet, which costs no more than what comes later.
    assert!(first > 1.02 * plain_first && first < 1.2 * plain_first, "{first} {plain_first}");
    assert!(
        whole - first < 1.15 * (plain_whole - plain_first),
        "{first} {plain_first} {whole} {plain_whole}"
    );
    let choice = choice(&default);
    assert_eq!((choice.method, choice.reason), (Kind::Leapfrog, Reason::Vibration));
    assert!(choice.steps[Kind::Rosenbrock as usize] > 20 && choice.changes < 10, "{choice:?}");
    assert!((1.5e5..3e5).contains(&choice.highest_frequency), "{choice:?}");
    scene["solver"] = json!({ "method": auto() });
    assert_eq!(default.model().scene().solver, sim(&scene, auto()).model().scene().solver.clone());
}

#[test]
fn a_standing_bearing_does_not_vibrate() {
    let mut run = run(&nu2310(&[rpm(0.0)]), auto(), 20e-3);
    let choice = choice(&run);
    assert_eq!(choice.method, Kind::Rosenbrock, "{}", run.report());
    assert!(choice.steps[Kind::Leapfrog as usize] < 100, "{}", run.report());
}

/// Ends of rollers whose damping sets in within nanometres: where derivatives are dear finer steps of the leapfrog take the place of error control.
#[test]
fn finer_steps_cost_less_where_derivatives_are_dear() {
    const END: f64 = 5e-5;
    let model = Arc::new(Model::from_json(&rollers_in_space::scene(3280, 1e-3).to_string()).unwrap());
    let run = |tuning: Tuning| {
        let mut sim = Sim::with_tuning(model.clone(), tuning).unwrap();
        sim.advance_to(END).unwrap();
        assert_eq!(sim.trust(), Ok(()), "{}", sim.report());
        sim
    };
    // Not even the Radau method, which helps there, too, costs as little.
    let with_radau = Tuning { dear_derivatives: f64::INFINITY, ..Tuning::default() };
    let without = Tuning { stiff: f64::INFINITY, ..with_radau };
    let [finer, with_radau, without] = [Tuning::default(), with_radau, without].map(run);
    let Choice { method, reason, .. } = choice(&finer);
    assert_eq!((method, reason), (Kind::Leapfrog, Reason::Balance));
    assert_eq!(choice(&without).method, Kind::Rosenbrock);
    let cost = |sim: &Sim| sim.statistics().evaluations + 9 * sim.statistics().jacobians;
    assert!(10 * cost(&finer) < cost(&without), "{} {}", cost(&finer), cost(&without));
    assert!(cost(&finer) < cost(&with_radau), "{} {}", cost(&finer), cost(&with_radau));
}

/// A thin layer of grease, through which leapfrog steps of the scene's own size would put 121 J.
#[test]
fn stretches_that_miss_energy_are_undone() {
    for (thickness, duration) in [(1e-6, 12e-3), (3e-6, 30e-3)] {
        let layer = ("cage.guide.film.lubricant_layer.thickness", json!(thickness));
        let scene = scene("scenes/nu2310_grease.json", &[layer]);
        let mut run = run(&scene, auto(), duration);
        let residual = run.power_balance().unwrap().relative_residual();
        println!("{thickness:e}: residual {residual:.1e}; {}", run.report());
        let statistics = run.statistics();
        assert!(statistics.driver.undone > 0 && choice(&run).steps[Kind::Leapfrog as usize] > 300);
        assert_eq!(statistics.driver.steps, choice(&run).steps.iter().sum::<u64>());
        assert!(residual.abs() < 1e-3, "{residual}");
        // As with error control of every kind, in the mean of starts a little apart, as one of them scatters by 0.025.
        let z = |scene: &Value, method: Value| {
            let mut sim = self::run(scene, method, 12e-3);
            let place = sim.channels().iter().position(|c| c.name == "cage.z_ratio").unwrap();
            sim.output(place).unwrap()
        };
        let starts = 6;
        let apart = |i: i32| z(&crate::common::with(&scene, &[load(4900.0 + 1e-4 * f64::from(i))]), auto());
        let ours = (0..starts).map(apart).sum::<f64>() / f64::from(starts);
        let theirs = z(&scene, json!({"dormand_prince": {"tolerance": 1e-7}}));
        assert!((ours - theirs).abs() < 0.03, "{ours} {theirs}");
    }
}

/// Steps of `draft` that are too long for the balance are those of `engineering` afterwards, and not made again all the time.
#[test]
fn draft_takes_care_once_its_steps_missed_energy() {
    let layer = ("cage.guide.film.lubricant_layer.thickness", json!(3e-6));
    let mut scene = scene("scenes/nu2310_grease.json", &[layer]);
    // Steps of the leapfrog before it missed energy, and after.
    let mut steps = |preset: &str| {
        scene["solver"] = json!({ "preset": preset });
        let mut sim = Sim::new(Arc::new(Model::from_json(&scene.to_string()).unwrap())).unwrap();
        let mut before = choice(&sim).leapfrog_step;
        while choice(&sim).reason != Reason::Balance {
            before = choice(&sim).leapfrog_step;
            sim.advance_to(sim.time() + 10e-6).unwrap();
        }
        [before, choice(&sim).leapfrog_step]
    };
    let [before, after] = steps("draft");
    assert!((before / after - 1.4).abs() < 1e-12, "{before} {after}");
    let [before, after] = steps("engineering");
    assert_eq!(before, after);
}

/// Steps of records, of calls and of single questions are the same, whatever stretch they are in.
#[test]
fn stretches_do_not_depend_on_the_questions() {
    let layer = ("cage.guide.film.lubricant_layer.thickness", json!(1e-6));
    let scene = scene("scenes/nu2310_grease.json", &[layer]);
    let whole = run(&scene, auto(), 5e-3);
    let mut parts = sim(&scene, auto());
    let mut out = vec![0.0; parts.channels().len()];
    for i in 1..=1000 {
        parts.advance_to(5e-6 * f64::from(i)).unwrap();
        parts.outputs(&mut out).unwrap();
        parts.power_balance().unwrap();
    }
    assert_eq!(parts.state(), whole.state());
    assert_eq!(parts.statistics(), whole.statistics());
}

/// A host that sets an input every 10 us never goes on with a stretch that was not judged.
#[test]
fn the_balance_is_kept_where_a_host_sets_inputs_often() {
    let layer = ("cage.guide.film.lubricant_layer.thickness", json!(1e-6));
    let mut sim = sim(&scene("scenes/nu2310_grease.json", &[layer]), auto());
    for i in 1..=1000 {
        sim.set_input(2, -4900.0 + f64::from(i % 2)).unwrap();
        sim.advance_to(1e-5 * f64::from(i)).unwrap();
    }
    let residual = sim.power_balance().unwrap().relative_residual();
    println!("residual {residual:.1e}, {} evaluations; {}", sim.statistics().evaluations, sim.report());
    assert!(residual.abs() < 2e-3, "{residual}");
}

#[test]
fn what_follows_an_event_is_followed_closely() {
    let load = json!({"ramp": {"from": -4900.0, "to": 4900.0, "start": 10e-3, "end": 10.1e-3}});
    let mut sim = sim(&nu2310(&[("inner_ring.motion.free.load.z", load)]), auto());
    let chosen = [9.7e-3, 10.03e-3, 30e-3].map(|t| {
        sim.advance_to(t).unwrap();
        let choice = choice(&sim);
        (choice.method, choice.reason)
    });
    let leapfrog = (Kind::Leapfrog, Reason::Vibration);
    assert_eq!([chosen[0], chosen[2]], [leapfrog; 2], "{}", sim.report());
    assert_eq!(chosen[1].0, Kind::Rosenbrock, "{}", sim.report());
}

/// Many events share what error control may take.
#[test]
fn events_that_follow_each_other_closely_cost_little() {
    let evaluations = |load: Value| {
        let run = run(&nu2310(&[("inner_ring.motion.free.load.z", load)]), auto(), 0.1);
        run.statistics().evaluations
    };
    let time: Vec<f64> = (0..=200).map(|i| 5e-4 * f64::from(i)).collect();
    let value: Vec<f64> = (0..=200).map(|i| -4900.0 + f64::from(i % 3)).collect();
    let [constant, kinks] =
        [json!({"constant": -4900.0}), json!({"table": {"time": time, "value": value}})].map(evaluations);
    println!("{constant} evaluations, with 200 kinks {kinks}");
    // Three on top of a budget of nine for one.
    let most = constant + (6000 + constant / 20) * 3;
    assert!(kinks > constant && kinks < most, "{kinks} {constant}");
}

/// Half the step would not make them vibrate otherwise.
#[test]
fn rollers_get_the_step_that_their_scene_needs() {
    for (name, scene, share) in [
        ("1000 rpm", nu2310(&[rpm(1000.0)]), 1.0),
        ("3000 rpm", nu2310(&[]), 1.0),
        ("40 kN", nu2310(&[load(40e3)]), 1.0),
        ("20 000 rpm", nu2310(&[rpm(20e3)]), 1.0),
        ("50 000 rpm", nu2310(&[rpm(50e3)]), 1.0),
        ("undamped", undamped(), 0.5),
    ] {
        // Without damping vibration builds up for tens of milliseconds.
        let mut run = run(&scene, auto(), 5e-3);
        // Where bodies are set down, errors are controlled, with steps of their own.
        let start = (run.time(), run.statistics().driver.steps);
        run.advance_to(if name == "undamped" { 80e-3 } else { 50e-3 }).unwrap();
        let choice = choice(&run);
        println!("{name}: {}", run.report());
        // The measured frequency may be higher than the expected one, and now and then far higher for a while.
        let mean = (run.time() - start.0) / (run.statistics().driver.steps - start.1) as f64;
        let found = mean * run.model().highest_frequency();
        println!("mean step {found:.4} of 1/omega");
        assert!(found < 1.01 * share && found > 0.88 * share, "{name}: {found}");
        assert!(choice.steps[Kind::Leapfrog as usize] > 5000, "{name}: {choice:?}");
        let duration = run.time();
        // Without damping it goes on growing, at a rate that scatters from start to start.
        let (starts, most) = if name == "undamped" { (4, 1.4) } else { (1, 1.2) };
        let [coarse, fine] = [1.0, 0.5].map(|part| {
            let leapfrog = json!({ "leapfrog": { "step": part * choice.leapfrog_step } });
            let loads = [4900.0, 4900.0001, 4900.0002, 4900.0003].into_iter().take(starts);
            let vibration = |newton: f64| {
                let scene =
                    if starts > 1 { crate::common::with(&scene, &[load(newton)]) } else { scene.clone() };
                self::run(&scene, leapfrog.clone(), duration).statistics().driver.vibration.rms()
            };
            loads.map(vibration).sum::<f64>() / starts as f64
        });
        println!("vibration {:.3} of that with half the step", coarse / fine);
        assert!((0.9..most).contains(&(coarse / fine)), "{name}: {coarse} {fine}");
    }
}

#[test]
fn error_control_costs_little_more_than_with_the_better_method() {
    let cold = scene(
        "scenes/grease_guide.json",
        &[("lubricant.viscosity.walther.temperature.over_time.constant", json!(273.15))],
    );
    let cases = [
        ("grease guide", scene("scenes/grease_guide.json", &[]), None, 1e-6, 50e-3),
        ("cold grease", cold, None, 1e-6, 50e-3),
        ("short bearing", scene("scenes/ball_short_bearing.json", &[]), None, 1e-6, 50e-3),
        ("stiff film", stiff_film(), None, 1e-6, 5e-3),
        ("NU2310", nu2310(&[]), Some(1e-4), 1e-4, 5e-3),
        ("NU2310, 40 kN", nu2310(&[load(40e3)]), Some(1e-5), 1e-5, 2e-3),
    ];
    for (name, scene, asked, tolerance, duration) in cases {
        let method = asked.map_or_else(auto, |t| json!({ "auto": { "tolerance": t } }));
        let mut chosen = run(&scene, method, duration);
        let cost = |method: &str| {
            let run = run(&scene, json!({ method: { "tolerance": tolerance } }), duration);
            // As the choice counts: derivatives of the Rosenbrock method are worth three evaluations.
            let steps = run.statistics().driver.steps;
            run.statistics().evaluations + if method == "rosenbrock" { 3 * steps } else { 0 }
        };
        let [explicit, implicit] = ["dormand_prince", "rosenbrock"].map(cost);
        let statistics = chosen.statistics();
        let here = statistics.evaluations + 3 * choice(&chosen).steps[Kind::Rosenbrock as usize];
        println!("{name}: {here}, Dormand-Prince {explicit}, Rosenbrock {implicit}; {}", chosen.report());
        assert_eq!(choice(&chosen).steps[Kind::Leapfrog as usize], 0, "{name}");
        // Trials cost one window of the other method each, and there are few windows in a short run.
        assert!((here as f64) < 1.3 * explicit.min(implicit) as f64 + 2000.0, "{name}");
    }
}

#[test]
fn thin_films_at_the_start_are_passed_and_forgotten() {
    for (file, thickness) in [
        ("scenes/grease_guide.json", 1e-6),
        ("scenes/grease_guide.json", 1e-7),
        ("scenes/nu2310_grease.json", 1e-6),
        ("scenes/nu2310_grease.json", 1e-7),
    ] {
        let scene = thin_film(file, thickness);
        let rollers = file.contains("nu2310");
        let duration = if rollers { 20e-3 } else { 10e-3 };
        let mut chosen = run(&scene, auto(), duration);
        let explicit = run(&scene, json!({ "dormand_prince": { "tolerance": 1e-6 } }), duration);
        let (ours, theirs) = (chosen.statistics(), explicit.statistics());
        println!(
            "{file} from {thickness:e} m: {} steps, {} evaluations; Dormand-Prince {} and {}; {}",
            ours.driver.steps,
            ours.evaluations,
            theirs.driver.steps,
            theirs.evaluations,
            chosen.report()
        );
        if rollers {
            // The leapfrog is back as soon as the film allows its steps.
            let own = sim(&scene, json!({ "leapfrog": {} })).nominal_step();
            let choice = choice(&chosen);
            assert!(choice.steps[Kind::Leapfrog as usize] > 1000, "{}", chosen.report());
            assert!(choice.leapfrog_step > 0.2 * own, "{}", chosen.report());
            assert!(ours.driver.smallest_step < 0.1 * own, "{}", chosen.report());
            assert!(ours.evaluations * 3 < theirs.evaluations);
        } else {
            // The balance of energy asks for more than the tolerance.
            assert!(ours.evaluations < theirs.evaluations * 3);
        }
        // Both tell the same story: where the cage is, in shares of its clearance.
        let [ours, theirs] = [&chosen, &explicit].map(|sim| {
            let (c, clearance) =
                (sim.model().layout().cage().unwrap(), sim.model().guide_clearance().unwrap());
            [sim.state()[c] / clearance, sim.state()[c + 1] / clearance]
        });
        let apart = (ours[0] - theirs[0]).hypot(ours[1] - theirs[1]);
        println!("{file} from {thickness:e} m: the cage is at {ours:?} and at {theirs:?}");
        assert!(apart < if rollers { 0.2 } else { 0.05 }, "{file} from {thickness:e} m: {apart}");
    }
}

#[test]
fn choices_continue_with_the_same_bits_after_saving() {
    let cold = scene(
        "scenes/grease_guide.json",
        &[("lubricant.viscosity.walther.temperature.over_time.constant", json!(273.15))],
    );
    for (scene, method, duration) in [
        (undamped(), auto(), 12e-3),
        (thin_film("scenes/nu2310_grease.json", 1e-7), auto(), 2e-3),
        (cold, auto(), 20e-3),
        (nu2310(&[]), json!({ "auto": { "tolerance": 1e-4 } }), 2e-3),
    ] {
        let mut first = sim(&scene, method.clone());
        for part in 1..=7 {
            first.advance_to(duration * f64::from(part) / 8.0).unwrap();
            let mut second = sim(&scene, method.clone());
            second.restore(&first.save()).unwrap();
            assert_eq!(second.statistics(), first.statistics());
            second.advance_to(duration).unwrap();
            let mut whole = sim(&scene, method.clone());
            whole.advance_to(duration).unwrap();
            assert_eq!(second.state(), whole.state(), "{method}, part {part}");
            assert_eq!(second.statistics(), whole.statistics(), "{method}, part {part}");
        }
    }
}

#[test]
fn a_set_state_is_met_without_memory_and_inputs_with_it() {
    let mut sim = sim(&nu2310(&[]), auto());
    let first = sim.nominal_step();
    // Contacts are stiffer than at any load of the scene.
    sim.set_input(2, -300e3).unwrap();
    sim.advance_to(20e-3).unwrap();
    let step = choice(&sim).leapfrog_step;
    assert!(step < 0.9 * first, "{step} {first}");
    sim.set_input(2, -290e3).unwrap();
    assert_eq!(choice(&sim).leapfrog_step, step);
    let (state, steps) = (sim.state().to_vec(), choice(&sim).steps);
    sim.set_state(0.0, &state).unwrap();
    assert_eq!(choice(&sim).leapfrog_step, first);
    assert_eq!(choice(&sim).steps, steps);
}

#[test]
fn the_report_says_what_was_chosen_and_why() {
    let report = run(&nu2310(&[]), auto(), 5e-3).report();
    for part in ["leapfrog with steps of 4.730e-6 s", "vibrate", "highest frequency", "rms"] {
        assert!(report.contains(part), "{part}: {report}");
    }
    let report = run(&scene("scenes/grease_guide.json", &[]), auto(), 30e-3).report();
    for part in ["dormand_prince", "errors are controlled", "most rejected steps, "] {
        assert!(report.contains(part), "{part}: {report}");
    }
    assert!(!report.contains('\n'));
    let mut plain = run(&nu2310(&[]), json!({ "leapfrog": {} }), 1e-3);
    assert!(plain.report().starts_with("leapfrog; loaded raceway contacts vibrate with"));
    let values = plain.statistics().values();
    let at = |name: &str| values[STATISTICS.iter().position(|n| *n == name).expect("a name")];
    assert_eq!(at("steps"), plain.statistics().driver.steps as f64);
    assert_eq!((at("highest_frequency"), at("leapfrog_steps"), at("failed_not_finite")), (0.0, 0.0, 0.0));
    assert!(at("raceway_vibration_rms") > 0.0);
}

#[test]
fn failures_are_counted_by_cause() {
    // Steps in which a load throws the cage out of its film fail, and are retried with smaller ones.
    let mut scene = scene("scenes/ball_short_bearing.json", &[]);
    scene["cage"]["load"] = json!({ "force_y": { "constant": 2e4 } });
    scene["solver"] = json!({ "method": { "dormand_prince": { "tolerance": 1e-2 } } });
    let mut sim = Sim::new(Arc::new(Model::from_json(&scene.to_string()).unwrap())).unwrap();
    sim.advance_to(1e-3).unwrap();
    let statistics = sim.statistics();
    assert!(statistics.driver.faults > 0, "{}", sim.report());
    assert_eq!(statistics.faults.iter().sum::<u64>(), statistics.driver.faults);
    assert!(sim.report().contains("no_guide_film") && sim.report().contains("smallest thickness"));
}

/// Prints the table of hard starts and loads; with `CAGEDYN_BLESS=1` also writes it into the page.
#[test]
#[ignore = "make verify"]
fn table() {
    let mut table =
        String::from("| run | method | steps | rejected | evaluations | smallest step | largest step |\n");
    table += "|---|---|---|---|---|---|---|\n";
    let runs = [
        ("NU2310, 40 kN, 50 ms", nu2310(&[load(40e3)]), 50e-3),
        ("grease guide from a film of 1 um, 50 ms", thin_film("scenes/grease_guide.json", 1e-6), 50e-3),
        ("cage in thick oil from 1 um, 5 ms", stiff_film(), 5e-3),
        ("NU2310 with grease guide from 1 um, 50 ms", thin_film("scenes/nu2310_grease.json", 1e-6), 50e-3),
    ];
    for (name, scene, duration) in runs {
        let methods = [
            ("auto", auto()),
            ("Rosenbrock, 1e-4", json!({ "rosenbrock": { "tolerance": 1e-4 } })),
            ("Dormand-Prince, 1e-4", json!({ "dormand_prince": { "tolerance": 1e-4 } })),
            ("Dormand-Prince, 1e-6", json!({ "dormand_prince": { "tolerance": 1e-6 } })),
        ];
        for (label, method) in methods {
            let statistics = run(&scene, method, duration).statistics();
            let d = statistics.driver;
            table += &format!(
                "| {name} | {label} | {} | {} | {} | {:.1e} s | {:.1e} s |\n",
                d.steps, d.rejected, statistics.evaluations, d.smallest_step, d.largest_step
            );
        }
    }
    println!("{table}");
    if std::env::var_os("CAGEDYN_BLESS").is_some() {
        crate::common::replace_between(&repository("docs/results/verification.md"), "<!-- hard -->", &table);
    }
}
