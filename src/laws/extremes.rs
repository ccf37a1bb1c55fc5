//! A million random and extreme arguments: results are finite, correctly signed, and monotone where physics says so.

use crate::laws::contact_pair::ContactMotion;
use crate::laws::elastic::profile::tests::profiles;
use crate::laws::elastic::solid::SolidContact;
use crate::laws::fluid::Fluid;
use crate::laws::guide::journal::JournalMotion;
use crate::laws::guide::lubricant_layer::{LubricantLayer, PressureShear};
use crate::laws::guide::short_bearing::ShortBearing;
use crate::laws::line_contact::LineContact;
use crate::laws::line_contact::tests::raceway;
use crate::laws::traction::solid_friction::SolidFriction;

/// Repeatable random arguments.
struct Random(fastrand::Rng);

impl Random {
    fn new(seed: u64) -> Self {
        Self(fastrand::Rng::with_seed(seed))
    }

    /// Uniform in [0, 1).
    fn unit(&mut self) -> f64 {
        self.0.f64()
    }

    /// A number of any size up to `largest`; now and then zero, or as small as numbers are.
    fn positive(&mut self, largest: f64) -> f64 {
        match self.unit() {
            x if x < 0.03 => 0.0,
            x if x < 0.05 => f64::from_bits(1),
            x if x < 0.3 => largest * self.unit(),
            _ => largest * 10f64.powf(-30.0 * self.unit()),
        }
    }

    /// The same of either sign.
    fn any(&mut self, largest: f64) -> f64 {
        let x = self.positive(largest);
        if self.unit() < 0.5 { -x } else { x }
    }

    fn motion(&mut self) -> ContactMotion<f64> {
        let u1 = self.any(1e5);
        // Often nearly rolling.
        let u2 = if self.unit() < 0.5 { u1 + self.any(1.0) } else { self.any(1e5) };
        ContactMotion { delta: self.any(0.1), delta_dot: self.any(1e4), u1, u2 }
    }

    /// A place in a clearance, often at its edge, as position and depth of the film.
    fn place(&mut self, clearance: f64) -> [f64; 2] {
        let angle = 7.0 * self.unit();
        let film = clearance * (1e-5 + self.positive(0.999));
        let e = clearance - film;
        [e * angle.cos(), e * angle.sin()]
    }
}

fn check_line_contact(law: &LineContact, random: &mut Random, n: u32) {
    for _ in 0..n {
        let (motion, ln_viscosity) = (random.motion(), 60.0 * random.unit() - 30.0);
        let edge_share = if random.unit() < 0.7 { 0.0 } else { 1.2 * random.unit() };
        let f = law.force(&motion, ln_viscosity, edge_share);
        let mut all_finite = true;
        let mut apart = true;
        f.map(|x| {
            all_finite &= x.is_finite();
            apart &= *x == 0.0;
        });
        assert!(all_finite, "{motion:?} {ln_viscosity}: {f:?}");
        assert!(motion.delta > 0.0 || apart, "{motion:?}: {f:?}");
        let sizes = [f.normal, f.film, f.film_ratio, f.temperature_rise, f.friction_coefficient];
        assert!(sizes.iter().all(|x| *x >= 0.0), "{motion:?}: {f:?}");
        assert!(f.friction * (motion.u1 - motion.u2) <= 0.0, "{motion:?}: {f:?}");
        assert!(f.rolling_resistance * (motion.u1 + motion.u2) <= 0.0, "{motion:?}: {f:?}");
        // At rest a deeper contact carries more, on a thinner film.
        let resting = ContactMotion { delta_dot: 0.0, ..motion };
        let deeper = ContactMotion { delta: motion.delta * (1.0 + random.unit()), ..resting };
        let [f, g] = [resting, deeper].map(|motion| law.force(&motion, ln_viscosity, 0.0));
        if motion.delta > 1e-300 {
            // The nodes of a profile move with the depth, which their rule does not see exactly.
            let exact = if law.profile.is_some() { 1e-9 } else { 1e-14 };
            assert!(g.normal >= f.normal * (1.0 - exact), "{resting:?} {f:?} {g:?}");
            assert!(g.film <= f.film * (1.0 + 1e-12), "{resting:?} {f:?} {g:?}");
        }
    }
}

