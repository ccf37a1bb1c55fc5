//! Checks of the cage: its masses, its pockets and its guide.

use crate::scalar::math;
use crate::scene::check::{Range, bad, range, shown};
use crate::scene::validate::*;
use crate::scene::*;
use std::f64::consts::FRAC_PI_2;

pub(super) const POCKET_CLEARANCE: Range = range(1e-7, 1e-2, "m");
const GUIDE_CLEARANCE: Range = range(1e-6, 1e-2, "m");
pub(crate) const VELOCITY: Range = range(-100.0, 100.0, "m/s");
pub(crate) const TORQUE: Range = range(-1e9, 1e9, "N m");

impl Scene {
    pub(in crate::scene) fn validate_cage(&self, judge: Judge<'_>, cage: &Cage) -> Result<()> {
        judge.number("cage.mass", cage.mass, MASS)?;
        judge.number("cage.inertia", cage.inertia, INERTIA)?;
        let ring = cage.mass * self.pitch_radius().powi(2);
        fitting_mass(judge, "cage.mass", cage.mass, cage.inertia, [0.05 * ring, 5.0 * ring])?;
        judge.number("cage.inertia", cage.inertia, range(0.05 * ring, 5.0 * ring, "kg m^2"))?;
        if let Some(material) = &cage.material {
            self.material_exists(judge, "cage.material", material)?;
        }
        if let Some(offset) = &cage.mass_eccentricity {
            let largest = 0.5 * self.pitch_radius();
            vector(judge, "cage.mass_eccentricity", offset, range(-largest, largest, "m"))?;
        }
        if let Some(ring) = &cage.elastic_ring {
            self.validate_elastic_ring(judge, ring, cage)?;
        }
        if let Some(load) = &cage.load {
            signal(judge, "cage.load.force_y", &load.force_y, FORCE)?;
            signal(judge, "cage.load.force_z", &load.force_z, FORCE)?;
            signal(judge, "cage.load.torque", &load.torque, TORQUE)?;
        }
        if let Some(start) = &self.initial.cage {
            vector(judge, "initial.cage", start, POSITION)?;
        }
        vector(judge, "initial.cage_velocity", &self.initial.cage_velocity, VELOCITY)?;
        judge.optional("initial.cage_speed", self.initial.cage_speed, SPEED)?;
        match &cage.pocket {
            None => {}
            Some(Pocket::LubricatedCylinder(pocket)) => self.validate_cylinder_pocket(judge, pocket)?,
            Some(Pocket::SolidCylinder(pocket)) => {
                self.validate_round_pocket(judge, "cage.pocket.solid_cylinder", pocket)?;
            }
            Some(Pocket::SolidSphere(pocket)) => {
                self.validate_round_pocket(judge, "cage.pocket.solid_sphere", pocket)?;
            }
            Some(Pocket::SolidPlane(pocket)) => {
                let path = "cage.pocket.solid_plane";
                judge.number(
                    &format!("{path}.diametral_clearance"),
                    pocket.diametral_clearance,
                    POCKET_CLEARANCE,
                )?;
                solid(judge, &format!("{path}.contact"), &pocket.contact)?;
                let half_width = self.element_radius() + 0.5 * pocket.diametral_clearance;
                self.neighbours_apart(judge, &format!("{path}.diametral_clearance"), half_width, "pockets")?;
            }
        }
        if let Some(guide) = &cage.guide {
            self.validate_guide(judge, "cage.guide", guide)?;
        }
        self.validate_motion_of_cage(judge, cage)?;
        // Where a free ring starts is not known before its equilibrium is found.
        match self.known_guide_centre() {
            Some(centre) => judge.pass("initial.cage", || {
                self.check_cage_start(self.initial.cage.map_or(centre, |c| [c.y, c.z]), centre)
            }),
            None => Ok(()),
        }
    }

    /// Where the ring that guides the cage starts, m; `None` for a ring that starts in equilibrium.
    fn known_guide_centre(&self) -> Option<[f64; 2]> {
        let guide = self.cage.as_ref().and_then(|cage| cage.guide.as_ref());
        let inner = guide.is_some_and(|guide| guide.ring == GuideRing::InnerRing);
        match self.outer_motion().filter(|_| !inner) {
            Some(OuterRingMotion::Prescribed(motion)) => return Some([motion.y.at(0.0), motion.z.at(0.0)]),
            Some(OuterRingMotion::Free(_)) if self.initial.inner_ring == RingStart::Equilibrium => {
                return None;
            }
            _ => {}
        }
        match self.inner_ring.as_ref().filter(|_| inner).map(|ring| &ring.motion) {
            Some(RingMotion::Fixed(position)) => Some([position.y, position.z]),
            Some(RingMotion::Prescribed(motion)) => Some([motion.y.at(0.0), motion.z.at(0.0)]),
            Some(RingMotion::Free(_) | RingMotion::Space(_))
                if self.initial.inner_ring == RingStart::Equilibrium =>
            {
                None
            }
            _ => Some([0.0; 2]),
        }
    }

