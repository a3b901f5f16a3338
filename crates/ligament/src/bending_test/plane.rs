//! What the bending test asks of meshed bodies in the plane.

use std::collections::BTreeMap;
use std::sync::Arc;

use ligament_mesh::{Cell, Mesh};
use ligament_model::Elasticity;

use super::meshed::{Meshed, Tensor};
use super::part::Kept;
use crate::body::{Body, MeshBody, Origin};
use crate::formulation::effective_elasticity;
use crate::setup::{Dim, Setup};

impl Meshed<2> for Dim {
    const MOST_POINTS: usize = 20_000;

    fn cells(setup: &Setup) -> Vec<&[u32]> {
        setup.body.cells().iter().map(Cell::corners).collect()
    }

    /// Cells lie on the left of the edges around them.
    fn sides(setup: &Setup) -> Vec<[u32; 2]> {
        let mut edges: BTreeMap<[u32; 2], Option<[u32; 2]>> = BTreeMap::new();
        for corners in Self::cells(setup) {
            let next = corners.iter().cycle().skip(1);
            for (&from, &to) in corners.iter().zip(next) {
                let edge = edges.entry([from.min(to), from.max(to)]);
                edge.and_modify(|it| *it = None).or_insert(Some([from, to]));
            }
        }
        edges.into_values().flatten().collect()
    }

    fn area([[x0, y0], [x1, y1]]: [[f64; 2]; 2]) -> [f64; 2] {
        [y1 - y0, x0 - x1]
    }

    fn part(setup: &Setup, cells: &[usize]) -> Arc<dyn Body> {
        let Origin::Mesh(mesh) = setup.body.origin() else {
            return setup.body.clone();
        };
        let cells = cells.iter().map(|&cell| mesh.cells[cell]);
        let kept = Kept::nodes(cells.clone().map(|it| it.corners().to_vec()));
        let part = Mesh {
            node_tags: kept.taken(&mesh.node_tags),
            positions: kept.taken(&mesh.positions),
            cells: cells
                .map(|cell| match cell {
                    Cell::Triangle(corners) => Cell::Triangle(kept.renumbered(corners)),
                    Cell::Quadrangle(corners) => Cell::Quadrangle(kept.renumbered(corners)),
                })
                .collect(),
            ..Mesh::default()
        };
        Arc::new(MeshBody::from(part))
    }

    /// Strains of the plane as the law has them.
    fn strain(setup: &Setup, &[[xx, xy], [_, yy]]: &Tensor<2>) -> Option<Tensor<2>> {
        let (region, plane) = (setup.materials.first()?, setup.plane());
        let elasticity: Elasticity = effective_elasticity(&region.material, &setup.law, plane);
        let compliance = elasticity.plane_stiffness(plane).try_inverse()?;
        let stress = [xx, yy, xy];
        let strain = |row: usize| {
            (0..3)
                .map(|k| compliance[(row, k)] * stress[k])
                .sum::<f64>()
        };
        let shear = 0.5 * strain(2);
        Some([[strain(0), shear], [shear, strain(1)]])
    }

    fn width(setup: &Setup) -> f64 {
        setup.thickness()
    }
}
