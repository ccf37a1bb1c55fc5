//! Scenes, the library's methods and CVODE on them, and the distance of their ends.

use crate::common::{example, read, with};
use cagedyn::integrate::{
    DormandPrince, Driver, Limits, Linearization, Linearized, Observed, Rosenbrock, Stepper, Structure,
    Structured, System,
};
use cagedyn::model::{Fault, HostInputs, Workspace};
use cagedyn::{Model, Sim};
use cagedyn_studies::cvode::{self, Derivatives, Method, Options};
use serde_json::{Value, json};
use std::sync::Arc;

/// Largest step of methods with error control in the library, s; CVODE gets the same where it is compared with them.
pub const MAX_STEP: f64 = 1e-4;
/// The same where a bounce is shorter than that.
pub const SHORT_STEP: f64 = 2e-6;

/// A scene and how long it is followed.
pub struct Case {
    pub name: &'static str,
    pub scene: Value,
    pub duration: f64,
    /// Largest step of the reference, s: short enough to meet every contact.
    pub reference_step: f64,
    /// Largest step of all methods with error control, s.
    pub max_step: f64,
}

/// The end of a reference run, and how far another method of CVODE ends from it.
pub struct Reference {
    pub end: End,
    pub doubt: f64,
}

/// Where a run ended and what it took.
#[derive(Clone, Debug)]
pub struct End {
    pub state: Vec<f64>,
    pub steps: u64,
    pub evaluations: u64,
}

impl Case {
    pub fn sim(&self, solver: &Value) -> Sim {
        let scene = with(&self.scene, &[("solver", solver.clone())]);
        let model = Model::from_json(&scene.to_string()).unwrap_or_else(|e| panic!("{}: {e}", self.name));
        Sim::new(Arc::new(model)).unwrap_or_else(|e| panic!("{}: {e}", self.name))
    }

    pub fn run(&self, solver: &Value) -> End {
        let mut sim = self.sim(solver);
        sim.advance_to(self.duration).unwrap_or_else(|e| panic!("{}: {e}", self.name));
        let statistics = sim.statistics();
        End {
            state: sim.state().to_vec(),
            steps: statistics.driver.steps,
            evaluations: statistics.evaluations,
        }
    }

    /// A method with error control at a tolerance.
    pub fn controlled(&self, method: &str, tolerance: f64) -> End {
        self.run(&json!({"method": {method: {"tolerance": tolerance}}, "max_step": self.max_step}))
    }

    pub fn leapfrog(&self, step: f64) -> End {
        self.run(&json!({"method": {"leapfrog": {"step": step}}}))
    }

    /// CVODE with `absolute` in units of the scene's state scales.
    pub fn cvode(&self, method: Method, relative: f64, absolute: f64, max_step: f64) -> End {
        let mut sim = self.sim(&json!({}));
        let scales: Vec<f64> = sim.model().state_scales().iter().map(|s| absolute * s).collect();
        let start = sim.state().to_vec();
        let options = Options { method, relative, absolute: &scales, max_steps: 10_000_000, max_step };
        let mut rates = |t: f64, x: &[f64], rate: &mut [f64]| sim.derivative(t, x, rate).map_err(|_| ());
        let solution =
            cvode::solve(&options, 0.0, &start, &[self.duration], &mut rates, Derivatives::Quotients)
                .unwrap_or_else(|e| panic!("{}, {method:?} at {relative:e}, {absolute:e}: {e}", self.name));
        let statistics = solution.statistics;
        End {
            state: solution.states[0].clone(),
            steps: statistics.steps,
            evaluations: statistics.evaluations,
        }
    }

    pub fn reference(&self) -> Reference {
        let [end, other] =
            [Method::Bdf, Method::Adams].map(|m| self.cvode(m, 1e-12, 1e-12, self.reference_step));
        Reference { doubt: self.distance(&other, &end), end }
    }

