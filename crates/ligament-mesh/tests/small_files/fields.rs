//! Values at nodes: what is read of `$NodeData`, and what is refused.

use super::square::{SQUARE, SQUARE_41, golden};
use ligament_mesh::gmsh::{self, FilePosition, GmshError};
use ligament_mesh::{Mesh, NodeField};

/// A scalar at nodes 1, 3 and at one that the file does not have; its rows are lines 26 to 28 behind the square.
const SCALAR: &str = "$NodeData
1
\"heat, \"\"first\"\"\"
1
0.5
3
7
1
3
1 20.5
3 -1e2
9 4
$EndNodeData
";

fn with(section: &str) -> Result<Mesh, GmshError> {
    gmsh::parse(format!("{SQUARE}{section}").as_bytes())
}

#[test]
fn scalars_stand_at_their_nodes() {
    let expected = NodeField {
        name: "heat, \"\"first\"\"".to_owned(),
        time_step: 7,
        components: 1,
        values: vec![(0, 20.5), (2, -100.0)],
    };
    for square in [SQUARE, SQUARE_41] {
        let mesh = gmsh::parse(format!("{square}{SCALAR}").as_bytes()).unwrap();
        assert_eq!(mesh.fields, std::slice::from_ref(&expected));
    }
}

/// The fourth integer tag is the partition; a section of vectors is read over.
#[test]
fn vectors_are_named_alone() {
    let vector = SCALAR
        .replace("3\n7\n1\n3\n", "4\n7\n3\n1\n0\n")
        .replace("1 20.5\n3 -1e2\n9 4\n", "2 1 2 3\n");
    let mesh = with(&format!("{vector}{SCALAR}")).unwrap();
    assert_eq!(mesh.fields.len(), 2);
    assert_eq!(mesh.fields[0].components, 3);
    assert_eq!(mesh.fields[0].values, []);
    assert_eq!(mesh.fields[1].components, 1);
}

/// Gmsh wrote the x coordinate as a view of that name: one field, the same bits in both formats and encodings.
#[test]
fn fields_of_gmsh_are_read_in_every_encoding() {
    for name in ["22", "22-binary", "41", "41-binary"] {
        let (bytes, _) = golden(&format!("periodic-{name}.msh"), "$NodeData");
        let mesh = gmsh::parse(&bytes).unwrap();
        let [field] = &mesh.fields[..] else {
            panic!("{name}: {} fields", mesh.fields.len());
        };
        assert_eq!((field.name.as_str(), field.components), ("x", 1), "{name}");
        let x: Vec<Option<f64>> = mesh.positions.iter().map(|p| Some(p[0])).collect();
        assert_eq!(field.at_nodes(x.len()), x, "{name}");
    }
}

#[test]
fn damaged_fields_are_refused_with_their_place() {
    let refused = |old: &str, new: &str| with(&SCALAR.replacen(old, new, 1)).unwrap_err();
    let unexpected = |line, expected, found: &str| GmshError::Unexpected {
        place: FilePosition::Line(line),
        expected,
        found: found.to_owned(),
    };
    assert_eq!(
        refused("1 20.5", "1 warm"),
        unexpected(26, "a value at a node", "\"warm\"")
    );
    assert_eq!(
        refused("1 20.5", "1 20.5 3"),
        unexpected(26, "the end of the line", "\"3\"")
    );
    assert_eq!(
        refused("3\n7\n1\n3\n", "2\n7\n1\n"),
        unexpected(
            22,
            "the integer tags time step, number of components, number of nodes",
            "2 of them"
        )
    );
    assert_eq!(
        refused("1\n3\n1 20.5", "1\n3000\n1 20.5"),
        GmshError::CountBeyondFile {
            place: FilePosition::Line(25),
            items: "values at nodes",
            count: 3000
        }
    );
    assert_eq!(
        refused("\n3\n1 20.5", "\n2\n1 20.5"),
        unexpected(28, "the end of the section", "\"9 4\"")
    );
}
