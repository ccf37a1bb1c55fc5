//! The linear systems of implicit integrators, `(I - gamma J) x = b`, for hosts that bring their own: solved through the
//! structure of J, in time and memory proportional to the number of rollers; as a dense matrix where a block of it is singular.

use crate::error::{Error, Result, Status};
use crate::integrate::linear::shifted::Shifted;
use crate::model::{Model, OF_BALL, OF_ELEMENT};
use crate::sim::linear::jacobian::{AnySlopes, Slopes};
use crate::sim::{Evaluated, Sim, check_time, wrong_size};

/// Derivatives and factors that are kept from call to call.
pub(in crate::sim) struct Newton {
    slopes: AnySlopes,
    linearized: bool,
    shifted: AnyShifted,
    /// 1/gamma of the factors, 1/s; none before there are any.
    shift: Option<f64>,
    solution: Vec<f64>,
}

/// Factors for the spokes of the plane or of space.
enum AnyShifted {
    Plane(Shifted<f64, OF_ELEMENT>),
    Space(Shifted<f64, OF_BALL>),
}

impl Newton {
    fn new(model: &Model) -> Self {
        let slopes = AnySlopes::new(model);
        let shifted = match &slopes {
            AnySlopes::Plane(slopes) => AnyShifted::Plane(Shifted::new(&slopes.structure)),
            AnySlopes::Space(slopes) => AnyShifted::Space(Shifted::new(&slopes.structure)),
        };
        Self {
            shifted,
            slopes,
            linearized: false,
            shift: None,
            solution: vec![0.0; model.layout().positions() + model.layout().velocities()],
        }
    }

    /// Whether there are factors for this shift, 1/s.
    fn factorize(&mut self, shift: f64) -> bool {
        match (&mut self.shifted, &self.slopes) {
            (AnyShifted::Plane(shifted), AnySlopes::Plane(slopes)) => {
                shifted.factorize(&slopes.linearization, shift)
            }
            (AnyShifted::Space(shifted), AnySlopes::Space(slopes)) => {
                shifted.factorize(&slopes.linearization, shift)
            }
            _ => false,
        }
    }

    fn solve(&mut self, positions: usize) {
        match (&mut self.shifted, &self.slopes) {
            (AnyShifted::Plane(shifted), AnySlopes::Plane(Slopes { linearization, structure })) => {
                shifted.solve(linearization, structure, positions, &mut self.solution);
            }
            (AnyShifted::Space(shifted), AnySlopes::Space(Slopes { linearization, structure })) => {
                shifted.solve(linearization, structure, positions, &mut self.solution);
            }
            _ => self.solution.fill(f64::NAN),
        }
    }
}

impl Sim {
    /// Evaluates the exact derivatives J of what [`Sim::derivative`] gives, at an arbitrary state and time `t` (s), and
    /// keeps them for [`Sim::factorize`]. The simulation's own state is not touched, and nothing is counted. The first
    /// call takes memory; later ones take none.
    ///
    /// # Errors
    /// As [`Sim::jacobian`]; there is then nothing to factorize.
    pub fn linearize(&mut self, t: f64, state: &[f64]) -> Result<()> {
        check_time("t", t)?;
        self.check_state(state)?;
        self.evaluated = Evaluated::Other;
        let newton = self.newton.get_or_insert_with(|| Box::new(Newton::new(self.bearing.model())));
        let slopes = &mut newton.slopes;
        let evaluated = self.bearing.linearize_at(t, state, &mut self.accelerations, slopes);
        let linearized = evaluated.and_then(|()| slopes.check());
        (newton.linearized, newton.shift) = (linearized.is_ok(), None);
        linearized.map_err(|fault| self.bad_state(t, fault))
    }

    /// Factorizes `I - gamma J` with the derivatives of the last [`Sim::linearize`], `gamma` in s and above zero. Can be
    /// repeated with another `gamma`.
    ///
    /// # Errors
    /// [`Status::BadValue`] for `gamma`; [`Status::BadState`] without derivatives or when the matrix has no inverse.
    pub fn factorize(&mut self, gamma: f64) -> Result<()> {
        if !(gamma > 0.0 && gamma.is_finite() && gamma.recip().is_finite()) {
            let text = format!("gamma: {gamma} s is not a finite number above zero");
            return Err(Error::new(Status::BadValue, text));
        }
        let newton = self.newton.as_deref_mut().filter(|newton| newton.linearized);
        let newton = newton.ok_or_else(|| out_of_order("linearize"))?;
        let shift = gamma.recip();
        newton.shift = None;
        if !newton.factorize(shift) {
            let text = format!(
                "I - gamma J has no inverse for gamma = {gamma:?} s at the state of the last linearize"
            );
            return Err(Error::new(Status::BadState, text));
        }
        newton.shift = Some(shift);
        Ok(())
    }

    /// Replaces the right-hand side `x`, in the order of the state, by the solution of `(I - gamma J) x = b` with the
    /// factors of the last [`Sim::factorize`].
    ///
    /// # Errors
    /// [`Status::WrongSize`]; [`Status::BadState`] without factors, whatever is in `x`, or when the solution is not finite;
    /// [`Status::BadValue`] for numbers that are not finite. `x` is then unchanged.
    pub fn solve(&mut self, x: &mut [f64]) -> Result<()> {
        if x.len() != self.state.len() {
            return Err(wrong_size("x", x.len(), self.state.len()));
        }
        let positions = self.model().layout().positions();
        let newton = self.newton.as_deref_mut().ok_or_else(|| out_of_order("factorize"))?;
        let shift = newton.shift.ok_or_else(|| out_of_order("factorize"))?;
        if let Some(i) = x.iter().position(|x| !x.is_finite()) {
            return Err(Error::new(Status::BadValue, format!("x[{i}]: {} is not a finite number", x[i])));
        }
        for (r, b) in newton.solution.iter_mut().zip(&*x) {
            *r = shift * b;
        }
        newton.solve(positions);
        if newton.solution.iter().any(|x| !x.is_finite()) {
            let text = "the solution of (I - gamma J) x = b is not finite";
            return Err(Error::new(Status::BadState, text.to_owned()));
        }
        x.copy_from_slice(&newton.solution);
        Ok(())
    }
}

fn out_of_order(before: &str) -> Error {
    Error::new(Status::BadState, format!("there is nothing to use yet: {before} comes first"))
}
