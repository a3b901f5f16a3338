//! A regular lattice in space: points at the centres of the cells of a box, some of which may be removed.

use super::shape::SolidShape;
use crate::cloud::lattice::Lattice;

/// A box of equal cells without those that holes take away.
pub type SolidLattice = Lattice<3, SolidShape>;

#[cfg(test)]
mod tests {
    use super::*;
    use crate::bonds::hole::bonds_across;
    use crate::horizon::Horizons;
    use crate::{BondSet, PointCloud};

    fn drilled() -> SolidLattice {
        let hole = SolidShape::Cylinder {
            ends: [[2.5, 2.0, 0.0], [2.5, 2.0, 3.0]],
            radius: 0.6,
        };
        SolidLattice::new([5, 4, 3], [1.0, 1.0, 0.5], [0.0; 3], vec![hole])
    }

    #[test]
    fn cells_in_holes_are_none() {
        let lattice = drilled();
        // The centres at (2.5, 1.5) and (2.5, 2.5) of three layers.
        assert_eq!((lattice.n_whole(), lattice.cells.len()), (60, 54));
        assert_eq!(lattice.point_in([2, 1, 0]), None);
        assert_eq!(lattice.point_in([-1, 0, 0]), None);
        for (number, cell) in (0..).zip(&lattice.cells) {
            assert_eq!(lattice.point_in(cell.map(i64::from)), Some(number));
        }
        assert_eq!(lattice.middle(), [2.5, 2.0, 0.75]);
        assert_eq!(lattice.offset([4, 0, 2]), [2.0, -1.5, 0.5]);
    }

    /// The vector areas of a closed surface cancel; those of the box are its own, and a cell has six sides.
    #[test]
    fn the_outline_is_closed() {
        let lattice = drilled();
        let outline = lattice.outline();
        let mut sum = [0.0; 3];
        for face in &outline {
            let area = lattice.face_size(face.normal);
            sum = [0, 1, 2].map(|axis| sum[axis] + area * f64::from(face.normal[axis]));
        }
        assert_eq!(sum, [0.0; 3]);
        assert_eq!(outline.len() + 2 * lattice.inner_faces().len(), 6 * 54);
        let at_hole = outline.iter().filter(|face| face.hole.is_some());
        // Two cells side by side have six sides each layer; those beyond the box above and below are in the cylinder too.
        let inside = at_hole.clone().filter(|face| !face.is_on_box);
        assert_eq!((at_hole.count(), inside.count()), (18, 18));
        assert_eq!(lattice.face_size([0, 0, 1]), 1.0);
        assert_eq!(lattice.face_size([0, -1, 0]), 0.5);
    }

    #[test]
    fn sets_are_layers_and_shapes() {
        let lattice = drilled();
        assert_eq!(lattice.points_at_side([-1, 0, 0], 1).len(), 12);
        assert_eq!(lattice.points_at_side([0, 0, 1], 2).len(), 36);
        let ball = SolidShape::Sphere {
            centre: [0.5, 0.5, 0.25],
            radius: 1.0,
        };
        let found = lattice.points_in(&ball);
        // Itself, the two beside it, and two layers up: 0.5 and 1.
        let expected: Vec<u32> = [[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1], [0, 0, 2]]
            .iter()
            .filter_map(|cell| lattice.point_in(*cell))
            .collect();
        let mut found_cells = expected.clone();
        found_cells.sort_unstable();
        assert_eq!(found, found_cells);
    }

    #[test]
    fn bonds_across_a_hole_are_none() {
        let lattice = drilled();
        let cloud = PointCloud::from_lattice(&lattice, 1.0, &[0; 54], 1);
        assert_eq!(cloud.volumes.iter().sum::<f64>(), 27.0);
        assert!(cloud.spacing.iter().all(|it| *it == 0.5));
        let bonds = BondSet::search(&cloud, &Horizons::unified(2.0, 54));
        let across = bonds_across(&lattice.holes, &bonds, &cloud);
        let bond = |a: [i64; 3], b: [i64; 3]| {
            let ends = [a, b].map(|cell| lattice.point_in(cell).unwrap_or(u32::MAX));
            bonds
                .ends
                .iter()
                .position(|it| *it == ends)
                .map(|it| across[it])
        };
        assert_eq!(bond([1, 1, 0], [3, 1, 0]), Some(true), "through the hole");
        assert_eq!(bond([2, 0, 0], [2, 0, 2]), Some(false), "beside it");
        assert_eq!(bond([1, 0, 0], [3, 0, 0]), Some(false), "beside it");
    }
}
