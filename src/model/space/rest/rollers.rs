//! Rollers at rest beside a ring that shifts and tilts: each yields along its radius and tilts with the ring.
//!
//! ```text
//! y = (x, rho, a tau),   a = l/2
//! Sum Q f_x = 0,   Sum Q f_r + m psi'^2 r = 0,   Sum Q m_psi = 0   over the slices of both raceways and the ribs
//! ```
//!
//! Rollers do not skew: raceways do not hold them, which ribs, pockets and friction do. Along the axis cylinders are held by ribs alone, and stay in the middle
//! without these. They go round with the speed that they roll at; their weight is left out, as in the plane.

use super::OF_RING;
use super::ball::{OnRing, following};
use super::ring::{RingAtRest, SettledRing, beside};
use super::settle::{Balance, Rest, settle};
use crate::bodies::{ElementSet, MovingRing, MovingRoller, RingInSpace, RollerPlace};
use crate::error::{Error, Result, Status};
use crate::laws::elastic::surface::Surface;
use crate::laws::elastic::tilted::{Along, Slice};
use crate::laws::line_contact::LineContact;
use crate::model::HostInputs;
use crate::model::plane::{Plane, StillBearing};
use crate::model::space::rollers::{AT_ONCE, Pass, Varied};
use crate::pairs::groove::RingPlace;
use crate::pairs::raceway::{Cones, Disc, RacewayGeometry};
use crate::pairs::roller::{EndPair, Shapes, Spot, SpotLaw, UnitWrench};
use crate::scalar::{Dual, Of, Real, math};
use crate::space::solid::{LARGEST_TILT, Moving, Tilt, cross, difference, scaled, sum};
use nalgebra::{Matrix5, SMatrix, SVector, Vector5};

/// What a roller yields by: x, rho and a tau, m.
const OF_ROLLER: usize = 3;
/// With the coordinates of the ring.
const ALL: usize = OF_ROLLER + OF_RING;
/// Share of the stiffness of a lightly pressed contact along the axis that holds a roller between ribs that it does not touch, where it follows the ring.
const BETWEEN_RIBS: f64 = 1e-9;
/// Share of the loads of a roller that its friction holds along the axis at least: between ribs nothing else tells where it is.
const HELD_BY_FRICTION: f64 = 1e-5;
/// Load of a lightly pressed contact, N.
const LIGHTLY: f64 = 1.0;

/// Ring `k` where the inner one is at `ring`, in the axes of the roller.
fn ring_at<T: Of<f64>>(k: usize, ring: [T; OF_RING]) -> RingPlace<T> {
    let zero = ring[0].like(0.0);
    match k {
        0 => RingPlace { centre: [zero; 3], axis: [zero.like(1.0), zero, zero] },
        _ => RingPlace { centre: [ring[0], ring[1], ring[2]], axis: Tilt::new([ring[3], ring[4]]).axis },
    }
}

/// A raceway along a roller.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct OnRaceway<T> {
    /// Q, N.
    pub(crate) load: T,
    /// On the roller about the axis along the orbit, N m.
    pub(crate) moment: T,
    /// Share of the length that is loaded.
    pub(crate) loaded: f64,
}

/// An end on a rib.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct OnRib<T> {
    /// delta, m, and Q, N.
    pub(crate) approach: T,
    pub(crate) load: T,
    /// On the roller about the axis along the orbit, N m.
    pub(crate) moment: T,
}

/// Forces at one place of roller and ring.
struct Forces<T> {
    /// Over x, rho and a tau, N.
    on_roller: [T; OF_ROLLER],
    /// On the ring over its coordinates, N and N m.
    on_ring: [T; OF_RING],
    raceways: [OnRaceway<T>; 2],
    /// Of all ribs, N.
    on_ribs: f64,
    /// Elastic, J.
    energy: f64,
}

