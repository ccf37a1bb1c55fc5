//! Checks of a parsed scene: ranges, geometry that can exist, references between its parts.
//!
//! Values that are known to be wrong are NaN while others are looked for (see `scene/problems.rs`), so a comparison that refuses a
//! value must be false of NaN, and what is refused without one asks the [`Judge`].
//!
//! The ranges are wide for engineering and narrow for unit slips. What a law needs from other parts of the scene is
//! checked where the law is built, in the model.

mod balls;
mod cage;
mod elastic_ring;
mod heat;
mod judge;
mod lubricant;
mod plausible;
mod profile;
mod rings;
mod roller_space;
mod series;
mod sizes;
mod spatial_cage;
mod waves;

pub(crate) use balls::MOMENT;
pub(crate) use cage::{TORQUE, VELOCITY};
pub(in crate::scene) use judge::{Judge, is_at_or_below};
pub(crate) use rings::{POSITION, TILT};

pub(in crate::scene) use series::signal;
use series::{harmonics, table};

use crate::scalar::math;
use crate::scene::check::{Range, bad, range, shown, slip_hint};
use crate::scene::*;
use std::f64::consts::PI;

pub(in crate::scene) const RADIUS: Range = range(1e-4, 5.0, "m");
pub(in crate::scene) const WIDTH: Range = range(1e-5, 5.0, "m");
/// Largest step of the leapfrog, s.
const LARGEST_LEAPFROG_STEP: f64 = 1e-3;
const ROLLER_CLEARANCE: Range = range(-2e-4, 2e-3, "m");
pub(in crate::scene) const MASS: Range = range(1e-7, 1e6, "kg");
pub(in crate::scene) const INERTIA: Range = range(1e-15, 1e6, "kg m^2");
pub(crate) const SPEED: Range = range(-1e5, 1e5, "rad/s");
pub(crate) const VISCOSITY: Range = range(1e-5, 1e3, "Pa s");
pub(crate) const FORCE: Range = range(-1e9, 1e9, "N");
const GRAVITY: Range = range(-1e4, 1e4, "m/s^2");
pub(in crate::scene) const ANGLE: Range = range(-1e3, 1e3, "rad");
const TIME: Range = range(0.0, 1e6, "s");
pub(in crate::scene) const COEFFICIENT: Range = range(0.0, 2.0, "");
pub(in crate::scene) const TRANSITION_SPEED: Range = range(1e-6, 10.0, "m/s");
pub(crate) const TEMPERATURE: Range = range(150.0, 1000.0, "K");
const MAX_ELEMENTS: u32 = 1000;
const MAX_RECORDS: f64 = 1e8;

impl Scene {
    /// Checks every value and the geometry.
    ///
    /// # Errors
    /// [`crate::Status::BadScene`]; the message starts with the JSON path.
    pub fn validate(&self) -> Result<()> {
        self.judged(Judge::STRICT)
    }

