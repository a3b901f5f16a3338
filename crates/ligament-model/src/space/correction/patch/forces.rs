//! The forces of uniform strains in space, as the cells of a mesh know them.

use ligament_mesh::SolidCell;

use crate::cloud::PointCloud;
use crate::material::Isotropic;
use crate::tensor::{cross, dot, minus};

/// What the cells at each point give it in a uniform strain: the sums of lambda g and of mu g over them, with Lame's constants of a cell
/// and g, the integral of the gradient of the point's shape function over it (m^2); shape (n_points, 2, 3), N.
///
/// The force of the strain eps is lambda g tr eps + 2 mu eps g.
pub type SolidCellForces = Vec<[[f64; 3]; 2]>;

/// Lame's constants lambda and mu of a material, Pa.
pub(super) fn lame(material: &Isotropic) -> [f64; 2] {
    let Isotropic { young, poisson } = *material;
    let shear = 0.5 * young / (1.0 + poisson);
    [2.0 * shear * poisson / (1.0 - 2.0 * poisson), shear]
}

/// The force of a uniform strain (xx, yy, zz, xy, xz, yz) on a point, N; shear strains are those of the tensor, half of gamma.
pub fn force_in([bulk, shear]: &[[f64; 3]; 2], [xx, yy, zz, xy, xz, yz]: [f64; 6]) -> [f64; 3] {
    let trace = xx + yy + zz;
    let rows = [[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]];
    std::array::from_fn(|axis| trace * bulk[axis] + 2.0 * dot(rows[axis], *shear))
}

/// Forces of the cells of a mesh, of which each has one of the materials (n_cells).
///
/// Shape functions are linear on tetrahedra. Other cells are split into tetrahedra ([`SolidCell::tetrahedra`]), alike on both sides of a
/// face: what neighbours give to a point inside a body of one material cancels.
pub fn of_solid_mesh(
    cells: &[SolidCell],
    cloud: &PointCloud<3>,
    material_of_cell: &[u32],
    materials: &[Isotropic],
) -> SolidCellForces {
    let constants: Vec<[f64; 2]> = materials.iter().map(lame).collect();
    let mut forces = vec![[[0.0; 3]; 2]; cloud.len()];
    for (cell, &material) in cells.iter().zip(material_of_cell) {
        let constants = constants[material as usize];
        for corners in cell.tetrahedra() {
            let places = corners.map(|corner| cloud.positions[corner as usize]);
            for (corner, gradient) in corners.into_iter().zip(gradients(places)) {
                for (sum, constant) in forces[corner as usize].iter_mut().zip(constants) {
                    *sum = [0, 1, 2].map(|axis| sum[axis] + constant * gradient[axis]);
                }
            }
        }
    }
    forces
}

/// Integrals of the gradients of the linear shape functions over a tetrahedron, m^2: a third of the area of the opposite face along its
/// inward normal.
fn gradients([a, b, c, d]: [[f64; 3]; 4]) -> [[f64; 3]; 4] {
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
