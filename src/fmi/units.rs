//! Units of variables in terms of the base units of the standard.

/// Exponents of kg, m, s, K and rad.
pub(super) type Exponents = [(&'static str, i8); 5];

/// Exponents of a unit of the library; `None` of the number 1, and of one that is not known.
pub(super) fn exponents(unit: &str) -> Option<Exponents> {
    let of = |kg, m, s, k, rad| Some([("kg", kg), ("m", m), ("s", s), ("K", k), ("rad", rad)]);
    match unit {
        "m" => of(0, 1, 0, 0, 0),
        "s" => of(0, 0, 1, 0, 0),
        "K" => of(0, 0, 0, 1, 0),
        "rad" => of(0, 0, 0, 0, 1),
        "m/s" => of(0, 1, -1, 0, 0),
        "m/s^2" => of(0, 1, -2, 0, 0),
        "rad/s" => of(0, 0, -1, 0, 1),
        "rad/s^2" => of(0, 0, -2, 0, 1),
        "K/s" => of(0, 0, -1, 1, 0),
        "N" => of(1, 1, -2, 0, 0),
        "N/m" => of(1, 0, -2, 0, 0),
        "N m" | "J" => of(1, 2, -2, 0, 0),
        "W" => of(1, 2, -3, 0, 0),
        "Pa" => of(1, -1, -2, 0, 0),
        "Pa s" => of(1, -1, -1, 0, 0),
        _ => None,
    }
}

/// Unit of the rate of a quantity in this unit.
pub(super) fn of_rate(unit: &str) -> &'static str {
    match unit {
        "m" => "m/s",
        "rad" => "rad/s",
        "m/s" => "m/s^2",
        "rad/s" => "rad/s^2",
        "K" => "K/s",
        _ => "",
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Model;

    #[test]
    fn every_unit_of_the_library_is_known() {
        for name in ["nu2310_heat", "grease_guide_elastic", "nu2310_space", "angular_contact_70_cage"] {
            let path = format!("{}/scenes/{name}.json", env!("CARGO_MANIFEST_DIR"));
            let model = Model::from_json(&std::fs::read_to_string(path).unwrap()).unwrap();
            let (states, inputs) = (model.state_infos(), model.input_infos());
            let of_states = states.iter().map(|info| info.unit);
            for unit in of_states.clone().chain(inputs.iter().map(|info| info.unit)) {
                assert!(exponents(unit).is_some(), "{unit}");
            }
            for unit in of_states {
                assert!(exponents(of_rate(unit)).is_some(), "rate of {unit}");
            }
            for channel in model.channels() {
                assert!(channel.unit == "1" || exponents(channel.unit).is_some(), "{}", channel.unit);
            }
        }
    }
}
