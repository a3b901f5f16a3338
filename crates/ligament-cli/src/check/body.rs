//! Report of `ligament check` on the body.

use std::io;

use ligament::Model;
use ligament::body::{Body, Origin};
use ligament::setup::Fineness;
use ligament_mesh::{Group, Mesh, SolidMesh};
use ligament_model::Lattice;
use ligament_model::cloud::lattice::SolidLattice;

use ligament_output::quantity::{between, quantity};

use super::report::Report;

/// Writes the composition of a body and the volume of its points.
pub(super) fn write(report: &mut Report<'_>, body: &dyn Body, volume: f64) -> io::Result<()> {
    match body.origin() {
        Origin::Mesh(mesh) => write_mesh(report, mesh, volume),
        Origin::Lattice(lattice) => write_lattice(report, body, lattice, volume),
        Origin::SolidMesh(mesh) => write_solid_mesh(report, mesh, volume),
        Origin::SolidLattice(lattice) => write_solid_lattice(report, body, lattice, volume),
        Origin::Points => {
            let (points, volume) = (body.n_points(), quantity(volume, "m^3"));
            report.line(format!("{points} points of {volume}"))
        }
    }
}

fn write_mesh(report: &mut Report<'_>, mesh: &Mesh, volume: f64) -> io::Result<()> {
    report.head("mesh");
    let [nodes, cells] = [mesh.positions.len(), mesh.cells.len()];
    report.entry("nodes, cells", format!("{nodes}, {cells}"))?;
    report.detail("area", quantity(mesh.area(), "m^2"))?;
    report.detail("volume of the points", quantity(volume, "m^3"))?;
    write_groups(report, &mesh.groups)
}

fn write_solid_mesh(report: &mut Report<'_>, mesh: &SolidMesh, volume: f64) -> io::Result<()> {
    report.head("mesh of a solid");
    let [nodes, cells] = [mesh.positions.len(), mesh.cells.len()];
    report.entry("nodes, cells", format!("{nodes}, {cells}"))?;
    report.entry("volume", quantity(mesh.volume(), "m^3"))?;
    report.detail("volume of the points", quantity(volume, "m^3"))?;
    write_groups(report, &mesh.groups)
}

fn write_groups(report: &mut Report<'_>, groups: &[Group]) -> io::Result<()> {
    let names: Vec<&str> = groups.iter().map(|it| it.name.as_str()).collect();
    if !names.is_empty() {
        report.entry("groups", names.join(", "))?;
    }
    for group in groups {
        let kinds = ["points", "curve", "surface", "volume"];
        let kind = kinds.get(usize::from(group.dimension)).unwrap_or(&"group");
        let of_nodes = format!("{kind} of {} nodes", group.nodes.len());
        report.detail(&format!("group {}", group.name), of_nodes)?;
    }
    Ok(())
}

/// Writes the names of the sets of a lattice.
fn write_sets(report: &mut Report<'_>, body: &dyn Body) -> io::Result<()> {
    match body.group_names() {
        names if names.is_empty() => Ok(()),
        names => report.entry("sets", names.join(", ")),
    }
}

fn write_solid_lattice(
    report: &mut Report<'_>,
    body: &dyn Body,
    lattice: &SolidLattice,
    volume: f64,
) -> io::Result<()> {
    let [nx, ny, nz] = lattice.size;
    let left = lattice.cells.len();
    let removed = lattice.n_whole() - left;
    report.head("lattice of a solid");
    let cells = format!("{left} of {nx} x {ny} x {nz} ({removed} removed)");
    report.entry("cells", cells)?;
    let sides = lattice.spacing.map(|it| quantity(it, "m"));
    report.entry("spacing", sides.join(" x "))?;
    report.detail("volume of the points", quantity(volume, "m^3"))?;
    write_sets(report, body)?;
    for name in body.group_names() {
        let points = body.points_of(&name).unwrap_or_default().len();
        report.detail(&format!("set {name}"), format!("{points} points"))?;
    }
    Ok(())
}

fn write_lattice(
    report: &mut Report<'_>,
    body: &dyn Body,
    lattice: &Lattice,
    volume: f64,
) -> io::Result<()> {
    let ([nx, ny], [dx, dy], [x, y]) = (lattice.size, lattice.spacing, lattice.corner);
    let left = lattice.cells.len();
    let removed = lattice.n_whole() - left;
    let [right, top] = [x + f64::from(nx) * dx, y + f64::from(ny) * dy];
    let area = left as f64 * dx * dy;
    report.head("lattice");
    let cells = format!("{left} of {nx} x {ny} ({removed} removed)");
    report.entry("cells", cells)?;
    let [wide, high] = [dx, dy].map(|it| quantity(it, "m"));
    report.entry("spacing", format!("{wide} x {high}"))?;
    let [of_x, of_y] = [[x, right], [y, top]].map(|it| between(it, "m"));
    let sides = format!("x {of_x}, y {of_y}");
    report.detail("rectangle", sides)?;
    report.detail("area", quantity(area, "m^2"))?;
    report.detail("volume of the points", quantity(volume, "m^3"))?;
    write_sets(report, body)?;
    for name in body.group_names() {
        let mut words = format!("{} points", body.points_of(&name).unwrap_or_default().len());
        if let Some(each) = body.lengths_of(&name).first() {
            words += &format!(", {} of a side each", quantity(each.share[0], "m"));
        }
        report.detail(&format!("set {name}"), words)?;
    }
    Ok(())
}

/// Writes what a refinement does with the mesh.
pub(super) fn write_refinement(report: &mut Report<'_>, model: &Model) -> io::Result<()> {
    let (Some(refine), Some(refined)) = (&model.setup.refine, &model.refined) else {
        return Ok(());
    };
    let at_crack = match refine.fineness {
        Fineness::Size(size) => format!("cells of {}", quantity(size, "m")),
        Fineness::Levels(1) => "edges halved once".to_owned(),
        Fineness::Levels(levels) => format!("edges halved {levels} times"),
    };
    let words = format!(
        "{at_crack} where bonds break; at most {} passes, each on a mesh that is finer around what broke before",
        refine.passes
    );
    report.entry("refinement", words)?;
    if refined.fine_horizon() > 0.0 {
        let horizon = quantity(refined.fine_horizon(), "m");
        let words = format!(
            "{} around {} places, with horizons of at most {horizon}",
            refine.pass,
            refine.places.len()
        );
        report.entry("this is pass", words)?;
    }
    Ok(())
}

/// Writes a group of points that are supported or loaded.
pub(super) fn write_group(
    report: &mut Report<'_>,
    body: &dyn Body,
    name: &str,
    points: &[u32],
) -> io::Result<()> {
    let where_at = match points {
        [only] => body.place(*only),
        points => format!("{} points", points.len()),
    };
    report.detail(name, where_at)
}
