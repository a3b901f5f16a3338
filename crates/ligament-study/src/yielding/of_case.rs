//! Model, criteria and Poisson's ratio of a case, for its families of bonds.

use ligament_model::failure::Criteria;

use super::error::YieldError;
use super::request::Request;
use ligament_case::case::CaseFile;
use ligament_run::model::{Model, build_model_in_plane};
use ligament_run::progress::{Progress, ProgressMode};
use ligament_run::stages::Stages;

/// Builds the model of a case; refuses laws whose bonds' strains do not depend on their direction.
pub(super) fn model(case: &CaseFile) -> anyhow::Result<Model> {
    let law = case.case.model.law.row;
    if law.has_own_strains() {
        return Err(YieldError::NoDirections { law: law.word }.into());
    }
    let progress = Progress::new(ProgressMode::Quiet);
    build_model_in_plane(case, &mut Stages::default(), &progress)
}

/// The criteria with their names: the criteria of the request, or each criterion of the case and, if there are several, their combination.
pub(super) fn criteria(
    request: &Request,
    model: &Model,
) -> anyhow::Result<Vec<(String, Criteria)>> {
    let n_bonds = model.system.ends.len();
    if !request.combinations.is_empty() {
        let values = poisson(request, model)?;
        let first = values[0];
        if values.iter().any(|it| *it != first) {
            let which = "several Poisson's ratios";
            return Err(YieldError::NoPoisson { which }.into());
        }
        let strengths = request.strengths(first);
        let of = request.combinations.iter().map(|combination| {
            let criteria = combination.criteria(&strengths, n_bonds)?;
            Ok((combination.name().to_owned(), criteria))
        });
        return of.collect();
    }
    let list = &model.criteria.list;
    if list.is_empty() {
        return Err(YieldError::NoCriteria.into());
    }
    if let Some(of_stress) = list.iter().find(|it| it.measure.takes_stress()) {
        let criterion = of_stress.name;
        return Err(YieldError::OfStress { criterion }.into());
    }
    let mut found: Vec<(String, Criteria)> = Vec::new();
    for criterion in list {
        // Criteria of the same kind keep their order in the case.
        let before = found
            .iter()
            .filter(|(name, _)| name.starts_with(criterion.name))
            .count();
        let name = match before {
            0 => criterion.name.to_owned(),
            n => format!("{} {}", criterion.name, n + 1),
        };
        let list = vec![criterion.clone()];
        found.push((name, Criteria { list }));
    }
    if list.len() > 1 {
        found.push(("first of all".to_owned(), Criteria::clone(&model.criteria)));
    }
    Ok(found)
}

/// Poisson's ratio in the plane at each point (n_points), the mean over its materials.
pub(super) fn poisson(request: &Request, model: &Model) -> Result<Vec<f64>, YieldError> {
    let cloud = &model.plane().cloud;
    if let Some(poisson) = request.poisson {
        return Ok(vec![poisson; cloud.len()]);
    }
    let setup = &model.setup;
    let of_materials: Option<Vec<f64>> = (setup.materials.iter())
        .map(|region| {
            let constants = setup.law.constants(&region.material, setup.space())?;
            Some(constants.in_plane(setup.plane()).poisson)
        })
        .collect();
    let which = "an orthotropic material";
    let of_materials = of_materials.ok_or(YieldError::NoPoisson { which })?;
    if let [only] = of_materials[..] {
        return Ok(vec![only; cloud.len()]);
    }
    let at = |point| cloud.mean_property(point, &of_materials);
    Ok((0..cloud.len()).map(at).collect())
}
