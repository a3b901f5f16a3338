//! Single files that commands write: existing files, and paths that are no files.

use std::fs;
use std::io::Read;
use std::os::unix::fs::{FileTypeExt, PermissionsExt, symlink};
use std::process::Command;
use std::thread;

use super::{Place, assert_refused, stderr, stdout};
use crate::support::assert_success;

/// A program in place of Gmsh, which copies a ready mesh.
const GMSH: &str = "#!/bin/sh\ncp square.msh \"$4\"\n";

/// The square of one cell.
const SQUARE: &str = "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n4\n1 0 0 0\n2 1 0 0\n3 1 1 0\n4 0 1 0\n$EndNodes\n\
    $Elements\n1\n1 3 2 1 1 1 2 3 4\n$EndElements\n";

/// Commands that write a file which their user names, with what comes before the name.
const WRITERS: [&str; 11] = [
    "report out --out",
    "report out --output",
    "plot out --format svg --out",
    "plot --curve out --format pdf --out",
    "plot out --animate",
    "profile out --from 0,0 --to 0.1,0.05 --field damage --out",
    "schema --out",
    "completions bash --out",
    "new --lattice 10,10,0.01 --out",
    "explain out --point 30 --csv",
    "mesh plate.geo --gmsh ./gmsh --out",
];

/// A folder with results and the input files of the commands.
fn prepared() -> Place {
    let place = Place::new();
    place.run();
    fs::write(place.path("square.msh"), SQUARE).unwrap();
    fs::write(place.path("plate.geo"), "// a square").unwrap();
    fs::write(place.path("gmsh"), GMSH).unwrap();
    let executable = fs::Permissions::from_mode(0o755);
    fs::set_permissions(place.path("gmsh"), executable).unwrap();
    place
}

/// The words of a command with the name of its file.
fn words<'a>(writer: &'a str, file: &'a str) -> Vec<&'a str> {
    writer.split(' ').chain([file]).collect()
}

/// The name of a file that a command takes.
fn name_for(writer: &str) -> &'static str {
    match writer {
        _ if writer.contains("svg") => "there.svg",
        _ if writer.contains("pdf") => "there.pdf",
        _ if writer.contains("animate") => "there.gif",
        _ => "there",
    }
}

/// An existing file is kept without `--force`; a link is kept even with it.
#[test]
fn files_that_are_there_are_replaced_only_if_asked() {
    let place = prepared();
    for writer in WRITERS {
        let name = name_for(writer);
        let path = place.path(name);
        fs::write(&path, "mine").unwrap();
        let output = place.ligament(words(writer, name));
        assert_refused(&output, &[name, "exists already", "--force"]);
        assert_eq!(fs::read(&path).unwrap(), b"mine", "{writer}");

        let forced = words(writer, name).into_iter().chain(["--force"]);
        assert_success(&place.ligament(forced));
        let written = fs::read(&path).unwrap();
        assert!(written.len() > 100, "{writer}: {} bytes", written.len());

        fs::rename(&path, place.path("elsewhere")).unwrap();
        symlink("elsewhere", &path).unwrap();
        let forced = words(writer, name).into_iter().chain(["--force"]);
        assert_refused(&place.ligament(forced), &[name, "is a link"]);
        assert!(path.is_symlink(), "{writer}");
        assert_eq!(fs::read(place.path("elsewhere")).unwrap(), written);
        fs::remove_file(&path).unwrap();
    }
}

/// Data written to a pipe arrive at its other end, and the pipe still exists.
#[test]
fn pipes_are_written_to() {
    let place = prepared();
    let pipe = place.path("pipe");
    assert!(
        Command::new("mkfifo")
            .arg(&pipe)
            .status()
            .unwrap()
            .success()
    );
    for writer in WRITERS {
        let reader = thread::spawn({
            let pipe = pipe.clone();
            move || {
                let mut bytes = Vec::new();
                fs::File::open(pipe)
                    .unwrap()
                    .read_to_end(&mut bytes)
                    .unwrap();
                bytes
            }
        });
        // Not even where a file would have to be replaced.
        assert_success(&place.ligament(words(writer, "pipe")));
        let kind = fs::symlink_metadata(&pipe).unwrap().file_type();
        assert!(kind.is_fifo(), "{writer}: {kind:?}");
        assert!(reader.join().unwrap().len() > 100, "{writer}");
    }
}

