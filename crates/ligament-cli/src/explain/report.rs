//! An explanation as text.

use std::fmt::Display;
use std::io::{self, Write};

use ligament_model::Absence;
use ligament_output::quantity::{quantity, zero_if_rounding};
use ligament_output::results::stored::{StoredBreak, StoredRun, StoredStep};

use super::bond_history::{BondHistories, BondHistory};
use super::words::{self, angle, direction, label, metres, number, place};
use crate::lines::{self, Columns};

/// Writes the history of the bond between two points, or the reason why there is no bond.
pub(super) fn bond(
    out: &mut dyn Write,
    run: &StoredRun,
    [a, b]: [u32; 2],
    lives: &BondHistories,
) -> io::Result<()> {
    let title = format!("bond {} - {}", label(run, a), label(run, b));
    writeln!(out, "{title} in {}", run.folder.display())?;
    entry(out, "from", place(run, a))?;
    entry(out, "to", place(run, b))?;
    let Some(life) = lives.of_bonds.first() else {
        let pair = lives.absent.first().copied();
        return sentences(out, words::reasons_without_bond(run, [a, b], pair));
    };
    let length = metres(life.length);
    let along = match run.model.in_space {
        true => format!("along {}", direction(life)),
        false => format!("{:.2} degrees from x", angle(life)),
    };
    entry(out, "length", format!("{length}, {along}"))?;
    let [h_a, h_b] = [a, b].map(|end| metres(run.model.horizon[end as usize]));
    let bonds = &run.model.bonds;
    let horizon = metres(bonds.horizon[life.pair]);
    let horizons = format!("{horizon} (its ends have {h_a} and {h_b})");
    entry(out, "bond horizon H", horizons)?;
    let [alpha, omega] = [&bonds.length_factor, &bonds.domain_factor].map(|it| it[life.pair]);
    entry(out, "alpha, Omega", format!("{alpha:.5}, {omega:.5}"))?;
    for (name, _) in bonds.interfaces.iter().filter(|it| it.1[life.pair]) {
        entry(
            out,
            "interface",
            format!("crosses {name}, whose strengths its limits have"),
        )?;
    }
    for (name, words) in words::limits(&lives.criteria, life.bond) {
        entry(out, &name, words)?;
    }
    writeln!(out, "what happened")?;
    sentences(out, words::bond_description(run, lives, life))?;
    missing(out, run, lives)?;
    write_path(out, lives, &bond_path(lives, life))
}

/// Writes the family of a point; `sought` is the position, if any, to which the point is nearest.
pub(super) fn family(
    out: &mut dyn Write,
    run: &StoredRun,
    point: u32,
    sought: Option<[f64; 3]>,
    lives: &BondHistories,
) -> io::Result<()> {
    let model = &run.model;
    writeln!(out, "{} in {}", label(run, point), run.folder.display())?;
    let position = model.positions[point as usize];
    let words = words::coordinates(run, position);
    entry(out, "position", format!("{words} m"))?;
    if let Some(sought) = sought {
        let distance = metres(words::distance(position, sought));
        let words = format!("{} m, {distance} from it", words::coordinates(run, sought));
        entry(out, "nearest to", words)?;
    }
    let volume = quantity(model.volumes[point as usize], "m^3");
    entry(out, "volume", volume)?;
    entry(out, "horizon", metres(model.horizon[point as usize]))?;
    entry(out, "bonds", counts(run, lives))?;
    if model.no_fail[point as usize] {
        entry(out, "no_fail", "its bonds never fail")?;
    }
    missing(out, run, lives)?;
    writeln!(
        out,
        "bonds in the order of breaking, then by largest utilisation"
    )?;
    family_table(run, point, lives).write(out)?;
    write_path(out, lives, &family_path(run, point, lives))
}

fn entry(out: &mut dyn Write, name: &str, words: impl Display) -> io::Result<()> {
    lines::entry(out, 17, name, words)
}

fn sentences(out: &mut dyn Write, sentences: Vec<String>) -> io::Result<()> {
    (sentences.iter()).try_for_each(|sentence| writeln!(out, "  {sentence}"))
}

