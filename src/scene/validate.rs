//! Checks of a parsed scene: ranges, geometry that can exist, references between its parts.
//!
//! The ranges are wide for engineering and narrow for unit slips. What a law needs from other parts of the scene is
//! checked where the law is built, in the model.

use super::check::{Range, bad, number, optional, range};
use super::*;
use std::f64::consts::{FRAC_PI_2, PI};

const RADIUS: Range = range(1e-4, 5.0, "m");
const WIDTH: Range = range(1e-5, 5.0, "m");
const ROLLER_CLEARANCE: Range = range(-2e-4, 2e-3, "m");
const POCKET_CLEARANCE: Range = range(1e-7, 1e-2, "m");
const GUIDE_CLEARANCE: Range = range(1e-6, 1e-2, "m");
const POSITION: Range = range(-1e-2, 1e-2, "m");
const MASS: Range = range(1e-7, 1e6, "kg");
const INERTIA: Range = range(1e-15, 1e6, "kg m^2");
const SPEED: Range = range(-1e5, 1e5, "rad/s");
const FORCE: Range = range(-1e9, 1e9, "N");
const GRAVITY: Range = range(-1e4, 1e4, "m/s^2");
const SUPPORT_DAMPING: Range = range(0.0, 1e9, "N s/m");
const ANGLE: Range = range(-1e3, 1e3, "rad");
const TIME: Range = range(0.0, 1e6, "s");
const COEFFICIENT: Range = range(0.0, 2.0, "");
const TRANSITION_SPEED: Range = range(1e-6, 10.0, "m/s");
const MAX_ROLLERS: u32 = 1000;
const MAX_HARMONICS: usize = 64;
const MAX_ORDER: u32 = 200;
const MAX_POINTS: usize = 1_000_000;
const MAX_RECORDS: f64 = 1e8;

impl Scene {
    /// Checks every value and the geometry.
    ///
    /// # Errors
    /// [`Status::BadScene`]; the message starts with the JSON path.
    pub fn validate(&self) -> Result<()> {
        if self.schema != SCENE_SCHEMA {
            return Err(bad("schema", format!("'{}' is not '{SCENE_SCHEMA}'", self.schema)));
        }
        if let Some(g) = &self.gravity {
            vector("gravity", g, GRAVITY)?;
        }
        for (name, material) in &self.materials {
            material.validate(&format!("materials.{name}"))?;
        }
        if let Some(lubricant) = &self.lubricant {
            lubricant.validate()?;
        }
        self.validate_bodies()?;
        self.validate_geometry()?;
        contact("raceways.contact", &self.raceways.contact)?;
        if let Some(RollingResistance { extent: Extent::Loaded { threshold } }) =
            self.raceways.rolling_resistance
        {
            let path = "raceways.rolling_resistance.extent.loaded.threshold";
            number(path, threshold, range(1e-6, 1e9, "N"))?;
        }
        if let Some(cage) = &self.cage {
            self.validate_cage(cage)?;
        }
        self.validate_run()
    }

    fn validate_bodies(&self) -> Result<()> {
        let r = &self.rollers;
        if !(1..=MAX_ROLLERS).contains(&r.count) {
            return Err(bad("rollers.count", format!("{} is not within 1 to {MAX_ROLLERS}", r.count)));
        }
        number("rollers.radius", r.radius, RADIUS)?;
        number("rollers.effective_length", r.effective_length, WIDTH)?;
        number("rollers.mass", r.mass, MASS)?;
        let ring = r.mass * r.radius * r.radius;
        number("rollers.inertia", r.inertia, range(0.2 * ring, 1.1 * ring, "kg m^2"))?;
        self.material_exists("rollers.material", &r.material)?;
        number("outer_ring.raceway_radius", self.outer_ring.raceway_radius, RADIUS)?;
        self.material_exists("outer_ring.material", &self.outer_ring.material)?;
        let inner = &self.inner_ring;
        number("inner_ring.radial_clearance", inner.radial_clearance, ROLLER_CLEARANCE)?;
        self.material_exists("inner_ring.material", &inner.material)?;
        signal("inner_ring.speed", &inner.speed, SPEED)?;
        match &inner.motion {
            RingMotion::Fixed(position) => vector("inner_ring.motion.fixed", position, POSITION),
            RingMotion::Free(ring) => {
                number("inner_ring.motion.free.mass", ring.mass, MASS)?;
                let path = "inner_ring.motion.free.support_damping";
                optional(path, ring.support_damping, SUPPORT_DAMPING)?;
                if let Some(load) = &ring.load {
                    signal("inner_ring.motion.free.load.y", &load.y, FORCE)?;
                    signal("inner_ring.motion.free.load.z", &load.z, FORCE)?;
                }
                Ok(())
            }
        }
    }

