//! Points at which a correction is worst.

use ligament_model::ConstantFields;
use ligament_model::correction::DomainReport;
use ligament_model::subdomain::Subdomain;

use super::{ENERGY_TOLERANCE, Warning};
use crate::body::Body;

/// Warning about a patch correction whose equations are not met.
pub(super) fn not_met(
    (body, subdomain): (&dyn Body, &Subdomain),
    (left, residual): (f64, &[f64]),
    factor: Option<f64>,
) -> Warning {
    let (worst, largest) = last_largest(subdomain, |point| residual[point as usize]);
    Warning::NotMet {
        left,
        largest,
        worst: body.label(worst),
        position: body.position(worst).to_vec(),
        factor,
    }
}

/// Number in the body of the last point with the largest of some values, and the value; collective.
fn last_largest(subdomain: &Subdomain, value: impl Fn(u32) -> f64) -> (u32, f64) {
    let owned = subdomain.owned().map(|point| (point, value(point)));
    let largest = owned.max_by(|one, other| one.1.total_cmp(&other.1));
    let row = largest.map(|(point, value)| [-value, -f64::from(subdomain.number(point))]);
    let [value, number] = subdomain.all_reduce_min(row).unwrap_or_default();
    (-number as u32, -value)
}

/// Warning about a domain correction that did not converge.
pub(super) fn not_converged(
    (body, subdomain): (&dyn Body, &Subdomain),
    correction: &DomainReport,
    fixed: &ConstantFields,
) -> Warning {
    let along_axes = &fixed.energy_ratios[..body.position(0).len()];
    let error = |point: u32| {
        let errors = along_axes
            .iter()
            .map(|it| (it.at_points[point as usize] - 1.0).abs());
        errors.fold(0.0, f64::max)
    };
    let owned = subdomain.owned();
    let off = owned.filter(|&point| error(point) > ENERGY_TOLERANCE);
    let off = subdomain.count(off.count());
    let (worst, largest) = last_largest(subdomain, error);
    Warning::NotConverged {
        sweeps: correction.sweeps,
        last_change: correction.last_change,
        off,
        n_points: subdomain.n_all(),
        error: largest,
        worst: body.label(worst),
        position: body.position(worst).to_vec(),
    }
}
