//! Element of MBB-PD with the printed forces, on the two ends of the bond alone (eqs 16 and 17).
//!
//! The force densities are f = psi c S (eqs 16 and 18); the class of the bond decides which of them act on its ends:
//!
//! | class | force along x | force along y |
//! |---|---|---|
//! | H | f_xx | - |
//! | V | - | f_yy |
//! | S | f_xx + 1/2 f_xy abs(tan theta) xi/xi_0 | f_yy + 1/2 f_xy abs(cot theta) xi/xi_0 |
//!
//! each in the direction in which a positive strain pulls, times both volumes; xi_0 is the length of the shortest bond of the same
//! direction. Eq. 17 has no meaning for H and V bonds. These forces do not derive from an energy: the stiffness is not symmetric. The
//! element exists to show the results of the printed equations.

use std::sync::Arc;

use super::imaginary::{BondClass, ImaginaryElement, ImaginaryElements};
use super::{Block, BondDeformation, Element, Rigidities, StiffnessFactors, Term};
use crate::bonds::{BondSet, Incidence};
use crate::tensor::SymTensor;

/// Elements of a lattice with the printed forces.
#[derive(Debug, Clone, PartialEq)]
pub struct PairwiseElements {
    /// The elements with the forces of the energy.
    pub lattice: ImaginaryElements,
    /// Factors of the rows (xx, yy, xy) of D in the printed forces of each bond, shape (n_bonds).
    pub row_factors: Vec<[f64; 3]>,
    /// Distances between the columns and between the rows of the lattice, m.
    pub spacing: [f64; 2],
}

/// The element of one bond with its surroundings.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PairwiseElement {
    /// Imaginary element: the strains, and D with the factor psi of the energy.
    strains: ImaginaryElement,
    ends: [u32; 2],
    /// Vector from A to B, m.
    offset: [f64; 2],
    /// Ratio of the printed psi to the psi of the energy, for the rows (xx, yy, xy).
    row_factors: [f64; 3],
    /// Coefficients from psi c S V_A V_B |xi| of the rows to the force on the second end, 1/m.
    of_rows: [[f64; 3]; 2],
}

impl PairwiseElement {
    /// Force on the second end, N.
    #[inline]
    fn force(&self, deformation: &BondDeformation) -> [f64; 2] {
        let rows = self.rows(deformation);
        self.of_rows.map(|of_rows| {
            of_rows
                .iter()
                .zip(rows)
                .map(|(factor, row)| factor * row)
                .sum()
        })
    }

    /// Products V_A V_B |xi| f of the rows (xx, yy, xy), J.
    #[inline]
    fn rows(&self, deformation: &BondDeformation) -> [f64; 3] {
        let stress = self.strains.stress(deformation);
        [0, 1, 2].map(|row| self.row_factors[row] * stress[row])
    }
}

/// Coefficients of the rows (xx, yy, xy) in the force along x and y, without volumes and densities, 1/m.
fn of_rows(offset: [f64; 2], spacing: [f64; 2], class: BondClass) -> [[f64; 3]; 2] {
    let length = offset[0].hypot(offset[1]);
    let [to_x, to_y] = offset.map(|it| it.signum() / length);
    match class {
        BondClass::Horizontal => [[to_x, 0.0, 0.0], [0.0; 3]],
        BondClass::Vertical => [[0.0; 3], [0.0, to_y, 0.0]],
        BondClass::Shear => {
            let [p, q] = [0, 1].map(|axis| (offset[axis].abs() / spacing[axis]).round() as u32);
            let multiple = f64::from(greatest_common_divisor(p, q));
            let tan = (offset[1] / offset[0]).abs();
            [
                [to_x, 0.0, 0.5 * multiple * tan * to_y],
                [0.0, to_y, 0.5 * multiple / tan * to_x],
            ]
        }
    }
}

fn greatest_common_divisor(one: u32, other: u32) -> u32 {
    if other == 0 {
        one
    } else {
        greatest_common_divisor(other, one % other)
    }
}

impl Element<2, 2> for PairwiseElement {
    type Deformation = BondDeformation;

    type Lattice = PairwiseElements;

