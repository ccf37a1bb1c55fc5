//! Rollers that move freely in the plane, in cylindrical coordinates about the centre of the bearing.
//!
//! ```text
//! m (rho'' - r psi'^2) = F_r,   m (r psi'' + 2 rho' psi') = F_psi,   I w' = M,   r = r_p + rho
//! ```
//!
//! The travel counts from the centred place of the pocket at the start. The spin angle is a state where a roller has waves.

use super::{
    Damping, ElementSlopes, ORBIT_TRAVEL, RADIAL_OFFSET, SPIN_ANGLE, SPIN_SPEED, Spacing, UPPER, scale_rows,
};
use crate::bodies::{
    BodyEnergy, BodyForces, Coordinate, Element, ElementBlock, ElementSet, Elements, Fault, ForceSource,
    Input, InputValues, Layout, Motions, OF_ELEMENT, SOUND, WrenchLanes, weight,
};
use crate::integrate::SpokeDamping;
use crate::scalar::{Columns, Lanes, Pack, WIDEST, ZEROS, dispatch, place_of};
use crate::scene::Scene;
use crate::space::Wrench;
use pulp::Simd;

/// A roller this far from the pitch circle, in pitch radii, has left the bearing.
const LOST_ROLLER: f64 = 0.25;

/// Mass in kg and moment of inertia in kg m^2 of a roller.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Inertia {
    mass: f64,
    moment: f64,
}

/// Rollers with states of their own.
#[derive(Debug)]
pub(in crate::bodies) struct Rollers {
    set: ElementSet,
    inertia: Inertia,
    /// Gap of a roller on the pitch circle to either raceway with the inner ring centred, m.
    gap: f64,
    spacing: Spacing,
    coordinates: &'static [Coordinate; OF_ELEMENT],
}

const ROUND: [Coordinate; OF_ELEMENT] = [RADIAL_OFFSET, ORBIT_TRAVEL, SPIN_SPEED];
const WAVY: [Coordinate; OF_ELEMENT] = [RADIAL_OFFSET, ORBIT_TRAVEL, SPIN_ANGLE];

impl Rollers {
    /// The rollers of a scene, if it has any.
    pub(in crate::bodies) fn new(scene: &Scene) -> Option<Self> {
        let rollers = scene.rollers.as_ref()?;
        Some(Self {
            set: ElementSet::new(scene),
            inertia: Inertia { mass: rollers.mass, moment: rollers.inertia },
            gap: scene.radial_clearance() / 4.0,
            spacing: Spacing::new(scene),
            coordinates: if rollers.waviness.is_empty() { &ROUND } else { &WAVY },
        })
    }

    /// The fault of the roller with the largest of these velocities.
    fn too_fast(&self, layout: &Layout, v: &[f64]) -> Fault {
        let lever = [1.0, self.set.pitch_radius, self.set.radius];
        let all = (0..layout.count).flat_map(|j| layout.of_element::<OF_ELEMENT>(j).into_iter().zip(lever));
        let speeds = all.map(|(velocity, lever)| (velocity, v[velocity].abs() * lever));
        let (velocity, speed) = speeds.fold((0, 0.0), |a, b| if b.1 > a.1 { b } else { a });
        Fault::TooFast { velocity, speed }
    }

    /// Refuses rollers that are lost, too fast or in each other, given their motion and their places.
    #[inline]
    fn judge(
        &self,
        layout: &Layout,
        v: &[f64],
        blocks: &[ElementBlock],
        place: impl Fn(usize) -> [f64; 2],
    ) -> Result<(), Fault> {
        let ElementSet { pitch_radius, radius, .. } = self.set;
        let limit = LOST_ROLLER * pitch_radius;
        let beyond = |column: &Lanes, lever: f64, limit: f64| {
            column.iter().fold(false, |beyond, x| beyond | (x.abs() * lever > limit))
        };
        let [mut lost, mut fast] = [false; 2];
        for ElementBlock { motion, .. } in blocks {
            lost |= beyond(&motion.radial_offset, 1.0, limit);
            fast |= beyond(&motion.radial_speed, 1.0, SOUND);
            fast |= beyond(&motion.orbit_speed, pitch_radius, SOUND);
            fast |= beyond(&motion.spin_speed, radius, SOUND);
        }
        if lost {
            let roller = (0..layout.count).find(|j| place(*j)[0].abs() > limit).unwrap_or_default();
            return Err(Fault::LostRoller { roller, way: "radial", offset: place(roller)[0] });
        }
        if fast {
            return Err(self.too_fast(layout, v));
        }
        self.spacing.overlap(&self.set, place).map_or(Ok(()), Err)
    }

    /// Radius of the circle of the centres of rollers that touch the outer raceway, m.
    fn outer_centre_radius(&self) -> f64 {
        self.set.pitch_radius + self.gap
    }
}

impl Elements for Rollers {
    fn set(&self) -> &ElementSet {
        &self.set
    }

