//! Forces of uniform strains from the cells of a mesh.

use ligament_mesh::{Cell, SolidCell};

use crate::cloud::PointCloud;
use crate::dimension::cast_ref;
use crate::material::Stiffness;
use crate::tensor::{SymTensor, cross, dot, minus};

/// Forces on the points in uniform strains, which are orthonormal as tensors, so that results do not depend on the axes: eps_ii = 1, and
/// eps_ij = eps_ji = 1/sqrt(2), in the order of [`SymTensor`].
#[derive(Debug, Clone)]
pub struct CellForces<const D: usize = 2> {
    /// Forces, shape (n_points, n_strains, D), N.
    values: Vec<[f64; D]>,
    /// Stiffness of each material in the forces: on a mesh its own, on a lattice the one of the uniaxial tractions.
    pub stiffness: Vec<Stiffness>,
}

/// Points with the forces that the correction needs.
#[derive(Debug, Clone)]
pub struct Points<'a, const D: usize = 2> {
    /// Positions and volumes.
    pub cloud: &'a PointCloud<D>,
    /// Forces of uniform strains.
    pub forces: CellForces<D>,
    /// Whether the points have rotations, and so equations of moments.
    pub turn: bool,
}

/// The uniform strains of [`CellForces`].
pub(crate) fn uniform_strains<const D: usize>() -> impl Iterator<Item = SymTensor<D>> {
    let places = SymTensor::<D>::COMPONENTS.iter();
    places.map(|&[i, j]| {
        let size = if i == j {
            1.0
        } else {
            std::f64::consts::FRAC_1_SQRT_2
        };
        SymTensor::from_fn(|row, column| if [row, column] == [i, j] { size } else { 0.0 })
    })
}

impl<const D: usize> CellForces<D> {
    /// Zero forces on some points, of materials with a stiffness.
    pub fn none(n_points: usize, stiffness: Vec<Stiffness>) -> Self {
        Self {
            values: vec![[0.0; D]; SymTensor::<D>::COMPONENTS.len() * n_points],
            stiffness,
        }
    }

    /// Stresses of each material in each strain, shape (n_materials, n_strains), Pa.
    pub(super) fn stresses(&self) -> Vec<Vec<SymTensor<D>>> {
        let of_material = |stiffness: &Stiffness| {
            let strains = SymTensor::<D>::COMPONENTS.iter().enumerate();
            let of_strain = |(k, &[i, j]): (usize, &[usize; 2])| {
                let size = if i == j {
                    1.0
                } else {
                    std::f64::consts::SQRT_2
                };
                let column = stiffness.column(k);
                let components: Vec<f64> = column.iter().map(|it| size * it).collect();
                SymTensor::from_components(&components)
            };
            strains.map(of_strain).collect()
        };
        self.stiffness.iter().map(of_material).collect()
    }

    /// Adds the tractions of the stresses in each strain, Pa, on an area, m^2, to the forces on a point.
    pub(crate) fn add(&mut self, point: u32, stresses: &[SymTensor<D>], area: [f64; D]) {
        let of_point = &mut self.values[stresses.len() * point as usize..][..stresses.len()];
        for (force, stress) in of_point.iter_mut().zip(stresses) {
            let traction = stress.times(area);
            (0..D).for_each(|axis| force[axis] += traction[axis]);
        }
    }

    /// Forces on each point in each strain.
    pub fn on_points(&self) -> impl Iterator<Item = &[[f64; D]]> {
        self.values.chunks_exact(SymTensor::<D>::COMPONENTS.len())
    }

    /// Forces on a point in each strain.
    pub fn on_point(&self, point: u32) -> &[[f64; D]] {
        let n_strains = SymTensor::<D>::COMPONENTS.len();
        &self.values[n_strains * point as usize..][..n_strains]
    }
}

