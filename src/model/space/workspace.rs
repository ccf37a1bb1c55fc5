//! Memory of a force evaluation in space: balls and their contacts in columns, motion of both rings and the cage, all forces.

use super::Space;
use super::cage::memory::CageMemory;
use super::rollers::contacts::RollerMemory;
use crate::bodies::{InputValues, MovingRing, OF_BALL, OF_RING, RingState};
use crate::integrate::Vibration;
use crate::laws::elastic::point::ElasticPoint;
use crate::laws::fluid::Fluid;
use crate::laws::point_contact::{POINT_FORCE, POINT_MOTION, PointForce, PointMotion};
use crate::pairs::groove::{Race, Wave};
use crate::pairs::{LAWS, LawCounts};
use crate::scalar::{Lanes, Pack, ZEROS, blocks_for, place_of};
use crate::space::solid::{Moving, Vector};
use pulp::{Arch, Simd};

/// Numbers of the elastic constants of a contact.
const ELASTIC: usize = 7;
/// Force and moment.
pub(super) const WRENCH: usize = 6;

/// What a law sees: Q, u_1, u_2, D_l, w_t, w_l, w_n, and the logarithm of the viscosity. The slip along the race is u_1 - u_2.
pub(super) const SEEN: usize = 8;
/// Forces with derivatives: F_t, F_l, M_t, M_l, M_n, F_R.
pub(super) const FORCES: usize = 6;

/// Derivatives of the forces of a block of contacts with both races.
pub(super) type BlockSlopes = [[[Lanes; SEEN]; FORCES]; 2];

/// Contacts of a block of balls with one race.
#[derive(Clone, Debug, Default)]
pub(super) struct ContactLanes {
    pub(super) elastic: [Lanes; ELASTIC],
    /// Height of the waves of the race there, m, its slope, m/rad, and the slope of that, m/rad^2; zero on a round race.
    pub(super) wave: [Lanes; 3],
    pub(super) motion: [Lanes; POINT_MOTION],
    pub(super) force: [Lanes; POINT_FORCE],
    /// Normal along the axis of the ring and outwards from it.
    pub(super) in_meridian: [Lanes; 2],
    /// On the ring: force and moment about its centre, in axes of the bearing.
    pub(super) on_ring: [Lanes; WRENCH],
    /// In the step from the last evaluated state: what the forces on the ring have changed by, normal force, and powers of damping,
    /// friction and rolling resistance, W.
    pub(super) reaction: [Lanes; WRENCH],
    pub(super) normal: Lanes,
    pub(super) powers: [Lanes; 3],
}

/// A block of balls.
#[derive(Clone, Debug)]
pub(super) struct BallBlock {
    /// x and rho, m; cosine and sine of the azimuth.
    pub(super) at: [Lanes; 2],
    pub(super) direction: [Lanes; 2],
    /// Orbit angle since the start, rad.
    pub(super) travel: Lanes,
    /// x', rho', psi', w_x, w_r, w_psi.
    pub(super) speeds: [Lanes; OF_BALL],
    /// By how much each radius is larger than nominal, m, mass and moment of inertia.
    pub(super) excess: Lanes,
    pub(super) inertia: [Lanes; 2],
    /// With outer and inner race.
    pub(super) contacts: [ContactLanes; 2],
    /// Force and moment of both contacts, in the axes of the azimuth.
    pub(super) on_ball: [Lanes; WRENCH],
}

/// Numbers of the columns from this place of the lanes on.
#[inline(always)]
pub(super) fn load<S: Simd, const K: usize, const N: usize>(
    simd: S,
    columns: &[Lanes; N],
    lane: usize,
) -> [Pack<S, K>; N] {
    let mut out = [Pack::all(simd, 0.0); N];
    for i in 0..N {
        out[i] = Pack::load(simd, &columns[i][lane..]);
    }
    out
}

/// Writes numbers to the columns from this place of the lanes on.
#[inline(always)]
pub(super) fn store<S: Simd, const K: usize, const N: usize>(
    numbers: [Pack<S, K>; N],
    columns: &mut [Lanes; N],
    lane: usize,
) {
    for i in 0..N {
        numbers[i].store(&mut columns[i][lane..]);
    }
}