    fn kind(&self) -> &'static str {
        "roller"
    }

    fn coordinates(&self) -> &'static [Coordinate] {
        self.coordinates
    }

    fn mass(&self) -> Option<f64> {
        Some(self.inertia.mass)
    }

    fn mobility(&self) -> f64 {
        let (Inertia { mass, moment }, radius) = (self.inertia, self.set.radius);
        1.0 / mass + radius * radius / moment
    }

    fn centrifugal(&self, orbit_speed: f64) -> f64 {
        self.inertia.mass * self.set.pitch_radius * orbit_speed * orbit_speed
    }

    /// Of a roller that touches both raceways: its centre moves at the mean of their surface speeds, and its spin is half of
    /// their difference over its radius.
    fn kinematic_speeds(&self, inputs: &InputValues) -> [f64; 2] {
        let [outer_ratio, inner_ratio] = self.orbit_ratios();
        let [outer, inner] = [inputs.of(Input::OuterRingSpeed), inputs.of(Input::RingSpeed)];
        let spin_ratio = -inner_ratio * self.outer_centre_radius() / self.set.radius;
        let (orbit, spin) = (inner_ratio * inner, spin_ratio * inner);
        if outer == 0.0 {
            return [orbit, spin];
        }
        let outer_spin_ratio = outer_ratio * self.outer_centre_radius() / self.set.radius;
        [orbit + outer_ratio * outer, spin + outer_spin_ratio * outer]
    }

    /// Of a roller that touches both raceways: R_o/(2 (R_o - R_b)) and R_i/(2 (R_o - R_b)).
    fn orbit_ratios(&self) -> [f64; 2] {
        let Self { set, gap, .. } = self;
        let outer = self.outer_centre_radius() + set.radius;
        let inner = set.pitch_radius - set.radius - gap;
        [outer, inner].map(|raceway| raceway / (2.0 * self.outer_centre_radius()))
    }

    fn find(
        &self,
        layout: &Layout,
        q: &[f64],
        v: &[f64],
        _inputs: &InputValues,
        out: &mut Motions,
    ) -> Result<(), Fault> {
        let place = |j: usize| {
            let i = layout.element(j);
            [q[i], q[i + 1]]
        };
        out.spin_angles.clear();
        let references = self.set.reference_angles.chunks(WIDEST);
        for (at, (block, references)) in out.blocks.iter_mut().zip(references).enumerate() {
            let ElementBlock { motion, travel, azimuth, .. } = block;
            layout.rates_of_block(
                v,
                at,
                [&mut motion.radial_speed, &mut motion.orbit_speed, &mut motion.spin_speed],
            );
            layout.places_of_block(q, at, [&mut motion.radial_offset, travel], &mut out.spin_angles);
            for ((azimuth, reference), travel) in azimuth.iter_mut().zip(references).zip(&*travel) {
                *azimuth = reference + travel;
            }
        }
        self.judge(layout, v, &out.blocks, place)?;
        out.find_directions();
        Ok(())
    }

    fn travel(&self, layout: &Layout, q: &[f64], _inputs: &InputValues, j: usize) -> [f64; 2] {
        let i = layout.element(j);
        [q[i + 1], q[i]]
    }

    fn accelerate(
        &self,
        layout: &Layout,
        motions: &Motions,
        on_elements: &[WrenchLanes],
        gravity: [f64; 2],
        a: &mut [f64],
    ) {
        let a = &mut a[layout.elements..];
        let a = if layout.has_spin_angles() {
            Rates::Together(a.as_chunks_mut().0)
        } else {
            let (rates, spins) = a.split_at_mut(2 * layout.count);
            Rates::Apart(rates.as_chunks_mut().0, spins)
        };
        let work = Accelerate { rollers: self, motions, on_elements, gravity, a };
        dispatch(motions.instructions, work);
    }

    fn slopes(
        &self,
        element: &Element,
        on_element: &Wrench<f64>,
        gravity: [f64; 2],
        k: ElementSlopes<'_>,
        d: ElementSlopes<'_>,
    ) -> [f64; OF_ELEMENT] {
        let (Inertia { mass, moment }, r) = (self.inertia, element.radius);
        let inverse = [1.0 / mass, 1.0 / (mass * r), 1.0 / moment];
        for columns in
            [&mut *k.own, k.over_hub, k.over_neighbours, &mut *d.own, d.over_hub, d.over_neighbours]
        {
            scale_rows(columns, &inverse);
        }
        let [weight_r, weight_c] = element.frame.to_local(gravity);
        let (radial_speed, orbit) = (element.motion.radial_speed, element.motion.orbit_speed);
        let across = (on_element.force[1] / mass + weight_c - 2.0 * radial_speed * orbit) / r;
        k.own[0][0] += orbit * orbit;
        k.own[1][0] += weight_c;
        k.own[0][1] -= across / r;
        k.own[1][1] -= weight_r / r;
        d.own[1][0] += 2.0 * r * orbit;
        d.own[0][1] -= 2.0 * orbit / r;
        d.own[1][1] -= 2.0 * radial_speed / r;
        inverse
    }

    fn accelerations_of(&self, motions: &Motions, damping: &mut Damping) {
        let divide = Divide { inertia: self.inertia, pitch_radius: self.set.pitch_radius, motions, damping };
        dispatch(motions.instructions, divide);
    }

    fn energy(&self, element: &Element, gravity: [f64; 2]) -> BodyEnergy {
        let Inertia { mass, moment } = self.inertia;
        let m = &element.motion;
        let across = element.radius * m.orbit_speed;
        BodyEnergy {
            kinetic: 0.5
                * (mass * (m.radial_speed * m.radial_speed + across * across)
                    + moment * m.spin_speed * m.spin_speed),
            elastic: 0.0,
            potential: BodyEnergy::of_weight(mass, gravity, element.frame.to_global([element.radius, 0.0])),
        }
    }

    fn report(&self, gravity: [f64; 2], out: &mut BodyForces) {
        out[ForceSource::Gravity as usize] = weight(self.inertia.mass, gravity);
    }
}

