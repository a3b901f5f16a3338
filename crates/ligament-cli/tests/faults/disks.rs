//! Disks that are full, or that cannot be written to: small ones in memory, in a namespace of their own where the system allows
//! it. Existing files are kept, the program names the file and gives advice, and the work can be continued later.

use super::*;
use std::process::Stdio;

use ligament_output::checkpoint::Checkpoint;

/// Tables and fields that are equal to the last byte in two runs of a case.
const SAME: [&str; 5] = [
    "breaks.csv",
    "criteria.csv",
    "history.csv",
    "iterations.csv",
    "model.vtu",
];

/// More points, whose results do not fit on the small disks, and checkpoints at every moment.
const LARGE: &str = "--set lattice.cells=[40,20] --set fracture.steps=30 --set load.0.displacement.x=2e-3 \
    --set fracture.stop={bonds=60} --set fracture.bonds_per_iteration=4";

/// Runs a script in a shell with a disk of a number of bytes at `disk`, which is removed afterwards. `$run` is the program with the large
/// case, `$L` the program alone; `grow` gives the disk more room. False where the system does not permit this.
fn with_disk(place: &Place, bytes: usize, script: &str) -> bool {
    let mount = format!("mkdir disk && mount -t tmpfs -o size={bytes} none disk");
    let in_namespace = |script: String| {
        let mut command = Command::new("unshare");
        command.args(["-rm", "sh", "-c", &script]);
        command.current_dir(place.folder.path());
        command.stdout(Stdio::null()).stderr(Stdio::null());
        command.status().is_ok_and(|it| it.success())
    };
    if !in_namespace(format!(
        "{mount}; code=$?; umount disk; rmdir disk; exit $code"
    )) {
        eprintln!("not run: this system lets no disk be mounted (`unshare -rm`, `mount -t tmpfs`)");
        return false;
    }
    let program = env!("CARGO_BIN_EXE_ligament");
    let names = format!(
        "L={program}; run=\"$L run case.toml {LARGE} --quiet\"; grow() {{ mount -o remount,size=60m disk; }}"
    );
    assert!(in_namespace(format!("set -e; {mount}; {names}; {script}")));
    true
}

/// Messages of a command that a script ran with `2>NAME; echo $? >NAME.code || true`, and its exit code.
fn said(place: &Place, name: &str) -> (String, String) {
    let text = |name: &str| fs::read_to_string(place.path(name)).unwrap();
    let code = text(&format!("{name}.code")).trim().to_owned();
    (text(name), code)
}

/// A command of a script failed with exit code 1 and these words, and without a panic.
fn assert_failed(place: &Place, name: &str, words: &[&str]) {
    let (said, code) = said(place, name);
    assert_eq!(code, "1", "{said}");
    assert!(!said.contains("panicked"), "{said}");
    for word in words {
        assert!(said.contains(word), "{word}: {said}");
    }
}

fn assert_ended_well(place: &Place, name: &str) {
    let (said, code) = said(place, name);
    assert_eq!(code, "0", "{said}");
}

fn assert_same_results(place: &Place, one: &str, other: &str) {
    for name in SAME {
        let [one, other] = [one, other].map(|it| fs::read(place.path(it).join(name)).ok());
        assert!(one == other, "{name}");
    }
    let names = |folder: &str| -> Vec<String> {
        place.contents(folder).into_iter().map(|it| it.0).collect()
    };
    assert_eq!(names(one), names(other));
}

/// Runs the large case where there is room, into `whole`.
fn run_whole(place: &Place, more: &str) {
    let output = place.limited(
        "true",
        &format!("run case.toml {LARGE} --out whole --quiet {more}"),
    );
    assert_success(&output);
}

/// Bytes of the files of a folder whose names satisfy a condition, in pages of the disk.
fn size(place: &Place, folder: &str, is_meant: impl Fn(&str) -> bool) -> usize {
    let files = place.contents(folder).into_iter();
    let sizes = files
        .filter(|(name, _)| is_meant(name))
        .map(|(_, it)| it.len().next_multiple_of(4096));
    sizes.sum()
}

const ON: &str = "--set output.fields_every=1 --set output.checkpoint_every=1e-6";

#[test]
fn a_disk_that_is_full_of_results() {
    let place = Place::new();
    run_whole(&place, ON);
    let all = size(&place, "whole", |_| true);
    let script = format!(
        "if $run --out disk/out {ON} 2>full; then echo 0 >full.code; else echo $? >full.code; fi
         if $L resume disk/out --quiet 2>again; then echo 0 >again.code; else echo $? >again.code; fi
         cp -r disk/out full-disk; grow
         if $L resume disk/out --quiet 2>later; then echo 0 >later.code; else echo $? >later.code; fi
         cp -r disk/out out"
    );
    // Room for some states; and for the first files alone.
    if !with_disk(&place, all * 2 / 3, &script) {
        return;
    }
    let words = [
        "cannot write disk/out/",
        "free space on its disk",
        "No space left",
        "ligament resume disk/out",
    ];
    assert_failed(&place, "full", &words);
    assert_failed(&place, "again", &["free space on its disk"]);
    assert!(!place.path("full-disk/summary.json").exists());
    assert_ended_well(&place, "later");
    assert_same_results(&place, "whole", "out");
}

#[test]
fn a_disk_without_room_for_the_first_files() {
    let place = Place::new();
    let script = format!(
        "if $run --out disk/out {ON} 2>full; then echo 0 >full.code; else echo $? >full.code; fi; grow
         if $L resume disk/out --quiet 2>later; then echo 0 >later.code; else echo $? >later.code; fi
         cp -r disk/out out"
    );
    if with_disk(&place, 24 * 1024, &script) {
        assert_failed(
            &place,
            "full",
            &["cannot write disk/out/", "free space on its disk"],
        );
        assert_ended_well(&place, "later");
        run_whole(&place, ON);
        assert_same_results(&place, "whole", "out");
    }
}

