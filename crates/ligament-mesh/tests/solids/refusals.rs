//! One file for each refusal of what is no solid mesh, with the place it is refused at.

use super::small_files::{CHAPEL, changed};
use ligament_mesh::gmsh::{CoordinatePlane, FilePosition, GmshError, parse_any, parse_any_with};
use ligament_mesh::{AnyMesh, Remark};

fn refusal(old: &str, new: &str) -> GmshError {
    parse_any(changed(old, new).as_bytes()).unwrap_err()
}

#[test]
fn flat_cells_are_refused() {
    for height in [1.0, 1.0 + 1e-9] {
        let error = refusal("9 0.5 0.5 2", &format!("9 0.5 0.5 {height}"));
        let GmshError::FlatCell {
            place,
            element: 6,
            shape: "pyramid",
            fraction,
            ..
        } = error
        else {
            panic!("{error}")
        };
        assert_eq!(place, FilePosition::Line(23));
        assert!(
            (fraction - (height - 1.0) / 3.0).abs() < 1e-15,
            "{fraction}"
        );
    }
    assert!(parse_any(changed("9 0.5 0.5 2", "9 0.5 0.5 1.00001").as_bytes()).is_ok());
    let sliver = changed("6 7 2 6 1 5 6 7 8 9", "6 4 2 6 1 5 6 7 9")
        .replace("9 0.5 0.5 2", "9 0.2 0.7 1.00000001");
    let error = parse_any(sliver.as_bytes()).unwrap_err();
    assert!(
        matches!(
            error,
            GmshError::FlatCell {
                element: 6,
                shape: "tetrahedron",
                ..
            }
        ),
        "{error}"
    );
    assert!(
        error.to_string().contains("line 23") && error.to_string().contains("5.9e-10"),
        "{error}"
    );
}

#[test]
fn cells_that_are_not_convex_are_refused() {
    let expected = |line, element, shape| GmshError::NotConvexSolid {
        place: FilePosition::Line(line),
        element,
        shape,
    };
    // The upper corner pushed through the cell, and the top rotated by half a turn.
    assert_eq!(
        refusal("7 1 1 1\n", "7 0.2 0.2 0.2\n"),
        expected(22, 5, "hexahedron")
    );
    assert_eq!(
        refusal("5 1 1 2 3 4 5 6 7 8", "5 1 1 2 3 4 7 8 5 6"),
        expected(22, 5, "hexahedron")
    );
    assert_eq!(
        refusal("6 1 5 6 7 8 9", "6 1 5 7 6 8 9"),
        expected(23, 6, "pyramid")
    );
}

#[test]
fn a_corner_that_stands_twice_is_refused() {
    let error = refusal("5 1 1 2 3 4 5 6 7 8", "5 1 1 2 3 4 5 6 7 7");
    let expected = GmshError::RepeatedCorner {
        place: FilePosition::Line(22),
        element: 5,
        node: 7,
    };
    assert_eq!(error, expected);
}

#[test]
fn cells_twice_or_over_each_other_are_refused() {
    let add = |row: &str| {
        let text = changed(
            "6 7 2 6 1 5 6 7 8 9\n",
            &format!("6 7 2 6 1 5 6 7 8 9\n{row}\n"),
        );
        parse_any(text.replace("$Elements\n6", "$Elements\n7").as_bytes()).unwrap_err()
    };
    let place = FilePosition::Line(24);
    let duplicate = GmshError::DuplicateCell {
        place,
        element: 7,
        other: 6,
    };
    assert_eq!(add("7 7 2 6 1 6 7 8 5 9"), duplicate);
    let overlap = GmshError::OverlappingSolids {
        place,
        element: 7,
        other: 6,
    };
    assert_eq!(add("7 4 2 6 1 5 6 9 8"), overlap);
}

