//! Steps selected by events, and a picture of each.

use std::fs;

use super::{LATTICE, call, pixels, plot, refusal, run, steps, text, texts};

/// The titles of steps in a picture of a folder.
fn titles(results: &str, words: &[&str], out: &str) -> Vec<String> {
    let call: Vec<&str> = [&[results, "--out", out], words].concat();
    let all = texts(&plot(&call));
    let of_steps = all.into_iter().filter(|it| it.starts_with("step "));
    of_steps.collect()
}

/// The plate's load grows by 2e-6 m a step; which step is which follows from its history.
#[test]
fn steps_are_named_by_what_happened_in_them() {
    let folder = tempfile::tempdir().unwrap();
    let results = run(folder.path(), LATTICE, "plate", &[]);
    let path = results.to_str().unwrap();
    let out = folder.path().join("a.svg");
    let out = out.to_str().unwrap();
    let history = steps(&results);
    let (peak, ..) = *(history.iter()).max_by(|a, b| a.2.total_cmp(&b.2)).unwrap();
    let breaks = fs::read_to_string(results.join("breaks.csv")).unwrap();
    let first = breaks.lines().nth(1).unwrap().split(',').nth(1).unwrap();
    let last = history.last().unwrap().0;
    assert!(peak > 0 && peak < last);
    let all = titles(path, &["--step", "first,peak,last", "--columns", "1"], out);
    let starts = [
        format!("step {first}, first breakage, displacement "),
        format!("step {peak}, peak, displacement "),
        format!("step {last}, displacement "),
    ];
    assert_eq!(all.len(), 3);
    for (title, start) in all.iter().zip(&starts) {
        assert!(title.starts_with(start), "{start}: {all:?}");
    }
    // Where nothing is stored of the step, the next stored one is drawn and says so.
    let few = run(folder.path(), LATTICE, "few", &["output.fields_every=0"]);
    let title = titles(
        few.to_str().unwrap(),
        &["--step", "peak", "--width", "180"],
        out,
    );
    let nearest = format!("step {last}, next stored after the peak in step {peak}");
    assert!(title[0].starts_with(&nearest), "{title:?}");

    let intact = run(
        folder.path(),
        LATTICE,
        "intact",
        &["material.tensile_strength=1e9"],
    );
    let error = refusal(&[intact.to_str().unwrap(), "--step", "first"]);
    assert!(error.contains("no bond broke or softened"), "{error}");
    let both = refusal(&[path, "--step", "all", "3"]);
    assert!(both.contains("leave out the others"), "{both}");
    let unknown = call(&[path, "--step", "paek"]);
    assert_eq!(unknown.status.code(), Some(2));
    assert!(text(&unknown.stderr).contains("peak, last or all"));
}

/// Colours, scale of the displacement, size and the place of the body are the same in all pictures.
#[test]
fn each_step_has_a_picture_of_its_own_with_the_same_scales() {
    let folder = tempfile::tempdir().unwrap();
    let results = run(folder.path(), LATTICE, "plate", &[]);
    let path = results.to_str().unwrap();
    let out = folder.path().join("ux.svg");
    let words = [path, "--step", "all", "--field", "displacement.y", "--out"];
    let output = call(&[&words[..], &[out.to_str().unwrap()]].concat());
    assert_eq!(output.status.code(), Some(0), "{}", text(&output.stderr));
    let names = text(&output.stdout);
    let names: Vec<&str> = names.lines().collect();
    let last = steps(&results).last().unwrap().0;
    assert_eq!(names.len(), last + 1);
    assert!(names[3].ends_with("ux-0003.svg"), "{names:?}");
    assert!(!out.exists());
    let svgs: Vec<Vec<u8>> = names.iter().map(|name| fs::read(name).unwrap()).collect();
    // All but the title of the step: the labels of the bar, its unit and the scale.
    let rest = |svg: &[u8]| {
        let all = texts(svg).into_iter();
        all.filter(|it| !it.starts_with("step ") && !it.contains("reaction"))
            .collect::<Vec<_>>()
    };
    let head = |svg: &[u8]| text(svg).lines().next().unwrap().to_owned();
    assert!(
        rest(&svgs[0])
            .iter()
            .any(|it| it.starts_with("deformation × "))
    );
    for svg in &svgs {
        assert_eq!(rest(svg), rest(&svgs[0]));
        assert_eq!(head(svg), head(&svgs[0]));
    }
    // The unloaded body is the reference of the others, so that its outline differs from theirs.
    assert_ne!(svgs[0], svgs[last]);

    let png = folder.path().join("all.png");
    let words = [
        path, "--step", "all", "--width", "40", "--dpi", "100", "--out",
    ];
    let output = call(&[&words[..], &[png.to_str().unwrap()]].concat());
    let sizes = text(&output.stdout);
    let sizes = sizes.lines().map(|name| pixels(&fs::read(name).unwrap()).0);
    let sizes: Vec<[usize; 2]> = sizes.collect();
    assert!(sizes.iter().all(|size| *size == sizes[0]), "{sizes:?}");
    let two = refusal(&[path, path, "--step", "all"]);
    assert!(two.contains("one result at a time"), "{two}");
}

