//! `make install`: what it puts where, that a C program builds from there, and that nothing is left half-installed.
#![cfg(all(target_os = "linux", feature = "cli"))]

use crate::common::repository;
use crate::docs::links;
use crate::hosts::present;
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

/// A folder with what `make build` makes, from the build of this test.
fn built() -> tempfile::TempDir {
    let test = std::env::current_exe().expect("path of this test");
    let deps = test.parent().expect("a directory");
    let folder = tempfile::tempdir().expect("a directory");
    let files = [deps.join("libcagedyn.so"), deps.join("libcagedyn.a"), env!("CARGO_BIN_EXE_cagedyn").into()];
    for file in files {
        let name = file.file_name().expect("a name");
        std::os::unix::fs::symlink(&file, folder.path().join(name)).expect("a link");
    }
    folder
}

#[test]
fn installing_puts_everything_in_place_and_removing_takes_it_away() {
    let (root, built) = (tempfile::tempdir().expect("a directory"), built());
    let output = make("install", root.path(), built.path());
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    let installed = files(root.path());
    for file in [
        "bin/cagedyn",
        "include/cagedyn.h",
        "include/cagedyn.hpp",
        "include/cagedyn_analysis.hpp",
        "lib64/cmake/cagedyn/cagedynConfig.cmake",
        "lib64/cmake/cagedyn/cagedynConfigVersion.cmake",
        "share/bash-completion/completions/cagedyn",
        "share/cagedyn/matlab/Cagedyn.m",
        "share/cagedyn/matlab/CagedynBatch.m",
        "share/cagedyn/matlab/CagedynHeat.m",
        "share/cagedyn/matlab/build_cagedyn.m",
        "share/doc/cagedyn/examples/nu2310.c",
        "share/doc/cagedyn/docs/scene.md",
        "lib64/libcagedyn.a",
        "lib64/libcagedyn.so",
        "lib64/libcagedyn.so.0",
        "lib64/pkgconfig/cagedyn.pc",
        "share/cagedyn/scenes/nu2310.json",
        "share/cagedyn/schemas/scene.schema.json",
        "share/doc/cagedyn/LICENSE-APACHE",
        "share/doc/cagedyn/LICENSE-MIT",
        "share/fish/vendor_completions.d/cagedyn.fish",
        "share/man/man1/cagedyn.1",
        "share/man/man1/cagedyn-run.1",
        "share/zsh/site-functions/_cagedyn",
    ] {
        assert!(installed.contains(&format!("opt/bearing/{file}")), "{file} is not in {installed:#?}");
    }
    let doc = root.path().join("opt/bearing/share/doc/cagedyn");
    for page in installed.iter().filter(|file| file.ends_with(".md")) {
        let page = root.path().join(page);
        let text = std::fs::read_to_string(&page).expect("readable");
        for link in links(&text).into_iter().filter(|link| !link.contains("://") && !link.starts_with('#')) {
            let file = page.parent().expect("a folder").join(link.split('#').next().expect("a path"));
            // Sources of tests and studies are not installed.
            let source = ["ctests/", "studies/"].iter().any(|folder| link.contains(folder));
            assert!(
                file.exists() || source,
                "{}: {link}",
                page.strip_prefix(&doc).expect("a page").display()
            );
        }
    }
    let read =
        |file: &str| std::fs::read_to_string(root.path().join("opt/bearing/lib64").join(file)).unwrap();
    let config = read("pkgconfig/cagedyn.pc");
    for text in [config, read("cmake/cagedyn/cagedynConfig.cmake")] {
        assert!(!text.contains("/opt/bearing") && !text.contains('@'), "{text}");
    }
    let library = root.path().join("opt/bearing/lib64/libcagedyn.so.0");
    let symbols = Command::new("nm").arg(&library).output().expect("nm runs");
    assert!(symbols.stdout.is_empty(), "the installed library has symbols that nobody needs");
    assert!(std::fs::metadata(&library).expect("the library").len() < 8_500_000);
    // The tool finds the library that is installed with it.
    let (prefix, unit) = (root.path().join("opt/bearing"), built.path().join("unit.fmu"));
    let mut tool = Command::new(prefix.join("bin/cagedyn"));
    tool.arg("fmu").arg(prefix.join("share/cagedyn/scenes/nu2310.json")).arg("--out").arg(&unit);
    assert!(tool.output().expect("the tool runs").status.success() && unit.is_file());
    assert!(make("uninstall", root.path(), built.path()).status.success());
    assert_eq!(files(root.path()), [""; 0]);
}

/// Folders may have any name; relative ones would end up anywhere.
#[test]
fn folders_with_spaces_and_quotes_are_as_good_as_others() {
    let (root, built) = (tempfile::tempdir().expect("a directory"), built());
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
    let built = self::built();
    // A file where a folder must be.
    std::fs::create_dir_all(root.path().join("opt/bearing/share")).expect("a folder");
    std::fs::write(root.path().join("opt/bearing/share/cagedyn"), "").expect("a file");
    assert!(!make("install", root.path(), built.path()).status.success());
    assert_eq!(files(root.path()), ["opt/bearing/share/cagedyn"]);
}

