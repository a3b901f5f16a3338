//! Results of a solid in the commands: its crack, a level surface, its page and its pictures.

#![allow(clippy::unwrap_used, reason = "a failed unwrap fails the test")]

use std::fs;
use std::path::{Path, PathBuf};

use ligament_output::FieldLocation;
use ligament_output::vtu::Cell;
use ligament_output::vtu::read::VtuFile;
use serde_json::Value;

use crate::support::{ligament_in, stderr, text};

/// A bar of 80 x 40 x 40 mm of cubes of 10 mm with a slit of 10 mm from the side, pulled until the 30 x 40 mm behind it part.
const BAR: &str = include_str!("support/small-solid.toml");

struct Place(tempfile::TempDir);

impl Place {
    fn new() -> Self {
        let place = Self(tempfile::tempdir().unwrap());
        fs::write(place.path("bar.toml"), BAR).unwrap();
        place
    }

    /// With the results of the bar in `out`.
    fn run() -> Self {
        let place = Self::new();
        place.call("run bar.toml --out out --quiet");
        place
    }

    fn path(&self, name: &str) -> PathBuf {
        self.0.path().join(name)
    }

    /// Messages of a command.
    fn call(&self, words: &str) -> String {
        let words: Vec<&str> = words.split_whitespace().collect();
        let output = ligament_in(self.0.path(), &words);
        assert!(output.status.success(), "{words:?}: {}", stderr(&output));
        text(&output.stdout)
    }

    /// Reason for the refusal of a command.
    fn refused(&self, words: &str) -> String {
        let words: Vec<&str> = words.split_whitespace().collect();
        let output = ligament_in(self.0.path(), &words);
        assert!(!output.status.success(), "{words:?}");
        stderr(&output)
    }

    fn vtu(&self, name: &str) -> VtuFile {
        VtuFile::open(self.path(name)).unwrap()
    }
}

fn area(file: &VtuFile) -> f64 {
    let points = file.points().unwrap();
    let of = |cell: &Cell| {
        let Cell::Triangle(corners) = cell else {
            panic!("{cell:?}")
        };
        let [a, b, c] = corners.map(|it| points[it as usize]);
        let [p, q] = [b, c].map(|it| [0, 1, 2].map(|axis| it[axis] - a[axis]));
        let cross = [
            p[1] * q[2] - p[2] * q[1],
            p[2] * q[0] - p[0] * q[2],
            p[0] * q[1] - p[1] * q[0],
        ];
        0.5 * cross.iter().map(|it| it * it).sum::<f64>().sqrt()
    };
    file.cells().unwrap().iter().map(of).sum()
}

/// A whole bar that is free to contract has each displacement between the displacements of its ends on one surface across it, the section
/// of 40 x 40 mm: sections stay flat up to the errors of the corrections, which the area contains squared.
#[test]
fn a_value_between_both_ends_has_the_section_as_surface() {
    let place = Place::new();
    place.call(
        "run bar.toml --out out --quiet --unset precrack --unset fracture --unset no_fail --unset material.fracture_energy \
         --set support.0.displacement={x=0.0}",
    );
    let said = place.call("crack out --iso 1e-4 --field displacement.x");
    assert!(
        said.starts_with("step 1: displacement.x = 0.0001 on ") && said.contains("iso.vtu"),
        "{said}"
    );
    let file = place.vtu("out/iso.vtu");
    let found = area(&file);
    assert!((1.0..1.001).contains(&(found / 1.6e-3)), "{found}");
    let moved = file
        .finite_numbers(FieldLocation::Point, "displacement")
        .unwrap();
    for along in moved.iter().step_by(3) {
        assert!((along - 1e-4).abs() < 1e-12, "{along}");
    }
    assert_eq!(
        file.components(FieldLocation::Point, "stress_virial")
            .unwrap()
            .0,
        6
    );
    assert!(
        file.components(FieldLocation::Point, "cell").is_none(),
        "a number between two tags is none"
    );
}

