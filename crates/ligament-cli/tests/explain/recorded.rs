//! Utilisations that `explain` tells, compared with those that the run itself recorded in its files of bonds, step by step.

use std::collections::BTreeMap;

use ligament_output::FieldLocation::{Cell, Point};
use ligament_output::vtu::read::VtuFile;

use super::*;

/// What a table of `explain` says of a bond in a step.
struct Told {
    step: usize,
    ends: [i64; 2],
    is_intact: bool,
    /// Utilisation and limit by each criterion.
    by_criteria: Vec<[f64; 2]>,
}

/// What `explain` tells of all bonds of a point.
fn told(results: &Path, point: u32) -> Vec<Told> {
    let file = results.with_extension("csv");
    let (point, path) = (point.to_string(), file.display().to_string());
    explain(results, &["--point", &point, "--csv", &path, "--force"]);
    let table = fs::read_to_string(&file).unwrap();
    let mut rows = table
        .lines()
        .map(|line| line.split(',').collect::<Vec<_>>());
    let header = rows.next().unwrap();
    let numbers = |row: &[&str], prefix: &str| -> Vec<f64> {
        let both = header.iter().zip(row);
        let named = both.filter(|(name, _)| name.starts_with(prefix));
        named.map(|(_, value)| value.parse().unwrap()).collect()
    };
    let of_row = |row: Vec<&str>| Told {
        step: row[2].parse().unwrap(),
        ends: [0, 1].map(|end| row[end].parse().unwrap()),
        is_intact: row[6] == "1",
        by_criteria: (numbers(&row, "utilisation.").into_iter())
            .zip(numbers(&row, "limit."))
            .map(|(utilisation, limit)| [utilisation, limit])
            .collect(),
    };
    rows.map(of_row).collect()
}

/// Whether each bond was intact in a step, and its largest utilisation over the criteria, from the file of bonds.
fn recorded(results: &Path, step: usize) -> BTreeMap<[i64; 2], (bool, f64)> {
    let (_, tags) = VtuFile::open(results.join("model.vtu"))
        .unwrap()
        .tags(Point)
        .unwrap();
    let file = VtuFile::open(results.join(format!("bonds_{step:04}.vtu"))).unwrap();
    let intact = file.required_integers(Cell, "intact").unwrap();
    let utilisation = file.required_numbers(Cell, "utilisation").unwrap();
    let ends = file.lines().unwrap().into_iter();
    let ends = ends.map(|it| it.map(|end| tags[end as usize]));
    ends.zip(intact.into_iter().map(|it| it != 0).zip(utilisation))
        .collect()
}

/// Compares the bonds of some points in all steps of a case; returns the number of intact bonds in steps that are beyond half of a limit.
///
/// 1e-10: the deformations are of displacements with all digits and positions with all digits, so that only rounding remains, and a bond is
/// seldom shorter than 1e-2 of the body; smaller ones than 1e-4 of a limit are all rounding.
fn compare(case: &str, points: &[u32]) -> usize {
    let folder = tempfile::tempdir().unwrap();
    let results = run(
        folder.path(),
        case,
        &["output.fields_every=1", "output.bonds=true"],
    );
    let mut states = BTreeMap::new();
    let mut near = 0;
    for told in points.iter().flat_map(|point| told(&results, *point)) {
        let of_step = states.entry(told.step);
        let of_step = of_step.or_insert_with(|| recorded(&results, told.step));
        let (was_intact, expected) = of_step[&told.ends];
        assert_eq!(
            told.is_intact, was_intact,
            "{:?} in step {}",
            told.ends, told.step
        );
        if was_intact {
            let found = told.by_criteria.iter().map(|it| it[0]).fold(0.0, f64::max);
            assert!(
                (found - expected).abs() <= 1e-10 * expected.max(1e-4),
                "{:?} in step {}: {found} {expected}",
                told.ends,
                told.step
            );
            near += usize::from(found > 0.5);
        }
    }
    near
}

/// A criterion, and what bonds do after its limit.
const CRITERIA: [(&str, &str); 6] = [
    ("strength", "brittle"),
    ("bond-energy", "linear"),
    ("rankine", "linear"),
    ("mohr-coulomb", "brittle"),
    ("mohr-coulomb", "linear"),
    ("tension", "two-branch"),
];

/// A body that is stretched and sheared in load steps until bonds break, in which those in front of the crack lose their bonds one by one.
fn pulled(body: &str, motion: &str, kind: &str, after: &str) -> String {
    let parameter = match after {
        "two-branch" => "end = 8.0\n",
        _ => "",
    };
    format!(
        r#"
{body}
[material]
young = 15e9
poisson = 0.2
tensile_strength = 3e6
compressive_strength = 20e6
fracture_energy = 60.0
[model]
law = "nhpd"
horizon_factor = 2.5
[[support]]
group = "held"
displacement = {{ x = 0.0, y = 0.0{} }}
[[load]]
group = "pulled"
displacement = {motion}
[fracture]
steps = 8
bonds_per_iteration = 20
[[fracture.criterion]]
kind = "{kind}"
after = "{after}"
{parameter}"#,
        if body.contains("solid") {
            ", z = 0.0"
        } else {
            ""
        }
    )
}

