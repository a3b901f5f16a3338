//! Bound of the energy of the motion of a part, and of the growth of the ratios of measure to limit in it, from the motions of its border.
//!
//! A delayed part has no loads, so that its motion has the least energy of all motions with the same motion of its border. The bonds share
//! this energy, and no bond has more than the sum: with |d|^2 twice the energy of a motion d,
//!
//! |d| <= |a| + |r|,  ratio(s + s_d) <= ratio(s) + kappa |d|,
//!
//! for any motion a of uniform strain, and the rest r = d - a of the border's motion, with no motion inside. The strain a is the
//! least-squares fit of the border's motion; the energy of r is the energy of the bonds from inside the part, point by point; and kappa
//! is the largest ratio of a bond of the part that has an energy of 1/2 J. All measures are sublinear, so that ratios of sums are
//! no larger than sums of ratios.

use ligament_model::Bonds;
use nalgebra::{DMatrix, DVector};

/// Marker of a motion that is not an unknown of the border.
pub(super) const NOT_THERE: u32 = u32::MAX;

/// Share of the size of a mode that is added to it, so that modes that are equal on the border stay solvable. The bound holds for
/// any strain.
const RIDGE: f64 = 1e-10;

/// Motions of a body as a whole, each of shape (n_degrees_of_freedom): rigid motions, without energy, and motions of uniform strain.
pub(super) struct Modes {
    pub(super) rigid: Vec<Vec<f64>>,
    pub(super) strain: Vec<Vec<f64>>,
}

impl Modes {
    /// Rigid and strain modes of a body.
    pub(super) fn of_body(system: &dyn Bonds) -> Self {
        let masses = vec![1.0; system.n_points()];
        Self {
            rigid: system.motions_about_centre(&masses).motions,
            strain: system.motions_of_strain(),
        }
    }

    fn all(&self) -> impl Iterator<Item = &Vec<f64>> {
        self.rigid.iter().chain(&self.strain)
    }
}

/// Data of the bound of one part with its descendants.
#[derive(Default)]
pub(super) struct Bound {
    /// Degrees of freedom of the points of the border, shape (n_points, n_components).
    dofs: Vec<u32>,
    /// Index of each of `dofs` among the rows of the border, or [`NOT_THERE`].
    places: Vec<u32>,
    /// Stiffness of each point of the border with the bonds into the part, shape (n_points, n_components, n_components).
    blocks: Vec<f64>,
    /// Least-squares fit of the modes to motions of the border, shape (n_modes, n_points n_components).
    fit: Vec<f64>,
    /// Twice the energy of the strain modes in the bonds of the part, shape (n_strains, n_strains), J.
    stiffness: Vec<f64>,
}

impl Bound {
    /// Bound from the points of the border, by their degrees of freedom, `places` and `blocks`.
    pub(super) fn new(
        modes: &Modes,
        (dofs, places): (Vec<u32>, Vec<u32>),
        blocks: Vec<f64>,
        stiffness: Vec<f64>,
    ) -> Self {
        let mut bound = Self {
            dofs,
            places,
            blocks,
            fit: Vec::new(),
            stiffness,
        };
        bound.fit = bound.fitted(modes);
        bound
    }

    fn n_components(&self) -> usize {
        match self.dofs.len() {
            0 => 1,
            count => self.blocks.len() / count,
        }
    }

    /// Least-squares fit of the modes to motions of the border, weighted by its stiffness.
    fn fitted(&self, modes: &Modes) -> Vec<f64> {
        let n = self.n_components();
        let weights = (0..self.dofs.len()).map(|k| self.blocks[k * n + k % n]);
        let weights = DVector::from_iterator(self.dofs.len(), weights);
        let at_border = |mode: &Vec<f64>| {
            let values = self.dofs.iter().map(|&dof| mode[dof as usize]);
            DVector::from_iterator(self.dofs.len(), values)
        };
        let columns: Vec<DVector<f64>> = modes.all().map(at_border).collect();
        let weighted: Vec<DVector<f64>> =
            (columns.iter().map(|it| it.component_mul(&weights))).collect();
        let size: Vec<f64> = (columns.iter().zip(&weighted))
            .map(|(one, weighted)| one.dot(weighted).sqrt().max(f64::MIN_POSITIVE))
            .collect();
        let normal = DMatrix::from_fn(columns.len(), columns.len(), |i, j| {
            let ridge = if i == j { RIDGE } else { 0.0 };
            columns[i].dot(&weighted[j]) / (size[i] * size[j]) + ridge
        });
        let right = DMatrix::from_fn(columns.len(), self.dofs.len(), |i, k| {
            weighted[i][k] / size[i]
        });
        let Some(factor) = normal.cholesky() else {
            return vec![0.0; columns.len() * self.dofs.len()];
        };
        let fit = factor.solve(&right);
        (0..columns.len())
            .flat_map(|i| {
                let size = size[i];
                fit.row(i)
                    .iter()
                    .map(move |it| it / size)
                    .collect::<Vec<_>>()
            })
            .collect()
    }

    /// Degrees of freedom of the points of the border, shape (n_points, n_components).
    pub(super) fn border(&self) -> &[u32] {
        &self.dofs
    }

    /// Bound of |d| of the motion d since the border had the motions `then`, J^(1/2); displacements are by degree of freedom.
    pub(super) fn norm(&self, modes: &Modes, displacement: &[f64], then: &[f64]) -> f64 {
        let change = |(&dof, &place): (&u32, &u32)| match place {
            NOT_THERE => 0.0,
            place => displacement[dof as usize] - then[place as usize],
        };
        let mut rest: Vec<f64> = self.dofs.iter().zip(&self.places).map(change).collect();
        if rest.is_empty() {
            return 0.0;
        }
        let fit = self.fit.chunks_exact(rest.len());
        let of_modes: Vec<f64> = fit.map(|row| dot(row, &rest)).collect();
        for (mode, size) in modes.all().zip(&of_modes) {
            for (rest, &dof) in rest.iter_mut().zip(&self.dofs) {
                *rest -= size * mode[dof as usize];
            }
        }
        let strain = &of_modes[modes.rigid.len()..];
        let of_strain = quadratic(&self.stiffness, strain);
        let n = self.n_components();
        let points = rest.chunks_exact(n).zip(self.blocks.chunks_exact(n * n));
        let of_rest: f64 = points.map(|(rest, block)| quadratic(block, rest)).sum();
        of_strain.max(0.0).sqrt() + of_rest.max(0.0).sqrt()
    }
}

fn dot(one: &[f64], other: &[f64]) -> f64 {
    one.iter().zip(other).map(|(a, b)| a * b).sum()
}

/// Quadratic form x^T A x.
fn quadratic(matrix: &[f64], x: &[f64]) -> f64 {
    let rows = matrix.chunks_exact(x.len());
    rows.zip(x).map(|(row, x_i)| x_i * dot(row, x)).sum()
}
