//! Wrong studies: refused before anything is run or written.

use super::*;

/// The error of a study, after which there is no folder.
fn error_of(study: &str) -> String {
    let place = Place::with(study);
    let output = place.sweep(&[]);
    assert_eq!(output.status.code(), Some(1), "{}", stdout(&output));
    assert!(!place.path("out").exists());
    stderr(&output)
}

fn assert_told(study: &str, words: &[&str]) {
    let error = error_of(study);
    for words in words {
        assert!(error.contains(words), "{words}: {error}");
    }
}

#[test]
fn faults_of_the_study_have_their_place_and_the_nearest_key() {
    let axis = |text: &str| format!("case = \"bar/case.toml\"\n[[axis]]\n{text}\n");
    assert_told(
        &GRID.replace("[[axis]]", "[[axsi]]"),
        &["study.toml:3:3: axsi: unknown key `axsi` in the study file; did you mean `axis`?"],
    );
    assert_told(
        &GRID.replace("range", "rnage"),
        &["axis.1.rnage: unknown key `rnage` in [[axis]]; did you mean `range`?"],
    );
    assert_told("title = \"a\"\n", &["missing key `case` in the study file"]);
    assert_told(
        "case = \"bar/case.toml\"\n",
        &["no [[axis]] section", "axis"],
    );
    assert_told(
        &axis("key = \"model.horizon_factor\"\nvalues = []"),
        &["study.toml:4:10: axis.0.values: must be a list of 1"],
    );
    assert_told(
        &axis("key = \"model.horizon_factor\""),
        &["exactly one of `values`, `range`"],
    );
    assert_told(
        &axis("values = [1]"),
        &["exactly one of `key`, `keys`, `number`"],
    );
    assert_told(
        &axis(
            "keys = [\"model.horizon_factor\", \"material.young\"]\nvalues = [[2.0, 1e9], [3.0]]",
        ),
        &["study.toml:4:23: axis.0.values.1: expected a list of 2"],
    );
    assert_told(
        &axis("key = \"model.horizon_factor\"\nvalues = [2.0, 3.0]\nlabels = [\"a\"]"),
        &["study.toml:5:10", "2 values, but 1 labels"],
    );
    assert_told(
        &axis("key = \"model.horizon_factor\"\nvalues = [2.0, 3.0]\nlabels = [\"a\", \"=cmd\"]"),
        &["axis.0.labels.1: must be a label that does not begin with ="],
    );
    assert_told(
        &axis("key = \"title\"\nvalues = [\"plate\", \"@b\"]"),
        &["axis.0.values.1: must be a text that does not begin with ="],
    );
    assert_told(
        &axis("key = \"model.horizon_factor\"\nvalues = [2.0, 2.0]"),
        &["axis.0.values.1: `2.0` is already used by axis.0.values.0"],
    );
    assert_told(
        &axis("key = \"model.horizon_factor\"\nrange = { from = 2.0, to = 3.0, step = -0.5 }"),
        &["axis.0.range.step: must be other than 0"],
    );
    assert_told(
        &axis(
            "key = \"model.horizon_factor\"\nrange = { from = 0.0, to = 3.0, count = 3, log = true }",
        ),
        &["greater than 0 with `log`"],
    );
    assert_told(
        &(GRID.to_owned() + "[[axis]]\nkey = \"model.horizon_factor\"\nvalues = [2.0]\n"),
        &["`model.horizon_factor` is already used by axis.1"],
    );
    assert_told(
        &(GRID.to_owned() + "[[plot]]\nx = \"a\"\ny = \"b\"\nby = \"model.horizon_facto\"\n"),
        &["plot.0.by", "did you mean `model.horizon_factor`?"],
    );
    assert_told(
        &axis("number = \"size\"\nvalues = [1]"),
        &["missing key `geometry`"],
    );
    assert_told(
        "case = \"bar/case.toml",
        &["study.toml:1:", "not valid TOML"],
    );
    let many = (0..3)
        .map(|k| format!("[[axis]]\nkey = \"a{k}\"\nrange = {{ from = 1, to = 100, step = 1 }}\n"));
    assert_told(
        &("case = \"bar/case.toml\"\n".to_owned() + &many.collect::<String>()),
        &["1000000 combinations"],
    );
}

