//! Pictures of fields, cracks, modes and curves.

use std::fs;
use std::path::PathBuf;

use roxmltree::Document;

use super::{LATTICE, call, pixels, plot, refusal, run, steps, text, texts};
use crate::support;

#[test]
fn a_field_has_title_scale_and_colour_bar_and_is_the_same_twice() {
    let folder = tempfile::tempdir().unwrap();
    let results = run(folder.path(), LATTICE, "plate", &[]);
    let path = results.to_str().unwrap();
    let out = folder.path().join("a.svg");
    let out = out.to_str().unwrap();
    let svg = plot(&[path, "--scale", "50", "--out", out]);
    let all = texts(&svg);
    let (last, displacement, _) = *steps(&results).last().unwrap();
    let title = format!("step {last}, displacement {:.2} µm", 1e6 * displacement);
    assert!(
        all.iter().any(|it| it.starts_with(&title)),
        "{title}: {all:?}"
    );
    assert!(all.contains(&"deformation × 50".to_owned()), "{all:?}");
    assert!(all.contains(&"damage".to_owned()), "{all:?}");
    assert!(
        all.contains(&"0.0".to_owned()) && all.len() > 6,
        "labels of the bar: {all:?}"
    );
    assert_eq!(plot(&[path, "--scale", "50", "--out", out]), svg);

    let png = folder.path().join("a.png");
    let png = png.to_str().unwrap();
    let drawn = plot(&[path, "--width", "60", "--dpi", "120", "--out", png]);
    let ([width, height], colours) = pixels(&drawn);
    // 60 mm at 120 dots per inch are 283.46 dots.
    assert_eq!(width, 283);
    let middle = &colours[3 * (width * (height * 2 / 3) + width / 3)..][..3];
    assert_ne!(middle, [255, 255, 255], "the body is in the middle");
    assert_eq!(
        plot(&[path, "--width", "60", "--dpi", "120", "--out", png]),
        drawn
    );
}

/// A picture of a folder lies in it, and no file of the run is touched.
#[test]
fn a_picture_lies_beside_the_results_and_changes_none() {
    let folder = tempfile::tempdir().unwrap();
    let results = run(folder.path(), LATTICE, "plate", &[]);
    let contents = || {
        let entries = fs::read_dir(&results).unwrap().map(|it| it.unwrap().path());
        let mut all: Vec<(PathBuf, Vec<u8>)> = entries
            .map(|path| (path.clone(), fs::read(path).unwrap()))
            .collect();
        all.sort();
        all
    };
    let before = contents();
    plot(&[results.to_str().unwrap()]);
    plot(&["--curve", results.to_str().unwrap()]);
    let after = contents();
    let is_new = |it: &&(PathBuf, Vec<u8>)| !before.contains(it);
    let new: Vec<_> = after
        .iter()
        .filter(is_new)
        .map(|it| it.0.file_name().unwrap())
        .collect();
    assert_eq!(new, ["picture-curve.png", "picture-damage.png"]);
    assert_eq!(after.len(), before.len() + 2);
}

#[test]
fn outputs_are_chosen_by_step_strip_or_displacement() {
    let folder = tempfile::tempdir().unwrap();
    let results = run(folder.path(), LATTICE, "plate", &[]);
    let path = results.to_str().unwrap();
    let out = folder.path().join("a.svg");
    let titles = |words: &[&str]| {
        let call: Vec<&str> = [&[path, "--out", out.to_str().unwrap()], words].concat();
        let all = texts(&plot(&call));
        let of_steps = all.iter().filter_map(|it| it.strip_prefix("step "));
        let number = |it: &str| it.split(',').next().unwrap().parse::<usize>().unwrap();
        of_steps.map(number).collect::<Vec<_>>()
    };
    let last = steps(&results).last().unwrap().0;
    assert_eq!(titles(&[]), [last]);
    assert_eq!(titles(&["--step", "3", "1"]), [3, 1]);
    assert_eq!(titles(&["--step", "3,1"]), [3, 1]);
    assert_eq!(titles(&["--strip", "2"]), [0, last]);
    // The load goes up by 2e-6 m a step.
    assert_eq!(titles(&["--displacement", "4.1e-6"]), [2]);
}

