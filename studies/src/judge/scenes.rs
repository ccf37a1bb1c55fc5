//! Plausible scenes drawn at random: what an engineer would set up, log-uniform over the ranges that are in use. Nothing of
//! the library has been tuned to them.
//!
//! Ranges: radial load 50 N to 40 kN, 100 to 12 000 rpm, viscosity 5 to 300 mPa s, layers of grease 0.1 to 200 um, roughness
//! 0.03 to 2 um, friction 0.02 to 0.2; loads swing at 10 Hz to 1 MHz, speeds
//! at 10 Hz to 1 kHz.

use crate::random::Random;
use serde_json::{Value, json};
use std::f64::consts::TAU;

/// Steel and brass.
pub(super) fn materials() -> Value {
    json!({
        "steel": {"young_modulus": 206e9, "poisson_ratio": 0.30,
            "thermal": {"conductivity": 46.0, "density": 7830.0, "specific_heat": 460.0}},
        "brass": {"young_modulus": 103e9, "poisson_ratio": 0.34,
            "thermal": {"conductivity": 110.0, "density": 8500.0, "specific_heat": 380.0}}
    })
}

/// Draws with named distributions.
pub(super) struct Draw(pub(super) Random);

impl Draw {
    /// Oil of any viscosity.
    pub(super) fn oil(&mut self) -> Value {
        json!({
            "viscosity": self.viscosity(), "pressure_viscosity": self.log(1e-8, 3e-8), "temperature_viscosity": 0.04,
            "conductivity": 0.13, "eyring_stress": self.log(2e6, 8e6), "shear_modulus": 0.3e9
        })
    }

    /// A coordinate of a ring of this size (m or rad): two times of `of` held, once moved, else free.
    pub(super) fn coordinate(&mut self, size: f64, of: usize) -> Value {
        match self.0.index(of) {
            0 | 1 => json!({"held": size * self.within(-1.0, 1.0)}),
            2 => {
                let [mean, amplitude] = [size, 0.3 * size].map(|size| size * self.within(-0.5, 0.5));
                let (frequency, phase) = (self.log(5.0, 500.0), self.angle());
                let sine =
                    json!({"mean": mean, "amplitude": amplitude, "frequency": frequency, "phase": phase});
                json!({"prescribed": {"sine": sine}})
            }
            _ => json!("free"),
        }
    }

    /// Log-uniform.
    pub(super) fn log(&mut self, low: f64, high: f64) -> f64 {
        self.0.within(low.ln(), high.ln()).exp()
    }

    pub(super) fn within(&mut self, low: f64, high: f64) -> f64 {
        self.0.within(low, high)
    }

    pub(super) fn chance(&mut self, probability: f64) -> bool {
        self.0.chance(probability)
    }

    pub(super) fn angle(&mut self) -> f64 {
        self.within(0.0, TAU)
    }

    /// A value that most often is constant, else jumps, grows, follows a table or swings by up to all of `mean` at up to `fastest`
    /// Hz, within `duration` s.
    pub(super) fn signal(&mut self, mean: f64, duration: f64, fastest: f64) -> Value {
        let at = self.within(0.1, 0.6) * duration;
        match self.0.index(10) {
            0 => json!({"step": {"before": mean, "after": mean * self.within(0.0, 2.0), "time": at}}),
            1 => {
                let (end, to) = (at + self.log(1e-5, 0.3 * duration), mean * self.within(0.0, 2.0));
                json!({"ramp": {"from": mean, "to": to, "start": at, "end": end}})
            }
            2 => {
                let (gap, n) = (self.log(1e-5, 1e-2), 2 + self.0.index(30));
                let time: Vec<f64> = (0..n).map(|i| at + gap * i as f64).collect();
                let value: Vec<f64> = (0..n).map(|_| mean * self.within(0.5, 1.5)).collect();
                json!({"table": {"time": time, "value": value}})
            }
            3 | 4 => {
                let (amplitude, frequency) = (mean * self.log(0.01, 1.0), self.log(10.0, fastest));
                let phase = self.angle();
                json!({"sine": {"mean": mean, "amplitude": amplitude, "frequency": frequency, "phase": phase}})
            }
            _ => json!({"constant": mean}),
        }
    }

    pub(super) fn friction(&mut self) -> Value {
        json!({"coefficient": self.log(0.02, 0.2), "transition_speed": self.log(5e-3, 0.1)})
    }

    /// Spring and damper against a body of `mass` kg, 1 to 50 percent of critical damping.
    pub(super) fn solid(&mut self, mass: f64) -> Value {
        let stiffness = self.log(1e5, 3e7);
        let critical = 2.0 * (stiffness * mass).sqrt();
        let softening = self.log(1e-7, 3e-6);
        let mut contact = json!({
            "stiffness": stiffness, "damping": critical * self.log(0.01, 0.5), "softening_depth": softening
        });
        if self.chance(0.8) {
            contact["friction"] = self.friction();
        }
        contact
    }

