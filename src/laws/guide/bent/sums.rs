//! Fourier coefficients around the circle of what a film or a solid contact does at each place, and of its derivatives.

use super::points::{
    AtEnds, FUNCTIONS, OF_VELOCITIES, Of, Points, SHORT, SHORT_OF_VELOCITIES, Slopes, Values,
};
use super::surface::SurfaceLaw;
use super::{BentSurface, Wanted};
use crate::laws::guide::circumference::gap::Gap;
use crate::laws::guide::circumference::panels::{Ends, Panel, PanelSums, Piece};
use crate::laws::guide::circumference::rule::total;
use crate::scalar::{Columns, Lanes, Numeric, Pack, WIDEST, ZEROS, dispatch};
use pulp::{Arch, Simd};

/// Widest panel of a solid contact, rad.
const WIDEST_PANEL: f64 = 0.25;
/// Halvings of one: its damper has kinks.
const DEEPEST: u32 = 8;

/// Cosine and sine coefficients of a function times two pi (times pi for the mean's cosine), lane by lane. Registers do not cross cache
/// lines.
#[derive(Clone, Copy, Debug)]
#[repr(align(64))]
struct Coefficients([Lanes; 2]);

impl Coefficients {
    const NONE: Self = Self([ZEROS; 2]);

    fn totals(&self) -> [f64; 2] {
        self.0.each_ref().map(total)
    }
}

/// The sums of one state.
#[derive(Clone, Debug)]
pub(super) struct Sums {
    /// Highest order of the waves.
    order: usize,
    wanted: Wanted,
    forces: Box<Forces>,
    lanes: Vec<Coefficients>,
    /// Their totals, once they are complete.
    totals: Vec<[f64; 2]>,
    points: Box<Points>,
}

/// Sums of the forces.
#[derive(Clone, Debug)]
struct Forces {
    /// n tau_n and tau_n of each order from one on.
    along: Vec<[f64; 2]>,
    /// Over the cosine and the sine of each order without s: -N + n tau E on its own wave and T tau on the other.
    on_waves: Vec<Coefficients>,
    /// Of the pressure, order one.
    pressure: Coefficients,
    /// About the centre of the journal, with that of the pressure on waves.
    moment: Lanes,
}

/// Forces of the sums on the journal.
pub(super) struct Found {
    pub pressure: [f64; 2],
    pub shear: [f64; 2],
    pub moment: f64,
}

impl Sums {
    /// Memory for the waves of a surface.
    pub(super) fn new(surface: &BentSurface) -> Self {
        let order = surface.waves.iter().map(|(order, _)| *order).max().unwrap_or(1) as usize;
        let mut along = vec![[0.0; 2]; order];
        along[0] = [-1.0; 2];
        for (order, tau) in &surface.waves {
            along[*order as usize - 1] = [f64::from(*order) * tau, *tau];
        }
        let forces = Forces {
            along,
            on_waves: vec![Coefficients::NONE; order],
            pressure: Coefficients::NONE,
            moment: ZEROS,
        };
        let count = SHORT * (order + 1) + (FUNCTIONS - SHORT) * (2 * order + 1);
        Self {
            order,
            wanted: Wanted::Forces,
            forces: Box::new(forces),
            lanes: vec![Coefficients::NONE; count],
            totals: vec![[0.0; 2]; count],
            points: Box::default(),
        }
    }

    /// Starts anew.
    pub(super) fn begin(&mut self, wanted: Wanted) {
        self.wanted = wanted;
        let Forces { on_waves, pressure, moment, .. } = &mut *self.forces;
        on_waves.fill(Coefficients::NONE);
        (*pressure, *moment) = (Coefficients::NONE, ZEROS);
        for range in self.used() {
            self.lanes[range].fill(Coefficients::NONE);
        }
    }

    /// Places of the coefficients that are found.
    fn used(&self) -> [std::ops::Range<usize>; 2] {
        let [short, long] = used(self.wanted);
        let first = SHORT * (self.order + 1);
        [0..short * (self.order + 1), first..first + (long - SHORT) * (2 * self.order + 1)]
    }

    /// Place of the first coefficients of a function.
    #[inline(always)]
    fn first(&self, of: usize) -> usize {
        let short = self.order + 1;
        if of < SHORT { of * short } else { SHORT * short + (of - SHORT) * (2 * self.order + 1) }
    }

