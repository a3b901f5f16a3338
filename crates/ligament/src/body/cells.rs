//! Named sets of the cells of a lattice, in the plane and in space.

use std::collections::BTreeMap;

use ligament_mesh::Portion;
use ligament_model::cloud::lattice::{Face, Lattice};
use ligament_model::shape::{Region, Shape};
use thiserror::Error;

/// A hole of a lattice: cells whose centre lies in it are removed.
#[derive(Debug, Clone, PartialEq)]
pub struct Hole<S = Shape> {
    /// Name of the group of the cells at the hole's rim; several holes may share it.
    pub name: Option<String>,
    /// Shape of the hole.
    pub shape: S,
}

/// Rule that selects the cells of a set.
#[derive(Debug, Clone, PartialEq)]
pub enum Cells<const D: usize, S> {
    /// The number of layers of cells at the side of the lattice with this outward normal.
    AtSide([i8; D], u32),
    /// Cells whose centre lies in a shape.
    Inside(S),
}

impl Cells<2, Shape> {
    /// The lowest rows of the lattice.
    pub fn bottom(rows: u32) -> Self {
        Self::AtSide([0, -1], rows)
    }

    /// The highest rows of the lattice.
    pub fn top(rows: u32) -> Self {
        Self::AtSide([0, 1], rows)
    }

    /// The leftmost columns of the lattice.
    pub fn left(columns: u32) -> Self {
        Self::AtSide([-1, 0], columns)
    }

    /// The rightmost columns of the lattice.
    pub fn right(columns: u32) -> Self {
        Self::AtSide([1, 0], columns)
    }
}

/// Error of a lattice that makes no body.
#[derive(Debug, Clone, PartialEq, Error)]
pub enum LatticeError {
    /// Holes that remove all cells.
    #[error("nothing is left of the {cells} cells")]
    NothingLeft {
        /// Number of cells of the whole lattice.
        cells: usize,
    },
    /// A set without a cell.
    #[error("no cell has its centre in this set")]
    EmptySet {
        /// Name of the set.
        name: String,
    },
    /// A named hole without a cell at its rim.
    #[error("no cell that is left borders on this hole")]
    NoRim {
        /// Index of the hole.
        hole: usize,
    },
}

/// The named sets of a lattice.
#[derive(Debug)]
pub(super) struct CellSets<const D: usize>(BTreeMap<String, Set<D>>);

/// A named set of points.
#[derive(Debug)]
struct Set<const D: usize> {
    /// Points of the set, ascending.
    points: Vec<u32>,
    /// Length (m), in space area (m^2), of the side that each point represents; none where the set is not at a side.
    part_of_side: Option<f64>,
    /// Faces of the outline that belong to the set.
    faces: Faces<D>,
}

/// Selection of the faces of the outline that belong to a set.
#[derive(Debug, Clone)]
enum Faces<const D: usize> {
    /// Faces of the set's cells.
    OfCells,
    /// Faces on the side of the lattice with this outward normal.
    OfSide([i8; D]),
    /// Faces at the marked holes, shape (n_holes).
    AtHoles(Vec<bool>),
}

/// A lattice with its holes.
///
/// # Errors
///
/// If the holes remove all cells.
pub(super) fn lattice<const D: usize, S: Region<D>>(
    size: [u32; D],
    spacing: [f64; D],
    corner: [f64; D],
    holes: &[Hole<S>],
) -> Result<Lattice<D, S>, LatticeError> {
    let shapes = holes.iter().map(|it| it.shape.clone()).collect();
    let lattice = Lattice::new(size, spacing, corner, shapes);
    if lattice.cells.is_empty() {
        let cells = lattice.n_whole();
        return Err(LatticeError::NothingLeft { cells });
    }
    Ok(lattice)
}

impl<const D: usize> CellSets<D> {
    /// The named sets of a lattice, and the sets at the rims of its named holes, unless a set has the hole's name.
    ///
    /// # Errors
    ///
    /// If a set or the rim of a named hole has no cell.
    pub(super) fn new<S: Region<D>>(
        lattice: &Lattice<D, S>,
        holes: &[Hole<S>],
        named: impl Iterator<Item = (String, Cells<D, S>)>,
    ) -> Result<Self, LatticeError> {
        let mut sets = BTreeMap::new();
        for (name, cells) in named {
            let set = Set::from_cells(&cells, lattice);
            if set.points.is_empty() {
                return Err(LatticeError::EmptySet { name });
            }
            sets.insert(name, set);
        }
        for (index, hole) in holes.iter().enumerate() {
            let Some(name) = hole.name.as_ref().filter(|&name| !sets.contains_key(name)) else {
                continue;
            };
            let shares_name = |it: &Hole<S>| it.name.as_ref() == Some(name);
            let set = Set::at_holes(holes.iter().map(shares_name).collect(), lattice);
            if set.points.is_empty() {
                return Err(LatticeError::NoRim { hole: index });
            }
            sets.insert(name.clone(), set);
        }
        Ok(Self(sets))
    }

