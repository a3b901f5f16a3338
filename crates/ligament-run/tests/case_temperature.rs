//! `[[temperature]]` and `thermal_expansion`: keys, defaults, faults, and files of temperatures on the points of a body.

#![allow(clippy::unwrap_used, reason = "a failed unwrap fails the test")]

use std::fs;
use std::path::Path;

use ligament::Loading;
use ligament_analysis::ControlKind;
use ligament_case::case::CaseFile;
use ligament_run::model::build_model;
use ligament_run::progress::{Progress, ProgressMode};
use ligament_run::stages::Stages;
use tempfile::TempDir;

/// Two cells of 1 m beside each other, and two above them.
const LATTICE: &str = r#"
[lattice]
cells = [2, 2]
spacing = 1.0
plane = "stress"
[lattice.set]
top = { top = 1 }
[material]
young = 1e9
poisson = 0.25
thermal_expansion = 1e-5
[model]
law = "nhpd"
horizon = 1.5
[[temperature]]
change = 50.0
"#;

/// A square of two triangles on its nodes 11 to 14, with two views: one of two time steps, one of vectors.
const MESH: &str = "$MeshFormat
2.2 0 8
$EndMeshFormat
$PhysicalNames
3
1 1 \"base\"
2 2 \"right\"
2 3 \"left\"
$EndPhysicalNames
$Nodes
4
11 0 0 0
12 1 0 0
13 1 1 0
14 0 1 0
$EndNodes
$Elements
3
1 1 2 1 1 11 12
2 2 2 2 1 11 12 13
3 2 2 3 2 11 13 14
$EndElements
$NodeData
1
\"heat\"
1
0.0
3
0
1
4
11 293
12 303
13 313
14 293
$EndNodeData
$NodeData
1
\"heat\"
1
1.0
3
1
1
3
11 300
12 310
13 320
$EndNodeData
$NodeData
1
\"flux\"
1
0.0
3
0
3
1
11 1 0 0
$EndNodeData
";

/// The case of the lattice on the mesh, in a folder with it.
fn meshed(temperature: &str) -> (TempDir, String) {
    let folder = tempfile::tempdir().unwrap();
    fs::write(folder.path().join("square.msh"), MESH).unwrap();
    let (_, rest) = LATTICE.split_once("[material]").unwrap();
    let (rest, _) = rest.split_once("[[temperature]]").unwrap();
    let rest = rest.replace("horizon = 1.5", "horizon = 2.0");
    let text = format!("[mesh]\nfile = \"square.msh\"\n[material]{rest}{temperature}");
    (folder, text)
}

fn parse_in(folder: &Path, text: &str) -> Result<CaseFile, String> {
    let parsed = CaseFile::parse(&folder.join("case.toml"), text.to_owned(), &[]);
    parsed.map_err(|error| error.to_string())
}

fn parse(text: &str) -> Result<CaseFile, String> {
    parse_in(Path::new(""), text)
}

/// The error of the lattice with `old` replaced by `new`.
fn error_with(old: &str, new: &str) -> String {
    assert!(LATTICE.contains(old), "the case has no `{old}`");
    parse(&LATTICE.replacen(old, new, 1)).unwrap_err()
}

fn loading(case: &CaseFile) -> anyhow::Result<Loading> {
    let progress = Progress::new(ProgressMode::Quiet);
    let model = build_model(case, &mut Stages::default(), &progress)?;
    Ok(Loading::new(&model).map_err(|it| case.error_at_key(it))?)
}

/// Changes of the points of a case in a folder, in the order of its mesh file, K.
fn changes_in(folder: &Path, text: &str) -> Result<Vec<f64>, String> {
    let case = parse_in(folder, text)?;
    let loading = loading(&case).map_err(|error| error.to_string())?;
    let setup = case.setup(&mut ()).map_err(|error| error.to_string())?;
    let changes = loading.boundary.temperature_change.clone();
    Ok(setup.body.numbering().to_file(changes))
}

fn changes(text: &str) -> Result<Vec<f64>, String> {
    changes_in(Path::new(""), text)
}

