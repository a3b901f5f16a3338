//! `ligament new`: a commented case to start from, for a mesh or a lattice, that runs as it is.

mod groups;
mod text;

use std::path::{Component, Path, PathBuf};

use ligament_mesh::Mesh;

use crate::mesh_file::{MeshFileError, bounding_box, read_mesh};
use groups::{Ends, Spot};
use ligament::setup::Law;
use ligament::warning::{SUSPICIOUSLY_LARGE, Warning};
use text::{Body, Section};

/// A starter case.
#[derive(Debug, Clone, PartialEq)]
pub struct Starter {
    /// The case, TOML with comments.
    pub text: String,
    /// What it holds and what it loads, in a line.
    pub choice: String,
    /// What the user should know.
    pub warnings: Vec<String>,
}

/// Why there is no starter case.
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
    /// The law is for lattices alone.
    #[error("\"{}\" is a law for lattices: take --lattice NX,NY,SPACING in the place of the mesh, or another --law", .0.name())]
    NeedsLattice(Law),
}

/// The starter case of a mesh file; `folder` is that of the case file.
///
/// # Errors
///
/// If the file is no mesh, or the law does not take one.
pub fn of_mesh(path: &Path, folder: &Path, law: Law) -> Result<Starter, StarterError> {
    let extension = path
        .extension()
        .unwrap_or_default()
        .to_string_lossy()
        .to_lowercase();
    if extension == "geo" || extension == "geo_unrolled" {
        return Err(StarterError::Geometry(path.to_owned()));
    }
    if matches!(law, Law::MbbPd { .. }) {
        return Err(StarterError::NeedsLattice(law));
    }
    let mesh = read_mesh(path).map_err(|source| match source {
        MeshFileError::Parse { .. } if extension != "msh" => StarterError::OtherFormat {
            path: path.to_owned(),
            source,
        },
        source => StarterError::Mesh(source),
    })?;
    let name = path.file_stem().unwrap_or_default().to_string_lossy();
    Ok(of_parsed(&mesh, &relative(path, folder), &name, law))
}

/// The starter case of a mesh; `file` is its path in the case, `name` that of the body.
fn of_parsed(mesh: &Mesh, file: &str, name: &str, law: Law) -> Starter {
    let extent = bounding_box(&mesh.positions);
    let spacing = (mesh.area() / mesh.positions.len() as f64).sqrt();
    let sides = [0, 1].map(|axis| extent[1][axis] - extent[0][axis]);
    let size = sides[0].max(sides[1]);
    let warnings = if size > SUSPICIOUSLY_LARGE {
        vec![Warning::LargeBody { length: size }.to_string()]
    } else {
        Vec::new()
    };
    let ends = groups::ends(mesh, extent, spacing);
    let middle = on_body(
        mesh,
        [0, 1].map(|axis| 0.5 * (extent[0][axis] + extent[1][axis])),
        spacing,
    );
    let body = Body {
        name: name.to_owned(),
        section: Section::Mesh {
            file: file.to_owned(),
            groups: mesh.groups.clone(),
        },
        parts: groups::parts(mesh)
            .iter()
            .map(|it| it.name.clone())
            .collect(),
        extent,
        middle,
        opening: opening(middle, sides[ends.axis], ends.axis)
            .map(|place| on_body(mesh, place, spacing)),
        spacing,
    };
    starter(&body, &ends, law, warnings)
}

/// A place or, where the body has a hole there, the node nearest to it.
fn on_body(mesh: &Mesh, place: [f64; 2], spacing: f64) -> [f64; 2] {
    let distance = |node: &[f64; 2]| (node[0] - place[0]).hypot(node[1] - place[1]);
    let nearest = (mesh.positions.iter()).min_by(|a, b| distance(a).total_cmp(&distance(b)));
    let in_hole = nearest.filter(|node| distance(node) > spacing);
    in_hole.copied().unwrap_or(place)
}

/// Places on either side of the middle, apart along an axis by a fifth of the body's size.
fn opening(middle: [f64; 2], size: f64, axis: usize) -> [[f64; 2]; 2] {
    [-0.1, 0.1].map(|share| {
        let mut place = middle;
        place[axis] += share * size;
        place
    })
}

/// The starter case of a lattice of square cells.
pub fn of_lattice(cells: [u32; 2], spacing: f64, law: Law) -> Starter {
    let sides = cells.map(|count| f64::from(count) * spacing);
    let (middle, axis) = (sides.map(|side| 0.5 * side), 1);
    let body = Body {
        name: "lattice".to_owned(),
        section: Section::Lattice {
            cells,
            // A horizon of three cells: bonds of the points that are moved do not fail.
            rows: 3.min(cells[1] / 3).max(1),
        },
        parts: Vec::new(),
        extent: [[0.0; 2], sides],
        middle,
        opening: opening(middle, sides[axis], axis),
        spacing,
    };
    let ends = Ends {
        support: Spot::Group("bottom".to_owned()),
        rollers: Vec::new(),
        load: Spot::Group("top".to_owned()),
        axis,
        away: 1.0,
        presses: false,
        found: "as the lowest and the highest rows",
    };
    starter(&body, &ends, law, Vec::new())
}

fn starter(body: &Body, ends: &Ends, law: Law, warnings: Vec<String>) -> Starter {
    let spot = |spot: &Spot| match spot {
        Spot::Group(name) => format!("at group `{name}`"),
        Spot::Box(_) => "in a box".to_owned(),
    };
    let direction = if ends.presses { "pressed" } else { "pulled" };
    let choice = format!(
        "held {}, {direction} along {} {} (chosen {})",
        spot(&ends.support),
        ["x", "y"][ends.axis],
        spot(&ends.load),
        ends.found
    );
    Starter {
        text: text::case_text(body, ends, law, &warnings),
        choice,
        warnings,
    }
}

/// The path of a file as seen from a folder, with slashes; absolute where there is none.
fn relative(path: &Path, folder: &Path) -> String {
    let here = Path::new(".");
    let folder = if folder.as_os_str().is_empty() {
        here
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
    // Another drive: there is no way from one to the other.
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