/// The paths of bonds in an SVG have two points each: as many pieces as `breaks.csv` has rows up to the step.
#[test]
fn the_crack_is_made_of_the_broken_bonds_and_the_precrack() {
    let folder = tempfile::tempdir().unwrap();
    let results = run(folder.path(), LATTICE, "plate", &[]);
    let path = results.to_str().unwrap();
    let out = folder.path().join("a.svg");
    let out = out.to_str().unwrap();
    let breaks = fs::read_to_string(results.join("breaks.csv")).unwrap();
    let n_broken = breaks.lines().count() - 1;
    assert!(n_broken > 10);
    let svg = plot(&[path, "--field", "none", "--crack", "--out", out]);
    let all = texts(&svg);
    assert!(all.contains(&format!("strength ({n_broken})")), "{all:?}");
    assert!(
        all.iter().any(|it| it.starts_with("pre-crack (")),
        "{all:?}"
    );
    let svg = text(&svg);
    let of_colour = |svg: &str, colour: &str| {
        let document = Document::parse(svg).unwrap();
        let paths = document
            .descendants()
            .filter(|it| it.attribute("stroke") == Some(colour))
            // Samples of the legend are wider than bonds.
            .filter(|it| it.attribute("stroke-width") == Some("40"));
        paths
            .filter_map(|it| it.attribute("d"))
            .map(|it| it.matches('m').count())
            .sum::<usize>()
    };
    assert_eq!(of_colour(&svg, "#0072b2"), n_broken);
    assert!(
        of_colour(&svg, "#8c8c8c") > 5,
        "bonds that the pre-crack cut"
    );
    // In a corner without a crack nothing of it is left.
    let corner = ["--box", "0.08,0.06,0.1,0.08", "--scale", "0"];
    let words = [
        &[
            path, "--field", "none", "--crack", "--step", "0", "--out", out,
        ],
        &corner[..],
    ]
    .concat();
    let svg = text(&plot(&words));
    assert!(of_colour(&svg, "#8c8c8c") == 0 && svg.contains("clip-path"));
    assert!(svg.contains("undeformed"));
}

#[test]
fn fields_have_units_and_signs_their_colours() {
    let folder = tempfile::tempdir().unwrap();
    let results = run(
        folder.path(),
        LATTICE,
        "plate",
        &["output.stress=[\"virial\"]"],
    );
    let path = results.to_str().unwrap();
    let out = folder.path().join("a.svg");
    let out = out.to_str().unwrap();
    let of = |field: &str| {
        let svg = plot(&[path, "--step", "2", "--field", field, "--out", out]);
        (texts(&svg), text(&svg))
    };
    assert!(
        of("displacement.y")
            .0
            .contains(&"displacement.y (µm)".to_owned())
    );
    assert!(
        of("stress_virial.yy").0.iter().any(|it| it
            .starts_with("stress_virial.yy, right in the mean (")
            && it.ends_with("Pa)"))
    );
    let (labels, svg) = of("displacement.x");
    assert!(labels.contains(&"0.0".to_owned()), "{labels:?}");
    // Ends of the diverging map, as its splines give them.
    assert!(svg.contains("#042f60") && svg.contains("#67001f"));
    let words = [
        path, "--field", "damage", "--range", "0,0.5", "--levels", "5", "--map", "cividis",
        "--out", out,
    ];
    let svg = plot(&words);
    let labels = texts(&svg);
    for label in ["0.0", "0.1", "0.2", "0.3", "0.4"] {
        assert!(labels.contains(&label.to_owned()), "{labels:?}");
    }
}

