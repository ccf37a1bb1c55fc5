//! A line contact at rest: the force, energy and stiffness of its spring, straight or with a profile.

use super::contact_pair::ContactMotion;
use super::line_contact::LineContact;

/// Halvings of the approach under a load: down to round-off.
const HALVINGS: usize = 60;

impl LineContact {
    /// Elastic load in N at the approach `delta` (m), and the sum of load times approach along the length, N m: 19/9 of the
    /// energy. Zero for delta <= 0.
    pub(crate) fn rest_at(&self, delta: f64) -> [f64; 2] {
        if self.profile.is_none() {
            let load = self.elastic.load(delta);
            return [load, load * delta.max(0.0)];
        }
        let mut sum = [0.0; 2];
        self.each_slice(delta, |depth, share| {
            let load = share * self.elastic.load(depth);
            sum[0] += load;
            sum[1] += load * depth.max(0.0);
        });
        sum
    }

    /// Stiffness in N/m under the load `q` > 0 (N), which belongs to the approach `delta` (m).
    pub(crate) fn stiffness_at_rest(&self, q: f64, delta: f64) -> f64 {
        if self.profile.is_none() {
            return self.elastic.stiffness_at_load(q);
        }
        let mut sum = 0.0;
        self.each_slice(delta, |depth, share| {
            sum += share * self.elastic.normal_force(None, depth, 0.0).stiffness;
        });
        sum
    }

    /// Elastic approach in m under the load `q` >= 0 in N.
    pub(crate) fn approach(&self, q: f64) -> f64 {
        let straight = self.elastic.approach(q);
        if self.profile.is_none() || straight.is_nan() || straight <= 0.0 {
            return straight;
        }
        // A profile makes the contact softer.
        let mut high = straight;
        while self.rest_at(high)[0] < q {
            high *= 2.0;
        }
        let mut low = 0.5 * high;
        for _ in 0..HALVINGS {
            let middle = 0.5 * (low + high);
            if self.rest_at(middle)[0] < q {
                low = middle;
            } else {
                high = middle;
            }
        }
        high
    }

    /// Elastic load in N of the slices whose force damping has cut off.
    pub(crate) fn cut_off(&self, motion: &ContactMotion<f64>) -> f64 {
        let ContactMotion { delta, delta_dot, .. } = *motion;
        let Some(damping) = &self.damping else { return 0.0 };
        // The shallower a slice, the sooner it is cut off; those at no depth first.
        if delta_dot * damping.relaxation_time * (10.0 / 9.0) > -damping.softening_depth {
            return 0.0;
        }
        let mut held = 0.0;
        self.each_slice(delta, |depth, share| {
            if self.elastic.normal_force(Some(damping), depth, delta_dot).force == 0.0 {
                held += share * self.elastic.load(depth);
            }
        });
        held
    }

    /// Calls `f` with approach (m) and share of every slice of the contact.
    fn each_slice(&self, delta: f64, mut f: impl FnMut(f64, f64)) {
        let Some(profile) = &self.profile else { return f(delta, 1.0) };
        let part = profile.loaded(delta);
        for k in 0..profile.count() {
            let (depth, share) = profile.slice(&part, k, delta);
            f(depth, share);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::super::elastic::normal::NormalDamping;
    use super::super::elastic::profile::{Logarithm, Profile};
    use super::*;
    use crate::laws::line_contact::tests::raceway;

    fn profiled() -> LineContact {
        let logarithm = Logarithm::new(1.5e-6, 0.0204, 0.6, Some(12e-6));
        LineContact { profile: Profile::new(0.0204, Some(logarithm), [None, Some(2.0)], 8), ..raceway() }
    }

    #[test]
    fn load_approach_stiffness_and_energy_belong_together() {
        let law = profiled();
        for q in [1e-3, 20.0, 1500.0, 2e4] {
            let delta = law.approach(q);
            assert!(delta > law.elastic.approach(q));
            assert!((law.rest_at(delta)[0] / q - 1.0).abs() < 1e-12);
            // Derivatives agree up to the error of the rule.
            let h = 1e-5 * delta;
            let [low, high] = [delta - h, delta + h].map(|delta| law.rest_at(delta));
            let stiffness = (high[0] - low[0]) / (2.0 * h);
            assert!((law.stiffness_at_rest(q, delta) / stiffness - 1.0).abs() < 1e-3, "{q}");
            let force = 9.0 / 19.0 * (high[1] - low[1]) / (2.0 * h);
            assert!((force / q - 1.0).abs() < 1e-4, "{q}: {force}");
        }
        assert_eq!(law.rest_at(-1e-6), [0.0; 2]);
        assert_eq!(law.approach(0.0), 0.0);
    }

    #[test]
    fn what_is_cut_off_is_the_spring_without_the_force() {
        let law = profiled();
        let (mut partly, mut cut) = (0, 0);
        for delta_dot in [0.1, -0.01, -0.017, -0.02, -0.05, -0.3, -1.0, -3.0] {
            for delta in [1e-8, 1e-7, 1e-6, 4e-6] {
                let motion = ContactMotion { delta, delta_dot, u1: 6.0, u2: 6.0 };
                let (force, held) = (law.force(&motion, 0.0, 0.0), law.cut_off(&motion));
                let elastic = law.rest_at(delta)[0];
                let pushed = force.normal - force.damping * delta_dot;
                assert!(((pushed + held) / elastic - 1.0).abs() < 1e-12, "{motion:?}");
                cut += usize::from(held > 0.0);
                partly += usize::from(held > 0.0 && force.normal > 0.0);
            }
        }
        assert!(cut > 5 && partly > 2, "{cut} {partly}");
        assert_eq!(
            LineContact { damping: Some(NormalDamping::NONE), ..law }.cut_off(&ContactMotion {
                delta: 1e-6,
                delta_dot: -10.0,
                u1: 6.0,
                u2: 6.0,
            }),
            0.0
        );
    }
}
