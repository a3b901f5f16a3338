//! The table of docs/space.md that says which laws and criteria exist in the plane and in space.
#![allow(clippy::unwrap_used, reason = "a failed unwrap fails the test")]

use ligament_model::failure::KINDS;
use ligament_model::law::LAWS;
use verification::repository;

const BEGIN: &str = "<!-- what exists where -->\n";
const END: &str = "<!-- end of what exists where -->\n";

/// The table, from the rows of the laws and the kinds of criteria.
fn table() -> String {
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
    made += "\n| criterion | plane | space | what fails |\n|---|---|---|---|\n";
    for kind in KINDS {
        let in_space = yes(kind.limits.solid.is_some());
        made += &format!("| `{}` | yes | {in_space} | {} |\n", kind.word, kind.words);
    }
    made
}

/// The page has the table of the laws and criteria that there are. With `LIGAMENT_WRITE_TABLES` in the environment it is written first.
#[test]
fn the_page_on_space_says_what_exists_where() {
    let path = repository().join("docs/space.md");
    let text = std::fs::read_to_string(&path).unwrap();
    let (before, rest) = text.split_once(BEGIN).unwrap();
    let (found, after) = rest.split_once(END).unwrap();
    if std::env::var_os("LIGAMENT_WRITE_TABLES").is_some() {
        std::fs::write(&path, [before, BEGIN, &table(), END, after].concat()).unwrap();
        return;
    }
    let again = "make it anew: LIGAMENT_WRITE_TABLES=1 cargo test --release -p verification --test guards existence";
    assert!(
        found == table(),
        "docs/space.md is not what the laws and criteria say; {again}"
    );
}
