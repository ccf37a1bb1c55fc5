//! Scenes of the study, with what is changed in them and how long they are followed.

use crate::statistics::methods::{Method, leapfrog, library};
use cagedyn::{Error, Model, Result, Scene, Sim, Status};
use serde_json::{Value, json};
use std::path::Path;
use std::sync::Arc;

/// Turn of the first element from one start to the next, rad.
const START_TURN: f64 = 1e-3;

/// A scene and its runs.
pub struct Case {
    /// Name, for headings.
    pub name: &'static str,
    /// Name of the scene file without its extension.
    pub scene: &'static str,
    /// Values by path, as in `--set`.
    pub set: &'static [(&'static str, &'static str)],
    /// Time that is left out, s.
    pub settling: f64,
    /// Time over which statistics are taken, s.
    pub window: f64,
    /// Time between records, s.
    pub interval: f64,
    /// Runs of the costly methods, each with another start.
    pub runs: usize,
    /// Tolerance of the reference methods, in units of the state scales.
    pub tolerance: f64,
    /// Methods for this case alone.
    pub more: &'static [Method],
}

impl Case {
    /// Text of the scene file.
    ///
    /// # Errors
    /// [`Status::File`].
    pub fn text(&self, folder: &Path) -> Result<String> {
        let path = folder.join(format!("{}.json", self.scene));
        std::fs::read_to_string(&path)
            .map_err(|e| Error::new(Status::File, format!("{}: {e}", path.display())))
    }

    /// The `k`-th start, integrated by a method of the library as in `solver.method`, or by the scene's own.
    ///
    /// # Errors
    /// Those of scene and model.
    pub fn sim(&self, text: &str, method: Option<&Value>, k: usize) -> Result<Sim> {
        let solver = method.map(|method| json!({"method": method}).to_string());
        let solver = solver.iter().map(|value| ("solver", value.as_str()));
        let mut scene = Scene::from_json_with(text, self.set.iter().copied().chain(solver))?;
        scene.initial.first_roller_angle += START_TURN * k as f64;
        Sim::new(Arc::new(Model::new(scene)?))
    }

    /// Times of the records, s.
    pub fn times(&self) -> Vec<f64> {
        let records = (self.window / self.interval).round() as u32;
        (0..=records).map(|i| self.settling + self.interval * f64::from(i)).collect()
    }
}

/// The example as it is; the other roller bearings differ from it in `set`.
pub const NU2310: Case = Case {
    name: "NU2310",
    scene: "nu2310",
    set: &[],
    settling: 0.06,
    window: 0.2,
    interval: 1e-4,
    runs: 5,
    tolerance: 1e-5,
    more: &[],
};

/// A cage among elements of prescribed motion. Its whirl is steady and scatters little, so the reference is tight.
const WHIRL: Case = Case {
    settling: 0.05,
    window: 0.05,
    runs: 5,
    tolerance: 1e-8,
    more: &[library("Dormand-Prince 1e-5", |_| json!({"dormand_prince": {"tolerance": 1e-5}}))],
    ..NU2310
};

/// All cases.
pub const CASES: [Case; 8] = [
    NU2310,
    Case { name: "5 um", set: &[("inner_ring.radial_clearance", "5e-6")], ..NU2310 },
    Case {
        name: "40 kN",
        set: &[("inner_ring.motion.free.load.z.constant", "-40e3")],
        window: 0.12,
        runs: 4,
        ..NU2310
    },
    Case {
        name: "1000 rpm",
        set: &[("inner_ring.speed.constant", "-104.71975511965977")],
        settling: 0.1,
        runs: 4,
        ..NU2310
    },
    Case {
        name: "20 000 rpm",
        set: &[("inner_ring.speed.constant", "-2094.3951023931954")],
        window: 0.12,
        ..NU2310
    },
    Case {
        name: "undamped",
        set: &[
            ("raceways.contact.damping", "null"),
            ("cage.pocket.lubricated_cylinder.contact.damping", "null"),
        ],
        window: 0.12,
        more: &[leapfrog("leapfrog 1/8", 0.125)],
        ..NU2310
    },
    Case { name: "grease guide", scene: "grease_guide", ..WHIRL },
    Case {
        name: "ball bearing",
        scene: "ball_short_bearing",
        // In the oil of the scene the cage comes to rest.
        set: &[("lubricant.viscosity.constant", "0.001")],
        ..WHIRL
    },
];
