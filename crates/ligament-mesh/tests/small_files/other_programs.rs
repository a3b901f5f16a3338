//! Files of other programs, and of Gmsh with unusual options: each means the square, or what is left of it.

use super::square::{SQUARE, SQUARE_41};
use ligament_mesh::gmsh::{CoordinatePlane, FilePosition, GmshError, parse, parse_any_with};
use ligament_mesh::{AnyMesh, Cell, Mesh, Remark};

/// The square with `old` replaced by `new`.
fn changed(square: &str, old: &str, new: &str) -> String {
    let count = square.matches(old).count();
    assert_eq!(count, 1, "{old:?} must stand once in the file");
    square.replace(old, new)
}

fn read(text: &str) -> Mesh {
    parse(text.as_bytes()).unwrap_or_else(|error| panic!("{error}"))
}

#[test]
fn a_byte_order_mark_changes_nothing() {
    for square in [SQUARE, SQUARE_41] {
        assert_eq!(read(&format!("\u{feff}{square}")), read(square));
    }
    let marked = format!("\u{feff}{}", changed(SQUARE, "2 1 0 0\n", "2 1 x 0\n"));
    let error = parse(marked.as_bytes()).unwrap_err().to_string();
    assert!(error.starts_with("line 7: "), "{error}");
}

#[test]
fn earlier_versions_of_format_2_are_read() {
    for version in ["2", "2.0", "2.1"] {
        let text = changed(SQUARE, "2.2 0 8", &format!("{version} 0 8"));
        assert_eq!(read(&text), read(SQUARE));
    }
    for version in ["2.3", "3", "4.0"] {
        let text = changed(SQUARE, "2.2 0 8", &format!("{version} 0 8"));
        let error = parse(text.as_bytes()).unwrap_err();
        assert!(matches!(error, GmshError::UnsupportedVersion { .. }));
    }
}

/// Format 2.0 has names without a dimension: of all groups with the number, or else of one that is empty.
#[test]
fn names_without_a_dimension_are_those_of_all_dimensions() {
    let names =
        "$PhysicalNames\n3\n1 \"edge\"\n2 \"body\"\n7 \"nothing\"\n$EndPhysicalNames\n$Nodes\n";
    let text = changed(SQUARE, "$Nodes\n", names).replace("2.2 0 8", "2 0 8");
    let text = text.replace("1 1 2 1 1 1 2", "1 1 2 2 1 1 2");
    let mesh = read(&text);
    let groups = mesh.groups.iter();
    let found: Vec<_> = groups.map(|it| (it.dimension, it.name.as_str())).collect();
    assert_eq!(found, [(1, "body"), (2, "body")]);
    let empty = ["edge", "nothing"].map(|name| Remark::EmptyGroup {
        name: name.to_owned(),
        dimension: 2,
    });
    assert_eq!(mesh.remarks, empty);
}

#[test]
fn names_may_have_any_signs_or_no_quotes() {
    for (written, name) in [
        ("\"a#b, [c] $Nodes\"", "a#b, [c] $Nodes"),
        ("\" top edge \"", " top edge "),
        ("\"it's \"\"one\"\"\"", "it's \"\"one\"\""),
        ("poly1", "poly1"),
    ] {
        let names = format!("$PhysicalNames\n1\n2 2 {written}\n$EndPhysicalNames\n$Nodes\n");
        let mesh = read(&changed(SQUARE, "$Nodes\n", &names));
        assert_eq!(mesh.groups[1].name, name);
    }
}

#[test]
fn exponents_of_fortran_are_read() {
    for (old, new) in [
        ("2 1 0 0\n", "2 1D+00 0.0d0 0D0\n"),
        ("2 1 0 0\n", "2 0.1D1 -0.25-101 +1.5-300\n"),
        ("3 1 1 0\n", "3 1.0+000 10d-1 0\n"),
    ] {
        let (found, expected) = (read(&changed(SQUARE, old, new)), read(SQUARE));
        assert_eq!(found.cells, expected.cells);
        let pairs = found.positions.iter().zip(&expected.positions);
        assert!(
            pairs
                .flat_map(|(a, b)| [a[0] - b[0], a[1] - b[1]])
                .all(|it| it.abs() < 1e-100)
        );
    }
    for wrong in ["1D", "D1", "1-2", "1D1D1", "1e5-101"] {
        let text = changed(SQUARE, "2 1 0 0\n", &format!("2 {wrong} 0 0\n"));
        let error = parse(text.as_bytes()).unwrap_err().to_string();
        let expected = format!("line 7: expected a coordinate, found \"{wrong}\"");
        assert!(error.starts_with(&expected), "{error}");
    }
}