    /// Laws of a lubricated line contact with this damping, s.
    pub(super) fn line(&mut self, [shortest, longest]: [f64; 2]) -> Value {
        let mut laws = json!({
            "damping": {"relaxation_time": self.log(shortest, longest), "softening_depth": 10e-9},
            "film": "pan_hamrock", "traction": "muraki_kimura",
        });
        if self.chance(0.7) {
            laws["thermal_correction"] = json!(if self.chance(0.5) { "gupta" } else { "ghosh_pandey" });
        }
        if self.chance(0.7) {
            laws["self_heating"] = json!("film_and_flash");
        }
        if self.chance(0.8) {
            let mut friction = self.friction();
            friction["roughness"] = json!(self.log(0.03e-6, 2e-6));
            friction["lambda_boundary"] = json!(0.06);
            friction["lambda_full"] = json!(3.0);
            laws["boundary_friction"] = friction;
        }
        laws
    }

    pub(super) fn viscosity(&mut self) -> Value {
        if self.chance(0.5) {
            return json!({"constant": self.log(0.005, 0.3)});
        }
        let (cold, ratio) = (self.log(30e-6, 300e-6), self.log(0.05, 0.2));
        let temperature = self.within(293.0, 373.0);
        json!({"walther": {
            "cold": {"temperature": 313.15, "kinematic_viscosity": cold},
            "hot": {"temperature": 373.15, "kinematic_viscosity": ratio * cold},
            "density": 880.0, "temperature": {"over_time": {"constant": temperature}}
        }})
    }

    /// What thickens the oil of a grease.
    pub(super) fn grease(&mut self) -> Value {
        if self.chance(0.5) {
            json!({"soap": {
                "yield_stress": self.log(30.0, 1e3), "consistency": self.log(2.0, 50.0), "exponent": self.within(0.3, 0.6)
            }})
        } else {
            json!({"polymer": {
                "plateau": self.within(0.3, 0.8), "relaxation_time": self.log(1e-7, 1e-5), "exponent": self.within(0.5, 0.9)
            }})
        }
    }

    /// Guide of a cage of `mass` kg at the radius `radius` m with at least the diametral clearance `least` m, land of `width` m;
    /// none now and then.
    pub(super) fn guide(&mut self, ring: &str, radius: f64, least: f64, width: f64, mass: f64) -> Value {
        let kind = self.0.index(8);
        if kind == 0 {
            return Value::Null;
        }
        let clearance = (radius * self.log(2e-3, 1e-2)).max(least);
        let mut guide = json!({"ring": ring, "guide_radius": radius, "diametral_clearance": clearance});
        let film = match kind {
            1 => Value::Null,
            2 | 3 => json!({"short_bearing": {"land_width": width, "squeeze": true}}),
            _ => {
                let thickness = self.log(0.1e-6, 200e-6).min(0.9 * clearance);
                json!({"lubricant_layer": {"land_width": width, "thickness": thickness}})
            }
        };
        let filled = kind == 2 || kind == 3;
        if !filled || self.chance(0.5) {
            guide["solid"] = json!({"contact": self.solid(mass)});
            if self.chance(0.3) {
                guide["solid"]["asperity_height"] = json!(self.log(0.1e-6, 5e-6));
            }
            if !film.is_null() {
                guide["film_share"] = json!({"roughness": self.log(0.03e-6, 2e-6)});
            }
        }
        if !film.is_null() {
            if self.chance(0.1) {
                let amplitude = self.log(0.01, 0.3) * 0.5 * clearance;
                guide["roundness"] =
                    json!([{"order": 2 + self.0.index(6), "amplitude": amplitude, "phase": self.angle()}]);
            }
            guide["film"] = film;
        }
        guide
    }

    /// Pocket of one of both kinds around an element of `radius` m, with `free` m between neighbours.
    pub(super) fn pocket(&mut self, radius: f64, free: f64, mass: f64) -> Value {
        let clearance = (radius * self.log(2e-3, 5e-2)).min(0.6 * free);
        if self.chance(0.5) {
            let contact = self.solid(mass);
            return json!({"solid_plane": {"diametral_clearance": 2.0 * clearance, "contact": contact}});
        }
        json!({"lubricated_cylinder": {
            "radial_clearance": clearance, "half_angle": self.within(0.2, 0.7), "edge_blend": 0.02,
            "edge_friction": self.friction(), "contact": self.line([5e-7, 5e-6])
        }})
    }

