//! Patches that change when bonds break or soften.

use super::patches::VolumetricTerms;
use crate::element::Term;
use crate::thermal::ThermalStrain;
use crate::topology::UnbrokenBonds;

/// Dilatation of a patch as an element: its stiffness kappa w t t^T.
#[derive(Debug, Clone, PartialEq)]
struct PatchElement {
    /// kappa w, J.
    rigidity: f64,
    /// Row t of the dilatation by degree of freedom.
    row: Vec<(usize, f64)>,
    /// Weights of the thermal strains of the points in the dilatation.
    thermal: Vec<(u32, f64)>,
    /// Number of axes of the body.
    n_axes: usize,
    /// Dilatation at the time of the change.
    before: f64,
}

/// A patch before and after a change; `None` without a living cell.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct ChangedPatch {
    before: Option<PatchElement>,
    after: Option<PatchElement>,
}

impl PatchElement {
    /// Dilatation less the thermal dilatation.
    fn dilatation(&self, displacement: &[f64], expansion: ThermalStrain<'_>) -> f64 {
        let moved: f64 = (self.row.iter())
            .map(|(dof, value)| value * displacement[*dof])
            .sum();
        if expansion.is_none() {
            return moved;
        }
        let by_temperature = self.thermal.iter().map(|(point, weight)| {
            let strain = expansion.of_point(*point as usize);
            let trace = (0..self.n_axes).map(|axis| strain.at(axis, axis));
            weight * trace.sum::<f64>()
        });
        moved - by_temperature.sum::<f64>()
    }

    fn term(&self) -> Term {
        (self.rigidity, self.row.clone())
    }

    /// Energy 1/2 u^T K u', J, of the motion at the change and another one.
    fn mutual_energy(&self, displacement: &[f64], expansion: ThermalStrain<'_>) -> f64 {
        0.5 * self.rigidity * self.before * self.dilatation(displacement, expansion)
    }
}

impl ChangedPatch {
    /// Term of the stiffness before the change.
    pub(crate) fn lost_term(&self) -> Option<Term> {
        self.before.as_ref().map(PatchElement::term)
    }

    /// Term of the stiffness after the change.
    pub(crate) fn gained_term(&self) -> Option<Term> {
        self.after.as_ref().map(PatchElement::term)
    }

    /// Number of terms before and after the change.
    pub(crate) fn n_terms(&self) -> usize {
        usize::from(self.before.is_some()) + usize::from(self.after.is_some())
    }

    /// Adds the forces before the change less those after it, by degree of freedom.
    pub(crate) fn add_unbalanced(
        &self,
        displacement: &[f64],
        expansion: ThermalStrain<'_>,
        forces: &mut Vec<(usize, f64)>,
    ) {
        for (element, sign) in [(&self.before, 1.0), (&self.after, -1.0)] {
            let Some(element) = element else { continue };
            let force = sign * element.rigidity * element.dilatation(displacement, expansion);
            let entries = element.row.iter();
            forces.extend(entries.map(|(dof, value)| (*dof, force * value)));
        }
    }

    /// Energy 1/2 u^T (K_before - K_after) u', J, with the displacements u' after the change.
    pub(crate) fn released(&self, displacement: &[f64], expansion: ThermalStrain<'_>) -> f64 {
        let energy = |element: &Option<PatchElement>| {
            let element = element.as_ref();
            element.map_or(0.0, |it| it.mutual_energy(displacement, expansion))
        };
        energy(&self.before) - energy(&self.after)
    }
}

impl<const D: usize> VolumetricTerms<D> {
    /// Patches that change with some bonds, from their stiffness before and after, at displacements of M components a point.
    pub(crate) fn changed<const M: usize>(
        &self,
        [before, after]: [UnbrokenBonds<'_>; 2],
        bonds: impl Iterator<Item = u32>,
        displacement: &[f64],
        expansion: ThermalStrain<'_>,
    ) -> Vec<ChangedPatch> {
        let mut cells = self.cells_along(bonds);
        cells.retain(|&cell| self.share(before, cell) != self.share(after, cell));
        let element = |patch: u32, bonds: UnbrokenBonds<'_>| {
            let mut found = self.element::<M>(patch, bonds)?;
            found.before = found.dilatation(displacement, expansion);
            Some(found)
        };
        let patches = self.patches_of(&cells).into_iter();
        let changed = patches.map(|patch| ChangedPatch {
            before: element(patch, before),
            after: element(patch, after),
        });
        changed.collect()
    }

    fn element<const M: usize>(
        &self,
        patch: u32,
        bonds: UnbrokenBonds<'_>,
    ) -> Option<PatchElement> {
        let share = |cell: u32| self.share(bonds, cell);
        let (volume, row) = self.row(patch, share)?;
        let entries = row.into_iter().flat_map(|(point, gradient)| {
            let first = M * point as usize;
            (first..).zip(gradient)
        });
        Some(PatchElement {
            rigidity: self.modulus(patch) * volume,
            row: entries.collect(),
            thermal: self.thermal_weights(patch, share),
            n_axes: D,
            before: 0.0,
        })
    }
}
