//! The cases and the documents of the repository.

use std::path::{Path, PathBuf};

use ligament_case::case::CaseFile;

use super::documents::all_of_schema;
use super::{document, objection};

fn root() -> PathBuf {
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
        for text in [&case.text, &case.resolved_toml().unwrap()] {
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

/// Every key is a word of KEYS.md or of the page on case files.
#[test]
fn every_key_is_in_the_documents() {
    let read = |name: &str| std::fs::read_to_string(root().join(name)).unwrap();
    let text = read("cases/KEYS.md") + &read("docs/case-file.md");
    let words: Vec<&str> = text
        .split(|it: char| !it.is_alphanumeric() && it != '_')
        .collect();
    let keys = all_of_schema().1.into_iter();
    let missing: Vec<String> = keys
        .filter(|(_, key, _)| !words.contains(&key.as_str()))
        .map(|(table, key, _)| format!("{table}/{key}"))
        .collect();
    assert!(
        missing.is_empty(),
        "not in cases/KEYS.md or docs/case-file.md: {missing:?}"
    );
}
