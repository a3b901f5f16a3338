//! Descriptions of bonds and their breakage.

use ligament_model::Absence;
use ligament_model::element::BondDeformation;
use ligament_model::failure::{Criterion, Measure, Softened};
use ligament_output::quantity::quantity;
use ligament_output::results::stored::{StoredBreak, StoredRun, StoredStep};

use super::bond_history::{BondHistories, BondHistory, LargestUtilisation};

/// Text of a number without a unit.
pub(super) fn number(value: f64) -> String {
    quantity(value, "-")
}

/// Text of a length (m).
pub(super) fn metres(value: f64) -> String {
    quantity(value, "m")
}

/// Direction of a bond in space, as cosines from its first to its second end.
pub(super) fn direction(life: &BondHistory) -> String {
    let [x, y, z] = life.direction.map(|it| format!("{it:.3}"));
    format!("({x}, {y}, {z})")
}

/// Direction of a bond in the plane, degrees above -90 up to 90.
pub(super) fn angle(life: &BondHistory) -> f64 {
    let [a, b, _] = life.direction;
    let angle = b.atan2(a).to_degrees();
    if angle > 90.0 {
        angle - 180.0
    } else if angle <= -90.0 {
        angle + 180.0
    } else {
        angle
    }
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
fn began_by_stress(criteria: &[(String, Criterion)], name: &str, bond: usize) -> Option<bool> {
    const AT_ONCE: &str = "-at-once";
    let name = name.strip_suffix(AT_ONCE).unwrap_or(name);
    let mut names = criteria.iter().map(|it| it.0.strip_suffix(AT_ONCE));
    let mut finite = criteria.iter().filter(|it| it.1.limit[bond].is_finite());
    let can_fail = finite.clone().next().is_some();
    (can_fail && names.any(|it| it == Some(name)))
        .then(|| finite.any(|it| !it.1.after.is_brittle()))
}

/// The limits of a bond, each with the criterion's name and a description.
pub(super) fn limits(criteria: &[(String, Criterion)], bond: usize) -> Vec<(String, String)> {
    let in_words = |name: &str, criterion: &Criterion| {
        let what = criterion.measure.words();
        let names = criterion.measure.coefficient_names().iter();
        let coefficient: String = (names.zip(criterion.coefficients(bond)))
            .map(|(name, &value)| format!(", {name} = {}", number(value)))
            .collect();
        let limit = criterion.limit[bond];
        if limit.is_infinite() {
            return match began_by_stress(criteria, name, bond) {
                Some(true) => "no longer counts: the bond began to soften".to_owned(),
                Some(false) => format!("has not begun to soften by its {what}{coefficient}"),
                None => format!("never fails by its {what}{coefficient}"),
            };
        }
        let at = format!("{what} = {}{coefficient}", number(limit));
        let (after, end) = (&criterion.after, criterion.break_limit(bond));
        if after.is_brittle() {
            format!("breaks at {at}")
        } else if end.is_infinite() {
            format!("softens ({}) from {at}, never breaks", after.word())
        } else {
            format!(
                "softens ({}) from {at}, breaks at {}",
                after.word(),
                number(end)
            )
        }
    };
    let each = criteria.iter();
    each.map(|(name, criterion)| (name.clone(), in_words(name, criterion)))
        .collect()
}

/// When a bond broke.
fn when(lives: &BondHistories, broke: &StoredBreak) -> String {
    match lives.loading.in_time {
        true => {
            let time = quantity(broke.at.load_factor, "s");
            format!("after {time}, in time step {}", broke.round)
        }
        false => format!("in step {}, round {}", broke.at.step, broke.round),
    }
}

/// The load of a state, in a motion without its factor, which is the time.
fn load_words(lives: &BondHistories, at: &StoredStep) -> String {
    let load = match lives.loading.in_time {
        true => "Load:".to_owned(),
        false => format!("Load factor {:.6},", at.load_factor),
    };
    let displacement = quantity(at.displacement, lives.loading.units.displacement);
    let reaction = quantity(at.reaction, lives.loading.units.force);
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
        if let Some((name, criterion)) = criterion.map(|criterion| &lives.criteria[criterion]) {
            let [measure, limit] = at_breakage(criterion, life.bond, broke);
            lines.push(format!(
                "`{name}` measured {} = {}, {:.4} times the limit {}.",
                criterion.measure.words(),
                number(measure),
                broke.utilisation,
                number(limit),
            ));
            lines.extend(plane_words(life, criterion, broke.utilisation));
        }
        lines.push(format!(
            "Deformation at breakage: {}.",
            deformed(lives, &broke.deformation)
        ));
        lines.push(load_words(lives, &broke.at));
        return lines;
    }
    if lives.criteria.is_empty() {
        return vec!["It is intact: nothing fails in an elastic analysis.".to_owned()];
    }
    if is_free(lives, life) {
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

/// The measure of a bond that broke by a criterion, and the limit that it had then.
fn at_breakage(criterion: &Criterion, bond: usize, broke: &StoredBreak) -> [f64; 2] {
    let measure = criterion.measure;
    // The table of broken bonds has neither stresses around bonds nor rotations of their ends.
    let measured = match measure.takes_stress() || measure.takes_rotations() {
        true => broke.utilisation * criterion.break_limit(bond),
        false => criterion.measure(bond, &broke.deformation),
    };
    [measured, measured / broke.utilisation]
}

/// Whether a bond has no limit.
fn is_free(lives: &BondHistories, life: &BondHistory) -> bool {
    let mut criteria = lives.criteria.iter();
    criteria.all(|(_, criterion)| criterion.limit[life.bond].is_infinite())
}

/// The stress on the plane across a bond that a criterion of stress broke, and the failure surface that it reached.
fn plane_words(life: &BondHistory, criterion: &Criterion, utilisation: f64) -> Option<String> {
    let limit = criterion.limit[life.bond];
    let of_limit = |share: f64, modulus: f64| quantity(share * limit * modulus, "Pa");
    let normal = match life.direction[2] == 0.0 {
        true => format!("at {:.2} degrees", angle(life)),
        false => direction(life),
    };
    let sees = |measure: Measure| criterion.measure == measure;
    if sees(Measure::NormalStress)
        && let &[.., modulus] = criterion.coefficients(life.bond)
    {
        let [stress, strength] = [utilisation, 1.0].map(|it| of_limit(it, modulus));
        return Some(format!(
            "This is sigma_n = {stress} on the plane across the bond, with the normal {normal}; the failure surface is sigma_n = \
             {strength}."
        ));
    }
    if sees(Measure::CoulombStress)
        && let &[.., modulus, slope] = criterion.coefficients(life.bond)
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
    let mut states = lives.stored_steps.iter().zip(&life.states);
    let state = states.find(|it| it.0.step == nearest.step);
    let seen = state.map(|(_, it)| format!(" ({})", deformed(lives, &it.deformation)));
    let row = run.step(nearest.step).filter(|_| lives.loading.in_time);
    let when = row.map(|it| format!("after {}", quantity(it.load_factor, "s")));
    format!(
        "It is intact: its largest utilisation was {:.4}, {}, by `{}`{}.",
        nearest.utilisation,
        when.unwrap_or_else(|| format!("in step {}", nearest.step)),
        lives.criteria[nearest.criterion].0,
        seen.unwrap_or_default()
    )
}

/// Description of an intact bond at the last stored step, if that is not the stored step nearest to its limit.
fn end_words(lives: &BondHistories, life: &BondHistory) -> Option<String> {
    let (stored_step, state) = (lives.stored_steps.last()?, life.states.last()?);
    let is_told = |it: LargestUtilisation| it.step == stored_step.step && it.utilisation > 0.0;
    if life.nearest.is_some_and(is_told) {
        return None;
    }
    let utilisations = state.of_criteria.iter().map(|it| it.utilisation);
    let largest = utilisations.fold(0.0, f64::max);
    let why = if largest == 0.0 && is_pressed(lives, &state.deformation) {
        ": it is compressed, which none of its criteria counts"
    } else {
        ""
    };
    let end = match lives.loading.in_time {
        true => quantity(stored_step.load_factor, "s"),
        false => format!("step {}", stored_step.step),
    };
    let deformed = deformed(lives, &state.deformation);
    Some(format!(
        "At the end ({end}) its utilisation is {largest:.4}{why} ({deformed})."
    ))
}

/// What is left of an unbroken bond beyond limits, at the last stored step, with the names of the criteria.
fn softened<'a>(
    lives: &'a BondHistories,
    life: &'a BondHistory,
) -> impl Iterator<Item = (&'a str, Softened)> {
    let last = life.states.last().into_iter();
    let of_criteria = last.flat_map(|state| lives.criteria.iter().zip(&state.of_criteria));
    let named = of_criteria.map(|((name, _), it)| (name.as_str(), it.softened));
    named.filter(|(_, softened)| *softened != Softened::SOUND)
}

/// Description of a softened bond, one sentence per criterion.
fn softened_words(lives: &BondHistories, life: &BondHistory) -> Vec<String> {
    let words = |(name, softened): (&str, Softened)| {
        format!(
            "It has softened by `{name}`: {:.4} of its force (mu) and {:.4} of its stiffness (omega) are left.",
            softened.force, softened.secant
        )
    };
    softened(lives, life).map(words).collect()
}

/// Short description of the breakage or the state of a bond.
pub(super) fn short_bond_description(
    run: &StoredRun,
    lives: &BondHistories,
    life: &BondHistory,
) -> String {
    let is_free = is_free(lives, life);
    let is_held = life.ends.iter().any(|end| run.model.no_fail[*end as usize]);
    let was_seen = life.nearest.is_some_and(|it| it.utilisation > 0.0);
    let is_pressed = (life.states.last()).is_some_and(|it| is_pressed(lives, &it.deformation));
    match &life.breakage {
        Some((broke, _)) => format!("broke, number {}", broke.order),
        None if lives.criteria.is_empty() => "intact".to_owned(),
        None if is_free && is_held => "intact: no_fail".to_owned(),
        None if is_free => "intact: no limit".to_owned(),
        None if !was_seen && is_pressed => "intact: compression".to_owned(),
        None => {
            let left = softened(lives, life).map(|(_, it)| it.force);
            let least = left.reduce(f64::min);
            least.map_or("intact".to_owned(), |mu| format!("softened: mu {mu:.3}"))
        }
    }
}

/// Notes about what the results do not tell, with settings that provide it.
pub(super) fn missing(run: &StoredRun, lives: &BondHistories) -> Vec<String> {
    let model = &run.model;
    let is_known = lives.criteria.is_empty() || model.largest.is_some();
    let measures = || lives.criteria.iter().map(|it| it.1.measure);
    let takes_stress = measures().any(Measure::takes_stress);
    let printed = [
        Measure::PrintedOpening,
        Measure::PrintedSliding,
        Measure::PrintedMixed,
    ];
    let mut largest = model.largest.iter();
    let is_old =
        takes_stress && !run.softened.is_empty() && largest.any(|it| it.began_in.is_empty());
    let (shown, all) = (lives.stored_steps.len(), run.history.len());
    let notes = [
        (
            !is_known && !model.is_in_pieces,
            "the run is incomplete; the largest utilisations are those of the steps with fields only".to_owned(),
        ),
        (
            !is_known && model.is_in_pieces,
            "several processes ran the case: the largest utilisations are those of the steps with fields only, and when a bond began to \
             soften is not known"
                .to_owned(),
        ),
        (
            is_old,
            "an earlier version wrote the results: limits are those of the end, also before a bond began to soften".to_owned(),
        ),
        (
            takes_stress && model.has_stiff_cells,
            "stresses around bonds are without what cells resist beside bonds, which the results do not have".to_owned(),
        ),
        (
            measures().any(|it| printed.contains(&it)),
            "limits and utilisations are those of the sound body; in the run limits followed the bonds that were left".to_owned(),
        ),
        (
            shown < all,
            format!("{shown} of {all} steps have fields; with `output.fields_every = 1` all have them"),
        ),
    ];
    let applicable = notes.into_iter().filter(|(applies, _)| *applies);
    applicable.map(|(_, note)| note).collect()
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

    fn limit_text(measure: Measure, limit: f64, after: AfterLimit) -> String {
        let coefficients: &[f64] = match measure {
            Measure::Friction => &[0.5],
            Measure::MixedModeY => &[0.25, 4.0, 2.0],
            _ => &[],
        };
        let criterion = Criterion {
            coefficient: coefficients.to_vec().into(),
            after,
            ..Criterion::brittle("", measure, vec![limit])
        };
        limits(&[("own".to_owned(), criterion)], 0).remove(0).1
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
