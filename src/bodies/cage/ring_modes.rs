//! In-plane bending of the ring of a cage, as modes in axes that turn with it.
//!
//! ```text
//! w(phi)   = Sum_n A_n cos(n phi) + B_n sin(n phi)                          outwards
//! u_t(phi) = Sum_n tau_n (A_n sin(n phi) - B_n cos(n phi)),   tau_n = -1/n + (xi/a) (n^2 - 1)/n
//! L = [I - Sum c (A^2 + B^2)] w^2/2 + Sum M [(A'^2 + B'^2)/2 + kappa w (A B' - B A')] - Sum K (A^2 + B^2)/2
//! M = (m/2) (1 + 1/n^2),   K = pi EI (n^2 - 1)^2/a^3,   kappa = 2 n/(n^2 + 1),   c = (m/2) (n^2 - 3),   D = 2 zeta sqrt(K M)
//! ```
//!
//! a neutral radius, m mass of the ring, w speed of the cage, xi height of a point above the neutral line, n = 2 to N. A ring
//! that does not stretch contracts where it bends: c is that change of the moment of inertia, and the stiffening by the
//! tension of the hoop less the softening by centrifugal forces. With it energy and angular momentum are exact. Modes carry no
//! momentum, so the translation of the cage is that of a rigid one.
//!
//! Valid for a thin ring, t/a below about 0.1, wavelengths over about three pitches of the pockets, amplitudes below a/100.
//! Source: Hoppe 1871, Love, Bryan 1890 for the linear vibration; the terms of second order are derived from the same
//! displacements.

use crate::bodies::cage::pocket_waves::PocketWaves;
use crate::scalar::{Dual, Lanes, Real, math};
use crate::scene::{ElasticRing, MOST_RING_ORDERS, RingStiffness};
use pulp::Arch;
use std::f64::consts::PI;

/// Most coordinates that the modes of a ring have.
pub(crate) const MOST_MODES: usize = 2 * (MOST_RING_ORDERS as usize - 1);

/// One pair of modes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(in crate::bodies) struct Mode {
    /// n.
    order: u32,
    /// M, kg.
    mass: f64,
    /// K, N/m.
    stiffness: f64,
    /// D, N s/m.
    damping: f64,
    /// kappa.
    gyroscopic: f64,
    /// c, kg.
    hoop: f64,
}

/// The modes of a ring. Coordinates are A and B of every order in turn.
#[derive(Debug)]
pub(in crate::bodies) struct RingModes {
    modes: Vec<Mode>,
    /// How each coordinate displaces each pocket, outwards and counter-clockwise, per unit.
    of_pockets: Vec<Vec<[f64; 2]>>,
    waves: PocketWaves,
}

impl RingModes {
    /// Those of a ring of `mass` (kg) that carries pockets at these angles (rad) on a circle of `pitch_radius` (m).
    pub(in crate::bodies) fn new(ring: &ElasticRing, mass: f64, pitch_radius: f64, pockets: &[f64]) -> Self {
        let a = ring.neutral_radius;
        let modes: Vec<Mode> = (2..=ring.modes)
            .map(|order| {
                let n = f64::from(order);
                let square = n * n;
                let of_ring = 0.5 * mass * (1.0 + 1.0 / square);
                let (mass_n, stiffness) = match &ring.stiffness {
                    RingStiffness::FiniteElements(found) => {
                        let at = order as usize - 2;
                        let (mass, frequency) = (found.modal_masses[at], found.frequencies[at]);
                        (mass, mass * frequency * frequency)
                    }
                    RingStiffness::Bending(bending) => (of_ring, of_bending(*bending, n, a)),
                    RingStiffness::Section(section) => {
                        (of_ring, of_bending(section.bending_stiffness(a, pockets.len()), n, a))
                    }
                };
                let share = mass_n / of_ring;
                Mode {
                    order,
                    mass: mass_n,
                    stiffness,
                    damping: 2.0 * ring.damping * (stiffness * mass_n).sqrt(),
                    gyroscopic: 2.0 * n / (square + 1.0) * share,
                    hoop: 0.5 * mass * (square - 3.0) * share,
                }
            })
            .collect();
        let height = pitch_radius - a;
        let of_pockets: Vec<Vec<_>> = pockets
            .iter()
            .map(|angle| {
                modes.iter().flat_map(|mode| displacements(mode.order, height / a, *angle)).collect()
            })
            .collect();
        let waves = PocketWaves::new(&of_pockets);
        Self { modes, of_pockets, waves }
    }

    /// Orders in turn.
    pub(in crate::bodies) fn orders(&self) -> impl Iterator<Item = u32> {
        self.modes.iter().map(|mode| mode.order)
    }

    /// How the coordinates displace pocket `j`, outwards and counter-clockwise, per unit.
    pub(in crate::bodies) fn displacements(&self, j: usize) -> &[[f64; 2]] {
        self.of_pockets.get(j).map_or(&[], Vec::as_slice)
    }

