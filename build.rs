//! Gives the shared library its SONAME and tells the tests which platform they were built for.

fn main() {
    println!("cargo:rerun-if-changed=build.rs");
    if std::env::var("CARGO_CFG_TARGET_OS").is_ok_and(|os| os == "linux") {
        println!("cargo:rustc-cdylib-link-arg=-Wl,-soname,libcagedyn.so.0");
    }
    for name in ["TARGET", "HOST"] {
        println!("cargo:rustc-env=CAGEDYN_{name}={}", std::env::var(name).unwrap_or_default());
    }
}