/// Bonds that break at once and bonds that soften, by their stretch, their energy and the stress around them, also before they begin.
#[test]
fn a_body_in_the_plane_is_told_as_it_was_recorded() {
    let body = "lattice = { cells = [12, 12], spacing = 0.01, set = { held = { bottom = 1 }, pulled = { top = 1 } } }";
    for (kind, after) in CRITERIA {
        let case = pulled(body, "{ x = 1e-5, y = 5e-5 }", kind, after);
        assert!(compare(&case, &[65, 78, 30]) > 10, "{kind}, {after}");
    }
}

/// Bonds of a solid that break at once and bonds that soften, as in the plane.
#[test]
fn a_solid_is_told_as_it_was_recorded() {
    let body = "solid_lattice = { cells = [6, 6, 6], spacing = [0.01, 0.01, 0.01], set = { held = { bottom = 1 }, pulled = { top = 1 } } }";
    for (kind, after) in CRITERIA {
        let case = pulled(body, "{ x = 1e-5, z = 3e-5 }", kind, after);
        assert!(compare(&case, &[45, 80, 120]) > 10, "{kind}, {after}");
    }
}

/// Explicit steps, in which bonds break between the rows.
#[test]
fn a_motion_is_told_as_it_was_recorded() {
    const MOTION: &str = r#"
lattice = { cells = [40, 16], spacing = 5e-4, thickness = 1e-3, set = { top = { top = 1 }, bottom = { bottom = 1 } } }
material = { young = 32e9, poisson = 0.2, density = 2450.0, fracture_energy = 3.0 }
model = { law = "nhpd", horizon_factor = 3.0 }
precrack = [{ points = [[-0.001, 0.004], [0.007, 0.004]] }]
load = [
    { group = "top", force_per_length = { y = 2.5e3 } },
    { group = "bottom", force_per_length = { y = -2.5e3 } },
]
motion = { duration = 20e-6, rows = 10 }
fracture = { criterion = [{ kind = "critical-stretch" }] }
"#;
    assert!(compare(MOTION, &[294, 296, 337, 338]) > 10);
}

/// Strains of bonds over the distances after the deformation.
#[test]
fn true_strains_are_told_as_they_were_recorded() {
    const CRACKED: &str = r#"
lattice = { cells = [12, 12], spacing = 0.002, thickness = 0.001, set = { base = { bottom = 1 }, end = { top = 1 } } }
material = { young = 65.8e9, poisson = 0.3, fracture_energy = 6137.0 }
model = { law = "mbb-pd", horizon_factor = 3.0, strains = "true" }
precrack = [{ points = [[-0.001, 0.012], [0.0083, 0.012]] }]
support = [{ group = "base", displacement = { x = 0.0, y = 0.0 } }]
load = [{ group = "end", displacement = { x = 1e-4, y = 3e-4 } }]
no_fail = [{ group = "base" }, { group = "end" }]
fracture = { steps = 6 }
"#;
    assert!(compare(CRACKED, &[64, 65, 77]) > 10);
}

/// Results do not have the stiffness of cells, nor how limits followed the bonds that were left: notes say so.
#[test]
fn what_results_do_not_have_is_noted() {
    const PRINTED: &str = r#"
lattice = { cells = [8, 8], spacing = 0.002, thickness = 0.001, set = { base = { bottom = 1 }, end = { top = 1 } } }
material = { young = 65.8e9, poisson = 0.3, fracture_energy = 6137.0 }
model = { law = "mbb-pd", horizon_factor = 3.0 }
support = [{ group = "base", displacement = { x = 0.0, y = 0.0 } }]
load = [{ group = "end", displacement = { y = 1e-5 } }]
fracture = { steps = 1, criterion = [{ kind = "printed-opening" }] }
"#;
    let folder = tempfile::tempdir().unwrap();
    let body = "lattice = { cells = [6, 6], spacing = 0.01, set = { held = { bottom = 1 }, pulled = { top = 1 } } }";
    let sound = pulled(body, "{ y = 1e-6 }", "rankine", "linear");
    let with_cells = sound.replace("poisson = 0.2", "poisson = 0.4");
    for (case, expected) in [
        (sound.as_str(), None),
        (
            &with_cells,
            Some("stresses around bonds are without what cells resist"),
        ),
        (
            PRINTED,
            Some("in the run limits followed the bonds that were left"),
        ),
    ] {
        let results = run(folder.path(), case, &["output.fields_every=1"]);
        let said = explain(&results, &["--point", "20"]);
        assert_eq!(said.contains("note:"), expected.is_some(), "{said}");
        assert!(said.contains(expected.unwrap_or_default()), "{said}");
    }
}
