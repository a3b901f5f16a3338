//! All result files of a run, written during the run.
//!
//! | file | holds |
//! |---|---|
//! | `history.csv` | one row per load step, or event of the exact path |
//! | `iterations.csv` | one row per Newton-Raphson iteration |
//! | `breaks.csv` | one row per broken bond, in the order of breaking |
//! | `softening.csv` | one row when a bond begins to soften, and one when its force falls below each of three shares; only where bonds soften |
//! | `criteria.csv` | one row per failure criterion: its measure and its law after the limit |
//! | `model.vtu` | points and bonds at the start, limits of the bonds; at the end their largest utilisations and dissipated energies |
//! | `timings.csv` | the time of each load step, in a file of its own, so that histories can be compared bitwise |
//! | `rigid_NNNN.vtu`, `rigid.pvd` | surfaces of the rigid bodies, as in the state of the fields with this number |
//! | `fields_NNNN.vtu`, `fields.pvd` | fields on the cells of the mesh or the lattice |
//! | `fields_NNNN_BBBB.vtu` | the same between the breakages of a load step, after so many of them |
//! | `bonds_NNNN.vtu`, `bonds.pvd` | the bonds as lines, if requested |
//!
//! The cracks of a stored run as lines, their tips and their growth are written later ([`write_cracks`]), as is the surface in a solid on
//! which a field has a value ([`write_level_set`]). A modal analysis writes `modes.csv`, `mode_NNNN.vtu` and `modes.pvd` instead
//! ([`write_modes`]).

mod between_breakages;
pub mod bond_arrays;
mod checkpoint_state;
pub mod columns;
mod crack_growth;
mod crack_tables;
pub mod cracks;
mod first_field;
mod grid;
mod isosurface_files;
mod model_file;
mod modes;
mod opened_files;
pub mod outputs;
pub mod passes;
mod pieces;
mod point_fields;
mod restored;
mod rigid_files;
mod rule;
mod softening_table;
pub mod solid_body;
pub mod solid_cracks;
pub mod steps;
pub mod stored;
pub mod stored_state;
mod surface_files;
mod tables;

use ligament_analysis::driver::Problem;
use ligament_analysis::first_bonds::FirstBonds;
use ligament_analysis::history::{BreakRecord, Observer, ObserverError, StepRecord, View};
use ligament_analysis::largest_utilisation::LargestUtilisations;
use ligament_analysis::result_fields::{DISPLACEMENT, displacements};
use ligament_model::{BodyGrid, ConstantFields};

pub use ligament_analysis::result_fields as fields;

use crate::Error;
use crate::file_digest::FileDigest;
use crate::folder::ResultFolder;
use crate::pvd::Collection;
use crate::vtu::Field;

use between_breakages::StatesBetweenBreakages;
pub use checkpoint_state::OutputState;
pub use crack_tables::{CRACK_FILES, write_cracks};
pub use first_field::{BondOutcome, first_field, first_field_of};
use grid::BondLines;
pub use grid::{point_grid, write_points};
pub use isosurface_files::write_level_set;
pub use modes::write_modes;
use outputs::remove_others;
pub use pieces::PieceWriter;
pub use point_fields::{location, sides_between_materials};
pub use restored::{RestoredBody, RestoredStep};
pub use rigid_files::{StoredRigidBodies, stored_rigid_bodies};
pub use rule::WriteRule;
use rule::{WrittenState, n_bonds_of_body};
pub use softening_table::CrackedBelow;
use softening_table::SofteningTable;
pub use stored_state::StoredState;
use stored_state::{BONDS, FIELDS, RIGID};
pub use surface_files::{SURFACE_FILES, stored_jumps, write_series, write_surface};
pub use tables::criterion_labels;
use tables::{CRITERIA_FILE, Tables, deformation_names};
pub use tables::{history_columns, history_row};

