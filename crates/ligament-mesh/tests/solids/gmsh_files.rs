//! Files written by Gmsh and meshio, compared with the reports of Gmsh on them (`tests/solid_data/README.md`).

use std::fs;
use std::path::Path;

use ligament_mesh::gmsh::{self, GmshError};
use ligament_mesh::{AnyMesh, Faces, Group, Remark, SolidCell, SolidMesh};

fn text(name: &str) -> Vec<u8> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/solid_data");
    fs::read(folder.join(name)).unwrap()
}

fn read(name: &str) -> SolidMesh {
    match gmsh::parse_any(&text(name)) {
        Ok(AnyMesh::Solid(mesh)) => mesh,
        other => panic!("{name}: {other:?}"),
    }
}

/// Numbers and measures that another program computed agree to rounding of sums of some hundred terms.
fn assert_near(found: f64, expected: &str, what: &str) {
    let expected: f64 = expected.parse().unwrap();
    let error = (found - expected).abs();
    assert!(
        error < 1e-12 * expected.abs().max(1.0),
        "{what}: {found}, not {expected}"
    );
}

/// Number and measure of the elements of a group.
fn elements(mesh: &SolidMesh, group: &Group) -> (usize, f64) {
    let length = |edge: &[u32; 2]| {
        let [a, b] = edge.map(|node| mesh.positions[node as usize]);
        (0..3)
            .map(|axis| (b[axis] - a[axis]).powi(2))
            .sum::<f64>()
            .sqrt()
    };
    let volume = |cell: &u32| mesh.cells[*cell as usize].volume(&mesh.positions);
    match group.dimension {
        0 => (group.nodes.len(), group.nodes.len() as f64),
        1 => (group.edges.len(), group.edges.iter().map(length).sum()),
        2 => {
            let areas = group
                .faces
                .iter()
                .map(|face| face.area_vector(&mesh.positions));
            let areas = areas.map(|it| it.iter().map(|x| x * x).sum::<f64>().sqrt());
            (group.faces.len(), areas.sum())
        }
        _ => (group.cells.len(), group.cells.iter().map(volume).sum()),
    }
}

#[test]
fn every_file_holds_what_gmsh_says() {
    let expected = String::from_utf8(text("expected.tsv")).unwrap();
    let mut meshes: Vec<(SolidMesh, Vec<Vec<String>>)> = Vec::new();
    for line in expected.lines() {
        let fields: Vec<String> = line.split('\t').map(str::to_owned).collect();
        if fields[0] == "group" {
            meshes.last_mut().unwrap().1.push(fields);
            continue;
        }
        let mesh = read(&fields[1]);
        let name = &fields[1];
        assert_eq!(mesh.positions.len().to_string(), fields[2], "{name}: nodes");
        let tags = mesh.node_tags.iter().sum::<u64>();
        assert_eq!(tags.to_string(), fields[3], "{name}: tags");
        for axis in 0..3 {
            assert_near(
                mesh.positions.iter().map(|p| p[axis]).sum(),
                &fields[4 + axis],
                name,
            );
        }
        let is_of = [
            |cell: &&SolidCell| matches!(cell, SolidCell::Tetrahedron(_)),
            |cell: &&SolidCell| matches!(cell, SolidCell::Hexahedron(_)),
            |cell: &&SolidCell| matches!(cell, SolidCell::Prism(_)),
            |cell: &&SolidCell| matches!(cell, SolidCell::Pyramid(_)),
        ];
        let counts = is_of.map(|shape| mesh.cells.iter().filter(shape).count().to_string());
        assert_eq!(counts.as_slice(), &fields[7..11], "{name}");
        assert_near(mesh.volume(), &fields[11], name);
        meshes.push((mesh, Vec::new()));
    }
    assert_eq!(meshes.len(), 12);
    for (mesh, groups) in &meshes {
        assert_eq!(mesh.groups.len(), groups.len());
        for (group, fields) in mesh.groups.iter().zip(groups) {
            let what = &group.name;
            assert_eq!(group.dimension.to_string(), fields[1], "{what}");
            assert_eq!(group.number.to_string(), fields[2], "{what}");
            assert_eq!(&group.name, &fields[3]);
            assert_eq!(group.nodes.len().to_string(), fields[4], "{what}");
            let tags = group
                .nodes
                .iter()
                .map(|node| mesh.node_tags[*node as usize]);
            assert_eq!(tags.sum::<u64>().to_string(), fields[5], "{what}");
            let (count, measure) = elements(mesh, group);
            assert_eq!(count.to_string(), fields[6], "{what}");
            assert_near(measure, &fields[7], what);
        }
    }
}

