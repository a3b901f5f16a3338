//! The text of an explanation.

use std::ops::Add;

use ligament_model::Absence;
use ligament_output::results::stored::{StoredRun, StoredStep};

use ligament_output::columns::aligned;

use super::life::{Life, Lives};
use super::words::{self, label, number, place};
use ligament::units::Units;

/// An explanation.
pub(super) struct Text {
    /// Title: the bond or point that is explained.
    pub(super) title: String,
    /// All lines below the title.
    pub(super) body: String,
}

/// The life of the bond between two points, or why there is none.
pub(super) fn bond(run: &StoredRun, [a, b]: [u32; 2], lives: &Lives) -> Text {
    let title = format!("bond {} - {}", label(run, a), label(run, b));
    let mut lines = vec![entry("from", &place(run, a)), entry("to", &place(run, b))];
    let Some(life) = lives.of_bonds.first() else {
        let pair = lives.absent.first().copied();
        lines.extend(
            words::no_bond(run, [a, b], pair)
                .iter()
                .map(|it| indented(it)),
        );
        return text(title, lines);
    };
    let [h_a, h_b] = [a, b].map(|end| run.model.horizon[end as usize]);
    let bonds = &run.model.bonds;
    let measures = format!(
        "{} m, {:.2} degrees from x",
        number(life.length),
        angle(life)
    );
    lines.push(entry("length", &measures));
    let horizons = format!(
        "{} m (horizons of its ends {} and {} m)",
        number(bonds.horizon[life.pair]),
        number(h_a),
        number(h_b)
    );
    lines.push(entry("bond horizon H", &horizons));
    lines.push(entry(
        "alpha, Omega",
        &format!(
            "{:.5}, {:.5}",
            bonds.length_factor[life.pair], bonds.domain_factor[life.pair]
        ),
    ));
    let limits = words::limits(life).into_iter();
    lines.extend(limits.map(|(name, words)| entry(&name, &words)));
    lines.push("what happened".to_owned());
    lines.extend(words::fate(run, lives, life).iter().map(|it| indented(it)));
    lines.extend(missing(run, lives));
    lines.push(path_title(lives));
    lines.extend(in_columns(&bond_path(lives, life)));
    text(title, lines)
}

/// The family of a point, which may be the one nearest to a position.
pub(super) fn family(run: &StoredRun, point: u32, sought: Option<[f64; 2]>, lives: &Lives) -> Text {
    let model = &run.model;
    let title = label(run, point);
    let [x, y] = model.positions[point as usize];
    let mut lines = vec![entry("position", &format!("({x:.6}, {y:.6}) m"))];
    if let Some([at_x, at_y]) = sought {
        let distance = (at_x - x).hypot(at_y - y);
        let words = format!("({at_x:.6}, {at_y:.6}) m, {} m from it", number(distance));
        lines.push(entry("nearest to", &words));
    }
    let [volume, horizon] = [&model.volumes, &model.horizon].map(|it| it[point as usize]);
    lines.push(entry("volume", &format!("{} m^3", number(volume))));
    lines.push(entry("horizon", &format!("{} m", number(horizon))));
    lines.push(entry("bonds", &counts(run, lives)));
    if model.no_fail[point as usize] {
        lines.push(entry("no_fail", "its bonds never fail"));
    }
    lines.extend(missing(run, lives));
    lines.push("bonds, as they broke; then by their largest utilisation".to_owned());
    lines.extend(in_columns(&family_table(run, point, lives)));
    lines.push(path_title(lives));
    lines.extend(in_columns(&family_path(run, point, lives)));
    text(title, lines)
}

fn text(title: String, lines: Vec<String>) -> Text {
    let body = lines.join("\n");
    Text { title, body }
}

fn entry(name: &str, words: &str) -> String {
    format!("  {name:<16}  {words}")
}

fn indented(words: &str) -> String {
    format!("  {words}")
}

/// Direction of a bond, degrees above -90 up to 90.
pub(super) fn angle(life: &Life) -> f64 {
    let [a, b] = life.direction;
    let angle = b.atan2(a).to_degrees();
    if angle > 90.0 {
        angle - 180.0
    } else if angle <= -90.0 {
        angle + 180.0
    } else {
        angle
    }
}

