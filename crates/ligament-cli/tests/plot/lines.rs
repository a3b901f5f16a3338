//! Crack paths, lines of tables, points that stand out on curves, and pictures at the end of a run.

use std::fs;

use super::{LATTICE, call, ligament, plot, refusal, run, steps, text, texts};

/// Three cracks: one runs on from the pre-crack by 40 mm, two run in from the right side beside the clamps by 50 mm each, to a cell of
/// 10 mm.
#[test]
fn the_crack_path_is_drawn_with_its_length_tips_and_axes() {
    let folder = tempfile::tempdir().unwrap();
    let results = run(folder.path(), LATTICE, "plate", &[]);
    let path = results.to_str().unwrap();
    let out = folder.path().join("a.svg");
    let out = out.to_str().unwrap();
    let svg = plot(&[path, "--crack=lines", "--out", out]);
    let all = texts(&svg);
    for label in ["x (mm)", "y (mm)", "100", "80", "undeformed", "pre-crack"] {
        assert!(all.contains(&label.to_owned()), "{label}: {all:?}");
    }
    let length = all.iter().find_map(|it| it.strip_prefix("crack path ("));
    let length: f64 = length
        .unwrap()
        .strip_suffix(" mm)")
        .unwrap()
        .parse()
        .unwrap();
    assert!((130.0..=150.0).contains(&length), "{length}");
    // Nothing broke in the first state: there is no path, and the pre-crack is there.
    let first = texts(&plot(&[path, "--crack=lines", "--step", "0", "--out", out]));
    assert!(!first.iter().any(|it| it.starts_with("crack path")));
    assert!(first.contains(&"pre-crack".to_owned()));
    // Over a field, with lines of a table.
    let band = folder.path().join("band.csv");
    fs::write(&band, "x,y\n0.04,0.03\n0.12,0.03\n\n0.04,0.05\n0.12,0.05\n").unwrap();
    let band = band.to_str().unwrap();
    let words = [
        path,
        "--crack=lines",
        "--field",
        "damage",
        "--with-lines",
        band,
    ];
    let svg = plot(&[&words[..], &["--out", out]].concat());
    let all = texts(&svg);
    assert!(all.contains(&"band".to_owned()) && all.contains(&"damage".to_owned()));
    let blue = text(&svg);
    let blue = blue
        .lines()
        .find(|it| it.contains("stroke=\"#0072b2\" stroke-width=\"100\""));
    assert_eq!(
        blue.unwrap().matches('m').count() - 1,
        2,
        "two lines: {blue:?}"
    );

    let moved = refusal(&[path, "--with-lines", band, "--scale", "10"]);
    assert!(moved.contains("leave out --scale"), "{moved}");
    fs::write(band, "0.04,0.03\n0.12\n").unwrap();
    let broken = refusal(&[path, "--with-lines", band]);
    assert!(broken.contains("row 2, `0.12`"), "{broken}");
    let other = call(&[path, "--crack=line"]);
    assert_eq!(other.status.code(), Some(2));
}

/// Rows of the history whose bonds were still failing are marked by crosses, the others are connected.
#[test]
fn curves_mark_the_first_breakage_and_what_is_not_at_rest() {
    let folder = tempfile::tempdir().unwrap();
    let results = run(folder.path(), LATTICE, "plate", &[]);
    let path = results.to_str().unwrap();
    let out = folder.path().join("a.svg");
    let out = out.to_str().unwrap();
    let all = texts(&plot(&["--curve", path, "--out", out]));
    for label in ["first breakage", "first peak"] {
        assert!(all.contains(&label.to_owned()), "{label}: {all:?}");
    }
    assert!(!all.contains(&"not converged".to_owned()));
    let table = results.join("history.csv");
    let history = fs::read_to_string(&table).unwrap();
    let names: Vec<&str> = history.lines().next().unwrap().split(',').collect();
    let at_rest = names.iter().position(|it| *it == "at_rest").unwrap();
    let last = steps(&results).last().unwrap().0;
    let unsettled = |line: &str| {
        let mut values: Vec<&str> = line.split(',').collect();
        let is_last = values[0] == "3" || values[0] == last.to_string();
        if is_last {
            values[at_rest] = "0";
        }
        values.join(",") + "\n"
    };
    fs::write(&table, history.lines().map(unsettled).collect::<String>()).unwrap();
    let svg = plot(&["--curve", path, "--out", out]);
    assert!(texts(&svg).contains(&"not converged".to_owned()));
    // A picture of such a step says so twice: in its title and in a sentence below.
    let all = texts(&plot(&[path, "--out", out]));
    assert!(all.iter().any(|it| it.contains("not converged")), "{all:?}");
    assert!(
        all.iter()
            .any(|it| it.contains("still breaking at this load")),
        "{all:?}"
    );
}

#[test]
fn a_run_draws_its_pictures_if_asked() {
    let folder = tempfile::tempdir().unwrap();
    let asked = run(folder.path(), LATTICE, "asked", &["output.picture=true"]);
    for name in ["picture-damage.png", "picture-curve.png"] {
        assert!(asked.join(name).is_file(), "{name}");
    }
    let plain = run(folder.path(), LATTICE, "plain", &[]);
    assert!(!plain.join("picture-damage.png").exists());
    let resolved = fs::read_to_string(plain.join("case.resolved.toml")).unwrap();
    assert!(!resolved.contains("picture"), "{resolved}");
    let (case, out) = (folder.path().join("case.toml"), folder.path().join("flag"));
    let words = [
        "run",
        case.to_str().unwrap(),
        "--out",
        out.to_str().unwrap(),
        "--plot",
    ];
    let output = ligament(words);
    assert_eq!(output.status.code(), Some(0), "{}", text(&output.stderr));
    assert!(text(&output.stdout).contains("picture            "));
    for name in ["picture-damage.png", "picture-curve.png"] {
        assert_eq!(
            fs::read(out.join(name)).unwrap(),
            fs::read(asked.join(name)).unwrap()
        );
    }
    // The last line of a run tells where the results are, and pictures are told below it.
    let last = text(&output.stdout);
    assert!(last.lines().last().unwrap().ends_with("picture-curve.png"));
}
