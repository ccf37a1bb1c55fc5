//! Laws of the places where a roller touches something: line contacts of many slices at once, each a share of what the whole contact would do at
//! its approach, and springs with friction.

use super::Spot;
use crate::laws::contact_pair::{ContactForce, ContactMotion};
use crate::laws::elastic::solid::SolidContact;
use crate::laws::line_contact::LineContact;
use crate::laws::rib_contact::{EndMotion, RibContact};
use crate::pairs::contacts::{
    ContactBlock, DIRECTIONS, EDGE_SHARE, FORCES, LawColumns, LawSlopes, NO_MOTION, VISCOSITY,
};
use crate::scalar::{Dual, Lanes, Of, Real, WIDEST, ZEROS, blocks_for, place_of};
use pulp::Arch;

/// Square of a slip, m^2/s^2, that is added so that its size has a slope at none.
const SLIP_FLOOR: f64 = 1e-24;

/// The law of one kind of contact of a roller.
#[expect(clippy::large_enum_variant, reason = "a few per model")]
#[derive(Clone, Copy, Debug)]
pub(crate) enum SpotLaw {
    /// Lubricated line contact.
    Line(LineContact),
    /// Spring, damper and friction.
    Solid(SolidContact),
    /// End on a rib.
    Rib(RibContact),
}

/// Forces at a place as those of a whole contact.
#[derive(Clone, Copy, Debug)]
pub(crate) struct SpotForces<T> {
    /// Normal force, N, its elastic part, and its damping, N s/m.
    pub(crate) normal: T,
    pub(crate) elastic: T,
    pub(crate) damping: T,
    /// Secant of friction, N s/m, and rolling resistance, N.
    pub(crate) secant: T,
    pub(crate) rolling: T,
}

impl SpotLaw {
    /// The line contact, if it is one.
    pub(crate) fn line(&self) -> Option<&LineContact> {
        match self {
            Self::Line(law) => Some(law),
            Self::Solid(_) | Self::Rib(_) => None,
        }
    }

    /// Elastic load at this approach (m), N.
    pub(crate) fn elastic_load<T: Of<f64> + Real>(&self, delta: T) -> T {
        match self {
            Self::Line(law) => law.elastic.load(delta),
            Self::Solid(law) => delta.floored(0.0) * law.stiffness,
            Self::Rib(law) => law.load(delta),
        }
    }

    /// Largest pressure (Pa) and mean radius (m) of Hertz's contact of an end under this load, N; zeros of others.
    pub(crate) fn pressed(&self, load: f64) -> [f64; 2] {
        match self {
            Self::Rib(law) => {
                let [radius, pressure] = law.circle(load);
                [pressure, radius]
            }
            Self::Line(_) | Self::Solid(_) => [0.0; 2],
        }
    }

    /// Elastic energy at this approach (m), J.
    pub(crate) fn energy(&self, delta: f64) -> f64 {
        match self {
            Self::Line(law) => law.elastic.energy(delta),
            Self::Solid(law) => 0.5 * law.stiffness * delta.max(0.0) * delta.max(0.0),
            Self::Rib(law) => law.energy(delta),
        }
    }

    /// Stiffness under this load (N), N/m.
    pub(crate) fn stiffness_at_load(&self, load: f64) -> f64 {
        match self {
            Self::Line(law) => law.elastic.stiffness_at_load(load),
            Self::Solid(law) => law.stiffness,
            Self::Rib(law) => law.stiffness_at_load(load),
        }
    }

    /// Forces of one place alone, with the logarithm of the relative viscosity; of a line contact those of its slices come from
    /// [`SliceLaws`].
    pub(crate) fn alone<T: Real>(&self, spot: &Spot<T>, ln_viscosity: T) -> Option<SpotForces<T>> {
        let zero = T::constant(0.0);
        match self {
            Self::Line(_) => None,
            Self::Solid(law) => {
                let [along, across] = spot.slip;
                let slip = (along * along + across * across + SLIP_FLOOR).sqrt();
                let motion =
                    ContactMotion { delta: spot.delta, delta_dot: spot.delta_dot, u1: slip, u2: zero };
                let force = law.force::<f64, T>(&motion);
                Some(SpotForces {
                    normal: force.normal,
                    elastic: spot.delta * law.stiffness,
                    damping: force.damping,
                    secant: force.friction_secant,
                    rolling: zero,
                })
            }
            Self::Rib(law) => {
                let force = law.force(&end_motion(spot), ln_viscosity);
                Some(SpotForces {
                    normal: force.normal,
                    elastic: law.load(spot.delta),
                    damping: force.damping,
                    secant: force.friction_secant,
                    rolling: zero,
                })
            }
        }
    }
}

/// How an end moves, as its law sees it.
fn end_motion<T: Real>(spot: &Spot<T>) -> EndMotion<T> {
    let [along, across] = spot.slip;
    EndMotion {
        delta: spot.delta,
        delta_dot: spot.delta_dot,
        entrainment: spot.entrainment,
        slip: (along * along + across * across + SLIP_FLOOR).sqrt(),
        surface_speeds: spot.surface_speeds,
    }
}

