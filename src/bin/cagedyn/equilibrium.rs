//! The command `equilibrium`.

use crate::plots::{equilibrium as picture, line_load_map};
use crate::results::facts;
use crate::results::files::{self, plain, write_csv, write_json, write_text};
use crate::results::table::{self, Align, number};
use crate::run::{in_file, read, stem};
use crate::sweep::{Vary, points};
use crate::{EquilibriumArgs, terminal};
use cagedyn::equilibrium::{Equilibrium, RaceControl, ReferenceLife, equilibrium};
use cagedyn::model::Quantity;
use cagedyn::{Error, Model, Result, Scene};
use serde_json::{Map, Value, json};
use std::f64::consts::PI;
use std::process::ExitCode;

/// The equilibrium of a scene at its start, or one for every value that is varied.
///
/// # Errors
/// A scene that cannot be used or has no equilibrium; results that cannot be written.
pub fn command(args: &EquilibriumArgs) -> Result<ExitCode> {
    let text = read(&args.scene)?;
    let set: Vec<String> = args.sets.pairs().map(|(path, value)| format!("{path}={value}")).collect();
    let of = |varied: Option<(&str, &str)>| -> Result<(Scene, Equilibrium)> {
        let model = Model::new(Scene::from_json_with(&text, args.sets.pairs().chain(varied))?)?;
        let found = equilibrium(&model, args.control)?;
        Ok((model.scene().clone(), found))
    };
    if let Some(vary) = &args.vary {
        let values: Vec<String> =
            points(std::slice::from_ref(vary), None, 0)?.into_iter().flatten().collect();
        let found: Vec<_> = values
            .iter()
            .map(|value| (value.as_str(), of(Some((&vary.path, value))).map(|(_, found)| found)))
            .collect();
        return tell_all(args, vary, &found);
    }
    let (scene, found) = of(None).map_err(|e| in_file(&args.scene, e))?;
    let title = facts::title(scene.title.as_deref(), &stem(&args.scene), &set);
    let whole = as_json(&found);
    if let Some(folder) = &args.out {
        std::fs::create_dir_all(folder).map_err(|e| files::file_error(folder, e))?;
        write_json(&folder.join("equilibrium.json"), &whole)?;
        write_csv(&folder.join("contacts.csv"), contacts(&found))?;
        write_text(&folder.join("equilibrium.svg"), &picture::around(&title, &found)?)?;
        if !found.line_loads.places.is_empty() {
            write_csv(&folder.join("line_loads.csv"), line_loads(&found))?;
            write_text(&folder.join("line_loads.svg"), &picture::along(&title, &found)?)?;
            let map = line_load_map::of_equilibrium(&title, &found)?;
            write_text(&folder.join("line_load_map.svg"), &map)?;
        }
        if let Some(life) = &found.life {
            write_csv(&folder.join("life.csv"), laminae(life))?;
        }
    }
    if args.json {
        terminal::print(&format!("{whole:#}\n"))?;
        return Ok(ExitCode::SUCCESS);
    }
    terminal::print(&in_words(&title, &found))?;
    Ok(ExitCode::SUCCESS)
}

/// Unit for people, and what turns SI into it.
fn for_people(quantity: &Quantity) -> (&'static str, f64) {
    match quantity.unit {
        "m" => ("um", 1e6),
        // Tilts are small.
        "rad" if quantity.name.starts_with("tilt") => ("mrad", 1e3),
        "rad" => ("deg", 180.0 / PI),
        "Pa" => ("GPa", 1e-9),
        "N" => ("N", 1.0),
        "N m" => ("N m", 1.0),
        "N/m" => ("N/mm", 1e-3),
        "rad/s" => ("rad/s", 1.0),
        "m/s" => ("m/s", 1.0),
        _ => ("", 1.0),
    }
}

/// The same of what is known of a life.
fn of_life(quantity: &Quantity) -> (&'static str, f64) {
    match quantity.unit {
        "s" => ("h", 1.0 / 3600.0),
        "1" => ("million turns", 1e-6),
        unit => (unit, 1.0),
    }
}

/// Unit of the force over a coordinate, and of a stiffness.
fn force_unit(coordinate: &Quantity) -> &'static str {
    if coordinate.unit == "rad" { "N m" } else { "N" }
}

fn heading(quantity: &Quantity) -> String {
    let (unit, _) = for_people(quantity);
    let name = quantity.name.replace('_', " ");
    if unit.is_empty() { name } else { format!("{name} {unit}") }
}

