//! The body of a starter case.

use ligament_mesh::Group;

/// What the case is about.
pub(in crate::starter) struct Body<const D: usize> {
    /// Name of the body, for the title.
    pub(in crate::starter) name: String,
    /// Where it comes from.
    pub(in crate::starter) section: Section<D>,
    /// Groups with a material each; none where one material fills the body.
    pub(in crate::starter) parts: Vec<String>,
    /// The lowest and the highest corner of the box around it, m.
    pub(in crate::starter) extent: [[f64; D]; 2],
    /// Where it is in the middle, m.
    pub(in crate::starter) middle: [f64; D],
    /// Two places on it whose distance along the load is an opening, m.
    pub(in crate::starter) opening: [[f64; D]; 2],
    /// Distance of the points, m.
    pub(in crate::starter) spacing: f64,
}

/// Where a body comes from.
pub(in crate::starter) enum Section<const D: usize> {
    /// From a mesh file.
    Mesh { file: String, groups: Vec<Group> },
    /// From a lattice; so many rows or layers are held, and so many are moved.
    Lattice { cells: [u32; D], rows: u32 },
}

/// Side of the box around a body along an axis, m.
pub(super) fn size<const D: usize>(body: &Body<D>, axis: usize) -> f64 {
    body.extent[1][axis] - body.extent[0][axis]
}
