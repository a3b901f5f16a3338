//! Numbers of the bonds of a whole body, summed over the processes.

use ligament_model::{Absence, AbsentBond, BondSet, PointCloud};

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
    /// Smallest and largest number of bonds of a point.
    pub of_points: [usize; 2],
}

impl BondCounts {
    /// Counts the bonds between the points of a cloud and the pairs of points that are not bonded.
    pub fn new<const D: usize>(
        cloud: &PointCloud<D>,
        bonds: &BondSet<D>,
        absent: &[AbsentBond],
    ) -> Self {
        let sizes = cloud.over_families(|point| [bonds.incidence.at(point).len() as f64]);
        let sizes = || sizes.iter().map(|[size]| *size as usize);
        Self {
            bonds: bonds.count(cloud),
            cut: count(cloud, absent, Absence::PreCrack),
            across_voids: count(cloud, absent, Absence::Void),
            across_layers: across_layers(cloud, bonds),
            of_points: [sizes().min(), sizes().max()].map(Option::unwrap_or_default),
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
        points: cloud.len(),
        bonds: bonds.count(cloud),
        across_voids: count(cloud, absent, Absence::Void),
    }
}

/// Number of pairs of points that are not bonded for a reason.
fn count<const D: usize>(cloud: &PointCloud<D>, absent: &[AbsentBond], absence: Absence) -> usize {
    let counted = |it: &&AbsentBond| it.absence == absence && cloud.subdomain.owns_bond(it.ends);
    cloud.subdomain.count(absent.iter().filter(counted).count())
}
