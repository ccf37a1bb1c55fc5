//! A complete line contact: the laws that its scene asks for, evaluated in order.
//!
//! ```text
//! normal force Q -> Hertz b, P_mean -> film h_c -> regime Lambda -> traction, self-heating -> mu, F_T
//!                                                                                          -> F_EHLr, F_S
//! ```
//!
//! Each part is optional and costs one predictable branch when absent. Friction is F_T = mu Q against the slip (NTN
//! Eq. 10), with the drag F_S of the inlet where it is asked for. There are no branches on numbers, so that one call can serve a group of contacts. The logarithms of load,
//! rolling speed and slip are taken once and serve all power laws.

use crate::laws::contact_pair::{ContactForce, ContactMotion};
use crate::laws::elastic::line::ElasticLine;
use crate::laws::elastic::normal::NormalDamping;
use crate::laws::elastic::profile::Profile;
use crate::laws::film::regime::LubricationRegime;
use crate::laws::film::thickness::{Entrainment, FilmThickness};
use crate::laws::rolling::RollingResistance;
use crate::laws::traction::film_friction::FilmFriction;
use crate::laws::traction::muraki_kimura::Traction;
use crate::laws::traction::self_heating::SelfHeating;
use crate::laws::traction::solid_friction::SolidFriction;
use crate::scalar::{Base, Of, math};

/// The laws of one kind of line contact (for example all roller and inner ring contacts).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LineContact<B = f64> {
    /// Elastic constants.
    pub elastic: ElasticLine<B>,
    /// Profile of the surfaces; without it both are straight.
    pub profile: Option<Profile<B>>,
    /// Normal damping.
    pub damping: Option<NormalDamping<B>>,
    /// Film thickness; without it there is neither regime nor traction.
    pub film: Option<FilmThickness<B>>,
    /// Full-film traction.
    pub traction: Option<Traction<B>>,
    /// Self-heating of the traction film.
    pub self_heating: Option<SelfHeating<B>>,
    /// Mixed and boundary lubrication.
    pub regime: Option<LubricationRegime<B>>,
    /// Rolling resistance.
    pub rolling_resistance: Option<RollingResistance<B>>,
    /// Dry friction of an edge, which replaces a share of the others.
    pub edge_friction: Option<SolidFriction<B>>,
}

/// Load and pressure of a contact. One that is apart has some load, so that everything is defined.
#[derive(Clone, Copy)]
struct Pressed<T> {
    ln_load: T,
    half_width: T,
    mean_pressure: T,
}

impl LineContact {
    /// The two laws with the same parts: where only one of them has one, the other gets one without effect. `None` where
    /// they differ in having a film, or in constants of the lubricant.
    pub fn alike(&self, other: &Self) -> Option<[Self; 2]> {
        let (mut a, mut b) = (*self, *other);
        for (a, b) in [(&mut a, other), (&mut b, self)] {
            a.damping = a.damping.or(b.damping.map(|_| NormalDamping::NONE));
            a.rolling_resistance = a.rolling_resistance.or(b.rolling_resistance.map(|law| law.none()));
            a.edge_friction = a.edge_friction.or(b.edge_friction.map(|_| SolidFriction::NONE));
            if let (Some(film), Some(beside)) = (&mut a.film, &b.film) {
                *film = film.beside(beside.thermal);
                a.traction = a.traction.or(b.traction.map(|law| law.none()));
                a.self_heating = a.self_heating.or(b.self_heating.map(|law| law.none()));
                a.regime = a.regime.or(b.regime.map(|_| LubricationRegime::NONE));
            }
        }
        let parts = |law: &Self| law.map(&mut |_| ());
        (parts(&a) == parts(&b)).then_some([a, b])
    }
}

impl<B> LineContact<B> {
    /// The same with every constant of the surfaces replaced; those of the lubricant are the same in all contacts.
    #[inline(always)]
    pub fn map<U>(&self, f: &mut impl FnMut(&B) -> U) -> LineContact<U> {
        LineContact {
            elastic: self.elastic.map(f),
            profile: match &self.profile {
                None => None,
                Some(profile) => Some(profile.map(f)),
            },
            damping: match &self.damping {
                None => None,
                Some(law) => Some(law.map(f)),
            },
            film: match &self.film {
                None => None,
                Some(law) => Some(law.map(f)),
            },
            traction: match &self.traction {
                None => None,
                Some(law) => Some(law.map(f)),
            },
            self_heating: match &self.self_heating {
                None => None,
                Some(law) => Some(law.map(f)),
            },
            regime: match &self.regime {
                None => None,
                Some(law) => Some(law.map(f)),
            },
            rolling_resistance: match &self.rolling_resistance {
                None => None,
                Some(law) => Some(law.map(f)),
            },
            edge_friction: match &self.edge_friction {
                None => None,
                Some(law) => Some(law.map(f)),
            },
        }
    }
}