/// Eight cubes, and on the corners of all of them a ninth: no face in common.
#[test]
fn coarse_solids_over_fine_ones_are_refused() {
    let file = |with_coarse: bool| {
        let mut text = "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n27\n".to_owned();
        for node in 0..27 {
            text += &format!("{} {} {} {}\n", node + 1, node % 3, node / 3 % 3, node / 9);
        }
        let cube = |corner: u32, side: u32| {
            let base = [0, side, 4 * side, 3 * side].map(|it| corner + it);
            let corners = base.into_iter().chain(base.map(|it| it + 9 * side));
            corners
                .map(|it| it.to_string())
                .collect::<Vec<_>>()
                .join(" ")
        };
        let mut cells: Vec<String> = [1, 2, 4, 5, 10, 11, 13, 14].map(|it| cube(it, 1)).to_vec();
        cells.extend(with_coarse.then(|| cube(1, 2)));
        text += &format!("$EndNodes\n$Elements\n{}\n", cells.len());
        for (number, cell) in (1..).zip(&cells) {
            text += &format!("{number} 5 2 1 1 {cell}\n");
        }
        text + "$EndElements\n"
    };
    assert!(parse_any(file(false).as_bytes()).is_ok());
    let error = parse_any(file(true).as_bytes()).unwrap_err();
    let GmshError::CoveringCells { other, .. } = error else {
        panic!("{error}")
    };
    let expected = GmshError::CoveringCells {
        place: FilePosition::Line(44),
        element: 9,
        other,
        other_place: FilePosition::Line(35 + other as usize),
    };
    assert_eq!(error, expected);
}

#[test]
fn nodes_at_one_place_are_refused() {
    let near =
        changed("6 1 5 6 7 8 9", "6 1 5 6 7 8 9").replace("9 0.5 0.5 2", "9 1 1 1.0000000000001");
    let expected = GmshError::CoincidentNodesInSpace {
        place: FilePosition::Line(14),
        tag: 9,
        other: 7,
        position: [1.0, 1.0, 1.000_000_000_000_1],
    };
    assert_eq!(parse_any(near.as_bytes()), Err(expected));
}

/// A shell in a group beside the solid, or a surface whose faces belong to another mesh.
#[test]
fn faces_of_no_cell_are_refused() {
    let shell = changed("$Nodes\n9", "$Nodes\n11\n20 7 7 7\n21 8 7 7")
        .replace("3 1 1 2 3 4", "3 1 1 2 21 20");
    for text in [shell, changed("3 3 2 3 1 1 2 3 4", "3 2 2 3 1 1 2 3")] {
        let expected = |line| GmshError::LooseFace {
            place: FilePosition::Line(line),
            element: 3,
            group: "3".to_owned(),
        };
        let error = parse_any(text.as_bytes()).unwrap_err();
        assert!(error == expected(20) || error == expected(22), "{error}");
    }
}

#[test]
fn a_file_without_cells_is_refused() {
    let begin = CHAPEL.find("3 3 2 3").unwrap();
    let text =
        format!("{}$EndElements\n", &CHAPEL[..begin]).replace("$Elements\n6", "$Elements\n2");
    assert_eq!(parse_any(text.as_bytes()), Err(GmshError::NoCells));
}

/// A solid is in no plane, and is not turned.
#[test]
fn a_plane_for_a_solid_is_refused() {
    let plane = CoordinatePlane::Yz;
    let expected = GmshError::SolidInPlane {
        place: FilePosition::Line(22),
        plane: CoordinatePlane::Yz,
    };
    assert_eq!(parse_any_with(CHAPEL.as_bytes(), plane), Err(expected));
}

/// The pyramid with its own nodes at the top of the cube.
#[test]
fn a_seam_is_refused_and_a_crack_is_read() {
    let doubled = "9 0.5 0.5 2\n15 0 0 1\n16 1 0 1\n17 1 1 1\n18 0 1 1\n";
    let text = changed("9 0.5 0.5 2\n", doubled)
        .replace("$Nodes\n9", "$Nodes\n13")
        .replace("6 1 5 6 7 8 9", "6 1 15 16 17 18 9")
        .replace("4 1 5 6 9", "4 1 15 16 9");
    let error = parse_any(text.as_bytes()).unwrap_err();
    let expected = GmshError::Seam {
        place: FilePosition::Line(15),
        tag: 15,
        other: 5,
        faces: 1,
    };
    assert_eq!(error, expected);
    // The crack ends at the edge of nodes 5 and 6.
    let text = text
        .replace("6 1 15 16 17 18 9", "6 1 5 6 17 18 9")
        .replace("4 1 15 16 9", "4 1 5 6 9");
    let Ok(AnyMesh::Solid(mesh)) = parse_any(text.as_bytes()) else {
        panic!("a solid mesh");
    };
    let unused = Remark::UnusedNodes { nodes: 2 };
    assert_eq!(mesh.remarks, [unused, Remark::Crack { faces: 1 }]);
    let [[below, above]] = mesh.crack_faces()[..] else {
        panic!("one pair of faces");
    };
    assert_eq!(below.corners(), [4, 5, 6, 7]);
    assert_eq!(above.corners(), [4, 5, 9, 10]);
}
