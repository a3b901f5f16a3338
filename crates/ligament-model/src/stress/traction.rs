//! The peridynamic traction: the force through a small plane at a point.
//!
//! The force of all bonds from points behind a plane to points before it, in a column as wide as the point, over the area of
//! the column (Lehoucq and Silling 2008; in discrete form MPPD eqs A.1 to A.5).

use rstar::primitives::GeomWithData;
use rstar::{AABB, RTree};

use crate::cloud::PointCloud;
use crate::contact::ClosedPair;
use crate::deformation::{Deformation, Deformations};
use crate::element::Element;
use crate::parallel;
use crate::system::{BondSystem, ElementSystem, UnbrokenBonds};
use crate::tensor::minus;

/// Names of the components of a traction: for the plane normal to each axis the normal stress, then the shear stresses; the first letter is the
/// direction of the force.
pub fn names<const D: usize>() -> &'static [&'static str] {
    match D {
        2 => &["xx", "yx", "yy", "xy"],
        _ => &["xx", "yx", "zx", "yy", "xy", "zy", "zz", "xz", "yz"],
    }
}

impl<const D: usize, const M: usize, E: Element<D, M>> ElementSystem<D, M, E> {
    /// Traction at every point on the planes with a normal along each axis, shape (n_points, D D), in the order of [`names`], Pa.
    ///
    /// The planes of a point are segments, in space squares, of width w_i = (V_i/t)^(1/D), the point in their middle, and the mean is taken of those
    /// that lie up to w_i/2 before and behind it: together they sweep a square, in space a cube, of the point's own size. A bond stands for a band
    /// of matter between its points, as wide as their planes in the mean. With the size a_i that the band and the square of point
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
        &self,
        bonds: UnbrokenBonds<'_>,
        deformations: &Deformations,
    ) -> Vec<f64> {
        let of_bonds: &[E::Deformation] = Deformation::of_bonds(deformations);
        let pull = |bond: usize| {
            let element = self.remaining_element(bonds, bond)?;
            // The end force is what holds the end in place against the bond: the bond pulls the other way.
            let [at_a, _] = element.end_forces(&of_bonds[bond])?;
            let force = std::array::from_fn(|axis| -at_a[axis]);
            Some((self.system.bonds.ends[bond], force))
        };
        let pulls = || (0..of_bonds.len()).filter_map(pull);
        let cloud = &self.system.cloud;
        let mut tractions = through_planes(cloud, pulls);
        if let Some(terms) = &self.system.volumetric {
            let of_points = tractions.chunks_exact_mut(D * D);
            for (point, values) in of_points.enumerate() {
                let changes = deformations.volume_changes();
                let found = terms.stress_from_changes(bonds, changes, point as u32);
                let normal = found.stress_volume / cloud.volumes[point];
                values.iter_mut().step_by(D).for_each(|it| *it += normal);
            }
        }
        tractions
    }
}

impl<const D: usize> BondSystem<D> {
    /// Adds the tractions of closed pairs to the tractions of the bonds, shape (n_points, D D), Pa.
    pub(crate) fn add_contact_tractions(&self, closed: &[ClosedPair], tractions: &mut [f64]) {
        if closed.is_empty() {
            return;
        }
        let pull = |it: &ClosedPair| {
            let force = std::array::from_fn(|axis| it.force() * it.pair.normal[axis]);
            (it.pair.ends, force)
        };
        let of_contact = through_planes(&self.cloud, || closed.iter().map(pull));
        for (sum, value) in tractions.iter_mut().zip(of_contact) {
            *sum += value;
        }
    }
}

/// Tractions of all points, shape (n_points, D D), from the forces with which the second ends of bonds pull at the first.
fn through_planes<const D: usize, I: Iterator<Item = ([u32; 2], [f64; D])>>(
    cloud: &PointCloud<D>,
    pulls: impl Fn() -> I + Sync,
) -> Vec<f64> {
    let squares = Squares::from_cloud(cloud);
    let of_normals = parallel::map(0..D, |normal| {
        let mut planes = Planes::new(cloud, &squares, normal);
        pulls().for_each(|(ends, force)| planes.share_out(ends, force));
        planes.tractions()
    });
    let of_point = |point: usize| {
        let of_normals = of_normals.iter().enumerate();
        of_normals.flat_map(move |(normal, tractions): (usize, &Vec<[f64; D]>)| {
            let across = (0..D).filter(move |axis| *axis != normal);
            let axes = std::iter::once(normal).chain(across);
            axes.map(move |axis| tractions[point][axis])
        })
    };
    (0..cloud.len()).flat_map(of_point).collect()
}

/// Forces through the planes of one normal at all points.
struct Planes<'a, const D: usize> {
    cloud: &'a PointCloud<D>,
    squares: &'a Squares<D>,
    /// Axis of the normal.
    normal: usize,
    /// Sums of force times extent, shape (n_points), N m.
    sums: Vec<[f64; D]>,
    /// Points whose squares a bond crosses, with the sizes of the overlaps.
    crossed: Vec<(usize, f64)>,
}

impl<'a, const D: usize> Planes<'a, D> {
    fn new(cloud: &'a PointCloud<D>, squares: &'a Squares<D>, normal: usize) -> Self {
        Self {
            cloud,
            squares,
            normal,
            sums: vec![[0.0; D]; cloud.len()],
            crossed: Vec::new(),
        }
    }

