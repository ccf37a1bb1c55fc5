//! Checks of balls, their grooves, and a ring that moves in space.

use super::*;

/// Largest free contact angle of a deep groove bearing, rad: clearance beyond it lets balls climb out of their grooves.
const DEEPEST: f64 = 1.0;
/// Largest radius of a groove over that of the ball.
const WIDEST_GROOVE: f64 = 2.0;
pub(crate) const MOMENT: Range = range(-1e9, 1e9, "N m");
const STIFFNESS: Range = range(0.0, 1e12, "N/m");
const CONTACT_ANGLE: Range = range(0.0, 1.5, "rad");

impl Scene {
    pub(super) fn validate_balls(&self, judge: Judge<'_>, balls: &Balls) -> Result<()> {
        count(judge, "balls.count", balls.count)?;
        judge.number("balls.pitch_radius", balls.pitch_radius, RADIUS)?;
        judge.number("balls.radius", balls.radius, range(RADIUS.min, 0.5 * balls.pitch_radius, "m"))?;
        judge.number("balls.mass", balls.mass, MASS)?;
        self.material_exists(judge, "balls.material", &balls.material)?;
        let missing = |path: &str| bad(path, "missing; 'balls' need it");
        let outer = self.outer_ring.as_ref().ok_or_else(|| missing("outer_ring"))?;
        let inner = self.inner_ring.as_ref().ok_or_else(|| missing("inner_ring"))?;
        let mut grooves = [0.0; 2];
        for (groove, (ring, radius, shoulder, material)) in grooves.iter_mut().zip([
            ("outer_ring", outer.groove_radius, outer.shoulder_height, &outer.material),
            ("inner_ring", inner.groove_radius, inner.shoulder_height, &inner.material),
        ]) {
            let path = format!("{ring}.groove_radius");
            *groove = radius.ok_or_else(|| missing(&path))?;
            if *groove <= balls.radius {
                let text = format!(
                    "{groove:?} m is not larger than the radius {:?} m of the balls, which would touch its edges; 1.03 to 1.06 times \
                     as large is usual",
                    balls.radius
                );
                judge.refuse(&path, text)?;
            }
            judge.number(&path, *groove, range(balls.radius, WIDEST_GROOVE * balls.radius, "m"))?;
            judge.optional(&format!("{ring}.shoulder_height"), shoulder, range(1e-6, *groove, "m"))?;
            let path = format!("{ring}.material");
            self.material_exists(judge, &path, material.as_ref().ok_or_else(|| missing(&path))?)?;
        }
        self.validate_fit(judge, balls, inner, grooves)?;
        for ((ring, shoulder), groove) in
            [("outer_ring", outer.shoulder_height), ("inner_ring", inner.shoulder_height)]
                .into_iter()
                .zip(grooves)
        {
            let angle = balls.contact_angle.unwrap_or(0.0);
            let least = groove * (1.0 - math::cos(angle));
            if let Some(height) = shoulder.filter(|height| *height <= least) {
                let text = format!(
                    "{height:?} m is too low for balls that touch at {angle:?} rad: they would leave the groove without any load; more than {} m",
                    shown(least)
                );
                judge.refuse(&format!("{ring}.shoulder_height"), text)?;
            }
        }
        if let Some(drag) = &balls.drag {
            judge.number("balls.drag.density", drag.density, range(1e-3, 2000.0, "kg/m^3"))?;
            judge.number("balls.drag.coefficient", drag.coefficient, range(0.0, 10.0, "1"))?;
            if self.lubricant.is_none() && !judge.excuses("lubricant") {
                judge.refuse("lubricant", "missing; 'balls.drag' needs its viscosity")?;
            }
        }
        for (path, present) in [
            ("outer_ring.raceway_radius", outer.raceway_radius.is_some()),
            ("outer_ring.raceway_crown_radius", outer.raceway_crown_radius.is_some()),
            ("inner_ring.raceway_crown_radius", inner.raceway_crown_radius.is_some()),
            ("heat", self.heat.is_some()),
        ] {
            if present {
                judge.refuse(path, "not allowed beside 'balls'; remove it")?;
            }
        }
        let raceways = self.raceways.as_ref().ok_or_else(|| missing("raceways"))?;
        contact(judge, "raceways.contact", &raceways.contact)?;
        if raceways.slices.is_some() {
            judge.refuse(
                "raceways.slices",
                "balls have no profile; 'raceways.ellipse' says where their stress is summed",
            )?;
        }
        if let Some(resistance) = &raceways.rolling_resistance {
            rolling_resistance(judge, resistance)?;
            if resistance.inlet_sliding.is_some() {
                let text = "a law of rollers; remove it";
                judge.refuse("raceways.rolling_resistance.inlet_sliding", text)?;
            }
        }
        let deviations = balls.radius_deviations.as_ref();
        self.validate_sizes(judge, "balls", (balls.count, balls.radius), deviations)?;
        self.neighbours_apart(judge, "balls.count", balls.radius + self.largest_deviation(), "balls")
    }

