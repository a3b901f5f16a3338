//! An explanation as a table and as JSON.

use anyhow::Context;
use ligament_model::Absence;
use ligament_model::element::BondDeformation;
use ligament_output::csv::{Value, line};
use ligament_output::results::stored::StoredRun;
use serde_json::json;

use super::bond_history::{BondHistories, BondHistory};
use super::words::angle;

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
        for (stored_step, state) in lives.stored_steps.iter().zip(&life.states) {
            let mut row: Vec<Value<'_>> = vec![
                tags[0].into(),
                tags[1].into(),
                stored_step.step.into(),
                stored_step.load_factor.into(),
                stored_step.displacement.into(),
                stored_step.reaction.into(),
                usize::from(state.is_intact).into(),
            ];
            let values = state.deformation.strains().into_iter();
            row.extend(values.take(lives.components.len()).map(Value::from));
            for ((_, criterion), it) in lives.criteria.iter().zip(&state.of_criteria) {
                let utilisation = if state.is_intact {
                    it.utilisation
                } else {
                    f64::NAN
                };
                row.extend([it.limit, it.measure, utilisation].map(Value::from));
                if !criterion.after.is_brittle() {
                    row.extend([it.softened.force, it.softened.secant].map(Value::from));
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
            "criterion": lives.criteria[it.criterion].0,
        })
    });
    let path = lives.stored_steps.iter().zip(&life.states);
    let path = path.map(|(stored_step, state)| {
        let utilisation = state.of_criteria.iter().map(|it| it.utilisation);
        let stored_step = json!({
            "step": stored_step.step,
            "load_factor": stored_step.load_factor,
            "displacement": stored_step.displacement,
            "reaction": stored_step.reaction,
            "intact": state.is_intact,
            "utilisation": utilisation.collect::<Vec<f64>>(),
        });
        with_components(stored_step, lives, &state.deformation)
    });
    let mut document = json!({
        "ends": life.ends.map(|end| run.model.tags[end as usize]),
        "length": life.length,
        "horizon": bonds.horizon[life.pair],
        "alpha": bonds.length_factor[life.pair],
        "omega": bonds.domain_factor[life.pair],
        "limits": limits(lives, life.bond),
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
fn limits(lives: &BondHistories, bond: usize) -> Vec<serde_json::Value> {
    let limits = lives.criteria.iter().map(|(name, criterion)| {
        json!({
            "criterion": name,
            "measure": criterion.measure.word(),
            "limit": criterion.limit[bond],
            "coefficients": criterion.coefficients(bond),
            "after": criterion.after.word(),
            "break_limit": criterion.break_limit(bond),
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
