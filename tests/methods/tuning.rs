//! The constants of `auto`: their table in the documentation, and that runs follow them.

use crate::common::{example, read, replace_between, repository};
use cagedyn::integrate::Tuning;
use cagedyn::{Model, Sim, Status};
use std::sync::Arc;

/// With `CAGEDYN_BLESS=1` writes them there.
#[test]
fn the_page_has_the_constants_of_the_choice() {
    let mut table = "| constant | value | unit | what it is, and why |\n|---|---:|---|---|\n".to_owned();
    for constant in Tuning::TABLE {
        table += &format!(
            "| `{}` | {} | {} | {} |\n",
            constant.name,
            constant.value,
            constant.unit,
            constant.reason.trim()
        );
    }
    let path = repository("docs/model/integration.md");
    if std::env::var_os("CAGEDYN_BLESS").is_some() {
        replace_between(&path, "<!-- tuning -->", &table);
    }
    assert!(
        read("docs/model/integration.md").contains(&table),
        "CAGEDYN_BLESS=1 writes the table of constants"
    );
    let mut tuning = Tuning::default();
    for (i, constant) in Tuning::TABLE.iter().enumerate() {
        assert_eq!(tuning.values()[i], constant.value, "{}", constant.name);
        assert!(tuning.set(constant.name, 2.0 * constant.value));
        assert_eq!(tuning.values()[i], 2.0 * constant.value, "{}", constant.name);
    }
    assert!(!tuning.set("no such constant", 1.0));
}

#[test]
fn runs_follow_the_constants_and_snapshots_know_them() {
    let model = Arc::new(Model::from_json(&example().to_string()).unwrap());
    let run = |tuning: Tuning| {
        let mut sim = Sim::with_tuning(model.clone(), tuning).unwrap();
        sim.advance_to(5e-3).unwrap();
        sim
    };
    let (mut usual, patient) = (run(Tuning::default()), run(Tuning { start: 50, ..Tuning::default() }));
    let rosenbrock = |sim: &Sim| sim.statistics().choice.unwrap().steps[2];
    assert!(rosenbrock(&patient) > 2 * rosenbrock(&usual));
    assert_eq!(usual.restore(&patient.save()).unwrap_err().status, Status::BadSnapshot);
}
