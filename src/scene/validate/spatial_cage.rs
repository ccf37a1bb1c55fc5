//! Checks of a cage that moves in space, its pockets and its lands.

use super::cage::{POCKET_CLEARANCE, VELOCITY, friction, solid};
use super::*;

const TILT: Range = range(-0.1, 0.1, "rad");
const DENSITY: Range = range(100.0, 2e4, "kg/m^3");
/// Tilts of pockets and lands are small beside one.
const SLICES: std::ops::RangeInclusive<u32> = 1..=15;

impl Scene {
    /// Whether its cage moves in space.
    pub(crate) fn has_spatial_cage(&self) -> bool {
        self.cage.as_ref().is_some_and(|cage| cage.space.is_some())
    }

    /// Moment of inertia across the axis of a cage of this shape with the pockets of the scene, kg m^2.
    pub(crate) fn transverse_inertia_of(&self, shape: &CageShape) -> f64 {
        let pocket = self.cage.as_ref().and_then(|cage| cage.pocket.as_ref());
        let hole = self.element_radius() + pocket.map_or(0.0, Pocket::clearance);
        shape.transverse_inertia(self.element_count(), hole)
    }

    /// In the plane or in space, with what that needs.
    pub(super) fn validate_motion_of_cage(&self, judge: Judge<'_>, cage: &Cage) -> Result<()> {
        let Some(space) = &cage.space else { return self.validate_planar_cage(judge, cage) };
        let in_plane = self.rollers.as_ref().is_some_and(|rollers| rollers.space.is_none());
        if in_plane && !judge.excuses("rollers.space") {
            let text = "not allowed beside 'rollers' in the plane; remove it, or add 'rollers.space'";
            return judge.refuse("cage.space", text);
        }
        if self.rollers.is_some() {
            if let Some(Pocket::SolidPlane(pocket)) = &cage.pocket
                && pocket.axial_clearance.is_some()
            {
                let text = "of balls; of rollers 'cage.space.pocket_sides'";
                judge.refuse("cage.pocket.solid_plane.axial_clearance", text)?;
            }
            if let Some(Pocket::SolidCylinder(_) | Pocket::SolidSphere(_)) = &cage.pocket {
                let text = "a pocket of balls; of rollers 'solid_plane' or 'lubricated_cylinder'";
                judge.refuse("cage.pocket", text)?;
            }
        } else if let Some(Pocket::LubricatedCylinder(_)) = &cage.pocket {
            let text = "a law of the plane; in space give 'solid_plane', 'solid_cylinder' or 'solid_sphere'";
            judge.refuse("cage.pocket.lubricated_cylinder", text)?;
        }
        self.validate_transverse(judge, cage, space)?;
        let largest = 0.5 * self.pitch_radius();
        judge.number("cage.space.mass_offset_x", space.mass_offset_x, range(-largest, largest, "m"))?;
        let height = range(1e-6, 2.0 * self.element_radius(), "m");
        judge.optional("cage.space.pocket_height", space.pocket_height, height)?;
        if let Some(sides) = &space.pocket_sides {
            if !self.has_skewing_rollers() {
                judge.refuse("cage.space.pocket_sides", "stops rollers in space; remove it")?;
            } else if self.rollers.as_ref().and_then(|rollers| rollers.space.as_ref()?.ends).is_none() {
                let text = "missing; 'cage.space.pocket_sides' needs the shape of the ends";
                judge.refuse("rollers.space.ends", text)?;
            }
            judge.number("cage.space.pocket_sides.play", sides.play, range(1e-7, 1e-2, "m"))?;
            contact(judge, "cage.space.pocket_sides.contact", &sides.contact)?;
        }
        if let Some(load) = &space.load {
            signal(judge, "cage.space.load.force_x", &load.force_x, FORCE)?;
            signal(judge, "cage.space.load.moment_y", &load.moment_y, TORQUE)?;
            signal(judge, "cage.space.load.moment_z", &load.moment_z, TORQUE)?;
        }
        for (k, land) in space.lands.iter().enumerate() {
            let at = |field: &str| format!("cage.space.lands.{k}.{field}");
            judge.number(&at("x"), land.x, range(-self.pitch_radius(), self.pitch_radius(), "m"))?;
            judge.optional(&at("width"), land.width, range(WIDTH.min, self.pitch_radius(), "m"))?;
            if !SLICES.contains(&land.slices) {
                let text = format!("{} is outside of {} to {}", land.slices, SLICES.start(), SLICES.end());
                judge.refuse(&at("slices"), text)?;
            }
            self.validate_guide(judge, &at("guide"), &land.guide)?;
        }
        self.validate_spatial_start(judge, space)
    }

