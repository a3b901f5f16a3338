//! A box of equal cells in space with named sets of cells.

use std::collections::BTreeMap;

use ligament_model::space::lattice::{SolidFace, SolidLattice};
use ligament_model::space::shape::SolidShape;
use ligament_model::{BodyGrid, Canvas, PointCloud};

use super::interface::{Body, OffOutline, Origin};
use super::lattice::LatticeError;

/// A body with a point at the centre of each cell of a box, by named sets of cells.
#[derive(Debug)]
pub struct SolidLatticeBody {
    lattice: SolidLattice,
    /// Positions of the points, shape (n_points), m.
    positions: Vec<[f64; 3]>,
    sets: BTreeMap<String, Set>,
}

/// A hole of a box.
#[derive(Debug, Clone, PartialEq)]
pub struct SolidHole {
    /// Name of the cells at its surface; none where it makes no group.
    pub name: Option<String>,
    /// Shape of the hole.
    pub shape: SolidShape,
}

/// Cells that make a set of a box.
#[derive(Debug, Clone, PartialEq)]
pub enum SolidCellSet {
    /// So many layers at the side of the box with this outward normal.
    AtSide([i8; 3], u32),
    /// Cells whose centre lies in a shape.
    Inside(SolidShape),
}

/// A named set of points.
#[derive(Debug)]
struct Set {
    /// Points of the set, ascending.
    points: Vec<u32>,
    /// Area of the side that each point stands for, m^2: none where the set is no part of a side.
    area: Option<f64>,
    /// Part of the outline that belongs to the set.
    faces: Faces,
}

/// The faces, with no cell behind them, that belong to a set.
#[derive(Debug)]
enum Faces {
    /// The faces of the cells of the set.
    OfCells,
    /// The faces on one side of the box, with this outward normal.
    OfSide([i8; 3]),
    /// The faces at some of the holes, shape (n_holes).
    AtHoles(Vec<bool>),
}

impl SolidLatticeBody {
    /// A box with named sets of cells and the holes that took cells from it; named holes are groups too, unless a set has their name.
    ///
    /// # Errors
    ///
    /// If nothing is left of the box, or a set or the surface of a named hole has no cell.
    pub fn new(
        size: [u32; 3],
        spacing: [f64; 3],
        corner: [f64; 3],
        holes: &[SolidHole],
        named: &BTreeMap<String, SolidCellSet>,
    ) -> Result<Self, LatticeError> {
        let shapes = holes.iter().map(|it| it.shape.clone()).collect();
        let lattice = SolidLattice::new(size, spacing, corner, shapes);
        if lattice.cells.is_empty() {
            let cells = lattice.n_whole();
            return Err(LatticeError::NothingLeft { cells });
        }
        let mut sets = BTreeMap::new();
        for (name, cells) in named {
            let set = Set::from_cells(cells, &lattice);
            if set.points.is_empty() {
                return Err(LatticeError::EmptySet { name: name.clone() });
            }
            sets.insert(name.clone(), set);
        }
        for (index, hole) in holes.iter().enumerate() {
            let Some(name) = hole.name.as_ref().filter(|&name| !sets.contains_key(name)) else {
                continue;
            };
            let shares_name = |it: &SolidHole| it.name.as_ref() == Some(name);
            let set = Set::at_holes(holes.iter().map(shares_name).collect(), &lattice);
            if set.points.is_empty() {
                return Err(LatticeError::NoRim { hole: index });
            }
            sets.insert(name.clone(), set);
        }
        let middle = lattice.middle();
        let positions = lattice.cells.iter().map(|&cell| {
            let offset = lattice.offset(cell);
            [0, 1, 2].map(|axis| middle[axis] + offset[axis])
        });
        Ok(Self {
            positions: positions.collect(),
            lattice,
            sets,
        })
    }
}

impl Set {
    /// The cells at the surface of some of the holes, marked in `holes` (n_holes).
    fn at_holes(holes: Vec<bool>, lattice: &SolidLattice) -> Self {
        let faces = lattice.outline().into_iter();
        let towards = faces.filter(|face| face.hole.is_some_and(|hole| holes[hole]));
        let mut points: Vec<u32> = towards.map(|face| face.point).collect();
        points.dedup();
        Self {
            points,
            area: None,
            faces: Faces::AtHoles(holes),
        }
    }