/// A point whose bonds pre-cracks cut has no stress: pictures leave its square bare, and the page, a profile and a probe are written.
#[test]
fn points_without_a_stress_are_bare() {
    let folder = tempfile::tempdir().unwrap();
    let box_of_one = "precrack=[{ points = [[0.0501, 0.0601], [0.0599, 0.0601], [0.0599, 0.0699], [0.0501, 0.0699], [0.0501, 0.0601]] }]";
    let probe = "probe=[{ name = \"alone\", at = [0.055, 0.065], field = \"stress.yy\" }]";
    let settings = ["output.stress=[\"material\"]", box_of_one, probe];
    let results = run(folder.path(), LATTICE, "plate", &settings);
    let path = results.to_str().unwrap();
    let history = fs::read_to_string(results.join("history.csv")).unwrap();
    assert!(
        history.starts_with("step,") && history.trim_end().ends_with("nan"),
        "{history}"
    );
    let out = folder.path().join("a.svg");
    let out = out.to_str().unwrap();
    // Outlines of the body, of which the square is one, beyond those of the lowest band, which is drawn over it.
    let bare = |field: &str| {
        let svg = plot(&[path, "--step", "2", "--field", field, "--out", out]);
        assert!(texts(&svg).iter().any(|it| it.starts_with(field)));
        let svg = text(&svg);
        let document = Document::parse(&svg).unwrap();
        let paths: Vec<(Option<&str>, usize)> = (document.descendants())
            .filter_map(|it| {
                Some((
                    it.attribute("fill"),
                    it.attribute("d")?.matches('m').count(),
                ))
            })
            .collect();
        let body = paths.iter().position(|it| it.0 == Some("#dcdcdc")).unwrap();
        paths[body].1 - paths[body + 1].1
    };
    let found = ["stress_principal.1", "stress.xy", "damage"].map(bare);
    assert_eq!(found, [1, 1, 0]);
    let line = ["profile", path, "--from", "0,0.065", "--to", "0.12,0.065"];
    let profile = support::ligament([&line[..], &["--field", "stress.yy", "--step", "2"]].concat());
    assert!(
        text(&profile.stdout).contains(",nan"),
        "{}",
        text(&profile.stderr)
    );
    for words in [["report", path], ["repeat", path]] {
        let output = support::ligament(words);
        assert_eq!(output.status.code(), Some(0), "{}", text(&output.stderr));
    }
}

#[test]
fn curves_have_labels_units_and_first_peaks() {
    let folder = tempfile::tempdir().unwrap();
    let first = run(folder.path(), LATTICE, "coarse", &[]);
    let second = run(
        folder.path(),
        LATTICE,
        "weak",
        &["material.tensile_strength=0.8e6"],
    );
    let (first, second) = (first.to_str().unwrap(), second.to_str().unwrap());
    let out = folder.path().join("a.svg");
    let out = out.to_str().unwrap();
    let svg = plot(&[
        "--curve", first, second, "--out", out, "--labels", "1 MPa", "0.8 MPa",
    ]);
    let all = texts(&svg);
    for label in [
        "1 MPa",
        "0.8 MPa",
        "first peak",
        "displacement (µm)",
        "reaction (kN)",
    ] {
        assert!(all.contains(&label.to_owned()), "{label}: {all:?}");
    }
    assert!(text(&svg).starts_with("<svg width=\"160.000mm\""));
    let named = texts(&plot(&["--curve", first, second, "--out", out]));
    assert!(named.contains(&"coarse".to_owned()) && named.contains(&"weak".to_owned()));
    let energy = [
        "--curve",
        first,
        "--y",
        "stored_energy",
        "--x",
        "step",
        "--out",
        out,
    ];
    let all = texts(&plot(&energy));
    assert!(
        all.contains(&"step".to_owned()) && all.iter().any(|it| it.starts_with("stored energy (")),
        "{all:?}"
    );
}

