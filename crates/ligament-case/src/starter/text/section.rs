//! The section of the body, and an example of an initial crack as a comment.

use std::fmt::Write;

use ligament_mesh::Group;
use ligament_mesh::gmsh::CoordinatePlane;

use super::body::{Body, Section, coordinates, exact, quantum, quoted, short, size};
use crate::starter::groups::SupportAndLoad;

/// Text of `[mesh]` or of the section of a lattice.
pub(super) fn section<const D: usize>(body: &Body<D>) -> String {
    match &body.section {
        Section::Mesh { file, groups } => mesh(body, file, groups),
        Section::Lattice { cells, rows } => match cells.as_slice() {
            [columns, lines] => lattice(body, [*columns, *lines], *rows),
            cells => solid_lattice(body, cells, *rows),
        },
    }
}

/// Further keys of a body in the plane.
const OF_THE_PLANE: &str = "\
thickness = 1.0 # m, EXAMPLE
plane = \"stress\" # thin bodies; \"strain\" for long ones
";

fn mesh<const D: usize>(
    body: &Body<D>,
    (file, plane): &(String, CoordinatePlane),
    groups: &[Group],
) -> String {
    let mut text = format!(
        "[mesh]\nfile = {} # from the folder of this file\n",
        quoted(file)
    );
    if *plane != CoordinatePlane::Xy {
        let word = plane.word();
        let _ = writeln!(
            text,
            "coordinates = \"{word}\" # the plane of the mesh, whose coordinates are x and y of this file"
        );
    }
    let sides: Vec<String> = (0..D).map(|axis| short(size(body, axis))).collect();
    if let [width, height] = sides.as_slice() {
        text += OF_THE_PLANE;
        let _ = writeln!(text, "# {width} m wide, {height} m high.");
    } else {
        let _ = writeln!(
            text,
            "# A solid of {} m along x, y and z.",
            sides.join(", ")
        );
    }
    if groups.is_empty() {
        text += "# It has no physical groups, so that supports and loads are placed by `box` or `at`.\n";
    } else {
        text += "# Its physical groups, each of which can stand as `group` below:\n";
    }
    for group in groups {
        let kind = ["points", "curve", "surface", "volume"][usize::from(group.dimension.min(3))];
        let _ = writeln!(
            text,
            "#   {} {kind}, {} nodes",
            quoted(&group.name),
            group.nodes.len()
        );
    }
    text
}

fn lattice<const D: usize>(body: &Body<D>, [columns, rows]: [u32; 2], held: u32) -> String {
    let spacing = exact(body.spacing);
    let [width, height] = [0, 1].map(|axis| size(body, axis));
    format!(
        "\
[lattice]
cells = [{columns}, {rows}] # along x and y, with a point at the centre of each
spacing = {spacing} # m
{OF_THE_PLANE}\
#corner = [0.0, 0.0] # lower left corner, m

# Sets of cells, which stand as `group` below.
[lattice.set]
bottom = {{ bottom = {held} }} # rows from below
top = {{ top = {held} }}

# Cells of a hole are removed, and bonds across it.
#[[lattice.remove]]
#circle = {{ centre = [{}, {}], radius = {} }} # m
",
        exact(quantum(body).round(0.5 * width)),
        exact(quantum(body).round(0.5 * height)),
        exact(quantum(body).round(0.1 * width).max(body.spacing)),
    )
}

fn solid_lattice<const D: usize>(body: &Body<D>, cells: &[u32], held: u32) -> String {
    let spacing = exact(body.spacing);
    let cells: Vec<String> = cells.iter().map(u32::to_string).collect();
    let half: Vec<String> = (0..D)
        .map(|axis| exact(quantum(body).round(0.5 * size(body, axis))))
        .collect();
    format!(
        "\
[solid_lattice]
cells = [{}] # along x, y and z, with a point at the centre of each
spacing = [{spacing}, {spacing}, {spacing}] # m
#corner = [0.0, 0.0, 0.0] # the lowest corner, m

# Sets of cells, which stand as `group` below.
[solid_lattice.set]
bottom = {{ bottom = {held} }} # layers from the lowest z
top = {{ top = {held} }}

# Cells of a hole are removed, and bonds across it.
#[[solid_lattice.remove]]
#sphere = {{ centre = [{}], radius = {} }} # m
",
        cells.join(", "),
        half.join(", "),
        exact(quantum(body).round(0.1 * size(body, 0)).max(body.spacing)),
    )
}

/// Text of `[[precrack]]`: a crack across the load, in the middle of the body.
pub(super) fn precrack<const D: usize>(body: &Body<D>, ends: &SupportAndLoad<D>) -> String {
    let quantum = quantum(body);
    let across = (0..D).filter(|axis| *axis != ends.axis);
    let sizes = across.map(|axis| size(body, axis));
    let size = sizes.fold(f64::INFINITY, f64::min);
    let centre = coordinates(body, body.middle);
    match D {
        2 => {
            let length = exact(quantum.round(0.2 * size).max(quantum.step));
            let angle = ["1.5707963268", "0.0"][ends.axis];
            format!(
                "\
# A crack or slot that is there from the start: bonds across it are cut. In the place of the three keys of a straight one,
# `points = [[x, y], [x, y]]` with two corners or more.
#[[precrack]]
#centre = {centre} # m
#length = {length} # m
#angle = {angle} # rad, from the x axis, counter-clockwise; 30 degrees are 0.5235987756
"
            )
        }
        _ => {
            let radius = exact(quantum.round(0.2 * size).max(body.spacing));
            let normal = ["[1.0, 0.0, 0.0]", "[0.0, 1.0, 0.0]", "[0.0, 0.0, 1.0]"][ends.axis];
            format!(
                "\
# A crack that is there from the start: bonds through it are cut. In the place of the three keys of a disk `points` with the corners
# [x, y, z] of a plane polygon, or the `group` of a physical surface in the mesh.
#[[precrack]]
#centre = {centre} # m
#normal = {normal}
#radius = {radius} # m
"
            )
        }
    }
}