    /// The sums over panels of a law.
    pub(super) fn over<'a, L: SurfaceLaw>(&'a mut self, law: &'a L) -> SumsOver<'a, L> {
        SumsOver { sums: self, law }
    }

    /// Coefficients of a function of this order; of a negative one, the sine is the opposite.
    #[inline]
    pub(super) fn of(&self, function: Of, order: isize) -> [f64; 2] {
        let [cos, sin] = self.totals[self.first(function as usize) + order.unsigned_abs()];
        [cos, if order < 0 { -sin } else { sin }]
    }

    /// Completes the sums; the forces. Those over each wave, without s, are told with its order.
    pub(super) fn forces(&mut self, mut tell: impl FnMut(usize, [f64; 2])) -> Found {
        for range in self.used() {
            for (totals, lanes) in self.totals[range.clone()].iter_mut().zip(&self.lanes[range]) {
                *totals = lanes.totals();
            }
        }
        let Forces { on_waves, pressure, moment, .. } = &*self.forces;
        let mut on_centre = [0.0; 2];
        for (i, lanes) in on_waves.iter().enumerate() {
            let force = lanes.totals();
            if i == 0 {
                on_centre = force;
            }
            tell(i + 1, force);
        }
        let pressure = pressure.totals().map(|x| -x);
        let shear = [on_centre[0] - pressure[0], on_centre[1] - pressure[1]];
        Found { pressure, shear, moment: total(moment) }
    }

    /// Adds the places from `from` to `to` (rad).
    pub(super) fn add_pieces<L: SurfaceLaw>(
        &mut self,
        law: &L,
        gap: &Gap<'_>,
        from: f64,
        to: f64,
        instructions: Arch,
    ) {
        let panels = ((to - from) / WIDEST_PANEL).ceil().max(1.0);
        let width = (to - from) / panels;
        for i in 0..panels as usize {
            let start = from + i as f64 * width;
            self.add_panel(law, gap, [start, start + width], DEEPEST, instructions);
        }
    }

    /// Adds a panel, or its halves.
    fn add_panel<L: SurfaceLaw>(
        &mut self,
        law: &L,
        gap: &Gap<'_>,
        [from, to]: [f64; 2],
        halvings: u32,
        instructions: Arch,
    ) {
        let panel = Panel::new(gap, &Piece::STRAIGHT, [from, to]);
        let checked = (halvings > 0).then_some(0.0);
        if self.over(law).add(&panel, checked, instructions) != [true; 2] {
            let middle = 0.5 * (from + to);
            self.add_panel(law, gap, [from, middle], halvings - 1, instructions);
            self.add_panel(law, gap, [middle, to], halvings - 1, instructions);
        }
    }

    /// Adds the functions at the points to their coefficients.
    fn add_points(&mut self, instructions: Arch, count: usize) {
        let (order, wanted) = (self.order, self.wanted);
        let first = [SHORT * (order + 1), 2 * order + 1];
        let Self { forces, lanes, points, .. } = self;
        dispatch(instructions, ForceWaves { forces, points, count });
        if wanted != Wanted::Forces {
            dispatch(instructions, Waves { order, wanted, first, lanes, points, count });
        }
    }
}

/// Sums over panels of a law.
pub(super) struct SumsOver<'a, L> {
    sums: &'a mut Sums,
    law: &'a L,
}

impl<L: SurfaceLaw> PanelSums for SumsOver<'_, L> {
    fn add(&mut self, panel: &Panel<'_>, checked: Option<f64>, instructions: Arch) -> [bool; 2] {
        let Self { sums, law } = self;
        let points = &mut *sums.points;
        dispatch(instructions, Values { law: *law, panel, points });
        let [stress, cubes] = &points.series;
        let suits = panel.suit([&points.normal, stress, cubes], checked);
        if suits == [false; 2] {
            return suits;
        }
        let Points { normal, along, inward, moment, .. } = points;
        let panel = &panel.only(suits, [normal, along, inward, moment]);
        match sums.wanted {
            Wanted::Forces => {}
            Wanted::Damping => dispatch(instructions, Slopes::<_, 2> { law: *law, panel, points }),
            Wanted::Slopes => dispatch(instructions, Slopes::<_, 4> { law: *law, panel, points }),
        }
        sums.add_points(instructions, WIDEST);
        suits
    }

    fn add_ends(&mut self, ends: &Ends<'_>, instructions: Arch) {
        let Self { sums, law } = self;
        (sums.points.normal, sums.points.inward) = (ZEROS, ZEROS);
        if sums.wanted != Wanted::Forces {
            sums.points.of.fill(ZEROS);
        }
        let slopes = sums.wanted != Wanted::Forces;
        dispatch(instructions, AtEnds { law: *law, ends, points: &mut sums.points, slopes });
        sums.add_points(instructions, ends.count);
    }

    fn moves_ends(&self) -> bool {
        self.sums.wanted == Wanted::Slopes
    }
}