/// How many bonds broke, and what else became of pairs.
fn counts(run: &StoredRun, lives: &Lives) -> String {
    let n_bonds = lives.of_bonds.len();
    let orders = lives.of_bonds.iter().filter_map(|life| {
        let (broke, _) = life.breakage.as_ref()?;
        Some((broke.order, broke.at.step))
    });
    let orders: Vec<(usize, usize)> = orders.collect();
    let mut words = format!("{n_bonds}");
    match (orders.iter().min(), orders.iter().max()) {
        (Some(first), Some(last)) => {
            words += &format!(
                ": {} broke, from number {} (step {}) to number {} (step {}) of {}",
                orders.len(),
                first.0,
                first.1,
                last.0,
                last.1,
                run.breaks.len()
            );
        }
        _ => words += ", all intact",
    }
    for (absence, why) in [
        (Absence::PreCrack, "cut by a pre-crack"),
        (Absence::Hole, "across a hole"),
    ] {
        let is_so = |pair: &&usize| run.model.bonds.absence[**pair] == Some(absence);
        let count = lives.absent.iter().filter(is_so).count();
        if count > 0 {
            words += &format!("; beside them {count} {why}");
        }
    }
    words
}

/// Lines on what the results leave out, and how to get it.
fn missing(run: &StoredRun, lives: &Lives) -> Vec<String> {
    let mut lines = Vec::new();
    let may_fail = !run.model.criteria.is_empty();
    if may_fail && run.model.largest.is_none() {
        lines.push(
            "note: the run did not get to its end; largest utilisations are those of steps with fields alone"
                .to_owned(),
        );
    }
    let (shown, all) = (lives.moments.len(), run.history.len());
    if shown < all {
        lines.push(format!(
            "note: {shown} of {all} steps have fields; for the others run again with --set output.fields_every=1"
        ));
    }
    lines
}

fn path_title(lives: &Lives) -> String {
    let when = if lives.before_breakages {
        "events with fields, just before their bonds break"
    } else {
        "steps with fields, at their end"
    };
    format!("path ({when})")
}

fn load_header(units: Units) -> Vec<String> {
    vec![
        "step".to_owned(),
        "load factor".to_owned(),
        format!("displacement {}", units.displacement),
        format!("reaction {}", units.force),
    ]
}

fn load(moment: &StoredStep) -> Vec<String> {
    vec![
        moment.step.to_string(),
        format!("{:.6}", moment.load_factor),
        number(moment.displacement),
        number(moment.reaction),
    ]
}

/// Deformation and utilisations of a bond over the moments.
fn bond_path(lives: &Lives, life: &Life) -> Vec<Vec<String>> {
    let mut header = load_header(lives.units);
    let names: &[&str] = match lives.components {
        strains @ [_, _, _] => strains,
        _ => &["stretch", "sliding"],
    };
    header.extend(names.iter().map(|it| (*it).to_owned()));
    for limit in &life.limits {
        header.push(limit.name.clone());
        if !limit.after.is_brittle() {
            header.extend(["mu", "omega"].map(|it| format!("{it} {}", limit.name)));
        }
    }
    let mut table = vec![header];
    for (place, (moment, deformation)) in lives.moments.iter().zip(&life.deformation).enumerate() {
        let mut row = load(moment);
        let values = deformation.strains().into_iter();
        row.extend(values.take(names.len()).map(number));
        for (criterion, limit) in life.limits.iter().enumerate() {
            let is_intact = place < life.n_intact;
            row.push(if is_intact {
                format!("{:.4}", limit.utilisation(deformation))
            } else {
                "broken".to_owned()
            });
            if !limit.after.is_brittle() {
                let softened = life.softened(criterion, &lives.moments, place);
                let value = |value: f64| if is_intact { value } else { 0.0 };
                row.extend([softened.force, softened.secant].map(|it| format!("{:.4}", value(it))));
            }
        }
        table.push(row);
    }
    table
}

