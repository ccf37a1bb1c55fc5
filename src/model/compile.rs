//! From the scene to laws and constants. A law is built only if the scene asks for it.

use super::{CageBody, Model, PocketLaws, RingBody};
use crate::contact::pocket::PocketGeometry;
use crate::contact::raceway::RacewayGeometry;
use crate::error::Result;
use crate::laws::film_thickness::{FilmThickness, ThermalCorrection, ThermalLoad};
use crate::laws::journal::Harmonic;
use crate::laws::line_contact::LineContact;
use crate::laws::lubrication_regime::LubricationRegime;
use crate::laws::normal_contact::{ElasticLine, NormalDamping, effective_modulus};
use crate::laws::rolling_resistance::{Extent, RollingResistance};
use crate::laws::self_heating::SelfHeating;
use crate::laws::short_bearing::ShortBearing;
use crate::laws::solid_friction::SolidFriction;
use crate::laws::traction::Traction;
use crate::model::inputs::InputSignals;
use crate::model::layout::Layout;
use crate::scene::{self, Cage, ContactLaws, Guide, Lubricant, Material, Pocket, RingMotion, Scene, Signal};
use crate::scene::{bad_scene, needed};
use std::f64::consts::TAU;

/// The parts of the scene that several laws need, with the path of the law being built.
struct Builder<'a> {
    scene: &'a Scene,
    path: &'a str,
}

