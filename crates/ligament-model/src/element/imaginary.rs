//! The element of MBB-PD: a small imaginary rectangle around a bond of a lattice, and the strains in it.
//!
//! | class | bond | rectangle | eqs |
//! |---|---|---|---|
//! | H | along x | the points above and below its ends | 12, 13 |
//! | V | along y | the points beside its ends | 14 |
//! | S | any other | the bond is its diagonal | 15 |
//!
//! The strains are differences of displacements over differences of positions. With
//! a discrete gradient of up to six points, du/dx ~ sum_i X_i u_i and du/dy ~ sum_i Y_i u_i, they are
//!
//! S_xx = sum X_i u_i, S_yy = sum Y_i v_i, S_xy = sum (Y_i u_i + X_i v_i):
//!
//! exact in uniform strains, and zero for small rotations. The energy is 1/2 S^T D S.
//!
//! # After breakage
//!
//! A neighbour counts while the bond of one spacing to it is unbroken; where one of the two is missing, the difference is taken to the end
//! itself. A corner of the rectangle of an S bond counts while one of its two edges is unbroken. A bond without support for one of its
//! derivatives drops out: it has no stiffness and no strain.

mod class;
mod quotients;
mod surroundings;

use std::sync::Arc;

use nalgebra::{SymmetricEigen, Vector3};

pub use super::strain_stiffness::{StrainStiffness, SymmetricEntries, entries, matrix};
use super::{Block, BondDeformation, Element, Rigidities, StiffnessFactors, Term};
use crate::bonds::{BondSet, Incidence};
use crate::tensor::SymTensor;
pub use class::BondClass;
pub(super) use quotients::{Axis, Quotient, Quotients};
pub use surroundings::Surroundings;

/// Largest number of points that an element couples.
const POINTS: usize = 6;

/// Imaginary elements of a lattice; the stiffness D of each bond is in [`Rigidities::strain`].
#[derive(Debug, Clone, PartialEq)]
pub struct ImaginaryElements {
    /// Positions whose differences are the denominators of the strains, shape (n_points), m.
    pub positions: Vec<[f64; 2]>,
    /// The bonds that support the element of each bond.
    pub surroundings: Surroundings,
    /// Bonds whose elements couple each point, ascending.
    pub couplings: Arc<Incidence>,
    /// Other points that some element couples with each point, ascending.
    pub neighbours: Arc<Incidence>,
}

impl ImaginaryElements {
    /// The elements of bonds on a lattice with positions (n_points), m.
    pub fn new(bonds: &BondSet, positions: Vec<[f64; 2]>) -> Self {
        let surroundings = Surroundings::from_bonds(bonds);
        let whole = vec![true; bonds.len()];
        let gradient =
            |bond: usize| Gradient::for_bond(bonds, &surroundings, &positions, &whole, bond);
        let of_bonds = (0..bonds.len()).flat_map(|bond| {
            let gradient = gradient(bond);
            let points = gradient.points.into_iter().take(gradient.count);
            points.map(move |point| (point, bond as u32))
        });
        let couplings = Incidence::from_pairs(of_bonds, positions.len());
        let of_points = (0..positions.len() as u32).flat_map(|point| {
            let bonds = couplings.at(point).iter();
            let mut others: Vec<u32> = bonds
                .flat_map(|&bond| gradient(bond as usize).points().to_vec())
                .filter(|&other| other != point)
                .collect();
            others.sort_unstable();
            others.dedup();
            others.into_iter().map(move |other| (point, other))
        });
        Self {
            neighbours: Incidence::from_pairs(of_points, positions.len()).into(),
            couplings: couplings.into(),
            surroundings,
            positions,
        }
    }
}

/// The imaginary element of one bond with its remaining surroundings.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ImaginaryElement {
    gradient: Gradient,
    stiffness: SymmetricEntries,
}

/// A discrete gradient over up to [`POINTS`] points.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Gradient {
    count: usize,
    points: [u32; POINTS],
    /// Weights X_i of the derivative by x, 1/m.
    by_x: [f64; POINTS],
    /// Weights Y_i of the derivative by y, 1/m.
    by_y: [f64; POINTS],
}

