//! Cracks as triangles.

/// Cracks of a solid as triangles.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct CrackSurface {
    /// Positions of the corners, each in the middle of an edge, a face or a tetrahedron between sides, shape (n_places), m.
    pub places: Vec<[f64; 3]>,
    /// Pairs of neighbouring points separated at each place, the lower one first, shape (n_places).
    pub parted: Vec<Vec<[u32; 2]>>,
    /// Corners of the triangles, counter-clockwise seen from the same side of a part, shape (n_triangles).
    pub triangles: Vec<[u32; 3]>,
    /// Whether each triangle belongs to a pre-crack: all its separated pairs were cut before the first load, shape (n_triangles).
    pub is_precrack: Vec<bool>,
    /// Connected part of each triangle, from 0, the largest first, shape (n_triangles).
    pub part: Vec<u32>,
}
