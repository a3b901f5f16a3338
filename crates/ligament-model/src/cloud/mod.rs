//! Material points, from a mesh (`lumping.rs`), a regular lattice ([`lattice`]) or arrays (`points.rs`).

pub mod lattice;
pub(crate) mod lumping;
mod points;
mod precision;

use std::borrow::Cow;
use std::sync::Arc;

use ligament_mesh::Numbering;
use rstar::RTree;
use rstar::primitives::GeomWithData;

use crate::communicator::Communicator;
use crate::geometry::bounding_box;
use crate::ghosts::Ghosts;
use crate::parallel;
use crate::subdomain::{Partition, Subdomain};
use crate::tensor::{dot, minus, norm};

/// Material points with their volumes, nearest-neighbour distances and materials.
///
/// Positions are stored relative to the middle of the bounding box: differences of coordinates of a body far from the origin would lose
/// digits. [`PointCloud::local`] converts a position of the case to these coordinates. Points lie in the plane, or for D = 3 in space.
#[derive(Debug, Clone)]
pub struct PointCloud<const D: usize = 2> {
    /// Positions X_i relative to [`PointCloud::origin`], shape (n_points), m.
    pub positions: Vec<[f64; D]>,
    /// Uncertainty of the coordinates of the case, m.
    pub precision: f64,
    /// Middle of the bounding box, which is subtracted from the positions of the mesh file or the lattice, m.
    pub origin: [f64; D],
    /// Thickness t, m; 1 in space.
    pub thickness: f64,
    /// Volumes V_i, shape (n_points), m^3.
    pub volumes: Arc<[f64]>,
    /// Distance to the nearest point dmin_i, shape (n_points), m.
    pub spacing: Arc<[f64]>,
    /// Sides of the points' cells on a lattice, where they are equal, m; `None` on a mesh.
    pub lattice_cell: Option<[f64; D]>,
    /// Number of materials.
    pub n_materials: usize,
    /// Fraction of each material in the volume of each point, shape (n_points, n_materials) row-major; rows sum to one.
    pub material_shares: Vec<f64>,
    /// All points in the order of a Hilbert curve, shape (n_points), for loops over the neighbours of points.
    pub curve: Vec<u32>,
    /// Numbering of the points, internal and in the file.
    pub numbering: Numbering,
    /// Points of this process.
    pub subdomain: Subdomain,
}

/// A point of the search tree, with its number.
pub(crate) type NumberedPoint<const D: usize = 2> = GeomWithData<[f64; D], u32>;

impl<const D: usize> PointCloud<D> {
    /// Sides of the cell of a point, m: a cell of a lattice; on a mesh the square with the point's area V/t, or the cube with its volume.
    pub fn cell_size(&self, point: u32) -> [f64; D] {
        self.lattice_cell.unwrap_or_else(|| {
            let size = self.volumes[point as usize] / self.thickness;
            [if D == 2 { size.sqrt() } else { size.cbrt() }; D]
        })
    }

    /// Squared radius of gyration of a point's cell about its centre, m^2: (dx^2 + dy^2)/12, in space the mean over the axes (dx^2 + dy^2 +
    /// dz^2)/18.
    pub fn squared_gyration(&self, point: u32) -> f64 {
        let sides = self.cell_size(point);
        dot(sides, sides) / (6 * D) as f64
    }

    /// Number of points.
    pub fn len(&self) -> usize {
        self.positions.len()
    }

    /// Whether the cloud has no point.
    pub fn is_empty(&self) -> bool {
        self.positions.is_empty()
    }

    /// A value for each point, shape (n_points), computed in parallel along the curve.
    pub(crate) fn over_points<T: Copy + Default + Send>(
        &self,
        value: impl Fn(u32) -> T + Sync,
    ) -> Vec<T> {
        self.over_some(&self.curve, T::default(), value)
    }

    /// Values of each point from its bonds, shape (n_points, N): computed at owned points, in parallel along the curve; other processes send
    /// theirs.
    pub fn over_families<const N: usize>(
        &self,
        values: impl Fn(u32) -> [f64; N] + Sync,
    ) -> Vec<[f64; N]> {
        let mut all = self.over_some(&self.owned_along_curve(), [0.0; N], values);
        Ghosts::all(&self.subdomain).update(all.as_flattened_mut(), N);
        all
    }

    /// Values of `points` by a function, and one value for all other points, shape (n_points).
    fn over_some<T: Copy + Send>(
        &self,
        points: &[u32],
        of_others: T,
        value: impl Fn(u32) -> T + Sync,
    ) -> Vec<T> {
        let in_order = parallel::values(points.len(), of_others, |place| value(points[place]));
        let mut values = vec![of_others; self.len()];
        for (&point, &value) in points.iter().zip(&in_order) {
            values[point as usize] = value;
        }
        values
    }

