//! `ligament new`: a commented starter case for a mesh or a lattice, which runs unchanged.

mod deck;
mod groups;
mod text;

use std::path::{Component, Path, PathBuf};

use ligament_mesh::gmsh::CoordinatePlane;
use ligament_mesh::{AnyMesh, Group};

pub use deck::{DeckCase, Units, deck_case};

use crate::mesh_file::{MeshFileError, bounding_box, read_in_own_plane};
use groups::{LoadPlace, MeshGroups, SupportAndLoad};
use ligament::setup::Law;
use ligament::warning::large_body;
use ligament_model::law::{laws_with, listed};
use ligament_model::material::Space;
use text::{Body, Section};

/// A starter case.
#[derive(Debug, Clone, PartialEq)]
pub struct Starter {
    /// Text of the case, TOML with comments.
    pub text: String,
    /// One-line description of supports and loads.
    pub choice: String,
    /// Warnings for the user.
    pub warnings: Vec<String>,
}

/// Error of making a starter case.
#[derive(Debug, thiserror::Error)]
pub enum StarterError {
    /// The file is a geometry, not a mesh.
    #[error("{} is a geometry: mesh it first (`ligament mesh {}`), then take the .msh", .0.display(), .0.display())]
    Geometry(PathBuf),
    /// The file is of another kind.
    #[error(
        "{} is not a Gmsh mesh (.msh): convert it with `ligament mesh --via-meshio`, or save it by Gmsh or meshio as .msh",
        path.display()
    )]
    OtherFormat {
        /// The file.
        path: PathBuf,
        /// The reader's reason.
        source: MeshFileError,
    },
    /// The mesh cannot be read.
    #[error(transparent)]
    Mesh(#[from] MeshFileError),
    /// The law is for lattices only.
    #[error("\"{}\" is a law for lattices: take --lattice NX,NY,SPACING in the place of the mesh, or another --law", .0.name())]
    NeedsLattice(Law),
    /// The law is for bodies in the plane only.
    #[error("\"{}\" is a law of the plane, and the body is a solid: take {} as --law", .0.name(), laws_for_solids())]
    NeedsPlane(Law),
}

/// The starter case of a mesh file; `folder` is the folder of the case file.
///
/// # Errors
///
/// If the file is not a mesh, or the law is not for meshes.
pub fn mesh_case(path: &Path, folder: &Path, law: Law) -> Result<Starter, StarterError> {
    let extension = path
        .extension()
        .unwrap_or_default()
        .to_string_lossy()
        .to_lowercase();
    if extension == "geo" || extension == "geo_unrolled" {
        return Err(StarterError::Geometry(path.to_owned()));
    }
    check_law(law, false)?;
    let (mesh, plane) = read_in_own_plane(path).map_err(|source| match source {
        MeshFileError::Parse { .. } if extension != "msh" => StarterError::OtherFormat {
            path: path.to_owned(),
            source,
        },
        source => StarterError::Mesh(source),
    })?;
    let name = path.file_stem().unwrap_or_default().to_string_lossy();
    let file = (relative(path, folder), plane);
    match &mesh {
        AnyMesh::Plane(mesh) => {
            let spacing = (mesh.area() / mesh.positions.len() as f64).sqrt();
            let named = named(&mesh.groups, &mesh.positions, mesh.cells.len());
            Ok(case_of_mesh(named, spacing, (&file, &name), law))
        }
        AnyMesh::Solid(mesh) => {
            check_law(law, true)?;
            let spacing = (mesh.volume() / mesh.positions.len() as f64).cbrt();
            let named = named(&mesh.groups, &mesh.positions, mesh.cells.len());
            Ok(case_of_mesh(named, spacing, (&file, &name), law))
        }
    }
}

fn named<'a, const D: usize>(
    groups: &'a [Group],
    positions: &'a [[f64; D]],
    n_cells: usize,
) -> MeshGroups<'a, D> {
    MeshGroups {
        groups,
        positions,
        n_cells,
    }
}

/// Refuses a law for a mesh, or for the mesh of a solid.
fn check_law(law: Law, is_solid: bool) -> Result<(), StarterError> {
    if law.row.needs_lattice {
        return Err(StarterError::NeedsLattice(law));
    }
    check_space(law, is_solid)
}

fn check_space(law: Law, is_solid: bool) -> Result<(), StarterError> {
    match law.row.exists_in(Space::Solid) || !is_solid {
        true => Ok(()),
        false => Err(StarterError::NeedsPlane(law)),
    }
}

/// List of the laws for solids.
fn laws_for_solids() -> String {
    listed(&laws_with(|it| it.exists_in(Space::Solid)), |it| {
        it.word.to_owned()
    })
}

/// The starter case of a mesh with a spacing of its points (m); `file` is its path in the case with the plane in which it lies, `name` the
/// name of the body.
fn case_of_mesh<const D: usize>(
    mesh: MeshGroups<'_, D>,
    spacing: f64,
    (file, name): (&(String, CoordinatePlane), &str),
    law: Law,
) -> Starter {
    let extent = bounding_box(mesh.positions);
    let sides: [f64; D] = std::array::from_fn(|axis| extent[1][axis] - extent[0][axis]);
    let size = sides.into_iter().fold(0.0, f64::max);
    let warnings = large_body(size).iter().map(ToString::to_string).collect();
    let ends = mesh.ends(extent, spacing);
    let middle = std::array::from_fn(|axis| 0.5 * (extent[0][axis] + extent[1][axis]));
    let middle = on_body(mesh.positions, middle, spacing);
    let body = Body {
        name: name.to_owned(),
        section: Section::Mesh {
            file: file.clone(),
            groups: mesh.groups.to_vec(),
        },
        parts: mesh.parts().iter().map(|it| it.name.clone()).collect(),
        extent,
        middle,
        opening: positions_beside_middle(middle, sides[ends.axis], ends.axis)
            .map(|place| on_body(mesh.positions, place, spacing)),
        spacing,
    };
    starter(&body, &ends, law, warnings)
}

