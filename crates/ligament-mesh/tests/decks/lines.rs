//! Lines: their continuation, comments, letters of either case, numbers, included files, keywords that are kept.

use std::io;

use super::{NODES, SQUARES, group, labels, line, no_files, plane, read, refusal, with_squares};
use ligament_mesh::inp::{InpError, Scope, number, parse};
use ligament_mesh::{FileLine, Remark};

#[test]
fn lines_go_on_and_blanks_and_letters_do_not_matter() {
    let deck = read(
        "\u{feff}** a comment before all
 * node ,
** a comment within a keyword
  nset = All nodes
 1 , 0. ,\t0D0,
2, 2.5D-1\r
3, .25E0, 0.25, 0.
** a comment between data

*Element, type=cps3,
ELSET=Plate
7, 1,
2,
3
*nset, NSET=\"corner, low\"
1,
",
    );
    let mesh = plane(&deck);
    assert_eq!(mesh.positions, [[0.0, 0.0], [0.25, 0.0], [0.25, 0.25]]);
    assert_eq!(labels(&deck, "ALL NODES"), [1, 2, 3]);
    assert_eq!(group(&deck, "plate").cells, [0]);
    assert_eq!(group(&deck, "plate").name, "Plate");
    assert_eq!(labels(&deck, "\"Corner, low\""), [1]);
    assert_eq!(mesh.remarks, []);
}

/// A comma behind a keyword that data follow is no continuation.
#[test]
fn data_do_not_go_on_a_keyword() {
    let deck = with_squares("*NSET, NSET=Low,\n1, 2, 3\n");
    assert_eq!(labels(&deck, "low"), [1, 2, 3]);
}

#[test]
fn included_files_stand_where_they_are_included() {
    let mut asked = Vec::new();
    let mut files = |name: &str| -> io::Result<Vec<u8>> {
        asked.push(name.to_owned());
        match name {
            "nodes.dat" => Ok(NODES.replace("*NODE\n", "").into_bytes()),
            "more.inc" => Ok(format!("{SQUARES}*INCLUDE, INPUT=low set.inc\n").into_bytes()),
            "low set.inc" => Ok(b"*NSET, NSET=Low\n1, 2\n".to_vec()),
            other => no_files(other),
        }
    };
    let text = "*NODE\n*INCLUDE, INPUT=nodes.dat\n10, 5, 5\n*include, input=more.inc\n3\n*NSET, NSET=High\n9\n";
    let deck = parse(text.as_bytes(), &mut files).unwrap();
    assert_eq!(labels(&deck, "Low"), [1, 2, 3]);
    assert_eq!(labels(&deck, "High"), [9]);
    assert_eq!(deck.mesh.remarks(), [Remark::UnusedNodes { nodes: 1 }]);
    // Data of a block from a file.
    let text = format!("*NODE, INPUT=nodes.dat, NSET=All\n{SQUARES}");
    let deck = parse(text.as_bytes(), &mut files).unwrap();
    assert_eq!(group(&deck, "All").nodes.len(), 9);
    assert_eq!(asked, ["nodes.dat", "more.inc", "low set.inc", "nodes.dat"]);
}

#[test]
fn errors_in_included_files_name_them() {
    let mut files = |_: &str| Ok(b"\n1, 0, x\n".to_vec());
    let error = parse(b"*NODE\n*INCLUDE, INPUT=a.inc\n", &mut files).unwrap_err();
    let InpError::Unexpected { line, .. } = &error else {
        panic!("{error}")
    };
    let file = Some("a.inc".into());
    assert_eq!(line, &FileLine { file, number: 2 });
    assert!(
        error.to_string().starts_with("line 2 of a.inc: "),
        "{error}"
    );
    let error = parse(b"*HEADING\n*INCLUDE, INPUT=b.inc\n", &mut no_files).unwrap_err();
    let InpError::UnreadableInclude { line: at, file, .. } = error else {
        panic!("{error}")
    };
    assert_eq!((at, file.as_str()), (line_2(), "b.inc"));
    let mut endless = |_: &str| Ok(b"*INCLUDE, INPUT=a.inc\n".to_vec());
    let error = parse(b"*INCLUDE, INPUT=a.inc\n", &mut endless).unwrap_err();
    assert!(error.to_string().contains("include each other"), "{error}");
    assert!(refusal("*INCLUDE\n").contains("INPUT"));
}

fn line_2() -> FileLine {
    line(2)
}

#[test]
fn other_keywords_are_kept() {
    let deck = with_squares(
        "*Material, name=Steel
*ELASTIC, Type = Isotropic
** Young's modulus and Poisson's ratio
2.1D11 , .3

*Part, name=Loose
*Solid  Section, elset=A, material=Steel
*End Part
*ELASTIC
1.,
",
    );
    let names: Vec<&str> = deck.keywords.iter().map(|it| it.name.as_str()).collect();
    assert_eq!(names, ["MATERIAL", "ELASTIC", "SOLID SECTION", "ELASTIC"]);
    let material = deck.keywords[0].parameter("NAME").unwrap();
    assert_eq!(material.value.as_deref(), Some("Steel"));
    let elastic = &deck.keywords[1];
    assert!(elastic.is("elastic") && !elastic.is("PLASTIC"));
    assert_eq!((elastic.line.clone(), elastic.data.len()), (line(17), 1));
    assert_eq!(elastic.data[0].line, line(19));
    let fields = elastic.data[0].fields();
    assert_eq!(fields, ["2.1D11", ".3"]);
    assert_eq!(number(&fields[0]), Some(2.1e11));
    assert_eq!(elastic.scope, Scope::Model);
    let section = &deck.keywords[2];
    assert!(section.is("solidsection"));
    assert_eq!(section.scope, Scope::Part("Loose".to_owned()));
    let kinds: Vec<_> = deck.other_keywords().into_iter().collect();
    assert_eq!(kinds[0], ("ELASTIC", (2, &line(17))));
    assert_eq!(kinds.len(), 3);
}
