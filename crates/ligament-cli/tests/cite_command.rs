//! `ligament cite`: the program and the papers of a case; and file names by which editors recognise cases.
#![allow(clippy::unwrap_used, reason = "a failed unwrap fails the test")]

use std::fs;

use crate::support::{assert_success, ligament, ligament_in, stdout};

/// The entries of a bibliography: their kinds and keys.
fn entries(text: &str) -> Vec<&str> {
    let heads = text.lines().filter_map(|it| it.strip_prefix('@'));
    heads.map(|it| it.trim_end_matches(',')).collect()
}

#[test]
fn the_program_and_the_papers_of_a_case_are_cited() {
    let alone = ligament(["cite"]);
    assert_success(&alone);
    assert_eq!(entries(&stdout(&alone)), ["software{Ligament"]);

    let folder = tempfile::tempdir().unwrap();
    // The mesh is not read.
    let case = "[mesh]\nfile = \"none.msh\"\n[material]\nyoung = 1e9\npoisson = 0.2\ntensile_strength = 1e6\nfracture_energy = 10.0\n\
         [model]\nlaw = \"nhpd\"\nhorizon_factor = 3.0\n[[support]]\nat = [0.0, 0.0]\ndisplacement = { x = 0.0, y = 0.0 }\n\
         [[load]]\nat = [1.0, 0.0]\ndisplacement = { x = 1e-6 }\n[fracture]\nsteps = 1\n\
         [[fracture.criterion]]\nkind = \"bond-energy\"\nafter = \"two-branch\"\n";
    fs::write(folder.path().join("case.toml"), case).unwrap();
    let cited = ligament_in(folder.path(), &["cite", "case.toml"]);
    assert_success(&cited);
    let text = stdout(&cited);
    let of_case = [
        "software{Ligament",
        "article{NHPD",
        "article{SillingandAskari2005",
        "misc{Petersson1981",
    ];
    let keys = |it: &str| it.split_once('{').map(|it| it.1.to_owned());
    let found: Vec<_> = entries(&text).into_iter().map(keys).collect();
    let expected: Vec<_> = of_case.into_iter().map(keys).collect();
    assert_eq!(found, expected, "{text}");
}

#[test]
fn a_case_by_another_name_has_results_of_its_name() {
    let folder = tempfile::tempdir().unwrap();
    let name = "plate.ligament.toml";
    let made = ["new", "--lattice", "12,6,0.01", "--out", name];
    assert_success(&ligament_in(folder.path(), &made));
    let run = ["run", name, "--quiet", "--set", "fracture.steps=1"];
    assert_success(&ligament_in(folder.path(), &run));
    assert!(folder.path().join("results/plate/summary.json").is_file());
}