impl Builder<'_> {
    fn lubricant(&self, by: &str) -> Result<&Lubricant> {
        self.scene
            .lubricant
            .as_ref()
            .ok_or_else(|| bad_scene("lubricant", format!("missing; {} needs it", self.law(by))))
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
        let viscosity = self.lubricant(by)?.viscosity;
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

    /// A contact between a roller and a mate of the given material.
    fn line_contact(&self, laws: &ContactLaws, mate: &str, equivalent_radius: f64) -> Result<LineContact> {
        let rollers = &self.scene.rollers;
        let (a, b) = (self.material("rollers.material", &rollers.material)?, self.material(self.path, mate)?);
        let modulus = effective_modulus(a.young_modulus, a.poisson_ratio, b.young_modulus, b.poisson_ratio);
        let elastic = ElasticLine::new(modulus, equivalent_radius, rollers.effective_length);
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
                let viscosity = self.lubricant("film")?.viscosity;
                Some(FilmThickness::new(&elastic, viscosity, self.pressure_viscosity("film")?, thermal))
            }
        };
        let traction = match laws.traction {
            None => None,
            Some(scene::TractionLaw::MurakiKimura) => {
                let lubricant = self.lubricant("traction")?;
                let path = "lubricant.shear_modulus";
                Some(Traction::new(
                    lubricant.viscosity,
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
                thermal_product_1: self.thermal_product(&rollers.material, "self_heating")?,
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
        Ok(LineContact { elastic, damping, film, traction, self_heating, regime, rolling_resistance: None })
    }

    fn raceway(&self, mate: &str, equivalent_radius: f64) -> Result<LineContact> {
        let mut law = self.line_contact(&self.scene.raceways.contact, mate, equivalent_radius)?;
        if let Some(rolling) = &self.scene.raceways.rolling_resistance {
            let extent = match rolling.extent {
                scene::Extent::All => Extent::All,
                scene::Extent::Loaded { threshold } => Extent::Loaded { threshold },
            };
            let builder = Builder { path: "raceways", ..*self };
            let by = "rolling_resistance";
            law.rolling_resistance = Some(RollingResistance::new(
                &law.elastic,
                builder.lubricant(by)?.viscosity,
                builder.pressure_viscosity(by)?,
                builder.thermal_load(by)?,
                extent,
            ));
        }
        Ok(law)
    }

    fn pocket(&self, cage: &Cage, pocket: &Pocket, pitch_radius: f64) -> Result<PocketLaws> {
        let roller_radius = self.scene.rollers.radius;
        let geometry = PocketGeometry {
            pitch_radius,
            roller_radius,
            clearance: pocket.radial_clearance,
            half_angle: pocket.half_angle,
            edge_blend: pocket.edge_blend,
        };
        let pocket_radius = roller_radius + pocket.radial_clearance;
        let equivalent_radius = roller_radius * pocket_radius / pocket.radial_clearance;
        let wall = self.line_contact(&pocket.contact, &cage.material, equivalent_radius)?;
        let edge = LineContact { film: None, traction: None, self_heating: None, regime: None, ..wall };
        let edge_friction = pocket.edge_friction.as_ref().map_or(
            SolidFriction { coefficient: 0.0, transition_speed: 1.0 },
            |f| SolidFriction { coefficient: f.coefficient, transition_speed: f.transition_speed },
        );
        Ok(PocketLaws { geometry, wall, edge, edge_friction })
    }

    fn guide(&self, guide: &Guide) -> Result<ShortBearing> {
        let Guide::ShortBearing(g) = guide;
        let clearance = g.diametral_clearance / 2.0;
        Ok(ShortBearing {
            viscosity: self.lubricant("guide")?.viscosity,
            radius: g.guide_radius - clearance,
            clearance,
            land_width: g.land_width,
            squeeze: g.squeeze,
            roundness: g
                .roundness
                .iter()
                .map(|a| Harmonic { order: a.order, amplitude: a.amplitude, phase: a.phase })
                .collect(),
        })
    }
}

/// Builds the model of a checked scene.
pub fn compile(scene: Scene) -> Result<Model> {
    let count = scene.rollers.count as usize;
    let radius = scene.rollers.radius;
    let outer_radius = scene.outer_ring.raceway_radius;
    let inner_radius = outer_radius - 2.0 * radius - scene.inner_ring.radial_clearance / 2.0;
    let geometry = RacewayGeometry::new(outer_radius, radius, scene.inner_ring.radial_clearance);

    let raceways = Builder { scene: &scene, path: "raceways.contact" };
    let outer = raceways.raceway(&scene.outer_ring.material, 1.0 / (1.0 / radius - 1.0 / outer_radius))?;
    let inner = raceways.raceway(&scene.inner_ring.material, 1.0 / (1.0 / radius + 1.0 / inner_radius))?;

    let cage = match &scene.cage {
        None => None,
        Some(cage) => {
            let pocket = match &cage.pocket {
                None => None,
                Some(pocket) => {
                    let builder = Builder { scene: &scene, path: "cage.pocket.contact" };
                    Some(builder.pocket(cage, pocket, geometry.pitch_radius)?)
                }
            };
            let guide = match &cage.guide {
                None => None,
                Some(guide) => Some(Builder { scene: &scene, path: "cage" }.guide(guide)?),
            };
            Some(CageBody { mass: cage.mass, inertia: cage.inertia, pocket, guide })
        }
    };

    let (ring, load) = match &scene.inner_ring.motion {
        RingMotion::Fixed(position) => (RingBody::Fixed([position.y, position.z]), None),
        RingMotion::Free(free) => {
            let damping = free.support_damping.unwrap_or(0.0);
            (RingBody::Free { mass: free.mass, damping }, free.load.clone())
        }
    };
    let zero = Signal::Constant(0.0);
    let (load_y, load_z) = load.map_or((zero.clone(), zero), |l| (l.y, l.z));
    let reference_angles =
        (0..count).map(|j| scene.initial.first_roller_angle + TAU * j as f64 / count as f64).collect();
    let layout = Layout::new(matches!(ring, RingBody::Free { .. }), cage.is_some(), count);
    Ok(Model {
        layout,
        reference_angles,
        geometry,
        roller_mass: scene.rollers.mass,
        roller_inertia: scene.rollers.inertia,
        gravity: scene.gravity.map_or([0.0; 2], |g| [g.y, g.z]),
        outer,
        inner,
        ring,
        cage,
        inputs: InputSignals { signals: [scene.inner_ring.speed.clone(), load_y, load_z] },
        scene,
    })
}
