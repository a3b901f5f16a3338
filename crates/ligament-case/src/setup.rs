//! From a case file to the setup of a computation, with what other files hold.

use std::sync::Arc;

use ligament::body::{Body, LatticeBody, LatticeError, MeshBody, SolidLatticeBody, SolidMeshBody};
use ligament::setup::{Setup, TemperatureChange};
use ligament::stage::{StageWatcher, stage};
use ligament_mesh::AnyMesh;

use crate::case::key_path::KeyPath;
use crate::case::{CaseError, CaseFile, LatticeSection, SolidLatticeSection};
use crate::mesh_file::{read_any_mesh, read_mesh};
use crate::temperature_table;

impl CaseFile {
    /// The setup of the case on its solid body, with the mesh and the tables that it names read from their files.
    ///
    /// # Errors
    ///
    /// If a file cannot be read, or the mesh is not one of solid cells.
    pub fn setup_in_space(&self, watcher: &mut dyn StageWatcher) -> anyhow::Result<Setup<3>> {
        let body: Arc<dyn Body<3>> = match (&self.case.mesh, &self.case.solid_lattice) {
            (Some(section), _) => {
                let mesh = stage(watcher, "read mesh", || read_any_mesh(&section.file))?;
                let AnyMesh::Solid(mesh) = mesh else {
                    let reason = "the geometry has volumes, and the mesh has no solid cells: mesh the volumes too (`gmsh -3`)";
                    return Err(self.error("mesh.file", reason).into());
                };
                Arc::new(SolidMeshBody::from(mesh))
            }
            (None, Some(section)) => {
                Arc::new(stage(watcher, "lattice", || self.solid_lattice(section))?)
            }
            (None, None) => anyhow::bail!("the case has no body"),
        };
        Ok(self.setup_on(body)?)
    }

    /// The setup of the case in the plane, with its body and the tables that it names read from their files.
    ///
    /// # Errors
    ///
    /// If a file cannot be read, nothing is left of the lattice or of one of its sets, or the body is solid.
    pub fn setup(&self, watcher: &mut dyn StageWatcher) -> anyhow::Result<Setup> {
        let body: Arc<dyn Body> = match (&self.case.mesh, &self.case.lattice) {
            _ if self.case.is_solid() => {
                let key = match self.case.mesh {
                    Some(_) => "mesh.file",
                    None => "solid_lattice",
                };
                let reason = "the body is a solid, and what is asked for is known of bodies in the plane alone";
                return Err(self.error(key, reason).into());
            }
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
    pub fn setup_on<const D: usize>(&self, body: Arc<dyn Body<D>>) -> Result<Setup<D>, CaseError> {
        let setup = self.case.setup_on(body);
        self.with_tables(setup.map_err(|fault| self.source.error(fault))?)
    }

    /// A setup with the tables of temperatures that the case names.
    fn with_tables<const D: usize>(&self, mut setup: Setup<D>) -> Result<Setup<D>, CaseError> {
        for (index, section) in self.case.temperatures.iter().enumerate() {
            if let Some(file) = &section.file {
                let rows = temperature_table::rows_of::<D>(file);
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
        body.map_err(|error| self.no_lattice("lattice", LatticeSection::set_key, error))
    }

    fn solid_lattice(&self, section: &SolidLatticeSection) -> Result<SolidLatticeBody, CaseError> {
        let key = KeyPath::default().child("solid_lattice");
        let parts = section.parts(&key);
        let (holes, sets) = parts.map_err(|fault| self.source.error(fault))?;
        let (spacing, corner) = (section.spacing, section.corner);
        let body = SolidLatticeBody::new(section.cells, spacing, corner, &holes, &sets);
        body.map_err(|error| self.no_lattice("solid_lattice", SolidLatticeSection::set_key, error))
    }

    /// The error of a lattice section that makes no body, at the key that it comes from.
    fn no_lattice(
        &self,
        section: &str,
        set_key: fn(&str) -> String,
        error: LatticeError,
    ) -> CaseError {
        let key = match &error {
            LatticeError::NothingLeft { .. } => format!("{section}.remove"),
            LatticeError::EmptySet { name } => set_key(name),
            LatticeError::NoRim { hole } => format!("{section}.remove.{hole}"),
        };
        self.error(&key, error.to_string())
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
