//! Nodes and elements that keywords generate: *SYSTEM, *NGEN, *NFILL, *NCOPY, *ELGEN, *ELCOPY.

use super::{NODES, group, labels, plane, read, refusal, remarks, solid};
use ligament_mesh::DeckRemark;

/// Rounding of coordinates and areas of the order of 1.
const TOLERANCE: f64 = 1e-14;

/// A plate of 4 x 4 squares of side 0.25.
const PLATE: &str = "\
*NODE
1, 0, 0\n5, 1, 0\n21, 0, 1\n25, 1, 1
*NGEN, NSET=Low
1, 5
*NGEN, NSET=High
21, 25, 1
*NFILL, NSET=All
Low, High, 4, 5
*ELEMENT, TYPE=CPS4
1, 1, 2, 7, 6
*ELGEN, ELSET=Plate
1, 4, 1, 1, 4, 5, 4
";

#[test]
fn a_plate_is_generated() {
    let deck = read(PLATE);
    let mesh = plane(&deck);
    assert_eq!((mesh.cells.len(), mesh.positions.len()), (16, 25));
    assert!((mesh.area() - 1.0).abs() < TOLERANCE);
    assert_eq!(group(&deck, "Plate").cells.len(), 16);
    assert_eq!(labels(&deck, "Low"), [1, 2, 3, 4, 5]);
    assert_eq!(group(&deck, "All").nodes.len(), 25);
    let tag = |tag: u64| mesh.node_tags.iter().position(|it| *it == tag).unwrap();
    assert_eq!(mesh.positions[tag(12)], [0.25, 0.5]);
    // The same elements as copies of the first row.
    let copies = PLATE
        .replace("1, 4, 1, 1, 4, 5, 4\n", "1, 4\n")
        .replace("Plate", "Row")
        + "*ELCOPY, OLD SET=Row, NEW SET=Row 2, ELEMENT SHIFT=4, SHIFT NODES=5\n\
           *ELCOPY, OLD SET=Row, ELEMENT SHIFT=8, SHIFT NODES=10\n\
           *ELCOPY, OLD SET=Row 2, ELEMENT SHIFT=8, SHIFT NODES=10\n";
    let copied = read(&copies);
    let (mut found, mut expected) = (plane(&copied).cells.clone(), mesh.cells.clone());
    found.sort_by_key(|cell| cell.corners().to_vec());
    expected.sort_by_key(|cell| cell.corners().to_vec());
    assert_eq!(found, expected);
    assert_eq!(group(&copied, "Row 2").cells, [4, 5, 6, 7]);
}

#[test]
fn layers_of_solid_elements_are_generated() {
    let deck = read(&format!(
        "{PLATE}*NCOPY, OLD SET=All, CHANGE NUMBER=100, SHIFT, MULTIPLE=2, NEW SET=Upper
0, 0, 0.5

*ELEMENT, TYPE=C3D8
101, 1, 2, 7, 6, 101, 102, 107, 106
*ELGEN, ELSET=Block
101, 4, 1, 1, 4, 5, 4, 2, 100, 100
*NSET, NSET=Top
205, 225
"
    ));
    let mesh = solid(&deck);
    assert_eq!(mesh.cells.len(), 32);
    assert!((mesh.volume() - 1.0).abs() < TOLERANCE);
    assert_eq!(group(&deck, "Upper").nodes.len(), 50);
    let top = &group(&deck, "Top").nodes;
    assert_eq!(mesh.positions[top[1] as usize], [1.0, 1.0, 1.0]);
    // The plane elements are faces of the lower layer.
    assert_eq!(group(&deck, "Plate").faces.len(), 16);
}

/// A ring between the radii 1 and 2, of a half and a whole circle: the area of the polygons is by hand.
#[test]
fn nodes_lie_on_circles() {
    let ring = |n: u32, degrees: f64| {
        // The polygon of n sides between the two radii.
        let angle = degrees.to_radians() / f64::from(n);
        f64::from(n) * angle.sin() * (4.0 - 1.0) / 2.0
    };
    let quarter = "\
*NODE
1, 1, 0\n5, 0, 1\n101, 2, 0\n105, 0, 2\n999, 0, 0
*NGEN, LINE=C, NSET=In
1, 5, 1, 999
*NGEN, LINE=C, NSET=Out
101, 105, 1, , 0, 0, 0
*ELEMENT, TYPE=CPS4
1, 1, 101, 102, 2
*ELGEN
1, 4
";
    let deck = read(quarter);
    assert!((plane(&deck).area() - ring(4, 90.0)).abs() < TOLERANCE);
    assert_eq!(labels(&deck, "In"), [1, 2, 3, 4, 5]);
    // Three quarters the other way around, by the normal.
    let longer = quarter
        .replace("1, 5, 1, 999", "1, 5, 1, 999, , , , 0, 0, -1")
        .replace("101, 105, 1, , 0, 0, 0", "101, 105, 1, , 0, 0, 0, 0, 0, -2");
    assert!((plane(&read(&longer)).area() - ring(4, 270.0)).abs() < TOLERANCE);
    let straight = quarter
        .replace("5, 0, 1\n", "5, -1, 0\n")
        .replace("105, 0, 2", "105, -2, 0");
    assert!(refusal(&straight).starts_with("line 8: expected a circle"));
    let oval = quarter.replace("5, 0, 1\n", "5, 0, 1.1\n");
    assert!(refusal(&oval).starts_with("line 8: expected a circle"));
    let parabola = refusal(&quarter.replace("LINE=C, NSET=In", "LINE=P"));
    assert!(parabola.contains("LINE=P") && parabola.contains("write the nodes out"));
}

