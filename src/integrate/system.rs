//! What methods ask of a system: every one the accelerations, some more.

use super::linear::Arrowhead;
use super::methods::damping::GroupDamping;
use std::ops::Range;

/// A second-order system `q' = v[..positions]`, `v' = a(t, q, v)`. Velocities beyond the positions have no position.
///
/// A state vector is (q, v).
pub trait System {
    /// Why an evaluation failed.
    type Fault: Copy;

    /// Number of positions.
    fn positions(&self) -> usize;
    /// Number of velocities, at least the number of positions.
    fn velocities(&self) -> usize;
    /// Accelerations at time `t` in s. A failure makes the driver retry with a smaller step.
    ///
    /// # Errors
    /// The system's fault when forces are undefined at this state.
    fn accelerations(&mut self, t: f64, q: &[f64], v: &[f64], a: &mut [f64]) -> Result<(), Self::Fault>;
    /// The fault for a result that is not finite at the index of a velocity.
    fn not_finite(&self, velocity: usize) -> Self::Fault;
    /// The first time after `t` at which the accelerations jump or kink by themselves; infinity if there is none.
    fn next_event(&self, _t: f64) -> f64 {
        f64::INFINITY
    }
    /// The longest step (s) from this state at time `t` in which nothing narrow can be passed unseen, or any longer one than
    /// `wanted`. No method takes a longer one.
    fn longest_step(&self, _t: f64, _q: &[f64], _v: &[f64], _wanted: f64) -> f64 {
        f64::INFINITY
    }
    /// Velocities of each group that belongs together, as those of one body do. Asked once.
    fn groups(&self) -> Vec<Vec<usize>> {
        Vec::new()
    }
}

/// A system that knows how its velocities are coupled: spokes of `N` velocities each to a hub.
pub trait Structured<const N: usize>: System {
    /// Which velocities are coupled. Asked once.
    fn structure(&self) -> Structure<N>;
}

/// A system that knows the derivatives of its accelerations: what implicit methods need.
pub trait Linearized<const N: usize>: Structured<N> {
    /// Accelerations `a` at time `t` in s, and their derivatives.
    ///
    /// # Errors
    /// The system's fault when forces are undefined at this state.
    fn linearize(
        &mut self,
        t: f64,
        q: &[f64],
        v: &[f64],
        a: &mut [f64],
        out: &mut Linearization<N>,
    ) -> Result<(), Self::Fault>;
    /// Time that the derivatives take beside the accelerations, in evaluations of these.
    fn linearization_cost(&self) -> f64 {
        2.0
    }
}

/// A system that knows how its forces oppose velocities: what semi-implicit methods split off.
///
/// The step of the spokes is found first. The bodies of the hub follow: what the forces between them and the spokes have become
/// in that step acts on them, too.
pub trait Split<const N: usize>: Structured<N> {
    /// Accelerations at time `t` in s, as [`System::accelerations`], before [`Split::damping`]: a system that finds both together
    /// for less may do so.
    ///
    /// # Errors
    /// As those.
    fn accelerations_to_split(
        &mut self,
        t: f64,
        q: &[f64],
        v: &[f64],
        a: &mut [f64],
    ) -> Result<(), Self::Fault> {
        self.accelerations(t, q, v, a)
    }
    /// Damping of every spoke and every body of the hub at the state (`q`, `v`) that [`Split::accelerations_to_split`] has evaluated
    /// last, for a step of size `h` in s.
    fn damping(&mut self, h: f64, q: &[f64], v: &[f64], out: &mut GroupDamping<N>);
    /// Adds to the accelerations `a` of the hub what the forces between it and the spokes have become since the last
    /// evaluation, at (`q`, `v`), in the `step` of the spokes.
    fn react(&mut self, _q: &[f64], _v: &[f64], _step: &SemiImplicit<'_>, _a: &mut [f64]) {}
    /// Whether a step may end with these velocities, which nothing evaluates before the next one.
    ///
    /// # Errors
    /// As [`System::accelerations`].
    fn admit(&self, _v: &[f64]) -> Result<(), Self::Fault> {
        Ok(())
    }
}

/// What the owner of a system wants to know of a run, and says to it. Nothing by default.
pub trait Observed: System {
    /// Number of powers that are integrated over time beside the state, and of other rates behind them.
    fn power_count(&self) -> [usize; 2] {
        [0; 2]
    }
    /// Those powers (W) and rates at the last evaluated state (`q`, `v`), or in a step from there. A system may keep what it has
    /// found of a step until its next evaluation, so this and [`Split::react`] are told the same one.
    fn powers(&mut self, _q: &[f64], _v: &[f64], _step: Option<&SemiImplicit<'_>>, _out: &mut [f64]) {}
    /// Kinds of energy stored at the last evaluated state (`q`, `v`), J. Their rate is the sum of the powers.
    fn energy(&self, _q: &[f64], _v: &[f64]) -> [f64; 3] {
        [0.0; 3]
    }
    /// The fast vibration at the last evaluated state, which a method must not damp by itself.
    fn vibration(&self) -> Vibration {
        Vibration::default()
    }
    /// Number of quantities that the host watches in every step.
    fn watched(&self) -> usize {
        0
    }
    /// Their values, as those of [`Observed::powers`].
    fn watch(&mut self, _q: &[f64], _v: &[f64], _step: Option<&SemiImplicit<'_>>, _out: &mut [f64]) {}
    /// Whether the host wants the run to stop; asked before every attempt.
    fn interruption(&mut self) -> Option<Interruption> {
        None
    }
    /// Told of every attempt from time `t` (s) that failed with `fault`.
    fn failed(&mut self, _t: f64, _fault: Self::Fault) {}
    /// The fault of a run whose works since it began, up to its last step and in it (J), are such as no system can have. Asked
    /// after every step.
    fn overdrawn(&self, _works: [&[f64]; 2]) -> Option<Self::Fault> {
        None
    }
    /// Told of every attempt whose error in this group was too large.
    fn rejected(&mut self, _group: usize) {}
}

/// A system that any method can follow.
pub trait Complete<const N: usize>: Linearized<N> + Split<N> + Observed {}

impl<S: Linearized<N> + Split<N> + Observed, const N: usize> Complete<N> for S {}

/// Why a host stops a run.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Interruption {
    /// Asked to.
    Cancelled,
    /// The wall time is used up.
    OutOfTime,
}

/// A semi-implicit step, whose forces F are linear from those at the evaluated velocities v* on: F(v*) - D (v - v*) with the
/// share of the change of the step that [`super::implicit_share`] says, and do their work at the mean velocities.
#[derive(Clone, Copy, Debug)]
pub struct SemiImplicit<'a> {
    /// Mean velocities.
    pub mean: &'a [f64],
    /// Velocities at the end.
    pub end: &'a [f64],
    /// Step, s.
    pub h: f64,
}

/// Zero for each of the rates that a system integrates beside its state.
pub(crate) fn zero_works<S: Observed>(system: &S) -> Vec<f64> {
    vec![0.0; system.power_count().iter().sum()]
}

/// Parts of equal length.
pub(crate) fn parts_mut<const N: usize>(whole: &mut [f64]) -> [&mut [f64]; N] {
    let mut parts = whole.chunks_exact_mut((whole.len() / N).max(1));
    std::array::from_fn(|_| parts.next().unwrap_or_default())
}

/// `sum` + `weight` `x`, in place.
pub(crate) fn add_weighted(sum: &mut [f64], weight: f64, x: &[f64]) {
    for (sum, x) in sum.iter_mut().zip(x) {
        *sum += weight * x;
    }
}

/// How much a system vibrates: mean squares, added up.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Vibration {
    /// Sum of squared speeds, m^2/s^2.
    pub squares: f64,
    /// Number of speeds in it.
    pub count: f64,
}

