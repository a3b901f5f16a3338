//! Distortion of first yield by the bonds' directions for all points of a case, as fields and as a distribution.

use std::io::Write;

use ligament_model::failure::Criteria;
use ligament_output::csv::{Table, Value};
use ligament_output::folder::ResultFolder;
use ligament_output::results::write_points;
use ligament_output::vtu::Field;
use ligament_post::yielding::field::{Distribution, FamilyYield, families};
use ligament_post::yielding::lattice;

use super::error::YieldError;
use super::of_case::{criteria, model, poisson};
use super::request::{Request, SUMMARY};
use super::subject::{Strain, Subject};
use ligament::run::on_threads;
use ligament_case::case::CaseFile;
use ligament_plot::plots::{Colour, Plot, Series};
use ligament_run::model::Model;
use ligament_run::summary::heading;

/// Computes and writes the anisotropy of first yield at all points.
pub(super) fn draw(
    request: &Request,
    case: &CaseFile,
    screen: &mut (dyn Write + Send),
) -> anyhow::Result<()> {
    on_threads(case.threads(), || draw_here(request, case, screen))?
}

/// A criterion and a strain at all points.
struct Layer {
    criterion: String,
    strain: Strain,
    /// First yield of each point's family, shape (n_points).
    yields: Vec<Option<FamilyYield>>,
    /// Error of the lattice with families of equal size, where all bonds have the same limits.
    lattice: Option<f64>,
}

fn draw_here(request: &Request, case: &CaseFile, screen: &mut dyn Write) -> anyhow::Result<()> {
    let model = model(case)?;
    let system = model.plane();
    let poisson = poisson(request, &model)?;
    let is_interior = model.interior(&model.body().rim());
    let sizes: Vec<i64> = (0..system.cloud.len() as u32)
        .map(|point| system.bonds.incidence.at(point).len() as i64)
        .collect();
    let size = mean_size(&sizes, &is_interior);
    let ratio = lattice::ratio_of_size(size);
    let criteria = criteria(request, &model)?;
    let layers = layers(request, &model, criteria, &poisson, ratio)?;
    if layers
        .iter()
        .all(|layer| layer.yields.iter().all(Option::is_none))
    {
        let of = "the body".to_owned();
        return Err(YieldError::NeverYields { of }.into());
    }
    let folder = request.folder()?;
    let n_interior = is_interior.iter().filter(|it| **it).count();
    writeln!(screen, "{}", heading(&case.case.title))?;
    writeln!(
        screen,
        "{n_interior} of {} points are interior: no point of their family lies on the rim, and no pre-crack cuts a bond of theirs.\n\
         The families of the others lack the directions out of the body (on a straight side half of them): their errors are\n\
         in the fields and in {SUMMARY}, and say less about the mesh.",
        sizes.len()
    )?;
    write_summary(&folder, screen, &model, &layers, &is_interior, ratio)?;
    if n_interior > 0 {
        writeln!(
            screen,
            "  interior families have {size:.1} bonds in the mean"
        )?;
    }
    let plot = distribution(&layers, &is_interior);
    if plot.series.iter().any(|it| !it.points().is_empty()) {
        folder.write("distribution.svg", plot.for_screen()?.to_svg(&plot.title))?;
    }
    write_fields(
        &folder.file("points.vtu"),
        &model,
        &layers,
        &is_interior,
        &sizes,
    )?;
    Ok(folder.finish()?)
}

/// Layers of each criterion under each strain, with Poisson's ratio of each point (n_points), compared with a lattice with a horizon of
/// `ratio` spacings.
fn layers(
    request: &Request,
    model: &Model,
    criteria: Vec<(String, Criteria)>,
    poisson: &[f64],
    ratio: f64,
) -> Result<Vec<Layer>, YieldError> {
    let mut layers = Vec::new();
    for (place, (criterion, criteria)) in criteria.into_iter().enumerate() {
        let combination = request.combinations.get(place);
        let strengths = request.strengths(poisson[0]);
        let lattice = combination.map(|it| Subject::from_lattice(ratio, it, &strengths));
        let lattice = lattice.transpose()?;
        for (k, strain) in Strain::in_figures(poisson[0]).into_iter().enumerate() {
            let at = |point: u32| Strain::in_figures(poisson[point as usize])[k].stretches;
            let worst = |it: &Subject| Some(it.family().worst(strain.stretches)?.error);
            layers.push(Layer {
                criterion: criterion.clone(),
                strain,
                yields: families(model.plane(), &criteria, at),
                lattice: lattice.as_ref().and_then(worst),
            });
        }
    }
    Ok(layers)
}

const COLUMNS: &str = "criterion,strain,points,count,mean,percentile_5,percentile_95,worst\
                       ,worst_point,worst_orientation_deg,lattice_m,lattice";

