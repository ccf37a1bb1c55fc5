//! How long a cage moves in which way: the window of a run cut into stretches of equal length, each with a class of its own.
//!
//! As many stretches as let the centre go two turns in each, in whatever sense, but 4 to 20, with at least five records. The rules are
//! those of [`CageMotion`], but half of a net turn is enough for a whirl. A motion is *intermittent* where a whirl comes and goes: it takes
//! more than a tenth and less than nine tenths of the time.

use super::whirl::{CageMotion, WhirlRecord, mean};
use crate::sim::Spread;
use std::f64::consts::TAU;

/// Number of stretches, fewest and most.
const STRETCHES: [usize; 2] = [4, 20];
/// Turns, in whatever sense, in each.
const TURNS_OF_EACH: f64 = 2.0;
/// Fewest records of each.
const RECORDS_OF_EACH: usize = 5;
/// Net turns in a stretch that make a whirl.
const WHIRL_TURNS: f64 = 0.5;
/// Shares of time between which a whirl is intermittent.
const INTERMITTENT: [f64; 2] = [0.1, 0.9];

/// Share of the time in each class, in the order of [`CageMotion::ALL`].
pub type MotionShares = [f64; CageMotion::ALL.len()];

/// Whether a whirl comes and goes.
pub(super) fn intermittent(shares: &MotionShares) -> bool {
    let whirls = CageMotion::ALL.into_iter().zip(shares).filter(|(motion, _)| motion.is_whirl());
    let share: f64 = whirls.map(|(_, share)| share).sum();
    share > INTERMITTENT[0] && share < INTERMITTENT[1]
}

impl WhirlRecord<'_> {
    /// Share of the time in each class; none of a window too short for a single stretch.
    pub(super) fn shares(&self) -> Option<MotionShares> {
        let records = self.times.len();
        // The first record of a stretch is the last of the one before.
        let most = (records.saturating_sub(1) / (RECORDS_OF_EACH - 1)).min(STRETCHES[1]);
        if most == 0 {
            return None;
        }
        let swept = self.angles().map(f64::abs).sum::<f64>() / TAU;
        let count = ((swept / TURNS_OF_EACH) as usize).clamp(STRETCHES[0].min(most), most);
        let clearance = Some(self.reference());
        let mut shares = [0.0; CageMotion::ALL.len()];
        for k in 0..count {
            let [first, last] = [k, k + 1].map(|k| k * (records - 1) / count);
            let stretch = WhirlRecord { clearance, ..self.part(first, last + 1)? };
            shares[stretch.class() as usize] += 1.0;
        }
        Some(shares.map(|stretches| stretches / count as f64))
    }

    fn class(&self) -> CageMotion {
        let speeds: Vec<f64> = self.known_speeds().map(|(_, speed)| speed).collect();
        let speed = Spread::of(&speeds);
        let turns = self.turns(speed.as_ref());
        self.motion(speed.as_ref(), mean(self.whirl_radius), turns.abs() >= WHIRL_TURNS)
    }
}

#[cfg(test)]
mod tests {
    use crate::sim::results::whirl::tests::{CLEARANCE, INTERVAL, Orbit, circle};
    use crate::sim::{CageMotion, WhirlSummary};

    #[test]
    fn a_whirl_that_comes_and_goes_is_intermittent() {
        let share = |summary: &WhirlSummary, motion: CageMotion| summary.shares.unwrap()[motion as usize];
        // The window is from 0.05 s to 0.1 s; half of it on a circle, half at rest.
        let round = circle(0.6, -2000.0);
        let halves =
            Orbit::new(140.0, INTERVAL, |t| if t < 0.075 { round(t) } else { round(0.075) }).summary();
        // A stretch at rest has the last step of the whirl before it.
        let rests = share(&halves, CageMotion::Resting) + share(&halves, CageMotion::Stable);
        assert_eq!([share(&halves, CageMotion::BackwardWhirl), rests], [0.5; 2], "{halves:?}");
        assert!(halves.intermittent);
        let steady = Orbit::new(140.0, INTERVAL, &round).summary();
        assert_eq!(share(&steady, CageMotion::BackwardWhirl), 1.0);
        assert!(!steady.intermittent);
        // Seven stretches, in the middle one of which it turns back.
        let turned = Orbit::new(140.0, INTERVAL, |t| round(t.min(0.15 - t))).summary();
        for sense in [CageMotion::ForwardWhirl, CageMotion::BackwardWhirl] {
            assert_eq!(share(&turned, sense), 3.0 / 7.0, "{turned:?}");
        }
        let all: f64 = turned.shares.unwrap().iter().sum();
        assert!((all - 1.0).abs() < 1e-12);
    }

    #[test]
    fn few_records_have_few_stretches_or_none() {
        let orbit = Orbit::new(140.0, INTERVAL, circle(0.6, -2000.0));
        assert!(WhirlSummary::of(&orbit.record(), 0.0996).unwrap().shares.is_none());
        let one = WhirlSummary::of(&orbit.record(), 0.0994).unwrap().shares.unwrap();
        assert_eq!(one.iter().filter(|share| **share > 0.0).count(), 1);
        assert_eq!(orbit.record().clearance, Some(CLEARANCE));
    }
}
