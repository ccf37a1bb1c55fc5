//! Channels chosen by patterns.

use super::Channel;
use crate::error::Result;
use crate::scene::{Record, bad_scene};

/// What is followed in every step where the scene does not say it: engineers size cages on peaks of these.
const USUALLY_WATCHED: &str = "*.pocket_force";

/// Places among all `channels` of those that a record has and of those that are followed in every step, as `record` asks.
pub(super) fn select(record: &Record, channels: &[Channel]) -> Result<[Vec<usize>; 2]> {
    let recorded = match &record.channels {
        Some(patterns) => matching("record.channels", patterns, channels, |_| true)?,
        None => (0..channels.len()).filter(|place| !channels[*place].detail).collect(),
    };
    let watched = match &record.extremes {
        Some(patterns) => matching("record.extremes", patterns, channels, |channel| channel.can_be_watched)?,
        None => places(USUALLY_WATCHED, channels).collect(),
    };
    Ok([recorded, watched])
}

/// Places of the channels that match one of the patterns and will do, in their own order.
fn matching(
    path: &str,
    patterns: &[String],
    channels: &[Channel],
    will_do: impl Fn(&Channel) -> bool,
) -> Result<Vec<usize>> {
    let mut chosen = vec![false; channels.len()];
    for (i, pattern) in patterns.iter().enumerate() {
        let named: Vec<usize> = places(pattern, channels).collect();
        let text = match named.iter().filter(|place| will_do(&channels[**place])).count() {
            0 if named.is_empty() => {
                format!(
                    "no channel of this scene is named '{pattern}'; * stands for any text, ? for a character"
                )
            }
            0 => format!(
                "'{pattern}' cannot be followed in every step; forces, moments, gaps of the guide and distances from its \
                 centre can"
            ),
            _ => {
                for place in named.into_iter().filter(|place| will_do(&channels[*place])) {
                    chosen[place] = true;
                }
                continue;
            }
        };
        return Err(bad_scene(&format!("{path}.{i}"), text));
    }
    Ok((0..channels.len()).filter(|place| chosen[*place]).collect())
}

fn places<'a>(pattern: &'a str, channels: &'a [Channel]) -> impl Iterator<Item = usize> + 'a {
    let named = channels.iter().enumerate().filter(|(_, c)| matches(pattern.as_bytes(), c.name.as_bytes()));
    named.map(|(place, _)| place)
}

/// Whether a name fits a pattern in which `*` stands for any text and `?` for one character.
fn matches(pattern: &[u8], name: &[u8]) -> bool {
    let (mut p, mut n) = (0, 0);
    // The last star and what it stands for so far: the only place to go back to.
    let mut star: Option<(usize, usize)> = None;
    while n < name.len() {
        match pattern.get(p) {
            Some(b'*') => {
                star = Some((p, n));
                p += 1;
            }
            Some(c) if *c == b'?' || *c == name[n] => (p, n) = (p + 1, n + 1),
            _ => {
                let Some((at, taken)) = star else { return false };
                star = Some((at, taken + 1));
                (p, n) = (at + 1, taken + 1);
            }
        }
    }
    pattern[p..].iter().all(|c| *c == b'*')
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn patterns() {
        let fits = |pattern: &str, name: &str| matches(pattern.as_bytes(), name.as_bytes());
        for (pattern, name) in [
            ("cage.*", "cage.y"),
            ("*", ""),
            ("*.pocket_force", "roller[3].pocket_force"),
            ("roller[?].slip", "roller[3].slip"),
            ("*a*b*c", "xaybabbc"),
            ("cage.y", "cage.y"),
        ] {
            assert!(fits(pattern, name), "{pattern} {name}");
        }
        for (pattern, name) in [
            ("cage.*", "cag.y"),
            ("", "x"),
            ("roller[?].slip", "roller[13].slip"),
            ("*a*b*c", "xaybabb"),
            ("cage.y", "cage.y_ratio"),
        ] {
            assert!(!fits(pattern, name), "{pattern} {name}");
        }
        // Time grows with the product of the lengths, not exponentially.
        assert!(!fits(&"*a".repeat(2000), &"a".repeat(1999)));
    }
}
