//! Which outputs depend on which inputs at the same instant, by what outputs are made of.

use super::Model;
use crate::bodies::Input;

/// What an output is made of beside states and angles.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Sees(u8);

impl Sees {
    /// States alone.
    pub(crate) const STATES: Self = Self(0);
    /// Places of rings and their rates.
    pub(crate) const PLACES: Self = Self(1);
    /// Speeds of rings and of elements.
    pub(crate) const SPEEDS: Self = Self(2);
    /// The viscosity.
    pub(crate) const TEMPERATURE: Self = Self(4);
    /// Forces of contacts and guides: all but loads, which accelerate bodies and act on nothing else.
    pub(crate) const FORCES: Self = Self(7);

    fn has(self, other: Self) -> bool {
        self.0 & other.0 != 0
    }
}

/// What an input is of that outputs see.
fn acts_on(input: Input) -> Sees {
    if input.place().is_some() {
        return Sees::PLACES;
    }
    match input {
        Input::RingSpeed | Input::OuterRingSpeed | Input::OrbitSpeed | Input::SpinSpeed => Sees::SPEEDS,
        Input::Temperature => Sees::TEMPERATURE,
        _ => Sees::STATES,
    }
}

impl Model {
    /// Places of the outputs that may change at once with each input, ascending, in the order of [`Model::input_infos`]; of all others the
    /// derivative over that input is zero at all states.
    pub(crate) fn feedthrough(&self) -> Vec<Vec<usize>> {
        let seen_by = |input| {
            let moved = acts_on(input);
            let channels = self.channels().iter().enumerate();
            channels.filter(|(_, channel)| channel.source.sees().has(moved)).map(|(place, _)| place).collect()
        };
        self.input_list().map(seen_by).collect()
    }
}
