//! Words: doc comments that can be read without their neighbours, names of functions, cited sources, links of pages.
#![allow(clippy::unwrap_used, reason = "a failed unwrap fails the test")]

use std::collections::BTreeSet;
use std::ffi::OsStr;
use std::fs;
use std::path::{Path, PathBuf};

use ligament_model::law::LAWS;
use verification::repository;

/// Words at the start of a doc comment that point at something beside it.
const POINTING: [&str; 13] = [
    "They ",
    "Them ",
    "Those ",
    "The same ",
    "That ",
    "It ",
    "Its ",
    "Their ",
    "Theirs ",
    "Which ",
    "Who ",
    "These ",
    "Likewise",
];

/// Examples in comments that look like sources.
const NO_SOURCES: [&str; 1] = ["Author 2019"];

/// The files below a folder that end in `.extension`, in order.
fn files(folder: &Path, extension: &str) -> Vec<PathBuf> {
    let mut found = Vec::new();
    let mut folders = vec![folder.to_owned()];
    while let Some(folder) = folders.pop() {
        for entry in fs::read_dir(folder).unwrap() {
            let path = entry.unwrap().path();
            if path.is_dir() {
                folders.push(path);
            } else if path.extension() == Some(OsStr::new(extension)) {
                found.push(path);
            }
        }
    }
    found.sort();
    found
}

/// Source files of the crates, their tests and benchmarks apart: the name of the crate, the path below `crates`, the text.
fn sources() -> Vec<(String, String, String)> {
    let crates = repository().join("crates");
    let file = |path: PathBuf| {
        let below = path.strip_prefix(&crates).unwrap();
        let name = below.iter().next().unwrap().to_str().unwrap().to_owned();
        (
            name,
            below.display().to_string(),
            fs::read_to_string(&path).unwrap(),
        )
    };
    let mut found: Vec<_> = files(&crates, "rs").into_iter().map(file).collect();
    found.retain(|(name, path, _)| path.starts_with(&format!("{name}/src/")));
    assert!(found.len() > 200, "the sources were not found");
    found
}

/// The text of a line of a comment that documents the item below it; none for any other line.
fn doc(line: &str) -> Option<&str> {
    let text = line.trim_start().strip_prefix("///")?;
    Some(text.strip_prefix(' ').unwrap_or(text))
}

/// The places of a file whose doc comment begins with a pointing word, or tells that something "is told".
fn pointing(path: &str, text: &str) -> Vec<String> {
    let mut before = None;
    let mut found = Vec::new();
    for (number, line) in (1..).zip(text.lines()) {
        let now = doc(line);
        let begins = before.is_none()
            && now.is_some_and(|text| POINTING.iter().any(|word| text.starts_with(word)));
        let tells =
            now.is_some_and(|text| ["is told", "are told"].iter().any(|w| text.contains(w)));
        if begins || tells {
            found.push(format!("{path}:{number}: {}", line.trim()));
        }
        before = now;
    }
    found
}

/// Every doc comment begins with what the item is, and no function is called `of`: its name says what it gives.
#[test]
fn comments_and_names_can_be_read_alone() {
    let mut found = Vec::new();
    for (_, path, text) in sources() {
        found.extend(pointing(&path, &text));
        let named = (1..)
            .zip(text.lines())
            .filter(|(_, line)| line.contains("fn of("));
        found.extend(named.map(|(number, line)| format!("{path}:{number}: {}", line.trim())));
    }
    assert!(found.is_empty(), "say what it is:\n{}", found.join("\n"));
}

/// What a law is stands in its row: no match asks for its word anywhere else.
#[test]
fn laws_are_asked_for_what_they_are() {
    let mut found = Vec::new();
    for (_, path, text) in sources() {
        let word_in_pattern = |line: &str| {
            LAWS.iter().any(|law| {
                let word = law.quoted();
                let patterns = [
                    format!("{word} =>"),
                    format!("{word} |"),
                    format!("| {word}"),
                ];
                patterns.iter().any(|pattern| line.contains(pattern))
            })
        };
        let lines = (1..).zip(text.lines());
        let matching = lines.filter(|(_, line)| word_in_pattern(line));
        found.extend(matching.map(|(number, line)| format!("{path}:{number}: {}", line.trim())));
    }
    found.retain(|place| !place.starts_with("ligament-model/src/law/"));
    assert!(
        found.is_empty(),
        "ask the row of the law:\n{}",
        found.join("\n")
    );
}

