//! One body in a picture: its field as bands of colour, its outline, its broken bonds.

use ligament_output::FieldLocation;
use ligament_output::vtu::Cell;

use super::body::{Body, bounds};
use super::contour::{Surface, halves};
use super::field::Field;
use super::levels::Levels;
use super::svg::{Document, Paint, PathData};

/// Colour of a body without a field, and of what has no value.
const BARE: &str = "#dcdcdc";

/// Colour of outlines.
const OUTLINE: &str = "#404040";

/// Widths of lines in pixels: outlines, ...
const OUTLINE_WIDTH: f64 = 0.5;

/// ... broken bonds, ...
const BOND_WIDTH: f64 = 0.5;

/// ... and around the cells of a lattice, in their own colour: without them cells that touch would show a hairline.
const SEAM_WIDTH: f64 = 0.3;

/// A body with what is drawn of it.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Panel {
    /// Words of its title, long and short.
    pub(super) title: Vec<[String; 2]>,
    /// The body.
    pub(super) body: Body,
    /// Deformed positions of the corners of its cells.
    pub(super) positions: Vec<[f64; 2]>,
    /// The field, if one is drawn.
    pub(super) field: Option<Field>,
    /// Broken bonds by colour, between deformed ends.
    pub(super) broken: Vec<(&'static str, Vec<[[f64; 2]; 2]>)>,
}

/// The colours of a field.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Scale {
    /// Levels between the bands.
    pub(super) levels: Levels,
    /// Colours of the bands.
    pub(super) colours: Vec<String>,
}

/// Where a part of the plane lies in a document, at one scale along both axes and y upwards.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Frame {
    /// Lower left corner of the part, m.
    pub(super) low: [f64; 2],
    /// Upper right corner, m.
    pub(super) high: [f64; 2],
    /// Its upper left corner in the document, pixels.
    pub(super) at: [f64; 2],
    /// Pixels to the metre.
    pub(super) scale: f64,
}

impl Frame {
    fn to_pixels(self, [x, y]: [f64; 2]) -> [f64; 2] {
        [
            self.at[0] + (x - self.low[0]) * self.scale,
            self.at[1] + (self.high[1] - y) * self.scale,
        ]
    }

    /// Width and height, pixels.
    pub(super) fn size(&self) -> [f64; 2] {
        [0, 1].map(|axis| (self.high[axis] - self.low[axis]) * self.scale)
    }

    /// Whether a polygon may reach into the frame.
    fn meets(&self, points: &[[f64; 2]]) -> bool {
        bounds(points).is_some_and(|[low, high]| {
            (0..2).all(|axis| low[axis] <= self.high[axis] && high[axis] >= self.low[axis])
        })
    }

    fn add(&self, path: &mut PathData, outline: &[[f64; 2]]) {
        if self.meets(outline) && outline.iter().flatten().all(|it| it.is_finite()) {
            path.outline(outline.iter().map(|&point| self.to_pixels(point)));
        }
    }
}

impl Panel {
    /// Draws it into a frame of a document.
    pub(super) fn draw(&self, document: &mut Document, frame: Frame, scale: Option<&Scale>) {
        let field = self.field.as_ref().zip(scale);
        match field {
            Some((field, scale)) if field.location == FieldLocation::Cell => {
                self.draw_cells(document, frame, Some((field, scale)));
            }
            None if self.stands_apart() => self.draw_cells(document, frame, None),
            _ => self.draw_surface(document, frame, field),
        }
        for (colour, bonds) in &self.broken {
            let mut path = PathData::default();
            for ends in bonds.iter().filter(|ends| frame.meets(*ends)) {
                path.segment(ends.map(|end| frame.to_pixels(end)));
            }
            let stroke = Some((*colour, BOND_WIDTH));
            document.path(&path, Paint { fill: None, stroke });
        }
    }

    /// Whether the cells share no corners, as those of a lattice.
    fn stands_apart(&self) -> bool {
        let n_corners: usize = self.body.cells.iter().map(|it| it.points().len()).sum();
        n_corners == self.positions.len()
    }

    /// Contours of values at the points, each region over the one of the level below.
    fn draw_surface(&self, document: &mut Document, frame: Frame, field: Option<(&Field, &Scale)>) {
        let triangles = || {
            let halves = |cell: &Cell| match *cell {
                Cell::Triangle(corners) => vec![corners],
                Cell::Quad(corners) => halves(corners).to_vec(),
                Cell::Vertex(_) | Cell::Line(_) => Vec::new(),
            };
            self.body.cells.iter().flat_map(halves)
        };
        let reference = &self.body.reference;
        let whole = Surface::new(triangles(), reference, |_| true);
        let path_of = |outlines: Vec<Vec<[f64; 2]>>| {
            let mut path = PathData::default();
            for outline in &outlines {
                frame.add(&mut path, outline);
            }
            path
        };
        let outline = path_of(whole.outlines(&self.positions));
        document.path(&outline, fill(BARE));
        if let Some((field, Scale { levels, colours })) = field {
            let values = &field.values;
            let surface = Surface::new(triangles(), reference, |node| {
                values[node as usize].is_finite()
            });
            let lowest = surface.outlines(&self.positions);
            document.path(&path_of(lowest), fill(&colours[0]));
            for (level, colour) in levels.bounds.iter().zip(colours).skip(1) {
                let region = surface.region(&self.positions, values, *level);
                document.path(&path_of(region), fill(colour));
            }
        }
        let stroke = Some((OUTLINE, OUTLINE_WIDTH));
        document.path(&outline, Paint { fill: None, stroke });
    }

    /// Cells with a colour each, those of a colour together.
    fn draw_cells(&self, document: &mut Document, frame: Frame, field: Option<(&Field, &Scale)>) {
        let n_bands = field.map_or(0, |(_, scale)| scale.colours.len());
        // The last one is for cells without a value.
        let mut paths = vec![PathData::default(); n_bands + 1];
        for (place, cell) in self.body.cells.iter().enumerate() {
            let corners: Vec<[f64; 2]> = cell
                .points()
                .iter()
                .map(|&it| self.positions[it as usize])
                .collect();
            let value = field.map_or(f64::NAN, |(field, _)| field.values[place]);
            let band = match field {
                Some((_, scale)) if value.is_finite() => scale.levels.band(value),
                _ => n_bands,
            };
            frame.add(&mut paths[band], &corners);
        }
        let colours = field.into_iter().flat_map(|(_, scale)| &scale.colours);
        let colours = colours.map(String::as_str).chain([BARE]);
        for (path, colour) in paths.iter().zip(colours) {
            let paint = Paint {
                fill: Some(colour),
                stroke: Some((colour, SEAM_WIDTH)),
            };
            document.path(path, paint);
        }
    }
}

fn fill(colour: &str) -> Paint<'_> {
    Paint {
        fill: Some(colour),
        stroke: None,
    }
}
