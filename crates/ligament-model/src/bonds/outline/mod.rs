//! The outline of a mesh: pairs whose straight line leaves the meshed body are not bonded.
//!
//! Holes, slots, notches and re-entrant corners are regions without cells. The outline consists of the edges, or in space the faces, that
//! belong to one cell only. The rule, decided with exact orientation predicates: a bond stays in the body if it passes through no facet of
//! the outline, and if it continues into a cell, or along a side of one, from its first end and from every node and, in space, every edge of
//! the outline on it. A bond along the outline, or one that only touches a corner or an edge, stays in the body: positions closer to a line
//! or a plane than 1e-5 of the nearest distance of the bond's ends lie on it, or rounding would decide about bonds along a slanted side.
//!
//! The two faces of a crack in the mesh are facets at one place, with nodes of their own. A bond to such a node stays in the body if cells of both
//! of its ends lie on a common side of its line.

mod plane;
mod solid;

use ligament_mesh::MeshCell;
use rstar::primitives::{GeomWithData, Rectangle};
use rstar::{AABB, RTree};

use super::first_bonds::first_bonds;
use super::{BondSet, Incidence};
use crate::cloud::lumping::shortest_edges;
use crate::cloud::{PointCloud, distance, search_tree};
use crate::geometry::bounding_box;
use crate::horizon::INCLUSION_TOLERANCE;
use crate::parallel;
use crate::tensor::{directions_across, minus, norm};

/// Number of points along the curve that are checked together for a near outline: most of a body is far from it.
const BLOCK: usize = 64;

/// Sides of a line, as parts of the directions across it; in the plane the first one counts. No crack of a regular mesh lies along them.
const SIDES: [[f64; 2]; 8] = [
    [1.0, 0.41],
    [-1.0, -0.41],
    [1.0, -0.41],
    [-1.0, 0.41],
    [0.41, 1.0],
    [-0.41, -1.0],
    [0.41, -1.0],
    [-0.41, 1.0],
];

/// Distance of a side from a line, relative to the length of the line: well above rounding, well below any cell.
const ASIDE: f64 = 1e-3;

/// Outline of a mesh in the plane.
pub type PlaneOutline = Facets<2, 3>;

/// Outline of a mesh in space.
pub type SolidOutline = Facets<3, 4>;

/// Facets of an outline, edges or triangles, and the parts of cells at their nodes, triangles or tetrahedra (N = D + 1).
#[derive(Debug)]
pub struct Facets<const D: usize, const N: usize> {
    positions: Vec<[f64; D]>,
    /// Nodes of the facets, in a spatial search tree.
    tree: RTree<GeomWithData<Rectangle<[f64; D]>, [u32; D]>>,
    /// Parts of cells at nodes of the outline.
    parts: Vec<[u32; N]>,
    /// Numbers of the parts at each node of the outline; none at other nodes.
    parts_at: Incidence,
    /// Whether each node shares its place with another one, shape (n_nodes).
    is_doubled: Vec<bool>,
}

impl<const D: usize, const N: usize> Facets<D, N> {
    /// The outline of given facets, with the parts of cells that have a node of the outline.
    fn new(
        facets: &[[u32; D]],
        parts: impl Iterator<Item = [u32; N]>,
        positions: &[[f64; D]],
    ) -> Self {
        let is_on_outline = marked(facets, positions.len());
        let is_on = |node: &u32| is_on_outline[*node as usize];
        let parts: Vec<[u32; N]> = parts.filter(|part| part.iter().any(is_on)).collect();
        let numbered = (0..).zip(&parts);
        let corners = numbered.flat_map(|(number, part)| part.map(|node| (node, number)));
        let at_outline = corners.filter(|(node, _)| is_on(node));
        let boxed = |&facet: &[u32; D]| {
            let [lower, upper] = bounding_box(facet.map(|node| positions[node as usize]));
            GeomWithData::new(Rectangle::from_corners(lower, upper), facet)
        };
        Self {
            positions: positions.to_vec(),
            tree: RTree::bulk_load(facets.iter().map(boxed).collect()),
            parts_at: Incidence::from_pairs(at_outline, positions.len()),
            parts,
            is_doubled: doubled(&is_on_outline, positions),
        }
    }

    fn at(&self, node: u32) -> [f64; D] {
        self.positions[node as usize]
    }

