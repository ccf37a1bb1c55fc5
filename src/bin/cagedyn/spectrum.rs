//! Amplitude spectrum of a sampled quantity.

use rustfft::algorithm::Radix4;
use rustfft::num_complex::Complex;
use rustfft::{Fft, FftDirection, Length};
use std::f64::consts::{PI, TAU};

/// Zero padding: the spectrum is computed at this many frequencies per line, so that a peak between two lines keeps
/// its height (without padding a Hann window shows it up to 15 % too low).
const PADDING: usize = 8;
/// Fewer samples than this give no spectrum worth showing.
const MIN_SAMPLES: usize = 16;
/// The floor beside a peak is the highest one of the medians over so many times the resolution, from its main lobe on: of wide ranges,
/// which scatter little, and of narrow ones, which follow a slope.
const BESIDE: [f64; 3] = [8.0, 4.0, 2.0];
/// Below this, in units of the resolution, there is nothing on one side of a peak to compare it with.
const LOWEST_PEAK: f64 = 1.5;
/// Noise is taken for a peak with this probability: its normal deviate, that of 1e-5.
const DEVIATE: f64 = 4.265;
/// Peaks are higher than this times what the window makes of higher ones: their frequency may vary a little.
const ABOVE_LEAKAGE: f64 = 3.0;
/// Degrees of freedom of the power of noise per segment: two, less what segments share under their windows.
const FREEDOM: f64 = 1.9;

/// Amplitude over frequency.
#[derive(Clone, Debug, PartialEq)]
pub struct Spectrum {
    /// Frequencies, Hz.
    pub frequencies: Vec<f64>,
    /// Amplitudes in the unit of the samples: a sine shows its amplitude.
    pub amplitudes: Vec<f64>,
    /// Two sines closer than this are one peak, Hz: half the width of the main lobe of the window. What is slower is no
    /// oscillation in the time that was seen.
    pub resolution: f64,
    /// Stretches of time that it is the mean of.
    pub segments: u32,
}

/// A line that stands out of the noise about it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Peak {
    /// Frequency, Hz.
    pub frequency: f64,
    /// Amplitude, in the unit of the samples.
    pub amplitude: f64,
}

/// Spectrum of samples taken every `interval` seconds: root of the mean power of segments that overlap by half, as many of them as
/// there can be while sines `resolution` Hz apart can be told apart; of all samples together where there are too few for that.
/// `None` for too few samples.
pub fn averaged_spectrum(samples: &[f64], interval: f64, resolution: f64) -> Option<Spectrum> {
    let wanted = (2.0 / (resolution * interval)).ceil();
    let length = if wanted < samples.len() as f64 { wanted as usize } else { samples.len() };
    let step = (length / 2).max(1);
    let starts = (0..=samples.len() - length).step_by(step);
    let analysis = Analysis::new(length, interval)?;
    let mut sum: Option<Spectrum> = None;
    let mut segments = 0;
    for start in starts {
        let one = analysis.of(&samples[start..start + length]);
        segments += 1;
        match &mut sum {
            None => {
                sum = Some(Spectrum { amplitudes: one.amplitudes.iter().map(|a| a * a).collect(), ..one })
            }
            Some(sum) => sum.amplitudes.iter_mut().zip(&one.amplitudes).for_each(|(s, a)| *s += a * a),
        }
    }
    let mut mean = sum?;
    mean.amplitudes.iter_mut().for_each(|power| *power = (*power / f64::from(segments)).sqrt());
    mean.segments = segments;
    Some(mean)
}

/// Spectra of equally many samples each.
pub struct Analysis {
    window: Vec<f64>,
    /// Sum of the window.
    gain: f64,
    interval: f64,
    transform: Radix4<f64>,
}

impl Analysis {
    /// Of `n` samples taken every `interval` seconds, with a Hann window and without their mean. `None` for too few.
    pub fn new(n: usize, interval: f64) -> Option<Self> {
        if n < MIN_SAMPLES || !interval.is_finite() || interval <= 0.0 {
            return None;
        }
        let window: Vec<f64> = (0..n).map(|i| 0.5 - 0.5 * (TAU * i as f64 / n as f64).cos()).collect();
        let gain = window.iter().sum();
        // One algorithm that serves powers of two; the planner would bring code for every other length.
        let transform = Radix4::new((n * PADDING).next_power_of_two(), FftDirection::Forward);
        Some(Self { window, gain, interval, transform })
    }

