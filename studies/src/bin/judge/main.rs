//! Judges the presets by plausible random scenes that nothing was tuned to: `make judge SEED=1000 N=2000`.
//!
//! Every scene runs with every preset. Counted are those that are refused, that fail, that the library itself does not trust,
//! and those whose missing energy is more than the preset promises although they are trusted. `--means` compares the means of
//! the cage's place and speed with two runs of `reference` that start 1e-9 of a clearance apart.

mod tuning;

use cagedyn::integrate::Tuning;
use cagedyn_studies::bearings;
use cagedyn_studies::judge::run::Kind;
use cagedyn_studies::judge::{run, summary};
use clap::Parser;
use std::process::ExitCode;

#[derive(Parser)]
#[command(about)]
struct Arguments {
    /// The first scene.
    #[arg(long, default_value_t = 1000)]
    seed: u64,
    /// Scenes of published bearings with everything that a scene can have, which have numbers of their own.
    #[arg(long)]
    published: bool,
    /// Scenes of balls that move in space, with numbers of their own.
    #[arg(long, conflicts_with = "published")]
    space: bool,
    /// The same scenes with cages that tilt among the balls.
    #[arg(long, requires = "space")]
    cages: bool,
    /// Scenes of rollers that move in space, with numbers of their own.
    #[arg(long, conflicts_with_all = ["published", "space"])]
    rollers: bool,
    /// Print the table of published bearings instead.
    #[arg(long)]
    bearings: bool,
    /// Number of scenes.
    #[arg(long, default_value_t = 200)]
    n: u64,
    /// Length of each run, s.
    #[arg(long, default_value_t = 0.03)]
    duration: f64,
    /// Also compare means with `reference`, which takes ten times as long.
    #[arg(long)]
    means: bool,
    /// Only these presets.
    #[arg(long)]
    preset: Vec<String>,
    /// Print what each constant of `auto` does instead.
    #[arg(long)]
    tuning: bool,
    /// Print the means of the first scene over so many starts instead.
    #[arg(long)]
    starts: Option<u32>,
    /// Also print the evaluations of every run.
    #[arg(long)]
    evaluations: bool,
    /// Print the scene instead of running it.
    #[arg(long)]
    print: bool,
    /// Limit of the wall time of a run, s.
    #[arg(long, default_value_t = 600.0)]
    wall_time: f64,
    /// Stop runs at the first record after so many evaluations.
    #[arg(long, default_value_t = u64::MAX)]
    most_evaluations: u64,
    /// A constant of `auto` that is not as it is by default, as NAME=VALUE.
    #[arg(long)]
    set: Vec<String>,
}

fn main() -> ExitCode {
    let arguments = Arguments::parse();
    if arguments.bearings {
        print!("{}", bearings::page());
        return ExitCode::SUCCESS;
    }
    let kind = match (arguments.published, arguments.space, arguments.rollers) {
        (true, ..) => Kind::Published,
        (_, true, _) => Kind::Space { caged: arguments.cages },
        (.., true) => Kind::Rollers,
        _ => Kind::Plain,
    };
    if arguments.print {
        println!("{:#}", kind.scene(arguments.seed, arguments.duration));
        return ExitCode::SUCCESS;
    }
    let Arguments {
        seed, n, duration, means, preset: presets, wall_time, evaluations, most_evaluations, ..
    } = arguments;
    let mut tuning = Tuning::default();
    for text in &arguments.set {
        let value = text.split_once('=').and_then(|(name, value)| Some((name, value.parse().ok()?)));
        if !value.is_some_and(|(name, value)| tuning.set(name, value)) {
            eprintln!("{text}: no constant of auto, or no value");
            return ExitCode::FAILURE;
        }
    }
    let options = run::Options { kind, duration, means, presets, wall_time, most_evaluations, tuning };
    if arguments.tuning {
        print!("{}", tuning::page(seed..seed + n, &options));
        return ExitCode::SUCCESS;
    }
    if let Some(count) = arguments.starts {
        return match run::over_starts(seed, count, &options) {
            Ok(means) => {
                print!("{}", summary::starts(&means));
                ExitCode::SUCCESS
            }
            Err(e) => {
                eprintln!("{seed}: {e}");
                ExitCode::FAILURE
            }
        };
    }
    let outcomes = run::judge_all(seed..seed + n, &options, |outcome| {
        if let Some(line) = summary::line(outcome) {
            println!("{line}");
        }
        if evaluations {
            println!("{} {}: {} evaluations", outcome.number, outcome.preset, outcome.evaluations);
        }
    });
    println!("{}", summary::table(&outcomes));
    ExitCode::SUCCESS
}
