//! What a report is made of, from a folder of `run`.

use super::animation::{self, Animation};
use super::series::Series;
use crate::plots::PICTURES;
use crate::results::facts;
use crate::results::files::file_error;
use crate::results::output::{CASES, SCENE, SUMMARY};
use crate::results::summary::Summary;
use cagedyn::{Error, Model, Result, Scene};
use serde_json::Value;
use std::fs;
use std::path::Path;

/// Pictures larger than this together are left out, bytes: a browser would not draw them in time either.
const LARGEST_PICTURES: usize = 8_000_000;
/// Elements of the pictures of `run`; what has others is somebody else's and might run a program.
const ELEMENTS: [&str; 8] = ["svg", "rect", "text", "polyline", "polygon", "circle", "line", "path"];

/// Content of a report.
pub struct Gathered {
    /// Results in numbers.
    pub summary: Summary,
    /// Text of the scene as it was run.
    pub scene: Option<String>,
    /// Its comment.
    pub comment: Option<Value>,
    /// Speed, load and clearances.
    pub facts: String,
    /// Pictures as SVG.
    pub pictures: Vec<String>,
    /// What moves.
    pub animation: Option<Animation>,
    /// What is not there and why.
    pub missing: Vec<String>,
}

impl Gathered {
    /// Reads a folder. What is not in it but for the summary is told in `missing`.
    ///
    /// # Errors
    /// [`cagedyn::Status::File`] without the summary of a run that has ended.
    pub fn from(folder: &Path) -> Result<Self> {
        let summary = summary(folder)?;
        let mut missing = Vec::new();
        let mut told = |what: &str, result: std::result::Result<_, String>| match result {
            Ok(found) => Some(found),
            Err(why) => {
                missing.push(format!("{what}: {why}"));
                None
            }
        };
        let scene = told("scene", scene(folder));
        let (text, model) = scene.map_or((None, None), |(text, model)| (Some(text), Some(model)));
        let comment = text.as_deref().and_then(crate::run::comment);
        let facts = model.as_ref().map_or(String::new(), facts::facts);
        let mut pictures = Vec::new();
        for name in PICTURES.into_iter().filter(|name| summary.files.iter().any(|file| file == name)) {
            match picture(&folder.join(name)) {
                Ok(svg) => pictures.push(svg),
                Err(why) => missing.push(format!("picture {name}: {why}")),
            }
        }
        let size: usize = pictures.iter().map(String::len).sum();
        if size > LARGEST_PICTURES {
            missing.push(format!("pictures: {} MB are too many for a page", size / 1_000_000));
            pictures.clear();
        }
        let animation = match &model {
            None => Err("needs the scene".to_owned()),
            Some(model) => Series::read(folder, &animation::columns(model))
                .and_then(|series| Animation::new(model, &series)),
        };
        let animation = animation.map_err(|why| missing.push(format!("animation: {why}"))).ok();
        missing.extend(animation.iter().flat_map(|animation| animation.missing.iter().cloned()));
        Ok(Self { summary, scene: text, comment, facts, pictures, animation, missing })
    }
}

fn summary(folder: &Path) -> Result<Summary> {
    let path = folder.join(SUMMARY);
    if !path.is_file() {
        let why = match folder.join(CASES).is_file() {
            true => "is the folder of a case set; there is a report for each of the folders in it",
            false => "is no folder of a run: it has no summary.json",
        };
        return Err(file_error(folder, why));
    }
    let text = fs::read_to_string(&path).map_err(|e| file_error(&path, e))?;
    serde_json::from_str(&text).map_err(|e| {
        let begun = serde_json::from_str::<Value>(&text)
            .is_ok_and(|value| value["complete"] == false && value.get("integration").is_none());
        match begun {
            true => file_error(&path, "the run has not ended, so there are no results yet"),
            false => file_error(&path, format!("is not as this version of `cagedyn run` writes it: {e}")),
        }
    })
}

/// Text of the scene and what it is compiled to.
fn scene(folder: &Path) -> std::result::Result<(String, Model), String> {
    let text = fs::read_to_string(folder.join(SCENE)).map_err(|e| format!("{SCENE}: {e}"))?;
    let model = Scene::from_json(&text).and_then(Model::new);
    Ok((text, model.map_err(|e: Error| format!("{SCENE}: {e}"))?))
}

/// A picture, if it is one of `run`: with elements that draw, and nothing that acts or loads.
fn picture(path: &Path) -> std::result::Result<String, String> {
    let svg = fs::read_to_string(path).map_err(|e| e.to_string())?;
    let words = |text: &str| -> Vec<String> {
        text.split(|c: char| !c.is_ascii_alphanumeric()).map(str::to_lowercase).collect()
    };
    let known = |tag: &str| {
        words(tag.trim_start_matches('/')).first().is_some_and(|name| ELEMENTS.contains(&name.as_str()))
    };
    let plain = |tag: &str| {
        let inside = tag.split('>').next().unwrap_or_default();
        let acts = |word: &String| word.starts_with("on") || word.ends_with("href") || word == "style";
        // Names, which stand outside of the quotes; the end of the tag is not within a value.
        !inside.split('"').step_by(2).flat_map(words).any(|word| acts(&word))
            && !inside.contains('\'')
            && !inside.contains("url(")
            && inside.matches('"').count().is_multiple_of(2)
    };
    let drawn = svg.starts_with("<svg") && svg.split('<').skip(1).all(|tag| known(tag) && plain(tag));
    if drawn { Ok(svg) } else { Err("is no picture of this program".to_owned()) }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_pictures_that_draw_are_taken() {
        let dir = tempfile::tempdir().unwrap();
        let path = dir.path().join("x.svg");
        let taken = |svg: &str| {
            fs::write(&path, svg).unwrap();
            picture(&path).is_ok()
        };
        assert!(taken("<svg><rect data-x=\"0 1 lin one of them, style [1]\"/></svg>"));
        assert!(taken("<svg width=\"1\">\n<text x=\"1\">\n1 &lt; 2 on top, style\n</text>\n</svg>\n"));
        for bad in [
            "<svg><script>alert(1)</script></svg>",
            "<svg onload=\"alert(1)\"></svg>",
            "<svg><text\tOnClick=\"x\">a</text></svg>",
            "<svg/onload=\"x\"></svg>",
            "<svg><text x=\"a>b\"onclick=\"x\">a</text></svg>",
            "<svg><text x='a>b' y='1'>a</text></svg>",
            "<svg><rect fill=\"url(x)\"/></svg>",
            "<svg><rect style=\"fill:url(x)\"/></svg>",
            "<svg><image href=\"x\"/></svg>",
            "<svg><!-- --></svg>",
            "text",
        ] {
            assert!(!taken(bad), "{bad}");
        }
    }
}
