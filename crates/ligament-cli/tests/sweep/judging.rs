//! What a study says of its runs: panels, filters and means of plots, errors against references, results of cracks, pictures of all runs.

use super::*;

/// Two lattices, two strengths and two horizons.
const THREE_AXES: &str = r#"title = "Bars"
case = "bar/case.toml"
[[axis]]
key = "lattice.cells"
values = [[12, 6], [16, 8]]
labels = ["coarse", "fine"]
[[axis]]
key = "material.tensile_strength"
values = [1e6, 1.2e6]
[[axis]]
key = "model.horizon_factor"
values = [2.2, 3.2]
"#;

/// A plate of 60 x 120 mm with a slit of 20 mm from the left between two rows of cells, pulled apart along the exact path.
const SLIT: &str = r#"title = "Plate with a slit"
[lattice]
cells = [12, 24]
spacing = 0.005
thickness = 0.01
[lattice.set]
bottom = { bottom = 1 }
top = { top = 1 }
[material]
young = 1e9
poisson = 0.2
fracture_energy = 50.0
[model]
law = "nhpd"
horizon_factor = 3.0
[[precrack]]
points = [[-0.001, 0.06], [0.0201, 0.06]]
[[support]]
group = "bottom"
displacement = { x = 0.0, y = 0.0 }
[[load]]
group = "top"
displacement = { x = 0.0, y = 4e-3 }
[fracture]
control = "event"
stop = { load_fraction = 0.01 }
criterion = [{ kind = "bond-energy" }]
"#;

fn plot(keys: &str) -> String {
    format!(
        "{THREE_AXES}[[plot]]\nx = \"model.horizon_factor\"\ny = \"first_peak.reaction\"\n{keys}\n"
    )
}

const PLOT: &str = "out/first_peak.reaction-over-model.horizon_factor.svg";

impl Place {
    fn plotted(&self) -> String {
        fs::read_to_string(self.path(PLOT)).unwrap()
    }
}

/// The last key of `by` has curves, the first ones panels; fits are named by both, and a filter leaves the runs that it means.
#[test]
fn several_keys_make_panels_and_filters_leave_runs() {
    let place = Place::with(&plot(
        "by = [\"lattice.cells\", \"material.tensile_strength\"]\nfit = {}",
    ));
    let output = place.sweep(&[]);
    assert_success(&output);
    let svg = place.plotted();
    for label in [">coarse<", ">fine<", ">1e6<", ">1.2e6<"] {
        assert_eq!(svg.matches(label).count(), 1, "{label}: {svg}");
    }
    // Two runs for each of two curves in both panels, and two curves in one legend.
    assert_eq!(svg.matches("<circle").count(), 10);
    let fits = Table::read(&place.path("out/fits.csv"));
    assert_eq!(
        fits.column("curve"),
        ["coarse, 1e6", "coarse, 1.2e6", "fine, 1e6", "fine, 1.2e6"]
    );
    assert!(stdout(&output).contains("by material.tensile_strength, fine"));

    place.study(&plot(
        "by = \"material.tensile_strength\"\nwhere = { \"lattice.cells\" = \"fine\", model.horizon_factor = [2.2, 3.2] }",
    ));
    let output = place.sweep(&["--collect"]);
    assert_success(&output);
    assert!(
        !stderr(&output).contains("does not name"),
        "{}",
        stderr(&output)
    );
    assert_eq!(place.plotted().matches("<circle").count(), 6);
}

