//! The outline of a body of cells, each of which moves with its point.

use super::cells::InnerFace;
use super::facet::Facet;
use crate::cloud::PointCloud;

/// The cells around the points of a body by their faces: those of the outline, each of which moves with one point, and those between two points.
#[derive(Debug, Clone)]
pub struct CellFaces<const D: usize> {
    /// Facets of the outline.
    pub outline: Vec<Facet<D>>,
    /// Faces between two points.
    pub inner: Vec<InnerFace<D>>,
}

impl<const D: usize> CellFaces<D> {
    /// Facets of sides of the outline between points (segments with the body on the left, triangles counter-clockwise from outside), cut in
    /// the middle between their points.
    pub fn outline(cloud: &PointCloud<D>, sides: &[[u32; D]]) -> Vec<Facet<D>> {
        let at = |point: u32| cloud.positions[point as usize];
        let parts = sides.iter().flat_map(|side| {
            let middle = mean(side.map(at));
            let starts = 0..if D == 2 { 1 } else { D };
            starts.flat_map(move |start| {
                let ends = [side[start], side[(start + 1) % D]];
                let [from, to] = ends.map(at);
                let half = mean([from, to]);
                let facet = |point: u32, one: [f64; D], other: [f64; D]| {
                    let corner = |place: usize| [one, other, middle][place];
                    Facet::new(cloud, std::array::from_fn(|place| (point, corner(place))))
                };
                [facet(ends[0], from, half), facet(ends[1], half, to)]
            })
        });
        parts.collect()
    }
}

/// Mean of positions.
fn mean<const D: usize, const N: usize>(positions: [[f64; D]; N]) -> [f64; D] {
    std::array::from_fn(|axis| positions.iter().map(|it| it[axis]).sum::<f64>() / N as f64)
}
