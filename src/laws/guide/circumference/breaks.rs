//! Places where the integrand of a film has a kink.
//!
//! The layer ends where h = h_L, the pressure where G = 0, and the viscosity stops growing where s = s_cap, which is where
//! K = G + c h^3 = 0. The circle is looked at in at least 16 steps per period of the highest order. In a step at
//! whose ends a function has different signs there is one place. Where it has not, but its slope says that it turns back
//! towards zero in between, the place where it turns is found first: that tells whether there are two. So nothing is
//! missed but what a function does by turning twice within one step.

use super::gap::Gap;
use super::roots::{Aim, Bracket, Brackets};
use super::samples::{GROUP, Memory, Sample, Samples, Signs, with_memory};
use super::stretch::{Aims, Break, DRY, EXCESS, FUNCTIONS, Functions, MOST_DRY, OPENING, Stretch};
use pulp::Arch;

/// A drop of the film between two points by this share of it is looked at.
const THIN: f64 = 0.25;

/// Share of a rise that slopes which do not change evenly may add to it: in 16 steps per period it is below 0.02.
const UNEVEN: f64 = 0.05;

/// What a search sees of one step.
struct Step<'a> {
    /// rad
    ends: [f64; 2],
    samples: [Sample<'a>; 2],
    /// Those at both ends, each in the lowest bits.
    signs: [Signs; 2],
}

/// Search over the circle, stretch by stretch.
pub(in crate::laws::guide) struct Search<'a> {
    functions: Functions<'a>,
    instructions: Arch,
    samples: Samples<'a>,
}

impl<'a> Search<'a> {
    /// Of a gap in a layer of this thickness, m, infinite where everything is wet.
    pub fn new(gap: &'a Gap<'a>, layer: f64, aims: Aims, instructions: Arch, memory: Memory<'a>) -> Self {
        let functions = Functions { gap, layer, aims };
        Self { functions, instructions, samples: Samples::new(gap.order(), memory) }
    }

    /// Smallest film at the ends of steps, m, once a stretch was found; of bent surfaces only. Between them none is thinner by
    /// more than the curvature allows.
    pub fn lowest(&self) -> f64 {
        self.samples.lowest()
    }

