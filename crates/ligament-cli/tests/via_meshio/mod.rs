//! `ligament mesh --via-meshio`: meshes of other programs with their groups, and the message where there is none.

#![allow(clippy::unwrap_used, reason = "a failed unwrap fails the test")]

use std::ffi::OsStr;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};

use ligament_mesh::{Cell, Mesh, gmsh};

mod solids;

use crate::support::{ligament, text};

fn repository() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../..")
}

fn python() -> PathBuf {
    std::env::var_os("LIGAMENT_PYTHON")
        .expect("set LIGAMENT_PYTHON to a Python with tools/requirements.txt installed")
        .into()
}

/// The meshes of `fixtures.py`, made from a mesh of the repository.
fn fixtures(mesh: &str) -> tempfile::TempDir {
    let folder = tempfile::tempdir().unwrap();
    let script = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/via_meshio/fixtures.py");
    let source = repository().join("meshes").join(mesh);
    let output = Command::new(python())
        .args([script, source, folder.path().to_owned()])
        .output()
        .unwrap();
    assert!(output.status.success(), "{}", text(&output.stderr));
    folder
}

fn convert(folder: &Path, file: &str, out: &str) -> Output {
    let (source, out, python) = (folder.join(file), folder.join(out), python());
    let words = ["mesh", "--via-meshio", "--python", "--out"].map(OsStr::new);
    let [mesh, via, with, to] = words;
    ligament([
        mesh,
        via,
        source.as_os_str(),
        with,
        python.as_os_str(),
        to,
        out.as_os_str(),
        "--force".as_ref(),
    ])
}

fn read(path: &Path) -> Mesh {
    gmsh::parse(&fs::read(path).unwrap()).unwrap()
}

/// Corners of the cells in an order of their own: formats may write the parts of a mesh one after the other.
fn sorted_cells(mesh: &Mesh) -> Vec<Vec<u32>> {
    let mut cells: Vec<Vec<u32>> = mesh.cells.iter().map(|it| it.corners().to_vec()).collect();
    cells.sort_unstable();
    cells
}

/// Content of the groups of a mesh: name, dimension, nodes, sorted edges and corners of cells.
type Content = (String, u8, Vec<u32>, Vec<[u32; 2]>, Vec<Vec<u32>>);

fn content(mesh: &Mesh, name: &str, dimension: u8) -> Content {
    let mut groups = mesh
        .groups_named(name)
        .filter(|it| it.dimension == dimension);
    let names: Vec<&str> = mesh.groups.iter().map(|it| it.name.as_str()).collect();
    let group = groups
        .next()
        .unwrap_or_else(|| panic!("{name} in {names:?}"));
    let mut edges: Vec<[u32; 2]> = group.edges.clone();
    edges.iter_mut().for_each(|edge| edge.sort_unstable());
    edges.sort_unstable();
    let corners = |cell: &u32| mesh.cells[*cell as usize].corners().to_vec();
    let mut cells: Vec<Vec<u32>> = group.cells.iter().map(corners).collect();
    cells.sort_unstable();
    (String::new(), dimension, group.nodes.clone(), edges, cells)
}

/// The left half of the plate by its definition: the triangles whose middle has x below that of all nodes.
fn half(mesh: &Mesh) -> Vec<Vec<u32>> {
    let xs = mesh.positions.iter().map(|it| it[0]);
    let low = xs.clone().fold(f64::INFINITY, f64::min);
    assert_eq!(low, 0.0);
    let mean = xs.sum::<f64>() / mesh.positions.len() as f64;
    let middle = |cell: &&Cell| {
        let corners = cell.corners().iter();
        corners
            .map(|&it| mesh.positions[it as usize][0])
            .sum::<f64>()
            / 3.0
            < mean
    };
    let cells = mesh.cells.iter().filter(middle);
    let mut cells: Vec<Vec<u32>> = cells.map(|it| it.corners().to_vec()).collect();
    cells.sort_unstable();
    cells
}

/// Groups of a format: the name there, and the group of the Gmsh mesh that it should be (or `half`, or `rest`).
struct Format {
    file: &'static str,
    groups: &'static [(&'static str, u8, &'static str)],
    tags: fn(u64) -> u64,
}

const PARTS: [(&str, u8, &str); 6] = [
    ("part-1", 2, "half"),
    ("part-2", 2, "rest"),
    ("part-3", 1, "left"),
    ("part-4", 1, "right"),
    ("part-5", 1, "bottom"),
    ("part-6", 1, "top"),
];

