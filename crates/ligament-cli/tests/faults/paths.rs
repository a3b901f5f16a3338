//! Names and links that would lead out of a folder of results, and files that are not of the expected kind.

use super::*;
use std::io::Read;
use std::os::unix::fs::symlink;

use ligament_analysis::Message;
use ligament_analysis::serial::Serial;
use ligament_output::checkpoint::Checkpoint;
use ligament_output::results::OutputState;

const SECRET: &str =
    "root:$6$SECRETHASH$abcdefgh:19000:0:99999:7:::\nSECRETHASHb3BlbnNzaC1rZXktdjEA\n";

/// Puts a link to the file `victim` in the place of a file.
fn link_to_victim(place: &Place, name: &str) {
    let path = place.path(name);
    let _ = fs::remove_file(&path);
    symlink(place.path("victim"), path).unwrap();
}

fn assert_victim_whole(place: &Place, name: &str) {
    let text = fs::read_to_string(place.path("victim")).unwrap();
    assert_eq!(text, SECRET, "{name}");
}

/// The bar with checkpoints, which a stop rule ends, so that it could go on.
fn stopped() -> Place {
    let place = Place::new();
    fs::write(place.path("victim"), SECRET).unwrap();
    let case = SMALL_BAR.replace("stop = { load_fraction = 0.5 }", "stop = { bonds = 1 }");
    fs::write(place.path("case.toml"), case).unwrap();
    place.run();
    assert!(place.path("out/checkpoint.bin").is_file());
    place
}

/// Nothing is read or written through a link in the place of a file of a run.
#[test]
fn links_in_results_lead_nowhere() {
    for name in [
        ".lock",
        ".replaced",
        "history.csv",
        "timings.csv",
        "summary.json",
        "checkpoint.bin",
        "fields_0000.vtu",
        "model.vtu",
        "case.resolved.toml",
    ] {
        for arguments in [
            &["resume", "out", "--set", "fracture.stop.bonds=2"][..],
            &["run", "case.toml", "--out", "out", "--force"],
            &["plot", "out", "--out", "p.svg"],
            &["plot", "out", "--curve", "--out", "p.svg"],
            &["explain", "out", "--point", "5"],
        ] {
            let place = stopped();
            link_to_victim(&place, &format!("out/{name}"));
            let output = place.ligament(arguments);
            assert_refused(&output, &[name, "is a link", "remove the link"]);
            assert_victim_whole(&place, name);
        }
    }
    // An empty folder, and another one beside it, of somebody else.
    let place = stopped();
    fs::create_dir(place.path("empty")).unwrap();
    link_to_victim(&place, "empty/.lock");
    let output = place.ligament(["run", "case.toml", "--out", "empty"]);
    assert_refused(&output, &["empty/.lock is a link"]);
    assert_victim_whole(&place, "empty/.lock");
    fs::rename(place.path("out"), place.path("theirs")).unwrap();
    place.run();
    let theirs = place.contents("theirs");
    symlink("theirs", place.path("out.new")).unwrap();
    let output = place.ligament(["run", "case.toml", "--out", "out", "--force"]);
    assert_refused(&output, &["out.new is a link"]);
    assert_success(&place.ligament(["resume", "out", "--quiet"]));
    assert_eq!(place.contents("theirs"), theirs);
}