/// A position or, where the body has a hole there, the nearest node.
fn on_body<const D: usize>(positions: &[[f64; D]], place: [f64; D], spacing: f64) -> [f64; D] {
    let distance = |node: &[f64; D]| {
        let squares = node.iter().zip(&place).map(|(a, b)| (a - b).powi(2));
        squares.sum::<f64>().sqrt()
    };
    let nearest = (positions.iter()).min_by(|a, b| distance(a).total_cmp(&distance(b)));
    let in_hole = nearest.filter(|node| distance(node) > spacing);
    in_hole.copied().unwrap_or(place)
}

/// Positions on either side of the middle, a fifth of the body's size apart along an axis.
fn positions_beside_middle<const D: usize>(
    middle: [f64; D],
    size: f64,
    axis: usize,
) -> [[f64; D]; 2] {
    [-0.1, 0.1].map(|share| {
        let mut place = middle;
        place[axis] += share * size;
        place
    })
}

/// The starter case of a lattice of square cells.
pub fn lattice_case(cells: [u32; 2], spacing: f64, law: Law) -> Starter {
    lattice_case_of_cells(cells, spacing, law)
}

/// The starter case of a lattice of cubes.
///
/// # Errors
///
/// If the law is for bodies in the plane only.
pub fn solid_lattice_case(
    cells: [u32; 3],
    spacing: f64,
    law: Law,
) -> Result<Starter, StarterError> {
    check_space(law, true)?;
    Ok(lattice_case_of_cells(cells, spacing, law))
}

fn lattice_case_of_cells<const D: usize>(cells: [u32; D], spacing: f64, law: Law) -> Starter {
    let sides = cells.map(|count| f64::from(count) * spacing);
    let (middle, axis) = (sides.map(|side| 0.5 * side), D - 1);
    let body = Body {
        name: "lattice".to_owned(),
        section: Section::Lattice {
            cells,
            // Three rows, about a horizon: bonds of the moved points do not fail.
            rows: 3.min(cells[axis] / 3).max(1),
        },
        parts: Vec::new(),
        extent: [[0.0; D], sides],
        middle,
        opening: positions_beside_middle(middle, sides[axis], axis),
        spacing,
    };
    let ends = SupportAndLoad {
        support: LoadPlace::Group("bottom".to_owned()),
        rollers: Vec::new(),
        load: LoadPlace::Group("top".to_owned()),
        axis,
        away: 1.0,
        presses: false,
        span: 0.0,
        found: "as the lowest and the highest rows",
    };
    starter(&body, &ends, law, Vec::new())
}

fn starter<const D: usize>(
    body: &Body<D>,
    ends: &SupportAndLoad<D>,
    law: Law,
    warnings: Vec<String>,
) -> Starter {
    let spot = |spot: &LoadPlace<D>| match spot {
        LoadPlace::Group(name) => format!("at group `{}`", name.escape_debug()),
        LoadPlace::Box(_) => "in a box".to_owned(),
    };
    let direction = if ends.presses { "pressed" } else { "pulled" };
    let choice = format!(
        "held {}, {direction} along {} {} (chosen {})",
        spot(&ends.support),
        ["x", "y", "z"][ends.axis],
        spot(&ends.load),
        ends.found
    );
    Starter {
        text: text::case_text(body, ends, law, &warnings),
        choice,
        warnings,
    }
}

/// The path of a file relative to a folder, with slashes; absolute if there is no relative path.
fn relative(path: &Path, folder: &Path) -> String {
    let current = Path::new(".");
    let folder = if folder.as_os_str().is_empty() {
        current
    } else {
        folder
    };
    let absolute = |it: &Path| it.canonicalize().or_else(|_| std::path::absolute(it));
    let (Ok(path), Ok(folder)) = (absolute(path), absolute(folder)) else {
        return path.to_string_lossy().into_owned();
    };
    let (to, from): (Vec<Component>, Vec<Component>) =
        (path.components().collect(), folder.components().collect());
    let shared = to.iter().zip(&from).take_while(|(a, b)| a == b).count();
    // There is no relative path to another drive.
    if shared == 0 {
        return path.to_string_lossy().into_owned();
    }
    let up = from[shared..].iter().map(|_| "..".to_owned());
    let down = to[shared..]
        .iter()
        .map(|part| part.as_os_str().to_string_lossy().into_owned());
    up.chain(down).collect::<Vec<_>>().join("/")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn paths_lead_from_the_case_to_the_mesh() {
        let folder = tempfile::tempdir().unwrap();
        let at = |name: &str| folder.path().join(name);
        std::fs::create_dir_all(at("meshes")).unwrap();
        std::fs::create_dir_all(at("cases/a")).unwrap();
        std::fs::write(at("meshes/plate.msh"), "").unwrap();
        let mesh = at("meshes/plate.msh");
        assert_eq!(relative(&mesh, &at("cases/a")), "../../meshes/plate.msh");
        assert_eq!(relative(&mesh, &at("meshes")), "plate.msh");
        assert_eq!(relative(&mesh, folder.path()), "meshes/plate.msh");
    }
}