    /// The same, going on where the judge says so.
    pub(in crate::scene) fn judged(&self, judge: Judge<'_>) -> Result<()> {
        if self.schema != SCENE_SCHEMA {
            judge.refuse("schema", format!("'{}' is not '{SCENE_SCHEMA}'", self.schema))?;
        }
        if let Some(g) = &self.gravity {
            vector(judge, "gravity", g, GRAVITY)?;
        }
        for (name, material) in &self.materials {
            material.validate(judge, &format!("materials.{name}"))?;
        }
        if let Some(lubricant) = &self.lubricant {
            lubricant.validate(judge)?;
            let layered = |guide: &Guide| matches!(guide.film, Some(GuideFilm::LubricantLayer(_)));
            let seen =
                self.cage.iter().flat_map(Cage::guides).any(layered) || judge.excuses("cage.guide.film");
            if lubricant.grease.is_some() && !seen {
                let text = "nothing sees it; it thickens the oil of cage.guide.film.lubricant_layer only";
                judge.refuse("lubricant.grease", text)?;
            }
            if let Viscosity::Walther(walther) = &lubricant.viscosity {
                let path = "lubricant.viscosity.walther.temperature";
                match (&walther.temperature, &self.heat) {
                    (None, None) => {
                        judge.refuse(path, "missing; give it, or 'heat', which it follows from")?;
                    }
                    (Some(_), Some(_)) => {
                        judge.refuse(
                            path,
                            "not allowed beside 'heat', which it follows from; remove one of them",
                        )?;
                    }
                    _ => {}
                }
            }
        }
        if let Some(heat) = &self.heat {
            self.validate_heat(judge, heat)?;
        }
        let kinds = self.element_kinds();
        match kinds[..] {
            [_] => {}
            [] => judge.refuse("rollers", "missing; give these, 'balls' or 'kinematic_elements'")?,
            [first, .., last] => {
                judge.refuse(last, format!("not allowed beside '{first}'; remove one of them"))?;
            }
        }
        if let Some(ring) = &self.inner_ring {
            self.validate_inner_ring(judge, ring)?;
        }
        if let Some(ring) = &self.outer_ring {
            self.validate_outer_ring(judge, ring)?;
        }
        if let Some(rotor) = &self.rotor {
            self.validate_rotor(judge, rotor)?;
        }
        // What elements of an unknown kind need is unknown.
        let known = |path: &str| !judge.excuses(path);
        let single = |path: &str| kinds.len() == 1 && known(path);
        if let Some(rollers) = self.rollers.as_ref().filter(|_| single("rollers")) {
            self.validate_rollers(judge, rollers)?;
        }
        if let Some(balls) = self.balls.as_ref().filter(|_| single("balls")) {
            self.validate_balls(judge, balls)?;
        }
        if let Some(elements) = self.kinematic_elements.as_ref().filter(|_| single("kinematic_elements")) {
            self.validate_kinematic(judge, elements)?;
        }
        self.grooves_need_balls(judge)?;
        self.validate_waves(judge)?;
        if let Some(cage) = &self.cage {
            self.validate_cage(judge, cage)?;
        }
        self.validate_run(judge)
    }

