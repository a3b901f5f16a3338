use super::*;
use crate::places::repository;

/// Every file of the repository is read, and everything that it names exists.
#[test]
fn the_experiments_of_the_repository_are_right() {
    let mut n_files = 0;
    for entry in std::fs::read_dir(folder()).unwrap() {
        let path = entry.unwrap().path();
        if path.extension().is_none_or(|it| it != "toml") {
            continue;
        }
        n_files += 1;
        let name = path.file_stem().unwrap().to_str().unwrap();
        let file = ExperimentFile::read(name).unwrap();
        for case in file.cases() {
            assert!(repository().join(case).is_file(), "{name}: {case}");
        }
        for table in &file.table {
            let known = known_table(&table.file).unwrap();
            let mut cache = RunCache::default();
            known
                .judge(Extent::Full, |labels| {
                    cache.plan(&EntryRuns::for_entry(&file, table, labels)?)?;
                    Ok(f64::NAN)
                })
                .unwrap();
        }
    }
    assert!(n_files > 5);
}

const TEXT: &str = r#"
name = "bar"
title = "A bar"
source = "closed form"
setup = "A bar."
[numbers]
force = "area*3e6"
area = { by = "lambda", 3 = 2.0, 4 = "1 + 2" }
[run]
case = "cases/plate-tension/case.toml"
set = ['model.horizon_factor={lambda}', 'correction.surface="{correction}"', 'lattice.cells=[{60/lambda},{force/1e5}]', 'fracture={{ steps = 2 }}']
[[table]]
file = "bar-tension"
value = { by = "correction", patch = "last.stiffness/force", domain = "mean(area)" }
over = [{ key = "lambda", label = "all", members = ["3", "4"] }]
"#;

fn runs<'a>(file: &'a ExperimentFile, labels: [&str; 2]) -> anyhow::Result<EntryRuns<'a>> {
    let keys = ["lambda", "correction"].map(str::to_owned);
    let labels = labels.map(str::to_owned);
    EntryRuns::for_entry(
        file,
        &file.table[0],
        crate::table::Labels::new(&keys, &labels),
    )
}

/// Settings have numbers as TOML has them, and texts of labels.
#[test]
fn labels_become_settings() {
    let file: ExperimentFile = toml::from_str(TEXT).unwrap();
    let command = runs(&file, ["4", "patch"]).unwrap().case_run(0).unwrap();
    assert_eq!(
        command.command(),
        "ligament run cases/plate-tension/case.toml --set model.horizon_factor=4 --set correction.surface=\"patch\" --set \
         lattice.cells=[15,90] --set fracture={ steps = 2 }"
    );
    let joined = runs(&file, ["all", "domain"]).unwrap();
    assert_eq!(RunCache::default().value(&joined).unwrap(), 2.5);
}

#[test]
fn what_is_wrong_is_told() {
    for (from, to, expected) in [
        (
            "last.stiffness",
            "last.stifness",
            "no quantity is called `last.stifness`",
        ),
        (
            "\"last.stiffness/force\"",
            "\"last.stiffness/\"",
            "a term is missing",
        ),
        ("4 = \"1 + 2\"", "5 = 2.0", "nothing is given for lambda 4"),
        (
            "{correction}",
            "{surface}",
            "no label `surface`; labels: correction, lambda",
        ),
        ("{lambda}", "{lambda", "a `}` is missing"),
        (
            "patch =",
            "volume =",
            "nothing is given for correction patch",
        ),
    ] {
        let file: ExperimentFile = toml::from_str(&TEXT.replacen(from, to, 1)).unwrap();
        let found = runs(&file, ["4", "patch"]).and_then(|it| RunCache::default().plan(&it));
        let found = format!("{:#}", found.unwrap_err());
        assert!(found.contains(expected), "{from}: {found}");
    }
    for (from, to, expected) in [
        ("source", "sources", "unknown field `sources`"),
        ("{ by =", "{ of =", "`by` names the keys of the labels"),
    ] {
        let found = toml::from_str::<ExperimentFile>(&TEXT.replacen(from, to, 1)).unwrap_err();
        assert!(found.to_string().contains(expected), "{found}");
    }
}