const FORMATS: [Format; 8] = [
    Format {
        file: "plate.inp",
        groups: &[
            ("corner", 0, "corner"),
            ("NODES-OF-LEFT", 0, "left"),
            ("left", 1, "left"),
            ("right", 1, "right"),
            ("bottom", 1, "bottom"),
            ("top", 1, "top"),
            ("ends", 1, "left and right"),
            ("top-of-cells", 1, "top"),
            ("plate", 2, "plate"),
            ("half", 2, "half"),
            ("all-nodes", 0, "plate"),
        ],
        tags: |place| place + 1,
    },
    Format {
        file: "plate.bdf",
        groups: &[
            ("ref-1", 2, "half"),
            ("ref-2", 2, "rest"),
            ("ref-3", 1, "left"),
            ("ref-4", 1, "right"),
            ("ref-5", 1, "bottom"),
            ("ref-6", 1, "top"),
        ],
        tags: |place| 10 * place + 7,
    },
    Format {
        file: "plate.mesh",
        groups: &[
            ("ref-9", 0, "corner"),
            ("ref-1", 2, "half"),
            ("ref-2", 2, "rest"),
            ("ref-3", 1, "left"),
            ("ref-4", 1, "right"),
            ("ref-5", 1, "bottom"),
            ("ref-6", 1, "top"),
        ],
        tags: |place| place + 1,
    },
    Format {
        file: "plate.med",
        groups: &[
            ("corner", 0, "corner"),
            ("left", 1, "left"),
            ("right", 1, "right"),
            ("bottom", 1, "bottom"),
            ("top", 1, "top"),
            ("plate", 2, "plate"),
            ("half", 2, "half"),
        ],
        tags: |place| place + 1,
    },
    Format {
        file: "plate.e",
        groups: &[
            ("corner", 0, "corner"),
            ("node-set-7", 0, "left"),
            ("top", 1, "top"),
            ("half", 2, "half"),
            ("block-20", 2, "rest"),
        ],
        tags: |place| place + 1,
    },
    Format {
        file: "plate.vtu",
        groups: &PARTS,
        tags: |place| place + 1,
    },
    Format {
        file: "plate.vtk",
        groups: &PARTS,
        tags: |place| place + 1,
    },
    Format {
        file: "plate.xdmf",
        groups: &PARTS,
        tags: |place| place + 1,
    },
];

/// The content that a group should have, by the mesh that the formats were made from.
fn wanted(original: &Mesh, group: &str, dimension: u8) -> Content {
    let whole = sorted_cells(original);
    let half = half(original);
    let of_cells = |cells: Vec<Vec<u32>>| {
        let mut nodes: Vec<u32> = cells.iter().flatten().copied().collect();
        nodes.sort_unstable();
        nodes.dedup();
        (String::new(), 2, nodes, Vec::new(), cells)
    };
    match (group, dimension) {
        ("half", _) => of_cells(half),
        ("rest", _) => of_cells(whole.into_iter().filter(|it| !half.contains(it)).collect()),
        ("left and right", _) => {
            let (mut left, right) = (content(original, "left", 1), content(original, "right", 1));
            left.2.extend(right.2);
            left.2.sort_unstable();
            left.3.extend(right.3);
            left.3.sort_unstable();
            left
        }
        (name, 0) => {
            let nodes = original.group(name).unwrap().nodes.clone();
            (String::new(), 0, nodes, Vec::new(), Vec::new())
        }
        (name, _) => content(original, name, dimension),
    }
}

/// Points to the last bit, cells and every group of every kind, in each format; and no other groups.
#[test]
#[ignore = "needs LIGAMENT_PYTHON; run by tools/test"]
fn groups_of_other_programs_are_kept() {
    let original = read(&repository().join("meshes/plate-coarse.msh"));
    let folder = fixtures("plate-coarse.msh");
    for Format { file, groups, tags } in FORMATS {
        let output = convert(folder.path(), file, "out.msh");
        assert_eq!(
            output.status.code(),
            Some(0),
            "{file}: {}",
            text(&output.stderr)
        );
        let mesh = read(&folder.path().join("out.msh"));
        assert_eq!(mesh.positions, original.positions, "{file}");
        assert_eq!(sorted_cells(&mesh), sorted_cells(&original), "{file}");
        let numbers: Vec<u64> = (0..mesh.positions.len() as u64).map(tags).collect();
        assert_eq!(*mesh.node_tags, numbers, "{file}");
        for &(name, dimension, group) in groups {
            let found = content(&mesh, name, dimension);
            assert!(
                found == wanted(&original, group, dimension),
                "{file}: {name}"
            );
        }
        let names: Vec<&str> = mesh.groups.iter().map(|it| it.name.as_str()).collect();
        assert_eq!(names.len(), groups.len(), "{file}: {names:?}");
        let said = text(&output.stdout);
        assert!(
            said.contains("out.msh\n  nodes         80\n"),
            "{file}: {said}"
        );
        assert!(mesh.remarks.is_empty(), "{file}: {:?}", mesh.remarks);
    }
}

