//! The command `fmu`: a scene as a functional mock-up unit.

use crate::results::files::{file_error, write_with};
use crate::run::{in_file, read, stem};
use crate::{FmuArgs, terminal};
use cagedyn::fmi::{SCENE_FILE, Standard, Unit, describe};
use cagedyn::{Error, Result, Scene, Status};
use clap::ValueEnum;
use std::env::consts::{ARCH, DLL_EXTENSION, DLL_PREFIX, OS};
use std::fs;
use std::io::{Cursor, Write};
use std::path::{Path, PathBuf};
use std::process::ExitCode;
use zip::ZipWriter;
use zip::write::SimpleFileOptions;

/// Where libraries are installed beside the folder of the tool; with that of Debian.
const BESIDE: [&str; 5] = [".", "deps", "../lib", "../lib64", "../lib/x86_64-linux-gnu"];

/// Version of the standard.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum Version {
    /// FMI 2.0.
    #[value(name = "2.0")]
    Two,
    /// FMI 3.0.
    #[value(name = "3.0")]
    Three,
}

/// A library for a platform, as the standard names it.
#[derive(Clone, Debug)]
pub struct Binary {
    platform: String,
    file: PathBuf,
}

/// Reads PLATFORM=FILE.
///
/// # Errors
/// What is missing.
pub fn parse_binary(text: &str) -> std::result::Result<Binary, String> {
    let (platform, file) =
        text.split_once('=').ok_or("write PLATFORM=FILE, for example x86_64-windows=cagedyn.dll")?;
    let named =
        !platform.is_empty() && platform.bytes().all(|b| b.is_ascii_alphanumeric() || b"_-".contains(&b));
    if !named {
        return Err(format!("'{platform}' is no platform of the standard, such as x86_64-linux or win64"));
    }
    Ok(Binary { platform: platform.to_owned(), file: file.into() })
}

/// Writes the unit.
///
/// # Errors
/// A scene that cannot be used; [`Status::File`] for a library that is not found, or of another build than the tool.
pub fn command(args: &FmuArgs) -> Result<ExitCode> {
    let text = read(&args.scene)?;
    let scene = Scene::from_json_with(&text, args.sets.pairs()).map_err(|e| in_file(&args.scene, e))?;
    let scene = scene.to_json();
    let unit = Unit::new(&scene).map_err(|e| in_file(&args.scene, e))?;
    let standard = if args.fmi == Version::Two { Standard::Two } else { Standard::Three };
    let name = identifier(&stem(&args.out));
    let mut binaries = args.binary.clone();
    if !binaries.iter().any(|binary| binary.platform == platform(args.fmi)) {
        binaries.push(Binary { platform: platform(args.fmi), file: library(args.library.as_deref())? });
    }
    let mut entries = vec![
        ("modelDescription.xml".to_owned(), describe(&unit, standard, &name).into_bytes()),
        (format!("resources/{SCENE_FILE}"), scene.into_bytes()),
    ];
    for (license, text) in
        [("MIT", include_str!("../../../LICENSE-MIT")), ("APACHE", include_str!("../../../LICENSE-APACHE"))]
    {
        entries.push((format!("documentation/licenses/LICENSE-{license}.txt"), text.as_bytes().to_vec()));
    }
    for Binary { platform, file } in &binaries {
        let content = fs::read(file).map_err(|e| file_error(file, e))?;
        same_build(file, &content)?;
        let ending = file.extension().map_or(DLL_EXTENSION.into(), |ending| ending.to_string_lossy());
        let ending = if ending.bytes().all(|b| b.is_ascii_digit()) { DLL_EXTENSION.into() } else { ending };
        entries.push((format!("binaries/{platform}/{name}.{ending}"), content));
    }
    let packed = packed(&entries).map_err(|e| file_error(&args.out, e))?;
    write_with(&args.out, |file| file.write_all(&packed))?;
    let version = args.fmi.to_possible_value().map_or(String::new(), |value| value.get_name().to_owned());
    let platforms: Vec<&str> = binaries.iter().map(|binary| binary.platform.as_str()).collect();
    terminal::print(&format!(
        "{}: FMI {version} for {}, co-simulation and model exchange, {}\n",
        args.out.display(),
        platforms.join(", "),
        unit.in_words()
    ))?;
    Ok(ExitCode::SUCCESS)
}

/// The platform of this machine in a version of the standard.
fn platform(version: Version) -> String {
    let system = if OS == "macos" { "darwin" } else { OS };
    match (version, system) {
        (Version::Three, system) => format!("{ARCH}-{system}"),
        (Version::Two, "windows") => "win64".to_owned(),
        (Version::Two, system) => format!("{system}64"),
    }
}

/// A name of C made of a file name.
fn identifier(stem: &str) -> String {
    let letters: String = stem.chars().map(|c| if c.is_ascii_alphanumeric() { c } else { '_' }).collect();
    if letters.starts_with(|c: char| c.is_ascii_alphabetic()) {
        letters
    } else {
        format!("cagedyn_{letters}")
    }
}

/// The shared library for this machine: the given one, or that beside the tool.
fn library(given: Option<&Path>) -> Result<PathBuf> {
    if let Some(path) = given {
        return Ok(path.to_owned());
    }
    let tool = std::env::current_exe().map_err(|e| file_error(Path::new("cagedyn"), e))?;
    let folder = tool.parent().unwrap_or(Path::new("."));
    let names =
        [format!("{DLL_PREFIX}cagedyn.{DLL_EXTENSION}"), format!("{DLL_PREFIX}cagedyn.{DLL_EXTENSION}.0")];
    let places = BESIDE.iter().flat_map(|place| names.iter().map(move |name| folder.join(place).join(name)));
    let found = places.into_iter().find(|path| path.is_file());
    found.ok_or_else(|| {
        let text = format!(
            "--library: there is no {} beside {} or in ../lib; say where it is",
            names[0],
            tool.display()
        );
        Error::new(Status::File, text)
    })
}

/// Refuses a library whose description of the variables may be another.
fn same_build(file: &Path, content: &[u8]) -> Result<()> {
    // Other platforms have other names of the same sources.
    let (_, sources) = env!("CAGEDYN_BUILD").rsplit_once(' ').unwrap_or_default();
    if content.windows(sources.len()).any(|part| part == sources.as_bytes()) {
        return Ok(());
    }
    Err(file_error(
        file,
        "is no library of this version of cagedyn: its sources are others than those of this tool",
    ))
}

fn packed(entries: &[(String, Vec<u8>)]) -> zip::result::ZipResult<Vec<u8>> {
    let mut zip = ZipWriter::new(Cursor::new(Vec::new()));
    for (name, content) in entries {
        // Without times: the same scene gives the same bytes.
        zip.start_file(name, SimpleFileOptions::default().unix_permissions(0o644))?;
        zip.write_all(content)?;
    }
    Ok(zip.finish()?.into_inner())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_are_those_of_c() {
        assert_eq!(identifier("nu2310"), "nu2310");
        assert_eq!(identifier("70 ac.cage"), "cagedyn_70_ac_cage");
    }

    #[test]
    fn platforms_are_named() {
        assert_eq!(parse_binary("win64=a/b.dll").unwrap().platform, "win64");
        assert!(parse_binary("win64").unwrap_err().contains("PLATFORM=FILE"));
        assert!(parse_binary("../x=y").unwrap_err().contains("../x"));
    }
}