fn in_words(title: &str, found: &Equilibrium) -> String {
    let mut text = format!("{title}\nequilibrium\n\n");
    let head = ["inner ring", "displacement", "", "load", ""].map(str::to_owned).to_vec();
    let rows = found.coordinates.iter().enumerate().map(|(k, coordinate)| {
        let (unit, factor) = for_people(coordinate);
        vec![
            coordinate.name.to_owned(),
            number(if found.displacement[k].abs() < NO_DISPLACEMENT {
                0.0
            } else {
                factor * found.displacement[k]
            }),
            unit.to_owned(),
            number(rounded(-found.reaction[k])),
            format!("{}{}", force_unit(coordinate), if found.free[k] { "" } else { ", held" }),
        ]
    });
    let rows: Vec<Vec<String>> = std::iter::once(head).chain(rows).collect();
    add(&mut text, &rows, &[Align::Left, Align::Right, Align::Left, Align::Right]);
    text.push_str("\n  stiffness: change of the load (N, N m) over that of the displacement (m, rad)\n");
    let n = found.coordinates.len();
    let largest = found.stiffness.iter().fold(0.0, |a: f64, b| a.max(b.abs()));
    let names = std::iter::once(String::new()).chain(found.coordinates.iter().map(|c| c.name.to_owned()));
    let rows = (0..n).map(|i| {
        let entries = (0..n).map(|k| {
            let value = found.stiffness[n * i + k];
            if value.abs() < 1e-12 * largest { "0".to_owned() } else { format!("{value:.4e}") }
        });
        std::iter::once(found.coordinates[i].name.to_owned()).chain(entries).collect()
    });
    let rows: Vec<Vec<String>> = std::iter::once(names.collect()).chain(rows).collect();
    add(&mut text, &rows, &[&[Align::Left][..], &[Align::Right; 5]].concat());
    for (title, quantities, names, values) in [
        ("elements", found.element_quantities, elements(found), &found.elements),
        ("contacts", found.contact_quantities, found.contacts.clone(), &found.contact_values),
    ] {
        let head = std::iter::once(title.to_owned()).chain(quantities.iter().map(heading)).collect();
        let rows = names.into_iter().zip(values).map(|(name, values)| {
            let shown = quantities
                .iter()
                .zip(values)
                .map(|(q, value)| number(if value.abs() < NOTHING { 0.0 } else { for_people(q).1 * value }));
            std::iter::once(name).chain(shown).collect()
        });
        let rows: Vec<Vec<String>> = std::iter::once(head).chain(rows).collect();
        text.push('\n');
        add(&mut text, &rows, &[&[Align::Left][..], &[Align::Right; 12]].concat());
    }
    if let Some(life) = &found.life {
        text.push('\n');
        let head = ["reference life", "", ""].map(str::to_owned).to_vec();
        let rows = life.quantities.iter().zip(&life.values).map(|(quantity, value)| {
            let (unit, factor) = of_life(quantity);
            let [value, unit] = if value.is_finite() {
                [number(factor * value), unit.to_owned()]
            } else {
                ["-".to_owned(), String::new()]
            };
            vec![quantity.name.replace('_', " "), value, unit]
        });
        let rows: Vec<Vec<String>> = std::iter::once(head).chain(rows).collect();
        add(&mut text, &rows, &[Align::Left, Align::Right, Align::Left]);
    }
    for warning in &found.warnings {
        text.push_str(&format!("\n  {warning}"));
    }
    if !found.warnings.is_empty() {
        text.push('\n');
    }
    text
}

/// What is told of a life where something is varied: turns, time and load.
const VARIED_OF_LIFE: usize = 3;
/// What is less is round-off, m and rad.
const NO_DISPLACEMENT: f64 = 1e-16;
/// The same of what is known of elements and contacts, in their SI units.
const NOTHING: f64 = 1e-13;

/// A force without the round-off of what cancels in it.
fn rounded(force: f64) -> f64 {
    if force.abs() < 1e-9 { 0.0 } else { force }
}

fn add(text: &mut String, rows: &[Vec<String>], align: &[Align]) {
    for line in table::lines(rows, align) {
        text.push_str(&format!("  {line}\n"));
    }
}

/// Names of the elements: those of their contacts up to the point.
fn elements(found: &Equilibrium) -> Vec<String> {
    let per_element = found.contacts.len() / found.elements.len().max(1);
    let firsts = found.contacts.iter().step_by(per_element.max(1));
    firsts.map(|name| name.split('.').next().unwrap_or_default().to_owned()).collect()
}

fn named(quantities: &[Quantity], name: String, values: &[f64]) -> Value {
    let mut map = Map::from_iter([("name".to_owned(), json!(name))]);
    map.extend(quantities.iter().zip(values).map(|(q, value)| (q.name.to_owned(), json!(value))));
    Value::Object(map)
}