    /// Cage around elements of `radius` m on the circle of `pitch` m, with `free` m between neighbours; among rollers if the inner
    /// ring has a clearance.
    fn cage(&mut self, [radius, pitch, free]: [f64; 3], clearance: Option<f64>, duration: f64) -> Value {
        let rollers = clearance.is_some();
        let mass = self.log(0.3, 3.0) * 7e3 * pitch * radius * radius;
        let inner = self.chance(0.4);
        let place = if inner { pitch - 0.35 * radius } else { pitch + 0.35 * radius };
        let ring = if inner { "inner_ring" } else { "outer_ring" };
        let width = radius * self.log(0.2, 2.0);
        // An inner ring that is pressed down by its clearance must not meet the cage there.
        let least = clearance.filter(|_| inner).map_or(0.0, |clearance| 1.5 * clearance + 60e-6);
        let mut cage = json!({
            "mass": mass, "inertia": 0.9 * mass * pitch * pitch, "material": "brass",
            "pocket": self.pocket(radius, free, mass), "guide": self.guide(ring, place, least, width, mass)
        });
        // Only rollers in cylindrical pockets hold a cage by themselves.
        let held = rollers && cage["pocket"]["lubricated_cylinder"].is_object();
        if !held && cage["guide"].is_null() {
            let place = pitch + 0.35 * radius;
            cage["guide"] = json!({
                "ring": "outer_ring", "guide_radius": place, "diametral_clearance": 5e-3 * place,
                "solid": {"contact": self.solid(mass)}
            });
        }
        if self.chance(0.5) {
            let (eccentricity, angle) = (self.log(1e-6, 1e-4), self.angle());
            cage["mass_eccentricity"] =
                json!({"y": eccentricity * angle.cos(), "z": eccentricity * angle.sin()});
        }
        if self.chance(0.2) {
            let size = mass * self.log(1.0, 300.0);
            cage["load"] = json!({"force_z": self.signal(size, duration, 1e6)});
        }
        cage
    }
}

/// A scene of `duration` s for this number, the same on every machine.
pub fn scene(number: u64, duration: f64) -> Value {
    let mut draw = Draw(Random::new(number.wrapping_mul(0x5851_f42d_4c95_7f2d).wrapping_add(1)));
    let rollers = draw.chance(0.6);
    let (radius, count) = (draw.log(2.5e-3, 12e-3), 9 + draw.0.index(16));
    let spacing = (std::f64::consts::PI / count as f64).sin();
    let pitch = radius / (draw.within(0.6, 0.88) * spacing);
    let free = pitch * spacing - radius;
    let speed = draw.log(100.0, 12e3) * TAU / 60.0 * if draw.chance(0.5) { 1.0 } else { -1.0 };
    let speed =
        if draw.chance(0.85) { json!({"constant": speed}) } else { draw.signal(speed, duration, 1e3) };
    let mut scene = json!({
        "schema": "cagedyn.scene/1", "title": format!("random scene {number}"),
        "gravity": {"y": 0.0, "z": -9.80665},
        "materials": materials(),
        "lubricant": draw.oil(),
        "inner_ring": {"speed": speed},
        "record": {"duration": duration, "interval": 1e-4}
    });
    let clearance = draw.log(5e-6, 120e-6);
    let caged = !rollers || draw.chance(0.95);
    if caged {
        scene["cage"] = draw.cage([radius, pitch, free], rollers.then_some(clearance), duration);
    }
    let length = radius * draw.within(1.8, 3.0);
    if rollers {
        let mass = 7800.0 * std::f64::consts::PI * radius * radius * length;
        scene["rollers"] = json!({
            "count": count, "radius": radius, "effective_length": 0.95 * length, "mass": mass,
            "inertia": 0.5 * mass * radius * radius, "material": "steel"
        });
        scene["outer_ring"] =
            json!({"raceway_radius": pitch + radius + 0.25 * clearance, "material": "steel"});
        scene["inner_ring"]["radial_clearance"] = json!(clearance);
        scene["inner_ring"]["material"] = json!("steel");
        // What is usual for the size: at most some 1.5 kN per mm of all rollers.
        let load = draw.log(50.0, 40e3).min(0.3e6 * length * count as f64);
        let support = if draw.chance(0.8) { json!(draw.log(100.0, 1e4)) } else { Value::Null };
        scene["inner_ring"]["motion"] = json!({"free": {
            "mass": draw.log(0.5, 20.0), "support_damping": support,
            "load": {"y": {"constant": 0.0}, "z": draw.signal(-load, duration, 1e6)}
        }});
        scene["raceways"] = json!({"contact": draw.line([2e-7, 2e-6])});
        if draw.chance(0.7) {
            scene["raceways"]["rolling_resistance"] = json!({"extent": "all"});
        }
        scene["initial"] = json!({"inner_ring": "equilibrium"});
    } else {
        let contact_angle = draw.within(0.0, 0.6);
        scene["kinematic_elements"] = json!({
            "count": count, "radius": radius, "pitch_radius": pitch,
            "motion": {"rolling": {"contact_angle": contact_angle}}
        });
        if scene["cage"]["pocket"]["lubricated_cylinder"].is_object() {
            scene["kinematic_elements"]["material"] = json!("steel");
            scene["kinematic_elements"]["effective_length"] = json!(0.95 * length);
        }
    }
    scene
}
