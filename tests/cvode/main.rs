//! The library's methods against CVODE of SUNDIALS, which integrates [`cagedyn::Sim::derivative`]. Errors are differences
//! of positions in units of the guide clearance. What is found is told in `docs/results/verification.md`.

#[path = "../common/mod.rs"]
mod common;

mod cases;
mod combinations;
mod driver;
mod space;
mod tables;
mod whirl;

use cagedyn_studies::cvode::Method;
use cases::{DRY, GREASED, SHORT_STEP, contacts, pressed, smooth, thick};
use serde_json::json;

/// Tolerances at which methods with error control are compared.
const LEVELS: [f64; 3] = [1e-4, 1e-6, 1e-8];
/// The methods with error control, by their names in scenes and in words.
const METHODS: [(&str, &str); 5] = [
    ("dormand_prince", "Dormand-Prince"),
    ("adams", "Adams"),
    ("rosenbrock", "Rosenbrock"),
    ("radau", "Radau"),
    ("auto", "auto"),
];
/// Steps of given size on the pressed cage.
const FIXED_SHARES: [f64; 4] = [125.0, 250.0, 500.0, 1000.0];

fn short(figures: &[f64]) -> String {
    figures.iter().map(|x| format!("{x:.1e}")).collect::<Vec<_>>().join(" ")
}

/// Orders from errors with steps that shrink by `ratio` from run to run.
fn orders(errors: &[f64], ratio: f64) -> Vec<f64> {
    errors.windows(2).map(|e| (e[0] / e[1]).log(ratio)).collect()
}

#[test]
fn smooth_motion_agrees_with_cvode() {
    for case in smooth().into_iter().chain([thick()]) {
        let reference = case.reference();
        let doubt = reference.doubt;
        assert!(doubt < 1e-9, "{}: two methods of CVODE differ by {doubt:e}", case.name);
        for (method, _) in METHODS {
            let error = |level: f64| case.distance(&case.controlled(method, level), &reference.end);
            let levels = LEVELS.map(error);
            let finest = error(1e-12);
            println!("{}, {method}: {}, {finest:.1e}; doubt {doubt:.1e}", case.name, short(&levels));
            assert!(levels[2] < 0.1 * levels[0], "{}, {method}: {levels:?}", case.name);
            assert!(finest < 1e-9, "{}, {method}: {finest:e} of the clearance", case.name);
        }
    }
}

#[test]
fn the_leapfrog_is_of_second_order() {
    for case in smooth() {
        let reference = case.reference().end;
        let errors = [4e3, 8e3, 16e3].map(|n| case.distance(&case.leapfrog(case.duration / n), &reference));
        let found = orders(&errors, 2.0);
        println!("{}, leapfrog: orders {found:.2?}, errors {}", case.name, short(&errors));
        assert!(found.iter().all(|order| (order - 2.0).abs() < 0.2), "{}: {found:?}", case.name);
    }
}

#[test]
fn methods_with_error_control_have_their_order() {
    let case = pressed();
    let reference = case.exact();
    for (method, order) in [("dormand_prince", 5.0), ("rosenbrock", 4.0)] {
        let errors = FIXED_SHARES.map(|n| case.distance(&case.fixed(method, case.duration / n), &reference));
        let found = orders(&errors, 2.0);
        println!("{method}: orders {found:.2?}, errors {}", short(&errors));
        assert!(found.iter().all(|found| *found > order - 0.2), "{method}: {found:?}");
        assert!((found[2] - order).abs() < 0.2, "{method}: {found:?}");
    }
}

/// Without the derivative of a warming film over time the order would be 1, and the errors hundreds of times larger.
#[test]
fn rosenbrock_follows_films_that_warm() {
    let temperature = json!({"sine": {"mean": 333.15, "amplitude": 20.0, "frequency": 50.0, "phase": 0.2}});
    let viscosity = json!({"walther": {
        "cold": {"temperature": 313.15, "kinematic_viscosity": 105e-6},
        "hot": {"temperature": 373.15, "kinematic_viscosity": 12e-6},
        "density": 880.0, "temperature": {"over_time": temperature}
    }});
    for case in smooth() {
        let scene = common::with(&case.scene, &[("lubricant.viscosity", viscosity.clone())]);
        let case = cases::Case { scene, ..case };
        let reference = case.reference().end;
        let errors = [200.0, 400.0, 800.0]
            .map(|n| case.distance(&case.fixed("rosenbrock", case.duration / n), &reference));
        let found = orders(&errors, 2.0);
        println!("{}, warming: orders {found:.2?}, errors {}", case.name, short(&errors));
        assert!(found.iter().all(|order| *order > 2.0), "{}: {found:?}", case.name);
        assert!(errors[2] < 5e-8, "{}: {errors:?}", case.name);
    }
}

