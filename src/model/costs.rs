//! Where the time of a force evaluation goes.

use super::batch::CONTACT_LAWS;
use super::{Fault, InputValues, Model, Workspace};
use std::hint::black_box;
use std::time::Instant;

/// Parts of a force evaluation.
pub const PARTS: [&str; 6] =
    ["finding_contacts", "outer_raceway", "inner_raceway", "pockets", "guide", "collecting_forces"];

/// Wall time of each of [`PARTS`], s.
pub type PartTimes = [f64; PARTS.len()];

impl Model {
    /// Wall time of each part of one evaluation at positions `q` and velocities `v`, the mean of `repeats`. Parts that the
    /// scene does not have take none. Contacts that are evaluated together share their time by their numbers.
    ///
    /// # Errors
    /// As [`Model::accelerations`].
    ///
    /// # Panics
    /// As [`Model::accelerations`].
    pub fn time_parts(
        &self,
        inputs: &InputValues,
        (q, v): (&[f64], &[f64]),
        ws: &mut Workspace,
        repeats: u32,
    ) -> Result<PartTimes, Fault> {
        let mut a = vec![0.0; v.len()];
        self.accelerations(inputs, q, v, ws, &mut a)?;
        let mut times = [0.0; PARTS.len()];
        let mut time = |part: usize, work: &mut dyn FnMut() -> Result<(), Fault>| {
            let started = Instant::now();
            for _ in 0..repeats {
                work()?;
            }
            times[part] = started.elapsed().as_secs_f64() / f64::from(repeats.max(1));
            Ok(())
        };
        time(0, &mut || self.locate(black_box(q), v, ws))?;
        if self.laws.raceways.is_some() {
            time(1, &mut || {
                ws.raceways.apply(ws.thickening, ws.instructions);
                Ok(())
            })?;
        }
        if self.laws.pocket.is_some() {
            time(3, &mut || {
                self.apply_to_pockets(ws);
                Ok(())
            })?;
        }
        if self.laws.guide.is_some() {
            time(4, &mut || self.apply_guide(black_box(q), v, ws))?;
        }
        time(5, &mut || {
            self.assemble(black_box(q), v, ws, &mut a);
            Ok(())
        })?;
        share_by_contacts(&ws.raceways.counts, &mut times[1..4]);
        Ok(times)
    }
}

/// Shares the time of a batch, which is that of the first part, among outer raceway, inner raceway and pockets.
fn share_by_contacts(counts: &[u64; CONTACT_LAWS], times: &mut [f64]) {
    let [together, ..] = times else { return };
    let together = std::mem::take(together);
    let [outer, inner, pockets @ ..] = counts;
    let n = [*outer, *inner, pockets.iter().sum()].map(|n| n as f64);
    let all: f64 = n.iter().sum();
    if all > 0.0 {
        for (time, n) in times.iter_mut().zip(n) {
            *time += together * n / all;
        }
    }
}
