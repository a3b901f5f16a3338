//! Strains of the points around bonds, from the stored motions and the remaining bonds of the points.

use std::array::from_fn;
use std::collections::BTreeMap;

use ligament_model::Absence;
use ligament_model::stress::point_strain::{Fit, StrainAround, closeness, mean_strain};
use ligament_model::tensor::SymTensor;
use ligament_output::results::stored::{Motions, StoredRun};

use super::strains::breakages;

/// The families of the ends of some bonds, with the steps in which their bonds broke.
pub(super) struct EndFamilies<'a> {
    run: &'a StoredRun,
    /// Bonds of the requested points.
    families: BTreeMap<u32, Vec<usize>>,
    /// Step in which each bond broke, shape (n_bonds).
    broke_in: Vec<Option<usize>>,
    /// Whether a stored step is just before the breakages of its step.
    before_breakages: bool,
}

impl<'a> EndFamilies<'a> {
    /// The families of the ends of bonds.
    pub(super) fn new(
        run: &'a StoredRun,
        of_bonds: impl Iterator<Item = [u32; 2]>,
        before_breakages: bool,
    ) -> Self {
        let ends = of_bonds.flatten();
        let mut families: BTreeMap<u32, Vec<usize>> = ends.map(|it| (it, Vec::new())).collect();
        let bonds = &run.model.bonds;
        let is_bond = |absence: &&Option<Absence>| absence.is_none();
        let n_bonds = bonds.absence.iter().take_while(is_bond).count();
        for (bond, ends) in bonds.ends[..n_bonds].iter().enumerate() {
            for end in ends {
                if let Some(family) = families.get_mut(end) {
                    family.push(bond);
                }
            }
        }
        Self {
            run,
            families,
            broke_in: breakages(run, &bonds.ends[..n_bonds]),
            before_breakages,
        }
    }

    /// The strain around a bond with these ends and this direction in a stored step; None where the bonds of neither end span the space.
    pub(super) fn strain(
        &self,
        (ends, direction): ([u32; 2], [f64; 3]),
        motions: &Motions,
        step: usize,
    ) -> Option<StrainAround> {
        match self.run.model.in_space {
            true => self.strain_in::<3>((ends, direction), motions, step),
            false => self.strain_in::<2>((ends, direction), motions, step),
        }
    }

    fn strain_in<const D: usize>(
        &self,
        (ends, direction): ([u32; 2], [f64; 3]),
        motions: &Motions,
        step: usize,
    ) -> Option<StrainAround> {
        let of_ends = ends.map(|end| self.point_strain::<D>(end, motions, step));
        let n = from_fn(|axis| direction[axis]);
        Some(StrainAround::new(&mean_strain(of_ends)?, n))
    }

    /// Strain of a point without its thermal strain.
    fn point_strain<const D: usize>(
        &self,
        point: u32,
        motions: &Motions,
        step: usize,
    ) -> Option<SymTensor<D>> {
        let model = &self.run.model;
        let is_intact = |bond: &usize| match self.broke_in[*bond] {
            None => true,
            Some(broke) if self.before_breakages => step <= broke,
            Some(broke) => step < broke,
        };
        let mut fit = Fit::<D>::default();
        for &bond in self.families[&point].iter().filter(|it| is_intact(it)) {
            let ends = model.bonds.ends[bond];
            let other = if ends[0] == point { ends[1] } else { ends[0] };
            let [here, there] = [point, other].map(|it| it as usize);
            let difference = |of: &[[f64; 3]]| from_fn(|axis| of[there][axis] - of[here][axis]);
            let along: [f64; D] = difference(&model.positions);
            let length = along.iter().map(|it| it * it).sum::<f64>().sqrt();
            let weight_per_length =
                model.volumes[there] * closeness(length, model.bonds.horizon[bond]);
            let moved = difference(&motions.displacement);
            fit.add(
                along.map(|it| it / length),
                moved,
                length,
                weight_per_length,
            );
        }
        let strain = fit.strain()?;
        if motions.thermal_strain.is_empty() {
            return Some(strain);
        }
        let free = motions.thermal_strain.times(1.0).of_point(point as usize);
        Some(strain.plus(&free.resized().scaled(-1.0)))
    }
}
