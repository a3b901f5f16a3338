//! An explanation as a table and as JSON.

use anyhow::Context;
use ligament_model::Absence;
use ligament_model::element::BondDeformation;
use ligament_output::csv::{Value, line};
use ligament_output::results::stored::StoredRun;
use serde_json::json;

use super::bond_history::{BondHistories, BondHistory};
use super::report::angle;

/// A table with one row per bond and step with fields.
pub(super) fn csv(run: &StoredRun, lives: &BondHistories) -> String {
    let tagged = run.model.tagged;
    let mut columns: Vec<String> = ["a", "b"].map(|end| format!("{tagged}_{end}")).to_vec();
    let loads = ["step", "load_factor", "displacement", "reaction", "intact"];
    columns.extend(loads.map(str::to_owned));
    columns.extend(lives.components.iter().map(|it| (*it).to_owned()));
    for criterion in &run.model.criteria {
        let of = |what: &str| format!("{what}.{}", criterion.name);
        columns.extend(["limit", "measure", "utilisation"].map(of));
        if criterion.after != "brittle" {
            columns.extend(["mu", "omega"].map(of));
        }
    }
    let columns: Vec<Value<'_>> = columns.iter().map(|it| it.as_str().into()).collect();
    let mut table = line(&columns);
    for life in &lives.of_bonds {
        let tags = life.ends.map(|end| run.model.tags[end as usize]);
        for (place, (stored_step, deformation)) in
            lives.stored_steps.iter().zip(&life.deformation).enumerate()
        {
            let is_intact = place < life.n_intact;
            let mut row: Vec<Value<'_>> = vec![
                tags[0].into(),
                tags[1].into(),
                stored_step.step.into(),
                stored_step.load_factor.into(),
                stored_step.displacement.into(),
                stored_step.reaction.into(),
                usize::from(is_intact).into(),
            ];
            let values = deformation.strains().into_iter();
            row.extend(values.take(lives.components.len()).map(Value::from));
            for criterion in 0..life.limits.len() {
                let limit = &life.limits[criterion];
                let utilisation = if is_intact {
                    life.utilisation(criterion, place)
                } else {
                    f64::NAN
                };
                let measure = life.measure(criterion, place);
                row.extend([limit.limit, measure, utilisation].map(Value::from));
                if !limit.after.is_brittle() {
                    let left = life.remaining_softened_state(criterion, &lives.stored_steps, place);
                    row.extend([left.force, left.secant].map(Value::from));
                }
            }
            table += &line(&row);
        }
    }
    table
}

/// Bonds with their limits, breakages and paths; infinite values are `null`.
pub(super) fn json(run: &StoredRun, lives: &BondHistories) -> anyhow::Result<String> {
    let tags = |ends: [u32; 2]| ends.map(|end| run.model.tags[end as usize]);
    let absent = lives.absent.iter().map(|pair| {
        let why = match run.model.bonds.absence[*pair] {
            Some(Absence::PreCrack) => "pre-crack",
            Some(Absence::Void) => "void",
            None => "none",
        };
        json!({"ends": tags(run.model.bonds.ends[*pair]), "absent": why})
    });
    let bonds = lives.of_bonds.iter().map(|life| bond(run, lives, life));
    let document = json!({
        "tagged": run.model.tagged,
        "bonds": bonds.collect::<Vec<_>>(),
        "no_bonds": absent.collect::<Vec<_>>(),
    });
    let text = serde_json::to_string_pretty(&document)
        .context("the explanation cannot be written as JSON")?;
    Ok(text + "\n")
}

fn bond(run: &StoredRun, lives: &BondHistories, life: &BondHistory) -> serde_json::Value {
    let bonds = &run.model.bonds;
    let breakage = life.breakage.as_ref().map(|(broke, _)| {
        let breakage = json!({
            "order": broke.order,
            "step": broke.at.step,
            "round": broke.round,
            "load_factor": broke.at.load_factor,
            "displacement": broke.at.displacement,
            "reaction": broke.at.reaction,
            "criterion": broke.criterion,
            "utilisation": broke.utilisation,
        });
        with_components(breakage, lives, &broke.deformation)
    });
    let nearest = life.nearest.map(|it| {
        json!({
            "utilisation": it.utilisation,
            "step": it.step,
            "criterion": life.limits[it.criterion].name,
        })
    });
    let path = lives.stored_steps.iter().zip(&life.deformation).enumerate();
    let path = path.map(|(place, (stored_step, deformation))| {
        let utilisation = (0..life.limits.len()).map(|it| life.utilisation(it, place));
        let stored_step = json!({
            "step": stored_step.step,
            "load_factor": stored_step.load_factor,
            "displacement": stored_step.displacement,
            "reaction": stored_step.reaction,
            "intact": place < life.n_intact,
            "utilisation": utilisation.collect::<Vec<f64>>(),
        });
        with_components(stored_step, lives, deformation)
    });
    let mut document = json!({
        "ends": life.ends.map(|end| run.model.tags[end as usize]),
        "length": life.length,
        "horizon": bonds.horizon[life.pair],
        "alpha": bonds.length_factor[life.pair],
        "omega": bonds.domain_factor[life.pair],
        "limits": limits(life),
        "breakage": breakage,
        "largest": nearest,
        "path": path.collect::<Vec<_>>(),
    });
    match run.model.in_space {
        true => document["direction"] = json!(life.direction),
        false => document["angle"] = json!(angle(life)),
    }
    document
}

/// The limits of a bond.
fn limits(life: &BondHistory) -> Vec<serde_json::Value> {
    let limits = life.limits.iter().map(|limit| {
        json!({
            "criterion": limit.name,
            "measure": limit.measure.word(),
            "limit": limit.limit,
            "coefficients": limit.coefficients,
            "after": limit.after.word(),
            "break_limit": limit.limit * limit.after.end(0),
        })
    });
    limits.collect()
}

/// Adds the components of a deformation to an object, by their names.
fn with_components(
    mut object: serde_json::Value,
    lives: &BondHistories,
    deformation: &BondDeformation,
) -> serde_json::Value {
    for (name, value) in lives.components.iter().zip(deformation.strains()) {
        object[*name] = json!(value);
    }
    object
}
