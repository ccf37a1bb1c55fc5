//! Instructions of force evaluations at saved states, counted by Valgrind's callgrind.

use cagedyn::{Error, Model, Result, Sim, Status};
use std::hint::black_box;
use std::path::Path;
use std::process::Command;

/// States of a run with their times.
#[derive(Clone, Debug, Default)]
pub struct States(pub Vec<(f64, Vec<f64>)>);

impl States {
    /// Writes them to a file, as numbers of 8 bytes.
    ///
    /// # Errors
    /// [`Status::File`].
    pub fn save(&self, path: &Path) -> Result<()> {
        let numbers = self.0.iter().flat_map(|(t, state)| std::iter::once(t).chain(state));
        let bytes: Vec<u8> = numbers.flat_map(|x| x.to_le_bytes()).collect();
        std::fs::write(path, bytes).map_err(|e| crate::file_error(path, e))
    }

    /// Reads states of `length` numbers.
    ///
    /// # Errors
    /// [`Status::File`].
    pub fn load(path: &Path, length: usize) -> Result<Self> {
        let bytes = std::fs::read(path).map_err(|e| crate::file_error(path, e))?;
        let (chunks, _) = bytes.as_chunks();
        let numbers: Vec<f64> = chunks.iter().map(|bytes| f64::from_le_bytes(*bytes)).collect();
        Ok(Self(numbers.chunks_exact(length + 1).map(|row| (row[0], row[1..].to_vec())).collect()))
    }

    /// The same states for a model that has only some of the bodies; `None` when it has a state that is not known.
    pub fn project(&self, from: &Model, to: &Model) -> Option<Self> {
        let known = from.state_infos();
        let place = |name: &str| known.iter().position(|info| info.name == name);
        let places: Option<Vec<usize>> = to.state_infos().iter().map(|info| place(&info.name)).collect();
        let places = places?;
        let pick = |state: &[f64]| places.iter().map(|&i| state[i]).collect();
        Some(Self(self.0.iter().map(|(t, state)| (*t, pick(state))).collect()))
    }
}

/// Evaluates the forces at all states, `passes` times. Its name tells callgrind where to count.
///
/// # Errors
/// As [`Sim::derivative`].
#[inline(never)]
pub fn evaluate_states(sim: &mut Sim, states: &States, passes: u32, rate: &mut [f64]) -> Result<()> {
    for _ in 0..passes {
        for (t, state) in &states.0 {
            sim.derivative(*t, black_box(state), rate)?;
        }
    }
    Ok(())
}

/// Instructions inside of [`evaluate_states`] while `program` runs with `arguments`.
///
/// # Errors
/// [`Status::File`] when callgrind does not run or the program fails in it.
pub fn instructions(program: &Path, arguments: &[&str], variables: &[(&str, &str)]) -> Result<u64> {
    let output = Command::new("valgrind")
        .args(["--tool=callgrind", "--toggle-collect=*evaluate_states*", "--callgrind-out-file=/dev/null"])
        .arg(program)
        .args(arguments)
        .envs(variables.iter().copied())
        .output()
        .map_err(|e| crate::file_error(Path::new("valgrind"), e))?;
    let text = String::from_utf8_lossy(&output.stderr);
    let counted = text.lines().find_map(|line| line.split_once("Collected :")?.1.trim().parse().ok());
    match counted {
        Some(count) if output.status.success() && count > 0 => Ok(count),
        _ => Err(Error::new(Status::File, format!("callgrind: {}\n{text}", output.status))),
    }
}
