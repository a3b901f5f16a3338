//! Results of a solid read back from their folder: its crack as a surface with opening, area and growth, and its cells opened along it.

#![allow(clippy::unwrap_used)]

use std::fs;

use ligament_output::FieldLocation;
use ligament_output::csv::read::CsvTable;
use ligament_output::results::solid_cracks::{SolidCracks, has_solid};
use ligament_output::results::{write_series, write_surface};
use ligament_output::vtu::Cell;
use ligament_output::vtu::read::VtuFile;
use verification::solid_run::{OPENING, write_results};
use verification::solids::{block, boxes};

/// The block 12 x 5 x 7 in the third step, in which the crack has come through: all of the section, and the opening that the halves
/// have at each place.
#[test]
fn the_crack_of_a_stored_run_is_a_surface_with_its_opening() {
    for body in [block([12, 5, 7], 0.2), boxes([12, 5, 7])] {
        let folder = tempfile::tempdir().unwrap();
        write_results(folder.path(), &body);
        assert!(has_solid(folder.path()).unwrap());
        let cracks = SolidCracks::open(folder.path()).unwrap();
        let surface = write_surface(folder.path(), &cracks, 3.into()).unwrap();
        assert!(
            (surface.area() / 60.0 - 1.0).abs() < 0.01,
            "{}",
            surface.area()
        );
        assert_eq!(surface.parts().len(), 1);

        let file = VtuFile::open(folder.path().join("crack.vtu")).unwrap();
        let (points, cells) = (file.points().unwrap(), file.cells().unwrap());
        assert!(cells.iter().all(|it| matches!(it, Cell::Triangle(_))));
        let of = |name| file.finite_numbers(FieldLocation::Point, name).unwrap();
        let (opening, sliding, load_factor) = (of("opening"), of("sliding"), of("load_factor"));
        for ((place, opening), sliding) in points.iter().zip(&opening).zip(&sliding) {
            // Points lie within a cell of their place along x, and the jump goes along z within some degrees.
            let expected = 3.0 * OPENING * (12.0 - place[0]);
            assert!(
                (opening - expected).abs() < 3.0 * OPENING + 0.05 * expected,
                "{place:?} {opening} {expected}"
            );
            assert!(
                *sliding < 0.6 * expected + 3.0 * OPENING,
                "{place:?} {sliding}"
            );
        }
        let steps = file
            .required_integers(FieldLocation::Point, "step")
            .unwrap();
        assert!(steps.iter().all(|it| (1..=3).contains(it)) && steps.contains(&1));
        assert!(
            steps
                .iter()
                .zip(&load_factor)
                .all(|(step, factor)| *factor == 0.25 * *step as f64)
        );

        let growth = CsvTable::read(folder.path().join("crack_growth.csv")).unwrap();
        let rows = growth.numbers(["step", "parts", "area"]).unwrap();
        assert_eq!(rows.len(), 3);
        assert!(
            rows.iter()
                .all(|row| (row[2] / (20.0 * row[0]) - 1.0).abs() < 0.12),
            "{rows:?}"
        );
        let stl = fs::read(folder.path().join("crack.stl")).unwrap();
        assert_eq!(stl.len(), 84 + 50 * surface.triangles.len());
    }
}

/// Opened, the cells keep their volume, and the two halves have no corner in common: their displacements are those of their side.
#[test]
fn cells_open_along_the_crack_of_a_stored_run() {
    let folder = tempfile::tempdir().unwrap();
    write_results(folder.path(), &block([12, 5, 7], 0.2));
    let cracks = SolidCracks::open(folder.path()).unwrap();
    write_surface(folder.path(), &cracks, 3.into()).unwrap();
    let file = VtuFile::open(folder.path().join("opened.vtu")).unwrap();
    let points = file.points().unwrap();
    let moved = file
        .finite_numbers(FieldLocation::Point, "displacement")
        .unwrap();
    let (mut volume, mut sides) = (0.0, [0, 0]);
    for cell in file.cells().unwrap() {
        let Cell::Solid(cell) = cell else {
            panic!("no solid cell")
        };
        volume += cell.volume(&points);
        let lifts: Vec<f64> = cell
            .corners()
            .iter()
            .map(|it| moved[3 * *it as usize + 2])
            .collect();
        let up = lifts.iter().filter(|it| **it > 0.0).count();
        let down = lifts.iter().filter(|it| **it < 0.0).count();
        assert!(up == 0 || down == 0, "{lifts:?}");
        sides[usize::from(up > 0)] += 1;
    }
    assert!((volume - 420.0).abs() < 0.2, "{volume}");
    assert!(sides.iter().all(|it| *it > 100));
    assert_eq!(write_series(folder.path(), &cracks).unwrap(), 4);
    for name in [
        "crack_0001.vtu",
        "opened_0000.vtu",
        "crack.pvd",
        "opened.pvd",
    ] {
        assert!(folder.path().join(name).is_file(), "{name}");
    }
    assert!(
        !folder.path().join("crack_0000.vtu").exists(),
        "nothing is broken there"
    );
}
