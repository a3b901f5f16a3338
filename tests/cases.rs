//! The cases and studies of the repository: each is documented, and loads and checks on its mesh.
#![allow(clippy::unwrap_used)]

use std::path::PathBuf;

use ligament::setup::Surface;
use ligament_case::case::{CaseFile, Word};
use ligament_cli::check::{CheckExtent, Lines, check};
use ligament_study::sweep::plan;
use ligament_study::sweep::study::Study;
use verification::repository;

/// What studies are called.
const STUDY: &str = "study.toml";

/// Folders of `cases/` with the case files and studies in them.
fn folders() -> Vec<(PathBuf, Vec<PathBuf>)> {
    let list = |folder: &PathBuf| {
        let entries = std::fs::read_dir(folder).unwrap();
        let mut paths: Vec<PathBuf> = entries.map(|entry| entry.unwrap().path()).collect();
        paths.sort();
        paths
    };
    let is_toml = |path: &PathBuf| {
        path.extension()
            .is_some_and(|extension| extension == "toml")
    };
    let folders = list(&repository().join("cases"));
    let folders = folders.into_iter().filter(|path| path.is_dir());
    let found: Vec<_> = folders
        .map(|folder| {
            (
                folder.clone(),
                list(&folder)
                    .into_iter()
                    .filter(is_toml)
                    .collect::<Vec<_>>(),
            )
        })
        .collect();
    assert!(!found.is_empty(), "there are no cases");
    found
}

/// All case files.
fn cases() -> Vec<PathBuf> {
    let all = folders().into_iter().flat_map(|(_, files)| files);
    all.filter(|path| !path.ends_with(STUDY)).collect()
}

/// A case's folder tells what it is about and holds the case.
#[test]
fn every_case_has_a_readme() {
    for (folder, cases) in folders() {
        assert!(!cases.is_empty(), "{} has no case", folder.display());
        let readme = folder.join("README.md");
        let text = std::fs::read_to_string(&readme)
            .unwrap_or_else(|error| panic!("{}: {error}", readme.display()));
        assert!(
            text.starts_with("# ") && text.len() > 200,
            "{} says too little",
            readme.display()
        );
    }
}

/// Every case loads, with a title, on a mesh of this repository. A mesh that is not committed is missing where the tests
/// run on a fresh checkout.
#[test]
fn every_case_names_a_mesh_of_the_repository() {
    let root = repository().canonicalize().unwrap();
    for path in cases() {
        let case = CaseFile::load(&path, &[]).unwrap_or_else(|error| panic!("{error}"));
        assert!(
            !case.case.title.is_empty(),
            "{} has no title",
            path.display()
        );
        let Some(mesh) = &case.case.mesh else {
            continue;
        };
        let mesh = &mesh.file;
        assert!(
            mesh.is_file(),
            "{}: no mesh {}",
            path.display(),
            mesh.display()
        );
        let inside = mesh.canonicalize().unwrap();
        let place = inside.strip_prefix(&root);
        let place = place
            .unwrap_or_else(|_| panic!("{}: {} lies elsewhere", path.display(), mesh.display()));
        let top = place.components().next().unwrap();
        let is_kept = ["meshes", "cases"]
            .iter()
            .any(|folder| top.as_os_str() == *folder);
        assert!(
            is_kept,
            "{}: {} is no place for a mesh",
            path.display(),
            place.display()
        );
    }
}

/// Three parts, so that the processors share them.
#[test]
fn every_case_passes_the_check() {
    cases_pass_the_check(0);
}

#[test]
fn every_case_passes_the_check_on() {
    cases_pass_the_check(1);
}

#[test]
fn every_case_passes_the_check_to_the_end() {
    cases_pass_the_check(2);
}

/// Every third case, from one on, passes `ligament check`: groups exist, supports and loads go together, and the equations can be set up. Its
/// domain correction, if it has one, converges unless the case says by a horizon factor below 2 that it may not.
fn cases_pass_the_check(from: usize) {
    for path in cases().into_iter().skip(from).step_by(3) {
        let case = CaseFile::load(&path, &[]).unwrap_or_else(|error| panic!("{error}"));
        let mut report = Vec::new();
        check(&case, CheckExtent::Matrix, None, Lines::Main, &mut report)
            .unwrap_or_else(|error| panic!("{}: {error:#}", path.display()));
        let report = String::from_utf8(report).unwrap();
        assert!(
            report.contains(&case.case.title)
                && (report.contains("unknowns") || report.contains("critical step")),
            "{report}"
        );
        let converges = report.contains("surface correction: domain (converged");
        let factor = case.case.model.horizon_factor;
        let may_not = factor.is_some_and(|factor| factor < 2.0);
        let surface = case.case.correction.surface;
        let iterates = matches!(surface, Some(Word(Surface::Domain(_))));
        assert!(
            converges || may_not || !iterates,
            "{}:\n{report}",
            path.display()
        );
        assert!(
            !case.case.contacts.is_empty() || !report.contains("with no bond between them"),
            "{}:\n{report}",
            path.display()
        );
    }
}

/// Every study loads, and the case of each of its runs on the meshes of this repository.
#[test]
fn every_study_has_the_cases_of_its_runs() {
    let all = folders().into_iter().flat_map(|(_, files)| files);
    let mut studies = 0;
    for path in all.filter(|path| path.ends_with(STUDY)) {
        let study = Study::load(&path).unwrap_or_else(|error| panic!("{error}"));
        assert!(!study.title.is_empty(), "{} has no title", path.display());
        let runs = plan::runs(&study, &repository().join("results/none"));
        let runs = runs.unwrap_or_else(|error| panic!("{error}"));
        assert!(runs.len() > 1, "{}", path.display());
        studies += 1;
    }
    assert!(studies > 0, "there are no studies");
}
