//! What a scene may say and rarely means.

use crate::scalar::math;
use crate::scene::check::{Range, range, shown, slip_hint};
use crate::scene::{RingMotion, Scene, Signal, Viscosity};
use std::f64::consts::TAU;

/// Speed times pitch diameter above which only special bearings run, m/min: a million mm/min.
const FASTEST: f64 = 1e3;
/// Load over count, length and diameter of the rollers, Pa: that of the static load rating of roller bearings, about.
const HEAVIEST: f64 = 40e6;
/// Viscosity above which oil hardly flows, Pa s.
const THICKEST: f64 = 2.0;
/// Largest acceleration of gravity that is meant on earth, m/s^2.
const HEAVY: f64 = 20.0;
/// Largest angle that is meant in rad.
const TURN: f64 = TAU + 1e-6;
/// Radial internal clearance above which a bearing rattles, relative to the pitch radius.
const LOOSEST: f64 = 4e-3;

impl Scene {
    /// Values that are legal and unlikely, one line for each: JSON path, value, why, and the unit that may have been meant.
    pub fn warnings(&self) -> Vec<String> {
        let mut list = Vec::new();
        let diameter = 2.0 * self.pitch_radius();
        let outer_speed = self.outer_ring.as_ref().and_then(|ring| ring.speed.as_ref());
        for (path, signal) in [
            ("inner_ring.speed", self.inner_ring.as_ref().map(|ring| &ring.speed)),
            ("outer_ring.speed", outer_speed),
        ] {
            let fastest = FASTEST / 60.0 * TAU / diameter;
            let speed = signal.map_or(0.0, Signal::largest);
            if speed > fastest {
                let why = format!(
                    "more than {} rad/s, which only special bearings of this size reach",
                    shown(fastest)
                );
                list.push(unlikely(path, speed, range(0.0, fastest, "rad/s"), &why));
            }
        }
        if let (Some(rollers), Some(RingMotion::Free(ring))) =
            (&self.rollers, self.inner_ring.as_ref().map(|ring| &ring.motion))
        {
            let load = ring.load.as_ref().map_or(0.0, |load| math::hypot(load.y.largest(), load.z.largest()));
            let rating =
                HEAVIEST * f64::from(rollers.count) * rollers.effective_length * 2.0 * rollers.radius;
            if load > rating {
                let why = format!("beyond what such a bearing carries at rest, about {} N", shown(rating));
                list.push(unlikely("inner_ring.motion.free.load", load, range(0.0, rating, "N"), &why));
            }
        }
        let clearance = self.inner_ring.as_ref().and_then(|ring| ring.radial_clearance).unwrap_or(0.0);
        if clearance > LOOSEST * self.pitch_radius() {
            list.push(format!(
                "inner_ring.radial_clearance: {} m is unusually large for this size; it is the radial, not the axial one",
                shown(clearance)
            ));
        }
        if let Some(Viscosity::Constant(viscosity)) = self.lubricant.as_ref().map(|l| &l.viscosity)
            && *viscosity > THICKEST
        {
            let usual = range(1e-3, THICKEST, "Pa s");
            list.push(unlikely("lubricant.viscosity", *viscosity, usual, "thicker than honey"));
        }
        if let Some(gravity) = self.gravity.filter(|g| math::hypot(g.y, g.z) > HEAVY) {
            let size = math::hypot(gravity.y, gravity.z);
            list.push(format!("gravity: {} m/s^2 is more than twice that of the earth", shown(size)));
        }
        let harmonics =
            self.cage.iter().filter_map(|cage| cage.guide.as_ref()).flat_map(|guide| &guide.roundness);
        let phases = harmonics.enumerate().map(|(i, a)| (format!("cage.guide.roundness.{i}.phase"), a.phase));
        let angles =
            phases.chain([("initial.first_roller_angle".to_owned(), self.initial.first_roller_angle)]);
        for (path, angle) in angles.filter(|(_, angle)| angle.abs() > TURN) {
            list.push(unlikely(&path, angle, range(-TURN, TURN, "rad"), "more than a turn"));
        }
        let inner = self.inner_ring.as_ref().map_or(f64::INFINITY, |ring| ring.speed.largest());
        let ring = inner.max(outer_speed.map_or(0.0, Signal::largest));
        if let Some(speed) = self.initial.cage_speed.filter(|speed| speed.abs() > 1.5 * ring && *speed != 0.0)
        {
            let usual = range(-1.5 * ring, 1.5 * ring, "rad/s");
            list.push(unlikely("initial.cage_speed", speed, usual, "more than the ring has"));
        }
        list
    }
}

/// The line for a value outside `usual`, in the unit of that range.
fn unlikely(path: &str, value: f64, usual: Range, why: &str) -> String {
    format!("{path}: {} {} is {why}{}", shown(value), usual.unit, slip_hint(value, usual))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn unlikely_values_are_named_with_the_unit_that_was_meant() {
        let text = include_str!("../../../scenes/nu2310.json");
        let warnings = |set: &[(&str, &str)]| {
            Scene::from_json_with(text, set.iter().copied()).unwrap_or_else(|e| panic!("{e}")).warnings()
        };
        assert_eq!(warnings(&[]), [""; 0]);
        for (path, value, unit) in [
            ("inner_ring.speed.constant", "-3000", "revolutions per minute, 314.159 rad/s"),
            ("gravity.z", "-9810", "twice that of the earth"),
            ("initial.first_roller_angle", "90", "degrees, 1.5708 rad"),
            ("initial.cage_speed", "-1360", "revolutions per minute"),
            ("inner_ring.motion.free.load.z.constant", "-1e6", "beyond what such a bearing carries"),
            ("lubricant.viscosity.constant", "40", "millipascal seconds"),
        ] {
            let list = warnings(&[(path, value)]);
            let start = path.trim_end_matches(".constant").trim_end_matches(".z");
            assert!(list.len() == 1 && list[0].starts_with(start) && list[0].contains(unit), "{list:?}");
        }
        assert_eq!(warnings(&[("inner_ring.radial_clearance", "3e-4")]).len(), 1);
    }
}