    /// Goes on to the next stretch; whether there is one.
    pub fn next(&mut self, out: &mut Stretch) -> bool {
        let steps = self.samples.count();
        if out.last_step == steps {
            return false;
        }
        out.go_on();
        let mut brackets = Brackets::default();
        let start = out.last_step;
        let mut known = None;
        (out.last_step, out.to) = (steps, self.samples.angle(steps));
        'groups: for group in start / GROUP..steps / GROUP {
            self.samples.reach(group, &self.functions, self.instructions);
            let (here, after) = (self.samples.group(group), self.samples.group(group + 1));
            let signs = here.signs();
            let next = signs.shifted(after.signs());
            let first = if known.is_none() { start % GROUP } else { 0 };
            let known = known.get_or_insert_with(|| {
                let values = std::array::from_fn(|of| signs.values(of) >> first & 1 == 1);
                out.begin(self.samples.angle(start), values);
                out.look_at(here.at(first).film()[0], out.from);
                values
            });
            let mut left = self.changing(signs, next) >> first << first;
            while left != 0 {
                let i = left.trailing_zeros() as usize;
                left &= left - 1;
                let k = group * GROUP + i;
                let angle = self.samples.angle(k);
                if !brackets.has_room() || out.dry >= MOST_DRY {
                    (out.last_step, out.to) = (k, angle);
                    break 'groups;
                }
                let step = Step {
                    ends: [angle, self.samples.angle(k + 1)],
                    samples: [here.at(i), if i + 1 < GROUP { here.at(i + 1) } else { after.at(0) }],
                    signs: [Signs(signs.0 >> i), Signs(next.0 >> i)],
                };
                self.add_step(&step, known, &mut brackets, out);
            }
        }
        if brackets.count > 0 {
            self.refine(&mut brackets, out);
        }
        true
    }

    /// A bit for each step of a group in which something may be: where a function crosses zero or turns back towards it, or the
    /// film is thinnest. Where both ends are dry, nothing acts: only a film that turns back there may do something.
    fn changing(&self, signs: Signs, next: Signs) -> u8 {
        let changes = signs.changes(next);
        let of = |of: usize| {
            let towards = signs.slopes(of) ^ signs.values(of);
            changes.values(of) | (changes.slopes(of) & towards)
        };
        let wet = signs.values(DRY) | next.values(DRY);
        let thinnest = changes.slopes(DRY) & signs.slopes(DRY);
        of(DRY) | thinnest | (of(OPENING) | of(EXCESS)) & wet
    }

    /// Adds the brackets of a step. Signs that are `known` are those of the last place that was not dry.
    #[inline(always)]
    fn add_step(
        &self,
        step: &Step<'_>,
        known: &mut [bool; FUNCTIONS],
        brackets: &mut Brackets,
        out: &mut Stretch,
    ) {
        let of_dry = brackets.count;
        self.add_brackets(DRY, step, brackets);
        let Step { ends, signs, .. } = step;
        let wet = (signs[0].values(DRY) | signs[1].values(DRY)) & 1 == 1;
        if !wet && brackets.count == of_dry {
            return;
        }
        for (of, known) in known.iter_mut().enumerate().skip(OPENING) {
            let (before, after) = (signs[0].values(of) & 1 == 1, signs[1].values(of) & 1 == 1);
            if *known != before {
                out.breaks.add(ends[0], of);
                out.dry += 1;
            }
            *known = after;
            self.add_brackets(of, step, brackets);
        }
    }

    /// Adds the brackets of one function in a step.
    #[inline(always)]
    fn add_brackets(&self, of: usize, step: &Step<'_>, brackets: &mut Brackets) {
        let Step { ends, samples, signs } = *step;
        let changes = signs[0].changes(signs[1]);
        let (crosses, turns) = (changes.values(of) & 1 == 1, changes.slopes(of) & 1 == 1);
        if !crosses && !turns {
            return;
        }
        let at = |sample: Sample<'_>| self.functions.of_values(of, sample.film(), sample.opening());
        let ([a, da], [b, db]) = (at(samples[0]), at(samples[1]));
        let (negative, rises) = (signs[0].values(of) & 1 == 1, signs[0].slopes(of) & 1 == 1);
        let bracket =
            |rises: bool, aim: Aim| Bracket { ends, values: [a, b], slopes: [da, db], rises, of, aim };
        if crosses {
            brackets.add(bracket(negative, Aim::Zero));
        }
        if !turns {
            return;
        }
        // Where slopes change evenly; the value there, seen from either end.
        let length = ends[1] - ends[0];
        let turn = da / (da - db);
        let rise = [0.5 * da * turn * length, -0.5 * db * (1.0 - turn) * length];
        let seen = [a + rise[0], b + rise[1]];
        let sign = if negative { -1.0 } else { 1.0 };
        let unsure = (seen[0] - seen[1]).abs() + UNEVEN * (rise[0] + rise[1]).abs();
        let nearly_zero = sign * seen[0] < unsure;
        if !crosses && rises != negative && nearly_zero {
            brackets.add(bracket(rises, Aim::Turn { negative }));
        } else if of == DRY && rises && self.may_be_thinnest(samples, -rise[0].min(rise[1])) {
            brackets.add(bracket(rises, Aim::Lowest));
        }
    }

    /// Whether a film that seems to drop by this between these places (m) has to be known better. Forces only ask
    /// whether there is one.
    fn may_be_thinnest(&self, [a, b]: [Sample<'_>; 2], drop: f64) -> bool {
        self.functions.aims == Aims::Minima || drop > THIN * a.film()[0].min(b.film()[0])
    }

    /// Tells every part of the circle where the film is thinner than the layer, cut where G changes its sign, rad.
    pub fn over_wet(mut self, mut tell: impl FnMut(f64, f64)) {
        let mut stretch = Stretch::new();
        while self.next(&mut stretch) {
            let (mut wet, mut from) = (stretch.negative[DRY], stretch.from);
            let end = Break { angle: stretch.to, of: OPENING };
            for b in stretch.breaks.all().iter().chain([&end]) {
                if wet && b.angle > from {
                    tell(from, b.angle);
                }
                wet ^= b.of == DRY;
                from = b.angle;
            }
        }
    }

    /// Number of arcs where the film is thinner than the layer, and the angle that they take together, rad.
    pub fn wet_arcs(self) -> (u32, f64) {
        let ends = [0, self.samples.count()].map(|k| self.samples.angle(k));
        let (mut starts, mut angle, mut last) = (0, 0.0, f64::NAN);
        let mut first = None;
        self.over_wet(|from, to| {
            first.get_or_insert(from);
            starts += u32::from(from != last);
            angle += to - from;
            last = to;
        });
        // What ends where the circle does goes on where it begins.
        let goes_on = starts > 1 && first == Some(ends[0]) && last >= ends[1] - 1e-12;
        (starts - u32::from(goes_on), angle)
    }

    /// Finds the places in these brackets; where functions turned back beyond zero, there are more.
    fn refine(&self, brackets: &mut Brackets, out: &mut Stretch) {
        let count = brackets.count;
        brackets.find(&self.functions, self.instructions);
        let mut more = None;
        for i in 0..count {
            let (angle, of) = (brackets.angle[i], brackets.of[i] as usize);
            let aim = brackets.aim[i];
            if aim == Aim::Zero {
                out.breaks.add(angle, of);
                continue;
            }
            if of == DRY {
                out.look_at(brackets.film[i], angle);
            }
            let [a, b] = [brackets.ends[0][i], brackets.ends[1][i]];
            let Aim::Turn { negative } = aim else { continue };
            let beyond = if negative { brackets.value[i] > 0.0 } else { brackets.value[i] < 0.0 };
            if beyond && a < angle && angle < b {
                let more = more.get_or_insert_with(Brackets::default);
                for (ends, rises) in [([a, angle], negative), ([angle, b], !negative)] {
                    let (values, slopes, aim) = ([0.0; 2], [0.0; 2], Aim::Zero);
                    more.add(Bracket { ends, values, slopes, rises, of, aim });
                }
            }
        }
        if let Some(more) = &mut more {
            self.refine(more, out);
        }
    }
}

impl Gap<'_> {
    /// Smallest film, m, and where it is, rad.
    pub(in crate::laws::guide) fn smallest(&self, instructions: Arch) -> [f64; 2] {
        with_memory(self.order(), |memory| {
            let mut search = Search::new(self, 0.0, Aims::Minima, instructions, memory);
            let mut stretch = Stretch::new();
            while search.next(&mut stretch) {}
            [stretch.thinnest, stretch.thinnest_at]
        })
    }
}