    /// Largest difference of positions in units of the reference clearance; angles count as arcs of the pitch circle.
    pub fn distance(&self, a: &End, b: &End) -> f64 {
        let sim = self.sim(&json!({}));
        let scales = sim.model().state_scales();
        let positions = sim.model().layout().positions();
        (0..positions).map(|i| (a.state[i] - b.state[i]).abs() / scales[i]).fold(0.0, f64::max)
    }
}

pub fn scene(file: &str, changes: &[(&str, Value)]) -> Value {
    let scene: Value = serde_json::from_str(&read(file)).expect("a scene");
    with(&scene, changes)
}

const BALL: &str = "scenes/ball_short_bearing.json";
pub const DRY: &str = "dry guide";
pub const GREASED: &str = "grease guide";
pub const GREASE: &str = "scenes/grease_guide.json";

/// The cage alone in a short bearing of thick oil: smooth, and stiff.
pub fn thick() -> Case {
    let first = smooth().swap_remove(0);
    let scene = with(&first.scene, &[("lubricant.viscosity.constant", json!(1.0))]);
    Case { name: "short bearing, thick oil", scene, ..first }
}

/// The cage on its film alone: nothing touches, forces have all the derivatives that the methods need.
pub fn smooth() -> Vec<Case> {
    let start = json!({
        "cage": {"y": 0.08e-3, "z": -0.05e-3}, "cage_velocity": {"y": 0.02, "z": 0.03}, "cage_speed": 142.5
    });
    let oil = |more: &[(&str, Value)]| {
        let alone = scene(BALL, &[("cage.pocket", Value::Null), ("initial", start.clone())]);
        with(&alone, more)
    };
    let unbalance = [("cage.mass_eccentricity", json!({"y": 50e-6, "z": -20e-6}))];
    let flooded = [
        ("cage.pocket", Value::Null),
        ("cage.guide.solid", Value::Null),
        ("cage.guide.film_share", Value::Null),
        ("cage.guide.film.lubricant_layer.thickness", json!(0.5e-3)),
        ("initial", start.clone()),
    ];
    let case = |name, scene| Case { name, scene, duration: 5e-3, reference_step: 2.5e-6, max_step: MAX_STEP };
    vec![
        case("short bearing", oil(&[])),
        case("short bearing, unbalance", oil(&unbalance)),
        case("flooded guide", scene(GREASE, &flooded)),
    ]
}

/// A cage that is always pressed onto the spring of its guide and slides there to and fro: smooth, and without any
/// damping. A decay that is fast against the steps would hide the order of the error.
pub fn pressed() -> Case {
    let start = json!({"cage": {"y": 30e-6, "z": -0.22e-3}});
    let changes = [
        ("gravity.z", json!(-981.0)),
        ("cage.pocket", Value::Null),
        ("cage.guide.film", Value::Null),
        ("cage.guide.film_share", Value::Null),
        ("cage.guide.solid", json!({"contact": {"stiffness": 1e6}})),
        ("initial", start),
    ];
    let scene = scene(GREASE, &changes);
    Case { name: "pressed cage", scene, duration: 5e-3, reference_step: f64::INFINITY, max_step: MAX_STEP }
}

