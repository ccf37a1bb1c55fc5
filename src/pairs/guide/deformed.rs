//! The guide of a cage that is bent: from the bodies to the axes of the cage, in which its waves are known, and back.
//!
//! Forces act over the place of the cage, its angle and its waves. The ring feels the opposite force, and the moment that
//! both together have about its centre.

use super::longest_step::longest_bent_step;
use super::side::GuideSide;
use crate::bodies::{CAGE, CAGE_MOTION, Motions, SHARED, along_factor};
use crate::laws::fluid::Fluid;
use crate::laws::guide::bent::{BentForces, BentMotion, BentSurface, Wanted};
use crate::laws::guide::journal::{Harmonic, NoFilm};
use crate::laws::guide::{GuideForce, GuideLaw};
use crate::pairs::slope_sums::SlopeSums;
use crate::pairs::{Ahead, Cost, SharedForce};
use crate::scalar::math;
use crate::scene::{ElasticRing, Scene};
use crate::space::{Motion, rotate};
use nalgebra::{DMatrix, DVector, Matrix3};

/// How a guide acts on a bent cage.
#[derive(Debug)]
pub(super) struct DeformedGuide {
    surface: BentSurface,
    side: GuideSide,
    ring: usize,
}

/// Forces over the coordinates of a bent cage, and memory for them.
#[derive(Clone, Debug)]
pub(in crate::pairs) struct OnDeformed {
    forces: BentForces,
    /// Over the waves: all, and those of the film.
    on_modes: [Vec<f64>; 2],
    /// How forces over all coordinates of the cage oppose their rates, global axes.
    damping: DMatrix<f64>,
    damped: bool,
    /// Derivatives over positions and velocities in global axes.
    over: [DMatrix<f64>; 2],
}

impl OnDeformed {
    pub(in crate::pairs) fn on_modes(&self) -> &[f64] {
        &self.on_modes[0]
    }

    pub(in crate::pairs) fn of_modes(&self) -> [&[f64]; 2] {
        self.on_modes.each_ref().map(Vec::as_slice)
    }

    pub(in crate::pairs) fn damping(&self) -> Option<&DMatrix<f64>> {
        self.damped.then_some(&self.damping)
    }
}

impl BentSurface {
    /// That of a guided surface of this radius (m) and profile on a cage with this elastic ring.
    pub(super) fn of(bends: &ElasticRing, radius: f64, side: GuideSide, profile: &[Harmonic]) -> Self {
        let height = (radius - bends.neutral_radius) / bends.neutral_radius;
        Self {
            waves: (2..=bends.modes).map(|order| (order, along_factor(order, height))).collect(),
            profile: profile.to_vec(),
            on_journal: side == GuideSide::CageInside,
            growth: bends.growth,
            contact_depth: bends.contact_depth,
        }
    }
}

/// Motion of the cage beside the ring, and the direction of its axes.
struct Beside {
    position: [f64; 2],
    velocity: [f64; 2],
    speeds: [f64; 2],
    sin: f64,
    cos: f64,
}

impl Beside {
    fn new(cage: &Motion<f64>, ring: &Motion<f64>) -> Self {
        let (sin, cos) = math::sin_cos(cage.angle);
        let own = |a: [f64; 2], b: [f64; 2]| rotate([a[0] - b[0], a[1] - b[1]], -sin, cos);
        Self {
            position: own(cage.position, ring.position),
            velocity: own(cage.velocity, ring.velocity),
            speeds: [cage.speed, ring.speed],
            sin,
            cos,
        }
    }

    fn with<'a>(&self, [amplitudes, rates]: [&'a [f64]; 2]) -> BentMotion<'a> {
        BentMotion {
            position: self.position,
            velocity: self.velocity,
            speeds: self.speeds,
            amplitudes,
            rates,
        }
    }

    fn to_global(&self, v: [f64; 2]) -> [f64; 2] {
        rotate(v, self.sin, self.cos)
    }
}

impl DeformedGuide {
    /// The guide of a cage with an elastic ring, whose guided surface has this radius (m) and profile; `None` for a rigid cage.
    pub(super) fn of(
        scene: &Scene,
        side: GuideSide,
        ring: usize,
        radius: f64,
        profile: &[Harmonic],
    ) -> Option<Self> {
        let bends = scene.cage.as_ref()?.elastic_ring.as_ref()?;
        let surface = BentSurface::of(bends, radius, side, profile);
        Some(Self { surface, side, ring })
    }

    /// Memory for forces.
    pub(super) fn memory(&self) -> Box<OnDeformed> {
        let width = CAGE_MOTION + 2 * self.surface.waves.len();
        let square = DMatrix::zeros(width, width);
        let modes = vec![0.0; width - CAGE_MOTION];
        Box::new(OnDeformed {
            forces: BentForces::new(&self.surface),
            on_modes: [modes.clone(), modes],
            damping: square.clone(),
            damped: false,
            over: [square.clone(), square],
        })
    }

