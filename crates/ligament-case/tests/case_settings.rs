//! Defaults, settings from the command line and writing a case back.

#![allow(clippy::unwrap_used, reason = "a failed unwrap fails the test")]

use std::path::{Path, PathBuf};

use ligament::setup::{Displacement, Iteration};
use ligament_case::case::{CaseFile, Control, Precrack, Region, Steps, Vector, Word};
use ligament_model::Plane;
use ligament_model::bonds::precrack::Ends;

const TEXT: &str = include_str!("data/brazilian-disk.toml");

const SMALL: &str = r#"
mesh = { file = "plate.msh" }
material.rock = { group = "rock", young = 1e9, poisson = 0 }
material."soft layer" = { group = "layer", young = 1e8, poisson = 0.3, tensile_strength = 1e6 }
model = { law = "nhpd", horizon_factor = 3 }
correction = { rule = "mean" }
load = [{ body_force = { y = -2.5e4 } }, { group = "top", force_per_length = { x = 1.5 } }]
"#;

fn with(text: &str, overrides: &[&str]) -> Result<CaseFile, String> {
    let overrides: Vec<String> = overrides.iter().map(|&given| given.to_owned()).collect();
    CaseFile::parse(Path::new("case.toml"), text.to_owned(), &overrides)
        .map_err(|error| error.to_string())
}

fn set(setting: &str) -> Result<CaseFile, String> {
    with(TEXT, &[setting])
}

/// Groups of other programs may have names that cannot head a column of a table.
#[test]
fn a_group_that_cannot_name_a_column_is_loaded_as_it_is() {
    for group in ["a#b, [c] $Nodes", " top edge ", "the \\\"top\\\"", "-x"] {
        let text = SMALL.replace("group = \"top\"", &format!("group = \"{group}\""));
        assert_ne!(text, SMALL);
        let load = &with(&text, &[]).unwrap().case.loads[1];
        let names = (load.name.as_deref(), load.group.as_deref());
        let group = group.replace('\\', "");
        assert_eq!(names, (Some("load-2"), Some(group.as_str())));
    }
}

#[test]
fn defaults_are_filled_in() {
    let case = with(SMALL, &[]).unwrap().case;
    assert_eq!(
        case.mesh.as_ref().map(|it| (it.thickness, it.plane)),
        Some((None, Some(Plane::Stress)))
    );
    let mean = Some(Word(Some(Iteration::MEAN)));
    assert_eq!(
        (case.correction.rule, case.correction.max_sweeps),
        (mean, Some(500))
    );
    assert_eq!(case.loads[0].name.as_deref(), Some("load-1"));
    assert_eq!(
        case.loads[0].body_force,
        Some(Vector {
            x: 0.0,
            y: -2.5e4,
            z: None
        })
    );
    let top = &case.loads[1];
    assert_eq!(
        (top.name.as_deref(), top.group.as_deref()),
        (Some("top"), Some("top"))
    );
    assert_eq!(case.materials[1].key(), "material.\"soft layer\"");
    assert_eq!(case.fracture, None);
    assert_eq!(
        (case.output.fields_every, case.output.bonds),
        (Some(10), false)
    );
}

#[test]
fn the_case_is_read_as_it_is_written() {
    let case = with(TEXT, &[]).unwrap().case;
    assert_eq!(
        case.precracks,
        [Precrack {
            points: Some(vec![[-0.015, 0.0].into(), [0.015, 0.0].into()]),
            centre: None,
            length: None,
            angle: None,
            normal: None,
            radius: None,
            group: None,
            ends: Ends::Excluded,
        }]
    );
    let held = Displacement {
        x: Some(0.0),
        ..Displacement::default()
    };
    assert_eq!(case.supports[1].displacement, Some(held));
    let ordered = Region {
        group: None,
        r#box: Some([[-0.01, 0.04], [0.01, 0.05]].into()),
    };
    assert_eq!(case.no_fail, [ordered]);
    let fracture = case.fracture.unwrap();
    assert_eq!(fracture.control, Control::Stepped);
    assert_eq!(
        (fracture.steps, fracture.bonds_per_iteration),
        (Some(Steps::Uniform(100)), Some(5))
    );
    assert_eq!(
        (fracture.stop.load_fraction, fracture.stop.wall_time),
        (Some(0.5), None)
    );
}

