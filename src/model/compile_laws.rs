//! From the scene to laws and their constants. A law is built only if the scene asks for it.

use super::laws::{CylinderLaws, Laws, PlaneLaws, PocketLaws, RacewayLaws};
use crate::contact::cylinder_pocket::CylinderPocket;
use crate::contact::plane_pocket::PlanePocket;
use crate::contact::pocket::PocketPlace;
use crate::contact::raceway::RacewayGeometry;
use crate::error::Result;
use crate::laws::film_thickness::{FilmThickness, ThermalCorrection, ThermalLoad};
use crate::laws::guide::{GuideFilm, GuideLaw, GuideSolid};
use crate::laws::journal::Harmonic;
use crate::laws::line_contact::LineContact;
use crate::laws::lubricant_layer::{LubricantLayer, PressureShear};
use crate::laws::lubrication_regime::LubricationRegime;
use crate::laws::normal_contact::{ElasticLine, NormalDamping, effective_modulus};
use crate::laws::rolling_resistance::{Extent, RollingResistance};
use crate::laws::self_heating::SelfHeating;
use crate::laws::short_bearing::ShortBearing;
use crate::laws::solid_contact::SolidContact;
use crate::laws::solid_friction::SolidFriction;
use crate::laws::traction::Traction;
use crate::scalar::math;
use crate::scene::{self, Cage, ContactLaws, Guide, GuideRing, Lubricant, Material, Scene};
use crate::scene::{bad_scene, needed};
use std::f64::consts::TAU;

/// Asperities begin to touch at this many times the roughness, unless the scene says otherwise.
const ASPERITY_HEIGHT: f64 = 3.0;
/// Samples per period of the highest harmonic, for the highest place of a roundness profile.
const PROFILE_SAMPLES: u32 = 64;

/// Builds the laws of a checked scene, with the lubricant at `viscosity` in Pa s.
pub(super) fn compile_laws(
    scene: &Scene,
    viscosity: Option<f64>,
    raceways: Option<&RacewayGeometry>,
) -> Result<Laws> {
    let at = |path| Builder { scene, path, viscosity };
    let raceways = match (raceways, &scene.raceways) {
        (Some(g), Some(laws)) => Some(at("raceways.contact").raceways(g, laws)?),
        _ => None,
    };
    let cage = scene.cage.as_ref();
    let pocket = match cage.and_then(|cage| Some((cage, cage.pocket.as_ref()?))) {
        None => None,
        Some((cage, pocket)) => Some(at("cage.pocket.lubricated_cylinder.contact").pocket(cage, pocket)?),
    };
    let guide = match cage.and_then(|cage| cage.guide.as_ref()) {
        None => None,
        Some(guide) => Some(at("cage.guide.film").guide(guide)?),
    };
    Ok(Laws { raceways, pocket, guide })
}

/// The parts of the scene that several laws need, with the path of the law being built.
struct Builder<'a> {
    scene: &'a Scene,
    path: &'a str,
    /// eta0 the laws are built with, Pa s.
    viscosity: Option<f64>,
}

/// One of the two bodies of a line contact.
struct Element<'a> {
    path: &'a str,
    material: &'a str,
    effective_length: f64,
}

