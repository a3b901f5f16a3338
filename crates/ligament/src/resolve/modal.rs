//! What a modal case asks for.

use ligament_analysis::modal::{ModalSettings, Rotations};
use ligament_analysis::{Component, Supports};
use ligament_model::{LumpedMass, PointCloud};

use super::boundary::place_name;
use super::places::Places;
use crate::body::Body;
use crate::case::{self, CaseError, CaseFile, Modal};

/// The supports on the points.
pub fn supports(
    case: &CaseFile,
    body: &dyn Body,
    cloud: &PointCloud,
) -> Result<Supports, CaseError> {
    let places = Places { case, body, cloud };
    let mut supports = Supports::none(cloud.len());
    for (index, support) in case.case.supports.iter().enumerate() {
        let points = places.points(&format!("support.{index}"), Some(&support.place))?;
        let held = &support.displacement;
        let components: Vec<Component> = [
            (Component::X, held.x),
            (Component::Y, held.y),
            (Component::Rotation, held.rotation),
        ]
        .into_iter()
        .filter_map(|(component, value)| value.map(|_| component))
        .collect();
        supports.hold(&place_name(&support.place, index), points, &components);
    }
    Ok(supports)
}

/// The masses of the points; every material of a modal case has a density.
pub fn mass(case: &CaseFile, cloud: &PointCloud) -> LumpedMass {
    let materials = case.case.materials.iter();
    let densities: Vec<f64> = materials.filter_map(|material| material.density).collect();
    LumpedMass::new(cloud, &densities)
}

/// Which modes, and how.
pub fn modal(modal: &Modal) -> ModalSettings {
    ModalSettings {
        modes: modal.modes as usize,
        rotations: match modal.rotations {
            case::Rotations::Auto => None,
            case::Rotations::Inertia => Some(Rotations::Inertia),
            case::Rotations::Massless => Some(Rotations::Massless),
        },
        tolerance: modal.tolerance,
    }
}