    /// Parts of cells at a node; none at a node off the outline.
    fn parts_at(&self, node: u32) -> impl Iterator<Item = [u32; N]> + Clone {
        let numbers = self.parts_at.at(node).iter();
        numbers.map(|&number| self.parts[number as usize])
    }

    /// Nodes of the facets that intersect a box.
    fn facets_in_box(&self, [lower, upper]: [[f64; D]; 2]) -> impl Iterator<Item = [u32; D]> {
        let around = AABB::from_corners(lower, upper);
        let found = self.tree.locate_in_envelope_intersecting(around);
        found.map(|facet| facet.data)
    }

    /// Nodes of an edge of the outline that passes through a facet, the smallest of all such edges.
    fn first_edge_through(
        &self,
        is_passed: impl Fn([u32; D], [[f64; D]; 2]) -> bool,
    ) -> Option<[u32; 2]> {
        let facets = self.tree.iter().map(|facet| facet.data);
        let edges = facets.flat_map(|nodes| (0..D).map(move |k| [nodes[k], nodes[(k + 1) % D]]));
        let is_passing = |edge: &[u32; 2]| {
            let ends = edge.map(|node| self.at(node));
            self.facets_in_box(bounding_box(ends))
                .any(|facet| is_passed(facet, ends))
        };
        // Each edge occurs in both directions.
        let once = edges.filter(|[from, to]| from < to);
        once.filter(is_passing).min()
    }
}

/// Flags of the nodes of an outline that share their place with another one, shape (n_nodes).
fn doubled<const D: usize>(is_on_outline: &[bool], positions: &[[f64; D]]) -> Vec<bool> {
    let numbered = positions.iter().zip(is_on_outline).enumerate();
    let on_outline = numbered.filter(|(_, (_, is_on))| **is_on);
    let mut placed: Vec<([u64; D], usize)> = on_outline
        .map(|(node, (place, _))| (place.map(|x| (x + 0.0).to_bits()), node))
        .collect();
    placed.sort_unstable();
    let mut is_doubled = vec![false; positions.len()];
    for pair in placed.windows(2).filter(|pair| pair[0].0 == pair[1].0) {
        is_doubled[pair[0].1] = true;
        is_doubled[pair[1].1] = true;
    }
    is_doubled
}

/// Flags of the nodes of some facets, shape (n_nodes).
fn marked<const D: usize>(facets: &[[u32; D]], n_nodes: usize) -> Vec<bool> {
    let mut is_marked = vec![false; n_nodes];
    for &node in facets.as_flattened() {
        is_marked[node as usize] = true;
    }
    is_marked
}

/// Geometric queries of bonds to the outline of a mesh.
pub trait Outline<const D: usize>: Sync {
    /// An edge or a triangle of the outline.
    type Facet;

    /// Facets that intersect a box, given by its lowest and its highest corner (m).
    fn facets_within(&self, bounds: [[f64; D]; 2]) -> impl Iterator<Item = Self::Facet>;

    /// Whether the line between two nodes leaves the body, given all facets that it may intersect.
    fn is_crossed_by_bonds(&self, ends: [u32; 2], near: &[Self::Facet], slack: f64) -> bool;

    /// Whether a node shares its place with another one: both are on the faces of a crack in the mesh.
    fn is_doubled(&self, node: u32) -> bool;

    /// Position of a node, m.
    fn position(&self, node: u32) -> [f64; D];

    /// Whether the line from a node to a position begins in a cell of this node.
    fn begins_in_body(&self, node: u32, end: [f64; D]) -> bool;

    /// Nodes of an edge that passes through a facet, the smallest of all such edges; none where cells do not overlap.
    fn first_crossing(&self) -> Option<[u32; 2]>;

    /// Whether the line between two nodes leaves the body, or one of them lies on the other face of a crack in the mesh.
    fn is_parted(&self, ends: [u32; 2], near: &[Self::Facet], slack: f64) -> bool {
        let is_on_crack = ends.iter().any(|&end| self.is_doubled(end));
        self.is_crossed_by_bonds(ends, near, slack) || (is_on_crack && !self.have_common_side(ends))
    }