/// The file with other settings, numbers and values than [`TEXT`] has.
fn file_with(changes: &[(&str, &str)]) -> ExperimentFile {
    let text = changes.iter().fold(TEXT.to_owned(), |text, (from, to)| {
        assert!(text.contains(from), "{from}");
        text.replacen(from, to, 1)
    });
    toml::from_str(&text).unwrap()
}

const SET: &str = r#"set = ['model.horizon_factor={lambda}', 'correction.surface="{correction}"', 'lattice.cells=[{60/lambda},{force/1e5}]', 'fracture={{ steps = 2 }}']"#;

#[test]
fn lists_and_stresses_become_settings() {
    let settings = r#"
list = { key = "fracture.steps", count = 3, item = "{item/2 + lambda}" }
stress = { principal = "-2*area; 0", angle = "0*lambda" }"#;
    let file = file_with(&[(SET, settings)]);
    let command = runs(&file, ["4", "patch"]).unwrap().case_run(0).unwrap();
    assert_eq!(
        command.command(),
        "ligament run cases/plate-tension/case.toml --set fracture.steps=[4,4.5,5] --set \
         load=[{ group = \"left\", force_per_length = { x = 6e0 } }, { group = \"right\", force_per_length = { x = -6e0 } }]"
    );
}

/// Numbers may be made of other runs, and labels change together.
#[test]
fn references_and_joined_keys_are_other_runs() {
    let references = r#"[reference.coarse]
value = "10*lambda"
labels = { lambda = "4" }
[reference.printed]
known = "omppd-table-{lambda}"
labels = { angle = "0", of = "finite elements" }
[numbers]
sum = "lambda + coarse""#;
    let file = file_with(&[
        ("[numbers]", references),
        ("last.stiffness/force", "sum"),
        ("mean(area)", "sum(factor)/difference(printed)"),
        (
            r#"key = "lambda", label = "all", members = ["3", "4"]"#,
            r#"key = "lambda, factor", members = ["3, 2", "4, 5"]"#,
        ),
    ]);
    let value = |labels| RunCache::default().value(&runs(&file, labels).unwrap());
    assert_eq!(value(["3", "domain"]).unwrap(), 7.0 / (400.85 - 1403.0));
    let several = format!("{:#}", value(["3", "patch"]).unwrap_err());
    assert!(several.contains("`sum` has 2 values"), "{several}");
    let file = file_with(&[
        ("[numbers]", references),
        ("\"last.stiffness/force\"", "\"max(sum)\""),
    ]);
    let value = |labels| RunCache::default().value(&runs(&file, labels).unwrap());
    assert_eq!(value(["3", "patch"]).unwrap(), 43.0);
}

/// Unknown quantities are refused within numbers and references as within a value.
#[test]
fn quantities_of_numbers_and_references_must_be_known() {
    for (number, expected) in [
        ("first_brake.x", "no quantity is called `first_brake.x`"),
        ("coarse", "no quantity is called `peek.reaction`"),
        ("printed", "omppd-table-3 has no [\"15\", \"lattice\"]"),
    ] {
        let references = format!(
            r#"[reference.coarse]
value = "peek.reaction"
[reference.printed]
known = "omppd-table-3"
labels = {{ angle = "15", of = "lattice" }}
[numbers]
other = "1 + {number}""#
        );
        let file = file_with(&[
            ("[numbers]", &references),
            ("last.stiffness/force", "other"),
        ]);
        let planned = runs(&file, ["3", "patch"]).and_then(|it| RunCache::default().plan(&it));
        let found = format!("{:#}", planned.unwrap_err());
        assert!(found.contains(expected), "{number}: {found}");
    }
}
