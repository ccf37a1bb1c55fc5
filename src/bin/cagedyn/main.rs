//! `cagedyn`: runs scenes and case sets from the command line and writes tables and pictures of the results.

mod cases;
mod catalogue;
mod check;
mod effects;
mod equilibrium;
mod fmu;
mod heat;
mod info;
mod init;
mod plots;
mod points;
mod report;
mod results;
mod run;
mod schema;
mod shell;
mod spectrum;
mod starts;
mod sweep;
mod terminal;
mod whirl;
mod workers;

use cagedyn::scene::Preset;
use cagedyn::{Result, Scene};
use clap::{Args, Parser, Subcommand, ValueEnum};
use results::formats::TableFormat;
use std::path::PathBuf;
use std::process::ExitCode;
use sweep::{MergeArgs, SweepArgs};

/// Dynamics of cage, rolling elements and rings of a rolling bearing.
#[derive(Parser)]
#[command(name = "cagedyn", version)]
struct Cli {
    #[command(subcommand)]
    command: Command,
    /// Print nothing to standard output, and no progress: only errors and doubts, and the exit code, tell how it went.
    #[arg(long, short, global = true)]
    quiet: bool,
}

/// What to do.
#[derive(Subcommand)]
enum Command {
    /// Run a scene; write its time series, summary and pictures.
    Run(RunArgs),
    /// Tell everything that is wrong with a scene or a case set, with lines; nothing is run.
    Check(CheckArgs),
    /// Write a starter scene with comments for a kind of bearing.
    Init(InitArgs),
    /// Run every case of a case set; write each like `run`, and a comparison.
    Cases(CasesArgs),
    /// Run a scene over a grid or a Latin hypercube of its values; write one table, and a picture. What is done is kept.
    Sweep(SweepArgs),
    /// Put the parts of a sweep, each run by `sweep --part`, together: the files of the whole sweep.
    Merge(MergeArgs),
    /// Write a run as one HTML file to hand on: results, pictures, an animation, the scene.
    Report(ReportArgs),
    /// Temperatures of a scene with a heat balance: steady, or warming up; powers, flows, a picture of the network.
    Heat(HeatArgs),
    /// Steady whirl of the cage without time stepping: speed, place, stability; a branch over a number of the scene.
    Whirl(WhirlArgs),
    /// Equilibrium without time stepping: displacement of the inner ring, contact loads and angles, stiffness.
    Equilibrium(EquilibriumArgs),
    /// Write a scene as a functional mock-up unit, FMI 2.0 or 3.0, for co-simulation and model exchange.
    Fmu(FmuArgs),
    /// Show what a scene contains: bodies, states, effects, channels, geometry.
    Info(InfoArgs),
    /// List the materials and lubricants that scenes can name, or show the values and sources of one.
    Catalogue(CatalogueArgs),
    /// Print the JSON Schema of a file format.
    Schema(SchemaArgs),
    /// Print a script with which a shell completes commands and options.
    Completions(CompletionsArgs),
    /// Print the manual page, or write one for every command.
    Man(ManArgs),
}

/// Arguments of `run`.
#[derive(Args)]
pub struct RunArgs {
    /// Scene file.
    scene: PathBuf,
    /// Folder for the results; made if it does not exist.
    #[arg(long, value_name = "DIR")]
    out: PathBuf,
    /// Formats of the time series, for example csv,mat.
    #[arg(long, value_enum, value_delimiter = ',', default_value = "csv")]
    format: Vec<TableFormat>,
    /// Print the content of summary.json instead of tables.
    #[arg(long)]
    json: bool,
    #[command(flatten)]
    instead: Instead,
    #[command(flatten)]
    sets: Sets,
}

/// Arguments of `cases`.
#[derive(Args)]
pub struct CasesArgs {
    /// Case set file.
    file: PathBuf,
    /// Folder for the results; every case gets a folder of its own in it.
    #[arg(long, value_name = "DIR")]
    out: PathBuf,
    #[command(flatten)]
    instead: Instead,
}

/// Arguments of `report`.
#[derive(Args)]
pub struct ReportArgs {
    /// Scene file, which is run, or a folder of results of `run`.
    #[arg(value_name = "SCENE|DIR")]
    source: PathBuf,
    /// The report; .html is put behind a name without it. NAME.html in this folder, of the scene or folder of this name, unless
    /// given.
    #[arg(long, value_name = "FILE.html")]
    out: Option<PathBuf>,
    #[command(flatten)]
    instead: Instead,
    #[command(flatten)]
    sets: Sets,
}

