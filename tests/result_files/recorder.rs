//! An observer that keeps what a run has in memory, apart from the writer of the results.

mod model;

use std::path::Path;

use ligament_analysis::driver::Problem;
use ligament_analysis::history::{BreakRecord, Observer, ObserverError, StepRecord, View};
use ligament_analysis::material_stress::MaterialStress;
use ligament_analysis::{Component, fields};
use ligament_case::case::StressField;
use ligament_model::interface::StressReading;
use ligament_model::stress::principal::{tresca, von_mises};
use ligament_model::thermal::StressFreeStrains;
use ligament_run::model::Model;
use verification::numbers::{by_point, damages};
use verification::stresses;

use super::bodies::Canvas;
use super::expected::{Entry, Expected, Place, Rows};
use super::softening::Softened;

/// A utilisation that is not larger by more than this is the same: the file keeps the first of several.
const SAME: f64 = 1.0 + 2e-7;

/// Seven digits of a horizon or a factor.
fn single(value: f64) -> f32 {
    value as f32
}

pub(crate) struct Recorder<'a> {
    pub(crate) expected: Expected,
    model: &'a Model,
    canvas: &'a Canvas,
    problem: Problem,
    fields_every: usize,
    bonds: bool,
    stress: Vec<StressField>,
    labels: Vec<String>,
    history: Rows,
    breaks: Rows,
    iterations: Rows,
    /// Where bonds soften.
    softened: Option<Softened>,
    fields: Rows,
    bond_files: Rows,
    round: (usize, usize, f64, usize),
    step_of_breaking: Vec<i64>,
    /// Utilisation, step and criterion.
    largest: Vec<(f32, i64, i64)>,
    /// Energies that the bonds dissipated up to the last step, J.
    dissipated: Vec<f64>,
}

/// Names of the components of symmetric tensors.
const TENSOR: [&str; 6] = ["XX", "YY", "ZZ", "XY", "YZ", "XZ"];

/// Components of a tensor in a plane without stress across it.
fn in_space(&[xx, yy, xy]: &[f64; 3]) -> [f64; 6] {
    let zero = if xx.is_nan() { xx } else { 0.0 };
    [xx, yy, zero, xy, zero, zero]
}

/// A criterion's name, with a number from the second of its kind on.
fn labels(problem: &Problem) -> Vec<String> {
    let names: Vec<&str> = problem.criteria.list.iter().map(|it| it.name).collect();
    let label = |(k, name): (usize, &&str)| match names[..k].iter().filter(|it| *it == name).count()
    {
        0 => (*name).to_owned(),
        before => format!("{name}-{}", before + 1),
    };
    names.iter().enumerate().map(label).collect()
}

/// Names of the two or three components of bonds that files have, each with how it is read.
fn deformation_names(problem: &Problem) -> &'static [&'static str] {
    if problem.system.element.strain_names()[0] == "strain_xx" {
        &["strain_xx", "strain_xy", "strain_yy"]
    } else {
        &["stretch", "shear"]
    }
}

fn component(name: &str, deformation: &ligament_analysis::BondDeformation) -> f64 {
    let [xx, yy, xy] = deformation.strain();
    match name {
        "stretch" => deformation.stretch(),
        "shear" => deformation.shear(),
        "strain_xx" => xx,
        "strain_yy" => yy,
        "strain_xy" => xy,
        other => panic!("{other}"),
    }
}

