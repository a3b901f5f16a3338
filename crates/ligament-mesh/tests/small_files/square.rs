//! A square of two triangles, to be damaged.

use std::fs;
use std::path::Path;

use ligament_mesh::gmsh::{GmshError, parse};

/// A square of two triangles in format 2.2; its node rows are lines 6 to 9, its elements 13 to 15.
pub(crate) const SQUARE: &str = "$MeshFormat
2.2 0 8
$EndMeshFormat
$Nodes
4
1 0 0 0
2 1 0 0
3 1 1 0
4 0 1 0
$EndNodes
$Elements
3
1 1 2 1 1 1 2
2 2 2 2 1 1 2 3
3 2 2 2 1 1 3 4
$EndElements
";

/// The same in format 4.1; nodes are lines 5 to 14, elements 17 to 22.
pub(crate) const SQUARE_41: &str = "$MeshFormat
4.1 0 8
$EndMeshFormat
$Nodes
1 4 1 4
2 1 0 4
1
2
3
4
0 0 0
1 0 0
1 1 0
0 1 0
$EndNodes
$Elements
2 3 1 3
1 1 1 1
1 1 2
2 1 2 2
2 1 2 3
3 1 3 4
$EndElements
";

/// The refusal of the square with `old` replaced by `new`.
pub(crate) fn refusal_of(square: &str, old: &str, new: &str) -> GmshError {
    assert_eq!(
        square.matches(old).count(),
        1,
        "{old:?} must stand once in the file"
    );
    parse(square.replace(old, new).as_bytes()).unwrap_err()
}

pub(crate) fn refusal(old: &str, new: &str) -> GmshError {
    refusal_of(SQUARE, old, new)
}

/// A file of the golden data, and where its marked text begins.
pub(crate) fn golden(name: &str, mark: &str) -> (Vec<u8>, usize) {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/data");
    let bytes = fs::read(folder.join(name)).unwrap();
    let at = bytes
        .windows(mark.len())
        .position(|window| window == mark.as_bytes())
        .unwrap();
    (bytes, at)
}
