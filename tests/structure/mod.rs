//! The inside of the crates: no circle of modules, no function that is too long or takes too much.
#![allow(clippy::unwrap_used, reason = "a failed unwrap fails the test")]
#![allow(clippy::print_stdout, reason = "a guard says what it counted")]

mod dimension;
mod fields;
mod functions;
mod limits;
mod matches;
mod modules;
mod ruler;
mod text;

use std::path::Path;

use functions::functions;
use matches::matches;
use modules::Tree;
use verification::repository;

/// Lines of a function that one can still take in, signature and closing brace included.
const LONGEST_FUNCTION: usize = 60;

/// Lines of a function with the loop over a run: cut into pieces, it is read in several places.
const LONGEST_LOOP: usize = 90;

/// Folder of the loops over a run.
const OF_RUNS: (&str, &str) = ("ligament-analysis", "driver");

/// Lines that half of the functions have at most, and nine tenths.
const USUAL_LINES: [usize; 2] = [9, 28];

/// Parameters that one can still keep apart, the value that a method is called on included.
const MOST_PARAMETERS: usize = 6;

/// Crates that see points, bonds and degrees of freedom as numbers: where points lie is behind the interface of the bonds.
const WITHOUT_SPACE: [&str; 2] = ["ligament-analysis", "ligament-linalg"];

/// Crates whose messages name fields of Rust types, and no keys or sections of a case file: these are for the layers above.
const WITHOUT_CASES: [&str; 4] = [
    "ligament-analysis",
    "ligament-linalg",
    "ligament-mesh",
    "ligament-model",
];

/// Words of the space that bodies lie in.
const OF_SPACE: [&str; 10] = [
    "BondSystem",
    "COMPONENTS",
    "Plane",
    "PointCloud",
    "UNKNOWNS",
    "cloud",
    "direction",
    "plane",
    "positions",
    "thickness",
];

/// Words of space that are still there, in any file or as `file.rs word`, each with its reason. Nothing may be added.
const STILL_SPATIAL: [(&str, &str); 5] = [
    (
        "eigen.rs 3 *",
        "the size of a basis, in vectors that are sought",
    ),
    ("amplitude.rs / 3", "the integral of a square over time"),
    (
        "amplitude.rs / 6",
        "the second integral of a line over time",
    ),
    ("amplitude.rs [f64; 2]", "a time and a factor"),
    (
        "amplitude.rs [f64; 3]",
        "a factor and its integrals over time",
    ),
];

/// Types whose values are kinds of something that new ones are added to: a match on them names them all.
const KINDS: [&str; 8] = [
    "Calibration",
    "ElementKind",
    "Form",
    "Materials",
    "Measure",
    "PaperCorrection",
    "ShearForm",
    "Strains",
];

/// The trees of all crates, each with the name of its crate.
fn trees() -> Vec<(String, Tree)> {
    let mut found = Vec::new();
    for entry in std::fs::read_dir(repository().join("crates")).unwrap() {
        let folder = entry.unwrap().path();
        let name = folder.file_name().unwrap().to_str().unwrap().to_owned();
        let sources = folder.join("src");
        let read = |file: &Path| std::fs::read_to_string(sources.join(file)).ok();
        for root in ["lib.rs", "main.rs"].map(Path::new) {
            if sources.join(root).exists() {
                found.push((name.clone(), Tree::read(root, &read)));
            }
        }
    }
    found.sort_by(|one, other| one.0.cmp(&other.0));
    assert!(found.len() > 5, "the crates were found");
    found
}

/// Name of a file by which it is known wherever its folder moves.
fn label(file: &Path) -> String {
    let name = file.file_name().unwrap().to_str().unwrap();
    match file.parent().and_then(Path::file_name) {
        Some(folder) if name == "mod.rs" => format!("{}/{name}", folder.to_str().unwrap()),
        _ => name.to_owned(),
    }
}

