//! Small systems with known solutions, for tests of integration methods.

use cagedyn::integrate::{
    GroupDamping, Linearization, Linearized, Observed, Split, Structure, Structured, System, Vibration,
    implicit_share,
};
use nalgebra::DMatrix;

/// A damped oscillator, a driven rotor and a speed without position, coupled, with an analytic solution:
/// x'' = -2 zeta x' - x, y'' = 0, w' = -rate (w - goal), and z'' = 0.
#[derive(Clone)]
pub struct Oscillator {
    pub zeta: f64,
    pub rate: f64,
    /// Damping that methods are told of, as a share of what there is.
    pub known: f64,
    /// The goal of w jumps from 1 to 2 at this time.
    pub jump: f64,
    /// Positions beyond this have no forces.
    pub wall: f64,
    pub evaluations: u64,
}

impl Oscillator {
    pub fn smooth() -> Self {
        Self { zeta: 0.1, rate: 0.7, known: 1.0, jump: f64::INFINITY, wall: f64::INFINITY, evaluations: 0 }
    }

    /// x, x', w at time t from x = 1, x' = 0, w = 0.
    pub fn exact(&self, t: f64) -> [f64; 3] {
        let omega = (1.0 - self.zeta * self.zeta).sqrt();
        let decay = (-self.zeta * t).exp();
        let x = decay * ((omega * t).cos() + self.zeta / omega * (omega * t).sin());
        let v = -decay * (omega * t).sin() / omega;
        let before = 1.0 - (-self.rate * t.min(self.jump)).exp();
        let w =
            if t <= self.jump { before } else { 2.0 + (before - 2.0) * (-self.rate * (t - self.jump)).exp() };
        [x, v, w]
    }
}

impl System for Oscillator {
    type Fault = &'static str;
    fn positions(&self) -> usize {
        2
    }
    fn velocities(&self) -> usize {
        3
    }
    fn accelerations(&mut self, t: f64, q: &[f64], v: &[f64], a: &mut [f64]) -> Result<(), &'static str> {
        self.evaluations += 1;
        if q[0] > self.wall {
            return Err("behind the wall");
        }
        let goal = if t < self.jump { 1.0 } else { 2.0 };
        a[0] = -2.0 * self.zeta * v[0] - q[0];
        a[1] = 0.0;
        a[2] = -self.rate * (v[2] - goal);
        Ok(())
    }
    fn not_finite(&self, _: usize) -> &'static str {
        "not finite"
    }
    fn next_event(&self, t: f64) -> f64 {
        if t < self.jump { self.jump } else { f64::INFINITY }
    }
    fn groups(&self) -> Vec<Vec<usize>> {
        self.structure().groups()
    }
}

impl Structured<3> for Oscillator {
    fn structure(&self) -> Structure<3> {
        Structure::around(3, Vec::new())
    }
}

impl Linearized<3> for Oscillator {
    fn linearize(
        &mut self,
        t: f64,
        q: &[f64],
        v: &[f64],
        a: &mut [f64],
        out: &mut Linearization<3>,
    ) -> Result<(), &'static str> {
        self.accelerations(t, q, v, a)?;
        out.clear();
        out.over_positions.hub[(0, 0)] = -1.0;
        out.over_velocities.hub[(0, 0)] = -2.0 * self.zeta;
        out.over_velocities.hub[(2, 2)] = -self.rate;
        Ok(())
    }
}

impl Split<3> for Oscillator {
    fn damping(&mut self, h: f64, _: &[f64], _: &[f64], damping: &mut GroupDamping<3>) {
        let rates = [2.0 * self.zeta, 0.0, self.rate].map(|rate| rate * self.known);
        let full = DMatrix::from_diagonal(&rates.to_vec().into());
        let share = implicit_share(h * rates[0].max(rates[2]));
        damping.bodies[0].share = share;
        damping.bodies[0].full = full;
    }
}

impl Observed for Oscillator {}

/// v' = -rate (v - cos t) with a position, coupled to a spoke of three velocities: stiff and driven.
pub struct Driven {
    pub rate: f64,
}