/// Multiplies what is at the points with all waves: the forces.
struct ForceWaves<'a> {
    forces: &'a mut Forces,
    points: &'a Points,
    count: usize,
}

impl Columns for ForceWaves<'_> {
    const PAIRED: bool = false;

    fn rows(&self) -> usize {
        self.count
    }

    #[inline(always)]
    fn group<S: Simd, const K: usize>(&mut self, simd: S, first: usize) {
        let Points { normal, along, inward, moment, cos, sin, .. } = self.points;
        let of = |lanes: &Lanes| Pack::<S, K>::load(simd, &lanes[first..]);
        let [normal, along, inward, cos, sin] = [of(normal), of(along), of(inward), of(cos), of(sin)];
        let Forces { along: factors, on_waves, pressure, moment: sum } = &mut *self.forces;
        of(moment).add_to(&mut sum[first..]);
        (normal * cos).add_to(&mut pressure.0[0][first..]);
        (normal * sin).add_to(&mut pressure.0[1][first..]);
        let (mut wave, mut before) = ([cos, sin], [cos.like(1.0), cos.like(0.0)]);
        let twice = cos * 2.0;
        for i in 0..factors.len() {
            let [of_inward, of_along] = factors[i];
            let (own, other) = (inward * of_inward - normal, along * of_along);
            let [c, s] = wave;
            (c * own + s * other).add_to(&mut on_waves[i].0[0][first..]);
            (s * own - c * other).add_to(&mut on_waves[i].0[1][first..]);
            (wave, before) = ([twice * c - before[0], twice * s - before[1]], wave);
        }
    }
}

/// Functions that are found: their number of one order, and the number behind them and those of twice the order.
#[inline(always)]
fn used(wanted: Wanted) -> [usize; 2] {
    match wanted {
        Wanted::Forces => [0, SHORT],
        Wanted::Damping => [SHORT_OF_VELOCITIES, OF_VELOCITIES],
        Wanted::Slopes => [SHORT, FUNCTIONS],
    }
}

/// Multiplies the derivatives at the points with all waves.
struct Waves<'a> {
    order: usize,
    wanted: Wanted,
    /// Place of the first coefficients of the long functions, and their number of each.
    first: [usize; 2],
    lanes: &'a mut [Coefficients],
    points: &'a Points,
    count: usize,
}

impl Columns for Waves<'_> {
    const PAIRED: bool = false;

    fn rows(&self) -> usize {
        self.count
    }

    #[inline(always)]
    #[expect(clippy::needless_range_loop, reason = "iterators might not be inlined")]
    fn group<S: Simd, const K: usize>(&mut self, simd: S, first: usize) {
        let Points { of, cos, sin, .. } = self.points;
        let (cos, sin) = (Pack::<S, K>::load(simd, &cos[first..]), Pack::load(simd, &sin[first..]));
        let [short, long] = used(self.wanted);
        let [of_long, each] = self.first;
        let mut wave = [cos.like(1.0), cos.like(0.0)];
        debug_assert!(self.count <= WIDEST);
        for order in 0..=2 * self.order {
            if order <= self.order {
                for function in 0..short {
                    let value = Pack::<S, K>::load(simd, &of[function][first..]);
                    let [c, s] = &mut self.lanes[function * (self.order + 1) + order].0;
                    (value * wave[0]).add_to(&mut c[first..]);
                    (value * wave[1]).add_to(&mut s[first..]);
                }
            }
            for function in SHORT..long {
                let value = Pack::<S, K>::load(simd, &of[function][first..]);
                let [c, s] = &mut self.lanes[of_long + (function - SHORT) * each + order].0;
                (value * wave[0]).add_to(&mut c[first..]);
                (value * wave[1]).add_to(&mut s[first..]);
            }
            let [c, s] = wave;
            wave = [c * cos - s * sin, s * cos + c * sin];
        }
    }
}
