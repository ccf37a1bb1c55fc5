//! A bounded run of fuzzing on its committed corpus, without the tools of fuzzing: texts with changes drawn at random are taken, or
//! refused in one line. `CAGEDYN_FUZZED` sets another number of texts.

use cagedyn::{Error, Model, Scene, Sim};
use fastrand::Rng;
use std::sync::Arc;

const TEXTS: u64 = 4000;
/// Wall time of a run that a changed scene is given, s.
const PATIENCE: f64 = 2e-3;
/// What a number or a word of a text is replaced by.
const REPLACEMENTS: [&str; 16] = [
    "0",
    "-1",
    "1e-300",
    "1e308",
    "-1e400",
    "NaN",
    "null",
    "true",
    "\"\"",
    "[]",
    "{}",
    "4294967296",
    "0.5",
    "1e-6",
    "\u{00e9}",
    "\"inf\"",
];

fn corpus(target: &str) -> Vec<String> {
    let folder = format!("{}/fuzz/corpus/{target}", env!("CARGO_MANIFEST_DIR"));
    let mut paths: Vec<_> =
        std::fs::read_dir(folder).expect("a corpus").flatten().map(|file| file.path()).collect();
    paths.sort();
    paths.iter().map(|path| std::fs::read_to_string(path).expect("a text")).collect()
}

/// What a number is multiplied by instead.
const FACTORS: [f64; 6] = [0.1, 0.5, 0.99, 1.01, 3.0, 1e3];

/// One to four changes: a number scaled, a token replaced, a piece left out or doubled, a part of another text.
fn changed(rng: &mut Rng, texts: &[String]) -> String {
    let mut text: Vec<char> = rng.choice(texts).expect("a text").chars().collect();
    for _ in 0..[1, 1, 2, 4][rng.usize(0..4)] {
        let place = |rng: &mut Rng, text: &[char]| rng.usize(0..=text.len());
        let (from, to) = (place(rng, &text), place(rng, &text));
        let (from, to) = (from.min(to), from.max(to).min(from + 200));
        match rng.u32(0..16) {
            0..12 => {
                // A whole token from there on.
                let is_part = |c: &char| c.is_alphanumeric() || "+-._\"".contains(*c);
                let start = (from..text.len()).find(|i| is_part(&text[*i])).unwrap_or(text.len());
                let end = (start..text.len()).find(|i| !is_part(&text[*i])).unwrap_or(text.len());
                let token: String = text[start..end].iter().collect();
                let with = match token.parse::<f64>() {
                    Ok(number) if rng.u32(0..4) > 0 => {
                        format!("{:?}", number * rng.choice(FACTORS).expect("a factor"))
                    }
                    _ => (*rng.choice(REPLACEMENTS).expect("a replacement")).to_owned(),
                };
                text.splice(start..end, with.chars());
            }
            12 => drop(text.drain(from..to)),
            13 => {
                let piece = text[from..to].to_vec();
                let at = place(rng, &text);
                text.splice(at..at, piece);
            }
            14 => {
                let other: Vec<char> = rng.choice(texts).expect("a text").chars().collect();
                let start = rng.usize(0..other.len());
                let end = (start + rng.usize(0..200)).min(other.len());
                text.splice(from..to, other[start..end].to_vec());
            }
            _ => text.truncate(to),
        }
    }
    text.into_iter().collect()
}

fn told(e: &Error) -> bool {
    !e.message.is_empty() && !e.message.contains('\n')
}

fn texts() -> u64 {
    std::env::var("CAGEDYN_FUZZED").ok().and_then(|n| n.parse().ok()).unwrap_or(TEXTS)
}

/// Refused in one line, or compiled and started; whether it was taken.
fn scene(text: &str) -> bool {
    match Model::from_json(text) {
        Err(e) => {
            assert!(told(&e), "{text}: {e:?}");
            false
        }
        Ok(model) => {
            if model.element_count() <= 100
                && let Ok(mut sim) = Sim::new(Arc::new(model))
            {
                sim.set_wall_time_limit(PATIENCE).expect("a limit");
                let _ = sim.advance_to(1e-5);
                assert!(sim.state().iter().all(|x| x.is_finite()), "{text}");
            }
            true
        }
    }
}

#[test]
fn changed_scenes_are_refused_in_one_line_or_run() {
    let scenes = corpus("scene");
    assert!(scenes.len() > 4);
    assert!(scenes.iter().all(|text| scene(text)));
    let mut rng = Rng::with_seed(1);
    let taken = (0..texts()).filter(|_| scene(&changed(&mut rng, &scenes))).count() as u64;
    println!("{taken} of {} changed scenes were taken", texts());
    // Neither all of one nor all of the other: changes reach what is behind the reader.
    assert!(taken > texts() / 50 && taken < texts() / 2, "{taken}");
}

#[test]
fn changed_replacements_are_refused_in_one_line_or_give_a_scene() {
    let lists = corpus("overrides");
    assert!(lists.len() > 1);
    let mut rng = Rng::with_seed(2);
    let changed = (0..texts()).map(|_| changed(&mut rng, &lists)).collect::<Vec<_>>();
    let mut taken = 0;
    for text in lists.iter().chain(&changed) {
        let pairs = text.lines().filter_map(|line| line.split_once('='));
        match Scene::from_json_with(include_str!("../../scenes/nu2310.json"), pairs) {
            Err(e) => assert!(told(&e), "{text}: {e:?}"),
            Ok(scene) => {
                assert_eq!(Scene::from_json(&scene.to_json()).expect("a scene"), scene);
                taken += 1;
            }
        }
    }
    assert!(taken > 0 && taken < changed.len());
}

#[test]
fn changed_snapshots_are_refused_or_gone_on_from() {
    let model = Arc::new(Model::from_json(include_str!("../../scenes/grease_guide.json")).expect("a scene"));
    let mut sim = Sim::new(model.clone()).expect("a simulation");
    sim.advance_to(1e-4).expect("a step");
    let saved = sim.save();
    let mut rng = Rng::with_seed(3);
    let mut refused = 0;
    for _ in 0..texts() / 8 {
        let mut sim = Sim::new(model.clone()).expect("a simulation");
        sim.restore(&saved).expect("what was saved");
        let (mut changed, state) = (saved.clone(), sim.state().to_vec());
        for _ in 0..rng.usize(1..4) {
            let place = rng.usize(0..changed.len());
            changed[place] =
                [f64::NAN, f64::from_bits(rng.u64(..)), 1e9, -1.0, changed[place] * 1.01][rng.usize(0..5)];
        }
        if sim.restore(&changed).is_err() {
            assert_eq!(sim.state(), state);
            refused += 1;
        }
        sim.set_wall_time_limit(PATIENCE).expect("a limit");
        let _ = sim.advance_to(sim.time() + 1e-5);
    }
    assert!(refused > 0 && refused < texts() / 8, "{refused}");
}