    /// Owned points in the order of the curve.
    pub(crate) fn owned_along_curve(&self) -> Cow<'_, [u32]> {
        if self.subdomain.is_whole() {
            return Cow::Borrowed(&self.curve);
        }
        let points = self.curve.iter().copied();
        points.filter(|&it| self.subdomain.owns(it)).collect()
    }

    /// Converts a position of the case to the coordinates of [`PointCloud::positions`].
    pub fn local(&self, position: [f64; D]) -> [f64; D] {
        minus(position, self.origin)
    }

    /// Fractions of the materials in the volume of a point, shape (n_materials).
    pub fn shares(&self, point: usize) -> &[f64] {
        &self.material_shares[point * self.n_materials..(point + 1) * self.n_materials]
    }

    /// Volume-weighted mean of a property of the materials (n_materials) at a point.
    pub fn mean_property(&self, point: usize, property: &[f64]) -> f64 {
        self.shares(point)
            .iter()
            .zip(property)
            .map(|(share, value)| share * value)
            .sum()
    }

    /// The point nearest to a position of the case (the one with the smallest number in the file where several are, up to rounding).
    ///
    /// # Panics
    ///
    /// Panics if the cloud has no point, which no mesh or lattice with a cell gives.
    pub fn nearest_point(&self, position: [f64; D]) -> u32 {
        let target = self.local(position);
        let nearest = (self.positions.iter())
            .map(|&p| distance(p, target))
            .fold(f64::INFINITY, f64::min);
        let is_nearest = |&point: &u32| {
            distance(self.positions[point as usize], target) <= nearest + self.slack(point)
        };
        (0..self.len() as u32)
            .map(|in_file| self.numbering.point(in_file))
            .find(is_nearest)
            .expect("a cloud has points")
    }

    /// Points nearest to many positions of the case, by a search tree; any of several at one distance.
    ///
    /// # Panics
    ///
    /// Panics if the cloud has no point, which no mesh or lattice with a cell gives.
    pub fn nearest_points(&self, positions: &[[f64; D]]) -> Vec<u32> {
        let tree = search_tree(&self.positions);
        let nearest = |&position: &[f64; D]| {
            let found = tree.nearest_neighbor(self.local(position));
            found.expect("a cloud has points").data
        };
        positions.iter().map(nearest).collect()
    }

    /// Points inside a box (coordinates of the case, rim included), ascending.
    pub fn points_in_box(&self, lower: [f64; D], upper: [f64; D]) -> Vec<u32> {
        let (lower, upper) = (self.local(lower), self.local(upper));
        (0..self.len())
            .filter(|&point| {
                let (p, slack) = (self.positions[point], self.slack(point as u32));
                (0..D).all(|axis| lower[axis] - slack <= p[axis] && p[axis] <= upper[axis] + slack)
            })
            .map(|point| point as u32)
            .collect()
    }

    /// Diagonal of the box around all points of the body, m; collective.
    pub(crate) fn extent(&self) -> f64 {
        let [lower, upper] = self.corners();
        norm(minus(upper, lower))
    }

    /// Lowest and highest corner of the box around all points of the body, m; collective.
    pub fn corners(&self) -> [[f64; D]; 2] {
        let [lower, upper] = self.box_around(self.subdomain.owned());
        let mut ends = [lower.map(|it| -it), upper];
        self.subdomain.all_reduce_max(ends.as_flattened_mut());
        [ends[0].map(|it| -it), ends[1]]
    }

    /// Orders some points so that the first half of them lies on one side of the second half along the axis of their largest extent (the
    /// first of several), with ties broken by number.
    pub(crate) fn halve(&self, points: &mut [u32]) {
        let positions = points.iter().map(|&it| self.positions[it as usize]);
        let [lower, upper] = bounding_box(positions);
        let extents = minus(upper, lower);
        let axis = (0..D)
            .rev()
            .max_by(|one, other| extents[*one].total_cmp(&extents[*other]));
        let axis = axis.unwrap_or_default();
        points.select_nth_unstable_by(points.len() / 2, |&one, &other| {
            let [first, second] = [one, other].map(|point| self.positions[point as usize][axis]);
            first.total_cmp(&second).then(one.cmp(&other))
        });
    }

    /// The points of this process where the body is divided between processes, with all points of the body.
    pub fn divided(&self, communicator: Arc<dyn Communicator>) -> Subdomain {
        let halve = |points: &mut [u32]| self.halve(points);
        let partition = Partition::new(self.len(), communicator.size(), &halve);
        Subdomain::new(partition, communicator)
    }

    /// Lowest and highest corner of the box around some points, m.
    pub fn box_around(&self, points: impl Iterator<Item = u32>) -> [[f64; D]; 2] {
        bounding_box(points.map(|it| self.positions[it as usize]))
    }

    /// Marks the points that may have bonds with owned points, and these, shape (n_points), for the radius of each point's horizon, m.
    pub fn near_owned(&self, horizon: impl Fn(u32) -> f64) -> Vec<bool> {
        let [lower, upper] = self.box_around(self.subdomain.owned());
        let reach = |point: usize| {
            let point = point as u32;
            horizon(point) * (1.0 + 2.0 * self.tolerance(point))
        };
        let owned = self.subdomain.owned().map(|it| it as usize);
        // Cells of a lattice are corners of blocks between them.
        let diagonal = self.lattice_cell.map_or(0.0, |sides| 1.01 * norm(sides));
        let farthest = owned.map(reach).fold(diagonal, f64::max);
        let is_near = |point: usize| {
            let position = self.positions[point];
            let inside = std::array::from_fn(|k| position[k].max(lower[k]).min(upper[k]));
            distance(position, inside) <= reach(point).max(farthest)
        };
        (0..self.len()).map(is_near).collect()
    }

    /// The cloud of some of its points (ascending), among them all owned ones.
    pub fn part(&self, points: &[u32]) -> Self {
        let indices = || points.iter().map(|&it| it as usize);
        let along_curve = self.curve.iter();
        let curve = along_curve.filter_map(|it| points.binary_search(it).ok());
        let [volumes, material_shares] = self.volumes_at(points);
        Self {
            positions: indices().map(|it| self.positions[it]).collect(),
            volumes: volumes.into(),
            spacing: indices().map(|it| self.spacing[it]).collect(),
            material_shares,
            curve: curve.map(|point| point as u32).collect(),
            numbering: self.numbering.part(points),
            subdomain: self.subdomain.part(points),
            ..*self
        }
    }

    /// Volumes of some points, m^3, and their material fractions; empty before the cloud has them.
    pub fn volumes_at(&self, points: &[u32]) -> [Vec<f64>; 2] {
        let n = self.n_materials;
        let indices = || points.iter().map(|&it| it as usize);
        let volumes = indices().filter_map(|it| self.volumes.get(it).copied());
        let shares = indices().filter_map(|it| self.material_shares.get(n * it..n * (it + 1)));
        [volumes.collect(), shares.flatten().copied().collect()]
    }

    /// Displacements u_i = x_j, u_j = x_i for each pair of axes i <= j, of points with `n_components` components of motion, each of shape
    /// (n_points, n_components).
    pub(crate) fn motions_of_strain(&self, n_components: usize) -> Vec<Vec<f64>> {
        let mode = |(i, j): (usize, usize)| {
            let mut motions = vec![0.0; n_components * self.positions.len()];
            for (motion, x) in motions.chunks_exact_mut(n_components).zip(&self.positions) {
                (motion[i], motion[j]) = (x[j], x[i]);
            }
            motions
        };
        let pairs = (0..D).flat_map(|i| (i..D).map(move |j| (i, j)));
        pairs.map(mode).collect()
    }

    /// Relative difference up to which lengths at a point count as equal:
    /// [`INCLUSION_TOLERANCE`](crate::horizon::INCLUSION_TOLERANCE), and the uncertainty of its nearest distance by
    /// [`PointCloud::precision`].
    pub fn tolerance(&self, point: u32) -> f64 {
        precision::tolerance(self.precision, self.spacing[point as usize])
    }

    /// Distance that counts as zero in comparisons at a point, m. On a lattice points lie exactly on the rims of boxes and halfway between
    /// others, where rounding must not decide.
    pub fn slack(&self, point: u32) -> f64 {
        self.tolerance(point) * self.spacing[point as usize]
    }

    /// Distance that counts as zero along a bond between two points, m: the smaller of both ends.
    pub(crate) fn slack_between(&self, [a, b]: [u32; 2]) -> f64 {
        self.slack(a).min(self.slack(b))
    }
}

/// A search tree over the points.
pub(crate) fn search_tree<const D: usize>(positions: &[[f64; D]]) -> RTree<NumberedPoint<D>> {
    RTree::bulk_load(
        positions
            .iter()
            .enumerate()
            .map(|(number, &p)| GeomWithData::new(p, number as u32))
            .collect(),
    )
}

/// Distance between two points, m, with the same bits in either order.
#[inline]
pub(crate) fn distance<const D: usize>(a: [f64; D], b: [f64; D]) -> f64 {
    norm(minus(b, a))
}
