//! What the pictures of a sweep show: curves and spectra over one value, maps over two.

use super::args::SweepArgs;
use super::grid::plain_text;
use crate::plots::sweep::{self, Abscissa, Cell, Curves, Map, Mark, Spectra, lines, maps};
use crate::points::Row;
use crate::points::columns::whirls;
use cagedyn::Result;
use cagedyn::scene::parse_override;

/// A quantity: its name, the column of its mean, and those of the ends of its band.
type Quantity = (&'static str, &'static str, Option<[&'static str; 2]>);

/// Column of a mean that says nothing where the cage does not whirl.
const WHIRL_SPEED: &str = "whirl speed mean [rad/s]";

/// Quantities in the order of the picture; of each group the first that is not zero everywhere.
const QUANTITIES: [&[Quantity]; 6] = [
    &[
        (
            "cage y / clearance [1]",
            "cage.y_ratio mean [1]",
            Some(["cage.y_ratio 5 % [1]", "cage.y_ratio 95 % [1]"]),
        ),
        ("cage y [m]", "cage.y mean [m]", Some(["cage.y 5 % [m]", "cage.y 95 % [m]"])),
    ],
    &[
        (
            "cage z / clearance [1]",
            "cage.z_ratio mean [1]",
            Some(["cage.z_ratio 5 % [1]", "cage.z_ratio 95 % [1]"]),
        ),
        ("cage z [m]", "cage.z mean [m]", Some(["cage.z 5 % [m]", "cage.z 95 % [m]"])),
    ],
    &[("whirl speed [rad/s]", WHIRL_SPEED, Some(["whirl speed 5 % [rad/s]", "whirl speed 95 % [rad/s]"]))],
    &[("cage slip [1]", "cage.slip mean [1]", Some(["cage.slip 5 % [1]", "cage.slip 95 % [1]"]))],
    &[("max roller slip [1]", "max roller slip [1]", None)],
    &[
        (
            "drag torque [N m]",
            "inner_ring.drag_torque mean [N m]",
            Some(["inner_ring.drag_torque 5 % [N m]", "inner_ring.drag_torque 95 % [N m]"]),
        ),
        (
            "guide moment [N m]",
            "guide.moment mean [N m]",
            Some(["guide.moment 5 % [N m]", "guide.moment 95 % [N m]"]),
        ),
    ],
];

/// The picture, if the sweep has one: over a range of numbers, over one for every value of a list, or over two.
pub fn picture(title: &str, args: &SweepArgs, rows: &[(usize, Row)]) -> Option<Result<String>> {
    let numeric: Vec<bool> = args.vary.iter().map(|one| one.values.numeric()).collect();
    let has =
        |(_, mean, _): &&Quantity| rows.iter().any(|(_, row)| row.number(mean).is_some_and(|x| x != 0.0));
    let shown: Vec<&Quantity> = QUANTITIES.iter().filter_map(|group| group.iter().find(has)).collect();
    if shown.is_empty() {
        return None;
    }
    let axis = |k: usize| axis(args, rows, k);
    match (&numeric[..], args.latin) {
        ([true], _) => Some(lines(title, &axis(0), &[], &curves(rows, &shown, 0, None))),
        ([true, true], None) => Some(maps(
            title,
            [&axis(0), &axis(1)],
            &shown.iter().map(|quantity| map(rows, quantity)).filter(Map::has_values).collect::<Vec<_>>(),
        )),
        ([true, false] | [false, true], None) => {
            let (x, list) = if numeric[0] { (0, 1) } else { (1, 0) };
            let mut labels: Vec<String> = Vec::new();
            for (_, row) in rows {
                let label = plain_text(&parse_override(&row.values[list]));
                if !labels.contains(&label) {
                    labels.push(label);
                }
            }
            Some(lines(title, &axis(x), &labels, &curves(rows, &shown, x, Some((list, &labels)))))
        }
        _ => None,
    }
}

/// The spectra over one number.
///
/// # Errors
/// [`cagedyn::Status::File`] when they cannot be drawn.
pub fn waterfall(title: &str, args: &SweepArgs, rows: &[(usize, Row)]) -> Result<String> {
    let column = |row: &Row| Some(row.spectrum.as_ref()?.column(number(row, 0)));
    let columns = rows.iter().filter_map(|(_, row)| column(row)).collect();
    let failed = rows.iter().filter(|(_, row)| row.error.is_some());
    let failed = failed.map(|(_, row)| number(row, 0)).collect();
    sweep::waterfall(title, &[Spectra { name: None, axis: axis(args, rows, 0), columns, failed }])
}

fn axis(args: &SweepArgs, rows: &[(usize, Row)], k: usize) -> Abscissa {
    Abscissa::of_path(&args.vary[k].path, args.vary[k].values.logarithmic(), &numbers(rows, k))
}

fn number(row: &Row, k: usize) -> f64 {
    row.values[k].parse().unwrap_or(f64::NAN)
}

fn numbers(rows: &[(usize, Row)], k: usize) -> Vec<f64> {
    rows.iter().map(|(_, row)| number(row, k)).collect()
}

/// One diagram for every quantity, with one curve for every label of a list, if there is one.
fn curves(
    rows: &[(usize, Row)],
    shown: &[&Quantity],
    x: usize,
    list: Option<(usize, &[String])>,
) -> Vec<Curves> {
    let mark = |row: &Row, (_, mean, band): &Quantity| Mark {
        x: number(row, x),
        mean: row.number(mean),
        band: band.and_then(|[low, high]| Some([row.number(low)?, row.number(high)?])),
        trusted: row.trusted != Some(false),
        failed: row.error.is_some(),
        short: row.few_turns().is_some(),
    };
    let series = |quantity: &Quantity, label: Option<&String>| {
        let of =
            |row: &Row| list.is_none_or(|(k, _)| Some(&plain_text(&parse_override(&row.values[k]))) == label);
        let mut marks: Vec<Mark> =
            rows.iter().filter(|(_, row)| of(row)).map(|(_, row)| mark(row, quantity)).collect();
        marks.sort_by(|a, b| a.x.total_cmp(&b.x));
        marks
    };
    shown
        .iter()
        .map(|quantity| Curves {
            name: quantity.0,
            series: match list {
                Some((_, labels)) => labels.iter().map(|label| series(quantity, Some(label))).collect(),
                None => vec![series(quantity, None)],
            },
        })
        .collect()
}

fn map(rows: &[(usize, Row)], (name, mean, _): &Quantity) -> Map {
    let cells = rows.iter().map(|(_, row)| {
        let meaningless = *mean == WHIRL_SPEED && row.error.is_none() && !whirls(row);
        Cell {
            at: [number(row, 0), number(row, 1)],
            value: row.number(mean).filter(|_| !meaningless),
            meaningless,
            trusted: row.trusted != Some(false),
            short: row.few_turns().is_some(),
        }
    });
    Map { name, cells: cells.collect() }
}
