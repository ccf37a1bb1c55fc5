//! `make install`: what it puts where, that a C program builds from there, and that nothing is left half-installed.
#![cfg(all(target_os = "linux", feature = "cli"))]

use crate::common::repository;
use std::path::Path;
use std::process::Command;

/// Runs a target of the Makefile for a library that stands in for a built one.
fn make(target: &str, root: &Path, built: &Path) -> std::process::Output {
    Command::new("make")
        .current_dir(repository("."))
        .args([target, "PREFIX=/opt/bearing", "LIBDIR=/opt/bearing/lib64"])
        .arg(format!("DESTDIR={}", root.display()))
        .arg(format!("BUILT={}", built.display()))
        .output()
        .expect("make runs")
}

fn files(folder: &Path) -> Vec<String> {
    let mut list = Vec::new();
    let mut folders = vec![folder.to_owned()];
    while let Some(next) = folders.pop() {
        for entry in std::fs::read_dir(&next).into_iter().flatten().flatten() {
            let path = entry.path();
            if path.is_dir() && !path.is_symlink() {
                folders.push(path);
            } else {
                list.push(path.strip_prefix(folder).expect("inside").display().to_string());
            }
        }
    }
    list.sort();
    list
}

#[test]
fn installing_puts_everything_in_place_and_removing_takes_it_away() {
    let [root, built] = [(); 2].map(|()| tempfile::tempdir().expect("a directory"));
    for name in ["libcagedyn.so", "libcagedyn.a", "cagedyn"] {
        std::fs::write(built.path().join(name), name).expect("a file");
    }
    let output = make("install", root.path(), built.path());
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    let installed = files(root.path());
    for file in [
        "bin/cagedyn",
        "include/cagedyn.h",
        "lib64/libcagedyn.a",
        "lib64/libcagedyn.so",
        "lib64/libcagedyn.so.0",
        "lib64/pkgconfig/cagedyn.pc",
        "share/cagedyn/scenes/nu2310.json",
        "share/cagedyn/schemas/scene.schema.json",
        "share/doc/cagedyn/LICENSE-APACHE",
        "share/doc/cagedyn/LICENSE-MIT",
    ] {
        assert!(installed.contains(&format!("opt/bearing/{file}")), "{file} is not in {installed:#?}");
    }
    let config = std::fs::read_to_string(root.path().join("opt/bearing/lib64/pkgconfig/cagedyn.pc")).unwrap();
    assert!(config.contains("libdir=/opt/bearing/lib64") && !config.contains('@'), "{config}");
    assert!(make("uninstall", root.path(), built.path()).status.success());
    assert_eq!(files(root.path()), [""; 0]);
}

/// Folders may have any name; relative ones would end up anywhere.
#[test]
fn folders_with_spaces_and_quotes_are_as_good_as_others() {
    let [root, built] = [(); 2].map(|()| tempfile::tempdir().expect("a directory"));
    for name in ["libcagedyn.so", "libcagedyn.a", "cagedyn"] {
        std::fs::write(built.path().join(name), name).expect("a file");
    }
    let odd = root.path().join("it's a place");
    assert!(make("install", &odd, built.path()).status.success());
    assert!(odd.join("opt/bearing/bin/cagedyn").is_file());
    assert!(make("uninstall", &odd, built.path()).status.success());
    let output = Command::new("make")
        .current_dir(repository("."))
        .args(["install", "PREFIX=relative"])
        .arg(format!("BUILT={}", built.path().display()))
        .output()
        .expect("make runs");
    let message = String::from_utf8_lossy(&output.stderr);
    assert!(!output.status.success() && message.contains("must begin with a slash"), "{message}");
}

#[test]
fn what_is_missing_or_does_not_fit_leaves_nothing() {
    let [root, built] = [(); 2].map(|()| tempfile::tempdir().expect("a directory"));
    std::fs::write(built.path().join("libcagedyn.so"), "").expect("a file");
    let output = make("install", root.path(), built.path());
    assert!(!output.status.success());
    assert!(String::from_utf8_lossy(&output.stderr).contains("run 'make build' first"));
    assert_eq!(files(root.path()), [""; 0]);
    for name in ["libcagedyn.a", "cagedyn"] {
        std::fs::write(built.path().join(name), name).expect("a file");
    }
    // A file where a folder must be.
    std::fs::create_dir_all(root.path().join("opt/bearing/share")).expect("a folder");
    std::fs::write(root.path().join("opt/bearing/share/cagedyn"), "").expect("a file");
    assert!(!make("install", root.path(), built.path()).status.success());
    assert_eq!(files(root.path()), ["opt/bearing/share/cagedyn"]);
}
