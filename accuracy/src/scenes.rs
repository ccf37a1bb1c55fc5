//! The scenes of the comparison.

use cagedyn::{Error, Result, Scene, Status};
use std::path::Path;

/// A value of a scene, by its path.
pub type Set<'a> = (&'a str, &'a str);

/// The heavy load.
pub const HEAVY: Set<'static> = ("inner_ring.motion.free.load.z.constant", "-40e3");

/// Number of rollers of the example.
const ROLLERS: f64 = 12.0;

/// The spring scene: gravity and the start of the cage beyond its place of rest, SI units.
const GRAVITY: f64 = 981.0;
const STIFFNESS: f64 = 1e6;
const AMPLITUDE: f64 = 8e-6;

/// A scene file with changes.
///
/// # Errors
/// [`Status::File`] and those of [`Scene::from_json_with`].
pub fn from_file(name: &str, sets: &[Set<'_>]) -> Result<Scene> {
    Scene::from_json_with(&read(&format!("scenes/{name}.json"))?, sets.iter().copied())
}

/// A file of the repository.
///
/// # Errors
/// [`Status::File`].
pub fn read(path: &str) -> Result<String> {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("..").join(path);
    std::fs::read_to_string(&path).map_err(|e| Error::new(Status::File, format!("{}: {e}", path.display())))
}

/// The example with changes.
///
/// # Errors
/// As [`from_file`].
pub fn nu2310(sets: &[Set<'_>]) -> Result<Scene> {
    from_file("nu2310", sets)
}

/// The cage that whirls.
///
/// # Errors
/// As [`from_file`].
pub fn grease_guide() -> Result<Scene> {
    from_file("grease_guide", &[])
}

/// The example with another number of rollers: radii, load, masses, speed grow or shrink so that every roller feels the
/// same.
///
/// # Errors
/// As [`from_file`].
pub fn rollers(count: u32) -> Result<Scene> {
    let factor = f64::from(count) / ROLLERS;
    let (radius, pitch) = (7.5e-3, 40e-3);
    let texts = [
        ("rollers.count", count.to_string()),
        ("outer_ring.raceway_radius", format!("{:e}", factor * pitch + radius)),
        ("inner_ring.speed.constant", format!("{:e}", -std::f64::consts::PI * 100.0 / factor)),
        ("inner_ring.motion.free.mass", format!("{:e}", 3.0 * factor)),
        ("inner_ring.motion.free.load.z.constant", format!("{:e}", -4900.0 * factor)),
        ("cage.mass", format!("{:e}", 0.37 * factor)),
        ("cage.inertia", format!("{:e}", 6.311e-4 * factor.powi(3))),
        // On the shoulder, which stays beside the rollers.
        ("cage.guide.guide_radius", format!("{:e}", factor * pitch + 5e-3)),
    ];
    let sets: Vec<Set<'_>> = texts.iter().map(|(path, value)| (*path, value.as_str())).collect();
    nu2310(&sets)
}

/// A cage pressed onto the spring of its guide by a steady acceleration, so hard that it never leaves it, and swinging
/// there: a harmonic oscillator.
///
/// # Errors
/// As [`from_file`].
pub fn spring() -> Result<Scene> {
    let mass = grease_guide()?.cage.map_or(0.0, |cage| cage.mass);
    let clearance = clearance()?;
    let start = clearance + mass * GRAVITY / STIFFNESS + AMPLITUDE;
    from_file(
        "grease_guide",
        &[
            ("gravity", &format!(r#"{{"y": {GRAVITY}, "z": 0}}"#)),
            ("cage.pocket", "null"),
            ("cage.guide.film", "null"),
            ("cage.guide.film_share", "null"),
            ("cage.guide.solid", &format!(r#"{{"contact": {{"stiffness": {STIFFNESS:e}}}}}"#)),
            ("initial", &format!(r#"{{"cage": {{"y": {start:e}, "z": 0}}}}"#)),
        ],
    )
}

/// Radial guide clearance of the spring scene, m.
fn clearance() -> Result<f64> {
    let guide = grease_guide()?.cage.and_then(|cage| cage.guide);
    Ok(guide.map_or(0.0, |guide| 0.5 * guide.diametral_clearance))
}

/// The state of the spring scene at time `t` in s, from its state at the start.
pub fn spring_motion(start: &[f64], t: f64) -> Vec<f64> {
    let mass = grease_guide().ok().and_then(|scene| scene.cage).map_or(f64::NAN, |cage| cage.mass);
    let rest = clearance().unwrap_or(f64::NAN) + mass * GRAVITY / STIFFNESS;
    let (frequency, amplitude) = ((STIFFNESS / mass).sqrt(), start[0] - rest);
    let (sin, cos) = (frequency * t).sin_cos();
    let turned = start[2] + start[5] * t;
    vec![rest + amplitude * cos, 0.0, turned, -amplitude * frequency * sin, 0.0, start[5]]
}

/// The twelve cases of the roller bearing.
///
/// # Errors
/// As [`from_file`].
pub fn twelve() -> Result<Vec<Scene>> {
    let bad = |e: serde_json::Error| Error::new(Status::BadJson, e.to_string());
    let set: serde_json::Value =
        serde_json::from_str(&read("scenes/nu2310_fig9.cases.json")?).map_err(bad)?;
    let cases = set["cases"].as_array().cloned().unwrap_or_default();
    let values = |case: &serde_json::Value| -> Vec<(String, String)> {
        let set = case["set"].as_object().cloned().unwrap_or_default();
        set.into_iter().map(|(path, value)| (path, value.to_string())).collect()
    };
    let scene = |case| {
        let values = values(case);
        nu2310(&values.iter().map(|(path, value)| (path.as_str(), value.as_str())).collect::<Vec<_>>())
    };
    cases.iter().map(scene).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::size::COUNTS;
    use cagedyn::Model;

    #[test]
    fn scenes_of_the_study_can_be_made() {
        let larger = COUNTS.into_iter().map(|count| rollers(count).unwrap());
        let others = [nu2310(&[]).unwrap(), grease_guide().unwrap(), spring().unwrap()];
        for scene in larger.chain(others).chain(twelve().unwrap()) {
            Model::new(scene).unwrap();
        }
    }
}
