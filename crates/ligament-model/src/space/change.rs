//! The bonds in space that a breakage takes away.

use super::element::SolidKinematics;
use super::system::Typed;
use crate::change::ChangedElements;
use crate::deformation::SpaceDeformation;
use crate::element::Term;
use crate::system::BondsLeft;
use crate::thermal::ThermalStrain;

/// A bond that breaks.
#[derive(Debug, Clone, PartialEq)]
struct BrokenBond<B, const M: usize> {
    ends: [u32; 2],
    element: B,
    /// Deformation when the bond breaks.
    deformation: SpaceDeformation,
}

impl<const M: usize, B: SolidKinematics<M>> Typed<'_, B, M> {
    /// The bonds that are lost when some of those that are `left` break, at displacements (n_degrees_of_freedom).
    pub(super) fn changed(
        self,
        left: BondsLeft<'_>,
        displacement: &[f64],
        expansion: ThermalStrain<'_>,
        bonds: &[u32],
    ) -> Box<dyn ChangedElements> {
        let broken = bonds.iter().filter_map(|&bond| {
            let element = self.left(left, bond as usize)?;
            let ends = self.system.bonds.ends[bond as usize];
            Some(BrokenBond {
                ends,
                element,
                deformation: deformation(&element, ends, displacement, expansion),
            })
        });
        Box::new(broken.collect::<Vec<BrokenBond<B, M>>>())
    }
}

impl<const M: usize, B: SolidKinematics<M>> ChangedElements for Vec<BrokenBond<B, M>> {
    fn n_elements(&self) -> usize {
        self.len()
    }

    fn lost_terms(&self) -> Vec<Term> {
        let of_bond = |it: &BrokenBond<B, M>| terms(&it.element, it.ends);
        self.iter().flat_map(of_bond).collect()
    }

    fn gained_terms(&self) -> Vec<Term> {
        Vec::new()
    }

    fn unbalanced_force(
        &self,
        displacement: &[f64],
        expansion: ThermalStrain<'_>,
    ) -> Vec<(usize, f64)> {
        let mut parts = Vec::new();
        for it in self {
            let deformation = deformation(&it.element, it.ends, displacement, expansion);
            for (end, values) in it.ends.into_iter().zip(it.element.end_forces(&deformation)) {
                parts.extend((M * end as usize..).zip(values));
            }
        }
        parts
    }

    fn released(&self, displacement: &[f64], expansion: ThermalStrain<'_>) -> f64 {
        let of_bond = |it: &BrokenBond<B, M>| {
            let now = deformation(&it.element, it.ends, displacement, expansion);
            it.element.mutual_energy(&it.deformation, &now)
        };
        self.iter().map(of_bond).sum()
    }
}

/// K of a bond as a sum of terms.
pub(super) fn terms<const M: usize, B: SolidKinematics<M>>(
    element: &B,
    ends: [u32; 2],
) -> Vec<Term> {
    let [a, b] = ends.map(|end| M * end as usize);
    let term = |(rigidity, [at_a, at_b]): (f64, [[f64; M]; 2])| {
        let entries = (a..).zip(at_a).chain((b..).zip(at_b));
        (
            rigidity,
            entries.filter(|(_, value)| *value != 0.0).collect(),
        )
    };
    element.modes().into_iter().map(term).collect()
}

/// Deformation of a bond without what its temperature gives it.
fn deformation<const M: usize, B: SolidKinematics<M>>(
    element: &B,
    ends: [u32; 2],
    displacement: &[f64],
    expansion: ThermalStrain<'_>,
) -> SpaceDeformation {
    let [a, b] = ends.map(|end| M * end as usize);
    let total = element.deformation(&displacement[a..a + M], &displacement[b..b + M]);
    if expansion.is_none() {
        total
    } else {
        total.less(&element.deformation_in(expansion.of_bond_in_space(ends)))
    }
}
