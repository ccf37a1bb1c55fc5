//! How the speeds of contacts change in a semi-implicit step: found once for all that ask.

use crate::bodies::OF_ELEMENT;
use crate::integrate::SemiImplicit;

/// Changes of the speeds of one contact, m/s: mean over the step, and slip at which friction acts.
#[derive(Clone, Copy, Debug, Default)]
pub(in crate::model) struct Changes {
    pub(in crate::model) approach_speed: f64,
    pub(in crate::model) slip: f64,
    pub(in crate::model) acting_slip: f64,
}

/// Those of all contacts, by batch, in the step from the last evaluated state.
#[derive(Clone, Debug)]
pub(in crate::model) struct StepChanges {
    /// Of the speeds of every element in its local frame: mean over the step, and to its end.
    pub(super) of_elements: Vec<[[f64; OF_ELEMENT]; 2]>,
    pub(super) of_batches: Vec<Vec<Changes>>,
    /// Shares of the change of slip at which the friction of all contacts acts, for a step of this size in s.
    pub(super) shares: Vec<Vec<f64>>,
    pub(super) h: f64,
    /// Whether they are those of the last evaluated state.
    pub(super) found: bool,
}

impl StepChanges {
    /// Memory for these elements, and for so many contacts in each batch.
    pub(in crate::model) fn new(elements: usize, most: impl Iterator<Item = usize>) -> Self {
        let of_elements = vec![[[0.0; OF_ELEMENT]; 2]; elements];
        let (of_batches, shares) = most.map(|n| (Vec::with_capacity(n), Vec::with_capacity(n))).unzip();
        Self { of_elements, of_batches, shares, h: f64::NAN, found: false }
    }

    /// Forgets them, as another state is evaluated.
    #[inline]
    pub(in crate::model) fn forget(&mut self) {
        (self.h, self.found) = (f64::NAN, false);
    }

    /// Of contact `i` of a batch in its step; none without a step, or where the motion of elements is prescribed.
    #[inline]
    pub(in crate::model) fn of(&self, batch: usize, i: usize, step: Option<&SemiImplicit<'_>>) -> Changes {
        step.and_then(|_| self.of_batches[batch].get(i).copied()).unwrap_or_default()
    }
}
