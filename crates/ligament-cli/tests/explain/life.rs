//! Explanations of bonds, compared with closed forms and the other files of a run.

use ligament_output::quantity::quantity;

use super::*;
use crate::support::{ligament_in, stderr, stdout};

/// Stretches, utilisations and steps of breaking of a bar under uniform strain, for bonds in three directions.
///
/// Horizons and factors are stored with seven digits, the rest with all; positions of the cells are rounded to 1e-17 of 1e-2.
#[test]
fn a_uniform_strain_gives_the_closed_form() {
    let folder = tempfile::tempdir().unwrap();
    let results = run(folder.path(), BAR, &[]);
    for (across, up) in [(1, 0), (2, 0), (3, 0), (2, 1), (1, 1), (1, 2), (0, 1)] {
        let [length, stretch, limit] = closed_form(f64::from(across), f64::from(up));
        let found = bond(&results, cell(2, 2), cell(2 + across, 2 + up));
        assert!((number(&found["length"]) / length - 1.0).abs() < 1e-12);
        assert!((number(&found["horizon"]) / 0.03 - 1.0).abs() < 1e-7);
        assert_eq!(
            (number(&found["alpha"]), number(&found["omega"])),
            (1.0, 1.0)
        );
        let expected = f64::from(up).atan2(f64::from(across)).to_degrees();
        assert!((number(&found["angle"]) - expected).abs() < 1e-9);
        let of_criterion = &found["limits"][0];
        assert_eq!(of_criterion["criterion"], "strength");
        assert_eq!(of_criterion["measure"], "tension");
        assert!((number(&of_criterion["limit"]) / limit - 1.0).abs() < 1e-12);

        // It breaks in the first step in which s >= s_0.
        let breaks_in = (1..=10).find(|step| *step as f64 / 10.0 * stretch >= limit);
        let path = found["path"].as_array().unwrap();
        assert_eq!(path.len(), 11);
        for (step, moment) in path.iter().enumerate() {
            let load_factor = step as f64 / 10.0;
            assert!((number(&moment["load_factor"]) - load_factor).abs() < 1e-15);
            assert!((number(&moment["stretch"]) - load_factor * stretch).abs() < 1e-15);
            let expected = load_factor * stretch / limit;
            assert!((number(&moment["utilisation"][0]) - expected).abs() < 1e-11);
            let is_intact = breaks_in.is_none_or(|breaks_in| step < breaks_in);
            assert_eq!(moment["intact"], is_intact, "{across}, {up} in step {step}");
        }
        match breaks_in {
            Some(step) => {
                let breakage = &found["breakage"];
                assert_eq!(number(&breakage["step"]), step as f64);
                assert_eq!(breakage["criterion"], "strength");
                let ratio = step as f64 / 10.0 * stretch / limit;
                assert!((number(&breakage["utilisation"]) - ratio).abs() < 1e-11);
                assert!((number(&found["largest"]["utilisation"]) - ratio).abs() < 1e-11);
            }
            None => {
                assert_eq!(found["breakage"], Value::Null);
                // Seven digits.
                let largest = number(&found["largest"]["utilisation"]);
                assert!((largest - stretch / limit).abs() < 1e-7, "{largest}");
            }
        }
    }
}

/// The stored largest utilisation is from the steps in which a bond was intact, not from the gap that it left.
#[test]
fn a_broken_bond_has_the_largest_utilisation_from_before() {
    let folder = tempfile::tempdir().unwrap();
    let model = StoredRun::open(&run(folder.path(), BAR, &[]))
        .unwrap()
        .model;
    let [a, b] = [cell(2, 2), cell(5, 2)].map(|tag| tag - 1);
    let pair = model
        .bonds
        .ends
        .iter()
        .position(|ends| *ends == [a, b])
        .unwrap();
    let [_, stretch, limit] = closed_form(3.0, 0.0);
    let breaks_in = (1..=10)
        .find(|step| f64::from(*step) / 10.0 * stretch >= limit)
        .unwrap();
    let largest = model.largest.unwrap();
    let expected = f64::from(breaks_in - 1) / 10.0 * stretch / limit;
    // Seven digits.
    assert!((largest.utilisation[pair] - expected).abs() < 1e-7);
    assert_eq!(largest.step[pair], i64::from(breaks_in - 1));
}

