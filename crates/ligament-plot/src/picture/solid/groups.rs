//! Picture of a mesh with the names of its groups.

use std::path::PathBuf;

use ligament_mesh::{AnyMesh, Group, Mesh, SolidMesh};

use super::outline::{outer_faces, rim, sharp_edges};
use super::visible::DepthBuffer;
use super::{Scene, Upward, View};
use crate::drawing::frame::bounds;
use crate::drawing::{Anchor, Drawing, Frame, OUTLINE, Paint, WHITE, text_width};
use crate::picture::{PictureError, Target};

/// Size of the longer side of the body in each view, and room around it, pixels.
const SIZE: f64 = 330.0;
const MARGIN: f64 = 32.0;

/// Size of the names, pixels.
const LETTERS: f64 = 8.0;

/// Views of a solid from two opposite sides, which together show all of its outside but for cavities.
const SIDES: [View; 2] = [
    View::OBLIQUE,
    View {
        azimuth: View::OBLIQUE.azimuth + 180.0,
        elevation: -View::OBLIQUE.elevation,
        up: Upward::Z,
    },
];

/// View of a body in the plane.
const FRONT: View = View {
    azimuth: -90.0,
    elevation: 90.0,
    up: Upward::Z,
};

/// A name with its possible places, m.
type Label = (String, Vec<[f64; 3]>);

/// Draws a mesh with a name at each of its groups that can be seen: surfaces and several parts of a solid, curves and several parts of a body in
/// the plane.
///
/// # Errors
///
/// If the picture cannot be written.
pub fn draw_groups(
    mesh: &AnyMesh,
    target: &Target,
    name: impl Fn(&Group) -> String,
) -> Result<PathBuf, PictureError> {
    let path = target.file(|| PathBuf::from("groups"))?;
    target.write(path, &drawing(mesh, name), "groups")
}

fn drawing(mesh: &AnyMesh, name: impl Fn(&Group) -> String) -> Drawing {
    let ((scene, places), views) = match mesh {
        AnyMesh::Plane(mesh) => (plane_scene(mesh), &[FRONT][..]),
        AnyMesh::Solid(mesh) => (solid_scene(mesh), &SIDES[..]),
    };
    let labels = mesh.groups().iter().map(&name).zip(places);
    let labels: Vec<Label> = labels.collect();
    let seen = views
        .iter()
        .map(|view| scene.projected_places(*view)[0].clone());
    let windows: Vec<[[f64; 2]; 2]> = seen.filter_map(|it| bounds(&it)).collect();
    let sides = |axis: usize| {
        let lengths = windows
            .iter()
            .map(move |[low, high]| high[axis] - low[axis]);
        lengths.fold(0.0, f64::max)
    };
    let extent = [sides(0), sides(1)];
    let scale = SIZE / extent[0].max(extent[1]).max(f64::MIN_POSITIVE);
    let [width, height] = extent.map(|it| scale * it + 2.0 * MARGIN);
    let mut drawing = Drawing::new([width * windows.len() as f64, height]);
    for (place, (view, window)) in views.iter().zip(windows).enumerate() {
        let at = [place as f64 * width + MARGIN, MARGIN];
        let size = [0, 1].map(|axis| scale * (window[1][axis] - window[0][axis]));
        let frame = Frame::new(window, [at, size]);
        scene.draw(&mut drawing, (frame, None), *view, 0.0);
        scene.draw_names(&mut drawing, frame, *view, &labels);
    }
    drawing
}

