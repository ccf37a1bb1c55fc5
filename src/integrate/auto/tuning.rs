//! The constants that the default method rests on, with their reasons. docs/results/tuning.md shows what each of them does.

/// A constant of [`Tuning`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Constant {
    /// Name of the field.
    pub name: &'static str,
    /// Its default.
    pub value: f64,
    /// Its unit.
    pub unit: &'static str,
    /// What it is, and why.
    pub reason: &'static str,
}

macro_rules! tuning {
    ($($(#[doc = $reason:literal])+ $name:ident: $type:ty = $value:literal, $unit:literal;)+) => {
        /// Constants of the default method.
        #[derive(Clone, Copy, Debug, PartialEq)]
        pub struct Tuning {
            $($(#[doc = $reason])+ pub $name: $type,)+
        }

        impl Default for Tuning {
            fn default() -> Self {
                Self { $($name: $value,)+ }
            }
        }

        impl Tuning {
            /// All constants.
            pub const TABLE: &'static [Constant] = &[$(Constant {
                name: stringify!($name),
                value: $value as f64,
                unit: $unit,
                reason: concat!($($reason),+),
            }),+];

            /// Sets a constant by its name. Whether there is one.
            pub fn set(&mut self, name: &str, value: f64) -> bool {
                match name {
                    $(stringify!($name) => self.$name = value as $type,)+
                    _ => return false,
                }
                true
            }

            /// The values, in the order of [`Tuning::TABLE`].
            pub fn values(&self) -> Vec<f64> {
                vec![$(self.$name as f64),+]
            }
        }
    };
}

tuning! {
    /// Steps that are judged together, at most. More would lose more work where they are wrong; fewer, more evaluations of
    /// their energy.
    longest_stretch: usize = 32, "steps";
    /// Share of what a preset may miss of its energy, `draft` as much as `engineering`, that one stretch and the run so far may
    /// miss: what is left is for the stretches to come.
    energy_share: f64 = 0.2, "1";
    /// Share of their own energy that the latest stretches may miss where they end with the leapfrog, whatever the run could
    /// spare: a light cage would be driven by errors that are small beside what the rings put through. Of them together, as the
    /// leapfrog gives back what it misses of a vibration.
    latest_share: f64 = 0.002, "1";
    /// Weight of a stretch in these, over that of the stretch behind it.
    latest_memory: f64 = 0.9, "1";
    /// Where error control misses this share of what steps before it had missed, or more, the steps are not to blame.
    inherent_share: f64 = 0.5, "1";
    /// Less missing energy than this share of the stored one is round-off.
    energy_rounding: f64 = 1e-12, "1";
    /// Stretches with more care after a wrong one; twice as many after the next, as long as fewer right ones lie between.
    first_hold: u64 = 4, "stretches";
    /// The most of these.
    longest_hold: u64 = 256, "stretches";
    /// Each further wrong stretch of error control divides its tolerance by this.
    stricter: f64 = 10.0, "1";
    /// How many times it does; then a stretch counts as it is.
    strictest: u64 = 5, "times";
    /// Stretches of error control at the start, of 1, 2, 4, ... steps: where bodies are set down is rarely where they rest.
    start: u64 = 5, "stretches";
    /// The same after a jump or kink of an input.
    transient: u64 = 8, "stretches";
    /// Stretches between two such transients, as inputs from tables have kinks all the time.
    event_interval: u64 = 256, "stretches";
    /// Stretches of the leapfrog until it is tried whether error control costs little, as where nothing vibrates. Twice as many after
    /// each trial in vain.
    first_pause: u64 = 256, "stretches";
    /// Failed attempts in a row after which the leapfrog gives way.
    patience: u64 = 3, "attempts";
    /// Failed or rejected attempts in a row after which one method with error control gives way to the other.
    long_patience: u64 = 12, "attempts";
    /// Evaluations after which the advance of a method with error control is taken.
    window: f64 = 400.0, "evaluations";
    /// Windows until the other one is tried; twice as many after each trial in vain.
    first_trial: f64 = 2.0, "windows";
    /// The most of these.
    longest_trial: f64 = 64.0, "windows";
    /// The other one takes over when it advances this many times as far.
    clear_lead: f64 = 1.2, "1";
    /// Where an implicit method spends this many evaluations on what the leapfrog was expected to make one step of, the other one is
    /// tried.
    stiff: f64 = 30.0, "evaluations";
    /// Below this share of the step that the leapfrog was expected to make no step is followed more strictly than others, and the
    /// Radau method gives way: friction as steep as a wall would need steps too small for the digits of time.
    finest: f64 = 1e-8, "1";
    /// Steps of the leapfrog between two measurements of the highest frequency: each costs a Jacobian.
    frequency_interval: u64 = 512, "steps";
    /// Its step follows a frequency that differs by this factor.
    clear_difference: f64 = 1.1, "1";
    /// Below this share of critical damping the fastest vibration counts as undamped, with half the step.
    light_damping: f64 = 0.01, "1";
    /// Above this many times the expected frequency error control costs no more.
    highest_frequency: f64 = 2.0, "1";
    /// Where derivatives cost so many evaluations, finer steps of the leapfrog are weighed against error control.
    dear_derivatives: f64 = 8.0, "evaluations";
    /// Halved steps of the leapfrog must advance this many times as far per evaluation as error control: they may still miss energy,
    /// and error control soon take longer ones.
    finer_lead: f64 = 2.0, "1";
    /// Stretches of finer steps until it is tried whether error control costs less by now.
    finer_pause: u64 = 64, "stretches";
    /// A finer step is made coarser again at once where its stretch could have missed this many times as much: four times twice
    /// over, as errors grow with the square of the step.
    reserve: f64 = 16.0, "1";
    /// Steps per period of the fastest sine that is switched on, at least.
    steps_per_period: f64 = 10.0, "steps";
    /// Share of a gap, or of the depth over which a law sets in, that one step may cross.
    onset_share: f64 = 0.25, "1";
    /// Share of the time sqrt(m/k) in which a solid contact turns a body that one step may go on behind its onset.
    turn_share: f64 = 0.25, "1";
    /// Roughness heights at which the film between rough surfaces begins to fade; its share is 0.999 there.
    fading: f64 = 3.0, "heights";
    /// Films thinner than this share of the clearance are left to error control.
    thinnest_film: f64 = 1e-4, "1";
}
