//! The pages in `docs/` agree with the library: examples compile, error messages are the real ones, every field of
//! the formats is described, links lead somewhere.

use crate::common::{read, repository};
use cagedyn::scene::CaseSet;
use cagedyn::{Model, Recording, Scene, Sim};
use serde_json::Value;
use std::collections::{BTreeMap, BTreeSet};
use std::sync::Arc;

const SCENE_PAGE: &str = "docs/scene.md and the pages in docs/scene";

/// Types that `docs/scene.md` describes once, under these names.
const SHARED: [(&str, &str); 16] = [
    ("Signal", "<signal>"),
    ("PlaneVector", "<vector>"),
    ("ContactLaws", "<contact>"),
    ("SolidContact", "<solid>"),
    ("Friction", "<friction>"),
    ("Guide", "<guide>"),
    ("DropTable", "<drops>"),
    ("RadiusDeviations", "<deviations>"),
    ("WavinessHarmonic", "<wave>"),
    ("WavinessTable", "<heights>"),
    ("RoundPocket", "<round_pocket>"),
    ("FreeRing", "<free_ring>"),
    ("PlaneMotion", "<place>"),
    ("PlaneMatrix", "<matrix>"),
    ("Load", "<load>"),
    ("Unbalance", "<unbalance>"),
];

/// The page on scenes with those that it leads to.
fn scene_page() -> String {
    let parts = pages().into_iter().filter(|page| page == "docs/scene.md" || page.starts_with("docs/scene/"));
    parts.map(|page| read(&page)).collect::<Vec<_>>().join("\n")
}

/// Contents of the fenced blocks of one language.
pub fn fenced(page: &str, language: &str) -> Vec<String> {
    let mut blocks = Vec::new();
    let mut open: Option<(bool, String)> = None;
    for line in page.lines() {
        match (&mut open, line.strip_prefix("```")) {
            (None, Some(info)) => open = Some((info.trim() == language, String::new())),
            (Some(_), Some(_)) => {
                if let Some((true, text)) = open.take() {
                    blocks.push(text);
                }
            }
            (Some((_, text)), None) => {
                text.push_str(line);
                text.push('\n');
            }
            (None, None) => {}
        }
    }
    assert!(open.is_none(), "a fenced block is not closed");
    blocks
}

/// Lines outside of fenced blocks.
fn prose(page: &str) -> Vec<&str> {
    let mut inside = false;
    let mut lines = Vec::new();
    for line in page.lines() {
        if line.starts_with("```") {
            inside = !inside;
        } else if !inside {
            lines.push(line);
        }
    }
    lines
}

/// Texts between backticks.
fn code_spans(line: &str) -> impl Iterator<Item = &str> {
    line.split('`').skip(1).step_by(2)
}

/// The JSON blocks of the scene page that are whole documents: scenes and case sets.
fn documents() -> (Vec<String>, Vec<String>) {
    let whole = fenced(&scene_page(), "json").into_iter().filter(|text| text.contains("\"schema\""));
    whole.partition(|text| text.contains("cagedyn.scene/"))
}

#[test]
fn scenes_of_the_page_run() {
    let (scenes, _) = documents();
    for elements in ["rollers", "kinematic_elements"] {
        assert!(scenes.iter().any(|text| text.contains(elements)), "no scene with {elements}");
    }
    for text in &scenes {
        let model = Model::from_json(text).unwrap_or_else(|e| panic!("{e}\n{text}"));
        let mut sim = Sim::new(Arc::new(model)).unwrap_or_else(|e| panic!("{e}\n{text}"));
        let record = sim.model().scene().record.clone();
        let result = Recording::default().run(&mut sim, record.duration, record.interval, |_, _| true);
        result.unwrap_or_else(|e| panic!("{e}\n{text}"));
    }
}

#[test]
fn case_sets_of_the_page_fit_its_first_scene() {
    let (scenes, sets) = documents();
    assert!(!sets.is_empty());
    for text in &sets {
        let set = CaseSet::from_json(text).unwrap_or_else(|e| panic!("{e}\n{text}"));
        for scene in set.scenes(&scenes[0]).unwrap_or_else(|e| panic!("{e}\n{text}")) {
            Model::new(scene).unwrap_or_else(|e| panic!("{e}\n{text}"));
        }
    }
}

#[test]
fn every_json_block_is_json() {
    for page in pages() {
        for text in fenced(&read(&page), "json") {
            serde_json::from_str::<Value>(&text).unwrap_or_else(|e| panic!("{page}: {e}\n{text}"));
        }
    }
}