/// A fault that a value causes in the case is reported with the line of the value, the run, and the message of the case.
#[test]
fn faults_of_the_case_have_the_line_of_the_study() {
    assert_told(
        &GRID.replace("model.horizon_factor", "model.horizon_factr"),
        &[
            "study.toml:8:",
            "no case for the run tensile_strength=1e6,horizon_factr=2.2",
            "because: --set model.horizon_factr=2.2: model.horizon_factr: unknown key",
            "did you mean `horizon_factor`?",
        ],
    );
    assert_told(
        &GRID.replace("[1e6, 1.2e6]", "[1e6, -1.2e6]"),
        &[
            "study.toml:5:16:",
            "because: --set material.tensile_strength=-1200000.0",
            "greater than 0",
        ],
    );
    assert_told(
        &(GRID.to_owned() + "[set]\n\"load.3.group\" = \"left\"\n"),
        &["study.toml:10:18:", "the only index of `load` is 0"],
    );
    assert_told(
        &GRID.replace("bar/case.toml", "bra/case.toml"),
        &["cannot read the case file bra/case.toml"],
    );
    assert_told(
        "case = \"bar/case.toml\"\n[[axis]]\nkey = \"temperature.0.file\"\nvalues = [\"a.csv\"]\n",
        &["study.toml:4:11:", "there is no `temperature.0`"],
    );
}

#[test]
fn a_file_that_no_run_could_read_is_told_first() {
    let place = Place::with(
        "case = \"bar/mesh.toml\"\n[[axis]]\nkey = \"mesh.file\"\nvalues = [\"here.msh\", \"missing.msh\"]\n",
    );
    let (from, to) = (
        SMALL_BAR.find("[lattice]").unwrap(),
        SMALL_BAR.find("[material]").unwrap(),
    );
    let case = SMALL_BAR[..from].to_owned() + "[mesh]\nfile = \"here.msh\"\n" + &SMALL_BAR[to..];
    fs::write(place.path("bar/mesh.toml"), case).unwrap();
    fs::write(place.path("bar/here.msh"), "never read").unwrap();
    let output = place.sweep(&[]);
    assert_eq!(output.status.code(), Some(1));
    let error = stderr(&output);
    assert!(
        error.starts_with("error: study.toml:4:23: the run file=missing.msh cannot read"),
        "{error}"
    );
    assert!(!place.path("out").exists());
}

/// A folder that belongs to no study is left unchanged.
#[test]
fn foreign_folders_are_refused() {
    for file in ["thesis.tex", "case.resolved.toml", "study.toml"] {
        let place = Place::with(GRID);
        fs::create_dir(place.path("out")).unwrap();
        fs::write(place.path("out").join(file), "mine").unwrap();
        for arguments in [&[][..], &["--force"], &["--collect"]] {
            let output = place.sweep(arguments);
            assert_eq!(output.status.code(), Some(1), "{file}");
            assert!(
                stderr(&output).contains("sweep.json"),
                "{}",
                stderr(&output)
            );
        }
        let entries = fs::read_dir(place.path("out")).unwrap();
        assert_eq!(entries.count(), 1, "{file}");
    }
}

/// A run that does not fit into the memory is not started, and told with the numbers; the others are.
#[test]
fn a_run_that_does_not_fit_is_refused() {
    let place = Place::with(
        "case = \"bar/case.toml\"\n[[axis]]\nkey = \"lattice.cells\"\nvalues = [[12, 6], [120, 60]]\n",
    );
    let output = place.sweep(&["--memory", "0.03"]);
    assert_eq!(output.status.code(), Some(1));
    let table = place.table();
    assert_eq!(table.column("status"), ["done", "failed"]);
    let reason = table.column("error")[1];
    assert!(
        reason.contains("0.03 GB are available; allow more by --memory"),
        "{reason}"
    );
    assert_eq!(place.summaries().len(), 1);
    let list = place.sweep(&["--list"]);
    assert!(
        stdout(&list).contains("2 runs, 1 to do"),
        "{}",
        stdout(&list)
    );
}

