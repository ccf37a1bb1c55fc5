//! The steps of a stretch, kept for questions about them. Room is taken once.

use crate::integrate::add_weighted;
use crate::integrate::{Kept, Samples};

/// Steps that follow each other.
#[derive(Default)]
pub(super) struct Trail {
    /// Most steps.
    longest: usize,
    spans: Vec<Span>,
    /// States at the start and at the end of every step.
    states: Vec<f64>,
    /// Works up to the start of the first step, then those over every step.
    works: Vec<f64>,
    /// What methods keep beside the states.
    rest: Vec<f64>,
    /// Of as many steps as there is room for.
    samples: Vec<Samples>,
    /// Numbers of a state, and of works.
    state_size: usize,
    works_size: usize,
}

/// Time of a step (s), and where its rest ends.
struct Span {
    from: f64,
    to: f64,
    rest: usize,
}

/// One step of a trail.
#[derive(Clone, Copy)]
pub(super) struct Step<'a> {
    trail: &'a Trail,
    place: usize,
}

impl Trail {
    /// Room for this many steps of systems with so many numbers of a state and of works, `rest` numbers of which methods keep
    /// beside those, and samples of `watched` quantities at up to `places` places.
    pub fn new(
        longest: usize,
        [state, works]: [usize; 2],
        rest: usize,
        [watched, places]: [usize; 2],
    ) -> Self {
        Self {
            longest,
            spans: Vec::with_capacity(longest),
            states: Vec::with_capacity((longest + 1) * state),
            works: Vec::with_capacity((longest + 1) * works),
            rest: Vec::with_capacity(rest),
            samples: (0..longest).map(|_| Samples::new(watched, places)).collect(),
            state_size: state,
            works_size: works,
        }
    }

    /// Most steps; zero where none are kept.
    pub fn longest(&self) -> usize {
        self.longest
    }

    /// Begins at this state.
    pub fn begin(&mut self, state: &[f64]) {
        self.spans.clear();
        self.rest.clear();
        self.works.clear();
        self.states.clear();
        self.states.extend_from_slice(state);
    }

    /// Whether there is room for another step with a rest of this size.
    pub fn has_room(&self, rest: usize) -> bool {
        self.spans.len() < self.longest && self.rest.len() + rest <= self.rest.capacity()
    }

    /// Adds a step `from` and `to` a time (s) that ended in this state, with the works up to it and over it, and what `keep` adds
    /// to its rest.
    pub fn add(
        &mut self,
        [from, to]: [f64; 2],
        state: &[f64],
        [before, over]: [&[f64]; 2],
        samples: &Samples,
        keep: impl FnOnce(&mut Vec<f64>),
    ) {
        if self.spans.is_empty() {
            self.works.extend_from_slice(before);
        }
        self.works.extend_from_slice(over);
        self.states.extend_from_slice(state);
        keep(&mut self.rest);
        self.samples[self.spans.len()].copy(samples);
        self.spans.push(Span { from, to, rest: self.rest.len() });
    }

    /// All steps.
    pub fn steps(&self) -> impl Iterator<Item = Step<'_>> {
        (0..self.spans.len()).map(|place| Step { trail: self, place })
    }

    /// The step that time `t` (s) lies in, else the last one, if there is any.
    pub fn at(&self, t: f64) -> Option<Step<'_>> {
        let last = self.spans.len().checked_sub(1)?;
        let place = self.spans.partition_point(|span| span.to < t).min(last);
        Some(Step { trail: self, place })
    }

    /// Where it begins, s.
    pub fn from(&self) -> Option<f64> {
        self.spans.first().map(|span| span.from)
    }
}

impl<'a> Step<'a> {
    /// Its time, s.
    pub fn span(self) -> [f64; 2] {
        let Span { from, to, .. } = self.trail.spans[self.place];
        [from, to]
    }

    /// What the host watches.
    pub fn samples(self) -> &'a Samples {
        &self.trail.samples[self.place]
    }

    /// For the method that made it.
    pub fn kept(self) -> Kept<'a> {
        let Self { trail, place } = self;
        let state = |place: usize| &trail.states[place * trail.state_size..][..trail.state_size];
        let end_of_rest = |place: usize| trail.spans[place].rest;
        let before = place.checked_sub(1).map_or(0, end_of_rest);
        Kept { start: state(place), end: state(place + 1), rest: &trail.rest[before..end_of_rest(place)] }
    }

    /// Works up to a `share` of the step.
    pub fn works(self, share: f64, out: &mut [f64]) {
        let Self { trail, place } = self;
        let mut rows = trail.works.chunks_exact(trail.works_size.max(1));
        let Some(before) = rows.next() else { return };
        out.copy_from_slice(before);
        for (i, over) in rows.take(place + 1).enumerate() {
            add_weighted(out, if i < place { 1.0 } else { share }, over);
        }
    }
}
