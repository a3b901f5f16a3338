//! Warnings about the rings around tips of cracks.

use ligament_analysis::Message;
use ligament_model::ConstantFields;

use crate::body::Body;
use crate::setup::{Reading, Setup};

/// Horizons around a tip within which bonds smear its field.
const SMEARED: f64 = 2.0;

/// Relative rounding of a radius that is meant to be two horizons.
const ROUNDING: f64 = 1e-9;

/// Warning about the first ring that begins within two horizons from its tip; on one process.
pub(super) fn of_rings(setup: &Setup, body: &dyn Body, fixed: &ConstantFields) -> Option<Message> {
    setup.probes.iter().find_map(|probe| {
        let Reading::Tip {
            position,
            radii: Some([inner, _]),
            ..
        } = probe.reading
        else {
            return None;
        };
        let distance = |point: usize| {
            let place = body.position(point as u32);
            let squares = place.iter().zip(position).map(|(a, b)| (a - b).powi(2));
            squares.sum::<f64>()
        };
        let points = 0..fixed.horizon.len();
        let nearest = points.min_by(|a, b| distance(*a).total_cmp(&distance(*b)))?;
        let smeared = SMEARED * fixed.horizon[nearest];
        (inner < smeared * (1.0 - ROUNDING)).then(|| {
            let text = format!(
                "the ring of the probe `{}` begins {inner:e} m from the tip, within two horizons ({smeared:e} m), where the bonds smear the field",
                probe.name
            );
            let advice = "take larger `radii` or a smaller horizon, or compare with another ring";
            Message::new("ring-near-tip", text).with_advice(advice)
        })
    })
}
