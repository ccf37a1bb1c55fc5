//! The optional physical effects of a scene: which it has, what each adds, which are absent.

use cagedyn::Scene;
use cagedyn::scene::{ContactLaws, Extent, Guide, RingMotion};

/// An optional block of a scene.
pub struct Effect {
    /// JSON path.
    pub path: String,
    /// What it adds to the model if the scene has it.
    pub adds: Option<String>,
}

/// All optional blocks. Those inside an absent block are left out: the absent block stands for them.
pub fn effects(scene: &Scene) -> Vec<Effect> {
    let mut list = List(Vec::new());
    list.add(
        "gravity",
        scene.gravity.as_ref().map(|g| format!("weight of all bodies, ({}, {}) m/s^2", g.y, g.z)),
    );
    ring(scene, &mut list);
    contact(&scene.raceways.contact, "raceways.contact", &mut list);
    let resistance = scene.raceways.rolling_resistance.as_ref().map(|r| match r.extent {
        Extent::All => "law: rolling resistance of the film in all raceway contacts".to_owned(),
        Extent::Loaded { threshold } => {
            format!("law: rolling resistance of the film in raceway contacts above {threshold} N")
        }
    });
    list.add("raceways.rolling_resistance", resistance);
    cage(scene, &mut list);
    list.0
}

struct List(Vec<Effect>);

impl List {
    fn add(&mut self, path: impl Into<String>, adds: Option<String>) {
        self.0.push(Effect { path: path.into(), adds });
    }

    fn flag(&mut self, path: impl Into<String>, present: bool, adds: &str) {
        self.add(path, present.then(|| adds.to_owned()));
    }
}

fn ring(scene: &Scene, list: &mut List) {
    let RingMotion::Free(ring) = &scene.inner_ring.motion else {
        list.add("inner_ring.motion.free", None);
        return;
    };
    list.add(
        "inner_ring.motion.free",
        Some(format!("4 states: ring of {} kg moves in the plane", ring.mass)),
    );
    let damping = ring.support_damping.map(|d| format!("force: damper of {d} N s/m on the ring"));
    list.add("inner_ring.motion.free.support_damping", damping);
    list.flag("inner_ring.motion.free.load", ring.load.is_some(), "force: external load on the ring");
}

fn contact(laws: &ContactLaws, path: &str, list: &mut List) {
    let at = |field: &str| format!("{path}.{field}");
    let damping = laws.damping.as_ref();
    list.add(
        at("damping"),
        damping.map(|d| format!("law: normal damping, relaxation time {:e} s", d.relaxation_time)),
    );
    list.flag(at("film"), laws.film.is_some(), "law: film thickness of Pan and Hamrock");
    let law = laws.thermal_correction.map(|law| format!("law: film thickness reduced by heat ({law:?})"));
    list.add(at("thermal_correction"), law);
    list.flag(at("traction"), laws.traction.is_some(), "law: film traction of Muraki and Kimura");
    let heating = laws.self_heating.is_some();
    list.flag(at("self_heating"), heating, "law: traction falls with the temperature of the film");
    let friction = laws.boundary_friction.as_ref();
    let text = |mu: f64| format!("law: mixed and boundary friction, coefficient {mu}");
    list.add(at("boundary_friction"), friction.map(|f| text(f.coefficient)));
}

fn cage(scene: &Scene, list: &mut List) {
    let Some(cage) = &scene.cage else {
        list.add("cage", None);
        return;
    };
    list.add("cage", Some(format!("6 states: cage of {} kg moves and turns in the plane", cage.mass)));
    match &cage.pocket {
        None => list.add("cage.pocket", None),
        Some(pocket) => {
            let clearance = 1e3 * pocket.radial_clearance;
            let text = format!("2 contacts per roller, front and back; clearance {clearance} mm");
            list.add("cage.pocket", Some(text));
            let friction = pocket.edge_friction.as_ref();
            let text = |mu: f64| format!("law: friction at the pocket edges, coefficient {mu}");
            list.add("cage.pocket.edge_friction", friction.map(|f| text(f.coefficient)));
            contact(&pocket.contact, "cage.pocket.contact", list);
        }
    }
    let Some(Guide::ShortBearing(guide)) = &cage.guide else {
        list.add("cage.guide.short_bearing", None);
        return;
    };
    let text = "force and moment: oil film of two lands between cage and outer ring";
    list.flag("cage.guide.short_bearing", true, text);
    list.flag(
        "cage.guide.short_bearing.squeeze",
        guide.squeeze,
        "law: film squeezed by the motion of the cage",
    );
    let orders: Vec<String> = guide.roundness.iter().map(|h| h.order.to_string()).collect();
    let roundness = (!orders.is_empty()).then(|| format!("shape: cage with harmonics {}", orders.join(", ")));
    list.add("cage.guide.short_bearing.roundness", roundness);
}
