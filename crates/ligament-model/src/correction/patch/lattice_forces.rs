//! The forces of uniform strains on a lattice, whose points are the centres of its cells.
//!
//! Normal tractions act on the faces of the outline, at the cells that have them: a bar has the force of its whole section. Shear acts on
//! the squares between the points, as the cells of a mesh: on the faces, half a cell outside the points, it would have a moment.

use nalgebra::Matrix3;

use super::forces::{CellForces, gradient, stresses};
use crate::cloud::PointCloud;
use crate::cloud::lattice::{Face, Lattice};
use crate::law::bulk_stiffness;

/// Forces of the cells of a lattice with the stiffness of each material, of which each cell has one (n_points).
///
/// The tractions on the faces between two materials act, with both signs, at the cell of the stiffer one, and a square between several
/// has the shear stress of the softest, because the bonds between them are corrected as bonds of the softer one.
pub fn of_lattice(
    lattice: &Lattice,
    cloud: &PointCloud,
    material_of_cell: &[u32],
    stiffness: &[Matrix3<f64>],
) -> CellForces {
    let parts = Parts::new(lattice, cloud, material_of_cell, stiffness);
    let stresses: Vec<_> = (0..)
        .zip(stiffness)
        .map(|(material, stiffness)| stresses(&parts.reach(material, cloud).stiffness(stiffness)))
        .collect();
    let mut forces = vec![[[0.0; 2]; 3]; cloud.len()];
    for Part {
        at,
        material,
        area: [x, y],
    } in parts.faces
    {
        let of_strains = forces[at as usize].iter_mut();
        for (force, [xx, yy, _]) in of_strains.zip(&stresses[material as usize]) {
            force[0] += xx * x;
            force[1] += yy * y;
        }
    }
    for Part {
        at,
        material,
        area: [x, y],
    } in parts.corners
    {
        let of_strains = forces[at as usize].iter_mut();
        for (force, [_, _, xy]) in of_strains.zip(&stresses[material as usize]) {
            force[0] += xy * y;
            force[1] += xy * x;
        }
    }
    forces
}

/// The stiffness over (eps_xx, eps_yy, gamma_xy), Pa, that uniaxial tractions find in a lattice of one material whose bonds have the forces
/// of [`of_lattice`].
pub fn stiffness_of_lattice(
    lattice: &Lattice,
    cloud: &PointCloud,
    stiffness: &Matrix3<f64>,
) -> Matrix3<f64> {
    let parts = Parts::new(lattice, cloud, &vec![0; cloud.len()], &[*stiffness]);
    parts.reach(0, cloud).stiffness(stiffness)
}

/// What has a stress: an area times its normal, m^2, with the point where it acts.
struct Part {
    at: u32,
    material: u32,
    area: [f64; 2],
}

struct Parts {
    /// Faces of the materials, on the outline and towards others.
    faces: Vec<Part>,
    /// Corners of the squares between the points.
    corners: Vec<Part>,
}

impl Parts {
    fn new(
        lattice: &Lattice,
        cloud: &PointCloud,
        material_of_cell: &[u32],
        stiffness: &[Matrix3<f64>],
    ) -> Self {
        let bulk: Vec<f64> = stiffness.iter().map(bulk_stiffness).collect();
        let material = |cell: u32| material_of_cell[cell as usize];
        let bulk = |cell: u32| bulk[material(cell) as usize];
        let [dx, dy] = lattice.spacing;
        let face = |at: u32, cell: u32, normal: [f64; 2]| Part {
            at,
            material: material(cell),
            area: [dy * normal[0], dx * normal[1]].map(|it| it * cloud.thickness),
        };
        let outline = lattice.outline().into_iter();
        let mut faces: Vec<_> = outline
            .map(|Face { point, normal, .. }| face(point, point, normal.map(f64::from)))
            .collect();
        for (cell, normal, next) in lattice.inner_faces() {
            if material(cell) != material(next) {
                let stiffer = if bulk(cell) <= bulk(next) { next } else { cell };
                faces.push(face(stiffer, cell, normal.map(f64::from)));
                faces.push(face(stiffer, next, normal.map(|it| -f64::from(it))));
            }
        }
        let mut corners = Vec::new();
        for square in lattice.squares() {
            let softest = square
                .into_iter()
                .reduce(|a, b| if bulk(b) < bulk(a) { b } else { a });
            corners.extend(square.iter().enumerate().map(|(k, &at)| Part {
                at,
                material: material(softest.unwrap_or(at)),
                area: gradient(&square, k, cloud),
            }));
        }
        Self { faces, corners }
    }

