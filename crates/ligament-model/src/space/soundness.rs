//! Whether points and bonds of a solid body are fit for a computation: what no equation would tell.

use ligament_mesh::SolidCell;

use crate::bonds::BondSet;
use crate::cloud::{PointCloud, distance};
use crate::horizon::Horizons;

/// Part of the size of a point below which its nearest point is one with it.
///
/// Double nodes of exports in single precision lie up to 1e-7 of the body's size apart, 1e-5 of cells of a hundredth of it. Of two
/// points nearer than this one bond would be 1e5 times as stiff as all others.
const DISTINCT: f64 = 1e-5;

/// Two points that nearly coincide.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct NearPoints {
    /// The points, the first of all that have another so near first.
    pub points: [u32; 2],
    /// Distance of the points, m.
    pub distance: f64,
    /// Size of the first, the cube root of its volume, m.
    pub size: f64,
}

/// A body in more parts than its mesh: edges of cells are longer than the horizons.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Torn {
    /// Number of parts that bonds hold together.
    pub parts: usize,
    /// Number of parts that cells hold together.
    pub of_mesh: usize,
    /// Ends of the edge between two parts that is longest for the horizons of its ends.
    pub ends: [u32; 2],
    /// Length of the edge, m.
    pub length: f64,
    /// The larger horizon of its ends, m.
    pub horizon: f64,
}

/// The first point with another nearer than 1e-5 of its size, the cube root of its volume.
pub fn near_points(cloud: &PointCloud<3>) -> Option<NearPoints> {
    let size = |point: usize| cloud.volumes[point].cbrt();
    let is_near = |&point: &usize| cloud.spacing[point] < DISTINCT * size(point);
    let point = (0..cloud.len()).find(is_near)?;
    let to = |other: usize| distance(cloud.positions[point], cloud.positions[other]);
    let others = (0..cloud.len()).filter(|other| *other != point);
    let other = others.min_by(|one, other| to(*one).total_cmp(&to(*other)))?;
    Some(NearPoints {
        points: [point as u32, other as u32],
        distance: to(other),
        size: size(point),
    })
}

/// Whether bonds leave a body of `cells` in more parts than these, by an edge of a cell that is longer than the horizons.
pub fn torn(
    cells: &[SolidCell],
    cloud: &PointCloud<3>,
    horizons: &Horizons,
    bonds: &BondSet<3>,
) -> Option<Torn> {
    let parts = Parts::new(cloud.len(), bonds.ends.iter().copied());
    if parts.count() == 1 {
        return None;
    }
    let length = |[from, to]: [u32; 2]| {
        distance(cloud.positions[from as usize], cloud.positions[to as usize])
    };
    let radius = |ends: [u32; 2]| {
        let [from, to] = ends.map(|it| horizons.radius[it as usize]);
        from.max(to)
    };
    // An edge whose ends hang together in the mesh, but not by bonds.
    let is_torn = |ends: &[u32; 2]| {
        parts.first[ends[0] as usize] != parts.first[ends[1] as usize]
            && length(*ends) > radius(*ends)
    };
    let excess = |ends: &[u32; 2]| length(*ends) / radius(*ends);
    let edges = cells.iter().flat_map(SolidCell::edges).filter(is_torn);
    let ends = edges.max_by(|one, other| excess(one).total_cmp(&excess(other)))?;
    let in_cells = cells.iter().flat_map(|cell| {
        let corners = cell.corners();
        corners.iter().map(|&it| [corners[0], it])
    });
    Some(Torn {
        parts: parts.count(),
        of_mesh: Parts::new(cloud.len(), in_cells).count(),
        ends,
        length: length(ends),
        horizon: radius(ends),
    })
}

/// Points that hang together by pairs.
struct Parts {
    /// The first point of the part of each point.
    first: Vec<u32>,
}

impl Parts {
    fn new(n_points: usize, pairs: impl Iterator<Item = [u32; 2]>) -> Self {
        let mut first: Vec<u32> = (0..n_points as u32).collect();
        let root = |first: &mut [u32], mut point: u32| {
            while first[point as usize] != point {
                first[point as usize] = first[first[point as usize] as usize];
                point = first[point as usize];
            }
            point
        };
        for [one, other] in pairs {
            let roots = [one, other].map(|it| root(&mut first, it));
            first[roots[0].max(roots[1]) as usize] = roots[0].min(roots[1]);
        }
        for point in 0..n_points as u32 {
            first[point as usize] = root(&mut first, point);
        }
        Self { first }
    }

    fn count(&self) -> usize {
        let firsts = (0..).zip(&self.first);
        firsts.filter(|(point, first)| point == *first).count()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use ligament_mesh::SolidMesh;

    /// Two bricks of heights 1 and 3 on each other.
    fn tower(z: [f64; 3]) -> (SolidMesh, PointCloud<3>) {
        let layer = |z: f64| [[0.0, 0.0, z], [1.0, 0.0, z], [1.0, 1.0, z], [0.0, 1.0, z]];
        let mesh = SolidMesh {
            node_tags: (1..=12).collect(),
            positions: z.map(layer).concat(),
            cells: vec![
                SolidCell::Hexahedron([0, 1, 2, 3, 4, 5, 6, 7]),
                SolidCell::Hexahedron([4, 5, 6, 7, 8, 9, 10, 11]),
            ],
            ..SolidMesh::default()
        };
        let cloud = PointCloud::from_solid_mesh(&mesh, &[0, 0], 1);
        (mesh, cloud)
    }

    #[test]
    fn long_edges_tear_a_body() {
        let (mesh, cloud) = tower([0.0, 1.0, 4.0]);
        let torn_at = |factor: f64| {
            let horizons = Horizons::from_spacing(&cloud.spacing, factor);
            torn(
                &mesh.cells,
                &cloud,
                &horizons,
                &BondSet::search(&cloud, &horizons),
            )
        };
        let found = torn_at(1.5).expect("a fault");
        assert_eq!((found.parts, found.of_mesh), (2, 1));
        assert_eq!((found.length, found.horizon), (3.0, 1.5));
        assert_eq!(torn_at(3.0), None);
    }

    #[test]
    fn nearly_coincident_points_are_found() {
        let (_, cloud) = tower([0.0, 1.0, 1.0 + 2e-6]);
        let found = near_points(&cloud).expect("a fault");
        assert_eq!(found.points, [4, 8]);
        assert!((found.distance - 2e-6).abs() < 1e-15 && (found.size - 0.5).abs() < 1e-5);
        assert_eq!(near_points(&tower([0.0, 1.0, 1.01]).1), None);
    }
}
