//! Rollers that move freely in the plane, in cylindrical coordinates about the centre of the bearing.
//!
//! ```text
//! m (rho'' - r psi'^2) = F_r,   m (r psi'' + 2 rho' psi') = F_psi,   I w' = M,   r = r_p + rho
//! ```
//!
//! The travel counts from the centred place of the pocket at the start; the spin angle enters no force.

use super::{Damping, ElementSlopes, UPPER, scale_rows};
use crate::bodies::{
    BodyEnergy, BodyForces, Coordinate, Element, ElementMotion, ElementSet, Elements, Fault, ForceSource,
    Input, InputValues, Layout, Motions, Moves, OF_ELEMENT, weight,
};
use crate::scalar::{Columns, Pack, dispatch};
use crate::scene::Scene;
use crate::space::Wrench;
use pulp::Simd;

/// A roller this far from the pitch circle, in pitch radii, has left the bearing.
const LOST_ROLLER: f64 = 0.25;

/// Mass in kg and moment of inertia in kg m^2 of a roller.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Inertia {
    mass: f64,
    moment: f64,
}

/// Rollers with states of their own.
#[derive(Debug)]
pub(in crate::bodies) struct Rollers {
    set: ElementSet,
    inertia: Inertia,
    /// Gap of a roller on the pitch circle to either raceway with the inner ring centred, m.
    gap: f64,
}

const COORDINATES: [Coordinate; OF_ELEMENT] = [
    Coordinate {
        position: Some(["radial_offset", "m", "distance outside the pitch circle"]),
        rate: ["radial_speed", "m/s", "rate of the radial offset"],
        moves: Moves::Itself,
    },
    Coordinate {
        position: Some([
            "orbit_travel",
            "rad",
            "orbit angle travelled from the centred place of its pocket at the start",
        ]),
        rate: ["orbit_speed", "rad/s", "rate of the orbit angle"],
        moves: Moves::PitchCircle,
    },
    Coordinate {
        position: None,
        rate: ["spin_speed", "rad/s", "rotation speed about its own axis"],
        moves: Moves::Surface,
    },
];

impl Rollers {
    /// The rollers of a scene, if it has any.
    pub(in crate::bodies) fn new(scene: &Scene) -> Option<Self> {
        let rollers = scene.rollers.as_ref()?;
        Some(Self {
            set: ElementSet::new(scene),
            inertia: Inertia { mass: rollers.mass, moment: rollers.inertia },
            gap: scene.radial_clearance() / 4.0,
        })
    }

    /// Radius of the circle of the centres of rollers that touch the outer raceway, m.
    fn outer_centre_radius(&self) -> f64 {
        self.set.pitch_radius + self.gap
    }
}

impl Elements for Rollers {
    fn set(&self) -> &ElementSet {
        &self.set
    }

