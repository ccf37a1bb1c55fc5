//! The ABI that the header declares is the committed one: `ctests/abi/cagedyn.abi`. What was there stays as it is, and what is
//! new is committed by `make abi`. That the library exports exactly what the header declares is tested beside.
#![cfg(target_os = "linux")]

use crate::c_programs::{root, succeed};
use std::path::{Path, PathBuf};
use std::process::Command;

/// A shared library with an empty body for every function of a header, and debug information.
fn stand_in(header: &str, folder: &Path, name: &str) -> PathBuf {
    let body = header.split("extern \"C\" {").nth(1).and_then(|rest| rest.split("#ifdef __cplusplus").next());
    let code = body.expect("functions").replace("#endif", "");
    let mut source = "#include \"declared.h\"\n".to_owned();
    // Comments have no code in them, and every declaration ends with a semicolon.
    let (mut rest, mut plain) = (code.as_str(), String::new());
    while let Some((before, after)) = rest.split_once("/*") {
        plain += before;
        rest = after.split_once("*/").map_or("", |(_, after)| after);
    }
    plain += rest;
    for declaration in plain.split(';').map(str::trim).filter(|text| text.contains('(')) {
        let nothing = declaration.starts_with("void ") && !declaration.starts_with("void *");
        source += &format!("{declaration} {{ {} }}\n", if nothing { "" } else { "return 0;" });
    }
    std::fs::write(folder.join("declared.h"), header).expect("a file");
    let (c, so) = (format!("{name}.c"), format!("{name}.so"));
    std::fs::write(folder.join(&c), source).expect("a file");
    let mut compiler = cc::Build::new();
    compiler.opt_level(0).cargo_metadata(false).target(env!("CAGEDYN_TARGET")).host(env!("CAGEDYN_HOST"));
    let mut command = compiler.out_dir(folder).get_compiler().to_command();
    // Debug information has no path of this machine.
    command.arg(format!("-fdebug-prefix-map={}=.", folder.display())).current_dir(folder);
    succeed(command.args(["-g", "-shared", "-fPIC", &c, "-o", &so]));
    folder.join(so)
}

/// Exit status of abidiff: bit 2 for a change, bit 3 for an incompatible one.
fn difference(old: &Path, new: &Path) -> i32 {
    let output = Command::new("abidiff").arg(old).arg(new).output().expect("abidiff runs");
    let code = output.status.code().expect("it ends by itself");
    assert_eq!(code & 3, 0, "{}", String::from_utf8_lossy(&output.stderr));
    print!("{}", String::from_utf8_lossy(&output.stdout));
    code
}

#[test]
fn the_abi_is_the_committed_one() {
    if Command::new("abidw").arg("--version").output().is_err() {
        assert!(std::env::var_os("CAGEDYN_REQUIRE_HOSTS").is_none(), "abigail-tools are not installed");
        eprintln!("abigail-tools are not installed: the ABI is not compared");
        return;
    }
    let folder = tempfile::tempdir().expect("a directory");
    let header = std::fs::read_to_string(root().join("include/cagedyn.h")).expect("the header");
    let so = stand_in(&header, folder.path(), "present");
    let committed = root().join("ctests/abi/cagedyn.abi");
    if std::env::var_os("CAGEDYN_BLESS").is_some() {
        let mut command = Command::new("abidw");
        command.args(["--no-comp-dir-path", "--no-corpus-path", "--no-show-locs", "--no-elf-needed"]);
        succeed(command.arg("--out-file").arg(&committed).arg(&so));
    }
    assert_eq!(difference(&committed, &so), 0, "the ABI has changed: if it only grew, run make abi");

    // The guard sees what it is there for.
    let added = header.replacen(
        "const char *cagedyn_version",
        "int32_t cagedyn_more(void);\n\nconst char *cagedyn_version",
        1,
    );
    let so = stand_in(&added, folder.path(), "added");
    assert_eq!(difference(&committed, &so) & 4, 4);
    for (name, old, new) in [
        ("type", "int32_t cagedyn_sim_step(cagedyn_sim *sim,", "int64_t cagedyn_sim_step(cagedyn_sim *sim,"),
        ("argument", "int64_t threads)", "int32_t threads)"),
        ("gone", "void cagedyn_sim_free(", "void cagedyn_sim_release("),
    ] {
        assert!(header.contains(old), "{old}");
        let so = stand_in(&header.replacen(old, new, 1), folder.path(), name);
        assert_ne!(difference(&committed, &so), 0, "{name}");
    }
}