    /// Writes the forces, and damping where it is wanted.
    pub(super) fn evaluate(
        &self,
        law: &GuideLaw,
        motions: &Motions,
        fluid: Fluid,
        wanted: Wanted,
        out: &mut SharedForce,
    ) -> Result<(), NoFilm> {
        let shared = &motions.shared;
        let SharedForce { on, of_law, damping, deformed: Some(deformed), .. } = out else { return Ok(()) };
        let beside = Beside::new(&shared[CAGE], &shared[self.ring]);
        let motion = beside.with(motions.modes.each_ref().map(Vec::as_slice));
        let OnDeformed { forces, on_modes, .. } = &mut **deformed;
        law.bend(&self.surface, &motion, fluid, wanted, forces)?;
        for (to, from) in on_modes.iter_mut().zip([&forces.all, &forces.film]) {
            to.copy_from_slice(&from[CAGE_MOTION..]);
        }
        let parts = &forces.parts;
        *of_law = GuideForce {
            pressure: beside.to_global(parts.pressure),
            shear: beside.to_global(parts.shear),
            solid: beside.to_global(parts.solid),
            ..*parts
        };
        *on = self.side.wrenches(of_law, &self.side.journal_motion(&shared[CAGE], &shared[self.ring]));
        deformed.damped = wanted == Wanted::Damping;
        *damping = None;
        if wanted == Wanted::Damping {
            *damping = Some([Matrix3::zeros(); 2]);
            self.to_global(deformed, &beside, wanted);
            let OnDeformed { damping: all, over: [_, over], .. } = &mut **deformed;
            all.iter_mut().zip(over.iter()).for_each(|(damping, slope)| *damping = -slope);
            // The ring feels what the cage feels.
            if let Some([_, on_ring]) = damping {
                on_ring.fixed_view_mut::<2, 2>(0, 0).copy_from(&all.fixed_view::<2, 2>(0, 0));
            }
        }
        Ok(())
    }

    /// Turns derivatives over the coordinates of the cage, beside a ring that does not move, from its axes to global ones; those
    /// over its angle and the moment on the cage follow.
    fn to_global(&self, deformed: &mut OnDeformed, beside: &Beside, wanted: Wanted) {
        let OnDeformed { forces, over, .. } = deformed;
        for (to, from) in over.iter_mut().zip(&forces.over) {
            to.copy_from(from);
        }
        let n = forces.all.len();
        let ([y, z], [vy, vz]) = (beside.position, beside.velocity);
        let [over_positions, over_velocities] = over;
        if wanted == Wanted::Slopes {
            for i in 0..n {
                over_positions[(i, 2)] += over_positions[(i, 0)] * z - over_positions[(i, 1)] * y
                    + over_velocities[(i, 0)] * vz
                    - over_velocities[(i, 1)] * vy;
            }
        }
        if self.side == GuideSide::CageOutside {
            // On the cage: -(moment on the journal) - place x force on the cage.
            let [fy, fz] = [forces.all[0], forces.all[1]];
            for part in [&mut *over_positions, &mut *over_velocities] {
                for k in 0..n {
                    part[(2, k)] = -part[(2, k)] - (y * part[(1, k)] - z * part[(0, k)]);
                }
            }
            if wanted == Wanted::Slopes {
                // The place in axes of the cage turns back with its angle.
                for (k, [dy, dz]) in [[1.0, 0.0], [0.0, 1.0], [z, -y]].into_iter().enumerate() {
                    over_positions[(2, k)] -= dy * fz - dz * fy;
                }
            }
        }
        for (part, turned) in [(over_positions, wanted == Wanted::Slopes), (over_velocities, false)] {
            for k in 0..n {
                let mut force = [part[(0, k)], part[(1, k)]];
                if k == 2 && turned {
                    // Forces turn with the axes.
                    force = [force[0] - forces.all[1], force[1] + forces.all[0]];
                }
                [part[(0, k)], part[(1, k)]] = beside.to_global(force);
            }
            for i in 0..n {
                [part[(i, 0)], part[(i, 1)]] = beside.to_global([part[(i, 0)], part[(i, 1)]]);
            }
        }
    }

