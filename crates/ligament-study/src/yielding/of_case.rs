//! Families of the bonds of a case: those of a point, or all.

use std::io::Write;

use ligament_model::Isotropic;
use ligament_model::failure::Criteria;
use ligament_model::law::bbpd;
use ligament_model::yielding::field::{Distribution, FamilyYield, families, interior};
use ligament_model::yielding::{PrincipalStretches, lattice};
use ligament_output::csv::Table;
use ligament_output::results::write_points;
use ligament_output::vtu::Field;

use super::diagrams::{self, Comparison};
use super::subject::{Strain, Subject};
use super::{Place, Request, SUMMARY, YieldError, console};
use ligament_case::case::{CaseFile, Law};
use ligament_case::model::{Model, build_model};
use ligament_case::progress::{Progress, ProgressMode};
use ligament_case::resolve;
use ligament_case::stages::Stages;
use ligament_case::summary::heading;
use ligament_plot::plots::{Colour, Mark, Plot, Series};

/// Diagrams of one point.
pub(super) fn point(
    request: &Request,
    case: &CaseFile,
    place: Place,
    screen: &mut (dyn Write + Send),
) -> anyhow::Result<()> {
    resolve::on_threads(case, || {
        let model = model(case)?;
        let point = find(&model, place)?;
        let poisson = poisson(request, case, &model)?[point as usize];
        let label = model.body.label(point);
        let mut comparisons = Vec::new();
        for (criterion, criteria) in criteria(request, case, &model)? {
            let subject = Subject::of_point(label.clone(), &model.system, &criteria, point);
            comparisons.push(Comparison {
                criterion,
                subjects: vec![subject],
            });
        }
        // With limits that are the same for all bonds a lattice is a fair neighbour.
        for (comparison, combination) in comparisons.iter_mut().zip(&request.combinations) {
            let ratio = lattice::ratio_of_size(comparison.subjects[0].size as f64);
            let strengths = request.strengths(poisson);
            let mut lattice = Subject::of_lattice(ratio, combination, &strengths)?;
            lattice.name = format!("lattice m = {ratio:.2}");
            comparison.subjects.push(lattice);
        }
        let strains = Strain::of_the_figures(poisson);
        let yields = |it: &Comparison| {
            let family = it.subjects[0].family();
            let paths = diagrams::PATHS.iter();
            let mut paths = paths.map(|&[first, second]| PrincipalStretches::new(first, second));
            paths.any(|path| family.theoretical_utilisation(path) > 0.0)
        };
        if !comparisons.iter().any(yields) {
            return Err(YieldError::NeverYields { of: label }.into());
        }
        comparisons.retain(yields);
        diagrams::write(&request.folder()?, &comparisons, &strains)?;
        writeln!(screen, "{}", heading(&case.case.title))?;
        writeln!(screen, "family of {}\n", model.body.place(point))?;
        for comparison in &comparisons {
            console::tell(screen, comparison)?;
        }
        Ok(())
    })?
}

/// The anisotropy of all points, as fields and in numbers.
pub(super) fn field(
    request: &Request,
    case: &CaseFile,
    screen: &mut (dyn Write + Send),
) -> anyhow::Result<()> {
    resolve::on_threads(case, || field_here(request, case, screen))?
}

/// A criterion and a strain at all points.
struct Layer {
    criterion: String,
    strain: Strain,
    /// Shape (n_points).
    yields: Vec<Option<FamilyYield>>,
    /// The error of the lattice with families of equal size, where limits are the same for all bonds.
    lattice: Option<f64>,
}