/// The order of breaking in `explain` equals the order in `breaks.csv`.
#[test]
fn breakages_are_those_of_the_table() {
    let folder = tempfile::tempdir().unwrap();
    let results = run(folder.path(), BAR, &[]);
    let table = fs::read_to_string(results.join("breaks.csv")).unwrap();
    let rows: Vec<Vec<&str>> = table
        .lines()
        .skip(1)
        .map(|line| line.split(',').collect())
        .collect();
    let point = cell(4, 2).to_string();
    let expected: Vec<(&str, &str)> = rows
        .iter()
        .filter(|row| row[6] == point || row[7] == point)
        .map(|row| (row[0], if row[6] == point { row[7] } else { row[6] }))
        .collect();
    assert!(expected.len() > 8, "{}", expected.len());
    let said = explain(&results, &["--point", &point]);
    let told: Vec<(&str, &str)> = said
        .lines()
        .filter_map(|line| line.split_once("broke, number "))
        .map(|(line, order)| (order, line.split_whitespace().next().unwrap()))
        .collect();
    assert_eq!(told, expected);
    let count = format!("{} broke, from number {}", expected.len(), expected[0].0);
    assert!(said.contains(&count), "{said}");
    let of_all = format!("of {} broken bonds", rows.len());
    let said = explain(&results, &["--bond", &point, expected[0].1]);
    assert!(said.contains(&of_all), "{said}");
}

#[test]
fn it_says_why_there_is_no_bond_or_no_breakage() {
    let folder = tempfile::tempdir().unwrap();
    let results = run(folder.path(), BAR, &[]);
    let say = |a: u32, b: u32| {
        let tags = [a, b].map(|tag| tag.to_string());
        explain(&results, &["--bond", &tags[0], &tags[1]])
    };
    let cut = say(cell(0, 2), cell(1, 2));
    assert!(cut.contains("a pre-crack cut it"), "{cut}");
    let far = say(cell(8, 4), cell(0, 0));
    let distance = SPACING * 8_f64.hypot(4.0);
    assert!(
        far.contains(&format!("distance is {}", quantity(distance, "m"))),
        "{far}"
    );
    assert!(
        far.contains("neither point lies in the horizon of the other"),
        "{far}"
    );
    assert!(far.contains("reach 30.00 mm"), "{far}");
    let held = say(cell(6, 2), cell(8, 2));
    assert!(held.contains("never fails by its stretch s"), "{held}");
    let why = format!("bonds of cell {} never fail (`no_fail`)", cell(8, 2));
    assert!(held.contains(&why), "{held}");
    let upright = say(cell(4, 2), cell(4, 3));
    assert!(
        upright.contains("its utilisation was 0 throughout"),
        "{upright}"
    );
    let slanted = say(cell(4, 2), cell(5, 3));
    let [_, stretch, limit] = closed_form(1.0, 1.0);
    let largest = format!(
        "largest utilisation was {:.4}, in step 10, by `strength`",
        stretch / limit
    );
    assert!(slanted.contains(&largest), "{slanted}");
}

/// A hole removes the middle column except its ends: no cell there has a bond across, and the tags count the remaining cells.
#[test]
fn a_hole_parts_its_sides() {
    let folder = tempfile::tempdir().unwrap();
    let hole = "remove = [{ rectangle = [[0.04, 0.01], [0.05, 0.04]] }]\n[lattice.set]";
    let results = run(folder.path(), &BAR.replacen("[lattice.set]", hole, 1), &[]);
    // Row 0 is whole; rows 1 and 2 have 8 cells each: columns 3 and 5 of row 2 are beside the hole.
    let [left, right] = [9 + 8 + 4, 9 + 8 + 5].map(|tag| tag.to_string());
    let said = explain(&results, &["--bond", &left, &right]);
    assert!(said.contains("distance is 20.00 mm"), "{said}");
    assert!(
        said.contains("a hole, slot, notch or crack of the mesh lies between them"),
        "{said}"
    );
    let family = explain(&results, &["--point", &left]);
    assert!(family.contains("across a void"), "{family}");
}

