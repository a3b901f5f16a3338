//! `ligament stiffness`: k_n, k_t and k_theta of bonds over their direction, as a table and polar diagrams.

use std::f64::consts::PI;
use std::io::Write;
use std::path::PathBuf;

use ligament::direction::{InDirection, over_direction};
use ligament::setup::Setup;
use ligament_case::case::CaseFile;
use ligament_output::csv::Table;
use ligament_output::folder::{Kind, ResultFolder};
use ligament_plot::plots::polar::PolarPlot;
use ligament_plot::plots::{Colour, Series};
use ligament_run::model::build_model_in_plane;
use ligament_run::progress::{Progress, ProgressMode};
use ligament_run::stages::Stages;
use ligament_run::summary::heading;

/// Error of a request for curves of stiffness.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum DirectionError {
    /// Imaginary elements have no such stiffness.
    #[error(
        "the bonds of \"{0}\" resist the strains of a rectangle by a matrix, and have no k_n, k_t and k_theta: take another law"
    )]
    NoStiffness(&'static str),
    /// A length of bonds out of range.
    #[error("--length must be greater than 0 and at most 1 (the horizon), found {0}")]
    Length(f64),
}

/// A request to `ligament stiffness`.
#[derive(Debug)]
pub struct Request {
    /// Case with the materials and the law.
    pub case: Box<CaseFile>,
    /// Length of the bonds over their horizon.
    pub length: f64,
    /// Folder of the results.
    pub out: PathBuf,
    /// Whether earlier results in the output folder may be replaced.
    pub force: bool,
}

/// File that marks a folder with curves of stiffness.
const TABLE: &str = "stiffness.csv";

const COLUMNS: &str = "material,direction_deg,k_n,k_t,k_theta,c_xx,c_ss";

/// The folder of curves of stiffness.
const KIND: Kind = Kind {
    owns: |name| name == TABLE || (name.starts_with("k-") && name.ends_with(".svg")),
    ..Kind::with_marker(TABLE)
};

/// Directions of the curves: a degree apart, over half a turn.
const DEGREES: u32 = 180;

/// Computes the curves of all materials of a case, prints their extremes and writes them.
///
/// # Errors
///
/// If the law has no such stiffness, the case no body, or the folder cannot be used.
pub fn bond_stiffness(request: &Request, screen: &mut dyn Write) -> anyhow::Result<()> {
    if !(request.length > 0.0 && request.length <= 1.0) {
        return Err(DirectionError::Length(request.length).into());
    }
    let progress = Progress::new(ProgressMode::Quiet);
    let model = build_model_in_plane(&request.case, &mut Stages::default(), &progress)?;
    let (setup, horizons) = (&model.setup, model.fixed.horizon.iter());
    let horizon = horizons.copied().fold(f64::INFINITY, f64::min);
    let length = request.length * horizon;
    let angles: Vec<f64> = (0..=DEGREES).map(|it| f64::from(it).to_radians()).collect();
    let of_material = |index| {
        let curves = over_direction(setup, index, [length, horizon], &angles);
        Ok((
            name_of(setup, index),
            curves.ok_or(DirectionError::NoStiffness(setup.law.name()))?,
        ))
    };
    let materials: Vec<(String, Vec<InDirection>)> = (0..setup.materials.len())
        .map(of_material)
        .collect::<Result<_, DirectionError>>()?;
    let folder = ResultFolder::create_of_kind(&request.out, KIND, request.force)?;
    let mut table = Table::with_header(folder.file(TABLE), COLUMNS)?;
    writeln!(screen, "{}", heading(&request.case.case.title))?;
    let law = setup.law.name();
    writeln!(
        screen,
        "law {law}, bonds of {length:.4e} m with the horizon {horizon:.4e} m\n"
    )?;
    for (index, (name, curves)) in materials.iter().enumerate() {
        write_extremes(screen, name, curves)?;
        append(&mut table, name, curves)?;
        for plot in plots(name, &file_stem(name, index), curves) {
            folder.write(
                &format!("{}.svg", plot.name),
                plot.for_screen()?.to_svg(&plot.title),
            )?;
        }
    }
    folder.finish()?;
    Ok(writeln!(screen, "results in {}", request.out.display())?)
}

/// Name of a material: its group, or "body" if it fills the whole body.
fn name_of(setup: &Setup, index: usize) -> String {
    let group = setup.materials[index].group.clone();
    group.unwrap_or_else(|| "body".to_owned())
}