/// Standard output receives the file and nothing else, wherever it leads; devices remain devices.
#[test]
fn standard_output_and_devices_are_written_to() {
    let place = prepared();
    for writer in WRITERS {
        // `explain` says so on standard output as well, unless the table is written there.
        let output = place.ligament(words(writer, "/dev/stdout"));
        assert_success(&output);
        assert!(output.stdout.len() > 100, "{writer}");
        assert!(!stdout_has_words(&output.stdout), "{writer}");
        assert_success(&place.ligament(words(writer, "/dev/null")));
        let kind = fs::symlink_metadata("/dev/null").unwrap().file_type();
        assert!(kind.is_char_device(), "{writer}");
    }
    // A shell opens a file for it, which then exists.
    let output = place.limited("exec > page.html", "report out --out /dev/stdout");
    assert_success(&output);
    let page = fs::read_to_string(place.path("page.html")).unwrap();
    assert!(page.starts_with("<!DOCTYPE html>") && page.trim_end().ends_with("</html>"));
    assert!(stderr(&output).contains("/dev/stdout ("));
    let output = place.ligament(["schema", "--out", "/dev/full"]);
    assert_refused(&output, &["/dev/full", "No space left on device"]);
}

/// `-` is standard output for a file, and no name for a folder; for a case that is not stored there is no advice.
#[test]
fn a_dash_is_standard_output() {
    let place = prepared();
    for writer in WRITERS {
        let output = place.ligament(words(writer, "-"));
        assert_success(&output);
        assert!(output.stdout.len() > 100, "{writer}");
        assert!(!stdout_has_words(&output.stdout), "{writer}");
        assert!(!place.path("-").exists(), "{writer}");
    }
    for command in ["run case.toml --out -", "check case.toml --out -"] {
        let output = place.ligament(command.split(' '));
        assert_eq!(output.status.code(), Some(2), "{command}");
        assert!(stderr(&output).contains("are a folder"), "{command}");
    }
    let new = |out: &str| {
        let output = place.ligament(["new", "--lattice", "8,8,0.01", "--out", out]);
        assert_success(&output);
        output
    };
    assert!(!stdout(&new("/dev/null")).contains("/dev/null\n  ligament run"));
    assert!(!stdout(&new("/dev/null")).contains("ligament check"));
    assert!(stdout(&new("-")).contains("[lattice]"));
}

/// Whether the messages follow the written file.
fn stdout_has_words(written: &[u8]) -> bool {
    let end = &written[written.len().saturating_sub(200)..];
    String::from_utf8_lossy(end).contains("/dev/stdout")
}

/// The program's own files in a folder of results are replaced without `--force`, but not through links.
#[test]
fn files_of_the_programs_own_are_made_anew() {
    let place = prepared();
    for (command, name) in [
        ("report out", "out/report.html"),
        ("plot out", "out/picture-damage.png"),
        ("crack out", "out/crack.csv"),
    ] {
        for _ in 0..2 {
            assert_success(&place.ligament(command.split(' ')));
        }
        fs::rename(place.path(name), place.path("elsewhere")).unwrap();
        let before = fs::read(place.path("elsewhere")).unwrap();
        symlink("../elsewhere", place.path(name)).unwrap();
        assert_refused(&place.ligament(command.split(' ')), &[name, "is a link"]);
        assert_eq!(fs::read(place.path("elsewhere")).unwrap(), before);
        fs::remove_file(place.path(name)).unwrap();
    }
    // The file for several results is in no result folder.
    let both = ["plot", "--curve", "out", "out"];
    assert_success(&place.ligament(both));
    assert_refused(&place.ligament(both), &["picture-curves.png", "--force"]);
    assert!(stdout(&place.ligament(["plot", "--curve", "out"])).contains("picture-curve.png"));
}

/// Unfinished files of a killed run are removed by the next one.
#[test]
fn unfinished_files_of_killed_runs_go() {
    let place = Place::new();
    let unfinished = |folder: &str| place.path(format!("{folder}/.fields_0001.vtu.4711.partial"));
    let others = |folder: &str| place.path(format!("{folder}/.notes.txt.4711.partial"));
    place.run();
    for path in [unfinished("out"), others("out")] {
        fs::write(path, "half").unwrap();
    }
    assert_success(&place.ligament(["run", "case.toml", "--out", "out", "--force"]));
    assert!(!unfinished("out").exists() && others("out").exists());
    fs::create_dir(place.path("new")).unwrap();
    fs::write(unfinished("new"), "half").unwrap();
    let stop = ["--set", "fracture.stop.bonds=2"];
    let run = ["run", "case.toml", "--out", "new"];
    assert_success(&place.ligament([&run[..], &stop[..]].concat()));
    assert!(!unfinished("new").exists());
    for made in [
        "report new",
        "run case.toml --out new --force --set fracture.stop.bonds=2",
    ] {
        let page = place.path("new/.report.html.4711.partial");
        fs::write(&page, "half").unwrap();
        assert_success(&place.ligament(made.split(' ')));
        assert!(!page.exists(), "{made}");
    }
    assert!(place.path("new/report.html").exists());
    fs::write(unfinished("new"), "half").unwrap();
    assert_success(&place.ligament(["resume", "new", "--set", "fracture.stop.bonds=3"]));
    assert!(!unfinished("new").exists());
}
