//! The command `heat`.

use crate::plots::heat_flow;
use crate::results::files::{write_csv, write_json, write_text};
use crate::results::table::{self, Align, celsius, number};
use crate::results::{facts, files};
use crate::run::{in_file, read, stem};
use crate::{HeatArgs, terminal};
use cagedyn::heat::{HeatBalance, HeatState};
use cagedyn::{Model, Result, Scene, Status};
use serde_json::json;
use std::process::ExitCode;
use std::time::Instant;

/// Temperatures of a bearing, where its heat comes from and where it goes.
///
/// # Errors
/// A scene that cannot be used, or whose temperatures do not settle; results that cannot be written.
pub fn command(args: &HeatArgs) -> Result<ExitCode> {
    let scene = Scene::from_json_with(&read(&args.scene)?, args.sets.pairs());
    let in_scene = |e| in_file(&args.scene, e);
    let mut heat = scene.and_then(Model::new).and_then(HeatBalance::new).map_err(in_scene)?;
    let started = Instant::now();
    let mut history = Vec::new();
    let ended = terminal::search("heat", args.max_wall_time, |limits| {
        heat.set_limits(limits.clone());
        if args.warm_up {
            heat.warm_up(|time, state| history.push((time, state.clone())))
        } else {
            heat.settle()
        }
    })?;
    // What bursts came to before the end of a search that was stopped is kept.
    let (state, stopped) = match (ended, heat.last()) {
        (Ok(state), _) => (state, None),
        (Err(e), Some(last)) if matches!(e.status, Status::Cancelled | Status::OutOfTime) => {
            (last.clone(), Some(e))
        }
        (Err(e), _) => return Err(in_scene(e)),
    };
    let stopped = stopped.map(in_scene);
    let as_json = |names: &[String], links: &[[String; 2]]| {
        let mut found = as_json(names, links, &state);
        found["stopped"] = json!(stopped.as_ref().map(|e| e.message.as_str()));
        found
    };
    let set: Vec<String> = args.sets.pairs().map(|(path, value)| format!("{path}={value}")).collect();
    let title = facts::title(heat.model().scene().title.as_deref(), &stem(&args.scene), &set);
    let names: Vec<String> = heat.names().map(str::to_owned).collect();
    let links: Vec<[String; 2]> = heat.links().map(|ends| ends.map(str::to_owned)).collect();
    if let Some(folder) = &args.out {
        std::fs::create_dir_all(folder).map_err(|e| files::file_error(folder, e))?;
        write_json(&folder.join("heat.json"), &as_json(&names, &links))?;
        let ambient = heat.model().scene().heat.as_ref().map_or(f64::NAN, |heat| heat.ambient);
        let picture = heat_flow::draw(&title, &names, &links, &state, ambient)?;
        write_text(&folder.join("heat_flow.svg"), &picture)?;
        if args.warm_up {
            let head = ["time_s".to_owned()].into_iter().chain(names.iter().map(|name| format!("{name}_K")));
            let rows = history.iter().map(|(time, state)| {
                std::iter::once(time).chain(&state.temperatures).map(|x| files::plain(*x)).collect()
            });
            write_csv(&folder.join("temperatures.csv"), std::iter::once(head.collect()).chain(rows))?;
        }
    }
    if args.json {
        terminal::print(&format!("{:#}\n", as_json(&names, &links)))?;
        return Ok(terminal::ended_by(stopped.as_ref()));
    }
    let mut text = format!("{title}\n");
    let last = history.last().map_or(f64::NAN, |(time, _)| *time);
    text.push_str(&if args.warm_up {
        format!("warming up from the start, after {} s\n", number(last))
    } else if stopped.is_some() {
        "temperatures on the way to where they stay\n".to_owned()
    } else {
        "steady temperatures\n".to_owned()
    });
    section(&mut text, "", temperatures(&names, &state));
    section(&mut text, "heat", sources(&state));
    for (name, power) in &state.in_no_lump {
        text.push_str(&format!("  in no lump: {name} {} W\n", number(*power)));
    }
    section(&mut text, "flows", flows(&links, &state));
    if !history.is_empty() {
        section(&mut text, "temperatures over time, K and °C", over_time(&names, &history));
    }
    if state.carried != 0.0 {
        text.push_str(&format!("  oil that flows through carries {} W away\n", number(state.carried)));
    }
    if let Some(clearance) = state.clearance {
        text.push_str(&format!("\n  radial clearance  {:.2} um\n", 1e6 * clearance));
    }
    if state.scatter > 0.0 {
        text.push_str(&format!(
            "\n  temperatures are means over bursts, with a standard error of {} K at most\n",
            number(state.scatter)
        ));
    }
    text.push_str(&format!(
        "\n  lubricant  {} Pa s\n  whirl      {} rad/s\n  time       {} bursts of motion in {:.2} s wall time\n",
        number(state.viscosity),
        number(state.whirl_speed),
        state.bursts,
        started.elapsed().as_secs_f64()
    ));
    let starts =
        state.temperatures.iter().enumerate().map(|(i, t)| format!("--set heat.nodes.{i}.start={t:.2}"));
    text.push_str(&format!(
        "\n  other commands run the scene at these temperatures with\n  {}\n",
        starts.collect::<Vec<_>>().join(" ")
    ));
    terminal::print(&text)?;
    Ok(terminal::ended_by(stopped.as_ref()))
}

