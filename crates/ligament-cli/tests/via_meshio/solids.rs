//! Solids by meshio: Gmsh files that it writes, and formats of other programs.

use std::fs;
use std::path::Path;
use std::process::Command;

use ligament_mesh::{AnyMesh, Group, SolidMesh, gmsh};

use super::{convert, python, text};

/// The meshes of `solids.py`.
fn fixtures() -> tempfile::TempDir {
    let folder = tempfile::tempdir().unwrap();
    let script = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/via_meshio/solids.py");
    let arguments = [script, folder.path().to_owned()];
    let output = Command::new(python()).args(arguments).output().unwrap();
    assert!(output.status.success(), "{}", text(&output.stderr));
    folder
}

fn read(path: &Path) -> SolidMesh {
    match gmsh::parse_any(&fs::read(path).unwrap()) {
        Ok(AnyMesh::Solid(mesh)) => mesh,
        other => panic!("{}: {other:?}", path.display()),
    }
}

/// Name and dimension of a group, with the number of its nodes and of its edges, faces or cells.
type Counts<'a> = (&'a str, u8, usize, usize);

fn counts(it: &Group) -> Counts<'_> {
    let members = it.edges.len() + it.faces.len() + it.cells.len();
    (it.name.as_str(), it.dimension, it.nodes.len(), members)
}

fn groups(mesh: &SolidMesh) -> Vec<Counts<'_>> {
    let mut groups: Vec<_> = mesh.groups.iter().map(counts).collect();
    groups.sort_unstable();
    groups
}

fn area(mesh: &SolidMesh, group: &str) -> f64 {
    let faces = mesh.group(group).unwrap().faces.iter();
    let areas = faces.map(|it| it.area_vector(&mesh.positions));
    areas.map(|[x, y, z]| (x * x + y * y + z * z).sqrt()).sum()
}

/// The block as `solids.py` describes it: 4 hexahedra, 8 prisms, 20 pyramids and 32 tetrahedra that fill 4 x 2 x 2.
fn assert_is_block(mesh: &SolidMesh, file: &str) {
    let counts = ["hexahedron", "prism", "pyramid", "tetrahedron"].map(|shape| {
        mesh.cells
            .iter()
            .filter(|it| it.shape_name() == shape)
            .count()
    });
    assert_eq!(counts, [4, 8, 20, 32], "{file}");
    assert_eq!(mesh.positions.len(), 49, "{file}");
    assert!(
        (mesh.volume() - 16.0).abs() < 1e-12,
        "{file}: {}",
        mesh.volume()
    );
    assert!(
        mesh.cells.iter().all(|it| it.volume(&mesh.positions) > 0.0),
        "{file}"
    );
}

const NAMED: [Counts<'_>; 6] = [
    ("corner", 0, 1, 0),
    ("edge", 1, 5, 4),
    ("first", 3, 27, 12),
    ("left", 2, 9, 4),
    ("right", 2, 9, 8),
    ("second", 3, 31, 52),
];

/// All four kinds of Gmsh files that meshio writes, with groups of all dimensions.
#[test]
#[ignore = "needs LIGAMENT_PYTHON; run by tools/test"]
fn gmsh_files_by_meshio_are_read() {
    let folder = fixtures();
    for file in [
        "ascii-2.2.msh",
        "binary-2.2.msh",
        "ascii-4.1.msh",
        "binary-4.1.msh",
    ] {
        let mesh = read(&folder.path().join(file));
        assert_is_block(&mesh, file);
        assert_eq!(groups(&mesh), NAMED, "{file}");
        assert_eq!(
            [area(&mesh, "left"), area(&mesh, "right")],
            [4.0, 4.0],
            "{file}"
        );
        assert!(mesh.remarks.is_empty(), "{file}: {:?}", mesh.remarks);
    }
}

/// Cells and groups through `ligament mesh --via-meshio`: numbers of parts of VTK, and sets and sides of elements of Abaqus.
#[test]
#[ignore = "needs LIGAMENT_PYTHON; run by tools/test"]
fn solids_of_other_programs_are_kept() {
    let folder = fixtures();
    let parts = [
        ("part-1", 3, 27, 12),
        ("part-2", 3, 31, 52),
        ("part-3", 2, 9, 4),
        ("part-4", 2, 9, 8),
        ("part-5", 1, 5, 4),
        ("part-6", 0, 1, 0),
    ];
    let of_exodus = [
        ("corner", 0, 1, 0),
        ("hexahedron-1", 3, 18, 4),
        ("left", 2, 9, 4),
        ("pyramid-2", 3, 22, 20),
        ("right", 2, 9, 8),
        ("tetra-2", 3, 22, 32),
        ("wedge-1", 3, 18, 8),
    ];
    let of_sets: Vec<_> = NAMED.into_iter().filter(|it| it.0 != "edge").collect();
    for (file, expected) in [
        ("block.vtu", &parts[..]),
        ("block.vtk", &parts),
        ("block.inp", &of_sets),
        ("block.e", &of_exodus),
    ] {
        let output = convert(folder.path(), file, "out.msh");
        assert_eq!(
            output.status.code(),
            Some(0),
            "{file}: {}",
            text(&output.stderr)
        );
        let said = text(&output.stdout);
        assert!(
            said.contains("64 (32 tetrahedra, 4 hexahedra, 8 prisms, 20 pyramids)"),
            "{said}"
        );
        let mesh = read(&folder.path().join("out.msh"));
        assert_is_block(&mesh, file);
        assert_eq!(groups(&mesh), expected, "{file}");
    }
}

/// A surface in space, plane cells beside the solid and flat cells.
#[test]
#[ignore = "needs LIGAMENT_PYTHON; run by tools/test"]
fn unfit_solids_are_refused_or_told_of() {
    let folder = fixtures();
    for (file, expected) in [
        ("surface.vtu", "has no solid cells and is not planar"),
        ("flat.vtu", "is flat"),
    ] {
        let output = convert(folder.path(), file, "out.msh");
        assert_eq!(output.status.code(), Some(1), "{file}");
        let said = text(&output.stderr);
        assert!(said.contains(expected), "{file}: {said}");
    }
    let output = convert(folder.path(), "mixed.vtu", "out.msh");
    let said = text(&output.stdout);
    assert!(
        said.contains("1 member of the group `part-9` (surface) on no corner of a cell dropped"),
        "{said}"
    );
}
