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
    let absence: Vec<i64> = std::iter::repeat_n(0, system.ends.len())
        .chain(absent.iter().map(|pair| pair.absence.number()))
        .collect();
    let horizon: Vec<f32> = (system.horizons.iter())
        .chain(absent.iter().map(|pair| &pair.horizon))
        .map(|&horizon| horizon as f32)
        .collect();
    let nothing = std::iter::repeat_n(f32::NAN, n_absent);
    let alpha: Vec<f32> = (system.weights.iter().zip(&fixed.domain_factor))
        .map(|(weight, omega)| (weight / omega) as f32)
        .chain(nothing.clone())
        .collect();
    let omega: Vec<f32> = (fixed.domain_factor.iter().map(|&omega| omega as f32))
        .chain(nothing)
        .collect();
    let interfaces = interfaces(fixed, n_absent);
    let criteria = at_end.map_or_else(
        || problem.criteria.without_state(),
        |(_, state)| state.softening.criteria(&problem.criteria),
    );
    let limits = limits(&criteria, n_absent);
    let largest = at_end.map(|(largest, _)| UtilisationColumns::new(largest, n_absent));
    let dissipated = at_end.map(|(_, state)| with_nan_for_absent(&state.dissipated, n_absent));

    let mut cell_fields = vec![
        Field::integer("absent", &absence),
        Field::single("horizon", &horizon),
        Field::single("length_factor", &alpha),
        Field::single("domain_factor", &omega),
    ];
    cell_fields.extend((interfaces.iter()).map(|(name, crosses)| Field::integer(name, crosses)));
    cell_fields.extend(
        limits
            .iter()
            .map(|(name, values)| Field::scalar(name, values)),
    );
    cell_fields.extend(largest.iter().flat_map(|columns| columns.fields()));
    let dissipated = dissipated.iter();
    cell_fields.extend(dissipated.map(|it| Field::scalar(DISSIPATED_ENERGY, it)));
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
fn interfaces(fixed: &ConstantFields, n_absent: usize) -> Vec<(String, Vec<i64>)> {
    let field = |(name, crosses): &(String, Vec<bool>)| {
        let crosses = crosses.iter().copied().map(i64::from);
        let all = crosses.chain(std::iter::repeat_n(0, n_absent));
        (format!("{INTERFACE}{name}"), all.collect())
    };
    fixed.interfaces.iter().map(field).collect()
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

/// Values of the bonds, followed by NaN for each absent bond.
fn with_nan_for_absent(values: &[f64], n_absent: usize) -> Vec<f64> {
    let nothing = std::iter::repeat_n(f64::NAN, n_absent);
    values.iter().copied().chain(nothing).collect()
}

/// Fields of the limits and coefficients of each criterion for each bond, by name.
fn limits(criteria: &CriteriaInState<'_>, n_absent: usize) -> Vec<(String, Vec<f64>)> {
    let list = &criteria.criteria().list;
    let mut found = Vec::new();
    let labels = criterion_labels(list.iter().map(|criterion| criterion.name));
    for (number, (criterion, label)) in list.iter().zip(labels).enumerate() {
        let mut push = |what: &str, values: &mut dyn Iterator<Item = f64>| {
            let nothing = std::iter::repeat_n(f64::NAN, n_absent);
            found.push((format!("{what}.{label}"), values.chain(nothing).collect()));
        };
        push("limit", &mut criteria.limits(number).iter().copied());
        let coefficients = &criterion.coefficient;
        let count = coefficients.len() / criterion.limit.len().max(1);
        for (place, what) in COEFFICIENTS.iter().take(count).enumerate() {
            push(
                what,
                &mut coefficients.iter().skip(place).step_by(count).copied(),
            );
        }
        let parameter = criteria.after(number).parameter();
        if !parameter.is_empty() {
            push("after", &mut parameter.iter().copied());
        }
    }
    found
}

/// Largest utilisations of all bonds as the columns of a file.
struct UtilisationColumns {
    utilisation: Vec<f32>,
    step: Vec<i64>,
    criterion: Vec<i64>,
}

impl UtilisationColumns {
    /// The largest utilisations as arrays, with `n_absent` entries at their end for absent bonds.
    fn new(largest: &LargestUtilisations, n_absent: usize) -> Self {
        let nothing = LargestUtilisation {
            utilisation: f32::NAN,
            ..Default::default()
        };
        let all = || {
            largest
                .of_bonds
                .iter()
                .chain(std::iter::repeat_n(&nothing, n_absent))
        };
        Self {
            utilisation: all().map(|largest| largest.utilisation).collect(),
            step: all().map(|largest| i64::from(largest.step)).collect(),
            criterion: all().map(|largest| i64::from(largest.criterion)).collect(),
        }
    }

    fn fields(&self) -> [Field<'_>; 3] {
        [
            Field::single("largest_utilisation", &self.utilisation),
            Field::integer("step_of_largest", &self.step),
            Field::integer("criterion_of_largest", &self.criterion),
        ]
    }
}
