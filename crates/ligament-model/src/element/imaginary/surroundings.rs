//! Bonds of a lattice that support each other: neighbours of the points and corners of the rectangles.

use super::BondClass;
use crate::bonds::{BondSet, Incidence};

/// Number of a missing bond.
const NONE: u32 = u32::MAX;

/// Bonds around each point and each bond of a lattice.
#[derive(Debug, Clone, PartialEq)]
pub struct Surroundings {
    /// Neighbours of each point on its left and right, below and above, with the bonds of one spacing to them, shape (n_points, 2, 2).
    links: Vec<[[Link; 2]; 2]>,
    /// Edges of the rectangle of each S bond that meet at its two other corners, shape (n_bonds, 2, 2).
    edges: Vec<[[Link; 2]; 2]>,
    /// Bonds whose elements change when a bond breaks, itself left out, for each bond.
    dependents: Incidence,
}

/// A neighbour of a point on the lattice with the bond to it, if there is one.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Link {
    bond: u32,
    point: u32,
}

const NO_LINK: Link = Link {
    bond: NONE,
    point: NONE,
};

impl Link {
    #[inline]
    fn is_there(&self, is_linked: impl Fn(u32) -> bool) -> bool {
        self.bond != NONE && is_linked(self.bond)
    }
}

impl Surroundings {
    /// The surroundings of bonds between the points of a lattice with rectangular cells: the shortest bonds along x and along y give its
    /// spacings.
    pub fn from_bonds(bonds: &BondSet) -> Self {
        let spacing = spacings(bonds);
        let steps = |bond: u32, from: u32| {
            let bond = bond as usize;
            let sign = if bonds.ends[bond][0] == from {
                1.0
            } else {
                -1.0
            };
            [0, 1].map(|axis| {
                let along = sign * bonds.direction[bond][axis] * bonds.length[bond];
                (along / spacing[axis]).round() as i32
            })
        };
        let link = |from: u32, wanted: [i32; 2]| {
            let family = bonds.incidence.at(from).iter();
            let mut found = family.filter(|&&bond| steps(bond, from) == wanted);
            found.next().map_or(NO_LINK, |&bond| Link {
                bond,
                point: bonds.neighbour(bond, from),
            })
        };
        let n_points = bonds.incidence.n_points() as u32;
        let links: Vec<[[Link; 2]; 2]> = (0..n_points)
            .map(|point| {
                [[[-1, 0], [1, 0]], [[0, -1], [0, 1]]]
                    .map(|both| both.map(|step| link(point, step)))
            })
            .collect();
        let edges: Vec<[[Link; 2]; 2]> = (0..bonds.len() as u32)
            .map(|bond| {
                let [first, second] = bonds.ends[bond as usize];
                let [p, q] = steps(bond, first);
                if p == 0 || q == 0 {
                    return [[NO_LINK; 2]; 2];
                }
                [
                    [link(first, [0, q]), link(second, [-p, 0])],
                    [link(first, [p, 0]), link(second, [0, -q])],
                ]
            })
            .collect();
        let dependents = dependents(bonds, &links, &edges);
        Self {
            links,
            edges,
            dependents,
        }
    }

    /// Points of the difference quotient at a point along an axis (0: x, 1: y); `None` without a linked neighbour.
    #[inline]
    pub(super) fn stencil(
        &self,
        point: u32,
        axis: usize,
        is_linked: impl Fn(u32) -> bool,
    ) -> Option<[u32; 2]> {
        let ends = self.links[point as usize][axis].map(|link| {
            if link.is_there(&is_linked) {
                link.point
            } else {
                point
            }
        });
        (ends[0] != ends[1]).then_some(ends)
    }

    /// Remaining corners of the rectangle of an S bond.
    #[inline]
    pub(super) fn corners(&self, bond: usize, is_linked: impl Fn(u32) -> bool) -> [Option<u32>; 2] {
        self.edges[bond].map(|edges| {
            let mut left = edges.iter().filter(|edge| edge.is_there(&is_linked));
            left.next().map(|edge| edge.point)
        })
    }

    /// Bonds whose elements may change when a bond breaks, itself left out, ascending.
    pub fn dependents(&self, bond: u32) -> &[u32] {
        self.dependents.at(bond)
    }
}

/// Distances between the columns and between the rows of a lattice, from the shortest bonds along x and along y, m.
fn spacings(bonds: &BondSet) -> [f64; 2] {
    let along = |class: BondClass| {
        let of_bonds = bonds.direction.iter().zip(&bonds.length);
        let of_class =
            of_bonds.filter(|(direction, _)| BondClass::from_direction(**direction) == class);
        of_class.fold(f64::INFINITY, |least, (_, &length)| least.min(length))
    };
    [along(BondClass::Horizontal), along(BondClass::Vertical)]
}

/// Bonds that each bond supports: for a V bond of one spacing the H bonds at its ends, for such an H bond the V bonds at its ends, and the S bonds
/// whose rectangle has it as an edge.
fn dependents(bonds: &BondSet, links: &[[[Link; 2]; 2]], edges: &[[[Link; 2]; 2]]) -> Incidence {
    let supports = |bond: u32| -> Vec<u32> {
        let of_edges = edges[bond as usize].as_flattened();
        let [along_x, along_y] = bonds.direction[bond as usize].map(|cosine| cosine != 0.0);
        let axes = [!along_x, !along_y].into_iter().enumerate();
        let crossed = axes
            .filter(|(_, is_crossed)| *is_crossed)
            .map(|(axis, _)| axis);
        let of_ends = crossed.flat_map(|axis| {
            bonds.ends[bond as usize]
                .into_iter()
                .flat_map(move |end| links[end as usize][axis])
        });
        let all = of_edges.iter().copied().chain(of_ends);
        all.map(|link| link.bond)
            .filter(|&bond| bond != NONE)
            .collect()
    };
    Incidence::from_pairs(
        (0..bonds.len() as u32).flat_map(|bond| {
            let supports = supports(bond);
            supports.into_iter().map(move |support| (support, bond))
        }),
        bonds.len(),
    )
}
