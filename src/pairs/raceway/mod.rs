//! The raceways: contacts of all rollers with the outer and with the inner ring.

mod kinematics;
mod slopes;

pub(crate) use kinematics::{RacewayGeometry, RingMotion};

use crate::bodies::{Fault, ForceSource, INNER_RING, Motions, OUTER_RING, Power};
use crate::error::Result;
use crate::laws::line_contact::LineContact;
use crate::pairs::line_laws::LawBuilder;
use crate::pairs::{Batch, ContactLaw, Cost, ElementPair, Law, PairInfo, Search, SlopeSums};
use crate::scalar::{Columns, Pack, dispatch};
use crate::scene::needed;
use crate::space::rotate;
use pulp::Simd;
use std::ops::Range;

/// The contacts of all rollers with one ring.
#[derive(Debug)]
struct Raceway {
    geometry: RacewayGeometry,
    law: LineContact,
    ring: &'static PairInfo,
}

static OUTER: PairInfo = PairInfo {
    mate: OUTER_RING,
    source: ForceSource::OuterRaceway,
    contacts: &["outer_raceway"],
    laws: [Some(Law::OuterRaceway), None],
    powers: [Power::RacewayDamping, Power::RacewayFriction],
    rolls: true,
};

static INNER: PairInfo = PairInfo {
    mate: INNER_RING,
    source: ForceSource::InnerRaceway,
    contacts: &["inner_raceway"],
    laws: [Some(Law::InnerRaceway), None],
    powers: [Power::RacewayDamping, Power::RacewayFriction],
    rolls: true,
};

/// Geometry and laws of the raceways of outer and inner ring of a scene, if its rollers have laws.
fn laws_of(builder: &LawBuilder<'_>) -> Result<Option<(RacewayGeometry, [LineContact; 2])>> {
    let scene = builder.scene();
    let (Some(_), Some(laws)) = (&scene.rollers, &scene.raceways) else { return Ok(None) };
    let this = builder.at("raceways.contact");
    let rings = (scene.outer_ring.as_ref(), scene.inner_ring.as_ref());
    let outer_ring = needed("outer_ring", rings.0, "raceways")?;
    let (outer, radius) = (outer_ring.raceway_radius, scene.element_radius());
    let geometry = RacewayGeometry::new(outer, radius, scene.radial_clearance());
    let inner = geometry.inner_radius(outer);
    let inner_material = rings.1.and_then(|ring| ring.material.as_deref());
    let inner_material = needed("inner_ring.material", inner_material, "raceways")?;
    let laws = [
        this.raceway(laws, &outer_ring.material, 1.0 / (1.0 / radius - 1.0 / outer))?,
        this.raceway(laws, inner_material, 1.0 / (1.0 / radius + 1.0 / inner))?,
    ];
    Ok(Some((geometry, laws)))
}

/// The raceway of the outer ring of a scene, if its rollers have laws.
pub(super) fn outer(laws: &LawBuilder<'_>) -> Result<Option<Box<dyn ElementPair>>> {
    let Some((geometry, [law, _])) = laws_of(laws)? else { return Ok(None) };
    Ok(Some(Box::new(Raceway { geometry, law, ring: &OUTER })))
}

/// That of the inner ring.
pub(super) fn inner(laws: &LawBuilder<'_>) -> Result<Option<Box<dyn ElementPair>>> {
    let Some((geometry, [_, law])) = laws_of(laws)? else { return Ok(None) };
    Ok(Some(Box::new(Raceway { geometry, law, ring: &INNER })))
}

impl ElementPair for Raceway {
    fn info(&self) -> &'static PairInfo {
        self.ring
    }

    fn law(&self) -> ContactLaw {
        ContactLaw::Line(self.law)
    }

    fn find(&self, motions: &Motions, out: &mut Search<'_>) -> std::result::Result<(), Fault> {
        let Search { touching, gaps, .. } = out;
        let geometry = &self.geometry;
        if self.ring.mate == OUTER_RING {
            for (j, motion) in motions.elements.iter().enumerate() {
                if is_touching(motion.radial_offset - geometry.gap) {
                    let (contact, grip) = geometry.outer(motion);
                    touching.push(j, 0, grip, 0.0, &contact);
                }
            }
            return Ok(());
        }
        let ring = &motions.shared[INNER_RING];
        let n = motions.elements.len();
        let approach = &mut gaps[0];
        dispatch(motions.instructions, Approach { motions, geometry, ring: ring.position, n, approach });
        for (j, (motion, approach)) in motions.elements.iter().zip(&gaps[0]).enumerate() {
            if is_touching(*approach) {
                let frame = motions.frame(j);
                let (position, velocity) = (frame.to_local(ring.position), frame.to_local(ring.velocity));
                let seen = RingMotion { position, velocity, speed: ring.speed };
                let (contact, grip) = geometry.inner(motion, &seen);
                touching.push(j, 0, grip, 0.0, &contact);
            }
        }
        Ok(())
    }

    fn add_slopes(&self, batch: &Batch, contacts: Range<usize>, motions: &Motions, sums: &mut SlopeSums<'_>) {
        for i in contacts {
            if self.ring.mate == OUTER_RING {
                slopes::add_outer(&self.geometry, batch, i, motions, sums);
            } else {
                slopes::add_inner(&self.geometry, batch, i, motions, sums);
            }
        }
    }

    fn cost(&self) -> Cost {
        Cost { value: 110.0, slopes: 150.0, per_element: true }
    }
}

/// A NaN approach counts as contact, so that it reaches the accelerations and is reported.
#[inline]
fn is_touching(approach: f64) -> bool {
    approach > 0.0 || approach.is_nan()
}

/// Finds the approach of all rollers to the inner raceway.
struct Approach<'a> {
    motions: &'a Motions,
    geometry: &'a RacewayGeometry,
    ring: [f64; 2],
    n: usize,
    approach: &'a mut [f64],
}

impl Columns for Approach<'_> {
    fn rows(&self) -> usize {
        self.n
    }

    #[inline(always)]
    fn group<S: Simd, const K: usize>(&mut self, simd: S, first: usize) {
        let places = &self.motions.places;
        let all = |x: f64| Pack::<S, K>::all(simd, x);
        let load = |column: &[f64]| Pack::load(simd, &column[first..]);
        let [sin, cos] = [load(&places.direction[0]), load(&places.direction[1])];
        let ring = rotate([all(self.ring[0]), all(self.ring[1])], -sin, cos);
        let approach = self.geometry.inner_approach(load(&places.radial_offset), ring);
        approach.store(&mut self.approach[first..]);
    }
}
