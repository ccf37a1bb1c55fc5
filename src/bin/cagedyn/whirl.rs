//! The command `whirl`.

use crate::plots::whirl_branch;
use crate::results::facts;
use crate::results::files::{self, write_csv, write_json, write_text};
use crate::results::table::{self, Align, number};
use crate::run::{in_file, read, stem};
use crate::{WhirlArgs, terminal};
use cagedyn::whirl::{self, Branch, Exact, Onset, Orbit, Point, Whirl};
use cagedyn::{Result, Scene};
use serde_json::{Value, json};
use std::process::ExitCode;
use std::time::Instant;

/// The steady whirl of a cage, or a branch of it.
///
/// # Errors
/// A scene that cannot be used or has no steady whirl; results that cannot be written.
pub fn command(args: &WhirlArgs) -> Result<ExitCode> {
    let text = read(&args.scene)?;
    let in_scene = |e| in_file(&args.scene, e);
    let scene = Scene::from_json_with(&text, args.sets.pairs()).map_err(in_scene)?;
    let set: Vec<String> = args.sets.pairs().map(|(path, value)| format!("{path}={value}")).collect();
    // That of a scene whose values are varied tells of others.
    let varied =
        args.vary.iter().map(|vary| format!("{}={:?}:{:?}", vary.path, vary.range[0], vary.range[1]));
    let set: Vec<String> = set.into_iter().chain(varied).collect();
    let title = facts::title(scene.title.as_deref(), &stem(&args.scene), &set);
    let started = Instant::now();
    if let Some(range) = args.onset {
        let onset =
            terminal::search("onset", args.max_wall_time, |limits| whirl::onset(&scene, range, limits))?;
        return tell_onset(args, &title, &onset.map_err(in_scene)?, started);
    }
    if args.gravity {
        let orbit = terminal::search("orbit", args.max_wall_time, |limits| whirl::orbit(&scene, limits))?;
        return tell_orbit(args, &title, &orbit.map_err(in_scene)?, started);
    }
    if args.all {
        let whirls = terminal::search("whirls", args.max_wall_time, |limits| whirl::all(&scene, limits))?;
        return tell_all(args, &title, &whirls.map_err(in_scene)?, started);
    }
    let Some(vary) = &args.vary else {
        let found = terminal::search("whirl", args.max_wall_time, |limits| {
            let whirl = whirl::steady(&scene, None, limits)?;
            // Averaging may find what single elements have not.
            let exact = whirl::exact(&scene, &whirl, limits);
            Ok((whirl, exact.ok()))
        })?;
        let (whirl, exact) = found.map_err(in_scene)?;
        return tell(args, &title, (&whirl, exact.as_ref()), started);
    };
    // Values are put into the text again, so that any number of a scene can be varied and is checked.
    let with = |_: &Scene, value: f64| {
        let value = format!("{value:?}");
        Scene::from_json_with(&text, args.sets.pairs().chain([(vary.path.as_str(), value.as_str())]))
    };
    let branch = terminal::search("whirls", args.max_wall_time, |limits| {
        whirl::follow(&scene, vary.range, with, limits, |_| ())
    })?;
    let branch = branch.map_err(in_scene)?;
    let stopped = match &branch.end {
        whirl::End::Stopped(e) => Some(in_scene(e.clone())),
        _ => None,
    };
    let found = as_json(&vary.path, &branch);
    if let Some(folder) = &args.out {
        std::fs::create_dir_all(folder).map_err(|e| files::file_error(folder, e))?;
        write_json(&folder.join("whirl.json"), &found)?;
        write_csv(&folder.join("whirl.csv"), csv(&vary.path, &branch))?;
        write_text(&folder.join("whirl.svg"), &whirl_branch::draw(&title, &vary.path, &branch)?)?;
    }
    if args.json {
        terminal::print(&format!("{found:#}\n"))?;
        return Ok(terminal::ended_by(stopped.as_ref()));
    }
    let mut text = format!("{title}\nsteady whirl without gravity over {}\n\n", vary.path);
    let head = ["", "whirl rad/s", "eccentricity um", "leading rate 1/s", "arcs", "", ""]
        .map(str::to_owned)
        .to_vec();
    let rows = branch.points.iter().map(|point| {
        let Point { parameter, whirl, fold, hopf, grazed } = point;
        let marks = [(*fold, "fold"), (*hopf, "Hopf point"), (*grazed, "other number of wet arcs")];
        let marks: Vec<_> = marks.into_iter().filter_map(|(is, name)| is.then_some(name)).collect();
        vec![
            number(*parameter),
            format!("{:.2}", whirl.speed),
            format!("{:.2}", 1e6 * whirl.eccentricity),
            number(whirl.eigenvalues.first().map_or(f64::NAN, |value| value[0])),
            whirl.arcs.to_string(),
            if whirl.stable() { "stable" } else { "unstable" }.to_owned(),
            marks.join(", "),
        ]
    });
    let rows: Vec<Vec<String>> = std::iter::once(head).chain(rows).collect();
    for line in table::lines(&rows, &[Align::Right; 5]) {
        text.push_str(&format!("  {line}\n"));
    }
    text.push_str(&format!(
        "\n  ends at {}{}\n  {} points in {:.2} s wall time\n",
        branch.end.name(),
        branch.end.why().map_or(String::new(), |why| format!(": {why}")),
        branch.points.len(),
        started.elapsed().as_secs_f64()
    ));
    terminal::print(&text)?;
    Ok(terminal::ended_by(stopped.as_ref()))
}

