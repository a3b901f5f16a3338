//! Summary of a mesh of solid cells.

use std::io::{self, Write};

use ligament_case::mesh_file::bounding_box;
use ligament_mesh::{Cell, Faces, Group, SolidCell, SolidMesh};
use ligament_output::quantity::{between, place, quantity};

use super::words::{
    Elements, NAMES, box_in_words, description, edge_length, edges_in_words, points_or_edges,
    write_fields, write_groups, write_remarks, write_size_note,
};
use crate::lines::entry;

/// Radius ratio below which a tetrahedron is a sliver.
const SLIVER: f64 = 0.1;

/// Writes the summary of a mesh of solid cells.
pub(super) fn write(out: &mut dyn Write, mesh: &SolidMesh) -> io::Result<()> {
    let faces = Faces::new(&mesh.cells, mesh.positions.len());
    let outline: f64 = (faces.outer().iter())
        .map(|side| area(&side.face, &mesh.positions))
        .sum();
    let corners = bounding_box(&mesh.positions);
    let edges = mesh.edges();
    let lengths = edges.iter().map(|&it| edge_length(&mesh.positions, it));
    let mut line = |name: &str, value: String| entry(out, NAMES, name, value);
    line("nodes", mesh.positions.len().to_string())?;
    line("cells", cells_in_words(&mesh.cells))?;
    line("volume", quantity(mesh.volume(), "m^3"))?;
    line("outline", quantity(outline, "m^2"))?;
    line("bounding box", box_in_words(corners))?;
    line("edges", edges_in_words(lengths))?;
    line("spacing", spacing_in_words(mesh, &edges))?;
    let quality = Quality::from_mesh(mesh);
    if let Some(quality) = &quality {
        line("quality", quality.in_words())?;
    }
    write_groups(out, &mesh.groups, |group| {
        let [kind, size, centre] = description(elements(group, mesh), &mesh.positions);
        [kind, size, centre + inside(group, &faces)]
    })?;
    write_fields(out, &mesh.fields)?;
    write_remarks(out, &mesh.remarks)?;
    if let Some(note) = quality.and_then(|it| it.note()) {
        writeln!(out, "  note: {note}")?;
    }
    if let Some(note) = volumes_note(mesh) {
        writeln!(out, "  note: {note}")?;
    }
    write_size_note(out, corners)
}

/// Text of the numbers of cells, in total and of each shape.
fn cells_in_words(cells: &[SolidCell]) -> String {
    let shapes = [
        ("tetrahedron", "tetrahedra"),
        ("hexahedron", "hexahedra"),
        ("prism", "prisms"),
        ("pyramid", "pyramids"),
    ];
    let of_shape = shapes.iter().filter_map(|(one, several)| {
        let count = cells.iter().filter(|it| it.shape_name() == *one).count();
        (count > 0).then(|| format!("{count} {}", if count == 1 { one } else { several }))
    });
    let of_shape: Vec<String> = of_shape.collect();
    format!("{} ({})", cells.len(), of_shape.join(", "))
}

/// Text of the shortest edges at the nodes, which are the distances to nearest nodes unless a nearer node has no edge to them.
fn spacing_in_words(mesh: &SolidMesh, edges: &[[u32; 2]]) -> String {
    let mut shortest = vec![f64::INFINITY; mesh.positions.len()];
    for &edge in edges {
        let length = edge_length(&mesh.positions, edge);
        for node in edge {
            let at_node = &mut shortest[node as usize];
            *at_node = at_node.min(length);
        }
    }
    let low = shortest.iter().copied().fold(f64::INFINITY, f64::min);
    let high = shortest.iter().copied().fold(0.0, f64::max);
    let mean = shortest.iter().sum::<f64>() / shortest.len() as f64;
    format!(
        "{} from a node to the next, mean {}",
        between([low, high], "m"),
        quantity(mean, "m")
    )
}

/// Radius ratios of the tetrahedra.
struct Quality {
    tetrahedra: usize,
    mean: f64,
    /// Smallest ratio, and the centre of its cell, m.
    worst: (f64, [f64; 3]),
    slivers: usize,
}