/// Contacts open and close: forces have kinks in their derivatives.
pub fn contacts() -> Vec<Case> {
    let falling =
        json!({"cage": {"y": 0.2e-3, "z": 0.0}, "cage_velocity": {"y": 0.05, "z": 0.1}, "cage_speed": 142.5});
    let fast = json!({
        "cage": {"y": 0.05e-3, "z": -0.03e-3}, "cage_velocity": {"y": 0.1, "z": 0.05}, "cage_speed": 160.0
    });
    let dry =
        [("cage.guide.film", Value::Null), ("cage.guide.film_share", Value::Null), ("initial", falling)];
    let cylinder = {
        let mut scene = example();
        let rollers = scene["rollers"].clone();
        for part in ["rollers", "outer_ring", "raceways"] {
            scene.as_object_mut().expect("an object").remove(part);
        }
        scene["kinematic_elements"] = json!({
            "count": 12, "radius": rollers["radius"], "pitch_radius": 39.99e-3, "material": "steel",
            "effective_length": rollers["effective_length"], "motion": {"rolling": {"contact_angle": 0.0}}
        });
        scene["inner_ring"] = json!({"speed": {"constant": -314.0}});
        scene["initial"] = json!({"cage_velocity": {"y": 0.08, "z": -0.15}});
        scene
    };
    let case = |name, scene, duration| {
        let max_step = if name == DRY { SHORT_STEP } else { MAX_STEP };
        Case { name, scene, duration, reference_step: 2.5e-7, max_step }
    };
    vec![
        case("NU2310", example(), 1e-3),
        // From 8.01 ms on the cage meets a pocket at 12 um/s: whether a step passes that is a matter of chance, with CVODE, too.
        case(GREASED, scene(GREASE, &[]), 8e-3),
        case(DRY, scene(GREASE, &dry), 2e-3),
        case("plane pockets", scene(BALL, &[("initial", fast)]), 3e-3),
        case("cylinder pockets", cylinder, 3e-3),
    ]
}

/// A scene for the library's own methods with steps of given size.
struct Fixed {
    model: Arc<Model>,
    workspace: Workspace,
    evaluations: u64,
}

impl System for Fixed {
    type Fault = Fault;
    fn positions(&self) -> usize {
        self.model.layout().positions()
    }
    fn velocities(&self) -> usize {
        self.model.layout().velocities()
    }
    fn accelerations(&mut self, t: f64, q: &[f64], v: &[f64], a: &mut [f64]) -> Result<(), Fault> {
        self.evaluations += 1;
        let inputs = self.model.inputs_at(t, &HostInputs::default());
        self.model.plane().unwrap().accelerations(&inputs, q, v, &mut self.workspace, a)
    }
    fn not_finite(&self, velocity: usize) -> Fault {
        Fault::NotFinite { velocity, contact: None }
    }
}

impl Structured<3> for Fixed {
    fn structure(&self) -> Structure<3> {
        self.model.plane().unwrap().structure()
    }
}

impl Linearized<3> for Fixed {
    fn linearize(
        &mut self,
        t: f64,
        q: &[f64],
        v: &[f64],
        a: &mut [f64],
        out: &mut Linearization<3>,
    ) -> Result<(), Fault> {
        self.accelerations(t, q, v, a)?;
        let rates = self.model.input_rates_at(t, &HostInputs::default());
        self.model.plane().unwrap().linearize(&mut self.workspace, &rates, out);
        Ok(())
    }
}

impl Observed for Fixed {}

impl Case {
    /// The end by CVODE with all the digits that it has.
    pub fn exact(&self) -> End {
        self.cvode(Method::Adams, 1e-14, 1e-14, self.reference_step)
    }

    /// One of the methods with error control, but with steps of `step` s, whatever the errors.
    pub fn fixed(&self, method: &str, step: f64) -> End {
        let sim = self.sim(&json!({}));
        let (model, start) = (sim.model().clone(), sim.state().to_vec());
        let mut system = Fixed { workspace: Workspace::new(model.plane().unwrap()), model, evaluations: 0 };
        let any = vec![f64::INFINITY; start.len()];
        let stepper: Box<dyn Stepper<Fixed> + Send> = match method {
            "rosenbrock" => Box::new(Rosenbrock::new(&system, &any)),
            _ => Box::new(DormandPrince::new(&system, &any)),
        };
        let limits = Limits { nominal_step: step, min_step: 1e-14, max_step: step, max_steps: 10_000_000 };
        let mut driver = Driver::new(stepper, limits);
        driver.start(0.0, &start);
        driver.advance(&mut system, self.duration).unwrap_or_else(|e| panic!("{}: {e:?}", self.name));
        let mut state = start;
        driver.state_at(self.duration, &mut state);
        End { state, steps: driver.statistics().steps, evaluations: system.evaluations }
    }
}
