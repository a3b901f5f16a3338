//! Descriptions of bonds and their breakage.

use ligament_model::Absence;
use ligament_model::element::BondDeformation;
use ligament_model::failure::{Measure, Softened};
use ligament_output::quantity::quantity;
use ligament_output::results::stored::{StoredBreak, StoredRun, StoredStep};

use super::bond_history::{BondHistories, BondHistory, LargestUtilisation, Limit};

/// Text of a number without a unit.
pub(super) fn number(value: f64) -> String {
    quantity(value, "-")
}

/// Text of a length (m).
pub(super) fn metres(value: f64) -> String {
    quantity(value, "m")
}

/// Description of a point: "node 12".
pub(super) fn label(run: &StoredRun, point: u32) -> String {
    format!("{} {}", run.model.tagged, run.model.tags[point as usize])
}

/// Text of a position, without z in the plane.
pub(super) fn coordinates(run: &StoredRun, [x, y, z]: [f64; 3]) -> String {
    match run.model.in_space {
        true => format!("({x:.6}, {y:.6}, {z:.6})"),
        false => format!("({x:.6}, {y:.6})"),
    }
}

/// Distance between two positions, m; z = 0 in the plane.
pub(super) fn distance(p: [f64; 3], q: [f64; 3]) -> f64 {
    (q[0] - p[0]).hypot(q[1] - p[1]).hypot(q[2] - p[2])
}

/// Description of a point, with its position.
pub(super) fn place(run: &StoredRun, point: u32) -> String {
    let position = coordinates(run, run.model.positions[point as usize]);
    format!("{} at {position} m", label(run, point))
}

fn deformed(lives: &BondHistories, deformation: &BondDeformation) -> String {
    let symbols: &[&str] = match lives.has_own_strains {
        true => &["S_xx", "S_xy", "S_yy"],
        false => &["s", "gamma"],
    };
    let values = symbols.iter().zip(deformation.strains());
    let words: Vec<String> = values
        .map(|(symbol, value)| format!("{symbol} = {}", number(value)))
        .collect();
    words.join(", ")
}

/// Whether a bond is shortened, or a normal strain of its own is negative.
fn is_pressed(lives: &BondHistories, deformation: &BondDeformation) -> bool {
    match lives.has_own_strains {
        true => deformation.strain()[..2].iter().any(|strain| *strain < 0.0),
        false => deformation.stretch() < 0.0,
    }
}

/// Whether a bond began to soften by the stress around it, for a criterion by which bonds begin or by which the others break at once; None for
/// other criteria, and for a bond that never fails.
fn began_by_stress(life: &BondHistory, limit: &Limit) -> Option<bool> {
    const AT_ONCE: &str = "-at-once";
    let name = limit.name.strip_suffix(AT_ONCE).unwrap_or(&limit.name);
    let mut names = life.limits.iter().map(|it| it.name.strip_suffix(AT_ONCE));
    let mut finite = life.limits.iter().filter(|it| it.limit.is_finite());
    let can_fail = finite.clone().next().is_some();
    (can_fail && names.any(|it| it == Some(name))).then(|| finite.any(|it| !it.after.is_brittle()))
}

/// The limits of a bond, each with the criterion's name and a description.
pub(super) fn limits(life: &BondHistory) -> Vec<(String, String)> {
    let in_words = |limit: &Limit| {
        let what = limit.measure.words();
        let names = limit.measure.coefficient_names().iter();
        let coefficient: String = (names.zip(&limit.coefficients))
            .map(|(name, &value)| format!(", {name} = {}", number(value)))
            .collect();
        if limit.limit.is_infinite() {
            return match began_by_stress(life, limit) {
                Some(true) => "no longer counts: the bond began to soften".to_owned(),
                Some(false) => format!("has not begun to soften by its {what}{coefficient}"),
                None => format!("never fails by its {what}{coefficient}"),
            };
        }
        let at = format!("{what} = {}{coefficient}", number(limit.limit));
        let end = limit.limit * limit.after.end(0);
        if limit.after.is_brittle() {
            format!("breaks at {at}")
        } else if end.is_infinite() {
            format!("softens ({}) from {at}, never breaks", limit.after.word())
        } else {
            let law = limit.after.word();
            format!("softens ({law}) from {at}, breaks at {}", number(end))
        }
    };
    let each = life.limits.iter();
    each.map(|limit| (limit.name.clone(), in_words(limit)))
        .collect()
}