/// No file uses another one that uses it, directly or through others.
#[test]
fn no_modules_go_in_circles() {
    let mut n_circles = 0;
    for (name, tree) in trees() {
        let found = tree.circles();
        let n_modules = tree.modules().count();
        println!("{name}: {n_modules} modules, {} circles", found.len());
        n_circles += found.len();
        for circle in found {
            println!("\n{name}: {:?}", circle.files);
            for reason in &circle.because {
                println!("    {reason}");
            }
        }
    }
    assert_eq!(n_circles, 0, "circles of modules, see above");
}

/// The crates of the equations name nothing of the space that bodies lie in, but for a few words with a reason.
#[test]
fn equations_know_no_dimension() {
    let mut found: Vec<String> = Vec::new();
    for (name, tree) in trees() {
        if !WITHOUT_SPACE.contains(&name.as_str()) {
            continue;
        }
        for module in tree.modules() {
            let words: Vec<&str> = module.tokens.iter().map(|it| it.text.as_str()).collect();
            let counted = (0..words.len()).filter_map(|at| spatial_count(&words[at..]));
            let spatial = words.iter().filter(|word| OF_SPACE.contains(word));
            let spatial = spatial.map(|word| (*word).to_owned());
            found.extend(
                counted
                    .chain(spatial)
                    .map(|word| format!("{} {word}", label(&module.file))),
            );
        }
    }
    found.sort();
    found.dedup();
    let is_open = |place: &str, open: &str| place == open || place.ends_with(&format!(" {open}"));
    let is_new = |place: &&String| !STILL_SPATIAL.iter().any(|(open, _)| is_open(place, open));
    let new: Vec<&String> = found.iter().filter(is_new).collect();
    assert!(new.is_empty(), "know of the dimension of space: {new:?}");
    for (open, reason) in STILL_SPATIAL {
        assert!(
            found.iter().any(|it| is_open(it, open)),
            "take it off the list: {open} ({reason})"
        );
    }
}

/// Messages of the crates below `ligament` have no sections, settings or other words of a case file.
#[test]
fn messages_below_the_setup_know_no_case_file() {
    let mut found: Vec<String> = Vec::new();
    for (name, tree) in trees() {
        if !WITHOUT_CASES.contains(&name.as_str()) {
            continue;
        }
        for module in tree.modules() {
            let of_cases = module.tokens.iter().filter(|it| is_of_cases(&it.literal));
            found.extend(
                of_cases.map(|it| format!("{name}/{}: {}", label(&module.file), it.literal)),
            );
        }
    }
    assert!(found.is_empty(), "words of the case file: {found:#?}");
}

/// Whether a literal has a section in brackets, a key that is set to a word, or speaks of the case.
fn is_of_cases(literal: &str) -> bool {
    let is_key = |text: &str| {
        let mut characters = text.chars();
        !text.is_empty() && characters.all(|it| it.is_ascii_lowercase() || "_.".contains(it))
    };
    let mut brackets = literal
        .split('[')
        .skip(1)
        .filter_map(|it| it.split_once(']'));
    brackets.any(|(section, _)| is_key(section))
        || ["= \\\"", "the case ", "a case "]
            .iter()
            .any(|it| literal.contains(it))
}

#[test]
fn words_of_case_files_are_known_in_literals() {
    for (source, is_of_case_files) in [
        ("\"hold it by a [[support]]\"", true),
        ("\"the section [fracture.stop] says\"", true),
        ("\"take kind = \\\"sliding\\\"\"", true),
        ("\"as the case says\"", true),
        ("\"the criterion \\\"sliding\\\" takes `limit`\"", false),
        ("\"loads[1], [x, y] and {found:?}\"", false),
        ("// [fracture]", false),
    ] {
        let tokens = text::tokens(source);
        let found = tokens.iter().any(|it| is_of_cases(&it.literal));
        assert_eq!(found, is_of_case_files, "{source}");
    }
}

/// The components of a point or of space that these tokens begin with: as the size of an array, as the step of a loop over degrees
/// of freedom, as their places.
fn spatial_count(tokens: &[&str]) -> Option<String> {
    match tokens {
        ["[", "f64", ";", size @ ("2" | "3"), "]", ..] => Some(format!("[f64; {size}]")),
        ["[", "0", ",", "1", ",", "2", "]", ..] => Some("[0, 1, 2]".to_owned()),
        [sign @ ("%" | "/" | "*"), count @ ("3" | "6"), ..] => Some(format!("{sign} {count}")),
        [count @ ("3" | "6"), "*", ..] => Some(format!("{count} *")),
        [
            step @ ("chunks" | "chunks_exact" | "chunks_mut" | "step_by"),
            "(",
            count @ ("3" | "6"),
            ..,
        ] => Some(format!("{step}({count})")),
        _ => None,
    }
}

