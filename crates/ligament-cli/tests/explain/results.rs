//! Contents and gaps of a result folder, and what `explain` reports about them.

use super::*;

/// The mesh may be gone and the folder elsewhere.
#[test]
fn the_folder_alone_is_enough() {
    let folder = tempfile::tempdir().unwrap();
    let mesh = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../meshes/plate-coarse.msh");
    fs::copy(mesh, folder.path().join("plate.msh")).unwrap();
    let case = r#"
mesh = { file = "plate.msh" }
material = { young = 15e9, poisson = 0.21, tensile_strength = 3.81e6 }
model = { law = "nhpd", horizon_factor = 3.0 }
support = [{ group = "left", displacement = { x = 0.0, y = 0.0 } }]
load = [{ group = "right", displacement = { x = 5e-5 } }]
fracture = { steps = 4 }
output = { fields_every = 2 }
"#;
    let results = run(folder.path(), case, &[]);
    let at = ["--at", "-0.5,0.031"];
    let before = explain(&results, &at);
    let elsewhere = tempfile::tempdir().unwrap();
    let moved = elsewhere.path().join("moved");
    fs::rename(&results, &moved).unwrap();
    fs::remove_file(folder.path().join("plate.msh")).unwrap();
    let after = explain(&moved, &at);
    let below_title = |text: &str| text.split_once('\n').unwrap().1.to_owned();
    assert_eq!(below_title(&before), below_title(&after));
    assert!(after.starts_with("node "), "{after}");
    assert!(
        after.contains("nearest to        (-0.500000, 0.031000) m"),
        "{after}"
    );
    assert!(after.contains("3 of 5 steps have fields"), "{after}");
}

#[test]
fn what_is_not_there_is_named() {
    let folder = tempfile::tempdir().unwrap();
    let results = run(folder.path(), BAR, &["output.fields_every=0"]);
    let unknown = refusal(&results, &["--point", "46"]);
    let expected = "error: there is no cell 46: the tags go from 1 to 45, and the nearest is 45\n";
    assert_eq!(unknown, expected);
    let unknown = refusal(&results, &["--bond", "1", "0"]);
    assert!(
        unknown.contains("no cell 0: the tags go from 1 to 45, and the nearest is 1"),
        "{unknown}"
    );
    let same = refusal(&results, &["--bond", "7", "7"]);
    assert!(
        same.contains("both are cell 7") && same.contains("--point 7"),
        "{same}"
    );
    let nowhere = refusal(&folder.path().join("nowhere"), &["--point", "1"]);
    assert!(nowhere.contains("there is no such folder"), "{nowhere}");
    let no_results = refusal(folder.path(), &["--point", "1"]);
    assert!(
        no_results.contains("it has no case.resolved.toml"),
        "{no_results}"
    );
    let file = refusal(&folder.path().join("case.toml"), &["--point", "1"]);
    assert!(file.contains("it is a file"), "{file}");
    for wrong in [
        vec![],
        vec!["--at", "1"],
        vec!["--bond", "1"],
        vec!["--point", "1", "--at", "0,0"],
    ] {
        assert_eq!(call(&results, &wrong).status.code(), Some(2), "{wrong:?}");
    }
    // Files that an earlier version, or a case without them, leaves out.
    let without = run(folder.path(), BAR, &["output.model=false"]);
    assert!(!without.join("model.vtu").exists());
    let message = refusal(&without, &["--point", "1"]);
    assert!(
        message.contains("no model.vtu") && message.contains("--set output.model=true"),
        "{message}"
    );
    assert!(
        fs::read_to_string(without.join("case.resolved.toml"))
            .unwrap()
            .contains("model = false")
    );
}

#[test]
fn a_damaged_result_is_named() {
    let folder = tempfile::tempdir().unwrap();
    let results = run(folder.path(), BAR, &[]);
    let model = results.join("model.vtu");
    let whole = fs::read(&model).unwrap();
    fs::write(&model, &whole[..whole.len() / 2]).unwrap();
    let message = refusal(&results, &["--point", "1"]);
    assert!(
        message.starts_with("error: cannot use ") && message.contains("model.vtu"),
        "{message}"
    );
    fs::write(&model, whole).unwrap();
    fs::remove_file(results.join("fields_0004.vtu")).unwrap();
    let said = explain(&results, &["--point", "1"]);
    assert!(said.contains("10 of 11 steps have fields"), "{said}");
}

/// A run that found no equilibrium at all: it has a model, and no path.
#[test]
fn a_run_without_an_end_is_told_as_such() {
    let folder = tempfile::tempdir().unwrap();
    // A stiffness that is not positive definite.
    let settings = [
        "material.poisson=0.38",
        "model.poisson=bonds",
        "solver.factorisation=llt",
    ];
    let results = run(folder.path(), SHEARED, &settings);
    let said = explain(&results, &["--bond", "25", "26"]);
    assert!(said.contains("the run is incomplete"), "{said}");
    assert!(said.contains("its utilisation was 0 throughout"), "{said}");
}

#[test]
fn modes_have_no_life_of_bonds() {
    let folder = tempfile::tempdir().unwrap();
    let case = r#"
analysis = "modal"
lattice = { cells = [6, 4], spacing = 0.01 }
material = { young = 15e9, poisson = 0.21, density = 2500.0 }
model = { law = "nhpd", horizon_factor = 3.0 }
modal = { modes = 4 }
"#;
    let results = run(folder.path(), case, &[]);
    let message = refusal(&results, &["--point", "1"]);
    assert!(message.contains("it has natural modes"), "{message}");
}

/// An elastic solution has no limits; its deformations are shown nevertheless.
#[test]
fn an_elastic_solution_is_told_without_limits() {
    let folder = tempfile::tempdir().unwrap();
    let case = BAR.replace("[fracture]\nsteps = 10\n", "");
    let results = run(folder.path(), &case, &[]);
    let said = explain(&results, &["--bond", "22", "23"]);
    assert!(
        said.contains("nothing fails in an elastic analysis"),
        "{said}"
    );
    let found = bond(&results, 22, 23);
    assert!((number(&found["path"][1]["stretch"]) - 1e-3).abs() < 1e-15);
}

/// A table has a row for each bond and step, with the numbers of the text.
#[test]
fn the_table_has_a_row_a_bond_and_step() {
    let folder = tempfile::tempdir().unwrap();
    let results = run(folder.path(), BAR, &[]);
    let file = folder.path().join("bonds.csv");
    let path = file.display().to_string();
    explain(&results, &["--bond", "22", "23", "--csv", &path]);
    let table = fs::read_to_string(&file).unwrap();
    let header = "cell_a,cell_b,step,load_factor,displacement,reaction,intact,stretch,shear,limit.strength,\
                  measure.strength,utilisation.strength";
    assert_eq!(table.lines().next().unwrap(), header);
    assert_eq!(table.lines().count(), 12);
    let row: Vec<&str> = table.lines().nth(6).unwrap().split(',').collect();
    assert_eq!(row[..3], ["22", "23", "5"]);
    let [_, stretch, limit] = closed_form(1.0, 0.0);
    let utilisation: f64 = row[11].parse().unwrap();
    assert!((utilisation - 0.5 * stretch / limit).abs() < 1e-11);
}
