//! A body from arrays: positions, volumes and named groups of points.

use std::borrow::Cow;
use std::collections::BTreeMap;
use std::sync::Arc;

use ligament_mesh::Portion;
use ligament_model::correction::patch::CellForces;
use ligament_model::material::Stiffness;
use ligament_model::{BodyGrid, Canvas, Numbering, PointCloud, PointTags, Tags, raised};
use thiserror::Error;

use super::cells::among;
use super::interface::{Body, Geometry, OffOutline, Origin, Restricted};

/// A body of points from arrays, each with the area, or in space the volume, that it represents. Groups are sets of points without length
/// and outline, so that forces are distributed over their points by volume.
#[derive(Debug, Clone, PartialEq)]
pub struct Points<const D: usize = 2> {
    /// Numbering of the points here, along a space-filling curve, and in the arrays.
    numbering: Numbering,
    positions: Vec<[f64; D]>,
    sizes: Vec<f64>,
    groups: BTreeMap<String, Vec<u32>>,
}

/// Error of arrays that make no body.
#[derive(Debug, Clone, PartialEq, Error)]
pub enum PointsError {
    /// Arrays of different lengths, or empty ones.
    #[error(
        "{positions} positions and {sizes} {what}s: every point needs one of each, and there must be a point"
    )]
    Lengths {
        /// Number of positions.
        positions: usize,
        /// Number of areas or volumes.
        sizes: usize,
        /// Quantity that a point represents: `area`, or in space `volume`.
        what: &'static str,
    },
    /// A position, an area or a volume that is not finite, or an area or a volume that is not positive.
    #[error(
        "point {point} has the position {position:?} and the {what} {size:?}: positions must be finite, {what}s greater than 0"
    )]
    NoSuchPoint {
        /// Index of the point.
        point: usize,
        /// Position of the point, m.
        position: Vec<f64>,
        /// Area of the point, m^2, or its volume, m^3.
        size: f64,
        /// Quantity that a point represents: `area`, or in space `volume`.
        what: &'static str,
    },
    /// A group without points, or with an index of no point.
    #[error("group `{group}` {}: it takes indices below {n_points}, one or more", match found {
        Some(found) => format!("has the point {found}"),
        None => "is empty".to_owned(),
    })]
    Group {
        /// Name of the group.
        group: String,
        /// Index that is too large; none where the group is empty.
        found: Option<u32>,
        /// Number of points.
        n_points: usize,
    },
}

impl<const D: usize> Points<D> {
    /// Points at `positions` (n_points, m), each with the area (n_points, m^2), or in space the volume (n_points, m^3), that it represents.
    ///
    /// # Errors
    ///
    /// If the arrays have different lengths or no element, a value is not finite, or an area or a volume is not positive.
    pub fn new(positions: Vec<[f64; D]>, sizes: Vec<f64>) -> Result<Self, PointsError> {
        let what = if D == 2 { "area" } else { "volume" };
        if positions.len() != sizes.len() || positions.is_empty() {
            return Err(PointsError::Lengths {
                positions: positions.len(),
                sizes: sizes.len(),
                what,
            });
        }
        let is_point = |(position, size): (&[f64; D], &f64)| {
            position.iter().all(|it| it.is_finite()) && *size > 0.0 && size.is_finite()
        };
        let wrong = (positions.iter().zip(&sizes)).position(|it| !is_point(it));
        match wrong {
            Some(point) => Err(PointsError::NoSuchPoint {
                point,
                position: positions[point].to_vec(),
                size: sizes[point],
                what,
            }),
            None => {
                let numbering = Numbering::along_curve(&positions);
                Ok(Self {
                    positions: numbering.from_file(positions),
                    sizes: numbering.from_file(sizes),
                    numbering,
                    groups: BTreeMap::new(),
                })
            }
        }
    }

    /// The body with a further group of points, by their indices.
    ///
    /// # Errors
    ///
    /// If the group is empty or has an index of no point.
    pub fn with_group(
        mut self,
        name: &str,
        points: impl IntoIterator<Item = u32>,
    ) -> Result<Self, PointsError> {
        let mut points: Vec<u32> = points.into_iter().collect();
        points.sort_unstable();
        points.dedup();
        let n_points = self.positions.len();
        let last = points.last().copied();
        if last.is_none_or(|last| last as usize >= n_points) {
            return Err(PointsError::Group {
                group: name.to_owned(),
                found: last,
                n_points,
            });
        }
        let mut points: Vec<u32> = points.iter().map(|it| self.numbering.point(*it)).collect();
        points.sort_unstable();
        self.groups.insert(name.to_owned(), points);
        Ok(self)
    }
}

