//! Strains of the points by least squares over their unbroken bonds.
//!
//! With the slopes du/l and the directions n of the bonds of a point P, to points Q with the volumes V_Q, the gradient G that fits the slopes
//! best is
//!
//! K = sum w n (x) n, M = sum w (du/l) (x) n, G = M K^-1, eps = (G + G^T)/2, with w = V_Q exp(-l/H).
//!
//! An affine motion is found exactly from any bonds that span the space: also from half a family at an edge or beside a crack.
//! The dyads of the forces ([`super::virial`]) have no such property: corrections make forces and energies right, not the dyads of
//! single points.

use nalgebra::{Cholesky, Const, SMatrix, SVector};

use crate::ghosts::Ghosts;
use crate::layout::Layout;
use crate::parallel;
use crate::system::BondSystem;
use crate::tensor::{SymTensor, cross, dot, minus, norm};
use crate::thermal::ThermalStrain;

/// Smallest det(D K/tr K) with which the bonds of a point span the space; a full family has 1.
const LEAST_SPAN: f64 = 4e-4;

/// Factor exp(-l/H)/l of a bond of a length l with a horizon H (m), by which near points count more, 1/m.
pub(crate) fn influence(length: f64, horizon: f64) -> f64 {
    (-length / horizon).exp() / length
}

/// The mean of the known strains of the ends of a bond.
#[inline]
pub(crate) fn mean_strain<const D: usize>(
    of_ends: [Option<SymTensor<D>>; 2],
) -> Option<SymTensor<D>> {
    match of_ends {
        [Some(a), Some(b)] => Some(a.plus(&b).scaled(0.5)),
        [one, other] => one.or(other),
    }
}

/// Sums over the bonds of a point that determine its strain.
#[derive(Debug, Clone)]
pub(crate) struct Fit<const D: usize> {
    /// K; entries above its diagonal are not used.
    spread: SMatrix<f64, D, D>,
    /// M.
    slopes: SMatrix<f64, D, D>,
}

impl<const D: usize> Default for Fit<D> {
    fn default() -> Self {
        Self {
            spread: SMatrix::zeros(),
            slopes: SMatrix::zeros(),
        }
    }
}

impl<const D: usize> Fit<D> {
    /// Adds a bond with the direction n away from the point, the displacement of its other end relative to the point (m), its length (m) and its
    /// weight over the length, V exp(-l/H)/l.
    #[inline]
    pub(crate) fn add(
        &mut self,
        n: [f64; D],
        moved: [f64; D],
        length: f64,
        weight_per_length: f64,
    ) {
        self.add_slope(n, moved, weight_per_length);
        for column in 0..D {
            let spread = length * (weight_per_length * n[column]);
            for (row, n) in n.iter().enumerate().skip(column) {
                self.spread[(row, column)] += spread * n;
            }
        }
    }

    /// Adds to M alone, for a bond that K already contains.
    #[inline]
    pub(super) fn add_slope(&mut self, n: [f64; D], moved: [f64; D], weight_per_length: f64) {
        for (column, n) in n.into_iter().enumerate() {
            let along = weight_per_length * n;
            for (row, moved) in moved.iter().enumerate() {
                self.slopes[(row, column)] += along * moved;
            }
        }
    }

    /// Strain of the point, thermal strain included; None where its bonds do not span the space.
    #[inline]
    pub(crate) fn strain(&self) -> Option<SymTensor<D>> {
        let gradient = self.transposed_gradient()?;
        Some(SymTensor::from_fn(|row, column| {
            0.5 * (gradient[(row, column)] + gradient[(column, row)])
        }))
    }

    /// G^T = K^-1 M^T; None where the bonds do not span the space.
    #[inline]
    pub(super) fn transposed_gradient(&self) -> Option<SMatrix<f64, D, D>> {
        let Span { factor, per_trace } = self.span()?;
        Some(factor.solve(&self.slopes.transpose()) * per_trace)
    }

    /// Factorisation of K; None where the bonds do not span the space.
    #[inline]
    pub(super) fn span(&self) -> Option<Span<D>> {
        let per_trace = D as f64 / self.spread.trace();
        let factor = (self.spread * per_trace).cholesky()?;
        (factor.determinant() > LEAST_SPAN).then_some(Span { factor, per_trace })
    }
}