    fn validate_rollers(&self, judge: Judge<'_>, r: &Rollers) -> Result<()> {
        count(judge, "rollers.count", r.count)?;
        // Geometry first: a radius in millimetres would be blamed on the inertia otherwise.
        if let Some(raceway) = self.outer_ring.as_ref().and_then(|outer| outer.raceway_radius) {
            judge.number("outer_ring.raceway_radius", raceway, RADIUS)?;
            judge.number("rollers.radius", r.radius, range(RADIUS.min, 0.5 * raceway, "m"))?;
        }
        judge.number("rollers.radius", r.radius, RADIUS)?;
        judge.number(
            "rollers.effective_length",
            r.effective_length,
            range(WIDTH.min, 50.0 * r.radius, "m"),
        )?;
        judge.number("rollers.mass", r.mass, MASS)?;
        let ring = r.mass * r.radius * r.radius;
        fitting_mass(judge, "rollers.mass", r.mass, r.inertia, [0.2 * ring, 1.1 * ring])?;
        judge.number("rollers.inertia", r.inertia, range(0.2 * ring, 1.1 * ring, "kg m^2"))?;
        judge.optional("rollers.dynamic_load_rating", r.dynamic_load_rating, range(1.0, 1e9, "N"))?;
        self.validate_sizes(judge, "rollers", (r.count, r.radius), r.radius_deviations.as_ref())?;
        if let Some(neighbours) = &r.neighbours {
            contact(judge, "rollers.neighbours.contact", &neighbours.contact)?;
            if r.count < 3 {
                let text = format!("{} rollers have no neighbour on either side; 3 at least", r.count);
                judge.refuse("rollers.neighbours", text)?;
            }
        }
        self.validate_roller_space(judge, r)?;
        self.material_exists(judge, "rollers.material", &r.material)?;
        let missing = |path: &str| bad(path, "missing; 'rollers' need it");
        let outer = self.outer_ring.as_ref().ok_or_else(|| missing("outer_ring"))?;
        let raceway = outer.raceway_radius.ok_or_else(|| missing("outer_ring.raceway_radius"))?;
        let material = outer.material.as_ref().ok_or_else(|| missing("outer_ring.material"))?;
        self.material_exists(judge, "outer_ring.material", material)?;
        let inner = self.inner_ring.as_ref().ok_or_else(|| missing("inner_ring"))?;
        let clearance = inner.radial_clearance.ok_or_else(|| missing("inner_ring.radial_clearance"))?;
        inner.material.as_ref().ok_or_else(|| missing("inner_ring.material"))?;
        if clearance > 0.2 * r.radius {
            let text = format!("{clearance:?} m is more than a fifth of the roller radius {:?} m", r.radius);
            judge.refuse("inner_ring.radial_clearance", text)?;
        }
        let inner_radius = raceway - 2.0 * r.radius - clearance / 2.0;
        if inner_radius < 0.1 * r.radius {
            let text = format!(
                "{raceway:?} m leaves no room for the inner ring (its raceway radius would be {inner_radius:?} m)"
            );
            judge.refuse("outer_ring.raceway_radius", text)?;
        }
        let fixed = matches!(inner.motion, RingMotion::Fixed(_)) && outer.motion.is_none();
        if self.initial.inner_ring == RingStart::Equilibrium && fixed {
            let text = "'equilibrium' needs a free inner ring; write 'centred' for a fixed one";
            judge.refuse("initial.inner_ring", text)?;
        }
        let raceways = self.raceways.as_ref().ok_or_else(|| missing("raceways"))?;
        contact(judge, "raceways.contact", &raceways.contact)?;
        if let Some(resistance) = &raceways.rolling_resistance {
            rolling_resistance(judge, resistance)?;
        }
        self.validate_profile(judge, r, outer, inner, raceways)?;
        self.neighbours_apart(judge, "rollers.count", r.radius + self.largest_deviation(), "rollers")
    }

    fn validate_kinematic(&self, judge: Judge<'_>, elements: &KinematicElements) -> Result<()> {
        count(judge, "kinematic_elements.count", elements.count)?;
        judge.number("kinematic_elements.radius", elements.radius, RADIUS)?;
        judge.number("kinematic_elements.pitch_radius", elements.pitch_radius, RADIUS)?;
        if elements.radius >= elements.pitch_radius {
            let text = format!(
                "{:?} m is not smaller than the pitch radius {:?} m; the element would cover the bearing centre{}",
                elements.radius,
                elements.pitch_radius,
                slip_hint(elements.radius, range(RADIUS.min, 0.5 * elements.pitch_radius, "m"))
            );
            judge.refuse("kinematic_elements.radius", text)?;
        }
        judge.optional("kinematic_elements.effective_length", elements.effective_length, WIDTH)?;
        if let Some(material) = &elements.material {
            self.material_exists(judge, "kinematic_elements.material", material)?;
        }
        match &elements.motion {
            ElementMotion::Rolling { contact_angle } => {
                let path = "kinematic_elements.motion.rolling.contact_angle";
                judge.number(path, *contact_angle, range(-1.5, 1.5, "rad"))?;
                if self.inner_ring.is_none() {
                    judge
                        .refuse("inner_ring", "missing; kinematic_elements.motion.rolling needs its speed")?;
                }
            }
            ElementMotion::Prescribed { orbit_speed, spin_speed } => {
                let path = "kinematic_elements.motion.prescribed";
                signal(judge, &format!("{path}.orbit_speed"), orbit_speed, SPEED)?;
                signal(judge, &format!("{path}.spin_speed"), spin_speed, SPEED)?;
            }
        }
        let outer = self.outer_ring.as_ref();
        for (path, present) in [
            ("outer_ring.raceway_radius", outer.is_some_and(|ring| ring.raceway_radius.is_some())),
            (
                "outer_ring.raceway_crown_radius",
                outer.is_some_and(|ring| ring.raceway_crown_radius.is_some()),
            ),
            ("raceways", self.raceways.is_some()),
        ] {
            if present {
                let text = "not allowed beside 'kinematic_elements', which touch no raceway; remove it";
                judge.refuse(path, text)?;
            }
        }
        if let Some(material) = outer.and_then(|ring| ring.material.as_ref()) {
            self.material_exists(judge, "outer_ring.material", material)?;
        }
        if self.initial.inner_ring == RingStart::Equilibrium {
            judge.refuse("initial.inner_ring", "'equilibrium' needs 'rollers'; write 'centred'")?;
        }
        if self.cage.is_none() {
            judge.refuse("cage", "missing; beside 'kinematic_elements' nothing else can move")?;
        }
        self.neighbours_apart(judge, "kinematic_elements.count", elements.radius, "elements")
    }

