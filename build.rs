//! Gives the shared library its SONAME, tells the tests which platform they were built for, and names this build of the library:
//! snapshots are good for no other.

use std::hash::{DefaultHasher, Hasher};
use std::path::Path;
use std::{env, fs, io};

fn main() -> io::Result<()> {
    println!("cargo:rerun-if-changed=build.rs");
    let setting = |name: &str| env::var(name).unwrap_or_default();
    if setting("CARGO_CFG_TARGET_OS") == "linux" {
        println!("cargo:rustc-cdylib-link-arg=-Wl,-soname,libcagedyn.so.0");
    }
    for name in ["TARGET", "HOST"] {
        println!("cargo:rustc-env=CAGEDYN_{name}={}", setting(name));
    }
    let (mut hasher, root) = (DefaultHasher::new(), setting("CARGO_MANIFEST_DIR"));
    for source in ["src", "Cargo.toml"] {
        println!("cargo:rerun-if-changed={source}");
        hash(&Path::new(&root).join(source), &mut hasher)?;
    }
    let build = format!("{} {} {:016x}", setting("TARGET"), setting("OPT_LEVEL"), hasher.finish());
    println!("cargo:rustc-env=CAGEDYN_BUILD={build}");
    Ok(())
}

/// Hashes the names and contents of all files, in the order of their names.
fn hash(path: &Path, hasher: &mut DefaultHasher) -> io::Result<()> {
    if !path.is_dir() {
        hasher.write(path.file_name().map_or(&[], |name| name.as_encoded_bytes()));
        hasher.write(&fs::read(path)?);
        return Ok(());
    }
    let mut inside = fs::read_dir(path)?.map(|entry| Ok(entry?.path())).collect::<io::Result<Vec<_>>>()?;
    inside.sort();
    inside.iter().try_for_each(|path| hash(path, hasher))
}
