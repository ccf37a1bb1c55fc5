//! Columns of a table of records, read from its file.

use crate::results::files::{SERIES, UNFINISHED};
use std::collections::BTreeMap;
use std::path::Path;

/// Records of a run: times and the columns that were asked for and are there.
pub struct Series {
    /// Times, s.
    pub times: Vec<f64>,
    columns: BTreeMap<String, Vec<f64>>,
}

impl Series {
    /// Reads columns by their names without units; that of the time is always read.
    ///
    /// # Errors
    /// What is wrong with the table, in words.
    pub fn read(folder: &Path, names: &[String]) -> Result<Self, String> {
        let name = [SERIES, UNFINISHED].into_iter().find(|name| folder.join(name).is_file());
        let name = name.ok_or_else(|| format!("{SERIES} is not in the folder"))?;
        let mut reader = csv::Reader::from_path(folder.join(name)).map_err(|e| format!("{name}: {e}"))?;
        let heads = reader.headers().map_err(|e| format!("{name}: {e}"))?.clone();
        let of_column =
            |head: &str| head.rsplit_once(" [").map_or(head.to_owned(), |(name, _)| name.to_owned());
        let wanted: Vec<(usize, String)> = heads
            .iter()
            .map(of_column)
            .enumerate()
            .filter(|(i, name)| *i == 0 || names.contains(name))
            .collect();
        let mut columns = vec![Vec::new(); wanted.len()];
        for (row, record) in reader.into_records().enumerate() {
            let record = record.map_err(|e| format!("{name}: {e}"))?;
            for ((place, head), column) in wanted.iter().zip(&mut columns) {
                let cell = record.get(*place).unwrap_or_default();
                let value =
                    cell.parse().map_err(|_| format!("{name}: {head} of record {row} is '{cell}'"))?;
                column.push(value);
            }
        }
        let mut columns: BTreeMap<String, Vec<f64>> =
            wanted.into_iter().map(|(_, name)| name).zip(columns).collect();
        let times = columns.remove("time").ok_or_else(|| format!("{name}: does not begin with the time"))?;
        Ok(Self { times, columns })
    }

    /// Values of a column, if they are there and all of them are numbers.
    pub fn column(&self, name: &str) -> Option<&[f64]> {
        self.columns.get(name).filter(|column| column.iter().all(|x| x.is_finite())).map(Vec::as_slice)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn columns_are_found_without_their_units_and_mistakes_are_told() {
        let dir = tempfile::tempdir().unwrap();
        let names = ["a.b min".to_owned(), "none".to_owned(), "c".to_owned()];
        let read = |text: &str| {
            std::fs::write(dir.path().join(SERIES), text).unwrap();
            Series::read(dir.path(), &names)
        };
        let series = read("time [s],a.b [N],a.b min [N],c [1]\n0.0,1,2,NaN\n0.5,3,-4e-3,1\n").unwrap();
        assert_eq!(series.times, [0.0, 0.5]);
        assert_eq!(series.column("a.b min"), Some(&[2.0, -4e-3][..]));
        assert!(
            series.column("a.b").is_none() && series.column("none").is_none() && series.column("c").is_none()
        );
        for (text, wrong) in [
            ("time [s],c [1]\n0.0,x\n", "c of record 0 is 'x'"),
            ("time [s],c [1]\n0.0\n", "found record with 1 fields"),
            ("c [1]\n0.0\n", "does not begin with the time"),
        ] {
            let e = read(text).err().unwrap();
            assert!(e.contains(wrong) && e.starts_with(SERIES), "{e}");
        }
        std::fs::remove_file(dir.path().join(SERIES)).unwrap();
        assert!(Series::read(dir.path(), &names).err().unwrap().contains("is not in the folder"));
    }
}