/// What stands in for what a scene says.
#[derive(Args)]
pub struct Instead {
    /// Simulated time in s, instead of the scene's.
    #[arg(long, value_name = "T", allow_negative_numbers = true, value_parser = parse_time)]
    until: Option<f64>,
    #[arg(long, value_parser = parse_preset, value_name = "PRESET", help = preset_help())]
    preset: Option<Preset>,
    /// End every run after this wall time in s, as a failure with the results so far; no pictures are drawn after it.
    #[arg(long, value_name = "S", allow_negative_numbers = true, value_parser = parse_time)]
    pub max_wall_time: Option<f64>,
    /// Run from so many slightly different starts, and tell which kinds of motion of the cage there are. The files are those of
    /// the scene's own start.
    #[arg(long, value_name = "N", default_value_t = 1, value_parser = clap::value_parser!(u16).range(1..))]
    pub starts: u16,
    /// How far apart these starts are: distance of the cage centre from that of the scene, m.
    #[arg(long, value_name = "M", default_value_t = 1e-9, value_parser = parse_shift, requires = "starts")]
    pub start_shift: f64,
    /// The same for the speed of the cage: largest change as a share of it.
    #[arg(long, value_name = "SHARE", default_value_t = 0.01, value_parser = parse_share, requires = "starts")]
    pub start_spin: f64,
    /// Simulate so many cases or starts at the same time; as many as there are cores unless given. Results do not depend on it, unless
    /// a limit on the wall time ends runs.
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..))]
    pub jobs: Option<u16>,
    /// Write the time series also where it takes more than 2 GB.
    #[arg(long)]
    pub large_table: bool,
}

impl Instead {
    /// Simulated time in s that stands in for that of a scene.
    pub fn until(&self) -> Option<f64> {
        self.until
    }

    /// Whether everything is as the scene says, from its one start.
    pub fn leaves_all(&self) -> bool {
        let Self { until, preset, max_wall_time, starts, jobs, large_table, .. } = self;
        (until, preset, max_wall_time, starts, jobs, large_table) == (&None, &None, &None, &1, &None, &false)
    }

    /// Changes a scene.
    ///
    /// # Errors
    /// [`cagedyn::Status::BadScene`] when the scene's other values do not fit.
    pub fn apply(&self, scene: &mut Scene) -> Result<()> {
        scene.record.duration = self.until.unwrap_or(scene.record.duration);
        scene.solver.preset = self.preset.unwrap_or(scene.solver.preset);
        scene.validate()
    }
}

/// Arguments of `check`.
#[derive(Args)]
pub struct CheckArgs {
    /// Scene or case set file.
    #[arg(value_name = "SCENE|CASES")]
    file: PathBuf,
    /// Print an array of objects with file, line, path and message.
    #[arg(long)]
    json: bool,
    #[command(flatten)]
    sets: Sets,
}

/// Arguments of `init`.
#[derive(Args)]
pub struct InitArgs {
    /// Kind of bearing.
    #[arg(value_enum)]
    kind: init::Kind,
    /// File to write; printed unless given.
    #[arg(long, value_name = "FILE.json")]
    out: Option<PathBuf>,
}

/// Arguments of `info`.
#[derive(Args)]
pub struct InfoArgs {
    /// Scene file.
    scene: PathBuf,
    /// Print it as JSON, in SI units.
    #[arg(long)]
    json: bool,
    #[command(flatten)]
    sets: Sets,
}

/// Arguments of `heat`.
#[derive(Args)]
pub struct HeatArgs {
    /// Scene file with `heat`.
    scene: PathBuf,
    /// Folder for heat.json, heat_flow.svg and, with --warm-up, temperatures.csv; made if it does not exist.
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,
    /// Warm up from the start for some hours of bearing time, instead of where temperatures stay.
    #[arg(long)]
    warm_up: bool,
    /// End the search after this wall time in s, as a failure; what was found until then is written and printed.
    #[arg(long, value_name = "S", allow_negative_numbers = true, value_parser = parse_time)]
    max_wall_time: Option<f64>,
    /// Print the result as JSON.
    #[arg(long)]
    json: bool,
    #[command(flatten)]
    sets: Sets,
}

