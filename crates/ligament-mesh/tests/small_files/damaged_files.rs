//! One damaged or unfit file for each refusal of the reader, with the place it is refused at.

use super::square::{SQUARE, SQUARE_41, golden, refusal, refusal_of};
use ligament_mesh::Remark;
use ligament_mesh::gmsh::{FilePosition, GmshError, parse};

fn unexpected(line: usize, expected: &'static str, found: &str) -> GmshError {
    GmshError::Unexpected {
        place: FilePosition::Line(line),
        expected,
        found: found.to_owned(),
    }
}

#[test]
fn the_squares_are_read() {
    for square in [SQUARE, SQUARE_41] {
        let mesh = parse(square.as_bytes()).unwrap();
        assert_eq!(
            (mesh.positions.len(), mesh.cells.len(), mesh.area()),
            (4, 2, 1.0)
        );
        assert_eq!(
            parse(square.replace('\n', "\r\n").as_bytes()).unwrap(),
            mesh
        );
    }
}

#[test]
fn empty_files_and_other_files_are_refused() {
    assert_eq!(parse(b""), Err(GmshError::Empty));
    assert_eq!(parse(b" \n\n"), Err(GmshError::Empty));
    assert_eq!(parse(b"Point(1) = {0, 0, 0};\n"), Err(GmshError::NotGmsh));
    assert_eq!(parse(b"\x7fELF\x00\xff\n"), Err(GmshError::NotGmsh));
    assert_eq!(parse(b"$Nodes\n0\n$EndNodes\n"), Err(GmshError::NotGmsh));
}

#[test]
fn other_versions_are_refused_with_the_command_that_converts() {
    let place = FilePosition::Line(2);
    let error = refusal("2.2 0 8", "4 0 8");
    assert_eq!(
        error,
        GmshError::UnsupportedVersion {
            place,
            version: "4".to_owned()
        }
    );
    assert!(error.to_string().contains("-format msh41"), "{error}");
    for (name, line, version) in [
        ("refused-version-1.msh", 1, "1"),
        ("refused-version-4.msh", 2, "4"),
    ] {
        let (bytes, _) = golden(name, "$");
        let place = FilePosition::Line(line);
        let expected = GmshError::UnsupportedVersion {
            place,
            version: version.to_owned(),
        };
        assert_eq!(parse(&bytes), Err(expected));
    }
}

#[test]
fn odd_encodings_are_refused() {
    assert_eq!(
        refusal("2.2 0 8", "2.2 2 8"),
        unexpected(2, "the file type 0 (ASCII) or 1 (binary)", "2")
    );
    let expected = GmshError::UnsupportedDataSize {
        place: FilePosition::Line(2),
        bytes: 4,
    };
    assert_eq!(refusal("2.2 0 8", "2.2 1 4"), expected);
    let (mut bytes, at) = golden("triangles-41-binary.msh", "$EndMeshFormat");
    bytes[at - 5..at - 1].copy_from_slice(&[0, 1, 0, 0]);
    assert_eq!(
        parse(&bytes),
        Err(GmshError::UnknownByteOrder {
            place: FilePosition::Byte(at - 5)
        })
    );
}

/// The format says so: sections with another name are ignored. Those on the body are named, if need be several times, in a binary file
/// by their offset.
#[test]
fn unknown_sections_are_ignored_with_a_remark() {
    let mesh = parse(SQUARE.as_bytes()).unwrap();
    let (before, behind) = SQUARE.split_at(SQUARE.find("$Elements").unwrap());
    let colours = "$Colours\n$ 3\n$EndColoursOfOther\n$EndColours\n";
    let text = format!("{before}{colours}{behind}{colours}$Ears\n$EndEars\n");
    let mut read = parse(text.as_bytes()).unwrap();
    let sections = [("Colours", 11), ("Ears", 25)];
    let sections = sections.map(|(name, line)| (name.to_owned(), FilePosition::Line(line)));
    let expected = Remark::IgnoredSections {
        sections: sections.to_vec(),
        others: 0,
    };
    assert_eq!(std::mem::take(&mut read.remarks), [expected]);
    assert_eq!(read, mesh);
    let (mut bytes, _) = golden("triangles-22-binary.msh", "$");
    let expected = parse(&bytes).unwrap();
    let at = FilePosition::Byte(bytes.len());
    bytes.extend(b"$Colours\n\0$End\n$EndColours\n");
    let read = parse(&bytes).unwrap();
    let remark = format!("the section $Colours ({at}) was ignored: nothing in it is used");
    assert_eq!(read.remarks.last().unwrap().to_string(), remark);
    assert_eq!((read.cells, read.groups), (expected.cells, expected.groups));
    // Text between sections is no section.
    assert_eq!(
        refusal("$EndNodes\n", "$EndNodes\n7\n"),
        unexpected(11, "the $ of a section", "\"7\"")
    );
}

