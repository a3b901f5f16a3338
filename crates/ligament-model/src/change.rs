//! Elements that a breakage changes.
//!
//! Breaking bonds lose their elements, and elements supported by these bonds change.

use crate::deformation::Deformation;
use crate::element::{Element, Term};
use crate::system::{ElementSystem, UnbrokenBonds};
use crate::thermal::ThermalStrain;
use crate::volumetric::ChangedPatch;

/// Terms of the stiffness of a bond in the plane.
const TERMS_OF_BOND: usize = 3;

/// Elements that change when some bonds break together.
pub trait ChangedElements: std::fmt::Debug {
    /// Number of changed elements.
    fn n_elements(&self) -> usize;

    /// Terms of the stiffness of the elements before the breakage.
    fn lost_terms(&self) -> Vec<Term>;

    /// Terms of the stiffness of the elements after the breakage.
    fn gained_terms(&self) -> Vec<Term>;

    /// Unbalanced force after the breakage at displacements (n_degrees_of_freedom), N and N m: forces of the elements on their points
    /// before, less those after; contributions with their degrees of freedom.
    fn unbalanced_force(
        &self,
        displacement: &[f64],
        expansion: ThermalStrain<'_>,
    ) -> Vec<(usize, f64)>;

    /// Energy 1/2 u^T (K_before - K_after) u' released at a fixed load, with the displacements u' after it (n_degrees_of_freedom), J.
    fn released(&self, displacement: &[f64], expansion: ThermalStrain<'_>) -> f64;
}

/// An element that a breakage changes.
#[derive(Debug, Clone, PartialEq)]
struct ChangedElement<const D: usize, const M: usize, E: Element<D, M>> {
    /// Ends of the bond.
    ends: [u32; 2],
    /// Element before the breakage, with its deformation then.
    before: (E, E::Deformation),
    /// Element after the breakage, with its deformation; `None` if its own bond breaks.
    after: Option<(E, E::Deformation)>,
}

/// Elements of bonds and patches of cells that a breakage changes.
#[derive(Debug)]
struct Changed<const D: usize, const M: usize, E: Element<D, M>> {
    elements: Vec<ChangedElement<D, M, E>>,
    patches: Vec<ChangedPatch>,
}

impl<const D: usize, const M: usize, E: Element<D, M>> ElementSystem<D, M, E> {
    /// Elements that change when some of the unbroken bonds `left` break, at displacements (n_degrees_of_freedom).
    pub(crate) fn changed(
        &self,
        left: UnbrokenBonds<'_>,
        displacement: &[f64],
        expansion: ThermalStrain<'_>,
        bonds: &[u32],
    ) -> Box<dyn ChangedElements> {
        let ends = &self.system.bonds.ends;
        let deformed = |bond: usize, element: E| {
            let deformation = deformation(&element, ends[bond], displacement, expansion);
            (element, deformation)
        };
        let broken = bonds.iter().filter_map(|&bond| {
            let bond = bond as usize;
            Some(ChangedElement {
                ends: ends[bond],
                before: deformed(bond, self.remaining_element(left, bond)?),
                after: None,
            })
        });
        let mut elements: Vec<ChangedElement<D, M, E>> = broken.collect();
        let dependent_bonds = E::dependent_bonds(&self.lattice, bonds);
        if !dependent_bonds.is_empty() {
            let mut intact = left.intact.to_vec();
            for &bond in bonds {
                intact[bond as usize] = false;
            }
            elements.extend(dependent_bonds.into_iter().filter_map(|bond| {
                let bond = bond as usize;
                let [before, after] =
                    [left.intact, &intact].map(|intact| self.whole_element(intact, bond));
                (intact[bond] && before != after).then(|| ChangedElement {
                    ends: ends[bond],
                    before: deformed(bond, before),
                    after: Some(deformed(bond, after)),
                })
            }));
        }
        let patches = self.system.volumetric.as_ref().map(|terms| {
            let mut intact = left.intact.to_vec();
            for &bond in bonds {
                intact[bond as usize] = false;
            }
            let after = UnbrokenBonds {
                intact: &intact,
                ..left
            };
            let bonds = bonds.iter().copied();
            terms.changed::<M>([left, after], bonds, displacement, expansion)
        });
        Box::new(Changed {
            elements,
            patches: patches.unwrap_or_default(),
        })
    }
}

impl<const D: usize, const M: usize, E: Element<D, M>> ChangedElements for Changed<D, M, E> {
    /// Patches count by their terms: three terms are one element.
    fn n_elements(&self) -> usize {
        let n_terms: usize = self.patches.iter().map(ChangedPatch::n_terms).sum();
        self.elements.len() + n_terms.div_ceil(TERMS_OF_BOND)
    }

    fn lost_terms(&self) -> Vec<Term> {
        let of_bonds = self.elements.iter().flat_map(|it| it.before.0.terms());
        let of_cells = self.patches.iter().filter_map(ChangedPatch::lost_term);
        of_bonds.chain(of_cells).collect()
    }

    fn gained_terms(&self) -> Vec<Term> {
        let after = self.elements.iter().filter_map(|it| it.after.as_ref());
        let of_bonds = after.flat_map(|(element, _)| element.terms());
        let of_cells = self.patches.iter().filter_map(ChangedPatch::gained_term);
        of_bonds.chain(of_cells).collect()
    }

    fn unbalanced_force(
        &self,
        displacement: &[f64],
        expansion: ThermalStrain<'_>,
    ) -> Vec<(usize, f64)> {
        let mut parts = Vec::new();
        let mut add = |ends: [u32; 2], element: &E, sign: f64| {
            let deformation = deformation(element, ends, displacement, expansion);
            element.forces(&deformation, |point, values| {
                let first = M * point as usize;
                parts.extend((first..).zip(values.map(|value| sign * value)));
            });
        };
        for it in &self.elements {
            add(it.ends, &it.before.0, 1.0);
            if let Some((after, _)) = &it.after {
                add(it.ends, after, -1.0);
            }
        }
        for it in &self.patches {
            it.add_unbalanced(displacement, expansion, &mut parts);
        }
        parts
    }

    fn released(&self, displacement: &[f64], expansion: ThermalStrain<'_>) -> f64 {
        let of_element = |it: &ChangedElement<D, M, E>| {
            let mutual = |(element, before): &(E, E::Deformation)| {
                let now = deformation(element, it.ends, displacement, expansion);
                element.mutual_energy(before, &now)
            };
            mutual(&it.before) - it.after.as_ref().map_or(0.0, mutual)
        };
        let of_cells = self.patches.iter();
        let of_cells = of_cells.map(|it| it.released(displacement, expansion));
        self.elements.iter().map(of_element).sum::<f64>() + of_cells.sum::<f64>()
    }
}

/// Deformation of an element less its thermal deformation.
fn deformation<const D: usize, const M: usize, E: Element<D, M>>(
    element: &E,
    ends: [u32; 2],
    displacement: &[f64],
    expansion: ThermalStrain<'_>,
) -> E::Deformation {
    let total = element.deformation(displacement);
    if expansion.is_none() {
        total
    } else {
        total.less(&element.deformation_in(&expansion.of_bond(ends)))
    }
}
