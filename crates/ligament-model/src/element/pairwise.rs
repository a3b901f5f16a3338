//! The element of MBB-PD with the printed forces: on the two ends of the bond alone (eqs 16 and 17).
//!
//! With the force densities f = psi c S (eqs 16 and 18), the class of the bond decides what its ends feel:
//!
//! | class | force along x | force along y |
//! |---|---|---|
//! | H | f_xx | - |
//! | V | - | f_yy |
//! | S | f_xx + 1/2 f_xy abs(tan theta) xi/xi_0 | f_yy + 1/2 f_xy abs(cot theta) xi/xi_0 |
//!
//! each in the direction in which a positive strain pulls, times both volumes; xi_0 is the length of the shortest bond of the same
//! direction. Eq. 17 has no meaning for H and V bonds. These forces are not those of an energy: the stiffness is not symmetric. The
//! form is here to show what the printed equations give.

use super::imaginary::{BondClass, ImaginaryElement};
use super::{BondDeformation, Element, Remaining, Term, UNKNOWNS};
use crate::system::BondSystem;

/// One bond with its surroundings.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PairwiseElement {
    /// The strains, and D with the factor psi of the energy.
    strains: ImaginaryElement,
    ends: [u32; 2],
    /// From A to B, m.
    offset: [f64; 2],
    /// Printed psi over that of the energy, of the rows (xx, yy, xy).
    row_factors: [f64; 3],
    /// Takes psi c S V_A V_B |xi| of the rows to the force on the second end, 1/m.
    of_rows: [[f64; 3]; 2],
}

impl PairwiseElement {
    /// Force on the second end for displacements of size one along x and y of each point that it couples, with the point: rows of
    /// the force, columns of the displacement, shape (2, 2), N/m. The first end feels the opposite.
    pub fn couplings(&self) -> impl Iterator<Item = (u32, [[f64; 2]; 2])> + '_ {
        self.strains.strains_of_points().map(|(point, strains)| {
            let of_columns =
                strains.map(|[xx, yy, xy]| self.force(&BondDeformation::of_strain([xx, yy, xy])));
            let block = [0, 1].map(|row| of_columns.map(|column| column[row]));
            (point, block)
        })
    }

    /// Points A and B.
    pub fn ends(&self) -> [u32; 2] {
        self.ends
    }

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

    /// V_A V_B |xi| f, J.
    #[inline]
    fn rows(&self, deformation: &BondDeformation) -> [f64; 3] {
        let stress = self.strains.stress(deformation);
        [0, 1, 2].map(|row| self.row_factors[row] * stress[row])
    }
}

/// What the rows (xx, yy, xy) give along x and y, without volumes and densities, 1/m.
fn of_rows(offset: [f64; 2], spacing: f64, class: BondClass) -> [[f64; 3]; 2] {
    let length = offset[0].hypot(offset[1]);
    let [to_x, to_y] = offset.map(|it| it.signum() / length);
    match class {
        BondClass::Horizontal => [[to_x, 0.0, 0.0], [0.0; 3]],
        BondClass::Vertical => [[0.0; 3], [0.0, to_y, 0.0]],
        BondClass::Shear => {
            let [p, q] = offset.map(|it| (it.abs() / spacing).round() as u32);
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

impl Element for PairwiseElement {
    /// # Panics
    ///
    /// Panics if the system is not one of imaginary elements with factors of their rows.
    fn of(system: &BondSystem, intact: &[bool], bond: usize) -> Self {
        let elements = system
            .imaginary
            .as_ref()
            .expect("a system of imaginary elements");
        let bonds = &system.bonds;
        let offset = bonds.direction[bond].map(|cosine| cosine * bonds.length[bond]);
        let spacing = system.cloud.spacing[bonds.ends[bond][0] as usize];
        Self {
            strains: ImaginaryElement::of(system, intact, bond),
            ends: bonds.ends[bond],
            offset,
            row_factors: elements.row_factors[bond],
            of_rows: of_rows(offset, spacing, BondClass::of(bonds.direction[bond])),
        }
    }

    fn weakened(self, remaining: &Remaining) -> Self {
        Self {
            strains: self.strains.weakened(remaining),
            ..self
        }
    }

    #[inline]
    fn deformation(&self, unknowns: &[f64]) -> BondDeformation {
        self.strains.deformation(unknowns)
    }

    #[inline]
    fn deformation_in(&self, strain: [f64; 3]) -> BondDeformation {
        self.strains.deformation_in(strain)
    }

    /// 1/2 f S V_A V_B |xi| (A.7) of the rows that the ends feel. It is not the work of the forces.
    #[inline]
    fn mutual_energy(&self, one: &BondDeformation, other: &BondDeformation) -> f64 {
        let [to_x, to_y] = self.of_rows;
        let feels = [to_x[0] != 0.0, to_y[1] != 0.0, to_x[2] != 0.0];
        let rows = self.rows(one).into_iter().zip(other.strain()).zip(feels);
        let felt = rows.filter(|(_, feels)| *feels);
        0.5 * felt.map(|((row, strain), _)| row * strain).sum::<f64>()
    }

    #[inline]
    fn forces(&self, deformation: &BondDeformation, mut add: impl FnMut(u32, [f64; UNKNOWNS])) {
        let [x, y] = self.force(deformation);
        add(self.ends[0], [-x, -y, 0.0]);
        add(self.ends[1], [x, y, 0.0]);
    }

    fn dyad(&self, deformation: &BondDeformation) -> [f64; 3] {
        let ([f_x, f_y], [x, y]) = (self.force(deformation), self.offset);
        [f_x * x, f_y * y, 0.5 * (f_x * y + f_y * x)]
    }

    /// Those of the energy form: the forces have none.
    fn terms(&self) -> [Term; 3] {
        self.strains.terms()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A bond (2, 2) is twice the shortest of its direction, (2, 1) the shortest; signs follow the offset.
    #[test]
    fn shear_pulls_along_both_axes() {
        let length = 8.0_f64.sqrt();
        let found = of_rows([2.0, 2.0], 1.0, BondClass::Shear);
        assert_eq!(
            found,
            [
                [1.0 / length, 0.0, 1.0 / length],
                [0.0, 1.0 / length, 1.0 / length]
            ]
        );
        let length = 5.0_f64.sqrt();
        let found = of_rows([-2.0, 1.0], 1.0, BondClass::Shear);
        assert_eq!(
            found,
            [
                [-1.0 / length, 0.0, 0.25 / length],
                [0.0, 1.0 / length, -1.0 / length]
            ]
        );
    }
}
