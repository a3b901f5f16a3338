//! Results of sweeps: order, names, columns, fits and plots.

use super::*;
use std::collections::BTreeSet;

const PLOTTED: &str = r#"
[[result]]
name = "relative_peak"
of = "first_peak.reaction"
over = 500.0
[[plot]]
x = "model.horizon_factor"
y = "relative_peak"
by = "material.tensile_strength"
line = { slope = 0.5, intercept = 1.0, label = "known, from a paper" }
fit = { from = 2.5 }
"#;

/// A grid has all combinations, the last axis varying fastest, and each run is what `ligament run` does with the same settings.
#[test]
fn a_grid_has_all_combinations_in_order() {
    let place = Place::with(&(GRID.to_owned() + PLOTTED));
    assert_success(&place.sweep(&[]));
    let table = place.table();
    assert_eq!(
        table.column("run"),
        [
            "tensile_strength=1e6,horizon_factor=2.2",
            "tensile_strength=1e6,horizon_factor=2.7",
            "tensile_strength=1e6,horizon_factor=3.2",
            "tensile_strength=1.2e6,horizon_factor=2.2",
            "tensile_strength=1.2e6,horizon_factor=2.7",
            "tensile_strength=1.2e6,horizon_factor=3.2",
        ]
    );
    assert_eq!(table.column("status"), ["done"; 6]);
    assert_eq!(
        table.numbers("model.horizon_factor"),
        [2.2, 2.7, 3.2, 2.2, 2.7, 3.2]
    );
    assert_eq!(
        table.numbers("material.tensile_strength"),
        [1e6, 1e6, 1e6, 1.2e6, 1.2e6, 1.2e6]
    );
    assert_eq!(table.column("case.material.young"), ["1000000000.0"; 6]);
    assert!(
        !table
            .columns
            .contains(&"case.model.horizon_factor".to_owned())
    );

    let out = place.path("alone");
    let alone = ligament([
        "run".as_ref(),
        place.path("bar/case.toml").as_os_str(),
        "--set".as_ref(),
        "material.tensile_strength=1.2e6".as_ref(),
        "--set".as_ref(),
        "model.horizon_factor=2.7".as_ref(),
        "--out".as_ref(),
        out.as_os_str(),
    ]);
    assert_success(&alone);
    let summary = fs::read_to_string(out.join("summary.json")).unwrap();
    let summary: serde_json::Value = serde_json::from_str(&summary).unwrap();
    let peak = summary["first_peak"]["reaction"].as_f64().unwrap();
    assert_eq!(table.numbers("first_peak.reaction")[4], peak);
    assert_eq!(table.numbers("relative_peak")[4], peak / 500.0);
    let broken = summary["broken_bonds"].as_f64().unwrap();
    assert_eq!(table.numbers("broken_bonds")[4], broken);
    for file in ["history.csv", "breaks.csv"] {
        let run = place
            .path("out/runs")
            .join(table.column("run")[4])
            .join(file);
        assert_eq!(
            fs::read(run).unwrap(),
            fs::read(out.join(file)).unwrap(),
            "{file}"
        );
    }
}

/// The line through two points is known; the plot and the text on standard output have it, and the known line beside it.
#[test]
fn fits_and_plots_are_those_of_the_table() {
    let place = Place::with(&(GRID.to_owned() + PLOTTED));
    let output = place.sweep(&[]);
    assert_success(&output);
    let peaks = place.table().numbers("relative_peak");
    let fits = Table::read(&place.path("out/fits.csv"));
    assert_eq!(
        fits.column("curve"),
        ["1e6", "1.2e6", "known, from a paper"]
    );
    assert_eq!(fits.column("points"), ["2", "2", ""]);
    for (curve, first) in [(0, 1), (1, 4)] {
        let slope = (peaks[first + 1] - peaks[first]) / 0.5;
        let found: f64 = fits.column("slope")[curve].parse().unwrap();
        let intercept: f64 = fits.column("intercept")[curve].parse().unwrap();
        // Rounding: some operations on numbers of size one.
        assert!(
            (found - slope).abs() < 1e-12 * slope.abs().max(1.0),
            "{found} {slope}"
        );
        assert!(
            (intercept + 2.7 * slope - peaks[first]).abs() < 1e-12,
            "{intercept}"
        );
    }
    assert_eq!(fits.column("slope")[2], "0.5");
    let text = stdout(&output);
    for words in [
        "relative_peak over model.horizon_factor, by",
        "x >= 2.5",
        "6 done, 0 failed",
    ] {
        assert!(text.contains(words), "{words}: {text}");
    }
    let plot = place.path("out/relative_peak-over-model.horizon_factor.svg");
    let plot = fs::read_to_string(plot).unwrap();
    assert!(plot.contains("known, from a paper") && plot.contains("1.2e6"));
    // Three open circles for each curve, and one in the legend.
    assert_eq!(plot.matches("<circle").count(), 8);
    assert!(plot.contains("width=\"160.000mm\""), "for a page");
    // The same as a picture: 160 mm at 300 dots per inch, by the width in the header of a PNG.
    let picture = place.path("out/relative_peak-over-model.horizon_factor.png");
    let picture = fs::read(picture).unwrap();
    let width = u32::from_be_bytes(picture[16..20].try_into().unwrap());
    assert_eq!(width, (160.0f64 / 25.4 * 300.0).round() as u32);
}

