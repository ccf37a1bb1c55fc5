//! Where the time of a force evaluation goes, and what its derivatives take.

use crate::bodies::{INNER_RING, OUTER_RING};
use crate::model::plane::{Fault, InputValues, Plane, Workspace};
use crate::pairs::Cost;
use std::hint::black_box;
use std::time::Instant;

/// Parts of a force evaluation.
pub const PARTS: [&str; 6] =
    ["finding_contacts", "outer_raceway", "inner_raceway", "pockets", "guide", "collecting_forces"];

/// Wall time of each of [`PARTS`], s.
pub type PartTimes = [f64; PARTS.len()];

/// A part is timed so often.
const ROUNDS: u32 = 5;

/// An element whose contacts are looked for.
const ELEMENT: Cost = Cost { value: 10.0, slopes: 5.0, per_element: true };

/// The shortest mean time of several times `repeats` works, s.
pub(in crate::model) fn shortest(
    repeats: u32,
    work: &mut dyn FnMut() -> Result<(), Fault>,
) -> Result<f64, Fault> {
    let mut shortest = f64::INFINITY;
    for _ in 0..ROUNDS {
        let started = Instant::now();
        for _ in 0..repeats {
            work()?;
        }
        shortest = shortest.min(started.elapsed().as_secs_f64());
    }
    Ok(shortest / f64::from(repeats.max(1)))
}

impl Plane {
    /// Time that the derivatives of the forces take beside their values, in force evaluations, counted from elements, contacts
    /// and films. Never clocked, so that equal runs choose equally.
    #[doc(hidden)]
    pub fn jacobian_cost(&self) -> f64 {
        let between = self.between.iter().filter_map(|pair| pair.cost());
        let of_pairs = self.pairs.iter().map(|pair| pair.cost());
        let (mut value, mut slopes) = (0.0, 0.0);
        for cost in std::iter::once(ELEMENT).chain(of_pairs).chain(between) {
            let n = if cost.per_element { self.element_count() as f64 } else { 1.0 };
            value += n * cost.value;
            slopes += n * cost.slopes;
        }
        if value > 0.0 { slopes / value } else { 1.0 }
    }

    /// Wall time of each part of one evaluation at positions `q` and velocities `v`: the shortest mean of several times `repeats`, so
    /// that what else the machine did does not count. Parts that the scene does not have take none. Contacts that are evaluated
    /// together share their time by their numbers.
    ///
    /// # Errors
    /// As [`Plane::accelerations`].
    ///
    /// # Panics
    /// As [`Plane::accelerations`].
    #[doc(hidden)]
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
            times[part] = shortest(repeats, work)?;
            Ok(())
        };
        time(0, &mut || self.locate(black_box(q), v, ws))?;
        // The first batch has the raceways, if there are any, and the pockets whose laws have the same parts.
        let raceways = self.has_raceways();
        if raceways {
            time(1, &mut || {
                self.apply_to_contacts(ws, |batch| batch == 0);
                Ok(())
            })?;
        }
        if self.has_pockets() {
            time(3, &mut || {
                self.apply_to_contacts(ws, |batch| batch > 0 || !raceways);
                Ok(())
            })?;
        }
        if !self.between.is_empty() {
            time(4, &mut || self.apply_between(black_box(&mut *ws)))?;
        }
        time(5, &mut || {
            self.assemble(black_box(&mut *ws), &mut a);
            Ok(())
        })?;
        self.share_by_contacts(ws, &mut times[1..4]);
        Ok(times)
    }

    /// Shares the time of a batch, which is that of the first part, among outer raceway, inner raceway and pockets.
    fn share_by_contacts(&self, ws: &Workspace, times: &mut [f64]) {
        let [together, ..] = times else { return };
        let together = std::mem::take(together);
        let mut n = [0.0; 3];
        for (pair, info) in self.infos.iter().enumerate() {
            let (batch, contacts) = ws.contacts.range(pair);
            let part = match info.mate {
                OUTER_RING => 0,
                INNER_RING => 1,
                _ => 2,
            };
            if std::ptr::eq(batch, &ws.contacts.batches[0]) {
                n[part] += contacts.len() as f64;
            }
        }
        let all: f64 = n.iter().sum();
        if all > 0.0 {
            for (time, n) in times.iter_mut().zip(n) {
                *time += together * n / all;
            }
        }
    }
}