impl Builder<'_> {
    fn lubricant(&self, by: &str) -> Result<&Lubricant> {
        self.scene
            .lubricant
            .as_ref()
            .ok_or_else(|| bad_scene("lubricant", format!("missing; {} needs it", self.law(by))))
    }

    fn viscosity(&self, by: &str) -> Result<f64> {
        self.lubricant(by)?;
        needed("lubricant.viscosity", self.viscosity, &self.law(by))
    }

    /// Material and contact length of the rolling elements.
    fn element(&self) -> Result<Element<'_>> {
        if let Some(rollers) = &self.scene.rollers {
            let (path, material) = ("rollers.material", rollers.material.as_str());
            return Ok(Element { path, material, effective_length: rollers.effective_length });
        }
        let elements = self.scene.kinematic_elements.as_ref();
        let (path, by) = ("kinematic_elements.material", "cage.pocket.lubricated_cylinder");
        let material = needed(path, elements.and_then(|e| e.material.as_deref()), by)?;
        let length = elements.and_then(|e| e.effective_length);
        let effective_length = needed("kinematic_elements.effective_length", length, by)?;
        Ok(Element { path, material, effective_length })
    }

    fn law(&self, field: &str) -> String {
        format!("{}.{field}", self.path)
    }

    fn pressure_viscosity(&self, by: &str) -> Result<f64> {
        needed("lubricant.pressure_viscosity", self.lubricant(by)?.pressure_viscosity, &self.law(by))
    }

    fn temperature_viscosity(&self, by: &str) -> Result<f64> {
        needed("lubricant.temperature_viscosity", self.lubricant(by)?.temperature_viscosity, &self.law(by))
    }

    fn conductivity(&self, by: &str) -> Result<f64> {
        needed("lubricant.conductivity", self.lubricant(by)?.conductivity, &self.law(by))
    }

    fn eyring_stress(&self, by: &str) -> Result<f64> {
        needed("lubricant.eyring_stress", self.lubricant(by)?.eyring_stress, &self.law(by))
    }

    fn thermal_load(&self, by: &str) -> Result<ThermalLoad> {
        let viscosity = self.viscosity(by)?;
        Ok(ThermalLoad::new(self.temperature_viscosity(by)?, viscosity, self.conductivity(by)?))
    }

    fn material(&self, path: &str, name: &str) -> Result<&Material> {
        self.scene
            .materials
            .get(name)
            .ok_or_else(|| bad_scene(path, format!("'{name}' is not one of the materials")))
    }

    /// k rho c of a material.
    fn thermal_product(&self, name: &str, by: &str) -> Result<f64> {
        let path = format!("materials.{name}.thermal");
        let t = self.material(&path, name)?.thermal.as_ref();
        let t = t.ok_or_else(|| bad_scene(&path, format!("missing; {} needs it", self.law(by))))?;
        Ok(t.conductivity * t.density * t.specific_heat)
    }

    /// A contact between an element and a mate of the given material.
    fn line_contact(&self, laws: &ContactLaws, mate: &str, equivalent_radius: f64) -> Result<LineContact> {
        let element = self.element()?;
        let (a, b) = (self.material(element.path, element.material)?, self.material(self.path, mate)?);
        let modulus = effective_modulus(a.young_modulus, a.poisson_ratio, b.young_modulus, b.poisson_ratio);
        let elastic = ElasticLine::new(modulus, equivalent_radius, element.effective_length);
        let thermal = match laws.thermal_correction {
            None => None,
            Some(kind) => {
                let load = self.thermal_load("thermal_correction")?;
                Some(match kind {
                    scene::ThermalCorrection::GhoshPandey => ThermalCorrection::GhoshPandey(load),
                    scene::ThermalCorrection::Gupta => ThermalCorrection::Gupta(load),
                })
            }
        };
        let film = match laws.film {
            None => None,
            Some(scene::FilmLaw::PanHamrock) => {
                let viscosity = self.viscosity("film")?;
                Some(FilmThickness::new(&elastic, viscosity, self.pressure_viscosity("film")?, thermal))
            }
        };
        let traction = match laws.traction {
            None => None,
            Some(scene::TractionLaw::MurakiKimura) => {
                let lubricant = self.lubricant("traction")?;
                let path = "lubricant.shear_modulus";
                Some(Traction::new(
                    self.viscosity("traction")?,
                    self.pressure_viscosity("traction")?,
                    self.eyring_stress("traction")?,
                    needed(path, lubricant.shear_modulus, &self.law("traction"))?,
                ))
            }
        };
        let self_heating = match laws.self_heating {
            None => None,
            Some(scene::SelfHeating::FilmAndFlash) => Some(SelfHeating {
                temperature_viscosity: self.temperature_viscosity("self_heating")?,
                conductivity: self.conductivity("self_heating")?,
                eyring_stress: self.eyring_stress("self_heating")?,
                thermal_product_1: self.thermal_product(element.material, "self_heating")?,
                thermal_product_2: self.thermal_product(mate, "self_heating")?,
            }),
        };
        let damping = laws.damping.as_ref().map(|d| NormalDamping {
            relaxation_time: d.relaxation_time,
            softening_depth: d.softening_depth,
        });
        let regime = laws.boundary_friction.as_ref().map(|b| LubricationRegime {
            boundary: SolidFriction { coefficient: b.coefficient, transition_speed: b.transition_speed },
            lambda_boundary: b.lambda_boundary,
            lambda_full: b.lambda_full,
            roughness: b.roughness,
        });
        Ok(LineContact {
            elastic,
            damping,
            film,
            traction,
            self_heating,
            regime,
            rolling_resistance: None,
            edge_friction: None,
        })
    }

    fn raceways(&self, g: &RacewayGeometry, laws: &scene::Raceways) -> Result<RacewayLaws> {
        let radius = g.roller_radius;
        let rings = (self.scene.outer_ring.as_ref(), self.scene.inner_ring.as_ref());
        let outer_ring = needed("outer_ring", rings.0, "raceways")?;
        let outer = outer_ring.raceway_radius;
        let inner = outer - 2.0 * radius - 2.0 * g.gap;
        let inner_material = rings.1.and_then(|ring| ring.material.as_deref());
        let inner_material = needed("inner_ring.material", inner_material, "raceways")?;
        Ok(RacewayLaws {
            outer: self.raceway(laws, &outer_ring.material, 1.0 / (1.0 / radius - 1.0 / outer))?,
            inner: self.raceway(laws, inner_material, 1.0 / (1.0 / radius + 1.0 / inner))?,
        })
    }

    fn raceway(&self, laws: &scene::Raceways, mate: &str, equivalent_radius: f64) -> Result<LineContact> {
        let mut law = self.line_contact(&laws.contact, mate, equivalent_radius)?;
        if let Some(rolling) = &laws.rolling_resistance {
            let extent = match rolling.extent {
                scene::Extent::All => Extent::All,
                scene::Extent::Loaded { threshold } => Extent::Loaded { threshold },
            };
            let builder = Builder { path: "raceways", ..*self };
            let by = "rolling_resistance";
            law.rolling_resistance = Some(RollingResistance::new(
                &law.elastic,
                builder.viscosity(by)?,
                builder.pressure_viscosity(by)?,
                builder.thermal_load(by)?,
                extent,
            ));
        }
        Ok(law)
    }

    fn pocket(&self, cage: &Cage, pocket: &scene::Pocket) -> Result<PocketLaws> {
        let element_radius = self.scene.element_radius();
        let place = PocketPlace { pitch_radius: self.scene.pitch_radius(), element_radius };
        match pocket {
            scene::Pocket::SolidPlane(pocket) => Ok(PocketLaws::Plane(PlaneLaws {
                shape: PlanePocket { place, clearance: pocket.diametral_clearance / 2.0 },
                contact: solid(&pocket.contact),
            })),
            scene::Pocket::LubricatedCylinder(pocket) => {
                let (half_angle, edge_blend) = (pocket.half_angle, pocket.edge_blend);
                let shape = CylinderPocket::new(place, pocket.radial_clearance, half_angle, edge_blend);
                let pocket_radius = element_radius + pocket.radial_clearance;
                let equivalent_radius = element_radius * pocket_radius / pocket.radial_clearance;
                let mate =
                    needed("cage.material", cage.material.as_deref(), "cage.pocket.lubricated_cylinder")?;
                let wall = self.line_contact(&pocket.contact, mate, equivalent_radius)?;
                let edge_friction = pocket.edge_friction.as_ref().map_or(SolidFriction::NONE, friction);
                let wall = LineContact { edge_friction: Some(edge_friction), ..wall };
                Ok(PocketLaws::Cylinder(CylinderLaws { shape, wall }))
            }
        }
    }

    fn guide(&self, guide: &Guide) -> Result<GuideLaw> {
        let clearance = guide.diametral_clearance / 2.0;
        // A profile on the outside of the cage thins the film where it is high, one in its bore thickens it.
        let (radius, sign) = match guide.ring {
            GuideRing::OuterRing => (guide.guide_radius - clearance, 1.0),
            GuideRing::InnerRing => (guide.guide_radius, -1.0),
        };
        let roundness: Vec<Harmonic> = guide
            .roundness
            .iter()
            .map(|a| Harmonic { order: a.order, amplitude: sign * a.amplitude, phase: a.phase })
            .collect();
        let free_clearance = clearance - highest_place(&roundness);
        let film = match &guide.film {
            None => None,
            Some(scene::GuideFilm::ShortBearing(film)) => Some(GuideFilm::ShortBearing(ShortBearing {
                viscosity: self.viscosity("short_bearing")?,
                radius,
                clearance,
                land_width: film.land_width,
                squeeze: film.squeeze,
                pressure_moment: film.pressure_moment,
                roundness,
                profile_on_journal: guide.ring == GuideRing::OuterRing,
            })),
            Some(scene::GuideFilm::LubricantLayer(film)) => Some(GuideFilm::LubricantLayer(LubricantLayer {
                viscosity: self.viscosity("lubricant_layer")?,
                pressure_viscosity: self.pressure_viscosity("lubricant_layer")?,
                cap: film.pressure_cap,
                radius,
                clearance,
                width: film.land_width,
                thickness: film.thickness,
                pressure_shear: match film.pressure_shear {
                    scene::PressureShear::Absent => PressureShear::Absent,
                    scene::PressureShear::WithinArc => PressureShear::WithinArc,
                    scene::PressureShear::WithEdges => PressureShear::WithEdges,
                },
                roundness,
                profile_on_journal: guide.ring == GuideRing::OuterRing,
            })),
        };
        let share = guide.film_share.as_ref();
        let (roughness, touching_ratio) = share.map_or((0.0, 0.0), |s| (s.roughness, s.touching_ratio));
        let solid = guide.solid.as_ref().map(|law| GuideSolid {
            contact: solid(&law.contact),
            asperity_height: law.asperity_height.unwrap_or(ASPERITY_HEIGHT * roughness),
        });
        Ok(GuideLaw { radius, free_clearance, film, solid, roughness, touching_ratio })
    }
}

fn solid(law: &scene::SolidContact) -> SolidContact {
    SolidContact {
        stiffness: law.stiffness,
        damping: law.damping,
        softening_depth: law.softening_depth,
        friction: law.friction.as_ref().map(friction),
    }
}

fn friction(law: &scene::Friction) -> SolidFriction {
    SolidFriction { coefficient: law.coefficient, transition_speed: law.transition_speed }
}

/// Largest height of a profile, m, to about a thousandth of its amplitude.
fn highest_place(roundness: &[Harmonic]) -> f64 {
    let order = roundness.iter().map(|a| a.order).max().unwrap_or(0);
    let samples = order * PROFILE_SAMPLES;
    (0..samples)
        .map(|i| {
            let angle = TAU * f64::from(i) / f64::from(samples);
            roundness.iter().map(|a| a.amplitude * math::cos(f64::from(a.order) * angle + a.phase)).sum()
        })
        .fold(0.0, f64::max)
}
