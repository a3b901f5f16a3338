//! Surfaces of bodies, rigid shapes, and the contact between them with friction, for motions in time.
//!
//! A [`Surface`] consists of the facets of the outline: segments in the plane, triangles in space. Each corner of a facet moves with a
//! point of the body. Integration points on the facets are compared with the facet of another surface that they meet, or with a
//! [`RigidShape`], in present positions ([`SurfacePair`]). All normals belong to the other surface.
//!
//! With the gap g of an integration point along the normal n, the part A of the area that it stands for and the stiffness k of the contact,
//! the force on its surface is
//!
//! F = k A (<g_0 - g> n - s), |s| <= mu <g_0 - g>,
//!
//! and the opposite one acts on the surface that is met: a penalty against penetration, and Coulomb's friction by return mapping, where the
//! elastic part s of the sliding keeps its size at most (Wriggers 2006, chapters 5 and 10). The energy 1/2 k A
//! (<g_0 - g>^2 + |s|^2) is stored. The depth g_0 <= 0 is the overlap that a contact was found with beyond what the step explains: at the
//! start, or where surfaces are born that overlap. Nothing jumps there; g_0 follows the gap as it opens, and is never restored.

mod cell_facets;
mod cells;
mod facet;
mod facet_pair;
mod lattice;
mod nearest;
mod pair;
mod rigid;
mod search;
mod touch;
mod undeformed;

pub use cell_facets::CellFaces;
pub use cells::{Bonded, Boundaries, CrackFaces, InnerFace};
pub use facet::{Corner, Facet, Surface};
pub use facet_pair::{FacetPair, Opposite};
pub use pair::{Missed, Pose, Step, SurfacePair};
pub use rigid::RigidShape;
pub use search::Search;
pub use touch::{Touch, Vector};
pub use undeformed::UndeformedPair;

use crate::tensor::{dot, minus, norm};

/// Positions of the corners of a facet, m.
type Corners<const D: usize> = [[f64; D]; D];

/// Outward unit normal of a facet in the order of its corners; `None` for a facet without area.
fn normal<const D: usize>(corners: &Corners<D>) -> Option<[f64; D]> {
    let vector = area_vector(corners);
    let size = norm(vector);
    (size > 0.0).then(|| vector.map(|it| it / size))
}

/// Largest distance of a corner of a facet from its first one, m.
fn extent<const D: usize>(corners: &Corners<D>) -> f64 {
    let distances = corners.iter().map(|it| norm(minus(*it, corners[0])));
    distances.fold(0.0, f64::max)
}

/// Outward normal of a facet times its length in the plane, m, or its area in space, m^2: the body is on the left of a segment, and
/// triangles are counter-clockwise from outside.
fn area_vector<const D: usize>(corners: &Corners<D>) -> [f64; D] {
    let edge = |corner: usize| minus(corners[corner], corners[0]);
    if D == 2 {
        let along = edge(1);
        return std::array::from_fn(|axis| if axis == 0 { along[1] } else { -along[0] });
    }
    let [one, other] = [edge(1), edge(2)];
    std::array::from_fn(|axis| {
        let (next, last) = ((axis + 1) % D, (axis + 2) % D);
        0.5 * (one[next] * other[last] - one[last] * other[next])
    })
}

/// Mean of the corners with weights (D, further ones are not used).
fn weighted<const D: usize>(corners: &Corners<D>, weights: &[f64]) -> [f64; D] {
    let mut sum = [0.0; D];
    for (corner, weight) in corners.iter().zip(weights) {
        for (sum, value) in sum.iter_mut().zip(corner) {
            *sum += weight * value;
        }
    }
    sum
}

/// Part of a vector across a unit normal.
fn tangential<const D: usize>(vector: [f64; D], normal: [f64; D]) -> [f64; D] {
    let along = dot(vector, normal);
    std::array::from_fn(|axis| vector[axis] - along * normal[axis])
}
