//! Errors of making and converting meshes.

use std::io;
use std::path::{Path, PathBuf};

use ligament::suggestion::hint;
use ligament_mesh::gmsh::{CoordinatePlane, GmshError};
use ligament_mesh::inp::InpError;

/// Error of making or converting a mesh. An existing mesh is then unchanged.
#[derive(Debug, thiserror::Error)]
pub enum MeshingError {
    /// The geometry or mesh does not exist.
    #[error("there is no {what} {}", path.display())]
    NoSource {
        /// Kind of the source.
        what: &'static str,
        /// The path at which the source should be.
        path: PathBuf,
    },
    /// A CAD file is given without a size of the cells.
    #[error("{}: give the size of the cells in m, `--size SIZE`{}", geometry.display(), proposed(*size))]
    NoSize {
        /// The CAD file.
        geometry: PathBuf,
        /// Size of about 5000 cells, m.
        size: Option<f64>,
    },
    /// The file is not a geometry, by its extension.
    #[error(
        "{} is no .geo file and no CAD file (.step, .stp, .iges, .igs, .brep): `ligament mesh` meshes geometries; a mesh of another program is \
         converted by `ligament mesh --via-meshio {}`",
        .0.display(), .0.display()
    )]
    NoGeo(PathBuf),
    /// A number to be set that the geometry does not use.
    #[error(
        "--set {name}=...: {} does not mention `{name}`{}",
        geometry.display(), hint(name, declared, "it declares", '`')
    )]
    UnusedNumber {
        /// File of the geometry.
        geometry: PathBuf,
        /// Name of the number.
        name: String,
        /// The names that the geometry declares by `DefineConstant`.
        declared: Vec<String>,
    },
    /// The mesh would replace its own source.
    #[error("--out {} is the {what}", path.display())]
    WouldReplaceSource {
        /// Kind of the source.
        what: &'static str,
        /// File that is refused.
        path: PathBuf,
    },
    /// A program could not be found.
    #[error("cannot find the program `{}`; {remedy}", program.display())]
    NoProgram {
        /// Program that was not found.
        program: PathBuf,
        /// Advice on installing the program, or giving its path.
        remedy: &'static str,
    },
    /// A program could not be started.
    #[error("cannot start `{}`", program.display())]
    Start {
        /// Program that cannot be started.
        program: PathBuf,
        /// The system's reason.
        source: io::Error,
    },
    /// The mesh cannot be written to its path.
    #[error(transparent)]
    Output(#[from] ligament_output::Error),
    /// Python lacks a package.
    #[error(
        "`{}` has no package `{package}`; install it: {} -m pip install {}",
        python.display(), python.display(), with_companions(package)
    )]
    NoPackage {
        /// Python that lacks the package.
        python: PathBuf,
        /// Package that is missing.
        package: String,
    },
    /// A program refused the source.
    #[error("{}", refusal.words(path, lines))]
    Refused {
        /// Kind of the refusal.
        refusal: Refusal,
        /// The geometry or mesh.
        path: PathBuf,
        /// Lines of the program about it.
        lines: Vec<String>,
    },
    /// Python ended without a mesh.
    #[error("`{}` failed on {}{}", python.display(), mesh.display(), indented(lines))]
    Failed {
        /// Python that failed.
        python: PathBuf,
        /// The mesh that was to be converted.
        mesh: PathBuf,
        /// Last lines of Python's output.
        lines: Vec<String>,
    },
    /// An input deck cannot be read.
    #[error("cannot use the input deck {}{}", deck.display(), match **source {
        InpError::OtherPlane { plane } => by_option(plane),
        _ => String::new(),
    })]
    Deck {
        /// The deck.
        deck: PathBuf,
        /// The reader's reason.
        source: Box<InpError>,
    },
    /// The mesh by gmsh cannot be used.
    #[error("gmsh made a mesh of {} that cannot be used{}", geometry.display(), plane_advice(source))]
    Unusable {
        /// File of the geometry.
        geometry: PathBuf,
        /// The reader's reason.
        source: GmshError,
    },
    /// The converted mesh cannot be used.
    #[error("the mesh of {} cannot be used{}", mesh.display(), plane_advice(source))]
    UnusableSource {
        /// The mesh that was to be converted.
        mesh: PathBuf,
        /// The reader's reason; its lines refer to the Gmsh file that would have been written.
        source: GmshError,
    },
    /// A plane is given for a mesh with solid cells.
    #[error("{} has solid cells: only a mesh without them is turned from the plane of {plane}", mesh.display())]
    SolidInPlane {
        /// The mesh that was to be converted.
        mesh: PathBuf,
        /// Plane that was given.
        plane: CoordinatePlane,
    },
    /// A file could not be read or written.
    #[error("cannot {action} {}", path.display())]
    File {
        /// Operation, a verb.
        action: &'static str,
        /// File that cannot be read or written.
        path: PathBuf,
        /// The system's reason.
        source: io::Error,
    },
}

/// Reason why a program refused a source.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Refusal {
    /// Gmsh reported errors or made no mesh.
    NotMeshed,
    /// The format is unknown to meshio.
    UnknownFormat,
    /// Meshio could not read the file.
    Unreadable,
    /// The source is a Gmsh mesh already.
    IsGmsh,
    /// The source has cells of unsupported shapes.
    Shapes,
    /// The source has neither planar nor solid cells.
    NoCells,
    /// The source has planar cells only and is not in the expected plane.
    NotPlanar,
}

impl Refusal {
    fn words(self, path: &Path, lines: &[String]) -> String {
        let (path, below, beside) = (path.display(), indented(lines), lines.join(" "));
        match self {
            Self::NotMeshed => format!("gmsh could not mesh {path}{below}"),
            Self::UnknownFormat => format!(
                "meshio does not know the format of {path}: give it by --format NAME, as meshio calls it (abaqus, nastran, \
                 exodus, ...){below}"
            ),
            Self::Unreadable => format!("meshio could not read {path}{below}"),
            Self::IsGmsh => format!("{path} is a Gmsh mesh: Ligament reads it as it is"),
            Self::Shapes => format!(
                "{path} has cells that are neither triangles and quadrangles nor tetrahedra, hexahedra, prisms and pyramids: {beside}"
            ),
            Self::NoCells => format!(
                "there are no triangles, quadrangles or solid cells in {path}, only: {beside}"
            ),
            Self::NotPlanar => format!(
                "{path} has no solid cells and is not planar: {beside}; of a solid mesh the volume too"
            ),
        }
    }
}

/// The option that turns a mesh in another plane.
fn plane_advice(error: &GmshError) -> String {
    match error {
        GmshError::OtherPlane { plane, .. } => by_option(*plane),
        _ => String::new(),
    }
}

fn by_option(plane: CoordinatePlane) -> String {
    format!("; `--plane {}` turns it", plane.word())
}

fn proposed(size: Option<f64>) -> String {
    size.map_or(String::new(), |size| {
        format!("; `--size {size:e}` makes about 5000 cells")
    })
}

/// Lines of another program's output, indented below an error.
fn indented(lines: &[String]) -> String {
    lines.iter().map(|line| format!("\n  {line}")).collect()
}

/// A package with the packages to be installed together: meshio needs others for formats on HDF5 and netCDF.
fn with_companions(package: &str) -> String {
    match package {
        "meshio" | "numpy" => "meshio".to_owned(),
        other => format!("meshio {other}"),
    }
}
