//! From the blocks of a scene to laws and their constants. A law is built only if the scene asks for it.

use crate::error::Result;
use crate::laws::elastic::line::{ElasticLine, effective_modulus};
use crate::laws::elastic::normal::NormalDamping;
use crate::laws::elastic::profile::{Logarithm, Profile, USUAL_SLICES};
use crate::laws::elastic::solid::SolidContact;
use crate::laws::film::regime::LubricationRegime;
use crate::laws::film::thickness::{FilmThickness, ThermalCorrection, ThermalLoad};
use crate::laws::fluid::grease::{Polymer, Soap, Thickener};
use crate::laws::line_contact::LineContact;
use crate::laws::rolling::{
    ELASTIC_RATIO, Extent, InletSliding, Isothermal, RIGID_RATIO, RigidLimit, RollingFilm, RollingResistance,
    ZhouHoeprich,
};
use crate::laws::traction::muraki_kimura::Traction;
use crate::laws::traction::self_heating::SelfHeating;
use crate::laws::traction::solid_friction::SolidFriction;
use crate::scene::{self, ContactLaws, Grease, Lubricant, Material, RollerProfile, Scene, bad_scene, needed};

/// The parts of the scene that several laws need, with the path of the law being built.
pub(crate) struct LawBuilder<'a> {
    scene: &'a Scene,
    path: &'a str,
    /// eta0 the laws are built with, Pa s.
    viscosity: Option<f64>,
}

/// What the elements of a line contact are made of.
struct Element<'a> {
    path: &'a str,
    material: &'a str,
    effective_length: f64,
}

/// What thickens an oil of this viscosity (Pa s).
pub(crate) fn thickener(grease: &Grease, base_viscosity: f64) -> Thickener {
    match grease {
        Grease::Soap(soap) => Thickener::Soap(Soap {
            yield_stress: soap.yield_stress,
            yield_time: soap.yield_time,
            consistency: soap.consistency,
            exponent: soap.exponent,
            lowest_shear_rate: soap.lowest_shear_rate,
            reference_temperature: soap.reference_temperature,
            halving: soap.halving,
            base_viscosity,
        }),
        Grease::Polymer(polymer) => Thickener::Polymer(Polymer {
            plateau: polymer.plateau,
            relaxation_time: polymer.relaxation_time,
            exponent: polymer.exponent,
        }),
    }
}

impl<'a> LawBuilder<'a> {
    /// For the laws of a scene, with the lubricant at `viscosity` in Pa s.
    pub(crate) fn new(scene: &'a Scene, viscosity: Option<f64>) -> Self {
        Self { scene, path: "", viscosity }
    }

