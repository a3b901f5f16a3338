//! The peridynamic traction: the force through a small plane at a point.
//!
//! The force of all bonds from points behind a plane to points before it, in a column as wide as the point, over the area of
//! the column (Lehoucq and Silling 2008; in discrete form MPPD eqs A.1 to A.5).

use rstar::primitives::GeomWithData;
use rstar::{AABB, RTree};

use crate::cloud::PointCloud;
use crate::contact::ClosedPair;
use crate::element::{BondDeformation, Element, Elements};
use crate::system::{BondSystem, BondsLeft, Typed};

/// Stresses of the planes with normal x (xx, yx) and with normal y (yy, xy), Pa; the first letter is the force's direction.
pub type Tractions = [f64; 4];

impl<const M: usize, E: Elements<M>> Typed<'_, E, M> {
    /// Traction at every point on the planes with normal x and with normal y, shape (n_points).
    ///
    /// The planes of a point are segments of width w_i = sqrt(V_i/t), the point in their middle, and the mean is taken of those
    /// that lie up to w_i/2 before and behind it: together they sweep a square of the point's own area. A bond stands for a band
    /// of matter between its points, as wide as their planes in the mean. With the area a_i that the band and the square of point
    /// i have in common, the extent d of the band along the normal and its force f, the traction of i is the sum over the bonds of
    ///
    /// t_i = f a_i d / (V_i sum_j a_j),
    ///
    /// so that a bond is shared out among the points along its way, and nothing is lost or counted twice: sum_i V_i t_i is the
    /// mean stress of the body, exactly. Where the squares fill the plane the sum of a_j is d times the width of the band, and
    /// t_i = (1/(w_i t)) times the force that crosses the plane of i: on a square lattice eq. A.4, there with the half of the bonds
    /// that end in a plane which lies before it, and the columns beside weighted by how far their bands reach into this one.
    /// Where they do not fill it, on other meshes and at the outline, planes alone would miss or repeat some of the force.
    ///
    /// Bonds within a plane do not cross it and do not count, nor do elements that couple more than two points: their forces go through no line.
    pub(crate) fn tractions(
        self,
        bonds: BondsLeft<'_>,
        deformations: &[BondDeformation],
    ) -> Vec<Tractions> {
        let squares = Squares::from_cloud(&self.system.cloud);
        let on_planes = |normal| self.through_planes(bonds, deformations, &squares, normal);
        let (with_x, with_y) = rayon::join(|| on_planes(0), || on_planes(1));
        let of_point = |([xx, yx], [xy, yy]): ([f64; 2], [f64; 2])| [xx, yx, yy, xy];
        with_x.into_iter().zip(with_y).map(of_point).collect()
    }

    /// Traction along x and y on the planes of each point with the given normal (0: x, 1: y), Pa.
    fn through_planes(
        self,
        bonds: BondsLeft<'_>,
        deformations: &[BondDeformation],
        squares: &Squares,
        normal: usize,
    ) -> Vec<[f64; 2]> {
        let system = self.system;
        let mut planes = Planes::new(&system.cloud, squares, normal);
        for (bond, deformation) in deformations.iter().enumerate() {
            let Some(element) = self.left(bonds, bond) else {
                continue;
            };
            // The end force is what holds the end in place against the bond: the bond pulls the other way.
            let Some([at_a, _]) = element.end_forces(deformation) else {
                continue;
            };
            planes.share_out(system.bonds.ends[bond], [-at_a[0], -at_a[1]]);
        }
        planes.tractions()
    }
}

impl BondSystem {
    /// Adds the tractions of closed pairs to those of the bonds, shape (n_points, 4), Pa.
    pub(crate) fn add_contact_tractions(&self, closed: &[ClosedPair], tractions: &mut [f64]) {
        if closed.is_empty() {
            return;
        }
        let squares = Squares::from_cloud(&self.cloud);
        let on_planes = |normal| {
            let mut planes = Planes::new(&self.cloud, &squares, normal);
            for it in closed {
                let force = it.pair.normal.map(|component| it.force() * component);
                planes.share_out(it.pair.ends, force);
            }
            planes.tractions()
        };
        let of_points = on_planes(0).into_iter().zip(on_planes(1));
        for (sums, ([xx, yx], [xy, yy])) in tractions.chunks_mut(4).zip(of_points) {
            for (sum, value) in sums.iter_mut().zip([xx, yx, yy, xy]) {
                *sum += value;
            }
        }
    }
}

/// Forces through the planes of one normal at all points.
struct Planes<'a> {
    cloud: &'a PointCloud,
    squares: &'a Squares,
    /// 0: x, 1: y.
    normal: usize,
    /// Sums of force times extent, shape (n_points), N m.
    sums: Vec<[f64; 2]>,
    /// Points along the way of a bond, and areas in common.
    crossed: Vec<(usize, f64)>,
}

impl<'a> Planes<'a> {
    fn new(cloud: &'a PointCloud, squares: &'a Squares, normal: usize) -> Self {
        Self {
            cloud,
            squares,
            normal,
            sums: vec![[0.0; 2]; cloud.len()],
            crossed: Vec::new(),
        }
    }

