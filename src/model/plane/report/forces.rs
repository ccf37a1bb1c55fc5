//! Force report: every contact and every contribution to every body at one state.

use crate::bodies::{BodyForces, BodyState, CAGE, Element};
use crate::laws::guide::GuideForce;
use crate::laws::line_contact::Loading;
use crate::model::plane::Plane;
use crate::model::plane::Workspace;
use crate::model::{Quantity, SpatialForces, quantity};
use crate::pairs::{Loaded, NEIGHBOUR};
use crate::space::Wrench;

/// What is reported of a contact. All zero when the surfaces are apart. A contact that touches but whose damping
/// would pull has a normal force of zero, its approach, its speeds and its place.
///
/// The normal n points from the centre of the element to the contact, t is n turned by +90 degrees. The force on the element is
/// -n Q + t (friction + rolling_resistance + film_pressure_roller); that on the mate, which is the opposite,
/// n Q + t (-friction + rolling_resistance + film_pressure_mate).
pub const CONTACT_QUANTITIES: [Quantity; 23] = [
    quantity("normal_force", "N", "normal force Q"),
    quantity("approach", "m", "elastic approach delta"),
    quantity("film_thickness", "m", "central film thickness h_c"),
    quantity("film_ratio", "1", "film ratio Lambda"),
    quantity("temperature_rise", "K", "temperature rise of the traction film"),
    quantity("friction_coefficient", "1", "friction coefficient mu = |F_T|/Q"),
    quantity("friction", "N", "friction F_T on the roller along t"),
    quantity(
        "rolling_resistance",
        "N",
        "rolling resistance F_EHLr on each surface along t, against the rolling speed u",
    ),
    quantity("film_pressure_roller", "N", "film pressure force F_px through the roller centre along t"),
    quantity("film_pressure_mate", "N", "film pressure force F_px through the centre of the mate along t"),
    quantity("slip_speed", "m/s", "u1 - u2: surface speed of the roller less that of the mate"),
    quantity("rolling_speed", "m/s", "u: mean of the surface speeds"),
    quantity("approach_speed", "m/s", "rate of the approach"),
    quantity(
        "surface_speed_roller",
        "m/s",
        "u1: surface speed of the roller along t relative to the contact",
    ),
    quantity("surface_speed_mate", "m/s", "u2: surface speed of the mate along t relative to the contact"),
    quantity("half_width", "m", "Hertz half width b; 0 of a solid contact without it"),
    quantity("mean_pressure", "Pa", "Hertz mean pressure; 0 of a solid contact without it"),
    quantity(
        "film_thermal_factor",
        "1",
        "what heat at the inlet leaves of the film thickness; 0 without film",
    ),
    quantity(
        "rolling_thermal_factor",
        "1",
        "what heat at the inlet leaves of the rolling resistance; 0 without it",
    ),
    quantity("point_y", "m", "contact point, to the right of the centre of the bearing"),
    quantity("point_z", "m", "contact point, above the centre of the bearing"),
    quantity("normal_y", "1", "normal from the centre of the roller to the contact, to the right"),
    quantity("normal_z", "1", "normal from the centre of the roller to the contact, upwards"),
];

/// Values of [`CONTACT_QUANTITIES`].
pub type ContactForces = [f64; CONTACT_QUANTITIES.len()];

/// Index of the normal force in [`ContactForces`].
pub(super) const NORMAL_FORCE: usize = 0;
/// Index of the mean pressure in [`ContactForces`].
pub(super) const MEAN_PRESSURE: usize = 16;
/// Indices of friction and slip speed in [`ContactForces`].
pub(super) const FRICTION: usize = 6;
pub(super) const SLIP_SPEED: usize = 10;
/// Index of the film thickness in [`ContactForces`].
pub(super) const FILM_THICKNESS: usize = 2;

/// Components of a force on a body, in [`BodyForces`].
pub const FORCE_COMPONENTS: [Quantity; 3] = [
    quantity("force_y", "N", "force to the right"),
    quantity("force_z", "N", "force upwards"),
    quantity("moment_x", "N m", "moment about the centre of the body, positive counter-clockwise"),
];

/// All forces at one state.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Forces {
    /// Per contact, in the order of [`Plane::contact_names`].
    pub contacts: Vec<ContactForces>,
    /// Per body, in the order of [`Plane::body_names`]. Inertia forces of the rotating frame are not included.
    pub bodies: Vec<BodyForces>,
    /// Acceleration of every velocity state, m/s^2 or rad/s^2.
    pub accelerations: Vec<f64>,
    /// The guide of the cage; all zero without one.
    pub guide: GuideReport,
    /// Contacts and bodies of a bearing in space, which has nothing in the fields for those of the plane.
    pub space: SpatialForces,
}

impl Forces {
    /// Values of all contacts, one after another.
    pub fn contact_values(&self) -> &[f64] {
        let plane = self.contacts.as_flattened();
        if plane.is_empty() { self.space.contacts.as_flattened() } else { plane }
    }

    /// Components of the forces on all bodies, by body and source.
    pub fn body_values(&self) -> &[f64] {
        let plane = self.bodies.as_flattened().as_flattened();
        if plane.is_empty() { self.space.bodies.as_flattened().as_flattened() } else { plane }
    }
}

