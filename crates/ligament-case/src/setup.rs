//! From a case file to the setup of a computation, with what other files hold.

use std::sync::Arc;

use ligament::body::{Body, LatticeBody, LatticeError, MeshBody};
use ligament::setup::{Setup, TemperatureChange};
use ligament::stage::{StageWatcher, stage};

use crate::case::key_path::KeyPath;
use crate::case::{CaseError, CaseFile, LatticeSection};
use crate::mesh_file::read_mesh;
use crate::temperature_table;

impl CaseFile {
    /// The setup of the case, with its body and the tables that it names read from their files.
    ///
    /// # Errors
    ///
    /// If a file cannot be read, or nothing is left of the lattice or of one of its sets.
    pub fn setup(&self, watcher: &mut dyn StageWatcher) -> anyhow::Result<Setup> {
        let body: Arc<dyn Body> = match (&self.case.mesh, &self.case.lattice) {
            (Some(section), _) => {
                let mesh = stage(watcher, "read mesh", || read_mesh(&section.file))?;
                Arc::new(MeshBody::from(mesh))
            }
            (None, Some(section)) => Arc::new(stage(watcher, "lattice", || self.lattice(section))?),
            (None, None) => anyhow::bail!("the case has no body"),
        };
        Ok(self.setup_on(body)?)
    }

    /// The setup of the case on a body that is there already, whatever body the case names.
    ///
    /// # Errors
    ///
    /// If a table of temperatures cannot be read.
    pub fn setup_on(&self, body: Arc<dyn Body>) -> Result<Setup, CaseError> {
        let setup = self.case.in_plane(body);
        let mut setup = setup.map_err(|fault| self.source.error(fault))?;
        for (index, section) in self.case.temperatures.iter().enumerate() {
            if let Some(file) = &section.file {
                let rows = temperature_table::rows_of(file);
                let rows = rows
                    .map_err(|reason| self.error(&format!("temperature.{index}.file"), reason))?;
                let samples = rows.into_iter().map(|(_, sample)| sample);
                setup.temperatures[index].change = TemperatureChange::Table(samples.collect());
            }
        }
        Ok(setup)
    }

    fn lattice(&self, section: &LatticeSection) -> Result<LatticeBody, CaseError> {
        let key = KeyPath::default().child("lattice");
        let parts = section.parts(&key);
        let (holes, sets) = parts.map_err(|fault| self.source.error(fault))?;
        let (spacing, corner) = (section.spacing.0, section.corner);
        let body = LatticeBody::new(section.cells, spacing, corner, &holes, &sets);
        body.map_err(|error| {
            let key = match &error {
                LatticeError::NothingLeft { .. } => "lattice.remove".to_owned(),
                LatticeError::EmptySet { name } => LatticeSection::set_key(name),
                LatticeError::NoRim { hole } => format!("lattice.remove.{hole}"),
            };
            self.error(&key, error.to_string())
        })
    }

    /// Number of threads that the case asks for, if it does.
    pub fn threads(&self) -> Option<usize> {
        self.case.solver.threads.map(|threads| threads as usize)
    }

    /// The error of a computation, with a faulty field of the setup at the key that it comes from.
    pub fn explained(&self, error: ligament::Error) -> anyhow::Error {
        match error {
            ligament::Error::Setup(error) => self.located(error).into(),
            other => other.into(),
        }
    }
}
