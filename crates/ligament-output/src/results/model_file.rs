//! File of the model of a run: points, bonds and their limits, from which a bond can be explained later.
//!
//! `model.vtu`, in pieces `model.pvtu`, has the points with their tags, volumes and horizons, and the bonds as lines between them, which
//! give lengths and directions. Factors and horizons have seven digits, limits all digits. The point field `group.NAME` is 1 at the points
//! of a support or load, NAME as in the columns of the history. The field data have `stiff_cells` where cells resist strains beside bonds.
//!
//! | cell field | of a bond |
//! |---|---|
//! | `absent` | 0; 1 where a pre-crack cut the bond, 2 where a void of the body lies between its ends: absent bonds have no values |
//! | `interface.A-B` | 1 where the bond crosses the interface between the materials A and B |
//! | `horizon` | H, m |
//! | `length_factor`, `domain_factor` | alpha, Omega |
//! | `limit.NAME` | limit of the criterion; infinite where the bond never fails by it, or has not begun to soften by the stress around it |
//! | `limit_at_start.NAME` | at the end of a run, the limit before bonds began to soften by the stress around them |
//! | `coefficient.NAME` | coefficient q of the criterion's measure, where it has one |
//! | `toughness_ratio.NAME`, `mixed_mode_exponent.NAME` | G_IIc/G_Ic and eta of the criterion's measure, where they differ from 1 |
//! | `coefficient_4.NAME` to `coefficient_9.NAME` | further coefficients of a measure of stress, whose second and third have the two names above |
//! | `after.NAME` | e_u/e_0 or e_f/e_0 of the law after the limit, where it has one |
//! | `largest_utilisation`, `step_of_largest`, `criterion_of_largest` | largest utilisation over the run, written at its end |
//! | `step_of_softening` | at the end of a run, step in which the bond began to soften by the stress around it; -1 if it did not |

use std::path::{Path, PathBuf};

use ligament_analysis::driver::Problem;
use ligament_analysis::largest_utilisation::{LargestUtilisation, LargestUtilisations};
use ligament_analysis::load_program::BoundaryGroup;
use ligament_analysis::result_fields::{HORIZON, VOLUME};
use ligament_analysis::state::State;
use ligament_model::failure::CriteriaInState;
use ligament_model::{BodyGrid, ConstantFields};

use super::grid::BondLines;
use super::tables::criterion_labels;
use crate::Error;
use crate::vtu::{self, Field};

/// Name of the field of the energies that bonds dissipated, J.
pub(super) const DISSIPATED_ENERGY: &str = "dissipated_energy";

/// Prefix of the names of the fields of supported and loaded points.
pub(super) const GROUP: &str = "group.";

/// Prefix of the names of the fields of interfaces.
pub(super) const INTERFACE: &str = "interface.";

/// Name of a number of files in which cells resist strains beside bonds: a far field, or cells with a volumetric stiffness.
pub(super) const STIFF_CELLS: &str = "stiff_cells";

/// Stem of the model file's name.
const MODEL: &str = "model";

/// Path of the model file in a result folder, if it exists.
pub(super) fn model_file(folder: &Path) -> Option<PathBuf> {
    let names =
        [vtu::FILE_EXTENSION, vtu::PIECES_EXTENSION].map(|it| folder.join(format!("{MODEL}.{it}")));
    names.into_iter().find(|path| path.is_file())
}

/// Names of the fields that hold the coefficients of a measure, in their order. Most measures have none or one; measures of stress have the
/// stress around the bond (none in the sound body) and moduli.
pub(super) const COEFFICIENTS: [&str; 9] = [
    "coefficient",
    "toughness_ratio",
    "mixed_mode_exponent",
    "coefficient_4",
    "coefficient_5",
    "coefficient_6",
    "coefficient_7",
    "coefficient_8",
    "coefficient_9",
];