/// The keys of docs/references.md: the first cells of its tables.
fn keys() -> BTreeSet<String> {
    let text = fs::read_to_string(repository().join("docs/references.md")).unwrap();
    let cells = text
        .lines()
        .filter_map(|line| line.strip_prefix("| ")?.split(" |").next());
    let keys: BTreeSet<String> = cells
        .filter(|cell| *cell != "key")
        .map(str::to_owned)
        .collect();
    assert!(keys.contains("NHPD") && keys.len() > 20, "{keys:?}");
    keys
}

/// The sources that a comment cites: `Silling and Askari 2005`, `Tada 2000`, `NHPD eq. 12`.
fn cited(comment: &str) -> Vec<String> {
    let words: Vec<&str> = comment
        .split(|c: char| c.is_whitespace() || "()[]`;:,".contains(c))
        .map(|word| word.trim_end_matches(['.', '\'']))
        .filter(|word| !word.is_empty())
        .collect();
    let is_name = |word: &str| {
        word.len() > 1
            && word.starts_with(char::is_uppercase)
            && word.chars().all(|c| c.is_alphabetic() || c == '-')
    };
    let is_year = |word: &str| {
        word.len() == 4
            && word
                .parse::<u32>()
                .is_ok_and(|year| (1900..2030).contains(&year))
    };
    let mut found = Vec::new();
    for (place, word) in words.iter().enumerate().skip(1) {
        let name = words[place - 1];
        if !is_name(name) {
            continue;
        }
        if is_year(word) {
            let first = place.checked_sub(3).map(|first| words[first]);
            match first {
                Some(first) if words[place - 2] == "and" && is_name(first) => {
                    found.push(format!("{first} and {name} {word}"));
                }
                _ => found.push(format!("{name} {word}")),
            }
        } else if ["eq", "eqs"].contains(word) {
            found.push(name.to_owned());
        }
    }
    found
}

#[test]
fn citations_are_found() {
    assert_eq!(
        cited("as (Silling and Askari (2005, eq. 3); Tada 2000; NHPD eqs 14 to 16, see eq. 2."),
        ["Silling and Askari 2005", "Tada 2000", "NHPD"]
    );
}

/// Whatever comments cite has its entry in docs/references.md.
#[test]
fn every_source_has_its_reference() {
    let keys = keys();
    let mut missing = BTreeSet::new();
    let mut count = 0;
    for (_, path, text) in sources() {
        // A citation may run over the end of a line.
        let comments: Vec<&str> = (text.lines().map(str::trim_start))
            .filter(|line| line.starts_with("//"))
            .map(|line| line.trim_start_matches(['/', '!']))
            .collect();
        for source in cited(&comments.join(" ")) {
            count += 1;
            if !keys.contains(&source) && !NO_SOURCES.contains(&source.as_str()) {
                missing.insert(format!("{source} in {path}"));
            }
        }
    }
    assert!(count > 50, "only {count} citations found");
    assert!(
        missing.is_empty(),
        "not in docs/references.md: {missing:#?}"
    );
}

/// Paths of all pages, the lists of changes apart, which name what was there.
fn pages() -> Vec<PathBuf> {
    let root = repository();
    let mut pages: Vec<PathBuf> = ["README.md", "ARCHITECTURE.md", "CONTRIBUTING.md"]
        .map(|name| root.join(name))
        .into();
    for folder in ["docs", "cases", "meshes", "tools"] {
        pages.extend(files(&root.join(folder), "md"));
    }
    let is_list = |it: &Path| it.to_str().unwrap().contains("/docs/changes-");
    pages.retain(|it| !is_list(it));
    assert!(pages.len() > 30, "the pages were found");
    pages
}

/// What a page sets in code within its sentences.
fn code_spans(page: &str) -> Vec<&str> {
    let outside_blocks = page.split("```").step_by(2);
    outside_blocks
        .flat_map(|text| text.split('`').skip(1).step_by(2))
        .collect()
}

