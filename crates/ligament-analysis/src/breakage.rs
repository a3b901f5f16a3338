//! Changes by bonds that break together, computed once for the energy, the connectivity and the factor.

use ligament_model::Bonds;
use ligament_model::change::ChangedElements;
use ligament_model::element::Term;
use ligament_model::subdomain::Subdomain;
use ligament_model::thermal::ThermalStrain;

use crate::connectivity::AddedSupport;
use crate::state::State;

/// Bonds that break together, and the resulting changes.
#[derive(Debug, Default)]
pub struct Breakage {
    /// Global numbers of the breaking bonds, in order.
    pub bonds: Vec<u32>,
    /// Supports added for rigid motions of detached parts.
    pub holds: Vec<AddedSupport>,
    /// Elements that change: the elements of the bonds, in order, and then elements that depend on them, ascending.
    elements: Option<Box<dyn ChangedElements>>,
    /// Elements of the owned bonds, on a divided body.
    owned: Option<(Subdomain, Box<dyn ChangedElements>)>,
}

impl Breakage {
    /// Breakage of local bonds that are still in the state, without added supports.
    pub fn new(
        system: &dyn Bonds,
        expansion: ThermalStrain<'_>,
        state: &State,
        bonds: &[u32],
    ) -> Self {
        let (left, displacement) = (state.bonds(), &state.displacement);
        let subdomain = &system.subdomain;
        Self {
            bonds: bonds.to_vec(),
            holds: Vec::new(),
            owned: (!subdomain.is_whole()).then(|| {
                let ends = &system.ends;
                let owned = bonds.iter().copied();
                let owned = owned.filter(|&bond| subdomain.owns_bond(ends[bond as usize]));
                let owned: Vec<u32> = owned.collect();
                let elements = system.changed(left, displacement, expansion, &owned);
                (subdomain.clone(), elements)
            }),
            elements: Some(system.changed(left, displacement, expansion, bonds)),
        }
    }

    /// Number of elements that change.
    pub fn n_elements(&self) -> usize {
        self.elements.as_ref().map_or(0, |it| it.n_elements())
    }

    /// Stiffness terms of the elements after the breakage.
    pub fn gained_terms(&self) -> impl Iterator<Item = Term> + '_ {
        self.elements.iter().flat_map(|it| it.gained_terms())
    }

    /// Stiffness terms of the elements before the breakage.
    pub fn lost_terms(&self) -> impl Iterator<Item = Term> + '_ {
        self.elements.iter().flat_map(|it| it.lost_terms())
    }

    /// Residual force due to the breakage at displacements (n_degrees_of_freedom), N and N m: forces of the elements on their
    /// points before the breakage minus their forces after it, as terms with their degrees of freedom.
    pub fn unbalanced_force(
        &self,
        displacement: &[f64],
        expansion: ThermalStrain<'_>,
    ) -> Vec<(usize, f64)> {
        match &self.elements {
            None => Vec::new(),
            Some(elements) => elements.unbalanced_force(displacement, expansion),
        }
    }

    /// Energy released at fixed load, with the displacements after the breakage (n_degrees_of_freedom), J: 1/2 u^T (K_before -
    /// K_after) u'.
    pub fn released(&self, displacement: &[f64], expansion: ThermalStrain<'_>) -> f64 {
        if let Some((subdomain, owned)) = &self.owned {
            return subdomain.sum(owned.released(displacement, expansion));
        }
        self.elements
            .as_ref()
            .map_or(0.0, |it| it.released(displacement, expansion))
    }
}
