//! The raceways: contacts of all rollers with the outer and with the inner ring.

mod cones;
mod disc;
mod kinematics;
mod wavy;

pub(crate) use cones::Cones;
pub(crate) use disc::{Disc, OffAxis};
pub(crate) use kinematics::{RacewayGeometry, RingMotion};

use crate::bodies::{
    ElementBlock, ElementMotion, Fault, ForceSource, INNER_RING, Motions, OUTER_RING, Power,
};
use crate::error::Result;
use crate::laws::contact_pair::ContactMotion;
use crate::laws::line_contact::LineContact;
use crate::pairs::contacts::{self, Kinematics, OverSpinAngle, Varied, VariedContact, add_slopes};
use crate::pairs::line_laws::LawBuilder;
use crate::pairs::{
    Ahead, Batch, ContactLaw, Cost, ElementPair, Found, Grip, Law, PairInfo, RelativeSlopes, Search,
    SlopeSums,
};
use crate::scalar::{Base, Columns, Numeric, Pack, dispatch, place_of};
use crate::scene::{Scene, needed};
use pulp::Simd;
use std::f64::consts::TAU;
use std::ops::Range;
use wavy::{Seen, Wave, Wavy};

/// The contacts of all rollers with one ring.
#[derive(Debug)]
struct Raceway {
    geometry: RacewayGeometry,
    law: LineContact,
    ring: &'static PairInfo,
    /// Whether it is that of an outer ring which is held in the centre.
    centred: bool,
    /// Waves of raceway and rollers, if they have any.
    wavy: Option<Wavy>,
}

static OUTER: PairInfo = PairInfo {
    mate: OUTER_RING,
    source: ForceSource::OuterRaceway,
    contacts: &["outer_raceway"],
    laws: [Some(Law::OuterRaceway), None],
    powers: [Power::RacewayDamping, Power::RacewayFriction],
    rolls: true,
    share: 1.0,
};

static INNER: PairInfo = PairInfo {
    mate: INNER_RING,
    source: ForceSource::InnerRaceway,
    contacts: &["inner_raceway"],
    laws: [Some(Law::InnerRaceway), None],
    powers: [Power::RacewayDamping, Power::RacewayFriction],
    rolls: true,
    share: 1.0,
};

/// Geometry and laws of the raceways of outer and inner ring of a scene, if its rollers have laws.
fn laws_of(builder: &LawBuilder<'_>) -> Result<Option<(RacewayGeometry, [LineContact; 2])>> {
    let scene = builder.scene();
    let (Some(_), Some(laws)) = (&scene.rollers, &scene.raceways) else { return Ok(None) };
    let this = builder.at("raceways.contact");
    let rings = (scene.outer_ring.as_ref(), scene.inner_ring.as_ref());
    let outer_ring = needed("outer_ring", rings.0, "raceways")?;
    let outer = needed("outer_ring.raceway_radius", outer_ring.raceway_radius, "raceways")?;
    let outer_material = needed("outer_ring.material", outer_ring.material.as_deref(), "raceways")?;
    let radius = scene.element_radius();
    let cones = Cones::new(scene.taper());
    let geometry = RacewayGeometry::new(outer, (radius, cones), scene.radial_clearance());
    let inner = geometry.inner_radius(outer);
    let inner_material = rings.1.and_then(|ring| ring.material.as_deref());
    let inner_material = needed("inner_ring.material", inner_material, "raceways")?;
    let crowns = [outer_ring.raceway_crown_radius, rings.1.and_then(|ring| ring.raceway_crown_radius)];
    // Of cones across their surfaces.
    let curvature = cones.roller.cos / radius;
    let of_rings = [-cones.raceways[0].cos / outer, cones.raceways[1].cos / inner];
    let laws = [
        this.raceway(laws, outer_material, 1.0 / (curvature + of_rings[0]), crowns[0])?,
        this.raceway(laws, inner_material, 1.0 / (curvature + of_rings[1]), crowns[1])?,
    ];
    Ok(Some((geometry, laws)))
}

/// The same of a scene, with the lubricant at `viscosity` in Pa s.
pub(crate) fn laws_of_scene(
    scene: &Scene,
    viscosity: Option<f64>,
) -> Result<Option<(RacewayGeometry, [LineContact; 2])>> {
    laws_of(&LawBuilder::new(scene, viscosity))
}

/// The raceway of the outer ring of a scene, if its rollers have laws.
pub(super) fn outer(laws: &LawBuilder<'_>) -> Result<Option<Box<dyn ElementPair>>> {
    let Some((geometry, [law, _])) = laws_of(laws)? else { return Ok(None) };
    let centred = laws.scene().outer_motion().is_none();
    let wavy = Wavy::of(laws.scene(), OUTER_RING);
    Ok(Some(Box::new(Raceway { geometry, law, ring: &OUTER, centred, wavy })))
}

/// That of the inner ring.
pub(super) fn inner(laws: &LawBuilder<'_>) -> Result<Option<Box<dyn ElementPair>>> {
    let Some((geometry, [_, law])) = laws_of(laws)? else { return Ok(None) };
    let wavy = Wavy::of(laws.scene(), INNER_RING);
    Ok(Some(Box::new(Raceway { geometry, law, ring: &INNER, centred: false, wavy })))
}