    /// Distance between neighbouring centres must exceed twice `radius`.
    pub(in crate::scene) fn neighbours_apart(
        &self,
        judge: Judge<'_>,
        path: &str,
        radius: f64,
        what: &str,
    ) -> Result<()> {
        let count = self.element_count();
        let spacing = 2.0 * self.pitch_radius() * math::sin(PI / f64::from(count));
        if count > 1 && spacing <= 2.0 * radius {
            let text = format!(
                "{count} {what} of radius {radius:?} m overlap on a pitch circle of radius {:?} m",
                self.pitch_radius()
            );
            judge.refuse(path, text)?;
        }
        Ok(())
    }

    /// The kinds of rolling elements that it has; a checked one has one.
    fn element_kinds(&self) -> Vec<&'static str> {
        let kinds = [
            ("rollers", self.rollers.is_some()),
            ("balls", self.balls.is_some()),
            ("kinematic_elements", self.kinematic_elements.is_some()),
        ];
        kinds.into_iter().filter_map(|(kind, is)| is.then_some(kind)).collect()
    }

    /// Number of rolling elements.
    pub fn element_count(&self) -> u32 {
        let kinematic = self.kinematic_elements.as_ref().map(|e| e.count);
        let of_balls = self.balls.as_ref().map(|b| b.count);
        self.rollers.as_ref().map(|r| r.count).or(of_balls).or(kinematic).unwrap_or(0)
    }

    /// Radius of a rolling element, m.
    pub fn element_radius(&self) -> f64 {
        let kinematic = self.kinematic_elements.as_ref().map(|e| e.radius);
        let of_balls = self.balls.as_ref().map(|b| b.radius);
        self.rollers.as_ref().map(|r| r.radius).or(of_balls).or(kinematic).unwrap_or(0.0)
    }

    /// Radius of the pitch circle, m; for rollers the mean of the raceway radii.
    pub fn pitch_radius(&self) -> f64 {
        if let Some(elements) = &self.kinematic_elements {
            return elements.pitch_radius;
        }
        if let Some(balls) = &self.balls {
            return balls.pitch_radius;
        }
        let outer = self.outer_ring.as_ref().and_then(|r| r.raceway_radius).unwrap_or(0.0);
        // A clearance that is not known yet changes the circle by less than what checks of a scene can tell.
        let clearance = Some(self.radial_clearance()).filter(|clearance| !clearance.is_nan()).unwrap_or(0.0);
        outer
            - self.element_radius() * math::cos(self.taper().map_or(0.0, RollerTaper::inclination))
            - clearance / 4.0
    }

    /// Cones of its rollers, if they are tapered.
    pub(crate) fn taper(&self) -> Option<&RollerTaper> {
        self.rollers.as_ref()?.space.as_ref()?.taper.as_ref()
    }

    /// Diametral play of the inner ring on the rollers, m; zero without rollers.
    pub fn radial_clearance(&self) -> f64 {
        let given = self.inner_ring.as_ref().and_then(|r| r.radial_clearance).unwrap_or(0.0);
        self.warmed_clearance(given).unwrap_or(given)
    }

    fn validate_run(&self, judge: Judge<'_>) -> Result<()> {
        if self.cage.is_none() {
            let start = &self.initial;
            for (field, given) in [
                ("cage", start.cage.is_some()),
                ("cage_velocity", start.cage_velocity != PlaneVector::default()),
                ("cage_speed", start.cage_speed.is_some()),
            ] {
                if given {
                    judge.refuse(&format!("initial.{field}"), "there is no cage to place")?;
                }
            }
        }
        judge.number("initial.first_roller_angle", self.initial.first_roller_angle, ANGLE)?;
        judge.number("solver.min_step", self.solver.min_step, range(1e-18, 1e-6, "s"))?;
        judge.optional("solver.max_step", self.solver.max_step, range(self.solver.min_step, 1e-2, "s"))?;
        let method = &self.solver.method;
        let path = format!("solver.method.{}.tolerance", method.name());
        judge.optional(&path, method.tolerance(), range(1e-13, 1e-1, ""))?;
        if let Method::Leapfrog(m) = method {
            let largest = self.solver.max_step.unwrap_or(LARGEST_LEAPFROG_STEP);
            let largest = largest.min(LARGEST_LEAPFROG_STEP);
            let allowed = range(self.solver.min_step.max(1e-10).min(largest), largest, "s");
            judge.optional("solver.method.leapfrog.step", m.step, allowed)?;
        }
        if self.solver.max_steps == 0 {
            judge.refuse("solver.max_steps", "0 is not allowed; at least 1")?;
        }
        judge.number("record.duration", self.record.duration, range(1e-9, 1e5, "s"))?;
        let Record { duration, interval, .. } = self.record;
        if interval > duration {
            let text =
                format!("{interval:?} s is longer than the run, {} s (record.duration)", shown(duration));
            judge.refuse("record.interval", text)?;
        }
        judge.number("record.interval", interval, range(1e-10, duration, "s"))?;
        judge.optional(
            "record.window",
            self.record.window,
            range(self.record.interval, self.record.duration, "s"),
        )?;
        let records = self.record.duration / self.record.interval;
        if records > MAX_RECORDS {
            let text =
                format!("{:?} s gives {records:e} records, at most {MAX_RECORDS:e}", self.record.interval);
            judge.refuse("record.interval", text)?;
        }
        Ok(())
    }

    pub(in crate::scene) fn material_exists(&self, judge: Judge<'_>, path: &str, name: &str) -> Result<()> {
        if self.materials.contains_key(name) || judge.excuses("materials") {
            return Ok(());
        }
        let known: Vec<&str> = self.materials.keys().map(String::as_str).collect();
        let known = if known.is_empty() { "there are none".to_owned() } else { known.join(", ") };
        let others = catalogue::names("materials").filter(|name| !self.materials.contains_key(*name));
        let others = others.collect::<Vec<&str>>().join(", ");
        judge.refuse(
            path,
            format!("'{name}' is not one of the materials ({known}), nor of the catalogue ({others})"),
        )
    }
}