    /// Whether the cells of two nodes lie on a common side of the line between them: all around it in the body, on one side along a face.
    fn have_common_side(&self, [a, b]: [u32; 2]) -> bool {
        let [p, q] = [a, b].map(|node| self.position(node));
        let length = norm(minus(q, p));
        if length == 0.0 {
            return false;
        }
        let across = directions_across(minus(q, p).map(|x| x / length));
        SIDES.iter().any(|parts| {
            let beside = |end: [f64; D]| {
                let parts = parts.iter().zip(&across);
                parts.fold(end, |place, (part, direction)| {
                    let far = ASIDE * part * length;
                    std::array::from_fn(|axis| place[axis] + far * direction[axis])
                })
            };
            self.begins_in_body(a, beside(q)) && self.begins_in_body(b, beside(p))
        })
    }
}

/// Whether the straight line of each bond between nodes of a mesh leaves the outline of the cells, shape (n_bonds).
pub fn bonds_outside<const D: usize, O: Outline<D>>(
    outline: &O,
    bonds: &BondSet<D>,
    cloud: &PointCloud<D>,
) -> Vec<bool> {
    let first = first_bonds(&bonds.ends, cloud.len());
    let own = |point: u32| first[point as usize]..first[point as usize + 1];
    let reach = |point: u32| {
        let lengths = bonds.length[own(point)].iter();
        lengths.copied().fold(0.0, f64::max)
    };
    let around = |points: &[u32]| {
        bounding_box(points.iter().flat_map(|&point| {
            let position = cloud.positions[point as usize];
            box_around(position, reach(point))
        }))
    };
    let leaves = |bond: usize, near: &[O::Facet]| {
        let slack = cloud.slack_between(bonds.ends[bond]);
        outline.is_parted(bonds.ends[bond], near, slack)
    };
    let leaving = |point: u32| {
        let around = box_around(cloud.positions[point as usize], reach(point));
        let near: Vec<_> = outline.facets_within(around).collect();
        own(point).filter(move |&bond| !near.is_empty() && leaves(bond, &near))
    };
    let of_blocks = parallel::map(cloud.curve.chunks(BLOCK), |block| {
        match outline.facets_within(around(block)).next() {
            Some(_) => block.iter().flat_map(|&point| leaving(point)).collect(),
            None => Vec::new(),
        }
    });
    let mut outside = vec![false; bonds.len()];
    for bond in of_blocks.into_iter().flatten() {
        outside[bond] = true;
    }
    outside
}

/// Distance of each node of the mesh of `cells` to the nearest other node that is visible within their outline, shape (n_points), m.
///
/// Across a thin slot the nearest node of all may be much nearer; a horizon that follows it would reach only the other side.
pub fn spacing_inside<const D: usize, C: MeshCell<D>>(
    outline: &impl Outline<D>,
    cells: &[C],
    cloud: &PointCloud<D>,
) -> Vec<f64> {
    let shortest = shortest_edges(cloud, cells);
    let mut spacing = cloud.spacing.to_vec();
    // Nodes nearer than the ends of all edges of cells may lie behind a void.
    let may_be_parted: Vec<u32> = (0..cloud.len() as u32)
        .filter(|&point| {
            let shortest = shortest[point as usize];
            shortest.is_finite() && spacing[point as usize] < shortest
        })
        .collect();
    if may_be_parted.is_empty() {
        return spacing;
    }
    let tree = search_tree(&cloud.positions);
    let nearest = |place: usize| {
        let point = may_be_parted[place];
        let (position, shortest) = (cloud.positions[point as usize], shortest[point as usize]);
        let near: Vec<_> = outline
            .facets_within(box_around(position, shortest))
            .collect();
        let is_seen = |other: u32, length: f64| {
            !outline.is_parted([point, other], &near, cloud.tolerance(point) * length)
        };
        tree.locate_within_distance(position, shortest * shortest)
            .filter(|other| other.data != point)
            .map(|other| (other.data, distance(position, *other.geom())))
            .filter(|&(other, length)| is_seen(other, length))
            .fold(shortest, |nearest, (_, length)| nearest.min(length))
    };
    let inside = parallel::values(may_be_parted.len(), 0.0, nearest);
    for (&point, nearest) in may_be_parted.iter().zip(inside) {
        spacing[point as usize] = nearest;
    }
    spacing
}

/// Lowest and highest corner of the box of positions within `reach` (m) of a position along every axis.
fn box_around<const D: usize>(position: [f64; D], reach: f64) -> [[f64; D]; 2] {
    let reach = reach * (1.0 + INCLUSION_TOLERANCE);
    [position.map(|x| x - reach), position.map(|x| x + reach)]
}