    /// The scene.
    pub(crate) fn scene(&self) -> &'a Scene {
        self.scene
    }

    /// The same for the law at this path, which messages name.
    pub(crate) fn at(&self, path: &'a str) -> Self {
        Self { path, ..*self }
    }

    pub(in crate::pairs) fn lubricant(&self, by: &str) -> Result<&'a Lubricant> {
        self.scene
            .lubricant
            .as_ref()
            .ok_or_else(|| bad_scene("lubricant", format!("missing; {} needs it", self.law(by))))
    }

    pub(crate) fn viscosity(&self, by: &str) -> Result<f64> {
        self.lubricant(by)?;
        needed("lubricant.viscosity", self.viscosity, &self.law(by))
    }

    /// Material and contact length of the rolling elements.
    fn element(&self) -> Result<Element<'a>> {
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

    pub(in crate::pairs) fn law(&self, field: &str) -> String {
        format!("{}.{field}", self.path)
    }

    /// What thickens the oil where it is sheared.
    pub(crate) fn thickener(&self, by: &str) -> Result<Option<Thickener>> {
        let viscosity = self.viscosity(by)?;
        Ok(self.lubricant(by)?.grease.as_ref().map(|grease| thickener(grease, viscosity)))
    }

    pub(crate) fn pressure_viscosity(&self, by: &str) -> Result<f64> {
        needed("lubricant.pressure_viscosity", self.lubricant(by)?.pressure_viscosity, &self.law(by))
    }

    pub(in crate::pairs) fn temperature_viscosity(&self, by: &str) -> Result<f64> {
        needed("lubricant.temperature_viscosity", self.lubricant(by)?.temperature_viscosity, &self.law(by))
    }

    pub(in crate::pairs) fn conductivity(&self, by: &str) -> Result<f64> {
        needed("lubricant.conductivity", self.lubricant(by)?.conductivity, &self.law(by))
    }

    pub(in crate::pairs) fn eyring_stress(&self, by: &str) -> Result<f64> {
        needed("lubricant.eyring_stress", self.lubricant(by)?.eyring_stress, &self.law(by))
    }

    pub(in crate::pairs) fn thermal_load(&self, by: &str) -> Result<ThermalLoad> {
        let viscosity = self.viscosity(by)?;
        Ok(ThermalLoad::new(self.temperature_viscosity(by)?, viscosity, self.conductivity(by)?))
    }

    pub(in crate::pairs) fn material(&self, path: &str, name: &str) -> Result<&'a Material> {
        self.scene
            .materials
            .get(name)
            .ok_or_else(|| bad_scene(path, format!("'{name}' is not one of the materials")))
    }

    /// k rho c of a material.
    pub(in crate::pairs) fn thermal_product(&self, name: &str, by: &str) -> Result<f64> {
        let path = format!("materials.{name}.thermal");
        let t = self.material(&path, name)?.thermal.as_ref();
        let t = t.ok_or_else(|| bad_scene(&path, format!("missing; {} needs it", self.law(by))))?;
        Ok(t.conductivity * t.density * t.specific_heat)
    }

    /// A contact between an element and a mate of the given material.
    pub(crate) fn line_contact(
        &self,
        laws: &ContactLaws,
        mate: &str,
        equivalent_radius: f64,
    ) -> Result<LineContact> {
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
            Some(scene::FilmLaw::HamrockDowson) => {
                return Err(bad_scene(&self.law("film"), "a law of balls; of line contacts 'pan_hamrock'"));
            }
        };
        let traction = self.traction(laws)?;
        let self_heating = self.self_heating(laws, [element.material, mate])?;
        let damping = laws.damping.as_ref().map(NormalDamping::from);
        let regime = laws.boundary_friction.as_ref().map(LubricationRegime::from);
        Ok(LineContact {
            elastic,
            profile: None,
            damping,
            film,
            traction,
            self_heating,
            regime,
            rolling_resistance: None,
            edge_friction: None,
        })
    }

    /// Traction of a full film.
    pub(in crate::pairs) fn traction(&self, laws: &ContactLaws) -> Result<Option<Traction>> {
        let Some(scene::TractionLaw::MurakiKimura) = laws.traction else { return Ok(None) };
        let lubricant = self.lubricant("traction")?;
        let path = "lubricant.shear_modulus";
        Ok(Some(Traction::new(
            self.viscosity("traction")?,
            self.pressure_viscosity("traction")?,
            self.eyring_stress("traction")?,
            needed(path, lubricant.shear_modulus, &self.law("traction"))?,
        )))
    }

    /// Self-heating of a film between an element and a mate of these materials.
    pub(in crate::pairs) fn self_heating(
        &self,
        laws: &ContactLaws,
        [element, mate]: [&str; 2],
    ) -> Result<Option<SelfHeating>> {
        let Some(scene::SelfHeating::FilmAndFlash) = laws.self_heating else { return Ok(None) };
        Ok(Some(SelfHeating {
            temperature_viscosity: self.temperature_viscosity("self_heating")?,
            conductivity: self.conductivity("self_heating")?,
            eyring_stress: self.eyring_stress("self_heating")?,
            thermal_product_1: self.thermal_product(element, "self_heating")?,
            thermal_product_2: self.thermal_product(mate, "self_heating")?,
            acts: 1.0,
        }))
    }

    /// Profile of the contact of a roller with a raceway whose crown has this radius, m.
    fn profile(&self, laws: &scene::Raceways, raceway_crown: Option<f64>) -> Result<Option<Profile>> {
        let Some(rollers) = &self.scene.rollers else { return Ok(None) };
        let length = rollers.effective_length;
        let (logarithm, roller_crown) = match &rollers.profile {
            None => (None, None),
            Some(RollerProfile::CircularCrown { radius }) => (None, Some(*radius)),
            // Of single rollers.
            Some(RollerProfile::Table(_)) => (None, None),
            Some(RollerProfile::Logarithmic(profile)) => {
                let steel = self.material("rollers.material", &rollers.material)?;
                let [young, poisson] = [steel.young_modulus, steel.poisson_ratio];
                let modulus = effective_modulus(young, poisson, young, poisson);
                let scale = Logarithm::scale_of(profile.design_load, profile.load_factor, length, modulus);
                (Some(Logarithm::new(scale, length, profile.crowned_share, profile.end_drop)), None)
            }
        };
        let slices = laws.slices.map_or(USUAL_SLICES, |n| n as usize);
        Ok(Profile::new(length, logarithm, [roller_crown, raceway_crown], slices))
    }

    /// A contact with a raceway of the given material, whose crown has this radius, m.
    pub(crate) fn raceway(
        &self,
        laws: &scene::Raceways,
        mate: &str,
        equivalent_radius: f64,
        crown: Option<f64>,
    ) -> Result<LineContact> {
        let mut law = self.line_contact(&laws.contact, mate, equivalent_radius)?;
        law.profile = self.profile(laws, crown)?;
        if let Some(rolling) = &laws.rolling_resistance {
            let extent = Extent::from(&rolling.extent);
            let builder = self.at("raceways");
            let by = "rolling_resistance";
            let film = RollingFilm {
                line: &law.elastic,
                viscosity: builder.viscosity(by)?,
                pressure_viscosity: builder.pressure_viscosity(by)?,
            };
            let isothermal = match rolling.law {
                None | Some(scene::RollingLaw::ZhouHoeprich) => {
                    Isothermal::ZhouHoeprich(ZhouHoeprich::new(&film))
                }
                Some(scene::RollingLaw::RigidLimit) => Isothermal::RigidLimit(RigidLimit::new(&film)),
                Some(scene::RollingLaw::BibouletHoupert | scene::RollingLaw::Houpert) => {
                    let text = "a law of balls; of rollers 'zhou_hoeprich' or 'rigid_limit'";
                    return Err(bad_scene("raceways.rolling_resistance.law", text));
                }
            };
            let sliding = rolling.inlet_sliding.as_ref().map(|of| {
                let (rigid, elastic) = (of.rigid_ratio, of.elastic_ratio);
                InletSliding::new(&film, rigid.unwrap_or(RIGID_RATIO), elastic.unwrap_or(ELASTIC_RATIO))
            });
            let thermal = builder.thermal_load(by)?;
            let resistance = RollingResistance::new(isothermal, &law.elastic, thermal, extent);
            law.rolling_resistance = Some(RollingResistance { sliding, ..resistance });
        }
        Ok(law)
    }
}

