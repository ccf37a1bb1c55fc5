//! Dry friction whirl of a journal pressed around in its guide, in closed form: what a dry guide can do at all.
//!
//! ```text
//! m z'' + c z' + K (1 -+ i mu) z = 0          contact K with damping c in both directions, no clearance
//! mu_c = c/sqrt(K m)                          whirl grows above it, at the frequency sqrt(K/m)
//! W = -c/(mu m),   e = C/(1 - (mu_c/mu)^2)    circular orbit with the clearance C, for mu > mu_c
//! ```
//!
//! The orbit is exact and unstable: smaller whirls die, larger ones grow until the surfaces no longer slide. So mu_c tells where such
//! a boundary exists, not where a whirl begins by itself. Not valid for a guide whose damper acts along the normal only: there
//! is no damping of a circular motion then. Source: Nogi's form of the criterion, derived here.

/// A journal on a dry guide.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DryWhirl {
    /// m, kg.
    pub mass: f64,
    /// K, N/m.
    pub stiffness: f64,
    /// c, N s/m.
    pub damping: f64,
}

impl DryWhirl {
    /// mu_c.
    pub fn threshold(&self) -> f64 {
        self.damping / (self.stiffness * self.mass).sqrt()
    }

    /// Whirl speed (rad/s) and eccentricity (m) of the circular orbit with a radial clearance in m; `None` where friction is too low for it.
    pub fn orbit(&self, friction: f64, clearance: f64) -> Option<[f64; 2]> {
        let ratio = self.threshold() / friction;
        let exists = friction > 0.0 && ratio < 1.0;
        exists.then(|| [-self.damping / (friction * self.mass), clearance / (1.0 - ratio * ratio)])
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const CAGE: DryWhirl = DryWhirl { mass: 12.34e-3, stiffness: 1e6, damping: 5.0 };
    const CLEARANCE: f64 = 0.2e-3;

    /// Accelerations of the journal at a place and velocity, m and m/s: spring beyond the clearance, damper in both directions, and
    /// friction against the turning surface.
    fn acceleration([y, z]: [f64; 2], [vy, vz]: [f64; 2], friction: f64) -> [f64; 2] {
        let e = y.hypot(z);
        let normal = CAGE.stiffness * (e - CLEARANCE).max(0.0);
        let touches = if e > CLEARANCE { CAGE.damping } else { 0.0 };
        let [dy, dz] = [y / e, z / e];
        [
            (-normal * (dy - friction * dz) - touches * vy) / CAGE.mass,
            (-normal * (dz + friction * dy) - touches * vz) / CAGE.mass,
        ]
    }

    #[test]
    fn the_orbit_is_one_and_smaller_whirls_die_while_larger_grow() {
        let friction = 2.0 * CAGE.threshold();
        let [speed, e] = CAGE.orbit(friction, CLEARANCE).unwrap();
        let [ay, az] = acceleration([e, 0.0], [0.0, e * speed], friction);
        let centripetal = -e * speed * speed;
        assert!(
            (ay / centripetal - 1.0).abs() < 1e-12 && az.abs() < 1e-9 * centripetal.abs(),
            "{ay} {az} {centripetal}"
        );
        // From a little inside and outside of it.
        let end = |share: f64| {
            let (mut x, mut v) = ([share * e, 0.0], [0.0, share * e * speed]);
            let dt = 1e-7;
            for _ in 0..100_000 {
                let a = acceleration(x, v, friction);
                v = [v[0] + a[0] * dt, v[1] + a[1] * dt];
                x = [x[0] + v[0] * dt, x[1] + v[1] * dt];
            }
            x[0].hypot(x[1])
        };
        assert!(end(0.99) < 0.97 * e && end(1.01) > 1.03 * e, "{} {}", end(0.99) / e, end(1.01) / e);
    }

    #[test]
    fn too_little_friction_has_no_orbit() {
        assert_eq!(CAGE.orbit(0.9 * CAGE.threshold(), CLEARANCE), None);
        assert_eq!(CAGE.orbit(0.0, CLEARANCE), None);
        assert!((CAGE.threshold() - 5.0 / (1e6f64 * 12.34e-3).sqrt()).abs() < 1e-15);
    }
}
