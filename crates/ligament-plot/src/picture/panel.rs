//! One body in a picture: its field as bands of colour, its outline, its broken bonds.

use ligament_output::FieldLocation;
use ligament_output::results::StoredRigidBodies;
use ligament_output::vtu::Cell;

use super::body::Body;
use super::colour_map::ColourMap;
use super::contour::{Surface, counter_clockwise, triangles_of_quadrangle};
use super::field::Field;
use super::levels::{Levels, Rule, has_both_signs};
use super::lines::Lines;
use super::merged_corners::MergedCorners;
use super::solid::{Scene, View};
use crate::drawing::frame::bounds;
use crate::drawing::{Drawing, Frame, OUTLINE, Paint, PathData, Rgb};

/// Colour of a body without a field, and of cells without a value.
const BARE: Rgb = [0xdc; 3];

/// Colour of a body without a field below lines.
const LIGHT: Rgb = [0xf4; 3];

/// Colour of rigid bodies.
const RIGID: Rgb = [0x8f, 0x98, 0xa3];

/// Width of outlines, pixels.
const OUTLINE_WIDTH: f64 = 0.5;

/// Width of broken bonds and of interfaces between materials, pixels.
const BOND_WIDTH: f64 = 0.4;
const INTERFACE_WIDTH: f64 = 0.9;

/// A body and everything drawn with it.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Panel {
    /// Long and short words of the title.
    pub(super) title: Vec<[String; 2]>,
    /// Body of the panel.
    pub(super) body: Body,
    /// Deformed positions of the corners of its cells.
    pub(super) positions: Vec<[f64; 2]>,
    /// Drawn field; None without one.
    pub(super) field: Option<Field>,
    /// Broken bonds by colour, between deformed ends.
    pub(super) broken: Vec<(Rgb, Vec<[[f64; 2]; 2]>)>,
    /// Sides of cells at interfaces between materials, between deformed ends.
    pub(super) interfaces: Vec<[[f64; 2]; 2]>,
    /// Lines over the body.
    pub(super) lines: Vec<Lines>,
    /// Rigid bodies beside the deformed body.
    pub(super) rigid: Option<StoredRigidBodies>,
    /// Scene of a solid, drawn instead of cells; None in the plane.
    pub(super) solid: Option<SolidView>,
}

/// A scene of a solid with the side from which it is seen.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct SolidView {
    /// Scene of the solid.
    pub(super) scene: Scene,
    /// The side from which the scene is seen.
    pub(super) view: View,
    /// Factor on the displacements.
    pub(super) factor: f64,
}

/// The colours of a field.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Scale {
    /// Levels between the bands.
    pub(super) levels: Levels,
    /// Colours of the bands.
    pub(super) colours: Vec<Rgb>,
}

impl Scale {
    /// Colours for values in `range`, by the requested levels, number of bands and map; settings that are not requested follow from
    /// the values.
    pub(super) fn new(
        range: [f64; 2],
        requested: Option<[f64; 2]>,
        bands: Option<usize>,
        map: Option<ColourMap>,
    ) -> Self {
        let map = map.unwrap_or(if has_both_signs(requested.unwrap_or(range)) {
            ColourMap::Diverging
        } else {
            ColourMap::Viridis
        });
        let centred = map == ColourMap::Diverging;
        let rule = Rule {
            bands,
            range: requested,
            centred,
        };
        let levels = Levels::new(range, rule);
        let colours = map.bands(levels.n_bands());
        Self { levels, colours }
    }
}

impl Panel {
    /// Draws the panel into a frame of a drawing.
    pub(super) fn draw(&self, drawing: &mut Drawing, frame: Frame, scale: Option<&Scale>) {
        let field = self.field.as_ref().zip(scale);
        if let Some(solid) = &self.solid {
            (solid.scene).draw(drawing, (frame, scale), solid.view, solid.factor);
            return;
        }
        match field {
            Some((field, scale)) if field.location == FieldLocation::Cell => {
                self.draw_cells(drawing, frame, Some((field, scale)));
            }
            None if !self.body.is_mesh() => self.draw_cells(drawing, frame, None),
            _ => self.draw_surface(drawing, frame, field),
        }
        let mut path = PathData::default();
        for corners in self.rigid.iter().flat_map(|it| &it.triangles) {
            frame.add(&mut path, &corners.map(|it| self.rigid_place(it)));
        }
        drawing.path(path, Paint::fill(RIGID));
        let mut draw = |segments: &[[[f64; 2]; 2]], colour: Rgb, width: f64| {
            let mut path = PathData::default();
            for ends in segments.iter().filter(|ends| frame.may_intersect(*ends)) {
                path.segment(ends.map(|end| frame.to_pixels(end)));
            }
            drawing.path(path, Paint::stroke(colour, width));
        };
        draw(&self.interfaces, OUTLINE, INTERFACE_WIDTH);
        for (colour, bonds) in &self.broken {
            draw(bonds, *colour, BOND_WIDTH);
        }
        for lines in &self.lines {
            lines.draw(drawing, |place| frame.to_pixels(place));
        }
    }

