//! Usual ranges of numbers of round pockets, which both kinds of them share.

use super::groups::{Group, SIZE, SOFT, UNUSUAL, WEAK, group};
use super::scales::damping;
use crate::scene::check::range;
use crate::scene::*;

/// Those of one kind: its name in a scene, and its variant.
macro_rules! round {
    ($name:literal, $kind:ident) => {{
        fn pocket(s: &Scene) -> Option<&RoundPocket> {
            match s.cage.as_ref()?.pocket.as_ref()? {
                Pocket::$kind(pocket) => Some(pocket),
                _ => None,
            }
        }
        [
            group(
                concat!("cage.pocket.", $name, ".diametral_clearance"),
                SIZE,
                |s| Some((pocket(s)?.diametral_clearance, range(1e-3, 1.0, "m").times(s.element_radius()))),
                UNUSUAL,
            ),
            group(
                concat!("cage.pocket.", $name, ".axial_clearance"),
                SIZE,
                |s| Some((pocket(s)?.axial_clearance?, range(1e-3, 1.0, "m").times(s.element_radius()))),
                UNUSUAL,
            ),
            group(
                concat!("cage.pocket.", $name, ".law.spring.stiffness"),
                &["cage.mass", concat!("cage.pocket.", $name, ".diametral_clearance")],
                |s| Some((pocket(s)?.spring()?.stiffness, s.stiffnesses(pocket(s)?.diametral_clearance)?)),
                SOFT,
            ),
            group(
                concat!("cage.pocket.", $name, ".law.spring.damping"),
                &[concat!("cage.pocket.", $name, ".law.spring.stiffness"), "cage.mass"],
                |s| {
                    let contact = pocket(s)?.spring()?;
                    Some((contact.damping, damping(contact.stiffness, s.cage.as_ref()?.mass)))
                },
                WEAK,
            ),
        ]
    }};
}

/// Groups of both kinds.
pub(super) const ROUND: [[Group; 4]; 2] =
    [round!("solid_cylinder", SolidCylinder), round!("solid_sphere", SolidSphere)];