    /// How far these amplitudes (m) displace the pockets of a block, or rates.
    pub(in crate::bodies) fn displace(
        &self,
        block: usize,
        amplitudes: &[f64],
        out: &mut [Lanes; 2],
        instructions: Arch,
    ) {
        self.waves.displace(block, amplitudes, out, instructions);
    }

    /// Accelerations of the modes by forces `on` them, at these coordinates and their rates, and the angular acceleration of the
    /// cage by the moment `moment` about its centre of mass, where its speed is `speed` and its moment of inertia `inertia`.
    /// Dampers are left out where they are not wanted.
    pub(in crate::bodies) fn motion<T: Real>(
        &self,
        [moment, inertia, speed]: [T; 3],
        on: impl Fn(usize) -> T,
        [q, v]: [&[T]; 2],
        damped: bool,
        out: &mut [T],
    ) -> T {
        let zero = T::constant(0.0);
        let (mut free, mut turning, mut held) = (zero, moment, inertia);
        for (k, mode) in self.modes.iter().enumerate() {
            let Mode { mass, stiffness, damping, gyroscopic, hoop, .. } = *mode;
            let [(a, b), (a_rate, b_rate)] = [q, v].map(|x| (x[2 * k], x[2 * k + 1]));
            let damping = if damped { damping } else { 0.0 };
            let stiff = speed * speed * hoop + stiffness;
            let swing = speed * (2.0 * mass * gyroscopic);
            let inverse = 1.0 / mass;
            let [fa, fb] = [on(2 * k), on(2 * k + 1)];
            let free_a = (swing * b_rate - stiff * a - a_rate * damping + fa) * inverse;
            let free_b = (-(swing * a_rate) - stiff * b - b_rate * damping + fb) * inverse;
            (out[2 * k], out[2 * k + 1]) = (free_a, free_b);
            free += (a * a_rate + b * b_rate) * hoop;
            turning -= (a * free_b - b * free_a) * (mass * gyroscopic);
            held -= (a * a + b * b) * (hoop + mass * gyroscopic * gyroscopic);
        }
        turning += speed * free * 2.0;
        // A ring that has collapsed has no inertia left.
        let turned = if held.value() > 0.0 { turning / held } else { T::constant(f64::NAN) };
        for (k, mode) in self.modes.iter().enumerate() {
            let [a, b] = [q[2 * k], q[2 * k + 1]];
            let twist = turned * mode.gyroscopic;
            out[2 * k] += twist * b;
            out[2 * k + 1] -= twist * a;
        }
        turned
    }

    /// See [`RingModes::motion`].
    pub(in crate::bodies) fn accelerate(
        &self,
        turned: [f64; 3],
        on: &[f64],
        state: [&[f64]; 2],
        out: &mut [f64],
    ) -> f64 {
        self.motion(turned, |k| on[k], state, true, out)
    }

    /// What a moment about the centre of mass (N m) and forces over the coordinates alone do, in place of the forces. Returns
    /// the angular acceleration.
    pub(in crate::bodies) fn respond(&self, moment: f64, inertia: f64, q: &[f64], forces: &mut [f64]) -> f64 {
        let (mut turning, mut held) = (moment, inertia);
        for (k, mode) in self.modes.iter().enumerate() {
            let [a, b] = [q[2 * k], q[2 * k + 1]];
            forces[2 * k] /= mode.mass;
            forces[2 * k + 1] /= mode.mass;
            turning -= (a * forces[2 * k + 1] - b * forces[2 * k]) * (mode.mass * mode.gyroscopic);
            held -= (a * a + b * b) * (mode.hoop + mode.mass * mode.gyroscopic * mode.gyroscopic);
        }
        let turned = if held > 0.0 { turning / held } else { f64::NAN };
        for (k, mode) in self.modes.iter().enumerate() {
            forces[2 * k] += turned * mode.gyroscopic * q[2 * k + 1];
            forces[2 * k + 1] -= turned * mode.gyroscopic * q[2 * k];
        }
        turned
    }

    /// How the accelerations change at constant forces with the moment about the centre of mass, the speed, every coordinate and
    /// every rate, but for what dampers make of the rates: tells each of these in turn, and with it the slopes of the angular acceleration and of
    /// those of the modes.
    pub(in crate::bodies) fn slopes(
        &self,
        [moment, inertia, speed]: [f64; 3],
        on: &[f64],
        [q, v]: [&[f64]; 2],
        mut tell: impl FnMut(Over, f64, &[f64]),
    ) {
        let n = q.len();
        let constant = Dual::<1>::constant;
        let (mut positions, mut rates) = ([constant(0.0); MOST_MODES], [constant(0.0); MOST_MODES]);
        for k in 0..n {
            (positions[k], rates[k]) = (constant(q[k]), constant(v[k]));
        }
        let (mut out, mut slopes) = ([constant(0.0); MOST_MODES], [0.0; MOST_MODES]);
        let all = [Over::Moment, Over::Speed].into_iter();
        let all = all.chain((0..n).map(Over::Coordinate)).chain((0..n).map(Over::Rate));
        for over in all {
            let [mut m, mut w] = [constant(moment), constant(speed)];
            let varied = match over {
                Over::Moment => &mut m,
                Over::Speed => &mut w,
                Over::Coordinate(k) => &mut positions[k],
                Over::Rate(k) => &mut rates[k],
            };
            varied.eps[0] = 1.0;
            let state = [&positions[..n], &rates[..n]];
            let damped = !matches!(over, Over::Rate(_));
            let turned =
                self.motion([m, constant(inertia), w], |k| constant(on[k]), state, damped, &mut out[..n]);
            slopes.iter_mut().zip(&out[..n]).for_each(|(slope, a)| *slope = a.eps[0]);
            match over {
                Over::Coordinate(k) => positions[k].eps[0] = 0.0,
                Over::Rate(k) => rates[k].eps[0] = 0.0,
                Over::Moment | Over::Speed => {}
            }
            tell(over, turned.eps[0], &slopes[..n]);
        }
    }

