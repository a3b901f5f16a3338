//! Forces of uniform strains on a lattice, whose points are the centres of its cells.
//!
//! Normal tractions act on the faces of the outline, at the cells of the faces: a bar carries the force of its whole section. Shear acts on
//! the blocks between the points, as on the cells of a mesh: on the faces, half a cell outside the points, it would have a moment.

use super::forces::CellForces;
use crate::cloud::PointCloud;
use crate::cloud::lattice::{Face, Lattice};
use crate::material::Stiffness;
use crate::shape::Region;
use crate::tensor::SymTensor;

/// Forces of the cells of a lattice for the stiffness of each material, with the index of the material of each cell (n_points).
///
/// The tractions on the faces between two materials act, with both signs, at the cell of the stiffer one, and a block between several has
/// the shear stress of the softest, because the bonds between them are corrected as bonds of the softer material.
pub fn forces_of_lattice<const D: usize, S: Region<D>>(
    lattice: &Lattice<D, S>,
    cloud: &PointCloud<D>,
    material_of_cell: &[u32],
    stiffness: &[Stiffness],
) -> CellForces<D> {
    let parts = Parts::new(lattice, cloud, material_of_cell, stiffness);
    let found = (0..).zip(stiffness);
    let found = found.map(|(material, it)| parts.reach(material, cloud).stiffness(it));
    let mut forces = CellForces::none(cloud.len(), found.collect());
    let stresses = forces.stresses();
    let part_of_stresses = |is_normal: bool| -> Vec<Vec<SymTensor<D>>> {
        let part = |stress: &SymTensor<D>| {
            SymTensor::from_fn(|row, column| match (row == column) == is_normal {
                true => stress.at(row, column),
                false => 0.0,
            })
        };
        let of_materials = stresses.iter();
        (of_materials.map(|it| it.iter().map(part).collect())).collect()
    };
    let (normal, shear) = (part_of_stresses(true), part_of_stresses(false));
    for (parts, stresses) in [(&parts.faces, normal), (&parts.corners, shear)] {
        for part in parts {
            forces.add(part.at, &stresses[part.material as usize], part.area);
        }
    }
    forces
}

/// An area times its normal under a stress, m^2, with the point where the traction acts.
struct Part<const D: usize> {
    at: u32,
    material: u32,
    area: [f64; D],
}

struct Parts<const D: usize> {
    /// Faces of the materials, on the outline and towards others.
    faces: Vec<Part<D>>,
    /// Corners of the blocks between the points.
    corners: Vec<Part<D>>,
}

impl<const D: usize> Parts<D> {
    fn new<S: Region<D>>(
        lattice: &Lattice<D, S>,
        cloud: &PointCloud<D>,
        material_of_cell: &[u32],
        stiffness: &[Stiffness],
    ) -> Self {
        let bulk: Vec<f64> = stiffness.iter().map(bulk_stiffness::<D>).collect();
        let material = |cell: u32| material_of_cell[cell as usize];
        let bulk = |cell: u32| bulk[material(cell) as usize];
        let face = |at: u32, cell: u32, normal: [i8; D], sign: f64| {
            let size = sign * lattice.face_size(normal);
            Part {
                at,
                material: material(cell),
                area: normal.map(|it| size * f64::from(it) * cloud.thickness),
            }
        };
        let outline = lattice.outline().into_iter();
        let mut faces: Vec<_> = outline
            .map(|Face { point, normal, .. }| face(point, point, normal, 1.0))
            .collect();
        for (cell, normal, next) in lattice.inner_faces() {
            if material(cell) != material(next) {
                let stiffer = if bulk(cell) <= bulk(next) { next } else { cell };
                faces.push(face(stiffer, cell, normal, 1.0));
                faces.push(face(stiffer, next, normal, -1.0));
            }
        }
        let mut corners = Vec::new();
        for block in blocks(lattice) {
            let softest = (block.iter().copied())
                .reduce(|a, b| if bulk(b) < bulk(a) { b } else { a })
                .map_or(0, material);
            corners.extend(block.iter().enumerate().map(|(k, &at)| Part {
                at,
                material: softest,
                area: gradient(&block, k, cloud),
            }));
        }
        Self { faces, corners }
    }