/// Factorised K of a point whose bonds span the space.
pub(super) struct Span<const D: usize> {
    /// Factor of K times `per_trace`.
    factor: Cholesky<f64, Const<D>>,
    /// D/tr K.
    per_trace: f64,
}

impl<const D: usize> Span<D> {
    /// Length |K^-1 n| for a direction n.
    pub(super) fn size(&self, n: [f64; D]) -> f64 {
        self.factor.solve(&SVector::from(n)).norm() * self.per_trace
    }
}

/// Neighbour of a point by a bond or an element.
#[derive(Debug, Clone, Copy)]
pub(super) struct Neighbour<const D: usize> {
    /// Direction away from the point.
    pub(super) n: [f64; D],
    /// Displacement relative to the point, m.
    pub(super) moved: [f64; D],
    /// Distance, m.
    pub(super) length: f64,
    /// Weight over the distance, m^(D - 1).
    pub(super) weight_per_length: f64,
}

/// A motion of the points of a body with its unbroken bonds.
#[derive(Debug, Clone, Copy)]
pub struct Motion<'a> {
    /// Whether each bond is unbroken, shape (n_bonds).
    pub intact: &'a [bool],
    /// Displacements and rotations, shape (n_degrees_of_freedom), m and rad.
    pub displacement: &'a [f64],
    /// Stress-free thermal strains of the points.
    pub expansion: ThermalStrain<'a>,
}

impl Motion<'_> {
    /// Displacement of a point, m.
    #[inline]
    fn place<const D: usize>(&self, layout: Layout, point: u32) -> [f64; D] {
        let first = layout.range(point).start;
        std::array::from_fn(|axis| self.displacement[first + axis])
    }
}

impl<const D: usize> BondSystem<D> {
    /// Strain of each point less its thermal strain, shape (n_points); None where its bonds do not span the space. Points of other processes get the
    /// strains of their owners.
    pub(crate) fn point_strains(
        &self,
        layout: Layout,
        motion: Motion<'_>,
    ) -> Vec<Option<SymTensor<D>>> {
        self.strains_of_all(|point| self.point_strain(layout, motion, point))
    }

    /// Strains of all local points, each computed by its owner.
    pub(super) fn strains_of_all(
        &self,
        of_point: impl Fn(u32) -> Option<SymTensor<D>> + Sync,
    ) -> Vec<Option<SymTensor<D>>> {
        let cloud = &self.cloud;
        let subdomain = &cloud.subdomain;
        if subdomain.is_whole() {
            return parallel::values(cloud.len(), None, |point| of_point(point as u32));
        }
        let n_components = SymTensor::<D>::COMPONENTS.len();
        let mut all = vec![f64::NAN; n_components * cloud.len()];
        for point in subdomain.owned() {
            if let Some(strain) = of_point(point) {
                let place = n_components * point as usize;
                let of_point = all[place..].iter_mut();
                of_point
                    .zip(strain.components())
                    .for_each(|(to, it)| *to = it);
            }
        }
        Ghosts::all(subdomain).update(&mut all, n_components);
        let strains = all.chunks_exact(n_components);
        let strain = |it: &[f64]| (!it[0].is_nan()).then(|| SymTensor::from_components(it));
        strains.map(strain).collect()
    }

    /// Strain of a point less its thermal strain; None where its bonds do not span the space.
    pub(crate) fn point_strain(
        &self,
        layout: Layout,
        motion: Motion<'_>,
        point: u32,
    ) -> Option<SymTensor<D>> {
        let strain = self.fit_of_motion(layout, motion, point).strain()?;
        if motion.expansion.is_none() {
            return Some(strain);
        }
        let free = motion.expansion.of_point(point as usize).resized();
        Some(strain.plus(&free.scaled(-1.0)))
    }

    /// Sums over the unbroken bonds of a point and over its elements.
    pub(crate) fn fit_of_motion(&self, layout: Layout, motion: Motion<'_>, point: u32) -> Fit<D> {
        let mut fit = self.fit_of_elements(layout, motion, point);
        let family = self.bonds.incidence.at(point).iter();
        for &bond in family.filter(|&&bond| motion.intact[bond as usize]) {
            let it = self.neighbour(layout, motion, point, bond);
            fit.add(it.n, it.moved, it.length, it.weight_per_length);
        }
        fit
    }