/// A roller beside a ring.
struct Contact<'a, T> {
    geometry: &'a RacewayGeometry,
    profile: Option<&'a Surface>,
    /// m.
    excess: f64,
    roller: RollerPlace<T>,
    /// With its number.
    ring: (usize, RingPlace<T>),
}

impl<T: Of<f64>> Contact<'_, T> {
    /// The disc at `s`, m.
    fn disc(&self, s: f64) -> Disc<T> {
        self.geometry.disc(
            (self.ring.0, &self.ring.1),
            &self.roller,
            self.profile,
            self.excess,
            self.roller.rho.like(s),
        )
    }
}

/// Rollers between their raceways.
pub(crate) struct Rollers<'a> {
    geometry: RacewayGeometry,
    /// Of outer and inner raceway.
    laws: [&'a LineContact; 2],
    /// By how much each radius is larger than nominal, m.
    excess: &'a [f64],
    shapes: Shapes,
    /// What holds their ends.
    ends: &'a [EndPair],
    pub(crate) azimuths: Vec<f64>,
    /// On each, N.
    centrifugal: f64,
    /// Whether friction holds rollers that lie between ribs: only where they find no rest without.
    held_by_friction: bool,
}

/// The equilibrium of ring and rollers.
pub(crate) struct SettledRollers<'a> {
    pub(crate) rollers: Rollers<'a>,
    pub(crate) ring: SettledRing,
    /// x, rho and a tau of each, m.
    pub(crate) places: Vec<[f64; OF_ROLLER]>,
}

impl SettledRollers<'_> {
    /// x and rho (m) and tau (rad) of roller `j`.
    pub(crate) fn place(&self, j: usize) -> [f64; OF_ROLLER] {
        let [x, rho, tilted] = self.places[j];
        [x, rho, tilted / self.rollers.half_length()]
    }

    /// Approach (m) of raceway `k` at `s` (m) along roller `j`.
    pub(crate) fn approach(&self, j: usize, k: usize, s: f64) -> f64 {
        let Self { rollers, ring, places } = self;
        rollers.contact(j, k, places[j], (rollers.beside(j) * ring.at).into()).disc(s).delta
    }

    /// Load per length of raceway `k` at this approach (m), N/m.
    pub(crate) fn line_load(&self, k: usize, approach: f64) -> f64 {
        let elastic = &self.rollers.law(k).elastic;
        elastic.load(approach) / elastic.length
    }
}

