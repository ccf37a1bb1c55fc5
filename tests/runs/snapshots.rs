//! Snapshots: what they keep, what they refuse.

use crate::started::{ACCURATE, CHOSEN, STIFF, bits, sim};
use cagedyn::Status;

#[test]
fn saving_and_restoring_continues_with_the_same_bits() {
    for method in [&[][..], &[CHOSEN][..], &[ACCURATE][..], &[STIFF][..]] {
        let mut first = sim(method);
        first.set_input(2, -3000.0).unwrap();
        first.advance_to(0.7e-3).unwrap();
        let saved = first.save();
        assert_eq!(saved.len(), first.save_len());
        let mut second = sim(method);
        second.advance_to(0.1e-3).unwrap();
        second.restore(&saved).unwrap();
        assert_eq!((second.time(), second.input(2)), (first.time(), Ok(-3000.0)));
        first.advance_to(1.5e-3).unwrap();
        second.advance_to(1.5e-3).unwrap();
        assert_eq!(bits(first.state()), bits(second.state()));
        assert_eq!(first.statistics(), second.statistics());
    }
}

#[test]
fn damaged_and_foreign_snapshots_are_refused_and_change_nothing() {
    let mut s = sim(&[]);
    s.advance_to(0.3e-3).unwrap();
    let good = s.save();
    let before = bits(s.state());
    let other = sim(&[("inner_ring.radial_clearance", "5e-6")]).save();
    let mut cases = vec![vec![], good[1..].to_vec(), other];
    for (i, value) in [(0, 1.0), (3, -1.0), (3, f64::NAN), (4, 0.5), (20, f64::INFINITY)] {
        let mut damaged = good.clone();
        damaged[i] = value;
        cases.push(damaged);
    }
    for (i, snapshot) in cases.iter().enumerate() {
        assert_eq!(s.restore(snapshot).map_err(|e| e.status), Err(Status::BadSnapshot), "case {i}");
        assert_eq!(bits(s.state()), before, "case {i}");
    }
    s.restore(&good).unwrap();
    s.advance_to(0.4e-3).unwrap();
}

/// What the future does not depend on may differ.
#[test]
fn snapshots_are_good_for_other_titles_and_records() {
    let mut s = sim(&[]);
    s.advance_to(1e-3).unwrap();
    let saved = s.save();
    s.advance_to(2e-3).unwrap();
    for same in [
        &[("title", "another"), ("record.interval", "1e-3")][..],
        &[("record.extremes", r#"["guide.*"]"#), ("record.channels", r#"["cage.y"]"#)],
        &[("comment", "text")],
    ] {
        let mut other = sim(same);
        other.restore(&saved).unwrap_or_else(|e| panic!("{same:?}: {e}"));
        other.advance_to(2e-3).unwrap();
        assert_eq!(bits(other.state()), bits(s.state()), "{same:?}");
    }
    for (path, value) in [
        ("solver", r#"{"preset": "draft"}"#),
        ("rollers.mass", "0.0305"),
        ("solver", r#"{"max_steps": 1000}"#),
    ] {
        assert_eq!(sim(&[(path, value)]).restore(&saved).unwrap_err().status, Status::BadSnapshot, "{path}");
    }
}

#[test]
fn states_that_could_not_be_saved_are_refused() {
    let mut s = sim(&[]);
    for value in [1e160, -1e13, f64::INFINITY] {
        let mut state = s.state().to_vec();
        *state.last_mut().unwrap() = value;
        assert_eq!(s.set_state(0.0, &state).unwrap_err().status, Status::BadValue, "{value}");
    }
    let mut state = s.state().to_vec();
    *state.last_mut().unwrap() = 1e12;
    if s.set_state(0.0, &state).is_ok() {
        let saved = s.save();
        s.restore(&saved).unwrap();
    }
}

#[test]
fn every_changed_number_of_a_snapshot_is_noticed() {
    let methods = [
        r#""leapfrog": {}"#,
        r#""dormand_prince": {"tolerance": 1e-5}"#,
        r#""adams": {"tolerance": 1e-5}"#,
        r#""auto": {}"#,
        r#""auto": {"tolerance": 1e-5}"#,
    ];
    for method in methods {
        let solver = format!(r#"{{"method": {{{method}}}, "max_steps": 3000}}"#);
        // Few rollers: a restore makes a stretch again, and there are as many as there are numbers.
        let mut s = sim(&[("solver", &solver), ("rollers.count", "5")]);
        s.advance_to(0.2e-3).unwrap();
        let good = s.save();
        for i in 0..good.len() {
            for value in [0.0, -1.0, 0.3, 7.0, 1e300, -1e300, 5e-324, good[i] * (1.0 + 1e-15), -good[i]] {
                let mut damaged = good.clone();
                damaged[i] = value;
                if value.to_bits() == good[i].to_bits() {
                    continue;
                }
                let e = s.restore(&damaged).expect_err("a damaged snapshot");
                assert_eq!(e.status, Status::BadSnapshot, "{method}, {i} = {value}: {e}");
            }
        }
        s.restore(&good).unwrap();
        s.step(1e-4).unwrap();
    }
}