/// The example builds and runs from the installed tree, after it was moved: in C and C++, shared and static, by pkg-config and by
/// CMake; and as a program that is static altogether.
#[test]
fn programs_build_from_the_installed_tree() {
    let (root, built) = (tempfile::tempdir().expect("a directory"), built());
    let (first, prefix) = (root.path().join("opt"), root.path().join("a/place"));
    let output = Command::new("make")
        .current_dir(repository("."))
        .arg("install")
        .arg(format!("PREFIX={}", first.display()))
        .arg(format!("BUILT={}", built.path().display()))
        .output()
        .expect("make runs");
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    std::fs::create_dir(root.path().join("a")).expect("a folder");
    std::fs::rename(&first, &prefix).expect("another place");
    let shell = |script: &str| {
        let mut shell = Command::new("sh");
        shell.args(["-euc", script]).current_dir(root.path()).env("PREFIX", &prefix);
        shell.env("PKG_CONFIG_PATH", prefix.join("lib/pkgconfig")).env("SOURCE", repository("."));
        let output = shell.output().expect("a shell");
        let [out, err] =
            [&output.stdout, &output.stderr].map(|text| String::from_utf8_lossy(text).into_owned());
        assert!(output.status.success(), "{script}: {out}\n{err}");
        out
    };
    let places = "cage centre (-0.566, 0.240) of the guide clearance";
    let text = shell(
        r#"strict="-Wall -Wextra -Wpedantic -Werror"
        doc=$PREFIX/share/doc/cagedyn/examples
        scene=$PREFIX/share/cagedyn/scenes/nu2310.json
        rpath=-Wl,-rpath,$(pkg-config --variable=libdir cagedyn)
        cc -std=c99 $strict $doc/nu2310.c -o c $(pkg-config --cflags --libs cagedyn) $rpath
        c++ -std=c++17 $strict $doc/nu2310.cpp -o cpp $(pkg-config --cflags --libs cagedyn) $rpath
        cc -std=c99 $strict $doc/nu2310.c -o static $(pkg-config --cflags cagedyn) $PREFIX/lib/libcagedyn.a \
            $(pkg-config --libs-only-l --static cagedyn | sed 's/-lcagedyn//')
        ! readelf -d static | grep -q libcagedyn
        cc -static -std=c99 $strict $doc/nu2310.c -o whole $(pkg-config --cflags --libs --static cagedyn)
        ! readelf -d whole | grep -q NEEDED
        ./c $scene c.csv > c.txt
        ./static $scene static.csv > static.txt
        ./whole $scene whole.csv > whole.txt
        cmp c.csv static.csv
        cmp c.csv whole.csv
        ./cpp $scene"#,
    );
    assert!(text.contains(places), "{text}");
    let text = shell(
        r#"mkdir -p project build
        cp $PREFIX/share/doc/cagedyn/examples/nu2310.cpp project
        cat > project/CMakeLists.txt <<'END'
cmake_minimum_required(VERSION 3.16)
project(host LANGUAGES C CXX)
set(CMAKE_CXX_STANDARD 17)
find_package(cagedyn 0.1 CONFIG REQUIRED)
add_executable(shared nu2310.cpp)
target_link_libraries(shared PRIVATE cagedyn::cagedyn)
add_executable(static nu2310.cpp)
target_link_libraries(static PRIVATE cagedyn::static)
add_executable(whole nu2310.cpp)
target_link_libraries(whole PRIVATE cagedyn::static -static)
END
        cmake -S project -B build -DCMAKE_PREFIX_PATH=$PREFIX > cmake.txt
        cmake --build build > build.txt
        build/shared $PREFIX/share/cagedyn/scenes/nu2310.json
        build/static $PREFIX/share/cagedyn/scenes/nu2310.json > static2.txt
        build/whole $PREFIX/share/cagedyn/scenes/nu2310.json > whole2.txt
        sed -i 's/cagedyn 0.1 CONFIG/cagedyn 0.2 CONFIG/' project/CMakeLists.txt
        ! cmake -S project -B newer -DCMAKE_PREFIX_PATH=$PREFIX > newer.txt 2>&1"#,
    );
    assert!(text.contains(places), "{text}");
}

/// The gateway of MATLAB and Octave, compiled from the installed tree into a folder of the user.
#[test]
fn octave_builds_its_gateway_from_the_installed_tree() {
    if !present(Path::new("mkoctfile"), &["--version"], &["CAGEDYN_REQUIRE_ALL_HOSTS"]) {
        return;
    }
    let [root, user] = [(); 2].map(|()| tempfile::tempdir().expect("a directory"));
    let built = built();
    // DESTDIR stands in for a tree that was moved.
    assert!(make("install", root.path(), built.path()).status.success());
    let share = root.path().join("opt/bearing/share/cagedyn");
    let code = "build_cagedyn(); b = Cagedyn(getenv('SCENE')); b.advance_to(1e-3); disp(b.time())";
    let output = Command::new("octave-cli")
        .arg("--path")
        .arg(share.join("matlab"))
        .args(["--eval", code])
        .env("SCENE", share.join("scenes/nu2310.json"))
        .current_dir(user.path())
        .output()
        .expect("Octave runs");
    let [out, err] = [&output.stdout, &output.stderr].map(|text| String::from_utf8_lossy(text).into_owned());
    assert!(output.status.success() && out.trim() == "1.0000e-03", "{out}\n{err}");
}
