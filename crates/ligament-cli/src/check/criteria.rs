//! What `ligament check` tells of the failure criteria: their limits, and what the fracture energy makes of them.

use std::io::{self, Write};

use ligament::formulation::constants;
use ligament_model::failure::{Criterion, Measure};

use ligament_model::scatter::{Distribution, Scattered};
use ligament_run::model::Model;
use ligament_run::summary::{ScatterSummary, Spread};

/// Writes the criteria with their limits over the bonds.
pub(super) fn write(out: &mut dyn Write, model: &Model) -> io::Result<()> {
    if model.setup.criteria.is_empty() {
        return Ok(());
    }
    writeln!(out, "failure criteria")?;
    let given = model.setup.criteria.iter();
    let given = given.flat_map(|it| std::iter::repeat_n(it, it.kind.measures.len()));
    for (given, criterion) in given.zip(&model.criteria.list) {
        write_limits(out, criterion)?;
        if given.spends_fracture_energy() {
            write_energy(out, model, criterion)?;
        }
    }
    write_scatter(out, model)
}

/// Writes what varies at random: limits of bonds above have its factors.
fn write_scatter(out: &mut dyn Write, model: &Model) -> io::Result<()> {
    let (Some(scatter), Some(summary)) = (model.setup.scatter, ScatterSummary::new(model)) else {
        return Ok(());
    };
    let distribution = match scatter.distribution {
        Distribution::Weibull { modulus } => format!("Weibull modulus {modulus}"),
        Distribution::Normal { deviation } => format!("normal by {} %", 100.0 * deviation),
    };
    let correlation = match scatter.correlation_length {
        0.0 => "each point for itself".to_owned(),
        length => format!("correlation length {length:.4e} m"),
    };
    let Spread { min, max, .. } = summary.factor;
    let name = match scatter.of {
        Scattered::Strength => "random strength",
        Scattered::FractureEnergy => "random G_c",
    };
    let seed = scatter.seed;
    writeln!(
        out,
        "  {name:<21} {distribution}, {correlation}, seed {seed}: factors {min:.4} to {max:.4}, deviation {:.2} %",
        100.0 * summary.deviation
    )
}

fn write_limits(out: &mut dyn Write, criterion: &Criterion) -> io::Result<()> {
    let measure = criterion.measure;
    write!(out, "  {:<21} {} = ", criterion.name, measure.formula())?;
    let failing = |bond: &usize| criterion.limit[*bond].is_finite();
    let bonds: Vec<usize> = (0..criterion.limit.len()).filter(failing).collect();
    let of_bonds =
        |value: &dyn Fn(usize) -> f64| Range::over(bonds.iter().map(|&bond| value(bond)));
    let Some(limits) = of_bonds(&|bond| criterion.limit[bond]) else {
        return writeln!(out, "no limit: no bond may fail");
    };
    write!(out, "{limits}")?;
    let stored = criterion.coefficients(0).len();
    let names = measure.coefficient_names().iter().take(stored);
    for (place, name) in names.enumerate() {
        if let Some(values) = of_bonds(&|bond| criterion.coefficients(bond)[place]) {
            write!(out, "; {name} = {values}")?;
        }
    }
    let after = &criterion.after;
    write!(out, "; {}", after.law().force)?;
    let parameter = after.parameter();
    if !parameter.is_empty()
        && let Some(ends) = of_bonds(&|bond| parameter[bond])
    {
        write!(out, " {ends} times that")?;
    }
    match criterion.limit.len() - bonds.len() {
        0 => writeln!(out),
        never => writeln!(out, "; {never} bonds never fail"),
    }
}

/// The limit falls with the root of the horizon, so that a body without a crack has another strength on every mesh.
fn write_energy(out: &mut dyn Write, model: &Model, criterion: &Criterion) -> io::Result<()> {
    let (shear, at_most) = match criterion.measure {
        // Bonds across the bar may come to their limit before those along it.
        Measure::Energy => ("shear of the bonds is counted", "at most "),
        _ => ("what shear of the bonds stores comes on top of it", ""),
    };
    let setup = &model.setup;
    for material in setup.materials() {
        let energy = material.fracture_energy.unwrap_or_default();
        write!(out, "{:<24}", "")?;
        if !material.name.is_empty() {
            write!(out, "{}: ", material.name)?;
        }
        writeln!(
            out,
            "separating a body takes G_c = {energy:.4e} J/m^2 ({shear})"
        )?;
    }
    // The weaker material decides at interfaces, so that limits belong to a material only where there is one.
    if let [region] = setup.materials.as_slice()
        && let Some(constants) = constants(&region.material, &setup.law, setup.plane())
        && let Some(limits) =
            Range::over(criterion.limit.iter().copied().filter(|it| it.is_finite()))
    {
        let young = constants.in_plane(setup.plane()).young;
        writeln!(
            out,
            "{:<24}a bar without a crack fails at {at_most}E s_0 = {} Pa, which changes with the horizon",
            "",
            limits.times(young)
        )?;
    }
    Ok(())
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
}

impl std::fmt::Display for Range {
    fn fmt(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let [min, median, max] = self.0.map(|value| format!("{value:.4e}"));
        if min == max {
            write!(formatter, "{min}")
        } else {
            write!(formatter, "{min} to {max}, median {median}")
        }
    }
}
