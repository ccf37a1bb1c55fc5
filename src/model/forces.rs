//! Force report: every contact and every contribution to every body at one state.

use super::batch::{Loaded, Mate, Site};
use super::evaluate::pocket_wrenches;
use super::workspace::Workspace;
use super::{ElementKind, Input, Model, RingBody};
use crate::contact::Wrench;
use crate::contact::pocket::Pillar;

/// Name, unit and meaning of a reported quantity.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Quantity {
    /// Name.
    pub name: &'static str,
    /// SI unit; "1" for ratios.
    pub unit: &'static str,
    /// What it is.
    pub description: &'static str,
}

const fn quantity(name: &'static str, unit: &'static str, description: &'static str) -> Quantity {
    Quantity { name, unit, description }
}

/// What is reported of a contact. All zero when the surfaces are apart. A contact that touches but whose damping
/// would pull has a normal force of zero, its approach and its speeds.
pub const CONTACT_QUANTITIES: [Quantity; 12] = [
    quantity("normal_force", "N", "normal force Q"),
    quantity("approach", "m", "elastic approach delta"),
    quantity("film_thickness", "m", "central film thickness h_c"),
    quantity("film_ratio", "1", "film ratio Lambda"),
    quantity("temperature_rise", "K", "temperature rise of the traction film"),
    quantity("friction_coefficient", "1", "traction coefficient mu"),
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
];

/// Values of [`CONTACT_QUANTITIES`].
pub type ContactForces = [f64; CONTACT_QUANTITIES.len()];

/// Index of the normal force in [`ContactForces`].
pub(super) const NORMAL_FORCE: usize = 0;
/// Indices of friction and slip speed in [`ContactForces`].
pub(super) const FRICTION: usize = 6;
pub(super) const SLIP_SPEED: usize = 10;
/// Index of the film thickness in [`ContactForces`].
pub(super) const FILM_THICKNESS: usize = 2;

/// Where forces on a body come from.
pub const FORCE_SOURCES: [&str; 7] =
    ["outer_raceway", "inner_raceway", "pocket", "guide", "gravity", "load", "support"];

pub(super) const OUTER: usize = 0;
pub(super) const INNER: usize = 1;
pub(super) const POCKET: usize = 2;
pub(super) const GUIDE: usize = 3;
const GRAVITY: usize = 4;
const LOAD: usize = 5;
const SUPPORT: usize = 6;

/// Forces on one body by source: (F_y in N, F_z in N, moment about its own geometric centre in N m).
pub type BodyForces = [[f64; 3]; FORCE_SOURCES.len()];

/// All forces at one state.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Forces {
    /// Per contact, in the order of [`Model::contact_names`].
    pub contacts: Vec<ContactForces>,
    /// Per body, in the order of [`Model::body_names`]. Inertia forces of the rotating frame are not included.
    pub bodies: Vec<BodyForces>,
    /// Acceleration of every velocity state, m/s^2 or rad/s^2.
    pub accelerations: Vec<f64>,
    /// The guide of the cage; all zero without one.
    pub guide: GuideReport,
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

impl Model {
    /// Writes the results of the last evaluation at (`q`, `v`) into `out`.
    pub(crate) fn report(&self, q: &[f64], v: &[f64], ws: &Workspace, a: &[f64], out: &mut Forces) {
        let per_element = self.contacts_per_element();
        out.contacts.clear();
        out.contacts.resize(per_element * self.elements.count, ContactForces::default());
        out.bodies.clear();
        out.bodies.resize(self.body_count(), BodyForces::default());
        out.accelerations.clear();
        out.accelerations.extend_from_slice(a);
        out.guide = GuideReport::default();
        for contact in ws.contacts() {
            let &Site { element, frame, mate } = contact.site;
            out.contacts[per_element * element + self.contact_place(&mate)] = quantities(&contact);
            match mate {
                Mate::Outer => self.report_raceway(OUTER, 0, &contact, ws, out),
                Mate::Inner => self.report_raceway(INNER, 1, &contact, ws, out),
                Mate::Pocket(pocket) => {
                    let site = &ws.elements[element];
                    let (on_element, on_cage) = pocket_wrenches(&frame, &contact.force, &pocket, site);
                    let on_element = Wrench { force: site.to_global(on_element.force), ..on_element };
                    add(&mut out.bodies[self.element_body(element)][POCKET], &on_element);
                    add(&mut out.bodies[CAGE_BODY][POCKET], &on_cage);
                }
            }
        }
        self.report_guide_and_external(q, v, ws, out);
    }

