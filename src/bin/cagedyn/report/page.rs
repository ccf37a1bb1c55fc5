//! The page of a report: its parts as HTML, put into their places of `report.html`.

use super::animation::Animation;
use super::gather::Gathered;
use super::scene_text::{Remarks, marked};
use crate::plots::style::escaped;
use crate::results::report::{cost, motion, results, window};
use crate::results::summary::{Balance, Summary, few_turns};
use crate::results::table::{number, rounded};
use std::path::Path;

/// The whole page but for the line that a report begins with.
pub fn page(g: &Gathered) -> String {
    let s = &g.summary;
    let parts = |name: &str| match name {
        "version" => s.version.to_string(),
        "title" => escaped(&s.title),
        "css" => include_str!("report.css").to_owned(),
        "js" => concat!(
            "\"use strict\";\n",
            include_str!("bearing.js"),
            include_str!("space.js"),
            include_str!("unrolled.js"),
            include_str!("pictures.js"),
            include_str!("report.js")
        )
        .to_owned(),
        "zoom" => {
            concat!("/*\n", include_str!("panzoom.license.txt"), "*/\n", include_str!("panzoom.min.js"))
                .to_owned()
        }
        "facts" => escaped(&g.facts),
        "trust" => trust(g),
        "origin" => origin(s),
        "results" => summary_table(s),
        "animation" => g.animation.as_ref().map_or(String::new(), animation),
        "pictures" => pictures(g),
        "balance" => s.power_balance.as_ref().map_or_else(no_balance, balance),
        "cost" => costs(s),
        "statistics" => statistics(s) + &extremes(s),
        "scene" => scene(g),
        "missing" => missing(&g.missing),
        other => unfilled(other),
    };
    filled(include_str!("report.html"), parts)
}

/// A template with its places filled; what is put in is not looked at again.
fn filled(template: &str, part: impl Fn(&str) -> String) -> String {
    let mut pieces = template.split("{{");
    let mut text = pieces.next().unwrap_or_default().to_owned();
    for piece in pieces {
        let (name, rest) = piece.split_once("}}").unwrap_or((piece, ""));
        text.push_str(&part(name));
        text.push_str(rest);
    }
    text
}

/// A place of the template that nothing fills stays to be seen; a test looks for it.
fn unfilled(name: &str) -> String {
    format!("{{{{{name}}}}}")
}

fn trust(g: &Gathered) -> String {
    let s = &g.summary;
    let mut wrong: Vec<String> = s.error.iter().map(|e| format!("The run failed: {e}")).collect();
    if s.interrupted {
        wrong.push("The run was interrupted.".to_owned());
    }
    if !s.complete {
        let end = number(s.simulated_time_s);
        wrong.push(format!("The results are incomplete: they end at {end} s."));
    }
    wrong.extend(s.doubts.iter().cloned());
    let but = !s.warnings.is_empty() || !s.remarks.is_empty() || s.few_turns().is_some();
    let (class, says) = match (s.trusted, s.complete) {
        (true, true) if but => ("trust but", "Trusted"),
        (true, true) => ("trust", "Trusted"),
        (true, false) => ("trust no", "Incomplete"),
        (false, _) => ("trust no", "Not to be trusted"),
    };
    let kept = match wrong.is_empty() {
        true => format!(": the run kept what the preset {} promises.", escaped(&s.integration.preset)),
        false => list(&wrong),
    };
    format!(
        "<div class=\"{class}\"><b>{says}</b>{kept}<p>That stands under these conditions:</p>{}</div>",
        list(&conditions(g))
    )
}