/// A mass in grams makes an inertia in kg m^2 look far too small.
pub(in crate::scene) fn fitting_mass(
    judge: Judge<'_>,
    path: &str,
    mass: f64,
    inertia: f64,
    allowed: [f64; 2],
) -> Result<()> {
    let [min, max] = allowed.map(|inertia| 1e-3 * inertia);
    let in_grams = min <= inertia && inertia <= max && inertia < 1e3 * min;
    if !in_grams {
        return Ok(());
    }
    let text = format!(
        "{mass:?} kg is far too much for the inertia; was it meant in grams, {} kg?",
        shown(1e-3 * mass)
    );
    judge.refuse(path, text)
}

impl Material {
    fn validate(&self, judge: Judge<'_>, path: &str) -> Result<()> {
        judge.number(&format!("{path}.young_modulus"), self.young_modulus, range(1e7, 1e13, "Pa"))?;
        judge.number(&format!("{path}.poisson_ratio"), self.poisson_ratio, range(0.0, 0.499, ""))?;
        if let Some(t) = &self.thermal {
            judge.number(
                &format!("{path}.thermal.conductivity"),
                t.conductivity,
                range(1e-2, 1e4, "W/(m K)"),
            )?;
            judge.number(&format!("{path}.thermal.density"), t.density, range(10.0, 3e4, "kg/m^3"))?;
            judge.number(
                &format!("{path}.thermal.specific_heat"),
                t.specific_heat,
                range(10.0, 1e4, "J/(kg K)"),
            )?;
        }
        Ok(())
    }
}

