//! Checks of rings: their speeds, what moves them, and what holds them.

use super::*;

pub(crate) const POSITION: Range = range(-1e-2, 1e-2, "m");
pub(crate) const TILT: Range = range(-0.1, 0.1, "rad");
pub(super) const SUPPORT_DAMPING: Range = range(0.0, 1e9, "N s/m");
const SUPPORT_STIFFNESS: Range = range(0.0, 1e13, "N/m");
const UNBALANCE: Range = range(0.0, 1e3, "kg m");

impl Scene {
    pub(super) fn validate_inner_ring(&self, judge: Judge<'_>, inner: &InnerRing) -> Result<()> {
        signal(judge, "inner_ring.speed", &inner.speed, SPEED)?;
        if let Some(clearance) = inner.radial_clearance {
            judge.number("inner_ring.radial_clearance", clearance, ROLLER_CLEARANCE)?;
        }
        if inner.raceway_crown_radius.is_some() && self.rollers.is_none() {
            judge.refuse("inner_ring.raceway_crown_radius", "needs 'rollers', which run on it; remove it")?;
        }
        if let Some(material) = &inner.material {
            self.material_exists(judge, "inner_ring.material", material)?;
        }
        match &inner.motion {
            RingMotion::Fixed(position) => vector(judge, "inner_ring.motion.fixed", position, POSITION),
            RingMotion::Free(_) if self.rollers.is_none() => {
                judge.refuse("inner_ring.motion", "a free ring needs 'rollers' to carry it; write 'fixed'")
            }
            RingMotion::Free(ring) => free_ring(judge, "inner_ring.motion.free", ring),
            RingMotion::Prescribed(motion) => prescribed(judge, "inner_ring.motion.prescribed", motion),
            RingMotion::Space(ring) => self.validate_spatial_ring(judge, ring),
        }
    }

    pub(super) fn validate_outer_ring(&self, judge: Judge<'_>, outer: &OuterRing) -> Result<()> {
        if let Some(speed) = &outer.speed {
            signal(judge, "outer_ring.speed", speed, SPEED)?;
        }
        let Some(motion) = &outer.motion else { return Ok(()) };
        if self.rollers.as_ref().is_none_or(|rollers| rollers.space.is_some()) {
            let text =
                "needs 'rollers' that move in the plane; the outer ring of other bearings is held: remove it";
            judge.refuse("outer_ring.motion", text)?;
        }
        if self.heat.is_some() {
            judge.refuse("outer_ring.motion", "not allowed beside 'heat'; remove one of them")?;
        }
        match motion {
            OuterRingMotion::Free(ring) => free_ring(judge, "outer_ring.motion.free", ring),
            OuterRingMotion::Prescribed(motion) => prescribed(judge, "outer_ring.motion.prescribed", motion),
        }
    }
}

impl Scene {
    pub(super) fn validate_rotor(&self, judge: Judge<'_>, rotor: &Rotor) -> Result<()> {
        if self.inner_ring.is_none() {
            judge.refuse("rotor", "needs 'inner_ring', which is the end of its shaft")?;
        }
        if self.balls.is_some()
            || self.rollers.as_ref().is_some_and(|rollers| rollers.space.is_some())
            || self.has_spatial_cage()
        {
            judge.refuse("rotor", "moves in the plane; not allowed beside bodies in space: remove it")?;
        }
        if self.heat.is_some() {
            judge.refuse("rotor", "not allowed beside 'heat'; remove one of them")?;
        }
        judge.number("rotor.mass", rotor.mass, MASS)?;
        judge.number("rotor.shaft.stiffness", rotor.shaft.stiffness, range(1.0, 1e13, "N/m"))?;
        judge.optional("rotor.shaft.internal_damping", rotor.shaft.internal_damping, SUPPORT_DAMPING)?;
        judge.optional("rotor.damping", rotor.damping, SUPPORT_DAMPING)?;
        loaded(judge, "rotor", rotor.unbalance.as_ref(), rotor.load.as_ref())
    }
}

/// Checks unbalance and load of a body.
fn loaded(judge: Judge<'_>, path: &str, unbalance: Option<&Unbalance>, load: Option<&Load>) -> Result<()> {
    let at = |field: &str| format!("{path}.{field}");
    if let Some(unbalance) = unbalance {
        judge.number(&at("unbalance.moment"), unbalance.moment, UNBALANCE)?;
        judge.number(&at("unbalance.phase"), unbalance.phase, ANGLE)?;
    }
    if let Some(load) = load {
        signal(judge, &at("load.y"), &load.y, FORCE)?;
        signal(judge, &at("load.z"), &load.z, FORCE)?;
    }
    Ok(())
}

/// Checks a place over time, which must not jump.
pub(super) fn place(judge: Judge<'_>, path: &str, motion: &Signal, allowed: Range) -> Result<()> {
    signal(judge, path, motion, allowed)?;
    if let Signal::Step { .. } = motion {
        let text = "a place that jumps has no speed; write a 'ramp', 'sine' or 'table'";
        judge.refuse(&format!("{path}.step"), text)?;
    }
    Ok(())
}

fn prescribed(judge: Judge<'_>, path: &str, motion: &PlaneMotion) -> Result<()> {
    place(judge, &format!("{path}.y"), &motion.y, POSITION)?;
    place(judge, &format!("{path}.z"), &motion.z, POSITION)
}

fn free_ring(judge: Judge<'_>, path: &str, ring: &FreeRing) -> Result<()> {
    let at = |field: &str| format!("{path}.{field}");
    judge.number(&at("mass"), ring.mass, MASS)?;
    judge.optional(&at("support_damping"), ring.support_damping, SUPPORT_DAMPING)?;
    if let Some(support) = &ring.support {
        support_of_ring(judge, &at("support"), support)?;
    }
    loaded(judge, path, ring.unbalance.as_ref(), ring.load.as_ref())
}

/// Stiffness and mass must push back in every direction, damping must not drive.
fn support_of_ring(judge: Judge<'_>, path: &str, support: &Support) -> Result<()> {
    let parts = [
        ("stiffness", Some(&support.stiffness), SUPPORT_STIFFNESS),
        ("damping", support.damping.as_ref(), SUPPORT_DAMPING),
        ("mass", support.mass.as_ref(), range(0.0, MASS.max, "kg")),
    ];
    for (name, matrix, allowed) in parts.into_iter().filter_map(|(n, m, a)| Some((n, m?, a))) {
        let at = |entry: &str| format!("{path}.{name}.{entry}");
        let PlaneMatrix { yy, yz, zy, zz } = *matrix;
        judge.number(&at("yy"), yy, allowed)?;
        judge.number(&at("zz"), zz, allowed)?;
        let cross = range(-allowed.max, allowed.max, allowed.unit);
        judge.number(&at("yz"), yz, cross)?;
        judge.number(&at("zy"), zy, cross)?;
        let mean = 0.5 * (yz + zy);
        if mean * mean > yy * zz {
            let text = format!(
                "pushes in the way of a motion: the square of the mean of yz and zy, {mean:?}, is above yy zz"
            );
            judge.refuse(&format!("{path}.{name}"), text)?;
        }
        if name == "mass" && (yz - zy).abs() > 0.0 {
            judge.refuse(&at("zy"), format!("{zy:?} kg; a mass has the same yz, {yz:?} kg"))?;
        }
    }
    Ok(())
}