#[test]
fn a_resolved_case_reads_as_the_same_case() {
    for text in [TEXT, SMALL] {
        let resolved = with(text, &[]).unwrap().resolved_toml().unwrap();
        let elsewhere =
            CaseFile::parse(Path::new("/elsewhere/case.toml"), resolved.clone(), &[]).unwrap();
        assert_eq!(elsewhere.case, with(text, &[]).unwrap().case);
        assert_eq!(elsewhere.resolved_toml().unwrap(), resolved);
    }
}

#[test]
fn the_exact_path_has_no_keys_of_load_steps() {
    let text = TEXT
        .replace("steps = 100", "control = \"event\"")
        .replace("fields_every = 5", "");
    let case_file = with(&text, &[]).unwrap();
    let fracture = case_file.case.fracture.as_ref().unwrap();
    assert_eq!(fracture.control, Control::Event);
    assert_eq!(
        (fracture.tie_tolerance, fracture.stop.bonds),
        (1e-8, Some(300))
    );
    assert_eq!(case_file.case.output.fields_every, Some(100));
    let resolved = case_file.resolved_toml().unwrap();
    let lines: Vec<&str> = resolved.lines().collect();
    assert!(lines.contains(&"control = \"event\"") && lines.contains(&"tie_tolerance = 1e-8"));
    assert!(!resolved.contains("steps") && !resolved.contains("bonds_per_iteration"));
    let again = with(&resolved, &[]).unwrap();
    assert_eq!(again.case, case_file.case);
    // Load steps written back say what drives the load as well.
    let stepped = with(TEXT, &[]).unwrap().resolved_toml().unwrap();
    let lines: Vec<&str> = stepped.lines().collect();
    assert!(lines.contains(&"control = \"stepped\"") && lines.contains(&"steps = 100"));
    // No stop rule is needed: the path ends at load factor 1.
    let bare = with(
        SMALL,
        &[
            "fracture.control=event",
            "material.rock.tensile_strength=2e6",
        ],
    );
    assert_eq!(bare.unwrap().case.fracture.unwrap().control, Control::Event);
}

#[test]
fn a_resolved_case_has_headers_defaults_and_an_absolute_mesh() {
    let resolved = with(
        SMALL,
        &[
            "fracture.steps=[0.5, 1]",
            "material.rock.tensile_strength=2e6",
        ],
    )
    .unwrap();
    let text = resolved.resolved_toml().unwrap();
    let absolute = std::path::absolute("plate.msh").unwrap();
    for line in [
        &format!("file = \"{}\"", absolute.display()),
        "[material.\"soft layer\"]",
        "young = 1e9",
        "[[load]]",
        "body_force = { x = 0.0, y = -25000.0 }",
        "steps = [0.5, 1.0]",
        "tie_tolerance = 1e-8",
        "fields_every = 10",
    ] {
        assert!(
            text.lines().any(|other| other == line),
            "no `{line}` in\n{text}"
        );
    }
}

#[test]
fn overrides_change_make_and_replace_settings() {
    let case = with(
        TEXT,
        &[
            "mesh.plane=strain",
            "load.0.displacement.y = -1e-6",
            "fracture.stop={ bonds = 10 }",
            "fracture.stop.wall_time=60",
            "output.bonds=true",
            "precrack.0.points.1=[0.02, 0.001]",
            "title=Disk under load",
            "title=Disk under a small load",
        ],
    );
    let case = case.unwrap().case;
    assert_eq!(case.plane(), Plane::Strain);
    let pushed = Displacement {
        y: Some(-1e-6),
        ..Displacement::default()
    };
    assert_eq!(case.loads[0].displacement, Some(pushed));
    let stop = case.fracture.unwrap().stop;
    assert_eq!(
        (stop.bonds, stop.wall_time, stop.load_fraction),
        (Some(10), Some(60.0), None)
    );
    assert!(case.output.bonds);
    let points = case.precracks[0].points.as_ref().unwrap();
    assert_eq!(points[1], [0.02, 0.001].into());
    assert_eq!(case.title, "Disk under a small load");
    let small = with(SMALL, &["output.fields_every=3"]).unwrap();
    assert_eq!(small.case.output.fields_every, Some(3));
}

