//! The body of a starter case.

use ligament_mesh::Group;

/// Body of a starter case.
pub(in crate::starter) struct Body<const D: usize> {
    /// Name of the body, for the title.
    pub(in crate::starter) name: String,
    /// Origin of the body.
    pub(in crate::starter) section: Section<D>,
    /// Groups with a material each; empty where one material fills the body.
    pub(in crate::starter) parts: Vec<String>,
    /// Lowest and highest corner of the body's bounding box, m.
    pub(in crate::starter) extent: [[f64; D]; 2],
    /// Position in the middle of the body, m.
    pub(in crate::starter) middle: [f64; D],
    /// Two positions on the body whose distance along the load is an opening, m.
    pub(in crate::starter) opening: [[f64; D]; 2],
    /// Spacing of the points, m.
    pub(in crate::starter) spacing: f64,
}

/// Origin of a body.
pub(in crate::starter) enum Section<const D: usize> {
    /// Body from a mesh file.
    Mesh { file: String, groups: Vec<Group> },
    /// Body from a lattice, with `rows` rows or layers fixed and as many moved.
    Lattice { cells: [u32; D], rows: u32 },
}

/// Side of the box around a body along an axis, m.
pub(super) fn size<const D: usize>(body: &Body<D>, axis: usize) -> f64 {
    body.extent[1][axis] - body.extent[0][axis]
}