impl<'a> Recorder<'a> {
    pub(crate) fn new(
        case: &ligament_case::case::Case,
        (model, mesh): (&'a Model, Option<&Path>),
        canvas: &'a Canvas,
        problem: Problem,
    ) -> Self {
        let history = [
            "step",
            "load_factor",
            "displacement",
            "reaction",
            "stored_energy",
            "released_energy",
            "broken_bonds",
            "external_work",
            "energy_error",
            "broken_in_step",
            "largest_ratio",
            "rounds",
            "solves",
            "fragments",
            "at_rest",
            "negative_eigenvalues",
            "dissipated_energy",
        ];
        let groups = problem.loads.groups().iter();
        let groups = groups.flat_map(|group| {
            ["force_x", "force_y", "moment"].map(|it| format!("{}.{it}", group.name))
        });
        let probes = problem.probes.iter().map(|it| it.name.clone());
        let history = history.map(str::to_owned).into_iter();
        let tagged = model.body().tagged();
        let breaks = ["order", "step", "round", "load_factor"].map(str::to_owned);
        let breaks = breaks
            .into_iter()
            .chain(["displacement", "reaction"].map(str::to_owned));
        let ends = [format!("{tagged}_a"), format!("{tagged}_b")];
        let after = ["utilisation", "criterion"].map(str::to_owned);
        let names = deformation_names(&problem)
            .iter()
            .map(|it| (*it).to_owned());
        let iterations = [
            "step",
            "round",
            "iteration",
            "load_factor",
            "residual",
            "stored_energy",
            "broken_bonds",
        ];
        let n_bonds = problem.system.ends.len();
        Self {
            expected: Expected::new(mesh, model),
            model,
            canvas,
            fields_every: case.output.fields_every.unwrap() as usize,
            bonds: case.output.bonds,
            stress: case.output.stress.clone(),
            labels: labels(&problem),
            problem: problem.clone(),
            history: Rows::new(history.chain(groups).chain(probes)),
            breaks: Rows::new(breaks.chain(ends).chain(after).chain(names)),
            iterations: Rows::new(iterations),
            softened: (problem.criteria.soften()).then(|| Softened::new(tagged, n_bonds)),
            fields: Rows::new(["timestep", "file"]),
            bond_files: Rows::new(["timestep", "file"]),
            round: (0, 0, 0.0, 0),
            step_of_breaking: vec![-1; n_bonds],
            largest: vec![(0.0, 0, 0); n_bonds],
            dissipated: vec![0.0; n_bonds],
        }
    }

    /// The tables and the model, once the run has ended.
    pub(crate) fn finish(mut self) -> Expected {
        self.model_file();
        let mut expected = self.expected;
        self.history.into_expected("history.csv", &mut expected);
        self.breaks.into_expected("breaks.csv", &mut expected);
        self.iterations
            .into_expected("iterations.csv", &mut expected);
        if let Some(softened) = self.softened {
            softened.into_expected(&mut expected);
        }
        self.fields.into_expected("fields.pvd", &mut expected);
        if self.bonds {
            self.bond_files.into_expected("bonds.pvd", &mut expected);
        }
        let mut criteria = Rows::new(["criterion", "measure", "after"]);
        for (criterion, label) in self.problem.criteria.list.iter().zip(&self.labels) {
            let row = [
                label.as_str(),
                criterion.measure.word(),
                criterion.after.word(),
            ];
            criteria.push(row.map(Entry::from));
        }
        criteria.into_expected("criteria.csv", &mut expected);
        expected
    }

    fn see_largest(&mut self, step: usize, view: &View<'_>) {
        let criteria = view.criteria;
        for number in 0..criteria.criteria().list.len() {
            for (bond, seen) in self.largest.iter_mut().enumerate() {
                let deformation = &view.balanced.deformations[bond];
                let measure = criteria.measure(number, bond, deformation);
                let limit = criteria.limits(number)[bond];
                if view.state.intact[bond] && measure > SAME * f64::from(seen.0) * limit {
                    *seen = ((measure / limit) as f32, step as i64, number as i64);
                }
            }
        }
    }

    fn write_fields(&mut self, file: &str, view: &View<'_>) {
        let (state, balanced) = (view.state, view.balanced);
        let system = &**self.model.plane();
        let layout = system.topology().layout;
        let motions = by_point(layout, &state.displacement);
        let points = 0..system.cloud.len();
        self.canvas.grid(file, &mut self.expected);
        let displacement: Vec<[f64; 3]> = motions.iter().map(|it| [it[0], it[1], 0.0]).collect();
        self.canvas
            .displacement(file, &displacement, &mut self.expected);
        let reactions = view
            .loads
            .reactions(state.load_factor, &balanced.internal.values);
        let reactions = by_point(layout, &reactions);
        let fragments = self.expected.parts(&view.fragments.of_point);
        let mut fields_of = self.canvas.on(file, &mut self.expected);
        fields_of.reals("rotation", motions.iter().map(|it| it[2]));
        fields_of.reals("damage", fields::damage(system, &state.intact));
        fields_of.reals(
            "strain_energy_density",
            fields::strain_energy_density(
                system,
                state.bonds(),
                &balanced.deformations,
                &balanced.closed,
            ),
        );
        fields_of.components(
            "reaction",
            ["", "", ""],
            reactions.iter().map(|it| [it[0], it[1], 0.0]),
        );
        fields_of.integers("fragment", fragments);
        let held = points
            .clone()
            .map(|it| i64::from(state.held[layout.range(it as u32)].contains(&true)));
        fields_of.integers("held", held);
        for (name, values) in damages(system, view.criteria.criteria(), state) {
            fields_of.reals(name, values);
        }
        if !view.criteria.criteria().list.is_empty() {
            let values = fields::dissipated_energy_density(system, &state.dissipated);
            fields_of.reals("dissipated_energy_density", values);
        }
        let change = view.loads.temperature_change(state.load_factor);
        if !change.is_empty() {
            fields_of.reals("temperature_change", change);
            let strain = view.loads.thermal_strain(state.load_factor);
            let of_points = StressFreeStrains::new(points.clone().map(|it| strain.of_point(it)));
            let strains = stresses::free(&of_points);
            fields_of.components("thermal_strain", ["XX", "YY", "XY"], strains);
        }
        let principal = |&[xx, yy, xy]: &[f64; 3]| {
            let radius = (0.5 * (xx - yy)).hypot(xy);
            [0.5 * (xx + yy) + radius, 0.5 * (xx + yy) - radius]
        };
        if self.stress.contains(&StressField::Material) {
            let stresses = view.solution().material_stresses(MaterialStress::Carried);
            let all = stresses.values.as_chunks::<4>().0;
            let in_plane = all.iter().map(|&[xx, yy, xy, _]| [xx, yy, xy]);
            let stresses: Vec<[f64; 3]> = in_plane.collect();
            let direction = |&[xx, yy, xy]: &[f64; 3]| {
                let (sine, cosine) = (0.5 * (2.0 * xy).atan2(xx - yy)).sin_cos();
                [cosine, sine, 0.0].map(|it| if xx.is_nan() { f64::NAN } else { it })
            };
            let (values, directions) = (
                stresses.iter().map(principal),
                stresses.iter().map(direction),
            );
            fields_of.components("stress_principal", ["1", "2"], values);
            fields_of.components("stress_direction", ["", "", ""], directions);
            let equivalent = |of: fn(&[f64]) -> Vec<f64>| all.iter().map(move |it| of(it)[0]);
            fields_of.reals("stress_von_mises", equivalent(von_mises));
            fields_of.reals("stress_tresca", equivalent(tresca));
            fields_of.components("stress", TENSOR, stresses.iter().map(in_space));
        }
        if self.stress.contains(&StressField::Effective) {
            let stresses = stresses::by_material(system, state, view.loads);
            let values = stresses.iter().map(principal);
            fields_of.components("stress_effective_principal", ["1", "2"], values);
            fields_of.components("stress_effective", TENSOR, stresses.iter().map(in_space));
        }
        if self.stress.contains(&StressField::Virial) {
            let stress = stresses::of_reading::<3>(
                StressReading::Virial,
                system,
                state.bonds(),
                &balanced.deformations,
            );
            fields_of.components("stress_virial", TENSOR, stress.iter().map(in_space));
        }
        if self.stress.contains(&StressField::Traction) {
            let stress = stresses::of_reading::<4>(
                StressReading::Traction,
                system,
                state.bonds(),
                &balanced.deformations,
            );
            let by_rows = stress.iter().map(|&[xx, yx, yy, xy]| [xx, xy, yx, yy]);
            fields_of.components("stress_traction", ["XX", "XY", "YX", "YY"], by_rows);
        }
        fields_of.fixed(self.model);
    }

    fn write_bonds(&mut self, file: &str, view: &View<'_>) {
        let (system, deformations) = (&**self.model.plane(), &view.balanced.deformations);
        let positions = self.model.setup.body.geometry().positions();
        self.expected.lines(file, &positions, system.bonds.len());
        let point = Place {
            file,
            part: "point",
            name: "displacement",
        };
        let motions = by_point(system.topology().layout, &view.state.displacement);
        let motions = motions.iter().map(|it| [it[0], it[1], 0.0]);
        self.expected.components(point, ["", "", ""], motions);
        let cell = |name| Place {
            file,
            part: "cell",
            name,
        };
        let intact = view.state.intact.iter().map(|&it| i64::from(it));
        self.expected.integers(cell("intact"), intact);
        let utilisation = (0..system.bonds.len()).map(|bond| {
            let of = |place| {
                let measure = view.criteria.measure(place, bond, &deformations[bond]);
                if measure > 0.0 {
                    measure / view.criteria.limits(place)[bond]
                } else {
                    0.0
                }
            };
            let places = 0..view.criteria.criteria().list.len();
            places.map(of).fold(0.0, f64::max)
        });
        self.expected.reals(cell("utilisation"), utilisation);
        let omega = self.model.fixed.domain_factor.iter().copied();
        self.expected.reals(cell("domain_factor"), omega);
        let steps = self.step_of_breaking.iter().copied();
        self.expected.integers(cell("step_of_breaking"), steps);
        for name in deformation_names(&self.problem) {
            let values = deformations.iter().map(|it| component(name, it));
            self.expected.reals(cell(name), values);
        }
    }
}

impl Observer for Recorder<'_> {
    fn iteration(
        &mut self,
        iteration: usize,
        residual: f64,
        stored_energy: f64,
    ) -> Result<(), ObserverError> {
        let (step, round, load_factor, broken) = self.round;
        self.iterations.push([
            step.into(),
            round.into(),
            iteration.into(),
            load_factor.into(),
            residual.into(),
            stored_energy.into(),
            broken.into(),
        ]);
        Ok(())
    }