/// When a bond broke.
fn when(lives: &BondHistories, broke: &StoredBreak) -> String {
    match lives.in_time {
        true => {
            let time = quantity(broke.at.load_factor, "s");
            format!("after {time}, in time step {}", broke.round)
        }
        false => format!("in step {}, round {}", broke.at.step, broke.round),
    }
}

/// The load of a state, in a motion without its factor, which is the time.
fn load_words(lives: &BondHistories, at: &StoredStep) -> String {
    let load = match lives.in_time {
        true => "Load:".to_owned(),
        false => format!("Load factor {:.6},", at.load_factor),
    };
    let displacement = quantity(at.displacement, lives.units.displacement);
    let reaction = quantity(at.reaction, lives.units.force);
    format!("{load} displacement {displacement}, reaction {reaction}.")
}

/// Description of the breakage or the state of a bond, one sentence per line.
pub(super) fn bond_description(
    run: &StoredRun,
    lives: &BondHistories,
    life: &BondHistory,
) -> Vec<String> {
    if let Some((broke, criterion)) = &life.breakage {
        let when = when(lives, broke);
        let mut lines = vec![format!(
            "It broke {when}, as number {} of {} broken bonds, by `{}`.",
            broke.order,
            run.breaks.len(),
            broke.criterion
        )];
        let deformation = broke.deformation;
        if let Some(limit) = criterion.map(|criterion| &life.limits[criterion]) {
            let end = limit.limit * limit.after.end(0);
            let seen = match limit.measure.takes_stress() {
                true => broke.utilisation * end,
                false => limit.measure(&deformation, None),
            };
            lines.push(format!(
                "`{}` measured {} = {}, {:.4} times the limit {}.",
                limit.name,
                limit.measure.words(),
                number(seen),
                broke.utilisation,
                number(end),
            ));
            lines.extend(plane_words(life, limit, broke.utilisation));
        }
        lines.push(format!(
            "Deformation at breakage: {}.",
            deformed(lives, &deformation)
        ));
        lines.push(load_words(lives, &broke.at));
        return lines;
    }
    if life.limits.is_empty() {
        return vec!["It is intact: nothing fails in an elastic analysis.".to_owned()];
    }
    if life.limits.iter().all(|limit| limit.limit.is_infinite()) {
        return vec![format!("It is intact: {}.", never_fails(run, life))];
    }
    let mut lines = Vec::new();
    match life.nearest.filter(|it| it.utilisation > 0.0) {
        Some(nearest) => lines.push(nearest_words(run, lives, life, nearest)),
        None => lines.push("It is intact: its utilisation was 0 throughout.".to_owned()),
    }
    lines.extend(end_words(lives, life));
    lines.extend(softened_words(lives, life));
    lines
}

/// The stress on the plane across a bond that a criterion of stress broke, and the failure surface that it reached.
fn plane_words(life: &BondHistory, limit: &Limit, utilisation: f64) -> Option<String> {
    let of_limit = |share: f64, modulus: f64| quantity(share * limit.limit * modulus, "Pa");
    let normal = words_of_normal(life);
    let sees = |measure: Measure| limit.measure == measure;
    if sees(Measure::NormalStress)
        && let &[.., modulus] = limit.coefficients.as_slice()
    {
        let [stress, strength] = [utilisation, 1.0].map(|it| of_limit(it, modulus));
        return Some(format!(
            "This is sigma_n = {stress} on the plane across the bond, with the normal {normal}; the failure surface is sigma_n = \
             {strength}."
        ));
    }
    if sees(Measure::CoulombStress)
        && let &[.., modulus, slope] = limit.coefficients.as_slice()
    {
        let [stress, cohesion] = [utilisation, 1.0].map(|it| of_limit(it, modulus));
        return Some(format!(
            "This is |tau| + {} sigma_n = {stress} on the plane across the bond, with the normal {normal}; the failure surface is the \
             cohesion {cohesion}.",
            number(slope)
        ));
    }
    None
}

