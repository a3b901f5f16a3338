//! What a breakage does to the elements: the bonds that break lose theirs, and imaginary elements that they support change.

use ligament_model::BondSystem;
use ligament_model::element::{BondDeformation, BondElement};

use crate::boundary::ThermalStrain;
use crate::state::BondsLeft;

/// An element that a breakage changed.
#[derive(Debug, Clone, PartialEq)]
pub struct ChangedElement {
    /// Ends of its bond.
    pub ends: [u32; 2],
    /// The element before, with its deformation in the state before.
    pub before: (BondElement, BondDeformation),
    /// The element after, with its deformation in the same state; none if the bond itself broke.
    pub after: Option<(BondElement, BondDeformation)>,
}

/// The elements that change when some of the bonds that are `left` break, with their deformations for displacements (3 n_points):
/// those of the bonds, in their order, and then those of bonds that they support, ascending.
pub fn changed_elements(
    system: &BondSystem,
    expansion: ThermalStrain<'_>,
    left: BondsLeft<'_>,
    displacement: &[f64],
    bonds: &[u32],
) -> Vec<ChangedElement> {
    let deformed = |bond: usize, element: BondElement| {
        (
            element,
            deformation(&element, system.bonds.ends[bond], displacement, expansion),
        )
    };
    let of_bond = |&bond: &u32| {
        let bond = bond as usize;
        let element = left.element(system, bond)?;
        Some(ChangedElement {
            ends: system.bonds.ends[bond],
            before: deformed(bond, element),
            after: None,
        })
    };
    let mut changed: Vec<ChangedElement> = bonds.iter().filter_map(of_bond).collect();
    let supported = supported_bonds(system, bonds);
    if supported.is_empty() {
        return changed;
    }
    let mut intact = left.intact.to_vec();
    for &bond in bonds {
        intact[bond as usize] = false;
    }
    let of_supported = supported.iter().filter_map(|&bond| {
        let bond = bond as usize;
        if !intact[bond] {
            return None;
        }
        let [before, after] =
            [left.intact, &intact].map(|intact| BondElement::of(system, intact, bond));
        (before != after).then(|| ChangedElement {
            ends: system.bonds.ends[bond],
            before: deformed(bond, before),
            after: Some(deformed(bond, after)),
        })
    });
    changed.extend(of_supported);
    changed
}

/// The bonds whose elements lean on some of `bonds`, ascending.
fn supported_bonds(system: &BondSystem, bonds: &[u32]) -> Vec<u32> {
    let Some(elements) = &system.imaginary else {
        return Vec::new();
    };
    let of_bonds = bonds
        .iter()
        .flat_map(|&bond| elements.surroundings.dependents(bond));
    let mut supported: Vec<u32> = of_bonds.copied().collect();
    supported.sort_unstable();
    supported.dedup();
    supported
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

impl ChangedElement {
    /// Energy that the change released at a fixed load, with the displacements after it (3 n_points), J: 1/2 u^T (K_before - K_after) u'.
    pub fn released(&self, displacement: &[f64], expansion: ThermalStrain<'_>) -> f64 {
        let mutual = |(element, before): &(BondElement, BondDeformation)| {
            let now = deformation(element, self.ends, displacement, expansion);
            element.mutual_energy(before, &now)
        };
        mutual(&self.before) - self.after.as_ref().map_or(0.0, mutual)
    }
}