/// Forces of the guide on the cage (y, z) in N, and its film.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct GuideReport {
    /// Film pressure.
    pub pressure: [f64; 2],
    /// Film shear.
    pub shear: [f64; 2],
    /// Solid contact.
    pub solid: [f64; 2],
    /// Share of the film: 1 for a film alone, 0 for a solid contact alone.
    pub film_share: f64,
    /// Smallest gap, m.
    pub minimum_film: f64,
    /// Cage centre relative to the centre of the guiding ring, m, and its velocity, m/s.
    pub offset: [f64; 2],
    /// See `offset`.
    pub velocity: [f64; 2],
}

impl Plane {
    /// Writes the results of the last evaluation of `ws` into `out`, with the accelerations `a` and the bodies at (`q`, `v`).
    pub(crate) fn report(&self, q: &[f64], v: &[f64], ws: &Workspace, a: &[f64], out: &mut Forces) {
        let per_element = self.contacts_per_element();
        out.contacts.clear();
        out.contacts.resize(per_element * self.element_count(), ContactForces::default());
        out.bodies.clear();
        out.bodies.resize(self.body_count(), BodyForces::default());
        out.accelerations.clear();
        out.accelerations.extend_from_slice(a);
        for contact in ws.contacts.iter() {
            let site = contact.site;
            let element = ws.motions.element(site.element);
            let frame = element.frame;
            let loading = self.laws[site.pair]
                .line()
                .map(|law| law.loading(&contact.motion, ws.fluid.ln_viscosity, &contact.force));
            out.contacts[self.contact_place(site)] =
                quantities(&contact, &element, &loading.unwrap_or_default());
            let source = self.infos[site.pair].source as usize;
            let mate = Some(site.mate).filter(|mate| *mate != NEIGHBOUR).map(|mate| self.report_place(mate));
            let bodies = [Some(self.element_body(site.element)), mate];
            let on_bodies = bodies.into_iter().zip(contact.grip.wrenches(&contact.force));
            for (body, on_body) in on_bodies.filter_map(|(body, on_body)| Some((body?, on_body))) {
                let force = frame.to_global(on_body.force);
                add(&mut out.bodies[body][source], &Wrench { force, ..on_body });
            }
        }
        let shared = self.motions_at(q, v, &ws.inputs);
        out.guide = GuideReport::default();
        for (info, force) in self.between_infos.iter().zip(&ws.between) {
            for (body, on_body) in info.bodies.into_iter().zip(&force.on) {
                add(&mut out.bodies[self.report_place(body)][info.source as usize], on_body);
            }
        }
        if let Some(on_cage) = self.force_of_guide(ws) {
            out.guide.pressure = on_cage.pressure;
            out.guide.shear = on_cage.shear;
            out.guide.solid = on_cage.solid;
            out.guide.film_share = on_cage.film_share;
            out.guide.minimum_film = self.smallest_gap(ws);
        }
        if self.has_cage() {
            let [body, ring] = [&shared[CAGE], &shared[self.guiding_ring()]];
            out.guide.offset = std::array::from_fn(|k| body.position[k] - ring.position[k]);
            out.guide.velocity = std::array::from_fn(|k| body.velocity[k] - ring.velocity[k]);
        }
        let present =
            self.shared.iter().enumerate().filter_map(|(place, body)| Some((place, body.as_ref()?)));
        for ((place, body), out) in present.zip(&mut out.bodies) {
            let at = self.layout.range(place);
            let state = BodyState { motion: &shared[place], q: &q[at.clone()], v: &v[at] };
            body.report(&state, &ws.inputs, self.gravity, out);
        }
        let first = self.element_body(0);
        for out in &mut out.bodies[first..] {
            self.elements.report(self.gravity, out);
        }
    }

    /// Smallest gap of the guide, m, at the last evaluated state; 0 without a guide.
    pub(super) fn smallest_gap(&self, ws: &Workspace) -> f64 {
        self.guide().map_or(0.0, |(place, _)| self.between[place].smallest_gap(&ws.motions))
    }

    /// Force of the guide on the cage by its parts, at the last evaluated state.
    pub(super) fn force_of_guide(&self, ws: &Workspace) -> Option<GuideForce<f64>> {
        let (place, _) = self.guide()?;
        Some(self.between[place].parts(&ws.motions, &ws.between[place]))
    }
}

fn add(sum: &mut [f64; 3], w: &Wrench<f64>) {
    for (sum, x) in sum.iter_mut().zip(w.components()) {
        *sum += x;
    }
}

fn quantities(contact: &Loaded<'_>, element: &Element, loading: &Loading) -> ContactForces {
    let (f, m, grip) = (contact.force, contact.motion, contact.grip);
    let [pressure_roller, pressure_mate] = grip.film_pressure_forces(&f);
    let [along, across] = grip.normal;
    let point = element.frame.to_global([element.radius + grip.arm * along, grip.arm * across]);
    let normal = element.frame.to_global(grip.normal);
    [
        f.normal,
        m.delta,
        f.film,
        f.film_ratio,
        f.temperature_rise,
        f.friction_coefficient,
        f.friction,
        f.rolling_resistance,
        pressure_roller,
        pressure_mate,
        m.u1 - m.u2,
        0.5 * (m.u1 + m.u2),
        m.delta_dot,
        m.u1,
        m.u2,
        loading.half_width,
        loading.mean_pressure,
        loading.film_thermal_factor,
        loading.rolling_thermal_factor,
        point[0],
        point[1],
        normal[0],
        normal[1],
    ]
}
