//! What the bending test asks of meshed bodies in space.

use std::sync::Arc;

use ligament_mesh::{Faces, SolidCell, SolidMesh};

use super::formulation::constants;
use crate::bending_test::{Kept, Meshed, Tensor, minus};
use crate::body::{Body, Origin, SolidMeshBody};
use crate::setup::{Dim, Setup};

impl Meshed<3> for Dim {
    const MOST_POINTS: usize = 3_000;

    fn cells(setup: &Setup<3>) -> Vec<&[u32]> {
        cells(setup).iter().map(SolidCell::corners).collect()
    }

    fn sides(setup: &Setup<3>) -> Vec<[u32; 3]> {
        let n_points = setup.body.positions().len();
        let outer = Faces::new(cells(setup), n_points).outer();
        outer.iter().flat_map(|it| it.face.triangles()).collect()
    }

    fn area([a, b, c]: [[f64; 3]; 3]) -> [f64; 3] {
        let ([x, y, z], [u, v, w]) = (minus(b, a), minus(c, a));
        [y * w - z * v, z * u - x * w, x * v - y * u].map(|it| 0.5 * it)
    }

    fn part(setup: &Setup<3>, cells: &[usize]) -> Arc<dyn Body<3>> {
        let Origin::SolidMesh(mesh) = setup.body.origin() else {
            return setup.body.clone();
        };
        let cells = cells.iter().map(|&cell| mesh.cells[cell]);
        let kept = Kept::nodes(cells.clone().map(|it| it.corners().to_vec()));
        let renumbered = |cell| match cell {
            SolidCell::Tetrahedron(it) => SolidCell::Tetrahedron(kept.renumbered(it)),
            SolidCell::Hexahedron(it) => SolidCell::Hexahedron(kept.renumbered(it)),
            SolidCell::Prism(it) => SolidCell::Prism(kept.renumbered(it)),
            SolidCell::Pyramid(it) => SolidCell::Pyramid(kept.renumbered(it)),
        };
        let part = SolidMesh {
            node_tags: kept.taken(&mesh.node_tags),
            positions: kept.taken(&mesh.positions),
            cells: cells.map(renumbered).collect(),
            ..SolidMesh::default()
        };
        Arc::new(SolidMeshBody::from(part))
    }

    /// (1 + nu)/E sigma - nu/E tr sigma.
    fn strain(setup: &Setup<3>, stress: &Tensor<3>) -> Option<Tensor<3>> {
        let material = constants(setup).into_iter().next()?;
        let (young, poisson) = (material.young, material.poisson);
        let trace = stress[0][0] + stress[1][1] + stress[2][2];
        let mut strain = stress.map(|row| row.map(|it| (1.0 + poisson) / young * it));
        for (axis, row) in strain.iter_mut().enumerate() {
            row[axis] -= poisson / young * trace;
        }
        Some(strain)
    }

    fn width(_: &Setup<3>) -> f64 {
        1.0
    }
}

fn cells(setup: &Setup<3>) -> &[SolidCell] {
    match setup.body.origin() {
        Origin::SolidMesh(mesh) => &mesh.cells,
        _ => &[],
    }
}