/// What a reader has to know before trusting results.
fn conditions(g: &Gathered) -> Vec<String> {
    let s = &g.summary;
    let mut all = Vec::new();
    if let Some(few) = s.few_turns() {
        all.push(format!("The run has {few}, so its means say little of how the bearing runs."));
    }
    let changing = s.statistics.iter().filter(|(_, of)| !of.spread.stationary).count();
    if changing > 0 {
        let count = s.statistics.len();
        all.push(format!("{changing} of {count} channels were still changing in the averaging window."));
    }
    all.extend(s.remarks.iter().map(|remark| format!("During the run: {remark}.")));
    all.extend(s.warnings.iter().map(|warning| format!("Unlikely value of the scene: {warning}")));
    let assumed = Remarks::of(g.comment.as_ref()).assumed;
    all.push(match assumed.as_ref().map(Vec::len) {
        None => "The scene does not say which of its values are assumed.".to_owned(),
        Some(0) => "The scene names none of its values as assumed.".to_owned(),
        Some(1) => "The scene names one of its values as assumed; it is marked below.".to_owned(),
        Some(n) => format!("The scene names {n} of its values as assumed; they are marked below."),
    });
    let balance = s.power_balance.as_ref().map_or(String::new(), |balance| {
        format!(
            " {:.4} % of the energy that passed through is missing.",
            100.0 * balance.relative_residual.abs()
        )
    });
    all.push(format!("Judged is how exactly the equations of this scene were solved, not whether they are those of the bearing.{balance}"));
    all
}

fn list(lines: &[String]) -> String {
    let items: String = lines.iter().map(|line| format!("<li>{}</li>", escaped(line))).collect();
    if items.is_empty() { items } else { format!("<ul>{items}</ul>") }
}

fn origin(s: &Summary) -> String {
    // Where the file lies is not of the run.
    let file =
        Path::new(&s.scene).file_name().map_or(String::new(), |name| name.to_string_lossy().into_owned());
    let case = s.case.as_ref().map_or(String::new(), |case| format!(", case {case}"));
    let set = if s.set.is_empty() { String::new() } else { format!(", with {}", s.set.join(", ")) };
    escaped(&format!("cagedyn {}; scene {file}{case}{set}", s.version))
}

/// A table with a head; cells are HTML, those of columns marked true are numbers.
fn table(head: &[(&str, bool)], rows: impl Iterator<Item = Vec<String>>) -> String {
    let class = |i: usize| if head.get(i).is_some_and(|(_, number)| *number) { " class=\"n\"" } else { "" };
    let mut html = "<div class=\"scroll\"><table><thead><tr>".to_owned();
    for (i, (name, _)) in head.iter().enumerate() {
        html.push_str(&format!("<th{}>{name}</th>", class(i)));
    }
    html.push_str("</tr></thead><tbody>\n");
    for row in rows {
        html.push_str("<tr>");
        for (i, cell) in row.iter().enumerate() {
            html.push_str(&format!("<td{}>{cell}</td>", class(i)));
        }
        html.push_str("</tr>\n");
    }
    html + "</tbody></table></div>"
}

/// A number with a typographic minus sign.
fn signed(text: &str) -> String {
    escaped(&text.replace('-', "\u{2212}"))
}

fn summary_table(s: &Summary) -> String {
    let w = &s.window;
    let mut html =
        format!("<p>Averaging window: {} s to {} s, {}.", rounded(w.from_s), rounded(w.to_s), window(w));
    if let Some(whirl) = &s.whirl {
        html.push_str(&format!(" Motion of the cage in it: <b>{}</b>.", escaped(&motion(whirl))));
    }
    if let Some(wobble) = &s.wobble {
        html.push_str(&format!(" Wobble of its axis: <b>{}</b>.", escaped(&motion(wobble))));
    }
    html.push_str("</p>\n");
    if let Some(starts) = &s.starts {
        html.push_str(&format!("<p>From {} starts: {}</p>\n", starts.count, escaped(&starts.in_words())));
    }
    let head = [
        ("quantity", false),
        ("mean or value", true),
        ("± standard deviation", true),
        ("standard error of the mean", true),
        ("unit", false),
        ("", false),
    ];
    let rows = results(s).into_iter().map(|row| {
        let [deviation, error] = row.spread.unwrap_or_default();
        let unit = if row.unit == "um" { "µm" } else { row.unit };
        vec![
            row.name.to_owned(),
            signed(&row.value),
            signed(&deviation),
            if error == "?" { "still changing".to_owned() } else { signed(&error) },
            unit.to_owned(),
            signed(&row.remark),
        ]
    });
    html + &table(&head, rows)
}