fn field_here(request: &Request, case: &CaseFile, screen: &mut dyn Write) -> anyhow::Result<()> {
    let model = model(case)?;
    let system = &model.system;
    let poisson = poisson(request, case, &model)?;
    let is_interior = interior(system, &model.body.rim(), &model.fixed.precrack_share);
    let sizes: Vec<i64> = (0..system.cloud.len() as u32)
        .map(|point| system.bonds.incidence.at(point).len() as i64)
        .collect();
    let size = mean_size(&sizes, &is_interior);
    let ratio = lattice::ratio_of_size(size);
    let mut layers = Vec::new();
    for (place, (criterion, criteria)) in criteria(request, case, &model)?.into_iter().enumerate() {
        let lattice = match request.combinations.get(place) {
            Some(combination) => {
                let strengths = request.strengths(poisson[0]);
                Some(Subject::of_lattice(ratio, combination, &strengths)?)
            }
            None => None,
        };
        for (k, strain) in Strain::of_the_figures(poisson[0]).into_iter().enumerate() {
            let at = |point: u32| Strain::of_the_figures(poisson[point as usize])[k].stretches;
            let worst = |it: &Subject| Some(it.family().worst(strain.stretches)?.error);
            layers.push(Layer {
                criterion: criterion.clone(),
                strain,
                yields: families(system, &criteria, at),
                lattice: lattice.as_ref().and_then(worst),
            });
        }
    }
    if layers
        .iter()
        .all(|layer| layer.yields.iter().all(Option::is_none))
    {
        let of = "the body".to_owned();
        return Err(YieldError::NeverYields { of }.into());
    }
    let folder = request.folder()?;
    let mut table = Table::create(
        folder.file(SUMMARY),
        &[
            "criterion",
            "strain",
            "points",
            "count",
            "mean",
            "percentile_5",
            "percentile_95",
            "worst",
            "worst_point",
            "worst_orientation_deg",
            "lattice_m",
            "lattice",
        ],
    )?;
    let n_interior = is_interior.iter().filter(|it| **it).count();
    writeln!(screen, "{}", heading(&case.case.title))?;
    writeln!(
        screen,
        "{n_interior} of {} points are interior: no point of their family lies on the rim, and no pre-crack cuts a bond of theirs.\n\
         The families of the others lack the directions out of the body (on a straight side half of them): their errors are\n\
         in the fields and in {SUMMARY}, and say less about the mesh.",
        sizes.len()
    )?;
    writeln!(
        screen,
        "largest error of first yield over the orientation at interior points, %"
    )?;
    writeln!(
        screen,
        "  {:<20}{:<16}{:>8}{:>8}{:>8}{:>8}  where",
        "criterion", "strain", "mean", "5 %", "95 %", "worst"
    )?;
    for layer in &layers {
        for (points, marked) in [("interior", Some(&is_interior)), ("all", None)] {
            let Some(summary) = layer.summary(marked.map(Vec::as_slice)) else {
                continue;
            };
            let Distribution {
                count,
                mean,
                percentile_5,
                percentile_95,
                worst,
            } = summary.errors;
            let numbers = [mean, percentile_5, percentile_95, worst];
            table.append(&[
                layer.criterion.as_str().into(),
                layer.strain.name.into(),
                points.into(),
                count.into(),
                mean.into(),
                percentile_5.into(),
                percentile_95.into(),
                worst.into(),
                model.body.tag(summary.point).into(),
                summary.orientation.to_degrees().into(),
                if layer.lattice.is_some() {
                    ratio
                } else {
                    f64::NAN
                }
                .into(),
                layer.lattice.unwrap_or(f64::NAN).into(),
            ])?;
            if marked.is_some() {
                let cells = numbers.map(|it| format!("{:>8.2}", 100.0 * it)).concat();
                let place = model.body.place(summary.point);
                let (criterion, words) = (&layer.criterion, layer.strain.words);
                writeln!(screen, "  {criterion:<20}{words:<16}{cells}  {place}")?;
                if let Some(error) = layer.lattice {
                    let words = format!("lattice m = {ratio:.2}");
                    writeln!(screen, "  {:<20}{words:<16}{:>32.2}", "", 100.0 * error)?;
                }
            }
        }
    }
    if n_interior > 0 {
        writeln!(
            screen,
            "  interior families have {size:.1} bonds in the mean"
        )?;
    }
    let plot = distribution(&layers, &is_interior);
    if plot.series.iter().any(|it| !it.points().is_empty()) {
        folder.write_text("distribution.svg", &plot.to_svg()?)?;
    }
    write_fields(
        &folder.file("points.vtu"),
        &model,
        &layers,
        &is_interior,
        &sizes,
    )?;
    Ok(())
}

/// Numbers of some points.
struct Summary {
    errors: Distribution,
    /// The worst point.
    point: u32,
    /// The worst orientation there.
    orientation: f64,
}

impl Layer {
    /// Over the points that are marked (n_points), or all.
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

