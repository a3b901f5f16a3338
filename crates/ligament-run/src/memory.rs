//! Estimate of the memory that a case needs, and the available memory.

use std::f64::consts::PI;
use std::fs;
use std::path::Path;

use ligament::plausibility::corners;
use ligament::processes::partition_communicator;
use ligament::setup::{ELASTIC_ENERGY_TOLERANCE, Horizon, Setup};
use ligament_analysis::Equilibrium;
use ligament_analysis::driver::Problem;
use ligament_analysis::solver::n_axes;
use ligament_analysis::stiffness::Stiffness;
use ligament_case::case::{CaseFile, LatticeSection};
use ligament_model::Bonds;

/// Estimated bytes of one bond while equations are solved: 96 of the model (its record, rigidities, limit and two entries in the lists of
/// its ends), the rest for state, deformation, points and cells. With it, runs of plates on a lattice took 1.20, 1.18, 1.09 and 1.07 times
/// the equations and the program at 6016, 9392, 37,588 and 99,276 points. The correction, which has ended by then, takes 190 per bond at
/// its peak.
const BOND: usize = 250;

/// Upper estimate of the bytes of a point without bonds (position, volume, cell and corners): the lattice of 99,276 points took about 100.
const POINT: usize = 200;

/// Upper bound of the memory of equations over the memory of their bonds: where this bound fits, no symbolic analysis is needed. Plates of 6016
/// points with horizon factors of 1.1 to 5 have ratios of 4.2 to 5.2, of 99,276 points with 1.1 to 3 ratios of 6.0 to 8.9: the ratio grows
/// with the logarithm of the number of points.
const MOST_OVER_BONDS: usize = 40;

/// Number of values of L U over the number of the Cholesky factor of the same pattern: both triangles, rows with delayed pivots, and
/// temporary parts of the fronts. Elastic plates under the law `mbb-pd` in the form `pairwise`, of 1600, 6400 and 14,400 points with
/// horizon factor 3, took 7.4, 8.2 and 9.0 times as many.
const UNSYMMETRIC: usize = 10;

/// Bytes of a degree of freedom where equations are solved without a matrix, in the plane and in space: about twenty vectors, the blocks of
/// the points, and the coarse space with its factor and forces. Bodies of 160,000 points in the plane took 290, of 105,000 and 170,000 in
/// space 1770 and 1020.
const WITHOUT_MATRIX: [usize; 2] = [500, 1800];

/// Memory of the program itself, bytes.
const PROGRAM: u64 = 10_000_000;

/// Factor for memory outside of the estimate: history, output buffers, reserves of the allocator. The peaks of runs of 846 to 99,276 points
/// were 1.07 to 1.35 times the equations and the program where bonds are independent, 1.41 where they soften, and 1.45 with the strains of
/// the law `mbb-pd`.
const MARGIN: f64 = 1.5;

/// Error of a run that would need more than the available memory.
#[derive(Debug, Clone, Copy, PartialEq, thiserror::Error)]
#[error(
    "the run needs {:.1} GB of memory{}, and {:.1} GB are available; take fewer points, a smaller horizon or a larger machine, or set \
     solver.memory to the number of GB that it may use",
    gigabytes(*needed),
    if *is_bound { " or more" } else { "" },
    gigabytes(*available)
)]
pub struct InsufficientMemory {
    /// Memory that the run needs, bytes.
    pub needed: u64,
    /// Whether the need is a lower bound, without the matrix factor.
    pub is_bound: bool,
    /// Available memory, bytes.
    pub available: u64,
}

fn gigabytes(bytes: u64) -> f64 {
    bytes as f64 / 1e9
}

/// Estimated bytes of the equations of a system and of its bonds; without a stiffness the equations are solved without a matrix.
pub fn equation_bytes(system: &dyn Bonds, stiffness: Option<&Stiffness>) -> usize {
    let Some(stiffness) = stiffness else {
        let unknowns = system.layout.n_degrees_of_freedom();
        let of_unknown = WITHOUT_MATRIX[usize::from(n_axes(system) > 2)];
        return of_unknown * unknowns + BOND * system.ends.len();
    };
    let factor = size_of::<f64>() * stiffness.symbolic().n_factor_values();
    let further = times_of_factor(stiffness.choice().unsymmetric) - 1;
    stiffness.bytes() + further * factor + BOND * system.ends.len()
}

