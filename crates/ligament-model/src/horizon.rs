//! Horizons: one radius a point.

/// Relative tolerance of the comparison of a length with another one, as that of a bond with a horizon.
///
/// On a regular lattice the neighbour at exactly lambda times the spacing belongs to the family; rounding must not
/// decide about it. That of the arithmetic is 1e-16. Coordinates that were given are known to single precision at best, and
/// [`PointCloud::tolerance`](crate::PointCloud::tolerance) is larger by what that leaves open.
pub const INCLUSION_TOLERANCE: f64 = 1e-9;

/// The horizon radius of each point.
#[derive(Debug, Clone, PartialEq)]
pub struct Horizons {
    /// Radii h_i, shape (n_points), m.
    pub radius: Vec<f64>,
}

impl Horizons {
    /// h_i = lambda dmin_i (NHPD section 2.1): `factor` lambda >= 1 times the distance to the nearest point, (n_points), m.
    pub fn from_spacing(spacing: &[f64], factor: f64) -> Self {
        Self {
            radius: spacing.iter().map(|nearest| factor * nearest).collect(),
        }
    }

    /// Horizons of one radius (m) for all of `n_points` points.
    pub fn unified(radius: f64, n_points: usize) -> Self {
        Self {
            radius: vec![radius; n_points],
        }
    }
}
