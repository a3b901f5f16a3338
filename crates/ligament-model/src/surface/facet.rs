//! Facets of the outline of a body, which move with its points.

use super::cells::{Boundaries, CrackFaces};
use super::rigid::largest_size;
use super::{Corners, Vector, area_vector, normal, weighted};
use crate::cloud::PointCloud;
use crate::layout::Layout;
use crate::tensor::{dot, minus, norm};

/// A corner of a facet, which moves with a point: x = X + u + phi x (X - X_point), linear in the rotation phi of the point; or the middle of four
/// points.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Corner<const D: usize> {
    /// Point with which the corner moves.
    pub point: u32,
    /// Further corners of a quadrangular side, whose middle this corner is: it moves by the mean of the displacements of all four points.
    pub others: Option<[u32; 3]>,
    /// Position X without motion, m.
    pub position: [f64; D],
    /// Arm X - X_point, m.
    pub arm: [f64; D],
}

/// A facet of the outline: a segment with the body on its left, or a triangle that is counter-clockwise from outside.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Facet<const D: usize> {
    /// Corners.
    pub corners: [Corner<D>; D],
    /// Area without motion, m^2: of a segment its length times the thickness.
    pub area: f64,
}

/// Facets of surfaces, each with the side to which it belongs.
#[derive(Debug, Clone)]
pub struct Surface<const D: usize> {
    pub(super) layout: Layout,
    pub(super) facets: Vec<Facet<D>>,
    /// Number of the side of each facet.
    pub(super) sides: Vec<u32>,
    /// Contact stiffness of each facet, Pa/m.
    pub(super) stiffness: Vec<f64>,
    /// Crack faces, which belong to the surface once they exist; numbered after the facets of the outline.
    pub(super) cracks: Option<CrackFaces<D>>,
}

impl<const D: usize> Corner<D> {
    /// Points with which the corner moves, each with its share in the motion.
    fn shares(&self) -> impl Iterator<Item = (u32, f64)> {
        let share = if self.others.is_some() { 0.25 } else { 1.0 };
        let points = std::iter::once(self.point).chain(self.others.into_iter().flatten());
        points.map(move |point| (point, share))
    }

    /// Displacement for the motions of all points (n_degrees_of_freedom), m.
    fn displacement(&self, layout: Layout, motions: &[f64]) -> [f64; D] {
        let motion = |point: u32| &motions[layout.range(point)];
        if self.others.is_some() {
            let sum = |axis: usize| self.shares().map(|it| motion(it.0)[axis]).sum::<f64>();
            return std::array::from_fn(|axis| 0.25 * sum(axis));
        }
        let motion = motion(self.point);
        let turned = rotated(&motion[D..], self.arm);
        std::array::from_fn(|axis| motion[axis] + turned[axis])
    }
}

impl<const D: usize> Facet<D> {
    /// A facet between corners, each a point and a position in the coordinates of the cloud.
    pub fn new(cloud: &PointCloud<D>, corners: [(u32, [f64; D]); D]) -> Self {
        let positions = corners.map(|(_, position)| position);
        let corner = |(point, position): (u32, [f64; D])| Corner {
            point,
            others: None,
            position,
            arm: minus(position, cloud.positions[point as usize]),
        };
        Self {
            corners: corners.map(corner),
            area: norm(area_vector(&positions)) * cloud.thickness,
        }
    }

    /// Facets of a side of the outline between points in their order from outside: one of a side of D points, of a quadrangle four triangles that
    /// meet in its middle, so that none of its diagonals is preferred.
    pub fn on_side(cloud: &PointCloud<D>, side: &[u32]) -> Vec<Self> {
        let corner = |point: u32| (point, cloud.positions[point as usize]);
        let &[a, b, c, d] = side else {
            let corners = std::array::from_fn(|place| corner(side[place]));
            return vec![Self::new(cloud, corners)];
        };
        let sum = |axis: usize| side.iter().map(|&it| corner(it).1[axis]).sum::<f64>();
        let middle: [f64; D] = std::array::from_fn(|axis| 0.25 * sum(axis));
        let edges = [[a, b, c, d], [b, c, d, a], [c, d, a, b], [d, a, b, c]];
        let triangle = |[from, to, third, fourth]: [u32; 4]| {
            let place = |place: usize| [corner(from), corner(to), (from, middle)][place];
            let mut facet = Self::new(cloud, std::array::from_fn(place));
            facet.corners[D - 1].others = Some([to, third, fourth]);
            facet.corners[D - 1].arm = [0.0; D];
            facet
        };
        edges.map(triangle).to_vec()
    }