    /// The moment about the centre of mass that turns the cage like this, N m: what [`RingModes::accelerate`] turns round.
    pub(in crate::bodies) fn moment_for(
        &self,
        [turned, inertia, speed]: [f64; 3],
        [q, v]: [&[f64]; 2],
        a: impl Fn(usize) -> f64,
    ) -> f64 {
        let mut moment = inertia * turned;
        for (k, mode) in self.modes.iter().enumerate() {
            let (i, j) = (2 * k, 2 * k + 1);
            let [x, y] = [q[i], q[j]];
            moment -= mode.hoop * (turned * (x * x + y * y) + 2.0 * speed * (x * v[i] + y * v[j]));
            moment += mode.mass * mode.gyroscopic * (x * a(j) - y * a(i));
        }
        moment
    }

    /// What the modes add to the kinetic energy, and their elastic energy, J.
    pub(in crate::bodies) fn energy(&self, speed: f64, [q, v]: [&[f64]; 2]) -> [f64; 2] {
        let (mut kinetic, mut elastic) = (0.0, 0.0);
        for (k, mode) in self.modes.iter().enumerate() {
            let ([a, b], [a_rate, b_rate]) = ([q[2 * k], q[2 * k + 1]], [v[2 * k], v[2 * k + 1]]);
            let square = a * a + b * b;
            let twist = mode.gyroscopic * speed * (a * b_rate - b * a_rate);
            kinetic += mode.mass * (0.5 * (a_rate * a_rate + b_rate * b_rate) + twist);
            kinetic -= 0.5 * mode.hoop * square * speed * speed;
            elastic += 0.5 * mode.stiffness * square;
        }
        [kinetic, elastic]
    }

    /// Angular momentum about its own axis of a cage with this moment of inertia and speed, kg m^2/s.
    pub(in crate::bodies) fn angular_momentum<T: Real>(
        &self,
        [inertia, speed]: [T; 2],
        [q, v]: [&[T]; 2],
    ) -> T {
        let mut sum = inertia * speed;
        for (k, mode) in self.modes.iter().enumerate() {
            let ([a, b], [a_rate, b_rate]) = ([q[2 * k], q[2 * k + 1]], [v[2 * k], v[2 * k + 1]]);
            sum += (a * b_rate - b * a_rate) * (mode.mass * mode.gyroscopic);
            sum -= (a * a + b * b) * speed * mode.hoop;
        }
        sum
    }

    /// Damping of every coordinate, N s/m.
    pub(in crate::bodies) fn damping(&self) -> impl Iterator<Item = f64> {
        self.modes.iter().flat_map(|mode| [mode.damping; 2])
    }

    /// Acceleration of the place of a radial force by all modes, per force, 1/kg.
    pub(in crate::bodies) fn mobility(&self) -> f64 {
        self.modes.iter().map(|mode| 1.0 / mode.mass).sum()
    }

    /// Order and frequency (rad/s) of each mode.
    pub(in crate::bodies) fn frequencies(&self) -> Vec<(u32, f64)> {
        self.modes.iter().map(|mode| (mode.order, (mode.stiffness / mode.mass).sqrt())).collect()
    }
}

/// K of order `n` (N/m) of a ring of this bending stiffness (N m^2) and neutral radius (m).
fn of_bending(bending: f64, n: f64, a: f64) -> f64 {
    let bent = n * n - 1.0;
    PI * bending * bent * bent / (a * a * a)
}

/// What accelerations change with.
#[derive(Clone, Copy, Debug)]
pub(in crate::bodies) enum Over {
    Moment,
    Speed,
    Coordinate(usize),
    Rate(usize),
}

/// How A and B of order `order` displace a point at `height` above the neutral line, in neutral radii, outwards and
/// counter-clockwise, at `angle` (rad).
fn displacements(order: u32, height: f64, angle: f64) -> [[f64; 2]; 2] {
    let n = f64::from(order);
    let (sin, cos) = math::sin_cos(n * angle);
    let along = along_factor(order, height);
    [[cos, along * sin], [sin, -along * cos]]
}

/// tau_n at `height` above the neutral line, in neutral radii.
pub(crate) fn along_factor(order: u32, height: f64) -> f64 {
    let n = f64::from(order);
    -1.0 / n + height * (n * n - 1.0) / n
}