    /// Lower left and upper right corner of everything that is drawn, m.
    pub(super) fn bounds(&self) -> Option<[[f64; 2]; 2]> {
        let of_rigid = self.rigid.iter().flat_map(|it| 0..it.places.len() as u32);
        let of_rigid = of_rigid.map(|it| self.rigid_place(it));
        let places: Vec<[f64; 2]> = self.positions.iter().copied().chain(of_rigid).collect();
        bounds(&places)
    }

    /// Place of a corner of the rigid bodies, m.
    fn rigid_place(&self, corner: u32) -> [f64; 2] {
        let place = self.rigid.as_ref().map(|it| it.places[corner as usize]);
        let [x, y, _] = place.unwrap_or_default();
        [x, y]
    }

    /// Colour of cells without a value.
    fn colour_without_value(&self) -> Rgb {
        match self.field.is_none() && !self.lines.is_empty() {
            true => LIGHT,
            false => BARE,
        }
    }

    /// Draws contours of values at the points, each region over the one of the next lower level.
    fn draw_surface(&self, drawing: &mut Drawing, frame: Frame, field: Option<(&Field, &Scale)>) {
        let triangles = || self.body.cells.iter().flat_map(triangles_of_cell);
        let reference = &self.body.reference;
        let whole = Surface::new(triangles(), reference, |_| true);
        let outline = path_of(whole.outlines(&self.positions), frame);
        drawing.path(outline.clone(), Paint::fill(self.colour_without_value()));
        if let Some((field, Scale { levels, colours })) = field {
            let values = &field.values;
            let surface = Surface::new(triangles(), reference, |node| {
                values[node as usize].is_finite()
            });
            let lowest = surface.outlines(&self.positions);
            drawing.path(path_of(lowest, frame), Paint::fill(colours[0]));
            for (level, colour) in levels.bounds.iter().zip(colours).skip(1) {
                let region = surface.region(&self.positions, values, *level);
                drawing.path(path_of(region, frame), Paint::fill(*colour));
            }
        }
        drawing.path(outline, Paint::stroke(OUTLINE, OUTLINE_WIDTH));
    }

    /// Draws cells with a colour each, band by band: a band and all bands above it are painted over the band below.
    fn draw_cells(&self, drawing: &mut Drawing, frame: Frame, field: Option<(&Field, &Scale)>) {
        let (body, cells) = (&self.body, &self.body.cells);
        let joined = MergedCorners::new(cells, &body.reference, &self.positions);
        let band_of = |cell: usize| {
            let (field, scale) = field?;
            let value = field.values[cell];
            value.is_finite().then(|| scale.levels.band(value))
        };
        // Cells without a value lie below all bands.
        let bands: Vec<Option<usize>> = (0..cells.len()).map(band_of).collect();
        let mut draw = |from: Option<usize>, paint: Paint| {
            let chosen = cells.iter().zip(&bands).filter(|(_, band)| **band >= from);
            let triangles = chosen.flat_map(|(cell, _)| triangles_of_cell(cell));
            // Corners of one cell differ, so that orientations are seen without load.
            let named = triangles.map(|corners| counter_clockwise(corners, &body.reference));
            let named = named.map(|it| it.map(|corner| joined.place_of[corner as usize]));
            let surface = Surface::from_counter_clockwise(named.collect());
            drawing.path(path_of(surface.outlines(&joined.places), frame), paint);
        };
        let rim = Some((OUTLINE, OUTLINE_WIDTH)).filter(|_| !self.lines.is_empty());
        let stroke = rim.filter(|_| field.is_none());
        let bare = Paint::fill(self.colour_without_value());
        draw(None, Paint { stroke, ..bare });
        let colours = field.iter().flat_map(|(_, scale)| &scale.colours);
        for (band, colour) in colours.enumerate() {
            draw(Some(band), Paint::fill(*colour));
        }
    }
}

/// The triangles of a cell.
fn triangles_of_cell(cell: &Cell) -> Vec<[u32; 3]> {
    match *cell {
        Cell::Triangle(corners) => vec![corners],
        Cell::Quad(corners) => triangles_of_quadrangle(corners).to_vec(),
        Cell::Vertex(_) | Cell::Line(_) | Cell::Solid(_) => Vec::new(),
    }
}

fn path_of(outlines: Vec<Vec<[f64; 2]>>, frame: Frame) -> PathData {
    let mut path = PathData::default();
    for outline in &outlines {
        frame.add(&mut path, outline);
    }
    path
}