/// Along the exact path a bond is at its limit in the event in which it breaks, and before it in proportion to the load: with
/// rotations of the points, from fields that know nothing of limits.
#[test]
fn on_the_exact_path_bonds_break_at_their_limit() {
    let folder = tempfile::tempdir().unwrap();
    let results = run(folder.path(), SHEARED, &[]);
    let table = fs::read_to_string(results.join("breaks.csv")).unwrap();
    let mut seen = 0;
    for row in table.lines().skip(1) {
        let row: Vec<&str> = row.split(',').collect();
        let step: usize = row[1].parse().unwrap();
        let found = bonds(&results, &["--bond", row[6], row[7]]);
        let path = found[0]["path"].as_array().unwrap();
        let utilisation = |step: usize| number(&path[step]["utilisation"][0]);
        // The fields hold the displacements to the last bit: only the rounding of their differences over a bond remains.
        assert!((utilisation(step) - 1.0).abs() < 1e-9, "{row:?}");
        assert_eq!(path[step]["intact"], true);
        assert_eq!(path[step + 1]["intact"], false);
        let broke = &found[0]["breakage"];
        for quantity in ["stretch", "shear"] {
            let (then, of_fields) = (number(&broke[quantity]), number(&path[step][quantity]));
            assert!(
                (then - of_fields).abs() < 1e-9 * number(&broke["stretch"]),
                "{quantity}"
            );
        }
        if step == 1 {
            // The first event is the end of the line from the unloaded body.
            let first_load: f64 = row[3].parse().unwrap();
            assert!((number(&path[1]["load_factor"]) - first_load).abs() < 1e-12 * first_load);
            seen += 1;
        }
    }
    assert!(seen > 0);
    // Before the first breakage everything grows with the load: a stepped run below it.
    let first: Vec<&str> = table.lines().nth(1).unwrap().split(',').collect();
    let critical: f64 = first[3].parse().unwrap();
    let stepped = SHEARED.replace("control = \"event\"", "steps = [0.05, 0.1]");
    let results = run(folder.path(), &stepped, &[]);
    let found = bonds(&results, &["--bond", first[6], first[7]]);
    for (step, factor) in [(1, 0.05), (2, 0.1)] {
        if factor < critical {
            let utilisation = number(&found[0]["path"][step]["utilisation"][0]);
            assert!(
                (utilisation - factor / critical).abs() < 1e-9,
                "{utilisation}"
            );
        }
    }
}

/// The largest utilisation covers all events, also events without fields, and the last event is not the worst for all bonds.
#[test]
fn the_largest_utilisation_is_of_all_events() {
    let folder = tempfile::tempdir().unwrap();
    let point = ["--point", "25"];
    let all = bonds(&run(folder.path(), SHEARED, &[]), &point);
    let results = run(folder.path(), SHEARED, &["output.fields_every=0"]);
    let history = fs::read_to_string(results.join("history.csv")).unwrap();
    let note = format!("2 of {} steps have fields", history.lines().count() - 1);
    assert!(explain(&results, &point).contains(&note), "{note}");
    let few = bonds(&results, &point);
    assert_eq!(all.len(), few.len());
    let mut before_the_end = 0;
    for (all, few) in all
        .iter()
        .zip(&few)
        .filter(|(all, _)| all["breakage"].is_null())
    {
        let path = all["path"].as_array().unwrap();
        let of_path = path.iter().map(|it| number(&it["utilisation"][0]));
        let largest = of_path.fold(0.0, f64::max);
        // Seven digits.
        let told = number(&few["largest"]["utilisation"]);
        assert!((told - largest).abs() <= 4e-7 * largest, "{told} {largest}");
        let step = number(&few["largest"]["step"]) as usize;
        assert!((number(&path[step]["utilisation"][0]) - largest).abs() <= 4e-7 * largest);
        before_the_end += usize::from(0 < step && step + 1 < path.len());
    }
    assert!(before_the_end > 3, "{before_the_end}");
}

