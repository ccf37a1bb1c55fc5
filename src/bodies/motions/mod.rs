//! Motion of all bodies at one state: what pairs see of them.

mod element_set;
mod turning;

pub(crate) use element_set::ElementSet;

use super::layout::OF_ELEMENT;
use super::{CAGE, SHARED};
use crate::scalar::{Lanes, Pack, WIDEST, ZEROS, blocks_for, math, place_of};
use crate::space::{Frame, Motion, Wrench, rotate};
use pulp::{Arch, Simd};

/// Motion of one element in cylindrical coordinates about the centre of the bearing.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct ElementMotion<T> {
    /// rho, radial offset from the pitch circle, m.
    pub(crate) radial_offset: T,
    /// Radial speed, m/s.
    pub(crate) radial_speed: T,
    /// Orbit speed psi_dot, rad/s.
    pub(crate) orbit_speed: T,
    /// Spin speed w_b, rad/s.
    pub(crate) spin_speed: T,
    /// How much larger its radius is than the nominal R_b, m; it never changes.
    pub(crate) radius_excess: T,
}

impl ElementMotion<Lanes> {
    const ZERO: Self = Self {
        radial_offset: ZEROS,
        radial_speed: ZEROS,
        orbit_speed: ZEROS,
        spin_speed: ZEROS,
        radius_excess: ZEROS,
    };

    /// Motion at a place of the lanes.
    #[inline(always)]
    pub(crate) fn of(&self, lane: usize) -> ElementMotion<f64> {
        let i = lane % WIDEST;
        ElementMotion {
            radial_offset: self.radial_offset[i],
            radial_speed: self.radial_speed[i],
            orbit_speed: self.orbit_speed[i],
            spin_speed: self.spin_speed[i],
            radius_excess: self.radius_excess[i],
        }
    }

    /// Motions from this place of the lanes on, as many as fit.
    #[inline(always)]
    pub(crate) fn load<S: Simd, const K: usize>(&self, simd: S, lane: usize) -> ElementMotion<Pack<S, K>> {
        ElementMotion {
            radial_offset: Pack::load(simd, &self.radial_offset[lane..]),
            radial_speed: Pack::load(simd, &self.radial_speed[lane..]),
            orbit_speed: Pack::load(simd, &self.orbit_speed[lane..]),
            spin_speed: Pack::load(simd, &self.spin_speed[lane..]),
            radius_excess: Pack::load(simd, &self.radius_excess[lane..]),
        }
    }
}

/// One element: its motion and where it is.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Element {
    pub(crate) motion: ElementMotion<f64>,
    /// Axes along its radius and across it.
    pub(crate) frame: Frame<f64>,
    /// r = r_p + rho, m.
    pub(crate) radius: f64,
}

impl Element {
    /// Power of a wrench in the local frame, W.
    pub(crate) fn power(&self, wrench: &Wrench<f64>) -> f64 {
        let m = &self.motion;
        let speeds = [m.radial_speed, self.radius * m.orbit_speed, m.spin_speed];
        wrench.components().iter().zip(speeds).map(|(force, speed)| force * speed).sum()
    }
}

/// Wrenches on a block of elements in their local frames, or what follows from them.
pub(crate) type WrenchLanes = [Lanes; OF_ELEMENT];

/// A block of elements: what is beyond the last one is of no meaning, but finite.
#[derive(Clone, Debug)]
#[repr(align(64))]
pub(crate) struct ElementBlock {
    pub(crate) motion: ElementMotion<Lanes>,
    /// Axes along their radii and across them.
    pub(crate) frame: Frame<Lanes>,
    /// Angle travelled since the start, rad; of elements that move freely.
    pub(crate) travel: Lanes,
    /// Direction from the centre, rad; of elements that move freely.
    pub(crate) azimuth: Lanes,
}

impl ElementBlock {
    const ZERO: Self = Self {
        motion: ElementMotion::<Lanes>::ZERO,
        frame: Frame::GLOBAL_LANES,
        travel: ZEROS,
        azimuth: ZEROS,
    };
}

/// How a block of places for elements is displaced in a deformed cage, outwards and counter-clockwise in m, and how fast, in m/s.
pub(crate) type DisplacedBlock = [[Lanes; 2]; 2];

