//! Files that a user writes, or another program: meshes, cases, studies.

use std::path::Path;

use ligament_case::case::CaseFile;
use ligament_cli::inspect::write_summary;
use ligament_mesh::{AnyMesh, gmsh};
use ligament_study::sweep::plan;
use ligament_study::sweep::study::Study;
use verification::repository;

use crate::{Target, files};

/// Meshes of Gmsh in all formats.
pub(crate) struct Meshes;

impl Target for Meshes {
    fn name(&self) -> &'static str {
        "mesh"
    }

    fn seeds(&self) -> Vec<Vec<u8>> {
        let mut seeds = files(
            &repository().join("crates/ligament-mesh/tests/data"),
            ".msh",
        );
        seeds.push(std::fs::read(repository().join("tests/reference/square.msh")).unwrap());
        seeds
    }

    fn words(&self) -> &'static [&'static str] {
        &[
            "$Nodes\n",
            "$EndNodes\n",
            "$Elements\n",
            "$Entities\n",
            "$PhysicalNames\n",
            "$Periodic\n",
            "$NodeData\n",
            "$EndNodeData\n",
            "$PartitionedEntities\n",
            "$MeshFormat\n4.1 0 8\n",
            "$MeshFormat\n2.2 1 8\n\u{1}\0\0\0",
        ]
    }

    /// What is read is written and read back to the same body.
    fn read(&mut self, input: &[u8]) -> bool {
        let Ok(mesh) = gmsh::parse_any(input) else {
            return false;
        };
        write_summary(&mut Vec::new(), Path::new("a.msh"), &mesh).unwrap();
        let text = match &mesh {
            AnyMesh::Plane(mesh) => gmsh::write(mesh),
            AnyMesh::Solid(mesh) => gmsh::write(mesh),
        };
        let again = gmsh::parse_any(text.as_bytes()).unwrap();
        assert_eq!(again.n_nodes(), mesh.n_nodes());
        true
    }
}

/// Case files.
pub(crate) struct Cases;

/// All cases of the repository.
fn cases() -> Vec<Vec<u8>> {
    let mut seeds = files(
        &repository().join("crates/ligament-case/tests/data"),
        ".toml",
    );
    let folders = std::fs::read_dir(repository().join("cases")).unwrap();
    let mut folders: Vec<_> = folders.map(|entry| entry.unwrap().path()).collect();
    folders.sort();
    seeds.extend(folders.iter().flat_map(|folder| files(folder, "case.toml")));
    seeds
}

impl Target for Cases {
    fn name(&self) -> &'static str {
        "case"
    }

    fn seeds(&self) -> Vec<Vec<u8>> {
        cases()
    }

    fn words(&self) -> &'static [&'static str] {
        &[
            "[fracture]\n",
            "[[load]]\n",
            "[[material]]\n",
            "[[precrack]]\n",
            "[modal]\n",
            "[solver]\n",
            "[[temperature]]\n",
            "law = \"mbb-pd\"\n",
            "law = \"orthotropic\"\n",
            "control = \"event\"\n",
            "[]",
            "{}",
            "\"\"",
            "\"\\u001b\"",
            "true",
        ]
    }

    /// What is read is resolved and read again.
    fn read(&mut self, input: &[u8]) -> bool {
        let path = Path::new("case.toml");
        let text = String::from_utf8_lossy(input).into_owned();
        match CaseFile::parse(path, text, &[]) {
            Ok(case) => {
                let resolved = case.resolved_toml().unwrap();
                CaseFile::parse(path, resolved, &[]).unwrap();
                true
            }
            Err(error) => {
                assert!(!error.to_string().is_empty());
                false
            }
        }
    }
}

/// Study files, with a case beside them.
pub(crate) struct Studies {
    folder: tempfile::TempDir,
}

/// Runs of a study that are still planned: each takes as long as a case.
const MOST_RUNS: usize = 50;

impl Studies {
    pub(crate) fn new() -> Self {
        let folder = tempfile::tempdir().unwrap();
        let data = repository().join("crates/ligament-case/tests/data");
        std::fs::copy(
            data.join("lattice-plate.toml"),
            folder.path().join("case.toml"),
        )
        .unwrap();
        Self { folder }
    }
}

impl Target for Studies {
    fn name(&self) -> &'static str {
        "study"
    }

    fn seeds(&self) -> Vec<Vec<u8>> {
        let mut seeds = vec![
            b"title = \"Plates\"\ncase = \"case.toml\"\n[[axis]]\nkey = \"model.horizon_factor\"\nrange = { from = 2.0, to = 4.0, \
              step = 0.5 }\n[[axis]]\nkey = \"material.young\"\nvalues = [1e9, 2e9]\nlabels = [\"soft\", \"stiff\"]\n[[result]]\n\
              name = \"ratio\"\nof = \"first_peak.reaction\"\nover = 3.0\n[[plot]]\nx = \"model.horizon_factor\"\n\
              y = \"ratio\"\nby = \"material.young\"\nline = { slope = 0.375, intercept = -0.125 }\nfit = { from = 2.0, to = 4.0 }\n"
                .to_vec(),
            b"case = \"case.toml\"\n[[axis]]\nkey = \"model.horizon_factor\"\nvalues = [2.5, 3]\n[set]\n\"solver.threads\" = 1\n".to_vec(),
        ];
        for name in [
            "horizon-study",
            "mesh-scatter",
            "slotted-disk",
            "strength-scatter",
        ] {
            seeds.extend(files(&repository().join("cases").join(name), "study.toml"));
        }
        seeds
    }

    fn words(&self) -> &'static [&'static str] {
        &[
            "[[axis]]\n",
            "[[plot]]\n",
            "[[result]]\n",
            "[set]\n",
            "geometry = \"a.geo\"\n",
            "[]",
            "{}",
            "\"\"",
        ]
    }

    fn read(&mut self, input: &[u8]) -> bool {
        let path = self.folder.path().join("study.toml");
        std::fs::write(&path, input).unwrap();
        let Ok(study) = Study::load(&path) else {
            return false;
        };
        let sizes = study.axes.iter().map(|axis| axis.points.len());
        sizes.fold(1, usize::saturating_mul) > MOST_RUNS
            || plan::runs(&study, self.folder.path()).is_ok()
    }
}
