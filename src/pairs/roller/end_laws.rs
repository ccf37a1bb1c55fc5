//! Ribs and pocket sides of a scene: their geometry and laws.

use super::end::{EndShape, RibGeometry};
use super::laws::SpotLaw;
use crate::error::Result;
use crate::laws::elastic::line::effective_modulus;
use crate::laws::elastic::normal::NormalDamping;
use crate::laws::elastic::point::ElasticPoint;
use crate::laws::film::ellipse::EllipseFilm;
use crate::laws::film::regime::LubricationRegime;
use crate::laws::rib_contact::RibContact;
use crate::pairs::line_laws::LawBuilder;
use crate::pairs::raceway::RacewayGeometry;
use crate::scene::{self, ContactLaws, RibRing, RibSide, Scene, bad_scene, needed};

/// An end that may touch something.
#[derive(Debug)]
pub(crate) struct EndPair {
    /// Name of the contact.
    pub(crate) name: &'static str,
    /// Outer ring, inner ring or cage.
    pub(crate) mate: usize,
    pub(crate) geometry: RibGeometry,
    pub(crate) law: SpotLaw,
}

impl EndPair {
    /// Whether it is a rib, and not the side of a pocket.
    pub(crate) fn is_rib(&self) -> bool {
        self.mate != CAGE
    }
}

/// Names of ribs by ring and side, and of the sides of pockets.
const RIBS: [[&str; 2]; 2] =
    [["outer_rib_positive", "outer_rib_negative"], ["inner_rib_positive", "inner_rib_negative"]];
const SIDES: [&str; 2] = ["pocket_side_positive", "pocket_side_negative"];
const CAGE: usize = crate::bodies::CAGE;

/// The ends of the rollers of a scene with ribs and pocket sides, with the lubricant at `viscosity` in Pa s.
pub(crate) fn ends(
    scene: &Scene,
    geometry: &RacewayGeometry,
    viscosity: Option<f64>,
) -> Result<Vec<EndPair>> {
    let Some(space) = scene.rollers.as_ref().and_then(|rollers| rollers.space.as_ref()) else {
        return Ok(Vec::new());
    };
    let sides = scene.cage.as_ref().and_then(|cage| cage.space.as_ref()?.pocket_sides.as_ref());
    if scene.ribs.is_none() && sides.is_none() {
        return Ok(Vec::new());
    }
    let ends = needed("rollers.space.ends", space.ends.as_ref(), "ribs")?;
    let end = EndShape { cap_radius: ends.cap_radius, face_radius: ends.face_radius, length: space.length };
    let builder = LawBuilder::new(scene, viscosity);
    let mut list = Vec::new();
    for rib in scene.ribs.iter().flat_map(|ribs| ribs.list.iter().map(move |rib| (ribs, rib))) {
        let (ribs, rib) = rib;
        let ring = usize::from(rib.ring == RibRing::Inner);
        let side = usize::from(rib.side == RibSide::Negative);
        let sign = [1.0, -1.0][side];
        let of_rib = [rib.angle, rib.height, ribs.end_play];
        let found = RibGeometry::rib(geometry, end, (ring, sign), of_rib).ok_or_else(|| {
            bad_scene(
                "rollers.space.ends.cap_radius",
                "as flat as the rib, or flatter; less than 0.99 of the radius of the rib",
            )
        })?;
        let material = match rib.ring {
            RibRing::Outer => scene.outer_ring.as_ref().and_then(|ring| ring.material.as_deref()),
            RibRing::Inner => scene.inner_ring.as_ref().and_then(|ring| ring.material.as_deref()),
        };
        let law =
            law(&builder.at("ribs.contact"), &ribs.contact, material, found.curvatures(&geometry.cones))?;
        list.push(EndPair { name: RIBS[ring][side], mate: ring, geometry: found, law });
    }
    if let Some(sides) = sides {
        let material = scene.cage.as_ref().and_then(|cage| cage.material.as_deref());
        let builder = builder.at("cage.space.pocket_sides.contact");
        for (name, sign) in SIDES.into_iter().zip([1.0, -1.0]) {
            let found = RibGeometry::pocket_side(geometry, end, sign, sides.play);
            let law = law(&builder, &sides.contact, material, [1.0 / end.cap_radius; 2])?;
            list.push(EndPair { name, mate: CAGE, geometry: found, law });
        }
    }
    Ok(list)
}

/// The law of an end on something of this material, with these curvatures of both together (1/m), the larger one first.
fn law(
    builder: &LawBuilder<'_>,
    laws: &ContactLaws,
    mate: Option<&str>,
    curvatures: [f64; 2],
) -> Result<SpotLaw> {
    let scene = builder.scene();
    let own = scene.rollers.as_ref().map_or("", |rollers| rollers.material.as_str());
    let mate = needed("material", mate, &builder.law("film"))?;
    let (a, b) = (builder.material("rollers.material", own)?, builder.material("cage.material", mate)?);
    let modulus = effective_modulus(a.young_modulus, a.poisson_ratio, b.young_modulus, b.poisson_ratio);
    let hertz = |curvatures| {
        ElasticPoint::new(modulus, curvatures)
            .ok_or_else(|| bad_scene("rollers.space.ends.cap_radius", "makes no contact of Hertz"))
    };
    let ellipse = hertz(curvatures)?;
    let point = hertz([0.5 * (curvatures[0] + curvatures[1]); 2])?;
    let thermal = match laws.thermal_correction {
        None => None,
        Some(scene::ThermalCorrection::Gupta) => Some(builder.thermal_load("thermal_correction")?),
        Some(scene::ThermalCorrection::GhoshPandey) => {
            let path = builder.law("thermal_correction");
            return Err(bad_scene(&path, "a law of line contacts; of ends 'gupta'"));
        }
    };
    let film = match laws.film {
        None => None,
        Some(scene::FilmLaw::HamrockDowson) => {
            let viscosity = builder.viscosity("film")?;
            Some(EllipseFilm::new(&point, viscosity, builder.pressure_viscosity("film")?, thermal))
        }
        Some(scene::FilmLaw::PanHamrock) => {
            return Err(bad_scene(&builder.law("film"), "a law of line contacts; of ends 'hamrock_dowson'"));
        }
    };
    Ok(SpotLaw::Rib(RibContact {
        elastic: ellipse,
        damping: laws.damping.as_ref().map(NormalDamping::from),
        film,
        traction: builder.traction(laws)?,
        self_heating: builder.self_heating(laws, [own, mate])?,
        regime: laws.boundary_friction.as_ref().map(LubricationRegime::from),
    }))
}
