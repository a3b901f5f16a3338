//! What a stopped run goes on from.

use std::fs;
use std::sync::atomic::{AtomicUsize, Ordering};

use ligament_analysis::Message;
use ligament_output::checkpoint::Checkpoint;
use ligament_output::summary::Build;
use ligament_run::progress::ProgressMode;
use ligament_run::resume;
use ligament_run::run;

use crate::Target;
use crate::folder::Folder;
use crate::results::small_bar;

/// Checkpoints.
pub(crate) struct Checkpoints {
    seed: Vec<u8>,
}

impl Checkpoints {
    pub(crate) fn new() -> Self {
        let folder = tempfile::tempdir().unwrap();
        let checkpoint = Checkpoint {
            version: env!("CARGO_PKG_VERSION").to_owned(),
            inputs: "lattice.cells = [8, 4]".to_owned(),
            results: vec![7; 90],
            messages: vec![Message::new("parts-detached", "3 points came loose")],
        };
        let solution: Vec<u8> = (0..=255).collect();
        (checkpoint.write(folder.path(), |out| out.put(&solution))).unwrap();
        let seed = fs::read(folder.path().join("checkpoint.bin")).unwrap();
        Self { seed }
    }
}

impl Target for Checkpoints {
    fn name(&self) -> &'static str {
        "checkpoint"
    }

    fn seeds(&self) -> Vec<Vec<u8>> {
        vec![self.seed.clone()]
    }

    fn read(&mut self, input: &[u8]) -> bool {
        Checkpoint::parse(input, input.len() as u64).is_ok()
    }
}

/// The folder of a run that was stopped, one file of which is another.
pub(crate) struct Stopped {
    _beside: tempfile::TempDir,
    folder: Folder,
}

impl Stopped {
    pub(crate) fn new() -> Self {
        let beside = tempfile::tempdir().unwrap();
        let case = small_bar(beside.path());
        let out = beside.path().join("out");
        let asked = AtomicUsize::new(0);
        let request = run::Request {
            is_stopped: &|| asked.fetch_add(1, Ordering::Relaxed) > 2,
            ..run::Request::new(&case, &out, Build::default())
        };
        assert!(request.run(ProgressMode::Quiet).unwrap().is_stopped());
        Self {
            _beside: beside,
            folder: Folder::read(out),
        }
    }
}

impl Target for Stopped {
    fn name(&self) -> &'static str {
        "stopped"
    }

    fn seeds(&self) -> Vec<Vec<u8>> {
        self.folder.seeds(|name| !name.ends_with(".vtu"))
    }

    fn words(&self) -> &'static [&'static str] {
        &[
            ",",
            "\n",
            "nan",
            "bonds = 3\n",
            "steps = [0.5, 1.5]\n",
            "</VTKFile>",
        ]
    }

    fn read(&mut self, input: &[u8]) -> bool {
        let request = resume::Request {
            folder: self.folder.path(),
            mesh: None,
            settings: &[],
            threads: Some(1),
            build: Build::default(),
            communicator: std::sync::Arc::new(ligament_analysis::distributed_matrix::SingleProcess),
            is_stopped: &|| false,
        };
        self.folder.make(input) && request.resume(ProgressMode::Quiet).is_ok()
    }
}