/// Arguments of `whirl`.
#[derive(Args)]
pub struct WhirlArgs {
    /// Scene file of a cage among elements of prescribed motion.
    scene: PathBuf,
    /// Follow the whirl over a number of the scene, as in inner_ring.speed.constant=52.4:837.8.
    #[arg(long, value_name = "PATH=FROM:TO", value_parser = whirl::parse_vary)]
    vary: Option<whirl::Vary>,
    /// The whirl of a rigid cage under the gravity of the scene instead, as an orbit that closes after a turn.
    #[arg(long, conflicts_with = "vary")]
    gravity: bool,
    /// At which speeds of the inner ring, rad/s, the cage whirls under gravity instead: survival, dropped start, loss of rest.
    #[arg(long, value_name = "FROM:TO", value_parser = whirl::parse_speeds, conflicts_with_all = ["vary", "gravity"])]
    onset: Option<[f64; 2]>,
    /// All steady whirls of a rigid cage instead of one.
    #[arg(long, conflicts_with_all = ["vary", "gravity", "onset"])]
    all: bool,
    /// End the search after this wall time in s, as a failure; what was found until then is written and printed.
    #[arg(long, value_name = "S", allow_negative_numbers = true, value_parser = parse_time)]
    max_wall_time: Option<f64>,
    /// Folder for whirl.json and, with --vary, whirl.csv and whirl.svg; made if it does not exist.
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,
    /// Print the result as JSON.
    #[arg(long)]
    json: bool,
    #[command(flatten)]
    sets: Sets,
}

/// Arguments of `equilibrium`.
#[derive(Args)]
pub struct EquilibriumArgs {
    /// Scene file of a bearing with balls or rollers.
    scene: PathBuf,
    /// One equilibrium for each of N values of the scene from a number to another, or of a list.
    #[arg(long, value_name = "PATH=FROM:TO:N", value_parser = sweep::parse_vary)]
    vary: Option<sweep::Vary>,
    /// What balls follow at speed: outer or inner race control, none (axes parallel to that of the bearing), or friction, their steady motion.
    #[arg(long, value_name = "RACE", default_value = "outer", value_parser = equilibrium::parse_control)]
    control: cagedyn::equilibrium::RaceControl,
    /// Folder for equilibrium.json, equilibrium.svg and contacts.csv, of rollers that tilt line_loads.csv and line_loads.svg, with --vary equilibrium.csv; made if it does not exist.
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,
    /// Print the result as JSON.
    #[arg(long)]
    json: bool,
    #[command(flatten)]
    sets: Sets,
}

/// Arguments of `fmu`.
#[derive(Args)]
pub struct FmuArgs {
    /// Scene file.
    scene: PathBuf,
    /// The unit.
    #[arg(long, value_name = "FILE.fmu")]
    out: PathBuf,
    /// Version of the standard.
    #[arg(long, value_enum, default_value = "3.0")]
    fmi: fmu::Version,
    /// Shared library for this machine, of the same build; that beside the tool or in ../lib unless given.
    #[arg(long, value_name = "FILE")]
    library: Option<PathBuf>,
    /// Shared library for another platform, as in x86_64-windows=cagedyn.dll; may be repeated.
    #[arg(long, value_name = "PLATFORM=FILE", value_parser = fmu::parse_binary)]
    binary: Vec<fmu::Binary>,
    #[command(flatten)]
    sets: Sets,
}

/// Arguments of `schema`.
#[derive(Args)]
pub struct SchemaArgs {
    /// File format.
    #[arg(value_enum, default_value_t = Format::Scene)]
    format: Format,
}

/// Arguments of `catalogue`.
#[derive(Args)]
pub struct CatalogueArgs {
    /// Name of an entry. Absent: the list.
    name: Option<String>,
    /// Print JSON.
    #[arg(long)]
    json: bool,
}

/// Arguments of `completions`.
#[derive(Args)]
pub struct CompletionsArgs {
    /// Shell.
    #[arg(value_enum)]
    shell: clap_complete::Shell,
}

/// Arguments of `man`.
#[derive(Args)]
pub struct ManArgs {
    /// Folder for a page of every command, cagedyn-run.1 and so on; made if it does not exist.
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,
}

/// A file format with a schema.
#[derive(Clone, Copy, ValueEnum)]
pub enum Format {
    /// One bearing and one run.
    Scene,
    /// A base scene and the values that differ from case to case.
    Cases,
}

/// Values that replace those of the scene.
#[derive(Args)]
pub struct Sets {
    /// Replace a value of the scene, as in inner_ring.speed.constant=-104.7; null removes an optional block.
    #[arg(long = "set", value_name = "PATH=VALUE", value_parser = parse_set)]
    list: Vec<(String, String)>,
}

impl Sets {
    /// Path and text of every value.
    pub fn pairs(&self) -> impl Iterator<Item = (&str, &str)> {
        self.list.iter().map(|(path, value)| (path.as_str(), value.as_str()))
    }
}