impl<const D: usize> Body for Points<D> {
    fn origin(&self) -> Origin<'_> {
        Origin::Points
    }

    fn n_points(&self) -> usize {
        self.positions.len()
    }

    fn position(&self, point: u32) -> Vec<f64> {
        self.positions[point as usize].to_vec()
    }

    fn numbering(&self) -> Numbering {
        self.numbering.clone()
    }

    fn tagged(&self) -> &'static str {
        "point"
    }

    fn tag(&self, point: u32) -> u64 {
        u64::from(self.numbering.in_file(point))
    }

    /// Number of cells: each point is a cell of its own.
    fn n_cells(&self) -> usize {
        self.positions.len()
    }

    fn group_kind(&self) -> &'static str {
        "group of points"
    }

    fn group_names(&self) -> Vec<String> {
        self.groups.keys().cloned().collect()
    }

    fn points_of(&self, group: &str) -> Option<Vec<u32>> {
        self.groups.get(group).cloned()
    }

    fn cells_of(&self, group: &str) -> Option<Vec<u32>> {
        self.points_of(group)
    }

    fn lengths_of(&self, _: &str) -> Vec<Portion<1>> {
        Vec::new()
    }

    fn point_tags(&self) -> PointTags {
        PointTags {
            numbering: self.numbering(),
            tags: Tags::Counted(0),
        }
    }

    fn names(self: Arc<Self>) -> Arc<dyn Body> {
        Arc::new(Self {
            numbering: self.numbering(),
            positions: self.positions.clone(),
            sizes: Vec::new(),
            groups: BTreeMap::new(),
        })
    }

    /// Marks no point: arrays do not define the edge of the body.
    fn rim(&self) -> Vec<bool> {
        vec![false; self.positions.len()]
    }

    /// Grid of the body with a square of its area, in space a cube of its volume, around each point.
    fn grid(&self) -> BodyGrid {
        let positions = raised(&self.positions);
        let around = positions.iter().zip(&self.sizes);
        let canvas = if D == 2 {
            let square = |([x, y, _], area): (&[f64; 3], &f64)| {
                let half = 0.5 * area.sqrt();
                [[-half, -half], [half, -half], [half, half], [-half, half]]
                    .map(|[right, up]| [x + right, y + up])
            };
            Canvas::Around(around.map(square).collect())
        } else {
            let cube = |(position, volume): (&[f64; 3], &f64)| {
                let half = 0.5 * volume.cbrt();
                [position.map(|it| it - half), position.map(|it| it + half)]
            };
            Canvas::Boxes(around.map(cube).collect())
        };
        BodyGrid {
            numbering: self.numbering(),
            tags: (0..positions.len() as u32)
                .map(|point| i64::from(self.numbering.in_file(point)))
                .collect(),
            positions,
            cell_numbers: Vec::new(),
            of_body: None,
            tagged: self.tagged(),
            canvas,
        }
    }
}

impl<const D: usize> Points<D> {
    /// Some of the points (ascending), with their groups.
    fn part(&self, points: &[u32]) -> Self {
        let indices = points.iter().map(|&point| point as usize);
        let groups = self.groups.iter();
        Self {
            numbering: self.numbering.part(points),
            positions: indices.clone().map(|it| self.positions[it]).collect(),
            sizes: indices.map(|it| self.sizes[it]).collect(),
            groups: groups
                .map(|(name, group)| (name.clone(), among(group, points)))
                .collect(),
        }
    }
}

impl<const D: usize> Geometry<D> for Points<D> {
    fn restricted(&self, points: &[u32], _: &[u32]) -> Restricted<D> {
        Restricted {
            body: Arc::new(self.part(points)),
            cells: points.to_vec(),
        }
    }

    fn positions(&self) -> Cow<'_, [[f64; D]]> {
        Cow::Borrowed(&self.positions)
    }

    fn cloud(&self, thickness: f64, material_of_cell: &[u32], n_materials: usize) -> PointCloud<D> {
        // The thickness in space is 1.
        let volumes: Vec<f64> = self.sizes.iter().map(|size| size * thickness).collect();
        let positions = &self.positions;
        PointCloud {
            numbering: self.numbering(),
            ..PointCloud::from_points(
                positions,
                &volumes,
                thickness,
                material_of_cell,
                n_materials,
            )
        }
    }

    /// No forces, because arrays have no cells.
    fn cell_forces(
        &self,
        cloud: &PointCloud<D>,
        _: &[u32],
        stiffness: Vec<Stiffness>,
    ) -> CellForces<D> {
        CellForces::none(cloud.len(), stiffness)
    }

    fn outline_of(&self, _: &str) -> Result<Vec<Portion<D>>, OffOutline> {
        Ok(Vec::new())
    }
}
