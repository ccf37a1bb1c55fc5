//! Checks of the profiles of rollers and raceways.

use crate::scene::check::{Range, range};
use crate::scene::validate::Judge;
use crate::scene::*;

/// Largest radius of a crown, m: beyond it a surface is straight.
const FLATTEST: f64 = 1e6;
/// Places of a table of drops.
const PLACES: std::ops::RangeInclusive<usize> = 3..=32;
const DROP: Range = range(-1e-3, 1e-3, "m");

impl Scene {
    /// Checks the profile of rollers and raceways.
    pub(in crate::scene) fn validate_profile(
        &self,
        judge: Judge<'_>,
        rollers: &Rollers,
        outer: &OuterRing,
        inner: &InnerRing,
        raceways: &Raceways,
    ) -> Result<()> {
        // A circle must reach over half of the length; twice that keeps it far from its end.
        let crown = range(rollers.effective_length, FLATTEST, "m");
        match &rollers.profile {
            None | Some(RollerProfile::Table(_)) => {}
            Some(RollerProfile::CircularCrown { radius }) => {
                judge.number("rollers.profile.circular_crown.radius", *radius, crown)?;
            }
            Some(RollerProfile::Logarithmic(profile)) => {
                let at = |field: &str| format!("rollers.profile.logarithmic.{field}");
                judge.number(&at("design_load"), profile.design_load, range(1e-3, 1e9, "N"))?;
                judge.number(&at("load_factor"), profile.load_factor, range(1e-3, 1e3, ""))?;
                judge.number(&at("crowned_share"), profile.crowned_share, range(0.01, 1.0, ""))?;
                judge.optional(&at("end_drop"), profile.end_drop, range(1e-9, 1e-3, "m"))?;
            }
        }
        if let Some(RollerProfile::Table(table)) = &rollers.profile {
            self.validate_drops(judge, "rollers.profile.table", table)?;
        }
        for (path, drops) in [
            ("outer_ring.raceway_drops", &outer.raceway_drops),
            ("inner_ring.raceway_drops", &inner.raceway_drops),
        ] {
            if let Some(drops) = drops {
                self.validate_drops(judge, path, drops)?;
            }
        }
        judge.optional("outer_ring.raceway_crown_radius", outer.raceway_crown_radius, crown)?;
        judge.optional("inner_ring.raceway_crown_radius", inner.raceway_crown_radius, crown)?;
        let Some(slices) = raceways.slices else { return Ok(()) };
        let path = "raceways.slices";
        if !(2..=32).contains(&slices) {
            judge.refuse(path, format!("{slices} is not within 2 to 32"))?;
        }
        let crowns = [outer.raceway_crown_radius, inner.raceway_crown_radius];
        if rollers.space.is_none() && rollers.profile.is_none() && crowns.iter().all(Option::is_none) {
            let text = "not used without 'rollers.profile', 'rollers.space' or 'raceway_crown_radius' of a ring; remove it";
            judge.refuse(path, text)?;
        }
        Ok(())
    }

    /// Checks a table of drops along the contact length.
    fn validate_drops(&self, judge: Judge<'_>, path: &str, table: &DropTable) -> Result<()> {
        let Some(rollers) = &self.rollers else { return Ok(()) };
        if rollers.space.is_none() {
            judge
                .refuse(path, "needs 'rollers.space'; write a profile of another kind, or 'rollers.space'")?;
        }
        let DropTable { places, drops } = table;
        if !PLACES.contains(&places.len()) {
            let text = format!("has {} numbers; {} to {}", places.len(), PLACES.start(), PLACES.end());
            return judge.refuse(&format!("{path}.places"), text);
        }
        if drops.len() != places.len() {
            let text = format!("has {} numbers for {} places", drops.len(), places.len());
            judge.refuse(&format!("{path}.drops"), text)?;
        }
        for (i, drop) in drops.iter().enumerate() {
            judge.number(&format!("{path}.drops.{i}"), *drop, DROP)?;
        }
        let (half, last) = (0.5 * rollers.effective_length, places.len() - 1);
        for (i, place) in places.iter().enumerate() {
            let allowed = match i {
                0 => range(-2.0 * half, -half, "m"),
                i if i == last => range(half, 2.0 * half, "m"),
                i => range(places[i - 1] + 1e-3 * half, 2.0 * half, "m"),
            };
            judge.number(&format!("{path}.places.{i}"), *place, allowed)?;
        }
        if places[last] <= places[last - 1] {
            judge.refuse(&format!("{path}.places.{last}"), "not above the place before it")?;
        }
        Ok(())
    }
}
