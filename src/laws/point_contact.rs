//! A complete point contact: the laws that its scene asks for, evaluated in order.
//!
//! ```text
//! normal force Q -> Hertz a, b, p0 -> film h -> regime Lambda -> traction over the ellipse, self-heating -> F_t, F_l, M
//!                                                            -> rolling resistance F_R
//! ```
//!
//! Each part is optional and costs one predictable branch when absent. There are no branches on numbers, so that one call can serve a
//! group of contacts. Slip at the middle of the contact is what heat at the inlet sees; near none its ratio to the rolling speed is rounded
//! off (an assumption of the library: the power law of the thermal factor has an infinite slope there).

use crate::laws::elastic::normal::{NormalDamping, NormalForce};
use crate::laws::elastic::point::ElasticPoint;
use crate::laws::film::ellipse::EllipseFilm;
use crate::laws::film::regime::LubricationRegime;
use crate::laws::film::thickness::{ENTRAINMENT_FLOOR, Entrainment, GUPTA_FLOOR, ThermalLoad};
use crate::laws::rolling::Extent;
use crate::laws::rolling::point::PointRolling;
use crate::laws::traction::ellipse::{EllipseFriction, EllipseState, EllipseTraction, Secants};
use crate::scalar::{Base, Numeric, Of, smoothstep};

/// No film without heat is thicker, m.
const THICKEST_FILM: f64 = 1e-4;
/// Slide-to-roll ratio below which the thermal factors take it as this, rounded off.
const SLIDE_ROLL_FLOOR: f64 = 1e-3;

/// Rolling resistance of the contacts of one race.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PointResistance {
    /// Its law.
    pub law: PointRolling,
    /// Heat at the inlet; without it the isothermal law.
    pub thermal: Option<ThermalLoad>,
    /// Contacts in which it acts.
    pub extent: Extent,
}

/// The laws of the contacts of one race.
#[derive(Clone, Debug, PartialEq)]
pub struct PointContact {
    /// Normal damping.
    pub damping: Option<NormalDamping>,
    /// Film thickness; without it there is neither regime nor traction.
    pub film: Option<EllipseFilm>,
    /// Traction of the film.
    pub traction: Option<EllipseTraction>,
    /// Mixed and boundary lubrication.
    pub regime: Option<LubricationRegime>,
    /// Rolling resistance.
    pub rolling_resistance: Option<PointResistance>,
}

/// How both surfaces of a point contact move.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PointMotion<T> {
    /// Approach delta, m, and its rate, m/s.
    pub delta: T,
    pub delta_dot: T,
    /// u1 and u2 of both surfaces along the race past the contact, m/s.
    pub surface_speeds: [T; 2],
    /// D_t and D_l in the middle, m/s.
    pub slip: [T; 2],
    /// w_t, w_l, w_n: turning of the first body against the second, rad/s.
    pub turning: [T; 3],
}

/// Forces of a point contact; all zero where the surfaces are apart.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PointForce<T> {
    /// Q, N.
    pub normal: T,
    /// dQ_el/d(delta), N/m, and dQ/d(delta_dot), N s/m.
    pub stiffness: T,
    pub damping: T,
    /// a and b, m, and p0, Pa.
    pub half_axes: [T; 2],
    pub pressure: T,
    /// h, m; zero without film.
    pub film: T,
    /// Lambda; zero without regime.
    pub film_ratio: T,
    /// Friction on the first body.
    pub friction: EllipseFriction<T>,
    /// Rolling resistance on each surface along the race, against the rolling speed, N.
    pub rolling_resistance: T,
}

/// Numbers of a [`PointForce`].
pub const POINT_FORCE: usize = 24;
/// Numbers of a [`PointMotion`].
pub const POINT_MOTION: usize = 9;

impl<T: Copy> PointMotion<T> {
    /// Its numbers, in the order of its fields.
    #[inline(always)]
    pub fn numbers(&self) -> [T; POINT_MOTION] {
        let ([u1, u2], [dt, dl], [wt, wl, wn]) = (self.surface_speeds, self.slip, self.turning);
        [self.delta, self.delta_dot, u1, u2, dt, dl, wt, wl, wn]
    }

    /// That of these numbers.
    #[inline(always)]
    pub fn of_numbers([delta, delta_dot, u1, u2, dt, dl, wt, wl, wn]: [T; POINT_MOTION]) -> Self {
        Self { delta, delta_dot, surface_speeds: [u1, u2], slip: [dt, dl], turning: [wt, wl, wn] }
    }
}

