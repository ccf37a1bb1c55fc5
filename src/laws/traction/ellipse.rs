//! Traction over the ellipse of a point contact: a stack of line contacts side by side, with slip that spin and the curvature of the
//! surface change from place to place.
//!
//! ```text
//! place s = x t + y l - H n,   H = y^2/(R_d + sqrt(R_d^2 - y^2)),   R_d radius of the pressed surface across the race (Heathcote)
//! D_t(y)   = D_t - w_n y - w_l H,    D_l(x, y) = D_l + w_n x + w_t H,    d = |D|
//! strip    P = (pi/4) p0 c,  c = sqrt(1 - (y/a)^2):  Sigma = eta d/(tau0 h),  eta = eta0 exp(alpha P - beta dT)
//!          1/k = u tau0 h/(G_l b c d),   S = asinh(Sigma)(1 - asinh(Sigma)/(4 k)) up to asinh = 2 k, then k
//! stress   g = tau/d = (1 - w) tau0 S/d + w mu_bd tanh(d/v_s)/d p0 sqrt(c^2 - (x/b)^2)
//! sums     S0 = sum G, Sx = sum G x, ..., G = g dA
//! F_t = -(S0 D_t - Sy w_n - Sh w_l),   F_l = -(S0 D_l + Sx w_n + Sh w_t)
//! M_t = -(Sh D_l + Sxh w_n + Shh w_t),   M_l = Sh D_t - Syh w_n - Shh w_l
//! M_n = -(Sx D_l + Sxx w_n + Sxh w_t - Sy D_t + Syy w_n + Syh w_l)
//! dT = R_th tau0/(pi a b) sum S d dA,   R_th = h/(12 k') + (4/3)/(sqrt(pi e1 U1/2b) + sqrt(pi e2 U2/2b))
//! ```
//!
//! Everything is linear in the secants g, so nothing is divided by a slip that may be zero, the power of forces and couple is the
//! dissipation, and the symmetric matrix of the sums is the damping that a semi-implicit step takes. Each strip follows the law of line
//! contacts ([`super::muraki_kimura`]) under its own mean pressure; film, regime and temperature are those of the middle. Places are those of
//! Gauss and Chebyshev across the race and of Gauss and Legendre along it. Valid for lubricated ellipses that are smaller than R_d; the
//! creep of the solids is left out. Combination of the library from laws of the literature: the limit of uniform slip and one
//! strip is the line contact.

use crate::laws::traction::self_heating::{SelfHeating, heat_flow};
use crate::laws::traction::solid_friction::SolidFriction;
use crate::scalar::{Base, Numeric, Of, math};
use std::f64::consts::PI;

/// ln of the largest factor by which pressure thickens the oil, far beyond what any film carries.
const LARGEST_LN_VISCOSITY: f64 = 300.0;
/// Added to the square of the slip, m^2/s^2, so that friction is defined without slip.
const SLIP_FLOOR: f64 = 1e-24;
/// Newton steps for the temperature before bisection takes over, and steps at all.
const FAST_STEPS: usize = 12;
const MOST_STEPS: usize = 80;
/// Error of the logarithm of the viscosity at which the temperature is found.
const ACCURACY: f64 = 1e-7;

/// Places and weights on the unit disc: strips across the race, each with places along it.
#[derive(Clone, Debug, PartialEq)]
pub struct EllipseRule {
    /// y/a >= 0 of a strip and, if it is not the middle one, of its mirror image; c, and the weight of one of both.
    strips: Vec<[f64; 3]>,
    /// x/(b c) of the places along a strip, their weights, and those of a stress like Hertz's pressure.
    places: Vec<[f64; 3]>,
}

impl EllipseRule {
    /// So many strips, and places along each.
    ///
    /// # Panics
    /// Without strips or places.
    pub fn new(strips: usize, places: usize) -> Self {
        assert!(strips > 0 && places > 0);
        let step = PI / (strips + 1) as f64;
        let strip = |j: usize| {
            let (sin, cos) = math::sin_cos(j as f64 * step);
            [if 2 * j == strips + 1 { 0.0 } else { cos }, sin, step * sin * sin]
        };
        let along = legendre(places);
        let share: f64 = along.iter().map(|[s, w]| w * (1.0 - s * s).sqrt()).sum();
        let pressed = |[s, w]: [f64; 2]| [s, w, w * (1.0 - s * s).sqrt() * (0.5 * PI) / share];
        Self {
            strips: (1..=strips.div_ceil(2)).map(strip).collect(),
            places: along.into_iter().map(pressed).collect(),
        }
    }
}

