//! One deck for each refusal of lines and of meshes, with the line at which it is refused.

use super::{CHAPEL, NODES, SQUARES, read, refusal, try_read};
use ligament_mesh::inp::InpError;

#[test]
fn faulty_lines_are_named() {
    for (old, new, expected) in [
        (
            "*NODE",
            "1, 0, 0\n*NODE",
            "line 1: data before the first keyword",
        ),
        (
            "*NODE",
            "*NODE, NSETS=A",
            "line 1: the parameter NSETS of *NODE is not read",
        ),
        (
            "*NODE",
            "*NODE, SYSTEM=X",
            "line 1: expected SYSTEM=R, C or S, found \"X\"",
        ),
        ("*NODE", "*NOD", "line 1: *NOD is short for *NODE"),
        ("*ELEMENT", "*ELEM", "line 11: *ELEM is short for *ELEMENT"),
        (
            "5, 1, 1\n",
            "5, 1, one\n",
            "line 6: expected a coordinate, found \"one\"",
        ),
        (
            "5, 1, 1\n",
            "5, 1, <y>\n",
            "line 6: <y> is a value of *PARAMETER",
        ),
        (
            "5, 1, 1\n",
            "-5, 1, 1\n",
            "line 6: expected the number of a node, found \"-5\"",
        ),
        (
            "5, 1, 1\n",
            "5, 1, 1e999\n",
            "line 6: expected a coordinate, found \"1e999\"",
        ),
        (", TYPE=CPS4", "", "line 11: *ELEMENT has no TYPE="),
        (
            "CPS4",
            "CPX4",
            "line 11: the element type CPX4 is not known",
        ),
        (
            "CPS4",
            "CAX4R",
            "line 11: the element type CAX4R is not read: a body of revolution",
        ),
        (
            "CPS4",
            "CPEG4",
            "line 11: the element type CPEG4 is not read: in generalised plane strain",
        ),
        (
            "CPS4",
            "CPS3",
            "line 12: element 1 of type CPS3 has 4 nodes for 3",
        ),
        (
            "CPS4",
            "CPS6",
            "line 12: element 1 of type CPS6 has 9 nodes for 6",
        ),
        (
            "TYPE=CPS4",
            "TYPE=CPS4, OFFSET=10",
            "line 11: *ELEMENT with OFFSET is not carried out",
        ),
        (
            "2, 2, 3, 6, 5\n",
            "2, 2, 3, , 5\n",
            "line 13: expected the number of a node, found nothing",
        ),
        (
            "2, 2, 3, 6, 5\n",
            "2, 2, 3, 66, 5\n",
            "line 13: element 2 names node 66",
        ),
        (
            "4, 5, 6, 9, 8\n",
            "4, 5, 6, 9\n",
            "line 15: element 4 of type CPS4 has 3 nodes for 4",
        ),
        (
            "4, 5, 6, 9, 8\n",
            "x\n",
            "line 15: expected the number of an element",
        ),
    ] {
        let text = format!("{NODES}{SQUARES}");
        assert_eq!(text.matches(old).count(), 1, "{old}");
        let error = refusal(&text.replace(old, new));
        assert!(error.starts_with(expected), "{error}");
    }
}

#[test]
fn files_without_a_body_are_refused() {
    assert_eq!(try_read(""), Err(InpError::NoCells));
    assert_eq!(try_read("** nothing\n\n"), Err(InpError::NoCells));
    assert_eq!(try_read(NODES), Err(InpError::NoCells));
    let trusses = format!("{NODES}*ELEMENT, TYPE=T2D2\n1, 1, 2\n");
    assert_eq!(try_read(&trusses), Err(InpError::NoCells));
    assert_eq!(
        try_read("*NODE\n1, \0"),
        Err(InpError::NotText { file: None })
    );
}

#[test]
fn faults_of_planar_meshes_are_named_with_lines_of_the_deck() {
    let text = format!("{NODES}{SQUARES}");
    for (old, new, expected) in [
        (
            "5, 1, 1\n",
            "5, 1, 1, 0.5\n",
            "line 6: node 5 lies at z = 0.5, others at z = 0",
        ),
        ("9, 2, 2\n", "9, 2, 2\n10, 1, 1\n", ""),
        (
            "6, 2, 1\n",
            "6, 1, 1\n",
            "line 7: nodes 5 (line 6) and 6 are at one place; merge them",
        ),
        (
            "1, 1, 2, 5, 4",
            "1, 1, 2, 3, 2",
            "line 12: element 1 of type CPS4 has repeated corners",
        ),
        (
            "4, 0, 1\n",
            "4, 0.5, 0\n",
            "line 12: element 1 of type CPS4 is not convex",
        ),
        (
            "3, 4, 5, 8, 7",
            "3, 1, 2, 5, 4",
            "line 14: element 3 has the corners of element 1 (line 12)",
        ),
        (
            "3, 4, 5, 8, 7",
            "3, 1, 2, 8, 7",
            "line 14: element 3 lies on the same side of a common edge as element 1",
        ),
    ] {
        assert_eq!(text.matches(old).count(), 1, "{old}");
        let changed = text.replace(old, new);
        if expected.is_empty() {
            assert_eq!(read(&changed).mesh.n_cells(), 4);
            continue;
        }
        let error = refusal(&changed);
        assert!(error.starts_with(expected), "{error}");
    }
    let flat =
        "*NODE\n1, 0, 0\n2, 1, 0\n3, 2, 0\n4, 0, 1\n*ELEMENT, TYPE=CPS3\n1, 1, 2, 3\n2, 1, 2, 4\n";
    assert!(refusal(flat).starts_with("line 7: element 1 of type CPS3 has no area"));
}

#[test]
fn faults_of_solid_meshes_are_named_with_lines_of_the_deck() {
    for (old, new, expected) in [
        (
            "9, 0.5, 0.5, 2",
            "9, 0.5, 0.5, 1",
            "line 14: element 2 of type C3D5 is flat",
        ),
        (
            "7, 1, 1, 1\n",
            "7, 0.2, 0.2, 0.2\n",
            "line 12: element 1 of type C3D8 is not convex",
        ),
        (
            "9, 0.5, 0.5, 2",
            "9, 0.5, 0.5, 0.5",
            "line 14: element 2 lies on the same side of a common face as element 1",
        ),
        (
            "9, 0.5, 0.5, 2",
            "9, 1, 1, 1",
            "line 10: nodes 7 (line 8) and 9 are at one place",
        ),
    ] {
        assert_eq!(CHAPEL.matches(old).count(), 1, "{old}");
        let error = refusal(&CHAPEL.replace(old, new));
        assert!(error.starts_with(expected), "{error}");
    }
}
