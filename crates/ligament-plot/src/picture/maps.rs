//! Maps of one quantity on bodies in memory, side by side with the same colours, to compare results of several methods.

use ligament_output::FieldLocation;
use ligament_output::vtu::Cell;

use super::PictureError;
use super::body::{Body, MODE_SHARE, common_scale};
use super::colour_bar::ColourBar;
use super::colour_map::ColourMap;
use super::field::{Field, normalise_by_quantile};
use super::panel::{Panel, Scale};
use super::strip::{LegendEntry, Strip};
use super::style::magnification_words;
use crate::drawing::{Drawing, PIXELS_PER_MM};

/// A body with a value at each of its corners or cells.
#[derive(Debug, Clone, PartialEq)]
pub struct MappedBody {
    title: String,
    body: Body,
    location: FieldLocation,
    values: Vec<f64>,
}

/// Maps of a quantity, side by side.
#[derive(Debug, Clone, PartialEq)]
pub struct Maps {
    /// Name of the file, without its extension.
    pub name: String,
    /// Title of the map.
    pub title: String,
    /// Quantity that the maps show.
    pub quantity: String,
    /// SI unit of the quantity; `-` without one.
    pub unit: &'static str,
    /// The bodies, in rows.
    pub bodies: Vec<MappedBody>,
    /// Bodies in a row.
    pub columns: usize,
    /// Whether the bodies are natural modes, whose amplitude is arbitrary: all have the same largest displacement, and values relative to
    /// their largest.
    pub are_modes: bool,
}

impl MappedBody {
    /// A mesh with a displacement (m) and a value at each node, both of shape (n_nodes).
    pub fn from_mesh(
        title: impl Into<String>,
        nodes: Vec<[f64; 2]>,
        cells: Vec<Cell>,
        displacements: Vec<[f64; 2]>,
        values: Vec<f64>,
    ) -> Self {
        Self {
            title: title.into(),
            body: Body::new(nodes, displacements, cells, FieldLocation::Point),
            location: FieldLocation::Point,
            values,
        }
    }

    /// A lattice, each of whose points has a square as wide as the spacing (m) that moves with it, a displacement (m) and a
    /// value; all of shape (n_points).
    pub fn from_lattice(
        title: impl Into<String>,
        points: &[[f64; 2]],
        spacing: f64,
        displacements: &[[f64; 2]],
        values: Vec<f64>,
    ) -> Self {
        let half = 0.5 * spacing;
        let around = |[x, y]: &[f64; 2]| {
            let signs = [[-1.0, -1.0], [1.0, -1.0], [1.0, 1.0], [-1.0, 1.0]];
            signs.map(|[sx, sy]| [x + sx * half, y + sy * half])
        };
        let squares: Vec<[[f64; 2]; 4]> = points.iter().map(around).collect();
        Self::from_squares(title, &squares, displacements, values)
    }

    /// A body whose points have a square each, by its corners (m), that moves with it, a displacement (m) and a value; all of shape
    /// (n_points).
    pub fn from_squares(
        title: impl Into<String>,
        squares: &[[[f64; 2]; 4]],
        displacements: &[[f64; 2]],
        values: Vec<f64>,
    ) -> Self {
        let moved = displacements.iter().flat_map(|it| [*it; 4]).collect();
        let square = |point: u32| Cell::Quad([0, 1, 2, 3].map(|corner| 4 * point + corner));
        let cells = (0..squares.len() as u32).map(square).collect();
        Self {
            title: title.into(),
            body: Body::new(
                squares.as_flattened().to_vec(),
                moved,
                cells,
                FieldLocation::Cell,
            ),
            location: FieldLocation::Cell,
            values,
        }
    }
}