    /// Adds the derivatives over the coordinates of both bodies.
    pub(super) fn add_slopes(
        &self,
        law: &GuideLaw,
        motions: &Motions,
        fluid: Fluid,
        force: &mut SharedForce,
        sums: &mut SlopeSums<'_>,
    ) {
        if self.evaluate(law, motions, fluid, Wanted::Slopes, force).is_err() {
            return;
        }
        let Some(deformed) = &mut force.deformed else { return };
        let shared = &motions.shared;
        let beside = Beside::new(&shared[CAGE], &shared[self.ring]);
        self.to_global(deformed, &beside, Wanted::Slopes);
        let OnDeformed { forces, over, .. } = &**deformed;
        let (cage, ring) = (sums.layout.range(CAGE), sums.layout.range(self.ring));
        let out = &mut *sums.out;
        for (over, to) in over.iter().zip([&mut out.over_positions.hub, &mut out.over_velocities.hub]) {
            for (k, column) in cage.clone().enumerate() {
                for (i, row) in cage.clone().enumerate() {
                    to[(row, column)] += over[(i, k)];
                }
                for (i, row) in ring.clone().enumerate() {
                    to[(row, column)] -= over[(i, k)];
                }
            }
            for (k, column) in ring.clone().enumerate() {
                for (i, row) in cage.clone().enumerate() {
                    to[(row, column)] -= over[(i, k)];
                }
                for (i, row) in ring.clone().enumerate() {
                    to[(row, column)] += over[(i, k)];
                }
            }
        }
        for (over, rates) in over.iter().zip(sums.moving(self.ring)) {
            for (k, rate) in rates.into_iter().enumerate().filter(|(_, rate)| *rate != 0.0) {
                for (i, row) in cage.clone().enumerate() {
                    sums.out.over_time[row] -= over[(i, k)] * rate;
                }
            }
        }
        let speeding = sums.speeding(self.ring);
        self.add_over_time(&beside, &forces.over_ring_speed, speeding, sums);
        if sums.ln_viscosity_rate != 0.0 {
            self.add_warming(law, motions, fluid, force, sums);
        }
    }

    /// Adds `rate` times the slope of the forces over all coordinates, in axes of the cage and with the moment on the journal.
    fn add_over_time(&self, beside: &Beside, slope: &DVector<f64>, rate: f64, sums: &mut SlopeSums<'_>) {
        if rate == 0.0 {
            return;
        }
        let [y, z] = beside.position;
        let moment = match self.side {
            GuideSide::CageInside => slope[2],
            GuideSide::CageOutside => -slope[2] - (y * slope[1] - z * slope[0]),
        };
        let [fy, fz] = beside.to_global([slope[0], slope[1]]);
        let of_motion = [fy, fz, moment];
        for (i, place) in sums.layout.range(CAGE).enumerate() {
            let slope = if i < CAGE_MOTION { of_motion[i] } else { slope[i] };
            sums.out.over_time[place] += rate * slope;
        }
        for (place, force) in sums.layout.range(self.ring).zip([fy, fz]) {
            sums.out.over_time[place] -= rate * force;
        }
    }

    /// Adds what a lubricant that changes its viscosity does.
    fn add_warming(
        &self,
        law: &GuideLaw,
        motions: &Motions,
        fluid: Fluid,
        force: &mut SharedForce,
        sums: &mut SlopeSums<'_>,
    ) {
        let shared = &motions.shared;
        let beside = Beside::new(&shared[CAGE], &shared[self.ring]);
        let rate = sums.ln_viscosity_rate;
        // A central difference over the logarithm.
        let step = SlopeSums::VISCOSITY_STEP;
        let mut slope = DVector::zeros(CAGE_MOTION + 2 * self.surface.waves.len());
        for side in [1.0, -1.0] {
            let thicker = fluid.moved(side * step, sums.ln_structure_ratio);
            if self.evaluate(law, motions, thicker, Wanted::Forces, force).is_err() {
                return;
            }
            if let Some(deformed) = &force.deformed {
                slope.iter_mut().zip(&deformed.forces.all).for_each(|(x, f)| *x += side * f / (2.0 * step));
            }
        }
        self.add_over_time(&beside, &slope, rate, sums);
        // The memory holds the forces of the state again.
        let _ = self.evaluate(law, motions, fluid, Wanted::Forces, force);
    }

    /// Time of its forces and of their derivatives, which grow with the number of waves and with its square.
    pub(super) fn cost(&self) -> Cost {
        let n = self.surface.waves.len() as f64;
        Cost { value: 1000.0 + 1500.0 * n, slopes: 6000.0 + 4000.0 * n + 300.0 * n * n, per_element: false }
    }

    /// Smallest gap, m.
    pub(super) fn smallest_gap(&self, law: &GuideLaw, motions: &Motions) -> f64 {
        let shared = &motions.shared;
        let beside = Beside::new(&shared[CAGE], &shared[self.ring]);
        let [gap, _] =
            law.smallest_bent_gap(&self.surface, &beside.with(motions.modes.each_ref().map(Vec::as_slice)));
        gap
    }

    /// Number of wet arcs, and the angle that they take, rad.
    pub(super) fn wet_arcs(&self, law: &GuideLaw, motions: &Motions) -> (u32, f64) {
        let shared = &motions.shared;
        let beside = Beside::new(&shared[CAGE], &shared[self.ring]);
        law.wet_arcs(&self.surface, &beside.with(motions.modes.each_ref().map(Vec::as_slice)))
    }

    /// The longest step (s) that passes no onset unseen.
    pub(super) fn longest_step(&self, law: &GuideLaw, ahead: &Ahead<'_>) -> f64 {
        let shared: &[Motion<f64>] = ahead.shared;
        debug_assert_eq!(shared.len(), SHARED);
        let beside = Beside::new(&shared[CAGE], &shared[self.ring]);
        longest_bent_step(law, &self.surface, &beside.with(ahead.modes()), ahead.masses[CAGE], ahead.tuning)
    }
}