    /// Volumes of a material over which its stresses do work; collective.
    fn reach(&self, material: u32, cloud: &PointCloud<D>) -> WorkVolumes {
        let sum = |parts: &[Part<D>], axis: usize| -> f64 {
            let is_counted =
                |part: &&Part<D>| part.material == material && cloud.subdomain.owns(part.at);
            let work = |part: &Part<D>| cloud.positions[part.at as usize][axis] * part.area[axis];
            let counted = parts.iter().filter(is_counted);
            cloud.subdomain.sum(counted.map(work).sum())
        };
        let volume = |&[row, column]: &[usize; 2]| match row == column {
            true => sum(&self.faces, row),
            false => sum(&self.corners, row),
        };
        let volumes: Vec<f64> = SymTensor::<D>::COMPONENTS.iter().map(volume).collect();
        let [least, most] = [f64::min, f64::max].map(|it| volumes.iter().copied().reduce(it));
        // One layer of cells has no strain across it, except by rounding.
        let is_layer = least <= most.map(|it| 1e-9 * it);
        WorkVolumes(if is_layer {
            vec![1.0; volumes.len()]
        } else {
            volumes
        })
    }
}

/// Sum of C_ij over the normal strains i and j, Pa, which is independent of the axes and proportional to the axial constants of the laws:
/// the softer of two materials has the smaller one.
fn bulk_stiffness<const D: usize>(stiffness: &Stiffness) -> f64 {
    let normal = SymTensor::<D>::COMPONENTS.iter().enumerate();
    let normal: Vec<usize> = normal.filter(|(_, [i, j])| i == j).map(|it| it.0).collect();
    let pairs = (normal.iter()).flat_map(|&i| normal.iter().map(move |&j| stiffness[(i, j)]));
    pairs.sum()
}

/// Blocks between the centres of cells around a corner: the points at the corners of a block, lower before upper ones, along x first.
pub(crate) fn blocks<const D: usize, S: Region<D>>(lattice: &Lattice<D, S>) -> Vec<Vec<u32>> {
    let above = |cell: &[u32; D]| -> Option<Vec<u32>> {
        let corners = 0..1_usize << D;
        let place = |corner: usize, axis: usize| i64::from(cell[axis]) + upper(corner, axis) as i64;
        let point = |corner| lattice.point_in(std::array::from_fn(|axis| place(corner, axis)));
        corners.map(point).collect()
    };
    lattice.cells.iter().filter_map(above).collect()
}

/// Returns 1 if a corner of a block is an upper one along an axis, else 0.
fn upper(corner: usize, axis: usize) -> usize {
    (corner >> axis) & 1
}

/// Integral of the gradient of the shape function of a corner over a block, m^2: half in the plane, a quarter in space, of the existing part
/// of the face across each axis.
pub(crate) fn gradient<const D: usize>(
    block: &[u32],
    corner: usize,
    cloud: &PointCloud<D>,
) -> [f64; D] {
    let place = |corner: usize| cloud.positions[block[corner] as usize];
    let (low, high) = (place(0), place(block.len() - 1));
    let share = 2.0 * cloud.thickness / block.len() as f64;
    std::array::from_fn(|axis| {
        let others = (0..D).filter(|&other| other != axis);
        let face: f64 = others.map(|other| high[other] - low[other]).product();
        let sign = 2.0 * upper(corner, axis) as f64 - 1.0;
        sign * share * face
    })
}