/// Bytes available to the matrix and its factor in a run of a case, after the program and the bonds.
pub fn factor_bytes(case: &CaseFile, system: &dyn Bonds) -> Option<usize> {
    let equation_bytes = allowed_memory(case)? as f64 / MARGIN - PROGRAM as f64;
    Some((equation_bytes as usize).saturating_sub(BOND * system.ends.len()))
}

/// Ratio of the number of values of a factor to the number of the symmetric factor.
fn times_of_factor(is_unsymmetric: bool) -> usize {
    if is_unsymmetric { UNSYMMETRIC } else { 1 }
}

/// Largest memory of a run whose equations take `equations` bytes.
pub fn run_bytes(equations: usize) -> u64 {
    (MARGIN * (equations as u64 + PROGRAM) as f64) as u64
}

/// Refuses a lattice whose points and bonds, not yet built, would exceed the available memory of one of several processes.
///
/// # Errors
///
/// If the available memory is exceeded, with both numbers.
pub fn check_lattice_memory(
    case: &CaseFile,
    lattice: &LatticeSection,
    processes: usize,
) -> Result<(), InsufficientMemory> {
    let points = lattice.cells.iter().map(|&it| f64::from(it)).product();
    let [dx, dy] = lattice.spacing.0;
    let model = &case.case.model;
    let spacings = model
        .horizon
        .map(|length| PI * (length / dx) * (length / dy));
    let of_factor = |factor: f64| PI * factor * factor;
    let family = spacings.or(model.horizon_factor.map(of_factor));
    require_memory_for_bonds(case, points, family.unwrap_or_default(), processes)
}

/// Refuses a body whose bonds on one process, not yet searched, would exceed the available memory.
///
/// # Errors
///
/// If the available memory is exceeded, with both numbers.
pub fn check_model_memory(case: &CaseFile, setup: &Setup) -> Result<(), InsufficientMemory> {
    let (points, family) = families(setup);
    require_memory_for_bonds(case, points, family, partition_communicator(setup).size())
}

/// Number of bonds that a body will have, before they are searched.
pub(crate) fn estimated_bonds(setup: &Setup) -> f64 {
    let (points, family) = families(setup);
    bonds(points, family)
}

/// Number of points, and number of neighbours of a point.
fn families(setup: &Setup) -> (f64, f64) {
    let dimensions = setup.body.dimensions();
    let points = setup.body.n_points() as f64;
    // Volume of a ball of radius 1 in the body's dimension.
    let ball = if dimensions == 2 { PI } else { 4.0 * PI / 3.0 };
    let family = match setup.horizon {
        Horizon::Factor(factor) => ball * factor.powi(dimensions as i32),
        Horizon::Length(length) => {
            let [low, high] = corners(&*setup.body);
            let box_of_body: f64 = low
                .iter()
                .zip(&high)
                .map(|(low, high)| high - low)
                .product();
            ball * length.powi(dimensions as i32) * points / box_of_body
        }
    };
    (points, family)
}

/// Number of bonds of points with `family` neighbours each: a bond belongs to two families, and no point has more neighbours than other
/// points exist.
fn bonds(points: f64, family: f64) -> f64 {
    0.5 * points * family.min(points)
}

/// Refuses a number of points and a size of families that exceed the available memory. Each process has all points and about its part of the
/// bonds.
fn require_memory_for_bonds(
    case: &CaseFile,
    points: f64,
    family: f64,
    processes: usize,
) -> Result<(), InsufficientMemory> {
    let bonds = bonds(points, family) / processes as f64;
    let needed = (POINT as f64 * points + BOND as f64 * bonds) as u64;
    check_available(case, needed, true)
}