    /// How far off the centre of the bearing (m) the cage can start before edges of its pockets reach into the elements, which
    /// start beside each other in them; `None` where they never do.
    pub(crate) fn reach_in_pockets(&self) -> Option<f64> {
        let Some(Pocket::LubricatedCylinder(pocket)) = self.cage.as_ref()?.pocket.as_ref() else {
            return None;
        };
        let element = self.element_radius() + self.largest_deviation();
        let radius = self.element_radius() + pocket.radial_clearance;
        let edge = radius * math::sin(pocket.half_angle);
        let discriminant = edge * edge - (radius * radius - element * element);
        (discriminant > 0.0).then(|| edge - discriminant.sqrt())
    }

    /// Whether the cage may start at `cage` (m), with the ring that guides it at `guide_centre`.
    ///
    /// # Errors
    /// [`crate::Status::BadScene`].
    pub(crate) fn check_cage_start(&self, cage: [f64; 2], guide_centre: [f64; 2]) -> Result<()> {
        let Some(body) = &self.cage else { return Ok(()) };
        if let Some(guide) = &body.guide {
            let clearance = guide.diametral_clearance / 2.0;
            let roundness: f64 = guide.roundness.iter().map(|a| a.amplitude.abs()).sum();
            let start = math::hypot(cage[0] - guide_centre[0], cage[1] - guide_centre[1]);
            // A solid contact may start pressed, but not through the ring.
            let room = if guide.solid.is_some() { 2.0 * clearance } else { clearance - roundness };
            if start >= room {
                let text = format!(
                    "the centre {} m from that of the guide ({:.3e}, {:.3e}) leaves no room in the radial guide \
                     clearance of {clearance:?} m",
                    shown(start),
                    guide_centre[0],
                    guide_centre[1]
                );
                return Err(bad("initial.cage", text));
            }
        }
        let start = math::hypot(cage[0], cage[1]);
        if let Some(reach) = self.reach_in_pockets()
            && start > reach
        {
            let text =
                format!("the centre {start:?} m off pushes pocket edges into rollers; at most {reach:e} m");
            return Err(bad("initial.cage", text));
        }
        if let Some(pocket) = &body.pocket
            && self.kinematic_elements.is_some()
        {
            // Prescribed elements do not start beside each other in displaced pockets: the cage may press on them, but
            // not be pushed through.
            let clearance = pocket.clearance();
            if start > 2.0 * clearance {
                let text = format!(
                    "the centre {start:?} m off presses elements through pockets of {clearance:?} m clearance; at most \
                     twice that"
                );
                return Err(bad("initial.cage", text));
            }
        }
        Ok(())
    }

    fn validate_cylinder_pocket(&self, judge: Judge<'_>, pocket: &CylinderPocket) -> Result<()> {
        let at = |field: &str| format!("cage.pocket.lubricated_cylinder.{field}");
        judge.number(&at("radial_clearance"), pocket.radial_clearance, POCKET_CLEARANCE)?;
        judge.number(&at("half_angle"), pocket.half_angle, range(1e-3, FRAC_PI_2 - 1e-3, "rad"))?;
        judge.number(&at("edge_blend"), pocket.edge_blend, range(0.0, pocket.half_angle, "rad"))?;
        if let Some(law) = &pocket.edge_friction {
            friction(judge, &at("edge_friction"), law)?;
        }
        contact(judge, &at("contact"), &pocket.contact)?;
        let radius = self.element_radius() + pocket.radial_clearance;
        self.neighbours_apart(judge, &at("radial_clearance"), radius, "pockets")
    }