/// Slices whose contacts have the same law, and their forces.
#[derive(Clone, Debug)]
pub(crate) struct SliceLaws {
    columns: LawColumns,
    blocks: Vec<ContactBlock>,
    /// Slip across the direction of rolling, m/s.
    across: Vec<Lanes>,
    slopes: LawSlopes,
    rows: usize,
}

impl SliceLaws {
    /// For so many slices under this law at most.
    pub(crate) fn new(law: &LineContact, room: usize) -> Self {
        let law = LineContact { profile: None, ..*law };
        Self {
            columns: LawColumns::new(law, &[], blocks_for(room) * WIDEST),
            blocks: vec![ContactBlock::APART; blocks_for(room)],
            across: vec![ZEROS; blocks_for(room)],
            slopes: LawSlopes::new(blocks_for(room) * WIDEST),
            rows: 0,
        }
    }

    /// Forgets all slices.
    pub(crate) fn clear(&mut self) {
        for i in 0..blocks_for(self.rows) {
            let block = &mut self.blocks[i];
            (block.motion, block.edge_share, self.across[i]) = (NO_MOTION, ZEROS, ZEROS);
        }
        self.rows = 0;
    }

    /// Adds a slice that moves like this, whose friction is that of an edge by this share.
    pub(crate) fn add(&mut self, spot: &Spot<f64>, edge_share: f64) {
        let (block, lane) = place_of(self.rows);
        let to = &mut self.blocks[block];
        to.motion.delta[lane] = spot.delta;
        to.motion.delta_dot[lane] = spot.delta_dot;
        let [u1, u2] = spot.surface_speeds;
        (to.motion.u1[lane], to.motion.u2[lane]) = (u1, u2);
        to.edge_share[lane] = edge_share;
        self.across[block][lane] = spot.slip[1];
        self.rows += 1;
    }

    /// How many there are.
    pub(crate) fn rows(&self) -> usize {
        self.rows
    }

    /// Evaluates the law, with the logarithm of the relative viscosity.
    pub(crate) fn apply(&mut self, ln_viscosity: f64, instructions: Arch) {
        let Self { columns, blocks, across, rows, .. } = self;
        columns.apply_sliding(*rows, blocks, Some(across), ln_viscosity, instructions);
    }

    /// Evaluates it with its derivatives.
    pub(crate) fn differentiate(&mut self, ln_viscosity: f64, instructions: Arch) {
        let Self { columns, blocks, across, slopes, rows } = self;
        slopes.find_sliding(columns, *rows, blocks, across, ln_viscosity, instructions);
    }

    /// Forces of slice `i` under this law, at this approach (m), as those of a whole contact.
    pub(crate) fn forces(&self, i: usize, law: &SpotLaw, delta: f64) -> SpotForces<f64> {
        let force = self.force(i);
        // Q_el = 9/10 k delta of Palmgren's law; a contact that its damping lets go before it is apart has no stiffness, but energy to lose.
        let elastic = match law.line() {
            Some(law) if force.normal == 0.0 => law.elastic.load(delta),
            _ => force.stiffness * delta * 0.9,
        };
        SpotForces {
            normal: force.normal,
            elastic,
            damping: force.damping,
            secant: force.friction_secant,
            rolling: force.rolling_resistance,
        }
    }

    /// The same with all that is known of it.
    pub(crate) fn force(&self, i: usize) -> ContactForce<f64> {
        let (block, lane) = place_of(i);
        self.blocks[block].force.of(lane)
    }

    /// Normal force, the secant of friction and rolling resistance of slice `i` as it varies like this, after
    /// [`SliceLaws::differentiate`].
    pub(crate) fn varied<const N: usize>(
        &self,
        i: usize,
        spot: &Spot<Dual<N>>,
        ln_viscosity: Dual<N>,
    ) -> [Dual<N>; FORCES] {
        let force = self.force(i);
        let slopes = self.slopes.of(i);
        let [u1, u2] = spot.surface_speeds;
        let mut seen = [Dual { re: 0.0, eps: [0.0; N] }; DIRECTIONS];
        (seen[0], seen[1], seen[2], seen[3]) = (spot.delta, spot.delta_dot, u1, u2);
        (seen[EDGE_SHARE], seen[VISCOSITY]) = (spot.slip[1], ln_viscosity);
        let of = |re: f64, slopes: &[f64; DIRECTIONS]| {
            let mut out = Dual { re, eps: [0.0; N] };
            for (slope, seen) in slopes.iter().zip(&seen) {
                for (sum, x) in out.eps.iter_mut().zip(&seen.eps) {
                    *sum += slope * x;
                }
            }
            out
        };
        let values = [force.normal, force.friction_secant, force.rolling_resistance];
        std::array::from_fn(|k| of(values[k], &slopes[k]))
    }
}