/// Runs that a plot does not tell apart have curves of their own, and the command says so; a mean must be asked for.
#[test]
fn no_run_is_averaged_unless_the_plot_says_so() {
    let place = Place::with(&plot("by = \"lattice.cells\""));
    let output = place.sweep(&[]);
    assert_success(&output);
    let told = stderr(&output);
    for words in [
        "study.toml:13:1",
        "each of the 2 values of material.tensile_strength has a curve",
        "mean = \"material.tensile_strength\"",
    ] {
        assert!(told.contains(words), "{words}: {told}");
    }
    let svg = place.plotted();
    for label in [
        ">coarse, tensile_strength = 1e6<",
        ">fine, tensile_strength = 1.2e6<",
    ] {
        assert!(svg.contains(label), "{label}: {svg}");
    }
    assert!(!svg.contains("mean"));

    place.study(&plot(
        "by = \"lattice.cells\"\nmean = \"material.tensile_strength\"",
    ));
    let output = place.sweep(&["--collect"]);
    assert_success(&output);
    assert!(!stderr(&output).contains("warning"), "{}", stderr(&output));
    assert!(
        place
            .plotted()
            .contains(">mean over material.tensile_strength<")
    );
    assert!(stdout(&output).contains("(mean over material.tensile_strength)"));

    // A column over which no two runs coincide draws all runs, and averages none.
    place.study(&format!(
        "{THREE_AXES}[[plot]]\nx = \"elastic_stiffness\"\ny = \"first_peak.reaction\"\nby = \"material.tensile_strength\"\n"
    ));
    let output = place.sweep(&["--collect"]);
    assert!(
        !stderr(&output).contains("does not name"),
        "{}",
        stderr(&output)
    );
}

/// Errors against a number, a column, the finest run and a table, which follow from the columns of the same table.
#[test]
fn results_are_compared_with_references() {
    let place = Place::with(&format!(
        r#"{THREE_AXES}
[[result]]
name = "relative"
of = "first_peak.reaction"
over = 600.0
[[result]]
name = "of_number"
of = "first_peak.reaction"
reference = 500
[[result]]
name = "of_column"
of = "first_peak.reaction"
reference = "relative"
[[result]]
name = "of_finest"
of = "first_peak.reaction"
reference = "finest"
[[result]]
name = "of_finest_horizon"
of = "first_peak.reaction"
reference = "finest"
along = "model.horizon_factor"
[[result]]
name = "of_table"
of = "first_peak.reaction"
over = 2.0
reference = {{ file = "measured.csv", column = "peak", key = ["lattice.cells", "model.horizon_factor"] }}
"#
    ));
    let measured = "lattice.cells,model.horizon_factor,peak\ncoarse,2.2,100\ncoarse,3.2,200\nfine,3.20,400\nfine,2.2,300\n";
    fs::write(place.path("measured.csv"), measured).unwrap();
    assert_success(&place.sweep(&[]));
    let table = place.table();
    let peaks = table.numbers("first_peak.reaction");
    let expect = |name: &str, of: &dyn Fn(usize) -> f64| {
        for (run, found) in table.numbers(name).into_iter().enumerate() {
            assert_eq!(found, of(run), "{name} of run {run}");
        }
    };
    expect("of_number", &|run| peaks[run] / 500.0 - 1.0);
    expect("of_column", &|run| peaks[run] / (peaks[run] / 600.0) - 1.0);
    // The last four of the eight runs have the finer lattice.
    expect("of_finest", &|run| peaks[run] / peaks[run % 4 + 4] - 1.0);
    // All horizons have as many points: the first is taken.
    expect("of_finest_horizon", &|run| {
        peaks[run] / peaks[run / 2 * 2] - 1.0
    });
    let measured = [100.0, 200.0, 100.0, 200.0, 300.0, 400.0, 300.0, 400.0];
    expect("of_table", &|run| peaks[run] / 2.0 / measured[run] - 1.0);
}