/// Numbers at one place of the columns.
#[inline]
pub(super) fn at_lane<const N: usize>(columns: &[Lanes; N], lane: usize) -> [f64; N] {
    columns.each_ref().map(|column| column[lane])
}

impl ContactLanes {
    fn new(elastic: &[&ElasticPoint]) -> Self {
        let mut columns = [ZEROS; ELASTIC];
        for (lane, elastic) in elastic.iter().enumerate() {
            let mut column = columns.iter_mut();
            elastic.map(&mut |x| {
                if let Some(column) = column.next() {
                    column[lane] = *x;
                }
            });
        }
        Self { elastic: columns, ..Self::default() }
    }

    /// Elastic constants from this place of the lanes on, with the shape of `like`.
    #[inline(always)]
    pub(super) fn elastic<S: Simd, const K: usize>(
        &self,
        simd: S,
        like: &ElasticPoint,
        lane: usize,
    ) -> ElasticPoint<Pack<S, K>> {
        let mut columns = self.elastic.iter();
        like.map(&mut |_| match columns.next() {
            Some(column) => Pack::load(simd, &column[lane..]),
            None => Pack::all(simd, f64::NAN),
        })
    }

    /// Waves of the race from this place of the lanes on, if it has any.
    #[inline(always)]
    pub(super) fn wave<S: Simd, const K: usize>(
        &self,
        simd: S,
        race: &Race,
        lane: usize,
    ) -> Option<Wave<Pack<S, K>>> {
        let [height, slope, _] = &self.wave;
        let at = |column: &Lanes| Pack::load(simd, &column[lane..]);
        race.waviness.as_ref().map(|_| Wave { height: at(height), slope: at(slope) })
    }

    /// The same of one contact.
    pub(super) fn wave_of(&self, race: &Race, lane: usize) -> Option<Wave<f64>> {
        let [height, slope, _] = at_lane(&self.wave, lane);
        race.waviness.as_ref().map(|_| Wave { height, slope })
    }

    /// How the surfaces of one contact move.
    pub(super) fn motion_of(&self, lane: usize) -> PointMotion<f64> {
        PointMotion::of_numbers(at_lane(&self.motion, lane))
    }

    /// Forces of one contact.
    pub(super) fn force_of(&self, lane: usize) -> PointForce<f64> {
        PointForce::of_numbers(at_lane(&self.force, lane))
    }
}

/// Memory of a force evaluation and its results. One per simulation; never shared.
#[derive(Clone, Debug)]
pub struct Workspace {
    pub(super) count: usize,
    /// Number of balls that have states.
    pub(super) balls: usize,
    pub(super) blocks: Vec<BallBlock>,
    pub(super) ring: RingState<f64>,
    /// Motion of outer and inner ring.
    pub(super) rings: [MovingRing<f64>; 2],
    /// Force and moment about the centre of what all balls do to each.
    pub(super) on_rings: [[Vector<f64>; 2]; 2],
    pub(super) load: [f64; OF_RING],
    pub(super) cage: CageMemory,
    pub(super) rollers: RollerMemory,
    pub(super) inputs: InputValues,
    pub(super) instructions: Arch,
    /// Step whose forces the contacts have, s; zero where they have those of the state itself.
    pub(super) step: Option<f64>,
    /// Mean and last speeds of the balls in that step less those of the evaluation.
    pub(super) changes: Vec<[[Lanes; OF_BALL]; 2]>,
    pub(super) counts: LawCounts,
    pub(super) counting: bool,
    /// Temperature that the viscosity belongs to, K; NaN where the viscosity is constant.
    pub(super) temperature: f64,
    pub(super) fluid: Fluid,
    /// Derivatives of the contacts, once they were asked for.
    pub(super) slopes: Vec<BlockSlopes>,
}