/// Observer that writes the results of a run.
pub struct ResultWriter<'a> {
    folder: &'a ResultFolder,
    grid: &'a BodyGrid,
    problem: Problem,
    fixed: &'a ConstantFields,
    rule: WriteRule,
    tables: Tables,
    /// Table of softening bonds, where bonds soften.
    softening: Option<SofteningTable>,
    first: FirstBonds,
    fields_collection: Collection,
    bonds_collection: Collection,
    rigid_collection: Collection,
    /// The kept states between breakages.
    between: StatesBetweenBreakages,
    /// Number of bonds of the body.
    n_bonds: usize,
    /// Ends of the broken bonds, with the steps.
    breaks: Vec<([u32; 2], u32)>,
    /// Step of breaking of each bond, -1 while it is intact, shape (n_bonds).
    step_of_breaking: Vec<i64>,
    /// Largest utilisation of each bond so far, where the model is written or the mesh is refined.
    largest: Option<LargestUtilisations>,
    /// Names of the completed files, with their contents' lengths and digests.
    whole: Vec<(String, FileDigest)>,
}

impl<'a> ResultWriter<'a> {
    /// Creates the tables of a run in a result folder.
    pub fn new(
        folder: &'a ResultFolder,
        grid: &'a BodyGrid,
        fixed: &'a ConstantFields,
        rule: WriteRule,
        problem: &Problem,
    ) -> Result<Self, Error> {
        if rule.model {
            model_file::write(folder.path(), grid, fixed, problem, None)?;
        }
        // Where the body is divided, each process would have the largest utilisations of its own bonds only.
        let can_fail = !problem.criteria.list.is_empty() && problem.system.subdomain.is_whole();
        let follows = rule.model || rule.utilisations;
        let largest =
            (follows && can_fail).then(|| LargestUtilisations::new(problem.system.ends.len()));
        let mut writer = Self {
            folder,
            grid,
            largest,
            problem: problem.clone(),
            fixed,
            rule,
            tables: Tables::create(folder, problem, grid.tagged)?,
            softening: SofteningTable::create(folder, problem, grid.tagged)?,
            first: FirstBonds::default(),
            fields_collection: Collection::new(folder.file("fields.pvd")),
            bonds_collection: Collection::new(folder.file("bonds.pvd")),
            rigid_collection: Collection::new(folder.file("rigid.pvd")),
            between: StatesBetweenBreakages::default(),
            n_bonds: n_bonds_of_body(problem),
            breaks: Vec::new(),
            step_of_breaking: vec![-1; fixed.domain_factor.len()],
            whole: Vec::new(),
        };
        writer.record_file(CRITERIA_FILE)?;
        Ok(writer)
    }

    /// Continues the results of a run from a checkpoint: later rows and files are removed, and the model is rewritten.
    ///
    /// # Errors
    ///
    /// If a file cannot be written, cut back or removed.
    pub fn resume(
        folder: &'a ResultFolder,
        grid: &'a BodyGrid,
        fixed: &'a ConstantFields,
        rule: WriteRule,
        problem: &Problem,
        so_far: OutputState,
    ) -> Result<Self, Error> {
        let OutputState {
            tables,
            softening,
            first,
            mut fields,
            mut bonds,
            between,
            breaks,
            largest,
            mut whole,
        } = so_far;
        // States that the run dropped after the checkpoint are dropped again; a resume with other files missing is refused before.
        let is_there = |name: &String| folder.file(name).is_file();
        fields.retain(|(_, name)| is_there(name));
        bonds.retain(|(_, name)| is_there(name));
        whole.retain(|(name, _)| is_there(name));
        // Where the body is divided, this process does not have all bonds.
        let is_whole = problem.system.subdomain.is_whole();
        let (softening, largest) = (softening.filter(|_| is_whole), largest.filter(|_| is_whole));
        if rule.model {
            model_file::write(folder.path(), grid, fixed, problem, None)?;
        }
        remove_others(folder, FIELDS, &fields)?;
        remove_others(folder, BONDS, &bonds)?;
        let is_rigid = !problem.contact.rigid_bodies.is_empty();
        let beside = |(time, name): &(f64, String)| (*time, rigid_files::name_beside(name));
        let rigid: Vec<(f64, String)> = fields.iter().filter(|_| is_rigid).map(beside).collect();
        remove_others(folder, RIGID, &rigid)?;
        let mut step_of_breaking = vec![-1; fixed.domain_factor.len()];
        set_steps_of_breaking(&mut step_of_breaking, problem, &breaks);
        Ok(Self {
            folder,
            grid,
            largest,
            problem: problem.clone(),
            fixed,
            rule,
            tables: Tables::resume(folder, problem, grid.tagged, &tables)?,
            softening: softening
                .map(|progress| SofteningTable::resume(folder, problem, progress))
                .transpose()?,
            first,
            fields_collection: Collection::with_outputs(folder.file("fields.pvd"), fields)?,
            bonds_collection: Collection::with_outputs(folder.file("bonds.pvd"), bonds)?,
            rigid_collection: Collection::with_outputs(folder.file("rigid.pvd"), rigid)?,
            between,
            n_bonds: n_bonds_of_body(problem),
            breaks,
            step_of_breaking,
            whole,
        })
    }

