use super::*;
use crate::Scene;

fn balance(changes: &[(&str, &str)]) -> HeatBalance {
    let text = include_str!("../../scenes/grease_guide_heat.json");
    let scene = Scene::from_json_with(text, changes.iter().copied()).unwrap();
    HeatBalance::new(Model::new(scene).unwrap()).unwrap()
}

#[test]
fn both_ways_lead_to_the_same_temperatures() {
    let mut heat = balance(&[]);
    let steady = heat.settle().unwrap();
    let film = heat.names().position(|name| name == "film").unwrap();
    // An independent prototype found 330.95 K with the same catalogue values.
    assert!((steady.temperatures[film] - 330.95).abs() < 0.3, "{steady:?}");
    assert!((steady.of_bearing - 125.4).abs() < 1.0, "{steady:?}");
    // What goes in comes out.
    let to_ambient: f64 =
        heat.links().zip(&steady.flows).filter(|([_, to], _)| *to == "ambient").map(|(_, flow)| flow).sum();
    let all: f64 = steady.heat.iter().sum();
    assert!((to_ambient / all - 1.0).abs() < 1e-3, "{to_ambient} {all}");
    let mut warming = balance(&[]);
    let (mut hottest, mut times) = (0.0, 0);
    let warmed = warming.warm_up(|time, state| {
        (hottest, times) = (state.temperatures[film], times + 1);
        assert!(time > 0.0);
    });
    let warmed = warmed.unwrap();
    assert_eq!((times, warmed.temperatures[film]), (STEPS, hottest));
    for (a, b) in warmed.temperatures.iter().zip(&steady.temperatures) {
        assert!((a - b).abs() < 0.02, "{warmed:?} {steady:?}");
    }
}

#[test]
fn the_whirl_is_flat_where_viscosity_falls_as_speed_grows() {
    // Temperatures of the film by an independent prototype, K.
    let expected = [(500.0, 300.2), (1000.0, 307.3), (2000.0, f64::NAN), (3000.0, 330.95), (8000.0, 372.9)];
    let mut whirls = Vec::new();
    for (turns, expected) in expected {
        let speed = format!("{}", turns * std::f64::consts::TAU / 60.0);
        let mut heat = balance(&[("inner_ring.speed.constant", &speed)]);
        let steady = heat.settle().unwrap();
        let film = steady.temperatures[0];
        assert!(expected.is_nan() || (film - expected).abs() < 0.3, "{turns}: {film} {expected}");
        whirls.push(steady.whirl_speed);
    }
    // Within a tenth from 2000 to 8000 1/min, where a lubricant of constant temperature lets it grow by more than two thirds.
    let fast = &whirls[2..];
    let [least, most] =
        [f64::min, f64::max].map(|f| fast.iter().fold(fast[0].abs(), |x, whirl| f(x, whirl.abs())));
    assert!(most / least < 1.12, "{whirls:?}");
    assert!((whirls[3] / -1372.7 - 1.0).abs() < 0.005, "{whirls:?}");
}

fn rollers(changes: &[(&str, &str)]) -> HeatBalance {
    let text = include_str!("../../scenes/nu2310_heat.json");
    let scene = Scene::from_json_with(text, changes.iter().copied()).unwrap();
    HeatBalance::new(Model::new(scene).unwrap()).unwrap()
}

#[test]
fn a_roller_bearing_by_catalogue_values_is_that_of_an_independent_prototype() {
    let torque = r#"{"f0": 2.2, "f1": 3e-4, "load": 4900, "nodes": ["inner_ring", "outer_ring"], "inner_share": 0.5,
        "elements": {"node": "rollers", "share": 0.5}, "without_load": "oil"}"#;
    let steady = rollers(&[("heat.sources", "[]"), ("heat.bearing_torque", torque)]).settle().unwrap();
    assert!((steady.temperatures[0] - 328.6).abs() < 0.1, "{steady:?}");
    assert!((steady.viscosity - 0.0252).abs() < 1e-4, "{steady:?}");
    assert!((steady.clearance.unwrap() - 38.3e-6).abs() < 0.05e-6, "{steady:?}");
    // Oil that flows through takes its share of the heat away.
    let flow = r#"{"rate": 1e-5, "inlet": 308.0, "heat_capacity": 1.67e6}"#;
    let changes = [("heat.sources", "[]"), ("heat.bearing_torque", torque), ("heat.nodes.0.flow", flow)];
    let cooled = rollers(&changes).settle().unwrap();
    let to_ambient: f64 = cooled.flows[7..].iter().sum();
    let all: f64 = cooled.heat.iter().sum();
    assert!(cooled.temperatures[0] < steady.temperatures[0] - 3.0, "{cooled:?}");
    assert!((to_ambient + cooled.carried) / all - 1.0 < 1e-3, "{cooled:?}");
}

#[test]
fn rattling_rollers_settle_in_their_mean() {
    let mut heat = rollers(&[]);
    let steady = heat.settle().unwrap();
    assert!(steady.scatter > 0.0 && steady.scatter < MEAN_SETTLED, "{steady:?}");
    let all: f64 = steady.heat.iter().sum();
    assert!((steady.flows[7] + steady.flows[8]) / all - 1.0 < 0.02, "{steady:?}");
    // A uniform rise leaves the play, the warmer inner ring takes from it.
    let above = |k: usize| steady.temperatures[k] - 293.15;
    let [inner, rollers, outer] = [1, 2, 3].map(above);
    let expected = 40e-6 + 11.7e-6 * (0.095 * outer - (0.065 - 40e-6) * inner - 0.03 * rollers);
    let play = heat.model().scene().radial_clearance();
    assert!((play - expected).abs() < 0.3e-6, "{play} {expected}");
    assert_eq!(Some(play), steady.clearance);
}