/// Checks both components of a vector.
pub(in crate::scene) fn vector(judge: Judge<'_>, path: &str, v: &PlaneVector, allowed: Range) -> Result<()> {
    judge.number(&format!("{path}.y"), v.y, allowed)?;
    judge.number(&format!("{path}.z"), v.z, allowed)
}

fn rolling_resistance(judge: Judge<'_>, law: &RollingResistance) -> Result<()> {
    if let Extent::Loaded { threshold } = law.extent {
        let path = "raceways.rolling_resistance.extent.loaded.threshold";
        judge.number(path, threshold, range(1e-6, 1e9, "N"))?;
    }
    let Some(InletSliding { rigid_ratio, elastic_ratio }) = &law.inlet_sliding else { return Ok(()) };
    for (ratio, name) in [(rigid_ratio, "rigid_ratio"), (elastic_ratio, "elastic_ratio")] {
        if let Some(ratio) = *ratio {
            judge.number(
                &format!("raceways.rolling_resistance.inlet_sliding.{name}"),
                ratio,
                range(0.0, 2.0, ""),
            )?;
        }
    }
    Ok(())
}

fn count(judge: Judge<'_>, path: &str, n: u32) -> Result<()> {
    if (1..=MAX_ELEMENTS).contains(&n) {
        return Ok(());
    }
    judge.refuse(path, format!("{n} is not within 1 to {MAX_ELEMENTS}"))
}

/// Checks the optional laws of a line contact.
pub(in crate::scene) fn contact(judge: Judge<'_>, path: &str, laws: &ContactLaws) -> Result<()> {
    let at = |field: &str| format!("{path}.{field}");
    if let Some(d) = &laws.damping {
        judge.number(&at("damping.relaxation_time"), d.relaxation_time, range(1e-12, 1e-3, "s"))?;
        judge.number(&at("damping.softening_depth"), d.softening_depth, range(1e-12, 1e-4, "m"))?;
    }
    if let Some(b) = &laws.boundary_friction {
        judge.number(&at("boundary_friction.coefficient"), b.coefficient, COEFFICIENT)?;
        judge.number(&at("boundary_friction.transition_speed"), b.transition_speed, TRANSITION_SPEED)?;
        judge.number(&at("boundary_friction.roughness"), b.roughness, range(1e-10, 1e-4, "m"))?;
        judge.number(&at("boundary_friction.lambda_boundary"), b.lambda_boundary, range(0.0, 100.0, ""))?;
        let full = range(b.lambda_boundary + 1e-3, 1e3, "");
        judge.number(&at("boundary_friction.lambda_full"), b.lambda_full, full)?;
    }
    for (field, present, needs, has) in [
        ("thermal_correction", laws.thermal_correction.is_some(), "film", laws.film.is_some()),
        ("traction", laws.traction.is_some(), "film", laws.film.is_some()),
        ("boundary_friction", laws.boundary_friction.is_some(), "film", laws.film.is_some()),
        ("self_heating", laws.self_heating.is_some(), "traction", laws.traction.is_some()),
    ] {
        if present && !has {
            judge.refuse(&at(field), format!("needs '{needs}' beside it"))?;
        }
    }
    Ok(())
}