/// Sections of plots and results name the place of a fault and the nearest valid name.
#[test]
fn faults_of_plots_and_references_have_their_place() {
    let line = GRID.lines().count();
    let told = |keys: &str, at: usize, words: &str| {
        let place = format!("study.toml:{}", line + at);
        assert_told(&format!("{GRID}{keys}"), &[&place, words]);
    };
    let plot = "[[plot]]\nx = \"model.horizon_factor\"\ny = \"peak.reaction\"\n";
    for (keys, words) in [
        (
            "by = [\"material.tensile_strength\", \"model.horizon_facto\"]",
            "plot.0.by: no key of an axis is called `model.horizon_facto`; did you mean `model.horizon_factor`?",
        ),
        (
            "by = \"material.tensile_strength\"\nmean = \"material.tensile_strength\"",
            "`material.tensile_strength` is in `by` too",
        ),
        (
            "where = { \"model.horizon_facto\" = 2.2 }",
            "no key of an axis is called `model.horizon_facto`; did you mean `model.horizon_factor`?",
        ),
        (
            "where = { model.horizon_factor = 2.8 }",
            "no value of the axis is called `2.8`; did you mean `2.",
        ),
        ("kind = \"curve\"", "plot.0.kind"),
        (
            "kind = \"crack-paths\"",
            "`x` does not apply with this `kind`",
        ),
    ] {
        let at = 3 + keys.lines().count();
        let at = if words.starts_with("`x`") { 2 } else { at };
        told(&format!("{plot}{keys}\n"), at, words);
    }
    told("[[plot]]\nx = \"peak.reaction\"\n", 1, "missing key `y`");
    let result = "[[result]]\nname = \"a\"\nof = \"peak.reaction\"\n";
    for (keys, words) in [
        ("reference = 0", "a number other than 0"),
        ("reference = \"finest\"", "name it, `along = \"mesh.file\"`"),
        (
            "reference = true",
            "expected a number, the name of a column",
        ),
        (
            "reference = { file = \"bar/none.csv\", column = \"a\", key = \"model.horizon_factor\" }",
            "none.csv",
        ),
        (
            "at = 0.1",
            "`at` is a place along x of `of = \"crack.height\"`",
        ),
        ("along = \"model.horizon_factor\"", "`along` is the axis of"),
    ] {
        told(&format!("{result}{keys}\n"), 4, words);
    }
    told(
        "[[result]]\nname = \"a\"\nof = \"crack.height\"\n",
        3,
        "give `at`, or `from` and `to`",
    );
}

/// A table of references needs a row for every run: told before anything is run.
#[test]
fn a_reference_without_a_row_for_a_run_is_refused() {
    let place = Place::with(&format!(
        "{GRID}[[result]]\nname = \"a\"\nof = \"peak.reaction\"\n\
         reference = {{ file = \"known.csv\", column = \"peak\", key = \"model.horizon_factor\" }}\n"
    ));
    for (table, words) in [
        (
            "model.horizon_factor,peak\n2.2,1\n2.7,2\n",
            "known.csv has no row for the runs with model.horizon_factor = 3.2",
        ),
        (
            "model.horizon_factor,peak\n2.2,1\n2.7,2\n3.2,3\n3.2,4\n",
            "known.csv has 2 rows for the runs with model.horizon_factor = 3.2",
        ),
        (
            "model.horizon_factor,peek\n2.2,1\n",
            "known.csv has no column `peak`; did you mean `peek`?",
        ),
        (
            "model.horizon_factor,peak\n2.2,1\n2.7,-\n3.2,3\n",
            "has `-`, no number other than 0, for the runs with model.horizon_factor = 2.7",
        ),
    ] {
        fs::write(place.path("known.csv"), table).unwrap();
        let output = place.sweep(&[]);
        assert_eq!(output.status.code(), Some(1));
        assert!(
            stderr(&output).contains(words),
            "{words}: {}",
            stderr(&output)
        );
        assert!(!place.path("out").exists());
    }
}