fn main() -> ExitCode {
    let Cli { command, quiet } = Cli::parse();
    if quiet {
        terminal::be_quiet();
    }
    match dispatch(&command) {
        Ok(code) => code,
        Err(error) => terminal::ended_by(Some(&error)),
    }
}

fn dispatch(command: &Command) -> Result<ExitCode> {
    match command {
        Command::Run(args) => run::command(args),
        Command::Cases(args) => cases::command(args),
        Command::Sweep(args) => sweep::command(args),
        Command::Merge(args) => sweep::merge::command(args),
        Command::Report(args) => report::command(args),
        Command::Heat(args) => heat::command(args),
        Command::Whirl(args) => whirl::command(args),
        Command::Equilibrium(args) => equilibrium::command(args),
        Command::Check(args) => check::command(args),
        Command::Init(args) => init::command(args),
        Command::Fmu(args) => fmu::command(args),
        Command::Info(args) => info::command(args),
        Command::Catalogue(args) => catalogue::command(args),
        Command::Schema(args) => schema::command(args),
        Command::Completions(args) => shell::completions(args),
        Command::Man(args) => shell::man(args),
    }
}

/// Splits `path=value` at the first equals sign; the value may contain more of them.
fn parse_set(text: &str) -> std::result::Result<(String, String), String> {
    match text.split_once('=') {
        Some((path, value)) if !path.trim().is_empty() => {
            Ok((path.trim().to_owned(), value.trim().to_owned()))
        }
        _ => Err("must have the form PATH=VALUE".to_owned()),
    }
}

/// A preset by its name.
fn parse_preset(text: &str) -> std::result::Result<Preset, String> {
    let named = Preset::ALL.into_iter().find(|preset| preset.name() == text);
    named.ok_or_else(|| format!("must be one of {}", preset_names()))
}

fn preset_names() -> String {
    Preset::ALL.map(Preset::name).join(", ")
}

fn preset_help() -> String {
    format!("How accurate, instead of the scene's solver.preset: {}", preset_names())
}

/// A share.
fn parse_share(text: &str) -> std::result::Result<f64, String> {
    match text.parse::<f64>() {
        Ok(share) if (0.0..=1.0).contains(&share) => Ok(share),
        _ => Err("must be a share from 0 to 1".to_owned()),
    }
}

/// A distance in m, above zero and not beyond any clearance.
fn parse_shift(text: &str) -> std::result::Result<f64, String> {
    match text.parse::<f64>() {
        Ok(shift) if shift > 0.0 && shift <= 1e-3 => Ok(shift),
        _ => Err("must be a number of metres above zero, at most 1e-3".to_owned()),
    }
}

/// A time in s, positive and finite.
fn parse_time(text: &str) -> std::result::Result<f64, String> {
    match text.parse::<f64>() {
        Ok(time) if time.is_finite() && time > 0.0 => Ok(time),
        _ => Err("must be a number of seconds above zero".to_owned()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use clap::CommandFactory;

    #[test]
    fn arguments_are_consistent() {
        Cli::command().debug_assert();
    }

    #[test]
    fn sets_are_split_at_the_first_equals_sign() {
        let pair = |path: &str, value: &str| Ok((path.to_owned(), value.to_owned()));
        assert_eq!(parse_set("a.b.0=1e-3"), pair("a.b.0", "1e-3"));
        assert_eq!(parse_set(" title = x = y "), pair("title", "x = y"));
        assert_eq!(parse_set("gravity="), pair("gravity", ""));
        for bad in ["gravity", "=3", "  =3", ""] {
            assert!(parse_set(bad).is_err(), "{bad}");
        }
    }

    #[test]
    fn sets_may_be_repeated() {
        let line = ["cagedyn", "run", "s.json", "--out", "o", "--set", "a=1", "--set", "b.c=-2"];
        let cli = Cli::try_parse_from(line).unwrap();
        let Command::Run(args) = cli.command else { panic!("not a run") };
        assert_eq!(args.sets.pairs().collect::<Vec<_>>(), [("a", "1"), ("b.c", "-2")]);
    }

    #[test]
    fn presets_have_the_names_of_scenes() {
        for preset in Preset::ALL {
            assert_eq!(parse_preset(preset.name()), Ok(preset));
        }
        assert_eq!(parse_preset("fast"), Err("must be one of draft, engineering, reference".to_owned()));
    }

    #[test]
    fn times_are_positive_and_finite() {
        assert_eq!(parse_time("1e-3"), Ok(1e-3));
        for bad in ["0", "-1", "inf", "nan", "1 s"] {
            assert!(parse_time(bad).is_err(), "{bad}");
        }
    }
}
