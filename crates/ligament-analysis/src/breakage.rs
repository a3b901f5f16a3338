//! What bonds that break together take away: made once, and handed to the energy, the parts of the body and the factor.
//!
//! The bonds that break lose their elements, and elements that lean on them change.

use ligament_model::BondSystem;
use ligament_model::element::{BondDeformation, BondElement, Term};

use crate::connectivity::Hold;
use crate::state::State;
use crate::thermal_strain::ThermalStrain;
use crate::unknowns::COMPONENTS;

/// Bonds that break together, and what that changes.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Breakage {
    /// Bonds that break, in their order.
    pub bonds: Vec<u32>,
    /// Rigid motions of parts that came loose, which are held from now on.
    pub holds: Vec<Hold>,
    /// Elements that change: those of the bonds, in their order, and then those that lean on them, ascending.
    elements: Vec<ChangedElement>,
}

/// An element that a breakage changes.
#[derive(Debug, Clone, PartialEq)]
struct ChangedElement {
    /// Ends of its bond.
    ends: [u32; 2],
    /// The element before, with its deformation when the bonds break.
    before: (BondElement, BondDeformation),
    /// The element after, with its deformation then; none if its bond itself breaks.
    after: Option<(BondElement, BondDeformation)>,
}

impl Breakage {
    /// The breakage of bonds of a state, which still has them; nothing is held yet.
    pub fn new(
        system: &BondSystem,
        expansion: ThermalStrain<'_>,
        state: &State,
        bonds: &[u32],
    ) -> Self {
        let left = state.bonds();
        let deformed = |bond: usize, element: BondElement| {
            let ends = system.bonds.ends[bond];
            let deformation = deformation(&element, ends, &state.displacement, expansion);
            (element, deformation)
        };
        let broken = bonds.iter().filter_map(|&bond| {
            let bond = bond as usize;
            Some(ChangedElement {
                ends: system.bonds.ends[bond],
                before: deformed(bond, left.element(system, bond)?),
                after: None,
            })
        });
        let mut elements: Vec<ChangedElement> = broken.collect();
        let leaning = leaning_bonds(system, bonds);
        if !leaning.is_empty() {
            let mut intact = left.intact.to_vec();
            for &bond in bonds {
                intact[bond as usize] = false;
            }
            elements.extend(leaning.into_iter().filter_map(|bond| {
                let bond = bond as usize;
                let [before, after] =
                    [left.intact, &intact].map(|intact| BondElement::of(system, intact, bond));
                (intact[bond] && before != after).then(|| ChangedElement {
                    ends: system.bonds.ends[bond],
                    before: deformed(bond, before),
                    after: Some(deformed(bond, after)),
                })
            }));
        }
        Self {
            bonds: bonds.to_vec(),
            holds: Vec::new(),
            elements,
        }
    }

    /// Number of elements that change.
    pub fn n_elements(&self) -> usize {
        self.elements.len()
    }

    /// Terms of the stiffness that the elements have afterwards.
    pub fn gained_terms(&self) -> impl Iterator<Item = Term> + '_ {
        let after = self.elements.iter().filter_map(|it| it.after.as_ref());
        after.flat_map(|(element, _)| element.terms())
    }

    /// Terms of the stiffness that the elements had before.
    pub fn lost_terms(&self) -> impl Iterator<Item = Term> + '_ {
        self.elements.iter().flat_map(|it| it.before.0.terms())
    }

    /// Force that nothing balances any more, for displacements (n_degrees_of_freedom): what the elements exerted on their
    /// points, less what they exert now; added by degree of freedom.
    pub fn unbalanced_force(
        &self,
        displacement: &[f64],
        expansion: ThermalStrain<'_>,
        mut add: impl FnMut(usize, f64),
    ) {
        let mut add_of = |ends: [u32; 2], element: &BondElement, sign: f64| {
            let deformation = deformation(element, ends, displacement, expansion);
            element.forces(&deformation, |point, values| {
                for (component, value) in values.into_iter().enumerate() {
                    add(COMPONENTS * point as usize + component, sign * value);
                }
            });
        };
        for it in &self.elements {
            add_of(it.ends, &it.before.0, 1.0);
            if let Some((after, _)) = &it.after {
                add_of(it.ends, after, -1.0);
            }
        }
    }

    /// Energy released at a fixed load, with the displacements after it (n_degrees_of_freedom), J:
    /// 1/2 u^T (K_before - K_after) u'.
    pub fn released(&self, displacement: &[f64], expansion: ThermalStrain<'_>) -> f64 {
        let of_element = |it: &ChangedElement| {
            let mutual = |(element, before): &(BondElement, BondDeformation)| {
                let now = deformation(element, it.ends, displacement, expansion);
                element.mutual_energy(before, &now)
            };
            mutual(&it.before) - it.after.as_ref().map_or(0.0, mutual)
        };
        self.elements.iter().map(of_element).sum()
    }
}

/// The bonds whose elements lean on some of `bonds`, ascending.
fn leaning_bonds(system: &BondSystem, bonds: &[u32]) -> Vec<u32> {
    let Some(elements) = &system.imaginary else {
        return Vec::new();
    };
    let of_bonds = bonds
        .iter()
        .flat_map(|&bond| elements.surroundings.dependents(bond));
    let mut leaning: Vec<u32> = of_bonds.copied().collect();
    leaning.sort_unstable();
    leaning.dedup();
    leaning
}

/// Deformation of an element without what its temperature gives it.
fn deformation(
    element: &BondElement,
    ends: [u32; 2],
    displacement: &[f64],
    expansion: ThermalStrain<'_>,
) -> BondDeformation {
    let total = element.deformation(displacement);
    if expansion.is_none() {
        total
    } else {
        total.less(&element.deformation_in(expansion.of_bond(ends)))
    }
}
