//! Amplitude spectrum of a sampled quantity.

use rustfft::algorithm::Radix4;
use rustfft::num_complex::Complex;
use rustfft::{Fft, FftDirection};
use std::f64::consts::TAU;

/// Zero padding: the spectrum is computed at this many frequencies per line, so that a peak between two lines keeps
/// its height (without padding a Hann window shows it up to 15 % too low).
const PADDING: usize = 8;
/// Fewer samples than this give no spectrum worth showing.
const MIN_SAMPLES: usize = 16;

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
}

/// Spectrum of samples taken every `interval` seconds, with a Hann window and without their mean. `None` for too few
/// samples.
pub fn amplitude_spectrum(samples: &[f64], interval: f64) -> Option<Spectrum> {
    let n = samples.len();
    if n < MIN_SAMPLES || !interval.is_finite() || interval <= 0.0 {
        return None;
    }
    let window: Vec<f64> = (0..n).map(|i| 0.5 - 0.5 * (TAU * i as f64 / n as f64).cos()).collect();
    let gain: f64 = window.iter().sum();
    // The mean under the window, so that nothing of it leaks into the lowest frequencies.
    let mean = samples.iter().zip(&window).map(|(x, w)| x * w).sum::<f64>() / gain;
    let length = (n * PADDING).next_power_of_two();
    let mut values = vec![Complex::new(0.0, 0.0); length];
    for (value, (x, w)) in values.iter_mut().zip(samples.iter().zip(&window)) {
        value.re = (x - mean) * w;
    }
    // One algorithm that serves powers of two; the planner would bring code for every other length.
    Radix4::new(length, FftDirection::Forward).process(&mut values);
    values.truncate(length / 2 + 1);
    let step = 1.0 / (length as f64 * interval);
    Some(Spectrum {
        frequencies: (0..values.len()).map(|k| k as f64 * step).collect(),
        amplitudes: values.iter().map(|x| 2.0 * x.norm() / gain).collect(),
        resolution: 2.0 / (n as f64 * interval),
    })
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

    /// Frequency and amplitude of the highest local maximum above the resolution: what is below is a drift.
    pub fn peak(&self) -> Option<(f64, f64)> {
        let inner = self.amplitudes.windows(3).enumerate();
        let inner =
            inner.filter(|(i, a)| a[1] > a[0] && a[1] >= a[2] && self.frequencies[i + 1] > self.resolution);
        let (i, a) = inner.max_by(|(_, a), (_, b)| a[1].total_cmp(&b[1]))?;
        Some((self.frequencies[i + 1], a[1]))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const N: usize = 400;
    const INTERVAL: f64 = 5e-4;

    /// Peak of a sine with amplitude 0.3 on an offset, at a frequency in units of spectral lines.
    fn peak_of_sine(lines: f64) -> (f64, f64) {
        let turn = TAU * lines / N as f64;
        let samples: Vec<f64> = (0..N).map(|i| 7.0 + 0.3 * (turn * i as f64 + 0.4).sin()).collect();
        amplitude_spectrum(&samples, INTERVAL).and_then(|s| s.peak()).unwrap()
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
        let (frequency, amplitude) = spectrum.peak().unwrap();
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
    fn too_few_samples_give_none() {
        assert_eq!(amplitude_spectrum(&[1.0; 8], INTERVAL), None);
        assert_eq!(amplitude_spectrum(&[1.0; 64], 0.0), None);
    }
}
