//! Checks of rollers that skew and tilt, and of ribs.

use super::*;

/// Most slices of a contact.
const SLICES: std::ops::RangeInclusive<u32> = 2..=32;
const END_PLAY: Range = range(1e-7, 1e-2, "m");
const RIB_ANGLE: Range = range(0.0, 0.2, "rad");
const HALF_ANGLE: Range = range(1e-4, 0.2, "rad");
/// Largest angle of a raceway, rad.
const RACEWAY_ANGLE: f64 = 0.9;
const CAP: Range = range(1e-3, 50.0, "m");

impl Scene {
    pub(super) fn validate_roller_space(&self, judge: Judge<'_>, rollers: &Rollers) -> Result<()> {
        let Some(space) = &rollers.space else {
            if self.ribs.is_some() && !judge.excuses("rollers.space") {
                judge.refuse("ribs", "needs 'rollers.space'; remove it")?;
            }
            return Ok(());
        };
        let at = |field: &str| format!("rollers.space.{field}");
        let longest = range(rollers.effective_length, 2.0 * rollers.effective_length, "m");
        judge.number(&at("length"), space.length, longest)?;
        let thin = rollers.mass * space.length * space.length;
        let inertia = range(0.5 * rollers.inertia, rollers.inertia + thin, "kg m^2");
        judge.optional(&at("transverse_inertia"), space.transverse_inertia, inertia)?;
        let lists = [
            ("length_deviations", &space.length_deviations, 0.02 * space.length),
            ("crown_deviations", &space.crown_deviations, 5e-3 * rollers.radius),
        ];
        for (field, deviations, largest) in lists {
            if let Some(deviations) = deviations {
                let path = at(field);
                let of = ("rollers", path.as_str(), rollers.count);
                self.validate_deviations(judge, of, range(-largest, largest, "m"), deviations)?;
            }
        }
        if let Some(taper) = &space.taper {
            let at = |field: &str| at(&format!("taper.{field}"));
            judge.number(&at("half_angle"), taper.half_angle, HALF_ANGLE)?;
            let angle = range(2.0 * taper.half_angle, RACEWAY_ANGLE, "rad");
            judge.number(&at("outer_raceway_angle"), taper.outer_raceway_angle, angle)?;
        }
        // From the middle to an end.
        let grown = 0.5 * space.length * space.growth();
        if grown >= 0.5 * rollers.radius {
            let text = format!(
                "the small ends are {} m in radius; at least half of 'rollers.radius'",
                shown(rollers.radius - grown)
            );
            judge.refuse("rollers.space.taper.half_angle", text)?;
        }
        if let Some(ends) = &space.ends {
            let cap = range(CAP.min.max(rollers.radius), CAP.max, "m; flat ends are caps of 10 to 50 m");
            judge.number(&at("ends.cap_radius"), ends.cap_radius, cap)?;
            judge.number(
                &at("ends.face_radius"),
                ends.face_radius,
                range(1e-5 + 2.0 * grown, rollers.radius + grown, "m"),
            )?;
        }
        if let Some(slices) = self.raceways.as_ref().and_then(|raceways| raceways.slices)
            && !SLICES.contains(&slices)
        {
            let text = format!("{slices} is outside of {} to {}", SLICES.start(), SLICES.end());
            judge.refuse("raceways.slices", text)?;
        }
        if rollers.neighbours.is_some() {
            let text = "a law of the plane; not allowed beside 'rollers.space'; remove one of them";
            judge.refuse("rollers.neighbours", text)?;
        }
        if self.heat.is_some() {
            judge.refuse("heat", "not allowed beside 'rollers.space'; remove one of them")?;
        }
        if let Some(RingMotion::Free(_)) = self.inner_ring.as_ref().map(|ring| &ring.motion) {
            let text = "'free' is a motion in the plane; beside 'rollers.space' write 'space' or 'fixed'";
            judge.refuse("inner_ring.motion", text)?;
        }
        self.validate_ribs(judge, rollers, space)
    }

    fn validate_ribs(&self, judge: Judge<'_>, rollers: &Rollers, space: &RollerSpace) -> Result<()> {
        let Some(ribs) = &self.ribs else { return Ok(()) };
        judge.number("ribs.end_play", ribs.end_play, END_PLAY)?;
        contact(judge, "ribs.contact", &ribs.contact)?;
        if ribs.list.is_empty() {
            judge.refuse("ribs.list", "has no rib; remove 'ribs'")?;
        }
        let Some(ends) = &space.ends else {
            return judge.refuse("rollers.space.ends", "missing; 'ribs' need the shape of the ends");
        };
        for (k, rib) in ribs.list.iter().enumerate() {
            let at = |field: &str| format!("ribs.list.{k}.{field}");
            judge.number(&at("angle"), rib.angle, RIB_ANGLE)?;
            judge.number(&at("height"), rib.height, range(1e-5, rollers.radius, "m"))?;
            let chamfer = rollers.radius + 0.5 * space.length * space.growth() - ends.face_radius;
            if rib.height <= chamfer {
                let text = format!(
                    "{:?} m reaches no face: the ends begin {} m from the raceway; more than that",
                    rib.height,
                    shown(chamfer)
                );
                judge.refuse(&at("height"), text)?;
            }
            if ribs.list[..k].iter().any(|other| other.ring == rib.ring && other.side == rib.side) {
                judge
                    .refuse(&format!("ribs.list.{k}"), "a second rib of this ring on this side; remove it")?;
            }
        }
        Ok(())
    }

    /// Whether rollers hold the inner ring along the axis: by ribs of both rings, or by their cones.
    pub(super) fn rollers_hold_along(&self) -> bool {
        if self.taper().is_some() {
            return true;
        }
        let on = |ring: RibRing| self.ribs.iter().flat_map(|ribs| &ribs.list).any(|rib| rib.ring == ring);
        on(RibRing::Outer) && on(RibRing::Inner)
    }
}
