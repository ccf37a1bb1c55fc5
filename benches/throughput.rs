//! Throughput of `cagedyn cases`: 24 equal cases on all cores over the same on one, in pairs. `cargo bench --bench throughput`
//! prints it. On one means that the whole process is held on it with `taskset`: files are written beside the cases.

use std::error::Error;
use std::path::Path;
use std::process::{Command, Stdio};
use std::time::Instant;

const CASES: usize = 24;
const PAIRS: usize = 7;

fn main() -> Result<(), Box<dyn Error>> {
    let folder = tempfile::tempdir()?;
    let scene = Path::new(env!("CARGO_MANIFEST_DIR")).join("scenes/nu2310.json");
    let cases: Vec<_> =
        (0..CASES).map(|i| serde_json::json!({"name": format!("case{i}"), "set": {}})).collect();
    let set = serde_json::json!({"schema": "cagedyn.cases/1", "scene": scene, "cases": cases});
    let (file, out) = (folder.path().join("equal.cases.json"), folder.path().join("out"));
    std::fs::write(&file, set.to_string())?;
    let cores = std::thread::available_parallelism()?.get();
    // Wall time in s.
    let run = |jobs: usize| -> Result<f64, Box<dyn Error>> {
        // Cases that stand there would not be run again.
        if out.exists() {
            std::fs::remove_dir_all(&out)?;
        }
        let started = Instant::now();
        let tool = env!("CARGO_BIN_EXE_cagedyn");
        let mut command = if jobs == 1 { Command::new("taskset") } else { Command::new(tool) };
        if jobs == 1 {
            command.args(["--cpu-list", "0", tool]);
        }
        let status = command
            .args(["cases".as_ref(), file.as_os_str(), "--jobs".as_ref(), jobs.to_string().as_ref()])
            .args(["--out".as_ref(), out.as_os_str()])
            .stdout(Stdio::null())
            .status()?;
        if status.success() { Ok(started.elapsed().as_secs_f64()) } else { Err(status.to_string().into()) }
    };
    let mut ratios = Vec::new();
    for _ in 0..PAIRS {
        let [one, all] = [run(1)?, run(cores)?];
        println!("{CASES} cases: {one:.2} s one at a time, {all:.2} s on {cores} cores");
        ratios.push(one / all);
    }
    ratios.sort_by(f64::total_cmp);
    println!(
        "throughput of {cores} cores over that of one: {:.2}, median of {PAIRS} pairs",
        ratios[PAIRS / 2]
    );
    Ok(())
}
