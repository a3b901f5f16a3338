//! What bonds that break together take away: made once, and handed to the energy, the parts of the body and the factor.

use ligament_model::Bonds;
use ligament_model::change::ChangedElements;
use ligament_model::element::Term;
use ligament_model::subdomain::Subdomain;
use ligament_model::thermal::ThermalStrain;

use crate::connectivity::AddedSupport;
use crate::state::State;

/// Bonds that break together, and what that changes.
#[derive(Debug, Default)]
pub struct Breakage {
    /// Bonds that break, in their order, by their numbers among all bonds of the body.
    pub bonds: Vec<u32>,
    /// Rigid motions of parts that came loose, which are held from now on.
    pub holds: Vec<AddedSupport>,
    /// Elements that change: those of the bonds, in their order, and then those that lean on them, ascending.
    elements: Option<Box<dyn ChangedElements>>,
    /// Elements of the owned bonds, where the body is divided between processes.
    owned: Option<(Subdomain, Box<dyn ChangedElements>)>,
}

impl Breakage {
    /// The breakage of bonds of a state that are known here, and which it still has; nothing is held yet.
    pub fn new(
        system: &dyn Bonds,
        expansion: ThermalStrain<'_>,
        state: &State,
        bonds: &[u32],
    ) -> Self {
        let (left, displacement) = (state.bonds(), &state.displacement);
        let subdomain = system.subdomain();
        Self {
            bonds: bonds.to_vec(),
            holds: Vec::new(),
            owned: (!subdomain.is_whole()).then(|| {
                let ends = system.ends();
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

    /// Terms of the stiffness that the elements have afterwards.
    pub fn gained_terms(&self) -> impl Iterator<Item = Term> + '_ {
        self.elements.iter().flat_map(|it| it.gained_terms())
    }

    /// Terms of the stiffness that the elements had before.
    pub fn lost_terms(&self) -> impl Iterator<Item = Term> + '_ {
        self.elements.iter().flat_map(|it| it.lost_terms())
    }

    /// Force that nothing balances any more, for displacements (n_degrees_of_freedom): what the elements exerted on their
    /// points, less what they exert now; parts of it with their degrees of freedom.
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

    /// Energy released at a fixed load, with the displacements after it (n_degrees_of_freedom), J:
    /// 1/2 u^T (K_before - K_after) u'.
    pub fn released(&self, displacement: &[f64], expansion: ThermalStrain<'_>) -> f64 {
        if let Some((subdomain, owned)) = &self.owned {
            return subdomain.sum(owned.released(displacement, expansion));
        }
        self.elements
            .as_ref()
            .map_or(0.0, |it| it.released(displacement, expansion))
    }
}