/// Part of a file's name for a material: its name if it has only letters, digits, hyphens and underscores, otherwise its number, since a
/// name with `/` would be a path.
fn file_stem(name: &str, index: usize) -> String {
    let is_plain = |it: char| it.is_ascii_alphanumeric() || matches!(it, '-' | '_');
    match name.chars().all(is_plain) {
        true => name.to_owned(),
        false => format!("material-{}", index + 1),
    }
}

/// Name of a quantity with a curve, and the function that returns it.
type Quantity = (&'static str, fn(&InDirection) -> f64);

const STIFFNESSES: [Quantity; 3] = [
    ("k_n", |it| it.axial),
    ("k_t", |it| it.shear),
    ("k_theta", |it| it.rotational),
];

/// Prints values along x and y, and the smallest and largest values with their directions.
fn write_extremes(
    screen: &mut dyn Write,
    name: &str,
    curves: &[InDirection],
) -> anyhow::Result<()> {
    writeln!(screen, "{name}")?;
    for (quantity, value) in STIFFNESSES {
        let unit = if quantity == "k_theta" {
            "N/m^5"
        } else {
            "N/m^6"
        };
        if curves.iter().all(|it| value(it) == 0.0) {
            writeln!(screen, "  {quantity:<8} 0")?;
            continue;
        }
        let by = |one: &&InDirection, other: &&InDirection| value(one).total_cmp(&value(other));
        let [at_0, at_90] = [0, curves.len() / 2].map(|place| value(&curves[place]));
        write!(
            screen,
            "  {quantity:<8} {at_0:.4e} at 0, {at_90:.4e} at 90 degrees"
        )?;
        if let (Some(least), Some(most)) = (curves.iter().min_by(by), curves.iter().max_by(by)) {
            let of =
                |it: &InDirection| format!("{:.4e} at {:.0}", value(it), it.angle.to_degrees());
            write!(
                screen,
                "; smallest {}, largest {} degrees",
                of(least),
                of(most)
            )?;
        }
        writeln!(screen, " ({unit})")?;
    }
    Ok(())
}

fn append(table: &mut Table, name: &str, curves: &[InDirection]) -> anyhow::Result<()> {
    for it in curves {
        table.append(&[
            name.into(),
            it.angle.to_degrees().into(),
            it.axial.into(),
            it.shear.into(),
            it.rotational.into(),
            it.normal_modulus.into(),
            it.shear_modulus.into(),
        ])?;
    }
    Ok(())
}

/// Diagrams of k_n and of k_t with the off-axis moduli of the continuum, each over its largest value, so that shapes can be compared;
/// negative values are dashed. The names of the files end in `stem`.
pub fn plots(name: &str, stem: &str, curves: &[InDirection]) -> Vec<PolarPlot> {
    let pairs: [[Quantity; 2]; 2] = [
        [STIFFNESSES[0], ("C_xx", |it| it.normal_modulus)],
        [STIFFNESSES[1], ("C_ss", |it| it.shear_modulus)],
    ];
    let plot = |[(stiffness, of_bond), (modulus, of_continuum)]: [Quantity; 2]| {
        let negative = Series::dashes(
            format!("-{stiffness}"),
            Colour::Vermilion,
            normalised_curve(curves, |it| -of_bond(it)),
        );
        let mut series = vec![
            Series::curve(stiffness, Colour::Blue, normalised_curve(curves, of_bond)),
            Series::curve(
                modulus,
                Colour::Orange,
                normalised_curve(curves, of_continuum),
            ),
            negative,
        ];
        series.retain(|it| it.points().iter().any(|point| point[1].is_finite()));
        PolarPlot {
            name: format!("k-{}-{stem}", &stiffness[2..]),
            title: format!("{stiffness} over the direction of the bond: {name}"),
            radius: "over the largest value".to_owned(),
            series,
        }
    };
    let drawable = |it: &PolarPlot| !it.series.is_empty();
    pairs.into_iter().map(plot).filter(drawable).collect()
}

/// A curve over all directions, normalised by its largest absolute value; NaN where it is negative.
fn normalised_curve(curves: &[InDirection], value: impl Fn(&InDirection) -> f64) -> Vec<[f64; 2]> {
    let largest = curves.iter().map(|it| value(it).abs()).fold(0.0, f64::max);
    let radius = |it: &InDirection| {
        let share = value(it) / largest;
        if share >= 0.0 { share } else { f64::NAN }
    };
    let half = curves.iter().map(|it| [it.angle, radius(it)]);
    let other = curves.iter().skip(1).map(|it| [it.angle + PI, radius(it)]);
    half.chain(other).collect()
}