/// What is known of a loaded contact beside its forces, with a profile of its middle. Zero where there is no such law, or no
/// contact.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Loading {
    /// Hertz half width b, m.
    pub half_width: f64,
    /// Hertz mean pressure P_mean, Pa.
    pub mean_pressure: f64,
    /// What heat at the inlet leaves of the film thickness, T_H or T_R.
    pub film_thermal_factor: f64,
    /// What it leaves of the rolling resistance, T_R.
    pub rolling_thermal_factor: f64,
}

impl LineContact {
    /// Half width, pressure and thermal factors of a contact that moves like this under this force, with the viscosity
    /// e^`ln_viscosity` times that of the laws.
    pub fn loading(
        &self,
        motion: &ContactMotion<f64>,
        ln_viscosity: f64,
        force: &ContactForce<f64>,
    ) -> Loading {
        let load = self.load_of_middle(motion, force);
        if load <= 0.0 {
            return Loading::default();
        }
        let half_width = self.elastic.half_width(load);
        let mean_pressure = self.elastic.mean_pressure(load, half_width);
        let rolling = Entrainment::new(motion.u1, motion.u2, ln_viscosity);
        // On edges there is neither.
        let film = self.film.as_ref().filter(|_| force.film > 0.0);
        let resistance = self.rolling_resistance.as_ref().filter(|_| force.rolling_resistance != 0.0);
        Loading {
            half_width,
            mean_pressure,
            film_thermal_factor: film
                .map_or(0.0, |law| law.thermal_factor(math::ln(load), mean_pressure, &rolling)),
            rolling_thermal_factor: resistance.map_or(0.0, |law| law.thermal_factor(mean_pressure, &rolling)),
        }
    }

    /// Load in N of a contact that is everywhere pressed like the middle of this one, whose line load is the largest.
    fn load_of_middle(&self, motion: &ContactMotion<f64>, force: &ContactForce<f64>) -> f64 {
        match &self.profile {
            None => force.normal,
            // The middle is cut off last, and may be left when all slices are.
            Some(_) if force.normal <= 0.0 => 0.0,
            Some(_) => {
                let damping = self.damping.as_ref();
                self.elastic.normal_force(damping, motion.delta, motion.delta_dot).force
            }
        }
    }

    /// Whether the thermal factor of its rolling resistance, or without it that of its film, is at its floor in a contact that
    /// moves like this under this force, with the viscosity e^`ln_viscosity` times that of the laws.
    pub fn is_at_floor(
        &self,
        motion: &ContactMotion<f64>,
        ln_viscosity: f64,
        force: &ContactForce<f64>,
    ) -> bool {
        let (q, u) = (self.load_of_middle(motion, force), 0.5 * (motion.u1 + motion.u2));
        match (&self.rolling_resistance, &self.film) {
            _ if q <= 0.0 => false,
            (Some(law), _) => law.is_at_floor(force.rolling_resistance, q, u),
            (None, Some(film)) => {
                let pressure = self.elastic.mean_pressure(q, self.elastic.half_width(q));
                film.is_at_floor(pressure, &Entrainment::new(motion.u1, motion.u2, ln_viscosity))
            }
            (None, None) => false,
        }
    }
}

impl<B: Base> LineContact<B> {
    /// Forces, with the viscosity e^`ln_viscosity` times that of the laws. Of an edge, its share w of the friction follows
    /// the law of edges, mu (1 - w) + mu_edge w; from w = 1 on there is no film.
    ///
    /// With a profile it is the sum over slices, each a share of what the whole contact would do at the approach of the slice;
    /// film thickness, film ratio and temperature rise are those of the slice next to the middle. Surface speeds are the same
    /// along the length: the radii differ by less than the approach, and one lever serves all slices.
    #[inline(always)]
    pub fn force<T: Of<B>>(
        &self,
        motion: &ContactMotion<T>,
        ln_viscosity: T,
        edge_share: T,
    ) -> ContactForce<T> {
        self.force_sliding(motion, ln_viscosity.like(0.0), ln_viscosity, edge_share)
    }

