//! What is computed: the key `analysis` and the section `[modal]`.

#![allow(clippy::unwrap_used, reason = "a failed unwrap fails the test")]

use std::path::Path;

use ligament_analysis::modal::{ModalSettings, Rotations};
use ligament_case::case::{Analysis, CaseFile};

const MODAL: &str = include_str!("data/modal-plate.toml");

const STATIC: &str = r#"
mesh = { file = "plate.msh" }
material = { young = 15e9, poisson = 0.21, tensile_strength = 1e6 }
model = { law = "nhpd", horizon_factor = 3.0 }
load = [{ group = "right", displacement = { x = 1e-5 } }]
"#;

fn read(text: &str, settings: &[&str]) -> Result<CaseFile, String> {
    let settings: Vec<String> = settings.iter().map(|&given| given.to_owned()).collect();
    CaseFile::parse(Path::new("case.toml"), text.to_owned(), &settings)
        .map_err(|error| error.to_string())
}

fn error(text: &str, settings: &[&str]) -> String {
    read(text, settings).unwrap_err()
}

#[test]
fn the_analysis_follows_from_the_sections_or_is_named() {
    let analysis = |text, settings: &[&str]| read(text, settings).unwrap().case.analysis.unwrap();
    assert_eq!(analysis(STATIC, &[]), Analysis::Static);
    assert_eq!(analysis(STATIC, &["analysis=static"]), Analysis::Static);
    assert_eq!(analysis(STATIC, &["fracture.steps=5"]), Analysis::Fracture);
    let named = ["fracture.steps=5", "analysis=fracture"];
    assert_eq!(analysis(STATIC, &named), Analysis::Fracture);
    assert_eq!(analysis(MODAL, &[]), Analysis::Modal);
}

#[test]
fn modes_have_defaults_and_need_no_load() {
    let case = read(MODAL, &[]).unwrap().case;
    let expected = ModalSettings {
        modes: 10,
        rotations: None,
        tolerance: 1e-10,
    };
    assert_eq!(case.modal, Some(expected));
    assert_eq!(case.loads, []);
    let settings = [
        "modal.modes=3",
        "modal.rotations=massless",
        "modal.tolerance=1e-8",
    ];
    let expected = ModalSettings {
        modes: 3,
        rotations: Some(Rotations::Massless),
        tolerance: 1e-8,
    };
    assert_eq!(read(MODAL, &settings).unwrap().case.modal, Some(expected));
    let free = read(MODAL, &["support=[]"]).unwrap();
    assert_eq!(free.case.supports, []);
}

#[test]
fn contradictions_are_faults_with_their_place() {
    for (text, setting, key, reason) in [
        (
            STATIC,
            "analysis=\"fracture\"",
            "analysis",
            "needs a [fracture] section",
        ),
        (STATIC, "modal.modes=3", "modal", "analysis = \"static\""),
        (
            MODAL,
            "fracture.steps=5",
            "fracture",
            "no bond breaks in a mode",
        ),
        (MODAL, "output.bonds=true", "output", "a file of its own"),
        (
            MODAL,
            "probe=[{name=\"p\",at=[0,0],field=\"damage\"}]",
            "probe",
            "no history",
        ),
        (
            MODAL,
            "load=[{group=\"right\",force={x=1}}]",
            "load",
            "supports hold",
        ),
    ] {
        let found = error(text, &[setting]);
        let place = format!("--set {setting}: {key}: ");
        assert!(found.starts_with(&place), "{found}");
        assert!(found.contains(reason), "{found}");
    }
    let found = error(STATIC, &["fracture.steps=5", "analysis=static"]);
    assert!(
        found.contains("fracture: `fracture` does not apply"),
        "{found}"
    );
    let found = error(STATIC, &["fracture.steps=5", "modal.modes=5"]);
    assert!(found.contains("modal: `modal` does not apply"), "{found}");

    let load = "[[load]]\ngroup = \"right\"\ndisplacement = { x = 1e-5 }\n";
    let found = error(&format!("{MODAL}{load}"), &[]);
    assert!(found.starts_with("case.toml:6:1: load: "), "{found}");
    let found = error(&MODAL.replace("\"modal\"", "\"modes\""), &[]);
    assert!(found.starts_with("case.toml:1:12: analysis: "), "{found}");
    assert!(found.contains("\"modal\""), "{found}");
}

#[test]
fn values_of_the_section_are_checked() {
    for (setting, expected) in [
        ("modal.modes=0", "modal.modes: must be 1 to 1000, found 0"),
        ("modal.modes=1001", "must be 1 to 1000"),
        (
            "modal.tolerance=0.0",
            "modal.tolerance: must be greater than 0",
        ),
        ("modal.rotations=massles", "\"massless\""),
        ("modal.mode=3", "`modes`"),
    ] {
        let found = error(MODAL, &[setting]);
        assert!(found.contains(expected), "{found}");
    }
}

#[test]
fn every_material_needs_a_density() {
    let found = error(&MODAL.replace(", density = 2500.0", ""), &[]);
    assert!(found.starts_with("case.toml:3:"), "{found}");
    assert!(
        found.contains("material.density") && found.contains("kg/m^3"),
        "{found}"
    );
    let two = MODAL.replace(
        "material = { young = 15e9, poisson = 0.21, density = 2500.0 }",
        "material.a = { group = \"a\", young = 1e9, poisson = 0.2, density = 1e3 }\n\
         material.b = { group = \"b\", young = 1e9, poisson = 0.2 }",
    );
    let found = error(&two, &[]);
    assert!(found.contains("material.b.density"), "{found}");
}

#[test]
fn a_resolved_case_reads_back_the_same() {
    for (text, settings) in [
        (MODAL, vec![]),
        (STATIC, vec![]),
        (STATIC, vec!["fracture.steps=5"]),
    ] {
        let case = read(text, &settings).unwrap();
        let resolved = case.resolved_toml().unwrap();
        let again = read(&resolved, &[]).unwrap_or_else(|error| panic!("{error}\n{resolved}"));
        assert_eq!(again.case, case.case, "{resolved}");
    }
}