fn animation(a: &Animation) -> String {
    let every = match a.stride {
        1 => "every record".to_owned(),
        n => format!("one of {n} records"),
    };
    let frames = format!(
        "{} frames, {every}, from {} s to {} s of the run; places between them are interpolated, forces are not.",
        a.frames,
        rounded(a.span[0]),
        rounded(a.span[1])
    );
    filled(include_str!("animation.html"), |name| match name {
        "frames" => frames.clone(),
        // Nothing in it ends the script.
        "json" => a.json.replace('<', "\\u003c"),
        other => unfilled(other),
    })
}

fn pictures(g: &Gathered) -> String {
    if g.pictures.is_empty() {
        return "<p>There are no pictures of this run.</p>".to_owned();
    }
    let figures: String = g.pictures.iter().map(|svg| format!("<figure>\n{svg}</figure>\n")).collect();
    format!("<div class=\"pictures\">\n{figures}</div>")
}

fn no_balance() -> String {
    "<p>Forces are undefined at the end of the run, so there is no balance.</p>".to_owned()
}

fn balance(b: &Balance) -> String {
    let time = b.to_s - b.from_s;
    let supplied: f64 = b.work_j.iter().map(|(_, work)| work.max(0.0)).sum();
    let largest = b.work_j.iter().fold(0.0, |m: f64, (_, work)| m.max(work.abs()));
    let mut works: Vec<_> = b.work_j.iter().collect();
    works.sort_by(|(_, x), (_, y)| y.abs().total_cmp(&x.abs()));
    let share = |work: f64| if supplied > 0.0 { number(100.0 * work / supplied) } else { String::new() };
    let row = |name: &str, work: f64, bar: bool| {
        let width = if largest > 0.0 && bar { 12.0 * work.abs() / largest } else { 0.0 };
        let class = if work > 0.0 { "bar in" } else { "bar" };
        vec![
            escaped(&name.replace('_', " ")),
            signed(&number(work)),
            signed(&share(work)),
            if bar && time > 0.0 { signed(&number(work / time)) } else { String::new() },
            format!("<span class=\"{class}\" style=\"width:{width:.2}em\"></span>"),
        ]
    };
    let gains = [
        ("gain of kinetic energy", b.kinetic_energy_gain_j),
        ("gain of elastic energy", b.elastic_energy_gain_j),
        ("gain of potential energy", b.potential_energy_gain_j),
        ("missing: works less gains", b.residual_j),
    ];
    let rows = works.into_iter().map(|(name, work)| row(name, *work, true));
    let rows = rows.chain(gains.into_iter().map(|(name, energy)| row(name, energy, false)));
    let head = [
        ("source", false),
        ("work [J]", true),
        ("share of supply [%]", true),
        ("mean power [W]", true),
        ("", false),
    ];
    format!(
        "<p>From {} s to {} s. Positive works go into the bearing. Of what passed through, {} % is missing.</p>\n{}",
        rounded(b.from_s),
        number(b.to_s),
        signed(&format!("{:.4}", 100.0 * b.relative_residual)),
        table(&head, rows)
    )
}

fn costs(s: &Summary) -> String {
    let rows = cost(s).into_iter().filter(|(name, _)| *name != "energy");
    let states = format!("{} positions, {} velocities", s.states.positions, s.states.velocities);
    let rows = [("simulated time", format!("{} s", rounded(s.simulated_time_s))), ("states", states)]
        .into_iter()
        .chain(rows)
        .map(|(name, text)| vec![name.to_owned(), escaped(&text)]);
    table(&[("", false), ("", false)], rows)
}