impl Quality {
    /// The quality of the tetrahedra of a mesh; `None` without tetrahedra.
    fn from_mesh(mesh: &SolidMesh) -> Option<Self> {
        let ratio = |cell: &SolidCell| Some((cell.radius_ratio(&mesh.positions)?, *cell));
        let ratios: Vec<(f64, SolidCell)> = mesh.cells.iter().filter_map(ratio).collect();
        let (worst, cell) = ratios.iter().min_by(|a, b| a.0.total_cmp(&b.0))?;
        let corners = cell.corners();
        let mean_of_corners = |axis: usize| {
            let along = corners.iter().map(|&it| mesh.positions[it as usize][axis]);
            along.sum::<f64>() / corners.len() as f64
        };
        Some(Self {
            tetrahedra: ratios.len(),
            mean: ratios.iter().map(|(ratio, _)| ratio).sum::<f64>() / ratios.len() as f64,
            worst: (*worst, [0, 1, 2].map(mean_of_corners)),
            slivers: ratios.iter().filter(|(ratio, _)| *ratio < SLIVER).count(),
        })
    }

    fn in_words(&self) -> String {
        let (worst, mean) = (quality_text(self.worst.0), quality_text(self.mean));
        format!("radius ratio of the tetrahedra {worst} at worst, {mean} in the mean; 1 is regular")
    }

    fn note(&self) -> Option<String> {
        let (count, all, (worst, at)) = (self.slivers, self.tetrahedra, self.worst);
        let worst = quality_text(worst);
        (count > 0).then(|| {
            format!(
                "{count} of {all} tetrahedra are slivers (radius ratio below {SLIVER}; the worst, {worst}, at {}): volumes and bonds are \
                 right all the same, but points may lie much nearer to each other there; `gmsh -3 -optimize_netgen` repairs most of them",
                place(&at)
            )
        })
    }
}

/// Text of a radius ratio.
fn quality_text(ratio: f64) -> String {
    if ratio < 0.01 {
        format!("{ratio:.1e}")
    } else {
        format!("{ratio:.2}")
    }
}

/// Note about volume groups that do not contain all cells.
fn volumes_note(mesh: &SolidMesh) -> Option<String> {
    let volumes: Vec<&Group> = mesh.groups.iter().filter(|it| it.dimension == 3).collect();
    if volumes.is_empty() {
        return Some(
            "there is no volume group, and none is necessary: a [material] without `group` fills the body; for several materials name each \
             `Physical Volume`"
                .to_owned(),
        );
    }
    let mut is_in_one = vec![false; mesh.cells.len()];
    for &cell in volumes.iter().flat_map(|it| &it.cells) {
        is_in_one[cell as usize] = true;
    }
    let outside = is_in_one.iter().filter(|it| !**it).count();
    (outside > 0).then(|| {
        format!(
            "{outside} cells are in no volume group, so they have no material if each group has its own"
        )
    })
}

fn elements<'a>(group: &'a Group, mesh: &'a SolidMesh) -> Elements<'a> {
    let positions = &mesh.positions;
    match group.dimension {
        2 => {
            let sides = group.faces.iter();
            let sides = sides.map(|it| (it.corners(), area(it, positions)));
            ("surface", Some("m^2"), sides.collect())
        }
        3 => {
            let cells = group.cells.iter().map(|&cell| &mesh.cells[cell as usize]);
            let cells = cells.map(|it| (it.corners(), it.volume(positions)));
            ("volume", Some("m^3"), cells.collect())
        }
        _ => points_or_edges(group, positions),
    }
}

/// Where a surface is, if it is not outside of the body.
fn inside(group: &Group, faces: &Faces<'_>) -> &'static str {
    let is_inside = |face: &&Cell| faces.sides_at(face).len() > 1;
    match group.faces.iter().filter(is_inside).count() {
        0 => "",
        inside if inside == group.faces.len() => ", inside of the body",
        _ => ", partly inside of the body",
    }
}

fn area(face: &Cell, positions: &[[f64; 3]]) -> f64 {
    let [x, y, z] = face.area_vector(positions);
    (x * x + y * y + z * z).sqrt()
}
