//! File of the model of a run: points, bonds and their limits, from which a bond can be explained later.
//!
//! `model.vtu`, in pieces `model.pvtu`, has the points with their tags, volumes and horizons, and the bonds as lines between them, which
//! give lengths and directions. Factors and horizons have seven digits, limits all digits. The point field `group.NAME` is 1 at the points
//! of a support or load, NAME as in the columns of the history.
//!
//! | cell field | of a bond |
//! |---|---|
//! | `absent` | 0; 1 where a pre-crack cut the bond, 2 where a void of the body lies between its ends: absent bonds have no values |
//! | `interface.A-B` | 1 where the bond crosses the interface between the materials A and B |
//! | `horizon` | H, m |
//! | `length_factor`, `domain_factor` | alpha, Omega |
//! | `limit.NAME` | limit of the criterion; infinite where the bond never fails by it, or has not begun to soften by the stress around it |
//! | `coefficient.NAME` | coefficient q of the criterion's measure, where it has one |
//! | `toughness_ratio.NAME`, `mixed_mode_exponent.NAME` | G_IIc/G_Ic and eta of the criterion's measure, where they differ from 1 |
//! | `coefficient_4.NAME` to `coefficient_9.NAME` | further coefficients of a measure of stress, whose second and third have the two names above |
//! | `after.NAME` | e_u/e_0 or e_f/e_0 of the law after the limit, where it has one |
//! | `largest_utilisation`, `step_of_largest`, `criterion_of_largest` | largest utilisation over the run, written at its end |

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

/// Number that a bond has, by its index in the file before it is put in order.
type NumberOfBond<'a> = Box<dyn Fn(usize) -> f64 + Sync + 'a>;

/// Integer that a bond has, by its index in the file before it is put in order.
type IntegerOfBond<'a> = Box<dyn Fn(usize) -> i64 + Sync + 'a>;

/// Writes the model, at the end of a run with the largest utilisations of its bonds, the energies that they dissipated (n_bonds, J), and
/// the limits of bonds that began to soften by the stress around them.
pub(super) fn write(
    folder: &Path,
    grid: &BodyGrid,
    fixed: &ConstantFields,
    problem: &Problem,
    at_end: Option<(&LargestUtilisations, &State)>,
) -> Result<(), Error> {
    let (system, absent) = (&problem.system, &fixed.absent);
    let n_absent = absent.len();
    let of_absent: Vec<[u32; 2]> = absent.iter().map(|pair| pair.ends).collect();
    let lines = BondLines::new(grid, &system.ends, &of_absent);
    let no_fail: Vec<i64> = fixed.no_fail.iter().copied().map(i64::from).collect();
    let n_bonds = system.ends.len();
    let count = n_bonds + n_absent;
    let absence = |place: usize| {
        let pair = place.checked_sub(n_bonds);
        pair.map_or(0, |it| absent[it].absence.number())
    };
    let horizon = |place: usize| match place.checked_sub(n_bonds) {
        None => system.horizons[place] as f32,
        Some(pair) => absent[pair].horizon as f32,
    };
    let omega = |place: usize| {
        fixed
            .domain_factor
            .get(place)
            .map_or(f32::NAN, |it| *it as f32)
    };
    let alpha = |place: usize| {
        let factors = fixed
            .domain_factor
            .get(place)
            .zip(system.weights.get(place));
        factors.map_or(f32::NAN, |(omega, weight)| (weight / omega) as f32)
    };
    let crosses: Vec<(String, IntegerOfBond<'_>)> = interfaces(fixed);
    let criteria = at_end.map_or_else(
        || problem.criteria.without_state(),
        |(_, state)| state.softening.criteria(&problem.criteria),
    );
    let limits = limits(&criteria);
    let limits: Vec<(&str, NumberOfBond<'_>)> = limits.iter().map(LimitColumn::by_bond).collect();
    let unknown = LargestUtilisation {
        utilisation: f32::NAN,
        ..Default::default()
    };
    let of_bonds = at_end.map(|(largest, _)| largest.of_bonds.as_slice());
    let largest = |place: usize| of_bonds.and_then(|it| it.get(place)).unwrap_or(&unknown);
    let utilisation = |place: usize| largest(place).utilisation;
    let step = |place: usize| i64::from(largest(place).step);
    let criterion = |place: usize| i64::from(largest(place).criterion);
    let dissipated = |place: usize| {
        let of_bonds = at_end.and_then(|(_, state)| state.dissipated.get(place));
        of_bonds.copied().unwrap_or(f64::NAN)
    };

    let mut cell_fields = vec![
        Field::computed_integer("absent", count, &absence),
        Field::computed_single("horizon", count, &horizon),
        Field::computed_single("length_factor", count, &alpha),
        Field::computed_single("domain_factor", count, &omega),
    ];
    let crosses = crosses.iter();
    cell_fields.extend(crosses.map(|(name, it)| Field::computed_integer(name, count, it)));
    cell_fields.extend(
        limits
            .iter()
            .map(|(name, it)| Field::computed(name, count, it)),
    );
    if at_end.is_some() {
        cell_fields.extend([
            Field::computed_single("largest_utilisation", count, &utilisation),
            Field::computed_integer("step_of_largest", count, &step),
            Field::computed_integer("criterion_of_largest", count, &criterion),
            Field::computed(DISSIPATED_ENERGY, count, &dissipated),
        ]);
    }
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
    lines.write(&path, grid, fields, (subdomain, &[]))
}

/// Fields of the interfaces: a name and 1 for its bonds for each.
fn interfaces(fixed: &ConstantFields) -> Vec<(String, IntegerOfBond<'_>)> {
    let mut fields = Vec::new();
    for (name, crosses) in &fixed.interfaces {
        let at = move |place: usize| crosses.get(place).map_or(0, |it| i64::from(*it));
        let at: IntegerOfBond<'_> = Box::new(at);
        fields.push((format!("{INTERFACE}{name}"), at));
    }
    fields
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

/// Limits or coefficients of a criterion: every so many values one of a bond.
struct LimitColumn<'a> {
    name: String,
    values: &'a [f64],
    first: usize,
    stride: usize,
}

impl LimitColumn<'_> {
    /// The name, and the value of a bond; NaN for absent bonds.
    fn by_bond(&self) -> (&str, NumberOfBond<'_>) {
        let value = |place: usize| self.values.get(self.first + self.stride * place);
        let of_bond = move |place: usize| value(place).copied().unwrap_or(f64::NAN);
        (&self.name, Box::new(of_bond))
    }
}

/// Limits and coefficients of each criterion for each bond.
fn limits<'a>(criteria: &'a CriteriaInState<'_>) -> Vec<LimitColumn<'a>> {
    let list = &criteria.criteria().list;
    let mut found = Vec::new();
    let labels = criterion_labels(list.iter().map(|criterion| criterion.name));
    for (number, (criterion, label)) in list.iter().zip(labels).enumerate() {
        let mut push = |what: &str, values: &'a [f64], first: usize, stride: usize| {
            let name = format!("{what}.{label}");
            found.push(LimitColumn {
                name,
                values,
                first,
                stride,
            });
        };
        push("limit", criteria.limits(number), 0, 1);
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
    found
}