/// `Mesh.SaveParametric` of Gmsh: points, curves and surfaces have 0, 1 and 2 parametric coordinates.
#[test]
fn parametric_nodes_of_format_2_are_read() {
    let text = SQUARE.replace("Nodes\n", "ParametricNodes\n");
    let text = changed(&text, "1 0 0 0\n", "1 0 0 0 0 1\n");
    let text = changed(&text, "2 1 0 0\n", "2 1 0 0 1 1 0.25\n");
    let text = changed(&text, "3 1 1 0\n", "3 1 1 0 2 1 0.5 0.5\n");
    let text = changed(&text, "4 0 1 0\n", "4 0 1 0 3 1\n");
    assert_eq!(read(&text), read(SQUARE));
    let text = changed(&text, "1 0.25\n", "1 0.25 1\n");
    let error = parse(text.as_bytes()).unwrap_err().to_string();
    assert!(
        error.starts_with("line 7: expected the end of the line"),
        "{error}"
    );
}

/// `Mesh.SaveTopology` of Gmsh lists the groups of entities, which tells those of elements without a group (`Mesh.SaveAll`).
#[test]
fn entities_of_format_2_give_their_groups() {
    let entities =
        "$Entities\n2 1 1 0\n1 0 \n2 0 \n1 2 1 2 1 -5 \n1 1 -1 2 6 7 \n$EndEntities\n$Nodes\n";
    let text = changed(SQUARE, "$Nodes\n", entities);
    assert_eq!(read(&text).groups, read(SQUARE).groups);
    let text = text.replace(" 2 2 2 1 ", " 2 2 0 1 ");
    let text = text.replace(" 1 2 1 1 ", " 1 2 0 1 ");
    let mesh = read(&text);
    let groups = mesh.groups.iter();
    let found: Vec<_> = groups
        .map(|it| (it.dimension, it.number, it.edges.len(), it.cells.len()))
        .collect();
    assert_eq!(found, [(1, 5, 1, 0), (2, 6, 0, 2), (2, 7, 0, 2)]);
    // In another form the section is not used.
    let other = changed(
        SQUARE,
        "$Nodes\n",
        "$Entities\nblue\n$EndEntities\n$Nodes\n",
    );
    let mut mesh = read(&other);
    let remark = mesh.remarks.remove(0).to_string();
    assert!(remark.contains("$Entities (line 4)"), "{remark}");
    assert_eq!(mesh, read(SQUARE));
}

/// Rows of entities may go on in the next line; an error still has the line in which the format is left.
#[test]
fn rows_of_entities_may_be_broken() {
    let entities = |point: &str| {
        let rows = "1 0 0 0 1 0 0 1 3 0\n1 0 0 0\n1 1 0 1\n8 0\n";
        let section = format!("$Entities\n1 1 1 0\n{point}{rows}$EndEntities\n$Nodes\n");
        changed(SQUARE_41, "$Nodes\n", &section)
    };
    let whole = read(&entities("1 0 0 0 0\n"));
    assert_eq!(read(&entities("1 0 0 0\n 0\n")), whole);
    assert_eq!(whole.group("8").unwrap().cells, [0, 1]);
    assert_eq!(whole.group("3").unwrap().edges, [[0, 1]]);
    let error = parse(entities("1 0 0 0\n").as_bytes())
        .unwrap_err()
        .to_string();
    assert!(
        error.starts_with("line 6: expected a number of physical tags"),
        "{error}"
    );
}

/// Two triangles as quadrangles with a repeated corner.
#[test]
fn a_quadrangle_with_a_repeated_corner_is_a_triangle() {
    let text = changed(SQUARE, "2 2 2 2 1 1 2 3\n", "2 3 2 2 1 1 2 3 3\n");
    let text = changed(&text, "3 2 2 2 1 1 3 4\n", "3 3 2 2 1 1 1 3 4\n");
    let mut mesh = read(&text);
    assert_eq!(mesh.cells[0], Cell::Triangle([0, 1, 2]));
    let remark = mesh.remarks.remove(0);
    assert_eq!(remark, Remark::CollapsedCells { cells: 2 });
    assert_eq!(mesh.area(), 1.0);
    assert_eq!(mesh.groups, read(SQUARE).groups);
    let folded = changed(SQUARE, "2 2 2 2 1 1 2 3\n", "2 3 2 2 1 1 2 1 3\n");
    let expected = GmshError::RepeatedCorner {
        place: FilePosition::Line(14),
        element: 2,
        node: 1,
    };
    assert_eq!(parse(folded.as_bytes()), Err(expected));
}