/// All bonds of a point: those that broke in their order, then the nearest to breakage first.
fn family_table(run: &StoredRun, point: u32, lives: &Lives) -> Vec<Vec<String>> {
    let bonds = &run.model.bonds;
    let mut header = [
        run.model.tagged,
        "length m",
        "angle",
        "H m",
        "alpha",
        "Omega",
    ]
    .map(str::to_owned)
    .to_vec();
    header.extend(
        run.model
            .criteria
            .iter()
            .map(|it| format!("limit {}", it.name)),
    );
    header.extend(["largest", "in step", "by", "fate"].map(str::to_owned));
    let mut table = vec![header];
    let mut order: Vec<&Life> = lives.of_bonds.iter().collect();
    let number_of_breakage = |life: &Life| {
        let broke = life.breakage.as_ref().map(|(it, _)| it.order);
        broke.unwrap_or(usize::MAX)
    };
    let largest = |life: &Life| life.nearest.map_or(0.0, |it| it.utilisation);
    order.sort_by(|one, other| {
        (number_of_breakage(one).cmp(&number_of_breakage(other)))
            .then(largest(other).total_cmp(&largest(one)))
    });
    for life in order {
        let mut row = vec![
            run.model.tags[other_end(life.ends, point)].to_string(),
            number(life.length),
            format!("{:.2}", angle(life)),
            number(bonds.horizon[life.pair]),
            format!("{:.5}", bonds.length_factor[life.pair]),
            format!("{:.5}", bonds.domain_factor[life.pair]),
        ];
        row.extend(life.limits.iter().map(|it| number(it.limit)));
        row.extend(match life.nearest.filter(|it| it.utilisation > 0.0) {
            Some(nearest) => [
                format!("{:.4}", nearest.utilisation),
                nearest.step.to_string(),
                life.limits[nearest.criterion].name.clone(),
            ],
            None => ["0", "-", "-"].map(str::to_owned),
        });
        row.push(words::short_fate(run, lives, life));
        table.push(row);
    }
    table
}

fn other_end([a, b]: [u32; 2], point: u32) -> usize {
    (if a == point { b } else { a }) as usize
}

/// Intact bonds, damage and the bond nearest to breakage over the moments.
fn family_path(run: &StoredRun, point: u32, lives: &Lives) -> Vec<Vec<String>> {
    let tagged = run.model.tagged;
    let mut header = load_header(lives.units);
    header.extend(["intact", "damage", "largest"].map(str::to_owned));
    header.extend([format!("to {tagged}"), "by".to_owned()]);
    let mut table = vec![header];
    for (place, moment) in lives.moments.iter().enumerate() {
        let intact = || lives.of_bonds.iter().filter(|life| place < life.n_intact);
        let mut worst: Option<(f64, &Life, usize)> = None;
        for life in intact() {
            for (criterion, limit) in life.limits.iter().enumerate() {
                let utilisation = limit.utilisation(&life.deformation[place]);
                let is_worse = worst.is_none_or(|(so_far, ..)| utilisation > so_far);
                if utilisation > 0.0 && is_worse {
                    worst = Some((utilisation, life, criterion));
                }
            }
        }
        let mut row = load(moment);
        row.push(intact().count().to_string());
        row.push(format!("{:.4}", damage(run, lives, place)));
        row.extend(match worst {
            Some((utilisation, life, criterion)) => [
                format!("{utilisation:.4}"),
                run.model.tags[other_end(life.ends, point)].to_string(),
                life.limits[criterion].name.clone(),
            ],
            None => ["0", "-", "-"].map(str::to_owned),
        });
        table.push(row);
    }
    table
}

/// Share of the broken bonds in the sum of alpha Omega over all (NHPD eq. 17).
fn damage(run: &StoredRun, lives: &Lives, place: usize) -> f64 {
    let bonds = &run.model.bonds;
    let weight = |life: &Life| bonds.length_factor[life.pair] * bonds.domain_factor[life.pair];
    // The sum of no floats is -0.
    let sum = |lives: &mut dyn Iterator<Item = &Life>| lives.map(weight).fold(0.0, f64::add);
    let all = sum(&mut lives.of_bonds.iter());
    let is_broken = |life: &&Life| place >= life.n_intact;
    let broken = sum(&mut lives.of_bonds.iter().filter(is_broken));
    if all > 0.0 { broken / all } else { 0.0 }
}

/// The lines of a table with its columns at the right.
fn in_columns(table: &[Vec<String>]) -> impl Iterator<Item = String> {
    aligned(table, 0)
        .into_iter()
        .map(|line| format!("  {line}"))
}