impl<T: Copy> PointForce<T> {
    /// Its numbers, in the order of its fields.
    #[inline(always)]
    pub fn numbers(&self) -> [T; POINT_FORCE] {
        let EllipseFriction { force: [ft, fl], couple: [mt, ml, mn], secants, temperature_rise: rise } =
            self.friction;
        let ([s0, sx, sy, sh], [sxx, syy, shh, sxh, syh]) = (secants.first, secants.second);
        let [a, b] = self.half_axes;
        let Self {
            normal, stiffness, damping, pressure, film, film_ratio, rolling_resistance: rolling, ..
        } = *self;
        [
            normal, stiffness, damping, a, b, pressure, film, film_ratio, ft, fl, mt, ml, mn, s0, sx, sy, sh,
            sxx, syy, shh, sxh, syh, rise, rolling,
        ]
    }

    /// That of these numbers.
    #[inline(always)]
    pub fn of_numbers(numbers: [T; POINT_FORCE]) -> Self {
        let [normal, stiffness, damping, a, b, pressure, film, film_ratio, rest @ ..] = numbers;
        let [ft, fl, mt, ml, mn, s0, sx, sy, sh, rest @ ..]: [T; 16] = rest;
        let [sxx, syy, shh, sxh, syh, rise, rolling]: [T; 7] = rest;
        let secants = Secants { first: [s0, sx, sy, sh], second: [sxx, syy, shh, sxh, syh] };
        Self {
            normal,
            stiffness,
            damping,
            half_axes: [a, b],
            pressure,
            film,
            film_ratio,
            friction: EllipseFriction {
                force: [ft, fl],
                couple: [mt, ml, mn],
                secants,
                temperature_rise: rise,
            },
            rolling_resistance: rolling,
        }
    }
}

impl PointContact {
    /// Forces with these elastic constants and the viscosity e^`ln_viscosity` times that of the laws.
    #[inline(always)]
    pub fn force<B: Base, T: Of<B>>(
        &self,
        elastic: &ElasticPoint<B>,
        motion: &PointMotion<T>,
        ln_viscosity: T,
    ) -> PointForce<T> {
        let normal = self.normal_force(elastic, motion.delta, motion.delta_dot);
        self.under(normal, elastic, motion, ln_viscosity)
    }

    /// Q of these at the approach `delta` (m) and its rate (m/s).
    #[inline(always)]
    pub fn normal_force<B: Base, T: Of<B>>(
        &self,
        elastic: &ElasticPoint<B>,
        delta: T,
        delta_dot: T,
    ) -> NormalForce<T> {
        let damping = self.damping.map(|law| law.map(&mut |x| delta.base().splat(*x)));
        elastic.normal_force(damping.as_ref(), delta, delta_dot)
    }

    /// Forces of these under a normal force, whatever approach it comes from.
    #[inline(always)]
    pub fn under<B: Base, T: Of<B>>(
        &self,
        normal: NormalForce<T>,
        elastic: &ElasticPoint<B>,
        motion: &PointMotion<T>,
        ln_viscosity: T,
    ) -> PointForce<T> {
        let zero = normal.force.like(0.0);
        // A NaN counts as contact and is passed on.
        let apart = normal.force.at_most(0.0);
        let load = T::select(apart, zero.like(1.0), normal.force);
        let ln_load = load.ln();
        let half_axes = elastic.half_axes(ln_load);
        let pressure = elastic.largest_pressure(load, half_axes);
        let mut out = PointForce {
            normal: normal.force,
            stiffness: normal.stiffness,
            damping: normal.damping,
            half_axes: held(apart, half_axes),
            pressure: T::select(apart, zero, pressure),
            film: zero,
            film_ratio: zero,
            friction: EllipseFriction {
                force: [zero; 2],
                couple: [zero; 3],
                secants: Secants { first: [zero; 4], second: [zero; 5] },
                temperature_rise: zero,
            },
            rolling_resistance: zero,
        };
        if self.film.is_none() && self.rolling_resistance.is_none() {
            return out;
        }
        let rolling = entrainment(motion, ln_viscosity);
        if let Some(resistance) = &self.rolling_resistance {
            let force = resistance.force(load, ln_load, pressure / elastic.effective_modulus, &rolling);
            out.rolling_resistance = T::select(apart, zero, -(force * rolling.direction));
        }
        let Some(film) = &self.film else { return out };
        let thickness = film.ln_central(ln_load, pressure, &rolling).exp();
        out.film = T::select(apart, zero, thickness);
        let mut share = zero;
        let mut boundary = None;
        if let Some(regime) = &self.regime {
            let regime = regime.map(&mut |x| zero.base().splat(*x));
            let ratio = regime.film_ratio(thickness);
            out.film_ratio = T::select(apart, zero, ratio);
            share = regime.boundary_share(ratio);
            boundary = Some(regime.boundary);
        }
        if let Some(traction) = &self.traction {
            let state = EllipseState {
                pressure,
                half_axes,
                film: thickness,
                ln_viscosity,
                rolling_speed: rolling.speed,
                surface_speeds: motion.surface_speeds,
                slip: motion.slip,
                turning: motion.turning,
                boundary_share: share,
            };
            let found = traction.friction(&state, boundary.as_ref());
            out.friction = EllipseFriction {
                force: held(apart, found.force),
                couple: held(apart, found.couple),
                secants: Secants {
                    first: held(apart, found.secants.first),
                    second: held(apart, found.secants.second),
                },
                temperature_rise: T::select(apart, zero, found.temperature_rise),
            };
        }
        out
    }
}

