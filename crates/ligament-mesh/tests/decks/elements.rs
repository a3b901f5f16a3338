//! Elements: their types, orders and shapes, those that are no cells, plane elements beside solid ones.

use super::{
    CHAPEL, NODES, SQUARES, group, labels, no_files, plane, read, refusal, remarks, solid,
    try_read, with_squares,
};
use ligament_mesh::gmsh::CoordinatePlane;
use ligament_mesh::inp::{InpError, Plane, parse_with};
use ligament_mesh::{AnyMesh, Cell, DeckRemark, Remark, SolidCell};

#[test]
fn the_state_of_the_plane_is_that_of_the_elements() {
    assert_eq!(with_squares("").plane, Some(Plane::Stress));
    let strain = format!("{NODES}{}", SQUARES.replace("CPS4", "CPE4RH"));
    assert_eq!(read(&strain).plane, Some(Plane::Strain));
    let heat = format!("{NODES}{}", SQUARES.replace("CPS4", "DC2D4"));
    assert_eq!(read(&heat).plane, None);
    let both =
        format!("{NODES}*ELEMENT, TYPE=CPE4\n1, 1, 2, 5, 4\n*ELEMENT, TYPE=CPS4R\n2, 2, 3, 6, 5\n");
    let error = refusal(&both);
    assert!(
        error.starts_with("line 12: ") && error.contains("(line 14)") && error.contains("CPS4R"),
        "{error}"
    );
}

#[test]
fn second_order_elements_keep_their_corners() {
    let deck = read(
        "*NODE, NSET=All
1, 0, 0\n2, 2, 0\n3, 0, 2\n4, 1, 0\n5, 1, 1\n6, 0, 1\n7, 9, 9
*ELEMENT, TYPE=CPE6
1, 1, 2, 3, 4, 5, 6
*NSET, NSET=Middle
4, 5
*ELEMENT, TYPE=B22, ELSET=Low
2, 1, 4, 2
",
    );
    let mesh = plane(&deck);
    assert_eq!(mesh.cells, [Cell::Triangle([0, 1, 2])]);
    let [higher, unused] = &mesh.remarks[..2] else {
        panic!("{:?}", mesh.remarks)
    };
    assert_eq!(higher, &Remark::HigherOrderCells { cells: 1, nodes: 3 });
    assert_eq!(unused, &Remark::UnusedNodes { nodes: 1 });
    assert_eq!(labels(&deck, "All"), [1, 2, 3]);
    // Nodes of sets that are no nodes of the mesh, and the corners beside those in the middle of edges.
    assert_eq!(deck.outside["All"], [4, 5, 6, 7]);
    assert_eq!(deck.outside["Middle"], [4, 5]);
    let midpoints: Vec<_> = deck.midpoints.clone().into_iter().collect();
    assert_eq!(midpoints, [(4, [1, 2]), (5, [2, 3]), (6, [3, 1])]);
    assert_eq!(group(&deck, "Low").edges, [[0, 1]]);
    let of_sets = remarks(&deck);
    let left_out = |set: &str, beside, is_group| DeckRemark::LeftOutMembers {
        set: set.to_owned(),
        undefined: 0,
        beside,
        is_group,
    };
    assert!(
        of_sets.contains(&(1, left_out("All", 1, true))),
        "{of_sets:?}"
    );
    assert!(
        of_sets.contains(&(11, left_out("Middle", 2, false))),
        "{of_sets:?}"
    );
}