    fn validate_geometry(&self) -> Result<()> {
        let (outer, radius) = (self.outer_ring.raceway_radius, self.rollers.radius);
        let clearance = self.inner_ring.radial_clearance;
        if clearance > 0.2 * radius {
            let text = format!("{clearance:?} m is more than a fifth of the roller radius {radius:?} m");
            return Err(bad("inner_ring.radial_clearance", text));
        }
        let inner = outer - 2.0 * radius - clearance / 2.0;
        if inner < 0.1 * radius {
            let text = format!(
                "{outer:?} m leaves no room for the inner ring (its raceway radius would be {inner:?} m)"
            );
            return Err(bad("outer_ring.raceway_radius", text));
        }
        if self.initial.inner_ring == RingStart::Equilibrium
            && matches!(self.inner_ring.motion, RingMotion::Fixed(_))
        {
            let text = "'equilibrium' needs a free inner ring; write 'centred' for a fixed one";
            return Err(bad("initial.inner_ring", text));
        }
        self.neighbours_apart("rollers.count", radius, "rollers")
    }

    /// Distance between neighbouring centres must exceed twice `radius`.
    fn neighbours_apart(&self, path: &str, radius: f64, what: &str) -> Result<()> {
        let count = self.rollers.count;
        let spacing = 2.0 * self.pitch_radius() * (PI / f64::from(count)).sin();
        if count > 1 && spacing <= 2.0 * radius {
            let text = format!(
                "{count} {what} of radius {radius:?} m overlap on a pitch circle of radius {:?} m",
                self.pitch_radius()
            );
            return Err(bad(path, text));
        }
        Ok(())
    }

    /// Mean of the raceway radii, m.
    pub fn pitch_radius(&self) -> f64 {
        self.outer_ring.raceway_radius - self.rollers.radius - self.inner_ring.radial_clearance / 4.0
    }

    fn validate_cage(&self, cage: &Cage) -> Result<()> {
        number("cage.mass", cage.mass, MASS)?;
        number("cage.inertia", cage.inertia, INERTIA)?;
        let ring = cage.mass * self.pitch_radius().powi(2);
        number("cage.inertia", cage.inertia, range(0.05 * ring, 5.0 * ring, "kg m^2"))?;
        self.material_exists("cage.material", &cage.material)?;
        vector("initial.cage", &self.initial.cage, POSITION)?;
        if let Some(pocket) = &cage.pocket {
            self.validate_pocket(pocket)?;
        }
        if let Some(Guide::ShortBearing(guide)) = &cage.guide {
            self.validate_short_bearing("cage.guide.short_bearing", guide)?;
        }
        Ok(())
    }

    fn validate_pocket(&self, pocket: &Pocket) -> Result<()> {
        number("cage.pocket.radial_clearance", pocket.radial_clearance, POCKET_CLEARANCE)?;
        number("cage.pocket.half_angle", pocket.half_angle, range(1e-3, FRAC_PI_2 - 1e-3, "rad"))?;
        number("cage.pocket.edge_blend", pocket.edge_blend, range(0.0, pocket.half_angle, "rad"))?;
        if let Some(friction) = &pocket.edge_friction {
            let path = "cage.pocket.edge_friction";
            number(&format!("{path}.coefficient"), friction.coefficient, COEFFICIENT)?;
            number(&format!("{path}.transition_speed"), friction.transition_speed, TRANSITION_SPEED)?;
        }
        contact("cage.pocket.contact", &pocket.contact)?;
        let radius = self.rollers.radius + pocket.radial_clearance;
        // Rollers start beside each other in their pockets; radially, the edges must not reach into them.
        let edge = radius * pocket.half_angle.sin();
        let discriminant = edge * edge - (radius * radius - self.rollers.radius * self.rollers.radius);
        let start = self.initial.cage.y.hypot(self.initial.cage.z);
        if discriminant > 0.0 && start > edge - discriminant.sqrt() {
            let text = format!(
                "the centre {start:?} m off pushes pocket edges into rollers; at most {:e} m",
                edge - discriminant.sqrt()
            );
            return Err(bad("initial.cage", text));
        }
        self.neighbours_apart("cage.pocket.radial_clearance", radius, "pockets")
    }

