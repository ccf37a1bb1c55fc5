//! The optional physical effects of a scene: which it has, what each adds, which are absent.

use cagedyn::Scene;
use cagedyn::scene::{
    ContactLaws, Extent, FilmLaw, Guide, GuideFilm, GuideRing, Pocket, PocketLaw, PressureShear, RingMotion,
    RollerProfile, RoundPocket, SolidContact, Viscosity,
};

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
    profiles(scene, &mut list);
    waves(scene, &mut list);
    if let Some(raceways) = &scene.raceways {
        contact(&raceways.contact, "raceways.contact", &mut list);
        let resistance = raceways.rolling_resistance.as_ref().map(|r| match r.extent {
            Extent::All => "law: rolling resistance of the film in all raceway contacts".to_owned(),
            Extent::Loaded { threshold } => {
                format!("law: rolling resistance of the film in raceway contacts above {threshold} N")
            }
        });
        list.add("raceways.rolling_resistance", resistance);
        if let Some(resistance) = &raceways.rolling_resistance {
            let path = "raceways.rolling_resistance.inlet_sliding";
            list.flag(
                path,
                resistance.inlet_sliding.is_some(),
                "law: drag of the inlet on surfaces that slip",
            );
        }
    }
    lubricant(scene, &mut list);
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
    let turns = scene.outer_ring.as_ref().is_some_and(|ring| ring.speed.is_some());
    list.flag("outer_ring.speed", turns, "motion: the outer ring turns at its given speed");
    if let Some(balls) = &scene.balls {
        let drag = balls.drag.map(|drag| format!("force: drag of a mixture of {} kg/m^3", drag.density));
        list.add("balls.drag", drag);
        space(scene, list);
    }
    if scene.rollers.is_none() {
        return;
    }
    let Some(RingMotion::Free(ring)) = scene.inner_ring.as_ref().map(|ring| &ring.motion) else {
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

fn space(scene: &Scene, list: &mut List) {
    let Some(RingMotion::Space(ring)) = scene.inner_ring.as_ref().map(|ring| &ring.motion) else { return };
    let preload = ring.preload.map(|spring| format!("force: spring of {} N along the axis", spring.force));
    list.add("inner_ring.motion.space.preload", preload);
    let damping = ring.support_damping.map(|d| format!("force: damper of {d} N s/m on the ring"));
    list.add("inner_ring.motion.space.support_damping", damping);
    let damping = ring.tilt_damping.map(|d| format!("force: damper of {d} N m s on its tilt"));
    list.add("inner_ring.motion.space.tilt_damping", damping);
}

fn profiles(scene: &Scene, list: &mut List) {
    let Some(rollers) = &scene.rollers else { return };
    let of_rollers = rollers.profile.as_ref().map(|profile| match profile {
        RollerProfile::Logarithmic(log) => {
            format!(
                "law: raceway contacts in slices, logarithmic rollers for {} N",
                log.load_factor * log.design_load
            )
        }
        RollerProfile::CircularCrown { radius } => {
            format!("law: raceway contacts in slices, rollers with a crown of radius {radius} m")
        }
        RollerProfile::Table(table) => {
            format!("law: rollers with a profile by a table of {} drops", table.places.len())
        }
    });
    list.add("rollers.profile", of_rollers);
    for (ring, radius) in [
        ("outer_ring", scene.outer_ring.as_ref().and_then(|ring| ring.raceway_crown_radius)),
        ("inner_ring", scene.inner_ring.as_ref().and_then(|ring| ring.raceway_crown_radius)),
    ] {
        let text = |radius| format!("law: contacts in slices, raceway with a crown of radius {radius} m");
        list.add(format!("{ring}.raceway_crown_radius"), radius.map(text));
    }
}

/// What is not round about its axis, where elements see it.
fn waves(scene: &Scene, list: &mut List) {
    let in_plane = scene.rollers.as_ref().filter(|rollers| rollers.space.is_none());
    if in_plane.is_none() && scene.balls.is_none() {
        return;
    }
    let outer = scene.outer_ring.as_ref().map(|ring| (ring.waviness.len(), &ring.waviness_table));
    let inner = scene.inner_ring.as_ref().map(|ring| (ring.waviness.len(), &ring.waviness_table));
    for (ring, waves) in [("outer_ring", outer), ("inner_ring", inner)] {
        let Some((orders, table)) = waves else { continue };
        let harmonics = (orders > 0).then(|| format!("shape: raceway with {orders} harmonics"));
        list.add(format!("{ring}.waviness"), harmonics);
        let heights =
            table.as_ref().map(|table| format!("shape: raceway by {} heights", table.heights.len()));
        list.add(format!("{ring}.waviness_table"), heights);
    }
    if let Some(rollers) = in_plane {
        let count: usize = rollers.waviness.iter().map(|group| group.rollers.len()).sum();
        let text = format!("shape: {count} rollers that are not round; states: spin angles of all");
        list.add("rollers.waviness", (count > 0).then_some(text));
    }
}

fn contact(laws: &ContactLaws, path: &str, list: &mut List) {
    let at = |field: &str| format!("{path}.{field}");
    let damping = laws.damping.as_ref();
    list.add(
        at("damping"),
        damping.map(|d| format!("law: normal damping, relaxation time {:e} s", d.relaxation_time)),
    );
    let film = laws.film.map(|law| match law {
        FilmLaw::PanHamrock => "law: film thickness of Pan and Hamrock".to_owned(),
        FilmLaw::HamrockDowson => "law: film thickness of Hamrock and Dowson".to_owned(),
    });
    list.add(at("film"), film);
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
    let [states, space] = if cage.space.is_some() { [12, 1] } else { [6, 0] };
    let moves = ["the plane", "space, and tilts"][space];
    list.add("cage", Some(format!("{states} states: cage of {} kg moves and turns in {moves}", cage.mass)));
    let offset = cage.mass_eccentricity.map(|u| format!("inertia: centre of mass ({}, {}) m off", u.y, u.z));
    list.add("cage.mass_eccentricity", offset);
    let ring = cage.elastic_ring.as_ref();
    let states = |modes: u32| {
        format!("{} states: the ring of the cage bends in waves of order 2 to {modes}", 4 * (modes - 1))
    };
    list.add("cage.elastic_ring", ring.map(|ring| states(ring.modes)));
    list.flag("cage.load", cage.load.is_some(), "inputs: external force and torque on the cage");
    pocket(cage.pocket.as_ref(), list);
    guide(cage.guide.as_ref(), "cage.guide", list);
    for (k, land) in cage.space.iter().flat_map(|space| &space.lands).enumerate() {
        guide(Some(&land.guide), &format!("cage.space.lands[{k}].guide"), list);
    }
}

fn lubricant(scene: &Scene, list: &mut List) {
    if let Some(lubricant) = &scene.lubricant {
        let heated = matches!(lubricant.viscosity, Viscosity::Walther(_));
        list.flag("lubricant.viscosity.walther", heated, "law: viscosity follows the temperature");
    }
    let heat = scene
        .heat
        .as_ref()
        .map(|heat| format!("balance: {} temperatures, by `cagedyn heat`", heat.nodes.len()));
    list.add("heat", heat);
}

fn pocket(pocket: Option<&Pocket>, list: &mut List) {
    match pocket {
        None => list.add("cage.pocket", None),
        Some(Pocket::LubricatedCylinder(pocket)) => {
            let path = "cage.pocket.lubricated_cylinder";
            let clearance = 1e3 * pocket.radial_clearance;
            let text =
                format!("2 line contacts per element, front and back; radial clearance {clearance} mm");
            list.add(path, Some(text));
            let friction = pocket.edge_friction.as_ref();
            let text = |mu: f64| format!("law: friction at the pocket edges, coefficient {mu}");
            list.add(format!("{path}.edge_friction"), friction.map(|f| text(f.coefficient)));
            contact(&pocket.contact, &format!("{path}.contact"), list);
        }
        Some(Pocket::SolidPlane(pocket)) => {
            let path = "cage.pocket.solid_plane";
            let clearance = 1e3 * pocket.diametral_clearance;
            let text = format!("2 solid contacts per element, front and back; clearance {clearance} mm");
            list.add(path, Some(text));
            solid(&pocket.contact, &format!("{path}.contact"), list);
        }
        Some(Pocket::SolidCylinder(pocket)) => round_pocket(pocket, "solid_cylinder", list),
        Some(Pocket::SolidSphere(pocket)) => round_pocket(pocket, "solid_sphere", list),
    }
}

fn round_pocket(pocket: &RoundPocket, shape: &str, list: &mut List) {
    let path = format!("cage.pocket.{shape}");
    let clearance = 1e3 * pocket.diametral_clearance;
    list.add(path.clone(), Some(format!("1 solid contact per element; clearance {clearance} mm")));
    match &pocket.law {
        PocketLaw::Spring(contact) => solid(contact, &format!("{path}.law.spring"), list),
        PocketLaw::Hertz(law) => {
            let damping = law.damping.as_ref().map(|_| "law: contact damping".to_owned());
            list.add(format!("{path}.law.hertz.damping"), damping);
            let text = |mu: f64| format!("law: solid friction, coefficient {mu}");
            let friction = law.friction.as_ref().map(|f| text(f.coefficient));
            list.add(format!("{path}.law.hertz.friction"), friction);
        }
    }
}

fn solid(contact: &SolidContact, path: &str, list: &mut List) {
    let damping = contact.damping;
    let adds = (damping > 0.0).then(|| format!("law: damper of {damping} N s/m"));
    list.add(format!("{path}.damping"), adds);
    let friction = contact.friction.as_ref();
    let text = |mu: f64| format!("law: solid friction, coefficient {mu}");
    list.add(format!("{path}.friction"), friction.map(|f| text(f.coefficient)));
}

fn guide(guide: Option<&Guide>, path: &str, list: &mut List) {
    let at = |field: &str| format!("{path}.{field}");
    let Some(guide) = guide else {
        list.add(path, None);
        return;
    };
    let lands = if path == "cage.guide" { "two lands" } else { "one land" };
    let ring = match guide.ring {
        GuideRing::OuterRing => "outer ring",
        GuideRing::InnerRing => "inner ring",
    };
    match &guide.film {
        None => list.add(at("film"), None),
        Some(GuideFilm::ShortBearing(film)) => {
            let text = format!("force and moment: oil film of {lands} between cage and {ring}");
            list.add(at("film.short_bearing"), Some(text));
            let text = "law: film squeezed by the motion of the cage";
            list.flag(at("film.short_bearing.squeeze"), film.squeeze, text);
        }
        Some(GuideFilm::LubricantLayer(film)) => {
            let thickness = 1e6 * film.thickness;
            let text = format!("force and moment: layer of {thickness} um between cage and {ring}");
            list.add(at("film.lubricant_layer"), Some(text));
            let present = film.pressure_shear != PressureShear::Absent;
            let text = "law: shear stress of the pressure gradient";
            list.flag(at("film.lubricant_layer.pressure_shear"), present, text);
        }
    }
    match &guide.solid {
        None => list.add(at("solid"), None),
        Some(law) => {
            let text = format!("force and moment: solid contact between cage and {ring}");
            list.add(at("solid"), Some(text));
            solid(&law.contact, &at("solid.contact"), list);
        }
    }
    let orders: Vec<String> = guide.roundness.iter().map(|h| h.order.to_string()).collect();
    let roundness = (!orders.is_empty()).then(|| format!("shape: cage with harmonics {}", orders.join(", ")));
    list.add(at("roundness"), roundness);
}