/// Files, modules and functions that pages name are there: a path is the end of that of a file, and each word of a path of modules names a file, a
/// folder or an item, behind the name of a crate of that crate.
#[test]
fn names_in_pages_exist() {
    let root = repository();
    let folders = ["crates", "tests", "tools"].map(|it| root.join(it));
    let paths = ["rs", "py", "js"].map(|it| folders.each_ref().map(|folder| files(folder, it)));
    let paths = paths.as_flattened().concat();
    let words: Vec<(&PathBuf, BTreeSet<String>)> =
        paths.iter().map(|it| (it, names_of(it))).collect();
    let is_file = |span: &str| paths.iter().any(|it| it.ends_with(span));
    let names = |word: &str, folder: &Path| {
        let within = words.iter().filter(|(path, _)| path.starts_with(folder));
        within.into_iter().any(|(_, words)| words.contains(word))
    };
    let exists = |span: &str| {
        let path: Vec<&str> = span.trim_end_matches("()").split("::").collect();
        let folder = root.join("crates").join(path[0].replace('_', "-"));
        let (within, path) = match folder.is_dir() {
            true => (&folder, &path[1..]),
            false => (&root, &path[..]),
        };
        path.iter().all(|word| names(word, within))
    };
    let mut missing = Vec::new();
    for page in pages() {
        let text = fs::read_to_string(&page).unwrap();
        for span in code_spans(&text) {
            let is_path = [".rs", ".py", ".js"].iter().any(|it| span.ends_with(it));
            let is_item = span.contains("::") || span.ends_with("()");
            let is_name = |it: char| it.is_alphanumeric() || "_/.:()-".contains(it);
            // Paths for a new file have a word in capitals for its name, and methods of other packages begin with a dot.
            let is_other = span.contains("NAME") || span.starts_with('.');
            if !(is_path || is_item) || !span.chars().all(is_name) || is_other {
                continue;
            }
            let is_there = if is_path { is_file(span) } else { exists(span) };
            if !is_there {
                missing.push(format!("{}: {span}", page.display()));
            }
        }
    }
    assert!(missing.is_empty(), "{missing:#?}");
}

/// Names that a source file defines, those of variants among them, and the names of the file and of its folders.
fn names_of(path: &Path) -> BTreeSet<String> {
    const BEFORE_NAMES: [&str; 11] = [
        "class", "const", "def", "enum", "fn", "function", "mod", "static", "struct", "trait",
        "type",
    ];
    let text = fs::read_to_string(path).unwrap();
    let code = (text.lines()).filter(|line| !line.trim_start().starts_with("//"));
    let words: Vec<&str> = code
        .flat_map(|line| line.split(|it: char| !(it.is_alphanumeric() || it == '_')))
        .filter(|it| !it.is_empty())
        .collect();
    let named = words
        .windows(2)
        .filter(|pair| BEFORE_NAMES.contains(&pair[0]));
    let variants = words.iter().filter(|it| it.starts_with(char::is_uppercase));
    let below = path.strip_prefix(repository()).unwrap();
    let of_path = below.iter().filter_map(|it| it.to_str());
    let of_path = of_path.map(|it| it.split('.').next().unwrap_or(it));
    let all = named
        .map(|pair| pair[1])
        .chain(variants.copied())
        .chain(of_path);
    all.map(str::to_owned).collect()
}

/// Links between the pages of the repository lead somewhere.
#[test]
fn links_lead_somewhere() {
    let mut broken = Vec::new();
    for page in &pages() {
        let text = fs::read_to_string(page).unwrap();
        for link in text
            .split("](")
            .skip(1)
            .filter_map(|rest| rest.split([')', ' ']).next())
        {
            let (file, anchor) = link.split_once('#').unwrap_or((link, ""));
            if link.starts_with("http") {
                continue;
            }
            let mut target = match file {
                "" => page.clone(),
                file => page.parent().unwrap().join(file),
            };
            if target.is_dir() && !anchor.is_empty() {
                target.push("README.md");
            }
            let leads = if anchor.is_empty() {
                target.exists()
            } else {
                fs::read_to_string(&target).is_ok_and(|text| anchors(&text).contains(anchor))
            };
            if !leads {
                broken.push(format!("{}: {link}", page.display()));
            }
        }
    }
    assert!(broken.is_empty(), "{broken:#?}");
}

/// The anchors that the headings of a page make.
fn anchors(page: &str) -> BTreeSet<String> {
    let headings = page.lines().filter(|line| line.starts_with('#'));
    let kept = |c: char| c.is_alphanumeric() || c == ' ' || c == '-' || c == '_';
    headings
        .map(|line| line.trim_start_matches('#').trim().to_lowercase())
        .map(|line| line.chars().filter(|&c| kept(c)).collect::<String>())
        .map(|line| line.replace(' ', "-"))
        .collect()
}