impl Rollers<'_> {
    fn half_length(&self) -> f64 {
        0.5 * self.laws[0].elastic.length
    }

    /// Coordinates of the ring beside roller `j`, by row, over those of the bearing.
    fn beside(&self, j: usize) -> Matrix5<f64> {
        beside(math::sin_cos(self.azimuths[j]))
    }

    /// Roller `j` beside ring `k`, each with its own place.
    fn contact<T: Of<f64>>(
        &self,
        j: usize,
        k: usize,
        at: [T; OF_ROLLER],
        ring: [T; OF_RING],
    ) -> Contact<'_, T> {
        let profile = self.shapes.surface(k, j);
        let (roller, ring) = (self.roller(at), (k, ring_at(k, ring)));
        Contact { geometry: &self.geometry, profile, excess: self.excess[j], roller, ring }
    }

    /// A roller at `at`.
    fn roller<T: Of<f64>>(&self, [x, rho, tilted]: [T; OF_ROLLER]) -> RollerPlace<T> {
        let tilt = Tilt::new([x.like(0.0), tilted / self.half_length()]);
        RollerPlace { x, rho, axis: self.geometry.cones.inclination.turned(tilt.axis) }
    }

    /// Ends on ribs: the ring, the law's load, and the unit wrench on the roller.
    fn on_ribs<T: Of<f64> + Real>(
        &self,
        j: usize,
        at: [T; OF_ROLLER],
        ring: [T; OF_RING],
    ) -> impl Iterator<Item = (usize, OnRib<T>, UnitWrench<T>, &SpotLaw)> {
        let still = |at: T| Moving { velocity: [at.like(0.0); 3], turning: [at.like(0.0); 3] };
        let roller = MovingRoller { place: self.roller(at), moving: still(at[0]) };
        self.ends.iter().filter(|end| end.is_rib()).map(move |end| {
            let RingPlace { centre, axis } = ring_at(end.mate, ring);
            let mate = MovingRing { centre, axis, moving: still(at[0]), speed: at[0].like(0.0) };
            let Spot { delta, normal, .. } = end.geometry.touch(&roller, &mate, self.shapes.longer(j)).spot;
            let load = end.law.elastic_load(delta);
            let moment = normal[1][2] * load;
            (end.mate, OnRib { approach: delta, load, moment }, normal, &end.law)
        })
    }

    /// Slices of the loaded part of raceway `k` along roller `j`.
    fn slices(&self, j: usize, k: usize, at: [f64; OF_ROLLER], ring: [f64; OF_RING]) -> Vec<Slice> {
        let half_length = self.shapes.half_length(j);
        let straight = Contact { profile: None, ..self.contact(j, k, at, ring) };
        let bare = [-half_length, 0.0, half_length].map(|s| straight.disc(s));
        let along = Along {
            profile: self.shapes.surface(k, j),
            half_length,
            approach: Along::parabola(half_length, bare.map(|disc| disc.delta)),
            in_raceway: [bare[1].in_raceway, (bare[2].in_raceway - bare[0].in_raceway) / (2.0 * half_length)],
        };
        let mut slices = Vec::new();
        along.slices(&mut slices);
        // Shares of the nominal length, which the law has.
        let longer = half_length / self.half_length();
        for slice in &mut slices {
            slice.share *= longer;
        }
        slices
    }

    /// Forces with these slices of both raceways.
    fn forces<T: Of<f64> + Real>(
        &self,
        j: usize,
        at: [T; OF_ROLLER],
        ring: [T; OF_RING],
        slices: &[Vec<Slice>; 2],
    ) -> Forces<T> {
        let zero = at[0].like(0.0);
        let none = OnRaceway { load: zero, moment: zero, loaded: 0.0 };
        let mut out = Forces {
            on_roller: [zero, zero + self.centrifugal, zero],
            on_ring: [zero; OF_RING],
            raceways: [none; 2],
            on_ribs: 0.0,
            energy: 0.0,
        };
        let from_ring =
            difference([at[0], at[1] + self.geometry.pitch_radius, zero], [ring[0], ring[1], ring[2]]);
        let (mut pushed, mut turned) = ([zero; 3], [zero; 3]);
        for (k, (law, slices)) in self.laws.into_iter().zip(slices).enumerate() {
            let contact = self.contact(j, k, at, ring);
            for slice in slices {
                let disc = contact.disc(slice.place);
                let load = law.elastic.load(disc.delta) * slice.share;
                let moment = scaled(disc.on_roller, load);
                let on_raceway = &mut out.raceways[k];
                on_raceway.loaded += slice.share;
                on_raceway.load += load;
                on_raceway.moment += moment[2];
                out.on_roller[0] -= load * disc.normal[0];
                out.on_roller[1] -= load * disc.normal[1];
                // Palmgren's law: the energy at the approach delta is 9/19 Q delta.
                out.energy += load.base() * disc.delta.base() * (9.0 / 19.0);
                if k == 1 {
                    let force = scaled(disc.normal, load);
                    let about_ring = difference(cross(from_ring, force), moment);
                    (pushed, turned) = (sum(pushed, force), sum(turned, about_ring));
                }
            }
        }
        let mut moments = out.raceways[0].moment + out.raceways[1].moment;
        for (mate, on_rib, [force, moment], law) in self.on_ribs(j, at, ring) {
            out.on_roller[0] += on_rib.load * force[0];
            out.on_roller[1] += on_rib.load * force[1];
            out.on_ribs += on_rib.load.base();
            moments += on_rib.moment;
            out.energy += law.energy(on_rib.approach.base());
            if mate == 1 {
                let (force, moment) = (scaled(force, -on_rib.load), scaled(moment, on_rib.load));
                let about_ring = difference(cross(from_ring, force), moment);
                (pushed, turned) = (sum(pushed, force), sum(turned, about_ring));
            }
        }
        out.on_roller[2] = moments / self.half_length();
        if !self.held_along() {
            // Nothing tells where it is along the axis: it stays there.
            out.on_roller[0] = -(at[0] * self.laws[0].elastic.stiffness_at_load(LIGHTLY));
        }
        let [over_r, over_psi] = Tilt::new([ring[3], ring[4]]).moments_over_angles(turned);
        out.on_ring = [pushed[0], pushed[1], pushed[2], over_r, over_psi];
        out
    }

    /// With their derivatives over the roller and the ring, at slices that stay.
    fn slopes(&self, j: usize, at: [f64; OF_ROLLER], ring: [f64; OF_RING]) -> Forces<Dual<ALL>> {
        let slices = [0, 1].map(|k| self.slices(j, k, at, ring));
        let variable = |k: usize, first: usize| {
            let value = if k < OF_ROLLER { at[k] } else { ring[k - OF_ROLLER] };
            Pass { first }.variable(value, k)
        };
        // As many directions at once as in motion, whose code this is.
        let pass = |first: usize| {
            let at = std::array::from_fn(|k| variable(k, first));
            self.forces(j, at, std::array::from_fn(|k| variable(OF_ROLLER + k, first)), &slices)
        };
        let [low, high] = [pass(0), pass(AT_ONCE)];
        let joined = |low: Varied, high: Varied| {
            let eps = |d: usize| if d < AT_ONCE { low.eps[d] } else { high.eps[d - AT_ONCE] };
            Dual { re: low.re, eps: std::array::from_fn(eps) }
        };
        let on_raceway = |k: usize| {
            let (low, high) = (low.raceways[k], high.raceways[k]);
            let (load, moment) = (joined(low.load, high.load), joined(low.moment, high.moment));
            OnRaceway { load, moment, loaded: low.loaded }
        };
        let mut on_roller = std::array::from_fn(|k| joined(low.on_roller[k], high.on_roller[k]));
        let loads = low.raceways[0].load.re + low.raceways[1].load.re + self.centrifugal;
        if self.rolls_between_ribs(low.on_ribs) && on_roller[0].re.abs() <= HELD_BY_FRICTION * loads {
            on_roller[0] = Dual { re: 0.0, eps: [0.0; ALL] };
            on_roller[0].eps[0] = -self.laws[0].elastic.stiffness_at_load(LIGHTLY);
        }
        Forces {
            on_roller,
            on_ring: std::array::from_fn(|k| joined(low.on_ring[k], high.on_ring[k])),
            raceways: [on_raceway(0), on_raceway(1)],
            on_ribs: low.on_ribs,
            energy: low.energy,
        }
    }

    /// Energy that falls along the forces on the roller, J.
    fn energy(&self, at: [f64; OF_ROLLER], forces: &Forces<Dual<ALL>>) -> f64 {
        forces.energy - self.centrifugal * at[1]
    }

    /// Where roller `j` rests beside a ring at these coordinates in its axes; `None` where it finds none.
    fn rest(&self, j: usize, ring: [f64; OF_RING]) -> Option<[f64; OF_ROLLER]> {
        let gap = self.geometry.gap - self.excess[j];
        let outside = gap + self.laws[0].approach(self.centrifugal);
        // In the middle of what the ring leaves.
        let along = if self.held_along() { 0.5 * ring[0] } else { 0.0 };
        let start = SVector::from([along, outside.max(0.5 * ring[1]), 0.5 * ring[4] * self.half_length()]);
        let soft = 1e-3 * self.laws[0].elastic.stiffness_at_load(LIGHTLY);
        let found = settle(start, soft, &mut |at| {
            let tilt = at[2].abs() / self.half_length();
            if at[0].abs().max(at[1].abs()) > self.geometry.roller_radius || tilt > LARGEST_TILT {
                return None;
            }
            let forces = self.slopes(j, (*at).into(), ring);
            Some(Balance {
                force: SVector::from(forces.on_roller.map(|force| force.re)),
                stiffness: SMatrix::from_fn(|i, k| -forces.on_roller[i].eps[k]),
                energy: self.energy((*at).into(), &forces),
                size: forces.raceways.iter().map(|raceway| raceway.load.re).sum::<f64>() + self.centrifugal,
            })
        });
        found.ok().map(|rest| rest.x.into())
    }

    /// x, rho and a tau (m) of all rollers at rest beside a ring at these coordinates; `None` where one finds none.
    fn places(&self, ring: &Vector5<f64>) -> Option<Vec<[f64; OF_ROLLER]>> {
        (0..self.azimuths.len()).map(|j| self.rest(j, (self.beside(j) * ring).into())).collect()
    }

    /// What rollers at these places do to the ring.
    fn on_ring(&self, ring: &Vector5<f64>, places: &[[f64; OF_ROLLER]]) -> Balance<OF_RING> {
        let mut total =
            Balance { force: Vector5::zeros(), stiffness: Matrix5::zeros(), energy: 0.0, size: 0.0 };
        let least = if self.held_along() {
            BETWEEN_RIBS * self.laws[0].elastic.stiffness_at_load(LIGHTLY)
        } else {
            0.0
        };
        for (j, at) in places.iter().enumerate() {
            let turned = self.beside(j);
            let forces = self.slopes(j, *at, (turned * ring).into());
            let energy = self.energy(*at, &forces);
            let OnRing { force, stiffness, energy } =
                following(&forces.on_roller, &forces.on_ring, energy, least);
            total.force += turned.transpose() * force;
            total.stiffness += turned.transpose() * stiffness * turned;
            total.energy += energy;
            total.size += force.fixed_rows::<3>(0).norm();
        }
        total
    }

    /// Loads and moments of both raceways of roller `j`, which is at `at` beside a ring at `ring` in its axes.
    pub(crate) fn raceways(
        &self,
        j: usize,
        at: [f64; OF_ROLLER],
        ring: &Vector5<f64>,
    ) -> [OnRaceway<f64>; 2] {
        let ring = (self.beside(j) * ring).into();
        let slices = [0, 1].map(|k| self.slices(j, k, at, ring));
        self.forces(j, at, ring, &slices).raceways
    }

    /// Ends of a roller at `at` beside a ring at `ring` in its axes on the ribs of both rings, each with its name and largest pressure (Pa) and mean radius
    /// (m) of the contact.
    pub(crate) fn ribs(
        &self,
        j: usize,
        at: [f64; OF_ROLLER],
        ring: &Vector5<f64>,
    ) -> Vec<(&'static str, OnRib<f64>, [f64; 2])> {
        let ring = (self.beside(j) * ring).into();
        let names = self.ends.iter().filter(|end| end.is_rib()).map(|end| end.name);
        let told = |(_, on_rib, _, law): (usize, OnRib<f64>, UnitWrench<f64>, &SpotLaw)| {
            (on_rib, if on_rib.load > 0.0 { law.pressed(on_rib.load) } else { [0.0; 2] })
        };
        names
            .zip(self.on_ribs(j, at, ring).map(told))
            .map(|(name, (on_rib, pressed))| (name, on_rib, pressed))
            .collect()
    }

    /// Whether anything holds rollers along the axis.
    fn held_along(&self) -> bool {
        self.geometry.cones != Cones::NONE || self.ends.iter().any(|end| end.is_rib())
    }

    /// Whether a roller may lie anywhere between ribs, which bear this load (N).
    fn rolls_between_ribs(&self, on_ribs: f64) -> bool {
        self.held_by_friction && self.geometry.cones == Cones::NONE && self.held_along() && on_ribs == 0.0
    }

    /// Laws of raceway `k`.
    pub(crate) fn law(&self, k: usize) -> &LineContact {
        self.laws[k]
    }
}