    /// The volumes of a material over which its stresses do work.
    fn reach(&self, material: u32, cloud: &PointCloud) -> Reach {
        let sum = |parts: &[Part], axis: usize| -> f64 {
            let of_material = parts.iter().filter(|part| part.material == material);
            let work = |part: &Part| cloud.positions[part.at as usize][axis] * part.area[axis];
            of_material.map(work).sum()
        };
        let volumes = [
            sum(&self.faces, 0),
            sum(&self.faces, 1),
            sum(&self.corners, 0),
        ];
        let [least, most] = [f64::min, f64::max].map(|it| volumes.into_iter().reduce(it));
        // One row of cells has no strain across it, but for rounding.
        let is_row = least <= most.map(|it| 1e-9 * it);
        Reach(if is_row { [1.0; 3] } else { volumes })
    }
}

/// Volumes over which sigma_xx, sigma_yy and sigma_xy do work in uniform strains, m^3: sums of x or y of the points times the areas.
///
/// The points lie half a cell inside the faces, so these are less than the volume, and differ unless there are as many cells along x as
/// along y. No symmetric stiffness then answers all tractions with the E and nu of the material: by the theorem of Betti sigma_xx would do
/// another work in the contraction nu sigma_yy/E than sigma_yy in nu sigma_xx/E. What has no room is left to the shorter direction: with
/// the volumes w, the compliance S_ij becomes S_ij w_j/max(w_i, w_j), which leaves E and G and, under tractions along the longer side, nu.
#[derive(Debug, Clone, Copy)]
struct Reach([f64; 3]);

impl Reach {
    fn stiffness(self, stiffness: &Matrix3<f64>) -> Matrix3<f64> {
        let Self(volumes) = self;
        let share = |i: usize, j: usize| volumes[j] / volumes[i].max(volumes[j]);
        let compliance = stiffness.try_inverse();
        let reduced = compliance.map(|it| Matrix3::from_fn(|i, j| it[(i, j)] * share(i, j)));
        let answer = reduced.and_then(|it| it.try_inverse());
        answer.unwrap_or(*stiffness)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::shape::Shape;

    /// Work of the forces of one strain in the affine motion of another is that of the other in the one, and all forces balance, whatever
    /// the sides of the body and its holes.
    #[test]
    fn the_forces_are_those_of_a_symmetric_stiffness() {
        let hole = Shape::rectangle([[0.004, 0.002], [0.009, 0.005]]);
        let stiffness = Matrix3::new(9.0, 2.0, 0.5, 2.0, 4.0, -0.3, 0.5, -0.3, 1.5);
        for holes in [vec![], vec![hole]] {
            let lattice = Lattice::new([17, 6], [0.001, 0.0015], [0.0; 2], holes);
            let cloud = PointCloud::from_lattice(&lattice, 0.01, &vec![0; lattice.cells.len()], 1);
            let forces = of_lattice(&lattice, &cloud, &vec![0; cloud.len()], &[stiffness]);
            let half = std::f64::consts::FRAC_1_SQRT_2;
            let mut work = Matrix3::<f64>::zeros();
            let mut sums = [[0.0_f64; 3]; 3];
            for (forces, &[x, y]) in forces.iter().zip(&cloud.positions) {
                let motions = [[x, 0.0], [0.0, y], [half * y, half * x]];
                for (k, [fx, fy]) in forces.iter().enumerate() {
                    for (l, [u, v]) in motions.iter().enumerate() {
                        work[(k, l)] += fx * u + fy * v;
                    }
                    for (sum, part) in sums[k].iter_mut().zip([*fx, *fy, x * fy - y * fx]) {
                        *sum += part;
                    }
                }
            }
            let size = work.norm();
            assert!((work - work.transpose()).norm() < 1e-12 * size, "{work}");
            assert!(sums.iter().flatten().all(|it| it.abs() < 1e-10), "{sums:?}");
        }
    }
}