#[test]
fn counts_of_components_are_seen() {
    for (source, expected) in [
        ("let point = dof / 3;", Some("/ 3")),
        ("dof % 3 == 2", Some("% 3")),
        ("let first = 3 * point;", Some("3 *")),
        ("u.chunks(3)", Some("chunks(3)")),
        ("[0, 1, 2].map(f)", Some("[0, 1, 2]")),
        ("let force: [f64; 3];", Some("[f64; 3]")),
        ("let middle = points.len() / 2;", None),
    ] {
        let tokens = text::tokens(source);
        let words: Vec<&str> = tokens.iter().map(|it| it.text.as_str()).collect();
        let found = (0..words.len()).find_map(|at| spatial_count(&words[at..]));
        assert_eq!(found.as_deref(), expected, "{source}");
    }
}

/// A match that names elements, measures or options of laws has no arm for whatever is left: a new kind is asked for everywhere.
#[test]
fn matches_on_kinds_name_them_all() {
    let mut hiding = Vec::new();
    for (name, tree) in trees() {
        for module in tree.modules() {
            let found = matches(&module.tokens).into_iter();
            let found = found.filter(|it| it.hides_values_of(&KINDS));
            hiding.extend(found.map(|it| format!("{name}/{}:{}", module.file.display(), it.line)));
        }
    }
    assert!(hiding.is_empty(), "name all values: {hiding:#?}");
}

#[test]
fn arms_for_whatever_is_left_are_seen() {
    for (source, hides) in [
        ("match it { Form::Rows => 1, _ => 2 }", true),
        ("match (it, 1) { (Form::Rows, _) => 1, (_, _) => 2 }", true),
        ("match f({ 1 }) { Form::Rows => { g(1, 2) } _ => 2, }", true),
        (
            "match it { 1 => 1, _ => match its { Form::Full | Form::Rows => 2 } }",
            false,
        ),
        ("match it { 1 => Form::Full, _ => Form::Rows }", false),
    ] {
        let found = matches(&text::tokens(source));
        assert_eq!(
            found.iter().any(|it| it.hides_values_of(&KINDS)),
            hides,
            "{source}"
        );
    }
}

/// Functions have at most 60 lines and 6 parameters, loops over a run at most 90 lines; half of them have at most 9, nine tenths at most 28.
#[test]
fn functions_are_short_and_take_little() {
    let (mut lines, mut large) = (Vec::new(), Vec::new());
    for (name, tree) in trees() {
        for module in tree.modules() {
            let is_of_runs = name == OF_RUNS.0 && module.file.starts_with(OF_RUNS.1);
            for function in functions(&module.tokens) {
                lines.push(function.lines);
                let most = match is_of_runs && function.has_loop {
                    true => LONGEST_LOOP,
                    false => LONGEST_FUNCTION,
                };
                if function.lines > most || function.parameters > MOST_PARAMETERS {
                    large.push(format!(
                        "{name}/{}::{}: {} lines, {} parameters",
                        module.file.display(),
                        function.name,
                        function.lines,
                        function.parameters
                    ));
                }
            }
        }
    }
    assert!(lines.len() > 1000, "the functions were found");
    lines.sort_unstable();
    let usual = [lines.len() / 2, lines.len() * 9 / 10].map(|at| lines[at]);
    println!("lines of half and of nine tenths of the functions: {usual:?}");
    assert!(
        usual[0] <= USUAL_LINES[0] && usual[1] <= USUAL_LINES[1],
        "{usual:?}"
    );
    assert!(large.is_empty(), "functions that are too large: {large:#?}");
}

