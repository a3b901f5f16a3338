//! Energy dissipated by a crack through a model under its failure criteria, for comparison with the material's fracture energy.

use ligament_model::failure::Criterion;
use ligament_model::failure::crack_opening::CrackEnergy;

use crate::model::Model;

/// Energies of cracks that open along x, and along y, through a material of a model.
///
/// Only points count whose families are complete, of the one material, and free to break, so that surfaces, interfaces, far fields and parts
/// without failure do not contribute. `None` for solids, where there is no such point, without criteria, for bonds with strains of their own
/// (`mbb-pd`), whose criteria dissipate the fracture energy by definition, and where bonds break at once by the stress around them, which
/// an opening does not determine.
pub fn crack_energies(model: &Model, material: usize) -> Option<[CrackEnergy; 2]> {
    let system = model.system.of_dimension::<2>()?;
    let list = &model.criteria.list;
    let softens = |choice| {
        let mut of_choice = list.iter().filter(|it| it.choice == choice);
        of_choice.any(|it| it.starting().is_some())
    };
    let is_by_stress = |it: &Criterion| it.follows_stress() && !softens(it.choice);
    if list.is_empty() || list.iter().any(is_by_stress) {
        return None;
    }
    let cloud = &system.cloud;
    let rim = model.body().rim().into_iter().enumerate();
    // Tolerance of three times the machine epsilon: shares are quotients of volumes.
    let is_mixed = |point| cloud.shares(point)[material] < 1.0 - 3.0 * f64::EPSILON;
    let far = system.far.as_ref();
    let has_elements = |point| far.is_some_and(|it| it.volume(point as u32) > 0.0);
    let is_excluded = |(point, on_rim)| {
        on_rim || model.fixed.no_fail[point] || is_mixed(point) || has_elements(point)
    };
    let excluded: Vec<bool> = rim.map(is_excluded).collect();
    let whole = model.interior(&excluded);
    let along = |normal| CrackEnergy::for_normal(system, &model.criteria, &whole, normal);
    Some([along([1.0, 0.0])?, along([0.0, 1.0])?])
}

impl Model {
    /// Whether the family of each point is complete, shape (n_points): neither the point nor a neighbour is marked in `excluded`
    /// (n_points), such as the [rim](crate::Body::rim) of the body, and pre-cracks cut none of their bonds.
    pub fn interior(&self, excluded: &[bool]) -> Vec<bool> {
        let families = self.system.families();
        let is_whole = |point: u32| {
            let mut family = families.incidence.at(point).iter();
            !excluded[point as usize]
                && self.fixed.precrack_share[point as usize] == 0.0
                && !family.any(|&bond| excluded[families.neighbour(bond, point) as usize])
        };
        (0..self.system.n_points() as u32).map(is_whole).collect()
    }
}
