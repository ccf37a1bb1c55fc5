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
    for (i, line) in lines.iter().enumerate() {
        let starts_declaration = !line.starts_with([' ', '#', '/', '}']) && line.contains('(');
        if starts_declaration {
            let name = line.split('(').next().and_then(|head| head.rsplit([' ', '*']).next()).unwrap_or(line);
            assert!(name.starts_with("cagedyn_"), "{line}");
            assert!(names.insert(name), "declared twice: {line}");
            assert!(lines[i - 1].starts_with("//"), "undocumented: {line}");
        }
    }
    assert!(names.len() >= 63, "{} functions", names.len());
}