/// Keys are taken away before others are set, so that a case with load steps can be followed on the exact path; an entry of a list
/// goes as a whole, and what is not there is told.
#[test]
fn keys_are_taken_away() {
    let taken = with(TEXT, &["-fracture.steps", "fracture.control=event"]);
    let fracture = taken.unwrap().case.fracture.unwrap();
    assert_eq!((fracture.control, fracture.steps), (Control::Event, None));
    let probes = |settings: &[&str]| with(TEXT, settings).unwrap().case.probes.len();
    assert_eq!(probes(&["-probe.1"]), probes(&[]) - 1);
    for (key, reason) in [
        (
            "fracture.step",
            "the case has no `fracture.step` to take away; did you mean `steps`?",
        ),
        (
            "probe.7",
            "there is no `probe.7`: the indices of `probe` are 0 to 2",
        ),
        (
            "model.law.x",
            "`model.law` is a value, not a table: it has no `x` below it",
        ),
        ("", "`` is not a key path"),
    ] {
        let error = with(TEXT, &[&format!("-{key}")]).unwrap_err();
        let expected = format!("--unset {key}: {reason}");
        assert!(error.starts_with(&expected), "{error}");
    }
}

#[test]
fn faults_of_overrides_are_blamed_on_them() {
    for (setting, expected) in [
        (
            "model.horizont_factor=4",
            "model.horizont_factor: unknown key `horizont_factor` in [model]; did you mean \
             `horizon_factor`? valid keys: `law`, `horizon_factor`, `horizon`, `bonds_through_voids`, `closing`, `closing_friction`, `allow_unstable`, `poisson`, `calibration`, \
             `rotational_stiffness`, `rotational_factor`, `cosserat_length`, `form`, `strains`",
        ),
        (
            "mesh.plane=strian",
            "mesh.plane: unknown value \"strian\"; did you mean \"strain\"? valid values: \
             \"stress\", \"strain\"",
        ),
        (
            "material.young=15 GPa",
            "material.young: expected a number, found the string \"15 GPa\"; values are plain \
             numbers in SI units, here Pa",
        ),
        (
            "model.horizon_factor=0.5",
            "model.horizon_factor: must be at least 1, found 0.5",
        ),
        (
            "load.1.name=x",
            "there is no `load.1`: the only index of `load` is 0",
        ),
        (
            "probe.3.name=x",
            "there is no `probe.3`: the indices of `probe` are 0 to 2",
        ),
        (
            "load.top.name=x",
            "`load` is a list: `top` should be an index from 0",
        ),
        (
            "model.law.x=1",
            "`model.law` is a value, not a table: it has no `x` below it",
        ),
        (
            "title",
            "expected key=value, such as model.horizon_factor=4",
        ),
        ("title=", "there is no value after `=`"),
        ("=3", "`` is not a key path such as load.0.displacement.y"),
        (
            "load.0.displacement={y=1",
            "the value is not valid TOML: unclosed inline table, expected `}`",
        ),
        (
            "load.0.force.y=1",
            "load.0: needs exactly one of `displacement`, `velocity`, `base_acceleration`, `force`, `force_per_length`, `force_per_area`, \
             `body_force`, `acceleration`, `moment`, `body_couple`, `pressure`; found `displacement`, `force`",
        ),
    ] {
        assert_eq!(
            set(setting).unwrap_err(),
            format!("--set {setting}: {expected}")
        );
    }
    let missing = with(SMALL, &["precrack.0.points=[]"]).unwrap_err();
    assert!(
        missing.ends_with("there is no `precrack.0`: the case has no `precrack`"),
        "{missing}"
    );
    let unknown = set("lod.0.group=x").unwrap_err();
    assert!(
        unknown.contains("unknown key `lod` in the case file; did you mean `load`?"),
        "{unknown}"
    );
}

#[test]
fn an_overridden_value_has_no_place_in_the_file() {
    let case_file = set("load.0.group=top").unwrap();
    assert_eq!(case_file.locate("load.0.group"), None);
    let error = case_file.error("load.0.group", "not in the mesh");
    assert_eq!(
        error.to_string(),
        "--set load.0.group=top: load.0.group: not in the mesh"
    );
}

#[test]
fn a_case_is_called_after_its_folder_or_its_file() {
    let name = |path: &str| {
        CaseFile::parse(Path::new(path), TEXT.to_owned(), &[])
            .unwrap()
            .name()
    };
    assert_eq!(name("cases/disk/case.toml"), "disk");
    assert_eq!(name("cases/disk-fine.toml"), "disk-fine");
    let here: PathBuf = std::env::current_dir().unwrap();
    assert_eq!(
        Some(name("case.toml").as_str()),
        here.file_name().and_then(|name| name.to_str())
    );
}