impl Gradient {
    const NONE: Self = Self {
        count: 0,
        points: [0; POINTS],
        by_x: [0.0; POINTS],
        by_y: [0.0; POINTS],
    };

    /// The gradient of a bond while the bonds marked in `intact` (n_bonds) are unbroken; [`Gradient::NONE`] where one of the
    /// derivatives has no support.
    #[inline]
    fn for_bond(
        bonds: &BondSet,
        surroundings: &Surroundings,
        positions: &[[f64; 2]],
        intact: &[bool],
        bond: usize,
    ) -> Self {
        let mut gradient = Self::NONE;
        for quotient in Quotients::for_bond(bonds, surroundings, intact, bond).iter() {
            gradient.add(quotient, positions);
        }
        gradient
    }

    /// Adds a difference quotient to the gradient.
    #[inline]
    fn add(&mut self, quotient: &Quotient, positions: &[[f64; 2]]) {
        let &Quotient {
            axis,
            ends: [from, to],
            weight,
        } = quotient;
        let distance = quotient.distance(positions);
        for (point, value) in [(from, -weight / distance), (to, weight / distance)] {
            let place = self.place_of(point);
            match axis {
                Axis::X => self.by_x[place] += value,
                Axis::Y => self.by_y[place] += value,
            }
        }
    }

    #[inline]
    fn place_of(&mut self, point: u32) -> usize {
        let known = self.points[..self.count].iter().position(|it| *it == point);
        known.unwrap_or_else(|| {
            self.points[self.count] = point;
            self.count += 1;
            self.count - 1
        })
    }

    /// Points of the gradient.
    fn points(&self) -> &[u32] {
        &self.points[..self.count]
    }

    /// Points of the gradient with their weights X_i and Y_i.
    #[inline]
    fn weights(&self) -> impl Iterator<Item = (u32, f64, f64)> + '_ {
        let weights = self.by_x.iter().zip(&self.by_y);
        let points = self.points[..self.count].iter().zip(weights);
        points.map(|(&point, (&x, &y))| (point, x, y))
    }
}

impl ImaginaryElement {
    /// Strains (S_xx, S_yy, S_xy) for unit displacements along x and y of each coupled point, with the point.
    pub(super) fn strains_of_points(&self) -> impl Iterator<Item = (u32, [[f64; 3]; 2])> + '_ {
        let weights = self.gradient.weights();
        weights.map(|(point, x, y)| (point, [[x, 0.0, y], [0.0, y, x]]))
    }

    /// Block of the stiffness between two coupled points, given by their indices in the gradient: rows of the first, columns of the second,
    /// shape (2, 2), N/m.
    fn block(&self, first: usize, second: usize) -> Block<2> {
        let [d11, d12, d16, d22, d26, d66] = self.stiffness;
        let Gradient { by_x, by_y, .. } = &self.gradient;
        let ([x, y], [x_2, y_2]) = ([by_x[first], by_y[first]], [by_x[second], by_y[second]]);
        // Columns of D B for the second point.
        let of_u = [
            d11 * x_2 + d16 * y_2,
            d12 * x_2 + d26 * y_2,
            d16 * x_2 + d66 * y_2,
        ];
        let of_v = [
            d12 * y_2 + d16 * x_2,
            d22 * y_2 + d26 * x_2,
            d26 * y_2 + d66 * x_2,
        ];
        [
            [x * of_u[0] + y * of_u[2], x * of_v[0] + y * of_v[2]],
            [y * of_u[1] + x * of_u[2], y * of_v[1] + x * of_v[2]],
        ]
    }

    /// D S for the strains (S_xx, S_yy, S_xy) of a deformation, J.
    #[inline]
    pub(super) fn stress(&self, deformation: &BondDeformation) -> [f64; 3] {
        let [d11, d12, d16, d22, d26, d66] = self.stiffness;
        let [xx, yy, xy] = deformation.strain();
        [
            d11 * xx + d12 * yy + d16 * xy,
            d12 * xx + d22 * yy + d26 * xy,
            d16 * xx + d26 * yy + d66 * xy,
        ]
    }
}

impl Element<2, 2> for ImaginaryElement {
    type Deformation = BondDeformation;

    type Lattice = ImaginaryElements;