fn section(text: &mut String, name: &str, rows: Vec<Vec<String>>) {
    text.push('\n');
    if !name.is_empty() {
        text.push_str(&format!("{name}\n"));
    }
    let align =
        [Align::Left, Align::Right, Align::Right, Align::Right, Align::Right, Align::Right, Align::Right];
    for line in table::lines(&rows, &align) {
        text.push_str(&format!("  {line}\n"));
    }
}

fn temperatures(names: &[String], state: &HeatState) -> Vec<Vec<String>> {
    let head = ["lump", "temperature", "", "heat made in it"].map(str::to_owned).to_vec();
    let rows = names.iter().zip(state.temperatures.iter().zip(&state.heat));
    let rows = rows.map(|(name, (temperature, heat))| {
        vec![
            name.clone(),
            format!("{temperature:.2} K"),
            format!("{:.2} °C", celsius(*temperature)),
            format!("{} W", number(*heat)),
        ]
    });
    std::iter::once(head).chain(rows).collect()
}

fn sources(state: &HeatState) -> Vec<Vec<String>> {
    let all: f64 = state.heat.iter().sum();
    let bearing = std::iter::once(("bearing, from catalogue values", state.of_bearing));
    let motion = state.of_motion.iter().map(|(name, power)| (name.as_str(), *power));
    motion
        .chain(bearing)
        .filter(|(_, power)| *power != 0.0)
        .map(|(name, power)| {
            vec![name.to_owned(), format!("{} W", number(power)), format!("{:.1} %", 100.0 * power / all)]
        })
        .collect()
}

fn flows(links: &[[String; 2]], state: &HeatState) -> Vec<Vec<String>> {
    let rows = links.iter().zip(&state.flows);
    rows.map(|([from, to], flow)| {
        let (from, to) = if *flow >= 0.0 { (from, to) } else { (to, from) };
        vec![format!("{from} to {to}"), format!("{} W", number(flow.abs()))]
    })
    .collect()
}

fn over_time(names: &[String], history: &[(f64, HeatState)]) -> Vec<Vec<String>> {
    let head = std::iter::once("s".to_owned()).chain(names.iter().cloned()).collect();
    let rows = history.iter().map(|(time, state)| {
        let temperatures = state.temperatures.iter().map(|t| format!("{t:.2} {:.2}", celsius(*t)));
        std::iter::once(number(*time)).chain(temperatures).collect()
    });
    std::iter::once(head).chain(rows).collect()
}

fn as_json(names: &[String], links: &[[String; 2]], state: &HeatState) -> serde_json::Value {
    let nodes: Vec<_> = names
        .iter()
        .zip(state.temperatures.iter().zip(&state.heat))
        .map(
            |(name, (temperature, heat))| json!({"name": name, "temperature_k": temperature, "heat_w": heat}),
        )
        .collect();
    let flows: Vec<_> = links
        .iter()
        .zip(&state.flows)
        .map(|([from, to], flow)| json!({"from": from, "to": to, "flow_w": flow}))
        .collect();
    let sources: Vec<_> =
        state.of_motion.iter().map(|(name, power)| json!({"power": name, "heat_w": power})).collect();
    json!({
        "nodes": nodes,
        "links": flows,
        "sources": sources,
        "bearing_torque_heat_w": state.of_bearing,
        "in_no_lump": state.in_no_lump.iter().map(|(name, power)| json!({"power": name, "heat_w": power})).collect::<Vec<_>>(),
        "carried_w": state.carried,
        "viscosity_pa_s": state.viscosity,
        "radial_clearance_m": state.clearance,
        "standard_error_k": state.scatter,
        "whirl_speed_rad_s": state.whirl_speed,
        "bursts": state.bursts,
    })
}