/// A case on a mesh that went through Abaqus has the results of the original, digit for digit: nodes and cells have their order.
#[test]
#[ignore = "needs LIGAMENT_PYTHON; run by tools/test"]
fn a_case_gives_the_same_numbers_on_a_converted_mesh() {
    let folder = fixtures("plate.msh");
    let output = convert(folder.path(), "plate.inp", "converted.msh");
    assert_eq!(output.status.code(), Some(0), "{}", text(&output.stderr));
    let case = repository().join("cases/plate-tension/case.toml");
    let run = |name: &str, more: &[String]| {
        let out = folder.path().join(name);
        let arguments = [
            "run".as_ref(),
            case.as_os_str(),
            "--out".as_ref(),
            out.as_os_str(),
        ];
        let output = ligament(arguments.into_iter().chain(more.iter().map(OsStr::new)));
        assert_eq!(output.status.code(), Some(0), "{}", text(&output.stderr));
        ["history.csv", "fields_0001.vtu", "model.vtu"]
            .map(|file| fs::read(out.join(file)).unwrap())
    };
    let mesh = folder.path().join("converted.msh");
    let converted = run(
        "converted",
        &["--set".into(), format!("mesh.file={:?}", mesh)],
    );
    assert!(run("original", &[]) == converted);
}

/// A file without a planar mesh, or one that cannot be read, is refused, and an earlier mesh is kept.
#[test]
#[ignore = "needs LIGAMENT_PYTHON; run by tools/test"]
fn what_is_no_planar_mesh_is_refused() {
    let folder = fixtures("plate-coarse.msh");
    let earlier = folder.path().join("out.msh");
    fs::write(&earlier, "earlier").unwrap();
    for (file, expected) in [
        (
            "upright.vtu",
            "is not planar: z goes from 0 to 0.1; y is the same everywhere",
        ),
        (
            "lines.vtu",
            "there are no triangles, quadrangles or solid cells in",
        ),
        ("broken.vtu", "meshio could not read"),
        ("moved.inp", "an instance of a part that is moved"),
        ("two.inp", "several *NODE blocks"),
        (
            "set.inp",
            "a has the element 7, which the file does not have",
        ),
        ("unknown.xyz", "meshio does not know the format of"),
    ] {
        let output = convert(folder.path(), file, "out.msh");
        assert_eq!(output.status.code(), Some(1), "{file}");
        let said = text(&output.stderr);
        assert!(
            said.starts_with("error: ") && said.contains(expected),
            "{file}: {said}"
        );
        assert_eq!(fs::read_to_string(&earlier).unwrap(), "earlier", "{file}");
    }
    let gmsh = repository().join("meshes/plate.msh");
    let python = python();
    let words = [
        OsStr::new("mesh"),
        "--via-meshio".as_ref(),
        gmsh.as_os_str(),
    ];
    let output = ligament(
        words
            .into_iter()
            .chain(["--python".as_ref(), python.as_os_str()]),
    );
    assert!(text(&output.stderr).contains("is a Gmsh mesh: Ligament reads it as it is"));
}

/// What is left out or renamed is told.
#[test]
#[ignore = "needs LIGAMENT_PYTHON; run by tools/test"]
fn what_is_read_in_another_way_is_told() {
    let folder = fixtures("plate-coarse.msh");
    let output = convert(folder.path(), "second-order.vtu", "out.msh");
    let said = text(&output.stdout);
    for remark in [
        "note: 1 cell of higher order was read by the corner nodes alone",
        "have the name `side-1`: the curve is now `side-1-curve`",
        "note: 4 nodes that no corner of a triangle or quadrangle uses were dropped",
    ] {
        assert!(said.contains(remark), "{said}");
    }
    let mesh = read(&folder.path().join("out.msh"));
    let names: Vec<(&str, u8)> = (mesh.groups.iter())
        .map(|it| (it.name.as_str(), it.dimension))
        .collect();
    assert_eq!(names, [("side-1-curve", 1), ("side-1", 2)]);
}