    /// A side of a face between points by its number: two for each face, of its first and of its second point, with which it moves.
    fn at_face(boundaries: &Boundaries<D>, number: usize) -> Self {
        let (corners, point, centre) = boundaries.side(number / 2, number % 2);
        Self {
            area: norm(area_vector(&corners)) * boundaries.thickness(),
            corners: corners.map(|position| Corner {
                point,
                others: None,
                position,
                arm: minus(position, centre),
            }),
        }
    }

    /// The points with which its corners move, corner by corner.
    pub fn points(&self) -> impl Iterator<Item = u32> {
        let corners = self.corners.into_iter();
        corners.flat_map(|it| it.shares().map(|it| it.0).collect::<Vec<_>>())
    }

    /// Distance of its plane from its first point, m: positive where the point is behind it.
    pub(super) fn depth(&self) -> f64 {
        let positions = self.corners.map(|it| it.position);
        normal(&positions).map_or(0.0, |it| dot(self.corners[0].arm, it))
    }

    /// Length of its longest edge, m.
    pub(super) fn length(&self) -> f64 {
        let positions = self.corners.map(|it| it.position);
        let edges = (0..D).map(|it| norm(minus(positions[(it + 1) % D], positions[it])));
        edges.fold(0.0, f64::max)
    }

    /// Present positions of the corners for the motions of all points (n_degrees_of_freedom), m.
    pub(super) fn moved(&self, layout: Layout, motions: &[f64]) -> Corners<D> {
        self.corners.map(|corner| {
            let moved = corner.displacement(layout, motions);
            std::array::from_fn(|axis| corner.position[axis] + moved[axis])
        })
    }

    /// Displacement of a position on the facet for the motions of all points (n_degrees_of_freedom), m.
    pub(super) fn motion(&self, layout: Layout, weights: &[f64], motions: &[f64]) -> [f64; D] {
        let moved = self.corners.map(|it| it.displacement(layout, motions));
        weighted(&moved, weights)
    }

    /// Adds a force (N) on a place of the facet to the forces and moments on its points, shape (n_degrees_of_freedom).
    pub(super) fn add_force(
        &self,
        layout: Layout,
        weights: &[f64],
        force: [f64; D],
        forces: &mut [f64],
    ) {
        let corners = self.corners.iter().zip(weights);
        let shares = corners.flat_map(|(corner, weight)| {
            let shares = corner.shares();
            shares.map(move |(point, share)| (corner, point, share * weight))
        });
        for (corner, point, weight) in shares {
            let own = &mut forces[layout.range(point)];
            let part = force.map(|it| weight * it);
            for (sum, value) in own.iter_mut().zip(part) {
                *sum += value;
            }
            let moment = moment(corner.arm, part);
            let moments = if D == 2 { &moment[2..] } else { &moment[..] };
            for (sum, value) in own[D..].iter_mut().zip(moments) {
                *sum += value;
            }
        }
    }

    /// Degrees of freedom and coefficients c of the motion of a place of the facet along a direction d, d . u = c . u: the forces and moments of
    /// a unit force along d, corner by corner.
    pub(super) fn row(
        &self,
        layout: Layout,
        weights: &[f64],
        direction: [f64; D],
    ) -> Vec<(usize, f64)> {
        let mut row = Vec::new();
        for (corner, weight) in self.corners.iter().zip(weights) {
            for (point, share) in corner.shares() {
                let part = direction.map(|it| share * weight * it);
                let moment = moment(corner.arm, part);
                let moments = if D == 2 { &moment[2..] } else { &moment[..] };
                let values = part.iter().chain(moments).copied();
                row.extend(layout.range(point).zip(values));
            }
        }
        row
    }
}

