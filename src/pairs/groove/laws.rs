//! From the blocks of a scene to the laws of balls in their grooves.

use crate::error::Result;
use crate::laws::elastic::normal::NormalDamping;
use crate::laws::elastic::point::ElasticPoint;
use crate::laws::film::ellipse::EllipseFilm;
use crate::laws::film::regime::LubricationRegime;
use crate::laws::point_contact::{PointContact, PointResistance};
use crate::laws::rolling::Extent;
use crate::laws::rolling::point::PointRolling;
use crate::laws::traction::ellipse::{EllipseRule, EllipseTraction};
use crate::pairs::line_laws::LawBuilder;
use crate::scalar::math;
use crate::scene::{self, EllipseNodes, Raceways, RollingLaw, bad_scene, needed};

/// Strips and places of the sums over an ellipse, and of those for its temperature.
fn rules(nodes: EllipseNodes) -> [EllipseRule; 2] {
    let of = |[strips, places]: [usize; 2]| EllipseRule::new(strips, places);
    match nodes {
        EllipseNodes::Coarse => [[8, 2], [8, 2]],
        EllipseNodes::Standard => [[16, 2], [8, 2]],
        EllipseNodes::Fine => [[32, 4], [32, 4]],
    }
    .map(of)
}

/// Laws of the contacts of balls with a race; `materials` are those of both, `pressed_radius` is R_d, m.
pub(super) fn point_contact(
    builder: &LawBuilder<'_>,
    laws: &Raceways,
    materials: [&str; 2],
    elastic: &ElasticPoint,
    pressed_radius: f64,
) -> Result<PointContact> {
    let this = builder.at("raceways.contact");
    let contact = &laws.contact;
    let thermal = match contact.thermal_correction {
        None => None,
        Some(scene::ThermalCorrection::Gupta) => Some(this.thermal_load("thermal_correction")?),
        Some(scene::ThermalCorrection::GhoshPandey) => {
            return Err(bad_scene(&this.law("thermal_correction"), "a law of rollers; of balls 'gupta'"));
        }
    };
    let film = match contact.film {
        None => None,
        Some(scene::FilmLaw::HamrockDowson) => {
            let (viscosity, alpha) = (this.viscosity("film")?, this.pressure_viscosity("film")?);
            Some(EllipseFilm::new(elastic, viscosity, alpha, thermal))
        }
        Some(scene::FilmLaw::PanHamrock) => {
            return Err(bad_scene(&this.law("film"), "a law of rollers; of balls 'hamrock_dowson'"));
        }
    };
    let traction = match contact.traction {
        None => None,
        Some(scene::TractionLaw::MurakiKimura) => {
            let [rule, temperature_rule] = rules(laws.ellipse.unwrap_or_default());
            let modulus = this.lubricant("traction")?.shear_modulus;
            let eyring_stress = this.eyring_stress("traction")?;
            Some(EllipseTraction {
                rule,
                temperature_rule,
                ln_time: math::ln(this.viscosity("traction")? / eyring_stress),
                pressure_viscosity: this.pressure_viscosity("traction")?,
                eyring_stress,
                shear_modulus: needed("lubricant.shear_modulus", modulus, &this.law("traction"))?,
                pressed_radius,
                self_heating: this.self_heating(contact, materials)?,
            })
        }
    };
    let rolling_resistance = match &laws.rolling_resistance {
        None => None,
        Some(resistance) => {
            let (this, by) = (builder.at("raceways"), "rolling_resistance");
            let viscosity = this.viscosity(by)?;
            let law = match resistance.law {
                None | Some(RollingLaw::BibouletHoupert) => {
                    PointRolling::biboulet_houpert(elastic, viscosity)
                }
                Some(RollingLaw::Houpert) => {
                    PointRolling::houpert(elastic, viscosity, this.pressure_viscosity(by)?)
                }
                Some(RollingLaw::ZhouHoeprich | RollingLaw::RigidLimit) => {
                    let text = "a law of rollers; of balls 'biboulet_houpert' or 'houpert'";
                    return Err(bad_scene("raceways.rolling_resistance.law", text));
                }
            };
            let extent = Extent::from(&resistance.extent);
            Some(PointResistance { law, thermal: Some(this.thermal_load(by)?), extent })
        }
    };
    Ok(PointContact {
        damping: contact.damping.as_ref().map(NormalDamping::from),
        film,
        traction,
        regime: contact.boundary_friction.as_ref().map(LubricationRegime::from),
        rolling_resistance,
    })
}