/// Text of the numbers of broken bonds and of absent bonds.
fn counts(run: &StoredRun, lives: &BondHistories) -> String {
    let n_bonds = lives.of_bonds.len();
    let broken = lives.of_bonds.iter();
    let broken = broken.filter_map(|it| Some(&it.breakage.as_ref()?.0));
    let mut broken: Vec<&StoredBreak> = broken.collect();
    broken.sort_by_key(|it| it.order);
    let number = |it: &StoredBreak| match lives.loading.in_time {
        true => format!("{} ({})", it.order, quantity(it.at.load_factor, "s")),
        false => format!("{} (step {})", it.order, it.at.step),
    };
    let mut words = match broken.as_slice() {
        [first, ..] => format!(
            "{n_bonds}: {} broke, from number {} to number {} of {}",
            broken.len(),
            number(first),
            number(broken[broken.len() - 1]),
            run.breaks.len()
        ),
        _ => format!("{n_bonds}, all intact"),
    };
    for (absence, why) in [
        (Absence::PreCrack, "cut by a pre-crack"),
        (Absence::Void, "across a void"),
    ] {
        let is_so = |pair: &&usize| run.model.bonds.absence[**pair] == Some(absence);
        let count = lives.absent.iter().filter(is_so).count();
        if count > 0 {
            words += &format!("; beside them {count} {why}");
        }
    }
    words
}

/// Writes notes about results that the run does not have, and settings that provide them.
fn missing(out: &mut dyn Write, run: &StoredRun, lives: &BondHistories) -> io::Result<()> {
    for note in words::missing(run, lives) {
        writeln!(out, "note: {note}")?;
    }
    Ok(())
}

/// Writes a table with a row for each stored step.
fn write_path(out: &mut dyn Write, lives: &BondHistories, rows: &Columns) -> io::Result<()> {
    let when = match (lives.loading.in_time, lives.loading.follows_path) {
        (true, _) => "times with fields",
        (false, true) => "events with fields, just before their bonds break",
        (false, false) => "steps with fields, at their end",
    };
    writeln!(out, "path ({when})")?;
    rows.write(out)
}

/// Names of the columns of [`load`].
fn load_header(lives: &BondHistories) -> Vec<String> {
    let names = match lives.loading.in_time {
        true => ["row", "time", "displacement", "reaction"],
        false => ["step", "load factor", "displacement", "reaction"],
    };
    names.map(str::to_owned).to_vec()
}

/// Cells of the load of a stored step; values negligible beside the largest of all stored steps are zero.
fn load(stored_step: &StoredStep, lives: &BondHistories) -> Vec<String> {
    let shown = |of: fn(&StoredStep) -> f64, unit: &str| {
        let sizes = lives.stored_steps.iter().map(|it| of(it).abs());
        quantity(
            zero_if_rounding(of(stored_step), sizes.fold(0.0, f64::max)),
            unit,
        )
    };
    vec![
        if stored_step.at_rest {
            stored_step.step.to_string()
        } else {
            format!("{} (not converged)", stored_step.step)
        },
        match lives.loading.in_time {
            true => shown(|it| it.load_factor, "s"),
            false => format!("{:.6}", stored_step.load_factor),
        },
        shown(|it| it.displacement, lives.loading.units.displacement),
        shown(|it| it.reaction, lives.loading.units.force),
    ]
}

/// Deformation and utilisations of a bond over the stored steps.
fn bond_path(lives: &BondHistories, life: &BondHistory) -> Columns {
    let mut header = load_header(lives);
    let names: &[&str] = match lives.components {
        strains @ [_, _, _] => strains,
        _ => &["stretch", "sliding"],
    };
    header.extend(names.iter().map(|it| (*it).to_owned()));
    for (name, criterion) in &lives.criteria {
        header.push(name.clone());
        if !criterion.after.is_brittle() {
            header.extend(["mu", "omega"].map(|it| format!("{it} {name}")));
        }
    }
    let mut table = Columns::new(header);
    for (stored_step, state) in lives.stored_steps.iter().zip(&life.states) {
        let mut row = load(stored_step, lives);
        let values = state.deformation.strains().into_iter();
        row.extend(values.take(names.len()).map(number));
        for ((_, criterion), it) in lives.criteria.iter().zip(&state.of_criteria) {
            row.push(match state.is_intact {
                true => format!("{:.4}", it.utilisation),
                false => "broken".to_owned(),
            });
            if !criterion.after.is_brittle() {
                let left = [it.softened.force, it.softened.secant];
                row.extend(left.map(|it| format!("{it:.4}")));
            }
        }
        table.push(row);
    }
    table
}

