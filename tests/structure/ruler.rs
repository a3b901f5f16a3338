//! How much code there is: tokens and short files of each crate against tables, and counts that show where it grows.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use verification::repository;

use super::trees;

/// Tokens of the crates. A rise fails until the number is changed in the same commit, whose message gives the reason.
const TOKENS: [(&str, usize); 16] = [
    ("ligament", 122_944),
    ("ligament-analysis", 207_287),
    ("ligament-case", 80_426),
    ("ligament-cli", 58_604),
    ("ligament-linalg", 28_982),
    ("ligament-mesh", 88_546),
    ("ligament-model", 230_472),
    ("ligament-output", 83_731),
    ("ligament-petsc", 2_978),
    ("ligament-plot", 60_418),
    ("ligament-post", 27_761),
    ("ligament-python", 14_676),
    ("ligament-report", 21_044),
    ("ligament-run", 31_989),
    ("ligament-study", 90_043),
    ("ligament-verify", 80_888),
];

/// Short files of the crates. The numbers may fall.
const SHORT_FILES: [(&str, usize); 16] = [
    ("ligament", 18),
    ("ligament-analysis", 11),
    ("ligament-case", 2),
    ("ligament-cli", 9),
    ("ligament-linalg", 2),
    ("ligament-mesh", 0),
    ("ligament-model", 24),
    ("ligament-output", 3),
    ("ligament-petsc", 0),
    ("ligament-plot", 2),
    ("ligament-post", 2),
    ("ligament-python", 2),
    ("ligament-report", 1),
    ("ligament-run", 5),
    ("ligament-study", 0),
    ("ligament-verify", 2),
];

/// Share of its number by which a crate may be smaller, so that a gain is written down before it is used up.
const UNWRITTEN: f64 = 0.01;

/// Lines below which a file is short: what it says may stand where it is used.
const SHORTEST_FILE: usize = 60;

/// Folders whose files are laws and criteria, one each: short by nature, as front pages of modules are.
const SHORT_BY_NATURE: [&str; 2] = ["ligament-model/src/law/", "ligament-model/src/failure/"];

/// A source file without tests.
struct Source {
    /// The crate that it belongs to.
    package: String,
    path: PathBuf,
    text: String,
}

/// The source files of all crates, without those that hold tests alone.
fn sources() -> Vec<Source> {
    let mut found = Vec::new();
    for folder in entries(&repository().join("crates")) {
        let mut open = vec![folder.join("src")];
        while let Some(path) = open.pop() {
            if path.is_dir() {
                open.extend(entries(&path).filter(|it| !it.ends_with("tests")));
            } else if path.extension().is_some_and(|it| it == "rs") && !path.ends_with("tests.rs") {
                found.push(Source {
                    package: folder.file_name().unwrap().to_str().unwrap().to_owned(),
                    text: std::fs::read_to_string(&path).unwrap(),
                    path,
                });
            }
        }
    }
    assert!(found.len() > 300, "the sources were found");
    found
}

fn entries(folder: &Path) -> impl Iterator<Item = PathBuf> {
    let entries = std::fs::read_dir(folder).unwrap();
    entries.map(|it| it.unwrap().path())
}

/// Lines of code, stripped: without blank lines, comments and modules of tests.
fn code(text: &str) -> Vec<&str> {
    let mut lines = text.lines().peekable();
    let mut found = Vec::new();
    let mut is_test = false;
    while let Some(line) = lines.next() {
        let next = lines.peek().copied().unwrap_or_default();
        is_test |= line.starts_with("#[cfg(test)]") && begins_module(next);
        let stripped = line.trim();
        if !is_test && !stripped.is_empty() && !stripped.starts_with("//") {
            found.push(stripped.split(" // ").next().unwrap_or_default());
        }
        is_test &= line != "}";
    }
    found
}

/// Whether a line begins a module that stands in the same file.
fn begins_module(line: &str) -> bool {
    let without_visibility = match line.strip_prefix("pub") {
        Some(rest) => rest.split_once(' ').map_or("", |(_, rest)| rest),
        None => line,
    };
    without_visibility.starts_with("mod ") && line.ends_with('{')
}

/// Number of words, numbers, strings and operators in a line of code.
fn n_tokens(line: &str) -> usize {
    let text: Vec<char> = line.chars().collect();
    let (mut at, mut count) = (0, 0);
    while at < text.len() {
        let length = length(&text[at..]);
        count += usize::from(length > 0);
        at += length.max(1);
    }
    count
}

/// Length of the token that some characters begin with; 0 for none.
fn length(text: &[char]) -> usize {
    let is_word = |it: &char| it.is_alphanumeric() || *it == '_';
    let while_all = |test: &dyn Fn(&char) -> bool| text.iter().take_while(|it| test(it)).count();
    match text {
        ['"', ..] => length_of_string(text).unwrap_or(1),
        ['\'', '\\', _, '\'', ..] => 4,
        ['\'', one, '\'', ..] if !['\'', '\\'].contains(one) => 3,
        [first, ..] if first.is_ascii_alphabetic() || *first == '_' => while_all(&is_word),
        [first, ..] if first.is_numeric() => while_all(&|it| is_word(it) || *it == '.'),
        [':', ':', ..] | ['-' | '=', '>', ..] | ['&', '&', ..] | ['|', '|', ..] => 2,
        [first, '=', ..] if "<>=!+-*/%^&|".contains(*first) => 2,
        ['.', '.', '=', ..] => 3,
        ['.', '.', ..] => 2,
        [first, ..] => usize::from(!first.is_whitespace() && !is_word(first)),
        [] => 0,
    }
}