impl ElementPair for Raceway {
    fn info(&self) -> &'static PairInfo {
        self.ring
    }

    fn law(&self) -> ContactLaw {
        ContactLaw::Line(self.law)
    }

    fn find(&self, motions: &Motions, out: &mut Search<'_>) -> std::result::Result<(), Fault> {
        let Search { touching, found, .. } = out;
        let geometry = &self.geometry;
        let instructions = motions.instructions;
        match (self.centred, self.ring.mate) {
            (true, _) => dispatch(instructions, Outer { motions, geometry, found }),
            (false, OUTER_RING) => dispatch(instructions, Beside::<OUTER_RING> { motions, geometry, found }),
            (false, _) => dispatch(instructions, Beside::<INNER_RING> { motions, geometry, found }),
        }
        if let Some(wavy) = &self.wavy {
            for j in 0..motions.count {
                let (block, lane) = place_of(j);
                let Found { motion, grip, .. } = &mut found[block];
                let (mut at, mut held) = (motion.of(lane), grip.of(lane));
                wavy.put_on(geometry, motions, (self.ring.mate, j), (&mut at, &mut held));
                motion.set(lane, &at);
                grip.set(lane, &held);
            }
        }
        for j in 0..motions.count {
            let (block, lane) = place_of(j);
            let Found { motion, grip, .. } = &found[block];
            if is_touching(motion.delta[lane]) {
                touching.push(j, 0, &grip.of(lane), 0.0, &motion.of(lane));
            }
        }
        Ok(())
    }

    fn add_slopes(
        &self,
        batch: &Batch,
        contacts: Range<usize>,
        motions: &Motions,
        sums: &mut SlopeSums<'_>,
        memory: &mut RelativeSlopes,
    ) {
        add_slopes(self, batch, contacts, motions, sums, memory);
    }

    fn has_onset(&self) -> bool {
        self.wavy.is_some()
    }

    /// A share of the shortest wave that passes a contact.
    fn longest_step(&self, ahead: &Ahead<'_>) -> f64 {
        let Some(wavy) = &self.wavy else { return f64::INFINITY };
        let [of_raceway, of_rollers] = wavy.highest_orders();
        let ring = ahead.shared[self.ring.mate].speed;
        let rate = |j: usize| {
            let [orbit, spin] = [ahead.layout.element(j) + 1, ahead.layout.spin(j)].map(|i| ahead.v[i]);
            (of_raceway * (orbit - ring).abs()).max(of_rollers * (spin - orbit).abs())
        };
        let fastest = (0..ahead.layout.count).map(rate).fold(0.0, f64::max);
        TAU / (fastest * ahead.tuning.steps_per_period)
    }

    fn cost(&self) -> Cost {
        // Of one slice, as often as there are any; finding the contact is the smaller part.
        let slices = self.law.profile.map_or(1.0, |profile| profile.count() as f64);
        Cost { value: 110.0 * slices, slopes: 150.0 * slices, per_element: true }
    }
}

impl Kinematics for Raceway {
    fn waves(&self, motions: &Motions, j: usize) -> Option<[[f64; 2]; 2]> {
        let wavy = self.wavy.as_ref()?;
        Some(
            wavy.under(&self.geometry, motions, self.ring.mate, j)
                .map(|[_, slope, curvature]| [slope, curvature]),
        )
    }

    #[inline(always)]
    fn contact<B: Base>(&self, at: &contacts::Beside<B>) -> VariedContact<B> {
        let (m, r, mate) = (&at.element, at.radius, &at.mate);
        let (zero, one) = (r.splat(0.0), r.splat(1.0));
        let varied = |re: B, eps: [B; 5]| Varied { re, eps };
        let spin_speed = varied(m.spin_speed, [zero, zero, zero, zero, one]);
        let radius_excess = Varied::lift(m.radius_excess);
        let turning = mate.speed;
        if self.centred {
            // The roller moves in the polar coordinates of the ring, whose axes turn with it.
            let (turn, across) = (one / r, r * m.orbit_speed);
            let across_speed = varied(across, [turning, -(turn * m.radial_speed), zero, one, zero]);
            let roller = ElementMotion {
                radial_offset: varied(m.radial_offset, [one, zero, zero, zero, zero]),
                radial_speed: varied(m.radial_speed, [zero, turn * across - turning, one, zero, zero]),
                orbit_speed: across_speed / varied(r, [one, zero, zero, zero, zero]),
                spin_speed,
                radius_excess,
            };
            let (motion, mut grip) = self.geometry.outer(&roller, Varied::lift(turning));
            grip.normal[1] = varied(zero, [zero, turn, zero, zero, zero]);
            let seen = Seen {
                outwards: [varied(one, [zero; 5]), grip.normal[1]],
                distance: roller.radial_offset + self.geometry.pitch_radius,
                turning: roller.orbit_speed,
            };
            return self.on_waves(at, &seen, spin_speed, (motion, grip));
        }
        let roller = ElementMotion {
            radial_offset: Varied::lift(m.radial_offset),
            radial_speed: Varied::lift(m.radial_speed),
            orbit_speed: Varied::lift(m.orbit_speed),
            spin_speed,
            radius_excess,
        };
        let ring = RingMotion {
            position: [
                varied(mate.position[0], [-one, zero, zero, zero, zero]),
                varied(mate.position[1], [zero, -one, zero, zero, zero]),
            ],
            velocity: [
                varied(mate.velocity[0], [zero, turning, -one, zero, zero]),
                varied(mate.velocity[1], [-turning, zero, zero, -one, zero]),
            ],
            speed: Varied::lift(turning),
        };
        let (motion, grip) = match self.ring.mate {
            OUTER_RING => self.geometry.outer_beside(&roller, &ring),
            _ => self.geometry.inner(&roller, &ring),
        };
        self.on_waves(at, &Seen::new(&self.geometry, &roller, &ring), spin_speed, (motion, grip))
    }
}

