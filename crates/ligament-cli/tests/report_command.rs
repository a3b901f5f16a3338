//! Calls of `ligament report`: the page of a run, of several, of modes and of a run that was cut short.

#![allow(clippy::unwrap_used, reason = "a failed unwrap fails the test")]

use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};

use serde_json::Value;

const TITLE: &str = "<script>alert(1)</script> & \\\"more\\\"";

/// A bar of 24 x 12 cells that is pulled apart, with a title that contains markup characters.
fn bar(end: &str) -> String {
    format!(
        r#"title = "{TITLE}"
[lattice]
cells = [24, 12]
spacing = 0.005
thickness = 0.01
[lattice.set]
left = {{ left = 1 }}
right = {{ right = 1 }}
[material]
young = 1e9
poisson = 0.2
density = 1000.0
tensile_strength = 1e6
[model]
law = "nhpd"
horizon_factor = 3.0
[[support]]
group = "left"
displacement = {{ x = 0.0, y = 0.0 }}
{end}"#
    )
}

const PULLED: &str = r#"[[load]]
group = "right"
displacement = { x = 4e-4, y = 0.0 }
[fracture]
steps = 16
[output]
fields_every = 1
"#;

fn text(bytes: &[u8]) -> String {
    String::from_utf8_lossy(bytes).into_owned()
}

fn call(folder: &Path, words: &[&str]) -> Output {
    let mut command = Command::new(env!("CARGO_BIN_EXE_ligament"));
    command.current_dir(folder).args(words).output().unwrap()
}

/// A folder with the results of a case in `out`.
fn run(case: &str) -> tempfile::TempDir {
    let folder = tempfile::tempdir().unwrap();
    fs::write(folder.path().join("bar.toml"), case).unwrap();
    let words = ["run", "bar.toml", "--out", "out", "--quiet"];
    let output = call(folder.path(), &words);
    assert!(output.status.success(), "{}", text(&output.stderr));
    folder
}

/// Calls the command and reads the page that it names.
fn report(folder: &Path, words: &[&str]) -> (String, String) {
    let all: Vec<&str> = ["report"].iter().chain(words).copied().collect();
    let output = call(folder, &all);
    assert!(output.status.success(), "{}", text(&output.stderr));
    let said = text(&output.stdout);
    let name = said.lines().last().unwrap().split(" (").next().unwrap();
    (fs::read_to_string(folder.join(name)).unwrap(), said)
}

/// The description that a page passes to its viewer.
fn description(page: &str) -> Value {
    let (_, rest) = page.split_once("id=\"description\">").unwrap();
    serde_json::from_str(rest.split_once("</script>").unwrap().0).unwrap()
}

fn names(run: &Value) -> Vec<String> {
    let fields = run["fields"].as_array().unwrap().iter();
    fields
        .map(|it| it["name"].as_str().unwrap().to_owned())
        .collect()
}

#[test]
fn a_page_has_a_run_and_no_markup_of_its_case() {
    let folder = run(&bar(PULLED));
    let (page, said) = report(folder.path(), &["out"]);
    assert!(said.contains("288 points, "), "{said}");
    assert!(folder.path().join("out/report.html").is_file());
    assert!(!page.contains("<script>alert"), "the title is text");
    assert!(
        page.contains(
            "<title>&lt;script&gt;alert(1)&lt;/script&gt; &amp; &quot;more&quot;</title>"
        )
    );
    // Nothing can be fetched.
    assert!(page.contains("default-src 'none'") && !page.contains("connect-src"));
    let run = &description(&page)["runs"][0];
    assert_eq!(run["title"], TITLE.replace("\\\"", "\""));
    assert_eq!(run["body"]["count"], 288);
    let n_steps = run["steps"].as_array().unwrap().len();
    assert!(n_steps > 4, "{n_steps}");
    assert_eq!(names(run)[..2], ["displacement", "damage"]);
    assert!(run["bonds"]["count"].as_u64().unwrap() > 2000);
    assert_eq!(run["cracks"]["lines"].as_array().unwrap().len(), n_steps);
    assert_eq!(run["firstField"], "damage");
    let opened = run["opensAt"].as_u64().unwrap() as usize;
    assert!(opened > 0 && opened < n_steps - 1, "{opened}");
    assert!(page.contains("Supports and loads") && page.contains("1.000 GPa"));
    let history = run["history"].as_array().unwrap();
    assert!(history.iter().any(|it| it["name"] == "residual"));
    // A rerun of the same results gives the same bytes.
    assert_eq!(report(folder.path(), &["out"]).0, page);
}

