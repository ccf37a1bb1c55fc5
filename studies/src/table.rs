//! Tables of texts.

/// A table of texts.
pub struct Table {
    /// Its name, which marks its place.
    pub name: &'static str,
    rows: Vec<Vec<String>>,
}

impl Table {
    /// One with these heads.
    pub fn new(name: &'static str, head: &[&str]) -> Self {
        Self { name, rows: vec![head.iter().map(|text| (*text).to_owned()).collect()] }
    }

    /// Adds a row.
    pub fn add<const N: usize>(&mut self, row: [String; N]) {
        self.rows.push(row.to_vec());
    }

    /// As Markdown.
    pub fn text(&self) -> String {
        let mut text = String::new();
        for (i, row) in self.rows.iter().enumerate() {
            text += &format!("| {} |\n", row.join(" | "));
            if i == 0 {
                text += &format!("|---|{}\n", "---:|".repeat(row.len() - 1));
            }
        }
        text
    }
}
