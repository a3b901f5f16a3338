//! Facets of the outline of a lattice: the free faces of its cells, in space two triangles each.

use super::facet::Facet;
use crate::cloud::PointCloud;
use crate::cloud::lattice::Lattice;
use crate::shape::Region;

impl<const D: usize> Facet<D> {
    /// Facets of the outline of a lattice, between the points of its cloud; all corners of a facet move with the point of its cell.
    pub fn of_lattice<S: Region<D>>(lattice: &Lattice<D, S>, cloud: &PointCloud<D>) -> Vec<Self> {
        let half = lattice.spacing.map(|side| 0.5 * side);
        let faces = lattice.outline().into_iter();
        let facets = faces.flat_map(|face| {
            let centre = cloud.positions[face.point as usize];
            let axis = (0..D).find(|&axis| face.normal[axis] != 0).unwrap_or(0);
            let outwards = f64::from(face.normal[axis]);
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
                (face.point, position)
            };
            let around = [(-1.0, -1.0), (1.0, -1.0), (1.0, 1.0), (-1.0, 1.0)];
            let corners = around.map(|(along, across)| corner(along, across));
            let starts = if D == 2 { 1..2 } else { 1..3 };
            starts.map(move |second| {
                let chosen = |place: usize| {
                    if place == 0 {
                        corners[0]
                    } else {
                        corners[second + place - 1]
                    }
                };
                Self::new(cloud, std::array::from_fn(chosen))
            })
        });
        facets.collect()
    }
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
        for facet in Facet::of_lattice(lattice, &cloud) {
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
