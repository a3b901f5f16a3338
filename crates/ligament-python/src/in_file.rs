//! Reordering of results in memory to the order of the body's file or arrays.

use ligament_model::{AbsentBond, BodyGrid, ConstantFields, Numbering};
use ligament_output::results::PointFields;
use ligament_output::results::fields::FieldValues;

use crate::collector::Kept;
use crate::solution::{Solved, SystemArrays};

/// The results of a run with points and bonds in the order of the body's file.
pub(crate) fn in_order_of_file(solved: Solved) -> Solved {
    let order = Order::new(&solved.grid, &solved.arrays.ends);
    let mut outcome = solved.outcome;
    outcome.state.intact = order.of_bonds(outcome.state.intact);
    outcome.state.dissipated = order.of_bonds(outcome.state.dissipated);
    Solved {
        fixed: order.fixed(solved.fixed),
        arrays: order.arrays(solved.arrays),
        kept: order.kept(solved.kept),
        grid: solved.grid.in_order_of_file(),
        outcome,
        ..solved
    }
}

/// Fields of the points in the order of the file.
fn fields_in_file(numbering: &Numbering, fields: PointFields) -> PointFields {
    let in_file = |values| match values {
        FieldValues::Numbers(values) => FieldValues::Numbers(numbering.to_file(values)),
        FieldValues::Integers(values) => FieldValues::Integers(numbering.to_file(values)),
    };
    let fields = fields.into_iter();
    fields.map(|(field, it)| (field, in_file(it))).collect()
}

/// The order of the points and bonds of a file.
struct Order {
    numbering: Numbering,
    /// Order of the bonds; none where it is the present one.
    bonds: Option<Vec<u32>>,
}

impl Order {
    fn new(grid: &BodyGrid, ends: &[[u32; 2]]) -> Self {
        Self {
            bonds: grid.numbering.bonds_in_file(ends),
            numbering: grid.numbering.clone(),
        }
    }

    fn of_points<T: Copy>(&self, values: Vec<T>) -> Vec<T> {
        self.numbering.to_file(values)
    }

    fn of_bonds<T: Copy>(&self, values: Vec<T>) -> Vec<T> {
        match &self.bonds {
            Some(bonds) if !values.is_empty() => {
                bonds.iter().map(|&bond| values[bond as usize]).collect()
            }
            _ => values,
        }
    }

    fn ends(&self, ends: Vec<[u32; 2]>) -> Vec<[u32; 2]> {
        let ends = ends.into_iter();
        ends.map(|it| self.numbering.ends_in_file(it)).collect()
    }

    fn fixed(&self, fixed: ConstantFields) -> ConstantFields {
        let ConstantFields {
            horizon,
            precrack_share,
            mut energy_ratios,
            domain_factor,
            shear_ratio,
            patch_residual,
            no_fail,
            mut scatter,
            absent,
        } = fixed;
        for it in &mut energy_ratios {
            it.at_points = self.of_points(std::mem::take(&mut it.at_points));
        }
        if let Some(it) = &mut scatter {
            it.at_points = self.of_points(std::mem::take(&mut it.at_points));
        }
        let pair = |pair: AbsentBond| AbsentBond {
            ends: self.numbering.ends_in_file(pair.ends),
            ..pair
        };
        let mut absent: Vec<AbsentBond> = absent.into_iter().map(pair).collect();
        absent.sort_unstable_by_key(|it| it.ends);
        ConstantFields {
            horizon: self.of_points(horizon),
            precrack_share: self.of_points(precrack_share),
            energy_ratios,
            domain_factor: self.of_bonds(domain_factor),
            shear_ratio: self.of_bonds(shear_ratio),
            patch_residual: self.of_points(patch_residual),
            no_fail: self.of_points(no_fail),
            scatter,
            absent,
        }
    }

    fn arrays(&self, arrays: SystemArrays) -> SystemArrays {
        SystemArrays {
            volumes: self.of_points(arrays.volumes),
            spacing: self.of_points(arrays.spacing),
            ends: self.of_bonds(self.ends(arrays.ends)),
            length: self.of_bonds(arrays.length),
            horizon: self.of_bonds(arrays.horizon),
            weight: self.of_bonds(arrays.weight),
        }
    }

    fn kept(&self, kept: Kept) -> Kept {
        let fields = kept.fields.into_iter();
        let fields = fields.map(|(step, it)| (step, fields_in_file(&self.numbering, it)));
        let opened = kept.opened.into_iter();
        let opened = opened.map(|(ends, step)| (self.numbering.ends_in_file(ends), step));
        Kept {
            fields: fields.collect(),
            broken: self.ends(kept.broken),
            opened: opened.collect(),
            step_of_breaking: self.of_bonds(kept.step_of_breaking),
            ..kept
        }
    }
}