    /// Neighbour of a point by a bond.
    #[inline]
    pub(super) fn neighbour(
        &self,
        layout: Layout,
        motion: Motion<'_>,
        point: u32,
        bond: u32,
    ) -> Neighbour<D> {
        let bonds = &self.bonds;
        let other = bonds.neighbour(bond, point);
        let bond = bond as usize;
        Neighbour {
            // The signs of a bond seen from its second end cancel in the products.
            n: match bonds.ends[bond][0] == point {
                true => bonds.direction[bond],
                false => bonds.direction[bond].map(|cosine| -cosine),
            },
            moved: minus(motion.place(layout, other), motion.place(layout, point)),
            length: bonds.length[bond],
            weight_per_length: self.cloud.volumes[other as usize] * self.influence()[bond],
        }
    }

    /// Slopes du/l - phi x n of a bond with the rotations phi of its first and second end, where points have rotations.
    pub(super) fn slopes_of(
        &self,
        layout: Layout,
        displacement: &[f64],
        bond: usize,
    ) -> [[f64; D]; 2] {
        let bonds = &self.bonds;
        let [a, b] = bonds.ends[bond].map(|end| &displacement[layout.range(end)]);
        let place = |motion: &[f64]| -> [f64; D] { std::array::from_fn(|axis| motion[axis]) };
        let (n, moved) = (bonds.direction[bond], minus(place(b), place(a)));
        let slope = moved.map(|it| it / bonds.length[bond]);
        [a, b].map(|motion| minus(slope, cross_product(&motion[D..], n)))
    }

    /// Sums over the points that elements of the far field couple with a point, with w = V_Q.
    pub(super) fn fit_of_elements(&self, layout: Layout, motion: Motion<'_>, point: u32) -> Fit<D> {
        let mut fit = Fit::default();
        for it in self.neighbours_by_elements(layout, motion, point) {
            fit.add(it.n, it.moved, it.length, it.weight_per_length);
        }
        fit
    }

    /// Points that elements of the far field couple with a point, with w = V_Q.
    pub(super) fn neighbours_by_elements<'a>(
        &'a self,
        layout: Layout,
        motion: Motion<'a>,
        point: u32,
    ) -> impl Iterator<Item = Neighbour<D>> + 'a {
        let others = self
            .far
            .iter()
            .flat_map(move |far| far.neighbours.at(point));
        others.map(move |other| {
            let [from, to] = [point, other].map(|it| self.cloud.positions[it as usize]);
            let along = minus(to, from);
            let length = norm(along);
            Neighbour {
                n: along.map(|it| it / length),
                moved: minus(motion.place(layout, other), motion.place(layout, point)),
                length,
                weight_per_length: self.cloud.volumes[other as usize] / length,
            }
        })
    }

    /// Factor exp(-l/H)/l of each bond, which weights the volumes of its ends, shape (n_bonds).
    pub(super) fn influence(&self) -> &[f64] {
        self.influence.get_or_init(|| {
            let (length, horizon) = (&self.bonds.length, &self.bonds.horizon);
            parallel::values(length.len(), 0.0, |bond| {
                influence(length[bond], horizon[bond])
            })
        })
    }
}

/// phi x n for the rotation of a point, about z or about all axes.
fn cross_product<const D: usize>(rotation: &[f64], n: [f64; D]) -> [f64; D] {
    let about = match *rotation {
        [z] => [0.0, 0.0, z],
        _ => std::array::from_fn(|axis| rotation[axis]),
    };
    let mut direction = [0.0; 3];
    direction[..D].copy_from_slice(&n);
    let product = cross(about, direction);
    std::array::from_fn(|axis| product[axis])
}

/// Strains around a bond that its own stretch does not contain. Both are linear in the motion.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct StrainAround {
    /// Sum of the strains across the bond, tr(eps) - n . eps n.
    pub lateral: f64,
    /// Shear strain eps n - (n . eps n) n on the plane across the bond; in the plane without its third component.
    pub shear: [f64; 3],
}

impl StrainAround {
    /// The parts of a strain around a bond with the direction n.
    #[inline]
    pub fn new<const D: usize>(strain: &SymTensor<D>, n: [f64; D]) -> Self {
        let along = strain.times(n);
        let normal = dot(n, along);
        let trace = strain.trace();
        let mut shear = [0.0; 3];
        for axis in 0..D {
            shear[axis] = along[axis] - normal * n[axis];
        }
        Self {
            lateral: trace - normal,
            shear,
        }
    }
}

#[cfg(test)]
pub(super) mod tests;