/// Nor through links in the folder of a study or of a calibration.
#[test]
fn links_in_studies_lead_nowhere() {
    let place = stopped();
    let study =
        "case = \"case.toml\"\n[[axis]]\nkey = \"model.horizon_factor\"\nvalues = [2.2, 2.4]\n";
    fs::write(place.path("study.toml"), study).unwrap();
    let sweep = |more: &[&str]| {
        let arguments = [&["sweep", "study.toml", "--out", "study", "--quiet"], more].concat();
        place.ligament(arguments)
    };
    assert_success(&sweep(&[]));
    let run = "study/runs/horizon_factor=2.2";
    let theirs = place.contents(run);
    for name in [
        "study/runs",
        "study/records",
        "study/logs",
        "study/locks",
        "study/meshes",
        run,
    ] {
        let path = place.path(name);
        let is_there = path.is_dir();
        if is_there {
            fs::rename(&path, place.path("theirs")).unwrap();
        } else {
            fs::create_dir(place.path("theirs")).unwrap();
        }
        symlink(place.path("theirs"), &path).unwrap();
        assert_refused(&sweep(&["--force"]), &[name, "is a link"]);
        fs::remove_file(&path).unwrap();
        if is_there {
            fs::rename(place.path("theirs"), &path).unwrap();
        } else {
            fs::remove_dir(place.path("theirs")).unwrap();
        }
        assert_eq!(place.contents(run), theirs, "{name}");
    }
    link_to_victim(&place, "study/locks/sweep.lock");
    assert_refused(&sweep(&[]), &["sweep.lock is a link"]);
    fs::remove_file(place.path("study/locks/sweep.lock")).unwrap();
    // What a run says goes into a file of its own.
    link_to_victim(&place, "study/logs/horizon_factor=2.2.log");
    assert_success(&sweep(&["--force"]));
    assert_victim_whole(&place, "log");

    let calibrate = [
        "calibrate",
        "case.toml",
        "--key",
        "material.tensile_strength",
        "--of",
        "first_break.reaction",
    ];
    let more = ["--target", "500", "--out", "found"];
    let arguments: Vec<&str> = calibrate.into_iter().chain(more).collect();
    assert_success(&place.ligament(&arguments));
    for name in [
        "found/calibration.csv",
        "found/calibration.json",
        "found/.lock",
    ] {
        let before = fs::read(place.path(name)).ok();
        link_to_victim(&place, name);
        assert_refused(&place.ligament(&arguments), &[name, "is a link"]);
        assert_victim_whole(&place, name);
        fs::remove_file(place.path(name)).unwrap();
        if let Some(before) = before {
            fs::write(place.path(name), before).unwrap();
        }
    }
}

/// The newest checkpoint of a folder with its solution.
fn newest(folder: &Path) -> (Checkpoint, Vec<u8>) {
    let (checkpoint, stored) = Checkpoint::list(folder).remove(0).unwrap();
    let mut solution = Vec::new();
    (stored.open(folder).unwrap())
        .read_to_end(&mut solution)
        .unwrap();
    (checkpoint, solution)
}

/// A checkpoint and a collection that name files elsewhere: the first is refused, the second is not read.
#[test]
fn names_in_results_lead_nowhere() {
    let place = stopped();
    let out = place.path("out");
    let (mut checkpoint, solution) = newest(&out);
    let name = b"fields_0000.vtu";
    for other in [
        b"../../evil0.vtu",
        b"/etc/passwd\0\0\0\0",
        b"history.csv0000",
    ] {
        let bytes = &mut checkpoint.results;
        let at = bytes.windows(name.len()).position(|it| it == name).unwrap();
        bytes[at..at + name.len()].copy_from_slice(other);
        assert!(OutputState::read(&mut bytes.as_slice()).is_ok());
        let _ = fs::remove_file(out.join("checkpoint.older.bin"));
        let _ = fs::remove_file(out.join("checkpoint.bin"));
        (checkpoint.write(&out, |it| it.put(&solution))).unwrap();
        let output = place.ligament(["resume", "out", "--set", "fracture.stop.bonds=2"]);
        assert_refused(&output, &["is no name of a file of a run"]);
        let bytes = &mut checkpoint.results;
        bytes[at..at + name.len()].copy_from_slice(name);
    }
    let draw = |picture: &str| {
        assert_success(&place.ligament(["plot", "out", "--out", picture]));
        fs::read(place.path(picture)).unwrap()
    };
    let before = draw("before.svg");
    let collection = fs::read_to_string(out.join("fields.pvd")).unwrap();
    let other = collection
        .replace("fields_0000.vtu", "../../evil0.vtu")
        .replace("fields_", "/etc/");
    fs::write(out.join("fields.pvd"), other).unwrap();
    assert_eq!(draw("after.svg"), before);
}