/// Length of the string that begins with a quotation mark, where it ends in the same line.
fn length_of_string(text: &[char]) -> Option<usize> {
    let mut at = 1;
    while *text.get(at)? != '"' {
        at += if text[at] == '\\' { 2 } else { 1 };
    }
    Some(at + 1)
}

#[test]
fn tokens_are_words_numbers_strings_and_operators() {
    for (line, count) in [
        ("let x = \"two words\"; // and a comment", 5),
        ("a += 1.5e-3 .. b::c->d", 11),
        ("// nothing", 0),
        ("if a && b != 'c' || <'d> { 0 ..=9 }", 16),
    ] {
        let found: usize = code(line).into_iter().map(n_tokens).sum();
        assert_eq!(found, count, "{line}");
    }
    let text = "fn a() {}\n#[cfg(test)]\nmod tests {\n    fn b() {}\n}\nfn c() {}\n";
    assert_eq!(code(text), ["fn a() {}", "fn c() {}"]);
}

/// Counts by crate.
fn by_crate(count: impl Fn(&Source) -> usize) -> BTreeMap<String, usize> {
    let mut counts = BTreeMap::new();
    for source in sources() {
        *counts.entry(source.package.clone()).or_default() += count(&source);
    }
    counts
}

/// The table with the numbers of today.
fn as_table(counts: &BTreeMap<String, usize>) -> String {
    let row = |(name, count): (&String, &usize)| format!("    (\"{name}\", {count}),\n");
    counts.iter().map(row).collect()
}

/// The code of each crate has the tokens that the table gives: no crate grows without a reason, and dense lines gain nothing.
#[test]
fn crates_grow_with_a_reason() {
    let counts = by_crate(|it| code(&it.text).into_iter().map(n_tokens).sum());
    let all: usize = counts.values().sum();
    println!("{all} tokens:\n{}", as_table(&counts));
    let names = counts.keys().map(String::as_str);
    assert!(
        names.eq(TOKENS.map(|it| it.0)),
        "the table names the crates"
    );
    for (name, most) in TOKENS {
        let count = counts[name];
        let least = most - (UNWRITTEN * most as f64) as usize;
        assert!(
            (least..=most).contains(&count),
            "{name} has {count} tokens, the table says {most}: write down the new number, and in the message of the commit the reason"
        );
    }
}

/// Files are not cut into pieces that say nothing alone.
#[test]
fn short_files_become_fewer() {
    let is_short = |it: &Source| {
        let path = it.path.to_str().unwrap();
        let is_page = ["mod.rs", "lib.rs", "main.rs"]
            .iter()
            .any(|name| it.path.ends_with(name));
        let is_excused = is_page || SHORT_BY_NATURE.iter().any(|folder| path.contains(folder));
        let is_short = !is_excused && it.text.lines().count() < SHORTEST_FILE;
        usize::from(is_short)
    };
    let counts = by_crate(is_short);
    println!(
        "files of fewer than {SHORTEST_FILE} lines:\n{}",
        as_table(&counts)
    );
    for (name, most) in SHORT_FILES {
        let count = counts[name];
        assert!(
            count == most,
            "{name} has {count} files of fewer than {SHORTEST_FILE} lines, the table says {most}: join a new one with its user, write down a fall"
        );
    }
}

/// Traits with one implementation and public items are told, and judged by nobody: a reader of a change sees them.
#[test]
fn traits_and_public_items_are_told() {
    let (mut implemented, mut traits) = (BTreeMap::<String, usize>::new(), Vec::new());
    let mut n_public = 0;
    for (package, tree) in trees() {
        for module in tree.modules() {
            let words: Vec<&str> = module.tokens.iter().map(|it| it.text.as_str()).collect();
            for (at, pair) in words.windows(2).enumerate() {
                match pair {
                    ["trait", name] => traits.push((package.clone(), (*name).to_owned())),
                    ["pub", next] if *next != "(" => n_public += 1,
                    ["impl", _] => {
                        if let Some(name) = implemented_trait(&words[at..]) {
                            *implemented.entry(name.to_owned()).or_default() += 1;
                        }
                    }
                    _ => {}
                }
            }
        }
    }
    traits.retain(|(_, name)| implemented.get(name) == Some(&1));
    println!("{n_public} public items; traits with one implementation: {traits:#?}");
    assert!(
        n_public > 500 && !implemented.is_empty(),
        "the items were found"
    );
}

/// Name of the trait that words from `impl` on implement, without its path and parameters; none for a block of methods.
fn implemented_trait<'a>(words: &[&'a str]) -> Option<&'a str> {
    let (mut depth, mut last) = (0_i32, None);
    for word in &words[1..] {
        match *word {
            "<" => depth += 1,
            ">" => depth -= 1,
            "for" if depth == 0 => return last,
            "{" | "where" if depth == 0 => return None,
            name if depth == 0 && name.starts_with(char::is_alphabetic) => last = Some(name),
            _ => {}
        }
    }
    None
}

#[test]
fn implemented_traits_are_seen() {
    for (words, name) in [
        ("impl A for B {", Some("A")),
        (
            "impl < T : C > crate :: A < T > for B < T > where T : D {",
            Some("A"),
        ),
        ("impl B {", None),
        ("impl < F : for < 'a > Fn ( & 'a u8 ) > B < F > {", None),
    ] {
        let words: Vec<&str> = words.split(' ').collect();
        assert_eq!(implemented_trait(&words), name, "{words:?}");
    }
}