/// Motion of all bodies at one state: all that pairs see of them.
#[derive(Clone, Debug)]
pub(crate) struct Motions {
    /// Of the shared bodies.
    pub(crate) shared: [Motion<f64>; SHARED],
    /// Coordinates of the cage behind those of its motion, and their rates; none of a rigid one.
    pub(crate) modes: [Vec<f64>; 2],
    /// Pockets of a cage that is not rigid.
    pub(crate) displaced: Vec<DisplacedBlock>,
    /// Of the elements.
    pub(crate) blocks: Vec<ElementBlock>,
    /// Number of elements.
    pub(crate) count: usize,
    /// Spin angles of the elements since the start, rad; none where no force depends on them.
    pub(crate) spin_angles: Vec<f64>,
    /// The travel of all elements, where it is the same, rad.
    pub(crate) together: Option<f64>,
    /// r_p, m.
    pitch_radius: f64,
    /// Vector instructions of this machine.
    pub(crate) instructions: Arch,
}

impl Motions {
    /// Memory for the motion of these elements and of a cage with so many modes.
    pub(crate) fn new(set: &ElementSet, modes: usize) -> Self {
        let mut blocks = vec![ElementBlock::ZERO; blocks_for(set.count)];
        for (j, excess) in set.radius_excess.iter().enumerate() {
            let (block, lane) = place_of(j);
            blocks[block].motion.radius_excess[lane] = *excess;
        }
        Self {
            shared: [Motion::default(); SHARED],
            modes: [vec![0.0; modes], vec![0.0; modes]],
            displaced: vec![[[ZEROS; 2]; 2]; if modes > 0 { blocks_for(set.count) } else { 0 }],
            blocks,
            count: set.count,
            spin_angles: Vec::new(),
            together: None,
            pitch_radius: set.pitch_radius,
            instructions: Arch::new(),
        }
    }

    /// r_p, m.
    #[inline(always)]
    pub(crate) fn pitch_radius(&self) -> f64 {
        self.pitch_radius
    }

    /// Angle that element `j` has travelled since the start, rad.
    #[inline]
    pub(crate) fn travel(&self, j: usize) -> f64 {
        let (block, lane) = place_of(j);
        self.together.unwrap_or(self.blocks[block].travel[lane])
    }

    /// Direction of element `j`, which moves freely, from the centre of the bearing, rad.
    #[inline]
    pub(crate) fn azimuth(&self, j: usize) -> f64 {
        let (block, lane) = place_of(j);
        self.blocks[block].azimuth[lane]
    }

    /// Angle that element `j` has turned about its own axis since the start, rad; zero where no force depends on it.
    #[inline]
    pub(crate) fn spin_angle(&self, j: usize) -> f64 {
        self.spin_angles.get(j).copied().unwrap_or(0.0)
    }

    /// How the pocket of element `j` is displaced, and how fast: see [`DisplacedBlock`].
    #[inline]
    pub(crate) fn displacement(&self, j: usize) -> [[f64; 2]; 2] {
        let (block, lane) = place_of(j);
        self.displaced
            .get(block)
            .map_or([[0.0; 2]; 2], |block| block.each_ref().map(|part| part.each_ref().map(|x| x[lane])))
    }

    /// Axes of the pocket of element `j`, which turn with the cage.
    pub(crate) fn pocket_frame(&self, j: usize) -> Frame<f64> {
        let (sin, cos) = math::sin_cos(self.travel(j) - self.shared[CAGE].angle);
        let Frame { sin: s, cos: c } = self.frame(j);
        let [cos, sin] = rotate([c, s], -sin, cos);
        Frame { sin, cos }
    }

    /// Axes of element `j`.
    #[inline]
    pub(crate) fn frame(&self, j: usize) -> Frame<f64> {
        let (block, lane) = place_of(j);
        self.blocks[block].frame.of(lane)
    }

    /// Element `j`.
    #[inline]
    pub(crate) fn element(&self, j: usize) -> Element {
        let (block, lane) = place_of(j);
        let ElementBlock { motion, frame, .. } = &self.blocks[block];
        let motion = motion.of(lane);
        Element { motion, frame: frame.of(lane), radius: self.pitch_radius + motion.radial_offset }
    }
}