/// Finds ring and rollers in the plane at rest at the start of the scene; rollers go round with `orbit`, rad/s.
///
/// # Errors
/// [`Status::BadState`] where there is no equilibrium, or none was found; [`Status::BadScene`] without raceways.
pub(crate) fn settled_rollers(plane: &Plane, orbit: f64) -> Result<SettledRollers<'_>> {
    let still = StillBearing::new(plane, orbit)
        .ok_or_else(|| Error::new(Status::BadScene, "raceways: missing; nothing presses on the rollers"))?;
    let shapes = Shapes::new(&plane.scene, still.laws, plane.elements.set().count);
    let rollers =
        Rollers::new(still.geometry, (still.laws, shapes, &[]), plane.elements.set(), still.centrifugal);
    let body = RingInSpace::new(&plane.scene);
    let inputs = plane.inputs.at(0.0, &HostInputs::default());
    rollers.settled(&body, body.load(&inputs))
}

impl<'a> Rollers<'a> {
    /// Rollers of this set between raceways with these laws and what holds their ends, under this centrifugal force, N.
    pub(in crate::model::space) fn new(
        geometry: RacewayGeometry,
        (laws, shapes, ends): ([&'a LineContact; 2], Shapes, &'a [EndPair]),
        set: &'a ElementSet,
        centrifugal: f64,
    ) -> Self {
        let (excess, azimuths) = (&set.radius_excess[..], set.reference_angles[..set.count].to_vec());
        Self { geometry, laws, shapes, excess, ends, azimuths, centrifugal, held_by_friction: false }
    }

    /// These at rest beside this ring under this load, N and N m.
    pub(in crate::model::space) fn settled(
        mut self,
        body: &RingInSpace,
        load: [f64; OF_RING],
    ) -> Result<SettledRollers<'a>> {
        let found = self.search(body, load).or_else(|e| {
            self.held_by_friction = true;
            if self.rolls_between_ribs(0.0) { self.search(body, load) } else { Err(e) }
        });
        let (ring, places) = found?;
        Ok(SettledRollers { rollers: self, ring, places })
    }

