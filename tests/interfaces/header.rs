//! The committed C header is what cbindgen makes of the sources.
//!
//! `make header` writes it anew.

use std::collections::BTreeSet;
use std::path::Path;

fn generated() -> String {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let config = cbindgen::Config::from_root_or_default(root);
    let mut header = Vec::new();
    cbindgen::Builder::new()
        .with_config(config)
        .with_src(root.join("src/capi/mod.rs"))
        .generate()
        .expect("the sources of the C ABI parse")
        .write(&mut header);
    let text = String::from_utf8(header).expect("UTF-8");
    // Rust's safety sections repeat what the conventions at the top of the header say for every function.
    let mut kept: Vec<&str> = Vec::new();
    let mut in_safety = false;
    for line in text.lines() {
        in_safety = (in_safety || line == "// # Safety") && line.starts_with("//");
        if in_safety {
            if kept.last() == Some(&"//") {
                kept.pop();
            }
        } else {
            kept.push(line);
        }
    }
    kept.join("\n") + "\n"
}

#[test]
fn committed_header_is_current() {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("include/cagedyn.h");
    let header = generated();
    if std::env::var_os("CAGEDYN_BLESS").is_some() {
        std::fs::write(&path, &header).expect("include/ can be written");
    }
    let committed = std::fs::read_to_string(&path).unwrap_or_default();
    assert!(committed == header, "include/cagedyn.h is stale; run: make header");
}

#[test]
fn every_function_is_documented_and_prefixed_and_declared_once() {
    let header = generated();
    let lines: Vec<&str> = header.lines().collect();
    let mut names = BTreeSet::new();
    for (i, name) in declarations(&header) {
        assert!(name.starts_with("cagedyn_"), "{name}");
        assert!(names.insert(name), "declared twice: {name}");
        assert!(lines[i - 1].starts_with("//"), "undocumented: {name}");
    }
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("src/capi");
    let sources = std::fs::read_dir(folder).expect("the C ABI").flatten();
    let sources = sources.map(|entry| std::fs::read_to_string(entry.path()).expect("a source"));
    let made: usize = sources.map(|text| text.matches("#[unsafe(no_mangle)]").count()).sum();
    assert_eq!(names.len(), made, "functions of the sources are missing in the header");
}

/// Lines and names of the functions that a header declares.
fn declarations(header: &str) -> impl Iterator<Item = (usize, &str)> {
    let starts = header.lines().enumerate();
    let starts = starts.filter(|(_, line)| !line.starts_with([' ', '#', '/', '}']) && line.contains('('));
    starts.filter_map(|(i, line)| Some((i, line.split('(').next()?.rsplit([' ', '*']).next()?)))
}

/// Names of the functions that a header declares.
pub fn functions(header: &str) -> BTreeSet<&str> {
    declarations(header).map(|(_, name)| name).collect()
}
