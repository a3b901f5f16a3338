//! Parts of the geometry of lattice cells that differ between the plane and space.

use std::fmt::Debug;

use ligament_model::Canvas;
use ligament_model::cloud::lattice::Lattice;
use ligament_model::shape::{Region, Shape, SolidShape};

use super::interface::Origin;

/// Shapes of the holes of a lattice in D dimensions.
pub trait LatticeShape<const D: usize>: Region<D> + Debug + Send + 'static {
    /// A lattice as the origin of a body.
    fn origin(lattice: &Lattice<D, Self>) -> Origin<'_>;

    /// Cells for result files around some positions, given by half of their sides, m.
    fn canvas(positions: &[[f64; D]], half: [f64; D]) -> Canvas;
}

impl LatticeShape<2> for Shape {
    fn origin(lattice: &Lattice) -> Origin<'_> {
        Origin::Lattice(lattice)
    }

    fn canvas(positions: &[[f64; 2]], half: [f64; 2]) -> Canvas {
        let corners = |[x, y]: &[f64; 2]| {
            [[-1.0, -1.0], [1.0, -1.0], [1.0, 1.0], [-1.0, 1.0]]
                .map(|[right, up]| [x + right * half[0], y + up * half[1]])
        };
        Canvas::Around(positions.iter().map(corners).collect())
    }
}

impl LatticeShape<3> for SolidShape {
    fn origin(lattice: &Lattice<3, SolidShape>) -> Origin<'_> {
        Origin::SolidLattice(lattice)
    }

    fn canvas(positions: &[[f64; 3]], half: [f64; 3]) -> Canvas {
        let corners = |p: &[f64; 3]| {
            [-1.0, 1.0].map(|sign| [0, 1, 2].map(|axis| p[axis] + sign * half[axis]))
        };
        Canvas::Boxes(positions.iter().map(corners).collect())
    }
}