/// A row of two cells of VTK of size 1 with corners in the order of images: x varies fastest, then y, then z.
fn image(cell_type: u8, depth: usize) -> String {
    let nodes = (0..depth).flat_map(|z| (0..2).flat_map(move |y| (0..3).map(move |x| [x, y, z])));
    let nodes: Vec<String> = nodes.map(|[x, y, z]| format!("{x} {y} {z}")).collect();
    let corners = |cell: usize| {
        (0..depth).flat_map(move |z| [0, 1, 3, 4].map(|it| (6 * z + cell + it).to_string()))
    };
    let corners: Vec<String> = (0..2).flat_map(corners).collect();
    let (n_nodes, n_corners) = (nodes.len(), 4 * depth);
    format!(
        "<VTKFile type=\"UnstructuredGrid\" version=\"0.1\" byte_order=\"LittleEndian\"><UnstructuredGrid>\
         <Piece NumberOfPoints=\"{n_nodes}\" NumberOfCells=\"2\">\
         <Points><DataArray type=\"Float64\" NumberOfComponents=\"3\" format=\"ascii\">\n{}\n</DataArray></Points><Cells>\
         <DataArray type=\"Int64\" Name=\"connectivity\" format=\"ascii\">\n{}\n</DataArray>\
         <DataArray type=\"Int64\" Name=\"offsets\" format=\"ascii\">\n{n_corners} {}\n</DataArray>\
         <DataArray type=\"UInt8\" Name=\"types\" format=\"ascii\">\n{cell_type} {cell_type}\n</DataArray>\
         </Cells></Piece></UnstructuredGrid></VTKFile>",
        nodes.join("\n"),
        corners.join(" "),
        2 * n_corners
    )
}

/// Cells of images are quadrangles and hexahedra whose corners have another order: two squares and two cubes of size 1.
#[test]
#[ignore = "needs LIGAMENT_PYTHON; run by tools/test"]
fn pixels_and_voxels_are_quadrangles_and_hexahedra() {
    let folder = tempfile::tempdir().unwrap();
    for (file, text, size) in [
        ("pixels.vtu", image(8, 1), "area          2.000 m^2"),
        ("voxels.vtu", image(11, 2), "volume        2.000 m^3"),
    ] {
        fs::write(folder.path().join(file), text).unwrap();
        let output = convert(folder.path(), file, "out.msh");
        let said = crate::support::text(&output.stdout);
        assert!(
            said.contains(size),
            "{said}{}",
            crate::support::text(&output.stderr)
        );
        assert!(said.contains("cells         2"), "{said}");
    }
}

#[test]
fn without_python_it_says_where_to_get_it() {
    let folder = tempfile::tempdir().unwrap();
    let source = folder.path().join("plate.inp");
    fs::write(&source, "*NODE\n").unwrap();
    let nowhere = folder.path().join("no-python");
    let words = [
        OsStr::new("mesh"),
        "--via-meshio".as_ref(),
        source.as_os_str(),
    ];
    let output = ligament(
        words
            .into_iter()
            .chain(["--python".as_ref(), nowhere.as_os_str()]),
    );
    assert_eq!(output.status.code(), Some(1));
    let said = text(&output.stderr);
    assert!(
        said.contains("cannot find the program") && said.contains("--python PATH"),
        "{said}"
    );
    let output = ligament(["mesh", "--via-meshio", "nowhere/plate.inp"]);
    assert_eq!(
        text(&output.stderr),
        "error: there is no mesh nowhere/plate.inp\n"
    );
}