/// A `text` block with lines `--set path=value` shows the messages of these changes of the first scene.
#[test]
fn error_messages_of_the_page_are_real() {
    let base = &documents().0[0];
    let mut shown = 0;
    for block in fenced(&scene_page(), "text") {
        let lines: Vec<&str> = block.lines().filter(|line| !line.is_empty()).collect();
        if !lines.first().is_some_and(|line| line.starts_with("--set ")) {
            continue;
        }
        for pair in lines.chunks(2) {
            let [change, message] = pair else { panic!("no message after {pair:?}") };
            let change = change.strip_prefix("--set ").expect("a change");
            let change = change.split_once('=').expect("path=value");
            let error = Scene::from_json_with(base, [change]).and_then(Model::new).expect_err(change.0);
            assert_eq!(&error.message, message, "{}", change.0);
            shown += 1;
        }
    }
    assert!(shown > 0);
}

/// An `sh` block with lines `--set path=value` shows changes of the example scene as a shell takes them.
#[test]
fn overrides_of_the_page_work() {
    let base = read("scenes/nu2310.json");
    let mut shown = 0;
    for block in fenced(&scene_page(), "sh") {
        for change in block.lines().filter_map(|line| line.strip_prefix("--set ")) {
            let (path, value) = change.split_once('=').expect("path=value");
            let scene = Scene::from_json_with(&base, [(path, value.trim_matches('\''))]);
            scene.and_then(Model::new).unwrap_or_else(|e| panic!("{change}: {e}"));
            shown += 1;
        }
    }
    assert!(shown > 0);
}

/// Paths of all fields below a schema with "needed", "optional" or "one of", and all words that are allowed values.
struct Fields<'a> {
    defs: &'a Value,
    paths: BTreeMap<String, &'static str>,
    words: BTreeSet<String>,
}

impl Fields<'_> {
    fn walk(&mut self, schema: &Value, at: &str, choice: bool) {
        if let Some(target) = schema["$ref"].as_str() {
            let name = target.strip_prefix("#/$defs/").expect("a local reference");
            let shared = SHARED.iter().find(|(shared, _)| *shared == name);
            if shared.is_none_or(|(_, root)| *root == at) {
                self.walk(&self.defs[name], at, choice);
            }
        }
        if let Some(word) = schema["const"].as_str() {
            self.words.insert(word.to_owned());
        }
        for word in schema["enum"].as_array().into_iter().flatten() {
            self.words.extend(word.as_str().map(str::to_owned));
        }
        for (key, choice) in [("oneOf", true), ("anyOf", choice)] {
            for part in schema[key].as_array().into_iter().flatten() {
                self.walk(part, at, choice);
            }
        }
        let below = |name: &str| if at.is_empty() { name.to_owned() } else { format!("{at}.{name}") };
        let required =
            |name: &str| schema["required"].as_array().is_some_and(|r| r.iter().any(|x| x == name));
        for (name, part) in schema["properties"].as_object().into_iter().flatten() {
            let need = match (choice, required(name)) {
                (true, _) => "one of",
                (false, true) => "needed",
                (false, false) => "optional",
            };
            self.paths.insert(below(name), need);
            self.walk(part, &below(name), false);
        }
        self.walk_if_object(&schema["additionalProperties"], &below("<name>"));
        self.walk_if_object(&schema["items"], &below("<i>"));
    }

    fn walk_if_object(&mut self, schema: &Value, at: &str) {
        if schema.is_object() {
            self.walk(schema, at, false);
        }
    }
}

/// The fields described in the page's tables: those whose first column is headed "field". Names continue the path
/// that the section's title gives as code.
fn described(page: &str) -> BTreeMap<String, String> {
    let mut fields = BTreeMap::new();
    let (mut base, mut in_table) = (String::new(), false);
    for line in prose(page) {
        let cells: Vec<&str> = line.split('|').map(str::trim).collect();
        if line.starts_with('#') {
            base = code_spans(line).last().unwrap_or_default().to_owned();
        }
        if !line.starts_with('|') {
            in_table = false;
        } else if cells[1] == "field" {
            in_table = true;
        } else if in_table && cells[1].starts_with('`') {
            let name = cells[1].trim_matches('`');
            let path = if base.is_empty() { name.to_owned() } else { format!("{base}.{name}") };
            let double = fields.insert(path, cells[4].to_owned());
            assert!(double.is_none(), "described twice: {line}");
        }
    }
    fields
}

