//! Texts that are not JSON or not of the shape of a scene.

use super::table::*;
use crate::common::example_text;

pub fn rows() -> Vec<Row> {
    let example = example_text();
    let nested = "[".repeat(100_000);
    let nested_object = r#"{"a":"#.repeat(100_000);
    vec![
        text("empty text", "", &["EOF", "line 1"]),
        text("blanks only", " \n\t ", &["EOF"]),
        text("not JSON", "bearing: NU2310", &["line 1 column 1"]),
        text("cut off", &example[..example.len() / 2], &["EOF"]),
        text("last brace missing", example.trim_end().strip_suffix('}').unwrap(), &["EOF"]),
        text("trailing garbage", &format!("{example} x"), &["trailing characters", "line"]),
        text("two scenes", &format!("{example}{example}"), &["trailing characters"]),
        text("two byte order marks", &format!("\u{feff}\u{feff}{example}"), &["line 1 column 1"]),
        text("NUL in the text", &example.replacen('{', "{\0", 1), &["line 1"]),
        text("number for a scene", "12", &["expected an object, found 12"]),
        text("null for a scene", "null", &["expected an object, found null"]),
        text("array for a scene", "[]", &["expected an object, found []"]),
        text("empty object", "{}", &["missing field", "schema"]),
        text("deep nesting of arrays", &nested, &["line 1"]),
        text("deep nesting of objects", &nested_object, &["recursion limit"]),
        replaced("deep nesting in a field", "12,", &nested, "rollers.count", &["line"]),
        replaced("comment", "\"gravity\"", "// weight\n\"gravity\"", "", &["line 4"]),
        replaced("trailing comma", "-9.80665 }", "-9.80665, }", "gravity", &["trailing comma"]),
        replaced("number beyond f64", "7.5e-3", "1e999", "rollers.radius", &["out of range"]),
        replaced("NaN", "7.5e-3", "NaN", "rollers.radius", &["line"]),
        replaced("infinity", "7.5e-3", "-Infinity", "rollers.radius", &["line"]),
        replaced("decimal comma", "0.0304", "0,0304", "rollers", &["line"]),
        replaced("hexadecimal", "\"count\": 12", "\"count\": 0x0c", "rollers", &["line"]),
        replaced("plus sign", "0.0304", "+0.0304", "rollers.mass", &["line"]),
        replaced("unit in a number", "7.5e-3", "7.5 mm", "rollers", &["line"]),
        replaced("raw line break in a text", "NU2310,", "NU2310\n", "title", &["line"]),
        replaced(
            "doubled field",
            "\"count\": 12",
            "\"count\": 12, \"count\": 13",
            "rollers",
            &["duplicate field `count`"],
        ),
        replaced(
            "doubled block",
            "\"gravity\"",
            "\"gravity\": { \"y\": 0.0, \"z\": 0.0 }, \"gravity\"",
            "",
            &["duplicate field `gravity`"],
        ),
        replaced("doubled material", "\"brass\":", "\"steel\":", "materials", &["steel"]),
    ]
}