    /// The sets with some of the points (ascending), numbered among these.
    pub(super) fn part(&self, points: &[u32]) -> Self {
        let part = |set: &Set<D>| Set {
            points: among(&set.points, points),
            part_of_side: set.part_of_side,
            faces: set.faces.clone(),
        };
        Self(
            (self.0.iter())
                .map(|(name, set)| (name.clone(), part(set)))
                .collect(),
        )
    }

    pub(super) fn names(&self) -> Vec<String> {
        self.0.keys().cloned().collect()
    }

    pub(super) fn points(&self, group: &str) -> Option<Vec<u32>> {
        self.0.get(group).map(|set| set.points.clone())
    }

    /// Points of a set at a side, each with the length (m) or area (m^2) of a cell's face divided by the number of layers; empty for other
    /// sets.
    pub(super) fn parts_of_side(&self, group: &str) -> Vec<Portion<1>> {
        let set = self.0.get(group);
        set.and_then(|set| {
            let part = set.part_of_side?;
            let portion = |&point: &u32| Portion {
                corners: vec![point],
                share: [part],
            };
            Some(set.points.iter().map(portion).collect())
        })
        .unwrap_or_default()
    }

    /// Outward normals of the outline along a group, each with the point of its cell: for layers at a side the faces on that side, for the
    /// rim of a hole the faces towards the hole, otherwise all faces of the group's cells that have no neighbour.
    pub(super) fn outline<S: Region<D>>(
        &self,
        group: &str,
        lattice: &Lattice<D, S>,
    ) -> Vec<Portion<D>> {
        let Some(set) = self.0.get(group) else {
            return Vec::new();
        };
        let belongs = |face: &Face<D>| match set.faces {
            Faces::OfSide(normal) => face.is_on_box && face.normal == normal,
            Faces::AtHoles(ref holes) => face.hole.is_some_and(|hole| holes[hole]),
            Faces::OfCells => set.points.binary_search(&face.point).is_ok(),
        };
        let mut normals: BTreeMap<u32, [f64; D]> = BTreeMap::new();
        for face in lattice.outline().iter().filter(|face| belongs(face)) {
            let size = lattice.face_size(face.normal);
            let sum = normals.entry(face.point).or_insert([0.0; D]);
            for (axis, cosine) in face.normal.into_iter().enumerate() {
                sum[axis] += f64::from(cosine) * size;
            }
        }
        let portion = |(point, share)| Portion {
            corners: vec![point],
            share,
        };
        normals.into_iter().map(portion).collect()
    }
}

impl<const D: usize> Set<D> {
    /// The cells at the rim of some of the holes, marked in `holes` (n_holes).
    fn at_holes<S: Region<D>>(holes: Vec<bool>, lattice: &Lattice<D, S>) -> Self {
        let faces = lattice.outline().into_iter();
        let towards = faces.filter(|face| face.hole.is_some_and(|hole| holes[hole]));
        let mut points: Vec<u32> = towards.map(|face| face.point).collect();
        points.dedup();
        Self {
            points,
            part_of_side: None,
            faces: Faces::AtHoles(holes),
        }
    }

    fn from_cells<S: Region<D>>(cells: &Cells<D, S>, lattice: &Lattice<D, S>) -> Self {
        match cells {
            Cells::AtSide(normal, layers) => Self {
                points: lattice.points_at_side(*normal, *layers),
                part_of_side: Some(lattice.face_size(*normal) / f64::from(*layers)),
                faces: Faces::OfSide(*normal),
            },
            Cells::Inside(shape) => Self {
                points: lattice.points_in(shape),
                part_of_side: None,
                faces: Faces::OfCells,
            },
        }
    }
}

/// Indices in `others` (ascending) of the `points` (ascending) that it contains; the shorter list is searched for in the longer one.
pub(super) fn among(points: &[u32], others: &[u32]) -> Vec<u32> {
    if others.len() < points.len() {
        let is_there = |(_, point): &(u32, &u32)| points.binary_search(point).is_ok();
        let numbered = (0..).zip(others).filter(is_there);
        return numbered.map(|(place, _)| place).collect();
    }
    let place = |point: &u32| others.binary_search(point).ok();
    let places = points.iter().filter_map(place);
    places.map(|place| place as u32).collect()
}

/// The cells that lack a neighbour, shape (n_points).
pub(super) fn rim<const D: usize, S: Region<D>>(lattice: &Lattice<D, S>) -> Vec<bool> {
    let mut marked = vec![false; lattice.cells.len()];
    for face in lattice.outline() {
        marked[face.point as usize] = true;
    }
    marked
}