impl Raceway {
    /// A contact of round bodies, on the waves that they have.
    #[inline(always)]
    fn on_waves<B: Base>(
        &self,
        at: &contacts::Beside<B>,
        seen: &Seen<Varied<B>>,
        spin: Varied<B>,
        (mut motion, mut grip): (ContactMotion<Varied<B>>, Grip<Varied<B>>),
    ) -> VariedContact<B> {
        let Some([raceway, roller]) = at.waves else {
            return VariedContact { motion, edge_share: None, over_spin_angle: None, grip };
        };
        let side = wavy::side(self.ring.mate);
        let zero = at.radius.splat(0.0);
        let [x, y] = seen.ahead();
        let ahead = [x.re, y.re, zero, zero, zero];
        let over_place = |[value, slope]: [B; 2]| Varied {
            re: value,
            eps: [slope * ahead[0], slope * ahead[1], zero, zero, zero],
        };
        let wave = Wave {
            height: over_place([zero, raceway[0] + roller[0]]),
            slopes: [over_place(raceway), over_place(roller)],
        };
        let tangent = grip.tangent();
        seen.put_on(&wave, side, [Varied::lift(at.mate.speed), spin], &mut motion, &mut grip);
        // A roller that turns moves its waves back under the contact.
        let turned = -roller[1];
        let steep = turned * side / seen.distance.re;
        let over_spin_angle = OverSpinAngle {
            delta: -roller[0],
            delta_dot: turned * (seen.turning.re - spin.re),
            normal: [steep * tangent[0].re, steep * tangent[1].re],
            offset: turned,
        };
        VariedContact { motion, edge_share: None, over_spin_angle: Some(over_spin_angle), grip }
    }
}

/// A NaN approach counts as contact, so that it reaches the accelerations and is reported.
#[inline]
fn is_touching(approach: f64) -> bool {
    approach > 0.0 || approach.is_nan()
}

/// Finds motion and levers of the contacts of all rollers with the outer raceway, whether they touch or not.
struct Outer<'a> {
    motions: &'a Motions,
    geometry: &'a RacewayGeometry,
    found: &'a mut [Found],
}

impl Columns for Outer<'_> {
    const PAIRED: bool = false;

    fn rows(&self) -> usize {
        self.motions.count
    }

    #[inline(always)]
    fn group<S: Simd, const K: usize>(&mut self, simd: S, first: usize) {
        let (block, lane) = place_of(first);
        let motion = self.motions.blocks[block].motion.load::<S, K>(simd, lane);
        let turning = Pack::<S, K>::all(simd, self.motions.shared[OUTER_RING].speed);
        let (motion, grip) = self.geometry.outer(&motion, turning);
        self.found[block].motion.store(lane, &motion);
        self.found[block].grip.store(lane, &grip);
    }
}

/// The same with the raceway of a ring that may be off the centre.
struct Beside<'a, const RING: usize> {
    motions: &'a Motions,
    geometry: &'a RacewayGeometry,
    found: &'a mut [Found],
}

impl<const RING: usize> Columns for Beside<'_, RING> {
    const PAIRED: bool = false;

    fn rows(&self) -> usize {
        self.motions.count
    }

    #[inline(always)]
    fn group<S: Simd, const K: usize>(&mut self, simd: S, first: usize) {
        let all = |x: f64| Pack::<S, K>::all(simd, x);
        let ring = &self.motions.shared[RING];
        let (block, lane) = place_of(first);
        let ElementBlock { motion, frame, .. } = &self.motions.blocks[block];
        let frame = frame.load(simd, lane);
        let [y, z] = ring.position;
        let [vy, vz] = ring.velocity;
        let (position, velocity) = (frame.to_local([all(y), all(z)]), frame.to_local([all(vy), all(vz)]));
        let seen = RingMotion { position, velocity, speed: all(ring.speed) };
        let motion = motion.load(simd, lane);
        let (motion, grip) = match RING {
            OUTER_RING => self.geometry.outer_beside(&motion, &seen),
            _ => self.geometry.inner(&motion, &seen),
        };
        self.found[block].motion.store(lane, &motion);
        self.found[block].grip.store(lane, &grip);
    }
}
