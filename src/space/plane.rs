//! The plane of a bearing: y to the right, z upwards, angles counter-clockwise.

use crate::scalar::{Lanes, Numeric, Pack, WIDEST, ZEROS};
use pulp::Simd;

/// Motion of a body.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Motion<T> {
    /// Centre (y, z), m.
    pub position: [T; 2],
    /// Velocity of the centre, m/s.
    pub velocity: [T; 2],
    /// Rotation angle, rad.
    pub angle: T,
    /// Rotation speed, rad/s.
    pub speed: T,
}

/// Force and moment about the body's own centre.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Wrench<T> {
    /// Force components, N.
    pub force: [T; 2],
    /// Moment, N m.
    pub moment: T,
}

impl Wrench<f64> {
    /// Adds another one.
    #[inline]
    pub fn add(&mut self, other: &Self) {
        self.force[0] += other.force[0];
        self.force[1] += other.force[1];
        self.moment += other.moment;
    }

    /// Power on a body that moves like this, W.
    #[inline]
    pub fn power(&self, body: &Motion<f64>) -> f64 {
        self.force[0] * body.velocity[0] + self.force[1] * body.velocity[1] + self.moment * body.speed
    }
}

impl<T: Copy> Wrench<T> {
    /// (force, force, moment).
    #[inline]
    pub fn components(&self) -> [T; 3] {
        [self.force[0], self.force[1], self.moment]
    }
}

/// Direction of the axes of a local frame, by the sine and the cosine of its angle.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Frame<T> {
    /// Sine.
    pub sin: T,
    /// Cosine.
    pub cos: T,
}

impl<T: Numeric> Frame<T> {
    /// A global vector in this frame.
    #[inline(always)]
    pub fn to_local(self, v: [T; 2]) -> [T; 2] {
        rotate(v, -self.sin, self.cos)
    }

    /// A vector of this frame in global axes.
    #[inline(always)]
    pub fn to_global(self, v: [T; 2]) -> [T; 2] {
        rotate(v, self.sin, self.cos)
    }
}

impl Frame<Lanes> {
    /// Global axes.
    pub const GLOBAL_LANES: Self = Self { sin: ZEROS, cos: [1.0; WIDEST] };

    /// Frame at a place of the lanes.
    #[inline(always)]
    pub fn of(&self, lane: usize) -> Frame<f64> {
        let i = lane % WIDEST;
        Frame { sin: self.sin[i], cos: self.cos[i] }
    }

    /// Sets the frame at a place of the lanes.
    #[inline(always)]
    pub fn set(&mut self, lane: usize, frame: Frame<f64>) {
        let i = lane % WIDEST;
        (self.sin[i], self.cos[i]) = (frame.sin, frame.cos);
    }

    /// Frames from this place of the lanes on, as many as fit.
    #[inline(always)]
    pub fn load<S: Simd, const K: usize>(&self, simd: S, lane: usize) -> Frame<Pack<S, K>> {
        Frame { sin: Pack::load(simd, &self.sin[lane..]), cos: Pack::load(simd, &self.cos[lane..]) }
    }

    /// Sets the frames from this place of the lanes on.
    #[inline(always)]
    pub fn store<S: Simd, const K: usize>(&mut self, lane: usize, frame: Frame<Pack<S, K>>) {
        frame.sin.store(&mut self.sin[lane..]);
        frame.cos.store(&mut self.cos[lane..]);
    }
}

/// Rotates `v` by the angle whose sine and cosine are given.
#[inline(always)]
pub fn rotate<T: Numeric>(v: [T; 2], sin: T, cos: T) -> [T; 2] {
    [v[0] * cos - v[1] * sin, v[0] * sin + v[1] * cos]
}