/// The square with its positions in another plane, at a height of 2.
fn in_plane(position: fn(f64, f64) -> [f64; 3]) -> String {
    let mut text = SQUARE.to_owned();
    for (node, x, y) in [(1, 0.0, 0.0), (2, 1.0, 0.0), (3, 1.0, 1.0), (4, 0.0, 1.0)] {
        let [a, b, c] = position(x, y);
        text = changed(
            &text,
            &format!("{node} {x} {y} 0\n"),
            &format!("{node} {a} {b} {c}\n"),
        );
    }
    text
}

#[test]
fn meshes_in_other_planes_are_named_and_turned() {
    let planes = [
        (CoordinatePlane::Xy, in_plane(|x, y| [x, y, 2.0])),
        (CoordinatePlane::Xz, in_plane(|x, y| [x, 2.0, y])),
        (CoordinatePlane::Yz, in_plane(|x, y| [2.0, x, y])),
    ];
    for (plane, text) in &planes {
        for wanted in planes.each_ref().map(|it| it.0) {
            let found = parse_any_with(text.as_bytes(), wanted);
            if wanted != *plane {
                let error = found.unwrap_err();
                let is_named = matches!(error, GmshError::OtherPlane { plane: of, height: 2.0, .. } if of == *plane);
                assert!(is_named, "{error}");
                continue;
            }
            let Ok(AnyMesh::Plane(mut mesh)) = found else {
                panic!("{plane}");
            };
            let turned = Remark::Turned { plane: wanted };
            let expected = (wanted != CoordinatePlane::Xy).then_some(turned);
            assert_eq!(mesh.remarks, Vec::from_iter(expected));
            mesh.remarks.clear();
            assert_eq!(mesh, read(SQUARE));
        }
    }
    let error = parse(planes[1].1.as_bytes()).unwrap_err().to_string();
    let expected = "line 8: the mesh lies in the plane of x and z (y = 2), not in that of x and y; \
        turn it (`Rotate {{1, 0, 0}, {0, 0, 0}, -Pi/2} { Surface{:}; }` in the geometry)";
    assert_eq!(error, expected);
}

#[test]
fn meshes_in_no_plane_are_refused_in_their_own_coordinates() {
    let plane = CoordinatePlane::Xz;
    let text = in_plane(|x, y| [x, 2.0 + 0.5 * x, y]);
    let error = parse_any_with(text.as_bytes(), plane).unwrap_err();
    let expected = "line 7: node 2 lies at y = 2.5, others at 2: the mesh does not lie in the plane of x and z";
    assert_eq!(error.to_string(), expected);
    assert!(matches!(
        parse(text.as_bytes()),
        Err(GmshError::NotPlanar { .. })
    ));
}

/// Two squares with doubled nodes 2 and 3 at their common side, which is a seam.
const SEAM: &str = "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n8\n1 0 0 0\n2 1 0 0\n3 1 1 0\n4 0 1 0\n\
    5 1 0 0\n6 2 0 0\n7 2 1 0\n8 1 1 0\n$EndNodes\n\
    $Elements\n2\n1 3 2 1 1 1 2 3 4\n2 3 2 1 1 8 7 6 5\n$EndElements\n";

#[test]
fn a_seam_is_refused_and_a_crack_is_read() {
    let error = parse(SEAM.as_bytes()).unwrap_err();
    let expected = GmshError::Seam {
        place: FilePosition::Line(10),
        tag: 5,
        other: 2,
        faces: 1,
    };
    assert_eq!(error, expected);
    assert!(
        error.to_string().contains("are parts not joined?"),
        "{error}"
    );
    // Nodes 3 and 8 are one: the tip of a crack from the lower edge on.
    let crack = SEAM.replace("8 7 6 5", "3 7 6 5");
    let mesh = parse(crack.as_bytes()).unwrap();
    let unused = Remark::UnusedNodes { nodes: 1 };
    assert_eq!(mesh.remarks, [unused, Remark::Crack { faces: 1 }]);
    assert_eq!(mesh.crack_faces(), [[[1, 2], [4, 2]]]);
    // With another node of the second square at that place, the sides are not one over the other.
    let text = changed(SEAM, "8 1 1 0", "8 1 1.5 0").replace("7 2 1 0", "7 1 1 0");
    let error = parse(text.as_bytes()).unwrap_err();
    assert!(
        matches!(error, GmshError::CoincidentNodes { .. }),
        "{error}"
    );
}
