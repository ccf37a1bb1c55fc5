//! Tables of the study: as text, as CSV files and in the documentation.

use crate::measure::Cost;
use crate::study::{Change, Outcome, Readings};
use cagedyn::Result;
use cagedyn::model::LAWS;
use cagedyn_studies::effects::rows::{Kind, Study};
use std::path::Path;

/// What was found for one scene.
pub struct Report {
    /// Scene and rows.
    pub study: &'static Study,
    /// What was read from the runs.
    pub readings: Readings,
    /// Runs of the unchanged scene, then of every row.
    pub outcomes: Vec<Outcome>,
    /// Cost of the unchanged scene, then of every row.
    pub costs: Vec<Cost>,
}

/// Name, headings and lines of a table.
struct Table {
    name: &'static str,
    head: Vec<String>,
    lines: Vec<Vec<String>>,
}

impl Report {
    /// Name of line `i`; the first is the unchanged scene.
    pub fn label(&self, i: usize) -> String {
        let Some(row) = i.checked_sub(1).map(|row| &self.study.rows[row]) else {
            return "unchanged".to_owned();
        };
        match row.kind {
            Kind::Removed => format!("without {}", row.effect),
            Kind::Added => format!("with {}", row.effect),
            Kind::Replaced | Kind::Reference => row.effect.to_owned(),
        }
    }

    /// Number of states of line `i`.
    fn states(&self, i: usize) -> Option<usize> {
        let layout = self.outcomes[i].model.as_ref()?.layout();
        Some(layout.positions() + layout.velocities())
    }

    /// Change of quantity `k` in line `i`.
    pub fn change(&self, i: usize, k: usize) -> Option<Change> {
        self.outcomes[i].change(&self.outcomes[0], k, self.readings.quantities[k].decimals)
    }

    /// Change of a quantity as text; in parentheses within scatter.
    pub fn change_text(&self, i: usize, k: usize) -> String {
        let decimals = self.readings.quantities[k].decimals;
        match self.change(i, k) {
            None => "-".to_owned(),
            Some(c) if c.significance >= 1.0 => format!("{:+.decimals$}", c.difference),
            Some(c) => format!("({:+.decimals$})", c.difference),
        }
    }

    /// Instructions of line `i` at the states of the unchanged scene, relative to that scene.
    pub fn instruction_share(&self, i: usize) -> Option<f64> {
        Some(self.costs[i].same_states? / self.costs[0].same_states?)
    }

    /// Prints all tables.
    pub fn print(&self) {
        for table in self.tables() {
            println!("{} {}\n\n{}", self.study.name, table.name, table.text());
        }
    }

    /// Writes all tables as CSV files.
    ///
    /// # Errors
    /// [`cagedyn::Status::File`].
    pub fn save(&self, folder: &Path) -> Result<()> {
        for table in self.tables() {
            let path = folder.join(format!("{}_{}.csv", self.study.name, table.name));
            let lines = std::iter::once(&table.head).chain(&table.lines);
            let write = || {
                let mut writer = csv::Writer::from_path(&path)?;
                lines.into_iter().try_for_each(|line| writer.write_record(line))?;
                Ok(writer.flush()?)
            };
            write().map_err(|e: csv::Error| cagedyn_studies::file_error(&path, e))?;
        }
        Ok(())
    }

    fn tables(&self) -> [Table; 3] {
        [self.cost(), self.laws(), self.results()]
    }

    fn table(&self, name: &'static str, head: &[&str], line: impl Fn(usize) -> Vec<String>) -> Table {
        let head = std::iter::once("scene").chain(head.iter().copied()).map(str::to_owned).collect();
        let line = |i| std::iter::once(self.label(i)).chain(line(i)).collect();
        Table { name, head, lines: (0..self.outcomes.len()).map(line).collect() }
    }

    fn cost(&self) -> Table {
        let head = [
            "states",
            "states saved",
            "instructions, %",
            "instructions in own run, %",
            "time in own run, %",
            "evaluations per ms",
            "instructions",
        ];
        self.table("cost", &head, |i| {
            let (cost, base) = (&self.costs[i], &self.costs[0]);
            let percent = |share: Option<f64>| optional(share.map(|share| format!("{:.1}", 100.0 * share)));
            let own = cost.instructions.zip(base.instructions).map(|(row, base)| row / base);
            let outcome = &self.outcomes[i];
            let rate = outcome.statistics.evaluations as f64 / (1e3 * outcome.simulated);
            let saved = self.states(i).zip(self.states(0)).map(|(row, base)| base as i64 - row as i64);
            vec![
                optional(self.states(i).map(|n| n.to_string())),
                optional(saved.map(|n| n.to_string())),
                percent(self.instruction_share(i)),
                percent(own),
                percent(cost.time),
                optional(rate.is_finite().then(|| format!("{rate:.0}"))),
                optional(cost.same_states.map(|n| format!("{n:.0}"))),
            ]
        })
    }