/// Names of groups, probes and values are names, not paths.
#[test]
fn names_in_cases_lead_nowhere() {
    let place = Place::new();
    let case = SMALL_BAR
        .replace("left = { left", "\"../../evil\" = { left")
        .replace("group = \"left\"", "group = \"../../evil\"");
    let probes = "[[probe]]\nname = \"../../evil\"\nat = [0.0, 0.0]\nfield = \"displacement.x\"\n\
                  [[probe]]\nname = \"/evil\"\nat = [0.0, 0.0]\nfield = \"displacement.x\"\n";
    fs::write(place.path("case.toml"), case + probes).unwrap();
    fs::create_dir_all(place.path("a/b")).unwrap();
    assert_success(&place.ligament(["run", "case.toml", "--out", "a/b/out"]));
    let long = "x/".repeat(400);
    let study = format!(
        "case = \"case.toml\"\n[[axis]]\nkey = \"title\"\n\
         values = [\"../../evil\", \"/evil\", \"..\", \"a\\u0000b\", \"CON\", \"{long}\"]\n\
         labels = [\"../../../evil\", \"/evil\", \"..\", \"nul\", \"CON\", \"{long}\"]\n"
    );
    fs::write(place.path("study.toml"), study).unwrap();
    assert_success(&place.ligament(["sweep", "study.toml", "--out", "a/b/study", "--quiet"]));
    for (folder, expected) in [
        ("", &["a", "case.toml", "study.toml"][..]),
        ("a", &["b"]),
        ("a/b", &["out", "study"]),
    ] {
        let entries = fs::read_dir(place.path(folder)).unwrap();
        let mut names: Vec<_> = entries.map(|it| it.unwrap().file_name()).collect();
        names.sort();
        assert_eq!(names, expected, "{folder}");
    }
    assert_eq!(
        fs::read_dir(place.path("a/b/study/runs")).unwrap().count(),
        6
    );
}

/// A file that is no case, mesh, table or result is refused without its text.
#[test]
fn texts_of_other_files_are_not_told() {
    let place = stopped();
    let temperature = format!("{SMALL_BAR}[[temperature]]\nfile = \"victim\"\n");
    fs::write(place.path("heated.toml"), temperature).unwrap();
    let lattice =
        &SMALL_BAR[SMALL_BAR.find("[lattice]").unwrap()..SMALL_BAR.find("[material]").unwrap()];
    let meshed = SMALL_BAR.replace(lattice, "[mesh]\nfile = \"victim\"\nthickness = 0.1\n");
    fs::write(place.path("meshed.toml"), meshed).unwrap();
    let study = "case = \"victim\"\n[[axis]]\nkey = \"title\"\nvalues = [\"a\"]\n";
    fs::write(place.path("study.toml"), study).unwrap();
    let refused = |arguments: &[&str]| {
        let output = place.ligament(arguments);
        let said = stdout(&output) + &stderr(&output);
        assert_eq!(output.status.code(), Some(1), "{said}");
        assert!(!said.contains("SECRETHASH"), "{said}");
    };
    for command in ["check", "run", "sweep", "inspect", "plot", "resume", "new"] {
        refused(&[command, "victim"]);
    }
    refused(&["explain", "victim", "--point", "5"]);
    refused(&["check", "heated.toml"]);
    refused(&["check", "meshed.toml"]);
    refused(&["sweep", "study.toml"]);
    for name in [
        "history.csv",
        "breaks.csv",
        "criteria.csv",
        "summary.json",
        "case.resolved.toml",
        "model.vtu",
        "checkpoint.bin",
    ] {
        let place = stopped();
        fs::copy(place.path("victim"), place.path("out").join(name)).unwrap();
        for arguments in [
            &["resume", "out", "--set", "fracture.stop.bonds=2"][..],
            &["plot", "out", "--out", "p.svg"],
            &["plot", "out", "--curve", "--out", "p.svg"],
            &["explain", "out", "--point", "5"],
        ] {
            let output = place.ligament(arguments);
            let said = stdout(&output) + &stderr(&output);
            assert!(!said.contains("SECRETHASH"), "{name}: {said}");
            assert!(
                matches!(output.status.code(), Some(0 | 1)),
                "{name}: {said}"
            );
        }
    }
}

