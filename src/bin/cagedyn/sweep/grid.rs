//! What a sweep varies, and its points: every combination of values, or a Latin hypercube.

use crate::results::files::plain;
use crate::results::table::rounded;
use cagedyn::scene::parse_override;
use cagedyn::{Error, Result, Status};
use serde_json::Value;

/// Most points of a sweep.
pub const MOST_POINTS: usize = 20_000;

/// What `--vary` must look like.
const FORM: &str =
    "must have the form PATH=FROM:TO:N, PATH=FROM:TO:N:log or PATH=A,B,...; with --latin PATH=FROM:TO";

/// A varied value of the scene.
#[derive(Clone, Debug, PartialEq)]
pub struct Vary {
    /// Where it stands in the scene.
    pub path: String,
    /// What it takes.
    pub values: Values,
    /// Both as they were given.
    pub given: String,
}

/// Values that a sweep takes.
#[derive(Clone, Debug, PartialEq)]
pub enum Values {
    /// From one number to another, in so many values unless the sweep is a hypercube.
    Range {
        /// First number.
        from: f64,
        /// Last number.
        to: f64,
        /// Number of values.
        count: Option<usize>,
        /// Whether their logarithms are at equal distances.
        log: bool,
    },
    /// These, as texts of JSON values or strings.
    List(Vec<String>),
}

/// The points of a sweep, in order: one text for each varied value.
///
/// # Errors
/// [`Status::BadValue`] for too many points, and for what does not fit together.
pub fn points(vary: &[Vary], latin: Option<u32>, seed: u64) -> Result<Vec<Vec<String>>> {
    let refuse = |text: String| Err(Error::new(Status::BadValue, format!("--vary: {text}")));
    for (i, one) in vary.iter().enumerate() {
        if vary[..i].iter().any(|other| other.path == one.path) {
            return refuse(format!("{} is varied twice", one.path));
        }
        match (&one.values, latin) {
            (Values::Range { count: None, .. }, None) => return refuse(format!("{}: {FORM}", one.path)),
            (Values::Range { count: Some(n), .. }, Some(_)) => {
                return refuse(format!("{}: with --latin no number of values, which is {n} here", one.path));
            }
            _ => {}
        }
    }
    let all = match latin {
        Some(count) => Some(count as usize),
        None => vary.iter().try_fold(1usize, |all, one| all.checked_mul(one.values.count())),
    };
    let Some(all) = all.filter(|all| *all <= MOST_POINTS) else {
        let counts: Vec<String> = vary.iter().map(|one| one.values.count().to_string()).collect();
        return refuse(format!("{} points, at most {MOST_POINTS}", counts.join(" x ")));
    };
    Ok(if latin.is_some() { hypercube(vary, all, seed) } else { grid(vary, all) })
}

/// Every combination; the last value varies fastest.
fn grid(vary: &[Vary], all: usize) -> Vec<Vec<String>> {
    let levels: Vec<Vec<String>> = vary.iter().map(|one| one.values.levels()).collect();
    let point = |mut place: usize| {
        let mut texts: Vec<String> = Vec::new();
        for levels in levels.iter().rev() {
            texts.push(levels[place % levels.len()].clone());
            place /= levels.len();
        }
        texts.reverse();
        texts
    };
    (0..all).map(point).collect()
}

/// A random point in each of `all` layers of every range, the layers in random order; lists are taken as evenly.
fn hypercube(vary: &[Vary], all: usize, seed: u64) -> Vec<Vec<String>> {
    let mut random = Random(seed);
    let columns: Vec<Vec<String>> = vary
        .iter()
        .map(|one| {
            let mut layers: Vec<usize> = (0..all).collect();
            for i in (1..all).rev() {
                layers.swap(i, random.below(i + 1));
            }
            let share = |layer: usize, within: f64| (layer as f64 + within) / all as f64;
            layers.into_iter().map(|layer| one.values.at(share(layer, random.share()))).collect()
        })
        .collect();
    (0..all).map(|i| columns.iter().map(|column| column[i].clone()).collect()).collect()
}

impl Values {
    fn count(&self) -> usize {
        match self {
            Values::Range { count, .. } => count.unwrap_or(1),
            Values::List(list) => list.len(),
        }
    }