    /// The ring at rest, and x, rho and a tau of the rollers, m. Once in the library: it is long.
    #[inline(never)]
    fn search(
        &self,
        body: &RingInSpace,
        load: [f64; OF_RING],
    ) -> Result<(SettledRing, Vec<[f64; OF_ROLLER]>)> {
        let (pitch_radius, count) = (self.geometry.pitch_radius, self.azimuths.len());
        let soft = self.laws[0].elastic.stiffness_at_load(LIGHTLY);
        let reach = self.geometry.roller_radius;
        let bearing = RingAtRest { ring: body, load, pitch_radius, reach, soft };
        let mut on_ring = |ring: &Vector5<f64>| Some(self.on_ring(ring, &self.places(ring)?));
        let none = |at: Vector5<f64>| {
            let ring = bearing.unscaled(&at);
            let restless = (0..count).find(|j| self.rest(*j, (self.beside(*j) * ring).into()).is_none());
            let why = match restless {
                Some(j) => format!("roller[{j}] finds no rest"),
                None => "Newton's method found none".to_owned(),
            };
            Error::new(Status::BadState, format!("no equilibrium: {why}"))
        };
        let rest: Rest<OF_RING> = bearing.settled(bearing.start(), &mut on_ring).map_err(none)?;
        let at = bearing.unscaled(&rest.x);
        let places = self.places(&at).ok_or_else(|| none(rest.x))?;
        let ring = bearing.equilibrium(&rest, self.on_ring(&at, &places))?;
        Ok((ring, places))
    }
}
