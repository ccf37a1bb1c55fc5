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