/// Time for which a picture is shown, hundredths of a second, and the colours of all its dots.
type Shown = (u16, Vec<[u8; 3]>);

/// Width and pictures of an animation.
fn shown(bytes: &[u8]) -> (usize, Vec<Shown>) {
    let mut decoder = gif::DecodeOptions::new().read_info(bytes).unwrap();
    let palette = decoder
        .global_palette()
        .unwrap()
        .as_chunks::<3>()
        .0
        .to_vec();
    let (width, height) = (usize::from(decoder.width()), usize::from(decoder.height()));
    let mut canvas = vec![[0; 3]; width * height];
    let mut pictures = Vec::new();
    while let Some(frame) = decoder.read_next_frame().unwrap() {
        assert!(frame.palette.is_none(), "one palette for all");
        for (place, &dot) in frame.buffer.iter().enumerate() {
            let columns = usize::from(frame.width);
            let x = usize::from(frame.left) + place % columns;
            let y = usize::from(frame.top) + place / columns;
            canvas[width * y + x] = palette[usize::from(dot)];
        }
        pictures.push((frame.delay, canvas.clone()));
    }
    (width, pictures)
}

#[test]
fn an_animation_has_a_picture_of_each_step_with_fixed_colours() {
    let folder = tempfile::tempdir().unwrap();
    let results = run(folder.path(), LATTICE, "plate", &[]);
    let path = results.to_str().unwrap();
    let file = folder.path().join("crack.gif");
    let file = file.to_str().unwrap();
    let words = [path, "--animate", file, "--field", "damage", "--crack"];
    let bytes = plot(&[&words[..], &["--fps", "5"]].concat());
    let (width, pictures) = shown(&bytes);
    // 90 mm at 150 dots per inch.
    assert_eq!(width, 531);
    let last = steps(&results).last().unwrap().0;
    assert_eq!(pictures.len(), last + 1);
    let times: Vec<u16> = pictures.iter().map(|it| it.0).collect();
    assert!(times[..last].iter().all(|it| *it == 20) && times[last] == 200);
    // The colour bar, in the last columns, is the same in all; the body is not.
    let bar = |picture: &[[u8; 3]]| {
        let rows = picture.chunks(width).map(|row| row[width - 60..].to_vec());
        rows.collect::<Vec<_>>()
    };
    let (_, first) = &pictures[0];
    assert!(pictures.iter().all(|it| bar(&it.1) == bar(first)));
    assert!(pictures.windows(2).any(|pair| pair[0].1 != pair[1].1));
    assert_eq!(plot(&[&words[..], &["--fps", "5"]].concat()), bytes);
    // A choice of steps is a choice of pictures.
    let few = plot(&[path, "--animate", file, "--strip", "3", "--width", "40"]);
    assert_eq!(shown(&few).1.len(), 3);
    let other = refusal(&[path, "--animate", "crack.mp4"]);
    assert!(other.contains("in .gif"), "{other}");
}

#[test]
fn a_pdf_is_one_page_of_the_width_with_text() {
    let folder = tempfile::tempdir().unwrap();
    let results = run(folder.path(), LATTICE, "plate", &[]);
    let path = results.to_str().unwrap();
    for (words, points, name) in [
        // 90 and 120 mm in points.
        (
            vec![path, "--format", "pdf"],
            "255.11",
            "picture-damage.pdf",
        ),
        (
            vec!["--curve", path, "--format", "pdf"],
            "340.15",
            "picture-curve.pdf",
        ),
    ] {
        let pdf = plot(&words);
        assert!(results.join(name).is_file());
        let whole = String::from_utf8_lossy(&pdf);
        assert!(whole.starts_with("%PDF-1.") && whole.trim_end().ends_with("%%EOF"));
        assert!(
            whole.contains(&format!("/MediaBox [0 0 {points}")),
            "{name}"
        );
        assert!(whole.contains("/Count 1") && whole.contains("/Identity-H"));
        assert_eq!(plot(&words), pdf, "the same twice");
    }
    let other = refusal(&[path, "--format", "pdf", "--out", "a.svg"]);
    assert!(other.contains("does not end in .pdf"), "{other}");
}
