//! Where steps are tiny: the choice goes on with the Radau method if that helps, with the same bits after saving, and
//! without it where it does not.

use crate::common::example;
use cagedyn::integrate::Tuning;
use cagedyn::integrate::auto::{Choice, Kind};
use cagedyn::{Model, Sim};
use cagedyn_studies::judge::scenes;
use std::sync::Arc;

const END: f64 = 30e-3;

fn choice(sim: &Sim) -> Choice {
    sim.statistics().choice.expect("the method chooses")
}

fn radau(sim: &Sim) -> u64 {
    choice(sim).steps[Kind::Radau as usize]
}

/// Light cages on the edge of their lubricant layers, beside prescribed elements and beside rollers.
#[test]
fn the_radau_method_helps_on_the_edge_of_a_layer() {
    for number in [40_176, 40_235] {
        let model = Arc::new(Model::from_json(&scenes::scene(number, END).to_string()).unwrap());
        let new =
            |stiff: f64| Sim::with_tuning(model.clone(), Tuning { stiff, ..Tuning::default() }).unwrap();
        let run = |mut sim: Sim| {
            sim.advance_to(END).unwrap();
            assert_eq!(sim.trust(), Ok(()), "{number}: {}", sim.report());
            sim
        };
        let usual = Tuning::default().stiff;
        let [with, without] = [usual, f64::INFINITY].map(|stiff| run(new(stiff)));
        assert!(radau(&with) > 100 && radau(&without) == 0, "{number}: {} {}", radau(&with), radau(&without));
        let [few, many] = [&with, &without].map(|sim| sim.statistics().evaluations);
        assert!(5 * few < many, "{number}: {few} {many}");
        let mut first = new(usual);
        while choice(&first).method != Kind::Radau {
            first.advance_to(first.time() + 1e-5).unwrap();
        }
        let mut second = new(usual);
        second.restore(&first.save()).unwrap();
        let second = run(second);
        assert_eq!((second.state(), second.statistics()), (with.state(), with.statistics()), "{number}");
    }
}

#[test]
fn where_steps_are_not_tiny_it_is_not_tried() {
    let mut sim = Sim::new(Arc::new(Model::from_json(&example().to_string()).unwrap())).unwrap();
    sim.advance_to(20e-3).unwrap();
    assert_eq!(radau(&sim), 0, "{}", sim.report());
}