fn as_json(found: &Equilibrium) -> Value {
    let n = found.coordinates.len();
    let coordinates: Vec<_> = found
        .coordinates
        .iter()
        .enumerate()
        .map(|(k, c)| {
            json!({
                "name": c.name, "unit": c.unit, "free": found.free[k], "displacement": found.displacement[k],
                "load": -found.reaction[k], "load_unit": force_unit(c),
            })
        })
        .collect();
    let all = |quantities: &[Quantity], names: Vec<String>, values: &[Vec<f64>]| -> Vec<Value> {
        names.into_iter().zip(values).map(|(name, values)| named(quantities, name, values)).collect()
    };
    let mut whole = json!({
        "coordinates": coordinates,
        "stiffness": found.stiffness.chunks(n.max(1)).collect::<Vec<_>>(),
        "elements": all(found.element_quantities, elements(found), &found.elements),
        "contacts": all(found.contact_quantities, found.contacts.clone(), &found.contact_values),
        "warnings": found.warnings,
        "residual": found.residual,
    });
    if !found.line_loads.places.is_empty() {
        let of_contact = |(name, loads): (&String, &Vec<f64>)| json!({"name": name, "line_load": loads});
        let contacts: Vec<_> = found.contacts.iter().zip(&found.line_loads.values).map(of_contact).collect();
        whole["line_loads"] = json!({"places": found.line_loads.places, "contacts": contacts});
    }
    if let Some(life) = &found.life {
        let values = life.quantities.iter().zip(&life.values);
        let mut told = Map::from_iter(values.map(|(q, value)| (q.name.to_owned(), json!(value))));
        let [outer, inner] = &life.equivalent_loads;
        told.insert("laminae".to_owned(), json!({"places": life.places, "outer": outer, "inner": inner}));
        whole["life"] = Value::Object(told);
    }
    whole
}

/// Name of a column with its unit.
fn column(name: &str, unit: &str) -> String {
    let unit = unit.replace(['/', ' '], "_");
    if unit == "1" { name.to_owned() } else { format!("{name}_{unit}") }
}

fn contacts(found: &Equilibrium) -> Vec<Vec<String>> {
    let columns = found.contact_quantities.iter().map(|q| column(q.name, q.unit));
    let head = std::iter::once("contact".to_owned()).chain(columns).collect();
    let rows = found.contacts.iter().zip(&found.contact_values);
    let rows = rows.map(|(name, values)| {
        std::iter::once(name.clone()).chain(values.iter().copied().map(plain)).collect::<Vec<_>>()
    });
    std::iter::once(head).chain(rows).collect()
}

/// Line loads by place, one column for each contact.
fn line_loads(found: &Equilibrium) -> Vec<Vec<String>> {
    let names = found.contacts.iter().map(|name| column(name, "N/m"));
    let head: Vec<String> = std::iter::once(column("place", "m")).chain(names).collect();
    let row = |(i, place): (usize, &f64)| {
        let loads = found.line_loads.values.iter().map(|values| values[i]);
        std::iter::once(*place).chain(loads).map(plain).collect::<Vec<_>>()
    };
    std::iter::once(head).chain(found.line_loads.places.iter().enumerate().map(row)).collect()
}

/// Equivalent loads of laminae by place.
fn laminae(life: &ReferenceLife) -> Vec<Vec<String>> {
    let head = ["place_m", "outer_equivalent_load_N", "inner_equivalent_load_N"].map(str::to_owned).to_vec();
    let [outer, inner] = &life.equivalent_loads;
    let rows = life
        .places
        .iter()
        .zip(outer)
        .zip(inner)
        .map(|((place, outer), inner)| [*place, *outer, *inner].map(plain).to_vec());
    std::iter::once(head).chain(rows).collect()
}

/// Largest value of a contact quantity; zero of none.
fn largest(found: &Equilibrium, name: &str) -> f64 {
    let place = found.contact_quantities.iter().position(|q| q.name == name);
    let values = found.contact_values.iter().filter_map(|values| values.get(place?).copied());
    values.fold(0.0, f64::max)
}

