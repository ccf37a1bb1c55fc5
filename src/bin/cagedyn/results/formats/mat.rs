//! Tables as MATLAB files of level 5, without compression: a column vector for every column, and their units in a structure.
//!
//! Format: The MathWorks, "MAT-File Format", chapter "Level 5 MAT-file format".

use super::Column;
use std::io::{self, ErrorKind, Write};

/// Longest name of a variable or field, and the room for it with its end.
const LONGEST_NAME: usize = 63;
const FIELD_NAME: usize = LONGEST_NAME + 1;
/// Longest element, bytes.
const LONGEST: usize = (1 << 31) - 1;

/// Types of data.
const INT8: u32 = 1;
const UINT16: u32 = 4;
const INT32: u32 = 5;
const UINT32: u32 = 6;
const DOUBLE: u32 = 9;
const MATRIX: u32 = 14;
/// Classes of arrays.
const STRUCT: u32 = 2;
const CHAR: u32 = 4;
const NUMBERS: u32 = 6;

/// Writes so many records of these columns.
///
/// # Errors
/// Those of the file, and columns that are longer than the format allows.
pub fn write(file: &mut dyn Write, records: usize, columns: &[Column<'_>]) -> io::Result<()> {
    if records.saturating_mul(8) > LONGEST - 256 {
        return Err(io::Error::new(
            ErrorKind::InvalidInput,
            format!("{records} records are too many for the format"),
        ));
    }
    let names = names(columns);
    file.write_all(&header())?;
    for (column, name) in columns.iter().zip(&names) {
        let mut values = Vec::with_capacity(8 * records);
        (0..records).for_each(|i| values.extend((column.at)(i).to_le_bytes()));
        file.write_all(&array(NUMBERS, [records, 1], name, &element(DOUBLE, &values)))?;
    }
    let units: Vec<&str> = columns.iter().map(|column| column.unit.as_str()).collect();
    file.write_all(&structure("units", &names, &units))
}

/// 128 bytes: a text, no data of other systems, the version, the order of bytes.
fn header() -> Vec<u8> {
    let mut bytes =
        concat!("MATLAB 5.0 MAT-file, written by cagedyn ", env!("CARGO_PKG_VERSION")).as_bytes().to_vec();
    bytes.resize(116, b' ');
    bytes.extend([0; 8]);
    bytes.extend([0, 1, b'I', b'M']);
    bytes
}

/// Data behind their type and length, filled up to eight bytes.
fn element(kind: u32, data: &[u8]) -> Vec<u8> {
    let length = data.len() as u32;
    let mut bytes = Vec::with_capacity(data.len() + 16);
    if (1..=4).contains(&length) {
        bytes.extend((length << 16 | kind).to_le_bytes());
    } else {
        bytes.extend(kind.to_le_bytes());
        bytes.extend(length.to_le_bytes());
    }
    bytes.extend(data);
    bytes.resize(bytes.len().next_multiple_of(8), 0);
    bytes
}

/// An array of a class, with its elements.
fn array(class: u32, size: [usize; 2], name: &str, contents: &[u8]) -> Vec<u8> {
    let mut inside = element(UINT32, &[class.to_le_bytes(), [0; 4]].concat());
    inside.extend(element(INT32, &size.map(|n| (n as u32).to_le_bytes()).concat()));
    inside.extend(element(INT8, name.as_bytes()));
    inside.extend(contents);
    element(MATRIX, &inside)
}

/// One structure whose fields are texts.
fn structure(name: &str, fields: &[String], texts: &[&str]) -> Vec<u8> {
    let mut contents = element(INT32, &(FIELD_NAME as u32).to_le_bytes());
    let mut names = Vec::new();
    for field in fields {
        names.extend(field.as_bytes());
        names.resize(names.len().next_multiple_of(FIELD_NAME), 0);
    }
    contents.extend(element(INT8, &names));
    for text in texts {
        let units: Vec<u8> = text.encode_utf16().flat_map(u16::to_le_bytes).collect();
        contents.extend(array(CHAR, [1, units.len() / 2], "", &element(UINT16, &units)));
    }
    array(STRUCT, [1, 1], name, &contents)
}

/// Names of variables: letters, digits and single underscores in place of all else, each once.
fn names(columns: &[Column<'_>]) -> Vec<String> {
    let mut names: Vec<String> = vec!["units".to_owned()];
    for column in columns {
        let words = column.name.split(|c: char| !c.is_ascii_alphanumeric()).filter(|word| !word.is_empty());
        let mut name = words.collect::<Vec<_>>().join("_");
        if !name.starts_with(|c: char| c.is_ascii_alphabetic()) {
            name.insert(0, 'x');
        }
        name.truncate(LONGEST_NAME);
        let mut others = (2..).map(|count| {
            let end = format!("_{count}");
            format!("{}{end}", &name[..name.len().min(LONGEST_NAME - end.len())])
        });
        let free = |name: &String| !names.contains(name);
        let name = Some(name.clone()).filter(free).or_else(|| others.find(free)).unwrap_or_default();
        names.push(name);
    }
    names.split_off(1)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn column(name: &str) -> Column<'static> {
        Column { name: name.to_owned(), unit: "m".to_owned(), at: Box::new(|i| i as f64) }
    }

    #[test]
    fn names_are_those_of_variables() {
        let long = "a".repeat(80);
        let given = ["cage.y", "roller[12].slip", "cage_y", "units", "1x", &long, &long];
        let names = names(&given.map(column));
        assert_eq!(names[..5], ["cage_y", "roller_12_slip", "cage_y_2", "units_2", "x1x"]);
        assert_eq!([names[5].len(), names[6].len()], [63, 63]);
        assert!(names[6].ends_with("a_2"));
    }

    #[test]
    fn elements_are_filled_up_and_short_ones_have_short_heads() {
        assert_eq!(element(INT8, b"abc"), [1, 0, 3, 0, b'a', b'b', b'c', 0]);
        assert_eq!(element(INT8, b"abcde")[..8], [1, 0, 0, 0, 5, 0, 0, 0]);
        let mut file = Vec::new();
        write(&mut file, 3, &[column("x")]).unwrap();
        assert_eq!(file.len() % 8, 0);
        assert_eq!(file[124..136], [0, 1, b'I', b'M', 14, 0, 0, 0, 72, 0, 0, 0]);
    }
}