    /// The same where the surfaces also slide across the direction of rolling at this speed, m/s: friction is against the resultant, and
    /// `friction` the part of it along that direction; across it is minus `friction_secant` times the speed.
    #[inline(always)]
    pub fn force_sliding<T: Of<B>>(
        &self,
        motion: &ContactMotion<T>,
        across: T,
        ln_viscosity: T,
        edge_share: T,
    ) -> ContactForce<T> {
        let mut rolling = Entrainment::new(motion.u1, motion.u2, ln_viscosity);
        if B::any(across.base().abs().above(0.0)) {
            rolling = rolling.sliding(across);
        }
        let mut loaded = None;
        if let Some(profile) = &self.profile {
            loaded = Some(profile.loaded(motion.delta));
        }
        let mut sum = ContactForce::none(motion.delta.like(0.0));
        let mut k = 0;
        // One loop for both, so that the law is compiled once.
        loop {
            let (delta, share) = match (&self.profile, &loaded) {
                (Some(profile), Some(part)) => profile.slice(part, k, motion.delta),
                _ => (motion.delta, motion.delta.like(1.0)),
            };
            let of = self.uniform(&ContactMotion { delta, ..*motion }, &rolling, edge_share);
            let Some(profile) = &self.profile else { return of };
            if k == 0 {
                sum.film = of.film;
                sum.film_ratio = of.film_ratio;
                sum.temperature_rise = of.temperature_rise;
            }
            sum.normal += of.normal * share;
            sum.stiffness += of.stiffness * share;
            sum.damping += of.damping * share;
            sum.friction += of.friction * share;
            sum.friction_secant += of.friction_secant * share;
            sum.rolling_resistance += of.rolling_resistance * share;
            k += 1;
            if k == profile.count() {
                let mu = sum.friction_secant * rolling.slip / sum.normal;
                sum.friction_coefficient = T::select(sum.normal.at_most(0.0), mu.like(0.0), mu);
                return sum;
            }
        }
    }

    /// Forces of a contact with the same approach along its length.
    #[inline(always)]
    fn uniform<T: Of<B>>(
        &self,
        motion: &ContactMotion<T>,
        rolling: &Entrainment<T>,
        edge_share: T,
    ) -> ContactForce<T> {
        let zero = motion.delta.like(0.0);
        let normal = self.elastic.normal_force(self.damping.as_ref(), motion.delta, motion.delta_dot);
        let mut out = ContactForce::none(zero);
        out.normal = normal.force;
        out.stiffness = normal.stiffness;
        out.damping = normal.damping;
        // A NaN counts as contact and is passed on.
        let apart = normal.force.at_most(0.0);

        let (mut mu, mut inlet) = (zero, None);
        if self.film.is_some() || self.rolling_resistance.is_some() {
            let load = T::select(apart, zero.like(1.0), normal.force);
            let half_width = self.elastic.half_width(load);
            let mean_pressure = self.elastic.mean_pressure(load, half_width);
            let pressed = Pressed { ln_load: load.ln(), half_width, mean_pressure };
            if let Some(film) = &self.film {
                mu = self.traction_coefficient(film, motion, rolling, &pressed, &mut out);
            }
            if let Some(law) = &self.rolling_resistance {
                let force = law.force(load, pressed.ln_load, mean_pressure, rolling);
                out.rolling_resistance = T::select(apart, zero, zero - force * rolling.direction);
                inlet = law.sliding_secant(force, pressed.ln_load, rolling);
            }
        }
        let mut without_film = apart;
        if let Some(edge) = &self.edge_friction
            && B::any(edge_share.base().above(0.0))
        {
            let on_edge = edge_share.at_least(1.0);
            let dry = edge.at(rolling.slip);
            mu = T::select(on_edge, dry, mu + (dry - mu) * edge_share);
            without_film = apart | on_edge;
            out.rolling_resistance = T::select(on_edge, zero, out.rolling_resistance);
            if let Some(drag) = &mut inlet {
                *drag = T::select(on_edge, zero, *drag);
            }
        }
        let mut secant = mu * out.normal / rolling.slip;
        if let Some(drag) = inlet {
            secant += drag;
            mu = secant * rolling.slip / out.normal;
        }
        out.friction_coefficient = T::select(apart, zero, mu);
        out.friction_secant = T::select(apart, zero, secant);
        out.friction = T::select(apart, zero, -(secant * (motion.u1 - motion.u2)));
        out.film = T::select(without_film, zero, out.film);
        out.film_ratio = T::select(without_film, zero, out.film_ratio);
        out.temperature_rise = T::select(without_film, zero, out.temperature_rise);
        out
    }

    /// mu of a film; also sets film thickness, film ratio and temperature rise.
    #[inline(always)]
    fn traction_coefficient<T: Of<B>>(
        &self,
        film: &FilmThickness<B>,
        motion: &ContactMotion<T>,
        rolling: &Entrainment<T>,
        pressed: &Pressed<T>,
        out: &mut ContactForce<T>,
    ) -> T {
        let ln_film = film.ln_central(pressed.ln_load, pressed.mean_pressure, rolling);
        out.film = ln_film.exp();
        let friction = FilmFriction {
            traction: self.traction.as_ref(),
            self_heating: self.self_heating.as_ref(),
            regime: self.regime.as_ref(),
        };
        let (pressed, film) = ([pressed.mean_pressure, pressed.half_width], [out.film, ln_film]);
        let rubbing = friction.at(pressed, film, [motion.u1, motion.u2], rolling);
        (out.film_ratio, out.temperature_rise) = (rubbing.film_ratio, rubbing.temperature_rise);
        rubbing.coefficient
    }
}

#[cfg(test)]
pub(crate) mod tests;