#[test]
fn line_contacts() {
    let mut random = Random::new(1);
    let edge = Some(SolidFriction { coefficient: 0.1, transition_speed: 0.02 });
    let full = LineContact { edge_friction: edge, ..raceway() };
    check_line_contact(&full, &mut random, 400_000);
    check_line_contact(&LineContact { self_heating: None, damping: None, ..full }, &mut random, 200_000);
    check_line_contact(&LineContact { film: None, regime: None, ..full }, &mut random, 100_000);
    for (_, profile, _) in profiles(4) {
        check_line_contact(&LineContact { profile: Some(profile), ..raceway() }, &mut random, 30_000);
    }
}

#[test]
fn solid_contacts() {
    let mut random = Random::new(2);
    for softening_depth in [0.0, 1e-6] {
        let friction = Some(SolidFriction { coefficient: 0.3, transition_speed: 1e-4 });
        let law = SolidContact { stiffness: 1e9, damping: 44.4, softening_depth, friction };
        for _ in 0..100_000 {
            let motion = random.motion();
            let f = law.force(&motion);
            assert!(f.normal.is_finite() && f.normal >= 0.0, "{motion:?}: {f:?}");
            assert!(
                f.friction.is_finite() && f.friction * (motion.u1 - motion.u2) <= 0.0,
                "{motion:?}: {f:?}"
            );
            assert!(f.friction.abs() <= 0.3 * f.normal * (1.0 + 1e-14) + 1e-300, "{motion:?}: {f:?}");
        }
    }
}

/// A random motion in a clearance.
fn journal(random: &mut Random, clearance: f64) -> JournalMotion<f64> {
    JournalMotion {
        position: random.place(clearance),
        velocity: [random.any(1e3), random.any(1e3)],
        journal_speed: random.any(1e5),
        bush_speed: random.any(1e5),
        profile_angle: 0.0,
        profile_speed: 0.0,
    }
}

#[test]
fn guide_films() {
    let mut random = Random::new(3);
    let bearing = ShortBearing {
        viscosity: 0.06,
        radius: 0.045,
        clearance: 0.2e-3,
        land_width: 7e-3,
        squeeze: true,
        pressure_moment: false,
        roundness: Vec::new(),
        profile_on_journal: true,
    };
    let layer = LubricantLayer {
        viscosity: 0.1,
        thickener: None,
        pressure_viscosity: 2e-8,
        cap: 0.9,
        radius: 0.045,
        clearance: 0.2e-3,
        width: 8e-3,
        thickness: 80e-6,
        pressure_shear: PressureShear::WithinArc,
        roundness: Vec::new(),
        profile_on_journal: true,
    };
    for i in 0..100_000 {
        let moving = journal(&mut random, 0.2e-3);
        // Without rotation a film takes energy from every motion.
        let sliding = JournalMotion { journal_speed: 0.0, bush_speed: 0.0, ..moving };
        for (motion, turns) in [(moving, true), (sliding, false)] {
            let forces = if i % 2 == 0 {
                bearing.force(&motion, Fluid::SAME)
            } else {
                layer.force(&motion, Fluid::SAME)
            };
            let f = forces.unwrap_or_else(|e| panic!("{motion:?}: {e:?}"));
            let [y, z] = f.force();
            assert!(y.is_finite() && z.is_finite() && f.moment.is_finite(), "{motion:?}: {f:?}");
            let film = if i % 2 == 0 { bearing.minimum(&motion) } else { layer.minimum(&motion) };
            assert!(film > 0.0, "{motion:?}: {film}");
            let [vy, vz] = motion.velocity;
            let size = y.hypot(z) * vy.hypot(vz);
            assert!(turns || y * vy + z * vz <= 1e-9 * size, "{motion:?}: {f:?}");
        }
    }
}