/// Displacement phi x r of an arm by the rotations of its point: one in the plane, three in space, or none.
fn rotated<const D: usize>(rotations: &[f64], arm: [f64; D]) -> [f64; D] {
    match *rotations {
        [angle] => std::array::from_fn(|axis| angle * if axis == 0 { -arm[1] } else { arm[0] }),
        [_, _, _] => std::array::from_fn(|axis| {
            let (next, last) = ((axis + 1) % D, (axis + 2) % D);
            rotations[next] * arm[last] - rotations[last] * arm[next]
        }),
        _ => [0.0; D],
    }
}

/// Moment r x f of a force at an arm, N m.
fn moment<const D: usize>(arm: [f64; D], force: [f64; D]) -> Vector {
    let product = |one: usize, other: usize| arm[one] * force[other] - arm[other] * force[one];
    if D == 2 {
        [0.0, 0.0, product(0, 1)]
    } else {
        [product(1, 2), product(2, 0), product(0, 1)]
    }
}

impl<const D: usize> Surface<D> {
    /// A surface of facets with the side and the contact stiffness (Pa/m) of each, for points with a layout.
    pub fn new(layout: Layout, facets: Vec<(Facet<D>, u32, f64)>) -> Self {
        let mut surface = Self {
            layout,
            facets: Vec::with_capacity(facets.len()),
            sides: Vec::with_capacity(facets.len()),
            stiffness: Vec::with_capacity(facets.len()),
            cracks: None,
        };
        for (facet, side, stiffness) in facets {
            surface.facets.push(facet);
            surface.sides.push(side);
            surface.stiffness.push(stiffness);
        }
        surface
    }

    /// The surface with crack faces, which belong to it once they exist. All its facets move with one point each.
    #[must_use]
    pub fn with_cracks(mut self, cracks: CrackFaces<D>) -> Self {
        self.cracks = Some(cracks);
        self
    }

    /// Facets of the outline.
    pub fn facets(&self) -> &[Facet<D>] {
        &self.facets
    }

    /// Number of the facets of the outline and of all possible crack faces.
    pub(super) fn n_facets(&self) -> usize {
        let cracks = self.cracks.as_ref().map(|it| it.boundaries.faces().len());
        self.facets.len() + 2 * cracks.unwrap_or(0)
    }

    /// A facet by its number.
    pub(super) fn facet(&self, number: usize) -> Facet<D> {
        match (number.checked_sub(self.facets.len()), &self.cracks) {
            (Some(beyond), Some(cracks)) => Facet::at_face(&cracks.boundaries, beyond),
            (Some(_), None) | (None, _) => self.facets[number],
        }
    }

    /// Side and stiffness (Pa/m) of a facet by its number; none for a crack face that does not belong to the surface.
    pub(super) fn side_and_stiffness(&self, number: usize) -> Option<(u32, f64)> {
        match (number.checked_sub(self.facets.len()), &self.cracks) {
            (Some(beyond), Some(cracks)) => cracks.side_and_stiffness(beyond),
            (Some(_), None) | (None, _) => Some((self.sides[number], self.stiffness[number])),
        }
    }

    /// Numbers of the facets on both sides of some faces between points, where they belong to the surface.
    pub(super) fn facets_at(&self, faces: impl Iterator<Item = u32>) -> Vec<u32> {
        let n_outline = self.facets.len() as u32;
        let both = faces.flat_map(|face| [0, 1].map(|end| n_outline + 2 * face + end));
        both.filter(|&it| self.side_and_stiffness(it as usize).is_some())
            .collect()
    }

    /// Facets that belong to the surface or may do so, with their numbers.
    pub(super) fn all(&self) -> impl Iterator<Item = (usize, Facet<D>)> {
        let outline = self.facets.iter().copied().enumerate();
        let n_outline = self.facets.len();
        let others = n_outline..self.n_facets();
        let others = others.filter(|&it| self.side_and_stiffness(it).is_some());
        outline.chain(others.map(|it| (it, self.facet(it))))
    }

    /// Largest length of an edge, m.
    pub(super) fn largest_length(&self) -> f64 {
        self.all().map(|it| it.1.length()).fold(0.0, f64::max)
    }

    /// Largest coordinate of a corner without motion, m.
    pub(super) fn largest_coordinate(&self) -> f64 {
        let corners = self.all().flat_map(|it| it.1.corners);
        (corners.flat_map(|it| it.position)).fold(0.0, largest_size)
    }