    /// Shares the force with which the second end pulls at the first out among the points on the way.
    fn share_out(&mut self, ends: [u32; 2], force: [f64; 2]) {
        let Self {
            cloud,
            squares,
            normal,
            sums,
            crossed,
        } = self;
        let [a, b] = ends.map(|end| end as usize);
        let band = Band {
            ends: [cloud.positions[a], cloud.positions[b]],
            width: 0.5 * (squares.width[a] + squares.width[b]),
            normal: *normal,
        };
        for point in squares.within(band.reach(squares.largest_width)) {
            let area = band.area_within(cloud.positions[point], squares.width[point]);
            if area > 0.0 {
                crossed.push((point, area));
            }
        }
        let area: f64 = crossed.iter().map(|(_, area)| area).sum();
        // What lies before the plane pulls at what lies behind it: the extent has the sign for that.
        let force = force.map(|component| component * band.extent());
        for (point, part) in crossed.drain(..) {
            for (sum, component) in sums[point].iter_mut().zip(force) {
                *sum += component * (part / area);
            }
        }
    }

    /// The tractions, shape (n_points), Pa.
    fn tractions(&self) -> Vec<[f64; 2]> {
        let over_volume = |(sum, volume): (&[f64; 2], &f64)| sum.map(|value| value / volume);
        let sums = self.sums.iter();
        sums.zip(&self.cloud.volumes).map(over_volume).collect()
    }
}

/// The matter of a bond on its way through planes of one normal.
struct Band {
    ends: [[f64; 2]; 2],
    width: f64,
    normal: usize,
}

impl Band {
    /// From the first end to the second along the normal, m.
    fn extent(&self) -> f64 {
        let [a, b] = self.ends.map(|end| end[self.normal]);
        b - a
    }

    /// The box of the points whose squares it may cross, for squares up to a width.
    fn reach(&self, largest_width: f64) -> [[f64; 2]; 2] {
        let margin = |axis: usize| {
            let of_band = if axis == self.normal { 0.0 } else { self.width };
            0.5 * (of_band + largest_width)
        };
        let [a, b] = self.ends;
        [
            [0, 1].map(|axis| a[axis].min(b[axis]) - margin(axis)),
            [0, 1].map(|axis| a[axis].max(b[axis]) + margin(axis)),
        ]
    }

    /// Area that the band has in common with the square of a point, m^2.
    fn area_within(&self, point: [f64; 2], width: f64) -> f64 {
        let along = 1 - self.normal;
        let half = 0.5 * width;
        let [n_a, n_b] = self.ends.map(|end| end[self.normal] - point[self.normal]);
        let [c_a, c_b] = self.ends.map(|end| end[along] - point[along]);
        let (first, last) = (n_a.min(n_b).max(-half), n_a.max(n_b).min(half));
        if first >= last {
            return 0.0;
        }
        let overlap = |place: f64| {
            let middle = c_a + (c_b - c_a) * ((place - n_a) / (n_b - n_a));
            let upper = (middle + 0.5 * self.width).min(half);
            (upper - (middle - 0.5 * self.width).max(-half)).max(0.0)
        };
        // It is linear between the places where an edge of the band passes an edge of the square.
        let (sum, difference) = (0.5 * (self.width + width), 0.5 * (self.width - width));
        let passing = |offset: f64| {
            let place = n_a + (n_b - n_a) * ((offset - c_a) / (c_b - c_a));
            if c_a == c_b {
                first
            } else {
                place.clamp(first, last)
            }
        };
        let [a, b, c, d] = [-sum, -difference, difference, sum].map(passing);
        let mut places = [first, a, b, c, d, last];
        places.sort_by(f64::total_cmp);
        let pieces = places.windows(2);
        pieces
            .map(|ends| 0.5 * (ends[1] - ends[0]) * (overlap(ends[0]) + overlap(ends[1])))
            .sum()
    }
}

/// The squares of the points, and a tree to find those near a bond.
struct Squares {
    /// Width sqrt(V/t) of each, shape (n_points), m.
    width: Vec<f64>,
    largest_width: f64,
    middles: RTree<GeomWithData<[f64; 2], u32>>,
}

impl Squares {
    fn from_cloud(cloud: &PointCloud) -> Self {
        let width: Vec<f64> = cloud
            .volumes
            .iter()
            .map(|volume| (volume / cloud.thickness).sqrt())
            .collect();
        let numbered = (0..).zip(&cloud.positions);
        let middles = numbered.map(|(point, &position)| GeomWithData::new(position, point));
        Self {
            largest_width: width.iter().copied().fold(0.0, f64::max),
            width,
            middles: RTree::bulk_load(middles.collect()),
        }
    }

    /// The points in a box, in the order of the tree, which depends on the points alone.
    fn within(&self, [lower, upper]: [[f64; 2]; 2]) -> impl Iterator<Item = usize> + '_ {
        let found = self
            .middles
            .locate_in_envelope(AABB::from_corners(lower, upper));
        found.map(|point| point.data as usize)
    }
}