/// Places and weights of Gauss and Legendre on (-1, 1).
pub(crate) fn legendre(n: usize) -> Vec<[f64; 2]> {
    let place = |i: usize| {
        let mut x = math::cos(PI * (i as f64 + 0.75) / (n as f64 + 0.5));
        let mut slope = 1.0;
        for _ in 0..100 {
            let (mut before, mut value) = (1.0, x);
            for k in 2..=n {
                let k = k as f64;
                (before, value) = (value, ((2.0 * k - 1.0) * x * value - (k - 1.0) * before) / k);
            }
            slope = n as f64 * (x * value - before) / (x * x - 1.0);
            let step = value / slope;
            x -= step;
            if step.abs() < 1e-16 {
                break;
            }
        }
        [x, 2.0 / ((1.0 - x * x) * slope * slope)]
    };
    (0..n).map(place).collect()
}

/// Lubricant and surfaces of the contacts of one race.
#[derive(Clone, Debug, PartialEq)]
pub struct EllipseTraction {
    /// Places of the sums, and those of the temperature.
    pub rule: EllipseRule,
    pub temperature_rule: EllipseRule,
    /// ln(eta0/tau0), ln s.
    pub ln_time: f64,
    /// alpha, 1/Pa.
    pub pressure_viscosity: f64,
    /// tau0, Pa.
    pub eyring_stress: f64,
    /// G_l, Pa.
    pub shear_modulus: f64,
    /// R_d, m.
    pub pressed_radius: f64,
    /// Self-heating, if there is any.
    pub self_heating: Option<SelfHeating>,
}

/// An ellipse, its film and how both surfaces move.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct EllipseState<T> {
    /// p0, Pa.
    pub pressure: T,
    /// a and b, m.
    pub half_axes: [T; 2],
    /// h, m.
    pub film: T,
    /// ln of eta0 over that of the law.
    pub ln_viscosity: T,
    /// |u| > 0, m/s.
    pub rolling_speed: T,
    /// u1 and u2 of the surfaces past the contact, m/s.
    pub surface_speeds: [T; 2],
    /// D_t and D_l in the middle, m/s.
    pub slip: [T; 2],
    /// w_t, w_l, w_n, rad/s.
    pub turning: [T; 3],
    /// Share w of boundary friction.
    pub boundary_share: T,
}

/// Moments of the secants over the ellipse, N s/m and its kin.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Secants<T> {
    /// S0, Sx, Sy, Sh.
    pub first: [T; 4],
    /// Sxx, Syy, Shh, Sxh, Syh.
    pub second: [T; 5],
}

/// Friction of an ellipse on the body whose slip is meant; the other one has the opposite at the same point.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct EllipseFriction<T> {
    /// F_t and F_l, N.
    pub force: [T; 2],
    /// M_t, M_l, M_n about the middle of the contact, N m.
    pub couple: [T; 3],
    /// Their secants.
    pub secants: Secants<T>,
    /// dT, K.
    pub temperature_rise: T,
}

impl<T: Numeric> Secants<T> {
    /// Force and couple by these slips and turning speeds.
    #[inline(always)]
    pub fn friction(&self, [dt, dl]: [T; 2], [wt, wl, wn]: [T; 3]) -> ([T; 2], [T; 3]) {
        let ([s0, sx, sy, sh], [sxx, syy, shh, sxh, syh]) = (self.first, self.second);
        let force = [sy * wn + sh * wl - s0 * dt, -(s0 * dl + sx * wn + sh * wt)];
        let couple = [
            -(sh * dl + sxh * wn + shh * wt),
            sh * dt - syh * wn - shh * wl,
            sy * dt - (sx * dl + sxx * wn + sxh * wt + syy * wn + syh * wl),
        ];
        (force, couple)
    }
}

/// What the stress of a strip follows from: eta/(tau0 h), s/m; 1/k times the slip, m/s, and its inverse.
struct Constants<T> {
    thickness: T,
    compliance: T,
    stiffness: T,
}

/// What a strip has in common.
struct Strip<T> {
    y: T,
    height: T,
    slip_t: T,
    slip_l: T,
}

impl EllipseTraction {
    /// Friction of an ellipse; `boundary` is that without film, with the Hertz pressure as its load.
    #[inline(always)]
    pub fn friction<B, T>(
        &self,
        at: &EllipseState<T>,
        boundary: Option<&SolidFriction<B>>,
    ) -> EllipseFriction<T>
    where
        B: Base,
        T: Of<B>,
    {
        let zero = at.pressure.like(0.0);
        let rise = match &self.self_heating {
            None => zero,
            Some(heating) => self.temperature_rise(at, heating),
        };
        let secants = self.secants(at, rise, boundary);
        let (force, couple) = secants.friction(at.slip, at.turning);
        EllipseFriction { force, couple, secants, temperature_rise: rise }
    }