#[test]
fn coordinates_are_taken_to_the_global_system() {
    let deck = read(
        "*SYSTEM
1, 0, 0, 1, 2, 0
*NODE, SYSTEM=C
1, 0, 0, 0\n2, 1, 0, 0
*NODE
3, 0, 1
*SYSTEM
*NODE, SYSTEM=S
4, 2, 90, 0
*ELEMENT, TYPE=CPE3
1, 1, 2, 3
2, 2, 4, 3
",
    );
    let expected = [[1.0, 0.0], [1.0, 1.0], [0.0, 0.0], [0.0, 2.0]];
    for (found, expected) in plane(&deck).positions.iter().zip(expected) {
        assert!((found[0] - expected[0]).hypot(found[1] - expected[1]) < TOLERANCE);
    }
}

#[test]
fn nodes_are_copied_by_reflections_and_rotations() {
    let square = "*NODE, NSET=All\n1, 1, 0\n2, 2, 0\n3, 2, 1\n4, 1, 1\n*ELEMENT, TYPE=CPS4, ELSET=One\n1, 1, 2, 3, 4\n";
    let copy = |parameters: &str, data: &str| {
        let deck = read(&format!(
            "{square}*NCOPY, OLD SET=All, CHANGE NUMBER=10, {parameters}\n{data}\n\
             *ELCOPY, OLD SET=One, ELEMENT SHIFT=1, SHIFT NODES=10, REFLECT\n"
        ));
        let mesh = plane(&deck);
        assert!((mesh.area() - 2.0).abs() < TOLERANCE);
        mesh.positions[4]
    };
    for (parameters, data, expected) in [
        ("SHIFT", "2, 2\n0,", [3.0, 2.0]),
        ("SHIFT", "\n0, 0, 0, 0, 0, 1, 90", [0.0, 1.0]),
        ("SHIFT", "1, 0, 0\n0, 0, 0, 0, 0, 1, 90", [0.0, 2.0]),
        ("REFLECT=POINT", "0, 0, 0", [-1.0, 0.0]),
        ("REFLECT=LINE", "0, 0, 0, 0, 1, 0", [-1.0, 0.0]),
        ("REFLECT=MIRROR", "0, 0, 0, 0, 1, 0\n0, 0, 1", [-1.0, 0.0]),
    ] {
        let [x, y] = copy(parameters, data);
        assert!(
            (x - expected[0]).hypot(y - expected[1]) < TOLERANCE,
            "{parameters}: {x} {y}"
        );
    }
}

/// The sides of reflected copies have no known numbers.
#[test]
fn numbered_sides_of_reflected_copies_are_refused() {
    let text = format!(
        "{NODES}*ELEMENT, TYPE=CPS4, ELSET=One\n1, 1, 2, 5, 4\n*ELCOPY, OLD SET=One, NEW SET=Two, ELEMENT SHIFT=1, SHIFT NODES=1, REFLECT\n\
         *SURFACE, NAME=Side\nTwo, S1\n"
    );
    assert!(refusal(&text).starts_with("line 15: a numbered side of a copy"));
    assert_eq!(group(&read(&text.replace("S1", "")), "Side").edges.len(), 3);
}

#[test]
fn the_last_definition_counts() {
    let text = PLATE.to_owned()
        + "*NODE\n13, 0.6, 0.5\n*NODE\n1, 0, 0\n*ELEMENT, TYPE=CPS4\n1, 1, 2, 7, 6\n";
    let deck = read(&text);
    let items = "nodes";
    let expected = (17, DeckRemark::Redefined { items, count: 1 });
    assert_eq!(remarks(&deck), [expected]);
    let mesh = plane(&deck);
    let moved = mesh.node_tags.iter().position(|tag| *tag == 13).unwrap();
    assert_eq!(mesh.positions[moved], [0.6, 0.5]);
}

#[test]
fn what_is_not_generated_is_refused() {
    for (old, new, expected) in [
        (
            "NSET=All",
            "NSET=All, BIAS=0.8",
            "line 10: *NFILL with uneven distances",
        ),
        ("NSET=All", "SINGULAR=1", "line 10: *NFILL"),
        ("Low, High", "Low, Top", "line 11: there is no node set Top"),
        ("Low, High", "Low, All", "line 11: there is no node set All"),
        (
            "Low, High",
            "Low, 21",
            "line 11: expected two sets with the same number of nodes",
        ),
        (
            "1, 5\n",
            "1, 5, 3\n",
            "line 7: expected an increment that divides",
        ),
        ("1, 5\n", "1, 6\n", "line 7: there is no node 6"),
        ("\n1, 4, 1", "\n7, 4, 1", "line 15: there is no element 7"),
        (
            "\n1, 4, 1",
            "\n1, 0, 1",
            "line 15: expected numbers of elements",
        ),
        (
            "\n1, 4, 1, 1",
            "\n1, 4, -1, 1",
            "line 15: expected numbers of nodes",
        ),
        (
            "*ELGEN",
            "*NMAP, NSET=All\n*ELGEN",
            "line 14: *NMAP is not carried out",
        ),
    ] {
        assert_eq!(PLATE.matches(old).count(), 1, "{old}");
        let error = refusal(&PLATE.replace(old, new));
        assert!(error.starts_with(expected), "{error}");
    }
    let uniform = PLATE.replace("NSET=All", "NSET=All, BIAS=1.");
    assert_eq!(read(&uniform).mesh, read(PLATE).mesh);
    let copy = PLATE.to_owned() + "*NCOPY, OLD SET=All, CHANGE NUMBER=100, POLE\n";
    assert!(refusal(&copy).starts_with("line 16: *NCOPY with POLE"));
}
