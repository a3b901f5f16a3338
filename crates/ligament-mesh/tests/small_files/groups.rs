//! Physical groups in the ways that files can give them.

use super::square::{SQUARE, SQUARE_41};
use ligament_mesh::{Mesh, Remark, gmsh};

/// The mesh of a square with `old` replaced by `new`.
fn changed(square: &str, old: &str, new: &str) -> Mesh {
    assert_eq!(
        square.matches(old).count(),
        1,
        "{old:?} must stand once in the file"
    );
    gmsh::parse(square.replace(old, new).as_bytes()).unwrap()
}

#[test]
fn a_negative_number_is_the_group_in_reversed_orientation() {
    let mesh = changed(SQUARE, "3 2 2 2 1 1 3 4", "3 2 2 -2 1 1 3 4");
    assert_eq!(mesh.group("2").unwrap().cells, [0, 1]);
    assert!(mesh.group("-2").is_none());
}

#[test]
fn an_element_without_tags_is_in_no_group() {
    let mesh = changed(SQUARE, "3 2 2 2 1 1 3 4", "3 2 0 1 3 4");
    assert_eq!(mesh.cells.len(), 2);
    assert_eq!(mesh.group("2").unwrap().cells, [0]);
}

#[test]
fn edges_are_ascending_and_each_once() {
    let edges = "1 1 2 1 1 2 3\n4 1 2 1 1 2 1\n5 1 2 1 1 1 2\n";
    let text = SQUARE.replace("$Elements\n3", "$Elements\n5");
    let mesh = changed(&text, "1 1 2 1 1 1 2\n", edges);
    assert_eq!(mesh.group("1").unwrap().edges, [[1, 0], [1, 2]]);
}

#[test]
fn cells_are_ascending_in_each_of_their_groups() {
    let cells = "3 2 2 2 1 1 3 4\n4 2 2 8 1 1 3 4\n5 2 2 8 1 1 2 3\n";
    let text = SQUARE
        .replace("3 2 2 2 1 1 3 4\n", cells)
        .replace("$Elements\n3", "$Elements\n5");
    let mesh = gmsh::parse(text.as_bytes()).unwrap();
    assert_eq!(mesh.cells.len(), 2);
    assert_eq!(mesh.group("8").unwrap().cells, [0, 1]);
}

#[test]
fn an_entity_that_names_a_group_twice_is_in_it_once() {
    let entities =
        "$Entities\n0 1 1 0\n1 0 0 0 0 0 0 0 0\n1 0 0 0 0 0 0 3 7 -7 3 0\n$EndEntities\n$Nodes\n";
    let mesh = changed(SQUARE_41, "$Nodes\n", entities);
    let numbers: Vec<i32> = mesh.groups.iter().map(|group| group.number).collect();
    assert_eq!(numbers, [3, 7]);
    assert!(mesh.groups.iter().all(|group| group.cells == [0, 1]));
    assert_eq!(mesh.remarks, []);
}

#[test]
fn names_may_hold_blanks_and_quotes_or_nothing() {
    let names = "$PhysicalNames\n2\n1 1 \"\"\n2 2 \"a \"b\" \u{e9}\"\n$EndPhysicalNames\n$Nodes\n";
    let mesh = changed(SQUARE, "$Nodes\n", names);
    let names: Vec<&str> = mesh
        .groups
        .iter()
        .map(|group| group.name.as_str())
        .collect();
    assert_eq!(names, ["1", "a \"b\" \u{e9}"]);
}

#[test]
fn the_node_on_a_side_of_an_edge_is_no_node_of_a_cell() {
    let text = SQUARE.replace("$Nodes\n4", "$Nodes\n5\n9 0.5 0 0");
    let mesh = changed(&text, "1 1 2 1 1 1 2", "1 8 2 1 1 1 2 9");
    assert_eq!(mesh.remarks, [Remark::UnusedNodes { nodes: 1 }]);
    assert_eq!(mesh.group("1").unwrap().edges, [[0, 1]]);
}
