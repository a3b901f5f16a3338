//! Stresses across bonds whose motions are known from different times.
//!
//! Parts of a large body may be solved later than others, so that the bonds of a point are known from several times. The displacements
//! of different times cannot be mixed, because the body also turns in between. The slope of a bond at its end P can, with the
//! rotation phi_P of that end at the same time taken off,
//!
//! g_P = du/l - phi_P x n = s n + gamma +- (dphi x n)/2,
//!
//! since it consists of the strains of the bond alone. It gives the strain of the point ([`super::point_strain`]):
//! eps_P = sym(sum w g_P (x) n K^-1), whatever phi_P is.
//!
//! A motion d of the bonds of P, with the energy |d|^2/2, changes the strain by at most
//!
//! |eps_P| <= Q_P |d|, Q_P^2 = sum (w |K^-1 n| rho)^2, rho^2 = max(1/A, 1/S + 1/(4 R)),
//!
//! by Cauchy and Schwarz over the bonds with the energies (A s^2 + S gamma^2 + R dphi^2)/2.

use crate::element::Rigidities;
use crate::failure::hooke::{Moduli, StressAcross};
use crate::layout::Layout;
use crate::parallel;
use crate::system::BondSystem;
use crate::tensor::{SymTensor, dot};

use super::point_strain::{Fit, StrainAround, mean_strain};

/// Motions of the bonds of a body at the times at which they were last known, and the stresses that follow from them.
pub trait StoredMotions: Send + Sync {
    /// Stores the motions of some bonds from the displacements and rotations of the points, shape (n_degrees_of_freedom), m and rad.
    fn store(&mut self, displacement: &[f64], bonds: &[u32]);

    /// Computes the strains of some points from the stored motions of their intact bonds.
    fn update_strains(&mut self, intact: &[bool], points: &[u32]);

    /// Stress across a bond by the last strains of its ends and its stored stretch.
    fn stress_across(&self, bond: u32, moduli: &Moduli) -> StressAcross;

    /// Computes the bounds Q_P of some points, J^(-1/2), from their intact bonds.
    fn update_bounds(&mut self, intact: &[bool], points: &[u32]);

    /// Largest strains around a bond in a motion of the bonds of its ends with an energy of 1/2 J, J^(-1/2); None where the bonds of
    /// neither end span the space, infinite where a bond resists no shear or no rotation.
    fn strain_per_norm(&self, bond: u32) -> Option<StrainAround>;
}

/// Stored motions of the bonds of a system.
struct StoredSlopes<'a, const D: usize> {
    system: &'a BondSystem<D>,
    layout: Layout,
    /// Slopes of each bond at its ends, along its direction from the first one, shape (n_bonds).
    slopes: Vec<[[f64; D]; 2]>,
    /// Strains of the points, shape (n_points); None where their bonds do not span the space.
    strains: Vec<Option<SymTensor<D>>>,
    /// Bounds Q of the points, shape (n_points), J^(-1/2); None where their bonds do not span the space.
    bounds: Vec<Option<f64>>,
}

impl<const D: usize> BondSystem<D> {
    /// Storage for the motions of the bonds; None where points have no rotations.
    pub(crate) fn stored_motions(&self, layout: Layout) -> Option<Box<dyn StoredMotions + '_>> {
        if !layout.components.iter().any(|it| it.is_rotation()) {
            return None;
        }
        Some(Box::new(StoredSlopes {
            system: self,
            layout,
            slopes: vec![[[0.0; D]; 2]; self.bonds.len()],
            strains: vec![None; self.cloud.len()],
            bounds: vec![None; self.cloud.len()],
        }))
    }
}

impl<const D: usize> StoredSlopes<'_, D> {
    /// The sums over the intact bonds of a point; `visit` gets each of these bonds with its weight w.
    fn fit(&self, intact: &[bool], point: u32, mut visit: impl FnMut(usize, f64)) -> Fit<D> {
        let BondSystem { bonds, cloud, .. } = self.system;
        let influence = self.system.influence();
        let mut fit = Fit::default();
        let family = bonds.incidence.at(point).iter();
        for &bond in family.filter(|&&bond| intact[bond as usize]) {
            let volume = cloud.volumes[bonds.neighbour(bond, point) as usize];
            let bond = bond as usize;
            let end = usize::from(bonds.ends[bond][0] != point);
            let length = bonds.length[bond];
            let moved = self.slopes[bond][end].map(|it| it * length);
            let weight_per_length = volume * influence[bond];
            fit.add(bonds.direction[bond], moved, length, weight_per_length);
            visit(bond, weight_per_length * length);
        }
        fit
    }

    /// Bound Q of a point; None where its bonds do not span the space.
    fn bound(&self, intact: &[bool], point: u32) -> Option<f64> {
        let mut weights = Vec::new();
        let fit = self.fit(intact, point, |bond, weight| weights.push((bond, weight)));
        let span = fit.span()?;
        let Rigidities {
            axial,
            shear,
            rotational,
            ..
        } = &self.system.rigidities;
        let squares = weights.into_iter().map(|(bond, weight)| {
            let across = shear[bond].recip() + 0.25 * rotational[bond].recip();
            let compliance = axial[bond].recip().max(across);
            (weight * span.size(self.system.bonds.direction[bond])).powi(2) * compliance
        });
        Some(squares.sum::<f64>().sqrt())
    }
}

impl<const D: usize> StoredMotions for StoredSlopes<'_, D> {
    fn store(&mut self, displacement: &[f64], bonds: &[u32]) {
        let found = parallel::values(bonds.len(), [[0.0; D]; 2], |place| {
            self.system
                .slopes_of(self.layout, displacement, bonds[place] as usize)
        });
        for (&bond, slopes) in bonds.iter().zip(found) {
            self.slopes[bond as usize] = slopes;
        }
    }

    fn update_strains(&mut self, intact: &[bool], points: &[u32]) {
        let found = parallel::values(points.len(), None, |place| {
            self.fit(intact, points[place], |_, _| {}).strain()
        });
        for (&point, strain) in points.iter().zip(found) {
            self.strains[point as usize] = strain;
        }
    }

    fn stress_across(&self, bond: u32, moduli: &Moduli) -> StressAcross {
        let bonds = &self.system.bonds;
        let [a, b] = bonds.ends[bond as usize].map(|end| self.strains[end as usize]);
        let n = bonds.direction[bond as usize];
        let around = mean_strain([a, b]).map(|it| StrainAround::new(&it, n));
        moduli.stress_across(dot(self.slopes[bond as usize][0], n), around)
    }

    fn update_bounds(&mut self, intact: &[bool], points: &[u32]) {
        let found = parallel::values(points.len(), None, |place| {
            self.bound(intact, points[place])
        });
        for (&point, bound) in points.iter().zip(found) {
            self.bounds[point as usize] = bound;
        }
    }

    fn strain_per_norm(&self, bond: u32) -> Option<StrainAround> {
        let [a, b] = self.system.bonds.ends[bond as usize].map(|end| self.bounds[end as usize]);
        let size = match [a, b] {
            [Some(a), Some(b)] => 0.5 * (a + b),
            [one, other] => one.or(other)?,
        };
        // Of all strains of the size 1 these have the largest trace across a direction, and the largest shear.
        Some(StrainAround {
            lateral: size * ((D - 1) as f64).sqrt(),
            shear: [size * 0.5_f64.sqrt(), 0.0, 0.0],
        })
    }
}