/// All whirls of a rigid cage.
fn tell_all(args: &WhirlArgs, title: &str, whirls: &[Whirl], started: Instant) -> Result<ExitCode> {
    let found = json!({"whirls": whirls.iter().map(of_whirl).collect::<Vec<_>>()});
    let head = ["whirl rad/s", "eccentricity um", "leading rate 1/s", "arcs", ""].map(str::to_owned).to_vec();
    let rows = whirls.iter().map(|whirl| {
        vec![
            format!("{:.2}", whirl.speed),
            format!("{:.3}", 1e6 * whirl.eccentricity),
            number(whirl.eigenvalues.first().map_or(f64::NAN, |value| value[0])),
            whirl.arcs.to_string(),
            if whirl.stable() { "stable" } else { "unstable" }.to_owned(),
        ]
    });
    let rows: Vec<_> = std::iter::once(head).chain(rows).collect();
    let none = if whirls.is_empty() { "\n  none: the cage can only rest\n" } else { "" };
    let last = format!("{none}\n  {:.2} s wall time\n", started.elapsed().as_secs_f64());
    tell_rows(args, &format!("{title}\nall steady whirls without gravity"), &found, &rows, &last)
}

/// Writes and prints a result that is no branch.
fn tell_rows(
    args: &WhirlArgs,
    head: &str,
    found: &Value,
    rows: &[Vec<String>],
    last: &str,
) -> Result<ExitCode> {
    if let Some(folder) = &args.out {
        std::fs::create_dir_all(folder).map_err(|e| files::file_error(folder, e))?;
        write_json(&folder.join("whirl.json"), found)?;
    }
    if args.json {
        terminal::print(&format!("{found:#}\n"))?;
        return Ok(ExitCode::SUCCESS);
    }
    let mut text = format!("{head}\n\n");
    for line in table::lines(rows, &[Align::Left]) {
        text.push_str(&format!("  {line}\n"));
    }
    text.push_str(last);
    terminal::print(&text)?;
    Ok(ExitCode::SUCCESS)
}

/// The orbit under gravity.
fn tell_orbit(args: &WhirlArgs, title: &str, orbit: &Orbit, started: Instant) -> Result<ExitCode> {
    let found = json!({
        "whirl_speed": orbit.speed,
        "whirl_speed_range": orbit.range,
        "eccentricity": orbit.eccentricity,
        "multiplier": orbit.multiplier,
        "stable": orbit.multiplier < 1.0,
    });
    let [slow, fast] = orbit.range;
    let [near, far] = orbit.eccentricity.map(|e| 1e6 * e);
    let rows = [
        ["mean whirl speed".to_owned(), format!("{:.2} rad/s", orbit.speed)],
        ["slowest and fastest in a turn".to_owned(), format!("{slow:.1} and {fast:.1} rad/s")],
        ["eccentricity".to_owned(), format!("{near:.2} to {far:.2} um")],
        ["multiplier of a turn".to_owned(), format!("{:.3}", orbit.multiplier)],
        ["stable".to_owned(), if orbit.multiplier < 1.0 { "yes" } else { "no" }.to_owned()],
    ];
    let seconds = started.elapsed().as_secs_f64();
    let last = format!("\n  {} Newton steps in {seconds:.1} s wall time\n", orbit.steps);
    tell_rows(args, &format!("{title}\nwhirl under gravity, averaged"), &found, &rows.map(Vec::from), &last)
}