    fn validate_planar_cage(&self, judge: Judge<'_>, cage: &Cage) -> Result<()> {
        if self.balls.is_some() || self.has_skewing_rollers() {
            judge.refuse("cage.space", "missing; a cage beside elements in space moves in space, too")?;
        }
        if self.initial.cage_space.is_some() {
            judge.refuse("initial.cage_space", "needs 'cage.space'; remove it")?;
        }
        match &cage.pocket {
            Some(Pocket::SolidPlane(pocket)) if pocket.axial_clearance.is_some() => {
                let text = "needs 'cage.space'; remove it";
                judge.refuse("cage.pocket.solid_plane.axial_clearance", text)
            }
            Some(pocket) if pocket.is_in_space() => {
                judge.refuse("cage.pocket", "a shape for cages in space, which 'cage.space' makes them")
            }
            _ => Ok(()),
        }
    }

    /// Moment of inertia across the axis, or the shape that it follows from.
    fn validate_transverse(&self, judge: Judge<'_>, cage: &Cage, space: &SpatialCage) -> Result<()> {
        let path = "cage.space.transverse_inertia";
        // No body has more of its mass about its axis than twice that across it.
        let allowed = range((0.5 * cage.inertia).max(INERTIA.min), 100.0 * cage.inertia, "kg m^2");
        match (space.transverse_inertia, &space.shape) {
            (None, None) => judge.refuse(path, "missing; give it, or 'cage.space.shape'"),
            (Some(_), Some(_)) => {
                let text = "not allowed beside 'cage.space.transverse_inertia'; remove one of them";
                judge.refuse("cage.space.shape", text)
            }
            (Some(inertia), None) => judge.number(path, inertia, allowed),
            (None, Some(shape)) => {
                let at = |field: &str| format!("cage.space.shape.{field}");
                judge.number(&at("inner_radius"), shape.inner_radius, RADIUS)?;
                let outside = range(shape.inner_radius, RADIUS.max, "m");
                judge.number(&at("outer_radius"), shape.outer_radius, outside)?;
                judge.number(&at("width"), shape.width, range(1e-4, RADIUS.max, "m"))?;
                judge.number(&at("density"), shape.density, DENSITY)?;
                let found = self.transverse_inertia_of(shape);
                let fits = (allowed.min..=allowed.max).contains(&found) || found.is_nan();
                if !fits {
                    let text = format!(
                        "makes a moment of inertia of {} kg m^2 across the axis, which does not fit the {:?} kg m^2 about it; allowed are {} to {}",
                        shown(found),
                        cage.inertia,
                        shown(allowed.min),
                        shown(allowed.max)
                    );
                    judge.refuse("cage.space.shape", text)?;
                }
                Ok(())
            }
        }
    }

    pub(super) fn validate_round_pocket(
        &self,
        judge: Judge<'_>,
        path: &str,
        pocket: &RoundPocket,
    ) -> Result<()> {
        let at = |field: &str| format!("{path}.{field}");
        judge.number(&at("diametral_clearance"), pocket.diametral_clearance, POCKET_CLEARANCE)?;
        judge.optional(&at("axial_clearance"), pocket.axial_clearance, POCKET_CLEARANCE)?;
        match &pocket.law {
            PocketLaw::Spring(contact) => solid(judge, &at("law.spring"), contact)?,
            PocketLaw::Hertz(law) => {
                if let Some(damping) = &law.damping {
                    let at = |field: &str| at(&format!("law.hertz.damping.{field}"));
                    let time = damping.relaxation_time;
                    judge.number(&at("relaxation_time"), time, range(0.0, 1e-3, "s"))?;
                    judge.number(&at("softening_depth"), damping.softening_depth, range(1e-12, 1e-5, "m"))?;
                }
                if let Some(law) = &law.friction {
                    friction(judge, &at("law.hertz.friction"), law)?;
                }
            }
        }
        let half_width = self.element_radius() + 0.5 * pocket.diametral_clearance;
        self.neighbours_apart(judge, &at("diametral_clearance"), half_width, "pockets")
    }

    fn validate_spatial_start(&self, judge: Judge<'_>, space: &SpatialCage) -> Result<()> {
        let Some(start) = &self.initial.cage_space else { return Ok(()) };
        let at = |field: &str| format!("initial.cage_space.{field}");
        judge.number(&at("x"), start.x, POSITION)?;
        judge.number(&at("velocity_x"), start.velocity_x, VELOCITY)?;
        judge.number(&at("tilt_y"), start.tilt_y, TILT)?;
        judge.number(&at("tilt_z"), start.tilt_z, TILT)?;
        judge.number(&at("tilt_speed_y"), start.tilt_speed_y, SPEED)?;
        judge.number(&at("tilt_speed_z"), start.tilt_speed_z, SPEED)?;
        // A tilt must leave room in every land.
        let tilt = math::hypot(start.tilt_y, start.tilt_z);
        for (k, land) in space.lands.iter().enumerate() {
            let clearance = 0.5 * land.guide.diametral_clearance;
            let room = if land.guide.solid.is_some() { 2.0 * clearance } else { clearance };
            let lifted = tilt * land.x.abs();
            if lifted >= room {
                let text = format!(
                    "a tilt of {} rad takes 'cage.space.lands.{k}' {} m off, which leaves no room in its radial clearance of {clearance:?} m",
                    shown(tilt),
                    shown(lifted)
                );
                judge.refuse("initial.cage_space", text)?;
            }
        }
        Ok(())
    }
}
