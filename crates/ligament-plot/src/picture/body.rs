//! The body of an output, with its displacement magnified.

use std::collections::HashMap;

use ligament_output::results::cracks::StoredCracks;
use ligament_output::results::fields::DISPLACEMENT;
use ligament_output::results::{StoredState, location, sides_between_materials};
use ligament_output::vtu::Cell;
use ligament_output::vtu::read::VtuFile;
use ligament_output::{Error, FieldLocation};

use crate::drawing::frame::bounds;

/// Share of the body's size at which the largest displacement is drawn, where the program chooses the scale.
const DRAWN_SHARE: f64 = 0.05;

/// Share of the body's size at which the largest displacement of a mode is drawn.
pub(super) const MODE_SHARE: f64 = 0.1;

/// Cells with the positions and displacements of their corners.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Body {
    /// Positions without load, shape (n), m.
    pub(super) reference: Vec<[f64; 2]>,
    /// Displacements, shape (n), m; for a mode with an arbitrary amplitude.
    pub(super) displacement: Vec<[f64; 2]>,
    /// Triangles and quadrangles.
    pub(super) cells: Vec<Cell>,
    /// Kind of the model's points: nodes, or cells of a lattice.
    tagged: FieldLocation,
    /// Indices of the points by their tags.
    places: HashMap<i64, usize>,
    /// Sides of cells along which other materials begin: reference and displacement of their ends, m.
    interfaces: Vec<[([f64; 2], [f64; 2]); 2]>,
}

impl Body {
    /// Cells with corners at these positions (m) and their displacements (m), and the kind of the model's points, which have no tags.
    pub(super) fn new(
        reference: Vec<[f64; 2]>,
        displacement: Vec<[f64; 2]>,
        cells: Vec<Cell>,
        tagged: FieldLocation,
    ) -> Self {
        Self {
            reference,
            displacement,
            cells,
            tagged,
            places: HashMap::new(),
            interfaces: Vec::new(),
        }
    }

    /// Reads the body from an output.
    pub(super) fn read(file: &VtuFile) -> Result<Self, Error> {
        let moved = file.finite_numbers(FieldLocation::Point, DISPLACEMENT.name)?;
        let tagged = location(file);
        let (_, tags) = file.tags(tagged)?;
        let reference = file.points_in_plane()?;
        let displacement: Vec<[f64; 2]> = moved.chunks_exact(3).map(|v| [v[0], v[1]]).collect();
        let end = |corner: u32| (reference[corner as usize], displacement[corner as usize]);
        let sides = sides_between_materials(file)?;
        Ok(Self {
            interfaces: sides.into_iter().map(|side| side.map(end)).collect(),
            reference,
            displacement,
            cells: file.cells()?,
            tagged,
            places: tags.into_iter().zip(0..).collect(),
        })
    }

    /// The sides along which other materials begin, with the displacement times a scale, m.
    pub(super) fn interfaces(&self, scale: f64) -> Vec<[[f64; 2]; 2]> {
        let moved = |(p, u): ([f64; 2], [f64; 2])| [0, 1].map(|axis| p[axis] + scale * u[axis]);
        self.interfaces.iter().map(|side| side.map(moved)).collect()
    }

    /// Cuts the cells of a mesh along the cracks in a state, so that they open with the displacement, and gives the new
    /// corners the means of `values` (n_points); other bodies are unchanged.
    pub(super) fn open(
        &mut self,
        cracks: &StoredCracks,
        state: StoredState,
        values: Option<&mut Vec<f64>>,
    ) {
        if !self.is_mesh() {
            return;
        }
        let opened = cracks.opened_cells(state);
        let moved = [0, 1].map(|axis| opened.means(|point| self.displacement[point][axis]));
        self.displacement = moved[0]
            .iter()
            .zip(&moved[1])
            .map(|(&x, &y)| [x, y])
            .collect();
        if let Some(values) = values {
            *values = opened.means(|point| values[point]);
        }
        self.cells = opened.cells.into_iter().map(Cell::from).collect();
        self.reference = opened.positions.iter().map(|it| [it[0], it[1]]).collect();
    }

    /// Whether the cells of the body share their corners.
    pub(super) fn is_mesh(&self) -> bool {
        self.tagged == FieldLocation::Point
    }

    /// Positions with the displacement times a scale, shape (n), m.
    pub(super) fn deformed(&self, scale: f64) -> Vec<[f64; 2]> {
        let moved = self.reference.iter().zip(&self.displacement);
        moved
            .map(|(p, u)| [p[0] + scale * u[0], p[1] + scale * u[1]])
            .collect()
    }

