//! `[lattice]` in place of `[mesh]`: keys, defaults and faults.

#![allow(clippy::unwrap_used, reason = "a failed unwrap fails the test")]

use std::path::Path;

use ligament_case::case::{
    CaseFile, CellSet, Circle, Hole, LatticeSection, Polygon, Rectangle, Spacing,
};
use ligament_model::Plane;

const TEXT: &str = include_str!("data/lattice-plate.toml");

fn parse(text: &str, settings: &[&str]) -> Result<CaseFile, String> {
    let settings: Vec<String> = settings.iter().map(|&it| it.to_owned()).collect();
    CaseFile::parse(Path::new("case.toml"), text.to_owned(), &settings)
        .map_err(|error| error.to_string())
}

fn section(text: &str, settings: &[&str]) -> LatticeSection {
    parse(text, settings).unwrap().case.lattice.unwrap()
}

/// The error of the case with `old` replaced by `new`.
fn error_with(old: &str, new: &str) -> String {
    assert!(TEXT.contains(old), "the case has no `{old}`");
    parse(&TEXT.replacen(old, new, 1), &[]).unwrap_err()
}

#[test]
fn the_section_is_read_with_its_defaults() {
    let lattice = section(TEXT, &[]);
    assert_eq!(
        (lattice.cells, lattice.spacing),
        ([20, 12], Spacing([0.01; 2]))
    );
    assert_eq!((lattice.corner, lattice.thickness), ([0.0; 2], None));
    assert_eq!(lattice.plane, Plane::Stress);
    let circle = |centre, radius| Circle { centre, radius };
    let hole = |name: Option<&str>, circle, outside| Hole {
        name: name.map(str::to_owned),
        circle,
        rectangle: None,
        polygon: None,
        outside,
    };
    let bore = circle([0.1, 0.06], 0.02);
    assert_eq!(lattice.remove, [hole(None, Some(bore), None)]);
    let named =
        "lattice.remove=[{ name = \"rim\", outside = { centre = [0.1, 0.06], radius = 0.02 } }]";
    assert_eq!(
        section(TEXT, &[named]).remove,
        [hole(Some("rim"), None, Some(bore))]
    );
    let sets: Vec<(&str, &CellSet)> = (lattice.sets.iter())
        .map(|(name, set)| (name.as_str(), set))
        .collect();
    let corners = vec![[0.0, 0.12], [0.03, 0.12], [0.0, 0.09]];
    assert_eq!(
        sets,
        [
            (
                "disk",
                &CellSet {
                    circle: Some(circle([0.0; 2], 0.03)),
                    ..CellSet::default()
                }
            ),
            (
                "left",
                &CellSet {
                    left: Some(3),
                    ..CellSet::default()
                }
            ),
            (
                "right",
                &CellSet {
                    right: Some(1),
                    ..CellSet::default()
                }
            ),
            (
                "rock",
                &CellSet {
                    r#box: Some(Rectangle([[0.0, 0.0], [0.2, 0.12]])),
                    ..CellSet::default()
                }
            ),
            (
                "tip",
                &CellSet {
                    polygon: Some(Polygon(corners)),
                    ..CellSet::default()
                }
            ),
        ]
    );
    let settings = [
        "lattice.spacing=[1e-3, 2]",
        "lattice.corner=[-1, 5]",
        "lattice.plane=strain",
        "lattice.thickness=0.1",
    ];
    let lattice = section(TEXT, &settings);
    assert_eq!(
        (lattice.spacing, lattice.corner),
        (Spacing([1e-3, 2.0]), [-1.0, 5.0])
    );
    assert_eq!(
        (lattice.thickness, lattice.plane),
        (Some(0.1), Plane::Strain)
    );
}

#[test]
fn a_resolved_lattice_reads_as_the_same_case() {
    let named = "lattice.remove.0.name=bore";
    let case = parse(TEXT, &["lattice.corner=[0.1, -3]", named]).unwrap();
    let resolved = case.resolved_toml().unwrap();
    assert!(resolved.contains("[lattice]\n") && resolved.contains("\nhorizon = 0.03\n"));
    assert!(!resolved.contains("[mesh]") && !resolved.contains("horizon_factor"));
    let again = parse(&resolved, &[]).unwrap();
    assert_eq!(again.case, case.case);
    assert_eq!(again.resolved_toml().unwrap(), resolved);
}

#[test]
fn a_body_is_a_mesh_or_a_lattice() {
    assert_eq!(
        error_with("[material]", "[mesh]\nfile = \"a.msh\"\n[material]"),
        "case.toml:2:1: lattice: the case has a [mesh] as well, but its body is one of the two: remove [mesh] or \
         [lattice]"
    );
    let start = TEXT.find("[lattice]").unwrap();
    let end = TEXT.find("[material]").unwrap();
    assert_eq!(
        parse(&format!("{}{}", &TEXT[..start], &TEXT[end..]), &[]).unwrap_err(),
        "case.toml: mesh: the case has no [mesh] or [lattice] section; it needs one of them: [mesh] with `file`, the \
         Gmsh file, or [lattice] with `cells` and `spacing`"
    );
    assert!(
        error_with("[lattice]", "[latice]\nx = 1\n[lattice]").contains("did you mean `lattice`?")
    );
}