    fn kind(&self) -> &'static str {
        "roller"
    }

    fn coordinates(&self) -> &'static [Coordinate] {
        &COORDINATES
    }

    fn mass(&self) -> Option<f64> {
        Some(self.inertia.mass)
    }

    fn mobility(&self) -> f64 {
        let (Inertia { mass, moment }, radius) = (self.inertia, self.set.radius);
        1.0 / mass + radius * radius / moment
    }

    fn centrifugal(&self, orbit_speed: f64) -> f64 {
        self.inertia.mass * self.set.pitch_radius * orbit_speed * orbit_speed
    }

    fn kinematic_speeds(&self, inputs: &InputValues) -> [f64; 2] {
        let orbit = self.orbit_ratio() * inputs.of(Input::RingSpeed);
        let spin_ratio = -self.orbit_ratio() * self.outer_centre_radius() / self.set.radius;
        [orbit, spin_ratio * inputs.of(Input::RingSpeed)]
    }

    /// Of a roller that touches both raceways: R_i/(2 (R_o - R_b)).
    fn orbit_ratio(&self) -> f64 {
        (self.set.pitch_radius - self.set.radius - self.gap) / (2.0 * self.outer_centre_radius())
    }

    fn find(
        &self,
        layout: &Layout,
        q: &[f64],
        v: &[f64],
        _inputs: &InputValues,
        out: &mut Motions,
    ) -> Result<(), Fault> {
        let n = layout.count;
        let Motions { elements, places, instructions, .. } = out;
        let states = q[layout.elements..].chunks_exact(2).zip(&self.set.reference_angles);
        let columns = places.radial_offset.iter_mut().zip(&mut places.azimuth).zip(&mut places.travel);
        for (j, (((radial_offset, azimuth), travel), (state, reference))) in columns.zip(states).enumerate() {
            (*radial_offset, *azimuth, *travel) = (state[0], reference + state[1], state[1]);
            if state[0].abs() > LOST_ROLLER * self.set.pitch_radius {
                return Err(Fault::LostRoller { roller: j, radial_offset: state[0] });
            }
        }
        places.find_directions(n, *instructions);
        let (rates, spins) = v[layout.elements..].split_at(2 * n);
        let rates = rates.chunks_exact(2).zip(spins);
        for ((motion, (rates, spin)), radial_offset) in
            elements.iter_mut().zip(rates).zip(&places.radial_offset)
        {
            *motion = ElementMotion {
                radial_offset: *radial_offset,
                radial_speed: rates[0],
                orbit_speed: rates[1],
                spin_speed: *spin,
            };
        }
        Ok(())
    }

    fn travel(&self, layout: &Layout, q: &[f64], _inputs: &InputValues, j: usize) -> [f64; 2] {
        let i = layout.element(j);
        [q[i + 1], q[i]]
    }

    fn accelerate(
        &self,
        layout: &Layout,
        motions: &Motions,
        on_elements: &[Wrench<f64>],
        gravity: [f64; 2],
        a: &mut [f64],
    ) {
        let Inertia { mass, moment } = self.inertia;
        let (rates, spins) = a[layout.elements..].split_at_mut(2 * layout.count);
        let rates = rates.chunks_exact_mut(2).zip(spins);
        for (j, ((rates, spin), wrench)) in rates.zip(on_elements).enumerate() {
            let element = motions.element(j);
            let r = element.radius;
            let weight = element.frame.to_local(gravity);
            let (radial_speed, orbit) = (element.motion.radial_speed, element.motion.orbit_speed);
            rates[0] = wrench.force[0] / mass + weight[0] + r * orbit * orbit;
            rates[1] = (wrench.force[1] / mass + weight[1] - 2.0 * radial_speed * orbit) / r;
            *spin = wrench.moment / moment;
        }
    }

    fn slopes(
        &self,
        element: &Element,
        on_element: &Wrench<f64>,
        gravity: [f64; 2],
        k: ElementSlopes<'_>,
        d: ElementSlopes<'_>,
    ) -> [f64; OF_ELEMENT] {
        let (Inertia { mass, moment }, r) = (self.inertia, element.radius);
        let inverse = [1.0 / mass, 1.0 / (mass * r), 1.0 / moment];
        for columns in [&mut *k.own, k.over_hub, &mut *d.own, d.over_hub] {
            scale_rows(columns, &inverse);
        }
        let [weight_r, weight_c] = element.frame.to_local(gravity);
        let (radial_speed, orbit) = (element.motion.radial_speed, element.motion.orbit_speed);
        let across = (on_element.force[1] / mass + weight_c - 2.0 * radial_speed * orbit) / r;
        k.own[0][0] += orbit * orbit;
        k.own[1][0] += weight_c;
        k.own[0][1] -= across / r;
        k.own[1][1] -= weight_r / r;
        d.own[1][0] += 2.0 * r * orbit;
        d.own[0][1] -= 2.0 * orbit / r;
        d.own[1][1] -= 2.0 * radial_speed / r;
        inverse
    }

    fn accelerations_of(&self, motions: &Motions, damping: &mut Damping) {
        let divide = Divide {
            inertia: self.inertia,
            pitch_radius: self.set.pitch_radius,
            rows: self.set.count,
            radial_offset: &motions.places.radial_offset,
            damping,
        };
        dispatch(motions.instructions, divide);
    }

    fn energy(&self, element: &Element, gravity: [f64; 2]) -> BodyEnergy {
        let Inertia { mass, moment } = self.inertia;
        let m = &element.motion;
        let across = element.radius * m.orbit_speed;
        BodyEnergy {
            kinetic: 0.5
                * (mass * (m.radial_speed * m.radial_speed + across * across)
                    + moment * m.spin_speed * m.spin_speed),
            potential: BodyEnergy::of_weight(mass, gravity, element.frame.to_global([element.radius, 0.0])),
        }
    }

    fn report(&self, gravity: [f64; 2], out: &mut BodyForces) {
        out[ForceSource::Gravity as usize] = weight(self.inertia.mass, gravity);
    }
}

/// From force over speed in the local frame to acceleration over rate of the coordinates.
struct Divide<'a> {
    inertia: Inertia,
    pitch_radius: f64,
    rows: usize,
    radial_offset: &'a [f64],
    damping: &'a mut Damping,
}

impl Columns for Divide<'_> {
    const PAIRED: bool = false;

    fn rows(&self) -> usize {
        self.rows
    }

    #[inline(always)]
    #[expect(clippy::needless_range_loop, reason = "iterators might not be inlined")]
    fn group<S: Simd, const K: usize>(&mut self, simd: S, first: usize) {
        let Self { inertia, pitch_radius, radial_offset, damping, .. } = self;
        let Inertia { mass, moment } = *inertia;
        let all = |x: f64| Pack::<S, K>::all(simd, x);
        let r = Pack::load(simd, &radial_offset[first..]) + *pitch_radius;
        let speed = [all(1.0), r, all(1.0)];
        let inverse: [_; OF_ELEMENT] = [all(1.0 / mass), all(1.0 / mass) / r, all(1.0 / moment)];
        for at in 0..UPPER.len() {
            let (i, k) = UPPER[at];
            let full = Pack::load(simd, &damping.full[i][k][first..]);
            let implicit = Pack::load(simd, &damping.implicit[i][k][first..]);
            let (here, mirrored) = (inverse[i] * speed[k], inverse[k] * speed[i]);
            (full * here).store(&mut damping.full[i][k][first..]);
            (full * mirrored).store(&mut damping.full[k][i][first..]);
            (implicit * here).store(&mut damping.implicit[i][k][first..]);
            (implicit * mirrored).store(&mut damping.implicit[k][i][first..]);
        }
    }
}