/// Refuses a problem whose equations would exceed the available memory.
///
/// # Errors
///
/// If the available memory is exceeded, with both numbers, or if the equations cannot be analysed.
pub fn check_equation_memory(
    case: &CaseFile,
    system: &dyn Bonds,
    problem: &Problem,
) -> anyhow::Result<()> {
    let times = times_of_factor(!problem.system.element.has_energy());
    let most = (times * MOST_OVER_BONDS * BOND * system.ends.len()) as u64;
    if allowed_memory(case).is_none_or(|there| most <= there) {
        return Ok(());
    }
    let equilibrium = Equilibrium::new(problem, ELASTIC_ENERGY_TOLERANCE)?;
    Ok(check_memory(case, system, equilibrium.stiffness())?)
}

/// Refuses analysed equations that would exceed the available memory.
///
/// # Errors
///
/// If the available memory is exceeded, with both numbers.
pub fn check_memory(
    case: &CaseFile,
    system: &dyn Bonds,
    stiffness: Option<&Stiffness>,
) -> Result<(), InsufficientMemory> {
    check_available(
        case,
        equation_bytes(system, stiffness) as u64 + PROGRAM,
        false,
    )
}

fn check_available(case: &CaseFile, needed: u64, is_bound: bool) -> Result<(), InsufficientMemory> {
    match allowed_memory(case) {
        Some(available) if needed > available => Err(InsufficientMemory {
            needed,
            is_bound,
            available,
        }),
        _ => Ok(()),
    }
}

/// Memory that a case may use, bytes: the given or the available memory.
pub fn allowed_memory(case: &CaseFile) -> Option<u64> {
    let given = case.case.solver.memory;
    given.map(|it| (1e9 * it) as u64).or_else(available_memory)
}

/// Memory that programs can use without swapping, bytes: the smaller one of the system's free memory and the rest of this process's limits
/// (cgroups, as of batch systems and containers, or the shell's). `None` where neither is known.
pub fn available_memory() -> Option<u64> {
    let limits = [
        system_memory(),
        cgroup_memory(),
        memory_from_files(
            Path::new("/sys/fs/cgroup/memory"),
            ["memory.limit_in_bytes", "memory.usage_in_bytes"],
        ),
        shell_memory(),
    ];
    limits.into_iter().flatten().min()
}

/// The value in KiB behind a name in a list such as /proc/meminfo, converted to bytes.
fn kibibytes(list: &str, name: &str) -> Option<u64> {
    let text = fs::read_to_string(list).ok()?;
    let line = text.lines().find_map(|line| line.strip_prefix(name))?;
    let kibibytes: u64 = line.trim().strip_suffix("kB")?.trim().parse().ok()?;
    Some(1024 * kibibytes)
}

fn system_memory() -> Option<u64> {
    kibibytes("/proc/meminfo", "MemAvailable:")
}

fn cgroup_memory() -> Option<u64> {
    let groups = fs::read_to_string("/proc/self/cgroup").ok()?;
    let group = groups.lines().find_map(|line| line.strip_prefix("0::/"))?;
    let folder = Path::new("/sys/fs/cgroup").join(group);
    memory_from_files(&folder, ["memory.max", "memory.current"])
}

fn memory_from_files(folder: &Path, [limit, usage]: [&str; 2]) -> Option<u64> {
    let number = |name: &str| {
        let text = fs::read_to_string(folder.join(name)).ok()?;
        text.trim().parse::<u64>().ok()
    };
    Some(number(limit)?.saturating_sub(number(usage)?))
}

/// The rest of this process's address space under `ulimit -v`, bytes.
fn shell_memory() -> Option<u64> {
    let limits = fs::read_to_string("/proc/self/limits").ok()?;
    let line = limits
        .lines()
        .find_map(|line| line.strip_prefix("Max address space"))?;
    let limit: u64 = line.split_whitespace().next()?.parse().ok()?;
    Some(limit.saturating_sub(kibibytes("/proc/self/status", "VmSize:")?))
}