    #[inline]
    fn new(
        lattice: &ImaginaryElements,
        bonds: &BondSet,
        rigidities: &Rigidities,
        intact: &[bool],
        bond: usize,
    ) -> Self {
        let gradient = Gradient::for_bond(
            bonds,
            &lattice.surroundings,
            &lattice.positions,
            intact,
            bond,
        );
        let is_supported = gradient.count > 0;
        Self {
            gradient,
            stiffness: if is_supported {
                rigidities.strain[bond].entries
            } else {
                [0.0; 6]
            },
        }
    }

    fn couplings(lattice: &ImaginaryElements) -> Option<[&Arc<Incidence>; 2]> {
        Some([&lattice.couplings, &lattice.neighbours])
    }

    fn dependent_bonds(lattice: &ImaginaryElements, bonds: &[u32]) -> Vec<u32> {
        let of_bonds = (bonds.iter()).flat_map(|&bond| lattice.surroundings.dependents(bond));
        let mut dependent_bonds: Vec<u32> = of_bonds.copied().collect();
        dependent_bonds.sort_unstable();
        dependent_bonds.dedup();
        dependent_bonds
    }

    #[inline]
    fn weakened(self, remaining: &StiffnessFactors) -> Self {
        // The axial factor scales the whole matrix D, which has no separate entries for stretch and shear.
        Self {
            stiffness: self.stiffness.map(|entry| remaining.axial * entry),
            ..self
        }
    }

    #[inline]
    fn deformation(&self, motions: &[f64]) -> BondDeformation {
        let mut strain = [0.0; 3];
        for (point, x, y) in self.gradient.weights() {
            let first = 2 * point as usize;
            let [u, v] = [motions[first], motions[first + 1]];
            strain[0] += x * u;
            strain[1] += y * v;
            strain[2] += y * u + x * v;
        }
        BondDeformation::of_strain(strain)
    }

    #[inline]
    fn deformation_in(&self, strain: &SymTensor<2>) -> BondDeformation {
        if self.gradient.count == 0 {
            return BondDeformation::default();
        }
        BondDeformation::of_strain([strain.at(0, 0), strain.at(1, 1), 2.0 * strain.at(0, 1)])
    }

    #[inline]
    fn mutual_energy(&self, one: &BondDeformation, other: &BondDeformation) -> f64 {
        let stress = self.stress(one);
        let products = stress.iter().zip(other.strain());
        0.5 * products
            .map(|(stress, strain)| stress * strain)
            .sum::<f64>()
    }

    #[inline]
    fn forces(&self, deformation: &BondDeformation, mut add: impl FnMut(u32, [f64; 2])) {
        let [xx, yy, xy] = self.stress(deformation);
        for (point, x, y) in self.gradient.weights() {
            add(point, [x * xx + y * xy, y * yy + x * xy]);
        }
    }

    /// Dyad D S, since the gradient is exact for linear fields.
    fn dyad(&self, deformation: &BondDeformation) -> SymTensor<2> {
        SymTensor::from_components(&self.stress(deformation))
    }

    /// Terms of the stiffness, one for each eigenvalue of D.
    fn terms(&self) -> Vec<Term> {
        let SymmetricEigen {
            eigenvalues,
            eigenvectors,
        } = matrix(self.stiffness).symmetric_eigen();
        let term = |mode: usize| {
            let of_strain: Vector3<f64> = eigenvectors.column(mode).into();
            let entries = self.gradient.weights().flat_map(|(point, x, y)| {
                let first = 2 * point as usize;
                let [xx, yy, xy] = [of_strain[0], of_strain[1], of_strain[2]];
                [(first, xx * x + xy * y), (first + 1, yy * y + xy * x)]
            });
            (
                eigenvalues[mode],
                entries.filter(|(_, value)| *value != 0.0).collect(),
            )
        };
        (0..eigenvalues.len()).map(term).collect()
    }

    fn upper_blocks(&self, point: u32, mut add: impl FnMut(u32, Block<2>)) {
        let points = self.gradient.points();
        let Some(column) = points.iter().position(|&it| it == point) else {
            return;
        };
        for (row, &other) in points.iter().enumerate().filter(|(_, it)| **it <= point) {
            add(other, self.block(row, column));
        }
    }
}
