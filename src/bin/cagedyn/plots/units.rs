//! Units of the values of a scene, which its schema tells in the descriptions.

use cagedyn::Scene;
use serde_json::Value;

/// Units that stand between a comma and the end of a sentence.
const UNITS: [&str; 30] = [
    "m",
    "m^2",
    "m^2/s",
    "m/s",
    "m s^2",
    "rad",
    "rad/s",
    "1/s",
    "Hz",
    "s",
    "N",
    "N m",
    "N/m",
    "N s/m",
    "Pa",
    "1/Pa",
    "Pa s",
    "kg",
    "kg m^2",
    "kg/m^3",
    "K",
    "1/K",
    "W/K",
    "W/(m K)",
    "J/K",
    "J/(kg K)",
    "J/(m^3 K)",
    "W",
    "J",
    "m^3/s",
];
/// Values of a signal, whose unit is that of the signal.
const OF_SIGNAL: [&str; 8] = ["constant", "mean", "amplitude", "before", "after", "from", "to", "value"];

/// The unit of the value at a path, where the schema tells it.
pub fn unit(path: &str) -> Option<&'static str> {
    let schema: Value = serde_json::from_str(Scene::JSON_SCHEMA).ok()?;
    let (mut node, mut unit) = (&schema, None);
    for step in path.split('.').filter(|step| step.parse::<usize>().is_err()) {
        node = property(&schema, node, step)?;
        let own = node["description"].as_str().and_then(in_words);
        if own.is_some() || !OF_SIGNAL.contains(&step) && !node["properties"].is_object() {
            unit = own;
        }
    }
    unit
}

/// What a schema says of a property, whichever choice has it.
fn property<'a>(schema: &'a Value, node: &'a Value, name: &str) -> Option<&'a Value> {
    if let Some(found) = node["properties"].get(name) {
        return Some(found);
    }
    if let Some(path) = node["$ref"].as_str().and_then(|path| path.strip_prefix('#')) {
        return property(schema, schema.pointer(path)?, name);
    }
    let choices = ["anyOf", "oneOf", "allOf"].into_iter().filter_map(|kind| node[kind].as_array()).flatten();
    choices.chain(node.get("items")).find_map(|choice| property(schema, choice, name))
}

/// The unit in "Rotation speed over time, rad/s; negative is clockwise."
fn in_words(description: &str) -> Option<&'static str> {
    let sentence = description.split(['.', ';']).next()?;
    let last = sentence.rsplit(", ").next()?;
    UNITS.into_iter().find(|unit| *unit == last)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn units_are_those_of_the_schema() {
        for (path, expected) in [
            ("inner_ring.speed.constant", Some("rad/s")),
            ("inner_ring.speed.sine.frequency", Some("Hz")),
            ("inner_ring.speed.ramp.end", Some("s")),
            ("inner_ring.speed", Some("rad/s")),
            ("inner_ring.radial_clearance", Some("m")),
            ("inner_ring.motion.free.load.z.constant", Some("N")),
            ("cage.guide.roundness.0.amplitude", Some("m")),
            ("cage.guide.diametral_clearance", Some("m")),
            ("cage.mass", Some("kg")),
            ("raceways.contact.damping.coefficient", None),
            ("title", None),
            ("of.nothing", None),
        ] {
            assert_eq!(unit(path), expected, "{path}");
        }
    }
}
