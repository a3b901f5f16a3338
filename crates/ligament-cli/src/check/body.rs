//! Report of `ligament check` on the body.

use std::io::{self, Write};

use ligament::body::{Body, Origin};
use ligament_mesh::{Group, Mesh, SolidMesh};
use ligament_model::Lattice;
use ligament_model::cloud::lattice::SolidLattice;

use ligament_output::quantity::{between, quantity};

use super::entry::entry;

/// Writes the composition of a body and the volume of its points.
pub(super) fn write(out: &mut dyn Write, body: &dyn Body, volume: f64) -> io::Result<()> {
    match body.origin() {
        Origin::Mesh(mesh) => write_mesh(out, mesh, volume),
        Origin::Lattice(lattice) => write_lattice(out, body, lattice, volume),
        Origin::SolidMesh(mesh) => write_solid_mesh(out, mesh, volume),
        Origin::SolidLattice(lattice) => write_solid_lattice(out, body, lattice, volume),
        Origin::Points => {
            let (points, volume) = (body.n_points(), quantity(volume, "m^3"));
            writeln!(out, "{points} points of {volume}")
        }
    }
}

fn write_mesh(out: &mut dyn Write, mesh: &Mesh, volume: f64) -> io::Result<()> {
    writeln!(out, "mesh")?;
    let [nodes, cells] = [mesh.positions.len(), mesh.cells.len()];
    entry(out, "nodes, cells", format!("{nodes}, {cells}"))?;
    entry(out, "area", quantity(mesh.area(), "m^2"))?;
    entry(out, "volume of the points", quantity(volume, "m^3"))?;
    write_groups(out, &mesh.groups)
}

fn write_solid_mesh(out: &mut dyn Write, mesh: &SolidMesh, volume: f64) -> io::Result<()> {
    writeln!(out, "mesh of a solid")?;
    let [nodes, cells] = [mesh.positions.len(), mesh.cells.len()];
    entry(out, "nodes, cells", format!("{nodes}, {cells}"))?;
    entry(out, "volume", quantity(mesh.volume(), "m^3"))?;
    entry(out, "volume of the points", quantity(volume, "m^3"))?;
    write_groups(out, &mesh.groups)
}

fn write_groups(out: &mut dyn Write, groups: &[Group]) -> io::Result<()> {
    for group in groups {
        let kinds = ["points", "curve", "surface", "volume"];
        let kind = kinds.get(usize::from(group.dimension)).unwrap_or(&"group");
        let of_nodes = format!("{kind} of {} nodes", group.nodes.len());
        entry(out, &format!("group {}", group.name), of_nodes)?;
    }
    Ok(())
}

fn write_solid_lattice(
    out: &mut dyn Write,
    body: &dyn Body,
    lattice: &SolidLattice,
    volume: f64,
) -> io::Result<()> {
    let [nx, ny, nz] = lattice.size;
    let left = lattice.cells.len();
    let removed = lattice.n_whole() - left;
    writeln!(out, "lattice of a solid")?;
    let cells = format!("{left} of {nx} x {ny} x {nz} ({removed} removed)");
    entry(out, "cells", cells)?;
    let sides = lattice.spacing.map(|it| quantity(it, "m"));
    entry(out, "spacing", sides.join(" x "))?;
    entry(out, "volume of the points", quantity(volume, "m^3"))?;
    for name in body.group_names() {
        let points = body.points_of(&name).unwrap_or_default().len();
        entry(out, &format!("set {name}"), format!("{points} points"))?;
    }
    Ok(())
}

fn write_lattice(
    out: &mut dyn Write,
    body: &dyn Body,
    lattice: &Lattice,
    volume: f64,
) -> io::Result<()> {
    let ([nx, ny], [dx, dy], [x, y]) = (lattice.size, lattice.spacing, lattice.corner);
    let left = lattice.cells.len();
    let removed = lattice.n_whole() - left;
    let [right, top] = [x + f64::from(nx) * dx, y + f64::from(ny) * dy];
    let area = left as f64 * dx * dy;
    writeln!(out, "lattice")?;
    let cells = format!("{left} of {nx} x {ny} ({removed} removed)");
    entry(out, "cells", cells)?;
    let [wide, high] = [dx, dy].map(|it| quantity(it, "m"));
    entry(out, "spacing", format!("{wide} x {high}"))?;
    let [of_x, of_y] = [[x, right], [y, top]].map(|it| between(it, "m"));
    let sides = format!("x {of_x}, y {of_y}");
    entry(out, "rectangle", sides)?;
    entry(out, "area", quantity(area, "m^2"))?;
    entry(out, "volume of the points", quantity(volume, "m^3"))?;
    for name in body.group_names() {
        let mut words = format!("{} points", body.points_of(&name).unwrap_or_default().len());
        if let Some((_, length)) = body.lengths_of(&name).first() {
            words += &format!(", {} of a side each", quantity(*length, "m"));
        }
        entry(out, &format!("set {name}"), words)?;
    }
    Ok(())
}

/// Writes a group of points that are supported or loaded.
pub(super) fn write_group(
    out: &mut dyn Write,
    body: &dyn Body,
    name: &str,
    points: &[u32],
) -> io::Result<()> {
    let where_at = match points {
        [only] => body.place(*only),
        points => format!("{} points", points.len()),
    };
    entry(out, name, where_at)
}
