//! Horizons, one radius per point.

/// Relative tolerance of the comparison of lengths, as of a bond with a horizon.
///
/// On a regular lattice the neighbour at exactly lambda times the spacing belongs to the family; rounding must not decide about it. The
/// arithmetic rounds to 1e-16. Given coordinates are known to single precision at best, and
/// [`PointCloud::tolerance`](crate::PointCloud::tolerance) is larger by their uncertainty.
pub const INCLUSION_TOLERANCE: f64 = 1e-9;

/// Horizon radius of each point.
#[derive(Debug, Clone, PartialEq)]
pub struct Horizons {
    /// Radii h_i, shape (n_points), m.
    pub radius: Vec<f64>,
}

impl Horizons {
    /// Horizons h_i = lambda dmin_i (NHPD section 2.1): `factor` lambda >= 1 times the distance to the nearest point (n_points), m.
    pub fn from_spacing(spacing: &[f64], factor: f64) -> Self {
        Self {
            radius: spacing.iter().map(|nearest| factor * nearest).collect(),
        }
    }

    /// Horizons of one radius (m) for all `n_points` points.
    pub fn unified(radius: f64, n_points: usize) -> Self {
        Self {
            radius: vec![radius; n_points],
        }
    }
}