/// Writes the model, at the end of a run with the limits of bonds that began to soften by the stress around them, the energies that bonds
/// dissipated (n_bonds, J) and, where they are known, their largest utilisations.
pub(super) fn write(
    folder: &Path,
    grid: &BodyGrid,
    fixed: &ConstantFields,
    problem: &Problem,
    at_end: Option<(&State, Option<&LargestUtilisations>)>,
) -> Result<(), Error> {
    let system = &problem.system;
    let of_absent: Vec<[u32; 2]> = fixed.absent.iter().map(|pair| pair.ends).collect();
    let lines = BondLines::new(grid, &system.ends, &of_absent);
    let criteria = at_end.map_or_else(
        || problem.criteria.without_state(),
        |(state, _)| state.softening.criteria(&problem.criteria),
    );
    let mut columns = constant_columns(fixed, problem);
    columns.extend(limits(&criteria));
    let largest = at_end.and_then(|(_, largest)| largest);
    columns.extend(largest.into_iter().flat_map(largest_utilisations));
    columns.extend(at_end.map(|(state, _)| dissipated(state)));
    let count = system.ends.len() + of_absent.len();
    let cell_fields: Vec<Field<'_>> = columns.iter().map(|it| it.field(count)).collect();
    let no_fail: Vec<i64> = fixed.no_fail.iter().copied().map(i64::from).collect();
    let groups = groups(problem);
    let mut point_fields = vec![
        Field::scalar(VOLUME.name, &system.volumes),
        Field::scalar(HORIZON.name, &fixed.horizon),
        Field::integer("no_fail", &no_fail),
        Field::integer(grid.tagged, &grid.tags),
    ];
    point_fields.extend(groups.iter().map(|(name, at)| Field::integer(name, at)));
    let subdomain = &system.subdomain;
    let path = folder.join(vtu::file_name(MODEL, subdomain));
    let fields = [&point_fields[..], &cell_fields];
    let has_stiff_cells = system.has_volumetric_cells || system.far_field.is_some();
    let field_data: &[_] = if has_stiff_cells {
        &[(STIFF_CELLS, 1.0)]
    } else {
        &[]
    };
    lines.write(&path, grid, fields, (subdomain, field_data))
}

/// A field of the bonds, followed by the absent bonds.
struct Column<'a> {
    name: String,
    values: BondValues<'a>,
}

/// Values by the index of a bond, computed where they are written.
enum BondValues<'a> {
    Double(Box<dyn Fn(usize) -> f64 + Sync + 'a>),
    Single(Box<dyn Fn(usize) -> f32 + Sync + 'a>),
    Integer(Box<dyn Fn(usize) -> i64 + Sync + 'a>),
}

impl<'a> Column<'a> {
    fn double(name: String, value: impl Fn(usize) -> f64 + Sync + 'a) -> Self {
        let values = BondValues::Double(Box::new(value));
        Self { name, values }
    }

    fn single(name: &str, value: impl Fn(usize) -> f32 + Sync + 'a) -> Self {
        let (name, values) = (name.to_owned(), BondValues::Single(Box::new(value)));
        Self { name, values }
    }

    fn integer(name: String, value: impl Fn(usize) -> i64 + Sync + 'a) -> Self {
        let values = BondValues::Integer(Box::new(value));
        Self { name, values }
    }

    /// The field of a number of bonds.
    fn field(&self, count: usize) -> Field<'_> {
        match &self.values {
            BondValues::Double(value) => Field::computed(&self.name, count, value),
            BondValues::Single(value) => Field::computed_single(&self.name, count, value),
            BondValues::Integer(value) => Field::computed_integer(&self.name, count, value),
        }
    }
}

/// Fields that do not change in a run: why bonds are absent, their horizons and factors, and the interfaces that they cross.
fn constant_columns<'a>(fixed: &'a ConstantFields, problem: &'a Problem) -> Vec<Column<'a>> {
    let (system, absent) = (&problem.system, &fixed.absent);
    let n_bonds = system.ends.len();
    let absence = move |bond: usize| {
        let pair = bond.checked_sub(n_bonds);
        pair.map_or(0, |pair| absent[pair].absence.number())
    };
    let horizon = move |bond: usize| match bond.checked_sub(n_bonds) {
        None => system.horizons[bond] as f32,
        Some(pair) => absent[pair].horizon as f32,
    };
    let omegas = &fixed.domain_factor;
    let omega = move |bond: usize| omegas.get(bond).map_or(f32::NAN, |it| *it as f32);
    let alpha = move |bond: usize| {
        let factors = omegas.get(bond).zip(system.weights.get(bond));
        factors.map_or(f32::NAN, |(omega, weight)| (weight / omega) as f32)
    };
    let crosses = |(name, crosses): &'a (String, Vec<bool>)| {
        let at = move |bond: usize| crosses.get(bond).map_or(0, |it| i64::from(*it));
        Column::integer(format!("{INTERFACE}{name}"), at)
    };
    let mut columns = vec![
        Column::integer("absent".to_owned(), absence),
        Column::single("horizon", horizon),
        Column::single("length_factor", alpha),
        Column::single("domain_factor", omega),
    ];
    columns.extend(fixed.interfaces.iter().map(crosses));
    columns
}