/// The speeds at which a cage whirls.
fn tell_onset(args: &WhirlArgs, title: &str, onset: &Onset, started: Instant) -> Result<ExitCode> {
    let Onset { survival, dropped_start, loss_of_rest, known, ref stopped } = *onset;
    let why = stopped.as_ref().map(|e| e.message.as_str());
    let found = json!({
        "survival": survival,
        "dropped_start": dropped_start,
        "loss_of_rest": loss_of_rest,
        "range": args.onset,
        "known": known,
        "stopped": why,
    });
    let shown = |place: usize, speed: Option<f64>, none: &str| match speed {
        Some(speed) => format!("{speed:.2} rad/s ({:.0} 1/min)", speed * 30.0 / std::f64::consts::PI),
        None if place >= known => "not known".to_owned(),
        None => none.to_owned(),
    };
    let rows = [
        ["a whirl goes on down to".to_owned(), shown(0, survival, "the slowest of these speeds")],
        ["a dropped cage comes to whirl from".to_owned(), shown(1, dropped_start, "none of these speeds on")],
        ["a cage at rest is lost at".to_owned(), shown(2, loss_of_rest, "none of these speeds")],
    ];
    let last = format!("\n  {:.1} s wall time\n", started.elapsed().as_secs_f64());
    tell_rows(
        args,
        &format!("{title}\nonset of whirl under gravity, speeds of the inner ring"),
        &found,
        &rows.map(Vec::from),
        &last,
    )?;
    Ok(terminal::ended_by(stopped.as_ref()))
}

/// Reads `from:to` as speeds.
///
/// # Errors
/// What is wrong with it.
pub fn parse_speeds(text: &str) -> std::result::Result<[f64; 2], String> {
    let form = || "must have the form FROM:TO in rad/s, as in 10:210".to_owned();
    let (from, to) = text.split_once(':').ok_or_else(form)?;
    let read =
        |text: &str| text.trim().parse::<f64>().ok().filter(|x| x.is_finite() && *x > 0.0).ok_or_else(form);
    Ok([read(from)?, read(to)?])
}

/// One whirl.
fn tell(
    args: &WhirlArgs,
    title: &str,
    (whirl, exact): (&Whirl, Option<&Exact>),
    started: Instant,
) -> Result<ExitCode> {
    let found = || {
        let mut found = of_whirl(whirl);
        found["exact"] = json!(exact.map(|exact| json!({
            "whirl_speed": exact.speed,
            "passage": exact.passage,
            "leading_rate": exact.leading_rate,
        })));
        found
    };
    if let Some(folder) = &args.out {
        std::fs::create_dir_all(folder).map_err(|e| files::file_error(folder, e))?;
        write_json(&folder.join("whirl.json"), &found())?;
    }
    if args.json {
        terminal::print(&format!("{:#}\n", found()))?;
        return Ok(ExitCode::SUCCESS);
    }
    let mut rows = vec![
        vec!["whirl speed".to_owned(), format!("{:.2} rad/s", whirl.speed)],
        vec!["eccentricity".to_owned(), format!("{:.3} um", 1e6 * whirl.eccentricity)],
        vec!["elements ahead of their pockets".to_owned(), format!("{} rad", number(whirl.lead))],
        vec!["wet arcs".to_owned(), whirl.arcs.to_string()],
        vec!["stable".to_owned(), if whirl.stable() { "yes" } else { "no" }.to_owned()],
    ];
    let speed = exact.map_or("none found".to_owned(), |exact| {
        format!("{:.2} rad/s, leading rate {} 1/s", exact.speed, number(exact.leading_rate))
    });
    rows.push(vec!["exact, among single elements".to_owned(), speed]);
    for (k, amplitude) in whirl.amplitudes.iter().enumerate() {
        rows.push(vec![format!("wave of order {}", k + 2), format!("{:.3} um", 1e6 * amplitude)]);
    }
    let mut text = format!("{title}\nsteady whirl without gravity\n\n");
    for line in table::lines(&rows, &[Align::Left]) {
        text.push_str(&format!("  {line}\n"));
    }
    text.push_str("\n  eigenvalues: rate 1/s, frequency rad/s\n");
    let values = whirl.eigenvalues.iter().filter(|[_, frequency]| *frequency >= 0.0);
    let rows: Vec<_> = values.map(|[rate, frequency]| vec![number(*rate), number(*frequency)]).collect();
    for line in table::lines(&rows, &[Align::Right, Align::Right]) {
        text.push_str(&format!("  {line}\n"));
    }
    let seconds = started.elapsed().as_secs_f64();
    text.push_str(&format!("\n  {} Newton steps in {seconds:.3} s wall time\n", whirl.steps));
    terminal::print(&text)?;
    Ok(ExitCode::SUCCESS)
}

