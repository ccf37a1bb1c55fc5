//! Lines of the places of a JSON text.

/// Line, from 1 on, of the place that a path leads to in a text that is JSON: that of its key, or that of the nearest place
/// above it that is there.
pub(crate) fn line_of(text: &str, path: &[String]) -> usize {
    let mut scan = Scan { bytes: text.as_bytes(), at: 0 };
    scan.skip_blanks();
    let mut place = scan.at;
    for key in path {
        match scan.enter(key) {
            Some(found) => place = found,
            None => break,
        }
    }
    line_at(text, place)
}

/// Line of a byte.
fn line_at(text: &str, place: usize) -> usize {
    1 + text.as_bytes()[..place.min(text.len())].iter().filter(|byte| **byte == b'\n').count()
}

/// A place in a text. What is no JSON ends a search, wherever.
struct Scan<'a> {
    bytes: &'a [u8],
    at: usize,
}

impl Scan<'_> {
    fn peek(&self) -> Option<u8> {
        self.bytes.get(self.at).copied()
    }

    fn skip_blanks(&mut self) {
        // The byte order mark with which some editors begin is one, too.
        while self.peek().is_some_and(|byte| b" \t\r\n,:\xef\xbb\xbf".contains(&byte)) {
            self.at += 1;
        }
    }

    /// Goes to the value of a key or index of the value that stands here, and tells where it begins: at the key, where
    /// there is one.
    fn enter(&mut self, key: &str) -> Option<usize> {
        self.skip_blanks();
        let open = self.peek()?;
        if open != b'{' && open != b'[' {
            return None;
        }
        self.at += 1;
        for i in 0.. {
            self.skip_blanks();
            if matches!(self.peek()?, b'}' | b']') {
                return None;
            }
            let start = self.at;
            let found = if open == b'{' {
                self.skip_value();
                let name = self.bytes.get(start..self.at).map(serde_json::from_slice::<String>);
                name.is_some_and(|name| name.is_ok_and(|name| name == key))
            } else {
                key.parse() == Ok(i)
            };
            self.skip_blanks();
            if found {
                return Some(start);
            }
            self.skip_value();
        }
        None
    }

    /// Goes behind the value that stands here.
    fn skip_value(&mut self) {
        let mut depth = 0_usize;
        while let Some(byte) = self.peek() {
            match byte {
                b'{' | b'[' => depth += 1,
                b'}' | b']' => depth = depth.saturating_sub(1),
                b'"' => self.skip_text(),
                _ => {
                    while self.peek().is_some_and(|byte| !b"{}[]\", \t\r\n:".contains(&byte)) {
                        self.at += 1;
                    }
                    if self.peek().is_some() {
                        self.at -= 1;
                    }
                }
            }
            self.at += 1;
            if depth == 0 {
                return;
            }
            self.skip_blanks();
        }
    }

    /// Goes to the quote that ends the text which begins here.
    fn skip_text(&mut self) {
        self.at += 1;
        while let Some(byte) = self.peek() {
            match byte {
                b'"' => return,
                b'\\' => self.at += 2,
                _ => self.at += 1,
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn places_are_found_in_their_lines() {
        let text = "\u{feff}{\n \"a\": {\"x}\\\"\": [1,\n  -2.5e3, {\"b\":\n true}]},\n\n \"\\u0063\": null,\n\"d\": \"[\", \"e\":\n\n3\n}";
        for (path, line) in [
            ("", 1),
            ("a", 2),
            ("a/x}\"", 2),
            ("a/x}\"/0", 2),
            ("a/x}\"/1", 3),
            ("a/x}\"/2/b", 3),
            ("a/x}\"/3", 2),
            ("a/y", 2),
            ("c", 6),
            ("c/z", 6),
            ("d", 7),
            ("e", 7),
            ("f", 1),
        ] {
            let keys: Vec<String> =
                path.split('/').filter(|key| !key.is_empty()).map(str::to_owned).collect();
            assert_eq!(line_of(text, &keys), line, "{path}");
        }
        // Anything else ends somewhere.
        for text in ["", "{", "{\"a\"", "{\"a\": [", "nonsense", "\"\\", "[}{]"] {
            line_of(text, &["a".to_owned(), "0".to_owned()]);
        }
    }
}
