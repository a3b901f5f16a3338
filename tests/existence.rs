//! Tables of pages that follow from tables of the program: what exists in the plane and in space, fields of results, columns of tables.
#![allow(clippy::unwrap_used, reason = "a failed unwrap fails the test")]

use ligament_model::failure::KINDS;
use ligament_model::law::LAWS;
use ligament_output::results::columns::{Column, tables};
use ligament_output::results::fields::{Components, FIELDS, FieldReading, ResultField};
use verification::repository;

/// The tables of the laws and the kinds of criteria.
fn what_exists_where() -> String {
    let yes = |exists: bool| if exists { "yes" } else { "no" };
    let mut made =
        "| law | plane | space | what its bonds resist | source |\n|---|---|---|---|---|\n"
            .to_owned();
    for law in LAWS {
        let in_space = yes(law.solid.is_some());
        made += &format!(
            "| `{}` | yes | {in_space} | {} | {} |\n",
            law.word, law.sentence, law.source
        );
    }
    made += "\n| criterion | plane | space | what fails | source |\n|---|---|---|---|---|\n";
    for kind in KINDS {
        let in_space = yes(kind.limits.solid.is_some());
        made += &format!(
            "| `{}` | yes | {in_space} | {} | {} |\n",
            kind.word, kind.words, kind.source
        );
    }
    made
}

/// A unit as pages write it: nothing where there is none.
fn unit(unit: &str) -> &str {
    if unit == "-" { "" } else { unit }
}

/// The table of the fields of results.
fn fields() -> String {
    let components = |it: Components| match it {
        Components::Integer => "integer".to_owned(),
        Components::Scalar => String::new(),
        Components::Vector => "x, y, z".to_owned(),
        Components::Named(names) => names.join(", "),
    };
    let row = |field: &&ResultField| {
        let name = match field.reading {
            FieldReading::EnergyRatios => format!("{}...", field.name),
            FieldReading::ScatterFactors => format!("...{}", field.name),
            _ => field.name.to_owned(),
        };
        let [plane, solid] = field.components.map(components);
        let components = match (plane == solid, plane.is_empty()) {
            (true, _) => plane,
            (false, true) => format!("of a solid {solid}"),
            (false, false) => format!("{plane}; of a solid {solid}"),
        };
        format!(
            "| `{name}` | {components} | {} | {} |\n",
            field.meaning,
            unit(field.unit)
        )
    };
    let head = "| field | components | meaning | unit |\n|---|---|---|---|\n";
    head.to_owned() + &FIELDS.iter().map(row).collect::<String>()
}

/// The table of the columns of a table.
fn columns(columns: &[Column]) -> String {
    let row = |it: &Column| {
        let unit = if it.unit.is_empty() {
            ""
        } else {
            &format!(" {}", it.unit)
        };
        format!("| `{}` |{unit} | {} |\n", it.name, it.meaning)
    };
    let head = "| column | unit | meaning |\n|---|---|---|\n";
    head.to_owned() + &columns.iter().map(row).collect::<String>()
}

/// Compares tables of a page with those that the program says, each between two lines that name it. With `LIGAMENT_WRITE_TABLES` in the
/// environment the tables are written instead.
fn compare(page: &str, made: &[(&str, String)]) {
    let path = repository().join(page);
    let mut text = std::fs::read_to_string(&path).unwrap();
    for (name, table) in made {
        let [begin, end] = ["", "end of "].map(|it| format!("<!-- {it}{name} -->\n"));
        let (before, rest) = text.split_once(&begin).unwrap();
        let (found, after) = rest.split_once(&end).unwrap();
        let again = "make it anew: LIGAMENT_WRITE_TABLES=1 cargo test --release -p verification --test guards existence";
        let is_written = std::env::var_os("LIGAMENT_WRITE_TABLES").is_some();
        if is_written {
            text = [before, &begin, table, &end, after].concat();
            std::fs::write(&path, &text).unwrap();
        } else {
            assert!(
                found == table,
                "{page}: {name} is not what the program says; {again}"
            );
        }
    }
}

#[test]
fn the_page_on_space_says_what_exists_where() {
    compare(
        "docs/space.md",
        &[("what exists where", what_exists_where())],
    );
}

#[test]
fn the_page_on_results_has_all_fields() {
    compare("docs/results.md", &[("fields", fields())]);
}

#[test]
fn the_page_on_columns_has_all_columns() {
    let made: Vec<(&str, String)> = (tables().iter())
        .map(|(name, all)| (*name, columns(all)))
        .collect();
    compare("docs/columns.md", &made);
}