impl PointContact {
    /// Whether the thermal factor of the film is at its floor in a contact with this force.
    pub fn is_at_floor(&self, motion: &PointMotion<f64>, force: &PointForce<f64>, ln_viscosity: f64) -> bool {
        let may_be = force.normal > 0.0 && force.film < GUPTA_FLOOR * THICKEST_FILM;
        let film = self.film.as_ref().filter(|_| may_be);
        film.is_some_and(|film| film.is_at_floor(force.pressure, &entrainment(motion, ln_viscosity)))
    }
}

impl PointResistance {
    /// F_R >= 0 in N under the load `q` > 0 (N), of which ln is `ln_q`, with the largest pressure p0/E'.
    #[inline(always)]
    fn force<T: Numeric>(&self, q: T, ln_q: T, pressure: T, e: &Entrainment<T>) -> T {
        let mut force = self.law.force(ln_q, e);
        if let Some(load) = &self.thermal {
            force = force * load.gupta(pressure, e).floored(GUPTA_FLOOR);
        }
        match self.extent {
            Extent::All => force,
            Extent::Loaded { threshold } => force * smoothstep((q - threshold) / threshold),
        }
    }
}

/// Zero of contacts that are apart. A loop, because closures would not always be inlined.
#[inline(always)]
fn held<T: Numeric, const N: usize>(apart: T::Mask, mut list: [T; N]) -> [T; N] {
    for x in &mut list {
        *x = T::select(apart, x.like(0.0), *x);
    }
    list
}