    fn laws(&self) -> Table {
        let used = |law: &usize| self.outcomes.iter().any(|outcome| outcome.statistics.laws[*law] > 0);
        let used: Vec<usize> = (0..LAWS.len()).filter(used).collect();
        let head: Vec<&str> = used.iter().map(|&law| LAWS[law]).collect();
        self.table("laws", &head, |i| {
            let statistics = &self.outcomes[i].statistics;
            let calls = used.iter().map(|&law| match statistics.laws[law] {
                0 => "0".to_owned(),
                n => format!("{:.3}", n as f64 / statistics.evaluations as f64),
            });
            calls.collect()
        })
    }

    fn results(&self) -> Table {
        let head: Vec<&str> = self.readings.quantities.iter().map(|q| q.name).chain(["error"]).collect();
        self.table("results", &head, |i| {
            let values = self.readings.quantities.iter().enumerate().map(|(k, quantity)| {
                let decimals = quantity.decimals;
                match self.outcomes[i].values[k] {
                    None => "-".to_owned(),
                    Some((mean, deviation)) if i == 0 => {
                        format!("{mean:.decimals$} ± {deviation:.decimals$}")
                    }
                    Some((mean, _)) => format!("{mean:.decimals$} {}", self.change_text(i, k)),
                }
            });
            values.chain([self.error(i)]).collect()
        })
    }

    /// Why the runs of line `i` ended early, or what they should not have evaluated.
    fn error(&self, i: usize) -> String {
        let outcome = &self.outcomes[i];
        if let (None, Some(row), Some(model)) = (&outcome.error, i.checked_sub(1), &outcome.model) {
            let counts = &outcome.statistics.laws;
            return self.study.rows[row].left_over(counts, &model.state_infos()).join(", ");
        }
        outcome.error.clone().unwrap_or_default()
    }
}

fn optional(text: Option<String>) -> String {
    text.unwrap_or_else(|| "-".to_owned())
}

impl Table {
    /// The table in Markdown with aligned columns, without columns that are empty.
    fn text(&self) -> String {
        let filled = |k: &usize| self.lines.iter().any(|line| !line[*k].is_empty());
        let columns: Vec<usize> = (0..self.head.len()).filter(filled).collect();
        let width = |&k: &usize| {
            let texts = self.lines.iter().map(|line| &line[k]).chain([&self.head[k]]);
            texts.map(|text| text.chars().count()).max().unwrap_or(0)
        };
        let widths: Vec<usize> = columns.iter().map(width).collect();
        let line = |texts: &[String]| {
            let mut line = "|".to_owned();
            for (n, (&k, &width)) in columns.iter().zip(&widths).enumerate() {
                let text = &texts[k];
                line += &if n == 0 { format!(" {text:width$} |") } else { format!(" {text:>width$} |") };
            }
            line + "\n"
        };
        let rule: String = widths
            .iter()
            .enumerate()
            .map(|(n, width)| {
                if n == 0 { format!("|{:-<1$}", "", width + 2) } else { format!("|{:-<1$}:", "", width + 1) }
            })
            .collect();
        let lines: String = self.lines.iter().map(|texts| line(texts)).collect();
        format!("{}{rule}|\n{lines}", line(&self.head))
    }
}

/// Puts the tables into a page, each between its marker and the end marker.
///
/// # Errors
/// [`cagedyn::Status::File`], also when the page has no place for a table.
pub fn write_page(path: &Path, reports: &[Report]) -> Result<()> {
    for report in reports {
        let tables = report.tables();
        let named: Vec<_> = tables
            .iter()
            .map(|table| (format!("{} {}", report.study.name, table.name), table.text()))
            .collect();
        cagedyn_studies::write_tables(path, named.iter().map(|(name, text)| (name.as_str(), text.clone())))?;
    }
    Ok(())
}
