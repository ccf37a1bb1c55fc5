//! Checks of the profiles of rollers and raceways.

use crate::scene::check::range;
use crate::scene::validate::Judge;
use crate::scene::*;

/// Largest radius of a crown, m: beyond it a surface is straight.
const FLATTEST: f64 = 1e6;

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
            None => {}
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
}