#[test]
fn errors_through_contacts_are_like_those_of_cvode() {
    for case in contacts() {
        let reference = case.reference();
        let error = |end: &cases::End| case.distance(end, &reference.end);
        let doubt = reference.doubt;
        assert!(doubt < 1e-6, "{}: two methods of CVODE differ by {doubt:e}", case.name);
        let theirs = LEVELS.map(|level| {
            [Method::Bdf, Method::Adams].map(|m| error(&case.cvode(m, 0.0, level, case.max_step)))
        });
        let mut coarsest = 0.0f64;
        for (method, _) in METHODS {
            let ours = LEVELS.map(|level| error(&case.controlled(method, level)));
            println!("{}, {method}: {}", case.name, short(&ours));
            for ((level, here), theirs) in LEVELS.iter().zip(&ours).zip(&theirs) {
                let bound = 5.0 * theirs[0].max(theirs[1]);
                let what = || format!("{}, {method} at {level:e}: {here:e}, CVODE {theirs:?}", case.name);
                assert!(*here < bound, "{}", what());
            }
            // Short steps are more accurate than a coarse tolerance asks for.
            let finest = if case.name == DRY { error(&case.controlled(method, 1e-12)) } else { ours[2] };
            // `auto` also keeps the energy, so at a coarse tolerance it is better than what it chooses from.
            coarsest = coarsest.max(ours[0]);
            let coarse = if method == "auto" { coarsest } else { ours[0] };
            assert!(finest < 0.1 * coarse, "{}, {method}: {ours:?}, {finest:e}", case.name);
        }
        println!("{}: CVODE {}", case.name, short(theirs.as_flattened()));
        let leapfrog = [4e-6, 1e-6, 2.5e-7].map(|h| error(&case.leapfrog(h)));
        println!("{}: leapfrog {}, doubt {doubt:.1e}", case.name, short(&leapfrog));
        assert!(leapfrog[2] < 0.3 * leapfrog[0], "{}: leapfrog {leapfrog:?}", case.name);
    }
}

/// The cage on the dry guide bounces, and its second contact lasts 7 us; on the greased guide it meets a pocket at 12 um/s for 9 us
/// at 8.01 ms. Error control that looks at a few places of a step can miss them; CVODE does, too.
#[test]
fn only_the_length_of_a_step_bounds_what_it_jumps_over() {
    let named = |name: &str| contacts().into_iter().find(|case| case.name == name).expect("such a case");
    jumps_over(&named(DRY), [2e-6, 1e-8]);
    let soft = cases::Case { duration: 10e-3, max_step: SHORT_STEP, ..named(GREASED) };
    jumps_over(&soft, [5e-5, 1e-7]);
}

/// With short steps errors are at most `allowed`, at any tolerance from 1e-8 on and at 1e-12.
fn jumps_over(limited: &cases::Case, allowed: [f64; 2]) {
    let free = cases::Case { max_step: cases::MAX_STEP, scene: limited.scene.clone(), ..*limited };
    let reference = limited.reference().end;
    let theirs = free.distance(&free.cvode(Method::Adams, 0.0, 1e-8, free.max_step), &reference);
    println!("{}: CVODE, Adams, 1e-8: {theirs:.1e}", limited.name);
    assert!(theirs > 1e-5, "the bounce is met: {theirs:e}");
    for (method, _) in METHODS {
        let mut worst: f64 = 0.0;
        for tolerance in [1e-8, 1e-9, 1e-10, 1e-11, 1e-12] {
            let [free, limited] =
                [&free, limited].map(|case| case.distance(&case.controlled(method, tolerance), &reference));
            println!("{method}, {tolerance:e}: {free:.1e}, with short steps {limited:.1e}");
            assert!(limited < allowed[0], "{method}, {tolerance:e}: {limited:e}");
            assert!(tolerance > 1e-12 || limited < allowed[1], "{method}, {tolerance:e}: {limited:e}");
            worst = worst.max(free);
        }
        assert!(worst < 1e-3, "{method}: {worst:e}");
    }
}