    fn round(
        &mut self,
        step: usize,
        round: usize,
        load_factor: f64,
        broken: usize,
    ) -> Result<(), ObserverError> {
        self.round = (step, round, load_factor, broken);
        Ok(())
    }

    fn broke(&mut self, records: &[BreakRecord]) -> Result<(), ObserverError> {
        for record in records {
            self.step_of_breaking[record.bond as usize] = record.step as i64;
            let ends = self
                .expected
                .in_file(self.problem.system.ends[record.bond as usize]);
            let [a, b] = ends.map(|end| self.model.body().tag(end) as usize);
            let row: [Entry; 10] = [
                record.order.into(),
                record.step.into(),
                record.round.into(),
                record.load_factor.into(),
                record.displacement.into(),
                record.reaction.into(),
                a.into(),
                b.into(),
                record.ratio.into(),
                self.labels[record.criterion].as_str().into(),
            ];
            let names = deformation_names(&self.problem).iter();
            let deformation = names.map(|name| component(name, &record.deformation).into());
            self.breaks.push(row.into_iter().chain(deformation));
        }
        Ok(())
    }

    fn step(&mut self, record: &StepRecord, view: &View<'_>) -> Result<(), ObserverError> {
        let is_due = match self.fields_every {
            0 => record.step == 0,
            every => record.step.is_multiple_of(every),
        };
        if is_due || view.is_last {
            let time = record.step as f64;
            let numbers = [
                ("TimeValue", time),
                ("load_factor", record.load_factor),
                ("load_displacement", record.displacement),
                ("load_reaction", record.reaction),
            ];
            let name = format!("fields_{:04}.vtu", record.step);
            self.write_fields(&name, view);
            self.expected.field_data(&name, &numbers);
            self.fields.push([time.into(), name.as_str().into()]);
            if self.bonds {
                let name = format!("bonds_{:04}.vtu", record.step);
                self.write_bonds(&name, view);
                self.expected.field_data(&name, &numbers);
                self.bond_files.push([time.into(), name.as_str().into()]);
            }
        }
        self.see_largest(record.step, view);
        self.dissipated.clone_from(&view.state.dissipated);
        if let Some(softened) = &mut self.softened {
            let body = self.model.body();
            let in_file = |bond: usize| self.expected.in_file(view.system.ends[bond]);
            let tags = |bond: usize| in_file(bond).map(|end| body.tag(end) as usize);
            softened.step(record, view, tags, &self.labels);
        }
        let missing = record.external_work - record.stored_energy - record.released_energy;
        let work = record.external_work;
        let scale = if work.abs() < record.energy_floor {
            record.energy_floor
        } else {
            work
        };
        let energy_error = if scale == 0.0 { 0.0 } else { missing / scale };
        let row: [Entry; 17] = [
            record.step.into(),
            record.load_factor.into(),
            record.displacement.into(),
            record.reaction.into(),
            record.stored_energy.into(),
            record.released_energy.into(),
            record.broken_bonds.into(),
            record.external_work.into(),
            energy_error.into(),
            record.broken_in_step.into(),
            record.largest_ratio.into(),
            record.rounds.into(),
            record.solves.into(),
            record.fragments.into(),
            usize::from(record.at_rest).into(),
            record.negative_eigenvalues.into(),
            record.dissipated_energy.into(),
        ];
        let layout = self.model.plane().topology().layout;
        let forces = record
            .group_forces
            .iter()
            .flat_map(|it| Component::ALL.map(|component| layout.value(0, component, it)));
        let more = forces.chain(record.probes.iter().copied()).map(Entry::from);
        self.history.push(row.into_iter().chain(more));
        Ok(())
    }
}
