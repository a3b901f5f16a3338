//! Groups: sets of nodes and elements, surfaces of nodes and of sides of elements.

use super::{CHAPEL, group, labels, plane, read, refusal, remarks, solid, with_squares};
use ligament_mesh::{DeckRemark, Group};

#[test]
fn sets_contain_numbers_ranges_and_sets() {
    let deck = with_squares(
        "*NSET, NSET=Low
1, 2,
3
*NSET, NSET=Sides, GENERATE
1, 7, 3
9, 3, -3
*NSET, NSET=both
LOW, sides, 8
*NSET, NSET=low
5
*ELSET, ELSET=Row, GENERATE
1, 2
*ELSET, ELSET=L
row, 3
*NSET, NSET=Of elements, ELSET=Row
",
    );
    assert_eq!(labels(&deck, "Low"), [1, 2, 3, 5]);
    assert_eq!(labels(&deck, "Sides"), [1, 3, 4, 6, 7, 9]);
    assert_eq!(labels(&deck, "Both"), [1, 2, 3, 4, 6, 7, 8, 9]);
    assert_eq!(group(&deck, "L").cells, [0, 1, 2]);
    assert_eq!(labels(&deck, "Of elements"), [1, 2, 3, 4, 5, 6]);
    let groups = &plane(&deck).groups;
    let order: Vec<_> = groups
        .iter()
        .map(|it| (it.dimension, it.number, it.name.as_str()))
        .collect();
    let expected = [
        (0, 1, "Low"),
        (0, 2, "Sides"),
        (0, 3, "both"),
        (0, 4, "Of elements"),
        (2, 1, "Plate"),
        (2, 2, "Row"),
        (2, 3, "L"),
    ];
    assert_eq!(order, expected);
}

#[test]
fn one_name_may_be_of_nodes_and_of_elements() {
    let deck = with_squares("*NSET, NSET=A\n1, 2\n*ELSET, ELSET=A\n2\n*SURFACE, NAME=A\n1, S1\n");
    let groups: Vec<&Group> = deck.groups_named("a").collect();
    let dimensions: Vec<u8> = groups.iter().map(|it| it.dimension).collect();
    assert_eq!(dimensions, [0, 1, 2]);
    assert_eq!(
        (groups[1].edges.as_slice(), groups[2].cells.as_slice()),
        (&[[0, 1]][..], &[1][..])
    );
}

#[test]
fn members_on_no_cell_are_told() {
    let deck = with_squares(
        "*NODE\n50, 9, 9\n*NSET, NSET=A\n1, 50, 51, 52\n*NSET, NSET=B\n60\n*NSET, NSET=C\n",
    );
    assert_eq!(labels(&deck, "A"), [1]);
    assert_eq!(
        deck.groups_named("B").count() + deck.groups_named("C").count(),
        0
    );
    let left_out = |set: &str, undefined, beside, is_group| DeckRemark::LeftOutMembers {
        set: set.to_owned(),
        undefined,
        beside,
        is_group,
    };
    let expected = [
        (18, left_out("A", 2, 1, true)),
        (20, left_out("B", 1, 0, false)),
    ];
    assert_eq!(remarks(&deck), expected);
    let texts: Vec<String> = deck
        .mesh
        .remarks()
        .iter()
        .map(ToString::to_string)
        .collect();
    assert_eq!(
        texts[1..],
        [
            "line 18: members of the set A were left out: 2 that the file does not define and 1 on no cell",
            "line 20: members of the set B were left out: 1 that the file does not define; it would be an empty group, and is none",
        ]
    );
}

#[test]
fn sides_of_elements_are_edges() {
    let deck = with_squares(
        "*SURFACE, NAME=Right, TYPE=ELEMENT
2, S2\n4, s2
*ELSET, ELSET=Upper\n3, 4
*SURFACE, NAME=Top, INTERNAL
Upper, S3
*SURFACE, NAME=Outline
Plate,
*SURFACE, NAME=Upper outline
Upper,
*NSET, NSET=Low\n1, 2
*SURFACE, NAME=Some, TYPE=NODE
3, 2.
Low
",
    );
    let right = group(&deck, "Right");
    assert_eq!(
        (right.dimension, right.edges.as_slice()),
        (1, &[[2, 5], [5, 8]][..])
    );
    assert_eq!(labels(&deck, "Top"), [7, 8, 9]);
    assert_eq!(group(&deck, "Outline").edges.len(), 8);
    assert_eq!(group(&deck, "Upper outline").edges.len(), 4);
    let some = group(&deck, "Some");
    assert_eq!((some.dimension, some.nodes.as_slice()), (0, &[0, 1, 2][..]));
}