    fn from_cells(cells: &SolidCellSet, lattice: &SolidLattice) -> Self {
        match cells {
            SolidCellSet::AtSide(normal, layers) => Self {
                points: lattice.points_at_side(*normal, *layers),
                area: Some(lattice.face_area(*normal) / f64::from(*layers)),
                faces: Faces::OfSide(*normal),
            },
            SolidCellSet::Inside(shape) => Self {
                points: lattice.points_in(shape),
                area: None,
                faces: Faces::OfCells,
            },
        }
    }
}

impl Body<3> for SolidLatticeBody {
    fn origin(&self) -> Origin<'_> {
        Origin::SolidLattice(&self.lattice)
    }

    fn positions(&self) -> &[[f64; 3]] {
        &self.positions
    }

    fn tagged(&self) -> &'static str {
        "cell"
    }

    /// Cells that are left count from 1.
    fn tag(&self, point: u32) -> u64 {
        u64::from(point) + 1
    }

    fn n_cells(&self) -> usize {
        self.lattice.cells.len()
    }

    fn cloud(&self, _: f64, material_of_cell: &[u32], n_materials: usize) -> PointCloud<3> {
        PointCloud::from_solid_lattice(&self.lattice, material_of_cell, n_materials)
    }

    fn group_kind(&self) -> &'static str {
        "set of the lattice"
    }

    fn group_names(&self) -> Vec<String> {
        self.sets.keys().cloned().collect()
    }

    fn points_of(&self, group: &str) -> Option<Vec<u32>> {
        self.sets.get(group).map(|set| set.points.clone())
    }

    /// Cells of the group, which are its points.
    fn cells_of(&self, group: &str) -> Option<Vec<u32>> {
        self.points_of(group)
    }

    fn lengths_of(&self, _: &str) -> Vec<(u32, f64)> {
        Vec::new()
    }

    /// The side of a cell spread over the layers of the set.
    fn areas_of(&self, group: &str) -> Vec<(u32, f64)> {
        let set = self.sets.get(group);
        set.and_then(|set| {
            let area = set.area?;
            Some(set.points.iter().map(|&point| (point, area)).collect())
        })
        .unwrap_or_default()
    }

    /// The face of a cell at its point; on layers of a side those on the box, at the cells of a hole those towards it, else all faces of the
    /// cells behind which there is no cell.
    fn outline_of(&self, group: &str) -> Result<Vec<(u32, [f64; 3])>, OffOutline> {
        let Some(set) = self.sets.get(group) else {
            return Ok(Vec::new());
        };
        let belongs = |face: &SolidFace| match set.faces {
            Faces::OfSide(normal) => face.is_on_box && face.normal == normal,
            Faces::AtHoles(ref holes) => face.hole.is_some_and(|hole| holes[hole]),
            Faces::OfCells => set.points.binary_search(&face.point).is_ok(),
        };
        let mut normals: BTreeMap<u32, [f64; 3]> = BTreeMap::new();
        for face in self.lattice.outline().iter().filter(|face| belongs(face)) {
            let area = self.lattice.face_area(face.normal);
            let sum = normals.entry(face.point).or_default();
            for (axis, cosine) in face.normal.into_iter().enumerate() {
                sum[axis] += f64::from(cosine) * area;
            }
        }
        Ok(normals.into_iter().collect())
    }

    /// The cells that lack one of six neighbours.
    fn rim(&self) -> Vec<bool> {
        let mut marked = vec![false; self.positions.len()];
        for face in self.lattice.outline() {
            marked[face.point as usize] = true;
        }
        marked
    }

    fn grid(&self) -> BodyGrid {
        let half = self.lattice.spacing.map(|side| 0.5 * side);
        let corners = |p: &[f64; 3]| {
            [-1.0, 1.0].map(|sign| [0, 1, 2].map(|axis| p[axis] + sign * half[axis]))
        };
        BodyGrid {
            positions: self.positions.clone(),
            tags: (1..=self.positions.len() as i64).collect(),
            tagged: self.tagged(),
            canvas: Canvas::Boxes(self.positions.iter().map(corners).collect()),
        }
    }
}
