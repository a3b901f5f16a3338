//! `ligament yield`: first yield of families of bonds, and its distortion by the directions of the bonds.
//!
//! | module | holds |
//! |---|---|
//! | [`criteria`] | criteria by name with the same limits for all bonds |
//! | [`subject`] | the compared families, and the strains |
//! | `request`, `error` | the request and its errors |
//! | `of_case`, `point`, `field` | families of a case: common parts, one point, all points |
//! | `diagrams`, `console` | tables, polar diagrams and loci; the terminal |

use std::io::Write;

mod console;
pub mod criteria;
mod diagrams;
mod error;
mod field;
mod of_case;
mod point;
mod request;
pub mod subject;

use criteria::Combination;
use diagrams::Comparison;
pub use error::YieldError;
pub use request::{BodyPoint, Families, Request};
use subject::{Strain, Subject};

/// Computes errors and loci, prints them and writes them.
///
/// # Errors
///
/// If the request is wrong, the case cannot be read or has no such point, or the folder cannot be used.
pub fn yielding(request: &Request, screen: &mut (dyn Write + Send)) -> anyhow::Result<()> {
    request.check()?;
    match &request.of {
        Families::Lattices(ratios) => yield_of_lattices(request, ratios, screen)?,
        Families::Point(case, place) => point::draw(request, case, *place, screen)?,
        Families::Field(case) => field::draw(request, case, screen)?,
    }
    Ok(writeln!(screen, "results in {}", request.out.display())?)
}

fn yield_of_lattices(
    request: &Request,
    ratios: &[f64],
    screen: &mut dyn Write,
) -> anyhow::Result<()> {
    let poisson = request.poisson.unwrap_or(0.0);
    let strengths = request.strengths(poisson);
    let given = &request.combinations;
    let combinations = if given.is_empty() {
        Combination::in_figures()
    } else {
        given.clone()
    };
    let mut comparisons = Vec::new();
    for combination in &combinations {
        let of_ratio = |&ratio: &f64| Subject::from_lattice(ratio, combination, &strengths);
        comparisons.push(Comparison {
            criterion: combination.name().to_owned(),
            subjects: ratios.iter().map(of_ratio).collect::<Result<_, _>>()?,
        });
    }
    let strains = Strain::in_figures(poisson);
    diagrams::write(request.folder()?, &comparisons, &strains)?;
    writeln!(
        screen,
        "lattices, nu = {poisson}, strains in units of the limit s0t, compressive over tensile strength {}\n",
        request.ratio
    )?;
    for comparison in &comparisons {
        console::write(screen, comparison)?;
    }
    Ok(())
}