    /// Largest stiffness of a facet, Pa/m.
    pub(super) fn largest_stiffness(&self) -> f64 {
        let cracks = self.cracks.iter().flat_map(|it| &it.of_points).flatten();
        let all = self.stiffness.iter().copied().chain(cracks.map(|it| it.1));
        all.fold(0.0, f64::max)
    }

    /// Mean stiffness of the facets of the outline of each side over their areas, Pa/m.
    pub(super) fn mean_stiffness(&self) -> Vec<f64> {
        let n_sides = self.sides.iter().max().map_or(0, |it| *it as usize + 1);
        let mut sums = vec![[0.0; 2]; n_sides];
        for ((facet, side), stiffness) in self.facets.iter().zip(&self.sides).zip(&self.stiffness) {
            let [area, weighted] = &mut sums[*side as usize];
            *area += facet.area;
            *weighted += facet.area * stiffness;
        }
        sums.iter()
            .map(|[area, weighted]| weighted / area)
            .collect()
    }

    /// Degrees of freedom of the points of the facets, ascending.
    pub(super) fn degrees_of_freedom(&self) -> Vec<u32> {
        let points = self.all().flat_map(|it| it.1.points().collect::<Vec<_>>());
        let mut points: Vec<u32> = points.collect();
        points.sort_unstable();
        points.dedup();
        let of_point = |point: u32| self.layout.range(point).map(|it| it as u32);
        points.into_iter().flat_map(of_point).collect()
    }

    /// Adds a stiffness (N/m) against motions of a place of a facet to that at the degrees of freedom of its points, so that their diagonal
    /// matrix is above it: with (u + phi x r)^2 <= 3 u^2 + 3/2 r^2 phi^2, which suits a cube, where points have rotations. `along` has the
    /// shares of the axes: 1 where the stiffness acts in all directions.
    pub(super) fn add_bound(
        &self,
        (facet, weights): (&Facet<D>, &[f64]),
        stiffness: f64,
        along: [f64; D],
        sums: &mut [f64],
    ) {
        let Facet { corners, .. } = facet;
        let is_one = |it: &Corner<D>| it.point == corners[0].point && it.others.is_none();
        let moves_as_one = corners.iter().all(is_one);
        let mean = weighted(&corners.map(|it| it.arm), weights);
        let weighted = corners.iter().zip(weights);
        let shares = weighted.flat_map(|(corner, weight)| {
            let shares = corner.shares();
            shares.map(move |(point, share)| (corner, point, share * weight * stiffness))
        });
        for (corner, point, share) in shares {
            let own = &mut sums[self.layout.range(point)];
            let has_rotations = own.len() > D;
            let (moves, turns) = own.split_at_mut(D);
            let arm = if moves_as_one { mean } else { corner.arm };
            for (sum, along) in moves.iter_mut().zip(along) {
                *sum += along * if has_rotations { 3.0 * share } else { share };
            }
            for sum in turns {
                *sum += 1.5 * dot(arm, arm) * share;
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::layout::Component;

    /// The work of a force on the motion of its place is that of the forces and moments on the points.
    #[test]
    fn forces_do_the_work_of_their_place() {
        let cloud =
            PointCloud::<3>::from_points(&[[0.0; 3], [1.0, 0.0, 0.0]], &[1.0; 2], 1.0, &[0, 0], 1);
        let corners = [
            (0, [0.1, 0.2, 0.3]),
            (1, [0.9, 0.0, -0.4]),
            (0, [0.5, 1.0, 0.0]),
        ];
        let facet = Facet::new(&cloud, corners);
        let layout = Layout {
            n_points: 2,
            components: &Component::IN_SPACE,
        };
        let motions: Vec<f64> = (0..12).map(|it| (f64::from(it) * 0.7).sin()).collect();
        let (weights, force) = ([0.2, 0.5, 0.3], [1.0, -2.0, 0.5]);
        let place = |motions: &[f64]| weighted(&facet.moved(layout, motions), &weights);
        let way = minus(place(&motions), place(&[0.0; 12]));
        let mut forces = vec![0.0; 12];
        facet.add_force(layout, &weights, force, &mut forces);
        let work: f64 = forces.iter().zip(&motions).map(|(f, u)| f * u).sum();
        assert!((work - dot(way, force)).abs() < 1e-14);
    }
}