/// Fields of the limits and coefficients of each criterion.
fn limits<'a>(criteria: &'a CriteriaInState<'_>) -> Vec<Column<'a>> {
    let list = &criteria.criteria().list;
    let mut columns = Vec::new();
    let labels = criterion_labels(list.iter().map(|criterion| criterion.name));
    for (number, (criterion, label)) in list.iter().zip(labels).enumerate() {
        // Every so many values are one of a bond.
        let mut push = |what: &str, values: &'a [f64], first: usize, stride: usize| {
            let value = move |bond: usize| values.get(first + stride * bond);
            let value = move |bond: usize| value(bond).copied().unwrap_or(f64::NAN);
            columns.push(Column::double(format!("{what}.{label}"), value));
        };
        push("limit", criteria.limits(number), 0, 1);
        if criteria.limits(number) != criterion.limit.as_slice() {
            push("limit_at_start", &criterion.limit, 0, 1);
        }
        let coefficients = &criterion.coefficient;
        let stride = coefficients.len() / criterion.limit.len().max(1);
        for (first, what) in COEFFICIENTS.iter().take(stride).enumerate() {
            push(what, coefficients, first, stride);
        }
        let parameter = criteria.after(number).parameter();
        if !parameter.is_empty() {
            push("after", parameter, 0, 1);
        }
    }
    columns
}

/// Field of the energies that the bonds dissipated.
fn dissipated(state: &State) -> Column<'_> {
    let of_bonds = &state.dissipated;
    let energy = move |bond: usize| of_bonds.get(bond).copied().unwrap_or(f64::NAN);
    Column::double(DISSIPATED_ENERGY.to_owned(), energy)
}

/// Fields of the largest utilisations.
fn largest_utilisations(largest: &LargestUtilisations) -> Vec<Column<'_>> {
    const OF_ABSENT: LargestUtilisation = LargestUtilisation {
        utilisation: f32::NAN,
        step: 0,
        criterion: 0,
    };
    let began_in = &largest.began_in;
    let largest = move |bond: usize| largest.of_bonds.get(bond).unwrap_or(&OF_ABSENT);
    let mut columns = vec![
        Column::single("largest_utilisation", move |bond| largest(bond).utilisation),
        Column::integer("step_of_largest".to_owned(), move |bond| {
            i64::from(largest(bond).step)
        }),
        Column::integer("criterion_of_largest".to_owned(), move |bond| {
            i64::from(largest(bond).criterion)
        }),
    ];
    if !began_in.is_empty() {
        let step = move |bond: usize| began_in.get(bond).map_or(-1, |it| i64::from(*it));
        columns.push(Column::integer("step_of_softening".to_owned(), step));
    }
    columns
}

/// Fields of the supported and loaded points: a name and 1 at its points for each group.
fn groups(problem: &Problem) -> Vec<(String, Vec<i64>)> {
    let n_points = problem.system.volumes.len();
    let field = |group: &BoundaryGroup| {
        let mut at = vec![0; n_points];
        for &point in &group.points {
            at[point as usize] = 1;
        }
        (format!("{GROUP}{}", group.name), at)
    };
    problem.loads.groups().iter().map(field).collect()
}
