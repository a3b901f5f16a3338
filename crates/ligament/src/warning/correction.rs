//! Points at which a correction is worst.

use ligament_model::ConstantFields;
use ligament_model::subdomain::Subdomain;

/// The last point with the largest of some values, by its number in the body, and the value.
pub(super) struct Worst {
    pub(super) point: u32,
    pub(super) value: f64,
}

impl Worst {
    /// The worst point of all processes; collective.
    pub(super) fn new(subdomain: &Subdomain, value: impl Fn(u32) -> f64) -> Self {
        let owned = subdomain.owned().map(|point| (point, value(point)));
        let largest = owned.max_by(|one, other| one.1.total_cmp(&other.1));
        let row = largest.map(|(point, value)| [-value, -f64::from(subdomain.number(point))]);
        let [value, number] = subdomain.all_reduce_min(row).unwrap_or_default();
        Self {
            point: -number as u32,
            value: -value,
        }
    }
}

/// Number of points whose energies differ from the energy of the continuum by more than a tolerance under a strain along an axis, and the
/// worst of them; collective.
pub(super) fn off_energies(
    subdomain: &Subdomain,
    fixed: &ConstantFields,
    (n_axes, tolerance): (usize, f64),
) -> (usize, Worst) {
    let error = |point: u32| {
        let along_axes = fixed.energy_ratios[..n_axes].iter();
        let errors = along_axes.map(|it| (it.at_points[point as usize] - 1.0).abs());
        errors.fold(0.0, f64::max)
    };
    let owned = subdomain.owned();
    let off = owned.filter(|&point| error(point) > tolerance).count();
    (subdomain.count(off), Worst::new(subdomain, error))
}