    fn validate_short_bearing(&self, path: &str, guide: &ShortBearingGuide) -> Result<()> {
        let at = |field: &str| format!("{path}.{field}");
        let outer = self.outer_ring.raceway_radius;
        number(&at("guide_radius"), guide.guide_radius, range(0.5 * outer, 1.5 * outer, "m"))?;
        number(&at("diametral_clearance"), guide.diametral_clearance, GUIDE_CLEARANCE)?;
        if guide.diametral_clearance > 0.1 * guide.guide_radius {
            let text = format!(
                "{:?} m is more than a tenth of the guide radius {:?} m; the short bearing needs a thin film",
                guide.diametral_clearance, guide.guide_radius
            );
            return Err(bad(&at("diametral_clearance"), text));
        }
        number(&at("land_width"), guide.land_width, WIDTH)?;
        if guide.roundness.len() > MAX_HARMONICS {
            let text = format!("{} harmonics, at most {MAX_HARMONICS}", guide.roundness.len());
            return Err(bad(&at("roundness"), text));
        }
        let clearance = guide.diametral_clearance / 2.0;
        for (i, a) in guide.roundness.iter().enumerate() {
            let at = |field: &str| format!("{path}.roundness.{i}.{field}");
            if !(2..=MAX_ORDER).contains(&a.order) {
                let text = format!("{} is not within 2 to {MAX_ORDER} (order 1 is eccentricity)", a.order);
                return Err(bad(&at("order"), text));
            }
            number(&at("amplitude"), a.amplitude, range(-clearance, clearance, "m"))?;
            number(&at("phase"), a.phase, ANGLE)?;
        }
        let roundness: f64 = guide.roundness.iter().map(|a| a.amplitude.abs()).sum();
        if roundness >= clearance {
            let text = format!(
                "the amplitudes add up to {roundness:?} m and close the radial clearance {clearance:?} m"
            );
            return Err(bad(&at("roundness"), text));
        }
        let start = self.initial.cage.y.hypot(self.initial.cage.z);
        if start >= clearance - roundness {
            let text = format!(
                "the centre {start:?} m off leaves no film in the radial guide clearance of {clearance:?} m"
            );
            return Err(bad("initial.cage", text));
        }
        Ok(())
    }

    fn validate_run(&self) -> Result<()> {
        if self.cage.is_none() && self.initial.cage != PlaneVector::default() {
            return Err(bad("initial.cage", "there is no cage to place"));
        }
        number("initial.first_roller_angle", self.initial.first_roller_angle, ANGLE)?;
        number("solver.min_step", self.solver.min_step, range(1e-18, 1e-6, "s"))?;
        match &self.solver.method {
            Method::Leapfrog(m) => {
                let allowed = range(self.solver.min_step.max(1e-10), 1e-3, "s");
                optional("solver.method.leapfrog.step", m.step, allowed)?;
            }
            Method::DormandPrince(m) => {
                number("solver.method.dormand_prince.tolerance", m.tolerance, range(1e-12, 1e-1, ""))?;
            }
        }
        if self.solver.max_steps == 0 {
            return Err(bad("solver.max_steps", "0 is not allowed; at least 1"));
        }
        number("record.duration", self.record.duration, range(1e-9, 1e5, "s"))?;
        number("record.interval", self.record.interval, range(1e-10, self.record.duration, "s"))?;
        let records = self.record.duration / self.record.interval;
        if records > MAX_RECORDS {
            let text =
                format!("{:?} s gives {records:e} records, at most {MAX_RECORDS:e}", self.record.interval);
            return Err(bad("record.interval", text));
        }
        Ok(())
    }

    fn material_exists(&self, path: &str, name: &str) -> Result<()> {
        if self.materials.contains_key(name) {
            return Ok(());
        }
        let known: Vec<&str> = self.materials.keys().map(String::as_str).collect();
        Err(bad(path, format!("'{name}' is not one of the materials ({})", known.join(", "))))
    }
}

impl Material {
    fn validate(&self, path: &str) -> Result<()> {
        number(&format!("{path}.young_modulus"), self.young_modulus, range(1e7, 1e13, "Pa"))?;
        number(&format!("{path}.poisson_ratio"), self.poisson_ratio, range(0.0, 0.499, ""))?;
        if let Some(t) = &self.thermal {
            number(&format!("{path}.thermal.conductivity"), t.conductivity, range(1e-2, 1e4, "W/(m K)"))?;
            number(&format!("{path}.thermal.density"), t.density, range(10.0, 3e4, "kg/m^3"))?;
            number(&format!("{path}.thermal.specific_heat"), t.specific_heat, range(10.0, 1e4, "J/(kg K)"))?;
        }
        Ok(())
    }
}