    /// State of the written results, which are synced to disk when this returns.
    ///
    /// # Errors
    ///
    /// If a file cannot be synced.
    pub fn output_state(&self) -> Result<OutputState, Error> {
        Ok(OutputState {
            tables: self.tables.progress()?,
            softening: self
                .softening
                .as_ref()
                .map(SofteningTable::progress)
                .transpose()?,
            first: self.first,
            fields: self.fields_collection.outputs().to_vec(),
            bonds: self.bonds_collection.outputs().to_vec(),
            between: self.between.clone(),
            breaks: self.breaks.clone(),
            largest: self.largest.clone(),
            whole: self.whole.clone(),
        })
    }

    /// The first bonds that broke and softened so far.
    pub fn first_bonds(&self) -> FirstBonds {
        self.first
    }

    /// Largest utilisations of the bonds so far, where they are followed.
    pub fn into_largest(self) -> Option<LargestUtilisations> {
        self.largest
    }

    /// Records length and digest of a completed file, on which a resumed run relies.
    fn record_file(&mut self, name: &str) -> Result<(), Error> {
        let path = self.folder.file(name);
        let written = FileDigest::of_file(&path).map_err(Error::system("read", &path))?;
        self.whole.push((name.to_owned(), written));
        Ok(())
    }

    /// Writes the fields of a state, and its bonds if requested.
    fn write(&mut self, written: WrittenState<'_>) -> Result<(), Error> {
        self.write_fields(written)?;
        match self.rule.bonds {
            true => self.write_bonds(written),
            false => Ok(()),
        }
    }

    /// Removes the states between breakages that are no longer kept.
    fn remove_dropped(&mut self) -> Result<(), Error> {
        let collections = [
            (FIELDS, &mut self.fields_collection),
            (BONDS, &mut self.bonds_collection),
            (RIGID, &mut self.rigid_collection),
        ];
        for (stem, collection) in collections {
            let is_kept = |name: &str| {
                let state = StoredState::of_file(name, stem);
                let between = state.filter(|it| it.breakages().is_some());
                between.is_none_or(|it| self.between.has(it))
            };
            collection.retain(is_kept)?;
            self.whole.retain(|(name, _)| is_kept(name));
            remove_others(self.folder, stem, collection.outputs())?;
        }
        Ok(())
    }

    fn write_fields(&mut self, written: WrittenState<'_>) -> Result<(), Error> {
        let name = written.fields_file();
        point_fields::write(
            &self.folder.file(&name),
            self.grid,
            self.fixed,
            self.rule,
            written,
        )?;
        self.record_file(&name)?;
        let bodies = &self.problem.contact.rigid_bodies;
        if !bodies.is_empty() {
            let name = rigid_files::name_beside(&name);
            let states = &written.record.rigid_bodies;
            let field_data = written.field_data();
            rigid_files::write(&self.folder.file(&name), bodies, states, &field_data)?;
            self.record_file(&name)?;
            self.rigid_collection.append(written.time, name)?;
        }
        self.fields_collection.append(written.time, name)
    }

