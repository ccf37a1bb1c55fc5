//! Every combination of parts, and NU2310 without each of its laws, against CVODE over their first impacts.

use crate::cases::Case;
use crate::common::parts::{all, scene};
use crate::common::{example, example_with};
use cagedyn::Model;
use cagedyn_studies::cvode::Method;
use serde_json::Value;

const TOLERANCE: f64 = 1e-8;
/// Largest step of all methods, s: no contact is jumped over.
const STEP: f64 = 2e-6;

fn case(name: &'static str, scene: Value) -> Case {
    Case { name, scene, duration: 0.2e-3, reference_step: 0.5 * STEP, max_step: STEP }
}

/// Errors of CVODE, Rosenbrock and Dormand-Prince at the same tolerance, in units of the clearance.
fn errors(case: &Case) -> [f64; 3] {
    let reference = case.cvode(Method::Bdf, 1e-12, 1e-12, case.reference_step);
    let theirs = case.cvode(Method::Bdf, 0.0, TOLERANCE, STEP);
    let [rosenbrock, explicit] =
        ["rosenbrock", "dormand_prince"].map(|method| case.controlled(method, TOLERANCE));
    [&theirs, &rosenbrock, &explicit].map(|end| case.distance(end, &reference))
}

/// Our errors are at most five times those of CVODE at its worst.
fn compare(name: &str, cases: Vec<(String, Case)>) {
    let found: Vec<_> = cases.iter().map(|(what, case)| (what, errors(case))).collect();
    let worst = |k: usize| found.iter().map(|(_, e)| e[k]).fold(0.0, f64::max);
    let [theirs, rosenbrock, explicit] = [0, 1, 2].map(worst);
    println!(
        "{name}: {} scenes, largest error of CVODE {theirs:.1e}, Rosenbrock {rosenbrock:.1e}, \
         Dormand-Prince {explicit:.1e}",
        found.len()
    );
    for (what, [_, rosenbrock, explicit]) in found {
        assert!(rosenbrock.max(explicit) < 5.0 * theirs, "{what}: {rosenbrock:e} {explicit:e}");
    }
}

#[test]
fn every_combination_of_parts_agrees_with_cvode() {
    let cases = all().into_iter().map(|parts| (format!("{parts:?}"), case("combination", scene(parts))));
    compare("combinations", cases.collect());
}

#[test]
fn every_law_alone_and_left_out_agrees_with_cvode() {
    let laws = [
        "raceways.contact.film",
        "raceways.contact.thermal_correction",
        "raceways.contact.traction",
        "raceways.contact.self_heating",
        "raceways.contact.boundary_friction",
        "raceways.contact.damping",
        "raceways.rolling_resistance",
        "cage.pocket.lubricated_cylinder.contact.damping",
        "cage.pocket.lubricated_cylinder.contact.boundary_friction",
        "cage.guide.film",
        "cage.guide",
        "cage.pocket",
    ];
    let without = |left_out: &[&str]| {
        let changes: Vec<_> = left_out.iter().map(|path| (*path, Value::Null)).collect();
        example_with(&changes)
    };
    let mut cases = vec![("all laws".to_owned(), case("NU2310", example()))];
    for law in laws {
        let others: Vec<&str> = laws.into_iter().filter(|other| !law.starts_with(other)).collect();
        cases.push((format!("without {law}"), case("NU2310", without(&[law]))));
        let alone: Vec<&str> = others
            .iter()
            .copied()
            .filter(|o| !others.iter().any(|p| o.len() > p.len() && o.starts_with(p)))
            .collect();
        cases.push((format!("{law} alone"), case("NU2310", without(&alone))));
    }
    // Some laws need others.
    let possible = |case: &Case| Model::from_json(&case.scene.to_string()).is_ok();
    cases.retain(|(_, case)| possible(case));
    assert!(cases.len() > 12, "{} scenes", cases.len());
    compare("laws", cases);
}
