//! The scene of an output of a solid.

use std::collections::{BTreeMap, HashMap};

use ligament_mesh::SolidCell;
use ligament_model::{Canvas, box_corners};
use ligament_output::FieldLocation;
use ligament_output::remedy::Remedy;
use ligament_output::results::StoredState;
use ligament_output::results::fields::{DISPLACEMENT, OPENING, ResultField, SLIDING};
use ligament_output::results::solid_body::SolidBody;
use ligament_output::results::solid_cracks::SolidCracks;
use ligament_output::vtu::read::VtuFile;
use ligament_post::surfaces::{Links, Tetrahedra, level_set, opened_cells};

use super::outline::{outer_faces, rim, sharp_edges};
use super::{Scene, Section};
use crate::picture::PictureError;
use crate::picture::field::{Field, NONE};
use crate::picture::request::{CrackDrawing, SolidRequest};

/// Fields on a crack surface only, in the order of the components of a jump.
const CRACK_FIELDS: [&ResultField; 2] = [&OPENING, &SLIDING];

/// Number of boxes up to which all faces are drawn where there is a crack.
const MOST_WHOLE: usize = 100_000;

/// A solid with displacements and a field of its points.
struct Solid<'a> {
    body: SolidBody,
    displacement: Vec<[f64; 3]>,
    field: Option<Field>,
    cracks: Option<(&'a SolidCracks, StoredState)>,
}

/// The scene of an output, and the field that is drawn; `cracks` with the state in which they are drawn.
pub(in crate::picture) fn read(
    file: &VtuFile,
    field: &str,
    (request, crack): (&SolidRequest, Option<CrackDrawing>),
    cracks: Option<(&SolidCracks, StoredState)>,
) -> Result<(Scene, Option<Field>), PictureError> {
    let body = SolidBody::read(file)?;
    let is_drawn = field != NONE
        && !(crack == Some(CrackDrawing::Lines) && CRACK_FIELDS.iter().any(|it| it.name == field));
    let read = is_drawn.then(|| Field::read(file, field)).transpose()?;
    let solid = Solid {
        displacement: body.vectors(file, DISPLACEMENT.name)?,
        field: read.filter(|it| it.values.len() == body.grid.positions.len()),
        body,
        cracks,
    };
    let scene = match (request.section, request.level, crack, cracks) {
        (Some(section), ..) => solid.section(section, request.view.is_some()),
        (_, Some(level), ..) => solid.level(level)?,
        (_, _, Some(CrackDrawing::Lines), Some((cracks, state))) => {
            return Ok(solid.crack(field, cracks, state));
        }
        _ => solid.outline(),
    };
    Ok((scene, solid.field))
}