#[test]
fn the_page_describes_every_field_and_no_other() {
    let page = scene_page();
    let spans: BTreeSet<&str> = prose(&page).into_iter().flat_map(code_spans).collect();
    let mut paths = BTreeMap::new();
    for (schema, root) in [(Scene::JSON_SCHEMA, ""), (CaseSet::JSON_SCHEMA, "<cases>")] {
        let schema: Value = serde_json::from_str(schema).expect("a schema is JSON");
        let defs = &schema["$defs"];
        let mut fields = Fields { defs, paths: BTreeMap::new(), words: BTreeSet::new() };
        fields.walk(&schema, root, false);
        for (name, root) in SHARED.iter().filter(|(name, _)| defs[*name].is_object()) {
            fields.walk(&defs[*name], root, false);
        }
        for word in &fields.words {
            assert!(spans.contains(word.as_str()), "`{word}` is not in {SCENE_PAGE}");
        }
        // Every object may have these; one sentence of the page says so.
        let remark = |path: &str| ["comment", "$schema"].contains(&path.rsplit('.').next().unwrap_or(path));
        let fields = fields.paths.into_iter().filter(|(path, _)| !remark(path));
        paths.extend(fields.map(|(path, need)| (path, need.to_owned())));
    }
    let told = described(&page);
    let missing: Vec<&String> = paths.keys().filter(|path| !told.contains_key(*path)).collect();
    let unknown: Vec<&String> = told.keys().filter(|path| !paths.contains_key(*path)).collect();
    assert!(missing.is_empty() && unknown.is_empty(), "missing: {missing:#?}\nunknown: {unknown:#?}");
    assert_eq!(told, paths);
}

#[test]
fn every_dependency_has_its_reason() {
    let page = read("docs/dependencies.md");
    let mut in_list = false;
    let mut names = BTreeSet::new();
    let manifests = ["Cargo.toml", "accuracy/Cargo.toml", "studies/Cargo.toml"].map(read).concat();
    for line in manifests.lines() {
        if line.starts_with('[') {
            in_list = line.ends_with("dependencies]");
        } else if in_list
            && let Some((name, _)) = line.split_once(" = ")
            && !name.starts_with("cagedyn")
        {
            assert!(page.contains(&format!("| `{name}` |")), "{name} is not in docs/dependencies.md");
            names.insert(name.to_owned());
        }
    }
    let rows = page.lines().filter(|line| line.starts_with("| `")).count();
    assert_eq!(rows, names.len(), "docs/dependencies.md lists something that Cargo.toml does not");
}

/// README and its kin and the pages in `docs/` and below, relative to the repository.
fn pages() -> Vec<String> {
    let mut pages: Vec<String> =
        ["README.md", "ARCHITECTURE.md", "CONTRIBUTING.md"].map(ToOwned::to_owned).into();
    let mut folders = vec!["docs".to_owned()];
    while let Some(folder) = folders.pop() {
        for entry in std::fs::read_dir(repository(&folder)).expect("the repository has docs").flatten() {
            let name = format!("{folder}/{}", entry.file_name().to_str().expect("UTF-8"));
            if entry.path().is_dir() {
                folders.push(name);
            } else if name.ends_with(".md") {
                pages.push(name);
            }
        }
    }
    pages.sort();
    pages
}

/// Targets of the links and pictures of a page: `](target)`, `href="target"` and `src="target"`.
pub fn links(page: &str) -> Vec<&str> {
    let mut targets = Vec::new();
    for line in prose(page) {
        for (start, end) in [("](", ')'), ("href=\"", '"'), ("src=\"", '"')] {
            targets.extend(line.split(start).skip(1).filter_map(|rest| rest.split(end).next()));
        }
    }
    targets
}

/// The anchor that GitHub gives to a heading.
fn anchor(heading: &str) -> String {
    let text = heading.trim_start_matches('#').trim().to_lowercase();
    text.chars()
        .filter(|c| c.is_alphanumeric() || " -_".contains(*c))
        .map(|c| if c == ' ' { '-' } else { c })
        .collect()
}

#[test]
fn relative_links_lead_somewhere() {
    for page in pages() {
        let folder = repository(&page).parent().expect("a folder").to_owned();
        let text = read(&page);
        for link in links(&text).into_iter().filter(|link| !link.contains("://")) {
            let (file, place) =
                link.split_once('#').map_or((link, None), |(file, place)| (file, Some(place)));
            let target = if file.is_empty() { repository(&page) } else { folder.join(file) };
            assert!(target.exists(), "{page}: {link} does not exist");
            if let Some(place) = place.filter(|_| target.extension().is_some_and(|e| e == "md")) {
                let target = std::fs::read_to_string(&target).expect("readable");
                let found = prose(&target).iter().any(|l| l.starts_with('#') && anchor(l) == place);
                assert!(found, "{page}: {link} has no such heading");
            }
        }
    }
}