/// Escape sequences in stored results are shown, not sent.
#[test]
fn escape_sequences_in_results_are_not_sent() {
    let escape = "\u{1b}]0;renamed\u{7}\u{9b}2J";
    let in_text = "\\u001b]0;renamed\\u0007\\u009b2J";
    let shown = |place: &Place, arguments: &[&str]| {
        let output = place.ligament(arguments);
        let said = stdout(&output) + &stderr(&output);
        // TOML has its own words for them.
        let is_shown = ["\\u{1b}", "\\u001B"].iter().any(|it| said.contains(it));
        assert!(is_shown, "{arguments:?} {said}");
        assert!(!said.contains(['\u{1b}', '\u{7}', '\u{9b}']), "{said:?}");
    };
    let resume = ["resume", "out", "--set", "fracture.stop.bonds=2"];
    // Titles of runs that go on, and of those that do not fit their checkpoint.
    let place = stopped();
    let resolved = place.path("out/case.resolved.toml");
    let case = fs::read_to_string(&resolved).unwrap();
    fs::write(&resolved, case.replace("Small bar", in_text)).unwrap();
    shown(&place, &resume);
    let place = stopped();
    let resolved = place.path("out/case.resolved.toml");
    let probe = format!(
        "{case}[[probe]]\nname = \"{in_text}\"\nat = [0.0, 0.0]\nfield = \"displacement.x\"\n"
    );
    fs::write(&resolved, probe).unwrap();
    shown(&place, &resume);
    // A checkpoint with messages and inputs of somebody else.
    let place = stopped();
    let (mut checkpoint, solution) = newest(&place.path("out"));
    checkpoint.messages = vec![Message::new("kind", escape).in_step(1)];
    let write = |checkpoint: &Checkpoint, place: &Place| {
        let written = checkpoint.write(&place.path("out"), |it| it.put(&solution));
        written.unwrap();
    };
    write(&checkpoint, &place);
    shown(&place, &resume);
    let place = stopped();
    checkpoint.version = escape.to_owned();
    for _ in 0..2 {
        write(&checkpoint, &place);
    }
    shown(&place, &resume);
    // Reasons of the end, names of criteria.
    let place = stopped();
    let summary = format!("{{\"termination_message\": \"{in_text}\"}}");
    fs::write(place.path("out/summary.json"), summary).unwrap();
    for name in ["checkpoint.bin", "checkpoint.older.bin"] {
        let _ = fs::remove_file(place.path("out").join(name));
    }
    shown(&place, &["resume", "out"]);
    let criteria = place.path("out/criteria.csv");
    let text = fs::read_to_string(&criteria).unwrap();
    fs::write(&criteria, text.replace("strength", escape)).unwrap();
    shown(&place, &["explain", "out", "--point", "5"]);
    let history = place.path("out/history.csv");
    let text = fs::read_to_string(&history).unwrap();
    fs::write(&history, text.replacen("reaction", escape, 1)).unwrap();
    shown(&place, &["plot", "out", "--curve", "--out", "p.svg"]);
}

/// Other programs are called without a shell: a path is one argument, whatever its characters, and no option.
#[test]
fn paths_are_one_argument_of_other_programs() {
    let place = Place::new();
    let program =
        "#!/bin/sh\nfor word in \"$@\"; do printf '%s\\n' \"$word\"; done >> words; exit 1\n";
    for name in ["gmsh", "python"] {
        fs::write(place.path(name), program).unwrap();
        let mode = std::os::unix::fs::PermissionsExt::from_mode(0o755);
        fs::set_permissions(place.path(name), mode).unwrap();
    }
    for name in [
        "a b'c\"d; touch executed; $(touch executed).geo",
        "-option.geo",
        "`touch executed`.geo",
    ] {
        fs::write(place.path(name), "Point(1) = {0, 0, 0};").unwrap();
        for call in [["--gmsh", "./gmsh"], ["--python", "./python"]] {
            let _ = fs::remove_file(place.path("words"));
            let mut command = place.command(["mesh", "--out", "a.msh"]);
            command.args(call);
            match call[0] {
                "--gmsh" => command.arg("--").arg(name),
                _ => command.arg(format!("--via-meshio={name}")),
            };
            let output = command.output().unwrap();
            assert_eq!(output.status.code(), Some(1), "{}", stderr(&output));
            let words = fs::read_to_string(place.path("words")).unwrap_or_default();
            let is_whole = |word: &str| word.ends_with(name) && !word.starts_with('-');
            assert!(
                words.lines().any(is_whole),
                "{name}: {words} {}",
                stderr(&output)
            );
        }
    }
    assert!(!place.path("executed").exists());
}