impl Solid<'_> {
    fn value(&self, point: u32) -> Option<f64> {
        self.field
            .as_ref()
            .map(|field| field.values[point as usize])
    }

    /// Adds a place with the mean displacement and value of some points; returns its number.
    fn push(&self, scene: &mut Scene, place: [f64; 3], points: &[u32]) -> u32 {
        let count = points.len() as f64;
        let moved = [0, 1, 2].map(|axis| {
            let all = points
                .iter()
                .map(|it| self.displacement[*it as usize][axis]);
            all.sum::<f64>() / count
        });
        let value = self.field.as_ref().map(|field| {
            let all = points.iter().map(|it| field.values[*it as usize]);
            all.sum::<f64>() / count
        });
        scene.push(place, moved, value)
    }

    /// The outside of the body, opened along its cracks where these are drawn.
    fn outline(&self) -> Scene {
        let grid = &self.body.grid;
        let links = self
            .cracks
            .map(|(cracks, state)| (cracks, cracks.links(state)));
        match &grid.canvas {
            Canvas::Boxes(boxes) => self.boxes(boxes, links.as_ref().map(|it| &it.1)),
            Canvas::Solid(cells) => match links {
                Some((cracks, links)) => {
                    let opened =
                        opened_cells((&grid.positions, cells), cracks.tetrahedra(), &links);
                    let corners = opened.positions.iter().copied().zip(&opened.follows);
                    self.cells(&opened.cells, corners.map(|(at, of)| (at, of.clone())))
                }
                None => {
                    let points = grid.positions.iter().copied().zip(0..);
                    self.cells(cells, points.map(|(at, point)| (at, vec![point])))
                }
            },
            Canvas::Between(_) | Canvas::Around(_) => Scene::default(),
        }
    }

    /// The outer faces of cells whose corners follow points.
    fn cells(
        &self,
        cells: &[SolidCell],
        corners: impl Iterator<Item = ([f64; 3], Vec<u32>)>,
    ) -> Scene {
        let corners: Vec<([f64; 3], Vec<u32>)> = corners.collect();
        let mut scene = Scene::default();
        let mut named: BTreeMap<u32, u32> = BTreeMap::new();
        for face in outer_faces(cells) {
            for triangle in face.triangles() {
                let places = triangle.map(|corner| {
                    *named.entry(corner).or_insert_with(|| {
                        let (place, points) = &corners[corner as usize];
                        self.push(&mut scene, *place, points)
                    })
                });
                scene.triangles.push(places);
            }
        }
        scene.edges = sharp_edges(&scene.places, &scene.triangles);
        scene
    }

    /// Faces of boxes without a neighbour, and faces between points that a crack separates.
    fn boxes(&self, boxes: &[[[f64; 3]; 2]], links: Option<&Links>) -> Scene {
        let mut scene = Scene::default();
        let Some([low, high]) = boxes.first() else {
            return scene;
        };
        // Middles of faces, and corners, lie at halves of sides.
        let side = [0, 1, 2].map(|axis| high[axis] - low[axis]);
        let key = |place: [f64; 3]| {
            [0, 1, 2].map(|axis| (2.0 * (place[axis] - low[axis]) / side[axis]).round() as i64)
        };
        let faces_of = |number: usize| {
            let corners = box_corners(boxes[number]);
            let whole = SolidCell::Hexahedron([0, 1, 2, 3, 4, 5, 6, 7]);
            whole.faces().map(move |face| {
                let at = face.corners().iter().map(|it| corners[*it as usize]);
                let sum = at.fold([0.0; 3], |sum, it| {
                    [0, 1, 2].map(|axis| sum[axis] + it[axis])
                });
                (key(sum.map(|it| 0.25 * it)), face, corners)
            })
        };
        let mut sharing: HashMap<[i64; 3], Vec<u32>> = HashMap::new();
        for number in 0..boxes.len() {
            for (middle, ..) in faces_of(number) {
                sharing.entry(middle).or_default().push(number as u32);
            }
        }
        // Boxes behind a crack can be seen through the gaps that it opens.
        let shows_all = links.is_some() && boxes.len() <= MOST_WHOLE;
        let mut named: HashMap<[i64; 3], u32> = HashMap::new();
        let mut outside = Vec::new();
        for number in 0..boxes.len() {
            for (middle, face, corners) in faces_of(number) {
                let is_open = match *sharing[&middle].as_slice() {
                    [_, _] if shows_all => true,
                    [one, other] => links.is_some_and(|it| it.between([one, other]).is_cut()),
                    _ => true,
                };
                if !is_open {
                    continue;
                }
                let mut places = BTreeMap::new();
                for corner in face.corners() {
                    let at = corners[*corner as usize];
                    let place = self.push(&mut scene, at, &[number as u32]);
                    let shared = *named.entry(key(at)).or_insert(place);
                    places.insert(*corner, (place, shared));
                }
                for triangle in face.triangles() {
                    scene.triangles.push(triangle.map(|it| places[&it].0));
                    if sharing[&middle].len() == 1 {
                        outside.push(triangle.map(|it| places[&it].1));
                    }
                }
            }
        }
        scene.edges = sharp_edges(&scene.places, &outside);
        scene
    }

    /// The section by a plane, and the edges of the body around it if they are wanted.
    fn section(&self, section: Section, with_edges: bool) -> Scene {
        let tetrahedra = Tetrahedra::new(&self.body.grid);
        let nodes = tetrahedra.nodes.iter();
        let distances: Vec<f64> = nodes.map(|it| section.distance(*it)).collect();
        let mut scene = self.level_surface(&tetrahedra, &distances, 0.0);
        scene.edges = rim(&scene.triangles);
        if with_edges {
            self.add_edges(&mut scene);
        }
        scene
    }

    /// The level surface of the field, within the edges of the body.
    fn level(&self, level: f64) -> Result<Scene, PictureError> {
        let tetrahedra = Tetrahedra::new(&self.body.grid);
        let points = tetrahedra.points.iter();
        let values: Option<Vec<f64>> = points.map(|it| self.value(*it)).collect();
        let values = values.ok_or(PictureError::NoLevel(Remedy::Give {
            option: "field",
            value: "NAME",
        }))?;
        let mut scene = self.level_surface(&tetrahedra, &values, level);
        self.add_edges(&mut scene);
        Ok(scene)
    }

    /// The level surface of values of the nodes of tetrahedra, with the field.
    fn level_surface(&self, tetrahedra: &Tetrahedra, values: &[f64], level: f64) -> Scene {
        let found = level_set(&tetrahedra.corners, values, level);
        let mut scene = Scene::default();
        for (ends, share) in &found.places {
            let between = |of: [f64; 2]| of[0] + share * (of[1] - of[0]);
            let nodes = ends.map(|it| tetrahedra.nodes[it as usize]);
            let points = ends.map(|it| tetrahedra.points[it as usize]);
            let moved = points.map(|it| self.displacement[it as usize]);
            let at = |of: [[f64; 3]; 2]| [0, 1, 2].map(|axis| between([of[0][axis], of[1][axis]]));
            let [one, other] = points.map(|it| self.value(it));
            let value = one.zip(other);
            scene.push(at(nodes), at(moved), value.map(|(a, b)| between([a, b])));
        }
        scene.triangles = found.triangles;
        scene
    }

    /// The surface of the crack, and the edges of the body around it.
    fn crack(
        &self,
        field: &str,
        cracks: &SolidCracks,
        state: StoredState,
    ) -> (Scene, Option<Field>) {
        let surface = cracks.surface(state);
        let mut scene = Scene::default();
        for (place, pairs) in surface.places.iter().zip(&surface.parted) {
            self.push(&mut scene, *place, pairs.as_flattened());
        }
        let own = CRACK_FIELDS.iter().position(|it| it.name == field);
        let drawn = own.map(|which| {
            let jumps = cracks.jumps(&surface, &self.displacement);
            scene.values = jumps.iter().map(|it| it[which]).collect();
            Field {
                name: field.to_owned(),
                unit: CRACK_FIELDS[which].unit,
                location: FieldLocation::Point,
                values: scene.values.clone(),
            }
        });
        scene.triangles = surface.triangles;
        self.add_edges(&mut scene);
        (scene, drawn.or_else(|| self.field.clone()))
    }

    /// Adds the edges of the body, which are drawn also where they are hidden.
    fn add_edges(&self, scene: &mut Scene) {
        let whole = Solid {
            body: self.body.clone(),
            displacement: self.displacement.clone(),
            field: None,
            cracks: None,
        };
        let outline = whole.outline();
        let has_values = !scene.values.is_empty();
        for ends in outline.edges {
            let ends = ends.map(|end| {
                let (place, moved) = (outline.places[end as usize], outline.moved[end as usize]);
                scene.push(place, moved, has_values.then_some(f64::NAN))
            });
            scene.edges.push(ends);
        }
        scene.shows_all_edges = true;
    }
}