fn tree_of(files: &[(&str, &str)]) -> Tree {
    let text = |wanted: &Path| {
        let mut found = files.iter().filter(|(file, _)| Path::new(file) == wanted);
        found.next().map(|(_, text)| (*text).to_owned())
    };
    Tree::read(Path::new("lib.rs"), &text)
}

fn circles_of(files: &[(&str, &str)]) -> Vec<Vec<String>> {
    let circles = tree_of(files).circles().into_iter();
    circles
        .map(|circle| {
            circle
                .files
                .iter()
                .map(|file| file.display().to_string())
                .collect()
        })
        .collect()
}

#[test]
fn modules_that_name_each_other_are_a_circle() {
    for text in [
        "use crate::b::B; pub struct A(B);",
        "pub struct A(crate::b::B);",
        "pub struct A(super::b::B);",
        "use super::b; pub struct A(b::B);",
        "use crate::{b as other}; pub struct A(other::B);",
        "use crate::B; pub struct A(B);",
    ] {
        let circles = circles_of(&[
            ("lib.rs", "mod a; mod b; pub use b::B;"),
            ("a.rs", text),
            ("b.rs", "use crate::a::A; pub struct B(Box<A>);"),
        ]);
        assert_eq!(circles, [["a.rs", "b.rs"]], "{text}");
    }
}

#[test]
fn a_circle_may_lead_through_others_and_through_a_parent() {
    let circles = circles_of(&[
        ("lib.rs", "mod a; mod b;"),
        ("a.rs", "mod c; pub fn a() { c::c() }"),
        ("a/c.rs", "pub fn c() { crate::b::b() }"),
        ("b.rs", "pub fn b() { crate::a::a() }"),
    ]);
    assert_eq!(circles, [["a.rs", "a/c.rs", "b.rs"]]);
}

#[test]
fn a_function_that_a_child_adds_to_its_parents_type_is_a_circle_if_the_parent_calls_it() {
    let child = "impl super::A { } use super::A; impl A { pub fn twice(&self) {} }";
    for (parent, n_circles) in [
        ("mod c; pub struct A; pub fn a(a: A) { a.twice() }", 1),
        ("mod c; pub struct A;", 0),
    ] {
        let files = [("lib.rs", "mod a;"), ("a.rs", parent), ("a/c.rs", child)];
        assert_eq!(circles_of(&files).len(), n_circles, "{parent}");
    }
}

#[test]
fn what_a_parent_lists_for_others_and_what_tests_use_is_no_circle() {
    let circles = circles_of(&[
        (
            "lib.rs",
            "pub mod a; pub use a::{A, C}; pub const ONE: usize = 1;",
        ),
        ("a/mod.rs", "mod c; pub use c::C; pub struct A;"),
        (
            "a/c.rs",
            "use super::A; pub struct C(A, [u8; crate::ONE]); // crate::a::x::y()\n const S: &str = \"crate::a::A\"; \
             #[cfg(test)] mod tests { fn f(it: crate::C) {} }",
        ),
    ]);
    assert_eq!(circles, Vec::<Vec<String>>::new());
}

#[test]
fn lines_and_parameters_are_counted_as_one_reads_them() {
    let source = "
        trait T { fn without_body(&self, a: u8); }
        fn plain() { loop {} }
        fn taking_apart(&self, (a, [b, c]): (u8, [u8; 2]), _: u8) {}
        pub fn generic<F: Fn(u8, u8) -> u8>(a: [u8; 2], b: (u8, u8), c: F,
            d: HashMap<u8, Vec<u8>>,) -> u8 where F: Copy
        {
            let brace = \"}}}\"; // }
            let c = '}';
            let r = r#\"}\"#;
        }
        #[cfg(test)]
        mod tests { fn of_a_test() {} }
        impl A { fn method<'a>(&'a self, x: u8) {
        } }";
    let found = functions(&text::tokens(source));
    let sizes: Vec<_> = (found.iter())
        .map(|it| (it.name.as_str(), it.lines, it.parameters, it.has_loop))
        .collect();
    assert_eq!(
        sizes,
        [
            ("plain", 1, 0, true),
            ("taking_apart", 1, 5, false),
            ("generic", 7, 4, false),
            ("method", 2, 2, false)
        ]
    );
}