fn of_whirl(whirl: &Whirl) -> Value {
    let eigenvalues: Vec<_> = whirl
        .eigenvalues
        .iter()
        .map(|[rate, frequency]| json!({"rate": rate, "frequency": frequency}))
        .collect();
    json!({
        "whirl_speed": whirl.speed,
        "eccentricity": whirl.eccentricity,
        "lead": whirl.lead,
        "amplitudes": whirl.amplitudes,
        "arcs": whirl.arcs,
        "stable": whirl.stable(),
        "eigenvalues": eigenvalues,
    })
}

fn as_json(path: &str, branch: &Branch) -> Value {
    let points: Vec<_> = branch
        .points
        .iter()
        .map(|point| {
            let mut value = of_whirl(&point.whirl);
            value["parameter"] = json!(point.parameter);
            value["fold"] = json!(point.fold);
            value["hopf"] = json!(point.hopf);
            value["grazed"] = json!(point.grazed);
            value
        })
        .collect();
    json!({"vary": path, "points": points, "end": branch.end.name(), "why": branch.end.why()})
}

fn csv(path: &str, branch: &Branch) -> Vec<Vec<String>> {
    let head = [
        path,
        "whirl_speed_rad_s",
        "eccentricity_m",
        "leading_rate_1_s",
        "leading_frequency_rad_s",
        "arcs",
        "stable",
        "fold",
        "hopf",
        "grazed",
    ];
    let rows = branch.points.iter().map(|point| {
        let whirl = &point.whirl;
        let [rate, frequency] = whirl.eigenvalues.first().copied().unwrap_or([f64::NAN; 2]);
        let numbers = [point.parameter, whirl.speed, whirl.eccentricity, rate, frequency].map(files::plain);
        let flags = [whirl.stable(), point.fold, point.hopf, point.grazed].map(|flag| flag.to_string());
        numbers.into_iter().chain([whirl.arcs.to_string()]).chain(flags).collect()
    });
    std::iter::once(head.map(str::to_owned).to_vec()).chain(rows).collect()
}

/// What is varied.
#[derive(Clone, Debug)]
pub struct Vary {
    path: String,
    range: [f64; 2],
}

/// Reads `PATH=from:to`.
///
/// # Errors
/// What is wrong with it.
pub fn parse_vary(text: &str) -> std::result::Result<Vary, String> {
    let form = || "must have the form PATH=FROM:TO, as in inner_ring.speed.constant=52.4:837.8".to_owned();
    let (path, range) = text.split_once('=').ok_or_else(form)?;
    let (from, to) = range.split_once(':').ok_or_else(form)?;
    let read = |text: &str| text.trim().parse::<f64>().ok().filter(|x| x.is_finite()).ok_or_else(form);
    let range = [read(from)?, read(to)?];
    if range[0] == range[1] {
        return Err("must go from one number to another".to_owned());
    }
    Ok(Vary { path: path.trim().to_owned(), range })
}