#[test]
fn sections_without_effect_need_no_remark() {
    let mesh = parse(SQUARE.as_bytes()).unwrap();
    let comments = "$Comments\n$Nodes costs $ 3\n$EndComments\n";
    assert_eq!(
        parse(format!("{comments}{SQUARE}").as_bytes()).unwrap(),
        mesh
    );
    let with = |name: &str| {
        let section = format!("${name}\n0\n$End{name}OfOther\n$End{name}\n");
        parse(format!("{SQUARE}{section}").as_bytes()).unwrap()
    };
    for name in [
        "GhostElements",
        "InterpolationScheme",
        "MeshVersion",
        "Parametrizations",
    ] {
        assert_eq!(with(name), mesh, "{name}");
    }
    for name in ["ElementData", "ElementNodeData", "Periodic"] {
        let mut read = with(name);
        let remark = read.remarks.remove(0).to_string();
        assert!(remark.contains(&format!("${name} (line 17)")), "{remark}");
        assert_eq!(read, mesh, "{name}");
    }
}

#[test]
fn truncated_sections_are_refused() {
    let truncated = |end: &str, line, name: &str| {
        // Long enough that the counts could be right.
        let square = SQUARE.replace("1 0 0 0", "1 0.00000000000000000 0 0");
        let text = &square[..square.find(end).unwrap() + end.len()];
        let expected = GmshError::TruncatedSection {
            place: FilePosition::Line(line),
            name: name.to_owned(),
        };
        assert_eq!(parse(text.as_bytes()), Err(expected), "cut behind {end:?}");
    };
    truncated("$MeshFormat\n2.2 0", 1, "MeshFormat");
    truncated("3 1 1", 4, "Nodes");
    truncated("4 0 1 0\n$EndNo", 4, "Nodes");
    truncated("3 2 2 2 1 1 3", 11, "Elements");
    truncated("1 1 3 4\n", 11, "Elements");
    let error = parse(format!("{SQUARE}$NodeData\n1\n").as_bytes()).unwrap_err();
    let expected = GmshError::TruncatedSection {
        place: FilePosition::Line(17),
        name: "NodeData".to_owned(),
    };
    assert_eq!(error, expected);
}

#[test]
fn truncated_binary_sections_are_refused_at_their_offset() {
    let (bytes, at) = golden("triangles-41-binary.msh", "$Entities");
    let error = parse(&bytes[..at + 100]).unwrap_err();
    let expected = GmshError::TruncatedSection {
        place: FilePosition::Byte(at),
        name: "Entities".to_owned(),
    };
    assert_eq!(error, expected);
}

#[test]
fn no_part_of_a_file_makes_a_mesh() {
    for name in [
        "triangles-22.msh",
        "triangles-22-binary.msh",
        "mixed-41.msh",
        "mixed-41-binary.msh",
    ] {
        let (bytes, _) = golden(name, "$");
        // Without its last byte, the end of a line, a file is whole.
        for length in 0..bytes.len() - 1 {
            assert!(
                parse(&bytes[..length]).is_err(),
                "{name}: first {length} bytes"
            );
        }
        assert!(parse(&bytes[..bytes.len() - 1]).is_ok());
    }
}

#[test]
fn missing_sections_are_refused() {
    let (head, elements) = SQUARE.split_at(SQUARE.find("$Elements").unwrap());
    assert_eq!(
        parse(head.as_bytes()),
        Err(GmshError::MissingSection { name: "Elements" })
    );
    let format = &SQUARE[..SQUARE.find("$Nodes").unwrap()];
    let error = parse(format!("{format}{elements}").as_bytes());
    assert_eq!(error, Err(GmshError::MissingSection { name: "Nodes" }));
}

#[test]
fn wrong_words_are_refused_with_what_was_expected() {
    assert_eq!(
        refusal("2 1 0 0\n", "2 1 x 0\n"),
        unexpected(7, "a coordinate", "\"x\"")
    );
    assert_eq!(
        refusal("2 1 0 0\n", "2 1 0\n"),
        unexpected(7, "a coordinate", "the end of the line")
    );
    assert_eq!(
        refusal("2 1 0 0\n", "2 1 0 0 9\n"),
        unexpected(7, "the end of the line", "\"9\"")
    );
    assert_eq!(
        refusal("2 1 0 0\n", "-2 1 0 0\n"),
        unexpected(7, "a node number", "-2")
    );
    assert_eq!(
        refusal("$Nodes\n4", "$Nodes\nfour"),
        unexpected(5, "the number of nodes", "\"four\"")
    );
    let error = refusal("$Nodes\n4", "$Nodes\n3");
    assert_eq!(
        error,
        unexpected(9, "the end of the section", "\"4 0 1 0\"")
    );
    let error = refusal_of(SQUARE_41, "2 1 0 4", "4 1 0 4");
    assert_eq!(error, unexpected(6, "an entity dimension from 0 to 3", "4"));
    let error = refusal_of(SQUARE_41, "1 1 1 1\n", "0 1 1 1\n");
    assert_eq!(
        error,
        unexpected(18, "an element type of the dimension of its entity", "1")
    );
    let names = "$PhysicalNames\n1\n1 left\n$EndPhysicalNames\n$Nodes\n";
    let expected = "a dimension, a number and a name in quotes";
    assert_eq!(
        refusal("$Nodes\n", names),
        unexpected(6, expected, "\"1 left\"")
    );
}

