//! Lumping: the nodes of a mesh become material points with the volume of its cells.

use ligament_mesh::{Mesh, MeshCell};

use super::{PointCloud, distance, search_tree};
use crate::horizon::INCLUSION_TOLERANCE;

impl<const D: usize> PointCloud<D> {
    /// Lumps the cells of a mesh: a cell's area times the thickness, or in space (thickness 1) its volume, is divided among its corners
    /// (NHPD section 2.1; [`MeshCell::shares`]).
    ///
    /// `material_of_cell` (n_cells) has the index of each cell's material. A point at an interface receives volume from the cells of either
    /// side.
    pub fn from_mesh<C: MeshCell<D>>(
        mesh: &Mesh<D, C>,
        thickness: f64,
        material_of_cell: &[u32],
        n_materials: usize,
    ) -> Self {
        let mut cloud = Self::at(&mesh.positions, thickness, n_materials);
        let mut material_volumes = vec![0.0; cloud.len() * n_materials];
        for (cell, &material) in mesh.cells.iter().zip(material_of_cell) {
            for (corner, share) in cell.shares(&cloud.positions) {
                material_volumes[corner as usize * n_materials + material as usize] +=
                    share * thickness;
            }
        }
        let of_points = material_volumes.chunks(n_materials);
        cloud.volumes = of_points.map(|volumes| volumes.iter().sum()).collect();
        let numbered = material_volumes.iter().enumerate();
        let share = |(k, volume): (usize, &f64)| volume / cloud.volumes[k / n_materials];
        cloud.material_shares = numbered.map(share).collect();
        cloud.spacing = nearest_neighbour_distances(&cloud, &mesh.cells).into();
        cloud
    }
}

/// Length of the shortest edge of a cell at each node, shape (n_points), m; infinite at nodes without a cell.
pub(crate) fn shortest_edges<const D: usize, C: MeshCell<D>>(
    cloud: &PointCloud<D>,
    cells: &[C],
) -> Vec<f64> {
    let mut shortest = vec![f64::INFINITY; cloud.len()];
    for ends in cells.iter().flat_map(C::edges) {
        let [from, to] = ends.map(|end| end as usize);
        let length = distance(cloud.positions[from], cloud.positions[to]);
        shortest[from] = length.min(shortest[from]);
        shortest[to] = length.min(shortest[to]);
    }
    shortest
}

/// Distance of each point to the nearest other one, m: searched no farther than the end of its shortest edge.
fn nearest_neighbour_distances<const D: usize, C: MeshCell<D>>(
    cloud: &PointCloud<D>,
    cells: &[C],
) -> Vec<f64> {
    let reach = shortest_edges(cloud, cells);
    let tree = search_tree(&cloud.positions);
    cloud.over_points(|point| {
        let position = cloud.positions[point as usize];
        let reach = reach[point as usize] * (1.0 + 2.0 * INCLUSION_TOLERANCE);
        tree.locate_within_distance(position, reach * reach)
            .filter(|neighbour| neighbour.data != point)
            .map(|neighbour| distance(position, *neighbour.geom()))
            .fold(f64::INFINITY, f64::min)
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use ligament_mesh::{SolidCell, SolidMesh};

    const CUBE: [[f64; 3]; 8] = [
        [10.0, 0.0, 0.0],
        [12.0, 0.0, 0.0],
        [12.0, 3.0, 0.0],
        [10.0, 3.0, 0.0],
        [10.0, 0.0, 4.0],
        [12.0, 0.0, 4.0],
        [12.0, 3.0, 4.0],
        [10.0, 3.0, 4.0],
    ];

    fn lumped(cells: Vec<SolidCell>, extra: &[[f64; 3]]) -> PointCloud<3> {
        let positions: Vec<[f64; 3]> = CUBE.iter().chain(extra).copied().collect();
        let n_cells = cells.len();
        let mesh = SolidMesh {
            node_tags: (1..=positions.len() as u64).collect(),
            positions,
            cells,
            ..SolidMesh::default()
        };
        let materials: Vec<u32> = (0..n_cells as u32).collect();
        PointCloud::from_mesh(&mesh, 1.0, &materials, n_cells)
    }

    /// Volume and middle of mass of a brick and of the pyramid on it, by hand; the material of a shared corner is that of both.
    #[test]
    fn volumes_keep_the_middle_of_mass() {
        let brick = SolidCell::Hexahedron([0, 1, 2, 3, 4, 5, 6, 7]);
        let cloud = lumped(
            vec![brick, SolidCell::Pyramid([4, 5, 6, 7, 8])],
            &[[11.0, 1.5, 10.0]],
        );
        let expected = [3.0, 3.0, 3.0, 3.0, 5.25, 5.25, 5.25, 5.25, 3.0];
        assert_eq!(*cloud.volumes, expected);
        let moment = |axis: usize| -> f64 {
            let terms = cloud.positions.iter().zip(&*cloud.volumes);
            terms
                .map(|(p, volume)| (p[axis] + cloud.origin[axis]) * volume)
                .sum()
        };
        // 24 at z = 2 and 12 at a quarter of the height of 6 over z = 4.
        assert!((moment(2) - (24.0 * 2.0 + 12.0 * 5.5)).abs() < 1e-13);
        assert!((moment(0) - 36.0 * 11.0).abs() < 1e-12);
        assert_eq!(cloud.shares(4), [3.0 / 5.25, 2.25 / 5.25]);
        assert_eq!(cloud.shares(0), [1.0, 0.0]);
        assert_eq!(cloud.spacing[..8], [2.0; 8]);
        assert_eq!(cloud.spacing[8], (1.0_f64 + 2.25 + 36.0).sqrt());
    }

    #[test]
    fn tetrahedra_and_prisms_share_equally() {
        let cloud = lumped(
            vec![
                SolidCell::Prism([0, 1, 2, 4, 5, 6]),
                SolidCell::Tetrahedron([0, 2, 3, 7]),
            ],
            &[],
        );
        assert_eq!(cloud.volumes[0], 2.0 + 1.0);
        assert_eq!(cloud.volumes[1], 2.0);
        assert_eq!(cloud.volumes[7], 1.0);
        assert_eq!(cloud.volumes.iter().sum::<f64>(), 16.0);
    }
}