    /// What only balls need stands beside balls only.
    pub(super) fn grooves_need_balls(&self, judge: Judge<'_>) -> Result<()> {
        if self.balls.is_some() || judge.excuses("balls") {
            return Ok(());
        }
        let (outer, inner) = (self.outer_ring.as_ref(), self.inner_ring.as_ref());
        for (path, present) in [
            ("outer_ring.groove_radius", outer.is_some_and(|ring| ring.groove_radius.is_some())),
            ("outer_ring.shoulder_height", outer.is_some_and(|ring| ring.shoulder_height.is_some())),
            ("inner_ring.groove_radius", inner.is_some_and(|ring| ring.groove_radius.is_some())),
            ("inner_ring.shoulder_height", inner.is_some_and(|ring| ring.shoulder_height.is_some())),
            ("raceways.ellipse", self.raceways.as_ref().is_some_and(|raceways| raceways.ellipse.is_some())),
        ] {
            if present {
                judge.refuse(path, "needs 'balls'; remove it")?;
            }
        }
        Ok(())
    }

    /// Contact angle or clearance: one of both, and one that can be.
    fn validate_fit(
        &self,
        judge: Judge<'_>,
        balls: &Balls,
        inner: &InnerRing,
        grooves: [f64; 2],
    ) -> Result<()> {
        match (balls.contact_angle, inner.radial_clearance) {
            (None, None) => {
                let text = "missing; give it, or 'inner_ring.radial_clearance' of a deep groove bearing";
                judge.refuse("balls.contact_angle", text)
            }
            (Some(_), Some(_)) => {
                let text =
                    "not allowed beside 'balls.contact_angle', from which it follows; remove one of them";
                judge.refuse("inner_ring.radial_clearance", text)
            }
            (Some(angle), None) => judge.number("balls.contact_angle", angle, CONTACT_ANGLE),
            (None, Some(clearance)) => {
                // cos a0 = 1 - P_d/(2 A), A the distance of the centres of both arcs.
                let distance: f64 = grooves.iter().map(|groove| groove - balls.radius).sum();
                let largest = 2.0 * distance * (1.0 - math::cos(DEEPEST));
                if clearance > largest {
                    let text = format!(
                        "{clearance:?} m lets balls climb to a free contact angle of more than {DEEPEST} rad in these grooves; at most \
                         {} m",
                        shown(largest)
                    );
                    judge.refuse("inner_ring.radial_clearance", text)?;
                }
                Ok(())
            }
        }
    }

    /// Whether it has rollers beside a ring that may shift along the axis and tilt: equilibria, no motion over time.
    pub(crate) fn has_tilting_rollers(&self) -> bool {
        let ring = self.inner_ring.as_ref().filter(|_| self.rollers.is_some());
        ring.is_some_and(|ring| matches!(ring.motion, RingMotion::Space(_)))
    }