    /// Larger side of the box around the unloaded body, m.
    pub(super) fn size(&self) -> f64 {
        bounds(&self.reference).map_or(0.0, |[low, high]| (high[0] - low[0]).max(high[1] - low[1]))
    }

    /// Largest length of a displacement.
    pub(super) fn largest_displacement(&self) -> f64 {
        let lengths = self.displacement.iter().map(|u| u[0].hypot(u[1]));
        lengths.filter(|it| it.is_finite()).fold(0.0, f64::max)
    }

    /// The scale at which the largest displacement is a share of the body's size.
    pub(super) fn scale_for_share(&self, share: f64) -> f64 {
        let largest = self.largest_displacement();
        if largest > 0.0 {
            share * self.size() / largest
        } else {
            1.0
        }
    }

    /// The largest scale that the program chooses for the body; `None` where nothing moved.
    pub(super) fn drawn_scale(&self) -> Option<f64> {
        let has_moved = self.largest_displacement() > 0.0;
        has_moved.then(|| self.scale_for_share(DRAWN_SHARE))
    }

    /// Position of the point with a tag among deformed positions, shape (n); `None` where there is no such tag.
    pub(super) fn place(&self, tag: i64, positions: &[[f64; 2]]) -> Option<[f64; 2]> {
        let place = *self.places.get(&tag)?;
        match self.tagged {
            FieldLocation::Point => positions.get(place).copied(),
            FieldLocation::Cell => {
                let corners = self.cells.get(place)?.points();
                let sum = corners.iter().map(|&it| positions[it as usize]);
                let [x, y] = sum.fold([0.0, 0.0], |[x, y], [dx, dy]| [x + dx, y + dy]);
                Some([x, y].map(|it| it / corners.len() as f64))
            }
        }
    }
}

/// A scale for all bodies: the largest displacement is 2 to 5 % of the body.
pub(super) fn common_scale<'a>(bodies: impl Iterator<Item = &'a Body>) -> f64 {
    common_scale_from(bodies.filter_map(Body::drawn_scale))
}

/// A scale for bodies with these largest scales, the smallest rounded down to 1, 2 or 5 times a power of ten.
pub(super) fn common_scale_from(scales: impl Iterator<Item = f64>) -> f64 {
    scales.reduce(f64::min).map_or(1.0, rounded_down)
}

fn rounded_down(scale: f64) -> f64 {
    let power = 10f64.powf(scale.log10().floor());
    let steps = [5.0, 2.0, 1.0].map(|it| it * power);
    let fits = |it: &f64| *it <= scale * (1.0 + 1e-9);
    steps.into_iter().find(fits).unwrap_or(power)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn square(tagged: FieldLocation) -> Body {
        Body {
            reference: vec![[0.0, 0.0], [2.0, 0.0], [2.0, 1.0], [0.0, 1.0]],
            displacement: vec![[0.0, 0.0], [0.01, 0.0], [0.01, -0.02], [0.0, -0.02]],
            cells: vec![Cell::Quad([0, 1, 2, 3])],
            tagged,
            places: HashMap::from([(7, 0)]),
            interfaces: Vec::new(),
        }
    }

    #[test]
    fn points_move_by_the_scaled_displacement() {
        let body = square(FieldLocation::Point);
        assert_eq!(body.deformed(10.0)[2], [2.1, 0.8]);
        assert_eq!(body.deformed(0.0), body.reference);
        assert_eq!(body.place(7, &body.deformed(10.0)), Some([0.0, 0.0]));
        assert_eq!(body.place(8, &body.reference), None);
        let cell = square(FieldLocation::Cell);
        let [x, y] = cell.place(7, &cell.deformed(10.0)).unwrap();
        assert!((x - 1.05).abs() < 1e-15 && (y - 0.4).abs() < 1e-15);
    }

    /// The largest displacement is hypot(0.01, 0.02) = 0.02236, 5 % of the size of 2 is 0.1: 4.47 times it, so 2 is drawn.
    #[test]
    fn a_common_scale_is_round() {
        assert_eq!(common_scale([square(FieldLocation::Point)].iter()), 2.0);
        assert_eq!(
            [0.9, 1.0, 4.9, 5.0, 19.0].map(rounded_down),
            [0.5, 1.0, 2.0, 5.0, 10.0]
        );
        assert_eq!(common_scale(std::iter::empty()), 1.0);
    }
}