    /// The spectrum of as many samples.
    pub fn of(&self, samples: &[f64]) -> Spectrum {
        let Self { window, gain, interval, transform } = self;
        // The mean under the window, so that nothing of it leaks into the lowest frequencies.
        let mean = samples.iter().zip(window).map(|(x, w)| x * w).sum::<f64>() / gain;
        let length = transform.len();
        let mut values = vec![Complex::new(0.0, 0.0); length];
        for (value, (x, w)) in values.iter_mut().zip(samples.iter().zip(window)) {
            value.re = (x - mean) * w;
        }
        transform.process(&mut values);
        values.truncate(length / 2 + 1);
        let step = 1.0 / (length as f64 * interval);
        Spectrum {
            frequencies: (0..values.len()).map(|k| k as f64 * step).collect(),
            amplitudes: values.iter().map(|x| 2.0 * x.norm_sqr().sqrt() / gain).collect(),
            resolution: 2.0 / (window.len() as f64 * interval),
            segments: 1,
        }
    }
}

impl Spectrum {
    /// What a picture can show: the largest amplitude in each of at most `most` equal ranges of frequency. None is narrower
    /// than the time that was seen can tell apart, or the side lobes of the window would look like lines.
    pub fn lines(&self, most: usize) -> impl Iterator<Item = (f64, f64)> + '_ {
        let pitch = self.frequencies.get(1).map_or(1.0, |f| f - self.frequencies[0]);
        let told_apart = (0.5 * self.resolution / pitch).ceil() as usize;
        let together = self.amplitudes.len().div_ceil(most).max(told_apart).max(1);
        let ranges = self.frequencies.chunks(together).zip(self.amplitudes.chunks(together));
        ranges.filter_map(|(f, a)| {
            let largest = f.iter().zip(a).max_by(|x, y| x.1.total_cmp(y.1))?;
            Some((*largest.0, *largest.1))
        })
    }

    /// Amplitude at a frequency, Hz: the largest within half of the resolution. `None` beyond the last line.
    pub fn at(&self, frequency: f64) -> Option<f64> {
        let near = 0.5 * self.resolution;
        let from = self.frequencies.partition_point(|f| *f < frequency - near);
        let to = self.frequencies.partition_point(|f| *f <= frequency + near);
        let all = self.amplitudes.get(from..to)?;
        (frequency <= *self.frequencies.last()?).then(|| all.iter().copied().fold(0.0, f64::max))
    }

    /// The highest local maximum above the resolution, whether it stands out or not: what is below is a drift.
    pub fn highest(&self) -> Option<Peak> {
        self.maxima().max_by(|a, b| a.amplitude.total_cmp(&b.amplitude))
    }

    /// Local maxima above the resolution that stand out of the noise on either side of them, and of what the window makes of higher
    /// ones, highest first.
    pub fn peaks(&self) -> Vec<Peak> {
        let lowest = LOWEST_PEAK * self.resolution;
        let mut all: Vec<Peak> = self.maxima().filter(|peak| peak.frequency > lowest).collect();
        all.sort_by(|a, b| b.amplitude.total_cmp(&a.amplitude));
        let least = self.least_ratio();
        let mut found: Vec<Peak> = Vec::new();
        for peak in all {
            let leaked = found.iter().map(|higher| self.leaked(higher, peak.frequency)).fold(0.0, f64::max);
            // Cheaply told first.
            if peak.amplitude > ABOVE_LEAKAGE * leaked && peak.amplitude > least * self.floor(peak.frequency)
            {
                found.push(peak);
            }
        }
        found
    }

    /// Envelope of what a Hann window shows of a sine at another frequency.
    fn leaked(&self, of: &Peak, frequency: f64) -> f64 {
        let lines = (frequency - of.frequency).abs() / (0.5 * self.resolution);
        if lines < 2.0 { of.amplitude } else { of.amplitude / (PI * lines * (lines * lines - 1.0)) }
    }

    fn maxima(&self) -> impl Iterator<Item = Peak> + '_ {
        let inner = self.amplitudes.windows(3).zip(&self.frequencies[1.min(self.frequencies.len())..]);
        let inner = inner.filter(|(a, f)| a[1] > a[0] && a[1] >= a[2] && **f > self.resolution);
        inner.map(|(a, f)| Peak { frequency: *f, amplitude: a[1] })
    }

    /// The highest one of the medians of the amplitudes on both sides of a frequency, without what the window makes of a sine there. On
    /// a slope that is the upper side, above which nothing stands out that is no peak.
    fn floor(&self, frequency: f64) -> f64 {
        let place =
            |times: f64| self.frequencies.partition_point(|f| *f < frequency + times * self.resolution);
        let zero = self.frequencies.partition_point(|f| *f <= 0.5 * self.resolution);
        let median = |from: usize, to: usize| {
            let mut side = self.amplitudes.get(from..to).unwrap_or_default().to_vec();
            let middle = side.len() / 2;
            if side.is_empty() { 0.0 } else { *side.select_nth_unstable_by(middle, f64::total_cmp).1 }
        };
        let sides =
            |wide: f64| [median(place(-wide).max(zero), place(-1.0)), median(place(1.0), place(wide))];
        BESIDE.map(sides).into_iter().flatten().fold(0.0, f64::max)
    }

    /// Ratio to the median that noise exceeds seldom: its power is chi-squared distributed, whose quantiles follow from the normal
    /// ones (E. B. Wilson and M. M. Hilferty, 1931).
    fn least_ratio(&self) -> f64 {
        let variance = 2.0 / (9.0 * FREEDOM * f64::from(self.segments));
        let median = 1.0 - variance;
        ((median + DEVIATE * variance.sqrt()) / median).powf(1.5)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn amplitude_spectrum(samples: &[f64], interval: f64) -> Option<Spectrum> {
        Some(Analysis::new(samples.len(), interval)?.of(samples))
    }

    const N: usize = 400;
    const INTERVAL: f64 = 5e-4;

    /// Peak of a sine with amplitude 0.3 on an offset, at a frequency in units of spectral lines.
    fn peak_of_sine(lines: f64) -> (f64, f64) {
        let turn = TAU * lines / N as f64;
        let samples: Vec<f64> = (0..N).map(|i| 7.0 + 0.3 * (turn * i as f64 + 0.4).sin()).collect();
        amplitude_spectrum(&samples, INTERVAL)
            .and_then(|s| s.highest())
            .map(|p| (p.frequency, p.amplitude))
            .unwrap()
    }

    /// Noise of a linear congruential generator.
    fn noise(mut state: u32) -> impl FnMut() -> f64 {
        move || {
            state = state.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
            f64::from(state >> 8) / f64::from(1u32 << 24) - 0.5
        }
    }

    #[test]
    fn sine_on_a_line_has_its_amplitude() {
        let (frequency, amplitude) = peak_of_sine(40.0);
        assert!((amplitude - 0.3).abs() < 1e-3 * 0.3, "{amplitude}");
        assert!((frequency - 40.0 / (N as f64 * INTERVAL)).abs() < 0.5, "{frequency}");
    }

    #[test]
    fn sine_between_lines_has_its_amplitude() {
        for lines in [40.5, 40.37, 40.0625] {
            let (frequency, amplitude) = peak_of_sine(lines);
            assert!((amplitude - 0.3).abs() < 3e-3 * 0.3, "{lines}: {amplitude}");
            assert!((frequency - lines / (N as f64 * INTERVAL)).abs() < 0.5, "{lines}: {frequency}");
        }
    }

    #[test]
    fn offset_and_drift_are_no_peaks() {
        let drift: Vec<f64> = (0..N).map(|i| 5.0 + 1e-3 * i as f64 + 1e-2 * (0.5 * i as f64).sin()).collect();
        let spectrum = amplitude_spectrum(&drift, INTERVAL).unwrap();
        assert!(spectrum.amplitudes[0] < 1e-12);
        assert_eq!(spectrum.frequencies.len(), spectrum.amplitudes.len());
        assert!((spectrum.frequencies.last().unwrap() - 0.5 / INTERVAL).abs() < 1e-9);
    }

    /// The mean is taken off, a slow swing is not: it is all below the resolution but for the feet of the window.
    #[test]
    fn slower_than_the_resolution_is_no_peak() {
        let drift: Vec<f64> = (0..N).map(|i| (0.7 * TAU * f64::from(i as i32) / N as f64).sin()).collect();
        let both: Vec<f64> =
            (0..N).map(|i| drift[i] + 0.05 * (TAU * 40.0 * i as f64 / N as f64).sin()).collect();
        let spectrum = amplitude_spectrum(&both, INTERVAL).unwrap();
        assert_eq!(spectrum.resolution, 2.0 / (N as f64 * INTERVAL));
        let Peak { frequency, amplitude } = spectrum.highest().unwrap();
        assert!(
            (frequency - 200.0).abs() < 1.0 && (amplitude - 0.05).abs() < 2e-3,
            "{frequency} {amplitude}"
        );
        // Between lines nothing is drawn that the padding made: one maximum, falling on both sides of it.
        let one: Vec<f64> = (0..N).map(|i| (TAU * 40.3 * i as f64 / N as f64).sin()).collect();
        let shown: Vec<f64> =
            amplitude_spectrum(&one, INTERVAL).unwrap().lines(1000).map(|(_, a)| a).collect();
        let maxima = shown.windows(3).filter(|a| a[1] > a[0] && a[1] > a[2]).count();
        assert_eq!(maxima, 1);
    }

    #[test]
    fn segments_keep_amplitudes_and_lower_the_scatter_of_noise() {
        let mut noise = noise(5);
        let samples: Vec<f64> = (0..8 * N).map(|i| (TAU * 0.1 * i as f64).sin() + 0.5 * noise()).collect();
        let one = amplitude_spectrum(&samples, INTERVAL).unwrap();
        let wanted = 2.0 / (N as f64 * INTERVAL);
        let many = averaged_spectrum(&samples, INTERVAL, wanted).unwrap();
        assert_eq!((one.segments, many.segments, many.resolution), (1, 15, wanted));
        let Peak { frequency, amplitude } = many.highest().unwrap();
        assert!((frequency - 200.0).abs() < 1.0 && (amplitude - 1.0).abs() < 0.01, "{frequency} {amplitude}");
        assert!((many.at(200.0).unwrap() - 1.0).abs() < 0.01 && many.at(1e9).is_none());
        // The noise above 400 Hz: its scatter over the lines.
        let scatter = |s: &Spectrum| {
            let from = s.frequencies.partition_point(|f| *f < 400.0);
            let spread = cagedyn::Spread::of(&s.amplitudes[from..]).unwrap();
            spread.deviation / spread.mean
        };
        assert!(scatter(&many) < 0.45 * scatter(&one), "{} {}", scatter(&many), scatter(&one));
        // A resolution that the samples do not have is not there.
        assert_eq!(averaged_spectrum(&samples[..N], INTERVAL, 1e-3).unwrap().resolution, wanted);
        assert_eq!(averaged_spectrum(&[1.0; 8], INTERVAL, 1.0), None);
    }

    /// Of records of noise that falls with the frequency not one in twenty has a peak; a sine in it is always found.
    #[test]
    fn peaks_are_sines_and_not_noise() {
        for (length, wanted) in [(N, 1.0), (8 * N, 2.0 / (N as f64 * INTERVAL))] {
            let (mut false_ones, mut sines) = (0, 0);
            for seed in 0..200 {
                let mut noise = noise(7919 * seed + 1);
                // With a mean over the past, so that low frequencies are the louder ones.
                let mut past = 0.0;
                let samples: Vec<f64> = (0..length)
                    .map(|_| {
                        past = 0.9 * past + noise();
                        past
                    })
                    .collect();
                false_ones += averaged_spectrum(&samples, INTERVAL, wanted).unwrap().peaks().len();
                let with: Vec<f64> =
                    samples.iter().enumerate().map(|(i, x)| x + (TAU * 0.2 * i as f64).sin()).collect();
                let peaks = averaged_spectrum(&with, INTERVAL, wanted).unwrap().peaks();
                sines += usize::from(peaks.first().is_some_and(|peak| (peak.frequency - 400.0).abs() < 2.0));
            }
            assert!(false_ones < 10 && sines == 200, "{length}: {false_ones} {sines}");
        }
        // The feet of the window about a sine are no peaks.
        let sine: Vec<f64> = (0..N).map(|i| (TAU * 40.3 * i as f64 / N as f64).sin()).collect();
        assert_eq!(amplitude_spectrum(&sine, INTERVAL).unwrap().peaks().len(), 1);
    }

    #[test]
    fn too_few_samples_give_none() {
        assert_eq!(amplitude_spectrum(&[1.0; 8], INTERVAL), None);
        assert_eq!(amplitude_spectrum(&[1.0; 64], 0.0), None);
    }
}