    pub(super) fn validate_guide(&self, judge: Judge<'_>, path: &str, guide: &Guide) -> Result<()> {
        let at = |field: &str| format!("{path}.{field}");
        let pitch = self.pitch_radius();
        if guide.ring == GuideRing::InnerRing && self.inner_ring.is_none() {
            judge.refuse("inner_ring", format!("missing; {path}.ring needs it"))?;
        }
        // A shoulder of the ring: beside the elements, not beyond its raceway.
        let (near, beyond) = (0.1 * self.element_radius(), 1.25 * self.element_radius());
        let shoulder = match guide.ring {
            GuideRing::OuterRing => range(pitch - near, pitch + beyond, "m"),
            GuideRing::InnerRing => range(pitch - beyond, pitch + near, "m"),
        };
        judge.number(&at("guide_radius"), guide.guide_radius, shoulder)?;
        let land = range(WIDTH.min, guide.guide_radius, "m");
        judge.number(&at("diametral_clearance"), guide.diametral_clearance, GUIDE_CLEARANCE)?;
        if guide.diametral_clearance > 0.1 * guide.guide_radius {
            let text = format!(
                "{:?} m is more than a tenth of the guide radius {:?} m; guide laws need a narrow gap",
                guide.diametral_clearance, guide.guide_radius
            );
            judge.refuse(&at("diametral_clearance"), text)?;
        }
        match &guide.film {
            None => {}
            Some(GuideFilm::ShortBearing(film)) => {
                judge.number(&at("film.short_bearing.land_width"), film.land_width, land)?;
            }
            Some(GuideFilm::LubricantLayer(film)) => {
                let at = |field: &str| at(&format!("film.lubricant_layer.{field}"));
                judge.number(&at("land_width"), film.land_width, land)?;
                judge.number(&at("thickness"), film.thickness, range(1e-8, 0.1, "m"))?;
                judge.number(&at("pressure_cap"), film.pressure_cap, range(0.1, 0.999, ""))?;
            }
        }
        if let Some(law) = &guide.solid {
            solid(judge, &at("solid.contact"), &law.contact)?;
            let allowed = range(0.0, 0.25 * guide.diametral_clearance, "m");
            judge.optional(&at("solid.asperity_height"), law.asperity_height, allowed)?;
        }
        match (&guide.film, &guide.solid, &guide.film_share) {
            (None, None, _) => {
                judge.refuse(path, "guides by nothing: give 'film', 'solid' or both; or remove it")?;
            }
            (Some(_), Some(_), None) => {
                judge.refuse(&at("film_share"), "missing; a guide with film and solid contact needs it")?;
            }
            (Some(_), Some(_), Some(share)) => {
                let largest = guide.diametral_clearance / 12.0;
                judge.number(&at("film_share.roughness"), share.roughness, range(1e-9, largest, "m"))?;
                judge.number(&at("film_share.touching_ratio"), share.touching_ratio, range(0.0, 3.0, ""))?;
            }
            (_, _, Some(_)) => {
                judge.refuse(&at("film_share"), "needs both 'film' and 'solid' beside it")?;
            }
            _ => {}
        }
        self.validate_gap(judge, &at("roundness"), guide)
    }

    /// Roundness must leave a gap.
    fn validate_gap(&self, judge: Judge<'_>, path: &str, guide: &Guide) -> Result<()> {
        if guide.film.is_none() && !guide.roundness.is_empty() {
            judge.refuse(path, "needs 'film' beside it")?;
        }
        let clearance = guide.diametral_clearance / 2.0;
        let list = guide.roundness.iter().map(|a| (a.order, a.amplitude, a.phase));
        harmonics(judge, path, list, (2, " (order 1 is eccentricity)"), range(-clearance, clearance, "m"))?;
        let roundness: f64 = guide.roundness.iter().map(|a| a.amplitude.abs()).sum();
        if roundness >= clearance {
            let text = format!(
                "the amplitudes add up to {roundness:?} m and close the radial clearance {clearance:?} m"
            );
            judge.refuse(path, text)?;
        }
        Ok(())
    }
}

pub(super) fn solid(judge: Judge<'_>, path: &str, law: &SolidContact) -> Result<()> {
    let at = |field: &str| format!("{path}.{field}");
    judge.number(&at("stiffness"), law.stiffness, range(1.0, 1e12, "N/m"))?;
    judge.number(&at("damping"), law.damping, range(0.0, 1e6, "N s/m"))?;
    judge.number(&at("softening_depth"), law.softening_depth, range(0.0, 1e-3, "m"))?;
    law.friction.as_ref().map_or(Ok(()), |law| friction(judge, &at("friction"), law))
}

pub(super) fn friction(judge: Judge<'_>, path: &str, law: &Friction) -> Result<()> {
    judge.number(&format!("{path}.coefficient"), law.coefficient, COEFFICIENT)?;
    judge.number(&format!("{path}.transition_speed"), law.transition_speed, TRANSITION_SPEED)
}