fn statistics(s: &Summary) -> String {
    let rows = s.statistics.iter().map(|(name, of)| {
        let x = &of.spread;
        let error = if x.stationary { number(x.standard_error) } else { "still changing".to_owned() };
        let numbers = [of_run(number(x.mean), of.few_cage_turns), number(x.deviation), error].into_iter();
        let numbers = numbers.chain([x.min, x.p05, x.p95, x.max].map(number));
        let names = [escaped(name), escaped(&of.unit)];
        names.into_iter().chain(numbers.map(|text| signed(&text))).collect()
    });
    let head = [
        ("channel", false),
        ("unit", false),
        ("mean", true),
        ("deviation", true),
        ("standard error", true),
        ("smallest", true),
        ("5 %", true),
        ("95 %", true),
        ("largest", true),
    ];
    folded(
        &format!("Statistics of {} channels over the records of the window", s.statistics.len()),
        &table(&head, rows),
    )
}

fn extremes(s: &Summary) -> String {
    if s.extremes.is_empty() {
        return String::new();
    }
    let rows = s.extremes.iter().map(|(name, x)| {
        let names = [escaped(name), escaped(&x.unit)];
        let mean = of_run(number(x.mean), x.few_cage_turns);
        names.into_iter().chain([number(x.min), number(x.max), mean].map(|text| signed(&text))).collect()
    });
    let head = [("channel", false), ("unit", false), ("smallest", true), ("largest", true), ("mean", true)];
    let title = format!("Extremes of {} channels in any step of the window", s.extremes.len());
    folded(&title, &table(&head, rows))
}

/// A mean, with the turns of the cage in its run where they are few.
fn of_run(mean: String, few: Option<f64>) -> String {
    few.map_or(mean.clone(), |turns| format!("{mean} ({})", few_turns(turns)))
}

/// Something that opens at a click, and in print.
fn folded(title: &str, html: &str) -> String {
    format!("<details class=\"channels\"><summary>{title}</summary>\n{html}</details>\n")
}

fn scene(g: &Gathered) -> String {
    let Some(text) = &g.scene else {
        return "<p>The scene is not in the folder.</p>".to_owned();
    };
    let remarks = Remarks::of(g.comment.as_ref());
    let (lines, lost) = marked(text, &remarks, &g.summary.set);
    let mut html = match &remarks.assumed {
        None => "<p>The scene does not say which of its values are assumed.</p>\n".to_owned(),
        Some(list) => {
            format!("<p><mark>Marked</mark>: {} values that the scene names as assumed.</p>\n", list.len())
        }
    };
    if !lost.is_empty() {
        html.push_str(&format!(
            "<p>Named as assumed, but not in the scene: {}.</p>\n",
            escaped(&lost.join(", "))
        ));
    }
    if let Some(comment) = &remarks.comment {
        html.push_str(&format!("<p>Comment: {}</p>\n", escaped(comment)));
    }
    let title = "As it was run, with the values that stand where the file has none; SI units, angles in rad";
    html + &format!("<details><summary>{title}</summary>\n<pre>{lines}</pre></details>")
}

fn missing(lines: &[String]) -> String {
    match lines.is_empty() {
        true => String::new(),
        false => format!(
            "<section id=\"missing\">\n<h2>What is not in this report</h2>\n{}</section>",
            list(lines)
        ),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn places_are_filled_once() {
        let part = |name: &str| if name == "a" { "{{b}}".to_owned() } else { unfilled(name) };
        assert_eq!(filled("1{{a}}2{{c}}3", part), "1{{b}}2{{c}}3");
        assert_eq!(escaped("<a b=\"c\">'&"), "&lt;a b=&quot;c&quot;&gt;&#39;&amp;");
        assert_eq!(signed("-1.5e-3 < 2"), "\u{2212}1.5e\u{2212}3 &lt; 2");
    }
}