impl From<&scene::ContactDamping> for NormalDamping {
    fn from(law: &scene::ContactDamping) -> Self {
        Self { relaxation_time: law.relaxation_time, softening_depth: law.softening_depth }
    }
}

impl From<&scene::BoundaryFriction> for LubricationRegime {
    fn from(law: &scene::BoundaryFriction) -> Self {
        Self {
            boundary: SolidFriction { coefficient: law.coefficient, transition_speed: law.transition_speed },
            lambda_boundary: law.lambda_boundary,
            lambda_full: law.lambda_full,
            roughness: law.roughness,
        }
    }
}

impl From<&scene::Extent> for Extent {
    fn from(extent: &scene::Extent) -> Self {
        match *extent {
            scene::Extent::All => Self::All,
            scene::Extent::Loaded { threshold } => Self::Loaded { threshold },
        }
    }
}

impl From<&scene::SolidContact> for SolidContact {
    fn from(law: &scene::SolidContact) -> Self {
        Self {
            stiffness: law.stiffness,
            damping: law.damping,
            softening_depth: law.softening_depth,
            friction: law.friction.as_ref().map(SolidFriction::from),
        }
    }
}

impl From<&scene::Friction> for SolidFriction {
    fn from(law: &scene::Friction) -> Self {
        Self { coefficient: law.coefficient, transition_speed: law.transition_speed }
    }
}