impl Vibration {
    /// Adds another with a weight.
    pub fn add(&mut self, other: Self, weight: f64) {
        self.squares += weight * other.squares;
        self.count += weight * other.count;
    }

    /// Root mean square speed, m/s; zero of nothing.
    pub fn rms(self) -> f64 {
        if self.count > 0.0 { (self.squares / self.count).sqrt() } else { 0.0 }
    }
}

/// Velocities by their coupling: a hub, coupled to all, and spokes of `N` velocities each, coupled to the hub and, with a rim,
/// to the spokes before and behind them in a circle. Every velocity has one place.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Structure<const N: usize> {
    /// Velocity index of each place of the hub.
    pub hub: Vec<usize>,
    /// Places in the hub of each of its bodies.
    pub bodies: Vec<Range<usize>>,
    /// Velocity indices of each spoke.
    pub spokes: Vec<[usize; N]>,
    /// Whether spokes touch their neighbours.
    pub rim: bool,
}

impl<const N: usize> Structure<N> {
    /// One body of the first `n` velocities as the hub, with these spokes.
    pub fn around(n: usize, spokes: Vec<[usize; N]>) -> Self {
        Self { hub: (0..n).collect(), bodies: std::iter::once(0..n).collect(), spokes, rim: false }
    }

    /// Velocities of each spoke, then of each body of the hub.
    pub fn groups(&self) -> Vec<Vec<usize>> {
        let of_hub = self.bodies.iter().map(|places| self.hub[places.clone()].to_vec());
        self.spokes.iter().map(|spoke| spoke.to_vec()).chain(of_hub).collect()
    }
}

/// Derivatives of the accelerations at one state. Columns of velocities without position are zero in the first.
#[derive(Clone, Debug, PartialEq)]
pub struct Linearization<const N: usize> {
    /// da/dq.
    pub over_positions: Arrowhead<f64, N>,
    /// da/dv.
    pub over_velocities: Arrowhead<f64, N>,
    /// da/dt at constant state.
    pub over_time: Vec<f64>,
}

impl<const N: usize> Linearization<N> {
    /// Memory for a system of this structure with `velocities` velocities.
    pub fn new(structure: &Structure<N>, velocities: usize) -> Self {
        let zero = Arrowhead::of(structure);
        Self { over_positions: zero.clone(), over_velocities: zero, over_time: vec![0.0; velocities] }
    }

    /// Sets everything to zero.
    pub fn clear(&mut self) {
        self.over_positions.fill_zero();
        self.over_velocities.fill_zero();
        self.over_time.fill(0.0);
    }
}