    fn new(
        elements: &PairwiseElements,
        bonds: &BondSet,
        rigidities: &Rigidities,
        intact: &[bool],
        bond: usize,
    ) -> Self {
        let offset = bonds.direction[bond].map(|cosine| cosine * bonds.length[bond]);
        Self {
            strains: ImaginaryElement::new(&elements.lattice, bonds, rigidities, intact, bond),
            ends: bonds.ends[bond],
            offset,
            row_factors: elements.row_factors[bond],
            of_rows: of_rows(
                offset,
                elements.spacing,
                BondClass::from_direction(bonds.direction[bond]),
            ),
        }
    }

    fn couplings(elements: &PairwiseElements) -> Option<[&Arc<Incidence>; 2]> {
        ImaginaryElement::couplings(&elements.lattice)
    }

    fn dependent_bonds(elements: &PairwiseElements, bonds: &[u32]) -> Vec<u32> {
        ImaginaryElement::dependent_bonds(&elements.lattice, bonds)
    }

    fn weakened(self, remaining: &StiffnessFactors) -> Self {
        Self {
            strains: self.strains.weakened(remaining),
            ..self
        }
    }

    #[inline]
    fn deformation(&self, motions: &[f64]) -> BondDeformation {
        self.strains.deformation(motions)
    }

    #[inline]
    fn deformation_in(&self, strain: &SymTensor<2>) -> BondDeformation {
        self.strains.deformation_in(strain)
    }

    /// Energy 1/2 f S V_A V_B |xi| (A.7) of the rows that act on the ends. It is not the work of the forces.
    #[inline]
    fn mutual_energy(&self, one: &BondDeformation, other: &BondDeformation) -> f64 {
        let [to_x, to_y] = self.of_rows;
        let is_affected_by = [to_x[0] != 0.0, to_y[1] != 0.0, to_x[2] != 0.0];
        let rows = self
            .rows(one)
            .into_iter()
            .zip(other.strain())
            .zip(is_affected_by);
        let felt = rows.filter(|(_, is_affected_by)| *is_affected_by);
        0.5 * felt.map(|((row, strain), _)| row * strain).sum::<f64>()
    }

    #[inline]
    fn forces(&self, deformation: &BondDeformation, mut add: impl FnMut(u32, [f64; 2])) {
        let [x, y] = self.force(deformation);
        add(self.ends[0], [-x, -y]);
        add(self.ends[1], [x, y]);
    }

    fn dyad(&self, deformation: &BondDeformation) -> SymTensor<2> {
        SymTensor::dyad(self.force(deformation), self.offset)
    }

    /// Terms of the energy form; the printed forces have none.
    fn terms(&self) -> Vec<Term> {
        self.strains.terms()
    }

    /// Blocks of the energy form.
    fn upper_blocks(&self, point: u32, add: impl FnMut(u32, Block<2>)) {
        self.strains.upper_blocks(point, add);
    }

    fn derivatives(&self, mut add: impl FnMut(usize, usize, f64)) {
        let [a, b] = self.ends;
        for (point, strains) in self.strains.strains_of_points() {
            let of_columns = strains.map(|strain| self.force(&BondDeformation::of_strain(strain)));
            for (end, sign) in [(a, -1.0), (b, 1.0)] {
                for r in 0..2 {
                    for (c, column) in of_columns.iter().enumerate() {
                        let [row, at] = [(end, r), (point, c)]
                            .map(|(point, component)| 2 * point as usize + component);
                        add(row, at, sign * column[r]);
                    }
                }
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A bond (2, 2) is twice the shortest of its direction, (2, 1) the shortest; signs follow the offset.
    #[test]
    fn shear_pulls_along_both_axes() {
        let length = 8.0_f64.sqrt();
        let found = of_rows([2.0, 2.0], [1.0; 2], BondClass::Shear);
        assert_eq!(
            found,
            [
                [1.0 / length, 0.0, 1.0 / length],
                [0.0, 1.0 / length, 1.0 / length]
            ]
        );
        let length = 5.0_f64.sqrt();
        let found = of_rows([-2.0, 1.0], [1.0; 2], BondClass::Shear);
        assert_eq!(
            found,
            [
                [-1.0 / length, 0.0, 0.25 / length],
                [0.0, 1.0 / length, -1.0 / length]
            ]
        );
    }
}
