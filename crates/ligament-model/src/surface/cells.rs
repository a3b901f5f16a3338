//! Faces between the cells of points, which become part of the surface of a body where it breaks.

use std::sync::Arc;

use super::{Corners, area_vector};
use crate::bonds::BondSet;
use crate::cloud::PointCloud;
use crate::contact::CutBond;
use crate::tensor::{dot, minus};
use crate::topology::Families;

/// A piece of the face between the cells of two points: a segment, or a triangle.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct InnerFace<const D: usize> {
    /// Points A < B.
    pub points: [u32; 2],
    /// Corners, m, in an order for which the normal points from A to B.
    pub corners: [[f64; D]; D],
}

/// Faces between the points of a body, by the bonds across them.
#[derive(Debug)]
pub struct Boundaries<const D: usize> {
    faces: Vec<InnerFace<D>>,
    /// Positions of the points, m.
    positions: Vec<[f64; D]>,
    thickness: f64,
    /// Bonds with the faces that they cross, ascending.
    of_bonds: Vec<(u32, u32)>,
    /// Faces along pre-cracks, ascending.
    cut: Vec<u32>,
}

/// Crack faces of a surface, with the side and the contact stiffness (Pa/m) for each point.
#[derive(Debug, Clone)]
pub struct CrackFaces<const D: usize> {
    /// Faces between points.
    pub boundaries: Arc<Boundaries<D>>,
    /// Side and contact stiffness of each point; none where its faces do not belong to the surface, shape (n_points).
    pub of_points: Vec<Option<(u32, f64)>>,
}

/// Unbroken bonds of a body.
#[derive(Debug, Clone, Copy)]
pub struct Bonded<'a> {
    /// Ends and families of all bonds.
    pub families: Families<'a>,
    /// Whether each bond is unbroken, shape (n_bonds).
    pub intact: &'a [bool],
}

impl Bonded<'_> {
    /// Whether an unbroken bond connects two points.
    pub(super) fn joins(&self, one: u32, other: u32) -> bool {
        bond_between(self.families, [one, other]).is_some_and(|it| self.intact[it as usize])
    }
}

/// The bond between two points; the neighbours of a point ascend in its list.
fn bond_between(families: Families<'_>, [one, other]: [u32; 2]) -> Option<u32> {
    let own = families.incidence.at(one);
    let place = own.binary_search_by_key(&other, |&bond| families.neighbour(bond, one));
    place.ok().map(|place| own[place])
}

impl<const D: usize> InnerFace<D> {
    /// The face between two points with given corners in any order, m.
    pub fn new(cloud: &PointCloud<D>, points: [u32; 2], corners: [[f64; D]; D]) -> Self {
        let points = [points[0].min(points[1]), points[0].max(points[1])];
        let [from, to] = points.map(|it| cloud.positions[it as usize]);
        let mut face = Self { points, corners };
        if dot(area_vector(&corners), minus(to, from)) < 0.0 {
            face.corners = turned_over(&corners);
        }
        face
    }
}

/// Corners in the reversed order, for the opposite side.
fn turned_over<const D: usize>(corners: &Corners<D>) -> Corners<D> {
    let mut corners = *corners;
    corners.swap(D - 2, D - 1);
    corners
}

impl<const D: usize> Boundaries<D> {
    /// Faces between the points of a cloud with its bonds and those that pre-cracks cut. Faces without a bond across them belong to no crack.
    pub fn new(
        mut faces: Vec<InnerFace<D>>,
        cloud: &PointCloud<D>,
        bonds: &BondSet<D>,
        cut: &[CutBond<D>],
    ) -> Self {
        faces.sort_by_key(|it| it.points);
        let families = Families {
            ends: &bonds.ends,
            incidence: &bonds.incidence,
            far_field: None,
        };
        let numbered = || (0..).zip(&faces);
        let bonded =
            numbered().filter_map(|(face, it)| Some((bond_between(families, it.points)?, face)));
        let mut of_bonds: Vec<(u32, u32)> = bonded.collect();
        of_bonds.sort_unstable();
        let mut parted: Vec<[u32; 2]> = cut.iter().map(|it| it.ends).collect();
        parted.sort_unstable();
        let is_cut = |it: &InnerFace<D>| parted.binary_search(&it.points).is_ok();
        let of_cut = numbered()
            .filter(|(_, it)| is_cut(it))
            .map(|(face, _)| face);
        Self {
            cut: of_cut.collect(),
            positions: cloud.positions.clone(),
            thickness: cloud.thickness,
            of_bonds,
            faces,
        }
    }

    /// Faces between points, by their points.
    pub(super) fn faces(&self) -> &[InnerFace<D>] {
        &self.faces
    }

    /// Faces along pre-cracks, ascending.
    pub(super) fn cut(&self) -> &[u32] {
        &self.cut
    }

    /// Faces that a bond crosses.
    pub(super) fn crossed_by(&self, bond: u32) -> impl Iterator<Item = u32> {
        let first = self.of_bonds.partition_point(|it| it.0 < bond);
        let own = self.of_bonds[first..]
            .iter()
            .take_while(move |it| it.0 == bond);
        own.map(|it| it.1)
    }

    /// The corners (m) of the side of a face that belongs to its first or its second point, in their order from outside, with the point and its
    /// position.
    pub(super) fn side(&self, face: usize, end: usize) -> (Corners<D>, u32, [f64; D]) {
        let InnerFace { points, corners } = &self.faces[face];
        let point = points[end];
        let corners = match end {
            0 => *corners,
            _ => turned_over(corners),
        };
        (corners, point, self.positions[point as usize])
    }

    /// Thickness of the body, m; 1 in space.
    pub(super) fn thickness(&self) -> f64 {
        self.thickness
    }
}

impl<const D: usize> CrackFaces<D> {
    /// Side and stiffness of a side of a face by its number, the first point first; none where it does not belong to the surface.
    pub(super) fn side_and_stiffness(&self, number: usize) -> Option<(u32, f64)> {
        let points = self.boundaries.faces()[number / 2].points;
        self.of_points[points[number % 2] as usize]
    }
}