/// Paired keys are one axis; labels name folders, columns and curves; a setting holds for all; lists are values.
#[test]
fn paired_keys_and_labels() {
    let place = Place::with(
        r#"
        case = "bar/case.toml"
        [set]
        "fracture.steps" = 4
        output.model = false
        [[axis]]
        keys = ["model.horizon_factor", "material.tensile_strength"]
        values = [[2.2, 1e6], [3.2, 0.8e6]]
        [[axis]]
        key = "lattice.cells"
        values = [[12, 6], [16, 8]]
        labels = ["coarse", "fine / 8 rows"]
        [[axis]]
        key = "fracture.stop.bonds"
        range = { from = 10, to = 20, count = 2 }
        "#,
    );
    assert_success(&place.sweep(&["--jobs", "2"]));
    let table = place.table();
    assert_eq!(table.rows.len(), 8);
    let name = "horizon_factor=3.2,tensile_strength=8e5,cells=fine___8_rows,bonds=20";
    assert_eq!(table.column("run")[7], name);
    assert!(!place.path("out/runs").join(name).join("model.vtu").exists());
    assert_eq!(
        table.column("cells.label")[1..3],
        ["coarse", "fine / 8 rows"]
    );
    assert_eq!(table.column("lattice.cells")[2], "[16, 8]");
    assert_eq!(table.column("fracture.stop.bonds")[..2], ["10", "20"]);
    assert_eq!(table.column("points")[1..3], ["72", "128"]);
    assert_eq!(table.column("case.fracture.steps"), ["4"; 8]);
    assert_eq!(table.numbers("material.tensile_strength")[3..5], [1e6, 8e5]);
}

/// A run that fails leaves the others alone and has its reason in the table; the exit code tells.
#[test]
fn a_failing_run_harms_no_other() {
    let study = r#"
        case = "bar/case.toml"
        [[axis]]
        key = "load.0.group"
        values = ["right", "rigth", "left"]
        [[axis]]
        key = "model.horizon_factor"
        values = [2.2, 3.2]
        "#;
    let place = Place::with(study);
    let output = place.sweep(&[]);
    assert_eq!(output.status.code(), Some(1));
    let table = place.table();
    let status = table.column("status");
    assert_eq!(status[..4], ["done", "done", "failed", "failed"]);
    let reason = table.column("error")[2];
    assert!(reason.contains("did you mean `right`?"), "{reason}");
    assert!(!reason.starts_with("error"), "{reason}");
    assert!(
        stderr(&output).contains(": failed: --set load.0.group="),
        "{}",
        stderr(&output)
    );
    assert!(stderr(&output).contains("of 6 runs failed; the same command repeats them"));
    assert_eq!(table.column("first_peak.reaction")[2], "");
    let before = place.summaries();
    let again = place.sweep(&[]);
    assert_eq!(again.status.code(), Some(1));
    assert_eq!(place.summaries(), before, "what is done is not done again");
    assert!(stderr(&again).contains("[1/"), "what failed is tried again");
}

/// A column of the table has cells of one type, or empty ones: any reader of CSV can guess it.
#[test]
fn columns_have_one_type() {
    let place = Place::with(&GRID.replace("1.2e6]", "1.2e6]\nlabels = [\"weak\", \"strong\"]"));
    assert_success(&place.sweep(&[]));
    let table = place.table();
    let kind = |cell: &str| match cell {
        "true" | "false" => "truth",
        _ if cell.parse::<i64>().is_ok() || cell.parse::<f64>().is_ok() => "number",
        _ => "text",
    };
    let mut kinds = BTreeSet::new();
    for name in &table.columns {
        let cells = table.column(name);
        let of_column: BTreeSet<&str> = cells
            .iter()
            .filter(|cell| !cell.is_empty())
            .map(|cell| kind(cell))
            .collect();
        assert!(of_column.len() <= 1, "{name}: {cells:?}");
        kinds.extend(of_column);
    }
    assert_eq!(kinds, BTreeSet::from(["number", "text", "truth"]));
}

/// A result that no run has is told with its place in the study, as soon as one run is done; the runs are kept.
#[test]
fn a_misspelt_result_is_told_and_costs_no_run() {
    let place =
        Place::with(&(GRID.to_owned() + &PLOTTED.replace("first_peak.rea", "first_pek.rea")));
    let output = place.sweep(&[]);
    assert_eq!(output.status.code(), Some(1));
    let text = stderr(&output);
    let line = GRID.lines().count() + 4;
    let expected = format!(
        "study.toml:{line}:6: result.0.of: no result of the runs is called `first_pek.reaction`; did you mean"
    );
    assert!(text.contains(&expected), "{text}");
    let first_run = text.find("[1/6]").unwrap();
    assert!(
        text.find(&expected).unwrap() < first_run + text[first_run..].find("[2/6]").unwrap(),
        "{text}"
    );
    let before = place.summaries();
    assert_eq!(before.len(), 6);
    place.study(&(GRID.to_owned() + PLOTTED));
    assert_success(&place.sweep(&[]));
    assert_eq!(place.summaries(), before);
    assert!(
        place
            .path("out/relative_peak-over-model.horizon_factor.svg")
            .is_file()
    );
}