    /// What the stress of a strip with the half length `c` times that of the middle follows from.
    #[inline(always)]
    fn strip_constants<T: Numeric>(&self, at: &EllipseState<T>, c: f64, rise: T) -> Constants<T> {
        let beta = self.self_heating.map_or(0.0, |heating| heating.temperature_viscosity);
        let ln_eta = at.pressure * (0.25 * PI * c * self.pressure_viscosity) + at.ln_viscosity + self.ln_time
            - rise * beta;
        let held = T::select(ln_eta.above(LARGEST_LN_VISCOSITY), ln_eta.like(LARGEST_LN_VISCOSITY), ln_eta);
        let drift = at.rolling_speed * at.film * (self.eyring_stress / (self.shear_modulus * c));
        let compliance = drift / at.half_axes[1];
        Constants { thickness: held.exp() / at.film, compliance, stiffness: at.half_axes[1] / drift }
    }

    /// Slip of the strip at `t` half axes across the race.
    #[inline(always)]
    fn strip<T: Numeric>(&self, at: &EllipseState<T>, t: f64) -> Strip<T> {
        let y = at.half_axes[0] * t;
        let square = y * y;
        let radius = self.pressed_radius;
        let height = square / ((-square + radius * radius).sqrt() + radius);
        let ([dt, dl], [wt, wl, wn]) = (at.slip, at.turning);
        Strip { y, height, slip_t: dt - wn * y - wl * height, slip_l: dl + wt * height }
    }

    /// S over the slip (m/s) at a place with this slip and its inverse, and dS over d(ln eta).
    #[inline(always)]
    fn secant<T: Numeric>(strip: &Constants<T>, slip: T, inverse: T) -> [T; 2] {
        let Constants { thickness, compliance, stiffness } = *strip;
        let sigma = thickness * slip;
        let arc = sigma.asinh();
        let share = arc * compliance * inverse;
        let elastic = share.at_least(2.0);
        let one = slip.like(1.0);
        let viscous = arc * (-share * 0.25 + 1.0) * inverse;
        let slope = sigma / (sigma * sigma + 1.0).sqrt() * (-share * 0.5 + 1.0);
        [T::select(elastic, stiffness, viscous), T::select(elastic, one.like(0.0), slope)]
    }

    /// R(dT), the rise that the friction at the rise dT sustains, K, and -dR/d(ln eta).
    #[inline(always)]
    fn sustained<T: Numeric>(&self, at: &EllipseState<T>, per_power: T, rise: T) -> [T; 2] {
        let zero = rise.like(0.0);
        let (mut sum, mut slope) = (zero, zero);
        for &[t, c, weight] in &self.temperature_rule.strips {
            let constants = self.strip_constants(at, c, rise);
            for side in sides(t) {
                let strip = self.strip(at, side * t);
                for &[s, w, _] in &self.temperature_rule.places {
                    let along = strip.slip_l + at.turning[2] * at.half_axes[1] * (c * s);
                    let square = strip.slip_t * strip.slip_t + along * along + SLIP_FLOOR;
                    let slip = square.sqrt();
                    let [secant, steep] = Self::secant(&constants, slip, slip.like(1.0) / slip);
                    sum += secant * square * (weight * w);
                    slope += steep * slip * (weight * w);
                }
            }
        }
        [sum * per_power, slope * per_power]
    }

