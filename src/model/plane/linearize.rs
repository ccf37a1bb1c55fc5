//! Exact derivatives of the accelerations with respect to positions and velocities, by dual numbers through the same
//! kinematics and laws that give the forces.
//!
//! Contacts are differentiated in lanes: their laws over what these see (approach, approach speed, surface speeds, share of
//! edge friction), their kinematics over the motion of the element that its mate sees, by their pair; both are chained with the
//! coordinates of the bodies by the same rows for all (`pairs/contacts/relative`). The sums keep the structure of the bearing: shared bodies are coupled to every element, elements
//! to nothing else.

use super::workspace::Workspace;
use super::{Input, InputValues, Plane};
use crate::bodies::{ElementSlopes, OF_ELEMENT, OnBody};
use crate::integrate::{Linearization, Structure};
use crate::pairs::SlopeSums;
use crate::scalar::place_of;
use crate::space::Wrench;

impl Plane {
    /// Which velocities are coupled: shared bodies and nodes are the hub, elements the spokes.
    #[doc(hidden)]
    pub fn structure(&self) -> Structure<OF_ELEMENT> {
        self.layout.structure()
    }

    /// Derivatives of the accelerations at the last evaluated state of `ws`, while the inputs change at `rates` (see
    /// [`Plane::input_rates_at`]).
    ///
    /// # Panics
    /// When `ws` or `out` was made for another model.
    #[doc(hidden)]
    pub fn linearize(&self, ws: &mut Workspace, rates: &InputValues, out: &mut Linearization<OF_ELEMENT>) {
        out.clear();
        for batch in &mut ws.contacts.batches {
            batch.differentiate(ws.fluid.ln_viscosity, ws.motions.instructions);
        }
        let mut sums = SlopeSums {
            layout: &self.layout,
            bodies: &self.shared,
            rates,
            ln_viscosity_rate: self.ln_viscosity_rate(ws, rates),
            ln_structure_ratio: self.ln_structure_ratio(ws),
            out: &mut *out,
        };
        for (place, pair) in self.pairs.iter().enumerate() {
            let (batch, contacts) = ws.contacts.range(place);
            pair.add_slopes(batch, contacts, &ws.motions, &mut sums, &mut ws.relative_slopes);
        }
        for (pair, force) in self.between.iter().zip(&mut ws.between) {
            pair.add_slopes(&ws.motions, ws.fluid, force, &mut sums);
        }
        self.divide_by_inertias(ws, rates, out);
        self.add_node_slopes(ws, out);
    }

    /// Rate of the logarithm of the viscosity, 1/s.
    fn ln_viscosity_rate(&self, ws: &Workspace, rates: &InputValues) -> f64 {
        let warming = rates.of(Input::Temperature);
        match &self.inputs.oil {
            Some(oil) if warming != 0.0 => oil.law.relative_slope(ws.inputs.of(Input::Temperature)) * warming,
            _ => 0.0,
        }
    }

    /// Change of the logarithm of a soap's structure over that of the viscosity.
    fn ln_structure_ratio(&self, ws: &Workspace) -> f64 {
        let Some(oil) = &self.inputs.oil else { return 0.0 };
        let of_viscosity = oil.law.relative_slope(ws.inputs.of(Input::Temperature));
        oil.thickener.map_or(0.0, |law| law.ln_structure_slope() / of_viscosity)
    }

    /// From forces to accelerations, with the terms that are no contact forces.
    fn divide_by_inertias(
        &self,
        ws: &mut Workspace,
        rates: &InputValues,
        out: &mut Linearization<OF_ELEMENT>,
    ) {
        let Linearization { over_positions, over_velocities, over_time } = out;
        let (inverse, width) = (&mut ws.inverse_inertia, self.layout.hub());
        let of_shared = self.layout.of_shared();
        inverse.clear();
        for (_, body, at) in self.free_bodies() {
            // External loads change by themselves.
            for (sum, rate) in over_time[at.clone()].iter_mut().zip(body.load_rates(&ws.inputs, rates)) {
                *sum += rate;
            }
            body.add_damping(&mut |[i, k], damping| {
                over_velocities.hub[(at.start + i, at.start + k)] -= damping;
            });
            inverse.add(body, at.clone(), &ws.of_shared[0][at]);
        }
        inverse.multiply(&mut over_time[..of_shared], of_shared);
        for part in [&mut *over_positions, &mut *over_velocities] {
            let [hub, _, to_hub, ..] = part.blocks_mut();
            inverse.multiply(hub, width);
            inverse.multiply(to_hub, width);
        }
        for (place, body, at) in self.free_bodies() {
            let [k, d] = [&mut *over_positions, &mut *over_velocities]
                .map(|part| part.hub.view_mut((at.start, at.start), (at.len(), at.len())));
            let on_body = OnBody { wrench: &ws.on_shared[place], coordinates: ws.on_coordinates(place) };
            body.add_inertial_slopes(&on_body, &ws.body(place, at), k, d);
        }
        let mut of_elements = [over_positions, over_velocities].map(|part| {
            let [_, own, _, over_hub, rim] = part.blocks_mut();
            [own, over_hub, rim].map(|block| block.as_chunks_mut().0)
        });
        for j in 0..self.layout.count {
            let (block, lane) = place_of(j);
            let [radial, across, moment] = &ws.on_elements[block];
            let on_element = Wrench { force: [radial[lane], across[lane]], moment: moment[lane] };
            let element = ws.motions.element(j);
            let [k, d] = of_elements.each_mut().map(|[own, over_hub, rim]| ElementSlopes {
                own: of_element(own, j, OF_ELEMENT),
                over_hub: of_element(over_hub, j, width),
                over_neighbours: of_element(rim, j, 2 * OF_ELEMENT),
            });
            let inverse = self.elements.slopes(&element, &on_element, self.gravity, k, d);
            for (place, factor) in self.layout.of_element::<OF_ELEMENT>(j).into_iter().zip(inverse) {
                over_time[place] *= factor;
            }
        }
    }
}

/// The `n` columns of element `j` among these; none where there are none.
#[inline]
fn of_element(columns: &mut [[f64; OF_ELEMENT]], j: usize, n: usize) -> &mut [[f64; OF_ELEMENT]] {
    columns.get_mut(j * n..(j + 1) * n).unwrap_or_default()
}