    fn write_bonds(&mut self, written: WrittenState<'_>) -> Result<(), Error> {
        let view = written.view;
        let (system, balanced) = (view.system, view.balanced);
        let names = deformation_names(system);
        let component = |place: usize| {
            let deformations = balanced.deformations.iter();
            deformations.map(|it| it.strains()[place]).collect()
        };
        let deformations: Vec<Vec<f64>> = (0..names.len()).map(component).collect();
        let utilisation: Vec<f64> = (balanced.deformations.iter().enumerate())
            .map(|(bond, deformation)| view.criteria.utilisation(bond, deformation))
            .collect();
        let intact = view.state.intact.iter();
        let state: Vec<i64> = intact.map(|&intact| i64::from(intact)).collect();
        let displacement = displacements(view);
        let lines = BondLines::new(self.grid, &system.ends, &[]);
        let mut cell_fields = vec![
            Field::integer("intact", &state),
            Field::scalar("utilisation", &utilisation),
            Field::scalar("domain_factor", &self.fixed.domain_factor),
            Field::integer("step_of_breaking", &self.step_of_breaking),
        ];
        if !self.fixed.shear_ratio.is_empty() {
            cell_fields.push(Field::scalar("shear_ratio", &self.fixed.shear_ratio));
        }
        let named = names.iter().zip(&deformations);
        cell_fields.extend(named.map(|(name, values)| Field::scalar(name, values)));
        let name = format!("{BONDS}_{}.vtu", written.state.in_file_name());
        let displacement = [Field::numbers(DISPLACEMENT.name, 3, &[], &displacement)];
        lines.write(
            &self.folder.file(&name),
            self.grid,
            [&displacement, &cell_fields],
            (&system.subdomain, &written.field_data()),
        )?;
        self.record_file(&name)?;
        self.bonds_collection.append(written.time, name)
    }
}

impl Observer for ResultWriter<'_> {
    fn round(
        &mut self,
        step: usize,
        round: usize,
        load_factor: f64,
        broken: usize,
    ) -> Result<(), ObserverError> {
        self.tables.enter_round(step, round, load_factor, broken);
        Ok(())
    }

    fn iteration(
        &mut self,
        iteration: usize,
        residual: f64,
        stored_energy: f64,
    ) -> Result<(), ObserverError> {
        observer_result(self.tables.iteration(iteration, residual, stored_energy))
    }

    fn broke(&mut self, records: &[BreakRecord]) -> Result<(), ObserverError> {
        self.first.broke(records)?;
        for record in records {
            self.breaks.push((record.ends, record.step as u32));
        }
        let new = &self.breaks[self.breaks.len() - records.len()..];
        set_steps_of_breaking(&mut self.step_of_breaking, &self.problem, new);
        observer_result(self.tables.breaks(records, self.grid))
    }

    fn looks(&self, step: usize) -> bool {
        self.rule.is_due(step) || self.softening.is_some()
    }

    fn looks_between_breakages(
        &mut self,
        step: usize,
        broken: usize,
    ) -> Result<bool, ObserverError> {
        let most = self.rule.during_breakage;
        if most > 0 && self.between.enter(step, broken, most) {
            observer_result(self.remove_dropped())?;
        }
        Ok(self.between.has(StoredState::between(step, broken)))
    }

    fn between_breakages(
        &mut self,
        record: &StepRecord,
        view: &View<'_>,
    ) -> Result<(), ObserverError> {
        let written = WrittenState::between_breakages(record, view, self.n_bonds);
        observer_result(self.write(written))
    }

    fn step(&mut self, record: &StepRecord, view: &View<'_>) -> Result<(), ObserverError> {
        if self.rule.writes_fields(record, view) {
            observer_result(self.write(WrittenState::of_row(record, view)))?;
        }
        self.first.step(record, view)?;
        if let Some(table) = &mut self.softening {
            observer_result(table.step(record, view, self.grid))?;
        }
        if let Some(largest) = self.largest.as_mut().filter(|_| view.is_whole) {
            largest.update(record.step, view);
        }
        if self.rule.rewrites_model(view) {
            let (folder, grid, fixed) = (self.folder.path(), self.grid, self.fixed);
            let at_end = Some((view.state, self.largest.as_ref()));
            observer_result(model_file::write(
                folder,
                grid,
                fixed,
                &self.problem,
                at_end,
            ))?;
        }
        observer_result(self.tables.step(record, view))
    }
}

/// Sets the steps of breaking of the bonds on this process.
fn set_steps_of_breaking(
    step_of_breaking: &mut [i64],
    problem: &Problem,
    breaks: &[([u32; 2], u32)],
) {
    let (ends, subdomain) = (&problem.system.ends, &problem.system.subdomain);
    for (of_bond, step) in breaks {
        let [a, b] = of_bond.map(|end| subdomain.point(end));
        let bond = a.zip(b).map(|(a, b)| ends.binary_search(&[a, b]));
        if let Some(Ok(bond)) = bond {
            step_of_breaking[bond] = i64::from(*step);
        }
    }
}

fn observer_result(result: Result<(), Error>) -> Result<(), ObserverError> {
    result.map_err(|error| ObserverError(Box::new(error)))
}
