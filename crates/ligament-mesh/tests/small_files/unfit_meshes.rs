//! One file for each refusal of what is no planar mesh, with the place it is refused at.

use super::square::{SQUARE, SQUARE_41, golden, refusal, refusal_of};
use ligament_mesh::gmsh::{FilePosition, GmshError, parse};

#[test]
fn unknown_and_volume_elements_are_refused() {
    let place = FilePosition::Line(14);
    for code in [0, -1, 34, 141] {
        let error = refusal("2 2 2 2 1 1 2 3", &format!("2 {code} 2 2 1 1 2 3"));
        assert_eq!(error, GmshError::UnknownElementType { place, code });
    }
    let error = refusal("2 2 2 2 1 1 2 3", "2 4 2 2 1 1 2 3 4");
    assert_eq!(error, GmshError::VolumeElement { place, code: 4 });
    let (bytes, _) = golden("refused-volume.msh", "$");
    assert!(matches!(
        parse(&bytes),
        Err(GmshError::VolumeElement { code: 4, .. })
    ));
}

#[test]
fn coordinates_that_are_no_numbers_are_refused() {
    let place = FilePosition::Line(8);
    for (word, value) in [
        ("inf", f64::INFINITY),
        ("-1e400", f64::NEG_INFINITY),
        ("1e200", 1e200),
    ] {
        let error = refusal("3 1 1 0\n", &format!("3 1 {word} 0\n"));
        assert_eq!(
            error,
            GmshError::BadCoordinate {
                place,
                tag: 3,
                value
            }
        );
    }
    let error = refusal("3 1 1 0\n", "3 nan 1 0\n");
    assert!(matches!(error, GmshError::BadCoordinate { tag: 3, value, .. } if value.is_nan()));
}

#[test]
fn duplicate_node_tags_are_refused() {
    let error = refusal("4 0 1 0", "2 0 1 0");
    let (place, first) = (FilePosition::Line(9), FilePosition::Line(7));
    assert_eq!(
        error,
        GmshError::DuplicateNodeTag {
            place,
            tag: 2,
            first
        }
    );
}

/// Tags far apart are looked up in another way than the usual ones.
#[test]
fn tags_far_apart_are_read_and_refused_alike() {
    let far = |text: &str| text.replace("4 0 1 0", "2000000000 0 1 0");
    let apart = far(SQUARE).replace("3 2 2 2 1 1 3 4", "3 2 2 2 1 1 3 2000000000");
    let mesh = parse(apart.as_bytes()).expect("a square");
    assert_eq!(*mesh.node_tags, [1, 2, 3, 2_000_000_000]);
    let usual = parse(SQUARE.as_bytes()).expect("a square");
    assert_eq!((mesh.positions, mesh.cells), (usual.positions, usual.cells));
    assert_eq!(
        parse(far(SQUARE).as_bytes()),
        Err(GmshError::MissingNode {
            place: FilePosition::Line(15),
            element: 3,
            node: 4,
        })
    );
    let twice = apart.replace("3 1 1 0", "2000000000 1 1 0");
    assert_eq!(
        parse(twice.as_bytes()),
        Err(GmshError::DuplicateNodeTag {
            place: FilePosition::Line(9),
            tag: 2_000_000_000,
            first: FilePosition::Line(8),
        })
    );
}

#[test]
fn missing_nodes_are_refused() {
    let missing = |line, element| GmshError::MissingNode {
        place: FilePosition::Line(line),
        element,
        node: 9,
    };
    assert_eq!(
        refusal("3 2 2 2 1 1 3 4", "3 2 2 2 1 1 3 9"),
        missing(15, 3)
    );
    assert_eq!(refusal("1 1 2 1 1 1 2", "1 1 2 1 1 1 9"), missing(13, 1));
    // A node on a side of a cell of second order.
    assert_eq!(
        refusal("2 2 2 2 1 1 2 3", "2 9 2 2 1 1 2 3 4 4 9"),
        missing(14, 2)
    );
    assert_eq!(refusal_of(SQUARE_41, "3 1 3 4", "3 1 3 9"), missing(22, 3));
}