    /// Whether its rollers shift along the axis, skew and tilt over time.
    pub(crate) fn has_skewing_rollers(&self) -> bool {
        self.rollers.as_ref().is_some_and(|rollers| rollers.space.is_some())
    }

    pub(super) fn validate_spatial_ring(&self, judge: Judge<'_>, ring: &SpatialRing) -> Result<()> {
        let at = |field: &str| format!("inner_ring.motion.space.{field}");
        if self.balls.is_none() && self.rollers.is_none() && !judge.excuses("balls") {
            return judge.refuse("inner_ring.motion.space", "needs 'balls' or 'rollers'; write 'fixed'");
        }
        if self.rollers.is_some() && ring.x == RingCoordinate::Free && !self.rollers_hold_along() {
            let text = "cylindrical rollers do not hold the ring along its axis without ribs on both rings; write '{\"held\": 0}'";
            judge.refuse(&at("x"), text)?;
        }
        for (name, coordinate) in ring.coordinates() {
            let allowed = if name.starts_with("tilt") { TILT } else { POSITION };
            match coordinate {
                RingCoordinate::Free => {}
                RingCoordinate::Held(value) => {
                    judge.number(&format!("{}.held", at(name)), *value, allowed)?;
                }
                RingCoordinate::Prescribed(motion) => {
                    let path = format!("{}.prescribed", at(name));
                    rings::place(judge, &path, motion, allowed)?;
                }
            }
        }
        for (name, load) in ring.load.iter().flat_map(SpatialLoad::components) {
            if let Some(load) = load {
                let allowed = if name.starts_with("moment") { MOMENT } else { FORCE };
                signal(judge, &at(&format!("load.{name}")), load, allowed)?;
            }
        }
        if let Some(preload) = &ring.preload {
            judge.number(&at("preload.force"), preload.force, FORCE)?;
            judge.number(&at("preload.stiffness"), preload.stiffness, STIFFNESS)?;
        }
        judge.optional(&at("mass"), ring.mass, MASS)?;
        if let Some(RotorInertia { polar, transverse }) = ring.inertia {
            judge.number(&at("inertia.transverse"), transverse, INERTIA)?;
            // No body has more of its mass about its axis than twice that across it.
            let most = range(INERTIA.min, 2.0 * transverse, "kg m^2, twice the transverse one at most");
            judge.number(&at("inertia.polar"), polar, most)?;
        }
        judge.optional(&at("support_damping"), ring.support_damping, rings::SUPPORT_DAMPING)?;
        judge.optional(&at("tilt_damping"), ring.tilt_damping, rings::SUPPORT_DAMPING)?;
        self.has_axial_stop(judge, ring)
    }

    /// A single row of balls with a contact angle holds one axial direction only.
    fn has_axial_stop(&self, judge: Judge<'_>, ring: &SpatialRing) -> Result<()> {
        let one_sided =
            self.balls.as_ref().and_then(|balls| balls.contact_angle).is_some_and(|angle| angle > 0.0);
        if !one_sided || ring.x != RingCoordinate::Free {
            return Ok(());
        }
        let load = ring.load.as_ref().and_then(|load| load.x.as_ref());
        let (smallest, _) = load.map_or((0.0, 0.0), Signal::bounds);
        let preload = ring.preload.map_or(0.0, |preload| preload.force);
        let elastic = ring.preload.is_some_and(|preload| preload.stiffness > 0.0);
        if smallest + preload > 0.0 || elastic || smallest.is_nan() {
            return Ok(());
        }
        let text = format!(
            "the axial load, {} N at least, does not press the ring into the bearing, which has no axial stop the other way; more than \
             0 N, a 'preload', or 'x' held",
            shown(smallest + preload)
        );
        judge.refuse("inner_ring.motion.space.load.x", text)
    }
}