    fn levels(&self) -> Vec<String> {
        match self {
            Values::List(list) => list.clone(),
            Values::Range { .. } => {
                let last = self.count().saturating_sub(1).max(1);
                (0..self.count()).map(|i| self.at(i as f64 / last as f64)).collect()
            }
        }
    }

    /// The value at a share of the way from first to last.
    fn at(&self, share: f64) -> String {
        match self {
            Values::List(list) => {
                let place = (share * list.len() as f64) as usize;
                list[place.min(list.len() - 1)].clone()
            }
            Values::Range { from, to, .. } if share == 0.0 || share == 1.0 => {
                text(if share == 0.0 { *from } else { *to })
            }
            Values::Range { from, to, log: false, .. } => text(rounded(from + (to - from) * share)),
            Values::Range { from, to, log: true, .. } => text(rounded(from * (to / from).powf(share))),
        }
    }

    /// Whether all values are numbers.
    pub fn numeric(&self) -> bool {
        match self {
            Values::Range { .. } => true,
            Values::List(list) => list.iter().all(|text| parse_override(text).is_number()),
        }
    }

    /// Whether a picture shows their logarithms.
    pub fn logarithmic(&self) -> bool {
        matches!(self, Values::Range { log: true, .. })
    }
}

/// A number as JSON text; whole ones without point, as counts must be.
fn text(x: f64) -> String {
    if x.fract() == 0.0 && x.abs() < 1e9 { format!("{}", x as i64) } else { plain(x) }
}

/// Numbers without pattern, the same on every machine: SplitMix64 (G. L. Steele, D. Lea, C. H. Flood, "Fast splittable pseudorandom
/// number generators", 2014).
struct Random(u64);

