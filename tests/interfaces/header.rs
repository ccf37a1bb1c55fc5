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
    let (mut kept, mut lines) = (Vec::new(), text.lines());
    while let Some(line) = lines.next() {
        if line == "/*" {
            let inside: Vec<&str> = lines.by_ref().take_while(|line| *line != " */").collect();
            kept.extend(comment(&inside));
        } else if let Some((code, comment)) = line.split_once("// ") {
            // C of 1989 has no such comments.
            kept.push(format!("{}  /* {comment} */", code.trim_end()));
        } else {
            kept.push(line.to_owned());
        }
    }
    kept.join("\n") + "\n"
}

/// The lines of a comment, without Rust's section on safety, which repeats what the conventions at the top of the header say.
fn comment(lines: &[&str]) -> Vec<String> {
    let lines = lines.iter().map(|line| line.strip_prefix(' ').unwrap_or(line).trim_end());
    let mut text: Vec<&str> = lines.take_while(|line| *line != "# Safety").collect();
    while text.last().is_some_and(|line| line.is_empty()) {
        text.pop();
    }
    let last = text.len().saturating_sub(1);
    let begin = |i: usize| if i == 0 { "/* " } else { " * " };
    let end = |i: usize| if i == last { " */" } else { "" };
    text.iter()
        .enumerate()
        .map(|(i, line)| format!("{}{line}", begin(i)).trim_end().to_owned() + end(i))
        .collect()
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
        assert!(lines[i - 1].ends_with("*/"), "undocumented: {name}");
    }
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("src/capi");
    let sources = std::fs::read_dir(folder).expect("the C ABI").flatten();
    // Functions of units have headers of their own.
    let sources = sources.filter(|entry| entry.path().is_file());
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

/// Strict compilers of every standard take the header by itself; of the oldest C but for the integers of stdint.h.
#[test]
#[cfg(unix)]
fn strict_compilers_take_the_header() {
    let header = Path::new(env!("CARGO_MANIFEST_DIR")).join("include");
    let check = |compiler: &str, standard: &str, language: &str, file: &str| {
        let mut command = std::process::Command::new(compiler);
        command.args([
            &format!("-std={standard}"),
            "-pedantic",
            "-Wall",
            "-Wextra",
            "-Werror",
            "-fsyntax-only",
        ]);
        let output = command.args(["-x", language]).arg(header.join(file)).output().expect("a compiler");
        assert!(output.status.success(), "{standard}: {}", String::from_utf8_lossy(&output.stderr));
    };
    for standard in ["c89", "c99", "c11", "c17"] {
        check("cc", standard, "c", "cagedyn.h");
    }
    for standard in ["c++11", "c++17", "c++20"] {
        check("c++", standard, "c++", "cagedyn.h");
    }
    for standard in ["c++17", "c++20"] {
        check("c++", standard, "c++", "cagedyn.hpp");
        check("c++", standard, "c++", "cagedyn_analysis.hpp");
    }
}