    /// Distributes the force of the second end on the first over the points along the bond.
    fn share_out(&mut self, ends: [u32; 2], force: [f64; D]) {
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
        for point in squares.points_in_box(band.reach(squares.largest_width)) {
            let size = band.size_within(cloud.positions[point], squares.width[point]);
            if size > 0.0 {
                crossed.push((point, size));
            }
        }
        let size: f64 = crossed.iter().map(|(_, size)| size).sum();
        // The matter before the plane pulls the matter behind it; the sign of the extent accounts for that.
        let force = force.map(|component| component * band.extent());
        for (point, part) in crossed.drain(..) {
            for (sum, component) in sums[point].iter_mut().zip(force) {
                *sum += component * (part / size);
            }
        }
    }

    /// The tractions, shape (n_points), Pa.
    fn tractions(&self) -> Vec<[f64; D]> {
        let over_volume = |(sum, volume): (&[f64; D], &f64)| sum.map(|value| value / volume);
        let sums = self.sums.iter();
        sums.zip(&*self.cloud.volumes).map(over_volume).collect()
    }
}

/// The band of matter around a bond that crosses planes of one normal.
struct Band<const D: usize> {
    ends: [[f64; D]; 2],
    width: f64,
    normal: usize,
}

impl<const D: usize> Band<D> {
    /// Length from the first end to the second along the normal, m.
    fn extent(&self) -> f64 {
        let [a, b] = self.ends.map(|end| end[self.normal]);
        b - a
    }

    /// Box around the points whose squares the band may cross, for squares up to a width.
    fn reach(&self, largest_width: f64) -> [[f64; D]; 2] {
        let margin = |axis: usize| {
            let of_band = if axis == self.normal { 0.0 } else { self.width };
            0.5 * (of_band + largest_width)
        };
        let [a, b] = self.ends;
        [
            std::array::from_fn(|axis| a[axis].min(b[axis]) - margin(axis)),
            std::array::from_fn(|axis| a[axis].max(b[axis]) + margin(axis)),
        ]
    }

    /// Area that the band has in common with the square of a point, m^2; in space the volume in common with its cube, m^3.
    fn size_within(&self, point: [f64; D], width: f64) -> f64 {
        let half = 0.5 * width;
        let [from, to] = self.ends.map(|end| minus(end, point));
        let [n_a, n_b] = [from[self.normal], to[self.normal]];
        let (first, last) = (n_a.min(n_b).max(-half), n_a.max(n_b).min(half));
        if first >= last {
            return 0.0;
        }
        let across = || (0..D).filter(|axis| *axis != self.normal);
        // Common size of the cross sections of the band and the square at a place along the normal.
        let overlap = |place: f64| -> f64 {
            let of_axis = |axis: usize| {
                let (c_a, c_b) = (from[axis], to[axis]);
                let middle = c_a + (c_b - c_a) * ((place - n_a) / (n_b - n_a));
                let upper = (middle + 0.5 * self.width).min(half);
                (upper - (middle - 0.5 * self.width).max(-half)).max(0.0)
            };
            across().map(of_axis).product()
        };
        // Along each axis it is linear between the places where an edge of the band passes an edge of the square.
        let (sum, difference) = (0.5 * (self.width + width), 0.5 * (self.width - width));
        let mut places = [last; 10];
        places[0] = first;
        let passing = across().flat_map(|axis| {
            let (c_a, c_b) = (from[axis], to[axis]);
            [-sum, -difference, difference, sum].map(|offset| {
                let place = n_a + (n_b - n_a) * ((offset - c_a) / (c_b - c_a));
                if c_a == c_b {
                    first
                } else {
                    place.clamp(first, last)
                }
            })
        });
        for (place, passing) in places[1..].iter_mut().zip(passing) {
            *place = passing;
        }
        places.sort_by(f64::total_cmp);
        let pieces = places.windows(2);
        pieces
            .map(|ends| {
                let [a, b] = [ends[0], ends[1]];
                match D {
                    2 => 0.5 * (b - a) * (overlap(a) + overlap(b)),
                    // Simpson's rule is exact for the product of two linear functions.
                    _ => (b - a) * (overlap(a) + 4.0 * overlap(0.5 * (a + b)) + overlap(b)) / 6.0,
                }
            })
            .sum()
    }
}

/// Squares of the points, in space cubes, in a search tree.
struct Squares<const D: usize> {
    /// Width (V/t)^(1/D) of each square, shape (n_points), m.
    width: Vec<f64>,
    largest_width: f64,
    middles: RTree<GeomWithData<[f64; D], u32>>,
}

impl<const D: usize> Squares<D> {
    fn from_cloud(cloud: &PointCloud<D>) -> Self {
        let width = |volume: &f64| match D {
            2 => (volume / cloud.thickness).sqrt(),
            _ => volume.cbrt(),
        };
        let width: Vec<f64> = cloud.volumes.iter().map(width).collect();
        let numbered = (0..).zip(&cloud.positions);
        let middles = numbered.map(|(point, &position)| GeomWithData::new(position, point));
        Self {
            largest_width: width.iter().copied().fold(0.0, f64::max),
            width,
            middles: RTree::bulk_load(middles.collect()),
        }
    }

    /// The points in a box, in the order of the tree, which depends on the points alone.
    fn points_in_box(&self, [lower, upper]: [[f64; D]; 2]) -> impl Iterator<Item = usize> + '_ {
        let found = self
            .middles
            .locate_in_envelope(AABB::from_corners(lower, upper));
        found.map(|point| point.data as usize)
    }
}