#[test]
fn meshes_without_cells_are_refused() {
    let points = "1 15 2 1 1 1\n2 15 2 1 1 2\n3 15 2 1 1 3\n";
    let begin = SQUARE.find("1 1 2 1 1 1 2").unwrap();
    let text = format!("{}{points}$EndElements\n", &SQUARE[..begin]);
    assert_eq!(parse(text.as_bytes()), Err(GmshError::NoCells));
}

#[test]
fn meshes_out_of_one_plane_are_refused() {
    let error = refusal("3 1 1 0\n", "3 1 1 1e-6\n");
    let place = FilePosition::Line(8);
    assert_eq!(
        error,
        GmshError::NotPlanar {
            place,
            tag: 3,
            z: 1e-6,
            plane: 0.0
        }
    );
    let text = SQUARE.replace("3 1 1 0\n", "3 1 1 1e-10\n");
    assert!(parse(text.as_bytes()).is_ok(), "heights within rounding");
    // The longer side of the mesh counts.
    let text = SQUARE
        .replace("3 1 1 0\n", "3 1 1000 1e-7\n")
        .replace("4 0 1 0\n", "4 0 1000 0\n");
    assert!(
        parse(text.as_bytes()).is_ok(),
        "heights within rounding of a tall mesh"
    );
    // A node off the plane that no cell uses.
    let text = SQUARE.replace("$Nodes\n4", "$Nodes\n5\n9 0 0 7");
    assert!(parse(text.as_bytes()).is_ok(), "unused node");
}

#[test]
fn nodes_at_one_place_are_refused() {
    let place = FilePosition::Line(9);
    for (x, y) in [
        (1.0, 1.0),
        (1.0 - 4e-13, 1.0 + 4e-13),
        (1.0 + 4e-13, 1.0 - 4e-13),
    ] {
        let error = refusal("4 0 1 0", &format!("4 {x} {y} 0"));
        assert_eq!(
            error,
            GmshError::CoincidentNodes {
                place,
                tag: 4,
                other: 3,
                x,
                y
            }
        );
    }
    let text = SQUARE.replace("4 0 1 0", "4 1 1.00000000001 0");
    assert!(parse(text.as_bytes()).is_ok(), "nodes ten tolerances apart");
    // A node at the place of another, but of no cell.
    let text = SQUARE.replace("$Nodes\n4", "$Nodes\n5\n9 1 1 0");
    assert!(parse(text.as_bytes()).is_ok());
}

#[test]
fn cells_without_area_are_refused() {
    let place = FilePosition::Line(14);
    let error = refusal("2 1 0 0\n", "2 0.5 0.5 0\n");
    assert_eq!(error, GmshError::ZeroArea { place, element: 2 });
    let error = refusal("2 1 0 0\n", "2 0.7 0.6999999999999999 0\n");
    assert_eq!(
        error,
        GmshError::ZeroArea { place, element: 2 },
        "on a line but for rounding"
    );
    let error = refusal("2 2 2 2 1 1 2 3", "2 2 2 2 1 1 2 1");
    assert_eq!(
        error,
        GmshError::RepeatedCorner {
            place,
            element: 2,
            node: 1
        }
    );
}

#[test]
fn quadrangles_that_are_not_convex_are_refused() {
    let quadrangle = "2 3 2 2 1 1 2 3 4\n";
    let begin = SQUARE.find("2 2 2 2 1").unwrap();
    let text = format!("{}{quadrangle}$EndElements\n", &SQUARE[..begin])
        .replace("$Elements\n3", "$Elements\n2");
    let place = FilePosition::Line(14);
    assert_eq!(parse(text.as_bytes()).unwrap().area(), 1.0);
    // An arrow head, a crossed one with area, and one whose two halves cancel.
    for row in ["3 0.4 0.4 0", "3 -0.5 0.5 0"] {
        let text = text.replace("3 1 1 0", row);
        assert_eq!(
            parse(text.as_bytes()),
            Err(GmshError::NotConvex { place, element: 2 }),
            "{row}"
        );
    }
    let crossed = text.replace("1 1 2 3 4", "1 1 3 2 4");
    assert_eq!(
        parse(crossed.as_bytes()),
        Err(GmshError::NotConvex { place, element: 2 })
    );
    // A corner of 180 degrees does no harm.
    let text = text.replace("3 1 1 0", "3 0.5 0.5 0");
    assert_eq!(parse(text.as_bytes()).unwrap().area(), 0.5);
}