#[test]
fn steps_in_which_a_value_is_nowhere_have_no_file() {
    let place = Place::run();
    place.call("crack out --iso 0.2");
    let said = place.call("crack out --iso 2 --step last");
    assert!(said.contains("damage is nowhere 2"), "{said}");
    assert!(!place.path("out/iso.vtu").exists());
    // All steps, of which the first has no damage yet.
    let said = place.call("crack out --iso 0.2 --step all");
    assert_eq!(said.lines().count(), 5, "{said}");
    assert!(place.path("out/iso_0004.vtu").is_file() && !place.path("out/iso_0000.vtu").exists());
    let listed = fs::read_to_string(place.path("out/iso.pvd")).unwrap();
    assert!(listed.contains("iso_0004.vtu") && !listed.contains("iso_0000.vtu"));
    assert!(
        place
            .refused("crack out --iso 0.2 --field damge")
            .contains("did you mean `damage`?")
    );
    assert!(place.refused("crack out --field damage").contains("--iso"));
    let profile = "profile out --from 0,0 --to 0.08,0 --field damage";
    assert!(place.refused(profile).contains("a section of it"));
}

/// What `ligament report` describes to the viewer of its page.
fn description(page: &Path) -> Value {
    let page = fs::read_to_string(page).unwrap();
    let (_, rest) = page.split_once("id=\"description\">").unwrap();
    let description = rest.split_once("</script>").unwrap().0;
    serde_json::from_str(description).unwrap()
}

#[test]
fn a_page_of_a_solid_has_its_body_and_its_crack() {
    let place = Place::run();
    let said = place.call("report out");
    assert!(said.starts_with("out: 128 points, 5 steps"), "{said}");
    let described = description(&place.path("out/report.html"));
    let run = &described["runs"][0];
    assert_eq!(
        (&run["body"]["dimension"], &run["body"]["count"]),
        (&3.into(), &128.into())
    );
    let fields = run["fields"].as_array().unwrap();
    let components = |name: &str| {
        let field = fields.iter().find(|it| it["name"] == name).unwrap();
        field["components"].as_array().unwrap().len()
    };
    assert_eq!(
        ["displacement", "stress_virial", "damage"].map(components),
        [3, 6, 0]
    );
    assert!(run["bonds"]["count"].as_u64().unwrap() > 500);
    let cracks = &run["cracks"];
    assert!(cracks["simplices"].as_u64().unwrap() > 50);
    let areas: Vec<f64> = serde_json::from_value(cracks["area"]["values"].clone()).unwrap();
    assert!(
        areas.len() == 5 && areas[0] == 0.0 && areas[4] > 0.0,
        "{areas:?}"
    );
    let columns = run["history"].as_array().unwrap();
    let unit = |name: &str| {
        let column = columns.iter().find(|it| it["name"] == name).unwrap();
        column["unit"].as_str().unwrap().to_owned()
    };
    assert!(unit("left.force_z").ends_with('N') && unit("right.moment_x").ends_with("N m"));
    let page = fs::read_to_string(place.path("out/report.html")).unwrap();
    let place_of_bond = "at (40.00, 15.00, 15.00) mm, in step 3";
    assert!(page.contains(place_of_bond));
    place.call("report out --output again.html");
    assert_eq!(
        fs::read_to_string(place.path("again.html")).unwrap(),
        page,
        "the same bytes again"
    );
}

#[test]
fn modes_of_a_solid_have_a_page_and_no_crack() {
    let place = Place::new();
    let free = "--unset fracture --unset support --unset load --unset probe --unset precrack --unset no_fail \
                --unset output --unset material.fracture_energy";
    place.call(&format!(
        "run bar.toml --out modes --quiet --set analysis=\"modal\" --set modal.modes=8 {free}"
    ));
    place.call("report modes");
    let described = description(&place.path("modes/report.html"));
    let run = &described["runs"][0];
    assert_eq!(
        (&run["kind"], run["steps"].as_array().unwrap().len()),
        (&"modes".into(), 8)
    );
    assert_eq!(
        (&run["cracks"], &run["firstField"]),
        (&Value::Null, &"strain_energy_density".into())
    );
}

/// Bodies in the plane have no such surface.
#[test]
fn bodies_in_the_plane_have_no_surface_of_a_value() {
    let place = Place::new();
    let plane = include_str!("support/small-bar.toml");
    fs::write(place.path("plane.toml"), plane).unwrap();
    place.call("run plane.toml --out plane --quiet");
    assert!(
        place
            .refused("crack plane --iso 0.2")
            .contains("has a body in the plane")
    );
}
