//! Report of `ligament check` on the failure criteria: limits, and their relation to the fracture energy.

use std::io;

use ligament::crack_energy::crack_energies;
use ligament_model::Material;
use ligament_model::failure::crack_opening::CrackEnergy;
use ligament_model::failure::softening::Law;
use ligament_model::failure::starting::Starting;
use ligament_model::failure::{Choice, Criterion};
use ligament_model::scatter::{Distribution, Scatter, Scattered};
use ligament_output::quantity::{between, four_digits, quantity};
use ligament_output::summary::{ScatterSummary, Spread};
use ligament_run::model::Model;
use ligament_run::summary::scatter;

use super::crack_work;
use super::report::Report;

/// Writes the criteria with their limits over the bonds.
pub(super) fn write(report: &mut Report<'_>, model: &Model) -> io::Result<()> {
    if model.setup.criteria.is_empty() {
        return Ok(());
    }
    report.head("failure criteria");
    for criterion in &model.criteria.list {
        match criterion.starting() {
            Some(starting) => write_start(report, criterion, starting)?,
            None => write_limits(report, criterion)?,
        }
        let given = model.setup.criteria.get(criterion.choice);
        if given.is_some_and(Choice::spends_fracture_energy) {
            write_energy(report, model, criterion)?;
        }
    }
    write_interfaces(report, model)?;
    write_curves(report, model)?;
    write_cracks(report, model)?;
    crack_work::write(report, model)?;
    write_characteristic_lengths(report, model)?;
    write_scatters(report, model)
}

/// Writes the interfaces with their properties and the number of their bonds.
fn write_interfaces(report: &mut Report<'_>, model: &Model) -> io::Result<()> {
    let crossed = model.setup.interfaces.iter().zip(&model.fixed.interfaces);
    for (interface, (name, crosses)) in crossed {
        let given = interface.properties().into_iter();
        let given = given.filter_map(|(key, value)| Some(format!("{key} = {:e}", value?)));
        let bonds = crosses.iter().filter(|it| **it).count();
        let words = format!("{bonds} bonds; {}", given.collect::<Vec<_>>().join(", "));
        report.entry(&format!("interface {name}"), words)?;
    }
    Ok(())
}

/// Draws the stress over the opening of a crack for each law of softening.
fn write_curves(report: &mut Report<'_>, model: &Model) -> io::Result<()> {
    let mut drawn: Vec<&Law> = Vec::new();
    for law in model.setup.criteria.iter().map(|it| &it.after) {
        if let Some(curve) = law.stress_over_opening().filter(|_| !drawn.contains(&law)) {
            drawn.push(law);
            let name = format!("stress, {}", law.word);
            for (place, line) in drawing(&curve).iter().enumerate() {
                report.detail(if place == 0 { &name } else { "" }, line)?;
            }
        }
    }
    Ok(())
}

/// Lines that draw stresses over the strength at openings over G_c/f_t, shape (n, 2), with a line below for the openings.
fn drawing(curve: &[[f64; 2]]) -> Vec<String> {
    const COLUMNS: usize = 48;
    const ROWS: usize = 8;
    let end = curve.last().map_or(0.0, |it| it[0]);
    let stress_at = |opening: f64| {
        let next = curve.partition_point(|it| it[0] < opening);
        curve[next.min(curve.len() - 1)][1]
    };
    let row_of = |column: usize| {
        let stress = stress_at(end * (column as f64 + 0.5) / COLUMNS as f64);
        (((1.0 - stress) * ROWS as f64) as usize).min(ROWS - 1)
    };
    let line = |row: usize| {
        let scale = if row == 0 { "f_t |" } else { "    |" };
        let marks = (0..COLUMNS).map(|it| if row_of(it) == row { '*' } else { ' ' });
        scale.to_owned() + marks.collect::<String>().trim_end()
    };
    let mut lines: Vec<String> = (0..ROWS).map(line).collect();
    lines.push(format!("    0 to an opening of {end:.2} G_c/f_t"));
    lines
}

/// Writes the energy that cracks dissipate in each material.
fn write_cracks(report: &mut Report<'_>, model: &Model) -> io::Result<()> {
    for (index, material) in model.setup.materials().into_iter().enumerate() {
        if let Some(energies) = crack_energies(model, index) {
            write_crack(report, model, &material, energies)?;
        }
    }
    Ok(())
}