#[test]
fn modes_are_drawn_with_their_frequencies() {
    let folder = tempfile::tempdir().unwrap();
    let modal = LATTICE
        .replace("[fracture]\nsteps = 10\n", "")
        .replace("young = 10e9", "young = 10e9\ndensity = 2500.0")
        .replace(
            "title = \"Plate\"",
            "title = \"Plate\"\nanalysis = \"modal\"",
        )
        .replace("fields_every = 1\n", "");
    let (start, end) = (
        modal.find("[[precrack]]").unwrap(),
        modal.find("[output]").unwrap(),
    );
    let modal = modal
        .replace(&modal[start..end], "[modal]\nmodes = 4\n")
        .replace("[output]\n", "");
    let results = run(folder.path(), &modal, "modes", &[]);
    let path = results.to_str().unwrap();
    let out = folder.path().join("a.svg");
    let out = out.to_str().unwrap();
    let all = texts(&plot(&[path, "--out", out]));
    let modes: Vec<&String> = all.iter().filter(|it| it.starts_with("mode ")).collect();
    assert_eq!(modes.len(), 4, "{all:?}");
    assert!(modes[0].starts_with("mode 1: ") && modes[0].ends_with(" Hz"));
    let two = texts(&plot(&[path, "--mode", "2", "--out", out]));
    assert_eq!(two.iter().filter(|it| it.starts_with("mode ")).count(), 1);
    assert!(refusal(&["--curve", path]).contains("natural modes"));
    assert!(refusal(&[path, "--crack"]).contains("--crack"));
    assert!(refusal(&[path, "--mode", "9"]).contains("no output of mode 9; there are 1, 2, 3, 4"));
}

/// Files of a run that was killed: no summary, and a history that ends early.
#[test]
fn a_run_that_was_cut_short_is_drawn() {
    let folder = tempfile::tempdir().unwrap();
    let results = run(folder.path(), LATTICE, "plate", &[]);
    fs::remove_file(results.join("summary.json")).unwrap();
    let history = fs::read_to_string(results.join("history.csv")).unwrap();
    let kept: Vec<&str> = history.lines().take(4).collect();
    fs::write(
        results.join("history.csv"),
        kept.join("\n") + "\n4,0.4,8e-6,1.2",
    )
    .unwrap();
    let path = results.to_str().unwrap();
    let out = folder.path().join("a.svg");
    let out = out.to_str().unwrap();
    assert!(
        texts(&plot(&[path, "--step", "2", "--out", out]))
            .iter()
            .any(|it| it.starts_with("step 2, displacement 4.000 µm"))
    );
    assert!(
        !texts(&plot(&[path, "--out", out])).is_empty(),
        "a step without a row of the history"
    );
    plot(&["--curve", path, "--out", out]);
    fs::remove_file(results.join("history.csv")).unwrap();
    plot(&[path, "--out", out]);
}

#[test]
fn what_cannot_be_drawn_is_told_with_what_can() {
    let folder = tempfile::tempdir().unwrap();
    let results = run(folder.path(), LATTICE, "plate", &["output.fields_every=5"]);
    let path = results.to_str().unwrap();
    for (words, message) in [
        (vec![path, "--field", "damge"], "did you mean `damage`?"),
        (
            vec![path, "--step", "3"],
            "no output of step 3; there are 0, 5",
        ),
        (
            vec!["--curve", path, "--y", "reactoin"],
            "did you mean `reaction`?",
        ),
        (
            vec![path, "--out", "a.eps"],
            "a picture ends in .png, .svg or .pdf",
        ),
        (vec![path, "--labels", "a", "b"], "2 labels for 1 results"),
        (vec!["nowhere"], "there is no such folder"),
        (
            vec![folder.path().to_str().unwrap()],
            "it has no case.resolved.toml",
        ),
        (
            vec![path, "--dpi", "1e6"],
            "choose another --width or --dpi",
        ),
    ] {
        let error = refusal(&words);
        assert!(
            error.starts_with("error: ") && error.contains(message),
            "{words:?}: {error}"
        );
    }
    for words in [
        vec![path, "--range", "1,0"],
        vec![path, "--strip", "0"],
        vec![path, "--scale", "big"],
    ] {
        assert_eq!(call(&words).status.code(), Some(2), "{words:?}");
    }
    for entry in fs::read_dir(&results).unwrap() {
        let name = entry.unwrap().file_name().into_string().unwrap();
        assert!(
            !name.starts_with("picture"),
            "{name} of a picture that was refused"
        );
    }
}