/// Bonds with strains of their own, whose rectangles lose corners as bonds break: the strains from the fields in the event in which a
/// bond breaks equal the strains that the run recorded, and are at its limit.
#[test]
fn strains_of_fields_are_those_of_the_breakages() {
    const CRACKED: &str = r#"
lattice = { cells = [16, 16], spacing = 0.002, thickness = 0.001, set = { base = { bottom = 1 }, end = { top = 1 } } }
material = { young = 65.8e9, poisson = 0.3, fracture_energy = 6137.0 }
model = { law = "mbb-pd", horizon_factor = 3.0 }
precrack = [{ points = [[-0.001, 0.016], [0.0103, 0.016]] }]
support = [{ group = "base", displacement = { x = 0.0, y = 0.0 } }]
load = [{ group = "end", displacement = { x = 1e-4, y = 4e-4 } }]
no_fail = [{ group = "base" }, { group = "end" }]
fracture = { control = "event", stop = { bonds = 40 } }
output = { fields_every = 1 }
"#;
    let folder = tempfile::tempdir().unwrap();
    let results = run(folder.path(), CRACKED, &[]);
    let table = fs::read_to_string(results.join("breaks.csv")).unwrap();
    let header: Vec<&str> = table.lines().next().unwrap().split(',').collect();
    assert_eq!(header[10..], ["strain_xx", "strain_xy", "strain_yy"]);
    assert!(table.lines().count() > 30);
    for row in table.lines().skip(1).step_by(5) {
        let row: Vec<&str> = row.split(',').collect();
        let step: usize = row[1].parse().unwrap();
        let found = bonds(&results, &["--bond", row[6], row[7]]);
        let (path, broke) = (&found[0]["path"], &found[0]["breakage"]);
        let largest = (0..2)
            .map(|it| number(&path[step]["utilisation"][it]))
            .fold(0.0, f64::max);
        assert!((largest - 1.0).abs() < 1e-9, "{row:?}");
        for name in &header[10..] {
            let (then, of_fields) = (number(&broke[*name]), number(&path[step][*name]));
            // Rounding of differences of displacements over a bond, against a limit of 7e-3.
            assert!(
                (then - of_fields).abs() < 1e-11,
                "{name}: {then} {of_fields}"
            );
        }
    }
}

/// Points that are all fixed keep the stretch -alpha dT of their cooling, the mean of the two ends; the deformation of the bond is
/// shown without the expansion, along the path and at the breakage.
#[test]
fn deformations_are_told_beyond_the_expansion() {
    let (case, _) = BAR.split_once("[[precrack]]").unwrap();
    let case = case
        .replace(
            "tensile_strength",
            "thermal_expansion = 2e-5\ntensile_strength",
        )
        .replace("all = {", "left = { left = 4 }\nall = {");
    let heat = "[[support]]\ngroup = \"all\"\ndisplacement = { x = 0, y = 0 }\n\
                [[temperature]]\nchange = -10.0\n[[temperature]]\ngroup = \"left\"\nchange = -30.0\n\
                [fracture]\nsteps = 10\n[output]\nfields_every = 1\n";
    let folder = tempfile::tempdir().unwrap();
    let results = run(folder.path(), &format!("{case}{heat}"), &[]);
    for (from, across, change) in [(1, 2, 30.0), (2, 2, 20.0), (6, 1, 10.0)] {
        let found = bond(&results, cell(from, 2), cell(from + across, 2));
        let path = found["path"].as_array().unwrap();
        assert_eq!(path.len(), 11);
        for (step, moment) in path.iter().enumerate() {
            let expected = 2e-5 * change * step as f64 / 10.0;
            assert!((number(&moment["stretch"]) - expected).abs() < 1e-15);
            assert!(number(&moment["shear"]).abs() < 1e-15);
        }
        let limit = number(&found["limits"][0]["limit"]);
        let largest = number(&found["largest"]["utilisation"]);
        // Seven digits, unless it broke.
        assert!(
            (largest * limit / (2e-5 * change) - 1.0).abs() < 1e-6,
            "{largest}"
        );
    }
}