/// Twenty nodes in two lines; nodes between the corners are 9 to 20.
#[test]
fn nodes_of_an_element_go_on_in_further_lines() {
    let corners = CHAPEL.split("9, 0.5").next().unwrap();
    let middles = (9..=20).map(|node| format!("{node}, 0.3, 0.4, 0.0{node}\n"));
    let middles: String = middles.collect();
    let lists = [
        "1, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15,\n16, 17, 18, 19, 20\n",
        "1, 1, 2, 3, 4, 5, 6, 7, 8\n9, 10, 11, 12, 13, 14, 15, 16, 17, 18, 19, 20,\n",
    ];
    for list in lists {
        let deck = read(&format!("{corners}{middles}*ELEMENT, TYPE=C3D20R\n{list}"));
        assert!((solid(&deck).volume() - 1.0).abs() < 1e-15);
        let higher = Remark::HigherOrderCells {
            cells: 1,
            nodes: 12,
        };
        assert_eq!(deck.mesh.remarks(), [higher]);
    }
    // Nodes within the element may be missing.
    let list =
        "1, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14,\n 15, 16, 17, 18, 19, 20, 9, , 0\n";
    let deck = read(&format!("{corners}{middles}*ELEMENT, TYPE=C3D27\n{list}"));
    assert_eq!(deck.mesh.n_cells(), 1);
}

#[test]
fn solid_elements_of_all_shapes_are_read() {
    let deck = read(CHAPEL);
    let mesh = solid(&deck);
    assert_eq!(
        mesh.cells[0],
        SolidCell::Hexahedron([0, 1, 2, 3, 4, 5, 6, 7])
    );
    assert_eq!(mesh.cells[1], SolidCell::Pyramid([4, 5, 6, 7, 8]));
    assert!((mesh.volume() - 4.0 / 3.0).abs() < 1e-15);
    assert_eq!((deck.plane, deck.mesh.remarks()), (None, &[][..]));
    let prisms = CHAPEL.replace("C3D8", "C3D6").replace(
        "1, 1, 2, 3, 4, 5, 6, 7, 8\n",
        "1, 1, 2, 3, 5, 6, 7\n3, 1, 3, 4, 5, 7, 8\n",
    );
    let roof = prisms
        .replace("C3D5", "C3D4")
        .replace("2, 5, 6, 7, 8, 9\n", "2, 5, 6, 7, 9\n4, 5, 7, 8, 9\n");
    for (text, n_cells) in [(prisms, 3), (roof, 4)] {
        let deck = read(&text);
        assert_eq!(deck.mesh.n_cells(), n_cells);
        assert!((solid(&deck).volume() - 4.0 / 3.0).abs() < 1e-15);
    }
}

#[test]
fn elements_with_repeated_corners_are_the_cells_they_are() {
    let text = CHAPEL
        .replace("C3D5", "C3D8R")
        .replace("2, 5, 6, 7, 8, 9\n", "2, 5, 6, 7, 8, 9, 9, 9, 9\n");
    let deck = read(&format!(
        "{text}*SURFACE, NAME=East\nRoof, S4\n*SURFACE, NAME=Tip\nRoof, S2\n"
    ));
    assert_eq!(solid(&deck).cells, solid(&read(CHAPEL)).cells);
    assert_eq!(labels(&deck, "East"), [6, 7, 9]);
    assert_eq!(deck.groups_named("Tip").count(), 0);
    let tip = DeckRemark::LeftOutSides {
        surface: "Tip".to_owned(),
        sides: 1,
        is_group: false,
    };
    assert_eq!(remarks(&deck), [(17, tip)]);
    assert_eq!(deck.mesh.remarks()[0], Remark::CollapsedCells { cells: 1 });
    let text = format!("{NODES}*ELEMENT, TYPE=CPS4\n1, 1, 2, 5, 5\n2, 1, 5, 4, 4\n");
    assert_eq!(plane(&read(&text)).cells.len(), 2);
    let error = refusal(&format!("{NODES}*ELEMENT, TYPE=CPS4\n1, 1, 2, 1, 4\n"));
    assert!(
        error.starts_with("line 12: element 1 of type CPS4"),
        "{error}"
    );
}