#[test]
fn the_sections_are_read() {
    let case = parse(LATTICE).unwrap().case;
    assert_eq!(case.temperatures.len(), 1);
    let first = &case.temperatures[0];
    assert_eq!((&first.group, first.r#box), (&None, None));
    assert_eq!(first.change, Some(50.0));
    assert_eq!(case.materials[0].expansion.thermal_expansion, Some(1e-5));
    let text = format!("{LATTICE}[[temperature]]\nbox = [[1, 2], [0, 1]]\nfile = \"a.csv\"\n");
    let case = parse_in(Path::new("/somewhere"), &text).unwrap();
    let second = &case.case.temperatures[1];
    assert_eq!(second.r#box, Some([[0.0, 1.0], [1.0, 2.0]].into()));
    let file = Path::new("/somewhere/a.csv").to_owned();
    assert_eq!(second.file, Some(file));
    // The resolved case of a run is the same case.
    let again = parse(&case.resolved_toml().unwrap()).unwrap();
    assert_eq!(again.case, case.case);
}

#[test]
fn orthotropic_materials_have_coefficients_along_their_axes() {
    let lamina = "young_1 = 2e9\nyoung_2 = 1e9\npoisson_12 = 0.25\nshear_modulus = 4e8\n";
    let text = LATTICE
        .replace("young = 1e9\npoisson = 0.25\n", lamina)
        .replace("\"nhpd\"", "\"orthotropic\"");
    assert!(parse(&text).is_ok());
    let axes = "thermal_expansion_1 = -1e-6\nthermal_expansion_2 = 3e-5";
    let text = text.replace("thermal_expansion = 1e-5", axes);
    let case = parse(&text).unwrap();
    let material = &case.case.materials[0].expansion;
    let (one, two) = (material.thermal_expansion_1, material.thermal_expansion_2);
    assert_eq!((one, two), (Some(-1e-6), Some(3e-5)));
    assert_eq!(material.thermal_expansion_3, None);
    let again = parse(&case.resolved_toml().unwrap()).unwrap();
    assert_eq!(again.case, case.case);
    let wrong = |old: &str, new: &str| parse(&text.replacen(old, new, 1)).unwrap_err();
    let error = wrong("thermal_expansion_1 = -1e-6\n", "");
    assert!(
        error.ends_with(
            "material.thermal_expansion_1: missing key `thermal_expansion_1`: it is required (in 1/K) because a \
             coefficient along another axis is given"
        ),
        "{error}"
    );
    let error = wrong(
        "thermal_expansion_1",
        "thermal_expansion = 1e-5\nthermal_expansion_1",
    );
    assert!(error.contains("remove one of the two"), "{error}");
    let strain = "young_3 = 1e9\npoisson_13 = 0.2\npoisson_23 = 0.2\nyoung_1";
    let text = text
        .replacen("young_1", strain, 1)
        .replace("\"stress\"", "\"strain\"");
    let error = parse(&text).unwrap_err();
    assert!(
        error.ends_with(
            "`thermal_expansion_3`: it is required (in 1/K) because of plane strain, where it widens the plane"
        ),
        "{error}"
    );
}

#[test]
fn faults_say_what_to_do() {
    for (old, new, expected) in [
        (
            "thermal_expansion = 1e-5",
            "thermal_expansion = 23",
            "case.toml:11:21: material.thermal_expansion: must be between -0.01 and 0.01 (1/K; steel has about 12e-6), found \
             23.0",
        ),
        (
            "thermal_expansion = 1e-5",
            "thermal_expansion_1 = 1e-5",
            "unknown key `thermal_expansion_1` in [material]; did you mean `thermal_expansion`?",
        ),
        (
            "change = 50.0",
            "chang = 50.0",
            "temperature.0.chang: unknown key `chang` in [[temperature]]; did you mean `change`?",
        ),
        (
            "change = 50.0",
            "change = \"50 K\"",
            "values are plain numbers in SI units, here K",
        ),
        (
            "change = 50.0",
            "group = \"top\"",
            "temperature.0: needs exactly one of `change`, `file`, `mesh_field`; found none",
        ),
        (
            "change = 50.0",
            "change = 50.0\nfile = \"a.csv\"",
            "found `change`, `file`",
        ),
        (
            "change = 50.0",
            "change = 50.0\nreference = 293.0",
            "`reference` does not apply with `change` or `file`: it belongs to a `mesh_field`; remove it",
        ),
        (
            "change = 50.0",
            "mesh_field = \"heat\"",
            "`mesh_field` does not apply with [lattice]: it is in the file of a mesh; a lattice takes a `file` of its own; \
             remove it",
        ),
        (
            "[[temperature]]",
            "[temperature]",
            "write [[temperature]] instead of [temperature]",
        ),
        (
            "[[temperature]]\nchange = 50.0",
            "",
            "the case has no [[load]] section; it needs one or more, or a [[temperature]], or nothing would happen",
        ),
        (
            "[lattice]",
            "analysis = \"modal\"\n[lattice]",
            "`temperature` does not apply with analysis = \"modal\"",
        ),
    ] {
        let error = error_with(old, new);
        assert!(error.contains(expected), "{error}");
    }
    let of_body = |old: &str, new: &str| changes(&LATTICE.replacen(old, new, 1)).unwrap_err();
    let error = of_body("thermal_expansion = 1e-5\n", "");
    assert!(
        error.ends_with(
            "material.thermal_expansion: missing key `thermal_expansion`: it is required (in 1/K) because the temperature of \
             cell 1 at (0.500000, 0.500000) changes, which has this material"
        ),
        "{error}"
    );
    let error = of_body("change = 50.0", "change = 0.0");
    assert!(error.contains("nothing would happen"), "{error}");
    let error = of_body("change = 50.0", "change = 5.0\ngroup = \"tip\"");
    assert!(
        error.contains("temperature.0.group: no set of the lattice is called `tip`"),
        "{error}"
    );
}

/// Without a load the temperature is the control, of the size of the largest change; for each point the last section that reaches it
/// counts.
#[test]
fn the_last_section_holds() {
    let text = format!(
        "{LATTICE}[[temperature]]\ngroup = \"top\"\nchange = -80.0\n[[temperature]]\nbox = [[1, 1], [2, 2]]\nchange = 20.0\n"
    );
    assert_eq!(changes(&text).unwrap(), [50.0, 50.0, -80.0, 20.0]);
    let boundary = loading(&parse(&text).unwrap()).unwrap().boundary;
    let control = &boundary.control;
    assert_eq!(
        (control.kind, control.magnitude),
        (ControlKind::Temperature, 80.0)
    );
    let strains = [5e-4, 5e-4, -8e-4, 2e-4].map(|strain| [strain, strain, 0.0]);
    for (found, expected) in boundary.thermal_strain.of_points().iter().zip(&strains) {
        for (found, expected) in found.components().zip(expected) {
            assert!((found - expected).abs() < 1e-18);
        }
    }
    let loaded = format!("{text}[[load]]\ngroup = \"top\"\nforce = {{ y = 1.0 }}\n");
    let control = loading(&parse(&loaded).unwrap())
        .unwrap()
        .boundary
        .control
        .clone();
    assert_eq!(control.kind, ControlKind::Force);
}

/// Nodes that two surfaces share have the mean by volume, whatever the order; a curve and a box take whole nodes. Node 11 and
/// 13 lie on the diagonal between the triangles, of equal area.
#[test]
fn surfaces_share_the_nodes_between_them() {
    let sections = [
        "[[temperature]]\ngroup = \"right\"\nchange = 10.0\n",
        "[[temperature]]\ngroup = \"left\"\nchange = 40.0\n",
    ];
    for order in [[0, 1], [1, 0]] {
        let text: String = order.iter().map(|&section| sections[section]).collect();
        let (folder, text) = meshed(&text);
        assert_eq!(
            changes_in(folder.path(), &text).unwrap(),
            [25.0, 10.0, 25.0, 40.0]
        );
        let curve = format!("{text}[[temperature]]\ngroup = \"base\"\nchange = 4.0\n");
        assert_eq!(
            changes_in(folder.path(), &curve).unwrap(),
            [4.0, 4.0, 25.0, 40.0]
        );
    }
    let (folder, text) = meshed(sections[1]);
    assert_eq!(
        changes_in(folder.path(), &text).unwrap(),
        [20.0, 0.0, 20.0, 40.0]
    );
}

#[test]
fn tables_give_each_point_the_row_beside_it() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("heat.csv");
    let text = LATTICE.replace("change = 50.0", "file = \"heat.csv\"");
    let of_table = |table: &str| {
        fs::write(&path, table).unwrap();
        changes_in(folder.path(), &text)
    };
    // With a byte order mark, other columns, another order, a row of no cell, coordinates off by less than a tenth of a cell.
    let table = "\u{feff}# from somewhere\r\n\"y\", x,id,change\r\n1.5,0.5,corner,3\r\n0.5,0.5,8,1e0\r\n\r\n0.5,1.45,9,2\r\n\
                 1.5,1.5,1,4.5\r\n9,9,2,99";
    assert_eq!(of_table(table).unwrap(), [1.0, 2.0, 3.0, 4.5]);
    let wrong = |table: &str, expected: &str| {
        let error = of_table(table).unwrap_err();
        assert!(error.contains(expected), "{error}");
        assert!(
            error.contains("case.toml:16:8: temperature.0.file:"),
            "{error}"
        );
    };
    wrong("", "heat.csv:1: the file is empty");
    wrong("x,y,T\n", "heat.csv:1: there is no column `change`");
    wrong(
        "x,y,change\n1,2\n",
        "heat.csv:2: 2 values, but the header names 3 columns",
    );
    wrong("x,y,change\n1,2,hot\n", "heat.csv:2: `hot` is no number");
    wrong("x,y,change\n1,2,nan\n", "heat.csv:2: `nan` is no number");
    wrong(
        "x,y,change\n0.5,0.5,1\n0.5,1.5,1\n0.7,1.5,1\n",
        "2 points have no temperature (the first is cell 2 at (1.500000, 0.500000)): the table has no row within a tenth of the distance \
         to the nearest other point",
    );
    wrong(
        "x,y,change\n0.5,0.5,1\n0.5,0.52,1\n",
        "heat.csv:3: cell 1 at (0.500000, 0.500000) has a row already, in line 2",
    );
    fs::remove_file(&path).unwrap();
    let error = changes_in(folder.path(), &text).unwrap_err();
    assert!(error.contains("cannot read"), "{error}");
}

#[test]
fn fields_of_the_mesh_file_stand_at_its_nodes() {
    let of_field = |keys: &str| {
        let (folder, text) = meshed(&format!("[[temperature]]\n{keys}\n"));
        changes_in(folder.path(), &text)
    };
    let first = "mesh_field = \"heat\"\ntime_step = 0\nreference = 293";
    assert_eq!(of_field(first).unwrap(), [0.0, 10.0, 20.0, 0.0]);
    for (keys, expected) in [
        (
            "mesh_field = \"haet\"",
            "temperature.0.mesh_field: no field at the nodes ($NodeData) in the mesh file is called `haet`; did you mean `heat`?",
        ),
        (
            "mesh_field = \"heat\"",
            "the field `heat` has several time steps (0, 1): choose one by `time_step`",
        ),
        (
            "mesh_field = \"heat\"\ntime_step = 3",
            "temperature.0.time_step: the field `heat` has no time step 3; it has 0, 1",
        ),
        (
            "mesh_field = \"flux\"",
            "the field `flux` has 3 values a node; a temperature is one value",
        ),
        (
            "mesh_field = \"heat\"\ntime_step = 1",
            "1 points have no temperature (the first is node 14 at (0.000000, 1.000000)): the field has no value",
        ),
    ] {
        let error = of_field(keys).unwrap_err();
        assert!(error.contains(expected), "{error}");
    }
}