/// The direction of a bond in words.
fn words_of_normal(life: &BondHistory) -> String {
    let [x, y, z] = life.direction;
    match z == 0.0 {
        true => format!("at {:.2} degrees", y.atan2(x).to_degrees()),
        false => format!("({x:.4}, {y:.4}, {z:.4})"),
    }
}

fn never_fails(run: &StoredRun, life: &BondHistory) -> String {
    let marked = life
        .ends
        .iter()
        .filter(|end| run.model.no_fail[**end as usize]);
    let marked: Vec<String> = marked.map(|end| label(run, *end)).collect();
    match marked.as_slice() {
        [] => "no criterion has a limit for its materials".to_owned(),
        [one] => format!("bonds of {one} never fail (`no_fail`)"),
        both => format!("bonds of {} never fail (`no_fail`)", both.join(" and ")),
    }
}

fn nearest_words(
    run: &StoredRun,
    lives: &BondHistories,
    life: &BondHistory,
    nearest: LargestUtilisation,
) -> String {
    let limit = &life.limits[nearest.criterion];
    let stored_step = lives
        .stored_steps
        .iter()
        .position(|it| it.step == nearest.step);
    let seen = stored_step.map(|stored_step| {
        let deformation = &life.deformation[stored_step];
        format!(" ({})", deformed(lives, deformation))
    });
    let row = run.step(nearest.step).filter(|_| lives.in_time);
    let when = row.map(|it| format!("after {}", quantity(it.load_factor, "s")));
    format!(
        "It is intact: its largest utilisation was {:.4}, {}, by `{}`{}.",
        nearest.utilisation,
        when.unwrap_or_else(|| format!("in step {}", nearest.step)),
        limit.name,
        seen.unwrap_or_default()
    )
}

/// Description of an intact bond at the last stored step, if that is not the stored step nearest to its limit.
fn end_words(lives: &BondHistories, life: &BondHistory) -> Option<String> {
    let (stored_step, deformation) = (lives.stored_steps.last()?, life.deformation.last()?);
    let is_told = |it: LargestUtilisation| it.step == stored_step.step && it.utilisation > 0.0;
    if life.nearest.is_some_and(is_told) {
        return None;
    }
    let last = lives.stored_steps.len() - 1;
    let largest = (0..life.limits.len()).map(|it| life.utilisation(it, last));
    let largest = largest.fold(0.0, f64::max);
    let why = if largest == 0.0 && is_pressed(lives, deformation) {
        ": it is compressed, which none of its criteria counts"
    } else {
        ""
    };
    let end = match lives.in_time {
        true => quantity(stored_step.load_factor, "s"),
        false => format!("step {}", stored_step.step),
    };
    let deformed = deformed(lives, deformation);
    Some(format!(
        "At the end ({end}) its utilisation is {largest:.4}{why} ({deformed})."
    ))
}

/// Softened state of a bond beyond limits, at the last stored step, with the names of the criteria.
fn softened<'a>(lives: &BondHistories, life: &'a BondHistory) -> Vec<(&'a str, Softened)> {
    let Some(last) = lives.stored_steps.len().checked_sub(1) else {
        return Vec::new();
    };
    let each = life.limits.iter().enumerate();
    each.map(|(criterion, limit)| {
        let softened = life.softened(criterion, &lives.stored_steps, last);
        (limit.name.as_str(), softened)
    })
    .filter(|(_, softened)| *softened != Softened::SOUND)
    .collect()
}

/// Description of a softened bond, one sentence per criterion.
fn softened_words(lives: &BondHistories, life: &BondHistory) -> Vec<String> {
    let words = |(name, softened): (&str, Softened)| {
        format!(
            "It has softened by `{name}`: {:.4} of its force (mu) and {:.4} of its stiffness (omega) are left.",
            softened.force, softened.secant
        )
    };
    softened(lives, life).into_iter().map(words).collect()
}