#[test]
fn a_bearing_whose_lumps_are_hurried_comes_to_the_same_temperatures_within_a_run() {
    let mut heat = balance(&[]);
    let steady = heat.settle().unwrap();
    let all = r#"["film", "cage", "outer_ring", "balls", "inner_ring", "housing"]"#;
    let text = include_str!("../../scenes/grease_guide_heat.json");
    let mut changes = vec![("heat.in_motion", all), ("heat.own_time", "2e-3")];
    // From near the end, as the slowest of all takes a hundred times the own time of each.
    let starts: Vec<_> = steady.temperatures.iter().map(|t| (t - 1.0).to_string()).collect();
    let paths: Vec<_> = (0..starts.len()).map(|i| format!("heat.nodes.{i}.start")).collect();
    changes.extend(paths.iter().zip(&starts).map(|(path, start)| (path.as_str(), start.as_str())));
    let scene = Scene::from_json_with(text, changes.iter().copied()).unwrap();
    let mut sim = Sim::new(Arc::new(Model::new(scene).unwrap())).unwrap();
    sim.advance_to(0.5).unwrap();
    let n = sim.state().len();
    for (found, steady) in sim.state()[n - 6..].iter().zip(&steady.temperatures) {
        assert!((found - steady).abs() < 0.1, "{found} {steady}");
    }
}

#[test]
fn the_temperature_of_the_film_is_a_state_in_every_method() {
    let text = include_str!("../../scenes/grease_guide_heat.json");
    let end = |method: &str| {
        let solver = format!(r#"{{"method": {method}}}"#);
        let changes = [
            ("heat.in_motion", r#"["film"]"#),
            ("solver", solver.as_str()),
            ("heat.nodes.0.capacity", "0.002"),
        ];
        let scene = Scene::from_json_with(text, changes).unwrap();
        let mut sim = Sim::new(Arc::new(Model::new(scene).unwrap())).unwrap();
        sim.advance_to(12e-3).unwrap();
        let channel = sim.channels().iter().position(|channel| channel.name == "temperature.film").unwrap();
        let viscosity =
            sim.channels().iter().position(|channel| channel.name == "lubricant.viscosity").unwrap();
        [sim.output(channel).unwrap(), sim.output(viscosity).unwrap()]
    };
    let [expected, viscosity] = end(r#"{"dormand_prince": {"tolerance": 1e-8}}"#);
    assert!(expected > 295.05, "{expected}");
    for method in [
        r#"{"adams": {"tolerance": 1e-8}}"#,
        r#"{"rosenbrock": {"tolerance": 1e-8}}"#,
        r#"{"radau": {"tolerance": 1e-8}}"#,
        r#"{"leapfrog": {"step": 2e-6}}"#,
        r#"{"auto": {}}"#,
    ] {
        let [found, thinner] = end(method);
        assert!((found - expected).abs() < 2e-3 * (expected - 295.0), "{method}: {found} {expected}");
        assert!((thinner / viscosity - 1.0).abs() < 1e-3, "{method}");
    }
}

#[test]
fn the_ends_of_the_viscosity_law_and_what_warms_nothing_are_told() {
    let settled = |changes: &[(&str, &str)]| balance(changes).settle();
    // Near the cold end the film is as stiff as a solid: temperatures settle, or it says that they do not. At the hot end it says
    // where the law ends.
    match settled(&[("heat.ambient", "251.0")]) {
        Ok(cold) => assert!(cold.temperatures[0] > 251.0 && cold.temperatures[0] < 320.0, "{cold:?}"),
        Err(error) => assert!(error.message.contains("settled"), "{error}"),
    }
    let mut burning = balance(&[("heat.ambient", "449.0"), ("inner_ring.speed.constant", "800.0")]);
    let before = burning.temperatures().to_vec();
    let hot = burning.settle().unwrap_err();
    assert!(hot.message.contains("Walther") && hot.message.contains("250 to 450 K"), "{hot}");
    // Nothing has moved, and it goes on from temperatures that the oil bears.
    assert_eq!(burning.temperatures(), before);
    let cool = vec![320.0; before.len()];
    burning.set_temperatures(&cool).unwrap();
    let warmer = burning.step(1.0).unwrap();
    assert_eq!(warmer.temperatures, burning.temperatures());
    assert!(warmer.temperatures[0] > 320.0 && warmer.temperatures[0] < 450.0, "{warmer:?}");
    let refused = |result: Result<()>| result.unwrap_err().message;
    assert!(refused(burning.set_temperatures(&cool[1..])).contains("length"));
    assert!(refused(burning.set_temperatures(&vec![47.0; cool.len()])).contains("47 K of film"));
    assert!(refused(burning.step(f64::NAN).map(|_| ())).contains("duration: NaN s"));
    let refused = |changes: &[(&str, &str)]| {
        let text = include_str!("../../scenes/grease_guide_heat.json");
        Scene::from_json_with(text, changes.iter().copied()).unwrap_err().message
    };
    let isolated = [("heat.links.6.conductance.constant", "0"), ("heat.links.7.conductance.constant", "0")];
    assert!(refused(&isolated).contains("ambient"), "{}", refused(&isolated));
    let cool = [("heat.sources", "[]"), ("heat.bearing_torque", "null")];
    assert!(refused(&cool).starts_with("heat.sources"), "{}", refused(&cool));
    let ramp = [("inner_ring.speed", r#"{"ramp": {"from": 0, "to": 300, "start": 0, "end": 1}}"#)];
    assert!(refused(&ramp).starts_with("inner_ring.speed"), "{}", refused(&ramp));
}