/// The third checkpoint does not fit beside the two that are there, which stay.
#[test]
fn a_disk_that_is_full_of_checkpoints() {
    let place = Place::new();
    let settings = "--set output.checkpoint_every=1e-6 --set output.model=false";
    run_whole(&place, settings);
    let two = size(&place, "whole", |name| name.starts_with("checkpoint"));
    let is_early = |name: &str| {
        name.ends_with(".csv") || name == "case.resolved.toml" || name == "fields_0000.vtu"
    };
    let rest = size(&place, "whole", is_early) + 4096;
    let script = format!(
        "if $run --out disk/out {settings} 2>full; then echo 0 >full.code; else echo $? >full.code; fi
         cp -r disk/out full-disk; grow
         if $L resume disk/out 2>later; then echo 0 >later.code; else echo $? >later.code; fi
         cp -r disk/out out"
    );
    if with_disk(&place, rest + two * 5 / 4, &script) {
        let words = [
            "cannot write disk/out/checkpoint.bin: free space on its disk",
            "ligament resume disk/out",
        ];
        assert_failed(&place, "full", &words);
        for name in ["checkpoint.bin", "checkpoint.older.bin"] {
            let bytes = fs::read(place.path("full-disk").join(name)).unwrap();
            Checkpoint::parse(bytes.as_slice(), bytes.len() as u64).unwrap();
        }
        assert_ended_well(&place, "later");
        let (said, _) = said(&place, "later");
        assert!(
            said.contains("resuming at load factor") && !said.contains("checkpoint before"),
            "{said}"
        );
        assert_same_results(&place, "whole", "out");
    }
}

#[test]
fn a_disk_that_is_full_of_earlier_results() {
    let place = Place::new();
    run_whole(&place, ON);
    place.run();
    let earlier = place.contents("out");
    let room = size(&place, "whole", |_| true) / 2 + size(&place, "out", |_| true);
    let script = format!(
        "cp -r out disk/out
         if $run --out disk/out {ON} --force 2>full; then echo 0 >full.code; else echo $? >full.code; fi
         cp -r disk/out full-disk; grow
         if $L resume disk/out --quiet 2>later; then echo 0 >later.code; else echo $? >later.code; fi
         cp -r disk/out new; ls disk >left"
    );
    if with_disk(&place, room, &script) {
        let words = [
            "disk/out has the earlier results",
            "cannot write disk/out.new/",
            "free space on its disk",
            "ligament resume disk/out.new",
        ];
        assert_failed(&place, "full", &words);
        assert_eq!(place.contents("full-disk"), earlier);
        assert_ended_well(&place, "later");
        assert_same_results(&place, "whole", "new");
        assert_eq!(fs::read_to_string(place.path("left")).unwrap(), "out\n");
    }
}

#[test]
fn a_disk_that_is_full_of_a_sweep() {
    let place = Place::new();
    let study = "case = \"case.toml\"\n[[axis]]\nkey = \"model.horizon_factor\"\nvalues = [2.2, 2.4, 2.6, 2.8]\n";
    fs::write(place.path("study.toml"), study).unwrap();
    let sweep = ["sweep", "study.toml", "--out", "whole", "--quiet"];
    assert_success(&place.ligament(sweep));
    let first = "whole/runs/horizon_factor=2.2";
    let of_one = size(&place, first, |_| true);
    let script = "if $L sweep study.toml --out disk/out --jobs 1 --quiet 2>full >table; then echo 0 >full.code; else echo $? >full.code; fi
         cp -r disk/out full-disk; grow
         if $L sweep study.toml --out disk/out --quiet 2>later >>table; then echo 0 >later.code; else echo $? >later.code; fi
         cp -r disk/out out";
    // Room for one run and a half, and the files of the study.
    if with_disk(&place, of_one * 3 / 2 + 40_000, script) {
        assert_failed(&place, "full", &["No space left on device"]);
        let done = |folder: &str| {
            fs::read(
                place
                    .path(folder)
                    .join("runs/horizon_factor=2.2/history.csv"),
            )
            .unwrap()
        };
        assert_eq!(done("full-disk"), done("whole"));
        assert_ended_well(&place, "later");
        for factor in ["2.2", "2.4", "2.6", "2.8"] {
            let run = format!("runs/horizon_factor={factor}");
            assert_same_results(&place, &format!("whole/{run}"), &format!("out/{run}"));
        }
    }
}

/// The administrator may write to any folder, but not to a disk that is mounted read-only.
#[test]
fn a_disk_that_cannot_be_written_to() {
    let place = Place::new();
    place.run();
    let script = "cp -r out disk/out; cp case.toml disk; mount -o remount,ro disk
         if $L run case.toml --out disk/new 2>new; then echo 0 >new.code; else echo $? >new.code; fi
         if $L run case.toml --out disk/out --force 2>forced; then echo 0 >forced.code; else echo $? >forced.code; fi
         if $L resume disk/out 2>resumed; then echo 0 >resumed.code; else echo $? >resumed.code; fi
         if $L explain disk/out --point 5 2>read; then echo 0 >read.code; else echo $? >read.code; fi
         cp -r disk/out after";
    if with_disk(&place, 4_000_000, script) {
        let words = ["its disk cannot be written to; choose a folder on another one"];
        assert_failed(&place, "new", &["cannot create disk/new", words[0]]);
        assert_failed(&place, "forced", &words);
        assert_failed(&place, "resumed", &words);
        assert_ended_well(&place, "read");
        assert_eq!(place.contents("after"), place.contents("out"));
    }
}