/// From wrenches in the local frames to accelerations: radial and orbital, spin.
struct Accelerate<'a> {
    rollers: &'a Rollers,
    motions: &'a Motions,
    on_elements: &'a [WrenchLanes],
    gravity: [f64; 2],
    a: Rates<'a>,
}

/// Accelerations of all rollers in the order of the state vector.
enum Rates<'a> {
    /// Radial and orbital ones, and those of the spins behind them.
    Apart(&'a mut [[f64; 2]], &'a mut [f64]),
    /// All of each roller.
    Together(&'a mut [[f64; OF_ELEMENT]]),
}

impl Columns for Accelerate<'_> {
    const PAIRED: bool = false;

    fn rows(&self) -> usize {
        self.motions.count
    }

    #[inline(always)]
    fn group<S: Simd, const K: usize>(&mut self, simd: S, first: usize) {
        let Self { rollers, motions, on_elements, gravity, a } = self;
        let Inertia { mass, moment } = rollers.inertia;
        let all = |x: f64| Pack::<S, K>::all(simd, x);
        let (block, lane) = place_of(first);
        let load = |column: &Lanes| Pack::load(simd, &column[lane..]);
        let [radial, across, turning] = &on_elements[block];
        let block = &motions.blocks[block];
        let weight = block.frame.load(simd, lane).to_local([all(gravity[0]), all(gravity[1])]);
        let motion = block.motion.load(simd, lane);
        let (r, orbit) = (motion.radial_offset + rollers.set.pitch_radius, motion.orbit_speed);
        let mut columns = [ZEROS; OF_ELEMENT];
        (load(radial) * (1.0 / mass) + weight[0] + r * orbit * orbit).store(&mut columns[0]);
        ((load(across) * (1.0 / mass) + weight[1] - motion.radial_speed * orbit * 2.0) / r)
            .store(&mut columns[1]);
        (load(turning) * (1.0 / moment)).store(&mut columns[2]);
        let last = (first + K * S::F64_LANES).min(motions.count);
        match a {
            Rates::Apart(rates, spins) => {
                for j in first..last {
                    rates[j] = [columns[0][j - first], columns[1][j - first]];
                    spins[j] = columns[2][j - first];
                }
            }
            Rates::Together(rates) => {
                for j in first..last {
                    rates[j] = [columns[0][j - first], columns[1][j - first], columns[2][j - first]];
                }
            }
        }
    }
}

/// From force over speed in the local frame to acceleration over rate of the coordinates.
struct Divide<'a> {
    inertia: Inertia,
    pitch_radius: f64,
    motions: &'a Motions,
    damping: &'a mut Damping,
}

impl Columns for Divide<'_> {
    const PAIRED: bool = false;

    fn rows(&self) -> usize {
        self.motions.count
    }

    #[inline(always)]
    #[expect(clippy::needless_range_loop, reason = "iterators might not be inlined")]
    fn group<S: Simd, const K: usize>(&mut self, simd: S, first: usize) {
        let Self { inertia, pitch_radius, motions, damping } = self;
        let Inertia { mass, moment } = *inertia;
        let (block, lane) = place_of(first);
        let all = |x: f64| Pack::<S, K>::all(simd, x);
        let r = Pack::load(simd, &motions.blocks[block].motion.radial_offset[lane..]) + *pitch_radius;
        let speed = [all(1.0), r, all(1.0)];
        let inverse: [_; OF_ELEMENT] = [all(1.0 / mass), all(1.0 / mass) / r, all(1.0 / moment)];
        let SpokeDamping { full, implicit } = &mut damping.spokes[block];
        for at in 0..UPPER.len() {
            let (i, k) = UPPER[at];
            let all = Pack::load(simd, &full[i][k][lane..]);
            let share = Pack::load(simd, &implicit[i][k][lane..]);
            let (here, mirrored) = (inverse[i] * speed[k], inverse[k] * speed[i]);
            (all * here).store(&mut full[i][k][lane..]);
            (all * mirrored).store(&mut full[k][i][lane..]);
            (share * here).store(&mut implicit[i][k][lane..]);
            (share * mirrored).store(&mut implicit[k][i][lane..]);
        }
    }
}