/// Rolling and sliding of the middle of the contact.
#[inline(always)]
fn entrainment<T: Numeric>(motion: &PointMotion<T>, ln_viscosity: T) -> Entrainment<T> {
    let [u1, u2] = motion.surface_speeds;
    let u = (u1 + u2) * 0.5;
    let speed = (u * u + ENTRAINMENT_FLOOR * ENTRAINMENT_FLOOR).sqrt();
    let [dt, dl] = motion.slip;
    let floor = speed * SLIDE_ROLL_FLOOR;
    let slip = (dt * dt + dl * dl + floor * floor).sqrt();
    Entrainment { speed, direction: u / speed, slip, ln_speed: speed.ln(), ln_slip: slip.ln(), ln_viscosity }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::laws::elastic::line::effective_modulus;
    use crate::laws::traction::ellipse::EllipseRule;
    use crate::laws::traction::self_heating::SelfHeating;
    use crate::laws::traction::solid_friction::SolidFriction;
    use crate::scalar::{Dual, Pack};
    use pulp::{Arch, Simd, WithSimd};

    fn point() -> ElasticPoint {
        ElasticPoint::new(effective_modulus(206e9, 0.3, 206e9, 0.3), [110.0, 4.0]).unwrap()
    }

    fn contact() -> PointContact {
        let steel = 46.0 * 7830.0 * 460.0;
        let thermal = ThermalLoad::new(0.04, 0.03, 0.13);
        PointContact {
            damping: Some(NormalDamping { relaxation_time: 5e-7, softening_depth: 1e-8 }),
            film: Some(EllipseFilm::new(&point(), 0.03, 2e-8, Some(thermal))),
            traction: Some(EllipseTraction {
                rule: EllipseRule::new(16, 2),
                temperature_rule: EllipseRule::new(8, 2),
                ln_time: (0.03_f64 / 5e6).ln(),
                pressure_viscosity: 2e-8,
                eyring_stress: 5e6,
                shear_modulus: 3e8,
                pressed_radius: 11.37e-3,
                self_heating: Some(SelfHeating {
                    temperature_viscosity: 0.04,
                    conductivity: 0.13,
                    eyring_stress: 5e6,
                    thermal_product_1: steel,
                    thermal_product_2: steel,
                    acts: 1.0,
                }),
            }),
            regime: Some(LubricationRegime {
                boundary: SolidFriction { coefficient: 0.1, transition_speed: 0.02 },
                lambda_boundary: 0.06,
                lambda_full: 3.0,
                roughness: 1e-7,
            }),
            rolling_resistance: Some(PointResistance {
                law: PointRolling::biboulet_houpert(&point(), 0.03),
                thermal: Some(thermal),
                extent: Extent::All,
            }),
        }
    }

    const INPUTS: [f64; 9] = [1.2e-5, 1e-3, 12.1, 11.9, 0.2, 0.05, 40.0, -2000.0, 300.0];

    fn motion<T: Copy>([delta, delta_dot, u1, u2, dt, dl, wt, wl, wn]: [T; 9]) -> PointMotion<T> {
        PointMotion { delta, delta_dot, surface_speeds: [u1, u2], slip: [dt, dl], turning: [wt, wl, wn] }
    }

    fn outputs<T: Copy>(f: &PointForce<T>) -> [T; 7] {
        let ([ft, fl], [mt, ml, mn]) = (f.friction.force, f.friction.couple);
        [f.normal, ft, fl, mt, ml, mn, f.rolling_resistance]
    }

    #[test]
    fn derivatives_are_those_of_the_forces() {
        let (law, point) = (contact(), point());
        let exact = outputs(&law.force(
            &point,
            &motion(std::array::from_fn(|k| Dual::<9>::variable(INPUTS[k], k))),
            Dual::lift(0.0),
        ));
        let value = |x: [f64; 9]| outputs(&law.force::<f64, f64>(&point, &motion(x), 0.0));
        for (k, input) in INPUTS.into_iter().enumerate() {
            let h = 1e-6 * input.abs();
            let moved = |s: f64| value(std::array::from_fn(|i| INPUTS[i] + if i == k { s * h } else { 0.0 }));
            let (before, after) = (moved(-1.0), moved(1.0));
            for i in 0..7 {
                let difference = (after[i] - before[i]) / (2.0 * h);
                let size = value(INPUTS)[i].abs() / input.abs();
                let error = (exact[i].eps[k] - difference).abs();
                assert!(error < 2e-5 * size, "{i} {k}: {} {difference}", exact[i].eps[k]);
            }
        }
    }

    #[test]
    fn apart_there_is_nothing() {
        let mut x = INPUTS;
        for (delta, delta_dot) in [(-1e-6, 0.0), (1e-7, -10.0), (0.0, 1.0)] {
            (x[0], x[1]) = (delta, delta_dot);
            let force = contact().force::<f64, f64>(&point(), &motion(x), 0.0);
            assert_eq!(outputs(&force), [0.0; 7], "{delta}");
            assert_eq!((force.film, force.pressure), (0.0, 0.0));
        }
        x[0] = f64::NAN;
        assert!(contact().force::<f64, f64>(&point(), &motion(x), 0.0).normal.is_nan());
    }

    #[test]
    fn lanes_have_the_bits_of_single_contacts() {
        struct Lanes<'a>(&'a PointContact, Vec<[f64; 9]>);
        impl WithSimd for Lanes<'_> {
            type Output = Vec<[f64; 7]>;
            #[inline(always)]
            fn with_simd<S: Simd>(self, simd: S) -> Vec<[f64; 7]> {
                let Self(law, inputs) = self;
                let n = S::F64_LANES;
                let mut all = Vec::new();
                let elastic = point().map(&mut |x| Pack::<S, 1>::all(simd, *x));
                for group in inputs.chunks_exact(n) {
                    let column = |k: usize| {
                        let numbers: Vec<f64> = group.iter().map(|x| x[k]).collect();
                        Pack::<S, 1>::load(simd, &numbers)
                    };
                    let force =
                        law.force(&elastic, &motion(std::array::from_fn(column)), Pack::all(simd, 0.0));
                    let columns = outputs(&force).map(|pack| {
                        let mut numbers = vec![0.0; n];
                        pack.store(&mut numbers);
                        numbers
                    });
                    all.extend((0..n).map(|i| std::array::from_fn(|k| columns[k][i])));
                }
                all
            }
        }
        let inputs: Vec<[f64; 9]> = (0..64)
            .map(|i| std::array::from_fn(|k| INPUTS[k] * (1.0 + 0.5 * f64::from(7 * i + k as i32).sin())))
            .collect();
        let law = contact();
        let found = Arch::new().dispatch(Lanes(&law, inputs.clone()));
        assert!(found.len() > 32);
        for (x, found) in inputs.into_iter().zip(found) {
            let single = outputs(&law.force::<f64, f64>(&point(), &motion(x), 0.0));
            assert_eq!(single.map(f64::to_bits), found.map(f64::to_bits));
        }
    }
}