/// A joint is named by `check`, with the number of its bonds, and by `explain`. Bonds of the offsets (p, q) that cross a line between two rows of 20
/// cells: q (20 - |p|), and within three spacings 94 for q = 1, 188 for q = 2 and 60 for q = 3.
#[test]
fn an_interface_is_named_with_its_bonds() {
    const JOINT: &str = include_str!("../../../../cases/brick-joint/case.toml");
    let folder = tempfile::tempdir().unwrap();
    let results = run(folder.path(), JOINT, &["fracture.steps=1"]);
    let said = stdout(&ligament_in(
        folder.path(),
        &["check", "case.toml", "--model-only"],
    ));
    assert!(
        said.contains("interface brick-mortar 342 bonds; tensile_strength = 4e5"),
        "{said}"
    );
    // Cells 390 and 410 are on both sides of the joint, 370 and 390 in the brick.
    assert!(explain(&results, &["--bond", "390", "410"]).contains("crosses brick-mortar"));
    assert!(!explain(&results, &["--bond", "370", "390"]).contains("brick-mortar"));
    for (setting, expected) in [
        (
            "interface.0.between=['brick','mortr']",
            "did you mean `mortar`?",
        ),
        ("interface.0.between=['brick','brick']", "both are this one"),
        (
            "fracture.criterion=[{kind='tension',limit=1e-4}]",
            "no criterion takes a property that it has",
        ),
        (
            "interface.0.tensile_strength=-1",
            "must be greater than 0, found -1.0",
        ),
    ] {
        let refused = ligament_in(folder.path(), &["check", "case.toml", "--set", setting]);
        assert_eq!(refused.status.code(), Some(1), "{setting}");
        assert!(
            stderr(&refused).contains(expected),
            "{setting}: {}",
            stderr(&refused)
        );
    }
}

/// A bond that the stress around it lets soften is told with the limit at which it began. In one straight line its force falls to zero at
/// e_f = e_c^2/e_i, so that it takes what a brittle bond of the critical stretch e_c does; e_c is what bonds that never began break at, over E'.
#[test]
fn softening_by_stress_is_told_from_where_it_began() {
    const JOINT: &str = include_str!("../../../../cases/brick-joint/case.toml");
    let folder = tempfile::tempdir().unwrap();
    let limit = |found: &Value, place: usize, key: &str| found["limits"][place][key].as_f64();
    let sound = run(
        folder.path(),
        JOINT,
        &["fracture.steps=1", "load.0.displacement.y=1e-9"],
    );
    let words = explain(&sound, &["--bond", "385", "405"]);
    assert!(words.contains("has not begun to soften"), "{words}");
    let found = bond(&sound, 385, 405);
    let bar = number(&found["limits"][0]["coefficients"][2]);
    let critical = limit(&found, 0, "limit").unwrap() / bar;

    let results = run(folder.path(), JOINT, &["output.fields_every=1"]);
    let words = explain(&results, &["--bond", "385", "405"]);
    assert!(
        words.contains("no longer counts: the bond began to soften"),
        "{words}"
    );
    let found = bond(&results, 385, 405);
    let [began, end] = ["limit", "break_limit"].map(|it| limit(&found, 1, it).unwrap());
    // The limits of bonds that never began are infinite, which JSON has no number for.
    assert_eq!(limit(&found, 0, "limit"), None);
    assert!(
        (began * end / critical.powi(2) - 1.0).abs() < 1e-12,
        "{began} {end}"
    );
    let broke = &found["breakage"];
    let ratio = number(&found["limits"][1]["coefficients"][0]);
    let measure = |at: &Value| {
        let [stretch, shear] = ["stretch", "shear"].map(|it| number(&at[it]));
        (stretch.max(0.0).powi(2) + shear.powi(2) * ratio).sqrt()
    };
    let beyond = number(&broke["utilisation"]);
    assert!(
        (measure(broke) / end / beyond - 1.0).abs() < 1e-9,
        "{beyond}"
    );
    let path = found["path"].as_array().unwrap();
    let last = path.iter().rfind(|it| it["intact"] == true).unwrap();
    let utilisation = number(&last["utilisation"][1]);
    assert!((measure(last) / began / utilisation - 1.0).abs() < 1e-6);
    assert!(utilisation > 1.0 && number(&last["utilisation"][0]) == 0.0);
}
