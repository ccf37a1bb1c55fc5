//! Instructions by the place in the source that they come from: callgrind counts them by address, addr2line says of which
//! functions an address is, those that were inlined there included.

use cagedyn::{Error, Result, Status};
use std::collections::HashMap;
use std::io::Write;
use std::path::Path;
use std::process::{Command, Stdio};
use std::sync::atomic::{AtomicUsize, Ordering};

/// Where instructions were counted.
pub struct Counted {
    /// Functions from the innermost on, up to the one that is no inlined copy. Of what another library did, its own function
    /// comes first and those of the caller follow.
    pub functions: Vec<String>,
    /// Instructions.
    pub count: u64,
}

/// What the program printed with this variable set, and its instructions within `function` (a pattern of callgrind).
///
/// # Errors
/// [`Status::File`] when a program does not run or fails.
pub fn count(program: &Path, variable: (&str, &str), function: &str) -> Result<(String, Vec<Counted>)> {
    static RUNS: AtomicUsize = AtomicUsize::new(0);
    let name = format!("cagedyn-profile-{}-{}", std::process::id(), RUNS.fetch_add(1, Ordering::Relaxed));
    let file = std::env::temp_dir().join(name);
    let output = Command::new("valgrind")
        .args(["--tool=callgrind", "--dump-instr=yes", "--compress-strings=no", "--compress-pos=no"])
        .arg(format!("--toggle-collect={function}"))
        .arg(format!("--callgrind-out-file={}", file.display()))
        .arg(program)
        .env(variable.0, variable.1)
        .output()
        .map_err(|e| cagedyn_studies::file_error(Path::new("valgrind"), e))?;
    if !output.status.success() {
        return Err(Error::new(Status::File, String::from_utf8_lossy(&output.stderr).into_owned()));
    }
    let text = std::fs::read_to_string(&file).map_err(|e| cagedyn_studies::file_error(&file, e))?;
    std::fs::remove_file(&file).ok();
    let by_address = by_address(&text, &program.display().to_string());
    let names = inlined(program, by_address.keys().map(|(address, _)| *address))?;
    let counted = by_address.into_iter().map(|((address, other), count)| {
        let own = names.get(&address).cloned().unwrap_or_default();
        Counted { functions: other.into_iter().chain(own).collect(), count }
    });
    Ok((String::from_utf8_lossy(&output.stdout).into_owned(), counted.collect()))
}

/// Instructions at every address of `object`, and those that a function of another object ran when it was called from there.
fn by_address(text: &str, object: &str) -> HashMap<(u64, Option<String>), u64> {
    let total = text.lines().find_map(|line| line.strip_prefix("summary: ")?.trim().parse().ok());
    let mut sums = HashMap::new();
    let (mut own, mut called_own, mut function, mut called) = (false, true, "", false);
    for line in text.lines() {
        if let Some(name) = line.strip_prefix("ob=") {
            own = name == object;
            called_own = own;
        } else if let Some(name) = line.strip_prefix("cob=") {
            called_own = name == object;
        } else if let Some(name) = line.strip_prefix("cfn=") {
            function = name;
        } else if line.starts_with("calls=") {
            called = true;
        } else if let Some([address, _, count]) = line.strip_prefix("0x").and_then(columns) {
            let other = (called && !called_own).then(|| function.to_owned());
            let parsed = u64::from_str_radix(address, 16).ok().zip(count.parse::<u64>().ok());
            let mine = own && (!called || other.is_some());
            // The start of the program calls all of it.
            if let Some((address, count)) = parsed.filter(|(_, count)| mine && Some(*count) != total) {
                *sums.entry((address, other)).or_default() += count;
            }
            if called {
                (called, called_own) = (false, own);
            }
        }
    }
    sums
}

fn columns(line: &str) -> Option<[&str; 3]> {
    let mut words = line.split_whitespace();
    Some([words.next()?, words.next()?, words.next()?])
}

/// Functions of every address, from the innermost on.
fn inlined(program: &Path, addresses: impl Iterator<Item = u64>) -> Result<HashMap<u64, Vec<String>>> {
    let failed = |e| cagedyn_studies::file_error(Path::new("addr2line"), e);
    let mut asked: Vec<u64> = addresses.collect();
    asked.sort_unstable();
    asked.dedup();
    let mut child = Command::new("addr2line")
        .args(["--addresses", "--inlines", "--functions", "--demangle", "--exe"])
        .arg(program)
        .stdin(Stdio::piped())
        .stdout(Stdio::piped())
        .spawn()
        .map_err(failed)?;
    let mut input = child.stdin.take().expect("it is a pipe");
    let lines: String = asked.iter().map(|address| format!("{address:x}\n")).collect();
    let writer = std::thread::spawn(move || input.write_all(lines.as_bytes()));
    let output = child.wait_with_output().map_err(failed)?;
    writer.join().expect("it does not panic").map_err(failed)?;
    let (mut names, mut now) = (HashMap::<u64, Vec<String>>::new(), 0);
    let mut lines = std::str::from_utf8(&output.stdout).unwrap_or_default().lines();
    while let Some(line) = lines.next() {
        if let Some(address) = line.strip_prefix("0x") {
            now = u64::from_str_radix(address, 16).unwrap_or_default();
        } else {
            names.entry(now).or_default().push(line.to_owned());
            // The place in the file.
            lines.next();
        }
    }
    Ok(names)
}