#[test]
fn counts_that_the_file_cannot_hold_are_refused() {
    let beyond = |line, items, count| {
        Err(GmshError::CountBeyondFile {
            place: FilePosition::Line(line),
            items,
            count,
        })
    };
    let huge = u64::MAX;
    let text = SQUARE.replace("$Nodes\n4", &format!("$Nodes\n{huge}"));
    assert_eq!(parse(text.as_bytes()), beyond(5, "nodes", huge));
    let text = SQUARE.replace("$Elements\n3", "$Elements\n4000000000");
    assert_eq!(
        parse(text.as_bytes()),
        beyond(12, "elements", 4_000_000_000)
    );
    let text = SQUARE_41.replace("2 1 0 4", "2 1 0 99999999999");
    assert_eq!(parse(text.as_bytes()), beyond(6, "nodes", 99_999_999_999));
    let text = SQUARE_41.replace("2 1 2 2\n", "2 1 2 99999999999\n");
    assert_eq!(
        parse(text.as_bytes()),
        beyond(20, "elements", 99_999_999_999)
    );
    let names = format!("$PhysicalNames\n{huge}\n1 1 \"left\"\n$EndPhysicalNames\n$Nodes\n");
    let text = SQUARE.replace("$Nodes\n", &names);
    assert_eq!(parse(text.as_bytes()), beyond(5, "physical names", huge));
    // Entities are not counted ahead of reading them.
    let entities = format!("$Entities\n{huge} 0 0 0\n$EndEntities\n$Nodes\n");
    let error = refusal_of(SQUARE_41, "$Nodes\n", &entities);
    assert_eq!(error, unexpected(6, "an entity tag", "\"$EndEntities\""));
}

#[test]
fn blocks_beyond_the_count_are_refused_in_binary_files() {
    let (mut bytes, at) = golden("meshio-plain-22-binary.msh", "$Elements");
    // One block of four triangles.
    let count = at + "$Elements\n".len();
    bytes[count] = b'3';
    let place = FilePosition::Byte(count);
    let expected = GmshError::CountMismatch {
        place,
        items: "elements",
        announced: 3,
        found: 4,
    };
    assert_eq!(parse(&bytes), Err(expected));
}

#[test]
fn counts_that_lie_are_refused_in_binary_files() {
    let (mut bytes, at) = golden("triangles-22-binary.msh", "$Elements");
    // "$Elements\n", the count in two digits, the end of its line, the element type.
    let count = at + "$Elements\n99\n".len() + 4;
    bytes[count..count + 4].copy_from_slice(&i32::MAX.to_le_bytes());
    let expected = GmshError::CountBeyondFile {
        place: FilePosition::Byte(count),
        items: "elements",
        count: i32::MAX as u64,
    };
    assert_eq!(parse(&bytes), Err(expected));

    let (mut bytes, at) = golden("mixed-41-binary.msh", "$Nodes");
    let total = at + "$Nodes\n".len() + 8;
    bytes[total..total + 8].copy_from_slice(&7_u64.to_le_bytes());
    let expected = GmshError::CountMismatch {
        place: FilePosition::Byte(total - 8),
        items: "nodes",
        announced: 7,
        found: 22,
    };
    assert_eq!(parse(&bytes), Err(expected));
}

#[test]
fn blocks_that_hold_another_number_are_refused() {
    let error = refusal_of(SQUARE_41, "1 4 1 4", "1 5 1 5");
    let place = FilePosition::Line(5);
    assert_eq!(
        error,
        GmshError::CountMismatch {
            place,
            items: "nodes",
            announced: 5,
            found: 4
        }
    );
    let error = refusal_of(SQUARE_41, "2 3 1 3", "1 3 1 3");
    let place = FilePosition::Line(17);
    assert_eq!(
        error,
        GmshError::CountMismatch {
            place,
            items: "elements",
            announced: 3,
            found: 1
        }
    );
}