#[test]
fn elements_that_are_no_cells_are_counted_by_type() {
    let deck = with_squares(
        "*NODE
90, 3, 3
*ELEMENT, TYPE=MASS, ELSET=Point
20, 90
*ELEMENT, TYPE=SPRINGA
21, 1, 9
22, 2, 9
*ELEMENT, TYPE=COH2D4
23, 5, 6, 6,
5
*ELEMENT, TYPE=T2D2, ELSET=Bars
24, 1, 2
25, 1, 9
",
    );
    assert_eq!(deck.mesh.n_cells(), 4);
    let left_out = |kind: &str, elements, in_groups| DeckRemark::LeftOutElements {
        kind: kind.to_owned(),
        elements,
        in_groups,
    };
    let members = |set: &str, is_group| DeckRemark::LeftOutMembers {
        set: set.to_owned(),
        undefined: 0,
        beside: 1,
        is_group,
    };
    let expected = [
        (19, left_out("MASS", 1, 0)),
        (21, left_out("SPRINGA", 2, 0)),
        (24, left_out("COH2D4", 1, 0)),
        (27, left_out("T2D2", 2, 1)),
        (18, members("Point", false)),
        (26, members("Bars", true)),
    ];
    assert_eq!(remarks(&deck), expected);
    assert_eq!(group(&deck, "Bars").edges, [[0, 1]]);
    let text = deck.mesh.remarks()[1].to_string();
    assert!(
        text.starts_with("line 19: 1 element of type MASS left out: no part of the body"),
        "{text}"
    );
}

#[test]
fn plane_elements_on_a_solid_are_its_faces() {
    let skin = "*ELEMENT, TYPE=CPS3, ELSET=East\n5, 6, 7, 9\n*ELEMENT, TYPE=S4R, ELSET=Floor\n6, 1, 4, 3, 2\n";
    let deck = read(&format!("{CHAPEL}{skin}"));
    assert_eq!(deck.plane, None);
    let (east, floor) = (group(&deck, "East"), group(&deck, "Floor"));
    assert_eq!(
        (east.dimension, east.faces.len(), east.nodes.as_slice()),
        (2, 1, &[5, 6, 8][..])
    );
    assert_eq!(
        (floor.dimension, floor.number, floor.nodes.len()),
        (2, 2, 4)
    );
    let error = refusal(&format!(
        "{CHAPEL}{}",
        skin.replace("5, 6, 7, 9", "5, 6, 3, 9")
    ));
    assert!(
        error.starts_with("line 16: element 5 of type CPS3"),
        "{error}"
    );
    // A shell beside the solid is left out.
    let deck = read(&format!(
        "{CHAPEL}{}",
        skin.replace("6, 1, 4, 3, 2", "6, 1, 3, 7, 5")
    ));
    assert_eq!(deck.groups_named("Floor").count(), 0);
}

#[test]
fn shells_alone_are_plane_cells() {
    let deck = read(&format!(
        "{NODES}{}*SURFACE, NAME=Low\n1, E1\n2, E1\n*SURFACE, NAME=Front\nPlate, SPOS\n",
        SQUARES.replace("CPS4", "S4R")
    ));
    assert_eq!((deck.plane, deck.mesh.n_cells()), (None, 4));
    assert_eq!(group(&deck, "Low").edges, [[0, 1], [1, 2]]);
    let remarks = remarks(&deck);
    assert_eq!(remarks[0], (12, DeckRemark::ShellsAsCells { elements: 4 }));
    assert!(
        matches!(&remarks[1], (19, DeckRemark::LeftOutSides { sides: 4, .. })),
        "{remarks:?}"
    );
}

#[test]
fn clockwise_and_inverted_elements_are_reoriented() {
    let text = format!("{NODES}*ELEMENT, TYPE=CPS4\n1, 1, 4, 5, 2\n*SURFACE, NAME=Left\n1, S1\n");
    let deck = read(&text);
    assert_eq!(plane(&deck).area(), 1.0);
    assert_eq!(labels(&deck, "Left"), [1, 4]);
    let text = CHAPEL.replace("1, 1, 2, 3, 4, 5, 6, 7, 8", "1, 5, 6, 7, 8, 1, 2, 3, 4");
    let deck = read(&format!("{text}*SURFACE, NAME=Base\n1, S2\n"));
    assert!((solid(&deck).volume() - 4.0 / 3.0).abs() < 1e-15);
    assert_eq!(labels(&deck, "Base"), [1, 2, 3, 4]);
}