impl Maps {
    /// The maps as a drawing of a width, mm.
    ///
    /// # Errors
    ///
    /// If no body has a finite value.
    pub fn draw(&self, width: f64) -> Result<Drawing, PictureError> {
        let bodies = || self.bodies.iter().map(|it| &it.body);
        let common = match bodies().all(|body| body.largest_displacement() == 0.0) {
            _ if self.are_modes => None,
            true => Some(0.0),
            false => Some(common_scale(bodies())),
        };
        let panel = |it: &MappedBody| {
            let factor = common.unwrap_or_else(|| it.body.scale_for_share(MODE_SHARE));
            let mut field = Field {
                name: self.quantity.clone(),
                unit: self.unit,
                location: it.location,
                values: it.values.clone(),
            };
            if self.are_modes {
                normalise_by_quantile(&mut field);
            }
            Panel {
                solid: None,
                title: vec![[it.title.clone(), it.title.clone()]],
                positions: it.body.deformed(factor),
                body: it.body.clone(),
                field: Some(field),
                broken: Vec::new(),
                interfaces: Vec::new(),
                rigid: None,
                lines: Vec::new(),
            }
        };
        let panels: Vec<Panel> = self.bodies.iter().map(panel).collect();
        let fields = panels.iter().filter_map(|panel| panel.field.as_ref());
        let range = (fields.filter_map(Field::range))
            .reduce(|a, b| [a[0].min(b[0]), a[1].max(b[1])])
            .ok_or_else(|| PictureError::NoValues(self.quantity.clone()))?;
        let requested = self.are_modes.then_some([range[0].signum().min(0.0), 1.0]);
        let map = ColourMap::default_for(&self.quantity);
        let scale = Scale::new(range, requested, None, map);
        let unit = if self.are_modes { "-" } else { self.unit };
        let strip = Strip {
            scale: Some(&scale),
            bar: Some(ColourBar::new(&scale, &self.quantity, unit, range)),
            legend: vec![LegendEntry {
                colour: None,
                words: format!("{}; {}", self.title, magnification_words(common)),
            }],
            window: None,
            columns: Some(self.columns),
            room: None,
            has_axes: false,
            panels: &panels,
        };
        Ok(strip.draw(width * PIXELS_PER_MM))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn lattice() -> MappedBody {
        let points = [[0.0, 0.0], [1.0, 0.0]];
        let moved = [[0.0, 0.0], [0.01, 0.0]];
        MappedBody::from_lattice("lattice", &points, 1.0, &moved, vec![0.0, 1.0])
    }

    #[test]
    fn bodies_of_both_kinds_stand_side_by_side() {
        let nodes = vec![[-0.5, -0.5], [1.5, -0.5], [1.5, 0.5], [-0.5, 0.5]];
        let cells = vec![Cell::Quad([0, 1, 2, 3])];
        let moved = vec![[0.0, 0.0], [0.01, 0.0], [0.01, 0.0], [0.0, 0.0]];
        let mesh = MappedBody::from_mesh("mesh", nodes, cells, moved, vec![0.0, 1.0, 1.0, 0.0]);
        let mut maps = Maps {
            name: "u".to_owned(),
            title: "A bar".to_owned(),
            quantity: "u_x".to_owned(),
            unit: "m",
            bodies: vec![mesh, lattice()],
            columns: 2,
            are_modes: false,
        };
        let svg = maps.draw(120.0).unwrap().to_svg("");
        for text in [">mesh<", ">lattice<", "A bar; deformation × 10"] {
            assert!(svg.contains(text), "{text}\n{svg}");
        }
        maps.are_modes = true;
        let svg = maps.draw(120.0).unwrap().to_svg("");
        assert!(svg.contains("largest displacement drawn as 0.1"), "{svg}");
    }

    #[test]
    fn bodies_that_did_not_move_are_undeformed() {
        let maps = Maps {
            name: "damage".to_owned(),
            title: "A bar".to_owned(),
            quantity: "damage".to_owned(),
            unit: "-",
            bodies: vec![MappedBody::from_lattice(
                "lattice",
                &[[0.0, 0.0], [1.0, 0.0]],
                1.0,
                &[[0.0; 2]; 2],
                vec![0.0, 1.0],
            )],
            columns: 1,
            are_modes: false,
        };
        let svg = maps.draw(90.0).unwrap().to_svg("");
        assert!(svg.contains("A bar; undeformed"));
    }

    #[test]
    fn maps_without_a_value_are_refused() {
        let mut body = lattice();
        body.values = vec![f64::NAN; 2];
        let maps = Maps {
            name: "u".to_owned(),
            title: String::new(),
            quantity: "u_x".to_owned(),
            unit: "m",
            bodies: vec![body],
            columns: 1,
            are_modes: false,
        };
        assert!(matches!(maps.draw(90.0), Err(PictureError::NoValues(name)) if name == "u_x"));
    }
}
