//! Memory that a case takes while its equations are solved.

use ligament_analysis::stiffness::Stiffness;
use ligament_model::BondSystem;

/// Bytes that a stored value of the factor takes.
const FACTOR_VALUE: usize = size_of::<f64>();

/// Bytes of one bond while equations are solved: 96 of the model (its record, rigidities, limit and two entries in the lists
/// of its ends), the rest for state, deformation, points and cells. The estimate lies 0 to 6 % below what runs of 106,000 to
/// 10,000 points took. The correction, which is over by then, takes 170 at its peak.
const BOND: usize = 250;

/// Estimated bytes of the equations of a system and of what stands around them.
pub fn of_equations(system: &BondSystem, stiffness: &Stiffness) -> usize {
    let symbolic = stiffness.symbolic();
    let (matrix, factor) = (symbolic.pattern().n_entries(), symbolic.n_factor_values());
    // The matrix is kept with its row numbers, and once more in the order of elimination while it is factorised.
    FACTOR_VALUE * factor + 4 * FACTOR_VALUE * matrix + BOND * system.bonds.len()
}
