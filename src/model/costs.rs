//! Where the time of a force evaluation goes, and what its derivatives take.

use super::batch::CONTACT_LAWS;
use super::laws::PocketLaws;
use super::{ElementKind, Fault, InputValues, Model, Workspace};
use crate::laws::guide::GuideFilm;
use std::hint::black_box;
use std::time::Instant;

/// Parts of a force evaluation.
pub const PARTS: [&str; 6] =
    ["finding_contacts", "outer_raceway", "inner_raceway", "pockets", "guide", "collecting_forces"];

/// Wall time of each of [`PARTS`], s.
pub type PartTimes = [f64; PARTS.len()];

/// Time of a part of an evaluation, and of its derivatives, ns. Only ratios matter: `cargo bench --bench jacobian` shows them
/// beside measured ones.
struct Cost {
    value: f64,
    slopes: f64,
}

/// An element whose contacts are looked for.
const ELEMENT: Cost = Cost { value: 10.0, slopes: 5.0 };
/// All contacts of a roller with raceways and pocket.
const ROLLER: Cost = Cost { value: 220.0, slopes: 300.0 };
/// A contact with a plane pocket.
const PLANE: Cost = Cost { value: 50.0, slopes: 600.0 };
const SHORT_BEARING: Cost = Cost { value: 160.0, slopes: 1550.0 };
/// A layer, which is dry for most of the time in some scenes and never in others.
const LAYER: Cost = Cost { value: 200.0, slopes: 400.0 };

impl Model {
    /// Time that the derivatives of the forces take beside their values, in force evaluations, counted from elements, contacts
    /// and films. Never clocked, so that equal runs choose equally.
    pub fn jacobian_cost(&self) -> f64 {
        let elements = self.elements.count as f64;
        let rollers = if let ElementKind::Rollers(_) = self.elements.kind { elements } else { 0.0 };
        // Of all planes, mostly one is touched.
        let planes = if let Some(PocketLaws::Plane(_)) = self.laws.pocket { 1.0 } else { 0.0 };
        let film = match &self.laws.guide {
            Some(guide) => guide.film.as_ref().map_or((0.0, LAYER), |film| match film {
                GuideFilm::ShortBearing(_) => (1.0, SHORT_BEARING),
                GuideFilm::LubricantLayer(_) => (1.0, LAYER),
            }),
            None => (0.0, LAYER),
        };
        let parts = [(elements, ELEMENT), (rollers, ROLLER), (planes, PLANE), film];
        let [value, slopes] = parts
            .iter()
            .fold([0.0; 2], |[value, slopes], (n, cost)| [value + n * cost.value, slopes + n * cost.slopes]);
        if value > 0.0 { slopes / value } else { 1.0 }
    }

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