#[test]
fn measured_curves_stand_in_the_page() {
    let folder = run(&bar(PULLED));
    let write = |text: &str| fs::write(folder.path().join("curve.csv"), text).unwrap();
    write("displacement (mm),force (kN)\n0,0\n0.1,2.5\n");
    let words = ["out", "--measured", "curve.csv"];
    let measured = &description(&report(folder.path(), &words).0)["measured"][0];
    assert_eq!(measured["label"], "curve");
    assert_eq!(measured["names"][1], "force (kN)");
    assert_eq!(measured["values"][1][1], 2.5);
    for (wrong, said) in [
        ("a,b,c\n0,0,0\n", "has 3 columns; a measured curve has two"),
        ("a,b\n0,x\n", "curve.csv"),
    ] {
        write(wrong);
        let output = call(folder.path(), &["report", "out", "--measured", "curve.csv"]);
        assert_eq!(output.status.code(), Some(1));
        assert!(
            text(&output.stderr).contains(said),
            "{}",
            text(&output.stderr)
        );
    }
}

#[test]
fn what_does_not_fit_is_left_out_and_named() {
    let fine = bar(PULLED)
        .replace("[24, 12]", "[72, 36]")
        .replace("0.005", "0.0016667");
    let folder = run(&fine);
    let words = [
        "out",
        "--size",
        "0.5",
        "--digits",
        "8",
        "--steps",
        "5",
        "--output",
        "small.html",
    ];
    let (page, said) = report(folder.path(), &words);
    assert!(page.len() < 500_000, "{}", page.len());
    assert!(said.contains("no room for: "), "{said}");
    let run = &description(&page)["runs"][0];
    // The largest load is one of them.
    assert!((5..=6).contains(&run["steps"].as_array().unwrap().len()));
    assert_eq!(names(run)[0], "displacement");
    assert!(page.contains("Not in this page, for its size: "));
}

#[test]
fn several_results_and_modes_stand_in_a_page() {
    let folder = run(&bar(PULLED));
    let modes = format!("analysis = \"modal\"\n{}", bar("[modal]\nmodes = 3\n"));
    fs::write(folder.path().join("modes.toml"), modes).unwrap();
    let output = call(
        folder.path(),
        &["run", "modes.toml", "--out", "modes", "--quiet"],
    );
    assert!(output.status.success(), "{}", text(&output.stderr));
    let words = [
        "out",
        "modes",
        "--labels",
        "pulled",
        "free",
        "--output",
        "both.html",
    ];
    let runs = description(&report(folder.path(), &words).0)["runs"].clone();
    assert_eq!(
        (&runs[0]["label"], &runs[1]["label"]),
        (&"pulled".into(), &"free".into())
    );
    assert_eq!(
        (&runs[0]["kind"], &runs[1]["kind"]),
        (&"steps".into(), &"modes".into())
    );
    let error = call(
        folder.path(),
        &["report", "out", "modes", "--labels", "one"],
    );
    assert!(text(&error.stderr).contains("1 labels for 2 results"));
}

#[test]
fn runs_cut_short_and_without_a_model_have_pages_too() {
    let folder = run(&bar(PULLED));
    let out: PathBuf = folder.path().join("out");
    fs::remove_file(out.join("summary.json")).unwrap();
    fs::remove_file(out.join("model.vtu")).unwrap();
    let (page, _) = report(folder.path(), &["out"]);
    assert!(page.contains("did not come to its end"));
    assert_eq!(description(&page)["runs"][0]["bonds"], Value::Null);
}

#[test]
fn without_results_there_is_no_page() {
    let folder = tempfile::tempdir().unwrap();
    for (words, said) in [
        (vec!["report", "nowhere"], "there is no such folder"),
        (vec!["report", "."], "it has no case.resolved.toml"),
    ] {
        let output = call(folder.path(), &words);
        assert_eq!(output.status.code(), Some(1));
        assert!(
            text(&output.stderr).contains(said),
            "{}",
            text(&output.stderr)
        );
    }
    assert_eq!(call(folder.path(), &["report"]).status.code(), Some(2));
    assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 0);
}