/// Faces of the cube by their numbers in the manual, and those of the pyramid.
#[test]
fn surfaces_in_space_are_faces() {
    let sides: String = [1, 2, 3, 4, 5, 6]
        .map(|side| {
            format!(
                "*SURFACE, NAME=C{side}\nNave, S{side}\n*SURFACE, NAME=P{side}\n2, S{}\n",
                side.min(5)
            )
        })
        .concat();
    let deck = read(&format!("{CHAPEL}{sides}*SURFACE, NAME=Outside\nNave\n2\n"));
    for (name, expected) in [
        ("C1", &[1, 2, 3, 4][..]),
        ("C2", &[5, 6, 7, 8]),
        ("C3", &[1, 2, 5, 6]),
        ("C4", &[2, 3, 6, 7]),
        ("C5", &[3, 4, 7, 8]),
        ("C6", &[1, 4, 5, 8]),
        ("P1", &[5, 6, 7, 8]),
        ("P2", &[5, 6, 9]),
        ("P3", &[6, 7, 9]),
        ("P4", &[7, 8, 9]),
        ("P5", &[5, 8, 9]),
    ] {
        assert_eq!(labels(&deck, name), expected, "{name}");
    }
    let outside = group(&deck, "Outside");
    assert_eq!((outside.dimension, outside.faces.len()), (2, 9));
    // Every face is one of a cell.
    for group in &solid(&deck).groups {
        if group.dimension == 2 {
            assert!(
                solid(&deck).outward_portions(&group.faces).is_ok()
                    || ["C2", "P1"].contains(&group.name.as_str())
            );
        }
    }
    // A blank line means the outline of everything.
    let all = read(&format!("{CHAPEL}*SURFACE, NAME=All\n\n*HEADING\n"));
    assert_eq!(group(&all, "All").faces.len(), 9);
}

#[test]
fn sides_and_surfaces_that_are_none_are_told_or_refused() {
    for (lines, expected) in [
        (
            "*SURFACE, NAME=A\n1, S5\n",
            "line 17: there is no side 5 of an element of type CPS4",
        ),
        (
            "*SURFACE, NAME=A\n1, T1\n",
            "line 17: expected a side of an element",
        ),
        (
            "*SURFACE, NAME=A\nB, S1\n",
            "line 17: there is no element set B",
        ),
        (
            "*SURFACE, NAME=A, COMBINE=UNION\nB\n",
            "line 16: *SURFACE with COMBINE or CROP is not carried out",
        ),
        ("*SURFACE\n1, S1\n", "line 16: *SURFACE has no NAME="),
        ("*NSET, NSET=A\nB\n", "line 17: there is no node set B"),
        (
            "*NSET, NSET=A\n1.5\n",
            "line 17: expected a number or the name of a set",
        ),
        (
            "*NSET, NSET=A, GENERATE\n1, 5, 0\n",
            "line 17: expected an increment",
        ),
        ("*ELSET\n1\n", "line 16: *ELSET has no ELSET="),
    ] {
        let error = refusal(&format!("{}{}{lines}", super::NODES, super::SQUARES));
        assert!(error.starts_with(expected), "{error}");
    }
    let deck = with_squares("*SURFACE, NAME=Tool, TYPE=SEGMENTS\nSTART, 0, 0\nLINE, 1, 0\n");
    let (surface, kind) = ("Tool".to_owned(), "SEGMENTS".to_owned());
    assert_eq!(
        remarks(&deck),
        [(16, DeckRemark::LeftOutSurface { surface, kind })]
    );
}

/// Sides under `*DLOAD` are groups: one for each side of a set, and one for single elements under one pressure. Lines without a side make no group.
#[test]
fn pressed_sides_are_groups() {
    let deck = with_squares(
        "*STEP\n*DLOAD\nPlate, p1, 2.\nPlate, GRAV, 9.81, 0., -1.\nNobody, P1, 1.\n3, P3, 5.\n4, P3, 5.\n4, P2, 7.\n*END STEP\n",
    );
    // The first side of each square, from its first to its second node.
    assert_eq!(
        group(&deck, "Plate.P1").edges,
        [[0, 1], [1, 2], [3, 4], [4, 5]]
    );
    let first = group(&deck, "dload-21");
    assert_eq!(first.edges, [[7, 6], [8, 7]]);
    assert_eq!(group(&deck, "dload-23").edges, [[5, 8]]);
    let names: Vec<_> = deck.keywords[1].pressed_sides();
    let expected = [
        "Plate.P1",
        "",
        "Nobody.P1",
        "dload-21",
        "dload-21",
        "dload-23",
    ];
    let expected = expected.map(|it| (!it.is_empty()).then(|| it.to_owned()));
    assert_eq!(names, expected);
}
