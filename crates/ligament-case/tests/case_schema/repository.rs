//! The cases and the documents of the repository.

use std::path::{Path, PathBuf};

use ligament_case::case::CaseFile;
use ligament_case::case::keys::rows;

use super::documents::all_of_schema;
use super::{document, objection};

pub(super) fn root() -> PathBuf {
    PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("../..")
}

/// Case files of a folder and those below it: TOML with a `[model]`.
fn cases(folder: &Path) -> Vec<PathBuf> {
    let mut found = Vec::new();
    for entry in std::fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        if path.is_dir() {
            found.extend(cases(&path));
        } else if path.extension().is_some_and(|it| it == "toml")
            && document(&std::fs::read_to_string(&path).unwrap())
                .get("model")
                .is_some()
        {
            found.push(path);
        }
    }
    found
}

/// Every case is valid, as it was written and with all of its settings filled in.
#[test]
fn every_case_is_valid() {
    let cases = cases(&root().join("cases"));
    assert!(cases.len() > 40, "{} cases", cases.len());
    for path in cases {
        let case = CaseFile::load(&path, &[]).unwrap();
        for text in [&case.source.text, &case.resolved_toml().unwrap()] {
            let objection = objection(&document(text));
            assert_eq!(objection, None, "{}:\n{text}", path.display());
        }
    }
}

/// A line that leads an editor to the schema is a comment to the reader.
#[test]
fn the_line_for_editors_is_a_comment() {
    let path = root().join("cases/plate-tension/case.toml");
    let text = std::fs::read_to_string(&path).unwrap();
    let case = CaseFile::parse(&path, text.clone(), &[]).unwrap();
    let led = format!("#:schema ./case.schema.json\n{text}");
    let with_line = CaseFile::parse(&path, led, &[]).unwrap();
    assert_eq!(with_line.case, case.case);
    let (line, _) = case.locate("model.law").unwrap();
    assert_eq!(with_line.locate("model.law").unwrap().0, line + 1);
}

/// The list of keys with its tables, between two lines of comment each, made anew.
fn listed(text: &str) -> String {
    let (mut made, mut is_in_table) = (String::new(), false);
    for line in text.lines() {
        is_in_table &= line != "<!-- end of keys -->";
        if !is_in_table {
            made += &format!("{line}\n");
        }
        let path = line.strip_prefix("<!-- keys of ");
        if let Some(path) = path.and_then(|it| it.strip_suffix(" -->")) {
            is_in_table = true;
            made += "| key | is |\n|---|---|\n";
            for row in rows(path) {
                made += &format!("{row}\n");
            }
        }
    }
    made
}

/// The tables of cases/KEYS.md are those of the schema, and have all of its keys but those of the case as a whole. With
/// `LIGAMENT_WRITE_KEYS` in the environment they are written first.
#[test]
fn the_list_of_keys_is_that_of_the_schema() {
    let path = root().join("cases/KEYS.md");
    let mut text = std::fs::read_to_string(&path).unwrap();
    if std::env::var_os("LIGAMENT_WRITE_KEYS").is_some() {
        text = listed(&text);
        std::fs::write(&path, &text).unwrap();
    }
    let again = "make it anew: LIGAMENT_WRITE_KEYS=1 cargo test --release -p ligament-case --test integration case_schema";
    assert!(
        listed(&text) == text,
        "cases/KEYS.md is not what the keys say; {again}"
    );
    for (table, key, _) in all_of_schema().1 {
        let is_listed = text.contains(&format!(".{key}` | "));
        assert!(is_listed || table.is_empty(), "{table}/{key}: {again}");
    }
}
