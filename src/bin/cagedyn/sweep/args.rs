//! Arguments of the commands `sweep` and `merge`.

use super::grid::{MOST_POINTS, Vary, parse_vary};
use super::portion::{Portion, parse_portion};
use crate::{Sets, parse_preset, parse_time, preset_help};
use cagedyn::scene::Preset;
use clap::Args;
use std::path::PathBuf;

/// Arguments of `sweep`.
#[derive(Args)]
pub struct SweepArgs {
    /// Scene file.
    pub(super) scene: PathBuf,
    /// Folder for the results. Points that are done in it are not run again.
    #[arg(long, value_name = "DIR")]
    pub(super) out: PathBuf,
    /// Vary a value of the scene: N values from a number to another, `:log` behind them for equal ratios, or a list as in
    /// solver.preset=draft,engineering. Several are combined.
    #[arg(long, value_name = "PATH=FROM:TO:N", value_parser = parse_vary, required = true)]
    pub(super) vary: Vec<Vary>,
    /// So many points of a Latin hypercube over the ranges PATH=FROM:TO instead of all combinations.
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(1..=MOST_POINTS as i64))]
    pub(super) latin: Option<u32>,
    /// Another hypercube for every number.
    #[arg(long, value_name = "S", default_value_t = 0, requires = "latin")]
    pub(super) seed: u64,
    /// Simulated time in s, instead of the scene's.
    #[arg(long, value_name = "T", allow_negative_numbers = true, value_parser = parse_time)]
    pub(super) until: Option<f64>,
    #[arg(long, value_parser = parse_preset, value_name = "PRESET", help = preset_help())]
    pub(super) preset: Option<Preset>,
    /// Simulate so many points at the same time; as many as there are cores unless given. Results do not depend on it.
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..))]
    pub(super) jobs: Option<u16>,
    /// Run only the points of one of N parts, from 1/N to N/N, each in a folder of its own; `merge` puts them together.
    #[arg(long, value_name = "K/N", value_parser = parse_portion)]
    pub(super) part: Option<Portion>,
    #[command(flatten)]
    pub(super) sets: Sets,
}

/// Arguments of `merge`.
#[derive(Args)]
pub struct MergeArgs {
    /// Folders of all parts of one sweep.
    #[arg(value_name = "PART_DIR", required = true)]
    pub(super) parts: Vec<PathBuf>,
    /// Folder for the results of the whole sweep; made if it does not exist.
    #[arg(long, value_name = "DIR")]
    pub(super) out: PathBuf,
}