/// Every cell has a positive volume, its tetrahedra fill it, and neighbours share whole faces: the outer faces close the body.
#[test]
fn cells_fill_the_body() {
    for name in [
        "tetrahedra-41.msh",
        "hexahedra-22.msh",
        "prisms-22.msh",
        "pyramids-41.msh",
    ] {
        let mesh = read(name);
        for cell in &mesh.cells {
            let parts = cell
                .tetrahedra()
                .map(|it| SolidCell::Tetrahedron(it).volume(&mesh.positions));
            let parts: Vec<f64> = parts.collect();
            assert!(parts.iter().all(|part| *part > 0.0), "{name}: {cell:?}");
            let difference = parts.iter().sum::<f64>() - cell.volume(&mesh.positions);
            assert!(difference.abs() < 1e-15, "{name}: {cell:?}");
        }
        let faces = Faces::new(&mesh.cells, mesh.positions.len());
        // The divergence theorem with x/3: the volume from the outline alone.
        let of_face = |corners: [u32; 3]| {
            let [a, b, c] = corners.map(|node| mesh.positions[node as usize]);
            let normal = [
                a[1] * (b[2] - c[2]),
                b[1] * (c[2] - a[2]),
                c[1] * (a[2] - b[2]),
            ];
            normal.iter().sum::<f64>() * (a[0] + b[0] + c[0]) / 6.0
        };
        let outer = faces.outer();
        let volume: f64 = outer
            .iter()
            .flat_map(|side| side.face.triangles())
            .map(of_face)
            .sum();
        assert!(
            (volume - mesh.volume()).abs() < 1e-12,
            "{name}: {volume} {}",
            mesh.volume()
        );
    }
}

#[test]
fn encodings_and_versions_of_one_model_give_one_mesh() {
    let reference = read("tetrahedra-41-binary.msh");
    for variant in ["22", "22-binary", "41"] {
        let mesh = read(&format!("tetrahedra-{variant}.msh"));
        assert_eq!(mesh.node_tags, reference.node_tags, "{variant}");
        let groups = |mesh: &SolidMesh| -> Vec<_> {
            let groups = mesh.groups.iter();
            groups
                .map(|it| (it.name.clone(), it.nodes.clone(), it.faces.clone()))
                .collect()
        };
        assert_eq!(groups(&mesh), groups(&reference), "{variant}");
        // Text holds 16 digits.
        for (p, q) in mesh.positions.iter().zip(&reference.positions) {
            assert!(
                (0..3).all(|axis| (p[axis] - q[axis]).abs() < 1e-15),
                "{variant}"
            );
        }
    }
}

#[test]
fn cells_of_second_order_are_read_by_their_corners() {
    let linear = read("tetrahedra-41.msh");
    let mesh = read("tetrahedra-10-node-41.msh");
    assert_eq!(mesh.cells.len(), linear.cells.len());
    let nodes = match mesh.remarks.as_slice() {
        [Remark::HigherOrderCells { cells: 196, nodes }] => *nodes,
        other => panic!("{other:?}"),
    };
    assert_eq!(nodes, mesh.edges().len(), "a node on each edge");
}

/// meshio keeps one group an element, but all cells.
#[test]
fn a_file_by_meshio_holds_the_same_cells() {
    let mesh = read("meshio-pyramids-22.msh");
    let original = read("pyramids-41.msh");
    assert_eq!(mesh.positions.len(), original.positions.len());
    assert_eq!(mesh.cells.len(), original.cells.len());
    assert!((mesh.volume() - original.volume()).abs() < 1e-14);
    assert!(mesh.group("left").is_some());
}

#[test]
fn a_skin_without_its_volume_is_refused() {
    let error = gmsh::parse_any(&text("refused-skin.msh")).unwrap_err();
    assert!(matches!(error, GmshError::NotPlanar { .. }), "{error}");
    assert!(error.to_string().contains("gmsh -3"), "{error}");
}

#[test]
fn a_solid_is_no_planar_mesh() {
    for name in ["tetrahedra-22.msh", "prisms-41-binary.msh"] {
        let error = gmsh::parse(&text(name)).unwrap_err();
        assert!(matches!(error, GmshError::VolumeElement { .. }), "{error}");
    }
}

#[test]
fn what_is_written_is_read_back() {
    for name in [
        "tetrahedra-41.msh",
        "hexahedra-22.msh",
        "prisms-22.msh",
        "pyramids-41.msh",
    ] {
        let mesh = read(name);
        let written = gmsh::write(&mesh);
        let expected = AnyMesh::Solid(SolidMesh {
            remarks: Vec::new(),
            fields: Vec::new(),
            ..mesh
        });
        assert_eq!(gmsh::parse_any(written.as_bytes()), Ok(expected), "{name}");
    }
}