/// Writes the energies that cracks opening along x and along y dissipate in a material.
fn write_crack(
    report: &mut Report<'_>,
    model: &Model,
    material: &Material,
    energies: [CrackEnergy; 2],
) -> io::Result<()> {
    let mut words = match material.name.as_str() {
        "" => String::new(),
        name => format!("{name}: "),
    };
    words += &match energies.map(|it| it.per_area) {
        [0.0, 0.0] => "nothing: opening a crack breaks no bond".to_owned(),
        spent => spent_words(spent, material.fracture_energy),
    };
    let from_energy = |it: &Choice| {
        let of_softening = it.after.softens && it.parameter_from_energy().is_some();
        it.spends_fracture_energy() || of_softening
    };
    if !model.setup.criteria.iter().any(from_energy) {
        words += ", which depends on the horizon";
    }
    let criteria = model.criteria.list.iter();
    let by_stretch = criteria.filter(|it| it.measure.opens() && !it.measure.takes_sliding());
    let has_shear = model.has_shear();
    if has_shear && by_stretch.count() > 0 {
        words += "; more where the faces slide, because this criterion ignores sliding";
    }
    let unbroken = energies
        .map(|it| it.unbroken)
        .into_iter()
        .fold(0.0, f64::max);
    // Sums of shares have rounding errors.
    if unbroken > 1e-9 {
        let percent = four_digits(100.0 * unbroken);
        words += &format!("; {percent} % of the bonds across it never break");
    }
    report.entry("a crack spends", words)
}

/// Text of the energies per area of cracks opening along x and along y, J/m^2, compared with a fracture energy: "97.09 to 97.63 J/m^2 (0.97
/// to 0.98 of the fracture_energy)"; for each direction where they differ by more than 5 %.
fn spent_words([x, y]: [f64; 2], given: Option<f64>) -> String {
    let words = |range: [f64; 2]| {
        let spent = between(range, "J/m^2");
        let Some(given) = given else {
            return spent;
        };
        let [low, high] = range.map(|it| format!("{:.2}", it / given));
        let shares = if low == high {
            low
        } else {
            format!("{low} to {high}")
        };
        format!("{spent} ({shares} of the fracture_energy)")
    };
    if (x - y).abs() < 0.05 * x.max(y) {
        words([x.min(y), x.max(y)])
    } else {
        let [along_x, along_y] = [x, y].map(|it| words([it; 2]));
        format!("{along_x} where it opens along x, {along_y} along y")
    }
}

/// Writes the random properties, whose factors are included in the limits above.
fn write_scatters(report: &mut Report<'_>, model: &Model) -> io::Result<()> {
    let mut properties = model.setup.scatter.iter().zip(scatter(model));
    properties.try_for_each(|(scatter, summary)| write_scatter(report, scatter, &summary))
}

fn write_scatter(
    report: &mut Report<'_>,
    scatter: &Scatter,
    summary: &ScatterSummary,
) -> io::Result<()> {
    let distribution = match scatter.distribution {
        Distribution::Weibull { modulus } => format!("Weibull modulus {modulus}"),
        Distribution::Normal { deviation } => format!("normal by {} %", 100.0 * deviation),
        Distribution::Lognormal { deviation } => format!("lognormal by {} %", 100.0 * deviation),
    };
    let correlation = match scatter.correlation_length {
        0.0 => "each point independent".to_owned(),
        length => format!("correlation length {}", quantity(length, "m")),
    };
    let Spread { min, max, .. } = summary.factor;
    let name = match scatter.of {
        Scattered::Strength => "random strength",
        Scattered::FractureEnergy => "random G_c",
    };
    let seed = summary.seed;
    let deviation = 100.0 * summary.deviation;
    let words = format!(
        "{distribution}, {correlation}, seed {seed}: factors {min:.4} to {max:.4}, deviation {deviation:.2} %"
    );
    report.entry(name, words)
}

/// Writes where bonds begin to soften by the stress around them, and what they take then.
fn write_start(
    report: &mut Report<'_>,
    criterion: &Criterion,
    starting: &Starting,
) -> io::Result<()> {
    let finite = |values: &[f64]| Range::over(values.iter().copied().filter(|it| it.is_finite()));
    let both = finite(starting.strengths()).zip(finite(starting.critical_stretches()));
    let Some((strength, critical)) = both else {
        return report.entry(criterion.name, "no limit: no bond can fail");
    };
    let words = format!(
        "begins at {} = {strength} around a bond; {}; takes what a brittle bond takes up to the stretch {critical}",
        starting.formula(),
        criterion.after.law().force,
    );
    report.entry(criterion.name, words)
}