impl Workspace {
    /// Memory for evaluations of a bearing.
    pub(crate) fn new(space: &Space) -> Self {
        let count = if space.rollers.is_some() { 0 } else { space.set.count };
        let block = |first: usize| {
            // Lanes beyond the last ball are a ball like the first one.
            let at = |lane: usize| if first + lane < count { first + lane } else { 0 };
            let column = |of: &dyn Fn(usize) -> f64| std::array::from_fn(|lane| of(at(lane)));
            let lanes: [usize; crate::scalar::WIDEST] = std::array::from_fn(at);
            let mut direction = [ZEROS; 2];
            direction[0].fill(1.0);
            BallBlock {
                at: [ZEROS; 2],
                direction,
                travel: ZEROS,
                speeds: [ZEROS; OF_BALL],
                excess: column(&|j| space.set.radius_excess[j]),
                inertia: [0, 1].map(|k| column(&|j| space.balls.inertia(j)[k])),
                contacts: [0, 1].map(|k| {
                    let elastic =
                        space.races.get(k).map(|race| lanes.iter().map(|j| &race.elastic[*j]).collect());
                    ContactLanes::new(&elastic.unwrap_or_else(Vec::<&ElasticPoint>::new))
                }),
                on_ball: [ZEROS; WRENCH],
            }
        };
        let at_rest = MovingRing {
            centre: [0.0; 3],
            axis: [1.0, 0.0, 0.0],
            moving: Moving { velocity: [0.0; 3], turning: [0.0; 3] },
            speed: 0.0,
        };
        let oil = space.inputs.oil;
        Self {
            count,
            balls: if space.rollers.is_some() { 0 } else { space.layout.count },
            blocks: (0..blocks_for(count)).map(|b| block(b * crate::scalar::WIDEST)).collect(),
            ring: RingState {
                position: [0.0; OF_RING],
                rate: [0.0; OF_RING],
                given: [0.0; OF_RING],
                speed: 0.0,
            },
            rings: [at_rest; 2],
            on_rings: [[[0.0; 3]; 2]; 2],
            load: [0.0; OF_RING],
            cage: CageMemory::new(space.set.count, space.cage.as_ref()),
            rollers: space
                .rollers
                .as_ref()
                .map_or_else(RollerMemory::none, |rollers| rollers.memory(space.set.count)),
            inputs: InputValues::default(),
            instructions: Arch::new(),
            step: None,
            changes: vec![[[ZEROS; OF_BALL]; 2]; blocks_for(count)],
            counts: [0; LAWS.len()],
            counting: true,
            temperature: oil.map_or(f64::NAN, |oil| oil.built_at.0),
            fluid: oil.map_or(Fluid::SAME, |oil| oil.fluid_at(oil.built_at.0)),
            slopes: Vec::new(),
        }
    }

    /// Contacts of every ball with one race, with their lanes, in order.
    pub(super) fn contacts(&self, race: usize) -> impl Iterator<Item = (&ContactLanes, usize)> {
        (0..self.balls).map(move |j| {
            let (block, lane) = place_of(j);
            (&self.blocks[block].contacts[race], lane)
        })
    }

    /// Contact of ball `j` with one race.
    pub(super) fn contact(&self, race: usize, j: usize) -> (&ContactLanes, usize) {
        let (block, lane) = place_of(j);
        (&self.blocks[block].contacts[race], lane)
    }

    /// Normal speeds of the loaded contacts at the last evaluated state.
    pub(crate) fn vibration(&self) -> Vibration {
        let mut sum = Vibration::default();
        for (contact, lane) in (0..2).flat_map(|race| self.contacts(race)) {
            if contact.force[0][lane] > 0.0 {
                let speed = contact.motion[1][lane];
                sum.count += 1.0;
                sum.squares += speed * speed;
            }
        }
        for speed in self.rollers.normal_speeds() {
            sum.count += 1.0;
            sum.squares += speed * speed;
        }
        sum
    }

    /// Number of evaluations of each law since the workspace was made or the counts were set.
    pub(crate) fn law_counts(&self) -> LawCounts {
        self.counts
    }

    /// Sets the counts.
    pub(crate) fn set_law_counts(&mut self, counts: LawCounts) {
        self.counts = counts;
    }

    /// Inputs of the next evaluation.
    #[inline]
    pub(crate) fn inputs_mut(&mut self) -> &mut InputValues {
        &mut self.inputs
    }

    /// Whether the next evaluations count; they do at first.
    pub(crate) fn set_counting(&mut self, counting: bool) {
        self.counting = counting;
    }

    /// Whether evaluations use the widest vector instructions of the machine, or none; they do at first.
    pub(crate) fn set_vector_instructions(&mut self, vector: bool) {
        self.instructions = if vector { Arch::new() } else { Arch::Scalar };
    }
}