impl System for Driven {
    type Fault = &'static str;
    fn positions(&self) -> usize {
        3
    }
    fn velocities(&self) -> usize {
        4
    }
    fn accelerations(&mut self, t: f64, q: &[f64], v: &[f64], a: &mut [f64]) -> Result<(), &'static str> {
        a[0] = -self.rate * (v[0] - t.cos()) - t.sin() + 0.3 * (q[1] - q[0]) - v[3] * v[0];
        a[1] = -q[1] * q[1] * q[1] + 0.5 * q[0] - 0.2 * v[1] * v[2];
        a[2] = -4.0 * q[2] + (t * q[1]).sin();
        a[3] = v[0] - v[3] * v[3];
        Ok(())
    }
    fn not_finite(&self, _: usize) -> &'static str {
        "not finite"
    }
}

impl Structured<3> for Driven {
    fn structure(&self) -> Structure<3> {
        Structure::around(1, vec![[1, 2, 3]])
    }
}

impl Linearized<3> for Driven {
    fn linearize(
        &mut self,
        t: f64,
        q: &[f64],
        v: &[f64],
        a: &mut [f64],
        out: &mut Linearization<3>,
    ) -> Result<(), &'static str> {
        self.accelerations(t, q, v, a)?;
        out.clear();
        let (k, d) = (&mut out.over_positions, &mut out.over_velocities);
        k.hub[(0, 0)] = -0.3;
        k.to_hub[(0, 0)] = 0.3;
        d.hub[(0, 0)] = -self.rate - v[3];
        d.to_hub[(0, 2)] = -v[0];
        k.from_hub[(0, 0)] = 0.5;
        k.own[(0, 0)] = -3.0 * q[1] * q[1];
        d.own[(0, 0)] = -0.2 * v[2];
        d.own[(0, 1)] = -0.2 * v[1];
        k.own[(1, 0)] = t * (t * q[1]).cos();
        k.own[(1, 1)] = -4.0;
        d.from_hub[(2, 0)] = 1.0;
        d.own[(2, 2)] = -2.0 * v[3];
        out.over_time.copy_from_slice(&[-self.rate * t.sin() - t.cos(), 0.0, q[1] * (t * q[1]).cos(), 0.0]);
        Ok(())
    }
}

impl Observed for Driven {}

/// An undamped spring whose stiffness changes at given times, and that fails for some evaluations after one.
pub struct Stiffening {
    /// From these times on (s) the square of the frequency is this.
    pub squares: [(f64, f64); 3],
    pub fails_from: f64,
    pub failures: u64,
}

impl Stiffening {
    pub fn square(&self, t: f64) -> f64 {
        self.squares.iter().rev().find(|(from, _)| t >= *from).map_or(1.0, |(_, square)| *square)
    }
}

impl System for Stiffening {
    type Fault = &'static str;
    fn positions(&self) -> usize {
        1
    }
    fn velocities(&self) -> usize {
        1
    }
    fn accelerations(&mut self, t: f64, q: &[f64], _: &[f64], a: &mut [f64]) -> Result<(), &'static str> {
        if t > self.fails_from && self.failures > 0 {
            self.failures -= 1;
            return Err("out of order");
        }
        a[0] = -self.square(t) * q[0];
        Ok(())
    }
    fn not_finite(&self, _: usize) -> &'static str {
        "not finite"
    }
    fn next_event(&self, t: f64) -> f64 {
        self.squares.iter().map(|(from, _)| *from).find(|from| *from > t).unwrap_or(f64::INFINITY)
    }
    fn groups(&self) -> Vec<Vec<usize>> {
        self.structure().groups()
    }
}

impl Structured<3> for Stiffening {
    fn structure(&self) -> Structure<3> {
        Structure::around(1, Vec::new())
    }
}

impl Linearized<3> for Stiffening {
    fn linearize(
        &mut self,
        t: f64,
        q: &[f64],
        v: &[f64],
        a: &mut [f64],
        out: &mut Linearization<3>,
    ) -> Result<(), &'static str> {
        self.accelerations(t, q, v, a)?;
        out.clear();
        out.over_positions.hub[(0, 0)] = -self.square(t);
        Ok(())
    }
}

impl Split<3> for Stiffening {
    fn damping(&mut self, _: f64, _: &[f64], _: &[f64], _: &mut GroupDamping<3>) {}
}

impl Observed for Stiffening {
    fn vibration(&self) -> Vibration {
        Vibration { squares: 1.0, count: 1.0 }
    }
}