fn write_limits(report: &mut Report<'_>, criterion: &Criterion) -> io::Result<()> {
    let measure = criterion.measure;
    let failing = |bond: &usize| criterion.limit[*bond].is_finite();
    let bonds: Vec<usize> = (0..criterion.limit.len()).filter(failing).collect();
    let of_bonds =
        |value: &dyn Fn(usize) -> f64| Range::over(bonds.iter().map(|&bond| value(bond)));
    let mut words = format!("{} = ", measure.formula());
    let Some(limits) = of_bonds(&|bond| criterion.limit[bond]) else {
        return report.entry(criterion.name, words + "no limit: no bond can fail");
    };
    words += &limits.to_string();
    let stored = criterion.coefficients(0).len();
    let names = measure.coefficient_names().iter().take(stored);
    for (place, name) in names.enumerate() {
        if let Some(values) = of_bonds(&|bond| criterion.coefficients(bond)[place]) {
            words += &format!("; {name} = {values}");
        }
    }
    let after = &criterion.after;
    words += &format!("; {}", after.law().force);
    let parameter = after.parameter();
    if let Some(of_law) = after.law().parameter
        && let Some(ends) = of_bonds(&|bond| parameter[bond])
    {
        words += &format!("{} {ends} times the limit", of_law.words);
    }
    match criterion.limit.len() - bonds.len() {
        0 => {}
        1 => words += "; 1 bond never fails",
        never => words += &format!("; {never} bonds never fail"),
    }
    report.entry(criterion.name, words)
}

/// Writes the strengths that correspond to limits from the fracture energy: these decrease with the root of the horizon, so that the
/// strength of a body without a crack depends on the mesh.
fn write_energy(report: &mut Report<'_>, model: &Model, criterion: &Criterion) -> io::Result<()> {
    // Bonds across the bar may reach their limit before those along it.
    let at_most = if criterion.measure.needs_shear_stiffness() {
        "at most "
    } else {
        ""
    };
    let setup = &model.setup;
    // At interfaces the weaker material determines the limit, so that limits belong to a material only in a body of one material.
    if let [region] = setup.materials.as_slice()
        && let Some(young) = setup.young(&region.material)
        && let Some(limits) =
            Range::over(criterion.limit.iter().copied().filter(|it| it.is_finite()))
    {
        let strength = limits.times(young).text("Pa");
        let words = format!(
            "a bar without a crack fails at {at_most}E s_0 = {strength}, which depends on the horizon"
        );
        report.entry("", words)?;
    }
    Ok(())
}

/// Writes for each material with a strength and a fracture energy its characteristic length
///
/// l_ch = E G_c/F_t^2,
///
/// and the horizon over it. With a horizon of at most l_ch a crack spends its energy over several bonds that soften, and neither strength nor
/// toughness hang on the mesh. Bonds that break at once by a strength know no energy: K_Ic grows with the root of the horizon.
fn write_characteristic_lengths(report: &mut Report<'_>, model: &Model) -> io::Result<()> {
    for material in model.setup.materials() {
        if let Some(length) = model.setup.characteristic_length(&material) {
            report.entry(
                "characteristic length",
                length_words(model, &material, length),
            )?;
        }
    }
    let list = &model.criteria.list;
    let breaks_by_stress = |it: &&Criterion| it.follows_stress() && it.after.is_brittle();
    let starts = list.iter().any(|it| it.starting().is_some());
    if list.iter().any(|it| breaks_by_stress(&it)) && !starts {
        let words = "brittle bonds with a limit of stress: the strength does not depend on the mesh, but the toughness does (K_Ic grows \
            with sqrt(H)); `rankine` softens according to the fracture energy";
        report.entry("cracks", words)?;
    }
    Ok(())
}

fn length_words(model: &Model, material: &Material, length: f64) -> String {
    let of_points = || model.fixed.horizon.iter().copied();
    let largest = of_points().fold(0.0, f64::max);
    let smallest = of_points().fold(f64::INFINITY, f64::min);
    let name = match material.name.as_str() {
        "" => String::new(),
        name => format!("{name}: "),
    };
    let shares = between([smallest / length, largest / length], "-");
    let finer = match largest > length {
        true => format!(
            "; a horizon no larger than that takes a mesh {} times finer",
            four_digits(largest / length)
        ),
        false => String::new(),
    };
    format!(
        "{name}E G_c/F_t^2 = {}, the horizon is {shares} of it{finer}",
        quantity(length, "m")
    )
}

/// Smallest, median (the lower of two) and largest of some numbers.
struct Range([f64; 3]);

impl Range {
    fn over(values: impl Iterator<Item = f64>) -> Option<Self> {
        let mut values: Vec<f64> = values.collect();
        values.sort_unstable_by(f64::total_cmp);
        let last = values.len().checked_sub(1)?;
        Some(Self([values[0], values[last / 2], values[last]]))
    }

    fn times(&self, factor: f64) -> Self {
        Self(self.0.map(|value| factor * value))
    }

    /// Text of the range in an SI unit: "190.1 to 212.1 (median 192.2)".
    fn text(&self, unit: &str) -> String {
        let [min, median, max] = self.0;
        let range = between([min, max], unit);
        let all_alike = quantity(min, unit) == quantity(max, unit);
        if all_alike {
            range
        } else {
            format!("{range} (median {})", quantity(median, unit))
        }
    }
}

impl std::fmt::Display for Range {
    fn fmt(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        formatter.write_str(&self.text("-"))
    }
}
