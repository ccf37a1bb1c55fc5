//! Any lines as replacements in a good scene.
#![no_main]

use cagedyn::Scene;
use libfuzzer_sys::fuzz_target;

fuzz_target!(|text: &str| {
    let pairs = text.lines().filter_map(|line| line.split_once('='));
    match Scene::from_json_with(include_str!("../../scenes/nu2310.json"), pairs) {
        Err(e) => assert!(!e.message.is_empty() && !e.message.contains('\n')),
        // What is accepted can be written and read again.
        Ok(scene) => assert_eq!(Scene::from_json(&scene.to_json()).expect("a scene"), scene),
    }
});
