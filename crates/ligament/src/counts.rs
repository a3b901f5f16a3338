//! Numbers of the bonds of a whole body and ranges of their factors, over all processes.

use ligament_model::correction::Correction;
use ligament_model::{Absence, AbsentBond, BondSet, BondSystem, PointCloud};

use crate::stage::Finding;

/// Numbers of bonds, each counted once.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct BondCounts {
    /// Number of bonds without those that pre-cracks cut.
    pub bonds: usize,
    /// Number of bonds that pre-cracks cut.
    pub cut: usize,
    /// Number of pairs of points that are not bonded because a void of the body separates them.
    pub across_voids: usize,
    /// Number of bonds that cross a material which neither of their ends has.
    pub across_layers: usize,
    /// Smallest and largest number of bonds of a point, outside of the far field.
    pub of_points: [usize; 2],
    /// Number of points of the far field, which have no bonds.
    pub far_points: usize,
    /// Number of cells that carry the volumetric stiffness of their material.
    pub volumetric_cells: usize,
}

impl BondCounts {
    /// Counts the bonds of a system and the pairs of points that are not bonded.
    pub fn new<const D: usize>(system: &BondSystem<D>, absent: &[AbsentBond]) -> Self {
        let (cloud, bonds) = (&system.cloud, &system.bonds);
        let is_far = |size: &usize| system.far.is_some() && *size == 0;
        let owned = || cloud.subdomain.owned();
        let all = || owned().map(|point| bonds.incidence.at(point).len());
        let sizes = || all().filter(|size| !is_far(size));
        let mut ends = [sizes().min(), sizes().max()].map(|it| it.unwrap_or_default() as f64);
        ends[0] = -ends[0];
        cloud.subdomain.all_reduce_max(&mut ends);
        Self {
            far_points: cloud.subdomain.count(all().filter(is_far).count()),
            volumetric_cells: system.volumetric.as_ref().map_or(0, |it| it.n_cells()),
            bonds: bonds.count(cloud),
            cut: count(cloud, absent, Absence::PreCrack),
            across_voids: count(cloud, absent, Absence::Void),
            across_layers: across_layers(cloud, bonds),
            of_points: [-ends[0], ends[1]].map(|it| it as usize),
        }
    }
}

/// Number of bonds that cross a material which neither of their ends has.
fn across_layers<const D: usize>(cloud: &PointCloud<D>, bonds: &BondSet<D>) -> usize {
    let across = bonds.composition.across_layers(&bonds.ends, cloud);
    let counted = across.filter(|&bond| cloud.subdomain.owns_bond(bonds.ends[bond]));
    cloud.subdomain.count(counted.count())
}

/// Numbers of points, bonds and pairs across voids after the search of bonds.
pub(crate) fn finding<const D: usize>(
    cloud: &PointCloud<D>,
    bonds: &BondSet<D>,
    absent: &[AbsentBond],
) -> Finding<'static> {
    Finding::Bonds {
        points: cloud.subdomain.n_all(),
        bonds: bonds.count(cloud),
        across_voids: count(cloud, absent, Absence::Void),
    }
}

/// Number of pairs of points that are not bonded for a reason.
fn count<const D: usize>(cloud: &PointCloud<D>, absent: &[AbsentBond], absence: Absence) -> usize {
    let counted = |it: &&AbsentBond| it.absence == absence && cloud.subdomain.owns_bond(it.ends);
    cloud.subdomain.count(absent.iter().filter(counted).count())
}

/// Smallest and largest Omega of the bonds of a body.
pub(crate) fn correction_range<const D: usize>(
    correction: &Correction,
    cloud: &PointCloud<D>,
) -> (f64, f64) {
    let (smallest, largest) = correction.domain_factor_range();
    (
        -cloud.subdomain.max(-smallest),
        cloud.subdomain.max(largest),
    )
}
