//! Text tables with aligned columns.

/// Side of a column that its text touches.
#[derive(Clone, Copy, PartialEq, Eq)]
pub enum Align {
    /// Left.
    Left,
    /// Right.
    Right,
}

/// Rows as lines of text, columns two spaces apart and aligned as given; columns beyond `align` are left-aligned.
pub fn lines(rows: &[Vec<String>], align: &[Align]) -> Vec<String> {
    let columns = rows.iter().map(Vec::len).max().unwrap_or(0);
    let width = |c: usize| rows.iter().filter_map(|r| r.get(c)).map(|t| t.chars().count()).max().unwrap_or(0);
    let widths: Vec<usize> = (0..columns).map(width).collect();
    rows.iter().map(|row| line(row, &widths, align)).collect()
}

/// One row with columns of the given widths.
pub fn line(row: &[String], widths: &[usize], align: &[Align]) -> String {
    let mut text = String::new();
    for (c, cell) in row.iter().enumerate() {
        let gap = widths.get(c).copied().unwrap_or(0).saturating_sub(cell.chars().count());
        let right = align.get(c) == Some(&Align::Right);
        text.push_str(&" ".repeat(if right { gap } else { 0 }));
        text.push_str(cell);
        text.push_str(&" ".repeat(if right { 2 } else { gap + 2 }));
    }
    text.trim_end().to_owned()
}

/// A number with about four significant digits, in plain notation where that stays short.
pub fn number(x: f64) -> String {
    let size = x.abs();
    if size == 0.0 {
        return "0".to_owned();
    }
    if !(1e-3..1e6).contains(&size) {
        return format!("{x:.3e}");
    }
    let decimals = (3 - size.log10().floor() as i32).max(0) as usize;
    format!("{x:.decimals$}")
}

/// A temperature in K on the scale of Celsius.
pub fn celsius(temperature: f64) -> f64 {
    temperature - 273.15
}

/// A number without the round-off of its last digits and without trailing zeros: 0.3, not 0.30000000000000004.
pub fn rounded(x: f64) -> f64 {
    format!("{x:.11e}").parse().unwrap_or(x)
}

/// An integer with its digits in groups of three.
pub fn grouped(n: u64) -> String {
    let digits = n.to_string();
    let mut text = String::new();
    for (i, digit) in digits.chars().enumerate() {
        if i > 0 && (digits.len() - i).is_multiple_of(3) {
            text.push(' ');
        }
        text.push(digit);
    }
    text
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_and_columns() {
        let texts = [0.0, 0.57159, -126.821, 4.73e-6, 8.5e7, 12345.6].map(number);
        assert_eq!(texts, ["0", "0.5716", "-126.8", "4.730e-6", "8.500e7", "12346"]);
        assert_eq!(rounded(0.1 + 0.2).to_string(), "0.3");
        assert_eq!([7, 1234, 1234567].map(grouped), ["7", "1 234", "1 234 567"]);
        let rows = [vec!["a".to_owned(), "1.5".to_owned()], vec!["long".to_owned(), "22.5".to_owned()]];
        assert_eq!(lines(&rows, &[Align::Left, Align::Right]), ["a      1.5", "long  22.5"]);
    }
}