#[test]
fn wrong_keys_and_values_are_refused() {
    for (old, new, message) in [
        (
            "cells = [20",
            "cels = [20",
            "3:1: lattice.cels: unknown key `cels` in [lattice]; did you mean `cells`?",
        ),
        (
            "cells = [20, 12]\n",
            "",
            "2:1: lattice.cells: missing key `cells` in [lattice]",
        ),
        (
            "cells = [20, 12]",
            "cells = [20, 0]",
            "3:9: lattice.cells: must be at least 1 along x and y, and 50000000 together at most, found [20, 0]",
        ),
        (
            "cells = [20, 12]",
            "cells = [4000000000, 4000000000]",
            "3:9: lattice.cells: must be at least 1 along x and y",
        ),
        (
            "cells = [20, 12]",
            "cells = [20, 1.5]",
            "3:14: lattice.cells.1: expected a whole number, 0 or more, found the number 1.5",
        ),
        (
            "spacing = 0.01",
            "spacing = [0.01]",
            "4:11: lattice.spacing: expected a number or a list of 2, found a list of 1",
        ),
        (
            "spacing = 0.01",
            "spacing = \"1 mm\"",
            "4:11: lattice.spacing: expected a number or a list of 2, found the string \"1 mm\"; values are plain \
             numbers in SI units, here m",
        ),
        (
            "spacing = 0.01",
            "spacing = [0.01, 0]",
            "4:11: lattice.spacing: must be greater than 0, and of a size that gives the cells a volume",
        ),
        (
            "spacing = 0.01",
            "spacing = 1e-200",
            "4:11: lattice.spacing: must be greater than 0, and of a size",
        ),
        (
            "spacing = 0.01",
            "spacing = 0.01\ncorner = [1e8, 0]",
            "5:10: lattice.corner: must be so near to the origin",
        ),
        (
            "spacing = 0.01",
            "spacing = 0.01\nthickness = 0",
            "5:13: lattice.thickness: must be greater than 0",
        ),
        (
            "[[lattice.remove]]",
            "[lattice.remove]",
            "lattice.remove: this section may be repeated, so its name stands in double brackets: write [[lattice.remove]] \
             instead of [lattice.remove]",
        ),
        (
            "radius = 0.02",
            "radius = 0",
            "lattice.remove.0.circle.radius: must be greater than 0, found 0.0",
        ),
        (
            "radius = 0.02 }",
            "radius = 0.02 }\noutside = { centre = [0, 0], radius = 1 }",
            "lattice.remove.0: needs exactly one of `circle`, `rectangle`, `polygon`, `outside`; found `circle`, `outside`",
        ),
        (
            "circle = { centre = [0.1, 0.06], radius = 0.02",
            "outside = { centre = [0.1, 0.06], radius = -1",
            "lattice.remove.0.outside.radius: must be greater than 0, found -1.0",
        ),
        (
            "[[lattice.remove]]",
            "[[lattice.remove]]\nname = \"disk\"",
            "7:8: lattice.remove.0.name: `lattice.set` has a `disk` as well: rename one of them",
        ),
        (
            "[[lattice.remove]]",
            "[[lattice.remove]]\nname = \"a,b\"",
            "7:8: lattice.remove.0.name: must be a name without commas, quotes or surrounding blanks",
        ),
        (
            "circle = { centre = [0.1",
            "rectangle = [[0, 0], [1, 0]] #",
            "lattice.remove.0.rectangle: must be two opposite corners of a rectangle with a width and a height",
        ),
        (
            "{ left = 3 }",
            "{ left = 0 }",
            "lattice.set.left.left: must be at least 1, found 0",
        ),
        (
            "{ left = 3 }",
            "{ left = 21 }",
            "lattice.set.left.left: must be 20 or less, as the lattice has, found 21",
        ),
        (
            "{ left = 3 }",
            "{ left = 3, top = 1 }",
            "lattice.set.left: needs exactly one of `bottom`, `top`, `left`, `right`, `box`, `circle`, `polygon`; found \
             `top`, `left`",
        ),
        (
            "[0, 0.09]]",
            "[0.03, 0.09], [0, 0.13]]",
            "lattice.set.tip.polygon: must be three corners or more of a polygon that does not cross or touch itself",
        ),
        (
            "horizon = 0.03",
            "horizon = 0",
            "model.horizon: must be greater than 0, found 0.0",
        ),
        (
            "horizon = 0.03\n",
            "",
            "model: needs exactly one of `horizon_factor`, `horizon`; found none",
        ),
        (
            "horizon = 0.03\n",
            "horizon = 0.03\nhorizon_factor = 3\n",
            "model: needs exactly one of `horizon_factor`, `horizon`; found `horizon_factor`, `horizon`",
        ),
    ] {
        let error = error_with(old, new);
        assert!(error.contains(message), "{new}:\n{error}");
    }
}
