//! The family of one point of a case, compared with the family of a lattice.

use std::io::Write;

use ligament_post::yielding::lattice;

use super::console;
use super::diagrams::{self, Comparison};
use super::error::YieldError;
use super::of_case::{criteria, model, poisson};
use super::request::{BodyPoint, Request};
use super::subject::{Strain, Subject};
use ligament::run::on_threads;
use ligament_case::case::CaseFile;
use ligament_run::model::Model;
use ligament_run::summary::heading;

/// Computes and writes the diagrams of one point.
pub(super) fn draw(
    request: &Request,
    case: &CaseFile,
    place: BodyPoint,
    screen: &mut (dyn Write + Send),
) -> anyhow::Result<()> {
    on_threads(case.threads(), || {
        let model = model(case)?;
        let point = find(&model, place)?;
        let poisson = poisson(request, &model)?[point as usize];
        let label = model.body().label(point);
        let mut comparisons = Vec::new();
        for (criterion, criteria) in criteria(request, &model)? {
            let subject = Subject::at_point(label.clone(), model.plane(), &criteria, point);
            comparisons.push(Comparison {
                criterion,
                subjects: vec![subject],
            });
        }
        // Where all bonds have the same limits, a lattice is comparable.
        for (comparison, combination) in comparisons.iter_mut().zip(&request.combinations) {
            let ratio = lattice::ratio_of_size(comparison.subjects[0].size as f64);
            let strengths = request.strengths(poisson);
            let mut lattice = Subject::from_lattice(ratio, combination, &strengths)?;
            lattice.name = format!("lattice m = {ratio:.2}");
            comparison.subjects.push(lattice);
        }
        let strains = Strain::in_figures(poisson);
        let yields = |it: &Comparison| {
            let family = it.subjects[0].family();
            let mut paths = diagrams::PATHS.into_iter();
            paths.any(|path| family.theoretical_utilisation(path) > 0.0)
        };
        if !comparisons.iter().any(yields) {
            return Err(YieldError::NeverYields { of: label }.into());
        }
        comparisons.retain(yields);
        diagrams::write(request.folder()?, &comparisons, &strains)?;
        writeln!(screen, "{}", heading(&case.case.title))?;
        writeln!(screen, "family of {}\n", model.body().place(point))?;
        for comparison in &comparisons {
            console::write(screen, comparison)?;
        }
        Ok(())
    })?
}

fn find(model: &Model, place: BodyPoint) -> Result<u32, YieldError> {
    let (body, cloud) = (model.body(), &model.plane().cloud);
    match place {
        BodyPoint::At(at) => {
            let point = cloud.nearest_point(at);
            let position = body.position(point);
            let horizon = model.fixed.horizon[point as usize];
            if (position[0] - at[0]).hypot(position[1] - at[1]) <= horizon {
                return Ok(point);
            }
            let nearest = body.place(point);
            Err(YieldError::NotInBody {
                at,
                nearest,
                horizon,
            })
        }
        BodyPoint::Tag(tag) => {
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