    /// dT. It is the one root of dT = R(dT), whose right side falls: Newton's method from 0, bisection where that swings, and a last step
    /// in the law's own numbers, with dual numbers the implicit-function rule.
    #[inline(always)]
    fn temperature_rise<T: Numeric>(&self, at: &EllipseState<T>, heating: &SelfHeating) -> T {
        let [u1, u2] = at.surface_speeds;
        let half_width = at.half_axes[1];
        let surfaces = heat_flow(heating.thermal_product_1, u1, half_width)
            + heat_flow(heating.thermal_product_2, u2, half_width);
        let resistance = at.film * (1.0 / (12.0 * heating.conductivity)) + at.film.like(4.0 / 3.0) / surfaces;
        let per_power = resistance * (heating.eyring_stress / PI);
        let beta = heating.temperature_viscosity;
        let (plain, plain_power) = (at.base(), per_power.base());
        let zero = plain_power.splat(0.0);
        let (mut rise, mut low, mut high) = (zero, zero, zero);
        let mut open = plain_power.splat(1.0);
        let mut derivative = open;
        for step in 0..MOST_STEPS {
            let [sustained, slope] = self.sustained(&plain, plain_power, rise);
            if step == 0 {
                high = sustained;
            }
            let missing = sustained - rise;
            derivative = slope * beta + 1.0;
            let colder = missing.at_least(0.0);
            low = <T::Base as Numeric>::select(colder, rise, low);
            high = <T::Base as Numeric>::select(colder, high, rise);
            let middle = (low + high) * 0.5;
            let next = if step < FAST_STEPS {
                let near = rise + missing / derivative;
                <T::Base as Numeric>::select(low.less_or_equal(near) & near.less_or_equal(high), near, middle)
            } else {
                middle
            };
            let done = (missing * beta).abs().at_most(ACCURACY);
            open = <T::Base as Numeric>::select(done, zero, open);
            // Contacts that are done take their last step below.
            rise = <T::Base as Numeric>::select(done, rise, next);
            if !<T::Base as Base>::any(open.above(0.0)) {
                break;
            }
        }
        let root = T::lift(rise);
        let [sustained, _] = self.sustained(at, per_power, root);
        let rise = root + (sustained - root) / T::lift(derivative);
        let lost = open.above(0.0);
        T::select(lost, rise.like(f64::NAN), rise)
    }

    #[inline(always)]
    fn secants<B, T>(&self, at: &EllipseState<T>, rise: T, boundary: Option<&SolidFriction<B>>) -> Secants<T>
    where
        B: Base,
        T: Of<B>,
    {
        let zero = rise.like(0.0);
        let mut sums = Secants { first: [zero; 4], second: [zero; 5] };
        let area = at.half_axes[0] * at.half_axes[1];
        let wet = (-at.boundary_share + 1.0) * area * self.eyring_stress;
        let dry = boundary.map(|law| (law, at.boundary_share * at.pressure * area));
        for &[t, c, weight] in &self.rule.strips {
            let constants = self.strip_constants(at, c, rise);
            for side in sides(t) {
                let strip = self.strip(at, side * t);
                // Over the strip: the secants, and their first and second moments along it.
                let (mut g0, mut g1, mut g2) = (zero, zero, zero);
                for &[s, w, pressed] in &self.rule.places {
                    let x = at.half_axes[1] * (c * s);
                    let along = strip.slip_l + at.turning[2] * x;
                    let slip = (strip.slip_t * strip.slip_t + along * along + SLIP_FLOOR).sqrt();
                    let inverse = slip.like(1.0) / slip;
                    let [secant, _] = Self::secant(&constants, slip, inverse);
                    let mut g = secant * wet * (weight * w);
                    if let Some((law, load)) = &dry {
                        g += law.at(slip) * *load * (weight * c * pressed) * inverse;
                    }
                    g0 += g;
                    g1 += g * x;
                    g2 += g * x * x;
                }
                let Strip { y, height, .. } = strip;
                let moments = [g0, g1, g0 * y, g0 * height];
                for (sum, moment) in sums.first.iter_mut().zip(moments) {
                    *sum += moment;
                }
                let moments = [g2, g0 * y * y, g0 * height * height, g1 * height, g0 * y * height];
                for (sum, moment) in sums.second.iter_mut().zip(moments) {
                    *sum += moment;
                }
            }
        }
        sums
    }
}

/// The strip itself and, unless it is the middle one, its mirror image.
#[inline(always)]
fn sides(t: f64) -> impl Iterator<Item = f64> {
    [1.0, -1.0].into_iter().take(if t == 0.0 { 1 } else { 2 })
}

impl<T: Numeric> EllipseState<T> {
    /// The same without derivatives.
    #[inline(always)]
    fn base(&self) -> EllipseState<T::Base> {
        EllipseState {
            pressure: self.pressure.base(),
            half_axes: [self.half_axes[0].base(), self.half_axes[1].base()],
            film: self.film.base(),
            ln_viscosity: self.ln_viscosity.base(),
            rolling_speed: self.rolling_speed.base(),
            surface_speeds: [self.surface_speeds[0].base(), self.surface_speeds[1].base()],
            slip: [self.slip[0].base(), self.slip[1].base()],
            turning: [self.turning[0].base(), self.turning[1].base(), self.turning[2].base()],
            boundary_share: self.boundary_share.base(),
        }
    }
}

#[cfg(test)]
mod tests;