/// Short description of the breakage or the state of a bond.
pub(super) fn short_bond_description(
    run: &StoredRun,
    lives: &BondHistories,
    life: &BondHistory,
) -> String {
    let is_free = life.limits.iter().all(|limit| limit.limit.is_infinite());
    let is_held = life.ends.iter().any(|end| run.model.no_fail[*end as usize]);
    let was_seen = life.nearest.is_some_and(|it| it.utilisation > 0.0);
    let is_pressed = (life.deformation.last()).is_some_and(|it| is_pressed(lives, it));
    match &life.breakage {
        Some((broke, _)) => format!("broke, number {}", broke.order),
        None if life.limits.is_empty() => "intact".to_owned(),
        None if is_free && is_held => "intact: no_fail".to_owned(),
        None if is_free => "intact: no limit".to_owned(),
        None if !was_seen && is_pressed => "intact: compression".to_owned(),
        None => {
            let left = softened(lives, life).into_iter().map(|(_, it)| it.force);
            let least = left.reduce(f64::min);
            least.map_or("intact".to_owned(), |mu| format!("softened: mu {mu:.3}"))
        }
    }
}

/// Reasons why two points have no bond, one sentence per line.
pub(super) fn reasons_without_bond(
    run: &StoredRun,
    [a, b]: [u32; 2],
    pair: Option<usize>,
) -> Vec<String> {
    let model = &run.model;
    let [p, q] = [a, b].map(|end| model.positions[end as usize]);
    let distance = distance(p, q);
    let [h_a, h_b] = [a, b].map(|end| model.horizon[end as usize]);
    let mut lines = vec![format!(
        "Their distance is {}; the horizons are {} ({}) and {} ({}).",
        metres(distance),
        metres(h_a),
        label(run, a),
        metres(h_b),
        label(run, b)
    )];
    lines.push(match pair.and_then(|pair| model.bonds.absence[pair]) {
        Some(Absence::PreCrack) => {
            "No bond: a pre-crack cut it before the first load. It does not count as damage."
                .to_owned()
        }
        Some(Absence::Void) => {
            "No bond: a hole, slot, notch or crack of the mesh lies between them.".to_owned()
        }
        None => format!(
            "No bond: neither point lies in the horizon of the other; their bonds reach {}.",
            metres(h_a.max(h_b))
        ),
    });
    lines
}

#[cfg(test)]
mod tests {
    use ligament_model::failure::AfterLimit;
    use ligament_model::failure::softening::{brittle, linear, plastic};

    use super::*;
    use crate::explain::bond_history::life_of;

    fn limit_text(measure: Measure, limit: f64, after: AfterLimit) -> String {
        let coefficients: &[f64] = match measure {
            Measure::Friction => &[0.5],
            Measure::MixedModeY => &[0.25, 4.0, 2.0],
            _ => &[],
        };
        let limit = Limit {
            name: "own".to_owned(),
            measure,
            limit,
            coefficients: coefficients.to_vec(),
            after,
        };
        limits(&life_of(vec![limit], Vec::new())).remove(0).1
    }

    #[test]
    fn limits_in_words() {
        let bilinear = AfterLimit::new(linear::LAW, vec![4.0]);
        for (measure, limit, after, expected) in [
            (
                Measure::Tension,
                2e-4,
                AfterLimit::new(brittle::LAW, Vec::new()),
                "breaks at stretch s = 200.0e-6",
            ),
            (
                Measure::Friction,
                2e-4,
                AfterLimit::new(plastic::LAW, Vec::new()),
                "softens (plastic) from |gamma| + s tan(beta) = 200.0e-6, tan(beta) = 0.5000, never breaks",
            ),
            (
                Measure::Compression,
                2e-4,
                bilinear,
                "softens (linear) from shortening -s = 200.0e-6, breaks at 800.0e-6",
            ),
            (
                Measure::Sliding,
                f64::INFINITY,
                AfterLimit::new(brittle::LAW, Vec::new()),
                "never fails by its sliding |gamma|",
            ),
            (
                Measure::MixedModeY,
                1e-2,
                AfterLimit::new(brittle::LAW, Vec::new()),
                "breaks at sqrt(max(S_yy, 0)^2 + q S_xy^2) = 0.01000, q = 0.2500, G_IIc/G_Ic = 4.000, eta = 2.000",
            ),
        ] {
            assert_eq!(limit_text(measure, limit, after), expected);
        }
    }
}