/// One row for every value that is varied; a value without an equilibrium is a row with its reason.
fn tell_all(args: &EquilibriumArgs, vary: &Vary, all: &[(&str, Result<Equilibrium>)]) -> Result<ExitCode> {
    let first = all.iter().find_map(|(_, found)| found.as_ref().ok());
    let Some(first) = first else {
        let why = all.iter().find_map(|(_, found)| found.as_ref().err());
        let none = || Error::new(cagedyn::Status::BadState, "nothing is varied");
        return Err(in_file(&args.scene, why.cloned().unwrap_or_else(none)));
    };
    let n = first.coordinates.len();
    let names = |part: &'static str| first.coordinates.iter().map(move |c| (part, c));
    let stiffness = (0..n * n).map(|i| {
        let [row, over] = [i / n, i % n].map(|k| &first.coordinates[k]);
        let unit = format!("{}_{}", force_unit(row), over.unit);
        column(&format!("stiffness_{}_{}", row.name, over.name), &unit)
    });
    // Those of the first that is loaded: of an unloaded one there is none.
    let of_life = all.iter().find_map(|(_, found)| found.as_ref().ok()?.life.as_ref());
    let lives: Vec<String> = of_life.map_or_else(Vec::new, |life| {
        life.quantities.iter().take(VARIED_OF_LIFE).map(|q| column(q.name, q.unit)).collect()
    });
    let head = std::iter::once(vary.path.clone())
        .chain(names("displacement").map(|(part, c)| column(&format!("{part}_{}", c.name), c.unit)))
        .chain(names("load").map(|(part, c)| column(&format!("{part}_{}", c.name), force_unit(c))))
        .chain(["largest_normal_force_N".to_owned(), "largest_pressure_Pa".to_owned()])
        .chain(lives.clone())
        .chain(stiffness)
        .chain(["failure".to_owned()]);
    let head: Vec<String> = head.collect();
    let lived = lives.len();
    let row = |(value, found): &(&str, Result<Equilibrium>)| -> Vec<String> {
        let mut row = vec![(*value).to_owned()];
        match found {
            Ok(found) => {
                let peaks = ["normal_force", "largest_pressure"].map(|name| largest(found, name));
                let numbers = found.displacement.iter().copied().chain(found.reaction.iter().map(|x| -x));
                let lives = found.life.as_ref().map_or(&[][..], |life| &life.values);
                let lives = (0..lived).map(|k| lives.get(k).copied().unwrap_or(f64::NAN));
                row.extend(
                    numbers.chain(peaks).chain(lives).chain(found.stiffness.iter().copied()).map(plain),
                );
                row.push(String::new());
            }
            Err(e) => {
                row.resize(head.len() - 1, String::new());
                row.push(e.message.clone());
            }
        }
        row
    };
    let rows: Vec<Vec<String>> = std::iter::once(head.clone()).chain(all.iter().map(row)).collect();
    let whole: Vec<Value> = all
        .iter()
        .map(|(value, found)| match found {
            Ok(found) => json!({"value": value, "equilibrium": as_json(found)}),
            Err(e) => json!({"value": value, "failure": e.message}),
        })
        .collect();
    let whole = json!({"vary": vary.path, "points": whole});
    if let Some(folder) = &args.out {
        std::fs::create_dir_all(folder).map_err(|e| files::file_error(folder, e))?;
        write_json(&folder.join("equilibrium.json"), &whole)?;
        write_csv(&folder.join("equilibrium.csv"), rows.clone())?;
        // Of words there is no axis.
        let numbers: Option<Vec<f64>> = all.iter().map(|(value, _)| value.parse().ok()).collect();
        let places = numbers.map(|numbers| {
            let found = all.iter().map(|(_, found)| found.as_ref().ok());
            numbers.into_iter().zip(found).collect::<Vec<_>>()
        });
        if let Some(places) = places {
            write_text(
                &folder.join("equilibrium.svg"),
                &picture::over(&stem(&args.scene), &vary.path, &places)?,
            )?;
        }
    }
    if args.json {
        terminal::print(&format!("{whole:#}\n"))?;
        return Ok(ExitCode::SUCCESS);
    }
    // For people: displacements, peaks and the diagonal of the stiffness.
    let shown: Vec<usize> = (0..=n)
        .chain(1 + 2 * n..3 + 2 * n)
        .chain(3 + 2 * n..3 + 2 * n + lived.min(1))
        .chain((0..n).map(|k| 3 + 2 * n + lived + k * (n + 1)))
        .chain([head.len() - 1])
        .collect();
    let short = |(i, row): (usize, &Vec<String>)| -> Vec<String> {
        let cell = |k: &usize| match row[*k].parse::<f64>() {
            Ok(x) if i > 0 && *k > 0 => number(x),
            _ => row[*k].clone(),
        };
        shown.iter().map(cell).collect()
    };
    let rows: Vec<Vec<String>> = rows.iter().enumerate().map(short).collect();
    let mut text = format!("equilibrium over {}\n\n", vary.path);
    add(&mut text, &rows, &vec![Align::Right; shown.len() - 1]);
    terminal::print(&text)?;
    Ok(ExitCode::SUCCESS)
}

/// A race control by its name.
///
/// # Errors
/// The names there are.
pub fn parse_control(text: &str) -> std::result::Result<RaceControl, String> {
    let names = RaceControl::ALL.map(|(name, _)| name).join(", ");
    let named = RaceControl::ALL.into_iter().find(|(name, _)| *name == text);
    named.map(|(_, control)| control).ok_or_else(|| format!("must be one of {names}"))
}