/// Forces of the cells of a mesh for the stiffness of each material, with the index of the material of each cell (n_cells).
///
/// The integral of the gradient of N_P over a cell is half of the side from its last corner before P to the next one after it, turned
/// by a right angle, for triangles and for quadrangles.
pub fn forces_of_mesh(
    cells: &[Cell],
    cloud: &PointCloud,
    material_of_cell: &[u32],
    stiffness: Vec<Stiffness>,
) -> CellForces {
    let mut forces = CellForces::none(cloud.len(), stiffness);
    let stresses = forces.stresses();
    for (cell, &material) in cells.iter().zip(material_of_cell) {
        let corners = cell.corners();
        for (k, &corner) in corners.iter().enumerate() {
            let gradient = gradient(corners, k, cloud);
            forces.add(corner, &stresses[material as usize], gradient);
        }
    }
    forces
}

/// Integral of the gradient of N over a cell for its corner number k, m^2.
fn gradient(corners: &[u32], k: usize, cloud: &PointCloud) -> [f64; 2] {
    let n = corners.len();
    let sides = [corners[(k + n - 1) % n], corners[(k + 1) % n]];
    let [[x0, y0], [x1, y1]] = sides.map(|corner| cloud.positions[corner as usize]);
    let half = 0.5 * cloud.thickness;
    [half * (y1 - y0), half * (x0 - x1)]
}

/// Forces of the cells of a solid mesh for the stiffness of each material, with the index of the material of each cell (n_cells).
///
/// Shape functions are linear on tetrahedra. Other cells are split into tetrahedra ([`SolidCell::tetrahedra`]), alike on both sides of a
/// face: contributions of neighbours to a point inside a body of one material cancel.
pub fn forces_of_solid_mesh(
    cells: &[SolidCell],
    cloud: &PointCloud<3>,
    material_of_cell: &[u32],
    stiffness: Vec<Stiffness>,
) -> CellForces<3> {
    let mut forces = CellForces::none(cloud.len(), stiffness);
    let stresses = forces.stresses();
    for (cell, &material) in cells.iter().zip(material_of_cell) {
        for corners in cell.tetrahedra() {
            let places = corners.map(|corner| cloud.positions[corner as usize]);
            for (corner, gradient) in corners.into_iter().zip(tetrahedron_gradients(places)) {
                forces.add(corner, &stresses[material as usize], gradient);
            }
        }
    }
    forces
}

/// Integrals of the gradients of the linear shape functions over a triangle times the thickness, or over a tetrahedron, for each of its
/// corners, m^2.
pub(crate) fn gradients<const D: usize>(corners: &[u32], cloud: &PointCloud<D>) -> Vec<[f64; D]> {
    if let Some(plane) = cast_ref::<_, PointCloud>(cloud) {
        let of_corners = (0..corners.len()).map(|k| resized(gradient(corners, k, plane)));
        return of_corners.collect();
    }
    let place = |k: usize| resized(cloud.positions[corners[k] as usize]);
    let of_corners = tetrahedron_gradients(std::array::from_fn(place)).into_iter();
    of_corners.map(resized).collect()
}

/// A vector with E components: the first ones of a vector with D, and zeros for missing ones.
fn resized<const D: usize, const E: usize>(vector: [f64; D]) -> [f64; E] {
    std::array::from_fn(|axis| vector.get(axis).copied().unwrap_or(0.0))
}

/// Integrals of the gradients of the linear shape functions over a tetrahedron, m^2: a third of the area of the opposite face along its
/// inward normal.
fn tetrahedron_gradients([a, b, c, d]: [[f64; 3]; 4]) -> [[f64; 3]; 4] {
    let [e, f, g] = [b, c, d].map(|corner| minus(corner, a));
    let is_positive = dot(e, cross(f, g)) > 0.0;
    let sixth = if is_positive { 1.0 / 6.0 } else { -1.0 / 6.0 };
    let [b, c, d] = [cross(f, g), cross(g, e), cross(e, f)].map(|it| it.map(|part| sixth * part));
    [
        [0, 1, 2].map(|axis| -(b[axis] + c[axis] + d[axis])),
        b,
        c,
        d,
    ]
}