/// Volumes over which the components of the stress do work in uniform strains, m^3: sums of a coordinate of the points times the areas.
///
/// The points lie half a cell inside the faces, so these volumes are smaller than the body's, and differ unless there are as many cells
/// along each axis. No symmetric stiffness then agrees with all tractions for the E and nu of the material: by the theorem of Betti sigma_xx
/// would do another work in the contraction nu sigma_yy/E than sigma_yy in nu sigma_xx/E. The error is left to the shorter direction: with
/// the volumes w, the compliance S_ij becomes S_ij w_j/max(w_i, w_j), which keeps E and G and, under tractions along the longer side, nu.
#[derive(Debug, Clone)]
struct WorkVolumes(Vec<f64>);

impl WorkVolumes {
    fn stiffness(self, stiffness: &Stiffness) -> Stiffness {
        let Self(volumes) = self;
        let share = |i: usize, j: usize| volumes[j] / volumes[i].max(volumes[j]);
        let compliance = stiffness.clone().try_inverse();
        let reduced = compliance.map(|it| {
            let size = volumes.len();
            Stiffness::from_fn(size, size, |i, j| it[(i, j)] * share(i, j))
        });
        let answer = reduced.and_then(|it| it.try_inverse());
        answer.unwrap_or_else(|| stiffness.clone())
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "a failed unwrap fails the test")]
mod tests {
    use super::*;
    use crate::correction::patch::uniform_strains;
    use crate::material::{Elasticity, Isotropic, Plane};
    use crate::shape::Shape;
    use crate::shape::SolidShape;
    use crate::tensor::dot;

    /// Work of the forces of one strain in the affine motion of another is that of the other in the one, and all forces and moments balance.
    fn check<const D: usize, S: Region<D>>(lattice: &Lattice<D, S>, stiffness: Stiffness) {
        let cells = vec![0; lattice.cells.len()];
        let cloud = PointCloud::from_lattice(lattice, 0.01, &cells, 1);
        let forces = forces_of_lattice(lattice, &cloud, &cells, &[stiffness]);
        let strains: Vec<SymTensor<D>> = uniform_strains().collect();
        let mut work = Stiffness::zeros(strains.len(), strains.len());
        let mut sums = vec![[[0.0; D]; D]; strains.len()];
        let mut totals = vec![[0.0; D]; strains.len()];
        for (forces, &position) in forces.on_points().zip(&cloud.positions) {
            for (k, &force) in forces.iter().enumerate() {
                for (l, strain) in strains.iter().enumerate() {
                    work[(k, l)] += dot(force, strain.times(position));
                }
                for i in 0..D {
                    totals[k][i] += force[i];
                    for j in 0..D {
                        sums[k][i][j] += position[i] * force[j] - position[j] * force[i];
                    }
                }
            }
        }
        let size = work.norm();
        assert!((&work - work.transpose()).norm() < 1e-12 * size, "{work}");
        // The terms of these sums are at most 1e-3: rounding leaves far less of them, a part that is missing far more.
        let left = sums.as_flattened().iter().chain(&totals).flatten();
        assert!(left.into_iter().all(|it| it.abs() < 1e-10));
    }

    /// The sides of the body and its holes do not matter.
    #[test]
    fn the_forces_are_those_of_a_symmetric_stiffness() {
        let hole = Shape::rectangle([[0.004, 0.002], [0.009, 0.005]]);
        let stiffness =
            Stiffness::from_row_slice(3, 3, &[9.0, 2.0, 0.5, 2.0, 4.0, -0.3, 0.5, -0.3, 1.5]);
        for holes in [vec![], vec![hole]] {
            let lattice = Lattice::new([17, 6], [0.001, 0.0015], [0.0; 2], holes);
            check(&lattice, stiffness.clone());
        }
        let hole = SolidShape::Sphere {
            centre: [0.005, 0.004, 0.003],
            radius: 0.002,
        };
        let isotropic = Elasticity::Isotropic(Isotropic {
            young: 3.0,
            poisson: 0.2,
        });
        let stiffness = isotropic.stiffness::<3>(Plane::Strain).unwrap();
        for holes in [vec![], vec![hole]] {
            let lattice = Lattice::new([11, 6, 4], [0.001, 0.0015, 0.002], [0.0; 3], holes);
            check(&lattice, stiffness.clone());
        }
    }
}