impl Scene {
    /// Draws each name at the visible one of its places that is nearest to the middle of them.
    fn draw_names(&self, drawing: &mut Drawing, frame: Frame, view: View, labels: &[Label]) {
        let seen = self.deformed(view, 0.0);
        let window = [frame.low, frame.high];
        let buffer = DepthBuffer::new(&seen, &self.triangles, window, frame.scale[0]);
        for (name, places) in labels {
            let seen = places.iter().map(|it| view.projected_places(*it));
            let visible: Vec<[f64; 3]> = seen.filter(|it| buffer.is_visible(*it)).collect();
            let middle = [0, 1].map(|axis| mean(visible.iter().map(|it| it[axis])));
            let distance = |it: &[f64; 3]| (it[0] - middle[0]).hypot(it[1] - middle[1]);
            let nearest = (visible.iter()).min_by(|a, b| distance(a).total_cmp(&distance(b)));
            let Some([x, y, _]) = nearest else {
                continue;
            };
            let [x, y] = frame.to_pixels([*x, *y]);
            let width = text_width(name, LETTERS) + 4.0;
            let paint = Paint {
                fill: Some(WHITE),
                ..Paint::stroke(OUTLINE, 0.4)
            };
            let corner = [x - 0.5 * width, y - 0.6 * LETTERS];
            drawing.rectangle(corner, [width, 1.2 * LETTERS], paint);
            drawing.text([x, y + 0.36 * LETTERS], Anchor::Middle, LETTERS, name);
        }
    }
}

fn mean(values: impl ExactSizeIterator<Item = f64>) -> f64 {
    let count = values.len() as f64;
    values.sum::<f64>() / count
}

/// The outside of a solid with the edges of its surface groups, and the places of its groups.
fn solid_scene(mesh: &SolidMesh) -> (Scene, Vec<Vec<[f64; 3]>>) {
    let outside = outer_faces(&mesh.cells);
    let triangles = outside.iter().flat_map(|face| face.triangles()).collect();
    let mut scene = unloaded(mesh.positions.clone(), triangles);
    scene.edges = sharp_edges(&scene.places, &scene.triangles);
    let n_parts = mesh.groups.iter().filter(|it| it.dimension == 3).count();
    let mut places = Vec::new();
    for group in &mesh.groups {
        let of_group: Vec<[u32; 3]> = match group.dimension {
            2 => group
                .faces
                .iter()
                .flat_map(|face| face.triangles())
                .collect(),
            3 if n_parts > 1 => {
                let is_in = |corner: &u32| group.nodes.binary_search(corner).is_ok();
                let all = scene.triangles.iter().filter(|it| it.iter().all(is_in));
                all.copied().collect()
            }
            _ => Vec::new(),
        };
        if group.dimension == 2 {
            scene.edges.extend(rim(&of_group));
        }
        places.push(
            of_group
                .iter()
                .map(|it| middle(&mesh.positions, it))
                .collect(),
        );
    }
    (scene, places)
}

/// The cells of a body in the plane with the edges of its groups, and the places of its groups.
fn plane_scene(mesh: &Mesh) -> (Scene, Vec<Vec<[f64; 3]>>) {
    let positions: Vec<[f64; 3]> = mesh.positions.iter().map(|[x, y]| [*x, *y, 0.0]).collect();
    let triangles = mesh
        .cells
        .iter()
        .flat_map(|cell| cell.triangles())
        .collect();
    let mut scene = unloaded(positions, triangles);
    scene.edges = mesh.outline();
    let n_parts = mesh.groups.iter().filter(|it| it.dimension == 2).count();
    let mut places = Vec::new();
    for group in &mesh.groups {
        scene.edges.extend(&group.edges);
        let cells = group.cells.iter().filter(|_| n_parts > 1);
        let corners = cells.map(|cell| mesh.cells[*cell as usize].corners());
        let corners = corners.chain(group.edges.iter().map(|it| it.as_slice()));
        places.push(corners.map(|it| middle(&scene.places, it)).collect());
    }
    (scene, places)
}

fn unloaded(places: Vec<[f64; 3]>, triangles: Vec<[u32; 3]>) -> Scene {
    Scene {
        moved: vec![[0.0; 3]; places.len()],
        places,
        triangles,
        ..Scene::default()
    }
}

fn middle(positions: &[[f64; 3]], corners: &[u32]) -> [f64; 3] {
    [0, 1, 2].map(|axis| mean(corners.iter().map(|it| positions[*it as usize][axis])))
}