/// A script in place of Python that says what the real script would, or nothing.
#[test]
#[cfg(unix)]
fn what_python_says_is_passed_on() {
    use std::os::unix::fs::PermissionsExt;
    let folder = tempfile::tempdir().unwrap();
    let source = folder.path().join("plate.inp");
    fs::write(&source, "*NODE\n").unwrap();
    let python = folder.path().join("python");
    for (script, expected) in [
        (
            "printf 'error\\nno-package\\nmeshio\\n'; exit 1",
            "-m pip install meshio\n",
        ),
        (
            "printf 'error\\nno-package\\nh5py\\n'; exit 1",
            "-m pip install meshio h5py\n",
        ),
        (
            "echo 'Segmentation fault' >&2; exit 3",
            "plate.inp\n  Segmentation fault\n",
        ),
        ("exit 0", "it said nothing (exit status: 0)\n"),
        (
            "printf 'remarks 0\\nnodes 3\\n1 0 0\\n'",
            "it said nothing (exit status: 0)\n",
        ),
    ] {
        fs::write(&python, format!("#!/bin/sh\n{script}\n")).unwrap();
        fs::set_permissions(&python, fs::Permissions::from_mode(0o755)).unwrap();
        let words = [
            OsStr::new("mesh"),
            "--via-meshio".as_ref(),
            source.as_os_str(),
        ];
        let output = ligament(
            words
                .into_iter()
                .chain(["--python".as_ref(), python.as_os_str()]),
        );
        assert_eq!(output.status.code(), Some(1), "{script}");
        let said = text(&output.stderr);
        assert!(said.ends_with(expected), "{script}: {said}");
        assert!(!folder.path().join("plate.msh").exists());
    }
}

/// A plate that stands in the plane of x and z, by its plane and with a factor that is exact.
#[test]
#[ignore = "needs LIGAMENT_PYTHON; run by tools/test"]
fn a_standing_mesh_is_turned_and_scaled() {
    let folder = fixtures("plate-coarse.msh");
    let (source, out, python) = (
        folder.path().join("upright.vtu"),
        folder.path().join("out.msh"),
        python(),
    );
    let mut words = ["mesh", "--plane", "xz", "--scale", "0.5", "--via-meshio"]
        .map(OsStr::new)
        .to_vec();
    words.extend([
        source.as_os_str(),
        "--python".as_ref(),
        python.as_os_str(),
        "--out".as_ref(),
        out.as_os_str(),
    ]);
    let output = ligament(words);
    assert!(output.status.success(), "{}", text(&output.stderr));
    let original = read(&repository().join("meshes/plate-coarse.msh"));
    let halves = original
        .positions
        .iter()
        .map(|it| it.map(|coordinate| 0.5 * coordinate));
    assert_eq!(read(&out).positions, halves.collect::<Vec<_>>());
}

#[test]
fn a_mesh_is_no_geometry() {
    let folder = tempfile::tempdir().unwrap();
    let source = folder.path().join("plate.med");
    fs::write(&source, "*NODE\n").unwrap();
    let output = ligament([OsStr::new("mesh"), source.as_os_str()]);
    assert_eq!(output.status.code(), Some(1));
    let said = text(&output.stderr);
    assert!(
        said.contains("is no .geo file") && said.contains("--via-meshio"),
        "{said}"
    );
    assert_eq!(ligament(["mesh"]).status.code(), Some(2));
}

/// The mesh of an input deck is read without Python: sets and surfaces are groups, and what a mesh does not have is named with its line.
#[test]
fn a_deck_needs_no_python() {
    let folder = tempfile::tempdir().unwrap();
    let deck = "*HEADING\nplate\n*NODE, NSET=all\n1, 0, 0\n2, 2, 0\n3, 2, 1\n4, 0, 1\n*ELEMENT, TYPE=CPS4, ELSET=plate\n1, 1, 2, 3, 4\n\
        *SURFACE, NAME=right\n1, S2\n*MATERIAL, NAME=steel\n*ELASTIC\n2.1D11, .3\n";
    let source = folder.path().join("plate.inp");
    fs::write(&source, deck).unwrap();
    let output = ligament([OsStr::new("mesh"), source.as_os_str()]);
    let said = text(&output.stdout) + &text(&output.stderr);
    assert!(output.status.success(), "{said}");
    for words in ["*ELASTIC (line 13)", "plane = \"stress\"", "right", "plate"] {
        assert!(said.contains(words), "{words}: {said}");
    }
    let mesh = gmsh::parse(&fs::read(folder.path().join("plate.msh")).unwrap()).unwrap();
    assert_eq!((mesh.cells.len(), mesh.area()), (1, 2.0));
    assert_eq!(mesh.group("right").unwrap().edges.len(), 1);
    let again = ligament([OsStr::new("mesh"), source.as_os_str()]);
    assert!(!again.status.success(), "an existing mesh is not replaced");
}