/// Shells in the plane of y and z, which the deck gives as (0, a, b), become the squares with a to the right and b upwards.
#[test]
fn shells_in_another_plane_are_turned() {
    let turned = NODES
        .lines()
        .map(|line| match line.split(", ").collect::<Vec<_>>()[..] {
            [node, a, b] => format!("{node}, 0, {a}, {b}\n"),
            _ => format!("{line}\n"),
        });
    let text = turned.collect::<String>() + &SQUARES.replace("CPS4", "S4");
    let error = try_read(&text).unwrap_err();
    let expected = InpError::OtherPlane {
        plane: CoordinatePlane::Yz,
    };
    assert_eq!(error, expected);
    let plane = CoordinatePlane::Yz;
    let AnyMesh::Plane(mesh) = parse_with(text.as_bytes(), plane, &mut no_files)
        .unwrap()
        .mesh
    else {
        panic!("a planar mesh");
    };
    let AnyMesh::Plane(expected) = read(&format!("{NODES}{SQUARES}")).mesh else {
        panic!("a planar mesh");
    };
    assert_eq!(mesh.positions, expected.positions);
    assert_eq!(mesh.cells, expected.cells);
}

/// Every node in the middle of an edge of solid elements of second order lies in the middle of the two corners.
#[test]
fn middles_of_edges_lie_between_their_corners() {
    const TETRAHEDRON: [[f64; 3]; 4] =
        [[0.0; 3], [1.0, 0.0, 0.0], [0.0, 2.0, 0.0], [0.0, 0.0, 4.0]];
    const BOX: [[f64; 3]; 8] = [
        [0.0; 3],
        [1.0, 0.0, 0.0],
        [1.0, 2.0, 0.0],
        [0.0, 2.0, 0.0],
        [0.0, 0.0, 4.0],
        [1.0, 0.0, 4.0],
        [1.0, 2.0, 4.0],
        [0.0, 2.0, 4.0],
    ];
    // Edges in the order of the manuals, by corners counted from 1.
    let ten: &[[usize; 2]] = &[[1, 2], [2, 3], [3, 1], [1, 4], [2, 4], [3, 4]];
    let twenty: &[[usize; 2]] = &[
        [1, 2],
        [2, 3],
        [3, 4],
        [4, 1],
        [5, 6],
        [6, 7],
        [7, 8],
        [8, 5],
        [1, 5],
        [2, 6],
        [3, 7],
        [4, 8],
    ];
    for (kind, corners, edges) in [
        ("C3D10", &TETRAHEDRON[..], ten),
        ("C3D20", &BOX[..], twenty),
    ] {
        let middle = |edge: &[usize; 2]| {
            let [a, b] = edge.map(|it| corners[it - 1]);
            std::array::from_fn(|axis| 0.5 * (a[axis] + b[axis]))
        };
        let positions: Vec<[f64; 3]> = corners
            .iter()
            .copied()
            .chain(edges.iter().map(middle))
            .collect();
        let mut text = "*NODE\n".to_owned();
        for (label, [x, y, z]) in (1..).zip(&positions) {
            text += &format!("{label}, {x}, {y}, {z}\n");
        }
        let labels: Vec<String> = (1..=positions.len()).map(|it| it.to_string()).collect();
        text += &format!(
            "*ELEMENT, TYPE={kind}\n1, {}\n",
            labels.join(", ").replace("15,", "15,\n")
        );
        let deck = read(&text);
        assert_eq!(deck.midpoints.len(), edges.len(), "{kind}");
        for (number, ends) in deck.midpoints {
            let at = |number: u64| positions[number as usize - 1];
            let [a, b] = ends.map(at);
            let between: [f64; 3] = std::array::from_fn(|axis| 0.5 * (a[axis] + b[axis]));
            assert_eq!(at(number), between, "{kind}: {number}");
        }
    }
}
