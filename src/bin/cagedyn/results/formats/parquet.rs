//! Tables as Apache Parquet: plain values without compression, each column of a group of rows as one page.
//!
//! Format: <https://parquet.apache.org/docs/file-format>; its headers are structures of Apache Thrift in the compact protocol. Every
//! column may have gaps, which are its null values.

use std::io::{self, Write};

/// Rows of a group.
const GROUP: usize = 1 << 20;
/// Marks both ends of a file.
const MAGIC: &[u8; 4] = b"PAR1";

/// Values of a column by row; `None` where there is no value.
pub enum Values<'a> {
    /// Integers.
    Wholes(Box<dyn Fn(usize) -> Option<i64> + 'a>),
    /// Double precision.
    Numbers(Box<dyn Fn(usize) -> Option<f64> + 'a>),
    /// True or false.
    Flags(Box<dyn Fn(usize) -> Option<bool> + 'a>),
    /// Text.
    Texts(Box<dyn Fn(usize) -> Option<&'a str> + 'a>),
}

/// A column.
pub struct Column<'a> {
    /// Name.
    pub name: String,
    /// Values.
    pub values: Values<'a>,
}

/// Where a page lies, its length with header in bytes, and the number of its rows.
struct Page {
    at: u64,
    length: usize,
}

/// Writes a table of so many rows.
///
/// # Errors
/// Those of the file.
pub fn write(file: &mut dyn Write, rows: usize, columns: &[Column<'_>]) -> io::Result<()> {
    file.write_all(MAGIC)?;
    let mut at = MAGIC.len() as u64;
    let mut groups = Vec::new();
    for first in (0..rows).step_by(GROUP) {
        let last = (first + GROUP).min(rows);
        let mut pages = Vec::new();
        for column in columns {
            let values = column.values.plain(first, last);
            let mut page = page_header(values.len(), last - first);
            page.extend(values);
            file.write_all(&page)?;
            pages.push(Page { at, length: page.len() });
            at += page.len() as u64;
        }
        groups.push((last - first, pages));
    }
    let footer = footer(rows, columns, &groups);
    file.write_all(&footer)?;
    file.write_all(&(footer.len() as u32).to_le_bytes())?;
    file.write_all(MAGIC)
}

impl Values<'_> {
    /// Type as a number of the format.
    fn code(&self) -> i64 {
        match self {
            Values::Flags(_) => 0,
            Values::Wholes(_) => 2,
            Values::Numbers(_) => 5,
            Values::Texts(_) => 6,
        }
    }

    /// Which of some rows have a value, and their values.
    fn plain(&self, first: usize, last: usize) -> Vec<u8> {
        let mut present = Vec::with_capacity(last - first);
        let mut values = Vec::new();
        let mut flags = 0;
        for row in first..last {
            present.push(match self {
                Values::Numbers(at) => at(row).map(|x| values.extend(x.to_le_bytes())),
                Values::Wholes(at) => at(row).map(|x| values.extend(x.to_le_bytes())),
                Values::Texts(at) => at(row).map(|text| {
                    values.extend((text.len() as u32).to_le_bytes());
                    values.extend(text.as_bytes());
                }),
                Values::Flags(at) => at(row).map(|flag| {
                    if flags % 8 == 0 {
                        values.push(0);
                    }
                    if let Some(byte) = values.last_mut() {
                        *byte |= u8::from(flag) << (flags % 8);
                    }
                    flags += 1;
                }),
            });
        }
        let mut levels = Vec::new();
        for run in present.chunk_by(|a, b| a.is_some() == b.is_some()) {
            varint(&mut levels, (run.len() as u64) << 1);
            levels.push(u8::from(run[0].is_some()));
        }
        let mut bytes = (levels.len() as u32).to_le_bytes().to_vec();
        bytes.extend(levels);
        bytes.extend(values);
        bytes
    }
}

fn page_header(length: usize, rows: usize) -> Vec<u8> {
    let mut header = Thrift::default();
    header.number(1, 0); // a page of data
    header.number(2, length as i64);
    header.number(3, length as i64);
    header.begin(5);
    header.number(1, rows as i64);
    for (field, encoding) in [(2, 0), (3, 3), (4, 3)] {
        header.number(field, encoding); // values plain, levels in runs
    }
    header.end();
    header.end();
    header.bytes
}

fn footer(rows: usize, columns: &[Column<'_>], groups: &[(usize, Vec<Page>)]) -> Vec<u8> {
    let mut out = Thrift::default();
    out.number(1, 1); // version
    out.list(2, Thrift::STRUCT, columns.len() + 1);
    out.item();
    out.text(4, "table");
    out.number(5, columns.len() as i64);
    out.end();
    for column in columns {
        out.item();
        out.number(1, column.values.code());
        out.number(3, 1); // optional
        out.text(4, &column.name);
        if let Values::Texts(_) = column.values {
            out.number(6, 0); // UTF-8
        }
        out.end();
    }
    out.long(3, rows as i64);
    out.list(4, Thrift::STRUCT, groups.len());
    for (rows, pages) in groups {
        out.item();
        out.list(1, Thrift::STRUCT, pages.len());
        for (column, page) in columns.iter().zip(pages) {
            out.item();
            out.long(2, page.at as i64);
            out.begin(3);
            out.number(1, column.values.code());
            out.list(2, Thrift::I32, 2);
            out.plain(0); // plain
            out.plain(3); // runs
            out.list(3, Thrift::BINARY, 1);
            out.bare_text(&column.name);
            out.number(4, 0); // no compression
            out.long(5, *rows as i64);
            for field in [6, 7] {
                out.long(field, page.length as i64);
            }
            out.long(9, page.at as i64);
            out.end();
            out.end();
        }
        out.long(2, pages.iter().map(|page| page.length as i64).sum());
        out.long(3, *rows as i64);
        out.end();
    }
    out.text(6, concat!("cagedyn version ", env!("CARGO_PKG_VERSION")));
    out.end();
    out.bytes
}

/// Appends a number in groups of seven bits.
fn varint(bytes: &mut Vec<u8>, mut x: u64) {
    while x >= 0x80 {
        bytes.push(x as u8 | 0x80);
        x >>= 7;
    }
    bytes.push(x as u8);
}

/// A structure in the making.
#[derive(Default)]
struct Thrift {
    bytes: Vec<u8>,
    /// The last field of this structure.
    last: u8,
    /// Those of the structures around it.
    outer: Vec<u8>,
}

impl Thrift {
    const I32: u8 = 5;
    const I64: u8 = 6;
    const BINARY: u8 = 8;
    const LIST: u8 = 9;
    const STRUCT: u8 = 12;

    fn field(&mut self, field: u8, kind: u8) {
        self.bytes.push((field - self.last) << 4 | kind);
        self.last = field;
    }

    fn plain(&mut self, x: i64) {
        varint(&mut self.bytes, ((x << 1) ^ (x >> 63)) as u64);
    }

    fn bare_text(&mut self, text: &str) {
        varint(&mut self.bytes, text.len() as u64);
        self.bytes.extend(text.as_bytes());
    }

    fn number(&mut self, field: u8, x: i64) {
        self.field(field, Self::I32);
        self.plain(x);
    }

    fn long(&mut self, field: u8, x: i64) {
        self.field(field, Self::I64);
        self.plain(x);
    }

    fn text(&mut self, field: u8, text: &str) {
        self.field(field, Self::BINARY);
        self.bare_text(text);
    }

    fn list(&mut self, field: u8, kind: u8, length: usize) {
        self.field(field, Self::LIST);
        if length < 15 {
            self.bytes.push((length as u8) << 4 | kind);
        } else {
            self.bytes.push(0xf0 | kind);
            varint(&mut self.bytes, length as u64);
        }
    }

    /// Begins a structure that is a field.
    fn begin(&mut self, field: u8) {
        self.field(field, Self::STRUCT);
        self.item();
    }

    /// Begins a structure that is an item of a list.
    fn item(&mut self) {
        self.outer.push(std::mem::take(&mut self.last));
    }

    fn end(&mut self) {
        self.bytes.push(0);
        self.last = self.outer.pop().unwrap_or(0);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// What pyarrow has read: an integer, a number, a flag and a text, each with a gap in the second of three rows.
    #[test]
    fn bytes_are_those_that_others_have_read() {
        let column = |name: &str, values| Column { name: name.to_owned(), values };
        let columns = [
            column("n", Values::Wholes(Box::new(|i| [Some(7), None, Some(-1)][i]))),
            column("x", Values::Numbers(Box::new(|i| [Some(1.5), None, Some(-2.0)][i]))),
            column("b", Values::Flags(Box::new(|i| [Some(false), None, Some(true)][i]))),
            column("t", Values::Texts(Box::new(|i| [Some("a"), None, Some("\u{b5}m")][i]))),
        ];
        let mut bytes = Vec::new();
        write(&mut bytes, 3, &columns).unwrap();
        let text: String = bytes.iter().map(|byte| format!("{byte:02x}")).collect();
        // Up to the name of the program.
        let read = concat!(
            "504152311500153415342c15061500150615060000060000000201020002010700000000000000ffffffffffffffff15",
            "00153415342c1506150015061506000006000000020102000201000000000000f83f00000000000000c0150015161516",
            "2c1506150015061506000006000000020102000201021500152c152c2c15061500150615060000060000000201020002",
            "01010000006103000000c2b56d1502195c48057461626c651508001504250218016e00150a2502180178001500250218",
            "016200150c25021801742500001606191c194c26081c1504192500061918016e150016061656165626080000265e1c15",
            "0a19250006191801781500160616561656265e000026b4011c15001925000619180162150016061638163826b4010000",
            "26ec011c150c192500061918017415001606164e164e26ec01000016b202160600",
        );
        assert_eq!(text[..read.len()], *read);
        assert!(bytes.ends_with(MAGIC));
    }

    #[test]
    fn numbers_of_any_length_are_written_in_groups_of_seven_bits() {
        let of = |x: u64| {
            let mut bytes = Vec::new();
            varint(&mut bytes, x);
            bytes
        };
        assert_eq!([of(0), of(127)], [vec![0], vec![127]]);
        assert_eq!([of(128), of(300)], [vec![0x80, 1], vec![0xac, 2]]);
    }
}
