//! Pairs of points within a horizon that have no bond.

use ligament_model::{Absence, AbsentBond, BondSet, PointCloud};

use crate::body::{BodyOutline, Geometry};

/// The bonds inside the body, and the pairs of points that its voids separate.
pub(crate) fn inside_body<const D: usize>(
    body: &dyn Geometry<D>,
    bonds: BondSet<D>,
    cloud: &PointCloud<D>,
    outline: Option<&(dyn BodyOutline<D> + '_)>,
) -> (BondSet<D>, Vec<AbsentBond>) {
    let crosses = match outline {
        Some(outline) => outline.is_crossed_by_bonds(&bonds, cloud),
        None => body.crosses_holes(&bonds, cloud),
    };
    if !crosses.contains(&true) {
        return (bonds, Vec::new());
    }
    let keep: Vec<bool> = crosses.iter().map(|crosses| !crosses).collect();
    let absent = absent_bonds(&bonds, &crosses, Absence::Void);
    (bonds.retained(&keep), absent)
}

/// Absent bonds and the bonds that pre-cracks cut, in the order of their ends; `is_cut` has shape (n_bonds).
pub(crate) fn with_cut<const D: usize>(
    mut absent: Vec<AbsentBond>,
    bonds: &BondSet<D>,
    is_cut: &[bool],
) -> Vec<AbsentBond> {
    absent.extend(absent_bonds(bonds, is_cut, Absence::PreCrack));
    absent.sort_unstable_by_key(|it| it.ends);
    absent
}

/// The bonds for which `is_absent` (n_bonds) is true, as absent bonds.
fn absent_bonds<const D: usize>(
    bonds: &BondSet<D>,
    is_absent: &[bool],
    absence: Absence,
) -> Vec<AbsentBond> {
    (bonds.ends.iter().zip(&*bonds.horizon))
        .zip(is_absent)
        .filter(|(_, is_absent)| **is_absent)
        .map(|((&ends, &horizon), _)| AbsentBond {
            ends,
            horizon,
            absence,
        })
        .collect()
}