/// Both triangles of the square on the same side of its diagonal: the second one covers half of the first.
#[test]
fn overlapping_cells_are_refused() {
    let expected = GmshError::OverlappingCells {
        place: FilePosition::Line(15),
        element: 3,
        other: 2,
    };
    let overlapping = SQUARE.replace("4 0 1 0", "4 1 0.4 0");
    assert_eq!(parse(overlapping.as_bytes()), Err(expected));
}

/// Eight triangles on three by three nodes, and two large ones on the corners of all: no edge in common. The overlap shows by a node that
/// lies in the second large triangle, or by the middle of a small one in it; without the large ones nothing is refused.
#[test]
fn coarse_cells_over_fine_ones_are_refused() {
    let file = |coarse: &[&str]| {
        let mut text = "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n9\n".to_owned();
        for node in 0..9 {
            text += &format!("{} {} {} 0\n", node + 1, node % 3, node / 3);
        }
        let mut cells = Vec::new();
        for corner in [1, 2, 4, 5] {
            let [right, above, across] = [1, 3, 4].map(|it| corner + it);
            cells.push(format!("{corner} {right} {above}"));
            cells.push(format!("{right} {across} {above}"));
        }
        cells.extend(coarse.iter().map(|it| (*it).to_owned()));
        text += &format!("$EndNodes\n$Elements\n{}\n", cells.len());
        for (number, cell) in (1..).zip(&cells) {
            text += &format!("{number} 2 2 1 1 {cell}\n");
        }
        text + "$EndElements\n"
    };
    assert_eq!(parse(file(&[]).as_bytes()).unwrap().area(), 4.0);
    // Elements begin in line 18; the first cell lies in the first large triangle.
    let expected = |other: u64| GmshError::CoveringCells {
        place: FilePosition::Line(26),
        element: 9,
        other,
        other_place: FilePosition::Line(17 + other as usize),
    };
    let error = parse(file(&["1 3 9", "1 9 7"]).as_bytes()).unwrap_err();
    assert!(
        error.to_string().contains("line 26: cell 9 and cell "),
        "{error}"
    );
    let GmshError::CoveringCells { other, .. } = error else {
        panic!("{error}")
    };
    assert_eq!(error, expected(other));
    let alone = parse(file(&["1 9 7"]).as_bytes()).unwrap_err();
    assert!(
        matches!(alone, GmshError::CoveringCells { element: 9, .. }),
        "{alone}"
    );
}

#[test]
fn duplicate_cells_are_refused() {
    let place = FilePosition::Line(15);
    let expected = GmshError::DuplicateCell {
        place,
        element: 3,
        other: 2,
    };
    assert_eq!(refusal("3 2 2 2 1 1 3 4", "3 2 2 2 1 3 2 1"), expected);
    // In another group of format 2.2 it is the same cell.
    let text = SQUARE.replace("3 2 2 2 1 1 3 4", "3 2 2 8 1 3 2 1");
    let mesh = parse(text.as_bytes()).unwrap();
    assert_eq!(mesh.cells.len(), 1);
    let groups: Vec<_> = mesh
        .groups_named("2")
        .chain(mesh.groups_named("8"))
        .collect();
    assert!(groups.iter().all(|group| group.cells == [0]) && groups.len() == 2);
    // In format 4.1 it is not.
    let place = FilePosition::Line(22);
    let expected = GmshError::DuplicateCell {
        place,
        element: 3,
        other: 2,
    };
    assert_eq!(refusal_of(SQUARE_41, "3 1 3 4", "3 3 1 2"), expected);
}