impl Random {
    fn next(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let x = (self.0 ^ (self.0 >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        let x = (x ^ (x >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        x ^ (x >> 31)
    }

    /// From 0 to below 1.
    fn share(&mut self) -> f64 {
        (self.next() >> 11) as f64 / (1u64 << 53) as f64
    }

    fn below(&mut self, n: usize) -> usize {
        ((u128::from(self.next()) * n as u128) >> 64) as usize
    }
}

/// Reads `PATH=FROM:TO:N`, `PATH=FROM:TO:N:log`, `PATH=FROM:TO`, `PATH=FROM:TO:log` or `PATH=A,B,...`.
///
/// # Errors
/// What is wrong with it.
pub fn parse_vary(given: &str) -> std::result::Result<Vary, String> {
    let (path, list) = given.split_once('=').ok_or(FORM)?;
    let (path, items) = (path.trim().to_owned(), split(list));
    if path.is_empty() || items.iter().any(|item| item.is_empty()) {
        return Err(FORM.to_owned());
    }
    let values = match &items[..] {
        [range] => parse_range(range)?,
        list => {
            let shown = |text: &str| plain_text(&parse_override(text));
            for (i, item) in list.iter().enumerate() {
                if list[..i].iter().any(|other| shown(other) == shown(item)) {
                    return Err(format!("{item} is listed twice"));
                }
            }
            Values::List(items)
        }
    };
    Ok(Vary { path, values, given: given.trim().to_owned() })
}

fn parse_range(text: &str) -> std::result::Result<Values, String> {
    let mut parts: Vec<&str> = text.split(':').map(str::trim).collect();
    let log = parts.len() > 2 && parts.last() == Some(&"log");
    parts.truncate(parts.len() - usize::from(log));
    let number = |text: &str| text.parse::<f64>().ok().filter(|x| x.is_finite());
    let (from, to, count) = match &parts[..] {
        [from, to] => (number(from), number(to), None),
        [from, to, count] => {
            let count = count.parse().ok().filter(|n| (2..=MOST_POINTS).contains(n));
            let count =
                count.ok_or_else(|| format!("the number of values must be from 2 to {MOST_POINTS}"))?;
            (number(from), number(to), Some(count))
        }
        _ => (None, None, None),
    };
    let (from, to) = from.zip(to).ok_or(FORM)?;
    if from == to {
        return Err("must go from one number to another".to_owned());
    }
    if log && from * to <= 0.0 {
        return Err("log: both ends must be above zero, or both below".to_owned());
    }
    Ok(Values::Range { from, to, count, log })
}

/// The items between commas that are outside of strings, lists and objects.
fn split(text: &str) -> Vec<String> {
    let (mut items, mut depth, mut quoted, mut escaped) = (vec![String::new()], 0i32, false, false);
    for c in text.chars() {
        match c {
            _ if escaped => escaped = false,
            '\\' if quoted => escaped = true,
            '"' => quoted = !quoted,
            '[' | '{' if !quoted => depth += 1,
            ']' | '}' if !quoted => depth -= 1,
            ',' if !quoted && depth <= 0 => {
                items.push(String::new());
                continue;
            }
            _ => {}
        }
        if let Some(item) = items.last_mut() {
            item.push(c);
        }
    }
    items.iter().map(|item| item.trim().to_owned()).collect()
}

/// A JSON value as a cell of a table.
pub fn plain_text(value: &Value) -> String {
    value.as_str().map_or_else(|| value.to_string(), str::to_owned)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn all(vary: &[&str], latin: Option<u32>, seed: u64) -> Vec<Vec<String>> {
        let vary: Vec<Vary> = vary.iter().map(|text| parse_vary(text).unwrap()).collect();
        points(&vary, latin, seed).unwrap()
    }

    #[test]
    fn grids_have_every_combination() {
        let found = all(&["a.b=0.1:0.4:4", "c=x,{\"d\": [1, 2]}"], None, 0);
        assert_eq!(found.len(), 8);
        assert_eq!([&found[0][..], &found[1][..]], [["0.1", "x"], ["0.1", "{\"d\": [1, 2]}"]]);
        let first: Vec<&str> = found.iter().step_by(2).map(|point| point[0].as_str()).collect();
        assert_eq!(first, ["0.1", "0.2", "0.3", "0.4"]);
        assert_eq!(all(&["n=10:14:3"], None, 0).concat(), ["10", "12", "14"]);
        assert_eq!(all(&["x=-1e-3:-10:5:log"], None, 0).concat(), ["-0.001", "-0.01", "-0.1", "-1", "-10"]);
    }

    #[test]
    fn hypercubes_have_one_point_in_every_layer() {
        let vary = ["a=0:1", "b=1:1000:log", "c=x,y"];
        let found = all(&vary, Some(10), 7);
        let numbers = |k: usize| {
            let mut numbers: Vec<f64> = found.iter().map(|point| point[k].parse().unwrap()).collect();
            numbers.sort_by(f64::total_cmp);
            numbers
        };
        for (i, x) in numbers(0).into_iter().enumerate() {
            assert!((i as f64..i as f64 + 1.0).contains(&(10.0 * x)), "{x}");
        }
        for (i, x) in numbers(1).into_iter().enumerate() {
            assert!((i as f64..i as f64 + 1.0).contains(&(10.0 / 3.0 * x.log10())), "{x}");
        }
        assert_eq!(found.iter().filter(|point| point[2] == "x").count(), 5);
        assert_eq!(found, all(&vary, Some(10), 7));
        assert!(found != all(&vary, Some(10), 8) && found.iter().any(|point| point[2] == "y"));
    }

    #[test]
    fn mistakes_are_told() {
        for (text, expected) in [
            ("a", "must have the form"),
            ("=1:2:3", "must have the form"),
            ("a=1", "must have the form"),
            ("a=1:x:3", "must have the form"),
            ("a=1:2:1", "from 2 to"),
            ("a=1:2:1e3", "from 2 to"),
            ("a=1:inf:3", "must have the form"),
            ("a=1:1:3", "from one number to another"),
            ("a=0:1:3:log", "above zero"),
            ("a=1,,2", "must have the form"),
            ("a=1,1", "listed twice"),
            ("a={\"b\":1,2", "must have the form"),
        ] {
            assert!(parse_vary(text).unwrap_err().contains(expected), "{text}");
        }
        let refused = |vary: &[&str], latin| {
            let vary: Vec<Vary> = vary.iter().map(|text| parse_vary(text).unwrap()).collect();
            points(&vary, latin, 0).unwrap_err().message
        };
        assert!(refused(&["a=1:2"], None).contains("must have the form"));
        assert!(refused(&["a=1:2:3"], Some(4)).contains("which is 3 here"));
        assert!(refused(&["a=1:2:3", "a=1,2"], None).contains("varied twice"));
        assert!(refused(&["a=1:2:1000", "b=1:2:1000"], None).contains("1000 x 1000 points"));
    }
}