/// Length, area and height of cracks equal the values of `ligament crack`, and both pictures of all runs show every run.
#[test]
fn cracks_are_results_and_all_runs_are_drawn() {
    let place = Place::with(
        r#"title = "Slits"
case = "bar/case.toml"
[[axis]]
key = "material.fracture_energy"
values = [50.0, 60.0]
[[axis]]
key = "model.horizon_factor"
values = [2.5, 3.0]
[[result]]
name = "height"
of = "crack.height"
from = 0.03
to = 0.055
[[result]]
name = "height_at"
of = "crack.height"
at = 0.04
[[result]]
name = "beyond"
of = "crack.height"
at = 0.07
[[plot]]
x = "model.horizon_factor"
y = "crack.length"
by = "material.fracture_energy"
[[plot]]
kind = "crack-paths"
by = ["material.fracture_energy", "model.horizon_factor"]
[[plot]]
kind = "curves"
"#,
    );
    fs::write(place.path("bar/case.toml"), SLIT).unwrap();
    let output = place.sweep(&[]);
    assert_success(&output);
    let told = stderr(&output);
    assert!(
        told.contains("`beyond`: no crack line leads over the whole range of x in 4 runs"),
        "{told}"
    );
    let table = place.table();
    assert_eq!(table.column("beyond"), [""; 4]);
    for (run, name) in table.column("run").into_iter().enumerate() {
        let folder = place.path("out/runs").join(name);
        assert_success(&ligament(["crack".as_ref(), folder.as_os_str()]));
        let growth = Table::read(&folder.join("crack_growth.csv"));
        for (column, of) in [("crack.length", "length"), ("crack.area", "area")] {
            assert_eq!(
                table.numbers(column)[run],
                *growth.numbers(of).last().unwrap()
            );
        }
        // The crack runs on from the slit at y = 60 mm to the other side, 40 mm; a path leaves its row by a cell at most.
        assert!((table.numbers("crack.length")[run] - 0.04).abs() < 0.005);
        for height in ["height", "height_at"] {
            assert!((table.numbers(height)[run] - 0.06).abs() < 0.005);
        }
    }
    let paths = fs::read_to_string(place.path("out/crack-paths.svg")).unwrap();
    for words in [
        "fracture_energy = 50",
        ">2.5<",
        ">3.0<",
        "Slits: crack paths at the end",
        "pre-crack",
    ] {
        assert!(paths.contains(words), "{words}: {paths}");
    }
    let curves = fs::read_to_string(place.path("out/curves.svg")).unwrap();
    for words in [
        "fracture_energy = 50.0, horizon_factor = 2.5",
        "fracture_energy = 60.0, horizon_factor = 3.0",
    ] {
        assert!(curves.contains(words), "{words}: {curves}");
    }
    assert!(place.path("out/crack-paths.png").is_file() && place.path("out/curves.png").is_file());

    // The same curves from the folder of the study, and the paths over one another.
    let draw = |words: &[&str]| {
        let all = [&["plot", "out", "--format", "svg"], words].concat();
        let output = crate::support::ligament_in(place.folder.path(), &all);
        assert_success(&output);
        let path = stdout(&output);
        fs::read_to_string(place.path(path.trim())).unwrap()
    };
    let drawn = draw(&[]);
    let lines = |svg: &str| svg.matches("stroke=\"#0072b2\"").count();
    assert!(drawn.contains("fracture_energy = 60") && lines(&drawn) > 0);
    assert!(draw(&["--crack=lines"]).contains("horizon_factor = 2.5"));
    let refused =
        crate::support::ligament_in(place.folder.path(), &["plot", "out", "--field", "damage"]);
    assert_eq!(refused.status.code(), Some(1));
    assert!(stderr(&refused).contains("--field draws the body of one run"));
}

/// Few bonds a family under a criterion of stress are told once for the study, before its runs.
#[test]
fn few_bonds_under_a_criterion_of_stress_are_told_once() {
    let place = Place::with(
        r#"case = "bar/case.toml"
[set]
"fracture.criterion" = [{ kind = "tension" }]
[[axis]]
key = "model.horizon_factor"
values = [2.0, 3.0]
[[axis]]
key = "material.tensile_strength"
values = [1e6, 1.2e6]
"#,
    );
    let output = place.sweep(&["--list"]);
    assert_success(&output);
    let told = stderr(&output);
    assert_eq!(told.matches("so few bonds").count(), 1, "{told}");
    assert!(
        told.contains("2 of 4 runs: criterion \"tension\""),
        "{told}"
    );
}