/// Writes the errors of the interior points and of all points into a table, and prints the errors of the interior points.
fn write_summary(
    folder: &ResultFolder,
    screen: &mut dyn Write,
    model: &Model,
    layers: &[Layer],
    is_interior: &[bool],
    ratio: f64,
) -> anyhow::Result<()> {
    writeln!(
        screen,
        "largest error of first yield over the orientation at interior points, %\n  {:<20}{:<16}{:>8}{:>8}{:>8}{:>8}  where",
        "criterion", "strain", "mean", "5 %", "95 %", "worst"
    )?;
    let mut table = Table::with_header(folder.file(SUMMARY), COLUMNS)?;
    for layer in layers {
        let (criterion, words) = (&layer.criterion, layer.strain.words);
        for (points, marked) in [("interior", Some(is_interior)), ("all", None)] {
            let Some(summary) = layer.summary(marked) else {
                continue;
            };
            let it = summary.errors;
            let numbers = [it.mean, it.percentile_5, it.percentile_95, it.worst];
            let lattice_ratio = layer.lattice.map_or(f64::NAN, |_| ratio);
            let mut row: Vec<Value<'_>> = vec![criterion.as_str().into(), layer.strain.name.into()];
            row.extend([Value::from(points), it.count.into()]);
            row.extend(numbers.map(Value::from));
            row.push(model.body().tag(summary.point).into());
            row.push(summary.orientation.to_degrees().into());
            row.extend([lattice_ratio, layer.lattice.unwrap_or(f64::NAN)].map(Value::from));
            table.append(&row)?;
            if marked.is_some() {
                let cells = numbers.map(|it| format!("{:>8.2}", 100.0 * it)).concat();
                let place = model.body().place(summary.point);
                writeln!(screen, "  {criterion:<20}{words:<16}{cells}  {place}")?;
                if let Some(error) = layer.lattice {
                    let words = format!("lattice m = {ratio:.2}");
                    writeln!(screen, "  {:<20}{words:<16}{:>32.2}", "", 100.0 * error)?;
                }
            }
        }
    }
    Ok(())
}

/// Statistics of some points.
struct Summary {
    errors: Distribution,
    /// The worst point.
    point: u32,
    /// The worst orientation at the worst point, rad.
    orientation: f64,
}

impl Layer {
    /// Statistics over the marked points (n_points), or over all points; `None` where no point yields.
    fn summary(&self, marked: Option<&[bool]>) -> Option<Summary> {
        let is_in = |point: usize| marked.is_none_or(|marked| marked[point]);
        let yields = self
            .yields
            .iter()
            .enumerate()
            .filter(|(point, _)| is_in(*point));
        let worst = yields.filter_map(|(point, it)| Some((point, it.as_ref()?.worst)));
        let errors = worst.clone().map(|(_, it)| it.error).collect();
        let first = worst.reduce(|first, it| {
            if it.1.error > first.1.error {
                it
            } else {
                first
            }
        })?;
        Some(Summary {
            errors: Distribution::from_values(errors)?,
            point: first.0 as u32,
            orientation: first.1.orientation,
        })
    }

    /// A value at each point, shape (n_points); NaN where no bond yields.
    fn values(&self, of: impl Fn(&FamilyYield) -> f64) -> Vec<f64> {
        let value = |it: &Option<FamilyYield>| it.as_ref().map_or(f64::NAN, &of);
        self.yields.iter().map(value).collect()
    }
}

fn mean_size(sizes: &[i64], is_interior: &[bool]) -> f64 {
    let pairs = || sizes.iter().zip(is_interior).filter(|(_, is_in)| **is_in);
    let count = pairs().count().max(1) as f64;
    pairs().map(|(size, _)| *size as f64).sum::<f64>() / count
}

/// Plot of the cumulative share of interior points over their error.
fn distribution(layers: &[Layer], is_interior: &[bool]) -> Plot {
    let curve = |(layer, colour): (&Layer, &Colour)| {
        let errors = layer.yields.iter().zip(is_interior);
        let mut errors: Vec<f64> = errors
            .filter(|(_, is_in)| **is_in)
            .filter_map(|(it, _)| Some(it.as_ref()?.worst.error))
            .collect();
        errors.sort_by(f64::total_cmp);
        let share = 100.0 / errors.len().max(1) as f64;
        let points = errors.iter().enumerate();
        let points = points.map(|(k, error)| [100.0 * error, share * (k + 1) as f64]);
        let name = format!("{}, {}", layer.criterion, layer.strain.name);
        Series::curve(name, *colour, points.collect())
    };
    let series = layers.iter().zip(Colour::CYCLE.iter().cycle()).map(curve);
    Plot::new(
        "distribution",
        "Anisotropy of first yield at interior points",
        [
            "largest error over the orientation, %",
            "points with no larger one, %",
        ],
        series.collect(),
    )
}

fn write_fields(
    path: &std::path::Path,
    model: &Model,
    layers: &[Layer],
    is_interior: &[bool],
    sizes: &[i64],
) -> Result<(), ligament_output::Error> {
    let finite = |error: f64| if error.is_finite() { error } else { f64::NAN };
    let mut scalars = Vec::new();
    for layer in layers {
        let name = |what: &str| {
            let criterion = layer.criterion.replace(['+', ' ', '-'], "_");
            format!("{criterion}_{}_{what}", layer.strain.name)
        };
        scalars.push((name("error"), layer.values(|it| finite(it.worst.error))));
        let degrees = layer.values(|it| it.worst.orientation.to_degrees());
        scalars.push((name("worst_orientation"), degrees));
        scalars.push((name("least_strain"), layer.values(|it| it.least_load)));
    }
    let interior: Vec<i64> = is_interior.iter().map(|&it| i64::from(it)).collect();
    let mut fields: Vec<Field<'_>> = scalars
        .iter()
        .map(|(name, values)| Field::scalar(name, values))
        .collect();
    fields.push(Field::integer("interior", &interior));
    fields.push(Field::integer("bonds", sizes));
    write_points(path, &model.body().grid(), &fields)
}
