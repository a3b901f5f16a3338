//! The outline of a body of cells, each of which moves with its point.

use super::cells::InnerFace;
use super::facet::Facet;
use crate::cloud::PointCloud;

/// Faces of the cells around the points of a body: faces of the outline, each of which moves with one point, and faces between two points.
#[derive(Debug, Clone)]
pub struct CellFaces<const D: usize> {
    /// Facets of the outline.
    pub outline: Vec<Facet<D>>,
    /// Faces between two points.
    pub inner: Vec<InnerFace<D>>,
}

impl<const D: usize> CellFaces<D> {
    /// Facets of sides of the outline between points (segments with the body on the left, triangles and quadrangles counter-clockwise from
    /// outside), cut in the middle between their points.
    pub fn outline(cloud: &PointCloud<D>, sides: &[Vec<u32>]) -> Vec<Facet<D>> {
        let at = |point: u32| cloud.positions[point as usize];
        let mut parts = Vec::new();
        for side in sides {
            let positions: Vec<[f64; D]> = side.iter().map(|&it| at(it)).collect();
            let middle = mean(&positions);
            // A segment is no ring.
            let starts = if D == 2 { 1 } else { side.len() };
            for start in 0..starts {
                let ends = [side[start], side[(start + 1) % side.len()]];
                let [from, to] = ends.map(at);
                let half = mean(&[from, to]);
                let facet = |point: u32, one: [f64; D], other: [f64; D]| {
                    let corner = |place: usize| [one, other, middle][place];
                    Facet::new(cloud, std::array::from_fn(|place| (point, corner(place))))
                };
                parts.extend([facet(ends[0], from, half), facet(ends[1], half, to)]);
            }
        }
        parts
    }
}

/// Mean of positions.
fn mean<const D: usize>(positions: &[[f64; D]]) -> [f64; D] {
    let count = positions.len() as f64;
    std::array::from_fn(|axis| positions.iter().map(|it| it[axis]).sum::<f64>() / count)
}
