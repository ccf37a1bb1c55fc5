use super::*;
use std::time::Instant;

fn scene(name: &str, changes: &[(&str, &str)]) -> Scene {
    let path = format!("{}/scenes/{name}.json", env!("CARGO_MANIFEST_DIR"));
    Scene::from_json_with(&std::fs::read_to_string(path).unwrap(), changes.iter().copied()).unwrap()
}

#[test]
fn the_averaged_whirl_is_that_of_an_independent_prototype() {
    let whirl = steady(&scene("grease_guide", &[]), None).unwrap();
    assert!((whirl.speed / -1962.12 - 1.0).abs() < 1e-4, "{whirl:?}");
    assert!(whirl.stable() && (whirl.eigenvalues[0][0] / -291.0 - 1.0).abs() < 0.005, "{whirl:?}");
    assert_eq!((whirl.arcs, whirl.eigenvalues.len()), (1, 5));
    let fast = ("inner_ring.speed.constant", "837.758");
    let whirl = steady(&scene("grease_guide", &[fast]), None).unwrap();
    assert!((whirl.speed / -3322.7 - 1.0).abs() < 5e-4, "{whirl:?}");
}

#[test]
fn averaging_is_a_thousandth_fast() {
    let rigid = scene("grease_guide", &[]);
    let averaged = steady(&rigid, None).unwrap();
    let found = exact(&rigid, &averaged).unwrap();
    assert!((found.speed / -1959.87 - 1.0).abs() < 1e-4, "{found:?}");
    assert!((found.leading_rate / -294.0 - 1.0).abs() < 0.01, "{found:?}");
    let elastic = scene("grease_guide_elastic", &[]);
    let averaged = steady(&elastic, None).unwrap();
    let found = exact(&elastic, &averaged).unwrap();
    let fast = averaged.speed / found.speed - 1.0;
    assert!((1e-3..1e-2).contains(&fast), "{found:?}");
}

#[test]
fn an_elastic_cage_whirls_with_its_waves() {
    let whirl = steady(&scene("grease_guide_elastic", &[]), None).unwrap();
    assert!((whirl.speed / -1732.28 - 1.0).abs() < 1e-3, "{whirl:?}");
    assert!((whirl.eccentricity / 209.36e-6 - 1.0).abs() < 1e-3, "{whirl:?}");
    for (found, expected) in whirl.amplitudes.iter().zip([96.62e-6, 18.52e-6, 2.23e-6]) {
        assert!((found / expected - 1.0).abs() < 1e-2, "{whirl:?}");
    }
    assert!(whirl.stable() && whirl.eigenvalues.len() == 5 + 12, "{whirl:?}");
}

#[test]
fn a_branch_over_speed_has_no_fold_and_is_stable() {
    let started = Instant::now();
    let base = scene("grease_guide", &[]);
    let with = |scene: &Scene, speed: f64| {
        let mut scene = scene.clone();
        if let Some(ring) = &mut scene.inner_ring {
            ring.speed = crate::scene::Signal::Constant(speed);
        }
        Ok(scene)
    };
    let mut told = 0;
    let branch = follow(&base, [52.36, 837.76], with, |_| told += 1).unwrap();
    assert_eq!((branch.end.name(), told), ("range", branch.points.len()));
    assert!(branch.points.iter().all(|point| point.whirl.stable() && !point.fold && !point.hopf));
    assert!(branch.points.len() > 10);
    println!("{} points in {:?}", branch.points.len(), started.elapsed());
    let last = branch.points.last().unwrap();
    assert!((last.whirl.speed / -3322.7 - 1.0).abs() < 2e-3, "{last:?}");
}

#[test]
fn what_has_no_steady_whirl_is_refused() {
    for (scene, says) in [
        (scene("nu2310", &[]), "rollers"),
        (scene("grease_guide", &[("cage.mass_eccentricity", r#"{"y": 1e-5, "z": 0}"#)]), "mass_eccentricity"),
        (scene("grease_guide", &[("cage.guide", "null")]), "cage.guide"),
    ] {
        let error = steady(&scene, None).unwrap_err();
        assert!(error.message.starts_with(says) || error.message.contains(says), "{error}");
    }
}
