//! States as flat arrays of numbers: saving and loading follow from one list of fields.

/// What can be saved as numbers and taken back.
pub trait Stored {
    /// Appends its numbers; always as many.
    fn save(&self, out: &mut Vec<f64>);
    /// Takes back what [`Stored::save`] wrote; `None` if it does not fit, and the state is then of no use.
    fn load(&mut self, from: &mut Reader<'_>) -> Option<()>;
}

/// Reads numbers in the order they were written.
#[derive(Debug)]
pub struct Reader<'a> {
    rest: &'a [f64],
}

impl<'a> Reader<'a> {
    /// Starts at the first number.
    pub fn new(values: &'a [f64]) -> Self {
        Self { rest: values }
    }

    /// The next number.
    fn number(&mut self) -> Option<f64> {
        let (first, rest) = self.rest.split_first()?;
        self.rest = rest;
        Some(*first)
    }

    /// The next number if it is a count.
    pub fn count(&mut self) -> Option<u64> {
        let x = self.number()?;
        (x >= 0.0 && x.fract() == 0.0 && x < 9e15).then_some(x as u64)
    }

    /// Whether everything was read.
    pub fn finished(&self) -> bool {
        self.rest.is_empty()
    }
}

/// Derives [`Stored`] of a type from its fields; `field[0]` is the first item of one. After loading, fields behind `then` have these values, and the whole must fulfil
/// the condition behind `if`.
macro_rules! stored {
    (
        impl[$($generics:tt)*] $type:ty { $($field:ident $([$at:literal])?),+ $(,)? }
        $(then { $($name:ident = $value:expr),+ $(,)? })?
        $(if $sound:expr)?
    ) => {
        impl<$($generics)*> $crate::stored::Stored for $type {
            fn save(&self, out: &mut Vec<f64>) {
                $($crate::stored::Stored::save(&self.$field $([$at])?, out);)+
            }

            fn load(&mut self, from: &mut $crate::stored::Reader<'_>) -> Option<()> {
                $($crate::stored::Stored::load(&mut self.$field $([$at])?, from)?;)+
                $($(self.$name = $value;)+)?
                $(
                    let sound: fn(&Self) -> bool = $sound;
                    if !sound(self) {
                        return None;
                    }
                )?
                Some(())
            }
        }
    };
}
pub(crate) use stored;

/// Derives [`Stored`] of an enumeration without data from the list of all its items in the order of its definition.
macro_rules! stored_choice {
    ($type:ty, $all:expr) => {
        impl $crate::stored::Stored for $type {
            fn save(&self, out: &mut Vec<f64>) {
                out.push(*self as usize as f64);
            }

            fn load(&mut self, from: &mut $crate::stored::Reader<'_>) -> Option<()> {
                *self = *$all.get(usize::try_from(from.count()?).ok()?)?;
                Some(())
            }
        }
    };
}
pub(crate) use stored_choice;

impl Stored for f64 {
    fn save(&self, out: &mut Vec<f64>) {
        out.push(*self);
    }

    fn load(&mut self, from: &mut Reader<'_>) -> Option<()> {
        *self = from.number()?;
        Some(())
    }
}

impl Stored for u64 {
    fn save(&self, out: &mut Vec<f64>) {
        out.push(*self as f64);
    }

    fn load(&mut self, from: &mut Reader<'_>) -> Option<()> {
        *self = from.count()?;
        Some(())
    }
}

impl Stored for usize {
    fn save(&self, out: &mut Vec<f64>) {
        out.push(*self as f64);
    }

    fn load(&mut self, from: &mut Reader<'_>) -> Option<()> {
        *self = from.count()?.try_into().ok()?;
        Some(())
    }
}

impl Stored for bool {
    fn save(&self, out: &mut Vec<f64>) {
        out.push(f64::from(u8::from(*self)));
    }

    fn load(&mut self, from: &mut Reader<'_>) -> Option<()> {
        *self = from.count().filter(|n| *n <= 1)? == 1;
        Some(())
    }
}

/// One that is absent takes the place of its default.
impl<T: Stored + Copy + Default> Stored for Option<T> {
    fn save(&self, out: &mut Vec<f64>) {
        self.is_some().save(out);
        self.unwrap_or_default().save(out);
    }

    fn load(&mut self, from: &mut Reader<'_>) -> Option<()> {
        let mut read = (false, T::default());
        read.load(from)?;
        *self = read.0.then_some(read.1);
        Some(())
    }
}

impl<A: Stored, B: Stored> Stored for (A, B) {
    fn save(&self, out: &mut Vec<f64>) {
        self.0.save(out);
        self.1.save(out);
    }

    fn load(&mut self, from: &mut Reader<'_>) -> Option<()> {
        self.0.load(from)?;
        self.1.load(from)
    }
}

impl<T: Stored, const N: usize> Stored for [T; N] {
    fn save(&self, out: &mut Vec<f64>) {
        self.iter().for_each(|part| part.save(out));
    }

    fn load(&mut self, from: &mut Reader<'_>) -> Option<()> {
        self.iter_mut().try_for_each(|part| part.load(from))
    }
}

/// As many as there are.
impl<T: Stored> Stored for Vec<T> {
    fn save(&self, out: &mut Vec<f64>) {
        self.iter().for_each(|part| part.save(out));
    }

    fn load(&mut self, from: &mut Reader<'_>) -> Option<()> {
        self.iter_mut().try_for_each(|part| part.load(from))
    }
}

impl<T: Stored + ?Sized> Stored for Box<T> {
    fn save(&self, out: &mut Vec<f64>) {
        (**self).save(out);
    }

    fn load(&mut self, from: &mut Reader<'_>) -> Option<()> {
        (**self).load(from)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[derive(Clone, Debug, PartialEq)]
    struct Everything {
        number: f64,
        counts: [u64; 2],
        place: usize,
        flag: bool,
        set: [Option<f64>; 2],
        list: Vec<f64>,
        derived: f64,
    }

    stored! {
        impl[] Everything { number, counts, place, flag, set, list }
        then { derived = -1.0 }
        if |all| all.number >= 0.0
    }

    #[test]
    fn what_is_saved_is_loaded_and_nothing_else() {
        let there = Everything {
            number: 2.5,
            counts: [7, 1 << 50],
            place: 3,
            flag: true,
            set: [None, Some(-4.0)],
            list: vec![0.5, f64::MIN_POSITIVE],
            derived: 9.0,
        };
        let mut numbers = Vec::new();
        there.save(&mut numbers);
        let empty = Everything {
            number: 0.0,
            counts: [0; 2],
            place: 0,
            flag: false,
            set: [Some(1.0); 2],
            list: vec![0.0; 2],
            derived: 0.0,
        };
        let mut back = empty.clone();
        let mut from = Reader::new(&numbers);
        assert_eq!((back.load(&mut from), from.finished()), (Some(()), true));
        assert_eq!(back, Everything { derived: -1.0, ..there });
        assert_eq!(empty.clone().load(&mut Reader::new(&numbers[1..])), None);
        // A number below zero, a count that is none, a flag that is none, a place that is none.
        for (at, bad) in [(0, -1.0), (1, 0.5), (2, -1.0), (3, 1e300), (4, 2.0), (5, 3.0)] {
            let mut numbers = numbers.clone();
            numbers[at] = bad;
            assert_eq!(empty.clone().load(&mut Reader::new(&numbers)), None, "{at}");
        }
    }
}