    /// A value of each point; no number where nothing yields.
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

/// Share of the interior points whose error is no larger.
fn distribution(layers: &[Layer], is_interior: &[bool]) -> Plot {
    let colours = [
        Colour::Blue,
        Colour::Vermilion,
        Colour::Green,
        Colour::Purple,
        Colour::Orange,
        Colour::Sky,
    ];
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
        Series::new(&name, Mark::Curve, *colour, points.collect())
    };
    Plot {
        name: "distribution".to_owned(),
        title: "Anisotropy of first yield at interior points".to_owned(),
        x: "largest error over the orientation, %".to_owned(),
        y: "points with no larger one, %".to_owned(),
        series: layers
            .iter()
            .zip(colours.iter().cycle())
            .map(curve)
            .collect(),
    }
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
    write_points(path, &model.body.grid(), &fields)
}

fn model(case: &CaseFile) -> anyhow::Result<Model> {
    if case.case.model.law == Law::MbbPd {
        return Err(YieldError::NoDirections.into());
    }
    let progress = Progress::new(ProgressMode::Quiet);
    build_model(case, &mut Stages::default(), &progress)
}

/// The criteria with their names: those of the request, or each of the case's and, where there are several, all together.
fn criteria(
    request: &Request,
    case: &CaseFile,
    model: &Model,
) -> anyhow::Result<Vec<(String, Criteria)>> {
    let n_bonds = model.system.bonds.len();
    if !request.combinations.is_empty() {
        let values = poisson(request, case, model)?;
        let first = values[0];
        if values.iter().any(|it| *it != first) {
            let which = "several Poisson's ratios";
            return Err(YieldError::NoPoisson { which }.into());
        }
        let strengths = request.strengths(first);
        let of = request.combinations.iter().map(|combination| {
            let criteria = combination.criteria(&strengths, n_bonds)?;
            Ok((combination.name().to_owned(), criteria))
        });
        return of.collect();
    }
    let list = &model.criteria.list;
    if list.is_empty() {
        return Err(YieldError::NoCriteria.into());
    }
    let mut found: Vec<(String, Criteria)> = Vec::new();
    for criterion in list {
        // Two of a kind keep their order in the case.
        let before = found
            .iter()
            .filter(|(name, _)| name.starts_with(criterion.name))
            .count();
        let name = match before {
            0 => criterion.name.to_owned(),
            n => format!("{} {}", criterion.name, n + 1),
        };
        let list = vec![criterion.clone()];
        found.push((name, Criteria { list }));
    }
    if list.len() > 1 {
        found.push(("first of all".to_owned(), Criteria::clone(&model.criteria)));
    }
    Ok(found)
}

/// Poisson's ratio in the plane at each point (n_points): the mean over its materials.
fn poisson(request: &Request, case: &CaseFile, model: &Model) -> Result<Vec<f64>, YieldError> {
    let cloud = &model.system.cloud;
    if let Some(poisson) = request.poisson {
        return Ok(vec![poisson; cloud.len()]);
    }
    let plane = resolve::plane(case);
    let of_materials: Option<Vec<f64>> = (resolve::materials(case).iter())
        .map(|material| {
            let given: Isotropic = material.elasticity.isotropic()?;
            let constants = if case.case.model.law.fixes_poisson() {
                bbpd::central(&given, plane)
            } else {
                given
            };
            Some(constants.in_plane(plane).poisson)
        })
        .collect();
    let which = "an orthotropic material";
    let of_materials = of_materials.ok_or(YieldError::NoPoisson { which })?;
    if let [only] = of_materials[..] {
        return Ok(vec![only; cloud.len()]);
    }
    let at = |point| cloud.mean_property(point, &of_materials);
    Ok((0..cloud.len()).map(at).collect())
}

fn find(model: &Model, place: Place) -> Result<u32, YieldError> {
    let (body, cloud) = (&model.body, &model.system.cloud);
    match place {
        Place::At(at) => {
            let point = cloud.nearest_point(at);
            let [x, y] = body.positions()[point as usize];
            let horizon = model.fixed.horizon[point as usize];
            if (x - at[0]).hypot(y - at[1]) <= horizon {
                return Ok(point);
            }
            let nearest = body.place(point);
            Err(YieldError::NotInBody {
                at,
                nearest,
                horizon,
            })
        }
        Place::Tag(tag) => {
            let points = || 0..cloud.len() as u32;
            let tags = || points().map(|point| body.tag(point));
            points()
                .find(|&point| body.tag(point) == tag)
                .ok_or_else(|| YieldError::NoPoint {
                    tagged: body.tagged(),
                    tag,
                    lowest: tags().min().unwrap_or(0),
                    highest: tags().max().unwrap_or(0),
                })
        }
    }
}