    fn report_raceway(
        &self,
        source: usize,
        mate: usize,
        contact: &Loaded<'_>,
        ws: &Workspace,
        out: &mut Forces,
    ) {
        let site = &ws.elements[contact.site.element];
        let [on_roller, on_mate] = contact
            .site
            .frame
            .wrenches(&contact.force)
            .map(|w| Wrench { force: site.to_global(w.force), moment: w.moment });
        add(&mut out.bodies[self.element_body(contact.site.element)][source], &on_roller);
        add(&mut out.bodies[mate][source], &on_mate);
    }

    fn report_guide_and_external(&self, q: &[f64], v: &[f64], ws: &Workspace, out: &mut Forces) {
        let weight = |mass: f64| [mass * self.gravity[0], mass * self.gravity[1], 0.0];
        if let (Some(cage), Some(c)) = (&self.cage, self.layout.cage) {
            if let (Some(force), Some(motion)) = (&ws.guide, &ws.journal) {
                let [on_cage, on_ring] = cage.guide_side.wrenches(force, motion);
                add(&mut out.bodies[CAGE_BODY][GUIDE], &on_cage);
                add(&mut out.bodies[usize::from(cage.guided_by_inner_ring)][GUIDE], &on_ring);
                let on_cage = cage.guide_side.on_cage(force, motion);
                out.guide.pressure = on_cage.pressure;
                out.guide.shear = on_cage.shear;
                out.guide.solid = on_cage.solid;
                out.guide.film_share = on_cage.film_share;
                out.guide.minimum_film = on_cage.minimum_film;
            }
            let [body, ring] = self.guide_bodies(q, v, &ws.inputs);
            out.guide.offset = std::array::from_fn(|k| body.position[k] - ring.position[k]);
            out.guide.velocity = std::array::from_fn(|k| body.velocity[k] - ring.velocity[k]);
            let [y, z, _] = weight(cage.mass);
            let [uy, uz] = cage.mass_offset(q[c + 2]).unwrap_or_default();
            out.bodies[CAGE_BODY][GRAVITY] = [y, z, uy * z - uz * y];
            if cage.loaded {
                let load = [Input::CageForceY, Input::CageForceZ, Input::CageTorque];
                out.bodies[CAGE_BODY][LOAD] = load.map(|input| ws.inputs.of(input));
            }
        }
        if let RingBody::Free { mass, damping } = self.ring {
            let (_, velocity) = self.ring_motion(q, v);
            out.bodies[1][GRAVITY] = weight(mass);
            out.bodies[1][LOAD] = [ws.inputs.of(Input::LoadY), ws.inputs.of(Input::LoadZ), 0.0];
            out.bodies[1][SUPPORT] = [-damping * velocity[0], -damping * velocity[1], 0.0];
        }
        if let ElementKind::Rollers(rollers) = &self.elements.kind {
            for j in 0..self.layout.count {
                out.bodies[self.element_body(j)][GRAVITY] = weight(rollers.mass);
            }
        }
    }

    /// Place of a contact with this mate among the contacts of its element.
    pub(super) fn contact_place(&self, mate: &Mate) -> usize {
        match mate {
            Mate::Outer => 0,
            Mate::Inner => 1,
            Mate::Pocket(site) => self.pocket_contact_offset() + usize::from(site.pillar == Pillar::Back),
        }
    }

    /// Number of bodies in a force report.
    pub fn body_count(&self) -> usize {
        2 + usize::from(self.cage.is_some()) + self.elements.count
    }

    /// Index of an element among the bodies of a force report.
    pub(super) fn element_body(&self, j: usize) -> usize {
        2 + usize::from(self.cage.is_some()) + j
    }
}

/// Index of the cage among the bodies, if there is one.
pub(super) const CAGE_BODY: usize = 2;

fn add(sum: &mut [f64; 3], w: &Wrench<f64>) {
    sum[0] += w.force[0];
    sum[1] += w.force[1];
    sum[2] += w.moment;
}

fn quantities(contact: &Loaded<'_>) -> ContactForces {
    let (f, m) = (contact.force, contact.motion);
    let [pressure_roller, pressure_mate] = contact.site.frame.film_pressure_forces(&f);
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
    ]
}
