//! Facets of the outline of a lattice: the free faces of its cells, in space two triangles each.

use super::Corners;
use super::cell_facets::CellFaces;
use super::cells::InnerFace;
use super::facet::Facet;
use crate::cloud::PointCloud;
use crate::cloud::lattice::Lattice;
use crate::shape::Region;

impl<const D: usize> Facet<D> {
    /// Facets of the outline of a lattice, between the points of its cloud; all corners of a facet move with the point of its cell.
    pub fn outline<S: Region<D>>(lattice: &Lattice<D, S>, cloud: &PointCloud<D>) -> Vec<Self> {
        let faces = lattice.outline().into_iter();
        let facets = faces.flat_map(|face| {
            let centre = cloud.positions[face.point as usize];
            let sides = side_of_cell(lattice.spacing, centre, face.normal);
            sides.map(move |corners| Self::new(cloud, corners.map(|it| (face.point, it))))
        });
        facets.collect()
    }
}

impl<const D: usize> CellFaces<D> {
    /// The cells of a lattice around the points of its cloud.
    pub fn from_lattice<S: Region<D>>(lattice: &Lattice<D, S>, cloud: &PointCloud<D>) -> Self {
        let faces = lattice.inner_faces().into_iter();
        let inner = faces.flat_map(|(point, normal, other)| {
            let centre = cloud.positions[point as usize];
            let sides = side_of_cell(lattice.spacing, centre, normal);
            sides.map(move |corners| InnerFace::new(cloud, [point, other], corners))
        });
        Self {
            outline: Facet::outline(lattice, cloud),
            inner: inner.collect(),
        }
    }
}

/// Corners (m) of the facets of a side of a cell with a given spacing around a centre (m): one in the plane, in space four that meet in its middle.
fn side_of_cell<const D: usize>(
    spacing: [f64; D],
    centre: [f64; D],
    normal: [i8; D],
) -> impl Iterator<Item = Corners<D>> {
    let half = spacing.map(|side| 0.5 * side);
    let axis = (0..D).find(|&axis| normal[axis] != 0).unwrap_or(0);
    let outwards = f64::from(normal[axis]);
    let next = (axis + 1) % D;
    // In the plane (x, -y) and (y, x) are right-handed pairs of normal and direction, in space x, y and z in turn.
    let handed = if D == 2 && axis == 1 {
        -outwards
    } else {
        outwards
    };
    let corner = |along: f64, across: f64| {
        let mut position = centre;
        position[axis] += outwards * half[axis];
        position[next] += handed * along * half[next];
        if D > 2 {
            let last = (axis + 2) % D;
            position[last] += across * half[last];
        }
        position
    };
    let around = [(-1.0, -1.0), (1.0, -1.0), (1.0, 1.0), (-1.0, 1.0)];
    let corners = around.map(|(along, across)| corner(along, across));
    let middle = corner(0.0, 0.0);
    let starts = if D == 2 { 0..1 } else { 0..4 };
    starts.map(move |start| {
        std::array::from_fn(|place| match place {
            2 => middle,
            _ => corners[(start + place) % 4],
        })
    })
}

#[cfg(test)]
mod tests {
    use super::super::{area_vector, normal};
    use super::*;
    use crate::layout::{Component, Layout};
    use crate::shape::{Shape, SolidShape};
    use crate::tensor::dot;

    /// Facets face away from their cell, and their vector areas add up to zero, their areas to those of the faces.
    fn is_closed<const D: usize, S: Region<D>>(lattice: &Lattice<D, S>) {
        let materials = vec![0; lattice.cells.len()];
        let cloud = PointCloud::from_lattice(lattice, 1.0, &materials, 1);
        let layout = Layout {
            n_points: cloud.len(),
            components: &Component::in_dimensions(D)[..D],
        };
        let motions = vec![0.0; layout.n_degrees_of_freedom()];
        let (mut sum, mut area) = ([0.0; D], 0.0);
        for facet in Facet::outline(lattice, &cloud) {
            let corners = facet.moved(layout, &motions);
            let outward = normal(&corners).expect("faces of cells have an area");
            assert!(facet.corners.iter().all(|it| dot(it.arm, outward) > 0.0));
            let vector = area_vector(&corners);
            sum = std::array::from_fn(|axis| sum[axis] + vector[axis]);
            area += facet.area;
        }
        let sizes = lattice.outline().into_iter();
        let expected: f64 = sizes.map(|it| lattice.face_size(it.normal)).sum();
        assert!((area / expected - 1.0).abs() < 1e-14, "{area} {expected}");
        assert!(sum.iter().all(|it| it.abs() < 1e-14), "{sum:?}");
    }

    #[test]
    fn facets_enclose_a_lattice() {
        let hole = Shape::Circle {
            centre: [2.0, 2.0],
            radius: 0.8,
        };
        is_closed(&Lattice::new([5, 4], [1.0, 0.5], [0.0; 2], vec![hole]));
        let none: Vec<SolidShape> = Vec::new();
        is_closed(&Lattice::new([3, 2, 2], [1.0, 0.5, 0.7], [0.0; 3], none));
    }
}
