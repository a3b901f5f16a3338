//! A small file, changed in one thing: orientations and groups.

use ligament_mesh::gmsh::parse_any;
use ligament_mesh::{AnyMesh, Cell, Remark, SolidCell, SolidMesh};

/// A cube as a hexahedron with a pyramid on its top, in format 2.2; its nodes are lines 6 to 14, its elements 18 to 23.
pub(crate) const CHAPEL: &str = "$MeshFormat
2.2 0 8
$EndMeshFormat
$Nodes
9
1 0 0 0
2 1 0 0
3 1 1 0
4 0 1 0
5 0 0 1
6 1 0 1
7 1 1 1
8 0 1 1
9 0.5 0.5 2
$EndNodes
$Elements
6
1 15 2 1 1 9
2 1 2 2 1 1 2
3 3 2 3 1 1 2 3 4
4 2 2 4 1 5 6 9
5 5 2 5 1 1 2 3 4 5 6 7 8
6 7 2 6 1 5 6 7 8 9
$EndElements
";

pub(crate) fn solid(text: &str) -> SolidMesh {
    match parse_any(text.as_bytes()) {
        Ok(AnyMesh::Solid(mesh)) => mesh,
        other => panic!("{other:?}"),
    }
}

/// The chapel with a part of the file replaced.
pub(crate) fn changed(old: &str, new: &str) -> String {
    assert_eq!(
        CHAPEL.matches(old).count(),
        1,
        "{old:?} must stand once in the file"
    );
    CHAPEL.replace(old, new)
}

#[test]
fn groups_of_all_dimensions_are_read() {
    let mesh = solid(CHAPEL);
    assert!((mesh.volume() - 4.0 / 3.0).abs() < 1e-15);
    let dimensions: Vec<u8> = mesh.groups.iter().map(|group| group.dimension).collect();
    assert_eq!(dimensions, [0, 1, 2, 2, 3, 3]);
    assert_eq!(mesh.group("1").unwrap().nodes, [8]);
    assert_eq!(mesh.group("2").unwrap().edges, [[0, 1]]);
    assert_eq!(
        mesh.group("3").unwrap().faces,
        [Cell::Quadrangle([0, 1, 2, 3])]
    );
    assert_eq!(mesh.group("3").unwrap().nodes, [0, 1, 2, 3]);
    assert_eq!(mesh.group("4").unwrap().faces, [Cell::Triangle([4, 5, 8])]);
    assert_eq!(
        (
            &mesh.group("5").unwrap().cells,
            &mesh.group("6").unwrap().cells
        ),
        (&vec![0], &vec![1])
    );
    assert_eq!(mesh.remarks, []);
}

#[test]
fn cells_inside_out_are_turned_round() {
    let expected = solid(CHAPEL);
    for (old, new) in [
        ("5 1 1 2 3 4 5 6 7 8", "5 1 1 4 3 2 5 8 7 6"),
        ("6 1 5 6 7 8 9", "6 1 5 8 7 6 9"),
    ] {
        let mesh = solid(&changed(old, new));
        assert!(
            mesh.cells
                .iter()
                .all(|cell| cell.volume(&mesh.positions) > 0.0)
        );
        assert!((mesh.volume() - expected.volume()).abs() < 1e-15);
    }
    for (row, name) in [
        ("6 4 2 6 1 5 6 7 9", "tetrahedron"),
        ("6 4 2 6 1 5 7 6 9", "tetrahedron"),
    ] {
        let mesh = solid(&changed("6 7 2 6 1 5 6 7 8 9", row));
        let volume = mesh.cells[1].volume(&mesh.positions);
        assert!((volume - 1.0 / 6.0).abs() < 1e-15, "{row}");
        assert_eq!(mesh.cells[1].shape_name(), name);
    }
    for row in ["5 6 2 5 1 1 2 3 5 6 7", "5 6 2 5 1 5 6 7 1 2 3"] {
        let text = changed("5 5 2 5 1 1 2 3 4 5 6 7 8", row)
            .replace("3 3 2 3 1 1 2 3 4", "3 3 2 3 1 1 2 6 5");
        let mesh = solid(&text);
        assert_eq!(mesh.cells[0].volume(&mesh.positions), 0.5, "{row}");
    }
}

/// In format 2.2 a cell or face occurs in the file once for each of its groups.
#[test]
fn what_stands_twice_in_other_groups_is_one() {
    let twice = "6 7 2 6 1 5 6 7 8 9\n7 7 2 5 1 6 7 8 5 9\n8 3 2 3 1 3 4 1 2\n";
    let mesh =
        solid(&changed("6 7 2 6 1 5 6 7 8 9\n", twice).replace("$Elements\n6", "$Elements\n8"));
    assert_eq!(mesh.cells.len(), 2);
    assert_eq!(mesh.group("5").unwrap().cells, [0, 1]);
    assert_eq!(mesh.group("6").unwrap().cells, [1]);
    assert_eq!(
        mesh.group("3").unwrap().faces,
        [Cell::Quadrangle([0, 1, 2, 3])]
    );
}

#[test]
fn nodes_of_no_cell_are_dropped_from_the_groups_too() {
    let text = changed("$Nodes\n9", "$Nodes\n11\n20 7 7 7\n21 8 7 7")
        .replace("1 15 2 1 1 9", "1 15 2 1 1 20")
        .replace("2 1 2 2 1 1 2", "2 1 2 2 1 1 20");
    let mesh = solid(&text);
    assert_eq!(mesh.positions.len(), 9);
    assert_eq!(mesh.group("2").unwrap().nodes, [0]);
    assert!(mesh.group("2").unwrap().edges.is_empty());
    let name = "1".to_owned();
    assert_eq!(
        mesh.remarks,
        [
            Remark::UnusedNodes { nodes: 2 },
            Remark::EmptyGroup { name, dimension: 0 }
        ]
    );
}

/// A surface without a group is allowed: nothing refers to it.
#[test]
fn a_loose_face_without_a_group_does_no_harm() {
    let mesh = solid(&changed("3 3 2 3 1 1 2 3 4", "3 3 2 0 1 1 3 5 7"));
    assert!(mesh.group("3").is_none() && mesh.cells.len() == 2);
}

#[test]
fn surfaces_inside_of_the_body_are_faces_too() {
    let mesh = solid(&changed("3 3 2 3 1 1 2 3 4", "3 3 2 3 1 5 6 7 8"));
    assert_eq!(
        mesh.group("3").unwrap().faces,
        [Cell::Quadrangle([4, 5, 6, 7])]
    );
    assert_eq!(
        mesh.cells[0],
        SolidCell::Hexahedron([0, 1, 2, 3, 4, 5, 6, 7])
    );
}

/// The pyramid, written as a hexahedron with one node at four corners, and a face of it as a quadrangle with a repeated corner.
#[test]
fn cells_with_repeated_corners_are_cells_with_fewer() {
    let text = changed("6 7 2 6 1 5 6 7 8 9", "6 5 2 6 1 5 6 7 8 9 9 9 9");
    let text = text.replace("4 2 2 4 1 5 6 9", "4 3 2 4 1 5 6 9 9");
    let mut mesh = solid(&text);
    let remark = mesh.remarks.remove(0);
    assert_eq!(remark, Remark::CollapsedCells { cells: 1 });
    let expected = solid(CHAPEL);
    assert_eq!(mesh.groups, expected.groups);
    assert_eq!(mesh.cells[1].shape_name(), "pyramid");
    assert_eq!(mesh.volume(), expected.volume());
}
