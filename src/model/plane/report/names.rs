//! Names of bodies, states, inputs and contacts.

use crate::bodies::{Fault, ForceSource, Owner, State, states_of};
use crate::model::StateInfo;
use crate::model::faults::{Names, in_words};
use crate::model::plane::Plane;
use crate::pairs::{ContactLaw, Law, Site};

impl Plane {
    /// A fault in words.
    #[doc(hidden)]
    pub fn describe(&self, fault: Fault) -> String {
        let names = Names {
            element: self.element_kind(),
            states: &|| self.state_infos(),
            positions: self.layout.positions(),
            contacts: &|| self.contact_names(),
            giving: self.energy_giving_film(),
        };
        in_words(fault, &names)
    }

    /// Names of the bodies, in the order of force reports: outer ring, inner ring, cage, rollers.
    pub fn body_names(&self) -> Vec<String> {
        let kind = self.element_kind();
        let shared = self.shared.iter().flatten().map(|body| body.name().to_owned());
        shared.chain((0..self.element_count()).map(|j| format!("{kind}[{j}]"))).collect()
    }

    /// Number of bodies in a force report.
    pub fn body_count(&self) -> usize {
        self.shared.iter().flatten().count() + self.element_count()
    }

    /// Index of a shared body among the bodies of a force report.
    pub(super) fn report_place(&self, body: usize) -> usize {
        self.shared[..body].iter().flatten().count()
    }

    /// Index of an element among the bodies of a force report. Shared bodies come first, in their order.
    pub(super) fn element_body(&self, j: usize) -> usize {
        self.shared.iter().flatten().count() + j
    }

    /// Name of the body of a group of velocities: see [`crate::integrate::System::groups`].
    pub(crate) fn group_name(&self, group: usize) -> Option<String> {
        match self.layout.owner_of_group(group) {
            Owner::Element(j) => Some(format!("{}[{j}]", self.element_kind())),
            Owner::Shared(body) => self.shared[body].as_ref().map(|body| body.name().to_owned()),
            Owner::Node(node) => self.nodes.get(node).map(|node| node.name().to_owned()),
        }
    }

    /// What the elements are called in names.
    pub fn element_kind(&self) -> &'static str {
        self.elements.kind()
    }

    /// The state vector: positions, then velocities.
    pub fn state_infos(&self) -> Vec<StateInfo> {
        let states = states_of(&self.shared, &*self.elements);
        let named = states.map(|(state, body, coordinate)| {
            let [name, unit, description] = match (state, coordinate.position) {
                (State::Position, Some(position)) => position,
                _ => coordinate.rate,
            };
            StateInfo { name: format!("{body}.{name}"), unit, description }
        });
        let of_nodes = self.nodes.iter().flat_map(|node| {
            node.states().iter().map(|state| {
                let name = format!("{}.{}", node.name(), state.name);
                StateInfo { name, unit: state.unit, description: state.description }
            })
        });
        named.chain(of_nodes).collect()
    }

    /// Contacts per element in force reports.
    pub(super) fn contacts_per_element(&self) -> usize {
        self.infos.iter().map(|info| info.contacts.len()).sum()
    }

    /// Place of the first contact of a pair among those of an element.
    fn first_contact(&self, pair: usize) -> usize {
        self.infos[..pair].iter().map(|info| info.contacts.len()).sum()
    }

    /// Place of the first contact of the pair with this force source among those of an element.
    pub(super) fn first_contact_of(&self, source: ForceSource) -> Option<usize> {
        self.infos.iter().position(|info| info.source == source).map(|pair| self.first_contact(pair))
    }

    /// Law of the pair with this force source.
    pub(in crate::model::plane) fn law_of(&self, source: ForceSource) -> Option<&ContactLaw> {
        self.infos.iter().zip(&self.laws).find(|(info, _)| info.source == source).map(|(_, law)| law)
    }

    /// Place of a contact in [`Plane::contact_names`].
    pub(in crate::model::plane) fn contact_place(&self, site: &Site) -> usize {
        site.element * self.contacts_per_element() + self.first_contact(site.pair) + site.contact
    }

    /// Pair of every contact that an element can have, and its name.
    pub(super) fn contact_kinds(&self) -> impl Iterator<Item = (usize, &'static str)> + '_ {
        self.infos
            .iter()
            .enumerate()
            .flat_map(|(pair, info)| info.contacts.iter().map(move |name| (pair, *name)))
    }

    /// Names of all contacts that can exist, in the order of force reports.
    pub fn contact_names(&self) -> Vec<String> {
        let element = self.element_kind();
        (0..self.element_count())
            .flat_map(|j| self.contact_kinds().map(move |(_, kind)| format!("{element}[{j}].{kind}")))
            .collect()
    }

    /// The laws that this scene uses, each with the largest number of contacts it can act in.
    pub fn laws_in_use(&self) -> Vec<(&'static str, usize)> {
        let mut most = [0; Law::ALL.len()];
        for (info, parts) in self.infos.iter().zip(&self.parts) {
            for law in info.laws.iter().flatten().chain(parts) {
                most[*law as usize] += self.element_count() * info.contacts.len();
            }
        }
        for law in self.between_infos.iter().flat_map(|info| info.laws).flatten() {
            most[law as usize] += 1;
        }
        most[Law::ViscosityTemperature as usize] += usize::from(self.inputs.oil.is_some());
        Law::ALL.iter().map(|law| (law.name(), most[*law as usize])).filter(|(_, n)| *n > 0).collect()
    }
}