impl Lubricant {
    fn validate(&self) -> Result<()> {
        number("lubricant.viscosity", self.viscosity, range(1e-5, 1e3, "Pa s"))?;
        for (name, value, allowed) in [
            ("pressure_viscosity", self.pressure_viscosity, range(1e-10, 1e-6, "1/Pa")),
            ("temperature_viscosity", self.temperature_viscosity, range(1e-4, 1.0, "1/K")),
            ("conductivity", self.conductivity, range(1e-3, 10.0, "W/(m K)")),
            ("eyring_stress", self.eyring_stress, range(1e4, 1e9, "Pa")),
            ("shear_modulus", self.shear_modulus, range(1e6, 1e12, "Pa")),
        ] {
            optional(&format!("lubricant.{name}"), value, allowed)?;
        }
        Ok(())
    }
}

fn vector(path: &str, v: &PlaneVector, allowed: Range) -> Result<()> {
    number(&format!("{path}.y"), v.y, allowed)?;
    number(&format!("{path}.z"), v.z, allowed)
}

fn contact(path: &str, laws: &ContactLaws) -> Result<()> {
    let at = |field: &str| format!("{path}.{field}");
    if let Some(d) = &laws.damping {
        number(&at("damping.relaxation_time"), d.relaxation_time, range(1e-12, 1e-3, "s"))?;
        number(&at("damping.softening_depth"), d.softening_depth, range(1e-12, 1e-4, "m"))?;
    }
    if let Some(b) = &laws.boundary_friction {
        number(&at("boundary_friction.coefficient"), b.coefficient, COEFFICIENT)?;
        number(&at("boundary_friction.transition_speed"), b.transition_speed, TRANSITION_SPEED)?;
        number(&at("boundary_friction.roughness"), b.roughness, range(1e-10, 1e-4, "m"))?;
        number(&at("boundary_friction.lambda_boundary"), b.lambda_boundary, range(0.0, 100.0, ""))?;
        let full = range(b.lambda_boundary + 1e-3, 1e3, "");
        number(&at("boundary_friction.lambda_full"), b.lambda_full, full)?;
    }
    for (field, present, needs, has) in [
        ("thermal_correction", laws.thermal_correction.is_some(), "film", laws.film.is_some()),
        ("traction", laws.traction.is_some(), "film", laws.film.is_some()),
        ("boundary_friction", laws.boundary_friction.is_some(), "film", laws.film.is_some()),
        ("self_heating", laws.self_heating.is_some(), "traction", laws.traction.is_some()),
    ] {
        if present && !has {
            return Err(bad(&at(field), format!("needs '{needs}' beside it")));
        }
    }
    Ok(())
}

fn signal(path: &str, s: &Signal, allowed: Range) -> Result<()> {
    let at = |field: &str| format!("{path}.{field}");
    match s {
        Signal::Constant(value) => number(&at("constant"), *value, allowed),
        Signal::Step { before, after, time } => {
            number(&at("step.before"), *before, allowed)?;
            number(&at("step.after"), *after, allowed)?;
            number(&at("step.time"), *time, TIME)
        }
        Signal::Ramp { from, to, start, end } => {
            number(&at("ramp.from"), *from, allowed)?;
            number(&at("ramp.to"), *to, allowed)?;
            number(&at("ramp.start"), *start, TIME)?;
            number(&at("ramp.end"), *end, TIME)?;
            if end <= start {
                return Err(bad(&at("ramp.end"), format!("{end:?} s is not after the start {start:?} s")));
            }
            Ok(())
        }
        Signal::Sine { mean, amplitude, frequency, phase } => {
            number(&at("sine.mean"), *mean, allowed)?;
            number(&at("sine.amplitude"), *amplitude, allowed)?;
            number(&at("sine.frequency"), *frequency, range(0.0, 1e6, "Hz"))?;
            number(&at("sine.phase"), *phase, ANGLE)
        }
        Signal::Table { time, value } => {
            if time.is_empty() || time.len() > MAX_POINTS {
                let text = format!("{} points, 1 to {MAX_POINTS} are allowed", time.len());
                return Err(bad(&at("table.time"), text));
            }
            if time.len() != value.len() {
                let text = format!("{} values for {} times", value.len(), time.len());
                return Err(bad(&at("table.value"), text));
            }
            for (i, (t, v)) in time.iter().zip(value).enumerate() {
                number(&at(&format!("table.time.{i}")), *t, TIME)?;
                number(&at(&format!("table.value.{i}")), *v, allowed)?;
                if i > 0 && *t <= time[i - 1] {
                    let text = format!("{t:?} s is not after {:?} s", time[i - 1]);
                    return Err(bad(&at(&format!("table.time.{i}")), text));
                }
            }
            Ok(())
        }
    }
}
