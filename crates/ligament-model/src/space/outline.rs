//! The outline of a solid mesh: a bond whose straight line leaves the meshed body is none.
//!
//! Holes, slots, notches and re-entrant edges are what the cells leave free. The outline is the faces that one cell has alone,
//! quadrangles split in two triangles as their cells are split in tetrahedra. The rule, decided with exact orientation predicates: a
//! bond stays in the body if it passes through no triangle of the outline, and if it goes on into a tetrahedron, or along a face or
//! an edge of one, from its first end and from every edge and node of the outline on it. Along the outline, and past an edge that it
//! only touches, it stays: what comes closer to a plane or a line than 1e-5 of the nearest distance of the bond's ends lies on it, or
//! rounding would decide about bonds along a slanted side.
//!
//! The nodes of a round body lie on its surface, but the triangles between them dip below it wherever an edge goes round the body
//! and its neighbours lie along it. These dips count as part of the body (`outline/dips.rs`): a convex body loses no bond.

mod dips;
mod surface;

use ligament_mesh::SolidCell;
use rayon::prelude::*;

use crate::bonds::BondSet;
use crate::cloud::{PointCloud, distance, search_tree};
use crate::space::cloud::shortest_edges;
use surface::Facet;
pub use surface::Surface;

/// Points along the curve that are asked for together whether the outline is near: most of a body is far from it.
const BLOCK: usize = 64;

/// For each bond between nodes of a mesh, whether its straight line leaves the surface of the cells, shape (n_bonds).
pub fn bonds_outside(surface: &Surface, bonds: &BondSet<3>, cloud: &PointCloud<3>) -> Vec<bool> {
    let mut first_bond = vec![0; cloud.len() + 1];
    for ends in &bonds.ends {
        first_bond[ends[0] as usize + 1] += 1;
    }
    for point in 0..cloud.len() {
        first_bond[point + 1] += first_bond[point];
    }
    let own = |point: u32| first_bond[point as usize]..first_bond[point as usize + 1];
    let reach = |point: u32| {
        let lengths = bonds.length[own(point)].iter();
        lengths.copied().fold(0.0, f64::max)
    };
    let leaves = |bond: usize, near: &[Facet]| {
        let slack = cloud.slack_between(bonds.ends[bond]);
        surface.is_left_by(bonds.ends[bond], near, slack)
    };
    let of_points: Vec<usize> = (cloud.curve.par_chunks(BLOCK))
        .filter(|block| surface.may_be_reached(block, reach))
        .flat_map_iter(|block| {
            block.iter().flat_map(|&point| {
                let near = surface.near(cloud.positions[point as usize], reach(point));
                own(point).filter(move |&bond| !near.is_empty() && leaves(bond, &near))
            })
        })
        .collect();
    let mut outside = vec![false; bonds.len()];
    for bond in of_points {
        outside[bond] = true;
    }
    outside
}

/// Distance of each node of the mesh of `cells` to the nearest other one that it sees within their surface, shape (n_points), m.
///
/// Across a thin slot the nearest node of all may be much nearer; a horizon that follows it would reach nothing but the other side.
pub fn spacing_inside(surface: &Surface, cells: &[SolidCell], cloud: &PointCloud<3>) -> Vec<f64> {
    let shortest = shortest_edges(cloud, cells);
    let mut spacing = cloud.spacing.clone();
    // What is nearer than the ends of all edges of cells may lie behind a void.
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
    let inside: Vec<f64> = may_be_parted
        .par_iter()
        .map(|&point| {
            let (position, shortest) = (cloud.positions[point as usize], shortest[point as usize]);
            let near = surface.near(position, shortest);
            let is_seen = |other: u32, length: f64| {
                !surface.is_left_by([point, other], &near, cloud.tolerance(point) * length)
            };
            tree.locate_within_distance(position, shortest * shortest)
                .filter(|other| other.data != point)
                .map(|other| (other.data, distance(position, *other.geom())))
                .filter(|&(other, length)| is_seen(other, length))
                .fold(shortest, |nearest, (_, length)| nearest.min(length))
        })
        .collect();
    for (&point, nearest) in may_be_parted.iter().zip(inside) {
        spacing[point as usize] = nearest;
    }
    spacing
}

#[cfg(test)]
mod tests;
