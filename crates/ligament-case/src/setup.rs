//! The setup of a computation from a case file and the files that it names.

use std::sync::Arc;

use ligament::body::AnyBody;
use ligament::processes::partition_communicator;
use ligament::setup::Setup;
use ligament::stage::{StageWatcher, stage};
use ligament_analysis::SetupError;
use ligament_analysis::distributed_matrix::{MatrixCommunicator, Processes, SingleProcess};
use ligament_mesh::AnyMesh;

use crate::case::keys::check_dimensions;
use crate::case::{CaseError, CaseFile};
use crate::mesh_file::{MeshFileError, read_any_mesh, read_mesh};
use crate::point_table::{self, Tables};

impl CaseFile {
    /// The setup of the case, with its mesh and tables read from their files.
    ///
    /// # Errors
    ///
    /// If a file cannot be read, the mesh has no cells of the kind of the body, or no cell remains of a lattice or of one of its sets.
    pub fn setup(&self, watcher: &mut dyn StageWatcher) -> anyhow::Result<Setup> {
        self.setup_on_processes(Arc::new(SingleProcess), watcher)
    }

    /// The setup of the case on each of several processes. The first one alone reads a mesh; the others have its nodes, and its cells only where
    /// the body is not divided between processes. Collective.
    ///
    /// # Errors
    ///
    /// As for [`setup`](Self::setup); other processes refuse a mesh that the first one cannot read.
    pub fn setup_on_processes(
        &self,
        communicator: Arc<dyn MatrixCommunicator>,
        watcher: &mut dyn StageWatcher,
    ) -> anyhow::Result<Setup> {
        let body = self.read_body_on_first(&*communicator, watcher)?;
        let mut setup = self.setup_on(body)?;
        setup.solver.communicator = Processes(communicator);
        if setup.body.n_cells() == 0 && partition_communicator(&setup).size() == 1 {
            setup.body = self.read_body(watcher)?;
        }
        Ok(setup)
    }

    /// The body of the case; other processes than the first have only the nodes of a mesh.
    fn read_body_on_first(
        &self,
        communicator: &dyn MatrixCommunicator,
        watcher: &mut dyn StageWatcher,
    ) -> anyhow::Result<AnyBody> {
        let mesh = self.case.mesh.as_ref();
        let is_mesh = mesh.is_some_and(|it| !point_table::is_table(&it.file));
        if !is_mesh || communicator.size() == 1 {
            return self.read_body(watcher);
        }
        let (read, error) = match communicator.is_root().then(|| self.read_body(watcher)) {
            Some(Ok(body)) => (Some(body), None),
            Some(Err(error)) => (None, Some(error)),
            None => (None, None),
        };
        let body = AnyBody::of_first(communicator, read)?;
        let refused = || error.unwrap_or_else(|| MeshFileError::OfFirstProcess.into());
        body.ok_or_else(refused)
    }

    /// Refuses a case whose body is a solid.
    ///
    /// # Errors
    ///
    /// If the body is a solid.
    pub fn require_plane(&self) -> Result<(), CaseError> {
        if !self.case.is_solid() {
            return Ok(());
        }
        let key = match self.case.mesh {
            Some(_) => "mesh.file",
            None => "solid_lattice",
        };
        let reason = "the body is a solid, and this is available only for bodies in the plane";
        Err(self.error(key, reason))
    }

    /// The body of the case, with the mesh or the points read from their file.
    ///
    /// # Errors
    ///
    /// As for [`setup`](Self::setup).
    pub fn read_body(&self, watcher: &mut dyn StageWatcher) -> anyhow::Result<AnyBody> {
        let case = &self.case;
        match (&case.mesh, &case.lattice, &case.solid_lattice) {
            (Some(section), _, _) if point_table::is_table(&section.file) => {
                let body = stage(watcher, "read points", || point_table::body(&section.file));
                body.map_err(|reason| self.error("mesh.file", reason).into())
            }
            (Some(section), _, _) if section.is_solid => {
                let mesh = stage(watcher, "read mesh", || {
                    read_any_mesh(&section.file, section.coordinate_plane())
                })?;
                let AnyMesh::Solid(_) = mesh else {
                    let reason = "the geometry has volumes, and the mesh has no solid cells: mesh the volumes too (`gmsh -3`)";
                    return Err(self.error("mesh.file", reason).into());
                };
                Ok(section.scaled(mesh).into())
            }
            (Some(section), _, _) => {
                let mesh = stage(watcher, "read mesh", || {
                    read_mesh(&section.file, section.coordinate_plane())
                })?;
                Ok(section.scaled(AnyMesh::Plane(mesh)).into())
            }
            (None, Some(section), _) => {
                let body = stage(watcher, "lattice", || section.grid().body());
                Ok(AnyBody::from(body.map_err(|it| self.source.error(it))?))
            }
            (None, None, Some(section)) => {
                let body = stage(watcher, "lattice", || section.grid().body());
                Ok(AnyBody::from(body.map_err(|it| self.source.error(it))?))
            }
            (None, None, None) => anyhow::bail!("the case has no body"),
        }
    }

    /// The setup of the case on a given body instead of the body of the case.
    ///
    /// # Errors
    ///
    /// If a table of temperatures or of factors or an amplitude of a load cannot be read.
    pub fn setup_on(&self, body: AnyBody) -> Result<Setup, CaseError> {
        let dimensions = body.dimensions();
        let setup = self.case.setup_on(body, Tables::Read { dimensions });
        let setup = setup.and_then(|it| check_dimensions(&self.source.document, it));
        setup.map_err(|fault| self.source.error(fault))
    }

    /// Number of threads of the case, if given.
    pub fn threads(&self) -> Option<usize> {
        self.case.solver.threads.map(|threads| threads as usize)
    }

    /// The error of a computation in the terms of the case: a faulty field of the setup at the responsible key.
    pub fn error_in_case_terms(&self, error: ligament::Error) -> anyhow::Error {
        match error {
            ligament::Error::Setup(error) => self.error_at_key(error).into(),
            ligament::Error::Equations(SetupError::NothingResists) => {
                anyhow::anyhow!("{error} ([[support]])")
            }
            other => other.into(),
        }
    }
}
