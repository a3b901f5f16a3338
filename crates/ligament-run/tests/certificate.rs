//! The certificate of a run against a calculation by hand.

#![allow(clippy::unwrap_used, reason = "a failed unwrap fails the test")]

use std::path::Path;

use ligament_case::case::CaseFile;
use ligament_output::summary::{self, Summary};
use ligament_run::progress::ProgressMode;
use ligament_run::run::run;

const BAR: &str = include_str!("../../../cases/softening-bar/case.toml");

/// Runs the bar with settings into a folder, and reads the summary from there.
fn summary_of(settings: &[&str]) -> Summary {
    let settings: Vec<String> = settings.iter().map(|it| (*it).to_owned()).collect();
    let case = CaseFile::parse(Path::new("case.toml"), BAR.to_owned(), &settings).unwrap();
    let place = tempfile::tempdir().unwrap();
    let out = place.path().join("out");
    let report = run(&case, &out, false, ProgressMode::Quiet).unwrap();
    let mut text = Vec::new();
    report.write(&mut text).unwrap();
    let text = String::from_utf8(text).unwrap();
    assert!(text.contains("largest residual"), "{text}");
    summary::read(&out).unwrap().unwrap()
}

/// A notched bar is pulled apart. By hand: the crack runs through the 6 mm between the notches, of a bar of 1 m in thickness, and takes
/// G_c A = 100 J/m^2 times 0.006 m^2 = 0.6 J; all the work is stored or released. The bonds that cross a section hold 0.97 of G_c at this ratio
/// of horizon to spacing, and a face of the lattice is 1 mm long.
#[test]
fn a_bar_pulled_apart_spends_its_fracture_energy() {
    let found = summary_of(&["fracture.steps=75", "output.fields_every=0"]);
    let certificate = found.certificate.unwrap();
    let balance = certificate.work - certificate.stored - certificate.released;
    assert!(balance.abs() <= 1e-8 * certificate.work, "{certificate:?}");
    assert!(
        certificate.stored <= 0.02 * certificate.work,
        "{certificate:?}"
    );
    let spent = certificate.dissipated / 0.6;
    assert!((0.94..=1.0).contains(&spent), "{certificate:?}");
    let area = certificate.crack_area.unwrap();
    assert!((area - 0.006).abs() <= 1e-3, "{certificate:?}");
    assert_eq!(certificate.fracture_energy, Some(100.0));
    let ratio = certificate.spent_ratio().unwrap();
    assert!((ratio - 0.01 * certificate.dissipated / area).abs() < 1e-12);
    // A lattice has no outline of sides, along which a ligament could be measured.
    assert_eq!(certificate.horizon_over_ligament, None);
    let residual = certificate.largest_residual.unwrap();
    assert!((0.0..1e-3).contains(&residual), "{certificate:?}");
}

/// An intact bar has no crack, and stores all the work.
#[test]
fn an_intact_bar_spends_nothing() {
    let found = summary_of(&["load.0.displacement.x=1e-6", "fracture.steps=2"]);
    let certificate = found.certificate.unwrap();
    assert_eq!(certificate.dissipated, 0.0);
    assert_eq!((certificate.crack_area, certificate.ties), (None, 0));
    let relative = (certificate.work - certificate.stored) / certificate.work;
    assert!(relative.abs() < 1e-9, "{certificate:?}");
}