/// Table of all bonds of a point: broken bonds in the order of breaking, then intact bonds, those nearest to breakage first.
fn family_table(run: &StoredRun, point: u32, lives: &BondHistories) -> Columns {
    let bonds = &run.model.bonds;
    let mut header = vec![run.model.tagged.to_owned()];
    let in_space = run.model.in_space;
    let along = if in_space { "direction" } else { "angle" };
    header.extend(["length", along, "H", "alpha", "Omega"].map(str::to_owned));
    header.extend(lives.criteria.iter().map(|it| format!("limit {}", it.0)));
    let in_step = if lives.loading.in_time {
        "in row"
    } else {
        "in step"
    };
    header.extend(["largest", in_step, "by", "fate"].map(str::to_owned));
    let mut table = Columns::new(header);
    let mut order: Vec<&BondHistory> = lives.of_bonds.iter().collect();
    let number_of_breakage = |life: &BondHistory| {
        let broke = life.breakage.as_ref().map(|(it, _)| it.order);
        broke.unwrap_or(usize::MAX)
    };
    let largest = |life: &BondHistory| life.nearest.map_or(0.0, |it| it.utilisation);
    order.sort_by(|one, other| {
        (number_of_breakage(one).cmp(&number_of_breakage(other)))
            .then(largest(other).total_cmp(&largest(one)))
    });
    for life in order {
        let mut row = vec![
            run.model.tags[other_end(life.ends, point)].to_string(),
            metres(life.length),
            match in_space {
                true => direction(life),
                false => format!("{:.2}", angle(life)),
            },
            metres(bonds.horizon[life.pair]),
            format!("{:.5}", bonds.length_factor[life.pair]),
            format!("{:.5}", bonds.domain_factor[life.pair]),
        ];
        row.extend((lives.criteria.iter()).map(|it| number(it.1.limit[life.bond])));
        row.extend(match life.nearest.filter(|it| it.utilisation > 0.0) {
            Some(nearest) => [
                format!("{:.4}", nearest.utilisation),
                nearest.step.to_string(),
                lives.criteria[nearest.criterion].0.clone(),
            ],
            None => ["0", "-", "-"].map(str::to_owned),
        });
        row.push(words::short_bond_description(run, lives, life));
        table.push(row);
    }
    table
}

fn other_end([a, b]: [u32; 2], point: u32) -> usize {
    (if a == point { b } else { a }) as usize
}

/// Table of the number of intact bonds, damage and the bond nearest to breakage over the stored steps.
fn family_path(run: &StoredRun, point: u32, lives: &BondHistories) -> Columns {
    let tagged = run.model.tagged;
    let mut header = load_header(lives);
    header.extend(["intact", "damage", "largest"].map(str::to_owned));
    header.extend([format!("to {tagged}"), "by".to_owned()]);
    let mut table = Columns::new(header);
    let steps = lives.stored_steps.iter().zip(&lives.damage).enumerate();
    for (place, (stored_step, damage)) in steps {
        let intact = || (lives.of_bonds.iter()).filter(|life| life.states[place].is_intact);
        let step = stored_step.step;
        let largest = intact().filter_map(|life| Some((life.largest_in(place, step)?, life)));
        let worst = largest
            .filter(|it| it.0.utilisation > 0.0)
            .reduce(|one, other| match other.0.utilisation > one.0.utilisation {
                true => other,
                false => one,
            });
        let mut row = load(stored_step, lives);
        row.push(intact().count().to_string());
        row.push(format!("{damage:.4}"));
        row.extend(match worst {
            Some((it, life)) => [
                format!("{:.4}", it.utilisation),
                run.model.tags[other_end(life.ends, point)].to_string(),
                lives.criteria[it.criterion].0.clone(),
            ],
            None => ["0", "-", "-"].map(str::to_owned),
        });
        table.push(row);
    }
    table
}
